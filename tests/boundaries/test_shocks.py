"""The smallest shock leaves the basin, no smaller one does, and it is the distance to the stable manifold."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import at_phase
from gearpair.boundaries.sides import Sides
from tests.support.oscillators import BASELINE

STATE = gp.steady_state(BASELINE, -2.3365, 1.5426)  # period 1, double-sided, whose basin has a smooth boundary


@pytest.fixture(scope="module")
def on_section():
    return gp.critical_shock(BASELINE, STATE, n_phases=1)


@pytest.fixture(scope="module")
def found():
    return gp.critical_shock(BASELINE, STATE, n_phases=8)


def test_it_is_the_distance_to_the_stable_manifold_of_the_saddle(on_section):
    saddle = gp.periodic_orbit(BASELINE, -1.5688, -1.0135, 1)
    boundary = np.concatenate(gp.manifolds(saddle, length=20.0, spacing=0.002).stable)
    apart = np.hypot(*(boundary - on_section.start).T)
    nearest = int(np.nanargmin(apart))
    assert on_section.size == pytest.approx(apart[nearest], rel=1e-6)
    # At right angles to the boundary: of the curve's points a few to either side, the chord.
    chord = boundary[nearest + 5] - boundary[nearest - 5]
    assert abs(on_section.kick @ chord) < 3e-3 * on_section.size * np.hypot(*chord)
    assert (on_section.phase, on_section.size) == (0.0, pytest.approx(np.hypot(*on_section.kick), rel=1e-15))
    np.testing.assert_array_equal(on_section.start, STATE.points[0])


@pytest.mark.parametrize("share", [1e-6, 1e-9, 1e-11])
def test_a_little_more_leaves_and_a_little_less_does_not(found, share):
    section = at_phase(BASELINE, found.phase % 1.0)
    more, less = (gp.steady_state(section, *(found.start + (1.0 + s) * found.kick)) for s in (share, -share))
    home = gp.steady_state(section, *found.start)
    assert more.motion != home.motion == less.motion
    assert found.leads_to.motion == more.motion or share != 1e-9  # it is told for a billionth


def test_no_smaller_kick_of_many_leaves(found):
    rng = np.random.default_rng(1)
    angles, sizes = rng.uniform(0.0, 2.0 * np.pi, 4000), found.size * np.sqrt(rng.uniform(0.0, 0.999, 4000))
    sides = Sides(at_phase(BASELINE, found.phase % 1.0), found.start, {})
    kicks = sizes[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    assert sides.at_home(found.start + kicks).all()
    assert not sides.at_home(found.start + 1.2 * found.size / sizes[:, None] * kicks).all()


def test_the_phase_is_that_of_the_smallest_and_the_start_is_on_the_motion(found):
    assert found.phases.tolist() == [k / 8 for k in range(8)]
    np.testing.assert_allclose(np.hypot(*found.kicks.T), found.sizes, rtol=1e-14)
    best = int(np.argmin(found.sizes))
    assert found.phase == found.phases[best] == 0.375
    assert found.size == pytest.approx(found.sizes[best], rel=2e-4)
    way = gp.trajectory(BASELINE, *STATE.points[0], 1, samples_per_period=8)
    np.testing.assert_allclose(found.start, (way.x[best], way.v[best]), rtol=0.0, atol=1e-12)


def test_an_impulse_changes_the_velocity_alone_and_has_to_be_larger(found):
    impulse = gp.critical_shock(BASELINE, STATE, kick="velocity", n_phases=8)
    assert abs(impulse.kick[0]) < 1e-15 and np.all(np.abs(impulse.kicks[:, 0]) < 1e-15)
    assert np.all(impulse.sizes >= found.sizes * (1.0 - 2e-4)) and impulse.size > 1.05 * found.size
    start = impulse.start + (1.0 - 1e-6) * impulse.kick
    assert gp.steady_state(at_phase(BASELINE, impulse.phase), *start).period == 1


def test_a_motion_of_period_two_has_twice_the_moments():
    state = gp.steady_state(BASELINE)
    found = gp.critical_shock(BASELINE, state, n_phases=2, n_directions=8)
    assert found.phases.tolist() == [0.0, 0.5, 1.0, 1.5]
    if found.phase in (0.0, 1.0):
        np.testing.assert_array_equal(found.start, state.points[int(found.phase)])
    assert found.size < 0.2  # the basins of period 3 and 5 are strewn over its own


def test_the_mirror_image_takes_the_mirrored_kick(on_section):
    mirrored = BASELINE.replace(mean_force=-BASELINE.mean_force, error_phase=BASELINE.error_phase + np.pi)
    state = gp.steady_state(mirrored, 2.3365, -1.5426)
    other = gp.critical_shock(mirrored, state, n_phases=1)
    assert other.size == pytest.approx(on_section.size, rel=1e-10)
    np.testing.assert_allclose(other.kick, -on_section.kick, rtol=0.0, atol=1e-4)


def test_where_all_starts_settle_alike_no_kick_leaves():
    osc = BASELINE.replace(damping_ratio=0.2)
    found = gp.critical_shock(osc, gp.steady_state(osc), n_phases=2, n_directions=4)
    assert np.isinf(found.size) and found.leads_to is None and np.isnan(found.kick).all()
    assert repr(found) == "no kick of those tried at 2 phases leaves the basin"


def test_only_a_settled_motion_of_this_oscillator_can_be_shocked():
    with pytest.raises(ValueError, match="state must be periodic and stable, got period 1, double-sided"):
        gp.critical_shock(BASELINE, gp.periodic_orbit(BASELINE, -1.5688, -1.0135, 1))
    chaos = BASELINE.replace(mesh_frequency=1.219)
    with pytest.raises(ValueError, match="state must be periodic and stable, got chaos"):
        gp.critical_shock(chaos, gp.steady_state(chaos, n_watch=100))
    with pytest.raises(ValueError, match="must be a motion of the oscillator that is given"):
        gp.critical_shock(chaos, STATE)
    with pytest.raises(ValueError, match="kick must be one of 'any', 'velocity', got 'both'"):
        gp.critical_shock(BASELINE, STATE, kick="both")
    with pytest.raises(TypeError, match="state must be a SteadyState or a PeriodicOrbit, as gearpair.steady_state"):
        gp.critical_shock(BASELINE, (0.3, 0.2))
