#!/usr/bin/env python3
"""How the car's drive scales: from one equilibrium the first milliseconds on several numbers of ranks, and whether they have the same bits.

usage: car.py BALOCCO FOLDER [--job results/car/comfort_semi-flexible] [--fidelity semi-flexible] [--ranks 1 2] [--duration 5]
"""
import argparse
import os
import re
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
SPEC = os.path.join(HERE, "..", "car", "car.toml")
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("balocco")
    parser.add_argument("folder")
    parser.add_argument("--job", help="folder of a car's job that has been run: its equilibrium and drive are taken")
    parser.add_argument("--fidelity", default="semi-flexible", choices=("rigid", "semi-flexible", "complete"))
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--duration", type=float, default=5.0, help="of the drive, ms")
    return parser.parse_args()


def equilibrium(given):
    """Runs it in the folder, where a drive's deck then stands too. @return the folder"""
    place = lambda name: os.path.join(given.folder, name)
    subprocess.run([given.balocco, "car", SPEC, "--fidelity", given.fidelity, "--output", place("car.inp"), "--drive", place("drive.inp")],
                   check=True, stdout=subprocess.DEVNULL)
    run(given, "car", 2)
    return given.folder


def write_drives(given, job):
    """Decks of the first milliseconds."""
    drive = re.sub(r"(?m)^(\*DYNAMIC, EXPLICIT.*\n), \S+", rf"\g<1>, {given.duration}", open(os.path.join(job, "drive.inp")).read())
    drive = re.sub(r"\*OUTPUT, FIELD, NUMBER INTERVAL=\d+", "*OUTPUT, FIELD, NUMBER INTERVAL=1", drive)
    drive = re.sub(r"\*RESTART, WRITE, NUMBER INTERVAL=\d+", "*RESTART, WRITE, NUMBER INTERVAL=1", drive)
    for ranks in given.ranks:
        open(os.path.join(given.folder, f"drive_on_{ranks}.inp"), "w").write(drive)


def run(given, name, ranks, *more):
    deck = os.path.join(given.folder, name + ".inp")
    yielding = {"OMPI_MCA_mpi_yield_when_idle": "1"} if ranks > os.cpu_count() else {}  # more ranks than cores: for their bits alone
    subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), given.balocco, "run", deck, "--output", given.folder, *more], check=True,
                   env=ENVIRONMENT | yielding, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def speed(given, ranks):
    """Increments a second without output, and the log's line of phases."""
    log = open(os.path.join(given.folder, f"drive_on_{ranks}.log")).read()
    line = re.search(r"explicit: (\d+) increments in ([\d.]+) s.*", log)
    output = float(re.search(r"output ([\d.]+) %", line[0])[1])
    return int(line[1]) / (float(line[2]) * (1.0 - 0.01 * output)), line[0]


def main():
    given = arguments()
    os.makedirs(given.folder, exist_ok=True)
    job = given.job or equilibrium(given)
    write_drives(given, job)
    checkpoint = os.path.join(job, "car.ckpt.h5")
    speeds = {}
    for ranks in given.ranks:
        run(given, f"drive_on_{ranks}", ranks, "--import", checkpoint)
        speeds[ranks], line = speed(given, ranks)
        print(f"{os.path.basename(os.path.normpath(job))} on {ranks} ranks: {speeds[ranks]:.0f} increments/s, {speeds[ranks] / speeds[given.ranks[0]]:.2f} times\n  {line}")
    files = [os.path.join(given.folder, f"drive_on_{ranks}.h5") for ranks in given.ranks]
    for other in files[1:]:
        same = subprocess.run([given.balocco, "diff", files[0], other], stdout=subprocess.DEVNULL).returncode == 0
        print(f"{os.path.basename(other)}: {'the same bits' if same else 'OTHER BITS'}")


if __name__ == "__main__":
    main()
