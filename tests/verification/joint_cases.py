#!/usr/bin/env python3
"""Links, chains and loops of bars against closed forms and fine integrations: joint_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import check, check_energy, run_case
from motion_decks import G, GRAVITY, explicit_step, history, integrate


def masses_on_links(run):
    """PEND and a double pendulum: point masses on links of 1 m, released level."""

    def swing(x):  # angles below the horizontal, and their rates, of equal masses on equal links
        a, b, u, v = x
        matrix = np.array([[2.0, math.cos(a - b)], [math.cos(a - b), 1.0]])
        right = np.array([2.0 * G * math.cos(a) - v * v * math.sin(a - b), G * math.cos(b) + u * u * math.sin(a - b)])
        return np.array([u, v, *np.linalg.solve(matrix, right)])

    for ranks in (1, 2):
        job = run(f"""*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
*NSET, NSET=BOBS
2, 3
*ELEMENT, TYPE=MASS, ELSET=BOBS
1, 2
2, 3
*MASS, ELSET=BOBS
1.
*MPC
LINK, 2, 1
LINK, 3, 2
*BOUNDARY
1, 1, 3
""" + explicit_step(1e-4, 2.0, GRAVITY, history("BOBS", "U1, U2", 0.02)), ranks)
        time, x = job.history("node_2", "U1")
        y = job.history("node_2", "U2")[1]
        u, v = job.history("node_3", "U1")[1], job.history("node_3", "U2")[1]
        angles = integrate(swing, [0.0, 0.0, 0.0, 0.0], time)
        early = time <= 1.0  # it is chaotic later
        check("way of the first mass", np.abs(1.0 + x - np.cos(angles[:, 0]))[early].max(), 0.0, 1e-5)
        check("way of the second mass", np.abs(2.0 + u - np.cos(angles[:, 0]) - np.cos(angles[:, 1]))[early].max(), 0.0, 1e-5)
        check("length of the first link", np.abs(np.hypot(1.0 + x, y) - 1.0).max(), 0.0, 1e-12)
        check("length of the second link", np.abs(np.hypot(1.0 + u - x, v - y) - 1.0).max(), 0.0, 1e-12)
        check_energy(job, 1e-4)


def rods(points, density=1.0):
    """Rigid bars between successive points, hinged to each other and, first and last, to the ground where `ground` nodes are put at
    the same places: the deck down to its steps, and the ids of the bars' centres."""
    lines = {"node": [], "mass": [], "inertia": [], "rigid": [], "hinge": []}
    centres = []
    for i, (a, b) in enumerate(zip(points[:-1], points[1:])):
        first, second, centre = 10 * i + 11, 10 * i + 12, 10 * i + 13
        length = math.dist(a, b)
        middle = [(p + q) / 2 for p, q in zip(a, b)]
        for node, at in ((first, a), (second, b), (centre, middle)):
            lines["node"].append(f"{node}, {at[0]!r}, {at[1]!r}, 0.")
        mass = density * length
        lines["mass"].append(f"*ELEMENT, TYPE=MASS, ELSET=M{i}\n{1000 + i}, {centre}\n*MASS, ELSET=M{i}\n{mass!r}")
        inertia = mass * length**2 / 12.0
        lines["inertia"].append(f"*ELEMENT, TYPE=ROTARYI, ELSET=I{i}\n{2000 + i}, {centre}\n*ROTARY INERTIA, ELSET=I{i}\n{inertia!r}, {inertia!r}, {inertia!r}")
        lines["rigid"].append(f"*NSET, NSET=ENDS{i}\n{first}, {second}\n*RIGID BODY, REF NODE={centre}, TIE NSET=ENDS{i}")
        if i > 0:
            lines["hinge"].append(f"{3000 + i}, {10 * i + 2}, {first}")
        centres.append(centre)
    lines["node"].append(f"1, {points[0][0]!r}, {points[0][1]!r}, 0.")
    lines["hinge"].append("3000, 1, 11")
    return lines, centres


def deck_of_rods(lines, centres, steps):
    return "\n".join(["*NODE", *lines["node"], *lines["mass"], *lines["inertia"], *lines["rigid"], "*ELEMENT, TYPE=CONN3D2, ELSET=HINGES",
                      *lines["hinge"], "*ORIENTATION, NAME=ALONG_Z\n0., 0., 1., 1., 0., 0.", "*CONNECTOR SECTION, ELSET=HINGES\nHINGE\nALONG_Z",
                      "*NSET, NSET=CENTRES\n" + ", ".join(map(str, centres)), "*NSET, NSET=GROUND\n1" + (", 2" if lines.get("closed") else ""),
                      "*BOUNDARY\nGROUND, 1, 6", steps])


def chain_motion(lengths, density=1.0):
    """Accelerations of a hanging chain of uniform bars by their angles from the x axis."""
    masses = density * np.array(lengths)
    n = len(lengths)
    arm = np.array([[lengths[j] if j < k else lengths[k] / 2 if j == k else 0.0 for j in range(n)] for k in range(n)])
    coupling = np.einsum("k,ki,kj->ij", masses, arm, arm)
    pull = G * masses @ arm

    def derivative(x):
        t, w = x[:n], x[n:]
        apart = t[:, None] - t[None, :]
        matrix = coupling * np.cos(apart) + np.diag(masses * np.array(lengths)**2 / 12.0)
        right = -pull * np.cos(t) - (coupling * np.sin(apart)) @ (w * w)
        return np.concatenate([w, np.linalg.solve(matrix, right)])

    return derivative


def falling_chain(run):
    """Chains of five hinged bars, and of fourteen, whose system is sparse, that are held at one end and fall from level."""
    for lengths, ranks in (([0.5, 0.4, 0.6, 0.5, 0.3], 1), ([0.5, 0.4, 0.6, 0.5, 0.3], 3), ([0.2 + 0.01 * i for i in range(14)], 2)):
        bars = len(lengths)
        points = [(sum(lengths[:i]), 0.0) for i in range(bars + 1)]
        job = run(deck_of_rods(*rods(points), explicit_step(1e-4, 0.8, GRAVITY, history("CENTRES", "U1, U2, UR3", 0.01))), ranks)
        time = job.history("node_13", "U1")[0]
        turn = np.array([job.history(f"node_{10 * i + 13}", "UR3")[1] for i in range(bars)]).T
        expected = integrate(chain_motion(lengths), np.zeros(2 * bars), time)[:, :bars]
        check("angles of the bars", np.abs(turn - expected).max(), 0.0, 2e-5)
        x = np.array([job.history(f"node_{10 * i + 13}", "U1")[1] for i in range(bars)]).T + [(a[0] + b[0]) / 2 for a, b in zip(points[:-1], points[1:])]
        joint = np.zeros(len(time))
        for i, length in enumerate(lengths):  # the ends of the bars meet
            start = x[:, i] - length / 2 * np.cos(turn[:, i])
            check(f"gap of joint {i}", np.abs(start - joint).max(), 0.0, 1e-11)
            joint = x[:, i] + length / 2 * np.cos(turn[:, i])
        check_energy(job, 1e-4)


def four_bar(run):
    """A closed loop of three bars and the ground with four hinges, some of whose conditions say the same: it swings as it must, by its
    energy, and its bars stay together."""
    points = [(0.0, 0.0), (0.0, 0.4), (0.8, 0.7), (0.8, 0.0)]
    lines, centres = rods(points)
    lines["closed"] = True
    lines["node"].append("2, 0.8, 0., 0.")
    lines["hinge"].append("3009, 32, 2")
    speed = 4.0
    # A start that the loop allows: the crank turns, the others follow.
    a, b, c, d = (np.array(p) for p in points)
    cross = lambda w, r: w * np.array([-r[1], r[0]])
    matrix = np.array([cross(1.0, c - b), -cross(1.0, c - d)]).T
    coupler, rocker = np.linalg.solve(matrix, -cross(speed, b - a))
    initial = "*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY"
    for centre, w, pivot, base in zip(centres, (speed, coupler, rocker), (a, b, d), (np.zeros(2), cross(speed, b - a), np.zeros(2))):
        initial += f"\n{centre}, {w!r}, {base[0]!r}, {base[1]!r}, 0.\n{pivot[0]!r}, {pivot[1]!r}, 0., {pivot[0]!r}, {pivot[1]!r}, 1."
    for ranks, duration in ((1, 10.0), (2, 1.0)):
        job = run(deck_of_rods(lines, centres, initial + "\n" + explicit_step(1e-4, duration, "", history("CENTRES", "U1, U2, UR3", 0.01))), ranks)
        x = [np.array(job.history(f"node_{n}", "U1")[1]) + (p[0] + q[0]) / 2 for n, p, q in zip(centres, points[:-1], points[1:])]
        y = [np.array(job.history(f"node_{n}", "U2")[1]) + (p[1] + q[1]) / 2 for n, p, q in zip(centres, points[:-1], points[1:])]
        t = [math.atan2(q[1] - p[1], q[0] - p[0]) + job.history(f"node_{n}", "UR3")[1] for n, p, q in zip(centres, points[:-1], points[1:])]
        end = lambda i, side: np.array([x[i] + side * math.dist(points[i], points[i + 1]) / 2 * np.cos(t[i]),
                                        y[i] + side * math.dist(points[i], points[i + 1]) / 2 * np.sin(t[i])])
        check("crank on the ground", np.abs(end(0, -1)).max(), 0.0, 1e-9)
        check("crank and coupler", np.abs(end(0, 1) - end(1, -1)).max(), 0.0, 1e-9)
        check("coupler and rocker", np.abs(end(1, 1) - end(2, -1)).max(), 0.0, 1e-9)
        check("rocker on the ground", np.abs(end(2, 1).T - [0.8, 0.0]).max(), 0.0, 1e-9)
        check("the loop moves", float(np.ptp(t[0]) > 1.0), 1.0, 0.0)
        check_energy(job, 1e-4)
        check("conditions that follow from others are told", float(" from other constraints" in job.log()), 1.0, 0.0)


def universal_joint(run):
    """The speed ratio of Cardan's joint: cos b / (1 - sin^2 b cos^2 a), b the angle between the shafts, a that of the first."""
    bend, speed = math.radians(30.0), 10.0
    axis = (math.cos(bend), math.sin(bend), 0.0)
    deck = f"""*NODE
1, 0., 0., 0.
2, 0., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 2
*MASS, ELSET=M
1.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 1
4, 2
*ROTARY INERTIA, ELSET=I
0.01, 0.01, 0.01
*NSET, NSET=SECOND
2
*TRANSFORM, NSET=SECOND
{axis[0]!r}, {axis[1]!r}, 0., {-axis[1]!r}, {axis[0]!r}, 0.
*ELEMENT, TYPE=CONN3D2, ELSET=JOINT
5, 1, 2
*ORIENTATION, NAME=CROSS
0., 0., 1., {axis[0]!r}, {axis[1]!r}, 0.
*CONNECTOR SECTION, ELSET=JOINT
UJOINT
CROSS
*BOUNDARY
1, 1, 3
1, 5, 6
2, 5, 6
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
1, {speed}
0., 0., 0., 1., 0., 0.
""" + explicit_step(1e-4, 2.0, f"*BOUNDARY, TYPE=VELOCITY\n1, 4, 4, {speed}\n", history("SECOND", "UR", 0.01))
    for ranks in (1, 2):
        job = run(deck, ranks)
        time, turn = job.history("node_2", "UR")
        along = turn @ np.array(axis)
        # tan(second) = tan(first) * cos b, from the cross pin of the first shaft that is at right angles to both shafts
        first = speed * time
        expected = np.unwrap(np.arctan2(np.sin(first), np.cos(first) * math.cos(bend)))
        other = np.unwrap(np.arctan2(np.sin(first) * math.cos(bend), np.cos(first)))
        error = min(np.abs(along - expected).max(), np.abs(along - other).max())
        check("angle of the second shaft", error, 0.0, 1e-5)


def turned_fast(run):
    """A hinge counts its turns, however far it turns in an increment short of half a turn, and whoever looks."""
    for increment, ranks in ((0.003, 1), (0.02, 2)):
        job = run(f"""*NODE
1, 0., 0., 0.
2, 0., 0., 0.
*NSET, NSET=ROTOR
2
*ELEMENT, TYPE=MASS, ELSET=MASSES
1, 1
2, 2
*MASS, ELSET=MASSES
1.
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIAS
3, 1
4, 2
*ROTARY INERTIA, ELSET=INERTIAS
1., 1., 1.
*ELEMENT, TYPE=CONN3D2, ELSET=BEARING
5, 1, 2
*ORIENTATION, NAME=AXES
1., 0., 0., 0., 1., 0.
*CONNECTOR SECTION, ELSET=BEARING
HINGE,
AXES
*RIGID BODY, REF NODE=1
*RIGID BODY, REF NODE=2
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
ROTOR, 100.
0., 0., 0., 1., 0., 0.
*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
{increment}, 1.
*BOUNDARY
1, 1, 6
*OUTPUT, HISTORY, TIME INTERVAL=0.25
*ELEMENT OUTPUT, ELSET=BEARING
CU
*END STEP
""", ranks)
        check(f"angle after a second by {100.0 * increment:g} an increment", job.history("element_5", "CU")[1][-1][3], 100.0, 1e-9)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (masses_on_links, falling_chain, four_bar, universal_joint, turned_fast)})
