#!/usr/bin/env python3
"""Springs, dashpots and point masses against closed forms: spring_cases.py CASE BALOCCO FOLDER."""
import math

import numpy as np

from job import check, check_energy, run_case
from motion_decks import explicit_step, integrate

HISTORY = """*OUTPUT, HISTORY, FREQUENCY=1
*NODE OUTPUT, NSET=MASSES
U1, U2
*ENERGY OUTPUT
ALLKE, ALLIE, ALLSE, ALLVD, ALLWK, ETOTAL
"""


def oscillator(spring, increment, periods, dashpot="", speed=1e-2):
    """A unit mass at the end of a spring of stiffness 1000 along x that starts with a velocity, in increments of that length. At
    the limit of stability KE + SE at the same instant is not the energy that central differences keep."""
    period = 2.0 * math.pi / math.sqrt(1000.0)
    return f"""*NODE
1, 0., 0., 0.
2, 1., 0., 0.
*NSET, NSET=MASSES
2
*ELEMENT, TYPE=MASS, ELSET=MASS
1, 2
*MASS, ELSET=MASS
1.
{spring}{dashpot}*BOUNDARY
1, 1, 3
2, 2, 3
*INITIAL CONDITIONS, TYPE=VELOCITY
2, 1, {speed}
*STEP
*DYNAMIC, EXPLICIT, ENERGY ERROR=1e9{", DIRECT USER CONTROL" if increment else ""}
{f"{increment:.15g}" if increment else ""}, {periods * period:.15g}
*BULK VISCOSITY
0., 0.
{HISTORY}*END STEP
"""


SPRINGA = "*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n2, 1, 2\n*SPRING, ELSET=SPRING\n\n1000.\n"
SPRING1 = "*ELEMENT, TYPE=SPRING1, ELSET=SPRING\n2, 2\n*SPRING, ELSET=SPRING\n1\n1000.\n"
SPRING2 = "*ELEMENT, TYPE=SPRING2, ELSET=SPRING\n2, 1, 2\n*SPRING, ELSET=SPRING\n1, 1\n1000.\n"
DASHPOT = "*ELEMENT, TYPE=DASHPOTA, ELSET=DASHPOT\n3, 1, 2\n*DASHPOT, ELSET=DASHPOT\n\n{}\n"


BELOW_LIMIT = 0.9  # of the stable increment an automatic one takes


def stable_increment(run):
    """DT-MK: spring 1000, mass 1, damping ratio 0 or 0.05: .063246 and .060162. Automatic increments are 0.9 of the closed form to 1e-6, and a
    fixed one is stable at 0.999 of it and not at 1.001."""
    omega = math.sqrt(1000.0)
    for ratio in (0.0, 0.05):
        critical = 2.0 / omega * (math.sqrt(1.0 + ratio * ratio) - ratio)
        dashpot = DASHPOT.format(2.0 * ratio * omega) if ratio else ""
        for spring in (SPRINGA, SPRING1, SPRING2):
            job = run(oscillator(spring, 0.0, 50.0, dashpot), 1)
            time = job.history("node_2", "U1")[0]
            check(f"automatic increment, damping ratio {ratio}", time[3] - time[2], BELOW_LIMIT * critical, 1e-6)
        amplitude = {}
        for factor in (0.999, 1.001):
            job = run(oscillator(SPRINGA, factor * critical, 40.0, dashpot), 1)
            amplitude[factor] = np.abs(job.history("node_2", "U1")[1])
        half = len(amplitude[0.999]) // 2
        check("below the limit it does not grow", float(amplitude[0.999][half:].max() <= 1.01 * amplitude[0.999][:half].max()), 1.0, 0.0)
        check("beyond the limit it grows", float(amplitude[1.001][half:].max() > 2.0 * amplitude[1.001][:half].max()), 1.0, 0.0)


def mass_on_spring(run):
    """Free vibration, damped and not: period, decay, energies."""
    omega, speed = math.sqrt(1000.0), 1e-2
    for ratio in (0.0, 0.05):
        dashpot = DASHPOT.format(2.0 * ratio * omega) if ratio else ""
        for ranks in (1, 2):
            job = run(oscillator(SPRINGA, 1e-3, 3.25, dashpot), ranks)
            time, u = job.history("node_2", "U1")
            damped = omega * math.sqrt(1.0 - ratio**2)
            exact = speed / damped * np.exp(-ratio * omega * time) * np.sin(damped * time)
            # Damping forces lag by half an increment: first order, omega dt xi per radian.
            check(f"largest error of the motion, damping ratio {ratio}", np.abs(u - exact).max() / np.abs(exact).max(), 0.0,
                  1e-2 if ratio else 2e-3)
            check_energy(job, 1e-3)
        if ratio:
            check("dissipated", job.history("energy", "ALLVD")[1][-1] / (0.5 * speed**2),
                  1.0 - (job.history("energy", "ALLKE")[1][-1] + job.history("energy", "ALLSE")[1][-1]) / (0.5 * speed**2), 1e-3)


def dissipated(coefficient, speed, duration, steps=2000):
    """Energy that a damper takes of a unit mass on a spring of 1000 in that time; Runge-Kutta."""
    rate = lambda y: np.array([y[1], -1000.0 * y[0] - coefficient * y[1], coefficient * y[1] ** 2])
    y, h = np.array([0.0, speed, 0.0]), duration / steps
    for _ in range(steps):
        a = rate(y)
        b = rate(y + 0.5 * h * a)
        c = rate(y + 0.5 * h * b)
        y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + rate(y + h * c))
    return y[2]


def bump_and_rebound(run):
    """A damper with a table that is six times as stiff in rebound (extension) as in bump, over a quarter of a period each way."""
    table = "*ELEMENT, TYPE=DASHPOTA, ELSET=DASHPOT\n3, 1, 2\n*DASHPOT, ELSET=DASHPOT, NONLINEAR\n\n-2., -1.\n0., 0.\n12., 1.\n"
    quarter = 0.25 * 2.0 * math.pi / math.sqrt(1000.0)
    for name, coefficient, speed in (("rebound", 12.0, 0.5), ("bump", 2.0, -0.5)):
        job = run(oscillator(SPRINGA, 1e-4, 0.25, table, speed=speed), 1)
        check(f"energy taken in {name}", job.history("energy", "ALLVD")[1][-1], dissipated(coefficient, speed, quarter), 2e-3)
        check_energy(job, 1e-3)
    one, two = (run(oscillator(SPRINGA, 0.0, 2.0, table, speed=0.5), ranks).history("node_2", "U1")[1].copy() for ranks in (1, 2))
    check("one rank and two find the same bits", float(np.array_equal(one, two)), 1.0, 0.0)


STATIC = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
*NSET, NSET=MASSES
1, 2
{}*STEP, NLGEOM
*STATIC
1., 1.
{}*OUTPUT, FIELD, FREQUENCY=1, PRECISION=DOUBLE
*NODE OUTPUT
U, RF
*ELEMENT OUTPUT
S, E
*OUTPUT, HISTORY, FREQUENCY=1
*ENERGY OUTPUT
ALLSE, ALLVD, ALLWK, ETOTAL
*END STEP
"""


def static_springs(run):
    """CalculiX's own spring2 and spring7, read as they are (with their blank lines), and a table's energy."""
    nonlinear = """*ELEMENT, TYPE=SPRINGA, ELSET=EALL
1, 1, 2
*BOUNDARY
1, 1, 3
2, 2, 3
*SPRING, ELSET=EALL, NONLINEAR

0., 0.
10., 1.
100., 20.
"""
    job = run(STATIC.format(nonlinear, "*CLOAD\n2, 1, 11.\n"), 1)
    check("displacement (ccx spring2)", job.frame("U", -1)[1, 0], 1.0 + 19.0 / 90.0, 1e-9)
    check("strain energy", job.history("energy", "ALLSE")[1][-1], 5.0 + 0.5 * (10.0 + 11.0) * 19.0 / 90.0, 1e-9)
    fixed = """*ELEMENT, TYPE=SPRING2, ELSET=EALL
1, 1, 2
*BOUNDARY
1, 1, 3
2, 3, 3
*SPRING, ELSET=EALL
1, 1
10.
"""
    job = run(STATIC.format(fixed, "*BOUNDARY\n2, 1, 1, 2.\n2, 2, 2, 3.\n"), 2)
    check("reaction (ccx spring7)", job.frame("RF", -1)[1, 0], 20.0, 1e-12)
    check("reaction at the other end", job.frame("RF", -1)[0, 0], -20.0, 1e-12)


def dashpot_in_statics(run):
    """A driven dashpot in a static step: velocity = displacement increment / time increment."""
    dashpot = """*ELEMENT, TYPE=DASHPOTA, ELSET=EALL
1, 1, 2
*BOUNDARY
1, 1, 3
2, 2, 3
*DASHPOT, ELSET=EALL

5.
"""
    deck = STATIC.format(dashpot, "*BOUNDARY\n2, 1, 1, 0.3\n").replace("1., 1.\n", "0.5, 2.\n")
    job = run(deck, 1)
    check("reaction", job.frame("RF", -1)[1, 0], 5.0 * 0.3 / 2.0, 1e-12)
    energy = job.history("energy", "ALLVD")[1]
    check("dissipated", energy[-1] - energy[1], 5.0 * (0.3 / 2.0) ** 2 * 1.5, 1e-9)


def swinging_spring(run):
    """A mass on a stiff axial spring swings through a full turn in free fall of no gravity: circular motion, the pull is m v^2 / l."""
    stiffness, speed = 1e4, 2.0
    deck = oscillator(SPRINGA.replace("1000.", f"{stiffness}"), 1e-3, 10.0).replace("2, 2, 3\n", "").replace("2, 1, 0.01", f"2, 2, {speed}")
    job = run(deck, 2)
    check_energy(job, 1e-3)
    time, x = job.history("node_2", "U1")
    y = job.history("node_2", "U2")[1]
    angle = np.unwrap(np.arctan2(y, 1.0 + x))
    radius = np.hypot(1.0 + x, y)
    check("angular momentum", radius[-1] ** 2 * (angle[-1] - angle[-2]) / (time[-1] - time[-2]), speed, 2e-3)
    # It breathes about the length at which m v^2 / l = k (l - 1), conserving v l.
    check("mean length", radius.mean(), 1.0 + speed**2 / stiffness, 1e-4)


def rods(restraints="", bodies=""):
    """Two rods of two elements, of stiffness 1000 and mass 1 at their middle nodes, clamped at their ends, that swing along x."""
    return f"""*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
4, 0., 1., 0.
5, 1., 1., 0.
6, 2., 1., 0.
7, 3., 0., 0.
8, 4., 0., 0.
*NSET, NSET=MASSES
2, 5
*ELEMENT, TYPE=T3D2, ELSET=RODS
1, 1, 2
2, 2, 3
3, 4, 5
4, 5, 6
*SOLID SECTION, ELSET=RODS, MATERIAL=ROD
1.
*MATERIAL, NAME=ROD
*ELASTIC
1000., 0.
*DENSITY
1.
{bodies}{restraints}*BOUNDARY
1, 1, 3
3, 1, 3
4, 1, 3
6, 1, 3
2, 2, 3
5, 2, 3
7, 2, 3
8, 1, 3
*INITIAL CONDITIONS, TYPE=VELOCITY
2, 1, 1e-2
5, 1, 1e-2
*STEP
*DYNAMIC, EXPLICIT
, 3.
*BULK VISCOSITY
0., 0.
{HISTORY}*RESTART, WRITE, NUMBER INTERVAL=1
*END STEP
"""


def beside_elements(run):
    """A spring or a dashpot takes from the increment of the elements that move with its ends, and of no others: not where it holds masses
    of its own; at a node of a rod what that node's mass allows; and little where its other end is heavy."""
    rod = 1.0 / math.sqrt(1000.0)  # L / c of a free element

    def limit(stiffness, rate):
        half = 0.5 * rate
        return 2.0 / (half + math.sqrt(half * half + 4.0 / rod**2 + stiffness))

    def spring(*nodes, stiffness=300.0, viscosity=4.0):
        where = ", ".join(map(str, nodes))
        return (f"*ELEMENT, TYPE=SPRINGA, ELSET=SPRING\n11, {where}\n*SPRING, ELSET=SPRING\n\n{stiffness}\n"
                f"*ELEMENT, TYPE=DASHPOTA, ELSET=DASHPOT\n12, {where}\n*DASHPOT, ELSET=DASHPOT\n\n{viscosity}\n")

    def body(mass):
        return f"*ELEMENT, TYPE=MASS, ELSET=MASS\n21, 7\n*MASS, ELSET=MASS\n{mass}\n"

    def share(value, mass):  # of the end at a rod, whose other end has that mass
        return value + math.sqrt(value * value / mass)

    cases = {"beside the rods": (spring(7, 8), body(1.0), rod),
             "between a rod and the ground": (spring(2, 8), body(1.0), limit(300.0, 4.0)),
             "between a rod and a heavy mass": (spring(2, 7), body(1e4), limit(share(300.0, 1e4), share(4.0, 1e4)))}
    for what, (restraint, mass, expected) in cases.items():
        job = run(rods(restraint, mass), 1)
        time, u = job.history("node_2", "U1")
        check(f"increment with a spring {what}", time[3] - time[2], BELOW_LIMIT * expected, 1e-6)
        half = len(u) // 2
        check("it does not grow", float(np.abs(u[half:]).max() <= 1.01 * np.abs(u[:half]).max()), 1.0, 0.0)
        check_energy(job, 1e-2)
        one, two = (job.history("node_5", "U1")[1], run(rods(restraint, mass), 2).history("node_5", "U1")[1])
        check("one rank and two find the same bits", float(np.array_equal(one, two)), 1.0, 0.0)


def springs_in_a_body(run):
    """Springs in fixed directions at nodes of a rigid body that turns about its reference node, to the ground and within the body:
    2 k sin a cos a balances a moment, and makes the body swing."""
    stiffness, inertia = 100.0, 0.5
    speed = 0.8 * math.sqrt(2.0 * stiffness / inertia)  # does not turn it over
    body = f"""*NODE
1, 0., 0., 0.
2, 1., 0., 0.
*NSET, NSET=TIP
2
*RIGID BODY, REF NODE=1, TIE NSET=TIP
*ELEMENT, TYPE=ROTARYI, ELSET=I
3, 1
*ROTARY INERTIA, ELSET=I
{inertia}, {inertia}, {inertia}
*ELEMENT, TYPE=MASS, ELSET=M
4, 1
*MASS, ELSET=M
1.
*ELEMENT, TYPE=SPRING1, ELSET=GROUND
5, 2
*SPRING, ELSET=GROUND
2
{stiffness}
*ELEMENT, TYPE=SPRING2, ELSET=WITHIN
6, 1, 2
*SPRING, ELSET=WITHIN
2, 2
{stiffness}
*BOUNDARY
1, 1, 5
"""
    output = "*OUTPUT, HISTORY, {}\n*NODE OUTPUT, NSET=TIP\nU1, U2\n*ENERGY OUTPUT\nALLKE, ALLIE, ALLWK, ETOTAL\n"
    moment = lambda a: 2.0 * stiffness * math.sin(a) * math.cos(a)
    swing = lambda x: np.array([x[1], -moment(x[0]) / inertia])
    for ranks in (1, 2):
        job = run(body + f"*STEP, NLGEOM\n*STATIC\n0.1, 1.\n*CLOAD\n1, 6, {moment(0.3)!r}\n" + output.format("FREQUENCY=1") + "*END STEP\n", ranks)
        check("way of the tip in statics", job.history("node_2", "U2")[1][-1], math.sin(0.3), 1e-8)
        job = run(body + f"*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\n1, {speed!r}\n0., 0., 0., 0., 0., 1.\n"
                  + explicit_step(1e-4, 1.0, "", output.format("TIME INTERVAL=0.01")), ranks)
        time, u = job.history("node_2", "U2")
        angle = integrate(swing, [0.0, speed], time)[:, 0]
        check("way of the tip in time", np.abs(u - np.sin(angle)).max(), 0.0, 1e-5)
        check_energy(job, 1e-4)


if __name__ == "__main__":
    run_case(globals())
