"""A bifurcation moved with the oscillator against continuation, and its first shift against differences."""

import pytest

import gearpair as gp
from gearpair.bifurcations import fold_shift, move_bifurcation

OSC = gp.Oscillator(damping_ratio=0.1, error_amplitude=0.1)


def folds(osc: gp.Oscillator) -> list:
    branch = gp.continue_orbit(gp.steady_state(osc.replace(mesh_frequency=0.7), 0.5), "mesh_frequency", 0.6, 0.85)
    return [each for each in branch.bifurcations if each.kind == "fold"]


def test_a_moved_fold_is_where_continuation_finds_it() -> None:
    other = OSC.replace(damping_ratio=0.099, error_amplitude=0.101, error_phase=0.02, contact_ratio=1.681)
    there = folds(other)
    assert len(there) == len(folds(OSC)) == 2
    for fold, expected in zip(folds(OSC), there, strict=True):
        moved = move_bifurcation(fold, other)
        assert moved is not None and moved.kind == "fold" and moved.oscillator.damping_ratio == 0.099
        assert moved.value == pytest.approx(expected.value, abs=1e-9) and abs(moved.value - fold.value) > 1e-4
        assert (moved.x, moved.v) == pytest.approx((expected.x, expected.v), abs=1e-5)


def test_a_fold_that_is_gone_is_none() -> None:
    assert move_bifurcation(folds(OSC)[0], OSC.replace(damping_ratio=0.5)) is None


@pytest.mark.parametrize("name", ["damping_ratio", "error_amplitude", "error_phase", "b"])
def test_the_shift_of_a_fold_is_its_derivative(name: str) -> None:
    fold = folds(OSC)[0]
    low, high = (OSC.replace(**{name: OSC.parameter(name) + side * 1e-5}) for side in (-1.0, 1.0))
    ends = [move_bifurcation(fold, each) for each in (low, high)]
    assert fold_shift(fold, low, high) == pytest.approx(ends[1].value - ends[0].value, rel=1e-5)
    assert abs(ends[1].value - ends[0].value) > 1e-8
