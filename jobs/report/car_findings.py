"""What a drive shows, measured as the paper tells it: where the obstacle lies, peaks, ringing, stress; the paper's words beside."""

import numpy as np

import car_figures
import car_flights
import car_loads
from report import smooth

YIELD = 320.0  # MPa of the high-strength steel
CUTOFF = 0.15  # kHz: peaks as far apart as the bar is long stay at 50 km/h, the noise of treads goes


def unevenness(surface):
    """Where along its profile a road is not level; nowhere: the car falls on it."""
    along, height = surface.profile.T
    return along[np.abs(height - height[0]) > 1e-6 * np.ptp(along)]


def course(results):
    """What a drive meets."""
    return Obstacle(results) if len(unevenness(results.surfaces["ROAD_LEFT_SURFACE"])) else Drop()


class Drop:
    """A flat road, onto which the car falls: time stands for the distance from an obstacle."""

    drop, hole = True, False
    label = "since the start, s"
    measure = "time"

    def distances(self, columns):
        return {name: columns["time"] for name, _, _ in car_loads.FORCES}


class Obstacle:
    """What the left road has: a bump (its distances count from its middle) or a hole (from the edge where its ramp begins)."""

    drop = False
    label = "wheel's centre from the obstacle, m"
    measure = "the distance of its wheel from the obstacle"

    def __init__(self, results):
        surface = results.surfaces["ROAD_LEFT_SURFACE"]
        along, height = surface.profile.T
        uneven = unevenness(surface)
        self.height = float(height[np.argmax(np.abs(height - height[0]))] - height[0])
        self.hole = self.height < 0.0
        self.start, self.end = float(uneven.min()), float(uneven.max())
        self.behind = self.end - self.start if self.hole else 0.5 * (self.end - self.start)  # distance at which it ends
        self.origin = float(surface.origin[0]) + (self.start if self.hole else 0.5 * (self.start + self.end))
        at = lambda wheel: results.coordinates[results.node_sets["HUB_" + wheel][0]][0]
        self.wheels = {axle: float(at(axle + "_LEFT")) for axle in ("FRONT", "REAR")}

    def words(self):
        length = self.end - self.start
        if self.hole:
            return (f"A pothole {-self.height:.0f} mm deep and {length:.0f} mm long between its edges, below the left wheels; "
                    "distances count from where its ramp begins.")
        return (f"A bar {self.height:.0f} mm high and {length:.0f} mm long with its fillets, below both sides; distances count "
                "from its middle.")

    def distances(self, columns):
        """How far each wheel's centre is behind the obstacle (negative: before it), and the mounts above with their wheels."""
        axle = lambda name: self.wheels["FRONT" if "_front_" in name else "REAR"]
        return {name: columns["road_travel"] + axle(name) - self.origin for name, _, _ in car_loads.FORCES}


def peaks(values, static):
    """Maxima above the static load that stand out by a tenth of it, in their order."""
    def stands_out(at):
        """By how much one has to descend from there before one can climb higher."""
        higher = np.flatnonzero(values > values[at])
        before, after = higher[higher < at], higher[higher > at]
        start, end = before[-1] + 1 if len(before) else 0, after[0] if len(after) else len(values)
        return values[at] - max(values[start:at + 1].min(), values[at:end].min())

    crests = np.flatnonzero((values[1:-1] > values[:-2]) & (values[1:-1] >= values[2:]) & (values[1:-1] > static)) + 1
    return np.array([values[at] for at in crests if stands_out(at) > 0.1 * static])


def ringing(time, force, distance, clear=400.0, length=2000.0):
    """Of a force behind the obstacle: half its swing, and the frequency at which it has most, Hz."""
    behind = (distance > clear) & (distance < clear + length)
    if behind.sum() < 32:
        return None
    rest = force[behind] - force[behind].mean()
    spectrum = np.abs(np.fft.rfft(rest * np.hanning(len(rest)), 8 * len(rest)))
    return 0.5 * float(np.ptp(rest)), 1000.0 * float(np.fft.rfftfreq(8 * len(rest), time[1] - time[0])[np.argmax(spectrum)])


def stress_over(drive, step, wanted, rigid):
    """Largest Mises stress and plastic strain of parts over the frames of a drive, in words."""
    if rigid:
        return "these parts are rigid in this job: no stress; drive the semi-flexible car"
    found = [values for frame in step.frames if (values := car_figures.stress_of(drive, frame, wanted)) is not None]
    if not found:
        return "the results hold no stress of these parts"
    stress, strain = (max(float(values[kind].max()) for values in found) for kind in (1, 2))
    return f"largest Mises stress {stress:.0f} MPa, plastic strain {strain:.2g}"


def blow(columns, away, wheel):
    """Largest vertical and longitudinal force of a wheel's centre in the hole, below the cutoff and in all, in words."""
    if away[wheel].max() < 0.0:
        return "not reached in this drive"
    near = away[wheel] > -300.0
    forces = [columns[f"{wheel}_{component}"] for component in ("Fz", "Fx")]
    below, at_most = ([float(np.abs(force[near]).max()) / 1e3 for force in found]
                      for found in ([smooth(columns["time"], force, CUTOFF) for force in forces], forces))
    return f"below 150 Hz {below[0]:.1f} and {below[1]:.1f} kN; at most {at_most[0]:.1f} and {at_most[1]:.1f} kN"


def squeezed(columns, member, travel, load):
    """How far a strut or damper is pushed together from where it stands, with what it then carries, in words."""
    way, force = columns[travel], columns[load]
    at = int(np.argmin(way))
    return (f"the {member} is pushed {way[0] - way[at]:.0f} mm together from where it stands and carries {np.abs(force).max() / 1e3:.1f} kN: "
            "its bump stop, a curve of this class, is driven home")


def compare(obstacle, columns, away, drive, step, fidelity):
    """Rows: what; the paper; Balocco; why they differ, where they do."""
    wheel, mount = "wheel_centre_front_left", "strut_mount_front_left"
    static, time = float(columns[f"{wheel}_Fz"][0]), columns["time"]
    rows = [("static load of a front wheel's centre", "about 4000 N on the road", f"{static:.0f} N",
             "a lighter front than the paper's car; the road also carries the wheel itself")]
    near = np.abs(away[wheel]) < 300.0 if not obstacle.hole else away[wheel] > -300.0  # the tyre's radius
    if not near.any() or away[wheel].max() < 0.0:
        return rows + [("obstacle", "crossed", "not reached in this drive", "")]
    up, along = columns[f"{wheel}_Fz"], columns[f"{wheel}_Fx"]
    house, frame = (stress_over(drive, step, (part,), fidelity == "rigid") for part in ("STRUT_HOUSE", "SUBFRAME"))
    highest = float(up[near].max())
    if not obstacle.hole:
        crests = peaks(smooth(time, up, CUTOFF)[near], static)
        heights = ", ".join(f"{crest:.0f}" for crest in crests)
        rows.append(("vertical force over the obstacle", "two peaks",
                     f"{len(crests)} below 150 Hz: {heights} N; at most {highest:.0f} N", ""))
        rang = ringing(time, along, away[wheel])
        over = f"over the obstacle {along[near].min():.0f} to {along[near].max():.0f} N"
        rows.append(("longitudinal force behind it", "rings on, more than in the multibody model",
                     over if rang is None else f"{over}; then swings by {rang[0]:.0f} N, mostly at {rang[1]:.0f} Hz", ""))
        rows.append(("stress of the strut houses", f"below the yield stress of {YIELD:.0f} MPa, no plasticity", house, ""))
        rows.append(("stress of the subframe", "as above", frame, ""))
        return rows
    filtered = float(smooth(time, up, CUTOFF)[near].max())
    strut = squeezed(columns, "strut", "strut_front_left_travel", "strut_front_left_force")
    rows += [("peaks of vertical and longitudinal force", "about equal, 24 kN", blow(columns, away, wheel),
              "what is above 150 Hz is the rim striking through the tyre: how a peak is filtered decides its height"),
             ("the same two of the left rear wheel", "", blow(columns, away, "wheel_centre_rear_left"),
              "not told by the paper: " + squeezed(columns, "rear damper", "damper_rear_left_travel", "damper_rear_left_force")),
             ("front peak over static load", "six", f"{filtered / static:.1f} below 150 Hz, {highest / static:.1f} at most",
              "the static load is the smaller here"),
             ("vertical peak at the strut mount", "10.5 kN", f"{columns[mount + '_Fz'][near].max() / 1e3:.1f} kN", strut),
             ("strut mount", "yields", house, ""), ("subframe", "", frame, "")]
    return rows


def of_drop(columns, drive, step, fidelity):
    """Rows of what a fall does: what; how much, of the harder struck side."""
    kilonewtons = lambda names: f"{max(float(np.abs(columns[name]).max()) for name in names) / 1e3:.1f} kN"
    rows = [(f"vertical force at the {place.replace('_', ' ')}", kilonewtons([f"{place}_{side}_Fz" for side in ("left", "right")]))
            for place in ("wheel_centre_front", "wheel_centre_rear", "strut_mount_front")]
    for part in ("strut_front", "damper_rear"):
        travel = min(float(columns[f"{part}_{side}_travel"].min()) for side in ("left", "right"))
        rows.append((f"{part.replace('_', ' ')}", f"{-travel:.0f} mm shorter than as drawn, with "
                     f"{kilonewtons([f'{part}_{side}_force' for side in ('left', 'right')])}"))
    height, time = car_flights.clearance(drive, step)
    rows.append(("lowest sheet of the car above the road", f"{height:.0f} mm at {time:.0f} ms" +
                 ("" if height > 0.0 else ": it would strike the road, which touches tyres alone here")))
    for title, part in (("strut houses", "STRUT_HOUSE"), ("subframe", "SUBFRAME")):
        rows.append((title, stress_over(drive, step, (part,), fidelity == "rigid")))
    return rows
