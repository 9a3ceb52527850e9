"""Manifolds: straight lines where the map is linear, and the boundary of a basin where it is not."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import backward_map, growing
from gearpair.boundaries.growing import length_of
from gearpair.boundaries.sides import Sides
from tests.support import always_in_contact
from tests.support.oscillators import BASELINE

SADDLE = gp.periodic_orbit(BASELINE, -1.5688, -1.0135, 1)


@pytest.fixture(scope="module")
def found():
    return gp.manifolds(SADDLE, length=40.0)


def linear(frequency):
    """Always in contact far beyond the backlash, with a wave deep enough to be parametrically unstable.

    The transmission error cancels most of the resonance, so that 100 to either side the contact does not end.
    """
    wave = gp.StiffnessWave((0.0, 0.5), (1.6, 0.4))
    error = 1000.0 if frequency < 1.0 else 0.0
    return gp.Oscillator(mean_force=1000.0, error_amplitude=error, mesh_frequency=frequency, stiffness=wave)


def off(curve, polyline):
    """How far each point of a curve is from a polyline."""
    a, b = polyline[:-1], polyline[1:]
    good = np.isfinite(a).all(axis=1) & np.isfinite(b).all(axis=1)
    a, along = a[good], (b - a)[good]
    square = np.maximum((along**2).sum(axis=1), 1e-300)
    distances = []
    for point in curve[np.isfinite(curve).all(axis=1)]:
        share = np.clip(((point - a) * along).sum(axis=1) / square, 0.0, 1.0)
        distances.append(np.hypot(*(a + share[:, None] * along - point).T).min())
    return np.array(distances)


@pytest.mark.parametrize("frequency, sign", [(1.9, -1.0), (0.97, 1.0)])
def test_those_of_a_linear_saddle_are_straight_lines(frequency, sign):
    osc = linear(frequency)
    centre, (values, vectors) = always_in_contact.section_point(osc), np.linalg.eig(always_in_contact.monodromy(osc))
    assert np.all(np.sign(values) == sign) and np.abs(values).max() > 1.0 > np.abs(values).min()
    orbit = gp.periodic_orbit(osc, *centre.tolist(), 1)
    np.testing.assert_allclose(orbit.points[0], centre, rtol=1e-12)
    x, v = centre[:, None] + np.array([-50.0, 50.0])
    lines = gp.manifolds(orbit, x=tuple(x), v=tuple(v), spacing=1.0, length=60.0)
    for curves, k in ((lines.unstable, np.abs(values).argmax()), (lines.stable, np.abs(values).argmin())):
        ends = []
        for curve in curves:
            across = (curve - centre) @ np.array([-vectors[1, k], vectors[0, k]])
            assert np.abs(across).max() < 1e-9
            along = (curve - centre) @ vectors[:, k]
            assert np.all(np.diff(np.abs(along)) > 0.0)  # outwards, point by point
            assert length_of(curve) == pytest.approx(60.0, abs=1.0)
            ends.append(np.sign(along[-1]))
        assert sorted(ends) == [-1.0, 1.0]


@pytest.mark.parametrize("offset", [1e-6, 1e-9, 1e-12])
def test_the_stable_one_separates_the_basins(found, offset):
    """At every tenth point, a start on one side settles elsewhere than one on the other."""
    sides = Sides(BASELINE, (-2.3365, 1.5426), {})
    n = 0
    for curve in found.stable:
        along = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
        across = along[:, ::-1] * (1.0, -1.0) / np.hypot(*along.T)[:, None]
        rows = np.arange(10, len(curve) - 1, 10)
        rows = rows[np.isfinite(curve[rows]).all(axis=1) & np.isfinite(across[rows]).all(axis=1)]
        points, offsets = curve[rows], offset * across[rows]
        assert np.all(sides.at_home(points + offsets) != sides.at_home(points - offsets))
        n += len(rows)
    assert n > 250


def test_each_is_mapped_onto_itself(found):
    finer = gp.manifolds(SADDLE, length=42.0, spacing=0.005)
    for name, mapped in (("unstable", gp.stroboscopic_map), ("stable", backward_map)):
        for curve, fine in zip(getattr(found, name), getattr(finer, name), strict=True):
            inner = curve[1 : len(curve) // 40 : 8]  # whose images are on what was grown
            image = np.column_stack(mapped(BASELINE, *inner.T))
            assert len(image) > 6 and off(image, fine).max() < 0.005 / 80.0


def test_neighbours_are_near_and_chords_nearly_the_curve(found):
    finer = gp.manifolds(SADDLE, length=25.0, spacing=0.002)
    for name in ("stable", "unstable"):
        for curve, fine in zip(getattr(found, name), getattr(finer, name), strict=True):
            assert np.nanmax(np.hypot(*np.diff(curve, axis=0).T)) <= found.spacing
            np.testing.assert_array_equal(curve[0], SADDLE.points[0])
            assert off(fine[::120], curve).max() < 0.02 / 40.0


def test_motions_approach_the_saddle_on_one_and_come_from_it_on_the_other():
    """Until rounding has taken over, which grows with the other multiplier."""
    short = gp.manifolds(SADDLE, length=5.0)
    for curves, mapped in ((short.stable, gp.stroboscopic_map), (short.unstable, backward_map)):
        for curve in curves:
            ways = [np.column_stack(mapped(BASELINE, *curve[::10].T, n)) for n in range(20)]
            assert np.min([np.hypot(*(way - SADDLE.points[0]).T) for way in ways], axis=0).max() < 1e-5


def test_the_unstable_one_ends_on_the_motion_that_it_leads_to(found):
    (to_focus,) = [curve for curve in found.unstable if curve[-1, 0] < -2.0]
    focus = gp.steady_state(BASELINE, -2.3365, 1.5426).points[0]
    assert np.hypot(*(to_focus[-1] - focus)) < 1e-3


def test_those_of_a_longer_orbit_begin_at_each_of_its_points_and_are_mapped_on():
    osc = BASELINE.replace(mesh_frequency=1.219)
    orbit = gp.periodic_orbit(osc, -1.5395, -0.79663, 2)
    found = gp.manifolds(orbit, length=6.0, spacing=0.01)
    assert len(found.stable) == len(found.unstable) == 4
    for k in range(4):
        np.testing.assert_array_equal(found.stable[k][0], orbit.points[k // 2])
        np.testing.assert_array_equal(found.unstable[k][0], orbit.points[k // 2])
    for curves, multiplier in ((found.stable, orbit.multipliers[1]), (found.unstable, orbit.multipliers[0])):
        for curve in curves[:2]:  # along the eigenvector of the whole cycle
            way = (curve[1] - curve[0]) / np.hypot(*(curve[1] - curve[0]))
            np.testing.assert_allclose(orbit.monodromy @ way, multiplier.real * way, rtol=0.0, atol=1e-7)
    first = np.concatenate([curve[: len(curve) // 20] for curve in found.unstable[:2]])
    image = np.column_stack(gp.stroboscopic_map(osc, *first.T))
    assert off(image, np.concatenate([found.unstable[2][::-1], found.unstable[3]])).max() < 0.01 / 80.0


def test_limits_of_length_and_points_are_kept_and_told(found):
    assert not found.complete
    short = gp.manifolds(SADDLE, length=2.0)
    for curve in (*short.stable, *short.unstable):
        assert 2.0 <= length_of(curve) < 2.0 + short.spacing
    few = gp.manifolds(SADDLE, max_points=300)
    assert not few.complete
    for curve in (*few.stable, *few.unstable):
        assert 150 < len(curve) <= 305 and np.nanmax(np.hypot(*np.diff(curve, axis=0).T)) <= few.spacing
    assert repr(short).startswith(
        "manifolds of the orbit of period 1 at X = -1.5688, X' = -1.0135: stable of length 4."
    )


def test_one_image_begins_where_the_last_one_ends():
    """Followed for long in chaos, too, where a difference in the last digit would have grown to more than a chord."""
    osc = BASELINE.replace(mesh_frequency=1.219)
    found = gp.manifolds(gp.periodic_orbit(osc, 1.00827, -0.33902, 1), spacing=0.2, length=4000.0)
    for curve in (*found.stable, *found.unstable):
        assert np.nanmax(np.hypot(*np.diff(curve, axis=0).T)) <= found.spacing * (1.0 + 1e-9)


def test_a_curve_ends_where_rounding_parts_neighbours(monkeypatch):
    """As it would at the usual begin after a length of some millions."""
    monkeypatch.setattr(growing, "BEGIN", 1e-14)
    found = gp.manifolds(SADDLE, length=40.0)
    assert not found.complete
    for curve in (*found.stable, *found.unstable):
        assert length_of(curve) < 30.0 and np.nanmax(np.hypot(*np.diff(curve, axis=0).T)) <= found.spacing


def test_a_curve_that_leaves_the_window_is_complete():
    osc = linear(0.97)
    x, v = always_in_contact.section_point(osc).tolist()
    window = {"x": (x - 5.0, x + 5.0), "v": (v - 5.0, v + 5.0)}
    found = gp.manifolds(gp.periodic_orbit(osc, x, v, 1), **window, spacing=0.1)
    assert found.complete
    for curve in (*found.stable, *found.unstable):
        reach = np.abs(curve - (x, v)).max()
        assert 10.0 <= reach <= 10.1  # to twice the window, and one chord on


def test_what_is_no_saddle_is_refused():
    stable = gp.periodic_orbit(BASELINE, 0.34629, -0.25625, 2)
    with pytest.raises(ValueError, match="must be a saddle, with one multiplier outside the unit circle, got: stable"):
        gp.manifolds(stable)
    with pytest.raises(ValueError, match="must be a saddle.*did not converge"):
        gp.manifolds(gp.periodic_orbit(BASELINE, 300.0, 100.0, 7))
    with pytest.raises(
        TypeError, match="orbit must be a PeriodicOrbit, as gearpair.periodic_orbit gives it; got a Ste"
    ):
        gp.manifolds(gp.steady_state(BASELINE))
    with pytest.raises(ValueError, match="x must be two finite numbers in rising order, got"):
        gp.manifolds(SADDLE, x=(1.0, -1.0))
