"""How the article's equation can be read: a `Hypothesis` is one reading of its physics, the printed one by default."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args, get_type_hints

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_array, check_choice, check_number
from gearpair.article import published
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave

N_LEVELS = 24  # of the staircase that stands for one harmonic
FORCINGS = {0.0: "sin", 90.0: "cos", 180.0: "-sin", 270.0: "-cos"}


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
    damping : {"2 zeta", "zeta", "2 zeta sqrt(mean)"}
        The coefficient of X'. The first is the article's own convention (item M5), the last its zeta taken of the
        critical damping at the mean of the wave that is used, which item M5 says is k_m and the numbers do not make so.
    shape : {"rectangle", "first harmonic"}
        Whether the wave is the rectangle or its mean and first harmonic alone, as a staircase of `N_LEVELS`.

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
    damping: Literal["2 zeta", "zeta", "2 zeta sqrt(mean)"] = "2 zeta"
    shape: Literal["rectangle", "first harmonic"] = "rectangle"

    def __post_init__(self) -> None:
        check_number("phase", self.phase)
        for name, choices in CHOICES.items():
            check_choice(name, getattr(self, name), choices)

    def __str__(self) -> str:
        forcing = FORCINGS.get(self.phase % 360.0, f"sin(. + {self.phase:g} deg)")
        words = (f"stiff for {self.stiff_for}", f"{self.first} first", forcing, self.force)
        shape = () if self.shape == "rectangle" else (self.shape,)
        return ", ".join((*words, f"mean {self.mean}", self.damping, *shape))

    @property
    def wave(self) -> StiffnessWave:
        """The stiffness wave of this reading."""
        base = published.BASELINE
        stiff = base.contact_ratio - 1.0 if self.stiff_for == "eps - 1" else 2.0 - base.contact_ratio
        high, low = 1.0 + base.a, 1.0 - base.b
        mean = stiff * high + (1.0 - stiff) * low if self.mean == "one" else 1.0
        if self.first == "stiff":
            rectangle = StiffnessWave((0.0, stiff), (high / mean, low / mean))
        else:
            rectangle = StiffnessWave((0.0, 1.0 - stiff), (low / mean, high / mean))
        return rectangle if self.shape == "rectangle" else rectangle.truncated(1, N_LEVELS)

    def oscillator(
        self,
        mesh_frequency: float = published.DAMPING_FREQUENCY,
        damping_ratio: float = published.BASELINE.damping_ratio,
    ) -> Oscillator:
        """The article's baseline in this reading."""
        mesh_frequency = check_number("mesh_frequency", mesh_frequency, above=0.0)
        damping_ratio = check_number("damping_ratio", damping_ratio, at_least=0.0)
        base, wave = published.BASELINE, self.wave
        scale = {"2 zeta": 1.0, "zeta": 0.5, "2 zeta sqrt(mean)": float(np.sqrt(wave.mean))}[self.damping]
        return Oscillator(
            mean_force=base.mean_force,
            error_amplitude=base.error_amplitude * (1.0 if self.force == "Omega^2" else mesh_frequency**-2),
            error_phase=base.error_phase + float(np.radians(self.phase)),
            damping_ratio=scale * damping_ratio,
            mesh_frequency=mesh_frequency,
            stiffness=wave,
        )

    def along(self, parameter: str, values: ArrayLike) -> list[Oscillator]:
        """One oscillator per value of a parameter that the article varies."""
        published.ranges(parameter)
        return [self.oscillator(**{parameter: float(value)}) for value in check_array("values", values, ndim=1)]


# What the fields that are words may be.
CHOICES = {name: get_args(hint) for name, hint in get_type_hints(Hypothesis).items() if get_args(hint)}
PRINTED = Hypothesis()
SWAPPED = Hypothesis(stiff_for="2 - eps")
