"""The smallest dip or surge of the load that throws a settled motion out of its basin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, check_number, checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations.orbits import PeriodicOrbit
from gearpair.boundaries.sections import at_phase, forward
from gearpair.boundaries.shocks import points_over_cycle
from gearpair.boundaries.sides import Sides
from gearpair.motion.settling import SettleOptions
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.oscillator import Oscillator

STEPS = 40  # changes of the load tried, evenly spaced, before the first that leaves is narrowed down
CUTS = 15  # tried at once between two
ACCURACY = 1e-4  # of the mean force


@equal_by_value
@dataclass(frozen=True, repr=False)
class CriticalDip:
    """The smallest change of the mean force found that throws a settled motion out of its basin.

    Attributes
    ----------
    oscillator : Oscillator
    cycles : int
        Mesh periods that it lasts.
    change : float
        Of the mean force, as a share of it: -0.5 is a dip to half; nan where none that was tried leaves.
    phase : float
        When it begins, in mesh periods since the motion was at ``points[0]``.
    leads_to : SteadyState or None
        Where the motion settles afterwards, seen from the phase at which the change ends.
    """

    oscillator: Oscillator
    cycles: int
    change: float
    phase: float
    leads_to: SteadyState | None

    def __repr__(self) -> str:
        """One line."""
        if self.leads_to is None:
            return f"no change of the load that was tried for {self.cycles} mesh periods leaves the basin"
        kind = "dip" if self.change < 0.0 else "surge"
        return f"a {kind} of {abs(self.change):.4g} for {self.cycles} mesh periods leads to {self.leads_to.motion}"


@checked
def critical_dip(
    osc: Oscillator,
    state: SteadyState | PeriodicOrbit,
    *,
    cycles: int = 1,
    n_phases: int = 8,
    largest: float = 1.0,
    surge: bool = False,
    **settling: Unpack[SettleOptions],
) -> CriticalDip:
    """The smallest dip of the mean force, over whole mesh periods, after which a motion does not come back.

    Parameters
    ----------
    osc : Oscillator
        With a mean force.
    state : SteadyState or PeriodicOrbit
        A stable periodic motion of `osc`.
    cycles : int
        Mesh periods that the dip lasts; it begins and ends at once.
    n_phases : int
        Phases of the mesh at which it may begin; a motion of period n has n times as many moments.
    largest : float
        The largest dip tried, as a share of the mean force; at 1 the load is gone.
    surge : bool
        A rise in place of a dip.
    **settling
        See `gearpair.motion.SettleOptions`.

    Raises
    ------
    ValueError
        For a motion that is not periodic and stable, or not of `osc`; without a mean force; with `shaft_orders`, with
        which a base period is no mesh period.

    Notes
    -----
    At each phase dips of forty sizes, evenly spaced up to `largest`, are followed exactly; between the first that
    leaves and the one before, the boundary is bisected to 1e-4 of the mean force. It is the smallest dip *found*:
    a narrow range of smaller dips that leave, too, may lie between two that were tried.

    Examples
    --------
    >>> from gearpair import StiffnessWave, steady_state
    >>> osc = Oscillator(error_amplitude=0.05, damping_ratio=0.05, mesh_frequency=0.75,
    ...     stiffness=StiffnessWave((0.0,), (1.0,)))
    >>> critical_dip(osc, steady_state(osc, 1.1, 0.0), cycles=2, n_phases=4)
    a dip of 0.4878 for 2 mesh periods leads to period 1, single-sided
    """
    cycles, n_phases = check_count("cycles", cycles), check_count("n_phases", n_phases)
    largest = check_number("largest", largest, above=0.0)
    if osc.mesh_periods > 1:
        raise ValueError(f"osc must repeat with the mesh period, got shaft_orders = {osc.shaft_orders}")
    if osc.mean_force == 0.0:
        raise ValueError("osc must have a mean force that can dip, got mean_force = 0.0")
    points = points_over_cycle(osc, state, n_phases)
    sizes = np.linspace(0.0, largest if surge else -largest, STEPS + 1)
    sections = [at_phase(osc, k / n_phases) for k in range(n_phases)]
    best, found = np.inf, 0
    for k, point in enumerate(points):
        sides = Sides(sections[k % n_phases], point, settling)
        change = _first_that_leaves(sides, point, cycles, sizes)
        if abs(change) < abs(best):
            best, found = change, k
            sizes = np.append(sizes[np.abs(sizes) < abs(change)], change)  # at another phase only a smaller one counts
    if np.isinf(best):
        return CriticalDip(osc, cycles, np.nan, np.nan, None)
    section = sections[found % n_phases]
    after = ends_of_dips(section, points[found], cycles, np.array([best]))[0]
    return CriticalDip(osc, cycles, best, found / n_phases, steady_state(section, *after.tolist(), **settling))


def _first_that_leaves(sides: Sides, point: NDArray[np.float64], cycles: int, sizes: NDArray[np.float64]) -> float:
    """The smallest of the changes `sizes`, which grow from 0, that leaves, narrowed down; nan if none does."""
    leaves = ~sides.at_home(ends_of_dips(sides.osc, point, cycles, sizes[1:]))
    if not leaves.any():
        return np.nan
    last = int(np.argmax(leaves))
    within, beyond = sizes[last], sizes[last + 1]
    while abs(beyond - within) > ACCURACY:
        between = np.linspace(within, beyond, CUTS + 2)
        leaves = np.append(~sides.at_home(ends_of_dips(sides.osc, point, cycles, between[1:-1])), True)
        last = int(np.argmax(leaves))
        within, beyond = between[last], between[last + 1]
    return float(beyond)


def ends_of_dips(
    osc: Oscillator, point: NDArray[np.float64], cycles: int, changes: NDArray[np.float64]
) -> NDArray[np.float64]:
    """X and X' (n, 2) after the mean force was changed by each of the shares `changes` (n,) for some mesh periods."""
    dipped = [osc.replace(mean_force=osc.mean_force * (1.0 + each)) for each in changes.tolist()]
    return np.concatenate([forward(each)(point[None], cycles) for each in dipped])
