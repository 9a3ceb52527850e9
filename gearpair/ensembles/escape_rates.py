"""The rate at which motions leave a set, from how long each was watched."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_number, checked
from gearpair._equality import equal_by_value
from gearpair.motion.outcome import Outcome


class Persistence(Outcome):
    """Whether chaos lasts, as far as it was watched: a word with a `remedy`, which says what it rests on."""

    TRANSIENT = "transient", "motions leave: the mean life has an interval, narrower the more of them are watched"
    LASTING = "lasting", "no motion left in the time watched: an attractor, or a transient of at least that mean life"
    DIRECT = (
        "direct",
        "every motion had settled before `discard` ended: no transient longer than that was there to watch",
    )
    UNWATCHED = "unwatched", "no motion was watched, by an n_watch of 0 or without damping: how long it lasts is open"


@equal_by_value
@dataclass(frozen=True)
class EscapeRate:
    """The escape rate of a set of motions with its confidence interval, and the time it rests on.

    Attributes
    ----------
    n_watched : int
        Motions that were still there after `discard` mesh periods.
    watched_periods : int
        Mesh periods that these were watched for from then on, together.
    escapes : int
        How many of them left in that time.
    escape_rate, escape_rate_low, escape_rate_high : float
        Per mesh period, with the ends of the interval: the survivors fall as ``exp(-rate t)``. Without an escape the
        rate is 0 and its interval one-sided; where nothing was watched it is nan, within 0 and infinity.
    confidence : float
        Of the interval.
    """

    n_watched: int
    watched_periods: int
    escapes: int
    escape_rate: float
    escape_rate_low: float
    escape_rate_high: float
    confidence: float

    @property
    def mean_life(self) -> float:
        """Mesh periods that a motion stays on average, the inverse of the rate; half are gone after ln 2 of it."""
        return _inverse(self.escape_rate)

    @property
    def mean_life_low(self) -> float:
        """The lower end of its interval: ``watched_periods / 3`` at 95 % where nothing escaped."""
        return _inverse(self.escape_rate_high)

    @property
    def mean_life_high(self) -> float:
        """The upper end of its interval, infinity where nothing escaped."""
        return _inverse(self.escape_rate_low)

    @property
    def persistence(self) -> Persistence:
        """Whether the motions leave."""
        if self.n_watched == 0:
            return Persistence.DIRECT
        return Persistence.TRANSIENT if self.escapes else Persistence.LASTING

    @property
    def told(self) -> str:
        """The mean life in words, with its interval; without an escape what it is at least; empty without a watch."""
        low, life, high = map(_three_digits, (self.mean_life_low, self.mean_life, self.mean_life_high))
        if self.n_watched == 0:
            return ""
        return (
            f"mean life {life} mesh periods ({low} to {high})"
            if self.escapes
            else f"mean life at least {low} mesh periods"
        )

    def __str__(self) -> str:
        told = f"{self.told} at {self.confidence:.4g} confidence" if self.told else self.persistence.remedy
        return (
            f"{self.escapes} of {self.n_watched} motions escaped in {self.watched_periods} mesh periods watched: {told}"
        )


@checked
def escape_rate(times: ArrayLike, watched: ArrayLike, *, discard: int = 0, confidence: float = 0.95) -> EscapeRate:
    """The constant rate at which motions leave, where some have and the others were still there when the watch ended.

    Parameters
    ----------
    times : array_like of float, shape (n,)
        The mesh period at whose end each motion had left; nan where it had not.
    watched : array_like of float, shape (n,) or ()
        Mesh periods that each was watched for, where it had not left.
    discard : int
        Mesh periods at the beginning that do not count, for the motions have yet to reach the set.
    confidence : float
        Of the interval.

    Notes
    -----
    Every mesh period watched is a trial in which the motion leaves with the same probability p. With k escapes in N
    periods the likelihood ``p^k (1 - p)^(N - k)``, whoever was watched for how long, is greatest at ``p = k / N``, and
    the rate is ``-log(1 - p)``. The interval of p is exact, of Clopper and Pearson (1934); for small p that is the
    chi-square interval of a Poisson count. With ``k = 0`` it is one-sided: ``-log(1 - confidence) / N``, at 95 % the
    "rule of three".

    Examples
    --------
    >>> print(escape_rate([120, 340, float("nan")], 1000))
    2 of 3 motions escaped in 1460 mesh periods watched: mean life 729 mesh periods (202 to 6030) at 0.95 confidence
    >>> print(escape_rate([float("nan")] * 3, 1000))
    0 of 3 motions escaped in 3000 mesh periods watched: mean life at least 1000 mesh periods at 0.95 confidence
    """
    left, ends = _checked(times, watched)
    discard = check_count("discard", discard, at_least=0)
    confidence = check_number("confidence", confidence, above=0.0, below=1.0)
    counted = ends > discard
    n, k = int((ends - discard)[counted].sum()), int(left[counted].sum())
    return counted_rate(int(counted.sum()), n, k, confidence)


def counted_rate(n_watched: int, n: int, k: int, confidence: float = 0.95) -> EscapeRate:
    """The rate from `k` escapes of `n_watched` motions in `n` mesh periods watched; see `escape_rate`."""
    best = k / n if n else math.nan
    low, high = _interval(k, n, confidence)
    return EscapeRate(n_watched, n, k, _rate(best), _rate(low), _rate(high), confidence)


def _checked(times: ArrayLike, watched: ArrayLike) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Which motions left, and when each did or the watch ended; or a ValueError."""
    at = check_array("times", times, finite=False)
    if at.ndim != 1 or at.size == 0:
        raise ValueError(f"times must be a non-empty sequence of numbers, got shape {at.shape}")
    checked_most = check_array("watched", watched, finite=False)
    try:
        most = np.broadcast_to(checked_most, at.shape)
    except ValueError:
        raise ValueError(
            f"watched must be one number, or one for each of the {at.size} times, got shape {np.shape(watched)}"
        ) from None
    left = ~np.isnan(at)
    ends = np.where(left, at, most)
    for name, values in (("watched", most), ("times", ends)):
        wrong = ~np.isfinite(values) | (values < 0.0) | (values != np.round(values))
        if wrong.any():
            raise ValueError(f"{name} must be whole numbers of at least 0, got {values[wrong][0]}")
    late = ends > most
    if late.any():
        raise ValueError(f"times must not exceed the periods watched, got {ends[late][0]:g} of {most[late][0]:g}")
    return left, ends


def _interval(k: int, n: int, confidence: float) -> tuple[float, float]:
    """The exact interval of a probability that k of n trials show; one-sided where none does."""
    from scipy.special import betaincinv  # here, so that importing gearpair stays quick

    if n == 0:
        return 0.0, 1.0
    if k == 0:
        return 0.0, -math.expm1(math.log1p(-confidence) / n)
    tail = 0.5 * (1.0 - confidence)
    return float(betaincinv(k, n - k + 1, tail)), float(betaincinv(k + 1, n - k, 1.0 - tail)) if k < n else 1.0


def _rate(p: float) -> float:
    """The rate at which survivors fall that leave with probability p each period."""
    return math.inf if p == 1.0 else -math.log1p(-p) + 0.0


def _inverse(rate: float) -> float:
    return math.inf if rate == 0.0 else 1.0 / rate


def _three_digits(number: float) -> str:
    """A number without an exponent."""
    return f"{number:.3g}" if not 1000.0 <= number < math.inf else f"{float(f'{number:.3g}'):.0f}"
