"""Run-up, load change and schedules of a drive, against formulas and the steady motions between which they lead."""

import math

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import how_many_moments, load_change, load_change_moments, run_up, schedule
from gearpair.design.courses import mesh_cycles
from gearpair.design.passages import inertia_force_n

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DRIVE = gp.GearDrive.from_pair(
    PAIR, pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=[(1, 4.0, 0.0)], damping_ratio=0.05
)


def test_mesh_periods_of_a_ramp() -> None:
    """The phase of each mesh period's start is whole: the integral of the speed, by trapezia."""
    cycles = mesh_cycles(DRIVE, 0.4, [(0.0, 1000.0), (0.1, 4000.0), (0.25, 2500.0)], 50.0)
    times, speeds = np.array([0.0, 0.1, 0.25, 1.0]), np.array([1000.0, 4000.0, 2500.0, 2500.0])
    for i in (0, 7, 100, 200, 300, len(cycles.speed)):
        t = cycles.time[i]
        inside = times < t
        knots = np.append(times[inside], t)
        values = np.interp(knots, times, speeds)
        turns = np.sum(np.diff(knots) * 0.5 * (values[1:] + values[:-1])) / 60.0 if len(knots) > 1 else 0.0
        assert turns * 28 == pytest.approx(i, abs=1e-9)
    assert cycles.time[-2] < 0.4 <= cycles.time[-1]
    steady = cycles.time[:-1] > 0.25
    assert cycles.speed[steady] == pytest.approx(2500.0, rel=1e-9)
    assert cycles.acceleration[steady] == pytest.approx(0.0, abs=1e-6)
    assert cycles.acceleration[5] == pytest.approx(30_000.0 * 2.0 * np.pi / 60.0, rel=1e-9)


def test_a_constant_schedule_stays_with_the_steady_motion() -> None:
    drive = DRIVE.at_speed(8000.0)
    state = gp.steady_state(drive.oscillator())
    run = schedule(drive, 0.05, speed_rpm=8000.0, start=state)
    loads = gp.design.measure_motion(drive, state)
    assert run.mesh_force.values == pytest.approx(loads["mesh_force"], rel=1e-7)
    assert run.dynamic_factor.values == pytest.approx(loads["dynamic_factor"], rel=1e-7)
    assert run.impact_velocity.values == pytest.approx(loads["impact_velocity"], rel=1e-6)
    assert run.sizes["cycle"] == round(0.05 * 8000.0 / 60.0 * 28)


def test_the_mesh_accelerates_the_driven_side() -> None:
    """Two rotors in balance: m_e (r1 T1 / I1 + r2 T2 / I2) with the torques that Newton's law asks for."""
    r1, r2 = DRIVE.pinion_base_radius_mm * 1e-3, DRIVE.gear_base_radius_mm * 1e-3
    i1, i2, a1 = DRIVE.pinion_inertia_kg_m2, DRIVE.gear_inertia_kg_m2, 700.0
    load = DRIVE.gear_torque_nm
    drive_torque = load * r1 / r2 + (i1 + i2 * (r1 / r2) ** 2) * a1
    force = DRIVE.equivalent_mass_kg * (r1 * drive_torque / i1 + r2 * load / i2)
    assert DRIVE.mean_force_n + float(inertia_force_n(DRIVE, a1)) == pytest.approx(force, rel=1e-12)
    ramp = run_up(DRIVE, 3000.0, 4000.0, 0.15)
    a1 = 1000.0 / 0.15 * 2.0 * np.pi / 60.0
    assert ramp.mean_mesh_force.values == pytest.approx(DRIVE.mean_force_n + float(inertia_force_n(DRIVE, a1)))
    plain = run_up(DRIVE, 3000.0, 4000.0, 0.15, accelerates=False)
    assert plain.mean_mesh_force.values == pytest.approx(DRIVE.mean_force_n)


def test_a_fast_ramp_is_late() -> None:
    """Down through the resonance: the teeth part until a lower speed, the faster the lower; up: from a higher one."""
    lost, found = [], []
    for seconds in (1.0, 0.2, 0.05):
        down = run_up(DRIVE, 11_000.0, 6200.0, seconds, accelerates=False)
        lost.append(float(down.speed[down.x_min.values < 1.0][-1]))
        up = run_up(DRIVE, 6200.0, 11_000.0, seconds, accelerates=False)
        found.append(float(up.speed[up.x_min.values < 1.0][0]))
    assert lost[0] > lost[1] > lost[2]
    assert found[2] > found[0] + 5.0 and abs(found[1] - found[0]) < 1.0  # the jump up is abrupt
    assert lost[0] - lost[2] > 100.0


@pytest.mark.slow
@pytest.mark.parametrize("ends", [(6200.0, 11_000.0), (11_000.0, 6200.0)])
def test_steps_of_the_speed_are_a_smooth_ramp(ends: tuple[float, float]) -> None:
    """Over the resonance in 50 ms: the speeds at which contact is first and last lost or made, to 0.1 rpm."""
    seconds, per_period = 0.05, 800
    run = run_up(DRIVE, *ends, seconds, accelerates=False, samples_per_period=per_period)
    start = DRIVE.at_speed(float(run.speed[0])).oscillator()
    fraction = np.arange(per_period) / per_period
    error = np.array([start.replace(mesh_frequency=each / DRIVE.resonance_rpm).error(fraction * 2.0 * np.pi
        * DRIVE.resonance_rpm / each) for each in run.speed.values])  # fmt: skip
    x = (run.sample_dte.values / (DRIVE.half_backlash_m * 1e6) - error).ravel()
    second = DRIVE.natural_frequency_rad_s
    found = crossings(run.sample_time.values.ravel() * second, x)
    first, rate = ends[0] / DRIVE.resonance_rpm, (ends[1] - ends[0]) / DRIVE.resonance_rpm / (seconds * second)
    v = float(run.v[0]) + start.error_amplitude * (
        start.mesh_frequency - first
    )  # X' + e' goes on from the ramp's start
    smooth = crossings(*smoothly(start, first, rate, float(run.x[0]), v, run.sizes["cycle"], per_period))
    rpm = [(first + rate * each) * DRIVE.resonance_rpm for each in (found[[0, -1]], smooth[[0, -1]])]
    assert rpm[0] == pytest.approx(rpm[1], abs=0.1)
    assert abs(rpm[0][1] - rpm[0][0]) > 1500.0


def crossings(tau: np.ndarray, x: np.ndarray) -> np.ndarray:
    """When samples of X cross 1, by straight lines."""
    at = np.flatnonzero((x[1:] >= 1.0) != (x[:-1] >= 1.0))
    return tau[at] + (1.0 - x[at]) / (x[at + 1] - x[at]) * (tau[at + 1] - tau[at])


def smoothly(osc: gp.Oscillator, first: float, rate: float, x: float, v: float, n: int, per_period: int):
    """Times and X of a motion while the mesh frequency is ``first + rate tau``, by Runge and Kutta's classical method.

    The steps end where the stiffness switches, at phases of the mesh, so that k is one number in each.
    """
    edges, size = [*osc.stiffness.edges, 1.0], osc.error_amplitude
    times, values = [], []

    def pushed(tau: float, x: float, v: float, k: float) -> float:
        omega, theta = first + rate * tau, (first + 0.5 * rate * tau) * tau
        error = size * (omega**2 * math.sin(theta) - rate * math.cos(theta))  # -e''
        return osc.mean_force + error - 2.0 * osc.damping_ratio * v - k * (x - min(max(x, -1.0), 1.0))

    for cycle in range(n):
        for k, begin, end in zip(osc.stiffness.levels, edges[:-1], edges[1:], strict=True):
            turns = [2.0 * math.pi * (cycle + each) for each in (begin, end)]
            tau, until = (2.0 * each / (first + math.sqrt(first**2 + 2.0 * rate * each)) for each in turns)
            steps = math.ceil(per_period * (end - begin))
            h = (until - tau) / steps
            for _ in range(steps):
                times.append(tau)
                values.append(x)
                a1 = pushed(tau, x, v, k)
                v2 = v + 0.5 * h * a1
                a2 = pushed(tau + 0.5 * h, x + 0.5 * h * v, v2, k)
                v3 = v + 0.5 * h * a2
                a3 = pushed(tau + 0.5 * h, x + 0.5 * h * v2, v3, k)
                v4 = v + h * a3
                a4 = pushed(tau + h, x + h * v3, v4, k)
                x, v = x + h * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0, v + h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0
                tau += h
    return np.array(times), np.array(values)


def test_a_reversal_crosses_the_backlash() -> None:
    drive = DRIVE.at_speed(3000.0)
    run = load_change(drive, [(0.0, -20.0), (0.005, 120.0)], 0.1, samples_per_period=64)
    assert run.x_max.values[0] < -0.9 and run.x_min.values[-1] > 0.9
    first = int(np.flatnonzero(run.drive_impacts.values)[0])
    assert 0.0 < run.time.values[first] < 0.01
    assert run.impact_velocity.values[first] > 0.0
    assert run.torque.values[[0, -1]] == pytest.approx([-20.0, 120.0], abs=15.0)
    pressed = run.sample_force.values
    assert pressed.min() < 0.0 < pressed.max()
    assert pressed.max(axis=1)[-1] == pytest.approx(float(run.mesh_force[-1]), rel=2e-2)
    assert pressed[-5:].mean() == pytest.approx(DRIVE.mean_force_n, rel=0.02)


def test_a_change_within_the_first_mesh_period_begins_from_the_motion_before() -> None:
    """At 100 rpm a mesh period takes 21 ms: a change of 1 ms is over at its middle, from where its torque is taken."""
    drive = DRIVE.at_speed(100.0)
    run = load_change(drive, [(0.0, -20.0), (0.001, 120.0)], 0.2)
    before = gp.steady_state(drive.oscillator().replace(mean_force=-20.0 / 120.0 * drive.oscillator().mean_force))
    assert run.torque.values.tolist() == [120.0] * run.sizes["cycle"]
    assert (float(run.x[0]), float(run.v[0])) == pytest.approx(before.points[0].tolist(), abs=1e-9)
    assert float(run.x[0]) < -1.0 < 1.0 < float(run.x[-1]) and float(run.drive_impacts[0]) > 0.0


def test_a_change_of_load_at_many_moments() -> None:
    """Each row is a change that begins so late; and where there is a choice of motions, the moment makes it."""
    drive = DRIVE.at_speed(3000.0)
    course = [(0.0, -20.0), (0.005, 120.0)]
    many = load_change_moments(drive, course, 0.1, n_moments=7)
    period = 2.0 * np.pi / drive.mesh_frequency_rad_s
    assert many.begins.values % 1.0 == pytest.approx((np.arange(7) + 0.5) / 7)
    assert many.begins.values // 1.0 == pytest.approx(np.arange(1, 8))
    assert float(load_change_moments(drive, course, 0.1, n_moments=13).begins[12]) == pytest.approx(1.0 + 12.5 / 13)
    for k in (0, 6):
        late = float(many.begins[k]) * period
        one = load_change(drive, [(0.0, -20.0), (late, -20.0), (late + 0.005, 120.0)], late + 0.1)
        assert float(many.dynamic_factor[k]) == float(one.dynamic_factor.max())
        assert float(many.factor_after[k]) == float(one.dynamic_factor[-20:].max())
        assert float(many.impact_velocity[k]) == float(one.impact_velocity.max())
        assert bool(many.coast_struck[k]) == bool(one.coast_impacts.any())
    steady = float(load_change(drive, 120.0, 0.1).dynamic_factor[-1])
    assert many.factor_after.values == pytest.approx(steady, rel=0.01)  # one motion at this speed
    assert not load_change_moments(drive, [(0.0, 120.0)], 0.1, n_moments=1).coast_struck.any()


@pytest.mark.parametrize(
    ("n", "told"), [(0, "none"), (1, "few"), (5, "few"), (6, "some"), (18, "some"), (19, "most"), (24, "all")]
)
def test_how_many_moments(n: int, told: str) -> None:
    assert how_many_moments(np.arange(24) < n) == told


def test_relieved_tips_follow_the_torque() -> None:
    """At each constant torque the schedule of one drive is that of the drive made for the torque, sign included."""
    relief = gp.teeth.TipRelief(20.0, 20.0, 0.33)
    drive = DRIVE.replace(relief=relief, transmission_error_um=0.0).at_speed(5000.0)
    for torque in (60.0, -120.0):
        made = drive.replace(pinion_torque_nm=torque).replace(damping_n_s_per_m=drive.damping_n_s_per_m)
        own = schedule(made, 0.1, speed_rpm=5000.0, samples_per_period=32)
        other = schedule(drive, 0.1, speed_rpm=5000.0, torque_nm=torque, samples_per_period=32)
        assert other.mesh_force.values[-1] == pytest.approx(own.mesh_force.values[-1], rel=1e-6)
        assert other.sample_dte.values[-1] == pytest.approx(own.sample_dte.values[-1], abs=1e-5)
    without = schedule(drive.replace(relief=None), 0.1, speed_rpm=5000.0, torque_nm=60.0)
    assert without.mesh_force.values[-1] != pytest.approx(own.mesh_force.values[-1], rel=0.05)


def test_bad_input() -> None:
    slow = DRIVE.at_speed(1000.0)
    for call, sentence in (
        (lambda: run_up(DRIVE, 0.0, 3000.0, 1.0), "from_rpm must be a finite number above 0"),
        (lambda: run_up(DRIVE, 100.0, 3000.0, 0.0), "seconds must be a finite number above 0"),
        (
            lambda: schedule(DRIVE, 1.0, speed_rpm=[(0.0, 100.0), (0.5, -100.0)]),
            r"speed_rpm\[1\] must be a finite number above 0",
        ),
        (lambda: schedule(DRIVE, 1.0, speed_rpm=[(0.0, 1.0), (0.0, 2.0)]), "speed_rpm must have times that rise"),
        (lambda: schedule(DRIVE, 1.0, speed_rpm=[(0.5, 100.0)]), "speed_rpm must begin at 0 s"),
        (lambda: schedule(DRIVE, 1.0, speed_rpm=[1.0, 2.0]), "speed_rpm must be a number or pairs"),
        (lambda: schedule(DRIVE, 1e6, speed_rpm=1000.0), "seconds must leave at most 1000000 mesh periods"),
        (lambda: run_up(DRIVE, 1.0, 1e300, 0.1), r"got 0.1, which are 2.33333e\+298"),
        (lambda: load_change(slow, [(0.0, 1.0), (0.5, float("nan"))], 1.0), "torque_nm"),
        (lambda: load_change(DRIVE, [(0.0, 1.0)], 1.0), "this drive has no speed"),
        (lambda: how_many_moments([]), "where must hold truth values, one at least"),
        (lambda: how_many_moments([0.5]), "where must hold truth values, one at least"),
        (lambda: load_change_moments(slow, [(0.1, 1.0)], 1.0), "torque_nm must begin at 0 s"),
        (lambda: load_change_moments(slow, [(0.0, 1.0)], 0.0), "seconds must be a finite number above 0"),
        (lambda: load_change_moments(slow, [(0.0, 1.0)], 1.0, n_moments=0), "n_moments must be a whole number"),
    ):
        with pytest.raises(ValueError, match=sentence):
            call()
