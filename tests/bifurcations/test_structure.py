"""Ranges of stability and of coexistence from branches made up for the purpose, and tables of them."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.bifurcations import Branch, End, coexistence, stable_ranges
from gearpair.motion import periodic
from tests.support.oscillators import BASELINE

RATTLE, CLATTER = (0.2, 1.8), (-1.5, 1.8)  # extremes of X of a single-sided and of a double-sided motion


def made_up(kind, value, period=1, contacts=((1, 0), (1, 0))):
    """A bifurcation of which only kind, value and period matter."""
    osc = BASELINE.replace(mesh_frequency=value)
    return gp.Bifurcation(kind, "mesh_frequency", value, period, 0.0, 0.0, osc, contacts, gp.ImpactState.SINGLE_DRIVE)


def branch_of(values, stable, period=1, extremes=RATTLE, located=()):
    """A branch with the given stability; `located` holds (row before it, bifurcation)."""
    n = len(values)
    low, high = np.broadcast_to(np.array(extremes), (n, 2)).T
    inside = np.array(stable, dtype=bool)
    return Branch(
        parameter="mesh_frequency",
        period=period,
        oscillator=BASELINE,
        values=np.array(values, dtype=float),
        points=np.zeros((n, period, 2)),
        multipliers=np.where(inside[:, None], 0.5, 2.0) + np.zeros((n, 2), complex),
        stable=inside,
        x_min=low.copy(),
        x_max=high.copy(),
        contacts=np.ones((n, 2), int),
        newton_steps=np.ones(n, int),
        bifurcations=[bifurcation for _, bifurcation in located],
        bifurcation_rows=np.array([row for row, _ in located], int),
        ends=(End.BOUND, End.BOUND),
    )


def spans(ranges):
    """(lower, upper, period) of each range."""
    return [(run.lower, run.upper, run.motion.period) for run in ranges]


def counted(ranges):
    """(lower, upper, how many stable orbits) of each range."""
    return [(low, high, len(motions)) for low, high, motions in ranges]


def test_a_stable_range_ends_at_the_bifurcation_between_its_last_orbit_and_the_next():
    """Not at an orbit, nor halfway; at the branch's own end where it has no other."""
    branch = branch_of([1, 2, 3, 4, 5], [1, 1, 0, 0, 1], located=[(1, made_up("flip", 2.2)), (3, made_up("fold", 4.9))])
    assert spans(stable_ranges([branch])) == [(1.0, 2.2, 1), (4.9, 5.0, 1)]
    falling = branch_of(
        [5, 4, 3, 2, 1], [1, 0, 0, 1, 1], located=[(0, made_up("fold", 4.9)), (2, made_up("flip", 2.2))]
    )
    assert spans(stable_ranges([falling])) == [(1.0, 2.2, 1), (4.9, 5.0, 1)]
    unknown = branch_of([1, 2, 3], [1, 1, 0])  # nothing located: halfway
    assert spans(stable_ranges([unknown])) == [(1.0, 2.5, 1)]


def test_of_several_bifurcations_in_a_step_the_stable_orbit_s_neighbour_counts():
    """A grazing does not change stability; of flip and fold the first on the stable side ends the range."""
    events = [(1, made_up("grazing", 2.1)), (1, made_up("flip", 2.5)), (1, made_up("fold", 2.8))]
    assert spans(stable_ranges([branch_of([1, 2, 3], [1, 1, 0], located=events)])) == [(1.0, 2.5, 1)]
    assert spans(stable_ranges([branch_of([1, 2, 3], [0, 0, 1], located=events)])) == [(2.8, 3.0, 1)]
    beside = [(0, made_up("flip", 1.9)), (1, made_up("flip", 2.3))]
    assert spans(stable_ranges([branch_of([1, 2, 3], [1, 0, 1], located=beside)])) == [(1.0, 1.9, 1), (2.3, 3.0, 1)]


def test_where_the_impact_state_changes_one_stable_range_goes_on_and_coexistence_tells_them_apart():
    """The grazing parts the two impact states; stability does not end there."""
    branch = branch_of(
        [1, 2, 3, 4], [1, 1, 1, 1], extremes=[RATTLE, RATTLE, CLATTER, CLATTER], located=[(1, made_up("grazing", 2.4))]
    )
    assert spans(stable_ranges([branch])) == [(1.0, 4.0, 1)]
    rattle, clatter = (periodic(1, state) for state in (gp.ImpactState.SINGLE_DRIVE, gp.ImpactState.DOUBLE))
    assert coexistence([branch], 1.0, 4.0) == [(1.0, 2.4, (rattle,)), (2.4, 4.0, (clatter,))]


def test_a_branch_that_turns_back_has_two_ranges_at_a_time():
    """Up to the fold at 3 stable, and again on the way back below 2: both count where they overlap."""
    branch = branch_of([1, 2, 2.9, 2, 1], [1, 1, 0, 0, 1], located=[(1, made_up("fold", 3)), (3, made_up("flip", 1.5))])
    assert counted(coexistence([branch], 0.0, 4.0)) == [(0.0, 1.0, 0), (1.0, 1.5, 2), (1.5, 3.0, 1), (3.0, 4.0, 0)]
    assert spans(stable_ranges([branch])) == [(1.0, 3.0, 1)]


def test_a_branch_that_turns_back_between_stable_orbits_is_counted_twice():
    """Where a step passes a fold and a flip the orbits on both sides are stable: two ranges that meet at the fold."""
    events = [(2, made_up("fold", 3.2)), (2, made_up("flip", 3.1))]
    branch = branch_of([1, 2, 3, 2, 1], [1, 1, 1, 1, 1], located=events)
    assert counted(coexistence([branch], 1.0, 4.0)) == [(1.0, 3.2, 2), (3.2, 4.0, 0)]
    unlocated = coexistence([branch_of([1, 2, 3, 2, 1], [1, 1, 1, 1, 1])], 1.0, 4.0)
    assert counted(unlocated) == [(1.0, 2.5, 2), (2.5, 3.0, 1), (3.0, 4.0, 0)]


def test_ranges_that_touch_or_overlap_are_joined_and_the_longer_one_counts():
    """A short range inside a long one does not shorten it; other periods stay apart."""
    long, short = branch_of([0, 10], [1, 1]), branch_of([2, 5], [1, 1])
    assert spans(stable_ranges([long, short])) == spans(stable_ranges([short, long])) == [(0.0, 10.0, 1)]
    assert spans(stable_ranges([branch_of([0, 4], [1, 1]), branch_of([4, 9], [1, 1])])) == [(0.0, 9.0, 1)]
    apart = [branch_of([0, 4], [1, 1]), branch_of([5, 9], [1, 1]), branch_of([3, 6], [1, 1], period=2)]
    assert spans(stable_ranges(apart)) == [(0.0, 4.0, 1), (3.0, 6.0, 2), (5.0, 9.0, 1)]


def test_narrow_ranges_are_left_out():
    """`shortest` is the least width that stays."""
    branches = [branch_of([0, 4], [1, 1]), branch_of([5, 6], [1, 1])]
    assert spans(stable_ranges(branches, shortest=1.0)) == [(0.0, 4.0, 1), (5.0, 6.0, 1)]
    assert spans(stable_ranges(branches, shortest=1.01)) == [(0.0, 4.0, 1)]
    assert counted(coexistence(branches, 0.0, 6.0, shortest=1.01)) == [(0.0, 4.0, 1), (4.0, 6.0, 0)]
    assert counted(coexistence(branches, 0.0, 6.0, shortest=1.0)) == [(0.0, 4.0, 1), (4.0, 5.0, 0), (5.0, 6.0, 1)]


def test_coexistence_counts_what_is_stable_together_within_its_bounds():
    """Each range between two ends of stability, the bounds included; neighbours with the same orbits are one range."""
    first = branch_of([0, 3, 6], [1, 1, 1])
    second = branch_of([2, 5], [1, 1], period=2, extremes=CLATTER)
    assert counted(coexistence([first, second], 1.0, 7.0)) == [
        (1.0, 2.0, 1),
        (2.0, 5.0, 2),
        (5.0, 6.0, 1),
        (6.0, 7.0, 0),
    ]
    assert counted(coexistence([first], 1.0, 2.0)) == [(1.0, 2.0, 1)]
    assert counted(coexistence([], 1.0, 2.0)) == [(1.0, 2.0, 0)]
    halves = [branch_of([0, 3], [1, 1]), branch_of([3, 6], [1, 1])]
    assert counted(coexistence(halves, 0.0, 6.0)) == [(0.0, 6.0, 1)]


def test_a_range_that_stops_just_short_of_a_bifurcation_ends_there():
    """Two ten-thousandths of the parameter are nearer than a walk's last step; five are not."""
    branch = branch_of([1, 2], [1, 1])
    other = branch_of([1, 3], [0, 0], located=[(0, made_up("flip", 2.0003))])
    assert counted(coexistence([branch, other], 1.0, 3.0)) == [(1.0, 2.0003, 1), (2.0003, 3.0, 0)]
    other = branch_of([1, 3], [0, 0], located=[(0, made_up("flip", 2.0005))])
    assert counted(coexistence([branch, other], 1.0, 3.0)) == [(1.0, 2.0, 1), (2.0, 3.0, 0)]


def test_a_branch_is_stable_to_the_flip_that_it_grows_from():
    """There a multiplier is 1, and rounding must not decide: the merged orbit is as stable as the one beside it."""
    two = gp.continue_orbit(gp.periodic_orbit(BASELINE, 0.34, -0.25, 2), "mesh_frequency", 0.69, 0.78)
    (flip,) = [b for b in two.bifurcations if b.kind == "flip"]
    doubled = gp.bifurcations.doubled_orbit(flip)
    for step in (0.02, 0.0177, 0.013, 0.011, 0.007):
        branch = gp.continue_orbit(doubled, "mesh_frequency", 0.75, 0.79, largest_step=step)
        assert sorted(branch.ends) == ["bound", "merged"] and branch.stable.all()
        (run,) = stable_ranges([branch])
        assert run.motion == periodic(4)
        assert run.lower == pytest.approx(flip.value, abs=1e-9) and run.upper == 0.79


def test_stable_ranges_do_not_depend_on_the_steps():
    """The doubled branch, whose range ends at a flip next to a grazing, walked with three step lengths."""
    single = gp.continue_orbit(gp.periodic_orbit(BASELINE, 0.34, -0.25, 2), "mesh_frequency", 0.7, 0.8)
    doubled = gp.bifurcations.doubled_orbit(next(b for b in single.bifurcations if b.kind == "flip"))
    found = []
    for step in (0.02, 0.0177, 0.005):
        branch = gp.continue_orbit(doubled, "mesh_frequency", 0.7, 1.2, largest_step=step)
        assert branch.ends == ("merged", "merged")
        found.append(spans(stable_ranges([branch])))
        flips = [b.value for b in branch.bifurcations if b.kind == "flip"]
        edges = sorted([*flips, branch.values[0], branch.values[-1]])
        assert [edge for lower, upper, _ in found[-1] for edge in (lower, upper)] == pytest.approx(edges, abs=1e-12)
    assert np.allclose(found[0], found[1], rtol=0, atol=1e-9) and np.allclose(found[0], found[2], rtol=0, atol=1e-9)


def test_a_cascade_s_ratios_are_gap_over_next_gap():
    """Gaps that shrink fourfold have the ratio 4.00, rising or falling."""
    for sign in (1.0, -1.0):
        values = [1.0 + sign * (1.0 - 4.0**-k) * 0.1 for k in range(4)]
        flips = [made_up("flip", value, 2**k) for k, value in enumerate(values)]
        (row,) = gp.bifurcations.cascade_table([flips], digits=4).rows
        assert row == ("1 2 4 8", " ".join(f"{value:.4f}" for value in values), "4.00 4.00")


def test_bifurcations_are_listed_by_value_with_their_contacts():
    """Rising; a grazing shows the contacts on both sides."""
    branch = branch_of(
        [1, 2, 3],
        [1, 1, 1],
        located=[(1, made_up("flip", 2.5)), (0, made_up("grazing", 1.5, contacts=((2, 0), (1, 0))))],
    )
    rows = gp.bifurcations.bifurcation_table([branch], digits=1).rows
    assert [row[:2] for row in rows] == [("grazing", "1.5"), ("flip", "2.5")]
    assert [row[3] for row in rows] == ["2 + 0 | 1 + 0", "1 + 0"]
