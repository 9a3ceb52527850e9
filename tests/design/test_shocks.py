"""The margin of the torque over speed: nothing where there is one motion, zero at the jump."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import at_phase
from gearpair.design import measure_motion, shock_margin, speed_chart

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


@pytest.mark.slow
def test_a_margin_against_a_brute_force_of_passages() -> None:
    """Every dip and rise of a grid, at every phase, by a passage of its own: the smallest that ends the motion."""
    cycles, n_phases, sizes = 2, 4, np.linspace(0.01, 1.0, 100)
    margin = shock_margin(DRIVE, [8000.0, 8300.0], cycles=cycles, n_phases=n_phases, n_starts=4).isel(speed=1)
    drive = DRIVE.at_speed(8300.0)
    osc = drive.oscillator()
    states = sorted(gp.attractors(osc, 300), key=lambda state: measure_motion(drive, state)["dynamic_factor"])
    quiet, loud = states[0], states[-1]
    assert (quiet.period, loud.period) == (1, 1) and quiet.x_min > 1.0 > loud.x_min

    def smallest(state: gp.SteadyState, sense: float) -> tuple[float, list[float]]:
        """The smallest change that ends the motion, and the phases at which it may begin; nan where none does."""
        for size in sizes.tolist():
            ends = []
            for k in range(n_phases):
                section = at_phase(osc, k / n_phases)
                start = gp.trajectory(osc, *state.points[0].tolist(), 1, samples_per_period=n_phases)
                dipped = section.replace(mean_force=osc.mean_force * (1.0 + sense * size))
                run = gp.passage([dipped] * cycles + [section] * 300, float(start.x[k]), float(start.v[k]))
                if (run.x_min.values[-1] < 1.0) != (state.x_min < 1.0):
                    ends.append(k / n_phases)
            if ends:
                return size, ends
        return np.nan, []

    step = sizes[1] - sizes[0]
    size, phases = smallest(quiet, -1.0)
    assert size - step < float(margin.shock_margin) <= size and float(margin.shock_phase) in phases
    for name, sense in (("dip_back", -1.0), ("surge_back", 1.0)):
        size, _ = smallest(loud, sense)
        found = float(margin[name])
        assert np.isnan(size) == np.isnan(found)
        assert np.isnan(size) or size - step < found <= size


def test_bad_input() -> None:
    with pytest.raises(ValueError, match="drive must have a torque that can dip"):
        shock_margin(DRIVE.replace(pinion_torque_nm=0.0), [1000.0, 2000.0])
    with pytest.raises(ValueError, match="largest must be"):
        shock_margin(DRIVE, [1000.0, 2000.0], largest=0.0)
