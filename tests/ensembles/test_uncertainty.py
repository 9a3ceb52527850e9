"""Measures of basins on planes whose answers are known."""

import numpy as np
import pytest
import xarray as xr

import gearpair as gp
from gearpair import ensembles


def cantor_labels(depth: int, refine: int = 1) -> np.ndarray:
    """0 and 1 in turn on the gaps of the middle-third Cantor set of a depth; a start in the set takes its gap's."""
    edges = [(0, 3**depth)]
    gaps = []
    for _ in range(depth):
        edges = [half for a, b in edges for half in ((a, a + (b - a) // 3), (b - (b - a) // 3, b))]
        gaps += [(p[1], q[0]) for p, q in zip(edges[::2], edges[1::2], strict=True)]
    labels = np.zeros(3**depth, int)
    for number, (a, b) in enumerate(sorted(gaps)):
        labels[a:b] = 1 + number  # every gap a colour of its own: each piece of the set is a boundary
    return labels


def test_uncertainty_exponent_of_a_line_is_one_and_of_a_cantor_set_its_codimension():
    """The boundary of the middle-third set has dimension log 2 / log 3, so alpha = 1 - log 2 / log 3 = 0.369."""
    smooth = np.tile((np.arange(4096) > 1700).astype(int), (3, 1))
    got = ensembles.uncertainty_exponent(smooth)
    assert got.exponent == pytest.approx(1.0, abs=1e-12)
    assert got.dimension == pytest.approx(1.0, abs=1e-12)
    fractal = ensembles.uncertainty_exponent(np.tile(cantor_labels(10), (2, 1)), longest=1024)
    assert fractal.exponent == pytest.approx(1.0 - np.log(2) / np.log(3), abs=0.03)
    assert 0.0 < fractal.error < 0.05
    assert fractal.share.shape == fractal.epsilon.shape == (11,)


def test_slanted_lines_have_exponent_one_too():
    row, column = np.mgrid[:64, :512]
    assert ensembles.uncertainty_exponent((column > 100 + 3 * row).astype(int)).exponent == pytest.approx(1.0, abs=0.01)


def test_basin_entropy_of_known_planes():
    """One colour: 0. Two in equal parts in every box: log 2. One box of four mixed half and half: a quarter of that."""
    assert ensembles.basin_entropy(np.zeros((10, 10))) == ensembles.BasinEntropy(0.0, 0.0, 0.0)
    checkers = np.indices((12, 12)).sum(axis=0) % 2
    even = ensembles.basin_entropy(checkers, box=4)
    assert [even.entropy, even.boundary_entropy, even.boundary_boxes] == pytest.approx([np.log(2), np.log(2), 1.0])
    stripes = np.zeros((8, 8), int)
    stripes[:, 5:] = 7
    stripes[:, 4] = 7
    quarter = stripes.copy()
    quarter[:4, :2] = 3
    got = ensembles.basin_entropy(quarter, box=4)
    assert got.boundary_boxes == 0.25
    assert got.entropy == pytest.approx(np.log(2) / 4)
    assert got.boundary_entropy == pytest.approx(np.log(2))


def test_basin_entropy_of_noise_nears_the_logarithm_of_the_number_of_colours():
    labels = np.random.default_rng(0).integers(0, 3, (400, 400))
    got = ensembles.basin_entropy(labels, box=20)
    assert got.boundary_entropy == pytest.approx(np.log(3) - 2 / (2 * 400), abs=5e-4)  # Miller's correction


def test_basin_entropy_leaves_out_boxes_that_do_not_fit():
    plane = np.zeros((7, 7), int)
    plane[6], plane[:, 6] = 1, 2
    assert ensembles.basin_entropy(plane, box=3).entropy == 0.0


def test_starts_whose_fate_is_not_known_are_no_colour():
    """Two colours in equal parts in every box: log 2, not more by a third; a start in four is left out, and told."""
    labels = np.indices((16, 16)).sum(axis=0) % 2
    labels[::4, ::2] = labels[2::4, 1::2] = -1
    got = ensembles.basin_entropy(labels, box=4)
    assert got.boundary_entropy == pytest.approx(np.log(2))
    assert ensembles.basin_entropy(labels + 1, box=4).boundary_entropy > 1.05
    assert got.left_out == 0.25
    empty = labels.copy()
    empty[:, :4] = -1
    assert ensembles.basin_entropy(empty, box=4).boundary_boxes == 1.0  # boxes without any start left do not count


def plane_of(status: np.ndarray, attractor: np.ndarray) -> xr.Dataset:
    """What of a plane of starts its entropy rests on."""
    return xr.Dataset({"status": (("v", "x"), status), "attractor": (("v", "x"), attractor)})


def test_of_a_plane_escape_is_a_colour_and_transients_are_none():
    """Half period 1, a quarter escaped, a quarter chaotic transients or unsettled: of the first two, 2 to 1."""
    status = np.array(
        [["periodic", "periodic", "escaped", "transient"], ["periodic", "periodic", "escaped", "unsettled"]]
    )
    attractor = np.array([[0, 0, -1, -1], [0, 0, -1, 1]])
    got = ensembles.basin_entropy(plane_of(status, attractor), box=2)
    assert (got.entropy, got.boundary_boxes, got.left_out) == (0.0, 0.0, 0.25)
    turned = ensembles.basin_entropy(plane_of(status[:, [0, 2, 1, 3]], attractor[:, [0, 2, 1, 3]]), box=2)
    assert turned.entropy == pytest.approx(np.log(2) / 2)


def test_transients_along_a_line_do_not_make_it_fractal():
    """A smooth boundary with a strip of scattered transients beside it: alpha is 1, and less if they were a colour."""
    labels = np.tile((np.arange(4096) > 1700).astype(int), (256, 1))
    strip = np.random.default_rng(0).random((256, 800)) < 0.1
    labels[:, 1300:2100][strip] = -1
    got = ensembles.uncertainty_exponent(labels)
    assert got.exponent == pytest.approx(1.0, abs=0.02)
    assert got.left_out == pytest.approx(strip.sum() / labels.size)
    assert ensembles.uncertainty_exponent(labels + 1).exponent < 0.5


@pytest.mark.slow
def test_basin_stability_agrees_with_a_fine_grid_within_its_errors_and_repeats_with_its_seed():
    osc = gp.Oscillator(mesh_frequency=0.9)
    grid = gp.basins(osc, np.linspace(-4, 4, 61), np.linspace(-3, 3, 61))
    drawn = ensembles.basin_stability(osc, 2000, seed=1)
    large = (grid.attractor_share.values > 0.05) & (grid.attractor_status.values == "periodic")
    assert large.any()
    shares = grid.attractor_share.values[large]
    near = [int(np.nanargmin(np.abs(drawn.attractor_x.values - x))) for x in grid.attractor_x.values[large]]
    gap = np.abs(drawn.attractor_share.values[near] - shares)
    assert np.all(gap < 4 * drawn.attractor_share_error.values[near] + 0.01)
    share, error = drawn.attractor_share.values, drawn.attractor_share_error.values
    np.testing.assert_allclose(error, np.sqrt(share * (1 - share) / 2000))
    again = ensembles.basin_stability(osc, 2000, seed=1)
    assert again.identical(drawn)
    assert not ensembles.basin_stability(osc, 2000, seed=2).identical(drawn)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ensembles.basin_entropy([1, 2]), "plane must be a plane of attractor numbers"),
        (lambda: ensembles.basin_entropy([[1, 2]], box=2), "box must be at most the shorter side"),
        (lambda: ensembles.basin_entropy([[-1, -1]], box=1), "plane must have starts whose fate is known"),
        (lambda: ensembles.uncertainty_exponent(np.zeros((2, 20))), "longest must be from 4"),
        (lambda: ensembles.uncertainty_exponent(np.zeros((2, 200))), "a boundary between different labels"),
        (lambda: ensembles.basin_stability(gp.Oscillator(), 0), "n must be a whole number"),
        (
            lambda: ensembles.basin_stability(gp.Oscillator(), 5, x_reach=(1.0, 1.0)),
            "x_reach must be two finite numbers",
        ),
    ],
)
def test_bad_input_gets_a_sentence(make, message):
    with pytest.raises(ValueError, match=message):
        make()
