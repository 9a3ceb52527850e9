"""The dimensionless gear pair: one frozen, validated description of the physics."""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from difflib import get_close_matches
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_array, check_class, check_count, check_fields, check_number, checked, plain, shown
from gearpair._flow.cells import Cells, Coefficients, build_cells
from gearpair.harmonics import Harmonic, ShaftOrder, check_harmonics, check_shaft_orders
from gearpair.quantities import ROWS, Part, part_of
from gearpair.stiffness import Rectangle, StiffnessWave

LARGEST_DAMPING_RATIO = 100.0
LARGEST_MESH_FREQUENCY = 1e6
MOST_TURNS = 1e6  # of the fastest rate in a base period, in radians: the tables of a period are as long
MOST_MESH_PERIODS = 10_000  # in a base period


@dataclass(frozen=True, kw_only=True)
class Oscillator:
    """A spur gear pair with backlash, ``X'' + 2 zeta X' + k(tau) f(X) = F_m + F_ah Omega^2 sin(Omega tau + phi)``.

    ``f`` is zero on [-1, 1] and has slope one outside. All quantities are dimensionless. Harmonics of the transmission
    error add ``F_n (n Omega)^2 sin(n Omega tau + phi_n)`` each; errors of shafts the same, with ``n = order / teeth``.

    Parameters
    ----------
    mean_force : float
        F_m', the mean force along the line of action; any sign.
    error_amplitude : float
        F_ah = e_a / b_h, the amplitude of the static transmission error, at least 0.
    error_phase : float
        phi_h, the phase of the transmission error at the start of a mesh period, in radians.
    damping_ratio : float
        zeta, from 0 to 100.
    flight_damping : float, optional
        zeta in free flight, ``|X| < 1``, from 0 to 100. When not given, it is that in contact, `damping_ratio`; 0 is
        damping in contact only.
    mesh_frequency : float
        Omega_h, above 0 and at most 1e6; the mesh period is ``T = 2 pi / Omega_h``, and not longer than a
        million times the fastest time scale of contact.
    stiffness : StiffnessWave
        k(tau) over the mesh period; the article's printed rectangle by default.
    harmonics : sequence of (order, amplitude, phase)
        What the transmission error has besides its first harmonic: orders n from 2 to 200, amplitudes
        F_n = e_n / b_h of at least 0, phases in radians, as `Harmonic`.
    shaft_orders : sequence of (teeth, amplitude, phase, order)
        What it has that repeats with a wheel's revolution, as `ShaftOrder`: teeth of at least 1, amplitudes over b_h of
        at least 0; phase and order may be left out.

    Notes
    -----
    With errors of shafts the *base period*, after which the equation repeats, is not the mesh period but the least
    revolution that all their wheels complete: `mesh_periods` mesh periods, the least common multiple of their teeth. It
    takes the mesh period's place as `period`: the section is ``tau mod period = 0``, the map leads from one base period
    to the next, and "period 1" says that a motion repeats every revolution. Errors of amplitude 0 do not count.

    The article, items M5 and M6. Above a damping ratio of 100 the fastest time scale is so far
    below the mesh period that the exact flow would be mostly idle work; gears have about 0.01.

    Examples
    --------
    >>> osc = Oscillator(mesh_frequency=1.0)
    >>> osc.replace(damping_ratio=0.05, contact_ratio=1.7).stiffness.edges
    (0.0, 0.7)
    >>> Oscillator(harmonics=[(2, 0.05, 0.0)]).harmonics
    (Harmonic(order=2, amplitude=0.05, phase=0.0),)
    >>> turning = Oscillator(shaft_orders=[(12, 0.3), (18, 0.1, 0.5)])  # run-out of both wheels
    >>> turning.mesh_periods, round(turning.period / turning.mesh_period, 12)
    (36, 36.0)
    """

    mean_force: float = 0.1
    error_amplitude: float = 0.2
    error_phase: float = 0.0
    damping_ratio: float = 0.02
    flight_damping: float | None = None
    mesh_frequency: float = 0.7
    stiffness: StiffnessWave = field(default_factory=StiffnessWave.rectangular)
    harmonics: tuple[Harmonic, ...] = ()
    shaft_orders: tuple[ShaftOrder, ...] = ()

    def __post_init__(self) -> None:
        check_fields(
            self,
            mean_force={},
            error_amplitude={"at_least": 0.0},
            error_phase={},
            damping_ratio={"at_least": 0.0, "at_most": LARGEST_DAMPING_RATIO},
            flight_damping={"at_least": 0.0, "at_most": LARGEST_DAMPING_RATIO},
            mesh_frequency={"above": 0.0},
        )
        if not isinstance(self.stiffness, StiffnessWave):
            raise ValueError(f"stiffness must be a StiffnessWave, got {shown(self.stiffness)}")
        object.__setattr__(self, "harmonics", check_harmonics("harmonics", self.harmonics))
        object.__setattr__(self, "shaft_orders", check_shaft_orders("shaft_orders", self.shaft_orders))
        if self.mesh_periods > MOST_MESH_PERIODS:
            raise ValueError(
                f"shaft_orders must repeat together within {MOST_MESH_PERIODS} mesh periods, got teeth "
                f"{[each.teeth for each in self.shaft_orders if each.amplitude]}, which need {self.mesh_periods}"
            )
        check_number("mesh_frequency", self.mesh_frequency, at_most=LARGEST_MESH_FREQUENCY)
        rate = max(2.0 * self.damping_ratio, 2.0 * (self.flight_damping or 0.0), math.sqrt(max(self.stiffness.levels)))
        slowest = 2.0 * math.pi * rate / MOST_TURNS * self.mesh_periods
        if self.mesh_frequency < slowest:
            shafts = f" and with a base period of {self.mesh_periods} mesh periods" if self.mesh_periods > 1 else ""
            raise ValueError(
                f"mesh_frequency must be at least {slowest:.3g} at this damping ratio and these stiffness levels"
                f"{shafts} (a millionth of their rate), got {self.mesh_frequency}"
            )

    def __repr__(self) -> str:
        """The call that makes it; options that are left at what they usually are do not appear."""
        shown = {each.name: getattr(self, each.name) for each in fields(self)}
        told = (f"{name}={value!r}" for name, value in shown.items() if name not in RARE or value != RARE[name])
        return f"{type(self).__name__}({', '.join(told)})"

    @property
    def mesh_period(self) -> float:
        """The mesh period 2 pi / Omega_h (dimensionless time)."""
        return 2.0 * np.pi / self.mesh_frequency

    @cached_property
    def mesh_periods(self) -> int:
        """How many mesh periods the base period has: 1 unless there are `shaft_orders`, see the class's notes."""
        return math.lcm(*(each.teeth for each in self.shaft_orders if each.amplitude > 0.0))

    @property
    def period(self) -> float:
        """The base period T (dimensionless time): the mesh period, `mesh_periods` of them with `shaft_orders`."""
        return self.mesh_period * self.mesh_periods

    def base_periods(self, mesh_periods: int) -> int:
        """The fewest base periods that as many mesh periods fit into.

        Examples
        --------
        >>> Oscillator().base_periods(500), Oscillator(shaft_orders=[(34, 0.1)]).base_periods(500)
        (500, 15)
        """
        return -(-check_count("mesh_periods", mesh_periods, at_least=0) // self.mesh_periods)

    @property
    def damping_in_flight(self) -> float:
        """The damping ratio in free flight: `flight_damping`, or `damping_ratio` where that is None."""
        return self.damping_ratio if self.flight_damping is None else self.flight_damping

    @property
    def all_harmonics(self) -> tuple[Harmonic, ...]:
        """All harmonics of the transmission error, the first among them; without the errors of shafts."""
        return (Harmonic(1, self.error_amplitude, self.error_phase), *self.harmonics)

    @property
    def error_lines(self) -> tuple[tuple[float, float, float], ...]:
        """All of the transmission error: frequency over the mesh frequency, amplitude and phase of each sinusoid.

        Examples
        --------
        >>> Oscillator(shaft_orders=[(20, 0.3)]).error_lines
        ((1, 0.2, 0.0), (0.05, 0.3, 0.0))
        """
        return (*((n, amplitude, phase) for n, amplitude, phase in self.all_harmonics), *self._shaft_lines)

    @property
    def _shaft_lines(self) -> tuple[tuple[float, float, float], ...]:
        """Those of the shafts alone; none where no amplitude is above 0."""
        turning = self.shaft_orders if any(each.amplitude > 0.0 for each in self.shaft_orders) else ()
        return tuple((each.order / each.teeth, each.amplitude, each.phase) for each in turning)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the scalars that `replace`, sweeps and continuation can change.

        Those of parts have the part's number: ``"levels[0]"`` and ``"edges[1]"`` of the stiffness wave, whose first
        edge is always 0; of the harmonics, by their order, ``"harmonics[3].amplitude"`` and ``"harmonics[3].phase"``;
        and of the errors of shafts, by their place, ``"shaft_orders[0].amplitude"`` and so on.

        Examples
        --------
        >>> Oscillator(harmonics=[(3, 0.05, 0.0)]).parameters[9:]
        ('levels[0]', 'levels[1]', 'edges[1]', 'harmonics[3].amplitude', 'harmonics[3].phase')
        """
        levels = range(len(self.stiffness.levels))
        wave = [*(f"levels[{i}]" for i in levels), *(f"edges[{i}]" for i in levels[1:])]
        orders = dict.fromkeys(each.order for each in self.harmonics)
        lines = [*(f"harmonics[{n}]" for n in orders), *(f"shaft_orders[{i}]" for i in range(len(self.shaft_orders)))]
        error = [f"{line}.{what}" for line in lines for what in ("amplitude", "phase")]
        rectangle = WAVE_SCALARS if self.stiffness.rectangle is not None else ()
        return (*SCALARS, *rectangle, *wave, *error)

    @checked
    def parameter(self, name: str) -> float:
        """The present value of one of `parameters`; of a `flight_damping` that is not given, that in contact."""
        self._check_name(name)
        if part := part_of(name):
            if part.what:
                return float(getattr(getattr(self, part.field)[self._place(part)], part.what))
            return float(getattr(self.stiffness, part.field)[part.number])
        if name == "flight_damping":
            return self.damping_in_flight
        return float(getattr(self.stiffness.rectangle if name in WAVE_SCALARS else self, name))

    def replace(self, **changes: Any) -> Self:
        """A copy with some parameters changed.

        Parameters
        ----------
        **changes
            Any field of the class; also ``contact_ratio``, ``a`` and ``b`` where the stiffness is
            the article's rectangle, whose reading is kept; and parts by their names in `parameters`, as
            ``**{"harmonics[3].amplitude": 0.1}``. A wave of which one level or edge is changed is no rectangle.
        """
        for name in changes:
            if name not in WHOLE:
                self._check_name(name)
        if parts := {name: part for name in changes if (part := part_of(name))}:
            changes = self._with_parts(changes, parts)
        wave = {name: changes.pop(name) for name in WAVE_SCALARS if name in changes}
        if wave:
            if "stiffness" in changes:
                raise ValueError(f"give either stiffness or {', '.join(wave)}, not both")
            rectangle = self.stiffness.rectangle
            assert rectangle is not None
            changes["stiffness"] = StiffnessWave.rectangular(**{**vars(rectangle), **wave})
        return replace(self, **changes)

    def _place(self, part: Part) -> int:
        """Where among the harmonics, which are named by their order, or the errors of shafts a part stands."""
        return [each.order for each in self.harmonics].index(part.number) if part.field == "harmonics" else part.number

    def _with_parts(self, changes: dict[str, Any], parts: dict[str, Part]) -> dict[str, Any]:
        """The changes with whole fields in place of their `parts`."""
        whole = {name: value for name, value in changes.items() if name not in parts}
        wave = {"edges": list(self.stiffness.edges), "levels": list(self.stiffness.levels)}
        lines: dict[str, list[Any]] = {"harmonics": list(self.harmonics), "shaft_orders": list(self.shaft_orders)}
        for name, part in parts.items():
            for other in (part.field,) if part.what else ("stiffness", *WAVE_SCALARS):
                if other in whole:
                    raise ValueError(f"give either {other} or {name}, not both")
            value = check_number(name, changes[name])
            if part.what:
                place = self._place(part)
                lines[part.field][place] = lines[part.field][place]._replace(**{part.what: value})
            else:
                wave[part.field][part.number] = value
        fields_of = {part.field for part in parts.values()}
        whole |= {name: tuple(lines[name]) for name in fields_of & lines.keys()}
        if fields_of & wave.keys():
            whole["stiffness"] = StiffnessWave(tuple(wave["edges"]), tuple(wave["levels"]))
        return whole

    @classmethod
    def from_attrs(cls, result: Any) -> Self:
        """The oscillator that a result belongs to, from the attributes of its dataset: also one read from a file.

        Examples
        --------
        >>> from gearpair import sweep
        >>> osc = Oscillator(mean_force=0.2)
        >>> Oscillator.from_attrs(sweep(osc, "mesh_frequency", [1.6])) == osc
        True
        """
        text = getattr(result, "attrs", {}).get("oscillator")
        if not isinstance(text, str):
            raise ValueError(f"result must be a dataset whose attributes name its oscillator, got {shown(result)}")
        try:
            found = _built(ast.parse(text, mode="eval").body, {cls.__name__: cls, **PARTS})
        except (SyntaxError, TypeError) as error:
            raise ValueError(f"the attribute 'oscillator' must be the repr of one, got {shown(text)}") from error
        check_class("the attribute 'oscillator'", found, cls)
        return found

    def _check_name(self, name: str) -> None:
        if name in SCALARS or name in self.parameters:
            return
        if name in WAVE_SCALARS:
            raise ValueError(
                f"{name} can be changed only where the stiffness wave is rectangular, got {self.stiffness!r}"
            )
        words = {each.lower(): each for each in self.parameters} | {
            row.symbol.lower(): row.name for row in ROWS if row.name in SCALARS and row.symbol
        }
        meant = get_close_matches(name.lower(), words, 1)
        hint = f" (did you mean {words[meant[0]]!r}?)" if meant else ""
        named = [each for each in self.parameters if part_of(each) is None]
        raise ValueError(
            f"unknown parameter {name!r}{hint}; the parameters are {', '.join(named)} and, of the parts that it has, "
            "levels[i], edges[i], amplitude and phase of harmonics[order] and of shaft_orders[i]"
        )

    def force(self, tau: ArrayLike) -> Any:
        """The right-hand side ``F_m + F_ah Omega^2 sin(Omega tau + phi)``, with all else, at `tau` (any shape).

        Of a number a float, of an array an array; so is `error`.
        """
        angle = self.mesh_frequency * check_array("tau", tau)
        total = self.mean_force + np.zeros_like(angle)
        for order, amplitude, phase in self.error_lines:
            total = total + amplitude * (order * self.mesh_frequency) ** 2 * np.sin(order * angle + phase)
        return plain(total)

    def error(self, tau: ArrayLike) -> Any:
        """The transmission error over half the backlash, ``F_ah sin(Omega tau + phi)`` with all else, at `tau`."""
        angle = self.mesh_frequency * check_array("tau", tau)
        total = np.zeros_like(angle)
        for order, amplitude, phase in self.error_lines:
            total = total + amplitude * np.sin(order * angle + phase)
        return plain(total)

    @cached_property
    def coefficients(self) -> Coefficients:
        """What the kernels take: plain floats and arrays."""
        return Coefficients(
            self.mean_force,
            self.error_amplitude,
            self.error_phase,
            self.damping_ratio,
            self.damping_in_flight,
            self.mesh_frequency,
            np.array([*self.stiffness.edges, 1.0]),
            np.array(self.stiffness.levels),
            np.array([*self.harmonics, *self._shaft_lines], dtype=float).reshape(-1, 3),
            self.mesh_periods,
        )

    @cached_property
    def cells(self) -> Cells:
        """The tables that the kernels walk over."""
        return build_cells(self.coefficients)


def _built(node: ast.expr, classes: Mapping[str, Any]) -> Any:
    """What an expression of constants, tuples and calls of `classes` by keywords builds; a TypeError for any other."""
    if isinstance(node, ast.Tuple):
        return tuple(_built(each, classes) for each in node.elts)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.args and node.func.id in classes:
        return classes[node.func.id](**{str(each.arg): _built(each.value, classes) for each in node.keywords})
    try:
        return ast.literal_eval(node)
    except ValueError as error:
        raise TypeError("neither a constant nor a part of an oscillator") from error


PARTS = {  # of the repr of an oscillator
    "StiffnessWave": StiffnessWave,
    "Rectangle": Rectangle,
    "Harmonic": Harmonic,
    "ShaftOrder": ShaftOrder,
}
RARE = {"flight_damping": None, "shaft_orders": ()}  # not in the repr, so that older results name the same oscillator
WHOLE = ("stiffness", "harmonics", "shaft_orders")  # the fields that are no scalars
SCALARS = tuple(f.name for f in fields(Oscillator) if f.name not in WHOLE)
WAVE_SCALARS = ("contact_ratio", "a", "b")
