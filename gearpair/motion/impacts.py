"""The impact state of a motion: which flanks touch over its cycle."""

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_number, checked


class ImpactState(StrEnum):
    """Which flanks touch over a cycle; a string, so that it compares with its name."""

    NONE_DRIVE = "none_drive"
    NONE_COAST = "none_coast"
    SINGLE_DRIVE = "single_drive"
    SINGLE_COAST = "single_coast"
    DOUBLE = "double"
    NEVER_IN_CONTACT = "never_in_contact"


IMPACT_STATES = tuple(ImpactState)  # in the order of the codes


@checked
def impact_state(x_min: float, x_max: float) -> ImpactState:
    """The impact state from the extremes of X over a cycle, ``x_min <= x_max``.

    ``none_drive`` (x_min >= 1) and ``none_coast`` (x_max <= -1): always in contact, no impact.
    ``single_drive`` (-1 <= x_min < 1 <= x_max): rattle on the drive side.
    ``double`` (x_min < -1 and x_max > 1): clatter on both.
    ``single_coast`` (x_min <= -1 and -1 < x_max <= 1, where nothing above applies).
    ``never_in_contact``: within the backlash throughout.

    Notes
    -----
    The article, items I1 to I3, which leave the last two unnamed. With a positive mean force a
    bounded motion has mean(k f) = F_m, so `none_coast`, `single_coast` and `never_in_contact`
    cannot be steady states there.

    Examples
    --------
    >>> str(impact_state(0.2, 1.8))
    'single_drive'
    """
    x_min, x_max = check_number("x_min", x_min), check_number("x_max", x_max)
    if x_min > x_max:
        raise ValueError(f"x_min must not exceed x_max, got x_min = {x_min} and x_max = {x_max}")
    return IMPACT_STATES[impact_codes(np.array(x_min), np.array(x_max))]


def impact_codes(x_min: NDArray[np.float64], x_max: NDArray[np.float64]) -> NDArray[np.int8]:
    """`impact_state` of many motions, as indices into `IMPACT_STATES`; -1 where an extreme is not finite.

    Examples
    --------
    >>> [IMPACT_STATES[code].value for code in impact_codes(np.array([0.2, -1.6]), np.array([1.8, 1.5]))]
    ['single_drive', 'double']
    """
    cases = (
        (~(np.isfinite(x_min) & np.isfinite(x_max)), None),
        (x_min >= 1.0, ImpactState.NONE_DRIVE),
        (x_max <= -1.0, ImpactState.NONE_COAST),
        ((x_min >= -1.0) & (x_max >= 1.0), ImpactState.SINGLE_DRIVE),
        ((x_min < -1.0) & (x_max > 1.0), ImpactState.DOUBLE),
        (x_min <= -1.0, ImpactState.SINGLE_COAST),
    )
    codes = np.full(np.shape(cases[0][0]), IMPACT_STATES.index(ImpactState.NEVER_IN_CONTACT), np.int8)
    for case, state in reversed(cases):  # the first that holds is written last
        codes[case] = -1 if state is None else IMPACT_STATES.index(state)
    return codes
