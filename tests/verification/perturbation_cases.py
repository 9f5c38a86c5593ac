"""Static perturbations through the whole program: perturbation_cases.py CASE PROGRAM FOLDER."""
import os
import re
import sys

import numpy as np

from static_cases import ELASTIC, cantilever
from static_model import OUTPUT, Deck, Runner, close

ENERGY = "*OUTPUT, HISTORY, FREQUENCY=1\n*ENERGY OUTPUT\nALLIE, ALLWK, ETOTAL\n"
GENERAL = "*STEP%s\n*STATIC\n1., 1.\n%s\n" + OUTPUT + ENERGY + "*END STEP"
PERTURBATION = "*STEP, PERTURBATION\n*STATIC\n%s\n" + OUTPUT + ENERGY + "*END STEP"


def taut_string(runner):
    """A load across two bars that an NLGEOM step has made taut: they resist by their tension alone, u = F l / 2 T. The next step goes on
    from the state before."""
    deck = Deck()
    for i in range(3):
        deck.add_node(i + 1, float(i), 0.0, 0.0)
    deck.elements["T3D2"] = [(1, (1, 2)), (2, (2, 3))]
    deck.add("*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n1.\n*BOUNDARY\n1, 1, 3\n3, 2, 3")
    deck.add(GENERAL % (", NLGEOM", "*BOUNDARY\n2, 2, 3\n3, 1, 1, 0.2"))
    deck.add(PERTURBATION % "*BOUNDARY, OP=NEW\n1, 1, 3\n3, 1, 3\n*CLOAD\n2, 2, 3.\n*NODE PRINT, NSET=MIDDLE\nU\n")
    deck.add(GENERAL % (", NLGEOM", ""))
    deck.sets["MIDDLE"] = [2]
    results = runner.run_alike("taut_string", deck)
    tension = results.at(3, "RF", 1)[0]
    moved = 3.0 * 1.1 / (2.0 * tension)
    close(results.at(2, "U", 2)[1], moved, 1e-9, "displacement across")
    close(results.at(2, "U", 2)[0], 0.0, 1e-15, "displacement along")
    close(results.at(1, "RF", 2)[1], -1.5, 1e-9, "reaction of the perturbation")
    close(results.at(1, "RF", 2)[0], 0.0, 1e-9, "reaction along")
    energy = lambda name: results.file["step_2/history/energy/%s" % name][-1]
    close(energy("ALLWK"), 0.5 * 3.0 * moved, 1e-9, "work")
    close(energy("ALLIE"), 0.5 * 3.0 * moved, 1e-7, "energy")
    close(np.abs(results.node("U", 3) - results.node("U", 1)).max(), 0.0, 1e-12, "what the perturbation leaves")
    close(np.abs(results.node("RF", 3) - results.node("RF", 1)).max() / tension, 0.0, 1e-10, "reactions after it")
    text = open(os.path.join(runner.folder, "taut_string_1", "taut_string.dat")).read()
    close(float(re.findall(r"^ +2 +(\S+) +(\S+)", text, re.M)[0][1]), moved, 1e-6, "printed")


def beam_of(kind):
    if kind == "B31":
        deck = Deck()
        for i in range(11):
            deck.add_node(i + 1, float(i), 0.0, 0.0)
        deck.elements[kind] = [(i + 1, (i + 1, i + 2)) for i in range(10)]
        deck.sets["ROOT"], deck.sets["TIP"] = [1], [11]
        deck.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n1., 0.8\n0., 1., 0.\n*MATERIAL, NAME=M\n*ELASTIC\n1e5, 0.3")
        return deck, 11, "*BOUNDARY\nROOT, 1, 6\n", ""
    deck = cantilever(10.0, 1.0, 1.0, (10, 1, 1), kind)
    deck.add(ELASTIC.format(young=1e5, poisson=0.3))
    deck.add("*ELSET, ELSET=EVERY, GENERATE\n1, 10\n*SURFACE, NAME=TOP, TYPE=ELEMENT\nEVERY, S2")
    return deck, 9001, "*BOUNDARY\nROOT, 1, 3\n", "*DSLOAD\nTOP, P, %r\n"


def bent_state(runner):
    """A perturbation about a bent cantilever under a pull (and a pressure that follows) against half the difference of two general steps
    with small loads of either sign."""
    for kind in ("C3D8", "C3D8R", "B31"):
        deck, tip, root, press = beam_of(kind)
        base = root + "*CLOAD\n%d, 1, 800.\n%d, 3, 300.\n" % (tip, tip) + (press % 5.0 if press else "")
        deck.add(GENERAL % (", NLGEOM", base))
        more = "*CLOAD\n%d, 2, 10.\n%d, 3, 20.\n" % (tip, tip) + (press % 0.3 if press else "")
        count = len(deck.text)
        deck.add(PERTURBATION % more)
        deck.add(GENERAL % (", NLGEOM", ""))
        whole = runner.run_alike("bent_" + kind, deck)
        sides, size = [], 1e-3
        for sign in (1.0, -1.0):
            small = sign * size
            load = "*CLOAD\n%d, 2, %r\n%d, 3, %r\n" % (tip, 10.0 * small, tip, 300.0 + 20.0 * small)
            side, _, _, _ = beam_of(kind)
            side.text = deck.text[:count]
            side.add("*STEP, NLGEOM\n*CONTROLS, PARAMETERS=FIELD\n1e-9, 1e-9\n*STATIC\n1., 1.\n" + load + (press % (5.0 + 0.3 * small) if press else "") +
                     OUTPUT + "*END STEP")
            sides.append(runner.run("side_%s_%s" % (kind, "up" if sign > 0 else "down"), side))
        for variable in ("U", "RF", "S", "UR"):
            read = lambda r, s: r.element(kind, variable, s) if variable == "S" else r.node(variable, s)
            slope = (read(sides[0], 2) - read(sides[1], 2)) / (2.0 * size)
            close(np.abs(read(whole, 2) - slope).max() / np.abs(slope).max(), 0.0, 1e-6, "%s: %s off the slope" % (kind, variable))
        close(np.abs(whole.node("U", 3) - whole.node("U", 1)).max() / np.abs(whole.node("U", 1)).max(), 0.0, 1e-8, kind + ": left behind")


def first_step(runner):
    """About the model as it is defined a perturbation is a linear step, of loads and of given motions; a general step follows."""
    for name, what in (("loaded", "*CLOAD\n9001, 3, 50."), ("moved", "*BOUNDARY\n9001, 3, 3, 0.2")):
        deck = cantilever(10.0, 1.0, 1.0, (10, 1, 1), "C3D8")
        deck.add(ELASTIC.format(young=1e5, poisson=0.3) + "\n*BOUNDARY\nROOT, 1, 3")
        deck.add(PERTURBATION % what)
        deck.add(GENERAL % ("", what))
        results = runner.run_alike("first_step_" + name, deck)
        for variable in ("U", "RF"):
            largest = np.abs(results.node(variable, 2)).max()
            close(np.abs(results.node(variable, 1) - results.node(variable, 2)).max() / largest, 0.0, 1e-9, variable)
        difference = np.abs(results.element("C3D8", "S", 1) - results.element("C3D8", "S", 2)).max()
        close(difference / np.abs(results.element("C3D8", "S", 2)).max(), 0.0, 1e-8, "S")


CASES = {case.__name__: case for case in (taut_string, bent_state, first_step)}

if __name__ == "__main__":
    CASES[sys.argv[1]](Runner(*sys.argv[2:]))
