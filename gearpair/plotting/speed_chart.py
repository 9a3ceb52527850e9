"""Pictures of a drive over its speeds."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from gearpair._checks import check_count, check_number, check_reach, checked
from gearpair.design import IdleRattle, IsoDynamicFactor
from gearpair.design.found import BOTH, FLOAT, HISTORY, KEPT, LOSSES, RARE
from gearpair.design.sensitivities import OUTCOMES
from gearpair.plotting.maps import ENDS, HEIGHT, IMPACT_COLOURS, impact_colours, name_colours
from gearpair.plotting.paper import legible, look_of, paper
from gearpair.plotting.style import INK, add_legend, new_axes, note, over_parameter, these_axes
from gearpair.quantities import axis_label

# Lines need more contrast than areas: contact kept, lost on one side, both flanks struck.
STATE_INK: Mapping[str, str] = {
    **dict.fromkeys(("none_drive", "none_coast"), "#1F3A5F"),
    **dict.fromkeys(("single_drive", "single_coast"), "#D55E00"),
    "double": "#54278F",
}
OTHER_INK = "#8C8577"
GREY = "#9A9A9A"
SERVICE = "#3E7A3E"  # speeds that the drive runs at
BAND = "#E9E4DA"  # over the phases
LEAP = 0.25  # change from one speed to the next, of the largest factor, that is drawn as a jump, located or not
STEP = 0.1  # likewise, from which on a located jump has an arrow
LANE = 0.36  # height of a bar of a tornado, whose rows are 1 apart
STRIP = 0.07  # height of a run's strip of impact states, in shares of the axes
# What is outlined in a map of loads, from which loss of contact on, and how; and what is dotted.
OUTLINES: Mapping[str, tuple[str, Any]] = {
    "the teeth may part": (FLOAT, "-"),
    "both flanks are struck": (BOTH, (0, (4.0, 1.2))),
}
IN_SOME = {RARE, HISTORY}
CHANGES: Mapping[str, str] = {
    "pinion_torque_nm": "torque",
    "backlash_um": "backlash",
    "transmission_error_um": "transmission error",
    "damping_ratio": "damping ratio",
    "addendum": "addendum",
}
UNITS = {"pinion_torque_nm": "N m", "backlash_um": "µm", "transmission_error_um": "µm", "addendum": "modules"}


@checked
def dynamic_factors(
    chart: xr.Dataset,
    iso: IsoDynamicFactor | None = None,
    ax: Axes | None = None,
    *,
    jumps: bool = True,
    service_rpm: Sequence[float] | None = None,
    pinion_teeth: int | None = None,
    **look: Any,
) -> Axes:
    """The dynamic factor over the speed, run up and down, with jumps, impact states, and what is usually taken.

    One line for each run, and strips of the impact states above it. Where the phase of the transmission error is
    unknown, the runs are at the worst, which the legend names, and a band behind them shows the largest factor over all
    phases.

    Parameters
    ----------
    iso : IsoDynamicFactor, optional
        Drawn in grey beside the linear response.
    jumps : bool
        Mark and name the located jumps.
    service_rpm : sequence of float, optional
        The lowest and the highest speed of service, to be marked.
    pinion_teeth : int, optional
        For a second axis, of the mesh frequency in hertz.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, pinion_speed_rpm=3000.0,
    ...     backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.08)
    >>> ax = dynamic_factors(gp.design.speed_chart(drive, [2000.0, 4000.0], n_starts=2))
    >>> [text.get_text() for text in ax.get_legend().get_texts()]
    ['linear response', 'any phase, worst 90°', 'run up', 'run down']
    """
    ax = new_axes(ax, 4.6)
    speed = chart.speed.values
    factor = chart.dynamic_factor
    top = float(np.nanmax(chart.factor_high.values, initial=1.2))
    top = top if iso is None else float(np.nanmax(iso.k_v, initial=top))
    linear = chart.linear_factor.values  # cut off where the strips begin
    linear = np.where(linear < 0.8 + (top - 0.8) * 1.12, linear, np.nan)
    ax.plot(speed, linear, color=GREY, linewidth=1.0, label="linear response", zorder=1)
    if iso is not None:
        ax.plot(iso.speed_rpm, iso.k_v, color=GREY, linestyle=(0, (5, 2)), linewidth=1.3, label="ISO 6336-1, $K_v$")
    if chart.attrs["error_phase"] == "unknown":
        named = f"any phase, worst {np.degrees(chart.attrs['run_phase_rad']):.0f}°"
        ax.fill_between(speed, chart.factor_low, chart.factor_high, color=BAND, linewidth=0, label=named, zorder=0)
    else:
        _mark_worst(ax, chart)
    for run, style, width in (("up", "-", 1.8), ("down", (0, (2.5, 1.2)), 1.4)):
        values, states = factor.sel(run=run).values, chart.impact_state.sel(run=run).values
        located = np.isfinite(chart.jump_speed.sel(run=run).values)
        line = look_of(Line2D, look, linestyle=style, linewidth=width)
        ax.plot([], [], **{"color": legible(ax, INK), **line, "label": f"run {run}"})
        _by_state(ax, speed, values, states, located[1:] if run == "up" else located[:-1], line)
    if jumps:
        _mark_jumps(ax, chart)
    over_parameter(ax, "speed", speed, axis_label("dynamic_factor"))
    ax.set_ylim(0.8, 0.8 + (top - 0.8) * 1.35)
    if service_rpm is not None:
        _mark_service(ax, service_rpm)
    if pinion_teeth is not None:
        _mesh_hertz(ax, check_count("pinion_teeth", pinion_teeth))
    _strips(ax, chart)
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.02), "borderaxespad": 0.0}
    add_legend(ax, columns=5, handlelength=2.2, fontsize=8, **place)
    return ax


def _mesh_hertz(ax: Axes, teeth: int) -> None:
    """A second axis below, the mesh frequency in hertz."""
    per_rpm = teeth / 60.0
    below = ax.secondary_xaxis(-0.16, functions=(partial(np.multiply, per_rpm), partial(np.multiply, 1.0 / per_rpm)))
    below.set_xlabel("mesh frequency (Hz)", fontsize=ax.xaxis.label.get_fontsize(), color=ax.xaxis.label.get_color())
    like = ax.get_xticklabels()[0]
    below.tick_params(labelsize=like.get_fontsize(), labelcolor=like.get_color())


def _mark_service(ax: Axes, service_rpm: Sequence[float]) -> None:
    """Shade and name the speeds of service."""
    low, high = check_reach("service_rpm", service_rpm)
    ax.axvspan(low, high, color=SERVICE, alpha=0.13, linewidth=0, zorder=-1)
    looks: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "va": "bottom", "fontsize": 8}
    looks["bbox"] = {"facecolor": ax.get_facecolor(), "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
    note(ax, "in service", (max(low, ax.get_xlim()[0]), 0.0), (4, 3), color=legible(ax, SERVICE), **looks)


def _mark_worst(ax: Axes, chart: xr.Dataset) -> None:
    """Circles where a start found a worse motion than either run."""
    runs, worst = chart.dynamic_factor.sel(run=["up", "down"]).values, chart.dynamic_factor.sel(run="worst").values
    other = ~np.isclose(runs, worst, rtol=1e-6, equal_nan=True).any(axis=0)
    if other.any():
        looks: dict[str, Any] = {"markersize": 3, "markerfacecolor": "none", "color": legible(ax, OTHER_INK)}
        ax.plot(chart.speed.values[other], worst[other], "o", label="worst found from other starts", **looks)


def _by_state(
    ax: Axes, speed: np.ndarray, values: np.ndarray, states: np.ndarray, located: np.ndarray, line: Mapping[str, Any]
) -> None:
    """A line that is broken where the run jumps, coloured by the impact state at each speed's left end."""
    jump = located | (np.abs(np.diff(values)) > LEAP * np.nanmax(values))
    first = 0
    for i in range(1, len(speed) + 1):
        if i < len(speed) and states[i] == states[first] and not jump[i - 1]:
            continue
        last = i + 1 if i < len(speed) and not jump[i - 1] else i  # as far as the next piece, unless the run jumps
        colour = legible(ax, STATE_INK.get(str(states[first]), OTHER_INK))
        own = {"color": colour, "zorder": 3, "solid_capstyle": "butt", **line, "label": None}
        ax.plot(speed[first:last], values[first:last], **own)
        first = i


def _mark_jumps(ax: Axes, chart: xr.Dataset) -> None:
    """An arrow from the motion that a run leaves to the one it goes to, with the speed beside it."""
    grey = legible(ax, "#333333")
    for run, before, shift, ha in (("up", -1, 4, "left"), ("down", 1, -4, "right")):
        values, jumps = (chart[name].sel(run=run).values for name in ("dynamic_factor", "jump_speed"))
        for i in np.flatnonzero(np.isfinite(jumps)):
            at, start, end = jumps[i], values[i + before], values[i]
            if not abs(end - start) > STEP * np.nanmax(values):
                continue
            arrow: dict[str, Any] = {"arrowstyle": "-|>", "color": grey, "linewidth": 0.9}
            ax.annotate("", (at, end), (at, start), arrowprops=arrow)
            if run == "up" and abs(end - start) < LEAP * np.nanmax(values):
                continue  # the branch that a small jump up leads to lies where its number would stand
            middle = (at, 0.5 * (start + end))
            look: dict[str, Any] = {"fontsize": 8, "ha": ha, "va": "center", "color": grey}
            halo = withStroke(linewidth=2.0, foreground=ax.get_facecolor())
            note(ax, f"{at:.0f}", middle, (shift, 0), path_effects=[halo], **look)


def _strips(ax: Axes, chart: xr.Dataset) -> None:
    """The impact state of each run as a strip along the top."""
    speed = chart.speed.values
    edges = np.concatenate([speed[:1], 0.5 * (speed[1:] + speed[:-1]), speed[-1:]])
    for k, run in enumerate(("up", "down")):
        bottom = 1.0 - (k + 1) * STRIP
        for left, right, state in zip(edges[:-1], edges[1:], chart.impact_state.sel(run=run).values, strict=True):
            colour = IMPACT_COLOURS[str(state)]
            ax.axvspan(left, right, bottom, bottom + 0.85 * STRIP, color=colour, linewidth=0, zorder=4)
        ax.text(
            0.004, bottom + 0.4 * STRIP, f"run {run}", transform=ax.transAxes, fontsize=7, va="center", color="#333333",
            zorder=5,
        )  # fmt: skip
    present = impact_colours(chart.impact_state.sel(run=["up", "down"]).values)
    under = (1.0, 1.0 - 2 * STRIP)
    key = name_colours(ax, present, loc="upper right", bbox_to_anchor=under, fontsize=7.5, columns=len(present))
    ax.add_artist(key)


@checked
def tooth_loads(chart: xr.Dataset, axes: Sequence[Axes], **look: Any) -> list[Axes]:
    """What the teeth bear over the speed: the dynamic transmission error, and impacts, of both runs.

    Examples
    --------
    >>> import gearpair as gp
    >>> from matplotlib import pyplot as plt
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, pinion_speed_rpm=3000.0,
    ...     backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.08)
    >>> chart = gp.design.speed_chart(drive, [2000.0, 4000.0], n_starts=2)
    >>> [ax.get_ylabel() for ax in tooth_loads(chart, tuple(plt.figure().subplots(1, 2)))]
    ['dynamic transmission error, rms (µm)', 'largest impact velocity (mm/s)']
    """
    left, right = axes = these_axes(axes, 2)
    speed = chart.speed.values
    left.plot(speed, chart.linear_rms.values, color=GREY, linewidth=1.0, label="linear response")
    for run, style in (("up", "-"), ("down", (0, (2.5, 1.2)))):
        chosen = chart.sel(run=run)
        line = look_of(Line2D, look, color=legible(left, INK), linestyle=style, label=f"run {run}")
        left.plot(speed, chosen.dte_rms.values, **line)
        right.plot(speed, chosen.impact_velocity.values, **line)
    for ax, shown in zip(axes, ("dte_rms", "impact_velocity"), strict=True):
        over_parameter(ax, "speed", speed, axis_label(shown), ylim=(0.0, None))
    left.legend()
    return axes


@checked
def load_map(found: xr.Dataset, ax: Axes | None = None, *, largest: float | None = None, **look: Any) -> Axes:
    """The largest dynamic factor over speed and torque, and outlines of where the teeth part, or strike both flanks.

    An image and its colour bar, logarithmic, a collection of lines for each outline, and dots where the teeth part in
    some of the motions alone. A point without a torque has no factor and stays blank.

    Parameters
    ----------
    found : xarray.Dataset
        Of `gearpair.design.load_map`.
    largest : float, optional
        Where the colours end, above 1; the largest factor when not given.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.08)
    >>> ax = load_map(gp.design.load_map(drive, [50.0, 100.0], [2000.0, 4000.0, 6000.0], n_starts=2))
    >>> ax.get_ylabel(), [text.get_text() for text in ax.get_legend().get_texts()]
    ('torque of the pinion (N m)', ['the teeth may part'])
    """
    ax = new_axes(ax, HEIGHT)
    speed, torque, factor = found.speed.values, found.torque.values, found.dynamic_factor.values
    top = max(float(np.nanmax(factor, initial=1.0)), 1.1)
    top = top if largest is None else check_number("largest", largest, above=1.0)
    image = look_of(QuadMesh, look, ENDS, cmap="cividis", norm=LogNorm(1.0, top), rasterized=True)
    shown = ax.pcolormesh(speed, torque, factor, shading="nearest", **image)
    bar = ax.figure.colorbar(shown, ax=ax, label=axis_label("dynamic_factor"), pad=0.01)
    ticks = [each for each in (1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50, 100) if each <= top]
    bar.set_ticks(ticks, labels=[f"{each:g}" for each in ticks], minor=False)
    bar.minorticks_off()
    _outline_losses(ax, found.loss.values, speed, torque)
    ax.set(xlabel=axis_label("speed"), ylabel=axis_label("torque"))
    return ax


def _outline_losses(ax: Axes, losses: np.ndarray, speed: np.ndarray, torque: np.ndarray) -> None:
    """Lines about the points of a map at which contact is lost, dots where it is in some of the motions there."""
    order = (KEPT, *LOSSES)
    kinds = np.array([[order.index(loss) for loss in row] for row in losses.tolist()])
    ink, around = legible(ax, INK), [withStroke(linewidth=2.9, foreground=paper(ax))]
    handles = []
    for name, (first, style) in OUTLINES.items():
        lost = kinds >= order.index(first)
        if lost.any():
            line: dict[str, Any] = {"color": ink, "linestyle": style, "linewidth": 1.3, "label": name}
            ax.add_collection(LineCollection(_borders(lost, speed, torque), path_effects=around, **line))
            handles.append(Line2D([], [], **line))
    rows, columns = np.nonzero(np.isin(losses, [*IN_SOME]))
    if len(rows):
        dots: dict[str, Any] = {"marker": "o", "markersize": 3.2, "markerfacecolor": ink, "linestyle": ""}
        dots |= {"markeredgecolor": paper(ax), "markeredgewidth": 0.6, "label": "in some of several motions"}
        handles += ax.plot(speed[columns], torque[rows], **dots)
    if handles:
        place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.3}
        add_legend(ax, handles, 3, fontsize=8, columnspacing=1.2, **place)


def _borders(inside: np.ndarray, x: np.ndarray, y: np.ndarray) -> list[list[tuple[float, float]]]:
    """The sides of the cells of a map, its points in their middles, at which what is inside ends."""
    between = [(each, 0.5 * (each[1:] + each[:-1])) for each in (x, y)]
    columns, rows = (np.array([2 * v[0] - m[0], *m, 2 * v[-1] - m[-1]]).tolist() for v, m in between)
    sides = [
        [(columns[j + 1], rows[i]), (columns[j + 1], rows[i + 1])]
        for i, j in np.argwhere(inside[:, 1:] != inside[:, :-1]).tolist()
    ]
    sides += [
        [(columns[j], rows[i + 1]), (columns[j + 1], rows[i + 1])]
        for i, j in np.argwhere(inside[1:] != inside[:-1]).tolist()
    ]
    return sides


def _with_unit(name: str) -> str:
    told = CHANGES.get(name, name)
    return f"{told} ({UNITS[name]})" if name in UNITS else told


@checked
def tornado(
    found: xr.Dataset,
    outcome: str = "dynamic_factor",
    ax: Axes | None = None,
    *,
    sort_by: str | None = None,
    **look: Any,
) -> Axes:
    """What each change does to the worst of the speed range: a bar for each of its two ends, the strongest on top.

    Parameters
    ----------
    outcome : {"dynamic_factor", "mesh_force", "time_apart", "impact_range"}
    sort_by : str, optional
        The outcome that the bars are sorted by, `outcome` itself when not given.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, pinion_speed_rpm=3000.0,
    ...     backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.08)
    >>> ax = tornado(gp.design.sensitivity(drive, [2000.0, 3000.0], {"damping_ratio": (0.04, 0.16)}))
    >>> [label.get_text() for label in ax.get_yticklabels()], len(ax.patches)
    (['damping ratio'], 2)
    """
    ax = new_axes(ax, 2.6)
    values, base = found[outcome].values.round(9), round(float(found[f"base_{outcome}"]), 9)  # 1e-15 is none
    sorting = sort_by or outcome
    order = np.argsort(np.abs(found[sorting].values - float(found[f"base_{sorting}"])).max(axis=1).round(9))
    ends = {"lower": "#56B4E9", "higher": "#E69F00"}
    for place, k in enumerate(order):
        for end, colour in enumerate(ends.values()):
            lane = place + (0.5 - end) * LANE  # each end has its own, for both may lie on one side of the base
            bar = look_of(Patch, look, ("height",), height=LANE, color=colour, zorder=2)
            ax.barh(lane, values[k, end] - base, left=base, **bar)
            beyond = values[k, end] - base > -1e-9 * base  # or the same, up to rounding
            shift, ha = (3, "left") if beyond else (-3, "right")
            told = f"{found.value.values[k, end]:.5g}"
            note(ax, told, (values[k, end], lane), (shift, 0), fontsize=7, va="center_baseline", ha=ha)
    ax.axvline(base, color=legible(ax, "#333333"), linewidth=0.9, zorder=3)
    names = [str(found.change.values[k]) for k in order]
    ax.set_yticks(range(len(names)), [_with_unit(name) for name in names])
    ax.set_xlabel(axis_label(OUTCOMES[outcome]))
    ax.margins(x=0.12)
    handles = [Patch(color=colour, label=name) for name, colour in ends.items()]
    add_legend(ax, handles, 2, loc="lower right", bbox_to_anchor=(1.0, 1.0))
    return ax


@checked
def rattle(found: IdleRattle, ax: Axes | None = None, **look: Any) -> Axes:
    """Impacts of an idle gear over the speed, and where its inertia torque exceeds the drag.

    Examples
    --------
    >>> import gearpair as gp
    >>> drive = gp.GearDrive.from_pair(gp.SpurPair(), pinion_torque_nm=100.0, pinion_speed_rpm=3000.0,
    ...     backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.08)
    >>> found = gp.design.idle_rattle(drive, [300.0, 1500.0], order=2.0, pinion_swing_deg=0.05, drag_torque_nm=0.4)
    >>> rattle(found).get_ylabel()
    'largest impact velocity (mm/s)'
    """
    ax = new_axes(ax, 2.8)
    ax.plot(found.speed_rpm, found.impact_velocity, **look_of(Line2D, look, color=legible(ax, INK)))
    over_parameter(ax, "speed", found.speed_rpm, axis_label("impact_velocity"), ylim=(0.0, None))
    quiet = found.rattle_ratio < 1.0
    if quiet.any() and not quiet.all():
        onset = float(np.interp(1.0, found.rattle_ratio, found.speed_rpm))
        ax.axvline(onset, color=GREY, linestyle=(0, (5, 2)), linewidth=1.0)
        grey = legible(ax, "#555555")
        looks: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "va": "top", "fontsize": 8, "color": grey}
        note(ax, "inertia torque = drag", (onset, 1.0), (4, -4), **looks)
    return ax
