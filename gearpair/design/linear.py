"""The answer without backlash: the linear, time-invariant response of a drive."""

from dataclasses import dataclass

import numpy as np

from gearpair._checks import checked
from gearpair.oscillator import Oscillator

# Over a mesh period, with half as many harmonics; of a base period of many as few as hold the highest order.
N_SAMPLES, FEWEST, MOST_IN_ALL = 4096, 512, 2**17


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


@checked
def linear_response(osc: Oscillator) -> LinearResponse:
    """The forced vibration about the static deflection, teeth always in contact and mean stiffness.

    Notes
    -----
    With ``Y = X - 1`` (X + 1 for a negative mean force) and the stiffness ``k = k_0 + k_1(tau)``,

        Y'' + 2 zeta Y' + k_0 Y = F(tau) - k_1(tau) F_m / k_0,

    F the oscillator's force: the variation of the stiffness acts on the static deflection alone. Each harmonic is then
    divided by ``k_0 - n^2 Omega^2 + 2 i n zeta Omega``; the force is ``k_0 Y + k_1 F_m / k_0``, to first order too.
    This is the linear time-invariant model that standards and most design tools rest on (Özgüven and Houser, 1988).

    Examples
    --------
    >>> from gearpair.stiffness import StiffnessWave
    >>> osc = Oscillator(mesh_frequency=1.0, mean_force=0.1, error_amplitude=0.002, damping_ratio=0.05,
    ...     stiffness=StiffnessWave((0.0,), (1.0,)))
    >>> round(linear_response(osc).load_factor, 9)  # 1 + 0.002 / 0.1 / (2 zeta)
    1.2
    """
    mean, omega, whole = osc.stiffness.mean, osc.mesh_frequency, osc.mesh_periods
    per_mesh = max(FEWEST, min(N_SAMPLES, MOST_IN_ALL // whole // 2 * 2))
    n_samples = per_mesh * whole
    order = np.arange(n_samples // 2) / whole
    wave = np.zeros(len(order), complex)
    wave[::whole] = osc.stiffness.harmonics(per_mesh // 2 - 1)
    wave[0] = 0.0
    force, error = np.zeros(len(order), complex), np.zeros(len(order), complex)
    for n, amplitude, phase in osc.error_lines:
        part, line = -0.5j * amplitude * np.exp(1j * phase), round(n * whole)
        error[line] += part
        force[line] += part * (n * omega) ** 2
    static = osc.mean_force / mean
    response = (force - wave * static) / (mean - (order * omega) ** 2 + 2j * osc.damping_ratio * order * omega)
    response[0] = 0.0
    moved = np.fft.irfft(response + error, n_samples, norm="forward")
    vibration = np.fft.irfft(response, n_samples, norm="forward")
    stiffness = osc.stiffness(
        np.arange(n_samples) % per_mesh / per_mesh
    )  # itself: its series would overshoot at the steps
    mesh_force = osc.mean_force + mean * vibration + (stiffness - mean) * static
    sign = 1.0 if osc.mean_force >= 0.0 else -1.0
    largest, smallest = float((sign * mesh_force).max()), float((sign * mesh_force).min())
    return LinearResponse(
        x_rms=float(np.sqrt(np.mean(moved**2))),
        peak_to_peak=float(np.ptp(moved)),
        largest_force=largest,
        smallest_force=smallest,
        load_factor=largest / abs(osc.mean_force) if osc.mean_force else np.nan,
    )
