"""The homoclinic tangency: where chaos ends, by manifolds, by where motions settle, and by how long they live."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import homoclinic_tangency, tangencies
from gearpair.boundaries.growing import branches_at
from gearpair.boundaries.tangencies import crossing_places
from tests.support.oscillators import BASELINE

OSC = BASELINE.replace(mesh_frequency=1.219, damping_ratio=0.011)
SADDLE = gp.periodic_orbit(OSC, -0.29164, -1.2262, 2)  # between chaos and the period 2 through (-0.81348, -1.0812)
RANGE = ("damping_ratio", 0.0105, 0.0115)


@pytest.fixture(scope="module")
def found():
    return homoclinic_tangency(SADDLE, *RANGE, length=10.0, spacing=0.05)


def leaving(damping_ratio, n):
    """How many of `n` points of a piece of the unstable branch on the side of chaos settle on the period 2.

    By their motions alone: no manifold is grown, neither of the two is looked at.
    """
    osc = OSC.replace(damping_ratio=damping_ratio)
    saddle = gp.periodic_orbit(osc, *SADDLE.points[0].tolist(), 2)
    values, vectors = np.linalg.eig(saddle.monodromy)
    along = vectors[:, np.argmax(np.abs(values))]
    growth = np.abs(values).max() ** np.linspace(0.0, 1.0, n, endpoint=False)
    points = saddle.points[0] + 1e-7 * growth[:, None] * along * np.sign(along[0])
    ends = gp.stroboscopic_map(osc, *points.T, 2 * 12 + 130)
    settled = np.ones(n, bool)
    for _ in range(2):  # so that none counts which only passes by
        ends = gp.stroboscopic_map(osc, *ends, 30)
        away = [np.hypot(ends[0] - x, ends[1] - v) for x, v in gp.periodic_orbit(osc, -0.81348, -1.0812, 2).points]
        settled &= np.min(away, axis=0) < 0.2
    return int(settled.sum())


@pytest.mark.slow
def test_the_value_does_not_depend_on_the_chords_the_length_or_the_range(found):
    assert found.status == "located" and not found.crosses_above and found.error < 1e-11
    longer = homoclinic_tangency(SADDLE, "damping_ratio", 0.0108, 0.0119, length=20.0)
    assert longer.status == "located"
    assert found.value == pytest.approx(longer.value, abs=1e-11)
    assert found.value == pytest.approx(0.01110903505, abs=1e-10)


@pytest.mark.slow
def test_below_it_the_unstable_branch_reaches_the_other_motion_and_above_it_not(found):
    """As much of it as a parabola has beyond its tangent: the square root of the distance from the value."""
    assert leaving(found.value + 1e-6, 20_000) == 0
    few, more = (leaving(found.value - distance, 20_000) for distance in (1e-6, 1e-5))
    assert few > 30 and more / few == pytest.approx(np.sqrt(10.0), rel=0.1)


def test_at_it_the_curves_touch_and_are_on_one_side_of_each_other(found):
    """The point lies on both; the signed distance of the unstable curve from the stable one has one sign about it."""
    window = np.array([(-4.0, 4.0), (-3.0, 3.0)])
    curves = {"unstable": [], "stable": []}
    for k in range(2):
        for name, branch in branches_at(found.orbit, k, window, 0.005):
            curves[name].append(branch.grown(10.0, 100_000)[0])
    near = {name: [c[np.hypot(*(c - found.point).T) < 0.03] for c in each] for name, each in curves.items()}
    for each in near.values():
        assert min(np.hypot(*(c - found.point).T).min() for c in each if len(c)) < 0.005
    stable = max(near["stable"], key=len)
    unstable = min((c for c in near["unstable"] if len(c)), key=lambda c: np.hypot(*(c - found.point).T).min())
    along = stable[-1] - stable[0]
    along /= np.hypot(*along)
    across = np.array([-along[1], along[0]])
    t, height = (stable - found.point) @ along, (stable - found.point) @ across
    bend = np.polynomial.Polynomial.fit(t, height, 3)
    gaps = (unstable - found.point) @ across - bend((unstable - found.point) @ along)
    assert np.abs(gaps).max() > 1e-4  # they part
    assert gaps.max() < 1e-5 or gaps.min() > -1e-5  # to one side


@pytest.mark.slow
def test_chaos_is_a_transient_below_it_and_lasts_above(found):
    """The crisis: the nearer to it, the longer the lives."""
    x, v = np.linspace(-0.5, 2.0, 12)[:, None], np.linspace(-1.0, 0.5, 8)
    lives = []
    for damping_ratio in (0.0095, 0.0103, found.value + 1e-4):
        result = gp.survival(OSC.replace(damping_ratio=damping_ratio), x, v, n_periods=5000)
        estimate = gp.ensembles.lifetimes.estimate_of(result)
        lives.append((estimate.escapes, estimate.mean_life))
    assert lives[0][0] > 50 and lives[1][0] > 5 and lives[2][0] == 0
    assert lives[1][1] > 3.0 * lives[0][1]


@pytest.mark.slow
def test_without_a_solution_the_bracket_is_told(monkeypatch):
    monkeypatch.setattr(tangencies, "STEPS", 0)
    found = homoclinic_tangency(SADDLE, *RANGE, length=10.0, spacing=0.05)
    assert found.status == "bracketed" and np.isnan(found.point).all() and "raise the length" in found.status.remedy
    assert abs(found.value - 0.01110903505) < found.error + 0.01 * 0.001
    assert found.error == pytest.approx(0.001 / 2**13)


def test_crossings_of_two_curves():
    """A circle and a line that cuts it twice, a gap, and places that run along."""
    angle = np.linspace(0.1, 6.0, 2001)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    line = np.column_stack([np.linspace(-2.0, 2.0, 301), np.full(301, 0.5)])
    line[250] = np.nan
    places = crossing_places(circle, angle, line, line[:, 0])
    np.testing.assert_allclose(np.sort(places[:, 0]), np.array([1.0, 5.0]) * np.pi / 6.0, atol=1e-5)
    np.testing.assert_allclose(np.sort(places[:, 1]), np.array([-1.0, 1.0]) * np.sqrt(0.75), atol=1e-5)
    assert len(crossing_places(circle, angle, line + [0.0, 1.0], line[:, 0])) == 0


def test_what_has_no_tangency_is_refused():
    above = gp.periodic_orbit(OSC.replace(damping_ratio=0.0113), *SADDLE.points[0].tolist(), 2)
    with pytest.raises(ValueError, match="grown to 10.0, cross at neither, 0.0112 and 0.0115"):
        homoclinic_tangency(above, "damping_ratio", 0.0112, 0.0115, length=10.0)
    with pytest.raises(ValueError, match="cross at both"):
        homoclinic_tangency(SADDLE, "damping_ratio", 0.0105, 0.011, length=10.0)
    with pytest.raises(
        ValueError, match="the saddle must reach from lower to upper, got 0.0105 and 0.02: .* to 0.0180"
    ):
        homoclinic_tangency(SADDLE, "damping_ratio", 0.0105, 0.02)
    with pytest.raises(ValueError, match="orbit must be a saddle"):
        homoclinic_tangency(gp.periodic_orbit(OSC, -0.81348, -1.0812, 2), *RANGE)
    with pytest.raises(ValueError, match="length must be"):
        homoclinic_tangency(SADDLE, *RANGE, length=0.0)
