"""Decks whose printed tables are CalculiX's, every one of them: ccx_print_cases.py CASE PROGRAM FOLDER.

ccx/NAME.inp and ccx/NAME.dat: the deck and what `ccx -i NAME` of CalculiX 2.20 printed for it; on one rank and on two.
"""
import os
import re
import subprocess
import sys

import numpy as np

from launch import on_ranks
from static_model import close

HERE = os.path.dirname(os.path.abspath(__file__))

# Largest difference allowed in a table, relative to the largest value of all tables of its kind: both print seven digits.
TOLERANCE = {
    "held_loads": 1e-6,
    "sudden_loads": 1e-6,
    "dummy_node": 1e-6,
    "removed_elements": 1e-6,
    "equation_totals": 1e-6,
    "heated": 1e-6,  # temperatures of the points of C3D8I, C3D20, C3D20R, C3D10 and C3D15, and an alpha that varies
}


def tables(path):
    """(title, rows of numbers) of each table; headings of steps and increments, which are laid out otherwise, are left out."""
    found = []
    for line in open(path):
        packed = line.replace(" ", "")
        if re.search("[a-z]{4}", line):
            found.append((" ".join(line.split()), []))
        elif line.strip() and not packed.startswith(("STEP", "INCREMENT")):
            found[-1][1].append([float(n) for n in line.split()])
    return [(title, np.array(rows)) for title, rows in found if rows]


def kind_of(title):
    """What a table tells; totals may be nothing, and are measured by their parts."""
    return title.split("(")[0].replace("total force", "forces")


def main():
    name, program, folder = sys.argv[1:4]
    deck = os.path.join(HERE, "ccx", name + ".inp")
    theirs = tables(deck[:-4] + ".dat")
    largest = {}
    for title, rows in theirs:
        largest[kind_of(title)] = max(largest.get(kind_of(title), 0.0), np.abs(rows).max())
    for ranks in (1, 2):
        place = os.path.join(folder, "on_%d" % ranks)
        os.makedirs(place, exist_ok=True)
        done = subprocess.run([*on_ranks(ranks), program, "run", deck, "--output", place], capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, "left with %d\n%s%s" % (done.returncode, done.stdout[-2000:], done.stderr[-2000:])
        ours = tables(os.path.join(place, name + ".dat"))
        assert [title for title, _ in ours] == [title for title, _ in theirs], "tables differ: %s" % [title for title, _ in ours]
        for (title, mine), (_, reference) in zip(ours, theirs):
            close(np.abs(mine - reference).max() / largest[kind_of(title)], 0.0, TOLERANCE[name], title)


if __name__ == "__main__":
    main()
