"""How hard and how often the teeth of a steady motion strike, exact from its events and its closed form."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_count, checked
from gearpair._cores import aside
from gearpair._equality import equal_by_value
from gearpair._flow import measures as at
from gearpair._flow.closed_form import TERMS
from gearpair._flow.observe import measure
from gearpair._flow.walk import OK
from gearpair.motion.settling import Status
from gearpair.motion.steady import SteadyState
from gearpair.motion.trajectories import WATCHED


@equal_by_value
@dataclass(frozen=True, kw_only=True)
class ImpactMeasures:
    """What the teeth of a steady motion bear; all dimensionless.

    Attributes
    ----------
    drive_impacts, coast_impacts : float
        Contacts made per mesh period, on each flank.
    drive_velocity, coast_velocity : float
        The largest approach speed |X'| at a contact; 0 where there is none.
    drive_velocity_mean, coast_velocity_mean : float
        Its mean over the contacts; nan where there is none.
    drive_impulse, coast_impulse : float
        The integral of the mesh force's modulus k |f(X)| over contact, per mesh period. Their difference is
        ``F_m T`` in a periodic motion.
    drive_share, coast_share, flight_share : float
        Shares of the time in drive-side contact, in coast-side contact, and apart; their sum is 1.
    drive_force, coast_force : float
        The largest modulus of the mesh force k f(X) on each flank.
    load_factor : float
        Dynamic load factor: the largest mesh force over the mean force, ``drive_force / |F_m|`` or
        ``coast_force / |F_m|``, whichever is larger; nan without a mean force.
    x_mean, x_rms, peak_to_peak : float
        Mean of X, root mean square of X about it, and ``x_max - x_min``.
    """

    drive_impacts: float
    coast_impacts: float
    drive_velocity: float
    coast_velocity: float
    drive_velocity_mean: float
    coast_velocity_mean: float
    drive_impulse: float
    coast_impulse: float
    drive_share: float
    coast_share: float
    flight_share: float
    drive_force: float
    coast_force: float
    load_factor: float
    x_mean: float
    x_rms: float
    peak_to_peak: float


MEASURES = tuple(field.name for field in fields(ImpactMeasures))


@checked
def impact_measures(state: SteadyState, *, n_periods: int = 2000) -> ImpactMeasures:
    """Blows, forces and displacements of a steady motion that stayed bounded.

    A periodic one is measured over its cycle, any other over `n_periods` mesh periods, in whole base periods.

    Notes
    -----
    Every contact is an event of the exact flow, so counts, times and velocities are those of the motion itself. Between
    events X is a power series of degree 15: the largest force of each stretch of contact is at a root of X', at an
    event or at a switch of the stiffness, and Gauss and Legendre's rule with 16 nodes integrates X and X^2 exactly.

    The root mean square about the mean is what experiments on gear pairs report (Kahraman and Blankenship, 1997), the
    ratio of the largest to the mean mesh force their dynamic load factor.

    Examples
    --------
    >>> from gearpair.motion import steady_state
    >>> from gearpair.oscillator import Oscillator
    >>> measures = impact_measures(steady_state(Oscillator()))
    >>> measures.drive_impacts, measures.coast_impacts
    (1.0, 0.0)
    """
    if state.status in (Status.ESCAPED, Status.CAPPED):
        raise ValueError(f"only a motion that stays bounded has impact measures, got one with status {state.status!r}")
    n_periods = check_count("n_periods", n_periods)
    row = np.empty(at.N_MEASURES)
    x, v = map(float, state.points[0])
    osc = state.oscillator
    span = state.period or osc.base_periods(n_periods)
    status = aside(measure, osc.cells, x, v, span, np.empty(TERMS), row, periods=span * osc.mesh_periods * WATCHED)
    assert status == OK, "the same motion stayed bounded while it settled"
    columns = measure_columns(row[np.newaxis], np.array([osc.mean_force]))
    return ImpactMeasures(**{name: float(column[0]) for name, column in columns.items()})


def measure_columns(rows: NDArray[np.float64], mean_forces: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """The kernel's rows (n, `at.N_MEASURES`) by the names of `ImpactMeasures`, each of shape (n,).

    `mean_forces` (n,) are those of the rows' oscillators.
    """
    columns = {}
    for i, side in enumerate(("drive", "coast")):
        columns[f"{side}_impacts"] = rows[:, at.IMPACTS + i]
        columns[f"{side}_velocity"] = rows[:, at.VELOCITY + i]
        columns[f"{side}_velocity_mean"] = _ratio(rows[:, at.VELOCITY_SUM + i], rows[:, at.IMPACTS + i])
        columns[f"{side}_impulse"] = rows[:, at.IMPULSE + i]
        columns[f"{side}_share"] = rows[:, at.SHARE + i]
        columns[f"{side}_force"] = rows[:, at.FORCE + i]
    apart = (rows[:, at.LOWEST] < 1.0) & (rows[:, at.HIGHEST] > -1.0)  # else rounding would pass for flight
    flight = np.clip(1.0 - columns["drive_share"] - columns["coast_share"], 0.0, 1.0)
    columns["flight_share"] = np.where(apart, flight, 0.0)
    columns["load_factor"] = _ratio(np.maximum(columns["drive_force"], columns["coast_force"]), np.abs(mean_forces))
    columns["x_mean"], columns["x_rms"] = rows[:, at.MEAN], rows[:, at.RMS]
    columns["peak_to_peak"] = rows[:, at.HIGHEST] - rows[:, at.LOWEST]
    return {name: columns[name] for name in MEASURES}


def _ratio(above: NDArray[np.float64], below: NDArray[np.float64]) -> NDArray[np.float64]:
    """Nan where there is nothing to divide by."""
    return np.divide(above, below, out=np.full_like(above, np.nan), where=below != 0.0)
