"""Forces on all matter of a set against closed forms: body_load_cases.py CASE BALOCCO FOLDER."""
import sys

from static_cases import ELASTIC
from static_model import OUTPUT, Deck, Runner, brick, close


def bar(kind, axis, count, length, material):
    """A bar of cross-section 0.5 x 0.5 along an axis, its end at the origin held."""
    counts, lengths = [1, 1, 1], [0.5, 0.5, 0.5]
    counts[axis], lengths[axis] = count, length
    deck = brick(tuple(counts), tuple(lengths), kind)
    deck.sets["ROOT"] = [n for n, x in deck.nodes.items() if x[axis] < 1e-9]
    deck.sets["TIP"] = [n for n, x in deck.nodes.items() if x[axis] > length - 1e-9]
    deck.add(material)
    return deck


def volume_force(runner):
    """A bar pulled by a force b by volume along it: b L^2 / 2E, exact at the nodes of equal elements; a volume needs no density."""
    length, young, force, count = 4.0, 1e6, 1.0, 8
    material = ELASTIC.format(young=young, poisson=0.0).replace("*DENSITY\n1e-9\n", "")
    for kind in ("C3D8R", "C3D8"):
        for axis, label in enumerate(("BX", "BY", "BZ")):
            deck = bar(kind, axis, count, length, material)
            for nlgeom in ("", ", NLGEOM"):
                deck.add("*STEP%s\n*STATIC\n1., 1.\n*BOUNDARY\nROOT, 1, 3\n*DLOAD, OP=NEW" % nlgeom)
                deck.add("ALL, %s, %g" % (label, force) + OUTPUT + "*END STEP")
            run = runner.run_alike if axis == 0 else runner.run
            results = run("force_%s_%s" % (kind.lower(), label.lower()), deck)
            for step in (1, 2):
                tip = results.at(deck.sets["TIP"][0], "U", step)[axis]
                close(tip, 0.5 * force * length**2 / young, 1e-5, "%s %s step %d: tip" % (kind, label, step))
                reaction = sum(results.at(n, "RF", step)[axis] for n in deck.sets["ROOT"])
                close(reaction, -force * length * 0.25, 1e-8, "%s %s step %d: reaction" % (kind, label, step))


def spinning_rod(runner):
    """A rod that turns about an axis through its root: rho w^2 L^3 / 3E at the tip, rho A w^2 L^2 / 2 at the root. Loads lumped at
    the nodes of 16 elements make that h^2 / 2 L^2 = 0.2 % more. The axis is along y, off the origin by a shift along itself."""
    length, young, density, speed = 4.0, 1e6, 0.1, 3.0
    deck = bar("C3D8", 0, 16, length, ELASTIC.format(young=young, poisson=0.0).replace("1e-9", "%g" % density))
    deck.add("*STEP\n*STATIC\n1., 1.\n*BOUNDARY\nROOT, 1, 3\n*DLOAD")
    deck.add("ALL, CENTRIF, %g, 0., 7., 0.25, 0., -2., 0." % speed**2 + OUTPUT + "*END STEP")
    deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n" + OUTPUT + "*END STEP")  # the same, with strains too small to tell
    results = runner.run_alike("spinning_rod", deck)
    for step in (1, 2):
        close(results.at(deck.sets["TIP"][0], "U", step)[0], density * speed**2 * length**3 / (3.0 * young), 3e-3, "tip")
        reaction = sum(results.at(n, "RF", step)[0] for n in deck.sets["ROOT"])
        close(reaction, -0.5 * density * 0.25 * speed**2 * length**2, 1e-5, "root")


def spun_mass(runner):
    """A mass on a spring of length 1 that turns about the other end: k r0 / (k - m w^2) once it is far out, which one increment
    finds because the load's stiffness is exact; a dynamic step from there, with the same load, stays at rest."""
    stiffness, mass, square = 100.0, 2.0, 15.0
    deck = Deck()
    deck.add_node(1, 0.0, 0.0, 0.0)
    deck.add_node(2, 1.0, 0.0, 0.0)
    deck.sets["MASSES"] = [2]
    deck.add("*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n1, 1, 2\n*SPRING, ELSET=SPRING\n\n%g" % stiffness)
    deck.add("*ELEMENT, TYPE=MASS, ELSET=MASS\n2, 2\n*MASS, ELSET=MASS\n%g\n*BOUNDARY\n1, 1, 3\n2, 2, 3" % mass)
    deck.add("*STEP, NLGEOM\n*STATIC, DIRECT\n1., 1.\n*DLOAD\nMASS, CENTRIF, %g, 0., 0., 0., 0., 0., 1." % square)
    deck.add(OUTPUT + "*END STEP")
    deck.add("*STEP\n*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n0.01, 10.\n" + OUTPUT.replace("FREQUENCY=1", "FREQUENCY=100") + "*END STEP")
    results = runner.run_alike("spun_mass", deck)
    radius = stiffness / (stiffness - mass * square)
    close(1.0 + results.at(2, "U", 1)[0], radius, 1e-10, "radius")
    for frame in range(len(results.frames(2))):
        close(1.0 + results.at(2, "U", 2, frame)[0], radius, 1e-9, "radius in frame %d" % frame)


def main():
    case, program, folder = sys.argv[1:4]
    globals()[case](Runner(program, folder))


if __name__ == "__main__":
    main()
