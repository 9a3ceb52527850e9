"""Continuation against the linear theory, an independent method, and known ratios."""

import numpy as np
import pytest
from scipy.optimize import fsolve

import gearpair as gp
from tests.support import always_in_contact
from tests.support.oscillators import BASELINE, CONTACT, SWAPPED
from tests.support.reference import dop853_period


def orbit_of(osc, x=1.0, v=0.0):
    """The stable orbit that the motion from (x, v) settles on."""
    state = gp.steady_state(osc, x, v)
    assert state.status == "periodic"
    return gp.periodic_orbit(osc, *state.points[0], state.period)


@pytest.fixture(scope="module")
def printed_branch():
    """The baseline's period-2 branch, both ways from 0.7 to 1.19 and its flip at 1.6."""
    return gp.continue_orbit(orbit_of(BASELINE), "mesh_frequency", 0.6, 1.7)


@pytest.fixture(scope="module")
def contact_branch():
    """Always in contact, across the first parametric tongue."""
    return gp.continue_orbit(gp.periodic_orbit(CONTACT, 5.0, 0.0, 1), "mesh_frequency", 1.5, 2.6, largest_step=0.1)


def test_a_branch_in_contact_is_the_linear_theorys(contact_branch):
    """Points, multipliers and stability of every orbit in closed form, to rounding; both ends on the bounds exactly."""
    b = contact_branch
    assert (b.ends, b.period, b.parameter) == (("bound", "bound"), 1, "mesh_frequency")
    assert (b.values[0], b.values[-1]) == pytest.approx((1.5, 2.6), abs=1e-14)
    assert set(b.impact_states()) == {"none_drive"} and not np.any(b.contacts)
    for i, omega in enumerate(b.values):
        osc = CONTACT.replace(mesh_frequency=omega)
        exact = always_in_contact.monodromy(osc)
        assert np.allclose(b.points[i, 0], always_in_contact.section_point(osc), rtol=0, atol=1e-11)
        assert np.sum(b.multipliers[i]) == pytest.approx(np.trace(exact), abs=1e-12)
        assert b.stable[i] == (np.abs(np.linalg.eigvals(exact)).max() < 1.0)


def test_parametric_instability_begins_where_the_linear_theory_says(contact_branch):
    """The flips are the edges of the tongue, and nothing else happens: mu = -1 of Hill's equation, to 1e-12."""
    theory = always_in_contact.edges(CONTACT, -1.0, "mesh_frequency", 1.5, 2.6)
    assert [(b.kind, b.period, b.impact_state) for b in contact_branch.bifurcations] == [("flip", 1, "none_drive")] * 2
    assert [b.value for b in contact_branch.bifurcations] == pytest.approx(theory, abs=1e-12)
    for flip, row in zip(contact_branch.bifurcations, contact_branch.bifurcation_rows, strict=True):
        assert contact_branch.values[row] <= flip.value <= contact_branch.values[row + 1]
        assert (flip.x, flip.v) == pytest.approx(always_in_contact.section_point(flip.oscillator), abs=1e-11)
        assert flip.oscillator == CONTACT.replace(mesh_frequency=flip.value)


def test_a_branch_that_runs_to_infinity_is_left_at_twenty_static_positions():
    """Where contact resonates (mu = +1 of Hill's equation) |X| grows like 1 / distance: the branch is left there."""
    orbit = next(o for o in gp.find_orbits(BASELINE, 1, n_starts=100) if o.stable and o.impact_state == "double")
    branch = gp.continue_orbit(orbit, "mesh_frequency", 0.69, 1.7)
    assert branch.ends == ("bound", "too_large")
    size = np.maximum(-branch.x_min, branch.x_max)
    largest = 20.0 * (1.0 + 0.1 / BASELINE.stiffness.mean)
    assert np.all(size[:-1] <= largest) and largest < size[-1] < 1.01 * largest
    half = np.flatnonzero(size > 0.5 * size[-1])[0]
    resonance = (size[-1] * branch.values[-1] - size[half] * branch.values[half]) / (size[-1] - size[half])
    assert resonance == pytest.approx(always_in_contact.edges(BASELINE, 1.0, "mesh_frequency", 0.85, 0.97)[0], abs=1e-3)


def test_steps_are_counted_each_way(contact_branch):
    """`max_steps` steps from the orbit to either side, no more; the orbit is in the middle."""
    orbit = gp.periodic_orbit(CONTACT.replace(mesh_frequency=2.0), 5.0, 0.5, 1)
    branch = gp.continue_orbit(orbit, "mesh_frequency", 1.5, 2.6, max_steps=4)
    assert branch.ends == ("max_steps", "max_steps") and len(branch.values) == 9
    assert branch.values[4] == pytest.approx(2.0, abs=1e-14) and branch.newton_steps[4] == 0
    assert np.all(np.diff(branch.values) > 0)
    assert "raise max_steps" in branch.ends[0].remedy


def test_steps_are_no_longer_than_asked():
    """In units of X, X' and the range of the parameter."""
    for largest in (0.01, 0.1):
        orbit = gp.periodic_orbit(CONTACT, 5.0, 0.0, 1)
        branch = gp.continue_orbit(orbit, "mesh_frequency", 1.5, 2.6, largest_step=largest)
        scaled = np.column_stack([branch.points[:, 0], branch.values / 1.1])
        lengths = np.linalg.norm(np.diff(scaled, axis=0), axis=1)
        assert 0.9 * largest < lengths.max() < 1.1 * largest


LEVEL = gp.Oscillator(
    mean_force=0.0, error_amplitude=0.5, damping_ratio=0.03, mesh_frequency=2.2,
    stiffness=gp.StiffnessWave((0.0,), (1.0,)),
)  # fmt: skip


@pytest.fixture(scope="module")
def island():
    """Period 3 at constant stiffness along the mean force: an isola about zero."""
    orbit = gp.periodic_orbit(LEVEL, -2.667, -0.670, 3)
    assert orbit.converged and orbit.stable
    return gp.continue_orbit(orbit, "mean_force", -1.0, 1.0, largest_step=0.05)


def test_an_isola_is_walked_once_around(island):
    """It ends in the orbit it began with, crosses every value twice, and turns back only at its two folds."""
    assert island.ends == ("closed", "closed") and "no more of it" in island.ends[0].remedy
    assert island.values[0] == island.values[-1] == 0.0 and np.array_equal(island.points[0], island.points[-1])
    for value in (-0.6, -0.2, 0.1, 0.64):
        assert np.sum(np.diff(np.sign(island.values - value)) != 0) == 2
    folds = sorted(b.value for b in island.bifurcations if b.kind == "fold")
    assert len(folds) == 2 and -folds[0] == pytest.approx(folds[1], abs=1e-10)
    assert folds[0] <= island.values.min() < 0.99 * folds[0] and 0.99 * folds[1] < island.values.max() <= folds[1]
    for b in island.bifurcations:
        if b.kind == "fold":
            assert np.min(np.abs(gp.periodic_orbit(b.oscillator, b.x, b.v, 3).multipliers - 1.0)) < 1e-5


def test_an_isola_is_the_same_from_any_of_its_orbits(island):
    """Started from an orbit beside the fold it has the same bifurcations, each once."""
    i = int(np.argmax(island.values)) + 2
    orbit = gp.periodic_orbit(LEVEL.replace(mean_force=island.values[i]), *island.points[i, 0], 3)
    again = gp.continue_orbit(orbit, "mean_force", -1.0, 1.0, largest_step=0.03)
    assert again.ends == ("closed", "closed")
    kinds, values = zip(*sorted((b.kind, b.value) for b in island.bifurcations), strict=True)
    kinds_again, values_again = zip(*sorted((b.kind, b.value) for b in again.bifurcations), strict=True)
    assert kinds_again == kinds and np.allclose(values_again, values, rtol=0, atol=1e-10)


def test_the_mirror_image_belongs_to_the_opposite_mean_force(island):
    """X(tau) -> -X(tau + T/2) with F_m -> -F_m: the bifurcations come in mirrored pairs, drive and coast changed."""
    found = {(b.kind, round(b.value, 9), tuple(sorted(b.contacts))) for b in island.bifurcations}
    mirrored = {
        (kind, -value, tuple(sorted((coast, drive) for drive, coast in contacts))) for kind, value, contacts in found
    }
    assert found == mirrored and len(found) == len(island.bifurcations) == 6
    i = int(np.argmin(np.abs(island.values - 0.3)))
    osc = LEVEL.replace(mean_force=island.values[i])
    motion = gp.trajectory(osc, *island.points[i, 0], 3, samples_per_period=2)
    mirror = gp.periodic_orbit(osc.replace(mean_force=-osc.mean_force), -motion.x[1], -motion.v[1], 3)
    halfway = -np.column_stack([motion.x, motion.v])[1::2]
    assert np.allclose(mirror.points, np.roll(halfway, -int(np.argmin(halfway[:, 0])), axis=0), rtol=0, atol=1e-10)
    assert (mirror.x_min, mirror.x_max) == pytest.approx((-island.x_max[i], -island.x_min[i]), abs=1e-10)
    assert mirror.contacts == tuple(island.contacts[i, ::-1])
    assert np.allclose(mirror.multipliers, island.multipliers[i], rtol=0, atol=1e-8)


def test_along_the_phase_a_branch_traces_its_orbit():
    """At constant stiffness error_phase shifts time: points at phase p are the orbit's at tau = p / Omega."""
    osc = LEVEL.replace(mean_force=0.1, error_amplitude=0.2, mesh_frequency=0.7)
    orbit = gp.periodic_orbit(osc, 0.633, -0.316, 1)
    branch = gp.continue_orbit(orbit, "error_phase", 0.0, 2.0 * np.pi)
    assert branch.ends == ("bound", "bound") and not branch.bifurcations
    assert np.allclose(branch.points[0], branch.points[-1], rtol=0, atol=1e-11)
    assert np.allclose(branch.multipliers, orbit.multipliers, rtol=0, atol=1e-11)
    assert np.ptp(branch.x_min) < 1e-12 and np.ptp(branch.x_max) < 1e-12
    motion = gp.trajectory(osc, *orbit.points[0], 1, samples_per_period=4000)
    for component, k in ((motion.x, 0), (motion.v, 1)):
        expected = np.interp(branch.values / 0.7, motion.tau, component)
        assert np.allclose(branch.points[:, 0, k], expected, rtol=0, atol=1e-5)  # interpolated: a parabola's sagitta


def test_a_branch_prints_what_it_is(contact_branch):
    assert str(contact_branch) == (
        f"branch of {len(contact_branch.values)} orbits of period 1 with 2 bifurcations, "
        "from mesh_frequency = 1.5 (bound) to 2.6 (bound)"
    )


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
    """Residual at rounding, product of multipliers exp(-2 zeta p T), mostly few Newton steps."""
    b = printed_branch
    product = np.exp(-2 * 0.02 * 2 * 2 * np.pi / b.values)
    size = np.maximum(1.0, np.abs(b.multipliers[:, 0]))
    assert np.max(np.abs(np.prod(b.multipliers, axis=1) - product) / size**2) < 1e-12
    for omega, point in zip(b.values[::20], b.points[::20, 0], strict=True):
        back = gp.stroboscopic_map(BASELINE.replace(mesh_frequency=omega), *point, 2)
        assert np.allclose(back, point, rtol=0, atol=1e-9)
    assert np.median(b.newton_steps) <= 4


def test_bifurcations_are_where_their_multipliers_say(printed_branch):
    """At a flip one multiplier is -1, at a fold +1, at a grazing an extremum is +-1: each to 1e-8 in the parameter."""
    kinds = [b.kind for b in printed_branch.bifurcations]
    assert {"fold", "flip", "grazing"} == set(kinds)
    for b in printed_branch.bifurcations:
        orbit = gp.periodic_orbit(b.oscillator, b.x, b.v, b.period)
        assert (b.x, b.v) == pytest.approx(tuple(orbit.points[0]), abs=1e-6)  # the section point of smallest X
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


@pytest.mark.slow
def test_coexisting_orbits_are_those_that_starts_settle_on():
    """At frequencies between 0.7 and 1.05 the stable branches up to period 2 are the attractors of a grid of starts."""
    branches = gp.find_branches(BASELINE, "mesh_frequency", 0.7, 1.05, max_period=2, n_values=5)
    ranges = gp.bifurcations.coexistence(branches, 0.7, 1.05, shortest=1e-4)
    for omega in (0.72, 0.75, 1.045):
        grid = gp.basins(BASELINE.replace(mesh_frequency=omega), np.linspace(-3, 3, 25), np.linspace(-2, 2, 25))
        reached = {motion for motion in gp.ensembles.attractor_motions(grid) if motion.period in (1, 2)}
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


def test_a_branch_that_ends_at_the_bound_twice_is_one_branch():
    """A fold's two orbits at the lower bound, where the walk ends up to rounding, lie on one branch."""
    branches = gp.find_branches(BASELINE, "damping_ratio", 5e-5, 0.025, max_period=1, n_values=6)
    folds = [b.value for branch in branches for b in branch.bifurcations if b.kind == "fold"]
    assert folds == pytest.approx([0.0084], abs=1e-4)
    ends = [tuple(np.round(branch.points[k, 0], 6)) for branch in branches for k in (0, -1)]
    assert len(set(ends)) == len(ends)


def test_a_branch_counts_the_contacts_of_each_side():
    """The baseline's period 2 strikes the drive side twice in its cycle and never the coast side."""
    orbit = gp.periodic_orbit(gp.Oscillator(), 0.34629, -0.25625, 2)
    branch = gp.continue_orbit(orbit, "mesh_frequency", 0.7, 0.71)
    np.testing.assert_array_equal(branch.contacts, np.tile(orbit.contacts, (len(branch.values), 1)))
    impacts = gp.trajectory(gp.Oscillator(), *map(float, orbit.points[0]), 2).impacts
    assert orbit.contacts == (
        np.sum(impacts.contact & (impacts.side > 0)),
        np.sum(impacts.contact & (impacts.side < 0)),
    )


def test_a_cascade_has_as_many_levels_as_asked_for():
    branch = gp.continue_orbit(gp.periodic_orbit(gp.Oscillator(), 0.34629, -0.25625, 2), "mesh_frequency", 0.7, 0.8)
    flip = next(b for b in branch.bifurcations if b.kind == "flip")
    assert gp.bifurcations.doubling_cascade(flip, 1) == [flip]
    assert [b.period for b in gp.bifurcations.doubling_cascade(flip, 2)] == [2, 4]
