"""Geometry of the pair: contact ratio, shifted pairs, outlines, and what cannot be cut or cannot run."""

import math
import re

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from gearpair.teeth.spurgear import SpurGear
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.tooth_profile import ToothProfile


def textbook_contact_ratio(pair: SpurPair) -> float:
    """By the angles at the tips and the working pressure angle, which is found here by bisection."""
    z1, z2, alpha = pair.pinion_teeth, pair.gear_teeth, math.radians(pair.pressure_angle_deg)
    shifts = pair.pinion_shift + pair.gear_shift
    involute = math.tan(alpha) - alpha + 2 * shifts * math.tan(alpha) / (z1 + z2)
    working = brentq(lambda angle: math.tan(angle) - angle - involute, 1e-3, 1.5, xtol=1e-15)

    def half(z: int, shift: float) -> float:
        tip = z / 2 + pair.addendum + shift - pair.tip_shortening
        return z * (math.tan(math.acos(z / 2 * math.cos(alpha) / tip)) - math.tan(working)) / (2 * math.pi)

    return half(z1, pair.pinion_shift) + half(z2, pair.gear_shift)


@pytest.mark.parametrize(
    "pair",
    [
        SpurPair(),
        SpurPair(gear_teeth=44, module_mm=0.7),
        SpurPair(gear_teeth=54, pressure_angle_deg=25.0),
        SpurPair(pinion_shift=0.3, gear_shift=0.2),
        SpurPair(pinion_shift=-0.1, gear_shift=-0.2, gear_teeth=60),
        SpurPair(pinion_teeth=16, gear_teeth=80, pinion_shift=0.4, gear_shift=-0.4),
        SpurPair(pinion_teeth=40, gear_teeth=60, addendum=1.3, clearance=0.2, tip_radius=0.1),
    ],
)
def test_contact_ratio_is_the_textbooks(pair: SpurPair) -> None:
    assert pair.contact_ratio == pytest.approx(textbook_contact_ratio(pair), rel=1e-12)


def test_contact_ratio_of_the_standard_pair() -> None:
    # a 1 : 1 pair of 34 teeth at 20 degrees, worked by hand: 2 (sqrt(18^2 - r_b^2) - 17 sin 20) / (pi cos 20)
    base = 17 * math.cos(math.radians(20))
    by_hand = (
        2 * (math.sqrt(18**2 - base**2) - 17 * math.sin(math.radians(20))) / (math.pi * math.cos(math.radians(20)))
    )
    assert SpurPair().contact_ratio == pytest.approx(by_hand, rel=1e-13)
    assert round(SpurPair().contact_ratio, 4) == 1.6806


def test_published_shifted_pair() -> None:
    # Kohara Gear Industry, Gear Technical Reference, profile shifted spur gears: m = 3, z = 12 and 24
    pair = SpurPair(pinion_teeth=12, gear_teeth=24, pinion_shift=0.6, gear_shift=0.36, tip_shortening=0.0)
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(26.0886, abs=1e-4)
    assert pair.centre_distance_mm == pytest.approx(56.4999, abs=1e-4)
    cut = pair.replace(tip_shortening=pair.full_clearance_shortening)
    assert 2 * cut.pinion.tip_circle_mm == pytest.approx(44.840, abs=1e-3)
    assert 2 * cut.gear.tip_circle_mm == pytest.approx(79.400, abs=1e-3)
    free = cut.centre_distance_mm - cut.gear.tip_circle_mm - cut.pinion.root_circle_mm
    assert free == pytest.approx(0.25 * 3, rel=1e-12)


@given(
    z1=st.integers(18, 90),
    z2=st.integers(18, 90),
    x1=st.floats(-0.2, 0.5),
    x2=st.floats(-0.2, 0.5),
    alpha=st.floats(18.0, 25.0),
)
def test_no_backlash_at_the_working_centre_distance(z1: int, z2: int, x1: float, x2: float, alpha: float) -> None:
    try:
        pair = SpurPair(z1, z2, pinion_shift=x1, gear_shift=x2, pressure_angle_deg=alpha)
    except ValueError:
        assume(False)
    thickness = 0.0
    for gear in (pair.pinion, pair.gear):
        rolling = gear.base_radius_mm / math.cos(pair.working_pressure_angle)
        involute = math.tan(pair.working_pressure_angle) - pair.working_pressure_angle
        thickness += 2 * rolling * (gear.base_half_angle - involute)
    pitch = 2 * math.pi * pair.centre_distance_mm / (z1 + z2)
    assert thickness == pytest.approx(pitch, rel=1e-12)
    if not (pair.pinion.undercut or pair.gear.undercut):
        assert pair.contact_ratio == pytest.approx(textbook_contact_ratio(pair), rel=1e-10)
    swapped = SpurPair(z2, z1, pinion_shift=x2, gear_shift=x1, pressure_angle_deg=alpha)
    assert swapped.contact_ratio == pytest.approx(pair.contact_ratio, rel=1e-12)


def envelope_of_rack(tooth: ToothProfile, travel: float) -> tuple[float, float]:
    """A fillet point another way: the curve parallel to the path of the tip arc's centre, at the arc's radius."""
    gear, m = tooth.gear, tooth.gear.module_mm
    r, rho = gear.pitch_radius_mm / m, gear.rack_tip_radius_mm / m
    angle = travel / r

    def turn(x: float, y: float) -> complex:  # from the fixed frame to the tooth's, complex x + i y
        return complex(x, y) * complex(math.cos(angle + math.pi / gear.teeth), math.sin(angle + math.pi / gear.teeth))

    centre_x, centre_y = travel + gear.rack_tip_offset_mm / m, r - gear.rack_tip_depth_mm / m
    # velocity of the centre as the gear sees it: the rack's motion less the gear's rotation
    along = turn(1 - centre_y / r, centre_x / r)
    normal = along / abs(along) * -1j
    if (normal * turn(0, 1).conjugate()).real > 0:
        normal = -normal
    point = turn(centre_x, centre_y) + rho * normal
    return point.imag, -point.real


PAIRS = (
    SpurPair(),
    SpurPair(gear_teeth=54, tip_radius=0.2),
    SpurPair(pinion_teeth=20, pinion_shift=0.3, gear_shift=-0.1),
    SpurPair(pinion_teeth=18, pressure_angle_deg=25.0, tip_radius=0.15),
)


@pytest.mark.parametrize("pair", PAIRS)
def test_fillet_is_the_envelope_of_the_rack(pair: SpurPair) -> None:
    for gear in (pair.pinion, pair.gear):
        tooth = ToothProfile(gear)
        m = gear.module_mm
        depth, offset = gear.rack_tip_depth_mm / m, gear.rack_tip_offset_mm / m
        for fraction in (0.05, 0.3, 0.7, 0.95):
            gamma = math.pi / 2 + (gear.pressure_angle - math.pi / 2) * fraction
            y, h, _, _ = tooth.fillet(fraction)
            assert envelope_of_rack(tooth, depth / math.tan(gamma) - offset) == pytest.approx((y, h), rel=1e-12)


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("root", ["trochoid", "straight", "base_circle"])
def test_outline_is_one_curve(pair: SpurPair, root: str) -> None:
    for gear in (pair.pinion, pair.gear):
        tooth = ToothProfile(gear, root)
        y, h, dy, dh = tooth.fillet(np.array([0.0, 1.0]))
        first = tooth.involute(tooth.first_roll)
        assert np.hypot(y[0], h[0]) == pytest.approx(tooth.clamp_radius, rel=1e-13)
        assert math.atan2(h[0], y[0]) == pytest.approx(tooth.clamp_half_angle, rel=1e-12)
        assert (y[1], h[1]) == pytest.approx(first[:2], rel=1e-13)
        if root == "trochoid":  # no corner where the fillet meets the involute, nor at the root circle
            assert dh[1] * first[2] == pytest.approx(dy[1] * first[3], rel=1e-9)
            assert y[0] * dy[0] + h[0] * dh[0] == pytest.approx(0.0, abs=1e-12)
        for curve, ends in ((tooth.fillet, (0.0, 1.0)), (tooth.involute, (tooth.first_roll, 0.45))):
            for k in (0, 1):
                length = quad(lambda s, k=k, curve=curve: float(curve(s)[2 + k]), *ends, epsabs=1e-13)[0]
                assert length == pytest.approx(float(curve(ends[1])[k] - curve(ends[0])[k]), abs=1e-11)


def half_angle_left(pair: SpurPair, gear: SpurGear, radius: float) -> float:
    """Half the tooth's angle at a radius in modules that the rack leaves, by trying its outline at 20 000 places."""
    alpha, z, h_f = math.radians(pair.pressure_angle_deg), gear.teeth, pair.addendum + pair.clearance
    rho = pair.rack_tip_radius
    turn = np.linspace(-1.4, 1.4, 20_001)

    def inside(angle: float) -> bool:
        """Whether a point of the tooth is inside the rack's tooth beside it at any place."""
        x = radius * np.sin(turn + angle) - z / 2 * turn + math.pi / 2  # from the centre line of the rack's tooth
        depth = z / 2 + gear.shift - radius * np.cos(turn + angle)  # below the rack's reference line
        half = math.pi / 4 - depth * math.tan(alpha)
        centre = h_f - rho
        offset = math.pi / 4 - centre * math.tan(alpha) - rho / math.cos(alpha)
        arc = offset + np.sqrt(np.clip(rho**2 - (depth - centre) ** 2, 0.0, None))
        width = np.where(depth > h_f - rho * (1 - math.sin(alpha)), arc, half)
        return bool(np.any((np.abs(x) < width) & (depth < h_f)))

    low, high = -math.pi / z, 0.0  # the space's centre line, the tooth's
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if inside(middle) else (low, middle)
    return -high


FZG_A = SpurPair(16, 24, module_mm=4.5, face_width_mm=20.0, pinion_shift=0.8532, gear_shift=-0.5)
UNDERCUT = (
    SpurPair(10, 80),
    SpurPair(17, 43),
    SpurPair(12, 34, pressure_angle_deg=17.0),
    SpurPair(14, 30, tip_radius=0.1),
    FZG_A,
)


@pytest.mark.parametrize("pair", UNDERCUT)
def test_an_undercut_tooth_is_what_the_rolling_rack_leaves(pair: SpurPair) -> None:
    gear = min(pair.pinion, pair.gear, key=lambda each: each.shift + each.teeth / 100)
    assert gear.undercut
    tooth, m = ToothProfile(gear), gear.module_mm
    y, h, _, _ = tooth.fillet(np.array([0.3, 0.7, 0.95, 1.0]))
    roll = tooth.first_roll + np.array([1e-3, 0.05, 0.2])
    y, h = (np.concatenate([fillet, flank]) for fillet, flank in zip((y, h), tooth.involute(roll)[:2], strict=True))
    left = [half_angle_left(pair, gear, float(radius)) for radius in np.hypot(y, h)]
    assert left == pytest.approx(np.arctan2(h, y), abs=2e-6)
    assert tooth.involute(tooth.first_roll)[:2] == pytest.approx(tooth.fillet(1.0)[:2], abs=1e-12)
    below = 0.5 * (gear.base_radius_mm + gear.form_circle_mm) / m  # the involute that was there has gone
    whole = gear.base_half_angle - math.tan(math.acos(gear.base_radius_mm / m / below))
    whole += math.acos(gear.base_radius_mm / m / below)
    assert half_angle_left(pair, gear, below) < whole


@pytest.mark.parametrize("pair", UNDERCUT)
def test_contact_of_an_undercut_gear_begins_where_its_involute_does(pair: SpurPair) -> None:
    """Along the line of action from the pinion's tangent point, each end the nearer of tip and form circle."""
    length, pitch = pair.line_of_action_mm, math.pi * pair.module_mm * math.cos(pair.pressure_angle)
    reach = [math.sqrt(each.tip_circle_mm**2 - each.base_radius_mm**2) for each in (pair.pinion, pair.gear)]
    form = [math.sqrt(each.form_circle_mm**2 - each.base_radius_mm**2) for each in (pair.pinion, pair.gear)]
    path = min(reach[0], length - form[1]) - max(length - reach[1], form[0])
    assert pair.contact_ratio == pytest.approx(path / pitch, rel=1e-12)
    assert 1.0 < pair.contact_ratio <= textbook_contact_ratio(pair) + 1e-12


def test_cases_that_the_standards_have() -> None:
    assert FZG_A.centre_distance_mm == pytest.approx(91.5, abs=1e-3)
    assert FZG_A.gear.undercut and FZG_A.contact_ratio == pytest.approx(textbook_contact_ratio(FZG_A), rel=1e-12)
    nearly = SpurPair(17, 43)  # undercut by a hair, where nothing is in contact
    assert nearly.pinion.undercut and round(nearly.contact_ratio, 4) == 1.6211
    assert SpurPair(10, 80).contact_ratio < textbook_contact_ratio(SpurPair(10, 80)) - 0.2


def test_undercut_comes_on_without_a_step() -> None:
    """At the shift where the rack's tip first reaches the involute, both ways of making the fillet are one."""
    limit = 1.0 - 12 * math.sin(math.radians(20)) ** 2 / 2
    one, other = (SpurPair(12, 44, pinion_shift=limit + step).pinion for step in (1e-7, -1e-7))
    assert other.undercut and not one.undercut
    assert one.form_circle_mm == pytest.approx(other.form_circle_mm, rel=1e-6)
    curves = [ToothProfile(each).fillet(np.linspace(0, 1, 9)) for each in (one, other)]
    assert curves[0][0] == pytest.approx(curves[1][0], abs=2e-3) and curves[0][1] == pytest.approx(
        curves[1][1], abs=2e-3
    )


def test_involute_has_the_thickness_of_iso_21771() -> None:
    pair = SpurPair(pinion_shift=0.25)
    gear = pair.pinion
    tooth = ToothProfile(gear)
    y, h, _, _ = tooth.involute(math.tan(math.radians(20)))
    assert np.hypot(y, h) == pytest.approx(17.0, rel=1e-13)
    thickness = 2 * 17.0 * math.atan2(h, y)
    assert thickness == pytest.approx(math.pi / 2 + 2 * 0.25 * math.tan(math.radians(20)), rel=1e-12)


BAD = [
    ({"pinion_teeth": 8, "gear_teeth": 80}, "contact ratio is 0.91"),
    (
        {"pinion_teeth": 6, "pinion_shift": -0.6, "addendum": 1.3},
        "pinion_teeth = 6 with pinion_shift = -0.6 is undercut so far",
    ),
    (
        {"pinion_teeth": 14, "gear_teeth": 67, "pinion_shift": -0.37, "gear_shift": -0.19},
        "interference: the gear's tip runs into the undercut root of the pinion",
    ),
    ({"addendum": 0.55, "clearance": 0.2}, "contact ratio is 0.9"),
    (
        {"bore_ratio": 0.95},
        "bore_ratio = 0.95 puts the pinion's bore at or beyond its root circle: it must be below 0.926",
    ),
    ({"pinion_teeth": 12, "pinion_shift": 1.2}, "the pinion's teeth are pointed: thickness at the tip is -"),
    ({"tip_radius": 0.6}, "tip_radius = 0.6 modules does not fit the rack's tip: it must be at most 0.4"),
    ({"addendum": 2.0}, "addendum + clearance = 2.25 makes the rack's tooth pointed: it must be below 2.15"),
    ({"tip_radius": 0.45, "gear_teeth": 400}, "interference: the gear's tip meets the pinion"),
    (
        {"clearance": 0.05, "pinion_shift": 0.6, "gear_shift": 0.6},
        "the pinion's tip circle reaches the gear's root circle",
    ),
    (
        {"pinion_teeth": 100, "gear_teeth": 100, "pinion_shift": -2.1, "gear_shift": -2.0},
        "pinion_shift + gear_shift must be above",
    ),
    ({"module_mm": -3.0}, "module_mm must be a finite number above 0, got -3.0"),
    ({"face_width_mm": 0.0}, "face_width_mm must be a finite number above 0, got 0.0"),
    ({"addendum": -1.0}, "addendum must be a finite number above 0, got -1.0"),
    ({"clearance": -0.1}, "clearance must be a finite number above 0, got -0.1"),
    ({"tip_radius": -0.1}, "tip_radius must be a finite number at least 0, got -0.1"),
    ({"tip_shortening": -0.1}, "tip_shortening must be a finite number at least 0, got -0.1"),
    ({"bore_ratio": -0.1}, "bore_ratio must be a finite number at least 0, got -0.1"),
    ({"gear_bore_ratio": 0.95}, "gear_bore_ratio = 0.95 puts the gear's bore at or beyond its root circle"),
    ({"gear_face_width_mm": 0.0}, "gear_face_width_mm must be a finite number above 0, got 0.0"),
    ({"youngs_modulus_gpa": -1.0}, "youngs_modulus_gpa must be a finite number above 0, got -1.0"),
    ({"poisson_ratio": 0.5}, "poisson_ratio must be a finite number above 0 and below 0.5, got 0.5"),
    ({"poisson_ratio": 0.0}, "poisson_ratio must be a finite number above 0 and below 0.5, got 0.0"),
    ({"pressure_angle_deg": 90.0}, "pressure_angle_deg must be a finite number above 0 and below 90, got 90.0"),
    ({"pinion_teeth": 34.5}, "pinion_teeth must be a whole number of at least 3, got 34.5"),
    ({"gear_teeth": -34}, "gear_teeth must be a whole number of at least 3, got -34"),
    ({"gear_shift": math.nan}, "gear_shift must be a finite number, got nan"),
    ({"pinion_shift": "0.1"}, "pinion_shift must be a finite number, got '0.1'"),
]


@pytest.mark.parametrize(("changes", "sentence"), BAD, ids=[str(changes) for changes, _ in BAD])
def test_bad_input_gets_its_sentence(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=re.escape(sentence)):
        SpurPair(**changes)


def test_a_rack_without_room_for_its_arc_gets_a_round_tip() -> None:
    pair = SpurPair(pressure_angle_deg=25.0)
    assert pair.rack_tip_radius < 0.25 / (1 - math.sin(math.radians(25)))
    assert pair.pinion.root_half_angle == pytest.approx(math.pi / 34, rel=1e-12)


def test_pair_is_frozen_and_replaced() -> None:
    pair = SpurPair()
    with pytest.raises(AttributeError):
        pair.module_mm = 2.0  # type: ignore[misc]
    assert pair.replace(module_mm=2.0) == SpurPair(module_mm=2.0)
    assert pair.replace(gear_teeth=54).gear.teeth == 54
    assert hash(pair) == hash(SpurPair())
