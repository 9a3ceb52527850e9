"""The smallest shock that throws a settled motion out of its basin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Unpack, get_args

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_choice, check_count, check_number, checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations.orbits import PeriodicOrbit
from gearpair.boundaries.sections import at_phase
from gearpair.boundaries.sides import Sides
from gearpair.motion.settling import SettleOptions
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.motion.trajectories import trajectory
from gearpair.oscillator import Oscillator

Kick = Literal["any", "velocity"]
KICKS = get_args(Kick)

SMALLEST = 1e-3  # of the largest kick: where rings of kicks begin
RINGS = 40  # from there on, each larger than the one before by a factor of 1.19; of two directions as many kicks
ROUGH, FINE = 1e-4, 1e-12  # how near the boundary is found, relative to the kick: at every phase, and at the best
SAME_SIZE = 1e-13  # relative to the kick: a turn that gains less than this gains nothing
TURNS = {ROUGH: 1e-2, FINE: 1e-6}  # the smallest turn of the direction, in radians, tried to make a kick smaller


@equal_by_value
@dataclass(frozen=True, repr=False)
class CriticalShock:
    """The smallest kick found that throws a settled motion out of its basin.

    Attributes
    ----------
    oscillator : Oscillator
    size : float
        The length of the kick; inf where none up to the largest leaves the basin.
    kick : ndarray of float, shape (2,)
        The changes of X and X'; nan where there is none.
    phase : float
        When it acts, in mesh periods since the motion was at ``points[0]``; its fraction is the phase of the mesh.
    start : ndarray of float, shape (2,)
        X and X' of the motion just before.
    leads_to : SteadyState or None
        Where the motion settles after a kick that is larger by a billionth, seen from that phase.
    phases, sizes : ndarray of float, shape (n,)
        Every phase that was looked at, and the smallest kick found there, to 1e-4.
    kicks : ndarray of float, shape (n, 2)
        The changes of X and X' there.
    """

    oscillator: Oscillator
    size: float
    kick: NDArray[np.float64]
    phase: float
    start: NDArray[np.float64]
    leads_to: SteadyState | None
    phases: NDArray[np.float64]
    sizes: NDArray[np.float64]
    kicks: NDArray[np.float64]

    def __repr__(self) -> str:
        """One line."""
        if self.leads_to is None:
            return f"no kick of those tried at {len(self.phases)} phases leaves the basin"
        dx, dv = self.kick
        return (
            f"a kick of {self.size:.4g} (X by {dx:.4g}, X' by {dv:.4g}) {self.phase:.4g} mesh periods after the "
            f"section leads to {self.leads_to.motion}"
        )


@checked
def critical_shock(
    osc: Oscillator,
    state: SteadyState | PeriodicOrbit,
    *,
    kick: Kick = "any",
    n_phases: int = 16,
    n_directions: int = 32,
    largest: float = 10.0,
    **settling: Unpack[SettleOptions],
) -> CriticalShock:
    """The smallest sudden change of X and X' after which a settled motion does not come back.

    Parameters
    ----------
    osc : Oscillator
    state : SteadyState or PeriodicOrbit
        A stable periodic motion of `osc`.
    kick : {"any", "velocity"}
        Whether X changes too, or X' alone, as by an impulse.
    n_phases : int
        Phases of the mesh at which the kick may act; a motion of n mesh periods has n times as many moments.
    n_directions : int
        Directions of a kick that are tried first, at least 2; of X' alone there are two, on rings that are nearer.
    largest : float
        The largest kick tried (dimensionless; the length of the change of X, over half the backlash, and X').
    **settling
        See `gearpair.motion.SettleOptions`.

    Raises
    ------
    ValueError
        For a motion that is not periodic and stable, or not of `osc`.

    Notes
    -----
    At each phase rings of kicks are tried, larger and larger, until one leaves. Between it and the ring before, the
    boundary is bisected in each direction that leaves, and the best direction turned until no turn makes the kick
    smaller: at the best phase to 1e-12 of its size. There the kick is at right angles to the boundary. A kick that
    leaves at one phase is, moved on with both motions, one that leaves at the next: so each is tried there, too, once
    round from the best.

    This is the smallest shock *found*. A tongue of another basin that is narrower than the directions and the rings
    (of a ratio of 1.19) are apart may lie nearer; more directions find it. The field calls it the "minimal fatal shock"
    (Halekotte and Feudel, 2020).

    Examples
    --------
    >>> from gearpair import steady_state
    >>> osc = Oscillator()
    >>> critical_shock(osc, steady_state(osc, -2.3365, 1.5426), n_phases=1)
    a kick of 1.461 (X by 0.9157, X' by -1.138) 0 mesh periods after the section leads to period 2, single-sided
    """
    check_choice("kick", kick, KICKS)
    n_phases, n_directions = check_count("n_phases", n_phases), check_count("n_directions", n_directions, at_least=2)
    largest = check_number("largest", largest, above=0.0)
    points = points_over_cycle(osc, state, n_phases)
    phases = np.arange(len(points)) / n_phases
    sections = [at_phase(osc, k / n_phases) for k in range(n_phases * osc.mesh_periods)]
    angles = (
        np.array([0.5, 1.5]) * np.pi if kick == "velocity" else 2.0 * np.pi * np.arange(n_directions) / n_directions
    )
    turn, rings = (0.0, RINGS * n_directions // 2) if kick == "velocity" else (np.pi / n_directions, RINGS)
    radii = largest * SMALLEST ** (1.0 - np.arange(rings + 1) / rings)
    searches = [Search(Sides(sections[k % len(sections)], point, settling), point) for k, point in enumerate(points)]
    kicks = np.array([search.smallest(angles, radii, turn) for search in searches])
    if kick == "any":
        _carry_round(searches, kicks, n_phases, turn)
    sizes = np.hypot(*kicks.T)
    sizes[np.isnan(sizes)] = np.inf
    best = int(np.argmin(sizes))
    if np.isinf(sizes[best]):
        return CriticalShock(osc, np.inf, kicks[best], phases[best], points[best], None, phases, sizes, kicks)
    section = sections[best % len(sections)]
    change = searches[best].refined(kicks[best], turn, FINE)
    beyond = points[best] + (1.0 + 1e-9) * change
    leads_to = steady_state(section, *beyond.tolist(), **settling)
    size = float(np.hypot(*change))
    return CriticalShock(osc, size, change, float(phases[best]), points[best], leads_to, phases, sizes, kicks)


def points_over_cycle(osc: Oscillator, state: SteadyState | PeriodicOrbit, n_phases: int) -> NDArray[np.float64]:
    """X and X' of a stable motion at every phase of its cycle, `n_phases` a mesh period, (n, 2); or a ValueError."""
    stable = state.stable if isinstance(state, PeriodicOrbit) else state.period is not None
    if not stable or state.period is None:
        raise ValueError(f"state must be periodic and stable, got {state.motion or state}")
    if state.oscillator != osc:
        raise ValueError("state must be a motion of the oscillator that is given, got one of another")
    x, v = state.points[0].tolist()
    way = trajectory(osc, x, v, state.period, samples_per_period=n_phases)
    return np.column_stack([way.x, way.v])[:-1]


def _carry_round(searches: list[Search], kicks: NDArray[np.float64], n_phases: int, turn: float) -> None:
    """Try each kick that leaves at the next phase, too, once round from the smallest; keeps what is smaller there."""
    if np.isnan(kicks).all():
        return
    first, n = int(np.nanargmin(np.hypot(*kicks.T))), len(kicks)
    for k in range(first, first + n):
        here, there = k % n, (k + 1) % n
        if np.isnan(kicks[here, 0]):
            continue
        carried = searches[here].carried(kicks[here], n_phases) - searches[there].point
        if not searches[there].leaves(carried):  # so near the boundary that rounding took it back
            continue
        found = searches[there].refined(carried, turn, ROUGH)
        if not np.hypot(*kicks[there]) <= np.hypot(*found):
            kicks[there] = found


class Search:
    """The search for the smallest kick from one point of a motion."""

    def __init__(self, sides: Sides, point: NDArray[np.float64]) -> None:
        self._sides, self.point = sides, point

    def leaves(self, kick: NDArray[np.float64]) -> bool:
        """Whether the motion does not come back after a kick."""
        return not self._sides.at_home((self.point + kick)[None])[0]

    def carried(self, kick: NDArray[np.float64], n_phases: int) -> NDArray[np.float64]:
        """X and X' (2,) at the next of as many phases of a mesh period, after a kick."""
        x, v = (self.point + kick).tolist()
        way = trajectory(self._sides.osc, x, v, 1, samples_per_period=n_phases)
        return np.array([way.x[1], way.v[1]])

    def smallest(self, angles: NDArray[np.float64], radii: NDArray[np.float64], turn: float) -> NDArray[np.float64]:
        """The smallest kick (2,) that leaves, roughly; nan where none of the rings has one."""
        directions = np.column_stack([np.cos(angles), np.sin(angles)])
        before = 0.0
        for radius in radii.tolist():
            stays = self._sides.at_home(self.point + radius * directions)
            if not stays.all():
                found = [self._cut(radius * each, before / radius, ROUGH) for each in directions[~stays]]
                return self.refined(min(found, key=lambda each: float(np.hypot(*each))), turn, ROUGH)
            before = radius
        return np.full(2, np.nan)

    def refined(self, kick: NDArray[np.float64], turn: float, accuracy: float) -> NDArray[np.float64]:
        """`kick`, which leaves, turned and shortened until no turn makes it smaller."""
        kick = self._cut(kick, 1.0 - 10.0 * ROUGH, accuracy)
        while turn >= TURNS[accuracy]:
            both = np.array([_turned(kick, turn), _turned(kick, -turn)]) * (1.0 - max(SAME_SIZE, 0.1 * turn * accuracy))
            leaves = ~self._sides.at_home(self.point + both)
            if leaves.any():
                kick = self._cut(both[int(np.argmax(leaves))], 0.0, accuracy)
            else:
                turn *= 0.5
        return kick

    def _cut(self, kick: NDArray[np.float64], share: float, accuracy: float) -> NDArray[np.float64]:
        """`kick`, which leaves, shortened to where it just does; a `share` of it should not, or nothing is tried."""
        inner = self.point + share * kick
        if share > 0.0 and not self._sides.at_home(inner[None])[0]:
            inner = self.point
        size = float(np.hypot(*kick))
        _within, beyond = self._sides.narrowed(inner, self.point + kick, accuracy * size)
        return beyond - self.point


def _turned(kick: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * kick[0] - s * kick[1], s * kick[0] + c * kick[1]])
