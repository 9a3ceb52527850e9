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
    for integrator in (gp.methods.Integrator(steps=20), gp.methods.Integrator(rtol=1e-3)):
        integrator.sections([osc], 1.0, 0.0, 1, 1)


if __name__ == "__main__":
    main()
