"""A file held by one process at a time: the lock is the system's, which drops it even when the process is killed."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def held(lock: Path) -> Iterator[None]:
    """Hold the file `lock`, made in a folder of its own or beside others, until the block ends, which removes it.

    Raises
    ------
    BlockingIOError
        If another process, or another thread of this one, holds it.
    OSError
        Where it cannot be made.
    """
    descriptor = _claim(lock)
    try:
        yield
    finally:
        with suppress(OSError):  # gone with its folder, or a system that removes no open file
            if _is_still(descriptor, lock):
                lock.unlink()
        os.close(descriptor)


def _claim(lock: Path) -> int:
    """The descriptor of the locked file; what another holder removed between opening and locking is made again."""
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
            if _is_still(descriptor, lock):
                return descriptor
        except OSError:
            os.close(descriptor)
            raise
        os.close(descriptor)


def _is_still(descriptor: int, lock: Path) -> bool:
    """Whether `lock` is the file that was opened; once it is, and is locked, only its holder removes it."""
    try:
        return os.path.samestat(os.fstat(descriptor), lock.stat())
    except FileNotFoundError:
        return False
