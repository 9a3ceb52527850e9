"""Another damping ratio in free flight: the flow, its tangent with a jump at each crossing, and what follows from both.

X' + 2 zeta X has no jump, whatever zeta is where, so the jump's determinant is 1; what else is checked against are
DOP853, differences, times in contact, and numbers that another program computed.
"""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import gearpair as gp
from gearpair._flow.capture import COLUMNS, surround_rows
from gearpair.boundaries import at_phase, backward_map
from gearpair.ensembles.datasets import check_origin
from gearpair.methods import integrated_trajectory, runge_kutta_section
from gearpair.methods.runge_kutta import Integrator
from gearpair.motion import impact_measures
from tests.ensembles.test_capture import edge, neighbourhoods, size
from tests.flow.test_invariants import MANY, OSCILLATORS, STARTS, monodromy
from tests.support.oscillators import SINGLE, random_case
from tests.support.reference import dop853_period

BASELINE = gp.Oscillator()
SILENT = gp.Oscillator(flight_damping=0.0)
DAMPINGS = (0.0, 1e-12, 0.05, 0.4, 2.0)
UNEQUAL = st.builds(lambda osc, zeta: osc.replace(flight_damping=zeta), OSCILLATORS, st.sampled_from(DAMPINGS))


def in_contact(osc, start, n=1):
    """The time in contact over n mesh periods, from the crossings."""
    crossings = gp.trajectory(osc, *start, n, samples_per_period=1).impacts
    times = np.concatenate([[0.0], crossings.tau, [n * osc.period]])
    first = abs(start[0]) > 1.0
    return float(np.diff(times) @ np.concatenate([[first], crossings.contact]))


@pytest.mark.parametrize("seed", range(4))
def test_random_oscillators_against_dop853_restarted_at_every_event(seed):
    rng = np.random.default_rng(seed)
    for i in range(20):
        osc, x, v = random_case(rng)
        osc = osc.replace(flight_damping=float(rng.choice(DAMPINGS)))
        if i % 4 == 0:
            osc = osc.replace(harmonics=[(3, 0.05, 0.4)])
        expected = dop853_period(osc, x, v)
        x, v = map(float, gp.stroboscopic_map(osc, x, v))
        assert max(abs(x - expected[0]), abs(v - expected[1])) <= 2e-11 * max(1.0, abs(x), abs(v)), (osc, x, v)


@pytest.mark.parametrize(("damping", "flight_damping"), [(0.02, 0.0), (0.02, 0.3), (0.0, 0.1), (0.3, 0.0)])
def test_monodromy_is_the_map_s_derivative(damping, flight_damping):
    """Central differences, of starts that cross both boundaries at speed."""
    osc = gp.Oscillator(damping_ratio=damping, flight_damping=flight_damping)
    for start in ((-1.3, 1.1), (0.3, 0.8), (1.5, -1.6)):
        step, m = 3e-6, monodromy(osc, start, 1)[0]
        assert len(gp.trajectory(osc, *start, 1).impacts) > 0
        apart = np.array([[step, 0.0], [0.0, step]])
        ends = [np.subtract(*(gp.stroboscopic_map(osc, *(start + way * each)) for way in (1, -1))) for each in apart]
        assert np.abs(m - np.transpose(ends) / (2.0 * step)).max() < 1e-8


@MANY
@given(UNEQUAL, STARTS, st.integers(1, 3))
def test_areas_shrink_by_the_damping_that_acted(osc, start, n):
    """det M = exp(-2 zeta (time in contact) - 2 zeta_f (time in flight)), up to the rounding of its products."""
    assume(abs(start[0]) != 1.0)
    m, _x, _v = monodromy(osc, start, n)
    contact = in_contact(osc, start, n)
    expected = np.exp(-2.0 * (osc.damping_ratio * contact + osc.flight_damping * (n * osc.period - contact)))
    products = abs(m[0, 0] * m[1, 1]) + abs(m[0, 1] * m[1, 0])
    assert abs(np.linalg.det(m) - expected) <= 1e-11 * n * max(products, expected, np.linalg.norm(m))


@settings(max_examples=25, deadline=None, derandomize=True)
@given(UNEQUAL, STARTS)
def test_exponents_sum_to_minus_twice_the_mean_damping(osc, start):
    assume(abs(start[0]) != 1.0)
    n = 3  # so few that chaos leaves the digits
    pair = gp.lyapunov_exponents(osc, *start, n, n_transient=0)
    middle = tuple(map(float, gp.stroboscopic_map(osc, *start, n)))  # measured after as many
    assume(abs(middle[0]) != 1.0 and max(map(abs, middle)) < 1e3)
    share = in_contact(osc, middle, n) / (n * osc.period)
    mean = share * osc.damping_ratio + (1.0 - share) * osc.flight_damping
    assert abs(pair.sum() + 2.0 * mean) < 1e-9 * max(1.0, abs(pair[0]))


def test_a_periodic_motion_s_exponents_are_its_multipliers_and_chaos_has_the_sum_too():
    state = gp.steady_state(SILENT.replace(damping_ratio=0.05))
    logs = np.log(np.abs(state.multipliers)) / (state.period * state.oscillator.period)
    np.testing.assert_allclose(state.lyapunov_exponents, logs, rtol=0.0, atol=1e-12)
    chaos = gp.steady_state(SILENT.replace(mesh_frequency=0.85), n_watch=2000)
    assert chaos.status == "aperiodic"
    share = impact_measures(chaos).flight_share
    assert abs(chaos.lyapunov_exponents.sum() + 0.04 * (1.0 - share)) < 1e-3


OTHERS = [
    (0.05, 0.0, 0.814421, 1.372254),
    (0.02, 0.0, 0.804922, 1.376214),
    (0.05, None, 0.823572, 1.368643),
    (0.02, None, 0.806393, 1.375657),
]


@pytest.mark.parametrize(("damping", "flight_damping", "lowest", "highest"), OTHERS)
def test_row_o4_of_others(damping, flight_damping, lowest, highest):
    """k = 1, mean force 0.1277013, error 0.05, Omega 0.9: a tight integration of each equation, to its six digits."""
    osc = gp.Oscillator(
        mean_force=0.1277013,
        error_amplitude=0.05,
        mesh_frequency=0.9,
        damping_ratio=damping,
        flight_damping=flight_damping,
        stiffness=SINGLE,
    )
    state = gp.steady_state(osc)
    assert (round(state.x_min, 6), round(state.x_max, 6)) == (lowest, highest)


def test_the_same_damping_in_flight_is_the_default_bit_for_bit():
    rng = np.random.default_rng(5)
    for osc, x, v in [random_case(rng) for _ in range(30)]:
        same = osc.replace(flight_damping=osc.damping_ratio)
        assert gp.stroboscopic_map(osc, x, v, 3) == gp.stroboscopic_map(same, x, v, 3)
        np.testing.assert_array_equal(monodromy(osc, (x, v), 2)[0], monodromy(same, (x, v), 2)[0])
    same = BASELINE.replace(flight_damping=BASELINE.damping_ratio)
    one, other = gp.steady_state(BASELINE), gp.steady_state(same)
    np.testing.assert_array_equal(one.points, other.points)
    np.testing.assert_array_equal(one.lyapunov_exponents, other.lyapunov_exponents)
    np.testing.assert_array_equal(neighbourhoods(BASELINE, 1.0, 0.0)[1], neighbourhoods(same, 1.0, 0.0)[1])


CYCLES = {
    "rattle": (SILENT, 1.0, 0.0),
    "clatter": (SILENT.replace(damping_ratio=0.05), -2.0, 1.5),
    "strong in flight": (BASELINE.replace(flight_damping=1.0), 1.0, 0.0),
    "strong in contact": (SILENT.replace(damping_ratio=0.4), 1.0, 0.0),
    "a section near the boundary": (at_phase(BASELINE.replace(flight_damping=1.0), 0.6), 1.0, 0.0),
}


@pytest.mark.parametrize(("osc", "x", "v"), CYCLES.values(), ids=CYCLES)
def test_a_neighbourhood_is_mapped_into_itself(osc, x, v):
    _state, rows = neighbourhoods(osc, x, v)
    assert len(rows) > 0
    for row in rows:
        rim = edge(row, 720)
        image = np.stack(gp.stroboscopic_map(osc, rim[:, 0], rim[:, 1], len(rows)), axis=1)
        assert size(row, image).max() < 1.0


@pytest.mark.slow
def test_neighbourhoods_of_random_oscillators_are_mapped_into_the_next():
    """Many with a boundary of the play through them: there X' and X' + 2 zeta X go apart."""
    rng = np.random.default_rng(3)
    across = 0
    for _ in range(400):
        osc = gp.Oscillator(
            mesh_frequency=rng.uniform(0.5, 2.0),
            damping_ratio=rng.uniform(0.01, 0.5),
            flight_damping=float(rng.choice([0.0, 0.2, 1.0, 3.0])),
            mean_force=rng.uniform(0.02, 0.4),
            error_amplitude=rng.uniform(0.05, 0.4),
        )
        osc = at_phase(osc, float(rng.uniform(0.0, 0.999)))
        state = gp.steady_state(osc, n_watch=0, n_exponent=20)
        if state.period is None:
            continue
        rows = np.zeros((state.period, COLUMNS))
        n = surround_rows(osc.cells, state.points[:1].copy(), np.array([state.period]), rows)
        for row, following in zip(rows[:n], np.roll(rows[:n], -1, axis=0), strict=True):
            rim = edge(row, 360)
            image = np.stack(gp.stroboscopic_map(osc, rim[:, 0], rim[:, 1]), axis=1)
            assert size(following, image).max() < 1.0
            across += np.unique(np.abs(rim[:, 0]) > 1.0).size > 1
    assert across > 30


def test_backward_undoes_forward():
    for zeta in (0.0, 0.3):
        osc = BASELINE.replace(flight_damping=zeta)
        back = backward_map(osc, *gp.stroboscopic_map(osc, 0.3, -1.2))
        np.testing.assert_allclose(back, (0.3, -1.2), rtol=0.0, atol=1e-12)


def test_the_section_s_phase_changes_no_motion():
    osc = SILENT.replace(damping_ratio=0.05)
    here, there = gp.steady_state(osc), gp.steady_state(at_phase(osc, 0.4))
    np.testing.assert_allclose([here.x_min, here.x_max], [there.x_min, there.x_max], rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(here.multipliers, there.multipliers, rtol=0.0, atol=1e-9)


def test_integrators_integrate_the_same_equation():
    x, v = gp.stroboscopic_map(SILENT, 1.0, 0.0)
    tight = {"rtol": 1e-10, "atol": 1e-12}
    points = {
        "compiled": runge_kutta_section(SILENT, 1.0, 0.0, 1, **tight)[-1],
        "scipy": [getattr(integrated_trajectory(SILENT, 1.0, 0.0, 1, **tight), name)[-1] for name in "xv"],
        "fixed steps": Integrator(rtol=None, steps=20_000).sections([SILENT], 1.0, 0.0, 1, 1)[0, 0],
    }
    for name, point in points.items():
        np.testing.assert_allclose(point, (x, v), rtol=0.0, atol=1e-5, err_msg=name)
    assert abs(gp.stroboscopic_map(BASELINE, 1.0, 0.0)[0] - x) > 1e-3  # the other equation is told apart


def test_without_damping_in_flight_a_floating_motion_is_neutral():
    """No mean force, in the play for ever: neutral to a shift of X, and without damping there to a drift, too."""
    osc = gp.Oscillator(mean_force=0.0, error_amplitude=0.2)
    still = 0.0, 0.0 - 0.2 * osc.mesh_frequency  # X' of the forced motion at phase 0: no drift
    assert gp.steady_state(osc, *still).status == "floating"
    free = gp.steady_state(osc.replace(flight_damping=0.0), *still)
    assert free.status == "floating" and not free.lyapunov_exponents.any()
    only = osc.replace(damping_ratio=0.0, flight_damping=0.05)
    assert gp.steady_state(only, *still).lyapunov_exponents.tolist() == [0.0, -0.1]


def test_a_parameter_like_others():
    assert BASELINE.flight_damping is None
    assert BASELINE.parameter("flight_damping") == BASELINE.damping_ratio
    assert BASELINE.replace(damping_ratio=0.1).damping_in_flight == 0.1
    assert SILENT.replace(damping_ratio=0.1).damping_in_flight == 0.0
    assert SILENT.replace(flight_damping=None) == BASELINE
    diagram = gp.sweep(BASELINE.replace(damping_ratio=0.05), "flight_damping", [0.0, 0.05])
    check_origin(BASELINE.replace(damping_ratio=0.05), diagram)
    known = gp.steady_state(BASELINE.replace(damping_ratio=0.05)).x_min
    assert abs(diagram.x_min[1] - known) < 1e-12 < 1e-3 < abs(diagram.x_min[0] - known)
    assert gp.Oscillator.from_attrs(gp.sweep(SILENT, "mesh_frequency", [1.6])) == SILENT
    for wrong in (-0.1, 101.0, "no", np.nan):
        with pytest.raises(ValueError, match="flight_damping"):
            gp.Oscillator(flight_damping=wrong)
    with pytest.raises(ValueError, match="mesh_frequency"):
        gp.Oscillator(flight_damping=100.0, mesh_frequency=1e-3)


@pytest.mark.parametrize("parameter", ["flight_damping", "damping_ratio"])
@pytest.mark.parametrize("flight_damping", [None, 0.01])
def test_branches_follow_the_dampings(parameter, flight_damping):
    """Every orbit of a branch is one of the oscillator at its value: in flight too, where that is not given."""
    osc = gp.Oscillator(flight_damping=flight_damping)
    state = gp.steady_state(osc)
    branch = gp.continue_orbit(gp.periodic_orbit(osc, *state.points[0], state.period), parameter, 0.008, 0.022)
    for row in (0, -1):
        there = osc.replace(**{parameter: float(branch.values[row])})
        point = branch.points[row, 0]
        again = gp.stroboscopic_map(there, *point, state.period)
        np.testing.assert_allclose(again, point, rtol=0.0, atol=1e-9)


def test_grazing_leaves_the_tangent_continuous():
    """The jump is 2 (zeta - zeta_f) there and back; what is left is of the time beyond, a square root."""
    osc = gp.Oscillator(mean_force=-0.1, error_amplitude=0.0, flight_damping=0.5, stiffness=SINGLE)
    low, high = 0.0, 5.0  # X' at X = 0 from which the drive side is missed and reached
    for _ in range(60):
        middle = 0.5 * (low + high)
        made = len(gp.trajectory(osc, 0.0, middle, 1, samples_per_period=1).impacts) > 0
        low, high = (low, middle) if made else (middle, high)
    missed = monodromy(osc, (0.0, low - 1e-9), 1)[0]
    apart = [np.abs(monodromy(osc, (0.0, high + d), 1)[0] - missed).max() for d in (1e-4, 1e-6, 1e-8)]
    assert apart[0] < 0.1
    np.testing.assert_allclose(np.divide(apart[:-1], apart[1:]), 10.0, rtol=0.1)
