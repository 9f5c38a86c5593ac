#!/usr/bin/env python3
"""Rigid meshes as contact masters, beside analytical surfaces of the same shape: rigid_mesh_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import check, run_case

OUTPUT = """*OUTPUT, FIELD, NUMBER INTERVAL=2, PRECISION=DOUBLE
*NODE OUTPUT
U, V, RF
*CONTACT OUTPUT
CPRESS, COPEN
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=REFERENCE
RF3
*ENERGY OUTPUT
ALLKE, ALLIE, ALLCW, ALLWK, ETOTAL
*END STEP
"""


def block(counts, size, low):
    """A rubber block with its upper face as surface TOP, its lower one as SOLE and its lower nodes as set FOOT."""
    nx, ny, nz = counts
    number = lambda i, j, k: 1 + i + (nx + 1) * (j + (ny + 1) * k)
    nodes, bricks, top, sole = [], [], [], []
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                x = [a + s * n / c for a, s, n, c in zip(low, size, (i, j, k), counts)]
                nodes.append("%d, %.12g, %.12g, %.12g" % (number(i, j, k), *x))
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                face = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                bricks.append("%d, %s" % (len(bricks) + 1, ", ".join(map(str, face + [n + (nx + 1) * (ny + 1) for n in face]))))
                if k == nz - 1:
                    top.append("%d, S2" % len(bricks))
                if k == 0:
                    sole.append("%d, S1" % len(bricks))
    foot = [str(number(i, j, 0)) for j in range(ny + 1) for i in range(nx + 1)]
    return "\n".join(["*NODE, NSET=BLOCK", *nodes, "*ELEMENT, TYPE=C3D8, ELSET=BLOCK", *bricks, "*SURFACE, NAME=TOP", *top,
                      "*SURFACE, NAME=SOLE", *sole, "*NSET, NSET=FOOT", *foot,
                      "*MATERIAL, NAME=RUBBER", "*DENSITY", "1e-9", "*HYPERELASTIC, NEO HOOKE", "0.5, 0.05",
                      "*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER", ""])


REFERENCE = 90000


def body(surface, extra=""):
    return f"""*NODE, NSET=REFERENCE
{REFERENCE}, 0, 0, 0
{surface}*SURFACE INTERACTION, NAME=DRY
*FRICTION
0.3
{extra}"""


def ball_mesh(radius, centre, n):
    """Facets of the lower half of a sphere by latitude and longitude, triangles at the pole."""
    nodes, facets = [], []
    point = lambda i, j: 50000 if i == 0 else 50000 + 1 + (i - 1) * 4 * n + j % (4 * n)
    for i in range(n + 1):
        for j in range(1 if i == 0 else 4 * n):
            a, b = 0.5 * math.pi * i / n, 0.5 * math.pi * j / n
            x = (radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b), centre - radius * math.cos(a))
            nodes.append("%d, %.12g, %.12g, %.12g" % (point(i, j), *x))
    triangles, quadrilaterals = [], []
    for j in range(4 * n):
        triangles.append("%d, %d, %d, %d" % (60000 + j, point(0, 0), point(1, j + 1), point(1, j)))
    for i in range(1, n):
        for j in range(4 * n):
            quadrilaterals.append("%d, %d, %d, %d, %d" % (60000 + 4 * n * i + j, point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)))
    return "\n".join(["*NODE", *nodes, "*ELEMENT, TYPE=R3D3, ELSET=BALL", *triangles, "*ELEMENT, TYPE=R3D4, ELSET=BALL", *quadrilaterals,
                      "*SURFACE, NAME=BALL", "BALL, SPOS", f"*RIGID BODY, REF NODE={REFERENCE}, ELSET=BALL", ""])


def ball_analytical(radius, centre):
    return f"""*SURFACE, TYPE=REVOLUTION, NAME=BALL
0, 0, 0, 0, 0, 1
START, {radius}, {centre}
CIRCL, 0, {centre - radius}, 0, {centre}
*RIGID BODY, REF NODE={REFERENCE}, ANALYTICAL SURFACE=BALL
"""


def pressed_by_a_ball(run):
    """A ball of radius 10 pressed 0.8 into a rubber block, statically and then moved on explicitly: facets of 4.5 degrees have a sag of
    0.008 and give the analytical ball's force within 3 %, its mean where nodes are hit one after the other."""
    force = {}
    for name, surface in (("analytical", ball_analytical(10.0, 10.0)), ("mesh", ball_mesh(10.0, 10.0, 20))):
        deck = (block((8, 8, 3), (8.0, 8.0, 3.0), (-4.0, -4.0, -3.0)) + body(surface) + f"""*CONTACT PAIR, INTERACTION=DRY
TOP, BALL
*BOUNDARY
FOOT, 1, 3
{REFERENCE}, 1, 2
{REFERENCE}, 4, 6
*STEP, NLGEOM
*STATIC
0.25, 1.
*BOUNDARY
{REFERENCE}, 3, 3, -0.8
{OUTPUT}*STEP
*DYNAMIC, EXPLICIT
, 2e-4
*BOUNDARY, TYPE=VELOCITY
{REFERENCE}, 3, 3, -500.
{OUTPUT}""")
        job = run(deck, 1)
        force[name] = [job.history(f"node_{REFERENCE}", "RF3", 1)[1][-1], job.history(f"node_{REFERENCE}", "RF3", 2)[1].mean()]
        start = job.history(f"node_{REFERENCE}", "RF3", 2)[1][0]
        check(f"{name}: force when the explicit step starts", start, force[name][0], 1e-6)
    check("static force of the mesh", force["mesh"][0], force["analytical"][0], 0.03)
    check("mean explicit force of the mesh", force["mesh"][1], force["analytical"][1], 0.03)


def sheet(at, z, counts=(6, 4)):
    """An open rectangle of R3D4, seen from above, about the origin."""
    nx, ny = counts
    number = lambda i, j: 50000 + i + (nx + 1) * j
    nodes = ["%d, %.12g, %.12g, %.12g" % (number(i, j), at[0] * (2.0 * i / nx - 1.0), at[1] * (2.0 * j / ny - 1.0), z)
             for j in range(ny + 1) for i in range(nx + 1)]
    facets = ["%d, %d, %d, %d, %d" % (60000 + i + nx * j, number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1))
              for j in range(ny) for i in range(nx)]
    return "\n".join(["*NODE", *nodes, "*ELEMENT, TYPE=R3D4, ELSET=GROUND", *facets, "*SURFACE, NAME=GROUND", "GROUND, SPOS",
                      f"*RIGID BODY, REF NODE={REFERENCE}, ELSET=GROUND", ""])


def plane(at, z):
    return f"""*SURFACE, TYPE=CYLINDER, NAME=GROUND
0, 0, {z}, 1, 0, {z}
0, 1, {z}
START, {-at[0]}, 0
LINE, {at[0]}, 0
*RIGID BODY, REF NODE={REFERENCE}, ANALYTICAL SURFACE=GROUND
"""


def dropped(surface, speed=(300.0, 0.0, -500.0), duration=4e-3):
    return (block((3, 3, 2), (3.0, 3.0, 2.0), (-1.4, -1.6, 0.05)) + body(surface) + f"""*CONTACT PAIR, INTERACTION=DRY
SOLE, GROUND
*BOUNDARY
{REFERENCE}, 1, 6
*INITIAL CONDITIONS, TYPE=VELOCITY
BLOCK, 1, {speed[0]}
BLOCK, 2, {speed[1]}
BLOCK, 3, {speed[2]}
*STEP
*DYNAMIC, EXPLICIT
, {duration}
{OUTPUT}""")


def dropped_on_a_sheet(run):
    """On flat ground a mesh and an analytical plane are the same surface; the mesh gives the same bits on any number of ranks."""
    jobs = [run(dropped(plane((9.0, 6.0), 0.0)), 1)] + [run(dropped(sheet((9.0, 6.0), 0.0)), ranks) for ranks in (1, 2)]
    reaction = [job.history(f"node_{REFERENCE}", "RF3")[1] for job in jobs]
    check("there is contact", float(np.abs(reaction[0]).max() > 0.0), 1.0, 0.0)
    check("reaction beside the analytical plane", np.abs(reaction[1] - reaction[0]).max() / np.abs(reaction[0]).max(), 0.0, 1e-6)
    check("one rank and two find the same bits", float(np.array_equal(reaction[1], reaction[2])), 1.0, 0.0)


def rolling_off(run):
    """Beyond the edge of an open mesh there is no body: a block that slides past it falls on with the velocity that it has left."""
    job = run(dropped(sheet((2.0, 6.0), 0.0), speed=(2000.0, 0.0, -100.0), duration=8e-3), 2)
    force = np.abs(job.history(f"node_{REFERENCE}", "RF3")[1])
    check("it has touched", float(force.max() > 0.0), 1.0, 0.0)
    check("no force in the end", force[-1], 0.0, 0.0)
    rows = job.frame("U", -1)[:48]
    check("all of it is past the edge", float(rows[:, 0].min() > 3.5), 1.0, 0.0)


if __name__ == "__main__":
    run_case(globals())
