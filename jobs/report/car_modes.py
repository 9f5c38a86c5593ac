"""What moves in each mode of a car about its equilibrium: its ride on springs and tyres, or its body, which twists and bends."""

from dataclasses import dataclass

import h5py
import numpy as np

from balocco_results import text

WHEELS = ("FRONT_LEFT", "FRONT_RIGHT", "REAR_LEFT", "REAR_RIGHT")
MOUNTS = ("STRUT_MOUNT_FRONT_LEFT", "STRUT_MOUNT_FRONT_RIGHT", "SPRING_SEAT_REAR_LEFT", "SPRING_SEAT_REAR_RIGHT")
FAMILIES = ("rigid", "torsion", "vertical bending", "lateral bending", "leaning", "local")
DEFORMS = 0.3  # share of a body's motion from which on it is its own: springs and tyres leave it all but rigid


@dataclass
class Mode:
    frequency: float  # Hz
    kind: str         # what moves
    group: h5py.Group
    shares: dict      # of the body's motion, by family; {}: it hardly deforms

    @property
    def local(self):
        return bool(self.shares) and max(FAMILIES[1:], key=self.shares.get) == "local"


def shapes_of(places):
    """(family, shape (n, 3)) of what a body does as a whole, lengths in parts of half of its own from its middle."""
    x, y, z = ((places - places.mean(axis=0)) / (0.5 * np.ptp(places[:, 0]))).T
    still, moves = np.zeros_like(x), np.ones_like(x)
    columns = [("rigid", (moves, still, still)), ("rigid", (still, moves, still)), ("rigid", (still, still, moves)),
               ("rigid", (still, -z, y)), ("rigid", (z, still, -x)), ("rigid", (-y, x, still)),
               # Ends roll against each other, about an axis of any height; sections may lose their right angles over it.
               ("torsion", (still, still, x * y)), ("torsion", (still, x * z, still)), ("torsion", (still, x, still)),
               # The middle moves against the ends; sections tilt, about a line of any height.
               ("vertical bending", (still, still, x**2)), ("vertical bending", (x * z, still, still)),
               ("vertical bending", (x, still, still)),
               ("lateral bending", (still, x**2, still)), ("lateral bending", (x * y, still, still)),
               ("leaning", (still, z, still))]  # the roof moves sideways against the floor
    return [(family, np.stack(shape, axis=1)) for family, shape in columns]


def decompose(places, moved):
    """Shares of a motion's squares by family, which sum to 1, and what is left of it when all but the local is taken away."""
    shapes = shapes_of(places)
    # Orthonormal one after the other: bending is what no rigid motion does.
    basis, _ = np.linalg.qr(np.stack([shape.ravel() for _, shape in shapes], axis=1))
    parts = basis.T @ moved.ravel()
    left = moved - (basis @ parts).reshape(moved.shape)
    whole = np.sum(moved**2)
    shares = dict.fromkeys(FAMILIES, 0.0)
    for (family, _), part in zip(shapes, parts):
        shares[family] += part**2 / whole
    shares["local"] = np.sum(left**2) / whole
    return shares, left


class Body:
    """The body in white: its nodes and those of each of its pressings."""

    def __init__(self, file):
        elements = file["mesh/set/element/BODY/S4R"][:]
        nodes, parts = (file[f"mesh/element/S4R/{name}"][:][elements] for name in ("connectivity", "part"))
        self.nodes = np.unique(nodes)
        self.places = file["mesh/node/coordinates"][:][self.nodes]
        name = lambda part: text(file[f"mesh/part/{part}"].attrs["name"])
        rows = lambda part: np.searchsorted(self.nodes, np.unique(nodes[parts == part]))
        self.pressings = {name(part): rows(part) for part in np.unique(parts)}

    def shape(self, moved):
        """What the body's nodes do, in words, and the shares; "" and none where it hardly deforms."""
        shares, left = decompose(self.places, moved)
        most = max(FAMILIES[1:], key=shares.get)
        if shares["rigid"] > 1.0 - DEFORMS:
            return "", {}
        if most != "local":
            return "body: " + most, shares
        squares = {name: np.sum(left[rows]**2) for name, rows in self.pressings.items()}
        return "body, local: " + max(squares, key=squares.get).lower().replace("_", " "), shares


def ride_words(wheels, mounts):
    """Of heights of wheels and mounts: the body on its springs, or wheels that hop below it; None: neither."""
    body, wheel = np.abs(mounts).max(), np.abs(wheels).max()
    if body > 0.3 and wheel < 0.3 * body:
        heave, roll = 0.5 * (mounts[[0, 2]] + mounts[[1, 3]]), 0.5 * (mounts[[0, 2]] - mounts[[1, 3]])
        return "body rolls" if np.abs(roll).max() > np.abs(heave).max() else "body: front %+.2f, rear %+.2f" % tuple(heave)
    if wheel > 0.5 and body < 0.2 * wheel:
        return "hop: " + ", ".join("%s %+.2f" % (name.lower(), value) for name, value in zip(WHEELS, wheels) if abs(value) > 0.2)
    return None


def modes(file):
    """Modes of the ride and of the body, by frequency; others (engine, tyres) are left out."""
    rows = lambda names: [file[f"mesh/set/node/{name}"][0] for name in names]
    hubs, mounts, body = rows("HUB_" + wheel for wheel in WHEELS), rows(MOUNTS), Body(file)
    groups = [group[name] for group in file.values() for name in group if name.startswith("mode_")]
    found = []
    for group in sorted(groups, key=lambda group: group.attrs["eigenvalue"]):
        moved = group["node/U"][:].astype(float)
        kind, shares = "", {}
        if np.abs(moved[body.nodes]).max() > 0.3 * np.abs(moved).max():
            kind, shares = body.shape(moved[body.nodes])
        if kind := kind or ride_words(moved[hubs, 2], moved[mounts, 2]):
            found.append(Mode(1000.0 * group.attrs["frequency"], kind, group, shares))
    return found
