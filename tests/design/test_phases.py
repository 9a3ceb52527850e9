"""An error of unknown phase: the verdict is never better than where the phase is known; and what a chart holds."""

import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import gearpair as gp
from gearpair.design import sensitivity, speed_chart, speed_range_table, speeds_to_avoid, verdict
from gearpair.design.found import LOSSES
from gearpair.teeth import TipRelief, tip_relief

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DATA = dict(pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=4.0, damping_ratio=0.05)
DRIVE = gp.GearDrive.from_pair(PAIR, **DATA)
SPEEDS = np.linspace(0.4, 1.2, 25) * DRIVE.resonance_rpm
RUNS_ALONE = {"n_starts": 0, "locate_jumps": False}
PHASES = 2.0 * np.pi * np.arange(8) / 8


@pytest.fixture(scope="module")
def chart():
    return speed_chart(DRIVE, SPEEDS, n_starts=2)


@pytest.fixture(scope="module")
def known():
    """The charts of the same drive at each of the phases."""
    return [speed_chart(DRIVE.at_phase(phase), SPEEDS, n_starts=2) for phase in PHASES]


def test_an_amplitude_alone_has_no_phase_and_harmonics_have():
    assert DRIVE.error_phase_rad is None and DRIVE.phase_is_unknown
    assert DRIVE.at_speed(3000.0).oscillator() == DRIVE.at_phase(0.0).at_speed(3000.0).oscillator()
    told = DRIVE.replace(transmission_error_um=[(1, 4.0, 0.5), (3, 1.0, 0.25)])
    assert told.error_phase_rad == 0.5 and not told.phase_is_unknown
    assert not told.replace(transmission_error_um=2.0).phase_is_unknown
    assert not DRIVE.replace(transmission_error_um=0.0).phase_is_unknown  # there is nothing whose phase it were


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (4.0, "of the 2 that were tried 180° is the worst; the verdict holds for all 2, not for every other."),
        ([(1, 4.0, 0.5)], "No phase had to be chosen: that of the error is known."),
        (0.0, "No phase had to be chosen: there is no transmission error."),
    ],
)
def test_a_verdict_tells_an_unknown_phase_from_a_known_one_and_from_no_error(error, told):
    few = speed_chart(DRIVE.replace(transmission_error_um=error), [3000.0, 3100.0], n_phases=2, **RUNS_ALONE)
    assert told in verdict(few).phase


def test_without_a_torque_no_phase_is_the_worst():
    floating = speed_chart(DRIVE.replace(pinion_torque_nm=0.0), [3000.0, 3100.0], n_phases=2, **RUNS_ALONE)
    assert verdict(floating).phase == "" and verdict(floating).worst == "Without a torque there is no dynamic factor."


def test_an_error_moved_along_the_mesh_period_keeps_its_shape():
    told = DRIVE.replace(transmission_error_um=[(1, 4.0, 0.5), (3, 1.0, 0.25)]).at_speed(3000.0)
    here, moved = told.oscillator(), told.at_phase(1.7).oscillator()
    tau = np.linspace(0.0, here.period, 50)
    assert np.allclose(moved.error(tau), here.error(tau + 1.2 / here.mesh_frequency), rtol=0.0, atol=1e-12)


@pytest.mark.slow
def test_the_chart_is_the_worst_of_the_charts_at_each_phase(chart, known):
    """Exactly: one lane a phase, from the same starts."""
    factors = np.array([each.factor_high.values for each in known])
    assert np.array_equal(chart.factor_high, factors.max(axis=0))
    assert np.array_equal(chart.factor_low, factors.min(axis=0))
    worst = int(factors.max(axis=1).argmax())
    assert chart.attrs["run_phase_rad"] == PHASES[worst] == pytest.approx(np.pi)
    for name in ("dynamic_factor", "motion", "jump_speed", "jump_kind"):
        runs = dict(run=["up", "down"])
        same = chart[name].sel(runs).values == known[worst][name].sel(runs).values
        assert np.all(same | (name == "jump_speed") & np.isnan(chart.jump_speed.sel(runs)))
    forces = np.array([each.tooth_force.sel(run="worst").values for each in known])
    assert np.array_equal(chart.tooth_force.sel(run="worst"), forces.max(axis=0))
    assert np.array_equal(chart.worst_phase, PHASES[forces.argmax(axis=0)])


@pytest.mark.slow
def test_the_verdict_is_never_better_where_the_phase_is_unknown(chart, known):
    for each in known:
        assert np.all(chart.factor_high >= each.factor_high)
        assert np.all((chart.loss != "") | (each.loss == ""))
    assert {bool(speeds_to_avoid(each)) for each in known} == {False, True} or speeds_to_avoid(chart)
    assert all(each.worst_phase_rad is not None for each in speeds_to_avoid(chart))


@pytest.mark.slow
@settings(max_examples=8, deadline=None, derandomize=True)
@given(
    st.tuples(st.integers(10, 40), st.integers(40, 90)),
    st.floats(-1.0, 1.0).filter(lambda share: abs(share) > 0.05),
    st.floats(0.1, 1.2),
    st.floats(0.03, 0.1),
    st.integers(0, 7),
)
@example((10, 80), 0.5, 1.2, 0.05, 0)  # undercut
@example((38, 40), -1.0, 0.9, 0.04, 4)  # driven back
def test_no_pair_gets_better_by_not_knowing_the_phase(teeth, load, error, damping, phase):
    """By any part of the verdict: factors at every speed, where the teeth part, and how; either sign of the torque."""
    drawn = dict(pinion_torque_nm=200.0 * load, backlash_um=100.0, transmission_error_um=0.0, damping_ratio=damping)
    drive = gp.GearDrive.from_pair(gp.SpurPair(*teeth), **drawn)
    deflection = abs(drive.mean_force_n) / drive.mean_stiffness_n_per_um
    drive = drive.replace(transmission_error_um=error * deflection)
    speeds = np.linspace(0.3, 1.3, 7) * drive.resonance_rpm
    unknown, known = (speed_chart(each, speeds, n_starts=1) for each in (drive, drive.at_phase(PHASES[phase])))
    unbounded = np.isnan(known.factor_high)
    assert np.all((unknown.factor_high >= known.factor_high) | unbounded)
    ways = ["", *LOSSES]
    assert all(ways.index(a) >= ways.index(b) for a, b in zip(unknown.loss.values, known.loss.values, strict=True))
    inside = [[low <= rpm <= high for rpm in speeds] for low, high in verdict(unknown).together]
    quiet = np.any([*inside, np.zeros(len(speeds), bool)], axis=0)
    assert np.all(known.loss.values[quiet] == "")


@pytest.mark.slow
@pytest.mark.parametrize("phase", [0.3, 1.9, 2.9, 4.4, 5.6])
@pytest.mark.parametrize("load", [60.0, 240.0])
def test_no_phase_between_those_taken_is_much_worse(phase, load):
    """Half a step beside its top a cosine over the phase has lost 1 - cos(22.5 degrees), 8 %, of its amplitude; the
    largest factor over a range is no cosine, but its amplitude is less than its mean."""
    drive = DRIVE.replace(pinion_torque_nm=load)
    unknown = speed_chart(drive, SPEEDS, **RUNS_ALONE)
    between = speed_chart(drive.at_phase(phase), SPEEDS, **RUNS_ALONE)
    assert float(between.factor_high.max()) <= 1.1 * float(unknown.factor_high.max())


@pytest.mark.slow
def test_a_sine_that_counters_the_stiffness_turned_by_half_a_period_adds_to_it():
    """The same chart told of phase 0 alone gives a verdict far better than it may be."""
    over = np.linspace(0.15, 1.35, 41) * DRIVE.resonance_rpm
    at = [float(speed_chart(DRIVE.at_phase(p), over, **RUNS_ALONE).factor_high.max()) for p in (0.0, np.pi)]
    worst = speed_chart(DRIVE, over, **RUNS_ALONE)
    assert at[1] > 1.2 * at[0]
    assert float(worst.factor_high.max()) >= at[1]


def test_sensitivities_are_at_the_worst_phase():
    found = sensitivity(DRIVE, SPEEDS, {"damping_ratio": (0.04, 0.06)})
    at_worst = sensitivity(DRIVE.at_phase(np.pi), SPEEDS, {"damping_ratio": (0.04, 0.06)})
    assert found.attrs["phase_rad"] == pytest.approx(np.pi)
    assert np.array_equal(found.dynamic_factor, at_worst.dynamic_factor)
    assert float(found.base_dynamic_factor) == float(speed_chart(DRIVE, SPEEDS, **RUNS_ALONE).factor_high.max())


# What a chart holds


def test_a_chart_is_a_table_of_one_row_a_run_and_speed(chart, tmp_path):
    """Whether there are jumps or none."""
    quiet = speed_chart(DRIVE.replace(pinion_torque_nm=2000.0), SPEEDS[:2], n_starts=0)
    assert not np.isfinite(quiet.jump_speed).any() and np.isfinite(chart.jump_speed).any()
    for each in (chart, quiet):
        frame = each.to_dataframe()
        assert len(frame) == 3 * each.sizes["speed"] and frame.index.is_unique
        assert not frame.reset_index().duplicated().any()
    chart.to_netcdf(tmp_path / "chart.nc")
    sensitivity(DRIVE, SPEEDS[:2]).to_netcdf(tmp_path / "sensitivity.nc")


def test_the_worst_motion_is_that_of_the_largest_tooth_force_or_else_mesh_force(chart):
    for of in (chart, speed_chart(DRIVE.replace(mesh=None), SPEEDS[:5], n_starts=2)):
        name = "mesh_force" if np.isnan(of.tooth_force).all() else "tooth_force"
        assert np.all(of[name].sel(run="worst") >= of[name].max("run"))


@pytest.mark.parametrize("number", [np.int64(4), np.float32(4.0), Fraction(4), Decimal(4), 4, np.array(4.0)])
def test_any_real_number_is_an_amplitude(number):
    assert gp.GearDrive.from_pair(PAIR, **(DATA | {"transmission_error_um": number})) == DRIVE
    relieved = [DRIVE.replace(relief=TipRelief(each, 0.0, Fraction(1, 3))) for each in (number, 4.0)]
    assert relieved[0] == relieved[1]
    assert np.array_equal(*(tip_relief(DRIVE.mesh, each, each, 0.25) for each in (number, 4.0)))


def test_a_drive_without_torque_floats_without_a_blow_or_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        still = speed_chart(DRIVE.replace(pinion_torque_nm=0.0), SPEEDS[::8], n_starts=4)
        [found] = speeds_to_avoid(still)
        text = str(speed_range_table([found]))
    assert np.all(still.impact_rate == 0.0)
    assert found.why == "the teeth float in the backlash without impacts"
    assert "strike" not in text and "nan" not in text


@pytest.mark.slow
def test_a_torque_turned_round_changes_nothing(chart):
    """X to -X and the error by half a mesh period, which is among the phases; the starts are mirrored too."""
    back = speed_chart(DRIVE.replace(pinion_torque_nm=-120.0), SPEEDS, n_starts=2)
    for name in ("factor_high", "factor_low", "time_apart_high", "worst_share"):
        assert np.allclose(back[name], chart[name], rtol=1e-6, equal_nan=True), name
    assert np.array_equal(back.loss, chart.loss)


def test_one_row_for_a_resonance():
    """A single speed at which contact is kept parts no range; eight do."""
    over = np.linspace(1.0, 1.2, 21) * DRIVE.resonance_rpm
    told = speed_chart(DRIVE, over, n_phases=1, **RUNS_ALONE)
    parted = np.isin(np.arange(21), [2, 3, 4, 5, 6, 8, 9, 18, 19])
    loss = np.where(parted, "part after a shock alone, not when run up or down", "")
    found = speeds_to_avoid(told.assign(loss=("speed", loss)))
    middles = 0.5 * (over[1:] + over[:-1])
    assert [(each.lower, each.upper) for each in found] == [(middles[1], middles[9]), (middles[17], middles[19])]
    assert {each.why for each in found} == {"the teeth part after a shock alone, not when run up or down"}
