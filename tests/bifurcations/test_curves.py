"""Curves of folds, flips and grazings in two parameters, where they are known exactly or by a second path."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.bifurcations import End
from gearpair.bifurcations._orbit_problem import describe_cycle
from gearpair.bifurcations._walk import StepSizes, walk_both_ways
from tests.support.always_in_contact import edge, edges

CONTACT = gp.Oscillator(mean_force=4.0, error_amplitude=0.02, mesh_frequency=2.6)  # never leaves the flank
LEVEL = gp.Oscillator(damping_ratio=0.03, stiffness=gp.StiffnessWave((0.0,), (1.0,)))


@pytest.fixture(scope="module")
def tongue_flip():
    """A flip of the motion in contact: the lower edge of its first parametric tongue."""
    branch = gp.continue_orbit(gp.periodic_orbit(CONTACT, 5.0, 0.0, 1), "mesh_frequency", 1.5, 2.6, largest_step=0.1)
    return branch.bifurcations[0]


@pytest.mark.slow
def test_a_tongue_in_damping_is_the_linear_theorys_from_edge_to_edge(tongue_flip):
    """Every point lies on mu = -1 of Hill's equation; the curve passes the tip and ends on the bound at both edges."""
    bounds = {"mesh_frequency": (1.5, 2.6), "damping_ratio": (0.01, 0.3)}
    curve = gp.continue_bifurcation(tongue_flip, bounds, largest_step=0.1)
    assert (curve.kind, curve.period, curve.parameters) == ("flip", 1, ("mesh_frequency", "damping_ratio"))
    assert curve.ends == ("bound", "bound") and curve.ends[0].remedy.startswith("it reached a bound")
    off = [edge(CONTACT, -1.0, mesh_frequency=omega, damping_ratio=zeta) for omega, zeta in curve.values]
    assert np.max(np.abs(off)) < 1e-12 and np.max(np.abs(curve.residual)) < 1e-12
    assert curve.values[[0, -1], 1] == pytest.approx([0.01, 0.01], abs=1e-15)
    theory = edges(CONTACT.replace(damping_ratio=0.01), -1.0, "mesh_frequency", 1.5, 2.6)
    assert sorted(curve.values[[0, -1], 0]) == pytest.approx(theory, abs=1e-12)
    # Beyond the tip there is no tongue: no frequency where mu = -1.
    tip = curve.values[:, 1].max()
    assert tip > 0.07
    assert len(edges(CONTACT.replace(damping_ratio=0.99 * tip), -1.0, "mesh_frequency", 1.85, 2.05, 40)) == 2
    assert not edges(CONTACT.replace(damping_ratio=1.02 * tip), -1.0, "mesh_frequency", 1.85, 2.05, 40)


@pytest.mark.slow
def test_a_tongue_in_contact_ratio_is_a_closed_curve(tongue_flip):
    """Towards contact ratios 1 and 2 the stiffness is constant and damping wins: the tongue is an island."""
    bounds = {"mesh_frequency": (1.0, 3.0), "contact_ratio": (1.01, 1.99)}
    curve = gp.continue_bifurcation(tongue_flip, bounds, largest_step=0.4)
    assert curve.ends == ("closed", "closed")
    assert np.array_equal(curve.values[0], curve.values[-1]) and np.array_equal(curve.points[0], curve.points[-1])
    off = [edge(CONTACT, -1.0, mesh_frequency=omega, contact_ratio=ratio) for omega, ratio in curve.values]
    assert np.max(np.abs(off)) < 1e-12
    # Once around: the angle about a point inside grows by one turn.
    inside = curve.values - np.mean(curve.values, axis=0)
    around = np.unwrap(np.arctan2(inside[:, 1] / np.ptp(inside[:, 1]), inside[:, 0] / np.ptp(inside[:, 0])))
    assert abs(around[-1] - around[0]) == pytest.approx(2.0 * np.pi, abs=1e-9)
    # It meets the present contact ratio at both edges of the tongue.
    assert curve.values[:, 1].min() < 1.1 and curve.values[:, 1].max() > 1.9
    crossings = np.flatnonzero(np.diff(np.sign(curve.values[1:, 1] - 1.5)))
    assert len(crossings) == 2


@pytest.fixture(scope="module")
def level_branch():
    """Period 1 at constant stiffness: folds, flips and grazings that know no phase."""
    return gp.continue_orbit(gp.periodic_orbit(LEVEL, 0.633, -0.316, 1), "mesh_frequency", 0.4, 1.2)


@pytest.mark.parametrize("kind", ["fold", "flip", "grazing"])
def test_where_the_phase_is_a_shift_of_time_a_curve_is_a_straight_line(kind, level_branch):
    """At constant stiffness error_phase moves tau = 0 along the orbit: the curve is Omega = const through every phase.

    A grazing's extremum goes round the whole mesh period on the way, and has to be followed.
    """
    bifurcation = next(b for b in level_branch.bifurcations if b.kind == kind)
    bounds = {"mesh_frequency": (0.3, 1.5), "error_phase": (-0.5, 2.0 * np.pi)}
    curve = gp.continue_bifurcation(bifurcation, bounds)
    assert curve.ends == ("bound", "bound")
    assert np.max(np.abs(curve.values[:, 0] - bifurcation.value)) < 1e-10
    assert sorted(curve.values[[0, -1], 1]) == pytest.approx([-0.5, 2.0 * np.pi], abs=1e-14)
    assert np.max(np.abs(curve.residual)) < 1e-10
    # The section points are the orbit of phase 0 at tau = phase / Omega.
    motion = gp.trajectory(bifurcation.oscillator, bifurcation.x, bifurcation.v, 1, samples_per_period=2000)
    inside = curve.values[:, 1] >= 0.0
    times = curve.values[inside, 1] / bifurcation.value
    for column, component in enumerate((motion.x, motion.v)):
        expected = np.interp(times, motion.tau, component)
        assert np.allclose(curve.points[inside, column], expected, rtol=0, atol=2e-5)  # h^2 |X'''| / 8 by interpolation


@pytest.fixture(scope="module")
def printed_branch():
    """The baseline's period-2 branch."""
    return gp.continue_orbit(gp.periodic_orbit(gp.Oscillator(), 0.34, -0.25, 2), "mesh_frequency", 0.7, 1.2)


@pytest.mark.parametrize("kind", ["fold", "flip", "grazing"])
def test_two_paths_lead_to_one_curve(kind, printed_branch):
    """Continued in two parameters, and located anew at a fixed second one: the same mesh frequency, to 1e-9."""
    bifurcation = next(b for b in printed_branch.bifurcations if b.kind == kind)
    for damping in (0.018, 0.022):
        ends = sorted((damping, 0.02))
        bounds = {"mesh_frequency": (0.6, 1.7), "damping_ratio": (ends[0], ends[1])}
        curve = gp.continue_bifurcation(bifurcation, bounds)
        (row,) = [i for i in (0, -1) if curve.values[i, 1] == pytest.approx(damping, abs=1e-14)]
        osc = gp.Oscillator(damping_ratio=damping)
        branch = gp.continue_orbit(gp.periodic_orbit(osc, 0.34, -0.25, 2), "mesh_frequency", 0.7, 1.2)
        located = [b for b in branch.bifurcations if b.kind == kind]
        nearest = min(located, key=lambda b: abs(b.value - curve.values[row, 0]))
        assert nearest.value == pytest.approx(curve.values[row, 0], abs=1e-9)
        assert nearest.contacts == bifurcation.contacts


SWAPPED = gp.Oscillator(stiffness=gp.StiffnessWave.rectangular(reading="swapped"))


def swapped_flip(start, period, lower, upper, damping=0.02):
    """The flip of a branch of the swapped reading between two mesh frequencies."""
    osc = SWAPPED.replace(damping_ratio=damping, mesh_frequency=0.5 * (lower + upper))
    branch = gp.continue_orbit(gp.periodic_orbit(osc, *start, period), "mesh_frequency", lower, upper)
    (flip,) = [b for b in branch.bifurcations if b.kind == "flip"]
    return flip


def test_over_a_kink_a_flip_goes_on_as_it_is_located_beyond():
    """Where the section point passes X = 1 the curve has a corner; at smaller damping the flip is located anew."""
    flip = swapped_flip((1.007, -0.34), 1, 0.81, 0.83)
    bounds = {"mesh_frequency": (0.6, 1.8), "damping_ratio": (0.0194, 0.06)}
    stopped = gp.continue_bifurcation(flip, bounds, over_kinks=False)
    assert stopped.ends == ("lost", "bound") and "over_kinks=False" in stopped.ends[0].remedy
    assert stopped.values[0] == pytest.approx([0.816995, 0.0194159], abs=1e-6)
    assert stopped.points[0, 0] == pytest.approx(1.0, abs=1e-5)
    curve = gp.continue_bifurcation(flip, bounds)
    assert curve.ends == ("bound", "bound") and np.max(np.abs(curve.residual)) < 1e-10
    assert curve.values[0, 1] == pytest.approx(0.0194, abs=1e-15)
    beyond = swapped_flip((1.008, -0.34), 1, 0.815, 0.83, 0.0194)
    assert curve.values[0, 0] == pytest.approx(beyond.value, abs=1e-9)
    assert beyond.value == pytest.approx(0.820441, abs=1e-6)
    before = gp.continue_bifurcation(flip, bounds | {"damping_ratio": (0.0195, 0.06)})
    assert before.values[0].tolist() == pytest.approx([0.817056, 0.0195], abs=1e-6)
    # No part of it is walked twice: damping falls all the way to the lower bound.
    assert np.all(np.diff(curve.values[:, 1]) > 0.0)


def test_over_a_kink_a_fold_is_one_curve_from_either_of_its_folds(printed_branch):
    """Two folds at the baseline's damping lie on the two sides of a corner near (1.3615, 0.0095)."""
    bounds = {"mesh_frequency": (0.4, 1.9), "damping_ratio": (0.001, 0.1)}
    folds = [b for b in printed_branch.bifurcations if b.kind == "fold"]
    pair = [min(folds, key=lambda b: abs(b.value - near)) for near in (1.1907, 0.8070)]
    for fold in pair:
        assert "lost" in gp.continue_bifurcation(fold, bounds, over_kinks=False).ends
        curve = gp.continue_bifurcation(fold, bounds)
        assert curve.ends == ("bound", "bound")
        assert sorted(curve.values[[0, -1], 0]) == pytest.approx([0.79311787, 1.1413738], abs=1e-7)


def test_two_flips_that_end_together_end_where_the_orbit_also_grazes():
    """Near (1.3847, 0.0594) the multiplier is -1 as the orbit touches X = 1: a point of codimension two.

    On the side with one contact more the gap of that contact grows with the square of the distance from there.
    """
    bounds = {"mesh_frequency": (0.4, 1.9), "damping_ratio": (0.001, 0.1)}
    fewer = gp.continue_bifurcation(swapped_flip((0.011, 0.074), 2, 0.862, 0.871), bounds)
    more = gp.continue_bifurcation(swapped_flip((0.860, -0.1755), 2, 1.432, 1.4366), bounds)
    assert fewer.ends[-1] == "grazes" == more.ends[0]
    assert "codimension two" in more.ends[0].remedy
    point = fewer.values[-1]
    assert point == pytest.approx([1.384697, 0.059435], abs=1e-6)
    assert more.values[0] == pytest.approx(point, abs=2e-3)

    def gap(curve, row):
        osc = SWAPPED.replace(**dict(zip(curve.parameters, curve.values[row].tolist(), strict=True)))
        cycle = describe_cycle(osc.coefficients, *curve.points[row], curve.period)
        return cycle.contacts, cycle.test("grazing")

    contacts, away = gap(fewer, -1)
    assert contacts == (1, 0) and -1e-5 < away < 0.0
    rows = [int(np.argmin(np.abs(more.values[:, 0] - omega))) for omega in (1.3856, 1.386, 1.387)]
    gaps = [gap(more, row) for row in rows]
    assert {contacts for contacts, _ in gaps} == {(2, 0)}
    distances = more.values[rows, 0] - point[0]
    ratios = np.array([away for _, away in gaps]) / distances**2
    assert ratios == pytest.approx(np.full(3, ratios[0]), rel=0.05)


def test_steps_are_counted_each_way(tongue_flip):
    """`max_steps` steps from the bifurcation to either side, no more."""
    bounds = {"mesh_frequency": (1.5, 2.6), "damping_ratio": (0.001, 0.3)}
    curve = gp.continue_bifurcation(tongue_flip, bounds, max_steps=3)
    assert curve.ends == ("max_steps", "max_steps") and len(curve.values) == 7
    assert np.allclose(curve.values[3], [tongue_flip.value, 0.02], rtol=0, atol=1e-14)
    assert "raise max_steps" in curve.ends[0].remedy


def test_steps_are_no_longer_than_asked(tongue_flip):
    """In units of X, X' and the ranges, to the bend of the curve."""
    bounds = {"mesh_frequency": (1.5, 2.6), "damping_ratio": (0.01, 0.3)}
    curve = gp.continue_bifurcation(tongue_flip, bounds, largest_step=0.05)
    scaled = np.hstack([curve.points, curve.values / [1.1, 0.29]])
    lengths = np.linalg.norm(np.diff(scaled, axis=0), axis=1)
    assert 0.045 < lengths.max() < 0.055


class Line:
    """X = X' = 0 and second parameter = twice the first: a straight line to walk along."""

    scales = np.ones(2)

    def equations(self, u):
        return np.array([u[0], u[1], u[3] - 2.0 * u[2]]), np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, -2, 1]])

    def describe(self, u):
        return None

    def values(self, u):
        return u[2:]

    def ending(self, last, step):
        return None


@pytest.mark.parametrize(
    ("bounds", "low", "high"),
    [
        (((-1.0, 1.0), (-9.0, 1.0)), (-1.0, -2.0), (0.5, 1.0)),  # the second parameter's upper bound comes first
        (((-1.0, 1.0), (-1.5, 9.0)), (-0.75, -1.5), (1.0, 2.0)),  # its lower one, the other way
    ],
)
def test_of_two_bounds_in_one_step_the_first_ends_the_walk(bounds, low, high):
    """A step of length 5 passes both; the walk ends where the line leaves the rectangle."""
    steps, ends = walk_both_ways(Line(), np.zeros(4), bounds, StepSizes(5.0, 1e-6, 5.0), max_steps=10)
    assert ends == (End.BOUND, End.BOUND) and len(steps) == 3
    assert np.allclose([steps[0].u[2:], steps[-1].u[2:]], [low, high], rtol=0, atol=1e-12)


def test_a_curve_prints_what_it_is(tongue_flip):
    bounds = {"mesh_frequency": (1.5, 2.6), "damping_ratio": (0.001, 0.3)}
    curve = gp.continue_bifurcation(tongue_flip, bounds, max_steps=1)
    assert str(curve).startswith("flip curve of period 1 with 3 points, from (mesh_frequency, damping_ratio) = (1.8")
    assert str(curve).endswith("(max_steps)")


@pytest.mark.parametrize(
    ("bounds", "sentence"),
    [
        ({"mesh_frequency": (1.5, 2.6)}, "bounds must name two parameters, got 1: mesh_frequency"),
        ({"mesh_frequency": (1.9, 2.6), "damping_ratio": (0.0, 0.1)}, "bounds of mesh_frequency must enclose"),
        ({"mesh_frequency": (1.5, 2.6), "damping_ratio": (0.1, 0.0)}, "bounds of damping_ratio must enclose"),
        ({"mesh_frequency": (1.5, 2.6), "speed": (0.0, 0.1)}, "unknown parameter 'speed'"),
    ],
)
def test_bad_input_is_named(bounds, sentence, tongue_flip):
    with pytest.raises(ValueError, match=sentence):
        gp.continue_bifurcation(tongue_flip, bounds)
