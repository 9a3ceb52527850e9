"""The exact flow against independent integrations, one mesh period at a time (chaos amplifies anything longer)."""

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.closed_form import TERMS
from gearpair._flow.walk import walk
from tests.support.oscillators import degenerate_cases, random_case
from tests.support.reference import dop853_period, mpmath_period

DEGENERATE = degenerate_cases()


@pytest.mark.parametrize("seed", range(8))
def test_random_oscillators_against_dop853_restarted_at_every_event(seed):
    rng = np.random.default_rng(seed)
    for _ in range(20):
        osc, x, v = random_case(rng)
        for _ in range(2):
            expected = dop853_period(osc, x, v)
            x, v = map(float, gp.stroboscopic_map(osc, x, v))
            scale = max(1.0, abs(x), abs(v))
            assert max(abs(x - expected[0]), abs(v - expected[1])) <= 1e-10 * scale, (osc, x, v)


@pytest.mark.parametrize("mesh_frequency", [0.7, 0.95, 1.219, 1.6])
def test_ordinary_parameters_against_seventy_digits(mesh_frequency):
    """1e-13 of max(1, |state|) times the map's own amplification of errors; we ask for a tenth of that."""
    osc = gp.Oscillator(mesh_frequency=mesh_frequency)
    x, v = 1.3, 0.2
    for _ in range(6):
        expected = mpmath_period(osc, x, v)
        x, v = map(float, gp.stroboscopic_map(osc, x, v))
        assert expected.error(x, v) <= 1e-14 * expected.amplification


@pytest.mark.parametrize("seed", range(6))
def test_random_oscillators_against_seventy_digits(seed):
    rng = np.random.default_rng(100 + seed)
    for _ in range(4):
        osc, x, v = random_case(rng)
        expected = mpmath_period(osc, x, v)
        assert expected.error(*map(float, gp.stroboscopic_map(osc, x, v))) <= 1e-13 * expected.amplification, (
            osc,
            x,
            v,
        )


@pytest.mark.parametrize("case", DEGENERATE, ids=DEGENERATE)
@pytest.mark.slow
def test_degenerate_cases_against_seventy_digits(case):
    """1e-11 is the promise; the series has no cancellation there, so that we ask for a hundredth of that."""
    osc, x, v = DEGENERATE[case]
    expected = mpmath_period(osc, x, v)
    error = expected.error(*map(float, gp.stroboscopic_map(osc, x, v)))
    assert error <= 1e-13 * expected.amplification
    assert error <= 1e-11


@pytest.mark.parametrize("seed", range(3))
def test_monodromy_against_seventy_digits(seed):
    rng = np.random.default_rng(200 + seed)
    for _ in range(4):
        osc, x, v = random_case(rng)
        expected = mpmath_period(osc, x, v)
        m = np.eye(2)
        status, x1, v1 = walk(osc.cells, x, v, 1, np.empty(TERMS), m)
        assert status == 0
        assert (x1, v1) == tuple(map(float, gp.stroboscopic_map(osc, x, v)))
        # A crossing at speed u moves in time by an error / u, and the matrix with it.
        slowest = min([1.0, *(abs(u) for _t, _side, u, _contact in expected.crossings)])
        truth = np.array(expected.monodromy.tolist(), dtype=float)
        np.testing.assert_allclose(
            m, truth, rtol=0.0, atol=1e-13 * expected.amplification**2 / slowest, err_msg=repr(osc)
        )
