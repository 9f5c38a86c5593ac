#!/usr/bin/env python3
"""*MPC: angles of its joints, chains of its rigid arms: multi_point_cases.py CASE BALOCCO FOLDER."""
import itertools
import math

import numpy as np

from job import check, check_energy, run_case
from motion_decks import GRAVITY, explicit_step, history

STEP = "*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1., 1e-6, 0.1\n"
LINEAR = "*STEP\n*STATIC\n1., 1.\n"
SHOWN = "*OUTPUT, FIELD, FREQUENCY=1000000\n*NODE OUTPUT\nU\n*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=SHOWN\nU, UR, RM\n*END STEP\n"


def rotor(joint, inertia=0.02, stiffness=0.0):
    """Node 2 turns against node 1, which is held, about the z axis; nodes 11 and 12 show the axes z and x. Node 3 is at the end of an arm."""
    spring = f"*ELEMENT, TYPE=SPRING1, ELSET=K\n6, 2\n*SPRING, ELSET=K\n6\n{stiffness}\n" if stiffness > 0.0 else ""
    return f"""*NODE
1, 0.1, 0.2, 0.3
2, 0.1, 0.2, 0.3
3, 0.4, 0.3, 0.1
11, 0.1, 0.2, 0.8
12, 0.6, 0.2, 0.3
*NSET, NSET=SHOWN
2, 3, 11, 12
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 2
*MASS, ELSET=M
2.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 1
4, 2
*ROTARY INERTIA, ELSET=I
{inertia}, {inertia}, {inertia}
{spring}*MPC
{joint}
PIN, 2, 1
BEAM, 3, 2
*BOUNDARY
1, 1, 6
"""


REVOLUTE, UNIVERSAL = "REVOLUTE, 2, 1, 11", "UNIVERSAL, 2, 1, 11, 12"
OUT = "*OUTPUT, HISTORY, TIME INTERVAL=0.02\n*NODE OUTPUT, NSET=SHOWN\nU, UR, VR, RM\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ETOTAL\n"


def revolute_angle(run):
    """Freedom 6 of the third node of REVOLUTE is the joint's angle: it is told, prescribed and loaded there."""
    inertia, stiffness = 0.02, 0.5
    ranks = itertools.cycle((1, 2))
    job = run(rotor(REVOLUTE) + explicit_step(1e-4, 0.5, "*BOUNDARY, TYPE=VELOCITY\n11, 6, 6, 15.\n", OUT), next(ranks))
    time, shown = job.history("node_11", "UR")
    check("angle that is driven, beyond whole turns", np.abs(shown[:, 2] - 15.0 * time).max(), 0.0, 1e-10)
    check("turn of the rotor", np.abs(job.history("node_2", "UR")[1][:, 2] - 15.0 * time).max(), 0.0, 1e-10)
    check("rate of the angle", np.abs(job.history("node_11", "VR")[1][1:, 2] - 15.0).max(), 0.0, 1e-9)
    job = run(rotor(REVOLUTE) + explicit_step(1e-4, 0.5, "*CLOAD\n11, 6, 0.1\n", OUT), next(ranks))
    time, shown = job.history("node_11", "UR")
    check("angle under a moment", np.abs(shown[:, 2] - 0.5 * 0.1 / inertia * time**2).max(), 0.0, 1e-3)
    check_energy(job, 1e-3)
    job = run(rotor(REVOLUTE) + explicit_step(1e-4, 0.5, "*BOUNDARY, TYPE=ACCELERATION\n11, 6, 6, 3.\n", OUT), next(ranks))
    moment = job.history("node_11", "RM")[1][2:, 2]
    # The round-off of an angle of 0.4 rad is a moment of 1e-16 * 0.4 * inertia / (1e-4)^2, 1e-10.
    check("moment that accelerates it", np.abs(moment - 3.0 * inertia).max(), 0.0, 1e-8)
    for kind, step in (("large", STEP), ("small", LINEAR)):
        sprung = rotor(REVOLUTE, stiffness=stiffness) + step
        job = run(sprung + "*CLOAD\n11, 6, 0.1\n" + SHOWN, next(ranks))
        check(f"angle against a spring, {kind}", job.history("node_11", "UR")[1][-1][2], 0.1 / stiffness, 1e-10)
        job = run(sprung + "*BOUNDARY\n11, 6, 6, 0.7\n" + SHOWN, next(ranks))
        check(f"turn of the rotor, {kind}", job.history("node_2", "UR")[1][-1][2], 0.7, 1e-10)
        check(f"moment that holds the angle, {kind}", job.history("node_11", "RM")[1][-1][2], 0.7 * stiffness, 1e-9)
    job = run(rotor(REVOLUTE, stiffness=stiffness) + LINEAR + "*CLOAD\n2, 6, 0.1\n" + SHOWN, next(ranks))
    check("angle that a linear step tells", job.history("node_11", "UR")[1][-1][2], 0.1 / stiffness, 1e-12)
    check("the step is linear", float("linear geometry" in job.log()), 1.0, 0.0)
    held = rotor(REVOLUTE, stiffness=stiffness) + "*BOUNDARY\n11, 6\n"
    second = STEP + "*BOUNDARY, OP=NEW\n1, 1, 6\n*CLOAD\n2, 6, 0.1\n" + SHOWN
    job = run(held + STEP + "*CLOAD\n2, 6, 0.1\n" + SHOWN + second, next(ranks))
    check("angle that is held from the start", np.abs(job.history("node_11", "UR")[1]).max(), 0.0, 1e-12)
    check("moment that holds it", job.history("node_11", "RM")[1][-1][2], -0.1, 1e-9)
    check("angle that is let go", job.history("node_11", "UR", 2)[1][-1][2], 0.1 / stiffness, 1e-9)
    job = run(rotor(REVOLUTE, stiffness=stiffness) + "*STEP, NLGEOM, INC=1000\n*DYNAMIC, ALPHA=0., DIRECT\n0.005, 1.\n*CLOAD\n2, 6, 0.1\n" + SHOWN, next(ranks))
    time, shown = job.history("node_11", "UR")
    expected = 0.1 / stiffness * (1.0 - np.cos(math.sqrt(stiffness / inertia) * time))
    check("angle in implicit dynamics", np.abs(shown[:, 2] - expected).max(), 0.0, 2e-4)


def universal_angles(run):
    """The angles of UNIVERSAL are about the first axis and then about the second one, which the first has turned."""
    about = lambda axis, angle: np.eye(3) + math.sin(angle) * axis + (1.0 - math.cos(angle)) * axis @ axis
    z, x = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0.0]]), np.array([[0, 0, 0], [0, 0, -1], [0, 1, 0.0]])
    arm = np.array((0.3, 0.1, -0.2))
    for ranks in (1, 2):
        job = run(rotor(UNIVERSAL) + STEP + "*BOUNDARY\n11, 6, 6, 0.9\n12, 6, 6, -0.6\n" + SHOWN, ranks)
        check("end of the arm", np.abs(job.history("node_3", "U")[1][-1] - (about(z, 0.9) @ about(x, -0.6) @ arm - arm)).max(), 0.0, 1e-10)
        check("the first angle", job.history("node_11", "UR")[1][-1][2], 0.9, 1e-10)
        check("the second angle", job.history("node_12", "UR")[1][-1][2], -0.6, 1e-10)


PLACES = {1: (0.0, 0.0, 0.0), 2: (1.0, 0.0, 0.0), 3: (1.0, 1.0, 0.0), 4: (1.0, 1.0, 0.7)}
JOINED = {"one body": "*NSET, NSET=REST{0}\n{2}, {3}, {4}\n*RIGID BODY, REF NODE={1}, TIE NSET=REST{0}\n",
          "outwards": "*MPC\nBEAM, {2}, {1}\nBEAM, {3}, {2}\nBEAM, {4}, {3}\n",
          "inwards": "*MPC\nBEAM, {4}, {3}\nBEAM, {3}, {2}\n*MPC\nBEAM, {2}, {1}\n",
          "meeting": "*MPC\nBEAM, {2}, {1}\nBEAM, {2}, {3}\nBEAM, {4}, {3}\n",
          "of connectors": "*ELEMENT, TYPE=CONN3D2, ELSET=WELDS\n{0}501, {1}, {2}\n{0}502, {3}, {2}\n{0}503, {3}, {4}\n"
                           "*CONNECTOR SECTION, ELSET=WELDS\nBEAM\n"}


def number(copy, node):
    """The node of PLACES in one of the copies."""
    return 10 * copy + node


def of_copies(*texts):
    """A text for each copy of the nodes, the same one where one is given: {1} to {4} are its nodes, {0} its number."""
    texts = texts if len(texts) > 1 else texts * len(JOINED)
    return "".join(text.format(copy, *(number(copy, node) for node in PLACES)) for copy, text in enumerate(texts))


def points():
    """Four nodes for each way to join them, apart by numbers alone."""
    nodes = "".join(f"{number(copy, node)}, {x}, {y}, {z}\n" for copy in range(len(JOINED)) for node, (x, y, z) in PLACES.items())
    return "*NODE, NSET=ALL\n" + nodes + of_copies(*JOINED.values())


def lengths(ways):
    """How far the nodes' distances get from those at the start."""
    at = {node: np.array(place) + way for (node, place), way in zip(PLACES.items(), ways)}
    return max(np.abs(np.linalg.norm(at[a] - at[b], axis=1) - math.dist(PLACES[a], PLACES[b])).max() for a in at for b in at if a < b)


def rigid_chains(run):
    """Rigid arms from node to node, none of which an element turns: one rigid body, in statics on springs, thrown, and hung up."""
    mass = lambda node: f"*ELEMENT, TYPE=MASS, ELSET=M{node}\n" + of_copies(f"{{{node}}}, {{{node}}}\n") + f"*MASS, ELSET=M{node}\n{0.5 * node}\n"
    spring = lambda node, dof: (f"*ELEMENT, TYPE=SPRING1, ELSET=K{node}{dof}\n" + of_copies(f"{{{node}}}{dof}, {{{node}}}\n")
                                + f"*SPRING, ELSET=K{node}{dof}\n{dof}\n{100.0 * node + 10.0 * dof}\n")
    masses = "".join(mass(node) for node in PLACES)
    springs = "".join(spring(node, dof) for node in PLACES for dof in (1, 2, 3))
    thrown = ("*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\nALL, 3., 0.2, -0.1, 0.3\n0., 0., 0., 1., 2., 3.\n"
              + explicit_step(1e-4, 0.2, "*CLOAD\n" + of_copies("{4}, 1, 2.\n{4}, 2, -1.\n"), history("ALL", "U", 0.02)))
    hung = "*BOUNDARY\n" + of_copies("{1}, 1, 3\n") + explicit_step(1e-4, 0.2, GRAVITY, history("ALL", "U", 0.02))
    static = lambda step: step + "*CLOAD\n" + of_copies("{4}, 1, 20.\n{4}, 2, -15.\n{3}, 3, 25.\n") + SHOWN.replace("SHOWN", "ALL")
    for name, elements, step, tolerance in (("thrown", masses, thrown, 1e-6), ("hung up", masses, hung, 1e-6),
                                            ("on springs", springs, static(STEP), 1e-8), ("on springs, linear", springs, static(LINEAR), 1e-9)):
        for ranks in (1, 2):
            job = run(points() + elements + step, ranks)
            all_ways = [[job.history(f"node_{number(copy, node)}", "U")[1] for node in PLACES] for copy in range(len(JOINED))]
            check(f"{name}: it moves", float(np.abs(all_ways[0]).max() > 0.03), 1.0, 0.0)
            for order, ways in list(zip(JOINED, all_ways))[1:]:
                check(f"{name}, {order}: as one body", np.abs(np.array(ways) - all_ways[0]).max(), 0.0, tolerance)
                if "linear" not in name:
                    check(f"{name}, {order}: distances", lengths(ways), 0.0, 1e-12 if "springs" not in name else 1e-9)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (revolute_angle, universal_angles, rigid_chains)})
