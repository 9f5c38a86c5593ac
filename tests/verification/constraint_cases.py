#!/usr/bin/env python3
"""Constraints and couplings against closed forms: constraint_cases.py CASE BALOCCO FOLDER."""
import math
import re

import numpy as np

from job import Job, check, check_energy, run_case
from motion_decks import explicit_step, history


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
    run_case({case.__name__: case for case in (coupled_tip, turned_coupling, equations, tied_blocks, welded_sheets, rest_with_constraints,
                                               hanging_at_rest, same_bits, springs_on_an_arm)})
