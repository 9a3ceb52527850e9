"""Attractors found once: their numbers, what they say of any start, and that these stay."""

import dataclasses

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

import gearpair as gp
from gearpair import ensembles, motion
from gearpair.ensembles.chaos import neighbours
from gearpair.ensembles.labelling import ESCAPES, LINGERS, UNKNOWN, numbers_of
from gearpair.motion.same_orbit import lies_on
from tests.support import always_in_contact
from tests.support.oscillators import level

BASELINE = gp.Oscillator()
CASES = {
    "several": BASELINE,
    "one flank": BASELINE.replace(mean_force=0.25),
    "chaos": BASELINE.replace(mesh_frequency=1.219),
    "transient chaos": BASELINE.replace(mesh_frequency=1.6),
    "no mean force": BASELINE.replace(mean_force=0.0, mesh_frequency=0.9),
    "unstable contact": BASELINE.replace(mesh_frequency=1.95, damping_ratio=0.001),
}
X, V = np.linspace(-3.7, 3.9, 8), np.linspace(-2.7, 2.8, 7)


@pytest.fixture(scope="module", params=CASES)
def found(request):
    return gp.attractors(CASES[request.param], 120)


def test_a_label_is_where_the_motion_settles(found):
    """By `steady_state`, which knows nothing beforehand: the same orbit, escape, or chaos."""
    x, v = np.random.default_rng(4).uniform((-4.0, -3.0), (4.0, 3.0), (25, 2)).T
    labels = found.label(x, v)
    for start, label in zip(zip(x, v, strict=True), labels.tolist(), strict=True):
        state = gp.steady_state(found.oscillator, *start)
        if label >= 0:
            own = found.by_number[label]
            assert (state.status, state.period) == (own.status, own.period)
            if state.period:
                np.testing.assert_allclose(own.points, state.points, rtol=1e-6, atol=1e-6)
        elif label == ESCAPES:
            assert state.status == "escaped"
        elif label == LINGERS:
            assert state.status == "aperiodic"  # alone it cannot know of the others
        else:
            assert not any(state.period and lies_on(state.points[0], own.points) for own in found if own.period)


def test_a_label_is_the_number_that_basins_give(found):
    plane = gp.basins(found.oscillator, X, V, attractors=found)
    labels = found.label(X, V[:, np.newaxis])
    known = np.isin(plane.attractor, found.numbers)
    np.testing.assert_array_equal(labels[known], plane.attractor.values[known])
    assert np.all(labels[~known] < 0)
    np.testing.assert_array_equal(labels == ESCAPES, plane.status == "escaped")
    np.testing.assert_array_equal(labels == LINGERS, plane.status == "transient")
    assert plane.attractor_number.values.tolist()[: len(found)] == list(found.numbers)
    assert float(plane.attractor_share.sum()) == pytest.approx(float((plane.attractor >= 0).mean()))


def test_basins_are_the_same_with_attractors_known_and_without(found):
    """But for the numbers; whoever finds them."""
    known, plain = gp.basins(found.oscillator, X, V, attractors=found), gp.basins(found.oscillator, X, V)
    for name in ("status", "period", "impact_state", "settling_time", "largest_displacement"):
        np.testing.assert_array_equal(known[name], plain[name], name)
    pairs = {*zip(plain.attractor.values.ravel().tolist(), known.attractor.values.ravel().tolist(), strict=True)}
    assert len(pairs) == len({one for one, _ in pairs}) == len({other for _, other in pairs})


def test_a_label_depends_on_its_start_alone(found):
    some = np.random.default_rng(5).uniform(-3.0, 3.0, (2, 2, 6))
    labels = found.label(*some)
    assert labels.shape == (2, 6) and labels.dtype == np.int64
    alone = [[found.label(float(x), float(v)) for x, v in zip(*row, strict=True)] for row in some.swapaxes(0, 1)]
    assert labels.tolist() == alone and isinstance(alone[0][0], int)
    np.testing.assert_array_equal(found.label(*found.starts.T), found.labels)


def test_the_section_points_lead_to_their_own_attractor(found):
    for number, state in found.by_number.items():
        if state.period:
            assert np.all(found.label(*state.points.T) == number)
    assert found.label(np.empty((0, 3)), 0.0).shape == (0, 3)


def test_a_file_labels_the_same(found, tmp_path):
    found.to_dataset().to_netcdf(tmp_path / "found.nc", engine="scipy")
    with xr.open_dataset(tmp_path / "found.nc") as result:
        again = gp.Attractors.from_dataset(result)
    assert again == found and hash(again) == hash(found)
    np.testing.assert_array_equal(again.label(X, V[:, np.newaxis]), found.label(X, V[:, np.newaxis]))
    assert again.table() == found.table()


def test_the_one_motion_of_a_linear_pair():
    osc = level(0.9, mean_force=4.0, damping_ratio=0.1, mesh_frequency=1.3)
    found = gp.attractors(osc, 40, x_reach=(3.0, 7.0))
    assert found.numbers == (0,) and found.shares.tolist() == [1.0]
    np.testing.assert_allclose(found[0].points[0], always_in_contact.section_point(osc), atol=1e-12)


def test_shares_are_those_of_the_same_random_starts():
    """`basin_stability` draws them alike; with the attractors given it numbers alike."""
    found = gp.attractors(BASELINE, 300, seed=7)
    plain = ensembles.basin_stability(BASELINE, 300, seed=7)
    np.testing.assert_array_equal(found.shares, plain.attractor_share)
    told = found.to_dataset()
    for name in plain.data_vars:
        if name != "attractor_share_error":
            np.testing.assert_array_equal(told[name], plain[name], name)
    few = gp.attractors(BASELINE, starts=[(1.0, 0.0)])
    known = ensembles.basin_stability(BASELINE, 300, seed=7, attractors=few)
    assert known.attractor_period[0] == 2
    assert float(known.attractor_share[0]) == float(plain.attractor_share[plain.attractor_period == 2][0])


def test_what_is_new_is_told_and_taken_in():
    few = gp.attractors(BASELINE, starts=[(1.0, 0.0)])
    assert few.numbers == (0,) and few[0].period == 2
    assert few.label([1.0, -2.0], [0.0, 1.5]).tolist() == [0, UNKNOWN]
    more = few.including(-2.0, 1.5)
    assert more.numbers == (0, 1) and more[0] == few[0] and more[1].period == 1
    assert more.label([1.0, -2.0], [0.0, 1.5]).tolist() == [0, 1] == more.labels.tolist()
    plane = gp.basins(BASELINE, [-2.0, 1.0], [0.0, 1.5], attractors=few)
    assert plane.attractor_number.values.tolist() == [0, 1] and int(plane.attractor.sel(x=-2.0, v=1.5)) == 1
    assert few.including([1.0, 1.1], 0.0).numbers == (0,)


def test_a_set_that_further_starts_leave_loses_its_number():
    """At 1.6 chaos lives 40 000 mesh periods: a start that stays for 3000 looks like an attractor, many do not."""
    osc, how = BASELINE.replace(mesh_frequency=1.6), {"n_watch": 3000}
    starts = np.random.default_rng(1).uniform(-2.0, 2.0, (60, 2))
    on_it = [start for start in starts if gp.steady_state(osc, *start, **how).status == "aperiodic"]
    few = gp.attractors(osc, starts=on_it[:1], **how)
    assert [str(each.motion.kind) for each in few] == ["chaos"] and few.label(*on_it[0]) == 0
    more = few.including(*starts.T)
    assert 0 not in more.numbers and list(more.ended) == [0] and min(more.numbers) == 1
    assert more.label(*on_it[0]) == LINGERS
    assert few.label(*on_it[0]) == 0  # what was found before does not change


def test_numbers_stay_along_a_parameter():
    """As `continue_attractors` has them, step by step."""
    values = [0.02, 0.021, 0.1, 0.021]
    shares = ensembles.continue_attractors(BASELINE, "damping_ratio", values, n=120)
    found = gp.attractors(BASELINE, 120)
    for i, value in enumerate(values):
        found = found if i == 0 else found.follow("damping_ratio", value)
        there = np.flatnonzero(shares.share[i].notnull()).tolist()
        assert list(found.numbers) == there and found.oscillator.damping_ratio == value
        np.testing.assert_array_equal(found.shares, shares.share[i, there])
        np.testing.assert_array_equal(found.columns["period"], shares.attractor_period[i, there])
        assert set(found.ended) == set(range(numbers_of(found).unused)) - set(found.numbers)
        np.testing.assert_array_equal(found.label(*found.starts.T), found.labels)
    there = shares.share.notnull().values
    assert there[2].sum() < there[1].sum() and np.array_equal(there[1], there[3])  # those of 0.021 are back


def test_a_continuation_goes_on_with_the_numbers_of_attractors():
    found = gp.attractors(BASELINE, starts=[(1.0, 0.0), (-2.0, 1.5)]).including([1.0], [0.0])
    turned = dataclasses.replace(found, numbers=(3, 5))
    shares = ensembles.continue_attractors(BASELINE, "damping_ratio", [0.0201, 0.021], n=60, attractors=turned)
    assert shares.attractor_period[:, [3, 5]].values.tolist() == [[1, 2]] * 2
    assert np.all(np.isnan(shares.share[:, :3]))
    np.testing.assert_allclose(shares.share.sum("attractor"), 1.0)


def test_numbers_with_gaps_everywhere():
    """After attractors have ended the rest keep their numbers, in every result."""
    found = gp.attractors(BASELINE, 60).follow("damping_ratio", 0.05).follow("damping_ratio", 0.02)
    found = dataclasses.replace(found, numbers=tuple(2 * number + 1 for number in found.numbers))
    plane = gp.basins(BASELINE, X, V, attractors=found)
    np.testing.assert_array_equal(plane.attractor, found.label(X, V[:, np.newaxis]))
    assert plane.attractor_number.values.tolist() == list(found.numbers)
    np.testing.assert_array_equal(plane.attractor_period.sel(attractor_number=plane.attractor), plane.period)
    assert gp.plotting.basins(plane).collections[0].get_array().max() <= len(found)
    watched = gp.survival(BASELINE, X, 0.5, n_periods=1000, attractors=found)
    np.testing.assert_array_equal(watched.attractor, found.label(X, 0.5))
    assert watched.attractor_number.values.tolist() == list(found.numbers)
    assert float(watched.attractor_share.sum()) == 1.0
    for number, state in found.by_number.items():
        assert int(watched.attractor_period.sel(attractor_number=number)) == state.period


def test_a_store_has_the_numbers_and_is_of_these_attractors(tmp_path):
    pytest.importorskip("zarr")
    found = gp.attractors(BASELINE, 60)
    turned = dataclasses.replace(found, numbers=tuple(number + 4 for number in found.numbers))
    stored = ensembles.decoded(gp.basins(BASELINE, X, V, attractors=turned, store=tmp_path / "plane"))
    assert stored.drop_attrs().equals(gp.basins(BASELINE, X, V, attractors=turned).drop_attrs())
    for other in (None, found):
        with pytest.raises(ValueError, match="was made with another attractors"):
            gp.basins(BASELINE, X, V, attractors=other, store=tmp_path / "plane")


def test_what_was_seen_of_chaos_counts_for_basins():
    """A plane of few starts, alone, knows little of how long chaos lives; with what was found before it knows more."""
    found = gp.attractors(CASES["transient chaos"], 120)
    alone = gp.basins(found.oscillator, X[:3], V[:3])
    known = gp.basins(found.oscillator, X[:3], V[:3], attractors=found)
    seen = sum(int(rate.watched_periods) for rate in found.sets.rates)
    assert int(known.set_watched_periods.sum()) == int(alone.set_watched_periods.sum()) + seen
    np.testing.assert_array_equal(known.status == "transient", known.status != "periodic")


def test_further_starts_do_not_count_what_was_seen_twice():
    osc = CASES["transient chaos"]
    found = gp.attractors(osc, 60)
    more = found.including(X, 0.5)
    whole = gp.attractors(osc, starts=more.starts)
    for name in ("motions", "watched", "periods", "escapes"):
        assert getattr(more.sets.observed, name).sum() == getattr(whole.sets.observed, name).sum()


def test_chaos_that_is_known_to_last_is_not_watched_again():
    found = gp.attractors(CASES["chaos"], 200)
    plane = gp.basins(found.oscillator, X, V, attractors=found)
    still = plane.lasted.values[plane.status == "aperiodic"]
    assert still.size > 20 and np.all(still == found.settings.before_watch(found.oscillator))


def test_a_neighbour_differs_by_one_at_most():
    marks = np.array([[0, 0, 0], [5, 5, 5]])
    assert neighbours(marks, np.array([[1, -1, 1], [4, 5, 5], [2, 0, 0], [5, 5, 5]])).tolist() == [0, 1, -1, 1]
    assert neighbours(marks[:0], marks).tolist() == [-1, -1]


@given(st.floats(0.02, 1.2), st.floats(0.01, 0.4), st.floats(0.3, 1.9), st.integers(0, 1000))
@hypothesis_settings(max_examples=25, deadline=None)
def test_any_oscillator_labels_its_own_starts(mean_force, damping_ratio, mesh_frequency, seed):
    osc = gp.Oscillator(mean_force=mean_force, damping_ratio=damping_ratio, mesh_frequency=mesh_frequency)
    found = gp.attractors(osc, 40, seed=seed, n_watch=2000)
    np.testing.assert_array_equal(found.label(*found.starts.T), found.labels)
    assert found.shares.sum() + np.mean(found.labels < 0) == pytest.approx(1.0)
    assert gp.Attractors.from_dataset(found.to_dataset()) == found
    plane = gp.basins(osc, X, V[:3], attractors=found, n_watch=2000)
    new = ~np.isin(plane.attractor, [*found.numbers, -1])
    labels = found.label(X, V[:3, np.newaxis])
    np.testing.assert_array_equal(np.maximum(labels, -1)[~new], plane.attractor.values[~new])
    assert np.all(labels[new] == UNKNOWN)


def test_a_sequence_that_is_told_in_a_line():
    found = gp.attractors(BASELINE, 200)
    assert len(found) == len(list(found)) == 4 and found[1] in found and found[:2] == tuple(found)[:2]
    assert [str(each.motion) for each in found] == list(map(str, found.kinds))
    assert found == gp.attractors(BASELINE, 200) and len({found, gp.attractors(BASELINE, 200)}) == 1
    assert found != gp.attractors(BASELINE, 201) and found != dataclasses.replace(found, numbers=(1, 2, 3, 4))
    assert "\n" not in repr(found) and repr(found).startswith("4 attractors of 200 starts; 0: period 1, double-sided (")
    assert gp.Oscillator.from_attrs(found.to_dataset()) == BASELINE


def test_where_everything_escapes_there_is_no_attractor():
    osc = CASES["unstable contact"].replace(damping_ratio=0.0)
    found = gp.attractors(osc, starts=[(50.0, 0.0), (80.0, 5.0)])
    assert len(found) == 0 and found.labels.tolist() == [ESCAPES] * 2 and found.label(60.0, 0.0) == ESCAPES
    assert found.label([60.0], 0.0).dtype == np.int64
    assert gp.Attractors.from_dataset(found.to_dataset()) == found
    assert found.table().rows == (("–", "escaped", "–", "–", "–", "1.000"),)
    assert np.all(gp.basins(osc, [60.0], [0.0], attractors=found).attractor == -1)


def test_the_table_tells_how_long_chaos_lives():
    table = gp.attractors(CASES["chaos"], 120).table()
    assert table.columns[-1] == "chaos"
    assert [row[-1].startswith("mean life at least 33") for row in table.rows] == [
        "chaos" in row[1] for row in table.rows
    ]
    assert gp.attractors(BASELINE, 20).table().columns[-1] == "share"


def test_bad_input_gets_a_sentence():
    found = gp.attractors(BASELINE, starts=[(1.0, 0.0)])
    other = BASELINE.replace(mesh_frequency=0.71)
    for call in (
        lambda: gp.basins(other, X, V, attractors=found),
        lambda: gp.survival(other, X, 0.0, attractors=found),
        lambda: ensembles.basin_stability(other, 10, attractors=found),
        lambda: ensembles.continue_attractors(other, "mesh_frequency", [0.72], n=10, attractors=found),
    ):
        with pytest.raises(
            ValueError, match="attractors must be those of this oscillator, .*0.71.* got those of .*0.7,"
        ):
            call()
    with pytest.raises(ValueError, match="starts must be pairs of finite numbers, one at least, got shape"):
        gp.attractors(BASELINE, starts=[1.0, 2.0])
    with pytest.raises(ValueError, match="x must be finite, got nan"):
        found.label(np.nan, 0.0)
    with pytest.raises(ValueError, match="shapes that broadcast, got shapes"):
        found.label([0.0] * 2, [0.0] * 3)
    with pytest.raises(ValueError, match="x and v must hold one start at least"):
        found.including([], [])
    with pytest.raises(ValueError, match="unknown parameter 'speed'"):
        found.follow("speed", 1.0)
    with pytest.raises(ValueError, match="mesh_frequency must be a finite number above 0, got -1.0"):
        found.follow("mesh_frequency", -1.0)
    with pytest.raises(ValueError, match="nearest must be a finite number above 0, got 0.0"):
        found.follow("mesh_frequency", 0.71, nearest=0)
    with pytest.raises(
        TypeError, match="attractors must be None or an Attractors, as|attractors must be an Attractors"
    ):
        gp.basins(BASELINE, X, V, attractors=found[0])
    with pytest.raises(TypeError, match="hand over its oscillator"):
        gp.steady_state(found)
    plane = gp.basins(BASELINE, [0.0], [0.0])
    with pytest.raises(ValueError, match="a dataset of Attractors.to_dataset"):
        gp.Attractors.from_dataset(plane)
    with pytest.raises(ValueError, match="needs a dataset that holds 'kept_status'"):
        gp.Attractors.from_dataset(found.to_dataset().drop_vars("kept_status"))
    assert motion.CHAOS not in found
