"""Options of static steps against closed forms, through the whole program on one and two ranks:
static_option_cases.py CASE PROGRAM FOLDER. Sources of the numbers stand with each case."""
import math
import os
import re
import sys

import numpy as np

from static_cases import ELASTIC, cantilever, foot_on_road
from static_model import OUTPUT, Deck, Results, Runner, brick, close

ENERGY = "*OUTPUT, HISTORY, FREQUENCY=1\n*ENERGY OUTPUT\nALLIE, ALLVD, ALLWK, ETOTAL\n"
TRUSS = "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n{area}\n*MATERIAL, NAME=M\n*ELASTIC\n{young}, 0.3\n*DENSITY\n1e-3"


def energy(results, variable, step=1):
    return results.file["step_%d/history/energy/%s" % (step, variable)][:]


def stop_at_once(runner, name, deck, ranks, options, expected=4):
    """The control file stands ready, so that the job is asked to stop after its first increment."""
    folder = os.path.join(runner.folder, "stopped_" + name)
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name + ".ctl"), "w") as control:
        control.write("stop\n")
    done, base = runner.launch(name, deck, ranks, options, "stopped_" + name)
    assert done.returncode == expected, "left with %d\n%s%s" % (done.returncode, done.stdout, done.stderr)
    return base


def stabilized(runner):
    """One truss pulled in four equal increments of a stabilised step. Its viscosity fades with the step, so the end is that of the
    step without. Dissipation, with f the fraction, k the stiffness and d the motion of an increment: the first uses f k as
    viscous force per motion, f k d^2 (1 - 1/4); the others f W1 (1 - i/4) with the work W1 = k d^2 / 2 of the first. In all
    f W1 (1.5 + 0.5 + 0.25) of the work 16 W1, but for changes of d of the size of f."""
    young, area, length, load, fraction = 1000.0, 0.5, 2.0, 1e-3, 2e-4
    ends = []
    for name, stabilize in (("plain", ""), ("stabilized", ", STABILIZE")):
        deck = Deck()
        deck.add_node(1, 0.0, 0.0, 0.0)
        deck.add_node(2, length, 0.0, 0.0)
        deck.elements["T3D2"] = [(1, [1, 2])]
        deck.add(TRUSS.format(area=area, young=young))
        deck.add("*STEP, NLGEOM\n*STATIC, DIRECT%s\n0.25, 1.\n*BOUNDARY\n1, 1, 3\n2, 2, 3\n*CLOAD\n2, 1, %g" % (stabilize, load))
        deck.add(OUTPUT + ENERGY + "*END STEP")
        results = runner.run(name, deck, 2)
        ends.append(results.at(2, "U")[0])
    close(ends[0], load * length / (young * area), 1e-5, "stretch")  # strain 2e-6
    close(ends[1], ends[0], 1e-8, "stretch with stabilisation")
    work = energy(results, "ALLWK")[-1]
    close(work, 0.5 * load * ends[0], 1e-3, "work")
    stop_at_once(runner, name, deck, 1, ())
    taken_up = runner.run(name, deck, 2, ("--restart",), "stopped_" + name)
    for job, what in ((results, "left alone"), (taken_up, "taken up after one increment")):
        dissipated = energy(job, "ALLVD")[-1] / work
        close(dissipated, 2.25 / 16.0 * fraction, 5.0 * fraction, "dissipated part of the work, " + what)


def snap_through(runner):
    """A shallow truss arch under twice the load that it snaps at: Newton's method alone finds no way down, stabilisation does, and
    ends where the load is carried upside down. P = (EA / L^3) (h^2 - z^2) z for two bars of Green strain with the apex at z."""
    young, area, rise = 1000.0, 1.0, 0.1
    length = math.hypot(1.0, rise)
    limit = young * area / length**3 * 2.0 * rise**3 / (3.0 * math.sqrt(3.0))

    def arch(load, stabilize):
        deck = Deck()
        for number, x, z in ((1, -1.0, 0.0), (2, 1.0, 0.0), (3, 0.0, rise)):
            deck.add_node(number, x, 0.0, z)
        deck.elements["T3D2"] = [(1, [1, 3]), (2, [3, 2])]
        deck.add(TRUSS.format(area=area, young=young))
        deck.add("*STEP, NLGEOM, INC=1000\n*STATIC%s\n0.1, 1., 1e-6, 0.1\n*BOUNDARY\n1, 1, 3\n2, 1, 3\n3, 1, 2" % stabilize)
        deck.add("*CLOAD\n3, 3, %.17g" % -load + OUTPUT.replace("FREQUENCY=1", "FREQUENCY=100") + ENERGY + "*END STEP")
        return deck

    done, _ = runner.launch("stuck", arch(2.0 * limit, ""), 1)
    assert done.returncode == 3, "without stabilisation the arch got through: exit status %d" % done.returncode
    results = runner.run("snapped", arch(2.0 * limit, ", STABILIZE"), 2)
    roots = np.roots([-1.0, 0.0, rise**2, -2.0 * limit * length**3 / (young * area)])
    z = min(root.real for root in roots if abs(root.imag) < 1e-9)
    close(results.at(3, "U")[2], z - rise, 1e-8, "motion of the apex")
    # What the load did beyond the strain energy went into the viscosity.
    work, strain, lost = (energy(results, name)[-1] for name in ("ALLWK", "ALLIE", "ALLVD"))
    # Dissipation is summed by the backward rule over some 40 increments of the snap: first order.
    close(work, strain + lost, 0.1, "work = strain energy + dissipation")


def velocity(runner):
    """*BOUNDARY, TYPE=VELOCITY in static steps: displacements are the integral of the velocity, at every increment, and go on from
    step to step. An amplitude that rises to 1 at half of the step and falls again integrates to half of it."""
    deck = brick((2, 1, 1), (2.0, 1.0, 1.0))
    deck.sets["ROOT"] = deck.where(lambda x, y, z: x < 1e-9)
    deck.sets["TIP"] = deck.where(lambda x, y, z: x > 2.0 - 1e-9)
    deck.add("*AMPLITUDE, NAME=TENT\n0., 0., 1., 1., 2., 0.")
    deck.add(ELASTIC.format(young=1000.0, poisson=0.0))
    speed = 0.02
    deck.add("*STEP, NLGEOM\n*STATIC\n0.3, 2.\n*BOUNDARY\nROOT, 1, 3\n*BOUNDARY, TYPE=VELOCITY\nTIP, 1, 1, %g" % speed)
    deck.add(OUTPUT + "*END STEP")
    deck.add("*STEP, NLGEOM\n*STATIC\n0.3, 2.\n*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=TENT\nTIP, 1, 1, %g" % speed)
    deck.add(OUTPUT + "*END STEP")
    deck.add("*STEP\n*STATIC\n0.5, 1.\n*BOUNDARY, TYPE=VELOCITY\nTIP, 1, 1, %g" % speed + OUTPUT + "*END STEP")
    results = runner.run("velocity", deck, 2)
    tent = lambda t: 0.5 * t * t if t < 1.0 else 1.0 - 0.5 * (2.0 - t) ** 2
    tip = deck.sets["TIP"][0]
    for step, begin, path in ((1, 0.0, lambda t: t), (2, 2.0, lambda t: 2.0 + tent(t)), (3, 4.0, lambda t: 3.0 + t)):
        for frame in results.frames(step)[1:]:
            time = frame.attrs["time"] - begin
            close(frame["node/U"][results.row[tip]][0], speed * path(time), 1e-12, "step %d, %g: motion of the tip" % (step, time))
    force = sum(results.at(n, "RF", 1)[0] for n in deck.sets["TIP"])
    close(force, 1000.0 * 1.02 * 0.5 * (1.02**2 - 1.0), 1e-9, "force of Green's strain at a stretch of 1.02")


def gravity(runner):
    """A bar hangs under its own weight: rho g L^2 / 2E, and with weight on its lower half only 3/8 rho g L^2 / E; nodal loads of
    equal elements make these exact at the nodes. Strains of 1e-7 leave nothing to NLGEOM."""
    length, young, density, acceleration, count = 4.0, 1e6, 0.1, 10.0, 8
    whole = 0.5 * density * acceleration * length**2 / young
    for kind in ("C3D8R", "C3D8"):
        deck = brick((1, 1, count), (0.5, 0.5, length), kind)
        deck.sets["TOP"] = deck.where(lambda x, y, z: z > length - 1e-9)
        deck.add("*ELSET, ELSET=LOWER, GENERATE\n1, %d" % (count // 2))
        deck.add(ELASTIC.format(young=young, poisson=0.0).replace("1e-9", "%g" % density))
        for nlgeom, target in (("", "ALL"), (", NLGEOM", "ALL"), (", NLGEOM", "LOWER")):
            deck.add("*STEP%s\n*STATIC\n1., 1.\n*BOUNDARY\nTOP, 1, 3\n*DLOAD, OP=NEW" % nlgeom)
            deck.add("%s, GRAV, %g, 0., 0., -1." % (target, acceleration) + OUTPUT + "*END STEP")
        results = runner.run("gravity_" + kind.lower(), deck, 2)
        for step, share, weight in ((1, 1.0, 1.0), (2, 1.0, 1.0), (3, 0.75, 0.5)):
            close(results.at(1, "U", step)[2], -share * whole, 1e-5, "%s step %d: motion of the lower end" % (kind, step))
            reaction = sum(results.at(n, "RF", step)[2] for n in deck.sets["TOP"])
            close(reaction, weight * density * acceleration * length * 0.25, 1e-8, "%s step %d: weight" % (kind, step))


def moment(runner):
    """A concentrated moment on the reference node bends a strip into a quarter circle: theta = M L / EI, u = L (sin t / t - 1),
    w = L (1 - cos t) / t. Bending strain t theta / 2L = 0.8 % leaves about its square, the mesh of 40 bricks 0.5 %. The moment is
    given in the node's own directions, of which the first is the global second."""
    length, depth, width, young = 10.0, 0.1, 1.0, 1.2e6
    stiffness = young * width * depth**3 / 12.0
    angle = 0.5 * math.pi
    deck = cantilever(length, depth, width, (40, 1, 2))
    deck.sets["END"] = [9001]
    deck.add("*TRANSFORM, NSET=END, TYPE=R\n0., 1., 0., -1., 0., 0.")
    deck.add(ELASTIC.format(young=young, poisson=0.0))
    deck.add("*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1., 1e-5, 0.2\n*BOUNDARY\nROOT, 1, 3")
    deck.add("*CLOAD\n9001, 4, %.17g" % (-stiffness * angle / length) + OUTPUT + ENERGY + "*END STEP")
    results = runner.run("moment", deck, 2)
    u = results.at(9001, "U")
    close(results.at(9001, "UR")[1], -angle, 5e-3, "rotation M L / EI")
    close(u[0], length * (math.sin(angle) / angle - 1.0), 1e-2, "u")
    close(u[2], length * (1.0 - math.cos(angle)) / angle, 5e-3, "w")
    # The root carries the moment: its reactions about the middle of the root.
    middle = np.array([0.0, 0.5 * width, 0.5 * depth])
    turning = sum(np.cross(deck.nodes[n] - middle, results.at(n, "RF")) for n in deck.sets["ROOT"])
    close(turning[1], stiffness * angle / length, 1e-6, "moment at the root")
    # Trapezoids of a linear moment-rotation curve are exact; the curve is straight to 1 %.
    close(energy(results, "ALLWK")[-1], 0.5 * stiffness * angle**2 / length, 1e-2, "work of the moment")


def pinned(runner):
    """A rigid lever turns by a right angle about its reference node and pulls a truss that is pinned to its end: the truss turns
    freely, so the lever feels the truss's force, along the truss, at the pin, and nothing else. Green strain, exactly."""
    young, area = 100.0, 0.2
    deck = Deck()
    for number, place in ((1, (0.0, 0.0, 0.0)), (2, (1.0, 0.0, 0.0)), (3, (1.0, -1.0, 0.5)), (4, (0.5, 0.0, 0.0))):
        deck.add_node(number, *place)
    deck.elements["T3D2"] = [(1, [2, 3])]
    deck.sets["PIN"] = [2]
    deck.sets["TIE"] = [4]
    deck.add(TRUSS.format(area=area, young=young))
    deck.add("*RIGID BODY, REF NODE=1, PIN NSET=PIN, TIE NSET=TIE")
    deck.add("*STEP, NLGEOM\n*STATIC\n0.2, 1.\n*BOUNDARY\n1, 1, 5\n1, 6, 6, %.17g\n3, 1, 3" % (0.5 * math.pi))
    deck.add(OUTPUT + "*END STEP")
    results = runner.run("pinned", deck, 2)
    pin, foot = np.array([0.0, 1.0, 0.0]), np.array(deck.nodes[3])
    close(np.abs(results.at(2, "U") - (pin - deck.nodes[2])).max(), 0.0, 1e-12, "distance of the pin from its circle")
    close(np.abs(results.at(4, "U") - [-0.5, 0.5, 0.0]).max(), 0.0, 1e-12, "distance of the tied node")
    initial, axis = np.dot(deck.nodes[2] - foot, deck.nodes[2] - foot), pin - foot
    force = young * area * 0.5 * (axis @ axis / initial - 1.0) / math.sqrt(initial) * axis  # of the truss on its foot
    for i in range(3):
        close(results.at(3, "RF")[i], -force[i], 1e-9, "force %d at the foot" % (i + 1))
        close(results.at(1, "RF")[i], force[i], 1e-9, "force %d on the lever" % (i + 1))
        close(results.at(1, "RM")[i], np.cross(pin, force)[i], 1e-9, "moment %d on the lever" % (i + 1))


def petsc(runner):
    """PETSc's options from the command line: an iterative solver finds what the direct one does. Newton drives the residual to 1e-9 of
    the forces either way; 1e-6 of the motion is what is left of that after the condition of a slender cantilever."""
    def deck(nlgeom):
        made = cantilever(10.0, 1.0, 1.0, (20, 1, 2))
        made.add(ELASTIC.format(young=1e5, poisson=0.3))
        made.add("*STEP%s\n*STATIC\n0.5, 1.\n*BOUNDARY\nROOT, 1, 3\n*CLOAD\n9001, 3, 30." % nlgeom + OUTPUT + "*END STEP")
        return made

    # Sums of forces in Newton's residual end at 1e-9 of the load; a linear step has one solution, to the solver's tolerance.
    options = ("--", "-ksp_type", "gmres", "-pc_type", "gamg", "-ksp_rtol", "1e-12", "-ksp_converged_reason")
    for name, nlgeom, ranks in (("linear", "", 1), ("nonlinear", ", NLGEOM", 2)):
        direct = runner.run("direct_" + name, deck(nlgeom)).node("U")
        done, _ = runner.launch("iterative_" + name, deck(nlgeom), ranks, options)
        assert done.returncode == 0, done.stdout + done.stderr
        assert "Linear solve converged" in done.stdout, "the options did not reach PETSc"
        found = runner.results("iterative_" + name, ranks).node("U")
        close(np.abs(found - direct).max() / np.abs(direct).max(), 0.0, 1e-6, "%s on %d ranks: difference" % (name, ranks))
    done, _ = runner.launch("unknown", deck(""), 1, ("--", "-pc_type", "nonsense"))
    assert done.returncode not in (0, 3), "an unknown preconditioner passed"


def rubbed_cube():
    """Pressed on the road, then rubbed along it: friction remembers the way, augmentation its multipliers."""
    deck = foot_on_road(0.5, 0.3)
    deck.add("*STEP, NLGEOM\n*STATIC\n0.2, 1., 1e-5, 0.5\n*BOUNDARY\n9001, 1, 6\n9002, 1, 2\n9002, 4, 6\n9002, 3, 3, -0.06")
    deck.add(OUTPUT + ENERGY + "*END STEP\n*STEP, NLGEOM\n*STATIC\n0.1, 1., 1e-5, 0.25\n*BOUNDARY\n9001, 1, 1, 0.1")
    deck.add(OUTPUT + ENERGY + "*END STEP")
    return deck


def bent_strip(nlgeom):
    """Bent by a force, which the second step takes back in part."""
    deck = cantilever(10.0, 0.5, 1.0, (20, 1, 2))
    deck.add(ELASTIC.format(young=1e5, poisson=0.3))
    for load in (20.0, 5.0):
        deck.add("*STEP%s\n*STATIC\n0.1, 1., 1e-5, 0.3\n*BOUNDARY\nROOT, 1, 3\n*CLOAD\n9001, 3, %g" % (nlgeom, load))
        deck.add(OUTPUT + ENERGY + "*END STEP")
    return deck


def same_job(whole, other, tolerance):
    """The same first increments, and displacements and reactions alike at the end of both steps."""
    times = [[frame.attrs["time"] for frame in job.frames(1)[:4]] for job in (whole, other)]
    assert times[0] == times[1], "increments differ: %s" % times
    for step in (1, 2):
        for variable in ("U", "RF"):
            reference = whole.node(variable, step)
            error = np.abs(other.node(variable, step) - reference).max() / np.abs(reference).max()
            close(error, 0.0, tolerance, "step %d: difference in %s" % (step, variable))


def interrupted(runner):
    """A job stopped inside a static step and taken up on another number of ranks goes on with the increments that it had come to,
    and ends where one ends that was left alone. What differs is where Newton starts from, and so perhaps later increments;
    elastic bodies have forgotten that when a step ends at 1e-9 of the forces, friction keeps what it makes of the path."""
    for name, deck, tolerance in (("nonlinear", bent_strip(", NLGEOM"), 1e-8), ("road", rubbed_cube(), 1e-6)):
        whole = runner.run(name, deck)
        stop_at_once(runner, name, deck, 2, ())
        if name == "road":  # in its second step, too
            runner.run(name, deck, 1, ("--restart", "--until", "STEP-1"), "stopped_" + name)
            stop_at_once(runner, name, deck, 2, ("--restart",))
        same_job(whole, runner.run(name, deck, 1, ("--restart",), "stopped_" + name), tolerance)


def linear_interrupted(runner):
    """A job stopped inside linear steps ends where one ends that was left alone: they count from the reference configuration."""
    deck = bent_strip("")
    whole = runner.run("linear", deck)
    stop_at_once(runner, "linear", deck, 2, ())
    runner.run("linear", deck, 1, ("--restart", "--until", "STEP-1"), "stopped_linear")
    stop_at_once(runner, "linear", deck, 2, ("--restart",))
    same_job(whole, runner.run("linear", deck, 1, ("--restart",), "stopped_linear"), 1e-10)


def kept_factors(runner):
    """A rubber block pressed and sheared: where the iterations converge quadratically the last correction is found with the factors of the
    one before, and yet ends at 1e-9 of the forces."""
    deck = brick((4, 4, 4), (1.0, 1.0, 1.0), "C3D8")
    deck.sets = {"BASE": deck.where(lambda x, y, z: z == 0.0), "TOP": deck.where(lambda x, y, z: z == 1.0)}
    deck.add("*MATERIAL, NAME=M\n*HYPERELASTIC, NEO HOOKE\n0.5, 0.1\n*SOLID SECTION, ELSET=ALL, MATERIAL=M")
    deck.add("*STEP, NLGEOM\n*STATIC\n1., 1.\n*BOUNDARY\nBASE, 1, 3\nTOP, 1, 1, 0.1\nTOP, 2, 2\nTOP, 3, 3, -0.15")
    deck.add(OUTPUT + "*END STEP")
    log = runner.run_alike("block", deck).log
    iterations = re.findall(r"iteration +(\d+): residual \S+ \((\S+) of the forces\)", log)
    factorizations = int(re.search(r"(\d+) factorisations", log).group(1))
    print("%s iterations, %d factorisations, residual %s" % (iterations[-1][0], factorizations, iterations[-1][1]))
    assert factorizations == int(iterations[-1][0]) - 1, "factors found anew"
    assert float(iterations[-1][1]) <= 1e-9, "residual"


CASES = {case.__name__: case for case in (stabilized, snap_through, velocity, gravity, moment, pinned, petsc, interrupted,
                                          linear_interrupted, kept_factors)}

if __name__ == "__main__":
    case, program, folder = sys.argv[1:4]
    CASES[case](Runner(program, folder))
