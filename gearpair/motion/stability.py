"""Stability: Floquet multipliers, and Lyapunov exponents by the exact tangent map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_array, check_count, checked
from gearpair._flow.closed_form import TERMS
from gearpair._flow.measures import N_MEASURES
from gearpair._flow.observe import mean_damping, stretch
from gearpair.motion.trajectories import check_start, passed, raise_unless_ok
from gearpair.oscillator import Oscillator

AT_ONCE = 100_000  # mesh periods between two chances to stop


@checked
def lyapunov_exponents(
    osc: Oscillator, x: float, v: float, n_periods: int, *, n_transient: int = 500
) -> NDArray[np.float64]:
    """Both Lyapunov exponents of the motion from (x, v).

    Parameters
    ----------
    osc, x, v, n_transient
        As in `trajectory`; the same errors are raised.
    n_periods : int
        Base periods to average over, at least 1, after as many in which the tangent turns to where it grows most.

    Returns
    -------
    ndarray of float, shape (2,)
        Per unit tau, descending. Their sum is ``-2 zeta``, since ``det M = exp(-2 zeta T)`` exactly; where free flight
        has another damping ratio, -2 times the mean of the two over time.

    Notes
    -----
    The tangent map is orthonormalised once a mesh period (Benettin and others, 1980).

    Examples
    --------
    >>> pair = lyapunov_exponents(Oscillator(mesh_frequency=1.219), 1.0, 0.0, 2000)
    >>> bool(pair[0] > 0.05), bool(abs(pair.sum() + 0.04) < 1e-12)
    (True, True)
    """
    x, v = check_start(x, v)
    n_periods = check_count("n_periods", n_periods)
    n_transient = check_count("n_transient", n_transient, at_least=0)
    x, v = passed(osc, x, v, n_transient)
    q, series, reach = np.eye(2), np.empty(TERMS), np.array([x, x, 0.0, 0.0])
    at_once, even = max(1, AT_ONCE // osc.mesh_periods), osc.damping_in_flight == osc.damping_ratio
    for _ in range(2):  # to turn the tangent, then to measure
        growth = damping = 0.0
        for done in range(0, n_periods, at_once):
            span = min(at_once, n_periods - done)
            mean = osc.damping_ratio if even else mean_damping(osc.cells, x, v, span, series, np.empty(N_MEASURES))
            damping += (mean - damping) * (span / (done + span))
            status, x, v, total = stretch(osc.cells, x, v, span, series, q, reach)
            raise_unless_ok(status, (n_transient + n_periods) * osc.mesh_periods)
            growth += total
    largest = growth / (n_periods * osc.period)
    return np.array([largest, -2.0 * damping - largest])


@checked
def multipliers_of(monodromy: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Eigenvalues of 2 x 2 matrices, shape (..., 2, 2), the largest modulus first (then the larger imaginary part).

    Examples
    --------
    >>> multipliers_of(np.array([[0.0, -0.25], [1.0, 0.0]])).tolist()
    [0.5j, -0.5j]
    """
    monodromy = check_array("monodromy", monodromy, finite=False)
    if monodromy.shape[-2:] != (2, 2):
        raise ValueError(f"monodromy must be matrices of shape (..., 2, 2), got shape {monodromy.shape}")
    half = 0.5 * (monodromy[..., 0, 0] + monodromy[..., 1, 1])
    determinant = monodromy[..., 0, 0] * monodromy[..., 1, 1] - monodromy[..., 0, 1] * monodromy[..., 1, 0]
    root = np.sqrt(half * half - determinant + 0j)
    real = root.real > 0.0  # of a pair on the real line, the smaller is taken from the product: no digits cancel
    first = half + np.where(real & (half < 0.0), -1.0, 1.0) * root
    second = np.divide(determinant, first, out=np.asarray(half - root), where=real)
    return np.stack([first, second], axis=-1)
