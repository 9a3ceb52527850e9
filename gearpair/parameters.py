"""A chapter's parameters, checked before anything is computed: ranges and relations by the library's own checks.

The cell after a chapter's parameters calls `check_parameters`. papermill runs it first, whether values come from its
command line or from a file; `gearpair run` runs the same cell before it starts a kernel.
"""

import ast
import os
from collections.abc import Callable, Mapping
from dataclasses import fields
from difflib import get_close_matches
from functools import partial
from math import prod
from typing import Any

from gearpair._checks import check_count, check_number
from gearpair.drive import GearDrive
from gearpair.motion.trajectories import check_start
from gearpair.oscillator import Oscillator
from gearpair.stiffness import StiffnessWave
from gearpair.teeth import SpurPair, mesh_stiffness

OSCILLATOR = tuple(field.name for field in fields(Oscillator) if field.name != "stiffness")
WAVE = ("contact_ratio", "a", "b", "reading")
PAIR = tuple(field.name for field in fields(SpurPair))
MESH = ("root", "foundation", "coupling")
DRIVE = ("pinion_torque_nm", "transmission_error_um", "damping_ratio")
ADDED = ("pinion_added_inertia_kg_m2", "gear_added_inertia_kg_m2")
STANDS_FOR = {
    **dict.fromkeys(("lowest", "highest", "chaos_near", "frequency_from", "frequency_to"), "mesh_frequency"),
    "weak_damping": "damping_ratio",
}
LISTS = {"long_speeds": "mesh_frequency"}  # of values of a scalar
STARTS = ("first_start", "second_start")
SPEEDS = ("lowest_rpm", "highest_rpm")
CHOSEN = (*SPEEDS, "ramp_seconds", "rig_step_rpm")  # none: the chapter's choice
RANGES = (("lowest", "highest"), ("lower", "upper"), ("frequency_from", "frequency_to"), SPEEDS)
AXES = ("n_values", "n_fine", "n_x", "n_v", "n_speeds")  # from one end to another
PAIRS = (*AXES, "n_reached", "n_steps", "n_phases")  # of n_reached half as many dampings
FEWEST = dict.fromkeys(PAIRS, 2) | {"n_transient": 0, "n_starts": 0, "n_speeds": 5}
# What a chapter computes in one go: as many motions as these numbers make together, where it has them.
PARTS = (
    *(("n_values",), ("n_fine",), ("n_reached",), ("n_x", "n_v"), ("n_frequency", "n_other")),
    *(("n_shares", "n_starts"), ("n_speeds", "n_starts")),
)
MOST_MOTIONS = 10**7  # of each about a kilobyte is kept
INJECTED = "# Parameters"  # how papermill begins the cell that it puts in
BASELINE = "baseline"  # the tag of a text cell that speaks of the chapter's own parameters
LEAVES_OUT = "GEARPAIR_LEAVES_OUT_BASELINE"  # in the environment of a kernel whose notebook loses those cells


def check_parameters(values: Mapping[str, Any], **stands_for: str) -> None:
    """Check a chapter's parameters by the objects that they feed; they are told by their names.

    Where papermill has put in others than the chapter's own, print which, and that the text cells tagged ``baseline``
    speak of the chapter's own. `gearpair run` leaves those cells out, and then nothing is printed.

    Parameters
    ----------
    values : mapping of str to object
        The parameters; a chapter gives ``globals()``, of which only the names that are known here are looked at.
    **stands_for
        For names that mean different things in different chapters: the scalar of the oscillator that one is a value
        of, ``highest="damping_ratio"``. Without it, ``lowest`` and ``highest`` are mesh frequencies.

    Raises
    ------
    ValueError
        Naming the parameter, its value and what is allowed. In a notebook that papermill runs, also for a parameter
        that the chapter does not have.

    Examples
    --------
    >>> check_parameters({"damping_ratio": 0.05, "lowest": 0.7, "highest": 1.7, "n_values": 101})
    >>> check_parameters({"lowest": 1.7, "highest": 0.7})
    Traceback (most recent call last):
        ...
    ValueError: lowest must be below highest, got lowest = 1.7 and highest = 0.7
    """
    changed = _changed(values)
    osc = oscillator_of(values)
    if pair := _chosen(values, PAIR):
        mesh_stiffness(SpurPair(**pair), **_chosen(values, MESH))
    if "pinion_torque_nm" in values:
        backlash = SpurPair(**pair).normal_backlash_um(**_chosen(values, ("backlash_um", "backlash")))
        GearDrive.from_pair(SpurPair(**pair), backlash_um=backlash, **_chosen(values, DRIVE))
    path = values.get("drive")  # a drive's file; later in a chapter it is the drive
    if isinstance(path, str) and GearDrive.from_file(path).pinion_torque_nm == 0.0:
        raise ValueError(f"{path}: a chapter needs a pinion_torque_nm other than 0; gearpair drive takes an idle gear")
    for name, scalar in {**STANDS_FOR, **stands_for}.items():
        if name in values:
            _check_as(name, partial(osc.replace, **{scalar: values[name]}))
    for name, scalar in LISTS.items():
        for value in values.get(name, ()):
            _check_as(name, partial(osc.replace, **{scalar: value}))
    for low, high in RANGES:
        first, last = values.get(low), values.get(high)
        if first is not None and last is not None and not first < last:
            raise ValueError(f"{low} must be below {high}, got {low} = {first} and {high} = {last}")
    for name, value in values.items():
        _check_alone(name, value)
    for part in PARTS:
        counts = {name: values[name] for name in part if isinstance(values.get(name), int)}
        if prod(counts.values()) > MOST_MOTIONS:
            names, got = " x ".join(counts), " x ".join(map(str, counts.values()))
            raise ValueError(f"{names} must be at most {MOST_MOTIONS}, the motions that memory holds, got {got}")
    if changed and LEAVES_OUT not in os.environ:
        print(f"Changed: {', '.join(changed)}. Text cells tagged {BASELINE!r} speak of the chapter's own parameters.")


def oscillator_of(values: Mapping[str, Any]) -> Oscillator:
    """The oscillator of a chapter's parameters; what they do not name is the baseline's.

    Examples
    --------
    >>> oscillator_of({"damping_ratio": 0.05, "reading": "swapped", "n_values": 101}).damping_ratio
    0.05
    """
    wave = StiffnessWave.rectangular(**_chosen(values, WAVE))
    return Oscillator(**_chosen(values, OSCILLATOR), stiffness=wave)


def _chosen(values: Mapping[str, Any], names: tuple[str, ...]) -> dict[str, Any]:
    return {name: values[name] for name in names if name in values}


def _check_as(name: str, check: Callable[[], object]) -> None:
    """Let an error of the library say which parameter of the chapter it is about."""
    try:
        check()
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def _check_alone(name: str, value: Any) -> None:
    """What can be said of one parameter by itself."""
    if name.startswith("n_") or name in ("longest", "dip_cycles"):
        if isinstance(value, int | float):  # a chapter may call an array of its own n_...
            check_count(name, value, at_least=FEWEST.get(name, 1))
    elif name in STARTS:
        if len(value) != 2:
            raise ValueError(f"{name} must be the two numbers X and X', got {value!r}")
        _check_as(name, lambda: check_start(*value))
    elif name in ("start_x", "start_v", "coast_torque_nm"):
        check_number(name, value)
    elif name in ("x_reach", "v_reach", "pinion_torque_nm", "weak_damping", "tip_in_seconds") or (
        name in CHOSEN and value is not None
    ):
        check_number(name, value, above=0.0)
    elif name in ("narrowest", "base_pitch_um", "profile_um", *ADDED):
        check_number(name, value, at_least=0.0)
    elif name == "tolerances":
        if not value:
            raise ValueError("tolerances must be at least one number, got none")
        for each in value:
            check_number(name, each, above=0.0, below=1.0)
    elif name == "phase_step" and 180 % check_count(name, value):
        raise ValueError(f"phase_step must be a divisor of 180 degrees, got {value}")


def unknown_name(name: str, known: Mapping[str, Any] | list[str], of: str) -> str:
    """One sentence for a name that `of` does not have: the one that was meant, or all there are.

    Examples
    --------
    >>> unknown_name("damping_ration", ["a", "damping_ratio"], "stiffness")
    "stiffness has no parameter 'damping_ration'; did you mean 'damping_ratio'?"
    """
    close = get_close_matches(name, [*known], 1)
    help_ = f"did you mean {close[0]!r}?" if close else f"it has {', '.join(known)}"
    return f"{of} has no parameter {name!r}; {help_}"


def _changed(values: Mapping[str, Any]) -> list[str]:
    """What papermill put in and differs from the chapter's own cell; refuse a name which that does not declare.

    papermill only warns of one, in its own log, and leaves no trace in the kernel but the cell that it put in: an
    ordinary assignment, like the chapter's own later ones. So the texts of the cells are read, of which IPython keeps a
    list, `In`.
    """
    declared: dict[str, Any] = {}
    changed = []
    for text in values.get("In", []):
        if text.startswith(INJECTED):
            for statement in ast.parse(text).body:
                for target in statement.targets if isinstance(statement, ast.Assign) else []:
                    if not isinstance(target, ast.Name) or not declared:
                        continue
                    if target.id not in declared:
                        raise ValueError(unknown_name(target.id, sorted(declared), "this chapter"))
                    value, own = _literal(statement.value), declared[target.id]
                    if value != own:
                        changed.append(f"{target.id} = {value!r} (the chapter's own is {own!r})")
        else:
            declared = _annotated(text) or declared
    return changed


def _literal(value: ast.expr) -> Any:
    try:
        return ast.literal_eval(value)
    except ValueError:  # papermill writes float('nan')
        return ast.unparse(value)


def _annotated(text: str) -> dict[str, Any]:
    """The names and literals that a cell of annotated literals declares; none for any other cell."""
    try:
        body = ast.parse(text).body
        found = {
            s.target.id: ast.literal_eval(s.value)
            for s in body
            if isinstance(s, ast.AnnAssign) and isinstance(s.target, ast.Name) and s.value is not None
        }
    except (SyntaxError, ValueError):  # a cell may hold a magic of IPython, or annotate what it computes
        return {}
    return found if len(found) == len(body) else {}
