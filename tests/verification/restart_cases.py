#!/usr/bin/env python3
"""*RESTART, READ: decks that go on from the checkpoint of another job with more or longer steps.

usage: restart_cases.py CASE BALOCCO FOLDER      exit status 0: everything as it must be
"""
import pathlib
import subprocess
import sys

import h5py
import numpy as np

from job import Job, check, failures

MODEL = "*NODE, NSET=ALL\n" + "".join(f"{4 * k + i + 1}, {x}, {y}, {z}\n" for k, z in enumerate((0.0, 1.0, 2.0)) for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))))
MODEL += """*ELEMENT, TYPE=C3D8R, ELSET=BAR
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 5, 6, 7, 8, 9, 10, 11, 12
*NSET, NSET=BOTTOM
1, 2, 3, 4
*NSET, NSET=TOP
9, 10, 11, 12
*SOLID SECTION, ELSET=BAR, MATERIAL=RUBBER
*MATERIAL, NAME=RUBBER
*HYPERELASTIC, NEO HOOKE
0.5E6, 1E-6
*VISCOELASTIC, TIME=PRONY
0.3, 0., 0.05
*DENSITY
1000.
"""
OUTPUT = "*RESTART, WRITE, NUMBER INTERVAL=1\n*OUTPUT, FIELD, NUMBER INTERVAL=2, PRECISION=DOUBLE\n*NODE OUTPUT\nU, V, RF\n*ELEMENT OUTPUT\nS\n*OUTPUT, HISTORY, TIME INTERVAL=0.01\n*NODE OUTPUT, NSET=TOP\nU3\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLVD, ALLWK, ETOTAL\n"
PRESSED = f"*STEP, NAME=PRESSED, NLGEOM\n*STATIC\n0.5, 1.\n*BOUNDARY\nBOTTOM, 1, 3\n*CLOAD\nTOP, 3, -1E4\n{OUTPUT}*END STEP\n"
THROWN = "*STEP, NAME=THROWN\n*DYNAMIC, EXPLICIT\n, {}\n*CLOAD\nTOP, 1, 3E3\n*END STEP\n"
FREE = "*STEP, NAME=FREE\n*DYNAMIC, EXPLICIT\n, 0.1\n*FIXED MASS SCALING, FACTOR=2.\n*CLOAD, OP=NEW\nTOP, 3, 1E3\n*END STEP\n"
AGAIN = "*STEP, NAME=AGAIN\n*DYNAMIC, EXPLICIT\n, 0.1\n*END STEP\n"
FLYING = MODEL + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, 2.\n*STEP, NAME=ONE\n*DYNAMIC, EXPLICIT\n, 1.\n{OUTPUT}*END STEP\n"


class Runner:
    def __init__(self, case, balocco, folder):
        self.case, self.balocco, self.folder = case, balocco, pathlib.Path(folder)

    def job(self, text, ranks, place, arguments=(), expected_status=0):
        job = Job(self.case, self.balocco, str(ranks), self.folder / place)
        job.output = job.run(text, expected_status, arguments)
        return job

    def checkpoint(self, job):
        return str(job.folder / f"{job.name}.ckpt.h5")

    def stopped(self, text, place):
        """A job that stops in its first increment."""
        (self.folder / place).mkdir(parents=True)
        (self.folder / place / f"{self.case}.ctl").write_text("stop\n")
        return self.job(text, 1, place, expected_status=4)


def same_steps(a, b, steps):
    """Whether two jobs have the same bits in all data of these steps."""
    same = True
    with h5py.File(a.folder / f"{a.name}.h5") as first, h5py.File(b.folder / f"{b.name}.h5") as second:
        for step in steps:
            known = []
            first[f"step_{step}"].visititems(lambda name, item: known.append(name) if isinstance(item, h5py.Dataset) else None)
            for name in known:
                x, y = first[f"step_{step}/{name}"][()], second[f"step_{step}/{name}"][()]
                if not np.array_equal(x, y):
                    same = False
                    print(f"step_{step}/{name} differs")
            same = same and len(known) > 10
    return float(same)


def more_steps(run):
    """Two more steps behind a static and an explicit one, the first deck included as it is: the bits of one deck with all four."""
    first = run.job(MODEL + PRESSED + THROWN.format(0.2), 1, "first")
    whole = run.job(MODEL + PRESSED + THROWN.format(0.2) + FREE + AGAIN, 1, "whole")
    deck = first.folder / f"{first.name}.inp"
    second = f"*INCLUDE, INPUT={deck}\n*RESTART, READ, STEP=2\n{FREE}{AGAIN}"
    for ranks in (1, 2):
        job = run.job(second, ranks, f"second_on_{ranks}", ("--import", run.checkpoint(first)))
        check(f"same bits on {ranks} ranks", same_steps(whole, job, (3, 4)), 1.0, 0.0)
        with h5py.File(job.folder / f"{job.name}.h5") as file:
            check("no others", float("step_2" in file), 0.0, 0.0)
    job = run.job(second, 1, "second_in_two", ("--import", run.checkpoint(first), "--until", "FREE"))
    job = run.job(second, 2, "second_in_two", ("--restart",))
    check("same bits when that is restarted", same_steps(whole, job, (3, 4)), 1.0, 0.0)


def longer_step(run):
    """A step that the first deck ends sooner goes on from within it to the end that the second deck says."""
    first = run.stopped(MODEL + PRESSED.replace("*STATIC\n0.5, 1.", "*DYNAMIC, EXPLICIT\n, 2."), "first")
    longer = MODEL + PRESSED.replace("*STATIC\n0.5, 1.", "*DYNAMIC, EXPLICIT\n, 2.5")
    whole = run.job(longer, 1, "whole")
    job = run.job(longer + "*RESTART, READ, STEP=1\n", 2, "second", ("--import", run.checkpoint(first)))
    a, b = whole.frame("U", -1), job.frame("U", -1)
    check("same bits at the end", float(np.array_equal(a, b) and np.abs(a).max() > 0.01), 1.0, 0.0)


def ended_step(run):
    """END STEP: the step ends where the first job was stopped, and the next one takes what flies on from there."""
    first = run.stopped(FLYING, "first")
    with h5py.File(run.checkpoint(first)) as file:
        place, increment = file.attrs["step_time"], file.attrs["time_increment"]
    second = FLYING + "*RESTART, READ, STEP=1, END STEP\n*STEP, NAME=TWO\n*DYNAMIC, EXPLICIT\n, 0.25\n*END STEP\n*STEP, NAME=THREE\n*DYNAMIC, EXPLICIT\n, 0.25\n*END STEP\n"
    job = run.job(second, 1, "second", ("--import", run.checkpoint(first)))
    check("distance", job.frame("U", -1, 2)[:, 0].mean(), 2.0 * (place + increment + 0.25), 1e-12)
    check("distance in the end", job.frame("U", -1, 3)[:, 0].mean(), 2.0 * (place + increment + 0.5), 1e-12)
    again = run.job(second, 1, "in_two", ("--import", run.checkpoint(first), "--until", "TWO"))
    again = run.job(second, 2, "in_two", ("--restart",))
    check("same bits when that is restarted", same_steps(job, again, (2, 3)), 1.0, 0.0)
    pushed = second.replace("*INITIAL", "*AMPLITUDE, NAME=A\n0., 1., 1., 0.5\n*INITIAL", 1).replace("EXPLICIT\n, 1.\n", "EXPLICIT\n, 1.\n*CLOAD, AMPLITUDE=A\nALL, 1, 1.\n", 1)
    job = run.job(pushed, 1, "third", ("--import", run.checkpoint(first)), 2)
    check("a load that the next step holds is refused", float(job.output.count("holds what the amplitude of")), 1.0, 0.0)


def tumbling(run):
    """A body that tumbles at a spring from a rod: how far it gives way, and with it what bounds the rod's increment, was found when the step
    began. It goes on with the same bits from where it was stopped, on other ranks."""
    deck = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
7, 1., 1., 0.
8, 1.5, 1.1, 0.2
9, 0.6, 0.8, 0.3
*ELEMENT, TYPE=T3D2, ELSET=ROD
1, 1, 2
2, 2, 3
*SOLID SECTION, ELSET=ROD, MATERIAL=ROD
1.
*MATERIAL, NAME=ROD
*ELASTIC
1000., 0.
*DENSITY
1.
*ELEMENT, TYPE=MASS, ELSET=MASS
21, 7
22, 8
23, 9
*MASS, ELSET=MASS
1.
*NSET, NSET=BODY
7, 8, 9
*RIGID BODY, PIN NSET=BODY, REF NODE=7
*ELEMENT, TYPE=ROTARYI, ELSET=TURNS
31, 7
*ROTARY INERTIA, ELSET=TURNS
0.2, 0.3, 0.4
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
11, 2, 8
*SPRING, ELSET=SPRING

300.
*ELEMENT, TYPE=DASHPOTA, ELSET=DASHPOT
12, 2, 8
*DASHPOT, ELSET=DASHPOT

2.
*BOUNDARY
1, 1, 3
3, 1, 3
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
BODY, 3., 1., 0.
1., 1., 0., 0., 0., 1.
*STEP
*DYNAMIC, EXPLICIT
, 2.
*RESTART, WRITE, NUMBER INTERVAL=1
*OUTPUT, FIELD, NUMBER INTERVAL=4, PRECISION=DOUBLE
*NODE OUTPUT
U, V, RF
*OUTPUT, HISTORY, TIME INTERVAL=0.01
*ENERGY OUTPUT
ALLKE, ALLIE, ALLVD, ALLWK, ETOTAL
*END STEP
"""
    whole = run.job(deck, 1, "whole")
    run.stopped(deck, "in_two")
    job = run.job(deck, 2, "in_two", ("--restart",))
    check("same bits", same_steps(whole, job, (1,)), 1.0, 0.0)
    check("it tumbles", float(np.abs(whole.frame("U", -1)).max() > 0.5), 1.0, 0.0)


def kept_states(run):
    """A job keeps every state that *RESTART, WRITE asks for, unless it says OVERLAY: others start from any of them."""
    deck = MODEL + PRESSED.replace("NUMBER INTERVAL=1", "NUMBER INTERVAL=4") + THROWN.format(0.2)
    whole = run.job(deck, 2, "whole")
    kept = {step: sorted(int(path.name.split("increment")[1].split(".")[0]) for path in whole.folder.glob(f"{whole.name}.step{step}.*"))
            for step in (1, 2)}
    check("states of the explicit step", len(kept[2]), 4, 0)
    source = ("--import", run.checkpoint(whole))
    for what, asked in (("INTERVAL", "STEP=2, INTERVAL=2"), ("INC", f"INC={kept[2][0]}")):
        job = run.job(deck + f"*RESTART, READ, {asked}\n", 1, what, source)
        check(f"same bits at the end from {what}", float(np.array_equal(whole.frame("U", -1, 2), job.frame("U", -1, 2))), 1.0, 0.0)
    job = run.job(deck + "*RESTART, READ, STEP=1\n", 1, "after_one", source)
    check("same bits from the end of the first step", same_steps(whole, job, (2,)), 1.0, 0.0)
    imported = MODEL + "*IMPORT, STATE=YES, UPDATE=NO, STEP=2, {}\nBAR\n" + THROWN.format(0.01).replace("*END", OUTPUT + "*END")
    job = run.job(imported.format(f"INCREMENT={kept[2][1]}"), 2, "imported", source)
    with h5py.File(whole.folder / f"{whole.name}.step2.increment{kept[2][1]}.ckpt.h5") as state, h5py.File(job.folder / f"{job.name}.h5") as file:
        place = file["mesh/node/coordinates"][()] + job.frame("U", 0)
        check("place where *IMPORT begins", np.abs(place - state["position"][()]).max(), 0.0, 1e-15)
    told = run.job(imported.format("INTERVAL=9"), 2, "missing", source, 2).output
    check("what is kept is told", float(f"no state of interval 9 of step 2 is kept" in told and f"increment {kept[2][0]} of step 2" in told), 1.0, 0.0)
    last = run.job(deck.replace("NUMBER INTERVAL=4", "NUMBER INTERVAL=4, OVERLAY"), 1, "whole")
    check("OVERLAY, and what an earlier run has kept", len(list(last.folder.glob("*.step*.ckpt.h5"))), 0, 0)
    told = run.job(imported.format("INTERVAL=1"), 1, "overlaid", source, 2).output
    check("how to keep states is told", float(told.count("without OVERLAY")), 1.0, 0.0)


def refusals(run):
    """What cannot be gone on from is told."""
    first = run.job(MODEL + PRESSED, 1, "first")
    source = ("--import", run.checkpoint(first))
    cases = {
        "of another step": (MODEL + PRESSED + "*RESTART, READ, STEP=2\n" + AGAIN, "at the end of step 1, not of step 2"),
        "without anything to do": (MODEL + PRESSED + "*RESTART, READ, STEP=1\n", "nothing is left to do"),
        "of other times": (MODEL + PRESSED.replace("0.5, 1.", "0.5, 2.") + "*RESTART, READ\n" + AGAIN, "the steps before end at time 1 in"),
        "of another model": (MODEL.replace("1000.", "1000.\n*DAMPING, ALPHA=1.").replace("0.5E6", "0.6E6") + PRESSED + "*RESTART, READ\n" + AGAIN,
                             "its sections and materials differ"),
    }
    for what, (text, message) in cases.items():
        for ranks in (1, 2) if what == "of other times" else (1,):
            job = run.job(text, ranks, "second", source, 2)
            check(f"a checkpoint {what} is refused on {ranks} ranks", float(job.output.count(message)), 1.0, 0.0)
    job = run.job(MODEL + PRESSED + "*RESTART, READ\n" + AGAIN, 1, "second", (), 2)
    check("no job is named", float("run with --import OLD.ckpt.h5" in job.output), 1.0, 0.0)


CASES = {case.__name__: case for case in (more_steps, longer_step, ended_step, tumbling, kept_states, refusals)}

if __name__ == "__main__":
    name, program, folder = sys.argv[1:4]
    subprocess.run(["rm", "-rf", folder], check=True)
    CASES[name](Runner(name, program, folder))
    sys.exit(1 if failures else 0)
