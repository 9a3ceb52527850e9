"""Which motion lives where: ranges of one parameter, and a representative of each motion."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_count, check_number, checked
from gearpair.ensembles.datasets import check_origin, oscillators_along
from gearpair.ensembles.sweeps import sweep
from gearpair.motion.names import CHAOS, IMPACT_NAMES, Motion, motions_of, periodic
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.oscillator import Oscillator
from gearpair.quantities import symbol
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr

LARGEST_STEP = 0.2  # of X_min and X_max between two values of one motion, relative to their distance
TRIES = 20  # values at which a representative is looked for again before the sweep is given up


@dataclass(frozen=True)
class MotionRange:
    """A range of one parameter with one kind of motion: the first and the last value at which it was met."""

    lower: float
    upper: float
    motion: Motion

    @property
    def width(self) -> float:
        """``upper - lower``."""
        return self.upper - self.lower


@checked
def motion_ranges(result: xr.Dataset) -> tuple[MotionRange, ...]:
    """The runs of one motion in a `gearpair.sweep`, by rising parameter, whatever its direction was.

    Examples
    --------
    >>> for run in motion_ranges(sweep(Oscillator(), "mesh_frequency", [0.78, 0.74, 0.7])):
    ...     print(run.motion, run.lower, run.upper)
    period 2 0.7 0.74
    period 4 0.78 0.78
    """
    values = result[swept_parameter(result)].values
    order = np.argsort(values)
    pairs = zip(values[order].tolist(), motions_of(result)[order].tolist(), strict=True)
    runs = [(motion, [value for value, _ in run]) for motion, run in groupby(pairs, key=lambda pair: pair[1])]
    return tuple(MotionRange(run[0], run[-1], motion) for motion, run in runs)


@checked
def joined_ranges(ranges: Iterable[MotionRange]) -> tuple[MotionRange, ...]:
    """Ranges, in any order, with those of one motion that overlap or touch made one; by rising lower end.

    Ranges of different motions may overlap.

    Examples
    --------
    >>> three = [MotionRange(2.0, 3.0, CHAOS), MotionRange(0.0, 4.0, CHAOS), MotionRange(5.0, 6.0, CHAOS)]
    >>> [(run.lower, run.upper) for run in joined_ranges(three)]
    [(0.0, 4.0), (5.0, 6.0)]
    """
    found: dict[Motion, list[MotionRange]] = {}
    for each in sorted(ranges, key=lambda each: each.lower):
        runs = found.setdefault(each.motion, [])
        if runs and each.lower <= runs[-1].upper:
            runs[-1] = MotionRange(runs[-1].lower, max(runs[-1].upper, each.upper), each.motion)
        else:
            runs.append(each)
    return tuple(sorted((run for runs in found.values() for run in runs), key=lambda run: (run.lower, run.motion)))


@checked
def found_ranges(*sweeps: xr.Dataset, narrowest: float = 0.0) -> tuple[MotionRange, ...]:
    """Where each periodic motion was found by any of several sweeps over one parameter, as `joined_ranges`.

    A carried sweep follows a stable motion to its end: a rising sweep to the upper end, a falling one to the lower. The
    ranges that the two give together are therefore the ranges of existence, to the step of the sweep, and they do not
    depend on where a chaotic motion happened to be caught. Those narrower than `narrowest` are left out.

    Examples
    --------
    >>> osc = Oscillator()
    >>> up, down = (sweep(osc, "mesh_frequency", values) for values in ([0.7, 0.74, 0.78], [0.74, 0.72, 0.7]))
    >>> for run in found_ranges(up, down, narrowest=0.01):
    ...     print(run.motion, run.lower, run.upper)
    period 2 0.7 0.74
    """
    check_number("narrowest", narrowest, at_least=0.0)
    if len({swept_parameter(result) for result in sweeps}) > 1:
        raise ValueError(f"the sweeps must be over one parameter, got {', '.join(map(swept_parameter, sweeps))}")
    runs = (run for result in sweeps for run in motion_ranges(result) if run.motion.period)
    return tuple(run for run in joined_ranges(runs) if run.width >= narrowest)


def swept_parameter(result: xr.Dataset) -> str:
    """The parameter that a sweep varied."""
    names = [str(name) for name in result.status.dims]
    if len(names) != 1:
        raise ValueError(f"a sweep over one parameter is needed, got a result over {', '.join(names)}")
    return names[0]


@checked
def representatives(
    osc: Oscillator,
    *sweeps: xr.Dataset,
    motions: Sequence[Motion] | None = None,
    near: Mapping[Motion, float] | None = None,
) -> dict[Motion, SteadyState]:
    """One settled motion of each kind in `motions`, whatever its impact state, from the sweeps of `osc` that met it.

    The sweeps are asked in turn, the preferred first, and the first that met the motion gives it: at the middle of its
    widest run, or at the value nearest to the one given for it in `near`. A motion that no sweep met is left out.
    Unless `motions` are given, they are the periods 1 to 4 and chaos.

    Examples
    --------
    >>> osc = Oscillator()
    >>> shown = representatives(osc, sweep(osc, "mesh_frequency", [0.7, 0.72, 0.78]))
    >>> {str(motion): state.oscillator.mesh_frequency for motion, state in shown.items()}
    {'period 2': 0.7, 'period 4': 0.78}
    """
    for result in sweeps:
        check_origin(osc, result)
    found = {}
    for motion in (*map(periodic, range(1, 5)), CHAOS) if motions is None else motions:
        for result in sweeps:
            parameter = swept_parameter(result)
            met = [run for run in motion_ranges(result) if run.motion == motion]
            if not met:
                continue
            widest = max(met, key=lambda run: run.width)
            target = (near or {}).get(motion, 0.5 * (widest.lower + widest.upper))
            where = np.flatnonzero(motions_of(result) == motion)
            nearest = where[np.argsort(np.abs(result[parameter].values[where] - target), kind="stable")]
            state = next(filter(None, (_settled_again(osc, result, i, motion) for i in nearest[:TRIES])), None)
            if state is not None:
                found[motion] = state
                break
    return found


def _settled_again(osc: Oscillator, result: xr.Dataset, i: int, motion: Motion) -> SteadyState | None:
    """The motion at value `i` of a sweep, or None where it was about to become another (a chaotic transient)."""
    parameter = swept_parameter(result)
    x, v = (float(result[name].values[i, 0]) for name in ("x", "v"))
    state = steady_state(osc.replace(**{parameter: float(result[parameter].values[i])}), x, v)
    return state if state.motion.kind == motion else None


@checked
def carried_sweeps(state: SteadyState, parameter: str, values: ArrayLike, **settings: Any) -> tuple[xr.Dataset, ...]:
    """Carried sweeps from one settled motion towards both ends of the values, to see how far it lives.

    Parameters
    ----------
    state : SteadyState
        Bounded; its own value of the parameter need not be among `values`.
    parameter : str
        One of ``state.oscillator.parameters``.
    values : array_like of float, shape (n,)
        In any order.
    **settings
        As for `gearpair.sweep`.

    Returns
    -------
    tuple of xarray.Dataset
        The falling sweep and the rising one; only one of them where the motion lies at an end of the values.

    Examples
    --------
    >>> falling, rising = carried_sweeps(steady_state(Oscillator()), "mesh_frequency", [0.65, 0.7, 0.75, 0.78])
    >>> print(found_ranges(falling, rising)[-1].motion)
    period 4
    """
    _, checked = oscillators_along(state.oscillator, parameter, values)
    here, ordered = state.oscillator.parameter(parameter), np.sort(checked)
    x, v = map(float, state.points[0])
    ways = (ordered[ordered <= here][::-1], ordered[ordered >= here])
    return tuple(sweep(state.oscillator, parameter, way, x=x, v=v, **settings) for way in ways if len(way))


@checked
def range_of(state: SteadyState, parameter: str, values: ArrayLike, **settings: Any) -> MotionRange:
    """How far one settled motion lives: the part of `carried_sweeps` in which it keeps its period and its size.

    From one value to the next X_min and X_max may change by no more than a fifth of their distance; a larger step is a
    jump to another motion. Parameters are those of `carried_sweeps`.

    Examples
    --------
    >>> range_of(steady_state(Oscillator()), "mesh_frequency", [0.65, 0.7, 0.75, 0.78]).upper
    0.75
    """
    motion, here = state.motion.kind, state.oscillator.parameter(parameter)
    ends = [here, here]
    for result in carried_sweeps(state, parameter, values, **settings):
        visited = result[parameter].values
        sizes = np.stack([result.x_min.values, result.x_max.values])
        steps = np.abs(np.diff(sizes, axis=1, prepend=[[state.x_min], [state.x_max]])).max(axis=0)
        changed = np.flatnonzero((motions_of(result) != motion) | ~(steps <= LARGEST_STEP * np.ptp(sizes, axis=0)))
        kept = visited[: changed[0]] if len(changed) else visited
        if len(kept):
            ends = [min(ends[0], float(kept.min())), max(ends[1], float(kept.max()))]
    return MotionRange(ends[0], ends[1], motion)


@checked
def motion_table(states: Mapping[Any, SteadyState], parameter: str, digits: int = 3) -> Table:
    """Settled motions by name: the value of a parameter, extremes, impact state, modulus of the larger multiplier.

    Of a motion that is not periodic only the value is told: the rest depends on the span that was looked at.

    Examples
    --------
    >>> from gearpair import steady_state
    >>> motion_table({"the baseline": steady_state(Oscillator())}, "damping_ratio")
    motion         zeta  X_min  X_max  impact state  largest multiplier
    -------------------------------------------------------------------
    the baseline  0.020  0.118  1.492  single-sided               0.698
    """
    check_count("digits", digits, at_least=0)
    rows = []
    for name, state in states.items():
        cells = [f"{state.x_min:.{digits}f}", f"{state.x_max:.{digits}f}", IMPACT_NAMES[state.impact_state or ""]]
        cells.append(f"{abs(state.multipliers[0]):.{digits}f}")
        value = f"{state.oscillator.parameter(parameter):.{digits}f}"
        rows.append([name, value, *(cells if state.period else ["–"] * len(cells))])
    return Table(["motion", *map(symbol, (parameter, "x_min", "x_max")), "impact state", "largest multiplier"], rows)
