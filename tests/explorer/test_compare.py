"""Motion A in grey behind motion B, and the run-up: what it carries along is the library's motion, step by step."""

import re

import numpy as np
import pytest

import gearpair as gp
from tests.support.explorer_pages import EXPLORER, SETTLED, part, shown, state

RUN = f"{EXPLORER}.runUp"


def press(page, name: str) -> None:
    page.evaluate(f"{part(name)}.focus()")
    page.keyboard.press("Enter")


def text(page, name: str) -> str:
    return page.evaluate(f"{part(name)}.textContent").replace("−", "-")


def greys(page, name: str) -> int:
    """How many pixels of a picture have the colour of A, the axes' words aside."""
    return page.evaluate(f"""(() => {{
      const canvas = {part(name)}, ratio = canvas.width / canvas.clientWidth;
      const {{ left, right, top, bottom }} = {EXPLORER}.historyPlot.box;
      const box = [left + 2, top + 2, right - left - 4, bottom - top - 4].map((side) => Math.round(side * ratio));
      const {{ data }} = canvas.getContext("2d").getImageData(...box);
      const grey = [0, 2, 4].map((i) => parseInt({EXPLORER}.theme.muted.slice(1 + i, 3 + i), 16));
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += grey.every((part, k) => Math.abs(data[i + k] - part) < 12);
      return count;
    }})()""")


def test_a_stays_in_grey_behind_b_with_both_load_factors(explorer):
    page = explorer()
    page.evaluate(f"{EXPLORER}.playing = false")
    first = gp.motion.impact_measures(gp.steady_state(gp.Oscillator())).load_factor
    bare = [greys(page, name) for name in ("history", "phase")]
    press(page, "keep")
    page.evaluate(f"{EXPLORER}.change({{ x: -2.3, v: 1.5, damping_ratio: 0.03 }})")
    page.wait_for_function(SETTLED)
    osc = gp.Oscillator(damping_ratio=0.03)
    second = gp.motion.impact_measures(gp.steady_state(osc, -2.3, 1.5)).load_factor
    assert text(page, "kept-load") == f"A: {first:.3g}"
    assert shown(page, "load") == f"{second:.3g}"
    assert text(page, "kept") == (
        f"Grey, A: period 2, rattles (one flank), load factor {first:.3g}. A has damping ratio 0.02, here 0.03; "
        "start displacement 1, here -2.3; start velocity 0, here 1.5."
    )
    assert all(
        now > before + 100 for now, before in zip([greys(page, n) for n in ("history", "phase")], bare, strict=True)
    )
    assert text(page, "keep") == "Clear A"
    press(page, "keep")
    assert [text(page, name) for name in ("kept", "kept-load", "keep")] == ["", "", "Keep as A"]
    assert greys(page, "history") < 20


def test_what_escapes_cannot_be_kept_nor_carried(explorer):
    page = explorer("#a=1&b=0.9")
    assert page.evaluate(f"{part('keep')}.disabled")
    press(page, "run-up")
    assert text(page, "run-note") == "There is no motion to carry: this one does not stay bounded."
    assert page.evaluate(f"{RUN}.way") == 0


def test_a_run_carries_the_motion_along_the_exact_flow(explorer):
    """Step by step as the library's flow, in the order of mesh periods, from the motion that was shown."""
    page = explorer("#damping_ratio=0.06")
    osc = gp.Oscillator(damping_ratio=0.06)
    x, v = page.evaluate(f"[{EXPLORER}.shown.points[0].x, {EXPLORER}.shown.points[0].v]")
    assert np.abs(gp.steady_state(osc).points - [x, v]).max(axis=1).min() < 1e-9
    press(page, "run-up")
    assert text(page, "run-up") == "Stop"
    page.wait_for_function(f"{RUN}.trace.length > 60")
    press(page, "run-up")
    assert text(page, "run-up") == "Run up"
    trace = page.evaluate(f"{RUN}.trace")
    steps = np.round(0.7 + 0.0002 * np.arange(1, 5 * len(trace) + 1), 4)
    for i, step in enumerate(steps[:300]):
        x, v = gp.stroboscopic_map(osc.replace(mesh_frequency=step), x, v)
        if i % 5 == 4:
            assert trace[i // 5]["value"] == pytest.approx(step, abs=1e-12)
            assert trace[i // 5]["x"] == pytest.approx(float(x), abs=1e-8)
    page.wait_for_function(SETTLED)
    now = state(page)
    assert now["mesh_frequency"] == pytest.approx(trace[-1]["value"])
    assert now["x"] == pytest.approx(trace[-1]["x"], abs=1e-9)
    assert text(page, "run-note") == f"At mesh frequency {trace[-1]['value']:.3f}: stopped."
    page.evaluate(f"{part('undo')}.click()")
    assert state(page)["mesh_frequency"] == 0.7  # a run is one step back


def test_a_jump_is_written_down_where_the_library_has_it(explorer):
    """Falling from 0.42, the clattering period 1 ends in a fold; what is carried jumps to another motion."""
    page = explorer("#mesh_frequency=0.42&x=-1.9&v=1.2")
    name = shown(page, "motion")
    press(page, "run-down")
    page.wait_for_function(f"{part('run-log')}.children.length > 1 || {RUN}.way === 0")
    press(page, "run-down")
    lines = page.eval_on_selector_all("[data-part=run-log] li", "(all) => all.map((line) => line.textContent)")
    assert lines[0].startswith(f"0.420: {name}")
    at, after = re.match(r"([\d.]+): (.*), load", lines[1]).groups()
    before = lines[0].split(": ")[1].split(", load")[0]
    assert after != before
    # Carried by the library to just before, it is still what it was; at the jump's speed it is the other.
    osc = gp.Oscillator(mesh_frequency=0.42)
    x, v = gp.steady_state(osc, -1.9, 1.2).points[0]
    for value in np.arange(0.4198, float(at) + 0.002, -0.0002):
        x, v = gp.stroboscopic_map(osc.replace(mesh_frequency=value), x, v)
    settled = gp.steady_state(osc.replace(mesh_frequency=float(at) + 0.002), x, v)
    assert f"period {settled.period}" == before.split(",")[0]


def test_a_slider_stops_a_run_and_the_end_does(explorer):
    page = explorer("#damping_ratio=0.1&mesh_frequency=2.98")
    press(page, "run-up")
    page.wait_for_function(f"{RUN}.way === 0")
    assert text(page, "run-note") == "At mesh frequency 3.000: the end of the slider."
    page.wait_for_function(SETTLED)  # a run begins from the motion that is shown
    press(page, "run-up")
    assert text(page, "run-note") == "The mesh frequency is at its highest."
    press(page, "run-down")
    page.wait_for_function(f"{EXPLORER}.state.mesh_frequency < 2.99")
    page.evaluate("document.getElementById('gp-damping_ratio').focus()")
    page.keyboard.press("ArrowRight")
    page.wait_for_function(f"{RUN}.way === 0")
    assert text(page, "run-note").endswith("stopped by a change.")
    assert text(page, "run-down") == "Run down"


def test_with_less_motion_a_run_goes_in_large_steps(explorer):
    page = explorer("#damping_ratio=0.1", reduced_motion="reduce")
    page.evaluate(f"""{{
      window.values = [];
      const explorer = {EXPLORER}, change = explorer.change;
      explorer.change = (changes) => {{ values.push(changes.mesh_frequency); change.call(explorer, changes); }};
      null;
    }}""")
    press(page, "run-up")
    page.wait_for_function("values.length >= 3")
    press(page, "run-up")
    assert np.diff(page.evaluate("values.slice(0, 3)")) == pytest.approx([0.02, 0.02])


def test_the_diagram_shows_the_way_of_a_run(explorer):
    page = explorer("#damping_ratio=0.1&diagram=mean_force")
    press(page, "run-up")
    page.wait_for_function(f"{RUN}.trace.length > 30")
    press(page, "run-up")
    page.wait_for_function(SETTLED)
    assert state(page)["diagram"] == "mesh_frequency"
    assert page.evaluate(f"{EXPLORER}.diagram.trace.length") > 20
    page.evaluate(f"{EXPLORER}.change({{ damping_ratio: 0.05 }})")
    page.wait_for_function(SETTLED)
    assert page.evaluate(f"{EXPLORER}.diagram.trace.length") == 0
