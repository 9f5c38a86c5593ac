#!/usr/bin/env python3
"""Linkages that spin and follow: linkage_cases.py CASE BALOCCO FOLDER."""
import math
import re

import numpy as np

from connector_cases import last, slider_at
from job import check, check_energy, run_case
from joint_cases import deck_of_rods, rods
from motion_decks import G, explicit_step, history, integrate


def heavy_top(run):
    """A gyroscope: a rotor in hinge bearings on an arm that a Cardan joint at its foot lets swing and turn about the vertical.
    It nutates and precesses as Lagrange's equations say, and its bearings stay together."""
    arm, mass, spin = 0.5, 2.0, 120.0
    axial, across = 0.02, 0.012                    # of the rotor
    carrier_mass, carrier_axial, carrier_across = 0.3, 1e-3, 7e-3  # about its own middle, at half the arm
    # The Cardan joint turns the arm about the vertical by a, then about the horizontal across it by b, downwards.
    swing = mass * arm**2 + across + carrier_mass * (arm / 2)**2 + carrier_across
    weight = G * (mass * arm + carrier_mass * arm / 2)
    spin_momentum = axial * spin
    vertical_momentum = 0.0  # released with a level arm that does not precess

    def rate_of_turn(b):
        return (vertical_momentum + spin_momentum * math.sin(b)) / (swing * math.cos(b)**2 + carrier_axial * math.sin(b)**2)

    def motion(x):
        a, b, rate = x
        turn = rate_of_turn(b)
        moment = ((carrier_axial - swing) * turn**2 * math.sin(b) + weight - spin_momentum * turn) * math.cos(b)
        return np.array([turn, rate, moment / swing])

    deck = lambda duration: f"""*NODE
1, 0., 0., 0.
2, 0., 0., 0.
3, {arm / 2}, 0., 0.
4, {arm}, 0., 0.
5, {arm}, 0., 0.
*NSET, NSET=ENDS
2, 4
*NSET, NSET=ROTOR
5
*NSET, NSET=OUT
4, 5
*ELEMENT, TYPE=MASS, ELSET=M_ROTOR
11, 5
*ELEMENT, TYPE=MASS, ELSET=M_ARM
12, 3
*MASS, ELSET=M_ROTOR
{mass}
*MASS, ELSET=M_ARM
{carrier_mass}
*ELEMENT, TYPE=ROTARYI, ELSET=I_ROTOR
13, 5
*ELEMENT, TYPE=ROTARYI, ELSET=I_ARM
14, 3
*ROTARY INERTIA, ELSET=I_ROTOR
{axial}, {across}, {across}
*ROTARY INERTIA, ELSET=I_ARM
{carrier_axial}, {carrier_across}, {carrier_across}
*RIGID BODY, REF NODE=3, TIE NSET=ENDS
*ELEMENT, TYPE=CONN3D2, ELSET=FOOT
15, 1, 2
*ELEMENT, TYPE=CONN3D2, ELSET=BEARING
16, 4, 5
*ORIENTATION, NAME=UPRIGHT
0., 0., 1., 1., 0., 0.
*ORIENTATION, NAME=ALONG
1., 0., 0., 0., 1., 0.
*CONNECTOR SECTION, ELSET=FOOT
UJOINT
UPRIGHT
*CONNECTOR SECTION, ELSET=BEARING
HINGE
ALONG
*BOUNDARY
1, 1, 6
*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
ROTOR, {spin}
0., 0., 0., 1., 0., 0.
""" + explicit_step(1e-4, duration, f"*DLOAD\n, GRAV, {G}, 0., 0., -1.\n",
                    history("OUT", "U", 0.01) + "*ELEMENT OUTPUT, ELSET=BEARING\nCU\n")
    job = run(deck(2.0), 1)
    time, u = job.history("node_5", "U")
    a, b, _ = integrate(motion, [0.0, 0.0, 0.0], time).T
    expected = arm * np.array([np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), -np.sin(b)]).T
    place = u + [arm, 0.0, 0.0]
    check("it precesses and nutates", float(np.ptp(a) > 1.0 and np.ptp(b) > 0.05), 1.0, 0.0)
    check("way of the rotor", np.abs(place - expected).max() / arm, 0.0, 1e-4)
    check("gap of the bearing", np.abs(u - job.history("node_4", "U")[1]).max(), 0.0, 1e-9 * arm)
    lead = np.trapz([rate_of_turn(x) * math.sin(x) for x in b], time)  # what the arm's own turning adds
    check("turns in the bearing", job.history("element_16", "CU")[1][-1][3] / (spin * time[-1] + lead), 1.0, 1e-5)
    check("length of the arm", np.abs(np.linalg.norm(place, axis=1) - arm).max(), 0.0, 1e-9 * arm)
    check_energy(job, 1e-3)
    early = run(deck(0.1), 2).history("node_5", "U")[1]  # whose last increment ends a bit elsewhere
    check("the same bits on two ranks", float(np.array_equal(early[:-1], u[:len(early) - 1])), 1.0, 0.0)


def orders(log):
    """Of convergence, by the last three residuals of each increment that lie between what is far away and round-off."""
    found, residuals = [], []
    for line in log.splitlines() + ["end"]:
        match = re.search(r"iteration +(\d+): residual \S+ \((\S+) of the forces\)", line)
        if match and int(match.group(1)) > 0:
            residuals.append(float(match.group(2)))
            continue
        near = [r for r in residuals if 1e-11 < r < 1e-1]
        if len(near) >= 3:
            found.append(math.log(near[-1] / near[-2]) / math.log(near[-2] / near[-3]))
        residuals = []
    return found


def blown_flaps(run):
    """Two rigid flaps in a row on hinges with springs under a pressure that follows them: closed forms for any angle, and Newton's
    iterations converge quadratically."""
    lengths, width, pressure, stiffness = (0.5, 0.3), 0.2, 2e3, (120.0, 9.0)
    nodes, shells = [], []
    for flap, (start, length) in enumerate(zip((0.0, lengths[0]), lengths)):
        first = 10 * flap + 11
        for k, (x, y) in enumerate(((start, 0.0), (start + length, 0.0), (start + length, width), (start, width))):
            nodes.append(f"{first + k}, {x!r}, {y!r}, 0.")
        for k, x in enumerate((start, start + length, start + length / 2), 4):
            nodes.append(f"{first + k}, {x!r}, {width / 2!r}, 0.")
        shells.append(f"*ELEMENT, TYPE=S4R, ELSET=FLAP{flap}\n{flap + 1}, {first}, {first + 1}, {first + 2}, {first + 3}\n"
                      f"*NSET, NSET=ENDS{flap}\n{first + 4}, {first + 5}")
    # About the first hinge turn its own pressure and that of the second flap, whose arm depends on the angle between the flaps.
    force = [pressure * width * length for length in lengths]
    second = force[1] * lengths[1] / 2 / stiffness[1]
    first = (force[0] * lengths[0] / 2 + force[1] * (lengths[0] * math.cos(second) + lengths[1] / 2)) / stiffness[0]
    deck = "\n".join(["*NODE", *nodes, f"1, 0., {width / 2!r}, 0.", *shells, "*ELSET, ELSET=FLAPS\nFLAP0, FLAP1",
                      "*MATERIAL, NAME=M\n*ELASTIC\n1e9, 0.3", "*SHELL SECTION, ELSET=FLAPS, MATERIAL=M\n0.001",
                      *[f"*RIGID BODY, REF NODE={17 + 10 * i}, ELSET=FLAP{i}, TIE NSET=ENDS{i}" for i in (0, 1)],
                      "*ELEMENT, TYPE=CONN3D2, ELSET=ROOT\n5, 1, 15", "*ELEMENT, TYPE=CONN3D2, ELSET=MIDDLE\n6, 16, 25",
                      "*ORIENTATION, NAME=ACROSS\n0., 1., 0., 1., 0., 0.",
                      *[f"*CONNECTOR BEHAVIOR, NAME={name}\n*CONNECTOR ELASTICITY, COMPONENT=4\n{k}\n"
                        f"*CONNECTOR SECTION, ELSET={name}, BEHAVIOR={name}\nHINGE\nACROSS"
                        for name, k in zip(("ROOT", "MIDDLE"), stiffness)],
                      "*BOUNDARY\n1, 1, 6", "*STEP, NLGEOM\n*STATIC\n0.2, 1., 1e-6, 0.2", f"*DLOAD\nFLAPS, P, {pressure}",
                      "*ELSET, ELSET=HINGES\nROOT, MIDDLE",
                      "*OUTPUT, HISTORY, FREQUENCY=1\n*ELEMENT OUTPUT, ELSET=HINGES\nCU\n*END STEP\n"])
    for ranks in (1, 2):
        job = run(deck, ranks)
        angles = [abs(job.history(f"element_{hinge}", "CU")[1][-1][3]) for hinge in (5, 6)]
        check("angle of the first flap", angles[0], first, 1e-8)
        check("angle of the second flap", angles[1], second, 1e-8)
        found = orders(job.log())
        check("increments with an order to tell", float(len(found) >= 3), 1.0, 0.0)
        check("order of convergence", float(np.median(found)), 2.0, 0.25)


def crank_geometry(r, l):
    """Of a crank of length r at an angle a, a connecting rod of length l and a slider on the x axis: the angle of the rod, the
    place of the slider, and how both change with a."""

    def at(a):
        b = -np.arcsin(r * np.sin(a) / l)
        rate = -r * np.cos(a) / (l * np.cos(b))
        return b, r * np.cos(a) + l * np.cos(b), rate, -r * np.sin(a) - l * np.sin(b) * rate

    return at


def crank_deck(start, r, l, spring=""):
    """Crank, rod and slider from an angle of the crank: hinges, a ball joint at the slider, and a translator between it and the ground."""
    rod, slider, _, _ = crank_geometry(r, l)(start)
    knee = (r * math.cos(start), r * math.sin(start))
    lines, centres = rods([(0.0, 0.0), knee, (float(slider), 0.0)])
    return lines, centres, slider_at(float(slider), lines, behavior=spring)


def thrown_crank(run):
    """A crank that is thrown and then left to itself, its rod and slider, with gravity and without: the equation of motion of its one
    degree of freedom; 1e5 increments leave the joints closed and keep the energy."""
    r, l, start, speed, slider_mass = 0.3, 0.8, 0.4, 6.0, 0.5
    geometry = crank_geometry(r, l)

    def inertia(a):  # of bars that weigh what they are long: twice the kinetic energy at unit speed
        b, x, rate, slide = geometry(a)
        middle = ((slide - r * np.sin(a)) / 2, r * np.cos(a) / 2)
        return r * r**2 / 3 + l * (middle[0]**2 + middle[1]**2) + l * l**2 / 12 * rate**2 + slider_mass * slide**2

    rod, slider, rod_rate, slide = (float(value) for value in geometry(start))
    knee = (r * math.cos(start), r * math.sin(start))
    lines, centres, joints = crank_deck(start, r, l)
    throw = f"""*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY
{centres[0]}, {speed}, 0., 0., 0.
0., 0., 0., 0., 0., 1.
{centres[1]}, {speed * rod_rate!r}, {-speed * knee[1]!r}, {speed * knee[0]!r}, 0.
{knee[0]!r}, {knee[1]!r}, 0., {knee[0]!r}, {knee[1]!r}, 1.
*INITIAL CONDITIONS, TYPE=VELOCITY
4, 1, {speed * slide!r}
*NSET, NSET=SHOWN
{centres[0]}, {centres[1]}, 4
"""
    for weight, ranks, duration in ((G, 1, 10.0), (G, 2, 0.5), (0.0, 1, 10.0)):
        load = f"*DLOAD\n, GRAV, {weight}, 0., -1., 0.\n" if weight > 0.0 else ""
        job = run(deck_of_rods(lines, centres, joints + throw + explicit_step(1e-4, duration, load, history("SHOWN", "U1, U2, UR3", 0.01))), ranks)
        pull = weight * (r * r / 2 + l * r / 2)  # times sin a: the potential of the bars

        def motion(state):
            a, w = state
            change = inertia(a + 1e-20j).imag / 1e-20
            return np.array([w, -(0.5 * change * w * w + pull * math.cos(a)) / inertia(a)])

        time, turn = job.history(f"node_{centres[0]}", "UR3")
        expected = integrate(motion, [start, speed], time)
        crank, bar = start + turn, rod + job.history(f"node_{centres[1]}", "UR3")[1]
        of = lambda node, start: np.array([start[c] + job.history(f"node_{node}", f"U{c + 1}")[1] for c in (0, 1)])
        end = lambda middle, angle, length: middle + 0.5 * length * np.array([np.cos(angle), np.sin(angle)])
        first, second = of(centres[0], np.array(knee) / 2), of(centres[1], ((knee[0] + slider) / 2, knee[1] / 2))
        at = of(4, (slider, 0.0))
        gaps = [end(first, crank, -r), end(first, crank, r) - end(second, bar, -l), end(second, bar, l) - at, at[1]]
        check(f"gravity {weight}: the crank turns", float(turn[-1] > 2.0 * duration), 1.0, 0.0)
        check("gaps of the joints", max(np.abs(gap).max() for gap in gaps), 0.0, 1e-9 * (r + l))
        # The increment's own error of phase, (w dt)^2 / 24 of the angle for the fastest motion there is, is a tenth of this.
        check("angle of the crank", np.abs(crank - expected[:, 0]).max(), 0.0, 1e-5 * expected[-1, 0])
        check_energy(job, 1e-3)


def loaded_crank(run):
    """Statics of the same: a moment on the crank against a spring on the slider, k (x - x0) dx/da = M, far beyond small angles."""
    r, l, start, stiffness = 0.3, 0.8, 0.4, 200.0
    geometry = crank_geometry(r, l)
    lines, centres, joints = crank_deck(start, r, l, f"*CONNECTOR ELASTICITY, COMPONENT=1\n{stiffness}\n")
    x0 = geometry(start)[1]
    moment = lambda a: stiffness * (geometry(a)[1] - x0) * geometry(a)[3]
    end = 1.6
    step = f"""*STEP, NLGEOM, INC=200
*STATIC
0.1, 1., 1e-6, 0.1
*CONNECTOR LOAD
CRANK, 4, {float(moment(end))!r}
*ELSET, ELSET=JOINTS
CRANK, GUIDE, PIN
*OUTPUT, HISTORY, FREQUENCY=1
*ELEMENT OUTPUT, ELSET=JOINTS
CU, CTF
*END STEP
"""
    for ranks in (1, 2):
        job = run(deck_of_rods(lines, centres, joints + step), ranks)
        time, motion = job.history("element_3000", "CU")
        angle = start + motion[:, 3]
        check("angle at the end", angle[-1], end, 1e-8)
        check("balance on the way", np.abs(moment(angle) - time * moment(end)).max() / moment(end), 0.0, 1e-7)
        # Along the rod goes what the slider's spring and guide make together.
        rod = geometry(end)[0]
        pin = job.history("element_7001", "CTF")[1][-1]
        check("force of the rod", np.linalg.norm(pin), abs(stiffness * (geometry(end)[1] - x0) / math.cos(rod)), 1e-7)
        found = orders(job.log())
        check("order of convergence", float(np.median(found)), 2.0, 0.25)


def joined_instances(run):
    """Two instances of a bar that a connector of the assembly joins, as Abaqus/CAE writes it: they stretch as one bar."""
    deck = """*Heading
*Part, name=Bar
*Node
      1,           0.,           0.,           0.
      2,          10.,           0.,           0.
      3,          20.,           0.,           0.
*Element, type=B31
1, 1, 2
2, 2, 3
*Elset, elset=Set-1
 1, 2
*Beam Section, elset=Set-1, material=Steel, temperature=GRADIENTS, section=CIRC
1.
0.,0.,-1.
*End Part
*Assembly, name=Assembly
*Instance, name=Bar-1, part=Bar
*End Instance
*Instance, name=Bar-2, part=Bar
         20.,           0.,           0.
*End Instance
*Element, type=CONN3D2
1, Bar-1.3, Bar-2.1
*Connector Section, elset=Wire-1-Set-1
Hinge,
Datum-csys-1,
*Elset, elset=Wire-1-Set-1
 1,
*Orientation, name=Datum-csys-1
 0., 0., 1., 1., 0., 0.
1, 0.
*Nset, nset=fix, instance=Bar-1
 1,
*Nset, nset=tip, instance=Bar-2
 3,
*End Assembly
*Material, name=Steel
*Elastic
210000., 0.3
*Boundary
fix, ENCASTRE
tip, 2, 5
*Step, name=Step-1, nlgeom=NO
*Static
1., 1., 1e-05, 1.
*Cload
tip, 1, 100.
*Output, history, frequency=1
*Node Output, nset=tip
U1
*Element Output, elset=Wire-1-Set-1
CTF
*End Step
"""
    for ranks in (1, 2):
        job = run(deck, ranks)
        groups = job.groups()
        (tip,), (joint,) = ([name for name in groups if name.startswith(kind)] for kind in ("node_", "element_"))
        check("stretch of both bars", job.history(tip, "U1")[1][-1], 100.0 * 40.0 / (210000.0 * math.pi), 1e-9)
        check("force of the hinge", last(job, "CTF", group=joint)[1], 100.0, 1e-9)


if __name__ == "__main__":
    run_case({case.__name__: case for case in (heavy_top, blown_flaps, thrown_crank, loaded_crank, joined_instances)})
