"""Period doubling: the doubled branch of a flip, and cascades of flips."""

import numpy as np

from gearpair._checks import check_count, checked
from gearpair._flow.cycle import map_at
from gearpair.bifurcations._orbit_problem import OrbitProblem
from gearpair.bifurcations._walk import correct, null_vector
from gearpair.bifurcations.branches import SIZES, continue_orbit
from gearpair.bifurcations.locating import Bifurcation
from gearpair.bifurcations.orbits import PeriodicOrbit, orbit_at


@checked
def doubled_orbit(bifurcation: Bifurcation) -> PeriodicOrbit:
    """An orbit of twice the period close to a flip: the start of the doubled branch.

    It is at a parameter value next to the flip's, on the side where the doubled branch is born.

    Raises
    ------
    RuntimeError
        Where no doubled orbit was found, as when the flip lies on a grazing.

    Examples
    --------
    >>> from gearpair import Oscillator, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34, -0.25, 2)
    >>> flip = continue_orbit(orbit, "mesh_frequency", 0.7, 0.77).bifurcations[0]
    >>> doubled = doubled_orbit(flip)
    >>> doubled.period, doubled.stable
    (4, True)
    """
    if bifurcation.kind != "flip":
        raise ValueError(f"bifurcation must be a flip, got a {bifurcation.kind} at {bifurcation.value}")
    osc, name = bifurcation.oscillator, bifurcation.parameter
    monodromy = np.empty((2, 2))
    map_at(osc.coefficients, bifurcation.x, bifurcation.v, bifurcation.period, monodromy)
    problem = OrbitProblem(osc, 2 * bifurcation.period, {name: max(abs(bifurcation.value), 1e-3)})
    u = problem.unknowns(bifurcation.x, bifurcation.v)
    normal = np.array([*null_vector(monodromy + np.eye(2)), 0.0])
    for distance in (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-3, 1e-2):
        found = correct(problem.equations, u + distance * normal, normal)
        if found is not None and np.max(np.abs(problem.cycle(found[0]).half_gap())) > distance:
            x, v = found[0][:2].tolist()
            return orbit_at(problem.oscillator(found[0]), x, v, problem.period)
    raise RuntimeError(
        f"no orbit of period {2 * bifurcation.period} was found near the flip at {name} = {bifurcation.value}"
    )


@checked
def doubling_cascade(flip: Bifurcation, levels: int = 5) -> list[Bifurcation]:
    """The flips of a period-doubling sequence, from its first on, each of twice the period of the one before it.

    They are fewer than `levels` where a branch has no further flip (a fold or a grazing ended the sequence) or the next
    could not be resolved.

    Parameters
    ----------
    flip : Bifurcation
        Of kind ``"flip"``; the doubled branch is followed on the side where it is born.
    levels : int
        How many flips at most, the first included.

    Notes
    -----
    Where nothing interferes the gaps between the flips shrink by 4.669 (Feigenbaum, 1978).

    Examples
    --------
    >>> from gearpair import Oscillator, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34, -0.25, 2)
    >>> first = continue_orbit(orbit, "mesh_frequency", 0.7, 0.77).bifurcations[0]
    >>> [(flip.period, round(flip.value, 5)) for flip in doubling_cascade(first, 2)]
    [(2, 0.76601), (4, 0.79829)]
    """
    flips = [flip]
    check_count("levels", levels)
    width = 0.1 * max(abs(flip.value), 1e-3)
    while len(flips) < levels:
        last = flips[-1]
        try:
            orbit = doubled_orbit(last)
        except RuntimeError:
            break
        value = orbit.oscillator.parameter(last.parameter)
        side = 1.0 if value > last.value else -1.0
        reach = (last.value - 0.05 * side * width, last.value + side * width, value)
        branch = continue_orbit(
            orbit, last.parameter, min(reach), max(reach), largest_step=0.5 * SIZES.largest, max_steps=400
        )
        beyond = [b for b in branch.bifurcations if b.kind == "flip" and side * (b.value - last.value) > 0.0]
        if not beyond:
            break
        flips.append(min(beyond, key=lambda b: abs(b.value - last.value)))
        width = abs(flips[-1].value - flips[-2].value)
    return flips
