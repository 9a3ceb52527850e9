"""The mesh's stiffness: sums over pairs, identities, the standard."""

import re

import numpy as np
import pytest
from scipy.optimize import brentq

from gearpair.stiffness import StiffnessWave
from gearpair.teeth.compliance import (
    foundation_compliance,
    hertz_compliance,
    tooth_compliance,
)
from gearpair.teeth.iso6336 import iso_stiffness, tooth_flexibility
from gearpair.teeth.meshing import mesh_stiffness
from gearpair.teeth.spurgear import Material
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.tooth_profile import ToothProfile
from tests.support.teeth import NU, rolls_in_contact

THREE_PAIRS = SpurPair(pinion_teeth=40, gear_teeth=60, addendum=1.3, clearance=0.2, tip_radius=0.1)


# --- the mesh ------------------------------------------------------------------------------------


@pytest.mark.parametrize("root", ["trochoid", "straight", "base_circle"])
@pytest.mark.parametrize("foundation", [True, False])
def test_mesh_curve_is_the_sum_of_the_pairs(root: str, foundation: bool) -> None:
    pair = SpurPair(gear_teeth=44)
    result = mesh_stiffness(pair, root=root, foundation=foundation, n_phases=50)
    unit = 206.8e9 * 0.020
    for phase, stiffness, count in zip(result.phase, result.stiffness_n_per_m, result.pairs_in_contact, strict=True):
        total = 0.0
        for position in phase + np.arange(count):
            compliance = hertz_compliance(NU)
            for who in ("pinion", "gear"):
                tooth = ToothProfile(getattr(pair, who), root)
                roll = rolls_in_contact(pair, who, position)
                compliance += sum(tooth_compliance(tooth, roll, NU))
                compliance += foundation_compliance(tooth, roll) if foundation else 0.0
            total += unit / compliance
        assert stiffness == pytest.approx(total, rel=1e-12)


def test_contact_once_per_pair_in_si() -> None:
    # k_h = pi E b / (4 (1 - nu^2)) = pi 206.8e9 0.020 / 3.64
    contact = mesh_stiffness(SpurPair(), n_phases=2).compliance_m_per_n["hertz"]
    assert 1 / contact == pytest.approx(3.569678e9, rel=1e-6)


def test_result_is_consistent() -> None:
    result = mesh_stiffness(SpurPair(gear_teeth=54), coupling="ring", n_phases=400)
    ratio = result.contact_ratio
    assert result.path[0] == 0.0 and result.path[-1] == ratio
    assert sum(result.compliance_m_per_n.values()) == pytest.approx(1 / result.pair_stiffness_n_per_m, rel=1e-13)
    assert set(result.compliance_m_per_n) == {
        "hertz",
        *(f"{who}_{part}" for who in ("pinion", "gear") for part in ("bending", "shear", "axial", "foundation")),
    }
    assert result.load_share.sum(axis=0) == pytest.approx(1.0, rel=1e-13)
    assert (result.load_share > 0).sum(axis=0).tolist() == result.pairs_in_contact.tolist()
    assert ((result.pairs_in_contact == 2) == (result.phase < ratio - 1)).all()  # the double zone comes first
    zone = np.where(result.phase < ratio - 1, 0, 1)
    curve = np.array([result.zones[z](p) for z, p in zip(zone, result.phase, strict=True)])
    assert curve == pytest.approx(result.stiffness_n_per_m, rel=1e-12)


@pytest.mark.slow
def test_means_are_those_of_the_curve() -> None:
    result = mesh_stiffness(SpurPair(), coupling="ring", n_phases=100_000)
    assert result.mean == pytest.approx(result.stiffness_n_per_m.mean(), rel=1e-5)
    double = result.stiffness_n_per_m[result.pairs_in_contact == 2].mean()
    assert result.zone_means[0] == pytest.approx(double, rel=1e-6)


@pytest.mark.parametrize("coupling", ["summed", "ring"])
@pytest.mark.parametrize("teeth", [34, 44, 54])
def test_rectangle_has_mean_one(coupling: str, teeth: int) -> None:
    result = mesh_stiffness(SpurPair(gear_teeth=teeth), coupling=coupling)
    rectangle = result.rectangular()
    eps, a, b = rectangle.contact_ratio, rectangle.a, rectangle.b
    assert eps == result.pair.contact_ratio
    assert a * (eps - 1) == pytest.approx(b * (2 - eps), rel=1e-12)
    printed = StiffnessWave.rectangular(eps, a, b)
    assert printed.mean == pytest.approx(1.0, abs=1e-14)
    assert result.wave(2).edges == pytest.approx(printed.edges, rel=1e-14)
    assert result.wave(2).levels == pytest.approx(printed.levels, rel=1e-12)


def test_staircase_becomes_the_curve() -> None:
    result = mesh_stiffness(SpurPair(gear_teeth=54), n_phases=997)
    errors = []
    for n in (20, 40, 80):
        wave = result.wave(n)
        assert len(wave.levels) == n
        assert wave.mean == pytest.approx(1.0, abs=1e-13)
        assert result.contact_ratio - 1 in wave.edges
        errors.append(np.abs(wave(result.phase) * result.mean / result.stiffness_n_per_m - 1).max())
    assert errors[2] < 0.01
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(1.0, abs=0.15)  # a staircase is of first order


def test_truncated_wave_keeps_its_first_harmonics_and_no_others() -> None:
    wave = mesh_stiffness(SpurPair(gear_teeth=54)).wave(400)
    for n_levels, n in ((40, 1), (40, 2), (400, 6)):
        kept = wave.truncated(n, n_levels)
        m = np.arange(1, 7)
        # each harmonic kept up to the factor sinc(m / n_levels)^2, and none from n + 1 to n_levels - n - 1
        expected = np.where(m <= n, wave.harmonics(6)[1:] * np.sinc(m / n_levels) ** 2, 0.0)
        assert kept.mean == pytest.approx(wave.mean, rel=1e-14)
        assert kept.harmonics(6)[1:] == pytest.approx(expected, abs=1e-14)


def test_truncated_wave_refuses_what_it_cannot_make() -> None:
    spike = StiffnessWave((0.0, 0.1), (10.0, 0.1))
    with pytest.raises(ValueError, match=r"levels\[\d+\] must be a finite number above 0"):
        spike.truncated(1)
    with pytest.raises(ValueError, match="n_levels must be a whole number of at least 7, got 6"):
        spike.truncated(3, 6)


@pytest.mark.parametrize("coupling", ["summed", "ring"])
def test_equal_gears_give_a_curve_that_reads_the_same_backwards(coupling: str) -> None:
    result = mesh_stiffness(SpurPair(), coupling=coupling)
    for zone in result.zones:
        left, right = zone.domain
        at = np.linspace(left, right, 9)
        assert zone(at) == pytest.approx(zone(at)[::-1], rel=1e-12)


@pytest.mark.parametrize("coupling", ["summed", "ring"])
def test_driving_by_the_other_gear_reads_the_curve_backwards(coupling: str) -> None:
    one = mesh_stiffness(SpurPair(34, 54, pinion_shift=0.2), coupling=coupling)
    other = mesh_stiffness(SpurPair(54, 34, gear_shift=0.2), coupling=coupling)
    for zone, mirrored in zip(one.zones, other.zones, strict=True):
        assert zone(np.linspace(*zone.domain, 9)) == pytest.approx(
            mirrored(np.linspace(*zone.domain, 9))[::-1], rel=1e-11
        )


@pytest.mark.parametrize("coupling", ["summed", "ring"])
@pytest.mark.parametrize("pair", [SpurPair(), THREE_PAIRS, SpurPair(pinion_shift=0.3)])
def test_stiffness_per_width_does_not_depend_on_the_module(coupling: str, pair: SpurPair) -> None:
    small = mesh_stiffness(pair, coupling=coupling, n_phases=50)
    large = mesh_stiffness(pair.replace(module_mm=12.5, face_width_mm=50.0), coupling=coupling, n_phases=50)
    assert large.stiffness_n_per_m / 50 == pytest.approx(small.stiffness_n_per_m / 20, rel=1e-12)
    stiffer = mesh_stiffness(pair.replace(youngs_modulus_gpa=413.6), coupling=coupling, n_phases=50)
    assert stiffer.mean == pytest.approx(2 * small.mean, rel=1e-12)


def test_three_pairs_in_contact() -> None:
    for coupling in ("summed", "ring"):
        result = mesh_stiffness(THREE_PAIRS, coupling=coupling, n_phases=200)
        assert 2.0 < result.contact_ratio < 3.0
        assert set(result.pairs_in_contact.tolist()) == {2, 3}
        assert result.pairs_in_contact[0] == 3
        assert result.load_share.shape == (3, 200)
        assert result.wave(30).mean == pytest.approx(1.0, abs=1e-13)
        with pytest.raises(ValueError, match=r"no two-level wave of the article's form exists: contact_ratio is 2\.2"):
            result.rectangular()


def test_whole_contact_ratio_has_one_zone() -> None:
    def ratio(addendum: float) -> float:
        return SpurPair(addendum=addendum, clearance=0.2, tip_radius=0.1).contact_ratio

    addendum = brentq(lambda value: ratio(value) - 2.0, 1.0, 1.35, xtol=1e-15)
    result = mesh_stiffness(SpurPair(addendum=addendum, clearance=0.2, tip_radius=0.1), n_phases=20)
    assert len(result.zones) == 1
    assert result.wave(1).levels == pytest.approx([1.0], rel=1e-13)
    assert result.wave(7).mean == pytest.approx(1.0, rel=1e-13)
    with pytest.raises(ValueError, match="no two-level wave"):
        result.rectangular()


def per_width(pair: SpurPair, coupling: str) -> float:
    """Mean stiffness in N/(mm um)."""
    return mesh_stiffness(pair, coupling=coupling, n_phases=2).mean * 1e-6 / pair.contact_width_mm


@pytest.mark.parametrize(
    "pair", [SpurPair(), THREE_PAIRS, SpurPair(20, 57, pinion_bore_ratio=0.2, gear_bore_ratio=0.5)]
)
def test_clamping_the_bores_puts_their_twist_in_series(pair: SpurPair) -> None:
    """A compliance that all pairs have in common: 1 / k grows by it, however many pairs are in contact."""
    ring, clamped = (mesh_stiffness(pair, coupling=each, n_phases=200) for each in ("ring", "clamped"))
    twist = sum(
        gear.base_radius_mm**2 * (1 / gear.bore_mm**2 - 1 / gear.root_circle_mm**2) for gear in (pair.pinion, pair.gear)
    )
    twist *= 2 * (1 + NU) / (4 * np.pi * 206.8e9 * 0.020)
    assert 1 / clamped.stiffness_n_per_m - 1 / ring.stiffness_n_per_m == pytest.approx(twist, rel=1e-9)


@pytest.mark.parametrize(
    ("bore", "free", "clamped"), [(0.0, 22.93, None), (0.1, 19.33, 4.4), (0.3, 20.89, 15.19), (0.6, 24.18, 22.57)]
)
def test_mean_stiffness_over_the_bore(bore: float, free: float, clamped: float | None) -> None:
    """With the twist a small bore rules the mesh; without it the mean is within a quarter of ISO's 19.9."""
    pair = SpurPair(bore_ratio=bore)
    assert per_width(pair, "ring") == pytest.approx(free, abs=0.01)
    if clamped is None:
        with pytest.raises(ValueError, match="holds each body at its bore, and the pinion is solid: take 'ring'"):
            mesh_stiffness(pair, coupling="clamped")
    else:
        assert per_width(pair, "clamped") == pytest.approx(clamped, abs=0.01)


def test_stiffness_without_twist_hardly_depends_on_the_bore() -> None:
    means = [per_width(SpurPair(bore_ratio=bore), "ring") for bore in np.linspace(0.05, 0.6, 12)]
    assert np.all(np.diff(means) > 0.0) and means[-1] < 1.31 * means[0]


def test_large_gears_are_nearly_racks() -> None:
    """From 60 teeth on the body's logarithm wins over the stiffer teeth; slowly, and without an end."""
    means = [per_width(SpurPair(28, z), "ring") for z in (60, 100, 200, 290, 310, 500, 1000, 2000, 3000)]
    assert np.all(np.diff(means) < 0.0) and means[-1] > 0.8 * means[0]
    summed = [per_width(SpurPair(28, z), "summed") for z in (310, 500, 1000, 2000, 3000, 30_000)]
    assert np.all(np.diff(summed) < 0.0) and summed[-1] > 0.85 * summed[0]


def test_each_gear_has_its_own_body_and_material() -> None:
    """What yields, gear by gear, is that of pairs whose two gears have it."""
    plastic = Material(youngs_modulus_gpa=3.1, poisson_ratio=0.35, density_kg_m3=1410.0)
    mixed = SpurPair(
        28, 57, pinion_bore_ratio=0.2, gear_bore_ratio=0.5, gear_material=plastic, pinion_face_width_mm=25.0
    )
    steel = SpurPair(28, 57, bore_ratio=0.2)
    soft = SpurPair(28, 57, bore_ratio=0.5, youngs_modulus_gpa=3.1, poisson_ratio=0.35)
    found, one, other = (mesh_stiffness(pair, coupling="ring", n_phases=20) for pair in (mixed, steel, soft))
    for name, values in found.compliance_m_per_n.items():
        whole, half = one.compliance_m_per_n[name], other.compliance_m_per_n[name]
        expected = (whole + half) / 2 if name == "hertz" else whole if name.startswith("pinion") else half
        assert values == pytest.approx(expected, rel=1e-12), name
    # Hertz: k = pi E b / 4 with 2 / E = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2
    modulus = 2 / ((1 - 0.3**2) / 206.8e9 + (1 - 0.35**2) / 3.1e9)
    assert found.compliance_m_per_n["hertz"] == pytest.approx(4 / (np.pi * modulus * 0.020), rel=1e-12)


def test_contact_is_as_wide_as_the_narrower_gear() -> None:
    wide = SpurPair(face_width_mm=30.0, gear_face_width_mm=20.0)
    assert (wide.contact_width_mm, wide.pinion.face_width_mm, wide.gear.face_width_mm) == (20.0, 30.0, 20.0)
    assert mesh_stiffness(wide).mean == mesh_stiffness(SpurPair()).mean


def test_undercut_pinions_have_a_mesh_curve() -> None:
    cut = mesh_stiffness(SpurPair(10, 80), coupling="ring", n_phases=200)
    assert cut.path[-1] == pytest.approx(cut.contact_ratio) and np.all(cut.pair_stiffness_n_per_m > 0.0)
    whole = mesh_stiffness(SpurPair(10, 80, pinion_shift=0.42, gear_shift=-0.42), coupling="ring", n_phases=200)
    assert 0.5 < cut.mean / whole.mean < 1.0


def test_foundation_outside_its_fit_is_said() -> None:
    assert mesh_stiffness(SpurPair(), n_phases=2).outside_fit == ()
    result = mesh_stiffness(SpurPair(pinion_teeth=20), n_phases=2)
    assert len(result.outside_fit) == 1
    assert "the pinion's theta_f = 0.151" in result.outside_fit[0]
    assert "0.01 to 0.12" in result.outside_fit[0]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"root": "round"}, "root must be one of 'trochoid', 'straight', 'base_circle', got 'round'"),
        ({"coupling": "both"}, "coupling must be one of 'summed', 'ring', 'clamped', got 'both'"),
        ({"n_phases": 1}, "n_phases must be a whole number of at least 2, got 1"),
        ({"coupling": "ring", "foundation": False}, "coupling = 'ring' joins the teeth by their gear bodies"),
    ],
)
def test_bad_options_get_their_sentence(options: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=re.escape(sentence)):
        mesh_stiffness(SpurPair(), **options)


def test_too_few_levels_get_their_sentence() -> None:
    with pytest.raises(ValueError, match="n_levels must be a whole number of at least 2, got 1"):
        mesh_stiffness(SpurPair(), n_phases=2).wave(1)


# --- ISO 6336-1 ----------------------------------------------------------------------------------


def test_iso_values() -> None:
    iso = iso_stiffness(SpurPair(youngs_modulus_gpa=206.0))
    flexibility = 0.04723 + (0.15551 + 0.25791) / 34
    assert iso.theoretical == pytest.approx(1 / flexibility, rel=1e-12)
    assert iso.single == pytest.approx(0.8 / flexibility * (1 + 0.5 * (1.2 - 1.25)), rel=1e-12)
    assert iso.mesh == pytest.approx(iso.single * (0.75 * SpurPair().contact_ratio + 0.25), rel=1e-12)
    assert (round(iso.theoretical, 3), round(iso.single, 3), round(iso.mesh, 3)) == (16.838, 13.134, 19.837)
    # 20 N/(mm um), the value the standard allows for steel when nothing is computed, is near
    assert iso.mesh == pytest.approx(20.0, rel=0.05)


def test_iso_shifts_and_pressure_angle() -> None:
    pair = SpurPair(20, 50, pinion_shift=0.4, gear_shift=0.1, pressure_angle_deg=22.5, clearance=0.2)
    flexibility = (
        0.04723 + 0.15551 / 20 + 0.25791 / 50 - 0.00635 * 0.4 - 0.11654 * 0.4 / 20 - 0.00193 * 0.1
        - 0.24188 * 0.1 / 50 + 0.00529 * 0.16 + 0.00182 * 0.01
    )  # fmt: skip
    expected = 0.8 / flexibility * 1.0 * (1 - 0.02 * (20 - 22.5)) * 206.8 / 206.0
    iso = iso_stiffness(pair)
    assert iso.single == pytest.approx(expected, rel=1e-12)
    assert iso.mesh_n_per_m == pytest.approx(iso.mesh * 20e6, rel=1e-15)


@pytest.mark.parametrize(
    ("shifts", "sentence"),
    [
        ((0.0, 0.2), "the smaller gear's shift to be at least the larger one's, 0.2, got 0"),
        ((-0.25, -0.3), "from -0.5 to 2, got -0.55"),
    ],
)
def test_iso_outside_its_range(shifts: tuple[float, float], sentence: str) -> None:
    pair = SpurPair(60, 61, pinion_shift=shifts[0], gear_shift=shifts[1])
    with pytest.raises(ValueError, match=re.escape(sentence)):
        iso_stiffness(pair)


def test_iso_has_the_smaller_gear_first_whichever_drives() -> None:
    down, up = SpurPair(28, 57, pinion_shift=0.3), SpurPair(57, 28, gear_shift=0.3)
    for load in (None, 40.0):
        one, other = (iso_stiffness(pair, specific_load_n_per_mm=load) for pair in (down, up))
        assert (one.single, one.mesh) == pytest.approx((other.single, other.mesh), rel=1e-13)
    assert iso_stiffness(SpurPair(28, 57)).single == pytest.approx(13.66, abs=0.005)
    assert iso_stiffness(SpurPair(34, 34, gear_shift=0.2)) == iso_stiffness(SpurPair(34, 34, pinion_shift=0.2))


def test_iso_light_loads_and_unlike_materials() -> None:
    usual = iso_stiffness(SpurPair())
    assert iso_stiffness(SpurPair(), specific_load_n_per_mm=250.0) == usual
    light = iso_stiffness(SpurPair(), specific_load_n_per_mm=6.25)
    assert (light.single, light.mesh) == pytest.approx((usual.single / 2, usual.mesh / 2), rel=1e-12)
    iron = Material(youngs_modulus_gpa=100.0, poisson_ratio=0.25)
    mixed = iso_stiffness(SpurPair(gear_material=iron))
    assert mixed.single / usual.single == pytest.approx(2 * 100.0 / 306.8, rel=1e-12)


def test_iso_examples_of_others() -> None:
    """ISO/TR 6336-30:2017, example 1, a helical pair by its virtual teeth; and a spur pair of another's notes."""
    theoretical = 1 / tooth_flexibility(18.905, 114.543, 0.145, 0.0)
    single = 0.8 * theoretical * (1 + 0.5 * (1.2 - 1.4)) * np.cos(np.radians(15.8))
    assert theoretical == pytest.approx(17.85584, rel=1e-4)
    assert single == pytest.approx(12.37047, rel=1e-4)
    assert single * (0.75 * 1.54909 + 0.25) == pytest.approx(17.46485, rel=1e-4)
    assert tooth_flexibility(17, 43) == pytest.approx(0.062376, abs=1e-6)
    iso = iso_stiffness(SpurPair(17, 43, youngs_modulus_gpa=206.0))
    assert (iso.theoretical, iso.single, iso.mesh) == pytest.approx((16.032, 12.505, 18.330), abs=6e-4)
