"""The linear case in closed form: under a large mean force the flank is never left, and the equation is Hill's.

X'' + 2 zeta X' + k(tau) (X - 1) = F_m + F_ah Omega^2 sin(Omega tau + phi) with a staircase k is solved by one
matrix exponential a level, of the state extended by 1, sin and cos. This is Meissner's equation (1918) with forcing.
"""

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

import gearpair as gp


def period_map(osc: gp.Oscillator) -> np.ndarray:
    """The 5 x 5 matrix that takes (X, X', 1, sin, cos) over a mesh period."""
    total = np.eye(5)
    omega, force = osc.mesh_frequency, osc.error_amplitude * osc.mesh_frequency**2
    for length, k in zip(osc.stiffness.durations, osc.stiffness.levels, strict=True):
        rates = np.zeros((5, 5))
        rates[0, 1] = 1.0
        rates[1] = -k, -2.0 * osc.damping_ratio, k + osc.mean_force, force, 0.0
        rates[3, 4], rates[4, 3] = omega, -omega
        total = expm(rates * length * osc.period) @ total
    return total


def monodromy(osc: gp.Oscillator) -> np.ndarray:
    """The derivative of the period map by the state: the product of the levels' own exponentials."""
    return period_map(osc)[:2, :2]


def section_point(osc: gp.Oscillator) -> np.ndarray:
    """X and X' of the one periodic motion at the start of the mesh period."""
    whole = period_map(osc)
    forcing = whole[:2, 2:] @ [1.0, np.sin(osc.error_phase), np.cos(osc.error_phase)]
    return np.linalg.solve(np.eye(2) - whole[:2, :2], forcing)


def edge(osc: gp.Oscillator, multiplier: float, **changes: float) -> float:
    """(mu_1 - multiplier)(mu_2 - multiplier): zero where the linear motion's stability changes."""
    at = osc.replace(**changes)
    trace, determinant = np.trace(monodromy(at)), np.exp(-2.0 * at.damping_ratio * at.period)
    return float(multiplier**2 - multiplier * trace + determinant)


def edges(
    osc: gp.Oscillator, multiplier: float, parameter: str, lower: float, upper: float, n: int = 60
) -> list[float]:
    """Every value of a parameter between two others where a multiplier is 1 or -1."""

    def signed(value: float) -> float:
        return edge(osc, multiplier, **{parameter: value})

    grid = np.linspace(lower, upper, n)
    signs = np.sign([signed(value) for value in grid])
    return [brentq(signed, *grid[i : i + 2], xtol=1e-13) for i in np.flatnonzero(np.diff(signs))]
