"""Sweeps, maps and basins: what is carried, what is restarted, what is labelled, what a stop leaves."""

import numpy as np
import pytest

import gearpair as gp
from gearpair import _cores
from gearpair.ensembles import sweeps
from gearpair.motion import settling
from gearpair.motion.settling import MANY

BASELINE = gp.Oscillator()
QUICK = {"n_transient": 300, "n_exponent": 200}


def test_restarted_sweep_is_one_steady_state_per_value():
    values = np.linspace(0.7, 1.6, 7)
    diagram = gp.sweep(BASELINE, "mesh_frequency", values, seeding="restart", **QUICK)
    for i, omega in enumerate(values):
        state = gp.steady_state(BASELINE.replace(mesh_frequency=omega), n_samples=128, **QUICK)
        assert diagram.status[i] == state.status
        assert diagram.period[i] == (state.period or 0)
        assert diagram.impact_state[i] == state.impact_state
        assert [float(diagram.x_min[i]), float(diagram.x_max[i])] == [state.x_min, state.x_max]
        cycle = np.resize(state.points, (128, 2)) if state.period else state.points
        np.testing.assert_allclose(diagram.x[i], cycle[:, 0], rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(diagram.v[i], cycle[:, 1], rtol=0.0, atol=1e-9)


def test_carried_sweep_shows_hysteresis_where_two_motions_coexist():
    """Bouncing or nearly not: the history decides. Down from the top differs from up."""
    values = np.linspace(0.4, 0.7, 21)
    up = gp.sweep(BASELINE, "mesh_frequency", values, **QUICK)
    down = gp.sweep(BASELINE, "mesh_frequency", values[::-1], **QUICK).sortby("mesh_frequency")
    assert up.attrs["seeding"] == "carry"
    assert np.any(np.abs(up.x_max.values - down.x_max.values) > 0.1)


def test_carried_sweep_visits_the_values_in_their_order():
    values = [1.6, 0.9, 1.5]
    diagram = gp.sweep(BASELINE, "mesh_frequency", values, **QUICK)
    assert diagram.mesh_frequency.values.tolist() == values
    alone = gp.sweep(BASELINE, "mesh_frequency", values[:2], **QUICK)
    np.testing.assert_array_equal(diagram.x[:2], alone.x)
    assert np.any(diagram.x[2].values != gp.sweep(BASELINE, "mesh_frequency", values[2:], **QUICK).x[0].values) or (
        diagram.period[2] > 0
    )


def test_after_an_escape_the_next_value_starts_afresh():
    osc = gp.Oscillator(damping_ratio=0.001)
    diagram = gp.sweep(osc, "mesh_frequency", [1.95, 1.5], x=300.0, n_transient=2000, n_exponent=200)
    assert diagram.status[0] == "escaped"
    assert diagram.impact_state[0] == ""
    assert np.all(np.isnan(diagram.x[0])) or np.all(np.abs(diagram.x[0]) > 1.0)
    assert diagram.status[1] in ("periodic", "aperiodic", "unsettled")


def test_every_scalar_can_be_swept_and_says_its_unit():
    for name in BASELINE.parameters:
        value = BASELINE.parameter(name)
        diagram = gp.sweep(BASELINE, name, [value], seeding="restart", **QUICK)
        assert diagram[name].attrs["units"] == ("rad" if name == "error_phase" else "1")
        assert diagram[name].attrs["long_name"]
        assert all(v.attrs["units"] and v.attrs["long_name"] for v in diagram.data_vars.values())
    assert "contact_ratio" not in gp.Oscillator(stiffness=gp.StiffnessWave((0.0,), (1.0,))).parameters


def test_a_map_is_a_sweep_in_each_direction():
    axes = {"damping_ratio": [0.03, 0.1], "mesh_frequency": [0.7, 1.0, 1.6]}
    grid = gp.parameter_map(BASELINE, axes, **QUICK)
    assert dict(grid.sizes) == {"damping_ratio": 2, "mesh_frequency": 3}
    for i, zeta in enumerate(axes["damping_ratio"]):
        row = gp.sweep(
            BASELINE.replace(damping_ratio=zeta), "mesh_frequency", axes["mesh_frequency"], seeding="restart", **QUICK
        )
        for name in ("status", "period", "x_min", "x_max"):
            np.testing.assert_array_equal(grid[name][i], row[name])


def test_basins_label_what_each_start_reaches():
    osc = gp.Oscillator(mesh_frequency=0.9, damping_ratio=0.02)
    x, v = np.linspace(-2.0, 3.0, 12), np.linspace(-1.5, 1.5, 10)
    found = gp.basins(osc, x, v)
    assert found.attractor.shape == (10, 12)
    assert float(found.attractor_share.sum()) == pytest.approx(1.0)
    for i, j in ((0, 0), (4, 7), (9, 11)):
        state = gp.steady_state(osc, x[j], v[i], n_exponent=500)
        number = int(found.attractor[i, j])
        assert found.attractor_period[number] == (state.period or 0)
        if state.period:
            assert float(found.attractor_x[number]) == pytest.approx(state.points[0, 0], abs=1e-6)
    periodic = found.where(found.attractor_status == "periodic", drop=True)
    points = np.stack([periodic.attractor_x, periodic.attractor_v], axis=1)
    gaps = np.abs(points[:, None] - points[None]).max(axis=2) + np.eye(len(points))
    assert gaps.min() > 1e-6


@pytest.mark.parametrize("seeding", ["carry", "restart"])
def test_a_stop_is_a_stop(monkeypatch, seeding):
    """Ctrl-C in the third block: nothing comes back that is half done."""
    calls = []

    def interrupted(first, last, *arguments):
        calls.append(first)
        if len(calls) == 3:
            raise KeyboardInterrupt
        original(first, last, *arguments)

    original = settling.settle_lanes
    monkeypatch.setattr(settling, "settle_lanes", interrupted)
    monkeypatch.setattr(settling, "BLOCK", 1)
    monkeypatch.setattr(_cores.config, "NUMBA_NUM_THREADS", 1)
    with pytest.raises(KeyboardInterrupt):
        gp.sweep(BASELINE, "mesh_frequency", np.linspace(1.5, 1.6, 6), seeding=seeding, **QUICK)
    assert len(calls) == 3


def test_progress_moves_on_stderr_only(capsys):
    gp.sweep(BASELINE, "mesh_frequency", [1.6, 1.65], progress=True, **QUICK)
    out, err = capsys.readouterr()
    assert out == ""
    assert "2/2" in err
    gp.sweep(BASELINE, "mesh_frequency", [1.6, 1.65], **QUICK)
    assert capsys.readouterr().err == ""


def test_blocks_cover_everything_once_and_errors_come_through():
    seen, steps = [], []
    _cores.on_all_cores(lambda first, last, tag: seen.extend(range(first, last)), ("x",), 23, 5, steps.append)
    assert sorted(seen) == list(range(23))
    assert sorted(steps) == [3, 5, 5, 5, 5]
    _cores.on_all_cores(lambda first, last: seen.append(-1), (), 0, 5)
    assert -1 not in seen

    def fails(first, last):
        raise ValueError("in a block")

    with pytest.raises(ValueError, match="in a block"):
        _cores.on_all_cores(fails, (), 9, 2)


def test_a_large_map_watches_in_full_beside_what_left_its_chaos(monkeypatch):
    """Around the speeds whose chaos ends: few labels differ from those of a full watch, at a part of its price."""
    axes = {"damping_ratio": [0.02, 0.021], "mesh_frequency": np.linspace(1.4, 1.66, 27)}
    full = gp.parameter_map(BASELINE, axes)
    monkeypatch.setattr(sweeps, "IN_FULL", 0)
    brief = gp.parameter_map(BASELINE, axes)
    longest = MANY.before_watch(BASELINE) + MANY.n_watch
    shortest = MANY.before_watch(BASELINE) + MANY.n_watch // sweeps.FIRST_LOOK
    chaos = brief.status.values == "aperiodic"
    assert set(brief.lasted.values[chaos].tolist()) == {shortest, longest}
    assert set(full.lasted.values[full.status.values == "aperiodic"].tolist()) == {longest}
    left = ~chaos & (brief.lasted.values > MANY.before_watch(BASELINE))
    for i, j in np.argwhere(chaos & (brief.lasted.values == longest)):
        assert left[i, max(0, j - 2) : j + 3].any()
    for i, j in np.argwhere(chaos & (brief.lasted.values == shortest)):
        assert not left[i, max(0, j - 2) : j + 3].any()
    assert np.sum(brief.status.values != full.status.values) <= 3
    line = gp.parameter_map(BASELINE, {"mesh_frequency": [1.219]})
    assert line.lasted.values.tolist() == [longest]


def test_both_exponents_are_stored_whatever_the_result(tmp_path):
    """The smallest is what the smaller multiplier says where the motion is periodic, and -2 zeta less the largest."""
    values = [0.75, 0.86, 1.219]  # two periods and chaos
    diagram = gp.sweep(BASELINE, "mesh_frequency", values, seeding="restart")
    for i, omega in enumerate(values):
        state = gp.steady_state(BASELINE.replace(mesh_frequency=omega))
        found = diagram.exponent.values[i], diagram.smallest_exponent.values[i]
        assert found == pytest.approx(tuple(state.lyapunov_exponents), abs=1e-12)
        if state.period:
            rates = np.log(np.abs(state.multipliers)) / (state.period * state.oscillator.period)
            assert found == pytest.approx(tuple(rates), abs=1e-9)
    grid = gp.parameter_map(BASELINE, {"damping_ratio": [0.02, 0.05], "mesh_frequency": values})
    plane = gp.basins(BASELINE.replace(mesh_frequency=1.219), [0.0, 1.0], [0.0, 0.5])
    along = gp.ensembles.continue_attractors(BASELINE, "mesh_frequency", [0.7, 1.219], n=20)
    np.testing.assert_allclose(grid.exponent + grid.smallest_exponent, [[-0.04] * 3, [-0.1] * 3], atol=1e-9)
    for one, other in (("exponent", "smallest_exponent"), ("attractor_exponent", "attractor_smallest_exponent")):
        np.testing.assert_allclose(plane[one] + plane[other], -0.04, atol=1e-9)
    sums = (along.attractor_exponent + along.attractor_smallest_exponent).values
    np.testing.assert_allclose(sums[np.isfinite(sums)], -0.04, atol=1e-9)
    assert grid.smallest_exponent.attrs["long_name"] == "smallest Lyapunov exponent per unit tau"


def test_a_file_from_before_the_second_exponent_is_read_as_ever(tmp_path):
    import xarray as xr

    diagram = gp.sweep(BASELINE, "mesh_frequency", [0.75, 0.86, 1.219])
    diagram.drop_vars("smallest_exponent").to_netcdf(tmp_path / "older.nc")
    older = xr.open_dataset(tmp_path / "older.nc")
    assert gp.ensembles.motion_ranges(older) == gp.ensembles.motion_ranges(diagram)
    assert gp.ensembles.representatives(BASELINE, older) == gp.ensembles.representatives(BASELINE, diagram)
    line = gp.plotting.exponents(older).lines[1]
    np.testing.assert_array_equal(line.get_ydata(), diagram.exponent)
