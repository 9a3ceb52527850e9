"""The transmission error with harmonics: exact as the first alone, and cheap."""

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.closed_form import TERMS
from gearpair._flow.walk import walk
from gearpair.methods import integrated_trajectory, runge_kutta_section, segments
from tests.support.oscillators import degenerate_cases, random_case
from tests.support.reference import dop853_period, mpmath_period

DEGENERATE = degenerate_cases()
FIVE = ((2, 0.05, 0.3), (3, 0.03, -1.0), (4, 0.01, 2.0), (5, 0.008, 0.7))
LOADED = gp.Oscillator(harmonics=FIVE)


def with_harmonics(rng, osc):
    """Up to five harmonics of orders up to 12, each of an acceleration like the first's."""
    orders = rng.choice(np.arange(2, 13), rng.integers(1, 6), replace=False)
    return osc.replace(harmonics=[(int(n), rng.uniform(0.0, 1.0) / n**2, rng.uniform(-4.0, 4.0)) for n in orders])


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_random_oscillators_against_seventy_digits(seed):
    """The same bound as for one harmonic, and the monodromy with it."""
    rng = np.random.default_rng(300 + seed)
    for _ in range(4):
        osc, x, v = random_case(rng)
        osc = with_harmonics(rng, osc)
        expected = mpmath_period(osc, x, v)
        assert expected.error(*map(float, gp.stroboscopic_map(osc, x, v))) <= 1e-13 * expected.amplification, (
            osc,
            x,
            v,
        )
        m = np.eye(2)
        status, x1, v1 = walk(osc.cells, x, v, 1, np.empty(TERMS), m)
        assert status == 0 and (x1, v1) == tuple(map(float, gp.stroboscopic_map(osc, x, v)))
        slowest = min([1.0, *(abs(u) for _t, _side, u, _contact in expected.crossings)])
        truth = np.array(expected.monodromy.tolist(), dtype=float)
        np.testing.assert_allclose(m, truth, rtol=0.0, atol=1e-13 * expected.amplification**2 / slowest)


@pytest.mark.parametrize("case", list(DEGENERATE)[::4])
@pytest.mark.slow
def test_degenerate_cases_against_seventy_digits(case):
    osc, x, v = DEGENERATE[case]
    osc = osc.replace(harmonics=FIVE)
    expected = mpmath_period(osc, x, v)
    assert expected.error(*map(float, gp.stroboscopic_map(osc, x, v))) <= 1e-13 * expected.amplification


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.slow
def test_random_oscillators_against_dop853(seed):
    rng = np.random.default_rng(400 + seed)
    for _ in range(10):
        osc, x, v = random_case(rng)
        osc = with_harmonics(rng, osc)
        expected = dop853_period(osc, x, v)
        end = tuple(map(float, gp.stroboscopic_map(osc, x, v)))
        assert np.abs(np.subtract(end, expected)).max() <= 1e-10 * max(1.0, *np.abs(expected)), (osc, x, v)


@pytest.mark.slow
def test_impacts_are_where_seventy_digits_put_them():
    expected = mpmath_period(LOADED, 1.0, 0.2).crossings
    found = gp.trajectory(LOADED, 1.0, 0.2, 1).impacts
    assert len(found) == len(expected) >= 1
    for tau, velocity, (at, _side, speed, _contact) in zip(found.tau, found.velocity, expected, strict=True):
        assert (tau / LOADED.period, velocity) == pytest.approx((at, speed), abs=1e-13)


@pytest.mark.parametrize("x, v", [(1.0, 0.0), (-1.0, 0.0)])
@pytest.mark.parametrize("phase", [0.5 * np.pi, -0.5 * np.pi])
@pytest.mark.slow
def test_a_start_at_rest_on_the_boundary_is_decided_by_the_whole_force(x, v, phase):
    osc = gp.Oscillator(mean_force=0.1, error_amplitude=0.1, harmonics=[(3, 0.4, phase)])
    expected = mpmath_period(osc, x, v)
    assert expected.error(*map(float, gp.stroboscopic_map(osc, x, v))) <= 1e-13 * expected.amplification


def test_a_first_harmonic_written_as_the_second_of_half_the_frequency():
    """One motion in two descriptions: the wave twice over, every order doubled."""
    osc = gp.Oscillator(mesh_frequency=0.9, error_phase=0.4, harmonics=[(2, 0.02, 1.0)])
    wave = osc.stiffness
    edges = np.array(wave.edges)
    twice = gp.StiffnessWave(tuple((np.concatenate([edges, 1.0 + edges]) / 2.0).tolist()), wave.levels * 2)
    slow = gp.Oscillator(
        mesh_frequency=0.45, error_amplitude=0.0, stiffness=twice, harmonics=[(2, 0.2, 0.4), (4, 0.02, 1.0)]
    )
    there, here = gp.stroboscopic_map(osc, 1.3, 0.1, 2), gp.stroboscopic_map(slow, 1.3, 0.1, 1)
    assert np.allclose(there, here, rtol=0.0, atol=1e-13)


@pytest.mark.slow
def test_continuation_and_sweeps_see_them():
    """A branch's orbits are fixed points of 70 digits; a sweep settles on them."""
    osc = LOADED.replace(mesh_frequency=1.7)
    state = gp.steady_state(osc)
    branch = gp.continue_orbit(gp.periodic_orbit(osc, *state.points[0], state.period), "mesh_frequency", 1.68, 1.72)
    for i in (0, len(branch.values) // 2, -1):
        there = osc.replace(mesh_frequency=float(branch.values[i]))
        x, v = branch.points[i, 0]
        for _ in range(state.period):
            expected = mpmath_period(there, x, v)
            x, v = float(expected.x), float(expected.v)
        assert np.allclose((x, v), branch.points[i, 0], rtol=0.0, atol=1e-11)
    diagram = gp.sweep(osc, "mesh_frequency", [1.69, 1.7], seeding="restart")
    assert diagram.x.values[1, 0] == pytest.approx(state.points[0, 0], abs=1e-12)


def test_integrators_honour_them():
    expected = gp.trajectory(LOADED, 1.0, 0.0, 2)
    drawn = integrated_trajectory(LOADED, 1.0, 0.0, 2, method="DOP853", rtol=1e-11, atol=1e-12)
    assert np.abs(drawn.x - expected.x).max() < 1e-6
    section = runge_kutta_section(LOADED, 1.0, 0.0, 2, rtol=1e-10, atol=1e-10)
    assert np.abs(section[:, 0] - expected.x[::128]).max() < 1e-6


def test_a_block_takes_its_cells_in_one_step():
    """The cells of five harmonics are narrower, the blocks that the walk takes are those of one."""
    many, one = LOADED.cells, gp.Oscillator().cells
    assert len(many.level) > 2 * len(one.level) and len(many.block_width) == len(one.block_width) == len(one.level)
    assert np.allclose(many.block_width, one.block_width, rtol=1e-15)
    assert np.array_equal(one.block_maps, one.maps)


def test_the_spread_of_a_block_bounds_the_distance_to_its_cubic():
    """The certificate rests on it: X over a block lies within the spread of the cubic Hermite interpolant."""
    rng = np.random.default_rng(1)
    for _ in range(20):
        osc, _x, _v = random_case(rng)
        osc = with_harmonics(rng, osc).replace(mean_force=0.0)
        cells = osc.cells
        b = int(rng.integers(len(cells.block_width)))
        first, last = cells.blocks[b], cells.blocks[b + 1]
        x, v = rng.normal(0.0, 50.0, 2)  # far out: contact throughout
        region = 1 if x > 0 else -1
        row = cells.block_maps[b, region + 1]
        spread = row[6] * abs(x - region) + row[7] * abs(v) + row[8]
        width, s, errors = cells.block_width[b], 0.0, []
        x1, v1 = row[0] * x + row[1] * v + row[2], row[3] * x + row[4] * v + row[5]
        here = x, v
        for j in range(first, last):
            cell = cells.maps[j, region + 1]
            s = (j - first) / (last - first)
            h00, h10 = (1 + 2 * s) * (1 - s) ** 2, s * (1 - s) ** 2
            h01, h11 = s * s * (3 - 2 * s), s * s * (s - 1)
            cubic = h00 * x + h10 * width * v + h01 * x1 + h11 * width * v1
            errors.append(abs(here[0] - cubic))
            here = (
                cell[0] * here[0] + cell[1] * here[1] + cell[2],
                cell[3] * here[0] + cell[4] * here[1] + cell[5],
            )
        assert np.allclose(here, (x1, v1), rtol=1e-12, atol=1e-11)
        assert max(errors) <= spread + 1e-12 * abs(x)


def test_certificates_know_the_whole_force():
    """Every segment's series has the stated bound, and its crossings are the trajectory's."""
    pieces = segments(LOADED, 1.0, 0.2, 2)
    crossings = sum(piece.crossing is not None for piece in pieces)
    assert crossings == len(gp.trajectory(LOADED, 1.0, 0.2, 2).impacts)
    for piece in pieces:
        fourth = np.polynomial.polynomial.polyder(piece.series, 4)
        t = np.linspace(0.0, piece.span, 20)
        assert np.abs(np.polynomial.polynomial.polyval(t, fourth)).max() <= piece.fourth * (1 + 1e-9)


@pytest.mark.parametrize(
    "harmonics, sentence",
    [
        ([(1, 0.1, 0.0)], r"harmonics\[0\] order must be a whole number of at least 2, got 1"),
        ([(2, -0.1, 0.0)], r"harmonics\[0\] amplitude must be a finite number at least 0, got -0.1"),
        ([(2, 0.1), (3, 0.1, np.nan)], r"harmonics\[1\] phase must be a finite number, got nan"),
        ([(2000, 0.1, 0.0)], r"harmonics\[0\] order must be a finite number at most 200, got 2000"),
        ([3], r"harmonics\[0\] must be \(order, amplitude, phase\), got 3"),
    ],
)
def test_bad_harmonics_get_a_sentence(harmonics, sentence):
    with pytest.raises(ValueError, match=sentence):
        gp.Oscillator(harmonics=harmonics)
