"""A start has one answer: alone, or in any grid, and it is that of a long march with the range of every segment."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import gearpair as gp
from gearpair._flow.closed_form import TERMS
from gearpair._flow.reach import HIGHEST, LOWEST, begin_reach
from gearpair._flow.walk import OK, walk

ANSWERS = ("status", "period", "impact_state", "worst_impact_state", "largest_displacement", "settling_time",
           "impacts_before", "x_min", "x_max", "lasted")  # fmt: skip
OSCILLATORS = st.builds(
    gp.Oscillator,
    mean_force=st.floats(0.05, 1.2),
    error_amplitude=st.floats(0.02, 0.4),
    damping_ratio=st.floats(0.01, 0.4),
    mesh_frequency=st.floats(0.3, 1.9),
)


def answers_of(plane, i, j):
    return {name: plane[name].values[j, i] for name in ANSWERS}


def assert_same(one, other):
    for name in ANSWERS:
        if one[name].dtype.kind == "f":
            assert one[name] == pytest.approx(other[name], rel=1e-9, abs=1e-9, nan_ok=True), name
        else:
            assert one[name] == other[name], name


@given(OSCILLATORS, st.integers(0, 2**31))
@settings(max_examples=40, deadline=None)
def test_a_start_alone_and_in_a_grid(osc, seed):
    """Near contact, where a neighbourhood may reach over the boundary and a start may swing wider once captured."""
    random = np.random.default_rng(seed)
    x = np.sort(random.uniform(-1.5 + osc.mean_force, 3.0 + osc.mean_force, 9))
    v = np.sort(random.uniform(-1.0, 1.0, 7))
    grid = gp.basins(osc, x, v, n_watch=3000)
    for i, j in zip(random.integers(0, 9, 4).tolist(), random.integers(0, 7, 4).tolist(), strict=True):
        alone = gp.basins(osc, [x[i]], [v[j]], n_watch=3000)
        found = answers_of(grid, i, j)
        if found["status"] == "transient":  # alone there is no other that has left the set
            found["status"] = np.array("aperiodic")[()]
        assert_same(answers_of(alone, 0, 0), found)
        if found["status"] == "periodic":
            assert_marched(osc, x[i], v[j], found)


def assert_marched(osc, x, v, found):
    """The range of the way is that of 3000 mesh periods or, where the transient is longer, ten times as many."""
    reach = np.empty(4)
    begin_reach(reach, x)
    n_periods = 3000 if found["settling_time"] < 300 else 30_000
    status, _x, _v = walk(osc.cells, x, v, n_periods, np.empty(TERMS), None, reach)
    assert status == OK
    largest = max(abs(reach[LOWEST]), abs(reach[HIGHEST]))
    assert found["largest_displacement"] == pytest.approx(largest, rel=3e-9, abs=3e-9)
    assert found["worst_impact_state"] == gp.motion.impact_state(reach[LOWEST], reach[HIGHEST])


@pytest.mark.parametrize(
    ("osc", "start"),
    [
        (
            gp.Oscillator(mean_force=0.66, error_amplitude=0.1826, damping_ratio=0.176, mesh_frequency=0.3985),
            (2.6875, -0.25),
        ),
        (gp.Oscillator(mean_force=1.0, error_amplitude=0.05, damping_ratio=0.05), (2.5, 0.0)),
        (gp.Oscillator(mean_force=0.0, error_amplitude=4.0, damping_ratio=0.05, mesh_frequency=0.25), (0.5, 0.5)),
    ],
)
def test_starts_that_had_two_answers(osc, start):
    x, v = start[0] + np.linspace(-2.0, 2.0, 17), start[1] + np.linspace(-1.0, 1.0, 9)
    found = answers_of(gp.basins(osc, x, v), 8, 4)
    assert_same(answers_of(gp.basins(osc, [start[0]], [start[1]]), 0, 0), found)
    assert_marched(osc, *start, found)
    state = gp.steady_state(osc, *start)
    assert (state.status, state.period) == (found["status"], found["period"])
