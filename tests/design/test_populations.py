"""A series of gearboxes against a plain loop over its drives, and its statistics against scipy's."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

import gearpair as gp
from gearpair.design import helps_most, population
from gearpair.design.charts import carried_runs, oscillators_at
from gearpair.design.loads import same_motion
from gearpair.design.populations import binomial_interval, drive_of, sampled
from gearpair.motion.impacts import ImpactState

DRIVE = gp.GearDrive.from_pair(
    gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0, transmission_error_um=3.0, damping_ratio=0.05
)
SPREAD = {
    "backlash_um": (15.0, 90.0),
    "transmission_error_um": stats.truncnorm(-2.0, 2.0, loc=3.0, scale=1.0),
    "damping_ratio": (0.04, 0.08),
}
SPEEDS = np.linspace(6000.0, 10_000.0, 17)


@pytest.fixture(scope="module")
def series() -> xr.Dataset:
    return population(DRIVE, SPREAD, SPEEDS, n=40)


def test_the_boxes_are_those_of_a_plain_loop(series: xr.Dataset) -> None:
    """Each drive built by hand, its runs carried up and down and measured one by one."""
    kinds, in_one_alone = set(), []
    for i in (*range(0, 40, 5), 12, 28):  # the last two clatter, and at some speeds in one run alone
        backlash, error, damping, phase = series.value.values[i].tolist()
        box = DRIVE.replace(backlash_um=backlash, transmission_error_um=error, damping_ratio=damping).at_phase(phase)
        [(up, down)] = carried_runs([oscillators_at(box, SPEEDS)], None)
        unit = box.half_backlash_m * box.natural_frequency_rad_s * 1e3
        for k, both in enumerate(zip(up, down, strict=True)):
            here = series.isel(box=i, speed=k)
            measures = [gp.motion.impact_measures(each, n_periods=300) for each in both]
            assert all(state.period for state in both)  # chaos, which is watched for longer here, would differ
            assert here.dynamic_factor == pytest.approx(max(each.load_factor for each in measures), rel=1e-6)
            struck = max(max(each.drive_velocity, each.coast_velocity) for each in measures) * unit
            assert here.impact_velocity == pytest.approx(struck, rel=1e-5, abs=1e-6)
            states = {state.impact_state for state in both}
            assert bool(here.parts) == bool(states - {ImpactState.NONE_DRIVE, ImpactState.NONE_COAST})
            assert bool(here.clatters) == (ImpactState.DOUBLE in states)
            assert bool(here.two_motions) == (not same_motion(*both))
            kinds.add((bool(here.parts), bool(here.clatters), bool(here.two_motions)))
            in_one_alone += [ImpactState.DOUBLE in states and len(states) > 1]
    assert all({each[k] for each in kinds} == {False, True} for k in range(3))
    assert any(in_one_alone)


def test_intervals_are_scipys(series: xr.Dataset) -> None:
    for k in range(len(SPEEDS)):
        count = int(series.parts.values[:, k].sum())
        assert series.parting_share.values[k] == count / 40
        exact = stats.binomtest(count, 40).proportion_ci(0.95, method="exact")
        ends = [series[f"parting_share_{end}"].values[k] for end in ("low", "high")]
        assert ends == pytest.approx([exact.low, exact.high], abs=1e-12)
    for count in (0, 1, 7, 20):
        exact = stats.binomtest(count, 20).proportion_ci(0.8, method="exact")
        ends = binomial_interval(count, 20, 0.8)
        assert [float(each) for each in ends] == pytest.approx([exact.low, exact.high], abs=1e-12)


def test_statistics_of_the_boxes(series: xr.Dataset) -> None:
    worst = series.dynamic_factor.max("speed").values
    assert series.largest_factor.values == pytest.approx(worst)
    for k in range(4):
        expected = stats.spearmanr(series.value.values[:, k], worst).statistic
        assert series.rank_correlation.values[k] == pytest.approx(expected, abs=1e-12)
    assert series.rank_correlation.sel(quantity="transmission_error_um") > 0.2
    assert series.rank_correlation.sel(quantity="damping_ratio") < 0.0
    median = series.factor_quantile.sel(quantile=0.5).values
    assert median.tolist() == np.sort(series.dynamic_factor.values, axis=0)[19].tolist()
    for lowest, parts in zip(series.first_loss.values, series.parts.values, strict=True):
        assert np.isnan(lowest) if not parts.any() else lowest == SPEEDS[parts].min()
    lower = series.value.sel(quantity="damping_ratio").values.argsort()[:20]
    share = series.half_share.sel(quantity="damping_ratio", half="lower").values
    assert share == pytest.approx(series.parts.values[lower].mean(axis=0))


def test_what_helps_most_is_the_error_where_all_hangs_on_it() -> None:
    drive = DRIVE.at_phase(0.0)
    spread = {"transmission_error_um": (0.1, 6.0), "pinion_torque_nm": (99.0, 101.0)}
    found = population(drive, spread, [7500.0, 8000.0, 8500.0], n=64)
    assert helps_most(found) == ("transmission_error_um", "lower")
    assert population(drive, {"damping_ratio": (0.05, 0.05 + 1e-12)}, SPEEDS[:2], n=2).sizes["quantity"] == 1


def test_points_fill_ranges_and_distributions() -> None:
    values = sampled({"a": (2.0, 4.0), "b": stats.norm(5.0, 0.5), "c": stats.expon(scale=3.0)}, 512, seed=3)
    uniform = (values[:, 0] - 2.0) / 2.0, stats.norm.cdf(values[:, 1], 5.0, 0.5), stats.expon.cdf(values[:, 2] / 3.0)
    for column in uniform:  # one point in each of 512 intervals: a Sobol sequence
        assert sorted(np.floor(column * 512).astype(int).tolist()) == list(range(512))
    more = sampled({"a": (2.0, 4.0), "b": stats.norm(5.0, 0.5), "c": stats.expon(scale=3.0)}, 700, seed=3)
    assert more[:512].tobytes() == values.tobytes()


def test_the_same_seed_gives_the_same_bits_and_another_one_others(series: xr.Dataset) -> None:
    again = population(DRIVE, SPREAD, SPEEDS, n=8)
    assert again.dynamic_factor.values.tobytes() == series.dynamic_factor.values[:8].tobytes()
    other = population(DRIVE, SPREAD, SPEEDS[:2], n=8, seed=1)
    assert not np.array_equal(other.value, again.value)


def test_a_store_holds_the_same_bits_and_goes_on(series, tmp_path, monkeypatch) -> None:
    pytest.importorskip("zarr")
    from gearpair.ensembles import stores

    monkeypatch.setattr(stores, "BLOCK_POINTS", 17 * 12)
    block, begun = stores.store_block, []

    def killed(grid, path, i, **how):
        if i == 2:
            raise KeyboardInterrupt
        begun.append(i)
        block(grid, path, i, **how)

    path = tmp_path / "series.zarr"
    monkeypatch.setattr(stores, "store_block", killed)
    with pytest.raises(KeyboardInterrupt):
        population(DRIVE, SPREAD, SPEEDS, n=40, store=path)
    monkeypatch.setattr(stores, "store_block", lambda *given, **how: (begun.append(given[2]), block(*given, **how)))
    stored = population(DRIVE, SPREAD, SPEEDS, n=40, store=path)
    assert begun == [0, 1, 2, 3]
    assert stored.identical(series)
    with pytest.raises(ValueError, match="was made with another spread"):
        population(DRIVE, SPREAD, SPEEDS, n=40, seed=5, store=path)
    with pytest.raises(ValueError, match="give store, too"):
        population(DRIVE, SPREAD, SPEEDS, n=40, client=object())


def test_a_drawing_is_drawn_anew_for_each_box() -> None:
    relieved = DRIVE.replace(relief=gp.teeth.TipRelief(10.0, 12.0, 0.4))
    values = {"pinion_shift": 0.05, "relief_pinion_um": 8.0, "error_phase_rad": 1.0, "pinion_torque_nm": 80.0}
    box = drive_of(relieved, values)
    by_hand = relieved.replace(
        pinion_shift=0.05, relief=gp.teeth.TipRelief(8.0, 12.0, 0.4), pinion_torque_nm=80.0
    ).at_phase(1.0)
    assert box == by_hand and box.relief == by_hand.relief
    spread = {"pinion_shift": (0.0, 0.1), "relief_gear_um": (5.0, 15.0)}
    found = population(relieved, spread, SPEEDS[:2], n=2)
    for i in range(2):
        own = drive_of(relieved, dict(zip(found.quantity.values.tolist(), found.value.values[i].tolist(), strict=True)))
        state = gp.steady_state(own.at_speed(float(SPEEDS[0])).oscillator(), 1.1)
        assert found.dynamic_factor.values[i, 0] == pytest.approx(
            gp.motion.impact_measures(state).load_factor, rel=1e-6
        )


@pytest.mark.parametrize(
    ("spread", "sentence"),
    [
        ({}, "spread must name at least one quantity"),
        ({"colour": (1.0, 2.0)}, "unknown name 'colour' in spread; what can differ is pinion_torque_nm, backlash_um"),
        ({"backlash_um": (90.0, 60.0)}, "spread of backlash_um must be two finite numbers in rising order, got"),
        ({"backlash_um": stats.norm}, "spread of backlash_um must be two finite numbers in rising order, got"),
        ({"backlash_um": (-5.0, -4.0)}, "spread reaches a box that cannot be built, backlash_um = -4"),
        ({"relief_gear_um": (1.0, 2.0)}, "relief_gear_um can differ only where the drive has a relief"),
    ],
)
def test_bad_spreads_get_a_sentence(spread, sentence) -> None:
    with pytest.raises(ValueError, match=sentence):
        population(DRIVE, spread, SPEEDS, n=2)


def test_other_bad_input_gets_a_sentence() -> None:
    with pytest.raises(ValueError, match="n must be a whole number of at least 1, got 0"):
        population(DRIVE, SPREAD, SPEEDS, n=0)
    with pytest.raises(ValueError, match="n must be a whole number of at most 10000000, got 1000000000000"):
        population(DRIVE, SPREAD, SPEEDS, n=10**12)
    with pytest.raises(ValueError, match="drive must have a torque"):
        population(DRIVE.replace(pinion_torque_nm=0.0), SPREAD, SPEEDS)
    with pytest.raises(ValueError, match="confidence must be"):
        population(DRIVE, SPREAD, SPEEDS, confidence=1.0)
    with pytest.raises(TypeError, match="unknown option"):
        population(DRIVE, SPREAD, SPEEDS, most_work=3)


def test_progress_is_shown(capsys) -> None:
    population(DRIVE, SPREAD, SPEEDS[:2], n=3, progress=True)
    assert "boxes: 100%" in capsys.readouterr().err
