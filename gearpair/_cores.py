"""Work spread over the cores: the kernels release the interpreter's lock, so that threads run in parallel."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any

from numba import config


def on_all_cores(
    kernel: Callable[..., object],
    arguments: tuple[Any, ...],
    n: int,
    block: int,
    done: Callable[[int], object] = lambda items: None,
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

    Notes
    -----
    NUMBA_NUM_THREADS in the environment limits the cores. Ctrl-C lets the blocks under way finish and drops the rest.
    """
    blocks = [(first, min(first + block, n)) for first in range(0, n, block)]
    if len(blocks) <= 1:
        for first, last in blocks:
            kernel(first, last, *arguments)
            done(last - first)
        return
    with ThreadPoolExecutor(min(config.NUMBA_NUM_THREADS, len(blocks))) as pool:
        waiting = {pool.submit(kernel, *ends, *arguments): ends for ends in blocks}
        try:
            while waiting:
                for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                    first, last = waiting.pop(future)
                    future.result()
                    done(last - first)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
