"""Geometrically linear steps through the whole program: linear_cases.py CASE PROGRAM FOLDER."""
import sys

import numpy as np

from static_cases import ELASTIC, cantilever
from static_model import OUTPUT, Runner, brick, close

ENERGY = "*OUTPUT, HISTORY, FREQUENCY=1\n*ENERGY OUTPUT\nALLIE, ALLWK, ETOTAL\n"
STEP = "*STEP%s\n*STATIC\n1., 1.\n%s\n" + OUTPUT + ENERGY + "*END STEP"
ROOT = "*BOUNDARY\nROOT, 1, 3\n"


def bent(kind):
    deck = cantilever(10.0, 1.0, 1.0, (20, 1, 2))
    if kind != "C3D8R":
        deck.elements[kind] = deck.elements.pop("C3D8R")
    deck.add(ELASTIC.format(young=1e5, poisson=0.3))
    return deck


def superposition(runner):
    """Loads A, B and none, each from the step before; A + B in one step. Strains of 15 % tell linear from finite geometry."""
    for kind in ("C3D8R", "C3D8"):
        loads = {"a": "9001, 3, 2500.", "b": "9001, 2, -1500.\n9001, 1, 4000.\n9001, 4, 300."}
        deck = bent(kind)
        deck.add(STEP % ("", ROOT + "*CLOAD\n" + loads["a"]))
        deck.add(STEP % ("", "*CLOAD, OP=NEW\n" + loads["b"]))
        deck.add(STEP % ("", "*CLOAD, OP=NEW"))
        apart = runner.run_alike("apart_" + kind, deck)
        deck = bent(kind)
        deck.add(STEP % ("", ROOT + "*CLOAD\n" + loads["a"] + "\n" + loads["b"]))
        whole = runner.run("whole_" + kind, deck)
        for variable, read in (("U", lambda r, s: r.node("U", s)), ("UR", lambda r, s: r.node("UR", s)),
                               ("RF", lambda r, s: r.node("RF", s)), ("S", lambda r, s: r.element(kind, "S", s))):
            largest = np.abs(read(whole, 1)).max()
            error = np.abs(read(apart, 1) + read(apart, 2) - read(whole, 1)).max() / largest
            close(error, 0.0, 1e-9, "%s: %s of A and of B less that of A + B" % (kind, variable))
            close(np.abs(read(apart, 3)).max() / largest, 0.0, 1e-9, "%s: %s after unloading" % (kind, variable))
        energy = lambda name, step: apart.file["step_%d/history/energy/%s" % (step, name)][-1]
        close(energy("ALLIE", 1), energy("ALLWK", 1), 1e-8, "strain energy and work")
        close(energy("ETOTAL", 3) / energy("ALLWK", 1), 0.0, 1e-8, "energy after unloading")


def small_strain(runner):
    """A block pressed by 10 % under a linear step: S33 = E * strain and reactions of that times the area, at any strain;
    then its top is let go."""
    deck = brick((2, 2, 2), (20.0, 20.0, 10.0))
    deck.sets["BASE"] = deck.where(lambda x, y, z: z < 1e-9)
    deck.sets["TOP"] = deck.where(lambda x, y, z: z > 10.0 - 1e-9)
    deck.add(ELASTIC.format(young=500.0, poisson=0.0))
    deck.add(STEP % (", NLGEOM=NO", "*BOUNDARY\nBASE, 1, 3\nTOP, 3, 3, -1."))
    deck.add(STEP % (", NLGEOM=NO", "*BOUNDARY, OP=NEW\nBASE, 1, 3"))
    results = runner.run_alike("pressed", deck)
    for element in results.element("C3D8R", "S"):
        close(element[2], -50.0, 1e-9, "S33")
    close(sum(results.at(n, "RF")[2] for n in deck.sets["BASE"]), 20000.0, 1e-10, "reaction")
    close(np.abs(results.node("U", 2)).max(), 0.0, 1e-12, "displacement when let go")
    close(np.abs(results.element("C3D8R", "S", 2)).max() / 50.0, 0.0, 1e-10, "stress when let go")


def then_finite(runner):
    """A step with NLGEOM goes on from linear displacements, out of balance there by what linear steps leave out, and ends where
    one ends that was nonlinear from the start."""
    ends = []
    for name, first in (("linear_first", ""), ("finite", ", NLGEOM")):
        deck = bent("C3D8R")
        deck.add(STEP % (first, ROOT + "*CLOAD\n9001, 3, 50."))
        deck.add(STEP % (", NLGEOM", "*CLOAD\n9001, 3, 60."))
        results = runner.run_alike(name, deck)
        ends.append((results.node("U", 2), results.element("C3D8R", "S", 2)))
    for first, second, what in zip(*ends, ("U", "S")):
        close(np.abs(first - second).max() / np.abs(second).max(), 0.0, 1e-7, "difference in " + what)


CASES = {case.__name__: case for case in (superposition, small_strain, then_finite)}

if __name__ == "__main__":
    CASES[sys.argv[1]](Runner(sys.argv[2], sys.argv[3]))
