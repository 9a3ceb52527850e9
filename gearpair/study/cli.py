"""The command ``gearpair``: list the chapters, run one, build the book, accept new outputs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from gearpair.study.errors import StudyError

EPILOG = """examples:
  gearpair chapters
  gearpair run stiffness -p gear_teeth 54 -p module_mm 2 -o larger.ipynb
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code: 0, 1 for a failure told in one sentence, 2 for wrong usage."""
    options = _parser().parse_args(_join_parameters(sys.argv[1:] if arguments is None else arguments))
    try:
        options.command(options)
    except StudyError as error:
        print(f"gearpair: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("gearpair: stopped", file=sys.stderr)
        return 130
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gearpair",
        description="Nonlinear dynamics of a spur gear pair: run the study's chapters and build its book.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--root", type=Path, metavar="DIR", help="the checkout (default: found from here upwards)")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    chapters = commands.add_parser("chapters", help="list the chapters and their parameters")
    chapters.set_defaults(command=_chapters)

    run = commands.add_parser("run", help="execute one chapter with parameters of your own")
    run.add_argument("chapter", metavar="CHAPTER", help="a chapter's name, or the path of a notebook")
    run.add_argument("-p", "--parameter", action="append", default=[], metavar="NAME VALUE", help="may be repeated")
    run.add_argument("-o", "--output", type=Path, metavar="OUT.ipynb", help="default: CHAPTER-run.ipynb, here")
    run.set_defaults(command=_run)

    book = commands.add_parser("book", help="execute every chapter and build the book")
    book.set_defaults(command=_book)

    accept = commands.add_parser("accept", help="re-execute the source notebooks and store their new outputs")
    accept.set_defaults(command=_accept)
    return parser


def _join_parameters(arguments: Sequence[str]) -> list[str]:
    """Write ``-p NAME VALUE`` as one word, for argparse takes a value such as -1e-3 for an option."""
    joined, rest = [], list(arguments)
    while rest:
        word = rest.pop(0)
        if word in {"-p", "--parameter"} and len(rest) >= 2 and "=" not in rest[0]:
            word = f"--parameter={rest.pop(0)}={rest.pop(0)}"
        joined.append(word)
    return joined


def _chapters(options: argparse.Namespace) -> None:
    from gearpair.study.book import Book

    for chapter in Book.find(options.root).chapters():
        print(f"{chapter.name}: {chapter.title}")
        left = [f"{p.name}: {p.annotation} = {p.default!r}" for p in chapter.parameters]
        width = max(map(len, left), default=0)
        for text, parameter in zip(left, chapter.parameters, strict=True):
            print(f"  {text:<{width}}  {parameter.comment}")


def _run(options: argparse.Namespace) -> None:
    from gearpair.study.book import Book
    from gearpair.study.execution import execute

    chapter = Book.find(options.root).chapter(options.chapter)
    given = [_name_and_value(word) for word in options.parameter]
    values = chapter.parse(given)
    output = options.output or Path(f"{chapter.name}-run.ipynb")
    if output.suffix != ".ipynb":
        raise StudyError(f"the output must be a notebook (a name that ends in .ipynb), got {str(output)!r}")
    if not output.absolute().parent.is_dir():
        raise StudyError(f"there is no directory {output.absolute().parent} for the output")
    if output.exists() and output.samefile(chapter.path):
        raise StudyError(f"the output {str(output)!r} is the chapter's own source; choose another name")
    execute(chapter, output, values)
    print(output)


def _name_and_value(word: str) -> tuple[str, str]:
    name, equals, value = word.partition("=")
    if not equals:
        raise StudyError(f"-p needs a name and a value, got only {word!r}")
    return name, value


def _book(options: argparse.Namespace) -> None:
    from gearpair.study.book import Book, build_book

    print(f"The book is at {build_book(Book.find(options.root))}")


def _accept(options: argparse.Namespace) -> None:
    from gearpair.study.book import Book, accept_outputs

    changed = accept_outputs(Book.find(options.root))
    print(f"new outputs stored: {', '.join(changed)} (look at them with git diff)" if changed else "nothing changed")
