"""Every public function shows in its docstring how it is called; pytest runs these examples as doctests."""

import importlib
import inspect

import pytest

ROOMS = (
    "teeth",
    "motion",
    "ensembles",
    "bifurcations",
    "design",
    "methods",
    "article",
    "article.case",
    "plotting",
    "teaching",
)


def public_functions(room):
    """What the room hands on; all that a room without such a list defines itself."""
    module = importlib.import_module(f"gearpair.{room}")
    own = [name for name, each in vars(module).items() if getattr(each, "__module__", "") == module.__name__]
    names = getattr(module, "__all__", [name for name in own if not name.startswith("_")])
    found = {name: getattr(module, name) for name in names}
    return {name: each for name, each in found.items() if inspect.isfunction(inspect.unwrap(each))}


@pytest.mark.parametrize("room", ROOMS)
def test_every_public_function_has_one_short_section_of_examples(room):
    functions = public_functions(room)
    assert functions
    docstrings = {name: inspect.getdoc(function) or "" for name, function in functions.items()}
    assert [name for name, text in docstrings.items() if text.count("Examples\n--------\n>>> ") != 1] == []
