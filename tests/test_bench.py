"""`make bench`: its accuracy part passes as it stands, and fails when the flow is wrong."""

import pytest
from numba import config

import benchmarks.__main__ as bench
from benchmarks import accuracy, jobs, methods, workload


@pytest.fixture(autouse=True)
def own_methods_alone(monkeypatch):
    """The comparison without heyoka, whether or not it is installed: compiling its integrator takes longest."""
    monkeypatch.setattr(methods, "heyoka", None)


def test_the_quick_run_shows_every_method_and_keeps_the_promise(capsys):
    assert bench.main(["--quick"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.count("gearpair, exact flow") == len(methods.FREQUENCIES)
    assert out.count("scipy RK45") == out.count("compiled Dormand-Prince") == 2
    assert "heyoka: not installed" in out


@pytest.mark.parametrize("offset", [1e-11, float("nan")])
def test_a_wrong_flow_gives_a_sentence_and_a_failure(offset, monkeypatch, capsys):
    """An offset too small to see in any diagram; the amplification over a period is some ten at the most."""
    right = methods.exact_flow

    def wrong(osc):
        run = right(osc)

        def shifted(x, v, n):
            x, v = run(x, v, n)
            return x + offset, v

        return shifted if osc.mesh_frequency == 0.95 else run

    monkeypatch.setattr(methods, "exact_flow", wrong)
    assert bench.main(["--quick"]) == 1
    (sentence,) = capsys.readouterr().err.splitlines()
    assert sentence.startswith("accuracy falls short: at Omega_h = 0.95 the exact flow is off by")


def test_the_promise_is_what_decides(monkeypatch, capsys):
    monkeypatch.setattr(accuracy, "PROMISED", 1e-17)
    assert bench.main(["--quick"]) == 1


def test_slow_is_no_failure(monkeypatch):
    seconds = iter(range(10**6))
    monkeypatch.setattr("benchmarks.race.perf_counter", lambda: 1000.0 * next(seconds))
    assert bench.main(["--quick"]) == 0


@pytest.mark.slow
def test_jobs_run_in_a_process_of_their_own():
    before, after = jobs.run_apart("grid", [3])
    assert (before.size, after.size) == (0, 3)
    assert after.seconds > 0.0
    assert 20.0 < before.peak_mib <= after.peak_mib


def test_one_core_is_timed_on_one_thread_and_the_setting_comes_back(monkeypatch):
    seen = []
    monkeypatch.setitem(workload.JOBS, "grid", lambda n: seen.append((n, config.NUMBA_NUM_THREADS)))
    before = config.NUMBA_NUM_THREADS
    workload._on_cores(1, "grid", 7)
    assert seen == [(7, 1)]
    assert before == config.NUMBA_NUM_THREADS
