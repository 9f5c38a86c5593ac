"""Natural modes against closed forms of the same discrete system, through the whole program on one and two ranks:
frequency_cases.py CASE PROGRAM FOLDER. Lumped masses make the sums exact, so tolerances are those of the solver."""
import math
import sys

import numpy as np

from static_cases import ELASTIC
from static_model import OUTPUT, Deck, Runner, brick, close

YOUNG, AREA, DENSITY = 200.0, 0.5, 0.01
ROD = "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n%g\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.\n*DENSITY\n%g" % (AREA, YOUNG, DENSITY)
MODES = "*STEP, PERTURBATION\n*FREQUENCY%s\n%s\n%s*END STEP"


def modes(results, step):
    group = results.file["step_%d" % step]
    names = sorted((n for n in group if n.startswith("mode_")), key=lambda n: int(n[5:]))
    return [group[n] for n in names]


def frequencies(results, step=1):
    return [mode.attrs["frequency"] for mode in modes(results, step)]


def run_alike(runner, name, deck, step):
    """One and two ranks: the same frequencies."""
    one, two = runner.run(name, deck, 1), runner.run(name, deck, 2)
    largest = max(abs(mode.attrs["eigenvalue"]) for mode in modes(one, step))
    for a, b in zip(modes(one, step), modes(two, step), strict=True):
        assert abs(a.attrs["eigenvalue"] - b.attrs["eigenvalue"]) <= 1e-8 * largest, "ranks differ"
    return one


def rod(count, length):
    deck = Deck()
    for i in range(count + 1):
        deck.add_node(i + 1, length * i / count, 0.0, 0.0)
    deck.elements["T3D2"] = [(i + 1, [i + 1, i + 2]) for i in range(count)]
    deck.sets["NALL"] = list(deck.nodes)
    deck.add(ROD)
    return deck


def free_bar(runner):
    """A bar free at both ends, its nodes on a line: f_k = sqrt(k / m) sin(k pi / 2n) / pi with half masses at the ends; the first
    mode is the rigid motion and carries all the mass."""
    count, length = 12, 6.0
    deck = rod(count, length)
    deck.add(MODES % (", NORMALIZATION=MASS", "5", "*BOUNDARY\nNALL, 2, 3\n"))
    results = run_alike(runner, "bar", deck, 1)
    spacing = length / count
    scale = math.sqrt(YOUNG * AREA / spacing / (DENSITY * AREA * spacing)) / math.pi
    found = frequencies(results)
    assert len(found) == 5
    close(found[0] / scale, 0.0, 1e-6, "rigid motion")
    for k in range(1, 5):
        close(found[k], scale * math.sin(k * math.pi / (2 * count)), 1e-9, "mode %d" % (k + 1))
    mass = DENSITY * AREA * length
    close(modes(results, 1)[0].attrs["effective_mass"][0], mass, 1e-9, "effective mass of the rigid motion")
    close(modes(results, 1)[0].attrs["participation"][0], math.sqrt(mass), 1e-9, "its participation")
    close(modes(results, 1)[1].attrs["effective_mass"][0] / mass, 0.0, 1e-9, "effective mass of the second mode")
    for mode in modes(results, 1):
        close(mode.attrs["generalized_mass"], 1.0, 1e-12, "generalised mass")


def string(runner):
    """A string pulled tight: f_k = sqrt(T / m h) sin(k pi / 2n) / pi, h the spacing of the stretched string, twice each (two planes).
    The perturbation leaves the state alone: the static step behind it takes the pull back to nothing."""
    count, length, stretch = 16, 8.0, 0.4
    deck = rod(count, length)
    deck.sets["MIDDLE"] = list(range(2, count + 1))
    ends = "*BOUNDARY\n1, 1, 3\n%d, 2, 3\n%d, 1, 1, %g\nMIDDLE, 2, 3\n" % (count + 1, count + 1, stretch)
    deck.add("*STEP, NLGEOM\n*STATIC\n" + ends + OUTPUT + "*END STEP")
    deck.add(MODES % ("", "6", "*BOUNDARY, OP=NEW\n1, 1, 3\n%d, 1, 3\n" % (count + 1)))
    deck.add("*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n%d, 1, 1, 0.\n" % (count + 1) + OUTPUT + "*END STEP")
    results = run_alike(runner, "string", deck, 2)
    tension = results.at(count + 1, "RF")[0]
    spacing, mass = (length + stretch) / count, DENSITY * AREA * length / count
    for i, found in enumerate(frequencies(results, 2)):
        expected = math.sqrt(tension / (mass * spacing)) * math.sin((i // 2 + 1) * math.pi / (2 * count)) / math.pi
        close(found, expected, 1e-7, "mode %d" % (i + 1))  # the state stands at 1e-9 of the forces
    shape = modes(results, 2)[0]["node/U"][:]
    close(np.abs(shape).max(), 1.0, 1e-12, "largest displacement")
    close(np.abs(shape[[results.row[n] for n in (1, count + 1)]]).max(), 0.0, 1e-14, "ends")
    close(np.abs(results.node("U", 3)).max() / stretch, 0.0, 1e-8, "displacement when let go")


def hanging(gravity):
    """A weight on a rigid arm of length 2 with rotary inertia about the pivot, in static equilibrium."""
    deck = Deck()
    deck.add_node(1, 0.0, 0.0, 0.0)
    deck.add_node(2, 0.0, 0.0, -2.0)
    deck.elements["MASS"] = [(1, [2])]
    deck.add("*ELEMENT, TYPE=ROTARYI, ELSET=TURNING\n2, 1\n*ROTARY INERTIA, ELSET=TURNING\n0.5, 0.7, 0.2")
    deck.add("*NSET, NSET=BOB\n2\n*MASS, ELSET=ALL\n3.\n*RIGID BODY, REF NODE=1, PIN NSET=BOB")
    deck.add("*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n1, 1, 3\n1, 6, 6\n*DLOAD\nALL, GRAV, %g, 0., 0., -1.\n" % gravity + "*END STEP")
    deck.add(MODES % ("", "2", ""))
    return deck


def pendulum(runner):
    """omega^2 = m g L / (J + m L^2) about either axis."""
    results = run_alike(runner, "pendulum", hanging(9.81), 2)
    for found, inertia in zip(frequencies(results, 2), (0.7, 0.5), strict=True):
        close(found, math.sqrt(3.0 * 9.81 * 2.0 / (inertia + 3.0 * 4.0)) / (2 * math.pi), 1e-9, "frequency")
    assert "the state is stable" in results.log, results.log


def upside_down(runner):
    """The pendulum on its head: omega^2 = -m g L / (J + m L^2), told as an instability."""
    results = run_alike(runner, "upside_down", hanging(-9.81), 2)
    for mode, inertia in zip(modes(results, 2), (0.5, 0.7), strict=True):
        close(mode.attrs["eigenvalue"], -3.0 * 9.81 * 2.0 / (inertia + 3.0 * 4.0), 1e-9, "eigenvalue")
        assert mode.attrs["frequency"] == 0.0
    assert "the state is unstable: 2 of its eigenvalues are negative" in results.log, results.log


def bounds(runner):
    """Of a fixed bar, f_k = sqrt(k / m) sin((2k - 1) pi / 4n) / pi, those in a range; at most so many; around a shift."""
    count, length = 12, 6.0
    spacing = length / count
    scale = math.sqrt(YOUNG * AREA / spacing / (DENSITY * AREA * spacing)) / math.pi
    exact = [scale * math.sin((2 * k - 1) * math.pi / (4 * count)) for k in range(1, count + 1)]
    between = "%.9g, %.9g" % (0.5 * (exact[1] + exact[2]), 0.5 * (exact[6] + exact[7]))
    for i, (options, line, expected) in enumerate((("", ", " + between, exact[2:7]), ("", "3, " + between, exact[2:5]),
                                                   (", EIGENSOLVER=SUBSPACE", "4", exact[:4]),
                                                   ("", "3, , , %.9g" % exact[5] ** 2.1, exact[:3]))):
        deck = rod(count, length)
        deck.add(MODES % (options, line, "*BOUNDARY\nNALL, 2, 3\n1, 1, 1\n"))
        found = frequencies(run_alike(runner, "bounds_%d" % i, deck, 1))
        assert len(found) == len(expected), "%s: %d modes" % (line, len(found))
        for a, b in zip(found, expected):
            close(a, b, 1e-9, "frequency for %s" % line)


def free_cube(runner):
    """A cube in the air: six rigid motions, which carry its mass and, in all, its inertia; the rest moves against itself."""
    for kind in ("C3D8", "C3D8R"):
        deck = brick((3, 3, 3), (1.0, 1.0, 1.0), kind, lambda x, y, z: (x - 0.5, y - 0.5, z - 0.5))
        deck.add(ELASTIC.format(young=1000.0, poisson=0.3).rstrip() + "\n*DENSITY\n2.")
        deck.add(MODES % ("", "9", ""))
        results = run_alike(runner, "cube_" + kind, deck, 1)
        found = modes(results, 1)
        for mode in found[:6]:
            close(mode.attrs["eigenvalue"] / found[6].attrs["eigenvalue"], 0.0, 1e-6, "rigid motion")
        total = sum(mode.attrs["effective_mass"][:] for mode in found[:6])
        # Lumped masses of 3 cells a side: sum of m x^2 = M (1/4 * 1/3 + 1/36 * 2/3).
        inertia = 2.0 * 2.0 * (0.25 / 3.0 + 1.0 / 54.0)
        for value, expected in zip(total, [2.0] * 3 + [inertia] * 3):
            close(value, expected, 1e-8, "effective mass of all rigid motions")
        close(np.abs(found[6].attrs["effective_mass"][:3]).max(), 0.0, 1e-8, "effective mass of the first that deforms")


def cantilever_modes(runner):
    """Bending of a slender cantilever, f = (1.8751^2, 4.6941^2) sqrt(E I / m L^4) / 2 pi in both planes, to what 40 reduced bricks
    with assumed bending strain and the shear that the formula leaves out are good for."""
    length, depth, width, young, density = 20.0, 0.5, 0.4, 1e6, 1e-3
    deck = brick((40, 1, 1), (length, width, depth))
    deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
    deck.add(ELASTIC.format(young=young, poisson=0.0).rstrip() + "\n*DENSITY\n%g" % density)
    deck.add(MODES % ("", "4", "*BOUNDARY\nROOT, 1, 3\n"))
    found = frequencies(run_alike(runner, "cantilever", deck, 1))
    formula = lambda root, thickness: root**2 / length**2 * math.sqrt(young * thickness**2 / 12.0 / density) / (2 * math.pi)
    for got, expected in zip(found, (formula(1.8751, width), formula(1.8751, depth), formula(4.6941, width), formula(4.6941, depth))):
        close(got, expected, 2e-2, "frequency")


def strip(count, length, width, thickness, held):
    """S4R in a row along x, without Poisson's ratio."""
    deck = Deck()
    for i in range(count + 1):
        for side in range(2):
            deck.add_node(2 * i + side + 1, length * i / count, width * side, 0.0)
    deck.elements["S4R"] = [(i + 1, [2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2]) for i in range(count)]
    deck.sets["NALL"] = list(deck.nodes)
    deck.sets["ROOT"] = [1, 2]
    deck.sets["ENDS"] = [1, 2, 2 * count + 1, 2 * count + 2]
    deck.add("*SHELL SECTION, ELSET=ALL, MATERIAL=M\n%g\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.\n*DENSITY\n%g" % (
        thickness, YOUNG, DENSITY))
    deck.add(MODES % ("", "3", "*BOUNDARY\n" + held))
    return deck


def strip_stretched(runner):
    """A strip of shells held at one end, its drilling rotations free: the modes of a chain of masses, none of rotations, which have
    no inertia about the normal: f_k = sqrt(k / m) sin((2k - 1) pi / 4n) / pi."""
    count, length = 8, 8.0
    results = run_alike(runner, "strip_stretched", strip(count, length, 1.0, 0.1, "NALL, 2, 5\nROOT, 1, 1\n"), 1)
    scale = math.sqrt(YOUNG / DENSITY) * count / length / math.pi
    for k, found in enumerate(frequencies(results), 1):
        close(found, scale * math.sin((2 * k - 1) * math.pi / (4 * count)), 1e-9, "mode %d" % k)


def strip_bent(runner):
    """A wide strip of shells on two supports bends like a beam, f_k = (k pi / L)^2 sqrt(E h^2 / 12 rho) / 2 pi, to what 32 elements
    are good for; the rotary inertia, h^2 k^2 pi^2 / 24 L^2 of it, is nothing in a thin one."""
    length, thickness = 16.0, 0.1
    results = run_alike(runner, "strip_bent", strip(32, length, 4.0, thickness, "NALL, 1, 2\nNALL, 4, 4\nNALL, 6, 6\nENDS, 3, 3\n"), 1)
    for k, found in enumerate(frequencies(results), 1):
        formula = (k * math.pi / length) ** 2 * math.sqrt(YOUNG * thickness**2 / 12.0 / DENSITY) / (2 * math.pi)
        close(found, formula, 1e-2, "mode %d" % k)


def strip_buckled(runner):
    """The strip between two supports, pressed by 2.5 of its Euler loads: one mode grows, omega^2 = (k pi / L)^2 (D (k pi / L)^2 - N)
    / rho h, k = 1; those that drilling without inertia adds, infinite but for rounding, are not among the modes."""
    count, length, thickness = 32, 16.0, 0.1
    deck = strip(count, length, 1.0, thickness, "NALL, 2, 2\nNALL, 4, 4\nENDS, 3, 3\nROOT, 1, 1\n")
    stiffness = YOUNG * thickness**3 / 12.0
    press = 2.5 * stiffness * (math.pi / length) ** 2
    ends = "".join("%d, 1, %.17g\n" % (node, -0.5 * press) for node in deck.sets["ENDS"][2:])
    free = deck.text.pop().replace("*BOUNDARY", "*BOUNDARY, OP=NEW")
    deck.add("*STEP, NLGEOM\n*STATIC\n*BOUNDARY\nNALL, 2, 5\nROOT, 1, 1\n*CLOAD\n" + ends + "*END STEP")
    deck.add(free)
    results = run_alike(runner, "strip_buckled", deck, 2)
    found = [mode.attrs["eigenvalue"] for mode in modes(results, 2)]
    for k, value in enumerate(found, 1):
        wave = (k * math.pi / length) ** 2
        close(value, wave * (stiffness * wave - press) / (DENSITY * thickness), 2e-2, "eigenvalue %d" % k)


def euler_column(runner):
    """Load factors of a clamped column, extrapolated from two meshes: Euler's with shear, uniform in the one element across, and with
    the stress in the stiffness along it, P / (1 + P / G A + P / E A); both ways across alike, and of three quarters of a wave."""
    young, length, width = 1000.0, 20.0, 1.0
    factors = []
    for count, ranks in ((30, 1), (60, 2)):
        deck = brick((count, 1, 1), (length, width, width), "C3D8I")
        deck.sets.update(FOOT=deck.where(lambda x, y, z: x == 0.0), TOP=deck.where(lambda x, y, z: x == length))
        deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0." % young)
        deck.add("*STEP\n*BUCKLE\n4\n*BOUNDARY\nFOOT, 1, 3\n*CLOAD\nTOP, 1, -0.25\n*END STEP")
        factors.append([mode.attrs["eigenvalue"] for mode in modes(runner.run("column_%d" % count, deck, ranks), 1)])
    for k in range(4):
        euler = ((1 + 2 * (k // 2)) * math.pi / (2.0 * length)) ** 2 * young * width**4 / 12.0
        close((4.0 * factors[1][k] - factors[0][k]) / 3.0, euler / (1.0 + 3.0 * euler / (young * width**2)), 3e-4, "load factor %d" % (k + 1))


def shaft(runner):
    """Torsion of a round beam held at one end, its nodes with the polar inertia of the section, which is its torsion constant:
    f_k = sqrt(G / rho) / (h pi) sin((2k - 1) pi / 4n)."""
    count, length, radius = 8, 16.0, 0.2
    deck = Deck()
    for i in range(count + 1):
        deck.add_node(i + 1, length * i / count, 0.0, 0.0)
    deck.elements["B31"] = [(i + 1, [i + 1, i + 2]) for i in range(count)]
    deck.sets["NALL"] = list(deck.nodes)
    deck.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=CIRC\n%g\n0., 0., 1.\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.25\n*DENSITY\n%g" % (
        radius, YOUNG, DENSITY))
    deck.add(MODES % ("", "3", "*BOUNDARY\nNALL, 1, 3\nNALL, 5, 6\n1, 4, 4\n"))
    results = run_alike(runner, "shaft", deck, 1)
    scale = math.sqrt(YOUNG / 2.5 / DENSITY) * count / length / math.pi
    for k, found in enumerate(frequencies(results), 1):
        close(found, scale * math.sin((2 * k - 1) * math.pi / (4 * count)), 1e-9, "mode %d" % k)


def heavy_end(runner):
    """A shaft twists with a rigid body at its end, whose reference node is the shaft's and has a rotary inertia: that counts once."""
    length, radius, inertia = 10.0, 1.0, 50.0
    deck = Deck()
    for number, x in enumerate(((0.0, 0.0), (length, 0.0), (length, 2.0)), 1):
        deck.add_node(number, *x, 0.0)
    deck.elements["B31"] = [(1, (1, 2))]
    deck.add("""*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=CIRC
%g
0., 1., 0.
*MATERIAL, NAME=M
*ELASTIC
210000., 0.3
*DENSITY
1e-12
*ELEMENT, TYPE=MASS, ELSET=MASS
11, 2
*MASS, ELSET=MASS
2.
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIA
12, 2
*ROTARY INERTIA, ELSET=INERTIA
%g, %g, %g
*NSET, NSET=CARRIED
3
*RIGID BODY, REF NODE=2, TIE NSET=CARRIED
*STEP
*FREQUENCY
1
*BOUNDARY
1, 1, 6
2, 1, 3
2, 5, 6
*END STEP""" % (radius, inertia, inertia, inertia))
    rate = 210000.0 / 2.6 * 0.5 * math.pi * radius**4 / length
    close(frequencies(run_alike(runner, "heavy_end", deck, 1))[0], math.sqrt(rate / inertia) / (2.0 * math.pi), 1e-9, "frequency")


def sliding(runner):
    """A block that slides on the ground sticks where it is in its modes: they are those of a block whose sole is held, but for the
    springs of the contact, ten times as stiff as a layer of bricks, and nothing is left out of its stiffness as unsymmetric."""
    found = {}
    for sole, friction in (("held", 0.1), ("sticks", 0.1), ("is smooth", 0.0)):
        deck = brick((2, 2, 2), (1.0, 1.0, 1.0))
        deck.sets["TOP"] = deck.where(lambda x, y, z: y > 0.9)
        deck.sets["SOLE"] = deck.where(lambda x, y, z: y < 0.1)
        deck.add_node(9000, 0.0, 0.0, 0.0)
        deck.add(ELASTIC.format(young=100.0, poisson=0.0).rstrip() + "\n*DENSITY\n2.")
        deck.add("*ELSET, ELSET=LOW\n1, 2, 5, 6\n*SURFACE, NAME=SLAVE\nLOW, S3\n*SURFACE, NAME=GROUND, TYPE=SEGMENTS\nSTART, -9., 0.\n"
                 "LINE, 9., 0.\n*RIGID BODY, REF NODE=9000, ANALYTICAL SURFACE=GROUND\n*SURFACE INTERACTION, NAME=I\n"
                 "*FRICTION\n%g\n*CONTACT PAIR, INTERACTION=I\nSLAVE, GROUND\n*BOUNDARY\n9000, 1, 6" % friction)
        deck.add("*STEP, NLGEOM\n*STATIC\n0.25, 1.\n*BOUNDARY\nTOP, 3, 3\nTOP, 1, 1, 0.2\nTOP, 2, 2, -0.05" + OUTPUT + "*END STEP")
        deck.add(MODES % ("", "3", "*BOUNDARY\nSOLE, 1, 3\n" if sole == "held" else ""))
        results = run_alike(runner, "sliding_" + sole[0:2], deck, 2)
        found[sole] = frequencies(results, 2)
        assert "not symmetric" not in results.log, results.log
        assert "the state is stable" in results.log, results.log
        if sole == "sticks":
            shear, press = np.abs(results.at(9000, "RF", 1)[:2])
            close(shear / press, friction, 1e-3, "it slides")
    for sticks, held in zip(found["sticks"], found["held"]):
        assert 0.97 * held < sticks < held, (sticks, held)
    assert found["is smooth"][0] < 0.7 * found["held"][0], found


def springs_buckled(runner):
    """A bar between springs across its ends that one of 5 bears, k L / 1, and a square sheet whose corners springs of 0.25 bear across, under
    a shear of 0.5, k / 0.5: the stress that stiffens a bar or a sheet has one or three components of the six that are shown."""
    bar = Deck()
    bar.nodes = {1: (0.0, 0.0, 0.0), 2: (2.0, 0.0, 0.0)}
    bar.elements = {"T3D2": [(1, (1, 2))], "SPRING1": [(2, (2,))]}
    bar.add("*ELSET, ELSET=BAR\n1\n*ELSET, ELSET=SPRINGS\n2\n*SPRING, ELSET=SPRINGS\n2\n5.\n*SOLID SECTION, ELSET=BAR, MATERIAL=M\n0.5\n"
            "*MATERIAL, NAME=M\n*ELASTIC\n1e6, 0.\n*BOUNDARY\n1, 1, 3\n2, 3, 3\n*STEP\n*BUCKLE\n1\n*CLOAD\n2, 1, -1.\n*END STEP")
    sheet = Deck()
    sheet.nodes = {1: (0.0, 0.0, 0.0), 2: (1.0, 0.0, 0.0), 3: (1.0, 1.0, 0.0), 4: (0.0, 1.0, 0.0)}
    sheet.elements = {"M3D4": [(1, (1, 2, 3, 4))], "SPRING1": [(1 + n, (n,)) for n in range(1, 5)]}
    sheet.add("*ELSET, ELSET=SHEET\n1\n*ELSET, ELSET=SPRINGS\n2, 3, 4, 5\n*SPRING, ELSET=SPRINGS\n3\n0.25\n*MEMBRANE SECTION, ELSET=SHEET, MATERIAL=M\n1.\n"
              "*MATERIAL, NAME=M\n*ELASTIC\n1e6, 0.\n*BOUNDARY\n1, 1, 2\n2, 2, 2\n*STEP\n*BUCKLE\n1\n*CLOAD\n" +
              "".join("%d, %d, %g\n" % (n, k, 0.25 * (1 if x[2 - k] > 0.5 else -1)) for n, x in sheet.nodes.items() for k in (1, 2)) + "*END STEP")
    for name, deck, factor in (("bar", bar, 10.0), ("sheet", sheet, 0.5)):
        for ranks in (1, 2):
            close(modes(runner.run(name + "_on_springs", deck, ranks), 1)[0].attrs["eigenvalue"], factor, 1e-5, "load factor of a " + name)


def tied_column(runner):
    """A column of two blocks that are tied, whose multipliers take pivots that MUMPS had not foreseen. Meshes that match: the modes of one
    block. A finer mesh on a coarser one: the load factor of CalculiX 2.20 for the same deck (its C3D8I are like ours, but not the same)."""
    def column(upper):
        deck = brick((2, 2, 2 if upper else 4), (1.0, 1.0, 2.0 if upper else 4.0), "C3D8I")
        if upper:
            above = brick((upper, upper, 2), (1.0, 1.0, 2.0), "C3D8I", lambda x, y, z: (x, y, z + 2.0), 1001, 1001)
            deck.nodes.update(above.nodes)
            deck.elements["C3D8I"] += above.elements["C3D8I"]
            deck.add("*ELSET, ELSET=LOWER, GENERATE\n1, 8\n*ELSET, ELSET=UPPER, GENERATE\n1001, %d" % (1000 + len(above.elements["C3D8I"])))
            deck.add("*SURFACE, NAME=MASTER\nLOWER, S2\n*SURFACE, NAME=SLAVE\nUPPER, S1\n*TIE, NAME=GLUE, POSITION TOLERANCE=0.01\nSLAVE, MASTER")
        deck.sets.update(FOOT=deck.where(lambda x, y, z: z == 0.0), TOP=deck.where(lambda x, y, z: z == 4.0))
        deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n*BOUNDARY\nFOOT, 1, 3")
        deck.add("*STEP\n*FREQUENCY\n4\n*END STEP\n*STEP\n*BUCKLE\n1\n*CLOAD\nTOP, 3, -1.\n*END STEP")
        return deck

    whole, matching = runner.run("whole", column(0)), run_alike(runner, "matching", column(2), 1)
    for step in (1, 2):
        for one, two in zip(modes(whole, step), modes(matching, step), strict=True):
            close(two.attrs["eigenvalue"], one.attrs["eigenvalue"], 1e-9, "step %d: eigenvalue of the blocks tied" % step)
    for ranks in (1, 2):
        finer = runner.run("finer", column(3), ranks)
        close(modes(finer, 2)[0].attrs["eigenvalue"], 169.1926, 1e-3, "load factor")


def held(runner):
    """A model whose every freedom is held, by conditions or by a constraint behind them, is told as such."""
    tied = "*EQUATION\n2\n2, 1, 1., 1, 1, -1."
    for constraint, held_nodes, told in (("", "NALL, 1, 3\n", "by *BOUNDARY: nothing can vibrate"),
                                         (tied, "NALL, 2, 3\n1, 1\n", "by *BOUNDARY, equations, ties or connectors: nothing can vibrate")):
        for ranks in (1, 2):
            deck = rod(2, 1.0)
            deck.add(constraint)
            deck.add(MODES % ("", "1", "*BOUNDARY\n3, 1\n" + held_nodes))
            done, _ = runner.launch("held", deck, ranks)
            assert done.returncode == 3, done.stdout + done.stderr
            assert (done.stdout + done.stderr).count(told) == 1, done.stdout + done.stderr


CASES = {case.__name__: case for case in (free_bar, string, pendulum, upside_down, bounds, free_cube, strip_stretched, strip_bent,
                                                strip_buckled, euler_column, springs_buckled, tied_column, shaft, heavy_end, sliding, held)}
CASES["cantilever"] = cantilever_modes

if __name__ == "__main__":
    CASES[sys.argv[1]](Runner(sys.argv[2], sys.argv[3]))
