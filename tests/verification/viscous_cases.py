#!/usr/bin/env python3
"""Laws that know time: viscous_cases.py CASE BALOCCO FOLDER."""
import numpy as np

from explicit_cases import check, run_case

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


if __name__ == "__main__":
    run_case(globals())
