"""Tetrahedra, quadratic and incompatible solids through the whole program: solid_cases.py CASE PROGRAM FOLDER."""
import math
import sys

import numpy as np

from static_model import Runner, brick, close

HEXAHEDRON_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
TETRAHEDRON_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
WEDGE_EDGES = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
WEDGES = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
OUTPUT = "*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*ELEMENT OUTPUT\nS\n"
MATERIAL = "*MATERIAL, NAME=M\n*ELASTIC\n%g, %g\n*DENSITY\n%g\n*SOLID SECTION, ELSET=ALL, MATERIAL=M"
STATIC = "*STEP\n*STATIC\n%s\n" + OUTPUT + "*END STEP"
KINDS = ("C3D20R", "C3D20", "C3D15", "C3D10", "C3D4", "C3D8I")


def solid(kind, counts, lengths, place=None):
    """A block of the kind from the origin; `place` moves its nodes, those in the middle of edges too."""
    bricks = brick(counts, lengths)
    nodes, elements = bricks.nodes, []
    middles = {}

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(nodes) + 1
            nodes[middles[key]] = tuple(0.5 * (p + q) for p, q in zip(nodes[a], nodes[b]))
        return middles[key]

    edges = {"C3D10": TETRAHEDRON_EDGES, "C3D15": WEDGE_EDGES, "C3D20": HEXAHEDRON_EDGES, "C3D20R": HEXAHEDRON_EDGES}.get(kind, ())
    for _, corners in bricks.elements.pop("C3D8R"):
        for local in {"C3D4": TETRAHEDRA, "C3D10": TETRAHEDRA, "C3D15": WEDGES}.get(kind, (range(8),)):
            own = [corners[i] for i in local]
            elements.append((len(elements) + 1, own + [middle(own[a], own[b]) for a, b in edges]))
    bricks.elements[kind] = elements
    if place:
        bricks.nodes = {number: place(*x) for number, x in nodes.items()}
    return bricks


def pressed(runner):
    """A distorted block with the same pressure on all its faces: -p in each direction, everywhere."""
    skew = lambda x, y, z: (x + 0.1 * y, y - 0.05 * z, z + 0.08 * x)
    for kind in KINDS:
        deck = solid(kind, (2, 2, 2), (1.0, 1.0, 1.0), skew)
        deck.add("*SURFACE, NAME=SKIN\nALL")
        deck.add(MATERIAL % (1000.0, 0.3, 1.0))
        hold = "*BOUNDARY\n1, 1, 3\n3, 2, 3\n7, 3\n"  # a corner and the ends of two edges from it
        deck.add(STATIC % (hold + "*DSLOAD\nSKIN, P, 2."))
        results = runner.run_alike("pressed_" + kind, deck)
        error = np.abs(results.element(kind, "S") + 2.0 * np.array([1, 1, 1, 0, 0, 0])).max()
        close(error, 0.0, 1e-8, "%s: stress under pressure from all sides" % kind)
        close(np.abs(results.node("RF")).max(), 0.0, 1e-8, "%s: reactions" % kind)


def bending(runner):
    """A cantilever under its own weight: Timoshenko's beam, no lateral contraction. Linear tetrahedra lock: half of it is what they
    have to reach. (A single row of C3D20R would have a mode without energy in every element: two rows.)"""
    length, height, young, weight = 10.0, 1.0, 1e5, 2.0
    expected = weight * length**4 * 12.0 / (8.0 * young) + 1.2 * weight * length**2 / (2.0 * young / 2.0)
    tolerance = {"C3D20R": 2e-3, "C3D20": 2e-3, "C3D15": 1e-2, "C3D10": 1e-2, "C3D8I": 5e-3, "C3D4": 0.5}
    for kind in KINDS:
        counts = {"C3D8I": (20, 1, 2), "C3D20R": (10, 2, 2), "C3D4": (20, 2, 2)}.get(kind, (10, 1, 1))
        deck = solid(kind, counts, (length, height, 1.0))
        deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
        tip = deck.where(lambda x, y, z: x > length - 1e-9)
        deck.add(MATERIAL % (young, 0.0, 0.5))
        deck.add(STATIC % "*BOUNDARY\nROOT, 1, 3\n*DLOAD\nALL, GRAV, 4., 0., 0., -1.")
        results = runner.run("bending_" + kind, deck)
        deflection = -np.mean([results.at(n, "U")[2] for n in tip])
        close(deflection, expected, tolerance[kind], "%s: deflection of the tip" % kind)
        # Weight of the nodes of the root is carried by them alone: RF has it all the same.
        close(sum(results.at(n, "RF")[2] for n in deck.sets["ROOT"]), weight * length, 1e-9, "%s: weight" % kind)


def spinning(runner):
    """A bar that turns about the axis through its end: u = rho omega^2 L^3 / (3 E) at the tip. Exact in the nodes where masses are
    consistent."""
    for kind, tolerance in (("C3D20R", 1e-9), ("C3D20", 1e-9), ("C3D10", 1e-3)):
        deck = solid(kind, (4, 1, 1), (2.0, 0.5, 0.5))
        deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
        deck.sets["SIDES"] = deck.where(lambda x, y, z: True)
        tip = deck.where(lambda x, y, z: x > 2.0 - 1e-9)
        deck.add(MATERIAL % (1000.0, 0.0, 0.3))
        deck.add(STATIC % "*BOUNDARY\nROOT, 1, 1\nSIDES, 2, 3\n*DLOAD\nALL, CENTRIF, 2., 0., 0., 0., 0., 1., 0.")
        results = runner.run_alike("spinning_" + kind, deck)
        expected = 0.3 * 2.0 * 8.0 / (3.0 * 1000.0)
        close(np.mean([results.at(n, "U")[0] for n in tip]), expected, tolerance, "%s: elongation" % kind)


def lagrange(places, i, x):
    """The polynomial that is 1 at places[i] and 0 at the others, at x."""
    return math.prod((x - place) / (places[i] - place) for k, place in enumerate(places) if k != i)


def at_corner(points, corner):
    """Of values at n x n x n Gauss points, the first coordinate running fastest, the polynomial through them at a corner of signs."""
    places = {8: (-math.sqrt(1 / 3), math.sqrt(1 / 3)), 27: (-math.sqrt(0.6), 0.0, math.sqrt(0.6))}[len(points)]
    n = len(places)
    value = np.zeros(points.shape[1:])
    for q in range(len(points)):
        value += math.prod(lagrange(places, i, x) for i, x in zip((q % n, q // n % n, q // n // n), corner)) * points[q]
    return value


def le10(runner):
    """NAFEMS LE10: a thick elliptic plate under pressure, -5.38 MPa across the symmetry plane at its inner edge, extrapolated
    from the points of the corner element."""
    def place(r, s, t):
        angle = 0.5 * math.pi * s
        return ((2.0 + 1.25 * r) * math.cos(angle), (1.0 + 1.75 * r) * math.sin(angle), 0.6 * t)

    for kind, n, tolerance in (("C3D20R", 1, 0.04), ("C3D20R", 3, 0.03), ("C3D20", 3, 0.01)):
        counts = (2 * n, 3 * n, 2 * n)
        unit = solid(kind, counts, (1.0, 1.0, 1.0))
        deck = solid(kind, counts, (1.0, 1.0, 1.0), place)
        deck.sets["DC"] = unit.where(lambda r, s, t: s < 1e-9)
        deck.sets["AB"] = unit.where(lambda r, s, t: s > 1.0 - 1e-9)
        deck.sets["RIM"] = unit.where(lambda r, s, t: r > 1.0 - 1e-9)
        deck.sets["MIDDLE"] = unit.where(lambda r, s, t: r > 1.0 - 1e-9 and abs(t - 0.5) < 1e-9)
        top = [i for i, _ in deck.elements[kind]][-counts[0] * counts[1]:]
        deck.add("*ELSET, ELSET=TOP\n" + ",\n".join(map(str, top)))
        deck.add(MATERIAL % (210e9, 0.3, 7800.0))
        deck.add("*STEP\n*STATIC\n*BOUNDARY\nDC, 2, 2\nAB, 1, 1\nRIM, 1, 2\nMIDDLE, 3, 3\n*DLOAD\nTOP, P2, 1e6\n*OUTPUT, FIELD, "
                 "PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT, POSITION=INTEGRATION POINTS\nS\n*END STEP")
        results = runner.run("le10_%s_%d" % (kind, n), deck)
        points = results.element(kind, "S_IP")[top[0] - 1]
        close(at_corner(points, (-1, -1, 1))[1], -5.38e6, tolerance, "%d x %d x %d %s: stress at D" % (*counts, kind))


def modes(runner):
    """The lowest two bending pairs of a cantilever, Euler's beam less the shear and rotary inertia of Timoshenko's."""
    length, side, young, rho = 20.0, 1.0, 1e5, 2.0
    for kind, tolerance in (("C3D20R", 3e-3), ("C3D20", 5e-3), ("C3D10", 1e-2)):
        deck = solid(kind, (12, 2, 2) if kind == "C3D20R" else (12, 1, 1), (length, side, side))
        deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
        deck.add(MATERIAL % (young, 0.0, rho))
        deck.add("*BOUNDARY\nROOT, 1, 3\n*STEP\n*FREQUENCY\n4\n*END STEP")
        results = runner.run("modes_" + kind, deck)
        found = [results.file["step_1/mode_%d" % k].attrs["frequency"] for k in (1, 2, 3, 4)]
        inertia, area = side**4 / 12.0, side**2
        for pair, root in ((0, 1.87510407), (1, 4.69409113)):
            euler = root**2 / (2.0 * math.pi * length**2) * math.sqrt(young * inertia / (rho * area))
            # Both corrections to first order for a wave of that root: (k r)^2 / 2 (1 + E / (kappa G)).
            slender = 0.5 * (root / length) ** 2 * inertia / area * (1.0 + 2.0 * 1.2)
            for k in (0, 1):
                close(found[2 * pair + k], euler * (1.0 - slender), tolerance if pair == 0 else 3 * tolerance,
                      "%s: frequency of mode %d" % (kind, 2 * pair + k + 1))


def falling(runner):
    """Explicit: a free block falls without strain, and a bar that is let go rings at its frequency without loss of energy."""
    for kind in ("C3D10", "C3D4", "C3D8I"):
        deck = solid(kind, (2, 1, 1), (2.0, 1.0, 1.0))
        deck.add(MATERIAL % (1000.0, 0.3, 1e-3))
        deck.add("*STEP\n*DYNAMIC, EXPLICIT\n, 0.02\n*DLOAD\nALL, GRAV, 10., 0., 0., -1.\n" + OUTPUT.replace("FREQUENCY=1", "NUMBER INTERVAL=1")
                 + "*END STEP")
        results = runner.run_alike("falling_" + kind, deck)
        close(results.node("U")[:, 2].max(), -0.5 * 10.0 * 0.02**2, 1e-8, "%s: fall, the least" % kind)
        close(results.node("U")[:, 2].min(), -0.5 * 10.0 * 0.02**2, 1e-8, "%s: fall, the most" % kind)

        deck = solid(kind, (24, 1, 1), (8.0, 0.5, 0.5))
        deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
        deck.sets["TIP"] = deck.where(lambda x, y, z: x > 8.0 - 1e-9)
        deck.sets["ALLNODES"] = sorted(deck.nodes)
        deck.add(MATERIAL % (1000.0, 0.0, 1e-3))
        deck.add("*STEP\n*STATIC\n*BOUNDARY\nROOT, 1, 1\nALLNODES, 2, 3\nTIP, 1, 1, 0.008\n" + OUTPUT + "*END STEP")
        deck.add("*STEP\n*DYNAMIC, EXPLICIT\n, 0.034\n*BULK VISCOSITY\n0., 0.\n*BOUNDARY, OP=NEW\nROOT, 1, 1\nALLNODES, 2, 3\n"
                 "*OUTPUT, HISTORY, TIME INTERVAL=0.0002\n*ENERGY OUTPUT\nALLKE, ALLIE, ETOTAL\n*NODE OUTPUT, NSET=TIP\nU1\n*END STEP")
        results = runner.run("ringing_" + kind, deck)
        energy = results.file["step_2/history/energy"]
        drift = np.abs(energy["ETOTAL"][:] - energy["ETOTAL"][0]).max() / energy["ALLIE"][0]
        close(drift, 0.0, 1e-3, "%s: drift of the energy" % kind)
        # Let go from a uniform strain the tip's way over time is a zigzag of period 4 L / c; it is back at 4 L / c = 0.032.
        tip = results.file["step_2/history/node_%d/U1" % deck.sets["TIP"][0]][:]
        time = results.file["step_2/history/node_%d/time" % deck.sets["TIP"][0]][:]
        back = np.interp(time[0] + 0.032, time, tip)
        close(back, 0.008, 0.06, "%s: the tip after a period" % kind)


def main():
    case, program, folder = sys.argv[1:4]
    {"pressed": pressed, "bending": bending, "spinning": spinning, "le10": le10, "modes": modes, "falling": falling}[case](
        Runner(program, folder))


if __name__ == "__main__":
    main()
