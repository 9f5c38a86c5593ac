#!/usr/bin/env python3
"""Laws that know time: Prony series and yield that depends on rates, explicit and implicit: viscous_cases.py CASE BALOCCO FOLDER."""
import numpy as np

from job import check, run_case

SOLIDS, SHELLS, MEMBRANES, BARS = ("C3D8", "C3D8R"), ("S4R", "S4"), ("M3D4",), ("T3D2", "B31")
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
BRICK = [(x, y, z) for z in (0, 1) for x, y in SQUARE]
SHEET = [(x, 0, z) for x, z in SQUARE]
BAR = [(0, 0, 0), (0, 0, 1)]
SECTIONS = {**dict.fromkeys(SOLIDS, (BRICK, "SOLID SECTION", "")), **dict.fromkeys(SHELLS, (SHEET, "SHELL SECTION", "1.\n")),
            "M3D4": (SHEET, "MEMBRANE SECTION", "1.\n"), "T3D2": (BAR, "SOLID SECTION", "1.\n"),
            "B31": (BAR, "BEAM SECTION, SECTION=RECT", "1., 1.\n1., 0., 0.\n")}
KINDS = tuple(SECTIONS)
FEW_FRAMES = "*OUTPUT, FIELD, NUMBER INTERVAL=1\n*NODE OUTPUT\nU\n"
ENERGIES = "*ENERGY OUTPUT\nALLIE, ALLVD, ALLWK, ALLKE, ETOTAL\n"


def first_node(kind):
    return 10 * KINDS.index(kind) + 1


def nodes_where(kind, holds):
    return [first_node(kind) + i for i, place in enumerate(SECTIONS[kind][0]) if holds(*place)]


def top(kind):
    return nodes_where(kind, lambda x, y, z: z == 1)


def mesh(*kinds):
    """Unit elements side by side that stand on the plane z = 0, all of the material M; what turns does not."""
    text = ""
    for kind in kinds:
        places, section, data = SECTIONS[kind]
        first = first_node(kind)
        nodes = range(first, first + len(places))
        text += "*NODE\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in zip(nodes, places))
        text += f"*ELEMENT, TYPE={kind}, ELSET={kind}\n{first}, {', '.join(map(str, nodes))}\n*{section}, ELSET={kind}, MATERIAL=M\n{data}"
        for name, height in (("BOTTOM", 0), ("TOP", 1)):
            text += f"*NSET, NSET={name}\n{', '.join(str(n) for n in nodes_where(kind, lambda x, y, z: z == height))}\n"
        if kind in SHELLS + ("B31",):
            text += "*BOUNDARY\n" + "".join(f"{n}, 4, 6\n" for n in nodes)
    return text


def closed_loop(run):
    """Sheared, pressed, let back in the same order, so slowly or fast that nothing or everything relaxes: the work is nil, the energy
    of the branches goes nowhere else, and what is dissipated grows alone."""
    elastic, rubber = "*ELASTIC{0}\n10., 0.3\n", "*HYPERELASTIC, NEO HOOKE{0}\n2., 0.2\n"
    kept, relaxed, between = (1e5, ""), (5e-4, ", MODULI=INSTANTANEOUS"), (1.0, "")
    for kind, name, law, times in (("C3D8R", "elastic", elastic, (kept, relaxed, between)), ("C3D8R", "rubber", rubber, (kept,)),
                                   ("S4R", "elastic", elastic, (kept,))):
        for time, moduli in times:
            deck = mesh(kind) + f"""*MATERIAL, NAME=M
*DENSITY
1e-6
{law.format(moduli)}*VISCOELASTIC, TIME=PRONY
0.7, 0., {time}
*AMPLITUDE, NAME=SHEAR
0, 0, 1, 1, 2, 1, 3, 0
4, 0
*AMPLITUDE, NAME=PRESS
0, 0, 1, 0, 2, 1, 3, 1
4, 0
*STEP, NLGEOM
*DYNAMIC, EXPLICIT
, 4.
*BULK VISCOSITY
0., 0.
*FIXED MASS SCALING, FACTOR=100.
*BOUNDARY
BOTTOM, 1, 3
TOP, 2
*BOUNDARY, AMPLITUDE=SHEAR
TOP, 1, 1, 0.4
*BOUNDARY, AMPLITUDE=PRESS
TOP, 3, 3, -0.3
{FEW_FRAMES}*OUTPUT, HISTORY, NUMBER INTERVAL=16
{ENERGIES}*END STEP
"""
            job = run(deck, 1)
            stored, lost, work, total = (job.history("energy", e)[1] for e in ("ALLIE", "ALLVD", "ALLWK", "ETOTAL"))
            most, what = stored.max(), f"{kind} {name} {time:g} s"
            check(f"{what}: energy kept", np.abs(total - total[0]).max() / most, 0.0, 1e-6)
            check(f"{what}: steepest fall of what is dissipated", min(np.diff(lost).min(), 0.0) / most, 0.0, 1e-12)
            check(f"{what}: stored beyond the work done", max((stored - work).max(), 0.0) / most, 0.0, 1e-6)
            if time == 1.0:
                check(f"{what}: work is dissipated", float(work[-1] > 0.1 * most), 1.0, 0.0)
            else:
                check(f"{what}: work of the loop", work[-1] / most, 0.0, 1e-2)
            if time == 1e5:
                check(f"{what}: nothing is dissipated", lost[-1] / most, 0.0, 1e-4)


IMPLICIT, EXPLICIT = "*DYNAMIC, DIRECT\n0.05, {}", "*DYNAMIC, EXPLICIT\n, {}"
HISTORY = FEW_FRAMES + "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=TOP\nU3, RF1, RF3\n"


def reaction(job, kind, axis, step=1):
    histories = [job.history(f"node_{node}", f"RF{axis}", step) for node in top(kind)]
    return histories[0][0], sum(values for _, values in histories)


def relaxation(run):
    """A strain that comes quickly and is held: the force falls with the series in implicit steps, explicit ones and from one to the
    other. Solids and membranes are sheared, shells and bars of a material that keeps its volume are pulled."""
    held, rise = 0.002, 0.05
    elastic, rubber = "*ELASTIC\n{young!r}, {poisson!r}\n", "*HYPERELASTIC, NEO HOOKE\n2., {compressibility!r}\n"
    for kinds, law, axis, bulk, modulus in (
        (SOLIDS + MEMBRANES, elastic, 1, 20.0, 4.0), (SOLIDS + MEMBRANES, rubber, 1, 20.0, 4.0), (SHELLS + BARS, elastic, 3, 1e4, 12.0)):
        moduli = {"young": 36.0 * bulk / (3.0 * bulk + 4.0), "poisson": (3.0 * bulk - 8.0) / (6.0 * bulk + 8.0), "compressibility": 2.0 / bulk}
        model = mesh(*kinds) + f"""*MATERIAL, NAME=M
*DENSITY
2e-5
{law.format(**moduli)}*VISCOELASTIC, TIME=PRONY
0.3, 0., 0.1
0.4, 0., 2.
*AMPLITUDE, NAME=QUICKLY, TIME=TOTAL TIME
0., 0., {rise}, 1., 100., 1.
"""
        held_nodes = "BOTTOM, 3\n" + "".join(map(free_sideways, kinds)) if axis == 3 else "BOTTOM, 1, 3\nTOP, 2, 3\n"
        moved = f"*BOUNDARY\n{held_nodes}*BOUNDARY, AMPLITUDE=QUICKLY\nTOP, {axis}, {axis}, {held}\n"
        procedures = (IMPLICIT.format(1.0), EXPLICIT.format(0.1), IMPLICIT.format(2.9))
        job = run(model + "".join(f"*STEP, NLGEOM, INC=1000\n{p}\n{moved}{HISTORY}*END STEP\n" for p in procedures), 1)
        for kind in kinds:
            for step in (1, 2, 3):
                time, force = reaction(job, kind, axis, step)
                relaxing = sum(g * t / rise * np.expm1(rise / t) * np.exp(-time / t) for g, t in ((0.3, 0.1), (0.4, 2.0)))
                exact = modulus * held * (1.0 + relaxing / 0.3)
                late = time > max(1.5 * rise, time[0])  # a step's first instant stops velocities
                check(f"{kind}, step {step}: force", np.abs(force / exact - 1.0)[late].max(), 0.0, 0.01)


def free_sideways(kind):
    """Conditions that let an element become thinner, but not wander."""
    if kind in BARS:
        return "".join(f"{n}, 1, 2\n" for n in nodes_where(kind, lambda x, y, z: True))
    held = "".join(f"{n}, 1\n" for n in nodes_where(kind, lambda x, y, z: x == 0))
    return held + "".join(f"{n}, 2\n" for n in nodes_where(kind, lambda x, y, z: y == 0))


def free_vibration(run):
    """A mass on a relaxing brick that is held sideways: m s^2 + K + 4/3 G (1 + r s t / (1 + s t)) = 0 has three poles."""
    shear, bulk, time, ratio, speed, mass = 50.0, 100.0 / 3.0, 0.1, 1.0, 0.01, 1.0 + 0.5e-3
    lag = np.array([time, 1.0])
    characteristic = np.polyadd(np.polymul([mass, 0.0, bulk], lag), 4.0 / 3.0 * shear * np.array([time * (1.0 + ratio), 1.0]))
    poles = np.roots(characteristic)
    masses = "".join(f"*ELEMENT, TYPE=MASS, ELSET=MASS\n{100 + n}, {n}\n" for n in top("C3D8"))
    model = mesh("C3D8") + f"""{masses}*MASS, ELSET=MASS
0.25
*MATERIAL, NAME=M
*DENSITY
1e-3
*ELASTIC
100., 0.
*VISCOELASTIC, TIME=PRONY
0.5, 0., {time}
*INITIAL CONDITIONS, TYPE=VELOCITY
TOP, 3, {speed}
*STEP, NLGEOM, INC=10000
*DYNAMIC, DIRECT, ALPHA=0.
0.005, 1.5
*BOUNDARY
BOTTOM, 1, 3
TOP, 1, 2
{HISTORY}{ENERGIES}*END STEP
"""
    job = run(model, 1)
    t, motion = job.history(f"node_{top('C3D8')[0]}", "U3")
    exact = sum(mass * speed * np.polyval(lag, p) / np.polyval(np.polyder(characteristic), p) * np.exp(p * t) for p in poles).real
    check("largest error of the motion", np.abs(motion - exact).max() / np.abs(exact).max(), 0.0, 5e-3)
    check("what is left after 1.3 s", np.abs(motion[t > 1.3]).max() / np.abs(exact[t > 1.3]).max(), 1.0, 0.02)
    lost = job.history("energy", "ALLVD")[1]
    check("what is dissipated", lost[-1] / (0.5 * mass * speed**2), 1.0, 0.02)
    check("steepest fall of it", min(np.diff(lost).min(), 0.0), 0.0, 1e-15)
    total = job.history("energy", "ETOTAL")[1]
    check("energy kept", np.abs(total - total[0]).max() / total.max(), 0.0, 5e-3)


def yield_at_rate(run):
    """A bar pulled at a steady speed in implicit dynamics: its yield stress is the table's times 1 + (rate / D)^(1/n); statics stay at rate
    zero and say so."""
    law = """*MATERIAL, NAME=M
*DENSITY
1e-2
*ELASTIC
1e5, 0.3
*PLASTIC
100., 0.
*RATE DEPENDENT
40., 5.
*AMPLITUDE, NAME=STEADY
0, 0, 1, 1
*BOUNDARY
BOTTOM, 3
"""
    model = mesh(*KINDS) + law + "".join(map(free_sideways, KINDS))
    for procedure, follows in {"*DYNAMIC, DIRECT": True, "*STATIC, DIRECT": False}.items():
        step = f"*STEP, NLGEOM, INC=1000\n{procedure}\n0.01, 1.\n*BOUNDARY, AMPLITUDE=STEADY\nTOP, 3, 3, 0.1\n{HISTORY}*END STEP\n"
        job = run(model + step, 1)
        check(f"{procedure}: notes", job.log().count("yields as at rate zero"), 0 if follows else 1, 0.0)
        for kind in KINDS:
            time, force = reaction(job, kind, 3)
            stretch, late = 1.0 + 0.1 * time, time > 0.1
            exact = 100.0 * (1.0 + follows * (0.1 / stretch / 40.0)**0.2) / stretch
            check(f"{kind} {procedure}: force", np.abs(force / exact - 1.0)[late].max(), 0.0, 5e-3)


if __name__ == "__main__":
    run_case(globals())
