"""The page's chart is the library's: motions, loads, standards, speeds to avoid, the verdict's words, and the file."""

from typing import Any

import numpy as np
import pytest

from gearpair import GearDrive, SpurPair, design
from gearpair.parameters import check_parameters
from gearpair.study.drive_answer import answer
from gearpair.teeth import GearBlank
from tests.support.chart_pages import CHART, run
from tools import chart_data

DEFAULTS = {
    field["name"]: field["value"] for group in chart_data.data()["groups"] for field in group["fields"]
}  # fmt: skip
CHANGES = [
    {},
    {"pinion_shift": 0.3, "gear_shift": 0.1, "backlash": "circumferential", "gear_added_inertia_kg_m2": 0.01},
    {"transmission_error_um": 0.0, "damping_ratio": 0.1, "bore_ratio": 0.0},
    {"pinion_teeth": 25, "gear_teeth": 71, "module_mm": 2.0, "backlash": "thickness", "pinion_torque_nm": 60.0},
    {"addendum": 1.3, "pinion_teeth": 40, "pressure_angle_deg": 17.5, "backlash_um": 20.0, "lowest_rpm": 2000.0},
    {"gear_shift": 0.4, "profile_um": 3.0, "pinion_torque_nm": 900.0, "transmission_error_um": 1.0},
]
DRAW = """({ state, count, nStarts }) => {
  const d = gearpair.use("chart/drive"), v = gearpair.use("chart/verdict"), s = gearpair.use("chart/standards");
  const drive = d.driveOf(state), speeds = d.speedsOf(drive, count), phases = d.phasesOf(drive);
  const { rows } = gearpair.use("chart/motions");
  const seen = phases.map((phase) => [...rows({ drive, speeds, phase, nStarts })].filter(Boolean));
  const chart = v.columnsOf(drive, speeds, phases, seen);
  const iso = s.isoFactors(drive, speeds);
  const factor = s.linearFactors(drive);
  const linear = speeds.map((rpm) => factor(d.oscillatorAt(drive, rpm, phases[chart.chosen])));
  return { chart, iso, linear, told: v.verdictOf(chart, iso.factors), resonance: drive.resonance };
}"""
NAMES = {"factor": "dynamic_factor", "apart": "time_apart", "meshForce": "mesh_force", "toothForce": "tooth_force"}
NAMES |= {"rate": "impact_rate", "velocity": "impact_velocity", "rms": "dte_rms"}


def drive_of(state: dict[str, Any]) -> GearDrive:
    """The chapter's own way from its parameters to a drive."""
    own = ("pinion_teeth", "gear_teeth", "module_mm", "face_width_mm", "pressure_angle_deg", "addendum", "clearance")
    pair = SpurPair(**{name: state[name] for name in (*own, "pinion_shift", "gear_shift", "bore_ratio")})
    return GearDrive.from_pair(
        pair,
        pinion_torque_nm=state["pinion_torque_nm"],
        backlash_um=pair.normal_backlash_um(state["backlash_um"], state["backlash"]),
        transmission_error_um=state["transmission_error_um"],
        damping_ratio=state["damping_ratio"],
        pinion_blank=GearBlank(added_inertia_kg_m2=state["pinion_added_inertia_kg_m2"]),
        gear_blank=GearBlank(added_inertia_kg_m2=state["gear_added_inertia_kg_m2"]),
    )


def close(found: Any, expected: Any, most: float) -> None:
    """Equal to a share of the larger, nan where nan."""
    pair = np.array([np.nan if x is None else x for x in found], float), np.asarray(expected, float)
    np.testing.assert_allclose(*pair, rtol=most, atol=most)


@pytest.mark.slow
@pytest.mark.parametrize("change", CHANGES, ids=range(len(CHANGES)))
def test_forty_speeds_of_a_drawing(change):
    state = DEFAULTS | change
    answer = run(DRAW, {"state": state, "count": 40, "nStarts": 3})
    drive = drive_of(state)
    speeds = np.array(answer["chart"]["speeds"])
    chart = design.speed_chart(drive, speeds, n_starts=3, locate_jumps=False)
    iso = design.iso_dynamic_factor(drive, speeds, **{name: state[name] for name in ("base_pitch_um", "profile_um")})
    assert answer["resonance"] == pytest.approx(drive.resonance_rpm, rel=1e-9)
    assert answer["chart"]["phases"][answer["chart"]["chosen"]] == pytest.approx(chart.attrs["run_phase_rad"])
    assert answer["iso"]["outside"] == iso.outside_range
    close(answer["iso"]["factors"], iso.k_v, 1e-9)
    close(answer["linear"], chart.linear_factor, 1e-9)
    for run_name in ("up", "down", "worst"):
        found, there = answer["chart"][run_name], chart.sel(run=run_name)
        assert [each["impact"] for each in found] == there.impact_state.values.tolist()
        assert [each["period"] or 0 for each in found] == there.period.values.tolist()
        periodic = [i for i, each in enumerate(found) if each["period"]]
        for name, theirs in NAMES.items():
            close([found[i][name] for i in periodic], there[theirs].values[periodic], 1e-7)
    assert answer["chart"]["loss"] == chart.loss.values.tolist()
    told = design.verdict(chart, iso)
    ranges = [(each["lower"], each["upper"], each["why"]) for each in answer["told"]["avoid"]]
    assert [each[2] for each in ranges] == [each.why for each in told.avoid]
    close([end for each in ranges for end in each[:2]], [end for each in told.avoid for end in (each.lower, each.upper)], 1e-9)  # fmt: skip
    assert answer["told"]["rule"] == told.rule
    assert answer["told"]["sentences"] == list(told.sentences)


def test_the_stored_table_is_what_the_library_writes():
    assert (CHART / "data.js").read_text(encoding="utf-8") == chart_data.text()
    assert "flexibility" in chart_data.text()
