"""The explorer's JavaScript computes what gearpair computes: states, impacts, settled motions, spectra, diagrams."""

from functools import cache, partial

import numpy as np
import pytest

import gearpair as gp
from gearpair._flow.cells import build_cells
from gearpair._flow.closed_form import TERMS
from gearpair._flow.walk import walk
from gearpair.motion.trajectories import raise_unless_ok
from tests.support.engines import as_json, run_in_chromium, run_in_node
from tests.support.oscillators import degenerate_cases, random_case
from tests.support.reference import plain_coefficients

PERIODS = 4


@pytest.fixture(scope="module", params=["node", "chromium"])
def run(request):
    """Runs a function of the modules; skips where the engine is missing, before anything is computed."""
    if request.param == "chromium":
        return partial(run_in_chromium, request.getfixturevalue("browser"))
    run_in_node("() => 0", None)
    return run_in_node


RECORD = """(cases) => cases.map(({ periods, x, v, ...oscillator }) => {
  const cells = gearpair.use("cells").buildCells(oscillator);
  const motion = gearpair.use("flow").startAt(cells, x, v);
  const { status, crossings } = gearpair.use("observe").record(cells, motion, periods, periods);
  const times = crossings.map(({ time, side, contact }) => [time, side, Number(contact)]);
  const free = gearpair.use("flow").startAt(cells, x, v);
  gearpair.use("flow").walk(cells, free, periods);
  return { status, ends: [motion.x, motion.v, free.x, free.v], times };
})"""


def growth(osc: gp.Oscillator, x: float, v: float) -> float:
    """The most that an error made at the start of a mesh period grows until the end, at least 1."""
    cells, series = build_cells(plain_coefficients(osc)), np.empty(TERMS)
    matrices = []
    for _ in range(PERIODS):
        m = np.eye(2)
        status, x, v = walk(cells, x, v, 1, series, m)
        raise_unless_ok(status, PERIODS)
        matrices.append(m)
    tail, most = np.eye(2), 1.0
    for m in reversed(matrices):
        tail = tail @ m
        most = max(most, float(np.linalg.norm(tail, np.inf)))
    return most


@cache
def records() -> list[tuple[dict, gp.Trajectory, float]]:
    """Cases as the modules take them, with gearpair's motion and how much errors grow in it."""
    rng = np.random.default_rng(20240613)
    cases = [random_case(rng) for _ in range(10_000)] + list(degenerate_cases().values())
    return [
        ({**as_json(*case), "periods": PERIODS}, gp.trajectory(*case, PERIODS, samples_per_period=1), growth(*case))
        for case in cases
    ]


@pytest.mark.slow
def test_states_and_impacts_of_ten_thousand_oscillators_and_every_degenerate_case(run):
    cases, motions, growths = zip(*records(), strict=True)
    worst = 0.0
    for case, motion, most, answer in zip(cases, motions, growths, run(RECORD, cases), strict=True):
        assert answer["status"] == 0
        times = np.array(answer["times"]).reshape(-1, 3)
        assert times[:, 1].tolist() == motion.impacts.side.tolist(), case
        assert times[:, 2].tolist() == motion.impacts.contact.tolist(), case
        ends = np.array(answer["ends"]).reshape(2, 2)
        size = max(1.0, np.abs(motion.x).max(), np.abs(motion.v).max())
        worst = max(worst, np.abs(ends - [motion.x[-1], motion.v[-1]]).max() / size / most)
    assert worst < 1e-13


SETTLE = """(cases) => cases.map(({ x, v, ...oscillator }) => {
  const cells = gearpair.use("cells").buildCells(oscillator);
  const measures = gearpair.use("measures");
  const motion = gearpair.use("settle").settle(cells, x, v, {});
  if (!motion.points.length) return { status: motion.status };
  return { ...motion, multipliers: motion.monodromy && measures.multipliers(motion.monodromy),
           impact: gearpair.use("verdict").impactState(motion.low, motion.high) };
})"""


def gear_pair(rng: np.random.Generator) -> gp.Oscillator:
    """A gear pair such as the sliders make."""
    wave = gp.StiffnessWave.rectangular(
        rng.uniform(1.1, 1.9), rng.uniform(0.0, 0.4), rng.uniform(0.0, 0.6), ("printed", "swapped")[rng.integers(2)]
    )
    return gp.Oscillator(
        mean_force=rng.uniform(0.02, 0.4),
        error_amplitude=rng.uniform(0.05, 0.6),
        error_phase=rng.uniform(-3.0, 3.0),
        damping_ratio=rng.uniform(0.005, 0.1),
        mesh_frequency=rng.uniform(0.3, 2.5),
        stiffness=wave,
    )


@pytest.mark.slow
def test_settled_motions(run):
    rng = np.random.default_rng(4)
    states = [gp.steady_state(gear_pair(rng), rng.normal(0.0, 1.5), rng.normal(), max_period=64) for _ in range(400)]
    bounded = [state for state in states if len(state.points)]
    # From beside the settled motion, so that no chaotic transient decides between two that coexist.
    cases = []
    for state in bounded:
        later = 0 if state.status == "periodic" else 2100  # what its exponents took
        x, v = gp.stroboscopic_map(state.oscillator, *state.points[0], later)
        cases.append(as_json(state.oscillator, float(x) + 1e-6, float(v)))
    counts = dict.fromkeys(("periodic", "aperiodic"), 0)
    for state, answer in zip(bounded, run(SETTLE, cases), strict=True):
        if state.status == "unsettled":
            continue
        if state.status == "aperiodic" and answer["status"] == "periodic":
            # A transient, whose end rounding decides: the cycle that it ended on is the library's too.
            point = answer["points"][0]
            assert gp.steady_state(state.oscillator, point["x"], point["v"]).period == answer["period"]
            continue
        assert answer["status"] == state.status
        counts[str(state.status)] += 1
        if state.status == "aperiodic":
            error = np.hypot(state.exponent_error, answer["error"])
            assert abs(answer["exponents"][0] - state.lyapunov_exponents[0]) < 6.0 * error
            continue
        assert answer["period"] == state.period
        points = np.array([[point["x"], point["v"]] for point in answer["points"]])
        assert np.abs(points - state.points).max() < 1e-9
        multipliers = np.array(answer["multipliers"]) @ [1.0, 1.0j]
        assert np.abs(multipliers - state.multipliers).max() < 1e-8
        assert abs(answer["low"] - state.x_min) < 1e-9
        assert abs(answer["high"] - state.x_max) < 1e-9
        assert answer["impact"] == state.impact_state
    assert counts["periodic"] > 300
    assert counts["aperiodic"] > 5


def test_another_damping_in_free_flight(run):
    """States, impacts and settled motions with none, little and much of it."""
    rng = np.random.default_rng(7)
    cases, ends = [], []
    for i in range(60):
        osc, x, v = random_case(rng)
        osc = osc.replace(flight_damping=(0.0, 0.05, 1.5)[i % 3])
        cases.append({**as_json(osc, x, v), "periods": 1})
        ends.append([gp.stroboscopic_map(osc, x, v), growth(osc, x, v)])
    for answer, (end, most) in zip(run(RECORD, cases), ends, strict=True):
        np.testing.assert_allclose(answer["ends"][:2], end, rtol=0.0, atol=1e-12 * most * max(1.0, *map(abs, end)))
    for flight_damping in (0.0, 0.2):
        osc = gp.Oscillator(damping_ratio=0.05, flight_damping=flight_damping)
        state = gp.steady_state(osc)
        (answer,) = run(SETTLE, [as_json(osc)])
        assert (answer["status"], answer["period"]) == (state.status, state.period)
        found = [answer["low"], answer["high"], *answer["exponents"]]
        np.testing.assert_allclose(found, [state.x_min, state.x_max, *state.lyapunov_exponents], rtol=0.0, atol=1e-9)
        multipliers = np.array(answer["multipliers"]) @ [1.0, 1.0j]
        np.testing.assert_allclose(multipliers, state.multipliers, rtol=0.0, atol=1e-8)


def test_large_starts_escape_where_contact_is_unstable(run):
    osc = gp.Oscillator(mesh_frequency=2.0, damping_ratio=0.001, stiffness=gp.StiffnessWave.rectangular(1.5, 0.5, 0.5))
    assert gp.steady_state(osc, 50.0, 0.0).status == "escaped"
    assert run(SETTLE, [as_json(osc, 50.0, 0.0)]) == [{"status": "escaped"}]


def test_without_damping_nothing_is_called_periodic(run):
    (answer,) = run(SETTLE, [as_json(gp.Oscillator(damping_ratio=0.0), 1.2, 0.0)])
    assert answer["status"] == gp.steady_state(gp.Oscillator(damping_ratio=0.0), 1.2, 0.0).status
    assert answer["status"] in ("unsettled", "aperiodic")


@pytest.mark.parametrize("frequency", [0.7, 1.8])
def test_the_load_factor_is_the_largest_mesh_force_over_the_mean(run, frequency):
    osc = gp.Oscillator(mesh_frequency=frequency)
    state = gp.steady_state(osc)
    (answer,) = run(SETTLE, [as_json(osc, *state.points[0])])
    motion = gp.trajectory(osc, *state.points[0], state.period, samples_per_period=20_000)
    depth = np.sign(motion.x) * np.maximum(np.abs(motion.x) - 1.0, 0.0)
    # Just before each sample: a sample on an edge of the wave belongs to the piece that ends there, too.
    before = osc.stiffness(motion.tau / osc.period - 1e-12)
    sampled = float(np.abs(before * depth).max())
    assert sampled - 1e-12 <= answer["force"] < sampled * (1.0 + 1e-3)


SPECTRUM = """({ x, v, periods, ...oscillator }) => {
  const cells = gearpair.use("cells").buildCells(oscillator);
  const motion = gearpair.use("flow").startAt(cells, x, v);
  const samples = gearpair.use("observe").record(cells, motion, periods, 2048).x;
  const { frequency, amplitude } = gearpair.use("measures").spectrum(samples, periods);
  return [Array.from(samples), Array.from(frequency), Array.from(amplitude)];
}"""


@pytest.mark.slow
def test_spectrum_and_samples(run):
    osc = gp.Oscillator()
    motion = gp.trajectory(osc, 1.0, 0.0, 8, samples_per_period=256)
    lines = gp.spectrum(motion)
    samples, frequency, amplitude = run(SPECTRUM, {**as_json(osc), "periods": 8})
    assert np.abs(np.array(samples) - motion.x[:-1]).max() < 1e-11
    assert frequency == lines.frequency[:-1].tolist()
    assert np.abs(np.array(amplitude) - lines.amplitude[:-1]).max() < 1e-13


DIAGRAM = """(order) => [...gearpair.use("branches").columns(order)].filter(Boolean)"""


def test_the_diagram_is_a_rising_and_then_a_falling_sweep(run):
    osc = gp.Oscillator(damping_ratio=0.06)
    order = {"oscillator": as_json(osc), "parameter": "mesh_frequency", "lower": 0.4, "upper": 0.9, "count": 41}
    columns = run(DIAGRAM, {**order, "x": 1.0, "v": 0.0})
    values = np.linspace(0.4, 0.9, 41)
    up = gp.sweep(osc, "mesh_frequency", values, x=1.0, v=0.0)
    last = {"x": up.x.values[-1, 0], "v": up.v.values[-1, 0]}
    down = gp.sweep(osc, "mesh_frequency", values[::-1], **last)
    assert [column["falling"] for column in columns] == [False] * 41 + [True] * 41
    for half, result in ((columns[:41], up), (columns[41:], down)):
        np.testing.assert_allclose([column["value"] for column in half], result.mesh_frequency.values, rtol=1e-14)
        for column, period, xs in zip(half, result.period.values, result.x.values, strict=True):
            assert column["motion"] == f"period {int(period)}"
            points = [point["x"] for point in column["points"]]
            assert np.abs(np.array(points) - xs[: len(points)]).max() < 1e-8
    both = np.abs(up.x_max.values - down.x_max.values[::-1]) > 1e-3
    assert both.any()  # somewhere the way there decides


ESCAPE = """({ x, v, ...oscillator }) => {
  const cells = gearpair.use("cells").buildCells(oscillator);
  const { OK, ESCAPED, startAt, walk } = gearpair.use("flow");
  const motion = startAt(cells, x, v);
  for (let periods = 1; ; periods++) {
    const status = walk(cells, motion, 1);
    if (status !== OK) return [periods, status === ESCAPED];
  }
}"""


def test_an_escape_is_noticed_in_the_same_period(run):
    wave = gp.StiffnessWave.rectangular(1.5, 0.5, 0.5)
    osc = gp.Oscillator(mesh_frequency=2.0, damping_ratio=0.001, stiffness=wave)
    periods, escaped = run(ESCAPE, as_json(osc, 50.0, 0.0))
    assert escaped
    assert np.isinf(gp.stroboscopic_map(osc, 50.0, 0.0, periods)[0])
    assert np.isfinite(gp.stroboscopic_map(osc, 50.0, 0.0, periods - 1)[0])
