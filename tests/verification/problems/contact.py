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


@problem("HERTZ-SPH", "sphere R 50, E 2e4, nu 0.3, pressed 1/32 against a rigid plane: half of two equal spheres; a quarter",
         "Hertz; geometry of Code_Aster ssnv104", {"radius of contact": (1.25, 0.05), "p0": (349.79, 0.05), "force, kN": (1.14469, 0.05)},
         {kind: (8, 16) for kind in ("C3D8", "C3D8R")}, lambda n: "%d x %d x %d" % (n, n, n), {"C3D8R": 0.25})
def sphere(session, kind, n):
    """A hemisphere without its rim. CPRESS is force over the area at rest, which in the middle shrinks by (1 + nu) (1 - 2 nu) p / E;
    with that, and with strains that Hertz neglects, p0 comes out 6 % low on meshes of any fineness where p0 / E is 3.5 %: hence
    pressed to a half of that. (ssnv104 presses 2 deep: 14 %.)"""
    widest = 0.9
    even, growth = 0.04525, 10.9383285  # half of the elements lie evenly within 1.3 radii of the contact, the others grow to the rim

    def graded(v):
        return even * (v if v < 0.5 else 0.5 + math.expm1(growth * (v - 0.5)) / growth)

    def place(r, s, t):
        a, b = graded(r), graded(s)
        x, y = a * math.sqrt(1.0 - 0.5 * b * b), b * math.sqrt(1.0 - 0.5 * a * a)
        distance = math.hypot(x, y)
        turned = 0.5 * math.pi * widest * distance
        out = np.array([x, y]) / distance if distance > 0.0 else np.zeros(2)
        low = np.array([*(50.0 * math.sin(turned) * out), 50.0 * (1.0 - math.cos(turned))])
        high = np.array([*(50.0 * math.sin(0.5 * math.pi * widest) * distance * out), 50.0])
        return tuple(low + graded(t) * (high - low))

    mesh = block(kind, (n, n, n), place)
    mesh.section(1.0, elastic(2e4, 0.3))
    mesh.add("*ELSET, ELSET=SKIN, GENERATE\n1, %d\n*SURFACE, NAME=SKIN, TYPE=ELEMENT\nSKIN, S1\n" % (n * n) + PLANE)
    mesh.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.25, 1., 1e-4, 0.5\n*BOUNDARY\n90001, 1, 6")
    mesh.add(mesh.hold(mesh.at(r=0.0), (1,)) + mesh.hold(mesh.at(s=0.0), (2,)))
    mesh.add("".join("%d, 3, 3, -0.03125\n" % m for m in mesh.at(t=1.0)))
    mesh.add("*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*CONTACT OUTPUT\nCPRESS\n*END STEP")
    results = session.run("sphere_%s_%d" % (kind, n), mesh)
    radius, highest = hertz_fit(results)
    return {"radius of contact": radius, "p0": highest, "force, kN": 4.0 * abs(results.at(90001, "RF")[2]) / 1e3}


def hertz_fit(results):
    """a and p0 of p^2 = p0^2 (1 - r^2 / a^2) by least squares over the nodes of more than 0.3 of the largest pressure: a count of
    the nodes that touch would know the radius to an element only."""
    pressure = results.node("CPRESS")
    squares = np.sum((results.file["mesh/node/coordinates"][:] + results.node("U"))[:, :2] ** 2, axis=1)
    inside = pressure > 0.3 * pressure.max()
    slope, height = np.polyfit(squares[inside], pressure[inside] ** 2, 1)
    return math.sqrt(-height / slope), math.sqrt(height)
