"""Damping and error from the speeds of jumps: round trips, intervals against differences, and honest answers."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import Identification, identify, run_up, speed_chart

PAIR = gp.SpurPair()
SPEEDS = np.linspace(5500.0, 11_500.0, 81)
NEITHER = (np.nan, np.nan)


def rig(torque: float = 100.0, error: float = 2.0, damping: float = 0.05, phase: float = 0.3, backlash: float = 80.0):
    return gp.GearDrive.from_pair(
        PAIR,
        pinion_torque_nm=torque,
        backlash_um=backlash,
        transmission_error_um=[(1, error, phase)],
        damping_ratio=damping,
    )


@cache
def jumps(drive: gp.GearDrive) -> tuple[float, float]:
    """The last fold that a run up meets, and the one before it that the run down meets; nan where there are none."""
    chart = speed_chart(drive, SPEEDS, n_starts=0)
    seen = {
        run: chart.jump_speed.sel(run=run).values[chart.jump_kind.sel(run=run).values == "fold"]
        for run in ("up", "down")
    }
    if not len(seen["up"]) or not (seen["down"] < seen["up"].max()).any():
        return NEITHER
    up = float(seen["up"].max())
    return up, float(seen["down"][seen["down"] < up].max())


def answers(found: Identification) -> np.ndarray:
    """All answers: damping ratio, error, phase."""
    own = (found.damping_ratio, found.transmission_error_um, found.error_phase_rad)
    return np.array([own, *found.others])


@cache
def one() -> Identification:
    return identify(rig(error=5.0, damping=0.03), *jumps(rig()))


@pytest.mark.slow
def test_the_jumps_of_a_drive_give_its_damping_and_error_back() -> None:
    found = one()
    assert (found.damping_ratio, found.transmission_error_um) == pytest.approx((0.05, 2.0), rel=1e-6)
    assert (found.drive.damping_ratio, found.drive.transmission_error_um) == pytest.approx((0.05, 2.0), rel=1e-6)
    assert found.fold_rpm == pytest.approx(jumps(rig()), abs=1e-5) and found.misfit_rpm < 1e-5
    assert found.runs == ("up", "down") and found.error_phase_rad == 0.3 == found.phase_interval[0]


@pytest.mark.slow
def test_another_answer_that_fits_as_well_is_told() -> None:
    """A tenth of the error moves the same folds to the same speeds: a drive with it jumps there."""
    found = one()
    assert found.status == "ambiguous"
    ((damping, error, phase),) = found.others
    assert jumps(rig(error=error, damping=damping, phase=phase)) == pytest.approx(jumps(rig()), abs=1e-3)
    assert abs(error - 2.0) > 1.0
    nearer = identify(rig(error=error * 1.2, damping=damping), *jumps(rig()))
    assert (nearer.damping_ratio, nearer.transmission_error_um) == pytest.approx((damping, error), rel=1e-6)


@pytest.mark.slow
def test_round_trips_of_ten_random_drives() -> None:
    rng, done = np.random.default_rng(5), 0
    while done < 10:
        torque, damping = rng.uniform(60.0, 160.0), rng.uniform(0.03, 0.07)
        error, phase = rng.uniform(1.0, 4.0), rng.uniform(0.0, 2.0 * np.pi)
        drive = rig(torque, error, damping, phase, rng.uniform(60.0, 120.0))
        seen = jumps(drive)
        if seen[0] - seen[1] < 100.0 or np.isnan(seen[0]):
            continue
        given = drive.replace(damping_ratio=1.3 * damping, transmission_error_um=0.8 * error)
        found = answers(identify(given, *seen))
        off = np.abs(found[:, :2] / (damping, error) - 1.0).max(axis=1)
        assert off.min() < 1e-6, (drive, found)
        done += 1


@pytest.mark.slow
def test_intervals_are_those_of_the_speeds() -> None:
    """What an answer moves by when each speed is off by a little, added in squares."""
    found, seen = one(), np.array(jumps(rig()))
    moved = []
    for k in range(2):
        off = [identify(rig(), *(seen + side * 0.5 * np.eye(2)[k])) for side in (-1.0, 1.0)]
        moved.append(
            [
                np.log(getattr(off[1], name) / getattr(off[0], name))
                for name in ("damping_ratio", "transmission_error_um")
            ]
        )
    half = 1.959964 * np.sqrt(np.sum(np.square(moved), axis=0))
    for width, (low, high), value in zip(
        half,
        (found.damping_interval, found.error_interval),
        (found.damping_ratio, found.transmission_error_um),
        strict=True,
    ):
        assert (low, high) == pytest.approx((value * np.exp(-width), value * np.exp(width)), rel=2e-5)
        assert width > 1e-3


@pytest.mark.slow
def test_several_torques_are_weighed_together() -> None:
    """Exact speeds of two torques: one answer alone, without misfit; with errors of a rpm: near it."""
    torques = [80.0, 120.0]
    seen = np.array([jumps(rig(torque)) for torque in torques])
    found = identify(rig(error=1.7, damping=0.06), *seen.T, torques_nm=torques)
    assert found.status == "found" and found.others == () and found.misfit_rpm < 1e-4
    assert (found.damping_ratio, found.transmission_error_um) == pytest.approx((0.05, 2.0), rel=1e-6)
    off = np.array([[1.0, -1.0], [-0.5, 1.0]])
    rough = identify(rig(error=1.7, damping=0.06), *(seen + off).T, torques_nm=torques)
    assert 0.0 < rough.misfit_rpm < np.sqrt(np.mean(off**2))
    for (low, high), truth in ((rough.damping_interval, 0.05), (rough.error_interval, 2.0)):
        assert low < truth < high < 1.01 * low


@pytest.mark.slow
def test_the_phase_is_found_from_two_torques() -> None:
    torques = [80.0, 120.0]
    seen = np.array([jumps(rig(torque)) for torque in torques])
    found = identify(rig(phase=1.0), *seen.T, torques_nm=torques, free_phase=True, damping_ratios=(0.03, 0.1))
    off = np.abs(answers(found) / (0.05, 2.0, 0.3) - 1.0).max(axis=1)
    assert off.min() < 1e-5


@pytest.mark.slow
def test_one_speed_does_not_determine_both() -> None:
    found = identify(rig(), jumps(rig())[0], np.nan)
    assert found.status == "undetermined" and "whole line" in found.status.remedy
    assert found.fold_rpm == pytest.approx(found.measured_rpm)
    assert found.damping_interval == (0.0, np.inf)


@pytest.mark.slow
def test_no_fold_and_no_fit_say_so() -> None:
    none = identify(rig(), 8600.0, 7300.0, damping_ratios=(0.4, 0.5))
    assert none.status == "no_fold" and np.isnan(none.damping_ratio) and none.curves == ()
    assert repr(none).startswith("Identification no_fold: the jumps were seen at 8600 and 7300 rpm, the drive's")
    assert f"resonance_rpm is {rig().resonance_rpm:.5g}; no damping ratio and error tried" in repr(none)
    assert none == replace(none)
    narrow = identify(rig(), 9580.0, 9500.0)  # both close below the resonance, where folds lie far apart
    assert narrow.status == "no_fit" and "none were found at these speeds" in repr(narrow)


def mill(torque: float, damping: float, error: float) -> gp.GearDrive:
    """A slow one: heavy rotors, so that it resonates at 64 rpm."""
    return gp.GearDrive.from_pair(
        gp.SpurPair(20, 80, module_mm=10.0, face_width_mm=100.0),
        pinion_torque_nm=torque, backlash_um=300.0, transmission_error_um=[(1, error, 0.0)], damping_ratio=damping,
        pinion_blank=gp.teeth.GearBlank(added_inertia_kg_m2=2e3),
        gear_blank=gp.teeth.GearBlank(added_inertia_kg_m2=3.2e4),
    )  # fmt: skip


@pytest.mark.slow
def test_jumps_of_two_resonances_are_found_from_more_starts() -> None:
    """The jump up of one range of two motions and the jump down of another: the nearest starts lead nowhere."""
    chart = speed_chart(mill(2000.0, 0.05, 15.0), np.linspace(7.0, 86.0, 81), n_starts=0).jump_speed
    found = identify(mill(2000.0, 0.03, 10.0), float(chart.sel(run="up").max()), float(chart.sel(run="down").min()))
    assert found.runs == ("up", "down") and found.measured_rpm == pytest.approx([79.54, 34.21], abs=0.01)
    assert found.status == "found"
    assert (found.damping_ratio, found.transmission_error_um) == pytest.approx((0.05, 15.0), rel=1e-6)


@pytest.mark.slow
def test_a_ramp_at_which_a_rig_would_see_no_jump_is_told() -> None:
    """Through a fifth of the speed below the fold in a ninth of a second, which is two mesh periods."""
    drive, seen = mill(5000.0, 0.05, 15.0), (54.112, 44.557)
    with pytest.warns(UserWarning, match="it jumps not even a fifth of the speed beyond a fold"):
        found = identify(drive, *seen, ramp_rpm_per_s=79.0)
    assert found.late_rpm[1] == np.inf
    assert run_up(drive, seen[1], 0.8 * seen[1], 0.2 * seen[1] / 79.0).sizes["cycle"] == 2
    with pytest.warns(UserWarning, match=r"it jumps up to 11\.\d rpm off"):  # early, for it unloads the mesh
        assert identify(drive, *seen, ramp_rpm_per_s=8.0).late_rpm[1] < -10.0


@pytest.mark.slow
def test_the_curves_meet_at_the_answer() -> None:
    found = one()
    for run, speed, curve in zip(found.runs, found.measured_rpm, found.curves, strict=True):
        ends = np.abs(curve / (0.05, 2.0) - 1.0).max(axis=1)
        assert ends.min() < 1e-6 and len(curve) > 10
        damping, error = curve[int(np.argmin(ends)) + 3]
        there = dict(zip(("up", "down"), jumps(rig(error=error, damping=damping)), strict=True))
        assert there[run] == pytest.approx(speed, abs=1e-3)


@pytest.mark.slow
def test_a_ramp_that_is_too_fast_is_told() -> None:
    """How late it is, read off a run of the same ramp that begins elsewhere, between the factors of the speed chart."""
    seen = jumps(rig())
    with pytest.warns(UserWarning, match=r"a ramp of 2000 rpm/s is too fast for steady folds: it jumps up to"):
        found = identify(rig(), *seen, ramp_rpm_per_s=2000.0)
    chart = speed_chart(rig(), SPEEDS, n_starts=0).dynamic_factor
    ways = {"up": (seen[1] - 200.0, seen[0] + 100.0), "down": (seen[0] + 200.0, seen[1] - 100.0)}  # one motion at first
    for late, fold, (name, way) in zip(found.late_rpm, seen, ways.items(), strict=True):
        after = int(np.searchsorted(SPEEDS, fold))
        middle = chart.sel(run=name).values[after - 1 : after + 1].mean()
        run = run_up(rig(), *way, abs(way[1] - way[0]) / 2000.0)
        near = run.isel(cycle=np.abs(run.speed.values - fold) < 100.0)
        beyond = near.dynamic_factor.values > middle
        crossed = near.speed.values[np.flatnonzero(beyond != beyond[0])[0]]
        assert late == pytest.approx((crossed - fold) * np.sign(way[1] - way[0]), abs=3.0) and late > 10.0


@pytest.mark.slow
def test_an_answer_is_a_line_and_compares_by_value() -> None:
    found = one()
    text = repr(found)
    assert "\n" not in text and text.startswith("Identification ambiguous: damping ratio 0.05 (")
    assert found == replace(found) and found != replace(found, condition=1.0) and len({found, replace(found)}) == 1


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"jump_up_rpm": np.nan, "jump_down_rpm": np.nan}, "must have a speed that was seen"),
        ({"jump_up_rpm": -3.0}, "jump_up_rpm must be a finite number above 0, got -3.0"),
        ({"jump_up_rpm": [8000.0, 8100.0]}, "jump_up_rpm must have one speed for each of 1 torques"),
        ({"jump_up_rpm": 0.5}, "must be at most a factor of 4 apart, got"),
        ({"speed_error_rpm": 0.0}, "speed_error_rpm must be a finite number above 0"),
        ({"ramp_rpm_per_s": 0.0}, "ramp_rpm_per_s must be a finite number above 0"),
        ({"damping_ratios": (0.0, 0.1)}, r"damping_ratios\[0\] must be a finite number above 0"),
        ({"torques_nm": [0.0]}, "torques_nm must not be 0"),
        ({"drive": replace(rig(), error_phase_rad=None)}, "drive must have an error_phase_rad"),
    ],
)
def test_bad_input_gets_a_sentence(changes, sentence) -> None:
    with pytest.raises(ValueError, match=sentence):
        identify(**{"drive": rig(), "jump_up_rpm": 8600.0, "jump_down_rpm": 7300.0, **changes})
