"""Other ways to the same motion, what they cost, and the certificates of the exact one taken apart."""

from gearpair.methods.certificates import CertifiedStep, Segment, segments, telling_segments
from gearpair.methods.precision import Precision, impact_time_error, numerical_chaos, plain_sweep, recut, work_precision
from gearpair.methods.runge_kutta import Integrator, apparent_period, runge_kutta_section, runge_kutta_sweep
from gearpair.methods.solvers import integrated_trajectory

__all__ = [
    "CertifiedStep",
    "Integrator",
    "Precision",
    "Segment",
    "apparent_period",
    "impact_time_error",
    "integrated_trajectory",
    "numerical_chaos",
    "plain_sweep",
    "recut",
    "runge_kutta_section",
    "runge_kutta_sweep",
    "segments",
    "telling_segments",
    "work_precision",
]
