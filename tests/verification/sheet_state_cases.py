#!/usr/bin/env python3
"""Initial stress and hardening of shells, and what presses them out of their plane: sheet_state_cases.py CASE BALOCCO FOLDER."""
import math

import h5py
import numpy as np

from job import check, run_case

FIELD = """*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF
*ELEMENT OUTPUT
S, PEEQ
"""


def sheet(kind, count, across, length, width, section, z=0.0):
    """A rectangle from the origin, with its edges as sets LEFT, RIGHT, FRONT and BACK."""
    number = lambda i, j: 1 + i + (count + 1) * j
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{number(i, j)}, {length * i / count}, {width * j / across}, {z}" for j in range(across + 1) for i in range(count + 1)]
    edges = {"LEFT": [number(0, j) for j in range(across + 1)], "RIGHT": [number(count, j) for j in range(across + 1)],
             "FRONT": [number(i, 0) for i in range(count + 1)], "BACK": [number(i, across) for i in range(count + 1)]}
    for name, nodes in edges.items():
        lines += [f"*NSET, NSET={name}"] + [", ".join(map(str, nodes[k:k + 12])) for k in range(0, len(nodes), 12)]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=SHEET")
    element = 0
    for j in range(across):
        for i in range(count):
            corners = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
            for part in ([corners] if kind != "S3R" else [corners[:3], [corners[0], *corners[2:]]]):
                element += 1
                lines.append(f"{element}, " + ", ".join(map(str, part)))
    return "\n".join(lines) + f"\n{section}\n", edges


def stress_of(job, kind, step=1, variable="S"):
    with h5py.File(job.folder / f"{job.name}.h5") as file:
        frames = sorted((k for k in file[f"step_{step}"] if k.startswith("frame_")), key=lambda k: int(k[6:]))
        return np.array(file[f"step_{step}/{frames[-1]}/element/{kind}/{variable}"])


ELASTIC = "*SHELL SECTION, ELSET=SHEET, MATERIAL=M\n{thickness}, 5\n*MATERIAL, NAME=M\n*DENSITY\n1e-3\n*ELASTIC\n{young}, {ratio}"


def held_and_let_go(run):
    """Between held ends a stress stays and pulls at them, also in an explicit step that statics hand it on to; one that changes through
    the thickness bends a strip into an arc of the radius that its moment wants."""
    young, thickness, length, stress = 1000.0, 0.1, 10.0, 0.5
    for kind in ("S4R", "S4", "S3R"):
        mesh, edges = sheet(kind, 20, 2, length, 1.0, ELASTIC.format(thickness=thickness, young=young, ratio=0.0))
        deck = mesh + f"""*INITIAL CONDITIONS, TYPE=STRESS
SHEET, {stress}
*STEP, NLGEOM
*STATIC
1., 1.
*BOUNDARY
LEFT, 1, 6
RIGHT, 1, 6
{FIELD}*END STEP
*STEP
*DYNAMIC, EXPLICIT
, 1e-2
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLKE
*END STEP
"""
        job = run(deck, 2)
        pull = job.frame("RF", -1)[[node - 1 for node in edges["RIGHT"]], 0].sum()
        check(f"{kind}: pull of held ends", pull, stress * thickness, 1e-10)
        check(f"{kind}: stress between them", np.abs(stress_of(job, kind)[..., 0] - stress).max(), 0.0, 1e-10)
        check(f"{kind}: nothing starts to move", np.abs(job.history("energy", "ALLKE", 2)[1]).max(), 0.0, 1e-18)
        # Simpson's five points from SNEG to SPOS.
        points = "".join(f"SHEET, {point + 1}, {stress * (0.5 * point - 1.0)}\n" for point in range(5))
        job = run(mesh + f"""*INITIAL CONDITIONS, TYPE=STRESS, SECTION POINTS
{points}*STEP, NLGEOM
*STATIC
0.25, 1.
*BOUNDARY
LEFT, 1, 6
{FIELD}*END STEP
""", 1)
        curvature = 2.0 * stress / (young * thickness)
        tip = job.frame("U", -1)[[node - 1 for node in edges["RIGHT"]]].mean(axis=0)
        check(f"{kind}: rise of the arc", abs(tip[2]), (1.0 - math.cos(curvature * length)) / curvature, 1e-3)
        check(f"{kind}: its end comes back", -tip[0], length - math.sin(curvature * length) / curvature, 1e-2)
        check(f"{kind}: what is left of the stress", np.abs(stress_of(job, kind)[..., 0]).max() / stress, 0.0, 2e-3)


def yielding(run):
    """An initial stress counts for yielding: a strip of it reaches the yield stress by what lacks; hardening is where its table says."""
    steel = "*MATERIAL, NAME=M\n*DENSITY\n1e-3\n*ELASTIC\n1000., 0.\n*PLASTIC\n1., 0.\n2., 1."
    sections = {"S4R": "*SHELL SECTION, ELSET=SHEET, MATERIAL=M\n0.1, 3\n", "S3R": "*SHELL SECTION, ELSET=SHEET, MATERIAL=M\n0.1, 3\n",
                "M3D4R": "*MEMBRANE SECTION, ELSET=SHEET, MATERIAL=M\n0.1\n"}
    for kind, section in sections.items():
        mesh, _ = sheet(kind, 2, 1, 2.0, 1.0, section + steel)
        turns = "ALL, 3, 6\n" if kind[0] == "S" else "ALL, 3\n"

        def pulled(strain, initial, shown="PEEQ", kind=kind, mesh=mesh, turns=turns):
            job = run(mesh + initial + f"*BOUNDARY\nLEFT, 1\nFRONT, 2\n{turns}*STEP, NLGEOM\n*STATIC\n0.25, 1.\n*BOUNDARY\nRIGHT, 1, 1, {2.0 * strain}\n{FIELD}*END STEP\n", 1)
            return stress_of(job, kind)[..., 0].ravel(), stress_of(job, kind, variable=shown).ravel()

        stressed = "*INITIAL CONDITIONS, TYPE=STRESS\nSHEET, 0.8\n"
        check(f"{kind}: at rest", np.abs(pulled(0.0, stressed)[0] - 0.8).max(), 0.0, 1e-12)
        thrown = run(mesh + stressed + f"*BOUNDARY\nLEFT, 1, 2\nRIGHT, 1, 2\n{turns}*STEP\n*DYNAMIC, EXPLICIT\n, 1e-2\n"
                     "*OUTPUT, HISTORY, FREQUENCY=1\n*ENERGY OUTPUT\nALLKE\n*END STEP\n", 1)
        check(f"{kind}: nothing starts to move", thrown.history("energy", "ALLKE")[1].max(), 0.0, 1e-20)
        stress, plastic = pulled(1e-4, stressed)
        check(f"{kind}: below the yield stress", np.abs(stress - 0.9).max(), 0.0, 5e-4)
        check(f"{kind}: no plastic strain", plastic.max(), 0.0, 0.0)
        stress, plastic = pulled(1e-2, stressed)  # 0.8 + 1000 (e - p) = 1 + p
        flow = (0.8 - 1.0 + 1000.0 * math.log(1.01)) / 1001.0
        check(f"{kind}: plastic strain", np.abs(plastic / flow - 1.0).max(), 0.0, 5e-3)
        check(f"{kind}: stress", np.abs(stress - 1.0 - flow).max(), 0.0, 2e-2)
        hard = "*INITIAL CONDITIONS, TYPE=HARDENING\nSHEET, 0.5\n"
        stress, plastic = pulled(1e-2, hard)
        check(f"{kind}: hardened", np.abs(stress - 1.5).max(), 0.0, 3e-2)
        check(f"{kind}: it begins there", plastic.min() - 0.5, math.log(1.01) - 1.5e-3, 2e-2)
        if kind[0] != "S":
            continue
        for point, name in enumerate(("PEEQ_BOT", "PEEQ_TOP")):
            plastic = pulled(1e-4, "*INITIAL CONDITIONS, TYPE=HARDENING, SECTION POINTS\nSHEET, 1, 0.2\nSHEET, 3, 0.4\n", name)[1]
            check(f"{kind}: {name}", np.abs(plastic - (0.2, 0.4)[point]).max(), 0.0, 0.0)


def buckled(run):
    """Load factors of thin square plates on simple supports, pressed along one axis: N = 4 pi^2 D / b^2; of a cross-ply laminate
    (pi / b)^2 (D11 + 2 (D12 + 2 D66) + D22) in one half wave. And pulled as well they buckle where they are pressed."""
    young, ratio, width, thickness, count = 1e6, 0.3, 1.0, 0.01, 16
    plate = ELASTIC.format(thickness=thickness, young=young, ratio=ratio)
    lamina = "*SHELL SECTION, ELSET=SHEET, COMPOSITE\n" + "".join(f"{thickness / 4}, 3, M, {angle}\n" for angle in (0, 90, 90, 0)) + \
        "*MATERIAL, NAME=M\n*ELASTIC, TYPE=LAMINA\n1e6, 1e5, 0.25, 5e4, 5e4, 5e4"
    of_plate = 4.0 * math.pi**2 * young * thickness**3 / (12.0 * (1.0 - ratio**2)) / width**2
    factor = 1.0 - 0.25**2 * 0.1
    q11, q22, q12, q66 = 1e6 / factor, 1e5 / factor, 0.25 * 1e5 / factor, 5e4
    outer, inner = thickness**3 / 12.0 * 7.0 / 8.0, thickness**3 / 12.0 / 8.0
    d11, d22 = outer * q11 + inner * q22, outer * q22 + inner * q11
    d12, d66 = (outer + inner) * q12, (outer + inner) * q66
    of_laminate = (math.pi / width)**2 * (d11 + 2.0 * (d12 + 2.0 * d66) + d22)
    for kind, section, expected in (("S4R", plate, of_plate), ("S4", plate, of_plate), ("S3R", plate, of_plate), ("S4R", lamina, of_laminate)):
        mesh, edges = sheet(kind, count, count, width, width, section)
        share = [width / count * (0.5 if node in (edges["RIGHT"][0], edges["RIGHT"][-1]) else 1.0) for node in edges["RIGHT"]]
        press = "".join(f"{node}, 1, {-part}\n{back}, 1, {part}\n" for node, back, part in zip(edges["RIGHT"], edges["LEFT"], share))
        deck = mesh + "".join(f"*BOUNDARY\n{edge}, 3\n" for edge in edges) + f"*BOUNDARY\n1, 1, 2\n{count + 1}, 2\n*STEP\n*BUCKLE\n1\n*CLOAD\n{press}*END STEP\n"
        job = run(deck, 2 if kind == "S4" else 1)
        with h5py.File(job.folder / f"{job.name}.h5") as file:
            found = file["step_1/mode_1"].attrs["eigenvalue"]
        check(f"{kind}, {'laminate' if section == lamina else 'plate'}: load factor", found / expected, 1.0, 3e-2 if kind == "S3R" else 1.5e-2)


if __name__ == "__main__":
    run_case(globals())
