"""Figures of a car's job: the car and its chassis, modes, the road, loads against distance, frames of motion, stress, energy."""

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize

import car_picture
import tyre_picture
from balocco_results import mises, text

WHEELS = ("FRONT_LEFT", "FRONT_RIGHT", "REAR_LEFT", "REAR_RIGHT")
CHASSIS = ("SUBFRAME", "STRUT_HOUSE", "TORSION_BEAM", "FRONT_RAIL", "TYRES")


def words(name):
    return name.lower().replace("_", " ")


def grid(rows, columns, width=10.0, height=3.4):
    figure, axes = plt.subplots(rows, columns, figsize=(width, height * rows), constrained_layout=True, squeeze=False)
    return figure, axes


def car(deck):
    """The car from four sides, and its chassis without the body."""
    nodes, parts, materials = car_picture.read_deck(deck)
    figure, axes = grid(3, 2, height=3.2)
    corners, colours = car_picture.facets(nodes, parts, materials, [])
    for axis, name in zip(axes.flat, ("side", "above", "from the front", "from below")):
        car_picture.draw(axis, car_picture.VIEWS[name], corners, colours)
        axis.set_title(name)
    corners, colours = car_picture.facets(nodes, parts, materials, CHASSIS)
    for axis, name in zip(axes[2], ("from the front", "above")):
        car_picture.draw(axis, car_picture.VIEWS[name], corners, colours)
        axis.set_title(f"chassis, {name}")
    return figure


def deformed(results, displacement, wanted=None):
    """Corners (n, 4, 3) of shells and tyres, and their normals; `wanted`: beginnings of the names of parts."""
    names = part_names(results)
    place, corners = results.coordinates + displacement, []
    for kind, rows, nodes in results.exterior_faces():
        nodes = nodes if nodes.shape[1] == 4 else np.concatenate([nodes, nodes[:, -1:]], axis=1)
        if wanted is not None:
            nodes = nodes[np.array([names[part].startswith(tuple(wanted)) for part in results.parts[kind][rows]], bool)]
        corners.append(place[nodes])
    corners = np.concatenate(corners)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return corners, normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def part_names(results):
    """Name of each part by its number."""
    return {int(number): text(group.attrs["name"]) for number, group in results.file["mesh/part"].items()}


def draw(axis, view, corners, colours, edges=0.1):
    order = np.argsort(view.depth(corners.mean(axis=1)))
    axis.add_collection(PolyCollection(view.project(corners)[order], facecolors=colours[order], edgecolors=(0, 0, 0, 0.25),
                                       linewidths=edges))
    axis.set_aspect("equal")
    axis.autoscale_view()
    axis.axis("off")


def view_of_mode(kind):
    if "lateral" in kind:
        return car_picture.VIEWS["above"]
    sideways = "rolls" in kind or "torsion" in kind or kind.startswith("hop")
    return car_picture.VIEWS["from the front" if sideways else "side"]


def modes(results, found, standing):
    """Shapes of modes: the car at rest as a shadow, the mode before it."""
    figure, axes = grid((len(found) + 2) // 3, 3, height=2.3)
    rest, _ = deformed(results, standing)
    for axis, mode in zip(axes.flat, found):
        shape = mode.group["node/U"][:].astype(float)
        shape *= (250.0 if mode.shares else 120.0) / np.linalg.norm(shape, axis=1).max()  # bodies bend less than wheels hop
        view = view_of_mode(mode.kind)
        draw(axis, view, rest, np.full((len(rest), 4), (0.8, 0.8, 0.8, 0.5)), 0.0)
        corners, normals = deformed(results, standing + shape)
        draw(axis, view, corners, np.outer(tyre_picture.shade(normals), (0.45, 0.58, 0.75)), 0.0)
        axis.set_title(f"{mode.frequency:.2f} Hz, {mode.kind}", fontsize=8)
    for axis in axes.flat[len(found):]:
        axis.axis("off")
    return figure


def road(results):
    """Profiles of both roads, mm, below each other."""
    roads = {name: surface for name, surface in results.surfaces.items() if name.startswith("ROAD_")}  # the others are rims
    figure, axes = grid(len(roads), 1, height=1.5)
    for axis, (name, surface) in zip(axes.flat, roads.items()):
        along, height = surface.profile.T
        bottom = min(height.min(), 0.0) - 60.0
        axis.fill_between(along, height, bottom, color="0.55")
        axis.set(title=words(name), ylim=(bottom, 160.0), ylabel="mm")
        if len(along) > 2:
            axis.set_xlim(along[1] - 400.0, along[-2] + 400.0)
    axes.flat[-1].set_xlabel("ahead of the front axle where the drive starts, mm")
    return figure


def against_distance(columns, distances, names, quantities, unit, label):
    """One panel a quantity; one line a name. distances: {name: (n)}, in thousandths of what the label says."""
    figure, axes = grid(len(quantities), 1, height=2.6)
    for axis, quantity in zip(axes.flat, quantities):
        for name in names:
            axis.plot(distances[name] / 1e3, columns[f"{name}_{quantity}"], linewidth=0.9, label=words(name))
        axis.set_ylabel(f"{quantity}, {unit}")
        axis.grid(alpha=0.25)
        axis.legend(fontsize=7)
    axes.flat[-1].set_xlabel(label)
    return figure


def motion(results, step, times, roads):
    """Frames nearest to the times, from the side, with the road as it has run."""
    frames = [min(step.frames, key=lambda frame: abs(frame.step_time - time)) for time in times]
    figure, axes = grid((len(frames) + 1) // 2, 2, height=2.4)
    view = car_picture.VIEWS["side"]
    surface = results.surfaces["ROAD_LEFT_SURFACE"]
    for axis, frame in zip(axes.flat, frames):
        corners, normals = deformed(results, frame.node("U").astype(float))
        moved = frame.node("U")[roads[0]].astype(float)
        line = view.project(surface.points(surface.profile) + moved)
        axis.fill_between(line[:, 0], line[:, 1], line[:, 1].min() - 250.0, color="0.6", zorder=0)
        draw(axis, view, corners, np.outer(tyre_picture.shade(normals), (0.62, 0.68, 0.76)), 0.05)
        seen = view.project(corners.reshape(-1, 3))
        axis.set_xlim(seen[:, 0].min() - 150.0, seen[:, 0].max() + 150.0)
        axis.set_ylim(line[:, 1].min() - 100.0, seen[:, 1].max() + 80.0)
        axis.set_title(f"{frame.step_time:.0f} ms", fontsize=9)
    return figure


def stress_of(results, frame, wanted):
    """Corners, Mises stress and plastic strain (of the worse face) of shells whose parts begin so; None without them."""
    names = part_names(results)
    if "S4R" not in results.connectivity or frame.element("S4R", "S_TOP") is None:
        return None
    chosen = np.array([names[part].startswith(tuple(wanted)) for part in results.parts["S4R"]])
    if not chosen.any():
        return None
    worse = lambda variable, measure: np.maximum(*(measure(frame.element("S4R", f"{variable}_{face}")[chosen].astype(float))
                                                   for face in ("TOP", "BOT")))
    place = results.coordinates + frame.node("U")
    return place[results.connectivity["S4R"][chosen]], worse("S", mises), worse("PEEQ", lambda values: values)


def contours(results, frame, groups):
    """Mises stress and plastic strain of each group of parts: {title: beginnings of names}."""
    figure, axes = grid(len(groups), 2, height=3.6)
    view = car_picture.VIEWS["from the front"]
    for row, (title, wanted) in zip(axes, groups.items()):
        corners, stress, strain = stress_of(results, frame, wanted)
        for axis, values, name in ((row[0], stress, "Mises stress, MPa"), (row[1], strain, "equivalent plastic strain")):
            norm = Normalize(0.0, max(values.max(), 1e-3))
            draw(axis, view, corners, plt.get_cmap("turbo")(norm(values)))
            axis.set_title(f"{title}: {name}, at most {values.max():.3g}", fontsize=8)
            figure.colorbar(ScalarMappable(norm, "turbo"), ax=axis, shrink=0.8)
    return figure


def energy(history):
    """Energies by kind, and how far their sum strays, in parts of the largest that moved."""
    figure, axes = grid(1, 2, height=3.0)
    time = history["time"]
    for name in ("ALLKE", "ALLIE", "ALLWK"):
        axes[0, 0].plot(time, (history[name] - history[name][0]) / 1e3, label=f"{name} less its start")
    axes[0, 0].set(xlabel="ms", ylabel="J")
    axes[0, 0].legend(fontsize=8)
    axes[0, 1].plot(time, (history["ETOTAL"] - history["ETOTAL"][0]) / 1e3)
    axes[0, 1].set(xlabel="ms", ylabel="J", title="ETOTAL less its start")
    for axis in axes.flat:
        axis.grid(alpha=0.25)
    return figure


def energies_of_parts(parts, time, springs):
    """Energies of parts, and work on springs, less their start, J. parts: {kind: {name: rows of time and energy}}."""
    figure, axes = grid(1, 3, height=3.2)
    for axis, (kind, title) in zip(axes.flat, (("internal", "elastic"), ("kinetic", "kinetic"))):
        for name, rows in parts[kind].items():
            axis.plot(rows[:, 0], (rows[:, 1] - rows[0, 1]) / 1e3, label=name)
        axis.set_title(title, fontsize=9)
    for name, done in springs.items():
        axes[0, 2].plot(time, done / 1e3, label=name)
    axes[0, 2].set_title("done on springs and dampers", fontsize=9)
    for axis in axes.flat:
        axis.set(xlabel="ms", ylabel="J")
        axis.grid(alpha=0.25)
        axis.legend(fontsize=7)
    return figure
