"""Ranges of motion, representatives, shares, and the article's table beside them."""

import numpy as np
import pytest
import xarray as xr

import gearpair as gp
from gearpair.article import published
from tests.support import always_in_contact

OSC = gp.Oscillator()
CHAOS, periodic = gp.motion.CHAOS, gp.motion.periodic


def made_up(motions, values, parameter="mesh_frequency"):
    """A sweep with the given periods; 0 stands for chaos."""
    periods = np.array(motions)
    return xr.Dataset(
        {
            "status": (parameter, np.where(periods > 0, "periodic", "aperiodic")),
            "period": (parameter, periods),
            "x": ((parameter, "sample"), np.zeros((len(periods), 4))),
        },
        {parameter: values},
    )


UP = made_up([1, 1, 1, 2, 0, 0, 3, 3], np.arange(8.0))
DOWN = made_up([3, 3, 3, 0, 2, 2, 1, 1], np.arange(8.0)[::-1])


def test_runs_do_not_depend_on_the_direction():
    expected = [(0, 2, periodic(1)), (3, 3, periodic(2)), (4, 5, CHAOS), (6, 7, periodic(3))]
    assert [(r.lower, r.upper, r.motion) for r in gp.ensembles.motion_ranges(UP)] == expected
    flipped = UP.isel(mesh_frequency=slice(None, None, -1))
    assert gp.ensembles.motion_ranges(flipped) == gp.ensembles.motion_ranges(UP)


def test_what_two_sweeps_saw_is_joined():
    """Each end is the one that some sweep followed the motion to; chaos has none."""
    found = [(r.lower, r.upper, r.motion) for r in gp.ensembles.found_ranges(UP, DOWN)]
    assert found == [(0, 2, periodic(1)), (2, 3, periodic(2)), (5, 7, periodic(3))]
    assert [r.motion for r in gp.ensembles.found_ranges(UP, DOWN, narrowest=1.5)] == [periodic(1), periodic(3)]


def test_of_two_runs_that_overlap_the_longer_one_counts():
    """A short run inside a long one does not shorten it, whichever sweep saw it and whichever starts first."""
    long, short = made_up([1, 1, 1, 1], [0.0, 1.0, 5.0, 9.0]), made_up([3, 1, 1, 3], [2.0, 3.0, 4.0, 5.0])
    for sweeps in ((long, short), (short, long)):
        joined = [(r.lower, r.upper) for r in gp.ensembles.found_ranges(*sweeps, narrowest=3.5)]
        assert joined == [(0.0, 9.0)]
    touching = made_up([3, 1, 1], [8.0, 9.0, 11.0])
    assert [(r.lower, r.upper) for r in gp.ensembles.found_ranges(long, touching, narrowest=3.5)] == [(0.0, 11.0)]
    apart = made_up([3, 1, 1], [8.0, 9.5, 11.0])
    assert [(r.lower, r.upper) for r in gp.ensembles.found_ranges(long, apart, narrowest=1.5)] == [
        (0.0, 9.0),
        (9.5, 11.0),
    ]


def test_a_range_just_as_wide_as_the_narrowest_stays():
    runs = made_up([1, 1, 2, 2], [0.0, 1.0, 2.0, 4.0])
    assert [(r.lower, r.upper) for r in gp.ensembles.found_ranges(runs, narrowest=1.0)] == [(0.0, 1.0), (2.0, 4.0)]
    assert [(r.lower, r.upper) for r in gp.ensembles.found_ranges(runs, narrowest=1.01)] == [(2.0, 4.0)]
    assert [r.width for r in gp.ensembles.found_ranges(runs)] == [1.0, 2.0]


def test_sweeps_over_two_parameters_are_not_joined():
    with pytest.raises(ValueError, match="over one parameter, got mesh_frequency, damping_ratio"):
        gp.ensembles.found_ranges(UP, made_up([1], [0.1], "damping_ratio"))
    with pytest.raises(ValueError, match="a result over v, x"):
        gp.ensembles.motion_ranges(gp.basins(OSC, [0.0, 1.0], [0.0, 1.0]))


def test_representatives_are_the_motions_named():
    result = gp.sweep(OSC, "mesh_frequency", [0.7, 0.71, 0.72, 0.78, 1.2, 1.21, 1.22])
    shown = gp.ensembles.representatives(OSC, result, motions=[periodic(2), periodic(17), CHAOS], near={CHAOS: 1.219})
    assert list(shown) == [periodic(2), CHAOS]  # no period 17 there
    assert shown[periodic(2)].oscillator.mesh_frequency == 0.71
    assert (shown[CHAOS].oscillator.mesh_frequency, shown[CHAOS].status) == (1.22, "aperiodic")


@pytest.mark.parametrize(
    ("values", "middle"),
    [([0.72, 0.74, 0.76, 0.78, 1.65], 0.74), ([0.74, 0.78, 1.64, 1.67, 1.7], 1.67)],
)
def test_a_representative_is_from_the_middle_of_the_widest_run(values, middle):
    """Whether the widest run of period 2 is the first or the last; the first sweep that met a motion gives it."""
    result = gp.sweep(OSC, "mesh_frequency", values)
    runs = gp.ensembles.motion_ranges(result)
    wide, narrow = sorted((run for run in runs if run.motion == runs[0].motion), key=lambda run: -run.width)
    assert wide.width > 0.03 and narrow.width == 0.0
    (shown,) = gp.ensembles.representatives(OSC, result, motions=[wide.motion]).values()
    assert shown.oscillator.mesh_frequency == middle and (shown.status, shown.period) == ("periodic", 2)
    (shown,) = gp.ensembles.representatives(
        OSC, result, motions=[wide.motion], near={wide.motion: narrow.lower}
    ).values()
    assert shown.oscillator.mesh_frequency == narrow.lower
    other = gp.sweep(OSC, "mesh_frequency", [0.73])
    (shown,) = gp.ensembles.representatives(OSC, other, result, motions=[wide.motion]).values()
    assert shown.oscillator.mesh_frequency == 0.73


def test_a_chaotic_transient_represents_nothing():
    """A motion that a short transient took for chaos is followed again and turned down when it settles."""
    osc = OSC.replace(damping_ratio=0.0075)
    result = gp.sweep(osc, "mesh_frequency", [0.7], x=0.0, v=0.0)
    result["status"] = result.status.astype("<U16")  # room for a longer word
    result["status"][:] = "aperiodic"
    assert gp.ensembles.representatives(osc, result, motions=[CHAOS]) == {}


def test_following_both_ways_keeps_to_one_motion():
    """The large period 1 of the baseline lives until contact resonates at 0.9206, where it grows without bound.

    So it does in steps of up to a fifth: the value after the last one kept is where the next step would be larger.
    """
    state = gp.steady_state(OSC, -2.0, 1.5)
    assert (state.period, state.impact_state) == (1, "double")
    falling, rising = gp.ensembles.carried_sweeps(state, "mesh_frequency", [0.68, 0.69, 0.71, 0.72])
    assert falling.mesh_frequency.values.tolist() == [0.69, 0.68]
    assert rising.mesh_frequency.values.tolist() == [0.71, 0.72]
    life = gp.ensembles.range_of(state, "mesh_frequency", np.arange(0.6, 1.0, 0.004))
    assert life.motion == periodic(1)
    (resonance,) = always_in_contact.edges(OSC, 1.0, "mesh_frequency", 0.85, 0.97)
    # |X| ~ 1 / distance from the resonance grows by a fifth in a step of 0.004 at five steps from it, by half at two.
    assert life.lower == 0.6 and resonance - 5 * 0.004 < life.upper < resonance - 0.004


def test_a_jump_to_another_motion_of_the_same_period_ends_a_life():
    """The large period 2 ends in a fold above 1.05, but the sweep falls onto the small period 2 that lives there."""
    state = gp.steady_state(OSC.replace(mesh_frequency=1.3), -2.0, 0.0)
    values = np.arange(1.04, 1.3, 0.002)
    below = gp.ensembles.carried_sweeps(state, "mesh_frequency", values)[0]
    assert below.period.values[-1] == 2 and below.x_max.values[-1] < 1.5 < state.x_max
    orbit = gp.periodic_orbit(state.oscillator, *state.points[0].tolist(), 2)
    (fold,) = [b for b in gp.continue_orbit(orbit, "mesh_frequency", 1.0, 1.4).bifurcations if b.kind == "fold"]
    life = gp.ensembles.range_of(state, "mesh_frequency", values)
    assert fold.value < life.lower < fold.value + 0.002 and life.upper == 1.3


def test_shares_count_the_starts():
    shares = gp.ensembles.motion_shares(OSC, "damping_ratio", [0.02], [-2.0, 0.0, 1.0], [0.0])
    assert shares.motion.values.tolist() == ["period 1", "period 2"]
    assert gp.motion.motions_of(shares).tolist() == [periodic(1), periodic(2)]
    assert shares.share.values.tolist() == [[1 / 3, 2 / 3]]


def test_motions_of_attractors_leave_out_small_basins():
    plane = gp.basins(OSC, np.linspace(-4, 4, 17), np.linspace(-3, 3, 13))
    motions = gp.ensembles.attractor_motions(plane, 0.1)
    assert motions == [periodic(1, gp.ImpactState.DOUBLE), periodic(2, gp.ImpactState.SINGLE_DRIVE)]
    assert len(gp.ensembles.attractor_motions(plane)) > 2


def test_an_attractor_that_just_enough_starts_reach_stays():
    """One start of three reaches period 1, two reach period 2: a least share of a third keeps both."""
    plane = gp.basins(OSC, [-2.0, 0.0, 1.0], [0.0])
    assert plane.attractor_share.values.tolist() == [1 / 3, 2 / 3]
    assert len(gp.ensembles.attractor_motions(plane)) == len(gp.ensembles.attractor_motions(plane, 1 / 3)) == 2
    assert gp.ensembles.attractor_motions(plane, 0.34) == [periodic(2, gp.ImpactState.SINGLE_DRIVE)]
    for share, periods in ((0.0, [1, 2]), (1 / 3, [1, 2]), (0.34, [2]), (0.67, [])):
        assert [state.period for state in gp.ensembles.attractor_states(OSC, plane, share)] == periods


def test_an_attractor_is_one_whichever_start_reached_it():
    """Every start of a plane that ends on an orbit gets the orbit's number; two orbits of one period get two."""
    plane = gp.basins(OSC, np.linspace(-4.0, 4.0, 9), np.linspace(-3.0, 3.0, 7))
    assert set(plane.attractor_status.values.tolist()) == {"periodic"}
    points = np.column_stack([plane.attractor_x.values, plane.attractor_v.values])
    apart = np.abs(points[:, None] - points[None]).max(axis=2) + np.eye(len(points))
    assert len(points) > 1 and np.nanmin(apart) > 1e-6
    for number in range(len(points)):
        same = plane.attractor.values == number
        assert np.ptp(plane.x_min.values[same]) < 1e-8 and np.ptp(plane.period.values[same]) == 0
    assert plane.attractor_share.values.sum() == pytest.approx(1.0)


STATED = (
    published.Range("A", "mesh_frequency", 0.0, 2.0, periodic(1)),
    published.Range("B", "mesh_frequency", 2.0, 4.0, published.COMPLEX),
    published.Range("C", "mesh_frequency", 4.0, 8.0, periodic(2)),
)
FOUND = (
    gp.ensembles.MotionRange(0.0, 1.5, periodic(1)),
    gp.ensembles.MotionRange(4.5, 6.5, periodic(2)),
    gp.ensembles.MotionRange(6.0, 8.0, periodic(4)),
)


def test_agreement_is_the_share_of_the_published_range():
    rows = gp.article.compare_ranges(STATED, FOUND, digits=1).rows
    assert [row[-1] for row in rows] == ["75%", "–", "50%"]
    assert rows[2][3] == "period 2 (4.5–6.5), period 4 (6.0–8.0)"
    assert rows[1][3] == "none this wide"
    twice = [*FOUND, gp.ensembles.MotionRange(4.0, 6.0, periodic(2))]  # by a sweep and by continuation
    row = gp.article.compare_ranges(STATED, twice, digits=1).rows[2]
    assert row[3:] == ("period 2 (4.0–6.5), period 4 (6.0–8.0)", "62%")


def test_boundaries_are_matched_by_the_same_change():
    stated = [published.Boundary("B", "mesh_frequency", 2.0, "crisis"), published.Boundary("C", "mesh_frequency", 4.0)]
    rows = gp.article.compare_boundaries(stated, STATED, FOUND, gap=1.0, digits=2).rows
    assert rows[0] == ("B", "2.00", "period 1 to complex", "crisis", "1.50", "-0.50")
    assert rows[1] == ("C", "4.00", "complex to period 2", "", "4.50", "+0.50")
    rows = gp.article.compare_boundaries(stated, STATED, FOUND[1:], gap=1.0).rows
    assert rows[0][-2:] == ("none", "–")
    assert gp.article.compare_boundaries(stated, STATED, [], gap=1.0).rows[0][-2:] == ("none", "–")


def test_attractors_are_counted_beside_the_published_motion():
    plane = gp.basins(OSC, np.linspace(-4, 4, 9), np.linspace(-3, 3, 7))
    rows = gp.article.compare_attractors(
        published.ranges("damping_ratio"), {0.02: plane, 0.03: plane}, 0.1, digits=2
    ).rows
    assert rows[0][:3] == ("0.02", "D5", "period 1") and rows[1][:3] == ("0.03", "–", "–")
    assert rows[0][3] == "period 1, double-sided; period 2, single-sided"


def test_a_table_is_aligned_and_escaped():
    table = gp.Table(["name", "value"], [["a < b", "-1.50"], ["c", "–"]])
    assert repr(table).splitlines() == ["name   value", "------------", "a < b  -1.50", "c          –"]
    html = table._repr_html_()
    assert "a &lt; b" in html and '<td style="text-align: right">-1.50</td>' in html
    with pytest.raises(ValueError, match="row 1 of the table must have 2 cells, got 1"):
        gp.Table(["a", "b"], [[1, 2], [3]])


def test_html_sets_symbols_and_keeps_intervals_together():
    html = gp.Table(
        ["Omega_h", "statement"], [["0.7–0.8", "X_min >= -1, eps = 1.68, F_m' small, zetas, pie"]]
    )._repr_html_()
    assert "Ω<sub>h</sub>" in html and "0.7&#8288;–&#8288;0.8" in html
    assert "X<sub>min</sub> ≥ -1, ε = 1.68, F<sub>m</sub>′ small, zetas, pie" in html


def test_html_sets_the_article_s_equation():
    rows = [[published.statement(item).text] for item in ("M4", "M6", "K1")]
    html = gp.Table(["item"], [*rows, ["sin, Omega^2, mean"], ["none_drive, x_min"]])._repr_html_()
    assert "m<sub>e</sub> x′′ + c<sub>h</sub> x′ + k<sub>h</sub>(t) f(x) = F<sub>m</sub> - m<sub>e</sub> e′′" in html
    assert (
        "X′′ + 2 ζ X′ + k f(X) = F<sub>m</sub>′ + F<sub>ah</sub> Ω<sub>h</sub>² sin(Ω<sub>h</sub> τ + φ<sub>h</sub>)"
        in html
    )
    assert "the mesh&#x27;s is" in html and "sin, Ω², mean" in html and "none_drive, x_min" in html


def test_a_table_without_rows_keeps_its_headings():
    assert repr(gp.Table(["a", "b"], [])).splitlines()[0] == "a  b"
