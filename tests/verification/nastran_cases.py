"""A pressed steel wheel (haoytchn/FEA_Tutorials, Apache-2.0) read from Nastran bulk data.

usage: nastran_cases.py CASE BALOCCO FOLDER BULK_DATA
"""

import os
import re
import subprocess
import sys

import h5py
import numpy as np


def fields_of(line):
    return [line[start:start + 8].strip() for start in range(8, 72, 8)]


def number(field):
    return float(re.sub(r"(?<=[\d.])([+-]\d)", r"e\1", field))


def summed(path):
    """Nodes in use, shells and mass, added up from the file's small fields without the program."""
    places, shells, thickness, density = {}, [], {}, 0.0
    for line in open(path):
        fields = fields_of(line)
        if line.startswith("GRID"):
            places[fields[0]] = np.array([number(field) for field in fields[2:5]])
        elif line.startswith(("CQUAD4", "CTRIA3")):
            shells.append((fields[1], fields[2:6 if line.startswith("CQUAD4") else 5]))
        elif line.startswith("PSHELL"):
            thickness[fields[0]] = number(fields[2])
        elif line.startswith("MAT1"):
            density = number(fields[4])
    mass = 0.0
    for gauge, corners in shells:
        a, b, c = (places[node] for node in corners[:3])
        diagonals = (c - a, places[corners[3]] - b) if len(corners) == 4 else (b - a, c - a)
        mass += 0.5 * np.linalg.norm(np.cross(*diagonals)) * thickness[gauge] * density
    return {node for _, corners in shells for node in corners}, shells, mass


def converted(balocco, folder, path):
    os.makedirs(folder, exist_ok=True)
    deck = os.path.join(folder, "wheel.inp")
    return deck, subprocess.run([balocco, "convert", path, "--output", deck], check=True, stdout=subprocess.PIPE, text=True).stdout


def wheel_mass(balocco, folder, path):
    """As many nodes and shells as the file has, of the same mass, and a deck that is read without a complaint."""
    deck, told = converted(balocco, folder, path)
    nodes, shells, mass = summed(path)
    assert re.search(rf"{len(nodes)} nodes, 56 S3R, {len(shells) - 56} S4R", told), told
    assert "1 FORCE, 1 GRAV, 2 GRID that no element uses, 1 MOMENT, 1 PARAM, 1 RBE2, 1 RBE3, 1 SPC" in told, told
    checked = subprocess.run([balocco, "check", deck], check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert checked.stderr == "", checked.stderr
    found = float(re.search(r"(?m)^Mass ([\d.e+-]+),", checked.stdout)[1])
    print(f"{len(nodes)} nodes, {len(shells)} shells, mass {found:.6g}, by the file {mass:.6g}")
    assert abs(found / mass - 1.0) < 1e-5, (found, mass)  # check prints six digits


FREE = """*INCLUDE, INPUT={deck}
*STEP, NAME=FREE
*FREQUENCY
8
*END STEP
"""


def wheel_frequency(balocco, folder, path):
    """The free wheel: six motions of a rigid body, then its rim becomes an ellipse, along two axes. A plain ring of its sheet (radius
    163 mm) would do so at 60 Hz; its flanges and its disc stiffen that, and the disc's eight vents tell no axis from the other."""
    deck, _ = converted(balocco, folder, path)
    job = os.path.join(folder, "free.inp")
    open(job, "w").write(FREE.format(deck=deck))
    subprocess.run([balocco, "run", job, "--output", folder], check=True)
    step = h5py.File(os.path.join(folder, "free.h5"))["step_1"]
    frequencies = sorted(step[name].attrs["frequency"] for name in step if name.startswith("mode_"))
    print(" ".join(f"{frequency:.2f}" for frequency in frequencies), "Hz")
    assert max(np.abs(frequencies[:6])) < 1e-2 * frequencies[6], frequencies
    assert 120.0 < frequencies[6] < 400.0 and frequencies[7] < 1.05 * frequencies[6], frequencies


CAR = """base = "{base}"
fidelity = "rigid"
mesh_size = 100.0
"""
WHEEL = """[wheel]
mesh = "{mesh}"
seat_diameter = 330.2
width = 127.0
seat_width = 20.0
mounting_diameter = 140.0
material = "structural"
"""
HELD = """*STEP, NAME=UP
*STATIC
*BOUNDARY
HUB_FRONT_LEFT, 1, 6
*CLOAD
SEATS_FRONT_LEFT, 3, 1000.
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=SEATS_FRONT_LEFT
U, UR
*END STEP
*STEP, NAME=MODES
*FREQUENCY
2
*BOUNDARY
HUB_FRONT_LEFT, 1, 6
*END STEP
"""


def car(balocco, folder, name, text):
    """The car's deck, and its mass by `check`, which has nothing to say against it but of joints between rigid parts."""
    spec, deck = os.path.join(folder, name + ".toml"), os.path.join(folder, name + ".inp")
    open(spec, "w").write(text)
    subprocess.run([balocco, "car", spec, "--output", deck], check=True, stdout=subprocess.DEVNULL)
    checked = subprocess.run([balocco, "check", deck], check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert "warning" not in checked.stderr, checked.stderr
    return open(deck).read(), float(re.search(r"(?m)^Mass ([\d.e+-]+),", checked.stdout)[1])


def wheel_of_car(balocco, folder, path):
    """In place of the rigid rims the car weighs what it weighed. A wheel whose hub is held is some hundred times as stiff as its
    tyre (190 N/mm), and its seats rock on it at frequencies far above wheel hop, alike about both axes."""
    os.makedirs(folder, exist_ok=True)
    base = CAR.format(base=os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "car", "car.toml"))
    (_, rigid), (deck, elastic) = car(balocco, folder, "rigid", base), car(balocco, folder, "steel", base + WHEEL.format(mesh=path))
    assert rigid == elastic, (rigid, elastic)
    wheel = deck[deck.index("*NODE, NSET=RIM_AND_DISC_FRONT_LEFT"):deck.index("*NODE, NSET=RIM_AND_DISC_FRONT_RIGHT")]
    materials = deck[deck.index("** ---- MATERIALS"):deck.index("** ---- FIDELITY")]
    job = os.path.join(folder, "wheel.inp")
    open(job, "w").write("*HEADING\n" + wheel.replace(", ANALYTICAL SURFACE=RIM_FRONT_LEFT", "") + materials + HELD)
    subprocess.run([balocco, "run", job, "--output", folder], check=True)
    results = h5py.File(os.path.join(folder, "wheel.h5"))
    history = results["step_1/history"]
    moved = next(history[name]["U"][-1] for name in history if name.startswith("node_"))
    rocking = [results["step_2"][name].attrs["frequency"] * 1e3 for name in ("mode_1", "mode_2")]
    print(f"car {rigid:.6g} g; wheel {1000.0 / moved[2]:.4g} N/mm upright, rocks at {rocking[0]:.1f} and {rocking[1]:.1f} Hz")
    assert 1e2 < 1000.0 / moved[2] / 190.0 < 1e3, moved
    assert abs(moved[0]) < 1e-3 * moved[2] and rocking[0] > 150.0 and rocking[1] < 1.02 * rocking[0], (moved, rocking)


if __name__ == "__main__":
    case, balocco, folder, path = sys.argv[1:]
    if not os.path.exists(path):
        print("skipped: no", path)
        sys.exit(77)
    {"wheel_mass": wheel_mass, "wheel_frequency": wheel_frequency, "wheel_of_car": wheel_of_car}[case](balocco, folder, path)
