"""The dimensionless gear pair: one frozen, validated description of the physics."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from difflib import get_close_matches
from functools import cached_property
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from gearpair._checks import check_array, check_class, check_count, check_fields, check_number, checked, plain, shown
from gearpair._flow.cells import Cells, Coefficients, build_cells
from gearpair.quantities import ROWS, Part, part_of
from gearpair.stiffness import Rectangle, StiffnessWave

LARGEST_ORDER = 200  # of a harmonic: the cells of a period are as many times ten
LARGEST_DAMPING_RATIO = 100.0
LARGEST_MESH_FREQUENCY = 1e6
MOST_TURNS = 1e6  # of the fastest rate in a mesh period, in radians: the tables of a period are as long


class Harmonic(NamedTuple):
    """A harmonic of the transmission error, ``amplitude * sin(order * Omega tau + phase)``."""

    order: int  # multiple of the mesh frequency
    amplitude: float  # over half the backlash in an `Oscillator`, in micrometres in a `GearDrive`
    phase: float = 0.0  # at the start of a mesh period, in radians


@dataclass(frozen=True, kw_only=True)
class Oscillator:
    """A spur gear pair with backlash, ``X'' + 2 zeta X' + k(tau) f(X) = F_m + F_ah Omega^2 sin(Omega tau + phi)``.

    ``f`` is zero on [-1, 1] and has slope one outside. All quantities are dimensionless. Harmonics of the transmission
    error add ``F_n (n Omega)^2 sin(n Omega tau + phi_n)`` each.

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
    mesh_frequency : float
        Omega_h, above 0 and at most 1e6; the mesh period is ``T = 2 pi / Omega_h``, and not longer than a
        million times the fastest time scale of contact.
    stiffness : StiffnessWave
        k(tau) over the mesh period; the article's printed rectangle by default.
    harmonics : sequence of (order, amplitude, phase)
        What the transmission error has besides its first harmonic: orders n from 2 to 200, amplitudes
        F_n = e_n / b_h of at least 0, phases in radians, as `Harmonic`.

    Notes
    -----
    The article, items M5 and M6. Above a damping ratio of 100 the fastest time scale is so far
    below the mesh period that the exact flow would be mostly idle work; gears have about 0.01.

    Examples
    --------
    >>> osc = Oscillator(mesh_frequency=1.0)
    >>> osc.replace(damping_ratio=0.05, contact_ratio=1.7).stiffness.edges
    (0.0, 0.7)
    >>> Oscillator(harmonics=[(2, 0.05, 0.0)]).harmonics
    (Harmonic(order=2, amplitude=0.05, phase=0.0),)
    """

    mean_force: float = 0.1
    error_amplitude: float = 0.2
    error_phase: float = 0.0
    damping_ratio: float = 0.02
    mesh_frequency: float = 0.7
    stiffness: StiffnessWave = field(default_factory=StiffnessWave.rectangular)
    harmonics: tuple[Harmonic, ...] = ()

    def __post_init__(self) -> None:
        check_fields(
            self,
            mean_force={},
            error_amplitude={"at_least": 0.0},
            error_phase={},
            damping_ratio={"at_least": 0.0, "at_most": LARGEST_DAMPING_RATIO},
            mesh_frequency={"above": 0.0},
        )
        if not isinstance(self.stiffness, StiffnessWave):
            raise ValueError(f"stiffness must be a StiffnessWave, got {self.stiffness!r}")
        object.__setattr__(self, "harmonics", check_harmonics("harmonics", self.harmonics))
        check_number("mesh_frequency", self.mesh_frequency, at_most=LARGEST_MESH_FREQUENCY)
        rate = max(2.0 * self.damping_ratio, math.sqrt(max(self.stiffness.levels)))
        slowest = 2.0 * math.pi * rate / MOST_TURNS
        if self.mesh_frequency < slowest:
            raise ValueError(
                f"mesh_frequency must be at least {slowest:.3g} at this damping ratio and these stiffness levels "
                f"(a millionth of their rate), got {self.mesh_frequency}"
            )

    @property
    def period(self) -> float:
        """The mesh period T = 2 pi / Omega_h (dimensionless time)."""
        return 2.0 * np.pi / self.mesh_frequency

    @property
    def all_harmonics(self) -> tuple[Harmonic, ...]:
        """All harmonics of the transmission error, the first among them."""
        return (Harmonic(1, self.error_amplitude, self.error_phase), *self.harmonics)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the scalars that `replace`, sweeps and continuation can change.

        Those of parts have the part's number: ``"levels[0]"`` and ``"edges[1]"`` of the stiffness wave, whose first
        edge is always 0, and of the harmonics, by their order, ``"harmonics[3].amplitude"`` and
        ``"harmonics[3].phase"``.

        Examples
        --------
        >>> Oscillator(harmonics=[(3, 0.05, 0.0)]).parameters[8:]
        ('levels[0]', 'levels[1]', 'edges[1]', 'harmonics[3].amplitude', 'harmonics[3].phase')
        """
        levels = range(len(self.stiffness.levels))
        wave = [*(f"levels[{i}]" for i in levels), *(f"edges[{i}]" for i in levels[1:])]
        orders = dict.fromkeys(each.order for each in self.harmonics)
        harmonics = [f"harmonics[{order}].{what}" for order in orders for what in ("amplitude", "phase")]
        rectangle = WAVE_SCALARS if self.stiffness.rectangle is not None else ()
        return (*SCALARS, *rectangle, *wave, *harmonics)

    @checked
    def parameter(self, name: str) -> float:
        """The present value of one of `parameters`."""
        self._check_name(name)
        if part := part_of(name):
            if part.field == "harmonics":
                return float(getattr(self.harmonics[self._place(part.number)], part.what))
            return float(getattr(self.stiffness, part.field)[part.number])
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

    def _place(self, order: int) -> int:
        """Where among the harmonics the one of an order stands."""
        return [each.order for each in self.harmonics].index(order)

    def _with_parts(self, changes: dict[str, Any], parts: dict[str, Part]) -> dict[str, Any]:
        """The changes with whole fields in place of their `parts`."""
        whole = {name: value for name, value in changes.items() if name not in parts}
        wave = {"edges": list(self.stiffness.edges), "levels": list(self.stiffness.levels)}
        harmonics = list(self.harmonics)
        for name, part in parts.items():
            for other in ("harmonics",) if part.field == "harmonics" else ("stiffness", *WAVE_SCALARS):
                if other in whole:
                    raise ValueError(f"give either {other} or {name}, not both")
            value = check_number(name, changes[name])
            if part.field == "harmonics":
                place = self._place(part.number)
                order, amplitude, phase = harmonics[place]
                harmonics[place] = (
                    Harmonic(order, value, phase) if part.what == "amplitude" else Harmonic(order, amplitude, value)
                )
            else:
                wave[part.field][part.number] = value
        fields_of = {part.field for part in parts.values()}
        if "harmonics" in fields_of:
            whole["harmonics"] = tuple(harmonics)
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
            "levels[i], edges[i], harmonics[order].amplitude and harmonics[order].phase"
        )

    def force(self, tau: ArrayLike) -> Any:
        """The right-hand side ``F_m + F_ah Omega^2 sin(Omega tau + phi)``, with harmonics, at `tau` (any shape).

        Of a number a float, of an array an array; so is `error`.
        """
        angle = self.mesh_frequency * check_array("tau", tau)
        total = self.mean_force + np.zeros_like(angle)
        for order, amplitude, phase in self.all_harmonics:
            total = total + amplitude * (order * self.mesh_frequency) ** 2 * np.sin(order * angle + phase)
        return plain(total)

    def error(self, tau: ArrayLike) -> Any:
        """The transmission error over half the backlash, ``F_ah sin(Omega tau + phi)`` with harmonics, at `tau`."""
        angle = self.mesh_frequency * check_array("tau", tau)
        total = np.zeros_like(angle)
        for order, amplitude, phase in self.all_harmonics:
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
            self.mesh_frequency,
            np.array([*self.stiffness.edges, 1.0]),
            np.array(self.stiffness.levels),
            np.array(self.harmonics, dtype=float).reshape(-1, 3),
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


def check_harmonics(name: str, harmonics: Any, lowest: int = 2) -> tuple[Harmonic, ...]:
    """`harmonics` of orders from `lowest` as named tuples, or a ValueError that says which is wrong."""
    checked: list[Harmonic] = []
    if isinstance(harmonics, (str, bytes)) or not isinstance(harmonics, Iterable):
        raise ValueError(f"{name} must be a sequence of (order, amplitude, phase), got {harmonics!r}")
    for i, each in enumerate(harmonics):
        if np.shape(each) not in ((2,), (3,)):
            raise ValueError(f"{name}[{i}] must be (order, amplitude, phase), got {each!r}")
        given = Harmonic(*each)
        order = check_count(f"{name}[{i}] order", given.order, at_least=lowest)
        check_number(f"{name}[{i}] order", order, at_most=LARGEST_ORDER)
        amplitude = check_number(f"{name}[{i}] amplitude", given.amplitude, at_least=0.0)
        checked.append(Harmonic(order, amplitude, check_number(f"{name}[{i}] phase", given.phase)))
    return tuple(checked)


PARTS = {"StiffnessWave": StiffnessWave, "Rectangle": Rectangle, "Harmonic": Harmonic}  # of the repr of an oscillator
WHOLE = ("stiffness", "harmonics")  # the fields that are no scalars
SCALARS = tuple(f.name for f in fields(Oscillator) if f.name not in WHOLE)
WAVE_SCALARS = ("contact_ratio", "a", "b")
