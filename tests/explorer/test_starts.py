"""The plane of starts: its labels are the library's, and the page shows them, names them and starts at them."""

import json

import numpy as np
import pytest

import gearpair as gp
from tests.support.engines import as_json, run_in_node
from tests.support.explorer_pages import EXPLORER, SETTLED, part, shown, state

LABELS = """(order) => {
  const fields = new Map();
  for (const label of gearpair.use("plane").labels(order)) if (label) fields.set([label.i, label.j].join(), label);
  return [...fields.values()];
}"""
STARTS = f"{EXPLORER}.starts"
ACROSS, UP = 48, 32
ASIDE = np.linspace(-1e-9, 1e-9, 15)
MOST = 0.01  # of the starts: those within 1e-9 of a boundary, where the last digits of the transient decide
CASES = {
    "the baseline, with four motions": ({}, (-2.5, 2.5, -1.5, 1.5)),
    "contact only damps": ({"damping_ratio": 0.04, "flight_damping": 0.0}, (-3.0, 3.0, -2.0, 2.0)),
    "three motions of large range": ({"mesh_frequency": 1.7}, (-12.0, 12.0, -12.0, 12.0)),
    "long chaotic transients": ({"mesh_frequency": 1.09}, (-2.0, 2.0, -1.5, 1.5)),
}


def labels(osc: gp.Oscillator, box: tuple[float, float, float, float]) -> list[dict]:
    sides = dict(zip(("left", "right", "bottom", "top"), box, strict=True))
    return run_in_node(LABELS, {"oscillator": as_json(osc), "range": sides})


def reached(osc: gp.Oscillator, xs: np.ndarray, vs: np.ndarray) -> np.ndarray:
    """The library's motion by start, as (period, smallest X of the section); (0, 0) where it is not periodic."""
    result = gp.basins(osc, xs, vs)
    motions = dict.fromkeys([-1], (0.0, 0.0))
    for number, period, x in zip(result.attractor_number, result.attractor_period, result.attractor_x, strict=True):
        motions[int(number)] = (float(period), float(x)) if period > 0 else (0.0, 0.0)
    return np.array([[motions[int(number)] for number in row] for row in result.attractor.values])


@pytest.mark.parametrize("name", CASES)
@pytest.mark.slow
def test_the_labels_are_those_of_basins(name):
    """1536 starts end on the library's motion, but for those that have the page's within 1e-9, too."""
    changes, box = CASES[name]
    osc = gp.Oscillator(**changes)
    found = labels(osc, box)
    assert len(found) == ACROSS * UP
    xs, vs = (np.unique([label[name] for label in found]) for name in ("x", "v"))
    truth = reached(osc, xs, vs)
    motions, differing = set(), 0
    for label in found:
        motion = label["motion"]
        own = (motion["period"], motion["points"][0]["x"]) if motion["period"] else (0.0, 0.0)
        motions.add((own[0], round(own[1], 6)))
        if np.abs(truth[np.searchsorted(vs, label["v"]), np.searchsorted(xs, label["x"])] - own).max() > 1e-6:
            differing += 1
            near = reached(osc, label["x"] + ASIDE, label["v"] + ASIDE).reshape(-1, 2)
            assert np.abs(near - own).max(axis=1).min() < 1e-6, (label["x"], label["v"])
    assert differing <= MOST * len(found)
    assert len(motions) >= 2


def test_starts_from_coarse_to_fine_each_once():
    order = {"oscillator": as_json(gp.Oscillator(damping_ratio=0.1)), "range": dict(left=-2, right=2, bottom=-1, top=1)}
    all_of = "(order) => [...gearpair.use('plane').labels(order)].filter(Boolean)"
    found = run_in_node(all_of, order)
    sizes = [label["size"] for label in found]
    assert sizes == sorted(sizes, reverse=True)
    assert [sizes.count(size) for size in (4, 2, 1)] == [96, 288, 1152]
    assert len({(label["i"], label["j"]) for label in found}) == 1536


def test_a_start_that_is_chaotic_so_far_is_called_that_and_watched():
    osc = gp.Oscillator(mesh_frequency=1.219)
    found = labels(osc, (0.0, 0.4, 0.0, 0.3))
    assert {label["motion"]["status"] for label in found} >= {"aperiodic"}
    some = [label for label in found if label["motion"]["status"] == "aperiodic"][::100]
    for label in some:
        assert gp.steady_state(osc, label["x"], label["v"]).status == "aperiodic"


def wait_for_starts(page) -> None:
    page.wait_for_function(f"{SETTLED} && {STARTS}.range && !{STARTS}.busy")


def chips(page) -> list[str]:
    return page.eval_on_selector_all(".gp-chips button", "(all) => all.map((chip) => chip.textContent)")


def test_chips_name_the_motions_and_start_them(explorer):
    page = explorer()
    wait_for_starts(page)
    assert page.evaluate(f"{part('found')}.textContent") == "motions seen: 1 of 4 found"
    names = chips(page)
    assert len(names) == 4
    assert [name.endswith("✓") for name in names] == [True, False, False, False]
    for place, name in enumerate(names):
        chip = page.locator(".gp-chips button").nth(place)
        chip.focus()
        page.keyboard.press("Enter")
        wait_for_starts(page)
        now = state(page)
        truth = gp.steady_state(gp.Oscillator(), now["x"], now["v"])
        assert name.startswith(f"period {truth.period}, ")
        assert shown(page, "motion") == f"period {truth.period}"
        assert chip.get_attribute("aria-current") == "true"
        assert page.evaluate("document.activeElement.textContent").startswith(f"period {truth.period}")
    assert page.evaluate(f"{part('found')}.textContent") == f"motions seen: {len(names)} of {len(chips(page))} found"


def test_the_picture_has_each_start_in_the_colour_of_its_motion(explorer):
    """Read off the canvas where the axes say that the start is, outside the shaded play."""
    page = explorer()
    wait_for_starts(page)
    right, wrong = page.evaluate(f"""(() => {{
      const {{ phasePlot, state, starts }} = {EXPLORER}, {{ range, theme }} = starts;
      const canvas = {part("phase")}, ratio = canvas.width / canvas.clientWidth;
      const cells = gearpair.use("cells").buildCells(state);
      const verdict = gearpair.use("verdict");
      let [right, wrong] = [0, 0];
      for (let i = 0; i < {ACROSS}; i++) for (let j = 0; j < {UP}; j++) {{
        const x = range.left + (range.right - range.left) * (i + 0.5) / {ACROSS};
        const v = range.bottom + (range.top - range.bottom) * (j + 0.5) / {UP};
        if (Math.abs(x) < 1.05) continue;
        const start = [x, v].map((value) => Number(value.toFixed(4)));
        const {{ status, period }} = gearpair.use("settle").settle(cells, ...start);
        const colour = theme.motion[verdict.colourName(verdict.motionName(status, period))];
        const at = [phasePlot.x(x), phasePlot.y(v)].map((place) => Math.round(place * ratio));
        const {{ data }} = canvas.getContext("2d").getImageData(...at, 1, 1);
        const same = [0, 1, 2].every((k) => Math.abs(data[k] - parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16)) < 6);
        same ? right++ : wrong++;
      }}
      return [right, wrong];
    }})()""")
    assert right > 500
    assert wrong < 0.06 * right  # under the motion's line


def test_another_gear_pair_forgets_them_and_another_start_does_not(explorer):
    page = explorer()
    wait_for_starts(page)
    order = page.evaluate(f"{STARTS}.order")
    page.evaluate(f"{EXPLORER}.change({{ x: 0.9 }})")
    wait_for_starts(page)
    assert page.evaluate(f"{STARTS}.order") == order
    page.evaluate(f"{EXPLORER}.change({{ damping_ratio: 0.1 }})")
    page.wait_for_function(f"{STARTS}.motions.length === 0 || {STARTS}.motions[0].motion.state?.damping_ratio === 0.1")
    wait_for_starts(page)
    assert len(chips(page)) == 1
    assert chips(page)[0].endswith("100 % ✓")


def test_a_motion_that_the_plane_has_missed_comes_to_the_others(explorer):
    """Its starts lie outside the plane or between those that were tried."""
    page = explorer("#mesh_frequency=1.7&damping_ratio=0.02")
    wait_for_starts(page)
    before = chips(page)
    far = labels(gp.Oscillator(mesh_frequency=1.7), (-12.0, 12.0, -12.0, 12.0))
    held = page.evaluate(f"{STARTS}.motions.map(({{ motion }}) => motion.points[0])")
    known = [point["x"] for point in held]
    periodic = [label for label in far if label["motion"]["period"]]
    new = next(label for label in periodic if np.abs(np.array(known) - label["motion"]["points"][0]["x"]).min() > 1e-6)
    page.evaluate(f"{EXPLORER}.change({json.dumps({name: new[name] for name in ('x', 'v')})})")
    wait_for_starts(page)
    assert len(chips(page)) > len(before)
    assert page.evaluate(f"{STARTS}.motions[{STARTS}.present].met")


@pytest.mark.parametrize("width", [360, 1300])
def test_chips_are_large_enough_and_fit(explorer, width):
    page = explorer("#mesh_frequency=1.09")
    page.set_viewport_size({"width": width, "height": 740})
    page.wait_for_function(f"innerWidth <= {width} && document.querySelectorAll('.gp-chips button').length > 2")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    least = 43.9 if width == 360 else 24
    assert all(chip.bounding_box()["height"] >= least for chip in page.locator(".gp-chips button").all())
