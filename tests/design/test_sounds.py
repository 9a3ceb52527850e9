"""Sounds: pitch, level, ends without a click, no clipping, and the file."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import wavfile

import gearpair as gp
from gearpair.design import Sound, run_up, sound, write_wav

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DRIVE = gp.GearDrive.from_pair(
    PAIR, pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=[(1, 4.0, 0.0)], damping_ratio=0.05
).at_speed(8100.0)
STATE = gp.steady_state(DRIVE.oscillator())


def test_pitch_and_level_are_those_of_the_force() -> None:
    """The line at mesh frequency is the Fourier coefficient of k f(X), in newtons."""
    heard = sound(DRIVE, STATE, 1.0)
    middle = heard.samples[4410:-4410][: 44_100 * 3 // 4]  # whole periods of 3780 Hz in 0.75 s
    lines = 2.0 * np.abs(np.fft.rfft(middle)) / len(middle)
    assert int(np.argmax(lines)) == round(3780 * 0.75)
    osc = STATE.oscillator
    way = gp.trajectory(osc, *STATE.points[0].tolist(), 1, samples_per_period=4096)
    force = np.sign(way.x) * np.clip(np.abs(way.x) - 1.0, 0.0, None) * osc.stiffness(way.tau / osc.period % 1.0)
    expected = 2.0 * np.abs(np.fft.rfft(force[:-1]))[1:3] / 4096 * DRIVE.unit_force_n
    found = lines[[round(3780 * 0.75 * n) for n in (1, 2)]] * heard.full_scale_n
    assert found == pytest.approx(expected, rel=0.01)


def test_no_click_no_clipping_and_what_the_rate_cannot_hold_is_gone() -> None:
    heard = sound(DRIVE, STATE, 0.5)
    assert heard.peak <= 1.0 and abs(heard.samples[0]) < 1e-3 and abs(heard.samples[-1]) < 1e-3
    slow = sound(DRIVE, STATE, 0.5, rate=8000)  # the second harmonic, 7560 Hz, would come back at 440 Hz
    lines = 2.0 * np.abs(np.fft.rfft(slow.samples)) / len(slow.samples)
    assert lines[220] < 1e-3 * lines.max()


def test_a_line_a_little_above_half_the_rate_does_not_come_back() -> None:
    """The second harmonic, 7560 Hz, of 14 000 samples a second would be heard at 6440 Hz."""
    heard = sound(DRIVE, STATE, 1.0, rate=14_000).samples[1400:-1400]  # 0.8 s
    lines = 2.0 * np.abs(np.fft.rfft(heard * np.hanning(len(heard)))) / len(heard)
    assert int(np.argmax(lines)) == round(3780 * 0.8)
    assert lines[round(6440 * 0.8)] < 1e-3 * lines.max()


def test_two_motions_compare() -> None:
    run = run_up(DRIVE, 11_000.0, 8100.0, 1.0, accelerates=False)
    rattling = gp.steady_state(DRIVE.oscillator(), float(run.x[-1]), float(run.v[-1]))
    quiet, noisy = sound(DRIVE, STATE), sound(DRIVE, rattling)
    assert quiet.full_scale_n == noisy.full_scale_n == pytest.approx(4.0 * DRIVE.mean_force_n)
    assert noisy.samples.std() > 3.0 * quiet.samples.std()
    with pytest.raises(ValueError, match="full_scale_n must be at least the largest change of the force"):
        sound(DRIVE, rattling, full_scale_n=100.0)


def test_a_passage_and_its_file(tmp_path: Path) -> None:
    run = run_up(DRIVE, 6000.0, 9000.0, 0.5, samples_per_period=64)
    heard = sound(DRIVE, run)
    assert heard.seconds == pytest.approx(0.5, abs=2e-3)
    write_wav(tmp_path / "run.wav", heard)
    rate, samples = wavfile.read(tmp_path / "run.wav")
    assert rate == 44_100 and samples.dtype == np.int16
    assert samples / 32767.0 == pytest.approx(heard.samples, abs=1e-4)
    half = len(samples) // 2
    pitch = [float(np.argmax(np.abs(np.fft.rfft(part)))) / (half / rate) for part in (samples[:half], samples[half:])]
    assert 2800.0 < pitch[0] < 3550.0 < pitch[1] < 4200.0


def test_bad_input() -> None:
    run = run_up(DRIVE, 6000.0, 9000.0, 0.5)
    with pytest.raises(ValueError, match="motion must be a settled motion, or a passage that was made with"):
        sound(DRIVE, run)
    with pytest.raises(ValueError, match="seconds must be"):
        sound(DRIVE, STATE, 0.0)
    with pytest.raises(ValueError, match="seconds must be at most those of the passage"):
        sound(DRIVE, run_up(DRIVE, 6000.0, 9000.0, 0.5, samples_per_period=64), 5.0)
    with pytest.raises(ValueError, match=r"motion must last for more than 0.12 s, got a passage of 0.05 s"):
        sound(DRIVE, run_up(DRIVE, 6000.0, 9000.0, 0.05, samples_per_period=64))
    with pytest.raises(ValueError, match="motion must have at least 16 samples_per_period, got 8"):
        sound(DRIVE, run_up(DRIVE, 6000.0, 9000.0, 0.5, samples_per_period=8))
    with pytest.raises(ValueError, match="rate must be a whole number of at most 192000, got 1000000000"):
        sound(DRIVE, STATE, rate=10**9)


@pytest.mark.parametrize("samples", [[0.0, 2.0], [0.0, float("nan")], []])
def test_a_sound_holds_what_a_file_can(samples: list[float]) -> None:
    with pytest.raises(ValueError, match="samples must be"):
        Sound(np.array(samples), 8000, 1.0)
