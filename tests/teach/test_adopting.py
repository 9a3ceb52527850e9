"""What a lecturer does beside grading: packs, sheets, a platform's archive, marks for a class, questions for Moodle."""

import csv
import json
import zipfile
from xml.etree import ElementTree as Xml

import nbformat
import pytest

from gearpair import teaching
from gearpair.study.cli import main
from gearpair.study.course_pages import expected_minutes, markdown
from gearpair.teaching.classes import Student, read_class
from gearpair.teaching.collecting import collect, matched
from tests.support import ROOT
from tests.teach.answers import NAMES
from tests.teach.conftest import ASSIGNMENTS
from tests.teach.conftest import SHORT as NAME
from tools.course_packs import student_pack, teacher_pack

CLASS = """First name,Surname,ID number,Email address
Ada,Lovelace,ada,ada@example.org
Grace,Hopper,grace,
Emmy,Noether,emmy,
Zoé,Müller,zoe,
Zoé,Müller,zoe2,
"""
# as Moodle and Canvas name what they pack
ARCHIVE = {
    "Ada Lovelace_1234567_assignsubmission_file_/stiffness.ipynb": "ada",
    "hoppergrace_LATE_12345_67890_stiffness-1.ipynb": "grace",
    "Zoé Müller_1234569_assignsubmission_file_stiffness (1).ipynb": "zoe2",
    "Sofia Kowalewskaja_1234570_assignsubmission_file_stiffness.ipynb": None,
    "Emmy Noether_1234571_assignsubmission_file_photo.jpg": None,
}


@pytest.fixture
def course(short_course):
    return short_course


@pytest.fixture
def class_list(tmp_path):
    path = tmp_path / "class.csv"
    path.write_text(CLASS, encoding="utf-8")
    return path


@pytest.fixture
def here(course):
    return ["--course", str(course.root)]


def test_an_archive_is_collected_graded_and_listed(course, class_list, here, tmp_path, capsys):
    archive = tmp_path / "all.zip"
    with zipfile.ZipFile(archive, "w") as packed:
        for name, student in ARCHIVE.items():
            packed.writestr(name, nbformat.writes(course.solution(NAME, student)) if student else "{}")
    assert main(["course", "collect", str(archive), NAME, str(class_list), *here]) == 0
    told = capsys.readouterr()
    assert told.out == "3 collected, 2 not handed in: emmy, zoe\n"
    assert "there is no 'Sofia Kowalewskaja' in the class" in told.err and "photo.jpg is no notebook" in told.err
    course.nbgrader("autograde", NAME)
    output = tmp_path / "marks.csv"
    assert main(["course", "marks", str(class_list), "-o", str(output), *here]) == 0
    assert "stiffness: 3 written answers wait, 2 not handed in" in capsys.readouterr().out
    rows = {row["id"]: row for row in csv.DictReader(output.open(encoding="utf-8"))}
    assert list(rows) == ["ada", "grace", "emmy", "zoe", "zoe2"] and rows["ada"]["name"] == "Ada Lovelace"
    for student in ("ada", "grace", "zoe2"):
        row = rows[student]
        assert (row["stiffness"], row["stiffness_max"], row["stiffness_state"]) == ("3", "5", "written answers wait")
    assert (rows["emmy"]["stiffness"], rows["emmy"]["stiffness_state"]) == ("", "not handed in")
    # the sentences of a test stand before its code
    course.nbgrader("generate_feedback", NAME)
    page = (course.root / "feedback" / "ada" / NAME / f"{NAME}.html").read_text(encoding="utf-8")
    assert 0 < page.index("# path_mm: right (2 of 2)") < page.index("expect")
    # a later notebook, marked or not, has not got the marks of the one before
    again = course.root / "submitted" / "ada" / NAME / f"{NAME}.ipynb"
    again.write_text(nbformat.writes(course.released(NAME)), encoding="utf-8")
    assert main(["course", "marks", str(class_list), "-o", str(output), *here]) == 0
    assert "1 handed in anew, not graded again" in capsys.readouterr().out
    rows = {row["id"]: row for row in csv.DictReader(output.open(encoding="utf-8"))}
    assert (rows["ada"]["stiffness"], rows["ada"]["stiffness_state"]) == ("3", "handed in anew, not graded again")


def test_what_is_handed_in_anew_is_told_and_what_is_there_stays(tmp_path):
    def collected(**notebooks):
        with zipfile.ZipFile(tmp_path / "all.zip", "w") as packed:
            for student, text in notebooks.items():
                packed.writestr(f"{student}/{NAME}.ipynb", text)
        return collect(tmp_path / "all.zip", NAME, [Student("ada"), Student("emmy")], tmp_path)

    assert collected(ada="1").missing == ("emmy",)
    again = collected(ada="1", emmy="1")
    assert (again.missing, again.sentences) == ((), ())
    late = collected(emmy="2")
    assert late.missing == () and "--student=emmy --force" in late.sentences[0]


def test_canvas_has_a_number_beside_the_login(tmp_path):
    path = tmp_path / "canvas.csv"
    path.write_text(
        "Student,ID,SIS User ID,SIS Login ID,Section\n    Points Possible,,,,\n"
        '"Lovelace, Ada",12345,9,AL15,A\n"Student, Test",12350,,1f3a,A\n',
        encoding="utf-8",
    )
    assert read_class(path) == [Student("al15", "Ada Lovelace")]


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("Ada Lovelace_1_assignsubmission_file_stiffness.ipynb", ("moodle", "Ada Lovelace", "stiffness.ipynb")),
        ("Ada Lovelace_1_assignsubmission_file/stiffness.ipynb", ("moodle", "Ada Lovelace", "stiffness.ipynb")),
        ("lovelaceada_1_2_stiffness.ipynb", ("canvas", "lovelaceada", "stiffness.ipynb")),
        ("ada/stiffness/stiffness.ipynb", ("ids", "ada", "stiffness.ipynb")),
        ("course/ada/stiffness.ipynb", ("ids", "ada", "stiffness.ipynb")),
        ("ada_b_stiffness-2.ipynb", ("ids", "ada_b", "stiffness-2.ipynb")),
        ("ada_stiffness.ipynb", ("ids", "ada", "stiffness.ipynb")),
        ("stiffness.ipynb", None),
        ("Ada Lovelace_1_assignsubmission_file_stiffness.pdf", None),
    ],
)
def test_the_names_of_platforms_are_known(name, found):
    assert matched(name, NAME) == found


def test_sheets_hold_the_students_numbers_and_the_graders_answers(course, class_list, here, tmp_path, capsys):
    output = tmp_path / "sheets"
    assert main(["course", "sheets", str(class_list), "-o", str(output), "-a", NAME, *here]) == 0
    pair = teaching.personal_pair("ada")
    page = (output / NAME / "ada.html").read_text(encoding="utf-8")
    assert f"{pair.gear.base_radius_mm:.6g}" in page and f"{pair.contact_ratio:.6g}" not in page
    marking = (output / f"{NAME}-marking.html").read_text(encoding="utf-8")
    assert f"{pair.contact_ratio:.6g} ± 0.0017" in marking and "Half (1)" in marking
    (row,) = [
        row
        for row in csv.DictReader((output / "answers.csv").open(encoding="utf-8"))
        if (row["id"], row["answer"]) == ("ada", "contact_ratio")
    ]
    assert float(row["right"]) == pytest.approx(pair.contact_ratio, rel=1e-8)
    quiz = Xml.parse(output / "moodle.xml").getroot()
    asked = [each for each in quiz if each.get("type") == "numerical"]
    assert len(asked) == 2 * 5
    assert float(asked[1].findtext("answer/text")) == pytest.approx(pair.contact_ratio)
    assert float(asked[1].findtext("answer/tolerance")) == pytest.approx(1e-3 * pair.contact_ratio, rel=1e-5)


@pytest.mark.parametrize("name", NAMES)
def test_the_questions_of_a_sheet_are_those_of_the_grader(name):
    """Each test records what it marks, worth what the gradebook says; every formula can be set."""
    source = ASSIGNMENTS / "source" / name / f"{name}.ipynb"
    found = teaching.questions(source, "grace")
    assert sum(question.points for question in found) == 20
    for question in found:
        assert bool(question.rubric) != bool(question.items)
        assert not question.items or sum(item.marks for item in question.items) == question.points
        assert "<code>\\" not in markdown(question.text)


def test_the_page_says_how_long_an_assignment_is_estimated_to_take():
    page = (ROOT / "book" / "teaching.md").read_text(encoding="utf-8")
    for name in NAMES:
        minutes = expected_minutes(ASSIGNMENTS / "source" / name / f"{name}.ipynb")
        assert (
            f"| `{name}` |" in page
            and f"| {round(minutes / 30) / 2:g} h |" in page.split(f"| `{name}` |")[1].split("\n")[0]
        )


def test_the_students_pack_holds_no_solution_and_the_teachers_all(course, tmp_path):
    wheel = tmp_path / "gearpair.whl"
    wheel.write_bytes(b"")
    with zipfile.ZipFile(student_pack(course.root, wheel, tmp_path)) as packed:
        names = packed.namelist()
        assert names == [f"gearpair-course/{each}" for each in (f"{NAME}.ipynb", "gearpair.whl", "FIRST-HOUR.md")]
        text = packed.read(names[0]).decode()
        json.loads(text)
        assert "SOLUTION" not in text and "HIDDEN" not in text and "**Full" not in text
    with zipfile.ZipFile(teacher_pack(course.root, wheel, tmp_path)) as packed:
        names = set(packed.namelist())
        assert "gearpair-course-teacher/nbgrader_config.py" in names
        assert "HIDDEN TESTS" in packed.read(f"gearpair-course-teacher/source/{NAME}/{NAME}.ipynb").decode()


def test_what_pip_installs_brings_no_assignment():
    """The library has no notebook of its own, and what stands beside it are the chapters alone."""
    assert not list((ROOT / "gearpair").rglob("*.ipynb"))
    pyproject = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert "assignments" not in pyproject and '"notebooks/*.ipynb"' in pyproject


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["sheets", "no.csv"], "no.csv cannot be read"),
        (["sheets", "{class}", "-a", "nothing"], "there is no assignment 'nothing'; there are damping"),
        (["collect", "{class}", NAME, "{class}"], "cannot be read as a ZIP file"),
        (["marks", "{class}", "--course", "{empty}"], "has no gradebook.db"),
        (["sheets", "{class}", "--course", "{empty}"], "holds no assignments"),
    ],
)
def test_what_is_missing_is_told_in_a_sentence(course, class_list, here, tmp_path, capsys, words, sentence):
    given = [word.format(**{"class": class_list, "empty": tmp_path}) for word in words]
    assert main(["course", *given, *([] if "--course" in given else here)]) == 1
    told = capsys.readouterr().err
    assert sentence in told and told.count("\n") == 1
