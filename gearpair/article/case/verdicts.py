"""What becomes of every numbered item of the article, by one rule.

A test asks whether an item holds in the printed reading and whether it holds in the best one; for a number there is a
third answer, that it nearly holds, with another number. `verdict_word` makes a word of the two answers:

- *confirmed*: it holds in both;
- *corrected*: it holds in the best reading only, or nearly, and no less than as printed: right about what was computed,
  once the reading or the number is put right;
- *contrary*: it holds better as printed than in the best reading. That corrects nothing: it is evidence against the
  best reading, and stands among the evidence;
- *refuted*: it holds in neither;
- *vacuous*: no outcome of any computation could contradict it.

What no computation decides has a word of its own and is not counted: a *definition*, an *assumption*, an *advice*.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from gearpair.article import published
from gearpair.table import Table

Decided = Literal["confirmed", "corrected", "contrary", "refuted", "vacuous"]
Undecided = Literal["definition", "assumption", "advice"]
DECIDED, UNDECIDED = get_args(Decided), get_args(Undecided)
FAILS, NEARLY, HOLDS = 0, 1, 2
NEAR, FAR = 0.01, 0.05  # of the axis: a number holds this near, and nearly holds this far


@dataclass(frozen=True)
class Verdict:
    """What became of one item.

    Attributes
    ----------
    printed, best : str
        What the printed and the best reading give.
    verdict : str
        One of `DECIDED` or `UNDECIDED`.
    decided_by : str
        What computation decided; empty where none did.
    """

    item: str
    printed: str
    best: str
    verdict: Decided | Undecided
    decided_by: str = ""

    def __post_init__(self) -> None:
        if (self.verdict in UNDECIDED) == bool(self.decided_by):
            raise ValueError(
                f"a verdict needs what decided it, and a word of {', '.join(UNDECIDED)} has none; "
                f"item {self.item} is {self.verdict!r}, decided by {self.decided_by!r}"
            )


def verdict_word(printed: int, best: int) -> Decided:
    """The word for how far an item holds in the two readings: `FAILS`, `NEARLY` or `HOLDS`.

    Examples
    --------
    >>> verdict_word(HOLDS, HOLDS), verdict_word(FAILS, HOLDS), verdict_word(HOLDS, FAILS), verdict_word(FAILS, FAILS)
    ('confirmed', 'corrected', 'contrary', 'refuted')
    """
    if printed > best:
        return "contrary"
    if printed == HOLDS:
        return "confirmed"
    return "refuted" if best == FAILS else "corrected"


def grade(value: float | None, stated: float, width: float) -> int:
    """How far a value on an axis of the given width is the stated one; None fails.

    Examples
    --------
    >>> grade(0.867, 0.865, 1.0) == HOLDS, grade(0.80, 0.83, 1.0) == NEARLY, grade(None, 0.8, 1.0) == FAILS
    (True, True, True)
    """
    away = float("inf") if value is None else abs(value - stated) / width
    return HOLDS if away <= NEAR else NEARLY if away <= FAR else FAILS


def both(item: str, texts: Sequence[str], holds: Sequence[bool | int], decided_by: str) -> Verdict:
    """The verdict on an item from what the two readings give and whether, or how far, it holds in each."""
    printed, best = (HOLDS if each is True else int(each) for each in holds)
    return Verdict(item, texts[0], texts[1], verdict_word(printed, best), decided_by)


def count_verdicts(verdicts: Iterable[Verdict]) -> dict[str, int]:
    """How many items a computation confirmed, corrected and so on, and how many nothing decided.

    Examples
    --------
    >>> some = [Verdict("I1", "met", "met", "definition"), both("I2", ["found", "found"], [True, True], "starts")]
    >>> count_verdicts(some)
    {'confirmed': 1, 'corrected': 0, 'contrary': 0, 'refuted': 0, 'vacuous': 0, 'not decided': 1}
    """
    words = [verdict.verdict for verdict in verdicts]
    counts: dict[str, int] = {word: words.count(word) for word in DECIDED}
    return {**counts, "not decided": len(words) - sum(counts.values())}


def verdict_table(*groups: Iterable[Verdict]) -> Table:
    """All verdicts in the article's order, one row an item.

    Raises
    ------
    ValueError
        Unless every item of the article is there exactly once.

    Examples
    --------
    >>> advice = (Verdict(statement.item, "", "", "advice") for statement in published.STATEMENTS)
    >>> [row[0] for row in verdict_table(advice).rows][:3]
    ['M1', 'M2', 'M3']
    """
    found = [verdict for group in groups for verdict in group]
    expected = [s.item for s in published.STATEMENTS]
    if sorted(v.item for v in found) != sorted(expected):
        wrong = {v.item for v in found}.symmetric_difference(expected)
        raise ValueError(f"every item of the article must be there exactly once; look at {', '.join(sorted(wrong))}")
    found.sort(key=lambda verdict: expected.index(verdict.item))
    rows = [
        [v.item, published.statement(v.item).text, v.printed, v.best, v.verdict, v.decided_by or "–"] for v in found
    ]
    return Table(["item", "the article", "as printed", "best reading", "verdict", "decided by"], rows)


def counter_evidence(verdicts: Iterable[Verdict]) -> Table:
    """The items that hold better as printed than in the best reading: what speaks against that reading.

    Examples
    --------
    >>> against = both("F9", ["chaos", "no chaos"], [True, False], "a grid of starts")
    >>> [row[0] for row in counter_evidence([against]).rows]
    ['F9']
    """
    rows = [[v.item, published.statement(v.item).text, v.printed, v.best] for v in verdicts if v.verdict == "contrary"]
    return Table(["item", "the article", "as printed", "best reading"], rows)
