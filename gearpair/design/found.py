"""The motions that were found at one speed: what they bear, which is the worst, and how they lose contact."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearpair.design.loads import measure_motion, one_error_for_both, same_motion
from gearpair.drive import GearDrive
from gearpair.motion.impacts import ImpactState
from gearpair.motion.steady import SteadyState

KEPT = ""  # the teeth stay in contact
FLOAT, RARE, HISTORY, ALWAYS, BOTH, UNBOUNDED = LOSSES = (  # what the teeth do else, the worst last
    "float in the backlash without impacts",
    "part after a shock alone, not when run up or down",
    "part or stay in contact, depending on how the speed is reached",
    "part and strike, however the speed is reached",
    "strike on both flanks",
    "leave what the model can follow",
)
ONE_FLANK = (ImpactState.SINGLE_DRIVE, ImpactState.SINGLE_COAST)


@dataclass(frozen=True)
class Found:
    """All motions of a drive at one speed and one phase of its error.

    Attributes
    ----------
    states : list of SteadyState
        Each once; the run up's first.
    loads : list of dict
        `measure_motion` of each.
    counts : list of int
        Of the starts, how many lead to each.
    both : list of bool
        Whether one error of the profile served both flanks in each.
    down : int
        The place of the run down's.
    """

    states: list[SteadyState]
    loads: list[dict[str, float]]
    counts: list[int]
    both: list[bool]
    down: int

    @property
    def worst(self) -> int:
        """The place of the motion with the largest force."""
        return int(np.argmax([force_of(each) for each in self.loads]))

    def row(self, j: int) -> dict[str, Any]:
        """What a chart tells of the motion at a place."""
        state = self.states[j]
        names: dict[str, Any] = {"motion": str(state.motion.kind), "period": state.period or 0}
        names |= {"impact_state": str(state.impact_state or ""), "both_flanks": self.both[j]}
        return {**names, **self.loads[j]}

    def largest(self, name: str) -> float:
        """Of one of the `MEASURES` over all motions that stayed bounded; nan where there is none."""
        return largest(each[name] for each in self.loads)

    @property
    def loss(self) -> str:
        """How contact is lost, one of `LOSSES`, or `KEPT`."""
        states = [state.impact_state for state in self.states]
        struck = [state in ONE_FLANK for state in states]
        runs = struck[0], struck[self.down]
        for happens, loss in (
            (None in states, UNBOUNDED),
            (ImpactState.DOUBLE in states, BOTH),
            (all(runs), ALWAYS),
            (any(runs), HISTORY),
            (any(struck), RARE),
            (ImpactState.NEVER_IN_CONTACT in states, FLOAT),
        ):
            if happens:
                return loss
        return KEPT


def find_motions(drive: GearDrive, up: SteadyState, down: SteadyState, started: Sequence[SteadyState]) -> Found:
    """Sort the motions of both runs and of the starts at one speed: each motion is measured once."""
    states, counts = [up], [0]
    for state, count in [(down, 0), *((each, 1) for each in started)]:
        same = next((j for j, other in enumerate(states) if same_motion(other, state)), len(states))
        if same == len(states):
            states.append(state)
            counts.append(0)
        counts[same] += count
    reached = next(j for j, other in enumerate(states) if same_motion(other, down))
    loads = [measure_motion(drive, state) for state in states]
    return Found(states, loads, counts, [one_error_for_both(drive, state) for state in states], reached)


def force_of(loads: dict[str, float]) -> float:
    """What motions are compared by: the tooth force, the mesh force without a mesh; infinite if it grows."""
    force = loads["mesh_force"] if np.isnan(loads["tooth_force"]) else loads["tooth_force"]
    return float(np.nan_to_num(force, nan=np.inf))


def largest(values: Iterable[float]) -> float:
    """Of those that are numbers; nan where none is."""
    return max((each for each in values if not np.isnan(each)), default=np.nan)
