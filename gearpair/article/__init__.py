"""What the published article states, how it can be read, and what chapters compare with it.

A *reading* is one way to understand the article's equation: of its wave alone (`StiffnessWave.rectangular`) or of all
of it (`Hypothesis`). The case about its numbers has a folder of its own, `case`.
"""

from gearpair.article import case, others, published
from gearpair.article.comparison import compare_attractors, compare_boundaries, compare_ranges
from gearpair.article.readings import PRINTED, SWAPPED, Hypothesis
from gearpair.article.wave_shape import SweptWave, sweep_waves

__all__ = [
    "Hypothesis",
    "PRINTED",
    "SWAPPED",
    "SweptWave",
    "case",
    "compare_attractors",
    "compare_boundaries",
    "compare_ranges",
    "others",
    "published",
    "sweep_waves",
]
