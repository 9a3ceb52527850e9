"""The page of recipes is true: every block runs, and puts out what stands there."""

import doctest
import re
from itertools import pairwise

import numpy as np
import pytest
from matplotlib import pyplot as plt
from scipy.integrate import solve_ivp

import gearpair as gp
from tests.support import ROOT

PAGE = (ROOT / "book" / "recipes.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
ON_A_CLUSTER = [block for block in BLOCKS if "distributed" in block]


def run(blocks):
    """Run blocks one after the other, as a reader would; the report of what came out otherwise."""
    names, report = {}, []
    for block in blocks:
        test = doctest.DocTestParser().get_doctest(block, names, block.split("\n")[0], "book/recipes.md", 0)
        doctest.DocTestRunner(verbose=False).run(test, out=report.append, clear_globs=False)
        names = test.globs
    return "".join(report)


def test_every_recipe_runs_from_the_first_to_the_last(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert len(BLOCKS) == PAGE.count("```") // 2 >= 11
    assert run([block for block in BLOCKS if block not in ON_A_CLUSTER]) == ""
    plt.close("all")


@pytest.mark.slow
def test_the_recipe_on_a_cluster_runs(tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.chdir(tmp_path)
    assert len(ON_A_CLUSTER) == 1
    assert run([BLOCKS[0], *ON_A_CLUSTER]) == ""


def test_a_wrong_output_would_be_seen():
    assert "Expected" in run([">>> 1 + 1\n3\n"])


def test_the_recipes_are_short():
    """A sentence, a block of twelve lines at most, a sentence."""
    recipes = re.split(r"^## .*\n", PAGE, flags=re.MULTILINE)[1:]
    assert len(recipes) == len(BLOCKS) - 1
    for recipe in recipes:
        before, block, after = re.split(r"```(?:python)?\n", recipe)
        assert len(block.splitlines()) <= 12
        assert all(0 < len(re.findall(r"[.:](?=\s)", text)) <= 2 for text in (before, after))
    headings = re.findall(r"^#+ .*", PAGE, flags=re.MULTILINE)
    assert not [one for one, other in pairwise(headings) if one == other]


def test_a_play_that_is_not_centred_is_the_model_s():
    """Against scipy, in the coordinate with the play from 0 to 3 and the forces as they are."""
    low, high, load, error = 0.0, 3.0, 0.15, 0.3
    middle, half = (low + high) / 2.0, (high - low) / 2.0
    osc = gp.Oscillator(mean_force=load / half, error_amplitude=error / half)
    state = gp.steady_state(osc)

    def slope(tau, y):
        apart = y[0] - high if y[0] > high else y[0] - low if y[0] < low else 0.0
        force = load + error * osc.mesh_frequency**2 * np.sin(osc.mesh_frequency * tau)
        return y[1], force - 2.0 * osc.damping_ratio * y[1] - osc.stiffness(tau / osc.period) * apart

    x, v = state.points[0]
    end = state.period * osc.period
    found = solve_ivp(slope, (0.0, end), (middle + half * x, half * v), max_step=0.005, rtol=1e-9, atol=1e-9)
    assert found.y[:, -1] == pytest.approx(found.y[:, 0], abs=1e-3)
    extremes = found.y[0].min(), found.y[0].max()
    assert extremes == pytest.approx((middle + half * state.x_min, middle + half * state.x_max), abs=1e-3)
