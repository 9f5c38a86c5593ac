"""NAFEMS problems of forced vibration: harmonic loads on a beam and on plates, by 16 modes with 2 % of critical damping."""
import numpy as np

from meshes import SHELLS, elastic, line, recovered, sheet
from verification import problem

STEEL = elastic(200e9, 0.3, 8000.0)
SOURCE = "NAFEMS R0016 (1993), test %s, as Abaqus Benchmarks and Altair OS-V %s quote it"


def sweep(mesh, lowest, highest, held, load, output):
    """Modes, then the response about them; fields in double precision."""
    mesh.add("*STEP\n*FREQUENCY\n16\n*BOUNDARY\n%s*END STEP\n*STEP\n*STEADY STATE DYNAMICS, FREQUENCY SCALE=LINEAR\n%g, %g, 20\n"
             "*MODAL DAMPING\n1, 16, 0.02\n*DLOAD\n%s\n*OUTPUT, FIELD, PRECISION=DOUBLE\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\n%s\n*END STEP"
             % (held, lowest, highest, load, output))


def peak(results, wanted):
    """Frequency and size of the greatest of what `wanted(part of a field's values by name)` finds, a complex number a frame."""
    step = results.file["step_2"]
    frames = [step[name] for name in step if name.startswith("frame_")]
    sizes = [abs(wanted(frame, "_REAL") + 1j * wanted(frame, "_IMAG")) for frame in frames]
    top = int(np.argmax(sizes))
    return frames[top].attrs["frequency"], sizes[top]


@problem("H5", "deep beam of length 10, 2 x 2, simply supported, 1e6 N/m sin wt all along", SOURCE % ("5H", "0300"),
         {"frequency, Hz": (42.65, 0.01), "displacement, mm": (13.45, 0.01), "stress, MPa": (241.9, 0.03)}, {"B31": (10, 20, 40)},
         lambda n: "%d" % n, {"B31": 0.03})
def deep_beam(session, kind, n):
    mesh = line(kind, n, lambda r: (10.0 * r, 0.0, 0.0))
    mesh.add("*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=RECT\n2., 2.\n0., 1., 0.\n*MATERIAL, NAME=M\n" + STEEL)
    held = mesh.hold(mesh.at(r=0.0), (1, 2, 3, 4)) + mesh.hold(mesh.at(r=1.0), (2, 3))
    sweep(mesh, 30.0, 55.0, held, "ALL, PY, 1e6", "SM")
    results = session.run("h5_%d" % n, mesh)
    inside = [n // 2 - 1, n // 2]  # elements beside the middle; bending stress M c / I
    frequency, deflection = peak(results, lambda frame, part: frame["node/U" + part][n // 2, 1])
    moment = max(peak(results, lambda frame, part: np.mean(frame["element/B31/SM" + part][inside], axis=0)[axis])[1] for axis in (0, 1))
    return {"frequency, Hz": frequency, "displacement, mm": 1e3 * deflection, "stress, MPa": moment * 1.0 / (16.0 / 12.0) / 1e6}


def plate(session, name, kind, n, thickness, pressure, lowest, highest):
    """Displacement and stress of the lower or upper fibre at the middle of a square plate of width 10, simply supported."""
    mesh = sheet(kind, (n, n), lambda r, s: (10.0 * r, 10.0 * s, 0.0), thickness)
    mesh.section(thickness, STEEL)
    held = mesh.hold(mesh.at(), (1, 2, 6))
    for edge in (0.0, 1.0):
        held += mesh.hold(mesh.at(r=edge), (3, 4)) + mesh.hold(mesh.at(s=edge), (3, 5))
    sweep(mesh, lowest, highest, held, "ALL, P, %g" % pressure, "S")
    results = session.run("%s_%s_%d" % (name, kind, n), mesh)
    middle = mesh.at(0.5, 0.5)[0] - 1
    frequency, deflection = peak(results, lambda frame, part: frame["node/U" + part][middle, 2])
    stress = peak(results, lambda frame, part: recovered(mesh, frame["element/%s/S_TOP%s" % (kind, part)][:, 0], 0.5, 0.5))[1]
    return {"frequency, Hz": frequency, "displacement, mm": 1e3 * deflection, "stress, MPa": stress / 1e6}


@problem("H13", "thin square plate 10 x 10 x 0.05, simply supported, pressure 100 sin wt", SOURCE % ("13H", "0340") +
         "; the stress printed there is 30.03, but test 13R of the same report (OS-V 0396) has the squares of both, 2063.20 = 45.42^2 and 1025.44 = 32.02^2",
         {"frequency, Hz": (2.377, 0.01), "displacement, mm": (45.42, 0.02), "stress, MPa": (32.02, 0.03)}, {kind: (8, 16) for kind in SHELLS},
         lambda n: "%d x %d" % (n, n))
def thin_plate(session, kind, n):
    return plate(session, "h13", kind, n, 0.05, 100.0, 1.8, 3.0)


@problem("H21", "thick square plate 10 x 10 x 1, simply supported, pressure 1e6 sin wt", SOURCE % ("21H", "0370"),
         {"frequency, Hz": (45.90, 0.02), "displacement, mm": (58.33, 0.05), "stress, MPa": (800.8, 0.05)}, {kind: (8, 16) for kind in SHELLS},
         lambda n: "%d x %d" % (n, n))
def thick_plate(session, kind, n):
    return plate(session, "h21", kind, n, 1.0, 1e6, 35.0, 55.0)
