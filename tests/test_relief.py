"""Relieved tips in a drive: stiffness and error follow the torque, and the error turns its sign with the flank."""

import dataclasses

import numpy as np
import pytest

import gearpair as gp
from gearpair.design import measure_motion, speed_chart, verdict
from gearpair.teeth import TipRelief, error_harmonics, loaded_mesh, tip_relief

PAIR = gp.SpurPair(pinion_teeth=28, gear_teeth=57, module_mm=3.0, face_width_mm=25.0)
GIVEN = dict(pinion_torque_nm=120.0, backlash_um=100.0, transmission_error_um=0.0, damping_ratio=0.05)
PLAIN = gp.GearDrive.from_pair(PAIR, **GIVEN)
SUNK = PLAIN.mean_force_n / PLAIN.mean_stiffness_n_per_um
RELIEF = TipRelief(SUNK, SUNK, 1.0 / 3.0)
DRIVE = gp.GearDrive.from_pair(PAIR, **GIVEN, relief=RELIEF)


def test_a_relieved_drive_has_the_mesh_under_its_own_torque():
    found = loaded_mesh(PLAIN.mesh, tip_relief(PLAIN.mesh, SUNK, SUNK, 1.0 / 3.0), PLAIN.mean_force_n)
    assert DRIVE.loaded_mesh == found and PLAIN.loaded_mesh is None
    assert DRIVE.stiffness == found.wave(16)
    assert DRIVE.mean_stiffness_n_per_um == pytest.approx(found.mean * 1e-6, rel=1e-14)
    assert DRIVE.profile_harmonics == error_harmonics(found.error_um, 12)
    assert DRIVE.damping_ratio == pytest.approx(0.05, rel=1e-14)
    less = DRIVE.replace(pinion_torque_nm=60.0)
    assert less.mean_stiffness_n_per_um < 0.95 * PLAIN.mean_stiffness_n_per_um
    assert np.allclose(DRIVE.all_harmonics, DRIVE.profile_harmonics, rtol=1e-12)
    assert PLAIN.all_harmonics == ((1, 0.0, 0.0),)


@pytest.mark.parametrize(
    "changes",
    [
        {"pinion_torque_nm": 60.0},
        {"pinion_torque_nm": 0.0},
        {"pinion_torque_nm": -120.0},
        {"relief": TipRelief(5.0, 3.0, 0.2)},
        {"relief": None},
        {"n_levels": 24},
        {"coupling": "summed", "pinion_torque_nm": 60.0},
        {"transmission_error_um": [(1, 2.0, 0.5), (3, 0.4, -1.0)], "pinion_torque_nm": 30.0},
    ],
)
def test_a_changed_drive_is_the_drive_of_what_was_changed(changes):
    changed = DRIVE.replace(**changes)
    made = gp.GearDrive.from_pair(PAIR, **(GIVEN | {"relief": RELIEF} | changes))
    assert changed == made and changed.relief == made.relief
    assert PLAIN.replace(**({"relief": RELIEF} | changes)) == made


def test_what_is_given_by_hand_is_followed_no_longer():
    flat = DRIVE.replace(stiffness=gp.StiffnessWave((0.0,), (1.0,)), pinion_torque_nm=60.0)
    assert flat.relief is flat.mesh is flat.loaded_mesh is None
    assert flat.profile_harmonics == DRIVE.profile_harmonics
    assert flat.mean_stiffness_n_per_um == DRIVE.mean_stiffness_n_per_um
    drawn = DRIVE.replace(profile_harmonics=[(1, 2.0, 0.5)])
    assert drawn.relief is None and drawn.stiffness == PLAIN.stiffness
    assert drawn.replace(pinion_torque_nm=60.0).profile_harmonics == ((1, 2.0, 0.5),)
    turned = DRIVE.replace(pinion_torque_nm=-120.0, pinion_speed_rpm=2000.0)
    back = turned.with_oscillator(turned.oscillator())
    assert not back.profile_harmonics and back.relief is None
    assert np.allclose(back.all_harmonics, turned.all_harmonics, rtol=1e-12)
    assert back.oscillator().mean_force == pytest.approx(turned.oscillator().mean_force, rel=1e-12)


def test_the_profiles_error_turns_with_the_flank_and_the_pitch_error_does_not():
    """As functions of time: e = pitch + profile on the drive flank, pitch - profile on the coast flank."""
    drive = DRIVE.replace(transmission_error_um=[(1, 3.0, 0.4), (2, 1.0, -0.7), (15, 0.1, 0.0)], pinion_speed_rpm=2e3)
    tau = np.linspace(0.0, drive.oscillator().period, 40)
    ahead, back = (drive.replace(pinion_torque_nm=t).oscillator().error(tau) for t in (120.0, -120.0))
    pitch = dataclasses.replace(drive, profile_harmonics=()).oscillator().error(tau)
    profile = DRIVE.at_speed(2e3).oscillator().error(tau)
    assert ahead == pytest.approx(pitch + profile, abs=1e-13) and back == pytest.approx(pitch - profile, abs=1e-13)
    assert np.ptp(profile) > 0.03 and np.ptp(pitch) > 0.05


@pytest.mark.parametrize("ratio", [0.33, 0.5, 0.8, 0.92])
def test_a_relief_serves_either_sign_of_the_torque(ratio):
    """X to -X: the same motion on the other flank. Before, the relief of the drive flank was added to the coast's."""
    states = []
    for torque, side in ((120.0, 1.0), (-120.0, -1.0)):
        drive = DRIVE.replace(pinion_torque_nm=torque)
        drive = drive.at_speed(ratio * drive.resonance_rpm)
        state = gp.steady_state(drive.oscillator(), side * 1.2, 0.0)
        states.append((state, measure_motion(drive, state)))
    (ahead, loads), (back, turned) = states
    assert back.x_min == pytest.approx(-ahead.x_max, rel=1e-9) and back.x_max == pytest.approx(-ahead.x_min, rel=1e-9)
    assert turned == pytest.approx(loads, rel=1e-8)


@pytest.mark.slow
def test_the_largest_factor_of_a_relief_for_a_torque():
    """Both ways alike; with the sign of one flank on the other the factor is much larger than with no relief at all."""
    speeds = np.linspace(0.15, 1.35, 25) * PLAIN.resonance_rpm

    def largest(drive):
        return float(speed_chart(drive, speeds, n_starts=0, locate_jumps=False).dynamic_factor.max())

    turned = [harmonic._replace(phase=harmonic.phase + np.pi) for harmonic in DRIVE.profile_harmonics]
    wrong = dataclasses.replace(DRIVE, profile_harmonics=turned)
    ahead, back, plain, other = map(largest, (DRIVE, DRIVE.replace(pinion_torque_nm=-120.0), PLAIN, wrong))
    assert back == pytest.approx(ahead, rel=1e-6)
    assert ahead < 0.95 * plain and other > 1.15 * plain


def springs_with_gaps(drive, deviation_um, at_rpm, periods=120, steps=200):
    """Largest force over the mean, by Runge-Kutta, of pairs of teeth that push at every instant and never pull."""
    mean, mass, rates = drive.mean_force_n, drive.equivalent_mass_kg, np.asarray(at_rpm) * drive.pinion_teeth / 60.0
    loads = np.concatenate([[1e-3], np.geomspace(0.02, 8.0, 60)]) * mean
    approach = np.array([loaded_mesh(drive.mesh, deviation_um, load).approach_um for load in loads]).T
    grid = np.linspace(approach.min() - 1.0, approach[:, -1].min(), 600)
    rows = [np.interp(grid, one, loads, left=0.0) for one in approach]  # at each phase the force of an approach
    table = np.array([*rows, rows[0]])

    def acceleration(x_um, v, phase):
        i, down = divmod(phase * len(rows), 1.0)
        j = (x_um - grid[0]) / (grid[1] - grid[0])
        k = j.astype(int)
        low, high = (table[int(i) + n, k] + (j - k) * (table[int(i) + n, k + 1] - table[int(i) + n, k]) for n in (0, 1))
        force = low + down * (high - low)
        return (mean - drive.damping_n_s_per_m * v - force) / mass, force

    h = 1.0 / rates / steps
    x, v, largest = np.full(len(rates), approach[:, loads.searchsorted(mean)].mean()), np.zeros(len(rates)), 0.0
    for i in range(periods * steps):
        phase = i % steps / steps
        a1, force = acceleration(x, v, phase)
        a2, _ = acceleration(x + 0.5e6 * h * v, v + 0.5 * h * a1, phase + 0.5 / steps)
        a3, _ = acceleration(x + 0.5e6 * h * (v + 0.5 * h * a1), v + 0.5 * h * a2, phase + 0.5 / steps)
        a4, _ = acceleration(x + 1e6 * h * (v + 0.5 * h * a2), v + h * a3, min(phase + 1.0 / steps, 1.0 - 1e-12))
        x = x + 1e6 * h * (v + h / 6.0 * (a1 + a2 + a3))
        v = v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        largest = np.maximum(largest, force) if i >= (periods - 20) * steps else largest
    return largest / mean


@pytest.mark.parametrize("coupling", ["clamped", "ring"])
def test_a_relieved_drive_against_pairs_that_push_at_every_instant(coupling):
    """At half the torque, where the pair that enters does not touch: one and a half of the deflection, a third long.

    A drive's stiffness and error are those of its mean load; the largest load is up to 2.7 times it.
    """
    whole = gp.GearDrive.from_pair(PAIR, **GIVEN, coupling=coupling)
    amount = 1.5 * whole.mean_force_n / whole.mean_stiffness_n_per_um
    drive = whole.replace(relief=TipRelief(amount, amount, 1.0 / 3.0), pinion_torque_nm=60.0)
    speeds = np.array([0.52, 0.64, 0.76, 0.96, 1.13, 1.25]) * whole.resonance_rpm
    exact = springs_with_gaps(drive, drive.relief.deviation_um(drive.mesh), speeds)
    stiff = dataclasses.replace(drive, stiffness=whole.stiffness, mean_stiffness_n_per_um=whole.mean_stiffness_n_per_um)
    pushing, pulling = (
        speed_chart(each, speeds, n_starts=0, locate_jumps=False).dynamic_factor.sel(run="up").values
        for each in (drive, stiff)
    )
    assert pushing == pytest.approx(exact, rel=0.04)
    assert np.abs(pulling / exact - 1.0).max() > 0.2


def test_the_share_of_relieved_teeth_is_that_under_load():
    drive = DRIVE.replace(pinion_torque_nm=60.0)
    drive = drive.at_speed(0.05 * drive.resonance_rpm)
    loads = measure_motion(drive, gp.steady_state(drive.oscillator()))
    alone = (drive.loaded_mesh.load_share > 0.0).sum(axis=0) == 1
    assert alone.mean() > (drive.mesh.pairs_in_contact == 1).mean() + 0.1
    assert loads["tooth_force"] == pytest.approx(loads["mesh_force"], rel=0.02)  # a pair alone at the worst moment


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_one_error_for_both_flanks_is_marked(sign):
    """In a small gap the teeth strike both; without an error of the profile there is nothing to tell."""
    tight = DRIVE.replace(pinion_torque_nm=sign * 20.0, backlash_um=4.0, transmission_error_um=6.0, damping_ratio=0.03)
    speeds = np.array([0.3, 0.9]) * tight.resonance_rpm
    chart, plain = (
        speed_chart(each, speeds, n_starts=2, locate_jumps=False) for each in (tight, tight.replace(relief=None))
    )
    double = (chart.impact_state == "double").values
    assert double.any() and not plain.both_flanks.any() and (plain.impact_state == "double").any()
    assert np.array_equal(chart.both_flanks.values, double)
    told = [str(verdict(each)) for each in (chart, plain)]
    assert ["Where both flanks are struck, the error of the relief is" in each for each in told] == [True, False]
    assert not speed_chart(DRIVE, 0.1 * speeds, n_starts=0, locate_jumps=False).both_flanks.any()


@pytest.mark.parametrize(
    "call, kind, sentence",
    [
        (lambda: TipRelief(-1.0, 2.0, 0.3), ValueError, "pinion_um must be a finite number at least 0, got -1.0"),
        (lambda: TipRelief(1.0, 2.0, 0.0), ValueError, "length must be a finite number above 0, got 0.0"),
        (lambda: PLAIN.replace(relief=TipRelief(1.0, 1.0, 9.0)), ValueError, "length must be .* at most 1.7"),
        (lambda: PLAIN.replace(relief=8.0), TypeError, "relief must be a TipRelief"),
        (lambda: PLAIN.replace(mesh=None).replace(relief=RELIEF), ValueError, "relief can be changed only where"),
        (lambda: DRIVE.replace(pinion_torque_nm=np.nan), ValueError, "pinion_torque_nm must be a finite number"),
        (lambda: PLAIN.replace(profile_harmonics=[(0, 1.0)]), ValueError, "profile_harmonics.0. order must be"),
        (lambda: DRIVE.replace(n_levels=1), ValueError, "n_levels must be a whole number of at least"),
    ],
)
def test_bad_input_gets_a_sentence(call, kind, sentence):
    with pytest.raises(kind, match=sentence):
        call()
