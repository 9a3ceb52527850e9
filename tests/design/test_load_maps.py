"""A map of loads is the speed chart at each torque, and a duty cycle meets the worst of the map about its points."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import duty_cycle, load_map, speed_chart
from gearpair.teeth import TipRelief

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DATA = dict(pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=4.0, damping_ratio=0.05)
DRIVE = gp.GearDrive.from_pair(PAIR, **DATA)
SPEEDS = np.linspace(0.4, 1.0, 13) * DRIVE.resonance_rpm
TORQUES = [-120.0, 0.0, 60.0, 120.0]
FEW = {"n_starts": 2, "n_phases": 2}


@pytest.fixture(scope="module")
def found():
    return load_map(DRIVE, TORQUES, SPEEDS, **FEW)


def test_each_row_is_the_speed_chart_of_that_torque(found):
    for torque in TORQUES:
        chart, row = speed_chart(DRIVE.replace(pinion_torque_nm=torque), SPEEDS, **FEW), found.sel(torque=torque)
        for name, of_chart in (("dynamic_factor", "factor_high"), ("loss", "loss"), ("worst_phase", "worst_phase")):
            assert np.array_equal(row[name], chart[of_chart], equal_nan=name == "dynamic_factor")
        for name in ("tooth_force", "motion", "impact_state"):
            assert np.array_equal(row[name], chart[name].sel(run="worst"))
        assert np.array_equal(row.jump_speed, chart.jump_speed.sel(run=["up", "down"]), equal_nan=True)
        assert np.all(row.mesh_force.values >= chart.mesh_force.max("run").values * (1.0 - 1e-12))
    assert found.dynamic_factor.sel(torque=0.0).isnull().all() and (found.mesh_force.sel(torque=0.0) >= 0.0).all()
    assert np.isfinite(found.jump_speed).any() and {*found.loss.sel(torque=120.0).values.tolist()} > {""}


def test_reversed_torque_is_the_same_drive_in_a_mirror(found):
    """The error's phase is turned by half a period, which is the other of the two that are taken."""
    there, back = found.sel(torque=120.0), found.sel(torque=-120.0)
    for name in ("dynamic_factor", "mesh_force", "tooth_force", "impact_velocity"):
        assert np.allclose(there[name], back[name], rtol=1e-6)
    turned = np.mod(there.worst_phase.values + np.pi, 2.0 * np.pi)
    assert np.allclose(back.worst_phase, turned)


def test_twice_of_torque_error_and_backlash_is_the_same_motion_twice_as_large(found):
    larger = DRIVE.replace(transmission_error_um=8.0, backlash_um=200.0)
    half, row = found.sel(torque=60.0), load_map(larger, [120.0, 121.0], SPEEDS, **FEW).sel(torque=120.0)
    assert np.allclose(row.dynamic_factor, half.dynamic_factor, rtol=1e-6) and np.array_equal(row.loss, half.loss)
    for name in ("mesh_force", "tooth_force", "impact_velocity"):
        assert np.allclose(row[name], 2.0 * half[name], rtol=1e-6)


@pytest.mark.slow
def test_a_relief_follows_the_torque():
    drive = DRIVE.replace(transmission_error_um=0.0, relief=TipRelief(8.0, 8.0, 1 / 3))
    found = load_map(drive, [60.0, 120.0], SPEEDS[::4], n_starts=0)
    for torque in (60.0, 120.0):
        drawn = gp.GearDrive.from_pair(
            PAIR, **(DATA | {"pinion_torque_nm": torque, "transmission_error_um": 0.0}), relief=drive.relief
        )
        chart = speed_chart(drawn, SPEEDS[::4], n_starts=0)
        assert np.allclose(found.dynamic_factor.sel(torque=torque), chart.factor_high, rtol=1e-9)
    assert not np.allclose(*found.dynamic_factor.values, rtol=0.02)


def test_a_duty_cycle_takes_the_worst_of_the_points_around(found):
    between = 0.5 * (SPEEDS[3] + SPEEDS[4])
    cycle = duty_cycle(found, [(60.0, SPEEDS[0], 6.0), (90.0, between, 1.0), (120.0, between, 1.0)])
    around = found.isel(torque=[2, 3], speed=[3, 4])
    by_place = cycle.sortby("point")
    assert by_place.dynamic_factor.values.tolist() == [
        found.dynamic_factor.values[2, 0],
        around.dynamic_factor.max().item(),
        around.dynamic_factor.sel(torque=120.0).max().item(),
    ]
    assert np.all(np.diff(cycle.mesh_force) <= 0.0) and cycle.worst_mesh_force == cycle.mesh_force[0]
    assert by_place.time_share.values.tolist() == [0.75, 0.125, 0.125]
    assert cycle.parted_share.item() == by_place.time_share.values[by_place.loss.values != ""].sum()


def test_what_leaves_the_model_is_the_worst_whatever_its_force(found):
    wild = found.copy(deep=True)
    wild.loss[2, 0] = "leave what the model can follow"
    cycle = duty_cycle(wild, [(120.0, SPEEDS[-1], 1.0), (60.0, SPEEDS[0], 0.0)])
    assert cycle.point.values.tolist() == [1, 0] and cycle.parted_share == float(cycle.loss[1] != "")


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        ([], "points must be rows of a torque, a speed and a time, got shape (0,)"),
        ([(60.0, SPEEDS[0], 0.0)], "points must have a time above 0 among them, got none"),
        ([(60.0, SPEEDS[0])], "points must be rows of a torque, a speed and a time, got shape (1, 2)"),
        ([(60.0, None, 1.0)], "points must be real numbers, got None"),
        ([(130.0, SPEEDS[0], 1.0)], "the torque of a point must be"),
        ([(60.0, 1.0, 1.0)], "the speed of a point must be"),
        ([(60.0, SPEEDS[0], -1.0)], "the time of points[0] must be"),
    ],
)
def test_a_point_off_the_map_or_not_whole_gets_a_sentence(found, points, sentence):
    with pytest.raises(ValueError) as told:
        duty_cycle(found, points)
    assert str(told.value).startswith(sentence)


@pytest.mark.parametrize("torques", [[100.0], [100.0, 50.0], [[1.0, 2.0]], [1.0, np.nan]])
def test_torques_have_to_rise(torques):
    with pytest.raises(ValueError, match="torques_nm"):
        load_map(DRIVE, torques, SPEEDS)
