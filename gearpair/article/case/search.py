"""Was it the step? Published boundaries that a diagram meets, those met by chance, and the phase that each asks for."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count
from gearpair.article import published
from gearpair.article.case.boundaries import named_bifurcation
from gearpair.article.case.scoring import FARTHEST, axis, published_motions
from gearpair.article.case.trials import Trial
from gearpair.bifurcations.curves import continue_bifurcation
from gearpair.bifurcations.locating import Bifurcation
from gearpair.table import Table

# A published boundary is met by one between the same two motions this near, about what its printed digits leave open.
TOLERANCES = {"mesh_frequency": 0.003, "damping_ratio": 0.0002}


def boundaries_met(trial: Trial) -> int:
    """How many of the published boundaries of both tables a diagram meets.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> from gearpair.article.case import Protocol, run_trials
    >>> boundaries_met(run_trials([SWAPPED], [Protocol("down")], 26)[0]) < 8
    True
    """
    return sum(
        match.distance is not None and abs(match.distance) <= TOLERANCES[match.boundary.parameter]
        for score in (trial.frequency, trial.damping)
        for match in score.matches
    )


def most_met_by_chance(trials: Sequence[Trial], n: int = 1000, *, seed: int = 0) -> NDArray[np.int64]:
    """The most boundaries that one of some diagrams meets, for tables whose boundaries lie anywhere.

    The tables have the published motions in their order, and boundaries drawn evenly over the published axes: what a
    search through as many diagrams finds where there is nothing to find.

    Parameters
    ----------
    n : int
        Random tables.

    Returns
    -------
    ndarray of int, shape (n,)

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> from gearpair.article.case import Protocol, run_trials
    >>> most_met_by_chance(run_trials([SWAPPED], [Protocol("down")], 11), 10).shape
    (10,)
    """
    rng = np.random.default_rng(seed)
    met = np.zeros((len(trials), check_count("n", n)), np.int64)
    for parameter, tolerance in TOLERANCES.items():
        kinds = list(pairwise(published_motions(parameter)))
        lower, upper = axis(parameter, 2)
        stated = np.sort(rng.uniform(lower, upper, (n, len(kinds))), axis=1)
        for i, trial in enumerate(trials):
            changes = (trial.frequency if parameter == "mesh_frequency" else trial.damping).changes
            for k, kind in enumerate(kinds):
                places = np.array([change.value for change in changes if (change.below, change.above) == kind])
                met[i] += np.any(np.abs(stated[:, k, None] - places) <= tolerance, axis=1)
    return np.asarray(met.max(axis=0))


def search_table(families: Mapping[str, tuple[Sequence[Trial], Sequence[Trial]]]) -> Table:
    """What the best setting of each family meets, beside the same search on another reading and by chance.

    Parameters
    ----------
    families : mapping of str to two sequences of Trial
        By what was varied: the trials of the reading in question and those of the other.

    Returns
    -------
    Table
        The last column is the share of a thousand random tables of which some setting of the first reading meets as
        many boundaries. Where none is met, no setting is best.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> from gearpair.article.case import Protocol, run_trials
    >>> printed, swapped = ([trial] for trial in run_trials([PRINTED, SWAPPED], [Protocol("down")], 6))
    >>> search_table({"seeding": (swapped, printed)}).rows[0][2:4]
    ('0 of 8', '–')
    """
    rows = []
    for name, (trials, others) in families.items():
        best = max(trials, key=boundaries_met)
        most = boundaries_met(best)
        chance = float(np.mean(most_met_by_chance(trials) >= most))
        setting = f"{best.integrator or 'exact flow'}, {best.protocol.seeding}" if most else "–"
        if most and best.hypothesis.phase:
            setting += f", phase {np.radians(best.hypothesis.phase):+.3f}"
        rows.append([name, len(trials), f"{most} of 8", setting, max(map(boundaries_met, others)), f"{chance:.2f}"])
    columns = ["varied", "diagrams", "best meets", "best setting", "the other reading meets", "by chance as many"]
    return Table(columns, rows)


def asked_phases(bifurcation: Bifurcation, stated: float, largest: float = 0.3) -> list[float]:
    """The phases of the forcing at which a bifurcation lies exactly where it is published.

    Parameters
    ----------
    bifurcation : Bifurcation
        In mesh frequency or damping ratio.
    stated : float
        The published value of that parameter.
    largest : float
        The largest phase looked at, in radians either way from that of the bifurcation's oscillator.

    Returns
    -------
    list of float
        In radians, relative to that oscillator; where the curve of the bifurcation in both parameters passes the
        value, by linear interpolation between its points.

    Examples
    --------
    >>> from gearpair import continue_orbit, periodic_orbit
    >>> from gearpair.article import SWAPPED
    >>> orbit = periodic_orbit(SWAPPED.oscillator(1.6), 0.0, 0.0, 1)
    >>> [flip] = [b for b in continue_orbit(orbit, "mesh_frequency", 1.5, 1.65).bifurcations if b.kind == "flip"]
    >>> [round(phase, 2) for phase in asked_phases(flip, 1.555, 0.1)]
    [-0.04]
    """
    ends = axis(bifurcation.parameter, 2)
    room = FARTHEST * (ends[1] - ends[0])
    own = bifurcation.oscillator.error_phase
    bounds = {
        bifurcation.parameter: (max(ends[0] - room, 0.1 * room), ends[1] + room),
        "error_phase": (own - largest, own + largest),
    }
    value, phase = continue_bifurcation(bifurcation, bounds).values.T
    away = value - stated
    passed = np.flatnonzero(away[:-1] * away[1:] <= 0.0)
    share = away[passed] / (away[passed] - away[passed + 1])
    return sorted((phase[passed] + share * (phase[passed + 1] - phase[passed]) - own).tolist())


def asked_phase_table(bifurcations: Sequence[Bifurcation], largest: float = 0.3) -> Table:
    """For every published boundary with a named event, the phase that would put that event on the published value.

    Parameters
    ----------
    bifurcations : sequence of Bifurcation
        Of one reading.
    largest : float
        As in `asked_phases`.

    Returns
    -------
    Table
        One row for each of the boundaries at which the article names a doubling, a halving or a saddle-node, and for
        the end of the last period 1, which has a flip of its own.

    Examples
    --------
    >>> from gearpair import continue_orbit, periodic_orbit
    >>> from gearpair.article import SWAPPED
    >>> orbit = periodic_orbit(SWAPPED.oscillator(1.6), 0.0, 0.0, 1)
    >>> [flip] = [b for b in continue_orbit(orbit, "mesh_frequency", 1.5, 1.65).bifurcations if b.kind == "flip"]
    >>> asked_phase_table([flip], 0.1).rows[-1][:3]
    ('F11', '1.555', 'flip of period 1')
    """
    rows = []
    for boundary in published.FREQUENCY_BOUNDARIES + published.DAMPING_BOUNDARIES:
        b = named_bifurcation(boundary, bifurcations)
        if b is None or boundary.item not in ("F2", "F4", "F6", "F11", "D4"):
            continue
        phases = asked_phases(b, boundary.value, largest)
        nearest_phase = min(phases, key=abs, default=None)
        shown = f"none within {largest:g}" if nearest_phase is None else f"{nearest_phase:+.3f}"
        rows.append([boundary.item, f"{boundary.value:g}", f"{b.kind} of period {b.period}", f"{b.value:.5f}", shown])
    return Table(["item", "published", "bifurcation", "found at", "phase asked for (rad)"], rows)
