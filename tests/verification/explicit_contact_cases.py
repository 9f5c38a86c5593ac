#!/usr/bin/env python3
"""Explicit dynamics as users meet it: bouncing, pressing, lifting off, sliding off; runs the real binary and checks what it wrote.

usage: explicit_contact_cases.py CASE BALOCCO RANKS FOLDER      exit status 0: everything within tolerance
"""
import sys

import numpy as np

from job import Job, check, check_energy, failures


def block(nx, ny, nz, size, element="C3D8R", height=0.0, law="*ELASTIC\n10., 0.3", density=1e-9, friction=0.0):
    """Bricks of `size` (mm, t, s), the lowest layer's faces SOLE on the profile GROUND; node sets LOW, TOP, ALL."""
    lines = ["*HEADING", "block", "*NODE, NSET=ALL"]
    number = lambda i, j, k: 1 + i + (nx + 1) * (j + (ny + 1) * k)
    nodes = [(i, j, k) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    lines += [f"{number(*n)}, {n[0] * size[0]}, {height + n[1] * size[1]}, {n[2] * size[2]}" for n in nodes]
    lines += ["*NODE, NSET=NREF", "9000, 0., 0., 0.", f"*ELEMENT, TYPE={element}, ELSET=BLOCK"]
    count, sole = 0, []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                count += 1
                lower, upper = [[number(i + a, j + b, k + c) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))] for c in (0, 1)]
                lines.append(", ".join(str(n) for n in [count] + lower + upper))
                if j == 0:
                    sole.append(count)
    sets = {"LOW": [number(i, 0, k) for k in range(nz + 1) for i in range(nx + 1)],
            "TOP": [number(i, ny, k) for k in range(nz + 1) for i in range(nx + 1)]}
    for name, members in sets.items():
        lines += [f"*NSET, NSET={name}"] + [", ".join(map(str, members[i:i + 8])) for i in range(0, len(members), 8)]
    lines += ["*ELSET, ELSET=SOLE"] + [str(e) for e in sole]
    lines += ["*SOLID SECTION, ELSET=BLOCK, MATERIAL=M", "*MATERIAL, NAME=M", law, "*DENSITY", str(density),
              "*SURFACE, NAME=SLAVE", "SOLE, S3", "*SURFACE, NAME=GROUND, TYPE=SEGMENTS", "START, -100., 0.", "LINE, 100., 0.",
              "*RIGID BODY, REF NODE=9000, ANALYTICAL SURFACE=GROUND", "*SURFACE INTERACTION, NAME=I", f"*FRICTION\n{friction}",
              "*CONTACT PAIR, INTERACTION=I", "SLAVE, GROUND", "*BOUNDARY", "9000, 1, 6"]
    return "\n".join(lines) + "\n"


ENERGIES = "*OUTPUT, HISTORY, TIME INTERVAL={}\n*NODE OUTPUT, NSET=NREF\nRF2\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLCW, ALLVD, ALLWK, ETOTAL\n*END STEP\n"


def bouncing_plate(job):
    """A flat plate bounces with half the automatic increment (near the whole one the ringing through its single layer of elements is
    not resolved); no viscosity: changes of the increment do not pump the energy of its ringing."""
    deck = block(6, 1, 6, (10.0, 2.0, 10.0), "C3D8", height=1.0, law="*ELASTIC\n70000., 0.3", density=2.7e-9)
    job.run(deck + "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 2, -5000.\n*STEP\n*DYNAMIC, EXPLICIT, SCALE FACTOR=0.5\n, 0.002\n*BULK VISCOSITY\n0., 0.\n"
            + ENERGIES.format(2e-5))
    check_energy(job, 1e-2)
    velocity = job.history("energy", "ALLKE")[1]
    check("it does not lose its energy in the impact", velocity[-20:].mean() / velocity[0], 1.0, 0.25)


def hard_hits(job):
    """Blocks and plates hit the ground at a hundredth of their speed of sound and bounce, all by default: strain and bulk viscosity lower
    the limit of the increment just when forces are greatest, and to follow it at once would create energy."""
    speed = "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 2, -5000.\nALL, 1, -1250.\n*STEP\n*DYNAMIC, EXPLICIT\n, 0.0006\n"
    laws = ("*ELASTIC\n200., 0.3", "*HYPERELASTIC, NEO HOOKE\n38.46, 0.012", "*ELASTIC\n200., 0.3\n*PLASTIC\n4., 0.\n8., 1.")
    for shape in ((3, 3, 3, (10.0, 0.5, 10.0)), (4, 4, 4, (5.0, 5.0, 5.0)), (2, 8, 3, (4.0, 2.0, 3.0))):
        for element in ("C3D8", "C3D8R"):
            for law in laws:
                job.run(block(*shape, element, height=0.2, law=law, friction=0.3) + speed + ENERGIES.format(6e-6))
                check_energy(job, 1e-2)


def touching_at_the_start(job):
    """A steel block falls on the ground from a gap of nothing, of less than an increment's way, and of many: no energy is created."""
    for height in (0.0, 1e-4, 0.05):
        job.run(block(3, 3, 3, (10.0, 10.0, 10.0), height=height, law="*ELASTIC\n210000., 0.3", density=7.8e-9, friction=0.3)
                + "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 2, -5000.\n*STEP\n*DYNAMIC, EXPLICIT\n, 5e-5\n" + ENERGIES.format(2e-6))
        check_energy(job, 2e-3)


def hit_at_the_end(job):
    """Steps that end about the increment in which a block hits the ground: the watch over the energies stops none, nothing is created. (A
    point that opens in the very last instant does not give back what its spring still held in the middle of the increment before.)"""
    deck = block(3, 3, 3, (1.0, 1.0, 1.0), "C3D8", height=0.05, law="*ELASTIC\n70000., 0.3", density=2.7e-9)
    for k in range(8):
        end = 1.0e-5 + 4e-8 * k
        job.run(deck + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 2, -5000.\n*STEP\n*DYNAMIC, EXPLICIT\n, {end}\n" + ENERGIES.format(end))
        total = job.history("energy", "ETOTAL")[1]
        check("energy created", max(0.0, total[-1] / total[0] - 1.0), 0.0, 1e-2)


def pressed_block(job, friction=0.0):
    """A rubber block pressed 20 %: the same force in statics and, slowly, in the explicit loop; it stands on the ground."""
    rubber = "*HYPERELASTIC, NEO HOOKE\n0.5, 0.1"
    deck = block(3, 4, 3, (5.0, 5.0, 5.0), law=rubber, friction=friction) + "*AMPLITUDE, NAME=RISE, DEFINITION=SMOOTH STEP\n0., 0., 8e-3, 1.\n"
    deck += "*STEP, NLGEOM\n"
    job.run(deck + "*STATIC\n0.05, 1., 1e-5, 0.05\n*BOUNDARY\nTOP, 1, 1\nTOP, 3, 3\nTOP, 2, 2, -4.\n" + ENERGIES.format(0.05))
    still = abs(job.history("node_9000", "RF2")[1][-1])
    work = abs(job.history("energy", "ALLWK")[1][-1])
    check("energy of hard contact", job.history("energy", "ALLCW")[1][-1] / work, 0.0, 5e-3)  # what the springs of statics hold
    check("balance of energies in statics", job.history("energy", "ETOTAL")[1][-1] / work, 0.0, 2e-3)
    explicit = "*STEP\n*DYNAMIC, EXPLICIT\n, 10e-3\n*BOUNDARY\nTOP, 1, 1\nTOP, 3, 3\n*BOUNDARY, AMPLITUDE=RISE\nTOP, 2, 2, -4.\n"
    job.run(deck.replace("*STEP, NLGEOM\n", "") + explicit + ENERGIES.format(1e-4))
    moving = np.abs(job.history("node_9000", "RF2")[1][-15:]).mean()
    check("force in the explicit loop against statics", moving, still, 0.03)
    penetration = float((job.folder / f"{job.name}.sta").read_text().strip().splitlines()[-3].split()[12])
    check("greatest penetration (mm), told in .sta", penetration, 0.0, 0.12)
    check_energy(job, 1e-2)


def rubbing_block(job):
    """As pressed_block, with friction."""
    pressed_block(job, friction=0.5)


def limits_of_friction(job):
    """A block pressed on the ground and dragged along it: TAUMAX bounds what the ground pulls with, ROUGH lets nothing slip."""
    deck = block(2, 1, 2, (5.0, 10.0, 5.0), "C3D8", friction=0.5)
    held = "*BOUNDARY\n9000, 1, 6\nTOP, 2, 2, -0.5\nTOP, 1, 1, 2.\nALL, 3, 3\n"
    drag = ("*STEP\n*DYNAMIC, EXPLICIT\n, 0.002\n*BOUNDARY\nTOP, 2, 2, -0.5\nALL, 3, 3\n*BOUNDARY, TYPE=VELOCITY\nTOP, 1, 1, 500.\n"
            "*OUTPUT, HISTORY, TIME INTERVAL=1e-4\n*NODE OUTPUT, NSET=NREF\nRF\n*END STEP\n")
    statics = "*STEP, NLGEOM\n*STATIC\n0.1, 1.\n" + held + "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=NREF\nRF\n*NODE OUTPUT, NSET=LOW\nU\n*END STEP\n"
    job.run(deck.replace("*FRICTION", "*FRICTION, TAUMAX=0.1") + statics + drag)
    pulls = job.history("node_9000", "RF")[1][-1]
    check("the coefficient would allow more", float(0.5 * abs(pulls[1]) > 15.0), 1.0, 0.0)
    check("statics: TAUMAX times the area", abs(pulls[0]), 0.1 * 100.0, 1e-6)
    check("explicit: the same", np.abs(job.history("node_9000", "RF", 2)[1][5:, 0]).mean(), 10.0, 0.02)
    job.run(deck.replace("*FRICTION\n0.5", "*FRICTION, ROUGH") + statics + drag)
    slid = max(abs(job.history("node_%d" % n, "U")[1][-1, 0]) for n in (1, 2, 3))
    check("rough: the sole stays where it came down, but for its springs", slid, 0.0, 0.03 * 2.0)
    check("and is pulled harder than any coefficient would have it", float(abs(job.history("node_9000", "RF")[1][-1, 0]) > 40.0), 1.0, 0.0)


def lifted_block(job):
    """Pressed by statics, lifted and pressed again explicitly: nothing pushes across a gap, and the force comes back."""
    rubber = "*HYPERELASTIC, NEO HOOKE\n0.5, 0.1"
    deck = block(3, 4, 3, (5.0, 5.0, 5.0), law=rubber)
    deck += "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., -4., 5e-3, 1., 10e-3, -4., 12e-3, -4.\n"
    deck += "*STEP, NLGEOM\n*STATIC\n0.5, 1.\n*BOUNDARY\nTOP, 1, 1\nTOP, 3, 3\nTOP, 2, 2, -4.\n" + ENERGIES.format(0.5)
    output = "*OUTPUT, FIELD, NUMBER INTERVAL=24\n*NODE OUTPUT\nU, RF\n"
    job.run(deck + "*STEP\n*DYNAMIC, EXPLICIT\n, 12e-3\n*BOUNDARY, AMPLITUDE=A\nTOP, 2, 2, 1.\n" + output + ENERGIES.format(1e-4))
    still = abs(job.history("node_9000", "RF2")[1][-1])
    force = np.abs(job.history("node_9000", "RF2", 2)[1])
    check("force when the explicit step starts", force[0], still, 1e-3)
    check("force when it is pressed again", force[-15:].mean(), still, 0.03)
    coordinates, _ = job.mesh("C3D8R")
    low, across = coordinates[:-1, 1] == 0.0, 0.0
    for frame in range(25):
        height, load = job.frame("U", frame, 2)[:-1, 1][low].min(), np.abs(job.frame("RF", frame, 2)[-1, 1])
        if height > 0.05:
            across = max(across, load)
    check("largest force across a gap", across / still, 0.0, 1e-6)


def velocities_set_once(job):
    """What is given twice is set once, later lines win: a body with all its nodes, and a free block."""
    deck = block(1, 1, 1, (10.0, 10.0, 10.0), height=50.0) + "*NODE, NSET=HUB\n9100, 5., 55., 5.\n"
    body = "*RIGID BODY, REF NODE=9100, ELSET=BLOCK\n"
    step = "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-5\n" + ENERGIES.format(1e-6)
    twice = "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 2, -7.\nALL, 2, -1000.\n"
    energy = 0.5 * 1e-9 * 1e3 * 1e6
    job.run(deck + body + twice.replace("ALL, 2, -7.", "HUB, 2, -1000.") + step)
    check("energy of a body given its velocity twice", job.history("energy", "ALLKE")[1][0], energy, 1e-9)
    job.run(deck + twice + step)
    check("energy of a block given its velocity twice", job.history("energy", "ALLKE")[1][0], energy, 1e-9)


def lost_energy(job):
    """Beyond the limit of stability the balance of energies is lost, slowly at first: the run says so and ends with 3."""
    deck = block(2, 2, 2, (1.0, 1.0, 1.0), "C3D8", height=5.0, law="*ELASTIC\n70000., 0.3", density=2.7e-9)
    step = "*INITIAL CONDITIONS, TYPE=VELOCITY\nLOW, 2, -1.\n*STEP\n*DYNAMIC, EXPLICIT, DIRECT{}\n{}, 1.\n*BULK VISCOSITY\n0., 0.\n*END STEP\n"
    output = job.run(deck + step.format("", 1.9e-7), expected_status=3)
    check("the reason", float("energy balance is lost" in output or "blown up" in output or "distorted" in output), 1.0, 0.0)


def blown_up_at_the_end(job):
    """A run that blows up in its very last increment has failed."""
    deck = block(1, 1, 1, (1.0, 1.0, 1.0), height=5.0, law="*ELASTIC\n70000., 0.3", density=2.7e-9)
    deck += "*AMPLITUDE, NAME=KICK\n0., 0., 0.9e-7, 0., 1e-7, 1.\n"
    step = "*STEP\n*DYNAMIC, EXPLICIT, DIRECT\n5e-8, 1e-7\n*CLOAD, AMPLITUDE=KICK\n1, 2, 1e-3\n*BOUNDARY, AMPLITUDE=KICK\nTOP, 2, 2, 1e12\n*END STEP\n"
    job.run(deck + step, expected_status=3)


def crushed_block(job):
    """A rubber block is crushed until inner nodes pass through the sole: the run ends with the element, the time and the reason, and
    does not claim to be completed. Crushed less it goes on to its end."""
    for element in ("C3D8", "C3D8R"):
        deck = block(4, 4, 4, (5.0, 5.0, 5.0), element, law="*HYPERELASTIC, NEO HOOKE\n1., 0.1", friction=0.5)
        press = "*BOUNDARY\nTOP, 1, 1\nTOP, 3, 3\n*BOUNDARY, TYPE=VELOCITY\nTOP, 2, 2, -4900.\n" + ENERGIES.format(1e-4)
        job.run(deck + "*STEP\n*DYNAMIC, EXPLICIT\n, 1.5e-3\n" + press)
        told = job.run(deck + "*STEP\n*DYNAMIC, EXPLICIT\n, 4e-3\n" + press, expected_status=3)
        check(f"{element}: the reason is told", float("has turned inside out at node" in told), 1.0, 0.0)
        check(f"{element}: short increments are told once", job.log().count("so stiffly held, that its stable increment"), 1, 0.0)


def folded_corner(job):
    """A corner of a brick that is driven towards its middle: from a third of the diagonal on it is folded, which is told once, and the run
    goes on; at the middle the element has turned inside out: if it stays there the run ends with the reason, if it comes back it is told."""
    for element in ("C3D8", "C3D8R"):
        deck = block(1, 1, 1, (1.0, 1.0, 1.0), element, law="*HYPERELASTIC, NEO HOOKE\n1., 0.1", height=5.0)
        push = "".join(f"*BOUNDARY, TYPE=VELOCITY\n1, {dof}, {dof}, 1000.\n" for dof in (1, 2, 3)) + "*BOUNDARY\nREST, 1, 3\n"
        deck += "*NSET, NSET=REST, GENERATE\n2, 8\n"
        step = "*STEP\n*DYNAMIC, EXPLICIT\n, {}\n" + push + ENERGIES.format(1e-5)
        job.run(deck + step.format(3e-4))
        check(f"{element}: nothing is folded", float("folded" in job.log()), 0.0, 0.0)
        job.run(deck + step.format(4e-4))
        check(f"{element}: a folded corner is told once", job.log().count("warning: element 1 is folded at a corner"), 1, 0.0)
        told = job.run(deck + step.format(4.7e-4), expected_status=3)
        check(f"{element}: the reason is told", float("element 1 has turned inside out at node 1 when" in told), 1.0, 0.0)
        if element == "C3D8":
            continue  # its increments become too short before
        there_and_back = push.replace("VELOCITY", "VELOCITY, AMPLITUDE=BACK")
        deck += "*AMPLITUDE, NAME=BACK\n0., 1., 4.6e-4, 1., 4.8e-4, -1., 1e-3, -1.\n"
        job.run(deck + step.format(8e-4).replace(push, there_and_back))
        check(f"{element}: what comes back is told", job.log().count("warning: element 1 has turned inside out"), 1, 0.0)


def past_the_end(job):
    """A block slides past the end of the profile: the log tells, once."""
    deck = block(2, 1, 1, (5.0, 5.0, 5.0)).replace("START, -100., 0.\nLINE, 100., 0.", "START, -5., 0.\nLINE, 12., 0.")
    job.run(deck + "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, 5000.\n*STEP\n*DYNAMIC, EXPLICIT\n, 4e-3\n*DLOAD\nBLOCK, GRAV, 9810., 0., -1., 0.\n"
            + ENERGIES.format(1e-4))
    check("warnings", job.log().count("profile of GROUND ends"), 1, 0.0)


def below_the_ground(job):
    """A block that starts below the ground is told with node and depth, and rests there: nothing throws it out; lifted, it comes
    down on the ground itself."""
    fall = "*DLOAD\nBLOCK, GRAV, {}, 0., {}, 0.\n"
    deck = block(1, 1, 1, (5.0, 5.0, 5.0), height=-0.25, friction=0.3)
    lift = fall.format(4e5, 1.0) + ENERGIES.format(1e-4)
    drop = fall.format(4e5, -1.0) + "*OUTPUT, FIELD, NUMBER INTERVAL=1\n*NODE OUTPUT\nU\n" + ENERGIES.format(1e-4)
    rest = fall.format(9810.0, -1.0) + ENERGIES.format(1e-5)
    steps = [f"*STEP\n*DYNAMIC, EXPLICIT, DIRECT\n8e-6, {duration}\n" + what for duration, what in ((2e-3, rest), (2e-3, lift), (8e-3, drop))]
    job.run(deck + "".join(step.replace("*DLOAD", "*DLOAD, OP=NEW") for step in steps))
    check("warning", float("node 1 of SLAVE starts 0.25 below GROUND" in job.log()), 1.0, 0.0)
    gravity = 1e-9 * 125.0 * 9810.0
    check("mean load on the ground", np.abs(job.history("node_9000", "RF2", 1)[1]).mean(), gravity, 0.1)
    check_energy(job, 1e-2, steps=(1, 2, 3))
    lowest = (job.mesh("C3D8R")[0] + job.frame("U", -1, 3))[:-1, 1].min()
    check("lowest node after it came down", min(lowest, 0.0), 0.0, 0.05)


def rigid_part(job):
    """A part carried by a rigid body is not computed; released, it goes on from the very history that it had."""
    deck = block(9, 1, 1, (1.0, 1.0, 1.0), height=9.0, law="*ELASTIC\n70000., 0.3", density=2.7e-9)
    deck += "*NODE, NSET=HUB\n9100, 0., 9., 0.\n*RIGID BODY, REF NODE=9100\n*BOUNDARY\n9100, 1, 6\n"
    deck += "*NSET, NSET=PART\n" + "".join(f"{n}\n" for n in range(1, 41) if (n - 1) % 10 < 6)
    history = "*OUTPUT, HISTORY, FREQUENCY=1\n*ENERGY OUTPUT\nALLIE, ALLVD, ALLKE, ALLWK, ETOTAL\n*END STEP\n"
    steps = ["*INITIAL CONDITIONS, TYPE=VELOCITY\nTOP, 2, -1e4\n*STEP\n*DYNAMIC, EXPLICIT, DIRECT\n5e-8, 1e-5\n" + history]
    steps.append("*STEP\n*DYNAMIC, EXPLICIT, DIRECT\n5e-8, 1e-6\n*RIGID BODY, REF NODE=9100, TIE NSET=PART\n" + history)
    steps.append("*STEP\n*DYNAMIC, EXPLICIT, DIRECT\n5e-8, 1e-5\n*RIGID BODY, REF NODE=9100, RELEASE NSET=PART\n" + history)
    job.run(deck + "".join(steps))
    check("resting elements told", float("5 of 9 elements move with rigid bodies" in job.log()), 1.0, 0.0)
    check("a run that resumes", float(np.isfinite(job.history("energy", "ETOTAL", 3)[1]).all()), 1.0, 0.0)


CASES = {case.__name__: case for case in (bouncing_plate, hard_hits, touching_at_the_start, hit_at_the_end, pressed_block, rubbing_block, limits_of_friction, lifted_block,
                                          velocities_set_once, lost_energy, blown_up_at_the_end, crushed_block, folded_corner, past_the_end, below_the_ground,
                                          rigid_part)}

if __name__ == "__main__":
    case, balocco, ranks, folder = sys.argv[1:]
    CASES[case](Job(case, balocco, ranks, folder))
    sys.exit(f"{len(failures)} checks failed" if failures else 0)
