"""The command ``gearpair drive``: the verdict, the report and the numbers, whole or not at all."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import gearpair as gp
from gearpair.design import speed_chart, verdict
from gearpair.study import drive_numbers
from gearpair.study.cli import main

PAIRS = Path(__file__).parent / "pairs"
LOADED = ("car", "high_contact_ratio", "mill", "plastic", "rig", "shifted")
FEW = "\nn_speeds: 5\nn_starts: 1\nn_phases: 2\nhighest_rpm: {}\nlowest_rpm: {}\n"
GEARS = "pinion_teeth: 28\ngear_teeth: 57\nmodule_mm: 3\nface_width_mm: 25\nbacklash_um: 100\n"
SMALL = GEARS + "transmission_error_um: 4\npinion_torque_nm: [900, -900]\nservice_rpm: [1500, 2000]\n"


@pytest.fixture
def small(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "pair.yml"
    path.write_text(SMALL + FEW.format(2200, 1000), encoding="utf-8")
    return path


def test_the_example_is_printed_and_works(capsys, tmp_path):
    assert main(["drive", "--example"]) == 0
    path = tmp_path / "pair.yml"
    path.write_text(capsys.readouterr().out, encoding="utf-8")
    assert gp.GearDrive.from_file(path).pinion_teeth == 28


@pytest.mark.slow
def test_verdict_report_and_numbers_say_the_same(small, capsys):
    words = ["--html", "out.html", "--csv", "out.csv", "--xlsx", "out.xlsx", "--netcdf", "out.nc"]
    assert main(["drive", "pair.yml", "--quiet", *words]) == 0
    told = capsys.readouterr()
    assert told.err == "" and told.out.endswith("written: out.html, out.csv, out.xlsx, out.nc\n")
    names = ["out.csv", "out.html", "out.nc", "out.xlsx", "pair.yml"]
    assert sorted(path.name for path in small.parent.iterdir()) == names
    chart = speed_chart(
        gp.GearDrive.from_file(small), np.linspace(1000.0, 2200.0, 5), n_starts=1, n_phases=2, locate_jumps=True
    )
    sentences = verdict(chart, None, (1500.0, 2000.0)).sentences
    page = Path("out.html").read_text(encoding="utf-8")
    assert all(sentence in told.out and sentence in page for sentence in sentences)
    assert "In service, from 1500 to 2000 rpm, they stay together." in sentences
    assert page.count("<svg ") == 2 and "mesh frequency (Hz)" in page.replace("<!-- ", "").replace(" -->", "")
    assert not re.search(r"<script|<link|<img|src=|url\(http|@import", page)
    frame = pd.read_csv("out.csv")
    assert len(frame) == 2 * 3 * 5 and {"torque_n_m", "speed_rpm", "mesh_force_n"} < {*frame.columns}
    pd.testing.assert_frame_equal(pd.read_excel("out.xlsx"), frame, check_dtype=False, rtol=1e-12)
    held = xr.load_dataset("out.nc")
    assert held.mesh_force.attrs["units"] == "N"
    ahead = held.sel(torque=900.0)
    assert np.array_equal(ahead.dynamic_factor.values, chart.dynamic_factor.values)
    one = frame[(frame.torque_n_m == 900.0) & (frame.run == "up")]
    assert one.dynamic_factor.to_numpy() == pytest.approx(chart.dynamic_factor.sel(run="up").values, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", LOADED)
def test_pairs_of_all_kinds_run_from_files_under_both_signs_of_the_torque(name, capsys, tmp_path):
    """Below the mesh resonance, from a tenth to a third; where nothing but the flank differs both signs agree."""
    drive = gp.GearDrive.from_file(PAIRS / f"{name}.yml")
    few = FEW.format(0.33 * drive.resonance_rpm, 0.1 * drive.resonance_rpm)
    text = re.sub(r"^service_rpm:.*$", "", (PAIRS / f"{name}.yml").read_text(encoding="utf-8"), flags=re.MULTILINE)
    (tmp_path / "pair.yml").write_text(text + few, encoding="utf-8")
    (tmp_path / "rig_error.csv").write_bytes((PAIRS / "rig_error.csv").read_bytes())
    assert main(["drive", str(tmp_path / "pair.yml"), "--quiet", "--csv", str(tmp_path / "out.csv")]) == 0
    assert capsys.readouterr().out.count("To keep the teeth together: ") == 2
    frame = pd.read_csv(tmp_path / "out.csv")
    ahead, back = (frame[frame.torque_n_m * sign > 0] for sign in (1, -1))
    assert ahead.factor_high.between(1.0, 12.0).all()
    if name in ("high_contact_ratio", "mill", "plastic", "shifted"):
        assert back.factor_high.to_numpy() == pytest.approx(ahead.factor_high.to_numpy(), rel=1e-3)


@pytest.mark.slow
def test_a_drive_with_run_out_runs_too(capsys, tmp_path):
    text = GEARS + "transmission_error_um: [[1, 4.0, 0.5]]\nshaft_orders: [[28, 10.0]]\ndamping_ratio: 0.2\n"
    text += "pinion_torque_nm: 900\nn_speeds: 2\nn_starts: 0\nlowest_rpm: 1500\nhighest_rpm: 1600\n"
    (tmp_path / "pair.yml").write_text(text, encoding="utf-8")
    assert main(["drive", str(tmp_path / "pair.yml"), "--quiet"]) == 0
    assert "No phase had to be chosen: that of the error is known." in capsys.readouterr().out


@pytest.mark.slow
def test_timing_gears_at_idle(capsys, tmp_path):
    """From where the inertia torque I2 swing (r_b1 / r_b2) (order omega)^2 is the drag."""
    (tmp_path / "pair.yml").write_text((PAIRS / "timing.yml").read_text(encoding="utf-8") + "n_speeds: 5\n")
    words = ["--html", str(tmp_path / "out.html"), "--csv", str(tmp_path / "out.csv")]
    assert main(["drive", str(tmp_path / "pair.yml"), "--quiet", *words]) == 0
    drive = gp.GearDrive.from_file(PAIRS / "timing.yml")
    onset = np.sqrt(0.4 / (drive.gear_inertia_kg_m2 * np.radians(0.15))) / 2.0 * 30.0 / np.pi
    sentence = f"The idle gear rattles from {onset:.0f} rpm on"
    assert sentence in capsys.readouterr().out and sentence in (tmp_path / "out.html").read_text(encoding="utf-8")
    frame = pd.read_csv(tmp_path / "out.csv")
    assert (frame.impact_rate_per_s.to_numpy() > 0.0).tolist() == (frame.speed_rpm.to_numpy() > onset).tolist()


def test_a_verdict_tells_where_the_teeth_part():
    """A pair that parts at its resonance, and at none of the speeds below; by its own jump or midway between two."""
    pair = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
    given = dict(backlash_um=100.0, transmission_error_um=4.0, damping_ratio=0.05)
    drive = gp.GearDrive.from_pair(pair, pinion_torque_nm=120.0, **given)
    chart = speed_chart(drive, [3000.0, 4000.0, 9000.0, 10000.0], n_starts=0, n_phases=2, locate_jumps=False)
    found = verdict(chart, service_rpm=(3500.0, 9500.0))
    assert found.rule == "run between 3000 and 6500 rpm"
    assert found.service == "In service, from 3500 to 9500 rpm, avoid 6500 to 9500 rpm."
    assert "180° is the worst" in found.phase and str(found).startswith("To keep the teeth together: run between 3000")
    assert "beyond" not in verdict(chart, service_rpm=(3500.0, 3600.0)).service
    assert "that the chart does not reach" in verdict(chart, service_rpm=(1000.0, 3600.0)).service
    bad = chart.isel(speed=[2, 3])
    assert verdict(bad).rule == "no speed of the range will do" and verdict(bad).quiet == ""


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["none.yml"], "none.yml: cannot be read: No such file or directory"),
        (["bad.yml"], "bad.yml: unknown name 'pinion_teth'; did you mean 'pinion_teeth'?"),
        (["pair.yml", "--html", "out.txt"], "the output must have a name that ends in .html, got 'out.txt'"),
        (["pair.yml", "--csv", "nowhere/out.csv"], "there is no directory "),
        (["bad.yml", "--html", "out.html", "--csv", "out.csv"], "bad.yml: unknown name"),
        (["low.yml"], "low.yml: mesh_frequency must be at least "),
    ],
)
def test_bad_input_gets_one_sentence(small, capsys, words, sentence):
    (small.parent / "bad.yml").write_text("pinion_teth: 3\n")
    (small.parent / "low.yml").write_text(GEARS + "iso_grade: 6\npinion_torque_nm: 1\nlowest_rpm: 1.0e-6\n")
    before = sorted(path.name for path in small.parent.rglob("*"))
    assert main(["drive", *words]) == 1
    error = capsys.readouterr().err.splitlines()[-1]
    assert sentence in error and error.startswith("gearpair: ")
    assert sorted(path.name for path in small.parent.rglob("*")) == before


def test_nothing_is_left_of_outputs_of_which_one_fails(small, capsys, monkeypatch):
    def fail(answer, path):
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(drive_numbers.WRITERS, "netcdf", (".nc", fail))
    assert main(["drive", "pair.yml", "--quiet", "--csv", "out.csv", "--netcdf", "out.nc"]) == 1
    assert capsys.readouterr().err == "gearpair: out.nc cannot be written: No space left on device\n"
    assert [path.name for path in small.parent.iterdir()] == ["pair.yml"]


def test_a_drive_without_a_file_is_wrong_usage(capsys):
    assert main(["drive"]) == 2
    assert capsys.readouterr().err == (
        "gearpair: Missing argument 'PAIR.yml', or --example. See gearpair drive --help\n"
    )


def test_help_opens_with_a_drawing_one_command_one_figure(capsys):
    assert main(["--help"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert told.index("A drawing, one command, one figure") < told.index("gearpair drive pair.yml --html report.html")


@pytest.mark.slow
def test_how_far_it_is_stands_on_stderr(small, capsys):
    assert main(["drive", "pair.yml"]) == 0
    told = capsys.readouterr()
    assert "pair.yml: 900 N m, 5 speeds" in told.err and "%" in told.err and "N m, 5 speeds" not in told.out
