"""The anatomy of the exact flow is the engine's, and pictures of the method show their results' own numbers."""

import numpy as np
import pytest

import gearpair as gp
from gearpair import plotting

CHAOTIC = gp.Oscillator(mesh_frequency=1.219)


@pytest.fixture(scope="module")
def pieces():
    return [piece for x in np.linspace(-1.5, 1.5, 16) for piece in gp.methods.segments(CHAOTIC, float(x), 0.0, 20)]


@pytest.fixture(scope="module")
def examples(pieces):
    return gp.methods.certificate_examples(pieces)


def line(ax, label):
    return next(line for line in ax.lines if line.get_label() == label)


def test_segments_are_those_of_the_trajectory():
    """They join, end where the map ends, and their crossings are its impacts."""
    parts = gp.methods.segments(CHAOTIC, 1.3, 0.2, 5)
    for before, after in zip(parts, parts[1:], strict=False):
        end = before.span if before.crossing is None else before.crossing
        assert before.start + end * before.width == pytest.approx(after.start, abs=1e-12)
        assert before(end) == pytest.approx(after(0.0), abs=1e-13)
    x, _v = gp.stroboscopic_map(CHAOTIC, 1.3, 0.2, 5)
    assert parts[-1](parts[-1].span) == pytest.approx(float(x), abs=1e-12)
    crossings = [part.start + part.crossing * part.width for part in parts if part.crossing is not None]
    impacts = gp.trajectory(CHAOTIC, 1.3, 0.2, 5).impacts
    np.testing.assert_allclose(np.array(crossings) * CHAOTIC.period, impacts.tau, rtol=0, atol=1e-12)


def test_certified_steps_alone_find_what_the_engine_found(pieces):
    """Two independent searches for the first crossing of each segment."""
    assert sum(piece.crossing is not None for piece in pieces) > 300
    for piece in pieces:
        _steps, crossing = piece.certified_steps()
        assert (crossing is None) == (piece.crossing is None)
        if crossing is not None:
            slope = np.polynomial.polynomial.polyval(crossing, np.polynomial.polynomial.polyder(piece.series))
            assert abs(crossing - piece.crossing) <= 1e-15 * 20.0 / abs(slope)


def test_certificates_hold(pieces):
    """The motion stays within the spread of the cubic, in the hull, and above every step's parabola."""
    for piece in pieces[::3]:
        t = np.linspace(0.0, piece.span, 50)
        assert np.all(np.abs(piece(t) - piece.cubic(t)) <= piece.spread + 1e-15)
        if piece.certificate == "hull":
            assert piece.crossing is None
        for step in piece.certified_steps()[0]:
            h = np.linspace(0.0, step.length, 20)
            distance = np.abs(piece(step.t + h) - step.boundary)
            assert np.all(distance >= step.d + step.u * h + 0.5 * step.m * h * h - 1e-14)


def test_certificate_table_counts_every_segment(pieces):
    rows = gp.methods.certificate_table(pieces).rows
    assert sum(int(row[1]) for row in rows) == len(pieces)
    assert rows[0][2] == "0"


def test_split_levels_change_only_rounding():
    x, v = np.array([-1.0, 0.3, 1.5]), np.array([0.4, 0.0, -0.2])
    here, there = gp.stroboscopic_map(CHAOTIC, x, v), gp.stroboscopic_map(gp.methods.split_levels(CHAOTIC), x, v)
    assert np.abs(np.array(here) - np.array(there)).max() < 1e-13


def test_a_missing_impact_is_seen():
    impacts = gp.trajectory(CHAOTIC, 0.5, 0.0, 3).impacts
    none = gp.trajectory(gp.Oscillator(mean_force=3.0), 4.0, 0.0, 1).impacts
    assert len(none) == 0
    assert gp.methods.impact_time_error(none, impacts) == np.inf
    assert gp.methods.impact_time_error(impacts, none) == 0.0


def test_work_precision_errors_fall_with_the_tolerance():
    measured = gp.methods.work_precision(CHAOTIC, 1.0, 0.0, n_starts=3, tolerances=[1e-3, 1e-9])
    errors = {method: [m.error for m in measured if m.method == method] for method in {m.method for m in measured}}
    exact = errors.pop("exact flow")
    assert exact[0] < 1e-13
    assert all(tight < 1e-3 * loose and tight > 100 * exact[0] for loose, tight in errors.values())
    ax = plotting.work_precision(measured)
    assert {drawn.get_label() for drawn in ax.lines} == {*errors, "exact flow"}
    assert line(ax, "DOP853").get_xdata().tolist() == errors["DOP853"]


def test_numerical_chaos_is_red():
    values = [1.219, 1.65, 1.7]
    exact = gp.sweep(CHAOTIC, "mesh_frequency", values)
    loose = gp.methods.runge_kutta_sweep(CHAOTIC, "mesh_frequency", values)
    tight = gp.methods.runge_kutta_sweep(CHAOTIC, "mesh_frequency", values, rtol=1e-9, atol=1e-12)
    assert gp.methods.numerical_chaos(exact, loose).tolist() == [False, True, True]
    assert not gp.methods.numerical_chaos(exact, tight).any()
    assert not gp.methods.numerical_chaos(exact, gp.methods.plain_sweep(CHAOTIC, "mesh_frequency", values)).any()
    red = line(plotting.drawn_diagram(exact, loose), "disordered, though periodic in the end")
    assert set(red.get_xdata()) == {1.65, 1.7}
    with pytest.raises(ValueError, match="same values of mesh_frequency"):
        gp.methods.numerical_chaos(exact, gp.methods.plain_sweep(CHAOTIC, "mesh_frequency", [1.65]))


def test_pictures_of_certificates(examples):
    ax = plotting.certificate(examples["monotone"])
    np.testing.assert_array_equal(line(ax, "Bézier points").get_xydata(), examples["monotone"].control_points)
    assert line(ax, "crossing").get_xdata()[0] == examples["monotone"].crossing
    drawn = line(plotting.interpolation_error(examples["hull"]), "motion - cubic").get_ydata()
    assert 0.0 < np.abs(drawn).max() < 10.0


def test_pictures_of_steps(examples):
    near, crossing = examples["near miss"], examples["crossing by steps"]
    ax = plotting.certified_steps(near)
    assert line(ax, "distance").get_ydata().min() > 0.0
    assert len([drawn for drawn in ax.lines if drawn.get_linestyle() == "--"]) == len(near.certified_steps()[0])
    left = line(plotting.step_convergence(crossing), "distance").get_ydata()
    assert left[-1] < 1e-3 * left[-2]


@pytest.mark.parametrize("picture", ["certificate", "interpolation_error", "certified_steps", "step_convergence"])
def test_nothing_to_show_is_said(picture):
    ax = getattr(plotting, picture)(None)
    assert [text.get_text() for text in ax.texts] == ["none met"]
