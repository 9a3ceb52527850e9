"""The motions that a reading has at all, reached from any start, whatever the protocol of a diagram."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gearpair._equality import equal_by_value
from gearpair.article import published
from gearpair.article.case.scoring import axis, published_at, published_kind, published_motions
from gearpair.article.case.trials import drawn_settings, followed
from gearpair.article.readings import Hypothesis
from gearpair.motion.names import Motion
from gearpair.motion.settling import MANY, STATUSES, Status, settle_batch
from gearpair.oscillator import Oscillator

# Mesh periods that a motion is watched for before it is said to be chaos: most chaotic transients end in them.
WATCHED = 20_000
NEITHER = -1  # in place of a period: neither periodic nor chaos
STARTS = tuple((x, v) for x in (-1.0, 0.0, 1.0, 2.0) for v in (-0.6, 0.0, 0.6))


@equal_by_value
@dataclass(frozen=True)
class Reached:
    """The motions that a hypothesis has at each value of a parameter, whatever the protocol: reached from any start.

    Attributes
    ----------
    values : ndarray of float, shape (n,)
    motions : tuple of frozenset of Motion
        One set per value, in the article's words as `published_kind` gives them.
    """

    hypothesis: Hypothesis
    parameter: str
    values: NDArray[np.float64]
    motions: tuple[frozenset[Motion], ...]

    def has(self, motion: Motion) -> NDArray[np.bool_]:
        """Where a motion was reached, shape (n,)."""
        return np.array([motion in there for there in self.motions])

    @property
    def published_present(self) -> NDArray[np.bool_]:
        """Where the published motion was reached, shape (n,)."""
        expected = published_at(self.parameter, self.values)
        return np.array([want in there for want, there in zip(expected, self.motions, strict=True)])

    @property
    def coverage(self) -> float:
        """Fraction of the axis on which the published motion was reached from some start."""
        return float(np.mean(self.published_present))

    def coverage_outside(self, motion: Motion) -> float:
        """`coverage` where another motion than `motion` is published.

        Examples
        --------
        >>> from gearpair.article import PRINTED
        >>> from gearpair.motion import periodic
        >>> found = Reached(PRINTED, "damping_ratio", np.array([0.001, 0.009]), (frozenset({periodic(3)}),) * 2)
        >>> found.coverage, found.coverage_outside(published.CHAOTIC)
        (0.5, 1.0)
        """
        outside = [want != motion for want in published_at(self.parameter, self.values)]
        return float(np.mean(self.published_present[outside]))

    def within(self, item: str) -> float:
        """`coverage` inside one published range, by its item."""
        (stated,) = (r for r in published.ranges(self.parameter) if r.item == item)
        inside = (self.values > stated.lower) & (self.values < stated.upper)
        return float(np.mean(self.published_present[inside]))


def shared_boundaries(reached: Reached) -> list[str]:
    """The items of the published boundaries at which the motions of both sides exist.

    Parameters
    ----------
    reached : Reached
        The value nearest to a boundary tells.

    Examples
    --------
    >>> from gearpair.article import PRINTED
    >>> from gearpair.motion import periodic
    >>> one, both = frozenset({periodic(3)}), frozenset({periodic(1), periodic(3)})
    >>> shared_boundaries(Reached(PRINTED, "damping_ratio", np.array([0.003, 0.0165]), (one, both)))
    ['D4']
    """
    pairs = zip(published.boundaries(reached.parameter), pairwise(published_motions(reached.parameter)), strict=True)
    nearest = [(b.item, kinds, int(np.argmin(np.abs(reached.values - b.value)))) for b, kinds in pairs]
    return [item for item, kinds, i in nearest if set(kinds) <= reached.motions[i]]


def reached(
    hypotheses: Sequence[Hypothesis],
    parameter: str,
    n_values: int = 40,
    *,
    starts: Sequence[tuple[float, float]] = STARTS,
    n_discarded: int | None = None,
    n_watch: int | None = None,
) -> list[Reached]:
    """The motions that each hypothesis has at the middles of `n_values` equal parts of the published axis.

    Parameters
    ----------
    parameter : {"mesh_frequency", "damping_ratio"}
    n_discarded : int or None
        As in `Protocol`.
    n_watch : int, optional
        What is not periodic by then is watched for so many mesh periods more, and chaos is what is aperiodic even
        then. When None, motions are read off as in a drawn diagram, where all that has no period up to
        `MAX_PERIOD` looks like chaos: a chaotic transient, a slow approach, a longer cycle.

    Notes
    -----
    This asks less than a `Trial`: which of several coexisting motions a diagram shows depends on its protocol,
    which ones exist does not.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> reached([SWAPPED], "damping_ratio", 5)[0].within("D5")
    1.0
    """
    edges = axis(parameter, n_values + 1)
    values = 0.5 * (edges[1:] + edges[:-1])

    settings = drawn_settings(n_discarded)
    if n_watch is not None:
        settings = MANY.having({"n_transient": n_discarded, "n_watch": n_watch})

    def follow(oscillators: list[Oscillator]) -> NDArray[np.int64]:
        out = settle_batch(oscillators, np.tile(starts, (len(oscillators), 1)), settings)
        chaos = out.status == STATUSES.index(Status.APERIODIC)
        return out.period if n_watch is None else np.where(chaos | (out.period > 0), out.period, NEITHER)

    def kinds(row: NDArray[np.int64]) -> frozenset[Motion]:
        return frozenset(published_kind(int(period), parameter) for period in row if period != NEITHER)

    return [
        Reached(h, parameter, values, tuple(map(kinds, rows)))
        for h, rows in zip(hypotheses, followed(hypotheses, parameter, values, follow), strict=True)
    ]
