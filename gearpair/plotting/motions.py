"""Pictures of one motion, and of several side by side."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.typing import ColorType

from gearpair._checks import check_choice, check_count, check_number, checked
from gearpair.bifurcations.orbits import PeriodicOrbit
from gearpair.motion.spectra import Spectrum
from gearpair.motion.spectra import spectrum as spectrum_of
from gearpair.motion.steady import SteadyState
from gearpair.motion.trajectories import Trajectory, trajectory
from gearpair.plotting.paper import legible, look_of, paper
from gearpair.plotting.style import BOUNDARY, INK, book_style, colour_on, new_axes, shade_backlash, these_axes
from gearpair.quantities import QUANTITIES, axis_label

SHOWN_PERIODS = 8  # mesh periods of a time history
SPECTRUM_PERIODS = 240  # at least so many mesh periods under a spectrum
CHAOS_PERIODS = 4000  # and so many under the section of a chaotic motion
LOWEST_LINE = 1e-5  # amplitudes below are rounding, not motion
VIEWS = ("time history", "phase portrait", "Poincaré section", "spectrum")


@checked
def time_history(
    motion: Trajectory, ax: Axes | None = None, *, n_periods: int | None = None, impacts: bool = True, **look: Any
) -> Axes:
    """X over time, with a dot at each contact made.

    Parameters
    ----------
    n_periods : int, optional
        Mesh periods shown, from the first; all without it.
    impacts : bool
        Mark where teeth come into contact.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = time_history(gp.trajectory(gp.Oscillator(), 1.0, 0.0, 2))
    >>> ax.get_ylabel(), [float(end) for end in ax.get_xlim()]
    ('displacement $X$', [0.0, 2.0])
    """
    ax = new_axes(ax)
    last, made = _first_periods(motion, n_periods)
    tau = motion.tau[:last] / motion.oscillator.mesh_period
    shade_backlash(ax, horizontal=True)
    curve = look_of(Line2D, look, color=legible(ax, INK))
    ax.plot(tau, motion.x[:last], **curve)
    if impacts:
        across = motion.impacts.tau[made] / motion.oscillator.mesh_period
        _contact_dots(ax, across, motion.impacts.side[made], curve["color"])
    ax.set(xlabel=axis_label("tau"), ylabel=axis_label("x"), xlim=(0.0, tau[-1]))
    return ax


def _first_periods(motion: Trajectory, n_periods: int | None) -> tuple[int, np.ndarray]:
    """How many samples the first periods are, and which impacts of theirs make contact."""
    shown = None if n_periods is None else check_count("n_periods", n_periods)
    last = motion.samples_per_period * shown + 1 if shown else len(motion.tau)
    return last, motion.impacts.contact & (motion.impacts.tau <= motion.tau[:last][-1])


def _contact_dots(ax: Axes, across: np.ndarray, up: np.ndarray, colour: ColorType) -> None:
    ax.plot(
        across.astype(float), up.astype(float), "o", markersize=3.2, markerfacecolor=paper(ax), markeredgecolor=colour,
        markeredgewidth=0.9, label="contact made",
    )  # fmt: skip


@checked
def phase_portrait(
    motion: Trajectory, ax: Axes | None = None, *, n_periods: int | None = None, impacts: bool = True, **look: Any
) -> Axes:
    """X' over X, the strip out of contact shaded, a dot at each contact made; see `time_history`.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = phase_portrait(gp.trajectory(gp.Oscillator(), 1.0, 0.0, 2))
    >>> ax.get_xlabel(), ax.get_ylabel()
    ('displacement $X$', "velocity $X'$")
    """
    ax = new_axes(ax, 5.0)
    last, made = _first_periods(motion, n_periods)
    shade_backlash(ax, horizontal=False)
    curve = look_of(Line2D, look, color=legible(ax, INK), linewidth=1.2 if last < 2000 else 0.35)
    ax.plot(motion.x[:last], motion.v[:last], **curve)
    if impacts:
        _contact_dots(ax, motion.impacts.side[made], motion.impacts.velocity[made], curve["color"])
    ax.set(xlabel=axis_label("x"), ylabel=axis_label("v"))
    return ax


@checked
def poincare_section(
    motion: Trajectory | SteadyState | PeriodicOrbit,
    ax: Axes | None = None,
    *,
    size: float | None = None,
    **look: Any,
) -> Axes:
    """X' over X once per base period, at ``tau mod T = 0``; dots of `size` points, or as their number suggests.

    Of a settled motion or an orbit, the section points that it holds.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = poincare_section(gp.trajectory(gp.Oscillator(), 1.0, 0.0, 20))
    >>> len(ax.lines[0].get_xdata())  # the start, and the end of each period
    21
    """
    ax = new_axes(ax, 5.0)
    if isinstance(motion, Trajectory):
        x, v = motion.section.T
    else:
        x, v = motion.points.T
    few = len(np.unique(np.round(np.stack([x, v]), 6), axis=1).T) <= 64
    size = size or (5.0 if few else 1.0)
    usual: dict[str, Any] = {"linestyle": "", "marker": "o", "markeredgewidth": 0, "markersize": size}
    ax.plot(x, v, **look_of(Line2D, look, color=legible(ax, INK), rasterized=not few, **usual))
    ax.set(xlabel=axis_label("x"), ylabel=axis_label("v"))
    return ax


@checked
def spectrum(
    lines: Spectrum, ax: Axes | None = None, *, period: int | None = None, highest: float = 3.0, **look: Any
) -> Axes:
    """The amplitude spectrum of X on a logarithmic scale; multiples of ``1 / period`` of the mesh frequency ruled.

    Parameters
    ----------
    period : int, optional
        In mesh periods, where the motion is periodic: then lines are drawn, otherwise a curve.
    highest : float
        Where the axis ends, in units of the mesh frequency.

    Examples
    --------
    >>> import gearpair as gp
    >>> ax = spectrum(gp.spectrum(gp.trajectory(gp.Oscillator(), 1.0, 0.0, 8)), period=2)
    >>> ax.get_ylabel(), ax.get_yscale()
    ('amplitude', 'log')
    """
    highest, ax = check_number("highest", highest, above=0.0), new_axes(ax)
    if period is not None:
        check_count("period", period)
    shown = (lines.frequency > 0.0) & (lines.frequency <= highest)
    frequency, amplitude = lines.frequency[shown], lines.amplitude[shown]
    for k in range(1, int(highest * (period or 1)) + 1):
        ax.axvline(k / (period or 1), color=BOUNDARY, linewidth=0.5, alpha=0.45, linestyle=(0, (1, 2)), zorder=-1)
    if period:
        real = amplitude > LOWEST_LINE
        dots = look_of(Line2D, look, color=legible(ax, INK), linestyle="", marker="o", markersize=2.6)
        stem = dots["color"], dots.get("linewidth", 1.2)
        ax.vlines(frequency[real], LOWEST_LINE, amplitude[real], color=stem[0], linewidth=stem[1])
        ax.plot(frequency[real], amplitude[real], **dots)
    else:
        ax.plot(frequency, amplitude, **look_of(Line2D, look, color=legible(ax, INK), linewidth=0.6))
    ax.set_yscale("log")
    ax.set(xlabel=axis_label("frequency"), ylabel="amplitude", xlim=(0, highest + 0.1), ylim=(LOWEST_LINE, 10.0))
    ax.set_xticks(range(int(highest) + 1))
    return ax


@checked
def portrait(state: SteadyState, axes: Sequence[Axes] | None = None, *, title: str = "", **look: Any) -> list[Axes]:
    """A settled motion in four views: time history, phase portrait, Poincaré section, spectrum.

    Parameters
    ----------
    state : SteadyState
        Of `gearpair.steady_state`, bounded.
    axes : sequence of four Axes, optional
        A new figure without them.
    title : str
        Stands above the first.

    Examples
    --------
    >>> import gearpair as gp
    >>> [ax.get_ylabel() for ax in portrait(gp.steady_state(gp.Oscillator()))]
    ['displacement $X$', "velocity $X'$", "velocity $X'$", 'amplitude']
    """
    if axes is None:
        with plt.style.context(book_style()):
            axes = list(plt.figure(figsize=(8.0, 5.4)).subplots(2, 2).flat)
    axes = these_axes(axes, 4)
    period, look = state.period, {"color": colour_on(axes[0], state.motion), **look_of(Line2D, look)}
    osc, whole = state.oscillator, state.oscillator.mesh_periods
    cycle = period * whole if period else None  # in mesh periods
    n_periods = period * -(-SPECTRUM_PERIODS // cycle) if period and cycle else osc.base_periods(CHAOS_PERIODS)
    x, v = map(float, state.points[0])
    motion = trajectory(osc, x, v, n_periods)
    time_history(motion, axes[0], n_periods=max(SHOWN_PERIODS, whole), **look)
    phase_portrait(motion, axes[1], n_periods=cycle or max(60, whole), impacts=period is not None, **look)
    shade_backlash(axes[2], horizontal=False)
    poincare_section(motion, axes[2], **look)
    axes[2].set(xlim=axes[1].get_xlim(), ylim=axes[1].get_ylim())
    spectrum(spectrum_of(motion, window="boxcar" if period else "hann"), axes[3], period=cycle, **look)
    axes[0].set_title(title, loc="left")
    return list(axes)


@checked
def gallery(states: Mapping[Any, SteadyState], *, parameter: str = "mesh_frequency", **look: Any) -> Figure:
    """Settled motions under one another, each a row of the four views of `portrait`.

    Parameters
    ----------
    states : mapping of Motion or str to SteadyState
        At least one, by name, as `gearpair.ensembles.representatives` gives them.
    parameter : str
        Whose value is told beside the name.

    Examples
    --------
    >>> import gearpair as gp
    >>> figure = gallery({"period 2": gp.steady_state(gp.Oscillator())})
    >>> [ax.get_title(loc="right") for ax in figure.axes[1:]]
    ['phase portrait', 'Poincaré section', 'spectrum']
    """
    if not states:
        raise ValueError("states must hold at least one motion, got none")
    with plt.style.context(book_style(**{"font.size": 8.0, "axes.labelsize": 8.0})):
        figure = plt.figure(figsize=(8.6, 0.5 + 1.75 * len(states)))
        grid = figure.subplots(len(states), len(VIEWS), squeeze=False)
        check_choice("parameter", parameter, [name for name in QUANTITIES if QUANTITIES[name].in_tex])
        for row, (name, state) in zip(grid, states.items(), strict=True):
            symbol = QUANTITIES[parameter].in_tex
            title = f"{name}  (${symbol} = {state.oscillator.parameter(parameter):.4g}$)"
            portrait(state, row, title=title, **look)
        for ax, view in zip(grid[0][1:], VIEWS[1:], strict=True):
            ax.set_title(view, weight="normal", loc="right")
        for ax in grid[:-1].flat:
            ax.set_xlabel("")
    return figure
