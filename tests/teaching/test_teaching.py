"""A gear pair for every student, answers as plain data, and marks; the course itself is graded by `make teach`."""

import json
import os
import re
import subprocess
from itertools import product

import matplotlib.pyplot as plt
import nbformat
import numpy as np
import pytest

import gearpair as gp
from gearpair import teaching
from gearpair.teaching.personal import CHOICES
from tests.support import ROOT

STUDENTS = [f"student{number}" for number in range(40)]
ENDS = {name: (choices[0], choices[-1]) for name, choices in CHOICES.items()}


def test_forty_students_have_forty_drives():
    for personal in (teaching.personal_oscillator, teaching.personal_drive):
        assert len({repr(personal(student)) for student in STUDENTS}) == len(STUDENTS)
    assert len({repr(teaching.personal_pair(student)) for student in STUDENTS}) >= len(STUDENTS) - 2  # one of 6160


def test_an_id_gives_the_same_pair_for_ever():
    """Marks given last year can be given again."""
    pair = teaching.personal_pair("ada")
    assert (pair.pinion_teeth, pair.gear_teeth, pair.module_mm, pair.face_width_mm) == (27, 47, 4.0, 24.0)


@pytest.mark.parametrize("student_id", ["", " ", "a", "-ada", "ada/grace", "ada grace", "a" * 65, None, 7, "../ada"])
def test_what_cannot_be_an_id_is_refused_in_one_sentence(student_id):
    with pytest.raises(ValueError, match="student_id must be your own id"):
        teaching.personal_drive(student_id)


def test_every_pair_of_teeth_can_be_cut_and_has_a_two_level_wave():
    for pinion, gear in product(CHOICES["pinion_teeth"], CHOICES["gear_teeth"]):
        assert 1.6 < gp.SpurPair(pinion_teeth=pinion, gear_teeth=gear).contact_ratio < 1.8


@pytest.mark.parametrize(("pinion", "gear"), [*zip(ENDS["pinion_teeth"], ENDS["gear_teeth"], strict=True)])
@pytest.mark.parametrize("force", ENDS["mean_force"])
@pytest.mark.parametrize("error", ENDS["error_amplitude"])
@pytest.mark.parametrize("damping", ENDS["damping_ratio"])
@pytest.mark.slow
def test_every_corner_of_the_choices_has_what_the_assignments_ask_about(pinion, gear, force, error, damping):
    shape = gp.mesh_stiffness(gp.SpurPair(pinion_teeth=pinion, gear_teeth=gear)).rectangular()
    wave = gp.StiffnessWave.rectangular(shape.contact_ratio, shape.a, shape.b)
    osc = gp.Oscillator(mean_force=force, error_amplitude=error, damping_ratio=damping, stiffness=wave)
    grid = np.linspace(0.545, 0.75, 42)
    up, down = (gp.sweep(osc, "mesh_frequency", way) for way in (grid, grid[::-1]))
    rattles_up = up.impact_state.values == "single_drive"
    rattles_down = down.impact_state.values[::-1] == "single_drive"
    # one jump each way, the one up after the one down: between them two motions, 0.635 included
    assert np.count_nonzero(np.diff(rattles_up)) == np.count_nonzero(np.diff(rattles_down)) == 1
    here = int(np.argmin(np.abs(grid - 0.635)))
    assert rattles_down[here] and not rattles_up[here]
    # at Omega = 1.05 a period doubling between the ends of the damping assignment
    strong, weak = (gp.steady_state(osc.replace(mesh_frequency=1.05, damping_ratio=zeta)) for zeta in (0.3, 0.08))
    assert strong.period == 1 and weak.period != 1


def test_answers_travel_as_plain_data():
    fig, axes = plt.subplots()
    axes.plot([0, 1], [2, 3], label="line")
    axes.scatter([5], [6])
    axes.set(xlabel="x")
    given = {"a": 1, "b": np.float64(2.5), "c": None, "d": True, "e": [1, "two"], "f": 1j}
    given |= {"g": axes, "h": gp, "i": np.arange(3)}
    back = teaching.read_report(teaching.report([*given, "absent"], given))
    plt.close(fig)
    assert {name: back[name] for name in "abcdef"} == {name: given[name] for name in "abcdef"}
    assert back["h"] == teaching.Unreadable("module") and back["i"].tolist() == [0, 1, 2]
    line, cloud = back["g"].curves
    assert (line.label, line.x.tolist(), line.y.tolist()) == ("line", [0, 1], [2, 3])
    assert (cloud.x.tolist(), cloud.y.tolist()) == ([5], [6])
    assert (back["g"].x_label, back["g"].y_label) == ("x", "")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{",
        json.dumps({"a": {"array": "text"}}),
        json.dumps({"a": {"drawing": [1]}}),
        json.dumps({"a": {"complex": [1, 2, 3]}}),
        "[" * 100_000,
        "1" * 5_000_000,
    ],
)
def test_a_forged_report_is_no_report(text):
    assert teaching.read_report(text) == {}


def test_an_answer_that_is_too_long_is_not_sent():
    with pytest.raises(ValueError, match="too long"):
        teaching.report(["a"], {"a": np.zeros(2_000_000)})


@pytest.mark.parametrize(
    ("given", "earned"),
    [
        (390.0, 2),
        (390.3, 2),
        (np.float64(390), 2),
        (np.array([390.0]), 2),
        (392.0, 1),  # nearly
        (390e6, 1),  # another unit
        (0.39, 1),
        (400.0, 0),
        (-390.0, 0),
        (float("nan"), 0),
        (float("inf"), 0),
        (10**400, 0),
        (None, 0),
        (True, 0),
        ("390", 0),
        ([390.0], 0),
        (teaching.Unreadable("Dataset"), 0),
    ],
)
def test_a_number_earns_its_marks(given, earned, capsys):
    marks = teaching.Marks()
    marks.number("stiffness", given, 390.0, marks=2, nearly=0.01)
    assert repr(marks) == str(earned)
    assert f"({earned} of 2)" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("given", "truth", "earned"),
    [
        (" Double ", "double", 1),
        ("single_drive", "double", 0),
        (gp.ImpactState.DOUBLE, "double", 1),
        (2, 2, 1),
        (2.0, 2, 1),
        (True, 1, 0),
        (1, True, 0),
        (True, True, 1),
        (None, 2, 0),
        (2, "2", 0),
    ],
)
def test_a_word_or_a_count_is_right_or_not(given, truth, earned):
    marks = teaching.Marks()
    marks.same("it", given, truth)
    assert marks.total == earned


@pytest.mark.parametrize(
    ("x", "factor", "earned"),
    [
        (np.linspace(0, 1, 50), 1.0, 2),
        (np.linspace(0, 1, 50)[::-1], 1.0, 2),
        (np.linspace(0, 0.5, 50), 1.0, 1),  # half of the range
        (np.linspace(0, 1, 5), 1.0, 1),  # too few points
        (np.linspace(0, 1, 50), 1e3, 1),  # another unit
        (np.linspace(0, 1, 50), 1.05, 0),
        (np.linspace(0, 0.1, 50), 1.0, 0),  # a corner of it
        (np.linspace(2, 3, 50), 1.0, 0),  # elsewhere
    ],
)
def test_a_picture_is_marked_by_its_data(x, factor, earned):
    fig, axes = plt.subplots()
    axes.plot([0, 1], [7, 7])
    axes.plot(x, factor * (2 + np.sin(x)))
    marks = teaching.Marks()
    marks.curve("the line", axes, lambda x: 2 + np.sin(x), (0.0, 1.0), marks=2)
    plt.close(fig)
    assert marks.total == earned


def test_labels_count_by_halves_and_no_picture_is_none():
    fig, axes = plt.subplots()
    axes.set(xlabel="phase")
    marks = teaching.Marks()
    marks.labels("the labels", axes)
    marks.labels("the labels", 3.0)
    marks.curve("the line", None, np.sin, (0.0, 1.0))
    plt.close(fig)
    assert marks.total == 0.5


def test_before_the_tests_a_cell_says_only_what_is_missing(capsys):
    marks = teaching.Marks()
    marks.expect(a=1.0, b=..., c=None)
    assert repr(marks) == "0"
    assert capsys.readouterr().out.splitlines() == ["b: no answer yet", "c: no answer yet"]
    marks.expect(a=1.0)
    assert "every answer asked for is there" in repr(marks)


def test_a_mistake_is_named_and_what_follows_from_it_counts(capsys):
    marks = teaching.Marks()
    marks.number("a", 57.3, 1.0, mistakes={"that is in degrees": 57.3})
    marks.number("b", 114.6, 2.0, follows=(lambda a: 2 * a, 57.3))
    marks.number("c", 0.0, 2.0, follows=(lambda a: 0 * a, 57.3))  # nothing follows from nothing
    marks.number("d", 5.0, 2.0, follows=(lambda a: 1 / a, 0.0))
    marks.number("e", 2.0, 1.0, also=[2.0])
    marks.same("f", 3, 2, mistakes={"of both": 3})
    assert marks.total == 2.0
    said = capsys.readouterr().out.splitlines()
    assert said[0].endswith("that is in degrees (0 of 1)") and said[5].endswith("of both (0 of 1)")
    assert [item.truth for item in marks.items] == [1.0, 2.0, 2.0, 2.0, 1.0, 2]


def test_an_empty_picture_is_no_answer():
    fig, axes = plt.subplots()
    marks = teaching.Marks()
    marks.expect(axes=axes)
    plt.close(fig)
    assert repr(marks) == "0"


@pytest.mark.slow
def test_the_rig_of_everybody_is_identified():
    """The damping and the error that its report hides, to the one per cent that the assignment asks for."""
    for student in STUDENTS[:3]:
        rig, true = teaching.personal_rig(student), teaching.true_rig(student)
        found = gp.design.identify(rig.drive, rig.jump_up_rpm, rig.jump_down_rpm)
        assert found.damping_ratio == pytest.approx(true.damping_ratio, rel=5e-3)
        assert found.transmission_error_um == pytest.approx(true.transmission_error_um, rel=5e-3)


CHAPTERS = [path for path in sorted((ROOT / "notebooks").glob("*.ipynb")) if path.stem != "library"]


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_a_chapter_can_be_taught_from(path):
    """Goals at its head, a summary or a verdict, two exercises at least; solutions folded, from what was computed."""
    cells = nbformat.read(path, as_version=4).cells
    text = "\n".join(cell.source for cell in cells)
    (goals,) = (cell.source for cell in cells[:4] if "```{admonition} What you will learn" in cell.source)
    assert "**Before:**" in goals
    assert re.search(r"^## (Summary|Verdict)$", text, re.MULTILINE) or "# Appendix: " in cells[0].source
    labels = re.findall(r"^`{3,}\{exercise\}.*\n:label: (\S+)$", text, re.MULTILINE)
    assert len(labels) >= 2
    for label in labels:
        starts = [i for i, cell in enumerate(cells) if f"{{solution-start}} {label}\n:class: dropdown" in cell.source]
        ends = [i for i, cell in enumerate(cells) if "{solution-end}" in cell.source and i > starts[0]]
        assert len(starts) == 1
        solution = cells[starts[0] : ends[0]]
        assert any(cell.cell_type == "code" or "{glue:text}" in cell.source for cell in solution)


@pytest.mark.parametrize(("fails", "code"), [("none", 0), ("test", 1), ("teach", 1), ("check-site", 1)])
def test_continuous_integration_runs_tests_course_and_gates_and_fails_with_any(tmp_path, fails, code):
    (tmp_path / "make").write_text(f'#!/bin/sh\necho "$1" $(cat | wc -c)\ntest "$1" != {fails}\n')
    for name in ("java", "npm"):  # and a browser: nothing to install
        (tmp_path / name).write_text("#!/bin/sh\n")
    for name in ("make", "java", "npm"):
        (tmp_path / name).chmod(0o755)
    run = ROOT / ".ci" / "run"
    environment = {**os.environ, "PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}", "CHROMIUM": "chromium"}
    done = subprocess.run([run], env=environment, input="typed", capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (
        code,
        "test 0\ncheck-site 0\nteach 0\n",
    )  # what the course told comes last
