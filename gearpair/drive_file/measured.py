"""A transmission error that was measured: from a file of numbers to harmonics and shaft orders."""

import csv
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearpair.teeth import SpurPair, error_harmonics, error_orders

MOST_HARMONICS = 12  # over a mesh period
MOST_LINES, LEAST = 24, 0.01  # over a revolution: how many at most, and of the largest deviation from the mean


def measured_error(path: Path, covers: str, pair: SpurPair) -> dict[str, Any]:
    """`transmission_error_um` and `shaft_orders` of `GearDrive.from_pair` from a file of samples.

    Parameters
    ----------
    path : Path
        Lines of numbers, with or without a line of headings: the error in micrometres, or the place and the error.
        Over `covers` at equal steps, the first at a start of a mesh period, the end point left out.
    covers : {"mesh", "pinion", "gear"}
        A mesh period, or a revolution of one of the gears.
    pair : SpurPair
    """
    samples = read_samples(path)
    if covers == "mesh":
        if len(samples) < 3:
            raise ValueError(f"{path} must hold at least 3 samples of a mesh period, got {len(samples)}")
        return {"transmission_error_um": error_harmonics(samples, min(MOST_HARMONICS, (len(samples) - 1) // 2))}
    teeth = pair.pinion_teeth if covers == "pinion" else pair.gear_teeth
    if len(samples) <= 2 * teeth:
        raise ValueError(
            f"{path} must hold more than {2 * teeth} samples of a revolution of the {covers}, got {len(samples)}"
        )
    least = LEAST * float(np.abs(samples - samples.mean()).max())
    harmonics, orders = error_orders(samples, teeth, least_um=least, most=MOST_LINES)
    return {"transmission_error_um": harmonics, "shaft_orders": orders}


def read_samples(path: Path) -> NDArray[np.float64]:
    """The numbers of the last column, of one or two; the first of two is the place, whose steps must be equal."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise ValueError(f"{path} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{path} is no text file") from None
    separator = next((each for each in (";", "\t", ",") if each in text), ",")
    lines = [(i, row) for i, row in enumerate(csv.reader(text.splitlines(), delimiter=separator), start=1) if any(row)]
    rows: list[list[float]] = []
    for place, (i, row) in enumerate(lines):
        try:
            rows.append([float(cell) for cell in row])
        except ValueError:
            if place:  # the first line may hold headings
                raise ValueError(f"{path}, line {i}, must hold numbers, got {', '.join(row)!r}") from None
    if not rows or {len(row) for row in rows} not in ({1}, {2}):
        raise ValueError(f"{path} must hold one column, the error in micrometres, or two, the place and the error")
    found = np.array(rows)
    if not np.isfinite(found).all():
        raise ValueError(f"{path} must hold finite numbers")
    steps = np.diff(found[:, 0])
    if found.shape[1] == 2 and not np.allclose(steps, steps.mean(), rtol=1e-3, atol=0.0):
        raise ValueError(f"{path} must hold samples at equal steps, got steps from {steps.min():g} to {steps.max():g}")
    return np.asarray(found[:, -1])
