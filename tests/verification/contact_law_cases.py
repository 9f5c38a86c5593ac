"""Contact whose pressure follows a law of the overclosure, and interactions that steps change, through the whole program on one and two
ranks: contact_law_cases.py CASE PROGRAM FOLDER."""
import math
import sys

import numpy as np

from mesh_contact_cases import OUTPUT, YOUNG, blocks, energy, history, pair, static
from static_model import Runner, brick, close
from static_option_cases import stop_at_once

EXPLICIT_OUTPUT = OUTPUT.replace("U, RF", "U, V").replace("FIELD, FREQUENCY=1,", "FIELD, NUMBER INTERVAL=2,")


def exponential(c0, p0):
    """Abaqus Theory Guide, "Contact pressure definition": pressure and work."""
    def pressure(d):
        x = max(0.0, 1.0 + d / c0)
        return p0 / (math.e - 1.0) * x * math.expm1(x)
    return "EXPONENTIAL\n%.17g, %.17g" % (c0, p0), pressure


def table(rows):
    def pressure(d):
        overclosures, pressures = [row[1] for row in rows], [row[0] for row in rows]
        if d > overclosures[-1]:
            return pressures[-1] + (d - overclosures[-1]) * (pressures[-1] - pressures[-2]) / (overclosures[-1] - overclosures[-2])
        return float(np.interp(d, overclosures, pressures))
    return "TABULAR\n" + "\n".join("%.17g, %.17g" % row for row in rows), pressure


def linear(slope):
    return "LINEAR\n%.17g" % slope, lambda d: max(0.0, slope * d)


def on_road(cells=2, poisson=0.0, kind="C3D8", young=YOUNG):
    """A unit block on a flat rigid road, FOOT on GROUND. Sets TOP and SOLE."""
    deck = brick((cells, cells, 1), (1.0, 1.0, 1.0), kind)
    deck.sets["TOP"] = deck.where(lambda x, y, z: z == 1.0)
    deck.sets["SOLE"] = deck.where(lambda x, y, z: z == 0.0)
    deck.add_node(90000, 0.0, 0.0, 0.0)
    deck.add("*ELSET, ELSET=UPPER, GENERATE\n1, %d\n*SURFACE, NAME=FOOT\nUPPER, S1" % cells ** 2)
    deck.add("*SURFACE, TYPE=CYLINDER, NAME=GROUND\n0., 0., 0., 1., 0., 0.\n0., 1., 0.\nSTART, -50., 0.\nLINE, 50., 0.")
    deck.add("*RIGID BODY, ANALYTICAL SURFACE=GROUND, REF NODE=90000")
    deck.add("*SOLID SECTION, ELSET=UPPER, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n%g, %g\n*DENSITY\n1e-3" % (young, poisson))
    deck.sets["BASE"] = [90000]
    return deck


def model(master, **options):
    """Blocks on a base of equal faces, or on a road: deck, how many of them yield."""
    if master == "road":
        return on_road(**options), 1
    kind = options.pop("kind", "C3D8")
    young = options.pop("young", YOUNG)
    return blocks(2, 2, kinds=(kind, kind), young=(young, young), **options), 2


def behavior(text):
    return "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=" + text


def pressed(runner):
    """The pressure p and the overclosure d of a block pushed down by w are those of the law: w = d + p h / E over the heights h that yield
    (strains of 1e-6, so that the rest of large deformations is that). From a clearance to far behind the table."""
    laws = {"exponential": exponential(2e-6, 1e-3), "table": table([(0.0, -1e-6), (2e-4, 0.0), (1e-3, 1e-6), (4e-3, 2e-6)]),
            "linear": linear(700.0)}
    for master in ("road", "faces"):
        for name, (text, law) in laws.items():
            deck, heights = model(master)
            pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE", behavior(text))
            overclosures = (-7e-7, 4e-7, 1.5e-6, 2.5e-6) if name != "linear" else (4e-7, 1.5e-6, 2.5e-6)
            for d in overclosures:
                static(deck, "*BOUNDARY\nBASE, 1, 3\nTOP, 1, 2\nTOP, 3, 3, %.17g\n" % -(d + law(d) * heights / YOUNG))
                deck.text[-1] = deck.text[-1].replace("BASE, 1, 3", "BASE, 1, %d" % (6 if master == "road" else 3))
            results = runner.run_alike("%s_%s" % (master, name), deck)
            worst = 0.0
            for step, d in enumerate(overclosures, 1):
                stress = -results.element("C3D8", "S", step)[..., 2]
                worst = max(worst, np.abs(stress - law(d)).max() / law(d))
                gap = [results.at(n, "COPEN", step) for n in deck.sets["SOLE"]]
                assert np.abs(np.array(gap) + d).max() < 1e-5 * abs(d), "%s, %s: gap %s, overclosure %g" % (master, name, gap, d)
            print("%s, %s: stress is off by %.1e" % (master, name, worst))
            assert worst < 5e-5  # Newton's last correction


def standing(runner):
    """Pressed in statics behind where an explicit step's law goes on straight, a block stands still when an explicit step takes it over."""
    for master in ("road", "faces"):
        for name, text in (("bounded", "EXPONENTIAL\n0.01, 1.5, 300."), ("automatic", "EXPONENTIAL\n0.002, 0.5"),
                           ("table", "TABULAR\n0., -0.01\n1., 0.\n5., 0.005"), ("linear", "LINEAR\n400.")):
            deck, _ = model(master, kind="C3D8R", poisson=0.3)
            pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE", "*FRICTION\n0.3\n" + behavior(text))
            static(deck, "*BOUNDARY\nBASE, 1, %d\nTOP, 2, 2\nTOP, 3, 3, -0.02\nTOP, 1, 1, 0.001\n" % (6 if master == "road" else 3), "0.5, 1.")
            deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.01\n*BULK VISCOSITY\n0., 0.\n%s*END STEP" % EXPLICIT_OUTPUT)
            results = runner.run("standing_%s_%s" % (master, name), deck, 2)
            before, after = history(results, "CFN", 1)[-1][2], history(results, "CFN", 2)[:, 2]
            moved = np.abs(after - before).max() / before
            kinetic, inner = energy(results, "ALLKE", 2), energy(results, "ALLIE", 2)
            print("%s, %s: force moves by %.1e, kinetic energy %.1e of the inner" % (master, name, moved, kinetic.max() / inner.max()))
            assert before > 0.0 and moved < 1e-3 and kinetic.max() < 1e-6 * inner.max()


def released(runner):
    """As standing(), then let go: what the law had stored, all of it, is in the motion or in the books."""
    for master in ("road", "faces"):
        for text in ("EXPONENTIAL\n0.01, 1.5, 300.", "EXPONENTIAL\n0.002, 0.5"):
            deck, _ = model(master, kind="C3D8R")
            pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE", behavior(text))
            base = 6 if master == "road" else 3
            static(deck, "*BOUNDARY\nBASE, 1, %d\nTOP, 1, 2\nTOP, 3, 3, -0.02\n" % base, "0.25, 1.")
            deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.05\n*BULK VISCOSITY\n0., 0.\n*BOUNDARY, OP=NEW\nBASE, 1, %d\n%s*END STEP" % (
                base, EXPLICIT_OUTPUT.replace("HISTORY, FREQUENCY=1", "HISTORY, TIME INTERVAL=1e-4")))
            results = runner.run("released_%s_%s" % (master, "automatic" if "0.5" in text else "bounded"), deck)
            stored, total = energy(results, "ALLIE", 1)[-1], energy(results, "ETOTAL", 2)
            drift = np.abs(total - total[0]).max() / stored
            print("%s: energy moves by %.1e of what was stored" % (master, drift))
            assert energy(results, "ALLKE", 2).max() > 0.5 * stored and drift < 2e-2, drift


def bouncing(runner):
    """A stiff block of mass m = 1e-3 comes down at v = 1 on a soft law and goes up as it came: no energy is lost, and the greatest force is
    that at which the law has taken m v^2 / 2."""
    for master in ("road", "faces"):
        for name, (text, law) in {"exponential": exponential(0.02, 0.01), "table": table([(0.0, 0.0), (0.01, 0.01), (0.05, 0.03)]),
                                  "linear": linear(1.0)}.items():
            deck, _ = model(master, kind="C3D8R", young=1e4)
            deck.sets["FALLING"] = [n for n in deck.nodes if n > 10000 and n != 90000] if master == "faces" else [n for n in deck.nodes if n != 90000]
            pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE", behavior(text))
            if master == "faces":
                deck.sets["BASE"] = [n for n in deck.nodes if n < 10000]
            deck.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nFALLING, 3, -1.")
            deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.15\n*BULK VISCOSITY\n0., 0.\n*BOUNDARY\nBASE, 1, %d\n%s*END STEP" % (
                6 if master == "road" else 3, EXPLICIT_OUTPUT.replace("HISTORY, FREQUENCY=1", "HISTORY, TIME INTERVAL=2e-4")))
            results = runner.run("bouncing_%s_%s" % (master, name), deck, 2 if name == "exponential" else 1)
            total = energy(results, "ETOTAL")
            work, d, step = 0.0, 0.0, 1e-6  # the sole begins on the ground
            while work < 0.5e-3:
                work += step * law(d + 0.5 * step)
                d += step
            force = history(results, "CFN")[:, 2]
            drift = np.abs(total - total[0]).max() / 0.5e-3
            print("%s, %s: energy moves by %.1e; greatest force %.6g, expected %.6g" % (master, name, drift, force.max(), law(d)))
            close(force.max(), law(d), 1e-2, "greatest force")
            assert drift < 1e-3 and force[-1] < 0.02 * law(d), (drift, force[-1])


def hard_blow(runner):
    """A law as stiff as the block: its springs close and open between the instants of the loop, and make no energy of that."""
    deck, _ = model("road", kind="C3D8R", young=1e3)
    deck.sets["FALLING"] = [n for n in deck.nodes if n != 90000]
    pair(deck, "NODE TO SURFACE", behavior(linear(2e4)[0]))
    deck.add("*INITIAL CONDITIONS, TYPE=VELOCITY\nFALLING, 3, -2.")
    deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.01\n*BULK VISCOSITY\n0., 0.\n*BOUNDARY\nBASE, 1, 6\n%s*END STEP" % EXPLICIT_OUTPUT)
    total = energy(runner.run("hard_blow", deck), "ETOTAL")
    drift = np.abs(total - total[0]).max() / total[0]
    print("energy moves by %.1e" % drift)
    assert drift < 1e-2, drift


def drawn(master):
    """Pressed and drawn along without friction; friction comes in, grows while the block is drawn on, and falls."""
    deck, _ = model(master) if master == "road" else (blocks(3, 1, at=(0.15, 1.0), size=(3.0, 1.0)), 2)
    pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE", "*FRICTION\n0.")
    base = 6 if master == "road" else 3
    held = "*BOUNDARY\nBASE, 1, %d\nTOP, 2, 2\nTOP, 3, 3, -0.01\nTOP, 1, 1, %g\n"
    change = "*CHANGE FRICTION, INTERACTION=TOUCH\n*FRICTION\n%g\n"
    static(deck, held % (base, 0.0))
    static(deck, held % (base, 0.3), "0.25, 1., 1e-5, 0.25")
    static(deck, change % 0.2 + held % (base, 0.3), "0.5, 1., 1e-5, 0.5")
    static(deck, change % 0.4 + held % (base, 0.7), "0.1, 1., 1e-5, 0.1")
    static(deck, change % 0.1 + held % (base, 0.9), "0.1, 1., 1e-5, 0.1")
    return deck, base


def friction_comes_in(runner):
    """Friction that comes in on a block at rest exerts nothing; on one that slides it is mu(t) N at all times, mu being on the straight line
    between the coefficients of the step before and of this one. An explicit step has the new coefficient at once."""
    for master in ("road", "faces"):
        deck, base = drawn(master)
        deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.2\n*CHANGE FRICTION, INTERACTION=TOUCH\n*FRICTION\n0.3\n"
                 "*BOUNDARY, TYPE=VELOCITY\nTOP, 1, 1, 0.5\n%s*END STEP" % EXPLICIT_OUTPUT)
        results = runner.run_alike("comes_in_" + master, deck)
        for step in (1, 2, 3):
            friction, normal = np.abs(history(results, "CFT", step)).max(), history(results, "CFN", step)[-1][2]
            assert friction < 1e-6 * normal, "%s, step %d: friction %g of %g" % (master, step, friction, normal)
        for step, before, after in ((4, 0.2, 0.4), (5, 0.4, 0.1)):
            time = history(results, "time", step)
            time = time - (step - 1.0)
            friction, normal = -history(results, "CFT", step)[:, 0], history(results, "CFN", step)[:, 2]
            sliding = time > 0.35 if step == 4 else time > 0.05
            expected = (before + time * (after - before)) * normal
            worst = np.abs(friction / expected - 1.0)[sliding].max()
            print("%s, step %d: friction is off by %.1e" % (master, step, worst))
            assert worst < 1e-6
        friction, normal = -history(results, "CFT", 6)[:, 0], history(results, "CFN", 6)[:, 2]
        assert (friction / normal).max() < 0.3 * (1 + 1e-6)  # the sudden start rings in shear: some points stick at times
        close(np.median(friction / normal), 0.3, 5e-2, master + ": friction of the explicit step")


def friction_comes_in_explicit(runner):
    """A block that an explicit step has drawn along without friction stops, and friction comes in: it begins to stick where it stands, so
    that at first there is none, not mu N for the whole way."""
    for master in ("road", "faces"):
        deck, _ = model(master, kind="C3D8R") if master == "road" else (blocks(3, 1, at=(0.15, 1.0), size=(3.0, 1.0), kinds=("C3D8R", "C3D8R")), 2)
        pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE")
        base = 6 if master == "road" else 3
        static(deck, "*BOUNDARY\nBASE, 1, %d\nTOP, 2, 2\nTOP, 3, 3, -0.01\nTOP, 1, 1, 0.\n" % base)
        deck.add("*AMPLITUDE, NAME=STOP, DEFINITION=SMOOTH STEP\n0., 0., 0.1, 1.")
        often = EXPLICIT_OUTPUT.replace("HISTORY, FREQUENCY=1", "HISTORY, TIME INTERVAL=1e-4")
        for change, condition in (("", "*BOUNDARY, AMPLITUDE=STOP\nTOP, 1, 1, 0.2\n"), ("*CHANGE FRICTION, INTERACTION=TOUCH\n*FRICTION\n0.3\n", "")):
            deck.add("*STEP, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, 0.1\n%s%s%s*END STEP" % (change, condition, often))
        results = runner.run("explicit_" + master, deck, 2)
        sliding = np.abs(history(results, "CFT", 2)).max()
        friction, normal = np.abs(history(results, "CFT", 3)).max(axis=1), history(results, "CFN", 3)[:, 2]
        moved = np.mean([results.at(n, "U", 3)[0] for n in deck.sets["SOLE"]])
        print("%s: friction %.1e of mu N at first, %.1e at most" % (master, friction[0] / (0.3 * normal[0]), (friction / normal).max() / 0.3))
        assert sliding == 0.0 and normal.min() > 0.0 and abs(moved - 0.2) < 1e-2, (sliding, normal.min(), moved)
        assert (friction / normal).max() < 0.05 * 0.3


def friction_restarted(runner):
    """A job stopped after each first increment, where friction is between two values, ends as one that was left alone."""
    for master in ("road", "faces"):
        whole = runner.run("whole_" + master, drawn(master)[0], 1)
        stop_at_once(runner, "restarted_" + master, drawn(master)[0], 2, ())
        taken_up = runner.run("restarted_" + master, drawn(master)[0], 1, ("--restart",), "stopped_restarted_" + master)
        for step in (3, 4, 5):
            for variable in ("U", "RF"):
                apart = np.abs(whole.node(variable, step) - taken_up.node(variable, step)).max()
                assert apart < 1e-9 * np.abs(whole.node(variable, step)).max(), "%s of step %d is off by %g" % (variable, step, apart)


def behavior_changes(runner):
    """*CHANGE SURFACE BEHAVIOR: hard, then soft, then hard again at one push: each step has its own law's pressure."""
    soft, law = linear(700.0)
    squeeze = 3e-6
    for master in ("road", "faces"):
        deck, heights = model(master)
        pair(deck, "SURFACE TO SURFACE" if master == "faces" else "NODE TO SURFACE")
        held = "*BOUNDARY\nBASE, 1, %d\nTOP, 1, 2\nTOP, 3, 3, %g\n" % (6 if master == "road" else 3, -squeeze)
        change = "*CHANGE SURFACE BEHAVIOR, INTERACTION=TOUCH\n"
        static(deck, held)
        static(deck, change + behavior(soft) + "\n" + held)
        static(deck, change + "*SURFACE BEHAVIOR\n" + held)
        results = runner.run_alike("changes_" + master, deck)
        stress = [-results.element("C3D8", "S", step)[..., 2].mean() for step in (1, 2, 3)]
        close(stress[1], squeeze / (heights / YOUNG + 1.0 / 700.0), 1e-5, master + ": soft")
        close(stress[2], stress[0], 1e-5, master + ": hard again")
        assert stress[0] > 1.1 * stress[1]


def tied(runner):
    """PRESSURE-OVERCLOSURE=TIED holds across and pulls, by the slopes of *FRICTION and of its own, as springs between the blocks whatever
    the coefficient is, and LINEAR lets go. Explicit steps, which do not compute such springs, refuse them."""
    law = behavior("TIED\n700.") + "\n*FRICTION\n1e-4, 300."
    deck = blocks(2, 4)
    deck.sets["EVERY"] = list(deck.nodes)
    pair(deck, "SURFACE TO SURFACE", law)
    shear, pull = 2e-6, 3e-6
    static(deck, "*BOUNDARY\nEVERY, 1, 2\nBASE, 3, 3\nTOP, 3, 3, %g\n" % pull)
    sheared = "*BOUNDARY, OP=NEW, FIXED\nEVERY, 3, 3\n*BOUNDARY, OP=NEW\nEVERY, 2, 2\nBASE, 1, 1\nTOP, 1, 1, %g\n" % shear
    static(deck, sheared)
    static(deck, "*CHANGE SURFACE BEHAVIOR, INTERACTION=TOUCH\n" + behavior("LINEAR\n700.") + "\n" + sheared)
    results = runner.run_alike("tied", deck)
    stress = results.element("C3D8", "S", 1)[:, 2]
    close(np.abs(stress * (2.0 / YOUNG + 1.0 / 700.0) / pull - 1.0).max(), 0.0, 1e-5, "stress")
    stress = results.element("C3D8", "S", 2)[:, 4]
    close(np.abs(stress * (4.0 / YOUNG + 1.0 / 300.0) / shear - 1.0).max(), 0.0, 1e-5, "shear stress")
    close(energy(results, "ETOTAL", 2)[-1] / energy(results, "ALLIE", 2)[-1], 0.0, 1e-5, "energy balance")
    close(np.abs(history(results, "CFN", 3)[-1]).max() + np.abs(history(results, "CFT", 3)[-1]).max(), 0.0, 1e-12, "force once open")
    deck = blocks(2, 4)
    pair(deck, "SURFACE TO SURFACE", law)
    deck.add("*STEP\n*DYNAMIC, EXPLICIT\n, 1.\n*END STEP")
    done, _ = runner.launch("refused", deck, 1)
    assert done.returncode == 2 and "use *TIE" in done.stdout + done.stderr, done.stdout + done.stderr


CASES = {f.__name__: f for f in (pressed, standing, released, bouncing, hard_blow, friction_comes_in, friction_comes_in_explicit, friction_restarted, behavior_changes, tied)}

if __name__ == "__main__":
    CASES[sys.argv[1]](Runner(sys.argv[2], sys.argv[3]))
