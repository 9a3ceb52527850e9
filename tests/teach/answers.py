"""Typical wrong answers to each assignment, and the marks by tests that they are worth."""

FULL = 15.0
WRITTEN = 5.0

# name of the mistake: marks, and the edits of the reference solution (cell, what, by what)
WRONG: dict[str, dict[str, tuple[float, list[tuple[str, str, str]]]]] = {
    "stiffness": {
        # the circular pitch, not the base pitch: the ratio, the harmonic and the factor go wrong with it
        "circular_pitch": (9.0, [("contact-ratio", "pair.module_mm * np.cos(alpha)", "pair.module_mm")]),
        "newton_per_metre": (13.5, [("mesh-stiffness", " / 1e6", "")]),
        # the harmonic has only a + b in it
        "a_for_b": (13.0, [("rectangle", "wave = ", "a, b = b, a\nwave = ")]),
        "half_a_picture": (
            13.0,
            [("picture", "mesh.phase, mesh.stiffness_n_per_m", "mesh.phase[:500], mesh.stiffness_n_per_m[:500]")]
            + [("picture", "axes.set(", "dict(")],
        ),
    },
    "frequency": {
        "rising_twice": (
            12.0,
            [("sweeps", '"mesh_frequency", frequencies[::-1]', '"mesh_frequency", frequencies')]
            + [("sweeps", "frequencies[::-1][falling", "frequencies[falling")]
            + [("picture", "axes.plot(frequencies[::-1]", "axes.plot(frequencies")],
        ),
        "half_the_damping": (14.0, [("one-period", "-2 * osc", "-osc")]),
        "a_step_early": (14.0, [("sweeps", "### END SOLUTION", "jump_up -= 0.005")]),
        # read off the sweep: near the grazing, far from the fold
        "read_off": (12.0, [("behind-the-jump", "### END SOLUTION", "grazing_frequency = fold_frequency = jump_up")]),
    },
    "damping": {
        "common_logarithm": (13.0, [("meaning", "np.log(10)", "1")]),
        "micrometres": (14.5, [("meaning", " * 1e6 *", " *")]),
        "read_off": (14.0, [("flip", "### END SOLUTION", "flip_damping = first_doubled")]),
        "fold_for_flip": (14.0, [("flip", "flip_multiplier = -1", "flip_multiplier = 1")]),
    },
    "impacts": {
        "separations_too": (14.0, [("impacts", "int(hits.contact.sum())", "len(hits)")]),
        "without_stiffness": (12.0, [("force", "osc.stiffness(motion.tau / osc.period) * penetration", "penetration")]),
        # follows the motion that keeps contact: no impact, no such picture, no such force, no load that ends it
        "the_other_motion": (5.0, [("impacts", 'values == "single_drive"', 'values == "none_drive"')]),
    },
    "speed_chart": {
        "without_teeth": (5.0, [("resonance", " / drive.pinion_teeth", "")]),
        "radians_for_hertz": (4.0, [("resonance", " / (2 * np.pi)", "")]),
        # the largest swing, and both curves
        "effective_value": (
            12.0,
            [("run-up", "dte_peak_to_peak", "dte_rms"), ("chart", "dte_peak_to_peak", "dte_rms")],
        ),
        "the_way_down": (13.0, [("run-up", 'peak_to_peak.sel(run="up")', 'peak_to_peak.sel(run="down")')]),
        "millimetres": (14.5, [("run-up", "### END SOLUTION", "largest_swing_um /= 1000")]),
    },
}
NAMES = tuple(WRONG)
