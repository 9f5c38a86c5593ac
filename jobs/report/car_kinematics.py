"""What a car's axles do as its wheels travel: toe, camber and half track against travel, rates at the wheel in bounce and in roll.

usage: car_kinematics.py KINEMATICS.h5 [PICTURE.png]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from balocco_results import Results
from car_loads import turned

AXLES = ("FRONT", "REAR")
QUANTITIES = ("toe-in, degrees", "camber, degrees", "half track at the road, mm", "load, N")


def path(results, axle, side, step_names):
    """Rows over the steps: travel mm, toe-in and camber (leaning outwards) in degrees, half track at the road mm, force up N."""
    node = results.node_sets[f"HUB_{axle}_{side}"][0]
    outwards = 1.0 if side == "LEFT" else -1.0
    radius = results.coordinates[node][2]  # the road lies at 0
    history = results.history(f"node_{results.node_ids[node]}", [step for step in results.steps if step.name in step_names])
    moved, axis = history["U"], turned(np.tile((0.0, outwards, 0.0), (len(history["U"]), 1)), history["UR"])
    toe, lean = np.arctan2(axis[:, 0], outwards * axis[:, 1]), -np.arcsin(axis[:, 2])
    return np.column_stack([moved[:, 2], np.degrees(toe), np.degrees(lean), outwards * moved[:, 1] - radius * np.sin(lean),
                            history["RF"][:, 2]])


def figure(results):
    shown, axes = plt.subplots(1, 4, figsize=(12.0, 3.6), constrained_layout=True, sharey=True)
    for axle in AXLES:
        rows = path(results, axle, "LEFT", ("REBOUND",))
        for column, (axis, name) in enumerate(zip(axes, QUANTITIES)):
            axis.plot(rows[:, 1 + column], rows[:, 0], label=axle.lower())
            axis.set_xlabel(name)
            axis.grid(alpha=0.25)
    axes[0].set_ylabel("travel of the wheel up, mm")
    axes[0].legend()
    return shown


def slope(rows, column, reach=10.0):
    """A quantity's change by travel about design height."""
    near = np.abs(rows[:, 0]) <= reach
    return float(np.polyfit(rows[near, 0], rows[near, column], 1)[0])


def summary(results):
    """Rows of a table: what, front, rear."""
    bounce = {axle: path(results, axle, "LEFT", ("REBOUND",)) for axle in AXLES}
    roll = {}
    for axle in AXLES:
        up, down = (path(results, axle, side, ("ROLL",))[-1] for side in ("LEFT", "RIGHT"))
        roll[axle] = float((up[4] - down[4]) / (up[0] - down[0]))
    rates = {axle: slope(bounce[axle], 4) for axle in AXLES}
    across = lambda words, values: (words, *(float(values(axle)) for axle in AXLES))
    return [across("toe-in by travel, degrees a metre", lambda axle: 1000.0 * slope(bounce[axle], 1)),
            across("camber by travel, degrees a metre", lambda axle: 1000.0 * slope(bounce[axle], 2)),
            across("half track at the road by travel, mm a metre", lambda axle: 1000.0 * slope(bounce[axle], 3)),
            across("rate at the wheel in bounce, N/mm", lambda axle: rates[axle]),
            across("rate at the wheel in roll, N/mm", lambda axle: roll[axle]),
            across("of it the anti-roll bar's or the torsion beam's, N/mm", lambda axle: roll[axle] - rates[axle])]


def main():
    results = Results(sys.argv[1])
    for words, front, rear in summary(results):
        print(f"{words:<56} front {front:9.3f}   rear {rear:9.3f}")
    if len(sys.argv) > 2:
        figure(results).savefig(sys.argv[2], dpi=110)


if __name__ == "__main__":
    main()
