"""Tooth geometry to mesh stiffness: the drawing of a pair, the compliance of its teeth, and the pairs in contact."""

from gearpair.teeth.blank import GearBlank
from gearpair.teeth.finite_elements import FiniteElementBody, double_contact_stiffness, finite_element_bodies
from gearpair.teeth.iso1328 import FlankTolerances, flank_tolerances
from gearpair.teeth.iso6336 import IsoStiffness, iso_stiffness
from gearpair.teeth.loading import LoadedMesh, loaded_mesh
from gearpair.teeth.meshing import MeshStiffness, mesh_stiffness
from gearpair.teeth.spurgear import Material, SpurGear
from gearpair.teeth.spurpair import SpurPair
from gearpair.teeth.tooth_profile import ToothProfile
from gearpair.teeth.transmission_error import (
    TipRelief,
    error_harmonics,
    error_orders,
    full_contact_force,
    pair_deviations,
    profile_error,
    tip_relief,
)

__all__ = [
    "FiniteElementBody",
    "FlankTolerances",
    "GearBlank",
    "IsoStiffness",
    "LoadedMesh",
    "Material",
    "MeshStiffness",
    "SpurGear",
    "SpurPair",
    "TipRelief",
    "ToothProfile",
    "double_contact_stiffness",
    "error_harmonics",
    "error_orders",
    "finite_element_bodies",
    "flank_tolerances",
    "full_contact_force",
    "iso_stiffness",
    "loaded_mesh",
    "mesh_stiffness",
    "pair_deviations",
    "profile_error",
    "tip_relief",
]
