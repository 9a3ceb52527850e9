"""Continuation against the linear theory, an independent method, and known ratios."""

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve

import gearpair as gp
from tests.reference import dop853_period
from tests.test_orbits import BASELINE, SWAPPED, floquet_trace


def orbit_of(osc, x=1.0, v=0.0):
    """The stable orbit that the motion from (x, v) settles on."""
    state = gp.steady_state(osc, x, v)
    assert state.status == "periodic"
    return gp.periodic_orbit(osc, *state.points[0], state.period)


@pytest.fixture(scope="module")
def printed_branch():
    """The baseline's period-2 branch, both ways from 0.7 to 1.19 and its flip at 1.6."""
    return gp.continue_orbit(orbit_of(BASELINE), "mesh_frequency", 0.6, 1.7)


def test_parametric_instability_begins_where_the_linear_theory_says():
    """Always in contact the flip of the period-1 orbit is the edge of the tongue: trace = -(1 + det), to 1e-5."""
    osc = gp.Oscillator(mean_force=50.0, error_amplitude=0.02, damping_ratio=0.02, mesh_frequency=2.6)

    def edge(omega):
        at = osc.replace(mesh_frequency=omega)
        return floquet_trace(at) + 1.0 + np.exp(-2 * at.damping_ratio * at.period)

    omegas = np.linspace(1.5, 2.6, 111)
    signs = np.sign([edge(omega) for omega in omegas])
    theory = [brentq(edge, *omegas[i : i + 2], xtol=1e-12) for i in np.flatnonzero(np.diff(signs))]
    assert len(theory) == 2
    branch = gp.continue_orbit(gp.periodic_orbit(osc, 50.0, 0.0, 1), "mesh_frequency", 1.5, 2.6)
    flips = sorted(b.value for b in branch.bifurcations if b.kind == "flip")
    assert {b.impact_state for b in branch.bifurcations} == {"none_drive"}
    assert np.allclose(flips, theory, rtol=0, atol=1e-8)


def test_a_branch_is_that_of_an_independent_solver(printed_branch):
    """fsolve on a DOP853 map, from a point a tenth of backlash off, finds the same orbit at four frequencies."""
    for omega in (0.72, 0.85, 0.95, 1.05):
        osc = BASELINE.replace(mesh_frequency=omega)
        i = int(np.argmin(np.abs(printed_branch.values - omega) + 10 * (printed_branch.contacts[:, 1] > 0)))
        here = gp.periodic_orbit(osc, *printed_branch.points[i, 0], 2)

        def residual(z, osc=osc):
            return np.subtract(dop853_period(osc, *dop853_period(osc, *z)), z)

        found = fsolve(residual, here.points[0] + [2e-3, -2e-3], xtol=1e-12)
        assert np.allclose(found, here.points[0], rtol=0, atol=1e-8)


def test_every_point_of_a_branch_is_an_orbit_with_the_right_determinant(printed_branch):
    """Residual at rounding, product of multipliers exp(-2 zeta p T), Newton steps few."""
    b = printed_branch
    product = np.exp(-2 * 0.02 * 2 * 2 * np.pi / b.values)
    size = np.maximum(1.0, np.abs(b.multipliers[:, 0]))
    assert np.max(np.abs(np.prod(b.multipliers, axis=1) - product) / size**2) < 1e-12
    for omega, point in zip(b.values[::20], b.points[::20, 0], strict=True):
        back = gp.stroboscopic_map(BASELINE.replace(mesh_frequency=omega), *point, 2)
        assert np.allclose(back, point, rtol=0, atol=1e-9)
    assert b.newton_steps.max() <= 12 and np.median(b.newton_steps) <= 4


def test_bifurcations_are_where_their_multipliers_say(printed_branch):
    """At a flip one multiplier is -1, at a fold +1, at a grazing an extremum is +-1: each to 1e-8 in the parameter."""
    kinds = [b.kind for b in printed_branch.bifurcations]
    assert {"fold", "flip", "grazing"} == set(kinds)
    for b in printed_branch.bifurcations:
        orbit = gp.periodic_orbit(b.oscillator, b.x, b.v, b.period)
        if b.kind == "grazing":
            motion = gp.trajectory(b.oscillator, b.x, b.v, b.period, samples_per_period=2000)
            turning = motion.x[1:-1][np.diff(np.sign(np.diff(motion.x))) != 0]
            assert np.min(np.abs(np.abs(turning) - 1.0)) < 1e-5  # sampled every T/2000: misses by h^2 X'' / 8
            assert abs(sum(b.contacts[0]) - sum(b.contacts[1])) == 1
        else:
            target = -1.0 if b.kind == "flip" else 1.0
            assert np.min(np.abs(orbit.multipliers - target)) < 1e-6


def test_beyond_a_grazing_multipliers_move_like_the_square_root():
    """Nordmark (1991): on the penetrating side |trace change| ~ |Omega - Omega_g|^(1/2), slope 0.5 in log-log."""
    branch = gp.continue_orbit(orbit_of(BASELINE.replace(mesh_frequency=1.06)), "mesh_frequency", 0.98, 1.06)
    grazing = next(b for b in branch.bifurcations if b.kind == "grazing")
    at = np.trace(gp.periodic_orbit(grazing.oscillator, grazing.x, grazing.v, 2).monodromy)
    inward = -1.0 if sum(grazing.contacts[0]) > sum(grazing.contacts[1]) else 1.0
    distances = np.logspace(-8, -5, 7)
    change = []
    for d in distances:
        osc = BASELINE.replace(mesh_frequency=grazing.value + inward * d)
        change.append(abs(np.trace(gp.periodic_orbit(osc, grazing.x, grazing.v, 2).monodromy) - at))
    slope = np.polyfit(np.log(distances), np.log(change), 1)[0]
    assert slope == pytest.approx(0.5, abs=0.05)
    # On the other side it moves smoothly: a thousandth of that at the smallest distance.
    outside = BASELINE.replace(mesh_frequency=grazing.value - inward * distances[0])
    smooth = abs(np.trace(gp.periodic_orbit(outside, grazing.x, grazing.v, 2).monodromy) - at)
    assert smooth < 1e-2 * change[0]


def test_a_doubled_branch_begins_and_ends_at_flips(printed_branch):
    """Followed both ways it merges with the orbit of half its period exactly at that orbit's flips."""
    flips = [b for b in printed_branch.bifurcations if b.kind == "flip" and b.contacts[0][1] == 0]
    doubled = gp.continue_orbit(gp.bifurcations.doubled_orbit(flips[0]), "mesh_frequency", 0.6, 1.7)
    assert doubled.period == 4 and doubled.ends == ("merged", "merged")
    assert sorted([doubled.values[0], doubled.values[-1]]) == pytest.approx(
        sorted(f.value for f in flips[:2]), abs=1e-8
    )


def test_the_period_doubling_sequence_has_feigenbaums_ratio():
    """Period 3, 6, 12, ... below Omega = 0.917: the gaps shrink by 4.669 (Feigenbaum, 1978), to 1 % at the fourth."""
    osc = BASELINE.replace(mesh_frequency=0.919)
    orbit = next(o for o in gp.find_orbits(osc, 3, n_starts=200) if o.period == 3 and o.stable)
    branch = gp.continue_orbit(orbit, "mesh_frequency", 0.91, 0.9195)
    first = next(b for b in branch.bifurcations if b.kind == "flip")
    flips = gp.bifurcations.doubling_cascade(first, 5)
    assert [flip.period for flip in flips] == [3, 6, 12, 24, 48]
    gaps = -np.diff([flip.value for flip in flips])
    assert np.all(gaps > 0)
    assert gaps[2] / gaps[3] == pytest.approx(4.669, rel=0.01)


def test_coexisting_orbits_are_those_that_starts_settle_on():
    """At frequencies between 0.7 and 1.05 the stable branches up to period 2 are the attractors of a grid of starts."""
    branches = gp.find_branches(BASELINE, "mesh_frequency", 0.7, 1.05, max_period=2, n_values=5)
    ranges = gp.bifurcations.coexistence(branches, 0.7, 1.05, shortest=1e-4)
    for omega in (0.72, 0.75, 1.045):
        grid = gp.basins(BASELINE.replace(mesh_frequency=omega), np.linspace(-3, 3, 25), np.linspace(-2, 2, 25))
        reached = {motion for motion in gp.motion.attractor_motions(grid) if motion.period in (1, 2)}
        motions = next(motions for low, high, motions in ranges if low <= omega <= high)
        assert reached == set(motions)


def test_the_search_finds_the_coexisting_branches():
    """At Omega = 0.7 the baseline has a clattering and a rattling stable orbit, on branches of their own."""
    branches = gp.find_branches(BASELINE, "mesh_frequency", 0.68, 0.72, max_period=2, n_values=3)
    for branch in branches:
        assert np.all(np.diff(branch.values) != 0)
    at = [
        (b.period, str(b.impact_states()[i]))
        for b in branches
        for i in [int(np.argmin(np.abs(b.values - 0.7)))]
        if b.stable[i] and abs(b.values[i] - 0.7) < 0.01
    ]
    assert sorted(at) == [(1, "double"), (2, "single_drive")]


@pytest.mark.parametrize("kind", ["fold", "flip", "grazing"])
def test_a_curve_in_two_parameters_carries_its_bifurcation(kind, printed_branch):
    """At points along the curve a one-parameter continuation finds the bifurcation at the same frequency, to 1e-7."""
    bifurcation = next(b for b in printed_branch.bifurcations if b.kind == kind)
    bounds = {"mesh_frequency": (0.6, 1.7), "damping_ratio": (0.015, 0.025)}
    curve = gp.continue_bifurcation(bifurcation, bounds)
    assert np.max(np.abs(curve.residual)) < 1e-8
    for i in (0, len(curve.values) - 1):
        omega, zeta = curve.values[i]
        osc = bifurcation.oscillator.replace(mesh_frequency=omega, damping_ratio=zeta)
        orbit = gp.periodic_orbit(osc, *curve.points[i], curve.period)
        if kind == "grazing":
            motion = gp.trajectory(osc, *curve.points[i], curve.period, samples_per_period=4000)
            turning = motion.x[1:-1][np.diff(np.sign(np.diff(motion.x))) != 0]
            assert np.min(np.abs(np.abs(turning) - 1.0)) < 1e-5
        else:
            assert np.min(np.abs(orbit.multipliers - (-1.0 if kind == "flip" else 1.0))) < 1e-5


def test_wave_parameters_can_be_continued():
    """The contact ratio is a parameter like any other where the wave is the article's rectangle."""
    orbit = orbit_of(SWAPPED)
    branch = gp.continue_orbit(orbit, "contact_ratio", 1.6, 1.75)
    assert branch.ends == ("bound", "bound")
    assert branch.values[[0, -1]] == pytest.approx([1.6, 1.75], abs=1e-12)


@pytest.mark.parametrize(
    ("lower", "upper", "parameter", "sentence"),
    [
        (0.8, 0.9, "mesh_frequency", "must enclose the orbit's mesh_frequency = 0.7"),
        (0.9, 0.6, "mesh_frequency", "must enclose"),
        (0.6, 0.9, "frequency", "unknown parameter 'frequency'"),
        (np.nan, 0.9, "mesh_frequency", "lower must be a finite number, got nan"),
    ],
)
def test_bad_input_is_named(lower, upper, parameter, sentence):
    with pytest.raises(ValueError, match=sentence):
        gp.continue_orbit(orbit_of(BASELINE), parameter, lower, upper)
