"""The method: what accuracy costs, how a step is certified, and what an integrator draws.

A segment that was not met, None, gives an Axes that says so.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from gearpair._checks import checked
from gearpair.ensembles.ranges import swept_parameter
from gearpair.methods.certificates import Segment
from gearpair.methods.precision import EXACT, Precision, numerical_chaos
from gearpair.plotting.paper import faint, legible, look_of, paper
from gearpair.plotting.style import BOUNDARY, INK, add_legend, new_axes, note, over_parameter
from gearpair.quantities import axis_label

METHOD_LOOKS = {
    "RK45": ("#E69F00", "o"),
    "DOP853": ("#009E73", "s"),
    "LSODA": ("#CC79A7", "^"),
    "RK45, compiled": ("#D55E00", "D"),
    EXACT: (INK, "*"),
}
FALSE_CHAOS, FAINT = "#C8102E", "#9A9A9A"
CUBIC, STEP = "#E69F00", "#D55E00"
T = "$t$ (widths of the cell)"
BESIDE: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "color": BOUNDARY, "fontsize": 8}  # a line's name


@checked
def work_precision(measured: Sequence[Precision], ax: Axes | None = None, **look: Any) -> Axes:
    """Time per mesh period over the one-period error of `gearpair.methods.work_precision`, both logarithmic, by method.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = work_precision(gp.methods.work_precision(gp.Oscillator(), 1.0, 0.0, n_starts=2, tolerances=[1e-6]))
    >>> [line.get_label() for line in ax.lines]
    ['RK45', 'DOP853', 'LSODA', 'RK45, compiled', 'exact flow']
    """
    ax = new_axes(ax, 4.2)
    for method in dict.fromkeys(m.method for m in measured):
        runs = [m for m in measured if m.method == method]
        colour, marker = METHOD_LOOKS.get(method, (FAINT, "x"))
        error = [max(m.error, 2.0**-53) for m in runs]
        usual: dict[str, Any] = {"color": legible(ax, colour), "marker": marker, "label": method}
        usual["markersize"] = 13 if method == EXACT else 5
        ax.plot(error, [m.seconds for m in runs], **look_of(Line2D, look, **usual))
    ax.set(xscale="log", yscale="log", xlabel="largest error after one mesh period", ylabel="seconds per mesh period")
    ax.invert_xaxis()
    ax.grid(linewidth=0.4, color=faint(ax, "#DDDDDD"))
    add_legend(ax, loc="center left", bbox_to_anchor=(1.0, 0.5))
    return ax


@checked
def drawn_diagram(
    exact: xr.Dataset, drawn: xr.Dataset, ax: Axes | None = None, *, title: str = "", legend: bool = True, **look: Any
) -> Axes:
    """A diagram as an integrator draws it; in red where it is disordered, though the motion is periodic in the end.

    Two lines of dots: what may be believed, then what the integrator made up.

    Parameters
    ----------
    exact : xarray.Dataset
        Of `gearpair.sweep`: what is true.
    drawn : xarray.Dataset
        Of `gearpair.methods.runge_kutta_sweep` at the same values.

    Examples
    --------
    >>> import gearpair as gp
    >>> osc, values = gp.Oscillator(), [1.65, 1.7]
    >>> exact = gp.sweep(osc, "mesh_frequency", values)
    >>> ax = drawn_diagram(exact, gp.methods.runge_kutta_sweep(osc, "mesh_frequency", values))
    >>> sorted(set(ax.lines[1].get_xdata().tolist()))  # all of it made up
    [1.65, 1.7]
    """
    ax = new_axes(ax)
    parameter = swept_parameter(exact)
    false = numerical_chaos(exact, drawn)
    values = drawn[parameter].values
    for chosen, colour, label in (
        (~false, INK, "periodic, or chaotic in truth too"),
        (false, FALSE_CHAOS, "disordered, though periodic in the end"),
    ):
        x = drawn.x.values[chosen]
        usual: dict[str, Any] = {"markeredgewidth": 0, "markersize": 1.7, "rasterized": True, "label": label}
        usual |= {"linestyle": "", "marker": ".", "color": legible(ax, colour)}
        ax.plot(np.repeat(values[chosen], x.shape[1]), x.ravel(), **look_of(Line2D, look, **usual))
    over_parameter(ax, parameter, values, axis_label("section"))
    strip = {"facecolor": paper(ax), "edgecolor": "none", "alpha": 0.85, "pad": 1.5}
    note(ax, title, (0.0, 1.0), (6, -4), xycoords="axes fraction", va="top", bbox=strip)
    if legend:
        place: dict[str, Any] = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.2}
        add_legend(ax, columns=2, markerscale=5.0, **place)
    return ax


@checked
def certificate(segment: Segment | None, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """A segment with its Bézier points, their hull and the boundaries in sight; that none was met, for None.

    Lines labelled ``"motion"`` and ``"Bézier points"``, and ``"crossing"`` where there is one.

    Examples
    --------
    >>> import gearpair as gp
    >>> crossing = next(s for s in gp.methods.segments(gp.Oscillator(), 1.0, 0.0) if s.crossing is not None)
    >>> [line.get_label() for line in certificate(crossing, legend=False).lines[:3]]
    ['Bézier points', 'motion', 'crossing']
    """
    ax = new_axes(ax)
    if segment is None:
        return _none_met(ax)
    t = np.linspace(0.0, segment.span, 201)
    points = segment.control_points
    low, high = points[:, 1].min() - segment.spread, points[:, 1].max() + segment.spread
    ax.axhspan(low, high, color=CUBIC, alpha=0.13, linewidth=0, label="hull $\\pm$ spread")
    ax.plot(*points.T, color=CUBIC, linestyle="--", marker="s", markersize=5, linewidth=1.0, label="Bézier points")
    ax.plot(t, segment(t), **look_of(Line2D, look, color=legible(ax, INK), linewidth=1.8, label="motion"))
    if segment.crossing is not None:
        ax.plot(segment.crossing, segment(segment.crossing), "o", color=STEP, markersize=7, label="crossing")
    _show_boundaries(segment, ax, low, high)
    ax.set(xlabel=T, ylabel=axis_label("x"), xlim=(0.0, segment.span))
    if legend:
        ax.legend()
    return ax


def _none_met(ax: Axes) -> Axes:
    """Say that there is nothing to show."""
    ax.annotate("none met", (0.5, 0.5), xycoords="axes fraction", ha="center", va="center", color=BOUNDARY)
    ax.set_axis_off()
    return ax


def _show_boundaries(segment: Segment, ax: Axes, low: float, high: float) -> None:
    """The boundaries that lie within the limits or near them."""
    room = 0.25 * (high - low)
    near = [b for b in segment.boundaries if low - 2.0 * room <= b <= high + 2.0 * room]
    for boundary in near:
        ax.axhline(boundary, color=BOUNDARY, linewidth=1.4)
        note(ax, f"$X = {boundary:g}$", (1.0, boundary), (-3, 3), ha="right", **BESIDE)
    ax.set_ylim(min([low, *near]) - room, max([high, *near]) + room)


@checked
def interpolation_error(segment: Segment | None, ax: Axes | None = None, **look: Any) -> Axes:
    """The motion less its cubic Hermite interpolant, between the bounds.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = interpolation_error(gp.methods.segments(gp.Oscillator(), 1.0, 0.0)[0])
    >>> ax.lines[-1].get_label()
    'motion - cubic'
    """
    ax = new_axes(ax)
    if segment is None:
        return _none_met(ax)
    t = np.linspace(0.0, segment.span, 201)
    power = int(np.floor(np.log10(segment.spread)))
    spread, difference = segment.spread * 10.0**-power, (segment(t) - segment.cubic(t)) * 10.0**-power
    ax.axhspan(-spread, spread, color=CUBIC, alpha=0.13, linewidth=0)
    for sign in (-1.0, 1.0):
        ax.axhline(sign * spread, color=CUBIC, linewidth=1.0, label="$\\pm$ spread" if sign > 0 else None)
    usual: dict[str, Any] = {"color": legible(ax, INK), "linewidth": 1.8, "label": "motion - cubic"}
    ax.plot(t, difference, **look_of(Line2D, look, **usual))
    ax.set(xlabel=T, ylabel=f"difference in $X$ ($10^{{{power}}}$)", xlim=(0.0, segment.span))
    ax.legend(loc="upper right")
    ax.set_ylim(-1.3 * spread, 2.2 * spread)
    return ax


@checked
def certified_steps(segment: Segment | None, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The distance to the boundary that limits the steps, and the parabola under it that certifies each step.

    A line labelled ``"distance"``, one line for each parabola, and a dot where each step starts.

    Examples
    --------
    >>> import gearpair as gp
    >>> crossing = next(s for s in gp.methods.segments(gp.Oscillator(), 1.0, 0.0) if s.crossing is not None)
    >>> certified_steps(crossing).lines[-1].get_label()
    'distance'
    """
    ax = new_axes(ax)
    if segment is None:
        return _none_met(ax)
    steps, _crossing = segment.certified_steps()
    boundary = min(steps, key=lambda step: step.d).boundary
    shown = [step for step in steps if step.boundary == boundary]
    sign = -boundary if segment.region == 0 else float(segment.region)
    t = np.linspace(0.0, segment.span, 201)
    distance = sign * (segment(t) - boundary)
    ax.axhline(0.0, color=BOUNDARY, linewidth=1.4)
    for i, step in enumerate(shown):
        h = np.linspace(0.0, step.length, 101)
        labels = ("lower bound", "start of a step") if i == 0 else (None, None)
        bound = step.d + step.u * h + 0.5 * step.m * h * h
        ax.plot(step.t + h, bound, "--", color=STEP, linewidth=1.2, label=labels[0])
        ax.plot(step.t, step.d, "o", color=STEP, markersize=4.5, label=labels[1])
    usual: dict[str, Any] = {"color": legible(ax, INK), "linewidth": 1.8, "label": "distance", "zorder": 1.5}
    ax.plot(t, distance, **look_of(Line2D, look, **usual))
    top = max(step.d for step in shown) if segment.crossing is not None else distance.max()
    ax.set(xlabel=T, ylabel=f"distance to $X = {boundary:g}$", xlim=(0.0, segment.span), ylim=(-0.25 * top, 1.6 * top))
    if legend:
        ax.legend()
    return ax


@checked
def step_convergence(segment: Segment | None, ax: Axes | None = None, **look: Any) -> Axes:
    """The distance left, on a logarithmic scale, at each certified step of a segment with a crossing.

    Examples
    --------
    >>> import gearpair as gp
    >>> crossing = next(s for s in gp.methods.segments(gp.Oscillator(), 1.0, 0.0) if s.crossing is not None)
    >>> ax = step_convergence(crossing)
    >>> ax.get_ylabel(), ax.get_yscale()
    ('distance at its start', 'log')
    """
    ax = new_axes(ax)
    if segment is None:
        return _none_met(ax)
    steps, _crossing = segment.certified_steps()
    distances = [max(step.d, 2.0**-53) for step in steps]
    usual: dict[str, Any] = {"color": legible(ax, INK), "marker": "o", "markersize": 5, "label": "distance"}
    ax.plot(range(len(steps)), distances, **look_of(Line2D, look, **usual))
    ax.axhline(2.0**-52, color=BOUNDARY, linewidth=0.9, linestyle=":")
    note(ax, "rounding", (0.02, 2.0**-52), (0, 3), **BESIDE)
    ax.set(xlabel="step", ylabel="distance at its start", yscale="log", xticks=range(len(steps)), ylim=(1e-17, None))
    return ax
