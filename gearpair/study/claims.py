"""A place to work in beside what is made: one run at a time, and nothing of it stays."""

import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from gearpair.study.errors import StudyError

if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def claimed(output: Path) -> Iterator[Path]:
    """A directory beside `output` that belongs to this process alone until the block ends, and is then removed.

    Its lock is the system's, which drops it even when the process is killed: what such a run left is cleared by the
    next one for the same output.

    Raises
    ------
    StudyError
        If another process is making the same output, or nothing can be written there.
    """
    scratch = output.parent / f".{output.name}.running"
    try:
        descriptor = _claim(scratch / "lock")
    except BlockingIOError:
        raise StudyError(f"another run is writing {output}; wait for it, or choose another output") from None
    except OSError as error:
        raise StudyError(f"cannot write beside {output}: {error.strerror or error}; choose another output") from None
    try:
        for left in scratch.iterdir():
            if left.name != "lock":
                shutil.rmtree(left) if left.is_dir() else left.unlink()
        yield scratch
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
        os.close(descriptor)


def _claim(lock: Path) -> int:
    """The descriptor of the locked file; what another run removed between opening and locking is made again."""
    while True:
        try:
            lock.parent.mkdir(exist_ok=True)
            descriptor = os.open(lock, os.O_RDWR | os.O_CREAT, 0o666)
        except FileNotFoundError:
            if not lock.parent.parent.is_dir():
                raise
            continue
        try:
            _lock(descriptor)
            if lock.exists() and os.path.samestat(os.fstat(descriptor), lock.stat()):
                return descriptor
        except OSError:
            os.close(descriptor)
            raise
        os.close(descriptor)
