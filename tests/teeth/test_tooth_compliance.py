"""One tooth and its gear body: the same integrals in other forms, and identities."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from gearpair.teeth import gear_body
from gearpair.teeth.compliance import (
    foundation_coefficients,
    foundation_compliance,
    root_load,
    tooth_compliance,
)
from gearpair.teeth.gear_body import ring_compliance
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.tooth_profile import ToothProfile
from tests.support.teeth import NU, rolls_in_contact

# --- one tooth: other forms of the same integrals -------------------------------------------------


def angle_form(tooth: ToothProfile, roll: float) -> tuple[float, float, float]:
    """Bending, shear and axial compliance as Liang, Zuo and Patel (2014) write them, by angles on the base circle."""
    half = tooth.gear.base_half_angle
    a1 = roll - half
    ratio = tooth.root_radius / tooth.base_radius
    last = half  # the involute begins on the base circle, or where the root circle cuts it
    if ratio > 1:
        last = half - math.sqrt(ratio**2 - 1)

    def thickness(a: float) -> float:
        return math.sin(a) + (half - a) * math.cos(a)

    def bend(a: float) -> float:
        arm = 1 + math.cos(a1) * ((half - a) * math.sin(a) - math.cos(a))
        return 3 * arm**2 * (half - a) * math.cos(a) / (2 * thickness(a) ** 3)

    def narrow(a: float) -> float:
        return (half - a) * math.cos(a) / thickness(a)

    bending = quad(bend, -a1, last, epsabs=1e-13, epsrel=1e-12)[0]
    narrowing = quad(narrow, -a1, last, epsabs=1e-13, epsrel=1e-12)[0]
    if tooth.root == "straight" and ratio < 1:
        foot = math.asin(math.sin(half) / ratio)
        depth = ratio * math.cos(foot)
        upper, lower = (1 - depth * math.cos(a1)) ** 3, (1 - math.cos(a1) * math.cos(half)) ** 3
        bending += (upper - lower) / (2 * math.cos(a1) * math.sin(half) ** 3)
        narrowing += (math.cos(half) - depth) / math.sin(half)
    return (
        bending,
        1.2 * (1 + NU) * math.cos(a1) ** 2 * narrowing,
        math.sin(a1) ** 2 * narrowing / 2,
    )


def coordinate_form(tooth: ToothProfile, roll: float) -> tuple[float, float, float]:
    """The same by y along the tooth, with the issue's moment: cos(a1) (y_C - y) - sin(a1) h_C."""
    a1 = roll - tooth.gear.base_half_angle
    y_load, h_load, _, _ = (float(value) for value in tooth.involute(roll))
    start, join = float(tooth.fillet(0.0)[0]), float(tooth.involute(tooth.first_roll)[0])

    def half_thickness(y: float) -> float:
        curve, ends = (tooth.fillet, (0.0, 1.0)) if y < join else (tooth.involute, (tooth.first_roll, roll))
        if y <= float(curve(ends[0])[0]):
            return float(curve(ends[0])[1])
        if y >= float(curve(ends[1])[0]):
            return float(curve(ends[1])[1])
        return float(curve(brentq(lambda s: float(curve(s)[0]) - y, *ends, xtol=1e-15))[1])

    def bend(y: float) -> float:
        moment = math.cos(a1) * (y_load - y) - math.sin(a1) * h_load
        return moment**2 / (2 * half_thickness(y) ** 3 / 3)

    pieces = [(start, join), (join, y_load)] if join > start + 1e-12 else [(start, y_load)]

    def total(function) -> float:
        return sum(quad(function, *ends, epsabs=1e-11, epsrel=1e-11, limit=200)[0] for ends in pieces)

    narrowing = total(lambda y: 1 / (2 * half_thickness(y)))
    shear_modulus = 1 / (2 * (1 + NU))
    return total(bend), 1.2 * math.cos(a1) ** 2 / shear_modulus * narrowing, math.sin(a1) ** 2 * narrowing


@pytest.mark.parametrize("teeth", [20, 34, 54])
@pytest.mark.parametrize("root", ["straight", "base_circle"])
def test_components_against_the_angle_form(teeth: int, root: str) -> None:
    pair = SpurPair(gear_teeth=teeth)
    tooth = ToothProfile(pair.gear, root)
    for roll in rolls_in_contact(pair, "gear", np.linspace(0.0, pair.contact_ratio, 7)):
        assert tooth_compliance(tooth, roll, NU) == pytest.approx(angle_form(tooth, roll), rel=1e-9)


@pytest.mark.parametrize("pair", [SpurPair(), SpurPair(20, 54, pinion_shift=0.3, gear_shift=-0.1, tip_radius=0.2)])
@pytest.mark.parametrize("root", ["trochoid", "straight"])
@pytest.mark.slow
def test_components_against_the_coordinate_form(pair: SpurPair, root: str) -> None:
    for who in ("pinion", "gear"):
        tooth = ToothProfile(getattr(pair, who), root)
        for roll in rolls_in_contact(pair, who, np.linspace(0.0, pair.contact_ratio, 3)):
            assert tooth_compliance(tooth, roll, NU) == pytest.approx(coordinate_form(tooth, roll), rel=1e-9)


def test_foundation_against_the_formula_written_out() -> None:
    tooth = ToothProfile(SpurPair().pinion)
    theta, h, r_f = tooth.clamp_half_angle, (17 - 1.25) / (0.3 * 17), 17 - 1.25

    def fit(a: float, b: float, c: float, d: float, e: float, f: float) -> float:
        return a / theta**2 + b * h**2 + c * h / theta + d / theta + e * h + f

    linear = fit(-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045)
    mixed = fit(60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086)
    shear = fit(-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236)
    thrust = fit(-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904)
    assert foundation_coefficients(theta, h) == pytest.approx((linear, mixed, shear, thrust), rel=1e-12)
    roll = math.tan(math.radians(20))
    a1 = roll - tooth.gear.base_half_angle
    u, s = 17 * math.cos(math.radians(20)) / math.cos(a1) - r_f, 2 * r_f * theta
    by_hand = math.cos(a1) ** 2 * (linear * (u / s) ** 2 + mixed * u / s + shear * (1 + thrust * math.tan(a1) ** 2))
    assert float(foundation_compliance(tooth, roll)) == pytest.approx(by_hand, rel=1e-12)


# --- the gear body -------------------------------------------------------------------------------


def test_ring_twists_and_shrinks_as_a_whole_ring() -> None:
    # loads on very narrow arcs all round the rim: only the closed forms for n = 0 are left of the mean
    h, n = 2.5, 1024
    mean = ring_compliance(h, 1e-4, 2 * math.pi / n * np.arange(n), NU, n_harmonics=400).mean(axis=0)
    twist = (1 + NU) / (2 * math.pi) * (h**2 - 1)
    inner = 1 / h**2
    shrink = (1 - inner) * (1 - NU**2) / (2 * math.pi * ((1 + inner) + NU * (1 - inner)))
    assert mean[0, 0] == pytest.approx(twist, rel=1e-6)
    assert mean[1, 1] == pytest.approx(shrink, rel=1e-6)


@pytest.mark.parametrize(("h", "twist"), [(3.0, True), (3.0, False), (math.inf, False)])
def test_ring_is_reciprocal_and_passive(h: float, twist: bool) -> None:
    angles = 2 * math.pi / 34 * np.arange(34)
    blocks = ring_compliance(h, 0.0886, angles, NU, twist=twist)
    back = ring_compliance(h, 0.0886, -angles, NU, twist=twist)
    assert back == pytest.approx(np.swapaxes(blocks, 1, 2), rel=1e-9, abs=1e-12)
    whole = np.block([[blocks[(i - j) % 34] for j in range(34)] for i in range(34)])
    assert np.linalg.eigvalsh(whole).min() > -1e-9


def test_twist_is_that_of_a_ring_between_bore_and_rim() -> None:
    """Of a force along the line of action: r_b^2 / (4 pi G b) (1 / r_i^2 - 1 / r_f^2), for every tooth alike."""
    tooth = ToothProfile(SpurPair().pinion)
    load = root_load(tooth, np.array([0.25, 0.4]))
    angles = 2 * math.pi / 34 * np.arange(3)
    free, held = (
        ring_compliance(tooth.radius_ratio, tooth.clamp_half_angle, angles, NU, twist=each) for each in (False, True)
    )
    bore = 0.3 * 17
    turn = tooth.base_radius**2 * 2 * (1 + NU) / (4 * math.pi) * (1 / bore**2 - 1 / tooth.clamp_radius**2)
    assert load @ (held - free) @ load.T == pytest.approx(np.full((3, 2, 2), turn), rel=1e-12)


def test_body_of_a_large_gear_yields_with_the_logarithm_of_its_teeth() -> None:
    """Each factor e adds 2 / pi, as the displacement of a half-plane grows with the depth at which it is held."""
    rings = [ring_compliance(3.0, 1.5 / teeth, 0.0, NU, twist=False) for teeth in (1500, 3000, 10**6)]
    for k, ratio in enumerate((2.0, 1e6 / 3000)):
        assert np.diag(rings[k + 1] - rings[k])[:2] == pytest.approx(2 / math.pi * math.log(ratio), rel=1e-4)


def test_groups_of_orders_stand_for_their_terms(monkeypatch: pytest.MonkeyPatch) -> None:
    angles = np.array([0.0, 0.0044])
    grouped = ring_compliance(3.0, 0.002, angles, NU)
    monkeypatch.setattr(gear_body, "_orders", lambda *_: (np.arange(18_001.0), np.ones(18_001)))
    each = ring_compliance(3.0, 0.002, angles, NU)
    assert grouped[..., :2, :2] == pytest.approx(each[..., :2, :2], rel=1e-4, abs=1e-5)
    assert grouped == pytest.approx(each, rel=1e-3, abs=1e-3)


def test_solid_disc_by_its_energy() -> None:
    """The order 1 of a disc that uniform forces balance: quadratic displacements, by Ritz's method in x and y.

    u_x = a x^2 + b y^2 - (a + b) / 4, u_y = c x y; integrals of x^2 and y^2 over the unit disc are pi / 4.
    """
    plane, shear = 1 / (1 - NU**2), 1 / (2 * (1 + NU))
    stiff = np.array(
        [[4 * plane, 0, 2 * NU * plane], [0, 4 * shear, 2 * shear], [2 * NU * plane, 2 * shear, plane + shear]]
    )
    theta = 2 * math.pi / 64 * np.arange(64)
    cos, sin = np.cos(theta), np.sin(theta)
    moves = np.array([[cos**2 - 0.25, 0 * cos], [sin**2 - 0.25, 0 * cos], [0 * cos, cos * sin]])
    radial, along = moves[:, 0] * cos + moves[:, 1] * sin, moves[:, 1] * cos - moves[:, 0] * sin
    parts = np.stack([radial @ cos, along @ sin], axis=1) / 32  # (u_r, u_theta) of each displacement at order 1
    expected = math.pi * parts.T @ np.linalg.solve(math.pi / 4 * stiff, parts)
    found = gear_body._ring_harmonics(math.inf, NU, np.arange(4.0), twist=False)[1]
    assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("order", [0, 2, 3, 9])
def test_small_bore_is_the_solid_disc_at_the_other_orders(order: int) -> None:
    small, solid = (gear_body._ring_harmonics(h, NU, np.arange(12.0), twist=False)[order] for h in (1e4, math.inf))
    assert small == pytest.approx(solid, rel=1e-6)


def test_ring_series_has_converged() -> None:
    short, long = (ring_compliance(3.0, 0.0886, [0.0, 0.185], NU, n_harmonics=n) for n in (400, 2400))
    assert short[1] == pytest.approx(long[1], rel=1e-3)
    assert short[0, :2, :2] == pytest.approx(long[0, :2, :2], rel=2e-4, abs=1e-9)


@pytest.mark.parametrize(("half_angle", "h"), [(0.03, 3.0), (0.06, 4.0), (0.1, 5.0), (0.0886, 3.088)])
def test_ring_finds_the_foundation_coefficients_of_shear_and_thrust(half_angle: float, h: float) -> None:
    # P* and P* Q* of Sainsot's fit, found again from the ring without any of its numbers (an independent check of
    # the table); L* and M*, which weight the small moment terms, differ by up to 20 % and 45 %
    own = ring_compliance(h, half_angle, 0.0, NU)
    _, _, shear, thrust = foundation_coefficients(half_angle, h)
    assert own[0, 0] == pytest.approx(shear, rel=0.02)
    assert own[1, 1] == pytest.approx(shear * thrust, rel=0.06)
