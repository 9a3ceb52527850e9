"""Nonlinear dynamics of a spur gear pair with backlash and time-varying mesh stiffness."""

from gearpair.stiffness import StiffnessWave

__all__ = ["StiffnessWave"]
