"""Whether capture ever changes a label: 10^5 starts of twelve oscillators, marched until nothing is left of the start.

``python -m benchmarks.labels`` takes some minutes, ``python -m benchmarks.labels 500`` less: starts of each oscillator.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import gearpair as gp
from gearpair.ensembles.capture import known_attractors, numbered, scouts
from gearpair.ensembles.datasets import settled_columns
from gearpair.motion.settling import STATUSES, SettleSettings, Status, settle_batch
from gearpair.table import Table

STARTS = 8334
ON_ORBIT = 1e-5  # a motion that still is this near to a cycle of its label, after so long, has settled on it


@dataclass(frozen=True)
class Case:
    """One oscillator and the rectangle of its starts."""

    name: str
    oscillator: gp.Oscillator
    reach: tuple[float, float] = (4.0, 3.0)


def cases() -> list[Case]:
    """Weak damping, nearly a fold, nearly a flip, fractal boundaries, chaos beside cycles, escape."""
    base = gp.Oscillator()
    swapped = base.replace(stiffness=gp.StiffnessWave.rectangular(reading="swapped"))
    cycle = gp.steady_state(base)
    orbit = gp.periodic_orbit(base, cycle.points[0, 0], cycle.points[0, 1], 2)
    ends = gp.continue_orbit(orbit, "mesh_frequency", 0.4, 1.2).bifurcations
    fold = next(b.value for b in ends if b.kind == "fold")
    flip = next(b.value for b in ends if b.kind == "flip")
    return [
        Case("baseline", base),
        Case("swapped reading", swapped),
        Case("swapped, damping 1e-3", swapped.replace(damping_ratio=1e-3)),
        Case("damping 1e-3", base.replace(damping_ratio=1e-3)),
        Case("damping 1e-3, speed 1.5", base.replace(damping_ratio=1e-3, mesh_frequency=1.5)),
        Case("inside a fold by 1e-4", base.replace(mesh_frequency=fold + 1e-4)),
        Case("inside a flip by 1e-4", base.replace(mesh_frequency=flip - 1e-4)),
        Case("beyond a flip by 1e-4", base.replace(mesh_frequency=flip + 1e-4)),
        Case("fractal boundaries", base.replace(damping_ratio=0.005)),
        Case("chaos", base.replace(mesh_frequency=1.219)),
        Case("chaos beside cycles", base.replace(mesh_frequency=1.25, damping_ratio=0.01)),
        Case("escape", base.replace(damping_ratio=0.001, mesh_frequency=1.95), (300.0, 300.0)),
    ]


@dataclass(frozen=True)
class Outcome:
    """What became of the starts of a case.

    Attributes
    ----------
    changed : int
        Starts labelled periodic whose motion, marched on, is not on that cycle.
    missed : int
        Starts not labelled periodic whose motion, marched on, is on a known cycle.
    """

    case: Case
    statuses: dict[str, int]
    attractors: int
    captured: float
    mean_settling: float
    changed: int
    missed: int


def compare(case: Case, n: int, seed: int = 0) -> Outcome:
    """Label `n` random starts by capture, and march each of them on without it."""
    osc = case.oscillator
    starts = np.random.default_rng(seed).uniform(-1.0, 1.0, (n, 2)) * case.reach
    settings = SettleSettings(n_exponent=500, n_samples=64)
    known = known_attractors(osc, starts[scouts(n)], settings)
    out = settle_batch([osc], starts, settings, known=known)
    result = numbered(settled_columns(out), settings.before_watch(osc), known.lasting)
    labels, first = result.columns["attractor"], result.table["first"]
    periodic = out.status == STATUSES.index(Status.PERIODIC)
    ends = march_on(osc, starts, -out.exponents[periodic, 0].max(initial=-osc.damping_ratio))
    changed = int(np.sum(periodic & (np.abs(gaps(ends, labels, out.points[first], out.period[first])) > ON_ORBIT)))
    cycles = [k for k, row in enumerate(first) if periodic[row]]
    on_any = np.zeros(n, bool)
    for k in cycles:
        on_any |= gaps(ends, np.full(n, k), out.points[first], out.period[first]) <= ON_ORBIT
    counts = {str(STATUSES[code]): int(np.sum(out.status == code)) for code in np.unique(out.status)}
    settling = float(np.mean(out.way[periodic, 0])) if periodic.any() else np.nan
    missed = int(np.sum(~periodic & on_any))
    return Outcome(case, counts, len(first), float(np.mean(out.attractor >= 0)), settling, changed, missed)


def march_on(osc: gp.Oscillator, starts: NDArray[np.float64], slowest: float) -> NDArray[np.float64]:
    """States (n, 2) after so many mesh periods that a transient of the `slowest` rate has fallen by exp(-30)."""
    n = int(np.clip(30.0 / (slowest * osc.period), 2000, 30_000))
    return np.stack(gp.stroboscopic_map(osc, starts[:, 0], starts[:, 1], n), axis=1)


def gaps(
    ends: NDArray[np.float64], labels: NDArray[np.int64], points: NDArray[np.float64], periods: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Distance (n,) of each state from the nearest section point of the attractor that it is labelled with."""
    apart = np.full(len(ends), np.inf)
    for k, period in enumerate(periods):
        own = labels == k
        if period and own.any():
            apart[own] = np.abs(ends[own, np.newaxis] - points[k, :period]).max(axis=2).min(axis=1)
    return apart


def table(outcomes: list[Outcome]) -> Table:
    """One row a case."""
    rows = [
        (
            o.case.name,
            ", ".join(f"{n} {status}" for status, n in o.statuses.items()),
            o.attractors,
            f"{o.captured:.1%}",
            f"{o.mean_settling:.0f}",
            o.changed,
            o.missed,
        )
        for o in outcomes
    ]
    return Table(("oscillator", "starts", "attractors", "captured", "periods", "changed", "missed"), rows)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else STARTS
    done = []
    for case in cases():
        done.append(compare(case, count))
        print(table(done[-1:]), flush=True)
    print(f"{sum(o.changed for o in done)} of {count * len(done)} labels changed")
