"""Pictures show their results' own numbers, under the right names."""

import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_rgb

import gearpair as gp
from gearpair import plotting
from gearpair.article import published
from gearpair.motion import periodic

OSC = gp.Oscillator()


@pytest.fixture(scope="module")
def result():
    """A sweep over period 2, period 4 and chaos."""
    return gp.sweep(OSC, "mesh_frequency", [0.7, 0.72, 0.78, 0.79, 0.86, 0.865])


@pytest.fixture(scope="module")
def plane():
    return gp.basins(OSC, np.linspace(-3, 3, 7), np.linspace(-2, 2, 5))


def legend_texts(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def labelled(ax):
    return {line.get_label(): line for line in ax.lines}


def test_import_sets_nothing_and_names_every_function():
    assert {"bifurcation_diagram", "gallery", "basins", "stiffness_wave"} <= set(plotting.__all__)
    assert not [name for name in plotting.__all__ if not hasattr(plotting, name)]
    assert matplotlib.rcParams["axes.titleweight"] == "normal"  # the style would make it bold


def test_colours_stay_apart_for_colour_blind_readers():
    """Any two colours differ in lightness or remain distinct under deuteranopia (Machado and others, 2009)."""
    deuteranopia = np.array([[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]])
    seen = {name: deuteranopia @ np.array(to_rgb(colour)) for name, colour in plotting.MOTION_COLOURS.items()}
    names = [f"period {p}" for p in (1, 2, 3, 4)] + ["chaos"]
    for i, one in enumerate(names):
        for other in names[:i]:
            assert np.linalg.norm(seen[one] - seen[other]) > 0.12, (one, other)


def test_bifurcation_diagram_draws_each_cycle_once_in_its_colour(result):
    ax = plotting.bifurcation_diagram(result, title="rising")
    lines = labelled(ax)
    motions = gp.motion.motions_of(result)
    for name, period in (("period 2", 2), ("period 4", 4)):
        chosen = motions == periodic(period)
        x, y = lines[name].get_data()
        shown = np.isfinite(y)
        assert np.array_equal(y[shown], result.x.values[chosen, :period].ravel())
        assert np.array_equal(x[shown], np.repeat(result.mesh_frequency.values[chosen], period))
        assert lines[name].get_color() == plotting.MOTION_COLOURS[name]
    assert np.array_equal(lines["chaos"].get_ydata(), result.x.values[motions == gp.motion.CHAOS].ravel())
    assert r"\Omega_h" in ax.get_xlabel()
    assert legend_texts(ax) == ["period 2", "period 4", "chaos"]
    assert ax.texts[0].get_text() == "rising"


def test_motions_without_bound_leave_the_others_their_room(result):
    """A period 2 that swings far, and one that has escaped: a triangle at the rim each, and the axis of the rest."""
    alone = plotting.bifurcation_diagram(result.isel(mesh_frequency=slice(2, None)))
    wild = result.copy(deep=True)
    wild.x[0] *= 1000.0
    wild.x[1] = 5.0  # where it happened to be when it was given up
    wild.status[1], wild.period[1] = "escaped", 0
    ax = plotting.bifurcation_diagram(wild)
    assert ax.get_ylim() == alone.get_ylim()
    marked = {line.get_label(): line for line in ax.lines if line.get_marker() == "^"}
    assert {name: line.get_xdata().tolist() for name, line in marked.items()} == {
        "period 2, not drawn": [0.7],
        "escaped, not drawn": [0.72],
    }
    ax.figure.canvas.draw()
    for line in marked.values():
        ((_, height),) = line.get_transform().transform(line.get_xydata())
        assert height == pytest.approx(ax.bbox.y1)
    wider = plotting.bifurcation_diagram(wild, reach=1e4)
    assert wider.get_ylim()[1] > 100.0 and "period 2, not drawn" not in labelled(wider)


def test_extremes_are_the_result_s(result):
    ax = plotting.extremes(result)
    drawn = np.concatenate([line.get_ydata() for line in ax.lines if line.get_marker() == "."])
    assert np.array_equal(np.sort(drawn), np.sort(np.concatenate([result.x_min, result.x_max])))
    assert sorted(line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == "--") == [-1.0, 1.0]


def test_exponents_rise_with_the_parameter_whatever_the_direction(result):
    ax = plotting.exponents(result.isel(mesh_frequency=slice(None, None, -1)), label="falling")
    x, y = labelled(ax)["falling"].get_data()
    assert np.array_equal(x, result.mesh_frequency) and np.array_equal(y, result.exponent)
    assert r"\lambda_1" in ax.get_ylabel()


def test_boundaries_outside_the_axes_are_left_out():
    _, ax = plt.subplots()
    ax.set_xlim(0.7, 1.0)
    plotting.mark_boundaries(published.boundaries("mesh_frequency"), ax)
    assert [line.get_xdata()[0] for line in ax.lines] == [0.799, 0.865]


def test_range_strips_set_runs_under_the_published_ranges(result):
    ax = plotting.range_strips({"published": published.ranges("mesh_frequency"), "found": result})
    assert [label.get_text() for label in ax.get_yticklabels()] == ["published", "found"]
    bars = [(bar.get_y() > 0.0, bar.get_x(), bar.get_width()) for bar in ax.patches]
    above = [(x, width) for below, x, width in bars if not below]
    assert np.allclose(above, [(r.lower, r.upper - r.lower) for r in published.ranges("mesh_frequency")])
    below = [(x, x + width) for below, x, width in bars if below]
    half = 0.0025  # of the smallest step
    assert np.allclose(below, [(r.lower - half, r.upper + half) for r in gp.ensembles.motion_ranges(result)])
    assert "complex" in [text.get_text() for text in ax.texts]


def test_range_lanes_give_each_motion_its_lane():
    found = [gp.ensembles.MotionRange(0.0, 0.02, periodic(1)), gp.ensembles.MotionRange(0.01, 0.015, periodic(3))]
    ax = plotting.range_lanes({"published": published.ranges("damping_ratio"), "found": found})
    assert [label.get_text() for label in ax.get_yticklabels()] == ["period 1", "period 3", "chaotic"]
    full = [(bar.get_x(), bar.get_width()) for bar in ax.patches if bar.get_alpha() is None]
    assert np.allclose(full, [(0.0, 0.02), (0.01, 0.005)])
    assert r"\zeta" in ax.get_xlabel()


def test_shares_are_stacked_to_one():
    shares = gp.ensembles.motion_shares(OSC, "damping_ratio", [0.01, 0.02, 0.05], [-2.0, 0.0, 1.0], [0.0, 1.0])
    ax = plotting.motion_shares(shares)
    tops = [band.get_paths()[0].vertices[:, 1].max() for band in ax.collections]
    assert tops[-1] == pytest.approx(1.0)
    assert tops[0] == pytest.approx(shares.share.values[:, 0].max())
    assert [band.get_label() for band in ax.collections] == shares.motion.values.tolist()


@pytest.fixture(scope="module")
def motion():
    return gp.trajectory(OSC, 1.0, 0.0, 6, n_transient=500)


def test_time_history_marks_the_contacts_made(motion):
    ax = plotting.time_history(motion, n_periods=4)
    curve = max(ax.lines, key=lambda line: len(line.get_xdata()))
    n = 4 * motion.samples_per_period + 1
    assert np.array_equal(curve.get_ydata(), motion.x[:n])
    assert np.allclose(curve.get_xdata(), motion.tau[:n] / OSC.period)
    made = motion.impacts.tau[motion.impacts.contact] / OSC.period
    assert np.allclose(labelled(ax)["contact made"].get_xdata(), made[made <= 4.0])
    assert labelled(plotting.time_history(motion, impacts=False)).keys() & {"contact made"} == set()


def test_phase_portrait_and_section_show_the_motion(motion):
    portrait = plotting.phase_portrait(motion)
    curve = max(portrait.lines, key=lambda line: len(line.get_xdata()))
    assert np.array_equal(curve.get_xdata(), motion.x) and np.array_equal(curve.get_ydata(), motion.v)
    assert (portrait.get_xlabel(), portrait.get_ylabel()) == ("displacement $X$", "velocity $X'$")
    x, v = plotting.poincare_section(motion).lines[0].get_data()
    assert np.array_equal(x, motion.x[:: motion.samples_per_period])
    assert np.array_equal(v, motion.v[:: motion.samples_per_period])


def test_spectrum_draws_lines_for_a_period_and_rules_its_multiples(motion):
    lines = gp.spectrum(motion)
    ax = plotting.spectrum(lines, period=2, highest=2.0)
    dots = next(line for line in ax.lines if line.get_marker() == "o")
    assert np.allclose(dots.get_xdata(), [0.5, 1.0, 1.5, 2.0])
    assert np.allclose(dots.get_ydata(), [lines.line(f) for f in (0.5, 1.0, 1.5, 2.0)])
    ruled = [line.get_xdata()[0] for line in ax.lines if line is not dots]
    assert np.allclose(ruled, [0.5, 1.0, 1.5, 2.0])
    assert ax.get_yscale() == "log"


def test_portrait_has_four_views_of_one_motion():
    state = gp.steady_state(OSC)
    axes = plotting.portrait(state, title="the baseline")
    assert len(axes) == 4 and axes[0].get_title(loc="left") == "the baseline"
    section = next(line for line in axes[2].lines if line.get_marker() == "o").get_xdata()
    assert np.allclose(np.unique(np.round(section, 9)), np.sort(np.round(state.points[:, 0], 9)))


def test_gallery_has_a_row_for_each_motion():
    states = {"period 2": gp.steady_state(OSC), "chaos": gp.steady_state(OSC.replace(mesh_frequency=1.219))}
    figure = plotting.gallery(states)
    assert len(figure.axes) == 8
    assert [figure.axes[i].get_title(loc="left").split("  ")[0] for i in (0, 4)] == ["period 2", "chaos"]
    with pytest.raises(ValueError, match="at least one motion"):
        plotting.gallery({})


def test_basins_and_impact_states_colour_every_start(plane):
    ax = plotting.basins(plane)
    assert np.array_equal(ax.collections[0].get_array(), plane.attractor.values + 1)
    assert legend_texts(ax) == list(map(str, gp.ensembles.attractor_motions(plane)))
    ax = plotting.impact_states(plane)
    shades = ax.collections[0].get_array()
    assert len(np.unique(shades)) == len(np.unique(plane.impact_state))
    assert np.array_equal(shades == shades.max(), plane.impact_state.values == "double")
    assert legend_texts(ax) == ["single-sided", "double-sided"]


def test_a_second_attractor_of_a_kind_is_paler(plane):
    twice = plane.isel(attractor_number=[0, 0])
    first, second = plotting.maps.attractor_colours(twice)
    assert first == pytest.approx(to_rgb(plotting.motion_colour(periodic(1))))
    assert sum(second) > sum(first)
    named = plotting.basins(twice).get_legend().get_patches()
    assert [patch.get_facecolor()[:3] for patch in named] == [pytest.approx(first)]  # not in the paler shade


def test_many_attractors_are_named_by_their_colours(plane):
    many = plane.isel(attractor_number=[0, 1] * 5)
    assert legend_texts(plotting.basins(many)) == ["period 1", "period 2"]


def test_shares_have_at_each_value_the_colour_of_the_motion_there():
    shares = gp.ensembles.continue_attractors(OSC, "mesh_frequency", [0.7, 0.72, 0.78], n=20, nearest=5.0)
    ax = plotting.attractor_shares(shares)
    (number,) = {int(i) for i in shares.attractor[(shares.attractor_period == 4).any("mesh_frequency")]}
    assert shares.attractor_period.sel(attractor=number).values.tolist() == [2, 2, 4]
    drawn = {area.get_label(): area for area in ax.collections}
    for name, ends in {"period 2": (0.7, 0.75), "period 4": (0.75, 0.78)}.items():
        across = drawn[name].get_paths()[0].vertices[:, 0]
        assert (across.min(), across.max()) == pytest.approx(ends)
        assert drawn[name].get_facecolor()[0][:3] == pytest.approx(
            to_rgb(plotting.motion_colour(periodic(int(name[-1]))))
        )
    assert {"period 1", "period 2", "period 4"} <= set(legend_texts(ax))


def test_transients_have_a_colour_and_a_name_of_their_own_and_escape_is_white(plane):
    mixed = plane.copy(deep=True)
    mixed.status[0, 0], mixed.status[1, 0] = "transient", "escaped"
    mixed.attractor[:2, 0] = -1
    ax = plotting.basins(mixed)
    (image,) = ax.collections
    shown = image.cmap(image.norm(image.get_array()))[:, :, :3]
    assert shown[0, 0] == pytest.approx(to_rgb(plotting.style.MOTION_COLOURS["chaotic transient"]))
    assert shown[1, 0] == pytest.approx((1.0, 1.0, 1.0))
    assert shown[0, 1] == pytest.approx(plotting.maps.attractor_colours(plane)[int(plane.attractor[0, 1])])
    names = list(map(str, gp.ensembles.attractor_motions(plane)))
    assert legend_texts(ax) == [*names, "chaotic transient"]
    many = mixed.isel(attractor_number=[0, 1] * 5)
    assert legend_texts(plotting.basins(many)) == ["period 1", "period 2", "chaotic transient"]


def test_starts_that_are_transients_still_stand_above_the_attractors():
    shares = gp.ensembles.continue_attractors(OSC, "mesh_frequency", [0.7, 0.72], n=20)
    shares = shares.assign(share=shares.share * [[0.75], [1.0]], transient_share=("mesh_frequency", [0.25, 0.0]))
    ax = plotting.attractor_shares(shares)
    (area,) = [each for each in ax.collections if each.get_label() == "chaotic transient"]
    corners = area.get_paths()[0].vertices
    assert (*corners.min(axis=0), *corners.max(axis=0)) == pytest.approx((0.7, 0.75, 0.71, 1.0))
    assert area.get_facecolor()[0][:3] == pytest.approx(to_rgb(plotting.style.MOTION_COLOURS["chaotic transient"]))
    assert legend_texts(ax)[-1] == "chaotic transient"


def test_attractor_points_are_the_cycles(plane):
    state = gp.steady_state(OSC)
    ax = plotting.attractor_points([state], plotting.basins(plane))
    assert np.array_equal(np.column_stack(ax.lines[-1].get_data()), state.points)


def test_finite_exponents_are_the_result_s(plane):
    ax = plotting.finite_exponents(plane)
    assert np.array_equal(ax.collections[0].get_array(), plane.exponent.values)


def test_stiffness_wave_and_harmonics():
    wave = OSC.stiffness
    ax = plotting.stiffness_wave(wave, n_periods=2)
    levels, edges, _ = ax.patches[0].get_data()
    assert np.array_equal(levels, np.tile(wave.levels, 2))
    assert np.allclose(edges, [0.0, 0.68, 1.0, 1.68, 2.0])
    assert any(np.all(np.asarray(line.get_ydata()) == wave.mean) for line in ax.lines)
    dots = plotting.harmonics(wave, 5).lines[0]
    assert np.array_equal(dots.get_ydata(), 2 * np.abs(wave.harmonics(5)[1:]))


def test_a_logarithmic_bar_has_plain_numbers_and_says_what_lies_beyond():
    axes = {"damping_ratio": [0.005, 0.05], "mesh_frequency": [0.7, 1.2, 1.6]}
    grid = gp.parameter_map(gp.Oscillator(), axes, measures=True)
    bars = [
        plotting.quantity_map(grid, "load_factor", **ends, logarithmic=True).images[0].colorbar
        for ends in ({"smallest": 1.0, "largest": 16.0}, {"smallest": 6.0}, {"smallest": 6.0, "largest": 16.0}, {})
    ]
    assert [bar.extend for bar in bars] == ["max", "min", "both", "neither"]  # the map has 5.0 to 17.1
    assert (bars[0].vmin, bars[0].vmax) == pytest.approx((1.0, 16.0))
    bars[0].ax.figure.canvas.draw()
    ticks = zip(bars[0].ax.get_yticks(), bars[0].ax.get_yticklabels(), strict=True)
    assert [text.get_text() for at, text in ticks if 1.0 <= at <= 16.0] == ["1", "2", "5", "10"]


def test_longer_periods_share_a_colour_in_shades():
    """Periods 5 and 7 have no colour of their own: in a plane of starts each has a shade."""
    plane = gp.basins(gp.Oscillator(damping_ratio=0.001, mesh_frequency=1.95), np.linspace(-4, 4, 9), [0.0, 2.0])
    names = [str(motion) for motion in gp.ensembles.attractor_motions(plane)]
    colours = plotting.maps.attractor_colours(plane)
    assert sum(name.split(",")[0] not in plotting.MOTION_COLOURS for name in names) > 1
    assert len(set(colours)) == len(colours)
