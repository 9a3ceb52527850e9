"""What helps, what does nothing, what makes it worse: a drive with one number changed at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_number, checked
from gearpair.design.charts import at_phases, carried_runs, check_speeds, oscillators_at, worst_of
from gearpair.design.loads import measure_motion
from gearpair.drive import GearDrive
from gearpair.quantities import attributes
from gearpair.teeth import SpurPair

if TYPE_CHECKING:
    import xarray as xr

OF_DRIVE = ("pinion_torque_nm", "backlash_um", "transmission_error_um", "damping_ratio")
OF_PAIR = tuple(field.name for field in fields(SpurPair) if not field.name.endswith(("teeth", "material")))
FACTORS = {name: (0.5, 2.0) for name in OF_DRIVE} | {"addendum": (0.95, 1.05)}
# What is kept of a range of speeds, by the names of the worst of it.
OUTCOMES = {
    "dynamic_factor": "worst_dynamic_factor",
    "mesh_force": "worst_mesh_force",
    "time_apart": "worst_time_apart",
    "impact_range": "impact_range",
}


@checked
def sensitivity(
    drive: GearDrive,
    speeds_rpm: ArrayLike,
    ranges: Mapping[str, tuple[float, float]] | None = None,
    *,
    n_phases: int = 8,
    n_transient: int | None = None,
    progress: bool = False,
) -> xr.Dataset:
    """How the worst of a speed range changes with one number of the drawing or the data sheet at a time.

    Parameters
    ----------
    drive : GearDrive
    speeds_rpm : array_like of float, shape (n,)
        Of the pinion, rising; run up and down with each change.
    ranges : mapping of str to (float, float), optional
        The low and the high value of each number: ``pinion_torque_nm``, ``backlash_um``, ``transmission_error_um`` (its
        harmonics go with it), ``damping_ratio``, or any size of the pair but the numbers of teeth, such as
        ``addendum``, which changes the contact ratio. Not given: half and twice each of the first four, and where
        the drive has a `mesh` the addendum five per cent less and more.
    n_phases, n_transient, progress
        As in `speed_chart`.

    Returns
    -------
    xarray.Dataset
        Over ``(change, end)``, the end being ``"low"`` or ``"high"``: ``value``, ``contact_ratio`` (nan without a mesh)
        and the worst over both runs of ``dynamic_factor``, ``mesh_force`` (N), ``time_apart`` and ``impact_range``
        (rpm). The same of the drive as it is in ``base_dynamic_factor`` and so on, and over ``change`` its
        ``base_value``. Where the phase of the error is unknown, all are at the one, ``phase_rad``, at which the mesh
        force of the drive as it is becomes largest.

    Notes
    -----
    A change of the geometry keeps the damping ratio, and takes inertias and mesh stiffness anew: `GearDrive.replace`.

    Examples
    --------
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.08)
    >>> found = sensitivity(drive, [2000.0, 3000.0], {"damping_ratio": (0.04, 0.16)})
    >>> found.dynamic_factor.sel(change="damping_ratio", end="low").item() > found.base_dynamic_factor.item()
    True
    """
    speeds = check_speeds(speeds_rpm)
    chosen = _default_ranges(drive) if ranges is None else dict(ranges)
    base = [_value(drive, name) for name in chosen]
    for name, ends in chosen.items():
        if len(ends) != 2:
            raise ValueError(f"the range of {name} must be a low and a high value, got {ends!r}")
    drive = _at_worst_phase(drive, speeds, n_phases, n_transient, progress)
    drives, values = [drive], []
    for name, ends in chosen.items():
        for value in ends:
            values.append(check_number(name, value))
            drives.append(drive.replace(**{name: values[-1]}))
    runs = carried_runs([oscillators_at(each, speeds) for each in drives], n_transient, progress=progress)
    rows = []
    for each, (up, down) in zip(drives, runs, strict=True):
        loads = [[measure_motion(each, state) for state in run] for run in (up, down)]
        table = {name: np.array([[row[name] for row in run] for run in loads]) for name in loads[0][0]}
        strikes = (table["impact_rate"] > 0.0).any(axis=0)
        largest = [table[name].max() for name in ("dynamic_factor", "mesh_force", "time_apart")]
        rows.append([*largest, float(np.gradient(speeds)[strikes].sum())])
    import xarray as xr  # here, so that importing gearpair stays quick

    shape = (len(chosen), 2)
    outcome = np.array(rows[1:]).reshape(*shape, len(OUTCOMES))
    ratios = [each.mesh.contact_ratio if each.mesh else np.nan for each in drives[1:]]
    variables: dict[str, Any] = {
        name: (("change", "end"), outcome[:, :, k], attributes(worst))
        for k, (name, worst) in enumerate(OUTCOMES.items())
    } | {f"base_{name}": ((), rows[0][k]) for k, name in enumerate(OUTCOMES)}
    variables["base_value"] = ("change", np.array(base, dtype=float), {"long_name": "as drawn"})
    variables["value"] = (("change", "end"), np.array(values).reshape(shape), {"long_name": "changed to"})
    variables["contact_ratio"] = (("change", "end"), np.array(ratios).reshape(shape), attributes("contact_ratio"))
    coordinates = {"change": list(chosen), "end": ["low", "high"]}
    return xr.Dataset(variables, coordinates, {"drive": repr(drive), "phase_rad": drive.error_phase_rad or 0.0})


def _at_worst_phase(
    drive: GearDrive, speeds: NDArray[np.float64], n_phases: int, n_transient: int | None, progress: bool
) -> GearDrive:
    """The drive at the phase of its error with the largest mesh force of both runs; itself where the phase is known."""
    drives = at_phases(drive, n_phases)
    if len(drives) == 1:
        return drives[0]
    runs = carried_runs([oscillators_at(each, speeds) for each in drives], n_transient, progress=progress)
    forces = [[measure_motion(drive, state)["mesh_force"] for state in (*up, *down)] for up, down in runs]
    return drives[worst_of(forces)]


def _default_ranges(drive: GearDrive) -> dict[str, tuple[float, float]]:
    names = [name for name in FACTORS if name in OF_DRIVE or drive.mesh is not None]
    present = {name: _value(drive, name) for name in names}
    return {
        name: (FACTORS[name][0] * present[name], FACTORS[name][1] * present[name]) for name in names if present[name]
    }


def _value(drive: GearDrive, name: str) -> float:
    """The present value of what can be changed."""
    if name in OF_DRIVE:
        return float(getattr(drive, name))
    if name not in OF_PAIR:
        raise ValueError(f"unknown name {name!r}; what can be changed is {', '.join((*OF_DRIVE, *OF_PAIR))}")
    if drive.mesh is None:
        raise ValueError(f"{name} can be changed only where the drive comes from GearDrive.from_pair")
    present = getattr(drive.mesh.pair, name)
    return np.nan if present is None else float(present)  # nan: it follows from others
