"""The explorer's page in a real browser: it opens from a file, answers, remembers, and says what it shows."""

import html
import json
import re
from urllib.parse import parse_qsl

import numpy as np
import pytest

import gearpair as gp
from tests.browser import Browser
from tests.explorer_pages import ROOT, write_page

EXPLORER = "document.getElementById('explorer').explorer"
IMPACTS = {"single_drive": "single-sided", "double": "double-sided", "none_drive": "no impact"}
SEE_IT_MOVE = re.compile(r'<a class="see-it-move" href="([^"#]*)#([^"]*)">([^<]*)</a>')
SETTLED = f"{EXPLORER}?.shown && !{EXPLORER}.pending && !{EXPLORER}.changed"


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    with Browser(tmp_path_factory.mktemp("profile")) as opened:
        opened.size(1300, 1600)
        yield opened


@pytest.fixture
def page(browser, tmp_path):
    """Opens the page at a hash; afterwards nothing may have gone wrong or been fetched from elsewhere."""
    path = write_page(tmp_path)

    def go(hash: str = ""):
        browser.open("about:blank")
        browser.open(path.as_uri() + hash)
        browser.wait_for(SETTLED)
        return browser

    browser.errors.clear()
    browser.requests.clear()
    yield go
    assert browser.errors == []
    assert [url for url in browser.requests if not url.startswith(("file:", "blob:", "about:"))] == []
    browser.media()
    browser.size(1300, 1600)


def part(name: str) -> str:
    return f"document.querySelector('[data-part={name}]')"


def shown(browser, name: str) -> str:
    """A value of the readout."""
    return browser.run(f"document.querySelector('[data-value={name}]').textContent").replace("−", "-")


def place(browser, element: str) -> dict:
    return browser.run(
        f"(({{ x, y, width, height }}) => ({{ x, y, width, height }}))({element}.getBoundingClientRect())"
    )


def state(browser) -> dict:
    return browser.run(f"{EXPLORER}.state")


def wait_for_diagram(browser):
    browser.wait_for(f"!{EXPLORER}.diagram.busy")


@pytest.mark.parametrize(
    ("hash", "changes", "start"),
    [
        ("", {}, (1.0, 0.0)),
        ("#x=-2.3&v=1.5", {}, (-2.3, 1.5)),
        ("#mesh_frequency=1.9&damping_ratio=0.05&mean_force=0.2&error_phase=1.2", {
            "mesh_frequency": 1.9, "damping_ratio": 0.05, "mean_force": 0.2, "error_phase": 1.2}, (1.0, 0.0)),
        ("#a=0.3&b=0.2&contact_ratio=1.5&error_amplitude=0.4", {
            "a": 0.3, "b": 0.2, "contact_ratio": 1.5, "error_amplitude": 0.4}, (1.0, 0.0)),
    ],
)  # fmt: skip
def test_the_readout_is_what_gearpair_says(page, hash, changes, start):
    browser = page(hash)
    truth = gp.steady_state(gp.Oscillator().replace(**changes), *start)
    assert truth.status == "periodic"
    assert shown(browser, "motion") == f"period {truth.period}"
    assert shown(browser, "impact") == IMPACTS[truth.impact_state]
    assert shown(browser, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"
    first = truth.multipliers[0]
    assert shown(browser, "modulus") == f"largest modulus {abs(first):.3f}"
    assert shown(browser, "multipliers").startswith(f"{first.real:.3f}")
    assert shown(browser, "exponent") == f"{truth.lyapunov_exponents[0]:.3f}"
    assert f"period {truth.period}" in browser.run(f"{EXPLORER}.shown.name")


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
def test_a_link_shows_the_motion_that_its_text_names(page, source, paragraph, target, hash, text):
    chapter = source.suffix == ".ipynb"
    assert target == ("../explorer.html" if chapter else "explorer.html")
    assert not chapter or "baseline" in paragraph  # a chapter may be run with other parameters; its links are not
    changes = {name: float(value) for name, value in parse_qsl(html.unescape(hash))}
    start = changes.pop("x", 1.0), changes.pop("v", 0.0)
    truth = gp.steady_state(gp.Oscillator().replace(**changes), *start)
    motion = f"period {truth.period}" if truth.period else "chaos"
    assert re.findall(r"period \d+|chaos", text) == [motion]
    said = {"rattles": "single-sided", "clatters": "double-sided"}.get(text.split()[-1], IMPACTS[truth.impact_state])
    assert said == IMPACTS[truth.impact_state]
    browser = page(f"#{html.unescape(hash)}")
    assert browser.run(f"{part('complaint')}.hidden")
    assert shown(browser, "motion") == motion
    assert shown(browser, "impact") == said


def test_every_chapter_about_motions_links_to_some():
    assert {path.stem for path, *_ in (each.values for each in links_to_motions())} >= {
        "frequency_sweep", "damping_sweep", "impacts"}  # fmt: skip


def test_the_swapped_reading(page):
    browser = page("#reading=swapped&damping_ratio=0.1")
    wave = gp.StiffnessWave.rectangular(reading="swapped")
    truth = gp.steady_state(gp.Oscillator(stiffness=wave, damping_ratio=0.1))
    assert shown(browser, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"
    assert browser.run("document.querySelector('[name=reading]:checked').value") == "swapped"


def test_chaos_is_named_with_its_exponent(page):
    browser = page("#mesh_frequency=1.219")
    truth = gp.steady_state(gp.Oscillator(mesh_frequency=1.219))
    assert shown(browser, "motion") == "chaos"
    assert shown(browser, "multipliers") == "–"
    exponent, error = float(shown(browser, "exponent")), float(shown(browser, "error").removeprefix("± "))
    assert abs(exponent - truth.lyapunov_exponents[0]) < 6 * np.hypot(error, truth.exponent_error) + 0.001
    assert "chaos" in browser.run(f"{part('meaning')}.textContent")


def test_an_escape_is_said(page):
    browser = page("#mesh_frequency=2&damping_ratio=0&a=0.5&b=0.5&contact_ratio=1.5&x=50")
    assert shown(browser, "motion") == "escaped"
    assert "without bound" in browser.run(f"{part('meaning')}.textContent")


def test_wrong_values_get_a_sentence_and_the_default(page):
    browser = page("#mesh_frequency=fast&damping_ratio=-1&colour=red&reading=mine&mean_force=0.2")
    text = browser.run(f"{part('complaint')}.textContent")
    for sentence in (
        "mesh_frequency must be a number from 0.2 to 3, got “fast”. The default 0.7 is used.",
        "damping_ratio must be a number from 0 to 0.2, got “-1”. The default 0.02 is used.",
        "There is no parameter “colour”",
        "reading must be one of printed, swapped, got “mine”. The default printed is used.",
    ):
        assert sentence in text
    now = state(browser)
    assert (now["mesh_frequency"], now["damping_ratio"], now["reading"]) == (0.7, 0.02, "printed")
    assert now["mean_force"] == 0.2
    browser.run(f"{EXPLORER}.change({{ mean_force: 0.1 }})")
    assert browser.run(f"{part('complaint')}.hidden")


def test_a_link_brings_the_state_back(page):
    browser = page("#mesh_frequency=0.81234567&x=-1.5&reading=swapped&diagram=damping_ratio")
    first = state(browser)
    assert first["mesh_frequency"] == 0.81234567  # not rounded to the slider's steps
    browser.run(f"{EXPLORER}.change({{ v: 0.25, a: 0.2 }})")
    browser.wait_for("location.hash.includes('v=0.25')")
    link = browser.run("location.hash")
    assert link == "#mesh_frequency=0.81234567&a=0.2&x=-1.5&v=0.25&reading=swapped&diagram=damping_ratio"
    assert state(page(link)) == {**first, "v": 0.25, "a": 0.2}


def test_an_address_typed_into_the_open_page_is_followed(page):
    browser = page()
    browser.run("location.hash = '#mesh_frequency=1.8'")
    browser.wait_for(f"{EXPLORER}.state.mesh_frequency === 1.8 && {SETTLED}")
    assert shown(browser, "motion") == "period 1"


def test_dragging_a_slider_shows_a_motion_for_every_move(page):
    browser = page()
    browser.run(f"""{{
      const explorer = {EXPLORER}, draw = explorer.draw;
      window.drawn = [];
      explorer.draw = (...all) => {{
        drawn.push(explorer.model.state.damping_ratio);
        return draw.apply(explorer, all);
      }};
    }}""")
    box = place(browser, "document.getElementById('gp-damping_ratio')")
    y = box["y"] + box["height"] / 2
    browser.mouse("mousePressed", box["x"] + 0.2 * box["width"], y)
    wanted = []
    for share in np.linspace(0.2, 0.9, 15):
        browser.mouse("mouseMoved", box["x"] + share * box["width"], y)
        browser.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        wanted.append(state(browser)["damping_ratio"])
    browser.mouse("mouseReleased", box["x"] + 0.9 * box["width"], y)
    assert len(set(wanted)) == 15
    assert set(wanted) <= set(browser.run("drawn"))


def test_a_slider_answers_to_the_keyboard_and_the_field_beside_it(page):
    browser = page()
    browser.run("document.getElementById('gp-mesh_frequency').focus()")
    browser.key("ArrowRight", 39)
    browser.wait_for(SETTLED)
    assert state(browser)["mesh_frequency"] == pytest.approx(0.701)
    field = "document.getElementById('gp-mesh_frequency-field')"
    browser.run(f"{field}.value = '0.7123'; {field}.dispatchEvent(new Event('change'))")
    assert state(browser)["mesh_frequency"] == 0.7123
    browser.run(f"{field}.value = '7'; {field}.dispatchEvent(new Event('change'))")
    assert state(browser)["mesh_frequency"] == 0.7123
    assert browser.run(f"{part('complaint')}.textContent") == "mesh_frequency must be a number from 0.2 to 3, got “7”."


def test_a_motion_is_announced_once_it_stands(page):
    browser = page()
    browser.run(f"{EXPLORER}.change({{ mesh_frequency: 1.7 }}); {EXPLORER}.change({{ mesh_frequency: 1.8 }})")
    browser.wait_for(f"{part('live')}.textContent.startsWith('period 1')")
    assert "load factor" in browser.run(f"{part('live')}.textContent")
    assert browser.run(f"{part('live')}.getAttribute('aria-live')") == "polite"


def test_a_click_into_the_phase_portrait_is_a_start(page):
    browser = page("#x=-2.3&v=1.5")
    box = place(browser, part("phase"))
    x, y = browser.run(f"[{EXPLORER}.phasePlot.x(1), {EXPLORER}.phasePlot.y(0)]")
    browser.click(box["x"] + round(x), box["y"] + round(y))
    browser.wait_for(f"Math.abs({EXPLORER}.state.x - 1) < 0.05 && {SETTLED}")
    now = state(browser)
    truth = gp.steady_state(gp.Oscillator(), now["x"], now["v"])
    assert shown(browser, "motion") == f"period {truth.period}"
    assert shown(browser, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"


def test_a_point_of_the_diagram_shows_its_motion(page):
    """A motion that the falling sweep alone has: the page shows another at this speed before."""
    browser = page("#damping_ratio=0.06")
    wait_for_diagram(browser)
    column = browser.run(f"""{{
      const columns = {EXPLORER}.diagram.columns;
      const other = (one) => columns.find(({{ value, falling }}) => value === one.value && !falling);
      columns.find((one) => one.falling && one.motion === "period 1" && one.points[0].x < other(one).points[0].x - 0.5);
    }}""")
    assert column, "the two sweeps meet nowhere"
    box = place(browser, part("diagram"))
    plot = f"{EXPLORER}.diagram.plot"
    point = column["points"][0]
    x, y = browser.run(f"[{plot}.x({column['value']}), {plot}.y({point['x']})]")
    browser.click(box["x"] + x, box["y"] + y)
    browser.wait_for(f"{EXPLORER}.state.x !== 1 && {SETTLED}")
    now = state(browser)
    osc = gp.Oscillator(damping_ratio=0.06, mesh_frequency=now["mesh_frequency"])
    truth = gp.steady_state(osc, now["x"], now["v"])
    assert abs(now["mesh_frequency"] - column["value"]) < 0.02
    assert abs(truth.points - [now["x"], now["v"]]).max(axis=1).min() < 1e-6  # a section point of what is shown
    assert shown(browser, "motion") == f"period {truth.period}"
    assert shown(browser, "range") == f"{truth.x_min:.3f} to {truth.x_max:.3f}"


def test_the_legend_has_the_motion_shown_before_the_diagram_does(page):
    browser = page()
    wait_for_diagram(browser)
    names = f"[...{part('legend')}.children].map((item) => item.textContent)"
    assert len(browser.run(names)) > 1
    browser.run(f"{EXPLORER}.diagram.columns = []; {EXPLORER}.diagram.describe()")
    assert browser.run(names) == ["period 2"]


def test_the_track_of_each_slider_is_dark_up_to_its_thumb(page):
    browser = page()
    browser.run(f"{part('speed')}.value = 0.25; {part('speed')}.dispatchEvent(new Event('input'))")
    tracks = browser.run("""[...document.querySelectorAll("input[type=range]")].map((range) => {
      const share = (range.value - range.min) / (range.max - range.min);
      return [parseFloat(range.style.getPropertyValue("--filled")), 100 * share];
    })""")
    assert len(tracks) == 11
    assert all(filled == pytest.approx(thumb) for filled, thumb in tracks)


def test_a_motion_that_both_sweeps_miss_adds_its_branch(page):
    """The double-sided period 1, which has half of all starts at the baseline, hangs together with neither sweep."""
    browser = page("#x=-2.3&v=1.5")
    (orbit,) = gp.steady_state(gp.Oscillator(), -2.3, 1.5).points
    browser.wait_for(f"""{EXPLORER}.diagram.columns.some(({{ value, points }}) =>
      Math.abs(value - 0.7) < 0.01 && Math.abs(points[0].x - ({orbit[0]})) < 0.1)""")
    wait_for_diagram(browser)
    columns = browser.run(f"{EXPLORER}.diagram.columns.slice(800)")
    assert {column["motion"] for column in columns} >= {"period 1"}
    for column in columns[::20]:
        osc = gp.Oscillator(mesh_frequency=column["value"])
        point = column["points"][0]
        truth = gp.steady_state(osc, point["x"], point["v"], max_period=32)
        if column["motion"].startswith("period"):
            assert f"period {truth.period}" == column["motion"]
            assert abs(truth.points - [point["x"], point["v"]]).max(axis=1).min() < 1e-8


def test_the_diagram_answers_to_the_keyboard(page):
    browser = page("#damping_ratio=0.06")
    wait_for_diagram(browser)
    browser.run(f"{part('diagram')}.focus()")
    for _ in range(3):
        browser.key("ArrowRight", 39)
    browser.key("ArrowUp", 38)
    text = browser.run(f"{part('diagram')}.getAttribute('aria-valuetext')")
    value, motion, x = re.fullmatch(r"([\d.]+), (period \d+), X = (-?[\d.]+)", text).groups()
    assert float(value) > 0.7
    browser.key("Enter", 13)
    browser.wait_for(f"{EXPLORER}.state.mesh_frequency > 0.7 && {SETTLED}")
    now = state(browser)
    assert now["mesh_frequency"] == pytest.approx(float(value), abs=1e-3)
    assert now["x"] == pytest.approx(float(x), abs=0.006)
    assert shown(browser, "motion") == motion


def test_a_change_starts_the_diagram_anew_but_its_own_parameter_does_not(page):
    browser = page("#damping_ratio=0.1")
    wait_for_diagram(browser)
    order = browser.run(f"{EXPLORER}.diagram.order")
    browser.run(f"{EXPLORER}.change({{ mesh_frequency: 0.9, x: 0.5 }})")
    browser.wait_for(f"{EXPLORER}.shown && !{EXPLORER}.changed")
    assert browser.run(f"{EXPLORER}.diagram.order") == order
    browser.run(f"{EXPLORER}.change({{ mean_force: 0.3 }})")
    browser.wait_for(f"{EXPLORER}.diagram.order > {order}")
    wait_for_diagram(browser)
    columns = browser.run(f"{EXPLORER}.diagram.columns")
    assert len(columns) == 800
    osc = gp.Oscillator(damping_ratio=0.1, mean_force=0.3, mesh_frequency=columns[399]["value"])
    truth = gp.steady_state(osc)
    assert columns[399]["points"][0]["x"] == pytest.approx(truth.points[0, 0], abs=1e-8)


def test_it_is_still_for_those_who_prefer_that_and_moves_on_demand(page):
    page().media(prefers_reduced_motion="reduce")
    browser = page()
    assert browser.run(f"{part('play')}.textContent") == "Play"
    time = browser.run(f"new Promise((done) => setTimeout(() => done({EXPLORER}.time), 200))")
    assert time == 0
    browser.run(f"{part('play')}.click()")
    browser.wait_for(f"{EXPLORER}.time > 0")
    assert browser.run(f"{part('play')}.textContent") == "Pause"


@pytest.mark.parametrize("width", [360, 768, 1300])
def test_no_width_scrolls_sideways(page, width):
    browser = page("#mesh_frequency=1.219")
    browser.size(width, 800)
    browser.wait_for(f"innerWidth <= {width}")
    assert browser.run("document.documentElement.scrollWidth") <= width


def test_every_control_has_a_name_and_every_picture_a_description(page):
    browser = page()
    nameless = browser.run("""[...document.querySelectorAll("input, select, button, canvas:not([aria-hidden])")]
      .filter((e) => !e.labels?.length && !e.getAttribute("aria-label") && !e.textContent.trim())
      .map((e) => e.outerHTML)""")
    assert nameless == []


def test_pictures_follow_the_theme(page):
    browser = page()
    light = browser.run(f"{EXPLORER}.theme.ink")
    browser.run("document.documentElement.dataset.theme = 'dark'")
    browser.wait_for(f"{EXPLORER}.theme.ink !== '{light}'")
