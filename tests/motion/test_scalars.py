"""What is asked of a number is a number; what is asked of an array is an array of its shape."""

import numpy as np
import pytest

import gearpair as gp

OSC = gp.Oscillator(harmonics=[(2, 0.05, 0.3)])
OF_ONE = {
    "force": OSC.force,
    "error": OSC.error,
    "stiffness": OSC.stiffness,
    "segment": gp.methods.segments(OSC, 1.0, 0.0)[0],
    "cubic": gp.methods.segments(OSC, 1.0, 0.0)[0].cubic,
}
OF_TWO = {
    "stroboscopic_map": lambda x, v: gp.stroboscopic_map(OSC, x, v),
    "stroboscopic_map, no period": lambda x, v: gp.stroboscopic_map(OSC, x, v, 0),
    "backward_map": lambda x, v: gp.boundaries.backward_map(OSC, x, v),
}


@pytest.mark.parametrize("name", OF_ONE)
def test_a_function_of_time(name):
    of = OF_ONE[name]
    for given in (0.1, 0, np.float64(0.1), np.array(0.1)):
        assert type(of(given)) is float
    for given in ([0.1], np.array([[0.1, 0.2]])):
        values = of(given)
        assert isinstance(values, np.ndarray) and values.shape == np.shape(given)
        assert values.flat[0] == of(0.1)


@pytest.mark.parametrize("name", OF_TWO)
def test_a_map_of_the_section(name):
    of = OF_TWO[name]
    for given in ((0.1, 0.2), (np.float64(0.1), np.array(0.2))):
        assert [type(value) for value in of(*given)] == [float, float]
    for given in (([0.1], 0.2), (0.1, [0.2]), (np.full((2, 3), 0.1), 0.2)):
        x, v = of(*given)
        assert x.shape == v.shape == np.broadcast_shapes(*map(np.shape, given))
        assert (x.flat[0], v.flat[0]) == of(0.1, 0.2)


def test_an_impact_state_of_two_numbers_of_any_kind():
    assert gp.impact_state(np.float64(0.2), np.array(1.8)) is gp.impact_state(0.2, 1.8)
