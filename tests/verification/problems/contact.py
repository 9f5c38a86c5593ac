"""Contact with known answers."""
import math

import numpy as np
from meshes import block, elastic
from verification import problem

PLANE = """*NODE, NSET=FLOOR
90001, 0., 0., 0.
*SURFACE, NAME=FLOOR, TYPE=CYLINDER
0., 0., 0., 1., 0., 0.
0., 1., 0.
START, -100., 0.
LINE, 100., 0.
*RIGID BODY, ANALYTICAL SURFACE=FLOOR, REF NODE=90001
*SURFACE INTERACTION, NAME=SMOOTH
*CONTACT PAIR, INTERACTION=SMOOTH
SKIN, FLOOR"""


@problem("HERTZ-SPH", "sphere R 50, E 2e4, nu 0.3, pressed 2 against a rigid plane: half of two equal spheres; a quarter", "Hertz; Code_Aster ssnv104",
         {"radius of contact": (10.0, 0.1), "p0": (2798.3, 0.1), "force, kN": (586.1, 0.1)}, {kind: (8, 16) for kind in ("C3D8", "C3D8R")},
         lambda n: "%d x %d x %d" % (n, n, n))
def sphere(session, kind, n):
    """A hemisphere without its rim; fine at the pole. The radius of contact follows from the area of the nodes that touch."""
    widest = 0.9

    def place(r, s, t):
        a, b = r**1.7, s**1.7
        x, y = a * math.sqrt(1.0 - 0.5 * b * b), b * math.sqrt(1.0 - 0.5 * a * a)
        distance = math.hypot(x, y)
        turned = 0.5 * math.pi * widest * distance
        out = np.array([x, y]) / distance if distance > 0.0 else np.zeros(2)
        low = np.array([*(50.0 * math.sin(turned) * out), 50.0 * (1.0 - math.cos(turned))])
        high = np.array([*(50.0 * math.sin(0.5 * math.pi * widest) * distance * out), 50.0])
        return tuple(low + t**1.7 * (high - low))

    mesh = block(kind, (n, n, n), place)
    mesh.section(1.0, elastic(2e4, 0.3))
    mesh.add("*ELSET, ELSET=SKIN, GENERATE\n1, %d\n*SURFACE, NAME=SKIN, TYPE=ELEMENT\nSKIN, S1\n" % (n * n) + PLANE)
    mesh.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1., 1e-4, 0.25\n*BOUNDARY\n90001, 1, 6")
    mesh.add(mesh.hold(mesh.at(r=0.0), (1,)) + mesh.hold(mesh.at(s=0.0), (2,)))
    mesh.add("".join("%d, 3, 3, -2.\n" % m for m in mesh.at(t=1.0)))
    mesh.add("*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*CONTACT OUTPUT\nCPRESS\n*OUTPUT, HISTORY\n*CONTACT OUTPUT\nCAREA\n*END STEP")
    results = session.run("sphere_%s_%d" % (kind, n), mesh)
    area, pressure = contact_area_and_pressure(results)
    return {"radius of contact": math.sqrt(4.0 * area / math.pi), "p0": pressure, "force, kN": 4.0 * abs(results.at(90001, "RF")[2]) / 1e3}


def contact_area_and_pressure(results):
    """Area that touches at the end, and the largest pressure."""
    step = results.file["step_1"]
    areas, pressures = [], []

    def visit(name, item):
        if name.endswith("CAREA"):
            areas.append(item[-1])
        if name.endswith("CPRESS"):
            pressures.append((name, np.max(item[:])))

    step.visititems(visit)
    last = max(pressures, key=lambda found: int(found[0].split("frame_")[1].split("/")[0]))
    return float(np.ravel(areas[0])[-1]), float(last[1])
