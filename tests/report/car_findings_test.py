"""How a car's drive is measured, on histories given by formulas."""

import os
import sys
import tempfile
import types
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "report"))
import car_comparison  # noqa: E402
import car_energies  # noqa: E402
import car_findings  # noqa: E402
import car_flights  # noqa: E402
import car_loads  # noqa: E402
import car_report  # noqa: E402
import car_sections  # noqa: E402


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

    def test_stress_is_shown_at_the_middle_of_a_bar_and_at_the_end_of_a_hole(self):
        time = np.arange(0.0, 101.0)
        columns = {"time": time, "wheel_centre_front_left_Fz": np.where(time == 70.0, 9000.0, 4000.0)}
        away = {"wheel_centre_front_left": 10.0 * time - 400.0}
        when = lambda hole, away: list(car_report.instants_of_stress(types.SimpleNamespace(hole=hole, drop=False), columns, away).values())
        self.assertEqual(when(False, away), [40.0])
        self.assertEqual(when(True, away), [70.0, 100.0])
        self.assertEqual(when(True, {"wheel_centre_front_left": away["wheel_centre_front_left"] - 700.0}), [])

    def test_a_fall_is_told_by_time(self):
        road = lambda heights: types.SimpleNamespace(profile=np.column_stack([np.arange(len(heights)), heights]), origin=np.zeros(3))
        results = lambda heights: types.SimpleNamespace(surfaces={"ROAD_LEFT_SURFACE": road(heights)}, coordinates=np.zeros((2, 3)),
                                                        node_sets={"HUB_FRONT_LEFT": [0], "HUB_REAR_LEFT": [1]})
        self.assertFalse(car_findings.course(results([0.0, 0.0, 25.0, 25.0, 0.0])).drop)
        fall = car_findings.course(results([0.0, 0.0]))
        self.assertTrue(fall.drop)
        time = np.arange(0.0, 101.0)
        columns = {"time": time, "wheel_centre_front_left_Fz": np.where(time == 70.0, 9000.0, 4000.0)}
        away = fall.distances(columns)
        self.assertEqual(list(car_report.instants_of_stress(fall, columns, away).values()), [70.0, 100.0])
        self.assertEqual(car_report.instants_of_motion(fall, columns, away), [0.0, 20.0, 40.0, 60.0, 80.0, 100.0])

    def test_flights_of_a_wheel_are_spans_without_load(self):
        time = np.arange(8.0)
        self.assertEqual(car_flights.flights(time, np.array([0.0, 0, 50, 50, 0, 0, 0, 9])), [(0.0, 2.0), (4.0, 7.0)])
        self.assertEqual(car_flights.flights(time, np.array([9.0, 9, 9, 9, 9, 9, 0, 0])), [(6.0, 7.0)])
        self.assertEqual(car_flights.flights(time, np.full(8, 9.0)), [])

    def test_landing_tells_the_height_of_the_fall(self):
        time = np.arange(0.0, 20.0, 0.1)
        load = np.where(time > 5.95, 3000.0 * (time - 5.95), 0.0)
        speed = np.column_stack([np.zeros_like(time), np.zeros_like(time), -3.0 - 9.81e-3 * time])
        names = {f"contact_TREAD_{wheel}_ROAD": {"time": time, "CFN": np.outer(load * (wheel == "REAR_LEFT"), (0.0, 0.0, 1.0))}
                 for wheel in car_flights.WHEELS} | {"node_7": {"time": time, "V": speed}}
        step = types.SimpleNamespace(time_start=0.0, histories=lambda: list(names), history=names.get)
        landing = car_flights.Landing(types.SimpleNamespace(reference_id=lambda name: 7), step)
        self.assertEqual(landing.wheel, "REAR_LEFT")
        self.assertAlmostEqual(landing.speed, 3.0 + 9.81e-3 * 6.0, places=6)
        self.assertAlmostEqual(landing.height, landing.speed**2 / (2.0 * 9.81e-3), places=6)
        self.assertIn("touches it after 6.0 ms", landing.words())
        names["contact_TREAD_FRONT_LEFT_ROAD"]["CFN"] = np.full((len(time), 3), 3000.0)
        self.assertIn("on it from the start", car_flights.Landing(types.SimpleNamespace(reference_id=lambda name: 7), step).words())

    def test_peaks_in_the_hole_count_from_the_ramp_on(self):
        distance = np.linspace(-1000.0, 1000.0, 201)
        columns = {"time": np.arange(201.0), "wheel_centre_rear_left_Fz": np.where(distance < -500.0, 99e3, np.where(distance > 400.0, 21e3, 2e3)),
                   "wheel_centre_rear_left_Fx": np.where(distance == 520.0, -18e3, 0.0)}
        found = lambda distance: car_findings.blow(columns, {"wheel_centre_rear_left": distance}, "wheel_centre_rear_left")
        self.assertRegex(found(distance), r"below 150 Hz 21\.\d and \d\.\d kN; at most 21\.0 and 18\.0 kN")
        self.assertEqual(found(distance - 2000.0), "not reached in this drive")

    def test_a_stop_is_told_by_what_pushes_a_member_together_most(self):
        columns = {"travel": np.array([-5.0, -77.0, 60.0]), "force": np.array([-3600.0, -38400.0, 300.0])}
        self.assertIn("the strut is pushed 72 mm together from where it stands and carries 38.4 kN",
                      car_findings.squeezed(columns, "strut", "travel", "force"))

    def test_two_drives_are_compared_where_both_have_been(self):
        name = car_comparison.COMPARED[0]
        distance = np.linspace(-600.0, 1400.0, 2001)
        bump = 1000.0 * np.exp(-(distance / 100.0)**2)
        drive = lambda force, end: types.SimpleNamespace(distance={name: distance[:end]}, force={name: force[:end]})
        drives = {"semi-flexible": drive(4000.0 + bump, 2001), "complete": drive(4000.0 + 0.5 * bump, 1201)}  # to 600
        one, other, spread = car_comparison.difference(drives, name)
        self.assertAlmostEqual(one, 5000.0, delta=1.0)
        self.assertAlmostEqual(other, 4500.0, delta=1.0)
        # Of half the bump over 1200 mm: 500 sqrt(100 sqrt(pi / 2) / 1200).
        self.assertAlmostEqual(spread, 500.0 * np.sqrt(100.0 * np.sqrt(np.pi / 2.0) / 1200.0), delta=0.5)


def box_section(width, height, strips):
    """Corners of strips of sheet around a box along x, 20 mm long: (n, 4, 3)."""
    y, z = 0.5 * width, 0.5 * height
    outline = np.array([(y, -z), (y, z), (-y, z), (-y, -z), (y, -z)])
    points = np.concatenate([np.linspace(a, b, strips, endpoint=False) for a, b in zip(outline[:-1], outline[1:])])
    after = np.roll(points, -1, axis=0)
    place = lambda x, at: np.column_stack([np.full(len(at), x), at])
    return np.stack([place(0.0, points), place(20.0, points), place(20.0, after), place(0.0, after)], axis=1)


class Parts(unittest.TestCase):
    def test_section_forces_of_a_box_under_tension_and_bending(self):
        corners = box_section(80.0, 60.0, 50)
        y, z = corners.mean(axis=1)[:, 1:].T
        sheet = np.zeros((1, len(corners), 5))
        sheet[0, :, 0] = 3.0 + 0.1 * z + 0.2 * y
        about_y, about_z = 2.0 * 80.0 * 30.0**2 + 2.0 * 60.0**3 / 12.0, 2.0 * 60.0 * 40.0**2 + 2.0 * 80.0**3 / 12.0
        wanted = (3.0 * 280.0, 0.0, 0.0, 0.1 * about_y, -0.2 * about_z)
        np.testing.assert_allclose(car_sections.resultants(corners, sheet)[0], wanted, rtol=1e-3, atol=1e-6)

    def test_shear_of_the_walls_alone_goes_up(self):
        corners = box_section(80.0, 60.0, 10)
        y = corners.mean(axis=1)[:, 1]
        sheet = np.zeros((1, len(corners), 5))
        sheet[0, np.abs(y) > 39.0, 2] = 2.0 * np.sign(y[np.abs(y) > 39.0])  # direction 2 goes around
        found = car_sections.resultants(corners, sheet)[0]
        self.assertAlmostEqual(found[2], 2.0 * 2.0 * 60.0, places=9)
        self.assertAlmostEqual(found[0], 0.0, places=9)

    def test_energies_of_parts_are_read_and_tyres_of_an_axle_added(self):
        row = "\n total {} energy for set {} and time  0.{}000000E+01\n\n        {:13.6E}\n"
        with tempfile.NamedTemporaryFile("w", suffix=".dat") as tables:
            for time in (1, 2):
                for part, value in (("TYRE_FRONT_LEFT", 10.0), ("TYRE_FRONT_RIGHT", 20.0), ("REAR_AXLE", 5.0)):
                    tables.write(row.format("internal", part, time, time * value) + row.format("kinetic", part, time, -value))
            tables.flush()
            found = car_energies.of_assemblies(tables.name, "internal")
        self.assertEqual(set(found), {"tyres front", "rear axle"})
        np.testing.assert_allclose(found["tyres front"], [(1.0, 30.0), (2.0, 60.0)])

    def test_loads_lie_by_place_with_their_units(self):
        columns = {"time": np.arange(3.0), "strut_mount_front_left_Fz": np.ones(3), "spring_rear_left_travel": np.zeros(3),
                   "section_rear_rail_left_My": np.full(3, 2.0)}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "loads.h5")
            car_loads.write_groups(columns, path)
            with h5py.File(path) as file:
                units = {name: file[name].attrs["unit"] for name in ("time", "strut_mount_front_left/Fz", "spring_rear_left/travel",
                                                                     "section_rear_rail_left/My")}
                self.assertEqual(list(units.values()), ["ms", "N", "mm", "N mm"])
                np.testing.assert_array_equal(file["section_rear_rail_left/My"], [2.0, 2.0, 2.0])

    def test_work_on_springs(self):
        travel = np.linspace(0.0, 10.0, 101)
        columns = {"time": travel} | {f"{name}_{side}_{what}": values for name in car_energies.SPRINGS for side in ("left", "right")
                                      for what, values in (("force", 20.0 * travel), ("travel", travel))}
        for done in car_energies.of_springs(columns).values():
            self.assertAlmostEqual(done[-1], 2.0 * 0.5 * 20.0 * 10.0**2, places=9)


if __name__ == "__main__":
    unittest.main()
