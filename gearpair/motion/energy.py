"""What puts energy into a motion and what takes it out, exact from the closed form of its segments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, checked
from gearpair._equality import equal_by_value
from gearpair._flow.closed_form import TERMS
from gearpair._flow.measures import NODES, WEIGHTS
from gearpair._flow.records import CROSSING, REGION, REST, SPAN, STARTS
from gearpair.motion.trajectories import check_start, segment_rows
from gearpair.oscillator import Oscillator

Array = NDArray[np.float64]
AT_ONCE = 1000  # mesh periods whose segments are listed together


@equal_by_value
@dataclass(frozen=True)
class EnergyBalance:
    """Energy and work of a motion, mesh period by mesh period; all dimensionless, in units of ``k_m b_h^2``.

    Parameters
    ----------
    oscillator : Oscillator
    energy : ndarray, shape (n + 1,)
        ``X'^2 / 2 + k f(X)^2 / 2`` at the start of each mesh period, after the switch of k there, and at the end.
    stiffness_work : ndarray, shape (n,)
        Of the switches of k: ``(k_after - k_before) f(X)^2 / 2``, summed. That of the end of a mesh period counts.
    mean_force_work : ndarray, shape (n,)
        ``F_m`` times the change of X.
    error_work : ndarray, shape (n,)
        Of the transmission error's inertia force, the sinusoids of `Oscillator.force`.
    damping_loss : ndarray, shape (n,)
        What the damper takes, ``2 zeta X'^2`` over time, with the damping ratio of contact or of free flight; at least
        0.
    """

    oscillator: Oscillator
    energy: Array
    stiffness_work: Array
    mean_force_work: Array
    error_work: Array
    damping_loss: Array

    @property
    def remainder(self) -> Array:
        """The change of energy less all works, shape (n,): rounding, and nothing else."""
        supplied = self.stiffness_work + self.mean_force_work + self.error_work - self.damping_loss
        return np.asarray(np.diff(self.energy) - supplied)


@checked
def energy_balance(osc: Oscillator, x: float, v: float, n_periods: int = 1) -> EnergyBalance:
    """Where the energy of a motion comes from and where it goes.

    Parameters
    ----------
    osc : Oscillator
    x, v : float
        X and X' at the start of a base period.
    n_periods : int
        Base periods to follow, at least 1: mesh periods, or revolutions with `shaft_orders`.

    Raises
    ------
    RuntimeError
        Where the motion escapes to infinity or the walk is capped.

    Notes
    -----
    With ``E = X'^2 / 2 + k f(X)^2 / 2`` the equation of motion gives, between two switches of k,
    ``E' = F_m X' + P(tau) X' - 2 zeta X'^2``, P the inertia force of the transmission error; a switch adds half its
    jump times the squared deflection. Gauss and Legendre's rule with 16 nodes integrates the square of a segment's
    power series exactly and its product with a sinusoid, which turns by 0.6 at most, to rounding.

    A motor that turns the gears past the switch does not feel that work in this equation: it comes from the clock of
    k(tau). Oh, Grosh and Barber (2005) derive equations of both rotors in which it does.

    Examples
    --------
    >>> from gearpair.motion import steady_state
    >>> state = steady_state(Oscillator())
    >>> balance = energy_balance(state.oscillator, *state.points[0], state.period)
    >>> bool(abs(balance.remainder).max() < 1e-14)
    True
    """
    x, v = check_start(x, v)
    n_periods = check_count("n_periods", n_periods)
    at_once = max(1, AT_ONCE // osc.mesh_periods)
    states, works = [], []
    for done in range(0, n_periods, at_once):
        rows, after = segment_rows(osc, x, v, min(at_once, n_periods - done))
        found = _accounts(osc, rows)
        states.append(found[0])
        works.append(found[1])
        x, v = after
    xs, vs = np.concatenate([*states, [(x, v)]]).T
    energy = vs**2 / 2.0 + osc.stiffness(0.0) * (xs - np.clip(xs, -1.0, 1.0)) ** 2 / 2.0
    return EnergyBalance(osc, energy, *np.concatenate(works, axis=1))


def _accounts(osc: Oscillator, rows: Array) -> tuple[Array, Array]:
    """The state at the start of each mesh period that begins in `rows`, (n, 2), and the four works in each, (4, n)."""
    starts, span = rows[:, STARTS] * osc.mesh_periods, rows[:, SPAN] * osc.mesh_periods  # in mesh periods
    ends = np.where(rows[:, CROSSING] < 0.0, rows[:, REST], rows[:, CROSSING])  # in spans, as the series
    series, width = rows[:, CROSSING + 1 :], span * osc.mesh_period
    middle = starts + (rows[:, REST] - 0.5) * span  # of the cell, which has one k and lies in one mesh period

    places, weights = ends[:, None] * (NODES + 1.0) / 2.0, ends[:, None] * WEIGHTS / 2.0
    slopes = _sums(series[:, 1:] * np.arange(1, TERMS), places)  # of X, over the span
    inertia = osc.force(starts[:, None] * osc.mesh_period + places * width[:, None]) - osc.mean_force
    zeta = np.where(rows[:, REGION] == 0.0, osc.damping_in_flight, osc.damping_ratio)
    first, last = series[:, 0], _sums(series, ends[:, None])[:, 0]
    k = np.append(osc.stiffness(middle), osc.stiffness(0.0))
    works = [
        np.diff(k) * (last - np.clip(last, -1.0, 1.0)) ** 2 / 2.0,
        osc.mean_force * (last - first),
        np.sum(weights * inertia * slopes, axis=1),
        2.0 * zeta / width * np.sum(weights * slopes**2, axis=1),
    ]
    begins = np.searchsorted(middle, np.arange(round(starts[-1] + 0.5)))
    states = np.column_stack([first[begins], series[begins, 1] / width[begins]])
    return states, np.add.reduceat(works, begins, axis=1)


def _sums(series: Array, places: Array) -> Array:
    """Power series (n, terms) at places (n, m), by Horner's rule."""
    total = np.zeros_like(places)
    for coefficients in series.T[::-1]:
        total = total * places + coefficients[:, None]
    return total
