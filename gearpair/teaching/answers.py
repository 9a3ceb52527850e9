"""Answers out of a student's notebook as plain data, so that nothing of the student's runs where marks are given."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from numbers import Complex, Integral, Real
from typing import Any

import numpy as np

from gearpair.teaching.drawings import Curve, Drawing, drawing

LONGEST = 4_000_000  # characters of one report: some hundred thousand numbers


@dataclass(frozen=True)
class Unreadable:
    """An answer that is no number, text, truth value, list of these or figure; its `kind` is what it is instead."""

    kind: str


def report(names: Iterable[str], answers: Mapping[str, Any]) -> str:
    """Some of a notebook's variables as one text for `read_report`; those that do not exist are left out.

    Parameters
    ----------
    names : iterable of str
        The variables asked for.
    answers : mapping of str to object
        All variables, such as ``globals()``.

    Examples
    --------
    >>> read_report(report(["a", "b"], {"a": 1.5}))
    {'a': 1.5}
    """
    text = json.dumps({name: _plain(answers[name]) for name in names if name in answers})
    if len(text) > LONGEST:
        raise ValueError(f"the answers are too long: {len(text)} characters, at most {LONGEST} are read")
    return text


def read_report(text: str) -> dict[str, Any]:
    """The answers in a text of `report`, or of somebody who would like it to be taken for that.

    Of what cannot be read there are none.

    Returns
    -------
    dict of str to object
        None, bool, int, float, complex, str, lists, ndarrays, `Drawing` and `Unreadable`.

    Examples
    --------
    >>> read_report("{")
    {}
    """
    try:
        data = json.loads(text) if len(text) <= LONGEST else {}
        return {str(name): _restored(value) for name, value in data.items()} if isinstance(data, dict) else {}
    except (ValueError, TypeError, KeyError, RecursionError):
        return {}


def _plain(value: Any) -> Any:
    if value is None or isinstance(value, bool | np.bool_):
        return None if value is None else bool(value)
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        return float(value)
    if isinstance(value, str):
        return str(value)
    if isinstance(value, Complex):
        return {"complex": [complex(value).real, complex(value).imag]}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, np.ndarray) and value.dtype.kind in "biuf":
        return _plain(value.item()) if value.ndim == 0 else {"array": value.tolist()}
    if (drawn := drawing(value)) is not None:
        curves = [[curve.label, curve.x.tolist(), curve.y.tolist()] for curve in drawn.curves]
        return {"drawing": [curves, drawn.x_label, drawn.y_label]}
    return {"unreadable": type(value).__name__}


def _restored(value: Any) -> Any:
    if isinstance(value, list):
        return [_restored(each) for each in value]
    if not isinstance(value, dict):
        return value
    if "complex" in value:
        return complex(*value["complex"])
    if "array" in value:
        return np.asarray(value["array"], dtype=float)
    if "drawing" in value:
        curves, x_label, y_label = value["drawing"]
        arrays = ((str(label), np.asarray(x, dtype=float), np.asarray(y, dtype=float)) for label, x, y in curves)
        return Drawing(tuple(Curve(*each) for each in arrays), str(x_label), str(y_label))
    return Unreadable(str(value.get("unreadable", "an object")))
