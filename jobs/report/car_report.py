"""The report of a car's job: one HTML page that needs no other file.

usage: car_report.py FOLDER REPORT.html      FOLDER: what jobs/car/job.sh left there: car.inp, car.txt, car.h5; drive.inp, drive.h5
once it has driven; kinematics.h5 once its axles were moved
"""

import os
import re
import sys

import numpy as np

import car_equilibrium
import car_figures
import car_findings
import car_kinematics
import car_loads
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
    page.text(f"The wheels carry {sum(loads.values()):.3f} N together; the roads are held by {roads:.3f} N.")
    page.table(("mount of the body", "moved up, mm"), [(words(name), moved(name)[2]) for name in car_equilibrium.MOUNTS])
    step, rows = car_equilibrium.last_step(file), []
    for name in (f"{part}_{side}" for part in LENGTHS for side in ("LEFT", "RIGHT")):
        along = lambda variable: float(np.ravel(car_loads.history_of(file, step, "element", name, variable)[-1])[0])
        rows.append((words(name), along("CU"), along("CTF")))
    page.table(("spring or damper", "longer than as drawn, mm", "force along it, N"), rows)
    page.table(("step", "increments", "iterations", "seconds"), steps_of(os.path.join(folder, "car.sta")))


def describe_modes(page, results):
    page.heading("Ride: modes about the equilibrium")
    found = car_equilibrium.ride_modes(results.file)
    if not found:
        return page.missing("The job has no frequency step.")
    page.table(("frequency, Hz", "what moves"), [(float(frequency), kind) for frequency, kind, _ in found])
    page.text("Cars of the class: bounce at 1.1 to 1.5 Hz, wheels hop at 10 to 14 Hz.")
    standing = next(step for step in reversed(results.steps) if step.frames).frames[-1].node("U").astype(float)
    page.figure(car_figures.modes(results, found, standing), "Their shapes, magnified, before the standing car.")


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


def describe_drive(page, folder, drive, columns, away):
    page.heading("Loads")
    for group, quantities in (("wheel_centre", ("Fz", "Fx", "Fy")), ("strut_mount", ("Fz", "Fx", "Fy"))):
        names = [name for name, _, _ in car_loads.FORCES if name.startswith(group)]
        page.figure(car_figures.against_distance(columns, away, names, quantities, "N"),
                    f"Forces of the {words(group)}s on the car against the distance from the obstacle.")
    page.text("The same as a table: loads.csv beside this page.")
    page.heading("Motion")
    for group in ("wheel_centre", "strut_mount"):
        names = [name for name, _, _ in car_loads.FORCES if name.startswith(group)]
        page.figure(car_figures.against_distance(columns, away, names, ("Uz", "Ux"), "mm"),
                    f"Motion of the {words(group)}s since the start.")
    along = [name.lower() for name in car_loads.ALONG]
    travelled = {name: away[f"wheel_centre_{'front' if 'front' in name else 'rear'}_left"] for name in along}
    page.figure(car_figures.against_distance(columns, travelled, along, ("travel",), "mm"),
                "Springs and dampers: longer than as drawn.")
    axles = (away["wheel_centre_front_left"], away["wheel_centre_rear_left"])
    instants = sorted(float(np.interp(place, values, columns["time"])) for values in axles for place in (-250.0, 0.0, 300.0)
                      if values[0] < place < values[-1])
    step = drive.steps[-1]
    roads = [drive.node_sets["ROAD_LEFT"][0]]
    page.figure(car_figures.motion(drive, step, instants or [0.0], roads), "Frames of the motion.")
    return step


def describe_stress(page, drive, step, time, fidelity):
    page.heading("Stress of strut houses and subframe")
    if fidelity == "rigid":
        return page.missing("These parts are rigid in this job; BALOCCO_FIDELITY=semi-flexible or complete makes them deform.")
    frame = min(step.frames, key=lambda frame: abs(frame.step_time - time))
    groups = {title: wanted for title, wanted in PARTS.items() if car_figures.stress_of(drive, frame, wanted)}
    if not groups:
        return page.missing("The results hold no stress of these parts.")
    page.figure(car_figures.contours(drive, frame, groups),
                f"At {frame.step_time:.1f} ms, the front wheels about where distances count from; the worse face of each shell.")


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
    drive = Results(inside("drive.h5"))
    columns = car_loads.table(inside("drive.inp"), inside("drive.h5"))
    obstacle = car_findings.Obstacle(drive)
    page.heading("Obstacle")
    page.text(obstacle.words())
    page.figure(car_figures.road(drive), "The roads' profiles.")
    away = obstacle.distances(columns)
    step = describe_drive(page, folder, drive, columns, away)
    crossing = float(np.interp(0.0, away["wheel_centre_front_left"], columns["time"]))
    describe_stress(page, drive, step, crossing, fidelity)
    page.heading("Energy")
    energy = step.history("energy")
    page.figure(car_figures.energy(energy), "Energies over the drive, and the error of their balance.")
    page.heading("What the paper says, what Balocco finds")
    page.table(("", "the paper", "Balocco"), car_findings.compare(obstacle, columns, away, drive, step, fidelity))
    page.write(path)


if __name__ == "__main__":
    report(sys.argv[1], sys.argv[2])
