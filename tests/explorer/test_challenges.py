"""The six challenges: each can be met, the library says so, and the page marks it when it is."""

import json

import numpy as np
import pytest

import gearpair as gp
from tests.explorer.test_explorer import EXPLORER, SETTLED
from tests.support.explorer_pages import opened, write_page

# One way to meet each, by what the explorer's sliders can do.
WAYS = [
    {"x": -2.3, "v": 1.5},
    {"x": 0.0, "v": -1.5},
    {"mean_force": 0.25},
    {"x": -2.3, "v": 1.5, "damping_ratio": 0.06},
    {"mesh_frequency": 0.55},
    {"mesh_frequency": 1.7, "x": -2.3, "v": 1.5},
]


def motion(way: dict) -> gp.SteadyState:
    changes = dict(way)
    start = changes.pop("x", 1.0), changes.pop("v", 0.0)
    return gp.steady_state(gp.Oscillator().replace(**changes), *start)


def test_each_can_be_met_by_the_library():
    clatter, fifth, silent, ended, fast, hard = map(motion, WAYS)
    assert clatter.impact_state == "double"
    assert fifth.period == 5
    assert silent.impact_state == "none_drive"
    assert ended.impact_state != "double"
    assert fast.impact_state == "none_drive"
    assert gp.motion.impact_measures(hard).load_factor > 100.0
    assert motion({}).impact_state == "single_drive"  # the baseline meets none of them
    assert motion({}).period == 2


@pytest.mark.slow
def test_the_page_marks_what_is_met(browser, tmp_path):
    with opened(browser) as go:
        page = go(write_page(tmp_path).as_uri())
        page.wait_for_function(SETTLED)

        def marks() -> list[str]:
            return page.eval_on_selector_all(".gp-challenges b", "(all) => all.map((mark) => mark.textContent)")

        assert marks() == [""] * 6
        met = np.zeros(6, dtype=bool)
        for i, way in enumerate(WAYS):
            page.evaluate(f"{EXPLORER}.change({{ ...gearpair.use('state').DEFAULTS, ...{json.dumps(way)} }})")
            page.wait_for_function(SETTLED)
            met[i] = True
            assert [bool(mark) for mark in marks()] == met.tolist(), way
        assert marks()[3] == "✓ Your best: damping ratio 0.06."
        for damping, best in ((0.08, 0.06), (0.05, 0.05)):
            page.evaluate(f"{EXPLORER}.change({{ mesh_frequency: 0.7, x: -2.3, v: 1.5, damping_ratio: {damping} }})")
            page.wait_for_function(SETTLED)
            assert marks()[3] == f"✓ Your best: damping ratio {best}."
        page.evaluate(f"{EXPLORER}.change({{ damping_ratio: 0.04, error_amplitude: 0.1 }})")  # two things at once
        page.wait_for_function(SETTLED)
        assert marks()[3] == "✓ Your best: damping ratio 0.05."
