"""Oscillators and starts to test with: random ones, and every degenerate case by name."""

import numpy as np

import gearpair as gp

SINGLE = gp.StiffnessWave((0.0,), (1.0,))
BASELINE = gp.Oscillator()
CONTACT = gp.Oscillator(mean_force=4.0, error_amplitude=0.02, mesh_frequency=2.6)  # never leaves the flank
SWAPPED = gp.Oscillator(stiffness=gp.StiffnessWave.rectangular(reading="swapped"))


def random_case(rng: np.random.Generator) -> tuple[gp.Oscillator, float, float]:
    """An oscillator and a start: any wave, damping from none to overdamped, starts near, far and on the boundaries."""
    kind = rng.integers(4)
    if kind < 2:
        reading = ("printed", "swapped")[kind]
        ratio, a, b = rng.uniform(1.05, 1.95), rng.uniform(-0.3, 0.5), rng.uniform(-0.3, 0.7)
        wave = gp.StiffnessWave.rectangular(ratio, a, b, reading)
    else:
        n = rng.integers(1, 6)
        wave = gp.StiffnessWave((0.0, *np.sort(rng.uniform(0.02, 0.98, n - 1))), tuple(rng.uniform(0.2, 3.0, n)))
    osc = gp.Oscillator(
        mean_force=rng.uniform(-0.3, 0.6),
        error_amplitude=rng.uniform(0.0, 1.0),
        error_phase=rng.uniform(0.0, 7.0),
        damping_ratio=float(rng.choice([0.0, 1e-12, 0.001, 0.02, 0.3, 1.0, 2.5])),
        mesh_frequency=rng.uniform(0.4, 3.0),
        stiffness=wave,
    )
    x = float(rng.choice([-1.0, 1.0, rng.normal(0.0, 1.5), rng.normal(0.0, 20.0)]))
    v = float(rng.choice([0.0, rng.normal(), 10.0 * rng.normal()]))
    return osc, x, v


def level(stiffness: float, **changes) -> gp.Oscillator:
    """An oscillator of constant stiffness."""
    return gp.Oscillator(stiffness=gp.StiffnessWave((0.0,), (stiffness,)), **changes)


NEIGHBOURHOOD = (0.0, 1e-15, 1e-12, 1e-8, 1e-4, -1e-15, -1e-12, -1e-8, -1e-4)


def degenerate_cases() -> dict[str, tuple[gp.Oscillator, float, float]]:
    """Name -> oscillator and start: each case in which a textbook formula divides by zero, and its neighbourhood."""
    cases = {}
    for zeta in (0.0, 5e-324, 1e-300, 1e-16, 1e-12, 1e-8, 1e-4):
        cases[f"zeta = {zeta}"] = gp.Oscillator(damping_ratio=zeta), 1.2, -0.4
        cases[f"zeta = {zeta}, free flight"] = gp.Oscillator(damping_ratio=zeta, mean_force=0.0), 0.1, 0.05
    for d in NEIGHBOURHOOD:
        for zeta in (0.0, 1e-12):
            cases[f"k = Omega^2 (1 + {d}), zeta = {zeta}"] = (
                level(0.81 * (1 + d), mesh_frequency=0.9, damping_ratio=zeta, mean_force=2.0),
                3.0,
                0.5,
            )
        cases[f"zeta^2 = k (1 + {d})"] = (
            level(1.0, mesh_frequency=0.8, damping_ratio=float(np.sqrt(1 + d))),
            1.5,
            -2.0,
        )
    for zeta in (1.5, 10.0, 100.0):
        cases[f"overdamped, zeta = {zeta}"] = gp.Oscillator(damping_ratio=zeta, mesh_frequency=1.3), 2.0, -5.0
    for omega in (0.05, 25.0):
        cases[f"mesh frequency {omega}"] = gp.Oscillator(mesh_frequency=omega), 1.1, 0.2
    return cases
