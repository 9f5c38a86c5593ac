"""How a car's drive is measured, on histories given by formulas."""

import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "report"))
import car_findings  # noqa: E402


class Findings(unittest.TestCase):
    def test_peaks_are_maxima_above_the_static_load_that_stand_out(self):
        values = np.array([10.0, 10, 14, 12, 16, 9, 9.5, 8, 13, 12.5, 12.9, 10])
        # 9.5 lies below the static load of 10; 12.9 is a ripple on the way down from 13.
        self.assertEqual(list(car_findings.peaks(values, 10.0)), [14.0, 16.0, 13.0])

    def test_ringing_finds_amplitude_and_frequency_behind_the_obstacle(self):
        time = np.arange(0.0, 300.0, 0.2)  # ms
        distance = 10.0 * time - 500.0
        force = np.where(distance > 0.0, 700.0 * np.sin(2.0 * np.pi * 0.03 * time), 5000.0)  # 30 Hz
        amplitude, frequency = car_findings.ringing(time, force, distance)
        self.assertAlmostEqual(amplitude, 700.0, delta=1.0)
        self.assertAlmostEqual(frequency, 30.0, delta=0.5)
        self.assertIsNone(car_findings.ringing(time[:200], force[:200], distance[:200]))


if __name__ == "__main__":
    unittest.main()
