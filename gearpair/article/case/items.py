"""The tests of the article's numbered items in two readings; one `Verdict` an item."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gearpair.article import published
from gearpair.article.case.boundaries import named_bifurcation, nearest
from gearpair.article.case.existence import Reached
from gearpair.article.case.scoring import axis, published_kind
from gearpair.article.case.two_rotors import two_rotor_difference
from gearpair.article.case.verdicts import Verdict, both, grade, judge
from gearpair.article.readings import Hypothesis
from gearpair.bifurcations.branch_search import find_branches
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


def numbers(values: Iterable[float]) -> str:
    """Numbers to two decimals, one after the other."""
    return " ".join(f"{value:.2f}" for value in values)


def model_items(
    printed: Hypothesis, best: Hypothesis, reached: Sequence[Sequence[Reached]], shares: Mapping[str, float]
) -> list[Verdict]:
    """M, K, N2, N3, F14, C4 and C5: the model itself, and what nothing decides.

    Parameters
    ----------
    printed, best : Hypothesis
    reached : sequence of sequence of Reached
        For each published axis the motions that the two readings have, in this order.
    shares : mapping of str to float
        The share of frequencies at which the ``"rectangle"`` and the ``"sinusoid"`` meet the computed curve's motion.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> from gearpair.article.case import reached
    >>> along = [reached([PRINTED, SWAPPED], p, 5, n_discarded=100) for p in ("mesh_frequency", "damping_ratio")]
    >>> items = model_items(PRINTED, SWAPPED, along, {"rectangle": 0.8, "sinusoid": 0.6})
    >>> [(each.item, each.verdict) for each in items if each.item in ("M1", "M5", "F14")]
    [('M1', 'assumption'), ('M5', 'refuted'), ('F14', 'vacuous')]
    """
    means = [h.wave.mean for h in (printed, best)]
    rows = published.STIFFNESS_TABLE
    ratios = [SpurPair(row.teeth_pinion, row.teeth_wheel).contact_ratio for row in rows]
    off = max(abs(r - row.contact_ratio) for r, row in zip(ratios, rows, strict=True))
    of_ones = [1.0 + row.a * (row.contact_ratio - 1.0) - row.b * (2.0 - row.contact_ratio) for row in rows]
    swapped = [1.0 + row.a * (2.0 - row.contact_ratio) - row.b * (row.contact_ratio - 1.0) for row in rows]
    orbit = periodic_orbit(best.oscillator(), 0.887, -0.337, 1)
    shrink = float(np.exp(-2.0 * orbit.oscillator.damping_ratio * orbit.oscillator.period))
    product = float(np.prod(np.asarray(orbit.multipliers)).real)
    rotors = [two_rotor_difference(h.oscillator()) for h in (printed, best)]
    alike = [f"the two rotors differ by {'less than 1e-5' if each < 1e-5 else 'more than 1e-5'}" for each in rotors]
    coverages = [min(axis_[k].coverage for axis_ in reached) for k in (0, 1)]
    met = f"rectangle {10 * shares['rectangle']:.0f} of 10, sinusoid {10 * shares['sinusoid']:.0f} of 10"
    beats = [shares["rectangle"] > shares["sinusoid"]] * 2
    geometry, same = "geometry of 20 degree gears", "the same"
    return [
        Verdict("M1", "assumed here too", same, "assumption"),
        Verdict("M2", "used as it stands", same, "definition"),
        Verdict("M3", "used as it stands", same, "definition"),
        both("M4", alike, [each < 1e-5 for each in rotors], "two rotors integrated in SI units"),
        both(
            "M5",
            [f"mean of k is {means[0]:.4f}, so k_m is not the average", f"{means[1]:.4f}"],
            [abs(mean - 1.0) < 0.005 for mean in means],
            "mean of the wave",
        ),
        both("M6", alike, [each < 1e-5 for each in rotors], "two rotors integrated in SI units"),
        Verdict("K1", "carried out in the chapter on stiffness", same, "assumption"),
        both(
            "K2",
            [
                f"stiff for {stiff:.2f}: the published motions on {'all' if share >= ENOUGH else 'part'} of both axes"
                for stiff, share in zip((0.68, 0.32), coverages, strict=True)
            ],
            [share >= ENOUGH for share in coverages],
            "motions from a grid of starts",
        ),
        both(
            "K3",
            [
                f"eps of 20 degree gears {numbers(ratios)}; means of k {numbers(of_ones)}",
                f"the same eps; means of k {numbers(swapped)}",
            ],
            [off < 0.02 and abs(mean - 1.0) < 0.02 for mean in (min(of_ones), min(swapped))],
            geometry,
        ),
        both(
            "K4",
            [f"eps of 34 against 34 is {ratios[0]:.2f}, its own table has {rows[0].contact_ratio}", same],
            [abs(ratios[0] - published.BASELINE.contact_ratio) < 0.005] * 2,
            f"{geometry}, eps only",
        ),
        both("K5", [met, same], beats, "sweeps with the computed curve"),
        both(
            "N2",
            [
                "no quasi-periodic motion with damping",
                f"product of multipliers {product:.4f} = exp(-2 zeta T) = {shrink:.4f}",
            ],
            [product >= 1.0] * 2,
            "multipliers of an orbit",
        ),
        Verdict("N3", "values taken as printed", same, "definition"),
        Verdict("F14", "holds for any motion: 3 Omega_h T_h = 6 pi", same, "vacuous", "arithmetic"),
        both("C4", [met, same], beats, "sweeps with the computed curve"),
        Verdict("C5", "that on many starts follows from C3", same, "advice"),
    ]


def integrator_items(printed: Hypothesis, best: Hypothesis, n_values: int = 41) -> list[Verdict]:
    """N1: how much of the frequency axis Runge-Kutta 4-5 draws rightly at its usual tolerance.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> [(each.item, each.verdict) for each in integrator_items(PRINTED, SWAPPED, n_values=5)]
    [('N1', 'refuted')]
    """
    values = axis("mesh_frequency", n_values)
    texts, holds = [], []
    for osc in (printed.oscillator(), best.oscillator()):
        exact = sweep(osc, "mesh_frequency", values, n_exponent=20, max_period=12).period.values
        drawn = runge_kutta_sweep(osc, "mesh_frequency", values, n_samples=32, rtol=1e-3, atol=1e-6).period.values
        right = float(np.mean((exact == drawn)[exact > 0]))
        texts.append(f"at the usual tolerance 1e-3, {right:.0%} of the periods right")
        holds.append(right >= ENOUGH)
    return [both("N1", texts, holds, "diagrams by Runge-Kutta and the exact flow")]


def range_items(printed: Sequence[Reached], best: Sequence[Reached]) -> list[Verdict]:
    """F1 to F11, D3 and D5 where they are ranges: on what share the published motion is reached from some start.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> from gearpair.article.case import reached
    >>> printed, swapped = reached([PRINTED, SWAPPED], "damping_ratio", 5)
    >>> [(each.item, each.best) for each in range_items([printed], [swapped])]
    [('D3', 'on all of it'), ('D5', 'on all of it')]
    """
    found = []
    for one, other in zip(printed, best, strict=True):
        for stated in published.ranges(one.parameter):
            if stated.motion == published.CHAOTIC:
                continue  # whether that chaos lasts is `transient_items`'s question
            shares = [reached.within(stated.item) for reached in (one, other)]
            holds = [share >= ENOUGH for share in shares]
            found.append(both(stated.item, [extent(share) for share in shares], holds, "motions from a grid of starts"))
    return found


def extent(share: float) -> str:
    """A share of a range in words, so that no number hangs on where the values tried happen to lie."""
    if share == 1.0:
        return "on all of it"
    return "on nearly all of it" if share >= ENOUGH else "on part of it" if share > 0.0 else "nowhere in it"


def boundary_items(printed: Sequence[Bifurcation], best: Sequence[Bifurcation]) -> list[Verdict]:
    """F2, F4, F6 and D4: the published boundaries that have a number and an event (D2 is `transient_items`'s).

    Parameters
    ----------
    printed, best : sequence of Bifurcation
        Of each reading, in either parameter; the nearest one of the kind that the article names counts.

    Examples
    --------
    >>> [(each.item, each.best, each.verdict) for each in boundary_items([], [])][:2]
    [('F2', 'none of this kind', 'refuted'), ('F4', 'none of this kind', 'refuted')]
    """
    found = []
    for parameter in ("mesh_frequency", "damping_ratio"):
        ends = axis(parameter, 2)
        for boundary in published.boundaries(parameter):
            if boundary.event is None or boundary.item == "D2":
                continue
            changes = [named_bifurcation(boundary, each) for each in (printed, best)]
            texts = [
                "none of this kind" if b is None else f"{b.kind} of period {b.period} at {b.value:.5f}" for b in changes
            ]
            grades = [grade(b.value if b else None, boundary.value, ends[1] - ends[0]) for b in changes]
            found.append(Verdict(boundary.item, texts[0], texts[1], judge(*grades), "branches continued"))
    return found


def transient_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """D1 and D2: whether the chaos at small damping lasts, from a grid of starts and transients of 30 000 periods.

    Where it does not, there is no attractor to end in a crisis.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> transient_items(PRINTED, SWAPPED)[0].best
    'after 30 000 periods chaotic at 0 of 5 values'
    """
    texts, holds = [], []
    for hypothesis in (printed, best):
        planes = [
            basins(hypothesis.oscillator(damping_ratio=zeta), [-1.0, 0.2, 1.4], [-0.6, 0.6], n_transient=30_000)
            for zeta in (0.0005, 0.001, 0.0015, 0.002, 0.0025)
        ]
        lasting = sum(bool(np.any(plane.status.values != Status.PERIODIC)) for plane in planes)
        texts.append(f"after 30 000 periods chaotic at {lasting} of {len(planes)} values")
        holds.append(lasting == len(planes))
    crisis = ["chaos to end" if lasts else "no lasting chaos to end" for lasts in holds]
    by = "transients of 30 000 periods"
    return [both("D1", texts, holds, by), both("D2", crisis, holds, by)]


def chaos_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """F9, F13, D6, C1 and C2: where chaos is, and what damping does to it.

    C1 calls the frequency the *main* parameter: it holds where a sweep along the frequency meets more kinds of motion
    than one along the damping, the only other parameter that the article varies.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> [each.item for each in chaos_items(PRINTED, SWAPPED)]
    ['F9', 'F13', 'D6', 'C1', 'C2']
    """
    x, v = np.linspace(-1.0, 2.0, 4), np.linspace(-0.6, 0.6, 3)
    values, dampings = axis("mesh_frequency", 41), axis("damping_ratio", 41)[1:]  # nothing settles without damping
    (zone,) = (r for r in published.FREQUENCY_RANGES if r.motion == published.COMPLEX)
    texts: dict[str, list[str]] = {item: [] for item in ("F9", "F13", "D6", "C1", "C2")}
    holds: dict[str, list[bool]] = {item: [] for item in texts}
    for hypothesis in (printed, best):
        at_f9 = basins(hypothesis.oscillator(published.CHAOTIC_FREQUENCY), x, v, max_period=32)
        chaotic = bool(np.any(at_f9.attractor_status.values == Status.APERIODIC))
        texts["F9"].append("chaos" if chaotic else f"no chaos: {periods_of(at_f9)}")
        holds["F9"].append(chaotic)
        resonance = float(np.sqrt(hypothesis.wave.mean))
        above = [f"{end / resonance - 1.0:.0%}" for end in (zone.lower, zone.upper)]
        texts["F13"].append(f"resonance {resonance:.2f}; the complex zone lies {above[0]} to {above[1]} above")
        holds["F13"].append(zone.lower <= 1.1 * resonance)
        along = sweep(hypothesis.oscillator(), "mesh_frequency", values, n_exponent=400)
        damped = sweep(hypothesis.oscillator(), "damping_ratio", dampings, n_transient=20_000, n_exponent=400)
        share = float(np.mean(along.status.values == Status.APERIODIC))
        texts["D6"].append("at zeta 0.02 chaos " + ("at some Omega_h" if share else "nowhere"))
        holds["D6"].append(share == 0.0)
        kinds, few = (len({published_kind(int(m), "mesh_frequency") for m in s.period.values}) for s in (along, damped))
        texts["C1"].append(f"{kinds} kinds of motion along the frequency, {few} along the damping at Omega_h 0.7")
        holds["C1"].append(kinds > few)
        calm = basins(hypothesis.oscillator(), x, v)
        texts["C2"].append(f"at zeta 0.02, Omega_h 0.7: {periods_of(calm)}; for other Omega_h see D6")
        holds["C2"].append(set(calm.attractor_period.values.tolist()) == {1})
    by = {
        "F9": "starts at Omega_h 1.219", "F13": "mean of the wave and the published zone",
        "D6": "a sweep along the frequency", "C1": "kinds counted in two sweeps", "C2": "starts at Omega_h 0.7",
    }  # fmt: skip
    return [both(item, texts[item], holds[item], by[item]) for item in texts]


def periods_of(plane: xr.Dataset) -> str:
    """The periods of the attractors of a plane of starts, in words."""
    periods = sorted({int(p) for p in plane.attractor_period.values if p})
    return f"period{'s' if len(periods) > 1 else ''} {', '.join(map(str, periods))}"


def route_items(
    printed: Sequence[Bifurcation], best: Sequence[Bifurcation], stretches: Sequence[tuple[float, float]]
) -> list[Verdict]:
    """F12: the doubling sequences into and out of the chaotic zone, from the flips of a period-2 branch.

    Parameters
    ----------
    printed, best : sequence of Bifurcation
        Of each reading; the flips of period 2 in mesh frequency count.
    stretches : sequence of two (lower, upper), one per reading
        The last flip of period 2 below and the first above which its chaotic zone lies.

    Examples
    --------
    >>> [(each.item, each.best, each.verdict) for each in route_items([], [], [(0.87, 1.2), (0.87, 1.2)])]
    [('F12', 'flips none in, none out', 'refuted')]
    """
    texts, holds = [], []
    for flips, (lower, upper) in zip((printed, best), stretches, strict=True):
        ends = [nearest(value, [b for b in flips if b.kind == "flip" and b.period == 2]) for value in (lower, upper)]
        ways = [doubling_cascade(flip, 3) if flip is not None else [] for flip in ends]
        shown = [" ".join(f"{b.value:.3f}" for b in way) for way in ways]
        texts.append(f"flips {shown[0] or 'none'} in, {shown[1] or 'none'} out")
        holds.append(all(len(way) >= 2 for way in ways))
    return [both("F12", texts, holds, "flips of doubled branches")]


def start_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """I1 to I5 and C3: what the plane of starts holds at Omega_h 0.7, zeta 0.02.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> start_items(PRINTED, SWAPPED)[3].best
    '2 attractors, period 1: double and single_drive'
    """
    grid = np.linspace(-3.0, 3.0, 13)
    planes = [basins(h.oscillator(), grid, grid) for h in (printed, best)]
    states = [sorted({str(s) for s in plane.attractor_impact_state.values}) for plane in planes]
    several = [len(each) > 1 for each in states]
    says = [" and ".join(each) for each in states]
    attractors = [
        f"{plane.sizes['attractor_number']} attractors, {periods_of(plane)}: {each}"
        for plane, each in zip(planes, says, strict=True)
    ]
    period_1 = [set(plane.attractor_period.values.tolist()) == {1} for plane in planes]
    by = "a grid of starts"
    met = {
        item: ["met here" if state in each else "not met here" for each in states]
        for item, state in {"I1": "none_drive", "I2": "single_drive", "I3": "double"}.items()
    }
    return [
        *(Verdict(item, as_printed, as_best, "definition") for item, (as_printed, as_best) in met.items()),
        both(
            "I4",
            attractors,
            [one and some for one, some in zip(period_1, several, strict=True)],
            "a grid of starts, unique meaning of one period",
        ),
        both("I5", says, several, by),
        both("C3", says, several, by),
    ]


def bifurcations_of(hypothesis: Hypothesis, max_period: int = 3) -> list[Bifurcation]:
    """The folds and flips in mesh frequency and in damping of the branches that a search finds in one reading.

    Parameters
    ----------
    hypothesis : Hypothesis
    max_period : int
        The longest period followed.

    Returns
    -------
    list of Bifurcation

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> sorted({(b.kind, b.parameter) for b in bifurcations_of(SWAPPED, max_period=1)})
    [('flip', 'mesh_frequency'), ('fold', 'damping_ratio')]
    """
    osc = hypothesis.oscillator()
    branches = [
        *find_branches(osc, "mesh_frequency", 0.65, 1.75, max_period=max_period, n_values=5),
        *find_branches(osc, "damping_ratio", 0.001, 0.03, max_period=max_period, n_values=3),
    ]
    return [b for branch in branches for b in branch.bifurcations if b.kind != "grazing"]
