"""The chaotic saddle behind a transient: where the motions are that neither have just come nor are about to leave."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearpair._checks import check_count, checked
from gearpair._flow.walk import OK
from gearpair.ensembles.datasets import dataset
from gearpair.ensembles.lifetimes import watched_starts
from gearpair.motion.settling import transient_periods
from gearpair.motion.trajectories import check_pairs, raise_if_capped, walked
from gearpair.oscillator import Oscillator
from gearpair.quantities import attributes

if TYPE_CHECKING:
    import xarray as xr


@checked
def chaotic_saddle(
    osc: Oscillator,
    x: ArrayLike,
    v: ArrayLike,
    *,
    n_periods: int = 5000,
    n_before: int = 50,
    n_after: int | None = None,
    n_points: int = 20_000,
    progress: bool = False,
) -> xr.Dataset:
    """Section points near the chaotic saddle that starts pass on their way to an attractor.

    Parameters
    ----------
    osc : Oscillator
    x, v : array_like of float
        X and X' at the start of a mesh period; broadcast against each other. The more, the more points.
    n_periods : int
        Mesh periods that each start is watched for, unless it is captured before; rounded up to whole base periods, as
        are the other two.
    n_before : int
        Mesh periods that a motion gets to come near the saddle, along its stable manifold.
    n_after : int, optional
        Mesh periods that it must have left until it is captured or the watch ends: the last ones lead away along the
        unstable manifold, and to the attractor. `gearpair.motion.transient_periods` when not given; less than the mean
        life of the transient leaves more points.
    n_points : int
        Points kept at most, spread evenly over all that were found.
    progress : bool
        Show progress bars on stderr, as `gearpair.survival`.

    Returns
    -------
    xarray.Dataset
        Over ``point``: ``x`` and ``v`` on the section, by start and time. Attributes: ``n_starts`` that were watched,
        ``n_used``, those that lasted for ``n_before + n_after``, and ``n_lasting`` of them that were not captured at
        all.

    Raises
    ------
    RuntimeError
        Where the walk is capped; the message says what to do.

    Notes
    -----
    The sprinkler method (Hsu, Ott and Grebogi, 1988; Kantz and Grassberger, 1985): of many starts, those that are still
    on their way after ``n_before + n_after`` are, in between, near the set that no motion leaves, forward or backward.
    Here each motion gives all its points in between, not one. They are the nearer to the saddle the larger both are. An
    empty result says that no start lasted: raise the number of starts, or lower `n_after`.

    Where no motion leaves, the set is an attractor as far as it was watched, and these are points of it: compare
    ``n_lasting`` with ``n_used``, and see `gearpair.survival`.

    Examples
    --------
    >>> found = chaotic_saddle(Oscillator(mesh_frequency=1.09), [-1.0, 0.0, 1.0, 2.0], -1.0)
    >>> found.attrs["n_starts"], found.sizes["point"] > 100
    (4, True)
    """
    starts = check_pairs(x, v)
    n_periods, n_points = check_count("n_periods", n_periods), check_count("n_points", n_points)
    n_before = check_count("n_before", n_before, at_least=0)
    n_after = transient_periods(osc) if n_after is None else check_count("n_after", n_after, at_least=0)
    if n_before + n_after > n_periods:
        raise ValueError(f"n_periods must be at least n_before + n_after = {n_before + n_after}, got {n_periods}")
    _known, watched, _later = watched_starts(osc, starts, n_periods, progress=progress)
    raise_if_capped(watched.status, starts)
    before = osc.base_periods(n_before)
    last = watched.periods // osc.mesh_periods - osc.base_periods(n_after)  # the last base period of each that counts
    used = last >= before
    points = _points_between(osc, starts[used], before, last[used], n_points)
    lasting = (watched.owner < 0) & (watched.status == OK)
    facts = {"n_starts": len(starts), "n_used": int(used.sum()), "n_lasting": int((used & lasting).sum())}
    variables = {name: ("point", points[:, i], attributes(name)) for i, name in enumerate(("x", "v"))}
    return dataset(osc, variables, {}, n_periods=n_periods, n_before=n_before, n_after=n_after, **facts)


def _points_between(
    osc: Oscillator, starts: NDArray[np.float64], first: int, last: NDArray[np.int64], n_points: int
) -> NDArray[np.float64]:
    """The section points of motions from base period `first` to each one's `last`, thinned out; shape (n, 2)."""
    total = int((last - first + 1).sum())
    step = max(1, -(-total // n_points))
    found: list[NDArray[np.float64]] = []
    owners: list[NDArray[np.int64]] = []
    here, _ = walked(osc.cells, starts, first)
    for done in range(first, int(last.max(initial=first - 1)) + 1, step):
        there = np.flatnonzero(last >= done)
        found.append(here[there])
        owners.append(there)
        here, _ = walked(osc.cells, here, step)
    if not found:
        return np.empty((0, 2))
    order = np.argsort(np.concatenate(owners), kind="stable")
    return np.concatenate(found)[order]
