"""Good arguments of every picture, and of what makes objects and of their methods, as `good_calls` has functions'."""

from functools import cache

from matplotlib import pyplot as plt

import gearpair as gp
from gearpair import article, methods, plotting, teaching, teeth
from gearpair.article import case, published
from tests.support.good_calls import CRISIS, OSC, QUICK, SPEEDS, SWEEP, TEETH, made

PINION = gp.SpurPair(density_kg_m3=7850.0).pinion


@cache
def drawn(name):
    """What pictures alone are of."""
    drive = made("drive")
    makers = {
        "curve": lambda: gp.continue_bifurcation(
            made("flip"), {"mesh_frequency": (0.7, 0.8), "a": (0.115, 0.117)}, max_steps=3
        ),
        "identified": lambda: gp.design.identify(
            drive.at_phase(0.3), 8598.0, 6500.0, damping_ratios=(0.19, 0.2), errors_um=(1e-3, 2e-3)
        ),
        "loaded": lambda: teeth.loaded_mesh(made("mesh"), made("mesh").path, 100.0),
        "manifolds": lambda: gp.manifolds(gp.periodic_orbit(OSC, -1.5688, -1.0135, 1), length=1.0, spacing=0.1),
        "passage": lambda: gp.design.run_up(made("moving"), 2000.0, 3000.0, 0.01, samples_per_period=16),
        "reached": lambda: tuple(
            case.reached([article.SWAPPED], name, 2, n_discarded=20, n_watch=0)
            for name in ("mesh_frequency", "damping_ratio")
        ),
        "saddle": lambda: gp.ensembles.chaotic_saddle(CRISIS, [-1.0, 0.0, 1.0, 2.0], -1.0, n_periods=800, n_after=100),
        "segment": lambda: next(each for each in made("pieces") if each.crossing is not None),
        "sensitivity": lambda: gp.design.sensitivity(drive, SPEEDS, {"damping_ratio": (0.1, 0.2)}),
        "shares": lambda: gp.ensembles.motion_shares(OSC, **SWEEP, x=[0.0], v=[0.0], **QUICK),
        "shocks": lambda: gp.design.shock_margin(made("moving"), SPEEDS, n_phases=1, n_starts=0),
        "trials": lambda: case.run_trials(
            [article.SWAPPED], [case.Protocol("restart", 20)], 3, [methods.Integrator(steps=20)]
        ),
    }
    return makers[name]()


def rows(n):
    """Axes of a new figure."""
    return list(plt.figure().subplots(n, 1, squeeze=False)[:, 0])


PLOTS = {
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
    "add_motion_legend": lambda: {"ax": rows(1)[0], "motions": [made("state").motion]},
    "attractor_points": lambda: {"states": [made("state")], "ax": rows(1)[0]},
    "bare": lambda: {"ax": rows(1)[0]},
    "bifurcation_curves": lambda: {"curves": [drawn("curve")]},
    "boundaries_by_step": lambda: {"trials": drawn("trials")},
    "certificate": lambda: {"segment": drawn("segment")},
    "certified_steps": lambda: {"segment": drawn("segment")},
    "chaotic_saddle": lambda: {"result": drawn("saddle")},
    "compliance_stack": lambda: {"mesh": made("mesh")},
    "contact_ratio_cloud": lambda: {
        "ratios": [[1.6] * len(published.STIFFNESS_TABLE)],
        "published": published.STIFFNESS_TABLE,
    },
    "coverage_by_phase": lambda: dict(zip(("frequency", "damping"), drawn("reached"), strict=True)),
    "drawn_diagram": lambda: {"exact": made("sweep"), "drawn": made("drawn")},
    "finite_element_check": lambda: {
        "body": teeth.finite_element_bodies()["34"],
        "mesh": made("mesh"),
        "axes": rows(2),
    },
    "fold_curves": lambda: {"found": drawn("identified")},
    "interpolation_error": lambda: {"segment": drawn("segment")},
    "load_shares": lambda: {"meshes": {"one": made("mesh")}},
    "manifolds": lambda: {"found": drawn("manifolds")},
    "mark_boundaries": lambda: {
        "boundaries": published.boundaries("mesh_frequency"),
        "ax": plotting.exponents(made("sweep")),
    },
    "motion_colour": lambda: {"motion": made("state").motion},
    "motion_shares": lambda: {"shares": drawn("shares")},
    "order_map": lambda: {"run": drawn("passage")},
    "pair_stiffness": lambda: {"mesh": made("mesh")},
    "passage_factor": lambda: {"run": drawn("passage")},
    "passage_path": lambda: {"run": drawn("passage")},
    "per_width": lambda: {"mesh": made("mesh")},
    "portrait": lambda: {"state": made("state")},
    "range_lanes": lambda: {"sources": {"article": published.ranges("mesh_frequency"), "found": made("ranges")}},
    "range_strips": lambda: {"strips": {"article": published.ranges("mesh_frequency"), "found": made("sweep")}},
    "rattling_share": lambda: {"found": made("boxes")},
    "reached_motions": lambda: {"reached": drawn("reached")[0][0]},
    "score_ranking": lambda: {"ranked": case.ranking(drawn("trials")), "marked": {"swapped": article.SWAPPED}},
    "shock_margins": lambda: {"margin": drawn("shocks")},
    "step_convergence": lambda: {"segment": drawn("segment")},
    "stiffness_trends": lambda: {"published": published.STIFFNESS_TABLE, "computed": {}, "axes": rows(3)},
    "survival_curves": lambda: {"results": {"one": made("survival")}},
    "tooth_loads": lambda: {"chart": made("chart"), "axes": tuple(rows(2))},
    "tooth_outlines": lambda: {"gear": PINION},
    "tornado": lambda: {"found": drawn("sensitivity")},
    "under_load": lambda: {"meshes": {"one": drawn("loaded")}, "axes": rows(3)},
    "work_precision": lambda: {"measured": made("precision")},
}
INTEGRATED = {"oscillators": [OSC], "x": 1.0, "v": 0.0, "n_discarded": 1, "n_kept": 1}
PERSONAL = ("personal_drive", "personal_oscillator", "personal_pair", "personal_rig", "personal_starts")
OBJECTS = {
    "Attractors.follow": lambda: (made("found").follow, {"parameter": "mesh_frequency", "value": 0.71}),
    "Attractors.from_dataset": lambda: (gp.Attractors.from_dataset, {"result": made("found").to_dataset()}),
    "Attractors.including": lambda: (made("found").including, {"x": [0.0, 1.0], "v": 0.0}),
    "Attractors.label": lambda: (made("found").label, {"x": [0.0, 1.0], "v": 0.0}),
    "Attractors.table": lambda: (made("found").table, {}),
    "GearBlank": lambda: (teeth.GearBlank, {"rim_mm": 5.0, "web_mm": 5.0}),
    "GearBlank.inertia_kg_m2": lambda: (teeth.GearBlank().inertia_kg_m2, {"gear": PINION}),
    "GearDrive": lambda: (
        gp.GearDrive,
        {name: getattr(made("drive"), name) for name in gp.GearDrive.__dataclass_fields__},
    ),
    "GearDrive.at_phase": lambda: (made("drive").at_phase, {"error_phase_rad": 0.1}),
    "GearDrive.at_speed": lambda: (made("drive").at_speed, {"pinion_speed_rpm": 100.0}),
    "GearDrive.from_file": lambda: (gp.GearDrive.from_file, {"path": made("drive").to_file("pair.yml") or "pair.yml"}),
    "GearDrive.from_pair": lambda: (gp.GearDrive.from_pair, {"pair": gp.SpurPair(), **TEETH}),
    "GearDrive.replace": lambda: (made("drive").replace, {"backlash_um": 90.0, "damping_ratio": 0.2}),
    "GearDrive.to_file": lambda: (made("drive").to_file, {"path": "pair.yml"}),
    "GearDrive.with_oscillator": lambda: (made("moving").with_oscillator, {"osc": OSC}),
    "Hypothesis": lambda: (article.Hypothesis, {}),
    "Hypothesis.along": lambda: (article.PRINTED.along, {"parameter": "mesh_frequency", "values": [0.7]}),
    "Hypothesis.oscillator": lambda: (article.PRINTED.oscillator, {}),
    "Integrator": lambda: (methods.Integrator, {"rtol": 1e-3}),
    "Integrator.integrate": lambda: (methods.Integrator(steps=20).integrate, INTEGRATED),
    "Integrator.sections": lambda: (methods.Integrator(steps=20).sections, INTEGRATED),
    "LoadedMesh.wave": lambda: (drawn("loaded").wave, {"n_levels": 5}),
    "Material": lambda: (teeth.Material, {"youngs_modulus_gpa": 200.0, "poisson_ratio": 0.3}),
    "MeshStiffness.wave": lambda: (made("mesh").wave, {"n_levels": 5}),
    "Oscillator": lambda: (gp.Oscillator, {"harmonics": [(2, 0.1)], "shaft_orders": [(4, 0.1)]}),
    "Oscillator.base_periods": lambda: (OSC.base_periods, {"mesh_periods": 5}),
    "Oscillator.error": lambda: (OSC.error, {"tau": [0.0, 1.0]}),
    "Oscillator.force": lambda: (OSC.force, {"tau": [0.0, 1.0]}),
    "Oscillator.from_attrs": lambda: (gp.Oscillator.from_attrs, {"result": made("sweep")}),
    "Oscillator.parameter": lambda: (OSC.parameter, {"name": "a"}),
    "Oscillator.replace": lambda: (OSC.replace, {"levels[0]": 1.1, "edges[1]": 0.5}),
    "Segment.__call__": lambda: (drawn("segment"), {"t": [0.0, 0.1]}),
    "Segment.cubic": lambda: (drawn("segment").cubic, {"t": [0.0, 0.1]}),
    "Spectrum.line": lambda: (gp.spectrum(made("motion")).line, {"frequency": 1.0}),
    "SpurPair": lambda: (gp.SpurPair, {}),
    "SpurPair.normal_backlash_um": lambda: (gp.SpurPair().normal_backlash_um, {"backlash_um": 80.0}),
    "SpurPair.replace": lambda: (gp.SpurPair().replace, {"module_mm": 2.0, "pinion_teeth": 30}),
    "StiffnessWave": lambda: (gp.StiffnessWave, {"edges": (0.0, 0.5), "levels": (1.0, 2.0)}),
    "StiffnessWave.__call__": lambda: (OSC.stiffness, {"fraction": [0.0, 0.5]}),
    "StiffnessWave.harmonics": lambda: (OSC.stiffness.harmonics, {"n": 2}),
    "StiffnessWave.rectangular": lambda: (gp.StiffnessWave.rectangular, {}),
    "StiffnessWave.truncated": lambda: (OSC.stiffness.truncated, {"n_harmonics": 2}),
    "SweptWave.share_met": lambda: (made("waves").share_met, {"reference": made("waves")}),
    "Table": lambda: (gp.Table, {"columns": ["one"], "rows": [["two"]]}),
    "Table.text": lambda: (gp.Table(["one"], [["two words"]]).text, {"widest": 4}),
    "TipRelief": lambda: (teeth.TipRelief, {"pinion_um": 20.0, "gear_um": 20.0, "length": 0.4}),
    "TipRelief.deviation_um": lambda: (teeth.TipRelief(20.0, 20.0, 0.4).deviation_um, {"mesh": made("mesh")}),
    "ToothProfile": lambda: (teeth.ToothProfile, {"gear": PINION}),
    "ToothProfile.fillet": lambda: (teeth.ToothProfile(PINION).fillet, {"fraction": [0.0, 1.0]}),
    "ToothProfile.involute": lambda: (teeth.ToothProfile(PINION).involute, {"roll": 0.364}),
    **{
        f"teaching.{name}": lambda name=name: (getattr(teaching, name), {"student_id": "1234567"})
        for name in ("check_student_id", "true_rig", *PERSONAL)
    },
}
