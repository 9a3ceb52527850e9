"""Batches that settle: chains run both ways, what they are asked for, and when two of their motions are one."""

import numpy as np

import gearpair as gp
from gearpair.motion.same_orbit import same_motions
from gearpair.motion.settling import ONE, settle_both_ways

OSC = gp.Oscillator()


def test_chains_run_both_ways_are_the_sweeps_one_by_one():
    """Two chains, up and down: every row stands where its oscillator does, whichever way it was reached."""
    values = np.linspace(1.0, 1.3, 7)
    bases = (OSC, OSC.replace(damping_ratio=0.03))
    lanes = [base.replace(mesh_frequency=omega) for base in bases for omega in values]
    settings = ONE.having({"n_exponent": 100}, n_samples=128)
    both = settle_both_ways(lanes, np.tile([1.0, 0.0], (len(lanes), 1)), settings, chain=len(values))
    differ = False
    for out, order in zip(both, (values, values[::-1]), strict=True):
        for k, base in enumerate(bases):
            alone = gp.sweep(base, "mesh_frequency", order, n_exponent=100).sortby("mesh_frequency")
            rows = slice(k * len(values), (k + 1) * len(values))
            np.testing.assert_array_equal(out.points[rows, :, 0], alone.x.values)
            np.testing.assert_array_equal(out.extremes[rows, 1], alone.x_max.values)
        differ = differ or not np.array_equal(both[0].period, both[1].period)
    assert differ, "no hysteresis: the two ways could be exchanged unseen"


def test_a_whole_cycle_is_kept_however_few_points_are_asked_for():
    assert gp.steady_state(OSC, n_samples=1).points.shape == (2, 2)
    assert ONE.having({"max_period": 3}, n_samples=5).whole_cycles().n_samples == 5


def test_two_motions_are_one_by_all_that_tells_them_apart():
    nan = np.nan
    rows = {
        "status": [0, 0, 0, 1, 1, 0, 0],
        "period": [2, 2, 2, 0, 0, 2, 2],
        "impact_state": [1, 1, 1, 1, 1, 1, 1],
        "section_x": [0.5, 0.5, 0.5, nan, nan, 0.5, 0.5],
        "section_v": [0.1, 0.1, 0.1, nan, nan, 0.1, 0.1],
    }
    others = {name: list(column) for name, column in rows.items()}
    others["section_x"][0] += 0.9e-6  # the same
    others["section_v"][1] += 1.1e-6
    others["section_x"][2] -= 1.1e-6
    others["status"][4] = 2
    others["period"][5] = 4
    others["impact_state"][6] = 2
    these, those = ({name: np.array(column) for name, column in each.items()} for each in (rows, others))
    assert same_motions(these, those).tolist() == [True, False, False, True, False, False, False]
