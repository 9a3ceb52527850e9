"""Marks for one graded cell, item by item, each with a sentence that the student can use."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair.teaching.answers import Unreadable
from gearpair.teaching.drawings import Curve, drawing

HALF = 0.5
SHARP = 0.02  # relative error within which a typical mistake, or a power of ten, is taken for it
COVERED = 0.95  # of the range asked for, to count as drawn
KINDS = {"str": "a text", "bool": "true or false", "list": "a list", "tuple": "a tuple", "ndarray": "an array"}
AGREEING = 0.95  # of the points in it, to count as right: a point on a jump may be on either side


@dataclass(frozen=True, eq=False)
class Item:
    """What was asked for in one place of a graded cell, and what is right: what a sheet or a question file is made of.

    Attributes
    ----------
    name : str
    truth : object
        A number, a word, a truth value; a function of x for a curve, None for the labels of a figure.
    marks, within, nearly : float
        As of `Marks.number`.
    over : tuple of float, optional
        The range of a curve.
    """

    name: str
    truth: Any
    marks: float
    within: float = 0.0
    nearly: float = 0.0
    over: tuple[float, float] | None = None


class Marks:
    """The marks of one graded cell; each item has a `name` for its sentence, and earns `marks` at most.

    Its `repr` is what nbgrader reads: the total, once something has been marked. Before that (in the student's
    notebook, which has no hidden tests) it says whether the answers are there at all.

    Examples
    --------
    >>> marks = Marks()
    >>> marks.number("base pitch", 8.86, 8.8564, within=1e-3)
    base pitch: right (1 of 1)
    >>> marks.number("stiffness", 3.9e8, 390.0, marks=2)
    stiffness: right but for a power of ten, look at the unit (1 of 2)
    >>> marks
    2
    """

    def __init__(self) -> None:
        self.total = 0.0
        self.marked = False
        self.missing: list[str] = []
        self.items: list[Item] = []

    def __repr__(self) -> str:
        if self.marked:
            return f"{self.total:g}"
        return "0" if self.missing else "every answer asked for is there; whether they are right, the grading will tell"

    def expect(self, **answers: Any) -> None:
        """Say which answers, by name, are still missing: the part of a test students see.

        Missing is None, an ellipsis, and a figure without a curve.
        """
        self.missing = [name for name, value in answers.items() if _missing(value)]
        for name in self.missing:
            print(f"{name}: no answer yet")

    def number(
        self,
        name: str,
        given: Any,
        truth: float,
        *,
        marks: float = 1.0,
        within: float = 1e-3,
        nearly: float = 0.0,
        also: Iterable[float] = (),
        follows: tuple[Any, ...] | None = None,
        mistakes: Mapping[str, float] | None = None,
    ) -> None:
        """Mark a number.

        Parameters
        ----------
        given, truth : object, float
            The answer and what is right; one off by a power of ten alone earns half.
        within : float
            Largest relative error of a right answer (absolute, where the truth is 0).
        nearly : float
            Largest relative error that still earns half: a step of a grid, say.
        also : iterable of float
            What other honest ways give: right as well.
        follows : tuple, optional
            A function, and the student's earlier answers that it is called with: what is right where these are wrong.
            It counts where they are numbers, and where it gives a finite number other than 0.
        mistakes : mapping of str to float, optional
            What typical errors give, each by the sentence that names its cause to the student.

        Examples
        --------
        >>> Marks().number("b", 6.0, 4.0, follows=(lambda a: 2 * a, 3.0))
        b: right, from your own earlier answers (1 of 1)
        >>> Marks().number("c", 57.3, 1.0, mistakes={"that is in degrees": 57.3})
        c: not the right number: that is in degrees (0 of 1)
        """
        self.items.append(Item(name, truth, marks, within, nearly))
        value = as_number(given)
        if value is None:
            self._give(name, _instead_of("a number", given), 0.0, marks)
            return
        exactly = min(within, SHARP)
        hints = (hint for hint, wrong in (mistakes or {}).items() if _near(value, wrong, exactly))
        hint = next((f": {hint}" for hint in hints), "")
        if any(_near(value, right, within) for right in (truth, *also)):
            self._give(name, "right", marks, marks)
        elif _near(value, _followed(follows), within):
            self._give(name, "right, from your own earlier answers", marks, marks)
        elif _near(value, truth, nearly):
            self._give(name, f"close, but not right{hint}", HALF * marks, marks)
        elif any(_near(value * 10.0**power, truth, exactly) for power in range(-12, 13)):
            self._give(name, f"right but for a power of ten, look at the unit{hint}", HALF * marks, marks)
        else:
            self._give(name, f"not the right number{hint}", 0.0, marks)

    def same(
        self,
        name: str,
        given: Any,
        truth: object,
        *,
        marks: float = 1.0,
        mistakes: Mapping[str, object] | None = None,
        shown: object = None,
    ) -> None:
        """Mark a word (whatever its capitals and blanks around it), a whole number or a truth value: right or not.

        `mistakes` holds what typical errors give, each by the sentence that names its cause to the student; `shown` is
        what a sheet says for the truth, where this does not say it.
        """
        self.items.append(Item(name, truth if shown is None else shown, marks))
        if given is None or isinstance(given, Unreadable):
            self._give(name, _instead_of("an answer", given), 0.0, marks)
            return
        hints = (hint for hint, wrong in (mistakes or {}).items() if _alike(given, wrong))
        hint = next((f": {hint}" for hint in hints), "")
        right = _alike(given, truth)
        wrong = "not the right word" if isinstance(truth, str) else "not right"
        self._give(name, "right" if right else f"{wrong}{hint}", marks * right, marks)

    def curve(
        self,
        name: str,
        axes: Any,
        truth: Callable[[NDArray[np.float64]], ArrayLike],
        over: tuple[float, float],
        *,
        marks: float = 1.0,
        within: float = 2e-3,
        points: int = 20,
        also: Iterable[Callable[[NDArray[np.float64]], ArrayLike]] = (),
        mistakes: Mapping[str, Callable[[NDArray[np.float64]], ArrayLike]] | None = None,
    ) -> None:
        """Mark one curve of a figure by the numbers behind it; the best of its curves counts.

        Parameters
        ----------
        axes : Axes or Drawing
        truth : callable
            The right y for an array of x.
        over : tuple of float
            The range of x that the curve must cover; a right one that covers less, has too few points, or is off by a
            power of ten earns half.
        within : float
            Largest error, relative to the largest true value.
        points : int
            That the curve must have in the range.
        also : iterable of callable, optional
            What other honest ways draw: right as well.
        mistakes : mapping of str to callable, optional
            What typical errors draw, each by the sentence that names its cause to the student.
        """
        self.items.append(Item(name, truth, marks, within, over=over))
        drawn = drawing(axes)
        if drawn is None:
            self._give(name, _instead_of("a figure (an Axes)", axes), 0.0, marks)
            return
        rights = (truth, *also)
        shares = [_curve_share(curve, right, over, within, points) for curve in drawn.curves for right in rights]
        best = max(shares, default=0.0)
        sentence = {1.0: "right", HALF: "right in part: look at its range, its number of points and its unit"}
        told = sentence.get(best, "no curve of the figure has the right values" if drawn.curves else "an empty figure")
        for hint, wrong in (mistakes or {}).items() if best == 0.0 else ():
            if any(_curve_share(curve, wrong, _range_of(curve, over), within, 2) for curve in drawn.curves):
                told += f": {hint}"
                break
        self._give(name, told, best * marks, marks)

    def labels(self, name: str, axes: Any, *, marks: float = 1.0) -> None:
        """Mark the labels of the axes of a figure, an Axes or a `Drawing`: half of the marks for each."""
        self.items.append(Item(name, None, marks))
        drawn = drawing(axes)
        there = sum(bool(label.strip()) for label in (drawn.x_label, drawn.y_label)) if drawn else 0
        self._give(name, ("none", "one of two", "both there")[there], HALF * there * marks, marks)

    def _give(self, name: str, sentence: str, given: float, marks: float) -> None:
        self.marked = True
        self.total += given
        print(f"{name}: {sentence} ({given:g} of {marks:g})")


def as_number(given: Any) -> float | None:
    """An answer as a number; None where it is none, or not a finite one.

    Examples
    --------
    >>> as_number(2), as_number("2"), as_number(float("inf"))
    (2.0, None, None)
    """
    if isinstance(given, bool) or not isinstance(given, Real):
        if isinstance(given, np.ndarray) and given.size == 1:
            return as_number(given.item())
        return None
    try:
        value = float(given)
    except OverflowError:
        return None
    return value if math.isfinite(value) else None


def _near(value: float, truth: float | None, within: float) -> bool:
    return truth is not None and abs(value - truth) <= within * (abs(truth) or 1.0)


def _followed(follows: tuple[Any, ...] | None) -> float | None:
    """What follows from the student's earlier answers, if that is a number."""
    if follows is None:
        return None
    earlier = [as_number(each) for each in follows[1:]]
    if None in earlier:
        return None
    try:
        return as_number(follows[0](*earlier)) or None
    except (ArithmeticError, ValueError):  # such as a contact ratio that no wave can have
        return None


def _alike(given: Any, truth: object) -> bool:
    if isinstance(truth, str):
        return isinstance(given, str) and given.strip().lower() == truth.lower()
    value = given if isinstance(given, bool) else as_number(given)
    return isinstance(given, bool) == isinstance(truth, bool) and value == truth


def _missing(answer: Any) -> bool:
    """Whether an answer is not there: nothing, or a figure on which nothing is drawn."""
    if answer is None or answer is ...:
        return True
    drawn = drawing(answer)
    return drawn is not None and not drawn.curves


def _instead_of(wanted: str, given: Any) -> str:
    if given is None or given is ... or (isinstance(given, Unreadable) and given.kind == "ellipsis"):
        return "no answer"
    if isinstance(given, float) and not math.isfinite(given):
        return f"{wanted} was asked for, not {given}"
    kind = given.kind if isinstance(given, Unreadable) else type(given).__name__
    return f"{wanted} was asked for, not {KINDS.get(kind, kind)}"


def _range_of(curve: Curve, over: tuple[float, float]) -> tuple[float, float]:
    """Where a curve is, whatever it is drawn over."""
    x = curve.x[np.isfinite(curve.x)]
    return (float(x.min()), float(x.max())) if x.size else over


def _curve_share(
    curve: Curve,
    truth: Callable[[NDArray[np.float64]], ArrayLike],
    over: tuple[float, float],
    within: float,
    points: int,
) -> float:
    if curve.x.shape != curve.y.shape:
        return 0.0
    low, high = over
    slack = 1e-9 * (high - low)
    inside = np.isfinite(curve.x) & np.isfinite(curve.y) & (curve.x >= low - slack) & (curve.x <= high + slack)
    x, y = curve.x[inside], curve.y[inside]
    if x.size == 0:
        return 0.0
    right = np.asarray(truth(x), dtype=float)
    full = x.size >= points and np.ptp(x) >= COVERED * (high - low)
    enough = x.size >= 2 and np.ptp(x) >= 0.3 * (high - low)
    largest = float(np.abs(right).max()) or 1.0
    for power in (0, *range(-12, 0), *range(1, 13)):
        if np.mean(np.abs(y * 10.0**power - right) <= within * largest) >= AGREEING:
            return (1.0 if full and power == 0 else HALF) if enough else 0.0
    return 0.0
