"""Which motion lives where: ranges of one parameter, a representative of each motion, shares of the starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_number
from gearpair.batches import Status
from gearpair.impacts import ImpactState
from gearpair.initial_conditions import basins
from gearpair.oscillator import Oscillator
from gearpair.steady import SteadyState, steady_state
from gearpair.sweeps import attributes, oscillators_along, sweep
from gearpair.tables import Table

if TYPE_CHECKING:
    import xarray as xr

CHAOS = "chaos"
LARGEST_STEP = 0.2  # of X_min and X_max between two values of one motion, relative to their distance
TRIES = 20  # values at which a representative is looked for again before the sweep is given up
IMPACT_NAMES: Mapping[str, str] = {
    ImpactState.NEVER_IN_CONTACT: "never in contact",
    ImpactState.NONE_DRIVE: "no impact",
    ImpactState.NONE_COAST: "no impact on the coast side",
    ImpactState.SINGLE_DRIVE: "single-sided",
    ImpactState.SINGLE_COAST: "single-sided on the coast side",
    ImpactState.DOUBLE: "double-sided",
    "": "not bounded",
}


@dataclass(frozen=True)
class MotionRange:
    """A range of one parameter with one kind of motion.

    Attributes
    ----------
    lower, upper : float
        The first and the last value at which the motion was met.
    motion : str
        ``"period 1"``, ``"period 2"``, ..., ``"chaos"``, or the status of what is neither.
    """

    lower: float
    upper: float
    motion: str

    @property
    def width(self) -> float:
        """``upper - lower``."""
        return self.upper - self.lower


def motion_name(status: str, period: int | None = None) -> str:
    """What to call a motion: ``"period 2"``, ``"chaos"``, or its status where it is neither.

    Examples
    --------
    >>> motion_name("periodic", 2), motion_name("aperiodic"), motion_name("escaped")
    ('period 2', 'chaos', 'escaped')
    """
    if status == Status.PERIODIC:
        return f"period {period}"
    return CHAOS if status == Status.APERIODIC else str(status)


def symbol(parameter: str) -> str:
    """The article's symbol of a parameter, in plain letters.

    Examples
    --------
    >>> symbol("mesh_frequency"), symbol("a")
    ('Omega_h', 'a')
    """
    return attributes(parameter)["long_name"].rsplit(" ", 1)[-1]


def motion_names(result: xr.Dataset) -> NDArray[np.str_]:
    """The name of every motion of a sweep, a map or a plane of starts, in the shape of its ``status``."""
    pairs = zip(result.status.values.ravel(), result.period.values.ravel(), strict=True)
    return np.array([motion_name(status, int(period)) for status, period in pairs]).reshape(result.status.shape)


def motion_ranges(result: xr.Dataset) -> tuple[MotionRange, ...]:
    """The runs of one motion in a sweep, by rising parameter, whatever its direction was.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.sweep`.

    Returns
    -------
    tuple of MotionRange

    Examples
    --------
    >>> motion_ranges(sweep(Oscillator(), "mesh_frequency", [0.78, 0.74, 0.7]))
    (MotionRange(lower=0.7, upper=0.74, motion='period 2'), MotionRange(lower=0.78, upper=0.78, motion='period 4'))
    """
    values = result[swept_parameter(result)].values
    order = np.argsort(values)
    named = zip(values[order].tolist(), motion_names(result)[order].tolist(), strict=True)
    runs = [(motion, [value for value, _ in run]) for motion, run in groupby(named, key=lambda pair: pair[1])]
    return tuple(MotionRange(run[0], run[-1], motion) for motion, run in runs)


def found_ranges(*sweeps: xr.Dataset, narrowest: float = 0.0) -> tuple[MotionRange, ...]:
    """Where each periodic motion was found by any of several sweeps, the runs that overlap joined.

    A carried sweep follows a stable motion to its end: a rising sweep to the upper end, a falling one to the lower. The
    ranges that the two give together are therefore the ranges of existence, to the step of the sweep, and they do not
    depend on where a chaotic motion happened to be caught.

    Parameters
    ----------
    *sweeps : xarray.Dataset
        Of `gearpair.sweep`, over the same parameter.
    narrowest : float
        Ranges narrower than this are left out.

    Returns
    -------
    tuple of MotionRange
        By rising lower end; ranges of different motions may overlap.

    Raises
    ------
    ValueError
        For sweeps over different parameters, or a negative `narrowest`.
    """
    check_number("narrowest", narrowest, at_least=0.0)
    if len({swept_parameter(result) for result in sweeps}) > 1:
        raise ValueError(f"the sweeps must be over one parameter, got {', '.join(map(swept_parameter, sweeps))}")
    found: list[MotionRange] = []
    for run in sorted((run for result in sweeps for run in motion_ranges(result)), key=lambda run: run.lower):
        if not run.motion.startswith("period "):
            continue
        same = [i for i, other in enumerate(found) if other.motion == run.motion and run.lower <= other.upper]
        if same:
            last = found[same[-1]]
            found[same[-1]] = MotionRange(last.lower, max(last.upper, run.upper), run.motion)
        else:
            found.append(run)
    wide = (run for run in found if run.width >= narrowest)
    return tuple(sorted(wide, key=lambda run: (run.lower, motion_order(run.motion))))


def swept_parameter(result: xr.Dataset) -> str:
    """The parameter that a sweep varied."""
    names = [str(name) for name in result.status.dims]
    if len(names) != 1:
        raise ValueError(f"a sweep over one parameter is needed, got a result over {', '.join(names)}")
    return names[0]


def representatives(
    osc: Oscillator,
    *sweeps: xr.Dataset,
    motions: Sequence[str] = ("period 1", "period 2", "period 3", "period 4", CHAOS),
    near: Mapping[str, float] | None = None,
) -> dict[str, SteadyState]:
    """One settled motion of each kind, from the sweeps that met it.

    The sweeps are asked in turn, and the first that met the motion gives it: at the middle of its widest run, or
    at the value nearest to the one given in `near`. A motion that no sweep met is left out.

    Parameters
    ----------
    osc : Oscillator
        What was swept.
    *sweeps : xarray.Dataset
        Of `gearpair.sweep`, the preferred first.
    motions : sequence of str
        Names as `motion_name` gives them.
    near : mapping of str to float, optional
        Where to look for some of the motions.

    Returns
    -------
    dict of str to SteadyState
    """
    found = {}
    for motion in motions:
        for result in sweeps:
            parameter = swept_parameter(result)
            met = [run for run in motion_ranges(result) if run.motion == motion]
            if not met:
                continue
            widest = max(met, key=lambda run: run.width)
            target = (near or {}).get(motion, 0.5 * (widest.lower + widest.upper))
            where = np.flatnonzero(motion_names(result) == motion)
            nearest = where[np.argsort(np.abs(result[parameter].values[where] - target), kind="stable")]
            state = next(filter(None, (_settled_again(osc, result, i, motion) for i in nearest[:TRIES])), None)
            if state is not None:
                found[motion] = state
                break
    return found


def _settled_again(osc: Oscillator, result: xr.Dataset, i: int, motion: str) -> SteadyState | None:
    """The motion at value `i` of a sweep, or None where it was about to become another (a chaotic transient)."""
    parameter = swept_parameter(result)
    x, v = (float(result[name].values[i, 0]) for name in ("x", "v"))
    state = steady_state(osc.replace(**{parameter: float(result[parameter].values[i])}), x, v)
    return state if motion_name(state.status, state.period) == motion else None


def follow(state: SteadyState, parameter: str, values: ArrayLike, **settings: Any) -> tuple[xr.Dataset, ...]:
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
    >>> falling, rising = follow(steady_state(Oscillator()), "mesh_frequency", [0.65, 0.7, 0.75, 0.78])
    >>> found_ranges(falling, rising)[-1]
    MotionRange(lower=0.78, upper=0.78, motion='period 4')
    """
    _, checked = oscillators_along(state.oscillator, parameter, values)
    here, ordered = state.oscillator.parameter(parameter), np.sort(checked)
    x, v = map(float, state.points[0])
    ways = (ordered[ordered <= here][::-1], ordered[ordered >= here])
    return tuple(sweep(state.oscillator, parameter, way, x=x, v=v, **settings) for way in ways if len(way))


def range_of(state: SteadyState, parameter: str, values: ArrayLike, **settings: Any) -> MotionRange:
    """How far one settled motion lives: the part of `follow` in which it keeps its period and its size.

    From one value to the next X_min and X_max may change by no more than a fifth of their distance; a larger step is a
    jump to another motion.

    Parameters
    ----------
    state, parameter, values, **settings
        As for `follow`.

    Returns
    -------
    MotionRange

    Examples
    --------
    >>> range_of(steady_state(Oscillator()), "mesh_frequency", [0.65, 0.7, 0.75, 0.78]).upper
    0.75
    """
    name, here = motion_name(state.status, state.period), state.oscillator.parameter(parameter)
    ends = [here, here]
    for result in follow(state, parameter, values, **settings):
        visited = result[parameter].values
        sizes = np.stack([result.x_min.values, result.x_max.values])
        steps = np.abs(np.diff(sizes, axis=1, prepend=[[state.x_min], [state.x_max]])).max(axis=0)
        changed = np.flatnonzero((motion_names(result) != name) | ~(steps <= LARGEST_STEP * np.ptp(sizes, axis=0)))
        kept = visited[: changed[0]] if len(changed) else visited
        if len(kept):
            ends = [min(ends[0], float(kept.min())), max(ends[1], float(kept.max()))]
    return MotionRange(ends[0], ends[1], name)


def attractor_names(result: xr.Dataset, least_share: float = 0.0) -> list[str]:
    """What each attractor of `gearpair.basins` is: its motion and, unless chaotic, its impact state.

    Parameters
    ----------
    result : xarray.Dataset
        Of `gearpair.basins`.
    least_share : float
        Attractors that fewer of the starts reach are left out.

    Examples
    --------
    >>> attractor_names(basins(Oscillator(), [0.0, 1.0], [0.0]))
    ['period 2, single-sided']
    """
    columns = (result[f"attractor_{name}"].values for name in ("status", "period", "impact_state", "share"))
    names = []
    for status, period, state, share in zip(*columns, strict=True):
        if share >= least_share:
            motion = motion_name(str(status), int(period))
            names.append(f"{motion}, {IMPACT_NAMES[str(state)]}" if status == Status.PERIODIC else motion)
    return names


def attractor_states(osc: Oscillator, result: xr.Dataset, least_share: float = 0.0) -> list[SteadyState]:
    """The periodic attractors of `gearpair.basins`, each described in full.

    Parameters
    ----------
    osc : Oscillator
        Whose basins they are.
    result : xarray.Dataset
        Of `gearpair.basins`.
    least_share : float
        Attractors that fewer of the starts reach are left out.

    Returns
    -------
    list of SteadyState

    Examples
    --------
    >>> [state.period for state in attractor_states(Oscillator(), basins(Oscillator(), [-2.0, 1.0], [0.0]))]
    [1, 2]
    """
    columns = (result[f"attractor_{name}"].values.tolist() for name in ("x", "v", "share"))
    rows = zip(*columns, strict=True)
    return [steady_state(osc, x, v) for x, v, share in rows if np.isfinite(x) and share >= least_share]


def motion_table(states: Mapping[str, SteadyState], parameter: str, digits: int = 3) -> Table:
    """Settled motions by name: the value of a parameter, extremes, impact state, modulus of the larger multiplier.

    Of a motion that is not periodic only the value is told: the rest depends on the span that was looked at.

    Examples
    --------
    >>> motion_table({"the baseline": steady_state(Oscillator())}, "damping_ratio")
    motion         zeta  X_min  X_max  impact state  largest multiplier
    -------------------------------------------------------------------
    the baseline  0.020  0.118  1.492  single-sided               0.698
    """
    rows = []
    for name, state in states.items():
        cells = [f"{state.x_min:.{digits}f}", f"{state.x_max:.{digits}f}", IMPACT_NAMES[state.impact_state or ""]]
        cells.append(f"{abs(state.multipliers[0]):.{digits}f}")
        value = f"{state.oscillator.parameter(parameter):.{digits}f}"
        rows.append([name, value, *(cells if state.period else ["–"] * len(cells))])
    return Table(["motion", symbol(parameter), "X_min", "X_max", "impact state", "largest multiplier"], rows)


def motion_shares(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    x: ArrayLike,
    v: ArrayLike,
    *,
    n_transient: int | None = None,
    max_period: int = 64,
    n_exponent: int = 500,
) -> xr.Dataset:
    """Along one parameter, the share of a grid of starts that reaches each kind of motion.

    Parameters
    ----------
    osc : Oscillator
    parameter : str
        One of ``osc.parameters``.
    values : array_like of float, shape (n,)
    x, v : array_like of float
        The grid of starts, as for `gearpair.basins`.
    n_transient, max_period, n_exponent
        As in `gearpair.steady_state`.

    Returns
    -------
    xarray.Dataset
        ``share`` over ``(parameter, motion)``, the motions named as by `motion_name`: periodic ones first, by period.

    Examples
    --------
    >>> shares = motion_shares(Oscillator(), "damping_ratio", [0.1, 0.2], [0.0, 1.0], [0.0])
    >>> shares.share.values.tolist()
    [[1.0], [1.0]]
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    names = [
        motion_names(basins(each, x, v, n_transient=n_transient, max_period=max_period, n_exponent=n_exponent))
        for each in oscillators
    ]
    motions = sorted({str(name) for plane in names for name in np.unique(plane)}, key=motion_order)
    share = [[float(np.mean(plane == motion)) for motion in motions] for plane in names]
    import xarray as xr  # here, so that importing gearpair stays quick

    return xr.Dataset(
        {"share": ((parameter, "motion"), share, {"long_name": "share of the starts", "units": "1"})},
        {parameter: (parameter, checked, attributes(parameter)), "motion": motions},
        {"oscillator": repr(osc)},
    )


def motion_order(motion: str) -> tuple[int, int, str]:
    """A key that sorts the names of motions: periodic ones by period, then chaos, then the rest."""
    if motion.startswith("period "):
        return 0, int(motion.removeprefix("period ")), motion
    return 1 + (motion != CHAOS), 0, motion
