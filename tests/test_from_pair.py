"""From a drawing to a drive: inertias, backlash and the transmission error, each against another way to the number."""

import dataclasses
import math

import numpy as np
import pytest

import gearpair as gp
from gearpair.teeth import (
    GearBlank,
    Material,
    ToothProfile,
    error_harmonics,
    error_orders,
    mesh_stiffness,
    profile_error,
    tip_relief,
)
from gearpair.teeth.blank import teeth_moment_mm4

PAIR = gp.SpurPair(pinion_teeth=25, gear_teeth=71, module_mm=2.0, pinion_shift=0.3, gear_shift=0.1)
GIVEN = dict(
    pinion_torque_nm=50.0, pinion_speed_rpm=4000.0, backlash_um=80.0, transmission_error_um=4.0, damping_ratio=0.06
)
DRIVE = gp.GearDrive.from_pair(PAIR, **GIVEN)


def outline(gear, n=4000):
    """One tooth as a polygon, from the root circle over the tip and back, in mm."""
    tooth = ToothProfile(gear)
    last = math.sqrt((gear.tip_circle_mm / gear.base_radius_mm) ** 2 - 1.0)
    parts = [tooth.fillet(np.linspace(0, 1, n)), tooth.involute(np.linspace(tooth.first_roll, last, n))]
    y, h = (np.concatenate([part[k] for part in parts]) * gear.module_mm for k in (0, 1))
    tip = np.arctan2(h[-1], y[-1]) * np.linspace(1, -1, n)
    root = np.arctan2(h[0], y[0]) * np.linspace(-1, 1, n)
    arcs = [
        radius * np.array([np.cos(angle), np.sin(angle)])
        for radius, angle in ((gear.tip_circle_mm, tip), (gear.root_circle_mm, root))
    ]
    return np.hstack([[y, h], arcs[0], [y[::-1], -h[::-1]], arcs[1]])


@pytest.mark.parametrize("gear", [PAIR.pinion, PAIR.gear])
def test_the_teeth_moment_is_that_of_the_polygon_of_their_outline(gear):
    """Polar second moment of a polygon: sum over its edges of (x_i y_j - x_j y_i)(r_i^2 + r_i . r_j + r_j^2) / 12."""
    x, y = outline(gear)
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    squares = x * x + x * x1 + x1 * x1 + y * y + y * y1 + y1 * y1
    polygon = abs(np.sum((x * y1 - x1 * y) * squares)) / 12.0
    assert teeth_moment_mm4(gear) == pytest.approx(gear.teeth * polygon, rel=1e-6)


def test_the_inertia_of_a_solid_gear_and_of_a_webbed_one():
    gear, width = PAIR.gear, 20.0
    solid = GearBlank(density_kg_m3=7800.0).inertia_kg_m2(gear, width)
    disc = math.pi / 2 * (gear.root_circle_mm**4 - gear.bore_mm**4)
    assert solid == pytest.approx(7800.0e-9 * 1e-6 * width * (disc + teeth_moment_mm4(gear)), rel=1e-12)
    webbed = GearBlank(rim_mm=6.0, web_mm=8.0, hub_mm=4.0, density_kg_m3=7800.0).inertia_kg_m2(gear, width)
    outer, inner = gear.root_circle_mm - 6.0, gear.bore_mm + 4.0
    removed = math.pi / 2 * (outer**4 - inner**4) * (width - 8.0) * 7800.0e-15
    assert solid - webbed == pytest.approx(removed, rel=1e-12)
    assert GearBlank(rim_mm=6.0, web_mm=width, density_kg_m3=7800.0).inertia_kg_m2(gear, width) == pytest.approx(solid)


def test_each_gear_is_weighed_by_its_own_material_width_and_bore():
    plastic = Material(youngs_modulus_gpa=3.1, poisson_ratio=0.35, density_kg_m3=1410.0)
    pair = PAIR.replace(gear_material=plastic, pinion_face_width_mm=25.0, pinion_bore_ratio=0.0)
    drive = gp.GearDrive.from_pair(pair, **GIVEN)
    assert drive.gear_inertia_kg_m2 == pytest.approx(DRIVE.gear_inertia_kg_m2 * 1410.0 / 7850.0, rel=1e-12)
    plug = math.pi / 2 * PAIR.pinion.bore_mm**4 * 25.0 * 7850.0e-15
    assert drive.pinion_inertia_kg_m2 == pytest.approx(DRIVE.pinion_inertia_kg_m2 * 25.0 / 20.0 + plug, rel=1e-12)
    soft = PAIR.replace(youngs_modulus_gpa=3.1)
    with pytest.raises(ValueError, match="density_kg_m3 must be given where youngs_modulus_gpa is no steel's"):
        gp.GearDrive.from_pair(soft, **GIVEN)
    weighed = gp.GearDrive.from_pair(soft.replace(density_kg_m3=1410.0), **GIVEN)
    assert weighed.gear_inertia_kg_m2 == pytest.approx(drive.gear_inertia_kg_m2, rel=1e-12)


def test_a_drive_has_the_geometry_of_its_pair():
    assert DRIVE.pinion_base_radius_mm == PAIR.pinion.base_radius_mm
    assert DRIVE.gear_base_radius_mm == PAIR.gear.base_radius_mm
    assert DRIVE.pinion_inertia_kg_m2 == GearBlank().inertia_kg_m2(PAIR.pinion)
    mesh = mesh_stiffness(PAIR, coupling="ring")
    assert DRIVE.mean_stiffness_n_per_um == pytest.approx(mesh.mean * 1e-6, rel=1e-14)
    assert DRIVE.stiffness == mesh.wave(16)
    osc = DRIVE.oscillator()
    assert osc.damping_ratio == pytest.approx(0.06, rel=1e-12)
    assert osc.stiffness.mean == pytest.approx(1.0, rel=1e-12)
    shaft = GearBlank(added_inertia_kg_m2=1e-3)
    more = gp.GearDrive.from_pair(PAIR, **GIVEN, pinion_blank=shaft, coupling="summed", n_levels=10)
    assert more.pinion_inertia_kg_m2 == pytest.approx(DRIVE.pinion_inertia_kg_m2 + 1e-3, rel=1e-14)
    assert more.mean_stiffness_n_per_um != DRIVE.mean_stiffness_n_per_um and len(more.stiffness.levels) == 10
    assert more.oscillator().damping_ratio == pytest.approx(0.06, rel=1e-12)


@pytest.mark.parametrize(
    "changes",
    [
        {"pinion_torque_nm": 30.0},
        {"backlash_um": 60.0},
        {"damping_ratio": 0.03},
        {"transmission_error_um": [(1, 2.0, 0.5), (3, 0.4, -1.0)]},
        {"pinion_speed_rpm": None},
        {"coupling": "summed", "damping_ratio": 0.1},
        {"n_levels": 24},
        {"gear_blank": GearBlank(rim_mm=6.0, web_mm=8.0, added_inertia_kg_m2=1e-3)},
    ],
)
def test_a_changed_drive_is_the_drive_of_what_was_changed(changes):
    """`replace` and `from_pair` with the same numbers are one, to the bit."""
    changed, made = DRIVE.replace(**changes), gp.GearDrive.from_pair(PAIR, **(GIVEN | changes))
    assert changed == made and repr(changed) == repr(made)
    assert changed.mesh.coupling == made.mesh.coupling and changed.gear_blank == made.gear_blank


def test_a_changed_pair_brings_what_follows_from_it():
    other = PAIR.replace(module_mm=2.5, gear_teeth=60)
    made = gp.GearDrive.from_pair(other, **GIVEN)
    for changed in (DRIVE.replace(module_mm=2.5, gear_teeth=60), DRIVE.replace(pair=other)):
        assert changed.mesh.pair == other and changed.damping_ratio == pytest.approx(0.06, rel=1e-14)
        assert changed.replace(damping_n_s_per_m=made.damping_n_s_per_m) == made
    heavy = DRIVE.replace(gear_inertia_kg_m2=1.0)
    assert heavy.damping_n_s_per_m == DRIVE.damping_n_s_per_m and heavy.mesh is DRIVE.mesh
    assert heavy.gear_blank is None and heavy.replace(module_mm=2.5).gear_inertia_kg_m2 == 1.0
    flat = DRIVE.replace(stiffness=gp.StiffnessWave((0.0,), (1.0,)))
    assert flat.mesh is None and DRIVE.replace(stiffness=DRIVE.stiffness).mesh is DRIVE.mesh


def test_an_error_that_is_scaled_keeps_its_form():
    drive = DRIVE.replace(transmission_error_um=[(1, 4.0, 0.3), (2, 1.5, -1.0)])
    half = drive.replace(transmission_error_um=2.0)
    assert (half.transmission_error_um, half.error_phase_rad, half.error_harmonics) == (2.0, 0.3, ((2, 0.75, -1.0),))


def test_a_speed_and_the_mesh_frequency_that_it_makes():
    """Omega = 1 at the resonance speed, where z1 teeth a turn pass in the period of the free vibration."""
    still = DRIVE.replace(pinion_speed_rpm=None)
    hertz = still.natural_frequency_rad_s / (2.0 * math.pi)
    assert still.resonance_rpm == pytest.approx(60.0 * hertz / 25, rel=1e-14)
    for share in (0.3, 1.0, 1.7):
        there = still.at_speed(share * still.resonance_rpm)
        assert there.oscillator().mesh_frequency == pytest.approx(share, rel=1e-14)
        assert still.with_oscillator(there.oscillator()).pinion_speed_rpm == pytest.approx(there.pinion_speed_rpm)


def test_sixteen_levels_stand_for_the_stiffness():
    """With four times as many the largest force of a resonance changes by less than two per cent."""
    factors = []
    for n in (16, 64):
        drive = gp.GearDrive.from_pair(PAIR, **(GIVEN | {"transmission_error_um": 0.0}), n_levels=n)
        osc = drive.oscillator().replace(mesh_frequency=0.5)
        factors.append(gp.motion.impact_measures(gp.steady_state(osc, 1.2, 0.0)).load_factor)
    assert factors[0] == pytest.approx(factors[1], rel=0.02)
    assert factors[0] > 1.1


def test_backlash_by_the_turn_it_allows():
    """Each backlash as the angle by which the pinion turns, the gear held: j_bn over its base radius."""
    r = PAIR.pinion
    working = r.base_radius_mm / math.cos(PAIR.working_pressure_angle)
    for kind, angle in (
        ("normal", 0.08 / r.base_radius_mm),
        ("circumferential", 0.08 / working),  # an arc of the working pitch circle
        ("thickness", 0.08 / r.pitch_radius_mm),  # of the reference circle: all of it taken off the pinion's tooth
    ):
        assert PAIR.normal_backlash_um(80.0, kind) * 1e-3 == pytest.approx(angle * r.base_radius_mm, rel=1e-12), kind


def test_a_drive_there_and_back_with_harmonics():
    """SI to dimensionless and back to 1e-12, harmonics and all."""
    drive = gp.GearDrive.from_pair(
        PAIR, **(GIVEN | {"transmission_error_um": [(1, 4.0, 0.3), (2, 1.5, -1.0), (5, 0.2, 2.0)]})
    )
    assert (drive.transmission_error_um, drive.error_phase_rad) == (4.0, 0.3)
    osc = drive.oscillator()
    assert [each.order for each in osc.harmonics] == [2, 5]
    assert osc.harmonics[0].amplitude == pytest.approx(1.5 / (drive.backlash_um / 2), rel=1e-12)
    again = drive.with_oscillator(osc)
    for field in dataclasses.fields(drive):
        here, there = getattr(drive, field.name), getattr(again, field.name)
        if field.name == "error_harmonics":
            assert np.allclose(here, there, rtol=1e-12, atol=0.0)
        elif field.name in ("stiffness", "relief", "mesh", "pinion_blank", "gear_blank"):
            assert here is there
        else:
            assert there == pytest.approx(here, rel=1e-12)
    assert drive.with_oscillator(osc.replace(stiffness=gp.StiffnessWave((0.0,), (1.0,)))).mesh is None


def test_the_error_of_an_oscillator_is_what_its_force_is_made_of():
    """The force is the mean minus the error's second derivative."""
    osc = DRIVE.oscillator().replace(harmonics=[(3, 0.02, 0.5)])
    tau, h = np.linspace(0.0, osc.period, 50), 1e-4
    second = (osc.error(tau + h) - 2 * osc.error(tau) + osc.error(tau - h)) / h**2
    assert np.allclose(osc.force(tau) - osc.mean_force, -second, atol=1e-6)


def test_a_relief_seen_by_springs_side_by_side():
    """Two pairs as springs with gaps: the approach under a load, less that of perfect teeth, is the error."""
    mesh = mesh_stiffness(PAIR)
    relief = tip_relief(mesh, 12.0, 8.0, 0.3)
    assert relief[0] == 8.0 and relief[-1] == 12.0
    error = profile_error(mesh, relief, force_n=3e4)
    pair = np.interp(mesh.phase + np.arange(2)[:, None], mesh.path, mesh.pair_stiffness_n_per_m, right=0.0)
    gaps = np.interp(mesh.phase + np.arange(2)[:, None], mesh.path, relief) * 1e-6
    for i in (5, 300, 900):
        k, d = pair[:, i] * (mesh.load_share[:, i] > 0), gaps[:, i]
        load = 3e4  # enough for both to carry
        approach = (load + k @ d) / k.sum()
        assert np.all(approach - d[k > 0] > 0.0)
        assert error[i] == pytest.approx((approach - load / k.sum()) * 1e6, rel=1e-6)
    free = profile_error(mesh, relief, loaded=False)
    assert np.all(free <= error + 1e-12)


def test_harmonics_give_the_error_back():
    rng = np.random.default_rng(0)
    theta = 2 * np.pi * np.arange(240) / 80  # three mesh periods
    drawn = [(n, rng.uniform(0.1, 3.0), rng.uniform(-3.0, 3.0)) for n in range(1, 7)]
    wave = sum(a * np.sin(n * theta + p) for n, a, p in drawn) + 0.7 * np.sin(theta / 3) + 5.0
    assert np.allclose(error_harmonics(wave, 6, n_periods=3), drawn, atol=1e-12)


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda: gp.GearDrive.from_pair(PAIR, **(GIVEN | {"backlash_um": 0.0})), "backlash_um must be .* above 0"),
        (lambda: PAIR.normal_backlash_um(80.0, "radial"), "backlash must be one of 'normal'"),
        (lambda: gp.GearDrive.from_pair(PAIR, **(GIVEN | {"damping_ratio": -0.1})), "damping_ratio must be"),
        (lambda: PAIR.normal_backlash_um(-1.0), "backlash_um must be a finite number above 0, got -1.0"),
        (
            lambda: GearBlank(added_inertia_kg_m2=-1.0),
            "added_inertia_kg_m2 must be a finite number at least 0, got -1.0",
        ),
        (lambda: DRIVE.replace(colour=1.0), "unknown name 'colour'; what can be changed is pinion_teeth, "),
        (
            lambda: DRIVE.replace(mesh=None).replace(addendum=1.1),
            "addendum can be changed only where",
        ),
        (lambda: DRIVE.replace(addendum=3.0), "tooth pointed"),
        (lambda: DRIVE.replace(backlash_um=None), "backlash_um must be a finite number above 0, got None"),
        (lambda: DRIVE.replace(damping_ratio=-1.0), "damping_ratio must be .* at least 0, got -1.0"),
        (lambda: DRIVE.at_speed(-1.0), "pinion_speed_rpm must be .* above 0, got -1.0"),
        (
            lambda: DRIVE.replace(pinion_speed_rpm=None).oscillator(),
            "this drive has no speed: give",
        ),
        (
            lambda: gp.GearDrive.from_pair(PAIR, **(GIVEN | {"transmission_error_um": [(0, 1.0, 0.0)]})),
            r"transmission_error_um\[0\] order must be a whole number of at least 1, got 0",
        ),
        (lambda: GearBlank(rim_mm=3.0), "rim_mm and web_mm go together"),
        (lambda: GearBlank(rim_mm=60.0, web_mm=5.0).inertia_kg_m2(PAIR.gear, 20.0), "leave no web"),
        (lambda: GearBlank(rim_mm=3.0, web_mm=25.0).inertia_kg_m2(PAIR.gear, 20.0), "web_mm must be .* at most 20"),
        (lambda: error_harmonics(np.zeros(8), 4), "error_um must be more than 8 samples for 4 harmonics, got 8"),
        (lambda: profile_error(mesh_stiffness(PAIR), [1.0, 2.0]), "deviation_um must be finite numbers over the path"),
        (lambda: tip_relief(mesh_stiffness(PAIR), 1.0, 1.0, 3.0), "length must be"),
    ],
)
def test_bad_input_gets_a_sentence(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()


def test_an_error_measured_over_a_revolution_is_taken_whole():
    """Every line of the series, of the mesh or of the shaft: the oscillator's error is what was measured."""
    teeth, per_mesh = 24, 16
    measured = np.random.default_rng(7).normal(size=teeth * per_mesh)
    harmonics, orders = error_orders(measured, teeth)
    assert [each.order for each in harmonics] == list(range(1, per_mesh // 2))
    assert len(harmonics) + len(orders) == len(measured) // 2 - 1 and {each.teeth for each in orders} == {teeth}
    drive = DRIVE.replace(transmission_error_um=harmonics, shaft_orders=orders, pinion_speed_rpm=3000.0)
    osc = drive.oscillator()
    tau = osc.period * np.arange(len(measured)) / len(measured)
    turn = np.fft.rfft(measured)
    turn[0] = turn[-1] = 0.0  # the mean, and half the sampling rate, which has no phase
    drawn = osc.error(tau) * drive.half_backlash_m * 1e6
    assert np.allclose(drawn, np.fft.irfft(turn), rtol=0.0, atol=1e-11)
    least = error_orders(measured, teeth, least_um=0.1)
    assert all(each.amplitude >= 0.1 for part in least for each in part)
    few = error_orders(measured, teeth, most=5)
    sizes = sorted((each.amplitude for part in (harmonics, orders) for each in part), reverse=True)
    assert sorted((each.amplitude for part in few for each in part), reverse=True) == sizes[:5]


def test_run_out_of_a_pair_from_its_drawing():
    drive = gp.GearDrive.from_pair(PAIR, **GIVEN, shaft_orders=[(25, 20.0)])
    assert drive.replace(addendum=1.05).oscillator().shaft_orders == ((25, 0.5, 0.0, 1),)
