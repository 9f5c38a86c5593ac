#!/usr/bin/env python3
"""Dynamics of superposed modes against closed forms and implicit dynamics: modal_cases.py CASE BALOCCO FOLDER."""
import math
import sys

import numpy as np

from dynamic_cases import HISTORY, OMEGA, SELDOM, implicit, oscillator
from job import Job, check, failures


def response(balocco, folder):
    """A force that acts at once on a mass and spring, by their mode: F / k (1 - cos), damped and not; any increment is exact."""
    force, period = 2.0, 2.0 * math.pi / OMEGA
    for ratio in (0.0, 0.1):
        damping = "*MODAL DAMPING\n1, 1, %g\n" % ratio if ratio else ""
        job = Job("modal", balocco, "1" if ratio else "2", folder)
        job.run(oscillator(["*FREQUENCY\n1", "*MODAL DYNAMIC\n%.15g, %.15g\n%s*CLOAD\n2, 1, %g" % (period / 7, 3.0 * period, damping, force)], speed=0.0))
        time, u = job.history("node_2", "U", 2)
        damped = OMEGA * math.sqrt(1.0 - ratio**2)
        fading = np.exp(-ratio * OMEGA * time) * (np.cos(damped * time) + ratio * OMEGA / damped * np.sin(damped * time))
        check("response, damped by %g" % ratio, np.abs(u[:, 0] - force / 1000.0 * (1.0 - fading)).max(), 0.0, 1e-10)


def cantilever(material, procedures):
    """A bar of six bricks that a force at its end bends, clamped at the other."""
    nodes = [(5.0 * i, 5.0 * j, 5.0 * k) for k in (0, 1) for j in (0, 1) for i in range(7)]
    deck = "*NODE, NSET=ALL\n" + "".join("%d, %g, %g, %g\n" % (i + 1, *x) for i, x in enumerate(nodes))
    deck += "*ELEMENT, TYPE=C3D8I, ELSET=BODY\n"
    deck += "".join("%d, %d, %d, %d, %d, %d, %d, %d, %d\n" % (i, i, i + 1, i + 8, i + 7, i + 14, i + 15, i + 22, i + 21) for i in range(1, 7))
    deck += "*NSET, NSET=CLAMP\n1, 8, 15, 22\n*NSET, NSET=WATCHED\n7\n*NSET, NSET=TIP\n7, 14, 21, 28\n*MATERIAL, NAME=M\n*ELASTIC\n1e4, 0.3\n"
    deck += "*DENSITY\n1e-3\n%s*SOLID SECTION, ELSET=BODY, MATERIAL=M\n*BOUNDARY\nCLAMP, 1, 3\n" % material
    for procedure in procedures:
        output = HISTORY.replace("*ENERGY", "*NODE OUTPUT, NSET=CLAMP\nRF\n*ENERGY") if "DYNAMIC" in procedure else ""
        deck += "*STEP, INC=1000\n%s\n%s*END STEP\n" % (procedure, output)
    return deck


def forces(balocco, folder):
    """Reactions, work and dissipation of the sum of all modes are those of implicit dynamics (short increments), and so are the first
    accelerations, with mass-proportional damping and without, on any number of ranks; energy is conserved to the last digits."""
    load, increment, period = "\n*CLOAD\nTIP, 3, 0.5", 5e-4, 0.02
    modal = ["*FREQUENCY\n72", "*MODAL DYNAMIC\n%g, %g" % (increment, period) + load]
    for alpha in (0.0, 20.0):
        damping = "*DAMPING, ALPHA=%g\n" % alpha if alpha else ""
        jobs = []
        for name, ranks, procedures in (("implicit", "1", [implicit(0.0, increment, period) + load]),
                                        ("modes", "1", modal), ("modes_on_2", "2", modal)):
            job = Job(name, balocco, ranks, folder)
            job.run(cantilever(damping, procedures))
            step = len(procedures)
            curves = {"U": job.history("node_7", "U", step)[1][:, 2], "A": job.history("node_7", "A", step)[1][:, 2],
                      "RF": sum(job.history("node_%d" % n, "RF", step)[1][:, 2] for n in (1, 8, 15, 22))}
            curves.update({name: job.history("energy", name, step)[1] for name in ("ALLKE", "ALLVD", "ALLWK", "ETOTAL")})
            jobs.append(curves)
        direct, modes, others = jobs
        for name, tolerance in (("U", 2e-3), ("RF", 2e-2), ("ALLWK", 2e-3), ("ALLKE", 1e-2)) + ((("ALLVD", 1e-2),) if alpha else ()):
            check(name + ", alpha %g" % alpha, np.abs(modes[name] - direct[name]).max() / np.abs(direct[name]).max(), 0.0, tolerance)
        check("acceleration at the start", modes["A"][0], direct["A"][0], 1e-6)
        check("dissipation", modes["ALLVD"].max(), direct["ALLVD"].max(), 1e-2)
        for curves, what in ((modes, "modes"), (direct, "implicit")):
            check("energy, " + what, np.abs(curves["ETOTAL"]).max() / curves["ALLWK"].max(), 0.0, 1e-6)
        for name in modes:
            scale = modes["ALLWK"].max() if name in ("ALLVD", "ETOTAL") else np.abs(modes[name]).max()
            check(name + " on two ranks", np.abs(modes[name] - others[name]).max() / scale, 0.0, 1e-6)


def material_damping(balocco, folder):
    """*DAMPING of a material acts on its modes: a mass on a bar, by ALPHA of the mass and by BETA of the stiffness, damped by ratio."""
    ratio, force, stiffness, mass = 0.1, 1.0, 100.0, 1.0
    omega = math.sqrt(stiffness / mass)
    for damping in ("ALPHA=%.15g" % (2.0 * ratio * omega), "BETA=%.15g" % (2.0 * ratio / omega)):
        # The bar's lumped mass at the free end is the mass: half of density * length.
        deck = """*NODE, NSET=WATCHED
1, 0., 0., 0.
2, 1., 0., 0.
*ELEMENT, TYPE=T3D2, ELSET=BAR
1, 1, 2
*MATERIAL, NAME=M
*ELASTIC
%g, 0.
*DENSITY
%g
*DAMPING, %s
*SOLID SECTION, ELSET=BAR, MATERIAL=M
1.
*BOUNDARY
1, 1, 3
2, 2, 3
*STEP
*FREQUENCY
1
*END STEP
*STEP
*MODAL DYNAMIC
0.02, 1.
*CLOAD
2, 1, %g
%s*END STEP
""" % (stiffness, 2.0 * mass, damping, force, HISTORY.replace("U, V, A", "U, V, A, RF"))
        job = Job("damped", balocco, "1", folder)
        job.run(deck)
        time, u = job.history("node_2", "U", 2)
        damped = omega * math.sqrt(1.0 - ratio**2)
        fading = np.exp(-ratio * omega * time) * (np.cos(damped * time) + ratio * omega / damped * np.sin(damped * time))
        check("response by " + damping, np.abs(u[:, 0] - force / stiffness * (1.0 - fading)).max() * stiffness / force, 0.0, 1e-9)
        work, lost, total = (job.history("energy", name, 2)[1] for name in ("ALLWK", "ALLVD", "ETOTAL"))
        check("work", np.abs(work - force * u[:, 0]).max() / work.max(), 0.0, 1e-9)
        check("energy", np.abs(total).max() / work.max(), 0.0, 1e-9)
        v, a = (job.history("node_2", name, 2)[1][:, 0] for name in ("V", "A"))
        pull = 2.0 * ratio * omega * mass * v + stiffness * u[:, 0]
        check("equilibrium of the mass", np.abs(mass * a + pull - force).max(), 0.0, 1e-9)
        held = -stiffness * u[:, 0] - (2.0 * ratio / omega * stiffness * v if "BETA" in damping else 0.0)
        check("reaction", np.abs(job.history("node_1", "RF", 2)[1][:, 0] - held).max() / force, 0.0, 1e-9)


def fast(balocco, folder):
    """A mass of 6.24e-9, F / k (1 - cos w t), counted in units in which its period is 1.6e-5: exact at every instant."""
    omega = math.sqrt(1000.0 / 6.24e-9)
    deck = oscillator([], speed=0.0).replace("*MASS, ELSET=MASS\n1.", "*MASS, ELSET=MASS\n6.24e-9")
    deck += "*STEP\n*FREQUENCY\n1\n*END STEP\n*STEP, INC=1000\n*MODAL DYNAMIC\n1e-7, 1e-5\n*CLOAD\n2, 1, 3.\n" + SELDOM + HISTORY + "*END STEP\n"
    for ranks in "12":
        job = Job("fast_on_" + ranks, balocco, ranks, folder)
        job.run(deck)
        time, u = job.history("node_2", "U", 2)
        check("displacement", np.abs(u[:, 0] / 3e-3 - (1.0 - np.cos(omega * time))).max(), 0.0, 1e-10)


if __name__ == "__main__":
    {case.__name__: case for case in (response, forces, material_damping, fast)}[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if failures else 0)
