"""Ranges of stability of a branch."""

from dataclasses import replace

import numpy as np
import pytest

import gearpair as gp
from gearpair.motion import periodic


@pytest.fixture(scope="module")
def doubled():
    """The period-4 branch that leaves period 2 at its flip near 0.766, continued back to it."""
    two = gp.continue_orbit(gp.periodic_orbit(gp.Oscillator(), 0.34629, -0.25625, 2), "mesh_frequency", 0.69, 0.78)
    (flip,) = (b for b in two.bifurcations if b.kind == "flip")
    state = gp.steady_state(gp.Oscillator(mesh_frequency=0.78))
    orbit = gp.periodic_orbit(state.oscillator, *map(float, state.points[0]), 4)
    return gp.continue_orbit(orbit, "mesh_frequency", 0.75, 0.79), flip.value


def test_a_branch_is_stable_to_the_flip_that_it_grows_from(doubled):
    """Whether rounding puts the multiplier 1 of the orbit in the flip inside the unit circle does not matter."""
    branch, flip = doubled
    at_flip = int(np.argmin(branch.values))
    assert branch.values[at_flip] == pytest.approx(flip, abs=1e-7)
    for inside in (True, False):
        stable = branch.stable.copy()
        stable[at_flip] = inside
        (run,) = gp.bifurcations.stable_ranges([replace(branch, stable=stable)])
        assert run.motion == periodic(4)
        assert run.lower == pytest.approx(flip, abs=1e-7)
        assert run.upper == 0.79
