#!/usr/bin/env python3
"""*CLOAD, FOLLOWER: forces that turn with their nodes: follower_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import check, check_energy, run_case


def elastica(load, steps=20000):
    """A cantilever of length 1 and bending stiffness 1 under a force at its end that stays at right angles to it. With the angle p from the
    end's tangent and the distance s from the end, p'' = load cos p, p(0) = p'(0) = 0. @return displacements and turn of the end"""
    h = 1.0 / steps
    state = np.zeros(4)  # p, p', place along and across the end's tangent

    def slope(y):
        return np.array([y[1], load * math.cos(y[0]), math.cos(y[0]), math.sin(y[0])])

    for _ in range(steps):
        a = slope(state)
        b = slope(state + 0.5 * h * a)
        c = slope(state + 0.5 * h * b)
        d = slope(state + h * c)
        state += h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
    turn, _, along, across = state
    # Seen from the root, whose tangent is at -turn: the end lies ahead, and to the side to which the force bends.
    c, s = math.cos(turn), math.sin(turn)
    x, y = c * along + s * across, s * along - c * across
    return x - 1.0, y, turn


def bent_cantilever(run):
    """The elastica under a follower force, in statics: where the end is, and in few iterations, of which the last ones are quadratic."""
    count, radius, young = 40, 0.02, 1e9
    bending = young * math.pi * radius**4 / 4.0
    nodes = "\n".join(f"{i + 1}, {i / count!r}, 0., 0." for i in range(count + 1))
    beams = "\n".join(f"{i + 1}, {i + 1}, {i + 2}" for i in range(count))
    deck = f"""*NODE
{nodes}
*ELEMENT, TYPE=B31, ELSET=BEAM
{beams}
*NSET, NSET=TIP
{count + 1}
*BEAM SECTION, ELSET=BEAM, MATERIAL=M, SECTION=CIRC
{radius}
0., 0., -1.
*MATERIAL, NAME=M
*ELASTIC
{young}, 0.
*BOUNDARY
1, 1, 6
"""
    loads = (1.0, 3.0, 8.0)
    for load in loads:
        deck += f"""*STEP, NLGEOM
*STATIC
0.25, 1., 1e-5, 0.25
*CLOAD, FOLLOWER
TIP, 2, {load * bending!r}
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=TIP
U, UR
*END STEP
"""
    for ranks in (1, 2):
        job = run(deck, ranks)
        for step, load in enumerate(loads, 1):
            u, turn = job.history(f"node_{count + 1}", "U", step)[1][-1], job.history(f"node_{count + 1}", "UR", step)[1][-1]
            x, y, angle = elastica(load)
            check(f"shortening under {load}", u[0], x, 2e-3)
            check(f"deflection under {load}", u[1], y, 2e-3)
            check(f"turn under {load}", turn[2], angle, 2e-3)
        lines = [line.split() for line in (job.folder / f"{job.name}.sta").read_text().splitlines()]
        iterations = [int(line[1]) for line in lines if len(line) > 8 and line[0].isdigit()]
        check("increments", float(len(iterations) >= 12), 1.0, 0.0)
        check("iterations of an increment", float(max(iterations) <= 7), 1.0, 0.0)


THRUSTER = """*NODE
1, 0.3, -0.2, 0.1
*ELEMENT, TYPE=MASS, ELSET=M
1, 1
*MASS, ELSET=M
2.
*ELEMENT, TYPE=ROTARYI, ELSET=I
2, 1
*ROTARY INERTIA, ELSET=I
0.01, 0.01, 0.01
BODY*NSET, NSET=ONE
1
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
1, 5.
0.3, -0.2, 0., 0.3, -0.2, 1.
*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
1e-4, 1.
*CLOAD, FOLLOWER
1, 1, 4.
*OUTPUT, HISTORY, TIME INTERVAL=0.01
*NODE OUTPUT, NSET=ONE
U, UR
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*END STEP
"""


def spinning_thruster(run):
    """A force that turns with a body that spins: it goes round in x'' = F / m (cos wt, sin wt), as a node and as a rigid body."""
    mass, force, spin = 2.0, 4.0, 5.0
    for ranks, body in ((1, ""), (2, "*RIGID BODY, REF NODE=1, TIE NSET=OTHER\n")):
        deck = THRUSTER.replace("BODY", body)
        if body:
            deck = deck.replace("*ELEMENT", "2, 0.4, -0.2, 0.1\n*NSET, NSET=OTHER\n2\n*ELEMENT", 1)
        job = run(deck, ranks)
        time, u = job.history("node_1", "U")
        x = force / mass / spin**2 * (1.0 - np.cos(spin * time))
        y = force / mass / spin * (time - np.sin(spin * time) / spin)
        check("spin", np.abs(job.history("node_1", "UR")[1][:, 2] - spin * time).max(), 0.0, 1e-9)
        check("along", np.abs(u[:, 0] - x).max(), 0.0, 1e-6)
        check("across", np.abs(u[:, 1] - y).max(), 0.0, 1e-6)
        check_energy(job, 1e-6)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (bent_cantilever, spinning_thruster)})
