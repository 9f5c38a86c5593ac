"""Laws and membranes with closed forms: uniaxial rubber, a balloon, Hencky's membrane, laminate theory, a spinning ring."""
import math

import numpy as np
from meshes import FIELDS, SOLIDS, TURNING, block, elastic, line, middle, patchwork, sheet
from verification import problem

RUBBERS = {
    "neo-Hooke": ("NEO HOOKE\n0.5, 1e-5", (1.05556, -1.34082)),
    "Mooney-Rivlin": ("MOONEY-RIVLIN\n0.4, 0.1, 1e-5", (0.98519, -1.45574)),
    "Yeoh": ("YEOH\n0.5, -0.05, 0.01, 1e-5", (0.95396, -1.25742)),
}


def uniaxial(law, constants, stresses):
    quantities = {"nominal stress at stretch 1.5": (stresses[0], 1e-3), "nominal stress at stretch 0.7": (stresses[1], 1e-3)}

    @problem("UNIAX %s" % law, "one element of rubber, almost incompressible (K / C10 = 4e5)", "closed form; CalculiX 2.20", quantities,
             {"C3D8": (1,), "C3D8R": (1,)}, lambda n: "1", {"C3D8R": 1e-3} if law != "Yeoh" else {})
    def solve(session, kind, n):
        found = {}
        for quantity, stretch in zip(quantities, (1.5, 0.7)):
            mesh = block(kind, (1, 1, 1), lambda r, s, t: (r, s, t))
            mesh.section(1.0, "*HYPERELASTIC, " + constants)
            mesh.add("*STEP, NLGEOM\n*STATIC\n0.2, 1., 1e-5, 0.5\n*BOUNDARY")
            mesh.add(mesh.hold(mesh.at(r=0.0), (1,)) + mesh.hold(mesh.at(s=0.0), (2,)) + mesh.hold(mesh.at(t=0.0), (3,)))
            mesh.add("".join("%d, 1, 1, %g\n" % (m, stretch - 1.0) for m in mesh.at(r=1.0)) + FIELDS + "*END STEP")
            results = session.run("uniaxial_%s_%s_%g" % (law, kind, stretch), mesh)
            found[quantity] = sum(results.at(m, "RF")[0] for m in mesh.at(r=1.0))
        return found


for name, (text, both) in RUBBERS.items():
    uniaxial(name, text, both)


@problem("HENCKY", "clamped circular membrane, nu 0.3, blown up from flat, p a / E t = 1e-6", "Hencky's series: 0.6533 a (p a / E t)^(1/3)",
         {"w0 / a": (0.6533e-2, 0.01)}, {kind: (8, 16, 32) for kind in ("M3D4", "M3D4R", "M3D3", "S4R")}, lambda n: "%d x %d" % (n, n),
         {"M3D4": 0.01})
def hencky(session, kind, n):
    def disc(r, s):
        a, b = 2.0 * r - 1.0, 2.0 * s - 1.0
        return a * math.sqrt(1.0 - 0.5 * b * b), b * math.sqrt(1.0 - 0.5 * a * a), 0.0

    mesh = sheet(kind, (n, n), disc, 1e-3)
    mesh.section(1e-3, elastic(1e6, 0.3))
    rim = [m for m, x in mesh.nodes.items() if math.hypot(*x) > 1.0 - 1e-9]
    mesh.add("*SURFACE, NAME=UP, TYPE=ELEMENT\nALL, SNEG\n*STEP, NLGEOM, INC=400\n*STATIC\n0.2, 1., 1e-6, 0.5\n*BOUNDARY")
    mesh.add(mesh.hold(rim, range(1, 4)) + "*DSLOAD\nUP, P, 1e-3\n" + FIELDS + "*END STEP")
    results = session.run("hencky_%s_%d" % (kind, n), mesh)
    return {"w0 / a": middle(mesh, results, 0.5, 0.5)[2]}


def octant(kind, n):
    """An eighth of the unit sphere as three patches of quadrilaterals that meet on its diagonal."""
    def patch(corner):
        def place(r, s):
            point = np.zeros(3)
            point[corner] = 1.0
            point[(corner + 1) % 3], point[(corner + 2) % 3] = math.tan(0.25 * math.pi * r), math.tan(0.25 * math.pi * s)
            return tuple(point / np.linalg.norm(point))
        return place

    return patchwork(kind, [patch(corner) for corner in range(3)], n)


@problem("BALLOON", "neo-Hookean spherical membrane blown up, t0 / r0 = 0.01; an eighth", "p r0 / 4 C10 t0 = (1 - 1 / l^6) / l",
         {"stretch at p r0 / 4 C10 t0 = 0.39593": (1.1, 0.01), "stretch at 0.55425": (1.2, 0.01)},
         {kind: (4, 8) for kind in ("M3D4", "M3D4R", "M3D3")}, lambda n: "3 x %d x %d" % (n, n), {"M3D4R": 0.02})
def balloon(session, kind, n):
    """Under a prescribed pressure the balloon can be followed up to its limit point at stretch 1.383 only."""
    mesh = octant(kind, n)
    mesh.section(0.01, "*HYPERELASTIC, NEO HOOKE\n1., 1e-5")
    mesh.add("*SURFACE, NAME=IN, TYPE=ELEMENT\nALL, SNEG")
    held = "".join(mesh.hold([m for m, x in mesh.nodes.items() if abs(x[axis]) < 1e-9], (axis + 1,)) for axis in range(3))
    for load in (0.39593, 0.55425):
        mesh.add("*STEP, NLGEOM, INC=400\n*STATIC\n0.1, 1., 1e-6, 0.5\n*BOUNDARY\n" + held)
        mesh.add("*DSLOAD\nIN, P, %.17g\n" % (4.0 * 0.01 * load) + FIELDS + "*END STEP")
    results = session.run("balloon_%s_%d" % (kind, n), mesh)
    radii = [np.mean([np.linalg.norm(results.at(m, "U", step) + x) for m, x in mesh.nodes.items()]) for step in (1, 2)]
    return {"stretch at p r0 / 4 C10 t0 = 0.39593": radii[0], "stretch at 0.55425": radii[1]}


CORD = "*ELASTIC, TYPE=LAMINA\n3000., 10., 0.45, 3.3, 3.3, 3.3"


@problem("CLT", "balanced laminate +-20 degrees of E1 3000, E2 10, G12 3.3, nu12 0.45, thickness 1, as a square", "classical lamination",
         {"Q11": (2343.195, 1e-3), "Q22": (51.1754, 1e-3), "Q12": (313.334, 1e-3), "Q66": (312.131, 1e-3)},
         {kind: (1,) for kind in ("M3D4", "M3D4R")}, lambda n: "1", {"M3D4R": 1e-3})
def lamination(session, kind, n):
    """Stiffnesses from the reactions to small prescribed strains."""
    force = {}
    for name, gradient in {"11": [[1, 0], [0, 0]], "22": [[0, 0], [0, 1]], "12": [[0, 1], [0, 0]]}.items():
        mesh = sheet(kind, (1, 1), lambda r, s: (r, s, 0.0), 1.0)
        mesh.section(1.0, CORD, layers="0.5, , M, 20.\n0.5, , M, -20.")
        mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + mesh.hold(mesh.at(), (3,)))
        for m, x in mesh.nodes.items():
            mesh.add("\n".join("%d, %d, %d, %.17g" % (m, dof + 1, dof + 1, 1e-6 * np.dot(gradient[dof], x[:2])) for dof in (0, 1)))
        mesh.add(FIELDS + "*END STEP")
        results = session.run("lamination_%s_%s" % (kind, name), mesh)
        force[name] = sum(results.at(m, "RF") for m in mesh.at(r=1.0)) / 1e-6, sum(results.at(m, "RF") for m in mesh.at(s=1.0)) / 1e-6
    return {"Q11": force["11"][0][0], "Q22": force["22"][1][1], "Q12": force["11"][1][1], "Q66": force["12"][0][1]}


@problem("RING", "thin ring rho 1100, R 0.3, E 10e6, spinning at 48 rad/s; a quarter, small strains", "rho w^2 R^3 / E",
         {"radial growth, mm": (6.8429, 0.01)}, {kind: (8, 16) for kind in ("C3D8R", "S4R", "B31")}, str)
def ring(session, kind, n):
    """In cylindrical directions, in which nothing moves around. Rings of bars or membranes are mechanisms until they are taut."""
    around = lambda r: (0.3 * math.sin(0.5 * math.pi * r), 0.3 * math.cos(0.5 * math.pi * r))
    material = elastic(10e6, 0.0, 1100.0)
    if kind == "B31":
        mesh = line(kind, n, lambda r: (*around(r), 0.0))
        section = "*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n0.001, 0.001\n0., 0., 1."
        mesh.add(section + "\n*MATERIAL, NAME=M\n" + material)
    else:
        mesh = sheet(kind, (n, 1), lambda r, s: (*around(r), 0.01 * s), 0.001)
        mesh.section(0.001, material)
    mesh.add("*NSET, NSET=AROUND\n" + "\n".join(map(str, mesh.at())) + "\n*TRANSFORM, NSET=AROUND, TYPE=C\n0., 0., 0., 0., 0., 1.")
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + mesh.hold(mesh.at(), (2,)))
    mesh.add(mesh.hold(mesh.at() if kind not in SOLIDS else mesh.at(s=0.0), (3,)))
    if kind in TURNING:
        mesh.add(mesh.hold(mesh.at(), (4, 5, 6)))
    mesh.add("*DLOAD\nALL, CENTRIF, %.17g, 0., 0., 0., 0., 0., 1.\n" % 48.0**2 + FIELDS + "*END STEP")
    results = session.run("ring_%s_%d" % (kind, n), mesh)
    return {"radial growth, mm": 1000.0 * middle(mesh, results, 0.0, None)[1]}


@problem("PRONY", "block sheared at once, then held: g1 0.3, tau 0.1, explicit", "tau / G gamma = 1 - g1 (1 - exp(-t / tau))",
         {"after tau": (1.0 - 0.3 * (1.0 - math.exp(-1.0)), 5e-3), "after 5 tau": (1.0 - 0.3 * (1.0 - math.exp(-5.0)), 5e-3)},
         {kind: (1,) for kind in ("C3D8", "C3D8R")}, lambda n: "1")
def relaxation(session, kind, n):
    """The strain grows within 2e-3, of which increments of 1e-4 make 20; times count from the middle of that. The moduli are those at once."""
    mesh = block(kind, (1, 1, 1), lambda r, s, t: (r, s, t))
    mesh.section(1.0, elastic(1e6, 0.25, 1000.0).replace("*ELASTIC", "*ELASTIC, MODULI=INSTANTANEOUS") + "\n*VISCOELASTIC, TIME=PRONY\n0.3, 0., 0.1")
    shear = 1e-4
    mesh.add("*AMPLITUDE, NAME=ONCE, DEFINITION=SMOOTH STEP\n0., 0., 0.002, 1., 1., 1.\n*STEP\n*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n1e-4, 0.501\n*BOUNDARY")
    mesh.add(mesh.hold(mesh.at(t=0.0), (1, 2, 3)) + mesh.hold(mesh.at(t=1.0), (2, 3)))
    mesh.add("*BOUNDARY, AMPLITUDE=ONCE\n" + "".join("%d, 1, 1, %g\n" % (m, shear) for m in mesh.at(t=1.0)))
    mesh.add("*OUTPUT, FIELD, TIME INTERVAL=0.01, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\nS\n*END STEP")
    results = session.run("prony_%s" % kind, mesh)
    modulus = 1e6 / 2.5
    stress = [(frame.attrs["time"] - 1e-3, frame["element/%s/S" % kind][0, 4] / (modulus * shear)) for frame in results.frames(1)]
    times, ratios = zip(*stress)
    return {"after tau": np.interp(0.1, times, ratios), "after 5 tau": np.interp(0.5, times, ratios)}
