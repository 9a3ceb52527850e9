"""A drive that hardly turns: what was disturbed dies out below the smallest number, without a word of warning."""

import warnings

import numpy as np

import gearpair as gp
from gearpair.design import speed_chart


def test_a_chart_at_five_turns_a_minute_warns_of_nothing():
    drive = gp.GearDrive.from_pair(
        gp.SpurPair(),
        pinion_speed_rpm=5.0,
        pinion_torque_nm=120.0,
        backlash_um=100.0,
        transmission_error_um=4.0,
        damping_ratio=0.08,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        chart = speed_chart(drive, [4.0, 5.0], n_starts=1, n_transient=20)
    assert np.all(chart.motion == "period 1")
    assert np.all(chart.impact_rate == 0.0)
