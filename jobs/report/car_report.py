"""The report of a car's job: one HTML page that needs no other file.

usage: car_report.py FOLDER REPORT.html      FOLDER: what jobs/car/job.sh left there: car.inp, car.txt, car.h5; drive.inp, drive.h5
once it has driven; kinematics.h5 once its axles were moved
"""

import os
import re
import sys

import numpy as np

import car_comparison
import car_energies
import car_equilibrium
import car_figures
import car_findings
import car_flights
import car_kinematics
import car_loads
import car_modes
from balocco_results import Results
from car_figures import WHEELS, words
from html_page import Page

LENGTHS = ("STRUT_FRONT", "SPRING_REAR", "DAMPER_REAR")
PARTS = {"strut houses": ("STRUT_HOUSE",), "subframe": ("SUBFRAME",)}


def option(deck, pattern, otherwise=""):
    found = re.search(pattern, open(deck).read())
    return found[1] if found else otherwise


def steps_of(status):
    """Name, increments, iterations and seconds of each static step of a status file."""
    rows, within, before = [], False, 0.0
    for line in open(status):
        fields = line.split()
        if step := re.match(r"Step \d+ (\w+): (\w+)", line):
            within = step[2] == "static"
            before += sum(row[3] for row in rows[-1:])
            rows += [[step[1], 0, 0, 0.0]] if within else []
        elif within and len(fields) > 8 and fields[0].isdigit():
            rows[-1][1:] = [int(fields[0]), rows[-1][2] + int(fields[1]), float(fields[8]) - before]
    return rows


def describe_car(page, folder):
    page.heading("The car")
    deck = os.path.join(folder, "car.inp")
    page.figure(car_figures.car(deck),
                "The car as built, and its chassis. Red: high-strength steel; ochre: structural; blue: mild; grey: tyres.")
    page.preformatted(open(os.path.join(folder, "car.txt")).read())


def describe_equilibrium(page, folder, results):
    page.heading("Equilibrium")
    file = results.file
    loads = car_equilibrium.wheel_loads(file)
    moved = lambda name: [float(x) for x in car_equilibrium.last(file, name, "U")]
    page.table(("wheel", "carries, N", "centre moved x, mm", "y, mm", "z, mm"),
               [(words(wheel), loads[wheel], *moved("HUB_" + wheel)) for wheel in WHEELS])
    roads = abs(sum(float(car_equilibrium.last(file, f"ROAD_{side}", "RF")[2]) for side in ("LEFT", "RIGHT")))
    if car_equilibrium.falls(file):
        page.text("So the car falls: without weight, its wheels on their rebound stops.")
    page.text(f"The wheels carry {sum(loads.values()):.3f} N together; the roads are held by {roads:.3f} N.")
    page.table(("mount of the body", "moved up, mm"), [(words(name), moved(name)[2]) for name in car_modes.MOUNTS])
    step, rows = car_equilibrium.last_step(file), []
    for name in (f"{part}_{side}" for part in LENGTHS for side in ("LEFT", "RIGHT")):
        along = lambda variable: float(np.ravel(car_loads.history_of(file, step, "element", name, variable)[-1])[0])
        rows.append((words(name), along("CU"), along("CTF")))
    page.table(("spring or damper", "longer than as drawn, mm", "force along it, N"), rows)
    jobs = [os.path.join(folder, name) for name in ("tyre.sta", "car.sta")]  # one tyre may have been inflated for all
    page.table(("step", "increments", "iterations", "seconds"), [step for job in jobs if os.path.exists(job) for step in steps_of(job)])


def describe_modes(page, results):
    page.heading("Modes about the equilibrium")
    found = car_modes.modes(results.file)
    if not found:
        return page.missing("The job has no frequency step.")
    page.table(("frequency, Hz", "on springs and tyres"), [(mode.frequency, mode.kind) for mode in found if not mode.shares])
    page.text("Cars of the class: bounce at 1.1 to 1.5 Hz, wheels hop at 10 to 14 Hz, the body twists and bends at 20 to 60 Hz.")
    own = [mode for mode in found if mode.shares]
    if own:
        percent = lambda mode: (f"{100.0 * mode.shares[family]:.0f} %" for family in car_modes.FAMILIES)
        page.table(("frequency, Hz", "the body's own", *car_modes.FAMILIES),
                   [(mode.frequency, mode.kind, *percent(mode)) for mode in own])
        page.text("Shares of the squares of its nodes' motion: of rigid motions; of ends that roll against each other; of a middle "
                  "that moves against the ends, up or sideways; of a roof that leans over the floor; of the rest.")
    standing = next(step for step in reversed(results.steps) if step.frames).frames[-1].node("U").astype(float)
    page.figure(car_figures.modes(results, [mode for mode in found if not mode.local], standing),
                "Shapes of all but the local ones, magnified, before the standing car.")


def describe_kinematics(page, path):
    page.heading("Kinematics of the axles")
    if not os.path.exists(path):
        return page.missing("The axles have not been moved: there is no kinematics.h5.")
    results = Results(path)
    if not {"BUMP", "REBOUND", "ROLL"} <= {step.name for step in results.steps if step.completed}:
        return page.missing("The axles have not been moved to the end: kinematics.h5 lacks steps.")
    page.figure(car_kinematics.figure(results),
                "Toe, camber, half track at the road and load of the left wheels as both wheels of an axle travel.")
    page.table(("about design height", "front", "rear"), car_kinematics.summary(results))


def describe_obstacle(page, drive, obstacle, columns, away):
    page.heading("Fall" if obstacle.drop else "Obstacle")
    if obstacle.drop:
        return page.text(car_flights.Landing(drive, drive.steps[-1]).words())
    page.text(obstacle.words())
    out = np.flatnonzero(away["wheel_centre_rear_left"] > obstacle.behind)
    page.text(f"The rear wheels have left it after {columns['time'][out[0]]:.0f} ms of {columns['time'][-1]:.0f}." if len(out) else
              f"The drive of {columns['time'][-1]:.0f} ms ends before the rear wheels have left it.")
    page.figure(car_figures.road(drive), "The roads' profiles.")


def describe_loads(page, obstacle, step, columns, away):
    page.heading("Loads")
    shown = [name for name, _, _ in car_loads.FORCES if not obstacle.hole or name.endswith("left")]
    for group in ("wheel_centre", "strut_mount"):
        names = [name for name in shown if name.startswith(group)]
        page.figure(car_figures.against_distance(columns, away, names, ("Fz", "Fx", "Fy"), "N", obstacle.label),
                    f"Forces of the {words(group)}s on the car against {obstacle.measure}.")
    rails = sorted({name.rpartition("_")[0] for name in columns if name.startswith("section_")})
    if rails:
        places = dict.fromkeys(rails, away["wheel_centre_front_left"])
        page.figure(car_figures.against_distance(columns, places, rails, ("N", "Vz"), "N", obstacle.label),
                    "Section forces across the middles of the rails: tension, and shear up, of the front part on the rear one; of the "
                    "front wheels.")
        page.figure(car_figures.against_distance(columns, places, rails, ("My", "Mz"), "N mm", obstacle.label),
                    "Moments in the same sections.")
    else:
        page.missing("Section forces of the rails: they are rigid in this job; BALOCCO_FIDELITY=complete makes them deform.")
    page.table(("wheel", "the road carries at most, N", "after, ms", "off the road", "at the end, N"), car_flights.rows(step))
    page.text("The forces as tables: loads.csv and loads.h5 beside this page.")


def instants_of_motion(obstacle, columns, away):
    """Times at which the car is shown: as wheels come to the obstacle and leave it; evenly over a fall."""
    if obstacle.drop:
        return list(np.linspace(columns["time"][0], columns["time"][-1], 6))
    axles = (away["wheel_centre_front_left"], away["wheel_centre_rear_left"])
    places = (-250.0, 300.0, obstacle.behind - 300.0, obstacle.behind) if obstacle.hole else (-250.0, 0.0, 300.0)
    return sorted(float(np.interp(place, values, columns["time"])) for values in axles for place in places
                  if values[0] < place < values[-1])


def describe_motion(page, obstacle, drive, columns, away):
    page.heading("Motion")
    for group in ("wheel_centre", "strut_mount"):
        names = [name for name, _, _ in car_loads.FORCES if name.startswith(group)]
        page.figure(car_figures.against_distance(columns, away, names, ("Uz", "Ux"), "mm", obstacle.label),
                    f"Motion of the {words(group)}s since the start.")
    along = [name.lower() for name in car_loads.ALONG]
    travelled = {name: away[f"wheel_centre_{'front' if 'front' in name else 'rear'}_left"] for name in along}
    page.figure(car_figures.against_distance(columns, travelled, along, ("travel",), "mm", obstacle.label),
                "Springs and dampers: longer than as drawn.")
    roads = [drive.node_sets["ROAD_LEFT"][0]]
    page.figure(car_figures.motion(drive, drive.steps[-1], instants_of_motion(obstacle, columns, away) or [0.0], roads),
                "Frames of the motion.")


def describe_both(page, obstacle, folder):
    page.heading("The semi-flexible and the complete car")
    folders = car_comparison.both(folder)
    if not folders:
        return page.missing("Only one of them has been driven over this obstacle: BALOCCO_FIDELITY=semi-flexible, and =complete, "
                            "bash jobs/run.sh car drive them.")
    drives = {fidelity: car_comparison.Loads(path) for fidelity, path in folders.items()}
    page.figure(car_comparison.figure(drives), "Forces on the car on its left side, below 150 Hz, as far as both have been driven, "
                f"against {obstacle.measure}.")
    page.table(("force on the car, N", "semi-flexible: farthest from its start", "complete: likewise", "differs by",
                "root mean square of the difference"), car_comparison.rows(drives))


def instants_of_stress(obstacle, columns, away):
    """Times at which stress is shown, by what happens then; none before the obstacle."""
    wheel, end = "wheel_centre_front_left", {"at the end": float(columns["time"][-1])}
    highest = float(columns["time"][np.argmax(columns[f"{wheel}_Fz"])])
    if obstacle.drop:
        return {"the left front wheel carries most": highest} | end
    if away[wheel].max() < 0.0:
        return {}
    if not obstacle.hole:
        return {"the front wheels above the obstacle's middle": float(np.interp(0.0, away[wheel], columns["time"]))}
    return {"the left front wheel strikes the ramp out of the hole": highest} | end


def describe_stress(page, drive, instants, fidelity):
    page.heading("Stress of strut houses and subframe")
    if fidelity == "rigid":
        return page.missing("These parts are rigid in this job; BALOCCO_FIDELITY=semi-flexible or complete makes them deform.")
    if not instants:
        return page.missing("The drive ends before the obstacle.")
    for happens, time in instants.items():
        frame = min(drive.steps[-1].frames, key=lambda frame: abs(frame.step_time - time))
        groups = {title: wanted for title, wanted in PARTS.items() if car_figures.stress_of(drive, frame, wanted)}
        if not groups:
            return page.missing("The results hold no stress of these parts.")
        page.figure(car_figures.contours(drive, frame, groups),
                    f"At {frame.step_time:.1f} ms, {happens}; the worse face of each shell.")


def describe_energy(page, folder, drive, columns):
    page.heading("Energy")
    page.figure(car_figures.energy(drive.steps[-1].history("energy")), "Energies over the drive, and the error of their balance.")
    tables = os.path.join(folder, "drive.dat")
    if not os.path.exists(tables):
        return page.missing("Energies by part: there is no drive.dat.")
    page.figure(car_figures.energies_of_parts({kind: car_energies.of_assemblies(tables, kind) for kind in ("internal", "kinetic")},
                                              columns["time"], car_energies.of_springs(columns)),
                "Less their first value: elastic and kinetic energies of what deforms; what has been done on springs and dampers.")


def describe_drive(page, folder, fidelity):
    deck, results = (os.path.join(folder, name) for name in ("drive.inp", "drive.h5"))
    drive, columns = Results(results), car_loads.table(deck, results)
    obstacle = car_findings.course(drive)
    away = obstacle.distances(columns)
    describe_obstacle(page, drive, obstacle, columns, away)
    describe_loads(page, obstacle, drive.steps[-1], columns, away)
    if fidelity in car_comparison.FIDELITIES:
        describe_both(page, obstacle, folder)
    describe_motion(page, obstacle, drive, columns, away)
    describe_stress(page, drive, instants_of_stress(obstacle, columns, away), fidelity)
    describe_energy(page, folder, drive, columns)
    if obstacle.drop:
        page.heading("What Balocco finds")
        return page.table(("", "Balocco"), car_findings.of_drop(columns, drive, drive.steps[-1], fidelity))
    page.heading("What the paper says, what Balocco finds")
    page.table(("", "the paper", "Balocco", "why they differ"), car_findings.compare(obstacle, columns, away, drive, drive.steps[-1], fidelity))


def report(folder, path):
    inside = lambda name: os.path.join(folder, name)
    title = option(inside("car.inp"), r"\*HEADING\n(.*?)\. Units", "Car")
    fidelity = option(inside("car.inp"), r"FIDELITY: (\S+)")
    page = Page(f"{title}: {fidelity}")
    describe_car(page, folder)
    if os.path.exists(inside("car.h5")):
        standing = Results(inside("car.h5"))
        describe_equilibrium(page, folder, standing)
        describe_modes(page, standing)
    else:
        page.missing("The equilibrium has not been run: there is no car.h5.")
    describe_kinematics(page, inside("kinematics.h5"))
    if not os.path.exists(inside("drive.h5")):
        page.missing("The car has not been driven: there is no drive.h5. BALOCCO_OBSTACLE=comfort (or pothole) bash jobs/run.sh "
                     "car drives it.")
        return page.write(path)
    describe_drive(page, folder, fidelity)
    page.write(path)


if __name__ == "__main__":
    report(sys.argv[1], sys.argv[2])
