"""What the tests of teeth share."""

import numpy as np

from gearpair.teeth.spurpair import SpurPair

NU = 0.3  # Poisson's ratio of steel


def rolls_in_contact(pair: SpurPair, who: str, positions: np.ndarray) -> np.ndarray:
    """Roll angles of the tooth of `who` at positions along the path of contact, in mesh periods since its start."""
    along = pair.contact_start_mm + positions * pair.base_pitch_mm
    if who == "gear":
        along = pair.line_of_action_mm - along
    return along / getattr(pair, who).base_radius_mm
