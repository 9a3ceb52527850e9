"""What a chapter declares: its parameters, read from the cell tagged ``parameters``.

That cell is the chapter's schema. Each of its statements is an annotated literal with a comment::

    damping_ratio: float = 0.02  # zeta, at least 0

and nothing else may stand in it. The call of `check_parameters` in the cell after it says what the values are
checked as.
"""

import ast
import io
import re
import tokenize
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
import yaml

from gearpair.parameters import check_parameters, unknown_name
from gearpair.study.errors import StudyError

TAG = "parameters"
SCALARS = {"float": "a number", "int": "a whole number", "bool": "true or false", "str": "a text"}


@dataclass(frozen=True)
class Parameter:
    """One parameter of a chapter, as its line in the cell has it."""

    name: str
    annotation: (
        str  # ``float``, ``int``, ``bool``, ``str``, a ``list[...]`` of one of these, or one of these ``| None``
    )
    default: Any
    comment: str

    @property
    def allowed(self) -> str:
        """The annotation in words.

        Examples
        --------
        >>> Parameter("shown", "list[float] | None", None, "frequencies").allowed
        'a list of numbers such as [1, 2], or none'
        """
        kind, in_list, optional = _type(self.annotation)
        word = f"a list of {SCALARS[kind].split(' ', 1)[1]}s such as [1, 2]" if in_list else SCALARS[kind]
        return f"{word}, or none" if optional else word

    def parse(self, text: str) -> Any:
        """The value that `text`, typed on a command line, stands for, or a ValueError.

        Examples
        --------
        >>> Parameter("damping_ratio", "float", 0.02, "zeta").parse("1e-3")
        0.001
        >>> Parameter("gear_teeth", "int", 34, "z2").parse("34.5")
        Traceback (most recent call last):
            ...
        ValueError: not a whole number
        """
        kind, in_list, optional = _type(self.annotation)
        if optional and text.strip().lower() in {"none", "null", "~", ""}:
            return None
        if kind == "str" and not in_list:
            return text
        try:
            return self.convert(yaml.safe_load(text))
        except yaml.YAMLError:
            return self.convert(text)

    def convert(self, value: Any) -> Any:
        """`value`, read from a YAML file, as the declared type, or a ValueError.

        Examples
        --------
        >>> Parameter("first_start", "list[float]", [1.0, 0.0], "X and X'").convert([1, "1e-3"])
        [1.0, 0.001]
        """
        kind, in_list, optional = _type(self.annotation)
        if optional and value is None:
            return None
        if not in_list:
            return _scalar(kind, value)
        if not isinstance(value, list):
            raise ValueError("not a list")
        return [_scalar(kind, element) for element in value]

    def suits(self, value: Any) -> bool:
        """Whether `value` is of the declared type as it stands (a whole number will do for a float)."""
        try:
            return self.convert(value) == value
        except ValueError:
            return False


def _type(annotation: str) -> tuple[str, bool, bool]:
    """The scalar's type, whether the annotation is a list of it, and whether None is allowed."""
    match = re.fullmatch(rf"(list\[)?({'|'.join(SCALARS)})(?(1)\])( \| None)?", annotation)
    if match is None:
        raise ValueError(f"no type of a parameter: {annotation}")
    return match[2], match[1] is not None, match[3] is not None


def _scalar(kind: str, value: Any) -> Any:
    """`value` as `kind`; YAML reads 1e-3 as a text, so a text is tried as a number."""
    if type(value).__name__ == kind:
        return value
    if kind == "float" and type(value) in (int, str):
        return float(value)
    raise ValueError(f"not {SCALARS[kind]}")


@dataclass(frozen=True)
class Chapter:
    """A parameterised notebook and what it declares; `seconds` is about how long it takes, 0 where that is short."""

    path: Path
    title: str
    parameters: tuple[Parameter, ...]
    stands_for: Mapping[str, str] | None = None
    seconds: float = 0.0

    @property
    def name(self) -> str:
        """How the command line calls it: the notebook's file name without its suffix."""
        return self.path.stem

    @property
    def defaults(self) -> dict[str, Any]:
        """The value of each parameter as the chapter has it."""
        return {parameter.name: parameter.default for parameter in self.parameters}

    def parse(self, given: Iterable[tuple[str, str]], file: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """The parameters to change, checked: types by the schema, ranges and relations by the library.

        `given` are names and texts, as typed on a command line; they go before the names and values of a YAML `file`.

        Raises
        ------
        StudyError
            Naming the first parameter that is unknown or wrong, the value, and what is allowed.
        """
        known = {parameter.name: parameter for parameter in self.parameters}
        values: dict[str, Any] = {}
        read = [(name, value, False) for name, value in (file or {}).items()]
        for name, value, typed in read + [(name, text, True) for name, text in given]:
            if name not in known:
                raise StudyError(unknown_name(name, [*known], self.name))
            try:
                values[name] = known[name].parse(value) if typed else known[name].convert(value)
            except ValueError:
                raise StudyError(f"{name} of {self.name} must be {known[name].allowed}, got {value!r}") from None
        if self.stands_for is not None:
            try:
                check_parameters(self.defaults | values, **self.stands_for)
            except ValueError as error:
                raise StudyError(str(error)) from None
        return values

    def convert(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """`parse` for values from a YAML file alone."""
        return self.parse([], values)


def read_chapter(path: Path) -> Chapter:
    """Read a chapter's title and schema.

    Raises
    ------
    StudyError
        If the file is not a notebook, or its parameters cell is missing, doubled or not made of annotated literals
        with a comment each.
    """
    try:
        notebook = nbformat.read(path, as_version=4)
    except FileNotFoundError:
        raise StudyError(f"there is no notebook {path}") from None
    except Exception as error:
        raise StudyError(f"{path} is not a readable notebook: {str(error).splitlines()[0]}") from error
    tagged = [cell for cell in notebook.cells if TAG in cell.metadata.get("tags", [])]
    if len(tagged) != 1:
        raise StudyError(f"{path} must have exactly one cell tagged {TAG!r}; it has {len(tagged)}")
    parameters = tuple(read_parameters(tagged[0].source, str(path)))
    after = notebook.cells[notebook.cells.index(tagged[0]) + 1 :]
    seconds = float(notebook.metadata.get("gearpair", {}).get("seconds", 0.0))
    return Chapter(path, _title(notebook, path), parameters, _stands_for(after), seconds)


def _stands_for(cells: list[nbformat.NotebookNode]) -> dict[str, str] | None:
    """The keywords that the first code cell gives to `check_parameters`; None where it does not call it."""
    source = next((cell.source for cell in cells if cell.cell_type == "code"), "")
    try:
        calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    except SyntaxError:  # it runs, or not, in IPython
        return None
    for call in calls:
        if ast.unparse(call.func).endswith("check_parameters"):
            return {str(word.arg): ast.literal_eval(word.value) for word in call.keywords}
    return None


def read_parameters(source: str, where: str = "the parameters cell") -> list[Parameter]:
    """Parameters declared by the text of a parameters cell.

    Examples
    --------
    >>> read_parameters("damping_ratio: float = 0.02  # zeta")
    [Parameter(name='damping_ratio', annotation='float', default=0.02, comment='zeta')]
    """
    try:
        statements = ast.parse(source).body
    except SyntaxError as error:
        raise StudyError(f"{where}: the parameters cell is not Python: {error}") from error
    comments = _comments(source)
    found = []
    for statement in statements:
        text = ast.unparse(statement)
        if not (isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name) and statement.value):
            raise StudyError(f"{where}: {text!r} must be an annotated literal such as 'a: float = 0.1  # what it is'")
        name, annotation = statement.target.id, ast.unparse(statement.annotation)
        try:
            _type(annotation)
        except ValueError:
            allowed = f"{', '.join(SCALARS)} and list[...]"
            raise StudyError(f"{where}: {name} has type {annotation}; allowed are {allowed}") from None
        try:
            default = ast.literal_eval(statement.value)
        except ValueError:
            raise StudyError(f"{where}: {text!r} must have a literal for its default") from None
        parameter = Parameter(name, annotation, default, comments.get(statement.end_lineno or 0, ""))
        if not parameter.suits(default):
            raise StudyError(f"{where}: the default of {name}, {default!r}, is not {annotation}")
        if not parameter.comment:
            raise StudyError(f"{where}: {name} has no comment that says what it is")
        found.append(parameter)
    return found


def _comments(source: str) -> dict[int, str]:
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return {t.start[0]: t.string.lstrip("# ").strip() for t in tokens if t.type == tokenize.COMMENT}


def _title(notebook: nbformat.NotebookNode, path: Path) -> str:
    prose = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    if title := re.search("^# (.*)$", prose, re.MULTILINE):
        return title[1].strip()
    raise StudyError(f"{path} has no title: no markdown line that starts with '# '")
