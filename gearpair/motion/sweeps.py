"""The settled motion along one parameter, or over a grid of several: the numbers of diagrams and maps."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_choice
from gearpair.motion.datasets import attributes, dataset, oscillators_along, settled_variables
from gearpair.motion.settling import SettleSettings, settle_lanes
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr


def sweep(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    x: float = 1.0,
    v: float = 0.0,
    seeding: Literal["carry", "restart"] = "carry",
    n_transient: int | None = None,
    max_period: int = 64,
    n_exponent: int = 2000,
    n_samples: int = 128,
    progress: bool = False,
) -> xr.Dataset:
    """The settled motion at each value of one parameter.

    Parameters
    ----------
    osc : Oscillator
    parameter : str
        One of ``osc.parameters``.
    values : array_like of float, shape (n,)
        Visited in the order given, which is the direction of the sweep.
    x, v : float
        The start: of the first value when carrying, of every value when restarting.
    seeding : {"carry", "restart"}
        ``"carry"`` starts each value where the one before it ended, as an experiment does;
        ``"restart"`` starts each from (x, v), in parallel over the cores.
    n_transient, max_period, n_exponent
        As in `steady_state`.
    n_samples : int
        Section points kept per value; at least `max_period` are.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        Dimensions ``(parameter, sample)``: ``x, v`` on the section, and per value ``status``, ``period``,
        ``impact_state``, ``x_min``, ``x_max``, ``exponent`` and ``exponent_error``.

    Raises
    ------
    ValueError
        For an unknown parameter, a value out of range, or no values.

    Examples
    --------
    >>> diagram = sweep(Oscillator(), "mesh_frequency", [1.65, 1.7], seeding="restart")
    >>> dict(diagram.sizes)
    {'mesh_frequency': 2, 'sample': 128}
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    check_choice("seeding", seeding, ("carry", "restart"))
    settings = SettleSettings(
        n_transient=n_transient, max_period=max_period, n_exponent=n_exponent, n_samples=max(n_samples, max_period)
    )
    starts = np.broadcast_to(check_start(x, v), (len(oscillators), 2))
    out = settle_lanes(
        oscillators, starts, settings, chain=len(oscillators) if seeding == "carry" else 1, progress=progress
    )
    variables = settled_variables(out, (parameter,), (len(checked),))
    for i, name in enumerate(("x", "v")):
        variables[name] = ((parameter, "sample"), out.points[:, :, i], attributes(name))
    return dataset(osc, variables, {parameter: checked}, seeding=seeding)


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
    return dataset(osc, settled_variables(out, tuple(checked), shape), checked)
