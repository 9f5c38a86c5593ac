"""Static cases with known answers, through the whole program on one and two ranks:
static_cases.py CASE PROGRAM FOLDER. Sources of the numbers stand with each case."""
import math
import sys

import numpy as np

from static_model import OUTPUT, Deck, Runner, brick, close

ELASTIC = """
*SOLID SECTION, ELSET=ALL, MATERIAL=M
*MATERIAL, NAME=M
*ELASTIC
{young}, {poisson}
*DENSITY
1e-9
"""


def patch(runner, kind):
    """Irregular bricks whose outer nodes follow an affine map: the inner ones must too, whatever the law, to round-off."""
    deck = brick((3, 3, 3), (1.0, 1.0, 1.0), kind)
    generator = np.random.default_rng(7)
    inner = deck.where(lambda x, y, z: all(0.1 < c < 0.9 for c in (x, y, z)))
    for n in inner:
        deck.nodes[n] = tuple(np.array(deck.nodes[n]) + generator.uniform(-0.08, 0.08, 3))
    gradient = np.array([[0.10, 0.05, -0.02], [0.03, -0.06, 0.04], [0.02, 0.01, 0.08]])
    deck.add(ELASTIC.format(young=100.0, poisson=0.3))
    deck.add("*STEP, NLGEOM\n*STATIC\n0.5, 1., 1e-5, 0.5\n*BOUNDARY")
    for n, x in deck.nodes.items():
        if n not in inner:
            for dof, u in enumerate(gradient @ np.array(x), 1):
                deck.add("%d, %d, %d, %.17g" % (n, dof, dof, u))
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("patch_" + kind.lower(), deck)
    for n in inner:
        error = np.abs(results.at(n, "U") - gradient @ np.array(deck.nodes[n])).max()
        close(error, 0.0, 1e-10, "node %d off the affine map" % n)
    stress = results.element(kind, "S")
    close(np.ptp(stress, axis=0).max() / np.abs(stress).max(), 0.0, 1e-9, "spread of stress")


def cantilever(length, depth, width, counts, kind="C3D8R"):
    deck = brick(counts, (length, width, depth), kind)
    deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
    deck.sets["TIP"] = deck.where(lambda x, y, z: x > length - 1e-9)
    deck.add_node(9001, length, 0.5 * width, 0.5 * depth)
    deck.add("*RIGID BODY, REF NODE=9001, TIE NSET=TIP")
    return deck


def elastica(runner):
    """Cantilever under a dead tip force P L^2 / EI = 4: w/L = 0.66996, u/L = 0.32894 (elastica by shooting). Slenderness 100 and
    nu = 0 leave shear and section deformation out; the mesh of 50 bricks is good for 0.5 %."""
    length, depth, width, young = 10.0, 0.1, 1.0, 1.2e6
    deck = cantilever(length, depth, width, (50, 1, 2))
    load = 4.0 * young * width * depth**3 / 12.0 / length**2
    deck.add(ELASTIC.format(young=young, poisson=0.0))
    deck.add("*STEP, NLGEOM\n*STATIC\n0.1, 1., 1e-5, 0.25\n*BOUNDARY\nROOT, 1, 3\n*CLOAD\n9001, 3, %.17g" % load)
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("elastica", deck)
    u = results.at(9001, "U")
    close(u[2] / length, 0.66996, 5e-3, "tip deflection w/L")
    close(-u[0] / length, 0.32894, 1e-2, "tip shortening u/L")
    reaction = sum(results.at(n, "RF")[2] for n in deck.sets["ROOT"])
    close(reaction, -load, 1e-8, "vertical reaction")


def rollup(runner):
    """The same strip bent by a turned end: a half circle, M = EI theta / L, tip where the arc ends. Bending strain t theta / 2L =
    1.6 % leaves about its square; prescribed rotation and free translations of a rigid body."""
    length, depth, width, young = 10.0, 0.1, 1.0, 1.2e6
    deck = cantilever(length, depth, width, (40, 1, 2))
    deck.add(ELASTIC.format(young=young, poisson=0.0))
    deck.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1., 1e-5, 0.2\n*BOUNDARY\nROOT, 1, 3\n9001, 5, 5, %.17g" % -math.pi)
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("rollup", deck)
    u, moment = results.at(9001, "U"), results.at(9001, "RM")[1]
    stiffness = young * width * depth**3 / 12.0
    close(moment, -stiffness * math.pi / length, 1e-2, "moment at half a circle")
    close(u[0], -length, 5e-3, "u = L (sin t / t - 1)")
    close(u[2], 2.0 * length / math.pi, 5e-3, "w = L (1 - cos t) / t")
    close(results.at(9001, "UR")[1], -math.pi, 1e-12, "rotation")


def rotation(runner):
    """A block whose two ends are rigid bodies that turn about one axis by 120 degrees: no stress, and the middle turns along."""
    deck = brick((4, 2, 2), (2.0, 1.0, 1.0))
    ends = {9001: deck.where(lambda x, y, z: x < 1e-9), 9002: deck.where(lambda x, y, z: x > 2.0 - 1e-9)}
    for reference, nodes in ends.items():
        deck.add_node(reference, 0.5, -1.0, 0.25)
        deck.sets["E%d" % reference] = nodes
        deck.add("*RIGID BODY, REF NODE=%d, TIE NSET=E%d" % (reference, reference))
    angle = 2.0 * math.pi / 3.0
    deck.add(ELASTIC.format(young=1000.0, poisson=0.3))
    deck.add("*STEP, NLGEOM\n*STATIC\n0.25, 1., 1e-5, 0.25\n*BOUNDARY")
    for reference in ends:
        deck.add("%d, 1, 5\n%d, 6, 6, %.17g" % (reference, reference, angle))
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("rotation", deck)
    turn = np.array([[math.cos(angle), -math.sin(angle), 0.0], [math.sin(angle), math.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    pivot = np.array([0.5, -1.0, 0.25])
    error = max(np.abs(results.at(n, "U") - (pivot + turn @ (np.array(x) - pivot) - x)).max() for n, x in deck.nodes.items())
    close(error, 0.0, 1e-9, "distance from the turned block")
    close(np.abs(results.element("C3D8R", "S")).max() / 1000.0, 0.0, 1e-9, "stress / E")


def release(runner):
    """A bar pulled by a prescribed motion that the next step takes away: the force fades linearly over that step."""
    deck = brick((4, 1, 1), (4.0, 1.0, 1.0))
    deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
    deck.sets["TIP"] = deck.where(lambda x, y, z: x > 4.0 - 1e-9)
    deck.add(ELASTIC.format(young=1000.0, poisson=0.0))
    pull = 1e-6  # strains of 2.5e-7: linear to that
    deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n*BOUNDARY\nROOT, 1, 3\nTIP, 1, 1, %g" % pull + OUTPUT + "*END STEP")
    deck.add("*STEP, NLGEOM\n*STATIC, DIRECT\n0.25, 1.\n*BOUNDARY, OP=NEW\nROOT, 1, 3" + OUTPUT + "*END STEP")
    results = runner.run_alike("release", deck)
    tip = deck.sets["TIP"][0]
    close(sum(results.at(n, "RF")[0] for n in deck.sets["TIP"]), 1000.0 * pull / 4.0, 1e-5, "pull")
    frames = results.frames(2)
    for frame in frames[-4:]:
        share = 1.0 - (frame.attrs["time"] - 1.0)
        close(frame["node/U"][results.row[tip]][0] / pull, share, 1e-5, "motion left at %g of the step" % (1.0 - share))


def linear(runner):
    """NLGEOM=NO: answers proportional to the load, and the cantilever of beam theory, P L^3 / 3EI + P L / (5/6 G A) with nu = 0
    (reduced bricks with assumed bending strain meet it within 2 % with 20 bricks)."""
    length, depth, width, young, load = 10.0, 1.0, 1.0, 1e5, 200.0
    tips = []
    for name, factor in (("linear", 1.0), ("linear_twice", 2.0)):
        deck = cantilever(length, depth, width, (20, 1, 2))
        deck.add(ELASTIC.format(young=young, poisson=0.0))
        deck.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\nROOT, 1, 3\n9001, 4, 4\n9001, 6, 6\n*CLOAD\n9001, 3, %g" % (factor * load))
        deck.add(OUTPUT + "*END STEP")
        results = runner.run_alike(name, deck)
        tips.append(results.at(9001, "U")[2])
        close(sum(results.at(n, "RF")[2] for n in deck.sets["ROOT"]), -factor * load, 1e-9, "reaction")
    inertia, area = width * depth**3 / 12.0, width * depth
    close(tips[0], load * length**3 / (3 * young * inertia) + load * length / (5.0 / 6.0 * young / 2.0 * area), 2e-2, "tip")
    close(tips[1] / tips[0], 2.0, 1e-9, "twice the load")


def hencky(runner):
    """Clamped circular membrane, nu = 0.3, blown up from flat and stress-free: w0 = 0.6533 a (p a / E t)^(1/3) (Hencky's series).
    At p a / E t = 1e-6 slopes are small, as the series wants; 12 rings of quadrilaterals are good for 1 %."""
    radius, thickness, young, pressure, rings, sectors = 1.0, 1e-3, 1e6, 1e-3, 12, 24
    deck = Deck()
    # A square core blends into circles, so that no element degenerates.
    half = 6
    core = {}
    for i in range(-half, half + 1):
        for j in range(-half, half + 1):
            s, t = i / half, j / half
            # The elliptical map of the square onto the disc.
            core[i, j] = 1 + (i + half) + (2 * half + 1) * (j + half)
            deck.add_node(core[i, j], radius * s * math.sqrt(1 - t * t / 2), radius * t * math.sqrt(1 - s * s / 2), 0.0)
    elements = deck.elements.setdefault("M3D4", [])
    for i in range(-half, half):
        for j in range(-half, half):
            elements.append((1 + len(elements), [core[i, j], core[i + 1, j], core[i + 1, j + 1], core[i, j + 1]]))
    deck.sets["RIM"] = deck.where(lambda x, y, z: math.hypot(x, y) > radius - 1e-9)
    deck.add("*MEMBRANE SECTION, ELSET=ALL, MATERIAL=M\n%g\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.3" % (thickness, young))
    deck.add("*SURFACE, NAME=UP, TYPE=ELEMENT\nALL, SNEG")
    deck.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.2, 1., 1e-6, 0.5\n*BOUNDARY\nRIM, 1, 3\n*DSLOAD\nUP, P, %g" % pressure)
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("hencky", deck)
    expected = 0.6533 * radius * (pressure * radius / (young * thickness)) ** (1.0 / 3.0)
    close(results.at(core[0, 0], "U")[2], expected, 1.5e-2, "deflection of the centre")


ROAD = """
*NODE, NSET=ROAD
9001, 0., 0., 0.
*SURFACE, NAME=ROAD, TYPE=CYLINDER
0., 0., 0., 1., 0., 0.
0., 1., 0.
START, {start:.17g}, 0.
LINE, {end:.17g}, 0.
*RIGID BODY, ANALYTICAL SURFACE=ROAD, REF NODE=9001
*SURFACE INTERACTION, NAME=RUBBER
*FRICTION
{friction}
*CONTACT PAIR, INTERACTION=RUBBER
FOOT, ROAD
"""


def foot_on_road(friction, poisson):
    """A cube that stands 0.01 over the road, its top a rigid body at node 9002."""
    deck = brick((3, 3, 2), (1.0, 1.0, 1.0), transform=lambda x, y, z: (x - 0.5, y - 0.5, z + 0.01))
    deck.sets["TOP"] = deck.where(lambda x, y, z: z > 1.0)
    deck.add_node(9002, 0.0, 0.0, 1.01)
    deck.add("*RIGID BODY, REF NODE=9002, TIE NSET=TOP")
    deck.add(ELASTIC.format(young=10.0, poisson=poisson))
    deck.add("*ELSET, ELSET=BOTTOM, GENERATE\n1, 9\n*SURFACE, NAME=FOOT, TYPE=ELEMENT\nBOTTOM, S1")
    deck.add(ROAD.format(start=-5.0, end=5.0, friction=friction))
    return deck


def touchdown(runner):
    """The cube comes down on a road that moves: friction is mu N in the very increment in which its nodes close, also where
    augmentation has taken the penetration back. Without Poisson's effect all nodes slide one way: exact but for Newton's residual."""
    deck = foot_on_road(0.5, 0.0)
    deck.add("*STEP, NLGEOM\n*STATIC, DIRECT\n1., 1.\n*BOUNDARY\n9001, 1, 1, 0.5\n9001, 2, 6\n9002, 1, 2\n9002, 4, 6\n"
             "9002, 3, 3, -0.06" + OUTPUT + "*END STEP")
    results = runner.run_alike("touchdown", deck)
    assert "augmented" in results.log
    force = results.at(9001, "RF")
    assert force[2] > 0.3, "the cube is pressed"
    close(force[0] / force[2], 0.5, 1e-8, "friction / normal force")


def unloading(runner):
    """The cube is pressed by 0.05 and let go but for 0.005: the multipliers of the great load must not hold it off the road with what
    is left of their force, which is that of a cube pressed by 0.005 alone. (With them it was four times as much.)"""
    forces = []
    for name, depths in (("unloading", (0.06, 0.015)), ("pressed_a_little", (0.015,))):
        deck = foot_on_road(0.0, 0.3)
        for depth in depths:
            deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n*BOUNDARY\n9001, 1, 6\n9002, 1, 2\n9002, 4, 6\n9002, 3, 3, %g" % -depth)
            deck.add(OUTPUT + "*END STEP")
        forces.append(runner.run_alike(name, deck).at(9001, "RF", len(depths))[2])
    close(forces[0], forces[1], 0.08, "force left over")  # a thousandth of a facet's edge may stay open: 7 % of 0.005


def far_reference(runner):
    """The road's reference node lies 1e9 away: the model's extent makes Newton's last corrections too small to matter, and still
    each augmentation of the contact must be solved for. The force is that of a road with a near reference node."""
    forces = []
    for name, x in (("near", 0.0), ("far", 1e9)):
        deck = foot_on_road(0.5, 0.3)
        deck.text = [text.replace("9001, 0., 0., 0.", "9001, %g, 0., 0." % x) for text in deck.text]
        deck.add("*STEP, NLGEOM\n*STATIC, DIRECT\n1., 1.\n*BOUNDARY\n9001, 1, 6\n9002, 1, 2\n9002, 4, 6\n9002, 3, 3, -0.06")
        deck.add(OUTPUT + "*END STEP")
        forces.append(runner.run(name, deck).at(9001, "RF")[2])
    # What Newton leaves where the model's extent decides: 2e-16 of it in displacement, of 0.06.
    close(forces[1], forces[0], 1e-4, "force on the road")


def road(runner):
    """A block pressed on the road, which then moves sideways: the pressing force comes back as the road's reaction, friction is mu
    times it once all slides, and less before."""
    deck = foot_on_road(0.5, 0.3)
    held = "*BOUNDARY\n9001, 1, 6\n9002, 1, 2\n9002, 4, 6\n"
    deck.add("*STEP, NLGEOM\n*STATIC\n0.2, 1., 1e-5, 0.5\n%s9002, 3, 3, -0.06" % held + OUTPUT + "*END STEP")
    deck.add("*STEP, NLGEOM\n*STATIC\n0.2, 1., 1e-5, 0.5\n*BOUNDARY, OP=NEW\n9001, 1, 6\n9002, 1, 2\n9002, 4, 6\n"
             "*CLOAD\n9002, 3, -0.8" + OUTPUT + "*END STEP")
    deck.add("*STEP, NLGEOM\n*STATIC\n0.1, 1., 1e-5, 0.25\n*BOUNDARY\n9001, 1, 1, 0.5" + OUTPUT + "*END STEP")
    results = runner.run_alike("road", deck)
    close(results.at(9001, "RF", 1)[2], -results.at(9002, "RF", 1)[2], 1e-8, "road against block")
    assert results.at(9002, "RF", 1)[2] < -0.3, "the block is pressed"
    close(results.at(9001, "RF", 2)[2], 0.8, 1e-7, "road carries the load")
    close(abs(results.at(9001, "RF", 2)[0]), 0.0, 1e-7, "no shear while pressing evenly")
    # The block bulges as it is pressed, so its nodes slide a little slantwise: the sum stays below Coulomb's limit.
    assert results.at(9001, "RF", 3)[0] <= 0.4 * (1 + 1e-8), "Coulomb's limit"
    close(results.at(9001, "RF", 3)[0], 0.4, 1e-2, "sliding friction mu N")
    close(results.at(9001, "RF", 3)[2], 0.8, 1e-7, "load while sliding")


def turning_back(runner):
    """The road slides under a rubber foot and back in increments of given size: guesses that go on forwards take nodes past the places
    where they stick, some here, some there, and Newton's method must find these all the same. At both ends all nodes slide."""
    deck = brick((6, 6, 2), (1.0, 1.0, 0.5), transform=lambda x, y, z: (x - 0.5, y - 0.5, z + 0.01))
    deck.sets["TOP"] = deck.where(lambda x, y, z: z > 0.505)
    deck.add_node(9002, 0.0, 0.0, 0.51)
    deck.add("*RIGID BODY, REF NODE=9002, TIE NSET=TOP")
    deck.add(ELASTIC.format(young=10.0, poisson=0.45))
    deck.add("*ELSET, ELSET=BOTTOM, GENERATE\n1, 36\n*SURFACE, NAME=FOOT, TYPE=ELEMENT\nBOTTOM, S1")
    deck.add(ROAD.format(start=-5.0, end=5.0, friction=0.5) + "*AMPLITUDE, NAME=BACK\n0., 0., 0.5, 0.3, 1., 0.05")
    deck.add("*STEP, NLGEOM\n*STATIC\n0.2, 1., 1e-5, 0.5\n*BOUNDARY\n9001, 1, 6\n9002, 1, 2\n9002, 4, 6\n9002, 3, 3, -0.06" + OUTPUT +
             "*END STEP")
    deck.add("*STEP, NLGEOM\n*STATIC, DIRECT\n0.25, 1.\n*BOUNDARY, AMPLITUDE=BACK\n9001, 1, 1, 1." + OUTPUT + "*END STEP")
    for ranks in (1, 2):
        results = runner.run("turning_back", deck, ranks)
        for frame, sense in ((2, 1.0), (4, -1.0)):
            force = results.at(9001, "RF", 2, frame)
            assert force[2] > 0.3, "the foot is pressed"
            close(force[0], sense * 0.5 * force[2], 1e-2, "sliding friction mu N")


def ring(runner):
    """*TRANSFORM, TYPE=C: a ring of trusses whose nodes all move outwards by one hundredth: axial force E A ln(1.01) or its like,
    and equal radial reactions 2 F sin(half the angle)."""
    count, radius, young, area = 12, 2.0, 1000.0, 0.1
    deck = Deck()
    for n in range(count):
        angle = 2 * math.pi * n / count
        deck.add_node(n + 1, radius * math.cos(angle), radius * math.sin(angle), 0.0)
    deck.elements["T3D2"] = [(n + 1, [n + 1, (n + 1) % count + 1]) for n in range(count)]
    deck.sets["RING"] = list(range(1, count + 1))
    deck.add("*TRANSFORM, NSET=RING, TYPE=C\n0., 0., 0., 0., 0., 1.")
    deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n%g\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.3" % (area, young))
    deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n*BOUNDARY\nRING, 1, 1, %.17g\nRING, 3, 3\n1, 2, 2" % (0.01 * radius))
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("ring", deck)
    reactions = results.node("RF")
    radial = [np.dot(reactions[results.row[n]], np.array(deck.nodes[n])) / radius for n in deck.sets["RING"]]
    close(np.ptp(radial) / radial[0], 0.0, 1e-9, "spread of radial reactions")
    force = radial[0] / (2.0 * math.sin(math.pi / count))
    # Between nominal strain and logarithmic strain the choice of the law makes half the strain.
    close(force / (young * area), 0.01, 2e-2, "axial strain")
    for n in deck.sets["RING"]:
        close(np.abs(results.at(n, "U") - 0.01 * np.array(deck.nodes[n])).max(), 0.0, 1e-12, "radial motion of node %d" % n)


def flat_sheet(runner):
    """Four M3D4 squares in a plane, held around, pushed at the middle node: flat, nothing resists the push. Then, with shape
    function x y of a square and 2 x 2 points, energy (11 / 72) t E / (1 - nu^2) w^4 each: F = (11 / 9) t E / (1 - nu^2) w^3."""
    young, poisson, thickness, force = 210000.0, 0.3, 0.01, 1e-3
    deck = Deck()
    for n in range(9):
        deck.add_node(n + 1, n % 3 - 1.0, n // 3 - 1.0, 0.0)
    deck.elements["M3D4"] = [(e + 1, [n, n + 1, n + 4, n + 3]) for e, n in enumerate((1, 2, 4, 5))]
    deck.sets["EDGE"] = [1, 2, 3, 4, 6, 7, 8, 9]
    deck.add("*MEMBRANE SECTION, ELSET=ALL, MATERIAL=M\n%g\n*MATERIAL, NAME=M\n*ELASTIC\n%g, %g" % (thickness, young, poisson))
    deck.add("*STEP, NLGEOM\n*STATIC\n*BOUNDARY\nEDGE, 1, 3\n*CLOAD\n5, 3, %g" % -force + OUTPUT + "*END STEP")
    results = runner.run_alike("flat_sheet", deck)
    deflection = (force / (11.0 / 9.0 * thickness * young / (1.0 - poisson**2))) ** (1.0 / 3.0)
    close(-results.at(5, "U")[2] / deflection, 1.0, 1e-6, "deflection")  # where Newton stops


def mechanism(runner):
    """A bar that may turn about its own axis: refused with the node and dof, on one rank and on two."""
    deck = brick((2, 1, 1), (2.0, 1.0, 1.0))
    deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
    deck.add(ELASTIC.format(young=1000.0, poisson=0.3))
    deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n*BOUNDARY\nROOT, 1, 1\n*CLOAD\n%d, 1, 1." % deck.node_at((2.0, 0.0, 0.0)))
    deck.add(OUTPUT + "*END STEP")
    for ranks in (1, 2):
        done, _ = runner.launch("mechanism", deck, ranks)
        said = done.stdout + done.stderr
        assert done.returncode == 3, "exit status %d\n%s" % (done.returncode, said)
        reason = [line for line in said.splitlines() if line.startswith("BALOCCO FAILED")]
        assert len(reason) == 1 and "singular" in reason[0] and "node " in reason[0] and "dof " in reason[0], said
        print(reason[0])


def contradiction(runner):
    """A face coupled to two nodes that are held apart: the second coupling is refused, in linear steps as in others."""
    for ranks, nlgeom in ((1, ""), (2, ""), (1, ", NLGEOM")):
        deck = brick((1, 1, 1), (1.0, 1.0, 1.0))
        deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
        deck.sets["FACE"] = deck.where(lambda x, y, z: x > 1.0 - 1e-9)
        deck.add_node(101, 1.5, 0.5, 0.5)
        deck.add_node(102, 2.0, 0.5, 0.5)
        deck.add(ELASTIC.format(young=1000.0, poisson=0.3))
        deck.add("*SURFACE, TYPE=NODE, NAME=NODES\nFACE")
        for node in (101, 102):
            deck.add("*COUPLING, CONSTRAINT NAME=C%d, REF NODE=%d, SURFACE=NODES\n*KINEMATIC" % (node, node))
        deck.add("*STEP%s\n*STATIC\n1., 1.\n*BOUNDARY\nROOT, 1, 3\n101, 1, 1, 0.1\n101, 2, 6\n102, 1, 6\n*END STEP" % nlgeom)
        done, _ = runner.launch("contradiction", deck, ranks)
        said = done.stdout + done.stderr
        assert done.returncode == 3, "exit status %d\n%s" % (done.returncode, said)
        reason = [line for line in said.splitlines() if line.startswith("BALOCCO FAILED")]
        assert len(reason) == 1 and "*COUPLING: cannot hold together with the other constraints" in reason[0], said
        print(reason[0])


CASES = {
    "patch_c3d8r": lambda runner: patch(runner, "C3D8R"),
    "patch_c3d8": lambda runner: patch(runner, "C3D8"),
    "elastica": elastica,
    "rollup": rollup,
    "rotation": rotation,
    "release": release,
    "linear": linear,
    "hencky": hencky,
    "road": road,
    "touchdown": touchdown,
    "unloading": unloading,
    "far_reference": far_reference,
    "turning_back": turning_back,
    "ring": ring,
    "flat_sheet": flat_sheet,
    "mechanism": mechanism,
    "contradiction": contradiction,
}

if __name__ == "__main__":
    case, program, folder = sys.argv[1:4]
    CASES[case](Runner(program, folder))
