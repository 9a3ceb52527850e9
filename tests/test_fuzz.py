"""Every public function, each argument wrong in turn: a sentence of ours, or a right call; nothing else comes out."""

import importlib
import inspect
import traceback
import warnings

import numpy as np
import pytest
from matplotlib import pyplot as plt

import gearpair as gp
from tests.support import ROOT
from tests.support.good_calls import CALLS, OSC
from tests.support.good_pictures import OBJECTS, PLOTS

ROOMS = ("motion", "ensembles", "bifurcations", "boundaries", "design", "methods", "teeth", "article", "plotting")
WRONG = {
    "None": None,
    "a text": "1.0",
    "nan": float("nan"),
    "inf": float("inf"),
    "minus one": -1,
    "zero": 0,
    "a half": 0.5,
    "a truth value": True,
    "complex": 1 + 1j,
    "a date": np.datetime64("2024-01-01"),
    "masked": np.ma.masked_array([1.0, 2.0], [False, True]),
    "empty": [],
    "nested": [[1.0], [2.0, 3.0]],
    "texts": ["a", "b"],
    "nan among numbers": [1.0, float("nan")],
    "a mapping": {"a": 1},
    "an object": object(),
    "a class": gp.Oscillator,
    "an oscillator": OSC,
    "a wave": OSC.stiffness,
    "a pair": gp.SpurPair(),
}
# Which have a place of their own in the tests, and what matplotlib itself says of colours and lines.
SKIPPED = ("store", "client", "ax", "axes", "colour", "colours", "linestyle")
RIGHT = (ValueError, TypeError, RuntimeError)


def own_sentence(error):
    """Whether an error was raised by a line of the library, and says something in a line."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    text = str(error)
    ours = last.filename.startswith(str(ROOT / "gearpair")) and (last.line or "").startswith("raise ")
    return isinstance(error, RIGHT) and ours and " " in text and "\n" not in text and len(text) < 1000


def surprises(function, good):
    """What else than a sentence or a call without a warning came of a wrong argument."""
    found = []
    names = [name for name in inspect.signature(function).parameters if name not in SKIPPED]
    for name in {**dict.fromkeys(names), **good}:
        for what, wrong in WRONG.items():
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    function(**{**good, name: wrong})
            except Exception as error:
                if not own_sentence(error):
                    found.append(f"{name} = {what}: {type(error).__name__}: {str(error)[:150]}")
            finally:
                plt.close("all")
    return found


LONG = {"identify", "critical_shock", "homoclinic_tangency"}  # a call takes a second, and a test some twenty calls
GOOD = {f"{room}.{name}": call for room, own in CALLS.items() for name, call in own.items()}
GOOD |= {f"plotting.{name}": call for name, call in PLOTS.items()} | OBJECTS
ASKED = [pytest.param(name, marks=[pytest.mark.slow] * (name.split(".")[-1] in LONG)) for name in GOOD]


def asked(name):
    """A public function, of a room or an object, and good arguments of it."""
    good = GOOD[name]()
    room, _, function = name.partition(".")
    return good if isinstance(good, tuple) else (getattr(importlib.import_module(f"gearpair.{room}"), function), good)


@pytest.mark.parametrize("name", ASKED)
def test_a_wrong_argument_gets_a_sentence(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    function, good = asked(name)
    function(**good)
    keywords = {each.name for each in inspect.signature(function).parameters.values() if each.kind is each.VAR_KEYWORD}
    assert [text for text in surprises(function, good) if text.split(" ")[0] not in keywords] == []


def public_functions():
    """Each with the name of its room."""
    for room in ROOMS:
        module = importlib.import_module(f"gearpair.{room}")
        for name in module.__all__:
            if inspect.isfunction(getattr(module, name)):
                yield room, name


def public_methods():
    """Those that take something, of every class that a room or the face hands on."""
    rooms = [gp, *(importlib.import_module(f"gearpair.{room}") for room in ROOMS)]
    handed_on = [getattr(room, name) for room in rooms for name in room.__all__]
    for cls in {each for each in handed_on if inspect.isclass(each)}:
        for name, method in vars(cls).items():
            function = getattr(method, "__func__", method)
            if not inspect.isfunction(function) or (name.startswith("_") and name != "__call__"):
                continue
            if len(inspect.signature(function).parameters) > (not isinstance(method, staticmethod)):
                yield f"{cls.__name__}.{name}"


def test_every_public_function_and_method_is_asked_and_checked():
    """A new one has to be given good arguments; none is left out."""
    assert {f"{room}.{name}" for room, name in public_functions()} | {*public_methods()} <= GOOD.keys()
    for room, name in public_functions():
        function = getattr(importlib.import_module(f"gearpair.{room}"), name)
        assert hasattr(function, "__wrapped__"), f"{room}.{name} lacks @checked"
