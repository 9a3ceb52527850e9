"""The margin of the torque over speed: nothing where there is one motion, zero at the jump."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import shock_margin, speed_chart

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DRIVE = gp.GearDrive.from_pair(
    PAIR, pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=[(1, 4.0, 0.0)], damping_ratio=0.05
)


@pytest.mark.slow
def test_margins_over_the_range_of_two_motions() -> None:
    chart = speed_chart(DRIVE, np.linspace(6500.0, 11_000.0, 46), n_starts=0)
    jumps = {run: float(np.nanmax(chart.jump_speed.sel(run=run))) for run in ("up", "down")}
    inside = jumps["down"] + (jumps["up"] - jumps["down"]) * np.array([0.05, 0.35, 0.65, 0.98])
    speeds = np.array([jumps["down"] - 100.0, *inside, jumps["up"] + 200.0])
    margin = shock_margin(DRIVE, speeds, cycles=3, n_phases=4, n_starts=4)
    assert margin.n_motions.values.tolist() == [1, 2, 2, 2, 2, 1]
    assert np.isnan(margin.shock_margin.values[[0, -1]]).all()
    smaller = margin.shock_margin.values[1:-1]
    assert (np.diff(smaller) < 0.0).all() and smaller[-1] < 0.1
    assert (np.diff(margin.dip_back.values[1:-1]) > 0.0).all() and margin.dip_back.values[1] < 0.15
    assert set(margin.after_shock.values[1:-1]) == {"period 1, single-sided"}
    assert (margin.loud_factor > margin.quiet_factor).values[1:-1].all()


def test_bad_input() -> None:
    with pytest.raises(ValueError, match="drive must have a torque that can dip"):
        shock_margin(DRIVE.replace(pinion_torque_nm=0.0), [1000.0, 2000.0])
    with pytest.raises(ValueError, match="largest must be"):
        shock_margin(DRIVE, [1000.0, 2000.0], largest=0.0)
