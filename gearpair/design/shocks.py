"""How large a gap in the torque a drive bears before it falls from its quiet motion into a louder one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike
from tqdm import tqdm

from gearpair._checks import check_count, check_number, checked
from gearpair.boundaries.dips import critical_dip
from gearpair.design.charts import carried_runs, check_speeds, oscillators_at, settled_starts
from gearpair.design.found import Found, find_motions
from gearpair.design.passages import check_one_course
from gearpair.drive import GearDrive
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr

NUMBERS = ("quiet_factor", "loud_factor", "shock_margin", "shock_phase", "dip_back", "surge_back")


@checked
def shock_margin(
    drive: GearDrive,
    speeds_rpm: ArrayLike,
    *,
    cycles: int = 3,
    n_phases: int = 8,
    largest: float = 1.0,
    n_starts: int = 16,
    progress: bool = False,
) -> xr.Dataset:
    """The smallest dip of the torque that throws a drive from its quiet motion into a louder one, at each speed.

    Parameters
    ----------
    drive : GearDrive
        With a torque, a known phase of its error (`GearDrive.at_phase`) and without `shaft_orders`.
    speeds_rpm : array_like of float, shape (n,)
        Of the pinion, rising, at least two.
    cycles : int
        Tooth meshes that the dip lasts; it begins and ends at once.
    n_phases : int
        Moments of a mesh period at which it may begin.
    largest : float
        The largest dip tried, as a share of the torque; at 1 the torque is gone.
    n_starts : int
        Starts at each speed that look for motions besides the runs up and down, as in `speed_chart`.
    progress : bool
        Show a progress bar on stderr.

    Returns
    -------
    xarray.Dataset
        Over ``speed``: ``n_motions``; ``quiet_motion`` and ``loud_motion``, those with the smallest and the largest
        mesh force, and their dynamic factors ``quiet_factor`` and ``loud_factor``; ``shock_margin``, the smallest dip
        that ends the quiet motion, as a share of the torque, ``shock_phase``, when it begins in mesh periods, and
        ``after_shock``, the motion after it; ``dip_back`` and ``surge_back``, the smallest dip and rise, of as many
        cycles, that end the loud motion. Nan where there is one motion, where no dip up to `largest` is enough, or
        where a motion is not periodic.

    Notes
    -----
    Every dip is followed exactly, at each phase; see `gearpair.boundaries.critical_dip` for how the smallest is found,
    and that it is the smallest of those looked at. At a jump the margin of the motion that ends there goes to zero.

    Examples
    --------
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=[(1, 5.0, 0.0)], damping_ratio=0.05)
    >>> margin = shock_margin(drive, [3000.0, 4000.0], n_phases=2, n_starts=4)
    >>> margin.n_motions.values.tolist()
    [1, 1]
    """
    import xarray as xr  # here, so that importing gearpair stays quick

    speeds = check_speeds(speeds_rpm)
    cycles, n_phases = check_count("cycles", cycles), check_count("n_phases", n_phases)
    largest = check_number("largest", largest, above=0.0)
    n_starts = check_count("n_starts", n_starts, at_least=0)
    check_one_course(drive)
    if drive.pinion_torque_nm == 0.0:
        raise ValueError("drive must have a torque that can dip, got pinion_torque_nm = 0.0")
    oscillators = oscillators_at(drive, speeds)
    up, down = carried_runs([oscillators], None, progress=progress)[0]
    started = settled_starts(oscillators, n_starts, None, progress=progress)
    rows = []
    found = [find_motions(drive, *each) for each in zip(up, down, started, strict=True)]
    pairs = zip(oscillators, found, strict=True)
    for osc, motions in tqdm(pairs, "shocks", len(speeds), unit="speed", disable=not progress):
        rows.append(_row(osc, motions, cycles, n_phases, largest))
    variables = {name: ("speed", np.array([row[name] for row in rows]), attributes(name)) for name in rows[0]}
    coordinates = {"speed": ("speed", speeds, attributes("speed"))}
    return xr.Dataset(variables, coordinates, {"drive": repr(drive), "cycles": cycles, "largest_dip": largest})


def _row(osc: Oscillator, found: Found, cycles: int, n_phases: int, largest: float) -> dict[str, float | str]:
    """What one speed has."""
    bounded = [j for j, state in enumerate(found.states) if state.impact_state is not None]
    motions = [found.states[j] for j in bounded]
    factors = [found.loads[j]["dynamic_factor"] for j in bounded]
    row: dict[str, float | str] = {"n_motions": len(motions), "quiet_motion": "", "loud_motion": "", "after_shock": ""}
    row |= dict.fromkeys(NUMBERS, np.nan)
    if not motions:
        return row
    quiet, loud = motions[int(np.argmin(factors))], motions[int(np.argmax(factors))]
    row |= {"quiet_motion": str(quiet.motion), "quiet_factor": min(factors)}
    row |= {"loud_motion": str(loud.motion), "loud_factor": max(factors)}
    if len(motions) == 1:
        return row
    if quiet.period is not None:
        dip = critical_dip(osc, quiet, cycles=cycles, n_phases=n_phases, largest=largest)
        row |= {"shock_margin": abs(dip.change), "shock_phase": dip.phase % 1.0}
        row["after_shock"] = str(dip.leads_to.motion) if dip.leads_to else ""
    if loud.period is not None:
        for name, surge in (("dip_back", False), ("surge_back", True)):
            back = critical_dip(osc, loud, cycles=cycles, n_phases=n_phases, largest=largest, surge=surge)
            row[name] = abs(back.change)
    return row
