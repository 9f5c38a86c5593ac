"""Temperatures through the whole program: thermal_cases.py CASE PROGRAM FOLDER."""
import os
import sys

import numpy as np

from frequency_cases import modes as modes_of
from static_model import Deck, Runner, brick, close

YOUNG, POISSON, ALPHA, HEAT = 2.0e5, 0.3, 1.2e-5, 200.0
MATERIAL = """
*SOLID SECTION, ELSET=ALL, MATERIAL=M
*MATERIAL, NAME=M
*ELASTIC
%g, %g
*EXPANSION
%g
*DENSITY
7.8e-9
""" % (YOUNG, POISSON, ALPHA)
OUTPUT = """
*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF, NT
*ELEMENT OUTPUT
S, THE
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLSE, ALLWK, ALLKE, ETOTAL
"""
FINITE, LINEAR = ", NLGEOM", ""


def block(kind="C3D8R", counts=(3, 2, 2), lengths=(3.0, 2.0, 2.0)):
    deck = brick(counts, lengths, kind)
    deck.sets["EVERY"] = list(deck.nodes)
    for axis, name in enumerate("XYZ"):
        deck.sets[name + "0"] = deck.where(lambda *x: x[axis] < 1e-9)
        deck.sets[name + "1"] = deck.where(lambda *x: x[axis] > lengths[axis] - 1e-9)
    return deck


def step(geometry, boundary, temperature, procedure="*STATIC\n1., 1."):
    return "*STEP%s\n%s\n%s\n%s\n%s*END STEP" % (geometry, procedure, boundary, temperature, OUTPUT)


ROLLERS = "*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nZ0, 3, 3"


def free(runner):
    """A block on rollers: no stress, and each edge longer by alpha dT, in one or in two steps, about an initial temperature."""
    for kind in ("C3D8R", "C3D8", "C3D8I"):
        for geometry in (LINEAR, FINITE):
            deck = block(kind)
            deck.add(MATERIAL + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nEVERY, 20.")
            deck.add(step(geometry, ROLLERS, "*TEMPERATURE\nEVERY, %g" % (20.0 + HEAT)))
            deck.add(step(geometry, "", "*TEMPERATURE, OP=NEW"))
            run = runner.run_alike if kind == "C3D8R" else runner.run
            results = run("free_%s%s" % (kind, "_finite" if geometry else ""), deck)
            far = deck.node_at((3.0, 2.0, 2.0))
            for axis, length in enumerate((3.0, 2.0, 2.0)):
                close(results.at(far, "U")[axis], length * ALPHA * HEAT, 1e-9, "%s: displacement %d" % (kind, axis + 1))
            close(np.abs(results.element(kind, "S")).max() / (YOUNG * ALPHA * HEAT), 0.0, 1e-8, "stress")
            close(results.at(far, "NT"), 20.0 + HEAT, 1e-14, "temperature")
            close(np.abs(results.element(kind, "THE") - ALPHA * HEAT).max(), 0.0, 1e-17, "thermal strain")
            close(np.abs(results.at(far, "U", 2)).max(), 0.0, 1e-10, "displacement when cold again")
            energy = results.file["step_1/history/energy"]
            close(energy["ETOTAL"][-1], 0.0, 1e-9, "energy balance")


def oriented(runner):
    """Matter with axes of its own, turned by 90 degrees, expands freely without stress."""
    for geometry in (LINEAR, FINITE):
        deck = block("C3D8")
        deck.add(MATERIAL.replace("*ELASTIC\n%g, %g" % (YOUNG, POISSON), "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n2e5, 1e5, 5e4, .3, .2, .25, 6e4, 5e4\n4e4,").replace(
            "MATERIAL=M\n", "MATERIAL=M, ORIENTATION=TURNED\n", 1) + "*ORIENTATION, NAME=TURNED\n0., 1., 0., -1., 0., 0.\n")
        deck.add(step(geometry, ROLLERS, "*TEMPERATURE\nEVERY, %g" % HEAT))
        results = runner.run("oriented" + ("_finite" if geometry else ""), deck)
        close(np.abs(results.element("C3D8", "S")).max() / (YOUNG * ALPHA * HEAT), 0.0, 1e-8, "stress")
        close(results.at(deck.node_at((3.0, 2.0, 2.0)), "U")[0], 3.0 * ALPHA * HEAT, 1e-9, "displacement")


def perturbed(runner):
    """A pull on a free heated block: its stress is the pull over the heated area."""
    for geometry, area in ((LINEAR, 4.0), (FINITE, 4.0 * (1.0 + ALPHA * HEAT) ** 2)):
        deck = block("C3D8")
        deck.add(MATERIAL + "*ELSET, ELSET=ENDS, GENERATE\n3, 12, 3\n*SURFACE, NAME=END, TYPE=ELEMENT\nENDS, S4")
        deck.add(step(geometry, ROLLERS, "*TEMPERATURE\nEVERY, %g" % HEAT))
        deck.add(step("", "*DSLOAD\nEND, P, -100.", "").replace("*STEP", "*STEP, PERTURBATION", 1))
        results = runner.run("perturbed" + ("_finite" if geometry else ""), deck)
        pull = -results.node("RF", 2)[:, 0].sum()
        for stress in results.element("C3D8", "S", 2):
            close(stress[0], pull / area, 1e-7, "S11")
        close(np.abs(results.element("C3D8", "S", 2)[:, 1:]).max() / (pull / area), 0.0, 1e-7, "other stresses")


def saint_venant(stretch):
    """Cauchy stress of a bar of St. Venant-Kirchhoff matter, free across, for its mechanical stretch along."""
    green = 0.5 * (stretch ** 2 - 1.0)
    across = 1.0 - 2.0 * POISSON * green
    return YOUNG * green * stretch / across


def clamped(runner):
    """A bar between walls: -E alpha dT; at finite strain the law's Cauchy stress at the stretch 1 / (1 + alpha dT)."""
    for kind in ("C3D8R", "C3D8", "C3D8I"):
        for geometry, expected in ((LINEAR, -YOUNG * ALPHA * HEAT), (FINITE, saint_venant(1.0 / (1.0 + ALPHA * HEAT)))):
            deck = block(kind)
            deck.add(MATERIAL)
            deck.add(step(geometry, ROLLERS + "\nX1, 1, 1", "*TEMPERATURE\nEVERY, %g" % HEAT))
            run = runner.run_alike if kind == "C3D8R" else runner.run
            results = run("clamped_%s%s" % (kind, "_finite" if geometry else ""), deck)
            for stress in results.element(kind, "S"):
                close(stress[0], expected, 1e-8, "%s: S11" % kind)
            close(np.abs(results.element(kind, "S")[:, 1:]).max() / abs(expected), 0.0, 1e-8, "other stresses")
            energy = results.file["step_1/history/energy"]
            close(energy["ETOTAL"][-1] / energy["ALLSE"][-1], 0.0, 1e-2 if geometry else 1e-8, "energy balance")
    deck = Deck()
    deck.add_node(1, 0.0, 0.0, 0.0)
    deck.add_node(2, 1.0, 0.0, 0.0)
    deck.elements["T3D2"] = [(1, (1, 2))]
    deck.sets["EVERY"] = [1, 2]
    deck.add(MATERIAL.replace("MATERIAL=M\n", "MATERIAL=M\n1.\n", 1))
    deck.add(step(LINEAR, "*BOUNDARY\nEVERY, 1, 3", "*TEMPERATURE\nEVERY, %g" % HEAT))
    close(runner.run("truss", deck).element("T3D2", "S")[0][0], -YOUNG * ALPHA * HEAT, 1e-9, "S11 of a truss")


def imported(runner):
    """Another job's heat stays as it is; its temperatures are not known there, and asking for them is refused."""
    def bar():
        deck = block()
        deck.add(MATERIAL)
        return deck
    hold = ROLLERS + "\nX1, 1, 1"
    deck = bar()
    deck.add(step(FINITE, hold, "*TEMPERATURE\nEVERY, %g\n*RESTART, WRITE, FREQUENCY=100" % HEAT))
    before = runner.run("heated", deck).element("C3D8R", "S")
    checkpoint = ("--import", os.path.join(runner.folder, "heated_1", "heated.ckpt.h5"))
    for name, procedure in (("static", "*STATIC\n1., 1."), ("explicit", "*DYNAMIC, EXPLICIT\n, 1e-5")):
        deck = bar()
        deck.add(step(FINITE, hold, "", procedure).replace("U, RF, NT", "U").replace("FIELD, FREQUENCY=1", "FIELD, NUMBER INTERVAL=1"))
        after = runner.run("imported_" + name, deck, options=checkpoint).element("C3D8R", "S")
        close(np.abs(after - before).max() / np.abs(before).max(), 0.0, 1e-6, name + ": stress")
    for name, outputs, temperature in (("asked", OUTPUT, ""), ("given", "", "*TEMPERATURE\nEVERY, 1.")):
        deck = bar()
        deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n%s\n%s\n%s*END STEP" % (hold, temperature, outputs))
        done, _ = runner.launch(name, deck, 1, options=checkpoint)
        assert done.returncode == 2 and "are not known" in done.stderr + done.stdout, done.stderr


def table(runner):
    """alpha(T) between rows and beyond them, from ZERO, less what the initial temperature has; a curve leads there."""
    deck = block()
    deck.add(MATERIAL.replace("*EXPANSION\n%g" % ALPHA, "*EXPANSION, ZERO=10.\n1e-5, 0.\n2e-5, 100.\n2.5e-5, 200."))
    deck.add("*INITIAL CONDITIONS, TYPE=TEMPERATURE\nEVERY, 50.\n*AMPLITUDE, NAME=CURVE\n0., 0., 1., 1.")
    deck.add(step(LINEAR, ROLLERS, "*TEMPERATURE, AMPLITUDE=CURVE\nEVERY, 150."))
    deck.add(step(LINEAR, "", "*TEMPERATURE\nEVERY, 300."))
    results = runner.run_alike("table", deck)
    before = 1.5e-5 * (50.0 - 10.0)
    close(results.element("C3D8R", "THE", 1)[0], 2.25e-5 * 140.0 - before, 1e-12, "between rows")
    close(results.element("C3D8R", "THE", 2)[0], 2.5e-5 * 290.0 - before, 1e-12, "beyond them")


def membrane(runner):
    """A sheet held all around: -E alpha dT / (1 - nu)."""
    deck = Deck()
    for number, x in enumerate(((0, 0), (1, 0), (1, 1), (0, 1)), 1):
        deck.add_node(number, float(x[0]), float(x[1]), 0.0)
    deck.elements["M3D4"] = [(1, (1, 2, 3, 4))]
    deck.sets["EVERY"] = [1, 2, 3, 4]
    deck.add(MATERIAL.replace("*SOLID SECTION, ELSET=ALL, MATERIAL=M", "*MEMBRANE SECTION, ELSET=ALL, MATERIAL=M\n0.1"))
    deck.add(step(LINEAR, "*BOUNDARY\nEVERY, 1, 3", "*TEMPERATURE\nEVERY, %g" % HEAT))
    results = runner.run("membrane", deck)
    for axis in (0, 1):
        close(results.element("M3D4", "S")[0][axis], -YOUNG * ALPHA * HEAT / (1.0 - POISSON), 1e-8, "S%d%d" % (axis + 1, axis + 1))


def turning(kind, section):
    """A strip 3 x 1 of shells, distorted inside, or a chain of three beams: along x, their ends as sets."""
    deck = Deck()
    beams = kind == "B31"
    for j in range(1 if beams else 3):
        for i in range(4):
            inside = not beams and j == 1 and 0 < i < 3
            deck.add_node(1 + i + 4 * j, i + 0.2 * inside, 0.5 * j + 0.1 * inside, 0.0)
    cells = [(1 + i + 4 * j, 2 + i + 4 * j, 6 + i + 4 * j, 5 + i + 4 * j) for j in range(2) for i in range(3)]
    corners = [(i, i + 1) for i in (1, 2, 3)] if beams else cells
    if kind == "S3R":
        corners = [part for a, b, c, d in cells for part in ((a, b, c), (a, c, d))]
    deck.elements[kind] = list(enumerate(corners, 1))
    deck.sets["EVERY"] = list(deck.nodes)
    deck.sets["X0"] = deck.where(lambda x, y, z: x < 1e-9)
    deck.sets["X1"] = deck.where(lambda x, y, z: x > 3.0 - 1e-9)
    deck.sets["Y0"] = deck.where(lambda x, y, z: y < 1e-9)
    deck.add(MATERIAL.replace("*SOLID SECTION, ELSET=ALL, MATERIAL=M", section))
    return deck


def shells_and_beams(runner):
    """Free they grow, in thickness too, without stress; held at both ends they press by -E alpha dT (at finite strain by what the law has
    at that stretch), heated fast or slowly; bits do not depend on the number of ranks."""
    sheet = "*SHELL SECTION, ELSET=ALL, MATERIAL=M\n0.1, 5"
    line = "*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=PIPE\n0.1, 0.02\n0., 1., 0."
    hold = "*BOUNDARY\nX0, 1\nY0, 2\nEVERY, 3, 6"
    stretch = 1.0 + ALPHA * HEAT
    for kind, section in (("S4R", sheet), ("S4", sheet), ("S3R", sheet), ("B31", line)):
        pressed = saint_venant(1.0 / stretch) if kind != "B31" else 0.5 * YOUNG * stretch * (stretch**-2 - 1.0)  # over the section at the start
        for geometry, expected in ((LINEAR, -YOUNG * ALPHA * HEAT), (FINITE, pressed)):
            name = kind + ("_finite" if geometry else "")
            deck = turning(kind, section)
            deck.add(step(geometry, hold, "*TEMPERATURE\nEVERY, %g" % HEAT).replace("S, THE", "S, THE" if kind == "B31" else "S, THE, STH"))
            results = runner.run("free_" + name, deck)
            close(results.at(4, "U")[0], 3.0 * ALPHA * HEAT, 1e-9, name + ": displacement")
            close(np.abs(results.element(kind, "S")).max() / (YOUNG * ALPHA * HEAT), 0.0, 1e-8, name + ": stress")
            close(np.abs(results.element(kind, "THE") - ALPHA * HEAT).max(), 0.0, 1e-17, name + ": thermal strain")
            if kind != "B31" and geometry:
                close(np.abs(results.element(kind, "STH") / 0.1 - 1.0 - ALPHA * HEAT).max(), 0.0, 1e-12, name + ": thickness")
            close(results.file["step_1/history/energy"]["ETOTAL"][-1], 0.0, 1e-9, name + ": energy balance")
            deck = turning(kind, section)
            deck.add(step(geometry, hold + "\nX1, 1", "*TEMPERATURE\nEVERY, %g" % HEAT))
            results = runner.run("held_" + name, deck)
            for stress in results.element(kind, "S"):
                close(stress[0], expected, 1e-8, name + ": S11")
        deck = turning(kind, section)
        deck.add("*AMPLITUDE, NAME=SLOW, DEFINITION=SMOOTH STEP\n0., 0., 2e-4, 1.")
        deck.add(step("", hold + "\nX1, 1", "*TEMPERATURE, AMPLITUDE=SLOW\nEVERY, %g" % HEAT, "*DYNAMIC, EXPLICIT\n, 2e-4").replace(
            "FREQUENCY=1, PRECISION", "NUMBER INTERVAL=2, PRECISION").replace("HISTORY, FREQUENCY=1", "HISTORY, TIME INTERVAL=1e-5"))
        runs = [runner.run("explicit_" + kind, deck, ranks) for ranks in (1, 2)]
        for stress in runs[0].element(kind, "S"):
            close(stress[0], pressed, 1e-2, kind + ": S11 of the explicit step")
        energy = runs[0].file["step_1/history/energy"]
        close(np.abs(energy["ETOTAL"][:]).max() / energy["ALLSE"][-1], 0.0, 1e-3, kind + ": energy balance")
        assert (runs[0].node("U") == runs[1].node("U")).all(), "bits depend on the number of ranks"


def constants(runner):
    """Young's modulus by the temperature: stress of a held bar, modes about the initial temperature, and the energy that softening takes
    from it, in linear, in large and in explicit steps."""
    steel = MATERIAL.replace("%g, %g\n*EXPANSION\n%g" % (YOUNG, POISSON, ALPHA), "2e5, 0.3, 0.\n1e5, 0.3, 100.")
    steel += "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nEVERY, 50.\n*AMPLITUDE, NAME=SLOW, DEFINITION=SMOOTH STEP\n0., 0., 2e-4, 1.\n"
    modes = "*STEP\n*FREQUENCY\n2\n*BOUNDARY\nX0, 1, 3\n*END STEP"
    deck = block("C3D8")
    deck.add(steel + modes)
    deck.add(step(LINEAR, ROLLERS + "\nX1, 1, 1, 0.003", ""))
    deck.add(step(LINEAR, "", "*TEMPERATURE\nEVERY, 75."))
    warm = runner.run("linear", deck)
    for number, young in ((2, 1.5e5), (3, 1.25e5)):
        close(warm.element("C3D8", "S", number)[0][0], 1e-3 * young, 1e-9, "stress of step %d" % number)
    deck = block("C3D8")
    deck.add(MATERIAL.replace("%g, %g\n*EXPANSION\n%g" % (YOUNG, POISSON, ALPHA), "1.5e5, 0.3") + modes)
    same = runner.run("modes", deck)
    for mode, other in zip(modes_of(warm, 1), modes_of(same, 1), strict=True):
        close(mode.attrs["frequency"] / other.attrs["frequency"], 1.0, 1e-10, "frequency about the initial temperature")
    deck = block("C3D8")
    deck.add(steel)
    deck.add(step(FINITE, ROLLERS + "\nX1, 1, 1, 0.09", ""))
    deck.add(step(FINITE, "", "*TEMPERATURE\nEVERY, 150."))
    deck.add(step("", "", "*TEMPERATURE, AMPLITUDE=SLOW\nEVERY, 75.", "*DYNAMIC, EXPLICIT\n, 2e-4").replace(
        "FREQUENCY=1, PRECISION", "NUMBER INTERVAL=1, PRECISION").replace("HISTORY, FREQUENCY=1", "HISTORY, TIME INTERVAL=1e-5"))
    runs = [runner.run("large", deck, ranks) for ranks in (1, 2)]
    assert (runs[0].node("U", 3) == runs[1].node("U", 3)).all(), "bits depend on the number of ranks"
    stress = [runs[0].element("C3D8", "S", number)[0][0] for number in (1, 2)]
    close(stress[1] / stress[0], 1.0 / 1.5, 1e-9, "stress once soft")
    energy = runs[0].file["step_2/history/energy"]
    close(energy["ALLSE"][-1] / energy["ALLSE"][0], 1.0 / 1.5, 1e-9, "energy once soft")
    close(np.ptp(energy["ETOTAL"][:]) / energy["ALLSE"][0], 0.0, 1e-9, "energy balance")
    energy = runs[0].file["step_3/history/energy"]
    close(np.ptp(energy["ETOTAL"][:]) / energy["ALLSE"][0], 0.0, 1e-4, "energy balance of explicit dynamics")
    last = runs[0].element("C3D8", "S", 3)
    deck = block("C3D8")
    deck.add(steel)
    deck.add(step(FINITE, ROLLERS + "\n*BOUNDARY, FIXED\nX1, 1, 1", "").replace("U, RF, NT", "U"))
    checkpoint = ("--import", os.path.join(runner.folder, "large_1", "large.ckpt.h5"))
    after = runner.run("imported", deck, options=checkpoint).element("C3D8", "S")
    close(np.abs(after - last).max() / np.abs(last).max(), 0.0, 1e-6, "stress of another job's state")


def explicit(runner):
    """The bar between walls, heated smoothly over many periods: the static stress, the energy in balance, and bits that do not depend
    on the number of ranks."""
    deck = block("C3D8R", (6, 2, 2), (6.0, 2.0, 2.0))
    deck.add(MATERIAL + "*AMPLITUDE, NAME=SLOW, DEFINITION=SMOOTH STEP\n0., 0., 2e-4, 1.")
    deck.add(step("", ROLLERS + "\nX1, 1, 1", "*TEMPERATURE, AMPLITUDE=SLOW\nEVERY, %g" % HEAT, "*DYNAMIC, EXPLICIT\n, 2e-4").replace(
        "FREQUENCY=1, PRECISION", "NUMBER INTERVAL=2, PRECISION").replace("HISTORY, FREQUENCY=1", "HISTORY, TIME INTERVAL=1e-5"))
    runs = [runner.run("explicit", deck, ranks) for ranks in (1, 2, 3)]
    expected = saint_venant(1.0 / (1.0 + ALPHA * HEAT))
    for stress in runs[0].element("C3D8R", "S"):
        close(stress[0], expected, 2e-3, "S11")
    energy = runs[0].file["step_1/history/energy"]
    close(np.abs(energy["ETOTAL"][:]).max() / energy["ALLSE"][-1], 0.0, 1e-4, "energy balance")
    close(energy["ALLKE"][-1] / energy["ALLSE"][-1], 0.0, 1e-4, "kinetic energy")
    for other in runs[1:]:
        assert (runs[0].node("U") == other.node("U")).all(), "bits depend on the number of ranks"


def refused(runner):
    """What is not followed is refused with its place in the deck."""
    def refusal(name, change, text):
        deck = block()
        deck.add(change(MATERIAL))
        deck.add(step(LINEAR, ROLLERS, "*TEMPERATURE\nEVERY, 1." if name != "file" else "*TEMPERATURE, FILE=OTHER\nEVERY, 1."))
        done, _ = runner.launch(name, deck, 1)
        message = done.stdout + done.stderr
        assert done.returncode != 0 and text in message and ".inp:" in message, message
        print(name, "is refused")

    refusal("ortho", lambda text: text.replace("*EXPANSION\n", "*EXPANSION, TYPE=ORTHO\n"), "TYPE")
    refusal("falling", lambda text: text.replace("*EXPANSION\n%g" % ALPHA, "*EXPANSION\n1e-5, 100.\n2e-5, 50."), "rising")
    refusal("file", lambda text: text, "FILE")
    table = lambda text: text.replace("%g, %g" % (YOUNG, POISSON), "2e5, 0.3, 0.\n1e5, 0.3, 100.")
    refusal("reduced", table, "other than C3D8R")
    refusal("yielding", lambda text: table(text).replace("*DENSITY", "*PLASTIC\n300., 0.\n*DENSITY"), "no other option")
    deck = block()
    deck.add(MATERIAL)
    deck.add(step(LINEAR, ROLLERS, "*TEMPERATURE\nEVERY, 2."))
    deck.add("*STEP\n*BUCKLE\n1\n*CLOAD\n2, 1, -1.\n*END STEP")
    done, _ = runner.launch("buckle", deck, 1)
    assert done.returncode == 2 and "does not follow temperatures" in done.stderr + done.stdout, done.stderr
    deck = block()
    deck.add(MATERIAL)
    deck.add(step(FINITE, ROLLERS, "*TEMPERATURE\nX1, %g" % (-3.0 / ALPHA)))
    for ranks in (1, 2):  # the elements of one rank
        done, _ = runner.launch("nothing_left", deck, ranks)
        assert done.returncode == 3 and "nothing is left of it" in done.stderr + done.stdout, done.stderr


CASES = {case.__name__: case for case in (free, oriented, perturbed, imported, clamped, table, constants, membrane, shells_and_beams, explicit, refused)}

if __name__ == "__main__":
    name, program, folder = sys.argv[1:4]
    os.makedirs(folder, exist_ok=True)
    CASES[name](Runner(program, folder))
