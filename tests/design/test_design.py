"""A real drive over its speeds: against hand calculation, exact theory, and the same motion in other units."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gearpair as gp
from gearpair.design import (
    chart_speeds,
    idle_oscillator,
    idle_rattle,
    iso_dynamic_factor,
    linear_response,
    measure_motion,
    sensitivity,
    speed_chart,
    speeds_to_avoid,
)
from gearpair.design.charts import carried_runs, oscillators_at
from gearpair.motion import impact_measures
from gearpair.teeth import iso_stiffness
from tests.support.oscillators import SINGLE

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
ERROR = [(1, 4.0, 0.0)]  # its phase is known, but where a test says otherwise
DATA = dict(pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=ERROR, damping_ratio=0.05)
DRIVE = gp.GearDrive.from_pair(PAIR, pinion_speed_rpm=3000.0, **DATA)
SPEEDS = np.linspace(7000.0, 10000.0, 31)


@pytest.fixture(scope="module")
def chart():
    return speed_chart(DRIVE, SPEEDS, n_starts=6)


def jumps_of(chart):
    """Speed, run and kind of each, by rising speed."""
    runs = [(run, chart.sel(run=run)) for run in ("up", "down")]
    return sorted(
        (float(at), run, str(kind))
        for run, of in runs
        for at, kind in zip(of.jump_speed.values, of.jump_kind.values, strict=True)
        if np.isfinite(at)
    )


def test_the_chart_is_the_dimensionless_motion_in_si_units(chart):
    """Every number of a run against `steady_state` at that speed and the scales of the drive."""
    unit_n, b = DRIVE.unit_force_n, DRIVE.half_backlash_m
    for i in (3, 28):
        osc = DRIVE.at_speed(float(SPEEDS[i])).oscillator()
        state = gp.steady_state(osc, 1.0 + osc.mean_force, 0.0)
        found, row = impact_measures(state), chart.sel(run="up").isel(speed=i)
        hz = 28 * SPEEDS[i] / 60.0
        assert float(row.mesh_force) == pytest.approx(found.drive_force * unit_n, rel=1e-9)
        assert float(row.dynamic_factor) == pytest.approx(found.load_factor, rel=1e-9)
        assert float(row.time_apart) == pytest.approx(found.flight_share, abs=1e-9)
        assert float(row.impact_rate) == pytest.approx(found.drive_impacts * hz, rel=1e-9)
        velocity = found.drive_velocity * b * DRIVE.natural_frequency_rad_s * 1e3
        assert float(row.impact_velocity) == pytest.approx(velocity, rel=1e-9)
        assert str(row.impact_state.values) == str(state.impact_state)


def test_the_dynamic_transmission_error_is_that_of_the_two_rotors():
    """r1 theta1 - r2 theta2 = x + e, so that without forces on it a rigid pair would follow e alone."""
    osc = DRIVE.at_speed(7000.0).oscillator()
    state = gp.steady_state(osc, 1.0 + osc.mean_force, 0.0)
    motion = gp.trajectory(osc, *map(float, state.points[0]), state.period, samples_per_period=4096)
    error = osc.error_amplitude * np.sin(osc.mesh_frequency * motion.tau[:-1] + osc.error_phase)
    dte = (motion.x[:-1] + error) * DRIVE.half_backlash_m * 1e6
    loads = measure_motion(DRIVE, state)
    assert loads["dte_rms"] == pytest.approx(dte.std(), rel=1e-4)
    assert loads["dte_peak_to_peak"] == pytest.approx(np.ptp(dte), rel=1e-3)


def test_one_pair_of_teeth_carries_at_most_the_mesh_force(chart):
    assert np.all(chart.tooth_force <= chart.mesh_force * (1 + 1e-9))
    assert np.all(chart.tooth_force > 0.3 * chart.mesh_force)


@pytest.mark.slow
def test_jumps_are_folds_located_by_continuation(chart):
    """A finer chart finds the same speeds, which lie on neither's grid; there a multiplier is 1."""
    jumps = jumps_of(chart)
    assert [(run, kind) for _, run, kind in jumps] == [("down", "fold"), ("up", "fold")]
    fine = speed_chart(DRIVE, np.linspace(7011.0, 9987.0, 47), n_starts=0)
    assert [at for at, *_ in jumps_of(fine)] == pytest.approx([at for at, *_ in jumps], rel=1e-7)
    osc = DRIVE.oscillator()
    for at, run, _ in jumps:
        before = at * (1 + (1e-6 if run == "down" else -1e-6))
        there = osc.replace(mesh_frequency=before * osc.mesh_frequency / DRIVE.pinion_speed_rpm)
        i = int(np.searchsorted(SPEEDS, at)) - (run == "up")
        state = carried_runs([oscillators_at(DRIVE, SPEEDS)], None)[0][run == "down"][i]
        x, v = state.points[0]
        for step in np.linspace(SPEEDS[i], before, 40):  # the motion that the run is about to lose, followed by Newton
            there = osc.replace(mesh_frequency=step * osc.mesh_frequency / DRIVE.pinion_speed_rpm)
            orbit = gp.periodic_orbit(there, float(x), float(v), 1)
            x, v = orbit.points[0]
        assert orbit.converged and 0.98 < orbit.multipliers[0].real < 1.0


def test_between_the_jumps_there_are_two_motions(chart):
    low, high = (at for at, *_ in jumps_of(chart))
    inside = (chart.speed.values > low) & (chart.speed.values < high)
    assert np.all(chart.n_motions.values[inside] >= 2)
    up, down = (chart.sel(run=run).dynamic_factor.values[inside] for run in ("up", "down"))
    assert np.all(down > 1.5 * up)


def test_the_verdict_names_both_reasons_of_one_resonance(chart):
    [found] = speeds_to_avoid(chart)
    (down, _, _), (up, _, _) = jumps_of(chart)
    assert found.lower == down
    two_ways = "depending on how the speed is reached; at other speeds they part and strike, however"
    assert two_ways in found.why
    assert found.upper == SPEEDS[-1]
    assert found.dynamic_factor == pytest.approx(chart.dynamic_factor.values.max())
    assert found.worst_phase_rad is None


def test_a_drive_twice_the_size_has_the_same_dimensionless_motion():
    """Lengths by s, torque by s^3 and speed by 1/s: forces grow by s^2, everything dimensionless stays."""
    s = 2.5
    large = gp.GearDrive.from_pair(
        PAIR.replace(module_mm=3.0 * s, face_width_mm=25.0 * s),
        pinion_speed_rpm=3000.0 / s,
        pinion_torque_nm=120.0 * s**3,
        backlash_um=100.0 * s,
        transmission_error_um=[(1, 4.0 * s, 0.0)],
        damping_ratio=0.05,
    )
    here, there = DRIVE.oscillator(), large.oscillator()
    for name in ("mean_force", "error_amplitude", "damping_ratio", "mesh_frequency"):
        assert getattr(there, name) == pytest.approx(getattr(here, name), rel=1e-12)
    assert np.allclose(there.stiffness.levels, here.stiffness.levels, rtol=1e-12)
    two = [speed_chart(each, v, n_starts=0) for each, v in ((DRIVE, SPEEDS[:3]), (large, SPEEDS[:3] / s))]
    assert np.allclose(two[1].mesh_force, two[0].mesh_force * s**2, rtol=1e-9)
    assert np.allclose(two[1].dynamic_factor, two[0].dynamic_factor, rtol=1e-9)


def test_the_linear_response_is_exact_where_it_must_be():
    """Constant stiffness, contact kept: the exact flow settles on the very same vibration."""
    osc = gp.Oscillator(
        mean_force=1.0,
        error_amplitude=0.05,
        damping_ratio=0.1,
        mesh_frequency=0.8,
        stiffness=SINGLE,
        harmonics=[(2, 0.02, 0.5), (3, 0.01, 1.0)],
    )
    found, linear = impact_measures(gp.steady_state(osc, 2.0, 0.0)), linear_response(osc)
    assert linear.keeps_contact
    assert linear.load_factor == pytest.approx(found.load_factor, rel=1e-5)  # 4096 samples against an exact maximum


def test_the_linear_response_is_of_first_order_in_the_stiffness_variation():
    """The error falls by a hundred where the variation falls by ten."""
    errors = []
    for h in (0.1, 0.01):
        wave = gp.StiffnessWave((0.0, 0.6), (1.0 + 0.4 * h, 1.0 - 0.6 * h))
        osc = gp.Oscillator(mean_force=1.0, error_amplitude=0.0, damping_ratio=0.1, mesh_frequency=0.7, stiffness=wave)
        found = impact_measures(gp.steady_state(osc, 2.0, 0.0))
        errors.append(abs(linear_response(osc).load_factor - found.load_factor))
    assert errors[1] < errors[0] / 50.0


def test_iso_factor_by_hand():
    """The formulas in another order of arithmetic, at one speed of each range."""
    stiffness = iso_stiffness(PAIR)
    load = 120e3 / 42.0 / 25.0  # N/mm: torque over reference radius and width
    assert load > 100.0
    b_p, b_f = stiffness.single * 8.0 / load, stiffness.single * 6.0 / load
    resonance = 30000.0 / np.pi / 28 * np.sqrt(stiffness.mesh / (DRIVE.equivalent_mass_kg / 25.0))
    # The same as the natural frequency with the standard's stiffness.
    omega = np.sqrt(stiffness.mesh_n_per_m / DRIVE.equivalent_mass_kg)
    assert resonance == pytest.approx(omega * 60.0 / (2 * np.pi) / 28, rel=1e-12)
    e = PAIR.contact_ratio
    rest = 0.125 * np.sin(np.pi * (e - 2.0)) + 0.875
    peak, fast = 0.32 * b_p + 0.34 * b_f + 0.90 + 1.0, 0.47 * b_p + 0.47 * b_f + rest
    ratios = np.array([0.5, 0.85, 1.0, 1.15, 1.325, 1.5, 2.0])
    slow = 0.32 * b_p + 0.34 * b_f + 0.23
    expected = [1 + 0.5 * slow, 1 + 0.85 * slow, peak, peak, (peak + fast) / 2, fast, fast]
    iso = iso_dynamic_factor(DRIVE, ratios * resonance, base_pitch_um=8.0, profile_um=6.0)
    assert iso.k_v == pytest.approx(expected, rel=1e-9)
    assert iso.resonance_ratio == pytest.approx(ratios, rel=1e-12)
    relieved = iso_dynamic_factor(DRIVE, [resonance], base_pitch_um=8.0, profile_um=6.0, relief_um=5.0)
    assert relieved.k_v[0] == pytest.approx(peak - 0.9 * (1.0 - abs(1 - stiffness.single * 5.0 / load)), rel=1e-12)


def test_iso_factor_of_a_lightly_loaded_pair():
    """Below 100 N/mm the stiffness falls with the fourth root of the load, and with it the resonance."""
    drive = gp.GearDrive.from_pair(gp.SpurPair(), **(DATA | {"pinion_torque_nm": 10.0}))
    iso = iso_dynamic_factor(drive, [1000.0, 4000.0, 20000.0], base_pitch_um=8.0, profile_um=8.0)
    assert iso.k_v == pytest.approx([1.60, 3.40, 6.43], abs=0.005)
    assert iso.resonance_rpm == pytest.approx(7002.0, abs=0.5)


def test_iso_factor_of_a_speed_increaser():
    """The same gears at the same mesh frequency and tooth force, the larger one driving."""
    up = gp.SpurPair(pinion_teeth=57, gear_teeth=28, module_mm=3.0, face_width_mm=25.0)
    other = gp.GearDrive.from_pair(up, **(DATA | {"pinion_torque_nm": 120.0 * 57 / 28}))
    given = {"base_pitch_um": 8.0, "profile_um": 6.0}
    one, two = (
        iso_dynamic_factor(each, np.array([3000.0, 9000.0]) * k, **given)
        for each, k in ((DRIVE, 1.0), (other, 28 / 57))
    )
    assert one.k_v == pytest.approx(two.k_v, rel=1e-12)


@pytest.mark.parametrize(
    ("drive", "why"),
    [
        (DRIVE.replace(gear_shift=0.3), "the smaller gear's shift to be at least the larger one's, 0.3, got 0"),
        (DRIVE.replace(pinion_torque_nm=0.0), "K_v is a factor of the load, and pinion_torque_nm is 0"),
    ],
)
def test_iso_outside_its_range_has_no_factor_and_says_why(drive, why):
    iso = iso_dynamic_factor(drive, [1000.0, 2000.0], base_pitch_um=8.0, profile_um=6.0)
    assert np.isnan(iso.k_v).all() and why in iso.outside_range
    assert iso_dynamic_factor(DRIVE, [1000.0], base_pitch_um=8.0, profile_um=6.0).outside_range == ""


def test_iso_light_load_lowers_the_resonance_range():
    light = DRIVE.replace(pinion_torque_nm=42.0 * 25.0 * 25.0 * 1e-3)  # 25 N/mm
    iso = iso_dynamic_factor(light, [100.0], base_pitch_um=8.0, profile_um=6.0)
    assert iso.specific_load_n_per_mm == pytest.approx(25.0)
    assert iso.lower_limit == pytest.approx(0.5 + 0.35 * 0.5)


@pytest.mark.slow
def test_backlash_changes_nothing_while_one_flank_alone_is_struck(chart):
    """The equation of one flank is homogeneous in X - 1, forces and errors: the width of the gap is not in it."""
    wide = DRIVE.replace(backlash_um=160.0)
    other = speed_chart(wide, SPEEDS, n_starts=0)
    assert np.allclose(other.mesh_force.values[:2], chart.mesh_force.values[:2], rtol=1e-8)
    assert np.allclose(other.time_apart.values[:2], chart.time_apart.values[:2], atol=1e-8)


# Sensitivity and rattle


@pytest.mark.slow
def test_sensitivity_is_the_chart_of_the_changed_drive(chart):
    ranges = {"damping_ratio": (0.03, 0.1), "pinion_torque_nm": (60.0, 240.0), "addendum": (0.95, 1.05)}
    found = sensitivity(DRIVE, SPEEDS, ranges)
    assert float(found.base_dynamic_factor) == pytest.approx(chart.dynamic_factor.values[:2].max(), rel=1e-9)
    damped = DRIVE.replace(damping_n_s_per_m=0.1 * DRIVE.critical_damping_n_s_per_m)
    expected = speed_chart(damped, SPEEDS, n_starts=0)
    there = found.sel(change="damping_ratio", end="high")
    assert float(there.dynamic_factor) == pytest.approx(expected.dynamic_factor.values.max(), rel=1e-9)
    assert float(there.time_apart) == pytest.approx(expected.time_apart.values.max(), rel=1e-9)
    assert found.contact_ratio.sel(change="addendum").values == pytest.approx(
        [PAIR.replace(addendum=a).contact_ratio for a in (0.95, 1.05)]
    )
    low, high = found.dynamic_factor.sel(change="damping_ratio").values
    assert high < float(found.base_dynamic_factor) < low


def test_an_idle_gear_follows_the_pinion_until_its_inertia_exceeds_the_drag():
    given = {"order": 2.0, "pinion_swing_deg": 0.05, "drag_torque_nm": 0.4}
    speeds = np.linspace(300.0, 1500.0, 25)
    found = idle_rattle(DRIVE, speeds, **given)
    swing = np.radians(0.05) * (2 * speeds * 2 * np.pi / 60) ** 2
    torque = DRIVE.gear_inertia_kg_m2 * DRIVE.pinion_base_radius_mm / DRIVE.gear_base_radius_mm * swing
    assert found.rattle_ratio == pytest.approx(torque / 0.4, rel=1e-12)
    quiet, loud = found.rattle_ratio < 0.97, found.rattle_ratio > 1.03
    assert quiet.any() and loud.any()
    assert np.all(found.impact_rate[quiet] == 0.0) and np.all(found.time_apart[quiet] < 1e-12)
    assert np.all(found.impact_rate[loud] > 0.0)
    oscillators = [idle_oscillator(DRIVE, speed, **given) for speed in speeds.tolist()]
    periodic = np.array([state.period is not None for state in carried_runs([oscillators], None)[0][0]])
    assert periodic.any() and not periodic.all()
    assert np.all(found.impact_power[periodic] >= 0.0) and np.isnan(found.impact_power[~periodic]).all()


def test_the_power_of_rattle_is_the_kinetic_energy_of_every_impact():
    """The gear behind a swinging pinion in SI units, struck at unlike speeds over a cycle of three swings."""
    drive = gp.GearDrive(
        **{"pinion_teeth": 34, "pinion_inertia_kg_m2": 2e-3, "gear_inertia_kg_m2": 2e-3, "backlash_um": 100.0},
        **{"pinion_base_radius_mm": 47.9, "gear_base_radius_mm": 47.9, "pinion_torque_nm": 120.0},
        **{"transmission_error_um": 10.0, "mean_stiffness_n_per_um": 350.0, "damping_n_s_per_m": 500.0},
    )
    given = dict(order=2.0, pinion_swing_deg=0.3, drag_torque_nm=0.2)
    osc = idle_oscillator(drive, 800.0, **given)
    [(up, _)] = carried_runs([[drive_osc for drive_osc in (idle_oscillator(drive, 200.0, **given), osc)]], None)
    state, mass, b = up[1], 2e-3 / 0.0479**2, 50e-6
    rate, forcing = np.sqrt(350e6 / mass), 2 * 800 * 2 * np.pi / 60
    swing, load = np.radians(0.3) * 0.0479, 0.2 / 0.0479

    def slope(t, y):
        gap = y[0] - b if y[0] > b else y[0] + b if y[0] < -b else 0.0
        push = load - mass * swing * forcing**2 * np.sin(forcing * t)
        return y[1], (push - 500.0 * y[1] - 350e6 * gap) / mass

    def drive_side(t, y):
        return y[0] - b

    def coast_side(t, y):
        return y[0] + b

    drive_side.direction, coast_side.direction = 1.0, -1.0
    x, v = state.points[0]
    span = state.period * 2 * np.pi / forcing
    how = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-14, "max_step": 2e-5, "events": [drive_side, coast_side]}
    run = solve_ivp(slope, (0.0, span), [x * b, v * b * rate], **how)
    speeds = np.concatenate([each[:, 1] for each in run.y_events if len(each)])
    assert len(speeds) > 2 and speeds.std() > 0.1 * speeds.mean()  # so that the mean's square would not do
    power = 0.5 * mass * np.sum(speeds**2) / span
    found = idle_rattle(drive, [200.0, 800.0], **given)
    assert found.impact_power == pytest.approx([0.0, power], rel=1e-4)
    assert found.impact_power[1] == pytest.approx(2.78e-3, rel=2e-3)


def test_the_idle_oscillator_is_the_gear_behind_a_swinging_pinion():
    """theta2 integrated in SI units, the pinion's motion given."""
    osc = idle_oscillator(DRIVE, 900.0, order=3.0, pinion_swing_deg=0.1, drag_torque_nm=0.3)
    r1, r2 = DRIVE.pinion_base_radius_mm * 1e-3, DRIVE.gear_base_radius_mm * 1e-3
    b, inertia, c = DRIVE.half_backlash_m, DRIVE.gear_inertia_kg_m2, DRIVE.damping_n_s_per_m
    k, rate, swing = DRIVE.mean_stiffness_n_per_um * 1e6, 3 * 900 * 2 * np.pi / 60, np.radians(0.1)

    def slope(t, y):
        x = r1 * swing * np.sin(rate * t) - y[0]
        v = r1 * swing * rate * np.cos(rate * t) - y[1]
        gap = x - b if x > b else x + b if x < -b else 0.0
        return y[1], -r2 * 0.3 / inertia + r2**2 / inertia * (c * v + k * gap)

    unit = np.sqrt(k * r2**2 / inertia)
    x0, v0 = 1.0001, 0.0
    start = [-b * x0, r1 * swing * rate - b * v0 * unit]
    end = 2 * np.pi / rate
    run = solve_ivp(slope, (0.0, end), start, method="DOP853", rtol=1e-11, atol=1e-16, max_step=end / 4000)
    x = (r1 * swing * np.sin(rate * end) - run.y[0, -1]) / b
    v = (r1 * swing * rate * np.cos(rate * end) - run.y[1, -1]) / b / unit
    assert np.allclose((x, v), gp.stroboscopic_map(osc, x0, v0), rtol=0.0, atol=1e-6)


# Bad input


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda: speed_chart(DRIVE, [1000.0]), r"speeds_rpm must be at least two numbers, got shape \(1,\)"),
        (lambda: speed_chart(DRIVE, [2000.0, 1000.0]), "speeds_rpm must rise"),
        (lambda: speed_chart(DRIVE, [0.0, 1000.0]), r"speeds_rpm\[0\] must be a finite number above 0, got 0.0"),
        (lambda: sensitivity(DRIVE, SPEEDS, {"colour": (1.0, 2.0)}), "unknown name 'colour'; what can be changed is"),
        (lambda: sensitivity(DRIVE, SPEEDS, {"backlash_um": (1.0,)}), "the range of backlash_um must be a low and a"),
        (
            lambda: iso_dynamic_factor(DRIVE.replace(mesh=None), [1.0], base_pitch_um=1.0, profile_um=1.0),
            "drive must come from GearDrive.from_pair",
        ),
        (lambda: idle_rattle(DRIVE, SPEEDS, order=2.0, pinion_swing_deg=0.1, drag_torque_nm=0.0), "drag_torque_nm"),
    ],
)
def test_bad_input_gets_a_sentence(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()


@pytest.mark.parametrize(
    ("given", "ends"),
    [
        ({}, (0.15, 1.35)),
        ({"lowest_rpm": 2.0}, (2.0, 2.2)),
        ({"highest_rpm": 0.2}, (0.1, 0.2)),
        ({"service_rpm": (0.1, 0.9)}, (0.1, 1.35)),
        ({"service_rpm": (0.4, 1.5)}, (0.15, 1.65)),
        ({"service_rpm": (0.4, 1.5), "lowest_rpm": 0.3, "highest_rpm": 0.8}, (0.3, 0.8)),
    ],
)
def test_a_chart_reaches_around_the_resonance_and_over_the_service(given, ends):
    """All in parts of the resonance speed."""
    resonance = DRIVE.resonance_rpm
    told = {name: np.multiply(value, resonance) for name, value in given.items()}
    np.testing.assert_allclose(chart_speeds(DRIVE, 5, **told) / resonance, np.linspace(*ends, 5), rtol=1e-12)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"lowest_rpm": 3000.0, "highest_rpm": 2000.0}, "lowest_rpm must be below highest_rpm, got 3000 and 2000"),
        ({"service_rpm": (-1.0, 2000.0)}, r"service_rpm\[0\] must be a finite number above 0, got -1.0"),
    ],
)
def test_a_chart_of_no_speeds_is_refused(given, sentence):
    with pytest.raises(ValueError, match=sentence):
        chart_speeds(DRIVE, **given)
