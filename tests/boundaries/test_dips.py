"""The smallest dip of the load, against passages through it."""

import numpy as np
import pytest

import gearpair as gp
from gearpair.boundaries import at_phase, critical_dip

OSC = gp.Oscillator(
    error_amplitude=0.05, damping_ratio=0.05, mesh_frequency=0.75, stiffness=gp.StiffnessWave((0.0,), (1.0,))
)
QUIET = gp.steady_state(OSC, 1.1, 0.0)


def lands_on(change: float, cycles: int, phase: float) -> str:
    """The motion after a dip of the quiet motion, by a passage: the dip, then 400 mesh periods as before."""
    section = at_phase(OSC, phase)
    start = gp.trajectory(OSC, *QUIET.points[0].tolist(), 1, samples_per_period=8)
    k = round(phase * 8)
    dipped = section.replace(mean_force=OSC.mean_force * (1.0 + change))
    run = gp.passage([dipped] * cycles + [section] * 400, float(start.x[k]), float(start.v[k]))
    return str(run.impact_state.values[-1])


@pytest.mark.parametrize("cycles", [1, 3])
def test_the_smallest_dip_is_where_passages_part(cycles: int) -> None:
    found = critical_dip(OSC, QUIET, cycles=cycles, n_phases=8)
    assert -1.0 < found.change < 0.0
    assert lands_on(found.change * 1.001, cycles, found.phase) == "single_drive"
    assert lands_on(found.change * 0.999 + 1e-4, cycles, found.phase) == "none_drive"
    assert found.leads_to is not None and str(found.leads_to.impact_state) == "single_drive"
    for phase in np.arange(8) / 8:  # brute force: no smaller one at any phase
        for size in np.linspace(0.0, found.change, 30)[1:-1]:
            assert lands_on(size, cycles, phase) == "none_drive"


def test_the_dip_goes_to_zero_at_the_fold() -> None:
    """The quiet motion ends by a fold near .8165: the smallest dip falls as the root of the distance to it."""
    branch = gp.continue_orbit(gp.periodic_orbit(OSC, *QUIET.points[0].tolist(), 1), "mesh_frequency", 0.7, 0.9)
    fold = max(each.value for each in branch.bifurcations if each.kind == "fold")
    sizes = []
    for distance in (4e-3, 1e-3, 2.5e-4):
        osc = OSC.replace(mesh_frequency=fold - distance)
        orbit = [each for each in gp.find_orbits(osc, 1) if each.stable]
        quiet = min(orbit, key=lambda each: float(np.ptp(gp.trajectory(osc, *each.points[0].tolist(), 1).x)))
        sizes.append(abs(critical_dip(osc, quiet, cycles=2, n_phases=4).change))
    assert sizes[0] > sizes[1] > sizes[2]
    slope = np.log(sizes[0] / sizes[2]) / np.log(16.0)
    assert 0.35 < slope < 0.65


def test_a_surge_and_none() -> None:
    surge = critical_dip(OSC, QUIET, cycles=3, n_phases=4, surge=True, largest=3.0)
    assert surge.change > 0.0
    only = gp.steady_state(OSC.replace(damping_ratio=0.5))
    none = critical_dip(only.oscillator, only, cycles=2, n_phases=2)
    assert np.isnan(none.change) and none.leads_to is None
    assert repr(none) == "no change of the load that was tried for 2 mesh periods leaves the basin"


def test_bad_input() -> None:
    idle = OSC.replace(mean_force=0.0)
    with pytest.raises(ValueError, match="osc must have a mean force that can dip"):
        critical_dip(idle, QUIET)
    with pytest.raises(ValueError, match="cycles must be"):
        critical_dip(OSC, QUIET, cycles=0)
    with pytest.raises(ValueError, match="state must be a motion of the oscillator"):
        critical_dip(OSC.replace(mean_force=0.2), QUIET)
