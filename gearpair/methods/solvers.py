"""The integrators of scipy: the article's way to a motion, for comparison."""

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_choice, check_count, check_number, checked
from gearpair.motion.trajectories import Impacts, Trajectory, check_start
from gearpair.oscillator import Oscillator

METHODS = ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")


@checked
def integrated_trajectory(
    osc: Oscillator,
    x: float,
    v: float,
    n_periods: int,
    *,
    method: str = "RK45",
    n_transient: int = 0,
    samples_per_period: int = 128,
    rtol: float = 1e-3,
    atol: float = 1e-6,
) -> Trajectory:
    """The motion from (x, v) as an integrator of `scipy.integrate.solve_ivp` draws it.

    It integrates the whole span at once and crosses the discontinuities as it finds them: the article's way.

    Parameters
    ----------
    osc, x, v, n_periods, n_transient, samples_per_period
        As in `gearpair.trajectory`.
    method : {"RK45", "RK23", "DOP853", "Radau", "BDF", "LSODA"}
    rtol, atol : float
        The tolerances; scipy's defaults.

    Returns
    -------
    Trajectory

    Raises
    ------
    RuntimeError
        Where the integrator fails.

    Examples
    --------
    >>> motion = integrated_trajectory(Oscillator(), 1.0, 0.0, 2, rtol=1e-9, atol=1e-9)
    >>> motion.method, motion.x.shape
    ('RK45', (257,))
    """
    from scipy.integrate import solve_ivp  # here, so that importing gearpair stays quick

    x, v = check_start(x, v)
    n_periods = check_count("n_periods", n_periods)
    n_transient = check_count("n_transient", n_transient, at_least=0)
    samples_per_period = check_count("samples_per_period", samples_per_period)
    check_choice("method", method, METHODS)
    check_number("rtol", rtol, above=0.0)
    check_number("atol", atol, above=0.0)
    wave, omega = osc.stiffness, osc.mesh_frequency
    contact_damping, flight_damping = osc.damping_ratio, osc.damping_in_flight
    amplitude = osc.error_amplitude * omega**2
    higher = [(size * (order * omega) ** 2, order * omega, phase) for order, size, phase in osc.error_lines[1:]]

    def slope(tau: float, y: NDArray[np.float64]) -> tuple[float, float]:
        x, v = y
        gap = x - 1.0 if x > 1.0 else x + 1.0 if x < -1.0 else 0.0
        stiffness, zeta = (wave(tau / osc.mesh_period), contact_damping) if gap else (0.0, flight_damping)
        force = osc.mean_force + amplitude * np.sin(omega * tau + osc.error_phase)
        for size, rate, phase in higher:
            force += size * np.sin(rate * tau + phase)
        return v, force - 2.0 * zeta * v - stiffness * gap

    begin, end = n_transient * osc.period, (n_transient + n_periods) * osc.period
    crossings = [lambda tau, y: y[0] - 1.0, lambda tau, y: y[0] + 1.0]
    times = np.linspace(begin, end, n_periods * osc.mesh_periods * samples_per_period + 1)
    solution = solve_ivp(slope, (0.0, end), (x, v), method=method, t_eval=times, rtol=rtol, atol=atol, events=crossings)
    if not solution.success:
        raise RuntimeError(f"{method} failed: {solution.message}")
    rows = [
        (tau - begin, side, y[1], float(y[1] * side > 0.0))
        for side, taus, states in zip((1, -1), solution.t_events, solution.y_events, strict=True)
        for tau, y in zip(taus, states, strict=True)
        if tau >= begin
    ]
    found = np.array(sorted(rows)).reshape(-1, 4)
    impacts = Impacts(found[:, 0], found[:, 1].astype(int), found[:, 2], found[:, 3] == 1.0)
    tau = np.linspace(0.0, n_periods * osc.period, len(times))
    return Trajectory(osc, tau, solution.y[0], solution.y[1], impacts, samples_per_period, method)
