"""Bad input gets one sentence, at once: the name, the value, what is allowed."""

import dataclasses
import inspect
from decimal import Decimal

import numpy as np
import pytest
import xarray as xr

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


DRIVE = gp.GearDrive.from_pair(
    gp.SpurPair(), pinion_torque_nm=100.0, backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.1
)
WAVE = BASELINE.stiffness
ISO = dict(base_pitch_um=8.0, profile_um=8.0)
VALUES = {
    "speeds_rpm must be finite, got nan": lambda: gp.design.iso_dynamic_factor(DRIVE, [1000.0, NAN], **ISO),
    "speeds_rpm must be a finite number at least 0, got -5.0": lambda: gp.design.iso_dynamic_factor(
        DRIVE, [1.0, -5.0], **ISO
    ),
    "x must be real numbers, got '1.0'": lambda: gp.stroboscopic_map(BASELINE, "1.0", 0.0),
    "v must be real numbers, got '0'": lambda: gp.basins(BASELINE, [0.0], ["0"]),
    "x must be real numbers, got datetime.date(2024, 1, 1)": lambda: gp.stroboscopic_map(
        BASELINE, np.datetime64("2024-01-01"), 0.0
    ),
    "x must be real numbers, got (1+1j)": lambda: gp.stroboscopic_map(BASELINE, [1 + 1j], 0.0),
    "x must be real numbers, got True": lambda: gp.stroboscopic_map(BASELINE, [True], 0.0),
    "x must be real numbers, got None": lambda: gp.steady_state(BASELINE, None),
    "x must be numbers, got masked ones among them": lambda: gp.stroboscopic_map(
        BASELINE, np.ma.masked_array([1.0, 2.0], [False, True]), 0.0
    ),
    "fraction must be finite, got nan": lambda: WAVE(NAN),
    "fraction must be real numbers, got None": lambda: WAVE(None),
    "shortest must be a finite number, got nan": lambda: gp.bifurcations.stable_ranges([BRANCH], shortest=NAN),
    "levels must be numbers, got masked ones among them": lambda: gp.StiffnessWave(
        [0.0, 0.5], np.ma.masked_array([1.0, 2.0], [False, True])
    ),
    "osc must be damped alike in contact and in flight": lambda: DRIVE.with_oscillator(
        BASELINE.replace(flight_damping=0.0)
    ),
    "x must be two finite numbers in rising order, got -1": lambda: gp.find_orbits(BASELINE, 1, x=-1),
    "v must be two finite numbers in rising order, got (1.0, 0.0)": lambda: gp.find_orbits(BASELINE, 1, v=(1.0, 0.0)),
    "x_reach must be two finite numbers in rising order, got 3": lambda: gp.ensembles.basin_stability(
        BASELINE, x_reach=3
    ),
    "seed must be a whole number of at least 0, got -1": lambda: gp.ensembles.basin_stability(BASELINE, seed=-1),
    "plane must be finite, got nan": lambda: gp.ensembles.basin_entropy(np.full((5, 5), NAN)),
    "plane must hold whole numbers": lambda: gp.ensembles.basin_entropy(np.full((5, 5), 0.5)),
    "period must be a whole number of at least 1, got -1": lambda: gp.motion.periodic(-1),
    "where must hold truth values, one at least, got []": lambda: gp.methods.coarse_share([]),
    "harmonics must be a sequence of (order, amplitude, phase), got None": lambda: BASELINE.replace(harmonics=None),
    "mesh_frequency must be a finite number above 0, got np.timedelta64(1)": lambda: BASELINE.replace(
        mesh_frequency=np.timedelta64(1)
    ),
    "largest_x must be a finite number above 0, got 0.0": lambda: gp.continue_orbit(
        gp.steady_state(BASELINE), "mesh_frequency", 0.6, 0.8, largest_x=0.0
    ),
    "orbit must be periodic, got a motion of status 'aperiodic'": lambda: gp.continue_orbit(
        gp.steady_state(gp.Oscillator(mesh_frequency=1.219), n_watch=0), "mesh_frequency", 1.2, 1.3
    ),
    "result must be one of this oscillator": lambda: gp.ensembles.attractor_states(
        BASELINE.replace(damping_ratio=0.1), gp.basins(BASELINE, [0.0], [0.0])
    ),
    "result must be a dataset whose attributes name its oscillator, got 3": lambda: gp.Oscillator.from_attrs(3),
    "needs a dataset that holds 'attractor_status', got one that holds status, period,": lambda: gp.plotting.basins(
        SWEPT
    ),
    "needs a dataset that holds 'rpm', got one that holds status, period,": lambda: gp.plotting.quantity_map(
        SWEPT, "rpm"
    ),
}
SWEPT = gp.sweep(BASELINE, "mesh_frequency", [0.7])


@pytest.mark.parametrize("message", VALUES)
def test_a_value_that_is_none(message):
    with pytest.raises(ValueError) as failure:
        VALUES[message]()
    assert message in str(failure.value)


@pytest.mark.parametrize("window", [NAN, 3.0, "no such window", None])
def test_a_window_that_is_none(window):
    motion = gp.trajectory(BASELINE, 1.0, 0.0, 2)
    with pytest.raises(ValueError, match=r"window must be one of scipy.signal.get_window, as 'boxcar', got"):
        gp.spectrum(motion, window=window)
    assert gp.spectrum(motion, window=("kaiser", 8.0)) != gp.spectrum(motion)


CLASSES = {
    "osc must be an Oscillator, got a GearDrive: hand over its oscillator()": lambda: gp.steady_state(DRIVE),
    "osc must be an Oscillator, got a SteadyState: hand over its oscillator": lambda: gp.find_orbits(STATE, 1),
    "osc must be an Oscillator; got None": lambda: gp.basins(None, [0.0], [0.0]),
    "trajectory must be a Trajectory, as gearpair.trajectory gives it; got array([0., 0.])": lambda: gp.spectrum(
        np.zeros(2)
    ),
    "bifurcation must be a Bifurcation, got a Branch: hand over one of its bifurcations": lambda: (
        gp.continue_bifurcation(BRANCH, {})
    ),
    "drive must be a GearDrive, as GearDrive.from_pair gives it; got an Oscillator": lambda: gp.design.speed_chart(
        BASELINE, [1.0, 2.0]
    ),
    "axes must be a mapping, as {name: ...}, got [1.0]": lambda: gp.parameter_map(BASELINE, axes=[1.0]),
    "parameter must be a text, got 3": lambda: gp.sweep(BASELINE, 3, [1.0]),
    "progress must be True or False, got 'no'": lambda: gp.basins(BASELINE, [0.0], [0.0], progress="no"),
    "sweeps must be a Dataset, as gearpair.sweep, parameter_map, basins and the like give it; got": lambda: (
        gp.ensembles.found_ranges(SWEPT, BASELINE)
    ),
    "gear must be a SpurGear, as the pinion of a SpurPair; got None": lambda: gp.teeth.ToothProfile(None),
    "states['a'] must be a SteadyState, got an Oscillator: hand over gearpair.steady_state of it": lambda: (
        gp.plotting.gallery({"a": BASELINE})
    ),
    "found[0] must be a Branch, as gearpair.continue_orbit gives it; got an Oscillator": lambda: gp.plotting.branches(
        [BASELINE]
    ),
    "mesh must be a MeshStiffness, got a SpurPair: hand over gearpair.mesh_stiffness of it": lambda: (
        dataclasses.replace(DRIVE, mesh=gp.SpurPair())
    ),
    "path must be a path, or a file open for writing bytes, got True": lambda: gp.design.write_wav(
        True,  # which scipy takes for the standard output
        gp.design.Sound(np.zeros(10), 8000, 1.0),
    ),
    "ax must be an Axes; got 3": lambda: gp.plotting.stiffness_wave(WAVE, 3),
}
STATE = gp.steady_state(BASELINE)
BRANCH = gp.continue_orbit(STATE, "mesh_frequency", 0.69, 0.71)


@pytest.mark.parametrize("message", CLASSES)
def test_an_object_of_a_wrong_class(message):
    with pytest.raises(TypeError) as failure:
        CLASSES[message]()
    assert message in str(failure.value)


def test_every_plot_says_what_it_is_handed_by_mistake():
    """A number in place of the result: one sentence that begins with the parameter's name."""
    plots = [getattr(gp.plotting, name) for name in gp.plotting.__all__]
    asked = 0
    for plot in filter(inspect.isfunction, plots):
        names = list(inspect.signature(plot).parameters)
        if names[0] in ("segment", "ratios", "ax"):  # that have a default, or are numbers
            continue
        with pytest.raises(TypeError, match=rf"^{names[0]} must be .* got (3|a float)") as failure:
            plot(3.0, *[3.0] * (names[1:2] == ["n"]))
        assert "\n" not in str(failure.value)
        asked += 1
    assert asked > 40


def test_decimals_and_single_numbers_of_arrays_and_datasets_are_numbers():
    assert BASELINE.replace(mesh_frequency=Decimal("0.7")) == BASELINE
    assert BASELINE.replace(mesh_frequency=np.array(0.7)) == BASELINE
    assert BASELINE.replace(mesh_frequency=SWEPT.mesh_frequency[0]) == BASELINE
    assert gp.stroboscopic_map(BASELINE, [Decimal("0.5")], 0) == gp.stroboscopic_map(BASELINE, [0.5], 0)
    assert gp.stroboscopic_map(BASELINE, np.ma.masked_array([0.5], [False]), 0) == gp.stroboscopic_map(
        BASELINE, [0.5], 0
    )


def test_starts_with_named_dimensions_are_crossed_by_their_names():
    x, v = xr.DataArray([0.0, 1.0, 2.0], dims="x"), xr.DataArray([0.0, 0.5, 1.0], dims="v")
    crossed = gp.stroboscopic_map(BASELINE, x, v)
    np.testing.assert_array_equal(crossed, gp.stroboscopic_map(BASELINE, x.values[:, None], v.values))
    assert crossed[0].shape == (3, 3)
    assert gp.survival(BASELINE, x, v, n_periods=1000).sizes["start"] == 9


def test_what_is_plain_is_accepted():
    assert len(gp.plotting.poincare_section(STATE).lines[0].get_xdata()) == 2
    orbit = gp.periodic_orbit(BASELINE, 0.34, -0.25, 2)
    assert gp.plotting.poincare_section(orbit).lines[0].get_xdata().tolist() == orbit.points[:, 0].tolist()
    np.testing.assert_allclose(gp.continue_orbit(orbit, "mesh_frequency", 0.69, 0.71).values, BRANCH.values, rtol=1e-12)


def test_a_large_attractor_is_followed_from_where_it_is():
    """Period 1 at 0.9, which a tenth of the starts reach: X from -35 to 31, beyond 20 static positions."""
    state = gp.steady_state(gp.Oscillator(mesh_frequency=0.9), -27.99, 16.13)
    assert state.period == 1 and state.x_min < -35.0
    branch = gp.continue_orbit(state, "mesh_frequency", 0.899, 0.901)
    assert [str(end) for end in branch.ends] == ["bound", "bound"]
    narrow, wide = (gp.continue_orbit(state, "mesh_frequency", 0.88, 0.92, largest_x=n) for n in (1.0, 200.0))
    assert [str(end) for end in narrow.ends] == ["bound", "too_large"]
    assert str(wide.ends[1]) == "max_steps"
    twice = -2.0 * state.x_min
    assert twice < -narrow.x_min.min() < twice + 1.0 < -wide.x_min.min()


def test_methods_too_say_what_they_are_handed_by_mistake():
    with pytest.raises(TypeError, match="pair must be a SpurPair, got a MeshStiffness: hand over its pair"):
        gp.GearDrive.from_pair(
            DRIVE.mesh, pinion_torque_nm=1.0, backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.1
        )
    with pytest.raises(TypeError, match="name must be a text, got 3"):
        BASELINE.parameter(3)
