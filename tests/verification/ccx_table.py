"""Every deck of CalculiX's suite, as it is, against its printed results: ccx_table.py PROGRAM SHARED FOLDER [PATTERN] > CCX.md;
ccx_table.py PROGRAM SHARED FOLDER --check DECK: a test of one.

A deck passes where compare_dat.py of SHARED finds every table within 1e-3 of its largest value. C3D8 is CalculiX's plain 2 x 2 x 2
brick, and in *FREQUENCY and under CENTRIF it finds the mass of C3D20R at eight points: to those decks the table adds *SECTION CONTROLS,
DILATATION=POINTWISE and says so. Of decks that print nothing the displacements
in CalculiX's .frd are compared at the same times, by the same measure; where it made solids of sheets, with the mean across them.
"""
import fnmatch
import os
import re
import subprocess
import sys

import numpy as np

from launch import on_ranks
from static_model import Results

SKIPPED = 77
# Why decks that run do not pass.
NOTES = {
    "beamf2": "CalculiX counts the stress of the linear step before as a preload of the modes; here, as in Abaqus, steps without NLGEOM "
              "leave none",
    "beamnh": "CalculiX stops 2.0e-3 away from its own converged answer (tolerances of 1e-7), from which this one differs by 5.7e-5",
    "beampd": "uniaxial stress at this strain is 988.2 by the law's closed form, as here; CalculiX's one increment gives 993.0; the "
              "second step takes four increments, each of them printed",
    "beampiso": "the elongation is 0.23323 by the law's closed form, as here; CalculiX's is 0.2275 in one increment, 0.2300 in a hundred",
    "beampisof": "modes about the state of beampiso",
    "beamnldye": "explicit: other increments, each of them printed; the motion of the tip agrees to 3.7e-3 (ccx_cases.py)",
    "beamnldype": "explicit: other increments, each of them printed; the motion of the tip agrees to 3.2e-4 (ccx_cases.py)",
    "beamplane": "CalculiX takes four increments and prints each, here one is enough; the end agrees to 8.4e-5",
    "beamnldy": "a load that is there at once, in one increment: here, as in Abaqus, the first acceleration is that of the consistent mass M; "
                "CalculiX finds it with M + (1 + alpha) beta (dt / 10)^2 K (one free degree of freedom shows this to five digits, for any "
                "alpha and dt), which leaves most of it out of what is fast; the same deck with the load rising within 1e-12 agrees to the "
                "digits printed",
    "cube2": "displacements agree to 1.0e-6; cubes in free fall have no stress, what is printed is rounding",
    "dist": "CalculiX lets the rope of 7.2 be 7.2025 at 0.6 before it pulls (1.2e-2, then up to 1.7e-3), and leaves 4.5e-8 where the load is gone",
    "membrane1": "CalculiX makes bricks of the sheet and their shear carries a third of the load (deflection 5.33e-3); sheets here carry "
                 "membrane forces alone (7.08e-3)",
    "truss": "CalculiX makes a solid of a bar and prints its points; ccx_cases.py compares the stress",
}
NOTES |= {
    "fricloop": "from the end of the first step on every frame agrees (ccx_cases.py); in that step CalculiX leaves the straight line of its "
                "own ends by up to 5 %",
    "contact6": "the slave is a set of nodes: 1 is the area of each here, as in Abaqus; CalculiX takes 0.0075, a share of all faces around",
    "contact1": "EXPONENTIAL is Abaqus's here, and the area of a node of a set 1; CalculiX has the pressure p0 exp(ln(100) d / c0) over "
                "0.03, a hundredth of the faces around: given that as TABULAR, the deck agrees to 7.1e-7",
    "punch2": "the slave reaches beyond the master: CalculiX cuts its faces at the edge, here their points count whole",
    "contactenergy": "the energies of CalculiX's own 28 contact springs are printed; U, RF and the energies of elements agree",
}
# Decks of *STEADY STATE DYNAMICS, which have CalculiX's tables of modal factors between those compared here.
HARMONIC = """
## Harmonic responses

Tables of sets alone are compared, with FREQUENCY SCALE=LINEAR, which is the scale that CalculiX means (here, as in Abaqus, the
logarithmic one is meant where nothing is said), and with DILATATION=POINTWISE.

| deck | passes | largest difference, or why not |
|---|---|---|
| beamdy8, beamdy9 | yes | 1.9e-11, 1.4e-15: all printed digits |
| beamdy10 | no | refused: *BOUNDARY moves the base; by *BASE MOTION, TYPE=DISPLACEMENT it runs, and TU differs by 6.2e-2 of itself: damping resists motion relative to the base here, as in Abaqus, and there the total one; that difference taken out, by 2.4e-4 |
| beamdy11, beamdy12, beamdy13 | no | refused: HARMONIC=NO |
| dashpot2 | no | displacements 6.1e-7 (without the empty *STEP at the end of the deck); reactions differ by up to 9.7e-2 of a table: they count the dashpot's force here, and there that of the spring alone |
| dashpot3 | no | refused: a damping coefficient that follows the frequency |
| beamfsh1, shellf, shellf2 | no | refused: S8 and S8R |
| acou2 | no | refused: acoustics by *HEAT TRANSFER |
| segststate, multistage | no | refused: cyclic symmetry |
"""
CONTROLS = "*SECTION CONTROLS, NAME=PLAIN-BRICK, DILATATION=POINTWISE\n"


def with_plain_bricks(text):
    """The deck with plain bricks in place of C3D8, and of C3D20R whose mass counts in modes or turns, or None where it has none."""
    counts = r"(8|20R)" if re.search(r"^\*FREQUENCY|,\s*CENTRIF", text, re.I | re.M) else "8"
    if not re.search(r"TYPE=C3D" + counts + r"\s*(,|$)", text, re.I | re.M):
        return None
    text = re.sub(r"^(\*SOLID SECTION\s*,)", r"\1CONTROLS=PLAIN-BRICK,", text, flags=re.I | re.M)
    first = re.search(r"^\*(NODE|HEADING)", text, re.I | re.M).start()
    return text[:first] + CONTROLS + text[first:]


def run(program, deck, folder, ranks=1):
    os.makedirs(folder, exist_ok=True)
    command = [*on_ranks(ranks), program, "run", deck, "--output", folder]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, errors="replace")


def first_reason(done):
    """The first error that the program told, without the path of the file; or its last line."""
    lines = [line for line in (done.stdout + done.stderr).splitlines() if ": error:" in line]
    if lines:
        return re.sub(r"^\S*/", "", lines[0])
    last = [line for line in (done.stdout + done.stderr).splitlines() if "BALOCCO FAILED" in line]
    return re.sub(r"/\S*/", "", last[-1]) if last else "exit status %d" % done.returncode


def compare(shared, table, reference):
    tool = os.path.join(shared, "tools", "compare_dat.py")
    done = subprocess.run([sys.executable, tool, table, reference], capture_output=True, text=True)
    errors = [float(line.rsplit(":", 1)[1]) for line in done.stdout.splitlines() if re.search(r": \d\.\d\de[-+]\d\d$", line)]
    other = [line for line in done.stdout.splitlines() if not re.search(r": \d\.\d\de[-+]\d\d$", line)]
    return done.returncode == 0, max(errors, default=0.0), other


def frd_displacements(path):
    """Coordinates (n x 3), and of each frame with displacements its time and these (n x 3), as a .frd has them."""
    coordinates, frames, rows, time = [], [], None, 0.0
    for line in open(path, encoding="latin1"):
        if line.startswith("    2C"):
            rows = coordinates
        elif line.startswith("  100CL"):
            time = float(line[12:24])
        elif line.startswith(" -4"):
            rows = [] if line.split()[1] == "DISP" else None
            if rows is not None:
                frames.append((time, rows))
        elif line.startswith(" -3"):
            rows = None
        elif line.startswith(" -1") and rows is not None:
            rows.append([float(line[13 + 12 * i:25 + 12 * i]) for i in range(3)])
    return np.array(coordinates), [(time, np.array(values)) for time, values in frames]


def compare_frd(results, reference):
    """(passes, largest difference over the largest displacement of a frame, what else is to say)."""
    coordinates, frames = frd_displacements(reference)
    used = np.unique(np.concatenate([table["connectivity"][:].ravel() for table in results.file["mesh/element"].values()]))
    used = used[used >= 0]
    apart = np.linalg.norm(results.file["mesh/node/coordinates"][:][used, None] - coordinates[None], axis=2)
    share = (apart <= 1.001 * apart.min(axis=1, keepdims=True) + 1e-9).astype(float)
    share /= share.sum(axis=1, keepdims=True)
    ours = {}
    for step in range(1, sum(name.startswith("step_") for name in results.file) + 1):
        ours.update({float(frame.attrs["time"]): frame["node/U"][:][used] for frame in results.frames(step)})
    worst = 0.0
    for time, displacement in frames:
        nearest = min(ours, key=lambda other: abs(other - time))
        if abs(nearest - time) > 1e-5 * max(time, 1e-30):
            return False, worst, ["no frame at the time %g" % time]
        worst = max(worst, np.abs(ours[nearest] - share @ displacement).max() / np.abs(displacement).max())
    return worst <= 1e-3, worst, []


def judge(program, shared, folder, name):
    """(passes, what to say of it)."""
    source = os.path.join(shared, "cases", "ccx", name)
    text = open(source + ".inp", encoding="latin1").read()
    plain = with_plain_bricks(text)
    deck = source + ".inp"
    if plain is not None:
        os.makedirs(folder, exist_ok=True)
        deck = os.path.join(folder, name + ".inp")
        with open(deck, "w", encoding="latin1") as copy:
            copy.write(plain)
    note = " (with DILATATION=POINTWISE)" if plain is not None else ""
    try:
        done = run(program, deck, folder)
    except subprocess.TimeoutExpired:
        return False, "runs longer than 300 s"
    if done.returncode == 2:
        return False, "refused: " + first_reason(done)
    if done.returncode != 0:
        return False, "fails: " + first_reason(done)
    table, reference = os.path.join(folder, name + ".dat"), source + ".dat.ref"
    if not os.path.exists(reference):
        good, worst, other = compare_frd(Results(os.path.join(folder, name + ".h5")), source + ".frd.ref")
        note += " (displacements)"
    elif not os.path.exists(table):
        return False, "runs, but prints nothing"
    else:
        good, worst, other = compare(shared, table, reference)
    if good:
        return True, "%.1e%s" % (worst, note)
    what = "; ".join(other[:1]) if other else "largest difference %.1e" % worst
    return False, "runs; %s%s%s" % (what, note, ": " + NOTES[name] if name in NOTES else "")


def main():
    program, shared, folder = sys.argv[1:4]
    if sys.argv[4:5] == ["--check"]:
        if not os.path.isdir(os.path.join(shared, "cases", "ccx")):
            print("skipped: no decks in %s" % shared)
            return SKIPPED
        passes, what = judge(program, shared, folder, sys.argv[5])
        print(what)
        return 0 if passes else 1
    pattern = sys.argv[4] if len(sys.argv) > 4 else "*"
    decks = sorted(name[:-4] for name in os.listdir(os.path.join(shared, "cases", "ccx")) if name.endswith(".inp"))
    rows = [(name,) + judge(program, shared, os.path.join(folder, name), name) for name in decks if fnmatch.fnmatch(name, pattern)]
    print("# CalculiX's own decks\n")
    print(__doc__.split("\n\n")[1].strip() + "\n")
    print("%d of %d pass.\n" % (sum(row[1] for row in rows), len(rows)))
    print("| deck | passes | largest difference, or why not |\n|---|---|---|")
    for name, passes, what in rows:
        print("| %s | %s | %s |" % (name, "yes" if passes else "no", what.replace("|", "/")))
    print(HARMONIC.rstrip("\n"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
