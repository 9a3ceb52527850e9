"""What a motion is called."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gearpair.motion.impacts import ImpactState
from gearpair.motion.settling import Status

if TYPE_CHECKING:
    import xarray as xr

CHAOS = "chaos"
IMPACT_NAMES: Mapping[str, str] = {
    ImpactState.NEVER_IN_CONTACT: "never in contact",
    ImpactState.NONE_DRIVE: "no impact",
    ImpactState.NONE_COAST: "no impact on the coast side",
    ImpactState.SINGLE_DRIVE: "single-sided",
    ImpactState.SINGLE_COAST: "single-sided on the coast side",
    ImpactState.DOUBLE: "double-sided",
    "": "not bounded",
}


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


def motion_names(result: xr.Dataset) -> NDArray[np.str_]:
    """The name of every motion of a sweep, a map or a plane of starts, in the shape of its ``status``."""
    pairs = zip(result.status.values.ravel(), result.period.values.ravel(), strict=True)
    return np.array([motion_name(status, int(period)) for status, period in pairs]).reshape(result.status.shape)


def motion_order(motion: str) -> tuple[int, int, str]:
    """A key that sorts the names of motions: periodic ones by period, then chaos, then the rest."""
    if motion.startswith("period "):
        return 0, int(motion.removeprefix("period ")), motion
    return 1 + (motion != CHAOS), 0, motion
