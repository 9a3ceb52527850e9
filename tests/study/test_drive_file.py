"""A drive in a file: what is read from it, the same drive back from one that is written, a sentence for a bad one."""

import math
from pathlib import Path

import numpy as np
import pytest

import gearpair as gp
from gearpair.drive_file import ENTRIES, example, read_drive_file
from gearpair.teeth import GearBlank, Material, TipRelief, flank_tolerances

PAIRS = sorted((Path(__file__).parent / "pairs").glob("*.yml"))
LEAST = "pinion_teeth: 28\ngear_teeth: 57\nmodule_mm: 3\nface_width_mm: 25\n"
REST = "backlash_um: 100\ntransmission_error_um: 4\npinion_torque_nm: 120\n"
GIVEN = dict(pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=4.0, damping_ratio=0.05)
PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)


@pytest.fixture
def written(tmp_path):
    def write(text, name="pair.yml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_the_example_is_the_drive_of_the_library(written):
    path = written(example())
    assert gp.GearDrive.from_file(path) == gp.GearDrive.from_pair(PAIR, **GIVEN)
    assert gp.GearDrive.from_file(str(path)) == gp.GearDrive.from_file(written(LEAST + REST))


def test_the_example_shows_every_entry_once_and_its_defaults_change_nothing(written):
    lines = [line.removeprefix("# ").split(":")[0] for line in example().splitlines()]
    assert [name for name in lines if name in ENTRIES] == list(ENTRIES)
    defaults = "".join(f"{name}: {e.default}\n" for name, e in ENTRIES.items() if e.default is not None)
    left_out = ("transmission_error_covers",)  # goes with a measurement
    kept = "".join(f"{line}\n" for line in defaults.splitlines() if not line.startswith(left_out))
    assert gp.GearDrive.from_file(written(LEAST + REST + kept)) == gp.GearDrive.from_file(written(LEAST + REST))


@pytest.mark.parametrize("path", PAIRS, ids=lambda path: path.stem)
def test_a_drive_comes_back_from_the_file_that_it_writes(path, tmp_path):
    drive = gp.GearDrive.from_file(path)
    drive.to_file(tmp_path / "again.yml")
    again = gp.GearDrive.from_file(tmp_path / "again.yml")
    assert again == drive
    assert again.mesh == drive.mesh and again.relief == drive.relief
    assert [each.name for each in tmp_path.iterdir()] == ["again.yml"]


@pytest.mark.parametrize(
    "changes",
    [
        {"pinion_inertia_kg_m2": 3e-3, "damping_ratio": 1 / 30},
        {"error_harmonics": [(2, 1.0, 0.3)], "pinion_speed_rpm": 1e3},
        {"transmission_error_um": [(2, 1.0, 0.3)], "shaft_orders": [(28, 5.0), (57, 2.0, 0.1, 3)]},
        {"relief": TipRelief(5.0, 0.0, 0.4), "pinion_torque_nm": -30.0},
        {"pinion_blank": GearBlank(rim_mm=5.0, web_mm=4.0, hub_mm=2.0, density_kg_m3=7000.0)},
        {"gear_material": Material(youngs_modulus_gpa=3.0, poisson_ratio=0.35, density_kg_m3=1400.0)},
        {"coupling": "summed", "n_levels": 7, "pinion_tip_shortening": 0.05, "tip_radius": 0.2},
    ],
)
def test_what_was_changed_comes_back_too(changes, tmp_path):
    drive = gp.GearDrive.from_pair(PAIR, **GIVEN).replace(**changes)
    drive.to_file(tmp_path / "pair.yml")
    again = gp.GearDrive.from_file(tmp_path / "pair.yml")
    assert again.damping_n_s_per_m == pytest.approx(drive.damping_n_s_per_m, rel=1e-14)
    assert again.replace(damping_n_s_per_m=drive.damping_n_s_per_m) == drive


def test_what_no_file_can_hold_is_refused_and_nothing_is_written(tmp_path):
    drive = gp.GearDrive.from_pair(PAIR, **GIVEN)
    with pytest.raises(ValueError, match="changed by hand: mean_stiffness_n_per_um$"):
        drive.replace(mean_stiffness_n_per_um=300.0).to_file(tmp_path / "pair.yml")
    with pytest.raises(ValueError, match="this drive has none: make it by GearDrive.from_pair"):
        drive.replace(stiffness=gp.StiffnessWave.rectangular()).to_file(tmp_path / "pair.yml")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("shifts", ["", "pinion_shift: 0.4\n", "gear_shift: -0.1\n"])
def test_the_shifts_follow_from_the_centre_distance(written, shifts):
    pair = read_drive_file(written(f"{LEAST}{REST}centre_distance_mm: 129\n{shifts}")).pair
    assert pair.centre_distance_mm == pytest.approx(129.0, abs=1e-9)
    if not shifts:
        assert pair.pinion_shift == pair.gear_shift
    else:
        assert getattr(pair, shifts.split(":")[0]) == float(shifts.split(":")[1])


def test_diameters_of_a_drawing_are_those_of_the_gears():
    pair = read_drive_file(Path(__file__).parent / "pairs" / "shifted.yml").pair
    assert [2 * gear.tip_circle_mm for gear in (pair.pinion, pair.gear)] == pytest.approx([65.2, 136.8], abs=1e-12)
    bores = read_drive_file(Path(__file__).parent / "pairs" / "car.yml").pair
    assert [2 * gear.bore_mm for gear in (bores.pinion, bores.gear)] == pytest.approx([20.0, 40.0], abs=1e-12)


def test_the_backlash_of_thickness_allowances_and_of_the_centre_distance():
    """Both gears' teeth thinner by A_s1 + A_s2 on the reference circle; centres apart by da add 2 da sin(alpha_w)."""
    file = read_drive_file(Path(__file__).parent / "pairs" / "mill.yml")
    cosine, sine = math.cos(math.radians(20.0)), math.sin(math.radians(20.0))
    least, most = 300.0 * cosine, 440.0 * cosine + 2 * 60.0 * sine
    assert file.backlash_range_um == pytest.approx((least, most), rel=1e-12)
    assert file.made(gp.GearDrive).backlash_um == pytest.approx(0.5 * (least + most), rel=1e-12)


def test_flank_tolerances_by_hand_and_by_their_steps():
    """Class 5: the formula itself; two classes more double it, up to the rounding to half or whole micrometres."""
    gear = gp.SpurPair(pinion_teeth=40, gear_teeth=40, module_mm=3.0).gear
    five = flank_tolerances(gear, 5)
    assert (five.single_pitch_um, five.profile_form_um) == (6.5, 6.5)  # 0.12 + 1.2 + 5 = 6.32 and 1.65 + 5 = 6.65
    assert five.base_pitch_um == pytest.approx(6.5 * math.cos(math.radians(20.0)), rel=1e-14)
    nine = flank_tolerances(gear, 9)
    assert (nine.single_pitch_um, nine.profile_form_um) == (25.0, 27.0)
    one = flank_tolerances(gear, 1)
    assert (one.single_pitch_um, one.profile_form_um) == (1.6, 1.7)
    for grade in (0, 12, 5.5, True):
        with pytest.raises(ValueError, match="^grade must be "):
            flank_tolerances(gear, grade)
    with pytest.raises(ValueError, match="a module of 0.5 to 70 mm, got 0.3 mm"):
        flank_tolerances(gp.SpurPair(pinion_teeth=40, gear_teeth=40, module_mm=0.3).gear, 5)


def test_a_grade_gives_an_error_whose_phase_is_unknown(written):
    file = read_drive_file(written(LEAST + "backlash_um: 100\npinion_torque_nm: 120\niso_grade: 6\n"))
    drive = file.made(gp.GearDrive)
    assert drive.phase_is_unknown and drive.transmission_error_um == 9.5
    tolerances = flank_tolerances(PAIR.gear, 6)
    assert file.iso_deviations == {"base_pitch_um": tolerances.base_pitch_um, "profile_um": 9.5}
    own = read_drive_file(written(f"{LEAST}{REST}iso_grade: 6\nprofile_um: 3\n"))
    assert own.made(gp.GearDrive).transmission_error_um == 4.0 and own.iso_deviations["profile_um"] == 3.0


def test_a_measured_error_over_a_mesh_period():
    drive = gp.GearDrive.from_file(Path(__file__).parent / "pairs" / "rig.yml")
    assert not drive.phase_is_unknown
    found = [drive.transmission_error_um, drive.error_phase_rad, *np.ravel(drive.error_harmonics[:2])]
    assert found == pytest.approx([5.0, 0.8, 2, 1.2, -0.4, 3, 0.3, 0.0], abs=1e-4)
    assert max(each.amplitude for each in drive.error_harmonics[2:]) < 1e-4


@pytest.mark.parametrize(("covers", "teeth"), [("pinion", 28), ("gear", 57)])
def test_a_measured_error_over_a_revolution(written, covers, teeth):
    turn = 2 * np.pi * np.arange(teeth * 8) / (teeth * 8)
    error = 5.0 * np.sin(teeth * turn + 0.4) + 12.0 * np.sin(turn - 1.0)
    written("".join(f"{angle};{each}\n" for angle, each in zip(turn.tolist(), error.tolist(), strict=True)), "dte.csv")
    text = "backlash_um: 100\npinion_torque_nm: 9\ntransmission_error_csv: dte.csv\n"
    drive = gp.GearDrive.from_file(written(f"{LEAST}{text}transmission_error_covers: {covers}\n"))
    assert (drive.transmission_error_um, drive.error_phase_rad) == pytest.approx((5.0, 0.4), abs=1e-9)
    (runout,) = drive.shaft_orders
    assert runout == pytest.approx((teeth, 12.0, -1.0, 1), abs=1e-9)


def test_a_text_like_1e_3_is_a_number_and_a_torque_may_be_a_list(written):
    file = read_drive_file(written(LEAST + REST.replace("120", "[50, -50]") + "damping_ratio: 4e-2\n"))
    assert file.torques_nm == (50.0, -50.0) and file.given["damping_ratio"] == 0.04
    assert file.made(gp.GearDrive).pinion_torque_nm == 50.0


BAD = {
    "": "must hold lines NAME: VALUE",
    "- 28\n- 57\n": "must hold lines NAME: VALUE",
    "pinion_teeth: [28\n": "cannot be read as YAML at line 2: ",
    LEAST: "backlash_um is needed, or the thickness_allowance_um of both",
    REST: "pinion_teeth is needed (teeth of the pinion, which drives)",
    f"{LEAST}{REST}pinion_teth: 30": "unknown name 'pinion_teth'; did you mean 'pinion_teeth'?",
    f"{LEAST}{REST}zzz: 30": "unknown name 'zzz'; gearpair drive --example lists what there is",
    f"{LEAST}{REST}module_mm: 2": "module_mm is given 2 times",
    f"{LEAST}{REST}damping_ratio: -0.1": "damping_ratio must be a finite number at least 0, got -0.1",
    f"{LEAST}{REST}damping_ratio: much": "damping_ratio must be a finite number at least 0, got 'much'",
    f"{LEAST}{REST}damping_ratio: yes": "damping_ratio must be a finite number at least 0, got True",
    f"{LEAST}{REST}n_starts: 1.5": "n_starts must be a whole number of at least 0, got 1.5",
    f"{LEAST}{REST}backlash: radial": "backlash must be one of 'normal', 'circumferential', 'thickness', got 'radial'",
    f"{LEAST}{REST}service_rpm: [3000, 1000]": "service_rpm must be two finite numbers in rising order",
    f"{LEAST}{REST}pinion_thickness_allowance_um: [-90, -60]": "give backlash_um or pinion_thickness_allowance_um, not",
    f"{LEAST}{REST}pinion_bore_ratio: 0.2\npinion_bore_diameter_mm: 20": "give pinion_bore_diameter_mm or pinion_bore_",
    f"{LEAST}{REST}centre_distance_mm: 100": "centre_distance_mm must be above 119.811, where the base circles touch",
    f"{LEAST}{REST}centre_distance_mm: 128\npinion_shift: 0\ngear_shift: 0": "leave one of the three out",
    f"{LEAST}{REST}pinion_shift: 1.5": "interference: the gear's tip meets the pinion 17.2322 mm along",
    f"{LEAST}{REST}pinion_bore_diameter_mm: 80": "puts the pinion's bore at or beyond its root circle",
    f"{LEAST}{REST}pinion_tip_diameter_mm: 95": "pinion_tip_diameter_mm must be at most 90 with this addendum",
    f"{LEAST}{REST}youngs_modulus_gpa: 3": "density_kg_m3 must be given where youngs_modulus_gpa is no steel's",
    f"{LEAST}{REST}relief_length: 0.3": "relief_length goes with a pinion_relief_um or gear_relief_um above 0",
    f"{LEAST}{REST}pinion_relief_um: 5\nrelief_length: 9": "length must be a finite number above 0 and at most",
    f"{LEAST}{REST}idle_order: 2": "idle_order, idle_swing_deg, idle_drag_nm go together, got idle_order alone",
    f"{LEAST}{REST}iso_grade: 14": "iso_grade must be a whole number of at most 11, got 14",
    f"{LEAST}{REST}transmission_error_csv: dte.csv": "give transmission_error_um or transmission_error_csv, not both",
    f"{LEAST}{REST.replace('4', '[[0, 4, 0]]')}": "transmission_error_um[0] order must be a whole number of at least 1",
    f"{LEAST}backlash_um: 9\npinion_torque_nm: 1": "one of transmission_error_um, transmission_error_csv, iso_grade is",
    f"{LEAST}backlash_um: 9\niso_grade: 6\n": "pinion_torque_nm is needed, unless the gear idles",
    f"{LEAST}{REST}lowest_rpm: 3000\nhighest_rpm: 1000": "lowest_rpm must be below highest_rpm, got 3000 and 1000",
    f"{LEAST}{REST}error_phase_rad: 1\niso_grade: 6".replace("transmission_error_um: 4\n", ""): "error_phase_rad goes",
}


@pytest.mark.parametrize("text", BAD)
def test_a_bad_file_gets_one_sentence(written, text):
    path = written(text)
    with pytest.raises(ValueError) as failure:
        gp.GearDrive.from_file(path)
    told = str(failure.value)
    assert told.startswith(f"{path}: ") and BAD[text] in told and "\n" not in told


@pytest.mark.parametrize(
    ("numbers", "sentence"),
    [
        (None, "dte.csv cannot be read: No such file or directory"),
        ("", "dte.csv must hold one column, the error in micrometres, or two"),
        ("1,2,3\n", "dte.csv must hold one column, the error in micrometres, or two"),
        ("error\n1\n2\nthree\n", "dte.csv, line 4, must hold numbers, got 'three'"),
        ("1\n2\n", "dte.csv must hold at least 3 samples of a mesh period, got 2"),
        ("1\nnan\n2\n", "dte.csv must hold finite numbers"),
        ("0 0\n", "dte.csv must hold one column, the error in micrometres, or two"),
        ("0,1\n1,2\n3,3\n", "dte.csv must hold samples at equal steps, got steps from 1 to 2"),
    ],
)
def test_a_bad_measurement_gets_one_sentence(written, numbers, sentence):
    if numbers is not None:
        written(numbers, "dte.csv")
    with pytest.raises(ValueError) as failure:
        read_drive_file(written(f"{LEAST}backlash_um: 9\npinion_torque_nm: 1\ntransmission_error_csv: dte.csv\n"))
    assert sentence in str(failure.value) and "\n" not in str(failure.value)


def test_a_file_that_is_not_there_or_no_text(tmp_path):
    with pytest.raises(ValueError, match="none.yml: cannot be read: No such file or directory"):
        gp.GearDrive.from_file(tmp_path / "none.yml")
    (tmp_path / "binary.yml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="binary.yml: cannot be read: it is no text file"):
        gp.GearDrive.from_file(tmp_path / "binary.yml")
    with pytest.raises(TypeError, match="path must be "):
        gp.GearDrive.from_file(3)
