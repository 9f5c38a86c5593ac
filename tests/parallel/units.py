#!/usr/bin/env python3
"""Units do not matter: a deck in other units of length, mass and time, all powers of two, gives the same bits times the power.

units.py CASE BALOCCO FOLDER. What is found to differ is a tolerance, a floor or a scale somewhere that has a unit of its own.
"""
import os
import pathlib
import subprocess
import sys

import h5py
import numpy as np

# Powers of two of the units of length, mass and time. The first is what the others are compared with; the second mixes all.
SYSTEMS = [(0, 0, 0), (10, -7, -13), (-20, 0, 0), (0, 30, 0), (0, 0, 21)]

# Dimension (length, mass, time) of what results hold.
FORCE, STRESS, ENERGY = (1, 1, -2), (-1, 1, -2), (2, 1, -2)
DIMENSION = {
    "U": (1, 0, 0), "V": (1, 0, -1), "A": (1, 0, -2), "RF": FORCE, "UR": (0, 0, 0), "VR": (0, 0, -1), "AR": (0, 0, -2), "RM": ENERGY,
    "S": STRESS, "MISES": STRESS, "LE": (0, 0, 0), "PEEQ": (0, 0, 0), "SENER": STRESS, "STH": (1, 0, 0), "E": (1, 0, 0),
    "CPRESS": STRESS, "CSHEAR": STRESS, "COPEN": (1, 0, 0), "CSLIP": (1, 0, 0), "CNORMF": FORCE, "CSHEARF": FORCE,
    "CFN": FORCE, "CFT": FORCE, "CAREA": (2, 0, 0), "time": (0, 0, 1),
}
SPRING_DIMENSION = dict(DIMENSION, S=FORCE)


class Units:
    """Writes numbers in a system of units."""

    def __init__(self, powers):
        self.powers = powers

    def factor(self, dimension):
        return 2.0 ** sum(p * d for p, d in zip(self.powers, dimension))

    def __call__(self, value, length=0, mass=0, time=0):
        return "%.17g" % (value * self.factor((length, mass, time)))

    def length(self, value):
        return self(value, length=1)

    def time(self, value):
        return self(value, time=1)

    def speed(self, value):
        return self(value, length=1, time=-1)

    def acceleration(self, value):
        return self(value, length=1, time=-2)

    def density(self, value):
        return self(value, length=-3, mass=1)

    def stress(self, value):
        return self(value, length=-1, mass=1, time=-2)

    def force(self, value):
        return self(value, length=1, mass=1, time=-2)


def block(units, counts, size, at=(0.0, 0.0, 0.0), kind="C3D8R"):
    """Nodes and bricks of a block, and its lower face as a surface SOLE."""
    nx, ny, nz = counts
    number = lambda i, j, k: 1 + i + (nx + 1) * (j + (ny + 1) * k)
    nodes, bricks, sole = [], [], []
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                x = [a + s * n / c for a, s, n, c in zip(at, size, (i, j, k), counts)]
                nodes.append("%d, %s, %s, %s" % (number(i, j, k), *map(units.length, x)))
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                low = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                high = [n + (nx + 1) * (ny + 1) for n in low]
                bricks.append("%d, %s" % (len(bricks) + 1, ", ".join(map(str, low + high))))
                if k == 0:
                    sole.append("%d, S1" % len(bricks))
    return ("*NODE, NSET=BLOCK\n" + "\n".join(nodes) + f"\n*ELEMENT, TYPE={kind}, ELSET=BLOCK\n" + "\n".join(bricks) +
            "\n*SURFACE, NAME=SOLE, TYPE=ELEMENT\n" + "\n".join(sole) + "\n")


def ground(units):
    return f"""*NODE, NSET=GROUND
9000, 0, 0, 0
*SURFACE, TYPE=CYLINDER, NAME=GROUND
0, 0, 0, {units.length(1)}, 0, 0
0, {units.length(1)}, 0
START, {units.length(-2)}, 0
LINE, {units.length(2)}, 0
*RIGID BODY, ANALYTICAL SURFACE=GROUND, REF NODE=9000
*SURFACE INTERACTION, NAME=DRY
*FRICTION
0.5
*CONTACT PAIR, INTERACTION=DRY
SOLE, GROUND
*BOUNDARY
9000, 1, 6
"""


OUTPUT = """*OUTPUT, FIELD, NUMBER INTERVAL=4, PRECISION=DOUBLE
*NODE OUTPUT
U, V, A, RF
*ELEMENT OUTPUT
S, LE, SENER
*OUTPUT, HISTORY, FREQUENCY=7
*NODE OUTPUT, NSET=WATCHED
U, V, RF
*ENERGY OUTPUT
ALLKE, ALLSE, ALLAE, ALLVD, ALLFD, ALLCW, ALLWK, ETOTAL
*END STEP
"""


def sliding(units, law="*ELASTIC\n{E}, 0.3", kind="C3D8R"):
    """A block falls on the ground and slides, all defaults: automatic increments, bulk viscosity, penalty contact with friction."""
    material = law.format(E=units.stress(2e6), C10=units.stress(3e5), D1=units(1e-6, length=1, mass=-1, time=2), beta=units.time(1e-6))
    return (block(units, (3, 2, 2), (0.1, 0.07, 0.05), (-0.03, 0.02, 2e-4), kind) + ground(units) +
            f"""*NSET, NSET=WATCHED
1, 17, 9000
*MATERIAL, NAME=RUBBER
*DENSITY
{units.density(1100)}
{material}
*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER
*INITIAL CONDITIONS, TYPE=VELOCITY
BLOCK, 1, {units.speed(1.0)}
BLOCK, 3, {units.speed(-0.5)}
*STEP
*DYNAMIC, EXPLICIT
, {units.time(2e-3)}
*DLOAD
BLOCK, GRAV, {units.acceleration(9.81)}, 0, 0, -1
""" + OUTPUT.replace("A, RF", "A, RF\n*CONTACT OUTPUT\nCPRESS, CSHEAR, COPEN, CSLIP"))


def sliding_rubber(units):
    return sliding(units, "*HYPERELASTIC, NEO HOOKE\n{C10}, {D1}\n*DAMPING, BETA={beta}", "C3D8")


def oscillators(units):
    """Masses on springs, dashpots and trusses; a spring to the ground through one point; a spinning rigid body."""
    stiffness = units(1000.0, mass=1, time=-2)
    return f"""*NODE
1, 0, 0, 0
2, {units.length(1)}, 0, 0
3, {units.length(1)}, {units.length(0.5)}, 0
4, {units.length(2)}, {units.length(0.5)}, {units.length(0.3)}
5, {units.length(2)}, 0, 0
*NSET, NSET=WATCHED
2, 3, 4, 5
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 2
2, 3
3, 4
4, 5
*MASS, ELSET=MASS
{units(1.7, mass=1)}
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIA
5, 5
*ROTARY INERTIA, ELSET=INERTIA
{units(0.3, length=2, mass=1)}, {units(0.5, length=2, mass=1)}, {units(0.7, length=2, mass=1)}
*RIGID BODY, REF NODE=5, TIE NSET=ARM
*NSET, NSET=ARM
4
*ELEMENT, TYPE=SPRINGA, ELSET=AXIAL
11, 1, 2
12, 2, 3
13, 3, 4
*SPRING, ELSET=AXIAL, NONLINEAR

{units.force(-100)}, {units.length(-0.2)}
{units.force(0)}, {units.length(0)}
{units.force(40)}, {units.length(0.1)}
*ELEMENT, TYPE=SPRING1, ELSET=GROUNDED
14, 3
*SPRING, ELSET=GROUNDED
2
{stiffness}
*ELEMENT, TYPE=DASHPOTA, ELSET=DAMPERS
15, 1, 3
*DASHPOT, ELSET=DAMPERS, NONLINEAR

{units.force(-8)}, {units.speed(-1)}
{units.force(0)}, {units.speed(0)}
{units.force(30)}, {units.speed(1)}
*BOUNDARY
1, 1, 3
*INITIAL CONDITIONS, TYPE=VELOCITY
2, 2, {units.speed(0.7)}
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
5, {units(3.0, time=-1)}, 0, 0, 0
0, 0, 0, 0.6, 0, 0.8
*STEP
*DYNAMIC, EXPLICIT
, {units.time(2.0)}
*CLOAD
2, 1, {units.force(5)}
""" + OUTPUT.replace("S, LE, SENER", "S, E")


CASES = {"sliding": sliding, "sliding_rubber": sliding_rubber, "oscillators": oscillators}


def dimension_of(path):
    """Of a dataset of the results, by its name and its group; nothing for what has no unit."""
    parts = path.split("/")
    name = parts[-1].removesuffix("_IP")
    if "element" in parts[:-1] and parts[-2].startswith(("SPRING", "DASHPOT")):
        return SPRING_DIMENSION[name]
    if name.startswith("ALL") or name == "ETOTAL":
        return ENERGY
    return DIMENSION.get(name) or DIMENSION.get(name.rstrip("0123456789"))


def results(path):
    values = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and name.startswith("step_"):
            dimension = dimension_of(name)
            assert dimension is not None, "no dimension is known for " + name
            values[name] = (item[()], dimension)

    with h5py.File(path) as file:
        file.visititems(visit)
        for name, group in file.items():
            if name.startswith("step_"):
                values.update({f"{name}/{frame}.time": (np.array(group[frame].attrs["time"]), (0, 0, 1)) for frame in group if frame.startswith("frame_")})
    return values


def main():
    case, balocco, folder = sys.argv[1:4]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    reference, failures = None, []
    for powers in SYSTEMS:
        units = Units(powers)
        place = pathlib.Path(folder) / "_".join(map(str, powers))
        place.mkdir(parents=True, exist_ok=True)
        deck = place / f"{case}.inp"
        deck.write_text(CASES[case](units))
        done = subprocess.run([balocco, "run", str(deck), "--output", str(place)], capture_output=True, text=True, env=environment, timeout=100)
        assert done.returncode == 0, f"{powers}: exit status {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
        found = results(place / f"{case}.h5")
        if reference is None:
            reference = found
            assert any(np.any(values) for values, _ in found.values())
            continue
        parted = [name for name in reference if name not in found or
                  not np.array_equal(found[name][0] / units.factor(found[name][1]), reference[name][0])]
        parted += [name for name in found if name not in reference]
        print(f"units 2^{powers}: {len(found)} fields and histories, {len(parted)} differ", *sorted(parted)[:8], sep="\n  ")
        failures += parted
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
