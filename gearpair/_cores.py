"""Work spread over the cores: the kernels release the interpreter's lock, so that threads run in parallel."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any

from numba import config


def on_all_cores(
    kernel: Callable[..., object],
    arguments: tuple[Any, ...],
    n: int,
    block: int,
    done: Callable[[int], object] = lambda items: None,
    cores: bool = True,
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

    Notes
    -----
    NUMBA_NUM_THREADS in the environment limits the cores. Ctrl-C lets the blocks under way finish and drops the rest.
    """
    blocks = [(first, min(first + block, n)) for first in range(0, n, block)]
    if len(blocks) <= 1 or not cores:
        for first, last in blocks:
            kernel(first, last, *arguments)
            done(last - first)
        return
    with ThreadPoolExecutor(min(config.NUMBA_NUM_THREADS, len(blocks))) as pool:
        items = {pool.submit(kernel, first, last, *arguments): last - first for first, last in blocks}
        try:
            for future in as_completed(items):
                future.result()
                done(items[future])
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
