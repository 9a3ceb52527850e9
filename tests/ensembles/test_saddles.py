"""The points of a chaotic saddle: far from both ends of the motions they are of."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.ensembles import chaotic_saddle

OSC = gp.Oscillator(mesh_frequency=1.09)  # chaos with a mean life of 2100 mesh periods
X, V = (grid.ravel() for grid in np.meshgrid(np.linspace(-2.0, 2.0, 6), np.linspace(-1.5, 1.5, 6)))


@pytest.fixture(scope="module")
def found():
    return chaotic_saddle(OSC, X, V, n_periods=3000, n_after=300)


def points_of(result):
    return np.column_stack([result.x.values, result.v.values])


def test_every_point_is_of_a_motion_that_has_come_and_is_not_about_to_leave(found):
    """The first and the last point of each motion are there, and nothing beyond; without thinning out, all between."""
    life = gp.survival(OSC, X, V, n_periods=3000).escape_time.values
    lived = np.where(np.isnan(life), 3000, life).astype(int)
    used = lived >= 350
    assert (found.attrs["n_starts"], found.attrs["n_used"]) == (36, used.sum())
    assert found.attrs["n_lasting"] == np.isnan(life).sum() and 0 < np.isnan(life).sum() < used.sum() < 36
    whole = chaotic_saddle(OSC, X, V, n_periods=3000, n_after=300, n_points=10**6)
    assert whole.sizes["point"] == (lived[used] - 350 + 1).sum()
    points, at = points_of(whole), 0
    for x, v, n in zip(X[used], V[used], lived[used], strict=True):
        np.testing.assert_array_equal(points[at], np.array(gp.stroboscopic_map(OSC, x, v, 50)))
        at += n - 350 + 1
        np.testing.assert_array_equal(points[at - 1], np.array(gp.stroboscopic_map(OSC, x, v, int(n) - 300)))


def test_thinned_out_they_are_some_of_all(found):
    few = chaotic_saddle(OSC, X, V, n_periods=3000, n_after=300, n_points=500)
    assert 450 < few.sizes["point"] <= 500 + 36
    assert set(map(tuple, points_of(few))) <= set(map(tuple, points_of(found))) | set(
        map(tuple, points_of(chaotic_saddle(OSC, X, V, n_periods=3000, n_after=300, n_points=10**6)))
    )


def test_unstable_orbits_are_embedded_and_the_attractors_are_not(found):
    points = points_of(found)

    def nearest(orbit):
        return max(np.hypot(*(points - point).T).min() for point in orbit.points)

    apart = {stable: [nearest(o) for o in gp.find_orbits(OSC, 2) if o.stable is stable] for stable in (True, False)}
    assert min(apart[False]) < 5e-3 and sum(each < 2e-2 for each in apart[False]) >= 3
    assert min(apart[True]) > 1e-3


def test_where_no_start_lasts_there_are_no_points():
    damped = gp.Oscillator(damping_ratio=0.1)
    empty = chaotic_saddle(damped, [0.0, 1.0], 0.5)
    assert empty.sizes["point"] == 0 == empty.attrs["n_used"]


def test_bad_times_are_refused():
    with pytest.raises(ValueError, match=r"n_periods must be at least n_before \+ n_after = 550, got 500"):
        chaotic_saddle(OSC, 0.0, 0.0, n_periods=500)
    with pytest.raises(ValueError, match="must hold one start at least"):
        chaotic_saddle(OSC, [], [])
