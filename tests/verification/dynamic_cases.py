#!/usr/bin/env python3
"""Implicit dynamics against closed forms: dynamic_cases.py CASE BALOCCO FOLDER."""
import math
import sys

import numpy as np

from job import Job, check, failures
from explicit_contact_cases import block

HISTORY = """*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=WATCHED
U, V, A
*ENERGY OUTPUT
ALLKE, ALLIE, ALLSE, ALLVD, ALLWK, ETOTAL
"""
OMEGA = math.sqrt(1000.0)
SELDOM = "*OUTPUT, FIELD, FREQUENCY=1000000\n*NODE OUTPUT\nU\n"  # a frame an increment takes longer than the increment


def oscillator(steps, dashpot=0.0, nlgeom="", speed=1e-2):
    """A unit mass on a spring of stiffness 1000 that starts with a velocity."""
    damper = "*ELEMENT, TYPE=DASHPOT1, ELSET=DAMPER\n3, 2\n*DASHPOT, ELSET=DAMPER\n1\n%.15g\n" % dashpot if dashpot else ""
    text = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
*NSET, NSET=WATCHED
2
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 2
*MASS, ELSET=MASS
1.
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
2, 1, 2
*SPRING, ELSET=SPRING

1000.
%s*BOUNDARY
1, 1, 3
2, 2, 3
*INITIAL CONDITIONS, TYPE=VELOCITY
2, 1, %.15g
""" % (damper, speed)
    for procedure in steps:
        frames = "" if "EXPLICIT" in procedure else SELDOM
        text += "*STEP, INC=100000%s\n%s\n%s*END STEP\n" % (nlgeom, procedure, frames + HISTORY)
    return text


def implicit(alpha, increment, period):
    return "*DYNAMIC, DIRECT, ALPHA=%.15g\n%.15g, %.15g" % (alpha, increment, period)


def ringing(time, ratio=0.0, speed=1e-2):
    damped = OMEGA * math.sqrt(1.0 - ratio * ratio)
    return speed / damped * np.exp(-ratio * OMEGA * time) * np.sin(damped * time)


def rate_of_error(balocco, folder):
    """Second order in the increment with and without numerical damping, dashpot and large displacements; the trapezoidal rule (ALPHA=0)
    keeps the energy of a linear oscillator to the last digits."""
    period = 2.0 * math.pi / OMEGA
    for alpha, ratio, nlgeom in ((0.0, 0.0, ""), (-0.05, 0.05, ""), (-0.3, 0.05, ", NLGEOM")):
        error = []
        for count in (100, 200):
            job = Job("oscillator", balocco, "2" if count == 100 else "1", folder)
            job.run(oscillator([implicit(alpha, period / count, 0.8 * period)], 2.0 * ratio * OMEGA, nlgeom))
            time, u = job.history("node_2", "U")
            error.append(np.abs(u[:, 0] - ringing(time, ratio)).max() / (1e-2 / OMEGA))
            if alpha == 0.0:
                total = job.history("energy", "ETOTAL")[1]
                check("energy kept by the trapezoidal rule", np.abs(total - 0.5e-4).max() / 0.5e-4, 0.0, 1e-9)
        check("error at 200 increments a period, ALPHA=%g" % alpha, error[1], 0.0, 3e-3)
        check("order of the error, ALPHA=%g" % alpha, math.log2(error[0] / error[1]), 2.0, 0.03)


def procedures_in_turn(balocco, folder):
    """Explicit, implicit and explicit steps of a third of a period each: one motion, one energy."""
    third = 2.0 * math.pi / OMEGA / 3.0
    explicit = "*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n%.15g, %.15g\n*BULK VISCOSITY\n0., 0." % (third / 200, third)
    job = Job("in_turn", balocco, "1", folder)
    job.run(oscillator([explicit, implicit(0.0, third / 200, third), explicit], nlgeom=", NLGEOM"))
    for step in (1, 2, 3):
        time, u = job.history("node_2", "U", step)
        check("path in step %d" % step, np.abs(u[:, 0] - ringing(time)).max() / (1e-2 / OMEGA), 0.0, 1e-3)
        velocity = job.history("node_2", "V", step)[1][:, 0]
        check("velocity in step %d" % step, np.abs(velocity - 1e-2 * np.cos(OMEGA * time)).max() / 1e-2, 0.0, 1e-3)
        check("energy in step %d" % step, np.abs(job.history("energy", "ETOTAL", step)[1] - 0.5e-4).max() / 0.5e-4, 0.0, 1e-4)


def connectors(balocco, folder):
    """A body on a spring and damper of a connector, along its axis (CARTESIAN) and about it (ROTATION), with and without large motion."""
    kinds = {"CARTESIAN": ("2, 1, 1e-2", 1, "U"), "ROTATION": ("2, 4, 1e-2", 4, "UR")}
    ratio, period = 0.05, 2.0 * math.pi / OMEGA
    for kind, (velocity, dof, variable) in kinds.items():
        for ranks, nlgeom, procedure in (("1", "", implicit(0.0, period / 100, 0.8 * period)), ("2", ", NLGEOM", implicit(0.0, period / 100, 0.8 * period)),
                                         ("1", "", "*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n%.15g, %.15g" % (period / 400, 0.8 * period))):
            # Components along the ground's axes put no moment on the body, which needs no inertia to turn then.
            rotary = "*ELEMENT, TYPE=ROTARYI, ELSET=TURN\n2, 2\n*ROTARY INERTIA, ELSET=TURN\n1., 1., 1.\n" if variable == "UR" else ""
            held = "\n".join("2, %d" % k for k in range(1, 7 if rotary else 4) if k != dof)
            start = "" if variable == "UR" else "*INITIAL CONDITIONS, TYPE=VELOCITY\n%s\n" % velocity
            push = "*CLOAD\n2, 4, 10.\n" if variable == "UR" else ""  # from rest: turns about 10 / 1000
            job = Job("connector", balocco, ranks, folder)
            job.run("*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n*NSET, NSET=WATCHED\n2\n*ELEMENT, TYPE=MASS, ELSET=MASS\n1, 2\n*MASS, ELSET=MASS\n1.\n"
                    "%s*ELEMENT, TYPE=CONN3D2, ELSET=C\n3, 1, 2\n"
                    "*CONNECTOR SECTION, ELSET=C, BEHAVIOR=B\n%s\n*CONNECTOR BEHAVIOR, NAME=B\n*CONNECTOR ELASTICITY, COMPONENT=%d\n1000.\n"
                    "*CONNECTOR DAMPING, COMPONENT=%d\n%.15g\n*BOUNDARY\n1, 1, 6\n%s\n%s*STEP, INC=100000%s\n%s\n%s%s*END STEP\n"
                    % (rotary, kind, dof, dof, 2.0 * ratio * OMEGA, held, start, nlgeom, procedure, push,
                       HISTORY.replace("U, V", "%s, V" % variable)))
            time, moved = job.history("node_2", variable)
            if variable == "U":
                expected = ringing(time, ratio)
            else:
                damped = OMEGA * math.sqrt(1.0 - ratio * ratio)
                expected = 1e-2 * (1.0 - np.exp(-ratio * OMEGA * time) * (np.cos(damped * time) + ratio * OMEGA / damped * np.sin(damped * time)))
            check("%s on %s ranks" % (kind, ranks), np.abs(moved[:, 0] - expected).max() / np.abs(expected).max(), 0.0, 1e-2)


def impact(balocco, folder):
    """A block falls on the ground: no increment creates energy, finer ones lose less of it in the blow. Pressed by statics it stays at rest."""
    deck = block(2, 3, 2, (10.0, 10.0, 10.0), "C3D8", height=0.05, law="*ELASTIC\n1000., 0.3", density=1e-9)
    energies = "*OUTPUT, HISTORY, FREQUENCY=1\n*ENERGY OUTPUT\nALLKE, ETOTAL\n*END STEP\n"
    lost = []
    for ranks, increment in (("1", 2e-6), ("2", 1e-6)):
        job = Job("impact", balocco, ranks, folder)
        job.run(deck + "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 2, -2000.\n*STEP, NLGEOM, INC=100000\n*DYNAMIC, DIRECT\n%g, 1.6e-4\n" % increment + energies)
        total = job.history("energy", "ETOTAL")[1]
        check("no energy is created at %g" % increment, total.max() / total[0] - 1.0, 0.0, 1e-4)
        lost.append(1.0 - total[-1] / total[0])
        check("it bounces", float(job.history("energy", "ALLKE")[1][-1] > 0.4 * total[0]), 1.0, 0.0)
    check("finer increments lose less", float(lost[1] < lost[0]), 1.0, 0.0)

    job = Job("pressed", balocco, "1", folder)
    push = "*DLOAD\nCAP, P4, 2.\n"
    deck = deck.replace("*ELSET, ELSET=SOLE", "*ELSET, ELSET=CAP\n%s\n*ELSET, ELSET=SOLE" % ", ".join(str(1 + i + 2 * (2 + 3 * k)) for k in range(2) for i in range(2)))
    deck = deck.replace("*STEP", "", 1)
    motion = "*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*END STEP\n"
    job.run(deck + "*BOUNDARY\nLOW, 1\nLOW, 3\n*STEP, NLGEOM\n*STATIC\n*BOUNDARY\nTOP, 2, 2, -0.06\n" + motion
            + "*STEP, NLGEOM\n*STATIC\n*BOUNDARY, OP=NEW\n9000, 1, 6\nLOW, 1\nLOW, 3\n" + push + motion
            + "*STEP, NLGEOM\n*DYNAMIC, DIRECT\n1e-5, 2e-4\n" + motion)
    still = job.frame("U", -1, 2)
    check("a pressed block stays at rest", np.abs(job.frame("U", -1, 3) - still).max() / np.abs(still).max(), 0.0, 1e-6)


BAR = """*NODE
%s*NSET, NSET=WATCHED, GENERATE
1, 20
*ELEMENT, TYPE=C3D8, ELSET=BAR
%s*SOLID SECTION, ELSET=BAR, MATERIAL=RUBBER
*MATERIAL, NAME=RUBBER
*HYPERELASTIC, NEO HOOKE
5e5, 4e-7
*DENSITY
1000.
"""


THROWN = """*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
WATCHED, 5., 1., 2., 0.5
0.5, 0.05, 0.05, 0.5, 0.05, 1.05
"""


def bar():
    nodes, elements = "", ""
    for i in range(5):
        for k, (y, z) in enumerate(((0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1))):
            nodes += "%d, %.15g, %.15g, %.15g\n" % (4 * i + k + 1, 0.25 * i, y, z)
        if i < 4:
            elements += "%d, %s\n" % (i + 1, ", ".join(str(4 * i + k) for k in (1, 2, 3, 4, 5, 6, 7, 8)))
    return BAR % (nodes, elements)


def free_flight(balocco, folder):
    """A soft bar is thrown with a spin: its centre of mass flies straight, its spin keeps its moment of momentum, and what ALPHA=0
    changes of its energy is of second order."""
    job = Job("thrown", balocco, "2", folder)
    job.run(bar() + THROWN + """*STEP, NLGEOM, INC=1000
*DYNAMIC, DIRECT, ALPHA=0.
1e-2, 0.5
%s*END STEP
""" % HISTORY)
    mass = np.array([0.5 if node < 4 or node >= 16 else 1.0 for node in range(20)]) * 2.5 / 4.0
    reference = job.mesh("C3D8")[0]
    time = job.history("node_1", "U")[0]
    x = np.array([reference[n] + job.history("node_%d" % (n + 1), "U")[1] for n in range(20)])
    v = np.array([job.history("node_%d" % (n + 1), "V")[1] for n in range(20)])
    centre = np.einsum("n,nti->ti", mass, x) / mass.sum()
    way = centre - (centre[0] + np.outer(time, (1.0, 2.0, 0.5)))
    check("path of the centre", np.abs(way).max(), 0.0, 1e-8)
    spin = np.einsum("n,nti->ti", mass, np.cross(x - centre, v))
    check("moment of momentum", np.abs(spin - spin[0]).max() / np.abs(spin[0]).max(), 0.0, 2e-2)
    momentum = np.einsum("n,nti->ti", mass, v)
    check("momentum", np.abs(momentum - momentum[0]).max() / np.abs(momentum[0]).max(), 0.0, 1e-8)
    total = job.history("energy", "ETOTAL")[1]
    check("energy", np.abs(total - total[0]).max() / total[0], 0.0, 2e-2)


def moderate_dissipation(balocco, folder):
    """APPLICATION=MODERATE DISSIPATION is alpha = 1 - sqrt 2: the amplitude of a ringing mass decays as that of the recurrence."""
    alpha, h, steps = 1.0 - math.sqrt(2.0), 0.2 / OMEGA, 200
    beta, gamma = 0.25 * (1.0 - alpha) ** 2, 0.5 - alpha
    x, v, a, reference = 0.0, 1e-2, 0.0, [0.0]
    for _ in range(steps):
        ahead = x + h * v + h * h * (0.5 - beta) * a
        acceleration = -OMEGA**2 * ((1.0 + alpha) * ahead - alpha * x) / (1.0 + (1.0 + alpha) * beta * (h * OMEGA) ** 2)
        x, v, a = ahead + beta * h * h * acceleration, v + h * ((1.0 - gamma) * a + gamma * acceleration), acceleration
        reference.append(x)
    job = Job("moderate", balocco, "1", folder)
    job.run(oscillator(["*DYNAMIC, DIRECT, APPLICATION=MODERATE DISSIPATION\n%.15g, %.15g" % (h, h * steps)]))
    u = job.history("node_2", "U")[1][:, 0]
    check("ringing", np.abs(u - reference).max() / np.abs(reference).max(), 0.0, 1e-9)


def growing_increments(balocco, folder):
    """DIRECT=NO: increments grow by a half as long as the force changes by no more than DELTMX in one, and stay exact; damping
    given without modes is that of all."""
    alpha, rate, duration = 4.0, 5.0, 1.0
    job = Job("growing", balocco, "1", folder)
    swing = ("*MODAL DYNAMIC, DIRECT=NO, DELTMX=0.2\n1e-2, %g\n*MODAL DAMPING, RAYLEIGH\n, , %g, 0.\n"
             "*CLOAD, AMPLITUDE=RAMP\n2, 1, %g" % (duration, alpha, rate))
    job.run("*AMPLITUDE, NAME=RAMP\n0., 0., 1., 1.\n" + oscillator(["*FREQUENCY\n1", swing], speed=0.0))
    time, u = job.history("node_2", "U", 2)
    increments = np.diff(time)
    check("growth", increments[1] / increments[0], 1.5, 1e-9)
    check("longest increment", increments.max(), 0.2 / rate, 1e-9)
    decay, damped = 0.5 * alpha, math.sqrt(OMEGA**2 - 0.25 * alpha**2)
    # The answer to a ramp: rate / k (t - c / k) and what fades of it.
    lag = alpha / OMEGA**2
    fading = np.exp(-decay * time) * (lag * np.cos(damped * time) + (decay * lag - 1.0) / damped * np.sin(damped * time))
    check("response", np.abs(u[:, 0] - rate / 1000.0 * (time - lag + fading)).max(), 0.0, 1e-10)


def stopped_and_resumed(balocco, folder):
    """The rubber bar in flight by implicit dynamics, stopped after its first step: it goes on to the same bits, and on other numbers of
    ranks to the same motion but for the order of elimination."""
    step = "*STEP, NAME=%s, NLGEOM, INC=1000\n*DYNAMIC, DIRECT\n1e-2, 0.1\n" + HISTORY + "*END STEP\n"
    deck = bar() + THROWN + step % "FIRST" + step % "SECOND"
    whole = [Job("on_" + ranks, balocco, ranks, folder) for ranks in ("1", "2", "3")]
    for job in whole:
        job.run(deck)
    stopped = Job("stopped", balocco, "1", folder)
    stopped.run(deck, arguments=("--until", "FIRST"))
    stopped.run(deck, arguments=("--restart",))
    motion = lambda job: job.history("node_20", "U", 2)[1]
    check("bits after a restart", float(np.array_equal(motion(whole[0]), motion(stopped))), 1.0, 0.0)
    for job in whole[1:]:
        check("motion on %s ranks" % job.ranks, np.abs(motion(job) - motion(whole[0])).max() / np.abs(motion(whole[0])).max(), 0.0, 1e-8)


def body(steps, inertia, spin, extra=""):
    """A free rigid body of unit mass at its reference node, with a weightless plate to watch."""
    return """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
*NSET, NSET=WATCHED
1, 2
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 1
*MASS, ELSET=MASS
1.
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIA
2, 1
*ROTARY INERTIA, ELSET=INERTIA
%s
*RIGID BODY, REF NODE=1, TIE NSET=CARRIED
*NSET, NSET=CARRIED
2, 3
*NSET, NSET=ALL_OF_IT
1, 2, 3
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
ALL_OF_IT, %s
%s""" % (inertia, spin, extra) + "".join("*STEP, NLGEOM, INC=10000\n%s\n%s*END STEP\n" % (step, HISTORY.replace("U, V, A", "U, V, A, UR, VR")) for step in steps)


def spinning_body(balocco, folder):
    """A rigid body in free flight: a parabola, exactly; about a principal axis its angle, exactly; a symmetric top precesses about
    its moment of momentum at |H| / I1, with an error of second order."""
    gravity = "*DLOAD\n, GRAV, 9.81, 0., 0., -1.\n"
    job = Job("falling", balocco, "2", folder)
    job.run(body(["*DYNAMIC, DIRECT\n0.01, 1.\n" + gravity], "0.1, 0.1, 0.2", "3., 1., 0., 2.\n0., 0., 0., 0., 0., 1."))
    time, u = job.history("node_1", "U")
    check("parabola", np.abs(u - np.stack((time, 0 * time, 2.0 * time - 4.905 * time**2), 1)).max(), 0.0, 1e-9)
    carried = job.history("node_2", "U")[1] - u
    check("a carried point on its circle", np.abs(carried[:, 1] - np.sin(3.0 * time)).max(), 0.0, 1e-8)
    axis = np.array((3.0, 0.0, 4.0))  # angular velocity
    error = []
    for count in (100, 200):
        job = Job("top_%d" % count, balocco, "1", folder)
        step = "*DYNAMIC, DIRECT, ALPHA=0.\n%.15g, 1.\n" % (1.0 / count)
        job.run(body([step], "0.1, 0.1, 0.2", "5., 0., 0., 0.\n0., 0., 0., 0.6, 0., 0.8"))
        time, spin = job.history("node_1", "VR")
        momentum = np.array((0.1 * axis[0], 0.0, 0.2 * axis[2]))
        precession, about = np.linalg.norm(momentum) / 0.1, momentum / np.linalg.norm(momentum)
        angle = precession * time[:, None]
        exact = axis * np.cos(angle) + np.cross(about, axis) * np.sin(angle) + np.outer(1 - np.cos(angle[:, 0]), about * about.dot(axis))
        error.append(np.abs(spin - exact).max() / 5.0)
    check("precession at 200 increments", error[1], 0.0, 1e-2)
    check("order of its error", math.log2(error[0] / error[1]), 2.0, 0.1)


def lone_masses(balocco, folder):
    """Nodes that inertia alone holds move under a force, F t^2 / (2 m), and turn under a moment, M t^2 / (2 I)."""
    deck = """*NODE, NSET=N
1, 0., 0., 0.
2, 5., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 2
*MASS, ELSET=M
2.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 2
*ROTARY INERTIA, ELSET=I
3., 3., 3.
*STEP, NLGEOM
*DYNAMIC
0.1, 1.
*CLOAD
1, 1, 4.
2, 4, 1.5
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=N
U, UR
*END STEP
"""
    for ranks in "12":
        job = Job("lone_on_" + ranks, balocco, ranks, folder)
        job.run(deck)
        time, u = job.history("node_1", "U")
        check("way", np.abs(u[:, 0] - time**2).max(), 0.0, 1e-12)
        time, turn = job.history("node_2", "UR")
        check("turn", np.abs(turn[:, 0] - 0.25 * time**2).max(), 0.0, 1e-12)


def initial_no(balocco, folder):
    """INITIAL=NO: from rest the first acceleration is zero whatever the load, u1 = (1 + a) F / (M / (b dt^2) + (1 + a) K) with a F more of
    the load before; behind a dynamic step it goes on as if there had been no new step."""
    alpha, increment, force = -0.1, 0.02, 3.0
    beta = 0.25 * (1.0 - alpha) ** 2
    load = "*CLOAD\n2, 1, %g\n" % force
    for nlgeom in ("", ", NLGEOM"):
        for ranks in "12":
            job = Job("initial_no_on_" + ranks, balocco, ranks, folder)
            procedure = implicit(alpha, increment, increment).replace("DIRECT", "DIRECT, INITIAL=NO") + "\n" + load
            job.run(oscillator([procedure], nlgeom=nlgeom, speed=0.0))
            _, u = job.history("node_2", "U")
            check("first displacement", u[-1, 0], force / (1.0 / (beta * increment**2) + (1.0 + alpha) * 1000.0), 1e-9)
        whole, parted = (Job(name, balocco, "1", folder) for name in ("initial_whole", "initial_parted"))
        whole.run(oscillator([implicit(alpha, increment, 0.2) + "\n" + load], nlgeom=nlgeom))
        half = implicit(alpha, increment, 0.1)
        parted.run(oscillator([half + "\n" + load, half.replace("DIRECT", "DIRECT, INITIAL=NO")], nlgeom=nlgeom))
        for variable in ("U", "V", "A"):
            check(variable + " at the end", parted.history("node_2", variable, 2)[1][-1, 0], whole.history("node_2", variable)[1][-1, 0], 1e-10)


CASES = {case.__name__: case for case in (rate_of_error, procedures_in_turn, free_flight, spinning_body, moderate_dissipation,
                                            growing_increments, lone_masses, initial_no, stopped_and_resumed, connectors, impact)}

if __name__ == "__main__":
    CASES[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if failures else 0)
