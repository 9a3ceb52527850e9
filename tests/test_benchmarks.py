"""The benchmarks compare the same motions, and fail on accuracy alone."""

import numpy as np
import pytest

import gearpair as gp
from benchmarks import __main__ as bench
from benchmarks.methods import all_methods


@pytest.mark.parametrize("method", all_methods(), ids=lambda method: method.name)
def test_every_method_computes_the_same_motion(method):
    osc = gp.Oscillator(mesh_frequency=1.219)
    exact = np.array(gp.stroboscopic_map(osc, 1.3, 0.2, 2))
    tolerance = 0.3 if "default" in method.name else 1e-2 if "1e-6" in method.name else 1e-5
    assert np.abs(np.array(method.prepare(osc)(1.3, 0.2, 2)) - exact).max() < tolerance


def test_accuracy_that_falls_short_is_an_error_and_time_is_not(monkeypatch, capsys):
    for name in ("compare_methods", "ordinary_speed", "batches"):
        monkeypatch.setattr(bench, name, lambda: None)
    monkeypatch.setattr(bench, "FREQUENCIES", (1.6,))
    monkeypatch.setattr(bench, "degenerate_cases", lambda: {"at rest": (gp.Oscillator(), 1.1, 0.0)})
    assert bench.main() == 0
    monkeypatch.setattr(bench, "ORDINARY", 1e-20)
    assert bench.main() == 1
    assert "falls short" in capsys.readouterr().err
