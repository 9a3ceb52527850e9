"""The answer without backlash: the linear, time-invariant response of a drive."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearpair.oscillator import Oscillator

N_HARMONICS = 60
N_SAMPLES = 1024  # over the mesh period


@dataclass(frozen=True)
class LinearResponse:
    """The forced vibration of the linear, time-invariant model; dimensionless.

    Attributes
    ----------
    x_rms, peak_to_peak : float
        Of the dynamic transmission error X + e about its mean, in units of half the backlash.
    largest_force, smallest_force : float
        Of the mesh force, in units of b_h k_m.
    load_factor : float
        The largest mesh force over the mean force; nan without a mean force.
    """

    x_rms: float
    peak_to_peak: float
    largest_force: float
    smallest_force: float
    load_factor: float

    @property
    def keeps_contact(self) -> bool:
        """Whether the force stays positive, as the model takes for granted."""
        return self.smallest_force > 0.0


def linear_response(osc: Oscillator) -> LinearResponse:
    """The forced vibration about the static deflection, teeth always in contact and mean stiffness.

    Parameters
    ----------
    osc : Oscillator

    Returns
    -------
    LinearResponse

    Notes
    -----
    With ``Y = X - 1`` (X + 1 for a negative mean force) and the stiffness ``k = k_0 + k_1(tau)``,

        Y'' + 2 zeta Y' + k_0 Y = F(tau) - k_1(tau) F_m / k_0,

    F the oscillator's force: the variation of the stiffness acts on the static deflection alone. Each harmonic is then
    divided by ``k_0 - n^2 Omega^2 + 2 i n zeta Omega``; the force is ``k_0 Y + k_1 F_m / k_0``, to the same first order.
    This is the linear time-invariant model that standards and most design tools rest on (Özgüven and Houser, 1988).

    Examples
    --------
    >>> slow = linear_response(Oscillator(mesh_frequency=0.01, error_amplitude=0.0))
    >>> round(slow.load_factor, 2)
    1.0
    """
    mean, omega = osc.stiffness.mean, osc.mesh_frequency
    order = np.arange(N_HARMONICS + 1)
    wave = osc.stiffness.harmonics(N_HARMONICS)
    wave[0] = 0.0
    force, error = np.zeros(len(order), complex), np.zeros(len(order), complex)
    highest = max([1, *(each.order for each in osc.harmonics)])
    if highest > N_HARMONICS:
        raise ValueError(f"harmonics must be of orders up to {N_HARMONICS} here, got {highest}")
    for n, amplitude, phase in ((1, osc.error_amplitude, osc.error_phase), *osc.harmonics):
        part = -0.5j * amplitude * np.exp(1j * phase)
        error[n] += part
        force[n] += part * (n * omega) ** 2
    static = osc.mean_force / mean
    response = (force - wave * static) / (mean - (order * omega) ** 2 + 2j * osc.damping_ratio * order * omega)
    response[0] = 0.0
    turn = np.exp(2j * np.pi * np.outer(np.arange(N_SAMPLES) / N_SAMPLES, order))
    moved = 2.0 * (turn @ (response + error)).real
    mesh_force = osc.mean_force + 2.0 * (turn @ (mean * response + wave * static)).real
    sign = 1.0 if osc.mean_force >= 0.0 else -1.0
    largest, smallest = float((sign * mesh_force).max()), float((sign * mesh_force).min())
    return LinearResponse(
        x_rms=float(np.sqrt(np.mean(moved**2))),
        peak_to_peak=float(np.ptp(moved)),
        largest_force=largest,
        smallest_force=smallest,
        load_factor=largest / abs(osc.mean_force) if osc.mean_force else np.nan,
    )
