"""The settled motion over a grid of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gearpair.batches import SettleSettings, settle_lanes
from gearpair.motion import check_start
from gearpair.oscillator import Oscillator
from gearpair.sweeps import attributes, oscillators_along, settled_variables

if TYPE_CHECKING:
    import xarray as xr


def parameter_map(
    osc: Oscillator,
    axes: Mapping[str, ArrayLike],
    *,
    x: float = 1.0,
    v: float = 0.0,
    n_transient: int | None = None,
    max_period: int = 64,
    n_exponent: int = 500,
    progress: bool = False,
) -> xr.Dataset:
    """The settled motion from one start at every point of a grid of parameters, in parallel over the cores.

    Parameters
    ----------
    osc : Oscillator
    axes : mapping of str to array_like of float
        Parameter names (of ``osc.parameters``) and their values, one or more.
    x, v : float
        The start, the same everywhere.
    n_transient, max_period, n_exponent
        As in `steady_state`.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        The axes are its dimensions, in their order; variables ``status``, ``period``, ``impact_state``,
        ``x_min``, ``x_max``, ``exponent``, ``exponent_error``.

    Raises
    ------
    ValueError
        For no axes, an unknown parameter, or a value out of range.

    Examples
    --------
    >>> grid = parameter_map(Oscillator(), {"mesh_frequency": [0.6, 0.7], "damping_ratio": [0.1]})
    >>> grid.period.values.tolist()
    [[1], [1]]
    """
    if not axes:
        raise ValueError("axes must name at least one parameter and its values, got none")
    checked = {name: oscillators_along(osc, name, values)[1] for name, values in axes.items()}
    shape = tuple(len(values) for values in checked.values())
    oscillators = [osc.replace(**dict(zip(checked, point, strict=True))) for point in product(*checked.values())]
    settings = SettleSettings(n_transient=n_transient, max_period=max_period, n_exponent=n_exponent, n_samples=1)
    starts = np.broadcast_to(check_start(x, v), (len(oscillators), 2))
    out = settle_lanes(oscillators, starts, settings, progress=progress)
    import xarray as xr  # here, so that importing gearpair stays quick

    return xr.Dataset(
        settled_variables(out, tuple(checked), shape),
        {name: (name, values, attributes(name)) for name, values in checked.items()},
        {"oscillator": repr(osc)},
    )
