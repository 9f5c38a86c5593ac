#!/usr/bin/env python3
"""Draws what a tyre run over an obstacle has to show, and writes its key figures.

usage: report.py RESULTS.h5 --output DIR [--hub ID] [--road ID] [--cutoff FREQUENCY] [--variable LE|S|U|...]

The hub and the road are found as the node sets HUB and ROAD, the obstacle in the road's profile; options say otherwise.
Forces are those of the tyre on the hub: Fz up, Fx along the direction of travel.
"""

import argparse
import os
import sys

import numpy as np
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import tyre_picture
from balocco_results import Results

CLEAR = 200.0  # distance (mm) before the obstacle's centre up to which the tyre does not feel it


class Run:
    """A results file with the roles of its nodes."""

    def __init__(self, path, hub, road):
        self.results = Results(path)
        self.hub = hub if hub is not None else self.results.reference_id("HUB")
        self.surface = next(iter(self.results.surfaces.values()), None)
        self.road = road if road is not None else self.results.reference_id("ROAD")
        if self.road is None and self.surface is not None:
            self.road = self.surface.reference_node
        if self.hub is None:
            raise SystemExit(f"{path}: no node set HUB with one node; name the hub's reference node with --hub ID")
        self.rolling = [step for step in self.results.steps if step.explicit]
        self.static = [step for step in self.results.steps if not step.explicit]

    def hub_history(self, steps):
        return self.results.history(f"node_{self.hub}", steps)

    def road_history(self, steps):
        return self.results.history(f"node_{self.road}", steps) if self.road is not None else {}

    def obstacle(self):
        """(centre, length, height) along and above the road's profile, or None on a flat road."""
        if self.surface is None:
            return None
        along, height = self.surface.profile.T
        base = height[0]
        raised = np.abs(height - base) > 1e-6 * max(1.0, np.ptp(along))
        if not raised.any():
            return None
        return (0.5 * (along[raised].min() + along[raised].max()), np.ptp(along[raised]), np.ptp(height))

    def distance(self, road_displacement):
        """Wheel centre minus obstacle centre along the road: negative before the obstacle."""
        hub_along = self.results.coordinates[self.results.row(self.hub)] @ self.surface.axes[0]
        return hub_along - (self.surface.origin @ self.surface.axes[0] + self.obstacle()[0] + road_displacement)

    def road_moved(self, frame):
        displacement = frame.node("U")
        if self.road is None or displacement is None:
            return np.zeros(3)
        return displacement[self.results.row(self.road)].astype(float)


def smooth(time, values, cutoff):
    """Gaussian low pass without phase shift, -3 dB at `cutoff`; the ends are continued as constants."""
    spacing = float(np.median(np.diff(time)))
    width = np.sqrt(np.log(2.0)) / (2.0 * np.pi * cutoff) / spacing  # standard deviation in samples
    if width < 0.5:
        return values
    half = int(4 * width) + 1
    kernel = np.exp(-0.5 * (np.arange(-half, half + 1) / width)**2)
    return np.convolve(np.pad(values, half, mode="edge"), kernel / kernel.sum(), mode="valid")


def new_axes(title, xlabel, ylabel):
    figure, axes = plt.subplots(figsize=(7.2, 4.2), constrained_layout=True)
    axes.set(title=title, xlabel=xlabel, ylabel=ylabel)
    axes.grid(alpha=0.25)
    return figure, axes


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name), dpi=150)
    plt.close(figure)


def column(history, name):
    """A component such as RF3, also where the file has the whole vector."""
    if name in history:
        return history[name]
    if name[:-1] in history and name[-1] in "123":
        return history[name[:-1]][:, int(name[-1]) - 1]
    return None


def inflated_figures(run, figures):
    """Dimensions of the tyre at the end of the step named INFLATE: all nodes but the hub's and the road's."""
    step = next((step for step in run.static if step.name == "INFLATE"), None)
    displacement = step.frames[-1].node("U") if step is not None and step.frames else None
    if displacement is None:
        return
    tyre = ~np.isin(np.arange(len(displacement)), [run.results.row(node) for node in (run.hub, run.road) if node is not None])
    hub = run.results.coordinates[run.results.row(run.hub)]
    position = (run.results.coordinates + displacement)[tyre] - hub
    figures["inflated section width (mm)"] = float(np.ptp(position[:, 1]))
    figures["inflated outer diameter (mm)"] = 2.0 * float(np.hypot(position[:, 0], position[:, 2]).max())


def static_figures(run, folder, figures):
    """Load against deflection over the static steps in which the road touches the tyre."""
    hub, road = run.hub_history(run.static), run.road_history(run.static)
    force, rise = column(hub, "RF3"), column(road, "U3")
    if force is None or rise is None or len(force) < 3:
        return
    force = -force
    touched = force > 1e-3 * force.max()
    if touched.sum() < 2:
        return
    force, rise = force[touched], rise[touched]
    order = np.argsort(rise, kind="stable")
    force, rise = force[order], rise[order]
    # The road touches where the first two points, taken straight on, reach no force.
    touch = rise[0] - force[0] * (rise[1] - rise[0]) / (force[1] - force[0]) if force[1] != force[0] else rise[0]
    deflection = rise - touch
    figures["static load (N)"] = force[-1]
    figures["static deflection (mm)"] = deflection[-1]
    figures["static vertical stiffness, load / deflection (N/mm)"] = force[-1] / deflection[-1]
    if rise[-1] > rise[-2]:
        figures["static vertical stiffness, tangent at load (N/mm)"] = (force[-1] - force[-2]) / (rise[-1] - rise[-2])
    figure, axes = new_axes("Static load against deflection", "deflection (mm)", "Fz (N)")
    axes.plot(np.append(0.0, deflection), np.append(0.0, force), "o-", color="#1f4e79", markersize=3)
    save(figure, folder, "static_load.png")


def rolling_figures(run, folder, cutoff, figures):
    """Hub forces and spin over the wheel-obstacle distance (over time on a flat road)."""
    hub, road = run.hub_history(run.rolling), run.road_history(run.rolling)
    if not hub:
        return
    time = hub["time"]
    obstacle = run.obstacle() if column(road, "U1") is not None else None
    axis, label = (run.distance(column(road, "U1")), "wheel centre - obstacle centre (mm)") if obstacle else (time, "time")
    curves = [("RF3", -1.0, "Fz", "Fz (N)"), ("RF1", -1.0, "Fx", "Fx (N)"), ("VR2", 1.0, "spin", "spin (rad/time)"),
              ("AR2", 1.0, "spin_acceleration", "spin acceleration (rad/time²)")]
    for variable, sign, name, ylabel in curves:
        values = column(hub, variable)
        if values is None:
            continue
        values = sign * values
        low = smooth(time, values, cutoff)
        figure, axes = new_axes(f"{name.replace('_', ' ')} at the hub", label, ylabel)
        axes.plot(axis, values, color="#9db7d5", linewidth=0.6, label="as computed")
        axes.plot(axis, low, color="#1f4e79", linewidth=1.6, label=f"below {cutoff:g} / time unit")
        if obstacle:
            axes.axvspan(-0.5 * obstacle[1], 0.5 * obstacle[1], color="#c0504d", alpha=0.15, label="obstacle")
        axes.legend(fontsize=8)
        save(figure, folder, f"{name}.png")
    if column(hub, "RF3") is not None:
        force_figures(time, axis, obstacle, {"Fz": -column(hub, "RF3"), "Fx": -column(hub, "RF1")}, cutoff, figures)


def force_figures(time, axis, obstacle, forces, cutoff, figures):
    before = axis < -CLEAR if obstacle else np.ones(len(time), bool)
    if before.sum() < 10:
        return
    settled = before & (time > time[before][0] + 0.5 * np.ptp(time[before]))  # the second half: starting has rung out
    vertical = forces["Fz"]
    steady = float(vertical[settled].mean())
    figures["steady Fz on the flat road (N)"] = steady
    if "static load (N)" in figures:
        figures["steady Fz against static load (%)"] = 100.0 * (steady / figures["static load (N)"] - 1.0)
    if not obstacle or (~before).sum() < 10:
        return
    low = smooth(time, vertical, cutoff) - steady
    over = ~before
    inner = np.flatnonzero(over)[1:-1]
    peaks = [i for i in inner if low[i] >= low[i - 1] and low[i] > low[i + 1] and low[i] > 0.25 * low[over].max()]
    for number, peak in enumerate(peaks, 1):
        figures[f"dFz peak {number} (N)"] = float(low[peak])
        figures[f"dFz peak {number} at distance (mm)"] = float(axis[peak])
    along = smooth(time, forces["Fx"], cutoff) - float(forces["Fx"][settled].mean())
    figures["dFx smallest (N)"], figures["dFx largest (N)"] = float(along[over].min()), float(along[over].max())


def energy_figures(run, folder, figures):
    energy = run.results.history("energy", run.rolling)
    if "ETOTAL" not in energy:
        return
    time = energy["time"]
    figure, axes = new_axes("Energy balance of the explicit steps", "time", "energy")
    for name in sorted(set(energy) - {"time"}):
        axes.plot(time, energy[name], label=name, linewidth=2.0 if name == "ETOTAL" else 1.0)
    axes.legend(fontsize=7, ncol=2)
    save(figure, folder, "energy.png")
    scale = max(float(np.max(energy.get("ALLKE", 0.0) + energy.get("ALLIE", 0.0))), 1e-300)
    figures["greatest energy error (% of kinetic + internal)"] = 100.0 * float(np.abs(energy["ETOTAL"] - energy["ETOTAL"][0]).max()) / scale
    if "ALLAE" in energy and "ALLIE" in energy:
        ratio = energy["ALLAE"] / np.maximum(np.abs(energy["ALLIE"]), 1e-300)
        figures["greatest hourglass / internal energy (%)"] = 100.0 * float(ratio.max())


def footprint(run, folder, figures):
    """Contact pressure under the standing tyre."""
    frames = [frame for step in run.static for frame in step.frames if frame.node("CPRESS") is not None]
    if not frames or not frames[-1].node("CPRESS").any():
        return
    frame = frames[-1]
    pressure, displacement = frame.node("CPRESS"), frame.node("U")
    closed = pressure > 0
    position = (run.results.coordinates + (0.0 if displacement is None else displacement))[closed]
    figure, axes = new_axes("Contact pressure of the standing tyre", "x (mm)", "y (mm)")
    image = axes.scatter(position[:, 0], position[:, 1], c=pressure[closed], s=28, cmap="viridis", vmin=0.0)
    figure.colorbar(image, ax=axes, label="CPRESS (MPa)")
    axes.set_aspect("equal")
    save(figure, folder, "footprint.png")
    figures["footprint length (mm)"], figures["footprint width (mm)"] = np.ptp(position[:, 0]), np.ptp(position[:, 1])
    figures["greatest contact pressure (MPa)"] = float(pressure.max())


LABELS = {"LE": "largest principal logarithmic strain", "S": "Mises stress (MPa)", "U": "displacement (mm)"}


def pictures(run, folder, variable):
    """Side views while the wheel meets, crosses and leaves the obstacle, and a view from ahead on top of it."""
    steps = run.rolling or run.results.steps
    frames = [frame for step in steps for frame in step.frames if frame.node("U") is not None]
    if not frames:
        return
    if all(frames[-1].element(kind, variable) is None for kind in run.results.connectivity):
        variable = "U"
    obstacle = run.obstacle()
    if obstacle:
        along = np.array([float(run.distance(run.road_moved(frame) @ run.surface.axes[0])) for frame in frames])
        chosen = [frames[int(np.abs(along - wanted).argmin())] for wanted in (-250.0, -100.0, 0.0, 150.0)]
        top = frames[int(np.abs(along - 0.0).argmin())]
    else:
        along, chosen, top = None, [frames[0], frames[-1]], frames[-1]
    chosen = list(dict.fromkeys(chosen))
    scale = tyre_picture.colour_scale(run.results, [top], variable)
    label = LABELS.get(variable, variable)

    figure, axes = plt.subplots(1, len(chosen), figsize=(4.2 * len(chosen), 4.4), constrained_layout=True, squeeze=False)
    for place, frame in zip(axes[0], chosen):
        tyre_picture.draw(place, run.results, frame, tyre_picture.SIDE, variable, scale, run.surface, run.road_moved(frame))
        place.set_title(f"{along[frames.index(frame)]:+.0f} mm" if along is not None else f"time {frame.time:g}")
    tyre_picture.colour_bar(figure, list(axes[0]), scale, label)
    save(figure, folder, "side_views.png")

    figure, axes = plt.subplots(figsize=(8.0, 7.0), constrained_layout=True)
    tyre_picture.draw(axes, run.results, top, tyre_picture.THREE_QUARTER, variable, scale, run.surface, run.road_moved(top))
    tyre_picture.colour_bar(figure, axes, scale, label)
    save(figure, folder, "tyre.png")


def write_figures(run, folder, figures):
    lines = [f"# {run.results.name}", ""]
    for step in run.results.steps:
        lines.append(f"- {step.name} ({step.procedure}): {len(step.frames)} frames{'' if step.completed else ', not completed'}")
    lines += ["", "| figure | value |", "|---|---|"]
    lines += [f"| {name} | {value:.5g} |" for name, value in figures.items()]
    lines.append("")
    lines += [f"![{name}]({name})" for name in sorted(os.listdir(folder)) if name.endswith(".png")]
    with open(os.path.join(folder, "report.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    for name, value in figures.items():
        print(f"{name:58s} {value:12.5g}")


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results")
    parser.add_argument("--output", required=True, help="folder for plots and report.md")
    parser.add_argument("--hub", type=int, help="id of the hub's reference node (default: node set HUB)")
    parser.add_argument("--road", type=int, help="id of the road's reference node (default: node set ROAD)")
    parser.add_argument("--cutoff", type=float, default=0.3, help="low pass for curves, cycles per time unit (default 0.3: 300 Hz in ms)")
    parser.add_argument("--variable", default="LE", help="element variable that colours the pictures (default LE)")
    options = parser.parse_args(arguments)
    os.makedirs(options.output, exist_ok=True)
    run = Run(options.results, options.hub, options.road)
    figures = {}
    inflated_figures(run, figures)
    static_figures(run, options.output, figures)
    footprint(run, options.output, figures)
    rolling_figures(run, options.output, options.cutoff, figures)
    energy_figures(run, options.output, figures)
    pictures(run, options.output, options.variable)
    write_figures(run, options.output, figures)


if __name__ == "__main__":
    main(sys.argv[1:])
