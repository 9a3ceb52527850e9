"""What a drawing, and the load on it, say of a drive."""

from __future__ import annotations

from typing import Any

from gearpair._checks import check_class, check_number
from gearpair.teeth.blank import GearBlank
from gearpair.teeth.loading import loaded_mesh
from gearpair.teeth.meshing import Coupling, MeshStiffness, mesh_stiffness
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.transmission_error import TipRelief, error_harmonics

PROFILE_HARMONICS = 12  # that stand for the error of relieved tips


def drawn_fields(pair: SpurPair, coupling: Coupling, blanks: dict[str, GearBlank | None]) -> dict[str, Any]:
    """The fields of a drive that follow from a drawing alone; an inertia where there is a blank."""
    drawn: dict[str, Any] = {"pinion_teeth": pair.pinion_teeth, "mesh": mesh_stiffness(pair, coupling=coupling)}
    for who, gear in (("pinion", pair.pinion), ("gear", pair.gear)):
        drawn |= {f"{who}_base_radius_mm": gear.base_radius_mm, f"{who}_blank": (blank := blanks[who])}
        if blank is not None:
            drawn[f"{who}_inertia_kg_m2"] = blank.inertia_kg_m2(gear)
    return drawn


def loaded_fields(mesh: MeshStiffness, relief: TipRelief | None, torque_nm: float, n_levels: int) -> dict[str, Any]:
    """The fields of a drive that follow from a mesh, with relieved tips under a torque."""
    if relief is None:
        return {"mean_stiffness_n_per_um": mesh.mean * 1e-6, "stiffness": mesh.wave(n_levels), "relief": None}
    check_class("relief", relief, TipRelief)
    force = abs(check_number("pinion_torque_nm", torque_nm)) / (mesh.pair.pinion.base_radius_mm * 1e-3)
    loaded = loaded_mesh(mesh, relief.deviation_um(mesh), force)
    return {
        "mean_stiffness_n_per_um": loaded.mean * 1e-6,
        "stiffness": loaded.wave(n_levels),
        "profile_harmonics": error_harmonics(loaded.error_um, PROFILE_HARMONICS),
        "relief": relief,
    }
