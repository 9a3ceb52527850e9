"""Every numbered item of the article tested in two readings: what it states, what each gives, and the verdict.

A test returns one `Verdict` per item. The rule is the same everywhere (`judge`): an item that holds in both readings is
confirmed; one that holds in one of them only, or with another number, is corrected; one that holds in neither is
refuted; one that nothing could contradict is vacuous.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from gearpair.article import published
from gearpair.tables import Table

if TYPE_CHECKING:
    pass

Word = Literal["confirmed", "corrected", "refuted", "vacuous"]
NEAR, FAR = 0.01, 0.05  # of the axis: a number holds this near, and is corrected rather than refuted this far


@dataclass(frozen=True)
class Verdict:
    """What became of one item.

    Attributes
    ----------
    item : str
    printed, best : str
        What the printed and the best reading give.
    verdict : {"confirmed", "corrected", "refuted", "vacuous"}
    """

    item: str
    printed: str
    best: str
    verdict: Word


def judge(printed: bool, best: bool) -> Word:
    """Confirmed in both readings, corrected in one, refuted in none.

    Examples
    --------
    >>> judge(True, True), judge(False, True), judge(False, False)
    ('confirmed', 'corrected', 'refuted')
    """
    return "confirmed" if printed and best else "corrected" if printed or best else "refuted"


def judge_number(printed: float | None, best: float | None, stated: float, width: float) -> Word:
    """As `judge`, for a number on an axis of the given width; a best value within 5 % of the axis corrects it.

    Examples
    --------
    >>> judge_number(None, 0.867, 0.865, 1.0), judge_number(None, 0.80, 0.83, 1.0), judge_number(None, None, 0.8, 1.0)
    ('corrected', 'corrected', 'refuted')
    """
    near = [value is not None and abs(value - stated) <= NEAR * width for value in (printed, best)]
    if not any(near) and best is not None and abs(best - stated) <= FAR * width:
        return "corrected"
    return judge(*near)


def both(item: str, texts: Sequence[str], holds: Sequence[bool]) -> Verdict:
    """The verdict on an item from what the two readings give and whether it holds in each."""
    return Verdict(item, texts[0], texts[1], judge(holds[0], holds[1]))


def verdict_table(*groups: Iterable[Verdict]) -> Table:
    """All verdicts in the article's order, one row an item.

    Raises
    ------
    ValueError
        Unless every item of the article is there exactly once.
    """
    found = [verdict for group in groups for verdict in group]
    expected = [s.item for s in published.STATEMENTS]
    if sorted(v.item for v in found) != sorted(expected):
        wrong = {v.item for v in found}.symmetric_difference(expected)
        raise ValueError(f"every item of the article must be there exactly once; look at {', '.join(sorted(wrong))}")
    found.sort(key=lambda verdict: expected.index(verdict.item))
    rows = [[v.item, published.statement(v.item).text, v.printed, v.best, v.verdict] for v in found]
    return Table(["item", "the article", "as printed", "best reading", "verdict"], rows)
