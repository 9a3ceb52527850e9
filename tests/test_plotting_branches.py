"""Pictures of branches and curves show their results' own numbers."""

import matplotlib
import numpy as np
import pytest

import gearpair as gp
from gearpair import plotting

matplotlib.use("Agg")


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
    assert {text.get_text() for text in ax.get_legend().get_texts()} == {b.kind for b in branch.bifurcations}


def test_periods_can_be_chosen(branch):
    assert not plotting.branches([branch], periods=[3]).lines


def test_a_curve_is_drawn_as_computed(branch):
    flip = next(b for b in branch.bifurcations if b.kind == "flip")
    curve = gp.continue_bifurcation(flip, {"mesh_frequency": (0.7, 0.9), "damping_ratio": (0.015, 0.025)})
    ax = plotting.bifurcation_curves([curve])
    assert np.array_equal(np.array(ax.lines[0].get_data()).T, curve.values)
    assert ax.lines[0].get_linestyle() == "--"
