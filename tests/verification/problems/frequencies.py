"""NAFEMS free-vibration problems of beams, plates and membranes."""
import math

import numpy as np
from meshes import SHELLS, SOLIDS, Mesh, angle, block, elastic, sheet
from verification import problem

STEEL = elastic(200e9, 0.3, 8000.0)


def modes(session, name, mesh, count, held, wanted=lambda shape: True):
    """The elastic frequencies, those of rigid motions left out; of the modes whose displacements are `wanted`."""
    mesh.add("*STEP\n*FREQUENCY\n%d\n*BOUNDARY\n%s*END STEP" % (count, held))
    results = session.run(name, mesh)
    step = results.file["step_1"]
    found = sorted(float(step[m].attrs["frequency"]) for m in step if m.startswith("mode_") and wanted(step[m]["node/U"][:]))
    return [f for f in found if f > 1e-3]


def listed(targets, first, tolerance):
    return {"f%d, Hz" % (first + i): (value, tolerance) for i, value in enumerate(targets)}


@problem("FV2", "double cross of 8 arms of length 5, 0.125 x 0.125, ends pinned, in its plane", "NAFEMS FV2",
         {"f1, Hz": (11.336, 0.01), "f2, Hz": (17.709, 0.01), "f4, Hz": (17.709, 0.01), "f8, Hz": (17.709, 0.01), "f9, Hz": (45.345, 0.01)},
         {"B31": (4, 8)}, lambda n: "%d an arm" % n)
def double_cross(session, kind, n):
    mesh = Mesh(kind)
    hub, ends = mesh.node((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), []
    for arm in range(8):
        turned, last = 0.25 * math.pi * arm, hub
        for i in range(1, n + 1):
            x = 5.0 * i / n
            number = mesh.node((x * math.cos(turned), x * math.sin(turned), 0.0), (arm, i / n, 0.0))
            mesh.element([last, number])
            last = number
        ends.append(last)
    mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n0.125, 0.125\n0., 0., 1.\n*MATERIAL, NAME=M\n" + STEEL)
    found = modes(session, "fv2_%d" % n, mesh, 9, mesh.hold(mesh.at(), (3, 4, 5)) + mesh.hold(ends, (1, 2)))
    return {"f%d, Hz" % i: found[i - 1] for i in (1, 2, 4, 8, 9)}


@problem("FV12", "free square plate 10 x 10 x 0.05", "NAFEMS FV12; thin plates, converged, f7 to f9: 4.190, 4.190, 7.356",
         listed((1.622, 2.360, 2.922, 4.233, 4.233, 7.416), 4, 0.02),
         {kind: (16, 32) for kind in ("C3D8R", *SHELLS)}, lambda n: "%d x %d" % (n, n))
def free_plate(session, kind, n):
    mesh = sheet(kind, (n, n), lambda r, s: (10.0 * r, 10.0 * s, 0.0), 0.05)
    mesh.section(0.05, STEEL)
    held = "" if kind in SOLIDS else mesh.hold(mesh.at(), (1, 2, 6))
    found = modes(session, "fv12_%s_%d" % (kind, n), mesh, 12, held)
    return {"f%d, Hz" % (4 + i): found[i] for i in range(6)}


@problem("FV16", "cantilevered square plate 10 x 10 x 0.05", "NAFEMS FV16; Altair OS-V 0430",
         listed((0.421, 1.029, 2.582, 3.306, 3.753, 6.555), 1, 0.02), {kind: (16, 32) for kind in ("C3D8R", *SHELLS)},
         lambda n: "%d x %d" % (n, n))
def cantilevered_plate(session, kind, n):
    mesh = sheet(kind, (n, n), lambda r, s: (10.0 * r, 10.0 * s, 0.0), 0.05)
    mesh.section(0.05, STEEL)
    found = modes(session, "fv16_%s_%d" % (kind, n), mesh, 6, mesh.hold(mesh.at(r=0.0), range(1, 7)))
    return {"f%d, Hz" % (1 + i): found[i] for i in range(6)}


@problem("FV32", "cantilevered tapered membrane, length 10, height 5 to 1, t 0.05, in its plane", "NAFEMS FV32; Abaqus Benchmarks 4.4.6",
         listed((44.623, 130.03, 162.70, 246.05, 379.90, 391.44), 1, 0.01),
         {kind: (16, 32) for kind in ("C3D8R", "C3D8", "M3D4", "M3D4R", "S4", "S4R", "S3R")}, lambda n: "%d x %d" % (n, n // 2))
def tapered_membrane(session, kind, n):
    mesh = sheet(kind, (n, n // 2), lambda r, s: (10.0 * r, (s - 0.5) * (5.0 - 4.0 * r), 0.0), 0.05)
    mesh.section(0.05, STEEL)
    in_plane = mesh.hold(mesh.at(t=0.0), (3,)) if kind in SOLIDS else mesh.hold(mesh.at(), (3, 4, 5))
    found = modes(session, "fv32_%s_%d" % (kind, n), mesh, 6, in_plane + mesh.hold(mesh.at(r=0.0), (1, 2, 6)))
    return {"f%d, Hz" % (1 + i): found[i] for i in range(6)}


@problem("FV41", "free cylinder, middle radius 2, t 0.4, L 10: axisymmetric modes by a sector of 5 degrees",
         "NAFEMS FV41; Altair OS-V 0450",
         listed((243.53, 377.41, 394.11, 397.72, 405.28), 2, 0.01), {kind: (3, 6) for kind in ("C3D8", "C3D8R")},
         lambda n: "%d x %d" % (n, 10 * n))
def free_cylinder(session, kind, n):
    def place(r, s, t):
        radius, turned = 1.8 + 0.4 * r, angle(5.0) * (s - 0.5)
        return radius * math.cos(turned), radius * math.sin(turned), 10.0 * t

    mesh = block(kind, (n, 1, 10 * n), place)
    mesh.section(1.0, STEEL)
    mesh.sets["EVERY"] = list(mesh.nodes)
    mesh.add("*TRANSFORM, NSET=EVERY, TYPE=C\n0., 0., 0., 0., 0., 1.")
    found = modes(session, "fv41_%s_%d" % (kind, n), mesh, 7, "EVERY, 2\n")
    return {"f%d, Hz" % (2 + i): found[i] for i in range(5)}


@problem("FV42", "thick hollow sphere 1.8 to 6: radial modes by a sector of 5 degrees", "NAFEMS FV42",
         listed((369.91, 838.03, 1451.2, 2117.0, 2795.8), 1, 0.01), {kind: (16, 32) for kind in ("C3D8", "C3D8R")}, str)
def hollow_sphere(session, kind, n):
    """Nodes move along their radii only: faces of the sector are those of a pyramid whose edges are rays. Of the modes those in which
    the four rays move alike: in the others, from 1600 Hz on, they shear against each other, which no sphere does by radial motion."""
    def place(r, s, t):
        ray = np.array([1.0, math.tan(angle(5.0) * (s - 0.5)), math.tan(angle(5.0) * (t - 0.5))])
        return tuple((1.8 + 4.2 * r) * ray / np.linalg.norm(ray))

    mesh, held = block(kind, (n, 1, 1), place), ""
    mesh.section(1.0, STEEL)
    for name, s, t in (("A", 0.0, 0.0), ("B", 1.0, 0.0), ("C", 0.0, 1.0), ("D", 1.0, 1.0)):
        ray = place(1.0, s, t)
        mesh.sets[name] = mesh.at(s=s, t=t)
        mesh.add("*TRANSFORM, NSET=%s, TYPE=R\n%.17g, %.17g, %.17g, %.17g, %.17g, 0." % (name, *ray, -ray[1], ray[0]))
        held += "%s, 2, 3\n" % name
    places = np.array([mesh.nodes[m] for m in sorted(mesh.nodes)])
    outward = places / np.linalg.norm(places, axis=1)[:, None]
    alike = lambda shape: np.ptp(np.sum(shape * outward, axis=1).reshape(4, n + 1), axis=0).max() < 1e-3  # nodes run along rays
    found = modes(session, "fv42_%s_%d" % (kind, n), mesh, 40, held, alike)
    return {"f%d, Hz" % (1 + i): found[i] for i in range(5)}
