"""Periodic orbits and exponents against finite differences, identities and the linear theory."""

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.cycle import map_at
from gearpair.motion.same_orbit import lies_on
from gearpair.motion.stability import multipliers_of
from tests.support import always_in_contact
from tests.support.oscillators import BASELINE, CONTACT, SWAPPED


@pytest.mark.parametrize("frequency", [0.7, 0.95, 1.219, 1.6])
@pytest.mark.parametrize("n", [1, 3])
def test_monodromy_is_the_derivative_of_the_map(frequency, n):
    """Central differences of the stroboscopic map, away from grazing, to their own O(h^2) error."""
    osc = BASELINE.replace(mesh_frequency=frequency)
    x, v = gp.stroboscopic_map(osc, 1.0, 0.0, 300)
    exact = np.empty((2, 2))
    map_at(osc.coefficients, float(x), float(v), n, exact)
    h = 1e-6
    right = np.array(gp.stroboscopic_map(osc, [x + h, x], [v, v + h], n))
    left = np.array(gp.stroboscopic_map(osc, [x - h, x], [v, v - h], n))
    assert np.allclose((right - left) / (2 * h), exact, rtol=0, atol=1e-7 * np.abs(exact).max())


@pytest.mark.parametrize("osc", [BASELINE, SWAPPED.replace(mesh_frequency=1.3), BASELINE.replace(damping_ratio=0.0)])
def test_orbits_are_closed_and_contract_as_they_must(osc):
    """map^period(point) = point; the multipliers' product is exp(-2 zeta period T); the period is minimal."""
    orbits = gp.find_orbits(osc, 4, n_starts=150)
    assert {orbit.period for orbit in orbits} >= {1, 2, 3}
    for orbit in orbits:
        assert orbit.converged and orbit.residual < 1e-11
        product = np.exp(-2.0 * osc.damping_ratio * orbit.period * osc.period)
        # The determinant cancels among entries of the size of the larger multiplier.
        assert abs(np.prod(orbit.multipliers) - product) < 1e-12 * max(1.0, abs(orbit.multipliers[0])) ** 2
        ahead = np.array(gp.stroboscopic_map(osc, orbit.points[:, 0], orbit.points[:, 1])).T
        assert np.allclose(ahead, np.roll(orbit.points, -1, axis=0), rtol=0, atol=1e-10)
        separation = np.abs(orbit.points[1:] - orbit.points[0]).max(axis=1)
        assert np.all(separation > 1e-6)


def test_orbits_are_found_once():
    """No two orbits of a search share a section point."""
    orbits = gp.find_orbits(BASELINE, 3, n_starts=200)
    firsts = np.concatenate([orbit.points for orbit in orbits])
    apart = np.abs(firsts[:, None] - firsts[None]).max(axis=2) + np.eye(len(firsts))
    assert apart.min() > 1e-7


def test_extremes_and_contacts_of_an_orbit_are_those_of_its_trajectory():
    """Densely sampled X stays within the extremes and comes as near to them as its sampling allows."""
    for orbit in gp.find_orbits(BASELINE, 3, n_starts=100):
        motion = gp.trajectory(BASELINE, *orbit.points[0], orbit.period, samples_per_period=4000)
        assert orbit.x_min <= motion.x.min() + 1e-9 and motion.x.max() - 1e-9 <= orbit.x_max
        # Between samples h apart an extremum is missed by h^2 max|X''| / 8.
        step = BASELINE.period / 4000
        assert motion.x.min() - orbit.x_min < step**2 and orbit.x_max - motion.x.max() < step**2
        begun = motion.impacts.side[motion.impacts.contact]
        assert orbit.contacts == (np.sum(begun == 1), np.sum(begun == -1))


@pytest.mark.parametrize("frequency", [1.2, 1.5, 1.9, 2.4])
def test_always_in_contact_the_orbit_is_that_of_the_linear_equation(frequency):
    """With a large mean force the flank is never left: point, monodromy and multipliers in closed form, to rounding."""
    osc = CONTACT.replace(mesh_frequency=frequency, error_phase=0.4)
    orbit = gp.periodic_orbit(osc, 5.0, 0.0, 1)
    assert orbit.converged and orbit.impact_state == "none_drive" and orbit.contacts == (0, 0)
    assert orbit.points[0] == pytest.approx(always_in_contact.section_point(osc), abs=1e-12)
    exact = always_in_contact.monodromy(osc)
    assert np.allclose(orbit.monodromy, exact, rtol=0, atol=1e-13)
    assert np.allclose(np.poly(orbit.multipliers), [1.0, -np.trace(exact), np.linalg.det(exact)], rtol=0, atol=1e-13)
    assert np.abs(orbit.multipliers[0]) >= np.abs(orbit.multipliers[1])
    motion = gp.trajectory(osc, *orbit.points[0], 1, samples_per_period=400)
    assert orbit.x_min <= motion.x.min() + 1e-12 and motion.x.max() <= orbit.x_max + 1e-12


@pytest.mark.parametrize("distance", [1e-3, 1e-5, 1e-8])
def test_an_orbit_is_stable_just_to_the_edge_of_the_tongue(distance):
    """The parametric tongue's edges are exact: the orbit is stable outside, unstable inside, however near."""
    lower, upper = always_in_contact.edges(CONTACT, -1.0, "mesh_frequency", 1.5, 2.6)
    for frequency, stable in (
        (lower - distance, True),
        (lower + distance, False),
        (upper - distance, False),
        (upper + distance, True),
    ):
        orbit = gp.periodic_orbit(CONTACT.replace(mesh_frequency=frequency), 5.0, 0.5, 1)
        assert orbit.converged and orbit.stable is stable


def test_a_period_is_minimal_and_a_start_on_any_point_leads_to_the_same_orbit():
    """Asked for twice the period from each of its points, Newton's method gives the orbit, lowest point first."""
    for orbit in gp.find_orbits(BASELINE, 3, n_starts=100):
        assert np.argmin(orbit.points[:, 0]) == 0
        if np.abs(orbit.multipliers[0]) < 100.0:
            for x, v in orbit.points:
                again = gp.periodic_orbit(BASELINE, x, v, 2 * orbit.period)
                assert again.period == orbit.period
                assert np.allclose(again.points, orbit.points, rtol=0, atol=1e-9)


def test_orbits_are_one_where_a_section_point_is():
    """A millionth decides, whichever point of the orbit it is."""
    points = np.array([[0.1, 0.2], [0.5, -0.3]])
    assert lies_on([0.5 + 0.9e-6, -0.3 - 0.9e-6], points) and lies_on([0.1, 0.2], points)
    assert not lies_on([0.5 + 1.1e-6, -0.3], points) and not lies_on([0.5, -0.3 - 1.1e-6], points)
    assert not lies_on([0.1, -0.3], points)


def test_multipliers_of_known_matrices():
    """Eigenvalues of a rotation, a saddle and a near-singular matrix, the largest modulus first."""
    turn = np.array([[0.0, -0.5], [0.5, 0.0]])
    saddle = np.array([[-3.0, 1.0], [0.0, 0.2]])
    assert np.allclose(multipliers_of(turn), [0.5j, -0.5j])
    assert np.allclose(multipliers_of(saddle), [-3.0, 0.2])
    assert np.allclose(multipliers_of(np.array([turn, saddle])), [[0.5j, -0.5j], [-3.0, 0.2]])
    nearly_singular = np.array([[1.0, 1.0], [1.0, 1.0 + 1e-12]])  # the small one is the determinant over the large
    assert multipliers_of(nearly_singular)[1] == pytest.approx(0.5e-12, rel=1e-3)


def test_a_search_that_fails_says_so_and_describes_no_orbit():
    """From afar at an unstable frequency Newton's method ends without an orbit: nothing has a stability there."""
    orbit = gp.periodic_orbit(BASELINE.replace(mesh_frequency=1.219), 300.0, 100.0, 7)
    assert not orbit.converged and orbit.status == "diverged" and "find_orbits" in orbit.status.remedy
    described = (orbit.stable, orbit.impact_state, orbit.multipliers, orbit.monodromy, orbit.x_min, orbit.x_max)
    assert described == (None,) * 6 and orbit.contacts is None and orbit.motion is None
    assert orbit.points.shape == (1, 2) and orbit.residual > 1e-3 and orbit.period == 7
    assert str(orbit).startswith("no orbit of period 7: Newton's method did not converge")
    with pytest.raises(ValueError, match="must have converged, got status 'diverged'"):
        gp.continue_orbit(orbit, "mesh_frequency", 1.2, 1.3)


def test_an_orbit_prints_what_it_is():
    """One line: stability, period, impact state, a point, multipliers."""
    stable = gp.periodic_orbit(BASELINE, 0.34, -0.25, 2)
    assert str(stable).startswith("stable orbit of period 2, single_drive, through X = 0.34629, X' = -0.25625: ")
    unstable = next(o for o in gp.find_orbits(BASELINE, 1, n_starts=100) if not o.stable)
    assert str(unstable).startswith("unstable orbit of period 1, ")
    assert f"multipliers {unstable.multipliers[0].real:.4g} and" in str(unstable)


@pytest.mark.parametrize("osc", [BASELINE.replace(mesh_frequency=1.219), BASELINE.replace(mesh_frequency=1.5)])
def test_exponents_sum_to_minus_twice_the_damping(osc):
    """det M = exp(-2 zeta T) along any motion, chaotic ones included."""
    pair = gp.lyapunov_exponents(osc, 1.0, 0.0, 3000)
    assert pair[0] > 0.05 > pair[1]
    assert pair.sum() == pytest.approx(-2 * osc.damping_ratio, abs=1e-12)


def test_exponents_of_a_periodic_motion_are_its_multipliers_logarithms():
    """lambda = log|mu| / (period T) once the motion is on the orbit."""
    state = gp.steady_state(BASELINE)
    assert state.status == "periodic" and state.period == 2
    pair = gp.lyapunov_exponents(BASELINE, *state.points[0], 2000)
    expected = np.log(np.abs(state.multipliers)) / (2 * BASELINE.period)
    assert np.allclose(pair, expected, rtol=0, atol=1e-3)
    assert np.allclose(state.lyapunov_exponents, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: gp.periodic_orbit(BASELINE, 0.0, 0.0, 0), "period"),
        (lambda: gp.periodic_orbit(BASELINE, np.nan, 0.0, 1), "x"),
        (lambda: gp.periodic_orbit(BASELINE, [0.0, 1.0], 0.0, 1), "x and v"),
        (lambda: gp.find_orbits(BASELINE, 1, n_starts=0), "n_starts"),
        (lambda: gp.lyapunov_exponents(BASELINE, 0.0, 0.0, -1), "n_periods"),
    ],
)
def test_bad_input_is_named(call, named):
    with pytest.raises(ValueError, match=f"{named} must"):
        call()
