"""The survival curve shows the survivors, the fitted rate and the time watched."""

import numpy as np
import pytest

import gearpair as gp
from gearpair import plotting
from gearpair.ensembles.lifetimes import estimate_of


def survival(frequency, **how):
    return gp.survival(gp.Oscillator(mesh_frequency=frequency), [-1.0, 0.0, 1.0, 2.0], -1.0, **how)


def test_the_steps_are_the_survivors_and_the_line_falls_with_the_rate():
    result = survival(1.09)
    ax = plotting.survival_curve(result)
    steps, _discarded, line = ax.lines
    shown = result.survivors.values > 0
    np.testing.assert_array_equal(steps.get_ydata()[shown], result.survivors.values[shown])
    np.testing.assert_array_equal(steps.get_xdata(), result.waited.values)
    assert np.all(steps.get_ydata()[~shown] < ax.get_ylim()[0]) and steps.get_drawstyle() == "steps-post"
    tau, fitted = line.get_data()
    assert (tau[0], fitted[0]) == (500.0, result.n_watched.item())
    slope = np.polyfit(tau, np.log(fitted), 1)[0]
    assert slope == pytest.approx(-result.escape_rate.item(), rel=1e-9)
    strip = ax.collections[0].get_paths()[0].vertices
    assert strip[:, 1].max() == pytest.approx(result.n_watched.item())
    at_end = strip[np.isclose(strip[:, 0], 20_000.0), 1]
    for rate in (result.escape_rate_low.item(), result.escape_rate_high.item()):
        assert np.isclose(at_end, result.n_watched.item() * np.exp(-rate * 19_500.0)).any()
    dotted, told = [text.get_text() for text in ax.get_legend().get_texts()]
    assert dotted == "counted from here on" and told == estimate_of(result).told and " to " in told
    assert result.escape_time.max() < ax.get_xlim()[1] < 20_000.0
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("mesh periods", "starts still on their way")


def test_without_an_escape_there_is_a_bound_and_no_line():
    result = survival(1.219, n_periods=1500)
    ax = plotting.survival_curve(result, colour="#009E73")
    assert len(ax.lines) == 2 and ax.lines[0].get_color() == "#009E73"
    assert ax.get_legend().get_texts()[1].get_text().startswith("mean life at least 1000 mesh")
    assert plotting.survival_curve(result, legend=False).get_legend() is None


def test_the_scale_begins_where_the_survivors_or_their_strip_end():
    """No room is left empty below the last survivors, and each tick is a plain number of starts."""
    rng = np.random.default_rng(0)
    starts = rng.uniform(-2.0, 2.0, 100), rng.uniform(-1.5, 1.5, 100)
    result = gp.survival(gp.Oscillator(mesh_frequency=1.09), *starts, n_periods=2000)
    ax = plotting.survival_curve(result)
    left, lowest = result.survivors.values[-1], ax.collections[0].get_paths()[0].vertices[:, 1].min()
    assert 1 < lowest < left and ax.get_ylim()[0] == pytest.approx(0.7 * lowest)
    ax.figure.canvas.draw()
    bottom, top = ax.get_ylim()
    shown = [label.get_text() for label in ax.get_yticklabels() if bottom <= label.get_position()[1] <= top]
    assert len(shown) >= 2 and all(text.isdigit() for text in shown)


def test_where_nothing_was_left_to_watch_the_survivors_are_drawn_alone():
    osc = gp.Oscillator(damping_ratio=0.1)
    ax = plotting.survival_curve(gp.survival(osc, [0.0, 1.0], 0.0, n_periods=600))
    assert (len(ax.lines), len(ax.collections), ax.get_legend()) == (2, 0, None)
    on_it = gp.steady_state(osc).points[0].tolist()
    ax = plotting.survival_curve(gp.survival(osc, *on_it, n_periods=600, discard=0))
    assert ax.get_ylim()[1] > 1.0


def test_several_watches_begin_at_one_and_fall_with_their_rates():
    results = {"short": survival(1.09), "long": survival(1.219)}
    ax = plotting.survival_curves(results, until=8000, lowest=0.02)
    steps = {line.get_label(): line for line in ax.lines if line.get_drawstyle() == "steps-post"}
    assert [*steps] == ["short", "long"]  # by their mean lives
    assert sum(steps["short"].get_color()[:3]) > sum(steps["long"].get_color()[:3])
    for name, result in results.items():
        tau, shares = steps[name].get_data()
        assert (tau[0], shares[0]) == (0.0, 1.0)
        counted = result.survivors.values[result.waited.values >= 500]
        np.testing.assert_allclose(shares[counted > 0] * result.n_watched.item(), counted[counted > 0], rtol=1e-12)
        assert np.all(shares[counted == 0] < 0.02)
    (fitted,) = [line for line in ax.lines if line.get_drawstyle() != "steps-post"]
    tau, shares = fitted.get_data()
    slope = np.polyfit(tau, np.log(shares), 1)[0]
    assert slope == pytest.approx(-results["short"].escape_rate.item(), rel=1e-9)
    assert (ax.get_xlim(), ax.get_ylim()[0], ax.get_yscale()) == ((0.0, 8000.0), 0.02, "log")


def test_a_name_stands_where_its_curve_leaves_the_picture():
    short = survival(1.09)
    ax = plotting.survival_curves({"short": short, "long": survival(1.219)}, until=8000, lowest=0.02)
    places = {text.get_text(): text.xy for text in ax.texts}
    assert places["long"] == (8000.0, 1.0)
    at, height = places["short"]
    assert 0.02 < height < 0.05 and height == pytest.approx(np.exp(-short.escape_rate.item() * at), rel=1e-9)


def test_what_had_nothing_left_to_watch_is_left_out():
    osc = gp.Oscillator(damping_ratio=0.1)
    ax = plotting.survival_curves({"direct": gp.survival(osc, [0.0, 1.0], 0.0, n_periods=600)})
    assert (len(ax.lines), len(ax.texts), ax.get_xlim()) == (0, 0, (0.0, 100.0))
