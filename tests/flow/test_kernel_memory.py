"""Kernels that count no references (see `gearpair._flow._kernel`) neither lose memory nor keep what they are handed."""

import sys

import numpy as np
import pytest
from numba.core.runtime import _nrt_python, rtsys

import gearpair as gp


@pytest.fixture(autouse=True, scope="module")
def counted():
    """Compiled code counts the memory that it makes."""
    _nrt_python.memsys_enable_stats()
    yield
    _nrt_python.memsys_disable_stats()


def held():
    """Pieces of memory that compiled code has made and not given back."""
    made = rtsys.get_allocation_stats()
    return made.alloc - made.free


def branch(osc):
    x, v = gp.stroboscopic_map(osc, 1.0, 0.0, 400)
    return gp.continue_orbit(gp.periodic_orbit(osc, x, v, 1), "damping_ratio", 0.09, 0.11)


WORK = {
    "a walk": lambda osc: gp.stroboscopic_map(osc, [0.3, 2.0], [0.0, 0.1], 5),
    "a trajectory": lambda osc: gp.trajectory(osc, 0.3, 0.0, 4),
    "a settled motion": lambda osc: gp.steady_state(osc),
    "a plane of starts": lambda osc: gp.basins(osc, np.linspace(-3.0, 3.0, 8), [-1.0, 0.0, 1.0]),
    "a watch": lambda osc: gp.survival(osc, [0.3, 2.0], 0.0, n_periods=600),
    "a sweep": lambda osc: gp.sweep(osc, "mesh_frequency", [0.7, 0.8]),
    "an orbit": lambda osc: gp.periodic_orbit(osc, 1.0, 0.0, 2),
    "a branch": branch,
}


@pytest.mark.parametrize("work", WORK.values(), ids=WORK)
@pytest.mark.parametrize("harmonics", [(), ((2, 0.05, 0.3),)])
def test_what_a_kernel_makes_it_gives_back(work, harmonics):
    osc = gp.Oscillator(harmonics=harmonics, damping_ratio=0.1)
    work(osc)  # the oscillator's cells are made and kept
    before = held()
    for _ in range(5):
        work(osc)
    assert held() == before


def test_what_a_kernel_is_handed_is_not_kept():
    osc = gp.Oscillator()
    arrays = [value for value in osc.cells if isinstance(value, np.ndarray)]
    before = [sys.getrefcount(value) for value in arrays]
    for _ in range(20):
        gp.stroboscopic_map(osc, 0.3, 0.0, 3)
        gp.steady_state(osc)
    assert [sys.getrefcount(value) for value in arrays] == before
