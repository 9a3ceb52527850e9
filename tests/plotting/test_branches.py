"""Pictures of branches and curves show their results' own numbers."""

import numpy as np
import pytest
from matplotlib.legend import Legend

import gearpair as gp
from gearpair import plotting


@pytest.fixture(scope="module")
def branch():
    orbit = gp.periodic_orbit(gp.Oscillator(), 0.34629, -0.25625, 2)
    return gp.continue_orbit(orbit, "mesh_frequency", 0.6, 1.19)


def test_solid_where_stable_and_dashed_where_not(branch):
    """Every stable orbit lies on a solid line and every unstable one on a dashed line, for each section point."""
    ax = plotting.branches([branch], markers=False)
    solid = [line for line in ax.lines if line.get_linestyle() == "-"]
    assert len(solid) == 2 and len(ax.lines) == 4
    for k, line in enumerate(solid):
        x, y = line.get_data()
        assert np.array_equal(np.isfinite(y), branch.stable)
        assert np.array_equal(y[branch.stable], branch.points[branch.stable, k, 0])
        assert np.array_equal(x, branch.values)
    dashed = [line.get_ydata() for line in ax.lines if line.get_linestyle() != "-"]
    assert all(np.all(np.isfinite(y[~branch.stable])) for y in dashed)


def test_each_bifurcation_has_its_mark(branch):
    ax = plotting.branches([branch])
    marks = [line for line in ax.lines if line.get_marker() in ("^", "o", "D")]
    shown = sorted(float(line.get_xdata()[0]) for line in marks)
    assert shown == sorted(b.value for b in branch.bifurcations)
    key = next(child for child in ax.get_children() if isinstance(child, Legend))
    assert {text.get_text() for text in key.get_texts()} == {b.kind for b in branch.bifurcations}


def test_periods_can_be_chosen(branch):
    assert not plotting.branches([branch], periods=[3]).lines


def test_a_curve_is_drawn_as_computed(branch):
    flip = next(b for b in branch.bifurcations if b.kind == "flip")
    curve = gp.continue_bifurcation(flip, {"mesh_frequency": (0.7, 0.9), "damping_ratio": (0.015, 0.025)})
    ax = plotting.bifurcation_curves([curve])
    assert np.array_equal(np.array(ax.lines[0].get_data()).T, curve.values)
    assert ax.lines[0].get_linestyle() == "--"


def test_a_period_map_has_one_pixel_for_each_motion():
    """Each pixel has the colour of its motion's name."""
    from matplotlib.colors import to_rgb

    axes = {"damping_ratio": [0.05, 0.1], "mesh_frequency": [0.7, 1.2, 1.7]}
    grid = gp.parameter_map(gp.Oscillator(), axes)
    ax = plotting.period_map(grid)
    pixels = ax.images[0].get_array()
    for i in range(2):
        for j in range(3):
            motion = gp.motion.motions_of(grid)[i, j]
            assert np.allclose(pixels[i, j], to_rgb(plotting.motion_colour(motion)))
    assert ax.get_xlim() == pytest.approx((0.45, 1.95)) and ax.get_ylim() == pytest.approx((0.025, 0.125))


def test_over_a_map_the_key_stands_below_and_the_legend_is_as_pale(branch):
    """No word covers a pixel, none is cut off, and the dots that name the colours are as pale as these."""
    flip = next(b for b in branch.bifurcations if b.kind == "flip")
    curve = gp.continue_bifurcation(flip, {"mesh_frequency": (0.7, 0.9), "damping_ratio": (0.015, 0.025)})
    grid = gp.parameter_map(gp.Oscillator(), {"damping_ratio": [0.015, 0.025], "mesh_frequency": [0.7, 0.8, 0.9]})
    ax = plotting.bifurcation_curves([curve], plotting.period_map(grid, alpha=0.5))
    ax.figure.canvas.draw()
    legend = ax.get_legend()
    key = next(each for each in ax.get_children() if isinstance(each, Legend) and each is not legend)
    box = key.get_window_extent()
    assert box.y0 >= 0.0 and box.y1 <= ax.xaxis.label.get_window_extent().y0 + 1.0
    assert {dot.get_alpha() for dot in legend.legend_handles} == {0.5}
