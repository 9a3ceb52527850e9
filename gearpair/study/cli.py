"""The command ``gearpair``: list the chapters, run one, build the book, accept new outputs."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gearpair.study.errors import StudyError

if TYPE_CHECKING:
    from gearpair.study.book import Book

EPILOG = """\b
examples:
  gearpair chapters
  gearpair run stiffness -p gear_teeth 54 -p module_mm 2 -o larger.ipynb
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code: 0, 1 for a failure told in one sentence, 2 for wrong usage."""
    try:
        command.main(None if arguments is None else [*arguments], prog_name="gearpair", standalone_mode=False)
    except StudyError as error:
        print(f"gearpair: {error}", file=sys.stderr)
        return 1
    except click.UsageError as error:
        print(f"gearpair: {error.format_message()} See gearpair --help", file=sys.stderr)
        return 2
    except click.Abort:  # what click makes of a KeyboardInterrupt
        print("gearpair: stopped", file=sys.stderr)
        return 130
    return 0


@click.group(epilog=EPILOG, no_args_is_help=False, context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--root", type=click.Path(path_type=Path), metavar="DIR", help="The checkout; found from here upwards.")
@click.pass_context
def command(context: click.Context, root: Path | None) -> None:
    """Nonlinear dynamics of a spur gear pair: run the study's chapters and build its book."""
    context.obj = root


def _book(context: click.Context) -> Book:
    """The book that ``--root`` names; imported here, so that ``--help`` is quick."""
    from gearpair.study.book import Book

    return Book.find(context.obj)


@command.command()
@click.pass_context
def chapters(context: click.Context) -> None:
    """List the chapters and their parameters."""
    for chapter in _book(context).chapters():
        print(f"{chapter.name}: {chapter.title}")
        left = [f"{p.name}: {p.annotation} = {p.default!r}" for p in chapter.parameters]
        width = max(map(len, left), default=0)
        for text, parameter in zip(left, chapter.parameters, strict=True):
            print(f"  {text:<{width}}  {parameter.comment}")


@command.command()
@click.argument("chapter")
@click.option("-p", "--parameter", "given", nargs=2, multiple=True, metavar="NAME VALUE", help="May be repeated.")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="OUT.ipynb",
    help="Where the executed notebook goes; CHAPTER-run.ipynb, here, when not given.",
)
@click.pass_context
def run(context: click.Context, chapter: str, given: Sequence[tuple[str, str]], output: Path | None) -> None:
    """Execute one chapter with parameters of your own.

    CHAPTER is a chapter's name, or the path of a notebook.
    """
    from gearpair.study.execution import execute

    read = _book(context).chapter(chapter)
    values = read.parse(given)
    output = output or Path(f"{read.name}-run.ipynb")
    if output.suffix != ".ipynb":
        raise StudyError(f"the output must be a notebook (a name that ends in .ipynb), got {str(output)!r}")
    if not output.absolute().parent.is_dir():
        raise StudyError(f"there is no directory {output.absolute().parent} for the output")
    if output.exists() and output.samefile(read.path):
        raise StudyError(f"the output {str(output)!r} is the chapter's own source; choose another name")
    execute(read, output, values)
    print(output)


@command.command()
@click.pass_context
def book(context: click.Context) -> None:
    """Execute every chapter and build the book."""
    from gearpair.study.book import build_book

    print(f"The book is at {build_book(_book(context))}")


@command.command()
@click.pass_context
def accept(context: click.Context) -> None:
    """Re-execute the source notebooks and store their new outputs."""
    from gearpair.study.book import accept_outputs

    changed = accept_outputs(_book(context))
    print(f"new outputs stored: {', '.join(changed)} (look at them with git diff)" if changed else "nothing changed")
