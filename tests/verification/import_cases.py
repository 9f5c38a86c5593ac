#!/usr/bin/env python3
"""Jobs that start from the state of another: import_cases.py CASE BALOCCO FOLDER."""
import pathlib
import re
import sys

import numpy as np

from constraint_cases import KINEMATIC, bar_with_end
from job import Job, check, failures

BUSHING = "\n".join(["*NODE\n1002, 1.2, 0.05, 0.05", "*ELEMENT, TYPE=CONN3D2, ELSET=BUSH\n9001, 1000, 1002",
                     "*ELEMENT, TYPE=MASS, ELSET=END_MASS\n9002, 1002\n*MASS, ELSET=END_MASS\n5.",
                     "*ELEMENT, TYPE=ROTARYI, ELSET=END_INERTIA\n9003, 1002\n*ROTARY INERTIA, ELSET=END_INERTIA\n0.1, 0.1, 0.1",
                     "*CONNECTOR BEHAVIOR, NAME=RUBBER", *[f"*CONNECTOR ELASTICITY, COMPONENT={c}\n{1e6 if c < 4 else 1e4}" for c in range(1, 7)],
                     "*CONNECTOR SECTION, ELSET=BUSH, BEHAVIOR=RUBBER\nBUSHING"])
LOADS = "*CLOAD\n1002, 1, 1e4\n1002, 2, {}\n1002, 6, 200.\n"


def drive(loads):
    return f"""*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
2e-6, 5e-4
{loads}*OUTPUT, HISTORY, FREQUENCY=10
*NODE OUTPUT, NSET=END
U, UR
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
*END STEP
"""


def imbalance(job):
    return float(re.search(r"\|f_int \+ f_contact - f_ext\| / \|f_ext\| = (\S+)", job.log()).group(1))


def driving_from_an_equilibrium(balocco, folder):
    """An equilibrium is found once; two explicit jobs start from it, at rest and with another load, on any number of ranks, and take the
    same way to the last bit as one deck with both steps."""
    rest = bar_with_end(KINEMATIC, 1, LOADS.format("3e3"), nlgeom=", NLGEOM", extra=BUSHING)
    model = rest[:rest.index("*STEP")]

    def run(name, text, ranks, *arguments):
        job = Job(name, balocco, str(ranks), folder)
        job.run(text, arguments=arguments)
        return job

    whole = run("whole", rest + drive(LOADS.format("-2e3")), 1)
    run("equilibrium", rest, 1)
    source = str(pathlib.Path(folder) / "equilibrium.ckpt.h5")
    for ranks in (1, 2, 3):
        job = run(f"drive_{ranks}", model + drive(LOADS.format("-2e3")), ranks, "--import", source)
        for variable in ("U", "UR"):
            same = np.array_equal(job.history("node_1000", variable)[1], whole.history("node_1000", variable, 2)[1])
            check(f"bits of {variable} on {ranks} ranks", float(same), 1.0, 0.0)
    still = run("still", model + drive(LOADS.format("3e3")), 2, "--import", source)
    check("imbalance at import", imbalance(still), 0.0, 1e-8)
    u = still.history("node_1000", "U")[1]
    check("drift", np.abs(u - u[0]).max() / np.abs(u[0]).max(), 0.0, 1e-6)
    job = Job("other", balocco, "2", folder)
    told = job.run(model.replace("1002, 1.2,", "1002, 1.25,") + drive(""), expected_status=2, arguments=("--import", source))
    check("another mesh is refused by name", float("its nodes differ" in told), 1.0, 0.0)


IMPORT = "*IMPORT, STATE=YES, UPDATE=NO, STEP=1\n{}\n*IMPORT NSET\nEND, BUSH_END\n*NSET, NSET=BUSH_END\n1002\n"
ALL_OF_IT = "BAR, BUSH, END_MASS, END_INERTIA"


def importing_parts(balocco, folder):
    """*IMPORT by sets of elements: all of them make the same bits as the whole model; what is new in the deck starts as it says; parts
    that have become rigid rest where they stand."""
    rest = bar_with_end(KINEMATIC, 1, LOADS.format("3e3"), nlgeom=", NLGEOM", extra=BUSHING)
    model = rest[:rest.index("*STEP")]

    def run(name, text, ranks, *arguments, status=0):
        job = Job(name, balocco, str(ranks), folder)
        told = job.run(text, expected_status=status, arguments=arguments)
        return job if status == 0 else told

    run("equilibrium", rest, 1)
    source = ("--import", str(pathlib.Path(folder) / "equilibrium.ckpt.h5"))
    whole = run("whole", model + drive(LOADS.format("-2e3")), 1, *source).history("node_1000", "U")[1]
    for ranks in (1, 2):
        parts = run(f"parts_{ranks}", model + IMPORT.format(ALL_OF_IT) + drive(LOADS.format("-2e3")), ranks, *source).history("node_1000", "U")[1]
        check(f"bits of all sets on {ranks} ranks", float(np.array_equal(parts, whole)), 1.0, 0.0)

    new = "*NODE\n" + "\n".join(f"{500 + i}, {3 + (i in (1, 2, 5, 6)) * 0.1}, {(i in (2, 3, 6, 7)) * 0.1}, {(i > 3) * 0.1}" for i in range(8))
    new += "\n*ELEMENT, TYPE=C3D8R, ELSET=NEW\n500, 500, 501, 502, 503, 504, 505, 506, 507\n*SOLID SECTION, ELSET=NEW, MATERIAL=STEEL\n"
    more = run("more", new + model + IMPORT.format(ALL_OF_IT) + drive(LOADS.format("-2e3")), 2, *source)
    check("beside a part that is new", np.abs(more.history("node_1000", "U")[1] - whole).max() / np.abs(whole).max(), 0.0, 1e-9)  # linkages are solved to rounding of the size of the model

    outer = "*ELSET, ELSET=OUTER\n" + ", ".join(str(8 * i + k) for i in range(2) for k in range(5, 9)) + "\n" + \
        ", ".join(str(8 * i + k) for i in range(2, 4) for k in range(5, 9)) + "\n*NODE\n2000, 1., 0., 0.\n*RIGID BODY, REF NODE=2000, ELSET=OUTER\n"
    for ranks in (1, 2):
        still = run(f"rigid_{ranks}", model + outer + IMPORT.format(ALL_OF_IT) + drive(LOADS.format("3e3")), ranks, *source)
        check(f"imbalance with a half that is rigid now, {ranks} ranks", imbalance(still), 0.0, 1e-8)
        u = still.history("node_1000", "U")[1]
        check("its drift", np.abs(u - u[0]).max() / np.abs(u[0]).max(), 0.0, 1e-6)

    def told(name, text, words, ranks=1):
        check(name, float(words in run("refused", text + drive(""), ranks, *source, status=2)), 1.0, 0.0)

    asked = model + IMPORT.format(ALL_OF_IT)
    told("a node elsewhere is named", asked.replace("1002, 1.2,", "1002, 1.25,"), "node 1002 at (1.2, 0.05, 0.05)", ranks=2)
    told("a new element is named", new + model + IMPORT.format(ALL_OF_IT + ", NEW"), "no node 500")
    told("another material is told", asked.replace("210e9", "200e9"), "another section or material")
    told("another step is told", asked.replace("STEP=1", "STEP=2"), "not of the end of step 2")
    check("a job to start from is wanted", float("--import OLD.ckpt.h5" in run("refused", asked + drive(""), 1, status=2)), 1.0, 0.0)


COLUMN = "*NODE, NSET=ALL\n" + "".join(f"{4 * k + i + 1}, {x}, {y}, {0.5 * k}\n" for k in range(3) for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))))
COLUMN += """*NSET, NSET=BOTTOM
1, 2, 3, 4
*NSET, NSET=TOP
9, 10, 11, 12
*ELEMENT, TYPE=C3D8R, ELSET=COLUMN
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 5, 6, 7, 8, 9, 10, 11, 12
*SOLID SECTION, ELSET=COLUMN, MATERIAL=RUBBER
*MATERIAL, NAME=RUBBER
*ELASTIC
1E6, 0.
*DENSITY
1000.
"""


def pulled(distance, more=""):
    return f"*STEP, NLGEOM, NAME=PULL{more}\n*STATIC\n0.5, 1.\n*BOUNDARY\nBOTTOM, 1, 3\nTOP, 1, 2\nTOP, 3, 3, {distance}\n*OUTPUT, FIELD, FREQUENCY=99, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*END STEP\n"


def importing_the_mesh(balocco, folder):
    """STATE=NO, UPDATE=YES: a column that was stretched to 1.25 of its height is a new one of that height, free of stress."""
    source = Job("stretched", balocco, "1", folder)
    source.run(COLUMN + pulled(0.25))
    asked = COLUMN + "*IMPORT, STATE=NO, UPDATE=YES, STEP=1\nCOLUMN\n" + pulled(1e-6, "-1") + pulled(2e-6, "-2")
    arguments = ("--import", str(pathlib.Path(folder) / "stretched.ckpt.h5"))
    jobs = []
    for name, ranks, parts in (("anew_1", "1", (arguments,)), ("anew_2", "2", (arguments,)), ("in_two", "1", ((*arguments, "--until", "PULL-1"), ("--restart",)))):
        job = Job(name, balocco, ranks, folder)
        for part in parts:
            job.run(asked, arguments=part)
        jobs.append(job)
        check(f"{name}: height", job.mesh("C3D8R")[0][:, 2].max(), 1.25, 1e-12)
        check(f"{name}: displacements count from there", np.abs(job.frame("U", 0)).max(), 0.0, 0.0)
        check(f"{name}: force E A u / height", job.frame("RF", -1, 2)[8:, 2].sum(), 1e6 * 2e-6 / 1.25, 1e-5)
    check("restarted: the same to rounding", np.abs(jobs[0].frame("U", -1, 2) - jobs[2].frame("U", -1, 2)).max(), 0.0, 1e-15)
    told = Job("refused", balocco, "1", folder).run(asked.replace("STEP=1", "STEP=2"), expected_status=2, arguments=arguments)
    check("another step is told", float("not of the end of step 2" in told), 1.0, 0.0)


ELEMENTS_TOO = "U, RF\n*ELEMENT OUTPUT\nS, LE\n*END STEP"


def updating_the_reference(balocco, folder):
    """STATE=YES, UPDATE=YES: a stretched column counts displacements and strains from where it stands, and has its stress there; it takes
    the force that it took, more by its stiffness as it is pulled on; what moves goes on with its velocity."""
    folder = pathlib.Path(folder)
    shown = lambda text: text.replace("U, RF\n*END STEP", ELEMENTS_TOO)
    last = lambda job, kind, variable, frame=-1, step=1: job.element(kind, variable, frame, step)
    for kind in ("C3D8I", "C3D8"):
        column = COLUMN.replace("C3D8R", kind)
        source = Job(f"stretched_{kind}", balocco, "1", folder)
        source.run(column + shown(pulled(0.25)))
        stress = last(source, kind, "S")
        asked = column + "*IMPORT, STATE=YES, UPDATE=YES, STEP=1\nCOLUMN\n" + shown(pulled(0.0, "-1")) + shown(pulled(1e-6, "-2"))
        arguments = ("--import", str(folder / f"stretched_{kind}.ckpt.h5"))
        for name, ranks, parts in (("1", "1", (arguments,)), ("2", "2", (arguments,)), ("in_two", "1", ((*arguments, "--until", "PULL-1"), ("--restart",)))):
            job = Job(f"on_{name}_{kind}", balocco, ranks, folder)
            for part in parts:
                job.run(asked, arguments=part)
            words = f"{kind}, {name}"
            check(f"{words}: height", job.mesh(kind)[0][:, 2].max(), 1.25, 1e-12)
            check(f"{words}: displacements count from there", np.abs(job.frame("U", -1)).max(), 0.0, 1e-12)
            check(f"{words}: strains too", np.abs(last(job, kind, "LE")).max(), 0.0, 1e-12)
            check(f"{words}: stress goes on", np.abs(last(job, kind, "S") - stress).max() / np.abs(stress).max(), 0.0, 1e-9)
            force, more = (job.frame("RF", -1, step)[8:, 2].sum() for step in (1, 2))
            check(f"{words}: force", force, source.frame("RF", -1)[8:, 2].sum(), 1e-9)
            check(f"{words}: stiffness", more - force, (1e6 + stress[0][2]) * 1e-6 / 1.25, 1e-5)

    for kind in ("C3D8", "C3D8I"):  # strains that vary within elements: their mean dilatation and modes are those of the new shape
        bar = bar_with_end(KINEMATIC, 1, "*CLOAD\n1000, 2, 1e6\n", nlgeom=", NLGEOM", element=kind)
        bar = bar.replace("*OUTPUT, HISTORY", "*OUTPUT, FIELD, FREQUENCY=99, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*OUTPUT, HISTORY")
        source = Job(f"bent_{kind}", balocco, "1", folder)
        source.run(bar)
        held = Job(f"held_{kind}", balocco, "2", folder)
        held.run(bar.replace("*STEP", "*IMPORT, UPDATE=YES\nBAR\n*IMPORT NSET\nEND\n*STEP", 1), arguments=("--import", str(folder / f"bent_{kind}.ckpt.h5")))
        bent, moved = (np.abs(job.frame("U", -1)).max() for job in (source, held))
        check(f"{kind}: it is bent", float(bent > 0.1), 1.0, 0.0)
        check(f"{kind}: a bent bar stays", moved / bent, 0.0, 1e-3)

    thrown = "*STEP\n*DYNAMIC, EXPLICIT\n, 0.01\n*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*END STEP\n"
    full = COLUMN.replace("C3D8R", "C3D8")
    Job("thrown", balocco, "1", folder).run(full + "*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, 2.\n" + thrown)
    source = ("--import", str(folder / "thrown.ckpt.h5"))
    asked = full + "*IMPORT, UPDATE=YES\nCOLUMN\n" + thrown
    for ranks in ("1", "2"):
        job = Job(f"flying_{ranks}", balocco, ranks, folder)
        job.run(asked, arguments=source)
        check(f"place, {ranks} ranks", job.mesh("C3D8")[0][:, 0].min(), 0.02, 1e-9)
        check(f"way, {ranks} ranks", np.abs(job.frame("U", -1) - (0.02, 0.0, 0.0)).max(), 0.0, 1e-9)

    def told(name, text, words):
        check(name, float(words in Job("refused", balocco, "1", folder).run(text, expected_status=2, arguments=source)), 1.0, 0.0)

    told("rubber", asked.replace("*ELASTIC\n1E6, 0.", "*HYPERELASTIC, NEO HOOKE\n1E5, 1E-6"), "C3D8 element 1 cannot go on with its stress, since the law of")
    told("metal", asked.replace("1E6, 0.\n", "1E6, 0.\n*PLASTIC\n1E4, 0.\n"), "its material RUBBER yields or relaxes")
    told("directions", asked.replace("MATERIAL=RUBBER\n", "MATERIAL=RUBBER, ORIENTATION=O\n*ORIENTATION, NAME=O\n0., 1., 0., -1., 0., 0.\n", 1),
         "its section has an ORIENTATION")
    told("other increments", asked.replace("UPDATE=YES", "UPDATE=YES, STEP=1, INCREMENT=3"), "no state of increment 3 of step 1 is kept beside")


def updating_bodies(balocco, folder):
    """UPDATE=YES: a rigid body that has been turned counts its turns from there, and its nodes go where it goes."""
    full = COLUMN.replace("C3D8R", "C3D8") + "*NODE\n" + "".join(
        f"{100 + i}, {x}, {y}, -1.\n{110 + i}, {x}, {y}, -2.\n" for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))))
    full += "*ELEMENT, TYPE=C3D8, ELSET=FOOT\n10, 110, 111, 112, 113, 100, 101, 102, 103\n*SOLID SECTION, ELSET=FOOT, MATERIAL=RUBBER\n"
    full += "*NODE, NSET=REFERENCE\n200, 0.5, 0.5, -1.5\n*RIGID BODY, REF NODE=200, ELSET=FOOT, TIE NSET=BOTTOM\n"
    turned = pulled(0.1).replace("BOTTOM, 1, 3\n", "REFERENCE, 1, 3\nREFERENCE, 5, 6\nREFERENCE, 4, 4, 0.4\n").replace("TOP, 1, 2\nTOP, 3, 3, 0.1\n", "")
    source = Job("turned", balocco, "1", folder)
    source.run(full + turned)
    move = ("*STEP\n*DYNAMIC, EXPLICIT\n, 0.01\n*BOUNDARY, TYPE=VELOCITY\nREFERENCE, 1, 2\nREFERENCE, 5, 6\nREFERENCE, 4, 4, 10.\nREFERENCE, 3, 3, 1.\n"
            "*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU, UR\n*END STEP\n")
    cosine, sine = np.cos(0.1), np.sin(0.1)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    for ranks in ("1", "2"):
        job = Job(f"on_{ranks}", balocco, ranks, folder)
        job.run(full + "*IMPORT, UPDATE=YES\nCOLUMN, FOOT\n*IMPORT NSET\nREFERENCE\n" + move, arguments=("--import", str(pathlib.Path(folder) / "turned.ckpt.h5")))
        places, foot = job.mesh("C3D8")[0], slice(12, 20)
        check(f"they stand where they were left, {ranks} ranks", np.abs(places - source.mesh("C3D8")[0] - source.frame("U", -1)).max(), 0.0, 1e-14)
        arms = places[foot] - places[20]
        check("nodes go with the body", np.abs(job.frame("U", -1)[foot] - (arms @ turn.T - arms + (0.0, 0.0, 0.01))).max(), 0.0, 1e-12)
        check("its turn", np.abs(job.frame("UR", -1)[20] - (0.1, 0.0, 0.0)).max(), 0.0, 1e-12)


def importing_copies(balocco, folder):
    """Columns elsewhere, with other numbers, start from the state of one: its displacements and forces, but for rounding."""
    def column(shift, place):
        nodes = [f"{shift + 4 * k + i + 1}, {place[0] + x}, {place[1] + y}, {place[2] + 0.5 * k}"
                 for k in range(3) for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1)))]
        return "\n".join(["*NODE", *nodes, f"*NSET, NSET=BOTTOM\n{', '.join(str(shift + i) for i in range(1, 5))}",
                          f"*NSET, NSET=TOP\n{', '.join(str(shift + i) for i in range(9, 13))}", f"*ELEMENT, TYPE=C3D8R, ELSET=COLUMN_{shift}",
                          *[f"{shift + e + 1}, " + ", ".join(str(shift + 4 * e + i) for i in range(1, 9)) for e in range(2)],
                          f"*SOLID SECTION, ELSET=COLUMN_{shift}, MATERIAL=RUBBER"]) + "\n"

    Job("one", balocco, "1", folder).run(COLUMN + pulled(0.1))
    columns = column(0, (0, 0, 0)) + column(20, (3.3, -0.7, 0.1)) + column(60, (-2.9, 5.1, 7.7))
    rubber = COLUMN[COLUMN.index("*MATERIAL"):]
    asked = columns + rubber + "".join(f"*IMPORT, UPDATE=NO, STEP=1, ELEMENT SHIFT={shift}, SHIFT NODES={shift}\nCOLUMN_{shift}\n" for shift in (0, 20, 60))
    still = "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n*BOUNDARY, FIXED\nBOTTOM, 1, 3\nTOP, 1, 3\n*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU, RF\n*END STEP\n"
    source = ("--import", str(pathlib.Path(folder) / "one.ckpt.h5"))
    for ranks in ("1", "2"):
        job = Job(f"copies_{ranks}", balocco, ranks, folder)
        job.run(asked + still, arguments=source)
        u = job.frame("U", 0).reshape(3, 12, 3)
        check(f"stretched, {ranks} ranks", u[0, 8:, 2].mean(), 0.1, 1e-9)
        check("copies too", np.abs(u - u[0]).max(), 0.0, 1e-14)
        force = job.frame("RF", 0).reshape(3, 12, 3)
        check("force that holds it", force[0, 8:, 2].sum(), 1e6 * 0.5 * (1.1**2 - 1.0) * 1.1, 1e-9)
        check("and copies", np.abs(force - force[0]).max() / np.abs(force).max(), 0.0, 1e-12)
        check("imbalance", imbalance(job), 0.0, 1e-8)
        check("they rest", np.abs(job.frame("U", -1).reshape(3, 12, 3) - u).max(), 0.0, 1e-8)

    def told(name, text, words):
        check(name, float(words in Job("refused", balocco, "2", folder).run(text + still, expected_status=2, arguments=source)), 1.0, 0.0)

    told("what has no source", asked.replace("SHIFT NODES=20", "SHIFT NODES=-100"), "no node 121, from which node 21 is to go on; look at SHIFT NODES=-100")
    told("a copy that is not moved as a whole", asked.replace("\n64, -2.9, 6.1, 7.7", "\n64, -2.9, 6.2, 7.7"), "a copy is moved as a whole")
    told("a copy of two", asked + "*IMPORT ELSET\nCOLUMN_20\n", "element 21 is imported twice")
    told("two states", asked + "*IMPORT, UPDATE=NO, STEP=2\nCOLUMN_0\n", "STATE, UPDATE, STEP, INCREMENT and INTERVAL differ from those of")


def bodies_keep_their_nodes(balocco, folder):
    """Nodes that a step of the other job has tied to a body go on with it, though the new deck does not say so."""
    foot = "*NODE\n" + "".join(f"{100 + i}, {x}, {y}, -1.\n{110 + i}, {x}, {y}, -2.\n" for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))))
    foot += "*ELEMENT, TYPE=C3D8R, ELSET=FOOT\n10, 110, 111, 112, 113, 100, 101, 102, 103\n*SOLID SECTION, ELSET=FOOT, MATERIAL=RUBBER\n"
    foot += "*NODE, NSET=REFERENCE\n200, 0.5, 0.5, -1.5\n*RIGID BODY, REF NODE=200, ELSET=FOOT\n"
    tied = pulled(0.1).replace("BOTTOM, 1, 3\n", "REFERENCE, 1, 6\n*RIGID BODY, REF NODE=200, TIE NSET=BOTTOM\n*BOUNDARY\n")
    Job("tied", balocco, "1", folder).run(COLUMN + foot + tied)
    move = "*STEP\n*DYNAMIC, EXPLICIT\n, 0.01\n*BOUNDARY\nREFERENCE, 1, 2\nREFERENCE, 4, 6\n*BOUNDARY, TYPE=VELOCITY\nREFERENCE, 3, 3, 1.\n*OUTPUT, FIELD, NUMBER INTERVAL=1, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*END STEP\n"
    for ranks in ("1", "2"):
        job = Job(f"moved_{ranks}", balocco, ranks, folder)
        job.run(COLUMN + foot + "*IMPORT, UPDATE=NO\nCOLUMN, FOOT\n*IMPORT NSET\nREFERENCE\n" + move,
                arguments=("--import", str(pathlib.Path(folder) / "tied.ckpt.h5")))
        u = job.frame("U", -1)[:4, 2]
        check("they go where it goes", np.abs(u - 0.01).max(), 0.0, 1e-12)


if __name__ == "__main__":
    {case.__name__: case for case in (driving_from_an_equilibrium, importing_parts, importing_the_mesh, updating_the_reference, updating_bodies, importing_copies, bodies_keep_their_nodes)}[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if failures else 0)
