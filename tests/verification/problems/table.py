#!/usr/bin/python3
"""table.py PROGRAM FOLDER [--quick] [--only NAME] [--element TYPE] [--jobs N] [--write FILE]: runs the problems, prints or writes
their table.

--quick runs the subset that the problems name, on their coarsest meshes, and fails where an error exceeds what is allowed there.
"""
import argparse
import concurrent.futures
import sys

import bars  # noqa: F401
import contact  # noqa: F401
import dynamics  # noqa: F401
import elements
import frequencies  # noqa: F401
import harmonics  # noqa: F401
import laws  # noqa: F401
import metals  # noqa: F401
import sheets  # noqa: F401
from verification import PROBLEMS, Refused, Session, rate, relative_error

HEAD = """# What the problems with known answers gave

Written by `bash tests/verification/results.sh` from runs of the program; the problems are in `problems/`. The seconds are those of
all runs behind a line, each on one rank, on a machine that did other work beside.
Order: of convergence from one mesh to the next; none where errors are round-off or change their sign.
A target that the finest mesh misses by more than its tolerance is marked, with the reason.
"""
TABLE = """
| quantity | element | mesh | got | target | error | order | s | |
|---|---|---|---|---|---|---|---|---|
"""


def percent(error, target):
    """An error relative to its target; as it is where the target is zero."""
    return "%+.2f %%" % (100 * error) if target.value else "%+.1e" % error


class Report:
    """Lines of the table, and what is to be said about all of them."""

    def __init__(self):
        self.lines, self.missed, self.refused, self.reached = [], [], [], 0

    def problem(self, chosen, outcomes):
        """`outcomes`: element -> what attempt() found."""
        self.lines.append("\n### %s: %s\n\nTarget: %s.\n%s" % (chosen.name, chosen.title, chosen.source, TABLE.rstrip("\n")))
        for kind, found in outcomes.items():
            if isinstance(found, Refused):
                self.refused.append("%s by %s: %s" % (chosen.name, kind, found))
                continue
            for quantity, target in chosen.targets.items():
                self.quantity(chosen, kind, quantity, target, found)

    def quantity(self, chosen, kind, quantity, target, found):
        meshes = chosen.meshes[kind]
        errors = [relative_error(got[quantity], target) for got, _ in found]
        for i, ((got, seconds), n) in enumerate(zip(found, meshes)):
            order = rate(errors[i - 1], errors[i], meshes[i - 1], n) if i else None
            note = ""
            if i == len(meshes) - 1 and abs(errors[i]) > target.tolerance:
                note = "missed (%g %%): %s" % (100 * target.tolerance, chosen.note(kind, quantity) or "not explained")
                self.missed.append("%s, %s by %s: %s" % (chosen.name, quantity, kind, percent(errors[i], target)))
            elif i == len(meshes) - 1:
                self.reached += 1
            self.lines.append("| %s | %s | %s | %.5g | %.5g | %s | %s | %.1f | %s |" % (
                quantity, kind, chosen.mesh(n), got[quantity], target.value, percent(errors[i], target),
                "" if order is None else "%.1f" % order, seconds, note))

    def summary(self):
        lines = ["\n%d targets reached on the finest mesh, %d missed." % (self.reached, len(self.missed))]
        return "\n".join(lines + (["\nNot run:\n"] + ["- " + r for r in self.refused] if self.refused else [])) + "\n"


ELEMENTS_HEAD = """
## What holds for every element

Patch: largest distance of inner nodes of an irregular mesh from a motion of constant strain, or of constant curvature, that is given at
the outer nodes, over the largest displacement. Rotated: largest stress over Young's modulus after a turn by 120 degrees about a
slanted axis. Zero modes of one skewed element, and how many there must be.

| element | stretched | bent | rotated | zero modes | must be |
|---|---|---|---|---|---|
"""
IMPORT_HEAD = """
## From statics to dynamics and back

A loaded static state starts an explicit step: forces out of balance over the loads, and the largest motion in that step over the static
displacement. Then the load grows by a tenth, dynamically, and a static step takes over: its Newton iterations.

| element | law | out of balance | motion | iterations |
|---|---|---|---|---|
"""


def element_tables(rows, imports, report):
    """Two tables: elements, and elements with laws; each row a future."""
    number = lambda value: "" if value is None else "%.0e" % value if isinstance(value, float) else str(value)
    text = ""
    for head, table in ((ELEMENTS_HEAD, rows), (IMPORT_HEAD, imports)):
        text += head
        for names, row in table.items():
            try:
                text += "| %s | %s |\n" % (" | ".join(names), " | ".join(number(v) for v in row.result()))
            except Refused as reason:
                report.refused.append("%s: %s" % (" with ".join(names), reason))
    return text


def attempt(session, chosen, kind):
    """Values and seconds on each mesh of an element, or why there are none."""
    try:
        return [measure(session, chosen, kind, n) for n in chosen.meshes[kind]]
    except Refused as reason:
        return reason


def measure(session, chosen, kind, n):
    session.seconds = 0.0
    try:
        return chosen.solve(session, kind, n), session.seconds
    except KeyError as missing:
        raise Refused("the results lack %s" % missing)


def quick(session, chosen):
    """The problems' own short subset; True where all errors are within what is allowed."""
    good = True
    for kind, allowed in chosen.quick.items():
        got, seconds = measure(session, chosen, kind, chosen.meshes[kind][0])
        for quantity, target in chosen.targets.items():
            error = relative_error(got[quantity], target)
            within = abs(error) <= allowed
            good = good and within
            print("%s %s, %s by %s: %.6g, target %.6g, off by %+.2e (allowed %g), %.1f s" % (
                "ok  " if within else "FAIL", chosen.name, quantity, kind, got[quantity], target.value, error, allowed, seconds))
    return good


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", help="part of a problem's name")
    parser.add_argument("--element")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    parser.add_argument("--write", help="the file of the whole table")
    options = parser.parse_args()
    new_session = lambda: Session(options.program, options.folder)
    chosen = [p for p in PROBLEMS if options.only is None or options.only in p.name]
    if options.quick:
        return 0 if all([quick(new_session(), p) for p in chosen]) else 1
    report = Report()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        found = {p.name: {kind: pool.submit(attempt, new_session(), p, kind) for kind in p.meshes if options.element in (None, kind)}
                 for p in chosen}
        rows, imports = {}, {}
        if options.write:
            for kind in elements.KINDS:
                rows[kind,] = pool.submit(elements.element_row, new_session(), kind)
                for law in elements.LAWS:
                    imports[kind, law] = pool.submit(elements.import_row, new_session(), kind, law)
        for p in chosen:
            before = len(report.lines)
            report.problem(p, {kind: future.result() for kind, future in found[p.name].items()})
            print("\n".join(report.lines[before:]), flush=True)
        tables = element_tables(rows, imports, report)
    print(report.summary() + "".join("missed: %s\n" % m for m in report.missed))
    if options.write:
        with open(options.write, "w") as out:
            out.write(HEAD + report.summary() + tables + "\n## Problems\n" + "\n".join(report.lines) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
