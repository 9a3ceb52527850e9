"""How far each method is off after one mesh period, against a solution with seventy digits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite

import gearpair as gp
from benchmarks.methods import CHAOTIC, Method
from tests.support.reference import Reference, mpmath_period

PROMISED = 1e-13  # of max(1, |state|) times the map's own amplification of errors


@dataclass(frozen=True)
class OnePeriod:
    """A start and where it leads within one mesh period, known to fifty digits at least."""

    x: float
    v: float
    end: Reference


@dataclass(frozen=True)
class Accuracy:
    """The largest error of one method over its starts.

    Parameters
    ----------
    error : float
        Relative to max(1, \\|state\\|).
    share : float
        The largest of error / amplification, in units of what is promised; above 1 the promise is broken.
    """

    error: float
    share: float


def reference_periods(osc: gp.Oscillator, n: int) -> list[OnePeriod]:
    """The reference over one period from `n` section points, spread over the motion from (1.3, 0.2).

    A chaotic motion's points come after the transient; others begin at once, or all points would be alike.
    """
    x, v = (float(end) for end in gp.stroboscopic_map(osc, 1.3, 0.2, 1000 if osc.mesh_frequency == CHAOTIC else 0))
    periods = []
    for _ in range(n):
        periods.append(OnePeriod(x, v, mpmath_period(osc, x, v)))
        x, v = (float(end) for end in gp.stroboscopic_map(osc, x, v))
    return periods


def measure(method: Method, periods: Sequence[OnePeriod]) -> Accuracy:
    """Run a method over each of the periods alone."""
    error = share = 0.0
    for period in periods:
        x, v = method.run(period.x, period.v, 1)
        off = period.end.error(x, v) if isfinite(x) and isfinite(v) else inf
        error, share = max(error, off), max(share, off / (PROMISED * period.end.amplification))
    return Accuracy(error, share)


def shortfall(methods: Sequence[Method], accuracies: Sequence[Accuracy]) -> str:
    """The sentence that says where the exact flow breaks its promise, or nothing."""
    falls = [
        (a.share, m.oscillator.mesh_frequency, a.error)
        for m, a in zip(methods, accuracies, strict=True)
        if m.exact and a.share > 1.0
    ]
    if not falls:
        return ""
    share, omega, error = max(falls)
    return (
        f"accuracy falls short: at Omega_h = {omega} the exact flow is off by {error:.1e} after one mesh period, "
        f"{share:.2g} times what is promised ({PROMISED:.0e} of max(1, |state|) times the map's own amplification)"
    )
