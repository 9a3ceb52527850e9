"""Results that hold arrays are equal when what they hold is."""

import dataclasses

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import iso_dynamic_factor

OSC = gp.Oscillator(mesh_frequency=1.6)
PAIR = dict(
    pinion_torque_nm=100.0, pinion_speed_rpm=3000.0, backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.1
)


def iso():
    drive = gp.GearDrive.from_pair(gp.SpurPair(), **PAIR)
    return iso_dynamic_factor(drive, [1000.0, 2000.0], base_pitch_um=8.0, profile_um=6.0)


@pytest.mark.parametrize(
    ("make", "changed"),
    [
        (lambda: gp.steady_state(OSC), lambda state: {"points": state.points + 1e-12}),
        (lambda: gp.steady_state(gp.Oscillator(mesh_frequency=1.219), n_exponent=100), lambda state: {"x_min": 0.0}),
        (lambda: gp.periodic_orbit(OSC, 0.8, -0.1, 1), lambda orbit: {"period": 2}),
        (lambda: gp.trajectory(OSC, 1.0, 0.0, 5), lambda motion: {"x": motion.x[:-1]}),
        (iso, lambda factor: {"k_v": np.full(2, np.nan)}),
    ],
)
def test_two_results_are_equal_when_all_that_they_hold_is(make, changed):
    one, other = make(), make()
    assert one == other
    assert one != dataclasses.replace(one, **changed(one))
    assert one != "something else"
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)


def test_nan_is_equal_to_nan():
    state = gp.steady_state(gp.Oscillator(mesh_frequency=1.219), n_exponent=100)
    assert np.isnan(state.multipliers).all()
    assert dataclasses.replace(state, x_max=np.nan) == dataclasses.replace(state, x_max=float("nan"))
