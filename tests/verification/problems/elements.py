"""What holds for every element: patch tests, rigid rotation, zero modes, and the way between statics and dynamics."""
import math
import re

import numpy as np
from meshes import BEAMS, FIELDS, MEMBRANES, SHELLS, SOLIDS, block, elastic, line, sheet

KINDS = SOLIDS + MEMBRANES + SHELLS + BEAMS + ("T3D2",)
MATERIAL = elastic(1e6, 0.25, 1000.0)

# Six rigid motions; nothing but stress resists the warping of a flat M3D4; a bar does not feel that it turns about itself.
EXPECTED_ZERO_MODES = {"M3D4": 7, "T3D2": 5}


def with_section(mesh, thickness, material=MATERIAL):
    if mesh.kind in BEAMS:
        mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n0.2, 0.1\n0., 1., 0.\n*MATERIAL, NAME=M\n" + material)
    elif mesh.kind == "T3D2":
        mesh.add("*SOLID SECTION, ELSET=ALL, MATERIAL=M\n0.1\n*MATERIAL, NAME=M\n" + material)
    else:
        mesh.section(thickness, material)
    return mesh


def irregular(kind):
    """A square or cube of 3 elements a side whose inner nodes are moved, or three uneven elements along a line."""
    moves = np.random.default_rng(7).uniform(-0.08, 0.08, (64, 3))
    if kind in SOLIDS:
        mesh = block(kind, (3, 3, 3), lambda r, s, t: (r, s, t))
    elif kind in BEAMS + ("T3D2",):
        mesh = line(kind, 3, lambda r: (r * r, 0.0, 0.0))
    else:
        mesh = sheet(kind, (3, 3), lambda r, s: (r, s, 0.0), 0.1)
    axes = {3: (0, 1, 2)}.get(3 if kind in SOLIDS else 2, (0, 1)) if kind not in BEAMS + ("T3D2",) else (0,)
    inner = [n for n, p in mesh.parameters.items() if all(0.1 < p[a] < 0.9 for a in axes)]
    if kind not in BEAMS + ("T3D2",):
        for n in inner:
            mesh.nodes[n] = tuple(np.array(mesh.nodes[n]) + moves[n % 64] * [a in axes for a in range(3)])
    return with_section(mesh, 0.1), inner


def prescribed(mesh, nodes, motion):
    """*BOUNDARY lines of motion(x) = (u1 u2 u3 r1 r2 r3) at nodes."""
    return "".join("%d, %d, %d, %.17g\n" % (n, dof + 1, dof + 1, value) for n in nodes
                   for dof, value in enumerate(motion(np.array(mesh.nodes[n]))) if dof < 3 or mesh.turning)


def patch(session, kind, motion, name):
    """Largest distance of the inner nodes from the motion that the outer ones are given, over the largest displacement."""
    mesh, inner = irregular(kind)
    outer = [n for n in mesh.nodes if n not in inner]
    mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n" + prescribed(mesh, outer, motion))
    if kind in MEMBRANES:
        mesh.add("".join("%d, 3\n" % n for n in inner))
    if kind == "T3D2":
        mesh.add("".join("%d, 2, 3\n" % n for n in inner))
    mesh.add(FIELDS + "*END STEP")
    results = session.run("patch_%s_%s" % (name, kind), mesh)
    expected = {n: np.array(motion(np.array(x))[:3]) for n, x in mesh.nodes.items()}
    return max(np.abs(results.at(n, "U") - expected[n]).max() for n in inner) / max(np.abs(u).max() for u in expected.values())


def stretched(x):
    plane = 1e-3 * np.array([[1.0, 0.5, 0.2], [0.5, 1.0, -0.3], [0.2, -0.3, -0.6]])
    return (*(plane @ x), 0.0, 0.0, 0.0)


def in_plane(x):
    return (1e-3 * (x[0] + 0.5 * x[1]), 1e-3 * (x[1] + 0.5 * x[0]), 0.0, 0.0, 0.0, 0.0)


def along(x):
    return (1e-3 * x[0], 0.0, 0.0, 0.0, 0.0, 0.0)


def bent(x):
    """Constant curvatures of a plate, w = k (x^2 + x y + y^2) / 2."""
    k = 1e-3
    return (0.0, 0.0, 0.5 * k * (x[0] ** 2 + x[0] * x[1] + x[1] ** 2), k * (0.5 * x[0] + x[1]), -k * (x[0] + 0.5 * x[1]), 0.0)


def bowed(x):
    """Constant curvature of a beam along x."""
    return (0.0, 0.0, 0.5e-3 * x[0] ** 2, 0.0, -1e-3 * x[0], 0.0)


def rotation(session, kind):
    """All nodes turn by 120 degrees about a slanted axis in one increment: largest stress over Young's modulus."""
    mesh, _ = irregular(kind)
    axis, turned = np.array([2.0, 1.0, -2.0]) / 3.0, math.radians(120.0)
    skew = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    change = math.sin(turned) * skew + (1.0 - math.cos(turned)) * skew @ skew
    mesh.add("*STEP, NLGEOM\n*STATIC, DIRECT\n1., 1.\n*BOUNDARY\n")
    mesh.add(prescribed(mesh, mesh.nodes, lambda x: (*(change @ x), *(turned * axis))) + FIELDS + "*END STEP")
    return np.abs(session.run("rotation_%s" % kind, mesh).element(kind, "S")).max() / 1e6


def single(kind):
    """One element, skewed."""
    skew = lambda r, s, t: (1.1 * r + 0.2 * s, 0.9 * s + 0.1 * r * s, 0.8 * t + 0.1 * r * t)
    if kind in SOLIDS:
        mesh = block(kind, (1, 1, 1), skew)
    elif kind in BEAMS + ("T3D2",):
        mesh = line(kind, 1, lambda r: (r, 0.3 * r, 0.2 * r))
    else:
        mesh = sheet(kind, (1, 1), lambda r, s: skew(r, s, 0.0), 0.1)
    mesh.elements[kind] = mesh.elements[kind][:1]
    used = set(mesh.elements[kind][0][1])
    mesh.nodes = {n: x for n, x in mesh.nodes.items() if n in used}
    return with_section(mesh, 0.1)


def zero_modes(session, kind):
    """Vanishing eigenvalues of the stiffness of one element, column by column from the reactions to unit motions."""
    dofs = 6 if kind in SHELLS + BEAMS else 3
    mesh = single(kind)
    held = "".join("%d, 1, %d\n" % (n, dofs) for n in mesh.nodes)
    fields = FIELDS.replace("U, RF", "U, RF, RM") if dofs == 6 else FIELDS
    for n in mesh.nodes:
        for dof in range(1, dofs + 1):
            mesh.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY, OP=NEW\n%s%d, %d, %d, 1e-6\n%s*END STEP" % (held, n, dof, dof, fields))
    results = session.run("zero_modes_%s" % kind, mesh)
    rows = []
    for step in range(1, 1 + dofs * len(mesh.nodes)):
        forces = [results.node("RF", step)] + ([results.node("RM", step)] if dofs == 6 else [])
        rows.append(np.hstack(forces).ravel())
    values = np.abs(np.linalg.eigvals(np.array(rows)))
    return int(np.sum(values < 1e-8 * values.max()))  # the weakest stiffness, that of drilling, is 1e-5 of the greatest


def element_row(session, kind):
    """The row of one element in the table."""
    flat = kind not in SOLIDS
    stretch = along if kind in BEAMS + ("T3D2",) else in_plane if flat else stretched
    first = patch(session, kind, stretch, "stretched")
    bending = patch(session, kind, bent if kind in SHELLS else bowed, "bent") if kind in SHELLS + BEAMS else None
    return [first, bending, rotation(session, kind), zero_modes(session, kind), EXPECTED_ZERO_MODES.get(kind, 6)]


LAWS = {
    "elastic": MATERIAL,
    "neo-Hooke": "*HYPERELASTIC, NEO HOOKE\n2e5, 1e-6\n*DENSITY\n1000.",
    "Mooney-Rivlin": "*HYPERELASTIC, MOONEY-RIVLIN\n1.5e5, 0.5e5, 1e-6\n*DENSITY\n1000.",
    "Yeoh": "*HYPERELASTIC, YEOH\n2e5, -1e3, 1e2, 1e-6\n*DENSITY\n1000.",
    "Ogden": "*HYPERELASTIC, OGDEN, N=1\n4e5, 2.5, 1e-6\n*DENSITY\n1000.",
    "plastic": MATERIAL + "\n*PLASTIC\n1e4, 0.\n3e4, 1.",
    "Prony": MATERIAL + "\n*VISCOELASTIC, TIME=PRONY\n0.3, 0., 0.1",
}


def loaded(kind, material):
    """A block or bar held at one end with a force on the other, or a sheet held and stretched at its edges under a pressure."""
    if kind in SOLIDS + BEAMS:
        bar = lambda r, s, t: (1.5 * r, s, t)
        mesh = block(kind, (3, 2, 2), bar) if kind in SOLIDS else line(kind, 6, lambda r: bar(r, 0.0, 0.0))
        with_section(mesh, 0.1, material)
        held = mesh.hold(mesh.at(r=0.0), range(1, 7))
        return mesh, held, lambda share: "*CLOAD\n" + mesh.share(mesh.at(r=1.0), 3, share * (4e3 if kind in SOLIDS else 5.0))
    if kind == "T3D2":
        mesh = with_section(line(kind, 4, lambda r: (r, 0.0, 0.0)), 0.1, material)
        held = mesh.hold(mesh.at(), (2, 3)) + mesh.hold(mesh.at(r=0.0), (1,))
        return mesh, held, lambda share: "*CLOAD\n" + mesh.share(mesh.at(r=1.0), 1, 1e3 * share)
    mesh = with_section(sheet(kind, (4, 4), lambda r, s: (r, s, 0.0), 0.05), 0.05, material)
    mesh.add("*SURFACE, NAME=FACE, TYPE=ELEMENT\nALL, SPOS")
    rim = [n for n, p in mesh.parameters.items() if not (0.1 < p[0] < 0.9 and 0.1 < p[1] < 0.9)]
    held = mesh.hold(rim, (3,))
    held += "".join("%d, %d, %d, %.17g\n" % (n, dof, dof, 0.02 * mesh.nodes[n][dof - 1]) for n in rim for dof in (1, 2))
    return mesh, held, lambda share: "*DSLOAD\nFACE, P, %.17g\n" % (500.0 * share)


def import_row(session, kind, law):
    """Out-of-balance force when the dynamic step starts, greatest motion during it over the static one, and Newton's iterations
    after a dynamic step in which the load grew by a tenth."""
    mesh, held, load = loaded(kind, LAWS[law] + "\n*DAMPING, ALPHA=30.")
    statics = "*STEP, NLGEOM, INC=200\n*STATIC\n0.25, 1.\n"
    dynamics = "*STEP\n*DYNAMIC, EXPLICIT\n, %g\n"
    fields = "*OUTPUT, FIELD, NUMBER INTERVAL=%d, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n"
    mesh.add("*AMPLITUDE, NAME=GROW, DEFINITION=SMOOTH STEP\n0., 1., 0.5, 1.1, 1., 1.1")
    mesh.add(statics + "*BOUNDARY\n" + held + load(1.0) + FIELDS + "*END STEP\n" + dynamics % 0.2 + fields % 20 + "*END STEP")
    growing = load(1.0).replace("*CLOAD", "*CLOAD, AMPLITUDE=GROW").replace("*DSLOAD", "*DSLOAD, AMPLITUDE=GROW")
    mesh.add(dynamics % 1.0 + growing + fields % 1 + "*END STEP\n" + statics.replace("0.25", "1.") + load(1.1) + FIELDS + "*END STEP")
    results = session.run("import_%s_%s" % (kind, law), mesh)
    imbalance = float(re.search(r"starts with .*?= ([0-9.e+-]+)", results.log)[1])
    at_rest = results.node("U", 1)
    moved = max(np.abs(frame["node/U"][:] - at_rest).max() for frame in results.frames(2)) / np.abs(at_rest).max()
    iterations = [int(found) for found in re.findall(r"increment \d+: .*?(\d+) iterations", results.log)][-1]
    return [imbalance, moved, iterations]
