"""When wheels are off the road, what it carries below them, how a fall ends and how near the body comes to the road."""

import numpy as np

from car_figures import WHEELS, words

GRAVITY = 9.81e-3  # mm/ms2
TOUCH = 1.0  # N below which a wheel is in the air


def carried(step, wheel):
    """Times, and what the road carries below a wheel, N."""
    name = next(name for name in step.histories() if name.startswith(f"contact_TREAD_{wheel}"))
    history = step.history(name)
    return history["time"] - step.time_start, np.abs(history["CFN"][:, 2])


def flights(time, force):
    """Spans of time (start, end) in which nothing is carried; one that has not ended ends with the times."""
    free = np.concatenate([[False], force < TOUCH, [False]]).astype(int)
    starts, ends = np.flatnonzero(np.diff(free) > 0), np.flatnonzero(np.diff(free) < 0)
    return [(float(time[start]), float(time[min(end, len(time) - 1)])) for start, end in zip(starts, ends)]


def rows(step):
    """Rows of a table: wheel, at most carried, how often and how long it was off the road, carried at the end."""
    found = []
    for wheel in WHEELS:
        time, force = carried(step, wheel)
        spans = flights(time, force)
        longest = max(spans, key=lambda span: span[1] - span[0], default=None)
        away = "never" if longest is None else f"{len(spans)}, the longest from {longest[0]:.0f} to {longest[1]:.0f} ms"
        found.append((words(wheel), float(force.max()), f"{time[np.argmax(force)]:.1f}", away, float(force[-1])))
    return found


def clearance(results, step):
    """Least height of the sheets of the car above the level road over the frames, mm, and when."""
    sheets = np.unique(np.concatenate([nodes.ravel() for kind, nodes in results.connectivity.items() if kind in ("S4R", "S3R")]))
    road, level = results.node_sets["ROAD_LEFT"][0], results.surfaces["ROAD_LEFT_SURFACE"].origin[2]
    lowest = []
    for frame in step.frames:
        moved = frame.node("U")[:, 2].astype(float)
        lowest.append((float((results.coordinates[sheets, 2] + moved[sheets]).min()) - level - moved[road], frame.step_time))
    return min(lowest)


class Landing:
    """The first touch of a fall."""

    def __init__(self, results, step):
        touched = {}
        for wheel in WHEELS:
            time, force = carried(step, wheel)
            if (force > TOUCH).any():
                touched[wheel] = float(time[np.argmax(force > TOUCH)])
        self.wheel = min(touched, key=touched.get, default=None)
        if self.wheel is None:
            return
        self.time = touched[self.wheel]
        hub = step.history(f"node_{results.reference_id('HUB_' + self.wheel)}")
        self.speed = -float(np.interp(self.time, hub["time"] - step.time_start, hub["V"][:, 2]))
        self.height = self.speed**2 / (2.0 * GRAVITY)

    def words(self):
        if self.wheel is None:
            return "The car falls on a flat road; the job ends before a wheel touches it."
        if self.time == 0.0:
            return "The road is flat; the car is on it from the start."
        return (f"The car falls on a flat road. The first wheel, {words(self.wheel)}, touches it after {self.time:.1f} ms, at "
                f"{self.speed:.2f} m/s: that of a fall by {self.height:.0f} mm.")
