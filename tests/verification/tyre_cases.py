"""The chain of the main job on the coarse tyre of tests/parallel: import at rest, and rolling on a flat road.

usage: tyre_cases.py CASE BALOCCO RANKS FOLDER
"""

import os
import re
import subprocess
import sys

import h5py
import numpy as np

from launch import on_ranks

HERE = os.path.dirname(os.path.abspath(__file__))
SPEC = os.path.join(HERE, "..", "parallel", "small_tyre.toml")


def run(balocco, ranks, folder, changes):
    """Builds the coarse tyre with some keys changed, runs it and opens its results and its log."""
    os.makedirs(folder, exist_ok=True)
    text = open(SPEC).read()
    for key, value in changes.items():
        text, count = re.subn(rf"(?m)^{key} = \S+", f"{key} = {value}", text)
        assert count == 1, f"{key} must stand once in {SPEC}"
    spec, deck = os.path.join(folder, "tyre.toml"), os.path.join(folder, "tyre.inp")
    open(spec, "w").write(text)
    subprocess.run([balocco, "tyre", spec, "--output", deck], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([*on_ranks(ranks), balocco, "run", deck, "--output", folder], check=True)
    return h5py.File(os.path.join(folder, "tyre.h5")), open(os.path.join(folder, "tyre.log")).read()


def step(results, name):
    return next(group for key, group in results.items() if key.startswith("step_") and group.attrs["name"] == name.encode())


def hub_load(results, name):
    hub = results["mesh/node/id"][results["mesh/set/node/HUB"][0]]
    return -step(results, name)[f"history/node_{hub}/RF3"][:]


def check(what, value, limit):
    print(f"{what}: {value:.3g} (limit {limit:g})")
    assert value <= limit, what


def imported_residual(log):
    return float(re.search(r"step SETTLE starts with .* = (\S+) \(", log)[1])


def at_rest(balocco, ranks, folder):
    """Without spin and road speed the imported equilibrium stays: the limits are those that the main job promises."""
    results, log = run(balocco, ranks, folder, {"speed": "0.0", "settle_duration": "20.0", "duration": "0.1"})
    check("|f_int + f_contact - f_ext| / |f_ext| on import", imported_residual(log), 1e-8)
    load = hub_load(results, "SETTLE")
    check("drift of the hub load over 20 ms", np.max(np.abs(load - load[0])) / load[0], 1e-3)


def rolling(balocco, ranks, folder, model="2"):
    """A free wheel on a flat road carries its static load and loses no energy unaccounted for."""
    changes = {"model": model, "settle_duration": "20.0", "duration": "0.1", "obstacle_start": "1000.0"}
    results, log = run(balocco, ranks, folder, changes)
    check("|f_int + f_contact - f_ext| / |f_ext| on import", imported_residual(log), 1e-8)
    load = hub_load(results, "SETTLE")
    second_half = load[len(load) // 2:]
    check("mean load against static load", abs(np.mean(second_half) / load[0] - 1.0), 0.03)
    energy = step(results, "SETTLE")["history/energy"]
    total, kinetic = energy["ETOTAL"][:], energy["ALLKE"][:]
    check("energy error", np.max(np.abs(total - total[0])) / np.max(kinetic), 1e-2)


def rolling_on_membranes(balocco, ranks, folder):
    """As rolling, with sidewalls of membranes alone (model 1)."""
    rolling(balocco, ranks, folder, model="1")


def rolling_start(balocco, ranks, folder):
    """Rolling starts as it goes on: nodes run through the loaded shape, so that the patch neither hits the road nor slips on it. Spun
    rigidly the tyre presses with up to 1.4 times its load at once and is braked with a third of it."""
    changes = {"sectors": "60", "settle_duration": "1.0", "duration": "0.1", "obstacle_start": "600.0", "history_interval": "0.02"}
    results, log = run(balocco, ranks, folder, changes)
    assert re.search(r"it rolls about \(0, 0, 0\); (\d+) of \d+ nodes run through its loaded shape", log), log
    forces = step(results, "SETTLE")["history/contact_TREAD_ROAD_SURFACE"]
    load, grip = forces["CFN"][:, 2], forces["CFT"][:, 0]
    windows = load[1:51].reshape(5, -1).mean(axis=1)
    check("largest mean load of 0.2 ms against static load", np.max(np.abs(windows / load[0] - 1.0)), 0.05)
    check("longitudinal force of rolling against the load", np.max(np.abs(grip[1:51].reshape(5, -1).mean(axis=1))) / load[0], 0.03)


if __name__ == "__main__":
    case, balocco, ranks, folder = sys.argv[1:]
    {"at_rest": at_rest, "rolling": rolling, "rolling_on_membranes": rolling_on_membranes,
     "rolling_start": rolling_start}[case](balocco, ranks, folder)
