#!/usr/bin/env python3
"""Initial stress and hardening, elements taken out of the model, springs of rotations: element_state_cases.py CASE BALOCCO FOLDER."""
import math
import tempfile

import numpy as np

from job import UNIT_CUBE, check, run_case
from static_model import brick

FIELD = """*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF, UR
*ELEMENT OUTPUT
S
"""

CUBE = UNIT_CUBE + """*NSET, NSET=FRONT
1, 2, 5, 6
*NSET, NSET=BOTTOM
1, 2, 3, 4
*ELEMENT, TYPE={kind}, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=M
*DENSITY
1e-3
*ELASTIC
1000., 0.25
{plastic}*SOLID SECTION, ELSET=CUBE, MATERIAL=M
*BOUNDARY
LEFT, 1
FRONT, 2
BOTTOM, 3
"""


def stress_of(job, kind, step, frame=-1):
    import h5py
    with h5py.File(job.folder / f"{job.name}.h5") as file:
        frames = sorted((k for k in file[f"step_{step}"] if k.startswith("frame_")), key=lambda k: int(k[6:]))
        return np.array(file[f"step_{step}/{frames[frame]}/element/{kind}/S"])[0]


def initial_stress(run):
    """Held between its ends an initial stress stays; let go it relaxes: E e (1 + e ...) balances it. Statics hands it on to the explicit
    step without a jump."""
    for kind in ("C3D8R", "C3D8"):
        deck = CUBE.format(kind=kind, plastic="") + f"""*INITIAL CONDITIONS, TYPE=STRESS
CUBE, 5., 0., 0.
*STEP, NLGEOM
*STATIC
1., 1.
*BOUNDARY
RIGHT, 1, 1, 0.
{FIELD}*END STEP
*STEP
*DYNAMIC, EXPLICIT
, 1e-3
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLKE
{FIELD}*END STEP
*STEP, NLGEOM
*STATIC
1., 1.
*BOUNDARY, OP=NEW
LEFT, 1
FRONT, 2
BOTTOM, 3
{FIELD}*END STEP
"""
        job = run(deck, 1)
        # Sideways it is free and contracts nothing: the stress is there without a strain.
        check(f"{kind}: stress between held ends", stress_of(job, kind, 1)[0], 5.0, 1e-9)
        check(f"{kind}: reaction of the right end", job.frame("RF", -1, 1)[[1, 2, 5, 6], 0].sum(), 5.0, 1e-9)
        check(f"{kind}: nothing starts to move", np.abs(job.history("energy", "ALLKE", 2)[1]).max(), 0.0, 1e-15)
        check(f"{kind}: stress when it is let go", stress_of(job, kind, 3)[0], 0.0, 1e-9)
        # St. Venant-Kirchhoff: E (Green strain) = -5.
        strain = -5.0 / 1000.0
        check(f"{kind}: displacement then", job.frame("U", -1, 3)[1, 0], math.sqrt(1.0 + 2.0 * strain) - 1.0, 1e-9)


def linear_initial_stress(run):
    """Linear steps count an initial stress as a force alone, as the theory of first order has it: they give what the same force on the
    body without stress gives. Modes about a state with NLGEOM have its stress stiffness: a mass between two taut bars."""
    square = """*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
*NSET, NSET=LEFT
1, 4
*NSET, NSET=RIGHT
2, 3
*BOUNDARY
ALL, 3
"""
    bodies = {"C3D8R": UNIT_CUBE + "*ELEMENT, TYPE=C3D8R, ELSET=BODY\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*SOLID SECTION, ELSET=BODY, MATERIAL=M\n",
              "C3D8": UNIT_CUBE + "*ELEMENT, TYPE=C3D8, ELSET=BODY\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*SOLID SECTION, ELSET=BODY, MATERIAL=M\n",
              "M3D4": square + "*ELEMENT, TYPE=M3D4, ELSET=BODY\n1, 1, 2, 3, 4\n*MEMBRANE SECTION, ELSET=BODY, MATERIAL=M\n1.\n",
              "T3D2": """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, -1, 0
*NSET, NSET=LEFT
1, 3
*NSET, NSET=RIGHT
2
*BOUNDARY
2, 3
*ELEMENT, TYPE=T3D2, ELSET=BODY
1, 1, 2
*ELEMENT, TYPE=T3D2, ELSET=OTHER
2, 3, 2
*SOLID SECTION, ELSET=BODY, MATERIAL=M
1.
*SOLID SECTION, ELSET=OTHER, MATERIAL=M
1.
"""}
    procedures = {"static": "*STATIC\n1., 1.\n", "dynamic": "*DYNAMIC, DIRECT, ALPHA=0.\n1e-4, 2e-3\n"}
    for kind, body in bodies.items():
        nodes = {"C3D8R": 4, "C3D8": 4, "M3D4": 2, "T3D2": 1}[kind]
        for name, procedure in procedures.items():
            jobs = []
            for stress, push, ranks in ((100.0, 0.0, 2), (0.0, -100.0 / nodes, 1)):
                initial = f"*INITIAL CONDITIONS, TYPE=STRESS\nBODY, {stress}\n" if stress else ""
                jobs.append(run(body + f"""*BOUNDARY
LEFT, 1, 3
*MATERIAL, NAME=M
*DENSITY
1e-3
*ELASTIC
1000., 0.25
{initial}*STEP
{procedure}*CLOAD
RIGHT, 2, {50.0 / nodes}
RIGHT, 1, {push}
{FIELD}*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLIE, ETOTAL
*END STEP
""", ranks))
            stressed, pushed = jobs
            largest = np.abs(pushed.frame("U", -1)).max()
            check(f"{kind}, {name}: displacements", np.abs(stressed.frame("U", -1) - pushed.frame("U", -1)).max() / largest, 0.0, 1e-9)
            check(f"{kind}, {name}: stress", (stress_of(stressed, kind, 1) - stress_of(pushed, kind, 1))[0], 100.0, 1e-8)
            check(f"{kind}, {name}: reaction", (stressed.frame("RF", -1) - pushed.frame("RF", -1))[0, 0], -100.0 / nodes, 1e-8)
            if name == "static":
                scale = stressed.history("energy", "ALLIE")[1][-1]
                check(f"{kind}: energy less work", stressed.history("energy", "ETOTAL")[1][-1] / scale, 0.0, 1e-8)
    job = run("""*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
*ELEMENT, TYPE=T3D2, ELSET=BARS
1, 1, 2
2, 2, 3
*ELEMENT, TYPE=MASS, ELSET=MASS
3, 2
*MASS, ELSET=MASS
1.
*MATERIAL, NAME=M
*DENSITY
1e-12
*ELASTIC
1000., 0.25
*SOLID SECTION, ELSET=BARS, MATERIAL=M
1.
*INITIAL CONDITIONS, TYPE=STRESS
BARS, 5.
*BOUNDARY
1, 1, 3
3, 1, 3
*STEP, NLGEOM
*STATIC
1., 1.
*END STEP
*STEP, PERTURBATION
*FREQUENCY
1
*END STEP
""", 1)
    import h5py
    with h5py.File(job.folder / f"{job.name}.h5") as file:
        found = file["step_2/mode_1"].attrs["frequency"]
    check("frequency of a mass between taut bars", found, math.sqrt(2.0 * 5.0) / (2.0 * math.pi), 1e-9)


def initial_hardening(run):
    """A bar that has hardened by 0.1 yields at the stress that its table has there."""
    plastic = "*PLASTIC\n10., 0.\n20., 0.2\n"
    deck = CUBE.format(kind="C3D8", plastic=plastic) + f"""*INITIAL CONDITIONS, TYPE=HARDENING
CUBE, 0.1
*STEP, NLGEOM
*STATIC
0.05, 1.
*BOUNDARY
RIGHT, 1, 1, 0.02
{FIELD}*END STEP
"""
    job = run(deck, 1)
    # Kirchhoff stress 15 + 50 e_p with e_p = log(1.02) - stress / E; the Cauchy stress is that over J, of elastic strains alone.
    kirchhoff = (15.0 + 50.0 * math.log(1.02)) / (1.0 + 50.0 / 1000.0)
    check("stress past yield", stress_of(job, "C3D8", 1)[0], kirchhoff * math.exp(-0.5 * kirchhoff / 1000.0), 1e-6)


def taken_out(run):
    """Two springs side by side under a load: one taken out, the other takes all of it; taken up again WITH STRAIN, both share. The explicit
    step that follows without the second shows the reaction of one alone."""
    deck = f"""*NODE
1, 0, 0, 0
2, 1, 0, 0
*ELEMENT, TYPE=MASS, ELSET=MASS
9, 2
*MASS, ELSET=MASS
1.
*ELEMENT, TYPE=SPRINGA, ELSET=FIRST
1, 1, 2
*ELEMENT, TYPE=SPRINGA, ELSET=SECOND
2, 1, 2
*ELSET, ELSET=SPRINGS
FIRST, SECOND
*SPRING, ELSET=SPRINGS

100.
*BOUNDARY
1, 1, 3
2, 2, 3
*STEP, NLGEOM
*STATIC
1., 1.
*CLOAD
2, 1, 10.
{FIELD}*END STEP
*STEP, NLGEOM
*STATIC
0.25, 1.
*MODEL CHANGE, TYPE=ELEMENT, REMOVE
SECOND
{FIELD}*END STEP
*STEP
*DYNAMIC, EXPLICIT
, 0.1
{FIELD}*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLKE, ALLSE
*END STEP
*STEP, NLGEOM
*STATIC
0.25, 1.
*MODEL CHANGE, TYPE=ELEMENT, ADD=WITH STRAIN
2
{FIELD}*END STEP
"""
    job = run(deck, 2)
    for step, extension in ((1, 0.05), (2, 0.1), (3, 0.1), (4, 0.05)):
        check(f"extension in step {step}", job.frame("U", -1, step)[1, 0], extension, 1e-9)
        check(f"reaction in step {step}", job.frame("RF", -1, step)[0, 0], -10.0, 1e-9)
    check("nothing moves in the explicit step", np.abs(job.history("energy", "ALLKE", 3)[1]).max(), 0.0, 1e-15)
    check("energy of the one that is left", job.history("energy", "ALLSE", 3)[1][-1], 0.5, 1e-9)


def torsion(run):
    """A spring of rotations holds a rotary inertia: angle in statics, period and bound of the increment in an explicit step."""
    stiffness, inertia = 40.0, 0.1
    model = f"""*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 2
*MASS, ELSET=MASS
1.
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIA
2, 2
*ROTARY INERTIA, ELSET=INERTIA
{inertia}, {inertia}, {inertia}
*ELEMENT, TYPE=SPRING1, ELSET=TORSION
3, 2
*SPRING, ELSET=TORSION
4
{stiffness}
*BOUNDARY
2, 1, 3
2, 5, 6
"""
    omega = math.sqrt(stiffness / inertia)
    load = "*CLOAD\n2, 4, 5.\n"
    job = run(model + f"*STEP, NLGEOM\n*STATIC\n1., 1.\n{load}{FIELD}*END STEP\n", 1)
    check("angle in statics", job.frame("UR", -1)[1, 0], 5.0 / stiffness, 1e-9)
    history = "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=TURNING\nUR1\n*END STEP\n"
    model = model.replace("*BOUNDARY", "*NSET, NSET=TURNING\n2\n*BOUNDARY")
    increment = 0.02 / omega
    job = run(model + f"*STEP\n*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n{increment}, {10.0 / omega}\n{load}{history}", 2)
    time, angle = job.history("node_2", "UR1")
    exact = 5.0 / stiffness * (1.0 - np.cos(omega * time))
    check("largest error of the motion", np.abs(angle - exact).max() / np.abs(exact).max(), 0.0, 1e-3)
    job = run(model + f"*STEP\n*DYNAMIC, EXPLICIT, ENERGY ERROR=1e9\n, {1000.0 / omega}\n{load}{history}", 1)
    time = job.history("node_2", "UR1")[0]
    check("automatic increment", time[3] - time[2], 0.9 * 2.0 / omega, 1e-9)



def rates_in_statics(run):
    """A static step yields as at rate zero, and says so; without a rate in the material nothing is said."""
    for rate in ("*RATE DEPENDENT\n40., 5.\n", ""):
        deck = CUBE.format(kind="C3D8", plastic="*PLASTIC\n2., 0.\n" + rate)
        job = run(deck + "*STEP, NLGEOM\n*STATIC\n1e-4, 1e-3\n*BOUNDARY\n2, 1, 1, 0.01\n3, 1, 1, 0.01\n6, 1, 1, 0.01\n7, 1, 1, 0.01\n" + FIELD + "*END STEP\n", 1)
        check("stress", stress_of(job, "C3D8", 1)[0], 2.0, 1e-2)
        check("note", job.log().count("material M yields as at rate zero"), 1 if rate else 0, 0.0)


def plastic_bending(run):
    """Beams of bricks bent to seven times the curvature at first yield: M = sigma b h^2 / 4 (1 - 1 / (3 * 49)). Exact for one layer, whose
    hourglass stresses alone carry it; a tenth of what they may carry is left beside a centre that flows."""
    young, stress, first = 210000.0, 300.0, 2.0 * 300.0 / 210000.0  # curvature at first yield, h = 1
    exact = 0.25 * stress * (1.0 - 1.0 / 147.0)
    for layers, tolerance in ((1, 0.02), (2, 0.07), (3, 0.04), (4, 0.04)):
        for procedure, amplitude in (("*STATIC\n0.025, 1., 1e-6, 0.025", ""), ("*DYNAMIC, EXPLICIT\n, 1e-4", ", AMPLITUDE=RISE")):
            deck = brick((1, layers, 1), (1.0, 1.0, 1.0), "C3D8R", lambda x, y, z: (x, y - 0.5, z - 0.5))
            ends = {side: deck.where(lambda x, y, z: x == side) for side in (0.0, 1.0)}
            deck.sets["FIXED"] = ends[0.0]
            low = deck.where(lambda x, y, z: abs(y + 0.5) < 1e-9 and x == 0.0)
            deck.add(f"*MATERIAL, NAME=M\n*ELASTIC\n{young}, 0.3\n*DENSITY\n7.8e-9\n*PLASTIC\n{stress}, 0.\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n"
                     f"*AMPLITUDE, NAME=RISE, DEFINITION=SMOOTH STEP\n0., 0., 1e-4, 1.\n*STEP, NLGEOM\n{procedure}\n*BOUNDARY\nFIXED, 1\n"
                     + "".join(f"{n}, 2\n" for n in low) + f"{low[0]}, 3\n{deck.node_at((1.0, -0.5, -0.5))}, 3\n*BOUNDARY{amplitude}\n"
                     + "".join(f"{n}, 1, 1, {-7.0 * first * deck.nodes[n][1]!r}\n" for n in ends[1.0]) + FIELD + "*END STEP\n")
            with tempfile.NamedTemporaryFile("r", suffix=".inp") as file:
                deck.write(file.name)
                force = dict(zip(deck.nodes, run(file.read(), 1).frame("RF", -1)))
            moment = -sum(force[n][0] * deck.nodes[n][1] for n in ends[1.0])
            check(f"moment of {layers} layers, {'explicit' if amplitude else 'static'}", moment, exact, tolerance)


def plastic_cantilever(run):
    """A short thick beam loaded beyond its plastic moment, by a force: statics must find the way through the yield of whole layers. Beside
    plain bricks (C3D8) on the same mesh."""
    def deflection(kind, counts, ranks):
        deck = brick(counts, (1.5, 1.0, 1.0), kind)
        deck.sets["ROOT"] = deck.where(lambda x, y, z: x == 0.0)
        tip = deck.where(lambda x, y, z: x == 1.5)
        share = lambda n: 3e3 / (counts[1] * counts[2]) / 2 ** sum(deck.nodes[n][k] in (0.0, 1.0) for k in (1, 2))
        deck.add("*MATERIAL, NAME=M\n*ELASTIC\n1e6, 0.25\n*PLASTIC\n1e4, 0.\n3e4, 1.\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*STEP, NLGEOM, INC=100\n"
                 "*STATIC\n0.05, 1., , 0.05\n*BOUNDARY\nROOT, 1, 3\n*CLOAD\n" + "".join(f"{n}, 3, {share(n)!r}\n" for n in tip) + FIELD + "*END STEP\n")
        with tempfile.NamedTemporaryFile("r", suffix=".inp") as file:
            deck.write(file.name)
            moved = dict(zip(deck.nodes, run(file.read(), ranks).frame("U", -1)))
        return max(moved[n][2] for n in tip)
    for counts, all_ranks, tolerance in (((6, 2, 2), (1, 2), 0.2), ((12, 4, 4), (1,), 0.01)):
        plain = deflection("C3D8", counts, 1)
        for ranks in all_ranks:
            check(f"deflection of {counts} on {ranks} ranks", deflection("C3D8R", counts, ranks), plain, tolerance)


if __name__ == "__main__":
    run_case(globals())
