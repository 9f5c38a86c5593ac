"""Loads of a car under the names that an engineer reads, as CSV: forces of wheel centres and strut mounts on the car along its
axes, and how far they have moved since the start; forces and travels of springs and dampers along themselves; forces in sections of
rails that deform; how far the roads have run. The same lies in LOADS.h5, a group for each place.

usage: car_loads.py CAR.inp CAR.h5 LOADS.csv      the deck says along which axes its connectors measure
"""

import os
import sys

import h5py
import numpy as np

import car_sections

# Name in the table; connector; the node that carries its axes along.
FORCES = [(f"wheel_centre_{wheel.lower()}", f"BEARING_{wheel}", f"AXLE_{wheel}")
          for wheel in ("FRONT_LEFT", "FRONT_RIGHT", "REAR_LEFT", "REAR_RIGHT")]
FORCES += [(f"strut_mount_front_{side.lower()}", f"TOP_MOUNT_{side}", f"STRUT_MOUNT_FRONT_{side}") for side in ("LEFT", "RIGHT")]
ALONG = [f"{part}_{side}" for part in ("STRUT_FRONT", "SPRING_REAR", "DAMPER_REAR") for side in ("LEFT", "RIGHT")]


def axes_of_connectors(deck):
    """Rows: the axes along which each connector's components lie in the undeformed model."""
    blocks, axes, result = [], {}, {}
    for line in open(deck):
        if line.startswith("*") and not line.startswith("**"):
            blocks.append((line.strip(), []))
        elif not line.startswith("**") and blocks:
            blocks[-1][1].append(line.strip())
    words = lambda keyword: (word.strip() for word in keyword.split(","))
    option = lambda keyword, name: next(word.split("=")[1].strip() for word in words(keyword) if word.startswith(name + "="))
    for keyword, lines in blocks:
        if keyword.startswith("*ORIENTATION"):
            first, second = np.array([float(x) for x in lines[0].split(",")][:6]).reshape(2, 3)
            first = first / np.linalg.norm(first)
            second = second - second @ first * first
            second = second / np.linalg.norm(second)
            axes[option(keyword, "NAME")] = np.array([first, second, np.cross(first, second)])
    for keyword, lines in blocks:
        if keyword.startswith("*CONNECTOR SECTION"):
            result[option(keyword, "ELSET")] = axes.get(lines[1].split(",")[0].strip() if len(lines) > 1 else "", np.eye(3))
    return result


def turned(vectors, rotations):
    """Each vector turned by its rotation vector."""
    angle = np.linalg.norm(rotations, axis=1)[:, None]
    axis = rotations / np.maximum(angle, 1e-300)
    along = np.sum(axis * vectors, axis=1)[:, None]
    return vectors * np.cos(angle) + np.cross(axis, vectors) * np.sin(angle) + axis * along * (1.0 - np.cos(angle))


def history_of(file, step, kind, name, variable):
    rows = file[f"mesh/set/{kind}/{name}"]
    number = file["mesh/node/id"][rows[0]] if kind == "node" else file["mesh/element/CONN3D2/id"][rows["CONN3D2"][0]]
    return step[f"history/{kind}_{number}/{variable}"][:]


def table(deck, results):
    """Columns by name."""
    file = h5py.File(results)
    step = file[max((name for name in file if name.startswith("step_")), key=lambda name: int(name[5:]))]
    axes = axes_of_connectors(deck)
    road = f"node_{file['mesh/node/id'][file['mesh/set/node/ROAD_LEFT'][0]]}"
    columns = {"time": step[f"history/{road}/time"][:], "road_travel": -step[f"history/{road}/U"][:, 0]}
    for name, connector, carrier in FORCES:
        local = history_of(file, step, "element", connector, "CTF")[..., :3].reshape(-1, 3)
        force = turned(local @ axes[connector], history_of(file, step, "node", carrier, "UR"))
        moved = history_of(file, step, "node", carrier, "U")
        columns.update({f"{name}_{c}": force[:, i] for i, c in enumerate(("Fx", "Fy", "Fz"))})
        columns.update({f"{name}_{c}": moved[:, i] - moved[0, i] for i, c in enumerate(("Ux", "Uy", "Uz"))})
    for name in ALONG:
        for column, variable in (("force", "CTF"), ("travel", "CU")):
            values = history_of(file, step, "element", name, variable)
            columns[f"{name.lower()}_{column}"] = values.reshape(len(columns["time"]), -1)[:, 0]
    return columns | car_sections.columns(file, step)


def unit(column):
    quantity = column.rpartition("_")[2]
    if quantity == "time":
        return "ms"
    if quantity in ("My", "Mz"):
        return "N mm"
    return "N" if quantity[0] in "FNV" or quantity == "force" else "mm"


def write_groups(columns, path):
    """PLACE/QUANTITY of each column, with its unit; the time at the root."""
    with h5py.File(path, "w") as file:
        for name, values in columns.items():
            place, _, quantity = name.rpartition("_")
            file[f"{place}/{quantity}"] = values
            file[f"{place}/{quantity}"].attrs["unit"] = unit(name)


def main():
    columns = table(sys.argv[1], sys.argv[2])
    rows = np.column_stack(list(columns.values()))
    np.savetxt(sys.argv[3], rows, delimiter=",", header=",".join(columns), comments="", fmt="%.7g")
    write_groups(columns, os.path.splitext(sys.argv[3])[0] + ".h5")
    for name, values in columns.items():
        if name.endswith(("Fx", "Fz")):
            print(f"{name:<28} starts at {values[0]:9.1f} N, between {values.min():9.1f} and {values.max():9.1f} N")


if __name__ == "__main__":
    main()
