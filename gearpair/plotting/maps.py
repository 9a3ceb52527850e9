"""Maps of the settled motion over two parameters."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb

from gearpair.plotting.style import LABELS, add_motion_legend, legend_name, motion_colour, new_axes
from gearpair.ranges import motion_names


def period_map(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """The motion at each point of a grid of two parameters, in the colours of all figures.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.parameter_map` with two axes, evenly spaced: the first is drawn upwards, the second to the right.
    ax : Axes, optional
    legend : bool
        Name the colours above the axes.

    Returns
    -------
    Axes
        With one image whose pixels are the grid's points.

    Raises
    ------
    ValueError
        For a map with another number of axes.
    """
    names = motion_names(result)
    if names.ndim != 2:
        raise ValueError(f"result must be a map over two parameters, got {names.ndim}: {', '.join(result.status.dims)}")
    ax = new_axes(ax, 4.6)
    vertical, horizontal = (str(dim) for dim in result.status.dims)
    colours = {name: to_rgb(motion_colour(str(name))) for name in np.unique(names)}
    pixels = np.array([[colours[name] for name in row] for row in names])
    x, y = result[horizontal].values, result[vertical].values
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    extent = (x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y)
    ax.imshow(pixels, origin="lower", extent=extent, aspect="auto", interpolation="nearest")
    ax.set(xlabel=LABELS[horizontal], ylabel=LABELS[vertical])
    if legend:
        add_motion_legend(ax, {legend_name(str(name)) for name in np.unique(names)})
    return ax
