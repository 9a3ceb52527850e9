"""Other ways to the same motion, what they cost, and the certificates of the exact one taken apart."""

from gearpair.methods.certificates import CertifiedStep, Segment, certificate_examples, segments
from gearpair.methods.precision import (
    Precision,
    impact_time_error,
    numerical_chaos,
    plain_sweep,
    split_levels,
    work_precision,
)
from gearpair.methods.runge_kutta import Integrator, runge_kutta_section, runge_kutta_sweep, section_period
from gearpair.methods.solvers import integrated_trajectory

__all__ = [
    "CertifiedStep",
    "Integrator",
    "Precision",
    "Segment",
    "certificate_examples",
    "impact_time_error",
    "integrated_trajectory",
    "numerical_chaos",
    "plain_sweep",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "section_period",
    "segments",
    "split_levels",
    "work_precision",
]
