"""The mesh force as sound: what the teeth of a drive do, at its own speed, for the ear."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_array, check_class, check_count, check_number, checked, shown
from gearpair._equality import equal_by_value
from gearpair.design.loads import sampled_force_n
from gearpair.drive import GearDrive
from gearpair.motion.settling import Status
from gearpair.motion.steady import SteadyState
from gearpair.motion.trajectories import trajectory

if TYPE_CHECKING:
    import xarray as xr

RATE = 44_100  # samples a second
OVER = 4  # as many times finer is the force sampled, before what the rate cannot hold is filtered out
# Of the filter before that, which falls from 46 % of the rate on, to less than a thousandth at half of it.
TAPS = 128 * OVER
FASTEST = 192_000  # samples a second
FEWEST = 16  # samples of a mesh period, of a passage
FADE = 0.06  # seconds, at both ends
LOUD = 4.0  # mean forces: what stands for full scale


@equal_by_value
@dataclass(frozen=True, repr=False)
class Sound:
    """A mesh force as sound.

    Attributes
    ----------
    samples : ndarray of float, shape (n,)
        The force less its mean, over `full_scale_n`; within [-1, 1].
    rate : int
        Samples a second.
    full_scale_n : float
        The force (N) that 1 stands for. Sounds of one full scale can be compared.
    """

    samples: NDArray[np.float64]
    rate: int
    full_scale_n: float

    def __post_init__(self) -> None:
        check_count("rate", self.rate)
        check_number("full_scale_n", self.full_scale_n, above=0.0)
        samples = check_array("samples", self.samples, ndim=1)
        if not len(samples) or np.abs(samples).max() > 1.0:
            raise ValueError("samples must be numbers from -1 to 1, one at least: full_scale_n is what 1 stands for")

    def __repr__(self) -> str:
        """One line."""
        return f"a sound of {self.seconds:.3g} s, peak {self.peak:.3g} of {self.full_scale_n:.4g} N"

    @property
    def seconds(self) -> float:
        """How long it is."""
        return len(self.samples) / self.rate

    @property
    def peak(self) -> float:
        """The largest modulus of the samples."""
        return float(np.abs(self.samples).max())


@checked
def sound(
    drive: GearDrive,
    motion: SteadyState | xr.Dataset,
    seconds: float | None = None,
    *,
    full_scale_n: float | None = None,
    rate: int = RATE,
) -> Sound:
    """The mesh force of a motion or of a passage at the drive's real speed, as sound.

    Parameters
    ----------
    drive : GearDrive
        That the motion is scaled with.
    motion : SteadyState or xarray.Dataset
        A settled motion of the drive's oscillator at some speed, or what `run_up`, `load_change` or `schedule` gave
        with samples.
    seconds : float, optional
        How long; 2 s of a motion, and the whole of a passage, when not given.
    full_scale_n : float, optional
        The force that stands for full scale: four times the drive's mean force when not given, or the largest change of
        this force where that is more.
    rate : int
        Samples a second, up to 192 000.

    Returns
    -------
    Sound
        Faded in and out over 60 ms each. What lies above half the rate is filtered out first.

    Raises
    ------
    ValueError
        Where the force does not fit into `full_scale_n`, a passage has fewer than 16 samples a mesh period, or it is
        shorter than the two fades.

    Notes
    -----
    Of a passage one hears what its samples hold, frequencies up to half of `samples_per_period` times that of the mesh.

    It is the tooth force as sound and not the noise of a gearbox: shafts, bearings and housing, which filter it, are
    not in the model.

    Examples
    --------
    >>> from gearpair.motion import steady_state
    >>> from gearpair.teeth import SpurPair
    >>> drive = GearDrive.from_pair(SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0,
    ...     transmission_error_um=5.0, damping_ratio=0.05, pinion_speed_rpm=3000.0)
    >>> heard = sound(drive, steady_state(drive.oscillator()), 0.5)
    >>> len(heard.samples), heard.peak < 1.0
    (22050, True)
    """
    from scipy.interpolate import CubicSpline  # here, so that importing gearpair stays quick
    from scipy.signal import firwin, resample_poly

    rate = check_count("rate", rate, at_least=1000, at_most=FASTEST)
    if isinstance(motion, SteadyState):
        seconds = 2.0 if seconds is None else check_number("seconds", seconds, above=2.0 * FADE, at_most=60.0)
        time, force = _force_of(drive, motion, seconds, rate * OVER)
    else:
        time, force = _force_in(motion)
        if time[-1] <= 2.0 * FADE:
            raise ValueError(f"motion must last for more than {2.0 * FADE:g} s, got a passage of {time[-1]:.3g} s")
        seconds = float(time[-1]) if seconds is None else check_number("seconds", seconds, above=2.0 * FADE)
        if seconds > time[-1] * (1.0 + 1e-9):
            raise ValueError(f"seconds must be at most those of the passage, {time[-1]:.4g}, got {seconds}")
    n = int(seconds * rate)
    at = np.arange(n * OVER) / (rate * OVER)
    fine = CubicSpline(time, force)(np.minimum(at, time[-1]))
    fine -= fine.mean()
    low_pass = firwin(TAPS + 1, 0.48 * rate, window=("kaiser", 8.0), fs=rate * OVER)
    samples = resample_poly(fine, 1, OVER, window=low_pass)[:n]
    edge = 0.5 - 0.5 * np.cos(np.pi * np.arange(int(FADE * rate)) / int(FADE * rate))
    samples[: len(edge)] *= edge
    samples[-len(edge) :] *= edge[::-1]
    peak = float(np.abs(samples).max())
    if full_scale_n is None:
        full_scale_n = max(LOUD * abs(drive.mean_force_n), peak) or 1.0
    elif peak > check_number("full_scale_n", full_scale_n, above=0.0):
        raise ValueError(
            f"full_scale_n must be at least the largest change of the force, {peak:.4g}, got {full_scale_n}"
        )
    return Sound(samples / full_scale_n, rate, float(full_scale_n))


@checked
def write_wav(path: str | Path | BinaryIO, heard: Sound) -> None:
    """Write a sound as a WAV file of 16 bits.

    Parameters
    ----------
    path : str, Path or file open for writing bytes
    heard : Sound

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_wav(Path(folder) / "a.wav", Sound(np.zeros(100), 8000, 1.0))
    ...     (Path(folder) / "a.wav").stat().st_size
    244
    """
    from scipy.io import wavfile

    check_class("heard", heard, Sound)
    if not isinstance(path, (str, Path)) and not hasattr(path, "write"):
        raise TypeError(f"path must be a path, or a file open for writing bytes, got {shown(path)}")
    wavfile.write(path, heard.rate, np.round(heard.samples * 32767.0).astype(np.int16))


def _force_of(
    drive: GearDrive, state: SteadyState, seconds: float, fine_rate: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Time (s) and mesh force (N) of a settled motion, a little longer than `seconds`."""
    if state.status in (Status.ESCAPED, Status.CAPPED):
        raise ValueError(f"motion must stay bounded, got one with status {str(state.status)!r}")
    osc, second = state.oscillator, drive.natural_frequency_rad_s
    mesh = osc.mesh_period / second
    per_period = max(16, int(np.ceil(fine_rate * mesh)))
    x, v = state.points[0].tolist()
    n_periods = osc.base_periods(int(np.ceil(seconds / mesh)) + 1)
    way = trajectory(osc, x, v, n_periods, samples_per_period=per_period)
    return way.tau / second, sampled_force_n(drive, way.x, osc.stiffness(way.tau / osc.mesh_period % 1.0))


def _force_in(run: xr.Dataset) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Time (s) and mesh force (N) of a passage."""
    if "sample_force" not in run:
        raise ValueError("motion must be a settled motion, or a passage that was made with samples_per_period")
    if run.sizes["sample"] < FEWEST:
        raise ValueError(f"motion must have at least {FEWEST} samples_per_period, got {run.sizes['sample']}")
    return run.sample_time.values.ravel(), run.sample_force.values.ravel()
