"""How a car stands: what its wheels carry, where its wheels and mounts came to rest, what its springs push.

usage: car_equilibrium.py CAR.h5
"""

import sys

import h5py

WHEELS = ("FRONT_LEFT", "FRONT_RIGHT", "REAR_LEFT", "REAR_RIGHT")
MOUNTS = ("STRUT_MOUNT_FRONT_LEFT", "STRUT_MOUNT_FRONT_RIGHT", "SPRING_SEAT_REAR_LEFT", "SPRING_SEAT_REAR_RIGHT")


def last_step(file):
    return file[max((name for name in file if name.startswith("step_")), key=lambda name: int(name[5:]))]


def last(file, name, variable):
    node = file["mesh/node/id"][file[f"mesh/set/node/{name}"][0]]
    return last_step(file)[f"history/node_{node}/{variable}"][-1]


def main():
    file = h5py.File(sys.argv[1])
    history = last_step(file)["history"]
    loads = {}
    for wheel in WHEELS:
        pair = next(history[name] for name in history if f"TREAD_{wheel}" in name)
        loads[wheel] = abs(float(pair["CFN"][-1][2]))
    for wheel in WHEELS:
        moved = last(file, "HUB_" + wheel, "U")
        print(f"wheel {wheel:<12} carries {loads[wheel]:8.1f} N; its centre moved {moved[0]:+7.2f}, {moved[1]:+7.2f}, {moved[2]:+7.2f} mm")
    roads = sum(last(file, f"ROAD_{side}", "RF")[2] for side in ("LEFT", "RIGHT"))
    print(f"wheels together {sum(loads.values()):.3f} N, roads hold {abs(roads):.3f} N")
    for mount in MOUNTS:
        print(f"mount {mount:<24} moved {last(file, mount, 'U')[2]:+7.2f} mm up")


if __name__ == "__main__":
    main()
