"""Jobs of the tests: runs of the program and what they left, and checks of it."""
import pathlib
import subprocess
import sys

import h5py
import numpy as np

from launch import on_ranks

DECKS = pathlib.Path(__file__).parent / "decks"


class Job:
    """A deck run in a fresh folder, and its results."""

    def __init__(self, name, balocco, ranks, folder):
        self.name, self.balocco, self.ranks, self.folder = name, balocco, ranks, pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def run(self, text=None, expected_status=0, arguments=()):
        deck = self.folder / f"{self.name}.inp"
        deck.write_text(text if text is not None else (DECKS / f"{self.name}.inp").read_text())
        command = [*on_ranks(self.ranks), self.balocco, "run", str(deck), "--output", str(self.folder), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=150)
        if done.returncode != expected_status:
            sys.exit(f"exit status {done.returncode}, expected {expected_status}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
        return done.stdout + done.stderr

    def history(self, group, variable, step=1):
        with h5py.File(self.folder / f"{self.name}.h5") as file:
            history = file[f"step_{step}/history/{group}"]
            return np.array(history["time"]), np.array(history[variable])

    def groups(self, step=1):
        with h5py.File(self.folder / f"{self.name}.h5") as file:
            return list(file[f"step_{step}/history"])

    def frame(self, variable, frame, step=1):
        """Nodal values of a frame; -1: the last."""
        with h5py.File(self.folder / f"{self.name}.h5") as file:
            frames = sorted((k for k in file[f"step_{step}"] if k.startswith("frame_")), key=lambda k: int(k[6:]))
            return np.array(file[f"step_{step}/{frames[frame]}/node/{variable}"])

    def element(self, kind, variable, frame, step=1):
        """Means of a frame over the points of elements of a type; -1: the last."""
        with h5py.File(self.folder / f"{self.name}.h5") as file:
            frames = sorted((k for k in file[f"step_{step}"] if k.startswith("frame_")), key=lambda k: int(k[6:]))
            return np.array(file[f"step_{step}/{frames[frame]}/element/{kind}/{variable}"])

    def mesh(self, element_type):
        with h5py.File(self.folder / f"{self.name}.h5") as file:
            return (np.array(file["mesh/node/coordinates"]), np.array(file[f"mesh/element/{element_type}/connectivity"]))

    def log(self):
        return (self.folder / f"{self.name}.log").read_text()


failures = []


def check(what, value, reference, tolerance):
    """|value - reference| <= tolerance * |reference| (absolute where the reference is zero)."""
    scale = abs(reference) if reference != 0.0 else 1.0
    good = abs(value - reference) <= tolerance * scale
    print(f"{'ok  ' if good else 'FAIL'} {what}: {value:.8g}, expected {reference:.8g} within {tolerance:g}")
    if not good:
        failures.append(what)


def check_energy(job, tolerance, steps=(1,)):
    """The drift of ETOTAL against the largest energy (VERIFY.md: 0.1 % elastic, 1 % with penalty contact)."""
    for step in steps:
        total = job.history("energy", "ETOTAL", step)[1]
        largest = max(np.abs(job.history("energy", name, step)[1]).max() for name in ("ALLKE", "ALLIE", "ALLWK"))
        check(f"energy drift in step {step}", np.abs(total - total[0]).max() / largest, 0.0, tolerance)


UNIT_CUBE = """*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*NSET, NSET=LEFT
1, 4, 5, 8
*NSET, NSET=RIGHT
2, 3, 6, 7
"""


def run_case(cases):
    """The main of a script: SCRIPT CASE BALOCCO FOLDER calls the case of that name with run(text, ranks, place=None), which gives the
    job of a deck, run in the folder under a number, or under the case's own name in `place` below it."""
    case, balocco, folder = sys.argv[1:4]
    counter = iter(range(1000))

    def run(text, ranks, place=None):
        job = Job(case if place else f"{case}_{next(counter)}", balocco, str(ranks), pathlib.Path(folder) / (place or ""))
        job.run(text)
        return job

    cases[case](run)
    sys.exit(1 if failures else 0)
