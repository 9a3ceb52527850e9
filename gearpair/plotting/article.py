"""The published tables: scores and motions of hypotheses about them, and the stiffness table beside computed ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from gearpair._checks import check_array, checked
from gearpair.article import published
from gearpair.article.case.existence import Reached
from gearpair.article.case.scoring import published_motions
from gearpair.article.case.search import TOLERANCES
from gearpair.article.case.trials import Ranked, Trial
from gearpair.article.published import StiffnessRow
from gearpair.article.readings import Hypothesis
from gearpair.plotting.paper import faint, legible, look_of
from gearpair.plotting.style import (
    BACKLASH,
    BOUNDARY,
    INK,
    book_style,
    colour_on,
    name_rows,
    new_axes,
    note,
    these_axes,
)
from gearpair.quantities import QUANTITIES, axis_label


@checked
def score_ranking(
    ranked: Sequence[Ranked], marked: Mapping[str, Hypothesis], ax: Axes | None = None, **look: Any
) -> Axes:
    """Mean and best score of every hypothesis, in their order, and the names of those `marked`.

    A bar from the mean to the best score for each.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> from gearpair.article.case import Protocol, ranking, run_trials
    >>> ranked = ranking(run_trials([PRINTED, SWAPPED], [Protocol("down")], 6))
    >>> [text.get_text() for text in score_ranking(ranked, {"swapped": SWAPPED}).texts]
    ['swapped']
    """
    ax = new_axes(ax, 2.6)
    places = np.arange(1, len(ranked) + 1)
    means, best = ([entry.mean for entry in ranked], [entry.best.total for entry in ranked])
    ax.vlines(places, means, best, color="#C9C3B8", linewidth=1.5)
    usual: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 2.5, "label": "mean over its diagrams"}
    ax.plot(places, means, **look_of(Line2D, look, color=legible(ax, INK), **usual))
    ax.plot(places, best, "_", markersize=4, color=BOUNDARY, label="its best diagram")
    for name, hypothesis in marked.items():
        for place, entry in zip(places, ranked, strict=True):
            if entry.hypothesis == hypothesis:
                arrow: dict[str, Any] = {"arrowstyle": "-", "color": BOUNDARY, "linewidth": 0.7}
                note(ax, name, (float(place), entry.best.total), (6, 8), fontsize=8.5, arrowprops=arrow)
    ax.set(xlabel="place", ylabel="score", xlim=(0, len(ranked) + 1), ylim=(0.0, 1.0))
    ax.legend(loc="upper right")
    return ax


@checked
def reached_motions(reached: Reached, ax: Axes | None = None, *, title: str = "", **look: Any) -> Axes:
    """Where each motion exists along a parameter, over the published ranges.

    A row for each published motion: an outlined box where it is published, a dot where it was reached.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> from gearpair.article.case import reached as motions_reached
    >>> ax = reached_motions(motions_reached([SWAPPED], "damping_ratio", 5)[0])
    >>> [label.get_text() for label in ax.get_yticklabels()]
    ['chaotic', 'period 3', 'period 1']
    """
    motions = list(dict.fromkeys(published_motions(reached.parameter)))
    ax = new_axes(ax, 0.7 + 0.3 * len(motions))
    ranges = published.ranges(reached.parameter)
    for row, motion in enumerate(motions):
        colour = colour_on(ax, motion)
        for stated in ranges:
            if stated.motion == motion:
                width = stated.upper - stated.lower
                ax.barh(row, width, left=stated.lower, height=0.8, color=colour, alpha=0.25, linewidth=0)
        here = reached.values[reached.has(motion)]
        usual: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 3.5, "color": colour}
        ax.plot(here, np.full(len(here), row), **look_of(Line2D, look, **usual))
    name_rows(ax, motions, reached.parameter)
    ax.set(xlim=(ranges[0].lower, ranges[-1].upper), title=title)
    return ax


@checked
def coverage_by_phase(
    frequency: Sequence[Reached], damping: Sequence[Reached], ax: Axes | None = None, **look: Any
) -> Axes:
    """The share of both published axes that each phase between forcing and stiffness can account for.

    What was reached along the two parameters is for the same hypotheses in the same order.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> from gearpair.article.case import reached
    >>> along = (reached([SWAPPED], p, 3, n_discarded=100) for p in ("mesh_frequency", "damping_ratio"))
    >>> ax = coverage_by_phase(*along)
    >>> [line.get_label() for line in ax.lines[:2]]
    ['frequency table', 'damping table']
    """
    ax = new_axes(ax, 2.4)
    for one, name, marker, style in ((frequency, "frequency table", "o", "-"), (damping, "damping table", "s", "--")):
        phases = [reached.hypothesis.phase for reached in one]
        usual: dict[str, Any] = {"marker": marker, "linestyle": style, "markersize": 3, "linewidth": 1.0}
        ax.plot(phases, [reached.coverage for reached in one], **look_of(Line2D, look, label=name, **usual))
    ax.axvline(0.0, color=BOUNDARY, linewidth=0.7)
    ax.set(xlabel="phase of the forcing (degrees)", ylabel="share accounted for", ylim=(0.0, 1.05))
    ax.set_xticks(range(-180, 181, 60))
    ax.legend(loc="upper right")
    return ax


@checked
def boundaries_by_step(trials: Sequence[Trial], axes: Sequence[Axes] | None = None, **look: Any) -> list[Axes]:
    """How far each published boundary is from the drawn one, against the steps a mesh period of fixed-step diagrams.

    One for each published boundary, with one line of dots for each way to sweep, and the tolerance as a band. Dots on
    the rim lie farther out; what a diagram does not have is not drawn.

    Parameters
    ----------
    trials : sequence of Trial
        Of `gearpair.article.case.run_trials`, with integrators of fixed steps.
    axes : sequence of eight Axes, optional
        A new figure without them.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> from gearpair.article.case import Protocol, run_trials
    >>> from gearpair.methods import Integrator
    >>> trials = run_trials([SWAPPED], [Protocol("restart", 50)], 6, [Integrator(steps=20)])
    >>> [ax.get_title().split(":")[0] for ax in boundaries_by_step(trials)]
    ['F2', 'F4', 'F6', 'F8', 'F10', 'F11', 'D2', 'D4']
    """
    if axes is None:
        with plt.style.context(book_style(**{"font.size": 8.0, "axes.labelsize": 8.0, "axes.titlesize": 8.5})):
            axes = list(plt.figure(figsize=(8.6, 4.2)).subplots(2, 4, sharex=True).flat)
    axes = these_axes(axes, 8)
    looks = {"restart": ("o", INK), "up": ("^", "#D55E00"), "down": ("v", "#009E73")}
    boundaries = published.FREQUENCY_BOUNDARIES + published.DAMPING_BOUNDARIES
    for ax, boundary in zip(axes, boundaries, strict=True):
        tolerance = TOLERANCES[boundary.parameter]
        ax.axhspan(-tolerance, tolerance, color=faint(ax, BACKLASH), zorder=-2, linewidth=0)
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
            usual: dict[str, Any] = {"linestyle": "", "marker": marker, "markersize": 3, "label": seeding}
            ax.plot(steps, away, **look_of(Line2D, look, color=legible(ax, colour), **usual))
        symbol = QUANTITIES[boundary.parameter].in_tex
        ax.set(xscale="log", ylim=(-1.1 * rim, 1.1 * rim), title=f"{boundary.item}: ${symbol}$ = {boundary.value:g}")
        ax.set_xticks([20, 50, 100, 200, 400], ["20", "50", "100", "200", "400"])
        ax.minorticks_off()
    for ax in axes[4:]:
        ax.set_xlabel("steps a mesh period")
    for ax in (axes[0], axes[4]):
        ax.set_ylabel("drawn minus published")
    axes[3].legend(loc="upper left", fontsize=7, handletextpad=0.1, borderaxespad=0.1)
    return list(axes)


@checked
def stiffness_trends(
    published: Sequence[StiffnessRow], computed: Mapping[str, Sequence[StiffnessRow]], axes: Sequence[Axes], **look: Any
) -> list[Axes]:
    """Contact ratio, a and b against the gear's teeth: what is published and what is computed.

    Each of the three axes has one line for the article, named first, and one for each entry of `computed` by its name.

    Examples
    --------
    >>> from matplotlib import pyplot as plt
    >>> from gearpair.article.published import STIFFNESS_TABLE
    >>> axes = stiffness_trends(STIFFNESS_TABLE, {}, plt.figure().subplots(1, 3))
    >>> axes[0].get_xticks().tolist(), axes[1].get_title()
    ([34, 44, 54], '$a$')
    """
    colours, axes = ("#D55E00", INK, "#009E73"), these_axes(axes, 3)
    for ax, name in zip(axes, ("contact_ratio", "a", "b"), strict=True):
        for k, (label, rows) in enumerate({"the article": published, **computed}.items()):
            teeth, values = [row.teeth_wheel for row in rows], [getattr(row, name) for row in rows]
            usual: dict[str, Any] = {"marker": "o", "linestyle": "-"} if k else {"marker": "s", "linestyle": "--"}
            usual |= {"markersize": 5, "color": legible(ax, colours[k % len(colours)]), "label": label}
            ax.plot(teeth, values, **look_of(Line2D, look, **usual))
        ax.set(xlabel="teeth of the gear $z_2$", title=axis_label(name))
        ax.set_xticks([row.teeth_wheel for row in published])
    return list(axes)


@checked
def contact_ratio_cloud(
    ratios: ArrayLike, published: Sequence[StiffnessRow], ax: Axes | None = None, **look: Any
) -> Axes:
    """Contact ratio of the first pair and its growth to the last: many tooth systems, and the article.

    One dot for each system and a star for the article.

    Parameters
    ----------
    ratios : array_like, shape (n, m)
        Contact ratios of n tooth systems at the m pairs of the article.
    published : sequence of StiffnessRow
        Those m pairs.

    Examples
    --------
    >>> from gearpair.article.published import STIFFNESS_TABLE
    >>> ax = contact_ratio_cloud([[1.6, 1.65, 1.7], [1.5, 1.55, 1.6]], STIFFNESS_TABLE)
    >>> len(ax.lines[0].get_xdata()), ax.lines[1].get_marker()
    (2, '*')
    """
    ax = new_axes(ax, 3.2)
    values = check_array("ratios", ratios)
    if values.ndim != 2 or values.shape[1] != len(published) or not values.size:
        raise ValueError(f"ratios must have a column for each of {len(published)} pairs, got shape {values.shape}")
    first, last = published[0], published[-1]
    usual: dict[str, Any] = {"linestyle": "", "marker": ".", "markersize": 3, "markeredgewidth": 0, "alpha": 0.45}
    dots = look_of(Line2D, look, color=legible(ax, INK), rasterized=True, **usual)
    ax.plot(values[:, 0], values[:, -1] - values[:, 0], **dots)
    ax.plot(first.contact_ratio, last.contact_ratio - first.contact_ratio, "*", markersize=13, color="#D55E00")
    handles = [
        Line2D([], [], linestyle="", marker="*", markersize=11, color="#D55E00", label="the article"),
        Line2D([], [], linestyle="", marker=".", markersize=6, color=dots["color"], label="tooth systems that can run"),
    ]
    ax.legend(handles=handles, loc="upper right")
    ax.axhline(0.0, color=BOUNDARY, linewidth=0.6)
    ax.set_xlabel(rf"contact ratio at $z_2 = {first.teeth_wheel}$")
    ax.set_ylabel(rf"growth to $z_2 = {last.teeth_wheel}$")
    return ax
