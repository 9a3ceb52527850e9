"""The command ``gearpair``: the verdict on a drive, list the chapters, run one, build the book."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any

import click
import yaml

from gearpair.study.course_cli import course
from gearpair.study.errors import StudyError

if TYPE_CHECKING:
    from gearpair.study.book import Book

EPILOG = """\b
the study behind it:
  gearpair chapters
  gearpair run stiffness -p gear_teeth 54 -p module_mm 2 -o larger.ipynb
  gearpair run impacts -p mean_force 0.3 --html
"""
STOPPED = 130


class _Named(click.Path):
    """A path with a name: an empty one would be taken for the directory it is in."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("a name is needed, got ''", param, ctx)
        return super().convert(value, param, ctx)


class _Command(click.Command):
    """A command whose every wrong usage points to its own help."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        try:
            return super().parse_args(ctx, args)
        except click.UsageError as error:
            error.ctx = error.ctx or ctx
            raise


class _Group(click.Group):
    command_class = _Command
    group_class = type  # a group within is of this class too


PATH: Any = _Named(path_type=Path)


def main(arguments: Sequence[str] | None = None, *, run: click.Command | None = None, name: str = "gearpair") -> int:
    """Run the command line; return the exit code: 0, 1 for a failure told in one sentence, 2 for wrong usage.

    `run` is another command than `command`, called `name`, to be run in the same way.
    """
    try:
        with _stopped_by_signals():
            (run or command).main(None if arguments is None else [*arguments], prog_name=name, standalone_mode=False)
    except StudyError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 1
    except click.UsageError as error:
        told = error.format_message()
        where = error.ctx.command_path if error.ctx else name
        print(f"{name}: {told}{'' if told.endswith(('.', '?')) else '.'} See {where} --help", file=sys.stderr)
        return 2
    except click.Abort:  # what click makes of a KeyboardInterrupt
        print(f"{name}: stopped", file=sys.stderr)
        return STOPPED
    return 0


@contextmanager
def _stopped_by_signals() -> Iterator[None]:
    """Let SIGTERM stop the command as Ctrl-C does, so that it clears up; further ones do not disturb it in that."""

    def stop(number: int, frame: FrameType | None) -> None:
        for each in before:  # not SIG_IGN: of one that is on its way already Python would print a traceback
            signal.signal(each, lambda *_: None)
        raise KeyboardInterrupt

    before = {each: signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)}
    try:
        for each in before:
            signal.signal(each, stop)
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


@click.group(cls=_Group, epilog=EPILOG, no_args_is_help=False, context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--root", type=PATH, metavar="DIR", help="The checkout; found from here upwards.")
@click.pass_context
def command(context: click.Context, root: Path | None) -> None:
    """A drawing, one command, one figure: at which speeds the teeth of a gear pair part.

    \b
      gearpair drive --example > pair.yml          a drawing with a comment to each line: put yours in
      gearpair drive pair.yml --html report.html   the verdict, and the figure with it

    For spur gears: one mesh, rigid shafts. The other commands run the chapters of the study and build its book.
    """
    context.obj = root


def _book(context: click.Context) -> Book:
    """The book that ``--root`` names; imported here, so that ``--help`` is quick."""
    from gearpair.study.book import Book

    return Book.find(context.obj)


@command.command()
@click.argument("file", type=PATH, required=False, metavar="PAIR.yml")
@click.option("--example", is_flag=True, help="Print a file with a comment to each line, and nothing else.")
@click.option("--html", type=PATH, metavar="OUT.html", help="Write a report: one page that needs nothing else.")
@click.option("--csv", type=PATH, metavar="OUT.csv", help="Write the numbers: one row a torque, run and speed.")
@click.option("--xlsx", type=PATH, metavar="OUT.xlsx", help="Write them as a workbook.")
@click.option("--netcdf", type=PATH, metavar="OUT.nc", help="Write them as netCDF, with units.")
@click.option("--quiet", is_flag=True, help="No progress on stderr.")
def drive(file: Path | None, example: bool, quiet: bool, **outputs: Path | None) -> None:
    """Say at which speeds the teeth of a drive part.

    PAIR.yml holds what stands on its drawing and data sheet. Where the gear only idles, the numbers are those of its
    rattle.
    """
    from gearpair.study.drive_run import example_file, run_drive

    if example:
        print(example_file(), end="")
    elif file is None:
        raise click.UsageError("Missing argument 'PAIR.yml', or --example", click.get_current_context())
    else:
        print(run_drive(file, {name: path for name, path in outputs.items() if path}, progress=not quiet))


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
@click.option("-p", "--parameter", "given", nargs=2, multiple=True, metavar="NAME VALUE", help="Repeat for more.")
@click.option("-f", "--file", type=PATH, metavar="FILE.yml", help="Parameters in a YAML file; -p takes precedence.")
@click.option("-o", "--output", type=PATH, metavar="OUT", help="The executed notebook; CHAPTER-run.ipynb, here.")
@click.option("--html", is_flag=True, help="Make one web page of it (CHAPTER-run.html) that needs nothing else.")
@click.option("--quiet", is_flag=True, help="No progress bar.")
@click.option("--source", is_flag=True, hidden=True, help="Leave the notebook as the book's pages are made from.")
@click.pass_context
def run(
    context: click.Context,
    chapter: str,
    given: Sequence[tuple[str, str]],
    file: Path | None,
    output: Path | None,
    html: bool,
    quiet: bool,
    source: bool,
) -> None:
    """Execute one chapter with parameters of your own.

    CHAPTER is a chapter's name, or the path of a notebook.
    """
    from gearpair.study.cache import Cache
    from gearpair.study.estimate import warning
    from gearpair.study.execution import execute
    from gearpair.study.readable import readable

    found = _book(context)
    read = found.chapter(chapter)
    values = read.parse(given, _read_parameters(file) if file else None)
    suffix = ".html" if html else ".ipynb"
    output = output or Path(f"{read.name}-run{suffix}")
    if output.suffix != suffix:
        kind = "a page" if html else "a notebook"
        raise StudyError(f"the output must be {kind} (a name that ends in {suffix}), got {str(output)!r}")
    if not output.absolute().parent.is_dir():
        raise StudyError(f"there is no directory {output.absolute().parent} for the output")
    if output.exists() and output.samefile(read.path):
        raise StudyError(f"the output {str(output)!r} is the chapter's own source; choose another name")
    if told := warning(read, values, Cache(found.target / "cache").seconds(read.name)):
        print(told, file=sys.stderr)
    if html:
        from gearpair.study.book import need_book_extra

        need_book_extra()
        from gearpair.study.page import make_page

        make_page(found, read, output, values, progress=not quiet)
    elif source:
        execute(read, output, values, progress=not quiet)
    else:
        execute(read, output, values, progress=not quiet, last=lambda notebook: readable(notebook, found))
    print(output)


def _read_parameters(file: Path) -> dict[str, Any]:
    try:
        read = yaml.safe_load(file.read_text(encoding="utf-8")) or {}
    except OSError as error:
        raise StudyError(f"{file} cannot be read: {error.strerror or error}") from None
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise StudyError(f"{file} cannot be read as YAML: {str(error).splitlines()[0]}") from None
    if not isinstance(read, dict):
        raise StudyError(f"{file} must hold lines NAME: VALUE")
    return {str(name): value for name, value in read.items()}


@command.command()
@click.option("-o", "--output", type=PATH, metavar="DIR", help="Where to build; _build in the checkout if not given.")
@click.pass_context
def book(context: click.Context, output: Path | None) -> None:
    """Execute what has changed and build the book."""
    from gearpair.study.book import build_book

    print(f"The book is at {build_book(_book(context), output)}")


command.add_command(course)
