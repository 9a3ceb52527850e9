"""The page's chart is the library's: motions, loads, standards, speeds to avoid, the verdict's words, and the file."""

from typing import Any

import numpy as np
import pytest

from gearpair import GearDrive, SpurPair, design
from gearpair.drive_file import read_drive_file
from gearpair.parameters import check_parameters
from gearpair.teeth import GearBlank
from tests.support.engines import CHART, run_in_chart
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
State = dict[str, Any]
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


def drive_of(state: State) -> GearDrive:
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
    answer = run_in_chart(DRAW, {"state": state, "count": 40, "nStarts": 3})
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
    ranges = answer["told"]["avoid"]
    assert [each["why"] for each in ranges] == [each.why for each in told.avoid]
    for end in ("lower", "upper"):
        close([each[end] for each in ranges], [getattr(each, end) for each in told.avoid], 1e-9)
    assert answer["told"]["rule"] == told.rule
    assert answer["told"]["sentences"] == list(told.sentences)


def test_the_stored_table_is_what_the_library_writes():
    assert (CHART / "data.js").read_text(encoding="utf-8") == chart_data.text()
    assert "flexibility" in chart_data.text()


REFUSED = [
    *({name: value} for name in ("module_mm", "face_width_mm", "backlash_um") for value in (0.0, -2.5, "2,5")),
    *({"pinion_teeth": value} for value in (2, 28.5, "x")),
    *({"gear_teeth": value} for value in (-1, 1e3 + 0.25)),
    *({"pinion_torque_nm": value} for value in (0.0, -120.0, 1e-400)),
    *({"transmission_error_um": -1e-5}, {"damping_ratio": -0.01}, {"damping_ratio": 101.0}, {"damping_ratio": "x"}),
    *({"pressure_angle_deg": 90.0}, {"pressure_angle_deg": 0.0}, {"pressure_angle_deg": "20 deg"}),
    *({"pinion_added_inertia_kg_m2": -1.0}, {"base_pitch_um": -1.0}, {"profile_um": "fine"}, {"backlash": "radial"}),
    *({"lowest_rpm": 0.0}, {"highest_rpm": -1e20}, {"lowest_rpm": 500, "highest_rpm": 100}),
    *({"bore_ratio": 0.99}, {"bore_ratio": -0.1}, {"pinion_shift": 1.4, "pinion_teeth": 12}),
    *({"pressure_angle_deg": 40.0}, {"pinion_teeth": 200, "bore_ratio": 0.983}),
    *({"pinion_teeth": 5}, {"pinion_shift": -0.9, "gear_shift": -0.9}, {"pinion_shift": "half"}, {"gear_shift": -3.0}),
]  # fmt: skip
REFUSE = """(states) => states.map((state) => {
  try { gearpair.use("chart/drive").driveOf(state); return null; } catch (refusal) { return refusal.message; }
})"""
CHAPTER = [name for name in DEFAULTS if name not in ("addendum", "clearance")]


@pytest.mark.parametrize("change", REFUSED, ids=str)
def test_refusals_are_the_chapter_s(change):
    state = DEFAULTS | change
    with pytest.raises(ValueError) as refusal:
        check_parameters({name: state[name] for name in CHAPTER})
    assert run_in_chart(REFUSE, [state]) == [str(refusal.value)]


def test_what_may_stand_in_a_field():
    read = """([name, texts]) => {
      const { read, FIELDS } = gearpair.use("chart/drive");
      return texts.map((text) => read(FIELDS.find((field) => field.name === name), text));
    }"""
    assert run_in_chart(read, ["module_mm", [" 2.5 ", "1e-3", ".5", "-3.", "2,5", "0x10", "", "1_0"]]) == [
        *(2.5, 1e-3, 0.5, -3.0, "2,5", "0x10", None, "1_0")
    ]  # fmt: skip
    assert run_in_chart(REFUSE, [DEFAULTS | {"module_mm": None}]) == ["module_mm is needed (module)"]


def test_numbers_are_written_as_python_writes_them():
    values = [0.0, -0.5, 1e-5, 1.5e-4, 123456.0, 1234567.0, 1e15, 1e16, 1e22, 0.1 + 0.2, 2.5, 3.5, 1e-7, 99.95, 5e-324]
    values += np.random.default_rng(3).lognormal(0.0, 8.0, 300).tolist()
    write = """(values) => {
      const { repr, general, fixed } = gearpair.use("chart/numbers");
      return values.map((x) => [repr(x), general(x), general(x, 3), fixed(x, 0), fixed(x, 2)]);
    }"""
    written = [[repr(x), f"{x:g}", f"{x:.3g}", f"{x:.0f}", f"{x:.2f}"] for x in values]
    for theirs, ours in zip(run_in_chart(write, values), written, strict=True):
        assert theirs[:3] == ours[:3]
        if 0.0 <= float(ours[3]) < 1e21 and not ours[0].startswith("-"):  # beyond, no number of the page
            assert theirs == ours


FILE = """(state) => {
  const d = gearpair.use("chart/drive"), f = gearpair.use("chart/file");
  const back = f.parse(f.format(state));
  return { yaml: f.yaml(state), speeds: d.speedsOf(d.driveOf(state), 121), back };
}"""


@pytest.mark.parametrize("change", [*CHANGES, {"highest_rpm": 2500.0, "damping_ratio": 1e-05}], ids=str)
def test_pair_yml_brings_the_drive_back(change, tmp_path):
    state = DEFAULTS | change
    made = run_in_chart(FILE, state)
    assert made["back"] == {"state": state, "complaints": []}
    path = tmp_path / "pair.yml"
    path.write_text(made["yaml"], encoding="utf-8")
    file = read_drive_file(path)
    drive = file.made(GearDrive)
    assert drive == drive_of(state)
    assert file.iso_deviations == {name: state[name] for name in ("base_pitch_um", "profile_um")}
    speeds = {name: file.value(name) for name in ("n_speeds", "lowest_rpm", "highest_rpm")}
    close(made["speeds"], design.chart_speeds(drive, **speeds), 1e-9)
    assert [file.value(name) for name in ("n_speeds", "n_starts", "n_phases")] == [121, 12, 8]


def test_an_address_by_hand():
    parse = '(hash) => gearpair.use("chart/file").parse(hash)'
    answer = run_in_chart(parse, "#module_mm=0&teeth=3&gear_teeth=71&backlash=thickness")
    assert answer["state"] == DEFAULTS | {"gear_teeth": 71, "backlash": "thickness"}
    assert answer["complaints"][0] == "module_mm must be a finite number above 0, got 0.0. 3 is taken."
    assert answer["complaints"][1].startswith("There is no “teeth” on this page")
