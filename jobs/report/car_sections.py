"""What the rails carry: forces and moments in sections across them, from the section forces of their sheets."""

import numpy as np

NAMES = [f"SECTION_{rail}_{side}" for rail in ("FRONT_RAIL", "RAIL_EXTENSION", "REAR_RAIL") for side in ("LEFT", "RIGHT")]
COMPONENTS = ("N", "Vy", "Vz", "My", "Mz")


def strips(corners):
    """Of quadrilaterals (n, 4, 3): middles, widths across the section, and axes: along the car in the sheet, across, normal."""
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    area = 0.5 * np.linalg.norm(normal, axis=1)
    normal /= 2.0 * area[:, None]
    along = np.array([1.0, 0.0, 0.0]) - normal[:, :1] * normal
    along /= np.linalg.norm(along, axis=1)[:, None]
    edges = np.roll(corners, -1, axis=1) - corners
    length = 0.5 * np.abs(np.einsum("nec,nc->ne", edges, along)).sum(axis=1)
    return corners.mean(axis=1), area / length, np.stack([along, np.cross(normal, along), normal], axis=1)


def resultants(corners, sheet_forces):
    """Rows (times, 5) of what the front part of a rail puts on the rear one: tension, shear across and up, moments about y and z
    through the section's middle. sheet_forces (times, n, 5): 11 22 12 13 23 a unit width; thin sheets' own moments are left out."""
    middles, widths, axes = strips(corners)
    force = np.einsum("tnk,nkc,n->tnc", sheet_forces[:, :, [0, 2, 3]], axes, widths)
    lever = middles - np.average(middles, axis=0, weights=widths)
    total, moment = force.sum(axis=1), np.cross(lever[None], force).sum(axis=1)
    return np.column_stack([total, moment[:, 1:]])


def columns(file, step):
    """Columns by name, N and N mm; {} where the rails are rigid."""
    result = {}
    for name in NAMES:
        rows = file[f"mesh/set/element/{name}/S4R"][:] if f"mesh/set/element/{name}" in file else []
        histories = [f"history/element_{number}/SF" for number in (file["mesh/element/S4R/id"][rows] if len(rows) else [])]
        if not histories or any(history not in step for history in histories):
            continue
        corners = file["mesh/node/coordinates"][:][file["mesh/element/S4R/connectivity"][:][rows]]
        carried = resultants(corners, np.stack([step[history][:] for history in histories], axis=1))
        result.update({f"{name.lower()}_{component}": carried[:, i] for i, component in enumerate(COMPONENTS)})
    return result
