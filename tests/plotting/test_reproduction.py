"""Pictures of a reproduction show what they were given."""

import numpy as np
import pytest

from gearpair import article, plotting
from gearpair.article import case, published
from gearpair.methods import Integrator
from gearpair.motion import periodic


def test_score_ranking_has_a_dot_for_every_reading():
    ranked = case.ranking(case.run_trials([article.PRINTED, article.SWAPPED], case.all_protocols(), 21))
    ax = plotting.score_ranking(ranked, {"swapped": article.SWAPPED})
    np.testing.assert_allclose(ax.lines[0].get_ydata(), [entry.mean for entry in ranked])
    np.testing.assert_allclose(ax.lines[1].get_ydata(), [entry.best.total for entry in ranked])
    assert [text.get_text() for text in ax.texts] == ["swapped"]


def test_reached_motions_has_a_box_for_every_range_and_dots_where_reached():
    (reached,) = case.reached([article.SWAPPED], "damping_ratio", 10, n_discarded=200)
    ax = plotting.reached_motions(reached, title="swapped")
    assert len(ax.patches) == len(published.DAMPING_RANGES)
    assert [label.get_text() for label in ax.get_yticklabels()] == ["chaotic", "period 3", "period 1"]
    np.testing.assert_allclose(ax.lines[2].get_xdata(), reached.values[reached.has(periodic(1))])


def test_coverage_by_phase():
    turned = [article.Hypothesis(stiff_for="2 - eps", phase=p) for p in (0.0, 90.0)]
    pair = [case.reached(turned, p, 5, n_discarded=100) for p in ("mesh_frequency", "damping_ratio")]
    ax = plotting.coverage_by_phase(*pair)
    for line, each in zip(ax.lines, pair, strict=False):
        np.testing.assert_allclose(line.get_ydata(), [reached.coverage for reached in each])


def test_boundaries_by_step_shows_each_distance_and_clips_at_the_rim():
    integrators = [Integrator(steps=n) for n in (20, 40)]
    trials = case.run_trials([article.SWAPPED], case.all_protocols(), 41, integrators)
    axes = plotting.boundaries_by_step(trials)
    assert [ax.get_title().split(":")[0] for ax in axes] == ["F2", "F4", "F6", "F8", "F10", "F11", "D2", "D4"]
    for k, ax in enumerate(axes):
        rim = 17.0 * (0.003 if k < 6 else 0.0002)
        lines = {line.get_label(): line for line in ax.lines if line.get_label() in ("up", "down", "restart")}
        for seeding, line in lines.items():
            drawn = {
                t.integrator.steps: (*t.frequency.matches, *t.damping.matches)[k].distance
                for t in trials
                if t.protocol.seeding == seeding
            }
            there = {n: float(np.clip(d, -rim, rim)) for n, d in drawn.items() if d is not None}
            assert dict(zip(line.get_xdata(), line.get_ydata(), strict=True)) == pytest.approx(there)
