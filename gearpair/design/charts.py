"""The speed chart: what a drive does at every speed of a range, run up, run down and from many starts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_number, checked
from gearpair.design.jumps import Jump, find_jumps
from gearpair.design.linear import linear_response
from gearpair.design.loads import MEASURES, measure_motion, one_error_for_both, same_motion
from gearpair.drive import GearDrive
from gearpair.motion.settling import CHART, settle_batch, settle_both_ways
from gearpair.motion.steady import SteadyState, describe
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

RUNS = ("up", "down", "worst")


@checked
def speed_chart(
    drive: GearDrive,
    speeds_rpm: ArrayLike,
    *,
    n_starts: int = 16,
    n_transient: int | None = None,
    locate_jumps: bool = True,
    progress: bool = False,
) -> xr.Dataset:
    """What a drive does over a range of speeds, in SI units.

    Parameters
    ----------
    drive : GearDrive
        With or without a speed of its own.
    speeds_rpm : array_like of float, shape (n,)
        Of the pinion, rising, at least two.
    n_starts : int
        Starts at each speed, spread evenly over a rectangle of X and X' about the backlash and the static deflection;
        they find the motions that no run meets, and what share of the starts leads to each.
    n_transient : int, optional
        Mesh periods at most before a motion is judged; `gearpair.motion.transient_periods` when not given. One that has
        not settled then is watched for 20 000 more before it is called chaos.
    locate_jumps : bool
        Whether to locate by continuation the speeds at which a run leaves a motion.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        Over ``(run, speed)``, the run being ``"up"``, ``"down"`` or ``"worst"`` (the motion with the largest tooth
        force of all that were found at that speed): ``motion``, ``period``, ``impact_state``, ``dte_rms``,
        ``dte_peak_to_peak`` (um), ``mesh_force``, ``tooth_force`` (N), ``dynamic_factor``, ``time_apart``,
        ``impact_rate`` (1/s), ``impact_velocity`` (mm/s) and ``both_flanks``, whether one error served both flanks.
        Over ``speed``: ``n_motions``, ``worst_share`` of the starts that leads to the worst motion, ``linear_factor``
        and ``linear_rms`` (um) of `linear_response`, ``mesh_frequency`` (dimensionless). Over ``jump``: ``jump_speed``
        (rpm), ``jump_run``, ``jump_kind``, ``jump_from`` and ``jump_to``, see `find_jumps`.

    Notes
    -----
    The dynamic transmission error is ``r_b1 theta1 - r_b2 theta2 = x + e``. The mesh force is the elastic one,
    ``k_h f(x)``; the tooth force is the share of it that the most loaded pair of teeth carries (nan where the drive
    has no `mesh`). The dynamic factor is the largest mesh force over the mean force.

    An error of the profile (`GearDrive.profile_harmonics`) has its sign on the flank that carries the torque and the
    other sign on the other flank. A motion that strikes both is computed with the one of the first, and marked.

    All chaos of a speed counts as one motion, and is measured over 200 mesh periods. Chaos that ends, but not while it
    is watched, counts as chaos: a drive can be in it for seconds, and bears its loads.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.08)
    >>> chart = speed_chart(drive, [2000.0, 4000.0], n_starts=4)
    >>> chart.motion.sel(run="up").values.tolist()
    ['period 1', 'period 1']
    """
    speeds = check_speeds(speeds_rpm)
    n_starts = check_count("n_starts", n_starts, at_least=0)
    oscillators = oscillators_at(drive, speeds)
    up, down = carried_runs([oscillators], n_transient, progress=progress)[0]
    started = settled_starts(oscillators, n_starts, n_transient, progress=progress)
    n_motions, worst_share = [], []
    shown: tuple[list[tuple[SteadyState, dict[str, float]]], ...] = ([], [], [])  # of each run
    for i in range(len(speeds)):
        found, counts = [up[i]], [0]
        for state, count in [(down[i], 0), *((each, 1) for each in started[i])]:
            same = [j for j, other in enumerate(found) if same_motion(other, state)]
            if same:
                counts[same[0]] += count
            else:
                found.append(state)
                counts.append(count)
        loads = [measure_motion(drive, state) for state in found]
        worst = int(np.argmax([np.nan_to_num(each["mesh_force"], nan=np.inf) for each in loads]))
        down_at = next(j for j, other in enumerate(found) if same_motion(other, down[i]))
        n_motions.append(len(found))
        worst_share.append(counts[worst] / n_starts if n_starts else np.nan)
        for run, j in zip(shown, (0, down_at, worst), strict=True):
            run.append((found[j], loads[j]))
    columns: dict[str, list[list[Any]]] = {
        "motion": [[str(state.motion.kind) for state, _ in run] for run in shown],
        "period": [[state.period or 0 for state, _ in run] for run in shown],
        "impact_state": [[str(state.impact_state or "") for state, _ in run] for run in shown],
        **{name: [[each[name] for _, each in run] for run in shown] for name in MEASURES},
        "both_flanks": [[one_error_for_both(drive, state) for state, _ in run] for run in shown],
    }
    jumps = find_jumps(up, down) if locate_jumps else []
    return _dataset(drive, speeds, oscillators, columns, n_motions, worst_share, jumps)


def check_speeds(speeds_rpm: ArrayLike) -> NDArray[np.float64]:
    """Rising speeds above 0, at least two, or a ValueError."""
    speeds = check_array("speeds_rpm", speeds_rpm)
    if speeds.ndim != 1 or len(speeds) < 2:
        raise ValueError(f"speeds_rpm must be at least two numbers, got shape {speeds.shape}")
    for i, speed in enumerate(speeds.tolist()):
        check_number(f"speeds_rpm[{i}]", speed, above=0.0)
    if not np.all(np.diff(speeds) > 0.0):
        raise ValueError("speeds_rpm must rise, each above the one before")
    return speeds


def oscillators_at(drive: GearDrive, speeds: NDArray[np.float64]) -> list[Oscillator]:
    """The drive's oscillator at each speed of the pinion."""
    return [drive.at_speed(speed).oscillator() for speed in speeds.tolist()]


def carried_runs(
    ranges: Sequence[list[Oscillator]], n_transient: int | None, *, progress: bool = False
) -> list[tuple[list[SteadyState], list[SteadyState]]]:
    """Each range of oscillators run up and down, every motion starting where the one before it ended.

    Returns
    -------
    list of (list of SteadyState, list of SteadyState)
        Both in the order of the range, which all have in one length.
    """
    n = len(ranges[0])
    lanes = [osc for each in ranges for osc in each]
    starts = np.array([(1.0 + max(osc.mean_force, 0.0) / osc.stiffness.mean, 0.0) for osc in lanes])
    both = settle_both_ways(lanes, starts, CHART.having({"n_transient": n_transient}), chain=n, progress=progress)
    up, down = ([describe(osc, out, i) for i, osc in enumerate(lanes)] for out in both)
    return [(up[i : i + n], down[i : i + n]) for i in range(0, len(lanes), n)]


def settled_starts(
    oscillators: list[Oscillator], n_starts: int, n_transient: int | None, *, progress: bool = False
) -> list[list[SteadyState]]:
    """The motions that `spread_starts` lead to, for each oscillator."""
    if not n_starts:
        return [[] for _ in oscillators]
    starts = np.concatenate([spread_starts(osc, n_starts) for osc in oscillators])
    out = settle_batch(oscillators, starts, CHART.having({"n_transient": n_transient}), progress=progress)
    return [
        [describe(osc, out, i) for i in range(k * n_starts, (k + 1) * n_starts)] for k, osc in enumerate(oscillators)
    ]


def spread_starts(osc: Oscillator, n: int) -> NDArray[np.float64]:
    """Starts spread evenly over a rectangle (an additive recurrence of low discrepancy), shape (n, 2).

    X reaches from as far beyond the coast flank as the static deflection, at least 1, to three times that beyond the
    drive flank; X' up to one and a half times it, each way.
    """
    size = max(1.0, abs(osc.mean_force) / osc.stiffness.mean)
    share = np.mod(0.5 + np.arange(1, n + 1)[:, None] * np.array([0.7548776662466927, 0.5698402909980532]), 1.0)
    low, high = np.array([-1.0 - size, -1.5 * size]), np.array([1.0 + 3.0 * size, 1.5 * size])
    return np.asarray(low + share * (high - low))


def _dataset(
    drive: GearDrive,
    speeds: NDArray[np.float64],
    oscillators: list[Oscillator],
    columns: dict[str, list[list[Any]]],
    n_motions: list[int],
    worst_share: list[float],
    jumps: list[Jump],
) -> xr.Dataset:
    import xarray as xr  # here, so that importing gearpair stays quick

    variables: dict[str, Any] = {
        name: (("run", "speed"), np.array(column), attributes(name)) for name, column in columns.items()
    }
    linear = [linear_response(osc) for osc in oscillators]
    unit_um = drive.half_backlash_m * 1e6
    of_speed = {
        "n_motions": n_motions,
        "worst_share": worst_share,
        "linear_factor": [each.load_factor for each in linear],
        "linear_rms": [each.x_rms * unit_um for each in linear],
    }
    variables |= {name: ("speed", np.array(values), attributes(name)) for name, values in of_speed.items()}
    ratios = np.array([osc.mesh_frequency for osc in oscillators])
    variables["mesh_frequency"] = ("speed", ratios, attributes("frequency_ratio"))
    at = np.array([jump.mesh_frequency * drive.resonance_rpm for jump in jumps])
    variables["jump_speed"] = ("jump", at, attributes("jump_speed"))
    for name, field in {"run": "run", "kind": "kind", "from": "before", "to": "after"}.items():
        words = np.array([getattr(jump, field) for jump in jumps], dtype=str)
        variables[f"jump_{name}"] = ("jump", words, attributes(f"jump_{name}"))
    return xr.Dataset(
        variables,
        {"run": list(RUNS), "speed": ("speed", speeds, attributes("speed"))},
        {"drive": repr(drive), "mean_force_n": drive.mean_force_n},
    )
