"""The edge state: the motion that stays on the boundary between two basins."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count, checked
from gearpair._equality import equal_by_value
from gearpair.bifurcations.orbits import PeriodicOrbit, periodic_orbit
from gearpair.boundaries.sections import forward
from gearpair.boundaries.sides import Sides, start_of
from gearpair.motion.outcome import Outcome
from gearpair.motion.settling import MANY, SettleOptions
from gearpair.motion.steady import SteadyState, steady_state
from gearpair.oscillator import Oscillator

# The two motions that hold the boundary between them start CLOSE together, relative to max(1, |X|, |X'|), and are
# brought together again before they are further APART.
CLOSE, APART = 1e-13, 1e-7
# The boundary's motion repeats where it returns as near as that; the orbit is then nearer to it than NEAR.
RETURNED, NEAR = 1e-6, 1e-4


class EdgeStatus(Outcome):
    """What was found on the boundary: a string, with a `remedy` that says what a user may do."""

    PERIODIC = "periodic", "the motion on the boundary approaches a periodic orbit, a saddle"
    UNSETTLED = (
        "unsettled",
        "the motion on the boundary did not repeat in the `tracked` mesh periods: it approaches an orbit slowly or of "
        "a longer period, or is chaotic itself; raise n_periods or max_period to look longer",
    )


@equal_by_value
@dataclass(frozen=True, repr=False)
class EdgeState:
    """What the boundary between two motions leads to.

    Attributes
    ----------
    oscillator : Oscillator
    status : EdgeStatus
        ``"periodic"`` or ``"unsettled"``; ``status.remedy`` says what to do.
    orbit : PeriodicOrbit or None
        The saddle, exact to rounding; None unless periodic.
    tracked : int
        Base periods that the boundary was followed for.
    points : ndarray of float, shape (tracked + 1, 2)
        X and X' on the section, from the boundary between the two starts on, each within 1e-7 of the boundary.
    exponent : float
        Rate at which the motions on either side part, per unit tau: of the orbit where there is one, else the mean over
        the later half of what was tracked.
    sides : tuple of SteadyState
        Where the motions settle on the side of `a` and beyond the boundary.
    """

    oscillator: Oscillator
    status: EdgeStatus
    orbit: PeriodicOrbit | None
    tracked: int
    points: NDArray[np.float64]
    exponent: float
    sides: tuple[SteadyState, SteadyState]

    def __repr__(self) -> str:
        """One line."""
        between = " and ".join(str(side.motion) for side in self.sides)
        found = "no periodic orbit" if self.orbit is None else repr(self.orbit)
        mesh_periods = self.tracked * self.oscillator.mesh_periods
        return f"between {between}, after {mesh_periods} mesh periods: {found}"


@checked
def edge_state(
    osc: Oscillator,
    a: ArrayLike | SteadyState | PeriodicOrbit,
    b: ArrayLike | SteadyState | PeriodicOrbit,
    *,
    n_periods: int = 1000,
    **settling: Unpack[SettleOptions],
) -> EdgeState:
    """The motion on the boundary of the basin of `a` that is found between `a` and `b`: the edge state.

    Parameters
    ----------
    osc : Oscillator
    a, b : array_like of float, shape (2,), or SteadyState or PeriodicOrbit
        X and X' of two starts that settle on different motions, or two such motions.
    n_periods : int
        Base periods at most that the boundary is followed for.
    **settling
        See `gearpair.motion.SettleOptions`; `max_period` is that of the boundary's motion too.

    Raises
    ------
    ValueError
        Where both starts settle on the same motion; for a motion of another oscillator.

    Notes
    -----
    Edge tracking (Skufca, Yorke and Eckhardt, 2006): the segment from `a` to `b` is bisected until two starts are as
    near as rounding allows, one of which settles where `a` does and the other not. Both are followed; before they are
    1e-7 apart they are brought together again on the segment between them. So they stay on the boundary, though every
    single motion leaves it. Where they repeat within 1e-6, Newton's method finds the orbit, with its multipliers.

    Each motion that is not captured by a periodic attractor counts as one of chaos; those that escape count as one.
    Between two starts there may be several boundaries, if the basins are intertwined or of more than two motions; this
    is the first from `a` that the bisection sees, and what is beyond it is ``sides[1]``, not always the motion of `b`.
    With `a` and `b` exchanged it is a boundary of the other basin, and may be another one.

    Examples
    --------
    >>> edge_state(Oscillator(), (-2.3365, 1.5426), (0.34629, -0.25625)).orbit
    unstable orbit of period 1, double, through X = -1.5688, X' = -1.0135: multipliers 3.261 and 0.2142
    """
    n_periods = check_count("n_periods", n_periods)
    max_period = MANY.having(settling).max_period
    within, beyond = start_of("a", a, osc), start_of("b", b, osc)
    sides = Sides(osc, within, settling)
    if sides.at_home(beyond[None])[0]:
        motion = steady_state(osc, *within.tolist(), **settling).motion
        raise ValueError(f"a and b must settle on different motions, got {motion} from both")
    step = forward(osc)
    points, rates, orbit = [], np.zeros(n_periods), None
    for done in range(n_periods + 1):
        scale = max(1.0, float(np.abs(within).max()))
        distance = float(np.hypot(*(beyond - within)))
        if done == 0 or distance > APART * scale:
            within, beyond = sides.narrowed(within, beyond, CLOSE * scale)
            distance = float(np.hypot(*(beyond - within)))
        points.append(within)
        orbit = _repeated(osc, points, max_period)
        if orbit is not None or done == n_periods:
            break
        within, beyond = step(np.array([within, beyond]), 1)
        rates[done] = np.log(float(np.hypot(*(beyond - within))) / distance) / osc.period
    found = tuple(steady_state(osc, *side.tolist(), **settling) for side in (within, beyond))
    if orbit is None:
        exponent = float(rates[done // 2 : done].mean())
    else:
        assert orbit.multipliers is not None  # it has converged
        exponent = float(np.log(np.abs(orbit.multipliers[0])) / (orbit.period * osc.period))
    status = EdgeStatus.UNSETTLED if orbit is None else EdgeStatus.PERIODIC
    return EdgeState(osc, status, orbit, done, np.array(points), exponent, (found[0], found[1]))


def _repeated(osc: Oscillator, points: list[NDArray[np.float64]], max_period: int) -> PeriodicOrbit | None:
    """The unstable orbit that the last of `points` are on, if they repeat."""
    last = points[-1]
    before = np.array(points[-2 : -max_period - 2 : -1])
    scale = max(1.0, float(np.abs(last).max()))
    for k in np.flatnonzero(np.abs(before - last).max(axis=1) <= RETURNED * scale).tolist() if len(before) else ():
        orbit = periodic_orbit(osc, float(last[0]), float(last[1]), k + 1)
        if orbit.converged and not orbit.stable and np.abs(orbit.points - last).max(axis=1).min() <= NEAR * scale:
            return orbit
    return None
