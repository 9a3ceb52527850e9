"""A motion that passes close by a stable orbit is not on its way to it."""

import numpy as np
import pytest

import gearpair as gp


def test_a_motion_near_a_stable_orbit_that_ends_on_another_is_told_by_its_own():
    """It returns within 0.01 of a stable orbit after 8 mesh periods, and is 0.4 away from it 160 later."""
    osc = gp.Oscillator(damping_ratio=0.005, error_amplitude=0.1, mesh_frequency=0.902)
    start = (-0.659597, -0.508342)
    passed = gp.periodic_orbit(osc, -0.655541, -0.513713, 8)
    assert passed.converged
    assert np.abs(passed.multipliers).max() < 1.0
    apart = np.abs(passed.points - np.array(gp.stroboscopic_map(osc, *start, 8))).max(axis=1)
    assert apart.min() < 0.01
    settled = gp.steady_state(osc, *start)
    judged = gp.steady_state(osc, *start, n_transient=0, max_period=32)
    assert settled.period == judged.period == 2
    assert judged.points == pytest.approx(settled.points, abs=1e-6)
