"""Compile every kernel once, so that no chapter and no test has to wait for it."""

from __future__ import annotations

import gearpair as gp


def main() -> None:
    """Call each public entry to the kernels on a small case; the compiled code stays in numba's disk cache."""
    osc = gp.Oscillator()
    gp.trajectory(osc, 1.0, 0.0, 1)
    gp.stroboscopic_map(osc, [0.0, 1.0], 0.0)
    gp.steady_state(osc)
    gp.lyapunov_exponents(osc, 1.0, 0.0, 20)
    orbit = next(orbit for orbit in gp.find_orbits(osc, 2, n_starts=50) if orbit.period == 2)
    gp.continue_orbit(orbit, "mesh_frequency", 0.69, 0.71)
    gp.runge_kutta_sweep(osc, "mesh_frequency", [0.7, 0.8], rtol=1e-3, atol=1e-6)
    gp.runge_kutta_sweep(osc, "mesh_frequency", [0.7, 0.8], rtol=1e-3, atol=1e-6, seeding="restart")


if __name__ == "__main__":
    main()
