"""Energies of a drive by part: tyres and sheets by the job's tables (JOB.dat), springs and dampers by force and travel."""

import re

import numpy as np

TOTAL = re.compile(r"total (internal|kinetic) energy for set (\w+) and time +(\S+)\s+(\S+)")
SPRINGS = ("strut_front", "spring_rear", "damper_rear")


def of_parts(tables):
    """{(set, "internal" or "kinetic"): rows of time, mJ} from the first time of the job on; {} where there are no tables."""
    found = {}
    with open(tables) as file:
        totals = TOTAL.findall(file.read())
    for kind, part, time, value in totals:
        found.setdefault((part, kind), []).append((float(time), float(value)))
    return {name: np.array(rows) for name, rows in found.items()}


def of_assemblies(tables, kind):
    """The same for one kind of energy, the tyres of an axle together: {name: rows}."""
    parts = {part: rows for (part, which), rows in of_parts(tables).items() if which == kind}
    together = {}
    for part, rows in parts.items():
        name = re.sub(r"^TYRE_(FRONT|REAR)_\w+$", r"tyres \1", part).replace("_", " ").lower()
        if name in together:
            rows = np.column_stack([rows[:, 0], together[name][:, 1] + rows[:, 1]])
        together[name] = rows
    return together


def of_springs(columns):
    """What has been done on both springs or dampers of a kind since the start, mJ: {name: (times)}."""
    work = {}
    for name in SPRINGS:
        done = np.zeros(len(columns["time"]))
        for side in ("left", "right"):
            force, travel = columns[f"{name}_{side}_force"], columns[f"{name}_{side}_travel"]
            done[1:] += np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(travel))
        work[name.replace("_", " ")] = done
    return work
