#!/usr/bin/env python3
"""Distributing couplings that share nodes with each other, with ties and with rigid bodies: shared_coupling_cases.py CASE BALOCCO FOLDER.

Whatever shares nodes, forces and moments at the reference nodes arrive in sum at the matter: in statics at the feet, in time as momenta.
"""
import numpy as np

from job import check, run_case
from motion_decks import explicit_step

LOADS = {1000: ((1.0, 0.5, -2.0), (0.1, 0.2, 0.3)), 1001: ((-0.3, 0.4, 0.6), (0.0, 0.1, 0.0))}  # force and moment at reference nodes
BODY = 1002


class Blocks:
    """Rows of unit bricks of unit density, their nodes and lumped masses."""

    def __init__(self):
        self.places, self.mass, self.text = {}, {}, ""

    def add(self, name, first, count, x, z):
        node = lambda i, j, k: first + i + 10 * j + 20 * k
        for k in (0, 1):
            for j in (0, 1):
                for i in range(count + 1):
                    self.places[node(i, j, k)] = (x + i, float(j), z + k)
        self.text += f"*ELEMENT, TYPE=C3D8R, ELSET={name}\n"
        for i in range(count):
            corners = [node(i + di, dj, dk) for dk in (0, 1) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
            self.text += f"{first + i}, " + ", ".join(map(str, corners)) + "\n"
            for corner in corners:
                self.mass[corner] = self.mass.get(corner, 0.0) + 1.0 / 8.0
        self.text += f"*SOLID SECTION, ELSET={name}, MATERIAL=M\n1.\n"


def surface(name, nodes):
    return f"*SURFACE, TYPE=NODE, NAME={name}\n" + "".join(f"{node},\n" for node in nodes)


def model(kind):
    """The deck down to its steps, the blocks with all nodes, and the feet."""
    blocks, extra = Blocks(), ""
    if kind == "on a tie":
        blocks.add("LOWER", 1, 3, -0.4, -1.0)
        blocks.add("UPPER", 101, 2, 0.0, 0.0)
        first, second, feet = (121, 122, 131, 132, 101, 102), (102, 103, 112, 113), (1, 2, 3, 4, 11, 12, 13, 14)
        extra = surface("SLAVE", (101, 102, 103, 111, 112, 113)) + "*SURFACE, NAME=MASTER\nLOWER, S2\n*TIE, NAME=T, ADJUST=NO, POSITION TOLERANCE=0.2\nSLAVE, MASTER\n"
    else:
        blocks.add("LOWER", 1, 2, 0.0, 0.0)
        first, second, feet = (21, 22, 31, 32), (22, 23, 32, 33), (1, 2, 3, 11, 12, 13)
    blocks.places |= {1000: (0.5, 0.5, 2.0), 1001: (1.5, 0.5, 2.0)}
    carried = {"partly on a body": (21, 31, 22), "all on a body": (21, 22, 31, 32)}.get(kind)
    if carried:
        blocks.places[BODY], blocks.mass[BODY] = (0.0, 0.5, 1.5), 0.5
        extra = f"""*NSET, NSET=CARRIED
{', '.join(map(str, carried))}
*RIGID BODY, REF NODE={BODY}, TIE NSET=CARRIED
*ELEMENT, TYPE=MASS, ELSET=BODY
900, {BODY}
*MASS, ELSET=BODY
0.5
*ELEMENT, TYPE=ROTARYI, ELSET=INERTIA
901, {BODY}
*ROTARY INERTIA, ELSET=INERTIA
0.1, 0.1, 0.1
"""
    if kind == "in a chain":
        second = (1000, *second)
    couplings = "".join(f"*COUPLING, CONSTRAINT NAME=C{node}, REF NODE={node}, SURFACE=S{node}\n*DISTRIBUTING\n" for node in LOADS)
    if kind == "kinematic in a chain":  # the reference node of the first is a node of the second, which the deck says first
        second = (1000, *second)
        couplings = (f"*COUPLING, CONSTRAINT NAME=OUTER, REF NODE=1001, SURFACE=S1001\n*KINEMATIC\n"
                     f"*COUPLING, CONSTRAINT NAME=INNER, REF NODE=1000, SURFACE=S1000\n*KINEMATIC\n")
    deck = "*NODE, NSET=ALL\n" + "".join(f"{node}, {x}, {y}, {z}\n" for node, (x, y, z) in blocks.places.items())
    deck += "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*DENSITY\n1.\n" + blocks.text + surface("S1000", first) + surface("S1001", second) + extra
    deck += couplings + "*NSET, NSET=FEET\n" + ", ".join(map(str, feet)) + "\n"
    return deck, blocks, feet


def load_lines():
    return "*CLOAD\n" + "".join(f"{node}, {3 * part + c + 1}, {load[part][c]}\n" for node, load in LOADS.items() for part in (0, 1) for c in range(3))


def wrench(places):
    """Sum of the loads and of their moments about the origin, by the places of the reference nodes."""
    force = sum(np.array(load[0]) for load in LOADS.values())
    return force, sum(np.cross(places[node], load[0]) + np.array(load[1]) for node, load in LOADS.items())


def check_statics(run, kind, ranks):
    deck, blocks, feet = model(kind)
    job = run(deck + "*STEP, NLGEOM\n*STATIC\n1., 1.\n*BOUNDARY\nFEET, 1, 3\n" + load_lines()
              + "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=ALL\nU, RF\n*END STEP\n", ranks)
    at = {node: np.array(place) + job.history(f"node_{node}", "U")[1][-1] for node, place in blocks.places.items()}
    reaction = {node: job.history(f"node_{node}", "RF")[1][-1] for node in feet}
    force, moment = wrench(at)
    check(f"{kind}: forces at the feet", np.abs(sum(reaction.values()) + force).max(), 0.0, 1e-9)
    check(f"{kind}: moments at the feet", np.abs(sum(np.cross(at[node], reaction[node]) for node in feet) + moment).max(), 0.0, 1e-9)


def check_motion(run, kind, ranks):
    deck, blocks, _ = model(kind)
    job = run(deck + explicit_step(1e-3, 0.4, load_lines(), "*OUTPUT, HISTORY, TIME INTERVAL=0.01\n*NODE OUTPUT, NSET=ALL\nU, V, VR\n"
                                   "*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ETOTAL\n"), ranks)
    time = job.history("node_1000", "U")[0]
    at = {node: np.array(place) + job.history(f"node_{node}", "U")[1] for node, place in blocks.places.items()}
    velocity = {node: job.history(f"node_{node}", "V")[1] for node in blocks.mass}
    momentum = sum(mass * velocity[node] for node, mass in blocks.mass.items())
    angular = sum(mass * np.cross(at[node], velocity[node]) for node, mass in blocks.mass.items())
    if BODY in blocks.mass:
        angular = angular + 0.1 * job.history(f"node_{BODY}", "VR")[1]
    force, moment = wrench(at)
    impulse = np.concatenate([np.zeros((1, 3)), np.cumsum((moment[1:] + moment[:-1]) / 2 * np.diff(time)[:, None], axis=0)])
    # Velocities at an instant are means over the half increments around it; the impulse of moments is a sum over ten increments.
    check(f"{kind}: momentum", np.abs(momentum - np.outer(time, force)).max() / np.abs(momentum).max(), 0.0, 1e-6)
    check(f"{kind}: angular momentum", np.abs(angular - impulse).max() / np.abs(impulse).max(), 0.0, 1e-4)
    return at[1000]


def arrives(run, *kinds):
    for kind in kinds:
        ways = []
        for ranks in (1, 2):
            check_statics(run, kind, ranks)
            ways.append(check_motion(run, kind, ranks))
        check(f"{kind}: the same bits on two ranks", float(np.array_equal(*ways)), 1.0, 0.0)


def with_each_other(run):
    """Two couplings have nodes in common; the reference node of one is a node of the other."""
    arrives(run, "with each other", "in a chain", "kinematic in a chain")


def with_ties(run):
    """Coupled nodes are those that a tie holds, too."""
    arrives(run, "on a tie")


def with_bodies(run):
    """A rigid body carries some of the coupled nodes, or all of them: then it carries the reference node, moments included."""
    arrives(run, "partly on a body", "all on a body")


def thrown_sheet(feather=""):
    """A sheet with three clouds of nodes, two of them on one reference node, all thrown with a spin."""
    side = 7
    place = lambda i, j: (i / 6.0, j / 6.0, 0.05 * i / 6.0)
    node = lambda i, j: 1 + i + side * j
    nodes = "".join("%d, %r, %r, %r\n" % (node(i, j), *place(i, j)) for j in range(side) for i in range(side))
    shells = "".join(f"{1 + i + 6 * j}, {node(i, j)}, {node(i + 1, j)}, {node(i + 1, j + 1)}, {node(i, j + 1)}\n" for j in range(6) for i in range(6))
    clouds = ([(i, j) for j in range(3) for i in range(3)], [(i, j) for j in range(4, 7) for i in range(4, 7)], [(i, j) for j in range(2) for i in range(4, 7)])
    couplings = "".join(surface(f"S{k}", [node(*at) for at in cloud]) + f"*COUPLING, CONSTRAINT NAME=K{k}, REF NODE={reference}, SURFACE=S{k}\n*DISTRIBUTING\n"
                        for k, (cloud, reference) in enumerate(zip(clouds, (1000, 1000, 1001))))
    return f"""*NODE, NSET=ALL
{nodes}1000, 0.4, 0.6, 0.7
1001, 0.9, 0.2, -0.5
*ELEMENT, TYPE=S4R, ELSET=SHEET
{shells}*ELEMENT, TYPE=MASS, ELSET=M
101, 1000
*MASS, ELSET=M
5e-6
*ELEMENT, TYPE=ROTARYI, ELSET=I
102, 1000
*ROTARY INERTIA, ELSET=I
1e-7, 2e-7, 3e-7
*MATERIAL, NAME=STEEL
*ELASTIC
2e5, 0.3
*DENSITY
1e-3
*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL
0.02
{couplings}{feather}*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
ALL, 30., 1., 0., 2.
0., 0., 0., 0.3, 0.5, 1.
*STEP, NLGEOM
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
2e-6, 4e-3
*CLOAD
1001, 3, 1e-3
*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U, V, A
*END STEP
"""


# It hangs on one node of each cloud, which takes all of them out of their closed form; 5e-9 of the sheet's mass.
FEATHER = """*NODE, NSET=ALL
1002, 0.5, 0.5, 0.2
*ELEMENT, TYPE=MASS, ELSET=FEATHER
103, 1002
*MASS, ELSET=FEATHER
1e-13
*ELEMENT, TYPE=ROTARYI, ELSET=SPIN
104, 1002
*ROTARY INERTIA, ELSET=SPIN
1e-14, 1e-14, 1e-14
""" + surface("S4", (1, 33, 7)) + """*COUPLING, CONSTRAINT NAME=K4, REF NODE=1002, SURFACE=S4
*DISTRIBUTING
"""


def by_nodes(run):
    """Clouds whose nodes nothing else joins move in closed form, as if their nodes were looked at one by one; a reference node may have no
    mass."""
    one, two, other = run(thrown_sheet(), 1), run(thrown_sheet(), 2), run(thrown_sheet(FEATHER), 1)
    for variable, tolerance in (("U", 1e-8), ("V", 1e-7), ("A", 1e-4)):  # A is a difference of V over an increment of 2e-6
        u, on_two = one.frame(variable, -1), two.frame(variable, -1)
        with_feather = other.frame(variable, -1)[:len(u)]
        check(f"{variable} as by nodes", np.abs(u - with_feather).max() / np.abs(u).max(), 0.0, tolerance)
        check(f"{variable}: something differs", float(np.abs(u - with_feather).max() > 0.0), 1.0, 0.0)
        check(f"{variable} on two ranks", np.abs(u - on_two).max(), 0.0, 0.0)


# One node of a cloud is held from here on, so that nodes of the cloud are looked at one by one, by every rank.
HELD = """*STEP, NLGEOM
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
2e-6, 1e-3
*BOUNDARY, TYPE=VELOCITY
1, 1, 3, 0.
*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U, V, A
*END STEP
"""


def opened_cloud(run):
    """Ranks that do not compute nodes of a cloud need not know how they move, until a later step makes them look."""
    one, *others = (run(thrown_sheet() + HELD, ranks) for ranks in (1, 2, 3))
    for other in others:
        for variable in ("U", "V", "A"):
            check(f"{variable} on {other.ranks}", np.abs(one.frame(variable, -1) - other.frame(variable, -1)).max(), 0.0, 0.0)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (with_each_other, with_ties, with_bodies, by_nodes, opened_cloud)})
