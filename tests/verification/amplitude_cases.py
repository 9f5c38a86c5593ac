"""What loads and motions with an amplitude do in the steps behind theirs: amplitude_cases.py CASE PROGRAM FOLDER.

Abaqus: a curve over step time leaves what it reached at the end of its step; one over total time goes on."""
import sys

from static_model import Deck, Runner, close

MASS, FORCE, SPEED = 2.0, 8.0, 3.0


def masses(procedure):
    """Node 1 is pushed, node 2 moved, by a curve over step time that ends at 0.5; node 3 is pushed by one over total time that falls
    to zero at the end of the second step. Step 2 says nothing of them."""
    deck = Deck()
    for number in (1, 2, 3):
        deck.add_node(number, float(number), 0.0, 0.0)
    deck.elements["MASS"] = [(number, [number]) for number in (1, 2, 3)]
    deck.sets["EACH"] = [1, 2, 3]
    deck.add("*MASS, ELSET=ALL\n%g\n*BOUNDARY\nEACH, 2, 3" % MASS)
    deck.add("*AMPLITUDE, NAME=OF-STEP\n0., 0., 0.5, 1., 1., 0.5\n*AMPLITUDE, NAME=OF-JOB, TIME=TOTAL TIME\n0., 1., 2., 0.")
    output = "*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU, V\n*END STEP"
    deck.add("*STEP, INC=100000\n%s\n*CLOAD, AMPLITUDE=OF-STEP\n1, 1, %g\n*CLOAD, AMPLITUDE=OF-JOB\n3, 1, %g\n"
             "*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=OF-STEP\n2, 1, 1, %g\n%s" % (procedure, FORCE, FORCE, SPEED, output))
    deck.add("*STEP, INC=100000\n%s\n%s" % (procedure, output))
    return deck


def check(results, tolerance, what):
    """In the second step: acceleration 0.5 F / m, velocity 0.5 v, and F / m (1 - t / 2) from t = 1 on."""
    before, after = results.frames(1)[-1], results.frames(2)[-1]
    change = lambda node, variable: (after["node/" + variable][results.row[node]] - before["node/" + variable][results.row[node]])[0]
    close(change(1, "V"), 0.5 * FORCE / MASS, tolerance, what + ": change of velocity under the force held")
    close(change(2, "U"), 0.5 * SPEED, tolerance, what + ": way at the velocity held")
    close(change(3, "V"), 0.25 * FORCE / MASS, tolerance, what + ": change of velocity under the force that goes on")


def explicit(runner):
    """Forces are linear in time over each increment, so that sums of impulses are trapezoids but for half an increment at the joints."""
    check(runner.run_alike("explicit", masses("*DYNAMIC, EXPLICIT, DIRECT\n1e-3, 1.")), 2e-3, "explicit")


def implicit(runner):
    """Without damping the mean of two trapezoids: exact, as the curves bend where increments end."""
    check(runner.run_alike("implicit", masses("*DYNAMIC, DIRECT, ALPHA=0.\n0.05, 1.")), 1e-9, "implicit")


CASES = {case.__name__: case for case in (explicit, implicit)}

if __name__ == "__main__":
    CASES[sys.argv[1]](Runner(sys.argv[2], sys.argv[3]))
