"""What a chapter declares, and how the command line reads it."""

import pytest

from gearpair.study.chapters import Parameter, read_chapter, read_parameters
from gearpair.study.errors import StudyError
from tests.support.notebooks import write_notebook


@pytest.mark.parametrize(
    ("annotation", "text", "value"),
    [
        ("float", "0.05", 0.05),
        ("float", "1e-3", 1e-3),
        ("float", "2", 2.0),
        ("float", "-.5", -0.5),
        ("int", "34", 34),
        ("bool", "true", True),
        ("str", "0.7", "0.7"),
        ("list[float]", "[0.7, 1e-3, 2]", [0.7, 1e-3, 2.0]),
        ("float | None", "none", None),
        ("float | None", "1", 1.0),
    ],
)
def test_a_typed_text_becomes_a_value_of_the_declared_type(annotation, text, value):
    parsed = Parameter("name", annotation, None, "comment").parse(text)
    assert parsed == value
    assert type(parsed) is type(value)


@pytest.mark.parametrize(
    ("annotation", "text"),
    [
        ("float", "fast"),
        ("float", "true"),
        ("float", "[1]"),
        ("int", "34.5"),
        ("int", "true"),
        ("bool", "1"),
        ("list[float]", "0.7"),
        ("list[int]", "[1, 2.5]"),
        ("float", "none"),
        ("float", "{"),
    ],
)
def test_a_text_of_another_type_is_refused(annotation, text):
    with pytest.raises(ValueError, match="not "):
        Parameter("name", annotation, None, "comment").parse(text)


@pytest.mark.parametrize(
    ("source", "sentence"),
    [
        ("a = 0.1  # no annotation", "must be an annotated literal"),
        ("a: float = 0.1", "a has no comment"),
        ("a: float = 2 * 3  # computed", "must have a literal for its default"),
        ("a: complex = 1  # not a scalar type", "a has type complex; allowed are float, int"),
        ("a: int = 0.1  # wrong default", "the default of a, 0.1, is not int"),
        ("import math", "must be an annotated literal"),
        ("a: float =", "not Python"),
    ],
)
def test_a_parameters_cell_that_is_no_schema_is_refused(source, sentence):
    with pytest.raises(StudyError, match=sentence):
        read_parameters(source)


def test_a_chapter_needs_its_parameters_cell(tmp_path):
    path = write_notebook(tmp_path / "untagged.ipynb", tags=())
    with pytest.raises(StudyError, match="exactly one cell tagged 'parameters'; it has 0"):
        read_chapter(path)


def test_a_file_that_is_no_notebook_is_named(tmp_path):
    path = tmp_path / "broken.ipynb"
    path.write_text("{")
    with pytest.raises(StudyError, match=r"broken\.ipynb is not a readable notebook"):
        read_chapter(path)
