"""Bad input gets one sentence: the name, the value, and what is allowed."""

import math
from collections.abc import Collection, Mapping
from numbers import Integral, Real
from typing import Any


def check_number(
    name: str,
    value: Any,
    *,
    above: float | None = None,
    at_least: float | None = None,
    below: float | None = None,
    at_most: float | None = None,
) -> float:
    """Return `value` as a float, or raise a ValueError that names it and the allowed range."""
    is_number = isinstance(value, (float, Real)) and not isinstance(value, bool)  # most are floats, and told faster
    number = float(value) if is_number else math.nan
    if (
        math.isfinite(number)
        and (above is None or number > above)
        and (at_least is None or number >= at_least)
        and (below is None or number < below)
        and (at_most is None or number <= at_most)
    ):
        return number
    limits = [
        f"{word} {limit:g}"
        for word, limit in (("above", above), ("at least", at_least), ("below", below), ("at most", at_most))
        if limit is not None
    ]
    allowed = "a finite number" + (" " + " and ".join(limits) if limits else "")
    raise ValueError(f"{name} must be {allowed}, got {number if is_number else value!r}")


def check_fields(of: Any, **limits: Mapping[str, float]) -> None:
    """Let fields of a frozen dataclass be floats within limits, as `check_number` has them, or None by default."""
    for name, limit in limits.items():
        if getattr(of, name) is not None or getattr(type(of), name, 0.0) is not None:
            object.__setattr__(of, name, check_number(name, getattr(of, name), **limit))


def check_count(name: str, value: Any, *, at_least: int = 1) -> int:
    """Return `value` as an int, or raise a ValueError."""
    if isinstance(value, bool) or not isinstance(value, Integral) or value < at_least:
        raise ValueError(f"{name} must be a whole number of at least {at_least}, got {value!r}")
    return int(value)


def check_options(options: Mapping[str, Any], allowed: Collection[str]) -> None:
    """Raise a TypeError unless all `options` are among the `allowed`."""
    for name, value in options.items():
        if name not in allowed:
            raise TypeError(f"unknown option {name}={value!r}: the options are {', '.join(allowed)}")


def check_choice(name: str, value: Any, choices: Collection[str]) -> None:
    """Raise a ValueError unless `value` is one of `choices`."""
    if value not in choices:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, choices))}, got {value!r}")
