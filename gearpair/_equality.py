"""When two results that hold arrays are equal."""

from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

Result = TypeVar("Result")


def equal_by_value(cls: type[Result]) -> type[Result]:
    """Let two objects of a dataclass be equal when all their fields are; nan is equal to nan.

    The comparison that dataclasses come with fails on arrays. Such an object has no hash.
    """

    def equal(self: Any, other: object) -> bool:
        if type(other) is not cls:
            return NotImplemented
        return all(_same(getattr(self, each.name), getattr(other, each.name)) for each in fields(self) if each.compare)

    cls.__eq__ = equal  # type: ignore[method-assign]
    cls.__hash__ = None  # type: ignore[assignment]
    return cls


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind in "fc")
    return bool(a == b or (a != a and b != b))  # nan alone differs from itself
