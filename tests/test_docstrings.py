"""Every public function shows in its docstring how it is called; pytest runs these examples as doctests."""

import importlib
import inspect

import pytest

ROOMS = ("teeth", "motion", "bifurcations", "design", "methods", "article", "plotting", "teaching", "tables")


def public_functions(room):
    """What the room hands on; all that a room without such a list defines itself."""
    module = importlib.import_module(f"gearpair.{room}")
    own = [
        name for name, each in vars(module).items() if inspect.isfunction(each) and each.__module__ == module.__name__
    ]
    names = getattr(module, "__all__", [name for name in own if not name.startswith("_")])
    return [function for function in (getattr(module, name) for name in names) if inspect.isfunction(function)]


@pytest.mark.parametrize("room", ROOMS)
def test_every_public_function_has_one_short_section_of_examples(room):
    functions = public_functions(room)
    assert functions
    docstrings = {function.__name__: inspect.getdoc(function) or "" for function in functions}
    assert [name for name, text in docstrings.items() if text.count("Examples\n--------\n>>> ") != 1] == []
