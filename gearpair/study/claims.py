"""A place to work in beside what is made: one run at a time, and nothing of it stays."""

import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from gearpair._locks import held
from gearpair.study.errors import StudyError


@contextmanager
def claimed(output: Path) -> Iterator[Path]:
    """A directory beside `output` that belongs to this process alone until the block ends, and is then removed.

    What a run that was killed left there is cleared by the next one for the same output.

    Raises
    ------
    StudyError
        If another process is making the same output, or nothing can be written there.
    """
    scratch = output.parent / f".{output.name}.running"
    with ExitStack() as stack:
        try:
            stack.enter_context(held(scratch / "lock"))
        except BlockingIOError:
            raise StudyError(f"another run is writing {output}; wait for it, or choose another output") from None
        except OSError as error:
            raise StudyError(
                f"cannot write beside {output}: {error.strerror or error}; choose another output"
            ) from None
        try:
            for left in scratch.iterdir():
                if left.name != "lock":
                    shutil.rmtree(left) if left.is_dir() else left.unlink()
            yield scratch
        finally:
            shutil.rmtree(scratch, ignore_errors=True)
