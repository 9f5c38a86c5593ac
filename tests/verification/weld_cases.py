#!/usr/bin/env python3
"""Welded sheets against closed forms and against sheets that share their nodes: weld_cases.py CASE BALOCCO FOLDER."""
import numpy as np

from job import check, check_energy, run_case
from motion_decks import explicit_step, history, integrate

YOUNG, POISSON, THICKNESS = 210e3, 0.3, 1.0
LENGTH, SLICES = 600.0, 30
HALF_WIDTH, HEIGHT, FLANGE = 30.0, 50.0, 15.0


def line(*points):
    """A polyline through (y, z, divisions up to there)."""
    nodes = [points[0][:2]]
    for (y, z, _), (to_y, to_z, n) in zip(points, points[1:]):
        nodes += [(y + (to_y - y) * i / n, z + (to_z - z) * i / n) for i in range(1, n + 1)]
    return nodes


def beam_deck(gap, pitch):
    """A hat section closed by a plate: `gap` below its flanges and welded to them every `pitch`, or, without a
    gap, joined to them by shared nodes."""
    edge = HALF_WIDTH + FLANGE
    hat = line((-edge, 0.0, 0), (-HALF_WIDTH, 0.0, 2), (-HALF_WIDTH, HEIGHT, 4), (HALF_WIDTH, HEIGHT, 4), (HALF_WIDTH, 0.0, 4),
               (edge, 0.0, 2))
    plate = line((-edge, -gap, 0), (-HALF_WIDTH, -gap, 2), (HALF_WIDTH, -gap, 4), (edge, -gap, 2))
    nodes, shells, number = [], {"HAT": [], "PLATE": []}, {}
    for name, places in (("HAT", hat), ("PLATE", plate)):
        for i in range(SLICES + 1):
            for y, z in places:
                if (i, y, z) not in number:
                    number[i, y, z] = len(number) + 1
                    nodes.append(f"{number[i, y, z]}, {LENGTH * i / SLICES!r}, {y!r}, {z!r}")
        for i in range(SLICES):
            for a, b in zip(places, places[1:]):
                corners = (number[(i, *a)], number[(i + 1, *a)], number[(i + 1, *b)], number[(i, *b)])
                shells[name].append(f"{len(shells[name]) + (1 if name == 'HAT' else 5001)}, " + ", ".join(map(str, corners)))
    ends = [", \n".join(str(n) for (slice_, _, _), n in number.items() if slice_ == at) for at in (0, SLICES)]
    welds = []
    if gap:
        middles = [pitch * (k + 0.5) for k in range(int(LENGTH / pitch))]
        out = HALF_WIDTH + FLANGE / 2
        welds = ["*NODE, NSET=WELDS", *[f"{20001 + 2 * k + side}, {x!r}, {(2 * side - 1) * out!r}, {-gap / 2!r}"
                                        for k, x in enumerate(middles) for side in (0, 1)],
                 "*SURFACE, NAME=A\nHAT, SPOS", "*SURFACE, NAME=B\nPLATE, SPOS", "*FASTENER PROPERTY, NAME=SPOT\n3.",
                 "*FASTENER, INTERACTION NAME=W, PROPERTY=SPOT, REFERENCE NODE SET=WELDS\n\nA, B"]
    step = lambda moment, dof: (f"*STEP\n*STATIC\n*CLOAD, OP=NEW\n10002, {dof}, {moment}\n*OUTPUT, HISTORY, FREQUENCY=1\n"
                                "*NODE OUTPUT, NSET=TIP\nUR\n*END STEP")
    return "\n".join(["*NODE", *nodes, f"10001, 0., 0., {HEIGHT / 2!r}\n10002, {LENGTH!r}, 0., {HEIGHT / 2!r}",
                      "*NSET, NSET=TIP\n10002",
                      *[f"*ELEMENT, TYPE=S4R, ELSET={name}\n" + "\n".join(these) for name, these in shells.items()],
                      *[f"*NSET, NSET=END{i}\n{members}\n*SURFACE, TYPE=NODE, NAME=FACE{i}\nEND{i}\n"
                        f"*COUPLING, CONSTRAINT NAME=C{i}, REF NODE=1000{i}, SURFACE=FACE{i}\n*KINEMATIC\n1, 6"
                        for i, members in enumerate(ends, 1)], *welds,
                      f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{YOUNG}, {POISSON}", "*ELSET, ELSET=ALL\nHAT, PLATE",
                      f"*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL\n{THICKNESS}",
                      "*BOUNDARY\n10001, 1, 6", step(1e5, 4), step(1e5, 5), ""])


def closed_forms(gap):
    """Stiffness of torsion (Bredt) and of bending about the horizontal axis, of thin sheets. Shear flows around the cell through
    the welds, in the middle of the flanges; where nodes are shared, through the feet of the webs."""
    width, height, detour = 2 * HALF_WIDTH, HEIGHT + gap, FLANGE / 2 if gap else 0.0
    cell, way = width * height + 2 * detour * gap, 2 * width + 2 * height + 4 * detour
    torsion = YOUNG / (2 * (1 + POISSON)) * 4 * cell**2 * THICKNESS / way / LENGTH
    strips = [(2 * FLANGE, 0.0, 0.0), (width, HEIGHT, 0.0), (2 * HEIGHT, HEIGHT / 2, HEIGHT), (width + 2 * FLANGE, -gap, 0.0)]
    area = sum(breadth for breadth, _, _ in strips)
    center = sum(breadth * z for breadth, z, _ in strips) / area
    second = sum(breadth * ((z - center)**2 + tall**2 / 12) for breadth, z, tall in strips) * THICKNESS
    return torsion, YOUNG * second / LENGTH


def closed_section(run):
    """A hat section closed by a plate that is welded to it, or shares its nodes, is as stiff as closed forms say. Welds in every
    element do not lock; fewer ones leave it softer in torsion, as the shear must pass through them."""

    def against_closed_form(gap, pitch, ranks):
        job = run(beam_deck(gap, pitch), ranks)
        turns = [abs(job.history("node_10002", "UR", step)[1][-1][axis]) for step, axis in ((1, 0), (2, 1))]
        return [1e5 / turn / stiffness for turn, stiffness in zip(turns, closed_forms(gap))]

    torsion, bending = against_closed_form(0.0, 0.0, 1)
    check("torsion, nodes shared", torsion, 1.0, 0.03)
    check("bending, nodes shared", bending, 1.0, 0.01)
    dense, bending = against_closed_form(THICKNESS, LENGTH / SLICES, 2)
    check("torsion, a weld in every element", dense, 1.0, 0.03)
    check("bending, a weld in every element", bending, 1.0, 0.01)
    sparse, bending = against_closed_form(THICKNESS, 3 * LENGTH / SLICES, 1)
    check("torsion, a weld in every third element", float(0.85 < sparse < dense), 1.0, 0.0)
    check("bending, a weld in every third element", bending, 1.0, 0.01)


def tied_sheets(run):
    """Two square sheets tied edge to edge, stretched and bent by the far edge. Where the edges of the tied mesh divide those of the
    other one, stretch and curvature stay uniform to round-off; else they miss that a little, less on finer meshes."""

    def farthest_from_uniform(divisions, others, ranks):
        nodes, shells, edges = [], [], {}
        for sheet, n in enumerate((divisions, others)):
            at = lambda i, j: 1000 * sheet + (n + 1) * i + j + 1
            nodes += [f"{at(i, j)}, {sheet + i / n!r}, {j / n!r}, 0." for i in range(n + 1) for j in range(n + 1)]
            corners = lambda i, j: (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
            shells.append([f"{at(i, j)}, " + ", ".join(map(str, corners(i, j))) for i in range(n) for j in range(n)])
            edges[2 * sheet], edges[2 * sheet + 1] = ([at(i, j) for j in range(n + 1)] for i in (0, n))
        listed = lambda name, members: f"*NSET, NSET={name}\n" + ",\n".join(map(str, members))
        job = run("\n".join(["*NODE", *nodes,
                             *[f"*ELEMENT, TYPE=S4R, ELSET=SHEET{i}\n" + "\n".join(these) for i, these in enumerate(shells)],
                             listed("LEFT", edges[0]), listed("SEAM", edges[2]), listed("RIGHT", edges[3]),
                             "*SURFACE, NAME=MASTER\nSHEET0, SPOS", "*SURFACE, TYPE=NODE, NAME=SLAVE\nSEAM",
                             "*TIE, NAME=GLUE\nSLAVE, MASTER",
                             "*ELSET, ELSET=ALL\nSHEET0, SHEET1", f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{YOUNG}, 0.",
                             "*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL\n0.05", "*BOUNDARY\nLEFT, 1, 6\nRIGHT, 6, 6",
                             "*STEP\n*STATIC", "*BOUNDARY\nRIGHT, 1, 1, 2e-3\nRIGHT, 5, 5, 2e-3",
                             "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=SEAM\nU, UR",
                             "*END STEP\n"]), ranks)
        last = lambda node, variable, axis: job.history(f"node_{node}", variable)[1][-1][axis]
        return max(max(abs(last(node, "U", 0) / 1e-3 - 1), abs(last(node, "UR", 1) / 1e-3 - 1)) for node in edges[2])

    check("edges that divide the others'", farthest_from_uniform(2, 4, 1), 0.0, 1e-8)
    coarse, fine = farthest_from_uniform(2, 3, 2), farthest_from_uniform(6, 9, 1)
    print(f"     edges that do not: {coarse:.3e}, three times finer {fine:.3e}")
    check("edges that do not", coarse, 0.0, 0.1)
    check("they come nearer on finer meshes", float(fine < 0.5 * coarse), 1.0, 0.0)


def tumbling_star(run):
    """Point masses on rigid arms, spun about the middle one of their axes: they tumble as Euler's equations say."""
    masses = np.array([1.0, 2.0, 1.5, 0.5, 1.0])
    places = np.array([[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [-0.7, 0.5, 0.1], [0.0, -0.9, 0.3], [0.1, 0.2, -0.8]])
    centre = masses @ places / masses.sum()
    arms = places - centre
    inertia = sum(m * (np.dot(a, a) * np.eye(3) - np.outer(a, a)) for m, a in zip(masses, arms))
    _, axes = np.linalg.eigh(inertia)
    spin = 5.0 * (axes[:, 1] + 0.02 * axes[:, 0])

    def motion(x):  # columns of the rotation, and the spin in the frame of the star
        turn, w = x[:9].reshape(3, 3), x[9:]
        cross = np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
        return np.concatenate([(turn @ cross).ravel(), np.linalg.solve(inertia, -np.cross(w, inertia @ w))])

    point = lambda p: ", ".join(repr(float(c)) for c in p)
    deck = "\n".join(["*NODE, NSET=STAR", *[f"{i}, {point(p)}" for i, p in enumerate(places, 1)],
                      *[f"*ELEMENT, TYPE=MASS, ELSET=M{i}\n{i}, {i}\n*MASS, ELSET=M{i}\n{m}" for i, m in enumerate(masses, 1)],
                      "*MPC\nBEAM, 2, 1\nBEAM, 3, 1\nBEAM, 4, 1\nBEAM, 5, 1",
                      "*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY", f"STAR, {float(np.linalg.norm(spin))!r}",
                      f"{point(centre)}, {point(centre + spin)}",
                      explicit_step(2e-4, 10.0, "", history("STAR", "U", 0.05))])
    job = run(deck, 1)
    time = job.history("node_1", "U")[0]
    turns = integrate(motion, np.concatenate([np.eye(3).ravel(), spin]), time)[:, :9].reshape(-1, 3, 3)
    check("it turns over", float(min(turn[:, 1] @ turns[0][:, 1] for turn in turns) < -0.5), 1.0, 0.0)
    ways = np.array([job.history(f"node_{i}", "U")[1] for i in range(1, 6)])
    expected = np.einsum("tij,nj->nti", turns, arms) - arms[:, None]
    check("ways", np.abs(ways - expected).max(), 0.0, 1e-4)
    now = ways + places[:, None]
    lengths = np.linalg.norm(now[1:] - now[0], axis=2)
    check("lengths of arms", np.abs(lengths - lengths[:, :1]).max(), 0.0, 1e-12)
    check("their centre rests", np.abs(np.einsum("n,nti->ti", masses, ways)).max(), 0.0, 1e-10)
    check_energy(job, 1e-11)
    again = run(deck, 2)
    check("the same bits on two ranks", float(np.array_equal(again.history("node_4", "U")[1], ways[3])), 1.0, 0.0)


def sheets_thrown(run):
    """Two sheets on rigid arms, one of which is struck: arms between free nodes, which move in closed form, do and bear what
    the same arms do that are said twice, which are systems of equations."""
    nodes, shells = [], {0: [], 1: []}
    for sheet in (0, 1):
        at = lambda i, j: 100 * sheet + 4 * i + j + 1
        nodes += [f"{at(i, j)}, {10.0 * i}, {10.0 * j}, {4.0 * sheet}" for i in range(4) for j in range(4)]
        shells[sheet] = [f"{at(i, j)}, {at(i, j)}, {at(i + 1, j)}, {at(i + 1, j + 1)}, {at(i, j + 1)}" for i in range(3) for j in range(3)]
    arms = [(1, 101), (104, 4), (13, 113), (16, 116), (116, 200)]  # the last one has a mass at its end

    def deck(times):
        ends = [f"{1000 * (k + 1) + i}, {first}, {second}" for k in range(times) for i, (first, second) in enumerate(arms)]
        return "\n".join(["*NODE, NSET=ALL", *nodes, "200, 45., 30., 12.", "*NSET, NSET=OUT\n1, 116, 200",
                          *[f"*ELEMENT, TYPE=S4R, ELSET=SHEET{i}\n" + "\n".join(these) for i, these in shells.items()],
                          "*ELSET, ELSET=SHEETS\nSHEET0, SHEET1", "*ELEMENT, TYPE=MASS, ELSET=MASS\n900, 200\n*MASS, ELSET=MASS\n2.",
                          "*ELEMENT, TYPE=CONN3D2, ELSET=ARMS", *ends, "*CONNECTOR SECTION, ELSET=ARMS\nBEAM",
                          "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e3, 0.3\n*DENSITY\n7.85e-3",
                          "*SHELL SECTION, ELSET=SHEETS, MATERIAL=STEEL\n0.8",
                          "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, 0.3\n1, 3, 2.\n16, 3, 1.\n113, 2, -1.5\n200, 3, -1.",
                          "*ELSET, ELSET=FIRST", ", ".join(str(1000 + i) for i in range(len(arms))),
                          explicit_step(5e-4, 2.0, "", history("OUT", "U, UR, A", 0.1) + "*ELEMENT OUTPUT, ELSET=FIRST\nCTF\n")])

    closed, system = run(deck(1), 1), run(deck(2), 1)
    check("arms said twice are told", float("follow from other constraints" in system.log()), 1.0, 0.0)
    for variable, tolerance in (("U", 1e-8), ("UR", 1e-8), ("A", 1e-5)):
        for node in (1, 116, 200):
            one, other = (job.history(f"node_{node}", variable)[1] for job in (closed, system))
            check(f"{variable} of {node}", np.abs(one - other).max() / np.abs(other).max(), 0.0, tolerance)
    largest = np.abs(system.history("element_1004", "CTF")[1]).max()
    for arm in range(1000, 1000 + len(arms)):
        one, other = (job.history(f"element_{arm}", "CTF")[1] for job in (closed, system))
        check(f"what arm {arm} bears", np.abs(one - other).max() / largest, 0.0, 1e-5)
    check_energy(closed, 1e-3)
    again = run(deck(1), 2)
    same = all(np.array_equal(again.history(f"node_{node}", "U")[1], closed.history(f"node_{node}", "U")[1]) for node in (1, 116, 200))
    check("the same bits on two ranks", float(same), 1.0, 0.0)


def stack_deck(kind, steps):
    """Three square sheets on top of each other and four welds: connectors from sheet to sheet, with a third one that closes each to a
    ring, or nodes that hold all sheets. Sets: BOTTOM, TOP, all nodes of these sheets; LOADED, one node of the top sheet."""
    side, n, height = 30.0, 6, 1.0
    nodes, shells = [], []
    for sheet in range(3):
        at = lambda i, j: 100 * sheet + 7 * i + j + 1
        nodes.append([f"{at(i, j)}, {side * i / n!r}, {side * j / n!r}, {height * sheet}" for i in range(n + 1) for j in range(n + 1)])
        shells.append([f"{at(i, j)}, {at(i, j)}, {at(i + 1, j)}, {at(i + 1, j + 1)}, {at(i, j + 1)}" for i in range(n) for j in range(n)])
    ends, upper, lower, across = [], [], [], []
    for weld, (x, y) in enumerate(((7.0, 8.0), (23.0, 6.0), (22.0, 24.0), (8.0, 22.0))):
        first = 400 + 10 * weld
        ends += [f"{first + sheet}, {x}, {y}, {height * sheet}" for sheet in range(3)]
        upper.append(f"{1000 + weld}, {first + 2}, {first + 1}")
        lower.append(f"{1010 + weld}, {first + 1}, {first}")
        across.append(f"{1020 + weld}, {first + 2}, {first}")
    connectors = ["*ELEMENT, TYPE=CONN3D2, ELSET=UPPER", *upper, "*ELEMENT, TYPE=CONN3D2, ELSET=LOWER", *lower]
    if kind == "rings":
        connectors += ["*ELEMENT, TYPE=CONN3D2, ELSET=ACROSS", *across]
    names = "UPPER, LOWER, ACROSS" if kind == "rings" else "UPPER, LOWER"
    if kind == "nodes":
        ends = [end for end in ends if end.endswith(f", {height}")]
        welds = ["*NSET, NSET=SPOTS", "401, 411, 421, 431", "*FASTENER, PROPERTY=SPOT, REFERENCE NODE SET=SPOTS"]
    else:
        welds = [*connectors, f"*ELSET, ELSET=WELDS\n{names}", "*CONNECTOR SECTION, ELSET=WELDS\nBEAM", "*FASTENER, PROPERTY=SPOT, ELSET=WELDS"]
    return "\n".join([*[f"*NODE, NSET={name}\n" + "\n".join(these) for name, these in zip(("BOTTOM", "MIDDLE", "TOP"), nodes)], "*NODE, NSET=ENDS", *ends,
                      *[f"*ELEMENT, TYPE=S4R, ELSET=SHEET{i}\n" + "\n".join(these) for i, these in enumerate(shells)],
                      *[f"*SURFACE, NAME=FACE{i}\nSHEET{i}, SPOS" for i in range(3)], "*FASTENER PROPERTY, NAME=SPOT\n3.", *welds, "FACE0, FACE1, FACE2",
                      "*ELSET, ELSET=SHEETS\nSHEET0, SHEET1, SHEET2", "*NSET, NSET=LOADED\n225", "*NSET, NSET=SHOWN\nBOTTOM, MIDDLE, TOP",
                      "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e3, 0.3\n*DENSITY\n7.85e-3", "*SHELL SECTION, ELSET=SHEETS, MATERIAL=STEEL\n0.8", steps])


def stacked_sheets(run):
    """Welds through three sheets: what pulls the top one passes through every gap between sheets, in statics and in time; a ring of three
    connectors in each weld, whose conditions follow from each other, moves as two of them do."""
    load = np.array([30.0, -20.0, 10.0])
    pull = "*CLOAD\n" + "".join(f"225, {c + 1}, {load[c]}\n" for c in range(3))
    sets = {"chains": ("UPPER", "LOWER"), "rings": ("UPPER", "LOWER", "ACROSS"), "nodes": ()}
    first = {"UPPER": 1000, "LOWER": 1010, "ACROSS": 1020}
    shown = lambda kind: "".join(f"*ELEMENT OUTPUT, ELSET={name}\nCTF\n" for name in sets[kind])
    through = lambda job, *names: sum(job.history(f"element_{first[name] + weld}", "CTF")[1][:, :3] for name in names for weld in range(4))
    for kind in sets:
        gaps = {"chains": (("UPPER",), ("LOWER",)), "rings": (("UPPER", "ACROSS"), ("LOWER", "ACROSS")), "nodes": ()}[kind]
        static = ("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\nBOTTOM, 1, 6\n" + pull + "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=SHOWN\nU, RF\n"
                  + shown(kind) + "*END STEP\n")
        ways = {}
        for ranks in (1, 2):
            job = run(stack_deck(kind, static), ranks)
            check(f"{kind}: forces of the support", np.abs(sum(job.history(f"node_{node}", "RF")[1][-1] for node in range(1, 50)) + load).max(), 0.0, 1e-8)
            for gap in gaps:
                check(f"{kind}: what {' and '.join(gap)} bear", np.abs(through(job, *gap)[-1] + load).max(), 0.0, 1e-8)
            ways[ranks] = job.history("node_225", "U")[1][-1]
        if kind == "chains":
            expected = ways[1]
        if kind == "rings":
            check("rings: as chains", np.abs(ways[2] - expected).max() / np.abs(expected).max(), 0.0, 1e-8)
        output = "*OUTPUT, HISTORY, TIME INTERVAL=0.01\n*NODE OUTPUT, NSET=SHOWN\nU, A\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ETOTAL\n"
        jobs = [run(stack_deck(kind, explicit_step(2e-4, 0.05, pull, output + shown(kind))), ranks) for ranks in {"chains": (1, 2), "rings": (1, 3), "nodes": (1,)}[kind]]
        for other in jobs[1:]:
            same = all(np.array_equal(other.history(f"node_{node}", "U")[1], jobs[0].history(f"node_{node}", "U")[1]) for node in (1, 101, 225, 249))
            check(f"{kind}: the same bits", float(same), 1.0, 0.0)
        share = lambda node: 7.85e-3 * 0.8 * 25.0 * (0.5 if (node % 100 - 1) // 7 in (0, 6) else 1.0) * (0.5 if (node % 100 - 1) % 7 in (0, 6) else 1.0)
        pushed = lambda sheets: sum(share(100 * sheet + i) * jobs[0].history(f"node_{100 * sheet + i}", "A")[1] for sheet in sheets for i in range(1, 50))
        check(f"{kind}: all of it", np.abs(pushed((0, 1, 2))[1:] - load).max() / np.abs(load).max(), 0.0, 1e-6)
        for gap, sheets in zip(gaps, ((0, 1), (0,))):  # connectors tell forces in axes that turn with the sheets, by 1e-4 here
            beyond = pushed(sheets)[1:]
            check(f"{kind}: what {' and '.join(gap)} bear in time", np.abs(through(jobs[0], *gap)[1:] + beyond).max() / np.abs(beyond).max(), 0.0, 1e-3)
        check_energy(jobs[0], 1e-3)
        if kind == "rings":
            check("conditions that follow from others are told", float("from other constraints" in jobs[0].log()), 1.0, 0.0)


def coarse_stack(places, weld, extra=""):
    """Sheets of two by two elements of 50 mm at heights, and a node off the middle of them at the height `weld` that holds all."""
    nodes = [f"{100 * sheet + 3 * i + j + 1}, {50.0 * i}, {50.0 * j}, {z}" for sheet, z in enumerate(places) for i in range(3) for j in range(3)]
    shells = [f"*ELEMENT, TYPE=S4R, ELSET=SHEET{sheet}\n" + "".join(
        f"{at}, {at}, {at + 3}, {at + 4}, {at + 1}\n" for at in (100 * sheet + 3 * i + j + 1 for i in (0, 1) for j in (0, 1))) for sheet in range(len(places))]
    names = [f"SHEET{sheet}" for sheet in range(len(places))]
    return "\n".join(["*NODE", *nodes, f"900, 37., 61., {weld}", "".join(shells) + "*ELSET, ELSET=SHEETS\n" + ", ".join(names),
                      *[f"*SURFACE, NAME={name}\n{name}, SPOS" for name in names], "*NSET, NSET=SPOT\n900", "*NSET, NSET=HELD, GENERATE\n1, 9",
                      f"*FASTENER PROPERTY, NAME=P\n3.\n*FASTENER, PROPERTY=P, REFERENCE NODE SET=SPOT{extra}\n" + ", ".join(names),
                      "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e3, 0.3", "*SHELL SECTION, ELSET=SHEETS, MATERIAL=STEEL\n0.8",
                      "*STEP\n*STATIC\n1., 1.\n*BOUNDARY\nHELD, 1, 6\n*CLOAD", *[f"{100 * sheet + 9}, {sheet}, 2." for sheet in range(1, len(places))],
                      "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=HELD\nRF\n*END STEP\n"])


def reach(run):
    """Without a SEARCH RADIUS a weld reaches all sheets of a stack from its lowest one, on meshes much coarser than the sheets are apart;
    sheets farther away need one."""
    for ranks, places, weld, extra in ((1, (0.0, 1.0), 0.0, ""), (2, (0.0, 1.0, 2.0), 0.0, ""), (1, (0.0, 12.0), 0.0, ", SEARCH RADIUS=15."),
                                       (2, (0.0, 1.0, 2.0), 2.0, "")):
        job = run(coarse_stack(places, weld, extra), ranks)
        held = sum(job.history(f"node_{node}", "RF")[1][-1] for node in range(1, 10))
        loads = -2.0 * np.array([len(places) > sheet for sheet in (1, 2, 3)])
        check(f"the lowest of {len(places)} sheets holds the others", np.abs(held - loads).max(), 0.0, 1e-9)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (closed_section, tied_sheets, tumbling_star, sheets_thrown, stacked_sheets, reach)})
