"""Batches of motions followed until they settle: many oscillators, many starts, block by block."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self, TypedDict

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from gearpair._checks import check_count, check_options, checked
from gearpair._cores import on_all_cores
from gearpair._flow.capture import COLUMNS
from gearpair._flow.measures import N_MEASURES
from gearpair._flow.settle import observed_periods, settle_lanes
from gearpair._flow.states import NOT_RUN, Known, Lanes, Limits, Settled
from gearpair.motion.outcome import Outcome
from gearpair.oscillator import Oscillator

UNLIMITED = 2**62
# Motions between two moves of the progress bar: of several oscillators, of one.
BLOCK, BLOCK_OF_ONE = 8, 256


class Status(Outcome):
    """What a motion became: a string, with a `remedy` that says what a user may do."""

    PERIODIC = "periodic", "the motion has settled on a stable periodic orbit"
    APERIODIC = (
        "aperiodic",
        "chaos for as long as it was watched: the largest Lyapunov exponent is positive, well outside its uncertainty, "
        "and the motion did not settle in `lasted` mesh periods; raise n_watch to look longer",
    )
    UNSETTLED = (
        "unsettled",
        "neither periodic nor of a resolved positive exponent after `lasted` mesh periods: raise n_watch or "
        "max_period; without damping there is nothing to settle on",
    )
    ESCAPED = (
        "escaped",
        "the motion grows without bound: start nearer to the backlash zone, or raise damping_ratio",
    )
    CAPPED = "capped", "too many events in one mesh period: the oscillator is outside what a gear can do"
    EXHAUSTED = (
        "exhausted",
        "the limit on work came before the motion was judged: raise most_work, or lower n_transient or n_watch",
    )
    TRANSIENT = (
        "transient",
        "chaotic for as long as it was watched, on a set that other motions have left and that is no attractor: "
        "raise n_watch to see where this one goes",
    )
    FLOATING = (
        "floating",
        "never in contact, without a mean force: it repeats, and so does any shift of it within the backlash",
    )


STATUSES = tuple(Status)  # in the order of the kernels' codes


class SettleOptions(TypedDict, total=False):
    """How long to wait for a motion to settle and how far to look: keyword arguments of all that settles motions.

    Parameters
    ----------
    n_transient : int or None
        Mesh periods at most before a motion is judged; `transient_periods` of the oscillator when None or not given.
    max_period : int
        The longest period looked for, in base periods: mesh periods, or revolutions with `shaft_orders`.
    n_exponent : int
        Mesh periods over which the exponents of a motion that is not periodic are measured; again over `n_watch` if
        they are not resolved.
    n_watch : int
        Mesh periods that such a motion is then watched for, in case it settles after all: some 0.4 microseconds each.
        Without damping nothing settles, and it is not watched.

    Notes
    -----
    What is taken where nothing is given: `ONE` for a motion and for a sweep, `MANY` for planes and maps. With
    `shaft_orders` all mesh periods are rounded up to whole revolutions.

    A chaotic transient of the mean life T outlasts the watch with the probability ``exp(-n_watch / T)``.

    Examples
    --------
    >>> from gearpair.motion.settling import MANY, ONE
    >>> ONE.n_exponent, ONE.n_watch, MANY.n_exponent, MANY.n_watch
    (2000, 20000, 500, 20000)
    """

    n_transient: int | None
    max_period: int
    n_exponent: int
    n_watch: int


class BatchOptions(SettleOptions, total=False):
    """`SettleOptions` and a limit on what a whole batch may cost.

    Parameters
    ----------
    most_work : int or None
        Mesh periods that a whole batch may take at most, shared equally by its motions; one that would need more than
        its share is followed for its share and, unless captured, ends as ``"exhausted"``. No limit when not given.
    """

    most_work: int | None


@dataclass(frozen=True, kw_only=True)
class SettleSettings:
    """`BatchOptions` with their values, how many section points to keep, and whether to take the impact measures."""

    n_transient: int | None = None
    max_period: int = 64
    n_exponent: int = 2000
    n_watch: int = 20_000
    n_samples: int = 256
    measures: bool = False
    most_work: int | None = None

    def __post_init__(self) -> None:
        if self.n_transient is not None:
            check_count("n_transient", self.n_transient, at_least=0)
        check_count("n_watch", self.n_watch, at_least=0)
        if self.most_work is not None:
            check_count("most_work", self.most_work)
        for name in ("max_period", "n_exponent", "n_samples"):
            check_count(name, getattr(self, name))

    def having(self, options: SettleOptions, allowed: type = SettleOptions, **own: Any) -> Self:
        """These settings but for the `options` that somebody gave, and the caller's `own`."""
        check_options(options, allowed.__annotations__)
        return replace(self, **options, **own)

    def before_watch(self, osc: Oscillator) -> int:
        """Mesh periods after which the watch of a motion begins that has not settled."""
        waited = self.waited(osc) + observed_periods(osc.base_periods(self.n_exponent))
        return waited * osc.mesh_periods

    def waited(self, osc: Oscillator) -> int:
        """Base periods of a transient at most."""
        return osc.base_periods(transient_periods(osc) if self.n_transient is None else self.n_transient)

    def whole_cycles(self) -> Self:
        """These settings with room for a cycle of the longest period."""
        return self if self.n_samples >= self.max_period else replace(self, n_samples=self.max_period)

    def share_of_work(self, n: int) -> int:
        """Mesh periods that one of `n` motions may take."""
        return UNLIMITED if self.most_work is None else self.most_work // max(n, 1)


# What is asked of a motion, by purpose: one, or a sweep, in full; many at a time; a chart, whose verdict on chaos needs
# no more digits; periods alone, where chaos is none of them.
ONE = SettleSettings()
MANY = SettleSettings(n_exponent=500, n_samples=1)
CHART = SettleSettings(max_period=16, n_exponent=300, n_samples=16)
PERIODS = SettleSettings(n_exponent=20, n_watch=0, n_samples=1)


@checked
def transient_periods(osc: Oscillator) -> int:
    """Mesh periods that a transient needs to fall to 9 digits at best: ``20 / (zeta T)``, within 500 to 20 000.

    Transients die like exp(-zeta tau) at best, slower near a bifurcation. Without damping none dies and the map
    preserves areas: there is nothing to wait for, and 500 are as good as any. Where free flight has another damping
    ratio, zeta is the mean of the two: that of a motion which flies half of the time.

    Examples
    --------
    >>> transient_periods(Oscillator(damping_ratio=0.00275))
    811
    """
    rate = 0.5 * (osc.damping_ratio + osc.damping_in_flight) * osc.mesh_period
    return math.ceil(min(max(20.0 / rate, 500), 20_000)) if rate > 0.0 else 500


def settle_batch(
    oscillators: Sequence[Oscillator],
    starts: NDArray[np.float64],
    settings: SettleSettings,
    *,
    known: Known | None = None,
    chain: int = 1,
    share: int | None = None,
    cores: bool = True,
    progress: bool = False,
) -> Settled:
    """Follow a motion from each start until it settles, in parallel over the cores.

    Parameters
    ----------
    oscillators : sequence of Oscillator
        One for each start, or one for each of equal runs of starts (one alone: for all); all with equally many
        stiffness levels and harmonics and the same base period.
    starts : ndarray of float, shape (n, 2)
        X and X' of each motion.
    settings : SettleSettings
    known : Known, optional
        Attractors of the oscillator, if there is but one, that may capture a motion.
    chain : int
        Motions in a chain, a divisor of n: each but the first of its chain starts where the one before it ended. 1
        starts every motion from its own start, n makes one carried sweep.
    share : int, optional
        The most mesh periods of one motion, where the batch is only a part of what `settings.most_work` is for.
    cores : bool
        Spread the motions over the cores.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    Settled
        Arrays with one row a motion; times in mesh periods.
    """
    n = len(starts)
    out = blank(n, settings)
    most = settings.share_of_work(n) if share is None else share
    lanes = lanes_of(oscillators, starts, settings)
    whole = lanes.mesh_periods
    n_exponent, n_watch = -(-settings.n_exponent // whole), -(-settings.n_watch // whole)
    limits = Limits(settings.max_period, n_exponent, n_watch, most // whole)
    arguments = (lanes, chain, limits, known or nothing_known(settings), out)
    single = chain == n  # one chain is carried along in parts, one after the other
    block = BLOCK_OF_ONE if len(oscillators) == 1 else BLOCK if chain == 1 or single else chain
    damped = np.array([max(o.damping_ratio, o.damping_in_flight) > 0.0 for o in oscillators], dtype=bool)
    watches = np.where(damped[lanes.own], n_watch, 0)  # of damped motions alone
    periods = np.minimum((lanes.n_transient + n_exponent + watches) * whole, most)
    text, longest = f"at most {periods.sum():.1e} mesh periods", float(periods.max(initial=0))
    with tqdm(desc=text, total=n, unit="motion", disable=not progress) as bar:
        on_all_cores(settle_lanes, arguments, n, block, bar.update, cores and not single, longest=longest)
    out.lasted[:] *= whole
    out.way[:, 0] *= whole
    return out


def settle_both_ways(
    oscillators: Sequence[Oscillator], starts: NDArray[np.float64], settings: SettleSettings, *, chain: int, **how: Any
) -> tuple[Settled, Settled]:
    """`settle_batch` of chains run up and of the same run down, each row where its oscillator stands among all."""
    n = len(oscillators)
    back = np.arange(n).reshape(-1, chain)[:, ::-1].ravel()
    lanes = [*oscillators, *(oscillators[i] for i in back.tolist())]
    out = settle_batch(lanes, np.concatenate([starts, starts[back]]), settings, chain=chain, **how)
    return Settled._make(column[:n] for column in out), Settled._make(column[n:][back] for column in out)


def lanes_of(oscillators: Sequence[Oscillator], starts: NDArray[np.float64], settings: SettleSettings) -> Lanes:
    """The lanes of a batch (see `settle_batch`); `starts` (n, 2) are copied."""
    m, coefficients = len(oscillators), [o.coefficients for o in oscillators]
    own = np.repeat(np.arange(m), len(starts) // max(m, 1))
    whole = {(o.mesh_periods, len(p.harmonics)) for o, p in zip(oscillators, coefficients, strict=True)} or {(1, 0)}
    if len(whole) > 1:
        raise ValueError(
            f"all oscillators must have the same base period, got some of {min(whole)[0]} and some of {max(whole)[0]} "
            "mesh periods: keep the amplitudes of shaft_orders above 0"
        )
    return Lanes(
        np.array([p[:6] for p in coefficients]),
        np.array([p.edges for p in coefficients]),
        np.array([p.levels for p in coefficients]),
        np.array([p.harmonics for p in coefficients]).reshape(m, min(whole)[1], 3),
        own,
        np.array(starts, dtype=float),
        np.array([settings.waited(o) for o in oscillators], dtype=np.int64)[own],
        min(whole)[0],
    )


def nothing_known(settings: SettleSettings) -> Known:
    """No attractors."""
    return Known(blank(0, settings), np.empty((0, COLUMNS)), np.empty((0, 4)))


def blank(n: int, settings: SettleSettings) -> Settled:
    """Rows for `n` motions, filled with what stands for "not run"."""
    return Settled(
        np.full(n, NOT_RUN),
        np.zeros(n, np.int64),
        np.full((n, settings.n_samples, 2), np.nan),
        np.full((n, 2, 2), np.nan),
        np.full((n, 2), np.nan),
        np.full((n, 3), np.nan),
        np.full((n, 2), np.nan),
        np.full(n, -1),
        np.full((n, 4), np.nan),
        np.zeros(n, np.int64),
        np.full((n, 3), np.nan),
        np.full((n, N_MEASURES if settings.measures else 0), np.nan),
    )
