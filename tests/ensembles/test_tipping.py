"""Attractors followed along a parameter: who is who, and who tips to whom."""

import numpy as np
import pytest

import gearpair as gp
from gearpair import ensembles, motion
from gearpair.ensembles.tipping import ESCAPES, LINGERS, _matched


def test_the_nearest_takes_the_number_and_the_other_tips_to_it():
    places = {0: np.array([0.0, 1.0]), 1: np.array([0.2, 1.2]), 2: np.array([-3.0, 3.0])}
    here = np.array([[-3.1, 3.0], [0.19, 1.2]])
    given, ended = _matched({0: 1, 1: 1, 2: 0}, places, here, 0.3)
    assert given == [2, 1]
    assert ended == {0: 1}


def test_one_that_is_far_is_new_one_that_comes_back_takes_its_number_and_escape_is_told():
    places = {0: np.array([0.0, 1.0]), 1: np.array([-2.0, 2.0])}
    given, ended = _matched({0: 0}, places, np.array([[0.9, 1.9], [-2.1, 2.0]]), 0.3)
    assert given == [2, 1]
    assert ended == {0: 2}
    assert _matched({0: -1}, places, np.empty((0, 2)), 0.3) == ([], {0: ESCAPES})
    assert _matched({0: LINGERS}, places, np.empty((0, 2)), 0.3) == ([], {0: LINGERS})


def test_near_is_a_share_of_the_size_and_a_motion_that_was_followed_goes_on():
    places = {0: np.array([-18.0, 15.0]), 1: np.array([0.0, 1.0])}
    here = np.array([[-22.0, 19.0], [0.4, 1.4]])
    assert _matched({0: 0, 1: 1}, places, here, 0.3) == ([0, 2], {1: 2})
    grown = np.array([[-180.0, 150.0]])
    assert _matched({0: 0}, places, grown, 0.3) == ([2], {0: 2})
    assert _matched({0: 0}, places, grown, 0.3, {0}) == ([0], {})


def test_a_motion_that_grows_without_bound_is_one_and_does_not_tip():
    """Towards contact's parametric resonance one stable period 1 grows seventyfold, the last step tenfold."""
    values = np.linspace(0.88, 0.92, 9)
    shares = ensembles.continue_attractors(gp.Oscillator(), "mesh_frequency", values, n=100)
    (number,) = np.flatnonzero(shares.attractor_x_min.min("mesh_frequency") < -10.0)
    grown = shares.isel(attractor=number)
    assert np.all(grown.attractor_period == 1) and np.all(grown.share > 0.0) and np.all(grown.tips_to == -1)
    assert grown.attractor_x_min[0] > -19.0 and grown.attractor_x_min[-1] < -1200.0
    assert not np.any(shares.tips_to == number)


def test_chaos_that_becomes_a_transient_is_no_attractor_any_more_and_does_not_escape():
    """At 1.1095 chaos lasts, at 1.09 it ends: with a mean life of 2000 mesh periods, so some starts are in it still."""
    how = {"n": 60, "n_watch": 2000}
    shares = ensembles.continue_attractors(gp.Oscillator(), "mesh_frequency", [1.1095, 1.09], **how)
    (chaos,) = np.flatnonzero(shares.attractor_status[0] == "aperiodic")
    assert shares.share[0, chaos] > 0.3 and shares.transient_share[0] == 0.0
    assert np.isnan(shares.share[1, chaos]) and not np.any(shares.attractor_status[1] == "aperiodic")
    assert 0.05 < shares.transient_share[1] < 0.95
    np.testing.assert_allclose(shares.share.sum("attractor") + shares.transient_share, 1.0)
    assert int(shares.tips_to[1, chaos]) in (LINGERS, *np.flatnonzero(shares.share[1] > 0.0))
    assert not np.any(shares.tips_to == ESCAPES)


def test_shares_sum_to_one_and_follow_the_basins():
    """At the baseline period 1 and 2 share the plane; above 0.1 period 1 has it alone, without the clatter."""
    shares = ensembles.continue_attractors(gp.Oscillator(), "damping_ratio", [0.02, 0.021, 0.1], n=120)
    np.testing.assert_allclose(shares.share.sum("attractor"), 1.0)
    double = [
        number
        for number in shares.attractor.values
        if shares.attractor_impact_state[0, number] == "double" and shares.attractor_period[0, number] == 1
    ]
    assert len(double) == 1
    assert float(shares.share[0, double[0]]) == pytest.approx(0.51, abs=0.15)
    assert shares.attractor_period[1, double[0]] == 1
    assert int(shares.tips_to[2, double[0]]) in shares.attractor.values
    assert np.isnan(shares.share[2, double[0]])


def test_a_map_with_all_that_can_be_asked_for():
    """Hysteresis where the sweeps up and down differ; as many attractors as the starts reach; measures."""
    osc, values = gp.Oscillator(), np.linspace(0.4, 0.7, 9)
    asked = {"starts": [[1.0, 0.0], [-2.0, 1.5]], "n_transient": 300, "n_exponent": 100}
    grid = gp.parameter_map(osc, {"mesh_frequency": values}, measures=True, carried="mesh_frequency", **asked)
    how = {"n_transient": 300, "n_exponent": 100}
    up = gp.sweep(osc, "mesh_frequency", values, **how)
    down = gp.sweep(osc, "mesh_frequency", values[::-1], **how).sortby("mesh_frequency")
    differ = (up.period != down.period) | (up.impact_state != down.impact_state)
    assert np.all(grid.hysteresis.values[differ.values])
    assert grid.hysteresis.values.any()
    assert int(grid.n_attractors[-1]) == 2
    state = gp.steady_state(osc, **how)
    expected = vars(motion.impact_measures(state))
    for name, value in expected.items():
        assert float(grid[name][-1]) == pytest.approx(value, rel=1e-9, nan_ok=True)
