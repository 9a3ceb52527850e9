"""What accuracy costs, and what is drawn without it: the exact flow beside the integrators."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from timeit import repeat
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count, check_truths, checked
from gearpair._equality import equal_by_value
from gearpair.ensembles.datasets import oscillators_along
from gearpair.methods.runge_kutta import DiagramOptions, diagram_rules, runge_kutta_section, section_diagram
from gearpair.methods.solvers import integrated_trajectory
from gearpair.motion.trajectories import Impacts, stroboscopic_map, trajectory
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave
from gearpair.table import Table

if TYPE_CHECKING:
    import xarray as xr

EXACT, COMPILED = "exact flow", "RK45, compiled"
INTEGRATORS = ("RK45", "DOP853", "LSODA")
ATOL_SHARE = 1e-3  # atol = rtol / 1000, as scipy's defaults are
TIMED_PERIODS = 1000  # of one compiled run
A_SMALL_PART = 0.25  # of the values at which a diagram is disordered, what is called so is smaller
CUT = 0.38  # where `split_levels` divides each level


@equal_by_value
@dataclass(frozen=True)
class Precision:
    """What one `method` did at one tolerance `rtol`, nan for the exact flow, which has none.

    `error` is the largest of X or X' after one mesh period, over all starts; `seconds` the measured time per period.

    Examples
    --------
    >>> work_precision(Oscillator(), 1.0, 0.0, n_starts=2, tolerances=[1e-6])[-1].method
    'exact flow'
    """

    method: str
    rtol: float
    error: float
    seconds: float


@checked
def split_levels(osc: Oscillator) -> Oscillator:
    """The same oscillator with each stiffness level written as two: the exact flow then works on other cells.

    What differs between the two is rounding.

    Examples
    --------
    >>> len(split_levels(Oscillator()).stiffness.levels)
    4
    """
    wave = osc.stiffness
    starts = np.array([*wave.edges, 1.0])
    edges = np.sort(np.concatenate([starts[:-1], starts[:-1] + CUT * np.diff(starts)]))
    return osc.replace(stiffness=StiffnessWave(tuple(edges.tolist()), tuple(np.repeat(wave.levels, 2).tolist())))


@checked
def impact_time_error(impacts: Impacts, reference: Impacts) -> float:
    """The largest time between an impact of `reference` and the nearest of `impacts` on the same side.

    0 where `reference` has none; inf where one has no counterpart.

    Examples
    --------
    >>> osc = Oscillator()
    >>> there, here = (trajectory(each, 0.5, 0.0, 3).impacts for each in (split_levels(osc), osc))
    >>> len(here) > 0 and impact_time_error(there, here) < 1e-12
    True
    """
    worst = 0.0
    for tau, side, contact in zip(reference.tau, reference.side, reference.contact, strict=True):
        alike = impacts.tau[(impacts.side == side) & (impacts.contact == contact)]
        worst = max(worst, float(np.abs(alike - tau).min(initial=np.inf)))
    return worst


@checked
def work_precision(
    osc: Oscillator,
    x: float,
    v: float,
    *,
    n_starts: int = 12,
    tolerances: Sequence[float] = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11),
) -> list[Precision]:
    """One-period errors of every method against the exact flow, and the time they took.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        X and X' where the exact flow starts; the section points it then visits are the starts of all methods.
    n_starts : int
        How many, after 100 discarded.
    tolerances : sequence of float
        rtol of the integrators; atol is a thousandth of it.

    Returns
    -------
    list of Precision
        scipy's RK45, DOP853 and LSODA, the compiled RK45, and the exact flow. The exact flow's own error is what
        changes when its cells do (`split_levels`), its rounding. Compiled methods are timed over many periods.

    Examples
    --------
    >>> measured = work_precision(Oscillator(), 1.0, 0.0, n_starts=2, tolerances=[1e-6])
    >>> [m.method for m in measured]
    ['RK45', 'DOP853', 'LSODA', 'RK45, compiled', 'exact flow']
    >>> measured[-1].error < 1e-12
    True
    """
    n_starts = check_count("n_starts", n_starts)
    motion = trajectory(osc, x, v, n_starts, n_transient=100, samples_per_period=1)
    starts = motion.section
    ends = np.column_stack(stroboscopic_map(osc, starts[:-1, 0], starts[:-1, 1]))
    first = (float(starts[0, 0]), float(starts[0, 1]))
    found: list[Precision] = []
    for method in INTEGRATORS:
        for rtol in tolerances:
            run: dict[str, Any] = {"samples_per_period": 1, "method": method, "rtol": rtol, "atol": rtol * ATOL_SHARE}
            errors, seconds = [], []
            for (x0, v0), end in zip(starts[:-1].tolist(), ends, strict=True):
                began = perf_counter()
                integrated = integrated_trajectory(osc, x0, v0, 1, **run)
                seconds.append(perf_counter() - began)
                errors.append(max(abs(integrated.x[-1] - end[0]), abs(integrated.v[-1] - end[1])))
            found.append(Precision(method, float(rtol), float(max(errors)), float(np.median(seconds))))
    for rtol in tolerances:
        tolerance: dict[str, Any] = {"rtol": rtol, "atol": rtol * ATOL_SHARE}
        last = [runge_kutta_section(osc, x0, v0, 1, **tolerance)[-1] for x0, v0 in starts[:-1].tolist()]
        seconds_each = _per_period(partial(runge_kutta_section, osc, *first, TIMED_PERIODS, **tolerance))
        found.append(Precision(COMPILED, float(rtol), float(np.abs(last - ends).max()), seconds_each))
    again = np.column_stack(stroboscopic_map(split_levels(osc), starts[:-1, 0], starts[:-1, 1]))
    seconds_each = _per_period(partial(stroboscopic_map, osc, *first, n=TIMED_PERIODS))
    return [*found, Precision(EXACT, np.nan, float(np.abs(again - ends).max()), seconds_each)]


def _per_period(run: Callable[[], object]) -> float:
    """Seconds per mesh period of a compiled run over `TIMED_PERIODS`: the best of three, once it is compiled."""
    return min(repeat(run, repeat=4, number=1)[1:]) / TIMED_PERIODS


@checked
def plain_sweep(
    osc: Oscillator,
    parameter: str,
    values: ArrayLike,
    *,
    x: float = 1.0,
    v: float = 0.0,
    **options: Unpack[DiagramOptions],
) -> xr.Dataset:
    """The exact flow under the rules of `runge_kutta_sweep`: a fixed transient, and the period read off the points.

    What this misjudges is the fault of the rules; what `runge_kutta_sweep` misjudges beyond it, of the integrator.
    Parameters and result are as there, but for ``calls``; values are carried.

    Raises
    ------
    RuntimeError
        Where the motion escapes.

    Examples
    --------
    >>> plain_sweep(Oscillator(), "mesh_frequency", [1.65, 1.7]).period.values.tolist()
    [2, 2]
    """
    oscillators, checked = oscillators_along(osc, parameter, values)
    n_transient, n_samples, closeness = diagram_rules(options)
    points = np.empty((len(checked), n_samples, 2))
    for i, each in enumerate(oscillators):
        motion = trajectory(each, x, v, n_samples - 1, n_transient=n_transient, samples_per_period=1)
        points[i] = motion.section
        x, v = float(motion.x[-1]), float(motion.v[-1])
    return section_diagram(osc, {parameter: checked}, points, closeness, seeding="carry")


@checked
def numerical_chaos(exact: xr.Dataset, drawn: xr.Dataset) -> NDArray[np.bool_]:
    """At which values a diagram shows disorder though the motion is periodic in the end.

    `exact` is of `sweep`; `drawn` of `runge_kutta_sweep` or `plain_sweep` at the same values.

    Not all of it is the integrator's own: a chaotic transient that outlasts the periods which the diagram discards is
    disordered in truth. `plain_sweep` shows that part too.

    Examples
    --------
    >>> from gearpair import sweep
    >>> from gearpair.methods import runge_kutta_sweep
    >>> osc, values = Oscillator(), [1.65, 1.7]
    >>> exact = sweep(osc, "mesh_frequency", values)
    >>> numerical_chaos(exact, runge_kutta_sweep(osc, "mesh_frequency", values)).tolist()
    [True, True]
    """
    parameter = str(exact.status.dims[0])
    if not np.array_equal(exact[parameter].values, drawn[parameter].values):
        raise ValueError(f"both diagrams must be of the same values of {parameter}")
    return (exact.status.values == "periodic") & (drawn.period.values == 0)


@checked
def disorder_table(exact: xr.Dataset, drawn: Mapping[str, xr.Dataset]) -> Table:
    """How often diagrams, by name, show disorder where the motion is periodic in the end, and a period where it is not.

    Datasets as for `numerical_chaos`; shares of the values as `coarse_share` writes them.

    Examples
    --------
    >>> from gearpair import sweep
    >>> from gearpair.methods import runge_kutta_sweep
    >>> osc, values = Oscillator(), [1.65, 1.7]
    >>> exact = sweep(osc, "mesh_frequency", values)
    >>> disorder_table(exact, {"RK45": runge_kutta_sweep(osc, "mesh_frequency", values)})
    drawn by  disordered though periodic  periodic though not
    ---------------------------------------------------------
    RK45      all                         under 10%
    """
    rows = []
    for name, diagram in drawn.items():
        missed = (exact.status.values != "periodic") & (diagram.period.values > 0)
        rows.append([name, coarse_share(numerical_chaos(exact, diagram)), coarse_share(missed)])
    return Table(["drawn by", "disordered though periodic", "periodic though not"], rows)


@checked
def disorder_told(exact: xr.Dataset, drawn: xr.Dataset, control: xr.Dataset) -> str:
    """How much of a diagram drawn by an integrator is disordered, and whether the rules or the integrator made it so.

    Parameters
    ----------
    exact, drawn : xarray.Dataset
        As for `numerical_chaos`.
    control : xarray.Dataset
        The exact flow under the rules of `drawn`, of `plain_sweep`.

    Examples
    --------
    >>> from gearpair import sweep
    >>> from gearpair.methods import plain_sweep, runge_kutta_sweep
    >>> osc, values = Oscillator(), [1.65, 1.7]
    >>> made = [draw(osc, "mesh_frequency", values) for draw in (sweep, runge_kutta_sweep, plain_sweep)]
    >>> disorder_told(*made).split(": ")[-1]
    'the exact flow, drawn by the same rules, is in order at these.'
    """
    made_up, shared = (numerical_chaos(exact, each) for each in (drawn, control))
    looks, unsettled = coarse_share(drawn.period.values == 0), coarse_share(exact.status.values != "periodic")
    told = f"{looks[0].upper()}{looks[1:]} of the frequencies look disordered, "
    told += f"and at {unsettled} the motion did not settle while it was watched."
    if not made_up.any():
        return f"{told} No motion that is periodic in the end is drawn as disorder."
    told += (
        f" At {coarse_share(made_up)} of the frequencies the diagram is disordered and the motion periodic in the end"
    )
    own = made_up & ~shared
    if not own.any():
        return f"{told}, and the exact flow, drawn by the same rules, is as disordered there: none of it is numerical."
    if np.array_equal(own, made_up):
        return f"{told}. All of this is numerical: the exact flow, drawn by the same rules, is in order at these."
    part = "a small part" if np.sum(made_up & shared) < A_SMALL_PART * np.sum(made_up) else "a good part"
    size = "more" if np.mean(own) > 0.5 else "less"
    return (
        f"{told}. At {part} of these frequencies the exact flow, drawn by the same rules, is disordered as well. "
        f"At the others, {size} than half of the axis, the disorder is numerical."
    )


@checked
def loosest_told(measured: Sequence[Precision], method: str = "RK45") -> str:
    """By how much a method is wrong at the loosest of its tolerances, beside what was asked for.

    Examples
    --------
    >>> loosest_told([Precision("RK45", 1e-3, error, 1.0) for error in (0.05,)])
    'more than 0.01, although 0.001 was asked for'
    >>> loosest_told([Precision("RK45", 1e-3, 2e-4, 1.0)])
    'less than the 0.001 that was asked for'
    """
    own = [each for each in measured if each.method == method]
    if not own:
        raise ValueError(
            f"measured must have one of method {method!r}, got those of {[each.method for each in measured]}"
        )
    loosest = max(own, key=lambda each: each.rtol)
    asked = f"{loosest.rtol:g}"
    if loosest.error > 10.0 * loosest.rtol:
        return f"more than {10.0 * loosest.rtol:g}, although {asked} was asked for"
    return f"{'more' if loosest.error > loosest.rtol else 'less'} than the {asked} that was asked for"


@checked
def coarse_share(where: ArrayLike) -> str:
    """The share of true values, so coarse that rounding on another machine hardly changes it.

    To the nearest 5%; ``"under 10%"`` and ``"over 90%"`` near the ends, ``"all"`` if all are.

    Examples
    --------
    >>> coarse_share([True, False, False]), coarse_share([True] * 29 + [False]), coarse_share([False])
    ('35%', 'over 90%', 'under 10%')
    """
    share = float(np.mean(check_truths("where", where)))
    if share == 1.0:
        return "all"
    return "under 10%" if share < 0.1 else "over 90%" if share > 0.9 else f"{round(20.0 * share) / 20.0:.0%}"
