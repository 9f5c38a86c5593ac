"""How a car stands: what its wheels carry, where its wheels and mounts came to rest, what its springs push, how it rides.

usage: car_equilibrium.py CAR.h5
"""

import sys

import h5py
import numpy as np

WHEELS = ("FRONT_LEFT", "FRONT_RIGHT", "REAR_LEFT", "REAR_RIGHT")
MOUNTS = ("STRUT_MOUNT_FRONT_LEFT", "STRUT_MOUNT_FRONT_RIGHT", "SPRING_SEAT_REAR_LEFT", "SPRING_SEAT_REAR_RIGHT")


def last_step(file):
    return file[max((name for name in file if name.startswith("step_") and "history" in file[name]), key=lambda name: int(name[5:]))]


def last(file, name, variable):
    node = file["mesh/node/id"][file[f"mesh/set/node/{name}"][0]]
    return last_step(file)[f"history/node_{node}/{variable}"][-1]


def ride(file):
    """(frequency in Hz, what moves) of each mode of the ride."""
    return [(frequency, kind) for frequency, kind, _ in ride_modes(file)]


def ride_modes(file):
    """(frequency in Hz, what moves, its group) of modes in which the body goes up and down on its springs, or wheels do under it."""
    rows = lambda names: [file[f"mesh/set/node/{name}"][0] for name in names]
    hubs, mounts = rows("HUB_" + wheel for wheel in WHEELS), rows(MOUNTS)
    modes = [group[name] for group in file.values() for name in group if name.startswith("mode_")]
    found = []
    for mode in sorted(modes, key=lambda mode: mode.attrs["eigenvalue"]):
        up = lambda nodes: mode["node/U"][:][nodes, 2]
        wheels, body = up(hubs), up(mounts)
        size = max(np.abs(wheels).max(), np.abs(body).max())
        kind = None
        if np.abs(body).max() > 0.3 and np.abs(wheels).max() < 0.3 * np.abs(body).max():
            heave, roll = 0.5 * (body[[0, 2]] + body[[1, 3]]), 0.5 * (body[[0, 2]] - body[[1, 3]])
            rolls = np.abs(roll).max() > np.abs(heave).max()
            kind = "body rolls" if rolls else "body: front %+.2f, rear %+.2f" % tuple(heave)
        elif size > 0.5 and np.abs(body).max() < 0.1 * size:
            kind = "hop: " + ", ".join("%s %+.2f" % (wheel.lower(), value) for wheel, value in zip(WHEELS, wheels) if abs(value) > 0.2)
        if kind:
            found.append((1000.0 * mode.attrs["frequency"], kind, mode))
    return found


def wheel_loads(file):
    """What the road carries below each wheel, N."""
    history = last_step(file)["history"]
    pair = lambda wheel: next(history[name] for name in history if f"TREAD_{wheel}" in name)
    return {wheel: abs(float(pair(wheel)["CFN"][-1][2])) for wheel in WHEELS}


def main():
    file = h5py.File(sys.argv[1])
    loads = wheel_loads(file)
    for wheel in WHEELS:
        moved = last(file, "HUB_" + wheel, "U")
        print(f"wheel {wheel:<12} carries {loads[wheel]:8.1f} N; its centre moved {moved[0]:+7.2f}, {moved[1]:+7.2f}, {moved[2]:+7.2f} mm")
    roads = sum(last(file, f"ROAD_{side}", "RF")[2] for side in ("LEFT", "RIGHT"))
    print(f"wheels together {sum(loads.values()):.3f} N, roads hold {abs(roads):.3f} N")
    for mount in MOUNTS:
        print(f"mount {mount:<24} moved {last(file, mount, 'U')[2]:+7.2f} mm up")
    for frequency, kind in ride(file):
        print(f"mode at {frequency:6.2f} Hz   {kind}")


if __name__ == "__main__":
    main()
