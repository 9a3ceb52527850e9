"""Chapters with other parameters, as pages of their own: what ``book/variants.yml`` declares.

::

    common:                      # for every variant whose chapter has the parameter
      damping_ratio: 0.02
    variants:
      swapped:                   # the page is CHAPTER_swapped, under its chapter
        chapter: frequency_sweep
        title: The mesh frequency, with the swapped wave
        why: One or two sentences, shown at the head.
        parameters:
          reading: swapped
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
import yaml
from nbformat.v4 import new_markdown_cell

from gearpair.study.chapters import Chapter
from gearpair.study.errors import StudyError
from gearpair.study.record import changed

FIELDS = ("chapter", "title", "why", "parameters")
# Where MyST defines a label: (label)= before a block, $$ (label) after a formula, :label: and :name: of a directive.
DEFINED = re.compile(r"^\(([\w-]+)\)=$|^\$\$ \(([\w-]+)\)$|^:(?:label|name): ([\w-]+)$", re.MULTILINE)


@dataclass(frozen=True)
class Variant:
    """A chapter with other parameters."""

    name: str  # of the page: the chapter's name, an underscore, and what the variant is called
    chapter: Chapter
    title: str  # this and the next are shown at the head
    why: str
    values: dict[str, Any]  # all that are given, the common ones included


def read_variants(path: Path, chapter: Callable[[str], Chapter]) -> list[Variant]:
    """The variants that the file declares, none where there is no file; a StudyError names what is wrong with one."""
    if not path.is_file():
        return []
    try:
        declared = yaml.safe_load(path.read_text(encoding="utf-8")) or {}
        common, variants = declared.get("common") or {}, declared.get("variants") or {}
        entries = [(str(name), dict(entry)) for name, entry in variants.items()]
    except (yaml.YAMLError, AttributeError, TypeError, ValueError) as error:
        raise StudyError(f"{path} is not a list of variants: {str(error).splitlines()[0]}") from None
    found = []
    for name, entry in entries:
        if set(entry) != set(FIELDS) or not re.fullmatch(r"[a-z0-9_]+", name):
            raise StudyError(f"variant {name!r} in {path} must have a name of a-z, 0-9, _ and {', '.join(FIELDS)}")
        try:
            read = chapter(entry["chapter"])
            shared = {key: value for key, value in common.items() if key in read.defaults}
            values = read.convert({**shared, **(entry["parameters"] or {})})
        except StudyError as error:
            raise StudyError(f"variant {name!r} in {path}: {error}") from None
        found.append(Variant(f"{read.name}_{name}", read, entry["title"].strip(), entry["why"].strip(), values))
    return found


def variant_page(variant: Variant, executed: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """The executed notebook as a page beside its chapter: what was changed at its head, its labels its own."""
    notebook = nbformat.from_dict(executed)
    renamed = _renaming(defined_labels(notebook), variant.name.removeprefix(f"{variant.chapter.name}_"))
    title = f"# {variant.chapter.title}"
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = renamed(cell.source)
            if title in cell.source.splitlines():
                cell.source = cell.source.replace(title, f"#{title}", 1)
        figure = cell.metadata.get("mystnb", {}).get("figure", {})
        if "name" in figure:
            figure["name"] = renamed(f"`{figure['name']}`")[1:-1]
        if "caption" in figure:
            figure["caption"] = renamed(figure["caption"])
    notebook.cells.insert(0, new_markdown_cell(_head(variant), id="what-was-changed"))
    return notebook


def _head(variant: Variant) -> str:
    declared = {parameter.name: parameter for parameter in variant.chapter.parameters}
    rows = [
        f"| `{name}` | {declared[name].comment} | `{declared[name].default!r}` | **`{value!r}`** |"
        for name, value in changed(variant.chapter, variant.values).items()
    ]
    table = "\n".join(["| parameter | what it is | in the chapter | here |", "|---|---|---|---|", *rows])
    chapter = f"[{variant.chapter.title}]({variant.chapter.path.name})"
    return (
        f"# {variant.title}\n\n{variant.why}\n\n"
        f"This page is the chapter {chapter}, computed again with other parameters. Figures, tables and the numbers in "
        "the text are those of this variant; what the chapter says of its own parameters alone is left out."
        f"\n\n{table}"
    )


def defined_labels(notebook: nbformat.NotebookNode) -> set[str]:
    """The labels that a chapter gives to its sections, formulas, directives and figures."""
    found: set[str] = set()
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            found |= {label for groups in DEFINED.findall(cell.source) for label in groups if label}
        name = cell.metadata.get("mystnb", {}).get("figure", {}).get("name")
        found |= {name} if name else set()
    return found


def _renaming(labels: set[str], suffix: str) -> Callable[[str], str]:
    """A function that appends `suffix` to the labels where a text of MyST defines or refers to them."""
    if not labels:
        return lambda text: text
    names = "|".join(sorted(map(re.escape, labels), key=len, reverse=True))
    after = "|".join(["(?<=^:label: )", "(?<=^:name: )", r"(?<=\{solution\} )", r"(?<=\{solution-start\} )"])
    place = re.compile(rf"(?<=[(`<#])(?:{names})(?=[)`>])|(?:{after})(?:{names})$", re.MULTILINE)
    return lambda text: place.sub(lambda match: f"{match[0]}-{suffix.replace('_', '-')}", text)


def with_variants(toc: Any, variants: Mapping[str, list[str]]) -> Any:
    """The table of contents with the variants' files under their chapters'."""
    if isinstance(toc, list):
        return [with_variants(entry, variants) for entry in toc]
    if not isinstance(toc, dict):
        return toc
    entry = {key: with_variants(value, variants) for key, value in toc.items()}
    if under := variants.get(entry.get("file", "")):
        entry["sections"] = [*entry.get("sections", []), *({"file": file} for file in under)]
    return entry
