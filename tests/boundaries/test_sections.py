"""The map backward is the inverse of the map forward, and a section may lie at any phase."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import at_phase, backward_map
from tests.support.oscillators import BASELINE, random_case

HARMONICS = BASELINE.replace(harmonics=[(2, 0.05, 0.7), (5, 0.01, -2.0)], error_phase=0.4, mean_force=-0.2)


def cases(n=120):
    """Oscillators with starts, those whose damping leaves no digits of the way back left out."""
    rng = np.random.default_rng(3)
    found = [random_case(rng) for _ in range(n)]
    found += [(HARMONICS, *start) for start in ((0.3, -1.2), (1.0, 0.0), (-4.0, 2.0))]
    return [case for case in found if case[0].damping_ratio <= 1.0]


def test_backward_after_forward_is_the_identity_to_rounding():
    for osc, x, v in cases():
        there = gp.stroboscopic_map(osc, x, v)
        back = backward_map(osc, *there)
        size = max(1.0, abs(x), abs(v), *map(abs, there)) * np.exp(2.0 * osc.damping_ratio * osc.period)
        assert np.abs(np.subtract(back, (x, v))).max() <= 2e-14 * size, (osc, x, v)


def test_several_mesh_periods_and_many_starts_go_back_as_well():
    x, v = np.meshgrid(np.linspace(-2.0, 2.0, 9), np.linspace(-1.0, 1.0, 5))
    back = backward_map(HARMONICS, *gp.stroboscopic_map(HARMONICS, x, v, 4), 4)
    assert back[0].shape == x.shape
    assert np.abs(back[0] - x).max() < 1e-11 and np.abs(back[1] - v).max() < 1e-11
    np.testing.assert_array_equal(backward_map(HARMONICS, x, v, 0)[0], x)


@pytest.mark.parametrize("mapped, sign", [(gp.stroboscopic_map, -1.0), (backward_map, 1.0)])
def test_areas_scale_by_the_damping_alone(mapped, sign):
    """A polygon of many corners, whatever its image looks like."""
    turns = 2.0 * np.pi * np.arange(40_000) / 40_000

    def area(x, v):
        return 0.5 * np.sum(x * np.roll(v, -1) - np.roll(x, -1) * v)

    x, v = 0.4 + 0.9 * np.cos(turns), -0.2 + 0.9 * np.sin(turns)
    for osc in (BASELINE, HARMONICS, BASELINE.replace(mesh_frequency=1.219, damping_ratio=0.1)):
        ratio = area(*mapped(osc, x, v)) / area(x, v)
        assert ratio == pytest.approx(np.exp(sign * 2.0 * osc.damping_ratio * osc.period), rel=1e-6)


def test_what_grows_beyond_all_bounds_backward_is_infinite():
    x, _v = backward_map(BASELINE, 2.0, 3.0, 400)
    assert np.isinf(x)


@pytest.mark.parametrize("osc", [BASELINE, HARMONICS])
@pytest.mark.parametrize("step", [0, 7, 17, 24, 49])
def test_the_map_at_another_phase_passes_through_the_same_motion(osc, step):
    """Every fiftieth of a mesh period; the stiffness changes at 0.68, which is the 34th."""
    for start in ((0.3, -1.2), (-2.5, 1.0)):
        way = gp.trajectory(osc, *start, 3, samples_per_period=50)
        there = gp.stroboscopic_map(at_phase(osc, step / 50), way.x[step], way.v[step], 2)
        np.testing.assert_allclose(there, (way.x[step + 100], way.v[step + 100]), rtol=0.0, atol=1e-12)


def test_a_section_at_an_edge_of_the_wave_has_no_piece_of_no_length():
    at_edge = at_phase(BASELINE, BASELINE.stiffness.edges[1]).stiffness
    assert at_edge.levels == BASELINE.stiffness.levels[::-1]
    assert at_phase(BASELINE, 0.0).stiffness == BASELINE.stiffness
    assert len(at_phase(BASELINE, 0.5).stiffness.levels) == len(BASELINE.stiffness.levels) + (
        0.5 not in BASELINE.stiffness.edges
    )


def test_bad_phases_are_refused():
    with pytest.raises(ValueError, match="phase must be a finite number at least 0 and below 1, got 1.0"):
        at_phase(BASELINE, 1.0)
