"""Impact measures of steady motions against closed forms, identities and quadrature in seventy digits."""

import numpy as np
import pytest
from mpmath import mp, mpf

import gearpair as gp
from gearpair._flow.closed_form import TERMS
from gearpair._flow.measures import N_MEASURES
from gearpair._flow.observe import measure
from gearpair.motion.measures import MEASURES, measure_columns
from tests.support.oscillators import level
from tests.support.reference import mpmath_period

COLLIDING = {
    "rattle": (gp.Oscillator(), 1.0, 0.0),
    "clatter": (gp.Oscillator(), -2.0, 1.5),
    "period 3": (gp.Oscillator(mesh_frequency=1.3), 1.0, 0.0),
    "four levels": (
        gp.Oscillator(
            damping_ratio=0.05,
            mesh_frequency=1.55,
            stiffness=gp.StiffnessWave((0.0, 0.2, 0.5, 0.9), (1.2, 0.7, 1.4, 0.9)),
        ),
        1.0,
        0.0,
    ),
}


def measured(osc, x, v, n_periods):
    """The measures of any stretch of motion, by name."""
    row = np.empty(N_MEASURES)
    assert measure(osc.cells, x, v, n_periods, np.empty(TERMS), row) == 0
    return {name: float(c[0]) for name, c in measure_columns(row[None], np.array([osc.mean_force])).items()}


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(("force", "zeta", "omega"), [(1.0, 0.02, 0.7), (1.0, 0.3, 1.6), (40.0, 0.02, 0.99)])
def test_always_in_contact_has_a_closed_form(force, zeta, omega, side):
    """Constant stiffness k: X = +-1 + F_m / k plus the forced wave of amplitude A / |k - Omega^2 + 2i zeta Omega|."""
    k = 0.9
    osc = level(k, mean_force=side * force, damping_ratio=zeta, mesh_frequency=omega)
    wave = 0.2 * omega**2 / abs(complex(k - omega**2, 2 * zeta * omega))
    assert force / k > wave, "the case must stay in contact"
    got = gp.motion.impact_measures(gp.steady_state(osc, x=side * 2.0))
    near, far = ("drive", "coast") if side > 0 else ("coast", "drive")
    assert got.drive_impacts == got.coast_impacts == got.drive_velocity == got.coast_velocity == 0.0
    assert np.isnan(got.drive_velocity_mean)
    assert [getattr(got, f"{near}_share"), getattr(got, f"{far}_share"), got.flight_share] == pytest.approx([1, 0, 0])
    assert got.flight_share == 0.0  # to the bit: no rounding passes for teeth that part
    assert getattr(got, f"{near}_force") == pytest.approx(force + k * wave, rel=1e-12)
    assert getattr(got, f"{far}_force") == 0.0
    assert got.load_factor == pytest.approx(1.0 + k * wave / force, rel=1e-12)
    assert getattr(got, f"{near}_impulse") == pytest.approx(force * osc.period, rel=1e-12)
    assert got.x_mean == pytest.approx(side * (1.0 + force / k), rel=1e-13)
    assert got.x_rms == pytest.approx(wave / np.sqrt(2.0), rel=1e-11)
    assert got.peak_to_peak == pytest.approx(2.0 * wave, rel=1e-12)


@pytest.mark.parametrize(("osc", "x", "v"), COLLIDING.values(), ids=COLLIDING)
def test_measures_agree_with_seventy_digits(osc, x, v):
    """Two periods on the way to the attractor: integrals by Gauss-Legendre quadrature, extremes at roots of X'."""
    pieces = []
    state = x, v
    for _ in range(2):
        end = mpmath_period(osc, *state)
        pieces.append(end)
        state = end.x, end.v
    segments = [segment for end in pieces for segment in end.segments]
    crossings = [crossing for end in pieces for crossing in end.crossings]
    span = 2 * 2 * mp.pi / mpf(osc.mesh_frequency)
    moments = [integral(segments, lambda y, power=n: y**power) for n in (1, 2)]
    got = measured(osc, x, v, 2)
    assert got["x_mean"] == pytest.approx(float(moments[0] / span), abs=1e-13)
    assert got["x_rms"] == pytest.approx(float(mp.sqrt(moments[1] / span - (moments[0] / span) ** 2)), rel=1e-12)
    highest = [max(turning_values(piece, h)) for piece, _region, _k, h in segments]
    lowest = [min(turning_values(piece, h)) for piece, _region, _k, h in segments]
    assert got["peak_to_peak"] == pytest.approx(float(max(highest) - min(lowest)), rel=1e-13)
    for side, name in ((1, "drive"), (-1, "coast")):
        own = [s for s in segments if s[1] == side]
        speeds = [abs(velocity) for _tau, at, velocity, contact in crossings if contact and at == side]
        assert got[f"{name}_impacts"] == len(speeds) / 2
        assert got[f"{name}_velocity"] == pytest.approx(max(speeds, default=0.0), abs=1e-12)
        assert got[f"{name}_velocity_mean"] == pytest.approx(np.mean(speeds) if speeds else np.nan, nan_ok=True)
        assert got[f"{name}_share"] == pytest.approx(float(sum(s[3] for s in own) / span), abs=1e-13)
        impulse = sum(s[2] * abs(integral([s], lambda y, side=side: y - side)) for s in own) / 2
        assert got[f"{name}_impulse"] == pytest.approx(float(impulse), abs=1e-12)
        peaks = [k * max(abs(y - side) for y in turning_values(piece, h)) for piece, _, k, h in own]
        assert got[f"{name}_force"] == pytest.approx(float(max(peaks, default=0)), abs=1e-12)


def integral(segments, of):
    """Integral of a function of X over segments of the reference."""
    total = mpf(0)
    for piece, _region, _stiffness, h in segments:
        total += mp.quad(
            lambda t, piece=piece: of(piece.derivative(0, t)), [0, h], method="gauss-legendre", maxdegree=4
        )
    return total


def turning_values(piece, h):
    """X at both ends of a piece and wherever X' vanishes."""
    points = [h * i / 40 for i in range(41)]
    return [piece.derivative(0, t) for t in (0, *piece.roots(1, points), h)]


def test_impulses_balance_the_mean_force_and_all_cycles_agree_with_their_impacts():
    """Over a cycle mean(k f) = F_m; counts and velocities are those that the trajectory lists."""
    seen = set()
    for omega in np.linspace(0.7, 1.7, 11):
        state = gp.steady_state(gp.Oscillator(mesh_frequency=omega), n_exponent=200)
        if state.period is None:
            continue
        got, osc = gp.motion.impact_measures(state), state.oscillator
        assert got.drive_impulse - got.coast_impulse == pytest.approx(osc.mean_force * osc.period, rel=1e-9)
        assert got.drive_share + got.coast_share + got.flight_share == pytest.approx(1.0, abs=1e-14)
        assert got.peak_to_peak == pytest.approx(state.x_max - state.x_min, rel=1e-12)
        listed = gp.trajectory(osc, *map(float, state.points[0]), state.period).impacts
        for side, name in ((1, "drive"), (-1, "coast")):
            speeds = np.abs(listed.velocity[listed.contact & (listed.side == side)])
            assert getattr(got, f"{name}_impacts") == pytest.approx(len(speeds) / state.period, abs=1e-14)
            assert getattr(got, f"{name}_velocity") == pytest.approx(max(speeds, default=0.0), rel=1e-12)
        seen.add(state.impact_state)
    assert {"single_drive", "double"} <= seen


@pytest.mark.parametrize(("omega", "period"), [(0.7, 2), (1.3, 3)])
def test_the_measures_do_not_depend_on_where_the_cycle_is_entered(omega, period):
    state = gp.steady_state(gp.Oscillator(mesh_frequency=omega))
    assert state.period == period
    first = measured(state.oscillator, *map(float, state.points[0]), period)
    for point in state.points[1:]:
        assert measured(state.oscillator, *map(float, point), period) == pytest.approx(first, rel=1e-9, nan_ok=True)


def test_chaos_is_measured_over_many_periods_and_without_a_mean_force_there_is_no_load_factor():
    chaos = gp.steady_state(gp.Oscillator(mesh_frequency=1.219))
    got = gp.motion.impact_measures(chaos, n_periods=5000)
    assert got.drive_impulse - got.coast_impulse == pytest.approx(0.1 * chaos.oscillator.period, rel=0.01)
    free = gp.steady_state(gp.Oscillator(mean_force=0.0, damping_ratio=0.1))
    assert np.isnan(gp.motion.impact_measures(free).load_factor)
    assert tuple(vars(got)) == MEASURES


def test_what_escapes_has_no_measures():
    gone = gp.steady_state(gp.Oscillator(damping_ratio=0.001, mesh_frequency=1.95), x=300.0)
    with pytest.raises(ValueError, match="only a motion that stays bounded has impact measures, got one with status"):
        gp.motion.impact_measures(gone)
