"""The bifurcation structure of a set of branches, as ranges of coexistence and of stability."""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby, pairwise

import numpy as np

from gearpair._checks import check_count, checked
from gearpair.bifurcations.branches import Branch
from gearpair.bifurcations.locating import Bifurcation
from gearpair.ensembles.ranges import MotionRange, joined_ranges
from gearpair.motion.names import IMPACT_NAMES, Motion, periodic
from gearpair.quantities import symbol
from gearpair.table import Table

SNAP = 2e-4  # relative distance within which the end of a stable range is the bifurcation found there


@checked
def coexistence(
    branches: list[Branch], lower: float, upper: float, *, shortest: float = 0.0
) -> list[tuple[float, float, tuple[Motion, ...]]]:
    """Which stable orbits of a set of branches exist together, range by range: start, end, and their motions.

    Orbits of one period and impact state on one branch count once each.

    Parameters
    ----------
    branches : list of Branch
        Along one parameter.
    lower, upper : float
        The range of the parameter.
    shortest : float
        Ranges narrower than this are left out.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> branch = continue_orbit(periodic_orbit(Oscillator(), 0.34629, -0.25625, 2), "mesh_frequency", 0.7, 0.8)
    >>> for low, high, motions in coexistence([branch], 0.7, 0.8):
    ...     print(f"{low:.3f} {high:.3f}", *motions)
    0.700 0.766 period 2, single-sided
    0.766 0.800
    """
    pieces = [piece for branch in branches for piece in _stable_pieces(branch) if piece.width >= shortest]
    # A branch that ends close to a bifurcation ends at it.
    located = [b.value for branch in branches for b in branch.bifurcations]

    def snapped(value: float) -> float:
        nearest = min(located, key=lambda each: abs(each - value), default=value)
        return nearest if abs(nearest - value) <= SNAP * max(1.0, abs(value)) else value

    pieces = [MotionRange(snapped(p.lower), snapped(p.upper), p.motion) for p in pieces]
    ends = {end for piece in pieces for end in (piece.lower, piece.upper) if lower < end < upper}

    def there(cell: tuple[float, float]) -> tuple[Motion, ...]:
        return tuple(sorted(piece.motion for piece in pieces if piece.lower <= 0.5 * sum(cell) <= piece.upper))

    runs = [(motions, list(run)) for motions, run in groupby(pairwise(sorted({lower, upper, *ends})), there)]
    ranges = [(run[0][0], run[-1][1], motions) for motions, run in runs]
    return [each for each in ranges if each[1] - each[0] >= shortest]


@checked
def stable_ranges(branches: Iterable[Branch], *, shortest: float = 0.0) -> tuple[MotionRange, ...]:
    """Where each kind of motion is stable on some branch, between the bifurcations that bound it; see `coexistence`.

    The ranges come by rising lower end; what overlaps or touches is one range, whatever the impact states.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> branch = continue_orbit(periodic_orbit(Oscillator(), 0.34629, -0.25625, 2), "mesh_frequency", 0.7, 0.8)
    >>> [(str(run.motion), round(run.lower, 4), round(run.upper, 4)) for run in stable_ranges([branch])]
    [('period 2', 0.7, 0.766)]
    """
    pieces = (piece for branch in branches for piece in _stable_pieces(branch))
    runs = joined_ranges(MotionRange(piece.lower, piece.upper, piece.motion.kind) for piece in pieces)
    return tuple(run for run in runs if run.width >= shortest)


def _stable_pieces(branch: Branch) -> list[MotionRange]:
    """Parameter ranges of the stable orbits of a branch, cut where the impact state changes or the branch turns."""
    states, values = branch.impact_states(), branch.values
    runs: list[list[int]] = []
    for i in np.flatnonzero(branch.stable).tolist():
        if runs and runs[-1][-1] == i - 1 and states[i - 1] == states[i]:
            steps = np.diff(values[[*runs[-1][-2:], i]])
            if steps[0] * steps[-1] >= 0.0:  # it does not turn
                runs[-1].append(i)
                continue
        runs.append([i])
    pieces = []
    for run in runs:
        reached = [_edge(branch, run[0] - 1), *values[run].tolist(), _edge(branch, run[-1])]
        pieces.append(MotionRange(min(reached), max(reached), periodic(branch.period, states[run[0]])))
    return pieces


def _edge(branch: Branch, i: int) -> float:
    """Where between the orbits `i` and ``i + 1`` a stable range ends, or the branch's own end.

    Stability changes at a fold or a flip, the impact state at a grazing, and one step may pass several: the one next to
    the stable orbit ends its range.
    """
    if not 0 <= i < len(branch.values) - 1:
        return float(branch.values[max(i, 0)])
    changed = branch.stable[i] != branch.stable[i + 1]
    between = [b for b, row in zip(branch.bifurcations, branch.bifurcation_rows, strict=True) if row == i]
    fitting = [b.value for b in between if (b.kind != "grazing") == changed] or [b.value for b in between]
    if not fitting:
        return float(0.5 * (branch.values[i] + branch.values[i + 1]))
    return fitting[0] if branch.stable[i] else fitting[-1]


@checked
def bifurcation_table(branches: Iterable[Branch], *, digits: int = 5) -> Table:
    """Every bifurcation of a set of branches, by rising parameter.

    It has kind, value (to `digits` decimals), the orbit's period, contacts per cycle on the drive and coast side
    (before and after a grazing), and impact state.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> bifurcation_table([continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)])
    kind  Omega_h  period  contacts  impact state
    ---------------------------------------------
    flip  0.76601       2  2 + 0     single-sided
    """
    check_count("digits", digits, at_least=0)
    found = sorted((b for branch in branches for b in branch.bifurcations), key=lambda b: (b.value, b.kind))
    rows = [[b.kind, f"{b.value:.{digits}f}", b.period, _contacts(b), IMPACT_NAMES[b.impact_state]] for b in found]
    value = symbol(found[0].parameter) if found else "value"
    return Table(["kind", value, "period", "contacts", "impact state"], rows)


def _contacts(bifurcation: Bifurcation) -> str:
    """Contacts per cycle (drive + coast), on both sides of a grazing."""
    first, second = (f"{drive} + {coast}" for drive, coast in bifurcation.contacts)
    return first if first == second else f"{first} | {second}"


@checked
def coexistence_table(
    branches: Sequence[Branch], lower: float, upper: float, *, shortest: float, digits: int = 4
) -> Table:
    """Which stable orbits of a set of branches exist together, one row a range; see `coexistence`.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> coexistence_table([continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)], 0.72, 0.78, shortest=0.001)
      from      to  stable orbits
    ------------------------------------------------------
    0.7200  0.7660  period 2 (single-sided)
    0.7660  0.7800  none up to the longest period followed
    """
    check_count("digits", digits, at_least=0)
    rows = []
    for low, high, motions in coexistence(list(branches), lower, upper, shortest=shortest):
        words = [(f"{m.kind} ({IMPACT_NAMES[m.impact_state or '']})", n) for m, n in Counter(motions).items()]
        text = ", ".join(word if n == 1 else f"{n} of {word}" for word, n in words)
        rows.append([f"{low:.{digits}f}", f"{high:.{digits}f}", text or "none up to the longest period followed"])
    return Table(["from", "to", "stable orbits"], rows)


@checked
def cascade_table(cascades: Iterable[Sequence[Bifurcation]], *, digits: int = 6) -> Table:
    """Sequences of `doubling_cascade`, one row each: periods, flips, and the ratios of the gaps between them.

    The flips have `digits` decimals; the ratios are 4.669 in the limit.

    Examples
    --------
    >>> from gearpair import Oscillator, continue_orbit, periodic_orbit
    >>> from gearpair.bifurcations import doubling_cascade
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> flip = continue_orbit(orbit, "mesh_frequency", 0.7, 0.78).bifurcations[0]
    >>> cascade_table([doubling_cascade(flip, 3)], digits=4).rows[0]
    ('2 4 8', '0.7660 0.7983 0.8067', '3.84')
    """
    check_count("digits", digits, at_least=0)
    rows = []
    for flips in cascades:
        gaps = np.diff([flip.value for flip in flips])
        ratios = [f"{ratio:.2f}" for ratio in gaps[:-1] / gaps[1:]]
        cells = [str(flip.period) for flip in flips], [f"{flip.value:.{digits}f}" for flip in flips], ratios
        rows.append([" ".join(cell) for cell in cells])
    return Table(["periods", "flips at", "ratios of the gaps"], rows)
