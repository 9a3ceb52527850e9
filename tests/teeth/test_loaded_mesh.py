"""A mesh under its load against closed forms, its two ends, and balances found another way."""

import dataclasses
import warnings

import numpy as np
import pytest
from scipy.optimize import brentq, nnls

from gearpair.teeth import (
    SpurPair,
    full_contact_force,
    loaded_mesh,
    mesh_stiffness,
    pair_deviations,
    profile_error,
    tip_relief,
)

PAIR = SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
MESHES = {
    "summed": mesh_stiffness(PAIR),
    "ring": mesh_stiffness(PAIR, coupling="ring"),
    "three pairs": mesh_stiffness(PAIR.replace(addendum=1.3), coupling="ring"),
}


def deflection_um(mesh, force):
    return force / mesh.mean * 1e6


def test_a_pair_alone_is_one_spring():
    mesh = MESHES["ring"]
    deviation, alone = 3.0 + 2.0 * mesh.path, mesh.pairs_in_contact == 1
    loaded = loaded_mesh(mesh, deviation, 2000.0)
    spring = np.interp(mesh.phase[alone], mesh.path, mesh.pair_stiffness_n_per_m)
    sunk = 2000.0 / spring * 1e6
    assert loaded.approach_um[alone] == pytest.approx(3.0 + 2.0 * mesh.phase[alone] + sunk, rel=1e-5)
    assert loaded.error_um[alone] == pytest.approx(3.0 + 2.0 * mesh.phase[alone], rel=1e-12)
    assert loaded.load_share[0, alone] == pytest.approx(1.0, rel=1e-12) and not loaded.load_share[1:, alone].any()


@pytest.mark.parametrize("coupling", ["summed", "ring"])
def test_two_pairs_by_hand(coupling):
    """Two springs joined by their bodies; the one with the larger gap takes part from a force on that is known."""
    mesh = MESHES[coupling]
    deviation = tip_relief(mesh, 12.0, 8.0, 0.4)
    i = 100
    (own, joint), (_, other) = mesh.joint_compliance_m_per_n[i]
    first, second = pair_deviations(mesh, deviation)[:, i] * 1e-6
    assert (joint == 0.0) == (coupling == "summed") and first > second
    meets = (first - second) / (other - joint)  # the second alone has sunk by the first's gap more than it drags it
    for force in (0.5 * meets, 0.999 * meets, 1.001 * meets, 3.0 * meets):
        loaded = loaded_mesh(mesh, deviation, force)
        if force < meets:
            on_first, approach, k = 0.0, second + force * other, 1.0 / other
        else:
            on_first = (force * (other - joint) - (first - second)) / (own + other - 2.0 * joint)
            approach = first + own * on_first + joint * (force - on_first)
            k = (own + other - 2.0 * joint) / (own * other - joint**2)
        assert loaded.load_share[:, i] * force == pytest.approx([on_first, force - on_first], abs=1e-9 * force)
        assert loaded.approach_um[i] == pytest.approx(approach * 1e6, rel=1e-12)
        assert loaded.stiffness_n_per_m[i] == pytest.approx(k, rel=1e-12)


@pytest.mark.parametrize("name", MESHES)
def test_in_full_contact_it_is_the_mean_weighted_by_the_shares(name):
    mesh = MESHES[name]
    deviation = tip_relief(mesh, 12.0, 8.0, 0.4)
    force = 1.001 * full_contact_force(mesh, deviation)
    loaded = loaded_mesh(mesh, deviation, force)
    assert loaded.error_um == pytest.approx(profile_error(mesh, deviation, force_n=force), abs=1e-9)
    assert loaded.stiffness_n_per_m == pytest.approx(mesh.stiffness_n_per_m, rel=1e-12)
    assert loaded.mean == pytest.approx(mesh.mean, rel=3e-4)  # samples, and jumps between two of them
    assert np.interp(0.3, *_steps(loaded.wave(32))) == pytest.approx(np.interp(0.3, *_steps(mesh.wave(32))), rel=2e-3)
    assert np.all(loaded.load_share[mesh.load_share > 0.0] > 0.0)
    below = loaded_mesh(mesh, deviation, 0.998 * force)
    assert (below.load_share > 0.0).sum() < (mesh.load_share > 0.0).sum()


def _steps(wave):
    return (np.array(wave.edges) + [*wave.edges[1:], 1.0]) / 2.0, wave.levels


def test_teeth_without_deviation_share_as_they_are_said_to():
    for mesh in MESHES.values():
        for force in (0.0, 1.0, 3000.0):
            loaded = loaded_mesh(mesh, np.zeros_like(mesh.path), force)
            assert loaded.load_share == pytest.approx(mesh.load_share, abs=1e-12)
            assert loaded.approach_um == pytest.approx(force / mesh.stiffness_n_per_m * 1e6, rel=1e-12)


@pytest.mark.parametrize("name", MESHES)
def test_without_load_the_first_pair_touches(name):
    mesh = MESHES[name]
    deviation = 5.0 + np.sin(3.0 * mesh.path) + mesh.path
    free, none = profile_error(mesh, deviation, loaded=False), loaded_mesh(mesh, deviation, 0.0)
    assert none.error_um == pytest.approx(free, rel=1e-12) and np.array_equal(none.approach_um, none.error_um)
    little = loaded_mesh(mesh, deviation, 1e-6)
    assert little.approach_um == pytest.approx(free, abs=1e-7)
    apart = np.sort(pair_deviations(mesh, deviation), axis=0)
    clear = apart[1] - apart[0] > 1e-6
    assert little.stiffness_n_per_m[clear] == pytest.approx(none.stiffness_n_per_m[clear], rel=1e-12)
    assert little.load_share[:, clear] == pytest.approx(none.load_share[:, clear], abs=1e-12)


def test_a_relief_keeps_a_pair_out_of_contact():
    """One and a half times what the mesh sinks, over a third of a base pitch: today's mean has pairs that pull."""
    mesh, force = MESHES["ring"], 1500.0
    amount = 3.0 * deflection_um(mesh, force)
    deviation = tip_relief(mesh, amount, amount, 1.0 / 3.0)
    loaded, least = loaded_mesh(mesh, deviation, force), full_contact_force(mesh, deviation)
    assert least > 2.0 * force and loaded.load_share[0, 0] == 0.0 < mesh.load_share[0, 0]
    at_entry = mesh.joint_compliance_m_per_n[0, 1, 1]  # the pair that was there carries alone, on its own stiffness
    assert loaded.stiffness_n_per_m[0] == pytest.approx(1.0 / at_entry, rel=1e-12)
    assert np.diff(loaded.approach_um).max() < 0.1 < np.diff(loaded.error_um).max()  # only the second jumps
    with pytest.raises(ValueError, match=r"force_n must be at least .*, got 1500.0: .* gearpair.teeth.loaded_mesh"):
        profile_error(mesh, deviation, force_n=force)
    with pytest.warns(UserWarning, match=r"holds from .* N on; .* take gearpair.teeth.loaded_mesh"):
        profile_error(mesh, deviation)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        profile_error(mesh, deviation, force_n=1.0001 * least)
        profile_error(mesh, np.zeros_like(mesh.path))


def by_least_squares(joint, gaps, force):
    """The balance by another way: forces of given approach by non-negative least squares, the approach by bisection."""
    unit = joint.max()  # so that all numbers are about one
    root, reach = np.linalg.cholesky(joint / unit), gaps / (unit * force)

    def forces(approach):
        return nnls(root.T, np.linalg.solve(root, approach - reach))[0]

    approach = brentq(lambda d: forces(d).sum() - 1.0, reach.min(), reach.max() + 2.0, xtol=1e-14, rtol=1e-14)
    return forces(approach) * force, approach * unit * force


@pytest.mark.parametrize("name", MESHES)
def test_random_deviations_against_another_way_to_the_balance(name):
    """Deviations of the size of the deflection and bodies that couple more and less than those of the gears do."""
    rng = np.random.default_rng(22)
    mesh = MESHES[name]
    carrying = set()
    for _ in range(12):
        force = rng.uniform(100.0, 5000.0)
        size = deflection_um(mesh, force) * 10.0 ** rng.uniform(-0.5, 1.5)
        deviation = size * np.interp(mesh.path, np.linspace(0.0, mesh.contact_ratio, 8), rng.uniform(0.0, 1.0, 8))
        stronger = mesh.joint_compliance_m_per_n * rng.uniform(0.3, 1.2)
        own = np.einsum("nii->ni", mesh.joint_compliance_m_per_n)
        np.einsum("nii->ni", stronger)[:] = own
        loaded = loaded_mesh(dataclasses.replace(mesh, joint_compliance_m_per_n=stronger), deviation, force)
        for i in rng.integers(0, len(mesh.phase), 25).tolist():
            n = mesh.pairs_in_contact[i]
            gaps = pair_deviations(mesh, deviation)[:n, i] * 1e-6
            forces, approach = by_least_squares(stronger[i, :n, :n], gaps, force)
            assert loaded.load_share[:n, i] == pytest.approx(forces / force, abs=1e-9)
            assert loaded.approach_um[i] == pytest.approx(approach * 1e6, rel=1e-9)
            carrying.add((n, int((loaded.load_share[:n, i] > 0.0).sum())))
    most = int(mesh.pairs_in_contact.max())
    assert {(most, each) for each in range(1, most + 1)} <= carrying  # every number of pairs was among them


@pytest.mark.parametrize("name", MESHES)
def test_stiffness_error_and_approach_belong_together(name):
    """The stiffness is the rate of force with approach, and the force is the stiffness times what is left of it."""
    mesh = MESHES[name]
    deviation, force, step = tip_relief(mesh, 10.0, 16.0, 0.45), 1200.0, 1e-3
    low, here, high = (loaded_mesh(mesh, deviation, force + each) for each in (-step, 0.0, step))
    steady = np.all((low.load_share > 0.0) == (high.load_share > 0.0), axis=0)
    rate = 2.0 * step / (high.approach_um - low.approach_um) * 1e6
    assert steady.mean() > 0.99
    assert rate[steady] == pytest.approx(here.stiffness_n_per_m[steady], rel=1e-6)
    assert here.stiffness_n_per_m * (here.approach_um - here.error_um) * 1e-6 == pytest.approx(force, rel=1e-12)


def test_the_staircase_has_the_means_of_the_curve():
    mesh = MESHES["ring"]
    loaded = loaded_mesh(mesh, tip_relief(mesh, 10.0, 16.0, 0.45), 1200.0)
    for n in (7, 16, 101):
        wave = loaded.wave(n)
        assert len(wave.levels) == n and wave.mean == pytest.approx(1.0, rel=1e-12)
    curve = loaded.stiffness_n_per_m / loaded.mean
    inside = np.abs(wave(mesh.phase) - curve) < 0.02
    assert inside.mean() > 0.99
    jumps = np.flatnonzero(np.abs(np.diff(curve)) > 0.1) + 1
    assert len(jumps) == 2  # a pair comes in, and another one goes, both later and earlier than on their paths
    edges = np.array(wave.edges)
    assert all(np.abs(edges - (mesh.phase[j] - 0.0005)).min() < 1e-12 for j in jumps)
    with pytest.raises(ValueError, match="n_levels must be a whole number of at least"):
        loaded.wave(1)


@pytest.mark.parametrize(
    "deviation, force, sentence",
    [
        (np.zeros(3), 1.0, "deviation_um must be finite numbers over the path of contact"),
        (np.zeros_like(MESHES["ring"].path), -1.0, "force_n must be a finite number at least 0, got -1.0"),
        (np.full_like(MESHES["ring"].path, np.nan), 1.0, "deviation_um must be finite, got nan"),
    ],
)
def test_bad_input_gets_a_sentence(deviation, force, sentence):
    with pytest.raises(ValueError, match=sentence):
        loaded_mesh(MESHES["ring"], deviation, force)
