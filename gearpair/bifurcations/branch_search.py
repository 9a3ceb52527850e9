"""A search for the branches of periodic orbits in a range of one parameter."""

import numpy as np

from gearpair._checks import check_count, check_number, check_reach, checked
from gearpair.bifurcations.branches import LARGEST_X, SIZES, Branch, continue_orbit, limit_of
from gearpair.bifurcations.doubling import doubled_orbit
from gearpair.bifurcations.locating import Bifurcation
from gearpair.bifurcations.orbits import PeriodicOrbit, find_orbits, periodic_orbit
from gearpair.motion.same_orbit import lies_on
from gearpair.oscillator import Oscillator


@checked
def find_branches(
    osc: Oscillator,
    parameter: str,
    lower: float,
    upper: float,
    *,
    max_period: int = 4,
    n_values: int = 11,
    n_starts: int = 100,
    largest_step: float = SIZES.largest,
    largest_x: float = LARGEST_X,
) -> list[Branch]:
    """The branches of periodic orbits that a search finds in a range of one parameter.

    Orbits are looked for from many starts at evenly spaced values; each that lies on no branch yet is
    continued, and so is the doubled branch of each flip, up to `max_period`. They come in the order found;
    a finite search can miss some.

    Parameters
    ----------
    osc : Oscillator
    parameter, lower, upper, largest_step, largest_x
        As in `continue_orbit`; orbits that reach further are left out.
    max_period, n_starts
        As in `find_orbits`, at each value; no longer period is followed either.
    n_values : int
        Values at which orbits are looked for.

    Examples
    --------
    >>> branches = find_branches(Oscillator(damping_ratio=0.1), "mesh_frequency", 0.7, 0.75, max_period=1, n_values=2)
    >>> [(branch.period, [b.kind for b in branch.bifurcations]) for branch in branches]
    [(1, ['flip'])]
    """
    lower, upper = check_reach("lower and upper", (lower, upper))
    branches: list[Branch] = []
    check_number("largest_x", largest_x, above=0.0)
    for value in np.linspace(lower, upper, check_count("n_values", n_values)).tolist():
        waiting: list[PeriodicOrbit | Bifurcation] = [
            *find_orbits(osc.replace(**{parameter: value}), max_period, n_starts=n_starts)
        ]
        while waiting:
            orbit = _start(branches, waiting.pop(0), lower, upper, largest_x)
            if orbit is not None:
                branch = continue_orbit(orbit, parameter, lower, upper, largest_step=largest_step, largest_x=largest_x)
                branches.append(branch)
                waiting += [b for b in branch.bifurcations if b.kind == "flip" and 2 * b.period <= max_period]
    return branches


def _start(
    branches: list[Branch], found: PeriodicOrbit | Bifurcation, lower: float, upper: float, largest_x: float
) -> PeriodicOrbit | None:
    """The orbit to continue from an orbit or a flip, or None where that leads to nothing new."""
    if isinstance(found, PeriodicOrbit):
        assert found.x_min is not None and found.x_max is not None  # it has converged
        large = max(-found.x_min, found.x_max) > limit_of(found.oscillator, largest_x)
        return None if large or any(_on_branch(branch, found) for branch in branches) else found
    for branch in branches:
        if branch.period == 2 * found.period and np.any(np.abs(branch.values[[0, -1]] - found.value) < 1e-6):
            return None
    try:
        orbit = doubled_orbit(found)
    except RuntimeError:
        return None
    return orbit if lower <= orbit.oscillator.parameter(found.parameter) <= upper else None


def _on_branch(branch: Branch, orbit: PeriodicOrbit) -> bool:
    """Whether Newton's method, started from the branch interpolated to the orbit's value, leads to the orbit."""
    if branch.period != orbit.period:
        return False
    value = orbit.oscillator.parameter(branch.parameter)
    left, right = branch.values[:-1], branch.values[1:]
    slack = 1e-12 * max(1.0, abs(value))  # a branch ends at a bound up to rounding
    for i in np.flatnonzero((np.minimum(left, right) <= value + slack) & (value - slack <= np.maximum(left, right))):
        share = (value - left[i]) / (right[i] - left[i]) if right[i] != left[i] else 0.0
        x, v = (1.0 - share) * branch.points[i, 0] + share * branch.points[i + 1, 0]
        if np.min(np.max(np.abs(orbit.points - (x, v)), axis=1)) > 0.1:
            continue
        found = periodic_orbit(orbit.oscillator, x, v, orbit.period)
        if found.converged and lies_on(found.points[0], orbit.points):
            return True
    return False
