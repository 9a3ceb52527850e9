"""The section seen from elsewhere: the period map backward, and the section at another phase of the mesh."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_number, checked
from gearpair._flow.cells import Cells, build_cells
from gearpair._flow.closed_form import PHASE
from gearpair._flow.walk import OK
from gearpair.harmonics import Harmonic
from gearpair.motion.trajectories import mapped, walked
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave


class PeriodMap(NamedTuple):
    """The map over base periods, forward or backward in time."""

    cells: Cells
    way: float  # 1 forward, -1 backward

    def __call__(self, points: NDArray[np.float64], n: int) -> NDArray[np.float64]:
        """The states `n` base periods from `points` (m, 2) on; nan where the motion cannot be followed."""
        ends, status = self.followed(points, n)
        ends[status != OK] = np.nan
        return ends

    def followed(self, points: NDArray[np.float64], n: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """The same with the status of each walk; where that is not OK, the state reached."""
        ends, status = walked(self.cells, points * (1.0, self.way), n)
        return ends * (1.0, self.way), status


def forward(osc: Oscillator) -> PeriodMap:
    """The period map of `osc`."""
    return PeriodMap(osc.cells, 1.0)


def backward(osc: Oscillator) -> PeriodMap:
    """Its inverse: the period map of the oscillator that time runs backward for, which gains what damping takes."""
    p = osc.coefficients
    harmonics = p.harmonics.copy()
    harmonics[:, PHASE] = np.pi - harmonics[:, PHASE]
    reverse = p._replace(
        error_phase=np.pi - p.error_phase,
        damping_ratio=-p.damping_ratio,
        flight_damping=-p.flight_damping,
        edges=np.ascontiguousarray(1.0 - p.edges[::-1]),
        levels=np.ascontiguousarray(p.levels[::-1]),
        harmonics=harmonics,
    )
    return PeriodMap(build_cells(reverse), -1.0)


@checked
def backward_map(osc: Oscillator, x: ArrayLike, v: ArrayLike, n: int = 1) -> tuple[Any, Any]:
    """The state `n` base periods before (x, v) on the section: the inverse of `gearpair.stroboscopic_map`.

    Parameters
    ----------
    osc : Oscillator
    x, v : array_like of float
        X and X' at the start of a base period; broadcast against each other.
    n : int
        Base periods, at least 0.

    Returns
    -------
    x, v : ndarray of float, or float
        The broadcast shape; of two numbers, two floats. Backward in time most motions grow; one beyond all bounds
        comes back as +-inf.

    Raises
    ------
    RuntimeError
        Where the walk is capped; the message says what to do.

    Notes
    -----
    ``Y(tau) = X(-tau)`` obeys the same equation with zeta negative, the stiffness wave turned round and each phase phi
    of the transmission error replaced by pi - phi. So the exact flow takes it, with the same certified events, and the
    map backward is exact to rounding, which grows as much as neighbours part: areas by ``exp(2 zeta T)`` a period. So
    with another zeta in free flight, which then is negative too; for areas, the mean over time counts.

    Examples
    --------
    >>> import gearpair as gp
    >>> osc = gp.Oscillator()
    >>> back = backward_map(osc, *gp.stroboscopic_map(osc, 0.3, -1.2))
    >>> bool(np.allclose(back, (0.3, -1.2), rtol=0.0, atol=1e-13))
    True
    """
    return mapped(backward(osc).followed, x, v, n)


@checked
def at_phase(osc: Oscillator, phase: float) -> Oscillator:
    """The same gear pair with its section at another phase of the mesh: its ``tau`` begins there.

    Parameters
    ----------
    osc : Oscillator
    phase : float
        In mesh periods from the section of `osc` on, from 0 to below 1; with `shaft_orders` to below as many as the
        base period has.

    Examples
    --------
    >>> import gearpair as gp
    >>> [round(edge, 2) for edge in at_phase(gp.Oscillator(), 0.5).stiffness.edges]  # 0.68, and the old section
    [0.0, 0.18, 0.5]
    """
    turned = check_number("phase", phase, at_least=0.0, below=float(osc.mesh_periods))
    phase = turned % 1.0
    edges, levels = osc.stiffness.edges, osc.stiffness.levels
    k = int(np.searchsorted(edges, phase, side="right")) - 1
    starts = [0.0, *(edge - phase for edge in edges[k + 1 :]), *(1.0 - phase + edge for edge in edges[: k + 1])]
    # Where the section is at an edge, the last piece is of no length.
    pieces = [(e, level) for e, level in zip(starts, (*levels[k:], *levels[: k + 1]), strict=True) if e < 1.0]
    angle = 2.0 * np.pi * phase
    return Oscillator(
        mean_force=osc.mean_force,
        error_amplitude=osc.error_amplitude,
        error_phase=osc.error_phase + angle,
        damping_ratio=osc.damping_ratio,
        flight_damping=osc.flight_damping,
        mesh_frequency=osc.mesh_frequency,
        stiffness=StiffnessWave(tuple(e for e, _ in pieces), tuple(level for _, level in pieces)),
        harmonics=tuple(Harmonic(h.order, h.amplitude, h.phase + h.order * angle) for h in osc.harmonics),
        shaft_orders=tuple(
            each._replace(phase=each.phase + 2.0 * np.pi * each.order * turned / each.teeth)
            for each in osc.shaft_orders
        ),
    )
