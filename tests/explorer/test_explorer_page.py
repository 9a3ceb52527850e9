"""What the explorer's page says and does: one motion at a time, no refused number kept, keys, paper, small screens."""

import json
import re

import pytest

import gearpair as gp
from tests.support.engines import as_json, run_in_node
from tests.support.explorer_pages import EXPLORER, SETTLED, part, shown, state, wait_for_diagram

# The shortest repetition of the picture's samples, in mesh periods, up to 8; null where they do not repeat.
REPEATS = f"""(() => {{
  const {{ x, periods }} = {EXPLORER}.shown.recorded;
  const each = x.length / periods;
  const gap = (p) => Math.max(...[...x].slice(p * each).map((value, i) => Math.abs(value - x[i])));
  for (let p = 1; p < periods; p++) if (gap(p) < 1e-6) return p;
  return null;
}})()"""


def field(name: str) -> str:
    return f"document.getElementById('gp-{name}-field')"


def refuse(page, name: str, text: str) -> None:
    page.evaluate(f"{field(name)}.value = {json.dumps(text)}; {field(name)}.dispatchEvent(new Event('change'))")


def meaning(page) -> str:
    return page.evaluate(f"{part('meaning')}.textContent")


@pytest.mark.parametrize("hash", ["#mesh_frequency=1.09&x=0.5&v=-0.5", "#mesh_frequency=1.219", "#mesh_frequency=1.8"])
def test_readout_history_spectrum_and_diagram_speak_of_one_motion(explorer, hash):
    page = explorer(hash)
    repeats = page.evaluate(REPEATS)
    said = shown(page, "motion")
    assert said == (f"period {repeats}" if repeats else "chaotic so far")
    points = page.evaluate(f"{EXPLORER}.diagram.marked.points.length")
    assert points == (repeats or 1200)
    low, high = map(float, shown(page, "range").split(" to "))
    assert page.evaluate(f"Math.min(...{EXPLORER}.shown.recorded.x)") >= low - 1e-3
    assert page.evaluate(f"Math.max(...{EXPLORER}.shown.recorded.x)") <= high + 1e-3
    tells = page.evaluate(f"{part('tells')}.textContent")
    assert ("doubled" in tells) == (repeats == 2)
    assert ("does not repeat" in tells) == (repeats is None)


def test_a_transient_is_chaotic_so_far_and_then_settles(explorer):
    """At this address chaos goes on for some ten thousand mesh periods before it ends."""
    late = """(oscillator) => {
      const cells = gearpair.use("cells").buildCells(oscillator);
      for (let i = 0; ; i++) {
        const x = Number((-2 + 0.1 * i).toFixed(1));
        const { period, lasted } = gearpair.use("settle").settle(cells, x, 0, { watch: 100000 });
        if (period && lasted > 9000) return [x, period, lasted];
      }
    }"""
    x, period, lasted = run_in_node(late, as_json(gp.Oscillator(mesh_frequency=1.09)))
    page = explorer(f"#mesh_frequency=1.09&x={x}")
    page.wait_for_function(f"{EXPLORER}.shown.status === 'periodic'")
    page.wait_for_function(f"!{EXPLORER}.fresh")
    count = f"{lasted:,}".replace(",", "\u202f")
    assert shown(page, "motion") == f"period {period}"
    assert shown(page, "watched") == f"settled on period {period} after {count} mesh periods"
    assert page.evaluate(REPEATS) == period


def test_the_count_of_periods_watched_grows_and_is_not_read_out_again(explorer):
    page = explorer("#mesh_frequency=1.219")
    page.wait_for_function(f"{part('live')}.textContent !== ''")
    read = page.evaluate(f"{part('live')}.textContent")
    page.wait_for_function(f"!{EXPLORER}.shown.watching")
    page.evaluate("new Promise((done) => setTimeout(done, 1000))")
    assert page.evaluate(f"{part('live')}.textContent") == read
    count = int(re.sub(r"\D", "", shown(page, "watched")))
    assert count > 1_000_000
    assert "may still settle" in meaning(page)


def test_the_diagram_says_for_how_long_its_chaos_was_watched(explorer):
    page = explorer()
    wait_for_diagram(page)
    columns = page.evaluate(f"{EXPLORER}.diagram.columns")
    chaotic = [column["lasted"] for column in columns if column["motion"] == "chaos"]
    assert len(columns) == 800
    assert min(chaotic) >= 20_000
    text = page.evaluate("document.querySelector('[data-motion=chaos]').textContent")
    least = int(re.sub(r"\D", "", text))
    assert min(chaotic) - 100 < least <= min(chaotic)


def test_a_refused_number_goes_with_the_next_change_and_with_a_reset(explorer):
    page = explorer()
    for restore in (f"{EXPLORER}.change({{ damping_ratio: 0.03 }})", f"{part('reset')}.click()"):
        refuse(page, "mesh_frequency", "7")
        assert page.evaluate(f"{field('mesh_frequency')}.getAttribute('aria-invalid')") == "true"
        page.evaluate(restore)
        page.wait_for_function(SETTLED)
        assert page.evaluate(f"{field('mesh_frequency')}.value") == "0.7"
        assert page.evaluate(f"{field('mesh_frequency')}.getAttribute('aria-invalid')") is None
        assert page.evaluate(f"{part('complaint')}.hidden")


def test_an_arrow_key_moves_a_field_by_its_slider_s_step(explorer):
    page = explorer()
    page.evaluate(f"{field('mesh_frequency')}.focus()")
    page.keyboard.press("ArrowUp")
    page.wait_for_function(f"{EXPLORER}.state.mesh_frequency !== 0.7")
    assert state(page)["mesh_frequency"] == pytest.approx(0.701)


def test_without_a_mean_force_the_pair_floats(explorer):
    page = explorer("#mean_force=0&x=0.2")
    osc = gp.Oscillator(mean_force=0.0)
    assert gp.steady_state(osc, 0.2, 0.0).status == "floating"
    assert shown(page, "motion") == "floating"
    assert shown(page, "impact") == "never in contact"
    assert "damping" not in meaning(page)


@pytest.mark.parametrize(
    ("hash", "helps"),
    [("#a=1&b=0.9", False), ("#mesh_frequency=2&damping_ratio=0.03&a=0.5&b=0.5&contact_ratio=1.5&x=50", True)],
)
def test_a_nearer_start_is_advised_only_where_one_stays(explorer, hash, helps):
    page = explorer(hash)
    assert shown(page, "motion") == "escaped"
    text = meaning(page)
    assert ("Start nearer" in text) == helps
    if helps:
        x, v = map(float, re.search(r"X₀ = (\S+), X₀′ = (\S+) stays", text).groups())
        osc = gp.Oscillator(
            mesh_frequency=2.0, damping_ratio=0.03, stiffness=gp.StiffnessWave.rectangular(1.5, 0.5, 0.5)
        )
        assert gp.steady_state(osc, x, v).status != "escaped"


def test_small_numbers_keep_their_digits():
    """An error of 2e-5 is not 0.000, nor a modulus of 0.99997 a 1."""
    values = """(motions) => {
      const fs = process.getBuiltinModule("fs");
      const read = (name) => fs.readFileSync(`${process.argv[1]}/${name}.js`, "utf8");
      for (const name of ["view/plot", "readout"]) (0, eval)(read(name));
      const rest = { title: "", impact: "double", loadFactor: 1, low: 0, high: 1 };
      return motions.map((motion) => gearpair.use("readout").values({ ...rest, ...motion }));
    }"""
    chaos = {"status": "aperiodic", "exponent": 0.000123, "error": 0.00002}
    slow = {"status": "periodic", "exponent": -0.00004, "error": 0, "multipliers": [[0.99997, 0], [0.00002, 0]]}
    shown = run_in_node(values, [chaos, slow])
    assert (shown[0]["exponent"], shown[0]["error"]) == ("0.000123", "± 0.000020")
    assert shown[1]["modulus"] == "largest modulus 0.999970"
    assert shown[1]["exponent"] == "−4.0·10⁻⁵"


def test_a_click_beside_the_axes_sets_nothing(explorer):
    page = explorer()
    wait_for_diagram(page)
    before = state(page)
    for name in ("phase", "diagram"):
        canvas = page.locator(f"[data-part={name}]")
        canvas.click(position={"x": 20, "y": 60})
        canvas.click(position={"x": 200, "y": canvas.bounding_box()["height"] - 12})
    page.evaluate("new Promise((done) => setTimeout(done, 100))")
    assert state(page) == before


def test_play_has_one_name_for_what_it_does(explorer):
    page = explorer()
    assert page.evaluate(f"[{part('play')}.textContent, {part('play')}.hasAttribute('aria-pressed')]") == [
        "Pause",
        False,
    ]
    page.evaluate(f"{part('play')}.click()")
    assert page.evaluate(f"[{part('play')}.textContent, {part('play')}.hasAttribute('aria-pressed')]") == [
        "Play",
        False,
    ]


def test_home_and_end_go_to_the_ends_of_the_diagram(explorer):
    page = explorer("#damping_ratio=0.1")
    wait_for_diagram(page)
    page.evaluate(f"{part('diagram')}.focus()")
    for key, value in (("Home", 0.2), ("End", 3.0)):
        page.keyboard.press(key)
        assert float(page.evaluate(f"{part('diagram')}.getAttribute('aria-valuenow')")) == pytest.approx(value)


def test_undo_goes_back_step_by_step_and_a_drag_is_one(explorer):
    page = explorer()
    assert page.evaluate(f"{part('undo')}.disabled")
    for i in range(5):
        page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: {0.8 + i / 100:.2f} }})")
    page.evaluate(f"{EXPLORER}.change({{ x: 2 }})")
    seen = []
    while not page.evaluate(f"{part('undo')}.disabled"):
        page.evaluate(f"{part('undo')}.click()")
        seen.append((state(page)["mesh_frequency"], state(page)["x"]))
    assert seen == [(0.84, 1), (0.7, 1)]


def test_nothing_moves_while_scrolled_away(explorer):
    page = explorer()
    page.set_viewport_size({"width": 1300, "height": 500})
    page.evaluate("document.body.style.paddingBottom = '3000px'; scrollTo(0, 2500)")
    page.wait_for_function(f"!{EXPLORER}.visible")
    time = page.evaluate(f"{EXPLORER}.time")
    page.evaluate("new Promise((done) => setTimeout(done, 200))")
    assert page.evaluate(f"{EXPLORER}.time") == time
    page.evaluate(f"{part('teeth')}.scrollIntoView()")
    page.wait_for_function(f"{EXPLORER}.time > {time}")


def test_paper_has_the_parameters_the_address_and_light_pictures(explorer):
    page = explorer("#mesh_frequency=0.9&x=-1.5")
    page.evaluate("document.documentElement.dataset.theme = 'dark'")
    page.wait_for_function(f"{EXPLORER}.theme.ink === '#a9c7ec'")
    page.emulate_media(media="print")
    page.wait_for_function(f"{EXPLORER}.theme.ink === '#1f3a5f'")
    text = page.locator("[data-part=printed]").inner_text()
    assert "mesh frequency Ωh = 0.9" in text
    assert "displacement X0 = −1.5" in text
    assert text.rstrip().endswith("#mesh_frequency=0.9&x=-1.5")
    page.emulate_media(media="screen")
    page.wait_for_function(f"{EXPLORER}.theme.ink === '#a9c7ec'")


def test_on_a_telephone_the_name_stays_in_sight_and_targets_are_large(explorer):
    page = explorer()
    page.set_viewport_size({"width": 360, "height": 740})
    page.wait_for_function("innerWidth <= 360")
    slider = page.locator("#gp-b")
    slider.scroll_into_view_if_needed()
    # Both ends of a distance are read at one moment: texts that arrive meanwhile move what is below them.
    name = page.evaluate("document.querySelector('.gp-name').getBoundingClientRect().toJSON()")
    assert name["top"] >= -1
    assert name["bottom"] < 120
    targets = "button, select, input[type=range], input[type=number], .gp-check, .gp-choice span"
    small = page.evaluate(f"""[...document.querySelectorAll("#explorer :is({targets})")]
      .filter((e) => e.getBoundingClientRect().height < 43.9).map((e) => e.outerHTML)""")
    assert small == []
    for group, figure in (("pair", "history"), ("start", "phase"), ("stiffness", "spectrum")):
        between = page.evaluate(f"""document.querySelector("[data-figure={figure}]").getBoundingClientRect().top
          - document.querySelector("[data-group={group}]").getBoundingClientRect().bottom""")
        assert 0 <= between < 30


def test_a_motion_that_escapes_has_its_mark_in_the_diagram(explorer):
    page = explorer("#mesh_frequency=2&damping_ratio=0.001&a=0.5&b=0.5&contact_ratio=1.5&x=50")
    wait_for_diagram(page)
    escaped = page.evaluate(
        f"{EXPLORER}.diagram.columns.filter(({{ motion }}) => motion === 'escaped').map((c) => c.value)"
    )
    assert escaped
    ink = page.evaluate(f"""((value) => {{
      const {{ plot, dots }} = {EXPLORER}.diagram;
      const ratio = dots.width / dots.clientWidth;
      return dots.getContext("2d").getImageData(plot.x(value) * ratio, (plot.box.top + 5) * ratio, 1, 1).data[3];
    }})({escaped[0]})""")
    assert ink > 0


def test_a_picture_that_comes_into_sight_shows_the_present_motion(explorer):
    page = explorer()
    page.set_viewport_size({"width": 360, "height": 400})
    page.wait_for_function(f"{EXPLORER}.hidden.has('spectrum')")
    pixels = f"{part('spectrum')}.toDataURL()"
    before = page.evaluate(pixels)
    page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: 1.8 }})")
    page.wait_for_function(f"{SETTLED} && {EXPLORER}.shown.period === 1")
    page.evaluate(f"{part('spectrum')}.scrollIntoView()")
    page.wait_for_function(f"!{EXPLORER}.hidden.has('spectrum')")
    assert page.evaluate(pixels) != before
