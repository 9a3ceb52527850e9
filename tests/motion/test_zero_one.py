"""The 0-1 test on maps whose nature is known, and on this model."""

import numpy as np
import pytest

import gearpair as gp


def logistic(r, n=2000):
    """The logistic map after a transient: chaotic at r = 4, of period 8 at 3.55, quasi-periodic never."""
    x, kept = 0.3, []
    for i in range(n + 500):
        x = r * x * (1 - x)
        if i >= 500:
            kept.append(x)
    return np.array(kept)


@pytest.mark.parametrize(
    ("series", "low", "high"),
    [
        (logistic(3.97), 0.95, 1.0),
        (logistic(3.55), -0.1, 0.1),
        (np.sin(np.arange(2000) * np.sqrt(2.0)), -0.1, 0.1),  # quasi-periodic: regular, though it never repeats
        (np.ones(500), -1e-12, 1e-12),
    ],
)
def test_known_series(series, low, high):
    assert low <= gp.motion.zero_one_test(series) <= high


def test_it_agrees_with_the_exponent_where_that_is_resolved():
    """Two independent judges of the same motions."""
    result = gp.sweep(gp.Oscillator(), "mesh_frequency", [0.72, 0.86, 1.02, 1.219, 1.3, 1.5], n_samples=2000)
    for status, x in zip(result.status.values, result.x.values, strict=True):
        assert (gp.motion.zero_one_test(x) > 0.5) == (status == "aperiodic")


@pytest.mark.parametrize(("values", "sentence"), [(np.ones(10), "at least 200"), ([np.nan] * 300, "finite")])
def test_bad_input_is_named(values, sentence):
    with pytest.raises(ValueError, match=sentence):
        gp.motion.zero_one_test(values)
