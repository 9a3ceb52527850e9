"""Typical errors in each assignment, with the marks that they leave and a word of the hint that they get."""

from tests.teach.edits import Edit, then

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
