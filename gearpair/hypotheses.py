"""What the published tables may have been computed with: readings of the equation, and ways to run a sweep.

A `Hypothesis` is a reading of the article's physics, a `Protocol` a way to draw its diagrams; a `Trial` is one with
the other, scored by `gearpair.reproduction.score`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair import published
from gearpair._checks import check_choice, check_count, check_number
from gearpair.batches import SettleSettings, settle_lanes
from gearpair.integrators import runge_kutta_sweep
from gearpair.oscillator import Oscillator
from gearpair.reproduction import Score, label, published_labels, score
from gearpair.stiffness import StiffnessWave
from gearpair.tables import Table

SHAPES = {0.0: "sin", 90.0: "cos", 180.0: "-sin", 270.0: "-cos"}
MAX_PERIOD = 12  # longer ones count as no period: nobody reads them off a diagram


@dataclass(frozen=True, kw_only=True)
class Hypothesis:
    """A reading of the article's equation; every default is what is printed.

    Parameters
    ----------
    stiff_for : {"eps - 1", "2 - eps"}
        How much of the mesh period the stiff interval lasts (item K2 says eps - 1).
    first : {"stiff", "soft"}
        Which interval begins at the start of the mesh period.
    phase : float
        Degrees added to the argument of the forcing's sine: 0 is sine, 90 cosine, 180 minus sine (the other sign of
        the error), 270 minus cosine.
    force : {"Omega^2", "constant"}
        Whether the forcing's amplitude is F_ah Omega^2 (item M6) or F_ah.
    mean : {"as printed", "one"}
        Whether the wave is divided by its mean, as item M5 asks.
    damping : {"2 zeta", "zeta"}
        The coefficient of X'.

    Examples
    --------
    >>> print(Hypothesis(stiff_for="2 - eps", phase=90.0))
    stiff for 2 - eps, stiff first, cos, Omega^2, mean as printed, 2 zeta
    """

    stiff_for: Literal["eps - 1", "2 - eps"] = "eps - 1"
    first: Literal["stiff", "soft"] = "stiff"
    phase: float = 0.0
    force: Literal["Omega^2", "constant"] = "Omega^2"
    mean: Literal["as printed", "one"] = "as printed"
    damping: Literal["2 zeta", "zeta"] = "2 zeta"

    def __post_init__(self) -> None:
        check_choice("stiff_for", self.stiff_for, ("eps - 1", "2 - eps"))
        check_choice("first", self.first, ("stiff", "soft"))
        check_number("phase", self.phase)
        check_choice("force", self.force, ("Omega^2", "constant"))
        check_choice("mean", self.mean, ("as printed", "one"))
        check_choice("damping", self.damping, ("2 zeta", "zeta"))

    def __str__(self) -> str:
        shape = SHAPES.get(self.phase % 360.0, f"sin(. + {self.phase:g} deg)")
        words = (
            f"stiff for {self.stiff_for}",
            f"{self.first} first",
            shape,
            self.force,
            f"mean {self.mean}",
            self.damping,
        )
        return ", ".join(words)

    @property
    def wave(self) -> StiffnessWave:
        """The stiffness wave of this reading."""
        base = published.BASELINE
        stiff = base.contact_ratio - 1.0 if self.stiff_for == "eps - 1" else 2.0 - base.contact_ratio
        high, low = 1.0 + base.a, 1.0 - base.b
        mean = stiff * high + (1.0 - stiff) * low if self.mean == "one" else 1.0
        if self.first == "stiff":
            return StiffnessWave((0.0, stiff), (high / mean, low / mean))
        return StiffnessWave((0.0, 1.0 - stiff), (low / mean, high / mean))

    def oscillator(
        self,
        mesh_frequency: float = published.DAMPING_FREQUENCY,
        damping_ratio: float = published.BASELINE.damping_ratio,
    ) -> Oscillator:
        """The article's baseline in this reading."""
        base = published.BASELINE
        return Oscillator(
            mean_force=base.mean_force,
            error_amplitude=base.error_amplitude * (1.0 if self.force == "Omega^2" else mesh_frequency**-2),
            error_phase=base.error_phase + float(np.radians(self.phase)),
            damping_ratio=damping_ratio * (1.0 if self.damping == "2 zeta" else 0.5),
            mesh_frequency=mesh_frequency,
            stiffness=self.wave,
        )

    def along(self, parameter: str, values: ArrayLike) -> list[Oscillator]:
        """One oscillator per value of a parameter that the article varies."""
        published.ranges(parameter)
        return [self.oscillator(**{parameter: float(value)}) for value in np.asarray(values)]


PRINTED = Hypothesis()
SWAPPED = Hypothesis(stiff_for="2 - eps")


def all_hypotheses() -> tuple[Hypothesis, ...]:
    """Every combination of the readings, the phase in quarter turns.

    Examples
    --------
    >>> len(all_hypotheses()), all_hypotheses()[0] == PRINTED
    (128, True)
    """
    choices = product(
        ("eps - 1", "2 - eps"),
        ("stiff", "soft"),
        SHAPES,
        ("Omega^2", "constant"),
        ("as printed", "one"),
        ("2 zeta", "zeta"),
    )
    return tuple(
        Hypothesis(stiff_for=s, first=i, phase=p, force=f, mean=m, damping=d)  # type: ignore[arg-type]
        for s, i, p, f, m, d in choices
    )


@dataclass(frozen=True)
class Protocol:
    """A way to draw a diagram.

    Parameters
    ----------
    seeding : {"up", "down", "restart"}
        State carried with the parameter rising or falling, or every value started from (x, v).
    n_discarded : int or None
        Mesh periods discarded as transient at each value; None waits for each motion to settle.
    x, v : float
        The start.
    """

    seeding: Literal["up", "down", "restart"]
    n_discarded: int | None = 200
    x: float = 0.0
    v: float = 0.0

    def __post_init__(self) -> None:
        check_choice("seeding", self.seeding, ("up", "down", "restart"))
        if self.n_discarded is not None:
            check_count("n_discarded", self.n_discarded)

    def __str__(self) -> str:
        wait = "settled" if self.n_discarded is None else f"{self.n_discarded} discarded"
        return f"{self.seeding} from ({self.x:g}, {self.v:g}), {wait}"


def all_protocols(
    starts: Iterable[tuple[float, float]] = ((0.0, 0.0),), n_discarded: Iterable[int | None] = (200,)
) -> tuple[Protocol, ...]:
    """Up, down and restarted, from each start, with each transient.

    Examples
    --------
    >>> print(*all_protocols(), sep="; ")
    up from (0, 0), 200 discarded; down from (0, 0), 200 discarded; restart from (0, 0), 200 discarded
    """
    return tuple(
        Protocol(seeding, n, x, v) for n in n_discarded for x, v in starts for seeding in ("up", "down", "restart")
    )


@dataclass(frozen=True)
class Trial:
    """One hypothesis drawn by one protocol, and its scores on the two published axes."""

    hypothesis: Hypothesis
    protocol: Protocol
    frequency: Score
    damping: Score

    @property
    def total(self) -> float:
        """The mean of the two scores: one hypothesis has to explain both tables."""
        return 0.5 * (self.frequency.total + self.damping.total)


def axis(parameter: str, n_values: int) -> NDArray[np.float64]:
    """Evenly spaced values over the published axis of a parameter."""
    ranges = published.ranges(parameter)
    return np.linspace(ranges[0].lower, ranges[-1].upper, check_count("n_values", n_values, at_least=2))


def periods(
    hypotheses: Sequence[Hypothesis], protocol: Protocol, parameter: str, n_values: int = 101
) -> NDArray[np.int64]:
    """The period at each value of a parameter (rising), 0 where none up to 12; shape (hypotheses, n_values).

    Examples
    --------
    >>> periods([SWAPPED], Protocol("down", None), "damping_ratio", 6)[0, 1:].tolist()
    [1, 1, 1, 1, 1]
    """
    values = axis(parameter, n_values)
    order = slice(None, None, -1) if protocol.seeding == "down" else slice(None)
    oscillators = [osc for hypothesis in hypotheses for osc in hypothesis.along(parameter, values[order])]
    starts = np.broadcast_to([protocol.x, protocol.v], (len(oscillators), 2))
    settings = SettleSettings(
        n_transient=protocol.n_discarded, max_period=MAX_PERIOD, n_exponent=20, n_samples=MAX_PERIOD
    )
    out = settle_lanes(oscillators, starts, settings, chain=1 if protocol.seeding == "restart" else n_values)
    return out.period.reshape(len(hypotheses), n_values)[:, order]


def trials(hypotheses: Sequence[Hypothesis], protocols: Sequence[Protocol], n_values: int = 101) -> list[Trial]:
    """Every hypothesis by every protocol, the best first.

    Parameters
    ----------
    hypotheses : sequence of Hypothesis
    protocols : sequence of Protocol
    n_values : int
        Values on each axis.

    Returns
    -------
    list of Trial

    Examples
    --------
    >>> best = trials([PRINTED, SWAPPED], [Protocol("down", None)], n_values=26)[0]
    >>> best.hypothesis == SWAPPED
    True
    """
    done = []
    for protocol in protocols:
        found = {p: periods(hypotheses, protocol, p, n_values) for p in ("mesh_frequency", "damping_ratio")}
        for i, hypothesis in enumerate(hypotheses):
            scores = [score(p, axis(p, n_values), motions[i]) for p, motions in found.items()]
            done.append(Trial(hypothesis, protocol, *scores))
    return sorted(done, key=lambda trial: -trial.total)


def runge_kutta_trials(
    hypotheses: Sequence[Hypothesis], protocols: Sequence[Protocol], rtol: float, n_values: int = 61
) -> list[Trial]:
    """`trials` with Runge-Kutta 4-5 in place of the exact flow, periods read off as a reader would.

    Parameters
    ----------
    hypotheses : sequence of Hypothesis
        With forcing and damping as printed: others have no single oscillator to sweep.
    protocols : sequence of Protocol
        With a number of periods to discard.
    rtol : float
        The relative tolerance; the absolute one is a thousandth of it.
    n_values : int
        Values on each axis.

    Returns
    -------
    list of Trial
        The best first.

    Raises
    ------
    ValueError
        For another forcing or damping, or a protocol that waits until motions settle.
    """
    done = []
    for hypothesis, protocol in product(hypotheses, protocols):
        check_choice("force", hypothesis.force, ("Omega^2",))
        check_choice("damping", hypothesis.damping, ("2 zeta",))
        n_discarded = check_count("n_discarded", protocol.n_discarded)
        scores = []
        for parameter in ("mesh_frequency", "damping_ratio"):
            osc, values = hypothesis.oscillator(), axis(parameter, n_values)
            drawn = runge_kutta_sweep(
                osc, parameter, values[::-1] if protocol.seeding == "down" else values, x=protocol.x, v=protocol.v,
                seeding="restart" if protocol.seeding == "restart" else "carry", n_transient=n_discarded,
                n_samples=2 * MAX_PERIOD, rtol=rtol, atol=1e-3 * rtol,
            ).sortby(parameter)  # fmt: skip
            scores.append(score(parameter, values, drawn.period.values))
        done.append(Trial(hypothesis, protocol, *scores))
    return sorted(done, key=lambda trial: -trial.total)


@dataclass(frozen=True)
class Ranked:
    """One hypothesis among others: the mean of its trials' totals, and the best trial."""

    hypothesis: Hypothesis
    mean: float
    best: Trial


def ranking(done: Iterable[Trial]) -> list[Ranked]:
    """Hypotheses by the mean over their trials, the highest first: one lucky start shall not decide."""
    grouped: dict[Hypothesis, list[Trial]] = {}
    for trial in done:
        grouped.setdefault(trial.hypothesis, []).append(trial)
    ranked = [
        Ranked(h, float(np.mean([trial.total for trial in each])), max(each, key=lambda trial: trial.total))
        for h, each in grouped.items()
    ]
    return sorted(ranked, key=lambda entry: -entry.mean)


def worth(ranked: Sequence[Ranked]) -> Table:
    """What each single choice is worth: the best place and the mean score of the hypotheses that make it.

    Parameters
    ----------
    ranked : sequence of Ranked
        Of `ranking`, over `all_hypotheses`.

    Returns
    -------
    Table
        One row for each value of each field of `Hypothesis`.
    """
    rows = []
    for field in fields(Hypothesis):
        for value in dict.fromkeys(getattr(entry.hypothesis, field.name) for entry in ranked):
            places = [i for i, entry in enumerate(ranked) if getattr(entry.hypothesis, field.name) == value]
            mean = float(np.mean([ranked[i].mean for i in places]))
            rows.append([field.name.replace("_", " "), SHAPES.get(value, value), places[0] + 1, f"{mean:.2f}"])
    return Table(["choice", "value", "best place", "mean score"], rows)


STARTS = tuple((x, v) for x in (-1.0, 0.0, 1.0, 2.0) for v in (-0.6, 0.0, 0.6))


@dataclass(frozen=True)
class Reached:
    """The motions that a hypothesis has at each value of a parameter, whatever the protocol: reached from any start.

    Attributes
    ----------
    hypothesis : Hypothesis
    parameter : str
    values : ndarray of float, shape (n,)
    motions : tuple of frozenset of str
        One set of labels per value, as `gearpair.reproduction.label` gives them.
    """

    hypothesis: Hypothesis
    parameter: str
    values: NDArray[np.float64]
    motions: tuple[frozenset[str], ...]

    def has(self, motion: str) -> NDArray[np.bool_]:
        """Where a motion was reached, shape (n,)."""
        return np.array([motion in there for there in self.motions])

    @property
    def published_present(self) -> NDArray[np.bool_]:
        """Where the published motion was reached, shape (n,)."""
        ends = [r.upper for r in published.ranges(self.parameter)[:-1]]
        expected = np.array(published_labels(self.parameter))[np.searchsorted(ends, self.values, side="right")]
        return np.array([want in there for want, there in zip(expected, self.motions, strict=True)])

    @property
    def coverage(self) -> float:
        """Fraction of the axis on which the published motion was reached from some start."""
        return float(np.mean(self.published_present))

    def within(self, item: str) -> float:
        """`coverage` inside one published range, by its item."""
        (stated,) = (r for r in published.ranges(self.parameter) if r.item == item)
        inside = (self.values > stated.lower) & (self.values < stated.upper)
        return float(np.mean(self.published_present[inside]))


def reached(
    hypotheses: Sequence[Hypothesis],
    parameter: str,
    n_values: int = 40,
    *,
    starts: Sequence[tuple[float, float]] = STARTS,
    n_discarded: int | None = None,
) -> list[Reached]:
    """The motions that each hypothesis has at the middles of `n_values` equal parts of the published axis.

    Parameters
    ----------
    hypotheses : sequence of Hypothesis
    parameter : {"mesh_frequency", "damping_ratio"}
    n_values : int
    starts : sequence of (x, v)
    n_discarded : int or None
        As in `Protocol`.

    Returns
    -------
    list of Reached

    Notes
    -----
    This asks less than a `Trial`: which of several coexisting motions a diagram shows depends on its protocol,
    which ones exist does not.

    Examples
    --------
    >>> reached([SWAPPED], "damping_ratio", 5)[0].within("D5")
    1.0
    """
    edges = axis(parameter, n_values + 1)
    values = 0.5 * (edges[1:] + edges[:-1])
    oscillators = [osc for h in hypotheses for osc in h.along(parameter, values) for _ in starts]
    settings = SettleSettings(n_transient=n_discarded, max_period=MAX_PERIOD, n_exponent=20, n_samples=MAX_PERIOD)
    out = settle_lanes(oscillators, np.tile(starts, (len(oscillators) // len(starts), 1)), settings)
    found = out.period.reshape(len(hypotheses), n_values, len(starts))
    return [
        Reached(h, parameter, values, tuple(frozenset(label(int(m), parameter) for m in row) for row in found[i]))
        for i, h in enumerate(hypotheses)
    ]


def random_tables(parameter: str, n: int, *, seed: int = 0, n_values: int = 101) -> list[Score]:
    """Scores of tables with the published motions in their order and boundaries at random.

    Parameters
    ----------
    parameter : {"mesh_frequency", "damping_ratio"}
    n : int
    seed : int
    n_values : int

    Returns
    -------
    list of Score
        What a table scores by chance that already knows the motions and their order.

    Examples
    --------
    >>> len(random_tables("damping_ratio", 3))
    3
    """
    values = axis(parameter, n_values)
    motions = np.array([r.period or 0 for r in published.ranges(parameter)])
    draw = np.random.default_rng(seed).random((check_count("n", n), len(motions) - 1))
    cuts = values[0] + (values[-1] - values[0]) * np.sort(draw, axis=1)
    return [score(parameter, values, motions[np.searchsorted(row, values, side="right")]) for row in cuts]
