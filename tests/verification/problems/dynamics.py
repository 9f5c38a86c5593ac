"""Explicit dynamics against closed forms: impacts of rods, a pendulum, a free top, skidding and sliding bodies, increments."""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import explicit_cases  # noqa: E402
from verification import problem  # noqa: E402

DECKS = explicit_cases.DECKS


def history(results, group, variable, step=1):
    rows = results.file["step_%d/history/%s" % (step, group)]
    return rows["time"][:], rows[variable][:]


def energy_drift(results, step=1):
    """Largest change of ETOTAL over the largest energy."""
    total = history(results, "energy", "ETOTAL", step)[1]
    largest = max(np.abs(history(results, "energy", name, step)[1]).max() for name in ("ALLKE", "ALLIE", "ALLWK"))
    return np.abs(total - total[0]).max() / largest


ROD = """*NODE
1, 0., 0., 0.
{last}, {length}, 0., 0.
9000, {wall}, 0., 0.
*NGEN, NSET=ROD
1, {last}, 1
*ELEMENT, TYPE=T3D2, ELSET=ROD
1, 1, 2
*ELGEN, ELSET=ROD
1, {count}, 1, 1
*SOLID SECTION, ELSET=ROD, MATERIAL=STEEL
{area}
*MATERIAL, NAME=STEEL
*ELASTIC
200e9, 0.
*DENSITY
7800.
*NSET, NSET=TIP
1
*NSET, NSET=WATCHED
{middle}, 9000
*SURFACE, NAME=TIP, TYPE=NODE
TIP
*SURFACE, NAME=WALL, TYPE=SEGMENTS
START, {wall}, 1.
LINE, {wall}, -1.
*RIGID BODY, REF NODE=9000, ANALYTICAL SURFACE=WALL
*SURFACE INTERACTION, NAME=SMOOTH
*CONTACT PAIR, INTERACTION=SMOOTH
TIP, WALL
*BOUNDARY
ROD, 2, 3
9000, 1, 6
*INITIAL CONDITIONS, TYPE=VELOCITY
ROD, 1, {velocity}
*STEP
*DYNAMIC, EXPLICIT, SCALE FACTOR=0.9
, {end}
*BULK VISCOSITY
0.06, 1.2
*OUTPUT, HISTORY, TIME INTERVAL={sample}
*NODE OUTPUT, NSET=WATCHED
RF1, V1
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*END STEP
"""


def impact(session, name, count, length, area, velocity, gap, end):
    """Time, force of the wall, velocity of the middle."""
    text = ROD.format(last=count + 1, length=length, wall=-gap, count=count, area=area, middle=count // 2 + 1, velocity=-velocity,
                      end=end, sample=end / 1000.0)
    results = session.run("%s_%d" % (name, count), text)
    time, force = history(results, "node_9000", "RF1")
    return time, np.abs(force), history(results, "node_%d" % (count // 2 + 1), "V1")[1]


@problem("RODS", "two equal rods of length 1 collide at 10 m/s: half of it, a rod at 5 m/s against a rigid wall", "one-dimensional waves",
         {"stress, MPa": (197.48, 0.02), "duration, ms": (0.39497, 0.02), "speed of leaving": (5.0, 0.02)}, {"T3D2": (50, 100)}, str,
         {"T3D2": 0.06})
def rods(session, kind, n):
    time, force, velocity = impact(session, "rods", n, 1.0, 1e-4, 5.0, 0.0, 6e-4)
    touching = time[force > 0.5 * force.max()]
    middle = (time > 0.2 * 3.95e-4) & (time < 0.8 * 3.95e-4)
    return {"stress, MPa": force[middle].mean() / 1e-4 / 1e6, "duration, ms": 1e3 * (touching[-1] - touching[0]),
            "speed of leaving": velocity[-50:].mean()}


@problem("TRUSS", "rod of length 2, area 0.2 at 1.5 m/s against a rigid wall 1 mm away", "Abaqus Benchmarks, truss impact",
         {"time of impact, ms": (0.6667, 0.01), "mean force, MN": (11.85, 0.03), "duration, ms": (0.790, 0.05),
          "impulse, Ns": (9360.0, 0.01)},
         {"T3D2": (20, 40, 80)}, str, {"T3D2": 0.05})
def truss(session, kind, n):
    time, force, _ = impact(session, "truss", n, 2.0, 0.2, 1.5, 1e-3, 2e-3)
    touching = time[force > 0.5 * force.max()]
    middle = (time > 6.667e-4 + 0.2 * 7.9e-4) & (time < 6.667e-4 + 0.8 * 7.9e-4)
    impulse = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(time))
    return {"time of impact, ms": 1e3 * time[force > 0.0][0], "mean force, MN": force[middle].mean() / 1e6,
            "duration, ms": 1e3 * (touching[-1] - touching[0]), "impulse, Ns": impulse}


@problem("PEND", "point mass on a light bar of 1 m, g 9.81, released at 90 degrees", "elliptic integral",
         {"period, s": (2.36784, 1e-3), "greatest speed, m/s": (4.42945, 1e-3)}, {"T3D2": (1,)}, str, {"T3D2": 1e-3})
def pendulum(session, kind, n):
    results = session.run("pendulum", (DECKS / "pendulum.inp").read_text())
    time, x = history(results, "node_2", "U1")
    across = 1.0 + x  # zero at the bottom
    passes = [time[i] + (time[i + 1] - time[i]) * across[i] / (across[i] - across[i + 1])
              for i in range(len(time) - 1) if across[i] * across[i + 1] <= 0.0 and across[i] != across[i + 1]]
    speed = np.linalg.norm(history(results, "node_2", "V")[1], axis=1)
    return {"period, s": 2.0 * (passes[1] - passes[0]), "greatest speed, m/s": speed.max()}


@problem("DZHAN", "free rigid body, inertia (1, 2, 3), spin (0.05, 3, 0)", "Euler's equations by RK4",
         {"between flips, s": (6.3281, 0.002), "angular momentum": (6.000208, 1e-3)}, {"ROTARYI": (1, 2)}, lambda n: "dt / %d" % n,
         {"ROTARYI": 0.01})
def free_top(session, kind, n):
    """Flips are the zeros of the spin about the middle axis, seen from the body: there the energy 2 T - H w2 ... turns sign."""
    text = (DECKS / "dzhanibekov.inp").read_text().replace("5e-4, 18.", "%g, 18." % (5e-4 / n))
    text = text.replace("TIME INTERVAL=0.05", "TIME INTERVAL=0.005")
    results = session.run("free_top_%d" % n, text)
    time, spin = history(results, "node_1", "VR")
    return {"between flips, s": flips(time, spin), "angular momentum": momentum(time, spin)}


def turned(time, spin):
    """Rotation of the body at each sample: exponential maps of the spins between."""
    rotation, found = np.eye(3), [np.eye(3)]
    for i in range(len(time) - 1):
        v = 0.5 * (spin[i] + spin[i + 1]) * (time[i + 1] - time[i])
        size = np.linalg.norm(v)
        skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
        step = np.eye(3) + math.sin(size) / size * skew + (1.0 - math.cos(size)) / size**2 * skew @ skew
        rotation = step @ rotation
        found.append(rotation)
    return found


def flips(time, spin):
    middle = np.array([(r.T @ w)[1] for r, w in zip(turned(time, spin), spin)])
    zeros = [time[i] + (time[i + 1] - time[i]) * middle[i] / (middle[i] - middle[i + 1])
             for i in range(len(time) - 1) if middle[i] * middle[i + 1] < 0.0]
    return zeros[1] - zeros[0]


def momentum(time, spin):
    """Largest |H| (it is conserved; its size at the worst sample shows the error)."""
    inertia = np.diag([1.0, 2.0, 3.0])
    sizes = [np.linalg.norm(r @ inertia @ r.T @ w) for r, w in zip(turned(time, spin), spin)]
    return sizes[int(np.argmax(np.abs(np.array(sizes) - sizes[0])))]


@problem("SKID", "ring of radius 0.1 skids at 10 m/s on mu 0.4 until it rolls: hoop and disc", "v0 / (1 + I / m r^2)",
         {"hoop's speed": (5.0, 0.01), "hoop's time, s": (1.27421, 0.01),
          "disc's speed": (6.66667, 0.01), "disc's time, s": (0.84947, 0.01)},
         {"ROTARYI": (1,)}, lambda n: "360 facets")
def skid(session, kind, n):
    found = {}
    for name, inertia, speed in (("hoop", 0.01, 5.0), ("disc", 0.005, 20.0 / 3.0)):
        results = session.run("skid_" + name, explicit_cases.rolling_deck(inertia))
        time, velocity = history(results, "node_9001", "V")
        found[name + "'s speed"] = velocity[-50:, 0].mean()
        # The loss of speed is even: from its half, read where the facets' rattle does not blur it, follows the whole.
        found[name + "'s time, s"] = 2.0 * np.interp(0.5 * (10.0 + speed), velocity[::-1, 0], time[::-1])
    return found


@problem("SLIDE", "rubber block thrown at 1 m/s on mu 0.5 under gravity, after a static step", "v0^2 / 2 mu g; its kinetic energy",
         {"distance, m": (1.0 / 9.81, 0.02), "heat, J": (0.25, 0.02), "energy drift": (0.0, 0.01)}, {"C3D8R": (1,)}, lambda n: "4 x 4 x 2",
         {"C3D8R": 0.02})
def slide(session, kind, n):
    results = session.run("slide", (DECKS / "sliding_block.inp").read_text())
    moved = [results.node("U", 2, frame)[:-1, 0].mean() for frame in (0, -1)]
    heat = history(results, "energy", "ALLFD", 2)[1]
    return {"distance, m": moved[1] - moved[0], "heat, J": heat[-1] - heat[0], "energy drift": energy_drift(results, 2)}


@problem("DT-T3D2", "critical increment of one free truss, from its motion just below and just beyond", "L / c = 0.1 sqrt(7850 / 210e9)",
         {"from 0.999 dt, us": (19.33415, 1e-5), "from 1.001 dt, us": (19.33415, 1e-5)}, {"T3D2": (1,)}, str, {"T3D2": 1e-4})
def critical_increment(session, kind, n):
    """Below, the stretch is a sine whose phase t over an increment obeys cos t = 1 - 2 (dt / dtc)^2; beyond, it grows by
    the exponent g with cosh g = 2 (dt / dtc)^2 - 1."""
    template, critical = (DECKS / "truss_stability.inp").read_text(), 0.1 * math.sqrt(7850.0 / 210e9)
    found = {}
    for share in (0.999, 1.001):
        results = session.run("critical_%g" % share, template.replace("INCREMENT", "%.12e" % (share * critical)))
        stretch = history(results, "node_2", "U1")[1] - history(results, "node_1", "U1")[1]
        # Three successive samples give 2 cos t, or 2 cosh g: all samples by least squares.
        x = stretch[:60] * (-1.0) ** np.arange(60)
        doubled = np.dot(x[2:] + x[:-2], x[1:-1]) / np.dot(x[1:-1], x[1:-1])
        ratio = math.sqrt((0.5 * doubled + 1.0) / 2.0)
        found["from %g dt, us" % share] = share * critical / ratio * 1e6
    return found


OSCILLATOR = """*NODE, NSET=ALL
1, 1., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=BOB
1, 1
*MASS, ELSET=BOB
1.
*ELEMENT, TYPE=SPRING1, ELSET=SPRING
2, 1
*SPRING, ELSET=SPRING
1
1000.
{damper}*BOUNDARY
1, 2, 3
*INITIAL CONDITIONS, TYPE=VELOCITY
ALL, 1, 1e-3
*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL, ENERGY ERROR=1e30
{increment:.17g}, {end:.17g}
*BULK VISCOSITY
0., 0.
*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=ALL
U1
*END STEP
"""
DAMPER = "*ELEMENT, TYPE=DASHPOT1, ELSET=DAMPER\n3, 1\n*DASHPOT, ELSET=DAMPER\n1\n%.17g\n"


@problem("DT-MK", "critical increment of a mass 1 on a spring 1000, from its motion at 0.999 of it: damping 0 and 0.05 of critical",
         "2 / w (sqrt(1 + xi^2) - xi)", {"xi 0, s": (0.0632456, 1e-6), "xi 0.05, s": (0.0601622, 1e-5)}, {"SPRING1": (1,)}, str)
def oscillator(session, kind, n):
    """Three successive displacements give w dt and xi of x'' dt^2 + 2 xi w dt (x' dt) + (w dt)^2 x = 0, by least squares; the
    scheme, whose damping lags by half an increment, is stable for (w dt)^2 + 4 xi w dt < 4."""
    found, w = {}, math.sqrt(1000.0)
    for damping, critical in ((0.0, 0.0632456), (0.05, 0.0601622)):
        increment = 0.999 * critical
        deck = OSCILLATOR.format(damper=DAMPER % (2.0 * damping * w) if damping else "", increment=increment, end=60.5 * increment)
        x = history(session.run("oscillator_%g" % damping, deck), "node_1", "U1")[1][:60]
        matrix = -np.stack([x[1:-1], x[1:-1] - x[:-2]], axis=1)
        columns = matrix if damping else matrix[:, :1]
        fitted = np.linalg.lstsq(columns, x[2:] - 2.0 * x[1:-1] + x[:-2], rcond=None)[0]
        stiffness, friction = fitted[0], fitted[1] if damping else 0.0
        share = math.sqrt(stiffness)
        xi = 0.5 * friction / share
        found["xi %g, s" % damping] = increment * 2.0 * (math.sqrt(1.0 + xi * xi) - xi) / share
    return found


@problem("ENERGY", "a soft block tumbles freely", "conservation", {"energy drift": (0.0, 1e-3)}, {kind: (1,) for kind in ("C3D8", "C3D8R")},
         lambda n: "4 x 4 x 4", {"C3D8R": 1e-3})
def energy(session, kind, n):
    return {"energy drift": energy_drift(session.run("tumbling_" + kind, (DECKS / "free_flight.inp").read_text().replace("C3D8R", kind)))}
