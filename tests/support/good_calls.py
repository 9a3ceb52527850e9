"""Good arguments of every public function, by its room and its name: what the fuzz spoils one at a time."""

from functools import cache

import numpy as np

import gearpair as gp
from gearpair.article import published

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
        "drawn": lambda: gp.methods.plain_sweep(OSC, "mesh_frequency", [0.7, 0.74, 0.78], n_transient=2, n_samples=4),
        "fold": lambda: next(
            each
            for each in gp.continue_orbit(
                gp.steady_state(OSC.replace(damping_ratio=0.1)), "mesh_frequency", 0.4, 0.9
            ).bifurcations
            if each.kind == "fold"
        ),
        "found": lambda: gp.attractors(OSC, 10, **QUICK),
        "heard": lambda: gp.design.sound(drive, made("state"), 0.2, rate=4000),
        "precision": lambda: gp.methods.work_precision(OSC, 1.0, 0.0, n_starts=1, tolerances=[1e-6]),
        "ranges": lambda: gp.ensembles.motion_ranges(made("sweep")),
        "row": lambda: gp.teeth.finite_element_bodies()["34 in a row"],
        "waves": lambda: gp.article.sweep_waves(OSC, {"own": OSC.stiffness}, [1.6])["own"],
        "up": lambda: [made("state").__class__(**vars(made("state")))] * 2,
    }
    return makers[name]()


SWEEP = {"parameter": "mesh_frequency", "values": [1.6, 1.65]}
WATCH = {"x": [0.0, 1.0], "v": 0.0, "n_periods": 600}
ORBIT = {"parameter": "mesh_frequency", "lower": 0.69, "upper": 0.71}
SWING = {"order": 2.0, "pinion_swing_deg": 0.3, "drag_torque_nm": 0.2}
# By function: its good arguments; or, where one has no name, a function that gives it one, too.
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
        "found_ranges": lambda: (
            lambda sweep, narrowest=0.0: gp.ensembles.found_ranges(sweep, narrowest=narrowest),
            {"sweep": made("sweep")},
        ),
        "joined_ranges": lambda: {"ranges": gp.ensembles.motion_ranges(made("sweep"))},
        "motion_ranges": lambda: {"result": made("sweep")},
        "motion_shares": lambda: {"osc": OSC, **SWEEP, "x": [0.0], "v": [0.0], **QUICK},
        "motion_table": lambda: {"states": {"one": made("state")}, "parameter": "damping_ratio"},
        "parameter_map": lambda: {"osc": OSC, "axes": {"mesh_frequency": [1.6, 1.7]}, **QUICK},
        "range_of": lambda: {"state": made("state"), "parameter": "mesh_frequency", "values": [0.7, 0.71]},
        "representatives": lambda: (
            lambda osc, sweep, motions=None, near=None: gp.ensembles.representatives(
                osc, sweep, motions=motions, near=near
            ),
            {"osc": OSC, "sweep": made("sweep")},
        ),
        "survival": lambda: {"osc": OSC, **WATCH},
        "survival_along": lambda: {"osc": OSC, **SWEEP, **WATCH},
        "sweep": lambda: {"osc": OSC, **SWEEP, **QUICK},
        "uncertainty_exponent": lambda: {"plane": [[0] * 64 + [1] * 64] * 3},
    },
    "bifurcations": {
        "bifurcation_table": lambda: {"branches": [made("branch")]},
        "cascade_table": lambda: {"cascades": [[made("flip")]]},
        "doubling_cascade": lambda: {"flip": made("flip"), "levels": 1},
        "fold_shift": lambda: {"fold": made("fold"), "low": OSC, "high": OSC.replace(a=0.1165)},
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
        "Player": lambda: {"heard": made("heard"), "caption": "one", "told": "two"},
        "chart_speeds": lambda: {"drive": made("drive"), "n_speeds": 3, "service_rpm": (1000.0, 2000.0)},
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
        "verdict": lambda: {"chart": made("chart")},
        "write_wav": lambda: {"path": "one.wav", "heard": made("heard")},
    },
    "methods": {
        "certificate_examples": lambda: {"pieces": made("pieces")},
        "certificate_table": lambda: {"pieces": made("pieces")},
        "coarse_share": lambda: {"where": [True, False]},
        "disorder_table": lambda: {"exact": made("sweep"), "drawn": {"one": made("drawn")}},
        "disorder_told": lambda: {"exact": made("sweep"), "drawn": made("drawn"), "control": made("drawn")},
        "impact_time_error": lambda: {"impacts": made("motion").impacts, "reference": made("motion").impacts},
        "integrated_trajectory": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 1},
        "loosest_told": lambda: {"measured": made("precision")},
        "numerical_chaos": lambda: {"exact": made("sweep"), "drawn": made("drawn")},
        "plain_sweep": lambda: {"osc": OSC, **SWEEP, "n_transient": 2, "n_samples": 4},
        "runge_kutta_section": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_periods": 2},
        "runge_kutta_sweep": lambda: {"osc": OSC, **SWEEP, "n_transient": 2, "n_samples": 4},
        "section_period": lambda: {"points": [[1.0, 0.0], [2.0, 0.0]] * 2},
        "segments": lambda: {"osc": OSC, "x": 1.5, "v": 0.0},
        "series_table": lambda: {"osc": OSC},
        "split_levels": lambda: {"osc": OSC},
        "work_precision": lambda: {"osc": OSC, "x": 1.0, "v": 0.0, "n_starts": 1, "tolerances": [1e-6]},
    },
    "teeth": {
        "double_contact_stiffness": lambda: {"pinion": made("row"), "gear": made("row").mirrored()},
        "error_harmonics": lambda: {"error_um": np.sin(np.arange(16.0)), "n": 2},
        "error_orders": lambda: {"error_um": np.sin(np.arange(16.0)), "teeth": 4},
        "finite_element_bodies": dict,
        "flank_tolerances": lambda: {"gear": gp.SpurPair().pinion, "grade": 6},
        "full_contact_force": lambda: {"mesh": made("mesh"), "deviation_um": np.zeros_like(made("mesh").path)},
        "iso_stiffness": lambda: {"pair": gp.SpurPair()},
        "loaded_mesh": lambda: {"mesh": made("mesh"), "deviation_um": made("mesh").path, "force_n": 100.0},
        "mesh_stiffness": lambda: {"pair": gp.SpurPair(), "n_phases": 10},
        "pair_deviations": lambda: {"mesh": made("mesh"), "deviation_um": np.zeros_like(made("mesh").path)},
        "profile_error": lambda: {"mesh": made("mesh"), "deviation_um": np.zeros_like(made("mesh").path)},
        "tip_relief": lambda: {"mesh": made("mesh"), "pinion_um": 20.0, "gear_um": 20.0, "length": 0.4},
    },
    "article": {
        "compare_attractors": lambda: {
            "stated": published.ranges("damping_ratio"),
            "planes": {0.02: made("plane")},
            "least_share": 0.1,
        },
        "compare_boundaries": lambda: {
            "boundaries": published.boundaries("mesh_frequency"),
            "stated": published.ranges("mesh_frequency"),
            "found": made("ranges"),
            "gap": 1.0,
        },
        "compare_ranges": lambda: {"stated": published.ranges("mesh_frequency"), "found": made("ranges")},
        "sweep_waves": lambda: {"osc": OSC, "waves": {"own": OSC.stiffness}, "frequencies": [1.6]},
    },
}
