"""Honest ways to each answer of an assignment, other than the reference: all of them earn full marks."""

from tests.teach.edits import Edit, then

# by assignment and name: edits of the reference solution (cell, what, by what) that still earn full marks
HONEST: dict[str, dict[str, list[Edit]]] = {
    "stiffness": {
        "path_from_the_ratio": then("contact-ratio", "path_mm = pair.contact_ratio * pair.base_pitch_mm"),
        "ratio_of_the_library": then("contact-ratio", "contact_ratio = pair.contact_ratio"),
        "ratio_of_the_stiffness": then("contact-ratio", "contact_ratio = gp.mesh_stiffness(pair).contact_ratio"),
        "mean_of_samples": then("mesh-stiffness", "mean_n_per_um = np.mean(mesh.stiffness_n_per_m) / 1e6"),
        "mean_by_trapezoids": then(
            "mesh-stiffness",
            "k = np.append(mesh.stiffness_n_per_m, mesh.stiffness_n_per_m[0])\n"
            "mean_n_per_um = np.trapezoid(k, np.append(mesh.phase, 1.0)) / 1e6",
        ),
        "zones_of_samples": then(
            "mesh-stiffness",
            "k, two = mesh.stiffness_n_per_m / 1e6, mesh.pairs_in_contact == 2\n"
            "two_pairs_n_per_um, one_pair_n_per_um = k[two].mean(), k[~two].mean()",
        ),
        "zones_by_phase": then(
            "mesh-stiffness",
            "k, two = mesh.stiffness_n_per_m / 1e6, mesh.phase < contact_ratio - 1\n"
            "two_pairs_n_per_um, one_pair_n_per_um = k[two].mean(), k[~two].mean()",
        ),
        "rectangle_of_the_library": then(
            "rectangle", "shape = gp.mesh_stiffness(pair).rectangular()\na, b = shape.a, shape.b"
        ),
        "harmonic_by_formula": then(
            "rectangle", "first_harmonic = 2 / np.pi * (a + b) * np.sin(np.pi * (contact_ratio - 1))"
        ),
        "harmonic_by_transform": then(
            "rectangle", "k = wave(np.arange(65536) / 65536)\nfirst_harmonic = 2 * abs(np.fft.rfft(k)[1]) / 65536"
        ),
        "factor_by_formula": then(
            "redesign",
            "def size(r):\n    return (r.a + r.b) * np.sin(np.pi * (r.contact_ratio - 1))\n"
            "harmonic_factor = size(new) / size(gp.mesh_stiffness(pair).rectangular())",
        ),
        "points_instead_of_a_line": [("picture", "axes.plot(", "axes.scatter(")],
    },
    "frequency": {
        "period_of_the_library": then("one-period", "mesh_period = osc.period"),
        "area_of_multipliers": then(
            "one-period",
            "state = gp.steady_state(osc)\nquiet = periodic_orbit(osc, *state.points[0].tolist(), 1)\n"
            "area_factor = abs(np.prod(quiet.multipliers))",
        ),
        "area_by_differences": then(
            "one-period",
            "x, v = gp.steady_state(osc).points[0]\n"
            "p, q, r = (np.array(gp.stroboscopic_map(osc, x + d, v + e)) for d, e in ((0, 0), (1e-6, 0), (0, 1e-6)))\n"
            "area_factor = np.linalg.det(np.array([q - p, r - p])) / 1e-12",
        ),
        "rattling_by_the_smallest_x": then(
            "sweeps", "jump_up = frequencies[rising.x_min.values < 1].min()\nquiet = falling.x_min.values >= 1"
        ),
        "points_instead_of_lines": [
            ("picture", 'axes.plot(frequencies, rising.x_max, "o-"', "axes.scatter(frequencies, rising.x_max"),
        ],
        "by_xarray": [("picture", 'axes.plot(frequencies, rising.x_max, "o-"', "rising.x_max.plot(ax=axes")],
        "from_a_settled_start": then(
            "behind-the-jump",
            "there = osc.replace(mesh_frequency=0.56)\n"
            "branch = continue_orbit(periodic_orbit(there, *gp.steady_state(there).points[0].tolist(), 1),"
            ' "mesh_frequency", 0.56, 0.75)\n'
            "grazing_frequency, fold_frequency = (next(b.value for b in branch.bifurcations if b.kind == kind)"
            ' for kind in ("grazing", "fold"))',
        ),
        "multipliers_of_the_settled_state": then(
            "stability",
            "multiplier_modulus = max(abs(gp.steady_state(osc.replace(mesh_frequency=0.56)).multipliers))",
        ),
        "multipliers_by_the_determinant": then(
            "stability",
            "two = orbit.multipliers\nif abs(two[0].imag) > 1e-9:\n"
            "    multiplier_modulus = np.exp(-osc.damping_ratio * 2 * np.pi / 0.56)",
        ),
    },
    "damping": {
        "damping_scaled": then("meaning", "damping_n_s_per_m = drive.damping_n_s_per_m * 0.1 / osc.damping_ratio"),
        "damping_of_the_library": then(
            "meaning", "damping_n_s_per_m = drive.replace(damping_ratio=0.1).damping_n_s_per_m"
        ),
        "damping_of_critical": then("meaning", "damping_n_s_per_m = 0.1 * drive.critical_damping_n_s_per_m"),
        "periods_by_the_logarithm": then(
            "meaning", "periods_for_nine_digits = np.log(1e9) / osc.damping_ratio / osc.period"
        ),
        "periods_by_a_loop": then(
            "meaning",
            "n = 0\nwhile np.exp(-osc.damping_ratio * n * osc.period) > 1e-9:\n    n += 0.001\n"
            "periods_for_nine_digits = n",
        ),
        "found_in_a_loop": then(
            "sweep", "first_doubled = next(z for z, p in zip(dampings, diagram.period.values) if p != 1)"
        ),
        "periods_as_they_come": then("sweep", "period_at_0_3, period_at_0_1 = diagram.period.values[[0, 40]]"),
        "from_weaker_damping": then(
            "flip",
            "there = osc.replace(damping_ratio=0.25)\n"
            "way = continue_orbit(periodic_orbit(there, *gp.steady_state(there).points[0].tolist(), 1),"
            ' "damping_ratio", 0.08, 0.3)\n'
            'flip_damping = max(each.value for each in way.bifurcations if each.kind == "flip")',
        ),
        "multiplier_of_the_branch": then(
            "flip",
            "k = np.argmin(abs(branch.values - flip_damping))\nflip_multiplier = branch.multipliers[k].real.min()",
        ),
        "exponents_of_multipliers": then(
            "exponents",
            "there = osc.replace(damping_ratio=0.2)\n"
            "own = periodic_orbit(there, *gp.steady_state(there).points[0].tolist(), 1)\n"
            "each = np.log(abs(own.multipliers)) / there.period\n"
            "exponent_sum, largest_exponent = each.sum(), each.max()",
        ),
        "exponents_watched": then(
            "exponents",
            "each = gp.lyapunov_exponents(osc.replace(damping_ratio=0.2), 1.0, 0.0, 2000)\n"
            "exponent_sum, largest_exponent = each.sum(), each[0]",
        ),
        "settled_one_by_one": then(
            "chaos",
            "each = [gp.steady_state(other, x, v, n_transient=20_000) for x, v in zip(start_x, start_v)]\n"
            "ends = [state.period for state in each if state.period]\ntrue_period = max(set(ends), key=ends.count)",
        ),
        "life_by_the_mean_of_times": then(
            "chaos",
            "times = watched.escape_time.values - watched.discard\nmean_life = times[times > 0].mean()",
        ),
        "life_after_fewer_starts": then(
            "chaos", "mean_life = float(gp.survival(other, start_x[:30], start_v[:30]).mean_life)"
        ),
        "sum_by_the_trace": then("exponents", "exponent_sum = -2 * 0.2"),
    },
    "impacts": {
        "share_of_the_library": then("two-motions", "share_rattling = float(plane.attractor_share[which])"),
        "share_by_counting": then(
            "two-motions", "share_rattling = np.sum(plane.impact_state.values == 'single_drive') / (len(xs) * len(vs))"
        ),
        "start_as_an_array": then("two-motions", "start = np.array(start)"),
        "start_settled_elsewhere": then(
            "two-motions",
            "settled = gp.ensembles.attractor_states(osc, plane)\n"
            "start = next(s for s in settled if s.impact_state == 'single_drive').points[0]",
        ),
        "free_by_impact_times": then(
            "impacts",
            "t, begins = hits.tau / osc.period, hits.contact\n"
            "free_fraction = sum(b - a for a, b in zip(t[~begins], t[begins]))\nfree_fraction %= 1.0",
        ),
        "free_of_many_samples": then(
            "impacts",
            "many = gp.trajectory(osc, *start, 1, samples_per_period=1000)\n"
            "free_fraction = np.mean(np.abs(many.x) < 1)",
        ),
        "speed_of_the_harder_side": then(
            "impacts", "largest_approach_speed = max(abs(v) for v, c in zip(hits.velocity, hits.contact) if c)"
        ),
        "default_samples": [("force", ", samples_per_period=4096", "")],
        "plain_mean": [("force", "penetration)[:-1]", "penetration)"), ("force", ", samples_per_period=4096", "")],
        "mean_by_trapezoids": then(
            "force", "mean_elastic_force = np.trapezoid(np.append(force, force[0]), fine.tau) / osc.period"
        ),
        "mean_by_theory": then("force", "mean_elastic_force = osc.mean_force"),
        "mean_of_two_periods": then(
            "force",
            "two = gp.trajectory(osc, *start, 2)\n"
            "mean_elastic_force = np.mean(osc.stiffness(two.tau / osc.period) * (two.x - np.clip(two.x, -1, 1)))",
        ),
        "first_quiet_in_a_loop": then(
            "load", 'quiet_force = next(f for f, s in zip(loads, loaded.impact_state.values) if s == "none_drive")'
        ),
        "quiet_by_the_smallest_x": then("load", "quiet_force = loads[loaded.x_min.values >= 1].min()"),
    },
    "speed_chart": {
        "frequency_of_the_library": then(
            "resonance", "natural_frequency_hz = drive.natural_frequency_rad_s / 2 / np.pi"
        ),
        "mass_of_the_library": then(
            "resonance", "pinion_mass_kg = 1 / (1 / drive.equivalent_mass_kg - 1 / gear_mass_kg)"
        ),
        "gear_speed_of_the_library": then(
            "resonance", "gear_rpm = drive.resonance_rpm * drive.pinion_base_radius_mm / drive.gear_base_radius_mm"
        ),
        "gear_speed_by_teeth": then(
            "resonance",
            "ratio = drive.gear_base_radius_mm / drive.pinion_base_radius_mm\n"
            "gear_rpm = 60 * natural_frequency_hz / round(drive.pinion_teeth * ratio)",
        ),
        "force_by_formula": then(
            "dimensionless",
            "force = drive.pinion_torque_nm / (drive.pinion_base_radius_mm * 1e-3)\n"
            "mean_force = force / (drive.mean_stiffness_n_per_um * drive.backlash_um / 2)",
        ),
        "ratio_by_formula": then(
            "dimensionless",
            "root = np.sqrt(drive.mean_stiffness_n_per_um * 1e6 * drive.equivalent_mass_kg)\n"
            "damping_ratio = drive.damping_n_s_per_m / (2 * root)",
        ),
        "speed_by_definition": then("dimensionless", "mesh_frequency = 0.7"),
        "with_jumps_located": [("run-up", ", locate_jumps=False", "")],
        "parting_by_time_apart": then(
            "run-up", 'parting_rpm = speeds[chart.time_apart.sel(run="up").values > 1e-9].min()'
        ),
        "loudest_by_xarray": then(
            "run-up", 'loudest_rpm = float(chart.dte_peak_to_peak.sel(run="up").idxmax("speed"))'
        ),
        "by_xarray": [
            (
                "chart",
                'axes.plot(speeds, chart.dte_peak_to_peak.sel(run=way), ".-"',
                "chart.dte_peak_to_peak.sel(run=way).plot(ax=axes",
            )
        ],
        "torque_of_a_drive": then(
            "torque",
            "force = osc.mean_force * factors[loaded.impact_state.values == 'none_drive'].min()\n"
            "heavier = drive.with_oscillator(osc.replace(mean_force=force))\n"
            "quiet_torque_nm = heavier.pinion_torque_nm",
        ),
        "torque_by_the_smallest_x": then(
            "torque", "quiet_torque_nm = factors[loaded.x_min.values >= 1].min() * drive.pinion_torque_nm"
        ),
    },
    "in_service": {
        "by_periods": then("heard", "up_hz = 1 / (60 / rig.jump_up_rpm / drive.pinion_teeth)"),
        "by_the_resonance": then(
            "heard", "down_hz = rig.jump_down_rpm / drive.resonance_rpm * drive.natural_frequency_rad_s / (2 * np.pi)"
        ),
        "of_the_drive_found": then(
            "identified", "damping_ratio, error_um = found.drive.damping_ratio, found.drive.transmission_error_um"
        ),
        "looked_for_in_a_narrow_range": [
            ("identified", "rig.jump_down_rpm)", "rig.jump_down_rpm, damping_ratios=(0.04, 0.1), speed_error_rpm=0.5)")
        ],
        "rounded": then("identified", "damping_ratio, error_um = round(damping_ratio, 3), round(error_um, 1)"),
        "by_xarray": [
            ("passage", "axes.plot(run.speed, run.x_max)", 'run.plot.scatter(x="speed", y="x_max", ax=axes)')
        ],
        "parting_by_the_smallest_x": then(
            "noticed", "parting_rpm = float(run.speed.values[run.x_min.values < 1].min())"
        ),
        "level_of_squares": then(
            "noticed",
            "louder_db = 10 * np.log10(np.mean(heard.samples[-n:] ** 2) / np.mean(heard.samples[:n] ** 2))",
        ),
        "level_of_norms": then(
            "noticed",
            "n = round(0.3 * heard.rate)\n"
            "louder_db = 20 * np.log10(np.linalg.norm(heard.samples[-n:]) / np.linalg.norm(heard.samples[:n]))",
        ),
    },
}
