"""The tests of the article's numbered items in two readings; one `Verdict` an item."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gearpair.article import published
from gearpair.article.comparison import drawn_boundary, nearest
from gearpair.article.existence import Reached
from gearpair.article.readings import Hypothesis
from gearpair.article.scoring import axis, published_kind
from gearpair.article.trials import Trial
from gearpair.article.verdicts import Verdict, both, judge, judge_number
from gearpair.bifurcations.branches import continue_orbit
from gearpair.bifurcations.doubling import doubling_cascade
from gearpair.bifurcations.locating import Bifurcation
from gearpair.bifurcations.orbits import periodic_orbit
from gearpair.methods.runge_kutta import runge_kutta_sweep
from gearpair.motion.initial_conditions import basins
from gearpair.motion.settling import Status
from gearpair.motion.sweeps import sweep
from gearpair.teeth.spurpair import SpurPair

if TYPE_CHECKING:
    import xarray as xr

ENOUGH = 0.95  # an item about a range holds where the motion is found on this share of it


def numbers(values: Iterable[float]) -> str:
    """Numbers to two decimals, one after the other."""
    return " ".join(f"{value:.2f}" for value in values)


def model_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """M, K, N2, N3 and what nothing could contradict: statements about the model itself."""
    means = [h.wave.mean for h in (printed, best)]
    rows = published.STIFFNESS_TABLE
    ratios = [SpurPair(row.teeth_pinion, row.teeth_wheel).contact_ratio for row in rows]
    off = max(abs(r - row.contact_ratio) for r, row in zip(ratios, rows, strict=True))
    of_ones = [1.0 + row.a * (row.contact_ratio - 1.0) - row.b * (2.0 - row.contact_ratio) for row in rows]
    swapped = [1.0 + row.a * (2.0 - row.contact_ratio) - row.b * (row.contact_ratio - 1.0) for row in rows]
    orbit = periodic_orbit(best.oscillator(), 0.887, -0.337, 1)
    assert orbit.multipliers is not None  # it has converged
    shrink = float(np.exp(-2.0 * orbit.oscillator.damping_ratio * orbit.oscillator.period))
    product = float(np.prod(orbit.multipliers).real)
    return [
        Verdict("M1", "assumed", "the same", "confirmed"),
        Verdict("M2", "derived in the book", "the same", "confirmed"),
        Verdict("M3", "derived in the book", "the same", "confirmed"),
        Verdict("M4", "derived in the book, F_m supplied", "the same", "confirmed"),
        Verdict(
            "M5",
            f"mean of k is {means[0]:.4f}, so k_m is not the average",
            f"{means[1]:.4f}",
            judge(abs(means[0] - 1.0) < 0.005, abs(means[1] - 1.0) < 0.005),
        ),
        Verdict("M6", "derived in the book", "the same", "confirmed"),
        Verdict("K1", "carried out in the chapter on stiffness", "the same", "confirmed"),
        Verdict("K2", "stiff for 0.68 of the period", "stiff for 0.32: the tables need this one", "corrected"),
        Verdict(
            "K3",
            f"eps of 20 degree gears {numbers(ratios)}; means of k {numbers(of_ones)}",
            f"means of k {numbers(swapped)}",
            "confirmed" if off < 0.02 else "corrected",
        ),
        Verdict(
            "K4",
            f"eps of 34 against 34 is {ratios[0]:.2f}, its own table has {rows[0].contact_ratio}",
            "the same",
            "confirmed" if abs(ratios[0] - published.BASELINE.contact_ratio) < 0.005 else "refuted",
        ),
        Verdict("K5", "nothing to compare with", "the same", "vacuous"),
        Verdict(
            "N2",
            "quasi-periodic motion cannot occur with damping",
            f"product of multipliers {product:.4f} = exp(-2 zeta T) = {shrink:.4f}",
            "refuted" if product < 1.0 else "confirmed",
        ),
        Verdict("N3", "values taken as printed", "values taken as printed", "confirmed"),
        Verdict("F14", "holds for any motion: 3 Omega_h T_h = 6 pi", "the same", "vacuous"),
        Verdict("C4", "nothing to compare with", "the same", "vacuous"),
        Verdict("C5", "advice; that on many starts follows from C3", "the same", "confirmed"),
    ]


def integrator_items(printed: Hypothesis, best: Hypothesis, n_values: int = 41) -> list[Verdict]:
    """N1: how much of the frequency axis Runge-Kutta 4-5 draws rightly at its usual tolerance."""
    values = axis("mesh_frequency", n_values)
    texts, holds = [], []
    for osc in (printed.oscillator(), best.oscillator()):
        exact = sweep(osc, "mesh_frequency", values, n_exponent=20, max_period=12).period.values
        drawn = runge_kutta_sweep(osc, "mesh_frequency", values, n_samples=32, rtol=1e-3, atol=1e-6).period.values
        right = float(np.mean((exact == drawn)[exact > 0]))
        texts.append(f"at the usual tolerance 1e-3, {right:.0%} of the periods right")
        holds.append(right >= ENOUGH)
    return [both("N1", texts, holds)]


def range_items(printed: Sequence[Reached], best: Sequence[Reached]) -> list[Verdict]:
    """F1 to F11, D3 and D5 where they are ranges: on what share the published motion is reached from some start."""
    found = []
    for one, other in zip(printed, best, strict=True):
        for stated in published.ranges(one.parameter):
            if stated.motion == published.CHAOTIC:
                continue  # whether that chaos lasts is `transient_items`'s question
            shares = [reached.within(stated.item) for reached in (one, other)]
            texts = [
                "on all of it" if share >= ENOUGH else "on part of it" if share > 0.0 else "nowhere in it"
                for share in shares
            ]
            found.append(both(stated.item, texts, [share >= ENOUGH for share in shares]))
    return found


def boundary_items(
    printed: Sequence[Trial], best: Sequence[Trial], bifurcations: Sequence[Bifurcation]
) -> list[Verdict]:
    """F2, F4, F6 and D4: the published boundaries that have a number of their own (D2 is `transient_items`'s).

    Parameters
    ----------
    printed, best : sequence of Trial
        Of each reading; the nearest boundary between the same motions in any of its diagrams counts.
    bifurcations : sequence of Bifurcation
        Of the best reading, in either parameter; the nearest fold or flip takes the place of its diagrams.
    """
    found = []
    for parameter in ("mesh_frequency", "damping_ratio"):
        values = axis(parameter, 2)
        digits = 3 if parameter == "mesh_frequency" else 5
        for boundary in published.boundaries(parameter):
            if boundary.event is None or boundary.item == "D2":
                continue
            one, other = drawn_boundary(printed, boundary), drawn_boundary(best, boundary)
            text = "not drawn" if other is None else f"drawn at {other:.{digits}f}"
            change = nearest(boundary.value, [b for b in bifurcations if b.parameter == parameter])
            if change is not None:
                other, text = change.value, f"{change.kind} of period {change.period} at {change.value:.5f}"
            word = judge_number(one, other, boundary.value, values[1] - values[0])
            found.append(
                Verdict(boundary.item, "not drawn" if one is None else f"drawn at {one:.{digits}f}", text, word)
            )
    return found


def transient_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """D1 and D2: whether the chaos at small damping lasts, from a grid of starts and transients of 30 000 periods.

    Where it does not, there is no attractor to end in a crisis.
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
    return [both("D1", texts, holds), both("D2", crisis, holds)]


def chaos_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """F9, F13, D6, C1 and C2: where chaos is, and what damping does to it."""
    x, v = np.linspace(-1.0, 2.0, 4), np.linspace(-0.6, 0.6, 3)
    values = axis("mesh_frequency", 41)
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
        share = float(np.mean(along.status.values == Status.APERIODIC))
        texts["D6"].append("at zeta 0.02 chaos " + ("at some Omega_h" if share else "nowhere"))
        holds["D6"].append(share == 0.0)
        kinds = len({published_kind(int(m), "mesh_frequency") for m in along.period.values})
        texts["C1"].append(f"{kinds} kinds of motion from 0.7 to 1.7")
        holds["C1"].append(kinds > 2)
        calm = basins(hypothesis.oscillator(), x, v)
        texts["C2"].append(f"at zeta 0.02, Omega_h 0.7: {periods_of(calm)}; for other Omega_h see D6")
        holds["C2"].append(set(calm.attractor_period.values.tolist()) == {1})
    return [both(item, texts[item], holds[item]) for item in texts]


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
        Of the period-2 branch in mesh frequency.
    stretches : sequence of two (lower, upper), one per reading
        The last flip of period 2 below and the first above which its chaotic zone lies.
    """
    texts, holds = [], []
    for flips, (lower, upper) in zip((printed, best), stretches, strict=True):
        ends = [nearest(value, [b for b in flips if b.kind == "flip"]) for value in (lower, upper)]
        ways = [doubling_cascade(flip, 3) if flip is not None else [] for flip in ends]
        shown = [" ".join(f"{b.value:.3f}" for b in way) for way in ways]
        texts.append(f"flips {shown[0] or 'none'} in, {shown[1] or 'none'} out")
        holds.append(all(len(way) >= 2 for way in ways))
    return [both("F12", texts, holds)]


def start_items(printed: Hypothesis, best: Hypothesis) -> list[Verdict]:
    """I1 to I5 and C3: what the plane of starts holds at Omega_h 0.7, zeta 0.02."""
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
    single, double = ([state in each for each in states] for state in ("single_drive", "double"))
    return [
        Verdict("I1", "a definition; not met here", "a definition; not met here", "confirmed"),
        both("I2", ["found" if found else "not found" for found in single], single),
        both("I3", ["found" if found else "not found" for found in double], double),
        both("I4", attractors, [one and some for one, some in zip(period_1, several, strict=True)]),
        both("I5", says, several),
        both("C3", says, several),
    ]


def period_two(hypothesis: Hypothesis, start: float = 1.1) -> list[Bifurcation]:
    """The bifurcations in mesh frequency of every stable period-2 branch met at `start`."""
    osc = hypothesis.oscillator(start)
    plane = basins(osc, np.linspace(-2.0, 2.0, 9), np.linspace(-1.0, 1.0, 5), max_period=2)
    found: list[Bifurcation] = []
    for period, x, v in zip(
        plane.attractor_period.values, plane.attractor_x.values, plane.attractor_v.values, strict=True
    ):
        if period == 2:
            orbit = periodic_orbit(osc, float(x), float(v), 2)
            found += continue_orbit(orbit, "mesh_frequency", 0.6, 1.8).bifurcations
    return found
