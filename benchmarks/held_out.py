"""Whether a start that is called aperiodic settles when it is marched on: 60 speeds, both readings, 35 starts each.

``python -m benchmarks.held_out`` takes some minutes, ``python -m benchmarks.held_out 5`` less: speeds of each reading.
A file named after the number keeps the truth, which the next run then need not find again.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

import gearpair as gp
from benchmarks.labels import ON_ORBIT
from gearpair.table import Table

SPEEDS, SEED = 60, 20
SLOWEST, FASTEST = 0.4, 1.9
READINGS: tuple[Literal["printed", "swapped"], ...] = "printed", "swapped"
X, V = np.linspace(-3.0, 3.0, 7), np.linspace(-2.0, 2.0, 5)
WITHIN = 20_000  # mesh periods: what settles by then must not be called aperiodic
MOST = 200_000

# The sign of a cycle: every one of the last points comes again after `p` mesh periods, four of the longest cycles long.
LONGEST_PERIOD, CYCLES, AGAIN, ROUGHLY = 64, 4, 1e-9, 1e-6
SPAN, LATER_SPAN = 500, 5000  # mesh periods between two looks, until `WITHIN` and after it


class Marched(NamedTuple):
    """What became of starts; `points` are those of the cycle with the smallest X, nan where there is none."""

    settled: NDArray[np.int64]  # (n,) mesh periods by which the motion repeats itself, 0 where it never did
    period: NDArray[np.int64]  # (n,) of the cycle, 0 where there is none
    escaped: NDArray[np.bool_]  # (n,)
    points: NDArray[np.float64]  # (n, 2)


def looks(most: int) -> list[int]:
    """The mesh periods after which a march of `most` is looked at."""
    early = range(SPAN, WITHIN, SPAN)
    return [n for n in [*early, *range(WITHIN, most, LATER_SPAN)] if n < most] + [most]


def march(osc: gp.Oscillator, starts: NDArray[np.float64], most: int = MOST) -> Marched:
    """March starts (n, 2) by the stroboscopic map alone until each repeats itself, `most` mesh periods at the most.

    Nothing of what the library judges motions by is used: no Newton, no neighbourhood, no exponent.
    """
    n = len(starts)
    out = Marched(np.zeros(n, np.int64), np.zeros(n, np.int64), np.zeros(n, np.bool_), np.full((n, 2), np.nan))
    here, left, done, window = starts.copy(), np.arange(n), 0, CYCLES * LONGEST_PERIOD
    for look in looks(most):
        seen = [onward(osc, here, look - window - done)]
        while len(seen) <= window:
            seen.append(onward(osc, seen[-1]))
        points, done = np.stack(seen, axis=1), look
        out.escaped[left] = ~np.isfinite(points[:, -1]).all(axis=1)
        left, points = left[~out.escaped[left]], points[~out.escaped[left]]
        period = repeats(points)
        for i in np.flatnonzero(period):
            cycle = points[i, -period[i] :]
            out.points[left[i]] = cycle[np.argmin(cycle[:, 0])]
        out.settled[left[period > 0]], out.period[left] = look, period
        left, here = left[period == 0], points[period == 0, -1]
        if not left.size:
            break
    return out


def onward(osc: gp.Oscillator, states: NDArray[np.float64], n: int = 1) -> NDArray[np.float64]:
    """States (m, 2) after `n` mesh periods more; those that have escaped stay infinite."""
    there = np.full_like(states, np.inf)
    here = np.isfinite(states).all(axis=1)
    there[here] = np.stack(gp.stroboscopic_map(osc, states[here, 0], states[here, 1], n), axis=1)
    return there


def repeats(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """The period of each motion whose successive points (n, m, 2) come again, 0 where they do not.

    A motion that turns about its cycle while it falls onto it comes nearest to where it was after several rounds: so
    the period is the least after which the points come again `ROUGHLY`, which near a cycle is that of the cycle.
    """
    size = np.maximum(1.0, np.abs(points).max(axis=(1, 2)))
    apart = [np.abs(points[:, p:] - points[:, :-p]).max(axis=(1, 2)) / size for p in range(1, LONGEST_PERIOD + 1)]
    near = np.stack(apart) <= ROUGHLY
    return np.where(np.min(apart, axis=0) <= AGAIN, np.argmax(near, axis=0) + 1, 0)


def oscillators(speeds: int = SPEEDS) -> list[tuple[str, gp.Oscillator]]:
    """The held-out set: `speeds` oscillators of each reading of the stiffness, otherwise the baseline."""
    drawn = np.sort(np.random.default_rng(SEED).uniform(SLOWEST, FASTEST, SPEEDS))[:: max(1, SPEEDS // speeds)][:speeds]
    return [
        (
            reading,
            gp.Oscillator(
                stiffness=gp.StiffnessWave.rectangular(reading=reading), mesh_frequency=round(float(speed), 6)
            ),
        )
        for reading in READINGS
        for speed in drawn
    ]


def starts() -> NDArray[np.float64]:
    """The starts (35, 2), X' by X as `gearpair.basins` has them."""
    return np.stack([np.tile(X, len(V)), np.repeat(V, len(X))], axis=1)


@dataclass(frozen=True)
class Verdict:
    """What `gearpair.basins` says of the starts of one oscillator, against what they do.

    Attributes
    ----------
    statuses : dict of str to int
        How many starts have each status.
    hasty : int
        Starts called aperiodic or unsettled that settle within `WITHIN` mesh periods.
    latest : int
        The mesh period by which the last of these has settled.
    astray : int
        Starts called periodic on a cycle that is not theirs. Where a march took longer than `SPAN`, through chaos that
        another rounding leads elsewhere, any cycle will do that some start is marched to.
    """

    reading: str
    mesh_frequency: float
    statuses: dict[str, int]
    hasty: int
    latest: int
    astray: int


def judge(reading: str, osc: gp.Oscillator, marched: Marched) -> Verdict:
    """Label the starts with the library's defaults and compare."""
    plane = gp.basins(osc, X, V)
    status = plane.status.values.ravel()
    hasty = np.isin(status, ("aperiodic", "unsettled")) & (marched.settled > 0) & (marched.settled <= WITHIN)
    cycles = np.stack([plane.attractor_x, plane.attractor_v], axis=1)[plane.attractor.values.ravel()]
    same = plane.period.values.reshape(-1, 1) == marched.period
    same &= np.abs(cycles[:, np.newaxis] - marched.points).max(axis=2) <= ON_ORBIT  # nan where there is no cycle
    on_one = np.where(marched.settled == SPAN, np.diag(same), same.any(axis=1))
    counts = {str(word): int(np.sum(status == word)) for word in np.unique(status)}
    latest = int(marched.settled[hasty].max(initial=0))
    astray = int(np.sum((status == "periodic") & ~on_one))
    return Verdict(reading, osc.mesh_frequency, counts, int(hasty.sum()), latest, astray)


def table(verdicts: list[Verdict]) -> Table:
    """One row an oscillator."""
    rows = [
        (v.reading, f"{v.mesh_frequency:.6f}", counted(v.statuses), v.hasty, v.latest or "", v.astray) for v in verdicts
    ]
    return Table(("reading", "Omega_h", "starts", "not periodic, but settle", "by", "on another cycle"), rows)


def counted(statuses: dict[str, int]) -> str:
    """How many starts have each status, in words."""
    return ", ".join(f"{n} {status}" for status, n in statuses.items())


def truth(pairs: list[tuple[str, gp.Oscillator]], file: Path | None = None) -> list[Marched]:
    """What the starts of each oscillator do, from the `file` if it is there, otherwise marched and kept in it."""
    if file is None or not file.exists():
        marches = [march(osc, starts()) for _, osc in pairs]
        if file is not None:
            speeds = np.array([osc.mesh_frequency for _, osc in pairs])
            columns: dict[str, Any] = {
                name: np.stack([getattr(each, name) for each in marches]) for name in Marched._fields
            }
            np.savez(file, mesh_frequency=speeds, reading=[reading for reading, _ in pairs], starts=starts(), **columns)
        return marches
    with np.load(file) as kept:
        if kept["mesh_frequency"].tolist() != [osc.mesh_frequency for _, osc in pairs]:
            raise ValueError(f"{file} must hold the truth of these speeds; remove it, or name another")
        return [Marched(*rows) for rows in zip(*(kept[name] for name in Marched._fields), strict=True)]


def main(arguments: Sequence[str]) -> int:
    """Print what is wrong, and return 1 where anything is."""
    pairs = oscillators(int(arguments[0]) if arguments else SPEEDS)
    marches = truth(pairs, Path(arguments[1]) if len(arguments) > 1 else None)
    verdicts = [judge(*pair, marched) for pair, marched in zip(pairs, marches, strict=True)]
    wrong = [v for v in verdicts if v.hasty or v.astray]
    if wrong:
        print(table(wrong))
    hasty, astray, n = sum(v.hasty for v in wrong), sum(v.astray for v in wrong), len(starts()) * len(pairs)
    print(f"of {n} starts {hasty} settle within {WITHIN} mesh periods and are not called periodic, {astray} are astray")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
