"""Every public function shows in its docstring how it is called; pytest runs these examples as doctests."""

import importlib
import inspect

import pytest

import gearpair as gp

ROOMS = (
    "teeth",
    "motion",
    "ensembles",
    "bifurcations",
    "boundaries",
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


@pytest.mark.parametrize("room", ROOMS)
def test_no_public_function_has_more_than_ten_parameters(room):
    """Of its own: options that many functions share, and a TypedDict documents, count once for all."""
    found = {name: inspect.signature(each).parameters.values() for name, each in public_functions(room).items()}
    counts = {name: sum(each.kind is not each.VAR_KEYWORD for each in own) for name, own in found.items()}
    assert {name: n for name, n in counts.items() if n > 10} == {}


@pytest.mark.parametrize(
    "function, options",
    [
        (gp.steady_state, gp.motion.SettleOptions),
        (gp.sweep, gp.motion.SettleOptions),
        (gp.basins, gp.motion.BatchOptions),
        (gp.parameter_map, gp.motion.BatchOptions),
        (gp.methods.plain_sweep, gp.methods.DiagramOptions),
    ],
)
def test_a_signature_names_its_options_and_they_are_documented_one_by_one(function, options):
    *_, last = inspect.signature(function).parameters.values()
    assert last.kind is last.VAR_KEYWORD
    assert last.annotation == f"Unpack[{options.__name__}]"
    told = "".join(inspect.getdoc(each) for each in (options, gp.motion.SettleOptions))
    assert [name for name in options.__annotations__ if f"\n{name} : " not in told] == []
