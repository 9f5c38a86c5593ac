"""Steel and copper: bars and sheets that yield, slowly and in impacts."""
import math

from dynamics import history
from meshes import BEAMS, FIELDS, SHELLS, SOLIDS, angle, block, elastic, line, patchwork, quarter_disc, sheet
from verification import problem


STIFF_FOOT = ("the hourglass stiffness of the reduced brick stays elastic where the copper flows, and holds the foot's edge back; "
              "order 0.6")
# Energies balance to 0.5 %, of hourglass 1 %.
CLAMPED = ("shells on 8, 16, 32 x 64 give 0.89, 1.07, 1.10 (1.20 at the peak), bricks whose hourglass stresses flow 0.36, 0.90, 1.00: both "
           "tend to 1.1 for these data; sides that are hinged, not clamped, give 13 % more")
STIFF_HINGE = "the mesh is near its limit (shells give -9.3 %): the reference is a measurement"


@problem("J2", "bar pulled to a true strain of 1, E 200e3, nu 0.3, yield 400 + 100 x plastic strain", "closed form, ln(l / L) = s / E + ep",
         {"true stress": (400.0 + 100.0 * (1.0 - 499.75 / 200e3), 2e-3)}, {kind: (10, 40) for kind in ("C3D8", "C3D8R", "T3D2", "S4R")},
         lambda n: "%d increments" % n, {"C3D8R": 2e-3, "T3D2": 2e-3})
def pulled(session, kind, n):
    """The flow rule holds for the Kirchhoff stress, which is 0.1 % above the true one at this elastic change of volume."""
    if kind == "T3D2":
        mesh = line(kind, 1, lambda r: (r, 0.0, 0.0))
        mesh.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n1.\n*MATERIAL, NAME=M\n" + yielding(200e3, 0.3, 400.0, 100.0))
        held = mesh.hold(mesh.at(r=0.0), (1,)) + mesh.hold(mesh.at(), (2, 3))
    else:
        mesh = block(kind, (1, 1, 1), lambda r, s, t: (r, s, t)) if kind in SOLIDS else sheet(kind, (1, 1), lambda r, s: (r, s, 0.0), 1.0)
        mesh.section(1.0, yielding(200e3, 0.3, 400.0, 100.0))
        held = mesh.hold(mesh.at(r=0.0), (1,)) + mesh.hold(mesh.at(s=0.0), (2,))
        held += mesh.hold(mesh.at(t=0.0), (3,)) if kind in SOLIDS else mesh.hold(mesh.at(), (3, 4, 5, 6))
    mesh.add("*STEP, NLGEOM, INC=1000\n*STATIC, DIRECT\n%.17g, 1.\n*BOUNDARY\n" % (1.0 / n) + held)
    mesh.add("".join("%d, 1, 1, %.17g\n" % (m, math.e - 1.0) for m in mesh.at(r=1.0)) + FIELDS + "*END STEP")
    return {"true stress": session.run("pulled_%s_%d" % (kind, n), mesh).element(kind, "S")[0, 0]}


def yielding(young, poisson, stress, hardening, density=None, end=2.0):
    """Linear isotropic hardening up to a plastic strain of `end`."""
    rows = "%.17g, 0.\n%.17g, %g" % (stress, stress + hardening * end, end)
    return elastic(young, poisson, density) + "\n*PLASTIC\n" + (rows if hardening else "%.17g, 0." % stress)


@problem("TAYLOR", "copper rod of 32.4 x 3.2 mm hits a smooth wall at 227 m/s; a quarter, 80 us", "Carina (Foulk 2021); Simo; Zienkiewicz",
         {"radius of the face, mm": (7.15, 0.02), "length, mm": (21.45, 0.02)}, {kind: (2, 3) for kind in ("C3D8R", "C3D8")},
         lambda n: "%d x %d" % (3 * n * n, 16 * n), {"C3D8R": 0.02})
def taylor(session, kind, n):
    """The published radii lie between 7.11 and 7.22 mm."""
    mesh = patchwork(kind, quarter_disc(3.2), n, [32.4 * k / (16 * n) for k in range(16 * n + 1)])
    mesh.section(1.0, yielding(117e3, 0.35, 400.0, 100.0, 8.93e-9, 5.0))
    mesh.sets["ROD"] = list(mesh.nodes)
    mesh.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nROD, 3, -227e3\n*STEP\n*DYNAMIC, EXPLICIT\n, 80e-6\n*BOUNDARY")
    for axis in range(3):
        mesh.add(mesh.hold([m for m, x in mesh.nodes.items() if x[axis] < 1e-9], (axis + 1,)))
    mesh.add("*OUTPUT, FIELD, NUMBER INTERVAL=2, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*END STEP")
    results = session.run("taylor_%s_%d" % (kind, n), mesh)
    corner = mesh.node_at((3.2, 0.0, 0.0))
    return {"radius of the face, mm": 3.2 + results.at(corner, "U")[0],
            "length, mm": 32.4 + results.at(mesh.node_at((0.0, 0.0, 32.4)), "U")[2]}


@problem("PANEL", "cylindrical panel of 120 degrees, R 2.9375, L 12.56, t 0.125 in, hit at 5650 in/s over 10.205 x 3.08 in",
         "Balmer & Witmer 1964 (experiment 1.28); Belytschko & Leviathan; Abaqus", {"deflection at L / 2, in": (1.265, 0.07)},
         {kind: (8, 16) for kind in SHELLS}, lambda n: "%d x %d" % (n, 2 * n), {}, {kind: CLAMPED for kind in SHELLS})
def panel(session, kind, n):
    """Half of the panel: r from the crown to the clamped edge, s along the axis; hinged ends, clamped side. Struck are 13/16 of the
    length and, of the arc, the middle half: hit over all of it the panel would stop in hoop compression, after rho v^2 R / 2 sy =
    0.27 in."""
    mesh = sheet(kind, (n, 2 * n), lambda r, s: (2.9375 * math.sin(angle(60.0) * r), 12.56 * s, 2.9375 * math.cos(angle(60.0) * r)), 0.125)
    mesh.section(0.125, yielding(10.5e6, 0.33, 44000.0, 0.0, 2.5e-4))
    struck = [m for m, p in mesh.parameters.items() if 12.56 * p[1] <= 10.205 + 1e-9 and p[0] <= 0.5 + 1e-9]
    mesh.add("*INITIAL CONDITIONS, TYPE=VELOCITY")
    for m in struck:
        turned = angle(60.0) * mesh.parameters[m][0]
        mesh.add("%d, 1, %.17g\n%d, 3, %.17g" % (m, -5650.0 * math.sin(turned), m, -5650.0 * math.cos(turned)))
    mesh.add("*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n*BOUNDARY")
    mesh.add(mesh.hold(mesh.at(r=0.0), (1, 5, 6)) + mesh.hold(mesh.at(r=1.0), range(1, 7)))
    mesh.add(mesh.hold(mesh.at(s=0.0) + mesh.at(s=1.0), (1, 2, 3)))
    crown = mesh.at(r=0.0, s=0.5)[0]
    mesh.sets["CROWN"] = [crown]
    mesh.add("*OUTPUT, HISTORY, TIME INTERVAL=5e-6\n*NODE OUTPUT, NSET=CROWN\nU3\n*END STEP")
    results = session.run("panel_%s_%d" % (kind, n), mesh)
    return {"deflection at L / 2, in": -history(results, "node_%d" % crown, "U3")[1][-40:].mean()}


@problem("CLBEAM", "clamped 6061-T6 beam of 10 in, 1.2 x 0.125, hit at 5000 in/s over 2 in in its middle; a half",
         "Balmer & Witmer 1964 (experiment about 0.78)", {"deflection of the middle, in": (0.78, 0.10)},
         {kind: (20, 40) for kind in ("S4R", "B31", "C3D8R")}, str, {}, {"C3D8R": STIFF_HINGE})
def clamped_beam(session, kind, n):
    """r from the middle to the clamped end."""
    material = yielding(10.4e6, 0.33, 41400.0, 0.0, 2.61e-4)
    if kind in BEAMS:
        mesh = line(kind, n, lambda r: (5.0 * r, 0.0, 0.0))
        mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n1.2, 0.125\n0., 1., 0.\n*MATERIAL, NAME=M\n" + material)
    else:
        mesh = sheet(kind, (n, 2), lambda r, s: (5.0 * r, 1.2 * s, 0.0), 0.125, layers=4)
        mesh.section(0.125, material)
    mesh.sets["STRUCK"] = [m for m, p in mesh.parameters.items() if p[0] < 0.2 + 1e-9]
    mesh.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nSTRUCK, 3, -5000.\n*STEP\n*DYNAMIC, EXPLICIT\n, 1.5e-3\n*BOUNDARY")
    mesh.add(mesh.hold(mesh.at(r=0.0), (1, 5, 6)) + mesh.hold(mesh.at(r=1.0), range(1, 7)))
    centre = mesh.at(r=0.0)[0]
    mesh.sets["CENTRE"] = [centre]
    mesh.add("*OUTPUT, HISTORY, TIME INTERVAL=5e-6\n*NODE OUTPUT, NSET=CENTRE\nU3\n*END STEP")
    results = session.run("clbeam_%s_%d" % (kind, n), mesh)
    # The beam goes on vibrating elastically about its lasting shape.
    return {"deflection of the middle, in": -history(results, "node_%d" % centre, "U3")[1][-150:].mean()}
