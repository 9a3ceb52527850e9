"""The sentences on what an integrator draws follow what it drew."""

import numpy as np
import pytest
import xarray as xr

from gearpair.methods import disorder_told, loosest_told
from gearpair.methods.precision import Precision

SPEEDS = [0.7, 0.8, 0.9, 1.0]


def diagram(periods, status="periodic"):
    columns = {"period": ("mesh_frequency", periods), "status": ("mesh_frequency", np.full(len(periods), status))}
    return xr.Dataset(columns, {"mesh_frequency": SPEEDS})


@pytest.mark.parametrize(
    ("drawn", "control", "sentence"),
    [
        ([1, 1, 1, 1], [1, 1, 1, 1], "No motion that is periodic in the end is drawn as disorder."),
        ([0, 0, 1, 1], [0, 0, 1, 1], "is as disordered there: none of it is numerical."),
        ([0, 0, 1, 1], [1, 1, 1, 0], "All of this is numerical"),
        ([0, 0, 0, 0], [0, 1, 1, 1], "At a good part of these frequencies the exact flow"),
        ([0, 0, 0, 0], [0, 1, 1, 1], "At the others, more than half of the axis"),
        ([0, 0, 1, 1], [0, 1, 1, 1], "At the others, less than half of the axis"),
    ],
)
def test_the_blame_follows_the_control(drawn, control, sentence):
    assert sentence in disorder_told(diagram([1, 1, 1, 1]), diagram(drawn), diagram(control))


def test_chaos_in_truth_is_nobodys_fault():
    told = disorder_told(diagram([0] * 4, "aperiodic"), diagram([0] * 4), diagram([0] * 4))
    assert told.startswith("All of the frequencies look disordered, and at all the motion did not settle")
    assert "No motion that is periodic" in told


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (0.05, "more than 0.01, although 0.001 was asked for"),
        (0.005, "more than the 0.001 that was asked for"),
        (1e-4, "less than the 0.001 that was asked for"),
    ],
)
def test_the_loosest_tolerance_is_set_against_what_was_asked_for(error, sentence):
    measured = [
        Precision("RK45", 1e-3, error, 1.0),
        Precision("RK45", 1e-5, 1.0, 1.0),
        Precision("LSODA", 0.1, 1.0, 1.0),
    ]
    assert loosest_told(measured) == sentence
