"""Parts of a wave and of the error as parameters: the same oscillators as with the whole field replaced."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.quantities import attributes, axis_label, symbol

STAIRS = gp.Oscillator(
    stiffness=gp.StiffnessWave((0.0, 0.3, 0.6), (1.1, 0.8, 0.6)), harmonics=[(2, 0.05, 0.1), (5, 0.01, 0.2)]
)


def test_a_part_is_that_of_the_whole_field():
    changes = {"levels[1]": 0.9, "edges[2]": 0.7, "harmonics[5].amplitude": 0.02, "harmonics[2].phase": 1.0}
    by_parts = STAIRS.replace(**changes, damping_ratio=0.03)
    whole = gp.Oscillator(
        stiffness=gp.StiffnessWave((0.0, 0.3, 0.7), (1.1, 0.9, 0.6)), harmonics=[(2, 0.05, 1.0), (5, 0.02, 0.2)],
        damping_ratio=0.03,
    )  # fmt: skip
    assert by_parts == whole
    assert [by_parts.parameter(name) for name in changes] == list(changes.values())
    assert set(changes) < set(STAIRS.parameters) == set(whole.parameters)


def test_a_rectangle_whose_level_changes_is_no_rectangle():
    osc = gp.Oscillator()
    changed = osc.replace(**{"levels[1]": 0.6})
    assert changed.stiffness == gp.StiffnessWave(osc.stiffness.edges, (1.116, 0.6))
    assert {"contact_ratio", "a", "b"} & set(changed.parameters) == set()
    assert STAIRS.replace(**{"harmonics[2].phase": 0.5}).stiffness == STAIRS.stiffness


def test_sweeps_maps_and_continuation_take_parts():
    """A sweep of the swapped level is that of b, which it is 1 minus."""
    osc, values = gp.Oscillator(harmonics=[(3, 0.05, 0.2)]), np.array([0.40, 0.42, 0.44])
    by_level = gp.sweep(osc, "levels[1]", 1.0 - values, n_watch=100)
    by_b = gp.sweep(osc, "b", values, n_watch=100)
    np.testing.assert_array_equal(by_level.x, by_b.x)
    assert by_level["levels[1]"].attrs["long_name"] == "stiffness level k_1"
    grid = gp.parameter_map(osc, {"harmonics[3].phase": [0.2, 1.0], "edges[1]": [0.5, 0.68]}, n_watch=100)
    assert grid.period.values[0, 1] == gp.steady_state(osc.replace(**{"edges[1]": 0.68})).period
    state = gp.steady_state(osc)
    branch = gp.continue_orbit(
        gp.periodic_orbit(osc, *state.points[0], state.period), "harmonics[3].amplitude", 0.04, 0.06
    )
    assert branch.values[[0, -1]] == pytest.approx([0.04, 0.06])
    there = osc.replace(**{"harmonics[3].amplitude": 0.06})
    assert gp.stroboscopic_map(there, *branch.points[-1, 0], n=state.period) == pytest.approx(branch.points[-1, 0])


def test_what_parts_are_called():
    assert attributes("harmonics[3].phase") == {"long_name": "phase of harmonic 3 phi_3", "units": "rad"}
    assert axis_label("harmonics[2].amplitude") == "amplitude of harmonic 2 $F_{2}$"
    assert axis_label("edges[1]") == "start of stiffness level $k_{1}$, in mesh periods"
    assert (symbol("levels[0]"), symbol("nothing")) == ("k_0", "nothing")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"levels[3]": 1.0}, r"unknown parameter 'levels\[3\]' \(did you mean 'levels\["),
        ({"edges[0]": 0.1}, r"unknown parameter 'edges\[0\]' \(did you mean 'edges\["),
        ({"harmonics[3].phase": 1.0}, r"unknown parameter 'harmonics\[3\].phase' \(did you mean 'harmonics\["),
        ({"harmonics[2]": 1.0}, r"unknown parameter 'harmonics\[2\]'"),
        ({"levels[0].phase": 1.0}, r"unknown parameter 'levels\[0\].phase'"),
        ({"Omega_h": 1.0}, r"unknown parameter 'Omega_h' \(did you mean 'mesh_frequency'\?\)"),
        ({"zeta": 1.0}, r"unknown parameter 'zeta' \(did you mean 'damping_ratio'\?\)"),
        ({"levels[1]": -1.0}, r"levels\[1\] must be a finite number above 0"),
        ({"levels[1]": "1"}, r"levels\[1\] must be"),
        ({"edges[1]": 0.65}, "edges must increase strictly"),
        ({"harmonics[2].amplitude": -0.1}, r"harmonics\[0\] amplitude must be"),
        ({"levels[1]": 0.9, "stiffness": STAIRS.stiffness}, r"give either stiffness or levels\[1\], not both"),
        ({"harmonics[2].phase": 0.9, "harmonics": []}, r"give either harmonics or harmonics\[2\].phase, not both"),
    ],
)
def test_parts_that_are_not_there_or_not_allowed(change, said):
    with pytest.raises(ValueError, match=said):
        STAIRS.replace(**change)
