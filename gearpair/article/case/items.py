"""The article's numbered items as a table of (item, test, evidence), and the verdicts on them in two readings.

A test takes what was found in one reading and says what that reading gives and whether, or how far, the item holds.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from gearpair.article import published
from gearpair.article.case.boundaries import named_bifurcation, nearest
from gearpair.article.case.existence import WATCHED, Reached
from gearpair.article.case.scoring import axis, published_kind
from gearpair.article.case.two_rotors import two_rotor_difference
from gearpair.article.case.verdicts import FAILS, HOLDS, NEARLY, Decided, Undecided, Verdict, both, grade
from gearpair.article.published import Boundary, Range
from gearpair.article.readings import PRINTED, Hypothesis
from gearpair.bifurcations.doubling import doubling_cascade
from gearpair.bifurcations.locating import Bifurcation
from gearpair.bifurcations.orbits import periodic_orbit
from gearpair.ensembles.planes import basins
from gearpair.ensembles.sweeps import sweep
from gearpair.methods.runge_kutta import runge_kutta_sweep
from gearpair.motion.settling import Status
from gearpair.teeth.spurpair import SpurPair

if TYPE_CHECKING:
    import xarray as xr

ENOUGH = 0.95  # an item about a range holds where the motion is found on this share of it
AXES = ("mesh_frequency", "damping_ratio")
GRID = np.linspace(-3.0, 3.0, 13)  # of starts for the items on impacts
FEW = np.linspace(-1.0, 2.0, 4), np.linspace(-0.6, 0.6, 3)  # and for those on chaos
CLOSE = np.linspace(-0.02, 0.02, 5), np.linspace(-0.02, 0.02, 4)  # about the orbit where doublings were last seen
BEYOND = (0.5, 0.75, 1.0)  # of the gap between the last two doublings: their limit lies 0.27 of it beyond


@dataclass(frozen=True)
class Evidence:
    """What was found in one reading; what has to be computed besides is computed when a test asks for it, and once.

    Parameters
    ----------
    reached : sequence of Reached
        The motions that it has along each published axis, watched for `WATCHED` mesh periods: chaos that ends in that
        time is none.
    changes : sequence of Bifurcation
        In either parameter, of `bifurcations_of`.
    stretch : (float, float)
        From the last flip of period 2 below its chaotic zone to the first above it.
    shares : mapping of str to float
        The share of frequencies at which the ``"rectangle"`` and the ``"sinusoid"`` meet the computed curve's motion.
    """

    hypothesis: Hypothesis
    reached: Sequence[Reached] = ()
    changes: Sequence[Bifurcation] = ()
    stretch: tuple[float, float] = (0.0, 0.0)
    shares: Mapping[str, float] | None = None

    @property
    def printed(self) -> bool:
        """Whether this is the article's own reading; what holds for both is told there."""
        return self.hypothesis == PRINTED

    @cached_property
    def plane(self) -> xr.Dataset:
        """A grid of starts at Omega_h 0.7, zeta 0.02."""
        return basins(self.hypothesis.oscillator(), GRID, GRID)

    @cached_property
    def states(self) -> list[str]:
        """The impact states met there."""
        return sorted({str(state) for state in self.plane.attractor_impact_state.values})

    @cached_property
    def along(self) -> xr.Dataset:
        """A carried sweep along the frequency."""
        values = axis("mesh_frequency", 41)
        return sweep(self.hypothesis.oscillator(), "mesh_frequency", values, n_exponent=400, n_watch=WATCHED)

    @cached_property
    def lasting(self) -> tuple[int, int]:
        """At how many small values of the damping, and of how many, chaos lasts."""
        planes = [
            basins(self.hypothesis.oscillator(damping_ratio=zeta), [-1.0, 0.2, 1.4], [-0.6, 0.6], n_watch=WATCHED)
            for zeta in (0.0005, 0.001, 0.0015, 0.002, 0.0025)
        ]
        return sum(map(has_chaos, planes)), len(planes)


Finding = tuple[str, bool | int]  # what a reading gives, and whether, or how far, the item holds in it
Test = Callable[[Evidence], Finding]


def periods_of(plane: xr.Dataset) -> str:
    """The periods of the attractors of a plane of starts, in words."""
    periods = sorted({int(p) for p in plane.attractor_period.values if p})
    return f"period{'s' if len(periods) > 1 else ''} {', '.join(map(str, periods))}"


def has_chaos(plane: xr.Dataset) -> bool:
    """Whether a plane of starts has a chaotic attractor: a set that no start left while it was watched.

    Examples
    --------
    >>> osc = PRINTED.oscillator(published.CHAOTIC_FREQUENCY)
    >>> has_chaos(basins(osc, [0.0], [0.0])), has_chaos(basins(osc.replace(damping_ratio=0.2), [0.0], [0.0]))
    (True, False)
    """
    return bool(np.any(plane.attractor_status.values == Status.APERIODIC))


def extent(share: float) -> str:
    """A share of a range in words, so that no number hangs on where the values tried happen to lie."""
    if share == 1.0:
        return "on all of it"
    return "on nearly all of it" if share >= ENOUGH else "on part of it" if share > 0.0 else "nowhere in it"


def _two_rotors(found: Evidence) -> Finding:
    alike = two_rotor_difference(found.hypothesis.oscillator()) < 1e-5
    return f"the two rotors differ by {'less' if alike else 'more'} than 1e-5", alike


def _mean_of_the_wave(found: Evidence) -> Finding:
    mean = found.hypothesis.wave.mean
    text = f"mean of k is {mean:.4f}, so k_m is not the average" if found.printed else f"{mean:.4f}"
    return text, abs(mean - 1.0) < 0.005


def _stiff_for(found: Evidence) -> Finding:
    """K2 is asked about by all published motions but the chaos of D1, which has a verdict of its own."""
    share = min(each.coverage_outside(published.CHAOTIC) for each in found.reached)
    where = "all" if share >= ENOUGH else "part"
    stiff = found.hypothesis.wave.durations[0]
    return f"stiff for {stiff:.2f}: the published motions but D1 on {where} of both axes", share >= ENOUGH


def _stiffness_table(found: Evidence) -> Finding:
    rows = published.STIFFNESS_TABLE
    ratios = [SpurPair(row.teeth_pinion, row.teeth_wheel).contact_ratio for row in rows]
    off = max(abs(ratio - row.contact_ratio) for ratio, row in zip(ratios, rows, strict=True))
    both_ways = [(row.contact_ratio - 1.0, 2.0 - row.contact_ratio) for row in rows]
    intervals = both_ways if found.printed else [way[::-1] for way in both_ways]
    means = [1.0 + row.a * stiff - row.b * soft for row, (stiff, soft) in zip(rows, intervals, strict=True)]
    told, told_means = (" ".join(f"{value:.2f}" for value in values) for values in (ratios, means))
    eps = f"eps of 20 degree gears {told}" if found.printed else "the same eps"
    return f"{eps}; means of k {told_means}", off < 0.02 and abs(min(means) - 1.0) < 0.02


def _contact_ratio(found: Evidence) -> Finding:
    row = published.STIFFNESS_TABLE[0]
    ratio = SpurPair(row.teeth_pinion, row.teeth_wheel).contact_ratio
    text = f"eps of 34 against 34 is {ratio:.2f}, its own table has {row.contact_ratio}"
    return text if found.printed else "the same", abs(ratio - published.BASELINE.contact_ratio) < 0.005


def _rectangle(found: Evidence) -> Finding:
    shares = found.shares or {}
    met = [10 * shares[name] for name in ("rectangle", "sinusoid")]
    text = f"rectangle {met[0]:.0f} of 10, sinusoid {met[1]:.0f} of 10"
    return text if found.printed else "the same", met[0] > met[1]


def _quasi_periodic(found: Evidence) -> Finding:
    if found.printed:
        return "no quasi-periodic motion with damping", False
    orbit = periodic_orbit(found.hypothesis.oscillator(), 0.887, -0.337, 1)
    shrink = float(np.exp(-2.0 * orbit.oscillator.damping_ratio * orbit.oscillator.period))
    product = float(np.prod(np.asarray(orbit.multipliers)).real)
    return f"product of multipliers {product:.4f} = exp(-2 zeta T) = {shrink:.4f}", product >= 1.0


def _runge_kutta(found: Evidence) -> Finding:
    osc, values = found.hypothesis.oscillator(), axis("mesh_frequency", 41)
    exact = sweep(osc, "mesh_frequency", values, n_exponent=20, max_period=12).period.values
    drawn = runge_kutta_sweep(osc, "mesh_frequency", values, n_samples=32, rtol=1e-3, atol=1e-6).period.values
    right = float(np.mean((exact == drawn)[exact > 0]))
    return f"at the usual tolerance 1e-3, {right:.0%} of the periods right", right >= ENOUGH


def _range(stated: Range, found: Evidence) -> Finding:
    (along,) = (each for each in found.reached if each.parameter == stated.parameter)
    share = along.within(stated.item)
    return extent(share), share >= ENOUGH


def _boundary(boundary: Boundary, found: Evidence) -> Finding:
    lower, upper = axis(boundary.parameter, 2)
    b = named_bifurcation(boundary, found.changes)
    if b is None:
        return "none of this kind", False
    return f"{b.kind} of period {b.period} at {b.value:.5f}", grade(b.value, boundary.value, upper - lower)


def _chaos(found: Evidence) -> Finding:
    osc = found.hypothesis.oscillator(published.CHAOTIC_FREQUENCY)
    plane = basins(osc, *FEW, max_period=32, n_watch=WATCHED)
    chaotic = has_chaos(plane)
    return "chaos" if chaotic else f"no chaos: {periods_of(plane)}", chaotic


def _near_resonance(found: Evidence) -> Finding:
    (zone,) = (r for r in published.FREQUENCY_RANGES if r.motion == published.COMPLEX)
    resonance = float(np.sqrt(found.hypothesis.wave.mean))
    above = [f"{end / resonance - 1.0:.0%}" for end in (zone.lower, zone.upper)]
    text = f"resonance {resonance:.2f}; the complex zone lies {above[0]} to {above[1]} above"
    return text, zone.lower <= 1.1 * resonance


def _damped(found: Evidence) -> Finding:
    calm = not np.any(found.along.status.values == Status.APERIODIC)
    return "at zeta 0.02 chaos " + ("nowhere" if calm else "at some Omega_h"), calm


def _main_parameter(found: Evidence) -> Finding:
    """C1 holds where a sweep along the frequency meets more kinds of motion than one along the damping."""
    dampings = axis("damping_ratio", 41)[1:]  # nothing settles without damping
    osc = found.hypothesis.oscillator()
    damped = sweep(osc, "damping_ratio", dampings, n_transient=20_000, n_exponent=400)
    kinds, few = (
        len({published_kind(int(period), "mesh_frequency") for period in each.period.values})
        for each in (found.along, damped)
    )
    return f"{kinds} kinds of motion along the frequency, {few} along the damping at Omega_h 0.7", kinds > few


def _simple(found: Evidence) -> Finding:
    plane = basins(found.hypothesis.oscillator(), *FEW)
    text = f"at zeta 0.02, Omega_h 0.7: {periods_of(plane)}; for other Omega_h see D6"
    return text, set(plane.attractor_period.values.tolist()) == {1}


def _met(state: str, found: Evidence) -> Finding:
    met = state in found.states
    return "met here" if met else "not met here", met


def _unique(found: Evidence) -> Finding:
    statuses, states = found.plane.attractor_status.values, " and ".join(found.states)
    n = int(np.isin(statuses, (Status.PERIODIC, Status.APERIODIC)).sum())  # what is unsettled is no attractor
    unique = set(found.plane.attractor_period.values.tolist()) == {1}
    return f"{n} attractors, {periods_of(found.plane)}: {states}", unique and len(found.states) > 1


def _several(found: Evidence) -> Finding:
    return " and ".join(found.states), len(found.states) > 1


def lasts_beyond(hypothesis: Hypothesis, way: Sequence[Bifurcation]) -> bool:
    """Whether a sequence of doublings leads to chaos that lasts: at one of the values `BEYOND` its last."""
    if len(way) < 2:
        return False
    last, gap = way[-1], way[-1].value - way[-2].value
    starts = last.x + CLOSE[0], last.v + CLOSE[1]
    oscillators = (hypothesis.oscillator(last.value + part * gap) for part in BEYOND)
    return any(has_chaos(basins(osc, *starts, n_watch=WATCHED)) for osc in oscillators)


def _route(found: Evidence) -> Finding:
    """F12 holds where doublings lead to chaos that lasts on both ways, nearly where on one it is a transient."""
    flips = [b for b in found.changes if b.kind == "flip" and b.period == 2]
    ends = [nearest(value, flips) for value in found.stretch]
    ways = [doubling_cascade(flip, 3) if flip is not None else [] for flip in ends]
    into, out = (" ".join(f"{b.value:.3f}" for b in way) or "none" for way in ways)
    lasting = [lasts_beyond(found.hypothesis, way) for way in ways]
    beyond = "both" if all(lasting) else "the first" if lasting[0] else "the second" if lasting[1] else "neither"
    doubled = all(len(way) >= 2 for way in ways)
    holds = FAILS if not (doubled and any(lasting)) else HOLDS if all(lasting) else NEARLY
    return f"flips {into} in, {out} out; lasting chaos beyond {beyond}", holds


def _lasting_chaos(found: Evidence) -> Finding:
    lasting, tried = found.lasting
    return f"lasting chaos at {lasting} of {tried} values", lasting == tried


def _crisis(found: Evidence) -> Finding:
    """D2: where chaos does not last, there is no attractor to end in a crisis."""
    lasts = _lasting_chaos(found)[1]
    return "chaos to end" if lasts else "no lasting chaos to end", lasts


ROTORS, GEOMETRY = "two rotors integrated in SI units", "geometry of 20 degree gears"
CURVE, STARTS = "sweeps with the computed curve", "a grid of starts"
WATCH = f"watched for {WATCHED:_} periods".replace("_", " ")
EXISTENCE, TRANSIENTS = f"motions from a grid of starts, {WATCH}", f"{STARTS}, {WATCH}"
# The item, its test, and the evidence: none for a definition, which is met or not. A chaotic range is asked about by
# D1, and D2 is no boundary that branches show.
TESTED: tuple[tuple[str, Test, str], ...] = (
    ("M4", _two_rotors, ROTORS),
    ("M5", _mean_of_the_wave, "mean of the wave"),
    ("M6", _two_rotors, ROTORS),
    ("K2", _stiff_for, EXISTENCE),
    ("K3", _stiffness_table, GEOMETRY),
    ("K4", _contact_ratio, f"{GEOMETRY}, eps only"),
    ("K5", _rectangle, CURVE),
    ("N1", _runge_kutta, "diagrams by Runge-Kutta and the exact flow"),
    ("N2", _quasi_periodic, "multipliers of an orbit"),
    ("C4", _rectangle, CURVE),
    *(
        (stated.item, partial(_range, stated), EXISTENCE)
        for parameter in AXES
        for stated in published.ranges(parameter)
        if stated.motion != published.CHAOTIC
    ),
    *(
        (boundary.item, partial(_boundary, boundary), "branches continued")
        for parameter in AXES
        for boundary in published.boundaries(parameter)
        if boundary.event is not None and boundary.item != "D2"
    ),
    ("F9", _chaos, f"starts at Omega_h 1.219, {WATCH}"),
    ("F12", _route, f"flips of doubled branches, starts beyond them {WATCH}"),
    ("F13", _near_resonance, "mean of the wave and the published zone"),
    ("D6", _damped, f"a sweep along the frequency, {WATCH}"),
    ("C1", _main_parameter, "kinds counted in two sweeps"),
    ("C2", _simple, "twelve starts at Omega_h 0.7"),
    *((f"I{i}", partial(_met, state), "") for i, state in enumerate(("none_drive", "single_drive", "double"), 1)),
    ("I4", _unique, "a grid of starts, unique meaning of one period"),
    ("I5", _several, STARTS),
    ("C3", _several, STARTS),
    ("D1", _lasting_chaos, TRANSIENTS),
    ("D2", _crisis, TRANSIENTS),
)
# What no computation has a say in, in either reading.
STATED: tuple[tuple[str, str, Decided | Undecided, str], ...] = (
    ("M1", "assumed here too", "assumption", ""),
    ("M2", "used as it stands", "definition", ""),
    ("M3", "used as it stands", "definition", ""),
    ("K1", "carried out in the chapter on stiffness", "assumption", ""),
    ("N3", "values taken as printed", "definition", ""),
    ("F14", "holds for any motion: 3 Omega_h T_h = 6 pi", "vacuous", "arithmetic"),
    ("C5", "that on many starts follows from C3; the rest is computed in the chapter In service", "advice", ""),
)


def judge_items(printed: Evidence, best: Evidence, items: Collection[str] | None = None) -> list[Verdict]:
    """The verdict on every item of the article, or on some of them.

    Parameters
    ----------
    printed, best : Evidence
        What was found in the printed and in the best reading.
    items : collection of str, optional
        Only these.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> [f"{v.item} {v.verdict}" for v in judge_items(Evidence(PRINTED), Evidence(SWAPPED), ["M1", "M5", "F2", "F14"])]
    ['M5 refuted', 'F2 refuted', 'M1 assumption', 'F14 vacuous']
    """
    verdicts = []
    for item, test, by in TESTED:
        if items is None or item in items:
            (text, holds), (other, holds_too) = test(printed), test(best)
            defined = Verdict(item, text, other, "definition")
            verdicts.append(both(item, (text, other), (holds, holds_too), by) if by else defined)
    stated = (Verdict(item, text, "the same", word, by) for item, text, word, by in STATED)
    return [*verdicts, *(each for each in stated if items is None or each.item in items)]
