"""Graded examples of each assignment: honest ways to each answer, and typical errors with marks and hint."""

FULL = 15.0
WRITTEN = 5.0
Edit = tuple[str, str, str]
END = "### END SOLUTION"


def then(cell: str, code: str) -> list[Edit]:
    """The reference solution, and behind it code that answers otherwise."""
    return [(cell, END, code)]


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
                'axes.plot(speeds, chart.dte_peak_to_peak.sel(run=run), ".-"',
                "chart.dte_peak_to_peak.sel(run=run).plot(ax=axes",
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
        "level_at_another_rate": then(
            "noticed",
            "heard = design.sound(found.drive, run, rate=16_000)\nn = int(0.3 * heard.rate)\n"
            "louder_db = 20 * np.log10(heard.samples[-n:].std() / heard.samples[:n].std())",
        ),
    },
}

# by assignment and name: marks by tests, a word of the hint that the student reads, and the edits
WRONG: dict[str, dict[str, tuple[float, str, list[Edit]]]] = {
    "stiffness": {
        # one error costs its own mark, and what follows from it is right
        "circular_pitch": (
            14.0,
            "circular pitch",
            [("contact-ratio", "pair.module_mm * np.cos(alpha)", "pair.module_mm")],
        ),
        # a ratio outside 1 to 2 ends in an error of the library, so that no harmonic comes of it
        "degrees": (
            9.0,
            "sin takes radians",
            [("contact-ratio", "np.radians(pair.pressure_angle_deg)", "pair.pressure_angle_deg")],
        ),
        "degrees_in_the_cosine": (
            11.0,
            "cos takes radians",
            [("contact-ratio", "np.cos(alpha)", "np.cos(pair.pressure_angle_deg)")],
        ),
        "pitch_circles": (10.0, "base circles", [("contact-ratio", "gear.base_radius_mm", "gear.pitch_radius_mm")]),
        "upside_down": (11.0, "upside down", then("contact-ratio", "contact_ratio = 1 / contact_ratio")),
        "newton_per_metre": (13.5, "power of ten", [("mesh-stiffness", " / 1e6", "")]),
        "mean_of_zones": (
            14.0,
            "equally long",
            then("mesh-stiffness", "mean_n_per_um = (two_pairs_n_per_um + one_pair_n_per_um) / 2"),
        ),
        "zones_swapped": (
            13.0,
            "other way round",
            then("mesh-stiffness", "two_pairs_n_per_um, one_pair_n_per_um = one_pair_n_per_um, two_pairs_n_per_um"),
        ),
        "one_pair_alone": (
            13.0,
            "alone",
            [("picture", "mesh.phase, mesh.stiffness_n_per_m", "mesh.path, mesh.pair_stiffness_n_per_m")],
        ),
        "a_for_b": (13.0, "that is b", [("rectangle", "wave = ", "a, b = b, a\nwave = ")]),
        "levels": (
            13.0,
            "level itself",
            then("rectangle", "a, b = 1 + a, 1 - b\nfirst_harmonic = 2 * abs(wave.harmonics(1)[1])"),
        ),
        "half_the_amplitude": (14.0, "twice the modulus", then("rectangle", "first_harmonic /= 2")),
        "of_the_curve": (
            14.0,
            "of the curve",
            then(
                "rectangle",
                "first_harmonic = 2 * abs(np.fft.rfft(mesh.stiffness_n_per_m)[1]) / mesh.stiffness_n_per_m.sum()",
            ),
        ),
        "old_over_new": (13.0, "old over new", then("redesign", "harmonic_factor = 1 / harmonic_factor")),
        "old_teeth": (14.0, "old teeth", then("redesign", "new_contact_ratio = contact_ratio")),
        "half_a_picture": (
            13.0,
            "right in part",
            [("picture", "mesh.phase, mesh.stiffness_n_per_m", "mesh.phase[:500], mesh.stiffness_n_per_m[:500]")]
            + [("picture", "axes.set(", "dict(")],
        ),
        "empty_picture": (
            12.0,
            "empty figure",
            [
                ("picture", "axes.plot(", "len("),
                ("picture", "mesh.phase, mesh.stiffness_n_per_m / 1e6", "()"),
                ("picture", "axes.set(", "dict("),
            ],
        ),
    },
    "frequency": {
        "rising_twice": (
            12.0,
            "begin at the highest frequency",
            [("sweeps", '"mesh_frequency", frequencies[::-1]', '"mesh_frequency", frequencies')]
            + [("sweeps", "frequencies[::-1][falling", "frequencies[falling")]
            + [("picture", "axes.plot(frequencies[::-1]", "axes.plot(frequencies")],
        ),
        "half_the_damping": (14.0, "square", [("one-period", "-2 * osc", "-osc")]),
        "without_two_pi": (14.0, "2 pi", [("one-period", "2 * np.pi / osc", "1 / osc")]),
        "per_unit_of_time": (
            14.0,
            "per unit of time",
            then("one-period", "area_factor = np.exp(-2 * osc.damping_ratio)"),
        ),
        "a_step_early": (14.0, "last frequency", then("sweeps", "jump_up -= 0.005")),
        "ways_exchanged": (11.0, "falling sweep jumps", then("sweeps", "jump_up, jump_down = jump_down, jump_up")),
        "largest_of_the_falling": (
            13.0,
            "highest",
            then("sweeps", 'jump_down = frequencies[::-1][falling.impact_state.values == "single_drive"].max()'),
        ),
        "smallest_drawn": (13.0, "smallest X", [("picture", "x_max", "x_min")]),
        "turned_values": (14.0, "run against", [("picture", "axes.plot(frequencies[::-1]", "axes.plot(frequencies")]),
        # read off the sweep: near the grazing, far from the fold
        "read_off": (
            12.0,
            "to one step of its grid",
            then("behind-the-jump", "grazing_frequency = fold_frequency = jump_up"),
        ),
        "exchanged": (
            11.0,
            "other kind",
            then("behind-the-jump", "grazing_frequency, fold_frequency = fold_frequency, grazing_frequency"),
        ),
        "last_fold": (
            13.0,
            "last fold",
            then("behind-the-jump", 'fold_frequency = [b.value for b in branch.bifurcations if b.kind == "fold"][-1]'),
        ),
        "real_part": (13.0, "real part", then("stability", "multiplier_modulus = orbit.multipliers.real.max()")),
        "determinant": (13.0, "determinant", then("stability", "multiplier_modulus = abs(np.prod(orbit.multipliers))")),
    },
    "damping": {
        "common_logarithm": (14.0, "natural logarithm", [("meaning", "np.log(10)", "1")]),
        "without_the_two": (14.0, "2 of the formula", [("meaning", "= 2 * 0.1", "= 0.1")]),
        "in_time": (14.0, "mesh period", [("meaning", "(osc.damping_ratio * osc.period)", "osc.damping_ratio")]),
        "of_the_drive": (14.0, "your drive has", then("meaning", "damping_n_s_per_m = drive.damping_n_s_per_m")),
        "micrometres": (14.5, "N/µm", [("meaning", " * 1e6 *", " *")]),
        "ends_exchanged": (
            14.0,
            "other end",
            then("sweep", "period_at_0_3, period_at_0_1 = period_at_0_1, period_at_0_3"),
        ),
        "last_single": (14.5, "last one with period 1", then("sweep", "first_doubled += 0.005")),
        "turned_values": (
            13.0,
            "run against",
            [("picture", "x_min,", "x_min[::-1],"), ("picture", "x_max,", "x_max[::-1],")],
        ),
        "read_off": (14.0, "exactly", then("flip", "flip_damping = first_doubled")),
        "fold_for_flip": (14.0, "fold", [("flip", "flip_multiplier = -1", "flip_multiplier = 1")]),
        "per_mesh_period": (
            13.0,
            "per mesh period",
            then("exponents", "exponent_sum *= osc.period\nlargest_exponent *= osc.period"),
        ),
        "smaller_exponent": (14.0, "smaller one", then("exponents", "largest_exponent = state.lyapunov_exponents[1]")),
        "number_of_starts": (14.0, "number of starts", then("chaos", "seem_chaotic *= len(start_x)")),
        "linear_estimate": (14.0, "last part", then("chaos", "mean_life = 20 / (other.damping_ratio * other.period)")),
        "length_of_the_watch": (14.0, "length of the watch", then("chaos", "mean_life = 20_000")),
    },
    "impacts": {
        "separations_too": (14.0, "separations", [("impacts", "int(hits.contact.sum())", "len(hits)")]),
        "share_of_the_quiet": (14.0, "quiet", then("two-motions", "share_rattling = 1 - share_rattling")),
        "number_of_starts": (14.0, "number of starts", then("two-motions", "n_attractors = plane.impact_state.size")),
        "in_contact": (14.0, "in contact", then("impacts", "free_fraction = 1 - free_fraction")),
        "largest_anywhere": (14.0, "anywhere", then("impacts", "largest_approach_speed = np.abs(motion.v).max()")),
        "velocity_drawn": (13.0, "velocity", [("picture", "shown.x)", "shown.v)")]),
        "time_in_tau": (13.0, "mesh periods", [("picture", "shown.tau / osc.period", "shown.tau")]),
        "without_stiffness": (
            12.0,
            "f(X) alone",
            [("force", "osc.stiffness(fine.tau / osc.period) * penetration", "penetration")],
        ),
        "from_the_middle": (
            12.0,
            "subtract 1",
            [("force", "fine.x - 1, np.where(fine.x < -1, fine.x + 1, 0)", "fine.x, fine.x")],
        ),
        "not_divided": (13.0, "not divided", [("force", "force.max() / osc.mean_force", "force.max()")]),
        "a_step_early": (13.5, "last one at which", then("load", "quiet_force -= 0.002")),
        "the_factor": (12.0, "factor", then("load", "quiet_force /= osc.mean_force")),
        # follows the motion that keeps contact: its start, and an approach that it does not have
        "the_other_motion": (
            13.0,
            "no section point",
            [("two-motions", 'values == "single_drive"', 'values == "none_drive"')],
        ),
    },
    "speed_chart": {
        "radius_not_squared": (14.0, "squared", [("resonance", " ** 2\ngear", "\ngear")]),
        "radians_for_hertz": (14.0, "2 pi", [("resonance", " / (2 * np.pi)", "")]),
        "sum_of_masses": (
            14.0,
            "1 over the sum",
            [("resonance", "1 / (1 / pinion_mass_kg + 1 / gear_mass_kg)", "pinion_mass_kg + gear_mass_kg")],
        ),
        "without_teeth": (14.0, "each of its teeth", then("resonance", "gear_rpm = 60 * natural_frequency_hz")),
        "the_pinion": (14.0, "pinion's speed", then("resonance", "gear_rpm = pinion_rpm")),
        "whole_backlash": (14.0, "half of the backlash", then("dimensionless", "mean_force /= 2")),
        "factor_two": (14.0, "2 zeta", then("dimensionless", "damping_ratio *= 2")),
        "effective_value": (
            14.0,
            "effective value",
            [("run-up", "dte_peak_to_peak", "dte_rms"), ("chart", "dte_peak_to_peak", "dte_rms")],
        ),
        "half_the_swing": (14.0, "peak to peak", then("run-up", "largest_swing_um /= 2")),
        "the_way_down": (12.0, "coast-down", [("run-up", 'sel(run="up")', 'sel(run="down")')]),
        "millimetres": (14.5, "power of ten", then("run-up", "largest_swing_um /= 1000")),
        "over_mesh_frequency": (
            13.0,
            "over the mesh frequency",
            [("chart", "axes.plot(speeds", "axes.plot(speeds / drive.resonance_rpm")],
        ),
        "factor_for_torque": (13.0, "that is the factor", then("torque", "quiet_torque_nm /= drive.pinion_torque_nm")),
        "torque_of_the_gear": (
            13.0,
            "of the gear",
            then("torque", "quiet_torque_nm *= drive.gear_base_radius_mm / drive.pinion_base_radius_mm"),
        ),
    },
    "in_service": {
        "turns": (13.0, "how often the pinion turns", [("heard", " * drive.pinion_teeth", "")]),
        "radians": (13.0, "radians", then("heard", "up_hz, down_hz = 2 * np.pi * up_hz, 2 * np.pi * down_hz")),
        "jumps_exchanged": (
            3.0,
            "not nan",
            [("identified", "rig.jump_up_rpm, rig.jump_down_rpm", "rig.jump_down_rpm, rig.jump_up_rpm")],
        ),
        # the passage of the drive of the data sheet: its curve is that of the numbers given
        "data_sheet": (
            10.0,
            "guess of the data sheet",
            then(
                "identified",
                "damping_ratio, error_um = drive.damping_ratio, drive.transmission_error_um\n"
                "found = teaching.RigReport(drive, 0, 0)",
            ),
        ),
        "peak_to_peak": (13.0, "peak to peak", then("identified", "error_um *= 2")),
        "over_time": (13.0, "over the time", [("passage", "run.speed, run.x_max", "run.time, run.x_max")]),
        "force_drawn": (13.0, "mesh force", [("passage", "run.x_max", "run.mesh_force")]),
        "the_jump": (13.0, "jump of the rig", then("noticed", "parting_rpm = rig.jump_up_rpm")),
        "newtons": (14.0, "newtons", then("noticed", "largest_force_factor *= drive.mean_force_n")),
        "ten_times_the_logarithm": (13.0, "20 times", then("noticed", "louder_db /= 2")),
        "the_ratio": (13.0, "ratio, not its level", then("noticed", "louder_db = 10 ** (louder_db / 20)")),
    },
}
NAMES = ("stiffness", "frequency", "damping", "impacts", "speed_chart", "in_service")
