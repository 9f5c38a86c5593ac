"""JOB.dat through the whole program: print_cases.py CASE PROGRAM FOLDER."""
import os
import shutil
import re
import signal
import subprocess
import sys
import time

from solid_cases import solid
from static_model import Runner, close

PRINTS = """*NODE PRINT, NSET=LISTED, TOTALS=YES, FREQUENCY=2
U, RF
*NODE PRINT, NSET=TOP, TOTALS=ONLY
RF
*EL PRINT, ELSET=FIRST, TOTALS=YES
S, E, ENER, EVOL, ELSE
"""


def pulled(kind, counts=(2, 2, 2)):
    """A unit block pulled by 1 % in z, free to contract: E = 1000, nu = 0.25."""
    deck = solid(kind, counts, (1.0, 1.0, 1.0))
    deck.sets["LISTED"] = [9, 3, 27, 1]
    deck.sets["TOP"] = deck.where(lambda x, y, z: z > 1.0 - 1e-9)
    deck.sets["BASE"] = deck.where(lambda x, y, z: z < 1e-9)
    deck.add("*ELSET, ELSET=FIRST\n2, 1")
    deck.add("*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.25\n*DENSITY\n1e-3\n*SOLID SECTION, ELSET=ALL, MATERIAL=M")
    return deck


def blocks(path):
    """(title, rows of numbers) of each table, with the headings of steps and increments."""
    found = []
    for line in open(path):
        if re.search("[a-z]{4}|S T E P|INCREMENT", line):
            found.append((line.strip(), []))
        elif line.strip():
            found[-1][1].append([float(n) for n in line.split()])
    return found


def tables(runner):
    """Tables of every kind and their sums; the same bytes on one rank and on two."""
    for kind in ("C3D20R", "C3D8"):
        deck = pulled(kind)
        deck.add("*STEP\n*STATIC\n0.5, 1.\n*BOUNDARY\n1, 1, 2\n3, 2\nBASE, 3\nTOP, 3, 3, 0.01\n" + PRINTS + "*END STEP")
        for ranks in (1, 2):
            runner.run("tables_" + kind, deck, ranks)
        paths = [os.path.join(runner.folder, "tables_%s_%d" % (kind, r), "tables_%s.dat" % kind) for r in (1, 2)]
        one, two = ([(t, [[round(x, 9) for x in row] for row in rows]) for t, rows in blocks(p)] for p in paths)
        assert one == two, "JOB.dat differs on two ranks"
        titles = [title for title, _ in one]
        assert titles[0] == "S T E P       1" and titles[1] == "INCREMENT     1", titles[:2]
        assert "displacements (vx,vy,vz) for set LISTED and time  0.1000000E+01" in titles
        assert not any("LISTED and time  0.5" in title for title in titles), "FREQUENCY=2 prints the second increment alone"
        last = {title.split(" for set")[0]: rows for title, rows in one if "0.1000000E+01" in title}
        assert [int(row[0]) for row in last["displacements (vx,vy,vz)"]] == [9, 3, 27, 1], "the order of the deck"
        close(last["displacements (vx,vy,vz)"][2][3], 0.01, 1e-6, "displacement of the top")
        close(last["total force (fx,fy,fz)"][0][2], 10.0, 1e-6, "force on the top")
        stress = last["stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz)"]
        assert [row[:2] for row in stress[:9]] == [[2, p] for p in range(1, 9)] + [[1, 1]], "elements and points"
        close(stress[0][4], 10.0, 1e-6, "stress")
        close(last["strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz)"][0][2], -0.0025, 1e-6, "strain across")
        close(last["internal energy density (elem, integ.pnt.,energy)"][0][2], 0.05, 1e-6, "energy density")
        close(last["total volume"][0][0], 0.25, 1e-6, "volume of two elements")
        close(last["total internal energy"][0][0], 0.0125, 1e-6, "energy of two elements")


def section(runner):
    """What the top of a pulled block transmits: force, moment, area and centre; on two ranks too."""
    for kind, top in (("C3D20R", "5, S2\n6, S2\n7, S2\n8, S2"), ("C3D8", "5, S2\n6, S2\n7, S2\n8, S2")):
        deck = pulled(kind)
        deck.add("*SURFACE, NAME=CUT\n" + top)
        deck.add("*STEP\n*STATIC\n*BOUNDARY\n1, 1, 2\n3, 2\nBASE, 3\nTOP, 3, 3, 0.01\n*SECTION PRINT, SURFACE=CUT, NAME=P\nSOF, SOM\n*END STEP")
        for ranks in (1, 2):
            runner.run("section_" + kind, deck, ranks)
            path = os.path.join(runner.folder, "section_%s_%d" % (kind, ranks), "section_%s.dat" % kind)
            numbers = [rows[0] for _, rows in blocks(path) if rows]
            wanted = [[0, 0, 10, 5, -5, 0], [0.5, 0.5, 1, 0, 0, 1], [0, 0, 0], [1, 10, 0, 0, 0]]
            for got, expected in zip(numbers, wanted, strict=True):
                assert len(got) == len(expected), got
                for a, b in zip(got, expected):
                    close(a, b, 1e-6, "%s on %d ranks" % (kind, ranks))


def requests(runner):
    """Tables at time points, on which increments end; ids that no node has; TOTALS where a variable has none; places of points."""
    deck = pulled("C3D20R")
    deck.add_node(90, 0.0, 0.0, 3.0)
    deck.add("*NSET, NSET=GAPS, GENERATE\n80, 99\n*TIME POINTS, NAME=T\n0.3, 0.5\n*STEP\n*STATIC\n0.4, 1.\n"
             "*BOUNDARY\n1, 1, 2\n3, 2\nBASE, 3\nTOP, 3, 3, 0.01\n*NODE PRINT, NSET=GAPS, TIME POINTS=T\nU\n"
             "*EL PRINT, ELSET=FIRST, TOTALS=ONLY, TIME POINTS=T\nENER, EVOL, COORD\n*END STEP")
    for ranks in (1, 2):
        runner.run("requests", deck, ranks)
        found = blocks(os.path.join(runner.folder, "requests_%d" % ranks, "requests.dat"))
        times = [float(title.split()[-1]) for title, _ in found if "displacements" in title]
        for time, expected in zip(times, (0.3, 0.5, 1.0), strict=True):
            close(time, expected, 1e-6, "time of a table")
        last = {title.split(" for set")[0]: rows for title, rows in found if "0.1000000E+01" in title}
        rows = last["displacements (vx,vy,vz)"]
        assert [int(row[0]) for row in rows] == list(range(80, 91)), "the ids that GENERATE made, up to the last node"
        assert all(row[1:] == [0.0, 0.0, 0.0] for row in rows[2:]), "no node, no displacement"
        assert len(last["internal energy density (elem, integ.pnt.,energy)"]) == 16, "points of two elements: they have no totals"
        assert "volume (element, volume)" not in last and len(last["total volume"]) == 1, "totals only"
        near, far = 0.25 * (1.0 - 1.0 / 3.0**0.5), 0.25 * (1.0 + 1.0 / 3.0**0.5)
        places = last["global coordinates (elem, integ.pnt.,x,y,z)"]
        for place, x in ((places[0], (0.5 + near, near, near)), (places[7], (0.5 + far, far, far))):
            assert place[0] == 2
            for a, b in zip(place[2:], x, strict=True):
                close(a, b, 1e-6, "coordinate of a point of element 2")


def in_explicit_steps(runner):
    """At time points the first increments from there on print their tables, and no other ones."""
    deck = pulled("C3D8R")
    deck.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nTOP, 3, 0.2\n*TIME POINTS, NAME=T\n3e-4, 5e-4\n"
             "*STEP\n*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n7e-5, 1e-3\n*NODE PRINT, NSET=TOP, TIME POINTS=T\nU\n*END STEP")
    for ranks in (1, 2):
        runner.run("in_explicit_steps", deck, ranks)
        path = os.path.join(runner.folder, "in_explicit_steps_%d" % ranks, "in_explicit_steps.dat")
        found = [(title, rows) for title, rows in blocks(path) if "displacements" in title]
        for (title, rows), expected in zip(found, (3.5e-4, 5.6e-4, 1e-3), strict=True):
            close(float(title.split()[-1]), expected, 1e-6, "time of a table")
            assert len(rows) == 9 and all(0.0 < row[3] <= 0.2 * expected for row in rows), rows


def restart(runner):
    """A run that is killed and goes on from its checkpoint leaves the same file as one that is not, to the round-off of statics."""
    deck = pulled("C3D8")
    deck.add("*STEP, INC=1000\n*STATIC, DIRECT\n0.01, 1.\n*BOUNDARY\n1, 1, 2\n3, 2\nBASE, 3\nTOP, 3, 3, 0.01\n*RESTART, WRITE, FREQUENCY=7\n"
             + PRINTS + "*END STEP\n*STEP\n*STATIC, DIRECT\n0.25, 1.\n*END STEP")
    runner.run("restart", deck)
    whole = os.path.join(runner.folder, "restart_1", "restart.dat")
    folder = os.path.join(runner.folder, "stopped")
    shutil.rmtree(folder, ignore_errors=True)  # what an earlier run left there would be taken for this one's
    os.makedirs(folder)
    command = [runner.program, "run", os.path.join(runner.folder, "restart_1", "restart.inp"), "--output", folder]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    mine = os.path.join(folder, "restart.dat")
    while running.poll() is None and not (os.path.exists(mine) and "INCREMENT    12" in open(mine).read()):
        time.sleep(0.02)
    running.send_signal(signal.SIGKILL)
    running.wait()
    assert os.path.exists(os.path.join(folder, "restart.ckpt.h5")), "killed too early"
    subprocess.run(command + ["--restart"], check=True, stdout=subprocess.DEVNULL)
    rounded = lambda path: [(t, [[round(x, 7) for x in row] for row in rows]) for t, rows in blocks(path)]
    assert rounded(mine) == rounded(whole), "the file of the restarted run differs"


def main():
    case, program, folder = sys.argv[1:4]
    {"tables": tables, "section": section, "requests": requests, "in_explicit_steps": in_explicit_steps, "restart": restart}[case](Runner(program, folder))


if __name__ == "__main__":
    main()
