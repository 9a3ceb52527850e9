"""The uncertainty exponent of a plane whose uncertain starts are counted by hand."""

import numpy as np
import pytest

from gearpair import ensembles


def one_line(n: int) -> np.ndarray:
    """A plane of n columns with one boundary, at the middle."""
    return np.tile((np.arange(n) >= n // 2).astype(int), (2, 1))


def test_both_neighbours_of_a_start_count():
    """An error of e steps may mislead the e starts on the left of the line and the e on its right."""
    n, longest = 100, 16
    found = ensembles.uncertainty_exponent(one_line(n), longest=longest)
    assert found.epsilon.tolist() == [1, 2, 4, 8, 16]
    assert found.share == pytest.approx(2 * found.epsilon / (n - 2 * longest), rel=1e-12)


def test_the_largest_error_is_a_sixteenth_of_the_row():
    assert ensembles.uncertainty_exponent(one_line(128)).epsilon.tolist() == [1, 2, 4, 8]
    assert ensembles.uncertainty_exponent(one_line(127)).epsilon.tolist() == [1, 2, 4]


def test_an_error_of_half_the_row_leaves_no_start_and_is_refused():
    assert ensembles.uncertainty_exponent(one_line(9), longest=4).share[0] > 0.0  # one column of starts is left
    with pytest.raises(ValueError, match="longest must be from 4 to below half of the plane's 8 columns, got 4"):
        ensembles.uncertainty_exponent(one_line(8), longest=4)
