"""Work spread over the cores, which Ctrl-C ends: the kernels release the interpreter's lock, and run in threads."""

from collections import deque
from collections.abc import Callable, Sequence
from functools import partial
from queue import Empty, SimpleQueue
from threading import Thread, current_thread, main_thread
from typing import Any

from numba import config

# A kernel called by the thread that hears Ctrl-C keeps it waiting. So longer ones, in mesh periods of a quarter of a
# microsecond or more, run in a thread of their own.
SHORT = 200_000
HEARING = 0.1  # seconds: how often a thread that waits looks up, where waiting itself does not hear Ctrl-C


def on_all_cores(
    kernel: Callable[..., object],
    arguments: tuple[Any, ...],
    n: int,
    block: int,
    done: Callable[[int], object] = lambda items: None,
    cores: bool = True,
    *,
    longest: float = 0.0,
) -> None:
    """Call ``kernel(first, last, *arguments)`` for blocks that cover 0 to `n`, as many at once as there are cores.

    Parameters
    ----------
    kernel : callable
        Works on items `first` to `last` (exclusive) independently of the others.
    arguments : tuple
        What else it takes.
    n, block : int
        Number of items, and of items in one call.
    done : callable
        Told how many items were finished, after each block.
    cores : bool
        Otherwise one block after the other.
    longest : float
        Mesh periods that one item may take.

    Notes
    -----
    NUMBA_NUM_THREADS in the environment limits the cores. Ctrl-C raises KeyboardInterrupt at once: blocks not yet begun
    are dropped, and those under way, which nobody waits for, fill arrays that nobody reads.
    """
    blocks = [(first, min(first + block, n)) for first in range(0, n, block)]
    workers = min(config.NUMBA_NUM_THREADS, len(blocks)) if cores else 1
    kept_waiting = longest * min(block, n) > SHORT and current_thread() is main_thread()
    if workers <= 1 and not kept_waiting:
        for first, last in blocks:
            kernel(first, last, *arguments)
            done(last - first)
        return
    calls = [partial(kernel, first, last, *arguments) for first, last in blocks]
    _in_threads(calls, max(workers, 1), lambda i: done(blocks[i][1] - blocks[i][0]))


def aside(kernel: Callable[..., Any], *arguments: Any, periods: float) -> Any:
    """``kernel(*arguments)``, which may take as many mesh periods; Ctrl-C does not wait for its end."""
    if periods <= SHORT or current_thread() is not main_thread():
        return kernel(*arguments)
    result: list[Any] = []
    _in_threads([lambda: result.append(kernel(*arguments))], 1)
    return result[0]


def _in_threads(
    calls: Sequence[Callable[[], object]], workers: int, done: Callable[[int], object] = lambda i: None
) -> None:
    """Make all calls, in threads that do not outlive the program; `done` is told of each, by its place."""
    todo = deque(enumerate(calls))
    ended: SimpleQueue[tuple[int, BaseException | None]] = SimpleQueue()

    def work() -> None:
        while True:
            try:
                i, call = todo.popleft()
            except IndexError:
                return
            try:
                call()
            except BaseException as error:
                ended.put((i, error))
                return
            ended.put((i, None))

    try:
        for _ in range(workers):
            Thread(target=work, daemon=True).start()
        for _ in calls:
            i, error = _heard(ended)
            if error is not None:
                raise error
            done(i)
    finally:
        todo.clear()


def _heard(ended: SimpleQueue[tuple[int, BaseException | None]]) -> tuple[int, BaseException | None]:
    while True:
        try:
            return ended.get(timeout=HEARING)
        except Empty:
            continue
