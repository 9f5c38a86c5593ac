#!/usr/bin/env python3
"""Initial stresses that count for yielding, and those of beams: initial_stress_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from element_state_cases import CUBE, FIELD, stress_of
from job import check, run_case


def steel(run):
    """An initial stress counts for the yielding of solids: nothing moves at rest, and a bar flows when it is pulled by what lacks. In closed
    form, with Kirchhoff's stress tau of the law: tau = E (log(stretch) + tau_0 / E - p) = 10 + 50 p, Cauchy's exp(-(1 - 2 nu) tau / E) tau."""
    young, first = 1000.0, 8.0
    plastic_table = "*PLASTIC\n10., 0.\n20., 0.2\n"
    cauchy = lambda tau: tau * math.exp(-0.5 * tau / young)
    kirchhoff = first
    for _ in range(20):
        kirchhoff = first * math.exp(0.5 * kirchhoff / young)
    pulls = (0.001, 0.02)
    for kind, ranks in (("C3D8", 1), ("C3D8R", 2), ("C3D8I", 1)):
        step = "*STEP, NLGEOM\n*STATIC\n0.1, 1.\n*BOUNDARY\nRIGHT, 1, 1, {}\n" + FIELD.replace("S\n", "S, PEEQ\n") + "*END STEP\n"
        job = run(CUBE.format(kind=kind, plastic=plastic_table) + f"""*INITIAL CONDITIONS, TYPE=STRESS
CUBE, {first}
*STEP, NLGEOM
*STATIC
1., 1.
*BOUNDARY
RIGHT, 1
{FIELD}*END STEP
*STEP
*DYNAMIC, EXPLICIT
, 1e-3
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLKE
{FIELD}*END STEP
""" + "".join(step.format(pull) for pull in pulls), ranks)
        check(f"{kind}: at rest", abs(stress_of(job, kind, 1)[0] - first), 0.0, 1e-12)
        check(f"{kind}: nothing starts to move", np.abs(job.history("energy", "ALLKE", 2)[1]).max(), 0.0, 1e-20)
        for step, pull in zip((3, 4), pulls):
            elastic = young * math.log(1.0 + pull) + kirchhoff
            plastic = max(0.0, (elastic - 10.0) / (young + 50.0))
            check(f"{kind}: stress pulled by {pull}", stress_of(job, kind, step)[0], cauchy(elastic - young * plastic), 1e-6)


def heated(run):
    """An initial stress of steel stands before heat comes: held and heated at once, matter has what both make, as where it is elastic."""
    heat = "*INITIAL CONDITIONS, TYPE=STRESS\nCUBE, 3.\n*STEP{}\n*STATIC\n{}, 1.\n*BOUNDARY\nRIGHT, 1\n*TEMPERATURE\n1, 5.\n"
    heat += "".join(f"{node}, 5.\n" for node in range(2, 9)) + FIELD + "*END STEP\n"
    for kind, geometry, first in (("C3D8", ", NLGEOM", 1.0), ("C3D8R", ", NLGEOM", 0.1), ("C3D8", "", 1.0)):
        both = []
        for plastic in ("", "*PLASTIC\n10., 0.\n20., 0.2\n"):
            job = run(CUBE.format(kind=kind, plastic="*EXPANSION\n1e-3\n" + plastic) + heat.format(geometry, first), 1)
            both.append(stress_of(job, kind, 1)[0])
        strain = 0.5 * (1.005**-2 - 1.0)  # Green's, of the mechanical part; S = 1000 strain + 3, free across
        finite = (1000.0 * strain + 3.0) / 1.005 / (1.0 - 2.0 * 0.25 * strain)
        check(f"{kind}{geometry}: stress", both[0], finite if geometry else 3.0 - 5.0, 1e-8)
        check(f"{kind}{geometry}: of steel less of elastic matter", both[1] - both[0], 0.0, 5e-2)


def beams(run):
    """Held, a beam pulls with what it has; let go, it shortens; of steel it yields by what lacks. Explicit steps go on at rest."""
    young, area, first = 1000.0, 0.02, 8.0
    for plastic in ("", "*PLASTIC\n10., 0.\n20., 0.2\n"):
        step = "*STEP, NLGEOM\n*STATIC\n0.1, 1.\n*BOUNDARY, OP=NEW\n1, 1, 6\n2, 2, 6\n{}" + FIELD + "*END STEP\n"
        job = run(f"""*NODE
1, 0, 0, 0
2, 1, 0, 0
*ELEMENT, TYPE=B31, ELSET=BEAM
1, 1, 2
*BEAM SECTION, ELSET=BEAM, MATERIAL=M, SECTION=RECT
0.2, 0.1
0, 1, 0
*MATERIAL, NAME=M
*DENSITY
1e-3
*ELASTIC
{young}, 0.25
{plastic}*INITIAL CONDITIONS, TYPE=STRESS
BEAM, {first}
""" + step.format("2, 1\n") + """*STEP
*DYNAMIC, EXPLICIT
, 1e-2
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLKE
*END STEP
""" + step.format("2, 1, 1, 0.01\n") + step.format(""), 2)
        name = "steel" if plastic else "elastic"
        check(f"{name}: at rest", job.frame("RF", -1, 1)[1, 0], first * area, 1e-12)
        check(f"{name}: nothing starts to move", np.abs(job.history("energy", "ALLKE", 2)[1]).max(), 0.0, 1e-20)
        # Second Piola-Kirchhoff stress and Green's strain: elastic S = E strain; steel tau = S square, of the square 1 + 2 (strain + strain at rest).
        square, pull, released = 1.01**2, first + 0.5 * young * (1.01**2 - 1.0), 1.0 - 2.0 * first / young
        if plastic:
            at_rest = 1.0
            for _ in range(20):
                at_rest = math.exp(2.0 * first * at_rest / young)
            square += at_rest - 1.0
            flow = (0.5 * young * math.log(square) - 10.0) / (young + 50.0)
            pull, released = (10.0 + 50.0 * flow) / square, math.exp(2.0 * flow) - at_rest + 1.0
        check(f"{name}: pulled", job.frame("RF", -1, 3)[1, 0], pull * area * 1.01, 1e-9)
        check(f"{name}: let go", job.frame("U", -1, 4)[1, 0], math.sqrt(released) - 1.0, 1e-9)


if __name__ == "__main__":
    run_case(globals())
