"""What others computed or measured (rows O1 to O8), computed here with their parameters."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.article.others import EQUIVALENT_MASS_KG, ROWS, SOURCES, STATED, beside_others, stated
from gearpair.teeth import (
    SpurPair,
    TipRelief,
    ToothProfile,
    error_harmonics,
    full_contact_force,
    iso_stiffness,
    profile_error,
)
from gearpair.teeth.compliance import foundation_coefficients, hertz_compliance, tooth_compliance
from gearpair.teeth.iso6336 import tooth_flexibility
from tests.support.oscillators import SINGLE

EQUAL_GEARS = SpurPair(62, 62, module_mm=2.0, youngs_modulus_gpa=206.0, bore_ratio=17.5 / 62.0)
RELIEVED = SpurPair(
    **{"pinion_teeth": 27, "gear_teeth": 35, "face_width_mm": 25.0, "youngs_modulus_gpa": 206.0, "clearance": 0.167},
    **{"pinion_bore_ratio": 0.2 * (27 - 2.334) / 27, "gear_bore_ratio": 0.2 * (35 - 2.334) / 35},
)


def values(row):
    return [each.value for each in stated(row)]


def test_o1_contact_ratio_hertz_and_what_is_not_equal():
    mesh = gp.mesh_stiffness(EQUAL_GEARS)
    ratio, hertz, start = values("O1")
    assert EQUAL_GEARS.contact_ratio == pytest.approx(ratio, rel=1e-8)
    assert 1e-6 / mesh.compliance_m_per_n["hertz"][0] == pytest.approx(hertz, rel=1e-9)
    assert mesh.stiffness_n_per_m[0] == pytest.approx(415.56e6, rel=1e-4)
    assert mesh.stiffness_n_per_m[0] / (start * 1e6) - 1.0 == pytest.approx(0.0477, abs=1e-4)


def test_o2_and_o3_their_foundation_and_their_way_along_the_flank_give_their_numbers():
    """Stored test values of ROSS at its first five samples: 20 load points in bending, shear and compression."""
    gear, tooth = EQUAL_GEARS.pinion, ToothProfile(EQUAL_GEARS.pinion)
    half = tooth.clamp_half_angle - 2 * np.tan(EQUAL_GEARS.pressure_angle) * EQUAL_GEARS.clearance / 62
    linear, mixed, shear, thrust = foundation_coefficients(half, tooth.radius_ratio)
    form, tip = np.arccos(gear.base_radius_mm / np.array([gear.form_circle_mm, gear.tip_circle_mm]))
    way = (tip - form) / EQUAL_GEARS.contact_ratio * (np.array([[0.0], [1.0]]) + np.arange(5) / 999)
    compliance = hertz_compliance(0.3)
    for angle in (form + way, tip - way):
        slope = np.tan(angle) - gear.base_half_angle
        ratio = (tooth.involute(np.tan(angle))[0] - tooth.root_radius) / (2 * tooth.root_radius * half)
        body = np.cos(slope) ** 2 * (linear * ratio**2 + mixed * ratio + shear * (1 + thrust * np.tan(slope) ** 2))
        compliance = compliance + sum(tooth_compliance(tooth, np.tan(angle), 0.3)) + body
    stiffness = np.sum(206e9 * 0.02 / compliance, axis=0) / 1e6
    stored = [396.6229213581085, 396.7386800375346, 396.8541472919756, 396.969323136738, 397.0842075865779]
    np.testing.assert_allclose(stiffness, stored, rtol=1e-14)
    assert stiffness[[0, 4]].tolist() == pytest.approx([*values("O3"), *values("O2")], rel=2e-9)


@pytest.mark.parametrize("k", range(3))
def test_o4_contact_alone_is_nearer_to_a_solver_that_damps_in_contact_alone(k):
    speed, damping = ((0.75, 0.05), (0.9, 0.05), (0.9, 0.02))[k]
    osc = gp.Oscillator(mean_force=0.1277013, error_amplitude=0.05, damping_ratio=damping, stiffness=SINGLE)
    state = gp.steady_state(osc.replace(mesh_frequency=speed, flight_damping=0.0))
    theirs = values("O4")[2 * k : 2 * k + 2]
    assert [state.x_min, state.x_max] == pytest.approx(theirs, abs=4e-4)
    everywhere = gp.steady_state(osc.replace(mesh_frequency=speed))
    assert (everywhere.x_min == state.x_min) == (speed == 0.75)
    if speed == 0.9:
        assert abs(everywhere.x_min - theirs[0]) > 1e-3


def test_o5_iso_constants():
    theoretical = 1 / tooth_flexibility(18.905, 114.543, 0.145, 0.0)
    single = 0.8 * theoretical * (1 + 0.5 * (1.2 - 1.4)) * np.cos(np.radians(15.8))
    found = [theoretical, single, single * (0.75 * 1.54909 + 0.25)]
    assert found == pytest.approx(values("O5"), rel=1e-4)


def test_o6_iso_equal_and_finite_elements_near():
    bores = {"pinion_bore_ratio": 7.25 / 1.4 / 8.5, "gear_bore_ratio": 20.25 / 1.4 / 21.5}
    pair = SpurPair(17, 43, youngs_modulus_gpa=206.0, **bores)
    iso = iso_stiffness(pair)
    *theirs, elements = values("O6")
    assert [tooth_flexibility(17, 43), iso.theoretical, iso.single, iso.mesh] == pytest.approx(theirs, rel=5e-5)
    plane_strain = pair.replace(youngs_modulus_gpa=206.0 / (1 - 0.3**2), poisson_ratio=0.3 / (1 - 0.3))
    mesh, stiff = gp.mesh_stiffness(pair), gp.mesh_stiffness(plane_strain)
    parts = {**stiff.compliance_m_per_n, "hertz": mesh.compliance_m_per_n["hertz"]}
    pitch = (
        pair.pinion.base_radius_mm * np.tan(pair.working_pressure_angle) - pair.contact_start_mm
    ) / pair.base_pitch_mm
    found = np.interp(pitch, mesh.path, 1 / sum(parts.values())) / pair.contact_width_mm / 1e6
    assert found / elements - 1.0 == pytest.approx(0.032, abs=1e-3)


def test_o7_the_best_relief_and_the_accelerations_beside_it():
    """Their equation without backlash, in our coordinates: X = 1 is a relief up the flank, where nothing jumps."""
    mesh = gp.mesh_stiffness(RELIEVED, root="base_circle")
    force = 80e3 / (2000 * 2 * np.pi / 60) / (RELIEVED.pinion.base_radius_mm * 1e-3)
    least, over, best, *rms = values("O7")
    assert mesh.stiffness_n_per_m.min() / 1e6 == pytest.approx(least, rel=0.01)
    assert force / mesh.stiffness_n_per_m.min() * 1e6 == pytest.approx(over, rel=0.01)
    found = [acceleration(mesh, force, um) for um in (0.0, 40.0, 43.519, 45.0)]
    assert np.all(np.abs(np.divide(found, rms) - 1.0) < [0.02, 0.02, 0.09, 0.09])
    near = [acceleration(mesh, force, um) for um in (best - 0.5, best, best + 0.5)]
    assert near[1] == min(near)


def acceleration(mesh, force, um):
    """Root mean square in m/s^2."""
    unit, rate = mesh.mean * 1e-6, np.sqrt(mesh.mean / EQUIVALENT_MASS_KG)
    omega, moved = 2 * np.pi * 27 * 2000 / 60 / rate, min(um, 42.9)
    relief = TipRelief(um, um, mesh.contact_ratio - 1).deviation_um(mesh)
    error = profile_error(mesh, relief, force_n=full_contact_force(mesh, relief))
    push = mesh.stiffness_n_per_m * (error - moved) * 1e-6 / unit
    lines = [(n, size / (n * omega) ** 2, phase) for n, size, phase in error_harmonics(push, 100)]
    osc = gp.Oscillator(
        mean_force=force / unit + push.mean(), damping_ratio=0.0771, mesh_frequency=omega, stiffness=mesh.wave(200),
        error_amplitude=lines[0][1], error_phase=lines[0][2], harmonics=lines[1:],
    )  # fmt: skip
    state = gp.steady_state(osc, 1 + force / unit - moved, 0.0)
    assert state.period == 1 and state.x_min > 1.0
    motion = gp.trajectory(osc, *state.points[0], 1, samples_per_period=4000)
    pressed = osc.stiffness(motion.tau / osc.period) * (motion.x - 1.0)
    return np.sqrt(np.mean((osc.force(motion.tau) - 2 * 0.0771 * motion.v - pressed)[:-1] ** 2)) * 1e-6 * rate**2


def test_o8_lies_among_the_bores():
    pair = SpurPair(30, 25, module_mm=2.0, youngs_modulus_gpa=200.0)
    least = [gp.mesh_stiffness(pair.replace(bore_ratio=bore), root="straight").pair_stiffness_n_per_m.min() / 1e6
             for bore in (0.3, 0.4, 0.5)]  # fmt: skip
    assert least == pytest.approx([142.0, 152.4, 158.1], abs=0.06)
    assert least[0] < values("O8")[0] < least[2]


def test_a_softening_resonance_with_two_jumps():
    """Our own computation of what is widely told of lightly damped pairs."""
    osc = gp.Oscillator(error_amplitude=0.05, damping_ratio=0.05, mesh_frequency=1.1, stiffness=SINGLE)
    branch = gp.continue_orbit(gp.steady_state(osc), "mesh_frequency", 0.5, 1.2)
    folds = sorted(each.value for each in branch.bifurcations if each.kind == "fold")
    assert folds == pytest.approx([0.7080, 0.8285], abs=1e-4)
    for values in (np.linspace(1.1, 0.5, 61), np.linspace(0.5, 1.1, 61)):
        swept = gp.sweep(osc, "mesh_frequency", values)
        assert set(swept.impact_state.values.ravel()) == {"none_drive", "single_drive"}


def test_the_table_has_every_row_and_says_how_far_apart():
    assert tuple(f"O{n}" for n in range(1, 9)) == ROWS and {each.source for each in STATED} == set(SOURCES)
    table = beside_others({row: [1.0001 * value for value in values(row)] for row in ROWS})
    assert len(table.rows) == len(STATED)
    assert [row[-1] for row in beside_others({"O8": [153.0]}).rows] == ["+0.66%"]
    assert beside_others({"O5": [17.8566, 12.3710, 17.46485]}).rows[2][-1] == "none"
    assert beside_others({"O5": [17.8566, 12.3710, 17.4656]}).rows[0][-1] == "+43 ppm"
    with pytest.raises(ValueError, match=r"found\['O8'\] must be 1 numbers, got 2"):
        beside_others({"O8": [1.0, 2.0]})
    with pytest.raises(ValueError, match="row must be one of 'O1'"):
        stated("O9")
