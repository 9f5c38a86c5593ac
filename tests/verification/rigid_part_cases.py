#!/usr/bin/env python3
"""Parts that are rigid: what they carry, what joins them, what costs nothing: rigid_part_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import Job, check, check_energy, run_case
from motion_decks import G, explicit_step, history


def carousel(run):
    """A free wheel that turns, with 24 bars on ball joints at its rim, which fly out: one large sparse linkage around one body. The
    centre of mass keeps its path, joints hold, energy stays; the same bits on two ranks."""
    bars, radius, length, speed = 24, 1.0, 0.4, 3.0
    rim = [(radius * math.cos(2 * math.pi * i / bars), radius * math.sin(2 * math.pi * i / bars)) for i in range(bars)]
    nodes, deck = ["1, 0., 0., 0."], []
    for i, (x, y) in enumerate(rim):
        nodes += [f"{100 + i}, {x!r}, {y!r}, 0.", f"{200 + i}, {x!r}, {y!r}, 0.", f"{300 + i}, {x!r}, {y!r}, {-length / 2!r}"]
        deck.append(f"*NSET, NSET=END{i}\n{200 + i}\n*RIGID BODY, REF NODE={300 + i}, TIE NSET=END{i}")
    numbers = lambda first: ", ".join(map(str, range(first, first + 12))) + ",\n" + ", ".join(map(str, range(first + 12, first + bars)))
    centres = "*NSET, NSET=CENTRES\n1, " + numbers(300) + "\n*NSET, NSET=RIM\n" + numbers(100) + "\n*NSET, NSET=ENDS\n" + numbers(200)
    spin = f"*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\nWHEEL, {speed}, 0., 0., 0.2\n0., 0., 0., 0., 0., 1."
    text = "\n".join(["*NODE", *nodes, centres, *deck, "*NSET, NSET=WHEEL\n1, RIM", "*RIGID BODY, REF NODE=1, TIE NSET=RIM",
                      "*ELEMENT, TYPE=MASS, ELSET=BARS", *[f"{1000 + i}, {300 + i}" for i in range(bars)], "*MASS, ELSET=BARS\n0.5",
                      "*ELEMENT, TYPE=ROTARYI, ELSET=TURNS", *[f"{2000 + i}, {300 + i}" for i in range(bars)],
                      "*ROTARY INERTIA, ELSET=TURNS\n0.02, 0.02, 0.001", "*ELEMENT, TYPE=MASS, ELSET=HUB\n3000, 1\n*MASS, ELSET=HUB\n8.",
                      "*ELEMENT, TYPE=ROTARYI, ELSET=WHEELI\n3001, 1\n*ROTARY INERTIA, ELSET=WHEELI\n2., 2., 4.",
                      "*ELEMENT, TYPE=CONN3D2, ELSET=JOINTS", *[f"{4000 + i}, {100 + i}, {200 + i}" for i in range(bars)],
                      "*CONNECTOR SECTION, ELSET=JOINTS\nJOIN", spin, explicit_step(2e-4, 0.5, "", history("CENTRES", "U", 0.05).replace(
                          "*ENERGY", "*NODE OUTPUT, NSET=RIM\nU\n*NODE OUTPUT, NSET=ENDS\nU\n*ENERGY"))])
    jobs = [run(text, ranks) for ranks in (1, 2)]
    check_energy(jobs[0], 1e-3)
    path = {node: jobs[0].history(f"node_{node}", "U") for node in (1, *range(100, 100 + bars), *range(200, 200 + bars), *range(300, 300 + bars))}
    time = path[1][0]
    centre = (8.0 * path[1][1] + 0.5 * sum(path[300 + i][1] for i in range(bars))) / (8.0 + 0.5 * bars)
    check("path of the centre of mass", np.abs(centre - np.outer(time, centre[-1] / time[-1])).max(), 0.0, 1e-9)
    check("joints hold", max(np.abs(path[100 + i][1] - path[200 + i][1]).max() for i in range(bars)), 0.0, 1e-9)
    check("bars fly out", float(np.linalg.norm(path[300][1][-1] - path[200][1][-1]) > 0.05), 1.0, 0.0)
    same = all(np.array_equal(path[node][1], jobs[1].history(f"node_{node}", "U")[1]) for node in path)
    check("bits on two ranks", float(same), 1.0, 0.0)


def thrown_plate(run):
    """A rigid plate of shells, most of whose nodes nothing touches, in free flight: a parabola and a spin, exactly, at its corner too;
    gravity on one half of it turns it as its moment says. The same bits on more ranks and after a restart."""
    nx, ny, length, width, mass = 6, 4, 1.2, 0.8, 1.2 * 0.8 * 0.01 * 1000.0
    number = lambda i, j: 1 + i + (nx + 1) * j
    nodes = [f"{number(i, j)}, {length * (i / nx - 0.5)!r}, {width * (j / ny - 0.5)!r}, 0." for j in range(ny + 1) for i in range(nx + 1)]
    shells = [f"{1 + i + nx * j}, {number(i, j)}, {number(i + 1, j)}, {number(i + 1, j + 1)}, {number(i, j + 1)}" for j in range(ny) for i in range(nx)]
    half = ", ".join(str(1 + i + nx * j) for j in range(ny) for i in range(nx) if i >= nx // 2)
    head = "\n".join(["*NODE, NSET=ALL", *nodes, "900, 0., 0., 0.", "*ELEMENT, TYPE=S4R, ELSET=PLATE", *shells, "*ELSET, ELSET=HALF\n" + half,
                      "*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL\n0.01", "*MATERIAL, NAME=STEEL\n*ELASTIC\n2e9, 0.3\n*DENSITY\n1000.",
                      "*NSET, NSET=WATCHED\n1, 900", "*RIGID BODY, REF NODE=900, ELSET=PLATE"])
    spin = "*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\nALL, 4., 1., 0., 3.\n0., 0., 0., 0., 0., 1.\n900, 4., 1., 0., 3.\n0., 0., 0., 0., 0., 1.\n"
    step = explicit_step(1e-4, 0.25, f"*DLOAD\nPLATE, GRAV, {G}, 0., 0., -1.\n", history("WATCHED", "U, UR, V", 0.05))
    deck = f"{head}\n{spin}{step.replace('*STEP', '*STEP, NAME=FIRST')}{step}"
    jobs = [run(deck, ranks) for ranks in (1, 2, 3)]
    stopped = Job("stopped", jobs[0].balocco, "3", jobs[0].folder)
    stopped.run(deck, arguments=("--until", "FIRST"))
    stopped.ranks = "1"
    stopped.run(deck, arguments=("--restart",))
    check_energy(jobs[0], 1e-7, (1, 2))
    for step in (1, 2):
        time = jobs[0].history("node_900", "U", step)[0]
        path = np.stack((time, 0 * time, 3.0 * time - 0.5 * G * time**2), 1)
        arm = np.array([-0.5 * length, -0.5 * width])
        turned = np.stack((np.cos(4 * time) * arm[0] - np.sin(4 * time) * arm[1], np.sin(4 * time) * arm[0] + np.cos(4 * time) * arm[1]), 1) - arm
        check("path of the centre", np.abs(jobs[0].history("node_900", "U", step)[1] - path).max(), 0.0, 1e-3)
        corner = jobs[0].history("node_1", "U", step)[1] - jobs[0].history("node_900", "U", step)[1]
        check("corner on its circle", np.abs(corner[:, :2] - turned).max(), 0.0, 1e-9)
        check("rotation of the corner", np.abs(jobs[0].history("node_1", "UR", step)[1][:, 2] - 4.0 * time).max(), 0.0, 1e-9)
        for job in (*jobs[1:], stopped):
            for node, variable in ((1, "U"), (1, "V"), (1, "UR"), (900, "U")):
                same = np.array_equal(jobs[0].history(f"node_{node}", variable, step)[1], job.history(f"node_{node}", variable, step)[1])
                check(f"bits of {variable} of node {node} in {job.name} on {job.ranks}", float(same), 1.0, 0.0)
    job = run(f"{head}\n" + explicit_step(1e-4, 0.02, f"*DLOAD\nHALF, GRAV, {G}, 0., 0., -1.\n", history("WATCHED", "U, UR", 0.01)), 2)
    time, turn = job.history("node_900", "UR")
    inertia = mass * length**2 / 12.0 * (1.0 + 0.5 / nx**2 * 4.0)  # of masses at the nodes, which have some of their own
    check("turn by half a weight", turn[-1][1], 0.5 * 0.5 * mass * G * 0.25 * length / inertia * time[-1] ** 2, 5e-2)
    check("fall by half a weight", job.history("node_900", "U")[1][-1][2], -0.25 * G * time[-1] ** 2, 1e-2)


def carried_inertia(run):
    """A tumbling body with a mass and a rotary inertia at the end of a rigid arm, which it carries: as if they were its own, and as a
    weld with its multipliers has it."""
    own, far = (0.02, 0.03, 0.04, 0.0, 0.0, 0.0), (0.005, 0.003, 0.006, 0.001, 0.0, -0.0005)
    tensor = lambda components: ", ".join(f"{value!r}" for value in components)

    def deck(joint, reference, end):
        head = f"""*NODE
1, 0., 0., 0.
2, 0.5, 0.2, 0.
3, 0.1, 0., 0.
*NSET, NSET=ARM
3
*NSET, NSET=SEEN
1, 2
*ELEMENT, TYPE=MASS, ELSET=M1
1, 1
*MASS, ELSET=M1
2.
*ELEMENT, TYPE=MASS, ELSET=M2
2, 2
*MASS, ELSET=M2
1.
*ELEMENT, TYPE=ROTARYI, ELSET=I1
3, 1
*ROTARY INERTIA, ELSET=I1
{tensor(reference)}
"""
        if end:
            head += f"*ELEMENT, TYPE=ROTARYI, ELSET=I2\n4, 2\n*ROTARY INERTIA, ELSET=I2\n{tensor(end)}\n"
        spin = "*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\nSEEN, 6.\n0., 0., 0., 1., 2., 3.\n"
        return head + joint + spin + explicit_step(1e-4, 1.0, "", history("SEEN", "U, UR", 0.02))

    body = "*RIGID BODY, REF NODE=1, TIE NSET=ARM\n"
    arm = deck(body + "*MPC\nBEAM, 2, 3\n", own, far)
    whole = deck(body.replace("ARM", "ARM2"), [a + b for a, b in zip(own, far)], None).replace("*NSET, NSET=SEEN", "*NSET, NSET=ARM2\n2, 3\n*NSET, NSET=SEEN")
    welded = deck(body + "*ELEMENT, TYPE=CONN3D2, ELSET=WELD\n9, 3, 2\n*CONNECTOR SECTION, ELSET=WELD\nBEAM\n", own, far)
    reference = run(whole, 1)
    check_energy(reference, 1e-6)
    for text, ranks, tolerance in ((arm, 1, 1e-12), (arm, 2, 1e-12), (welded, 1, 1e-6)):
        job = run(text, ranks)
        for node, variable in ((1, "U"), (1, "UR"), (2, "U")):
            difference = np.abs(job.history(f"node_{node}", variable)[1] - reference.history(f"node_{node}", variable)[1]).max()
            check(f"{variable} of node {node} in {job.name}", difference, 0.0, tolerance)
        check("kinetic energy", job.history("energy", "ALLKE")[1][-1], reference.history("energy", "ALLKE")[1][-1], max(tolerance, 1e-9))


PLATES = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 0.1
6, 1., 0., 0.1
7, 1., 1., 0.1
8, 0., 1., 0.1
9, 5., 0., 0.
11, 2., 0., 0.
*ELEMENT, TYPE=S4R, ELSET=PLATES
1, 1, 2, 3, 4
2, 5, 6, 7, 8
*SHELL SECTION, ELSET=PLATES, MATERIAL=SHEET
0.1
*MATERIAL, NAME=SHEET
*DENSITY
1.
*ELASTIC
1000., 0.3
*MPC
BEAM, 5, 1
BEAM, 7, 3
*RIGID BODY, REF NODE=9, ELSET=PLATES, POSITION=CENTER OF MASS
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
3, 2, 11
*SPRING, ELSET=SPRING

1.
*BOUNDARY
11, 1, 3
*NSET, NSET=SEEN
2, 9
"""


def plates_made_rigid(run):
    """Welded plates that one line makes rigid. Displacements count from the centre of mass: held there nothing moves, and the plates
    turn about it; let go in an explicit step they oscillate on a spring."""
    output = "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=SEEN\nU\n*END STEP\n"
    angle = 0.1
    turned = ((0.5 * math.cos(angle) + 0.5 * math.sin(angle), 0.5 * math.sin(angle) - 0.5 * math.cos(angle), 0.0) - np.array((0.5, -0.5, 0.0)))
    for ranks in (1, 2):
        held = run(PLATES + f"*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n9, 1, 6\n{output}", ranks)
        check("a held body stays", np.abs(held.history("node_2", "U")[1]).max(), 0.0, 1e-14)
        job = run(PLATES + f"*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n9, 1, 5\n9, 6, 6, {angle}\n{output}", ranks)
        check("it turns about its centre of mass", np.abs(job.history("node_2", "U")[1][-1] - turned).max(), 0.0, 1e-12)
        check("which stays", np.abs(job.history("node_9", "U")[1]).max(), 0.0, 1e-14)
    motion = "*BOUNDARY\n9, 2, 6\n*INITIAL CONDITIONS, TYPE=VELOCITY\nSEEN, 1, 0.01\n"
    job = run(PLATES + motion + explicit_step(1e-3, 2.0, "", output.removesuffix("*END STEP\n")), 2)
    time, moved = job.history("node_9", "U")
    frequency = math.sqrt(1.0 / (2 * 0.1))  # spring of 1, plates of 0.1 each
    check("the welded plates swing", np.abs(moved[:, 0] - 0.01 / frequency * np.sin(frequency * time)).max(), 0.0, 2e-8)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (carousel, thrown_plate, carried_inertia, plates_made_rigid)})
