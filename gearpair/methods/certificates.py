"""The exact flow taken apart: every segment of a motion, and the certificate by which its impacts were found."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, checked, plain
from gearpair._equality import equal_by_value
from gearpair._flow.closed_form import DEGREE, REACH, TERMS, evaluate_jerk
from gearpair._flow.event_search import MAX_STEPS, MONOTONE, ROUNDING, certified_step
from gearpair._flow.records import SPAN, STARTS
from gearpair._flow.walk import EVENT_UNDECIDED
from gearpair.motion.trajectories import check_start, raise_unless_ok, segment_rows
from gearpair.oscillator import Oscillator
from gearpair.table import Table


@dataclass(frozen=True)
class CertifiedStep:
    """One step from `t`, `length` widths of the cell long, that cannot pass the `boundary`, which is +1 or -1.

    On it the distance is at least ``d + u h + m h^2 / 2``: `d` at its start, `u` its rate, and `m` a lower bound of its
    second derivative over the step (per t).
    """

    t: float
    boundary: float
    d: float
    u: float
    m: float
    length: float


@equal_by_value
@dataclass(frozen=True)
class Segment:
    """A piece of the motion inside one cell and one region, as a power series in t (unit: the cell's width).

    Attributes
    ----------
    start : float
        In mesh periods since the motion's start.
    width : float
        Of the cell, in mesh periods.
    region : int
        -1 coast-side contact, 0 free flight, +1 drive-side contact.
    series : ndarray of float
        X is the sum of ``series[n] t**n``.
    span : float
        What is left of the cell, in widths: 1 but for a segment that begins with an impact.
    fourth : float
        A bound of the fourth derivative by t.
    crossing : float or None
        The t at which the engine found that the motion leaves the region.

    Examples
    --------
    >>> first = segments(Oscillator(), 1.5, 0.0)[0]
    >>> first.region, first.certificate, bool(first(0.0) == 1.5)
    (1, 'hull', True)
    """

    start: float
    width: float
    region: int
    series: NDArray[np.float64]
    span: float
    fourth: float
    crossing: float | None

    def __call__(self, t: ArrayLike) -> Any:
        """X at `t` by the series."""
        return plain(np.asarray(np.polynomial.polynomial.polyval(check_array("t", t), self.series), dtype=float))

    @cached_property
    def control_points(self) -> NDArray[np.float64]:
        """The Bézier points (t, X) of the cubic Hermite interpolant, shape (4, 2)."""
        slope = np.polynomial.polynomial.polyder(self.series)
        b0, b3 = self(0.0), self(self.span)
        third = self.span / 3.0
        b1, b2 = b0 + third * slope[0], b3 - third * np.polynomial.polynomial.polyval(self.span, slope)
        return np.column_stack([np.arange(4) * third, [b0, b1, b2, b3]])

    def cubic(self, t: ArrayLike) -> Any:
        """The cubic Hermite interpolant at `t`."""
        b0, b1, b2, b3 = self.control_points[:, 1]
        s = check_array("t", t) / self.span
        r = 1.0 - s
        return plain(b0 * r**3 + 3.0 * b1 * r**2 * s + 3.0 * b2 * r * s**2 + b3 * s**3)

    @property
    def spread(self) -> float:
        """How far the motion can be from the cubic: ``span^4 max |X''''| / 384``."""
        return self.fourth * self.span**4 / 384.0

    @property
    def boundaries(self) -> tuple[float, float]:
        """Floor and ceiling of the region, infinite where there is none."""
        return {-1: (-np.inf, -1.0), 0: (-1.0, 1.0), 1: (1.0, np.inf)}[self.region]

    @property
    def clearance(self) -> float:
        """Distance from the hull, widened by `spread`, to the nearest boundary; negative where it sticks out."""
        floor, ceiling = self.boundaries
        heights = self.control_points[:, 1]
        return float(min(heights.min() - self.spread - floor, ceiling - heights.max() - self.spread))

    @cached_property
    def certificate(self) -> str:
        """The first that holds: ``"hull"``, ``"monotone"`` or ``"steps"``."""
        if self.clearance >= 0.0:
            return "hull"
        differences = np.diff(self.control_points[:, 1])
        margin = MONOTONE * self.spread
        if np.all(differences > margin) or np.all(differences < -margin):
            return "monotone"
        return "steps"

    def certified_steps(self) -> tuple[list[CertifiedStep], float | None]:
        """The search by certified steps alone, whatever certificate holds, and the t where they arrive at the boundary.

        None where they reach the end.
        """
        tiny = ROUNDING * max(1.0, abs(self.series[0]))
        t = 0.0
        steps: list[CertifiedStep] = []
        for _ in range(MAX_STEPS):
            p, u, a, j = evaluate_jerk(self.series, t)
            rest = self.span - t
            found = []
            for boundary, sign in zip(self.boundaries, (1.0, -1.0), strict=True):
                if np.isfinite(boundary):
                    d = sign * (p - boundary)
                    if d <= tiny and sign * u < 0.0:
                        return steps, t
                    length, m = self._longest(max(d, 0.0), sign * u, sign * a, sign * j, rest)
                    if d <= tiny:  # at rest on the boundary or leaving it
                        length = max(length, float(np.sqrt(tiny / (abs(a) + abs(j) + self.fourth + ROUNDING))))
                    found.append(CertifiedStep(t, boundary, d, sign * u, m, length))
            shortest = min(found, key=lambda step: step.length)
            steps.append(shortest)
            t += shortest.length
            if t >= self.span:
                return steps, None
        raise_unless_ok(EVENT_UNDECIDED, 0)
        return steps, None

    def _longest(self, d: float, u: float, a: float, j: float, end: float) -> tuple[float, float]:
        """`event_search.longest_step`, with the bound m that the step was taken with."""
        step, bound = 0.0, -np.inf
        while end > step:
            m = a + min(0.0, j * end) - 0.5 * self.fourth * end * end
            length = min(end, certified_step(d, u, m))
            if length >= step:
                step, bound = length, m
            end *= 0.5
        return step, bound


@checked
def segments(osc: Oscillator, x: float, v: float, n_periods: int = 1) -> list[Segment]:
    """Every segment of the motion from (x, v) over `n_periods` mesh periods, in the order of time.

    A cell without an impact is one segment, each impact adds one.

    Raises
    ------
    RuntimeError
        Where an impact cannot be told from a near miss.

    Examples
    --------
    >>> from gearpair import trajectory
    >>> pieces = segments(Oscillator(), 1.0, 0.0)
    >>> impacts = trajectory(Oscillator(), 1.0, 0.0, 1).impacts
    >>> sum(piece.crossing is not None for piece in pieces) == len(impacts)
    True
    """
    x, v = check_start(x, v)
    n_periods = check_count("n_periods", n_periods)
    rows, _ = segment_rows(osc, x, v, n_periods)
    rows[:, [STARTS, SPAN]] *= osc.mesh_periods
    return [
        Segment(start, width, int(region), row[-TERMS:], rest, fourth, crossing if crossing >= 0.0 else None)
        for row, (start, width, region, rest, fourth, crossing) in zip(rows, rows[:, :-TERMS].tolist(), strict=True)
    ]


@checked
def certificate_examples(pieces: Iterable[Segment]) -> dict[str, Segment | None]:
    """The segments that show the three certificates best; None where there is no such segment.

    ``"hull"``, a whole cell with a turn: the nearest to a boundary. ``"monotone"``, a whole cell: the crossing nearest
    to its middle. ``"near miss"``: the closest approach without a crossing that needs steps. ``"crossing by steps"``:
    the one that takes the most of them.

    Examples
    --------
    >>> found = certificate_examples(segments(Oscillator(mesh_frequency=1.219), 1.0, 0.0, 50))
    >>> {name: piece.certificate for name, piece in found.items() if piece}
    {'hull': 'hull', 'monotone': 'monotone', 'crossing by steps': 'steps'}
    """
    pieces = list(pieces)
    whole = [piece for piece in pieces if piece.span == 1.0]
    hull = [piece for piece in whole if piece.certificate == "hull" and _turns(piece)]
    monotone = [piece for piece in whole if piece.certificate == "monotone" and piece.crossing is not None]
    stepped = [piece for piece in pieces if piece.certificate == "steps"]
    misses = [piece for piece in stepped if piece.crossing is None and _closest(piece) < np.inf]
    crossed = [piece for piece in stepped if piece.crossing is not None]
    return {
        "hull": min(hull, key=lambda piece: piece.clearance, default=None),
        "monotone": min(monotone, key=lambda piece: abs((piece.crossing or 0.0) - 0.5), default=None),
        "near miss": min(misses, key=_closest, default=None),
        "crossing by steps": max(crossed, key=lambda piece: len(piece.certified_steps()[0]), default=None),
    }


def _turns(piece: Segment) -> bool:
    """Whether the cubic rises and falls."""
    slopes = np.diff(piece.control_points[:, 1])
    return bool(slopes.min() < 0.0 < slopes.max())


def _closest(piece: Segment) -> float:
    """The smallest distance to a boundary, on a fine grid; inf where it is at an end."""
    floor, ceiling = piece.boundaries
    x = piece(np.linspace(0.0, piece.span, 65))
    distance = np.minimum(x - floor, ceiling - x)
    return float(distance.min()) if 0 < distance.argmin() < 64 else np.inf


@checked
def certificate_table(pieces: Iterable[Segment]) -> Table:
    """How many segments each certificate settles, and how many of these hold a crossing.

    Examples
    --------
    >>> from gearpair.methods import segments
    >>> len(certificate_table(segments(Oscillator(), 1.0, 0.0)).rows)
    3
    """
    kinds = [(piece.certificate, piece.crossing is not None) for piece in pieces]
    rows = [
        [f"{i}. {name}", sum(kind == name for kind, _ in kinds), kinds.count((name, True))]
        for i, name in enumerate(("hull", "monotone", "steps"), start=1)
    ]
    return Table(["certificate", "segments", "with a crossing"], rows)


@checked
def series_table(osc: Oscillator) -> Table:
    """The constants of the power series and the cells that `osc` needs.

    Examples
    --------
    >>> series_table(Oscillator()).rows[0]
    ('degree of the series', '15')
    """
    neglected = REACH**TERMS / float(np.prod(np.arange(1.0, TERMS + 1)))
    rows = [
        ["degree of the series", f"{DEGREE}"],
        ["reach: the most that a rate turns in a cell", f"{REACH:.1f}"],
        ["first neglected term", f"{neglected:.0e}"],
        ["cells in the mesh period", f"{len(osc.cells.level)}"],
    ]
    return Table(["of the closed form", "value"], rows)
