"""The dimensional model against the two rotor equations in SI units."""

import dataclasses

import numpy as np
import pytest

import gearpair as gp
from gearpair.article.case.two_rotors import two_rotors

DRIVE = gp.GearDrive(
    pinion_teeth=34,
    pinion_inertia_kg_m2=2e-3,
    gear_inertia_kg_m2=5e-3,
    pinion_base_radius_mm=47.9,
    gear_base_radius_mm=76.1,
    pinion_torque_nm=80.0,
    pinion_speed_rpm=5600.0,
    backlash_um=100.0,
    transmission_error_um=10.0,
    error_phase_rad=0.4,
    mean_stiffness_n_per_um=350.0,
    damping_n_s_per_m=600.0,
)


def test_the_relative_motion_of_two_rotors_is_the_oscillators():
    """I1 theta1'' and I2 theta2'' integrated with SI quantities; X = (r1 theta1 - r2 theta2 - e) / b_h."""
    osc = DRIVE.oscillator()
    assert 0.6 < osc.mesh_frequency < 0.9  # a motion with impacts, not a trivial one
    rotors = two_rotors(DRIVE, 1.2, -0.3, 3)
    exact = [gp.stroboscopic_map(osc, 1.2, -0.3, n) for n in range(4)]
    assert np.allclose(rotors, np.array(exact), rtol=0, atol=1e-8)


def test_there_and_back():
    """with_oscillator(oscillator()) is the identity, and the other way round."""
    again = DRIVE.with_oscillator(DRIVE.oscillator())
    for f in dataclasses.fields(DRIVE):
        if isinstance(getattr(DRIVE, f.name), float):
            assert getattr(again, f.name) == pytest.approx(getattr(DRIVE, f.name), rel=1e-13)
    osc = gp.Oscillator(mesh_frequency=1.3, damping_ratio=0.05, error_phase=1.0)
    back = DRIVE.with_oscillator(osc).oscillator()
    for name in ("mean_force", "error_amplitude", "error_phase", "damping_ratio", "mesh_frequency"):
        assert getattr(back, name) == pytest.approx(getattr(osc, name), rel=1e-13)
    assert back.stiffness == osc.stiffness


def test_mean_force_is_the_articles():
    """F_m = m_e (r_b1 T1 / I1 + r_b2 T2 / I2) with balanced torques."""
    r1, r2 = DRIVE.pinion_base_radius_mm * 1e-3, DRIVE.gear_base_radius_mm * 1e-3
    article = DRIVE.equivalent_mass_kg * (
        r1 * DRIVE.pinion_torque_nm / DRIVE.pinion_inertia_kg_m2 + r2 * DRIVE.gear_torque_nm / DRIVE.gear_inertia_kg_m2
    )
    assert DRIVE.mean_force_n == pytest.approx(article, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "value"),
    [("pinion_teeth", 0), ("gear_inertia_kg_m2", 0.0), ("backlash_um", -1.0), ("pinion_torque_nm", np.nan)],
)
def test_bad_input_is_named(name, value):
    with pytest.raises(ValueError, match=f"{name}.*got"):
        DRIVE.replace(**{name: value})


def test_shaft_orders_go_with_the_drive():
    """Micrometres over half the backlash; kept at other speeds, scaled there and back."""
    drive = DRIVE.replace(shaft_orders=[(34, 30.0, 0.2), (54, 20.0)])
    osc = drive.at_speed(3000.0).oscillator()
    assert osc.shaft_orders == ((34, pytest.approx(0.6), 0.2, 1), (54, pytest.approx(0.4), 0.0, 1))
    assert osc.mesh_periods == 918 and osc.period == pytest.approx(918 * osc.mesh_period)
    back = drive.with_oscillator(osc)
    assert [each.amplitude for each in back.shaft_orders] == pytest.approx([30.0, 20.0], rel=1e-14)
    assert DRIVE.with_oscillator(osc.replace(shaft_orders=())).shaft_orders == ()
    with pytest.raises(ValueError, match=r"shaft_orders\[0\] amplitude must be a finite number at least 0, got -1.0"):
        DRIVE.replace(shaft_orders=[(34, -1.0)])


def test_impacts_per_second_count_the_mesh_periods():
    """Rattle in five of twenty mesh periods: a quarter of an impact a mesh period."""
    osc = gp.Oscillator(
        mean_force=0.01, error_amplitude=0.005, damping_ratio=0.03, mesh_frequency=1.5, shaft_orders=[(20, 1.0)]
    )
    drive = DRIVE.replace(pinion_teeth=20).with_oscillator(osc)
    loads = gp.design.measure_motion(drive, gp.steady_state(drive.oscillator(), 1.02))
    assert loads["impact_rate"] == pytest.approx(5 * drive.pinion_speed_rpm / 60, rel=1e-9)
