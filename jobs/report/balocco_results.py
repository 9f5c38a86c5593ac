"""Reads Balocco's result files (JOB.h5). Layout: README, "Files of a job"."""

import numpy as np
import h5py

# Corners of the faces of each shape, counter-clockwise seen from outside, by the number of nodes of an element.
SOLID_FACES = {
    8: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    6: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
}


def _number(name):
    return int(name.rsplit("_", 1)[1])


def text(attribute):
    """A string attribute: fixed-length ones arrive as bytes."""
    return attribute.decode() if isinstance(attribute, bytes) else str(attribute)


class Frame:
    """Variables at one instant: node("U") (n, 3), element("C3D8R", "S") (n, 6)."""

    def __init__(self, group):
        self._group = group
        self.time = float(group.attrs["time"])
        self.step_time = float(group.attrs["step_time"])

    def node(self, variable):
        return self._group["node"][variable][:] if variable in self._group["node"] else None

    def element(self, kind, variable):
        path = f"element/{kind}/{variable}"
        return self._group[path][:] if path in self._group else None


class Step:
    def __init__(self, group):
        self._group = group
        self.name = text(group.attrs["name"])
        self.procedure = text(group.attrs["procedure"])
        self.completed = bool(group.attrs["completed"])
        self.time_start = float(group.attrs["time_start"])
        names = sorted((name for name in group if name.startswith("frame_")), key=_number)
        self.frames = [Frame(group[name]) for name in names]

    @property
    def explicit(self):
        return self.procedure.startswith("explicit")

    def histories(self):
        return list(self._group["history"]) if "history" in self._group else []

    def history(self, group):
        """{"time": (n), variable: (n) or (n, c)} of a group such as "energy" or "node_9003", or of the node or element alone in a set of
        that name; {} if there is none."""
        path = f"history/{group}"
        if path not in self._group:
            named = (name for name in self.histories() if text(self._group[f"history/{name}"].attrs.get("set", "")) == group)
            path = f"history/{next(named, '')}"
        if path not in self._group or path == "history/":
            return {}
        data = {name: dataset[:] for name, dataset in self._group[path].items()}
        rows = len(data["time"])
        return {name: values[:rows] for name, values in data.items()}


class Surface:
    """An analytical rigid surface: profile points (n, 2) in the plane of axes 0 and 1 through origin."""

    def __init__(self, group):
        self.profile = group["profile"][:]
        self.origin = group["origin"][:]
        self.axes = group["axes"][:]
        self.reference_node = int(group.attrs["reference_node"]) if "reference_node" in group.attrs else None

    def points(self, profile, third=0.0):
        """Global coordinates of profile points, moved by `third` along the third axis."""
        return self.origin + profile[:, :1] * self.axes[0] + profile[:, 1:] * self.axes[1] + third * self.axes[2]


class Results:
    def __init__(self, path):
        self.file = h5py.File(path, "r")
        mesh = self.file["mesh"]
        self.node_ids = mesh["node/id"][:]
        self.coordinates = mesh["node/coordinates"][:]
        self.connectivity = {kind: group["connectivity"][:] for kind, group in mesh["element"].items()}
        self.parts = {kind: group["part"][:] for kind, group in mesh["element"].items()}
        self.node_sets = {name: rows[:] for name, rows in mesh["set/node"].items()}
        self.surfaces = {name: Surface(group) for name, group in mesh.get("analytical_surface", {}).items()}
        names = sorted((name for name in self.file if name.startswith("step_")), key=_number)
        self.steps = [Step(self.file[name]) for name in names]
        self.name = text(self.file.attrs["name"])
        self.units = text(self.file.attrs["units"]).split()

    def row(self, node_id):
        return int(np.flatnonzero(self.node_ids == node_id)[0])

    def reference_id(self, name):
        """Id of the only node of a set, or None."""
        rows = self.node_sets.get(name, [])
        return int(self.node_ids[rows[0]]) if len(rows) == 1 else None

    def history(self, group, steps=None):
        """A history over several steps in one; variables that every step has."""
        pieces = [step.history(group) for step in (self.steps if steps is None else steps)]
        pieces = [piece for piece in pieces if piece]
        if not pieces:
            return {}
        names = set.intersection(*(set(piece) for piece in pieces))
        return {name: np.concatenate([piece[name] for piece in pieces]) for name in names}

    def exterior_faces(self):
        """[(kind, element rows, corners (n, 3 or 4))] of faces that one solid has alone, and of membranes and shells."""
        found = []
        for kind, nodes in self.connectivity.items():
            if nodes.shape[1] in (3, 4) and not kind.startswith(("T3", "B3")):
                found.append((kind, np.arange(len(nodes)), nodes))
        solids = [(kind, nodes, face) for kind, nodes in self.connectivity.items()
                  for face in SOLID_FACES.get(nodes.shape[1], [])]
        keys = [np.sort(np.pad(nodes[:, face], ((0, 0), (0, 4 - len(face))), constant_values=-1), axis=1)
                for kind, nodes, face in solids]
        if keys:
            _, inverse, counts = np.unique(np.concatenate(keys), axis=0, return_inverse=True, return_counts=True)
            alone = np.split(counts[inverse.ravel()] == 1, np.cumsum([len(key) for key in keys])[:-1])
            for (kind, nodes, face), single in zip(solids, alone):
                if single.any():
                    found.append((kind, np.flatnonzero(single), nodes[single][:, face]))
        return found


def largest_principal(tensors):
    """Largest eigenvalue of tensors (n, 6) in Abaqus's order; shear components of strain are engineering strains."""
    full = np.empty((len(tensors), 3, 3))
    for i, (a, b) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]):
        factor = 1.0 if a == b else 0.5
        full[:, a, b] = full[:, b, a] = factor * tensors[:, i]
    return np.linalg.eigvalsh(full)[:, -1]


def mises(tensors):
    s11, s22, s33, s12, s13, s23 = tensors.T
    return np.sqrt(0.5 * ((s11 - s22)**2 + (s22 - s33)**2 + (s33 - s11)**2) + 3.0 * (s12**2 + s13**2 + s23**2))
