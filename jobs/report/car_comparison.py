"""The semi-flexible and the complete car over one obstacle: their loads beside each other where both have been driven."""

import os

import numpy as np

import car_findings
import car_loads
from balocco_results import Results
from car_figures import grid, words
from report import smooth

FIDELITIES = ("semi-flexible", "complete")
COMPARED = [f"{group}_left_{component}" for group in ("wheel_centre_front", "wheel_centre_rear", "strut_mount_front")
            for component in ("Fz", "Fx")]


def both(folder):
    """Folders of both drives by fidelity, if this is one of them and the other lies beside it; {} otherwise."""
    obstacle, _, fidelity = os.path.basename(os.path.abspath(folder)).partition("_")
    beside = {name: os.path.join(os.path.dirname(os.path.abspath(folder)), f"{obstacle}_{name}") for name in FIDELITIES}
    driven = all(os.path.exists(os.path.join(path, name)) for path in beside.values() for name in ("drive.inp", "drive.h5"))
    return beside if fidelity in beside and driven else {}


class Loads:
    """Forces of a drive below 150 Hz, against the distance of their wheel from the obstacle, or time."""

    def __init__(self, folder):
        deck, results = (os.path.join(folder, name) for name in ("drive.inp", "drive.h5"))
        columns = car_loads.table(deck, results)
        course = car_findings.course(Results(results))
        away, self.label = course.distances(columns), course.label
        self.distance = {name: away[name[:-3]] for name in COMPARED}
        self.force = {name: smooth(columns["time"], columns[name], car_findings.CUTOFF) for name in COMPARED}


def title(name):
    place, _, component = name.rpartition("_")
    return f"{words(place)}, {component}"


def figure(drives):
    """One panel a force; one line a drive, as far as the shorter one goes."""
    shown, axes = grid(len(COMPARED) // 2, 2, height=2.5)
    for axis, name in zip(axes.flat, COMPARED):
        for fidelity, style in zip(FIDELITIES, ("-", "--")):
            axis.plot(drives[fidelity].distance[name] / 1e3, drives[fidelity].force[name], style, linewidth=1.0, label=fidelity)
        axis.set_xlim(*(end / 1e3 for end in common_range(drives, name)))
        axis.set_ylabel("N")
        axis.set_title(title(name), fontsize=9)
        axis.grid(alpha=0.25)
        axis.legend(fontsize=7)
    for axis in axes[-1]:
        axis.set_xlabel(next(iter(drives.values())).label)
    return shown


def common_range(drives, name):
    ends = [(drive.distance[name][0], drive.distance[name][-1]) for drive in drives.values()]
    return max(first for first, _ in ends), min(last for _, last in ends)


def difference(drives, name):
    """Over the range that both have: the value of each farthest from its first, and the root mean square of their difference."""
    start, end = common_range(drives, name)
    at = np.linspace(start, end, 1000)
    values = {fidelity: np.interp(at, drive.distance[name], drive.force[name]) for fidelity, drive in drives.items()}
    peaks = [float(force[np.argmax(np.abs(force - force[0]))]) for force in (values[fidelity] for fidelity in FIDELITIES)]
    return *peaks, float(np.sqrt(np.mean((values[FIDELITIES[0]] - values[FIDELITIES[1]])**2)))


def rows(drives):
    """Rows of a table: force, peak of each, their difference, root mean square of the difference."""
    found = []
    for name in COMPARED:
        one, other, spread = difference(drives, name)
        found.append((title(name), one, other, other - one, spread))
    return found
