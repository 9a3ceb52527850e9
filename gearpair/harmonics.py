"""What a transmission error is made of: sinusoids of the mesh, and of the shafts."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np

from gearpair._checks import check_count, check_number, is_number, shown

LARGEST_ORDER = 200  # of a harmonic: the cells of a period are as many times ten


class Harmonic(NamedTuple):
    """A harmonic of the transmission error, ``amplitude * sin(order * Omega tau + phase)``."""

    order: int  # multiple of the mesh frequency
    amplitude: float  # over half the backlash in an `Oscillator`, in micrometres in a `GearDrive`
    phase: float = 0.0  # at the start of a mesh period, in radians


class ShaftOrder(NamedTuple):
    """An error that repeats with a wheel's revolution, ``amplitude * sin(order * Omega tau / teeth + phase)``.

    Run-out has the order 1, an oval wheel 2; pitch errors have many.
    """

    teeth: int  # of the wheel that has it: mesh periods of its revolution
    amplitude: float  # over half the backlash in an `Oscillator`, in micrometres in a `GearDrive`
    phase: float = 0.0  # at the start of a base period, in radians
    order: int = 1  # waves in a revolution


Line = TypeVar("Line", Harmonic, ShaftOrder)
Error = float | Sequence[Harmonic | tuple[int, float, float]]  # an amplitude, or all harmonics


def check_harmonics(name: str, harmonics: Any, lowest: int = 2) -> tuple[Harmonic, ...]:
    """`harmonics` of orders from `lowest` as named tuples, or a ValueError that says which is wrong."""
    checked: list[Harmonic] = []
    if isinstance(harmonics, (str, bytes)) or not isinstance(harmonics, Iterable):
        raise ValueError(f"{name} must be a sequence of (order, amplitude, phase), got {harmonics!r}")
    for i, each in enumerate(harmonics):
        if np.shape(each) not in ((2,), (3,)):
            raise ValueError(f"{name}[{i}] must be (order, amplitude, phase), got {each!r}")
        given = Harmonic(*each)
        order = check_count(f"{name}[{i}] order", given.order, at_least=lowest)
        check_number(f"{name}[{i}] order", order, at_most=LARGEST_ORDER)
        amplitude = check_number(f"{name}[{i}] amplitude", given.amplitude, at_least=0.0)
        checked.append(Harmonic(order, amplitude, check_number(f"{name}[{i}] phase", given.phase)))
    return tuple(checked)


def check_shaft_orders(name: str, given: Any) -> tuple[ShaftOrder, ...]:
    """Errors of shafts as named tuples, or a ValueError that says which is wrong."""
    form = "(teeth, amplitude, phase, order)"
    if isinstance(given, (str, bytes)) or not isinstance(given, Iterable):
        raise ValueError(f"{name} must be a sequence of {form}, got {shown(given)}")
    found: list[ShaftOrder] = []
    for i, each in enumerate(given):
        if np.shape(each) not in ((2,), (3,), (4,)):
            raise ValueError(f"{name}[{i}] must be {form}, got {shown(each)}")
        teeth, amplitude, phase, order = ShaftOrder(*each)
        found.append(
            ShaftOrder(
                check_count(f"{name}[{i}] teeth", teeth),
                check_number(f"{name}[{i}] amplitude", amplitude, at_least=0.0),
                check_number(f"{name}[{i}] phase", phase),
                check_count(f"{name}[{i}] order", order),
            )
        )
        check_number(f"{name}[{i}] order", found[-1].order, at_most=LARGEST_ORDER * found[-1].teeth)
    return tuple(found)


def summed_harmonics(*harmonics: Harmonic) -> tuple[Harmonic, ...]:
    """One harmonic for each order: those of one order added as phasors."""
    sums: dict[int, complex] = {}
    for order, amplitude, phase in harmonics:
        sums[order] = sums.get(order, 0.0) + cmath.rect(amplitude, phase)
    return tuple(Harmonic(order, *cmath.polar(each)) for order, each in sorted(sums.items()))


def error_fields(given: Error, present: float, others: tuple[Harmonic, ...]) -> dict[str, Any]:
    """The fields of a drive's transmission error from its amplitude, or from all its harmonics.

    An amplitude takes the harmonics beyond the first, `others`, with it from the one at `present`.
    """
    if is_number(given):
        size = check_number("transmission_error_um", given, at_least=0.0)
        rest = tuple(each._replace(amplitude=each.amplitude * size / present) for each in others if present)
        return {"transmission_error_um": size, "error_harmonics": rest or others}
    error = check_harmonics("transmission_error_um", given, lowest=1)
    first = next((each for each in error if each.order == 1), Harmonic(1, 0.0))
    rest = tuple(each for each in error if each.order > 1)
    return {"transmission_error_um": first.amplitude, "error_phase_rad": first.phase, "error_harmonics": rest}


def scaled(lines: Iterable[Line], unit: float) -> tuple[Line, ...]:
    """Harmonics or shaft orders in other units."""
    return tuple(each._replace(amplitude=each.amplitude * unit) for each in lines)
