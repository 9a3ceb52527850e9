"""Chaos that ends and chaos that lasts: the baseline's, with starts and times that were found by marching on."""

import numpy as np
import pytest

import gearpair as gp
from gearpair import _cores
from gearpair._flow.walk import TOO_MANY_EVENTS
from gearpair.ensembles import capture, lifetimes
from gearpair.ensembles.escape_rates import escape_rate
from gearpair.ensembles.planes import RATES

X, V = (a.ravel() for a in np.meshgrid(np.linspace(-3.0, 3.0, 7), np.linspace(-2.0, 2.0, 5)))
ENDING = gp.Oscillator(mesh_frequency=1.09)
LASTING = gp.Oscillator(mesh_frequency=1.219)


@pytest.fixture(scope="module")
def ending():
    return gp.survival(ENDING, X, V)


def test_all_chaos_at_1_09_ends_on_one_period_2(ending):
    """Times are those of a chaotic motion, and not the same under another rounding: what holds is their scale."""
    assert ending.attractor_period.values.tolist() == [2]
    assert 500 < ending.escape_time.max() < 15_000 and int(ending.survivors[-1]) == 0
    assert set(ending.status.values) == {"periodic"} and set(ending.attractor.values) == {0}
    state = gp.steady_state(ENDING, float(ending.attractor_x[0]), float(ending.attractor_v[0]))
    assert abs(state.multipliers[0]) == pytest.approx(0.79, abs=0.005)
    assert ending.attractor_share.values.tolist() == ending.escape_share.values.tolist() == [1.0]
    assert (str(ending.persistence.values), ending.discard, ending.n_periods) == ("transient", 500, 20_000)


def test_the_mean_life_at_1_09_is_some_two_thousand_periods():
    """A half-life of 1371 periods, 1247 to 1511 at 95 %, with 600 starts; here 35, and odds of a failure of 10^-4."""
    result = gp.survival(ENDING, X, V, confidence=0.9999)
    assert result.mean_life_low.item() < 1371.0 / np.log(2.0) < result.mean_life_high.item()
    assert result.mean_life_high.item() < 6.0 * result.mean_life_low.item()


def test_a_captured_start_is_on_its_orbit_for_ever(ending):
    orbit = gp.steady_state(ENDING, float(ending.attractor_x[0]), float(ending.attractor_v[0])).points
    _known, watched, later = lifetimes.watched_starts(ENDING, np.column_stack([X, V]), 20_000)
    np.testing.assert_array_equal(watched.periods, ending.escape_time)
    assert np.all(watched.owner >= 0) and len(later.status) == 0
    apart = np.abs(watched.points[:, np.newaxis] - orbit).max(axis=2).min(axis=1)
    after = np.stack(gp.stroboscopic_map(ENDING, *watched.points.T, 400), axis=1)
    assert 1e-6 < apart.max() < 0.2
    assert np.abs(after[:, np.newaxis] - orbit).max(axis=2).min(axis=1).max() < 1e-9


def test_the_estimate_is_that_of_the_times(ending):
    estimate = escape_rate(ending.escape_time.values, 20_000, discard=500)
    for name in RATES:
        assert ending[name].item() == getattr(estimate, name), name
    times = ending.escape_time.values
    assert estimate.escapes == np.sum(times > 500) and estimate.watched_periods == (times[times > 500] - 500).sum()
    for waited, survivors in zip(ending.waited.values, ending.survivors.values, strict=True):
        assert survivors == np.sum(times > waited)
    assert {0, 500, 20_000} <= set(ending.waited.values)


def test_chaos_at_1_219_lasts_as_long_as_it_is_watched():
    """24 of the starts; the others are on a period 2 beside it within 46 periods."""
    result = gp.survival(LASTING, X, V, n_periods=3000)
    left = np.isnan(result.escape_time.values)
    assert (left.sum(), int(result.survivors[-1]), result.n_watched.item()) == (24, 24, 24)
    assert result.escape_time.max() < 100.0 and result.attractor_period.values.tolist() == [2]
    assert np.array_equal(result.attractor.values, np.where(left, -1, 0))
    assert set(result.status.values[left]) == {"aperiodic"}
    assert (str(result.persistence.values), result.escapes.item(), result.mean_life.item()) == ("lasting", 0, np.inf)
    assert result.mean_life_low.item() == pytest.approx(24 * 2500 / 3.0, rel=2e-3)
    assert result.attractor_share.item() == pytest.approx(11 / 35) and result.escape_share.item() == 0.0
    assert "at least" in result.persistence.attrs["remedy"]


def test_chaos_at_1_6275_lives_for_some_hundred_periods():
    """A half-life of 557 periods, 486 to 640, with 600 starts."""
    result = gp.survival(gp.Oscillator(mesh_frequency=1.6275), X, V, confidence=0.9999)
    assert int(result.survivors[-1]) == 0 and set(result.attractor_period.values) == {2, 6}
    assert result.mean_life_low.item() < 557.0 / np.log(2.0) < result.mean_life_high.item()
    assert result.escape_share.values.sum() == pytest.approx(1.0)


def test_what_goes_straight_to_its_attractor_is_no_transient():
    result = gp.survival(gp.Oscillator(damping_ratio=0.1), X[::5], V[::5], n_periods=600)
    assert (str(result.persistence.values), result.n_watched.item(), result.watched_periods.item()) == ("direct", 0, 0)
    assert np.isnan(result.mean_life.item()) and (result.mean_life_low.item(), result.mean_life_high.item()) == (
        0.0,
        np.inf,
    )
    assert result.escape_time.max() < 500.0 and result.escape_share.values.tolist() == [0.0]


def test_a_motion_beyond_all_bounds_has_gone_but_to_no_attractor():
    escaping = gp.Oscillator(mesh_frequency=1.95, damping_ratio=0.001)
    result = gp.survival(escaping, [3e5, 2e5], 0.0, n_periods=3000, discard=0)
    assert result.attractor.values.tolist() == [-2, -2] and result.status.values.tolist() == ["escaped"] * 2
    x, _v = gp.stroboscopic_map(escaping, 3e5, 0.0, int(result.escape_time[0]))
    assert np.isinf(x) and str(result.persistence.values) == "transient"


def test_an_attractor_that_the_scouts_miss_is_found_where_the_others_have_come_to(monkeypatch):
    """Without scouts nothing is known: all are watched to the end, and then again from their start."""
    starts = dict(x=[-2.0, 1.0, 2.0], v=[1.5, 0.0, -1.0])
    monkeypatch.setattr(lifetimes, "scouts", lambda n: np.arange(n))
    scouted = gp.survival(gp.Oscillator(), **starts, n_periods=1000)
    monkeypatch.setattr(lifetimes, "scouts", lambda n: np.arange(0))
    found = gp.survival(gp.Oscillator(), **starts, n_periods=1000)
    assert found.attractor_period.values.tolist() == [1, 2]
    for name in ("attractor", "escape_time"):
        np.testing.assert_array_equal(found[name], scouted[name])
    assert np.isfinite(found.escape_time).all()


def test_a_cycle_without_a_neighbourhood_captures_what_is_as_good_as_on_it(ending, monkeypatch):
    monkeypatch.setattr(capture, "surround_rows", lambda *_: 0)
    chosen = [0, 7, 20]
    result = gp.survival(ENDING, X[chosen], V[chosen])
    later = result.escape_time.values - ending.escape_time.values[chosen]
    assert result.attractor_period.values.tolist() == [2] and np.all((later > 0.0) & (later < 200.0))


def test_a_motion_that_leaves_soon_after_the_watch_makes_the_set_a_transient(ending):
    """Three starts that all live longer than the watch, one of them hardly."""
    order = np.argsort(ending.escape_time.values)
    late = order[-3:]
    n_periods = int(ending.escape_time[late[0]]) - 30
    result = gp.survival(ENDING, X[late], V[late], n_periods=n_periods)
    assert result.escapes.item() == 0 and int(result.survivors[-1]) == 3
    assert "periodic" in result.status.values and str(result.persistence.values) == "transient"
    assert result.mean_life_low.item() == pytest.approx(3 * (n_periods - 500) / 3.0, rel=2e-3)


def test_shapes_broadcast_and_threads_change_nothing(monkeypatch):
    result = gp.survival(ENDING, np.array([[0.0], [1.0]]), np.array([-1.0, 0.0, 1.0]), n_periods=2000)
    assert result.start_x.values.tolist() == [0.0] * 3 + [1.0] * 3
    assert result.start_v.values.tolist() == [-1.0, 0.0, 1.0] * 2
    monkeypatch.setattr(_cores.config, "NUMBA_NUM_THREADS", 1)
    monkeypatch.setattr(lifetimes, "AT_ONCE", 300)  # in spans, the last one shorter
    again = gp.survival(ENDING, np.array([[0.0], [1.0]]), np.array([-1.0, 0.0, 1.0]), n_periods=2000)
    assert again.identical(result)


def test_ctrl_c_ends_it(monkeypatch):
    def stop(*_):
        raise KeyboardInterrupt

    for name, place in (("watch_starts", lifetimes), ("settle_lanes", gp.motion.settling)):
        with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
            patch.setattr(place, name, stop)
            gp.survival(ENDING, 0.0, 0.0, n_periods=1000)


def test_a_walk_that_is_capped_is_an_error_with_a_remedy(monkeypatch):
    def cap(first, last, cells, neighbourhoods, n_periods, watched):
        watched.status[last - 1] = TOO_MANY_EVENTS

    monkeypatch.setattr(lifetimes, "watch_starts", cap)
    with pytest.raises(RuntimeError, match=r"start x = 1.0, v = 0.0: more than .* raise mesh_frequency"):
        gp.survival(ENDING, [0.0, 1.0], 0.0, n_periods=1000)


def test_it_tells_beforehand_the_most_that_it_may_take(capsys):
    gp.survival(gp.Oscillator(), [0.0, 1.0], 0.0, n_periods=1000, progress=True)
    assert "at most 2.0e+03 mesh periods: " in capsys.readouterr().err


def test_along_a_parameter_each_value_is_a_survival_of_its_own():
    values = [1.09, 1.219]
    along = gp.ensembles.survival_along(gp.Oscillator(), "mesh_frequency", values, X[::6], V[::6], n_periods=2500)
    for i, value in enumerate(values):
        alone = gp.survival(gp.Oscillator(mesh_frequency=value), X[::6], V[::6], n_periods=2500)
        for name in (*RATES, "persistence"):
            assert along[name].values[i] == alone[name].values[()], name
        assert (along.survivors[i], along.discarded[i]) == (alone.survivors[-1], alone.discard)
    assert along.mean_life.dims == ("mesh_frequency",) and along.mean_life.attrs["units"] == "1"


def test_the_mean_life_at_1_6_is_many_times_that_at_1_6275_and_the_intervals_know():
    along = gp.ensembles.survival_along(gp.Oscillator(), "mesh_frequency", [1.6275, 1.6], X, V)
    assert along.mean_life_high[0] < along.mean_life_low[1]
