"""Other ways to the same motion, what they cost, and the certificates of the exact one taken apart."""

from gearpair.methods.certificates import (
    CertifiedStep,
    Segment,
    certificate_examples,
    certificate_table,
    segments,
    series_table,
)
from gearpair.methods.precision import (
    Precision,
    coarse_share,
    disorder_table,
    disorder_told,
    impact_time_error,
    loosest_told,
    numerical_chaos,
    plain_sweep,
    split_levels,
    work_precision,
)
from gearpair.methods.runge_kutta import (
    DiagramOptions,
    Integrator,
    runge_kutta_section,
    runge_kutta_sweep,
    section_period,
)
from gearpair.methods.solvers import integrated_trajectory

__all__ = [
    "CertifiedStep",
    "DiagramOptions",
    "Integrator",
    "Precision",
    "Segment",
    "certificate_examples",
    "certificate_table",
    "coarse_share",
    "disorder_table",
    "disorder_told",
    "impact_time_error",
    "integrated_trajectory",
    "loosest_told",
    "numerical_chaos",
    "plain_sweep",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "section_period",
    "segments",
    "series_table",
    "split_levels",
    "work_precision",
]
