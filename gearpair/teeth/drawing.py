"""What a drawing, and the load on it, say of a drive."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from gearpair._checks import check_class, check_number
from gearpair.teeth.blank import GearBlank
from gearpair.teeth.loading import loaded_mesh
from gearpair.teeth.meshing import Coupling, MeshStiffness, mesh_stiffness
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.transmission_error import TipRelief, error_harmonics

PAIR = tuple(each.name for each in fields(SpurPair))
DRAWING = ("pair", "coupling", "n_levels", "pinion_blank", "gear_blank", "relief")
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


def redrawn_fields(drive: Any, changes: dict[str, Any]) -> dict[str, Any]:
    """Changes of a drive with what follows from those of the drawing, or of the load on reliefs, in their place."""
    mesh = drive.mesh
    drawn: dict[str, Any] = {} if drive.relief is None else {"profile_harmonics": ()}
    drawing = {name: changes.pop(name) for name in (*DRAWING, *PAIR) if name in changes}
    n_levels, relief = drawing.pop("n_levels", len(drive.stiffness.levels)), drawing.pop("relief", drive.relief)
    if drawing:
        pair, coupling = drawing.pop("pair", mesh.pair), drawing.pop("coupling", mesh.coupling)
        blanks = {who: drawing.pop(f"{who}_blank", getattr(drive, f"{who}_blank")) for who in ("pinion", "gear")}
        drawn |= drawn_fields(pair.replace(**drawing), coupling, blanks)
    torque = changes.get("pinion_torque_nm", drive.pinion_torque_nm)
    return drawn | loaded_fields(drawn.get("mesh", mesh), relief, torque, n_levels) | changes
