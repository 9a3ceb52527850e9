"""Pictures of a drive in service show their results' own numbers."""

import numpy as np
import pytest
from matplotlib.collections import QuadMesh
from matplotlib.legend import Legend
from scipy.ndimage import maximum_filter1d

import gearpair as gp
from gearpair import design, plotting
from gearpair.plotting.passages import short_time_levels

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DRIVE = gp.GearDrive.from_pair(
    PAIR, pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=[(1, 4.0, 0.0)], damping_ratio=0.05
).at_phase(np.pi)


@pytest.fixture(scope="module")
def run():
    return design.run_up(DRIVE, 7000.0, 9000.0, 0.3, samples_per_period=32)


def test_a_passage_is_one_line_over_the_speed_and_the_steady_runs_are_behind_it(run):
    chart = design.speed_chart(DRIVE, np.linspace(6500.0, 9500.0, 5), n_starts=0, locate_jumps=False)
    ax = plotting.passage_factor(run, chart)
    up, down, line = ax.lines
    np.testing.assert_array_equal(up.get_ydata(), chart.dynamic_factor.sel(run="up"))
    np.testing.assert_array_equal(down.get_ydata(), chart.dynamic_factor.sel(run="down"))
    np.testing.assert_array_equal(line.get_xdata(), run.speed)
    np.testing.assert_array_equal(line.get_ydata(), maximum_filter1d(run.dynamic_factor.values, 4))
    assert line.get_label() == "run up" and ax.get_xlim() == (6500.0, 9500.0)
    back = plotting.passage_factor(run.isel(cycle=slice(None, None, -1)))
    assert back.lines[0].get_label() == "coast-down"


def test_a_change_of_load_is_drawn_over_time():
    change = design.load_change(DRIVE.at_speed(7000.0), [(0.0, 60.0), (0.01, 120.0)], 0.02)
    ax = plotting.passage_factor(change)
    np.testing.assert_array_equal(ax.lines[0].get_xdata(), change.time)
    assert ax.get_xlabel() == "time (s)"


def test_the_levels_of_a_steady_motion_are_the_lines_of_its_force():
    """At one speed each order is a line of the Fourier series of k f(X), and half orders are empty."""
    at = DRIVE.at_speed(7000.0)
    steady = design.load_change(at, 120.0, 0.2, samples_per_period=64)
    _, frequency, level = short_time_levels(steady, 3)
    middle = level[:, level.shape[1] // 2]
    mesh = 7000.0 / 60.0 * 28
    found = [middle[np.abs(frequency - order * mesh) < 0.2 * mesh].max() for order in (1, 2, 3)]
    lines = np.abs(np.fft.rfft(steady.sample_force.values[-1]))[1:4]
    assert np.diff(found) == pytest.approx(np.diff(20.0 * np.log10(lines)), abs=1.42)  # Hann, between bins
    assert middle[np.abs(frequency - 1.5 * mesh) < 0.2 * mesh].max() < -50.0


def test_an_order_map_has_the_mesh_orders_as_lines_and_names_them(run):
    ax = plotting.order_map(run, n_orders=3)
    mesh = run.speed.values / 60.0 * 28
    for order, line in enumerate(ax.lines, 1):
        np.testing.assert_allclose(line.get_xdata(), run.speed)
        np.testing.assert_allclose(line.get_ydata(), order * mesh / 1000.0, rtol=1e-3)
    assert [text.get_text() for text in ax.texts] == ["1", "2", "3"]
    (image,) = [each for each in ax.collections if isinstance(each, QuadMesh)]
    assert image.get_clim() == (-60.0, 0.0) and image.get_array().max() == 0.0
    with pytest.raises(ValueError, match="run must be a passage that was made with samples_per_period"):
        plotting.order_map(run.drop_vars("sample_force"))
    with pytest.raises(ValueError, match="run must have at least 42 samples_per_period, got 32"):
        plotting.order_map(run, n_orders=20)


def test_a_path_goes_from_the_circle_to_the_square_over_the_basins():
    osc = gp.Oscillator()
    passed = gp.passage([osc] * 30, 1.0, 0.0)
    plane = gp.basins(osc, [-3.0, 0.0, 3.0], [-2.0, 0.0, 2.0])
    ax = plotting.passage_path(passed, plane)
    path, first, last = ax.lines[-3:]
    np.testing.assert_array_equal(np.column_stack(path.get_data()), np.column_stack([passed.x, passed.v]))
    assert (first.get_xdata()[0], last.get_xdata()[0]) == (passed.x[0], passed.x[-1])
    assert ax.get_xlim() == (-4.5, 4.5) and ax.get_xlabel() == plotting.basins(plane).get_xlabel()


def margins(**changed):
    shock = np.array([np.nan, 0.5, 0.1, np.nan])
    columns = {"shock_margin": shock, "dip_back": shock[::-1], "surge_back": 2.0 * shock, "n_motions": [1, 2, 2, 2]}
    found = gp.design.shock_margin(DRIVE, [3000.0, 3100.0, 3200.0, 3300.0], n_phases=1, n_starts=0)
    return found.assign({name: ("speed", np.asarray(values)) for name, values in (columns | changed).items()})


def test_margins_their_ways_back_and_where_no_dip_is_enough():
    found = margins()
    ax = plotting.shock_margins(found)
    drawn = {line.get_label(): line.get_data() for line in ax.lines}
    np.testing.assert_array_equal(drawn["a dip that ends the quieter motion"][1], found.shock_margin)
    np.testing.assert_array_equal(drawn["a dip that brings it back"][1], found.dip_back)
    np.testing.assert_array_equal(drawn["a rise that does"][1], found.surge_back)
    assert drawn["no dip that was tried does"][0].tolist() == [3300.0]
    assert not ax.texts


def test_without_a_second_motion_the_picture_says_so():
    none = np.full(4, np.nan)
    alone = margins(n_motions=[1] * 4, shock_margin=none, dip_back=none, surge_back=none)
    ax = plotting.shock_margins(alone)
    assert [text.get_text() for text in ax.texts] == ["one motion at each of these speeds"]


def test_the_spectra_begin_and_end_where_a_whole_window_has_been_seen(run):
    """So the jolt with which a ramp begins is no streak of the map."""
    times, _, _ = short_time_levels(run, 3)
    whole = float(run.sample_time.values.ravel()[-1])
    half = 0.5 * whole / 40
    assert times[0] >= half and times[-1] <= whole - half and times[-1] - times[0] > whole - 3.0 * half


def test_two_motions_of_one_name_have_two_colours_and_numbers():
    osc = gp.Oscillator()
    plane = gp.basins(osc, [-2.0, 1.0], [0.0, 0.5])
    plane.attractor_period[:], plane.attractor_impact_state[:] = 1, "single_drive"
    ax = plotting.passage_path(gp.passage([osc] * 3, 1.0, 0.0), plane)
    (key,) = [each for each in ax.get_children() if isinstance(each, Legend) and each.get_patches()]
    assert [text.get_text() for text in key.get_texts()] == ["period 1, single-sided, 1", "period 1, single-sided, 2"]
    (image,) = [each for each in ax.collections if isinstance(each, QuadMesh)]
    drawn = {tuple(colour) for colour in image.to_rgba(image.get_array()).reshape(-1, 4).tolist()}
    assert drawn == {patch.get_facecolor() for patch in key.get_patches()} and len(drawn) == 2
