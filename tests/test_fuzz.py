"""Every public function, each argument wrong in turn: a sentence of ours, or a right call; nothing else comes out."""

import importlib
import inspect
import traceback
import warnings
from functools import cache

import numpy as np
import pytest
from matplotlib import pyplot as plt

import gearpair as gp
from tests.support import ROOT

ROOMS = ("motion", "ensembles", "bifurcations", "boundaries", "design", "methods", "teeth", "article", "plotting")
OSC = gp.Oscillator()
CRISIS = gp.Oscillator(mesh_frequency=1.219, damping_ratio=0.011)
QUICK = {"n_transient": 20, "n_exponent": 20, "n_watch": 20}
SPEEDS = [2000.0, 4000.0]
TEETH = {"pinion_torque_nm": 100.0, "backlash_um": 80.0, "transmission_error_um": 5.0, "damping_ratio": 0.1}


@cache
def made(name):
    """Good arguments, by the name of a parameter or of what it is."""
    drive = gp.GearDrive.from_pair(gp.SpurPair(), **TEETH)
    makers = {
        "branch": lambda: gp.continue_orbit(made("state"), "mesh_frequency", 0.7, 0.8),
        "chart": lambda: gp.design.speed_chart(drive, SPEEDS, n_starts=2, locate_jumps=False),
        "double": lambda: gp.steady_state(OSC, -2.3365, 1.5426),
        "boxes": lambda: gp.design.population(drive, {"backlash_um": (60.0, 100.0)}, SPEEDS, n=2),
        "drive": lambda: drive,
        "moving": lambda: drive.at_speed(2000.0).at_phase(0.0),
        "flip": lambda: made("branch").bifurcations[0],
        "loads": lambda: gp.design.load_map(drive, [50.0, 100.0], SPEEDS, n_starts=0, locate_jumps=False),
        "map": lambda: gp.parameter_map(
            OSC, {"damping_ratio": [0.1, 0.2], "mesh_frequency": [0.6, 0.7]}, measures=True
        ),
        "mesh": lambda: drive.mesh,
        "motion": lambda: gp.trajectory(OSC, 1.0, 0.0, 8),
        "pieces": lambda: gp.methods.segments(OSC, 1.5, 0.0),
        "plane": lambda: gp.basins(OSC, np.linspace(-2.0, 2.0, 40), [0.0, 0.5]),
        "rattle": lambda: gp.design.idle_rattle(
            drive, [800.0, 900.0], order=2.0, pinion_swing_deg=0.3, drag_torque_nm=0.2
        ),
        "state": lambda: gp.steady_state(OSC),
        "survival": lambda: gp.survival(OSC, [0.0, 1.0], 0.0, n_periods=1000),
        "sweep": lambda: gp.sweep(OSC, "mesh_frequency", [0.7, 0.74, 0.78]),
        "up": lambda: [made("state").__class__(**vars(made("state")))] * 2,
    }
    return makers[name]()


SWEEP = {"parameter": "mesh_frequency", "values": [1.6, 1.65]}
WATCH = {"x": [0.0, 1.0], "v": 0.0, "n_periods": 600}
ORBIT = {"parameter": "mesh_frequency", "lower": 0.69, "upper": 0.71}
SWING = {"order": 2.0, "pinion_swing_deg": 0.3, "drag_torque_nm": 0.2}
# By function: its good arguments, beside those that are the same everywhere.
CALLS = {
    "motion": {
        "energy_balance": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 2},
        "impact_measures": lambda: {"state": made("state")},
        "impact_state": lambda: {"x_min": 0.0, "x_max": 1.5},
        "lyapunov_exponents": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 5},
        "motions_of": lambda: {"result": made("sweep")},
        "multipliers_of": lambda: {"monodromy": np.eye(2)},
        "passage": lambda: {"oscillators": [OSC, OSC], "x": 1.0, "v": 0.0, "samples_per_period": 2},
        "periodic": lambda: {"period": 2},
        "spectrum": lambda: {"trajectory": made("motion")},
        "steady_state": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, **QUICK},
        "stroboscopic_map": lambda: {"osc": OSC, "x": [0.0, 1.0], "v": 0.0, "n": 2},
        "trajectory": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 2},
        "transient_periods": lambda: {"osc": OSC},
        "zero_one_test": lambda: {"values": np.sin(np.arange(200.0)), "n_frequencies": 3},
    },
    "ensembles": {
        "attractor_motions": lambda: {"result": made("plane")},
        "attractor_states": lambda: {"osc": OSC, "result": made("plane")},
        "attractors": lambda: {"osc": OSC, "n": 10, **QUICK},
        "basin_entropy": lambda: {"plane": [[0, 1], [1, 0]], "box": 2},
        "basin_stability": lambda: {"osc": OSC, "n": 10, **QUICK},
        "basins": lambda: {"osc": OSC, "x": [0.0, 1.0], "v": [0.0], **QUICK},
        "carried_sweeps": lambda: {"state": made("state"), "parameter": "mesh_frequency", "values": [0.7, 0.71]},
        "chaotic_saddle": lambda: {"osc": OSC, **WATCH, "n_after": 5},
        "continue_attractors": lambda: {"osc": OSC, **SWEEP, "n": 10, **QUICK},
        "decoded": lambda: {"result": made("plane")},
        "escape_rate": lambda: {"times": [3.0, 5.0], "watched": 10},
        "joined_ranges": lambda: {"ranges": gp.ensembles.motion_ranges(made("sweep"))},
        "motion_ranges": lambda: {"result": made("sweep")},
        "motion_shares": lambda: {"osc": OSC, **SWEEP, "x": [0.0], "v": [0.0], **QUICK},
        "motion_table": lambda: {"states": {"one": made("state")}, "parameter": "damping_ratio"},
        "parameter_map": lambda: {"osc": OSC, "axes": {"mesh_frequency": [1.6, 1.7]}, **QUICK},
        "range_of": lambda: {"state": made("state"), "parameter": "mesh_frequency", "values": [0.7, 0.71]},
        "survival": lambda: {"osc": OSC, **WATCH},
        "survival_along": lambda: {"osc": OSC, **SWEEP, **WATCH},
        "sweep": lambda: {"osc": OSC, **SWEEP, **QUICK},
        "uncertainty_exponent": lambda: {"plane": [[0] * 64 + [1] * 64] * 3},
    },
    "bifurcations": {
        "bifurcation_table": lambda: {"branches": [made("branch")]},
        "cascade_table": lambda: {"cascades": [[made("flip")]]},
        "coexistence": lambda: {"branches": [made("branch")], "lower": 0.7, "upper": 0.8},
        "coexistence_table": lambda: {"branches": [made("branch")], "lower": 0.7, "upper": 0.8, "shortest": 0.0},
        "continue_bifurcation": lambda: {
            "bifurcation": made("flip"),
            "bounds": {"mesh_frequency": (0.7, 0.8), "a": (0.115, 0.117)},
            "max_steps": 3,
        },
        "continue_orbit": lambda: {"orbit": made("state"), **ORBIT, "max_steps": 5},
        "doubled_orbit": lambda: {"bifurcation": made("flip")},
        "find_branches": lambda: {"osc": OSC, **ORBIT, "max_period": 1, "n_values": 1, "n_starts": 5},
        "find_orbits": lambda: {"osc": OSC, "max_period": 1, "n_starts": 10},
        "move_bifurcation": lambda: {"bifurcation": made("flip"), "osc": OSC},
        "periodic_orbit": lambda: {"osc": OSC, "x": 0.34, "v": -0.25, "period": 2},
        "stable_ranges": lambda: {"branches": [made("branch")]},
    },
    "boundaries": {
        "at_phase": lambda: {"osc": OSC, "phase": 0.5},
        "backward_map": lambda: {"osc": OSC, "x": [0.0, 1.0], "v": 0.0, "n": 2},
        "critical_dip": lambda: {"osc": OSC, "state": made("double"), "n_phases": 1, **QUICK},
        "critical_shock": lambda: {"osc": OSC, "state": made("double"), "n_phases": 1, "n_directions": 4, **QUICK},
        "edge_state": lambda: {"osc": OSC, "a": [-2.3365, 1.5426], "b": made("state"), "n_periods": 20},
        "homoclinic_tangency": lambda: {
            "orbit": gp.periodic_orbit(CRISIS, -0.29164, -1.2262, 2),
            **{"parameter": "damping_ratio", "lower": 0.0105, "upper": 0.0115, "spacing": 0.1, "length": 10.0},
        },
        "manifolds": lambda: {"orbit": gp.periodic_orbit(OSC, -1.5688, -1.0135, 1), "length": 1.0, "spacing": 0.1},
    },
    "design": {
        "duty_cycle": lambda: {"found": made("loads"), "points": [(60.0, 3000.0, 1.0)]},
        "helps_most": lambda: {"found": made("boxes")},
        "find_jumps": lambda: {"up": made("up"), "down": made("up")},
        "how_many_moments": lambda: {"where": [True, False]},
        "identify": lambda: {
            "drive": made("drive").at_phase(0.3),
            "jump_up_rpm": 8598.0,
            "jump_down_rpm": 6500.0,
            "damping_ratios": (0.19, 0.2),
            "errors_um": (1e-3, 2e-3),
        },
        "idle_oscillator": lambda: {"drive": made("drive"), "speed_rpm": 800.0, **SWING},
        "idle_rattle": lambda: {"drive": made("drive"), "speeds_rpm": [800.0, 900.0], **SWING},
        "iso_dynamic_factor": lambda: {
            "drive": made("drive"),
            "speeds_rpm": SPEEDS,
            "base_pitch_um": 8.0,
            "profile_um": 8.0,
        },
        "linear_response": lambda: {"osc": OSC},
        "load_change": lambda: {"drive": made("moving"), "torque_nm": [(0.0, 50.0), (0.01, 100.0)], "seconds": 0.01},
        "load_change_moments": lambda: {
            "drive": made("moving"),
            "torque_nm": [(0.0, 50.0), (0.01, 100.0)],
            "seconds": 0.01,
            "n_moments": 2,
        },
        "load_map": lambda: {
            "drive": made("drive"),
            "torques_nm": [50.0, 100.0],
            "speeds_rpm": SPEEDS,
            "n_starts": 1,
            "n_transient": 20,
        },
        "measure_motion": lambda: {"drive": made("drive"), "state": made("state")},
        "run_up": lambda: {"drive": made("moving"), "from_rpm": 2000.0, "to_rpm": 3000.0, "seconds": 0.01},
        "schedule": lambda: {"drive": made("moving"), "seconds": 0.01, "speed_rpm": [(0.0, 2000.0), (0.01, 3000.0)]},
        "sensitivity": lambda: {"drive": made("drive"), "speeds_rpm": SPEEDS, "ranges": {"damping_ratio": (0.1, 0.2)}},
        "shock_margin": lambda: {"drive": made("moving"), "speeds_rpm": SPEEDS, "n_phases": 1, "n_starts": 1},
        "sound": lambda: {"drive": made("drive"), "motion": made("state"), "seconds": 0.2, "rate": 4000},
        "population": lambda: {
            "drive": made("drive"),
            "spread": {"backlash_um": (60.0, 100.0)},
            "speeds_rpm": SPEEDS,
            "n": 2,
        },
        "speed_chart": lambda: {"drive": made("drive"), "speeds_rpm": SPEEDS, "n_starts": 1, "n_transient": 20},
        "speed_range_table": lambda: {"ranges": gp.design.speeds_to_avoid(made("chart"))},
        "speeds_to_avoid": lambda: {"chart": made("chart")},
    },
    "methods": {
        "certificate_examples": lambda: {"pieces": made("pieces")},
        "certificate_table": lambda: {"pieces": made("pieces")},
        "coarse_share": lambda: {"where": [True, False]},
        "impact_time_error": lambda: {"impacts": made("motion").impacts, "reference": made("motion").impacts},
        "integrated_trajectory": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 1},
        "plain_sweep": lambda: {"osc": OSC, **SWEEP, "n_transient": 2, "n_samples": 4},
        "runge_kutta_section": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 2},
        "runge_kutta_sweep": lambda: {"osc": OSC, **SWEEP, "n_transient": 2, "n_samples": 4},
        "section_period": lambda: {"points": [[1.0, 0.0], [2.0, 0.0]] * 2},
        "segments": lambda: {"osc": OSC, "x": 1.5, "v": 0.0},
        "split_levels": lambda: {"osc": OSC},
    },
    "teeth": {
        "error_harmonics": lambda: {"error_um": np.sin(np.arange(16.0)), "n": 2},
        "error_orders": lambda: {"error_um": np.sin(np.arange(16.0)), "teeth": 4},
        "full_contact_force": lambda: {"mesh": made("mesh"), "deviation_um": np.zeros_like(made("mesh").path)},
        "iso_stiffness": lambda: {"pair": gp.SpurPair()},
        "loaded_mesh": lambda: {"mesh": made("mesh"), "deviation_um": made("mesh").path, "force_n": 100.0},
        "mesh_stiffness": lambda: {"pair": gp.SpurPair(), "n_phases": 10},
        "pair_deviations": lambda: {"mesh": made("mesh"), "deviation_um": np.zeros_like(made("mesh").path)},
        "profile_error": lambda: {"mesh": made("mesh"), "deviation_um": np.zeros_like(made("mesh").path)},
        "tip_relief": lambda: {"mesh": made("mesh"), "pinion_um": 20.0, "gear_um": 20.0, "length": 0.4},
    },
    "plotting": {
        "attractor_shares": lambda: {"result": gp.ensembles.continue_attractors(OSC, **SWEEP, n=10, **QUICK)},
        "basins": lambda: {"result": made("plane")},
        "bifurcation_diagram": lambda: {"sweep": made("sweep")},
        "branches": lambda: {"found": [made("branch")]},
        "dynamic_factors": lambda: {"chart": made("chart")},
        "exponents": lambda: {"sweep": made("sweep")},
        "extremes": lambda: {"sweep": made("sweep")},
        "finite_exponents": lambda: {"result": made("plane")},
        "gallery": lambda: {"states": {"one": made("state")}},
        "harmonics": lambda: {"wave": OSC.stiffness, "n": 2},
        "impact_map": lambda: {"result": made("map")},
        "impact_states": lambda: {"result": made("plane")},
        "load_map": lambda: {"found": made("loads")},
        "mesh_curves": lambda: {"meshes": {"one": made("mesh")}},
        "period_map": lambda: {"result": made("map")},
        "phase_portrait": lambda: {"motion": made("motion")},
        "poincare_section": lambda: {"motion": made("motion")},
        "quantity_map": lambda: {"result": made("map"), "quantity": "load_factor"},
        "rattle": lambda: {"found": made("rattle")},
        "spectrum": lambda: {"lines": gp.spectrum(made("motion"))},
        "stiffness_wave": lambda: {"wave": OSC.stiffness},
        "survival_curve": lambda: {"result": made("survival")},
        "time_history": lambda: {"motion": made("motion")},
    },
}
WRONG = {
    "None": None,
    "a text": "1.0",
    "nan": float("nan"),
    "inf": float("inf"),
    "minus one": -1,
    "zero": 0,
    "a half": 0.5,
    "a truth value": True,
    "complex": 1 + 1j,
    "a date": np.datetime64("2024-01-01"),
    "masked": np.ma.masked_array([1.0, 2.0], [False, True]),
    "empty": [],
    "nested": [[1.0], [2.0, 3.0]],
    "texts": ["a", "b"],
    "nan among numbers": [1.0, float("nan")],
    "a mapping": {"a": 1},
    "an object": object(),
    "a class": gp.Oscillator,
    "an oscillator": OSC,
    "a wave": OSC.stiffness,
    "a pair": gp.SpurPair(),
}
# Which have a place of their own in the tests, and what matplotlib itself says of colours and lines.
SKIPPED = ("store", "client", "ax", "axes", "colour", "colours", "linestyle")
RIGHT = (ValueError, TypeError, RuntimeError)


def own_sentence(error):
    """Whether an error was raised by a line of the library, and says something in a line."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    text = str(error)
    ours = last.filename.startswith(str(ROOT / "gearpair")) and (last.line or "").startswith("raise ")
    return isinstance(error, RIGHT) and ours and " " in text and "\n" not in text and len(text) < 1000


def surprises(function, good):
    """What else than a sentence or a call without a warning came of a wrong argument."""
    found = []
    names = [name for name in inspect.signature(function).parameters if name not in SKIPPED]
    for name in {**dict.fromkeys(names), **good}:
        for what, wrong in WRONG.items():
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    function(**{**good, name: wrong})
            except Exception as error:
                if not own_sentence(error):
                    found.append(f"{name} = {what}: {type(error).__name__}: {str(error)[:150]}")
            finally:
                plt.close("all")
    return found


LONG = {"identify", "critical_shock", "homoclinic_tangency"}  # a call takes a second, and a test some twenty calls
ASKED = [
    pytest.param(room, name, marks=[pytest.mark.slow] * (name in LONG), id=f"{room}-{name}")
    for room, own in CALLS.items()
    for name in own
]


@pytest.mark.parametrize(("room", "name"), ASKED)
def test_a_wrong_argument_gets_a_sentence(room, name):
    function, good = getattr(importlib.import_module(f"gearpair.{room}"), name), CALLS[room][name]()
    function(**good)
    keywords = {each.name for each in inspect.signature(function).parameters.values() if each.kind is each.VAR_KEYWORD}
    assert [text for text in surprises(function, good) if text.split(" ")[0] not in keywords] == []


def public_functions():
    """Each with the name of its room."""
    for room in ROOMS:
        module = importlib.import_module(f"gearpair.{room}")
        for name in module.__all__:
            if inspect.isfunction(getattr(module, name)):
                yield room, name


@pytest.mark.parametrize(("room", "name"), list(public_functions()))
def test_a_wrong_object_in_the_first_place_gets_a_sentence(room, name):
    """Of every public function, also of those that no good call stands for above."""
    function = getattr(importlib.import_module(f"gearpair.{room}"), name)
    parameters = inspect.signature(function).parameters.values()
    needed = [
        each.name for each in parameters if each.default is each.empty and each.kind is each.POSITIONAL_OR_KEYWORD
    ]
    for what in ("an object", "a class") if needed else ():
        with pytest.raises(RIGHT) as failure:
            function(**dict.fromkeys(needed, WRONG[what]))
        assert own_sentence(failure.value), (what, str(failure.value))


def test_every_public_function_is_checked():
    for room, name in public_functions():
        function = getattr(importlib.import_module(f"gearpair.{room}"), name)
        assert hasattr(function, "__wrapped__"), f"{room}.{name} lacks @checked"
