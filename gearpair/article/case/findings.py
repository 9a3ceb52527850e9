"""What a search through readings found, in sentences that follow it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import checked
from gearpair.article import published
from gearpair.article.case.existence import Reached
from gearpair.article.readings import PRINTED, SWAPPED, Hypothesis

CHOICES = {  # the fields of a `Hypothesis`, in words
    "stiff_for": "durations",
    "first": "order",
    "phase": "phase",
    "force": "forcing",
    "mean": "mean",
    "damping": "damping",
    "shape": "shape",
}
FEW_PHASES = 4  # as many are named one by one
CLEAR_LEAD = 0.2  # of two scores: the best of twenty random tables is as far above their median


@checked
def headline(best: Sequence[Hypothesis]) -> str:
    """Whether the equation as printed has the published tables, from the readings that do best.

    Examples
    --------
    >>> headline([SWAPPED])
    'Not from the equation as printed.'
    >>> headline([SWAPPED, PRINTED])
    'This run does not tell: at so few values the equation as printed does as well as any.'
    """
    if PRINTED in best:
        return "This run does not tell: at so few values the equation as printed does as well as any."
    return "Not from the equation as printed."


@checked
def best_durations(best: Sequence[Hypothesis]) -> str:
    """Which durations of the stiffness wave the best readings have.

    Examples
    --------
    >>> best_durations([PRINTED])
    'It has the two durations of the stiffness wave as printed: stiff for ε − 1 of the mesh period.'
    """
    swapped, one = _swapped(best), len(best) == 1
    if 0 < swapped < len(best):
        return (
            f"Of these {len(best)}, {swapped} interchange the two durations of the stiffness wave and "
            f"{len(best) - swapped} leave them as printed, so this run does not settle which was computed."
        )
    which = {1: "It", 2: "Both"}.get(len(best), "All of these")
    if swapped:
        durations = "stiff for 2 − ε of the mesh period, soft for ε − 1"
        return f"{which} interchange{'s' if one else ''} the two durations of the stiffness wave: {durations}."
    verb = "has" if one else "have"
    return f"{which} {verb} the two durations of the stiffness wave as printed: stiff for ε − 1 of the mesh period."


@checked
def how_they_differ(best: Sequence[Hypothesis]) -> str:
    """How many readings do best, and by which choices they differ from one another.

    Examples
    --------
    >>> how_they_differ([SWAPPED, Hypothesis(stiff_for="2 - eps", damping="zeta", phase=90.0)])
    '2 do best, which differ in phase and damping only'
    """
    if len(best) == 1:
        return "one does best"
    return f"{len(best)} do best, which differ in {_with_article(_differing(best))} only"


@checked
def which_reading(best: Sequence[Hypothesis]) -> str:
    """The verdict on the reading, as far as the readings that do best allow one.

    Examples
    --------
    >>> print(which_reading([SWAPPED, Hypothesis(stiff_for="2 - eps", damping="zeta")]).split("; ")[-1])
    on the damping this run does not decide.
    >>> which_reading([SWAPPED, PRINTED])[:60]
    'This run does not tell: of the 2 readings that do best, 1 ha'
    """
    if printed := len(best) - _swapped(best):
        return (
            f"This run does not tell: of the {len(best)} readings that do best, {printed} "
            f"{'has' if printed == 1 else 'have'} the durations as printed. Ask at more values."
        )
    open_ = _differing(best)
    agreed = [name for name in CHOICES if name != "stiff_for" and CHOICES[name] not in open_]
    kept = [CHOICES[name] for name in agreed if getattr(best[0], name) == getattr(PRINTED, name)]
    other = [CHOICES[name] for name in agreed if getattr(best[0], name) != getattr(PRINTED, name)]
    parts = [f"of {listed(kept)} the printed choice fits best"] if kept else []
    parts += [f"of {listed(other)} another than the printed choice fits best"] if other else []
    parts += [f"on {_with_article(open_)} this run does not decide"] if open_ else []
    told = "; ".join(parts)
    return (
        "The published tables fit a wave that is stiff for 2 − ε of the mesh period, so the two durations of item K2 "
        f"seem to be interchanged between page and program. {told[0].upper()}{told[1:]}."
    )


@checked
def after_watching(best: Sequence[Hypothesis], leading: Sequence[Hypothesis]) -> str:
    """Whether the readings that did `best` as drawn are `leading` when they are watched.

    Examples
    --------
    >>> after_watching([SWAPPED], [SWAPPED]), after_watching([SWAPPED], [PRINTED])
    ('the same one leads', 'another leads')
    """
    one, kept = len(leading) == 1, len({*best} & {*leading})
    if set(best) == set(leading):
        return "the same one leads" if one else f"the same {len(leading)} lead"
    if one:
        return "one of these leads" if kept else "another leads"
    return f"{len(leading)} lead, {kept or 'none'} of them among these"


@checked
def chaos_at_small_damping(watched: Sequence[Reached]) -> str:
    """How many of the readings watched along the damping have chaos where the article has it (D1).

    Examples
    --------
    >>> chaos_at_small_damping([Reached(SWAPPED, "damping_ratio", np.array([0.01]), (frozenset(),))])
    'No damping as small as that of the published chaos (D1) was tried.'
    """
    small = [found.values < published.DAMPING_RANGES[0].upper for found in watched]
    if not np.any(small):
        return "No damping as small as that of the published chaos (D1) was tried."
    n = sum(bool(found.has(published.CHAOTIC)[where].any()) for found, where in zip(watched, small, strict=True))
    have = {0: "none has", 1: "one has"}.get(n, f"{n} have")
    return f"Of the readings watched, {have} chaos that lasts so long at the small damping where it is published (D1)."


@checked
def score_headline(swapped: float, printed_duration: float) -> str:
    """What the score says of the swapped wave, beside the best reading of the printed duration.

    Examples
    --------
    >>> score_headline(0.55, 0.47)
    'The score that was fixed beforehand prefers the swapped wave too, but not by much.'
    """
    lead = swapped - printed_duration
    if lead <= 0.0:
        return "The score that was fixed beforehand does not prefer the swapped wave in this run."
    margin = "but not by much" if lead < CLEAR_LEAD else "and clearly"
    return f"The score that was fixed beforehand prefers the swapped wave too, {margin}."


@checked
def behind(lead: float) -> str:
    """Where the second of two scores stands whose first leads by `lead`, before the name of the first.

    Examples
    --------
    >>> behind(0.081), behind(-0.02), behind(0.001)
    ('0.08 behind', '0.02 ahead of', 'level with')
    """
    size = f"{abs(lead):.2f}"
    return "level with" if float(size) == 0.0 else f"{size} {'behind' if lead > 0.0 else 'ahead of'}"


@checked
def met_by_chance(most: int, chance: float) -> str:
    """What it is worth that the best diagram of a search meets so many published boundaries.

    Parameters
    ----------
    most : int
        How many.
    chance : float
        The share of random tables of which some diagram of the search meets as many.

    Examples
    --------
    >>> met_by_chance(3, 0.02)
    'Of a thousand random tables 2 in a hundred are met as well by some diagram of this search.'
    >>> met_by_chance(0, 1.0)
    'A search that meets none says nothing: its grid is too coarse, or its settings are far off.'
    """
    if most == 0:
        return "A search that meets none says nothing: its grid is too coarse, or its settings are far off."
    share = f"{100 * chance:.0f}" if chance >= 0.01 else "fewer than one"
    return f"Of a thousand random tables {share} in a hundred are met as well by some diagram of this search."


@checked
def best_phase(phases: ArrayLike, shares: ArrayLike) -> str:
    """Where the share of the tables that a wave accounts for is highest, of phases in degrees.

    Examples
    --------
    >>> best_phase([-90.0, 0.0, 90.0, 180.0], [0.5, 1.0, 0.5, 0.2])
    'the peak is at 0 degrees'
    >>> best_phase([-180.0, -90.0, 0.0, 90.0, 180.0], [1.0, 0.5, 1.0, 0.5, 1.0])
    'the highest share is reached at 0 and 180 degrees alike'
    """
    tried = {float(phase): float(share) for phase, share in zip(np.ravel(phases), np.ravel(shares), strict=True)}
    tried = {phase: share for phase, share in tried.items() if phase > -180.0 or 180.0 not in tried}  # one and the same
    peaks = sorted(phase for phase, share in tried.items() if share == max(tried.values()))
    if len(peaks) == 1:
        return f"the peak is at {peaks[0]:.0f} degrees"
    if len(peaks) <= FEW_PHASES:
        return f"the highest share is reached at {listed([f'{phase:.0f}' for phase in peaks])} degrees alike"
    zero = "0 among them" if 0.0 in peaks else "0 not among them"
    return f"the highest share is reached at {len(peaks)} of the {len(tried)} phases tried, {zero}"


def listed(words: Sequence[str]) -> str:
    """The words with commas and an "and".

    Examples
    --------
    >>> listed(["order", "phase", "mean"]), listed(["mean"])
    ('order, phase and mean', 'mean')
    """
    return f"{', '.join(words[:-1])} and {words[-1]}" if len(words) > 1 else "".join(words)


def _swapped(best: Sequence[Hypothesis]) -> int:
    return sum(each.stiff_for == SWAPPED.stiff_for for each in best)


def _differing(best: Sequence[Hypothesis]) -> list[str]:
    return [word for name, word in CHOICES.items() if len({getattr(each, name) for each in best}) > 1]


def _with_article(words: Sequence[str]) -> str:
    return f"the {words[0]}" if len(words) == 1 else listed(words)
