#!/usr/bin/env python3
"""Tractions on faces, and on the edges of sheets: traction_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from follower_cases import elastica
from job import check, check_energy, run_case

FIELD = """*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF, UR
*ELEMENT OUTPUT
S
"""


def strip(kind, along, across, length, width, thickness, material, skew=0.0):
    """A flat sheet from the origin in x and y, nodes numbered along x first; edges E2 of the elements LAST are its end, the surface FREE."""
    deck = ["*NODE, NSET=ALL"]
    number = lambda i, j: 1 + i + (along + 1) * j
    for j in range(across + 1):
        for i in range(along + 1):
            x, y = length * i / along, width * j / across
            inside = 0 < i < along and 0 < j < across
            deck.append(f"{number(i, j)}, {x + (skew * math.sin(3.0 * i + j) if inside else 0.0)!r}, {y!r}, 0.")
    deck.append(f"*ELEMENT, TYPE={kind}, ELSET=SHEET")
    ends, element = [], 0
    for j in range(across):
        for i in range(along):
            a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            for nodes in ((a, b, c), (a, c, d)) if kind.startswith("S3") else ((a, b, c, d),):
                element += 1
                deck.append(f"{element}, " + ", ".join(map(str, nodes)))
                if b in nodes and c in nodes and i == along - 1:
                    ends.append(element)
    deck.append("*ELSET, ELSET=LAST\n" + "\n".join(map(str, ends)))
    deck.append("*NSET, NSET=ROOT\n" + "\n".join(str(number(0, j)) for j in range(across + 1)))
    deck.append(f"*SURFACE, NAME=FREE\nLAST, E2\n{material}*SHELL SECTION, ELSET=SHEET, MATERIAL=M\n{thickness!r}, 5")
    return "\n".join(deck) + "\n"


def bent_strip(run):
    """A transverse traction on the end of a cantilever stays at right angles to it: the elastica, for quadrilaterals by surface and
    triangles by element."""
    length, width, thickness, young = 10.0, 1.0, 0.1, 1.2e6
    bending = young * width * thickness**3 / 12.0
    material = f"*MATERIAL, NAME=M\n*ELASTIC\n{young!r}, 0.\n"
    for kind, ranks in (("S4R", 1), ("S4R", 2), ("S3R", 1)):
        deck = strip(kind, 40, 2, length, width, thickness, material) + "*BOUNDARY\nROOT, 1, 6\n"
        loads = (1.0, 3.0)
        for load in loads:
            traction = -load * bending / length**2 / width
            line = f"*DSLOAD\nFREE, EDTRA, {traction!r}\n" if kind == "S4R" else f"*DLOAD\nLAST, EDTRA2, {traction!r}\n"
            deck += f"*STEP, NLGEOM, INC=100\n*STATIC\n0.25, 1., 1e-5, 0.25\n{line}{FIELD}*END STEP\n"
        job = run(deck, ranks)
        for step, load in enumerate(loads, 1):
            u = job.frame("U", -1, step)[40] / length
            x, y, angle = elastica(load)
            check(f"shortening of {kind} under {load}", u[0], x, 4e-3)
            check(f"deflection of {kind} under {load}", u[2], y, 2e-3)
            check(f"turn of {kind} under {load}", -job.frame("UR", -1, step)[40][1], angle, 2e-3)


def pulled_and_sheared(run):
    """Edge tractions are forces by length: uniform stress in an uneven mesh."""
    material = "*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n"
    hold = "*BOUNDARY\nALL, 3\n1, 1, 2\n"
    thickness = 0.5
    for kind in ("S4R", "S4"):
        deck = strip(kind, 4, 3, 4.0, 2.0, thickness, material, skew=0.15) + hold + f"""*SURFACE, NAME=RIM_1
BELOW, E1
*SURFACE, NAME=RIM_3
ABOVE, E3
*SURFACE, NAME=RIM_4
FIRST, E4
*STEP
*STATIC
*BOUNDARY
ROOT, 1
*DSLOAD
FREE, EDNOR, -6.
{FIELD}*END STEP
*STEP
*STATIC
*BOUNDARY, OP=NEW
ALL, 3
1, 1, 2
5, 2
*DSLOAD, OP=NEW
FREE, EDSHR, 4.
RIM_1, EDSHR, -4.
RIM_3, EDSHR, -4.
RIM_4, EDSHR, 4.
{FIELD}*END STEP
"""
        groups = "*ELSET, ELSET=BELOW\n1, 2, 3, 4\n*ELSET, ELSET=ABOVE\n9, 10, 11, 12\n*ELSET, ELSET=FIRST\n1, 5, 9\n"
        job = run(deck.replace("*SURFACE, NAME=FREE", groups + "*SURFACE, NAME=FREE"), 1)
        for step, component, stress in ((1, 0, 6.0 / thickness), (2, 3, 4.0 / thickness)):
            wanted = np.zeros(6)
            wanted[component] = stress
            got = job.element(kind, "S", -1, step)
            check(f"stress {component} of {kind}", np.abs(got - wanted[:got.shape[1]]).max() / stress, 0.0, 1e-9)


BLOCK = """*NODE, NSET=ALL
{nodes}*ELEMENT, TYPE=C3D8, ELSET=BLOCK
{elements}*SURFACE, NAME=TOP
BLOCK_TOP, S2
*MATERIAL, NAME=M
*HYPERELASTIC, NEO HOOKE
0.5, 0.05
*SOLID SECTION, ELSET=BLOCK, MATERIAL=M
*BOUNDARY
BASE, 1, 3
"""


def block():
    number = lambda i, j, k: 1 + i + 3 * (j + 3 * k)
    nodes = "".join(f"{number(i, j, k)}, {i * 1.0}, {j * 1.0}, {k * 0.5}\n" for k in range(3) for j in range(3) for i in range(3))
    rows, top = [], []
    for k in range(2):
        for j in range(2):
            for i in range(2):
                low = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                rows.append(f"{len(rows) + 1}, " + ", ".join(map(str, low + [n + 9 for n in low])))
                if k == 1:
                    top.append(len(rows))
    return BLOCK.format(nodes=nodes, elements="\n".join(rows) + "\n*ELSET, ELSET=BLOCK_TOP\n" + ", ".join(map(str, top))
                        + "\n*NSET, NSET=BASE, GENERATE\n1, 9\n")


def as_pressure(run):
    """A traction against the normal that turns with its surface is a pressure; the block stretches and bulges."""
    deck = block() + "*STEP, NLGEOM\n*STATIC\n0.25, 1.\n{load}" + FIELD + "*END STEP\n"
    answers = [run(deck.format(load=load), ranks).frame("U", -1) for load, ranks in
               (("*DSLOAD\nTOP, P, -1.\n", 1), ("*DSLOAD\nTOP, TRVEC, 1., 0., 0., 0.5\n", 2),
                ("*DLOAD\nBLOCK_TOP, TRVEC2, 1., 0., 0., 2.\n", 1))]
    check("the block stretches", float(np.abs(answers[0]).max() > 0.2), 1.0, 0.0)
    for answer in answers[1:]:
        check("traction as pressure", np.abs(answer - answers[0]).max(), 0.0, 1e-7)


def turned_block(run):
    """A block turned by a quarter about its normal takes its tractions with it, or not; the base feels their resultant. Area 4."""
    loads = {"TRVEC, 1e-4, 1., 0., 0.": (True, (0.0, 4e-4, 0.0)), "TRSHR, 1e-4, 1., 0., 3.": (True, (0.0, 4e-4, 0.0)),
             "TRVEC, 1e-4, 1., 0., 1.": (False, (4e-4 / math.sqrt(2.0), 0.0, 4e-4 / math.sqrt(2.0)))}
    for load, (follows, force) in loads.items():
        parameter = "" if follows else ", FOLLOWER=NO, CONSTANT RESULTANT=YES"
        deck = block() + f"""*RIGID BODY, REF NODE=100, TIE NSET=BASE
*STEP, NLGEOM
*STATIC
0.1, 1.
*BOUNDARY
100, 1, 5
100, 6, 6, {math.pi / 2!r}
*DSLOAD{parameter}
TOP, {load}
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=REF
RF
*END STEP
"""
        deck = deck.replace("*ELEMENT", "100, 1., 1., 0.\n*NSET, NSET=REF\n100\n*ELEMENT", 1).replace("*BOUNDARY\nBASE, 1, 3\n", "", 1)
        reaction = run(deck, 1).history("node_100", "RF")[1][-1]
        for axis in range(3):
            check(f"force {axis} of {load.split(',')[0]}", -reaction[axis], force[axis], 2e-3 if force[axis] else 1e-6)


def thrown_sheet(run):
    """A free sheet under an edge traction of fixed direction: its momentum is the force times time, the work is what it moves and strains
    with, and ranks do not matter."""
    material = "*MATERIAL, NAME=M\n*DENSITY\n1e-3\n*ELASTIC\n200., 0.3\n"
    deck = strip("S4R", 6, 4, 3.0, 2.0, 0.1, material) + """*STEP
*DYNAMIC, EXPLICIT
, 0.2
*DSLOAD, FOLLOWER=NO, CONSTANT RESULTANT=YES
FREE, EDLD, 5e-4, 0., 3., 4.
*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U, V
*OUTPUT, HISTORY, TIME INTERVAL=0.02
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*END STEP
"""
    velocities = []
    for ranks in (1, 2):
        job = run(deck, ranks)
        v = job.frame("V", -1)
        share = np.array([(0.5 if i in (0, 6) else 1.0) * (0.5 if j in (0, 4) else 1.0) for j in range(5) for i in range(7)]) / 24.0
        mean = share @ v
        impulse, mass = 5e-4 * 2.0 * 0.2, 1e-3 * 3.0 * 2.0 * 0.1
        for axis, part in ((1, 0.6), (2, 0.8)):
            check(f"speed {axis}", mean[axis], part * impulse / mass, 1e-9)
        check_energy(job, 1e-4)
        velocities.append(v)
    check("ranks", np.abs(velocities[1] - velocities[0]).max(), 0.0, 0.0)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (bent_strip, pulled_and_sheared, as_pressure, turned_block, thrown_sheet)})
