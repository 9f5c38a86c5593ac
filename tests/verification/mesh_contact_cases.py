"""Contact of deformable bodies against closed forms, through the whole program on one and two ranks:
mesh_contact_cases.py CASE PROGRAM FOLDER. Sources of the numbers stand with each case."""
import math
import sys

import numpy as np

from static_model import Deck, Runner, brick, close
from static_option_cases import stop_at_once

YOUNG = 1000.0
OUTPUT = """
*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF
*ELEMENT OUTPUT
S
*CONTACT OUTPUT
CSTRESS, CDISP
*OUTPUT, HISTORY, FREQUENCY=1
*CONTACT OUTPUT, SLAVE=FOOT, MASTER=GROUND
CFN, CFT, CAREA
*ENERGY OUTPUT
ALLIE, ALLWK, ALLFD, ALLKE, ETOTAL
"""


def blocks(below, above, at=(0.0, 0.0), size=(1.0, 1.0), gap=0.0, poisson=0.0, young=(YOUNG, YOUNG), kinds=("C3D8", "C3D8"), height=1.0):
    """A block of n x n x 1 bricks on another one, whose base stands on z = 0. Sets BASE and TOP, surfaces GROUND and FOOT."""
    deck = brick((below, below, 1), (size[0], size[0], 1.0), kinds[0])
    upper = brick((above, above, 1), (size[1], size[1], height), kinds[1],
                  lambda x, y, z: (x + at[0], y + at[1], z + 1.0 + gap), 10001, 10001)
    deck.nodes.update(upper.nodes)
    lower_count = below * below
    for kind, elements in upper.elements.items():
        deck.elements.setdefault(kind, []).extend(elements)
    deck.sets["BASE"] = [n for n in deck.nodes if n < 10001 and deck.nodes[n][2] == 0.0]
    deck.sets["FACE"] = [n for n in deck.nodes if n < 10001 and deck.nodes[n][2] == 1.0]
    deck.sets["SOLE"] = [n for n in upper.nodes if upper.nodes[n][2] == 1.0 + gap]
    deck.sets["TOP"] = [n for n in upper.nodes if upper.nodes[n][2] == 1.0 + gap + height]
    deck.add("*ELSET, ELSET=LOWER, GENERATE\n1, %d\n*ELSET, ELSET=UPPER, GENERATE\n10001, %d" % (lower_count, 10000 + above * above))
    deck.add("*SURFACE, NAME=GROUND\nLOWER, S2\n*SURFACE, NAME=FOOT\nUPPER, S1")
    for name, modulus in (("LOWER", young[0]), ("UPPER", young[1])):
        deck.add("*SOLID SECTION, ELSET=%s, MATERIAL=OF_%s\n*MATERIAL, NAME=OF_%s\n*ELASTIC\n%g, %g\n*DENSITY\n1e-3" %
                 (name, name, name, modulus, poisson))
    return deck


def pair(deck, kind, interaction=""):
    deck.add("*SURFACE INTERACTION, NAME=TOUCH\n%s\n*CONTACT PAIR, INTERACTION=TOUCH, TYPE=%s\nFOOT, GROUND" % (interaction, kind))


def static(deck, conditions, increments="1., 1.", options=""):
    deck.add("*STEP, NLGEOM=YES\n*STATIC%s\n%s\n%s%s*END STEP" % (options, increments, conditions, OUTPUT))


def history(results, variable, step=1):
    return results.file["step_%d/history/contact_FOOT_GROUND/%s" % (step, variable)][:]


def energy(results, variable, step=1):
    return results.file["step_%d/history/energy/%s" % (step, variable)][:]


def patch(runner):
    """Two blocks of unlike material under a uniform pressure, the faces of the slave within those of the master: the stress is uniform
    (Crisfield's patch test of contact), whatever the enforcement: sigma = u / (1/E1 + 1/E2 + 1/K) for small u. Hard contact has
    K = 10 E2 / h until a penetration asks for more."""
    squeeze, moduli = 1e-6, (1000.0, 3000.0)
    for name, kind, interaction, slope in (("faces", "SURFACE TO SURFACE", "", 3e4), ("nodes", "NODE TO SURFACE", "", 3e4),
                                           ("soft", "SURFACE TO SURFACE", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e4", 1e4)):
        deck = blocks(2, 4, young=moduli)
        pair(deck, kind, interaction)
        static(deck, "*BOUNDARY\nBASE, 1, 3\nTOP, 1, 2\nTOP, 3, 3, %g\n" % -squeeze)
        results = runner.run_alike(name, deck)
        stress = results.element("C3D8", "S")[..., 2]
        compliance = sum(1.0 / modulus for modulus in moduli) + 1.0 / slope
        close(-stress.mean(), squeeze / compliance, 1e-5, name + ": stress")
        spread = np.ptp(stress) / abs(stress.mean())
        assert spread < 1e-8, "%s: stress differs by %g of its mean" % (name, spread)
        pressure = [results.at(n, "CPRESS") for n in deck.sets["SOLE"]]
        assert np.ptp(pressure) < 1e-8 * pressure[0] and abs(pressure[0] + stress.mean()) < 1e-5 * pressure[0], pressure


def printed(runner):
    """*CONTACT PRINT: a block pressed and then pushed along by more than it sticks, on two ranks: CSTR is the stress of the field output, CDIS
    what the slave has moved over the master, and CELS sums to what the springs hold."""
    for kind in ("NODE TO SURFACE", "SURFACE TO SURFACE"):
        deck = blocks(2, 2, at=(0.4, 0.1), size=(2.0, 1.0))
        pair(deck, kind, "*FRICTION\n0.2\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n2e4")
        held = "*BOUNDARY\nBASE, 1, 3\nTOP, 2, 2\nTOP, 3, 3, -0.01\nTOP, 1, 1, %g\nSOLE, 1, 1, %g\n*CONTACT PRINT\nCDISP, CSTRESS, CELS\n"
        static(deck, held % (0.0, 0.0))
        static(deck, held % (0.3, 0.3), "0.25, 1.")
        results = runner.run("printed_" + kind.split()[0].lower(), deck, 2)
        text = open(results.file.filename[:-3] + ".dat").read().split("relative contact displacement")[-1]
        tables = [[[float(v) for v in line.split()] for line in part.splitlines() if line[:10].strip().isdigit()]
                  for part in text.replace("contact spring energy", "contact stress").split("contact stress")]
        places = 9 if kind.startswith("NODE") else 16
        assert [len(table) for table in tables] == 3 * [places], [len(table) for table in tables]
        moved, stress, stored = (np.array(table) for table in tables)
        base = np.array([results.at(n, "U", 2)[0] for n in deck.sets["FACE"]])
        assert np.abs(moved[:, -2] - 0.3).max() < np.abs(base).max() + 1e-6, moved
        area = 1.0 if kind.startswith("SURF") else None
        normal, friction = history(results, "CFN", 2)[-1], history(results, "CFT", 2)[-1]
        close(np.abs(stress[:, -2] / stress[:, -3]).mean(), 0.2, 1e-6, "shear over pressure")
        if area:
            close(stress[:, -3].mean(), normal[2], 1e-5, "mean pressure")
            close(stress[:, -2].mean(), -friction[0], 1e-5, "mean shear")
        assert np.all(stored[:, -1] > 0.0)


def free_body(runner):
    """A block that only touches is put under a load: nothing but contact carries it. Forces balance to round-off, on curved and
    slanting faces too: the whole stands aslant."""
    turn = math.radians(25.0)
    slant = lambda x, y, z: (x, y * math.cos(turn) - z * math.sin(turn), y * math.sin(turn) + z * math.cos(turn))
    for kind in ("C3D8", "C3D20R"):
        deck = blocks(2, 2, at=(0.1, 0.2), size=(1.4, 1.0), poisson=0.3) if kind == "C3D8" else quadratic_blocks()
        for n, x in deck.nodes.items():
            deck.nodes[n] = slant(*x)
        pair(deck, "SURFACE TO SURFACE")
        along = slant(1.0, 0.0, 0.0), slant(0.0, 1.0, 0.0)
        deck.add("*TRANSFORM, NSET=TOP\n%s, %s" % tuple(", ".join("%.17g" % c for c in v) for v in along))
        static(deck, "*BOUNDARY\nBASE, 1, 3\nTOP, 1, 2\n*DSLOAD\nLOAD, P, 4.\n")
        deck.text.insert(0, "*SURFACE, NAME=LOAD\nUPPER, S2")
        results = runner.run_alike("free_" + kind, deck)
        total = sum(results.at(n, "RF") for n in deck.sets["BASE"])
        normal = slant(0.0, 0.0, 1.0)
        close(float(np.dot(total, normal)), 4.0, 2e-2, kind + ": load that reaches the base")  # the pressed face grows
        pushed = history(results, "CFN")[-1]
        assert np.abs(pushed - total).max() < 1e-9 * 4.0, (pushed, total)


def quadratic_blocks():
    deck = Deck()
    number = {}

    def node(first, x):
        key = (first, tuple(round(c, 9) for c in x))
        if key not in number:
            number[key] = first + len([k for k in number if k[0] == first])
            deck.add_node(number[key], *x)
        return number[key]

    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    middles = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]
    elements = deck.elements.setdefault("C3D20R", [])
    for first, base, size, cells, z in ((1, 0.0, 1.4, 2, 0.0), (10001, 0.2, 1.0, 2, 1.0)):
        for j in range(cells):
            for i in range(cells):
                edge = size / cells
                where = lambda p: (base + edge * (i + 0.5 * p[0]), base + edge * (j + 0.5 * p[1]), z + 0.5 * p[2])
                elements.append((first + i + cells * j, [node(first, where(p)) for p in corners + middles]))
    deck.sets["BASE"] = deck.where(lambda x, y, z: z == 0.0)
    deck.sets["TOP"] = deck.where(lambda x, y, z: z == 2.0)
    deck.add("*ELSET, ELSET=LOWER, GENERATE\n1, 4\n*ELSET, ELSET=UPPER, GENERATE\n10001, 10004")
    deck.add("*SURFACE, NAME=GROUND\nLOWER, S2\n*SURFACE, NAME=FOOT\nUPPER, S1")
    deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3")
    return deck


COEFFICIENT = 0.3


def drawn_block():
    """A block is pressed on a base three times its length and drawn over its faces, there and half-way back."""
    coefficient, squeeze, stroke = COEFFICIENT, 0.01, 1.2
    deck = blocks(3, 1, at=(0.15, 1.0), size=(3.0, 1.0))
    pair(deck, "SURFACE TO SURFACE", "*FRICTION\n%g" % coefficient)
    held = "*BOUNDARY\nBASE, 1, 3\nTOP, 2, 2\nTOP, 3, 3, %g\nTOP, 1, 1, %g\n"
    static(deck, held % (-squeeze, 0.0))
    static(deck, held % (-squeeze, stroke), "0.025, 1., 1e-5, 0.025")
    static(deck, held % (-squeeze, 0.5 * stroke), "0.025, 1., 1e-5, 0.025")
    return deck


def sliding(runner):
    """Friction is mu times the normal force, against the motion, and what is put in is stored or dissipated."""
    coefficient = COEFFICIENT
    results = runner.run_alike("sliding", drawn_block())
    for step, direction in ((2, -1.0), (3, 1.0)):
        normal, friction = history(results, "CFN", step), history(results, "CFT", step)
        close(friction[-1][0], direction * coefficient * normal[-1][2], 1e-6, "friction at the end of step %d" % step)
        assert np.abs(np.hypot(friction[:, 0], friction[:, 1])).max() <= coefficient * normal[:, 2].max() * (1 + 1e-9)
    stored = energy(results, "ALLIE", 3)[-1] + energy(results, "ALLFD", 3)[-1]
    close(stored, energy(results, "ALLWK", 3)[-1], 2e-2, "what is stored and dissipated of the work")


def restarted(runner):
    """A job stopped after each first increment and taken up on another number of ranks ends as one that was left alone: places of
    faces, their anchors and multipliers are kept."""
    whole = runner.run("whole", drawn_block(), 1)
    stop_at_once(runner, "restarted", drawn_block(), 2, ())
    taken_up = runner.run("restarted", drawn_block(), 1, ("--restart",), "stopped_restarted")
    for step in (2, 3):
        for variable in ("U", "RF"):
            apart = np.abs(whole.node(variable, step) - taken_up.node(variable, step)).max()
            assert apart < 1e-9 * np.abs(whole.node(variable, step)).max(), "%s of step %d is off by %g" % (variable, step, apart)


def standing_together(runner):
    """Blocks that stick are carried round together with their base: turned by 90 degrees nothing slips and no stress arises but that
    of the squeeze."""
    deck = blocks(2, 3, at=(0.1, 0.1), size=(1.2, 1.0))
    pair(deck, "NODE TO SURFACE", "*FRICTION\n0.5")
    deck.add("*NODE\n20001, 0., 0., 0.\n20002, 0., 0., 0.\n*RIGID BODY, REF NODE=20001, TIE NSET=BASE\n*RIGID BODY, REF NODE=20002, TIE NSET=TOP")
    static(deck, "*BOUNDARY\n20001, 1, 6\n20002, 1, 2\n20002, 3, 3, -0.01\n20002, 4, 6\n")
    for step in range(2):
        static(deck, "*BOUNDARY, OP=NEW\n20001, 1, 3\n20001, 4, 4, %g\n20001, 5, 6\n20002, 4, 4, %g\n20002, 5, 6\n20002, 1, 1\n%s" % (
            0.5 * math.pi, 0.5 * math.pi, "20002, 2, 2, 0.01\n20002, 3, 3, 0.0\n") if step == 0 else "*BOUNDARY\n20001, 4, 4, %g\n" % (0.5 * math.pi),
               "0.1, 1.")
    results = runner.run_alike("together", deck)
    first, last = history(results, "CFN", 1)[-1], history(results, "CFN", 2)[-1]
    close(-last[1], first[2], 1e-3, "normal force, turned")
    assert np.linalg.norm(history(results, "CFT", 2)[-1]) < 1e-3 * first[2], history(results, "CFT", 2)[-1]


def rods(runner):
    """A rod hits an equal one at rest end on (VERIFY.md, RODS): v = 10 changes over, the stress between is rho c v / 2."""
    young, density, length, speed, cells = 200e9, 7800.0, 1.0, 10.0, 40
    deck = Deck()
    for first, start in ((1, 0.0), (10001, length)):
        rod = brick((cells, 1, 1), (length, 0.1, 0.1), "C3D8", lambda x, y, z: (x + start, y, z), first, first)
        deck.nodes.update(rod.nodes)
        deck.elements.setdefault("C3D8", []).extend(rod.elements["C3D8"])
    deck.sets["ALL_NODES"] = list(deck.nodes)
    deck.sets["SECOND"] = [n for n in deck.nodes if n > 10000]
    deck.sets["FIRST"] = [n for n in deck.nodes if n < 10000]
    deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.\n*DENSITY\n%g" % (young, density))
    deck.add("*SURFACE, NAME=GROUND\n%d, S4\n*SURFACE, NAME=FOOT\n10001, S6" % cells)
    pair(deck, "SURFACE TO SURFACE")
    deck.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nFIRST, 1, %g" % speed)
    wave = math.sqrt(young / density)
    duration = 2.0 * length / wave
    deck.add("*STEP, NLGEOM=YES, INC=1000\n*DYNAMIC, DIRECT, ALPHA=0.\n%g, %g\n*BOUNDARY\nALL_NODES, 2, 3\n%s*END STEP" % (
        duration / 160, 1.25 * duration, OUTPUT))
    results = runner.run("rods", deck)
    force = -history(results, "CFN")[:, 0]
    time = history(results, "time")
    close(abs(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(time))), density * 0.01 * length * speed, 2e-2, "impulse")
    middle = np.abs(force[(time > 0.2 * duration) & (time < 0.8 * duration)]).mean() / 0.01
    close(middle, 0.5 * density * wave * speed, 2e-2, "stress between the rods")
    total = energy(results, "ETOTAL")
    assert np.abs(total - total[0]).max() < 1e-2 * abs(total[0]), "energy moves by %g of %g" % (np.ptp(total), total[0])


def explicit_rods(runner):
    """The rods again, with equal and with unlike faces at either end, explicit: the first gives all of its speed to the second, less
    what stays behind as ringing; no energy is lost."""
    young, density, length, speed = 200e9, 7800.0, 1.0, 10.0
    wave = math.sqrt(young / density)
    for name, kind, across in (("faces", "SURFACE TO SURFACE", (1, 1)), ("nodes", "NODE TO SURFACE", (1, 2))):
        deck = Deck()
        for first, start, n in ((1, 0.0, across[0]), (10001, length, across[1])):
            rod = brick((40, n, n), (length, 0.1, 0.1), "C3D8R", lambda x, y, z: (x + start, y, z), first, first)
            deck.nodes.update(rod.nodes)
            deck.elements.setdefault("C3D8R", []).extend(rod.elements["C3D8R"])
        deck.sets["ALL_NODES"] = list(deck.nodes)
        deck.sets["FIRST"] = [n for n in deck.nodes if n < 10000]
        deck.sets["SECOND"] = [n for n in deck.nodes if n > 10000]
        deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.\n*DENSITY\n%g" % (young, density))
        ends = [10001 + 40 * i for i in range(across[1] ** 2)]
        deck.add("*SURFACE, NAME=GROUND\n40, S4\n*SURFACE, NAME=FOOT\n%s" % "\n".join("%d, S6" % e for e in ends))
        pair(deck, kind)
        deck.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nFIRST, 1, %g" % speed)
        duration = 2.0 * length / wave
        deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, %g\n*BULK VISCOSITY\n0., 0.\n*BOUNDARY\nALL_NODES, 2, 3\n%s*END STEP" % (
            1.3 * duration, OUTPUT.replace("U, RF", "U, V").replace("FIELD, FREQUENCY=1,", "FIELD, NUMBER INTERVAL=2,")))
        results = [runner.run("explicit_" + name, deck, ranks) for ranks in (1, 2, 3)]
        force, time = -history(results[0], "CFN")[:, 0], history(results[0], "time")
        middle = np.abs(force[(time > 0.2 * duration) & (time < 0.8 * duration)]).mean() / 0.01
        close(middle, 0.5 * density * wave * speed, 2e-2, name + ": stress between the rods")
        second = np.mean([results[0].at(n, "V")[0] for n in deck.sets["SECOND"]])
        close(second, speed, 2e-2, name + ": speed of the second rod")
        total = energy(results[0], "ETOTAL")
        assert np.abs(total - total[0]).max() < 2e-3 * total[0], "energy moves by %g of %g" % (np.ptp(total), total[0])
        for other in results[1:]:
            for variable in ("U", "V"):
                assert np.array_equal(results[0].node(variable), other.node(variable)), "bits differ between ranks in " + variable


def at_rest(runner):
    """A block pressed and drawn aslant in statics goes on in an explicit step with all that held it: nothing moves."""
    for name, kind, interaction in (("nodes", "NODE TO SURFACE", "*FRICTION\n0.3"), ("faces", "SURFACE TO SURFACE", "*FRICTION\n0.3"),
                                    ("soft", "SURFACE TO SURFACE", "*FRICTION\n0.3\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n2e4")):
        deck = blocks(3, 2, at=(0.3, 0.4), size=(3.0, 1.2), kinds=("C3D8R", "C3D8R"), poisson=0.3)
        pair(deck, kind, interaction)
        static(deck, "*BOUNDARY\nBASE, 1, 3\nTOP, 2, 2\nTOP, 3, 3, -0.02\nTOP, 1, 1, 0.002\n", "0.5, 1.")
        deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.01\n*BULK VISCOSITY\n0., 0.\n%s*END STEP" % OUTPUT.replace(
            "U, RF", "U, V").replace("FIELD, FREQUENCY=1,", "FIELD, NUMBER INTERVAL=2,"))
        results = [runner.run("rest_" + name, deck, ranks) for ranks in ((1, 2, 3) if name == "faces" else (1, 2))]
        before, after = history(results[0], "CFN", 1)[-1][2], history(results[0], "CFN", 2)[:, 2]
        assert np.abs(after - before).max() < 1e-3 * before, "normal force moves from %g to %g ... %g" % (before, after.min(), after.max())
        held, kept = history(results[0], "CFT", 1)[-1][0], history(results[0], "CFT", 2)[:, 0]
        assert np.abs(kept - held).max() < 1e-2 * abs(held), "friction moves from %g to %g ... %g" % (held, kept.min(), kept.max())
        kinetic, inner = energy(results[0], "ALLKE", 2), energy(results[0], "ALLIE", 2)
        print("%s: kinetic energy %.2e of the inner" % (name, kinetic.max() / inner.max()))
        assert kinetic.max() < 1e-6 * inner.max()
        for other in results[1:]:  # the same state but for the order of elimination
            assert np.abs(results[0].node("U", 2) - other.node("U", 2)).max() < 1e-9


def released(runner):
    """Hard contact pressed in statics, whose multipliers are large, and let go in an explicit step: the block flies off with what was
    stored and no more."""
    deck = blocks(4, 3, at=(0.1, 0.1), size=(1.2, 1.0), kinds=("C3D8R", "C3D8R"), poisson=0.3)
    pair(deck, "NODE TO SURFACE")
    static(deck, "*BOUNDARY\nBASE, 1, 3\nTOP, 1, 2\nTOP, 3, 3, -0.05\n")
    deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.03\n*BULK VISCOSITY\n0., 0.\n*BOUNDARY, OP=NEW\nBASE, 1, 3\n%s*END STEP" % OUTPUT.replace(
        "U, RF", "U, V").replace("FIELD, FREQUENCY=1,", "FIELD, NUMBER INTERVAL=2,"))
    results = runner.run("released", deck)
    assert history(results, "CFN", 2)[-1][2] == 0.0, "the block has not left"
    stored, total = energy(results, "ALLIE", 1)[-1], energy(results, "ETOTAL", 2)
    print("energy moves by %.2e of what was stored" % (np.abs(total - total[0]).max() / stored))
    assert np.abs(total - total[0]).max() < 6e-2 * stored
    assert energy(results, "ALLKE", 2)[-1] + energy(results, "ALLIE", 2)[-1] < 1.06 * stored


def pushed_far(runner):
    """A block is pushed onto another one by more than the edges of its elements, in one increment as in ten; two that overlap to begin with
    are pressed apart."""
    forces = []
    for name, gap, push, increments in (("one", 0.1, 0.4, "1., 1."), ("ten", 0.1, 0.4, "0.1, 1., 1e-5, 0.1"), ("overlap", -0.2, 0.1, "1., 1.")):
        deck = blocks(4, 4, gap=gap)
        pair(deck, "SURFACE TO SURFACE")
        static(deck, "*BOUNDARY\nBASE, 1, 3\nTOP, 1, 2\nTOP, 3, 3, %g\n" % -push, increments)
        forces.append(history(runner.run("far_" + name, deck), "CFN")[-1][2])
    close(forces[0], forces[1], 1e-3, "force in one increment, as in ten")
    close(forces[2], forces[1], 1e-3, "force of the overlap")


def skid(runner):
    """VERIFY.md, SLIDE: a block of speed v comes to rest on a level base after v^2 / (2 mu g), and all its energy is friction's. It passes
    over the faces of the base, first pressed down by its weight in statics."""
    coefficient, gravity, speed = 0.3, 9.81, 3.0
    deck = blocks(4, 2, at=(0.2, 1.5), size=(4.0, 1.0), kinds=("C3D8R", "C3D8R"))
    pair(deck, "NODE TO SURFACE", "*FRICTION\n%g" % coefficient)
    deck.sets["BLOCK_NODES"] = [n for n in deck.nodes if n > 10000]
    held = "*BOUNDARY\nBASE, 1, 3\n"
    static(deck, held + "TOP, 1, 2\n*DLOAD\n, GRAV, %g, 0., 0., -1.\n" % gravity)
    deck.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nBLOCK_NODES, 1, %g" % speed)
    duration = 1.3 * speed / (coefficient * gravity)
    deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, %g\n*BOUNDARY, OP=NEW\nBASE, 1, 3\n%s*END STEP" % (
        duration, OUTPUT.replace("U, RF", "U, V").replace("FREQUENCY=1", "NUMBER INTERVAL=20")))
    text = deck.text.pop(-2)
    deck.text.insert(deck.text.index(next(t for t in deck.text if t.startswith("*STEP"))), text)
    results = [runner.run("skid", deck, ranks) for ranks in (1, 2)]
    path = np.mean([results[0].at(n, "U", 2)[0] for n in deck.sets["BLOCK_NODES"]])
    close(path, speed ** 2 / (2.0 * coefficient * gravity), 1e-2, "way to rest")
    kinetic = energy(results[0], "ALLKE", 2)
    close(energy(results[0], "ALLFD", 2)[-1], kinetic[0], 1e-2, "heat")
    total = energy(results[0], "ETOTAL", 2)
    assert np.abs(total - total[0]).max() < 5e-3 * kinetic[0], "energy moves by %g of %g" % (np.ptp(total), kinetic[0])


CASES = {"patch": patch, "printed": printed, "free_body": free_body, "sliding": sliding, "restarted": restarted, "standing_together": standing_together, "rods": rods, "explicit_rods": explicit_rods,
         "at_rest": at_rest, "skid": skid, "released": released, "pushed_far": pushed_far}

if __name__ == "__main__":
    case, program, folder = sys.argv[1:4]
    CASES[case](Runner(program, folder))
