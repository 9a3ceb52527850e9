"""Tables for people: aligned as text, ruled as HTML, the same numbers in both."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape, unescape
from itertools import zip_longest
from textwrap import wrap
from typing import Any

from gearpair._checks import check_count, shown
from gearpair.quantities import LETTERS

# Plain names of symbols, and how they are set in HTML.
SYMBOLS = {**LETTERS, ">=": "≥", "<=": "≤", "-+": "∓"}
SYMBOL = re.compile("|".join(rf"(?<!\w){re.escape(escape(name))}(?!\w)" for name in SYMBOLS))
INDEX = re.compile(r"(?<!\w)((?:Omega|omega|phi|[FTXbcekmr])(?=_)|theta(?=\d))_?(min|max|ah|b1|b2|[aehmn12])(?!\w)")
PRIMES = re.compile(r"(?:(?<=\b[Xxe])|(?<=F<sub>m</sub>))(?:&#x27;)+(?!\w)")


@dataclass(frozen=True)
class Table:
    """Rows under headings; its `repr` is aligned text, and a notebook shows it as HTML with its symbols set.

    Parameters
    ----------
    columns : sequence of str
        The headings.
    rows : sequence of sequences
        As many cells each as there are columns; numbers stand to the right. A cell is shown as `str` gives it, so
        format floats first.

    Examples
    --------
    >>> Table(["motion", "from", "to"], [["period 2", "0.700", "0.766"], ["chaos", "0.81", "0.814"]])
    motion     from     to
    ----------------------
    period 2  0.700  0.766
    chaos      0.81  0.814
    """

    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]

    def __post_init__(self) -> None:
        columns, rows = _members("columns", self.columns), _members("rows", self.rows)
        object.__setattr__(self, "columns", tuple(map(str, columns)))
        texts = tuple(tuple(map(str, _members(f"rows[{i}]", row))) for i, row in enumerate(rows))
        object.__setattr__(self, "rows", texts)
        for i, row in enumerate(self.rows):
            if len(row) != len(self.columns):
                raise ValueError(f"row {i} of the table must have {len(self.columns)} cells, got {len(row)}")

    @property
    def right(self) -> tuple[bool, ...]:
        """Whether each column holds numbers only (empty cells and dashes aside) and so stands to the right."""
        return tuple(
            any(map(_is_number, cells)) and all(_is_number(cell) or cell in ("", "-", "–") for cell in cells)
            for cells in (list(column) for column in zip(*self.rows, strict=True))
        ) or (False,) * len(self.columns)

    def __repr__(self) -> str:
        return self.text()

    def text(self, widest: int | None = None) -> str:
        """The table as aligned text.

        Parameters
        ----------
        widest : int, optional
            Cells of more characters go on in further lines, as do headings wider than their column.

        Examples
        --------
        >>> print(Table(["rpm", "what they do"], [["900", "part or stay"], ["950", "part"]]).text(widest=9))
        rpm  what
             they do
        ------------
        900  part or
             stay
        950  part
        """
        if widest is None:
            folded = [[[cell] for cell in line] for line in (self.columns, *self.rows)]
        else:
            widest = check_count("widest", widest)
            rows = [[wrap(cell, widest) or [""] for cell in row] for row in self.rows]
            needed = [[piece for cell in column for piece in cell] for column in zip(*rows, strict=True)]
            head = [
                wrap(name, max(map(len, [*pieces, *name.split()])))
                for name, pieces in zip(self.columns, needed or [[]] * len(self.columns), strict=True)
            ]
            folded = [head, *rows]
        widths = [max(len(piece) for pieces in cells for piece in pieces) for cells in zip(*folded, strict=True)]
        texts = [
            "  ".join(
                piece.rjust(width) if right else piece.ljust(width)
                for piece, width, right in zip(pieces, widths, self.right, strict=True)
            ).rstrip()
            for line in folded
            for pieces in zip_longest(*line, fillvalue="")
        ]
        below = max(map(len, folded[0]))
        return "\n".join([*texts[:below], "-" * max(map(len, texts)), *texts[below:]])

    def _repr_html_(self) -> str:
        def line(tag: str, cells: Sequence[str]) -> str:
            aligned = zip(cells, self.right, strict=True)
            marks = [f'<{tag} style="text-align: {"right" if r else "left"}">{_html(c)}</{tag}>' for c, r in aligned]
            return f"<tr>{''.join(marks)}</tr>"

        head, body = line("th", self.columns), "\n".join(line("td", row) for row in self.rows)
        return f'<table class="table">\n<thead>\n{head}\n</thead>\n<tbody>\n{body}\n</tbody>\n</table>'


def _members(name: str, given: Any) -> tuple[Any, ...]:
    if isinstance(given, (str, bytes)) or not isinstance(given, Iterable):
        raise TypeError(f"{name} must be a sequence, got {shown(given)}")
    return tuple(given)


def _html(cell: str) -> str:
    """A cell with its symbols set, and its intervals kept on one line."""
    text = INDEX.sub(r"\1<sub>\2</sub>", escape(cell))
    text = SYMBOL.sub(lambda match: SYMBOLS[unescape(match.group())], text)
    text = PRIMES.sub(lambda match: "′" * unescape(match.group()).count("'"), text).replace("^2", "²")
    return re.sub(r"(?<=\d)–(?=\d)", "&#8288;–&#8288;", text)


def _is_number(cell: str) -> bool:
    try:
        float(cell.removesuffix("%").strip().replace("\N{MINUS SIGN}", "-"))
    except ValueError:
        return False
    return True
