"""The compiled Dormand-Prince pair is scipy's RK45, step for step."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gearpair as gp
from gearpair._flow.runge_kutta import STEP_TOO_SMALL, TOO_MANY_STEPS, Steps, integrate
from gearpair.methods import Integrator
from tests.support.reference import plain_coefficients, right_hand_side


def ours(osc, x, v, n_periods, rtol, atol):
    points = np.empty((n_periods + 1, 2))
    status, steps, calls = integrate(plain_coefficients(osc), x, v, n_periods, Steps(rtol, atol, 0, 10**6), points)
    assert status == 0
    return points, steps, calls


IN_CONTACT = gp.Oscillator(mean_force=3.0, stiffness=gp.StiffnessWave((0.0,), (1.0,)))
THREE_LEVELS = gp.Oscillator(stiffness=gp.StiffnessWave((0.0, 0.3, 0.75), (1.3, 0.6, 1.0)))
ACROSS_EVENTS = [(THREE_LEVELS.replace(mesh_frequency=omega), 0.9, 1e-3) for omega in (0.7, 1.219, 1.6)]
SMOOTH = [(IN_CONTACT, 4.0, rtol) for rtol in (1e-3, 1e-6, 1e-9)]


@pytest.mark.parametrize("osc, x, rtol", ACROSS_EVENTS + SMOOTH)
def test_steps_and_section_are_those_of_scipy(osc, x, rtol):
    """Across events only loosely: a discontinuity inside a step turns rounding into different steps at 1e-9."""
    atol, n = min(rtol, 1e-6), 2
    span, times = (0.0, n * osc.period), np.arange(n + 1) * osc.period
    run = {"method": "RK45", "rtol": rtol, "atol": atol}
    sampled = solve_ivp(right_hand_side(osc), span, (x, 0.3), t_eval=times, **run)
    stepped = solve_ivp(right_hand_side(osc), span, (x, 0.3), **run)
    points, steps, calls = ours(osc, x, 0.3, n, rtol, atol)
    assert steps == len(stepped.t) - 1
    assert calls == sampled.nfev
    np.testing.assert_allclose(points, sampled.y.T, rtol=0.0, atol=1e-10)


def test_converges_to_the_exact_flow_where_no_event_spoils_its_order():
    """Always in contact with a constant stiffness: error against tolerance on a log-log slope near one."""
    osc = IN_CONTACT
    exact = np.array(gp.stroboscopic_map(osc, 4.0, 0.0, n=2))
    tolerances = 10.0 ** np.arange(-4, -11, -1.0)
    errors = [np.abs(ours(osc, 4.0, 0.0, 2, t, t)[0][-1] - exact).max() for t in tolerances]
    slope = np.polyfit(np.log(tolerances), np.log(errors), 1)[0]
    assert 0.9 < slope < 1.1
    assert errors[-1] < 1e-9


def test_only_the_last_points_are_kept():
    osc = gp.Oscillator()
    everything = gp.methods.runge_kutta_section(osc, 1.0, 0.0, 5)
    assert everything.shape == (6, 2)
    np.testing.assert_array_equal(gp.methods.runge_kutta_section(osc, 1.0, 0.0, 5, n_kept=2), everything[-2:])
    np.testing.assert_array_equal(everything[0], [1.0, 0.0])


def test_a_failure_has_a_status_not_a_hang():
    points = np.empty((2, 2))
    p = plain_coefficients(gp.Oscillator())
    assert integrate(p, 1.2, 0.0, 1, Steps(1e-30, 1e-30, 0, 10**5), points)[0] == TOO_MANY_STEPS
    assert integrate(p, 1e308, 1e308, 1, Steps(1e-3, 1e-6, 0, 10**5), points)[0] == STEP_TOO_SMALL
    with pytest.raises(RuntimeError, match="RK45 gave up"):
        gp.methods.runge_kutta_section(gp.Oscillator(), 1e308, 1e308, 1)


def test_carried_and_restarted_sweeps_start_where_they_say():
    osc, values = gp.Oscillator(), [1.6, 1.65, 1.7]
    options = {"n_transient": 20, "n_samples": 5}
    carried = gp.methods.runge_kutta_sweep(osc, "mesh_frequency", values, **options)
    restarted = gp.methods.runge_kutta_sweep(osc, "mesh_frequency", values, seeding="restart", **options)
    for i, omega in enumerate(values):
        alone = gp.methods.runge_kutta_section(osc.replace(mesh_frequency=omega), 1.0, 0.0, 24, n_kept=5)
        np.testing.assert_array_equal(restarted.x[i], alone[:, 0])
    before = carried.isel(mesh_frequency=0, sample=-1)
    alone = gp.methods.runge_kutta_section(
        osc.replace(mesh_frequency=1.65), float(before.x), float(before.v), 24, n_kept=5
    )
    np.testing.assert_array_equal(carried.x[1], alone[:, 0])


def test_section_period():
    cycle = np.tile([[1.0, 0.0], [2.0, 0.1], [3.0, 0.2]], (10, 1))
    assert gp.methods.section_period(cycle) == 3
    assert gp.methods.section_period(cycle + 0.004 * np.sin(np.arange(30))[:, None]) == 3
    assert gp.methods.section_period(np.random.default_rng(1).normal(size=(30, 2))) == 0
    assert gp.methods.section_period(np.full((30, 2), np.nan)) == 0


def test_the_largest_step_is_kept_as_scipy_keeps_it():
    osc, n = THREE_LEVELS, 2
    run = {"method": "RK45", "rtol": 1e-3, "atol": 1e-6, "max_step": osc.period / 50}
    stepped = solve_ivp(right_hand_side(osc), (0.0, n * osc.period), (0.9, 0.3), **run)
    points = np.empty((n + 1, 2))
    status, steps, _ = integrate(plain_coefficients(osc), 0.9, 0.3, n, Steps(1e-3, 1e-6, 50, 10**6), points)
    assert (status, steps) == (0, len(stepped.t) - 1)
    np.testing.assert_allclose(points[-1], stepped.y[:, -1], rtol=0.0, atol=1e-10)


def textbook(osc, x, v, n_periods, n_steps):
    """The classical Runge-Kutta method as textbooks have it, time counted afresh in each mesh period."""
    f, h, y = right_hand_side(osc), osc.period / n_steps, np.array([x, v])
    for _ in range(n_periods):
        for i in range(n_steps):
            # A step's end belongs to the level that begins there: of the next mesh period at the last one.
            t, end = i * h, (i + 1) * h if i < n_steps - 1 else 0.0
            k1 = np.array(f(t, y))
            k2 = np.array(f(t + h / 2, y + h / 2 * k1))
            k3 = np.array(f(t + h / 2, y + h / 2 * k2))
            k4 = np.array(f(end, y + h * k3))
            y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return y


@pytest.mark.parametrize("n_steps", [1, 23, 37, 101])
def test_fixed_steps_are_the_textbook_s(n_steps):
    """Across switches that fall inside steps and contacts that do."""
    points = Integrator(steps=n_steps).sections([THREE_LEVELS], 0.9, 0.3, 2, 1)
    np.testing.assert_allclose(points[0, -1], textbook(THREE_LEVELS, 0.9, 0.3, 2, n_steps), rtol=0.0, atol=1e-11)


def test_fixed_steps_are_of_order_four_where_nothing_switches_and_of_order_one_where_steps_stride_over_it():
    steps = np.array([40, 80, 160])
    slopes = []
    for osc in (IN_CONTACT, IN_CONTACT.replace(stiffness=gp.StiffnessWave((0.0, 1 / 3), (1.2, 0.9)))):
        exact = np.array(gp.stroboscopic_map(osc, 4.0, 0.0, n=2))
        errors = [np.abs(Integrator(steps=int(n)).sections([osc], 4.0, 0.0, 2, 1)[0, -1] - exact).max() for n in steps]
        slopes.append(-np.polyfit(np.log(steps), np.log(errors), 1)[0])
    assert slopes[0] == pytest.approx(4.0, abs=0.15)
    assert slopes[1] == pytest.approx(1.0, abs=0.3)


@pytest.mark.parametrize("integrator", [Integrator(steps=30), Integrator(rtol=1e-4)])
def test_chains_carry_on_and_begin_afresh(integrator):
    """Two chains of three oscillators: each first starts from (x, v), the others where the one before ended."""
    oscillators = [THREE_LEVELS.replace(mesh_frequency=omega) for omega in (0.7, 0.8, 0.9)]
    chained = integrator.sections(oscillators * 2, 0.9, 0.3, 3, 2, chain=3)
    np.testing.assert_array_equal(chained[:3], chained[3:])
    x, v = 0.9, 0.3
    for osc, points in zip(oscillators, chained, strict=False):
        np.testing.assert_array_equal(points, integrator.sections([osc], x, v, 3, 2)[0])
        x, v = map(float, points[-1])


def test_a_motion_that_escapes_is_blank():
    """Far too few steps: the method itself is unstable."""
    assert np.isnan(Integrator(steps=1).sections([THREE_LEVELS.replace(mesh_frequency=0.05)], 5.0, 0.0, 200, 1)).all()


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [({}, "needs steps or rtol"), ({"steps": 0}, "steps must be"), ({"rtol": -1.0}, "rtol must be")],
)
def test_an_integrator_needs_what_it_steps_by(settings, sentence):
    with pytest.raises(ValueError, match=sentence):
        Integrator(**settings)


def test_the_absolute_tolerance_is_a_thousandth_unless_it_is_given():
    default = gp.methods.runge_kutta_section(THREE_LEVELS, 0.9, 0.3, 4, n_kept=2, rtol=1e-3, atol=1e-6)
    np.testing.assert_array_equal(Integrator(rtol=1e-3).sections([THREE_LEVELS], 0.9, 0.3, 3, 2)[0], default)
    other = Integrator(rtol=1e-3, atol=1e-2)
    assert str(other) == "RK45, rtol 0.001, atol 0.01"
    assert np.abs(other.sections([THREE_LEVELS], 0.9, 0.3, 3, 2)[0] - default).max() > 1e-6
    with pytest.raises(ValueError, match="atol must be a finite number above 0, got 0.0"):
        Integrator(rtol=1e-3, atol=0.0)
