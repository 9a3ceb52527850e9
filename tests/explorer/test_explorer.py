"""The explorer's page in a real browser: it opens from a file, answers, remembers, and says what it shows."""

import html
import json
import re
from urllib.parse import parse_qsl

import numpy as np
import pytest

import gearpair as gp
from tests.support import ROOT
from tests.support.explorer_pages import EXPLORER, SETTLED, part, shown, state, wait_for_diagram

IMPACTS = {"single_drive": "single-sided", "double": "double-sided", "none_drive": "no impact"}
SEE_IT_MOVE = re.compile(r'<a class="see-it-move" href="([^"#]*)#([^"]*)">([^<]*)</a>')


@pytest.mark.parametrize(
    ("hash", "changes", "start"),
    [
        ("", {}, (1.0, 0.0)),
        ("#x=-2.3&v=1.5", {}, (-2.3, 1.5)),
        ("#mesh_frequency=1.9&damping_ratio=0.05&mean_force=0.2&error_phase=1.2", {
            "mesh_frequency": 1.9, "damping_ratio": 0.05, "mean_force": 0.2, "error_phase": 1.2}, (1.0, 0.0)),
        ("#damping_ratio=0.05&flight_damping=0", {"damping_ratio": 0.05, "flight_damping": 0.0}, (1.0, 0.0)),
        ("#a=0.3&b=0.2&contact_ratio=1.5&error_amplitude=0.4", {
            "a": 0.3, "b": 0.2, "contact_ratio": 1.5, "error_amplitude": 0.4}, (1.0, 0.0)),
    ],
)  # fmt: skip
def test_the_readout_is_what_gearpair_says(explorer, hash, changes, start):
    page = explorer(hash)
    truth = gp.steady_state(gp.Oscillator().replace(**changes), *start)
    assert truth.status == "periodic"
    assert shown(page, "motion") == f"period {truth.period}"
    assert shown(page, "impact") == IMPACTS[truth.impact_state]
    assert shown(page, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"
    first = truth.multipliers[0]
    assert shown(page, "modulus") == f"largest modulus {abs(first):.3f}"
    assert shown(page, "multipliers").startswith(f"{first.real:.3f}")
    assert shown(page, "exponent") == f"{truth.lyapunov_exponents[0]:.3f}"
    assert f"period {truth.period}" in page.evaluate(f"{EXPLORER}.shown.name")


def test_a_box_takes_the_damping_out_of_the_play(explorer):
    page = explorer("#damping_ratio=0.05")
    box = "document.querySelector('[name=undamped_flight]')"
    for flight_damping in (0.0, None):
        page.evaluate(f"{box}.click()")
        page.wait_for_function(f"{EXPLORER}.state.flight_damping === {json.dumps(flight_damping)} && {SETTLED}")
        truth = gp.steady_state(gp.Oscillator(damping_ratio=0.05, flight_damping=flight_damping))
        assert shown(page, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"
        assert page.evaluate(f"{box}.checked") == (flight_damping == 0.0)
        page.wait_for_function(f"location.hash.includes('flight_damping=0') === {json.dumps(flight_damping == 0.0)}")
    page = explorer("#flight_damping=0.01")
    assert page.evaluate(f"{box}.indeterminate")


def paragraphs_of(path):
    """The paragraphs of a page or of a chapter's prose."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    return text.split("\n\n")


def links_to_motions():
    """Each link from the book into the explorer, with where it stands."""
    return [
        pytest.param(path, paragraph, *found.groups(), id=f"{path.stem}: {found[2]}")
        for path in sorted([*ROOT.glob("notebooks/*.ipynb"), *ROOT.glob("book/*.md")])
        for paragraph in paragraphs_of(path)
        for found in SEE_IT_MOVE.finditer(paragraph)
    ]


@pytest.mark.parametrize(("source", "paragraph", "target", "hash", "text"), links_to_motions())
@pytest.mark.slow
def test_a_link_shows_the_motion_that_its_text_names(explorer, source, paragraph, target, hash, text):
    chapter = source.suffix == ".ipynb"
    assert target == ("../explorer.html" if chapter else "explorer.html")
    assert not chapter or "baseline" in paragraph  # a chapter may be run with other parameters; its links are not
    changes = {name: float(value) for name, value in parse_qsl(html.unescape(hash))}
    start = changes.pop("x", 1.0), changes.pop("v", 0.0)
    truth = gp.steady_state(gp.Oscillator().replace(**changes), *start)
    motion = f"period {truth.period}" if truth.period else "chaotic so far"
    assert re.findall(r"period \d+|chaos", text) == [motion.replace("chaotic so far", "chaos")]
    said = {"rattles": "single-sided", "clatters": "double-sided"}.get(text.split()[-1], IMPACTS[truth.impact_state])
    assert said == IMPACTS[truth.impact_state]
    page = explorer(f"#{html.unescape(hash)}")
    assert page.evaluate(f"{part('complaint')}.hidden")
    assert shown(page, "motion") == motion
    assert shown(page, "impact") == said


def test_every_chapter_about_motions_links_to_some():
    assert {path.stem for path, *_ in (each.values for each in links_to_motions())} >= {
        "frequency_sweep", "damping_sweep", "impacts"}  # fmt: skip


def test_the_swapped_reading(explorer):
    page = explorer("#reading=swapped&damping_ratio=0.1")
    wave = gp.StiffnessWave.rectangular(reading="swapped")
    truth = gp.steady_state(gp.Oscillator(stiffness=wave, damping_ratio=0.1))
    assert shown(page, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"
    assert page.evaluate("document.querySelector('[name=reading]:checked').value") == "swapped"


def test_chaos_is_named_with_its_exponent(explorer):
    page = explorer("#mesh_frequency=1.219")
    truth = gp.steady_state(gp.Oscillator(mesh_frequency=1.219))
    assert shown(page, "motion") == "chaotic so far"
    assert re.fullmatch(r"[\d\u202f]+ mesh periods watched", shown(page, "watched"))
    assert shown(page, "multipliers") == "–"
    exponent, error = float(shown(page, "exponent")), float(shown(page, "error").removeprefix("± "))
    assert abs(exponent - truth.lyapunov_exponents[0]) < 6 * np.hypot(error, truth.exponent_error) + 0.001
    assert "neighbouring starts part" in page.evaluate(f"{part('meaning')}.textContent")


def test_an_escape_is_said(explorer):
    page = explorer("#mesh_frequency=2&damping_ratio=0&a=0.5&b=0.5&contact_ratio=1.5&x=50")
    assert shown(page, "motion") == "escaped"
    assert "without bound" in page.evaluate(f"{part('meaning')}.textContent")


def test_wrong_values_get_a_sentence_and_the_default(explorer):
    page = explorer("#mesh_frequency=fast&damping_ratio=-1&colour=red&reading=mine&mean_force=0.2")
    text = page.evaluate(f"{part('complaint')}.textContent")
    for sentence in (
        "mesh_frequency must be a number from 0.2 to 3, got “fast”. The default 0.7 is used.",
        "damping_ratio must be a number from 0 to 0.2, got “-1”. The default 0.02 is used.",
        "There is no parameter “colour”",
        "reading must be one of printed, swapped, got “mine”. The default printed is used.",
    ):
        assert sentence in text
    now = state(page)
    assert (now["mesh_frequency"], now["damping_ratio"], now["reading"]) == (0.7, 0.02, "printed")
    assert now["mean_force"] == 0.2
    page.evaluate(f"{EXPLORER}.change({{ mean_force: 0.1 }})")
    assert page.evaluate(f"{part('complaint')}.hidden")


def test_a_link_brings_the_state_back(explorer):
    page = explorer("#mesh_frequency=0.81234567&x=-1.5&reading=swapped&diagram=damping_ratio")
    first = state(page)
    assert first["mesh_frequency"] == 0.81234567  # not rounded to the slider's steps
    page.evaluate(f"{EXPLORER}.change({{ v: 0.25, a: 0.2 }})")
    page.wait_for_function("location.hash.includes('v=0.25')")
    link = page.evaluate("location.hash")
    assert link == "#mesh_frequency=0.81234567&a=0.2&x=-1.5&v=0.25&reading=swapped&diagram=damping_ratio"
    assert state(explorer(link)) == {**first, "v": 0.25, "a": 0.2}


def test_an_address_typed_into_the_open_page_is_followed(explorer):
    page = explorer()
    page.evaluate("location.hash = '#mesh_frequency=1.8'")
    page.wait_for_function(f"{EXPLORER}.state.mesh_frequency === 1.8 && {SETTLED}")
    assert shown(page, "motion") == "period 1"


def test_dragging_a_slider_shows_a_motion_for_every_move(explorer):
    page = explorer()
    wait_for_diagram(page)  # its legend moves what is below
    page.evaluate(f"""{{
      const explorer = {EXPLORER}, draw = explorer.draw;
      window.drawn = [];
      explorer.draw = (...all) => {{
        drawn.push(explorer.shown.state.damping_ratio);
        return draw.apply(explorer, all);
      }};
    }}""")
    slider = page.locator("#gp-damping_ratio")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    y = box["y"] + box["height"] / 2
    slider.hover(position={"x": 0.2 * box["width"], "y": box["height"] / 2})
    page.mouse.down()
    wanted = []
    for share in np.linspace(0.2, 0.9, 15):
        page.mouse.move(box["x"] + share * box["width"], y)
        page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        wanted.append(state(page)["damping_ratio"])
        page.wait_for_function(f"drawn.includes({wanted[-1]})")
    page.mouse.up()
    assert len(set(wanted)) == 15
    assert set(wanted) <= set(page.evaluate("drawn"))


def test_a_slider_answers_to_the_keyboard_and_the_field_beside_it(explorer):
    page = explorer()
    page.evaluate("document.getElementById('gp-mesh_frequency').focus()")
    page.keyboard.press("ArrowRight")
    page.wait_for_function(SETTLED)
    assert state(page)["mesh_frequency"] == pytest.approx(0.701)
    field = "document.getElementById('gp-mesh_frequency-field')"
    page.evaluate(f"{field}.value = '0.7123'; {field}.dispatchEvent(new Event('change'))")
    assert state(page)["mesh_frequency"] == 0.7123
    page.evaluate(f"{field}.value = '7'; {field}.dispatchEvent(new Event('change'))")
    assert state(page)["mesh_frequency"] == 0.7123
    assert (
        page.evaluate(f"{part('complaint')}.textContent") == "mesh_frequency must be a number from 0.2 to 3, got “7”."
    )


def test_a_motion_is_announced_once_it_stands(explorer):
    page = explorer()
    page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: 1.7 }}); {EXPLORER}.change({{ mesh_frequency: 1.8 }})")
    page.wait_for_function(f"{part('live')}.textContent.startsWith('period 1')")
    assert "load factor" in page.evaluate(f"{part('live')}.textContent")
    assert page.evaluate(f"{part('live')}.getAttribute('aria-live')") == "polite"


def test_a_click_into_the_phase_portrait_is_a_start(explorer):
    page = explorer("#x=-2.3&v=1.5")
    x, y = page.evaluate(f"[{EXPLORER}.phasePlot.x(1), {EXPLORER}.phasePlot.y(0)]")
    page.locator("[data-part=phase]").click(position={"x": round(x), "y": round(y)})
    page.wait_for_function(f"Math.abs({EXPLORER}.state.x - 1) < 0.05 && {SETTLED}")
    now = state(page)
    truth = gp.steady_state(gp.Oscillator(), now["x"], now["v"])
    assert shown(page, "motion") == f"period {truth.period}"
    assert shown(page, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"


def test_a_point_of_the_diagram_shows_its_motion(explorer):
    """A motion that the falling sweep alone has: the page shows another at this speed before."""
    page = explorer("#damping_ratio=0.06")
    wait_for_diagram(page)
    column = page.evaluate(f"""{{
      const columns = {EXPLORER}.diagram.columns;
      const other = (one) => columns.find(({{ value, falling }}) => value === one.value && !falling);
      columns.find((one) => one.falling && one.motion === "period 1" && one.points[0].x < other(one).points[0].x - 0.5);
    }}""")
    assert column, "the two sweeps meet nowhere"
    plot = f"{EXPLORER}.diagram.plot"
    point = column["points"][0]
    x, y = page.evaluate(f"[{plot}.x({column['value']}), {plot}.y({point['x']})]")
    page.locator("[data-part=diagram]").click(position={"x": x, "y": y})
    page.wait_for_function(f"{EXPLORER}.state.x !== 1 && {SETTLED}")
    now = state(page)
    osc = gp.Oscillator(damping_ratio=0.06, mesh_frequency=now["mesh_frequency"])
    truth = gp.steady_state(osc, now["x"], now["v"])
    assert abs(now["mesh_frequency"] - column["value"]) < 0.02
    assert abs(truth.points - [now["x"], now["v"]]).max(axis=1).min() < 1e-6  # a section point of what is shown
    assert shown(page, "motion") == f"period {truth.period}"
    assert shown(page, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"


def test_the_legend_has_the_motion_shown_before_the_diagram_does(explorer):
    page = explorer()
    wait_for_diagram(page)
    names = f"[...{part('legend')}.children].map((item) => item.textContent)"
    assert len(page.evaluate(names)) > 1
    page.evaluate(f"{EXPLORER}.diagram.columns = []; {EXPLORER}.diagram.describe()")
    assert page.evaluate(names) == ["period 2"]


def test_the_track_of_each_slider_is_dark_up_to_its_thumb(explorer):
    page = explorer()
    page.evaluate(f"{part('speed')}.value = 0.25; {part('speed')}.dispatchEvent(new Event('input'))")
    tracks = page.evaluate("""[...document.querySelectorAll("input[type=range]")].map((range) => {
      const share = (range.value - range.min) / (range.max - range.min);
      return [parseFloat(range.style.getPropertyValue("--filled")), 100 * share];
    })""")
    assert len(tracks) == 11
    assert all(filled == pytest.approx(thumb) for filled, thumb in tracks)


def test_a_motion_that_both_sweeps_miss_adds_its_branch(explorer):
    """The double-sided period 1, which has half of all starts at the baseline, hangs together with neither sweep."""
    page = explorer("#x=-2.3&v=1.5")
    (orbit,) = gp.steady_state(gp.Oscillator(), -2.3, 1.5).points
    page.wait_for_function(f"""{EXPLORER}.diagram.columns.some(({{ value, points }}) =>
      Math.abs(value - 0.7) < 0.01 && Math.abs(points[0].x - ({orbit[0]})) < 0.1)""")
    wait_for_diagram(page)
    columns = page.evaluate(f"{EXPLORER}.diagram.columns.slice(800)")
    assert {column["motion"] for column in columns} >= {"period 1"}
    for column in columns[::20]:
        osc = gp.Oscillator(mesh_frequency=column["value"])
        point = column["points"][0]
        truth = gp.steady_state(osc, point["x"], point["v"], max_period=32)
        if column["motion"].startswith("period"):
            assert f"period {truth.period}" == column["motion"]
            assert abs(truth.points - [point["x"], point["v"]]).max(axis=1).min() < 1e-8


def test_the_diagram_answers_to_the_keyboard(explorer):
    page = explorer("#damping_ratio=0.06")
    wait_for_diagram(page)
    page.evaluate(f"{part('diagram')}.focus()")
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowUp")
    text = page.evaluate(f"{part('diagram')}.getAttribute('aria-valuetext')")
    value, motion, x = re.fullmatch(r"([\d.]+), (period \d+), X = (-?[\d.]+)", text).groups()
    assert float(value) > 0.7
    page.keyboard.press("Enter")
    page.wait_for_function(f"{EXPLORER}.state.mesh_frequency > 0.7 && {SETTLED}")
    now = state(page)
    assert now["mesh_frequency"] == pytest.approx(float(value), abs=1e-3)
    assert now["x"] == pytest.approx(float(x), abs=0.006)
    assert shown(page, "motion") == motion


def test_a_change_starts_the_diagram_anew_but_its_own_parameter_does_not(explorer):
    page = explorer("#damping_ratio=0.1")
    wait_for_diagram(page)
    order = page.evaluate(f"{EXPLORER}.diagram.order")
    page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: 0.9, x: 0.5 }})")
    page.wait_for_function(f"{EXPLORER}.shown && !{EXPLORER}.changed")
    assert page.evaluate(f"{EXPLORER}.diagram.order") == order
    page.evaluate(f"{EXPLORER}.change({{ mean_force: 0.3 }})")
    page.wait_for_function(f"{EXPLORER}.diagram.order > {order}")
    wait_for_diagram(page)
    columns = page.evaluate(f"{EXPLORER}.diagram.columns")
    assert len(columns) == 800
    osc = gp.Oscillator(damping_ratio=0.1, mean_force=0.3, mesh_frequency=columns[399]["value"])
    truth = gp.steady_state(osc)
    assert columns[399]["points"][0]["x"] == pytest.approx(truth.points[0, 0], abs=1e-8)


def test_it_is_still_for_those_who_prefer_that_and_moves_on_demand(explorer):
    page = explorer(reduced_motion="reduce")
    assert page.evaluate(f"{part('play')}.textContent") == "Play"
    time = page.evaluate(f"new Promise((done) => setTimeout(() => done({EXPLORER}.time), 200))")
    assert time == 0
    page.evaluate(f"{part('play')}.click()")
    page.wait_for_function(f"{EXPLORER}.time > 0")
    assert page.evaluate(f"{part('play')}.textContent") == "Pause"


@pytest.mark.parametrize("width", [360, 768, 1300])
def test_no_width_scrolls_sideways(explorer, width):
    page = explorer("#mesh_frequency=1.219")
    page.set_viewport_size({"width": width, "height": 800})
    page.wait_for_function(f"innerWidth <= {width}")
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_every_control_has_a_name_and_every_picture_a_description(explorer):
    page = explorer()
    nameless = page.evaluate("""[...document.querySelectorAll("input, select, button, canvas:not([aria-hidden])")]
      .filter((e) => !e.labels?.length && !e.getAttribute("aria-label") && !e.textContent.trim())
      .map((e) => e.outerHTML)""")
    assert nameless == []


def test_pictures_follow_the_theme(explorer):
    page = explorer()
    light = page.evaluate(f"{EXPLORER}.theme.ink")
    page.evaluate("document.documentElement.dataset.theme = 'dark'")
    page.wait_for_function(f"{EXPLORER}.theme.ink !== '{light}'")
