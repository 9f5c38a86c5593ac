"""A problem with a known answer: what is asked, which elements answer on which meshes, and the runs behind a row of the table."""
import dataclasses
import math
import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from launch import environment_of_its_own, on_ranks  # noqa: E402
from static_model import Results  # noqa: E402


LONGEST = 90.0  # seconds of one run


class Refused(Exception):
    """The program left with an error, its first message; or its results lack what was asked for."""


class Session:
    """Runs of the program in one folder; `seconds` is their wall time since it was last set to zero."""

    def __init__(self, program, folder):
        self.program, self.folder, self.seconds = program, folder, 0.0

    def run(self, name, deck, ranks=1):
        """Runs a deck (an object with write(path), or text) and opens its results."""
        os.makedirs(self.folder, exist_ok=True)
        base = os.path.join(self.folder, name)
        if isinstance(deck, str):
            with open(base + ".inp", "w") as out:
                out.write(deck)
        else:
            deck.write(base + ".inp")
        command = on_ranks(ranks) + [self.program, "run", base + ".inp", "--output", self.folder]
        start = time.time()
        try:
            with environment_of_its_own() as environment:
                done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, env=environment)
        except subprocess.TimeoutExpired:
            raise Refused("stopped after %g s" % LONGEST)
        self.seconds += time.time() - start
        if done.returncode != 0:
            said = (done.stdout + done.stderr).splitlines()
            reasons = [line for line in said if "error:" in line or line.startswith("BALOCCO FAILED")]
            raise Refused(reasons[0].replace(self.folder + "/", "") if reasons else "exit status %d" % done.returncode)
        results = Results(base + ".h5")
        results.log = open(base + ".log").read()
        return results


@dataclasses.dataclass
class Target:
    value: float
    tolerance: float  # relative; of the largest value where the value is zero


@dataclasses.dataclass
class Problem:
    """`solve(session, element, n)` gives {quantity: value}; `meshes` maps an element to the mesh numbers n, coarse to fine;
    `quick` maps an element to the error that is allowed on its coarsest mesh: the test's subset of the table."""

    name: str
    title: str
    source: str
    targets: dict
    meshes: dict
    solve: object
    mesh: object  # n -> text
    quick: dict
    notes: dict  # element, or (element, quantity), -> why a target is missed

    def note(self, element, quantity):
        return self.notes.get((element, quantity), self.notes.get(element, ""))


PROBLEMS = []


def problem(name, title, source, targets, meshes, mesh, quick=None, notes=None):
    """Registers the function below it as a problem of the table."""

    def register(solve):
        chosen = {q: Target(*t) for q, t in targets.items()}
        PROBLEMS.append(Problem(name, title, source, chosen, meshes, solve, mesh, quick or {}, notes or {}))
        return solve

    return register


def relative_error(got, target):
    return (got - target.value) / abs(target.value) if target.value else got


def rate(coarse_error, fine_error, coarse, fine):
    """Order of convergence on two meshes; None where errors are round-off or of opposite signs, which tell no order."""
    if coarse_error * fine_error <= 0.0 or abs(fine_error) < 1e-9:
        return None
    return math.log(abs(coarse_error / fine_error)) / math.log(fine / coarse)
