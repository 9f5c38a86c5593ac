#!/usr/bin/env python3
"""Explicit dynamics against closed forms: runs the real binary on small decks and checks what it wrote.

usage: explicit_cases.py CASE BALOCCO RANKS FOLDER      exit status 0: everything within tolerance
"""
import math
import sys

import numpy as np

from job import DECKS, Job, check, check_energy, failures


def truss_stability(job):
    """DT-T3D2: the critical increment of a free lumped truss is L / c = 1.933415e-5 exactly."""
    critical = 0.1 * math.sqrt(7850.0 / 210e9)
    template = (DECKS / "truss_stability.inp").read_text()
    job.run(template.replace("INCREMENT", f"{0.999 * critical:.12e}"))
    # Starting from rest with velocity v, x(n) = v dt sin(n t) / sin(t), cos(t) = 1 - 2 * 0.999^2: at most v dt / sin(t) / 2 each way.
    angle = math.acos(1.0 - 2.0 * 0.999**2)
    stretch = job.history("node_2", "U1")[1] - job.history("node_1", "U1")[1]
    check("largest stretch below the limit", np.abs(stretch).max(), 1e-6 * 0.999 * critical / math.sin(angle), 0.02)
    # Beyond the limit the amplitude grows by the exponent acosh(2 * 1.001^2 - 1) an increment.
    job.run(template.replace("INCREMENT", f"{1.001 * critical:.12e}"))
    stretch = np.abs(job.history("node_2", "U1")[1] - job.history("node_1", "U1")[1])
    check("growth beyond the limit", math.log(stretch[100] / stretch[50]) / 50.0, math.acosh(2.0 * 1.001**2 - 1.0), 1e-3)
    # Far beyond it the run is stopped.
    output = job.run(template.replace("INCREMENT", f"{2.0 * critical:.12e}"), expected_status=3)
    told = "of element 1" in output or "element 1 has become" in output
    check("the failure names the element", float(told), 1.0, 0.0)


def rod_impact(job):
    """RODS: half of the symmetric impact, a rod at 5 m/s against a rigid wall; one-dimensional wave theory."""
    job.run()
    speed, density, velocity = math.sqrt(200e9 / 7800.0), 7800.0, 5.0
    time, force = job.history("node_1000", "RF1")
    duration, area = 2.0 / speed, 1e-4
    plateau = force[(time > 0.2 * duration) & (time < 0.8 * duration)]
    check("mean stress during contact", abs(plateau.mean()) / area, density * speed * velocity, 0.02)
    impulse = abs(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(time)))
    check("impulse", impulse, 2.0 * density * area * velocity, 0.01)
    touching = time[np.abs(force) > 0.5 * np.abs(force).max()]
    # The contact spring and 100 elements smear both ends over about two elements' transit time.
    check("duration of contact", touching[-1] - touching[0], duration, 0.04)
    check("exit velocity of the middle", job.history("node_51", "V1")[1][-50:].mean(), velocity, 0.02)
    check_energy(job, 2e-4)


def free_flight(job):
    """A soft block tumbles freely: momentum and angular momentum stay to round-off, energy to 0.1 %."""
    job.run()
    coordinates, bricks = job.mesh("C3D8R")
    mass = np.zeros(len(coordinates))
    np.add.at(mass, bricks.ravel(), 1000.0 * 0.1**3 / len(bricks) / 8.0)  # equal cubes of a block of 0.1 m
    momenta, spins = [], []
    for frame in range(11):
        position, velocity = coordinates + job.frame("U", frame), job.frame("V", frame)
        momenta.append(mass @ velocity)
        spins.append(mass @ np.cross(position, velocity))
    momentum, spin = np.array(momenta), np.array(spins)
    check("drift of momentum", np.abs(momentum - momentum[0]).max() / np.abs(momentum[0]).max(), 0.0, 1e-12)
    check("drift of angular momentum", np.abs(spin - spin[0]).max() / np.abs(spin[0]).max(), 0.0, 1e-11)
    check("momentum", momentum[-1][0], 1000.0 * 0.1**3 * 20.0, 1e-12)
    check_energy(job, 1e-3)


def spun_block(job):
    """A block carried by a driven rigid body turns 3 times: nothing strains, the axis carries the centripetal force."""
    job.run()
    kinetic, internal = job.history("energy", "ALLKE")[1], job.history("energy", "ALLIE")[1]
    check("strain energy of a rigid rotation", np.abs(internal).max() / kinetic.max(), 0.0, 1e-12)
    mass, spin = 1000.0 * 0.1**3, 2.0 * math.pi * 10.0
    arm = 0.05 * math.sqrt(2.0)
    reaction = job.frame("RF", -1)
    reference = np.abs(reaction).sum(axis=1).argmax()
    check("centripetal force", np.linalg.norm(reaction[reference]), mass * spin**2 * arm, 1e-5)
    check("rotation after three turns", job.frame("UR", -1)[reference][2], 6.0 * math.pi, 1e-9)


def pendulum(job):
    """PEND: L = 1, g = 9.81, released at 90 degrees: period 2.36784 s, greatest speed 4.42945 m/s (elliptic integral)."""
    job.run()
    time, x = job.history("node_2", "U1")
    across = 1.0 + x  # zero at the bottom
    falls = [i for i in range(len(time) - 1) if across[i] > 0.0 >= across[i + 1]]
    rises = [i for i in range(len(time) - 1) if across[i] < 0.0 <= across[i + 1]]
    crossing = lambda i: time[i] + (time[i + 1] - time[i]) * across[i] / (across[i] - across[i + 1])
    check("quarter period", crossing(falls[0]), 2.36784 / 4.0, 1e-3)
    check("half a period between passes", crossing(rises[0]) - crossing(falls[0]), 2.36784 / 2.0, 1e-3)
    speed = np.linalg.norm(job.history("node_2", "V")[1], axis=1)
    check("greatest speed", speed.max(), 4.42945, 1e-3)
    check_energy(job, 1e-3)


def dzhanibekov_node(job):
    """The same without a rigid body: MASS and ROTARYI on a free node."""
    deck = (DECKS / "dzhanibekov.inp").read_text()
    dzhanibekov(job, deck.replace("*RIGID BODY, REF NODE=1, ELSET=FRAME\n", ""))


def dzhanibekov(job, text=None):
    """A free rigid body with inertia 1, 2, 3 spins about its middle axis and flips. Reference: Euler's equations by RK4."""
    job.run(text)
    time, spin = job.history("node_1", "VR")
    inertia = np.diag([1.0, 2.0, 3.0])

    def rate(state):
        w, rotation = state[:3], state[3:].reshape(3, 3)  # spin in the body's frame
        change = np.linalg.solve(inertia, np.cross(inertia @ w, w))
        skew = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        return np.concatenate([change, (rotation @ skew).ravel()])

    state, now, reference = np.concatenate([[0.05, 3.0, 0.0], np.eye(3).ravel()]), 0.0, []
    for t in time:
        steps = max(1, math.ceil((t - now) / 1e-3))
        h = (t - now) / steps
        for _ in range(steps if h > 0.0 else 0):
            a = rate(state)
            b = rate(state + 0.5 * h * a)
            c = rate(state + 0.5 * h * b)
            d = rate(state + h * c)
            state = state + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        now = t
        reference.append(state[3:].reshape(3, 3) @ state[:3])
    reference = np.array(reference)
    # The flip amplifies the error of the increments (0.2 % of a period): compare the whole history.
    check("spin over three flips, worst difference / 3", np.abs(spin - reference).max() / 3.0, 0.0, 0.02)
    kinetic = job.history("energy", "ALLKE")[1]
    check("kinetic energy", np.abs(kinetic - kinetic[0]).max() / kinetic[0], 0.0, 2e-3)


def rolling_deck(inertia):
    """A rigid ring of radius 0.1 m and 360 strips, mass 1, slides at 10 m/s on a plane with mu = 0.4."""
    lines = ["*HEADING", "Skidding ring", "*NODE"]
    count, radius = 360, 0.1
    for side, z in ((0, -0.01), (1, 0.01)):
        for i in range(count):
            angle = 2.0 * math.pi * i / count
            lines.append(f"{side * 1000 + i + 1}, {radius * math.sin(angle):.15g}, {-radius * math.cos(angle):.15g}, {z}")
    lines += ["9001, 0., 0., 0.", "9002, 0., -0.1, 0.", "*ELEMENT, TYPE=M3D4R, ELSET=RING"]
    for i in range(count):
        j = (i + 1) % count
        lines.append(f"{i + 1}, {i + 1}, {1001 + i}, {1001 + j}, {j + 1}")
    lines += f"""*ELEMENT, TYPE=MASS, ELSET=HUB
2001, 9001
*ELEMENT, TYPE=ROTARYI, ELSET=SPIN
2002, 9001
*MASS, ELSET=HUB
1.
*ROTARY INERTIA, ELSET=SPIN
{inertia}, {inertia}, {inertia}
*MEMBRANE SECTION, ELSET=RING, MATERIAL=SKIN
0.001
*MATERIAL, NAME=SKIN
*ELASTIC
1e9, 0.3
*DENSITY
0.1
*NSET, NSET=HUB
9001
*SURFACE, NAME=TREAD
RING, SPOS
*SURFACE, NAME=GROUND, TYPE=SEGMENTS
START, -10., -0.1
LINE, 100., -0.1
*RIGID BODY, REF NODE=9001, ELSET=RING
*RIGID BODY, REF NODE=9002, ANALYTICAL SURFACE=GROUND
*SURFACE INTERACTION, NAME=GRIP
*FRICTION
0.4
*CONTACT PAIR, INTERACTION=GRIP
TREAD, GROUND
*BOUNDARY
9002, 1, 6
9001, 3, 5
*INITIAL CONDITIONS, TYPE=VELOCITY
HUB, 1, 10.
*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
5e-5, 1.6
*DLOAD
, GRAV, 9.81, 0., -1., 0.
*OUTPUT, HISTORY, TIME INTERVAL=0.002
*NODE OUTPUT, NSET=HUB
U, V, VR
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ALLFD, ETOTAL
*END STEP""".splitlines()
    return "\n".join(lines) + "\n"


def skid(job):
    """SKID: the end of sliding of a skidding ring and disc: v = v0 / (1 + I / m r2), t = v0 (I / m r2) / (mu g (1 + I / m r2))."""
    for name, inertia, speed, end in (("hoop", 0.01, 5.0, 1.27421), ("disc", 0.005, 6.66667, 0.84947)):
        job.run(rolling_deck(inertia))
        time, velocity = job.history("node_9001", "V")
        spin = job.history("node_9001", "VR")[1][:, 2]
        check(f"{name}: speed when rolling", velocity[-50:, 0].mean(), speed, 0.01)
        check(f"{name}: spin when rolling", -0.1 * spin[-50:].mean(), speed, 0.01)
        half = np.interp(0.5 * (10.0 + speed), velocity[::-1, 0], time[::-1])
        check(f"{name}: time to half the loss of speed", half, 0.5 * end, 0.01)
        check_energy(job, 1e-2)


def sliding_block(job):
    """SLIDE: a rubber block at rest under gravity on a plane (static) is thrown at 1 m/s: it stops after v0^2 / (2 mu g)."""
    job.run()
    start = next(line for line in job.log().splitlines() if "starts with" in line)
    check("imbalance when the explicit step starts", float(start.split("= ")[1].split()[0]), 0.0, 1e-8)
    moved = [job.frame("U", frame, step=2)[:-1, 0].mean() for frame in (0, -1)]  # the last node is the plane's
    check("stopping distance", moved[1] - moved[0], 1.0 / (2.0 * 0.5 * 9.81), 0.02)
    heat = job.history("energy", "ALLFD", 2)[1]
    check("heat", heat[-1] - heat[0], 0.5 * 1000.0 * 0.1 * 0.1 * 0.05, 0.02)
    check_energy(job, 1e-2, steps=(2,))


def chattering_block(job):
    """SLIDE without damping: the block is dropped from 0.1 mm while it slides at 2 m/s, and hops for as long as it slides. The mean
    normal force is its weight, so it stops where a block that never leaves the plane does, and by then all its energy is heat
    but for m g h and what bulk viscosity has taken from the vibrations of the hops."""
    text = (DECKS / "sliding_block.inp").read_text()
    start, end = text.index("*STEP, NAME=SETTLE"), text.index("*STEP, NAME=SLIDE")
    text = text[:start] + text[end:]
    for old, new in (("*DAMPING, BETA=5e-5\n", ""), ("BLOCK, 1, 1.", "BLOCK, 1, 2."), (", 0.25", ", 0.5"),
                     ("START, -10., 0.\nLINE, 10., 0.", "START, -10., -1e-4\nLINE, 10., -1e-4"),
                     ("ACROSS, 1, 1\nMIDDLE, 3, 3\n", ""),
                     ("ALLFD", "ALLFD, ALLVD"), ("*OUTPUT, FIELD", "*DLOAD\n, GRAV, 9.81, 0., -1., 0.\n*OUTPUT, FIELD")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    job.run(text)
    distance = job.frame("U", -1)[:-1, 0].mean()  # the last node is the plane's
    # Speed is lost hop by hop, at most 2 mu sqrt(2 g h) = 2 % of it at once: 1 %.
    check("stopping distance", distance, 4.0 / (2.0 * 0.5 * 9.81), 0.01)
    start, heat, viscous = 0.5 * 1000.0 * 0.1 * 0.1 * 0.05 * 4.0, job.history("energy", "ALLFD")[1][-1], job.history("energy", "ALLVD")[1][-1]
    check("heat, and what bulk viscosity took from the vibrations", heat + viscous, start, 0.005)
    check("part of the vibrations", viscous / start, 0.0, 0.03)
    check_energy(job, 1e-3)


RESTING_PAIR = """*HEADING
A held cube dips into a plane that moves; the pair rests while the plane moves on, and comes back
*NODE
1, 0., 0., -0.001
2, 1., 0., -0.001
3, 1., 1., -0.001
4, 0., 1., -0.001
5, 0., 0., 0.999
6, 1., 0., 0.999
7, 1., 1., 0.999
8, 0., 1., 0.999
9002, 0., 0., 0.
*ELEMENT, TYPE=C3D8R, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*SOLID SECTION, ELSET=CUBE, MATERIAL=M
*MATERIAL, NAME=M
*ELASTIC
1e6, 0.
*DENSITY
1000.
*NSET, NSET=CUBE, GENERATE
1, 8
*NSET, NSET=PLANE
9002
*SURFACE, NAME=SOLE
CUBE, S1
*SURFACE, NAME=GROUND, TYPE=CYLINDER
0., 0., 0., 1., 0., 0.
0., 1., 0.
START, -10., 0.
LINE, 10., 0.
*RIGID BODY, REF NODE=9002, ANALYTICAL SURFACE=GROUND
*SURFACE INTERACTION, NAME=GRIP
*FRICTION
0.5
*CONTACT PAIR, INTERACTION=GRIP
SOLE, GROUND
*BOUNDARY
CUBE, 1, 3
9002, 2, 6
""" + "".join(f"""*STEP
*DYNAMIC, EXPLICIT
, 0.1
*BOUNDARY, TYPE=VELOCITY
9002, 1, 1, {speed}
{change}*OUTPUT, HISTORY, TIME INTERVAL=0.01
*NODE OUTPUT, NSET=PLANE
RF
*ENERGY OUTPUT
ALLFD
*END STEP
""" for speed, change in ((0.1, ""), (0.1, "*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nSOLE, GROUND\n"),
                          (0.0, "*MODEL CHANGE, TYPE=CONTACT PAIR, ADD\nSOLE, GROUND\n")))


def resting_pair(job):
    """A pair that rests in a step has forgotten where its nodes stuck when it comes back: the plane, which moved on meanwhile,
    presses and does not pull. Heat stays: normal force x mu x slip, all but the stretch of the tangential spring, mu x depth."""
    job.run(RESTING_PAIR)
    depth, pressing = 1e-3, 1e6 / 2.0 * 1e-3  # k = E A / (2 h) in all, of a cube of 1
    first, rest, back = (job.history("node_9002", "RF", step)[1][-1] for step in (1, 2, 3))
    check("normal force", abs(first[2]), pressing, 1e-9)
    check("friction", first[0], 0.5 * pressing, 1e-9)
    check("force while the pair rests", np.abs(rest).max(), 0.0, 1e-9 * pressing)
    check("normal force of the pair that came back", abs(back[2]), pressing, 1e-9)
    check("its friction", abs(back[0]), 0.0, 1e-9 * pressing)
    for step in (1, 2, 3):
        heat = job.history("energy", "ALLFD", step)[1][-1]
        check(f"heat after step {step}", heat, 0.5 * pressing * (0.01 - 0.5 * depth), 1e-6)


def resting_block(job):
    """An imported equilibrium stays at rest: block on a plane under gravity, static then explicit."""
    job.run()
    start = next(line for line in job.log().splitlines() if "starts with" in line)
    check("imbalance when the explicit step starts", float(start.split("= ")[1].split()[0]), 0.0, 1e-8)
    load = job.history("node_9002", "RF2", 2)[1]
    check("drift of the load on the plane", np.abs(load - load[0]).max() / abs(load[0]), 0.0, 1e-6)
    check("load on the plane", abs(load[-1]), 1000.0 * 0.1 * 0.1 * 0.05 * 9.81, 1e-6)


def driven_block(job):
    """Prescribed motion in rotated directions: the driven end goes where it is told, and its reactions do the work."""
    job.run()
    moved = job.frame("U", -1)
    coordinates, _ = job.mesh("C3D8R")
    ends = coordinates[:, 0] > 0.0999
    angle = math.radians(30.0)
    along = np.array([math.cos(angle), math.sin(angle), 0.0])
    check("displacement along the prescribed direction", (moved[ends] @ along).max(), 0.01, 1e-9)
    check("the same at every driven node", (moved[ends] @ along).min(), 0.01, 1e-9)
    check_energy(job, 1e-3)


FIRST_INCREMENT = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 2
*MASS, ELSET=M
2.
*AMPLITUDE, NAME=RAMP
0., 0., 1., 1.
*BOUNDARY
1, 2, 3
2, 2, 3
*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
DT, 0.5
*BOUNDARY, TYPE=DISPLACEMENT, AMPLITUDE=RAMP
1, 1, 1, 0.4
*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=RAMP
2, 1, 1, 0.4
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=ENDS
U1, V1
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*END STEP
"""


def first_increment(job):
    """What is prescribed holds from the first increment on, also where it is the only one; a displacement starts as fast as it goes."""
    # A range of ids takes no longer than there are nodes.
    deck = FIRST_INCREMENT.replace("*ELEMENT", "*NSET, NSET=ENDS, GENERATE\n1, 9000000000000000000\n*ELEMENT", 1)
    # Frames at each of very many times are frames at all increments.
    deck = deck.replace("*OUTPUT, HISTORY", "*OUTPUT, FIELD, TIME INTERVAL=1e-18\n*NODE OUTPUT\nU\n*OUTPUT, HISTORY")
    for increments in (1, 5):
        job.run(deck.replace("DT", repr(0.5 / increments), 1))
        time, ramp = job.history("node_1", "U1")
        check("increments", len(time), increments + 1, 0.0)
        check("way in the frame of each increment", job.frame("U", increments)[0][0], 0.4 * 0.5, 1e-6)
        check("displacement along its course", np.abs(ramp - 0.4 * time).max(), 0.0, 1e-12)
        check("speed of a course", np.abs(job.history("node_1", "V1")[1] - 0.4).max(), 0.0, 1e-9)
        check("way of a growing velocity", np.abs(job.history("node_2", "U1")[1] - 0.2 * time**2).max(), 0.0, 1e-12)
        check_energy(job, 1e-9)


CASES = {case.__name__: case for case in (truss_stability, rod_impact, free_flight, spun_block, pendulum, dzhanibekov, dzhanibekov_node, skid,
                                          sliding_block, chattering_block, resting_pair, resting_block, driven_block, first_increment)}

if __name__ == "__main__":
    case, balocco, ranks, folder = sys.argv[1:]
    CASES[case](Job(case, balocco, ranks, folder))
    sys.exit(f"{len(failures)} checks failed" if failures else 0)
