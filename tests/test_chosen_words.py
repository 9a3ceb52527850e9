"""Sentences of the chapters that follow the result: one cell each, run on results that differ."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

import gearpair as gp
from gearpair.drive_file import read_drive_file
from tests.support.notebooks import glued, run_cell


@pytest.mark.parametrize(
    ("teeth", "start"),
    [
        ((34, 34), "On either gear they part near the base circle."),
        ((20, 80), "On the pinion they part near the base circle; on the gear that circle lies inside the root circle"),
        ((80, 20), "On the gear they part near the base circle; on the pinion that circle lies inside the root circle"),
        ((54, 60), "On either gear the base circle lies inside the root circle"),
    ],
)
def test_where_the_roots_of_the_drawn_teeth_part(teeth, start):
    assert glued("tooth_bending", "tooth-bendi-005-roots", pair=gp.SpurPair(*teeth))["roots"].startswith(start)


@pytest.mark.parametrize(
    ("bore", "foundation", "other", "words"),
    [(0.3, True, "0.6", "stiffer by"), (0.6, True, "0.3", "softer by"), (0.6, False, "0.3", "Nothing changes")],
)
def test_another_bore_is_told_as_it_comes_out(bore, foundation, other, words):
    pair = gp.SpurPair(bore_ratio=bore)
    made = {"root": "trochoid", "foundation": foundation, "coupling": "summed"}
    texts = glued(
        "tooth_bending", "tooth-bore-b", pair=pair, bore_ratio=bore, mesh=gp.mesh_stiffness(pair, **made), **made
    )
    assert texts["other_bore"] == other and words in texts["bored"]


@pytest.mark.parametrize(("weak", "word"), [(0.005, "weaker"), (0.02, "the same"), (0.1, "stronger")])
def test_the_other_damping_is_called_what_it_is(weak, word):
    texts = glued("impacts", "impacts-less", weak_damping=weak, damping_ratio=0.02)
    assert texts["weaker"] == f"{word} damping"


GENTLE, HARSH, OTHER = ("period 2", 0.2, 1.5, 2), ("period 1", -3.4, 3.2, 1), ("period 1", -2.6, 3.3, 1)
CHAOS, CHAOS_AGAIN = ("chaos", -2.1, 3.0, None), ("chaos", -2.3, 3.1, None)


@pytest.mark.parametrize(
    ("ways", "said", "not_said"),
    [
        ((GENTLE, GENTLE, HARSH), "So claim I5 holds for the start", "slow ways end in period 2 and"),
        ((HARSH, GENTLE, HARSH), "So claim I5 holds here", "does not show"),
        ((HARSH, HARSH, HARSH), "here the past does not show", "claim I5"),
        ((HARSH, HARSH, OTHER), "So claim I5 holds for the start", "All three"),  # two motions with one name
        ((CHAOS, CHAOS, CHAOS_AGAIN), "here the past does not show", "claim I5"),
    ],
)
def test_whether_the_past_shows_is_read_from_the_three_ways(ways, said, not_said):
    names = ("sped up", "slowed down", "from (-2, 1.5)")
    histories = {
        name: SimpleNamespace(motion=motion, x_min=low, x_max=high, period=period)
        for name, (motion, low, high, period) in zip(names, ways, strict=True)
    }
    ended = dict.fromkeys(names, ("an escape", 0.0, 0.0))
    told = glued("impacts", "impacts-ways", histories=histories, ended=ended)["ways"]
    assert said in told and not_said not in told


@pytest.mark.parametrize(
    ("x", "state", "damping", "said"),
    [
        (
            1.5,
            ("periodic", 1),
            0.02,
            "The energy steps at the switches at which the teeth are pressed, and in the figure",
        ),
        (0.5, ("periodic", 1), 0.02, "and in the figure they are so at none"),
        (1.5, ("escaped", None), 0.02, "The motion of the figure escapes."),
        (0.5, ("aperiodic", None), 0.0, "Without damping no motion settles"),
    ],
)
def test_where_the_energy_steps(x, state, damping, said):
    osc = gp.Oscillator()
    tau = np.linspace(0.0, osc.period, 101)
    settled = SimpleNamespace(status=state[0], period=state[1])
    results = {"wave": osc.stiffness, "osc": osc, "state": settled, "shown": 1, "damping_ratio": damping}
    texts = glued("others", "others-28-told", motion=SimpleNamespace(tau=tau, x=np.full(101, x)), **results)
    assert said in texts["steps"]


@pytest.mark.parametrize(
    ("force", "lost", "share", "left_out"),
    [(0.1, 0, "too little for a torque meter", "none escapes"), (3.0, 2, ", enough for", "2 of the 5 speeds")],
)
def test_what_a_torque_meter_notices_and_which_speeds_are_left_out(force, lost, share, left_out):
    works = np.ones((5, 3))
    works[:lost] = np.nan
    results = {"soft": 0.6, "stiff": 1.1, "slow": 0.1, "works": works, "n_values": 5}
    texts = glued("others", "others-32", mean_force=force, **results)
    assert share in texts["share"] and left_out in texts["left_out"]


@pytest.mark.parametrize(("ratio", "said"), [(1.68, "at each of the three"), (1.0005, "it does not take the limit")])
def test_whether_the_damper_takes_the_limit_is_seen(ratio, said):
    wave = gp.StiffnessWave.rectangular(ratio)
    soft, stiff = sorted(wave.levels)
    osc = gp.Oscillator(stiffness=wave)
    slow = osc.mean_force**2 * (soft + stiff) / 2 * (1 / soft - 1 / stiff) ** 2
    assert said in glued("others", "others-43", osc=osc, slow=slow)["at_limit"]


@pytest.mark.parametrize(
    ("captured", "said", "not_said"),
    [
        ([100.0] * 30, "Half of the motions are captured after about 100, which needs no nine digits", "%"),
        ([100.0] * 20, "Of the motions 66.7% were captured, half of them after about 100", "Half of the motions"),
        ([900.0] * 30, "Half of the motions are captured after about 900. One in twenty", "nine digits"),
        ([], "None of the motions was seen to be captured.", "nan"),
    ],
)
def test_how_long_is_long_enough_is_told_of_what_was_captured(captured, said, not_said):
    plane = SimpleNamespace(settling_time=np.empty(30))
    results = {"captured": np.array(captured), "plane": plane, "needed": 446.0}
    told = glued("damping_sweep", "ex-damping-how-long-told", **results)["captured"]
    assert said in told and not_said not in told


@pytest.mark.parametrize(
    ("statuses", "upper", "said"),
    [
        (["periodic"] * 3 + ["other state"], 0.025, "but not each to one impact state"),
        (["periodic"] * 3, 0.025, "Nothing happens on the way: from end to end and back the sweeps keep to period 2."),
        (["periodic"] * 3, 0.01, "ranges narrower than 0.0005"),
        (["periodic", "aperiodic", "periodic"], 0.025, "but for chaos"),
    ],
)
def test_what_the_sweeps_met_on_the_way(statuses, upper, said):
    states = SimpleNamespace(values=["double"] * 2 + ["single_drive" if "other state" in statuses else "double"])
    swept = SimpleNamespace(status=SimpleNamespace(values=np.array(statuses[:3])), impact_state=states)
    found = [SimpleNamespace(motion="period 2", lower=0.0005, upper=upper)]
    results = {"falling": [swept], "rising": [swept], "found": found, "narrowest": 0.0005}
    texts = glued("damping_sweep", "damping-carried-told", dampings=np.array([0.0005, 0.01, 0.025]), **results)
    assert said in texts["carried"]


@pytest.mark.parametrize(("entropy", "above"), [(0.6934, "none of them"), (0.76, '"other reading"')])
def test_a_boundary_is_called_fractal_by_the_number_that_the_table_shows(entropy, above):
    shares = SimpleNamespace(
        attractor_share=xr.DataArray([0.6, 0.4]), attractor_impact_state=["double", "single_drive"]
    )
    mixed = [SimpleNamespace(entropy=0.2, boundary_entropy=value) for value in (0.4, entropy, 0.5)]
    planes = {"plane": shares, "swapped": shares, "weaker": shares, "less": "weaker damping", "entropies": mixed}
    assert glued("impacts", "cell30", **planes)["above"] == above


@pytest.mark.parametrize(
    ("factors", "said", "damping"),
    [
        (
            [[4.0, 6.0], [3.0, 7.0], [2.0, 6.0]],
            "done by the backlash: it takes the largest factor of the runs from 5.00 to",
            "6.00",
        ),
        ([[4.0, 6.0], [5.0, 5.0], [2.0, 6.0]], "nothing that was tried makes the largest factor", "6.00"),
        ([[4.0, 6.0], [np.nan, 5.5]], "nothing that was tried makes", ""),  # a drive without damping
    ],
)
def test_what_helps_is_said_as_it_came_out(factors, said, damping):
    names = ["pinion_torque_nm", "backlash_um", "damping_ratio"][: len(factors)]
    found = xr.Dataset(
        {"dynamic_factor": (("change", "end"), factors), "base_dynamic_factor": 5.0},
        {"change": names, "end": ["low", "high"]},
    )
    design = SimpleNamespace(sensitivity=lambda *_: found)
    texts = glued("speed_chart", "changes-told", design=design, plotting=gp.plotting, drive=None, speeds=np.arange(4))
    assert said in texts["most"] and damping in texts["damped"] and bool(damping) == bool(texts["damped"])


@pytest.mark.parametrize(
    ("counts", "said"),
    [
        ((19, 4, 46, 48), "slow is worst: the slowest, of 20 ms, ends in a louder motion at 48 of 48 moments"),
        ((30, 20, 10, 5), "Here it holds: the slowest"),
        ((5, 48, 0, 10), "Here it does not: the slowest, of 20 ms, ends in a louder motion at 10 of 48 moments, the"),
        ((0, 0, 0, 0), "none of them ends in a louder motion"),
        ((48, 48, 48, 48), "Here it does not"),
    ],
)
def test_whether_a_slow_tip_in_is_gentle_is_counted(counts, said):
    names = ("0.5", "2", "5", "20")
    loud = {f"tip-in in {name} ms": np.arange(48) < n for name, n in zip(names, counts, strict=True)}
    results = {"tip_in_seconds": 0.005, "loud_after": loud, "told": {"moments": "48"}}
    assert said in glued("in_service", "service-gentler", **results)["gentler"]


@pytest.mark.parametrize(
    ("shares", "said"),
    [
        (
            [0.0, 0.0, 0.25, 1.0, 1.0],
            "none parts up to 2000 rpm (so of a whole series at most 2.8%, at 95 %), 25% do at",
        ),
        ([0.5, 0.0, 0.25, 0.0, 0.0], "some part at the lowest speed, and the most, 50%, at 1000 rpm"),
        ([0.0, 0.0, 0.0, 0.0, 0.0], "none parts at any speed (so of a whole series at most 2.8%, at 95 %)"),
    ],
)
def test_up_to_which_speed_no_box_parts_is_told_with_what_that_says_of_a_series(shares, said):
    high = np.maximum(shares, 1.0 - 0.025 ** (1.0 / 128))  # Clopper and Pearson, none of 128
    columns = {"parting_share": ("speed", shares), "parting_share_high": ("speed", high)}
    boxes = xr.Dataset(columns, {"speed": 1000.0 * np.arange(1, 6), "box": np.arange(128)})
    assert said in glued("in_service", "service-boxes-words", boxes=boxes)["boxes"]


@pytest.mark.parametrize(
    ("jumps", "phases", "said"),
    [
        (
            (3500.0, 1500.0),
            (0.0, 0.0, 0.25, 0.0),
            "a drop of 10% at 3000 rpm (jump up at 3500); a drop or rise of 5% at",
        ),
        ((np.nan, np.nan), (0.0, 0.5, 0.5, 0.0), "Next to no jump"),
    ],
)
def test_what_is_enough_next_to_a_jump(jumps, phases, said):
    margin = xr.Dataset(
        {
            "shock_margin": ("speed", [np.nan, 0.9, 0.1, np.nan]),
            "dip_back": ("speed", [np.nan, 0.05, 0.3, np.nan]),
            "surge_back": ("speed", [np.nan, 0.2, np.nan, np.nan]),
            "shock_phase": ("speed", list(phases)),
        },
        {"speed": [1000.0, 2000.0, 3000.0, 4000.0]},
    )
    where = np.full((2, 8), np.nan)
    where[0, 6], where[1, 2] = jumps
    chart = xr.Dataset(
        {"jump_speed": (("run", "speed"), where)}, {"run": ["up", "down"], "speed": 500.0 * np.arange(1, 9)}
    )
    assert said in glued("in_service", "service-margin-words", margin=margin, chart=chart)["towards"]
    moment = "another" if phases[1] != phases[2] else "the same"
    step = {"margin": margin, "tried": margin.shock_margin.values, "grid": margin.speed.values}
    told = glued("in_service", "service-margin-leap", **step)["leap"]
    assert f"from 90% to 10% between 2000 and 3000 rpm, and {moment} moment" in told


@pytest.mark.parametrize(
    ("service", "motions", "margins", "said"),
    [
        (None, (1, 1, 1), (), ""),
        ((100, 300), (1, 1, 2), (np.nan, np.nan, 0.2), "from 100 to 300 rpm, a drop by 20% is enough, at 300 rpm"),
        (
            (100, 200),
            (1, 1, 2),
            (np.nan, np.nan, 0.2),
            "from 100 to 200 rpm, one motion alone was found at every speed tr",
        ),
        ((100, 300), (1, 2, 1), (np.nan,) * 3, "but no dip that was tried ends the quietest"),
        ((110, 120), (2, 2, 2), (0.3, 0.2, 0.1), "from 110 to 120 rpm, no speed was tried"),
        ((50, 300), (2, 2, 2), (0.3, 0.1, 0.2), "a drop by 10% is enough, at 200 rpm (not all of that was tried)"),
    ],
)
def test_which_blow_is_enough_at_the_speeds_of_service(service, motions, margins, said):
    over = {"n_motions": ("speed", list(motions)), "shock_margin": ("speed", list(margins) or [np.nan] * 3)}
    given = {"margin": xr.Dataset(over, {"speed": [100.0, 200.0, 300.0]}), "low": 100.0, "high": 300.0}
    texts = glued("in_service", "service-range", service_rpm=service, found={"least": "none"}, **given)
    assert texts["least"] == "none" if service is None else said in texts["least"]


def test_a_file_s_counts_are_those_of_the_speed_chart(tmp_path):
    """What it does not say stays as the parameters have it."""
    path = tmp_path / "pair.yml"
    gp.GearDrive.from_pair(
        gp.SpurPair(), pinion_torque_nm=90.0, backlash_um=80.0, transmission_error_um=2.0, damping_ratio=0.05
    ).to_file(path)
    with path.open("a") as file:
        file.write("n_phases: 3\nn_speeds: 15\n")
    own = {"lowest_rpm": None, "highest_rpm": None, "base_pitch_um": 8.0, "profile_um": 8.0}
    given = own | {"read_drive_file": read_drive_file, "n_starts": 5, "n_speeds": 161}
    names = run_cell("speed_chart", "cell-03-file", drive=str(path), **given)
    assert names["counts"] == {"n_starts": 5, "n_phases": 3}
    assert (names["n_speeds"], names["service_rpm"]) == (15, None)
