"""Pictures of a car's deck: shells from the side, from above, from the front and in three-quarter view, a colour for each gauge's kind.

usage: car_picture.py DECK PICTURE.png [FIRST_PART ...]      parts: only those whose names begin so
"""

import sys

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

from tyre_picture import LIGHT, View

COLOURS = {"MILD": (0.62, 0.70, 0.80), "STRUCTURAL": (0.80, 0.66, 0.42), "HIGH_STRENGTH": (0.80, 0.32, 0.28), "GLASS": (0.72, 0.86, 0.88)}
OTHER = (0.35, 0.35, 0.37)
VIEWS = {"side": View((0.0, -1.0, 0.0)), "above": View((0.0, 0.0, 1.0), up=(0.0, 1.0, 0.0)), "front": View((1.0, 0.0, 0.0)),
         "from the front": View((0.85, -1.0, 0.55)), "from behind": View((-0.9, -1.0, 0.5)), "from below": View((0.6, -0.8, -0.9))}


def read_deck(path):
    """Nodes by id, and the quadrilaterals and triangles of each element set with its material."""
    nodes, parts, materials = {}, {}, {}
    keyword, options = "", {}
    for line in open(path):
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            words = [word.strip() for word in line[1:].strip().split(",")]
            keyword, options = words[0].upper(), dict(w.upper().split("=", 1) for w in words[1:] if "=" in w)
            if keyword == "SHELL SECTION":
                materials[options["ELSET"]] = options["MATERIAL"]
            continue
        if keyword == "NODE":
            fields = line.split(",")
            nodes[int(fields[0])] = [float(x) for x in fields[1:4]]
        elif keyword == "ELEMENT" and options.get("TYPE", "").startswith(("S4", "S3", "M3D4", "R3D4")):
            corners = [int(x) for x in line.split(",")[1:]]
            parts.setdefault(options.get("ELSET", "TYRES"), []).append((corners + corners[-1:])[:4])
    return nodes, parts, materials


def facets(nodes, parts, materials, wanted):
    """Corners (n, 4, 3) and colours (n, 3)."""
    corners, colours = [], []
    for part, elements in parts.items():
        if wanted and not part.startswith(tuple(wanted)):
            continue
        corners.append(np.array([[nodes[n] for n in element] for element in elements]))
        colours.append(np.tile(COLOURS.get(materials.get(part, ""), OTHER), (len(elements), 1)))
    return np.concatenate(corners), np.concatenate(colours)


def draw(axes, view, corners, colours):
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    shaded = colours * (0.5 + 0.5 * np.abs(normals @ LIGHT))[:, None]
    order = np.argsort(view.depth(corners.mean(axis=1)))
    axes.add_collection(PolyCollection(view.project(corners)[order], facecolors=shaded[order], edgecolors=np.clip(0.8 * shaded[order], 0, 1), linewidths=0.15))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")


def main():
    corners, colours = facets(*read_deck(sys.argv[1]), sys.argv[3:])
    figure, axes = plt.subplots(3, 2, figsize=(16, 15), constrained_layout=True)
    for axis, (name, view) in zip(axes.flat, VIEWS.items()):
        draw(axis, view, corners, colours)
        axis.set_title(name)
    figure.savefig(sys.argv[2], dpi=90)


if __name__ == "__main__":
    main()
