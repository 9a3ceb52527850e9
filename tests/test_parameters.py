"""Ranges and relations of a chapter's parameters: refused before anything runs, in a sentence that names them."""

import pytest

from gearpair.parameters import check_parameters

DECLARING = "damping_ratio: float = 0.02  # zeta\nn_values: int = 101  # frequencies"

DRIVE = {"pinion_torque_nm": 120.0, "backlash_um": 100.0, "transmission_error_um": 4.0, "damping_ratio": 0.05}


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"damping_ratio": -0.1}, "damping_ratio must be a finite number at least 0 and at most 100, got -0.1"),
        ({"b": 1.0}, "b must be a finite number below 1, got 1.0"),
        ({"reading": "prined"}, "reading must be one of 'printed', 'swapped', got 'prined'"),
        ({"lowest": 1.7, "highest": 0.7}, "lowest must be below highest, got lowest = 1.7 and highest = 0.7"),
        ({"lowest": 0.7, "highest": 0.7}, "lowest must be below highest"),
        ({"lowest": 0.0, "highest": 0.7}, "lowest: mesh_frequency must be a finite number above 0, got 0.0"),
        ({"chaos_near": -1.0}, "chaos_near: mesh_frequency must be a finite number above 0"),
        ({"mesh_frequency": 1e-9}, "mesh_frequency must be at least"),
        ({"gear_teeth": 8}, "contact ratio is 0.9"),
        ({"pinion_teeth": 34, "coupling": "sum"}, "coupling must be one of 'summed', 'ring', 'clamped', got 'sum'"),
        ({"pinion_teeth": 34, "coupling": "ring", "foundation": False}, "it needs foundation=True"),
        ({"n_values": 1}, "n_values must be a whole number of at least 2, got 1"),
        ({"n_reached": 1}, "n_reached must be a whole number of at least 2, got 1"),
        ({**DRIVE, "backlash_um": -1.0}, "backlash_um must be a finite number above 0, got -1.0"),
        ({**DRIVE, "pinion_torque_nm": 0.0}, "pinion_torque_nm must be a finite number above 0, got 0.0"),
        ({**DRIVE, "pinion_torque_nm": -5.0}, "pinion_torque_nm must be a finite number above 0, got -5.0"),
        ({"profile_um": -1.0}, "profile_um must be a finite number at least 0, got -1.0"),
        ({**DRIVE, "backlash": "wide"}, "backlash must be one of 'normal', 'circumferential', 'thickness', got 'wide'"),
        (
            {"lowest_rpm": 3000.0, "highest_rpm": 2000.0},
            "lowest_rpm must be below highest_rpm, got lowest_rpm = 3000.0",
        ),
        ({"lowest_rpm": None, "highest_rpm": 0.0}, "highest_rpm must be a finite number above 0, got 0.0"),
        ({"n_transient": -1}, "n_transient must be a whole number of at least 0, got -1"),
        ({"n_x": 2.5}, "n_x must be a whole number"),
        ({"first_start": [1.0]}, "first_start must be the two numbers X and X', got [1.0]"),
        ({"second_start": [1.0, float("inf")]}, "second_start: "),
        ({"start_x": "much"}, "start_x must be a finite number, got 'much'"),
        ({"x_reach": 0.0}, "x_reach must be a finite number above 0, got 0.0"),
        ({"narrowest": -0.1}, "narrowest must be a finite number at least 0"),
        ({"tolerances": []}, "tolerances must be at least one number"),
        ({"tolerances": [1e-3, 0.0]}, "tolerances must be a finite number above 0 and below 1, got 0.0"),
        (
            {"weak_damping": -0.1},
            "weak_damping: damping_ratio must be a finite number at least 0 and at most 100, got -0.1",
        ),
        ({"weak_damping": 0.0}, "weak_damping must be a finite number above 0, got 0.0"),
        ({"frequency_to": -1.0}, "frequency_to: mesh_frequency must be a finite number above 0, got -1.0"),
        (
            {"frequency_from": 1.7, "frequency_to": 0.4},
            "frequency_from must be below frequency_to, got frequency_from = 1.7 and frequency_to = 0.4",
        ),
        ({"lower": 0.9, "upper": 0.7}, "lower must be below upper, got lower = 0.9 and upper = 0.7"),
        (
            {"n_starts": 10**9, "n_shares": 53},
            "n_shares x n_starts must be at most 10000000, the motions that memory holds, got 53 x 1000000000",
        ),
        ({"n_values": 10**9}, "n_values must be at most 10000000, the motions that memory holds, got 1000000000"),
        ({"phase_step": 7}, "phase_step must be a divisor of 180 degrees, got 7"),
    ],
)
def test_what_the_library_refuses_is_refused_by_the_parameters_name(values, sentence):
    with pytest.raises(ValueError) as refusal:
        check_parameters(values)
    assert sentence in str(refusal.value)


def refusal_of(values):
    """The sentence by which values are refused, None where they are not."""
    try:
        check_parameters(values)
    except ValueError as refusal:
        return str(refusal)
    return None


def test_values_that_are_none_are_the_librarys_choice():
    values = {**DRIVE, "tip_radius": None, "lowest_rpm": None, "highest_rpm": 3000.0, "n_starts": 0}
    assert refusal_of(values) is None


def test_a_name_means_what_the_chapter_says():
    check_parameters({"highest": 150.0})  # a mesh frequency
    with pytest.raises(ValueError, match="highest: damping_ratio must be a finite number at least 0 and at most 100"):
        check_parameters({"highest": 150.0}, highest="damping_ratio")


def test_a_notebooks_other_names_are_no_parameters():
    names = {"gp": object(), "rows": [], "n_found": [1, 2], "osc": None, "In": ["", "%matplotlib inline"]}
    assert refusal_of(names) is None


@pytest.mark.parametrize(
    ("between", "later"), [([], []), ([], ["import numpy", "x = 1"]), (["%matplotlib inline"], [])]
)
def test_a_name_that_papermill_put_in_must_be_declared(between, later):
    injected = "# Parameters\ndamping_ration = 0.05\n"
    with pytest.raises(
        ValueError, match="this chapter has no parameter 'damping_ration'; did you mean 'damping_ratio'?"
    ):
        check_parameters({"In": ["", DECLARING, *between, injected, *later]})
    check_parameters({"In": ["", DECLARING, injected.replace("ration", "ratio"), "x = 1"]})
    check_parameters({"In": ["", DECLARING, "damping_ration = 0.05"]})  # typed by hand, no business of ours


def test_a_chapter_needs_a_torque_also_of_a_file(tmp_path):
    """A dynamic factor is a factor of the load; of either sign it has one."""
    teeth = "pinion_teeth: 28\ngear_teeth: 57\nmodule_mm: 3\nface_width_mm: 25\nbacklash_um: 100\n"
    for torque in (0, -120):
        (tmp_path / f"{torque}.yml").write_text(f"{teeth}transmission_error_um: 4\npinion_torque_nm: {torque}\n")
    check_parameters({"drive": str(tmp_path / "-120.yml")})
    with pytest.raises(ValueError, match=r"0\.yml: a chapter needs a pinion_torque_nm other than 0; gearpair drive"):
        check_parameters({"drive": str(tmp_path / "0.yml")})
