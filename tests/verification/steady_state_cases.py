#!/usr/bin/env python3
"""Harmonic responses against closed forms, sums of modes and statics: steady_state_cases.py CASE BALOCCO FOLDER."""
import math
import pathlib
import re
import sys

import h5py
import numpy as np

from job import Job, check, failures
from modal_cases import cantilever

STIFFNESS, MASS = 1000.0, 2.0
NATURAL = math.sqrt(STIFFNESS / MASS) / (2.0 * math.pi)
LINEAR = "*STEADY STATE DYNAMICS, INTERVAL=RANGE, FREQUENCY SCALE=LINEAR\n"
NO_FRAMES = "*OUTPUT, FIELD, FREQUENCY=0\n"
TOLD = "*OUTPUT, HISTORY\n*NODE OUTPUT, NSET=%s\n%s\n"


def oscillator(steps, dashpot=0.0, elements=""):
    """A mass on a spring along x, whose one end is held; `steps` are those behind *FREQUENCY, from step 2 on."""
    damper = "*ELEMENT, TYPE=DASHPOTA, ELSET=DAMPER\n3, 1, 2\n*DASHPOT, ELSET=DAMPER\n\n%.15g\n" % dashpot if dashpot else ""
    return """*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 2
*MASS, ELSET=MASS
%.15g
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
2, 1, 2
*SPRING, ELSET=SPRING

%.15g
%s%s*AMPLITUDE, NAME=GROWING
0., 1., 100., 2.
*BOUNDARY
1, 1, 3
2, 2, 3
*STEP
*FREQUENCY
1
*END STEP
%s""" % (MASS, STIFFNESS, damper, elements, "".join("*STEP\n%s*END STEP\n" % step for step in steps))


def told(job, node, variable, step=2):
    """Frequencies and the complex history of a node."""
    with h5py.File(job.folder / (job.name + ".h5")) as file:
        rows = file["step_%d/history/node_%d" % (step, node)]
        return rows["frequency"][:], rows[variable + "_REAL"][:] + 1j * rows[variable + "_IMAG"][:]


def worst(found, wanted):
    return np.abs(found - wanted).max() / np.abs(wanted).max()


def forced(balocco, folder):
    """A complex force on a mass, spring and damper: F / (k (1 + i s) - w^2 m + i w c), the damper being a dashpot, a fraction of critical
    damping, Rayleigh's, or structural; its velocity, acceleration and reaction, and an amplitude over the frequency."""
    critical, force = 2.0 * math.sqrt(STIFFNESS * MASS), 3.0 - 2.0j
    loads = "*CLOAD, AMPLITUDE=GROWING\n2, 1, 3.\n*CLOAD, LOAD CASE=2, AMPLITUDE=GROWING\n2, 1, -2.\n"
    variants = {"dashpot": ("", 0.1 * critical, 0.0), "fraction": ("*MODAL DAMPING\n1, 1, 0.02\n", 0.02 * critical, 0.0),
                "Rayleigh": ("*MODAL DAMPING, RAYLEIGH\n1, 1, 0.5, 1e-3\n", 0.5 * MASS + 1e-3 * STIFFNESS, 0.0),
                "structural": ("*MODAL DAMPING, STRUCTURAL\n1, 1, 0.05\n", 0.0, 0.05)}
    for number, (ranks, dashpot, names) in enumerate((("1", 0.1 * critical, ["dashpot"]), ("2", 0.1 * critical, ["dashpot"]),
                                                      ("1", 0.0, ["fraction", "Rayleigh", "structural"]))):
        job = Job("forced_%d" % number, balocco, ranks, folder)
        job.run(oscillator([LINEAR + "0.5, 10., 40\n" + variants[name][0] + loads + NO_FRAMES + TOLD % ("ALL", "U, V, A, RF") for name in names],
                           dashpot))
        for step, name in enumerate(names, 2):
            c, s = variants[name][1:]
            f, u = told(job, 2, "U", step)
            w = 2.0 * math.pi * f
            check("frequencies", np.abs(f - np.linspace(0.5, 10.0, 40)).max(), 0.0, 1e-12)
            response = force * (1.0 + f / 100.0) / (STIFFNESS * (1.0 + 1j * s) - w**2 * MASS + 1j * w * c)
            check("displacement, %s, %s ranks" % (name, ranks), worst(u[:, 0], response), 0.0, 1e-10)
            check("velocity", worst(told(job, 2, "V", step)[1][:, 0], 1j * w * response), 0.0, 1e-10)
            check("acceleration", worst(told(job, 2, "A", step)[1][:, 0], -w**2 * response), 0.0, 1e-10)
            check("reaction", worst(told(job, 1, "RF", step)[1][:, 0], -(STIFFNESS + 1j * w * dashpot) * response), 0.0, 1e-10)


def shaken(balocco, folder):
    """The base of the oscillator moves by a given displacement, velocity or acceleration: relative response m w^2 ub / (k - w^2 m + i w c)."""
    c, kinds = 5.0, ("DISPLACEMENT", "VELOCITY", "ACCELERATION")
    steps = [LINEAR + "0.5, 10., 30\n*BASE MOTION, DOF=1, SCALE=0.3, AMPLITUDE=GROWING, TYPE=%s\n*BASE MOTION, DOF=1, SCALE=0.1, IMAGINARY, TYPE=%s\n"
             % (kind, kind) + NO_FRAMES + TOLD % ("ALL", "U, TU, TV, TA1, RF") for kind in kinds]
    for ranks in "12":
        job = Job("shaken_on_" + ranks, balocco, ranks, folder)
        job.run(oscillator(steps, c))
        for power, kind in enumerate(kinds):
            history = lambda node, variable: told(job, node, variable, 2 + power)
            f, u = history(2, "U")
            w = 2.0 * math.pi * f
            moved = (0.3 * (1.0 + f / 100.0) + 0.1j) / (1j * w) ** power
            relative = MASS * w**2 * moved / (STIFFNESS - w**2 * MASS + 1j * w * c)
            check("relative displacement, " + kind, worst(u[:, 0], relative), 0.0, 1e-10)
            check("total displacement", worst(history(2, "TU")[1][:, 0], relative + moved), 0.0, 1e-10)
            check("total velocity", worst(history(2, "TV")[1][:, 0], 1j * w * (relative + moved)), 0.0, 1e-10)
            check("total acceleration", worst(history(2, "TA1")[1], -w**2 * (relative + moved)), 0.0, 1e-10)
            check("the base itself", worst(history(1, "TU")[1][:, 0], moved), 0.0, 1e-10)
            check("reaction of the base", worst(history(1, "RF")[1][:, 0], -(STIFFNESS + 1j * w * c) * relative), 0.0, 1e-10)


def turned(balocco, folder):
    """The base turns about an axis 2 away from the mass, which is free across it: it is moved by twice the angle."""
    deck = oscillator([LINEAR + "0.5, 6., 20\n*MODAL DAMPING\n1, 1, 0.1\n*BASE MOTION, DOF=6, SCALE=0.01, TYPE=DISPLACEMENT\n-1., 0., 0.\n"
                       + NO_FRAMES + TOLD % ("ALL", "U, TU")])
    deck = deck.replace("TYPE=SPRINGA", "TYPE=SPRING2").replace("*SPRING, ELSET=SPRING\n\n", "*SPRING, ELSET=SPRING\n2, 2\n")
    job = Job("turned", balocco, "2", folder)
    job.run(deck.replace("2, 2, 3\n*STEP", "2, 1\n2, 3\n*STEP"))
    f, u = told(job, 2, "U")
    w = 2.0 * math.pi * f
    relative = MASS * w**2 * 0.02 / (STIFFNESS - w**2 * MASS + 1j * w * 0.2 * math.sqrt(STIFFNESS * MASS))
    check("across the arm", worst(u[:, 1], relative), 0.0, 1e-10)
    check("in total", worst(told(job, 2, "TU")[1][:, 1], relative + 0.02), 0.0, 1e-10)


def coupled(balocco, folder):
    """Two masses in a row, a dashpot between them and one to the ground, a structural part of the stiffness, held by springs: modes that dampers
    couple, against K (1 + i s) - w^2 M + i w C solved whole."""
    deck = """*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 2
2, 3
*MASS, ELSET=MASS
2.
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
3, 1, 2
4, 2, 3
*SPRING, ELSET=SPRING

1000.
*ELEMENT, TYPE=DASHPOTA, ELSET=BETWEEN
5, 2, 3
*DASHPOT, ELSET=BETWEEN

9.
*ELEMENT, TYPE=DASHPOT1, ELSET=GROUND
6, 3
*DASHPOT, ELSET=GROUND
1
4.
*BOUNDARY
1, 1, 3
2, 2, 3
3, 2, 3
*STEP
*FREQUENCY
2
*END STEP
*STEP
*STEADY STATE DYNAMICS
1., 8., 7
*MODAL DAMPING, STRUCTURAL
1, 2, 0.03
*CLOAD
2, 1, 1.
*CLOAD, IMAGINARY
3, 1, 2.
""" + NO_FRAMES + TOLD % ("ALL", "U1, RF1") + "*END STEP\n"
    stiffness, mass = 1000.0 * np.array([[2.0, -1.0], [-1.0, 1.0]]), 2.0 * np.eye(2)
    damping = np.array([[9.0, -9.0], [-9.0, 13.0]])
    for ranks in "12":
        job = Job("coupled_on_" + ranks, balocco, ranks, folder)
        job.run(deck)
        f, first = told(job, 2, "U1")
        wanted = np.array([np.linalg.solve(stiffness * (1.0 + 0.03j) - w**2 * mass + 1j * w * damping, np.array([1.0, 2j]))
                           for w in 2.0 * math.pi * f])
        check("first mass", worst(first, wanted[:, 0]), 0.0, 1e-10)
        check("second mass", worst(told(job, 3, "U1")[1], wanted[:, 1]), 0.0, 1e-10)
        check("reaction", worst(told(job, 1, "RF1")[1], -1000.0 * wanted[:, 0]), 0.0, 1e-10)


def preloaded(balocco, folder):
    """About a bent state: with all modes and far below the lowest the response of a static perturbation, stresses and reactions too."""
    load, output = "*CLOAD\nTIP, 3, 1e-3\n", "*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*ELEMENT OUTPUT\nS\n"
    deck = cantilever("", ["*STATIC\n0.25, 1.\n*CLOAD\nTIP, 3, 40.", "*STATIC\n" + load + output, "*FREQUENCY\n72",
                           "*STEADY STATE DYNAMICS\n1e-5\n" + load + output])
    deck = deck.replace("*STEP, INC=1000\n*STATIC\n0.25, 1.", "*STEP, NLGEOM\n*STATIC\n0.25, 1.")
    deck = deck.replace("*STEP, INC=1000\n*STATIC\n*CLOAD", "*STEP, PERTURBATION\n*STATIC\n*CLOAD")
    job = Job("preloaded", balocco, "2", folder)
    job.run(deck)
    check("the tip is bent", float(job.frame("U", -1, 1)[6, 2] > 1.0), 1.0, 0.0)
    for variable in ("U", "RF"):
        check(variable, worst(job.frame(variable + "_REAL", 0, 4), job.frame(variable, -1, 2)), 0.0, 1e-6)
    check("S", worst(job.element("C3D8I", "S_REAL", 0, 4), job.element("C3D8I", "S", -1, 2)), 0.0, 1e-6)


def biased(first, last, points, bias, to, back):
    y = np.linspace(-1.0, 1.0, points)
    middle, half = 0.5 * (to(first) + to(last)), 0.5 * (to(last) - to(first))
    return back(middle + half * np.sign(y) * np.abs(y) ** (1.0 / bias))


def frequencies(balocco, folder):
    """Points crowd about the eigenfrequency: of linear and of logarithmic scale, several ranges, a factor, one frequency alone."""
    damped, force = "*MODAL DAMPING\n1, 1, 0.02\n", "*CLOAD\n2, 1, 1.\n"
    same = lambda x: x
    log = lambda first, last, points, bias=3.0: biased(first, last, points, bias, np.log, np.exp)
    linear = lambda first, last, points, bias=3.0: biased(first, last, points, bias, same, same)
    default = np.concatenate([log(1.0, NATURAL, 20), log(NATURAL, 8.0, 20)[1:]])
    scaled = 1.02 * np.concatenate([linear(1.0, NATURAL, 5), linear(NATURAL, 8.0, 5)[1:]])[1:-1]
    kinds = [("*STEADY STATE DYNAMICS\n1., 8.\n", default),
             ("*STEADY STATE DYNAMICS, FREQUENCY SCALE=LINEAR\n1., 8., 6, 2.\n", np.concatenate([linear(1.0, NATURAL, 6, 2.0), linear(NATURAL, 8.0, 6, 2.0)[1:]])),
             ("*STEADY STATE DYNAMICS, INTERVAL=RANGE\n1., 2., 4\n2., 8., 5, 3.\n9.\n",
              np.concatenate([log(1.0, 2.0, 4, 1.0), log(2.0, 8.0, 5)[1:], [9.0]])),
             ("*STEADY STATE DYNAMICS, FREQUENCY SCALE=LINEAR\n1., 8., 5, 3., 1.02\n", np.concatenate([[1.0], scaled[scaled < 8.0], [8.0]]))]
    job = Job("frequencies", balocco, "1", folder)
    job.run(oscillator([text + damped + force + TOLD % ("ALL", "U1") for text, _ in kinds]))
    for step, (_, wanted) in enumerate(kinds, 2):
        f, u = told(job, 2, "U1", step)
        check("number of frequencies", len(f), len(wanted), 0.0)
        check("frequencies", np.abs(f / wanted - 1.0).max(), 0.0, 1e-12)
        with h5py.File(job.folder / (job.name + ".h5")) as file:
            frames = [file["step_%d/frame_%d" % (step, i)] for i in range(len(f))]
            check("frames", max(abs(frame.attrs["frequency"] / f[i] - 1.0) for i, frame in enumerate(frames)), 0.0, 1e-15)
            seen = np.array([frame["node/U_REAL"][1, 0] + 1j * frame["node/U_IMAG"][1, 0] for frame in frames])
        check("frames in single precision", worst(seen, u), 0.0, 1e-6)
        described = (job.folder / ("%s.step_%d.xdmf" % (job.name, step))).read_text()
        check("frames that ParaView reads", described.count("<Time Value="), len(f), 0.0)


def bar(balocco, folder):
    """A cantilever of bricks with modal damping: the sum of its modes at a node, and far below its lowest mode, with all modes, the statics
    of the same loads, one a quarter of a cycle ahead: displacements, reactions and stresses, of both parts. Base motion acts as its inertia."""
    damping, load, pull = "*MODAL DAMPING\n1, 72, 0.03\n", "*CLOAD\nTIP, 3, 0.5\n", "*CLOAD, LOAD CASE=2\nTIP, 2, 0.2\n*DLOAD, IMAGINARY\nBODY, GRAV, 300., 1., 0., 0.\n"
    told_bar = "*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*ELEMENT OUTPUT\nS\n"
    harmonic = "*STEADY STATE DYNAMICS, INTERVAL=RANGE\n1e-5, 900., 12\n"
    jobs = []
    for ranks in "12":
        job = Job("bar_on_" + ranks, balocco, ranks, folder)
        job.run(cantilever("", ["*FREQUENCY\n72", harmonic + damping + load + pull + told_bar]))
        jobs.append(job)
    statics = Job("bar_at_rest", balocco, "1", folder)
    statics.run(cantilever("", ["*STATIC\n" + load + told_bar, "*STATIC\n" + load.replace("*CLOAD", "*CLOAD, OP=NEW") .replace("TIP, 3, 0.5", "TIP, 2, 0.2")
                                + "*DLOAD\nBODY, GRAV, 300., 1., 0., 0.\n" + told_bar]))
    with h5py.File(jobs[0].folder / "bar_on_1.h5") as file, h5py.File(jobs[1].folder / "bar_on_2.h5") as other:
        shapes = [file["step_1/mode_%d" % i] for i in range(1, 73)]
        tip = [6, 13, 20, 27]
        worst_sum = worst_pair = 0.0
        for i in range(12):
            frame = file["step_2/frame_%d" % i]
            f = frame.attrs["frequency"]
            # The share of gravity of a node is a body's mass of 6 * 125e-3 spread by eighths of each brick.
            weight = np.array([0.0156250 * (1 if n % 7 in (0, 6) else 2) for n in range(28)]) * 300.0
            total = 0.0
            for shape in shapes:
                u, mass, natural = shape["node/U"][:], shape.attrs["generalized_mass"], shape.attrs["frequency"]
                push = 0.5 * u[tip, 2].sum() + 1j * (0.2 * u[tip, 1].sum() + weight @ u[:, 0])
                total = total + u * push / mass / (4.0 * math.pi**2 * (natural**2 - f**2 + 0.06j * natural * f))
            found = frame["node/U_REAL"][:] + 1j * frame["node/U_IMAG"][:]
            worst_sum = max(worst_sum, worst(found, total))
            for name in ("U_REAL", "U_IMAG", "RF_REAL", "RF_IMAG"):
                a, b = frame["node/" + name][:], other["step_2/frame_%d/node/%s" % (i, name)][:]
                worst_pair = max(worst_pair, np.abs(a - b).max() / np.abs(a).max())
        check("sum of modes", worst_sum, 0.0, 1e-8)
        check("two ranks", worst_pair, 0.0, 1e-6)
        slow = file["step_2/frame_0"]
        for part, step in (("_REAL", 1), ("_IMAG", 2)):
            for variable in ("U", "RF"):
                check(variable + part + " of statics", worst(slow["node/" + variable + part][:], statics.frame(variable, -1, step)), 0.0, 1e-4)
            check("S" + part, worst(slow["element/C3D8I/S" + part][:], statics.element("C3D8I", "S", -1, step)), 0.0, 1e-4)


def printed(balocco, folder):
    """*NODE PRINT and *EL PRINT tell real parts first, as CalculiX does, with the frequency for the time; energies have no parts."""
    job = Job("printed", balocco, "1", folder)
    said = job.run(oscillator([LINEAR + "2.\n*MODAL DAMPING\n1, 1, 0.1\n*CLOAD, LOAD CASE=2\n2, 1, 7.\n*NODE PRINT, NSET=ALL\nU\n*OUTPUT, FIELD\n"
                              "*NODE OUTPUT\nU\n*OUTPUT, HISTORY\n*ENERGY OUTPUT\nALLKE\n"]))
    check("energies are told to be left out", "ALLKE have no real and imaginary part" in said, True, 0.0)
    lines = (job.folder / "printed.dat").read_text().split("S T E P       2")[1].splitlines()
    titles = [line for line in lines if "displacements" in line]
    values = [float(line.split()[1]) for line in lines if line.split()[:1] == ["2"]]
    w = 4.0 * math.pi
    wanted = 7j / (STIFFNESS - w**2 * MASS + 1j * w * 0.2 * math.sqrt(STIFFNESS * MASS))
    check("tables", len(titles), 2, 0.0)
    check("of the frequency", all("time  0.2000000E+01" in title for title in titles), True, 0.0)
    check("real part", values[0], wanted.real, 1e-6)
    check("imaginary part", values[1], wanted.imag, 1e-6)


def tables(path):
    """Title and numbers of each table of a set that a .dat has."""
    found = []
    for line in open(path):
        if " for set " in line:
            found.append((" ".join(line.split()), []))
        elif re.search("[A-Z] [A-Z] [A-Z]|[A-DF-Z]", line):
            found.append((None, []))  # something else, until the next table
        elif line.strip() and found:
            found[-1][1].append([float(word) for word in line.split()[1:]])
    return [(title, np.array(rows)) for title, rows in found if title]


def calculix(balocco, folder):
    """A cantilever under forces of two phases that grow with the frequency, with modal damping, and under a pressure, with Rayleigh's:
    displacements and stresses of both parts as CalculiX 2.20 printed them for ccx/harmonic.inp (ccx/harmonic.dat: its tables of sets)."""
    deck = pathlib.Path(__file__).parent / "ccx" / "harmonic.inp"
    theirs = tables(deck.with_suffix(".dat"))
    for ranks in "12":
        job = Job("harmonic_on_" + ranks, balocco, ranks, folder)
        job.run(deck.read_text())
        ours = tables(job.folder / (job.name + ".dat"))
        check("tables and their frequencies", [title for title, _ in ours] == [title for title, _ in theirs], True, 0.0)
        for what, tolerance in (("displacements", 1e-6), ("stresses", 1e-5)):
            pairs = [(mine, reference) for (_, mine), (title, reference) in zip(ours, theirs) if title.startswith(what)]
            check(what, max(worst(mine, reference) for mine, reference in pairs), 0.0, tolerance)


def weighed(balocco, folder):
    """An accelerated base is a gravity the other way: displacements and reactions of C3D20, whose mass is not at its nodes; and what steps
    tell that come behind a harmonic one does not know of it."""
    deck = (pathlib.Path(__file__).parent / "ccx" / "harmonic.inp").read_text()
    deck = deck[:deck.index("*STEP")]
    told_bar, damping = NO_FRAMES + TOLD % ("CLAMP", "RF") + "*NODE OUTPUT, NSET=TIP\nU\n", "*MODAL DAMPING\n1, 6, 0.04\n"
    bent = "*STEP, NLGEOM\n*STATIC\n0.5, 1.\n*CLOAD\nTIP, 3, 9.\n*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*END STEP\n"
    modes = "*STEP\n*FREQUENCY\n6\n*END STEP\n"
    sweep = "*STEP\n*STEADY STATE DYNAMICS, INTERVAL=RANGE\n300., 1500., 5\n" + damping
    further = bent.replace("0.5, 1.", "1., 1.").replace("TIP, 3, 9.", "TIP, 3, 7.")
    job = Job("weighed", balocco, "1", folder)
    job.run(deck + bent + modes + sweep + "*DLOAD\nBAR, GRAV, 3000., -0.6, 0., -0.8\n" + told_bar + "*END STEP\n" + sweep
            + "*BASE MOTION, DOF=1, SCALE=1800.\n*BASE MOTION, DOF=3, SCALE=2400.\n" + told_bar + "*END STEP\n" + further)
    nodes = [group for group in job.groups(3) if group.startswith("node_")]
    for variable in ("U", "RF"):
        pairs = []
        for node in nodes:
            with h5py.File(job.folder / "weighed.h5") as file:
                if variable + "_REAL" in file["step_3/history/" + node]:
                    pairs.append([told(job, int(node[5:]), variable, step)[1] for step in (3, 4)])
        pairs = np.array(pairs)
        check(variable, worst(pairs[:, 1], pairs[:, 0]), 0.0, 1e-9)
    alone = Job("unswept", balocco, "1", folder)
    alone.run(deck + bent + further)
    check("the step behind", worst(job.frame("U", -1, 5), alone.frame("U", -1, 2)), 0.0, 1e-9)


def unbounded(balocco, folder):
    """An undamped mode that is excited at its own frequency ends the run; one that nothing excites does not."""
    both = "*ELEMENT, TYPE=SPRING2, ELSET=ACROSS\n5, 1, 2\n*SPRING, ELSET=ACROSS\n2, 2\n4000.\n"
    deck = oscillator(["*STEADY STATE DYNAMICS\n1., 8., 5\n*CLOAD\n2, 1, 1.\n" + TOLD % ("ALL", "U1")], elements=both)
    said = Job("unbounded", balocco, "2", folder).run(deck, expected_status=3)
    check("told", "mode 1 of %.7g cycles/time is excited at its own frequency and not damped" % NATURAL in said, True, 0.0)
    idle = deck.replace("2, 2, 3\n*STEP", "2, 3\n*STEP").replace("*FREQUENCY\n1", "*FREQUENCY\n2").replace("1., 8., 5", "4., 8., 5")
    job = Job("idle", balocco, "1", folder)
    job.run(idle)
    f, u = told(job, 2, "U1")
    check("frequencies", len(f), 9, 0.0)
    moved = deck.replace("*STEP\n*STEADY", "*STEP, NLGEOM\n*STATIC\n1., 1.\n*CLOAD\n2, 1, 1.\n*END STEP\n*STEP\n*STEADY")
    assert moved != deck
    check("modes of another state", "has moved the state" in Job("moved", balocco, "1", folder).run(moved, expected_status=3), True, 0.0)
    check("beside the mode across", worst(u, 1.0 / (STIFFNESS - MASS * (2.0 * math.pi * f) ** 2)), 0.0, 1e-9)


if __name__ == "__main__":
    cases = (forced, shaken, turned, coupled, preloaded, frequencies, bar, printed, calculix, weighed, unbounded)
    {case.__name__: case for case in cases}[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if failures else 0)
