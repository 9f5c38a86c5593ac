#!/usr/bin/env python3
"""Beams and nodes that turn, in both procedures: beam_cases.py CASE BALOCCO FOLDER."""
import math
import os
import re
import subprocess
import sys

import h5py
import numpy as np

from job import Job, check, check_energy, failures

YOUNG, DENSITY, WIDTH, HEIGHT = 210e9, 7850.0, 0.02, 0.01


def beam(count, place, material="", direction="0., 0., 1."):
    """A chain of `count` beams along place(0) .. place(1), fixed at its start; its end is the set TIP."""
    nodes = "\n".join("%d, %.17g, %.17g, %.17g" % (i + 1, *place(i / count)) for i in range(count + 1))
    elements = "\n".join("%d, %d, %d" % (i + 1, i + 1, i + 2) for i in range(count))
    return f"""*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=B31, ELSET=BEAM
{elements}
*NSET, NSET=TIP
{count + 1}
*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT
{WIDTH}, {HEIGHT}
{direction}
*MATERIAL, NAME=STEEL
*ELASTIC
{YOUNG}, 0.3
*DENSITY
{DENSITY}
{material}"""


OUTPUT = """*OUTPUT, HISTORY, TIME INTERVAL=%g
*NODE OUTPUT, NSET=TIP
U, UR
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
"""
CLAMP = "*BOUNDARY\n1, 1, 6\n"


def straight(t):
    return (t, 0.0, 0.0)


def arc(t):
    return (math.sin(t), 1.0 - math.cos(t), 0.2 * t)


def import_at_rest(job):
    """A curved beam bent far by a force and a moment goes on in an explicit step, and back into statics, as it was."""
    loads = "*CLOAD\nTIP, 3, 400.\nTIP, 2, -200.\nTIP, 6, 150.\n"
    static = "*STEP, NLGEOM\n*STATIC\n0.25, 1.\n" + CLAMP + loads + OUTPUT % 1.0 + "*END STEP\n"
    job.run(beam(12, arc) + static + "*STEP\n*DYNAMIC, EXPLICIT\n, 2e-3\n*BULK VISCOSITY\n0., 0.\n" + loads + OUTPUT % 1e-4 +
            "*END STEP\n" + static)
    imbalance = float(re.search(r"\|f_ext\| = ([0-9.e+-]+)", job.log()).group(1))
    check("imbalance at the start of the explicit step", imbalance, 0.0, 1e-8)
    for variable in ("U", "UR"):
        bent = job.history(f"node_13", variable, 1)[1][-1]
        moved = job.history(f"node_13", variable, 2)[1]
        check(f"drift of {variable}", np.abs(moved - bent).max() / np.abs(bent).max(), 0.0, 1e-3)
        check(f"{variable} found again by statics", np.abs(job.history("node_13", variable, 3)[1][-1] - bent).max() /
              np.abs(bent).max(), 0.0, 1e-6)
    iterations = re.findall(r"increment 1: step time .* ([0-9]+) iterations", job.log())
    check("iterations of the second static step", min(int(iterations[-1]), 2), int(iterations[-1]), 0.0)


def vibration(job):
    """A cantilever let go: 3.5160 / (2 pi) sqrt(E I / (rho A L^4)) (Euler and Bernoulli) is its first frequency."""
    job.run(beam(16, straight, direction="0., 1., 0.") + "*STEP, NLGEOM\n*STATIC\n1., 1.\n" + CLAMP +
            "*CLOAD\nTIP, 3, 1.\n" + OUTPUT % 1.0 + "*END STEP\n*STEP\n*DYNAMIC, EXPLICIT\n, 1.2\n*CLOAD, OP=NEW\n*BULK VISCOSITY\n0., 0.\n" +
            OUTPUT % 5e-4 + "*END STEP\n")
    check("static deflection", job.history("node_17", "U")[1][-1, 2], 1.0 / (3.0 * YOUNG * WIDTH * HEIGHT**3 / 12.0), 1e-3)
    time, w = job.history("node_17", "U", 2)
    w = w[:, 2]
    falls = [i for i in range(len(w) - 1) if w[i] > 0.0 >= w[i + 1]]
    at = [time[i] + (time[i + 1] - time[i]) * w[i] / (w[i] - w[i + 1]) for i in falls]
    expected = 3.5160 / (2.0 * math.pi) * math.sqrt(YOUNG * HEIGHT**2 / 12.0 / DENSITY)
    check("first frequency", (len(at) - 1) / (at[-1] - at[0]), expected, 5e-3)
    check_energy(job, 1e-3, steps=(2,))


def tumbling(job):
    """A spinning curved beam under a moment at its end: the same bits on 1, 2 and 3 ranks, and after a restart on another number."""
    deck = beam(30, arc) + """*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
ALL, 100.
0., 0., 0., 0., 1., 0.3
*STEP
*DYNAMIC, EXPLICIT
, 4e-3
*CLOAD
TIP, 5, 30.
TIP, 1, 200.
*RESTART, WRITE, NUMBER INTERVAL=4
*OUTPUT, FIELD, NUMBER INTERVAL=4
*NODE OUTPUT
U, UR, VR
*ELEMENT OUTPUT
S, SF, SM
""" + OUTPUT % 1e-4 + "*END STEP\n"
    found = []
    for ranks in ("1", "2", "3"):
        job.ranks = ranks
        job.run(deck)
        found.append([job.frame(variable, -1) for variable in ("U", "UR", "VR")])
    turned = np.abs(found[0][1]).max()
    check("it tumbles", float(turned > 0.3), 1.0, 0.0)
    for other in found[1:]:
        check("bits that differ between ranks", sum(int((a != b).sum()) for a, b in zip(found[0], other)), 0, 0.0)
    check_energy(job, 1e-3)


CASES = {case.__name__: case for case in (import_at_rest, vibration, tumbling)}

if __name__ == "__main__":
    case, balocco, folder = sys.argv[1:]
    CASES[case](Job(case, balocco, "1", folder))
    sys.exit(f"{len(failures)} checks failed" if failures else 0)
