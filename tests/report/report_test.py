"""The report over a results file whose figures are known: a ring of bricks over a bump, with forces given by formulas."""

import os
import sys
import tempfile
import unittest

import h5py
import numpy as np

REPORT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "report")
sys.path.insert(0, REPORT)
import report  # noqa: E402
from balocco_results import Results, largest_principal, mises  # noqa: E402

HUB, ROAD, RADIUS, SPEED, STIFFNESS, LOAD = 900, 901, 290.0, 11.0, 180.0, 3000.0
SECTORS, WIDTH = 40, 160.0


def ring():
    """Bricks around the y axis: coordinates and connectivity with outward faces."""
    points, bricks = [], []
    for sector in range(SECTORS):
        angle = 2 * np.pi * sector / SECTORS
        for radius in (RADIUS - 40.0, RADIUS):
            for y in (-WIDTH / 2, WIDTH / 2):
                points.append((radius * np.cos(angle), y, radius * np.sin(angle)))
    for sector in range(SECTORS):
        a, b = 4 * sector, 4 * ((sector + 1) % SECTORS)
        bricks.append((a, a + 2, a + 3, a + 1, b, b + 2, b + 3, b + 1))
    return np.array(points), np.array(bricks, dtype=np.int32)


def history(group, **columns):
    for name, values in columns.items():
        group[name] = np.asarray(values, float)


def write_frame(step, number, time, displacement, elements):
    frame = step.create_group(f"frame_{number}")
    frame.attrs.update({"time": time, "step_time": time, "increment": number})
    frame["node/U"] = displacement.astype(np.float32)
    frame["node/CPRESS"] = np.where(np.arange(len(displacement)) < 8, 0.25, 0.0)
    strain = np.zeros((elements, 6), np.float32)
    strain[:, 0] = np.linspace(0, 0.1, elements)
    frame["element/C3D8R/LE"] = strain


def write_results(path):
    points, bricks = ring()
    coordinates = np.concatenate([points, [[0, 0, 0], [0, 0, -RADIUS]]])
    with h5py.File(path, "w") as file:
        file.attrs.update({"name": "ring", "units": "mm g ms", "format": "balocco"})
        file["mesh/node/id"] = np.concatenate([1 + np.arange(len(points)), [HUB, ROAD]])
        file["mesh/node/coordinates"] = coordinates
        file["mesh/element/C3D8R/connectivity"] = bricks
        file["mesh/element/C3D8R/part"] = np.zeros(len(bricks), np.int32)
        file["mesh/set/node/HUB"] = [len(points)]
        file["mesh/set/node/ROAD"] = [len(points) + 1]
        surface = file.create_group("mesh/analytical_surface/ROAD_SURFACE")
        surface.attrs["reference_node"] = ROAD
        surface["profile"] = [[-800, 0], [450, 0], [450, 25], [550, 25], [550, 0], [2000, 0]]
        surface["origin"] = [0, 0, -RADIUS]
        surface["axes"] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]

        load = file.create_group("step_1")
        load.attrs.update({"name": "LOAD", "procedure": "static", "completed": 1, "time_start": 0.0})
        rise = np.array([0.0, 5.0, 10.0, 15.0, 5.0 + LOAD / STIFFNESS])  # the road touches after 5 mm
        force = STIFFNESS * np.maximum(rise - 5.0, 0.0)
        history(load.create_group(f"history/node_{HUB}"), time=np.linspace(0, 1, 5), RF3=-force, RF1=0 * force)
        history(load.create_group(f"history/node_{ROAD}"), time=np.linspace(0, 1, 5), U1=0 * force, U3=rise)
        write_frame(load, 0, 1.0, np.zeros_like(coordinates), len(bricks))

        roll = file.create_group("step_2")
        roll.attrs.update({"name": "ROLL", "procedure": "explicit dynamics", "completed": 1, "time_start": 1.0})
        time = np.arange(0.0, 80.0, 0.1)
        distance = SPEED * time - 500.0
        bump = 1500 * np.exp(-((distance + 60) / 35)**2) + 1200 * np.exp(-((distance - 60) / 35)**2)
        vertical = 1.01 * LOAD + bump
        history(roll.create_group(f"history/node_{HUB}"), time=1 + time, RF3=-vertical, RF1=0.3 * bump,
                VR2=0.038 + 0 * time, AR2=0 * time)
        history(roll.create_group(f"history/node_{ROAD}"), time=1 + time, U1=-SPEED * time, U3=0 * time)
        history(roll.create_group("history/energy"), time=1 + time, ALLKE=1e6 + 0 * time, ALLIE=1e6 + 0 * time,
                ALLAE=2e4 + 0 * time, ETOTAL=2e6 + 10 * time)
        for number, t in enumerate((0.0, 500.0 / SPEED, 70.0)):
            displacement = np.zeros_like(coordinates)
            displacement[-1, 0] = -SPEED * t
            write_frame(roll, number, 1 + t, displacement, len(bricks))


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "ring.h5")
        write_results(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_figures_are_those_of_the_formulas(self):
        output = os.path.join(self.folder.name, "report")
        report.main([self.path, "--output", output])
        with open(os.path.join(output, "report.md"), encoding="utf-8") as file:
            rows = [line.split("|") for line in file if line.startswith("| ") and "figure" not in line]
        figures = {row[1].strip(): float(row[2]) for row in rows}
        self.assertAlmostEqual(figures["static vertical stiffness, load / deflection (N/mm)"], STIFFNESS, places=2)
        self.assertAlmostEqual(figures["steady Fz against static load (%)"], 1.0, places=2)
        # A low pass at 300 Hz lowers peaks that are 35 / 11 ms wide by 2 %.
        self.assertAlmostEqual(figures["dFz peak 1 (N)"] / 1500, 0.98, delta=0.02)
        self.assertAlmostEqual(figures["dFz peak 2 (N)"] / 1200, 0.98, delta=0.02)
        self.assertAlmostEqual(figures["dFz peak 1 at distance (mm)"], -60, delta=2)
        self.assertAlmostEqual(figures["dFx smallest (N)"], -450, delta=15)
        self.assertAlmostEqual(figures["greatest hourglass / internal energy (%)"], 2.0, places=3)
        self.assertAlmostEqual(figures["greatest energy error (% of kinetic + internal)"], 100 * 799 / 2e6, places=3)
        for picture in ("Fz", "Fx", "spin", "energy", "tyre", "side_views", "static_load", "footprint"):
            self.assertGreater(os.path.getsize(os.path.join(output, picture + ".png")), 5000, picture)

    def test_exterior_faces_of_a_ring_leave_out_inner_ones(self):
        faces = sum(len(rows) for _, rows, _ in Results(self.path).exterior_faces())
        self.assertEqual(faces, 4 * SECTORS)

    def test_invariants(self):
        self.assertAlmostEqual(mises(np.array([[3.0, 0, 0, 0, 0, 0]]))[0], 3.0)
        self.assertAlmostEqual(mises(np.array([[0, 0, 0, 1.0, 0, 0]]))[0], np.sqrt(3.0))
        self.assertAlmostEqual(largest_principal(np.array([[0, 0, 0, 0.2, 0, 0]]))[0], 0.1)  # engineering shear


if __name__ == "__main__":
    unittest.main()
