"""How a car stands: what its wheels carry, where its wheels and mounts came to rest, what its springs push, how it rides.

usage: car_equilibrium.py CAR.h5
"""

import sys

import h5py

from car_modes import MOUNTS, WHEELS, modes


def last_step(file):
    with_history = (name for name in file if name.startswith("step_") and "history" in file[name])
    return file[max(with_history, key=lambda name: int(name[5:]))]


def last(file, name, variable):
    node = file["mesh/node/id"][file[f"mesh/set/node/{name}"][0]]
    return last_step(file)[f"history/node_{node}/{variable}"][-1]


def falls(file):
    """The last step is the state in which a fall begins."""
    name = last_step(file).attrs["name"]
    return (name.decode() if isinstance(name, bytes) else name) == "FALL"


def wheel_loads(file):
    """What the road carries below each wheel, N."""
    history = last_step(file)["history"]
    pair = lambda wheel: next(history[name] for name in history if f"TREAD_{wheel}" in name)
    return {wheel: abs(float(pair(wheel)["CFN"][-1][2])) for wheel in WHEELS}


def main():
    file = h5py.File(sys.argv[1])
    if falls(file):
        print("it falls: without weight, its wheels on their rebound stops")
    loads = wheel_loads(file)
    for wheel in WHEELS:
        moved = last(file, "HUB_" + wheel, "U")
        place = ", ".join(f"{component:+7.2f}" for component in moved)
        print(f"wheel {wheel:<12} carries {loads[wheel]:8.1f} N; its centre moved {place} mm")
    roads = sum(last(file, f"ROAD_{side}", "RF")[2] for side in ("LEFT", "RIGHT"))
    print(f"wheels together {sum(loads.values()):.3f} N, roads hold {abs(roads):.3f} N")
    for mount in MOUNTS:
        print(f"mount {mount:<24} moved {last(file, mount, 'U')[2]:+7.2f} mm up")
    for mode in modes(file):
        print(f"mode at {mode.frequency:6.2f} Hz   {mode.kind}")


if __name__ == "__main__":
    main()
