#!/usr/bin/env python3
"""How the car's drive scales: from one equilibrium the first milliseconds on several numbers of ranks, and whether they have the same bits.

usage: car.py BALOCCO FOLDER [--fidelity semi-flexible] [--ranks 1 2] [--duration 5]
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
    parser.add_argument("--fidelity", default="semi-flexible", choices=("rigid", "semi-flexible", "complete"))
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--duration", type=float, default=5.0, help="of the drive, ms")
    return parser.parse_args()


def write_decks(given):
    """The equilibrium's deck and a short drive's, in the folder."""
    os.makedirs(given.folder, exist_ok=True)
    place = lambda name: os.path.join(given.folder, name)
    text = re.sub(r'(?m)^fidelity = "\S+"', f'fidelity = "{given.fidelity}"', open(SPEC).read())
    text = text.replace('tyre = "', f'tyre = "{os.path.dirname(os.path.abspath(SPEC))}/', 1)
    open(place("car.toml"), "w").write(text)
    subprocess.run([given.balocco, "car", place("car.toml"), "--output", place("car.inp"), "--drive", place("drive.inp")], check=True,
                   stdout=subprocess.DEVNULL)
    drive = re.sub(r"(?m)^(\*DYNAMIC, EXPLICIT.*\n), \S+", rf"\g<1>, {given.duration}", open(place("drive.inp")).read())
    drive = re.sub(r"\*OUTPUT, FIELD, NUMBER INTERVAL=\d+", "*OUTPUT, FIELD, NUMBER INTERVAL=1", drive)
    for ranks in given.ranks:
        open(place(f"drive_on_{ranks}.inp"), "w").write(drive)


def run(given, name, ranks, *more):
    deck = os.path.join(given.folder, name + ".inp")
    subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), given.balocco, "run", deck, "--output", given.folder, *more], check=True,
                   env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def speed(given, ranks):
    """Increments a second without output, and the log's line of phases."""
    log = open(os.path.join(given.folder, f"drive_on_{ranks}.log")).read()
    line = re.search(r"explicit: (\d+) increments in ([\d.]+) s.*", log)
    output = float(re.search(r"output ([\d.]+) %", line[0])[1])
    return int(line[1]) / (float(line[2]) * (1.0 - 0.01 * output)), line[0]


def main():
    given = arguments()
    write_decks(given)
    checkpoint = os.path.join(given.folder, "car.ckpt.h5")
    run(given, "car", 2)
    speeds = {}
    for ranks in given.ranks:
        run(given, f"drive_on_{ranks}", ranks, "--import", checkpoint)
        speeds[ranks], line = speed(given, ranks)
        print(f"{given.fidelity} on {ranks} ranks: {speeds[ranks]:.0f} increments/s, {speeds[ranks] / speeds[given.ranks[0]]:.2f} times\n  {line}")
    files = [os.path.join(given.folder, f"drive_on_{ranks}.h5") for ranks in given.ranks]
    for other in files[1:]:
        same = subprocess.run([given.balocco, "diff", files[0], other], stdout=subprocess.DEVNULL).returncode == 0
        print(f"{os.path.basename(other)}: {'the same bits' if same else 'OTHER BITS'}")


if __name__ == "__main__":
    main()
