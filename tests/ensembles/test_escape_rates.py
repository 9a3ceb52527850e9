"""Escape rates of maps that are known exactly, and how often the interval holds the true one."""

import math

import numpy as np
import pytest

from gearpair.ensembles import Persistence, escape_rate

NAN = float("nan")
GOLDEN = 0.5 * (1.0 + math.sqrt(5.0))


def tent_times(n, most, seed):
    """When points of the unit interval leave it under the tent map of slope 3; nan if not within `most` steps."""
    x, times = np.random.default_rng(seed).uniform(size=n), np.full(n, NAN)
    for step in range(1, most + 1):
        x = 3.0 * np.minimum(x, 1.0 - x)
        times[np.isnan(times) & (x > 1.0)] = step
    return times


def doubling_times(n, most, seed):
    """When points first fall into the hole [0, 1/4) of x -> 2x mod 1: two zeros in a row among their binary digits.

    The digits of a random number are random; doubling a float would lose them.
    """
    zero = np.random.default_rng(seed).integers(2, size=(n, most + 1)) == 0
    hole = zero[:, 1:] & zero[:, :-1]
    return np.where(hole.any(axis=1), hole.argmax(axis=1) + 1.0, NAN)


def test_the_tent_map_of_slope_three_loses_a_third_of_its_points_each_step():
    estimate = escape_rate(tent_times(20_000, 12, seed=1), 12)
    assert estimate.escape_rate == pytest.approx(math.log(1.5), rel=0.02)
    assert estimate.escape_rate_low < math.log(1.5) < estimate.escape_rate_high
    assert estimate.mean_life == pytest.approx(1.0 / math.log(1.5), rel=0.02)


def test_the_doubling_map_with_a_hole_loses_its_points_at_the_rate_of_the_golden_mean():
    """Words without two zeros in a row grow like phi^n among the 2^n of all; the first steps are those of the start."""
    true = math.log(2.0 / GOLDEN)
    estimate = escape_rate(doubling_times(40_000, 40, seed=2), 40, discard=6)
    assert estimate.escape_rate == pytest.approx(true, rel=0.02)
    assert estimate.escape_rate_low < true < estimate.escape_rate_high
    assert escape_rate(doubling_times(40_000, 40, seed=2), 40).escape_rate > 1.02 * true


@pytest.mark.parametrize(("mean", "discard"), [(700.0, 0), (700.0, 400), (8000.0, 500)])
def test_the_interval_holds_the_true_rate_as_often_as_it_says(mean, discard):
    """35 motions with exponential lives after a time of their own on the way, watched for 5000 periods."""
    rng, n, tries = np.random.default_rng(3), 35, 1500
    times = np.ceil(rng.exponential(mean, (tries, n)) + rng.integers(0, discard + 1, (tries, n)))
    times[times > 5000] = NAN
    estimates = [escape_rate(row, 5000, discard=discard) for row in times]
    held = np.mean([each.mean_life_low < mean < each.mean_life_high for each in estimates])
    assert 0.935 < held < 0.985
    beyond = (
        np.mean([each.mean_life_high < mean for each in estimates]),
        np.mean([each.mean_life_low > mean for each in estimates]),
    )
    assert max(beyond) < 0.04


def test_what_is_not_counted_does_not_count():
    """Gone before the end of `discard`, exactly at it, after it, and still there."""
    estimate = escape_rate([10, 100, 150, NAN], 300, discard=100)
    assert (estimate.n_watched, estimate.escapes, estimate.watched_periods) == (2, 1, 50 + 200)
    assert estimate.escape_rate == pytest.approx(-math.log1p(-1.0 / 250.0), rel=1e-14)
    each = escape_rate([NAN, NAN, 20], [100, 40, 60], discard=10)
    assert (each.n_watched, each.watched_periods) == (3, 90 + 30 + 10)


def test_the_interval_is_the_chi_square_interval_of_a_poisson_count_where_escapes_are_rare():
    from scipy.stats import chi2

    estimate = escape_rate([30_000, 50_000, *[NAN] * 8], 100_000)
    n = estimate.watched_periods
    assert estimate.escape_rate_low == pytest.approx(chi2.ppf(0.025, 4) / (2 * n), rel=1e-3)
    assert estimate.escape_rate_high == pytest.approx(chi2.ppf(0.975, 6) / (2 * n), rel=1e-3)


def test_without_an_escape_there_is_a_bound_which_is_the_rule_of_three():
    estimate = escape_rate([NAN] * 35, 20_000, discard=500)
    assert (estimate.escape_rate, estimate.escape_rate_low) == (0.0, 0.0)
    assert estimate.mean_life_low == pytest.approx(35 * 19_500 / -math.log(0.05), rel=1e-12)
    assert (estimate.mean_life, estimate.mean_life_high) == (math.inf, math.inf)
    assert estimate.persistence == Persistence.LASTING
    assert (
        "0 of 35 motions escaped in 682500 mesh periods watched: mean life at least 228000 mesh periods at 0.95"
        in str(estimate)
    )
    half = escape_rate([NAN] * 35, 20_000, discard=500, confidence=0.5)
    assert half.mean_life_low == pytest.approx(35 * 19_500 / math.log(2.0), rel=1e-12)


def test_that_all_escape_is_no_obstacle():
    estimate = escape_rate([700, 900, 1100], 5000)
    assert (estimate.escapes, estimate.watched_periods, estimate.persistence) == (3, 2700, Persistence.TRANSIENT)
    assert estimate.mean_life_low < 900.0 < estimate.mean_life_high < math.inf
    at_once = escape_rate([1, 1, 1], 5000)
    assert (at_once.escape_rate, at_once.escape_rate_high, at_once.mean_life) == (math.inf, math.inf, 0.0)
    assert 0.0 < at_once.escape_rate_low < 2.0 and at_once.mean_life_low == 0.0


def test_where_nothing_was_watched_it_says_so():
    estimate = escape_rate([3, 7], 1000, discard=7)
    assert (estimate.n_watched, estimate.watched_periods, estimate.escapes) == (0, 0, 0)
    assert math.isnan(estimate.escape_rate) and math.isnan(estimate.mean_life)
    assert (estimate.mean_life_low, estimate.mean_life_high) == (0.0, math.inf)
    assert estimate.persistence == Persistence.DIRECT and Persistence.DIRECT.remedy in str(estimate)
