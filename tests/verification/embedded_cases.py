#!/usr/bin/env python3
"""*EMBEDDED ELEMENT: embedded_cases.py CASE BALOCCO FOLDER."""
import sys

import numpy as np

from static_model import OUTPUT, Runner, brick

STRAIN = np.array(((2e-3, 1e-3, 0.0), (0.0, -1e-3, 5e-4), (3e-4, 0.0, 1e-3)))
MATERIAL = """*ELSET, ELSET=HOSTS, GENERATE
1, 8
*ELSET, ELSET=INSIDE
101
*SOLID SECTION, ELSET=ALL, MATERIAL=M
*MATERIAL, NAME=M
*ELASTIC
200., 0.3
*EMBEDDED ELEMENT, HOST ELSET=HOSTS
INSIDE
*STEP
*STATIC
"""


def patch(runner):
    """A distorted brick across the faces of its hosts, whose nodes are given a homogeneous strain: it strains as they do, and is where
    the field says."""
    deck = brick((2, 2, 2), (1.0, 1.0, 1.0), "C3D8")
    corners = ((0.2, 0.15, 0.3), (0.8, 0.2, 0.25), (0.75, 0.8, 0.3), (0.25, 0.7, 0.2), (0.2, 0.2, 0.8), (0.7, 0.25, 0.9), (0.8, 0.8, 0.7), (0.3, 0.75, 0.8))
    for i, corner in enumerate(corners):
        deck.add_node(101 + i, *corner)
    deck.elements["C3D8"].append((101, list(range(101, 109))))
    deck.add(MATERIAL + "*BOUNDARY")
    for number, x in deck.nodes.items():
        if number < 101:
            for dof, value in enumerate(STRAIN @ np.array(x)):
                deck.add("%d, %d, %d, %.17g" % (number, dof + 1, dof + 1, value))
    deck.add(OUTPUT + "*END STEP")
    results = runner.run_alike("patch", deck)
    for number, x in deck.nodes.items():
        apart = np.abs(results.at(number, "U") - STRAIN @ np.array(x)).max()
        assert apart <= 1e-13, "node %d is %g from the field" % (number, apart)
    stress = results.element("C3D8", "S")
    assert np.abs(stress - stress[0]).max() <= 1e-10 * np.abs(stress).max(), "stresses differ"


if __name__ == "__main__":
    {"patch": patch}[sys.argv[1]](Runner(*sys.argv[2:4]))
