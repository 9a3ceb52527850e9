"""The spectrum of a sampled motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_number, checked, shown
from gearpair._equality import equal_by_value
from gearpair.motion.trajectories import Trajectory


@equal_by_value
@dataclass(frozen=True)
class Spectrum:
    """One-sided amplitude spectrum of X; both arrays have shape (n,).

    Attributes
    ----------
    frequency : ndarray of float
        In units of the mesh frequency: 1 is the mesh frequency, 1/2 its first subharmonic.
    amplitude : ndarray of float
        Amplitude of X (dimensionless, units of b_h); the mean of X at frequency 0.
    """

    frequency: NDArray[np.float64]
    amplitude: NDArray[np.float64]

    def line(self, frequency: float) -> float:
        """The amplitude at the sampled frequency nearest to `frequency` (units of the mesh frequency)."""
        return float(self.amplitude[np.argmin(np.abs(self.frequency - check_number("frequency", frequency)))])


@checked
def spectrum(trajectory: Trajectory, *, window: str | tuple[Any, ...] = "boxcar") -> Spectrum:
    """Amplitude spectrum of X by the discrete Fourier transform.

    Parameters
    ----------
    trajectory : Trajectory
        Whole base periods, as `gearpair.trajectory` gives them; the end point, which repeats the phase of
        the start, is left out.
    window : str or tuple
        A window of `scipy.signal.get_window`, scaled so that a line keeps its amplitude. The default
        is exact for a periodic motion when the number of base periods is a multiple of its period;
        ``"hann"`` suits aperiodic motions.

    Returns
    -------
    Spectrum
        Frequencies at multiples of ``1 / n`` for n mesh periods.

    Notes
    -----
    With `shaft_orders` the base period is a revolution; the unit stays the mesh frequency. An error of a shaft with z
    teeth then shows at ``1 / z``, and as sidebands at ``1 - 1 / z`` and ``1 + 1 / z``.

    Examples
    --------
    >>> from gearpair import Oscillator, trajectory
    >>> motion = trajectory(Oscillator(), 1.0, 0.0, 8, n_transient=500)
    >>> lines = spectrum(motion)
    >>> bool(lines.line(0.5) > 1e-3 > 1e-9 > lines.line(0.25))
    True
    """
    from scipy.signal import get_window  # here, so that importing gearpair stays quick

    x = trajectory.x[:-1]
    try:
        if not isinstance(window, (str, tuple)):  # of a number scipy would make a Kaiser window
            raise ValueError
        weights = get_window(window, len(x))
    except ValueError:
        raise ValueError(f"window must be one of scipy.signal.get_window, as 'boxcar', got {shown(window)}") from None
    amplitude = np.abs(np.fft.rfft(x * weights)) / weights.sum()
    amplitude[1 : (len(x) + 1) // 2] *= 2.0
    frequency = np.linspace(0.0, len(amplitude) - 1.0, len(amplitude)) * trajectory.samples_per_period / len(x)
    return Spectrum(frequency, amplitude)
