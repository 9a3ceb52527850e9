"""Pictures of teeth and of the mesh stiffness show their results' own numbers."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from gearpair import mesh_stiffness, plotting
from gearpair.article import published
from gearpair.teeth import loaded_mesh, tip_relief
from gearpair.teeth.finite_elements import MEASURES, finite_element_bodies
from gearpair.teeth.spurpair import SpurPair

THREE_PAIRS = SpurPair(pinion_teeth=40, gear_teeth=60, addendum=1.3, clearance=0.2, tip_radius=0.1)


@pytest.fixture(scope="module")
def mesh():
    return mesh_stiffness(SpurPair(gear_teeth=54), n_phases=200)


def line(ax, label):
    (found,) = [each for each in ax.lines if each.get_label() == label]
    return np.array(found.get_data())


def test_a_tooth_is_drawn_from_its_root_circle_to_its_tip_circle():
    gear = SpurPair().pinion
    ax = plotting.tooth_outlines(gear)
    for name, foot in (
        ("fillet cut by the rack", gear.root_circle_mm),
        ("straight lines to the root circle", gear.root_circle_mm),
        ("clamped at the base circle", gear.base_radius_mm),
    ):
        h, y = line(ax, name)
        radius = np.hypot(h, y) * gear.module_mm
        assert radius[[0, -1]] == pytest.approx(foot, rel=1e-12)
        assert radius.max() == pytest.approx(gear.tip_circle_mm, rel=1e-12)
        assert h == pytest.approx(-h[::-1], abs=1e-12)  # both flanks
    # what the rack leaves is widest at the foot
    assert np.ptp(line(ax, "fillet cut by the rack")[0]) > 1.3 * np.ptp(line(ax, "clamped at the base circle")[0])


def test_the_stack_ends_at_the_compliance_of_the_pair(mesh):
    ax = plotting.compliance_stack(mesh)
    assert len(ax.collections) == len(mesh.compliance_m_per_n) == 9
    top = max(path.vertices[:, 1].max() for band in ax.collections for path in band.get_paths())
    width_mm, micrometres = mesh.pair.face_width_mm, 1e6
    assert top == pytest.approx((micrometres * width_mm / mesh.pair_stiffness_n_per_m).max(), rel=1e-12)


def test_rigid_bodies_are_no_part_of_the_stack():
    ax = plotting.compliance_stack(mesh_stiffness(SpurPair(), foundation=False, n_phases=50))
    assert {text.get_text() for text in ax.get_legend().get_texts()} == {
        "hertz", *(f"{who}, {part}" for who in ("pinion", "gear") for part in ("bending", "shear", "axial"))
    }  # fmt: skip


def test_stiffness_is_per_width_and_micrometre(mesh):
    _, values = np.array(plotting.pair_stiffness(mesh, label="pair").lines[0].get_data())
    assert values == pytest.approx(mesh.pair_stiffness_n_per_m / 20.0 * 1e-6, rel=1e-12)
    assert plotting.per_width(mesh) == pytest.approx(1e-6 / 20.0)


@pytest.mark.parametrize("pair", [SpurPair(gear_teeth=54), THREE_PAIRS], ids=["two pairs", "three pairs"])
def test_mesh_curves_break_where_the_number_of_pairs_changes(pair):
    result = mesh_stiffness(pair, n_phases=200)
    ax = plotting.mesh_curves({"curve": result}, two_levels=True)
    time, values = line(ax, "curve")
    drawn = np.isfinite(values)
    assert (~drawn).sum() == 3  # down, up, down in two periods
    assert values[drawn] == pytest.approx(np.tile(result.stiffness_n_per_m, 2) * plotting.per_width(result), rel=1e-12)
    (levels,) = ax.patches
    ends = np.array(levels.get_data().values) / plotting.per_width(result)
    assert ends == pytest.approx(np.tile(result.zone_means, 2), rel=1e-12)


def test_a_pair_enters_with_a_share_carries_all_and_leaves(mesh):
    ax = plotting.load_shares({"summed": mesh})
    time, share = line(ax, "summed")
    assert (np.diff(time) > 0).all() and time[-1] < mesh.contact_ratio
    alone = (time >= mesh.contact_ratio - 1) & (time < 1)
    assert share[alone] == pytest.approx(1.0, rel=1e-12)
    assert (share[~alone] < 0.65).all()


def test_a_mesh_under_load_is_drawn_as_found(mesh):
    loaded = {f"{force:g} N": loaded_mesh(mesh, tip_relief(mesh, 20.0, 20.0, 0.4), force) for force in (1e3, 4e3, 20e3)}
    axes = plotting.under_load(loaded, plt.subplots(3, 1)[1])
    for name, each in loaded.items():
        assert np.array_equal(line(axes[0], name)[1], each.approach_um)
        assert np.array_equal(line(axes[1], name)[1], each.stiffness_n_per_m * plotting.per_width(mesh))
    shares = np.array([each.get_ydata() for each in axes[2].lines])
    assert np.array_equal(np.nan_to_num(shares), np.concatenate([each.load_share for each in loaded.values()]))


def test_finite_elements_are_drawn_as_stored():
    body = finite_element_bodies()["34"]
    result = mesh_stiffness(body.pair)
    _, axes = plt.subplots(2, 1)
    upper, lower = plotting.finite_element_check(body, result, axes)
    points = [each for each in upper.lines if each.get_linestyle() == "None"]
    for name, drawn, off in zip(MEASURES, points, lower.lines[1:], strict=True):
        assert np.array_equal(drawn.get_ydata(), body.compliance[name])
        assert np.array_equal(drawn.get_xdata(), body.positions)
        fast = (1 + np.array(off.get_ydata()) / 100) * body.compliance[name]
        unit = 206.8e9 * 0.020
        exact = sum(v for part, v in result.compliance_m_per_n.items() if part.startswith("pinion")) * unit
        assert fast == pytest.approx(np.interp(body.positions, result.path, exact), rel=1e-12)


def test_trends_have_the_article_first():
    rows = published.STIFFNESS_TABLE
    _, axes = plt.subplots(1, 3)
    for ax, name in zip(
        plotting.stiffness_trends(rows, {"again": rows}, axes), ("contact_ratio", "a", "b"), strict=True
    ):
        assert [each.get_label() for each in ax.lines] == ["the article", "again"]
        assert list(ax.lines[0].get_ydata()) == [getattr(row, name) for row in rows]


def test_the_article_is_a_star_over_the_cloud():
    ax = plotting.contact_ratio_cloud([[1.6, 1.65, 1.7], [1.5, 1.55, 1.6]], published.STIFFNESS_TABLE)
    dots, star = ax.lines[:2]
    x, y = dots.get_data()
    assert (list(x), list(y)) == ([1.6, 1.5], pytest.approx([0.1, 0.1]))
    assert (star.get_xdata()[0], star.get_ydata()[0]) == pytest.approx((1.65, 0.23))
