"""What the article states: its numbers, ranges, criteria and claims as data, every item under its number.

Nothing here is computed or judged: chapters and tests set their own results beside these. The article is unsigned
and has tables and prose only; where a field is None, the article is silent.

Examples
--------
>>> print(*(r.motion for r in FREQUENCY_RANGES), sep="; ")
period 1; period 2; period 4; period 2; complex; period 2; period 1
>>> statement("F14").kind
'claim'
"""

from dataclasses import dataclass
from typing import Literal

from gearpair._checks import check_choice
from gearpair.motion.names import Motion, periodic

Kind = Literal["equation", "value", "range", "method", "criterion", "claim"]
SECTIONS = {  # by the letter of an item
    "M": "model", "K": "stiffness", "N": "numerics", "F": "frequency", "D": "damping", "I": "impacts",
    "C": "conclusions",
}  # fmt: skip
# The article's two words for what is not one of its periods: neither says more than that.
COMPLEX = Motion("complex")  # on the frequency axis: chaotic bands and windows of periods other than 1, 2 and 4 (F8)
CHAOTIC = Motion("chaotic")  # on the damping axis: no period


@dataclass(frozen=True)
class Baseline:
    """The article's baseline (item N3; K4 for the contact ratio), as `Oscillator` and its rectangle name it."""

    mean_force: float
    error_amplitude: float
    error_phase: float
    contact_ratio: float
    a: float
    b: float
    damping_ratio: float


@dataclass(frozen=True)
class StiffnessRow:
    """One row of the article's stiffness table (item K3): z1, z2, and a rectangle whose values are approximate."""

    teeth_pinion: int
    teeth_wheel: int
    contact_ratio: float
    a: float
    b: float


@dataclass(frozen=True)
class Range:
    """A range of one of the oscillator's parameters in which the article reports one kind of motion.

    Attributes
    ----------
    motion : Motion
        A period, `COMPLEX` or `CHAOTIC`.
    spectrum : str or None
        Where the lines of the spectrum lie, in the article's words.
    """

    item: str
    parameter: str
    lower: float
    upper: float
    motion: Motion
    spectrum: str | None = None

    def __contains__(self, value: float) -> bool:
        return self.lower <= value < self.upper


@dataclass(frozen=True)
class Boundary:
    """A value of one of the oscillator's parameters where the article reports that one motion gives way to another.

    Attributes
    ----------
    item : str
        The item that names the boundary; the item of the range above it where none does.
    event : str or None
        What the article says happens there, the parameter rising; None where it says nothing.
    """

    item: str
    parameter: str
    value: float
    event: str | None = None


@dataclass(frozen=True)
class ImpactCriterion:
    """A condition on the extremes of X over a cycle, as the article's inequality."""

    item: str
    state: str
    condition: str


@dataclass(frozen=True)
class Statement:
    """One numbered item of the article, ``"M1"`` to ``"C5"``: what sort of statement it is, and what in short words."""

    item: str
    kind: Kind
    text: str

    @property
    def section(self) -> str:
        """The part of the article that the item stands in."""
        return SECTIONS[self.item[0]]


BASELINE = Baseline(
    mean_force=0.1, error_amplitude=0.2, error_phase=0.0, contact_ratio=1.68, a=0.116, b=0.414, damping_ratio=0.02
)
STIFFNESS_TABLE = (
    StiffnessRow(34, 34, 1.65, 0.116, 0.414),
    StiffnessRow(34, 44, 1.78, 0.125, 0.395),
    StiffnessRow(34, 54, 1.88, 0.131, 0.382),
)
FREQUENCY_RANGES = (
    Range("F1", "mesh_frequency", 0.700, 0.799, periodic(1), "n Omega_h"),
    Range("F3", "mesh_frequency", 0.799, 0.865, periodic(2), "n Omega_h / 2"),
    Range("F5", "mesh_frequency", 0.865, 1.028, periodic(4), "n Omega_h / 4"),
    Range("F7", "mesh_frequency", 1.028, 1.191, periodic(2)),
    Range("F8", "mesh_frequency", 1.191, 1.459, COMPLEX),
    Range("F10", "mesh_frequency", 1.459, 1.555, periodic(2)),
    Range("F11", "mesh_frequency", 1.555, 1.700, periodic(1)),
)
FREQUENCY_BOUNDARIES = (
    Boundary("F2", "mesh_frequency", 0.799, "period doubling"),
    Boundary("F4", "mesh_frequency", 0.865, "period doubling"),
    Boundary("F6", "mesh_frequency", 1.028, "period halving"),
    Boundary("F8", "mesh_frequency", 1.191),
    Boundary("F10", "mesh_frequency", 1.459),
    Boundary("F11", "mesh_frequency", 1.555),
)
COMPLEX_WINDOWS = (3, 6)  # periods of the windows inside the complex zone (F8)
CHAOTIC_FREQUENCY = 1.219  # where the article shows its chaotic motion, "about" (F9)
DAMPING_FREQUENCY = 0.7  # the mesh frequency of the damping study (section D) and of the impact study (section I)
DAMPING_RANGES = (
    Range("D1", "damping_ratio", 0.0, 0.00275, CHAOTIC),
    Range("D3", "damping_ratio", 0.00275, 0.0165, periodic(3), "n Omega_h / 3"),
    Range("D5", "damping_ratio", 0.0165, 0.025, periodic(1)),
)
DAMPING_BOUNDARIES = (
    Boundary("D2", "damping_ratio", 0.00275, "crisis"),
    Boundary("D4", "damping_ratio", 0.0165, "saddle-node or similar"),
)
SUFFICIENT_DAMPING = 0.0165  # damping above this suffices to suppress complex motion, it is claimed (D6)
IMPACT_CRITERIA = (
    ImpactCriterion("I1", "no impact", "X_min >= 1 or X_max <= -1"),
    ImpactCriterion("I2", "single-sided impact (rattle)", "-1 <= X_min < 1 and X_max >= 1"),
    ImpactCriterion("I3", "double-sided impact (clatter)", "X_min < -1 and X_max > 1"),
)
# The item, its kind, what it states.
ITEMS = """
M1  equation  Two gears turn as rigid bodies in pure torsion, on rigid shafts and bearings.
M2  equation  x = r_b1 theta1 - r_b2 theta2 - e(t), with the error e = e_a sin(omega_h t + psi).
M3  equation  Symmetric backlash 2 b_h: f is zero inside it and x -+ b_h on the two flanks.
M4  equation  m_e x'' + c_h x' + k_h(t) f(x) = F_m - m_e e'', with m_e = 1/(r_b1^2/I1 + r_b2^2/I2).
M5  equation  Scaling by b_h and omega_n = sqrt(k_m/m_e), with k_m the average mesh stiffness.
M6  equation  X'' + 2 zeta X' + k f(X) = F_m' + F_ah Omega_h^2 sin(Omega_h tau + phi_h).
K1  method    Single-pair stiffness by the potential-energy method; the mesh's is the sum over pairs.
K2  equation  k = 1 + a on the first (eps - 1) of the mesh period, 1 - b on the rest.
K3  value     Contact ratio, a and b for 34 teeth against 34, 44 and 54.
K4  value     The baseline takes eps = 1.68 with a and b of 34 teeth against 34.
K5  claim     The rectangle excites more faithfully than a sinusoid and predicts more credibly.
N1  method    Variable-step Runge-Kutta 4-5 handles stiffness and discontinuities accurately.
N2  method    On the section few points tell a period, a structured set quasi-periodic motion, a dense set chaos.
N3  value     The baseline: F_m' 0.1, F_ah 0.2, phi_h 0, eps 1.68, a 0.116, b 0.414, zeta 0.02.
F1  range     Period 1 from 0.700 to 0.799: one closed orbit, lines at n Omega_h.
F2  value     Period doubling at 0.799.
F3  range     Period 2 from 0.799 to 0.865: lines at n Omega_h / 2.
F4  value     Period doubling at 0.865.
F5  range     Period 4 from 0.865 to 1.028: lines at n Omega_h / 4.
F6  value     Period halving at 1.028.
F7  range     Period 2 from 1.028 to 1.191.
F8  range     Complex from 1.191 to 1.459: windows of period 3 and 6, chaotic bands, sensitivity.
F9  value     Chaos at about 1.219: fractal-like section, broadband spectrum.
F10 range     Period 2 from 1.459 to 1.555.
F11 range     Period 1 from 1.555 to 1.700.
F12 claim     A classic period-doubling route into chaos as Omega_h rises, a reverse one out of it.
F13 claim     Chaos lies near primary resonances.
F14 claim     A stable period-3 orbit satisfies 3 Omega_h T_h = 2 pi m for some integer m.
D1  range     Chaotic for zeta from 0 to 0.00275.
D2  value     A crisis to period 3 at 0.00275.
D3  range     Period 3 from 0.00275 to 0.0165: lines at n Omega_h / 3.
D4  value     Straight to period 1 at 0.0165, by a saddle-node or similar.
D5  range     Period 1 from 0.0165 to 0.025, zeta = 0.02 included.
D6  claim     zeta above 0.0165 suffices to suppress complex motion.
I1  criterion No impact: X_min >= 1 or X_max <= -1.
I2  criterion Single-sided impact (rattle): -1 <= X_min < 1 and X_max >= 1.
I3  criterion Double-sided impact (clatter): X_min < -1 and X_max > 1.
I4  claim     At Omega_h 0.7, zeta 0.02 the attractor is unique, yet starts lead to several impact states.
I5  claim     The same gearbox can differ in noise and wear by its start-up history.
C1  claim     Frequency is the main bifurcation parameter, with speed ranges to avoid.
C2  claim     Modest damping collapses chaotic and high-period motion to period 1.
C3  claim     Several impact states occur, by the start.
C4  claim     The rectangle gives more credible predictions.
C5  claim     Analyse the whole speed range and many starts; maximise damping; mind torque reversal.
"""
STATEMENTS = tuple(Statement(*line.split(maxsplit=2)) for line in ITEMS.strip().splitlines())  # type: ignore[arg-type]


def statement(item: str) -> Statement:
    """The numbered item of the article, from ``"M1"`` to ``"C5"``.

    Examples
    --------
    >>> statement("F4").text
    'Period doubling at 0.865.'
    """
    for candidate in STATEMENTS:
        if candidate.item == item:
            return candidate
    raise ValueError(f"item must be one of {', '.join(s.item for s in STATEMENTS)}, got {item!r}")


def ranges(parameter: str) -> tuple[Range, ...]:
    """The published ranges of one parameter, ``"mesh_frequency"`` or ``"damping_ratio"``, in ascending order.

    Examples
    --------
    >>> [str(r.motion) for r in ranges("damping_ratio")]
    ['chaotic', 'period 3', 'period 1']
    """
    check_choice("parameter", parameter, ("mesh_frequency", "damping_ratio"))
    return tuple(r for r in FREQUENCY_RANGES + DAMPING_RANGES if r.parameter == parameter)


def boundaries(parameter: str) -> tuple[Boundary, ...]:
    """The published boundaries between the `ranges` of one parameter, in ascending order.

    Examples
    --------
    >>> [b.value for b in boundaries("damping_ratio")]
    [0.00275, 0.0165]
    """
    ranges(parameter)
    return tuple(b for b in FREQUENCY_BOUNDARIES + DAMPING_BOUNDARIES if b.parameter == parameter)
