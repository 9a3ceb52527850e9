"""The 0-1 test for chaos: a second opinion where a Lyapunov exponent is within its uncertainty of zero."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_array, check_count, checked

FEWEST = 200  # values below which the test says little


@checked
def zero_one_test(values: ArrayLike, n_frequencies: int = 100) -> float:
    """The 0-1 test's growth rate K of a series, from -1 to 1: near 1 for chaos, near 0 for regular motion.

    The series, less its mean, drives a walk in the plane, ``p(n) + i q(n) = sum of values[j] exp(i j c)``. Chaos
    makes it diffuse: its mean square displacement grows in proportion to n; a regular series keeps it bounded.

    Parameters
    ----------
    values : array_like of float, shape (n,)
        Successive section points of one coordinate, at least 200; not oversampled.
    n_frequencies : int
        Frequencies c, spread evenly over (pi/5, 4 pi/5); K is the median over them.

    Notes
    -----
    Gottwald and Melbourne (2009), "On the implementation of the 0-1 test for chaos": the mean square displacement
    up to a tenth of the series, and their correlation method.

    Examples
    --------
    >>> from gearpair import Oscillator, sweep
    >>> two = sweep(Oscillator(), "mesh_frequency", [0.7, 1.219], n_samples=2000)
    >>> [bool(zero_one_test(x) > 0.5) for x in two.x.values]
    [False, True]
    """
    series = check_array("values", values)
    check_count("n_frequencies", n_frequencies)
    if series.ndim != 1 or series.size < FEWEST:
        raise ValueError(f"values must be a sequence of at least {FEWEST} numbers, got shape {series.shape}")
    series = series - series.mean()
    n, cut = series.size, series.size // 10
    # Golden steps, so that no frequency is a low-order resonance of a periodic series.
    shares = np.mod(0.5 + np.arange(1, n_frequencies + 1) * 0.6180339887498949, 1.0)
    frequencies = np.pi * (0.2 + 0.6 * shares)
    lags = np.arange(1, cut + 1)
    rates = []
    for c in frequencies:
        walk = np.cumsum(series * np.exp(1j * c * np.arange(1, n + 1)))
        squares = np.array([np.mean(np.abs(walk[lag : n - cut + lag] - walk[: n - cut]) ** 2) for lag in lags])
        if squares.max() <= 0.0:
            rates.append(0.0)
            continue
        # Without its mean the series leaves no oscillating term to subtract.
        rates.append(float(np.corrcoef(lags, squares)[0, 1]))
    return float(np.median(rates))
