"""A bifurcation taken along while the oscillator changes: where it is now, and how fast it moves."""

from dataclasses import replace

import numpy as np

from gearpair._checks import checked
from gearpair.bifurcations._walk import CLOSE, Step, newton_step, null_vector
from gearpair.bifurcations.curves import CurveProblem
from gearpair.bifurcations.locating import Bifurcation, bifurcation_at
from gearpair.motion.trajectories import stroboscopic_map
from gearpair.oscillator import Oscillator

NEWTON_STEPS = 20


@checked
def move_bifurcation(bifurcation: Bifurcation, osc: Oscillator) -> Bifurcation | None:
    """The same bifurcation of another oscillator near by, along the same parameter.

    Parameters
    ----------
    bifurcation : Bifurcation
        Located by `continue_orbit`.
    osc : Oscillator
        Its own value of the bifurcation's parameter does not matter.

    Returns
    -------
    Bifurcation or None
        None where Newton's method does not converge: move in smaller steps, or there is none any more.

    Notes
    -----
    Newton's method on the three equations of `continue_bifurcation`, in X, X' and the parameter. For a curve in two
    parameters take that; here everything else may change at once.

    Examples
    --------
    >>> from gearpair import continue_orbit, periodic_orbit
    >>> osc = Oscillator()
    >>> flip = continue_orbit(periodic_orbit(osc, 0.34, -0.25, 2), "mesh_frequency", 0.7, 0.77).bifurcations[0]
    >>> moved = move_bifurcation(flip, osc.replace(damping_ratio=0.021))
    >>> round(flip.value, 5), round(moved.value, 5)
    (0.76601, 0.76459)
    """
    there = osc.replace(**{bifurcation.parameter: bifurcation.value})
    problem = CurveProblem(
        replace(bifurcation, oscillator=there), {bifurcation.parameter: abs(bifurcation.value) or 1.0}
    )
    u = problem.unknowns(bifurcation.x, bifurcation.v)
    for _ in range(NEWTON_STEPS):
        found = problem.equations(u)
        if found is None:
            return None
        change = newton_step(found[1], found[0])
        if change is None:
            return None
        u = u + change
        if np.max(np.abs(change)) < CLOSE:
            cycle = problem.cycle(u)
            return bifurcation_at(problem, bifurcation.kind, Step(u, found[0], 0, cycle), *[cycle.contacts] * 2)
    return None


@checked
def fold_shift(fold: Bifurcation, low: Oscillator, high: Oscillator) -> float:
    """By how much a fold moves along its parameter from one oscillator to another, to first order.

    Parameters
    ----------
    fold : Bifurcation
        Of an oscillator half-way between both.
    low, high : Oscillator
        So near to each other that the map changes by a straight line in between.

    Notes
    -----
    At a fold the derivative M of the period map P has a left vector w with ``w (M - 1) = 0``. What moves the fold by
    ``dp`` along its parameter and the oscillator by a small change leaves ``w P`` as it is: ``w dP + w P_p dp = 0``.

    Examples
    --------
    >>> from gearpair import continue_orbit, steady_state
    >>> osc = Oscillator(damping_ratio=0.1, error_amplitude=0.1)
    >>> branch = continue_orbit(steady_state(osc, 0.5), "mesh_frequency", 0.7, 0.8)
    >>> fold = next(each for each in branch.bifurcations if each.kind == "fold")
    >>> low, high = (osc.replace(error_amplitude=size) for size in (0.0999, 0.1001))
    >>> both = [move_bifurcation(fold, each).value for each in (low, high)]
    >>> abs(fold_shift(fold, low, high) / (both[1] - both[0]) - 1.0) < 1e-4
    True
    """
    problem = CurveProblem(fold, {fold.parameter: 1.0})
    u = problem.unknowns(fold.x, fold.v)
    found = problem.equations(u)
    if found is None:
        raise RuntimeError(f"the fold's orbit cannot be followed from X = {fold.x:.5g}, X' = {fold.v:.5g}")
    across = null_vector((problem.cycle(u).monodromy - np.eye(2)).T)
    ends = [
        np.array(stroboscopic_map(osc.replace(**{fold.parameter: fold.value}), fold.x, fold.v, fold.period))
        for osc in (low, high)
    ]
    return float(-(across @ (ends[1] - ends[0])) / (across @ found[1][:2, 2]))
