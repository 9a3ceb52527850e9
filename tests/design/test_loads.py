"""What the teeth bear on either flank, on every pair, over every period of a cycle."""

import dataclasses

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import measure_motion
from gearpair.design.loads import same_motion

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DATA = dict(pinion_torque_nm=40.0, backlash_um=60.0, transmission_error_um=12.0, damping_ratio=0.05)
DRIVE = gp.GearDrive.from_pair(PAIR, pinion_speed_rpm=6500.0, **DATA)


@pytest.fixture(scope="module")
def clatter():
    """A motion of two mesh periods that strikes both flanks."""
    state = gp.steady_state(DRIVE.oscillator())
    assert str(state.motion) == "period 2, double-sided"
    return state


@pytest.mark.parametrize("speed", [3000.0, 5000.0, 6500.0])
def test_a_drive_that_is_driven_back_bears_on_one_flank_what_it_bore_on_the_other(speed):
    """X to -X turns the torque round and moves the error by half a period; the equation stays."""
    drive = DRIVE.at_speed(speed)
    back = drive.replace(pinion_torque_nm=-40.0, error_phase_rad=np.pi)
    state, mirrored = gp.steady_state(drive.oscillator()), gp.steady_state(back.oscillator(), -1.0, 0.0)
    assert mirrored.x_min == pytest.approx(-state.x_max, rel=1e-9) and mirrored.x_min < -1.0
    assert measure_motion(back, mirrored) == pytest.approx(measure_motion(drive, state), rel=1e-9)


@pytest.mark.parametrize("teeth", [PAIR, PAIR.replace(addendum=1.3)])
def test_the_force_on_one_pair_of_teeth_is_the_largest_of_all_pairs_and_times(teeth):
    """Pair by pair and sample by sample; of the longer teeth two or three pairs share the force."""
    drive = gp.GearDrive.from_pair(teeth, pinion_speed_rpm=5000.0, **DATA)
    osc, shares, state = drive.oscillator(), drive.mesh.load_share, gp.steady_state(drive.oscillator())
    motion = gp.trajectory(osc, *state.points[0].tolist(), state.period, samples_per_period=256)
    largest = np.zeros(len(shares))
    for k, x in enumerate(motion.x[:-1].tolist()):
        fraction = k % 256 / 256
        force = osc.stiffness(fraction) * max(x - 1.0, 0.0) * drive.unit_force_n
        largest = np.maximum(largest, shares[:, int(fraction * shares.shape[1])] * force)
    assert abs(largest[1] - largest[0]) > 0.05 * largest.max()  # it matters which pair is looked at
    assert measure_motion(drive, state)["tooth_force"] == pytest.approx(largest.max(), rel=1e-12)


def test_a_cycle_is_one_motion_from_whichever_of_its_points_it_is_told(clatter):
    for first in range(2):
        assert same_motion(clatter, dataclasses.replace(clatter, points=np.roll(clatter.points, first, axis=0)))
    assert not same_motion(clatter, dataclasses.replace(clatter, points=clatter.points + 1e-3))


def test_a_cycle_is_measured_over_all_its_periods(clatter):
    """The largest of a cycle that strikes in some of its mesh periods only, whichever it is told from."""
    turned = [dataclasses.replace(clatter, points=np.roll(clatter.points, -first, axis=0)) for first in range(2)]
    first, *others = (measure_motion(DRIVE, each) for each in turned)
    for other in others:
        assert other == pytest.approx(first, rel=1e-9)
