#!/usr/bin/env python3
"""Jobs that start from the state of another: import_cases.py CASE BALOCCO FOLDER."""
import pathlib
import re
import sys

import numpy as np

from constraint_cases import KINEMATIC, bar_with_end
from explicit_cases import Job, check, failures

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

    def told(name, text, words):
        check(name, float(words in run("refused", text + drive(""), 2, *source, status=2)), 1.0, 0.0)

    asked = model + IMPORT.format(ALL_OF_IT)
    told("a node elsewhere is named", asked.replace("1002, 1.2,", "1002, 1.25,"), "node 1002 at (1.2, 0.05, 0.05)")
    told("a new element is named", new + model + IMPORT.format(ALL_OF_IT + ", NEW"), "no node 500")
    told("another material is told", asked.replace("210e9", "200e9"), "another section or material")
    told("another step is told", asked.replace("STEP=1", "STEP=2"), "not of the end of step 2")
    check("a job to start from is wanted", float("--import OLD.ckpt.h5" in run("refused", asked + drive(""), 1, status=2)), 1.0, 0.0)


if __name__ == "__main__":
    {case.__name__: case for case in (driving_from_an_equilibrium, importing_parts)}[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if failures else 0)
