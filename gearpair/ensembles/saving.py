"""Attractors as a dataset and back: what `gearpair.attractors` has found, in a file."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearpair._checks import shown
from gearpair.ensembles.capture import Numbered
from gearpair.ensembles.chaos import Observed
from gearpair.ensembles.datasets import dataset, variables_of, with_numbers
from gearpair.ensembles.labelling import Attractors, Evidence
from gearpair.ensembles.planes import numbered_variables
from gearpair.motion.settling import SettleSettings, blank
from gearpair.oscillator import Oscillator

if TYPE_CHECKING:
    import xarray as xr

# What of the kernels' rows is not the same for all attractors.
KEPT = ("status", "period", "points", "monodromy", "extremes", "exponents", "final", "lasted", "chaos")


def to_dataset(found: Attractors) -> xr.Dataset:
    """What the attractors and the chaotic sets are, the starts, and in variables ``kept_...`` the `Evidence`."""
    evidence, n = found.evidence, len(found.starts)
    told = numbered_variables(Numbered({}, found.columns, found.sets, evidence.leads_to), n)
    starts = {"start_x": found.starts[:, 0], "start_v": found.starts[:, 1], "attractor": found.labels}
    variables = told | variables_of(starts, ("start",), (n,))
    variables["label"] = variables.pop("attractor")
    kept = {name: ("attractor_number", getattr(evidence.settled, name)) for name in KEPT}
    kept |= {f"observed_{name}": ("cell", column) for name, column in evidence.observed._asdict().items()}
    kept["lasting"] = "watched", evidence.lasting
    kept["leads_to"] = "set_number", evidence.leads_to
    ended = [[number, *place] for number, place in found.ended.items()]
    kept["ended"] = "ended", np.array(ended, float).reshape(-1, 3)
    for name, (dim, values) in kept.items():
        dims = (dim, *(f"axis_{k}_of_{length}" for k, length in enumerate(values.shape[1:], 1)))
        variables[f"kept_{name}"] = (dims, values, {"long_name": "for Attractors.from_dataset"})
    settings = json.dumps(asdict(found.settings))
    return with_numbers(dataset(found.oscillator, variables, {}, settings=settings))


def from_dataset(result: xr.Dataset) -> Attractors:
    """The attractors that `to_dataset` has written."""
    osc, settings = Oscillator.from_attrs(result), _settings_of(result)

    def kept(name: str, like: NDArray[Any]) -> NDArray[Any]:
        return np.asarray(result[f"kept_{name}"].values, like.dtype)

    numbers = result["attractor_number"].values.tolist()
    settled = blank(len(numbers), settings)
    settled = settled._replace(**{name: kept(name, getattr(settled, name)) for name in KEPT})
    whole, real = np.empty(0, np.int64), np.empty(0)
    floats = ("x_min", "x_max", "exponents")
    observed = Observed(*(kept(f"observed_{name}", real if name in floats else whole) for name in Observed._fields))
    evidence = Evidence(settled, observed, kept("lasting", real), kept("leads_to", whole))
    starts = np.column_stack([result["start_x"].values, result["start_v"].values])
    labels = np.asarray(result["label"].values, np.int64)
    ended = {int(number): (low, high) for number, low, high in kept("ended", real).tolist()}
    return Attractors(osc, tuple(numbers), starts, labels, settings, ended, evidence)


def _settings_of(result: xr.Dataset) -> SettleSettings:
    text: Any = result.attrs.get("settings")
    try:
        return SettleSettings(**json.loads(text))
    except (TypeError, ValueError) as error:
        raise ValueError(
            f"result must be a dataset of Attractors.to_dataset, which tells its settings, got {shown(text)}"
        ) from error
