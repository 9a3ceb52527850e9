"""Finite elements of a tooth among others, kept in gearpair/teeth/data/finite_elements.json, beside the formulas."""

import math

import numpy as np
import pytest

from gearpair.teeth.compliance import (
    foundation_compliance,
    in_foundation_range,
    root_load,
    tooth_compliance,
)
from gearpair.teeth.finite_elements import FiniteElementBody, double_contact_stiffness, finite_element_bodies
from gearpair.teeth.gear_body import ring_compliance
from gearpair.teeth.meshing import MeshStiffness, mesh_stiffness
from gearpair.teeth.tooth_profile import ToothProfile
from tests.support.teeth import NU, rolls_in_contact

BODIES = finite_element_bodies()


def library_own(body: FiniteElementBody) -> np.ndarray:
    """The library's compliance of the loaded tooth and its body at the stored loads, times E b."""
    tooth, rolls = ToothProfile(body.body), rolls_in_contact(body.pair, body.who, body.positions)
    return sum(tooth_compliance(tooth, rolls, NU)) + foundation_compliance(tooth, rolls)


def library_neighbour(body: FiniteElementBody, step: int) -> np.ndarray:
    """Displacement at tooth `step`, every roll, for a load on tooth 0, every roll: shape (watched, loaded)."""
    tooth, rolls = ToothProfile(body.body), rolls_in_contact(body.pair, body.who, body.positions)
    ring = ring_compliance(tooth.radius_ratio, tooth.clamp_half_angle, 2 * math.pi / body.body.teeth * step, NU)
    load = root_load(tooth, rolls)
    return load @ ring @ load.T


def test_finite_elements_have_converged() -> None:
    for body in BODIES.values():
        assert max(body.change_on_refining.values()) < 0.005


def test_one_tooth_on_its_rim() -> None:
    body = BODIES["34"]
    own = library_own(body)
    assert own == pytest.approx(body.compliance["section"], rel=0.018)
    low = body.positions < body.pair.contact_ratio / 2
    assert own[low] == pytest.approx(body.compliance["tip"][low], rel=0.015)
    # down to the tooth's centre line, a little more of the contact's own yielding is taken off
    excess = own / body.compliance["centre"] - 1
    assert excess.min() > 0.03 and excess.max() < 0.06


@pytest.mark.parametrize("name", ["34 in a row", "34 all round", "34 with 54", "54 with 34", "20 shifted"])
def test_tooth_among_others(name: str) -> None:
    body = BODIES[name]
    assert library_own(body) == pytest.approx(body.compliance["section"], rel=0.02)
    assert library_own(body) == pytest.approx(body.compliance["tip"], rel=0.042)


def test_thin_ring_shows_the_limit_of_the_foundation_fit() -> None:
    # h = 1.54 is inside Sainsot's stated range, yet the fit is 10 % too soft; the ring it was fitted to is not
    body = BODIES["34 thin ring"]
    tooth, rolls = ToothProfile(body.body), rolls_in_contact(body.pair, body.who, body.positions)
    assert in_foundation_range(tooth)
    fitted = library_own(body) / body.compliance["section"] - 1
    assert 0.09 < fitted[0] < 0.11
    by_ring = sum(tooth_compliance(tooth, rolls, NU)) + np.diag(library_neighbour(body, 0))
    assert by_ring == pytest.approx(body.compliance["section"], rel=0.03)


@pytest.mark.parametrize("name", ["34 in a row", "34 all round", "34 with 54", "54 with 34", "20 shifted"])
@pytest.mark.parametrize("step", [1, -1])
def test_neighbours_move_as_the_ring_says(name: str, step: int) -> None:
    ratio = library_neighbour(BODIES[name], step) / BODIES[name].compliance[f"section {step:+d}"]
    assert np.abs(ratio - 1).max() < 0.045
    assert abs(ratio.mean() - 1) < 0.01


def test_neighbours_two_pitches_away() -> None:
    body = BODIES["34 in a row"]
    for step in (2, -2):
        ratio = library_neighbour(body, step) / body.compliance[f"section {step:+d}"]
        assert np.abs(ratio - 1).max() < 0.045


@pytest.mark.parametrize(("pinion", "gear"), [("34 in a row", "34 in a row"), ("34 with 54", "54 with 34")])
def test_double_contact(pinion: str, gear: str) -> None:
    one, other = BODIES[pinion], BODIES[gear]
    other = other.mirrored() if one is other else other  # equal gears: the driven one's contact runs from tip to root
    phase, coupled = double_contact_stiffness(one, other)
    _, summed = double_contact_stiffness(one, other, coupled=False)
    results: dict[str, MeshStiffness] = {c: mesh_stiffness(one.pair, coupling=c) for c in ("summed", "clamped")}
    unit = 206.8e9 * 0.020
    assert results["clamped"].zones[0](phase) / unit == pytest.approx(coupled, rel=0.02)
    assert results["summed"].zones[0](phase) / unit == pytest.approx(summed, rel=0.01)
    # summing the pairs overestimates double contact by a third with a bore of 0.3 pitch radii
    assert (summed / coupled).min() > 1.32 and (summed / coupled).max() < 1.38


@pytest.mark.parametrize(
    "name", ["34 in a row", "34 all round", "34 with 54", "54 with 34", "20 shifted", "34 thin ring"]
)
def test_one_tooth_on_a_ring_without_the_fit(name: str) -> None:
    body = BODIES[name]
    tooth, rolls = ToothProfile(body.body), rolls_in_contact(body.pair, body.who, body.positions)
    by_ring = sum(tooth_compliance(tooth, rolls, NU)) + np.diag(library_neighbour(body, 0))
    assert by_ring == pytest.approx(body.compliance["section"], rel=0.03)


def test_double_contact_needs_neighbours() -> None:
    with pytest.raises(ValueError, match="'34' has no neighbouring teeth stored"):
        double_contact_stiffness(BODIES["34"], BODIES["34"])
