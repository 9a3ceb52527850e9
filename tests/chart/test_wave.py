"""The page's own mesh stiffness is the library's: contact ratio, wave, load share, inertias, and the refusals."""

import numpy as np
import pytest

from gearpair import SpurPair, mesh_stiffness
from gearpair.teeth import GearBlank
from tests.support.engines import run_in_chart

SIZES = ("pinion_teeth", "gear_teeth", "module_mm", "face_width_mm", "pressure_angle_deg", "addendum", "clearance")
SIZES += ("pinion_shift", "gear_shift", "bore_ratio", "youngs_modulus_gpa", "poisson_ratio")
DRAWN = """(cases) => cases.map((sizes) => {
  const { SpurPair } = gearpair.use("chart/pair");
  const { meshStiffness, inertia } = gearpair.use("chart/mesh");
  let pair;
  try { pair = new SpurPair(sizes); } catch (error) { return { refusal: error.message }; }
  const { mean, edges, levels, share } = meshStiffness(pair, 16, 256);
  return { ratio: pair.contactRatio, mean, edges, levels, share: [...share],
           inertias: [inertia(pair.pinion, pair.face_width_mm), inertia(pair.gear, pair.face_width_mm)] };
})"""


def drawing(rng: np.random.Generator) -> dict[str, float]:
    """Sizes as they are drawn, and now and then as none could be."""
    shifts = rng.uniform(-0.6, 0.8, 2) if rng.random() < 0.7 else np.zeros(2)
    angle, bore = rng.choice([14.5, 17.5, 20.0, 22.5, 25.0]), rng.choice([0.0, rng.uniform(0.1, 0.9)])
    return {
        "pinion_teeth": int(rng.integers(9, 60)),
        "gear_teeth": int(rng.integers(12, 160)),
        "module_mm": float(rng.uniform(0.5, 12.0)),
        "face_width_mm": float(rng.uniform(5.0, 120.0)),
        "pressure_angle_deg": float(angle),
        "addendum": float(rng.choice([1.0, rng.uniform(0.8, 1.35)])),
        "clearance": float(rng.choice([0.25, 0.2, 0.4])),
        "pinion_shift": float(shifts[0]),
        "gear_shift": float(shifts[1]),
        "bore_ratio": float(bore),
        "youngs_modulus_gpa": 206.8,
        "poisson_ratio": 0.3,
    }


def pair_or_refusal(sizes: dict[str, float]) -> SpurPair | str:
    try:
        return SpurPair(**sizes)
    except ValueError as refusal:
        return str(refusal)


@pytest.mark.slow
def test_wave_of_three_hundred_drawings_and_every_refusal():
    rng = np.random.default_rng(24)
    cases, pairs = [], []
    while sum(isinstance(each, SpurPair) for each in pairs) < 300:
        cases.append(drawing(rng))
        pairs.append(pair_or_refusal(cases[-1]))
    worst = 0.0
    for pair, answer in zip(pairs, run_in_chart(DRAWN, cases), strict=True):
        if isinstance(pair, str):
            assert answer == {"refusal": pair}
            continue
        mesh = mesh_stiffness(pair, coupling="ring")
        wave = mesh.wave(16)
        share = mesh.load_share.max(axis=0)[(np.arange(256) / 256 * 1000).astype(int)]
        inertias = [GearBlank().inertia_kg_m2(gear) for gear in (pair.pinion, pair.gear)]
        expected = [pair.contact_ratio, mesh.mean, *wave.edges, 1.0, *wave.levels, *share, *inertias]
        found = [answer["ratio"], answer["mean"], *answer["edges"], *answer["levels"], *answer["share"]]
        found += answer["inertias"]
        assert len(found) == len(expected)
        worst = max(worst, float(np.max(np.abs(np.array(found) - expected) / np.maximum(np.abs(expected), 1e-3))))
    assert worst < 1e-9
    refused = {each.split(" = ")[0].split(" must")[0][:24] for each in pairs if isinstance(each, str)}
    assert len(refused) >= 6
