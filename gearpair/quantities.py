"""The vocabulary: what each quantity is called, in a dataset, on an axis and at the head of a column.

One row for each; whoever shows a quantity takes its name, its symbol and its unit from here.
"""

import re
from typing import NamedTuple

# How the letters of plain symbols are spelled, and what stands for them on a page.
LETTERS = dict(
    zip(("Omega", "omega", "theta", "zeta", "phi", "psi", "eps", "epsilon", "tau", "pi"), "Ωωθζφψεετπ", strict=True)
)


class Quantity(NamedTuple):
    """One quantity and how it is told; braces in `words` and `axis` are where its symbol stands.

    Examples
    --------
    >>> QUANTITIES["mesh_frequency"].long_name, QUANTITIES["mesh_frequency"].label
    ('mesh frequency Omega_h', 'mesh frequency $\\\\Omega_h$')
    >>> QUANTITIES["speed"].label
    'speed of the pinion (rpm)'
    """

    name: str  # in the library: of a parameter or of a variable
    words: str  # what it is
    symbol: str = ""  # the article's, in plain letters
    tex: str = ""  # the same as TeX sets it, where that differs
    unit: str = "1"  # this for what is dimensionless
    axis: str = ""  # the words along an axis, where they are shorter

    @property
    def long_name(self) -> str:
        """The words with the symbol in plain letters."""
        return self.words.format(self.symbol)

    @property
    def in_tex(self) -> str:
        """The symbol as TeX sets it, without dollars."""
        return self.tex or self.symbol

    @property
    def label(self) -> str:
        """The words along an axis with the symbol in TeX, and the unit."""
        return self._in_tex(self.axis or self.words)

    @property
    def title(self) -> str:
        """The long name with the symbol in TeX, and the unit."""
        return self._in_tex(self.words)

    def _in_tex(self, words: str) -> str:
        unit = "" if self.unit == "1" else f" ({self.unit.replace('um', 'µm')})"
        return words.format(f"${self.in_tex}$") + unit


ROWS = (
    # The oscillator's parameters.
    Quantity("mean_force", "mean force {}", "F_m'"),
    Quantity("error_amplitude", "transmission error amplitude {}", "F_ah", "F_{ah}", axis="transmission error {}"),
    Quantity(
        "error_phase", "transmission error phase {}", "phi_h", r"\varphi_h", "rad",
        axis="phase of the transmission error {}",
    ),
    Quantity("damping_ratio", "damping ratio {}", "zeta", r"\zeta"),
    Quantity("flight_damping", "damping ratio {} in free flight", "zeta_f", r"\zeta_f"),
    Quantity("mesh_frequency", "mesh frequency {}", "Omega_h", r"\Omega_h"),
    Quantity("contact_ratio", "contact ratio {}", "epsilon", r"\varepsilon"),
    Quantity("a", "stiffness added in double contact, {}", "a", axis="{}"),
    Quantity("b", "stiffness missing in single contact, {}", "b", axis="{}"),
    # One motion.
    Quantity("tau", "time {}", "tau", r"\tau / T_h", axis="time {} (mesh periods)"),
    Quantity("frequency", "frequency over the mesh frequency {}", "Omega_h", r"\Omega_h", axis="frequency / {}"),
    Quantity("stiffness", "stiffness {}", "k", r"\bar k"),
    Quantity("x", "{} on the section", "X", axis="displacement {}"),
    Quantity("v", "{} on the section", "X'", axis="velocity {}"),
    Quantity("section", "{} on the section", "X"),
    Quantity("start_x", "initial X", "X_0", axis="initial displacement {}"),
    Quantity("start_v", "initial X'", "X_0'", axis="initial velocity {}"),
    # What it settles on.
    Quantity("motion", "motion"),
    Quantity("status", "what the motion became"),
    Quantity("period", "period in mesh periods, 0 unless periodic"),
    Quantity("impact_state", "impact state"),
    Quantity("x_min", "smallest X", "X_min", r"X_{\min}"),
    Quantity("x_max", "largest X", "X_max", r"X_{\max}"),
    Quantity(
        "exponent", "largest Lyapunov exponent per unit tau", "lambda_1", r"\lambda_1", axis="largest exponent {}"
    ),
    Quantity("smallest_exponent", "smallest Lyapunov exponent per unit tau", "lambda_2", r"\lambda_2"),
    Quantity("exponent_error", "standard error of the largest exponent"),
    Quantity("section_x", "{} on the section, the smallest of the cycle; nan unless periodic", "X"),
    Quantity("section_v", "{} there", "X'"),
    Quantity("lasted", "mesh periods followed; of a periodic motion, until it had settled"),
    Quantity("chaos_x_min", "smallest X while it was chaotic; nan if it never was observed to be", "X_min"),
    Quantity("chaos_x_max", "largest X while it was chaotic", "X_max"),
    Quantity("chaos_exponent", "largest Lyapunov exponent while it was chaotic, per unit tau", "lambda_1"),
    Quantity(
        "settling_time", "mesh periods until the motion was certain to stay with its attractor",
        axis="settling time (mesh periods)",
    ),
    Quantity("impacts_before", "contacts made in that time"),
    Quantity("worst_impact_state", "impact state of the whole way, the attractor included"),
    Quantity("largest_displacement", "largest {} on the whole way, the attractor included", "|X|", axis="largest {}"),
    # Several motions.
    Quantity("attractor", "number of the attractor"),
    Quantity("chaotic_set", "number of the chaotic set that the motion was on, -1 if none"),
    Quantity("leads_to", "share of the motions that left the set for the attractor"),
    Quantity("still", "motions still on the set"),
    Quantity("tips_to", "number of the attractor that one that has ended goes over to; -2 escape, -3 a transient"),
    Quantity("share", "share of the starts"),
    Quantity("transient_share", "share of the starts that are transients still"),
    Quantity("share_error", "standard error of the share, for starts drawn at random"),
    Quantity("n_attractors", "number of attractors that the starts reach"),
    Quantity("hysteresis", "whether the motion carried up differs from that carried down"),
    Quantity("calls", "calls of the right-hand side"),
    # How long they take.
    Quantity("escape_time", "mesh periods until the start was captured, nan if it was not"),
    Quantity("waited", "mesh periods since the start", axis="mesh periods"),
    Quantity("survivors", "starts still on their way"),
    Quantity("discarded", "mesh periods at the beginning that do not count"),
    Quantity("n_watched", "starts still on their way after those"),
    Quantity("watched_periods", "mesh periods that these were watched for from then on, together"),
    Quantity("escapes", "how many of them left in that time"),
    Quantity("escape_share", "share of these escapes"),
    Quantity("escape_rate", "escapes per mesh period watched"),
    Quantity("escape_rate_low", "lower end of the escape rate's interval"),
    Quantity("escape_rate_high", "upper end of the escape rate's interval"),
    Quantity("mean_life", "mean life in mesh periods", axis="mean life (mesh periods)"),
    Quantity("mean_life_low", "lower end of the mean life's interval"),
    Quantity("mean_life_high", "upper end of the mean life's interval"),
    Quantity("persistence", "whether chaos lasts, as far as it was watched"),
    # Measures of a motion.
    Quantity("drive_impacts", "contacts made on the drive side per mesh period"),
    Quantity("coast_impacts", "contacts made on the coast side per mesh period"),
    Quantity("drive_velocity", "largest approach speed on the drive side", axis="largest approach speed, drive side"),
    Quantity("coast_velocity", "largest approach speed on the coast side", axis="largest approach speed, coast side"),
    Quantity("drive_velocity_mean", "mean approach speed on the drive side"),
    Quantity("coast_velocity_mean", "mean approach speed on the coast side"),
    Quantity("drive_impulse", "impulse on the drive side per mesh period"),
    Quantity("coast_impulse", "impulse on the coast side per mesh period"),
    Quantity("drive_share", "share of the time in drive-side contact"),
    Quantity("coast_share", "share of the time in coast-side contact"),
    Quantity("flight_share", "share of the time without contact"),
    Quantity("drive_force", "largest mesh force on the drive side"),
    Quantity("coast_force", "largest mesh force on the coast side"),
    Quantity("load_factor", "largest mesh force over the mean force", axis="dynamic load factor"),
    Quantity("x_mean", "mean of {}", "X"),
    Quantity("x_rms", "root mean square of {} about its mean", "X", axis="rms of {} about its mean"),
    Quantity("peak_to_peak", "peak-to-peak value of {}", "X"),
    Quantity("largest_force", "largest mesh force"),
    Quantity("end_tau", "time {} at the end", "tau"),
    Quantity("end_x", "{} at the end", "X"),
    Quantity("end_v", "{} at the end", "X'"),
    Quantity("sample_tau", "time {}", "tau"),
    Quantity("sample_x", "displacement {}", "X"),
    Quantity("sample_v", "velocity {}", "X'"),
    # A drive over its speeds, in SI units.
    Quantity("speed", "speed of the pinion", unit="rpm"),
    Quantity(
        "dte_rms", "rms of the dynamic transmission error about its mean", unit="um",
        axis="dynamic transmission error, rms",
    ),
    Quantity("dte_peak_to_peak", "peak to peak of the dynamic transmission error", unit="um"),
    Quantity("mesh_force", "largest mesh force", unit="N"),
    Quantity("tooth_force", "largest force on one pair of teeth", unit="N"),
    Quantity("time", "time", unit="s"),
    Quantity("torque", "torque of the pinion", unit="N m"),
    Quantity("mean_mesh_force", "mean mesh force", unit="N"),
    Quantity("sample_time", "time", unit="s"),
    Quantity("sample_dte", "dynamic transmission error", unit="um"),
    Quantity("sample_force", "mesh force", unit="N"),
    Quantity("dynamic_factor", "largest mesh force over the mean force", axis="largest mesh force / mean force"),
    Quantity("time_apart", "share of the time without contact"),
    Quantity("impact_rate", "impacts per second", unit="1/s"),
    Quantity("factor_after", "largest mesh force over the mean force at the end"),
    Quantity("coast_struck", "whether the coast flank is struck"),
    Quantity("begins", "moment at which the load begins to change", unit="mesh periods"),
    Quantity("impact_velocity", "largest approach velocity at an impact", unit="mm/s", axis="largest impact velocity"),
    Quantity("n_motions", "motions found"),
    Quantity("both_flanks", "one error served both flanks"),
    Quantity("worst_share", "share of the starts that leads to the worst motion"),
    Quantity("worst_phase", "phase of the error of the worst motion", unit="rad"),
    Quantity("time_share", "share of the time"),
    Quantity("parted_share", "share of the time spent where the teeth may part"),
    Quantity("loss", "what the teeth do that lose contact"),
    Quantity("factor_low", "largest mesh force over the mean force, at the mildest phase of the error"),
    Quantity("factor_high", "largest mesh force over the mean force, at the worst phase of the error"),
    Quantity("time_apart_high", "largest share of the time without contact"),
    Quantity("impact_velocity_high", "largest approach velocity at an impact", unit="mm/s"),
    Quantity("linear_factor", "dynamic factor of the linear response"),
    Quantity("linear_rms", "rms of the linear response", unit="um"),
    Quantity("quiet_motion", "quietest motion"),
    Quantity("loud_motion", "loudest motion"),
    Quantity("quiet_factor", "dynamic factor of the quietest motion"),
    Quantity("loud_factor", "dynamic factor of the loudest motion"),
    Quantity("shock_margin", "smallest dip of the torque that ends the quietest motion, as a share of it"),
    Quantity("shock_phase", "mesh phase at which it begins, in mesh periods"),
    Quantity("after_shock", "motion after it"),
    Quantity("dip_back", "smallest dip of the torque that ends the loudest motion, as a share of it"),
    Quantity("surge_back", "smallest rise of the torque that does"),
    Quantity("frequency_ratio", "mesh frequency over the natural frequency"),
    # Many drives.
    Quantity("box", "number of the gearbox"),
    Quantity("parts", "whether the teeth part, run up or down"),
    Quantity("clatters", "whether they strike both flanks, run up or down"),
    Quantity("two_motions", "whether the runs up and down lead to two motions"),
    *(
        Quantity(f"{what}_share{end}", f"share of the gearboxes {words}{which}")
        for what, words in (
            ("parting", "whose teeth part"),
            ("clattering", "that strike both flanks"),
            ("two_motions", "that have two motions"),
        )
        for end, which in (("", ""), ("_low", ", lower end"), ("_high", ", upper end"))
    ),
    Quantity("factor_quantile", "quantiles of the largest mesh force over the mean force"),
    Quantity("velocity_quantile", "quantiles of the largest approach velocity at an impact", unit="mm/s"),
    Quantity("first_loss", "lowest speed at which the teeth part", unit="rpm"),
    Quantity("largest_factor", "largest mesh force over the mean force, at any speed"),
    Quantity("value", "what the gearbox has of each quantity"),
    Quantity("rank_correlation", "rank correlation of the largest factor with a quantity"),
    Quantity("half_share", "share whose teeth part, of the gearboxes with one half of a quantity's values"),
    Quantity("jump_speed", "speed of the jump", unit="rpm"),
    Quantity("jump_kind", "jump: kind"),
    Quantity("jump_from", "jump: from"),
    Quantity("jump_to", "jump: to"),
    # The worst of a range of speeds.
    Quantity("worst_dynamic_factor", "largest dynamic factor"),
    Quantity("worst_mesh_force", "largest mesh force", unit="N"),
    Quantity("worst_time_apart", "largest share of the time without contact", axis="largest share of time apart"),
    Quantity("impact_range", "speeds with impacts, together", unit="rpm", axis="speeds with impacts"),
)  # fmt: skip
QUANTITIES = {row.name: row for row in ROWS}


# A part's name, its number and, of a harmonic, what of it.
PART = re.compile(r"(levels|edges)\[(\d+)\]|(harmonics|shaft_orders)\[(\d+)\]\.(amplitude|phase)")


class Part(NamedTuple):
    """A scalar that is a part of a field."""

    field: str  # levels, edges, harmonics or shaft_orders
    number: int  # which; of a harmonic its order
    what: str  # amplitude or phase of a harmonic or of a shaft's error


def part_of(name: str) -> Part | None:
    """The part that a parameter's name stands for; None for a name of another form."""
    found = PART.fullmatch(name)
    if found is None:
        return None
    level, i, line, order, what = found.groups()
    return Part(level or line, int(i or order), what or "")


def part(name: str) -> Quantity | None:
    """What a part of a field is called (``"levels[0]"``, ``"harmonics[3].phase"``); None for another name."""
    found = part_of(name)
    if found is None:
        return None
    field, i, what = found
    if field == "levels":
        return Quantity(name, "stiffness level {}", f"k_{i}", rf"k_{{{i}}}")
    if field == "edges":
        return Quantity(name, "start of stiffness level {}, in mesh periods", f"k_{i}", rf"k_{{{i}}}")
    line, sign = (f"harmonic {i}", f"{i}") if field == "harmonics" else (f"shaft order {i}", f"s{i}")
    if what == "phase":
        return Quantity(name, f"phase of {line} {{}}", f"phi_{sign}", rf"\varphi_{{{sign}}}", "rad")
    return Quantity(name, f"amplitude of {line} {{}}", f"F_{sign}", rf"F_{{{sign}}}")


def quantity(name: str) -> Quantity | None:
    """The quantity of a name, also of an attractor's, a set's or a part's; None if it stands for none."""
    return QUANTITIES.get(name) or part(name) or QUANTITIES.get(name.removeprefix("attractor_").removeprefix("set_"))


def attributes(name: str) -> dict[str, str]:
    """Long name and units of a dataset's variable, by its name; those of an attractor or a set are of its motion."""
    known = quantity(name)
    if known is None:
        raise KeyError(name)
    return {"long_name": known.long_name, "units": known.unit}


def symbol(name: str) -> str:
    """The article's symbol of a quantity, in plain letters.

    Examples
    --------
    >>> symbol("mesh_frequency"), symbol("a")
    ('Omega_h', 'a')
    """
    known = quantity(name)
    return known.symbol if known else name


def axis_label(name: str) -> str:
    """The label of an axis; a name that stands for no quantity labels it itself.

    Examples
    --------
    >>> axis_label("contact_ratio")
    'contact ratio $\\\\varepsilon$'
    """
    known = QUANTITIES.get(name) or part(name)
    return known.label if known else name
