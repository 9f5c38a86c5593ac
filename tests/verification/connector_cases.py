#!/usr/bin/env python3
"""Connectors that are stopped, locked, driven, loaded and rubbed, in both procedures: connector_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import Job, check, check_energy, run_case
from joint_cases import deck_of_rods, rods
from motion_decks import G, GRAVITY, explicit_step, history, integrate


def connector_output(elements="JOINT", interval=None):
    when = f"TIME INTERVAL={interval}" if interval else "FREQUENCY=1"
    return f"*OUTPUT, HISTORY, {when}\n*ELEMENT OUTPUT, ELSET={elements}\nCTF, CRF, CEF, CSF, CCF, CU, CP\n"


def two_nodes(connector, behavior="", at=0.3, inertia="0.02, 0.02, 0.02"):
    """A body at (at, 0, 0) that a connector joins to the ground, its axis along x."""
    return f"""*NODE
1, 0., 0., 0.
2, {at!r}, 0., 0.
*NSET, NSET=BODY
2
*ELEMENT, TYPE=MASS, ELSET=M
1, 2
*MASS, ELSET=M
2.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 2
*ROTARY INERTIA, ELSET=I
{inertia}
*ELEMENT, TYPE=CONN3D2, ELSET=JOINT
5, 1, 2
*ORIENTATION, NAME=ALONG
1., 0., 0., 0., 1., 0.
*CONNECTOR BEHAVIOR, NAME=B
{behavior}*CONNECTOR SECTION, ELSET=JOINT, BEHAVIOR=B
{connector}
ALONG
*BOUNDARY
1, 1, 6
"""


def last(job, variable, step=1, group="element_5"):
    return job.history(group, variable, step)[1][-1]


def strut(run):
    """A strut with spring, preload, bump stop and rebound stop in statics: what the spring does not carry, the stop does."""
    stiffness, free, rebound, bump = 1e4, 0.35, 0.32, 0.2
    behavior = f"""*CONNECTOR ELASTICITY, COMPONENT=1
{stiffness}
*CONNECTOR CONSTITUTIVE REFERENCE
{free}
*CONNECTOR STOP, COMPONENT=1
{bump}, {rebound}
"""
    loads = (0.0, -1000.0, -3000.0, -200.0)
    steps = "".join(f"*STEP, NLGEOM\n*STATIC\n0.25, 1.\n*BOUNDARY\n2, 4, 4\n*CLOAD\n2, 1, {load}\n{connector_output()}*END STEP\n" for load in loads)
    for ranks in (1, 2):
        job = run(two_nodes("CYLINDRICAL", behavior) + steps, ranks)
        for step, load in enumerate(loads, 1):
            place = min(max(free + load / stiffness, bump), rebound)
            spring = stiffness * (place - free)
            check(f"place under {load}", last(job, "CP", step)[0], place, 1e-12)
            check(f"spring under {load}", last(job, "CEF", step)[0], spring, 1e-10)
            check(f"stop under {load}", last(job, "CRF", step)[0], load - spring, 1e-9)
            check(f"whole under {load}", last(job, "CTF", step)[0], load, 1e-9)


def struck_pendulum(run):
    """A bar that falls from level onto a stop of its hinge: it arrives as it must, loses all its speed and stays."""
    length, limit = 0.8, -1.0
    lines, centres = rods([(0.0, 0.0), (length, 0.0)])
    deck = deck_of_rods(lines, centres, explicit_step(1e-4, 1.0, GRAVITY, history("CENTRES", "UR3", 0.01) + connector_output("HINGES", 0.01)
                                                      .split("\n", 1)[1]))
    deck = deck.replace("*CONNECTOR SECTION, ELSET=HINGES", f"*CONNECTOR BEHAVIOR, NAME=B\n*CONNECTOR STOP, COMPONENT=4\n{limit},\n"
                        "*CONNECTOR SECTION, ELSET=HINGES, BEHAVIOR=B").replace("ALLKE, ALLIE, ALLWK, ETOTAL", "ALLKE, ALLIE, ALLWK, ALLVD, ETOTAL")
    for ranks in (1, 3):
        job = run(deck, ranks)
        time, turn = job.history("node_13", "UR3")
        free = integrate(lambda x: np.array([x[1], -1.5 * G / length * math.cos(x[0])]), [0.0, 0.0], time)[:, 0]
        falls = np.arange(len(time)) < np.argmax(free < limit)
        check("angle on the way", np.abs(turn - free)[falls].max(), 0.0, 1e-6)
        check("angle at the stop", np.abs(turn[~falls] - limit).max(), 0.0, 1e-9)
        check("speed that was lost", job.history("energy", "ALLVD")[1][-1], length * G * length / 2.0 * math.sin(-limit), 1e-4)
        check("moment of the stop", last(job, "CRF", group="element_3000")[3], -length * G * length / 2.0 * math.cos(limit), 1e-6)
        check_energy(job, 1e-3)


def braked_rotor(run):
    """A rotor whose hinge rubs with a constant moment comes to rest in omega I / M, and stays there under a smaller moment."""
    inertia, speed, moment = 0.02, 10.0, 0.5
    behavior = "*CONNECTOR FRICTION, COMPONENT=4\n2.5,\n*FRICTION\n0.2\n"
    deck = two_nodes("HINGE", behavior, at=0.0) + f"*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\n2, {speed}\n0., 0., 0., 1., 0., 0.\n"
    deck += explicit_step(1e-4, 1.0, "*CLOAD, AMPLITUDE=LATER\n2, 4, 0.4\n",
                          history("BODY", "UR1", 0.01).replace("ALLWK", "ALLWK, ALLFD") + connector_output("JOINT", 0.01).split("\n", 1)[1])
    deck = deck.replace("*INITIAL CONDITIONS", "*AMPLITUDE, NAME=LATER\n0., 0., 0.5, 0., 0.6, 1., 1., 1.\n*INITIAL CONDITIONS", 1)
    for ranks in (1, 2):
        job = run(deck, ranks)
        time, turn = job.history("node_2", "UR1")
        slow = moment / inertia
        stop = speed / slow
        expected = np.where(time < stop, speed * time - 0.5 * slow * time**2, 0.5 * speed * stop)
        check("angle", np.abs(turn - expected).max(), 0.0, 2e-3 * expected.max())
        check("creep at rest", np.ptp(turn[time > stop + 0.02]), 0.0, 1e-12)
        check("work of friction", job.history("energy", "ALLFD")[1][-1], 0.5 * inertia * speed**2, 1e-3)
        check("moment that holds", last(job, "CSF")[3], 0.4, 1e-6)
        check_energy(job, 1e-3)


def rubbing_slider(run):
    """A block on a slot that is pressed across it: it sticks up to mu N, in statics and on its way."""
    behavior = """*CONNECTOR DERIVED COMPONENT, NAME=PRESSED
2, 3
*CONNECTOR FRICTION, COMPONENT=1, CONTACT FORCE=PRESSED
*FRICTION
0.3
*CONNECTOR ELASTICITY, COMPONENT=1
1e4
"""
    steps = ""
    for along in (20.0, 50.0, 35.0):
        steps += f"*STEP, NLGEOM\n*STATIC\n0.25, 1.\n*CLOAD\n2, 1, {along}\n2, 2, -60.\n2, 3, 80.\n{connector_output()}*END STEP\n"
    for ranks in (1, 2):
        job = run(two_nodes("TRANSLATOR", behavior) + steps, ranks)
        check("it sticks", abs(last(job, "CU", 1)[0]), 0.0, 1e-12)
        check("friction that holds", last(job, "CSF", 1)[0], 20.0, 1e-9)
        check("it slips", last(job, "CU", 2)[0], 20.0 / 1e4, 1e-9)
        check("friction that slips", last(job, "CSF", 2)[0], 30.0, 1e-9)
        check("it sticks where it was", last(job, "CU", 3)[0], 20.0 / 1e4, 1e-9)
        check("friction less", last(job, "CSF", 3)[0], 15.0, 1e-8)


def slider_at(place, lines, mass=0.5, behavior=""):
    """A slider at the end of the second rod, node 4 on the x axis, which a translator guides: adds its nodes to the lines of the rods and
    gives the rest of its deck. Keywords of `behavior` belong to the guide."""
    lines["node"].append(f"3, {place!r}, 0., 0.\n4, {place!r}, 0., 0.")
    return f"""*ELEMENT, TYPE=MASS, ELSET=SLIDER
7000, 4
*MASS, ELSET=SLIDER
{mass}
*ELEMENT, TYPE=ROTARYI, ELSET=SLIDERI
7003, 4
*ROTARY INERTIA, ELSET=SLIDERI
0.01, 0.01, 0.01
*ELEMENT, TYPE=CONN3D2, ELSET=PIN
7001, 22, 4
*ELEMENT, TYPE=CONN3D2, ELSET=GUIDE
7002, 3, 4
*ELSET, ELSET=CRANK
3000
*ORIENTATION, NAME=ALONG_X
1., 0., 0., 0., 1., 0.
*CONNECTOR SECTION, ELSET=PIN
JOIN
*CONNECTOR BEHAVIOR, NAME=GUIDE
{behavior}*CONNECTOR SECTION, ELSET=GUIDE, BEHAVIOR=GUIDE
TRANSLATOR
ALONG_X
*BOUNDARY
3, 1, 6
"""


def slider_crank(run):
    """The slider of a crank that a motion of its hinge turns, in statics and in time: r cos a + sqrt(l^2 - r^2 sin^2 a)."""
    r, l, speed = 0.3, 0.8, 5.0
    points = [(0.0, 0.0), (r, 0.0), (r + l, 0.0)]
    lines, centres = rods(points)
    extra = slider_at(r + l, lines, mass=1.0) + "*NSET, NSET=SLIDER\n4\n"
    place = lambda a: r * np.cos(a) + np.sqrt(l**2 - (r * np.sin(a))**2)
    moves = lambda duration: explicit_step(1e-4, duration, f"*CONNECTOR MOTION, TYPE=VELOCITY\nCRANK, 4, {speed}\n", history("SLIDER", "U1", 0.01))
    turns = f"*STEP, NLGEOM, INC=200\n*STATIC\n0.05, 1., 1e-6, 0.05\n*CONNECTOR MOTION\nCRANK, 4, {2.5 * math.pi!r}\n*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=SLIDER\nU1\n*END STEP\n"
    for steps, ranks, angle, tolerance in ((moves(2.0), 1, lambda t: speed * t, 1e-6), (moves(0.5), 2, lambda t: speed * t, 1e-6),
                                           (turns, 1, lambda t: 2.5 * math.pi * t, 1e-8), (turns, 2, lambda t: 2.5 * math.pi * t, 1e-8)):
        job = run(deck_of_rods(lines, centres, extra + steps), ranks)
        time, u = job.history("node_4", "U1")
        check("place of the slider", np.abs(r + l + u - place(angle(time))).max(), 0.0, tolerance)


def on_the_ground(run):
    """Springs between a body and the ground, where the body is at first: one end is left empty, or is 0."""
    for ends in ("2,", ", 2", "0, 2", "2, 0"):
        deck = two_nodes("CARTESIAN", "*CONNECTOR ELASTICITY, COMPONENT=1\n100.\n", at=0.3).replace("5, 1, 2\n", f"5, {ends}\n")
        steps = "".join(f"*STEP, NLGEOM\n*STATIC\n*BOUNDARY, OP=NEW\n2, 2, 6\n*CLOAD\n2, 1, {load}\n{connector_output()}*END STEP\n" for load in (3.0, 5.0))
        job = run(deck.replace("*BOUNDARY\n1, 1, 6\n", "") + steps, 2)
        for step, load in ((1, 3.0), (2, 5.0)):
            sign = 1.0 if ends in (", 2", "0, 2") else -1.0
            check(f"relative motion of {ends}", last(job, "CU", step)[0], sign * load / 100.0, 1e-12)


def driven_hinge(run):
    """A moment between the ground and a rotor: half M t^2 / I; in statics against a spring, M / k; a hinge that locks."""
    inertia = 0.02
    job = run(two_nodes("HINGE", at=0.0) + explicit_step(1e-4, 1.0, "*CONNECTOR LOAD\nJOINT, 4, 0.1\n", history("BODY", "UR1", 0.1)), 2)
    time, turn = job.history("node_2", "UR1")
    check("angle under a moment", np.abs(turn - 0.5 * 0.1 / inertia * time**2).max(), 0.0, 1e-3)
    check_energy(job, 1e-3)
    spring = "*CONNECTOR ELASTICITY, COMPONENT=4\n0.5\n"
    job = run(two_nodes("HINGE", spring, at=0.0) + f"*STEP, NLGEOM\n*STATIC\n*CONNECTOR LOAD\n5, 4, 0.1\n{connector_output()}*END STEP\n", 1)
    check("angle against a spring", last(job, "CU")[3], 0.2, 1e-12)
    check("the load itself", last(job, "CCF")[3], 0.1, 1e-12)
    lock = "*CONNECTOR LOCK, COMPONENT=4\n, 0.3\n"
    job = run(two_nodes("HINGE", lock, at=0.0) + explicit_step(1e-4, 1.0, "*CONNECTOR LOAD\nJOINT, 4, 0.1\n", history("BODY", "UR1", 0.01)), 1)
    turn = job.history("node_2", "UR1")[1]
    check("angle where it locked", turn[-1], 0.3, 1e-3)
    check("it stays", np.ptp(turn[-20:]), 0.0, 1e-12)


def damped_strut(run):
    """A strut whose rod hardly resists turning: its spring and damper act along it and do not turn it, so they do not bound the increment."""
    mass, stiffness, viscosity, x0 = 2.0, 1e4, 100.0, 0.01
    behavior = f"*CONNECTOR ELASTICITY, COMPONENT=1\n{stiffness}\n*CONNECTOR DAMPING, COMPONENT=1\n{viscosity}\n"
    deck = two_nodes("CYLINDRICAL", behavior, at=0.6, inertia="1e-6, 1e-6, 1e-6")
    deck = deck.replace("*CONNECTOR SECTION", f"*CONNECTOR CONSTITUTIVE REFERENCE\n{0.6 - x0}\n*CONNECTOR SECTION")
    output = "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=BODY\nU1\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ETOTAL\n"
    omega, rate = math.sqrt(stiffness / mass), 0.5 * viscosity / mass
    damped = math.sqrt(omega**2 - rate**2)
    limit = 2.0 / (rate + math.sqrt(rate**2 + omega**2))
    for ranks in (1, 2):
        job = run(deck + f"*STEP\n*DYNAMIC, EXPLICIT, SCALE FACTOR=0.05\n, 0.2\n*BULK VISCOSITY\n0., 0.\n{output}*END STEP\n", ranks)
        time, u = job.history("node_2", "U1")
        check("increment", np.diff(time)[1:-100].min(), 0.05 * 0.9 * limit, 1e-3)
        expected = x0 * np.exp(-rate * time) * (np.cos(damped * time) + rate / damped * np.sin(damped * time)) - x0
        check("motion", np.abs(u - expected).max(), 0.0, 0.05 * x0)
        check_energy(job, 1e-2)


def thrown_off(run):
    """A CARTESIAN spring along one axis, whose node is thrown off along a free one: the arm of its force grows from 1 mm to 3 m, and the
    increments shrink with it. Momentum, energy and angular momentum stay, and so do the bits when the job goes on from a checkpoint."""
    deck = """*NODE
1, 0., 0., 0.
2, 0.001, 0., 0.
*NSET, NSET=BOTH
1, 2
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 2
*MASS, ELSET=M
1.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 1
4, 2
*ROTARY INERTIA, ELSET=I
0.01, 0.01, 0.01
*ELEMENT, TYPE=CONN3D2, ELSET=JOINT
5, 1, 2
*CONNECTOR BEHAVIOR, NAME=B
*CONNECTOR ELASTICITY, COMPONENT=1
1e4
*CONNECTOR SECTION, ELSET=JOINT, BEHAVIOR=B
CARTESIAN
*INITIAL CONDITIONS, TYPE=VELOCITY
2, 2, 10.
2, 1, 0.1
*STEP
*DYNAMIC, EXPLICIT
, 0.3
*OUTPUT, HISTORY, TIME INTERVAL=0.01
*NODE OUTPUT, NSET=BOTH
U, V, VR
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*RESTART, WRITE, NUMBER INTERVAL=3
*END STEP
"""
    jobs = [run(deck, ranks) for ranks in (1, 2)]
    job = jobs[0]
    check_energy(job, 1e-2)
    u, v, spin = ([job.history(f"node_{node}", variable)[1] for node in (1, 2)] for variable in ("U", "V", "VR"))
    check("distance", float(np.linalg.norm(u[1][-1] - u[0][-1]) > 2.0), 1.0, 0.0)
    check("momentum", np.abs(v[0] + v[1] - np.array((0.1, 10.0, 0.0))).max(), 0.0, 1e-9)
    place = [u[0], u[1] + np.array((0.001, 0.0, 0.0))]
    angular = sum(np.cross(place[i], v[i])[:, 2] + 0.01 * spin[i][:, 2] for i in (0, 1))
    check("angular momentum", np.abs(angular - 0.01).max(), 0.0, 1e-2)
    stopped = Job("stopped", job.balocco, "2", job.folder)
    (stopped.folder / "stopped.ctl").write_text("stop\n")
    stopped.run(deck, expected_status=4)
    (stopped.folder / "stopped.ctl").unlink(missing_ok=True)
    stopped.ranks = "1"
    stopped.run(deck, arguments=("--restart",))
    for other in (jobs[1], stopped):
        check(f"bits in {other.name}", float(np.array_equal(job.history("node_2", "U")[1], other.history("node_2", "U")[1])), 1.0, 0.0)


def joints_of_constraints(run):
    """*MPC REVOLUTE and UNIVERSAL with PIN do what the connectors HINGE and UJOINT do: a tilted body that swings from another one."""
    axis, across = np.array((0.6, 0.0, 0.8)), np.array((0.0, 1.0, 0.0))
    show = lambda node, direction: f"{node}, " + ", ".join(repr(float(x)) for x in (np.array((0.1, 0.2, 0.3)) + 0.5 * direction)) + "\n"
    first = ", ".join(repr(float(x)) for x in axis)
    bodies = """*NODE
1, 0.1, 0.2, 0.3
2, 0.1, 0.2, 0.3
3, 0.4, 0.3, 0.1
SHOWN*NSET, NSET=SWINGS
2
*NSET, NSET=END
3
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 3
*MASS, ELSET=M
2.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 1
4, 2
*ROTARY INERTIA, ELSET=I
0.02, 0.03, 0.04
*MPC
BEAM, 3, 2
*BOUNDARY
1, 1, 3
"""
    joints = {"REVOLUTE": ("HINGE", "REVOLUTE, 2, 1, 11\nPIN, 2, 1\n"), "UNIVERSAL": ("UJOINT", "UNIVERSAL, 2, 1, 11, 12\nPIN, 2, 1\n")}
    for ranks, (kind, (connector, lines)) in zip((1, 2), joints.items()):
        load = "*DLOAD\n, GRAV, 9.81, 0.2, -0.9, 0.3\n"
        step = explicit_step(1e-4, 0.4, load, "*OUTPUT, HISTORY, TIME INTERVAL=0.02\n*NODE OUTPUT, NSET=SWINGS\nUR\n*NODE OUTPUT, NSET=END\nU\n"
                             "*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ETOTAL\n")
        by_constraint = run(bodies.replace("SHOWN", show(11, axis) + show(12, np.cross(axis, across))) + "*MPC\n" + lines + step, ranks)
        by_connector = run(bodies.replace("SHOWN", "") + f"""*ELEMENT, TYPE=CONN3D2, ELSET=JOINT
5, 1, 2
*ORIENTATION, NAME=AXES
{first}, {', '.join(repr(float(x)) for x in across)}
*CONNECTOR SECTION, ELSET=JOINT
{connector}
AXES
""" + step, ranks)
        for node, variable in ((2, "UR"), (3, "U")):
            ours, theirs = (job.history(f"node_{node}", variable)[1] for job in (by_constraint, by_connector))
            check(f"{kind}: {variable} moves", float(np.abs(theirs).max() > 0.1), 1.0, 0.0)
            check(f"{kind}: {variable}", np.abs(ours - theirs).max(), 0.0, 1e-7)
        check_energy(by_constraint, 1e-3)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (strut, damped_strut, struck_pendulum, braked_rotor, rubbing_slider, slider_crank, on_the_ground, driven_hinge, thrown_off, joints_of_constraints)})
