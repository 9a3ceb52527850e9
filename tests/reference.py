"""Independent references for the exact flow: nothing here is shared with `gearpair._flow`.

`dop853_period` integrates each linear piece by DOP853 and restarts at every event. `Reference`
solves each linear piece in closed form with 50 digits (matrix exponential through the characteristic roots,
which 50 digits make harmless near their degeneracies) and finds events by dense sampling and bisection.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

import gearpair as gp
from gearpair._flow.cells import Parameters


def kernel_parameters(osc: gp.Oscillator) -> Parameters:
    """What the kernels take, built by hand."""
    scalars = (osc.mean_force, osc.error_amplitude, osc.error_phase, osc.damping_ratio, osc.mesh_frequency)
    return Parameters(*scalars, np.array([*osc.stiffness.edges, 1.0]), np.array(osc.stiffness.levels))


def right_hand_side(osc: gp.Oscillator):
    """(tau, (X, X')) -> (X', X'') written from the article's equation."""

    def slope(tau, y):
        x, v = y
        gap = x - 1.0 if x > 1.0 else x + 1.0 if x < -1.0 else 0.0
        force = osc.mean_force + osc.error_amplitude * osc.mesh_frequency**2 * np.sin(
            osc.mesh_frequency * tau + osc.error_phase
        )
        return v, force - 2.0 * osc.damping_ratio * v - float(osc.stiffness(tau / osc.period)) * gap

    return slope
