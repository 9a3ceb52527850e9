"""Maps over two parameters by motion, impact and measure, and the shares of the attractors along one."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize, to_rgb

from gearpair.motion.names import Motion, motions_of
from gearpair.plotting.planes import IMPACT_COLOURS, impact_colours, name_colours
from gearpair.plotting.style import add_motion_legend, motion_colour, new_axes, over_parameter
from gearpair.quantities import axis_label


def impact_map(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """The impact state at each point of a grid of two parameters, the harsher the darker.

    One image whose pixels are the grid's points.

    Parameters
    ----------
    result : xarray.Dataset
        As for `period_map`.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = impact_map(gp.parameter_map(gp.Oscillator(), {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7]}))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['no impact', 'single-sided']
    """
    states = result.impact_state.values
    ax = _image(result, _pixels(states, IMPACT_COLOURS), ax)
    if legend:
        name_colours(ax, impact_colours(states))
    return ax


def period_map(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """The motion at each point of a grid of two parameters, in the colours of all figures.

    One image whose pixels are the grid's points.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.parameter_map` with two axes, evenly spaced: the first is drawn upwards, the second to the right.

    Raises
    ------
    ValueError
        For a map with another number of axes.

    Examples
    --------
    >>> import gearpair as gp
    >>> grid = gp.parameter_map(gp.Oscillator(), {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7, 0.8]})
    >>> period_map(grid).images[0].get_size()
    (2, 3)
    """
    motions = motions_of(result)
    present = set(motions.ravel())
    ax = _image(result, _pixels(motions, {motion: motion_colour(motion) for motion in present}), ax)
    if legend:
        add_motion_legend(ax, present)
    return ax


def quantity_map(
    result: xr.Dataset,
    quantity: str,
    ax: Axes | None = None,
    *,
    largest: float | None = None,
    logarithmic: bool = False,
) -> Axes:
    """A quantity of the motion at each point of a grid of two parameters: dark where it is small.

    A colour bar beside it.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.parameter_map` with two axes (or of `gearpair.basins`), evenly spaced.
    quantity : str
        One of its variables.
    largest : float, optional
        Where the colours end; the largest value when not given.
    logarithmic : bool
        Spread the colours over the logarithm.

    Examples
    --------
    >>> import gearpair as gp
    >>> axes = {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7]}
    >>> ax = quantity_map(gp.parameter_map(gp.Oscillator(), axes, measures=True), "load_factor")
    >>> ax.figure.axes[1].get_ylabel()
    'dynamic load factor'
    """
    values = result[quantity].values
    top = float(np.nanmax(values)) if largest is None else largest
    low = float(np.nanmin(values[values > 0.0])) if logarithmic else float(np.nanmin(values))
    ax = _image(result, values, ax, norm=(LogNorm if logarithmic else Normalize)(low, top), cmap="cividis")
    beyond = "max" if np.nanmax(values) > top else "neither"
    ax.figure.colorbar(ax.images[0], ax=ax, label=axis_label(quantity), pad=0.01, extend=beyond)
    return ax


def _pixels(values: np.ndarray, colours: Mapping[Any, str]) -> np.ndarray:
    pixels = np.zeros((*values.shape, 3))
    for value, colour in colours.items():
        pixels[values == value] = to_rgb(colour)
    return pixels


def _image(result: xr.Dataset, pixels: np.ndarray, ax: Axes | None, **colours: Any) -> Axes:
    dims = [str(dim) for dim in result.status.dims]
    if len(dims) != 2:
        raise ValueError(f"result must be a map over two parameters, got {len(dims)}: {', '.join(dims)}")
    ax = new_axes(ax, 4.6)
    vertical, horizontal = dims
    (left, right), (low, high) = (_ends(result[name].values) for name in (horizontal, vertical))
    extent = (left, right, low, high)
    ax.imshow(pixels, origin="lower", extent=extent, aspect="auto", interpolation="nearest", **colours)
    names = ("start_v", "start_x") if dims == ["v", "x"] else dims
    ax.set(xlabel=axis_label(names[1]), ylabel=axis_label(names[0]))
    return ax


def _ends(values: np.ndarray) -> tuple[float, float]:
    """Half a step beyond the first and the last of evenly spaced values."""
    half = 0.5 * (values[-1] - values[0]) / max(len(values) - 1, 1)
    return values[0] - half, values[-1] + half


def attractor_shares(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """The shares of the attractors along a parameter, stacked, with a triangle at each tipping point.

    One filled step for each attractor, cut where its kind of motion changes and coloured by it, and a triangle at
    the top where one has tipped to another.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.ensembles.continue_attractors`.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = attractor_shares(gp.ensembles.continue_attractors(gp.Oscillator(), "damping_ratio", [0.15, 0.16], n=50))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['period 1']
    """
    ax = new_axes(ax, 3.6)
    parameter = str(result.share.dims[0])
    values = result[parameter].values
    between = 0.5 * (values[1:] + values[:-1])
    edges = np.concatenate([values[:1], between, values[-1:]])
    below = np.zeros(len(values))
    present = set()
    for number in range(result.sizes["attractor"]):
        own = result.isel(attractor=number)
        above = below + np.nan_to_num(own.share.values)
        columns = own.attractor_status.values, own.attractor_period.values, above > below
        kinds = [Motion(str(a), int(p) or None) if seen else None for a, p, seen in zip(*columns, strict=True)]
        for kind, group in groupby(range(len(values)), kinds.__getitem__):
            if kind is None:
                continue
            run = list(group)
            steps = np.repeat(edges[run[0] : run[-1] + 2], 2)[1:-1]
            ax.fill_between(
                steps, np.repeat(below[run], 2), np.repeat(above[run], 2), facecolor=motion_colour(kind),
                edgecolor="white", linewidth=0.4, label=str(kind),
            )  # fmt: skip
            present.add(kind)
        below = above
    for i in np.flatnonzero(np.any(result.tips_to.values != -1, axis=1)):
        ax.plot(between[i - 1], 1.0, marker="v", markersize=4, color="black", clip_on=False, label="tipping point")
    over_parameter(ax, parameter, values, axis_label("share"), ylim=(0.0, 1.0))
    if legend:
        add_motion_legend(ax, present)
    return ax
