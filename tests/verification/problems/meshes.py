"""Meshes of the verification problems: lines, sheets and blocks mapped from parameters, for any element that can fill them."""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from static_model import Deck  # noqa: E402

SHELLS = ("S4", "S4R", "S3R")
MEMBRANES = ("M3D4", "M3D4R", "M3D3")
BEAMS = ("B31",)
SOLIDS = ("C3D8", "C3D8R", "C3D6")
TURNING = SHELLS + BEAMS  # their nodes rotate

# Output at the end of each static increment.
FIELDS = "*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*ELEMENT OUTPUT\nS\n"


class Mesh(Deck):
    """A deck that knows the parameters (r, s, t) of its nodes, each from 0 to 1; t runs through the thickness."""

    def __init__(self, kind):
        super().__init__()
        self.kind = kind
        self.parameters = {}
        self.centres = []  # parameters of the middles of elements

    @property
    def turning(self):
        return self.kind in TURNING

    def node(self, place, parameters):
        number = len(self.nodes) + 1
        self.add_node(number, *place)
        self.parameters[number] = parameters
        return number

    def element(self, nodes):
        rows = self.elements.setdefault(self.kind, [])
        rows.append((len(rows) + 1, nodes))
        self.centres.append(np.mean([self.parameters[n] for n in nodes], axis=0))

    def at(self, r=None, s=None, t=None):
        """Nodes at these parameters; None: at any."""
        wanted = (r, s, t)
        return [n for n, p in self.parameters.items() if all(w is None or abs(w - v) < 1e-9 for w, v in zip(wanted, p))]

    def hold(self, nodes, dofs):
        """*BOUNDARY lines: zero at each of `dofs` that the nodes have."""
        has = [dof for dof in dofs if dof <= 3 or self.turning]
        return "\n".join("%d, %d" % (n, dof) for n in nodes for dof in has) + "\n"

    def share(self, nodes, dof, total):
        """*CLOAD lines: `total` spread over an edge or an end face as an even traction would, whatever the spacing."""
        weights = np.ones(len(nodes))
        for axis in range(3):
            values = np.array([self.parameters[n][axis] for n in nodes])
            levels = np.unique(np.round(values, 9))
            if len(levels) > 1:
                reach = np.concatenate([[levels[0]], 0.5 * (levels[1:] + levels[:-1]), [levels[-1]]])
                weights *= np.diff(reach)[np.searchsorted(levels, np.round(values, 9))]
        weights /= weights.sum()
        return "".join("%d, %d, %.17g\n" % (n, dof, total * w) for n, w in zip(nodes, weights))

    def section(self, thickness, material, orientation="", layers=""):
        """Section and material of a sheet of any kind; `layers` are the data lines of a composite."""
        named = "ELSET=ALL, MATERIAL=M" if not layers else "ELSET=ALL, COMPOSITE"
        data = layers or "%.17g" % thickness
        if self.kind in SOLIDS:
            self.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M" + orientation)
        else:
            keyword = "*SHELL SECTION" if self.kind in SHELLS else "*MEMBRANE SECTION"
            self.add("%s, %s%s\n%s" % (keyword, named, orientation, data))
        self.add("*MATERIAL, NAME=M\n" + material)


def elastic(young, poisson, density=None):
    return "*ELASTIC\n%.17g, %.17g" % (young, poisson) + ("" if density is None else "\n*DENSITY\n%.17g" % density)


def line(kind, count, place):
    """Two-node elements along place(r)."""
    mesh = Mesh(kind)
    numbers = [mesh.node(place(i / count), (i / count, 0.5, 0.5)) for i in range(count + 1)]
    for i in range(count):
        mesh.element(numbers[i:i + 2])
    return mesh


def block(kind, counts, place, spread=None):
    """Bricks or wedges filling place(r, s, t); `spread` moves parameters for a distorted mesh."""
    mesh = Mesh(kind)
    nr, ns, nt = counts
    numbers = {}
    for k in range(nt + 1):
        for j in range(ns + 1):
            for i in range(nr + 1):
                p = (i / nr, j / ns, k / nt)
                q = spread(*p) if spread else p
                numbers[i, j, k] = mesh.node(place(*q), p)
    for k in range(nt):
        for j in range(ns):
            for i in range(nr):
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                for face in [ring] if kind != "C3D6" else halves(ring, i + j):
                    mesh.element([numbers[a, b, k] for a, b in face] + [numbers[a, b, k + 1] for a, b in face])
    return mesh


def halves(ring, parity):
    """A quadrilateral cut in two, along one diagonal or the other."""
    a, b, c, d = ring
    return ([a, b, c], [a, c, d]) if parity % 2 == 0 else ([a, b, d], [b, c, d])


def patchwork(kind, patches, n, heights=None):
    """Patches of n x n quadrilaterals, each placed by a function of (r, s), joined where their nodes coincide; columns of bricks over
    them where `heights` are given, nodes then being asked for by the parameter t alone."""
    mesh, found = Mesh(kind), {}

    def node(place, t):
        key = tuple(np.round(place, 9))
        if key not in found:
            found[key] = mesh.node(place, (*key[:2], t))
        return found[key]

    levels = [None] if heights is None else list(enumerate(heights))
    for patch in patches:
        for i in range(n):
            for j in range(n):
                ring = [patch(a / n, b / n) for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
                faces = [ring] if kind not in ("M3D3", "S3R", "C3D6") else halves(ring, i + j)
                for face in faces:
                    if heights is None:
                        mesh.element([node(p, 0.0) for p in face])
                        continue
                    for (k, low), (_, high) in zip(levels[:-1], levels[1:]):
                        top = (len(heights) - 1.0)
                        mesh.element([node((*p[:2], low), k / top) for p in face] + [node((*p[:2], high), (k + 1) / top) for p in face])
    return mesh


def quarter_disc(radius):
    """A quarter of a disc as three patches, none of them with a corner flatter than 120 degrees."""
    middle = 0.45 * radius

    def core(r, s):
        return middle * r * (1.0 + 0.15 * (1.0 - s)), middle * s * (1.0 + 0.15 * (1.0 - r)), 0.0

    def rim(first):
        def place(r, s):
            inner = core(1.0, s) if first else core(1.0 - s, 1.0)
            turned = 0.25 * math.pi * (s if first else 1.0 + s)
            outer = (radius * math.cos(turned), radius * math.sin(turned), 0.0)
            return tuple((1.0 - r) * a + r * b for a, b in zip(inner, outer))
        return place

    return core, rim(True), rim(False)


def sheet(kind, counts, place, thickness, spread=None, layers=1):
    """A sheet about the middle surface place(r, s): shells, membranes, or solids in layers along the normals."""
    if kind in SOLIDS:
        normal = lambda r, s: unit_normal(place, r, s)
        solid = lambda r, s, t: tuple(np.array(place(r, s)) + (t - 0.5) * thickness * normal(r, s))
        sideways = (lambda r, s, t: (*spread(r, s), t)) if spread else None
        return block(kind, (*counts, layers), solid, sideways)
    mesh = Mesh(kind)
    nr, ns = counts
    numbers = {}
    for j in range(ns + 1):
        for i in range(nr + 1):
            p = (i / nr, j / ns)
            numbers[i, j] = mesh.node(place(*(spread(*p) if spread else p)), (*p, 0.5))
    for j in range(ns):
        for i in range(nr):
            ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            for face in [ring] if kind not in ("S3R", "M3D3") else halves(ring, i + j):
                mesh.element([numbers[a] for a in face])
    return mesh


def unit_normal(place, r, s):
    """Normal of place(r, s) by one-sided or central differences, whichever stays on the sheet."""
    step = 1e-6
    ends = [(max(v - step, 0.0), min(v + step, 1.0)) for v in (r, s)]
    along = np.array(place(ends[0][1], s)) - np.array(place(ends[0][0], s))
    across = np.array(place(r, ends[1][1])) - np.array(place(r, ends[1][0]))
    n = np.cross(along, across)
    return n / np.linalg.norm(n)


def middle(mesh, results, r, s, step=1, variable="U"):
    """Mean of a nodal vector through the thickness at (r, s)."""
    return np.mean([results.at(n, variable, step) for n in mesh.at(r, s)], axis=0)


def recovered(mesh, values, r, s, t=None):
    """An element value at the parameters (r, s): biquadratic through the nine elements next to it, whose centres are where
    stresses are most accurate (Barlow's points); in the layer of elements nearest to t."""
    centres = np.array(mesh.centres)
    rows = np.arange(len(centres))
    if t is not None:
        rows = rows[np.abs(centres[:, 2] - t) <= np.abs(centres[:, 2] - t).min() + 1e-9]
    for axis, wanted in ((0, r), (1, s)):
        levels = np.unique(np.round(centres[rows, axis], 9))
        near = levels[np.argsort(np.abs(levels - wanted))[:3 if mesh.kind not in ("S3R", "C3D6", "M3D3") else 6]]
        rows = rows[np.abs(centres[rows, axis][:, None] - near[None, :]).min(axis=1) < 1e-6]
    terms = lambda a, b: np.stack([(a - r) ** i * (b - s) ** j for i in range(3) for j in range(3)], axis=-1)
    found = np.linalg.lstsq(terms(centres[rows, 0], centres[rows, 1]), np.asarray(values)[rows], rcond=None)[0]
    return found[0]


def angle(degrees):
    return math.radians(degrees)
