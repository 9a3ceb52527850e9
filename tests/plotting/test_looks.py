"""Every picture takes matplotlib's keywords, keeps its legends in the figure and is legible on light and dark."""

import inspect
from functools import cache

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.collections import Collection, LineCollection, QuadMesh
from matplotlib.colors import same_color, to_hex, to_rgb
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import gearpair as gp
from gearpair import plotting
from gearpair.article import PRINTED, SWAPPED, published
from gearpair.article.case import Protocol, ranking, reached, run_trials
from gearpair.methods import Integrator
from gearpair.plotting.paper import contrast, paper

OSC = gp.Oscillator()
MESHES = {"34 and 34 teeth": gp.mesh_stiffness(gp.SpurPair(), n_phases=50)}
(MESH,) = MESHES.values()
LOADED = gp.teeth.loaded_mesh(MESH, gp.teeth.tip_relief(MESH, 20.0, 20.0, 0.4), 2000.0)
STYLES = ("default", "dark_background")
PLANE = {"x": np.linspace(-3.0, 3.0, 25), "v": np.linspace(-2.0, 2.0, 9)}
SPEEDS = np.linspace(2000.0, 6000.0, 9)


@cache
def made(name):
    """What the pictures are of, made once."""
    drive = gp.GearDrive.from_pair(
        gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.03
    )
    grid = {"damping_ratio": [0.02, 0.05, 0.1], "mesh_frequency": [0.6, 0.7, 0.8, 1.219]}
    makers = {
        "along": lambda: gp.ensembles.continue_attractors(OSC, "mesh_frequency", [0.7, 0.75, 0.78, 0.865], n=20),
        "branch": lambda: gp.continue_orbit(gp.periodic_orbit(OSC, 0.34629, -0.25625, 2), "mesh_frequency", 0.7, 0.78),
        "chart": lambda: gp.design.speed_chart(drive, SPEEDS, n_starts=2, locate_jumps=True),
        "curve": lambda: gp.continue_bifurcation(
            made("branch").bifurcations[0], {"mesh_frequency": (0.76, 0.78), "damping_ratio": (0.019, 0.021)}
        ),
        "drawn": lambda: gp.methods.runge_kutta_sweep(OSC, "mesh_frequency", made("sweep").mesh_frequency),
        "fe": lambda: gp.teeth.finite_element_bodies()["34"],
        "identified": lambda: gp.design.identify(drive.at_phase(0.3), 8598.25, 7345.0),
        "idle": lambda: gp.design.idle_rattle(
            drive, np.linspace(300.0, 1500.0, 5), order=2.0, pinion_swing_deg=0.05, drag_torque_nm=0.4
        ),
        "loads": lambda: gp.design.load_map(drive, [50.0, 100.0], SPEEDS, n_starts=0, locate_jumps=False),
        "manifolds": lambda: gp.manifolds(gp.periodic_orbit(OSC, -1.5688, -1.0135, 1), length=3.0),
        "map": lambda: gp.parameter_map(OSC, grid, measures=True),
        "motion": lambda: gp.trajectory(OSC, 1.0, 0.0, 8),
        "passage": lambda: gp.design.run_up(drive.at_phase(0.0), 3000.0, 4000.0, 0.1, samples_per_period=16),
        "plane": lambda: gp.basins(OSC, **PLANE),
        "population": lambda: gp.design.population(
            drive, {"transmission_error_um": (0.5, 8.0), "backlash_um": (60.0, 100.0)}, SPEEDS, n=16
        ),
        "precision": lambda: gp.methods.work_precision(OSC, 1.0, 0.0, n_starts=2, tolerances=[1e-6, 1e-7]),
        "ranked": lambda: ranking(run_trials([PRINTED, SWAPPED], [Protocol("down")], 6)),
        "reached": lambda: tuple(
            reached([SWAPPED], name, 3, n_discarded=100) for name in ("mesh_frequency", "damping_ratio")
        ),
        "saddle": lambda: gp.ensembles.chaotic_saddle(OSC.replace(mesh_frequency=1.09), [-1.0, 0.0, 1.0, 2.0], -1.0),
        "shocks": lambda: gp.design.shock_margin(drive.at_phase(0.0), [3000.0, 3100.0], n_phases=1, n_starts=0),
        "segment": lambda: next(s for s in gp.methods.segments(OSC, 1.0, 0.0) if s.crossing is not None),
        "sensitivity": lambda: gp.design.sensitivity(drive, [2000.0, 3000.0], {"damping_ratio": (0.02, 0.06)}),
        "shares": lambda: gp.ensembles.motion_shares(OSC, "damping_ratio", [0.02, 0.1, 0.2], [-2.0, 0.0, 1.0], [0.0]),
        "state": lambda: gp.steady_state(OSC),
        "survival": lambda: gp.survival(OSC.replace(mesh_frequency=1.09), [-1.0, 0.0, 1.0, 2.0], -1.0),
        "sweep": lambda: gp.sweep(OSC, "mesh_frequency", [0.7, 0.72, 0.78, 0.865, 1.0, 1.219]),
        "trials": lambda: run_trials([SWAPPED], [Protocol("restart", 50)], 6, [Integrator(steps=20)]),
    }
    return makers[name]()


def rows(n):
    """Axes of a new figure of the usual size."""
    return list(plt.figure().subplots(n, 1))


# By the function: a call on axes (or on none, for those that need their own), with a look.
ON_AXES = {
    "attractor_points": lambda ax, **k: plotting.attractor_points([made("state")], ax or plt.figure().subplots(), **k),
    "attractor_shares": lambda ax, **k: plotting.attractor_shares(made("along"), ax, **k),
    "basins": lambda ax, **k: plotting.basins(made("plane"), ax, **k),
    "bifurcation_curves": lambda ax, **k: plotting.bifurcation_curves([made("curve")], ax, **k),
    "bifurcation_diagram": lambda ax, **k: plotting.bifurcation_diagram(made("sweep"), ax, title="run up", **k),
    "branches": lambda ax, **k: plotting.branches([made("branch")], ax, **k),
    "certificate": lambda ax, **k: plotting.certificate(made("segment"), ax, **k),
    "certified_steps": lambda ax, **k: plotting.certified_steps(made("segment"), ax, **k),
    "chaotic_saddle": lambda ax, **k: plotting.chaotic_saddle(made("saddle"), ax, **k),
    "compliance_stack": lambda ax, **k: plotting.compliance_stack(MESH, ax, **k),
    "contact_ratio_cloud": lambda ax, **k: plotting.contact_ratio_cloud(
        [[1.6, 1.65, 1.7], [1.5, 1.55, 1.6]], published.STIFFNESS_TABLE, ax, **k
    ),
    "coverage_by_phase": lambda ax, **k: plotting.coverage_by_phase(*made("reached"), ax, **k),
    "drawn_diagram": lambda ax, **k: plotting.drawn_diagram(made("sweep"), made("drawn"), ax, title="drawn", **k),
    "dynamic_factors": lambda ax, **k: plotting.dynamic_factors(made("chart"), None, ax, **k),
    "exponents": lambda ax, **k: plotting.exponents(made("sweep"), ax, **k),
    "extremes": lambda ax, **k: plotting.extremes(made("sweep"), ax, **k),
    "finite_exponents": lambda ax, **k: plotting.finite_exponents(made("plane"), ax, **k),
    "fold_curves": lambda ax, **k: plotting.fold_curves(made("identified"), ax, **k),
    "harmonics": lambda ax, **k: plotting.harmonics(OSC.stiffness, 5, ax, **k),
    "impact_map": lambda ax, **k: plotting.impact_map(made("map"), ax, **k),
    "impact_states": lambda ax, **k: plotting.impact_states(made("plane"), ax, **k),
    "interpolation_error": lambda ax, **k: plotting.interpolation_error(made("segment"), ax, **k),
    "load_map": lambda ax, **k: plotting.load_map(made("loads"), ax, **k),
    "load_shares": lambda ax, **k: plotting.load_shares(MESHES, ax, **k),
    "manifolds": lambda ax, **k: plotting.manifolds(made("manifolds"), ax, **k),
    "mark_boundaries": lambda ax, **k: plotting.mark_boundaries(
        published.boundaries("mesh_frequency"), plotting.exponents(made("sweep"), ax, color="#808080"), **k
    ),
    "mesh_curves": lambda ax, **k: plotting.mesh_curves(MESHES | {"again": MESH}, ax, **k),
    "motion_shares": lambda ax, **k: plotting.motion_shares(made("shares"), ax, **k),
    "order_map": lambda ax, **k: plotting.order_map(made("passage"), ax, **k),
    "passage_factor": lambda ax, **k: plotting.passage_factor(made("passage"), made("chart"), ax, **k),
    "passage_path": lambda ax, **k: plotting.passage_path(made("passage"), made("plane"), ax, **k),
    "pair_stiffness": lambda ax, **k: plotting.pair_stiffness(MESH, ax, **k),
    "period_map": lambda ax, **k: plotting.period_map(made("map"), ax, **k),
    "phase_portrait": lambda ax, **k: plotting.phase_portrait(made("motion"), ax, **k),
    "poincare_section": lambda ax, **k: plotting.poincare_section(made("state"), ax, **k),
    "quantity_map": lambda ax, **k: plotting.quantity_map(made("map"), "load_factor", ax, **k),
    "range_lanes": lambda ax, **k: plotting.range_lanes(
        {"article": published.ranges("mesh_frequency"), "found": gp.ensembles.motion_ranges(made("sweep"))}, ax, **k
    ),
    "range_strips": lambda ax, **k: plotting.range_strips(
        {"article": published.ranges("mesh_frequency"), "found": made("sweep")}, ax, **k
    ),
    "rattle": lambda ax, **k: plotting.rattle(made("idle"), ax, **k),
    "rattling_share": lambda ax, **k: plotting.rattling_share(made("population"), ax, **k),
    "reached_motions": lambda ax, **k: plotting.reached_motions(made("reached")[0][0], ax, **k),
    "score_ranking": lambda ax, **k: plotting.score_ranking(made("ranked"), {"swapped": SWAPPED}, ax, **k),
    "shock_margins": lambda ax, **k: plotting.shock_margins(made("shocks"), ax, **k),
    "spectrum": lambda ax, **k: plotting.spectrum(gp.spectrum(made("motion")), ax, period=2, **k),
    "step_convergence": lambda ax, **k: plotting.step_convergence(made("segment"), ax, **k),
    "stiffness_wave": lambda ax, **k: plotting.stiffness_wave(OSC.stiffness, ax, **k),
    "survival_curve": lambda ax, **k: plotting.survival_curve(made("survival"), ax, **k),
    "survival_curves": lambda ax, **k: plotting.survival_curves(
        {"short": made("survival"), "again": made("survival")}, ax, **k
    ),
    "time_history": lambda ax, **k: plotting.time_history(made("motion"), ax, **k),
    "tooth_outlines": lambda ax, **k: plotting.tooth_outlines(gp.SpurPair().pinion, ax, **k),
    "tornado": lambda ax, **k: plotting.tornado(made("sensitivity"), "dynamic_factor", ax, **k),
    "work_precision": lambda ax, **k: plotting.work_precision(made("precision"), ax, **k),
}
OF_THEIR_OWN = {
    "boundaries_by_step": lambda **k: plotting.boundaries_by_step(made("trials"), **k),
    "finite_element_check": lambda **k: plotting.finite_element_check(made("fe"), MESH, rows(2), **k),
    "gallery": lambda **k: plotting.gallery({"period 2": made("state")}, **k).axes,
    "portrait": lambda **k: plotting.portrait(made("state"), **k),
    "stiffness_trends": lambda **k: plotting.stiffness_trends(published.STIFFNESS_TABLE, {}, rows(3), **k),
    "tooth_loads": lambda **k: plotting.tooth_loads(made("chart"), tuple(rows(2)), **k),
    "under_load": lambda **k: plotting.under_load({"2 kN": LOADED}, rows(3), **k),
}
CALLS = {name: lambda call=call, **k: [call(None, **k)] for name, call in ON_AXES.items()} | OF_THEIR_OWN
IMAGES = {
    *("basins", "finite_exponents", "impact_map", "impact_states"),
    *("load_map", "order_map", "period_map", "quantity_map"),
}
BY_STATE = {"range_strips", "dynamic_factors"}  # whose words stand on bars, which are as light in every style
NO_PICTURES = {"add_motion_legend", "bare", "motion_colour", "per_width"}


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def parts(axes, kinds):
    """All artists of some kinds, legends' and colour bars' own left out."""
    return [artist for ax in axes for artist in ax.get_children() if isinstance(artist, kinds)]


def test_every_picture_is_in_the_table_and_takes_a_look():
    drawn = {name for name in plotting.__all__ if inspect.isfunction(getattr(plotting, name))}
    assert drawn - NO_PICTURES == CALLS.keys()
    for name in CALLS:
        kinds = {each.name: each.kind for each in inspect.signature(getattr(plotting, name)).parameters.values()}
        assert kinds["look"] is inspect.Parameter.VAR_KEYWORD and not kinds.keys() & {"colour", "color", "lw"}


@pytest.mark.parametrize("name", sorted(CALLS.keys() - IMAGES))
def test_a_colour_and_a_width_reach_what_is_drawn(name):
    given = {"color": "#12AB34", "lw": 2.75}
    for look in (given, {"colour": "#12AB34", "linewidth": 2.75}):
        found = [
            artist
            for artist in parts(CALLS[name](**look), (Line2D, Patch, Collection))
            if np.allclose(artist.get_linewidth(), 2.75)
        ]
        assert found
        for artist in found:
            if isinstance(artist, Line2D):
                assert same_color(artist.get_color(), given["color"])
            else:
                colours = *np.atleast_2d(artist.get_facecolor()), *np.atleast_2d(artist.get_edgecolor())
                assert any(same_color(to_hex(colour), given["color"]) for colour in colours)


@pytest.mark.parametrize("name", sorted(IMAGES))
def test_a_transparency_reaches_an_image(name):
    (image,) = parts(CALLS[name](alpha=0.25), (QuadMesh, AxesImage))
    assert image.get_alpha() == 0.25
    if name in ("finite_exponents", "load_map", "order_map", "quantity_map"):
        (image,) = parts(CALLS[name](cmap="magma"), (QuadMesh, AxesImage))
        assert image.get_cmap().name == "magma"


@pytest.mark.parametrize("name", sorted(CALLS))
def test_an_option_that_nobody_has_gets_a_sentence(name):
    with pytest.raises(TypeError, match="unknown option colr='red': neither of this function nor of a "):
        CALLS[name](colr="red")


def legends(axes):
    return parts(axes, Legend)


def outside(legend):
    """By how many pixels a legend leaves its figure."""
    box, page = legend.get_window_extent(), legend.figure.bbox
    return max(page.x0 - box.x0, box.x1 - page.x1, page.y0 - box.y0, box.y1 - page.y1)


@pytest.mark.parametrize("name", sorted(CALLS))
def test_legends_stay_in_the_figure(name):
    for drawn in ([ON_AXES[name](plt.figure().subplots())] if name in ON_AXES else [], CALLS[name]()):
        for ax in drawn:
            ax.figure.canvas.draw()
        assert all(outside(legend) <= 1.0 for legend in legends(drawn))


def test_a_legend_of_many_motions_gets_rows_and_a_huge_one_goes_inside():
    motions = [gp.motion.periodic(n) for n in (1, 2, 3, 4, 5, 6, 8)] + [gp.motion.CHAOS]
    ax = plt.figure().subplots()
    plotting.add_motion_legend(ax, motions, fontsize=12)
    ax.figure.canvas.draw()
    assert outside(ax.get_legend()) <= 0.0 and ax.get_legend()._ncols < 8
    plotting.add_motion_legend(ax, motions, fontsize=30)
    ax.figure.canvas.draw()
    assert ax.get_legend().get_window_extent().y0 < ax.bbox.y1
    plotting.add_motion_legend(plt.figure(figsize=(8.0, 3.4)).subplots(), motions[:3])
    assert plt.gca().get_legend()._ncols == 3  # one row where there is room


def shown(artist):
    """The colours by which an artist is seen."""
    if isinstance(artist, Line2D):
        line = [] if artist.get_linestyle() in ("None", "none", "", " ") else [artist.get_color()]
        dots = [artist.get_markerfacecolor(), artist.get_markeredgecolor()]
        dots = dots if artist.get_marker() not in ("None", "", None) else []
        return [to_rgb(colour) for colour in (*line, *dots) if not isinstance(colour, str) or colour != "none"]
    return [to_rgb(colour) for colour in artist.get_colors()]


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("name", sorted(CALLS))
def test_lines_and_words_are_seen_on_light_and_dark(name, style):
    with plt.style.context(style):
        axes = CALLS[name]()
        for ax in axes:
            ax.figure.canvas.draw()
            ground = paper(ax)
            assert (contrast(ground, "black") < 2.0) == (style == "dark_background")
            words = [ax.xaxis.label, ax.yaxis.label, *ax.get_xticklabels(), *ax.get_yticklabels()]
            assert all(contrast(to_rgb(text.get_color()), ground) > 3.0 for text in words if text.get_text())
            notes = [] if name in BY_STATE else ax.texts  # some in the colour of their curve
            assert all(contrast(to_rgb(text.get_color()), ground) > 2.0 for text in notes if text.get_text())
            for artist in (*ax.lines, *parts([ax], LineCollection)):
                assert max(contrast(colour, ground) for colour in shown(artist)) > (
                    2.5 if style == "dark_background" else 1.4
                )
        for legend in legends(axes):
            face = to_hex(legend.get_frame().get_facecolor())
            assert all(contrast(text.get_color(), face) > 3.0 for text in legend.get_texts())


def test_on_the_light_page_the_colours_are_the_book_s():
    diagram = plotting.bifurcation_diagram(made("sweep"))
    drawn = {line.get_label(): line.get_color() for line in diagram.lines}
    assert all(drawn[name] == plotting.MOTION_COLOURS[name] for name in ("period 2", "chaos"))
    with plt.style.context("dark_background"):
        dark = {line.get_label(): line.get_color() for line in plotting.bifurcation_diagram(made("sweep")).lines}
    assert dark["period 2"] == drawn["period 2"] and contrast(dark["chaos"], "black") > 3.0 > contrast(
        "#3A3A3A", "black"
    )


def test_a_colour_bar_says_the_long_name():
    bar = plotting.finite_exponents(made("plane")).figure.axes[1]
    assert bar.get_ylabel() == "largest Lyapunov exponent per unit tau"
    worded = plotting.quantity_map(made("map"), "x_mean").figure.axes[1]
    assert worded.get_ylabel() == "mean of $X$"
    own = made("map").assign(mine=made("map").x_max.assign_attrs(long_name="what I measured"))
    assert plotting.quantity_map(own, "mine").figure.axes[1].get_ylabel() == "what I measured"
    long = plotting.quantity_map(gp.basins(OSC, **PLANE), "settling_time").figure.axes[1].get_ylabel()
    assert " ".join(long.split()) == "mesh periods until the motion was certain to stay with its attractor"
    assert max(map(len, long.split("\n"))) <= 44


@pytest.mark.slow
def test_nothing_is_left_in_the_settings():
    before = dict(mpl.rcParams)
    for name in CALLS:
        CALLS[name]()
        plt.close("all")
    assert dict(mpl.rcParams) == before


def test_a_colour_reaches_a_diagrams_legend_and_is_none_of_a_maps():
    legend = plotting.bifurcation_diagram(made("sweep"), colour="#12AB34").get_legend()
    assert {to_hex(dot.get_color()) for dot in legend.legend_handles} == {"#12ab34"}
    with pytest.raises(TypeError, match="the colours of a map say where each start leads"):
        plotting.basins(made("plane"), color="#12AB34")
