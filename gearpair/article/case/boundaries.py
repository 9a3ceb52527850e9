"""The published boundaries beside bifurcations and beside the boundaries that readings draw."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from gearpair.article import published
from gearpair.article.case.scoring import FARTHEST, axis
from gearpair.article.case.trials import Trial
from gearpair.article.published import Boundary
from gearpair.article.readings import Hypothesis
from gearpair.bifurcations.branch_search import find_branches
from gearpair.bifurcations.locating import Bifurcation
from gearpair.table import Table


def nearest(stated: float, bifurcations: Iterable[Bifurcation]) -> Bifurcation | None:
    """The fold or flip nearest to a stated value; grazings change no motion by themselves.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> branch = continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)
    >>> nearest(0.8, branch.bifurcations).kind
    'flip'
    """
    changes = [b for b in bifurcations if b.kind != "grazing"]
    return min(changes, key=lambda b: abs(b.value - stated), default=None)


def named_bifurcation(boundary: Boundary, bifurcations: Iterable[Bifurcation]) -> Bifurcation | None:
    """The bifurcation nearest to a published boundary, of the kind that the article names there.

    A period doubling is a flip of the period below the boundary, a halving one of the period above, a saddle-node a
    fold of the period below; where the article names nothing, any fold or flip will do.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> branch = continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)
    >>> [boundary] = [b for b in published.boundaries("mesh_frequency") if b.item == "F4"]
    >>> named_bifurcation(boundary, branch.bifurcations).period, boundary.event
    (2, 'period doubling')
    """
    ranges = published.ranges(boundary.parameter)
    place = published.boundaries(boundary.parameter).index(boundary)
    below, above = (ranges[k].motion.period for k in (place, place + 1))
    named = {
        "period doubling": ("flip", below), "period halving": ("flip", above), "saddle-node or similar": ("fold", below)
    }.get(boundary.event or "")  # fmt: skip
    there = (b for b in bifurcations if b.parameter == boundary.parameter)
    return nearest(boundary.value, [b for b in there if named in (None, (b.kind, b.period))])


def boundary_table(trials: Mapping[str, Sequence[Trial]], bifurcations: Mapping[str, Sequence[Bifurcation]]) -> Table:
    """Every published boundary: where several readings draw it, and how far their bifurcation of the named kind lies.

    Parameters
    ----------
    trials : mapping of str to sequence of Trial
        By reading; the nearest boundary between the same two motions in any of its diagrams counts.
    bifurcations : mapping of str to sequence of Bifurcation
        By reading; the one of the kind that the article names, if within a tenth of the axis.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> from gearpair.article.case import Protocol, run_trials
    >>> boundary_table({"swapped": run_trials([SWAPPED], [Protocol("down")], 6)}, {"swapped": []}).columns[3:]
    ('drawn, swapped', 'bifurcation, swapped')
    """
    rows = []
    for boundary in published.FREQUENCY_BOUNDARIES + published.DAMPING_BOUNDARIES:
        digits = 3 if boundary.parameter == "mesh_frequency" else 5
        lower, upper = axis(boundary.parameter, 2)
        drawn = [drawn_boundary(each, boundary) for each in trials.values()]
        cells = ["–" if value is None else f"{value:.{digits}f}" for value in drawn]
        for each in bifurcations.values():
            b = named_bifurcation(boundary, each)
            if b is None or abs(b.value - boundary.value) > FARTHEST * (upper - lower):
                cells.append("–")
            else:
                cells.append(f"{b.kind} of period {b.period} ({b.value - boundary.value:+.{digits + 1}f})")
        rows.append([boundary.item, f"{boundary.value:.{digits}f}", boundary.event or "", *cells])
    columns = [*(f"drawn, {name}" for name in trials), *(f"bifurcation, {name}" for name in bifurcations)]
    return Table(["item", "published", "said to be", *columns], rows)


def distance_from_bifurcations(
    parameter: str, bifurcations: Iterable[Bifurcation], n: int = 20_000
) -> tuple[float, float]:
    """How near the published boundaries lie to folds and flips, and how often boundaries at random lie as near.

    Parameters
    ----------
    parameter : {"mesh_frequency", "damping_ratio"}
    n : int
        Random tables.

    Returns
    -------
    distance, chance : float
        The mean distance of a published boundary from the nearest fold or flip, and the fraction of tables with
        boundaries anywhere on the axis whose mean distance is no larger.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> branch = continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)
    >>> distance, chance = distance_from_bifurcations("mesh_frequency", branch.bifurcations, n=100)
    >>> round(distance, 2), chance > 0.0
    (0.38, True)
    """
    changes = np.array([b.value for b in bifurcations if b.parameter == parameter and b.kind != "grazing"])
    stated = np.array([boundary.value for boundary in published.boundaries(parameter)])
    ends = axis(parameter, 2)
    random = np.random.default_rng(0).uniform(ends[0], ends[1], (n, len(stated)))
    distance = float(np.abs(stated[:, None] - changes).min(axis=1).mean())
    chance = float(np.mean(np.abs(random[:, :, None] - changes).min(axis=2).mean(axis=1) <= distance))
    return distance, chance


def drawn_boundary(trials: Iterable[Trial], boundary: published.Boundary) -> float | None:
    """The nearest boundary between the same two motions in any of the diagrams, None where none has one.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> from gearpair.article.case import Protocol, run_trials
    >>> [boundary] = [b for b in published.boundaries("mesh_frequency") if b.item == "F6"]
    >>> drawn = drawn_boundary(run_trials([SWAPPED], [Protocol("down", None)], 26), boundary)
    >>> round(drawn, 2), boundary.value
    (1.04, 1.028)
    """
    scores = [t.frequency if boundary.parameter == "mesh_frequency" else t.damping for t in trials]
    found = [m.found for s in scores for m in s.matches if m.boundary == boundary and m.found is not None]
    return min(found, key=lambda value: abs(value - boundary.value), default=None)


def bifurcations_of(hypothesis: Hypothesis, max_period: int = 3) -> list[Bifurcation]:
    """The folds and flips in mesh frequency and in damping of the branches that a search finds in one reading.

    Parameters
    ----------
    max_period : int
        The longest period followed.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> sorted({(b.kind, b.parameter) for b in bifurcations_of(SWAPPED, max_period=1)})
    [('flip', 'mesh_frequency'), ('fold', 'damping_ratio')]
    """
    osc = hypothesis.oscillator()
    branches = [
        *find_branches(osc, "mesh_frequency", 0.65, 1.75, max_period=max_period, n_values=5),
        *find_branches(osc, "damping_ratio", 0.001, 0.03, max_period=max_period, n_values=3),
    ]
    return [b for branch in branches for b in branch.bifurcations if b.kind != "grazing"]
