"""What the machine that settles (`settle`) is handed, works with and fills in."""

from typing import NamedTuple

import numpy as np

from ._kernel import Array, Integers, allocating_kernel, kernel
from .capture import COLUMNS
from .cells import Coefficients
from .closed_form import TERMS
from .measures import N_MEASURES
from .walk import OK

PERIODIC, APERIODIC, UNSETTLED, GONE, CAPPED, EXHAUSTED, TRANSIENT, FLOATING = 0, 1, 2, 3, 4, 5, 6, 7
NOT_RUN = -1  # what a row is filled with beforehand


class Limits(NamedTuple):
    """How far to look."""

    max_period: int  # the longest period looked for
    n_exponent: int  # mesh periods over which exponents are measured
    n_watch: int  # mesh periods that a motion is then watched for; without damping nothing settles, and it is not
    most: int  # mesh periods of one motion at most; one that would need more is followed for as many and not judged


class Lanes(NamedTuple):
    """A batch of motions, one lane each, of some oscillators."""

    scalars: Array  # (m, 6): mean force, error amplitude, error phase, damping ratio, that in flight, mesh frequency
    edges: Array  # (m, n_levels + 1)
    levels: Array  # (m, n_levels)
    harmonics: Array  # (m, n_harmonics, 3)
    own: Integers  # (n,) row of the lane's oscillator
    starts: Array  # (n, 2)
    n_transient: Integers  # (n,)
    mesh_periods: int  # that the base period of every oscillator has


class Settled(NamedTuple):
    """What became of each lane; the arrays have one row a lane, filled beforehand with what stands for "not run"."""

    status: Integers  # (n,) PERIODIC ... FLOATING, or NOT_RUN
    period: Integers  # (n,) 0 unless PERIODIC
    points: Array  # (n, n_samples, 2) successive section points; a cycle starts at its smallest X
    monodromy: Array  # (n, 2, 2) nan unless PERIODIC
    extremes: Array  # (n, 2)
    exponents: Array  # (n, 3): largest, smallest, standard error
    final: Array  # (n, 2) the last section point walked to; of a periodic motion, that of its orbit
    attractor: Integers  # (n,) row of the known attractor that captured the motion, or -1
    way: Array  # (n, 4): mesh periods and impacts until settled, or the transient has passed; smallest and largest X
    lasted: Integers  # (n,) mesh periods followed; of a periodic motion, until it had settled
    chaos: Array  # (n, 3) what it was when observed: smallest and largest X, largest exponent; nan if captured before
    measures: Array  # (n, N_MEASURES), or (n, 0) where they are not asked for


class Known(NamedTuple):
    """Attractors known beforehand."""

    settled: Settled  # one row an attractor
    neighbourhoods: Array  # (m, COLUMNS), OWNER the attractor's row
    lasting: Array  # (k, 4) rows as of `Settled.chaos` of motions on sets that last, and mesh periods watched


class Scratch(NamedTuple):
    """What a thread works with."""

    known: Known
    neighbourhoods: Array  # the known ones first, then room for those of one more cycle
    m: Array  # (2, 2)
    reach: Array  # (4,)
    way: Array  # (4,) the whole way of a motion, as in `Settled`
    series: Array  # (TERMS,)
    measures: Array  # (N_MEASURES,)


class Orbit(NamedTuple):
    """A stable orbit."""

    period: int  # 0: there is none
    x: float
    v: float
    n_neighbourhoods: int  # certified for it, among the scratch


class Course(NamedTuple):
    """Where a motion has been followed to."""

    status: int  # of the walk
    x: float  # the last point reached
    v: float
    held: int  # the neighbourhood that holds it, among the scratch, or -1
    orbit: Orbit  # that captured it, where it is not known


@allocating_kernel
def coefficients_of(lanes: Lanes, i: int) -> Coefficients:
    """Oscillator `i` of a batch."""
    s = lanes.scalars[i]
    return Coefficients(
        s[0], s[1], s[2], s[3], s[4], s[5], lanes.edges[i], lanes.levels[i], lanes.harmonics[i], lanes.mesh_periods
    )


@allocating_kernel
def make_scratch(known: Known, max_period: int) -> Scratch:
    """Scratch for motions of periods up to `max_period`."""
    n = len(known.neighbourhoods)
    neighbourhoods = np.empty((n + max_period, COLUMNS))
    neighbourhoods[:n] = known.neighbourhoods
    return Scratch(
        known, neighbourhoods, np.empty((2, 2)), np.empty(4), np.empty(4), np.empty(TERMS), np.empty(N_MEASURES)
    )


@kernel
def undecided(course: Course) -> bool:
    """Whether a motion stayed bounded and nothing has captured it."""
    return course.status == OK and not captured(course)


@kernel
def captured(course: Course) -> bool:
    """Whether an orbit has captured a motion."""
    return course.held >= 0 or course.orbit.period > 0
