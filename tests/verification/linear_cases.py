"""Geometrically linear steps through the whole program: linear_cases.py CASE PROGRAM FOLDER."""
import copy
import os
import sys

import numpy as np

from static_cases import ELASTIC, cantilever
from static_model import OUTPUT, Deck, Runner, brick, close

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


def equations_removed(runner):
    """Two bars whose ends an equation joins, then each alone; the next step, of large displacements, goes without it too."""
    deck = Deck()
    for number, x in ((1, (0, 0, 0)), (2, (1, 0, 0)), (3, (0, 1, 0)), (4, (1, 1, 0))):
        deck.add_node(number, *x)
    deck.elements["T3D2"] = [(1, [1, 2]), (2, [3, 4])]
    deck.sets["ENDS"] = [2, 4]
    deck.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n0.5\n*MATERIAL, NAME=M\n*ELASTIC\n2000., 0.\n"
             "*EQUATION\n2\n2, 1, 1., 4, 1, -1.\n*BOUNDARY\n1, 1, 3\n3, 1, 3\nENDS, 2, 3")
    deck.add(STEP % ("", "*CLOAD\n2, 1, 3."))
    deck.add(STEP % ("", "*EQUATION, REMOVE\n2, 1"))
    deck.add(STEP % (", NLGEOM", "*CLOAD\n2, 1, 0."))
    results = runner.run_alike("removed", deck)
    for number, step, expected in ((2, 1, 1.5e-3), (4, 1, 1.5e-3), (2, 2, 3e-3), (4, 2, 0.0), (2, 3, 0.0), (4, 3, 0.0)):
        close(results.at(number, "U", step)[0], expected, 1e-9, "end %d in step %d" % (number, step))


def released(runner):
    """Implicit dynamics go on without an equation that linked two masses: each then moves with the velocity that both had."""
    deck = Deck()
    deck.add_node(1, 0, 0, 0)
    deck.add_node(2, 1, 0, 0)
    deck.elements["MASS"] = [(1, [1]), (2, [2])]
    deck.add("*MASS, ELSET=ALL\n2.\n*EQUATION\n2\n2, 1, 1., 1, 1, -1.\n*BOUNDARY\n1, 2, 3\n2, 2, 3")
    step = ("*STEP, INC=1000%s\n*DYNAMIC, DIRECT, ALPHA=0.\n0.05, 1.\n%s\n"
            "*OUTPUT, FIELD, FREQUENCY=20, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*END STEP")
    for nlgeom in ("", ", NLGEOM"):
        deck_of_one = copy.deepcopy(deck)
        deck_of_one.add(step % (nlgeom, "*CLOAD\n2, 1, 4."))
        deck_of_one.add(step % (nlgeom, "*EQUATION, REMOVE ALL"))
        results = runner.run_alike("released" + nlgeom.strip(", ").lower(), deck_of_one)
        close(results.at(1, "U", 1)[0], 0.5, 1e-9, "both under the force")
        close(results.at(1, "U", 2)[0], 1.5, 1e-9, "the one that goes on alone")
        close(results.at(2, "U", 2)[0], 2.5, 1e-9, "the one that the force drives")


def mean_rotation(runner):
    """A block whose upper corners turn by a mean angle: each turns by it, in large displacements too; the couple at the node of
    the angle is that which the base bears, and the work of it the strain energy."""
    for nlgeom, angle in (("", 1e-3), (", NLGEOM", 0.5)):
        deck = brick((1, 1, 2), (1.0, 1.0, 2.0), "C3D8")
        deck.sets["BASE"] = deck.where(lambda x, y, z: z < 1e-9)
        corners = deck.where(lambda x, y, z: z > 2.0 - 1e-9)
        deck.add_node(99, 0.0, 0.0, 2.0)
        deck.sets["ANGLE"] = [99]
        deck.add(ELASTIC.format(young=500.0, poisson=0.0))
        thrice = ", ".join("%d, %d, %d" % (n, n, n) for n in corners)
        deck.add("*MPC\nMEANROT, %s, 99" % thrice)
        deck.add(STEP % (nlgeom, "*BOUNDARY\nBASE, 1, 3\n99, 1, 1, %g\n*NODE PRINT, NSET=ANGLE\nRF" % angle))
        results = runner.run_alike("turned" + nlgeom.strip(", ").lower(), deck)
        for n in corners:
            x, u = np.array(deck.nodes[n]) - 0.5, results.at(n, "U")
            turned = np.arctan2(x[0] * (x[1] + u[1]) - x[1] * (x[0] + u[0]), x[0] * (x[0] + u[0]) + x[1] * (x[1] + u[1]))
            close(turned, angle, 1e-6 if nlgeom else 1e-5, "angle of corner %d" % n)
        couple = 0.0
        for n in deck.sets["BASE"]:
            (x, y, _), force = deck.nodes[n], results.at(n, "RF")
            couple += (x - 0.5) * force[1] - (y - 0.5) * force[0]
        close(results.at(99, "RF")[0], -couple, 1e-7, "couple")
        name = "turned" + nlgeom.strip(", ").lower()
        rows = [line.split() for line in open(os.path.join(runner.folder, name + "_2", name + ".dat"))]
        close(float([row for row in rows if row[:1] == ["99"]][-1][1]), -couple, 1e-6, "couple in the table")
        energy = lambda name: results.file["step_1/history/energy/" + name][-1]
        if not nlgeom:
            close(energy("ALLIE"), 0.5 * angle * results.at(99, "RF")[0], 1e-6, "strain energy and work")


def dummy_nodes(runner):
    """Nodes of no element have those degrees of freedom alone that an equation or a spring uses: the top of a block follows node 100 in
    one, which a spring joins to one of node 200. A force there stretches both; natural modes are those of a top that stays plane."""
    young, stiffness, force = 1000.0, 50.0, 3.0
    deck = brick((1, 1, 1), (1.0, 1.0, 1.0), "C3D8")
    top = deck.where(lambda x, y, z: z > 0.5)
    deck.sets.update(BASE=deck.where(lambda x, y, z: z < 0.5), FIRST=top[:1])
    plane = copy.deepcopy(deck)
    deck.add_node(100, 0.0, 0.0, 2.0)
    deck.add_node(200, 0.0, 0.0, 3.0)
    deck.elements["SPRING2"] = [(9, [200, 100])]
    for each, leader, followers in ((deck, 100, top), (plane, top[0], top[1:])):
        each.add("*SOLID SECTION, ELSET=BLOCK, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n%g, 0.\n*DENSITY\n2.\n*ELSET, ELSET=BLOCK\n1" % young)
        each.add("*BOUNDARY\nBASE, 1, 3")
        each.add("\n".join("*EQUATION\n2\n%d, 3, 1., %d, 3, -1." % (n, leader) for n in followers))
    deck.add("*ELSET, ELSET=SPRING\n9\n*SPRING, ELSET=SPRING\n1, 3\n%g" % stiffness)
    modes = "*STEP\n*FREQUENCY\n3\n*END STEP"
    loaded = copy.deepcopy(deck)
    loaded.add(STEP % ("", "*CLOAD\n200, 1, %g" % force))
    loaded.add(STEP % (", NLGEOM", ""))
    results = runner.run_alike("dummy", loaded)
    for step, stretch in ((1, force / young), (2, results.at(100, "U", 2)[2])):
        strain = stretch + 0.5 * stretch**2 if step == 2 else stretch
        close(young * strain * (1.0 + stretch if step == 2 else 1.0), force, 1e-8, "force in the block of step %d" % step)
        for n in (*top, 100):
            close(results.at(n, "U", step)[2], stretch, 1e-8, "top in step %d" % step)
        close(results.at(200, "U", step)[0], stretch + force / stiffness, 1e-8, "end of the spring in step %d" % step)
    alone, still = copy.deepcopy(deck), copy.deepcopy(plane)
    alone.add(modes)
    still.add(modes)
    eigenvalues = [[results.file["step_1/mode_%d" % k].attrs["eigenvalue"] for k in (1, 2, 3)]
                   for results in (runner.run("alone", alone, 1), runner.run("alone", alone, 2), runner.run("plane", still, 1))]
    for k in range(3):
        close(eigenvalues[0][k], eigenvalues[2][k], 1e-9, "mode %d" % (k + 1))
        close(eigenvalues[1][k], eigenvalues[2][k], 1e-9, "mode %d on two ranks" % (k + 1))
    deck.add(STEP % ("", "*CLOAD\n200, 2, 1."))
    for ranks in (1, 2):
        done, _ = runner.launch("refused", deck, ranks)
        assert done.returncode == 2 and "nothing uses degree of freedom 2 of node 200" in done.stdout + done.stderr, done.stdout + done.stderr


CASES = {case.__name__: case for case in (superposition, small_strain, then_finite, equations_removed, released, mean_rotation, dummy_nodes)}

if __name__ == "__main__":
    CASES[sys.argv[1]](Runner(sys.argv[2], sys.argv[3]))
