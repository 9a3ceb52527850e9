"""Hypotheses about the published tables: their scores, and the motions that they have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from gearpair.article import published
from gearpair.article.existence import Reached
from gearpair.article.readings import Hypothesis
from gearpair.article.scoring import published_motions
from gearpair.article.search import TOLERANCES
from gearpair.article.trials import Ranked, Trial
from gearpair.plotting.style import BACKLASH, BOUNDARY, INK, LABELS, STYLE, motion_colour, new_axes


def score_ranking(ranked: Sequence[Ranked], marked: Mapping[str, Hypothesis], ax: Axes | None = None) -> Axes:
    """Mean and best score of every hypothesis, in their order.

    Parameters
    ----------
    ranked : sequence of Ranked
        Of `gearpair.article.ranking`.
    marked : mapping of str to Hypothesis
        The ones to name.
    ax : Axes, optional

    Returns
    -------
    Axes
        With a bar from the mean to the best score for each.
    """
    ax = new_axes(ax, 2.6)
    places = np.arange(1, len(ranked) + 1)
    means, best = ([entry.mean for entry in ranked], [entry.best.total for entry in ranked])
    ax.vlines(places, means, best, color="#C9C3B8", linewidth=1.5)
    ax.plot(places, means, "o", markersize=2.5, color=INK, label="mean over its diagrams")
    ax.plot(places, best, "_", markersize=4, color=BOUNDARY, label="its best diagram")
    for name, hypothesis in marked.items():
        for place, entry in zip(places, ranked, strict=True):
            if entry.hypothesis == hypothesis:
                ax.annotate(
                    name, (place, entry.best.total), xytext=(6, 8), textcoords="offset points", fontsize=8.5,
                    arrowprops={"arrowstyle": "-", "color": BOUNDARY, "linewidth": 0.7},
                )  # fmt: skip
    ax.set(xlabel="place", ylabel="score", xlim=(0, len(ranked) + 1), ylim=(0.0, 1.0))
    ax.legend(loc="upper right")
    return ax


def reached_motions(reached: Reached, ax: Axes | None = None, *, title: str = "") -> Axes:
    """Where each motion exists along a parameter, over the published ranges.

    Parameters
    ----------
    reached : Reached
        Of `gearpair.article.reached`.
    ax : Axes, optional
    title : str

    Returns
    -------
    Axes
        A row for each published motion: an outlined box where it is published, a dot where it was reached.
    """
    motions = list(dict.fromkeys(published_motions(reached.parameter)))
    ax = new_axes(ax, 0.7 + 0.3 * len(motions))
    values = reached.values
    for row, motion in enumerate(motions):
        colour = motion_colour(motion)
        for stated in published.ranges(reached.parameter):
            if stated.motion == motion:
                width = stated.upper - stated.lower
                ax.barh(row, width, left=stated.lower, height=0.8, color=colour, alpha=0.25, linewidth=0)
        here = values[reached.has(motion)]
        ax.plot(here, np.full(len(here), row), "o", markersize=3.5, color=colour)
    ax.set_yticks(range(len(motions)), list(map(str, motions)))
    ranges = published.ranges(reached.parameter)
    ax.set(xlabel=LABELS[reached.parameter], xlim=(ranges[0].lower, ranges[-1].upper), ylim=(len(motions) - 0.5, -0.5))
    ax.set_title(title)
    return ax


def coverage_by_phase(frequency: Sequence[Reached], damping: Sequence[Reached], ax: Axes | None = None) -> Axes:
    """The share of both published axes that each phase between forcing and stiffness can account for.

    Parameters
    ----------
    frequency, damping : sequence of Reached
        Along the two parameters, for the same hypotheses in the same order.
    ax : Axes, optional

    Returns
    -------
    Axes
        With one curve for each axis.
    """
    ax = new_axes(ax, 2.4)
    for one, name, style in ((frequency, "frequency table", "o-"), (damping, "damping table", "s--")):
        phases = [reached.hypothesis.phase for reached in one]
        ax.plot(phases, [reached.coverage for reached in one], style, markersize=3, linewidth=1.0, label=name)
    ax.axvline(0.0, color=BOUNDARY, linewidth=0.7)
    ax.set(xlabel="phase of the forcing (degrees)", ylabel="share accounted for", ylim=(0.0, 1.05))
    ax.set_xticks(range(-180, 181, 60))
    ax.legend(loc="upper right")
    return ax


def boundaries_by_step(trials: Sequence[Trial], axes: Sequence[Axes] | None = None) -> list[Axes]:
    """How far each published boundary is from the drawn one, against the steps a mesh period of fixed-step diagrams.

    Parameters
    ----------
    trials : sequence of Trial
        Of `gearpair.article.run_trials`, with integrators of fixed steps.
    axes : sequence of eight Axes, optional
        A new figure without them.

    Returns
    -------
    list of Axes
        One for each published boundary, with one line of dots for each way to sweep, and the tolerance as a band. Dots
        on the rim lie farther out; what a diagram does not have is not drawn.
    """
    if axes is None:
        with plt.style.context({**STYLE, "font.size": 8.0, "axes.labelsize": 8.0, "axes.titlesize": 8.5}):
            axes = list(plt.figure(figsize=(8.6, 4.2)).subplots(2, 4, sharex=True).flat)
    looks = {"restart": ("o", INK), "up": ("^", "#D55E00"), "down": ("v", "#009E73")}
    boundaries = published.FREQUENCY_BOUNDARIES + published.DAMPING_BOUNDARIES
    for ax, boundary in zip(axes, boundaries, strict=True):
        tolerance = TOLERANCES[boundary.parameter]
        ax.axhspan(-tolerance, tolerance, color=BACKLASH, zorder=-2, linewidth=0)
        ax.axhline(0.0, color=BOUNDARY, linewidth=0.7)
        rim = 17.0 * tolerance
        for seeding, (marker, colour) in looks.items():
            drawn = [
                (trial.integrator.steps, match.distance)
                for trial in trials
                for match in (*trial.frequency.matches, *trial.damping.matches)
                if trial.integrator and trial.protocol.seeding == seeding and match.boundary == boundary
            ]
            steps = [n or 0 for n, distance in drawn if distance is not None]
            away = np.clip([distance for _, distance in drawn if distance is not None], -rim, rim)
            ax.plot(steps, away, linestyle="", marker=marker, markersize=3, color=colour, label=seeding)
        symbol = LABELS[boundary.parameter].split("$")[1]
        ax.set(xscale="log", ylim=(-1.1 * rim, 1.1 * rim), title=f"{boundary.item}: ${symbol}$ = {boundary.value:g}")
        ax.set_xticks([20, 50, 100, 200, 400], ["20", "50", "100", "200", "400"])
        ax.minorticks_off()
    for ax in axes[4:]:
        ax.set_xlabel("steps a mesh period")
    for ax in (axes[0], axes[4]):
        ax.set_ylabel("drawn minus published")
    axes[3].legend(loc="upper left", fontsize=7, handletextpad=0.1, borderaxespad=0.1)
    return list(axes)
