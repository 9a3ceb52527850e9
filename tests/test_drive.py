"""The dimensional model against the two rotor equations in SI units."""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gearpair as gp

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
    """Integrate I1 theta1'' and I2 theta2'' with SI quantities; X = (r1 theta1 - r2 theta2 - e) / b_h."""
    osc = DRIVE.oscillator()
    assert 0.6 < osc.mesh_frequency < 0.9  # a motion with impacts, not a trivial one
    r1, r2 = DRIVE.pinion_base_radius_mm * 1e-3, DRIVE.gear_base_radius_mm * 1e-3
    e_a, b = DRIVE.transmission_error_um * 1e-6, DRIVE.half_backlash_m
    omega, psi = DRIVE.mesh_frequency_rad_s, DRIVE.error_phase_rad
    # Every stiffness switch ends an integration, so that each runs over a smooth piece (but for the impacts).
    period = 2 * np.pi / omega
    t, state = 0.0, None
    x0, v0 = 1.2, -0.3
    e0, de0 = e_a * np.sin(psi), e_a * omega * np.cos(psi)
    state = np.array([(b * x0 + e0) / r1, (b * v0 * DRIVE.natural_frequency_rad_s + de0) / r1, 0.0, 0.0])

    def rotors(k):
        def slope(t, y):
            theta1, w1, theta2, w2 = y
            x = r1 * theta1 - r2 * theta2 - e_a * np.sin(omega * t + psi)
            dx = r1 * w1 - r2 * w2 - e_a * omega * np.cos(omega * t + psi)
            gap = x - b if x > b else x + b if x < -b else 0.0
            force = DRIVE.damping_n_s_per_m * dx + k * DRIVE.mean_stiffness_n_per_um * 1e6 * gap
            return (
                w1,
                (DRIVE.pinion_torque_nm - r1 * force) / DRIVE.pinion_inertia_kg_m2,
                w2,
                (-DRIVE.gear_torque_nm + r2 * force) / DRIVE.gear_inertia_kg_m2,
            )

        return slope

    n = 3
    for cycle in range(n):
        for start, length, k in zip(osc.stiffness.edges, osc.stiffness.durations, osc.stiffness.levels, strict=True):
            t = (cycle + start) * period
            span = (t, t + length * period)
            piece = solve_ivp(rotors(k), span, state, method="DOP853", rtol=1e-12, atol=1e-15, max_step=period / 400)
            state = piece.y[:, -1]
    end = n * period
    x = (r1 * state[0] - r2 * state[2] - e_a * np.sin(omega * end + psi)) / b
    v = (r1 * state[1] - r2 * state[3] - e_a * omega * np.cos(omega * end + psi)) / b / DRIVE.natural_frequency_rad_s
    assert np.allclose((x, v), gp.stroboscopic_map(osc, x0, v0, n), rtol=0, atol=2e-7)


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
