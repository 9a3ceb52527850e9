"""Results that hold arrays are equal when what they hold is."""

import dataclasses

import numpy as np
import pytest
import xarray as xr

import gearpair as gp
from gearpair.design import iso_dynamic_factor

OSC = gp.Oscillator(mesh_frequency=1.6)
PAIR = dict(
    pinion_torque_nm=100.0, pinion_speed_rpm=3000.0, backlash_um=80.0, transmission_error_um=5.0, damping_ratio=0.1
)


def iso():
    drive = gp.GearDrive.from_pair(gp.SpurPair(), **PAIR)
    return iso_dynamic_factor(drive, [1000.0, 2000.0], base_pitch_um=8.0, profile_um=6.0)


@pytest.mark.parametrize(
    ("make", "changed"),
    [
        (lambda: gp.steady_state(OSC), lambda state: {"points": state.points + 1e-12}),
        (lambda: gp.steady_state(gp.Oscillator(mesh_frequency=1.219), n_exponent=100), lambda state: {"x_min": 0.0}),
        (lambda: gp.periodic_orbit(OSC, 0.8, -0.1, 1), lambda orbit: {"period": 2}),
        (lambda: gp.trajectory(OSC, 1.0, 0.0, 5), lambda motion: {"x": motion.x[:-1]}),
        (iso, lambda factor: {"k_v": np.full(2, np.nan)}),
        (lambda: gp.mesh_stiffness(gp.SpurPair()), lambda mesh: {"phase": mesh.phase + 1e-12}),
        (lambda: gp.methods.segments(OSC, 1.5, 0.0)[0], lambda segment: {"series": 2.0 * segment.series}),
        (lambda: gp.methods.segments(OSC, 1.5, 0.0)[0], lambda segment: {"span": 0.5}),
        (
            lambda: gp.article.sweep_waves(OSC, {"own": OSC.stiffness}, [1.6])["own"],
            lambda swept: {"up": swept.up[["x"]]},
        ),
        (lambda: gp.motion.impact_measures(gp.steady_state(OSC)), lambda measures: {"drive_share": 0.0}),
        (lambda: gp.ensembles.escape_rate([3], 10), lambda rate: {"escapes": 0}),
        (
            lambda: gp.continue_orbit(gp.steady_state(gp.Oscillator()), "mesh_frequency", 0.69, 0.71),
            lambda branch: {"bifurcations": [1]},
        ),
        (lambda: gp.spectrum(gp.trajectory(OSC, 1.0, 0.0, 2)), lambda lines: {"amplitude": 2.0 * lines.amplitude}),
        (
            lambda: next(iter(gp.teeth.finite_element_bodies().values())),
            lambda body: {"positions": np.zeros(2)},
        ),
    ],
)
def test_two_results_are_equal_when_all_that_they_hold_is(make, changed):
    one, other = make(), make()
    assert one == other
    assert one != dataclasses.replace(one, **changed(one))
    assert one != "something else"
    assert len({one, other}) == 1 and one in [other]


def test_nan_is_equal_to_nan():
    state = gp.steady_state(gp.Oscillator(mesh_frequency=1.219), n_exponent=100)
    assert np.isnan(state.multipliers).all()
    assert dataclasses.replace(state, x_max=np.nan) == dataclasses.replace(state, x_max=float("nan"))


def test_orbits_are_found_among_orbits():
    orbits = gp.find_orbits(OSC, 2, n_starts=50)
    assert orbits[-1] in gp.find_orbits(OSC, 2, n_starts=50)
    assert len({*orbits, *orbits}) == len(orbits) > 1


def test_a_number_is_no_array():
    lines = gp.motion.Spectrum(np.zeros(2), np.zeros(2))
    assert lines != dataclasses.replace(lines, amplitude=0.0)


def test_zero_of_either_sign_has_one_hash():
    one, other = (gp.motion.Spectrum(np.array([zero]), np.array([zero])) for zero in (0.0, -0.0))
    assert one == other and hash(one) == hash(other)


LINES = {
    "steady_state": (lambda: gp.steady_state(OSC), "points=<float64 (256, 2) from "),
    "trajectory": (lambda: gp.trajectory(OSC, 1.0, 0.0, 300), "x=<float64 (38401,) from "),
    "mesh_stiffness": (lambda: gp.mesh_stiffness(gp.SpurPair()), "load_share=<float64 (2, 1000) from 0 to 1>"),
    "loaded mesh": (
        lambda: gp.teeth.loaded_mesh(mesh := gp.mesh_stiffness(gp.SpurPair()), 0.0 * mesh.path, 100.0),
        "approach_um=<float64 (1000,) from ",
    ),
    "finite elements": (lambda: next(iter(gp.teeth.finite_element_bodies().values())), "FiniteElementBody("),
    "spectrum": (lambda: gp.spectrum(gp.trajectory(OSC, 1.0, 0.0, 300)), "frequency=<float64 (19201,) from 0 to 64>"),
    "waves": (lambda: gp.article.sweep_waves(OSC, {"own": OSC.stiffness}, [1.6])["own"], "up=Dataset of status, "),
    "branch": (
        lambda: gp.continue_orbit(gp.steady_state(gp.Oscillator()), "mesh_frequency", 0.69, 0.71),
        "orbits of period 2",
    ),
    "iso": (iso, "k_v=["),
    "chaos": (lambda: gp.steady_state(gp.Oscillator(mesh_frequency=1.219), n_watch=0), "status='aperiodic'"),
}


@pytest.mark.parametrize("name", LINES)
def test_a_result_is_one_line_with_shapes_and_ranges(name):
    make, part = LINES[name]
    text = repr(make())
    assert "\n" not in text and len(text) < 900
    assert part in text


@pytest.mark.parametrize(
    "osc",
    [
        gp.Oscillator(),
        gp.Oscillator(mean_force=-0.1, harmonics=[(2, 0.05, -1.0), (3, 1e-9, 0.5)]),
        gp.Oscillator(stiffness=gp.StiffnessWave((0.0, 0.25, 0.5), (1.0, 2.0, 1.5))),
        gp.Oscillator(stiffness=gp.StiffnessWave.rectangular(1.5, reading="swapped")),
    ],
    ids=["baseline", "harmonics", "levels", "swapped"],
)
def test_a_dataset_tells_its_oscillator(osc, tmp_path):
    """Also one read back from a file, and with the reading of its wave."""
    gp.sweep(osc, "mesh_frequency", [1.6]).to_netcdf(tmp_path / "sweep.nc", engine="scipy")
    with xr.open_dataset(tmp_path / "sweep.nc") as result:
        found = gp.Oscillator.from_attrs(result)
    assert found == osc
    assert found.stiffness.rectangle == osc.stiffness.rectangle


@pytest.mark.parametrize(
    "text", ["print('no')", "Oscillator(mesh_frequency=__import__('os'))", "1", "Oscillator(", "a.b"]
)
def test_an_attribute_that_is_no_oscillator_is_not_run(text, capsys):
    with pytest.raises((ValueError, TypeError), match="the attribute 'oscillator' must be"):
        gp.Oscillator.from_attrs(xr.Dataset(attrs={"oscillator": text}))
    assert capsys.readouterr().out == ""


def test_the_library_lists_what_is_imported_when_it_is_used():
    assert "plotting" in dir(gp) and set(gp.__all__) <= set(dir(gp))
