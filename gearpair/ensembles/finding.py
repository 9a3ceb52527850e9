"""The motions of one oscillator looked for, from random starts or given ones."""

from __future__ import annotations

from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_reach, checked
from gearpair.ensembles.labelling import Attractors, surveyed
from gearpair.motion.settling import MANY, SettleOptions
from gearpair.oscillator import Oscillator


@checked
def attractors(
    osc: Oscillator,
    n: int = 500,
    *,
    x_reach: tuple[float, float] = (-4.0, 4.0),
    v_reach: tuple[float, float] = (-3.0, 3.0),
    seed: int = 0,
    starts: ArrayLike | None = None,
    progress: bool = False,
    **settling: Unpack[SettleOptions],
) -> Attractors:
    """The motions that random starts settle on, found once: numbered, and ready to label any other start.

    Parameters
    ----------
    osc : Oscillator
    n, x_reach, v_reach, seed
        The starts, as in `gearpair.ensembles.basin_stability`.
    starts : array_like of float, shape (n, 2), optional
        X and X' of other starts, in place of these.
    progress : bool
        Show a progress bar on stderr.
    **settling
        See `gearpair.motion.SettleOptions`.

    Returns
    -------
    Attractors
        Numbered as by `gearpair.basins`: periodic ones first, by period and X; then chaotic sets that no motion has
        left; then all unsettled motions as one. A motion that few starts lead to may be missed:
        `Attractors.label` tells -1 of these, and `Attractors.including` takes them in.

    Examples
    --------
    >>> found = attractors(Oscillator(mesh_frequency=1.219), 50)
    >>> found.numbers, [str(motion.motion.kind) for motion in found]
    ((0, 1), ['period 2', 'chaos'])
    """
    if starts is None:
        pairs = random_starts(check_count("n", n), x_reach, v_reach, seed)
    else:
        pairs = check_array("starts", starts)
        if pairs.ndim != 2 or pairs.shape[1] != 2 or not len(pairs):
            raise ValueError(f"starts must be pairs of finite numbers, one at least, got shape {pairs.shape}")
    return surveyed(osc, pairs, MANY.having(settling), progress=progress)


def random_starts(n: int, x_reach: tuple[float, float], v_reach: tuple[float, float], seed: int) -> NDArray[np.float64]:
    """Starts (n, 2) drawn evenly from a rectangle, or a ValueError that says what is wrong with it."""
    (x_low, x_high), (v_low, v_high) = check_reach("x_reach", x_reach), check_reach("v_reach", v_reach)
    generator = np.random.default_rng(check_count("seed", seed, at_least=0))
    return generator.uniform((x_low, v_low), (x_high, v_high), (n, 2))
