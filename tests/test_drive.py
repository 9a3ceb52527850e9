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
