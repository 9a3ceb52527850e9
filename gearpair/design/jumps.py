"""Where a run up or down leaves the motion that it was on."""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from gearpair._checks import checked
from gearpair.bifurcations import Bifurcation, continue_orbit, periodic_orbit
from gearpair.motion.steady import SteadyState

SMOOTH = 0.1  # change of X_min and X_max, relative to their distance, that no jump is needed for
ARRIVED = 1e-3  # how near to the next motion a branch has to lead to be its own
MAX_STEPS = 300
ON_GRID = "between speeds"  # the kind of a jump that no continuation locates


@dataclass(frozen=True)
class Jump:
    """A speed at which a run leaves a motion.

    Attributes
    ----------
    run : str
        ``"up"`` or ``"down"``.
    mesh_frequency : float
        Omega, where the motion ends.
    kind : str
        ``"fold"``, ``"flip"`` or ``"grazing"``, the bifurcation at which it ends; ``"between speeds"`` where the motion
        is not periodic, or its branch goes on: the jump is then known to the step of the run alone.
    before, after : str
        The motions.
    bifurcation : Bifurcation or None
        That at which the motion ends; None between speeds.
    """

    run: str
    mesh_frequency: float
    kind: str
    before: str
    after: str
    bifurcation: Bifurcation | None = field(default=None, repr=False, compare=False)


@checked
def find_jumps(up: list[SteadyState], down: list[SteadyState]) -> list[Jump]:
    """The jumps of a run up and of one down over the same speeds.

    Parameters
    ----------
    up, down : list of SteadyState
        In the order of the speeds, each from a carried run.

    Returns
    -------
    list of Jump
        By rising speed.

    Notes
    -----
    Between two speeds of a run whose motions differ, the branch of the first motion is followed towards the second
    speed (pseudo-arclength continuation): the jump is where it first loses its stability. A change that is continuous,
    a period doubling or an impact that sets in, is no jump. Between two motions that are not periodic none is looked
    for.

    Examples
    --------
    >>> from gearpair import Oscillator, steady_state
    >>> osc, up = Oscillator(damping_ratio=0.1, error_amplitude=0.1), []
    >>> for value in (0.7, 0.75, 0.8):
    ...     start = up[-1].points[0].tolist() if up else (0.5, 0.0)
    ...     up.append(steady_state(osc.replace(mesh_frequency=value), *start))
    >>> [jump] = find_jumps(up, [])
    >>> jump.kind, round(jump.mesh_frequency, 3)
    ('fold', 0.763)
    """
    found = []
    for run, states in (("up", up), ("down", down[::-1])):
        for before, after in pairwise(states):
            if _differ(before, after):
                jump = _located(run, before, after)
                if jump is not None:
                    found.append(jump)
    return sorted(found, key=lambda jump: (jump.mesh_frequency, jump.run))


def _differ(before: SteadyState, after: SteadyState, smooth: float = SMOOTH) -> bool:
    """Whether two neighbours of a run are so unlike that a jump may lie between them."""
    if before.period is None and after.period is None and before.impact_state and after.impact_state:
        return False  # chaos, whether its exponent was resolved or not
    size = max(before.x_max - before.x_min, after.x_max - after.x_min)
    change = max(abs(before.x_min - after.x_min), abs(before.x_max - after.x_max))
    return not change <= smooth * size


def _located(run: str, before: SteadyState, after: SteadyState) -> Jump | None:
    here, there = before.oscillator.mesh_frequency, after.oscillator.mesh_frequency
    names = str(before.motion.kind), str(after.motion.kind)
    middle = Jump(run, 0.5 * (here + there), ON_GRID, *names)
    if before.period is None:
        return middle
    x, v = before.points[0].tolist()
    orbit = periodic_orbit(before.oscillator, x, v, before.period)
    if not orbit.converged:
        return middle
    branch = continue_orbit(orbit, "mesh_frequency", min(here, there), max(here, there), max_steps=MAX_STEPS)
    # Where the branch turns round, two of its orbits lie at `here`: the run is on the one that it was started from.
    apart = np.abs(branch.values - here) + np.abs(branch.points[:, 0] - orbit.points[0]).max(axis=1)
    start = int(np.argmin(apart))
    rows = np.arange(start, len(apart))
    if start and (branch.values[start - 1] - here) * (there - here) > 0.0:  # the branch is walked the other way
        rows = np.arange(start, -1, -1)
    stable = branch.stable[rows]
    if np.all(stable):  # a change that is steep but continuous, unless the run went elsewhere
        arrived = after.period and np.abs(branch.points[rows[-1]] - after.points[0]).max(axis=1).min() < ARRIVED
        return None if arrived else middle
    lost = int(np.argmin(stable))
    row = rows[max(lost - 1, 0) : lost + 1].min()  # a bifurcation belongs to the row before it, in the order walked
    met = zip(branch.bifurcations, branch.bifurcation_rows.tolist(), strict=True)
    ends = sorted(met, key=lambda each: (abs(each[1] - row), each[0].kind == "grazing"))
    if not ends:
        return middle
    end = ends[0][0]
    if end.kind == "flip" and after.period == 2 * before.period and not _differ(before, after, 3.0 * SMOOTH):
        return None
    return Jump(run, end.value, end.kind, *names, end)
