"""The transmission error of teeth without load: the first pair that touches, of those on their paths alone."""

import numpy as np
import pytest

from gearpair.teeth import SpurPair, mesh_stiffness, profile_error


@pytest.mark.parametrize("addendum", [1.0, 1.3])
@pytest.mark.parametrize("slope", [-5.0, 5.0])
def test_a_pair_off_its_path_touches_nothing(addendum, slope):
    """A deviation that falls, or rises, along the path: of the pairs on it the one furthest along, or the last to come.

    Beyond its path a pair would be still further along, or not have come yet.
    """
    mesh = mesh_stiffness(SpurPair(addendum=addendum))
    error = profile_error(mesh, 40.0 + slope * mesh.path, loaded=False)
    most = mesh.phase + (np.ceil(mesh.contact_ratio - mesh.phase) - 1.0)
    touching = most if slope < 0.0 else mesh.phase
    assert error == pytest.approx(40.0 + slope * touching, abs=1e-9)
