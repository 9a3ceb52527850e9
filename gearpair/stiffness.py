"""The mesh stiffness as a function of time: any periodic staircase."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Self, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_array, check_choice, check_class, check_count, check_number, plain

Reading = Literal["printed", "swapped"]
READINGS = get_args(Reading)


@dataclass(frozen=True)
class Rectangle:
    """The article's description of a two-level wave: what `StiffnessWave.rectangular` was given."""

    contact_ratio: float
    a: float
    b: float
    reading: Reading


@dataclass(frozen=True)
class StiffnessWave:
    """A periodic staircase: the mesh stiffness divided by its reference k_m.

    Parameters
    ----------
    edges : sequence of float, shape (n,)
        Fractions of the mesh period where each level starts: ``edges[0] == 0``, strictly
        increasing, below 1.
    levels : sequence of float, shape (n,)
        Dimensionless stiffness from each edge to the next, positive.
    rectangle : Rectangle, optional
        Set by `rectangular`: the contact ratio, a and b that the two levels came from.

    Examples
    --------
    >>> wave = StiffnessWave(edges=(0.0, 0.25), levels=(2.0, 1.0))
    >>> wave.mean
    1.25
    >>> wave(np.array([0.0, 0.3, 1.1]))
    array([2., 1., 2.])
    """

    edges: tuple[float, ...]
    levels: tuple[float, ...]
    rectangle: Rectangle | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        edges, levels = _numbers("edges", self.edges), _numbers("levels", self.levels)
        if self.rectangle is not None:
            check_class("rectangle", self.rectangle, Rectangle)
        object.__setattr__(self, "edges", edges)
        object.__setattr__(self, "levels", levels)
        if len(edges) == 0 or len(edges) != len(levels):
            raise ValueError(
                "edges and levels must have the same length, at least 1; "
                f"got {len(edges)} edges and {len(levels)} levels"
            )
        if edges[0] != 0.0:
            raise ValueError(f"edges[0] must be 0 (the start of the mesh period), got {edges[0]}")
        for i, (left, right) in enumerate(zip(edges, (*edges[1:], 1.0), strict=True)):
            if not left < right:
                raise ValueError(
                    f"edges must increase strictly and stay below 1; got edges[{i}] = {left} followed by {right}"
                )
        for i, level in enumerate(levels):
            check_number(f"levels[{i}]", level, above=0.0)

    @classmethod
    def rectangular(
        cls,
        contact_ratio: float = 1.68,
        a: float = 0.116,
        b: float = 0.414,
        reading: Reading = "printed",
    ) -> Self:
        """The article's rectangle: two pairs in contact, then one.

        Parameters
        ----------
        contact_ratio : float
            epsilon, in (1, 2).
        a : float
            Stiffness added in double contact, relative to k_m; above -1.
        b : float
            Stiffness missing in single contact, relative to k_m; below 1.
        reading : {"printed", "swapped"}
            ``"printed"``: 1 + a on the first (epsilon - 1) of the period, 1 - b on the rest.
            ``"swapped"``: 1 + a on the first (2 - epsilon) of the period, 1 - b on the rest.

        Returns
        -------
        StiffnessWave
            With `rectangle` set, so that `contact_ratio`, `a` and `b` can be swept.

        Notes
        -----
        The article, item K2. The mean is ``1 + a (eps - 1) - b (2 - eps)`` as printed, which the
        article's own numbers do not make 1.

        Examples
        --------
        >>> StiffnessWave.rectangular().levels
        (1.116, 0.5860000000000001)
        >>> round(StiffnessWave.rectangular().mean, 5)
        0.9464
        """
        contact_ratio = check_number("contact_ratio", contact_ratio, above=1.0, below=2.0)
        a = check_number("a", a, above=-1.0)
        b = check_number("b", b, below=1.0)
        check_choice("reading", reading, READINGS)
        stiff = contact_ratio - 1.0 if reading == "printed" else 2.0 - contact_ratio
        return cls((0.0, stiff), (1.0 + a, 1.0 - b), Rectangle(contact_ratio, a, b, reading))

    @property
    def durations(self) -> NDArray[np.float64]:
        """Fractions of the mesh period that each level lasts, shape (n,); they sum to 1."""
        return np.diff([*self.edges, 1.0])

    @property
    def mean(self) -> float:
        """Mean over one mesh period, relative to k_m (dimensionless)."""
        return float(self.durations @ np.asarray(self.levels))

    def __call__(self, fraction: ArrayLike) -> Any:
        """Stiffness at a time given in mesh periods: an array for an array of any shape, a float for a number."""
        phase = np.mod(check_array("fraction", fraction), 1.0)
        return plain(np.asarray(self.levels)[np.searchsorted(self.edges, phase, side="right") - 1])

    def harmonics(self, n: int) -> NDArray[np.complex128]:
        """Fourier coefficients c_0 .. c_n with ``k = sum of c_m exp(2 pi i m t / T)`` over all integers m.

        Parameters
        ----------
        n : int
            Highest harmonic of the mesh frequency, at least 0.

        Returns
        -------
        ndarray of complex, shape (n + 1,)
            Dimensionless; c_0 is the mean, and the amplitude of harmonic m is ``2 |c_m|``.

        Examples
        --------
        >>> np.round(2 * np.abs(StiffnessWave.rectangular().harmonics(2)[1:]), 4)
        array([0.2849, 0.1526])
        """
        n = check_count("n", n, at_least=0)
        m = np.arange(1, n + 1)[:, None]
        ends = np.array([*self.edges, 1.0])
        turns = np.exp(-2j * np.pi * m * ends)
        steps = (turns[:, :-1] - turns[:, 1:]) / (2j * np.pi * m)
        return np.concatenate([[self.mean], steps @ np.asarray(self.levels)])

    def truncated(self, n_harmonics: int, n_levels: int = 40) -> Self:
        """The mean and the first few harmonics of this wave alone, as a staircase of equal steps.

        Parameters
        ----------
        n_harmonics : int
            Highest harmonic kept, at least 0; 1 gives the sinusoid of the same mean and first harmonic.
        n_levels : int
            Levels of the staircase, at least ``2 n_harmonics + 1``.

        Returns
        -------
        StiffnessWave
            Each level is the mean of the truncated Fourier series over its step, so the mean is kept exactly.

        Raises
        ------
        ValueError
            For too few levels, or where the series is not positive (one harmonic alone can exceed the mean).

        Examples
        --------
        >>> sinusoid = StiffnessWave.rectangular().truncated(1)
        >>> round(sinusoid.mean, 4), np.round(2 * np.abs(sinusoid.harmonics(2)[1:]), 3).tolist()
        (0.9464, [0.284, 0.0])
        """
        n_harmonics = check_count("n_harmonics", n_harmonics, at_least=0)
        n_levels = check_count("n_levels", n_levels, at_least=2 * n_harmonics + 1)
        m = np.arange(1, n_harmonics + 1)
        middles = (np.arange(n_levels) + 0.5) / n_levels
        kept = self.harmonics(n_harmonics)[1:] * np.sinc(m / n_levels)
        levels = self.mean + 2.0 * (np.exp(2j * np.pi * np.outer(middles, m)) @ kept).real
        return type(self)(tuple(np.arange(n_levels) / n_levels), tuple(levels))


def _numbers(name: str, values: Sequence[float]) -> tuple[float, ...]:
    array = check_array(name, values, finite=False)
    if array.ndim != 1:
        raise ValueError(f"{name} must be a sequence of numbers (one dimension), got shape {array.shape}")
    return tuple(check_number(f"{name}[{i}]", value) for i, value in enumerate(array.tolist()))
