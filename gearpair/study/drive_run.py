"""The command ``gearpair drive``: a file in, a verdict out, and what was asked for beside it, whole or not at all."""

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

from gearpair.drive_file import example
from gearpair.study.claims import claimed
from gearpair.study.drive_answer import Answer, answer
from gearpair.study.drive_numbers import WRITERS
from gearpair.study.errors import StudyError

Writer = Callable[[Answer, Path], None]


def example_file() -> str:
    """A drive's file with a comment to each line."""
    return example()


def run_drive(file: Path, outputs: Mapping[str, Path], *, progress: bool) -> str:
    """Compute what a drive's file asks for, write the outputs, and return what there is to say.

    Parameters
    ----------
    file : Path
    outputs : mapping of str to Path
        By ``"html"``, ``"csv"``, ``"xlsx"`` and ``"netcdf"``; looked at before anything is computed, and written when
        all of them are there.
    progress : bool
        Show on stderr how far it is.

    Raises
    ------
    StudyError
        In one sentence.
    """
    writers = {"html": (".html", _write_page), **WRITERS}
    for kind, path in outputs.items():
        _check_output(file, path, writers[kind][0])
    if len({path.absolute() for path in outputs.values()}) < len(outputs):
        raise StudyError("two outputs have one name")
    with ExitStack() as stack:
        partial = {kind: stack.enter_context(claimed(path)) / path.name for kind, path in outputs.items()}
        found = answer(file, progress=progress)
        for kind, path in partial.items():
            _write(writers[kind][1], found, path)
        for kind, path in partial.items():
            os.replace(path, outputs[kind])
    return "\n\n".join([str(found), *([f"written: {', '.join(map(str, outputs.values()))}"] if outputs else [])])


def _check_output(file: Path, output: Path, suffix: str) -> None:
    if output.suffix != suffix:
        raise StudyError(f"the output must have a name that ends in {suffix}, got {str(output)!r}")
    if not output.absolute().parent.is_dir():
        raise StudyError(f"there is no directory {output.absolute().parent} for the output")
    if output.is_dir():
        raise StudyError(f"the output {output} is a directory")
    if output.exists() and file.exists() and output.samefile(file):
        raise StudyError(f"the output {output} is the drive's own file; choose another name")


def _write(writer: Writer, found: Answer, path: Path) -> None:
    try:
        writer(found, path)
    except OSError as error:
        raise StudyError(f"{path.name} cannot be written: {error.strerror or error}") from None


def _write_page(found: Answer, path: Path) -> None:
    with _without_windows():
        from gearpair.study.drive_page import page

        path.write_text(page(found), encoding="utf-8")


@contextmanager
def _without_windows() -> Iterator[None]:
    """No window for a figure that goes into a file; what is run afterwards chooses for itself."""
    if "MPLBACKEND" in os.environ:
        yield
        return
    os.environ["MPLBACKEND"] = "agg"
    try:
        yield
    finally:
        del os.environ["MPLBACKEND"]
