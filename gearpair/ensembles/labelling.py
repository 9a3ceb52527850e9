"""The motions of one oscillator, found once: with numbers that stay, and that tell of any start where it leads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count, check_number, checked
from gearpair._equality import equal_by_value
from gearpair._flow.states import APERIODIC, GONE, PERIODIC, TRANSIENT, Known, Settled
from gearpair.ensembles.capture import (
    Numbered,
    Numbers,
    known_among,
    known_attractors,
    marks_of,
    number_attractors,
    numbered,
    scouts,
    with_sets,
)
from gearpair.ensembles.chaos import ChaoticSets, Observed, chaotic_sets, neighbours, scouted
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.impacts import IMPACT_STATES
from gearpair.motion.names import CHAOS, Motion
from gearpair.motion.settling import STATUSES, SettleSettings, Status, settle_batch
from gearpair.motion.steady import SteadyState, describe
from gearpair.motion.trajectories import check_pairs, check_starts, walked
from gearpair.oscillator import Oscillator
from gearpair.quantities import symbol
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr

UNKNOWN, ESCAPES, LINGERS = -1, -2, -3  # what stands for a number where a start leads to no attractor that has one
NO_ATTRACTOR = {ESCAPES: Motion(Status.ESCAPED), LINGERS: Motion(Status.TRANSIENT), UNKNOWN: Motion("not judged")}
MOST_TOLD = 6  # attractors in a line


class Evidence(NamedTuple):
    """What is known of attractors, in the kernels' numbers."""

    settled: Settled  # one row an attractor
    observed: Observed  # the motions that were on chaotic sets
    lasting: NDArray[np.float64]  # see `gearpair._flow.states.Known`
    leads_to: NDArray[np.int64]  # (sets, attractors) how many motions that left a set went where


@equal_by_value
@dataclass(frozen=True, repr=False)
class Attractors(Sequence[SteadyState]):
    """The motions that starts of one oscillator settle on: a sequence of `SteadyState`, by their numbers.

    Attributes
    ----------
    oscillator : Oscillator
    numbers : tuple of int
        The number of each, rising; no number is used twice. They are 0, 1, ... unless attractors have ended on the way
        (see `follow`).
    starts : ndarray of float, shape (n, 2)
        X and X' of the starts that the motions were looked for from.
    labels : ndarray of int, shape (n,)
        Where each of these leads, as of `label`, with what all of them show of chaos.
    settings : SettleSettings
        How long was waited, and how far was looked.
    ended : mapping of int to (float, float)
        Numbers of attractors that are no more, with the X_min and X_max they were last seen with.
    evidence : Evidence
        What the library keeps to know them again.

    Examples
    --------
    >>> from gearpair import attractors
    >>> found = attractors(Oscillator(), 100)
    >>> found.numbers[:2], str(found[0].motion), found.label([-2.0, 1.0], [1.5, 0.0])
    ((0, 1), 'period 1, double-sided', array([0, 1]))
    """

    oscillator: Oscillator
    numbers: tuple[int, ...]
    starts: NDArray[np.float64]
    labels: NDArray[np.int64]
    settings: SettleSettings
    ended: Mapping[int, tuple[float, float]]
    evidence: Evidence

    def __len__(self) -> int:
        return len(self.numbers)

    @overload
    def __getitem__(self, place: int) -> SteadyState: ...

    @overload
    def __getitem__(self, place: slice) -> tuple[SteadyState, ...]: ...

    def __getitem__(self, place: int | slice) -> SteadyState | tuple[SteadyState, ...]:
        return self._motions[place]

    def __repr__(self) -> str:
        """One line."""
        told = zip(self.numbers[:MOST_TOLD], self.kinds, self.shares.tolist(), strict=False)
        texts = [f"{number}: {kind} ({share:.1%} of the starts)" for number, kind, share in told]
        texts += [f"{len(self) - MOST_TOLD} more"] * (len(self) > MOST_TOLD)
        others = {code: float(np.mean(self.labels == code)) for code in NO_ATTRACTOR}
        texts += [f"{NO_ATTRACTOR[code]} ({share:.1%})" for code, share in others.items() if share]
        kind = "attractor" if len(self) == 1 else "attractors"
        return f"{len(self)} {kind} of {len(self.starts)} starts; {'; '.join(texts)}"

    @property
    def by_number(self) -> dict[int, SteadyState]:
        """Each motion by its number."""
        return dict(zip(self.numbers, self, strict=True))

    @property
    def kinds(self) -> list[Motion]:
        """What each is; a chaotic one by the range of all motions on it."""
        columns = zip(*(self.columns[name].tolist() for name in ("status", "period", "impact_state")), strict=True)
        return [Motion(STATUSES[status], period or None, IMPACT_STATES[state]) for status, period, state in columns]

    @property
    def shares(self) -> NDArray[np.float64]:
        """The share of the starts that each takes, shape (len,)."""
        return np.array([np.mean(self.labels == number) for number in self.numbers])

    @cached_property
    def sets(self) -> ChaoticSets:
        """All chaotic sets that were seen."""
        return chaotic_sets([self.evidence.observed])

    @cached_property
    def columns(self) -> dict[str, NDArray[Any]]:
        """What each attractor is, as the library's codes."""
        _, table = number_attractors([], self.sets, numbers_of(self))
        counts = np.array([np.sum(self.labels == number) for number in self.numbers], np.int64)
        return table | {"counts": counts}

    @property
    def places(self) -> dict[int, tuple[float, float]]:
        """The X_min and X_max that each number was last seen with, those of `ended` included."""
        reach = zip(self.columns["x_min"].tolist(), self.columns["x_max"].tolist(), strict=True)
        return {**self.ended, **dict(zip(self.numbers, reach, strict=True))}

    @property
    def _own_sets(self) -> list[int]:
        """The chaotic set that each attractor is, or -1."""
        return np.where(self.columns["status"] == APERIODIC, self.columns["chaotic_set"], -1).tolist()

    @cached_property
    def _motions(self) -> tuple[SteadyState, ...]:
        return tuple(describe(self.oscillator, self.evidence.settled, i) for i in range(len(self)))

    @cached_property
    def _known(self) -> Known:
        known = known_among(self.oscillator, self.evidence.settled)
        return known._replace(lasting=self.evidence.lasting)

    @checked
    def label(self, x: ArrayLike, v: ArrayLike) -> int | NDArray[np.int64]:
        """The number of the attractor that each start leads to; an int for a single one.

        Parameters
        ----------
        x, v : array_like of float
            X and X' at the start of a mesh period; broadcast against each other.

        Returns
        -------
        int, or ndarray of int
            Of the broadcast shape. -1 where a start leads to a motion that is not among these, or was not judged;
            -2 where it escapes; -3 where it is still on a chaotic set that other motions have left.

        Notes
        -----
        A start is followed until a certified neighbourhood captures it, as in `gearpair.basins`, and settles as in
        `gearpair.steady_state` where none does. Its label does not depend on what other starts of the call do: a
        chaotic set is an attractor, or a transient, as it was when these were found. `including` takes starts in that
        lead elsewhere.

        Examples
        --------
        >>> from gearpair import attractors
        >>> attractors(Oscillator(), 100).label(-2.0, 1.5)
        0
        """
        xs, vs = check_starts(x, v)
        starts = np.stack([xs.ravel(), vs.ravel()], axis=1)
        known = known_of(self, self.oscillator, self.settings)
        out = settle_batch([self.oscillator], starts, self.settings, known=known)
        numbers = self._numbers(settled_columns(out)).reshape(xs.shape)
        return numbers if xs.ndim else int(numbers)

    def _numbers(self, columns: dict[str, NDArray[Any]]) -> NDArray[np.int64]:
        discard = self.settings.before_watch(self.oscillator)
        columns = with_sets(self.sets, columns, discard)
        own = with_sets(self.sets, settled_columns(self.evidence.settled), discard)
        places = neighbours(marks_of(own), marks_of(columns))
        numbers = np.array([*self.numbers, UNKNOWN], np.int64)
        return np.where(places >= 0, numbers[places], codes_of(columns["status"]))

    @checked
    def including(self, x: ArrayLike, v: ArrayLike) -> Attractors:
        """These and what further starts lead to, with new numbers for what is new.

        Parameters
        ----------
        x, v : array_like of float
            X and X' at the start of a mesh period; broadcast against each other.

        Examples
        --------
        >>> from gearpair import attractors
        >>> one = attractors(Oscillator(), starts=[(-2.0, 1.5)])
        >>> one.label(1.0, 0.0), one.including(1.0, 0.0).label(1.0, 0.0)
        (-1, 1)
        """
        starts = np.concatenate([self.starts, check_pairs(x, v)])
        return surveyed(self.oscillator, starts, self.settings, self)

    @checked
    def follow(self, parameter: str, value: float, *, nearest: float = 0.3) -> Attractors:
        """The attractors at another value of a parameter, from the same starts; those that go on keep their numbers.

        Parameters
        ----------
        parameter : str
            One of ``oscillator.parameters``.
        value : float
            Small steps are surer: a motion that changes much on the way is taken for another.
        nearest : float
            As in `gearpair.ensembles.continue_attractors`, which takes many such steps, and says what goes on.

        Examples
        --------
        >>> from gearpair import attractors
        >>> found = attractors(Oscillator(), 50).follow("damping_ratio", 0.15)
        >>> found.oscillator.damping_ratio, len(found), found.label(0.0, 0.0) in found.numbers
        (0.15, 1, True)
        """
        from gearpair.ensembles.tipping import followed  # here, for that module is made of these

        self.oscillator.parameter(parameter)
        osc = self.oscillator.replace(**{parameter: value})
        return followed(self, osc, parameter, check_number("nearest", nearest, above=0.0))[0]

    def table(self, digits: int = 3) -> Table:
        """The number of each, what it is, its range, exponent and share of the starts, and how long chaos lives.

        Examples
        --------
        >>> from gearpair import attractors
        >>> attractors(Oscillator(damping_ratio=0.1), 50).table()
        number  motion                  X_min  X_max  lambda_1  share
        -------------------------------------------------------------
             0  period 1, single-sided  0.448  1.415    -0.022  1.000
        """
        check_count("digits", digits, at_least=0)
        names = "x_min", "x_max", "exponent"
        rows = [
            [number, kind, *(f"{self.columns[name][k]:.{digits}f}" for name in names), f"{share:.{digits}f}"]
            for k, (number, kind, share) in enumerate(zip(self.numbers, self.kinds, self.shares, strict=True))
        ]
        lives = [self.sets.rates[own].told if own >= 0 else "" for own in self._own_sets]
        for code, kind in NO_ATTRACTOR.items():
            if share := float(np.mean(self.labels == code)):
                left = np.flatnonzero(self.sets.transient).tolist() if code == LINGERS else ()
                rows.append(["–", kind, "–", "–", "–", f"{share:.{digits}f}"])
                lives.append("; ".join(self.sets.rates[k].told for k in left))
        heads = ["number", "motion", *map(symbol, names), "share"]
        if CHAOS in {kind.kind for kind in self.kinds} or any(lives):
            heads, rows = [*heads, "chaos"], [[*row, life] for row, life in zip(rows, lives, strict=True)]
        return Table(heads, rows)

    def to_dataset(self) -> xr.Dataset:
        """All of it as a dataset, which can be saved.

        Returns
        -------
        xarray.Dataset
            Over ``attractor_number`` and ``set_number`` as of `gearpair.ensembles.basin_stability` and
            `gearpair.basins`; over ``start`` the ``start_x``, ``start_v`` and ``label`` of each; and what
            `from_dataset` needs besides.

        Examples
        --------
        >>> from gearpair import attractors
        >>> found = attractors(Oscillator(), 50)
        >>> Attractors.from_dataset(found.to_dataset()) == found
        True
        """
        from gearpair.ensembles.saving import to_dataset  # here, for that module is made of these

        return to_dataset(self)

    @classmethod
    @checked
    def from_dataset(cls, result: xr.Dataset) -> Attractors:
        """The attractors that `to_dataset` has written, also read back from a file."""
        from gearpair.ensembles.saving import from_dataset

        return from_dataset(result)


def known_of(found: Attractors, osc: Oscillator, settings: SettleSettings) -> Known:
    """What captures other starts of `osc` that are settled by `settings`; a ValueError where it is another's."""
    check_of(found, osc)
    settled = found._known.settled
    places = np.arange(settings.n_samples) % settled.period[:, np.newaxis]
    points = settled.points[np.arange(len(places))[:, np.newaxis], places]
    return found._known._replace(settled=settled._replace(points=points))


def check_of(found: Attractors, osc: Oscillator) -> None:
    """Raise a ValueError unless the attractors are those of `osc`."""
    if found.oscillator != osc:
        raise ValueError(f"attractors must be those of this oscillator, {osc!r}, got those of {found.oscillator!r}")


def numbers_of(found: Attractors, *, periodic: bool = False) -> Numbers:
    """The numbers that attractors have, for others to be numbered beside; or those of the `periodic` ones alone."""
    settled, observed = found.evidence.settled, found.evidence.observed
    columns, numbers = settled_columns(settled), np.array(found.numbers, np.int64)
    if periodic:
        rows = np.flatnonzero(settled.status == PERIODIC)
        columns, numbers = {name: column[rows] for name, column in columns.items()}, numbers[rows]
        observed = scouted(np.empty((0, 4)))
    return Numbers(numbers, columns, observed, max([*found.numbers, *found.ended, UNKNOWN]) + 1)


def codes_of(status: NDArray[np.int64]) -> NDArray[np.int64]:
    """What stands for the number of motions that have no attractor, by their status."""
    return np.where(status == GONE, ESCAPES, np.where(status == TRANSIENT, LINGERS, UNKNOWN))


def surveyed(
    osc: Oscillator,
    starts: NDArray[np.float64],
    settings: SettleSettings,
    before: Attractors | None = None,
    *,
    progress: bool = False,
) -> Attractors:
    """The attractors of all `starts` (n, 2); those from `before`, of some of the same starts, keep their numbers."""
    if before is None:
        known, numbers = known_attractors(osc, starts[scouts(len(starts))], settings), None
    else:
        known = known_of(before, osc, settings)
        # The motions of all starts are seen again.
        numbers = numbers_of(before)._replace(observed=scouted(known.lasting))
    out = settle_batch([osc], starts, settings, known=known, progress=progress)
    result = numbered(settled_columns(out), settings.before_watch(osc), known.lasting, numbers)
    if before is None:
        return gathered(osc, starts, settings, out, result, known.lasting)
    own = before.evidence.settled
    own = own._replace(points=own.points[:, : settings.n_samples])
    out = Settled._make(map(np.concatenate, zip(out, own, strict=True)))
    ended = {number: place for number, place in before.places.items() if number not in result.table["number"]}
    return gathered(osc, starts, settings, out, result, known.lasting, ended=ended)


def gathered(
    osc: Oscillator,
    starts: NDArray[np.float64],
    settings: SettleSettings,
    out: Settled,
    result: Numbered,
    lasting: NDArray[np.float64],
    numbers: NDArray[np.int64] | None = None,
    ended: Mapping[int, tuple[float, float]] | None = None,
) -> Attractors:
    """The attractors of a `result`, whose first motions are of the `starts`; in place of its own numbers others."""
    table, n = result.table, len(starts)
    given = table["number"] if numbers is None else numbers
    order = np.argsort(given)
    settled = Settled._make(column[table["first"][order]] for column in out)
    settled = settled._replace(
        status=table["status"][order].astype(np.int64),
        attractor=np.full(len(order), UNKNOWN),
        way=np.full(settled.way.shape, np.nan),
        points=_section_points(osc, settled, settings.whole_cycles().n_samples),
    )
    attractor, status = result.columns["attractor"][:n], result.columns["status"][:n]
    own = np.append(given, UNKNOWN)[np.searchsorted(table["number"], attractor)]
    labels = np.where(attractor >= 0, own, codes_of(status))
    evidence = Evidence(settled, result.sets.seen, lasting, result.leads_to[:, order])
    return Attractors(osc, tuple(given[order].tolist()), starts, labels, settings, dict(ended or {}), evidence)


def _section_points(osc: Oscillator, settled: Settled, n: int) -> NDArray[np.float64]:
    """The first `n` section points of settled motions (k, n, 2), of which the first is known; a cycle is repeated."""
    points = [settled.points[:, 0]]
    for _ in range(n - 1):
        points.append(walked(osc.cells, points[-1], 1)[0])
    places = np.arange(n) % np.where(settled.period > 0, settled.period, n)[:, np.newaxis]
    return np.stack(points, axis=1)[np.arange(len(places))[:, np.newaxis], places]
