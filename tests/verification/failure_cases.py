#!/usr/bin/env python3
"""*SHEAR FAILURE and element deletion: failure_cases.py CASE BALOCCO FOLDER."""
import math
import shutil
import subprocess

import h5py
import numpy as np

from job import UNIT_CUBE, check, run_case
from launch import on_ranks

YOUNG, YIELD, FAILURE, DENSITY = 200e3, 400.0, 0.05, 7.8e-9

STEEL = f"""*MATERIAL, NAME=M
*DENSITY
{DENSITY}
*ELASTIC
{YOUNG}, 0.3
*PLASTIC
{YIELD}, 0.
*SHEAR FAILURE
{FAILURE}
"""

CUBE = UNIT_CUBE + """*ELEMENT, TYPE=C3D8R, ELSET=BODY
1, 1, 2, 3, 4, 5, 6, 7, 8
*SOLID SECTION, ELSET=BODY, MATERIAL=M
*BOUNDARY
1, 2, 3
2, 2, 3
4, 3
3, 3
5, 2
6, 2
"""
SHEET = """*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
*NSET, NSET=LEFT
1, 4
*NSET, NSET=RIGHT
2, 3
*ELEMENT, TYPE=S4R, ELSET=BODY
1, 1, 2, 3, 4
*SHELL SECTION, ELSET=BODY, MATERIAL=M
1., 5
*BOUNDARY
ALL, 3, 6
1, 2
2, 2
"""
ROD = """*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
*NSET, NSET=LEFT
1
*NSET, NSET=RIGHT
2
*ELEMENT, TYPE=T3D2, ELSET=BODY
1, 1, 2
*SOLID SECTION, ELSET=BODY, MATERIAL=M
1.
*BOUNDARY
ALL, 2, 3
"""


def element_frames(job, kind, variable):
    with h5py.File(job.folder / f"{job.name}.h5") as file:
        frames = sorted((k for k in file["step_1"] if k.startswith("frame_")), key=lambda k: int(k[6:]))
        return np.array([np.array(file[f"step_1/{frame}/element/{kind}/{variable}"]).ravel() for frame in frames])


def pulled(run):
    """One element pulled slowly: it fails where ln(1 + u) = yield / E + failure strain, gives its elastic energy up, and is gone: no
    force, STATUS 0, its mass at its nodes."""
    for kind, mesh in (("C3D8R", CUBE), ("S4R", SHEET), ("T3D2", ROD)):
        speed, end = 100.0, 1e-3
        job = run(mesh + STEEL + f"""*BOUNDARY
LEFT, 1
*STEP
*DYNAMIC, EXPLICIT
, {end}
*BOUNDARY, TYPE=VELOCITY
RIGHT, 1, 1, {speed}
*OUTPUT, FIELD, NUMBER INTERVAL=100, PRECISION=DOUBLE
*NODE OUTPUT
U, RF
*ELEMENT OUTPUT
STATUS, PEEQ, MISES, PE
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLIE, ALLPD, ALLSE, ALLWK, ALLAE, ALLKE, ETOTAL
*END STEP
""", 1)
        status = element_frames(job, kind, "STATUS")[:, 0]
        first = int(np.argmin(status))
        expected = math.exp(YIELD / YOUNG + FAILURE) - 1.0
        check(f"{kind}: strain at failure", job.frame("U", first)[1, 0], expected, 0.02)
        check(f"{kind}: STATUS before and after", status[:first].min() - status[first:].max(), 1.0, 0.0)
        left = [0, 3, 4, 7] if kind == "C3D8R" else [0, 3] if kind == "S4R" else [0]
        force = [abs(job.frame("RF", frame)[left, 0].sum()) for frame in (first - 2, first + 1)]
        check(f"{kind}: force before", force[0], YIELD / (1.0 + job.frame("U", first - 2)[1, 0]), 5e-3)
        check(f"{kind}: force after", force[1], 0.0, 0.0)
        check(f"{kind}: stress after", np.abs(element_frames(job, kind, "MISES")[first:]).max(), 0.0, 0.0)
        if kind != "T3D2":
            strain = element_frames(job, kind, "PE")[first - 2]
            peeq = element_frames(job, kind, "PEEQ")[first - 2][0]
            check(f"{kind}: plastic strain along", strain[0] / peeq, 1.0, 1e-3)
            check(f"{kind}: plastic strain across", strain[2] / peeq, -0.5, 1e-3)
        plastic, work = job.history("energy", "ALLPD")[1], job.history("energy", "ALLWK")[1]
        given_up = YIELD * FAILURE + YIELD ** 2 / (2.0 * YOUNG)
        check(f"{kind}: dissipated with what was elastic", plastic[-1], given_up, 0.01)
        check(f"{kind}: elastic energy left", job.history("energy", "ALLSE")[1][-1], 0.0, 0.0)
        total = job.history("energy", "ETOTAL")[1]
        check(f"{kind}: energy balance", np.abs(total - total[0]).max() / work.max(), 0.0, 0.01)
        check(f"{kind}: told in .log", float("1 elements have failed and are deleted" in job.log()), 1.0, 0.0)
        lines = (job.folder / f"{job.name}.sta").read_text().splitlines()
        check(f"{kind}: column of .sta", float([line for line in lines if line.strip()[:1].isdigit()][-1].split()[-1]), 1.0, 0.0)


def torn(kind):
    """A strip of n x m whose middle is narrower, torn from its upper side in two steps; solid or shell."""
    n, m, solid = 12, 6, kind == "C3D8R"
    layers = 2 if solid else 1
    text = "*NODE, NSET=ALL\n"
    number = lambda i, j, k: 1 + i + (n + 1) * (j + (m + 1) * k)
    for k in range(layers):
        for j in range(m + 1):
            for i in range(n + 1):
                text += f"{number(i, j, k)}, {i}, {j * (0.7 if i in (6, 7) else 1.0)}, {k}\n"
    for name, i in (("LEFT", 0), ("RIGHT", n)):
        text += f"*NSET, NSET={name}\n" + "".join(f"{number(i, j, k)}\n" for j in range(m + 1) for k in range(layers))
    text += f"*ELEMENT, TYPE={kind}, ELSET=BODY\n"
    for j in range(m):
        for i in range(n):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            nodes = [number(a, b, k) for k in range(layers) for a, b in corners]
            text += f"{1 + i + n * j}, " + ", ".join(map(str, nodes)) + "\n"
    text += "*SOLID SECTION, ELSET=BODY, MATERIAL=M\n" if solid else "*SHELL SECTION, ELSET=BODY, MATERIAL=M\n1., 5\n"
    step = """*STEP, NAME={name}
*DYNAMIC, EXPLICIT
, {end}
*BOUNDARY, TYPE=VELOCITY
{pulled}*OUTPUT, FIELD, NUMBER INTERVAL=5, PRECISION=DOUBLE
*NODE OUTPUT
U, V
*ELEMENT OUTPUT
STATUS, PEEQ
*OUTPUT, HISTORY, NUMBER INTERVAL=20
*ENERGY OUTPUT
ALLIE, ALLPD, ALLWK, ALLKE, ALLAE, ETOTAL
*END STEP
"""
    pulled = "".join(f"{number(n, j, k)}, 1, 1, {2e3 + 8e3 * j / m}\n" for j in range(m + 1) for k in range(layers))
    return text + STEEL + "*BOUNDARY\nLEFT, 1, 3\n" + "".join(step.format(name=name, end=4e-5 if solid else 2.4e-5, pulled=pulled) for name in ("FIRST", "SECOND"))


def preloaded(run):
    """A static step may preload what an explicit step then tears, at the same strain; elements that it strains as far end it."""
    folder = None
    for kind, mesh in (("C3D8R", CUBE), ("T3D2", ROD)):
        strain = FAILURE + YIELD / YOUNG
        pull = lambda reach: "*STEP, NLGEOM\n*STATIC\n0.1, 1.\n*BOUNDARY\nLEFT, 1\nRIGHT, 1, 1, %.15g\n*END STEP\n" % math.expm1(reach * strain)
        tear = ("*AMPLITUDE, NAME=PULL, DEFINITION=SMOOTH STEP\n0., %.15g, 1e-3, 0.1\n*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n"
                "*BOUNDARY, AMPLITUDE=PULL\nRIGHT, 1, 1, 1.\n*OUTPUT, FIELD, NUMBER INTERVAL=50\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\nSTATUS\n"
                "*END STEP\n" % math.expm1(0.2 * strain))
        job = run(mesh + STEEL + pull(0.2) + tear, 1)
        folder = job.folder
        with h5py.File(folder / f"{job.name}.h5") as file:
            frames = sorted((k for k in file["step_2"] if k.startswith("frame_")), key=lambda k: int(k[6:]))
            status = np.array([np.array(file[f"step_2/{f}/element/{kind}/STATUS"]).ravel()[0] for f in frames])
            moved = np.array([np.array(file[f"step_2/{f}/node/U"])[1, 0] for f in frames])
        check("%s stands after the preload" % kind, status[0], 1.0, 0.0)
        check("%s fails" % kind, status[-1], 0.0, 0.0)
        gone = int(np.argmin(status))
        check("%s fails where it must" % kind, float(moved[gone - 1] <= math.expm1(strain) <= moved[gone] * (1.0 + 1e-9)), 1.0, 0.0)
        (folder / "too_far.inp").write_text(mesh + STEEL + pull(1.5))
        done = subprocess.run([*on_ranks(2), job.balocco, "run", str(folder / "too_far.inp"), "--output", str(folder)], capture_output=True, text=True)
        check("too far: status", done.returncode, 3.0, 0.0)
        check("too far: told", (done.stdout + done.stderr).count("the plastic strain of *SHEAR FAILURE is reached in 1 element, which static does not delete"), 1.0, 0.0)


def ranks(run):
    """A strip that tears has the same bits on one, two and three ranks, and after a restart between the ranks' numbers."""
    for kind in ("C3D8R", "S4R"):
        jobs = [run(torn(kind), count, f"{kind}_on_{count}") for count in ((1, 2, 3) if kind == "S4R" else (1, 2))]
        with h5py.File(jobs[0].folder / f"{jobs[0].name}.h5") as file:
            status = []
            for step in ("step_1", "step_2"):
                frames = sorted((k for k in file[step] if k.startswith("frame_")), key=lambda k: int(k[6:]))
                status.append(np.array(file[f"{step}/{frames[-1]}/element/{kind}/STATUS"]).ravel())
        gone = [int((s == 0.0).sum()) for s in status]
        check(f"{kind}: some tear in the first step", float(0 < gone[0] < len(status[0])), 1.0, 0.0)
        check(f"{kind}: more in the second, none comes back", float(gone[1] > gone[0] and np.all(status[1] <= status[0])), 1.0, 0.0)
        total = np.concatenate([jobs[0].history("energy", "ETOTAL", step)[1] for step in (1, 2)])
        work = jobs[0].history("energy", "ALLWK", 2)[1].max()
        check(f"{kind}: energy lost", max(0.0, (total[0] - total).max()) / work, 0.0, 0.01)
        check(f"{kind}: energy created", max(0.0, (total - total[0]).max()) / work, 0.0, 0.01)
        restarted = jobs[0].folder.parent / f"restarted_{kind}"
        shutil.rmtree(restarted, ignore_errors=True)
        deck = jobs[0].folder / f"{jobs[0].name}.inp"
        for count, extra in (("2", ["--until", "FIRST"]), ("3", ["--restart"])):
            subprocess.run([*on_ranks(count), jobs[0].balocco, "run", str(deck), "--output", str(restarted)] + extra,
                           check=True, capture_output=True, timeout=150)
        others = [job.folder / f"{job.name}.h5" for job in jobs[1:]] + [restarted / f"{jobs[0].name}.h5"]
        for other in others:
            same = subprocess.run(["h5diff", str(jobs[0].folder / f"{jobs[0].name}.h5"), str(other)], capture_output=True)
            check(f"{kind}: the same bits in {other.parent.name}/{other.name}", float(same.returncode), 0.0, 0.0)


if __name__ == "__main__":
    run_case(globals())
