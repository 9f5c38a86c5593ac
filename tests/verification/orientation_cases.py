#!/usr/bin/env python3
"""Directions and thicknesses of single elements through the whole program: orientation_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import check, run_case

MATERIAL = """*MATERIAL, NAME=M
*ELASTIC, TYPE=ENGINEERING CONSTANTS
100., 10., 5., 0.3, 0.2, 0.1, 4., 3.,
2.
*DENSITY
1e-3
"""
STEPS = """*STEP, NLGEOM
*STATIC
1., 1.
*BOUNDARY
ROOT, 1, 3
*CLOAD
TIP, 2, 1e-5
TIP, 3, 1e-5
*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U
*END STEP
*STEP
*DYNAMIC, EXPLICIT
, 0.05
*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U
*END STEP
"""


def strip(kind, count):
    """A strip of elements along x; shells and membranes are its lower side."""
    solid = kind == "C3D8R"
    nodes, elements = [], []
    number = lambda i, j, k: 1 + i + (count + 1) * (j + 2 * k)
    for k in range(2 if solid else 1):
        for j in range(2):
            nodes += [f"{number(i, j, k)}, {float(i)!r}, {j + 0.1 * i!r}, {float(k)!r}" for i in range(count + 1)]
    for i in range(count):
        lower = [number(i, 0, 0), number(i + 1, 0, 0), number(i + 1, 1, 0), number(i, 1, 0)]
        upper = [number(i, 0, 1), number(i + 1, 0, 1), number(i + 1, 1, 1), number(i, 1, 1)] if solid else []
        elements.append(f"{i + 1}, " + ", ".join(map(str, lower + upper)))
    ends = {name: [number(i, j, k) for j in range(2) for k in range(2 if solid else 1)] for name, i in (("ROOT", 0), ("TIP", count))}
    text = "*NODE\n" + "\n".join(nodes) + f"\n*ELEMENT, TYPE={kind}, ELSET=ALL\n" + "\n".join(elements) + "\n" + MATERIAL
    return text + "".join(f"*NSET, NSET={name}\n{', '.join(map(str, ids))}\n" for name, ids in ends.items())


def directions_of_elements(run):
    """A strip whose elements each have an orientation and a section of their own does the same where one distribution, or the
    elements' own nodes, give the directions."""
    count = 5
    sections = {"C3D8R": ("*SOLID SECTION", ""), "S4R": ("*SHELL SECTION", "0.2\n"), "M3D4R": ("*MEMBRANE SECTION", "0.2\n")}
    for kind, (section, data) in sections.items():
        steps = STEPS.replace("ROOT, 1, 3\n", "ROOT, 1, 6\n") if kind == "S4R" else STEPS
        if kind == "M3D4R":  # in its plane
            steps = steps.replace("ROOT, 1, 3\n", "ROOT, 1, 3\nEVERY, 3, 3\n").replace("TIP, 3, 1e-5\n", "")
        mesh = strip(kind, count) + f"*NSET, NSET=EVERY, GENERATE\n1, {2 * count + 2}\n"
        axes = [f"{math.cos(0.3 * i)!r}, {math.sin(0.3 * i)!r}, 0., {-math.sin(0.3 * i)!r}, {math.cos(0.3 * i)!r}, 0." for i in range(count)]
        rows = "".join(f"{i + 1}, {axes[i]}\n" for i in range(1, count))
        given = f"*DISTRIBUTION TABLE, NAME=T\nCOORD3D, COORD3D\n*DISTRIBUTION, NAME=D, LOCATION=ELEMENT, TABLE=T\n, {axes[0]}\n{rows}"
        one = f"{section}, ELSET=ALL, MATERIAL=M, ORIENTATION=O\n{data}*ORIENTATION, NAME=O"
        each = "".join(f"*ELSET, ELSET=E{i}\n{i + 1}\n*ORIENTATION, NAME=O{i}\n{axes[i]}\n3, 20.\n"
                       f"{section}, ELSET=E{i}, MATERIAL=M, ORIENTATION=O{i}\n{data}" for i in range(count))
        offset = 0.1 / math.sqrt(1.01)  # of the first edge, which is (1, 0.1, 0) long
        along = f"{1.0 / math.sqrt(1.01)!r}, {offset!r}, 0., 0., 1., 0."
        pairs = [(each, one + "\nD\n3, 20.\n" + given), (one + f"\n{along}\n3, 20.\n", one + ", DEFINITION=OFFSET TO NODES\n2, 4\n3, 20.\n"),
                 (one + f"\n{along}\n3, 20.\n", one + ", DEFINITION=NODES\n2, 7, 1\n3, 20.\n")]
        references = {text: run(mesh + text + steps, 1) for text in dict.fromkeys(reference for reference, _ in pairs)}
        for number, (reference, other) in enumerate(pairs):
            ours, theirs = references[reference], run(mesh + other + steps, 2)
            for step in (1, 2):
                u, v = (job.frame("U", -1, step) for job in (ours, theirs))
                check(f"{kind}, {number}: it moves in step {step}", float(np.abs(u).max() > 1e-5), 1.0, 0.0)
                check(f"{kind}, {number}: step {step}", np.abs(u - v).max(), 0.0, 1e-6 * np.abs(u).max())


def thickness_of_elements(run):
    """A strip of sheets whose thickness a distribution gives does what it does where each has a section of its own."""
    count = 5
    steps = STEPS.replace("ROOT, 1, 3\n", "ROOT, 1, 6\n")
    thickness = [0.1 * 1.5**i for i in range(count)]
    for options, data in (("MATERIAL=M, OFFSET=SPOS", "{}, 5\n"), ("COMPOSITE", "{}, 3, M, 20.\n{}, 3, M, -50.\n")):
        parts = lambda whole: data.format(*(share * whole for share in ((1.0,) if data.count("{}") == 1 else (0.25, 0.75))))
        each = "".join(f"*ELSET, ELSET=E{i}\n{i + 1}\n*SHELL SECTION, ELSET=E{i}, {options}\n{parts(thickness[i])}" for i in range(count))
        given = "*DISTRIBUTION TABLE, NAME=T\nLENGTH\n*DISTRIBUTION, NAME=D, LOCATION=ELEMENT, TABLE=T\n" + \
            "".join(f"{i + 1}, {thickness[i]!r}\n" for i in range(count)) + f"*SHELL SECTION, ELSET=ALL, {options}, SHELL THICKNESS=D\n{parts(1.0)}"
        expected = run(strip("S4R", count) + each + steps, 1)
        found = run(strip("S4R", count) + given + steps, 2)
        for step, words in ((1, "statics"), (2, "explicit")):
            u, other = expected.frame("U", -1, step), found.frame("U", -1, step)
            check(f"{options}, {words}", np.abs(u - other).max() / np.abs(u).max(), 0.0, 1e-9)


def coupling_in_cylindrical_axes(run):
    """A ring whose outer face is coupled to a node on its axis along radii and tangents, each node in axes of its own: it turns by the
    node's angle, and a pressure inside does not widen it."""
    count, angle, pressure = 24, 0.3, 5.0
    number = lambda i, j, k: 1 + i + 3 * (j + count * k)
    place = lambda i, j, k: ((1.0 + 0.5 * i) * math.cos(2 * math.pi * j / count), (1.0 + 0.5 * i) * math.sin(2 * math.pi * j / count), float(k))
    ids = [(i, j, k) for k in range(2) for j in range(count) for i in range(3)]
    text = "*NODE, NSET=RING\n" + "".join("%d, %.15g, %.15g, %g\n" % (number(*n), *place(*n)) for n in ids) + "*NODE, NSET=AXLE\n9001, 0., 0., 0.\n"
    bricks = [[number(i + a, (j + b) % count, c) for c in range(2) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))] for j in range(count) for i in range(2)]
    text += "*ELEMENT, TYPE=C3D8, ELSET=ALL\n" + "".join("%d, %s\n" % (e + 1, ", ".join(map(str, brick))) for e, brick in enumerate(bricks))
    text += "*ELSET, ELSET=INNER, GENERATE\n1, %d, 2\n*ELSET, ELSET=OUTER, GENERATE\n2, %d, 2\n" % (2 * count - 1, 2 * count)
    text += """*SURFACE, NAME=INSIDE
INNER, S6
*SURFACE, NAME=OUTSIDE
OUTER, S4
*MATERIAL, NAME=M
*ELASTIC
1000., 0.3
*SOLID SECTION, ELSET=ALL, MATERIAL=M
*ORIENTATION, NAME=ROUND, SYSTEM=CYLINDRICAL
0., 0., 0., 0., 0., 1.
*COUPLING, REF NODE=9001, SURFACE=OUTSIDE, CONSTRAINT NAME=C, ORIENTATION=ROUND
*KINEMATIC
1, 2
*STEP, NLGEOM
*STATIC
0.25, 1.
*BOUNDARY
RING, 3, 3
9001, 1, 5
9001, 6, 6, %g
*DSLOAD
INSIDE, P, %g
*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U
*END STEP
""" % (angle, pressure)
    for ranks in (1, 2):
        moved = run(text, ranks).frame("U", -1)[:len(ids)]
        at = np.array([place(*n) for n in ids]) + moved
        outer, inner = [np.array([n[0] == i for n in ids]) for i in (2, 0)]
        turned = np.array([place(*n) for n in ids]) @ np.array([[math.cos(angle), math.sin(angle), 0], [-math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
        check("the outer face turns with its node", np.abs(at - turned)[outer].max(), 0.0, 1e-9)
        check("the inner one widens", float((np.hypot(at[:, 0], at[:, 1])[inner] > 1.0 + 1e-3).all()), 1.0, 0.0)


def section_turns_with_its_part(run):
    """A cantilever of a part whose instance is turned by 90 degrees about its axis, or about another: n1 of its section turns along, also
    where none is given. w = F L^3 / 3 E I and what shear adds."""
    tip = {}
    for name, direction, turn, load in (("as it is", "0., 1., 0.", "0., 0., 1., 0., 0., 0.", 3), ("about its axis", "0., 1., 0.", "0., 0., 0., 1., 0., 0., 90.", 2),
                                        ("about z", "0., 1., 0.", "0., 0., 0., 0., 0., 1., 90.", 3), ("default", "", "0., 0., 0., 0., 1., 0., 90.", 2),
                                        ("default as it is", "", "", 2)):
        text = "*PART, NAME=P\n*NODE\n" + "".join("%d, %g, 0., 0.\n" % (i + 1, 0.1 * i) for i in range(11)) + "*ELEMENT, TYPE=B31, ELSET=E\n"
        text += "".join("%d, %d, %d\n" % (i, i, i + 1) for i in range(1, 11)) + "*BEAM SECTION, SECTION=RECT, ELSET=E, MATERIAL=M\n0.02, 0.03\n"
        text += (direction + "\n" if direction else "") + "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n"
        text += ("0., 0., 0.\n" + turn + "\n" if len(turn.split()) == 7 else "") + """*END INSTANCE
*NSET, NSET=ROOT, INSTANCE=I
1
*NSET, NSET=TIP, INSTANCE=I
11
*END ASSEMBLY
*MATERIAL, NAME=M
*ELASTIC
2e11, 0.3
*STEP
*STATIC
*BOUNDARY
ROOT, 1, 6
*CLOAD
TIP, %d, 10.
*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U
*END STEP
""" % load
        tip[name] = np.abs(run(text, 1).frame("U", -1)[-1]).max()
    across = 10.0 / (3.0 * 2e11 * 0.02 * 0.03 ** 3 / 12.0)  # bent about n1, by a force along n2
    for name in ("as it is", "about its axis", "about z"):
        check("deflection, turned " + name, tip[name], across, 5e-3)
    check("deflection by the default direction", tip["default"], tip["default as it is"], 1e-9)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (directions_of_elements, thickness_of_elements, coupling_in_cylindrical_axes,
                                                    section_turns_with_its_part)})
