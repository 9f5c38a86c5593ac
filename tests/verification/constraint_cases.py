#!/usr/bin/env python3
"""Constraints, joints and couplings against closed forms and fine integrations: constraint_cases.py CASE BALOCCO FOLDER."""
import math
import re

import numpy as np

from explicit_cases import Job, check, check_energy, run_case

G = 9.81


def integrate(derivative, state, times):
    """Runge and Kutta's method in steps far shorter than the sampled times."""
    states, substeps = [np.array(state, float)], 20
    for before, after in zip(times[:-1], times[1:]):
        x, h = states[-1], (after - before) / substeps
        for _ in range(substeps):
            k1 = derivative(x)
            k2 = derivative(x + 0.5 * h * k1)
            k3 = derivative(x + 0.5 * h * k2)
            k4 = derivative(x + h * k3)
            x = x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        states.append(x)
    return np.array(states)


def history(nodes, variables, interval):
    return f"""*OUTPUT, HISTORY, TIME INTERVAL={interval}
*NODE OUTPUT, NSET={nodes}
{variables}
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
"""


def explicit_step(increment, duration, loads, output):
    return f"""*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
{increment}, {duration}
*BULK VISCOSITY
0., 0.
{loads}{output}*END STEP
"""


GRAVITY = f"*DLOAD\n, GRAV, {G}, 0., -1., 0.\n"


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
    for ranks in (1, 2):
        job = run(deck_of_rods(lines, centres, initial + "\n" + explicit_step(1e-4, 10.0, "", history("CENTRES", "U1, U2, UR3", 0.01))), ranks)
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




def block(nx, ny, nz, size, origin=(0.0, 0.0, 0.0), first_node=1, first_element=1):
    """Nodes and bricks of a block, with their ids: nodes by (i, j, k)."""
    number = lambda i, j, k: first_node + i + (nx + 1) * (j + (ny + 1) * k)
    nodes = [f"{number(i, j, k)}, {origin[0] + size[0] * i / nx!r}, {origin[1] + size[1] * j / ny!r}, {origin[2] + size[2] * k / nz!r}"
             for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    bricks, element = [], first_element
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                corners = [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                bricks.append(f"{element}, " + ", ".join(map(str, corners)))
                element += 1
    return nodes, bricks, number


STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.\n*DENSITY\n7800.\n"


def bar_with_end(end, dofs_of_load, loads, procedure="*STATIC\n1., 1.\n", nlgeom="", element="C3D8R", extra=""):
    nodes, bricks, number = block(8, 2, 2, (1.0, 0.1, 0.1))
    root = [number(0, j, k) for j in range(3) for k in range(3)]
    return "\n".join(["*NODE, NSET=ALL", *nodes, "1000, 1.2, 0.05, 0.05", f"*ELEMENT, TYPE={element}, ELSET=BAR", *bricks,
                      "*NSET, NSET=ROOT\n" + ", ".join(map(str, root)),
                      "*NSET, NSET=END\n1000", "*ELSET, ELSET=LAST, GENERATE\n8, 32, 8", "*SURFACE, NAME=TIP_FACES\nLAST, S4", STEEL + "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL", end,
                      "*BOUNDARY\nROOT, 1, 3", extra, f"*STEP{nlgeom}\n{procedure}{loads}", "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=END\nU, UR\n*END STEP\n"])


KINEMATIC = "*COUPLING, CONSTRAINT NAME=C, REF NODE=1000, SURFACE=TIP_FACES\n*KINEMATIC\n1, 6"
DISTRIBUTING = "*COUPLING, CONSTRAINT NAME=C, REF NODE=1000, SURFACE=TIP_FACES\n*DISTRIBUTING"


def coupled_tip(run):
    """A bar of 1 m held at one end: stretched, and bent by a moment on the reference node of its other end, 0.2 m before it. Without
    lateral contraction couplings change nothing: closed forms, on both kinds of coupling, linear and with large displacements."""
    area, inertia, modulus = 0.01, 0.1**4 / 12.0, 210e9
    for ranks, kind, nlgeom in ((1, KINEMATIC, ""), (2, KINEMATIC, ", NLGEOM"), (1, DISTRIBUTING, ""), (2, DISTRIBUTING, ", NLGEOM")):
        pulled = run(bar_with_end(kind, 1, "*CLOAD\n1000, 1, 1e5\n", nlgeom=nlgeom), ranks)
        check("stretch", pulled.history("node_1000", "U")[1][-1][0], 1e5 / (area * modulus), 1e-9 if not nlgeom else 1e-4)
        if nlgeom:
            continue
        bent = run(bar_with_end(kind, 6, "*CLOAD\n1000, 6, 1e3\n", element="C3D8R"), ranks)
        turn = bent.history("node_1000", "UR")[1][-1][2]
        deflection = bent.history("node_1000", "U")[1][-1][1]
        # One-point bricks, two across: the hourglass stiffness makes the bar stiffer than the beam.
        check("moment turns the end and lifts the node before it", deflection / turn, 0.5 + 0.2, 5e-3)
        check("turn of the end", turn, 1e3 / (modulus * inertia), 0.15)


def turned_coupling(run):
    """Large rotations: a coupled end turned by 90 degrees about the bar's axis carries its nodes along; the iterations converge
    quadratically."""
    job = run(bar_with_end(KINEMATIC, 4, "*BOUNDARY\n1000, 4, 4, 1.5707963267948966\n1000, 1, 3\n1000, 5, 6\n", procedure="*STATIC\n0.1, 1., 1e-6, 0.1\n", nlgeom=", NLGEOM"), 2)
    check("angle", job.history("node_1000", "UR")[1][-1][0], math.pi / 2, 1e-9)
    residuals = [float(r) for r in re.findall(r"residual \S+ \((\S+) of the forces\)", job.log())]
    check("the last residual", residuals[-1], 0.0, 1e-9)
    check("iterations in all", float(len(residuals) <= 70), 1.0, 0.0)


def equations(run):
    """A bar whose end section stays plane by equations; a lever by one equation with three terms; sets in equations."""
    nodes, bricks, number = block(4, 1, 1, (1.0, 0.1, 0.1))
    end = [number(4, j, k) for j in range(2) for k in range(2)]
    root = [number(0, j, k) for j in range(2) for k in range(2)]
    deck = "\n".join(["*NODE, NSET=ALL", *nodes, "900, 0., 0., 0.", "901, 0., 0., 0.", "*ELEMENT, TYPE=C3D8R, ELSET=BAR", *bricks,
                      "*NSET, NSET=FOLLOWERS\n" + ", ".join(map(str, end[1:])), "*NSET, NSET=ROOT\n" + ", ".join(map(str, root)), "*NSET, NSET=END\n900, 901",
                      STEEL + "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL",
                      f"*EQUATION\n2\nFOLLOWERS, 1, 1., {end[0]}, 1, -1.\n3\n{end[0]}, 1, 1.,\n900, 1, -2., 901, 1, -1.",
                      "*BOUNDARY\nROOT, 1, 3\n901, 2, 3\n900, 2, 3", "*STEP\n*STATIC\n*BOUNDARY\n901, 1, 1, 1e-5\n*CLOAD\n900, 1, 2e4",
                      "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=END\nU1, RF1\n*END STEP\n"])
    for ranks in (1, 2):
        job = run(deck, ranks)
        # The end moves by 2 u900 + u901 and takes half of the force on 900, as a lever; the bar's stiffness is 2.1e9 N/m.
        end_motion = 1e4 / (210e9 * 0.01)
        check("free end of the lever", job.history("node_900", "U1")[1][-1], (end_motion - 1e-5) / 2.0, 1e-8)
        check("held end of the lever", job.history("node_901", "RF1")[1][-1], 1e4, 1e-8)


def tied_blocks(run):
    """Two blocks tied along a face: meshes that match are as if they shared their nodes; others miss the uniform stress a little, less
    on a finer mesh."""

    def stretch(divisions, others, ranks):
        lower, bricks, number = block(divisions, divisions, 1, (1.0, 1.0, 1.0))
        upper, more, other = block(others, others, 1, (1.0, 1.0, 1.0), (0.0, 0.0, 1.0), 5001, 5001)
        low = [number(i, j, 0) for i in range(divisions + 1) for j in range(divisions + 1)]
        high = [other(i, j, 1) for i in range(others + 1) for j in range(others + 1)]
        deck = "\n".join(["*NODE, NSET=ALL", *lower, *upper, "*ELEMENT, TYPE=C3D8, ELSET=LOWER", *bricks, "*ELEMENT, TYPE=C3D8, ELSET=UPPER", *more,
                          "*ELSET, ELSET=BOTH\nLOWER, UPPER", "*NSET, NSET=LOW\n" + ",\n".join(map(str, low)), "*NSET, NSET=HIGH\n" + ",\n".join(map(str, high)),
                          "*SURFACE, NAME=TOP\nLOWER, S2", "*SURFACE, NAME=BOTTOM\nUPPER, S1", "*SURFACE, NAME=PULLED\nUPPER, S2",
                          "*TIE, NAME=GLUE\nBOTTOM, TOP", "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.3", "*SOLID SECTION, ELSET=BOTH, MATERIAL=STEEL",
                          f"*BOUNDARY\nLOW, 3\n{number(0, 0, 0)}, 1, 2\n{number(divisions, 0, 0)}, 2", "*STEP\n*STATIC\n*DSLOAD\nPULLED, P, -210e6",
                          "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=HIGH\nU3\n*END STEP\n"])
        job = run(deck, ranks)
        return np.array([job.history(f"node_{node}", "U3")[1][-1] for node in high])

    check("matching meshes", np.abs(stretch(3, 3, 1) / 2e-3 - 1.0).max(), 0.0, 1e-10)
    coarse, fine = np.abs(stretch(2, 3, 2) / 2e-3 - 1.0).max(), np.abs(stretch(6, 9, 2) / 2e-3 - 1.0).max()
    print(f"     meshes that do not match: {coarse:.3e}, three times finer {fine:.3e}")
    check("meshes that do not match", coarse, 0.0, 0.1)
    check("they come nearer on finer meshes", float(fine < 0.5 * coarse), 1.0, 0.0)


def welded_sheets(run):
    """Two overlapping strips of shells joined by spot welds: at nodes they do exactly what rigid links between the nodes do, and
    wherever else they are on the meshes nearly the same."""
    fasteners = "*FASTENER PROPERTY, NAME=SPOT\n0.003\n*FASTENER, INTERACTION NAME=W, PROPERTY=SPOT, REFERENCE NODE SET=WELDS\n\nA, B"

    def lap(shift, join, ranks, output=""):
        nodes, shells = [], []
        for sheet in range(2):
            for i in range(13):
                for j in range(5):
                    nodes.append(f"{1000 * sheet + 10 * i + j + 1}, {0.1 * i + (0.8 + shift) * sheet!r}, {0.1 * j!r}, {0.004 * sheet!r}")
            for i in range(12):
                for j in range(4):
                    corners = [1000 * sheet + 10 * a + b + 1 for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
                    shells.append((sheet, f"{1000 * sheet + 10 * i + j + 1}, " + ", ".join(map(str, corners))))
        welds = [f"{5001 + 3 * a + b}, {0.9 + 0.1 * a!r}, {0.1 + 0.1 * b!r}, 0.002" for a in range(3) for b in range(3)]
        left = ", ".join(str(j + 1) for j in range(5))
        right = ", ".join(str(1120 + j + 1) for j in range(5))
        return run("\n".join(["*NODE", *nodes, *welds, "*ELEMENT, TYPE=S4R, ELSET=FIRST", *[e for s, e in shells if s == 0],
                              "*ELEMENT, TYPE=S4R, ELSET=SECOND", *[e for s, e in shells if s == 1], "*ELSET, ELSET=BOTH\nFIRST, SECOND",
                              "*NSET, NSET=LEFT\n" + left, "*NSET, NSET=RIGHT\n" + right,
                              "*NSET, NSET=WELDS, GENERATE\n5001, 5009, 1", "*SURFACE, NAME=A\nFIRST, SPOS", "*SURFACE, NAME=B\nSECOND, SPOS",
                              join,
                              "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7800.", "*SHELL SECTION, ELSET=BOTH, MATERIAL=STEEL\n0.004",
                              "*BOUNDARY\nLEFT, 1, 6\nRIGHT, 2, 6", "*STEP\n*STATIC\n*BOUNDARY\nRIGHT, 1, 1, 1e-4",
                              "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=LEFT\nRF" + output + "\n*END STEP\n"]), ranks)

    def forces(job):
        return -sum(job.history(f"node_{j + 1}", "RF")[1][-1] for j in range(5))

    def force(job):
        return forces(job)[0]

    links = "*MPC\n" + "\n".join(f"BEAM, {1000 + 10 * (i - 8) + j + 1}, {10 * i + j + 1}" for i in (9, 10, 11) for j in (1, 2, 3))
    linked = force(lap(0.0, links, 1))
    at_nodes = force(lap(0.0, fasteners, 1))
    check("welds at nodes against rigid links", at_nodes / linked, 1.0, 1e-9)
    between = force(lap(0.037, fasteners, 2))
    check("welds between the nodes against those at nodes", between / at_nodes, 1.0, 0.02)
    # Welds as connectors between the sheets tell their forces, which sum to what pulls the sheets.
    connectors = "\n".join(["*NODE", *[f"{6001 + 3 * a + b}, {0.9 + 0.1 * a!r}, {0.1 + 0.1 * b!r}, 0.004" for a in range(3) for b in range(3)],
                            "*ELEMENT, TYPE=CONN3D2, ELSET=SPOTS", *[f"{7001 + k}, {5001 + k}, {6001 + k}" for k in range(9)],
                            "*CONNECTOR SECTION, ELSET=SPOTS\nBEAM\nGLOBAL", "*ORIENTATION, NAME=GLOBAL\n1., 0., 0., 0., 1., 0.",
                            fasteners.replace("REFERENCE NODE SET=WELDS", "ELSET=SPOTS")])
    job = lap(0.037, connectors, 2, "\n*ELEMENT OUTPUT, ELSET=SPOTS\nCTF")
    check("welds as connectors", force(job) / between, 1.0, 1e-9)
    sum_of_welds = sum(job.history(f"element_{7001 + k}", "CTF")[1][-1] for k in range(9))
    check("forces of all welds against those on the sheets", np.abs(sum_of_welds[:3] - forces(job)).max() / force(job), 0.0, 1e-9)


def hanging_at_rest(run):
    """What hangs at rest makes no energy but that of rounding, of which no error is told and no run fails."""
    for number, along in enumerate(((0.3, -0.8, 0.5), (-0.1, -0.7, -0.9), (0.6, 0.2, -1.3))):
        along = np.array(along) / np.linalg.norm(along)
        below = ", ".join(repr(float(x)) for x in np.array((0.3, 1.7, -0.4)) + 1.3 * along)
        for joint in ("LINK", "BEAM"):
            job = run(f"""*NODE
1, 0.3, 1.7, -0.4
2, {below}
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
2, 2
*MASS, ELSET=M
2.
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 1
4, 2
*ROTARY INERTIA, ELSET=I
0.1, 0.1, 0.1
*MPC
{joint}, 2, 1
*BOUNDARY
1, 1, 3
""" + explicit_step(1e-4, 0.11, "*DLOAD\n, GRAV, 9.81, " + ", ".join(repr(float(x)) for x in along) + "\n", ""), 1 + number % 2)
            lines = [line.split() for line in (job.folder / f"{job.name}.sta").read_text().splitlines()]
            errors = [float(line[11]) for line in lines if line and line[0].isdigit()]
            check(f"{joint}: lines of status", float(len(errors) > 5), 1.0, 0.0)
            check(f"{joint}: errors of the balance", max(abs(error) for error in errors), 0.0, 0.0)


def rest_with_constraints(run):
    """A loaded equilibrium with couplings, an equation and a bushing goes on explicitly at rest."""
    for ranks, kind in ((1, KINEMATIC), (2, DISTRIBUTING)):
        extra = "\n".join(["*NODE\n1001, 1.3, 0.05, 0.05\n1002, 1.3, 0.05, 0.05", "*ELEMENT, TYPE=CONN3D2, ELSET=BUSH\n9001, 1000, 1002",
                           "*ELEMENT, TYPE=MASS, ELSET=END_MASS\n9002, 1002\n*MASS, ELSET=END_MASS\n5.",
                           "*ELEMENT, TYPE=ROTARYI, ELSET=END_INERTIA\n9003, 1002\n*ROTARY INERTIA, ELSET=END_INERTIA\n0.1, 0.1, 0.1",
                           "*CONNECTOR BEHAVIOR, NAME=RUBBER", *[f"*CONNECTOR ELASTICITY, COMPONENT={c}\n{1e6 if c < 4 else 1e4}" for c in range(1, 7)],
                           "*CONNECTOR SECTION, ELSET=BUSH, BEHAVIOR=RUBBER\nBUSHING", "*EQUATION\n2\n1001, 1, 1., 1002, 1, -1.",
                           "*BOUNDARY\n1001, 2, 3"])
        deck = bar_with_end(kind, 1, "*CLOAD\n1002, 1, 1e4\n1002, 2, 3e3\n1002, 6, 200.\n", nlgeom=", NLGEOM", extra=extra)
        deck += """*STEP
*DYNAMIC, EXPLICIT
, 5e-4
*OUTPUT, HISTORY, FREQUENCY=10
*NODE OUTPUT, NSET=END
U, UR
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*END STEP
"""
        job = run(deck, ranks)
        found = re.search(r"\|f_int \+ f_contact - f_ext\| / \|f_ext\| = (\S+)", job.log())
        check("imbalance at import", float(found.group(1)), 0.0, 1e-8)
        u = job.history("node_1000", "U", 2)[1]
        check("drift of the coupled node", np.abs(u - u[0]).max() / np.abs(u[0]).max(), 0.0, 1e-6)


def same_bits(run):
    """Two tied blocks, the upper one coupled to a node on which a body hangs by a hinge that rubs and has stops, thrown about: the same
    bits on any number of ranks, and when the job is stopped on the way and goes on on another number."""
    lower, bricks, number = block(4, 4, 2, (1.0, 1.0, 0.5))
    upper, more, other = block(3, 3, 2, (1.0, 1.0, 0.5), (0.0, 0.0, 0.5), 501, 501)
    high = [other(i, j, 2) for i in range(4) for j in range(4)]
    deck = "\n".join(["*NODE, NSET=ALL", *lower, *upper, "900, 0.5, 0.5, 1.3", "901, 0.5, 0.5, 1.3", "902, 0.7, 0.6, 1.8",
                      "*ELEMENT, TYPE=C3D8R, ELSET=LOWER", *bricks, "*ELEMENT, TYPE=C3D8R, ELSET=UPPER", *more, "*ELSET, ELSET=BOTH\nLOWER, UPPER",
                      "*NSET, NSET=HIGH\n" + ", ".join(map(str, high)), "*NSET, NSET=BOB\n902", "*NSET, NSET=LINK\n901",
                      "*SURFACE, NAME=TOP\nLOWER, S2", "*SURFACE, NAME=BOTTOM\nUPPER, S1", "*TIE, NAME=GLUE\nBOTTOM, TOP",
                      "*SURFACE, TYPE=NODE, NAME=HIGH_NODES\nHIGH", "*COUPLING, CONSTRAINT NAME=C, REF NODE=900, SURFACE=HIGH_NODES\n*DISTRIBUTING",
                      "*ELEMENT, TYPE=MASS, ELSET=M\n2001, 902\n*MASS, ELSET=M\n50.",
                      "*ELEMENT, TYPE=ROTARYI, ELSET=I\n2002, 902\n*ROTARY INERTIA, ELSET=I\n2., 3., 4.", "*RIGID BODY, REF NODE=902, TIE NSET=LINK",
                      "*ELEMENT, TYPE=CONN3D2, ELSET=HINGE\n2003, 900, 901", "*ORIENTATION, NAME=ACROSS\n0., 1., 0., 0., 0., 1.",
                      "*CONNECTOR BEHAVIOR, NAME=TORSION\n*CONNECTOR ELASTICITY, COMPONENT=4\n1e4\n*CONNECTOR DAMPING, COMPONENT=4\n10.",
                      "*CONNECTOR STOP, COMPONENT=4\n-0.02, 0.02\n*CONNECTOR FRICTION, COMPONENT=4\n5.,\n*FRICTION\n0.2",
                      "*CONNECTOR SECTION, ELSET=HINGE, BEHAVIOR=TORSION\nHINGE\nACROSS",
                      "*MATERIAL, NAME=SOFT\n*HYPERELASTIC, NEO HOOKE\n1e5, 1e-6\n*DENSITY\n1000.", "*SOLID SECTION, ELSET=BOTH, MATERIAL=SOFT",
                      "*INITIAL CONDITIONS, TYPE=VELOCITY\nBOB, 1, 2.\nHIGH, 3, 1.", "*STEP\n*DYNAMIC, EXPLICIT\n, 5.",
                      "*OUTPUT, HISTORY, TIME INTERVAL=0.1\n*NODE OUTPUT, NSET=ALL\nU\n*NODE OUTPUT, NSET=BOB\nU, UR",
                      "*ELEMENT OUTPUT, ELSET=HINGE\nCP, CRF, CSF\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ALLVD, ALLFD, ETOTAL\n*END STEP\n"])
    jobs = [run(deck, ranks) for ranks in (1, 2, 3)]
    check_energy(jobs[0], 1e-2)
    stopped = Job("stopped", jobs[0].balocco, "2", jobs[0].folder)
    (stopped.folder / "stopped.ctl").write_text("stop\n")  # looked for after 0.2 s
    stopped.run(deck, expected_status=4)
    (stopped.folder / "stopped.ctl").unlink(missing_ok=True)
    stopped.ranks = "3"
    stopped.run(deck, arguments=("--restart",))
    for job in (*jobs[1:], stopped):
        for node in (number(2, 2, 2), other(1, 1, 0), other(0, 0, 2), 902):
            same = np.array_equal(jobs[0].history(f"node_{node}", "U")[1], job.history(f"node_{node}", "U")[1])
            check(f"bits of node {node} in {job.name}", float(same), 1.0, 0.0)
        stop = np.array_equal(jobs[0].history("element_2003", "CRF")[1], job.history("element_2003", "CRF")[1])
        check(f"bits of the stop in {job.name}", float(stop), 1.0, 0.0)
    angle, stop, friction = (jobs[0].history("element_2003", variable)[1][:, 3] for variable in ("CP", "CRF", "CSF"))
    at_stop = np.abs(angle + 0.02) < 1e-9
    check("times at the stop", float(at_stop.sum()), 2.0, 0.0)
    check("forces of the stop away from it", np.abs(stop[~at_stop]).max(), 0.0, 0.0)
    check("the stop has struck back", float(stop[at_stop].min() < -100.0), 1.0, 0.0)
    check("friction slips", np.abs(np.abs(friction[~at_stop]) - 1.0).max(), 0.0, 1e-12)


def springs_on_an_arm(run):
    """CARTESIAN springs of two stiffnesses between nodes in one place, with no stiffness of rotation: the force on the mass has an arm
    about the held node as soon as it swings, and that node bears the moment. Two oscillators that know nothing of each other."""
    stiffness, speed, mass = (1e6, 4e6), (10.0, 10.0), 1.0
    omega = [math.sqrt(k / mass) for k in stiffness]
    for ranks in (1, 2):
        job = run(f"""*NODE
1, 0., 0., 0.
2, 0., 0., 0.
3, 1., 0., 0.
*NSET, NSET=HELD
1, 3
*NSET, NSET=SWINGS
2
*ELEMENT, TYPE=CONN3D2, ELSET=SPRINGS
1, 1, 2
*ELEMENT, TYPE=MASS, ELSET=MASSES
2, 2
3, 3
*MASS, ELSET=MASSES
{mass}
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIAS
4, 2
*ROTARY INERTIA, ELSET=INERTIAS
0.01, 0.01, 0.01
*CONNECTOR BEHAVIOR, NAME=LAW
*CONNECTOR ELASTICITY, COMPONENT=1
{stiffness[0]}
*CONNECTOR ELASTICITY, COMPONENT=2
{stiffness[1]}
*CONNECTOR ELASTICITY, COMPONENT=3
{stiffness[1]}
*CONNECTOR SECTION, ELSET=SPRINGS, BEHAVIOR=LAW
CARTESIAN
*INITIAL CONDITIONS, TYPE=VELOCITY
SWINGS, 1, {speed[0]}
SWINGS, 2, {speed[1]}
*BOUNDARY
HELD, 1, 6
""" + explicit_step(1e-6, 5e-3, "", history("SWINGS", "U1, U2", 1e-5) + "*NODE OUTPUT, NSET=HELD\nRM3\n"), ranks)
        time, x = job.history("node_2", "U1")
        y = job.history("node_2", "U2")[1]
        for place, v, w in ((x, speed[0], omega[0]), (y, speed[1], omega[1])):
            check("swing", np.abs(place - v / w * np.sin(w * time)).max(), 0.0, 1e-5 * v / w)
        moment = job.history("node_1", "RM3")[1]
        expected = (stiffness[0] - stiffness[1]) * x * y
        check("moment on the held node", np.abs(np.abs(moment) - np.abs(expected)).max(), 0.0, 1e-6 * np.abs(expected).max())


if __name__ == "__main__":
    run_case({case.__name__: case for case in (masses_on_links, falling_chain, four_bar, universal_joint, coupled_tip, turned_coupling, equations,
                                               tied_blocks, welded_sheets, rest_with_constraints, hanging_at_rest, same_bits, springs_on_an_arm)})
