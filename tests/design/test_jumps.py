"""Jumps between two speeds of a run: against the same run in steps so small that they show where it leaves."""

from itertools import pairwise

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import find_jumps


def pair_of_speeds(here, there, start, **values):
    """The motion at `here` from a start, and the one at `there` that it leads to."""
    osc = gp.Oscillator(**values)
    before = gp.steady_state(osc.replace(mesh_frequency=here), *start)
    return before, gp.steady_state(osc.replace(mesh_frequency=there), *before.points[0].tolist())


def jumps_between(before, after):
    """`find_jumps` of a run over two speeds."""
    if before.oscillator.mesh_frequency < after.oscillator.mesh_frequency:
        return find_jumps([before, after], [])
    return find_jumps([], [after, before])


def change(a, b):
    """Of the extremes, relative to their distance."""
    return max(abs(a.x_min - b.x_min), abs(a.x_max - b.x_max)) / (a.x_max - a.x_min)


def carried(state, frequencies):
    """The motions of a run that goes on from `state`."""
    states = [state]
    for value in np.asarray(frequencies).tolist():
        osc = state.oscillator.replace(mesh_frequency=value)
        states.append(gp.steady_state(osc, *states[-1].points[0].tolist()))
    return states


def largest_change(states):
    """Of one step of a run."""
    return max(change(*two) for two in pairwise(states))


@pytest.mark.parametrize(
    ("here", "there", "start", "values", "kind"),
    [
        (0.6, 0.8, (1.26, 0.11), dict(damping_ratio=0.1, error_amplitude=0.2, mean_force=0.2), "fold"),
        (0.8, 0.6, (0.5, -0.12), dict(damping_ratio=0.1, error_amplitude=0.2, mean_force=0.2), "fold"),
        # It grazes 2e-4 before the fold, and stays stable in between.
        (0.5, 0.4, (-0.914, 0.32), dict(damping_ratio=0.02, error_amplitude=0.2, mean_force=0.2), "fold"),
        # A flip further along its branch, which folds twice, lies nearer to the first row that is unstable.
        (0.4, 0.6, (1.067, 0.017), dict(damping_ratio=0.08, error_amplitude=0.2, mean_force=0.05), "flip"),
        # It grazes in the very step of the walk in which it doubles its period, and stays stable in between.
        (0.6, 0.7, (1.09, 0.08), dict(damping_ratio=0.03, error_amplitude=0.2, mean_force=0.1), "flip"),
        # It grazes first, then doubles its period, and the run lands near by on another motion of one period.
        (0.6, 0.55, (-0.63235, -0.36807), dict(damping_ratio=0.02, error_amplitude=0.3, mean_force=0.2), "flip"),
        # Its branch turns round and ends at `here`, at both ends.
        (0.8, 0.6, (-0.32995, -0.004927), dict(damping_ratio=0.05, error_amplitude=0.2, mean_force=0.05), "flip"),
    ],
)
def test_a_jump_is_where_a_run_in_small_steps_leaves_its_motion(here, there, start, values, kind):
    before, after = pair_of_speeds(here, there, start, **values)
    [jump] = jumps_between(before, after)
    assert (jump.kind, jump.run) == (kind, "up" if here < there else "down")
    assert (jump.before, jump.after) == (str(before.motion.kind), str(after.motion.kind))
    step = np.sign(there - here) * 5e-5
    at = jump.mesh_frequency
    *kept, beyond = carried(before, [*np.linspace(here, at - step, 200), at + step])
    assert largest_change(kept) < 0.05
    assert {state.period for state in kept} == {before.period}
    assert change(kept[-1], beyond) > 0.1 if kind == "fold" else beyond.period != before.period


def test_the_jumps_of_both_runs_are_told_by_rising_speed():
    values = dict(damping_ratio=0.1, error_amplitude=0.2, mean_force=0.2)
    up = pair_of_speeds(0.6, 0.8, (1.26, 0.11), **values)
    down = pair_of_speeds(0.8, 0.6, (0.5, -0.12), **values)
    assert [jump.run for jump in find_jumps([*up], [*down[::-1]])] == ["down", "up"]


@pytest.mark.parametrize(("here", "there"), [(0.8, 1.2), (1.2, 0.8)])
def test_a_steep_change_of_one_motion_is_no_jump(here, there):
    values = dict(damping_ratio=0.1, error_amplitude=0.2, mean_force=0.2)
    before, after = pair_of_speeds(here, there, (0.5, -0.12) if here < there else (1.0, -0.33), **values)
    assert change(before, after) > 0.3
    states = carried(before, np.linspace(here, there, 100))
    assert largest_change(states) < 0.05
    assert change(states[-1], after) < 1e-9
    assert jumps_between(before, after) == []


def test_a_period_doubling_that_has_opened_a_little_is_no_jump():
    """Between the two speeds the extremes move by more than what is smooth, but by less than three times that."""
    values = dict(damping_ratio=0.05, error_amplitude=0.2, mean_force=0.05)
    before, after = pair_of_speeds(1.6, 1.55, (0.959, -0.358), **values)
    assert (before.period, after.period) == (1, 2)
    assert 0.1 < change(after, before) < 0.3
    assert largest_change(carried(before, np.linspace(1.6, 1.55, 100))) < 0.05
    assert jumps_between(before, after) == []


def test_a_run_that_lands_on_another_motion_has_jumped_though_its_own_goes_on():
    """A step so long that it leads out of the basin: known to the step alone."""
    values = dict(damping_ratio=0.03, error_amplitude=0.05, mean_force=0.1)
    before, after = pair_of_speeds(0.6, 0.4, (1.143, 0.055), **values)
    own = carried(before, np.linspace(0.6, 0.4, 100))
    assert largest_change(own) < 0.1
    assert own[-1].period == after.period
    assert change(own[-1], after) > 0.1
    [jump] = jumps_between(before, after)
    assert jump.kind == "between speeds"
    assert jump.mesh_frequency == pytest.approx(0.5)


def test_a_run_that_lands_where_motions_escape_has_jumped():
    values = dict(damping_ratio=0.02, error_amplitude=0.3, mean_force=0.05)
    before, after = pair_of_speeds(0.9, 0.95, (-30.0128, 17.539), **values)
    assert before.period == 1
    assert after.status == "escaped"
    assert [(jump.kind, jump.after) for jump in jumps_between(before, after)] == [("between speeds", "escaped")]
