"""Bad input gets one sentence, at once: the name, the value, what is allowed."""

import numpy as np
import pytest

import gearpair as gp

BASELINE = gp.Oscillator()
NAN, INF = float("nan"), float("inf")
RECTANGULAR = gp.StiffnessWave.rectangular


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"mesh_frequency": 0.0}, "mesh_frequency must be a finite number above 0, got 0.0"),
        ({"mesh_frequency": -1.0}, "mesh_frequency must be a finite number above 0, got -1.0"),
        ({"mesh_frequency": NAN}, "mesh_frequency must be a finite number above 0, got nan"),
        ({"mesh_frequency": INF}, "mesh_frequency must be a finite number above 0, got inf"),
        ({"mesh_frequency": "0.7"}, "mesh_frequency must be a finite number above 0, got '0.7'"),
        ({"mesh_frequency": True}, "mesh_frequency must be a finite number above 0, got True"),
        ({"mesh_frequency": 1e-9}, "mesh_frequency must be at least 6.64e-06 at this damping ratio"),
        ({"mesh_frequency": 1e200}, "mesh_frequency must be a finite number at most 1e+06, got 1e+200"),
        ({"damping_ratio": -1e-9}, "damping_ratio must be a finite number at least 0 and at most 100, got -1e-09"),
        ({"damping_ratio": 101}, "damping_ratio must be a finite number at least 0 and at most 100, got 101.0"),
        ({"error_amplitude": -0.1}, "error_amplitude must be a finite number at least 0, got -0.1"),
        ({"error_amplitude": None}, "error_amplitude must be a finite number at least 0, got None"),
        ({"mean_force": NAN}, "mean_force must be a finite number, got nan"),
        ({"error_phase": INF}, "error_phase must be a finite number, got inf"),
        ({"stiffness": 1.0}, "stiffness must be a StiffnessWave, got 1.0"),
        ({"contact_ratio": 1.0}, "contact_ratio must be a finite number above 1 and below 2, got 1.0"),
        ({"contact_ratio": 2.0}, "contact_ratio must be a finite number above 1 and below 2, got 2.0"),
        ({"b": 1.0}, "b must be a finite number below 1, got 1.0"),
        ({"a": -1.0}, "a must be a finite number above -1, got -1.0"),
        ({"omega": 1.0}, "unknown parameter 'omega' (did you mean 'mesh_frequency'?); the parameters are mean_force"),
        ({"a": 0.1, "stiffness": RECTANGULAR()}, "give either stiffness or a, not both"),
    ],
)
def test_an_oscillator_out_of_range(changes, message):
    with pytest.raises(ValueError) as failure:
        BASELINE.replace(**changes)
    assert message in str(failure.value)


@pytest.mark.parametrize(
    "edges, levels, message",
    [
        ((0.1, 0.5), (1.0, 2.0), "edges[0] must be 0 (the start of the mesh period), got 0.1"),
        ((0.0, 0.5, 0.5), (1.0, 2.0, 1.0), "edges must increase strictly and stay below 1; got edges[1] = 0.5"),
        ((0.0, 0.6, 0.5), (1.0, 2.0, 1.0), "edges must increase strictly and stay below 1; got edges[1] = 0.6"),
        ((0.0, 1.0), (1.0, 2.0), "edges must increase strictly and stay below 1; got edges[1] = 1.0"),
        ((0.0,), (1.0, 2.0), "the same length, at least 1; got 1 edges and 2 levels"),
        ((), (), "the same length, at least 1; got 0 edges and 0 levels"),
        ((0.0,), (0.0,), "levels[0] must be a finite number above 0, got 0.0"),
        ((0.0, 0.5), (1.0, -1.0), "levels[1] must be a finite number above 0, got -1.0"),
        ((0.0, NAN), (1.0, 1.0), "edges[1] must be a finite number, got nan"),
        ((0.0,), ([1.0],), "levels must be a sequence of numbers (one dimension), got shape (1, 1)"),
    ],
)
def test_a_stiffness_wave_out_of_range(edges, levels, message):
    with pytest.raises(ValueError) as failure:
        gp.StiffnessWave(edges, levels)
    assert message in str(failure.value)


def test_an_unknown_reading():
    with pytest.raises(ValueError, match="reading must be one of 'printed', 'swapped', got 'mirrored'"):
        RECTANGULAR(reading="mirrored")


def test_a_wave_that_is_not_the_article_s_has_no_contact_ratio():
    osc = gp.Oscillator(stiffness=gp.StiffnessWave((0.0, 0.5), (1.0, 2.0)))
    with pytest.raises(ValueError, match="contact_ratio can be changed only where the stiffness wave is rectangular"):
        osc.replace(contact_ratio=1.5)


CALLS = {
    "x must be finite, got nan": lambda: gp.stroboscopic_map(BASELINE, NAN, 0.0),
    "v must be finite, got inf": lambda: gp.stroboscopic_map(BASELINE, 0.0, [0.0, INF]),
    "shapes that broadcast, got shapes (2,) and (3,)": lambda: gp.stroboscopic_map(BASELINE, [0.0] * 2, [0.0] * 3),
    "n must be a whole number of at least 0, got -1": lambda: gp.stroboscopic_map(BASELINE, 0.0, 0.0, -1),
    "n must be a whole number of at least 0, got 1.5": lambda: gp.stroboscopic_map(BASELINE, 0.0, 0.0, 1.5),
    "x and v must be single numbers, got shape (2,)": lambda: gp.trajectory(BASELINE, [0.0, 1.0], 0.0, 1),
    "n_periods must be a whole number of at least 1, got 0": lambda: gp.trajectory(BASELINE, 0.0, 0.0, 0),
    "n_transient must be a whole number of at least 0, got -3": lambda: gp.trajectory(
        BASELINE, 0.0, 0.0, 1, n_transient=-3
    ),
    "samples_per_period must be a whole number of at least 1, got 0": lambda: gp.trajectory(
        BASELINE, 0.0, 0.0, 1, samples_per_period=0
    ),
    "method must be one of 'RK23', 'RK45'": lambda: gp.methods.integrated_trajectory(
        BASELINE, 0.0, 0.0, 1, method="Euler"
    ),
    "rtol must be a finite number above 0, got 0.0": lambda: gp.methods.integrated_trajectory(
        BASELINE, 0.0, 0.0, 1, rtol=0.0
    ),
    "max_period must be a whole number of at least 1, got 0": lambda: gp.steady_state(BASELINE, max_period=0),
    "n_exponent must be a whole number of at least 1, got 2.0": lambda: gp.steady_state(BASELINE, n_exponent=2.0),
    "x must be finite, got -inf": lambda: gp.steady_state(BASELINE, -INF),
    "x and v must be single numbers, got shape (1,)": lambda: gp.steady_state(BASELINE, [1.0]),
    "unknown parameter 'speed'": lambda: gp.sweep(BASELINE, "speed", [1.0]),
    "values of mesh_frequency must be a non-empty sequence of numbers, got shape (0,)": lambda: gp.sweep(
        BASELINE, "mesh_frequency", []
    ),
    "values of mesh_frequency must be a non-empty sequence of numbers, got shape ()": lambda: gp.sweep(
        BASELINE, "mesh_frequency", 0.7
    ),
    "mesh_frequency must be a finite number above 0, got -0.7": lambda: gp.sweep(
        BASELINE, "mesh_frequency", [0.7, -0.7]
    ),
    "seeding must be one of 'carry', 'restart', got 'random'": lambda: gp.sweep(
        BASELINE, "mesh_frequency", [0.7], seeding="random"
    ),
    "single numbers, got shape (2,)": lambda: gp.sweep(BASELINE, "mesh_frequency", [0.7], x=[0.0, 1.0]),
    "axes must name at least one parameter and its values, got none": lambda: gp.parameter_map(BASELINE, {}),
    "contact_ratio must be a finite number above 1 and below 2, got 2.5": lambda: gp.parameter_map(
        BASELINE, {"contact_ratio": [1.5, 2.5]}
    ),
    "x must be a non-empty sequence of numbers, got shape ()": lambda: gp.basins(BASELINE, 0.0, [0.0]),
    "v must be a non-empty sequence of numbers, got shape (0,)": lambda: gp.basins(BASELINE, [0.0], []),
    "x_min must not exceed x_max, got x_min = 2.0 and x_max = 1.0": lambda: gp.impact_state(2.0, 1.0),
    "x_max must be a finite number, got nan": lambda: gp.impact_state(2.0, NAN),
    "n_kept must be at most n_periods + 1 = 3, got 4": lambda: gp.methods.runge_kutta_section(
        BASELINE, 0.0, 0.0, 2, n_kept=4
    ),
    "closeness must be a finite number above 0, got 0.0": lambda: gp.methods.runge_kutta_sweep(
        BASELINE, "mesh_frequency", [0.7], closeness=0.0
    ),
    "x and v must hold one start at least, got shape (0,)": lambda: gp.survival(BASELINE, [], 0.0),
    "n_periods must be a whole number of at least 1, got 0.5": lambda: gp.survival(BASELINE, 0.0, 0.0, n_periods=0.5),
    "discard must be a whole number of at least 0, got -1": lambda: gp.survival(BASELINE, 0.0, 0.0, discard=-1),
    "n_periods must be more than the 500 that are discarded, got 500": lambda: gp.survival(
        BASELINE, 0.0, 0.0, n_periods=500
    ),
    "confidence must be a finite number above 0 and below 1, got 1.0": lambda: gp.survival(
        BASELINE, 0.0, 0.0, confidence=1.0
    ),
    "unknown parameter 'rpm'": lambda: gp.ensembles.survival_along(BASELINE, "rpm", [1.0], 0.0, 0.0),
    "times must be a non-empty sequence of numbers, got shape (0,)": lambda: gp.ensembles.escape_rate([], 10),
    "times must be whole numbers of at least 0, got inf": lambda: gp.ensembles.escape_rate([INF], 10),
    "times must be whole numbers of at least 0, got 1.5": lambda: gp.ensembles.escape_rate([1.5], 10),
    "times must not exceed the periods watched, got 11 of 10": lambda: gp.ensembles.escape_rate([11, NAN], 10),
    "watched must be whole numbers of at least 0, got nan": lambda: gp.ensembles.escape_rate([1, NAN], [10, NAN]),
    "watched must be one number, or one for each of the 2 times, got shape (3,)": lambda: gp.ensembles.escape_rate(
        [1, NAN], [10] * 3
    ),
    "n must be a whole number of at least 0, got 2.5": lambda: gp.StiffnessWave((0.0,), (1.0,)).harmonics(2.5),
}


@pytest.mark.parametrize("message", CALLS)
def test_a_call_with_a_value_out_of_range(message):
    with pytest.raises(ValueError) as failure:
        CALLS[message]()
    assert message in str(failure.value)


SETTLING = "the options are n_transient, max_period, n_exponent, n_watch"
DIAGRAM = "the options are n_transient, n_samples, closeness"


@pytest.mark.parametrize(
    "call, allowed",
    [
        (lambda **how: gp.steady_state(BASELINE, **how), SETTLING),
        (lambda **how: gp.sweep(BASELINE, "mesh_frequency", [0.7], **how), SETTLING),
        (lambda **how: gp.ensembles.basin_stability(BASELINE, 1, **how), SETTLING),
        (lambda **how: gp.ensembles.continue_attractors(BASELINE, "mesh_frequency", [0.7], **how), SETTLING),
        (lambda **how: gp.basins(BASELINE, [1.0], [0.0], **how), SETTLING + ", most_work"),
        (lambda **how: gp.parameter_map(BASELINE, {"mesh_frequency": [0.7]}, **how), SETTLING + ", most_work"),
        (lambda **how: gp.methods.runge_kutta_sweep(BASELINE, "mesh_frequency", [0.7], **how), DIAGRAM),
        (lambda **how: gp.methods.plain_sweep(BASELINE, "mesh_frequency", [0.7], **how), DIAGRAM),
    ],
)
def test_an_option_misspelt_and_one_out_of_range(call, allowed):
    with pytest.raises(TypeError) as failure:
        call(n_transiet=5)
    assert str(failure.value) == f"unknown option n_transiet=5: {allowed}"
    with pytest.raises(ValueError, match="n_transient must be a whole number of at least 0, got -5"):
        call(n_transient=-5)


def test_numpy_scalars_are_numbers_too():
    osc = gp.Oscillator(mesh_frequency=np.float32(0.5), damping_ratio=np.int64(0))
    assert osc.mesh_frequency == 0.5
    assert isinstance(osc.damping_ratio, float)
    x, _v = gp.stroboscopic_map(osc, np.float32(0.5), 0, np.int64(2))
    assert np.isfinite(x)
