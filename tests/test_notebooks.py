"""Every chapter as a text and as a program (its stored outputs are compared by nbval)."""

import ast
import os
import re
import shutil
import subprocess
import sys
from types import SimpleNamespace

import nbformat
import numpy as np
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from papermill import inspect_notebook

import gearpair as gp
from gearpair.drive_file import read_drive_file
from gearpair.parameters import BASELINE
from gearpair.study.book import Book
from gearpair.study.errors import StudyError
from gearpair.study.execution import execute
from gearpair.study.variants import defined_labels
from tests.support import ROOT
from tests.support.notebooks import MEAN, write_notebook
from tests.support.shown import fallbacks, typed_numbers
from tools.accept import accept_outputs

BOOK = Book(ROOT)
NOTEBOOKS = sorted(
    path
    for path in (ROOT / "notebooks").rglob("*.ipynb")
    if not {".ipynb_checkpoints", "assignments"} & set(path.parts)  # `make teach` has the assignments
)
CHAPTERS = BOOK.chapter_names()
LONGEST_CELL = 14  # lines that are not blank; notebooks/README.md says so too

# What each chapter is run with, beside its defaults, to show that its parameters are live and what it says of them: far
# from the defaults, where much of what a chapter looks for is not there.
CHANGED = {
    "stiffness": {  # three pairs in contact: the article's rectangle does not exist
        **{"pinion_teeth": "40", "gear_teeth": "60", "module_mm": "2", "addendum": "1.3", "clearance": "0.2"},
        **{"tip_radius": "0.1", "gear_shift": "0.1", "foundation": "false", "reading": "swapped", "n_values": "21"},
    },
    "tooth_bending": {  # the same, and a thin ring on its bore
        **{"pinion_teeth": "40", "gear_teeth": "60", "module_mm": "2", "addendum": "1.3", "clearance": "0.2"},
        **{"tip_radius": "0.1", "gear_shift": "0.1", "bore_ratio": "0.6", "coupling": "ring"},
    },
    "frequency_sweep": {"damping_ratio": "0.1", "n_values": "101", "reading": "swapped", "narrowest": "0.05"},
    "damping_sweep": {
        **{"mesh_frequency": "0.55", "highest": "0.2", "n_values": "51", "n_transient": "1000"},
        **{"n_long": "100", "n_watched": "10000"},
    },
    "method": {"mesh_frequency": "0.95", "reading": "swapped", "n_starts": "2", "n_values": "11"},
    "reproduction": {"n_reached": "2", "phase_step": "90"},
    "reproduction_appendix": {"n_values": "11", "n_fine": "21", "n_search": "11", "n_steps": "2", "n_phases": "2"},
    "library": {"upper": "0.8", "n_values": "21", "damping_ratio": "0.2"},  # both starts lead to one motion
    "impacts": {"mean_force": "0.25", "damping_ratio": "0.06", "reading": "swapped", "n_x": "13", "n_v": "9"},
    "others": {"mean_force": "0.25", "damping_ratio": "0.06", "reading": "swapped", "n_values": "9", "n_speeds": "15"},
    "speed_chart": {  # another pair, from another kind of drawing, whose teeth stay together
        **{
            "pinion_teeth": "25",
            "gear_teeth": "71",
            "module_mm": "2",
            "backlash": "thickness",
            "pinion_torque_nm": "200",
            "damping_ratio": "0.5",
        },
        **{"pinion_shift": "0.2", "gear_added_inertia_kg_m2": "0.01", "n_speeds": "31", "n_starts": "3"},
    },
    "in_service": {  # a car's pair, whose teeth part for a moment
        **{"pinion_teeth": "25", "gear_teeth": "71", "module_mm": "2", "pinion_torque_nm": "20"},
        **{"n_speeds": "31", "n_starts": "2", "ramp_seconds": "0.2", "dip_cycles": "1", "coast_torque_nm": "-5"},
    },
}
# Decimals that a chapter's prose has and that hold for any parameters; the rest is glued, or stands in a cell tagged
# `baseline`.
TYPED = {
    "others": "0.05 0.3 0.5 0.9 1.003 2.4 396.6 4.4 4.8 43.519",
    "frequency_sweep": "0.001 1.3 1.7 4.669",
    "damping_sweep": "0.0003 1.44",
    "impacts": "1.95",
    "in_service": "0.6 1.09 1.5",
    "reproduction_appendix": "0.0002 0.003 0.05",
    "tooth_bending": "0.3 0.6",
}
# A value that the library refuses, and its sentence.
REFUSED = {
    "stiffness": ("gear_teeth", "8", "contact ratio is 0.91"),
    "tooth_bending": ("gear_teeth", "8", "contact ratio is 0.91"),
    "frequency_sweep": (
        "damping_ratio",
        "-0.05",
        "damping_ratio must be a finite number at least 0 and at most 100, got -0.05",
    ),
    "damping_sweep": ("mesh_frequency", "0", "mesh_frequency must be a finite number above 0, got 0.0"),
    "method": ("mesh_frequency", "0", "mesh_frequency must be a finite number above 0, got 0.0"),
    "reproduction": ("phase_step", "7", "phase_step must be"),
    "reproduction_appendix": ("n_values", "1", "n_values must be a whole number of at least 2, got 1"),
    "speed_chart": ("pinion_teeth", "8", "contact ratio is 0.91"),
    "in_service": ("dip_cycles", "0", "dip_cycles must be a whole number of at least 1, got 0"),
    "others": ("error_amplitude", "-1", "error_amplitude must be a finite number at least 0, got -1.0"),
    "library": ("damping_ratio", "-1", "damping_ratio must be a finite number at least 0 and at most 100, got -1.0"),
    "impacts": ("error_amplitude", "-1", "error_amplitude must be a finite number at least 0, got -1.0"),
}


def code_cells(path):
    return [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]


def stored_text(path):
    texts = []
    for cell in code_cells(path):
        for output in cell.outputs:
            texts.append(output.get("text", ""))
            texts += [data for mime, data in output.get("data", {}).items() if not mime.startswith("image/")]
    return "\n".join(texts)


def test_the_table_of_contents_lists_every_chapter():
    assert sorted(CHAPTERS) == sorted(path.stem for path in (ROOT / "notebooks").glob("*.ipynb"))
    assert set(CHANGED) == set(REFUSED) == set(CHAPTERS)


@pytest.mark.parametrize("name", CHAPTERS)
def test_a_chapter_declares_its_parameters(name):
    chapter = BOOK.chapter(name)  # raises unless there is one parameters cell of annotated literals with comments
    assert chapter.parameters


@pytest.mark.parametrize("name", CHAPTERS)
def test_papermill_can_read_the_parameters_too(name):
    """It warns of a line with two equal signs, and calls that parameter unknown; `... | None` it does not know."""
    chapter = BOOK.chapter(name)
    known = [parameter.name for parameter in chapter.parameters if "|" not in parameter.annotation]
    assert [*inspect_notebook(chapter.path)] == known


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_cells_are_short_calls_into_the_library(path):
    for cell in code_cells(path):
        definitions = [node for node in ast.walk(ast.parse(cell.source)) if hasattr(node, "decorator_list")]
        assert not definitions, f"defined in a chapter: {cell.source}"
        if "parameters" not in cell.metadata.get("tags", []):
            lines = [line for line in cell.source.splitlines() if line.strip()]
            assert len(lines) <= LONGEST_CELL, f"{len(lines)} lines in one cell: {cell.source}"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_figures_have_caption_name_and_alt_text(path):
    for cell in code_cells(path):
        if any("<Figure" in str(output.get("data", {}).get("text/plain", "")) for output in cell.outputs):
            shown = cell.metadata.get("mystnb", {})
            elsewhere = "remove-cell" in cell.metadata.get("tags", [])  # a stamp for another page
            assert elsewhere or shown.get("figure", {}).get("caption"), f"no caption: {cell.source}"
            assert shown.get("figure", {}).get("name", "").startswith("fig-"), f"no name fig-...: {cell.source}"
            assert shown.get("image", {}).get("alt"), f"no alt text: {cell.source}"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_stored_outputs_are_the_same_on_every_machine(path):
    outputs = [output for cell in code_cells(path) for output in cell.outputs]
    assert not [output for output in outputs if output.output_type == "error"]
    assert not [output for output in outputs if output.get("name") == "stderr"], "a warning or a progress bar"
    text = stored_text(path)
    assert not re.search(r" at 0x[0-9a-f]+", text), "the address of an object"
    assert not re.search(r"\d+%\|", text), "a progress bar"
    assert not re.search(r"(/(home|tmp|root|usr)/|[A-Z]:\\)", text), "a path of one machine"
    assert not re.search(r"\d\.\d{7,}", text), "more digits than are the same everywhere: print 3 to 5"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_numbers_glued_into_the_prose_are_formatted_texts(path):
    for cell in code_cells(path):
        for output in cell.outputs:
            record = output.get("data", {}).get("application/papermill.record/text/plain", "''")
            assert record.startswith("'"), f"glue a formatted text, not {record}"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_text_that_is_left_out_elsewhere_defines_nothing_that_others_need(path):
    notebook = nbformat.read(path, as_version=4)
    for cell, after in zip(notebook.cells, [*notebook.cells[1:], new_markdown_cell("# The end")], strict=True):
        if BASELINE in cell.metadata.get("tags", []):
            assert cell.cell_type == "markdown", f"code runs for any parameters: {cell.source}"
            assert not defined_labels(SimpleNamespace(cells=[cell])), f"a label: {cell.source}"
            whole = cell.source.startswith("#") and re.match(r"(\([\w-]+\)=\s+)?#", after.source)
            assert whole or not re.search("^#", cell.source, re.MULTILINE), f"a heading of others: {cell.source}"
            assert len(re.findall("^(```|:::)", cell.source, re.MULTILINE)) % 2 == 0, f"half a block: {cell.source}"


@pytest.mark.parametrize("name", CHAPTERS)
@pytest.mark.slow
def test_a_chapter_runs_with_other_parameters(name, tmp_path):
    chapter = BOOK.chapter(name)
    values = chapter.parse(list(CHANGED[name].items()))
    execute(chapter, tmp_path / "out.ipynb", values, progress=False)
    executed = nbformat.read(tmp_path / "out.ipynb", as_version=4)
    assert any("injected-parameters" in cell.metadata.get("tags", []) for cell in executed.cells)
    assert not [cell.source for cell in executed.cells if BASELINE in cell.metadata.get("tags", [])]
    assert not fallbacks(executed)


@pytest.mark.parametrize("name", CHAPTERS)
def test_no_number_is_typed_into_text_that_is_shown_for_any_parameters(name):
    notebook = nbformat.read(BOOK.chapter(name).path, as_version=4)
    assert {*typed_numbers(notebook)} <= {*TYPED.get(name, "").split()}
    assert not fallbacks(notebook)


@pytest.mark.parametrize(
    ("source", "text", "lost"),
    [
        ("chaos reaches from about\n{glue:text}`found`.", "nowhere", True),
        ("it is found {glue:text}`found`.", "nowhere", False),
        ("up to {glue:text}`found` rpm", "nan", True),
        ("the flips at {glue:text}`found` and", "–", True),
        ("ranges {glue:text}`found`", "0.7–1.7", False),
        ("has {glue:text}`found` left", "None", True),
        ("It ends. {glue:text}`found` of them is left", "None", False),
        ("and {glue:text}`found` of them is left", "none", False),
    ],
)
def test_a_word_for_what_was_not_found_is_seen_where_it_makes_no_sentence(source, text, lost):
    output = new_output(
        "display_data",
        data={"application/papermill.record/text/plain": repr(text)},
        metadata={"scrapbook": {"name": "found"}},
    )
    cells = [new_markdown_cell(source), new_code_cell("glue()", outputs=[output])]
    assert bool(fallbacks(new_notebook(cells=cells))) == lost


def test_a_typed_number_is_seen_but_the_articles_and_those_of_tasks():
    sources = ["at 0.865 and 1.234, $x = 2.345$, `3.456`", "```{exercise} A\nTake 4.567.\n```", "at 5.678"]
    cells = [new_markdown_cell(source) for source in sources]
    cells[2].metadata["tags"] = [BASELINE]
    assert typed_numbers(new_notebook(cells=cells)) == ["1.234"]


@pytest.mark.slow
def test_a_chapter_takes_a_drive_from_its_file(tmp_path):
    """Torque and teeth are those of the file and not those of the parameters cell."""
    drive = gp.GearDrive.from_pair(
        gp.SpurPair(20, 31), pinion_torque_nm=45.0, backlash_um=80.0, transmission_error_um=2.0, damping_ratio=0.06
    )
    drive.to_file(tmp_path / "pair.yml")
    with (tmp_path / "pair.yml").open("a") as file:
        file.write("service_rpm: [1000, 2000]\n")
    chapter = BOOK.chapter("in_service")
    few = [("n_speeds", "21"), ("n_starts", "0"), ("ramp_seconds", "0.2")]
    values = chapter.parse([("drive", str(tmp_path / "pair.yml")), *few])
    execute(chapter, tmp_path / "out.ipynb", values, progress=False)
    text = stored_text(tmp_path / "out.ipynb")
    assert "; in service, from 1000 to 2000 rpm" in text
    assert "'45'" in text and "120" not in re.findall(r"'(\d+)'", text)


@pytest.mark.slow
def test_the_speed_chart_takes_all_of_a_drives_file(tmp_path):
    """A pair that its gear drives, with relieved tips, a measured error, a grade and speeds below all resonances."""
    (tmp_path / "pair.yml").write_text(
        "pinion_teeth: 16\ngear_teeth: 24\nmodule_mm: 4.5\nface_width_mm: 20\npinion_shift: 0.8532\n"
        "gear_shift: -0.5\nbacklash_um: 150\niso_grade: 5\ntransmission_error_um: [[1, 3.0, 0.4]]\n"
        "pinion_torque_nm: -302\nhighest_rpm: 4000\nservice_rpm: [500, 3000]\npinion_relief_um: 8\nrelief_length: 0.3\n"
        "n_speeds: 9\nn_starts: 0\n"
    )
    chapter, file = BOOK.chapter("speed_chart"), read_drive_file(tmp_path / "pair.yml")
    execute(chapter, tmp_path / "out.ipynb", chapter.parse([("drive", str(file.path))]), progress=False)
    text = stored_text(tmp_path / "out.ipynb")
    speeds, drive = np.linspace(500.0, 4000.0, 9), file.made(gp.GearDrive)
    chart = gp.design.speed_chart(drive, speeds, n_starts=0)
    iso = gp.design.iso_dynamic_factor(drive, speeds, **file.iso_deviations)
    told = gp.design.verdict(chart, iso, (500.0, 3000.0))
    assert all(sentence in text for sentence in (told.service, told.worst, told.quiet, told.reach))
    assert "'No phase had to be chosen" in text and "as it is" in text and not re.search(r"\bnan\b", text)


@pytest.mark.parametrize("name", CHAPTERS)
def test_a_chapter_checks_its_parameters_before_a_kernel_starts(name):
    """Its first cell after the parameters calls `check_parameters`, and so does the command line."""
    chapter = BOOK.chapter(name)
    assert chapter.stands_for is not None
    parameter, value, sentence = REFUSED[name]
    with pytest.raises(StudyError) as refusal:
        chapter.parse([(parameter, value)])
    assert sentence in str(refusal.value)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["-p", "mesh_frequency", "0"], "mesh_frequency must be a finite number above 0, got 0"),
        (
            ["-p", "highest", "200"],
            "highest: damping_ratio must be a finite number at least 0 and at most 100, got 200.0",
        ),
        (["-f", "mine.yml"], "n_values must be a whole number of at least 2, got 1"),
        (
            ["-p", "mesh_frequnecy", "0.8"],
            "this chapter has no parameter 'mesh_frequnecy'; did you mean 'mesh_frequency'?",
        ),
    ],
)
@pytest.mark.slow
def test_papermill_itself_stops_at_what_is_out_of_range(tmp_path, words, sentence):
    (tmp_path / "mine.yml").write_text("n_values: 1\n")
    command = [sys.executable, "-m", "papermill", str(BOOK.chapter("damping_sweep").path), "out.ipynb", *words]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    result = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert result.returncode != 0
    assert f"ValueError: {sentence}" in result.stderr
    ran = [cell for cell in code_cells(tmp_path / "out.ipynb") if cell.execution_count]
    assert "check_parameters" in ran[-1].source  # nothing after it was run


@pytest.mark.slow
def test_nbval_sees_a_broken_library(small_book, tmp_path):
    """The stored outputs are compared for real: one changed constant in the library, and nbval is red."""
    notebook = write_notebook(small_book / "notebooks" / "small.ipynb", MEAN)
    accept_outputs(Book(small_book), progress=False)
    assert nbval(notebook, ROOT).returncode == 0

    for path in (ROOT / "gearpair").rglob("*.py"):
        copy = tmp_path / "broken" / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        source = path.read_text(encoding="utf-8")
        copy.write_text(source.replace("(1.0 + a, 1.0 - b)", "(1.0 + a, 1.001 - b)"), encoding="utf-8")
    result = nbval(notebook, tmp_path / "broken")
    assert result.returncode == 1, result.stdout
    assert "0.9464" in result.stdout and "0.9467" in result.stdout


@pytest.mark.parametrize(
    ("cell", "sentence"),
    [
        ("import warnings; warnings.warn('careful')", "Cell wrote to stderr: a warning, or a progress bar"),
        ("1 / 0", "chapter small failed in code cell 2 (cell 3 of the notebook): ZeroDivisionError: division by zero"),
    ],
)
@pytest.mark.slow
def test_a_warning_and_an_error_of_a_chapter_are_seen(small_book, cell, sentence):
    notebook = write_notebook(small_book / "notebooks" / "small.ipynb", cell)
    result = nbval(notebook, ROOT)
    assert result.returncode == 1
    assert sentence in result.stdout


def nbval(notebook, library):
    """Have `notebook` compared as `make test` does, with the package found in the directory `library`."""
    shutil.copy(ROOT / "notebooks" / "conftest.py", notebook.parent)
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider"]
    command += ["-c", "/dev/null", "--rootdir", str(notebook.parent), str(notebook)]
    environment = {**os.environ, "PYTHONPATH": str(library)}
    return subprocess.run(command, env=environment, cwd=notebook.parent, capture_output=True, text=True)
