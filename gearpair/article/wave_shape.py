"""Rectangle or sinusoid: which of the two finds the motions of the computed stiffness curve (items K5 and C4)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_array, checked
from gearpair._equality import equal_by_value
from gearpair.ensembles.sweeps import sweep
from gearpair.motion.names import motions_of
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave

if TYPE_CHECKING:
    import xarray as xr


@equal_by_value
@dataclass(frozen=True)
class SweptWave:
    """An oscillator with one stiffness wave, and its carried sweeps in mesh frequency, both by rising frequency."""

    oscillator: Oscillator
    up: xr.Dataset
    down: xr.Dataset

    @checked
    def share_met(self, reference: SweptWave) -> float:
        """The share of the frequencies at which some motion is met with both waves, counting both sweeps of each."""
        met = [
            [set(pair) for pair in zip(motions_of(wave.up), motions_of(wave.down), strict=True)]
            for wave in (self, reference)
        ]
        return float(np.mean([bool(one & other) for one, other in zip(*met, strict=True)]))


@checked
def sweep_waves(osc: Oscillator, waves: Mapping[str, StiffnessWave], frequencies: ArrayLike) -> dict[str, SweptWave]:
    """Carried sweeps up and down with each of several stiffness waves.

    Parameters
    ----------
    osc : Oscillator
        Its own stiffness is replaced.
    waves : mapping of str to StiffnessWave
    frequencies : array_like of float, shape (n,)
        Mesh frequencies, rising.

    Examples
    --------
    >>> waves = {"rectangle": StiffnessWave.rectangular(), "flat": StiffnessWave((0.0,), (1.0,))}
    >>> swept = sweep_waves(Oscillator(), waves, [1.6, 1.65, 1.7])
    >>> swept["flat"].share_met(swept["rectangle"])
    0.0
    """
    values = check_array("frequencies", frequencies, ndim=1)
    swept = {}
    for name, wave in waves.items():
        own = osc.replace(mesh_frequency=float(values[0]), stiffness=wave)
        up = sweep(own, "mesh_frequency", values)
        down = sweep(own, "mesh_frequency", values[::-1]).sortby("mesh_frequency")
        swept[name] = SweptWave(own, up, down)
    return swept
