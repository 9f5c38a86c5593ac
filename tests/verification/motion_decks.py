"""What decks of explicit motions have in common, and fine integrations to compare them with."""
import numpy as np

G = 9.81


def integrate(derivative, state, times):
    """Runge and Kutta's method in steps far shorter than the sampled times."""
    states, substeps = [np.array(state, float)], 20
    for before, after in zip(times[:-1], times[1:]):
        x, h = states[-1], (after - before) / substeps
        for _ in range(substeps):
            k1 = derivative(x)
            k2 = derivative(x + 0.5 * h * k1)
            k3 = derivative(x + 0.5 * h * k2)
            k4 = derivative(x + h * k3)
            x = x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        states.append(x)
    return np.array(states)


def history(nodes, variables, interval):
    return f"""*OUTPUT, HISTORY, TIME INTERVAL={interval}
*NODE OUTPUT, NSET={nodes}
{variables}
*ENERGY OUTPUT
ALLKE, ALLIE, ALLWK, ETOTAL
"""


def explicit_step(increment, duration, loads, output):
    return f"""*STEP
*DYNAMIC, EXPLICIT, DIRECT USER CONTROL
{increment}, {duration}
*BULK VISCOSITY
0., 0.
{loads}{output}*END STEP
"""


GRAVITY = f"*DLOAD\n, GRAV, {G}, 0., -1., 0.\n"
