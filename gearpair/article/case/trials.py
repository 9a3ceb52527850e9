"""All readings, the ways to draw the article's diagrams, and what scores: a `Trial` is a reading and a `Protocol`."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from itertools import product
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_choice, check_count
from gearpair.article.case.scoring import Score, axis, score
from gearpair.article.readings import CHOICES, FORCINGS, Hypothesis
from gearpair.methods.runge_kutta import Integrator, section_period
from gearpair.motion.settling import PERIODS, SettleSettings, settle_batch
from gearpair.oscillator import Oscillator
from gearpair.table import Table

ALREADY = ("one", "2 zeta sqrt(mean)")  # damping at a mean of one is the article's own
MAX_PERIOD = 12  # longer ones count as no period: nobody reads them off a diagram


def all_hypotheses() -> tuple[Hypothesis, ...]:
    """Every combination of the readings of a rectangle, the phase in quarter turns, and one harmonic in its place.

    The damping at the wave's mean is left out where that mean is one: it is then the article's own. One harmonic is
    combined with durations, order and phase only.

    Examples
    --------
    >>> from gearpair.article import PRINTED
    >>> len(all_hypotheses()), all_hypotheses()[0] == PRINTED
    (176, True)
    """
    orders = _combined("stiff_for", "first", phase=FORCINGS)
    scalings = [each for each in _combined("force", "mean", "damping") if (each["mean"], each["damping"]) != ALREADY]
    rectangles = [Hypothesis(**order, **scaling) for order, scaling in product(orders, scalings)]
    return (*rectangles, *(Hypothesis(**order, shape="first harmonic") for order in orders))


def _combined(*names: str, **others: Iterable[Any]) -> list[dict[str, Any]]:
    """Every combination of the choices of some fields of a reading, and of other values."""
    values = {name: CHOICES[name] for name in names} | others
    return [dict(zip(values, each, strict=True)) for each in product(*values.values())]


def followed(
    hypotheses: Sequence[Hypothesis], parameter: str, values: ArrayLike, follow: Callable[[list[Oscillator]], Any]
) -> NDArray[Any]:
    """What `follow` finds along a parameter, shape (hypotheses, values, ...): equally many levels go side by side."""
    levels = [len(hypothesis.wave.levels) for hypothesis in hypotheses]
    found: dict[int, NDArray[Any]] = {}
    for n in set(levels):
        places = [i for i, own in enumerate(levels) if own == n]
        rows = follow([osc for i in places for osc in hypotheses[i].along(parameter, values)])
        found |= zip(places, np.asarray(rows).reshape(len(places), np.size(values), -1), strict=True)
    return np.array([found[i] for i in range(len(hypotheses))])


def drawn_settings(n_discarded: int | None) -> SettleSettings:
    """How a motion settles whose period alone is read off, as its author may have done: without watching it."""
    return PERIODS.having({"n_transient": n_discarded, "max_period": MAX_PERIOD})


@dataclass(frozen=True)
class Protocol:
    """A way to draw a diagram.

    Parameters
    ----------
    seeding : {"up", "down", "restart"}
        State carried with the parameter rising or falling, or every value started from (x, v).
    n_discarded : int or None
        Mesh periods discarded as transient at each value; None waits for each motion to settle, for
        `gearpair.motion.settling.transient_periods` at most. No diagram is watched any longer: a chaotic transient that
        outlasts the wait is drawn as what it looks like.
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
    """One hypothesis drawn by one protocol, and its scores on the two published axes.

    `integrator` is None where the motions were followed by the exact flow.
    """

    hypothesis: Hypothesis
    protocol: Protocol
    integrator: Integrator | None
    frequency: Score
    damping: Score

    @property
    def total(self) -> float:
        """The mean of the two scores: one hypothesis has to explain both tables."""
        return 0.5 * (self.frequency.total + self.damping.total)


def periods(
    hypotheses: Sequence[Hypothesis],
    protocol: Protocol,
    parameter: str,
    n_values: int = 101,
    integrator: Integrator | None = None,
) -> NDArray[np.int64]:
    """The period at each value of a parameter (rising), 0 where none up to 12; shape (hypotheses, n_values).

    With an integrator the period is read off the section as a reader would (`gearpair.methods.section_period`), and
    the protocol needs a number of mesh periods to discard.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> periods([SWAPPED], Protocol("down", None), "damping_ratio", 6)[0, 1:].tolist()
    [1, 1, 1, 1, 1]
    """
    values = axis(parameter, n_values)
    order = slice(None, None, -1) if protocol.seeding == "down" else slice(None)
    chain = 1 if protocol.seeding == "restart" else n_values
    x, v, n_discarded = protocol.x, protocol.v, protocol.n_discarded

    def draw(oscillators: list[Oscillator]) -> ArrayLike:
        if integrator is None:
            starts = np.broadcast_to([x, v], (len(oscillators), 2))
            return settle_batch(oscillators, starts, drawn_settings(n_discarded), chain=chain).period
        n = check_count("n_discarded", n_discarded)
        sections = integrator.sections(oscillators, x, v, n, 2 * MAX_PERIOD, chain=chain)
        return [section_period(section) for section in sections]

    return followed(hypotheses, parameter, values[order], draw)[:, order, 0]


def run_trials(
    hypotheses: Sequence[Hypothesis],
    protocols: Sequence[Protocol],
    n_values: int = 101,
    integrators: Sequence[Integrator | None] = (None,),
) -> list[Trial]:
    """Every hypothesis by every protocol and every integrator, the best first.

    Parameters
    ----------
    n_values : int
        Values on each axis.
    integrators : sequence of Integrator or None
        None is the exact flow; another needs protocols with a number of mesh periods to discard.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> best = run_trials([PRINTED, SWAPPED], [Protocol("down", None)], n_values=26)[0]
    >>> best.hypothesis == SWAPPED
    True
    """
    done = []
    for protocol, integrator in product(protocols, integrators):
        parameters = ("mesh_frequency", "damping_ratio")
        found = {p: periods(hypotheses, protocol, p, n_values, integrator) for p in parameters}
        for i, hypothesis in enumerate(hypotheses):
            scores = [score(p, axis(p, n_values), motions[i]) for p, motions in found.items()]
            done.append(Trial(hypothesis, protocol, integrator, *scores))
    return sorted(done, key=lambda trial: -trial.total)


@dataclass(frozen=True)
class Ranked:
    """One hypothesis among others: the mean of its trials' totals, and the best trial."""

    hypothesis: Hypothesis
    mean: float
    best: Trial


def ranking(done: Iterable[Trial]) -> list[Ranked]:
    """Hypotheses by the mean over their trials, the highest first: one lucky start shall not decide.

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> ranked = ranking(run_trials([PRINTED, SWAPPED], [Protocol("down", None)], 11))
    >>> [entry.hypothesis == SWAPPED for entry in ranked]
    [True, False]
    """
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

    Examples
    --------
    >>> from gearpair.article import PRINTED, SWAPPED
    >>> score_by_choice(ranking(run_trials([PRINTED, SWAPPED], [Protocol("down", None)], 11))).rows[0][:3]
    ('stiff for', '2 - eps', '1')
    """
    rows = []
    for field in fields(Hypothesis):
        for value in dict.fromkeys(getattr(entry.hypothesis, field.name) for entry in ranked):
            places = [i for i, entry in enumerate(ranked) if getattr(entry.hypothesis, field.name) == value]
            mean = float(np.mean([ranked[i].mean for i in places]))
            rows.append([field.name.replace("_", " "), FORCINGS.get(value, value), places[0] + 1, f"{mean:.2f}"])
    return Table(["choice", "value", "best place", "mean score"], rows)


def score_by_start(done: Iterable[Trial]) -> Table:
    """For each start the mean and the best score over all that was drawn from it, the highest mean first.

    Parameters
    ----------
    done : iterable of Trial
        Of `run_trials`.

    Examples
    --------
    >>> from gearpair.article import SWAPPED
    >>> starts = all_protocols(starts=[(0.0, 0.0), (1.0, 0.0)], n_discarded=[None])
    >>> sorted(row[0] for row in score_by_start(run_trials([SWAPPED], starts, 6)).rows)
    ['(0, 0)', '(1, 0)']
    """
    grouped: dict[tuple[float, float], list[float]] = {}
    for trial in done:
        grouped.setdefault((trial.protocol.x, trial.protocol.v), []).append(trial.total)
    ordered = sorted(grouped.items(), key=lambda entry: -float(np.mean(entry[1])))
    rows = [[f"({x:g}, {v:g})", f"{np.mean(totals):.2f}", f"{max(totals):.2f}"] for (x, v), totals in ordered]
    return Table(["start", "mean score", "best score"], rows)
