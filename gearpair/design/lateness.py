"""How late a ramp of the speed jumps: how far it goes on beyond the fold at which the steady motion ends."""

import numpy as np

from gearpair.bifurcations import Bifurcation
from gearpair.design.passages import run_up
from gearpair.drive import GearDrive
from gearpair.motion.measures import impact_measures
from gearpair.motion.settling import Status
from gearpair.motion.steady import SteadyState, steady_state

BEFORE = 0.003  # of the speed, from which a ramp begins at least
LIVES = 10.0  # of what begins with the ramp, which has died out by then
BEYOND = (0.005, 0.02, 0.06, 0.2)  # how far it is followed, the next where it has not jumped by then
SAME = 1e-6  # of the force: one motion on both sides
NUDGE = 1e-3  # of the speed, beside the fold, at which both motions are looked at


def lateness(drive: GearDrive, fold: Bifurcation, run: str, ramp_rpm_per_s: float) -> float:
    """How far (rpm) a run at a ramp goes on beyond a fold before its mesh force is half-way to that of the jump.

    Negative where it jumps before; infinite where it has not jumped a fifth of the speed beyond. Nan where a motion
    beside the fold has no bound, or where both have one force.
    """
    at, sense = fold.value * drive.resonance_rpm, 1.0 if run == "up" else -1.0
    before = _near(drive, fold, at * (1.0 - sense * NUDGE))
    after = _near(drive, fold, at * (1.0 + sense * NUDGE))
    if Status.ESCAPED in (before.status, after.status):
        return np.nan
    factors = [impact_measures(each).load_factor for each in (before, after)]
    if abs(factors[1] - factors[0]) < SAME * factors[0]:
        return np.nan
    lives = LIVES / (max(drive.damping_ratio, 1e-3) * drive.natural_frequency_rad_s)
    start = at - sense * min(at * BEFORE + ramp_rpm_per_s * lives, 0.3 * at)
    settled = _near(drive, fold, start)
    for beyond in BEYOND:
        end = at * (1.0 + sense * beyond)
        ramped = run_up(drive, start, end, abs(end - start) / ramp_rpm_per_s, start=settled)
        jumped = (ramped.dynamic_factor.values - np.mean(factors)) * (factors[1] - factors[0]) > 0.0
        if jumped.any():
            return sense * (float(ramped.speed.values[int(jumped.argmax())]) - at)
    return np.inf


def _near(drive: GearDrive, fold: Bifurcation, speed_rpm: float) -> SteadyState:
    """The motion that one on the fold's orbit settles on at a speed near by."""
    return steady_state(drive.at_speed(speed_rpm).oscillator(), fold.x, fold.v)
