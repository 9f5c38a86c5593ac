"""Pictures of the deformed tyre on the road: orthographic, painter's algorithm, shaded facets."""

import numpy as np
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize

from balocco_results import largest_principal, mises

LIGHT = np.array([0.35, -0.55, 0.76])  # unit vector to the lamp


class View:
    """Looks along -toward at the origin; `up` is up in the picture."""

    def __init__(self, toward, up=(0.0, 0.0, 1.0)):
        self.toward = np.asarray(toward, float) / np.linalg.norm(toward)
        self.right = np.cross(up, self.toward)
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(self.toward, self.right)

    def project(self, points):
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def depth(self, points):
        return points @ self.toward


SIDE = View((0.0, -1.0, 0.0))
THREE_QUARTER = View((0.55, -1.0, 0.42))


def element_values(frame, kind, variable):
    """One number an element for colours: a scalar, or Mises of S, or the largest principal LE."""
    values = frame.element(kind, variable)
    if values is None or values.ndim == 1:
        return values
    return {"S": mises, "LE": largest_principal}.get(variable, lambda v: np.linalg.norm(v, axis=1))(values.astype(float))


def shade(normals):
    return 0.52 + 0.48 * np.abs(normals @ LIGHT)


def facets(results, frame, variable):
    """Deformed exterior facets: corners (n, 4, 3), value, unit normals. Facets without the variable have NaN."""
    displacement = frame.node("U")
    position = results.coordinates + (0.0 if displacement is None else displacement)
    corners, values = [], []
    for kind, rows, nodes in results.exterior_faces():
        nodes = nodes if nodes.shape[1] == 4 else np.concatenate([nodes, nodes[:, -1:]], axis=1)
        corners.append(position[nodes])
        if variable == "U":
            values.append(np.linalg.norm(displacement[nodes].mean(axis=1), axis=1))
            continue
        of_elements = element_values(frame, kind, variable)
        values.append(np.full(len(rows), np.nan) if of_elements is None else of_elements[rows])
    corners, values = np.concatenate(corners), np.concatenate(values)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    return corners, values, normals


def road_strips(surface, moved, centre, reach, half_width):
    """Facets of the extruded profile around the wheel, `reach` to each side, with a body below it in the side view."""
    profile = surface.profile + np.array([moved @ surface.axes[0], moved @ surface.axes[1]])
    middle = (centre - surface.origin) @ surface.axes[0]
    pieces = []
    for start, end in zip(profile[:-1], profile[1:]):  # short pieces, so that they sort by depth and end at the reach
        count = max(1, int(np.ceil(np.linalg.norm(end - start) / 12.0)))
        pieces.append(start + np.linspace(0.0, 1.0, count, endpoint=False)[:, None] * (end - start))
    fine = np.concatenate(pieces + [profile[-1:]])
    line = surface.points(fine[np.abs(fine[:, 0] - middle) <= reach])
    left, right = line - half_width * surface.axes[2], line + half_width * surface.axes[2]
    return np.stack([left[:-1], left[1:], right[1:], right[:-1]], axis=1), line


def draw(axes, results, frame, view, variable, scale, surface=None, road_moved=None, reach=330.0):
    """Draws the tyre and the road at a frame; returns what a colour bar needs."""
    corners, values, normals = facets(results, frame, variable)
    centre = np.array([0.0, 0.0, 0.0])
    half_width = 1.25 * np.abs(corners[:, :, 1]).max()
    if surface is not None:
        strips, line = road_strips(surface, road_moved, centre, reach, half_width)
        normal = np.cross(strips[:, 1] - strips[:, 0], strips[:, 3] - strips[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        order = np.argsort(view.depth(strips.mean(axis=1)))
        grey = (0.55 + 0.4 * np.abs(normal @ LIGHT))[order, None] * np.array([0.78, 0.78, 0.80])
        axes.add_collection(PolyCollection(view.project(strips)[order],
                                           facecolors=np.clip(grey, 0, 1), edgecolors="face", linewidths=0.4))
        if abs(view.toward @ surface.axes[2]) > 0.99:
            outline = view.project(line)
            floor = outline[:, 1].min() - 30.0
            axes.fill_between(outline[:, 0], outline[:, 1], floor, color="#b9b9bd", linewidth=0)
            axes.plot(outline[:, 0], outline[:, 1], color="#55555a", linewidth=1.2)
    colours = plt.get_cmap("viridis")(scale(np.nan_to_num(values, nan=scale.vmin)))
    colours[np.isnan(values), :3] = 0.35
    colours[:, :3] *= shade(normals)[:, None]
    order = np.argsort(view.depth(corners.mean(axis=1)))
    axes.add_collection(PolyCollection(view.project(corners)[order], facecolors=colours[order],
                                       edgecolors=np.clip(0.72 * colours[order], 0, 1), linewidths=0.15))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")


def colour_scale(results, frames, variable):
    """From 0 to what 99.5 % of the facets stay below."""
    seen = [values[np.isfinite(values)] for values in (facets(results, frame, variable)[1] for frame in frames)]
    seen = np.concatenate(seen)
    return Normalize(0.0, float(np.percentile(seen, 99.5)) if len(seen) and seen.max() > 0 else 1.0)


def colour_bar(figure, axes, scale, label):
    mappable = plt.cm.ScalarMappable(norm=scale, cmap="viridis")
    bar = figure.colorbar(mappable, ax=axes, shrink=0.6, pad=0.02)
    bar.set_label(label)
