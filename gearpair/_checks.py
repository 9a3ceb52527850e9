"""Bad input gets one sentence: the name, the value, and what is allowed."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from decimal import Decimal
from functools import cache, wraps
from inspect import Parameter, signature
from itertools import chain, repeat
from numbers import Integral, Real
from types import SimpleNamespace, UnionType
from typing import Any, NamedTuple, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

SHOWN_NAMES = 8  # of a dataset's variables, in a sentence
Function = TypeVar("Function", bound=Callable[..., Any])


def check_number(
    name: str,
    value: Any,
    *,
    above: float | None = None,
    at_least: float | None = None,
    below: float | None = None,
    at_most: float | None = None,
) -> float:
    """Return `value` as a float, or raise a ValueError that names it and the allowed range."""
    numeric = isinstance(value, float) or is_number(value)  # most are floats, and told faster
    number = float(value) if numeric else math.nan
    if (
        math.isfinite(number)
        and (above is None or number > above)
        and (at_least is None or number >= at_least)
        and (below is None or number < below)
        and (at_most is None or number <= at_most)
    ):
        return number
    limits = [
        f"{word} {limit:g}"
        for word, limit in (("above", above), ("at least", at_least), ("below", below), ("at most", at_most))
        if limit is not None
    ]
    allowed = "a finite number" + (" " + " and ".join(limits) if limits else "")
    raise ValueError(f"{name} must be {allowed}, got {number if numeric else shown(value)}")


def is_number(value: Any) -> bool:
    """Whether a value is one real number; no truth value, no time, no text."""
    if isinstance(value, (float, Real, Decimal)):
        return not isinstance(value, (bool, np.timedelta64))
    kind = getattr(value, "dtype", None)
    return kind is not None and np.shape(value) == () and kind.kind in "fiu" and not np.ma.is_masked(value)


def check_array(
    name: str, values: Any, *, ndim: int | None = None, at_least: float | None = None, finite: bool = True
) -> NDArray[np.float64]:
    """Return `values` as an array of floats, finite unless not asked for, or raise a ValueError that tells.

    Texts, times, truth values, complex numbers and masked ones are no numbers.
    """
    masked = isinstance(values, np.ma.MaskedArray)
    try:
        array = np.ma.asanyarray(values) if masked else np.asarray(values)
    except ValueError:
        raise ValueError(f"{name} must be numbers in rows of one length, got {shown(values)}") from None
    if masked and np.ma.is_masked(array):
        raise ValueError(f"{name} must be numbers, got masked ones among them: leave them out")
    if array.dtype.kind == "O" and array.size and all(map(is_number, array.flat)):
        array = array.astype(float)
    if array.dtype.kind not in "fiu" and array.size:
        wrong = next((each for each in array.flat if not is_number(each)), array.flat[0])
        raise ValueError(f"{name} must be real numbers, got {shown(getattr(wrong, 'item', lambda: wrong)())}")
    found = np.asarray(array, dtype=float)
    if ndim is not None and (found.ndim != ndim or found.size == 0):
        raise ValueError(f"{name} must be a non-empty sequence of numbers, got shape {found.shape}")
    if finite and not np.isfinite(found).all():
        raise ValueError(f"{name} must be finite, got {found[~np.isfinite(found)].flat[0]}")
    if at_least is not None and found.size:
        check_number(name, float(found.min()), at_least=at_least)
    return found


def check_truths(name: str, value: Any) -> NDArray[np.bool_]:
    """The truth values, of any shape, one at least; or a ValueError."""
    truths = np.array(value, dtype=object) if isinstance(value, list) else np.asarray(value)
    truths = truths.astype(bool) if all(isinstance(each, (bool, np.bool_)) for each in truths.flat) else truths
    if truths.size == 0 or truths.dtype != bool:
        raise ValueError(f"{name} must hold truth values, one at least, got {shown(value)}")
    return truths


def plain(values: NDArray[np.float64]) -> Any:
    """An array as it is, but for one of no dimension, which becomes a float: what comes of a number is a number."""
    return float(values) if np.ndim(values) == 0 else values


def check_reach(name: str, reach: Any) -> tuple[float, float]:
    """Return two finite numbers in rising order, or raise a ValueError."""
    try:
        found = check_array(name, reach)
    except ValueError:
        found = np.empty(0)
    if found.shape != (2,) or not found[0] < found[1]:
        raise ValueError(f"{name} must be two finite numbers in rising order, got {shown(reach)}")
    return float(found[0]), float(found[1])


def shown(value: Any) -> str:
    """A value for a sentence: in full where it is short."""
    text = repr(value)
    if len(text) <= 80 and "\n" not in text:
        return text
    shape = f" of shape {np.shape(value)}" if isinstance(value, (list, tuple)) or hasattr(value, "dtype") else ""
    return f"{_article(type(value).__name__)}{shape}"


def check_fields(of: Any, **limits: Mapping[str, float]) -> None:
    """Let fields of a frozen dataclass be floats within limits, as `check_number` has them, or None by default."""
    for name, limit in limits.items():
        if getattr(of, name) is not None or getattr(type(of), name, 0.0) is not None:
            object.__setattr__(of, name, check_number(name, getattr(of, name), **limit))


def check_count(name: str, value: Any, *, at_least: int = 1, at_most: int | None = None) -> int:
    """Return `value` as an int, or raise a ValueError."""
    if isinstance(value, (bool, np.timedelta64)) or not isinstance(value, (int, Integral)) or value < at_least:
        raise ValueError(f"{name} must be a whole number of at least {at_least}, got {shown(value)}")
    if at_most is not None and int(value) > at_most:
        raise ValueError(f"{name} must be a whole number of at most {at_most}, got {shown(value)}")
    return int(value)


def check_options(options: Mapping[str, Any], allowed: Collection[str]) -> None:
    """Raise a TypeError unless all `options` are among the `allowed`."""
    for name, value in options.items():
        if name not in allowed:
            raise TypeError(f"unknown option {name}={value!r}: the options are {', '.join(allowed)}")


def check_choice(name: str, value: Any, choices: Collection[str]) -> None:
    """Raise a ValueError unless `value` is one of `choices`."""
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, choices))}, got {shown(value)}")


STARTS = ("x", "v")  # numbers, or arrays of them; what is wrong with them `check_starts` says
# What makes an object of a class, by its name; and what to hand over where another one has it.
MADE_BY = {
    "Attractors": "as gearpair.attractors gives it",
    "Bifurcation": "one of the bifurcations of a Branch",
    "BifurcationCurve": "as gearpair.continue_bifurcation gives it",
    "Branch": "as gearpair.continue_orbit gives it",
    "Dataset": "as gearpair.sweep, parameter_map, basins and the like give it",
    "GearDrive": "as GearDrive.from_pair gives it",
    "Impacts": "the impacts of a Trajectory",
    "LoadedMesh": "as gearpair.teeth.loaded_mesh gives it",
    "MeshStiffness": "as gearpair.mesh_stiffness gives it",
    "PeriodicOrbit": "as gearpair.periodic_orbit gives it",
    "Spectrum": "as gearpair.spectrum gives it",
    "SpurGear": "as the pinion of a SpurPair",
    "SteadyState": "as gearpair.steady_state gives it",
    "StiffnessWave": "as StiffnessWave.rectangular gives it",
    "Trajectory": "as gearpair.trajectory gives it",
}
HAS = {
    ("Oscillator", "Attractors"): "its oscillator",
    ("Oscillator", "GearDrive"): "its oscillator()",
    ("Oscillator", "SteadyState"): "its oscillator",
    ("Oscillator", "PeriodicOrbit"): "its oscillator",
    ("Oscillator", "Trajectory"): "its oscillator",
    ("Oscillator", "Bifurcation"): "its oscillator",
    ("Oscillator", "Branch"): "its oscillator",
    ("Oscillator", "Dataset"): "Oscillator.from_attrs of it",
    ("StiffnessWave", "Oscillator"): "its stiffness",
    ("StiffnessWave", "MeshStiffness"): "what it makes of itself by wave()",
    ("StiffnessWave", "LoadedMesh"): "what it makes of itself by wave()",
    ("Bifurcation", "Branch"): "one of its bifurcations",
    ("SpurPair", "GearDrive"): "its mesh.pair",
    ("SpurPair", "MeshStiffness"): "its pair",
    ("SpurGear", "SpurPair"): "its pinion or gear",
    ("MeshStiffness", "SpurPair"): "gearpair.mesh_stiffness of it",
    ("MeshStiffness", "GearDrive"): "its mesh",
    ("MeshStiffness", "LoadedMesh"): "its mesh",
    ("LoadedMesh", "GearDrive"): "its loaded_mesh",
    ("Spectrum", "Trajectory"): "gearpair.spectrum of it",
    ("Trajectory", "SteadyState"): "gearpair.trajectory of its oscillator from one of its points",
    ("Trajectory", "PeriodicOrbit"): "gearpair.trajectory of its oscillator from one of its points",
    ("SteadyState", "Oscillator"): "gearpair.steady_state of it",
    ("Motion", "SteadyState"): "its motion",
}


def check_class(name: str, value: Any, *classes: type) -> None:
    """Raise a TypeError unless `value` is of one of `classes`: it says what to hand over."""
    if isinstance(value, classes):
        return
    wanted = [each.__name__ for each in classes]
    got = [each.__name__ for each in type(value).__mro__]
    better = [HAS[want, have] for want in wanted for have in got if (want, have) in HAS]
    hint = f": hand over {better[0]}" if better else f", {MADE_BY[wanted[0]]}" if wanted[0] in MADE_BY else ""
    if better:
        raise TypeError(f"{name} must be {' or '.join(map(_article, wanted))}, got {_article(got[0])}{hint}")
    raise TypeError(f"{name} must be {' or '.join(map(_article, wanted))}{hint}; got {shown(value)}")


def checked(function: Function) -> Function:
    """Let a public function say in a sentence what it was handed by mistake: what its annotations do not allow.

    Classes of the library, datasets, texts, truth values, mappings and sequences of these raise a TypeError; ranges of
    numbers are the function's own, but nan is none. A dataset without what a function reads in it raises a ValueError.
    """
    parameters = signature(function).parameters
    extra = next((name for name, each in parameters.items() if each.kind is Parameter.VAR_POSITIONAL), "")
    places = list(parameters)[: list(parameters).index(extra) if extra else None]

    @wraps(function)
    def called(*given: Any, **named: Any) -> Any:
        rules = _rules(function)
        by_place = zip(chain(places, repeat(extra)), given, strict=False)
        for name, value in chain(by_place, named.items()):
            if name in rules:
                kinds, at_once = rules[name]
                if type(value) not in at_once or (isinstance(value, float) and value != value):
                    _check_kind(name, value, kinds)
        try:
            return function(*given, **named)
        except (AttributeError, KeyError) as error:
            missing = _missing(error, [*given, *named.values()])
            if missing is None:
                raise
            raise ValueError(f"{function.__name__} needs {missing}") from error

    return called  # type: ignore[return-value]


class _Dataset:
    """Stands for `xarray.Dataset`, which is not imported before it is used."""


class _Rule(NamedTuple):
    """What a parameter may be."""

    kinds: tuple[Any, ...]
    at_once: frozenset[Any]  # types of which any value but nan is right, and most values are


@cache
def _rules(function: Callable[..., Any]) -> dict[str, _Rule]:
    """What each parameter of a function may be, where that can be told from its annotation."""
    unknown = {"xr": SimpleNamespace(Dataset=_Dataset), "Client": Any, "Group": Any}
    hints = get_type_hints(function, localns=unknown)
    keywords = {name for name, each in signature(function).parameters.items() if each.kind is Parameter.VAR_KEYWORD}
    found = {name: _kinds(hint) for name, hint in hints.items() if name != "return" and name not in keywords}
    return {name: _Rule(kinds, _right_at_once(kinds)) for name, kinds in found.items() if kinds}


def _right_at_once(kinds: tuple[Any, ...]) -> frozenset[type]:
    """The types of which any value but nan is of one of the `kinds`, without a look at members."""
    numbers = (float, np.float64, int) if float in kinds or int in kinds else ()
    return frozenset((*kinds, *numbers))


def _kinds(hint: Any) -> tuple[Any, ...]:
    """The kinds of an annotation; none where anything might be meant."""
    kinds = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    return kinds if all(_known(kind) for kind in kinds) else ()


def _known(kind: Any) -> bool:
    if kind is type(None) or kind in (str, bool, int, float):
        return True
    if get_origin(kind) in (list, Sequence, Iterable, Mapping):
        return True
    return isinstance(kind, type) and kind.__module__.split(".")[0] in ("gearpair", "matplotlib", "xarray", "pathlib")


def _check_kind(name: str, value: Any, kinds: tuple[Any, ...]) -> None:
    """Raise a TypeError unless a value is of one of the `kinds`."""
    numbers = int in kinds or float in kinds
    if any(_is_kind(value, kind) for kind in kinds) or (numbers and name in STARTS):
        if float in kinds and name not in STARTS and is_number(value) and value != value:
            raise ValueError(f"{name} must be a finite number, got nan")
        for kind in kinds:
            _check_members(name, value, kind)
        return
    classes = [kind for kind in kinds if isinstance(kind, type) and kind not in (type(None), str, bool, int, float)]
    if classes:
        check_class(name, value, *(type("Dataset", (), {}) if each is _Dataset else each for each in classes))
    words = {str: "a text", bool: "True or False", int: "a whole number", float: "a number", type(None): "None"}
    words |= {list: "a list", Sequence: "a sequence", Iterable: "a sequence", Mapping: "a mapping, as {name: ...}"}
    told = [words[get_origin(kind) or kind] for kind in kinds]
    raise TypeError(f"{name} must be {' or '.join(told)}, got {shown(value)}")


def _is_kind(value: Any, kind: Any) -> bool:
    origin = get_origin(kind) or kind
    if origin is str:
        return isinstance(value, str)
    if origin is bool:
        return isinstance(value, (bool, np.bool_))
    if origin in (int, float):  # its range is the function's own
        return is_number(value) or isinstance(value, bool)
    if origin is _Dataset:
        return any(each.__name__ == "Dataset" for each in type(value).__mro__)
    if origin is Mapping:
        return isinstance(value, Mapping)
    if origin in (list, Sequence, Iterable):
        return isinstance(value, Iterable) and not isinstance(value, (str, bytes, Mapping))
    return isinstance(value, origin)


def _check_members(name: str, value: Any, kind: Any) -> None:
    """Raise a TypeError for a wrong member of a sequence or a mapping that can be looked through twice."""
    origin, inside = get_origin(kind), get_args(kind)
    if is_number(value):  # an array without dimensions is no sequence
        return
    if origin is Mapping and isinstance(value, Mapping):
        kinds, members = _kinds(inside[1]), list(value.items())
    elif origin in (list, Sequence, Iterable) and isinstance(value, (list, tuple, np.ndarray)):
        kinds, members = _kinds(inside[0]), list(enumerate(value))
    else:
        return
    for key, member in members if kinds else ():
        _check_kind(f"{name}[{key!r}]", member, kinds)


def _missing(error: Exception, given: list[Any]) -> str | None:
    """What a dataset lacks that an error came from, in a sentence's words; None where the error is another one's."""
    held = getattr(error, "obj", None)
    wanted = getattr(error, "name", None) or (error.args[0] if error.args else None)
    datasets = [each for each in given if _is_kind(each, _Dataset)]
    if isinstance(error, AttributeError) and not _is_kind(held, _Dataset):
        return None
    if not datasets or (isinstance(error, KeyError) and any(str(wanted) in each for each in datasets)):
        return None
    held_names = list(map(str, datasets[0].data_vars))
    holds = ", ".join(held_names[:SHOWN_NAMES]) + ", ..." * (len(held_names) > SHOWN_NAMES)
    name = str(wanted).removeprefix("No variable named ").split(". ")[0].strip("'")
    return f"a dataset that holds {name!r}, got one that holds {holds or 'nothing'}"


def _article(noun: str) -> str:
    return f"{'an' if noun[0] in 'AEIOaeio' else 'a'} {noun}"
