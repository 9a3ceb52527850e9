"""Pictures of a drive over its speeds show their results' own numbers."""

import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot as plt

import gearpair as gp
from gearpair import design, plotting

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
DRIVE = gp.GearDrive.from_pair(
    PAIR, pinion_torque_nm=120.0, pinion_speed_rpm=1e3, backlash_um=100.0, transmission_error_um=4.0, damping_ratio=0.05
)
SPEEDS = np.linspace(6000.0, 9000.0, 21)


@pytest.fixture(scope="module")
def chart():
    return design.speed_chart(DRIVE, SPEEDS, n_starts=2)


def lines(ax, label):
    return [np.array(each.get_data()) for each in ax.lines if each.get_label() == label]


def test_the_chart_draws_each_run_in_pieces_broken_where_it_jumps(chart):
    iso = design.iso_dynamic_factor(DRIVE, SPEEDS, base_pitch_um=8.0, profile_um=8.0)
    ax = plotting.dynamic_factors(chart, iso)
    assert np.allclose(lines(ax, "ISO 6336-1, $K_v$")[0], [SPEEDS, iso.k_v])
    pieces = [np.array(each.get_data()) for each in ax.lines if each.get_label().startswith("_child")]
    drawn = {(float(x), round(float(y), 9)) for piece in pieces for x, y in piece.T}
    runs = {
        (float(x), round(float(y), 9))
        for run in ("up", "down")
        for x, y in zip(SPEEDS, chart.dynamic_factor.sel(run=run).values, strict=True)
    }
    assert drawn == runs
    assert max(np.abs(np.diff(piece[1])).max(initial=0.0) for piece in pieces) < 0.3  # the jumps are twice as high
    words = [text.get_text() for text in ax.texts]
    jumps = chart.jump_speed.values[np.isfinite(chart.jump_speed.values)]
    assert {f"{at:.0f}" for at in jumps} == {word for word in words if word.isdigit()}


def test_a_band_shows_all_phases_and_the_legend_the_worst(chart):
    ax = plotting.dynamic_factors(chart)
    [band] = [each for each in ax.collections if each.get_label().startswith("any phase")]
    drawn = band.get_paths()[0].vertices
    for speed, low, high in zip(SPEEDS, chart.factor_low.values, chart.factor_high.values, strict=True):
        there = drawn[np.isclose(drawn[:, 0], speed), 1]
        assert (there.min(), there.max()) == pytest.approx((low, high))
    assert band.get_label() == f"any phase, worst {np.degrees(chart.attrs['run_phase_rad']):.0f}°"
    known = plotting.dynamic_factors(design.speed_chart(DRIVE.at_phase(0.0), SPEEDS[:3], n_starts=0))
    assert not any(each.get_label().startswith("any phase") for each in known.collections)


def test_the_strips_show_the_impact_state_of_each_run(chart):
    ax = plotting.dynamic_factors(chart)
    colours = [matplotlib.colors.to_hex(patch.get_facecolor()).upper() for patch in ax.patches]
    states = [*chart.impact_state.sel(run="up").values, *chart.impact_state.sel(run="down").values]
    assert colours == [plotting.maps.IMPACT_COLOURS[str(state)] for state in states]


def test_tooth_loads_in_their_units(chart):
    left, right = plotting.tooth_loads(chart, tuple(plt.subplots(1, 2)[1]))
    assert np.allclose(lines(left, "run down")[0][1], chart.dte_rms.sel(run="down"))
    assert np.allclose(lines(right, "run up")[0][1], chart.impact_velocity.sel(run="up"))


def test_a_tornado_has_the_strongest_change_on_top():
    found = design.sensitivity(DRIVE, SPEEDS, {"backlash_um": (50.0, 200.0), "damping_ratio": (0.025, 0.1)})
    ax = plotting.tornado(found)
    assert [label.get_text() for label in ax.get_yticklabels()] == ["backlash (µm)", "damping ratio"]
    ends = sorted(bar.get_x() + bar.get_width() for bar in ax.patches if bar.get_y() > 0.5)
    assert ends == pytest.approx(sorted(found.dynamic_factor.sel(change="damping_ratio").values))
    other = plotting.tornado(found, "time_apart", sort_by="dynamic_factor")
    assert [label.get_text() for label in other.get_yticklabels()] == ["backlash (µm)", "damping ratio"]


def test_a_tornado_s_bars_and_numbers_stay_apart_where_both_ends_lie_on_one_side():
    found = design.sensitivity(DRIVE, SPEEDS, {"damping_ratio": (0.06, 0.1)})
    assert (found.dynamic_factor < found.base_dynamic_factor).all()
    ax = plotting.tornado(found)
    low, high = sorted(ax.patches, key=lambda bar: -bar.get_y())
    assert low.get_y() == pytest.approx(high.get_y() + high.get_height())
    ax.figure.canvas.draw()
    boxes = [text.get_window_extent() for text in ax.texts]
    assert [text.get_text() for text in ax.texts] == ["0.06", "0.1"]
    assert not boxes[0].overlaps(boxes[1])
    assert not any(box.overlaps(bar.get_window_extent()) for box in boxes for bar in ax.patches)


def test_rattle_begins_at_the_line():
    found = design.idle_rattle(
        DRIVE, np.linspace(300.0, 1500.0, 21), order=2.0, pinion_swing_deg=0.05, drag_torque_nm=0.4
    )
    ax = plotting.rattle(found)
    onset = ax.lines[1].get_xdata()[0]
    speed, velocity = ax.lines[0].get_data()
    assert np.all(velocity[speed < onset * 0.98] == 0.0) and np.all(velocity[speed > onset * 1.02] > 0.0)


def test_the_standard_s_factor_has_room_where_it_is_the_larger(chart):
    iso = design.iso_dynamic_factor(DRIVE, SPEEDS, base_pitch_um=80.0, profile_um=80.0)
    assert iso.k_v.max() > chart.factor_high.max()
    assert plotting.dynamic_factors(chart, iso).get_ylim()[1] > iso.k_v.max()


def test_a_map_of_loads_outlines_where_contact_is_lost(chart):
    found = design.load_map(DRIVE, [60.0, 120.0, 240.0], SPEEDS, n_starts=2, n_phases=2, locate_jumps=False)
    found.loss[2, :3] = ""
    found.loss[0, 4] = "strike on both flanks"
    found.loss[1, 5] = "part after a shock alone, not when run up or down"
    ax = plotting.load_map(found)
    (image,) = [each for each in ax.collections if isinstance(each, matplotlib.collections.QuadMesh)]
    assert np.array_equal(image.get_array(), found.dynamic_factor)
    outlines = {each.get_label(): each.get_segments() for each in ax.collections if each is not image}
    step = SPEEDS[1] - SPEEDS[0]
    ends = np.array(outlines["both flanks are struck"])[:, :, 0]  # three sides, for the fourth is the map's edge
    assert len(ends) == 3 and np.allclose(np.abs(ends - SPEEDS[4]), step / 2)
    kept = np.argwhere(found.loss.values == "")
    assert len(kept) and all(len(side) == 2 for side in outlines["the teeth may part"])
    dots = {(float(x), float(y)) for line in ax.lines for x, y in zip(*line.get_data(), strict=True)}
    assert (SPEEDS[5], 120.0) in dots and (SPEEDS[4], 60.0) not in dots


def test_outlines_are_the_sides_between_inside_and_outside():
    inside = np.array([[True, False, False], [True, True, False]])
    sides = plotting.speed_chart._borders(inside, np.array([1.0, 2.0, 3.0]), np.array([10.0, 20.0]))
    assert sides == [[(1.5, 5.0), (1.5, 15.0)], [(2.5, 15.0), (2.5, 25.0)], [(1.5, 15.0), (2.5, 15.0)]]


def test_a_time_apart_of_a_rounding_has_no_bar():
    quiet = DRIVE.replace(damping_ratio=0.5, pinion_torque_nm=400.0)
    found = design.sensitivity(quiet, SPEEDS[::10], {"damping_ratio": (0.4, 1.0)})
    found.time_apart[:] = 1e-15
    assert {bar.get_width() for bar in plotting.tornado(found, "time_apart").patches} == {0.0}


def test_a_small_jump_breaks_its_line_and_has_an_arrow_where_it_is_located(chart):
    small = chart.copy(deep=True)
    small.jump_speed[:] = np.nan
    small.dynamic_factor[:] = np.where(SPEEDS[-2] > SPEEDS, 2.0, 2.4)  # a step of a sixth
    small.impact_state[:] = "none_drive"

    def drawn():
        ax = plotting.dynamic_factors(small)
        pieces = [each for each in ax.lines if each.get_label().startswith("_child")]
        arrows = [text for text in ax.texts if getattr(text, "arrow_patch", None) is not None]
        return len(pieces), len(arrows), [text.get_text() for text in ax.texts if text.get_text().isdigit()]

    assert drawn() == (2, 0, [])
    small.jump_speed.loc[{"run": "up", "speed": SPEEDS[-2]}] = SPEEDS[-2] - 20.0
    assert drawn() == (3, 1, [])
    small.jump_speed.loc[{"run": "down", "speed": SPEEDS[-3]}] = SPEEDS[-3] + 20.0
    assert drawn() == (4, 2, [f"{SPEEDS[-3] + 20.0:.0f}"])
