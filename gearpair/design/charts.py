"""The speed chart: what a drive does at every speed of a range, run up, run down and from many starts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_count, check_number, check_reach, checked
from gearpair.design.found import KEPT, LOSSES, Found, find_motions, force_of, largest
from gearpair.design.jumps import Jump, find_jumps
from gearpair.design.linear import linear_response
from gearpair.drive import GearDrive
from gearpair.motion.settling import CHART, settle_batch, settle_both_ways
from gearpair.motion.steady import SteadyState, describe
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

# Of the mesh resonance: where a chart begins and ends that nothing else bounds; and how far beyond the service.
FIRST, LAST, BEYOND = 0.15, 1.35, 1.1


@checked
def chart_speeds(
    drive: GearDrive,
    n_speeds: int = 121,
    *,
    lowest_rpm: float | None = None,
    highest_rpm: float | None = None,
    service_rpm: Sequence[float] | None = None,
) -> NDArray[np.float64]:
    """The speeds that a chart of a drive is for: as given, or around the mesh resonance and over the service.

    Parameters
    ----------
    drive : GearDrive
        With or without a speed of its own.
    n_speeds : int
        How many, evenly spread.
    lowest_rpm, highest_rpm : float, optional
        Of the pinion, in rpm.
    service_rpm : sequence of float, optional
        The lowest and the highest speed that the drive runs at, which an end that is not given leaves inside.

    Returns
    -------
    ndarray, shape (n_speeds,)
        Speeds of the pinion, in rpm, rising.

    Examples
    --------
    >>> from gearpair import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=4.0, damping_ratio=0.05)
    >>> (chart_speeds(drive, 3) / drive.resonance_rpm).round(2)
    array([0.15, 0.75, 1.35])
    """
    resonance = drive.resonance_rpm
    service = (np.inf, 0.0)
    if service_rpm is not None:
        service = check_reach("service_rpm", service_rpm)
        check_number("service_rpm[0]", service[0], above=0.0)
    low = None if lowest_rpm is None else check_number("lowest_rpm", lowest_rpm, above=0.0)
    high = None if highest_rpm is None else check_number("highest_rpm", highest_rpm, above=0.0)
    if high is None:
        high = max(LAST * resonance, BEYOND * max(service[1], low or 0.0))
    if low is None:
        low = min(FIRST * resonance, service[0], 0.5 * high)
    if not low < high:
        raise ValueError(f"lowest_rpm must be below highest_rpm, got {low:g} and {high:g}")
    return np.linspace(low, high, check_count("n_speeds", n_speeds, at_least=2))


@checked
def speed_chart(
    drive: GearDrive,
    speeds_rpm: ArrayLike,
    *,
    n_starts: int = 16,
    n_phases: int = 8,
    n_transient: int | None = None,
    locate_jumps: bool = True,
    progress: bool = False,
) -> xr.Dataset:
    """What a drive does over a range of speeds, in SI units, at the worst phase of its error if that is unknown.

    Parameters
    ----------
    drive : GearDrive
        With or without a speed of its own.
    speeds_rpm : array_like of float, shape (n,)
        Of the pinion, rising, at least two.
    n_starts : int
        Starts at each speed and phase, spread evenly over a rectangle of X and X' about the backlash and the static
        deflection; they find the motions that no run meets, and what share of the starts leads to each.
    n_phases : int
        Phases of the transmission error, spread evenly from 0, where it is unknown (`GearDrive.phase_is_unknown`).
        One between two of eight had a largest factor up to 15 % higher, for one of ten random pairs; at a single speed
        it may be far higher, where a motion jumps.
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
        Over ``(run, speed)``, the run being ``"up"`` or ``"down"`` at the worst phase of the range (the one with the
        largest mesh force), or ``"worst"`` (the motion with the largest tooth force of all that were found at that
        speed and any phase; by mesh force where the drive has no `mesh`): ``motion``, ``period``, ``impact_state``,
        ``dte_rms``, ``dte_peak_to_peak`` (um), ``mesh_force``, ``tooth_force`` (N), ``dynamic_factor``,
        ``time_apart``, ``impact_rate`` (1/s), ``impact_velocity`` (mm/s) and ``both_flanks``, whether one error of
        the profile served both flanks; of the jump by which a run came to that
        speed ``jump_speed`` (rpm, nan where there is none), ``jump_kind``, ``jump_from`` and ``jump_to``, see
        `find_jumps`.

        Over ``speed``: ``worst_phase`` (rad) of the worst motion, and at it ``n_motions`` and ``worst_share`` of the
        starts that leads to the worst; ``loss``, what the teeth do that lose contact, at the worst phase for it, empty
        if they do at none; the largest factor of all motions, ``factor_low`` and ``factor_high``, at the mildest and
        the worst phase, and ``time_apart_high`` and ``impact_velocity_high``; ``linear_factor`` and ``linear_rms``
        (um) of `linear_response` at the phase of the runs; ``mesh_frequency`` (dimensionless).

        The attribute ``run_phase_rad`` is the phase of the runs, ``n_phases`` how many were tried; ``error_phase`` is
        ``"known"``, ``"unknown"``, or ``"none"`` where there is no error.

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
    drives, n = at_phases(drive, n_phases), len(speeds)
    ranges = [oscillators_at(each, speeds) for each in drives]
    runs = carried_runs(ranges, n_transient, progress=progress)
    started = settled_starts([osc for each in ranges for osc in each], n_starts, n_transient, progress=progress)
    seen = [  # of each phase, at each speed
        [find_motions(drive, *motions) for motions in zip(up, down, started[k * n : k * n + n], strict=True)]
        for k, (up, down) in enumerate(runs)
    ]
    chosen = worst_of([[load["mesh_force"] for each in row for load in each.loads] for row in seen])
    jumps = find_jumps(*runs[chosen]) if locate_jumps else []
    return _dataset(drives, speeds, ranges[chosen], seen, chosen, n_starts, jumps).assign_attrs(
        drive=repr(drive), mean_force_n=drive.mean_force_n, error_phase=_error_phase(drive), n_phases=len(drives)
    )


def _error_phase(drive: GearDrive) -> str:
    if drive.phase_is_unknown:
        return "unknown"
    sizes = [amplitude for _, amplitude, *_ in (*drive.all_harmonics, *drive.shaft_orders)]
    return "known" if any(sizes) else "none"


def at_phases(drive: GearDrive, n_phases: int) -> list[GearDrive]:
    """The drive at phases of its error that are spread evenly from 0; itself alone where the phase is known."""
    n_phases = check_count("n_phases", n_phases)
    if not drive.phase_is_unknown:
        return [drive]
    return [drive.at_phase(2.0 * np.pi * k / n_phases) for k in range(n_phases)]


def worst_of(forces: Sequence[Sequence[float]]) -> int:
    """The place of the row with the largest mesh force, than which nan, of a motion without bound, is larger."""
    return int(np.argmax([np.nan_to_num(row, nan=np.inf).max() for row in forces]))


def check_speeds(speeds_rpm: ArrayLike) -> NDArray[np.float64]:
    """Rising speeds above 0, at least two, or a ValueError."""
    speeds = check_rising("speeds_rpm", speeds_rpm)
    for i, speed in enumerate(speeds.tolist()):
        check_number(f"speeds_rpm[{i}]", speed, above=0.0)
    return speeds


def check_rising(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Rising numbers, at least two, or a ValueError."""
    array = check_array(name, values)
    if array.ndim != 1 or len(array) < 2:
        raise ValueError(f"{name} must be at least two numbers, got shape {array.shape}")
    if not np.all(np.diff(array) > 0.0):
        raise ValueError(f"{name} must rise, each above the one before")
    return array


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
    starts = np.array([(drive_side(osc) + osc.mean_force / osc.stiffness.mean, 0.0) for osc in lanes])
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
    drive flank; X' up to one and a half times it, each way. Mirrored where the mean force is negative.
    """
    size, sign = max(1.0, abs(osc.mean_force) / osc.stiffness.mean), drive_side(osc)
    share = np.mod(0.5 + np.arange(1, n + 1)[:, None] * np.array([0.7548776662466927, 0.5698402909980532]), 1.0)
    low, high = np.array([-1.0 - size, -1.5 * size]), np.array([1.0 + 3.0 * size, 1.5 * size])
    return np.asarray(sign * (low + share * (high - low)))


def drive_side(osc: Oscillator) -> float:
    """1 where the mean force presses the teeth to X = 1, or is none, -1 where to X = -1."""
    return -1.0 if osc.mean_force < 0.0 else 1.0


def _dataset(
    drives: list[GearDrive],
    speeds: NDArray[np.float64],
    oscillators: list[Oscillator],
    seen: list[list[Found]],
    chosen: int,
    n_starts: int,
    jumps: list[Jump],
) -> xr.Dataset:
    import xarray as xr  # here, so that importing gearpair stays quick

    phases = [each.error_phase_rad or 0.0 for each in drives]
    worst = [
        int(np.argmax([force_of(each.loads[each.worst]) for each in column])) for column in zip(*seen, strict=True)
    ]
    at_worst = [seen[k][i] for i, k in enumerate(worst)]
    shown = {
        "up": [each.row(0) for each in seen[chosen]],
        "down": [each.row(each.down) for each in seen[chosen]],
        "worst": [each.row(each.worst) for each in at_worst],
    }
    names = shown["up"][0]
    columns: dict[str, Any] = {name: [[row[name] for row in run] for run in shown.values()] for name in names}
    columns |= _jump_columns(speeds, jumps, drives[0].resonance_rpm)
    linear = [linear_response(osc) for osc in oscillators]
    of_speed = {
        "worst_phase": [phases[k] for k in worst],
        "n_motions": [len(each.states) for each in at_worst],
        "worst_share": [each.counts[each.worst] / n_starts if n_starts else np.nan for each in at_worst],
        **_over_phases(seen),
        "linear_factor": [each.load_factor for each in linear],
        "linear_rms": [each.x_rms * drives[0].half_backlash_m * 1e6 for each in linear],
    }
    variables: dict[str, Any] = {
        **{name: (("run", "speed"), np.array(column), attributes(name)) for name, column in columns.items()},
        **{name: ("speed", np.array(values), attributes(name)) for name, values in of_speed.items()},
    }
    ratios = np.array([osc.mesh_frequency for osc in oscillators])
    variables["mesh_frequency"] = ("speed", ratios, attributes("frequency_ratio"))
    coordinates = {"run": list(shown), "speed": ("speed", speeds, attributes("speed"))}
    return xr.Dataset(variables, coordinates, {"run_phase_rad": phases[chosen]})


def _over_phases(seen: list[list[Found]]) -> dict[str, list[Any]]:
    """The band over the phases of the largest factor, and the worst of contact, by speed."""
    columns = list(zip(*seen, strict=True))
    factors = [[each.largest("dynamic_factor") for each in column] for column in columns]
    return {
        "factor_low": [-largest(-each for each in row) for row in factors],
        "factor_high": [largest(row) for row in factors],
        **{
            f"{name}_high": [largest(each.largest(name) for each in column) for column in columns]
            for name in ("time_apart", "impact_velocity")
        },
        "loss": [max((each.loss for each in column), key=(KEPT, *LOSSES).index) for column in columns],
    }


def _jump_columns(speeds: NDArray[np.float64], jumps: list[Jump], resonance_rpm: float) -> dict[str, Any]:
    """Of each run, at the speed that it jumped on its way to: the speed of the jump, its kind, and both motions."""
    runs = ("up", "down", "worst")
    columns: dict[str, Any] = {
        name: [[blank] * len(speeds) for _ in runs]
        for name, blank in {"jump_speed": np.nan, "jump_kind": "", "jump_from": "", "jump_to": ""}.items()
    }
    for jump in jumps:
        at = jump.mesh_frequency * resonance_rpm
        place = int(np.clip(np.searchsorted(speeds, at), 1, len(speeds) - 1)) - (jump.run == "down")
        for column, value in zip(columns.values(), (at, jump.kind, jump.before, jump.after), strict=True):
            column[runs.index(jump.run)][place] = value
    return columns
