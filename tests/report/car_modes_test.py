"""How the modes of a car's body are named, on shapes given by formulas."""

import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "report"))
import car_modes  # noqa: E402

ALONG, ACROSS = 24, 9  # nodes of a sheet


def box():
    """A floor and a roof, 3700 x 1500 mm, 1200 mm apart, as a results file in memory."""
    file = h5py.File("box.h5", "w", driver="core", backing_store=False)
    x, y = np.meshgrid(np.linspace(-3000.0, 700.0, ALONG), np.linspace(-750.0, 750.0, ACROSS), indexing="ij")
    sheets = [np.stack([x.ravel(), y.ravel(), np.full(x.size, z)], axis=1) for z in (250.0, 1450.0)]
    first = (ACROSS * np.arange(ALONG - 1)[:, None] + np.arange(ACROSS - 1)).ravel()
    sheet = np.stack([first, first + ACROSS, first + ACROSS + 1, first + 1], axis=1)
    file["mesh/node/coordinates"] = np.concatenate(sheets)
    file["mesh/element/S4R/connectivity"] = np.concatenate([sheet, sheet + x.size])
    file["mesh/element/S4R/part"] = np.repeat([0, 1], len(sheet))
    file["mesh/set/element/BODY/S4R"] = np.arange(2 * len(sheet))
    for number, name in enumerate(("FLOOR", "ROOF")):
        file.create_group(f"mesh/part/{number}").attrs["name"] = name
    return file


class Modes(unittest.TestCase):
    def setUp(self):
        self.body = car_modes.Body(box())
        self.x, self.y, self.z = (self.body.places - (-1150.0, 0.0, 300.0)).T / 1000.0

    def named(self, along=0.0, across=0.0, up=0.0):
        moved = np.stack([component + np.zeros_like(self.x) for component in (along, across, up)], axis=1)
        return self.body.shape(moved)

    def test_rigid_motion_is_no_mode_of_the_body(self):
        motion = {"along": 0.3 * self.z - 0.1 * self.y, "across": 0.1 * self.x + 0.5, "up": -0.3 * self.x + 0.7}
        self.assertEqual(self.named(**motion), ("", {}))
        motion["across"], motion["up"] = motion["across"] - 3.0 * self.x * self.z, motion["up"] + 3.0 * self.x * self.y
        self.assertEqual(self.named(**motion)[0], "body: torsion")

    def test_torsion_whatever_the_height_of_its_axis(self):
        for height in (-0.4, 0.0, 0.8):
            roll = 0.2 * (self.x - 0.3)
            name, shares = self.named(across=-roll * (self.z - height), up=roll * self.y)
            self.assertEqual(name, "body: torsion")
            self.assertGreater(shares["torsion"] + shares["rigid"], 0.999)

    def test_a_roof_that_leans_is_no_torsion(self):
        name, shares = self.named(across=self.z - 0.55, up=self.y)
        self.assertEqual(name, "body: leaning")
        self.assertLess(shares["torsion"], 1e-12)

    def test_bending_of_a_slender_and_of_a_shear_soft_body(self):
        for tilt in (0.0, 2.0):  # sections that stay upright; that stay normal to the bent line
            name, shares = self.named(along=-tilt * self.x * self.z, up=self.x**2)
            self.assertEqual(name, "body: vertical bending")
            self.assertGreater(shares["vertical bending"] + shares["rigid"], 0.999)
            name, _ = self.named(along=-tilt * self.x * self.y, across=self.x**2 - 1.5)
            self.assertEqual(name, "body: lateral bending")

    def test_a_panel_alone_is_local_and_told_by_its_name(self):
        bulge = np.where(self.z > 0.5, np.cos(2.0 * np.pi * self.x) * np.cos(np.pi * self.y / 1.5), 0.0)
        name, shares = self.named(up=bulge)
        self.assertEqual(name, "body, local: roof")
        self.assertGreater(shares["local"], 0.9)

    def test_shares_of_a_mixture_are_those_of_its_squares(self):
        torsion = np.stack([0.0 * self.x, -self.x * self.z, self.x * self.y], axis=1)
        bending = np.stack([0.0 * self.x, 0.0 * self.x, self.x**2], axis=1)
        shares, _ = car_modes.decompose(self.body.places, torsion + bending)
        alone = [np.sum(motion**2) * car_modes.decompose(self.body.places, motion)[0][family]
                 for motion, family in ((torsion, "torsion"), (bending, "vertical bending"))]
        self.assertAlmostEqual(shares["torsion"] / shares["vertical bending"], alone[0] / alone[1], places=10)
        self.assertAlmostEqual(sum(shares.values()), 1.0, places=12)

    def test_ride_is_told_by_wheels_and_mounts(self):
        self.assertEqual(car_modes.ride_words(np.full(4, 0.05), np.array([1.0, 1.0, 0.5, 0.5])), "body: front +1.00, rear +0.50")
        self.assertEqual(car_modes.ride_words(np.full(4, 0.05), np.array([1.0, -1.0, 0.5, -0.5])), "body rolls")
        self.assertEqual(car_modes.ride_words(np.array([1.0, 0.0, 0.0, 0.0]), np.full(4, 0.01)), "hop: front_left +1.00")
        self.assertIsNone(car_modes.ride_words(np.full(4, 0.1), np.full(4, 0.1)))


if __name__ == "__main__":
    unittest.main()
