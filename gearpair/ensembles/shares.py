"""The shares of many starts that each motion takes: of starts drawn at random, and of a grid along a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_count, checked
from gearpair.ensembles.capture import known_attractors, numbered, scouts
from gearpair.ensembles.datasets import dataset, oscillators_along, settled_columns, with_numbers
from gearpair.ensembles.finding import random_starts
from gearpair.ensembles.labelling import Attractors, known_of, numbers_of
from gearpair.ensembles.planes import attractor_variables, basins
from gearpair.motion.names import motions_of
from gearpair.motion.settling import MANY, BatchOptions, SettleOptions, settle_batch
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr


@checked
def basin_stability(
    osc: Oscillator,
    n: int = 1000,
    *,
    x_reach: tuple[float, float] = (-4.0, 4.0),
    v_reach: tuple[float, float] = (-3.0, 3.0),
    seed: int = 0,
    attractors: Attractors | None = None,
    **settling: Unpack[SettleOptions],
) -> xr.Dataset:
    """The share of random starts that each attractor takes, with its standard error.

    Parameters
    ----------
    osc : Oscillator
    n : int
        Starts, drawn evenly from the rectangle.
    x_reach, v_reach : (float, float)
        Smallest and largest X and X' of the rectangle.
    seed : int
        Of the random numbers: the same seed draws the same starts.
    attractors : Attractors, optional
        Found before, as for `basins`.
    **settling
        See `gearpair.motion.SettleOptions`.

    Returns
    -------
    xarray.Dataset
        Over ``attractor_number`` as of `basins`, with ``attractor_share_error`` besides.

    Notes
    -----
    Menck, Heitzig, Marwan and Kurths (2013). Each start is a Bernoulli trial, so a share S has the standard error
    ``sqrt(S (1 - S) / n)``, whatever the shape of the basin.

    Examples
    --------
    >>> stability = basin_stability(Oscillator(), 400)
    >>> bool(abs(stability.attractor_share[0] - 0.5) < 4 * stability.attractor_share_error[0])
    True
    """
    n = check_count("n", n)
    starts = random_starts(n, x_reach, v_reach, seed)
    settings = MANY.having(settling)
    if attractors is None:
        known, before = known_attractors(osc, starts[scouts(n)], settings), None
    else:
        known, before = known_of(attractors, osc, settings), numbers_of(attractors)
    out = settle_batch([osc], starts, settings, known=known)
    table = numbered(settled_columns(out), settings.before_watch(osc), known.lasting, before).table
    return with_numbers(dataset(osc, attractor_variables(table, n, errors=True), {}, n=n))


@checked
def motion_shares(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    x: ArrayLike,
    v: ArrayLike,
    **settling: Unpack[BatchOptions],
) -> xr.Dataset:
    """Along one parameter, the share of a grid of starts that reaches each kind of motion.

    Parameters
    ----------
    osc, parameter, values
        As in `gearpair.sweep`.
    x, v, **settling
        The grid of starts, as for `gearpair.basins`.

    Returns
    -------
    xarray.Dataset
        ``share`` over ``(parameter, motion)``; each motion by its name, with its ``status`` and ``period``: periodic
        ones first, by period.

    Examples
    --------
    >>> shares = motion_shares(Oscillator(), "damping_ratio", [0.1, 0.2], [0.0, 1.0], [0.0])
    >>> shares.share.values.tolist()
    [[1.0], [1.0]]
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    planes = [motions_of(basins(each, x, v, **settling)) for each in oscillators]
    motions = sorted({motion for plane in planes for motion in plane.ravel()})
    share = [[float(np.mean(plane == motion)) for motion in motions] for plane in planes]
    columns = {
        "share": ((parameter, "motion"), share, attributes("share")),
        "status": ("motion", [str(motion.status) for motion in motions], attributes("status")),
        "period": ("motion", [motion.period or 0 for motion in motions], attributes("period")),
    }
    result = dataset(osc, columns, {parameter: checked})
    return result.assign_coords(motion=[str(motion) for motion in motions])
