"""A drive over its torques and speeds, and the worst of a duty cycle on that map."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from tqdm import tqdm

from gearpair._checks import check_array, check_number, checked
from gearpair.design.charts import check_rising, check_speeds, speed_chart
from gearpair.design.found import KEPT, LOSSES, UNBOUNDED
from gearpair.drive import GearDrive
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

OF_ALL = {"dynamic_factor": "factor_high", "time_apart": "time_apart_high", "impact_velocity": "impact_velocity_high"}
OF_THE_WORST = ("tooth_force", "motion", "impact_state", "both_flanks")
OF_A_POINT = ("dynamic_factor", "mesh_force", "tooth_force", "time_apart", "impact_velocity")


@checked
def load_map(
    drive: GearDrive,
    torques_nm: ArrayLike,
    speeds_rpm: ArrayLike,
    *,
    n_starts: int = 16,
    n_phases: int = 8,
    n_transient: int | None = None,
    locate_jumps: bool = True,
    progress: bool = False,
) -> xr.Dataset:
    """What a drive does over torque and speed, at the worst phase of its error if that is unknown.

    Parameters
    ----------
    drive : GearDrive
        Each row is the `speed_chart` of this drive under another torque, which a relief of its tips follows.
    torques_nm : array_like of float, shape (m,)
        Of the pinion, rising, at least two; below 0 the other flanks carry.
    speeds_rpm : array_like of float, shape (n,)
    n_starts, n_phases, n_transient, locate_jumps
        As in `speed_chart`.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        Over ``(torque, speed)``. Of all motions that were found there, at any phase: ``dynamic_factor`` (nan without a
        torque), ``mesh_force`` (N), ``time_apart``, ``impact_velocity`` (mm/s), the largest of each, and ``loss``, what
        the teeth do that lose contact, empty if they do not. Of the one with the largest tooth force: ``tooth_force``
        (N), ``motion``, ``impact_state``, ``both_flanks`` and ``worst_phase`` (rad). Over ``(torque, run, speed)``, for
        the runs ``"up"`` and ``"down"``: ``jump_speed`` (rpm), nan where there is none.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.08)
    >>> found = load_map(drive, [50.0, 200.0], [2000.0, 4000.0], n_starts=2)
    >>> bool((found.dynamic_factor.sel(torque=50.0) > found.dynamic_factor.sel(torque=200.0)).all())
    True
    """
    torques, speeds = check_rising("torques_nm", torques_nm), check_speeds(speeds_rpm)
    options: dict[str, Any] = {"n_starts": n_starts, "n_phases": n_phases, "n_transient": n_transient}
    charts = [
        speed_chart(drive.replace(pinion_torque_nm=torque), speeds, locate_jumps=locate_jumps, **options)
        for torque in tqdm(torques.tolist(), "load map", unit="torque", disable=not progress)
    ]
    import xarray as xr  # here, so that importing gearpair stays quick

    plane = "torque", "speed"
    columns: dict[str, list[Any]] = {name: [each[high].values for each in charts] for name, high in OF_ALL.items()}
    columns["mesh_force"] = [_largest_force(each) for each in charts]
    columns |= {name: [each[name].values for each in charts] for name in ("loss", "worst_phase")}
    columns |= {name: [each[name].sel(run="worst").values for each in charts] for name in OF_THE_WORST}
    variables: dict[str, Any] = {name: (plane, np.array(values), attributes(name)) for name, values in columns.items()}
    runs = ["up", "down"]
    jumps = np.array([each.jump_speed.sel(run=runs).values for each in charts])
    variables["jump_speed"] = (("torque", "run", "speed"), jumps, attributes("jump_speed"))
    axes = {name: (name, values, attributes(name)) for name, values in zip(plane, (torques, speeds), strict=True)}
    told = {"drive": repr(drive), "error_phase": charts[0].attrs["error_phase"]}
    return xr.Dataset(variables, axes | {"run": runs}, told)


def _largest_force(chart: xr.Dataset) -> NDArray[np.float64]:
    """The largest mesh force at each speed, in N; without a mean force that it is a multiple of, of the runs alone."""
    of_all = chart.factor_high.values * abs(chart.attrs["mean_force_n"])
    return np.asarray(of_all if chart.attrs["mean_force_n"] else chart.mesh_force.max("run").values)


@checked
def duty_cycle(found: xr.Dataset, points: ArrayLike) -> xr.Dataset:
    """What a drive meets at a list of operating points, the worst first.

    Parameters
    ----------
    found : xarray.Dataset
        Of `load_map`.
    points : array_like of (torque, speed, time), shape (n, 3)
        Of the pinion, in N m and rpm, within the map; the time as a share or in any unit, at least 0.

    Returns
    -------
    xarray.Dataset
        Over ``point``, the place in the list, by falling mesh force, and first of all where a motion leaves what the
        model can follow: ``torque``, ``speed``, ``time_share``, ``dynamic_factor``, ``mesh_force``, ``tooth_force``
        (N), ``time_apart``, ``impact_velocity`` (mm/s) and ``loss``. Of all points: ``worst_dynamic_factor``,
        ``worst_mesh_force`` (N) and ``parted_share``, the share of the time spent where the teeth may part.

    Notes
    -----
    A point takes the worst of the map's points around it, four between its lines and one on a crossing of them: where a
    motion begins or ends nothing can be interpolated. A finer map gives a sharper answer.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.08)
    >>> found = load_map(drive, [50.0, 200.0], [2000.0, 4000.0], n_starts=2)
    >>> cycle = duty_cycle(found, [(50.0, 2000.0, 3.0), (150.0, 3000.0, 1.0)])
    >>> cycle.point.values.tolist(), cycle.time_share.values.tolist()
    ([1, 0], [0.25, 0.75])
    """
    given = _operating_points(points)
    around = [(_beside("torque", found, torque), _beside("speed", found, speed)) for torque, speed, _ in given.tolist()]
    there = [found.isel(torque=rows, speed=columns) for rows, columns in around]
    values = {name: np.array([np.fmax.reduce(each[name].values.ravel()) for each in there]) for name in OF_A_POINT}
    losses = [max(each.loss.values.ravel().tolist(), key=(KEPT, *LOSSES).index) for each in there]
    shares = given[:, 2] / given[:, 2].sum()
    rank = np.where(np.array(losses) == UNBOUNDED, np.inf, np.nan_to_num(values["mesh_force"], nan=np.inf))
    order = np.argsort(-rank, kind="stable")
    import xarray as xr  # here, so that importing gearpair stays quick

    columns = {"torque": given[:, 0], "speed": given[:, 1], "time_share": shares, **values, "loss": np.array(losses)}
    variables: dict[str, Any] = {name: ("point", column[order], attributes(name)) for name, column in columns.items()}
    worst = {
        "worst_dynamic_factor": np.fmax.reduce(values["dynamic_factor"]),
        "worst_mesh_force": np.fmax.reduce(values["mesh_force"]),
        "parted_share": shares[np.array(losses) != KEPT].sum(),
    }
    variables |= {name: ((), float(value), attributes(name)) for name, value in worst.items()}
    return xr.Dataset(variables, {"point": order}, dict(found.attrs))


def _operating_points(points: ArrayLike) -> NDArray[np.float64]:
    """Torque, speed and time of each point, shape (n, 3), or a ValueError."""
    given = check_array("points", points)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"points must be rows of a torque, a speed and a time, got shape {given.shape}")
    for i, time in enumerate(given[:, 2].tolist()):
        check_number(f"the time of points[{i}]", time, at_least=0.0)
    if not given[:, 2].any():
        raise ValueError("points must have a time above 0 among them, got none")
    return given


def _beside(axis: str, found: xr.Dataset, value: float) -> list[int]:
    """The place of a value on an axis of the map, or the two that it lies between."""
    grid = found[axis].values
    check_number(f"the {axis} of a point", value, at_least=float(grid[0]), at_most=float(grid[-1]))
    lower = int(np.searchsorted(grid, value, side="right")) - 1
    return [lower] if grid[lower] == value else [lower, lower + 1]
