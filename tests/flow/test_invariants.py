"""What every motion obeys, whatever its parameters: random ones, by hypothesis."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

import gearpair as gp
from gearpair._flow.closed_form import TERMS
from gearpair._flow.observe import exponents
from gearpair._flow.walk import walk

WAVES = (
    gp.StiffnessWave.rectangular(),
    gp.StiffnessWave.rectangular(reading="swapped"),
    gp.StiffnessWave((0.0, 0.1, 0.45, 0.8), (1.4, 0.5, 2.1, 0.9)),
)
OSCILLATORS = st.builds(
    gp.Oscillator,
    mean_force=st.floats(-0.4, 0.6),
    error_amplitude=st.floats(0.0, 0.6),
    error_phase=st.floats(-3.0, 3.0),
    damping_ratio=st.floats(0.0, 0.3) | st.sampled_from([0.0, 1e-12, 1.0, 3.0]),
    mesh_frequency=st.floats(0.4, 2.5),
    stiffness=st.sampled_from(WAVES),
)
STARTS = st.tuples(st.floats(-3.0, 3.0) | st.sampled_from([-1.0, 1.0]), st.floats(-2.0, 2.0) | st.just(0.0))
MANY = settings(max_examples=150, deadline=None, derandomize=True)


def monodromy(osc, start, n):
    m = np.eye(2)
    status, x, v = walk(osc.cells, *start, n, np.empty(TERMS), m)
    assert status == 0
    return m, x, v


def always_in_contact(osc):
    """The state after a period as an affine map, (matrix, shift), from scipy's matrix exponential."""
    total = np.eye(5)
    zeta, omega = osc.damping_ratio, osc.mesh_frequency
    for k, share in zip(osc.stiffness.levels, osc.stiffness.durations, strict=True):
        rate = np.zeros((5, 5))  # of (X - 1, X', F, A sin, A cos)
        rate[0, 1] = 1.0
        rate[1] = [-k, -2.0 * zeta, 1.0, 1.0, 0.0]
        rate[3, 4], rate[4, 3] = omega, -omega
        total = expm(rate * share * osc.period) @ total
    amplitude, phase = osc.error_amplitude * omega**2, osc.error_phase
    force = np.array([osc.mean_force, amplitude * np.sin(phase), amplitude * np.cos(phase)])
    return total[:2, :2], total[:2, 2:] @ force


@MANY
@given(OSCILLATORS, STARTS, st.integers(1, 3))
@example(gp.Oscillator(), (1.0, 0.0), 1)
def test_areas_shrink_by_the_damping_alone(osc, start, n):
    """det M = exp(-2 zeta n T); its rounding is that of the products it is the difference of."""
    m, _x, _v = monodromy(osc, start, n)
    products = abs(m[0, 0] * m[1, 1]) + abs(m[0, 1] * m[1, 0])
    expected = np.exp(-2.0 * osc.damping_ratio * n * osc.period)
    assert abs(np.linalg.det(m) - expected) <= 1e-12 * n * max(products, expected, np.linalg.norm(m))


@MANY
@given(OSCILLATORS, STARTS, st.integers(0, 4), st.integers(0, 4))
def test_a_span_can_be_split(osc, start, n, m):
    """The map over n + m periods is that over n, then over m: bit for bit, off the boundaries."""
    middle = gp.stroboscopic_map(osc, *start, n)
    assume(abs(middle[0]) != 1.0 or n == 0)
    assert gp.stroboscopic_map(osc, *start, n + m) == gp.stroboscopic_map(osc, *middle, m)


@MANY
@given(OSCILLATORS, STARTS, st.integers(1, 4))
def test_a_trajectory_passes_through_the_map_s_points(osc, start, samples):
    motion = gp.trajectory(osc, *start, 2, samples_per_period=samples)
    for n in range(3):
        x, v = gp.stroboscopic_map(osc, *start, n)
        scale = 1e-13 * max(1.0, abs(x), abs(v))
        assert abs(motion.x[n * samples] - x) <= scale
        assert abs(motion.v[n * samples] - v) <= scale


@MANY
@given(OSCILLATORS, STARTS)
def test_turned_round_the_gear_pair_moves_the_other_way(osc, start):
    """X -> -X with the forcing reversed: F_m -> -F_m, phi -> phi + pi, up to the rounding of that phase."""
    m, x, v = monodromy(osc, start, 1)
    mirrored = osc.replace(mean_force=-osc.mean_force, error_phase=osc.error_phase + np.pi)
    x1, v1 = gp.stroboscopic_map(mirrored, -start[0], -start[1])
    # What an error on the way grows to is at most about |m| / det m; strong damping makes that bound absurd.
    shrinks = max(1e-3, np.exp(-2.0 * osc.damping_ratio * osc.period))
    scale = 1e-13 * max(1.0, abs(x), abs(v), np.linalg.norm(m)) / shrinks
    assert abs(x1 + x) <= scale
    assert abs(v1 + v) <= scale


@MANY
@given(OSCILLATORS, st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.sampled_from([1, -1]))
@pytest.mark.slow
def test_always_in_contact_it_is_the_linear_oscillator(osc, x, v, side):
    """A load that no motion here can overcome; the map is then affine, and scipy's matrix exponential gives it."""
    osc = osc.replace(mean_force=side * 60.0)
    x, v = side * 100.0 + x, v
    motion = gp.trajectory(osc, x, v, 1, samples_per_period=64)
    assume(len(motion.impacts) == 0)
    matrix, shift = always_in_contact(osc)
    expected = matrix @ [x - side, v] + shift + [side, 0.0]
    assert np.max(np.abs([motion.x[-1], motion.v[-1]] - expected)) <= 1e-12 * max(100.0, np.abs(expected).max())
    np.testing.assert_allclose(monodromy(osc, (x, v), 1)[0], matrix, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("mesh_frequency, damping_ratio", [(0.7, 0.02), (1.219, 0.005), (1.5, 1.0), (1.3, 0.3)])
def test_multipliers_always_in_contact_are_floquet_s(mesh_frequency, damping_ratio):
    osc = gp.Oscillator(mean_force=3.0, mesh_frequency=mesh_frequency, damping_ratio=damping_ratio)
    state = gp.steady_state(osc, 4.0, 0.0)
    assert (state.status, state.period, state.impact_state) == ("periodic", 1, "none_drive")
    matrix, shift = always_in_contact(osc)
    expected = np.linalg.eigvals(matrix)
    assert np.max(np.abs(np.sort_complex(state.multipliers) - np.sort_complex(expected))) < 1e-12
    orbit = np.linalg.solve(np.eye(2) - matrix, shift) + [1.0, 0.0]
    np.testing.assert_allclose(state.points[0], orbit, rtol=0.0, atol=1e-12)
    rates = np.sort(np.log(np.abs(expected)))[::-1] / osc.period
    np.testing.assert_allclose(state.lyapunov_exponents, rates, rtol=0.0, atol=1e-12)


@settings(max_examples=20, deadline=None, derandomize=True)
@given(OSCILLATORS, STARTS)
@example(gp.Oscillator(mesh_frequency=1.219), (1.0, 0.0))
def test_lyapunov_exponents_by_qr(osc, start):
    """The exponents of the kernel against numpy's QR of every period's monodromy; their sum is -2 zeta."""
    assume(osc.damping_ratio <= 0.3)  # beyond, the second diagonal entry is rounding
    blocks, per_block = 4, 25
    status, _x, _v, largest, _error = exponents(osc.cells, *start, per_block, blocks * per_block, blocks, np.empty(4))
    assume(status == 0)
    x, v = start
    q, logs = np.eye(2), np.zeros(2)
    for n in range((blocks + 1) * per_block):
        m, x, v = monodromy(osc, (x, v), 1)
        q, r = np.linalg.qr(m @ q)
        logs += np.log(np.abs(np.diag(r))) * (n >= per_block)
    expected = logs / (blocks * per_block * osc.period)
    assert [largest, -2.0 * osc.damping_ratio - largest] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("x, v", [(300.0, 0.0), (-300.0, 40.0)])
def test_a_large_start_escapes_where_contact_is_parametrically_unstable_and_returns_where_not(x, v):
    unstable = gp.Oscillator(mesh_frequency=1.95, damping_ratio=0.001)
    assert np.abs(np.linalg.eigvals(always_in_contact(unstable)[0])).max() > 1.0
    x1, v1 = gp.stroboscopic_map(unstable, [x, 1.0], [v, 0.0], 2000)
    assert np.isinf(x1[0]) and np.isinf(v1[0])
    assert np.isfinite(x1[1]) and np.isfinite(v1[1])
    state = gp.steady_state(unstable, x, v)
    assert (state.status, state.period, state.impact_state, len(state.points)) == ("escaped", None, None, 0)
    assert "grows without bound" in state.status.remedy
    with pytest.raises(RuntimeError, match="escapes to infinity"):
        gp.trajectory(unstable, x, v, 2000, samples_per_period=1)
    stable = gp.Oscillator(mesh_frequency=1.5, damping_ratio=0.001)
    assert np.abs(np.linalg.eigvals(always_in_contact(stable)[0])).max() < 1.0
    x1, v1 = gp.stroboscopic_map(stable, x, v, 20_000)
    assert abs(x1) < 10.0


def test_without_damping_what_escapes_is_still_named():
    """zeta = 0 at a parametric resonance grows from any start large enough; nothing comes back as nan."""
    osc = gp.Oscillator(mesh_frequency=0.95, damping_ratio=0.0)
    x, v = gp.stroboscopic_map(osc, np.linspace(-1e3, 1e3, 21), 0.0, 500)
    assert not np.any(np.isnan(x) | np.isnan(v))
    assert np.all(np.isinf(x) == np.isinf(v))
    assert np.isinf(x[0])
