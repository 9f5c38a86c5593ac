"""Straight, curved and twisted cantilevers by solids, shells and beams."""
import math

from meshes import BEAMS, FIELDS, SHELLS, SOLIDS, angle, elastic, line, middle, sheet
from verification import problem

BAR_ELEMENTS = ("C3D8", "C3D8R", "S4", "S4R", "S3R", "B31")
TRAPEZOIDS = ("a 4-node membrane or brick that passes the patch test is stiff in bending when cut to trapezoids: "
              "MacNeal, Int. J. Numer. Meth. Eng. 24 (1987)")
WARPING = ("one layer of bricks warps bilinearly: J = b^3 h^3 / 3 (b^2 + h^2), 16 % above St. Venant's; the target itself counts "
           "the held root, 6 % of it")
TRIANGLE = "the membrane of the triangle has constant strain and locks in bending in its plane: 48 x 8 of them still hold back %s"
LAYER = "one layer of bricks without a shear strain that varies over it; 24 x 4 reach the target"
SHEARED = "twist of a section twice as broad as thick is transverse shear near its edges, constant in a triangle: 48 x 8 give -2 %"
BBAR = "the 2x2x2 brick without incompatible modes is stiff in bending (shear locking); finer meshes converge"


def bar(kind, counts, place, depth_along_s, thickness, breadth, spread=None, direction=(0.0, 0.0, 1.0)):
    """The bar as a sheet place(r, s) of `thickness`, or as beams along place(r, 1/2) with their first axis in `direction`."""
    if kind not in BEAMS:
        return sheet(kind, counts, place, thickness, spread)
    mesh = line(kind, counts[0], lambda r: place(r, 0.5))
    mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n%.17g, %.17g\n%g, %g, %g" %
             (thickness if direction == (0.0, 0.0, 1.0) else breadth, depth_along_s, *direction))
    return mesh


def tip_loads(session, name, make, material, thickness, loads, nonlinear=False):
    """One linear step for each load (dof, total) on the end r = 1 of a bar clamped at r = 0; displacement of its middle."""
    found = []
    for number, (dof, total) in enumerate(loads):
        mesh = make()
        if mesh.kind in BEAMS:
            mesh.add("*MATERIAL, NAME=M\n" + material)
        else:
            mesh.section(thickness, material)
        mesh.add("*STEP%s\n*STATIC\n1., 1.\n*BOUNDARY" % (", NLGEOM" if nonlinear else ""))
        mesh.add(mesh.hold(mesh.at(r=0.0), range(1, 7)) + "*CLOAD\n" + mesh.share(mesh.at(r=1.0), dof, total))
        mesh.add(FIELDS + "*END STEP")
        results = session.run("%s_%d" % (name, number), mesh)
        found.append(middle(mesh, results, 1.0, None)[dof - 1])
    return found


def distortion(shape, elements):
    """Moves the inner edges of a bar of `elements`: slanted by 45 degrees, alternately (trapezoid) or all alike (parallelogram)."""
    slant = 0.1 / 6.0  # half the depth over the length

    def spread(r, s):
        edge = round(r * elements)
        if shape == "rectangle" or edge in (0, elements):
            return r, s
        sign = (-1) ** edge if shape == "trapezoid" else 1
        return r + sign * slant * (1.0 - 2.0 * s), s

    return spread


def straight(shape, targets, elements, notes, quick):
    @problem("MH-beam %s" % shape, "straight cantilever 6 x 0.2 x 0.1, unit loads on the end",
             "MacNeal & Harder, Finite Elem. Anal. Des. 1 (1985); closed forms", targets, {kind: (6, 12) for kind in elements},
             lambda n: "%d x %d" % (n, max(1, n // 6)), quick, notes)
    def solve(session, kind, n):
        across = max(1, n // 6)
        make = lambda: bar(kind, (n, across), lambda r, s: (6.0 * r, 0.2 * (s - 0.5), 0.0), 0.2, 0.1, 0.2,
                           distortion(shape, n) if across == 1 else refined(shape, n))
        extension, in_plane, out = tip_loads(session, "mh_%s_%s_%d" % (shape, kind, n), make, elastic(1e7, 0.3), 0.1,
                                             ((1, 1.0), (2, 1.0), (3, 1.0)))
        return {"extension": extension, "in plane": in_plane, "out of plane": out,
                "twist": twist(session, "mh_%s_%s_%d_twist" % (shape, kind, n), make())}

    return solve


def refined(shape, n):
    """The benchmark's six elements, each halved both ways."""
    coarse = distortion(shape, n // 2)

    def spread(r, s):
        half = 2.0 / n
        low = math.floor(r / half + 1e-9) * half
        high = min(low + half, 1.0)
        a, b = coarse(low, s)[0], coarse(high, s)[0]
        return a + (b - a) * (r - low) / half, s

    return spread


def twist(session, name, mesh):
    """Rotation of the end under a unit moment about the bar: a couple on the end's nodes, or a moment where they turn."""
    mesh.section(0.1, elastic(1e7, 0.3)) if mesh.kind not in BEAMS else mesh.add("*MATERIAL, NAME=M\n" + elastic(1e7, 0.3))
    end = mesh.at(r=1.0)
    if mesh.turning:
        loads = mesh.share(end, 4, 1.0)
    else:
        loads = ""
        arms = {n: mesh.nodes[n] for n in end}
        polar = sum(y * y for _, y, _ in arms.values())
        for n, (_, y, _) in arms.items():
            loads += "%d, 3, %.17g\n" % (n, y / polar)
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + mesh.hold(mesh.at(r=0.0), range(1, 7)) + "*CLOAD\n" + loads)
    mesh.add(FIELDS.replace("U, RF", "U, UR") if mesh.turning else FIELDS)
    mesh.add("*END STEP")
    results = session.run(name, mesh)
    if mesh.kind in BEAMS:
        return results.at(end[0], "UR")[0]
    edges = [middle(mesh, results, 1.0, s)[2] for s in (0.0, 1.0)]
    return (edges[1] - edges[0]) / 0.2


STRAIGHT = {"extension": (3e-5, 0.02), "in plane": (0.1081, 0.03), "out of plane": (0.4321, 0.03), "twist": (0.03208, 0.08)}
straight("rectangle", STRAIGHT, BAR_ELEMENTS, {
    ("C3D8", "in plane"): BBAR, ("C3D8", "out of plane"): BBAR, ("C3D8", "twist"): WARPING, ("C3D8R", "twist"): WARPING,
    ("S3R", "in plane"): TRIANGLE % "32 %", ("S3R", "twist"): SHEARED}, {"C3D8R": 0.1})
for distorted in ("trapezoid", "parallelogram"):
    straight(distorted, STRAIGHT, BAR_ELEMENTS[:-1], {
        kind: TRAPEZOIDS for kind in ("C3D8", "C3D8R", "S4", "S4R", "S3R")}, {})


@problem("MH-curved", "quarter arc 4.12 to 4.32, thickness 0.1, unit loads on the end", "MacNeal & Harder 1985; Altair OS-V 0710",
         {"in plane": (0.08734, 0.05), "out of plane": (0.5022, 0.05)}, {kind: (6, 12) for kind in BAR_ELEMENTS},
         lambda n: "%d x %d" % (n, max(1, n // 6)), {},
         {"C3D8": BBAR, ("C3D8R", "out of plane"): LAYER, ("S3R", "in plane"): TRIANGLE % "36 %",
          ("S3R", "out of plane"): "bends and twists: " + SHEARED.replace("-2", "-3")})
def curved(session, kind, n):
    def place(r, s):
        radius, turned = 4.32 - 0.2 * s, 0.5 * math.pi * r
        return radius * math.sin(turned), radius * math.cos(turned), 0.0

    make = lambda: bar(kind, (n, max(1, n // 6)), lambda r, s: place(r, 1.0 - s) if kind in SOLIDS + SHELLS else place(r, s),
                       0.2, 0.1, 0.2)
    # Clamped where the arc runs along x; at the other end it runs along y, and a load along x bends all of it in its plane.
    in_plane, out = tip_loads(session, "mh_curved_%s_%d" % (kind, n), make, elastic(1e7, 0.25), 0.1, ((1, 1.0), (3, 1.0)))
    return {"in plane": in_plane, "out of plane": out}


@problem("MH-twist", "cantilever 12 x 1.1 x 0.32 twisted by 90 degrees, unit loads on the end",
         "MacNeal & Harder 1985; Zupan & Saje: 0.001753248, 0.005424535",
         {"along the root's breadth": (0.001754, 0.02), "across it": (0.005424, 0.02)}, {kind: (12, 24) for kind in BAR_ELEMENTS},
         lambda n: "%d x %d" % (n, n // 6), {"C3D8R": 0.05}, {"C3D8": BBAR, ("S3R", "along the root's breadth"): TRIANGLE % "2 %"})
def twisted(session, kind, n):
    def place(r, s):
        turned, across = 0.5 * math.pi * r, 1.1 * (s - 0.5)
        return 12.0 * r, across * math.cos(turned), across * math.sin(turned)

    if kind in BEAMS:
        return twisted_beams(session, n)
    make = lambda: bar(kind, (n, n // 6), place, 1.1, 0.32, 0.32)
    along, across = tip_loads(session, "mh_twist_%s_%d" % (kind, n), make, elastic(29e6, 0.22), 0.32, ((2, 1.0), (3, 1.0)))
    return {"along the root's breadth": along, "across it": across}


def twisted_beams(session, n):
    """Beams with a section turned at the middle of each element."""
    def make():
        mesh = line("B31", n, lambda r: (12.0 * r, 0.0, 0.0))
        rows = mesh.elements["B31"]
        for number, _ in rows:
            turned = 0.5 * math.pi * (number - 0.5) / n
            mesh.add("*ELSET, ELSET=E%d\n%d\n*BEAM SECTION, ELSET=E%d, MATERIAL=M, SECTION=RECT\n1.1, 0.32\n0., %.17g, %.17g" %
                     (number, number, number, math.cos(turned), math.sin(turned)))
        return mesh

    along, across = tip_loads(session, "mh_twist_B31_%d" % n, make, elastic(29e6, 0.22), 0.32, ((2, 1.0), (3, 1.0)))
    return {"along the root's breadth": along, "across it": across}


SLENDER = ("C3D8", "C3D8R", "S4", "S4R", "S3R", "B31")


def strip(kind, n):
    """A cantilever 10 x 1 x 0.1 along x that bends about y."""
    if kind in BEAMS:
        mesh = line(kind, n, lambda r: (10.0 * r, 0.0, 0.0))
        mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n1., 0.1\n0., 1., 0.\n*MATERIAL, NAME=M\n" + elastic(1.2e6, 0.0))
        return mesh
    mesh = sheet(kind, (n, 1), lambda r, s: (10.0 * r, s, 0.0), 0.1)
    mesh.section(0.1, elastic(1.2e6, 0.0))
    return mesh


@problem("ELASTICA", "cantilever 10 x 1 x 0.1 under a dead force on its end, P L^2 / EI = 4", "elastica by shooting; Sze et al. 2004",
         {"w/L": (0.66996, 0.005), "-u/L": (0.32894, 0.005)},
         {kind: (20, 40) if kind in SOLIDS else (10, 20) for kind in SLENDER}, lambda n: "%d x 1" % n,
         {"C3D8R": 0.02}, {"C3D8": BBAR})
def elastica(session, kind, n):
    mesh = strip(kind, n)
    load = 4.0 * 1.2e6 * 0.1**3 / 12.0 / 100.0
    mesh.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1., 1e-5, 0.25\n*BOUNDARY\n" + mesh.hold(mesh.at(r=0.0), range(1, 7)))
    mesh.add("*CLOAD\n" + mesh.share(mesh.at(r=1.0), 3, load) + FIELDS + "*END STEP")
    u = middle(mesh, session.run("elastica_%s_%d" % (kind, n), mesh), 1.0, None)
    return {"w/L": u[2] / 10.0, "-u/L": -u[0] / 10.0}


@problem("ROLLUP", "the same strip rolled into a circle by the moment 2 pi EI / L on its end", "closed form; Code_Aster V6.04.138",
         {"u/L": (-1.0, 0.005), "w/L": (0.0, 0.005)}, {kind: (20, 40) for kind in ("S4", "S4R", "S3R", "B31")},
         lambda n: "%d x 1" % n, {"B31": 0.02})
def rollup(session, kind, n):
    """In its plane, as the closed form has it: moments about a fixed axis on the end's nodes can leave it by drilling and twist."""
    mesh = strip(kind, n)
    moment = 2.0 * math.pi * 1.2e6 * 0.1**3 / 12.0 / 10.0
    mesh.add("*STEP, NLGEOM, INC=400\n*STATIC\n0.05, 1., 1e-5, 0.1\n*BOUNDARY\n" + mesh.hold(mesh.at(r=0.0), range(1, 7)))
    mesh.add(mesh.hold(mesh.at(), (2, 4, 6)))
    mesh.add("*CLOAD\n" + mesh.share(mesh.at(r=1.0), 5, -moment) + FIELDS + "*END STEP")
    u = middle(mesh, session.run("rollup_%s_%d" % (kind, n), mesh), 1.0, None)
    return {"u/L": u[0] / 10.0, "w/L": u[2] / 10.0}


@problem("BATHE", "45 degree bend of radius 100, section 1 x 1, force 600 across its plane",
         "Bathe & Bolourchi 1979; Simo & Vu-Quoc 1986: (-23.48, -13.50, 53.37) with 8 elements",
         {"x": (-23.48, 0.02), "y": (-13.50, 0.02), "z": (53.37, 0.01)}, {"B31": (8, 16), "C3D8R": (16, 32)}, str)
def bend(session, kind, n):
    turned = lambda r: angle(45.0) * r
    arc = lambda r, s: ((99.5 + s) * math.sin(turned(r)), 100.0 - (99.5 + s) * math.cos(turned(r)), 0.0)
    if kind == "B31":
        mesh = line(kind, n, lambda r: arc(r, 0.5))
        mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n1., 1.\n0., 0., 1.\n*MATERIAL, NAME=M\n" + elastic(1e7, 0.0))
    else:
        mesh = sheet(kind, (n, 1), lambda r, s: arc(r, 1.0 - s), 1.0)
        mesh.section(1.0, elastic(1e7, 0.0))
    mesh.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1., 1e-5, 0.25\n*BOUNDARY\n" + mesh.hold(mesh.at(r=0.0), range(1, 7)))
    mesh.add("*CLOAD\n" + mesh.share(mesh.at(r=1.0), 3, 600.0) + FIELDS + "*END STEP")
    u = middle(mesh, session.run("bend_%s_%d" % (kind, n), mesh), 1.0, None)
    # x is the tangent at the clamp, y points from there to the centre of the arc.
    return {"x": u[0], "y": u[1], "z": u[2]}
