"""Lyapunov exponents of a motion, from a direction that its variational flow turns; with the range of X it covers."""

import numpy as np

from ._kernel import allocating_kernel, kernel
from .march import OK
from .observe import widen


@kernel
def stretch(cells, x, v, n_periods, low, high, q, series):
    """`widen`, turning the first column of `q` (2, 2) with the flow: (status, x, v, low, high, log of its growth)."""
    status, total = OK, 0.0
    for _ in range(n_periods):
        status, x, v, low, high, _drive, _coast = widen(cells, x, v, 1, low, high, series, q)
        if status != OK:
            break
        length = np.hypot(q[0, 0], q[1, 0])
        q[0, 0], q[1, 0] = q[0, 0] / length, q[1, 0] / length
        q[0, 1], q[1, 1] = -q[1, 0], q[0, 0]
        total += np.log(length)
    return status, x, v, low, high, total


@allocating_kernel
def exponents(cells, x, v, n_periods, blocks, series):
    """Lyapunov exponents: (status, x, v, largest, smallest, standard error, x_min, x_max).

    Per unit tau, the largest first. The smallest follows from Liouville's formula, the sum being -2 zeta; from
    the matrices it would lose all digits where damping is strong. The error is that of the mean over
    `blocks` equal parts of the span.
    """
    q = np.eye(2)
    per_block = max(1, n_periods // blocks)
    # One block first, uncounted, to turn the first direction into the most unstable one.
    status, x, v, low, high, _total = stretch(cells, x, v, per_block, x, x, q, series)
    mean, spread = 0.0, 0.0
    for block in range(blocks):
        status, x, v, low, high, total = stretch(cells, x, v, per_block, low, high, q, series)
        if status != OK:
            return status, x, v, np.nan, np.nan, np.nan, low, high
        rate = total / (per_block * cells.period)
        delta = rate - mean
        mean += delta / (block + 1)
        spread += delta * (rate - mean)
    error = np.sqrt(spread / max(1, blocks - 1) / blocks)
    return OK, x, v, mean, -2.0 * cells.damping_ratio - mean, error, low, high
