"""All methods timed in turns, so that whatever slows the machine slows them alike."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from time import perf_counter

from benchmarks.accuracy import Accuracy, OnePeriod
from benchmarks.methods import CHAOTIC, Method
from gearpair.table import Table


def race(methods: Sequence[Method], starts: Sequence[OnePeriod], rounds: int) -> list[list[float]]:
    """Microseconds per mesh period of each method in each round; every round takes another start."""
    for method in methods:
        method.run(starts[0].x, starts[0].v, 1)  # compiled before the clock starts
    times: list[list[float]] = [[] for _ in methods]
    for i in range(rounds):
        start = starts[i % len(starts)]
        for method, kept in zip(methods, times, strict=True):
            begin = perf_counter()
            method.run(start.x, start.v, method.n_periods)
            kept.append((perf_counter() - begin) / method.n_periods * 1e6)
    return times


def comparison(methods: Sequence[Method], accuracies: Sequence[Accuracy], times: Sequence[Sequence[float]]) -> Table:
    """Median and least time, the median over rounds of the ratio to the exact flow, and the largest error."""
    base = next(t for m, t in zip(methods, times, strict=True) if m.exact and m.oscillator.mesh_frequency == CHAOTIC)
    rows = []
    for method, accuracy, kept in zip(methods, accuracies, times, strict=True):
        ratio = median(own / exact for own, exact in zip(kept, base, strict=True))
        rows.append(
            (
                method.name,
                method.oscillator.mesh_frequency,
                f"{median(kept):.3g}" if median(kept) < 1000 else f"{median(kept):.0f}",
                f"{min(kept):.3g}" if min(kept) < 1000 else f"{min(kept):.0f}",
                f"{ratio:.2g}" if ratio < 100 else f"{ratio:.0f}",
                f"{accuracy.error:.0e}",
                f"{accuracy.share:.0e}",
            )
        )
    return Table(("method", "Omega_h", "us / period", "at best", "to exact flow", "error", "error / promised"), rows)
