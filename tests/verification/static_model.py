"""Decks for the static verification cases, runs of the program, and what its result files say."""
import math
import os
import subprocess

import h5py
import numpy as np

from launch import on_ranks


class Deck:
    """Nodes, elements and keyword text of a deck."""

    def __init__(self):
        self.nodes = {}
        self.elements = {}  # type -> list of (id, nodes)
        self.sets = {}
        self.text = []

    def add_node(self, number, x, y, z):
        self.nodes[number] = (x, y, z)

    def node_at(self, point, tolerance=1e-9):
        for number, x in self.nodes.items():
            if max(abs(a - b) for a, b in zip(x, point)) < tolerance:
                return number
        raise KeyError(point)

    def where(self, condition):
        return [n for n, x in self.nodes.items() if condition(*x)]

    def add(self, text):
        self.text.append(text.strip("\n"))

    def write(self, path):
        with open(path, "w") as out:
            out.write("*HEADING\nstatic verification\n*NODE\n")
            for number, x in self.nodes.items():
                out.write("%d, %.17g, %.17g, %.17g\n" % (number, *x))
            for kind, elements in self.elements.items():
                out.write("*ELEMENT, TYPE=%s, ELSET=ALL\n" % kind)
                for number, nodes in elements:
                    out.write("%d, %s\n" % (number, ", ".join(map(str, nodes))))
            for name, members in self.sets.items():
                out.write("*NSET, NSET=%s\n" % name)
                for i in range(0, len(members), 10):
                    out.write(", ".join(map(str, members[i:i + 10])) + "\n")
            out.write("\n".join(self.text) + "\n")


def brick(counts, lengths, kind="C3D8R", transform=None, first_node=1, first_element=1):
    """A block of bricks from the origin, its nodes moved by `transform`."""
    deck = Deck()
    nx, ny, nz = counts
    number = lambda i, j, k: first_node + i + (nx + 1) * (j + (ny + 1) * k)
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                x = (lengths[0] * i / nx, lengths[1] * j / ny, lengths[2] * k / nz)
                deck.add_node(number(i, j, k), *(transform(*x) if transform else x))
    elements = deck.elements.setdefault(kind, [])
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                low = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                high = [number(i, j, k + 1), number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1)]
                elements.append((first_element + len(elements), low + high))
    return deck


OUTPUT = """
*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF, UR, RM
*ELEMENT OUTPUT
S
"""


class Results:
    """Frames of a finished run."""

    def __init__(self, path):
        self.file = h5py.File(path, "r")
        self.ids = self.file["mesh/node/id"][:]
        self.row = {int(n): i for i, n in enumerate(self.ids)}

    def frames(self, step):
        group = self.file["step_%d" % step]
        names = sorted((n for n in group if n.startswith("frame_")), key=lambda n: int(n[6:]))
        return [group[n] for n in names]

    def node(self, variable, step=1, frame=-1):
        return self.frames(step)[frame]["node/" + variable][:]

    def at(self, number, variable, step=1, frame=-1):
        return self.node(variable, step, frame)[self.row[number]]

    def element(self, kind, variable, step=1, frame=-1):
        return self.frames(step)[frame]["element/%s/%s" % (kind, variable)][:]


class Runner:
    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def launch(self, name, deck, ranks, options=(), place=None):
        """Runs in the folder `place`, or in one for this number of ranks."""
        folder = os.path.join(self.folder, place or "%s_%d" % (name, ranks))
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, name + ".inp")
        deck.write(path)
        command = [*on_ranks(ranks), self.program, "run", path, "--output", folder, *options]
        done = subprocess.run(command, capture_output=True, text=True, timeout=240)
        return done, os.path.join(folder, name)

    def run(self, name, deck, ranks=1, options=(), place=None):
        done, base = self.launch(name, deck, ranks, options, place)
        assert done.returncode == 0, "%s on %d ranks left with %d\n%s%s" % (
            name, ranks, done.returncode, done.stdout[-3000:], done.stderr[-3000:])
        results = Results(base + ".h5")
        results.log = open(base + ".log").read()
        return results

    def results(self, name, ranks):
        """What launch() left."""
        return Results(os.path.join(self.folder, "%s_%d" % (name, ranks), name + ".h5"))

    def run_alike(self, name, deck):
        """Runs on one and on two ranks; both must agree to 1e-10 of the largest displacement: all that differs is the order of
        elimination in the linear solver, and Newton ends at 1e-9 of the forces or better."""
        one, two = self.run(name, deck, 1), self.run(name, deck, 2)
        steps = range(1, 1 + sum(n.startswith("step_") for n in one.file))
        largest = max(np.abs(one.node("U", step)).max() for step in steps)
        for step in steps:
            difference = np.abs(one.node("U", step) - two.node("U", step)).max()
            assert difference <= 1e-10 * largest, "ranks differ by %g in step %d" % (difference, step)
        return one


def close(actual, expected, tolerance, what):
    error = abs(actual - expected) / abs(expected) if expected else abs(actual)
    print("%s: %.6g, expected %.6g, off by %.2e (allowed %.0e)" % (what, actual, expected, error, tolerance))
    assert math.isfinite(actual) and error <= tolerance, what
