"""Membranes, plates and shells: NAFEMS LE1 and LE5, Cook's panel, and the shell obstacle course."""
import math

import numpy as np
from meshes import FIELDS, SHELLS, SOLIDS, Mesh, angle, elastic, middle, recovered, sheet
from verification import problem

FLAT = ("C3D8", "C3D8R", "M3D4", "M3D4R", "S4", "S4R", "S3R")
CURVED = ("C3D8R", "S4", "S4R", "S3R")
THIN = "bricks of this slenderness need finer meshes: their faces' shear and membrane strains lock on a curved sheet"
GRADED = "D is where the stress is steepest, and an extrapolation from the middles of elements: first order; finer meshes reach it"
TRIANGLE = "a triangle of constant membrane strain: converges with order two, from the stiff side"


def flat(mesh):
    """Holds a plane-stress model in its plane: the middle surface of solids, the normal motion of membranes and shells."""
    if mesh.kind in SOLIDS:
        return mesh.hold(mesh.at(t=0.0), (3,))
    return mesh.hold(mesh.at(), (3, 4, 5))


def symmetry(mesh, nodes, axis):
    """The plane normal to `axis` is one of symmetry: no motion along it, no turning about the other two."""
    return mesh.hold(nodes, [axis] + [4 + a for a in range(3) if a != axis - 1])


@problem("LE1", "elliptic membrane, ellipses (2, 1) and (3.25, 2.75), outward pressure 10 MPa on the outer edge; a quarter",
         "NAFEMS LE1; Abaqus Benchmarks 4.2.1", {"sigma_yy at D, MPa": (92.7, 0.02)}, {kind: (16, 32) for kind in FLAT},
         lambda n: "%d x %d" % (n, n // 2), {"C3D8R": 0.06, "M3D4": 0.06}, {kind: GRADED for kind in FLAT})
def le1(session, kind, n):
    """r runs from C and D (angle 0) to B and A, s outwards; the stress is recovered from the middles of elements."""
    def place(r, s):
        a, b, turned = 2.0 + 1.25 * s, 1.0 + 1.75 * s, 0.5 * math.pi * r
        return a * math.cos(turned), b * math.sin(turned), 0.0

    mesh = sheet(kind, (n, n // 2), lambda r, s: place(1.0 - r, s), 0.1)
    mesh.section(0.1, elastic(210e9, 0.3))
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + flat(mesh) + symmetry(mesh, mesh.at(r=0.0), 1) + symmetry(mesh, mesh.at(r=1.0), 2))
    mesh.add("*CLOAD\n" + edge_pressure(mesh, 10e6 * 0.1))
    mesh.add(FIELDS + "*END STEP")
    results = session.run("le1_%s_%d" % (kind, n), mesh)
    stress = global_stress(mesh, results)
    return {"sigma_yy at D, MPa": recovered(mesh, stress[:, 1], 1.0, 0.0) / 1e6}


def edge_pressure(mesh, per_length):
    """Forces of an outward pressure on the edge s = 1, exact for straight element edges."""
    forces = {}
    rows = sorted({round(p[0], 9) for p in mesh.parameters.values()})
    for low, high in zip(rows[:-1], rows[1:]):
        ends = [mesh.at(r=v, s=1.0) for v in (low, high)]
        along = np.mean([mesh.nodes[n] for n in ends[1]], axis=0) - np.mean([mesh.nodes[n] for n in ends[0]], axis=0)
        outward = per_length * np.array([-along[1], along[0]])
        for nodes in ends:
            for n in nodes:
                forces[n] = forces.get(n, 0.0) + 0.5 * outward / len(nodes)
    return "".join("%d, %d, %.17g\n" % (n, dof, f[dof - 1]) for n, f in forces.items() for dof in (1, 2))


def global_stress(mesh, results):
    """S of the elements in global axes: solids report it so, sheets in the axes 1 = projected global x."""
    stress = results.element(mesh.kind, "S")
    if mesh.kind in SOLIDS:
        return stress
    return stress  # flat sheets in the xy plane: the projected axes are the global ones


@problem("COOK", "Cook's panel 48 x 44/16, plane stress, E 1, nu 1/3, unit shear on its end", "Cook 1974; FinEtools: 23.97",
         {"v at (48, 52)": (23.97, 0.01)}, {kind: (8, 16, 32) for kind in FLAT}, lambda n: "%d x %d" % (n, n),
         {"C3D8R": 0.05})
def cook(session, kind, n):
    mesh = sheet(kind, (n, n), lambda r, s: (48.0 * r, 44.0 * r + s * (44.0 - 28.0 * r), 0.0), 1.0)
    mesh.section(1.0, elastic(1.0, 1.0 / 3.0))
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + flat(mesh) + mesh.hold(mesh.at(r=0.0), (1, 2, 6)))
    mesh.add("*CLOAD\n" + mesh.share(mesh.at(r=1.0), 2, 1.0) + FIELDS + "*END STEP")
    results = session.run("cook_%s_%d" % (kind, n), mesh)
    return {"v at (48, 52)": middle(mesh, results, 1.0, 0.5)[1]}


@problem("LE5", "Z-section cantilever of length 10 under the torque 1.2 MNm", "NAFEMS LE5; refined meshes give -111.2",
         {"sigma_xx at A, MPa": (-108.0, 0.05)}, {kind: (8, 16, 32) for kind in SHELLS}, lambda n: "%d x %d" % (n, n // 2))
def le5(session, kind, n):
    """A lies on the edge of a flange at x = 2.5; the stress is that of the middle surface."""
    line = [(-1.0, 1.0), (0.0, 1.0), (0.0, -1.0), (1.0, -1.0)]  # y, z of the section

    def place(r, s):
        piece = min(int(s * 4.0), 3)  # flange, two halves of the web, flange
        y, z = [(s * 4.0 - 1.0, 1.0), (0.0, 2.0 - s * 4.0), (0.0, 2.0 - s * 4.0), (s * 4.0 - 3.0, -1.0)][piece]
        return 10.0 * r, y, z

    assert place(0.0, 0.0)[1:] == line[0] and place(0.0, 1.0)[1:] == line[-1]
    mesh = sheet(kind, (n, n // 2), place, 0.1)
    mesh.section(0.1, elastic(210e9, 0.3))
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + mesh.hold(mesh.at(r=0.0), range(1, 7)) + "*CLOAD\n")
    flanges = [[m for m in mesh.at(r=1.0) if low <= mesh.parameters[m][1] <= high] for low, high in ((0.0, 0.25), (0.75, 1.0))]
    mesh.add(mesh.share(flanges[0], 2, -0.6e6) + mesh.share(flanges[1], 2, 0.6e6) + FIELDS + "*END STEP")
    results = session.run("le5_%s_%d" % (kind, n), mesh)
    stress = results.element(kind, "S")[:, 0]
    return {"sigma_xx at A, MPa": flange_stress(mesh, stress) / 1e6}


def flange_stress(mesh, stress):
    """Quadratic extrapolation across the flange at x = 2.5 to its edge."""
    centres = np.array(mesh.centres)
    near = centres[:, 1] < 0.25
    terms = lambda r, s: np.stack([np.ones_like(r), r - 0.25, (r - 0.25) ** 2, s, s * s, s * (r - 0.25)], axis=-1)
    close = near & (np.abs(centres[:, 0] - 0.25) < 0.2)
    across = len(np.unique(np.round(centres[close, 1], 9)))
    kept = 6 if across > 2 else 4
    matrix = terms(centres[close, 0], centres[close, 1])[:, :kept]
    return np.linalg.lstsq(matrix, stress[close], rcond=None)[0][0]


@problem("SCOR", "Scordelis-Lo roof, R 25, L 50, 40 degrees, t 0.25, weight 90 per area; a quarter", "MacNeal & Harder; FinEtools",
         {"u_z at the middle of the free edge": (-0.3024, 0.01)}, {kind: (8, 16) for kind in CURVED}, lambda n: "%d x %d" % (n, n),
         {"C3D8R": 0.1, "S4": 0.01, "S4R": 0.01}, {"S3R": TRIANGLE})
def scordelis(session, kind, n):
    """r along the axis from the middle to the diaphragm, s from the crown to the free edge."""
    place = lambda r, s: (25.0 * math.sin(angle(40.0) * s), -25.0 * r, 25.0 * math.cos(angle(40.0) * s))
    mesh = sheet(kind, (n, n), place, 0.25)
    mesh.section(0.25, elastic(4.32e8, 0.0, 360.0))
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + symmetry(mesh, mesh.at(r=0.0), 2) + symmetry(mesh, mesh.at(s=0.0), 1))
    mesh.add(mesh.hold(mesh.at(r=1.0), (1, 3)) + "*DLOAD\n, GRAV, 1., 0., 0., -1.\n" + FIELDS + "*END STEP")
    results = session.run("scordelis_%s_%d" % (kind, n), mesh)
    return {"u_z at the middle of the free edge": middle(mesh, results, 0.0, 1.0)[2]}


@problem("PCYL", "cylinder L 600, R 300, t 3 between diaphragms, pinched by unit forces; an eighth", "Code_Aster ssls104; MacNeal & Harder",
         {"w under the force": (-1.8248e-5, 0.03)}, {kind: (16, 32) for kind in CURVED}, lambda n: "%d x %d" % (n, n),
         notes={"C3D8R": THIN, "S3R": TRIANGLE})
def cylinder(session, kind, n):
    """r along the axis from the middle to the diaphragm, s from the force down to the horizontal plane."""
    place = lambda r, s: (300.0 * math.sin(0.5 * math.pi * s), -300.0 * r, 300.0 * math.cos(0.5 * math.pi * s))
    mesh = sheet(kind, (n, n), place, 3.0)
    mesh.section(3.0, elastic(3e6, 0.3))
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + symmetry(mesh, mesh.at(r=0.0), 2) + symmetry(mesh, mesh.at(s=0.0), 1))
    mesh.add(symmetry(mesh, mesh.at(s=1.0), 3) + mesh.hold(mesh.at(r=1.0), (1, 3)))
    mesh.add("*CLOAD\n" + mesh.share(mesh.at(r=0.0, s=0.0), 3, -0.25) + FIELDS + "*END STEP")
    results = session.run("cylinder_%s_%d" % (kind, n), mesh)
    return {"w under the force": middle(mesh, results, 0.0, 0.0)[2]}


@problem("PHEMI", "hemisphere with a hole of 18 degrees, R 10, t 0.04, two pairs of forces 2; a quarter",
         "MacNeal & Harder (0.094); Simo, Fox & Rifai (0.093); Code_Aster ssls105",
         {"u under the outward force": (0.0935, 0.02)}, {kind: (16, 32) for kind in CURVED}, lambda n: "%d x %d" % (n, n),
         notes={"C3D8R": THIN, "S3R": TRIANGLE})
def hemisphere(session, kind, n):
    """r along the equator from x to y, s from the equator up to the hole."""
    def place(r, s):
        around, up = 0.5 * math.pi * r, angle(72.0) * s
        return 10.0 * math.cos(up) * math.cos(around), 10.0 * math.cos(up) * math.sin(around), 10.0 * math.sin(up)

    mesh = sheet(kind, (n, n), place, 0.04)
    mesh.section(0.04, elastic(6.825e7, 0.3))
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + symmetry(mesh, mesh.at(r=0.0), 2) + symmetry(mesh, mesh.at(r=1.0), 1))
    mesh.add("%d, 3\n*CLOAD\n" % mesh.at(r=0.0, s=0.0)[0])
    mesh.add(mesh.share(mesh.at(r=0.0, s=0.0), 1, 1.0) + mesh.share(mesh.at(r=1.0, s=0.0), 2, -1.0) + FIELDS + "*END STEP")
    results = session.run("hemisphere_%s_%d" % (kind, n), mesh)
    return {"u under the outward force": middle(mesh, results, 0.0, 0.0)[0]}


@problem("PLATE", "square plate 10 x 10 x 0.05 under an even pressure, hard simple support and clamped; a quarter",
         "Timoshenko & Woinowsky-Krieger; FinEtools",
         {"w D / p L^4, supported": (4.06235e-3, 0.01), "w D / p L^4, clamped": (1.26532e-3, 0.01)},
         {kind: (4, 8) for kind in CURVED}, lambda n: "%d x %d" % (n, n), {"C3D8R": 0.01, "S4R": 0.01, "S3R": 0.06}, {"S3R": TRIANGLE})
def plate(session, kind, n):
    """r and s from the middle to the edges."""
    found = []
    for clamped in (False, True):
        mesh = sheet(kind, (n, n), lambda r, s: (5.0 * r, 5.0 * s, 0.0), 0.05)
        mesh.section(0.05, elastic(200e9, 0.3))
        mesh.add("*SURFACE, NAME=TOP, TYPE=ELEMENT\nALL, %s" % ("S2" if kind in SOLIDS else "SPOS"))
        mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + symmetry(mesh, mesh.at(r=0.0), 1) + symmetry(mesh, mesh.at(s=0.0), 2))
        for edge, tangent in ((mesh.at(r=1.0), 4), (mesh.at(s=1.0), 5)):
            if clamped:
                mesh.add(mesh.hold(edge, range(1, 7)))
            elif kind in SOLIDS:
                mesh.add(mesh.hold([m for m in edge if mesh.parameters[m][2] == 0.0], (3,)))
                mesh.add(mesh.hold(edge, (2 if tangent == 4 else 1,)))
            else:
                mesh.add(mesh.hold(edge, (3, tangent)))
        mesh.add("*DSLOAD\nTOP, P, 1000.\n" + FIELDS + "*END STEP")
        results = session.run("plate_%s_%d_%d" % (kind, n, clamped), mesh)
        stiffness = 200e9 * 0.05**3 / 12.0 / (1.0 - 0.09)
        found.append(-middle(mesh, results, 0.0, 0.0)[2] * stiffness / 1000.0 / 1e4)
    return {"w D / p L^4, supported": found[0], "w D / p L^4, clamped": found[1]}


PLIES = "".join("%g, 3, %s, %g\n" % (0.4 if i == 3 else 0.1, "M", 90.0 * (i % 2)) for i in range(7))


@problem("R0031-1", "laminated strip 0/90/0/90/0/90/0 in three-point bending, 10 N/mm", "NAFEMS R0031 problem 1",
         {"w at E, mm": (-1.06, 0.02), "sigma_11 at E, MPa": (683.9, 0.05)}, {kind: (10, 20) for kind in SHELLS},
         lambda n: "%d x %d" % (n, max(2, n // 5)))
def laminate(session, kind, n):
    """Half of the strip: from the middle (r = 0) over the support at 15 to the free end at 25. E: bottom of the middle."""
    mesh = sheet(kind, (n, max(2, n // 5)), lambda r, s: (25.0 * r, 10.0 * s, 0.0), 1.0)
    mesh.section(1.0, "*ELASTIC, TYPE=LAMINA\n1e5, 5e3, 0.4, 3e3, 3e3, 2e3", layers=PLIES.strip())
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + symmetry(mesh, mesh.at(r=0.0), 1) + mesh.hold(mesh.at(r=0.6), (3,)))
    mesh.add("%d, 2\n*CLOAD\n" % mesh.at(r=0.0, s=0.0)[0] + mesh.share(mesh.at(r=0.0), 3, -50.0))
    mesh.add(FIELDS.replace("S\n", "S\nSM\n") + "*END STEP")
    results = session.run("laminate_%s_%d" % (kind, n), mesh)
    bottom = results.element(kind, "S_BOT")[:, 0]
    return {"w at E, mm": middle(mesh, results, 0.0, None)[2], "sigma_11 at E, MPa": recovered(mesh, bottom, 0.0, 0.5)}
