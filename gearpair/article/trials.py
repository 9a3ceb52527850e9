"""Ways to draw the article's diagrams, and what readings score by them: a `Trial` is a reading and a `Protocol`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import check_choice, check_count
from gearpair.article.readings import SHAPES, Hypothesis
from gearpair.article.scoring import Score, axis, score
from gearpair.methods.runge_kutta import runge_kutta_sweep
from gearpair.motion.settling import SettleSettings, settle_lanes
from gearpair.tables import Table

MAX_PERIOD = 12  # longer ones count as no period: nobody reads them off a diagram


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


def periods(
    hypotheses: Sequence[Hypothesis], protocol: Protocol, parameter: str, n_values: int = 101
) -> NDArray[np.int64]:
    """The period at each value of a parameter (rising), 0 where none up to 12; shape (hypotheses, n_values).

    Examples
    --------
    >>> from gearpair.article import SWAPPED
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


def run_trials(hypotheses: Sequence[Hypothesis], protocols: Sequence[Protocol], n_values: int = 101) -> list[Trial]:
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
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> best = run_trials([PRINTED, SWAPPED], [Protocol("down", None)], n_values=26)[0]
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
    """`run_trials` with Runge-Kutta 4-5 in place of the exact flow, periods read off as a reader would.

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


def score_by_choice(ranked: Sequence[Ranked]) -> Table:
    """For each single choice the best place and the mean score of the hypotheses that make it.

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
