"""The reference of the library, made from its docstrings: one page for a folder of `gearpair`.

``.. room:: gearpair.motion`` lists the folder's public names with their first sentences and then documents each.
``.. face:: `` does the listing for what ``import gearpair as gp`` gives, with links to the folders' pages.
"""

from __future__ import annotations

import enum
import inspect
import re
from importlib import import_module
from types import ModuleType

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

# What Python makes of the types and defaults in a signature, and what the source says.
ANY_ARRAY = "_Buffer | _SupportsArray[dtype[Any]] | _NestedSequence[_SupportsArray[dtype[Any]]] | complex | bytes | str"
ANY_ARRAY += " | _NestedSequence[complex | bytes | str]"
SAID = (
    (r"~?\b(?:[A-Za-z_]\w*\.)+(?=[A-Za-z_])", ""),
    (re.escape(ANY_ARRAY), "ArrayLike"),
    (r"ndarray\[tuple\[Any, \.\.\.\], dtype\[(\w+)\]\]", r"NDArray[\1]"),
    (r"GearBlank\(rim_mm=None[^)]*\)", "GearBlank()"),
    (r"\*?<class '(?:\w+\.)*(\w+)'>", r"Unpack[\1]"),
    (r"<factory>", "..."),
)

MODULES = ("oscillator", "stiffness", "harmonics", "drive", "scales", "drive_file", "quantities", "table", "parameters")
FOLDERS = (
    "teeth",
    "motion",
    "ensembles",
    "bifurcations",
    "boundaries",
    "methods",
    "design",
    "article",
    "article.case",
    "plotting",
    "teaching",
)


def public_names(module: ModuleType) -> list[str]:
    """What a folder hands on, or a module defines; classes and functions only."""
    given = getattr(module, "__all__", None)
    names = given or [name for name in vars(module) if not name.startswith("_")]
    objects = {name: getattr(module, name) for name in names}
    callables = [name for name, obj in objects.items() if inspect.isclass(obj) or inspect.isroutine(obj)]
    return sorted(name for name in callables if given or objects[name].__module__ == module.__name__)


def homes() -> dict[str, str]:
    """Where each public object of the library is documented, by every dotted name that leads to it."""
    import gearpair

    home: dict[str, str] = {}
    of_object: dict[int, str] = {}
    for part in (*MODULES, *FOLDERS):
        module = import_module(f"gearpair.{part}")
        for name in public_names(module):
            obj, place = getattr(module, name), f"gearpair.{part}.{name}"
            of_object.setdefault(id(obj), place)
            home[f"{obj.__module__}.{obj.__qualname__}"] = of_object[id(obj)]
    for name in gearpair.__all__:
        place = of_object.get(id(getattr(gearpair, name)))
        if place:
            home[f"gearpair.{name}"] = place
    return {name: place for name, place in home.items() if name != place}


class Generated(SphinxDirective):
    """A directive that writes reStructuredText and has it parsed."""

    def parse(self, lines: list[str]) -> list[nodes.Node]:
        container = nodes.container()
        self.state.nested_parse(StringList(lines, source=self.get_source_info()[0]), self.content_offset, container)
        return container.children


class Room(Generated):
    """All public names of one module, in brief and then in full."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        listed = [f"   {item}" for item in public_names(import_module(name))]
        table = [f".. currentmodule:: {name}", "", ".. autosummary::", "   :nosignatures:", "", *listed, ""]
        members = ",".join(public_names(import_module(name)))
        return self.parse([*table, f".. automodule:: {name}", f"   :members: {members}", "   :imported-members:"])


class Face(Generated):
    """What ``import gearpair as gp`` gives: each name with its first sentence."""

    def run(self) -> list[nodes.Node]:
        import gearpair

        rows = [".. list-table::", "   :widths: 32 68", ""]
        for name in gearpair.__all__:
            place = homes().get(f"gearpair.{name}")
            if place:
                summary = inspect.getdoc(getattr(gearpair, name)).partition("\n\n")[0].replace("\n", " ")
                rows += [f"   * - :obj:`gp.{name} <{place}>`", f"     - {summary}"]
        return self.parse(rows)


def for_readers(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """A docstring as reStructuredText: a modulus such as |X| is no substitution; doctest flags are not for readers."""
    for number, line in enumerate(lines):
        pieces = re.split("(``.*?``)", re.sub(r"\s*# doctest:.*$", "", line))
        pieces[::2] = [re.sub(r"(?<![`|])\|([^|`\s]+)\|", r"\\|\1\\|", text) for text in pieces[::2]]
        lines[number] = "".join(pieces)


def without_machinery(app: Sphinx, what: str, name: str, obj: object, skip: bool, options: object) -> bool | None:
    """The fields of a named tuple stand among its attributes already; what Python says of them says nothing."""
    return True if str(getattr(obj, "__doc__", "")).startswith("Alias for field number") else None


def signature(
    app: Sphinx, what: str, name: str, obj: object, options: object, arguments: str | None, returns: str | None
) -> tuple[str | None, str | None]:
    """Types and defaults by their short names; an enumeration, which is not made by calling it, without the call."""
    if isinstance(obj, enum.EnumMeta):
        return "", ""
    texts = [arguments, returns]
    for pattern, said in SAID:
        texts = [text and re.sub(pattern, said, text) for text in texts]
    return texts[0], texts[1]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directives; tell the links in code where the names are documented."""
    app.add_directive("room", Room)
    app.add_directive("face", Face)
    app.connect("config-inited", lambda _, config: config.codeautolink_inventory_map.update(homes()), priority=1)
    app.connect("autodoc-process-docstring", for_readers)
    app.connect("autodoc-skip-member", without_machinery)
    app.connect("autodoc-process-signature", signature)
    return {"parallel_read_safe": True}
