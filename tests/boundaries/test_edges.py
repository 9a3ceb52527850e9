"""The edge state is the saddle on the boundary between two basins."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries.sides import UNBOUNDED, Sides
from gearpair.motion.same_orbit import lies_on
from tests.support.oscillators import BASELINE

DOUBLE, SINGLE = (-2.3365, 1.5426), (0.34629, -0.25625)  # near the motions of period 1 and 2
SADDLE = (-1.5688, -1.0135)


@pytest.fixture(scope="module")
def found():
    return gp.edge_state(BASELINE, DOUBLE, SINGLE)


def test_the_boundary_leads_to_the_saddle_that_newton_finds(found):
    saddle = gp.periodic_orbit(BASELINE, *SADDLE, 1)
    assert found.status == "periodic" and found.orbit.period == 1
    np.testing.assert_allclose(found.orbit.points, saddle.points, rtol=0.0, atol=1e-12)
    large, small = np.abs(found.orbit.multipliers)
    assert large > 1.0 > small
    assert found.exponent == pytest.approx(np.log(large) / BASELINE.period, rel=1e-14)
    assert [str(side.motion) for side in found.sides] == ["period 1, double-sided", "period 2, single-sided"]
    assert repr(found) == f"between period 1, double-sided and period 2, single-sided, after {found.tracked} mesh " + (
        f"periods: {saddle!r}"
    )


def test_it_is_approached_at_the_rate_of_the_smaller_multiplier(found):
    assert len(found.points) == found.tracked + 1
    apart = np.hypot(*(found.points - found.orbit.points[0]).T)
    small = abs(found.orbit.multipliers[1])
    np.testing.assert_allclose(apart[5:8] / apart[4:7], small, rtol=5e-3)
    assert apart[-1] < 1e-6


def test_all_that_was_tracked_is_on_the_boundary():
    """For so long that the two starts beside it had to be brought together again: within 2e-7 both sides are found."""
    osc, start = BASELINE.replace(mesh_frequency=2.0), (-3.0, -0.5)
    found = gp.edge_state(osc, start, (-1.5, -0.5))
    assert found.tracked > 40 and found.orbit.period == 3
    rate = np.log(np.abs(found.orbit.multipliers[0])) / (3.0 * osc.period)
    assert found.exponent == pytest.approx(rate, rel=1e-14)
    sides = Sides(osc, start, {})
    angles = np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False)
    for point in found.points:
        around = sides.at_home(point + 2e-7 * np.column_stack([np.cos(angles), np.sin(angles)]))
        assert around.any() and not around.all()


def test_motions_may_be_given_instead_of_starts(found):
    states = gp.steady_state(BASELINE, *DOUBLE), gp.steady_state(BASELINE, *SINGLE)
    assert lies_on(gp.edge_state(BASELINE, *states).orbit.points[0], found.orbit.points)


def test_the_other_way_round_it_is_the_boundary_of_the_other_basin(found):
    """Period 2 shares its side with motions of period 3 and 5: the first boundary from there is with one of these."""
    other = gp.edge_state(BASELINE, SINGLE, DOUBLE)
    assert str(other.sides[0].motion) == "period 2, single-sided"
    assert other.sides[1].period in (3, 5) and not lies_on(other.orbit.points[0], found.orbit.points)
    large, small = np.abs(other.orbit.multipliers)
    assert large > 1.0 > small


def test_the_mirror_image_has_the_mirrored_saddle(found):
    mirrored = BASELINE.replace(mean_force=-BASELINE.mean_force, error_phase=BASELINE.error_phase + np.pi)
    other = gp.edge_state(mirrored, -np.array(DOUBLE), -np.array(SINGLE))
    np.testing.assert_allclose(other.orbit.points, -found.orbit.points, rtol=0.0, atol=1e-11)


def test_the_boundary_between_chaos_and_a_period_two_leads_to_a_saddle_of_period_two():
    osc = BASELINE.replace(mesh_frequency=1.219)
    found = gp.edge_state(osc, (1.0, 0.0), (-2.2116, -0.0777), n_watch=1000)
    assert str(found.sides[0].motion.kind) == "chaos" and found.orbit.period == 2
    assert lies_on(found.orbit.points[0], gp.periodic_orbit(osc, -1.5395, -0.79663, 2).points)


def test_what_escapes_has_a_boundary_too():
    osc = BASELINE.replace(mesh_frequency=1.85)  # beyond it contact is parametrically unstable
    assert Sides(osc, (500.0, 0.0), {}).home == UNBOUNDED
    found = gp.edge_state(osc, (500.0, 0.0), (1.0, 0.0))
    assert (found.sides[0].status, found.sides[1].period) == ("escaped", 1)
    assert found.orbit.period == 2 and np.abs(found.orbit.multipliers[0]) == pytest.approx(1.753, abs=1e-3)
    assert found.orbit.x_min < -3.0 and found.orbit.x_max > 3.0


def test_a_boundary_may_be_chaotic_itself():
    """From within, the first boundary at 1.85 is that of a motion of period 4, which never repeats."""
    found = gp.edge_state(BASELINE.replace(mesh_frequency=1.85), (1.0, 0.0), (500.0, 0.0), n_periods=300)
    assert (found.status, found.orbit, found.tracked) == ("unsettled", None, 300)
    assert 0.02 < found.exponent < 0.1 and len(found.points) == 301


def test_a_boundary_that_has_not_repeated_is_no_orbit(found):
    early = gp.edge_state(BASELINE, DOUBLE, SINGLE, n_periods=4)
    assert (early.status, early.orbit, early.tracked) == ("unsettled", None, 4)
    assert "raise n_periods" in early.status.remedy and "no periodic orbit" in repr(early)
    np.testing.assert_array_equal(early.points, found.points[:5])
    assert early.exponent == pytest.approx(found.exponent, rel=0.05)  # the mean of the third and fourth period


def test_what_settles_on_one_motion_has_no_boundary_between():
    with pytest.raises(ValueError, match="different motions, got period 2, single-sided from both"):
        gp.edge_state(BASELINE, SINGLE, (0.3, -0.2))
    with pytest.raises(ValueError, match=r"b must be X and X', or a settled motion, got shape \(3,\)"):
        gp.edge_state(BASELINE, SINGLE, (0.3, -0.2, 1.0))
