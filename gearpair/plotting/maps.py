"""Maps over two parameters, and over the plane of starts (X0, X0')."""

from collections import Counter
from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, LogNorm, Normalize, to_rgb
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
from matplotlib.typing import ColorType

from gearpair._checks import checked
from gearpair.ensembles.planes import attractor_motions
from gearpair.motion.impacts import ImpactState
from gearpair.motion.names import IMPACT_NAMES, Motion, motions_of
from gearpair.motion.settling import Status
from gearpair.motion.steady import SteadyState
from gearpair.plotting.paper import look_of
from gearpair.plotting.style import (
    add_legend,
    add_motion_legend,
    colour_on,
    legend_name,
    motion_colour,
    new_axes,
    shade_backlash,
)
from gearpair.quantities import axis_label
from gearpair.quantities import quantity as quantity_of

Colour = tuple[float, float, float]
HEIGHT = 4.6  # of a map of two parameters, in inches
ENDS = ("vmin", "vmax")  # of the colours, which are told when an image is made
LETTERS_OF_A_BAR = 44  # in a line beside it
MOST_NAMED = 8  # motions that a legend names one by one
FEW_DECADES = 1e3  # the largest over the smallest value of a logarithmic bar whose ticks are plain numbers
LINGERING = Motion(Status.TRANSIENT)

# The harsher the darker; without impacts green.
IMPACT_COLOURS: Mapping[str, str] = {
    ImpactState.NEVER_IN_CONTACT: "#FFFFFF",
    ImpactState.NONE_DRIVE: "#D5EBD0",
    ImpactState.NONE_COAST: "#BFDDC0",
    ImpactState.SINGLE_DRIVE: "#BCBDDC",
    ImpactState.SINGLE_COAST: "#9E9AC8",
    ImpactState.DOUBLE: "#54278F",
    "": "#FFFFFF",
}


def attractor_colours(result: xr.Dataset, ax: Axes | None = None) -> list[Colour]:
    """One colour for each attractor of `gearpair.basins`: its motion's, paler for the second of a colour and so on."""
    colours, seen = [], Counter[str]()
    for motion in attractor_motions(result):
        shade = 0.6 ** seen[legend_name(motion)]
        seen[legend_name(motion)] += 1
        red, green, blue = (
            1.0 - shade * (1.0 - part) for part in to_rgb(colour_on(ax, motion) if ax else motion_colour(motion))
        )
        colours.append((red, green, blue))
    return colours


@checked
def basins(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """Which attractor each start reaches, a second motion of a kind paler; starts that reach none are white.

    Of these, chaotic transients, which reach none yet, have a colour of their own. The legend above the axes names
    the attractors and the transients; where the attractors are many, their colours.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = basins(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['period 1, double-sided', 'period 2, single-sided']
    """
    ax = new_axes(ax, 5.0)
    motions, colours = attractor_motions(result), attractor_colours(result, ax)
    still = result.status.values == Status.TRANSIENT
    if still.any():
        motions, colours = [*motions, LINGERING], [*colours, to_rgb(colour_on(ax, LINGERING))]
    places = np.searchsorted(np.unique(result.attractor_number), result.attractor)
    numbers = np.where(still, len(motions), np.where(result.attractor >= 0, places + 1, 0))
    _map(ax, result, numbers, [(1.0, 1.0, 1.0), *colours], look)
    if legend and len(motions) > MOST_NAMED:
        add_motion_legend(ax, motions)
    elif legend:
        strongest: dict[str, Colour] = {}
        for motion, colour in zip(motions, colours, strict=True):
            strongest.setdefault(str(motion), colour)
        name_colours(ax, strongest)
    return ax


@checked
def impact_states(
    result: xr.Dataset, ax: Axes | None = None, *, worst: bool = False, legend: bool = True, **look: Any
) -> Axes:
    """In which impact state each start ends, or the `worst` of its whole way: the harsher the darker.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = impact_states(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['single-sided', 'double-sided']
    """
    ax = new_axes(ax, 5.0)
    states = (result.worst_impact_state if worst else result.impact_state).values
    numbers = np.zeros(states.shape, int)
    for i, state in enumerate(IMPACT_COLOURS):
        numbers[states == state] = i
    _map(ax, result, numbers, [to_rgb(colour) for colour in IMPACT_COLOURS.values()], look)
    if legend:
        name_colours(ax, impact_colours(states))
    return ax


def _map(ax: Axes, result: xr.Dataset, numbers: np.ndarray, colours: Sequence[Colour], look: Mapping[str, Any]) -> None:
    _plane(ax, result, numbers, look, cmap=ListedColormap(list(colours)), vmin=-0.5, vmax=len(colours) - 0.5)


def _plane(ax: Axes, result: xr.Dataset, values: np.ndarray, look: Mapping[str, Any], **colours: Any) -> QuadMesh:
    for name in ("color", "colour"):
        if name in look:  # matplotlib would paint the edges of the cells with it
            raise TypeError(f"unknown option {name}={look[name]!r}: the colours of a map say where each start leads")
    ax.set(xlabel=axis_label("start_x"), ylabel=axis_label("start_v"))
    image = look_of(QuadMesh, look, ENDS, rasterized=True, **colours)
    return ax.pcolormesh(result.x.values, result.v.values, values, shading="nearest", **image)


def impact_colours(states: np.ndarray) -> dict[str, Colour]:
    """The colours of the impact states that are present, by their names in words."""
    present = set(states.ravel())
    return {IMPACT_NAMES[state]: to_rgb(colour) for state, colour in IMPACT_COLOURS.items() if state in present}


def name_colours(ax: Axes, colours: Mapping[str, Colour], columns: int = 1, **place: Any) -> Legend:
    """A legend of coloured patches, above the axes or where `place` says."""
    handles = [Patch(facecolor=each, edgecolor="#999999", linewidth=0.5, label=name) for name, each in colours.items()]
    place = place or {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.3}
    return add_legend(ax, handles, columns, **place)


@checked
def attractor_points(states: Sequence[SteadyState], ax: Axes, **look: Any) -> Axes:
    """The section points of periodic attractors, as white-rimmed dots over a map of their basins.

    One line of dots for each periodic state.

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
            usual: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 5.5, "markeredgecolor": "white"}
            usual |= {"markerfacecolor": colour_on(ax, state.motion), "markeredgewidth": 1.0}
            ax.plot(*state.points.T, **look_of(Line2D, look, label=str(state.motion.kind), **usual))
    return ax


@checked
def finite_exponents(result: xr.Dataset, ax: Axes | None = None, *, largest: float | None = None, **look: Any) -> Axes:
    """The largest Lyapunov exponent from each start: dark where neighbours part, pale where they stay together.

    A colour bar beside it; the colours end at `largest`.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = finite_exponents(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    >>> ax.get_xlabel(), len(ax.figure.axes)  # the other one is the colour bar's
    ('initial displacement $X_0$', 2)
    """
    ax = new_axes(ax, 5.0)
    shown = _plane(ax, result, result.exponent.values, look, cmap="cividis", vmin=0.0, vmax=largest)
    shade_backlash(ax, horizontal=False)
    ax.figure.colorbar(shown, ax=ax, label=_long_name(result, "exponent"), pad=0.01)
    return ax


@checked
def impact_map(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The impact state at each point of a grid of two parameters, the harsher the darker.

    One image whose pixels are the grid's points.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = impact_map(gp.parameter_map(gp.Oscillator(), {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7]}))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['no impact', 'single-sided']
    """
    states = result.impact_state.values
    ax = _image(result, _pixels(states, IMPACT_COLOURS), new_axes(ax, HEIGHT), look)
    if legend:
        name_colours(ax, impact_colours(states))
    return ax


@checked
def period_map(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The motion at each point of a grid of two parameters, in the colours of all figures.

    One image whose pixels are the points of a `gearpair.parameter_map` with two axes, evenly spaced: the first is drawn
    upwards, the second to the right.

    Examples
    --------
    >>> import gearpair as gp
    >>> grid = gp.parameter_map(gp.Oscillator(), {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7, 0.8]})
    >>> period_map(grid).images[0].get_size()
    (2, 3)
    """
    motions = motions_of(result)
    present = set(motions.ravel())
    ax = new_axes(ax, HEIGHT)
    _image(result, _pixels(motions, {motion: colour_on(ax, motion) for motion in present}), ax, look)
    if legend:
        add_motion_legend(ax, present)
        drawn = ax.get_legend()
        for dot in filter(None, drawn.legend_handles if drawn else ()):
            dot.set_alpha(ax.images[-1].get_alpha())  # as pale as the map
    return ax


@checked
def quantity_map(
    result: xr.Dataset,
    quantity: str,
    ax: Axes | None = None,
    *,
    smallest: float | None = None,
    largest: float | None = None,
    logarithmic: bool = False,
    **look: Any,
) -> Axes:
    """A quantity of the motion at each point of a grid of two parameters: dark where it is small.

    A colour bar beside it.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.parameter_map` with two axes (or of `gearpair.basins`), evenly spaced.
    quantity : str
        One of its variables.
    smallest, largest : float, optional
        Where the colours begin and end; the smallest value (on a logarithmic scale the smallest above 0) and the
        largest when not given.
    logarithmic : bool
        Spread the colours over the logarithm.

    Examples
    --------
    >>> import gearpair as gp
    >>> axes = {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.6, 0.7]}
    >>> ax = quantity_map(gp.parameter_map(gp.Oscillator(), axes, measures=True), "load_factor")
    >>> ax.figure.axes[1].get_ylabel()
    'largest mesh force over the mean force'
    """
    values = result[quantity].values
    top = float(np.nanmax(values)) if largest is None else largest
    low = float(np.nanmin(values[values > 0.0] if logarithmic else values)) if smallest is None else smallest
    norm = (LogNorm if logarithmic else Normalize)(low, top)
    ax = _image(result, values, new_axes(ax, HEIGHT), look, norm=norm, cmap="viridis")
    below, above = bool(np.nanmin(values) < low), bool(np.nanmax(values) > top)
    beyond = {(True, True): "both", (True, False): "min", (False, True): "max"}.get((below, above), "neither")
    bar = ax.figure.colorbar(ax.images[0], ax=ax, label=_long_name(result, quantity), pad=0.01, extend=beyond)
    if logarithmic and top / low < FEW_DECADES:
        bar.ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        bar.ax.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        bar.ax.yaxis.set_minor_formatter(NullFormatter())
    return ax


def _long_name(result: xr.Dataset, name: str) -> str:
    """What a colour bar says of a variable: what it is in full, in lines that are not longer than the bar."""
    known = quantity_of(name)
    return fill(known.title if known else str(result[name].attrs.get("long_name", name)), LETTERS_OF_A_BAR)


def _pixels(values: np.ndarray, colours: Mapping[Any, ColorType]) -> np.ndarray:
    pixels = np.zeros((*values.shape, 3))
    for value, colour in colours.items():
        pixels[values == value] = to_rgb(colour)
    return pixels


def _image(result: xr.Dataset, pixels: np.ndarray, ax: Axes, look: Mapping[str, Any], **colours: Any) -> Axes:
    dims = [str(dim) for dim in result.status.dims]
    if len(dims) != 2:
        raise ValueError(f"result must be a map over two parameters, got {len(dims)}: {', '.join(dims)}")
    vertical, horizontal = dims
    (left, right), (low, high) = (_ends(result[name].values) for name in (horizontal, vertical))
    extent = (left, right, low, high)
    image = look_of(AxesImage, look, ENDS, interpolation="nearest", **colours)
    ax.imshow(pixels, origin="lower", extent=extent, aspect="auto", **image)
    names = ("start_v", "start_x") if dims == ["v", "x"] else dims
    ax.set(xlabel=axis_label(names[1]), ylabel=axis_label(names[0]))
    return ax


def _ends(values: np.ndarray) -> tuple[float, float]:
    """Half a step beyond the first and the last of evenly spaced values."""
    half = 0.5 * (values[-1] - values[0]) / max(len(values) - 1, 1)
    return values[0] - half, values[-1] + half
