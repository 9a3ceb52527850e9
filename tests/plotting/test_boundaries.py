"""The picture of manifolds draws every branch, over a map of basins or alone."""

import numpy as np
import pytest
from matplotlib.legend import Legend

import gearpair as gp
from gearpair import plotting


@pytest.fixture(scope="module")
def found():
    return gp.manifolds(gp.periodic_orbit(gp.Oscillator(), -1.5688, -1.0135, 1), length=3.0)


def keys_in(ax):
    """The legends inside the axes."""
    return [each for each in ax.get_children() if isinstance(each, Legend) and each is not ax.get_legend()]


def test_each_branch_is_a_line_and_the_saddle_a_mark(found):
    ax = plotting.manifolds(found)
    *curves, dots = ax.lines
    for line, curve in zip(curves, (*found.stable, *found.unstable), strict=True):
        np.testing.assert_array_equal(np.column_stack(line.get_data()), curve)
    assert [line.get_label() for line in curves] == 2 * ["stable manifold"] + 2 * ["unstable manifold"]
    assert {line.get_linestyle() for line in curves[:2]} == {"-"} and curves[2].get_linestyle() == "--"
    np.testing.assert_array_equal(np.column_stack(dots.get_data()), found.orbit.points)
    assert ax.get_xlabel() == "displacement $X$" and ax.get_ylabel() == "velocity $X'$"


def test_over_basins_the_limits_the_labels_and_the_legend_stay(found):
    ax = plotting.basins(gp.basins(gp.Oscillator(), [-2.0, 1.0], [0.0, 0.5]))
    limits, label, key = (ax.get_xlim(), ax.get_ylim()), ax.get_xlabel(), ax.get_legend()
    assert plotting.manifolds(found, ax) is ax
    assert (ax.get_xlim(), ax.get_ylim()) == limits and ax.get_xlabel() == label
    assert ax.get_legend() is key  # above the axes, and not cut off by them
    (own,) = keys_in(ax)
    assert [text.get_text() for text in own.get_texts()] == ["stable manifold", "unstable manifold", "saddle"]
    ax.figure.canvas.draw()
    assert own.get_window_extent().y1 <= ax.xaxis.label.get_window_extent().y0 + 1.0  # and covers no basin


def test_without_a_legend_there_is_none(found):
    assert keys_in(plotting.manifolds(found, legend=False)) == []


def test_a_chaotic_saddle_is_drawn_point_by_point():
    result = gp.ensembles.chaotic_saddle(gp.Oscillator(mesh_frequency=1.09), [0.0, 1.0], -1.0, n_periods=700)
    ax = plotting.chaotic_saddle(result, colour="#009E73")
    (dots,) = ax.lines
    np.testing.assert_array_equal(np.column_stack(dots.get_data()), np.column_stack([result.x, result.v]))
    assert (dots.get_color(), dots.get_linestyle(), ax.get_ylabel()) == ("#009E73", "None", "velocity $X'$")
