"""No verdict of the page is refuted by a longer march, and a link brings back the very same motion in any browser."""

from functools import cache

import numpy as np
import pytest

import gearpair as gp
from tests.support.engines import as_json, run_in_chromium, run_in_node

N, WATCH = 200, 20_000
VERDICTS = """({ cases, watch }) => cases.map(({ x, v, ...oscillator }) => {
  const cells = gearpair.use("cells").buildCells(oscillator);
  const { settling } = gearpair.use("settle");
  const motion = gearpair.use("flow").startAt(cells, x, v);
  const work = settling(cells, motion, { watch, samples: 64 });
  const said = [];
  for (;;) {
    const { done, value } = work.next();
    if (value) said.push({ status: value.status, period: value.period, lasted: value.lasted });
    if (done) return { ...value, said };
  }
})"""
# A plain march, with no test but one at its end: how near the last state comes to one of the 64 before it.
MARCH = """(cases) => cases.map(({ x, v, periods, ...oscillator }) => {
  const cells = gearpair.use("cells").buildCells(oscillator);
  const { startAt, walk } = gearpair.use("flow");
  const motion = startAt(cells, x, v);
  walk(cells, motion, periods - 64);
  const before = [];
  for (let i = 0; i < 64; i++) {
    before.push([motion.x, motion.v]);
    walk(cells, motion, 1);
  }
  return Math.min(...before.map(([x, v]) => Math.max(Math.abs(x - motion.x), Math.abs(v - motion.v))));
})"""


@cache
def addresses() -> list[tuple[gp.Oscillator, float, float]]:
    """Where chaos, long transients and coexisting motions are common, with the numbers of an address."""
    rng = np.random.default_rng(24)
    drawn = []
    for i in range(N):
        osc = gp.Oscillator(
            mesh_frequency=round(rng.uniform(0.95, 1.45), 3),
            damping_ratio=(0.02, round(rng.uniform(0.005, 0.04), 4))[i % 2],
            error_amplitude=(0.2, round(rng.uniform(0.1, 0.4), 3))[i % 4 == 3],
        )
        drawn.append((osc, round(rng.uniform(-2.0, 2.0), 2), round(rng.uniform(-1.5, 1.5), 2)))
    return drawn


@cache
def verdicts() -> list[dict]:
    return run_in_node(VERDICTS, {"cases": [as_json(*case) for case in addresses()], "watch": WATCH})


@pytest.mark.slow
def test_no_verdict_is_refuted_by_a_long_march():
    """The library, from the cycle that is named, is still on it 20 000 mesh periods later."""
    counts = dict.fromkeys(("periodic", "aperiodic", "unsettled", "escaped"), 0)
    for (osc, *_start), answer in zip(addresses(), verdicts(), strict=True):
        counts[answer["status"]] += 1
        if answer["status"] != "periodic":
            continue
        point = answer["points"][0]["x"], answer["points"][0]["v"]
        aside = point[0] + 1e-7, point[1] - 1e-7
        ends = gp.stroboscopic_map(osc, *aside, WATCH // answer["period"] * answer["period"])
        np.testing.assert_allclose(np.ravel(ends), point, rtol=0.0, atol=1e-6)
        assert gp.steady_state(osc, *point).period == answer["period"]
    assert counts["periodic"] > 100
    assert counts["aperiodic"] > 20


@pytest.mark.slow
def test_what_is_called_chaotic_so_far_had_not_settled_by_then():
    """A march without a verdict in it has not come to repeat when the page still says that it does not."""
    chaotic = [
        (case, answer) for case, answer in zip(addresses(), verdicts(), strict=True) if answer["status"] == "aperiodic"
    ]
    cases = [{**as_json(*case), "periods": answer["lasted"]} for case, answer in chaotic]
    assert min(run_in_node(MARCH, cases)) > 1e-7
    assert min(answer["lasted"] for _case, answer in chaotic) >= WATCH


@pytest.mark.slow
def test_a_motion_is_named_for_good_and_only_once():
    """Before a motion is named it may be chaotic so far; after that nothing is said of it."""
    late = 0
    for answer in verdicts():
        *before, last = answer["said"]
        assert all(said["status"] in ("aperiodic", "unsettled") for said in before)
        assert [said["lasted"] for said in answer["said"]] == sorted(said["lasted"] for said in answer["said"])
        late += bool(before) and last["status"] == "periodic"
    assert late > 1, "no transient ended while it was watched: draw other addresses"


@pytest.mark.slow
def test_the_browser_s_motion_is_node_s_to_the_last_bit(browser):
    """And what is told of it; exponents are sums of logarithms, in which engines differ by a rounding."""
    order = {"cases": [as_json(*case) for case in addresses()], "watch": WATCH}
    for told, expected in zip(run_in_chromium(browser, VERDICTS, order), verdicts(), strict=True):
        of_logarithms = {name: expected[name] for name in ("exponents", "error")}
        assert told == {**expected, **{name: told[name] for name in of_logarithms}}
        for name, value in of_logarithms.items():
            np.testing.assert_allclose(told[name], value, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("engine", ["node", "chromium"])
def test_a_long_transient_ends_in_period_2(engine, request):
    """Said to be chaos once, over the picture of a period 2."""
    run = run_in_node if engine == "node" else lambda *all: run_in_chromium(request.getfixturevalue("browser"), *all)
    case = as_json(gp.Oscillator(mesh_frequency=1.09), 0.5, -0.5)
    (answer,) = run(VERDICTS, {"cases": [case], "watch": WATCH})
    assert (answer["status"], answer["period"]) == ("periodic", 2)


def test_sine_and_cosine_are_exact_to_rounding():
    angles = np.linspace(-20.0, 20.0, 4001).tolist()
    pairs = np.array(run_in_node("(angles) => angles.map(gearpair.use('closed_form').sineCosine)", angles))
    assert np.abs(pairs - np.transpose([np.sin(angles), np.cos(angles)])).max() <= 2.0**-53
