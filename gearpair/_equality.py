"""When two results that hold arrays are equal, and how they are told in a line."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

Result = TypeVar("Result")
LONGEST = 120  # characters of a part of a line


def equal_by_value(cls: type[Result]) -> type[Result]:
    """Let two objects of a dataclass be equal when all their fields are; nan is equal to nan.

    The comparison that dataclasses come with fails on arrays. Equal ones have one hash, so that they may be members of
    a set. Unless the class says it in its own way, its `repr` is one line: of an array its shape and range.
    """

    def equal(self: Any, other: object) -> bool:
        if type(other) is not cls:
            return NotImplemented
        return all(_same(getattr(self, each.name), getattr(other, each.name)) for each in fields(self) if each.compare)

    def hashed(self: Any) -> int:
        return hash((cls, *(_mark(getattr(self, each.name)) for each in fields(self) if each.compare)))

    def told(self: Any) -> str:
        parts = (f"{each.name}={_told(getattr(self, each.name))}" for each in fields(self) if each.repr)
        return f"{cls.__name__}({', '.join(parts)})"

    cls.__eq__ = equal  # type: ignore[method-assign]
    cls.__hash__ = hashed  # type: ignore[method-assign]
    if cls.__dataclass_params__.repr:  # type: ignore[attr-defined]
        cls.__repr__ = told  # type: ignore[method-assign]
    return cls


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind in "fc")
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return False
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(map(_same, a, b))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        if hasattr(a, "identical"):  # a dataset
            return bool(a.identical(b))
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    return bool(a == b or (a != a and b != b))  # nan alone differs from itself


def _mark(value: Any) -> Any:
    """What two equal values have in common, and can be hashed; not the numbers in it, for -0 is 0 and nan is nan."""
    if isinstance(value, np.ndarray):
        return value.shape
    if isinstance(value, (list, tuple)):
        return tuple(map(_mark, value))
    if isinstance(value, Mapping):
        return tuple(map(str, value))
    return 0 if value != value or type(value).__hash__ is None else value


def _told(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return _array_told(value)
    if isinstance(value, Mapping):
        return f"{type(value).__name__} of {', '.join(map(str, value))}"
    if isinstance(value, (list, tuple)) and len(value) > 8:
        return f"{type(value).__name__} of {len(value)}"
    text = repr(str(value)) if isinstance(value, str) else " ".join(repr(value).split())
    return text if len(text) <= LONGEST else f"{type(value).__name__}(...)"


def _array_told(values: "np.ndarray[Any, Any]") -> str:
    """An array in words: all of it where it is short."""
    if values.size <= 4 and values.ndim <= 1:
        return str(np.array2string(values, precision=6, separator=", "))
    text = f"<{values.dtype} {values.shape}"
    finite = values[np.isfinite(values)] if values.dtype.kind in "fiu" else np.empty(0)
    if finite.size:
        text += f" from {finite.min():.4g} to {finite.max():.4g}"
    if values.dtype.kind == "f" and finite.size < values.size:
        text += f", {values.size - finite.size} not finite"
    return text + ">"
