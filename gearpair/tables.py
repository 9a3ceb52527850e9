"""Tables for people: aligned as text, ruled as HTML, the same numbers in both."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape, unescape
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gearpair._flow.closed_form import DEGREE, REACH, TERMS
from gearpair.bifurcations.branches import Branch
from gearpair.bifurcations.locating import Bifurcation
from gearpair.bifurcations.structure import coexistence
from gearpair.design import SpeedRange
from gearpair.ensembles.datasets import symbol
from gearpair.methods.certificates import Segment
from gearpair.methods.precision import numerical_chaos
from gearpair.motion.names import IMPACT_NAMES
from gearpair.motion.steady import SteadyState
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr

# Plain names of symbols, and how they are set in HTML.
GREEK = dict(
    zip(("Omega", "omega", "theta", "zeta", "phi", "psi", "eps", "epsilon", "tau", "pi"), "Ωωθζφψεετπ", strict=True)
)
SYMBOLS = {**GREEK, ">=": "≥", "<=": "≤", "-+": "∓"}
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

    Raises
    ------
    ValueError
        For a row with more or fewer cells than there are columns.

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
        object.__setattr__(self, "columns", tuple(str(column) for column in self.columns))
        object.__setattr__(self, "rows", tuple(tuple(str(cell) for cell in row) for row in self.rows))
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
        lines = [self.columns, *self.rows]
        widths = [max(map(len, cells)) for cells in zip(*lines, strict=True)]
        texts = [
            "  ".join(
                cell.rjust(width) if right else cell.ljust(width)
                for cell, width, right in zip(line, widths, self.right, strict=True)
            ).rstrip()
            for line in lines
        ]
        return "\n".join([texts[0], "-" * max(map(len, texts)), *texts[1:]])

    def _repr_html_(self) -> str:
        def line(tag: str, cells: Sequence[str]) -> str:
            aligned = zip(cells, self.right, strict=True)
            marks = [f'<{tag} style="text-align: {"right" if r else "left"}">{_html(c)}</{tag}>' for c, r in aligned]
            return f"<tr>{''.join(marks)}</tr>"

        head, body = line("th", self.columns), "\n".join(line("td", row) for row in self.rows)
        return f'<table class="table">\n<thead>\n{head}\n</thead>\n<tbody>\n{body}\n</tbody>\n</table>'


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


def motion_table(states: Mapping[Any, SteadyState], parameter: str, digits: int = 3) -> Table:
    """Settled motions by name: the value of a parameter, extremes, impact state, modulus of the larger multiplier.

    Of a motion that is not periodic only the value is told: the rest depends on the span that was looked at.

    Examples
    --------
    >>> from gearpair import steady_state
    >>> motion_table({"the baseline": steady_state(Oscillator())}, "damping_ratio")
    motion         zeta  X_min  X_max  impact state  largest multiplier
    -------------------------------------------------------------------
    the baseline  0.020  0.118  1.492  single-sided               0.698
    """
    rows = []
    for name, state in states.items():
        cells = [f"{state.x_min:.{digits}f}", f"{state.x_max:.{digits}f}", IMPACT_NAMES[state.impact_state or ""]]
        cells.append(f"{abs(state.multipliers[0]):.{digits}f}")
        value = f"{state.oscillator.parameter(parameter):.{digits}f}"
        rows.append([name, value, *(cells if state.period else ["–"] * len(cells))])
    return Table(["motion", symbol(parameter), "X_min", "X_max", "impact state", "largest multiplier"], rows)


def bifurcation_table(branches: Iterable[Branch], *, digits: int = 5) -> Table:
    """Every bifurcation of a set of branches, by rising parameter.

    Parameters
    ----------
    branches : iterable of Branch
        Along one parameter.
    digits : int
        Decimals of the parameter.

    Returns
    -------
    Table
        Kind, value, the orbit's period, contacts per cycle on the drive and coast side (before and after
        a grazing), and impact state.

    Examples
    --------
    >>> from gearpair import continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> bifurcation_table([continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)])
    kind  Omega_h  period  contacts  impact state
    ---------------------------------------------
    flip  0.76601       2  2 + 0     single-sided
    """
    found = sorted((b for branch in branches for b in branch.bifurcations), key=lambda b: (b.value, b.kind))
    rows = [[b.kind, f"{b.value:.{digits}f}", b.period, _contacts(b), IMPACT_NAMES[b.impact_state]] for b in found]
    value = symbol(found[0].parameter) if found else "value"
    return Table(["kind", value, "period", "contacts", "impact state"], rows)


def _contacts(bifurcation: Bifurcation) -> str:
    """Contacts per cycle (drive + coast), on both sides of a grazing."""
    first, second = (f"{drive} + {coast}" for drive, coast in bifurcation.contacts)
    return first if first == second else f"{first} | {second}"


def coexistence_table(
    branches: Sequence[Branch], lower: float, upper: float, *, shortest: float, digits: int = 4
) -> Table:
    """Which stable orbits of a set of branches exist together, one row a range; see `coexistence`.

    Examples
    --------
    >>> from gearpair import continue_orbit, periodic_orbit
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> coexistence_table([continue_orbit(orbit, "mesh_frequency", 0.7, 0.78)], 0.72, 0.78, shortest=0.001)
      from      to  stable orbits
    ------------------------------------------------------
    0.7200  0.7660  period 2 (single-sided)
    0.7660  0.7800  none up to the longest period followed
    """
    rows = []
    for low, high, motions in coexistence(list(branches), lower, upper, shortest=shortest):
        words = [(f"{m.kind} ({IMPACT_NAMES[m.impact_state or '']})", n) for m, n in Counter(motions).items()]
        text = ", ".join(word if n == 1 else f"{n} of {word}" for word, n in words)
        rows.append([f"{low:.{digits}f}", f"{high:.{digits}f}", text or "none up to the longest period followed"])
    return Table(["from", "to", "stable orbits"], rows)


def cascade_table(cascades: Iterable[Sequence[Bifurcation]], *, digits: int = 6) -> Table:
    """Period-doubling sequences, one row each: the first flips and the ratios of the gaps between them.

    Parameters
    ----------
    cascades : iterable of sequences of Bifurcation
        Of `doubling_cascade`.
    digits : int
        Decimals of the parameter.

    Returns
    -------
    Table
        The sequence of periods, its flips, and the ratios of successive gaps (4.669 in the limit).

    Examples
    --------
    >>> from gearpair import continue_orbit, periodic_orbit
    >>> from gearpair.bifurcations import doubling_cascade
    >>> orbit = periodic_orbit(Oscillator(), 0.34629, -0.25625, 2)
    >>> flip = continue_orbit(orbit, "mesh_frequency", 0.7, 0.78).bifurcations[0]
    >>> cascade_table([doubling_cascade(flip, 3)], digits=4).rows[0]
    ('2 4 8', '0.7660 0.7983 0.8067', '3.84')
    """
    rows = []
    for flips in cascades:
        values = [flip.value for flip in flips]
        gaps = np.diff(values)
        ratios = gaps[:-1] / gaps[1:]
        rows.append(
            [
                " ".join(str(flip.period) for flip in flips),
                " ".join(f"{value:.{digits}f}" for value in values),
                " ".join(f"{ratio:.2f}" for ratio in ratios),
            ]
        )
    return Table(["periods", "flips at", "ratios of the gaps"], rows)


def disorder_table(exact: xr.Dataset, drawn: Mapping[str, xr.Dataset]) -> Table:
    """How often a diagram shows disorder where the motion is periodic, and a period where it is not.

    Parameters
    ----------
    exact : xarray.Dataset
        Of `sweep`.
    drawn : mapping of str to xarray.Dataset
        Diagrams of the same values by name, of `runge_kutta_sweep` or `plain_sweep`.

    Returns
    -------
    Table
        Shares of the values, as `coarse_share` writes them.

    Examples
    --------
    >>> from gearpair import sweep
    >>> from gearpair.methods import runge_kutta_sweep
    >>> osc, values = Oscillator(), [1.65, 1.7]
    >>> exact = sweep(osc, "mesh_frequency", values)
    >>> disorder_table(exact, {"RK45": runge_kutta_sweep(osc, "mesh_frequency", values)})
    drawn by  disordered though periodic  periodic though not
    ---------------------------------------------------------
    RK45      all                         under 10%
    """
    rows = []
    for name, diagram in drawn.items():
        missed = (exact.status.values != "periodic") & (diagram.period.values > 0)
        rows.append([name, coarse_share(numerical_chaos(exact, diagram)), coarse_share(missed)])
    return Table(["drawn by", "disordered though periodic", "periodic though not"], rows)


def coarse_share(where: ArrayLike) -> str:
    """The share of true values, so coarse that rounding on another machine hardly changes it.

    Parameters
    ----------
    where : array_like of bool

    Returns
    -------
    str
        To the nearest 10%; ``"under 10%"`` and ``"over 90%"`` near the ends, ``"all"`` if all are.

    Examples
    --------
    >>> coarse_share([True, False, False]), coarse_share([True] * 29 + [False]), coarse_share([False])
    ('30%', 'over 90%', 'under 10%')
    """
    share = float(np.mean(np.asarray(where, dtype=bool)))
    if share == 1.0:
        return "all"
    return "under 10%" if share < 0.1 else "over 90%" if share > 0.9 else f"{round(share, 1):.0%}"


def speed_range_table(ranges: Iterable[SpeedRange]) -> Table:
    """The speeds to avoid, one row a range: why, and the worst of it.

    Parameters
    ----------
    ranges : iterable of SpeedRange
        Of `gearpair.design.speeds_to_avoid`.

    Returns
    -------
    Table

    Examples
    --------
    >>> from gearpair.design import SpeedRange
    >>> speed_range_table([SpeedRange(6836.7, 8139.1, "the teeth part", ("period 1",), 3.779, 0.571, 568.0)])
    rpm        why             motions   dynamic factor  time apart  impacts at (mm/s)
    ----------------------------------------------------------------------------------
    6837–8139  the teeth part  period 1             3.8         57%                568
    """
    rows = [
        [
            f"{run.lower:.0f}–{run.upper:.0f}",
            run.why,
            ", ".join(run.motions) if len(run.motions) < 4 else f"{len(run.motions)} kinds",
            f"{run.dynamic_factor:.1f}",
            f"{run.time_apart:.0%}",
            f"{run.impact_velocity:.3g}",
        ]
        for run in ranges
    ]
    columns = ["rpm", "why", "motions", "dynamic factor", "time apart", "impacts at (mm/s)"]
    return Table(columns, rows or [["none", "the teeth stay in contact", *["–"] * 4]])


def certificate_table(pieces: Iterable[Segment]) -> Table:
    """How many segments each certificate settles, and how many of these hold a crossing.

    Parameters
    ----------
    pieces : iterable of Segment

    Returns
    -------
    Table

    Examples
    --------
    >>> from gearpair.methods import segments
    >>> len(certificate_table(segments(Oscillator(), 1.0, 0.0)).rows)
    3
    """
    kinds = [(piece.certificate, piece.crossing is not None) for piece in pieces]
    rows = [
        [f"{i}. {name}", sum(kind == name for kind, _ in kinds), kinds.count((name, True))]
        for i, name in enumerate(("hull", "monotone", "steps"), start=1)
    ]
    return Table(["certificate", "segments", "with a crossing"], rows)


def series_table(osc: Oscillator) -> Table:
    """The constants of the power series and the cells that `osc` needs.

    Parameters
    ----------
    osc : Oscillator

    Returns
    -------
    Table

    Examples
    --------
    >>> series_table(Oscillator()).rows[0]
    ('degree of the series', '15')
    """
    neglected = REACH**TERMS / float(np.prod(np.arange(1.0, TERMS + 1)))
    rows = [
        ["degree of the series", f"{DEGREE}"],
        ["reach: the most that a rate turns in a cell", f"{REACH:.1f}"],
        ["first neglected term", f"{neglected:.0e}"],
        ["cells in the mesh period", f"{len(osc.cells.level)}"],
    ]
    return Table(["of the closed form", "value"], rows)
