"""Readings of the article and ways to draw its diagrams."""

import numpy as np
import pytest

import gearpair as gp
from gearpair import article
from gearpair.article import case
from gearpair.article.case.trials import MAX_PERIOD
from gearpair.methods import Integrator
from gearpair.motion import periodic


def test_the_enumeration_is_complete_and_without_repeats():
    everything = case.all_hypotheses()
    assert len(everything) == len(set(everything)) == 2 * 2 * 4 * (2 * 2 * 3 - 2 + 1)
    assert article.PRINTED in everything and article.SWAPPED in everything
    assert len({str(h) for h in everything}) == len(everything)


def test_the_printed_reading_is_the_librarys_default():
    assert article.PRINTED.oscillator(0.9, 0.01) == gp.Oscillator(mesh_frequency=0.9, damping_ratio=0.01)


def test_the_swapped_reading_is_the_librarys():
    assert article.SWAPPED.oscillator() == gp.Oscillator(stiffness=gp.StiffnessWave.rectangular(reading="swapped"))


@pytest.mark.parametrize("hypothesis", case.all_hypotheses()[::7], ids=str)
def test_the_equation_is_the_one_that_the_words_say(hypothesis):
    osc = hypothesis.oscillator(1.3, 0.02)
    stiff = 0.68 if hypothesis.stiff_for == "eps - 1" else 0.32
    mean = stiff * 1.116 + (1.0 - stiff) * 0.586
    factor = {"2 zeta": 1.0, "zeta": 0.5, "2 zeta sqrt(mean)": np.sqrt(mean)}[hypothesis.damping]
    assert osc.damping_ratio == pytest.approx(0.02 * factor, rel=1e-14)
    amplitude = 0.2 * (1.3**2 if hypothesis.force == "Omega^2" else 1.0)
    tau = np.linspace(0.0, osc.period, 50)
    expected = 0.1 + amplitude * np.sin(1.3 * tau + np.radians(hypothesis.phase))
    np.testing.assert_allclose(osc.force(tau), expected, atol=1e-12)
    if hypothesis.shape == "first harmonic":
        return
    longest = osc.stiffness.durations[np.argmax(osc.stiffness.levels)]
    assert longest == pytest.approx(stiff)
    assert (osc.stiffness.levels[0] > osc.stiffness.levels[1]) == (hypothesis.first == "stiff")
    ratio = max(osc.stiffness.levels) / min(osc.stiffness.levels)
    assert ratio == pytest.approx(1.116 / 0.586)
    if hypothesis.mean == "one":
        assert osc.stiffness.mean == pytest.approx(1.0)


def test_soft_first_is_stiff_first_seen_later():
    """Beginning with the other interval is a shift of time by 0.32 of the period, so of the phase by 115.2 degrees."""
    stiff_first = article.Hypothesis(stiff_for="2 - eps", phase=30.0).oscillator(1.0)
    soft_first = article.Hypothesis(stiff_for="2 - eps", first="soft", phase=30.0 + 360.0 * 0.32).oscillator(1.0)
    seen = gp.trajectory(stiff_first, 0.3, 0.1, 4, samples_per_period=25)
    later = gp.trajectory(soft_first, seen.x[8], seen.v[8], 3, samples_per_period=25)
    np.testing.assert_allclose(later.x, seen.x[8:84], rtol=0, atol=1e-9)


@pytest.mark.parametrize("seeding", ["up", "down", "restart"])
def test_many_sweeps_side_by_side_are_the_sweeps_one_by_one(seeding):
    protocol = case.Protocol(seeding, None, 1.0, 0.0)
    side_by_side = case.periods([article.PRINTED, article.SWAPPED], protocol, "mesh_frequency", 21)
    values = case.axis("mesh_frequency", 21)
    order = values[::-1] if seeding == "down" else values
    for row, hypothesis in zip(side_by_side, (article.PRINTED, article.SWAPPED), strict=True):
        alone = gp.sweep(
            hypothesis.oscillator(), "mesh_frequency", order, seeding="restart" if seeding == "restart" else "carry",
            max_period=MAX_PERIOD, n_exponent=20, n_watch=0, n_samples=MAX_PERIOD,
        ).sortby("mesh_frequency")  # fmt: skip
        np.testing.assert_array_equal(row, alone.period.values)


def test_trials_are_ranked_and_one_per_pair():
    done = case.run_trials([article.PRINTED, article.SWAPPED], case.all_protocols([(0.0, 0.0), (1.0, 0.0)]), 21)
    assert len(done) == 2 * 3 * 2
    totals = [t.total for t in done]
    assert totals == sorted(totals, reverse=True)
    ranked = case.ranking(done)
    assert {r.hypothesis for r in ranked} == {article.PRINTED, article.SWAPPED}
    for entry in ranked:
        own = [t.total for t in done if t.hypothesis == entry.hypothesis]
        assert entry.best.total == max(own)
        assert entry.mean == pytest.approx(np.mean(own))


def test_many_starts_find_both_period_one_and_period_three():
    """At zeta = 0.0075 the swapped reading has a period-1 and a period-3 motion; zeta = 0.02 has period 1 alone."""
    swapped, printed = case.reached([article.SWAPPED, article.PRINTED], "damping_ratio", 5)
    assert {periodic(1), periodic(3)} <= swapped.motions[1]
    assert swapped.within("D5") == 1.0
    assert swapped.coverage > printed.coverage


def test_random_tables_repeat_with_their_seed_and_differ_without():
    first = case.random_tables("mesh_frequency", 5, seed=3)
    assert first == case.random_tables("mesh_frequency", 5, seed=3)
    assert first != case.random_tables("mesh_frequency", 5, seed=4)
    assert all(s.total < 0.99 for s in first)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: article.Hypothesis(stiff_for="eps"), "stiff_for must be one of"),
        (lambda: article.Hypothesis(phase=float("nan")), "phase must be"),
        (lambda: case.Protocol("sideways"), "seeding must be one of"),
        (lambda: case.Protocol("up", 0), "n_discarded must be"),
        (lambda: case.axis("zeta", 3), "one of 'mesh_frequency', 'damping_ratio'"),
        (lambda: article.SWAPPED.along("contact_ratio", [1.5]), "one of 'mesh_frequency', 'damping_ratio'"),
    ],
)
def test_bad_input_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_runge_kutta_at_a_tight_tolerance_draws_what_the_exact_flow_draws():
    protocol = case.Protocol("down", 300, 1.0, 0.0)
    (drawn,) = case.run_trials([article.SWAPPED], [protocol], 21, [Integrator(rtol=1e-9)])
    (exact,) = case.run_trials([article.SWAPPED], [protocol], 21)
    assert drawn.damping.agreement == pytest.approx(exact.damping.agreement, abs=0.1)
    assert drawn.frequency.agreement == pytest.approx(exact.frequency.agreement, abs=0.1)


def test_runge_kutta_at_a_loose_tolerance_draws_noise():
    (loose,) = case.run_trials([article.SWAPPED], [case.Protocol("down", 100)], 21, [Integrator(rtol=1e-3)])
    assert loose.frequency.agreement < 0.4


def test_an_integrator_needs_a_number_of_periods_to_discard():
    with pytest.raises(ValueError, match="n_discarded must be"):
        case.run_trials([article.SWAPPED], [case.Protocol("up", None)], 5, [Integrator(steps=20)])


def test_waves_of_other_lengths_are_followed_side_by_side():
    """One harmonic is a staircase of many levels; among rectangles each reading gives what it gives alone."""
    mixed = [article.SWAPPED, article.Hypothesis(shape="first harmonic"), article.PRINTED]
    together = case.periods(mixed, case.Protocol("restart", 50), "damping_ratio", 5)
    for hypothesis, row in zip(mixed, together, strict=True):
        np.testing.assert_array_equal(
            case.periods([hypothesis], case.Protocol("restart", 50), "damping_ratio", 5)[0], row
        )
    assert [each.hypothesis for each in case.reached(mixed, "damping_ratio", 2, n_discarded=50)] == mixed


def test_damping_of_the_wave_s_own_mean():
    """With a wave of mean one it is the article's own convention; the swapped wave has mean 0.7556."""
    own = article.Hypothesis(stiff_for="2 - eps", damping="2 zeta sqrt(mean)")
    assert own.oscillator().damping_ratio == pytest.approx(0.02 * np.sqrt(0.7556))
    one = article.Hypothesis(mean="one", damping="2 zeta sqrt(mean)")
    assert one.oscillator().damping_ratio == pytest.approx(0.02, rel=1e-14)


def test_one_harmonic_keeps_the_mean_and_the_first_harmonic():
    rectangle, harmonic = article.SWAPPED.wave, article.Hypothesis(stiff_for="2 - eps", shape="first harmonic").wave
    assert harmonic.mean == pytest.approx(rectangle.mean, rel=1e-14)
    assert abs(harmonic.harmonics(1)[1]) == pytest.approx(abs(rectangle.harmonics(1)[1]), rel=0.01)
    assert abs(harmonic.harmonics(2)[2]) < 1e-12


def test_starts_are_scored_like_readings():
    done = case.run_trials([article.SWAPPED], case.all_protocols([(0.0, 0.0), (2.0, 0.6)]), 11)
    rows = case.score_by_start(done).rows
    assert sorted(row[0] for row in rows) == ["(0, 0)", "(2, 0.6)"]
    totals = [trial.total for trial in done if (trial.protocol.x, trial.protocol.v) == (0.0, 0.0)]
    assert f"{np.mean(totals):.2f}" in [row[1] for row in rows] and f"{max(totals):.2f}" in [row[2] for row in rows]


def test_each_choice_has_its_place_and_mean():
    ranked = case.ranking(case.run_trials([article.PRINTED, article.SWAPPED], [case.Protocol("down")], 21))
    rows = {(row[0], row[1]): row for row in case.score_by_choice(ranked).rows}
    assert rows["stiff for", "2 - eps"][2] == "1"
    assert rows["stiff for", "eps - 1"][2] == "2"
    assert rows["phase", "sin"][2] == "1"
