"""Finite-element gear bodies, computed once and stored: what the mesh stiffness is checked against.

The numbers stand in ``data/finite_elements.json``; the script that made them, which needs scikit-fem and gmsh, is
``tests/teeth/finite_elements/run.py`` in the source tree. Nothing here needs either.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Self

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import checked
from gearpair._equality import equal_by_value
from gearpair.teeth.compliance import hertz_compliance
from gearpair.teeth.spurgear import SpurGear
from gearpair.teeth.spurpair import SpurPair

Array = NDArray[np.float64]
MEASURES = ("section", "tip", "centre")


@equal_by_value
@dataclass(frozen=True)
class FiniteElementBody:
    """A gear on its bore with one, several or all of its teeth, loaded at eleven places of the path of contact.

    Plane stress, quadratic triangles, no contact: a unit force acts along the line of action.

    Attributes
    ----------
    name : str
    pair : SpurPair
    who : {"pinion", "gear"}
        Which gear of the pair it is.
    positions : ndarray, shape (n,)
        Of the load, in mesh periods since the pair of teeth entered contact.
    compliance : mapping of str to ndarray
        Displacement along the line of action times E b over the force (dimensionless). ``"section"``, ``"tip"``
        and ``"centre"``, shape (n,): of the loaded tooth, the load's indentation removed in three ways.
        ``"section +1"`` and so on, shape (n, n): of the next tooth on the loaded flank's side; rows are the
        watched places, columns the loaded ones.
    change_on_refining : mapping of str to float
        The largest relative change of each when the elements were halved for the last time.

    Notes
    -----
    ``section``: the cross-section through the loaded point, taken as rigid; its mean displacement and mean turn are
    what the displacement of a Timoshenko beam stands for (Cowper 1966). ``tip``: the same of the tooth's end, which
    carries nothing. ``centre``: the point where the force crosses the tooth's centre line (Weber and Banaschek).
    """

    name: str
    pair: SpurPair
    who: str
    positions: Array
    compliance: Mapping[str, Array]
    change_on_refining: Mapping[str, float]

    @property
    def body(self) -> SpurGear:
        """The gear itself."""
        return self.pair.pinion if self.who == "pinion" else self.pair.gear

    def mirrored(self) -> Self:
        """The same gear as its equal mate: there the contact runs the other way along the flank."""
        turned = {
            name: values[::-1] if values.ndim == 1 else values[::-1, ::-1] for name, values in self.compliance.items()
        }
        mate = "gear" if self.who == "pinion" else "pinion"
        return type(self)(self.name, self.pair, mate, self.positions, turned, self.change_on_refining)


@checked
def finite_element_bodies() -> dict[str, FiniteElementBody]:
    """The stored bodies by name.

    Examples
    --------
    >>> bodies = finite_element_bodies()
    >>> list(bodies)[:3]
    ['34', '34 in a row', '34 all round']
    >>> bodies["34"].compliance["section"].shape
    (11,)
    """
    text = (files("gearpair.teeth") / "data" / "finite_elements.json").read_text(encoding="utf-8")
    bodies = {}
    for entry in json.loads(text):
        blocks = {name: np.array(block["compliance"]) for name, block in entry["blocks"].items()}
        bodies[entry["case"]] = FiniteElementBody(
            name=entry["case"],
            pair=SpurPair(**entry["pair"]),
            who=entry["gear"],
            positions=np.array(entry["positions"]),
            compliance={name: block[0] if name in MEASURES else block for name, block in blocks.items()},
            change_on_refining={name: block["change_on_refining"] for name, block in entry["blocks"].items()},
        )
    return bodies


@checked
def double_contact_stiffness(
    pinion: FiniteElementBody, gear: FiniteElementBody, *, coupled: bool = True
) -> tuple[Array, Array]:
    """Mesh stiffness with two pairs of teeth in contact, from finite-element bodies and linear Hertzian contacts.

    Parameters
    ----------
    pinion, gear : FiniteElementBody
        The two bodies of one pair, with neighbouring teeth stored.
    coupled : bool
        Whether a load on one tooth moves its neighbour, or each pair has bodies of its own.

    Returns
    -------
    phase, stiffness : ndarray, shape (5,)
        Fractions of the mesh period inside the zone of double contact; stiffness over E b (dimensionless).

    Examples
    --------
    >>> body = finite_element_bodies()["34 in a row"]
    >>> double_contact_stiffness(body, body.mirrored())[1].round(3).tolist()
    [0.079, 0.081, 0.081, 0.081, 0.079]
    """
    n = 5  # stored places: five in the zone of double contact, one in the middle, the first five one period later
    stiffness = []
    for k in range(n):
        early, late = k, n + 1 + k
        matrix = hertz_compliance(pinion.pair.poisson_ratio) * np.eye(2)
        for body, behind in ((pinion, "section +1"), (gear, "section -1")):
            if behind not in body.compliance:
                raise ValueError(f"finite-element body {body.name!r} has no neighbouring teeth stored")
            matrix += np.diag(body.compliance["section"][[early, late]])
            matrix += coupled * body.compliance[behind][late, early] * np.array([[0.0, 1.0], [1.0, 0.0]])
        stiffness.append(float(np.linalg.inv(matrix).sum()))
    return pinion.positions[:n], np.array(stiffness)
