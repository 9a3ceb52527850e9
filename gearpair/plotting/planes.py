"""Maps over the plane of starts (X0, X0')."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.patches import Patch

from gearpair.ensembles.planes import attractor_motions
from gearpair.motion.impacts import ImpactState
from gearpair.motion.names import IMPACT_NAMES, Motion, motions_of
from gearpair.motion.steady import SteadyState
from gearpair.plotting.diagrams import shade_backlash
from gearpair.plotting.style import add_motion_legend, motion_colour, new_axes
from gearpair.quantities import axis_label

MOST_NAMED = 8  # attractors that a legend names one by one

# The harsher the darker.
IMPACT_COLOURS: Mapping[str, str] = {
    ImpactState.NEVER_IN_CONTACT: "#FFFFFF",
    ImpactState.NONE_DRIVE: "#F2F0F7",
    ImpactState.NONE_COAST: "#DADAEB",
    ImpactState.SINGLE_DRIVE: "#BCBDDC",
    ImpactState.SINGLE_COAST: "#9E9AC8",
    ImpactState.DOUBLE: "#54278F",
    "": "#FFFFFF",
}


def attractor_colours(result: xr.Dataset) -> list[tuple[float, float, float]]:
    """One colour for each attractor of `gearpair.basins`: its motion's, paler for the second of a kind and so on."""
    colours, seen = [], Counter[Motion]()
    for motion in attractor_motions(result):
        shade = 0.6 ** seen[motion.kind]
        seen[motion.kind] += 1
        red, green, blue = (1.0 - shade * (1.0 - part) for part in to_rgb(motion_colour(motion)))
        colours.append((red, green, blue))
    return colours


def basins(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """Which attractor each start reaches, a second motion of a kind paler; starts that do not stay bounded are white.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.basins`.
    ax : Axes, optional
    legend : bool
        Name the attractors above the axes; where they are many, their colours.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = basins(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['period 1, double-sided', 'period 2, single-sided']
    """
    ax = new_axes(ax, 5.0)
    motions, colours = attractor_motions(result), attractor_colours(result)
    _map(ax, result, result.attractor.values + 1, [(1.0, 1.0, 1.0), *colours])
    if legend and len(motions) > MOST_NAMED:
        add_motion_legend(ax, motions)
    elif legend:
        strongest: dict[str, tuple[float, float, float]] = {}
        for motion, colour in zip(motions, colours, strict=True):
            strongest.setdefault(str(motion), colour)
        name_colours(ax, strongest)
    return ax


def impact_states(result: xr.Dataset, ax: Axes | None = None, *, worst: bool = False, legend: bool = True) -> Axes:
    """In which impact state each start ends, the harsher the darker.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.basins`.
    ax : Axes, optional
    worst : bool
        The worst state of the whole way instead, from the start on.
    legend : bool
        Name the states above the axes.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = impact_states(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['single-sided', 'double-sided']
    """
    ax = new_axes(ax, 5.0)
    states = list(IMPACT_COLOURS)
    names = (result.worst_impact_state if worst else result.impact_state).values
    numbers = np.zeros(names.shape, int)
    for i, state in enumerate(states):
        numbers[names == state] = i
    _map(ax, result, numbers, [to_rgb(colour) for colour in IMPACT_COLOURS.values()])
    if legend:
        present = [state for i, state in enumerate(states) if np.any(numbers == i)]
        name_colours(ax, {IMPACT_NAMES[state]: to_rgb(IMPACT_COLOURS[state]) for state in present})
    return ax


def _map(ax: Axes, result: xr.Dataset, numbers: np.ndarray, colours: Sequence[tuple[float, float, float]]) -> None:
    ax.pcolormesh(
        result.x.values, result.v.values, numbers, cmap=ListedColormap(list(colours)), vmin=-0.5,
        vmax=len(colours) - 0.5, shading="nearest", rasterized=True,
    )  # fmt: skip
    ax.set(xlabel=axis_label("start_x"), ylabel=axis_label("start_v"))


def name_colours(ax: Axes, colours: Mapping[str, tuple[float, float, float]], columns: int = 1) -> None:
    """A legend of coloured patches above the axes."""
    handles = [
        Patch(facecolor=colour, edgecolor="#999999", linewidth=0.5, label=name) for name, colour in colours.items()
    ]
    ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, borderaxespad=0.3)


def attractor_points(states: Sequence[SteadyState], ax: Axes) -> Axes:
    """The section points of periodic attractors, as white-rimmed dots over a map of their basins.

    Parameters
    ----------
    states : sequence of SteadyState
    ax : Axes

    Returns
    -------
    Axes
        With one line of dots for each periodic state.

    Examples
    --------
    >>> import gearpair as gp
    >>> osc = gp.Oscillator()
    >>> ax = attractor_points([gp.steady_state(osc)], basins(gp.basins(osc, [-2.0, 1.0], [0.0, 0.5])))
    >>> ax.lines[0].get_label(), len(ax.lines[0].get_xdata())
    ('period 2', 2)
    """
    for state in states:
        if state.period:
            ax.plot(
                state.points[:, 0], state.points[:, 1], linestyle="", marker="o", markersize=5.5,
                label=str(state.motion.kind), markerfacecolor=motion_colour(state.motion), markeredgecolor="white",
                markeredgewidth=1.0,
            )  # fmt: skip
    return ax


def finite_exponents(result: xr.Dataset, ax: Axes | None = None, *, largest: float | None = None) -> Axes:
    """The largest Lyapunov exponent from each start: dark where neighbours part, pale where they stay together.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.basins`.
    ax : Axes, optional
    largest : float, optional
        Where the colours end.

    Returns
    -------
    Axes
        With a colour bar beside it.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = finite_exponents(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    >>> ax.get_xlabel(), len(ax.figure.axes)  # the other one is the colour bar's
    ('initial displacement $X_0$', 2)
    """
    ax = new_axes(ax, 5.0)
    shown = ax.pcolormesh(
        result.x.values, result.v.values, result.exponent.values, cmap="cividis", vmin=0.0, vmax=largest,
        shading="nearest", rasterized=True,
    )  # fmt: skip
    shade_backlash(ax, horizontal=False)
    ax.figure.colorbar(shown, ax=ax, label=r"largest exponent $\lambda_1$", pad=0.01)
    ax.set(xlabel=axis_label("start_x"), ylabel=axis_label("start_v"))
    return ax


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

    Examples
    --------
    >>> import gearpair as gp
    >>> grid = gp.parameter_map(gp.Oscillator(), {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7, 0.8]})
    >>> period_map(grid).images[0].get_size()
    (2, 3)
    """
    motions = motions_of(result)
    if motions.ndim != 2:
        raise ValueError(
            f"result must be a map over two parameters, got {motions.ndim}: {', '.join(result.status.dims)}"
        )
    ax = new_axes(ax, 4.6)
    vertical, horizontal = (str(dim) for dim in result.status.dims)
    present = set(motions.ravel())
    colours = {motion: to_rgb(motion_colour(motion)) for motion in present}
    pixels = np.array([[colours[motion] for motion in row] for row in motions])
    x, y = result[horizontal].values, result[vertical].values
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    extent = (x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y)
    ax.imshow(pixels, origin="lower", extent=extent, aspect="auto", interpolation="nearest")
    ax.set(xlabel=axis_label(horizontal), ylabel=axis_label(vertical))
    if legend:
        add_motion_legend(ax, present)
    return ax
