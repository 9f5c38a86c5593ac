#!/usr/bin/env python3
"""*FIXED and *VARIABLE MASS SCALING against closed forms.

usage: mass_scaling_cases.py CASE BALOCCO FOLDER      exit status 0: everything within tolerance
"""
import math
import pathlib
import subprocess
import sys

import numpy as np

from constraint_cases import KINEMATIC, bar_with_end
from job import UNIT_CUBE, Job, check, failures
from import_cases import BUSHING, LOADS

STEEL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7800.\n"
SPEED = math.sqrt(2.1e11 / 7800.0)
NO_VISCOSITY = "*BULK VISCOSITY\n0., 0.\n"
CHOSEN = 0.9  # of the stable increment of the elements is what a step takes


class Runner:
    def __init__(self, case, balocco, folder):
        self.case, self.balocco, self.folder = case, balocco, pathlib.Path(folder)
        self.count = 0

    def job(self, text, ranks=1, place=None, arguments=(), expected_status=0):
        self.count += 1
        job = Job(self.case if place else f"{self.case}_{self.count}", self.balocco, str(ranks), self.folder / (place or ""))
        job.run(text, expected_status, arguments)
        return job

    def same(self, a, b):
        command = [self.balocco, "diff", str(a.folder / f"{a.name}.h5"), str(b.folder / f"{b.name}.h5")]
        done = subprocess.run(command, capture_output=True, text=True)
        print(done.stdout[-600:] if done.returncode else "")
        return float(done.returncode == 0)


def status(job, column, step=1):
    """A column of the .sta of an explicit step, by its title."""
    lines = (job.folder / f"{job.name}.sta").read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(f"Step {step} "))
    titles = lines[start + 1].replace("STEP TIME", "STEP_TIME").replace("TOTAL TIME", "TOTAL_TIME").replace("TIME INC", "TIME_INC")
    titles = titles.replace("ADDED MASS %", "ADDED_MASS_%").replace("ERROR %", "ERROR_%").replace("WALL S", "WALL_S").replace("LEFT S", "LEFT_S")
    at = titles.split().index(column)
    rows = []
    for line in lines[start + 2:]:
        if not line.strip():
            break
        rows.append(float(line.split()[at]))
    return np.array(rows)


def increments(job):
    """Of the first step, without the last hundred, which share out what remains."""
    return np.diff(job.history("energy", "ALLKE")[0])[:-100]


def told(job, what):
    """The number behind 'has added' of the last line of the log that tells of `what`."""
    lines = [line for line in job.log().splitlines() if "mass scaling has added" in line and what in line]
    return float(lines[-1].split("has added ")[1].split()[0])


def bar(lengths, scaling, period, more="", velocity=1.0):
    """Trusses of these lengths along x, 1 m2 each 1e-4, all nodes moving with `velocity`."""
    at = np.concatenate([[0.0], np.cumsum(lengths)])
    text = "*NODE, NSET=ALL\n" + "".join(f"{i + 1}, {x:.9g}, 0., 0.\n" for i, x in enumerate(at))
    text += "*ELEMENT, TYPE=T3D2, ELSET=BAR\n" + "".join(f"{i + 1}, {i + 1}, {i + 2}\n" for i in range(len(lengths)))
    text += "*ELSET, ELSET=FIRST\n1\n*ELSET, ELSET=SECOND\n2\n*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL\n1E-4\n" + STEEL
    text += f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, {velocity}\n" + more
    return text + f"*STEP\n*DYNAMIC, EXPLICIT\n, {period}\n{NO_VISCOSITY}{scaling}*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=ALL\nU, V\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLMW, ALLWK, ETOTAL\n*END STEP\n"


def element_at_a_spring(run):
    """A stiff spring to the ground bounds the element at whose end it pulls: that one is made heavier, the bound of both falls with its mass."""
    length, dt = 0.1, 0.1 / SPEED
    mass = 7800.0 * 1e-4 * length
    stiffness = 3.0 * (2.0 / dt)**2 * mass / 2.0  # adds three times the element's own squared frequency at its node
    spring = f"*ELEMENT, TYPE=SPRING1, ELSET=GROUND\n100, 1\n*SPRING, ELSET=GROUND\n1\n{stiffness!r}\n"
    for ranks in (1, 2):
        job = run.job(bar([length] * 6, f"*FIXED MASS SCALING, TYPE=BELOW MIN, DT={dt!r}\n", 200 * dt, spring), ranks)
        check("mass added", told(job, "in all"), 3.0 * mass, 1e-6)
        check("increments", increments(job).min(), CHOSEN * dt, 1e-3)
        check("increments stay", increments(job).max(), CHOSEN * dt, 1e-6)


def tiny_element(run):
    """One element of a tenth of the others' length, raised to their increment: 99 times its mass comes to it, and nothing else."""
    lengths, dt = [0.1] * 5 + [0.01] + [0.1] * 5, 0.1 / SPEED
    mass = 7800.0 * 1e-4 * sum(lengths)
    job = run.job(bar(lengths, f"*FIXED MASS SCALING, DT={dt:.15e}, TYPE=BELOW MIN\n", 200 * dt))
    check("least increment", increments(job).min(), CHOSEN * dt, 1e-3)
    check("largest increment", increments(job).max(), CHOSEN * dt, 1e-6)
    check("added mass", told(job, "in all"), 99.0 * 7800.0 * 1e-4 * 0.01, 1e-5)
    check("added mass, percent", status(job, "ADDED_MASS_%")[-1], 100.0 * 99.0 * 7800.0 * 1e-4 * 0.01 / mass, 1e-4)
    check("kinetic energy of what moves evenly", job.history("energy", "ALLKE")[1][-1], 0.5 * (mass + 99.0 * 7800.0 * 1e-4 * 0.01), 1e-6)
    plain = run.job(bar(lengths, "", 200 * dt))
    check("increment without", increments(plain).mean(), 0.1 * CHOSEN * dt, 1e-6)


def kinds(run):
    """UNIFORM, SET EQUAL DT, FACTOR, and definitions of sets in place of that of the model."""
    lengths, dt = [0.1, 0.2, 0.4], 0.3 / SPEED
    unit = 7800.0 * 1e-4
    added = lambda scales: unit * sum((s - 1.0) * l for s, l in zip(scales, lengths))
    cases = {
        "UNIFORM": (f"*FIXED MASS SCALING, DT={dt:.15e}, TYPE=UNIFORM\n", [9.0, 9.0, 9.0], 1.0),
        "SET EQUAL DT": (f"*FIXED MASS SCALING, DT={dt:.15e}, TYPE=SET EQUAL DT\n", [9.0, 2.25, 0.5625], 1.0),
        "BELOW MIN": (f"*FIXED MASS SCALING, DT={dt:.15e}\n", [9.0, 2.25, 1.0], 1.0),
        "FACTOR before the target": (f"*FIXED MASS SCALING, FACTOR=4., DT={dt:.15e}\n", [9.0, 4.0, 4.0], 1.0),
        "a set in place of the model": (f"*FIXED MASS SCALING, DT={dt:.15e}, ELSET=FIRST\n*FIXED MASS SCALING, FACTOR=5.0625\n", [9.0, 5.0625, 5.0625], 1.0),
        "two sets": ("*FIXED MASS SCALING, FACTOR=4., ELSET=FIRST\n*FIXED MASS SCALING, FACTOR=9., ELSET=SECOND\n", [4.0, 9.0, 1.0], 2.0 / 3.0),
        "variable": (f"*VARIABLE MASS SCALING, DT={dt:.15e}, TYPE=UNIFORM, FREQUENCY=1\n", [9.0, 9.0, 9.0], 1.0),
    }
    for name, (text, scales, part) in cases.items():
        job = run.job(bar(lengths, text, 150 * dt))
        check(f"{name}: mass", told(job, "in all"), added(scales), 1e-5)
        check(f"{name}: increment", increments(job).mean(), part * CHOSEN * dt, 1e-6)


def vibration(run):
    """FACTOR=4 doubles the increment and halves the frequency of a bar that vibrates in its first mode, held at one end."""
    count, length = 20, 0.05
    held = "*NSET, NSET=END\n1\n*BOUNDARY\nALL, 2, 3\nEND, 1, 1\n"
    nodes = "".join(f"*INITIAL CONDITIONS, TYPE=VELOCITY\n{i + 1}, 1, {1e-4 * math.sin(0.5 * math.pi * i / count):.12e}\n" for i in range(1, count + 1))
    period = 4.0 * count * length / SPEED
    steps, periods = [], []
    for scaling, slower in (("", 1.0), ("*FIXED MASS SCALING, FACTOR=4.\n", 2.0)):
        job = run.job(bar([length] * count, scaling, 4.2 * slower * period, held + nodes, 0.0))
        time, u = job.history(f"node_{count + 1}", "U")
        u = u[:, 0]
        crossings = [time[i] - u[i] * (time[i + 1] - time[i]) / (u[i + 1] - u[i]) for i in range(1, len(u) - 1) if (u[i] > 0.0) != (u[i + 1] > 0.0)]
        periods.append(2.0 * np.diff(crossings).mean())
        steps.append(increments(job).mean())
        total = job.history("energy", "ETOTAL")[1]
        check("energy drift", np.abs(total - total[0]).max() / total[0], 0.0, 1e-4)
    check("period", periods[0], period, 2e-3)
    check("period of four times the mass", periods[1] / periods[0], 2.0, 1e-6)
    check("increments", steps[1] / steps[0], 2.0, 1e-6)


def families(density, scaling):
    """A patch of every family of elements, apart from each other; each thrown into vibration by a turn of one node or more."""
    text, node, element = "*NODE, NSET=ALL\n", 0, 0
    patches = []

    def patch(kind, points, connectivity, section):
        nonlocal text, node, element
        place = 3.0 * len(patches)
        text += "".join(f"{node + i + 1}, {x + place}, {y}, {z}\n" for i, (x, y, z) in enumerate(points))
        patches.append((kind, [element + 1], ", ".join(str(node + i + 1) for i in connectivity), section))
        node, element = node + len(points), element + 1

    cube = [(0, 0, 0), (1, 0, 0), (1.1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0.1, 1), (1, 1, 1.2), (0, 1, 1)]
    solid, shell, membrane = "*SOLID SECTION", "*SHELL SECTION", "*MEMBRANE SECTION"
    for kind in ("C3D8R", "C3D8", "C3D8I"):
        patch(kind, cube, range(8), (solid, ""))
    patch("C3D6", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1.1)], range(6), (solid, ""))
    tetrahedron = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    patch("C3D4", tetrahedron, range(4), (solid, ""))
    middle = lambda i, j: tuple(0.5 * (a + b) for a, b in zip(tetrahedron[i], tetrahedron[j]))
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
    patch("C3D10", tetrahedron + [middle(*edge) for edge in edges], range(10), (solid, ""))
    square = [(0, 0, 0), (1, 0, 0), (1.1, 1, 0), (0, 1, 0.1)]
    for kind in ("S4R", "S4"):
        patch(kind, square, range(4), (shell, "0.05\n"))
    patch("S3R", square[:3], range(3), (shell, "0.05\n"))
    for kind in ("M3D4R", "M3D4"):
        patch(kind, square, range(4), (membrane, "0.05\n"))
    patch("M3D3", square[:3], range(3), (membrane, "0.05\n"))
    patch("T3D2", [(0, 0, 0), (1, 0.2, 0)], range(2), (solid, "0.01\n"))
    patch("B31", [(0, 0, 0), (1, 0.2, 0)], range(2), ("*BEAM SECTION, SECTION=RECT", "0.1, 0.05\n0., 0., -1.\n"))
    for kind, (row,), nodes, (section, data) in patches:
        text += f"*ELEMENT, TYPE={kind}, ELSET=E{row}\n{row}, {nodes}\n{section}, ELSET=E{row}, MATERIAL=RUBBERY\n{data}"
    text += f"*MATERIAL, NAME=RUBBERY\n*ELASTIC\n1E6, 0.3\n*DENSITY\n{density}\n*DAMPING, ALPHA=3.\n"
    text += "".join(f"*INITIAL CONDITIONS, TYPE=VELOCITY\n{i}, {i % 3 + 1}, {1.0 + 0.1 * (i % 7)}\n" for i in range(1, node + 1))
    step = "*STEP, NAME={}\n*DYNAMIC, EXPLICIT\n, 0.05\n{}*OUTPUT, FIELD, NUMBER INTERVAL=4, PRECISION=DOUBLE\n*NODE OUTPUT\nU, V, A\n*OUTPUT, HISTORY, TIME INTERVAL=0.005\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLVD, ETOTAL\n*END STEP\n"
    return text + "".join(step.format(name, more) for name, more in (("ONE", scaling), ("TWO", "")))


def heavier_matter(run):
    """FACTOR=4 and four times the density are the same to the last bit, for every family, with bulk viscosity and damping by mass."""
    heavy = run.job(families(4000.0, ""), place="heavy")
    scaled = run.job(families(1000.0, "*FIXED MASS SCALING, FACTOR=4.\n"), place="scaled")
    check("same bits", run.same(heavy, scaled), 1.0, 0.0)
    for ranks in (2, 3):
        again = run.job(families(1000.0, "*FIXED MASS SCALING, FACTOR=4.\n"), ranks, f"on_{ranks}")
        check(f"same bits on {ranks} ranks", run.same(scaled, again), 1.0, 0.0)


def weight(run):
    """Gravity acts on the original mass: what stands weighs as before, what falls falls with a quarter of g where all masses are four."""
    cube = UNIT_CUBE + "*ELEMENT, TYPE=C3D8R, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*SOLID SECTION, ELSET=CUBE, MATERIAL=SOFT\n"
    cube += "*MATERIAL, NAME=SOFT\n*ELASTIC\n1E6, 0.\n*DENSITY\n1000.\n"
    step = "*STEP\n*DYNAMIC, EXPLICIT\n, 0.5\n*FIXED MASS SCALING, FACTOR=4.\n*DLOAD\nCUBE, GRAV, 9.81, 0., 0., -1.\n"
    output = "*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=ALL\nU3, RF3\n*END STEP\n"
    job = run.job(cube + step + output)
    time, z = job.history("node_1", "U3")
    check("fall", z[-1], -0.5 * 0.25 * 9.81 * time[-1] ** 2, 1e-9)
    job = run.job(cube + "*BOUNDARY\nALL, 1, 3\n" + step + output)
    check("weight", sum(job.history(f"node_{i}", "RF3")[1][-1] for i in range(1, 9)), 1000.0 * 9.81, 1e-9)


CRUSHING = 5.0  # time that it takes


def crushed(scaling, more=""):
    """Two bars of rubber between plates that close on the first of them."""
    text = "*NODE, NSET=ALL\n" + "".join(f"{4 * k + i + 1}, {x}, {y}, {z}\n" for k, z in enumerate((0.0, 1.0, 2.0)) for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))))
    text += "*ELEMENT, TYPE=C3D8R, ELSET=BAR\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n"
    text += "*NSET, NSET=MIDDLE\n5, 6, 7, 8\n*NSET, NSET=BOTTOM\n1, 2, 3, 4\n*NSET, NSET=TOP\n9, 10, 11, 12\n"
    text += "*SOLID SECTION, ELSET=BAR, MATERIAL=RUBBER\n*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n0.5E6, 1E-6\n*DENSITY\n1000.\n"
    text += "*AMPLITUDE, NAME=PUSH, DEFINITION=SMOOTH STEP\n" + f"0., 0., {CRUSHING}, 1.\n"
    step = "*STEP, NAME={}\n*DYNAMIC, EXPLICIT\n, {}\n*BOUNDARY\nBOTTOM, 1, 3\nTOP, 3, 3\n*BOUNDARY, AMPLITUDE=PUSH\nMIDDLE, 3, 3, -0.6\n{}"
    output = "*RESTART, WRITE, NUMBER INTERVAL=2\n*OUTPUT, FIELD, NUMBER INTERVAL=4, PRECISION=DOUBLE\n*NODE OUTPUT\nU, V\n*OUTPUT, HISTORY, FREQUENCY=1\n*NODE OUTPUT, NSET=ALL\nU3\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLVD, ALLMW, ALLWK, ETOTAL\n*END STEP\n"
    return text + step.format("CRUSH", CRUSHING, scaling) + output + more


def keeps_its_increment(run):
    """An element crushed to 0.4 of its height keeps the increment that is asked for; the energy that comes with mass is counted."""
    plain = increments(run.job(crushed("")))
    check("without scaling the increment falls", float(plain[-1] < 0.6 * plain[0]), 1.0, 0.0)
    for when in ("FREQUENCY=10", "NUMBER INTERVAL=100"):
        dt = plain[0] / CHOSEN
        job = run.job(crushed(f"*VARIABLE MASS SCALING, DT={dt:.12e}, TYPE=BELOW MIN, {when}\n"))
        check(f"{when}: least increment", increments(job).min(), CHOSEN * dt, 0.03)
        percent = status(job, "ADDED_MASS_%")
        check(f"{when}: mass is added as it is crushed", float(percent[0] < 0.2 * percent[-1] and (np.diff(percent) >= 0.0).all()), 1.0, 0.0)
        total, inner = job.history("energy", "ETOTAL")[1], job.history("energy", "ALLIE")[1]
        check(f"{when}: energy drift", np.abs(total - total[0]).max() / inner.max(), 0.0, 1e-3)
        check(f"{when}: energy came with mass", float(job.history("energy", "ALLMW")[1][-1] > 0.0), 1.0, 0.0)


def steps_and_ranks(run):
    """Scaled masses and variable definitions go on from step to step, until *FIXED MASS SCALING and *VARIABLE MASS SCALING end them;
    the same bits on any number of ranks and after a restart, between steps and within one."""
    more = "*STEP, NAME=ON\n*DYNAMIC, EXPLICIT\n, 0.1\n*END STEP\n*STEP, NAME=KEPT\n*DYNAMIC, EXPLICIT\n, 0.1\n*VARIABLE MASS SCALING\n*END STEP\n"
    more += "*STEP, NAME=BACK\n*DYNAMIC, EXPLICIT\n, 0.1\n*FIXED MASS SCALING\n*END STEP\n"
    text = crushed("*FIXED MASS SCALING, FACTOR=2.\n*VARIABLE MASS SCALING, DT=0.012, FREQUENCY=1\n", more)
    whole = run.job(text, 1, "whole")
    percent = [status(whole, "ADDED_MASS_%", step)[-1] for step in (1, 2, 3, 4)]
    check("more than the fixed factor", float(percent[0] > 100.0), 1.0, 0.0)
    check("goes on", float(percent[1] >= percent[0]), 1.0, 0.0)
    check("is kept", percent[2] - percent[1], 0.0, 1e-9)
    check("is given back", percent[3], 0.0, 0.0)
    for ranks in (2, 3):
        check(f"same bits on {ranks} ranks", run.same(whole, run.job(text, ranks, f"on_{ranks}")), 1.0, 0.0)
    run.job(text, 2, "between", ("--until", "ON"))
    check("same bits when restarted between steps", run.same(whole, run.job(text, 1, "between", ("--restart",))), 1.0, 0.0)
    (run.folder / "within").mkdir(parents=True)
    (run.folder / "within" / f"{run.case}.ctl").write_text("stop\n")
    run.job(text, 1, "within", expected_status=4)
    check("same bits when restarted within a step", run.same(whole, run.job(text, 2, "within", ("--restart",))), 1.0, 0.0)


def with_linkages(run):
    """Beside a coupling, a bushing, point masses and inertias, which follow masses that change every third increment: the same bits on two
    ranks and after a restart, which makes everything anew; the energy balance holds."""
    rest = bar_with_end(KINEMATIC, 1, LOADS.format("3e3"), nlgeom=", NLGEOM", extra=BUSHING)
    text = rest[:rest.index("*STEP")] + "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n*VARIABLE MASS SCALING, DT=1.2e-5, TYPE=UNIFORM, FREQUENCY=3\n"
    text += LOADS.format("-2e3") + "*OUTPUT, FIELD, NUMBER INTERVAL=3, PRECISION=DOUBLE\n*NODE OUTPUT\nU, V, UR\n*OUTPUT, HISTORY, FREQUENCY=10\n"
    text += "*ENERGY OUTPUT\nALLKE, ALLIE, ALLMW, ALLWK, ETOTAL\n*END STEP\n"
    whole = run.job(text, 1, "whole")
    total, largest = (whole.history("energy", name)[1] for name in ("ETOTAL", "ALLKE"))
    check("energy drift", np.abs(total - total[0]).max() / largest.max(), 0.0, 1e-5)
    check("mass is added", float(status(whole, "ADDED_MASS_%")[-1] > 10.0), 1.0, 0.0)
    check("the same bits on two ranks", run.same(whole, run.job(text, 2, "two")), 1.0, 0.0)
    (run.folder / "within").mkdir(parents=True)
    (run.folder / "within" / f"{run.case}.ctl").write_text("stop\n")
    run.job(text, 1, "within", expected_status=4)
    check("the same bits when restarted", run.same(whole, run.job(text, 2, "within", ("--restart",))), 1.0, 0.0)


CASES = {case.__name__: case for case in (tiny_element, element_at_a_spring, kinds, vibration, heavier_matter, weight, keeps_its_increment, steps_and_ranks, with_linkages)}

if __name__ == "__main__":
    name, program, folder = sys.argv[1:4]
    subprocess.run(["rm", "-rf", folder], check=True)
    CASES[name](Runner(name, program, folder))
    sys.exit(1 if failures else 0)
