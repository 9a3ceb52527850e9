"""The settled motion from one start, fully described."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, checked
from gearpair._equality import equal_by_value
from gearpair._flow.states import Settled
from gearpair.motion.impacts import ImpactState, impact_state
from gearpair.motion.names import Motion
from gearpair.motion.settling import ONE, STATUSES, SettleOptions, Status, settle_batch
from gearpair.motion.stability import multipliers_of
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator

SAMPLES = 256  # section points kept of a motion that is not periodic


@equal_by_value
@dataclass(frozen=True)
class SteadyState:
    """A settled motion.

    Attributes
    ----------
    oscillator : Oscillator
    status : Status
        ``"periodic"``, ``"aperiodic"``, ``"unsettled"``, ``"floating"``, ``"escaped"`` or ``"capped"``;
        ``status.remedy`` says what to do.
    lasted : int
        Mesh periods that the motion was followed for; of a periodic one, until it had settled.
    period : int or None
        In base periods (mesh periods, or revolutions with `shaft_orders`); None unless periodic.
    points : ndarray of float, shape (n, 2)
        X and X' on the section, in the order visited: the whole cycle from its smallest X where the motion is periodic,
        `samples` successive points where it stayed bounded, none where not.
    multipliers : ndarray of complex, shape (2,)
        Floquet multipliers of the cycle, the largest modulus first; nan unless periodic.
    x_min, x_max : float
        Extremes of X, at exact roots of X' (dimensionless); over a finite span unless periodic.
    impact_state : ImpactState or None
        None where the motion did not stay bounded.
    lyapunov_exponents : ndarray of float, shape (2,)
        Per unit tau, descending; their sum is ``-2 zeta``, zeta the mean over time where free flight has another.
    exponent_error : float
        Standard error of the largest exponent; 0 for a periodic motion.
    """

    oscillator: Oscillator
    status: Status
    lasted: int
    period: int | None
    points: NDArray[np.float64]
    multipliers: NDArray[np.complex128]
    x_min: float
    x_max: float
    impact_state: ImpactState | None
    lyapunov_exponents: NDArray[np.float64]
    exponent_error: float

    @property
    def motion(self) -> Motion:
        """Its status, period and impact state as one."""
        return Motion(self.status, self.period, self.impact_state)


@checked
def steady_state(
    osc: Oscillator,
    x: float = 1.0,
    v: float = 0.0,
    *,
    samples: int | None = None,
    n_samples: int | None = None,
    **settling: Unpack[SettleOptions],
) -> SteadyState:
    """Follow the motion from (x, v) until it has settled, and describe what it settled on.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        X and X' at the start of a base period.
    samples : int, optional
        Section points kept of a motion that is not periodic: successive ones, so 20 000 draw the section of chaos. They
        take 16 bytes and some 0.4 microseconds each, after the motion has been judged. Of a periodic motion each point
        of the cycle is kept once, whatever this is. 256 when not given.
    n_samples : int, optional
        What sweeps call it; the same as `samples`.
    **settling
        See `SettleOptions`.

    Notes
    -----
    A motion is *periodic* when it enters a certified neighbourhood of a stable orbit, which no motion leaves; where
    none can be certified, when it returns within 1e-8 of itself (relative to max(1, |X|, |X'|)) and the stable orbit
    lies within 1e-6; after the whole transient, also when it approaches a stable orbit within 1e-2. The points and
    multipliers are those of the orbit, exact to rounding.

    A motion that has not settled after `n_transient` is observed for `n_exponent` periods and then watched for
    `n_watch`: chaos in this model may go on for ten thousands of mesh periods and then settle for good. It is
    *aperiodic* when it has not settled even then and its largest Lyapunov exponent exceeds four standard errors, and
    *unsettled* when that is not so: a statement about the `lasted` mesh periods, no more. *Floating* is a motion that
    repeats within the backlash, which has no attractor but a family of such motions.

    With `shaft_orders` the period counts revolutions: a motion of period 1 repeats every revolution, whatever it does
    from tooth to tooth.

    Examples
    --------
    >>> state = steady_state(Oscillator())
    >>> print(state.motion)
    period 2, single-sided

    >>> steady_state(Oscillator(mesh_frequency=1.219), samples=20_000).points.shape
    (20000, 2)
    """
    start = check_start(x, v)
    if samples is not None and n_samples is not None:
        raise ValueError(f"give either samples or n_samples, which are the same, got {samples} and {n_samples}")
    kept = check_count("samples", next((each for each in (samples, n_samples) if each is not None), SAMPLES))
    out = settle_batch([osc], np.array([start]), ONE.having(settling, n_samples=kept).whole_cycles())
    return describe(osc, out, 0, kept)


def describe(osc: Oscillator, out: Settled, i: int, samples: int | None = None) -> SteadyState:
    """Row `i` of the kernels' results in the library's words; with so many points unless periodic."""
    status = STATUSES[out.status[i]]
    period = int(out.period[i]) or None
    bounded = status not in (Status.ESCAPED, Status.CAPPED)
    points = out.points[i] if bounded else out.points[i][:0]
    x_min, x_max = map(float, out.extremes[i])
    return SteadyState(
        oscillator=osc,
        status=status,
        lasted=int(out.lasted[i]),
        period=period,
        points=points[: period or samples].copy(),
        multipliers=multipliers_of(out.monodromy[i]),
        x_min=x_min,
        x_max=x_max,
        impact_state=impact_state(x_min, x_max) if bounded else None,
        lyapunov_exponents=out.exponents[i, :2].copy(),
        exponent_error=float(out.exponents[i, 2]),
    )
