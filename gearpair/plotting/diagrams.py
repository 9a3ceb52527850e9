"""Diagrams over one parameter."""

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from gearpair._checks import checked
from gearpair.article.published import COMPLEX, Boundary, Range
from gearpair.ensembles.ranges import MotionRange, motion_ranges, swept_parameter
from gearpair.motion.names import CHAOS, Motion, motions_of
from gearpair.motion.settling import Status
from gearpair.plotting.paper import legible, look_of
from gearpair.plotting.style import (
    BOUNDARY,
    INK,
    add_legend,
    add_motion_legend,
    colour_on,
    legend_name,
    motion_colour,
    name_rows,
    new_axes,
    note,
    over_parameter,
    shade_backlash,
)
from gearpair.quantities import axis_label

LETTER = 0.0115  # share of the axis that a letter of a bar's name takes
LARGEST_DRAWN = 10.0  # |X| where a diagram ends


@checked
def bifurcation_diagram(
    sweep: xr.Dataset,
    ax: Axes | None = None,
    *,
    title: str = "",
    legend: bool = True,
    size: float = 1.1,
    reach: float = LARGEST_DRAWN,
    **look: Any,
) -> Axes:
    """Section points of X at each value of a sweep, coloured by the motion's period.

    A motion that is larger than `reach`, or that has escaped, would leave the others no room: it is not drawn, and a
    triangle of its colour at the upper rim says where it is.

    One line, labelled with its name, for each kind of motion, and one of triangles for those beyond `reach`.

    Parameters
    ----------
    size : float
        Diameter of a dot in points; those of chaotic motions are smaller.
    reach : float
        The largest ``|X|`` that is drawn.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = bifurcation_diagram(gp.sweep(gp.Oscillator(), "mesh_frequency", [0.7, 0.74, 0.78]))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['period 2', 'period 4']
    """
    ax = new_axes(ax)
    parameter = swept_parameter(sweep)
    motions = motions_of(sweep)
    names = np.array([legend_name(motion) for motion in motions])
    values, drawn = sweep[parameter].values, {}
    for name in sorted(set(names.tolist()), key=lambda name: -int(np.sum(names == name))):
        points = _section_points(sweep, names == name)
        chosen = motions[names == name]
        escaped = np.array([motion.status == Status.ESCAPED for motion in chosen])
        beyond = escaped | np.any(np.abs(points) > reach, axis=1)
        points[beyond] = np.nan
        where = np.repeat(values[names == name], points.shape[1])
        many, colour = not chosen[0].period, look_of(Line2D, look, color=colour_on(ax, chosen[0]))["color"]
        drawn[name] = colour
        usual: dict[str, Any] = {"markersize": 0.6 * size, "alpha": 0.5} if many else {"markersize": 1.6 * size}
        usual |= {"linestyle": "", "marker": ".", "markeredgewidth": 0, "rasterized": True}
        ax.plot(where, points.ravel(), **look_of(Line2D, look, color=colour, label=name, **usual))
        if beyond.any():
            ax.plot(
                values[names == name][beyond], np.ones(beyond.sum()), "^", transform=ax.get_xaxis_transform(),
                markersize=3.5, markeredgewidth=0.4, markeredgecolor="#777777", clip_on=False,
                markerfacecolor=colour, label=f"{name}, not drawn",
            )  # fmt: skip
    over_parameter(ax, parameter, values, axis_label("section"))
    note(ax, title, (0.0, 1.0), (6, -4), xycoords="axes fraction", va="top")
    if legend:
        add_motion_legend(ax, motions)
        if (key := ax.get_legend()) is not None:
            for dot, text in zip(key.get_lines(), key.get_texts(), strict=True):
                dot.set_color(drawn[text.get_text()])
    return ax


def _section_points(sweep: xr.Dataset, chosen: np.ndarray) -> np.ndarray:
    """X of the chosen motions, the repeated points of periodic ones blanked."""
    x = sweep.x.values[chosen].copy()
    period = sweep.period.values[chosen]
    repeats = np.arange(x.shape[1]) >= np.where(period > 0, period, x.shape[1])[:, None]
    x[repeats] = np.nan
    return x


@checked
def mark_boundaries(boundaries: Iterable[Boundary], ax: Axes, **look: Any) -> Axes:
    """Dotted vertical lines where the article puts its boundaries.

    Parameters
    ----------
    boundaries : iterable of Boundary
        As `gearpair.published.boundaries` gives them.
    ax : Axes
        Of a diagram over their parameter; boundaries outside its limits are left out.

    Examples
    --------
    >>> from matplotlib import pyplot as plt
    >>> from gearpair import published
    >>> ax = plt.figure().add_subplot(xlim=(0.7, 1.0))
    >>> ax = mark_boundaries(published.boundaries("mesh_frequency"), ax)
    >>> [float(line.get_xdata()[0]) for line in ax.lines]
    [0.799, 0.865]
    """
    left, right = ax.get_xlim()
    usual: dict[str, Any] = {"color": BOUNDARY, "linewidth": 0.9, "linestyle": (0, (1, 1.6)), "zorder": -1}
    for boundary in boundaries:
        if left <= boundary.value <= right:
            ax.axvline(boundary.value, **look_of(Line2D, look, **usual))
    return ax


@checked
def extremes(sweep: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """Smallest and largest X along a sweep, coloured by motion, over the strip where the teeth are out of contact.

    One line of dots each for the smallest and the largest X of every kind of motion.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = extremes(gp.sweep(gp.Oscillator(), "mesh_frequency", [0.7, 0.74, 0.78]))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['period 2', 'period 4']
    """
    ax = new_axes(ax)
    parameter = swept_parameter(sweep)
    values, motions = sweep[parameter].values, motions_of(sweep)
    shade_backlash(ax, horizontal=True)
    for motion in sorted(set(motions)):
        chosen = motions == motion
        usual: dict[str, Any] = {"linestyle": "", "marker": ".", "markersize": 2, "color": colour_on(ax, motion)}
        for extreme, label in (("x_min", str(motion)), ("x_max", None)):
            ax.plot(values[chosen], sweep[extreme].values[chosen], **look_of(Line2D, look, label=label, **usual))
    over_parameter(ax, parameter, values, r"$X_{\min}$ and $X_{\max}$")
    if legend:
        add_motion_legend(ax, motions)
    return ax


@checked
def exponents(sweep: xr.Dataset, ax: Axes | None = None, **look: Any) -> Axes:
    """The largest Lyapunov exponent along a sweep, within two standard errors, and the line at zero.

    Shaded where it is positive: there the motion had not settled when the watch ended.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = exponents(gp.sweep(gp.Oscillator(), "mesh_frequency", [0.7, 0.74, 0.78]), label="rising")
    >>> bool(ax.lines[1].get_ydata().max() < 0.0)  # periodic at all three
    True
    """
    ax = new_axes(ax, 2.2)
    parameter = swept_parameter(sweep)
    ordered = sweep.sortby(parameter)
    values, largest, error = (ordered[name].values for name in (parameter, "exponent", "exponent_error"))
    ax.axhline(0.0, color=BOUNDARY, linewidth=0.7)
    curve, band = look_of(Line2D, look, color=legible(ax, INK), linewidth=0.9), 2.0 * error
    ax.fill_between(values, largest - band, largest + band, color=curve["color"], alpha=0.25, linewidth=0)
    ax.plot(values, largest, **curve)
    ax.fill_between(values, 0.0, largest, where=largest > 0.0, color=colour_on(ax, CHAOS), alpha=0.25, linewidth=0)
    over_parameter(ax, parameter, values, axis_label("exponent"))
    return ax


@checked
def range_strips(
    strips: Mapping[str, xr.Dataset | Iterable[MotionRange | Range]],
    ax: Axes | None = None,
    *,
    parameter: str | None = None,
    legend: bool = True,
    **look: Any,
) -> Axes:
    """Ranges of motion as coloured bars, one strip for each source: what is published above what was found.

    One bar for each range; wide ones hold their names.

    Parameters
    ----------
    strips : mapping of str to xarray.Dataset or ranges
        The first stands on top. A sweep is drawn as its runs; the article's ranges come from `gearpair.published`.
    parameter : str, optional
        Needed only where no strip is a sweep.

    Examples
    --------
    >>> from gearpair import published
    >>> from gearpair.motion import periodic
    >>> found = [MotionRange(0.004, 0.016, periodic(3)), MotionRange(0.016, 0.025, periodic(1))]
    >>> ax = range_strips({"article": published.ranges("damping_ratio"), "found": found})
    >>> [label.get_text() for label in ax.get_yticklabels()], len(ax.patches)
    (['article', 'found'], 5)
    """
    ax = new_axes(ax, 0.7 + 0.42 * len(strips))
    bars: list[tuple[int, float, float, Motion]] = []
    for row, source in enumerate(strips.values()):
        ranges, half = (source, 0.0) if not isinstance(source, xr.Dataset) else _runs_and_half_step(source)
        parameter = swept_parameter(source) if isinstance(source, xr.Dataset) else parameter
        for each in ranges:
            parameter = getattr(each, "parameter", parameter)
            bars.append((row, each.lower - half, each.upper + half, each.motion))
    left, right = min(bar[1] for bar in bars), max(bar[2] for bar in bars)
    for row, low, high, motion in bars:
        colour, hatch = colour_on(ax, motion), "////" if motion == COMPLEX else None
        usual: dict[str, Any] = {"hatch": hatch, "linewidth": 0, "edgecolor": "white", "alpha": 0.75 if hatch else 1.0}
        bar = look_of(Patch, look, ("height",), height=0.8, color=colour, **usual)
        ax.barh(row, high - low, left=low, **bar)
        room = (high - low) / (right - left) / LETTER - 1.0
        text = next((text for text in (str(motion), str(motion.period or motion)) if len(text) <= room), "")
        ink = "white" if colour == motion_colour(motion) else "black"
        ax.text(0.5 * (low + high), row, text, ha="center", va="center", fontsize=8, color=ink, weight="bold")
    name_rows(ax, strips, parameter or "")
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    ax.set_xlim(left, right)
    if legend:
        add_motion_legend(ax, [bar[3] for bar in bars])
    return ax


def _runs_and_half_step(sweep: xr.Dataset) -> tuple[Iterable[MotionRange], float]:
    steps = np.abs(np.diff(sweep[swept_parameter(sweep)].values))
    return motion_ranges(sweep), 0.5 * float(steps.min()) if len(steps) else 0.0


@checked
def range_lanes(
    sources: Mapping[str, Iterable[MotionRange | Range]],
    ax: Axes | None = None,
    *,
    parameter: str | None = None,
    **look: Any,
) -> Axes:
    """One lane for each motion with its ranges from several sources under one another; coexistence shows as overlap.

    Parameters
    ----------
    sources : mapping of str to ranges
        The first is drawn pale with a dark rim, the others in full colour.
    parameter : str, optional
        For the label of the axis, where no source is the article.

    Examples
    --------
    >>> from gearpair import published
    >>> from gearpair.motion import periodic
    >>> found = [MotionRange(0.01, 0.02, periodic(1))]
    >>> ax = range_lanes({"article": published.ranges("damping_ratio"), "found": found})
    >>> [label.get_text() for label in ax.get_yticklabels()]
    ['period 1', 'period 3', 'chaotic']
    """
    rows = [(k, each) for k, source in enumerate(sources.values()) for each in source]
    motions = sorted({each.motion for _, each in rows})
    ax = new_axes(ax, 1.0 + 0.3 * len(motions))
    height, rim = 0.84 / len(sources), legible(ax, "black")
    for k, each in rows:
        parameter = getattr(each, "parameter", parameter)
        usual: dict[str, Any] = {"alpha": 0.35, "edgecolor": rim, "linewidth": 0.8} if k == 0 else {"linewidth": 0}
        usual |= {"height": 0.9 * height, "color": colour_on(ax, each.motion)}
        lane = motions.index(each.motion) + height * (k + 0.5) - 0.42
        ax.barh(lane, each.upper - each.lower, left=each.lower, **look_of(Patch, look, ("height",), **usual))
    name_rows(ax, motions, parameter or "")
    ax.tick_params(axis="y", length=0)
    ax.set_xlim(min(each.lower for _, each in rows), max(each.upper for _, each in rows))
    for edge in range(1, len(motions)):
        ax.axhline(edge - 0.5, color=BOUNDARY, linewidth=0.3)
    looks = {"facecolor": "#BBBBBB", "edgecolor": rim, "linewidth": 0.8, "alpha": 0.5}, {"facecolor": "#777777"}
    handles = [Patch(**looks[k > 0], label=name) for k, name in enumerate(sources)]
    add_legend(ax, handles, len(sources), loc="lower right", bbox_to_anchor=(1.0, 1.0))
    return ax


@checked
def motion_shares(shares: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The share of the starts that reaches each kind of motion, stacked over the parameter.

    One filled band, labelled with its name, for each motion.

    Examples
    --------
    >>> import gearpair as gp
    >>> shares = gp.ensembles.motion_shares(gp.Oscillator(), "damping_ratio", [0.1, 0.2], [0.0, 1.0], [0.0])
    >>> [band.get_label() for band in motion_shares(shares).collections]
    ['period 1']
    """
    ax = new_axes(ax)
    parameter = str(shares.share.dims[0])
    values, motions = shares[parameter].values, motions_of(shares)
    bands = shares.share.values.T
    colours = [colour_on(ax, motion) for motion in motions]
    area = look_of(PolyCollection, look, linewidth=0.4, edgecolor="white")
    ax.stackplot(values, bands, labels=list(map(str, motions)), colors=colours, **area)
    over_parameter(ax, parameter, values, axis_label("share"), ylim=(0, 1))
    if legend:
        add_motion_legend(ax, motions)
    return ax


@checked
def attractor_shares(result: xr.Dataset, ax: Axes | None = None, *, legend: bool = True, **look: Any) -> Axes:
    """The shares of the attractors along a parameter, stacked, with a triangle at each tipping point.

    One filled step for each attractor, cut where its kind of motion changes and coloured by it; above them one for the
    starts that are transients still; and a triangle at the top where an attractor has ended. Longer periods, which
    share one colour, are striped.

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
    kinds = [
        [Motion(str(status), int(period) or None) for status, period in zip(*columns, strict=True)]
        for columns in zip(result.attractor_status.values.T, result.attractor_period.values.T, strict=True)
    ]
    shares = [*np.nan_to_num(result.share.values.T), result.transient_share.values]
    below, present = np.zeros(len(values)), set()
    for share, own in zip(shares, [*kinds, [Motion(Status.TRANSIENT)] * len(values)], strict=True):
        above = below + share
        seen = [kind if more else None for kind, more in zip(own, share > 0.0, strict=True)]
        for kind, group in groupby(range(len(values)), seen.__getitem__):
            if kind is None:
                continue
            run = list(group)
            steps = np.repeat(edges[run[0] : run[-1] + 2], 2)[1:-1]
            usual: dict[str, Any] = {"edgecolor": "white", "linewidth": 0.4, "label": str(kind)}
            usual["hatch"] = "////" if legend_name(kind) == "other periods" else None  # brown beside the black of chaos
            ends = np.repeat(below[run], 2), np.repeat(above[run], 2)
            ax.fill_between(steps, *ends, **look_of(PolyCollection, look, facecolor=colour_on(ax, kind), **usual))
            present.add(kind)
        below = above
    for i in np.flatnonzero(np.any(result.tips_to.values != -1, axis=1)):
        mark: dict[str, Any] = {"marker": "v", "markersize": 4, "color": legible(ax, "black"), "clip_on": False}
        ax.plot(between[i - 1], 1.0, label="tipping point", **mark)
    over_parameter(ax, parameter, values, axis_label("share"), ylim=(0.0, 1.0))
    if legend:
        add_motion_legend(ax, present)
    return ax
