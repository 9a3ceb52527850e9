"""What a motion is: one type for its status, period and impact state, which becomes text only where it is shown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import total_ordering
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, checked
from gearpair.motion.impacts import ImpactState
from gearpair.motion.settling import Status

if TYPE_CHECKING:
    import xarray as xr

IMPACT_NAMES: Mapping[str, str] = {
    ImpactState.NEVER_IN_CONTACT: "never in contact",
    ImpactState.NONE_DRIVE: "no impact",
    ImpactState.NONE_COAST: "no impact on the coast side",
    ImpactState.SINGLE_DRIVE: "single-sided",
    ImpactState.SINGLE_COAST: "single-sided on the coast side",
    ImpactState.DOUBLE: "double-sided",
    "": "not bounded",
}
# Of a motion that is not periodic, where that is not its status.
WORDS: Mapping[str, str] = {Status.APERIODIC: "chaos", Status.TRANSIENT: "chaotic transient"}
RANKS: Mapping[str, int] = {Status.PERIODIC: 0, Status.APERIODIC: 1, Status.TRANSIENT: 2}


@total_ordering
@dataclass(frozen=True)
class Motion:
    """A kind of motion; periodic ones come first, by period, then chaos, then the rest.

    Parameters
    ----------
    status : str
        A `Status`, or the article's word for a class of motions (`gearpair.article.published`).
    period : int or None
        In mesh periods; None unless periodic.
    impact_state : ImpactState or None
        None where it is left open.

    Examples
    --------
    >>> double = Motion("periodic", 2, ImpactState.DOUBLE)
    >>> print(double, double.kind, CHAOS, sep="; ")
    period 2, double-sided; period 2; chaos
    >>> [str(motion) for motion in sorted([CHAOS, periodic(10), periodic(2)])]
    ['period 2', 'period 10', 'chaos']
    """

    status: str
    period: int | None = None
    impact_state: ImpactState | None = None

    def __post_init__(self) -> None:
        if self.period is not None:
            check_count("period", self.period)

    def __str__(self) -> str:
        if self.status == Status.PERIODIC:
            word = f"period {self.period}"
        else:
            word = WORDS.get(self.status, str(self.status))
        return word if self.impact_state is None else f"{word}, {IMPACT_NAMES[self.impact_state]}"

    def __lt__(self, other: Motion) -> bool:
        return self._place < other._place

    @property
    def _place(self) -> tuple[int, int, str, str]:
        rank = RANKS.get(self.status, len(RANKS))
        return rank, self.period or 0, str(self.status), str(self.impact_state or "")

    @property
    def kind(self) -> Motion:
        """The same, whatever the impact state."""
        return Motion(self.status, self.period)


CHAOS = Motion(Status.APERIODIC)


@checked
def periodic(period: int, impact_state: ImpactState | None = None) -> Motion:
    """The motion of a period.

    Examples
    --------
    >>> print(periodic(3))
    period 3
    """
    return Motion(Status.PERIODIC, period, impact_state)


@checked
def motions_of(result: xr.Dataset) -> NDArray[np.object_]:
    """The kind of every motion of a sweep, a map or a plane of starts, in the shape of its ``status``.

    Examples
    --------
    >>> from gearpair import Oscillator, sweep
    >>> print(*motions_of(sweep(Oscillator(), "mesh_frequency", [0.7, 0.78])), sep="; ")
    period 2; period 4
    """
    return motions_from(result.status.values, result.period.values)


def motions_from(status: NDArray[np.str_], period: NDArray[np.int64]) -> NDArray[np.object_]:
    """Kinds of motion from their statuses and periods (0 unless periodic), in the shape of `status`."""
    kinds = np.empty(status.size, dtype=object)
    kinds[:] = [Motion(Status(s), int(p) or None) for s, p in zip(status.ravel(), period.ravel(), strict=True)]
    return kinds.reshape(status.shape)
