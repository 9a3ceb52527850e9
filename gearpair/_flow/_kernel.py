"""How every kernel here is compiled, in one place; the only one that knows how numba names its cached files."""

import os
import warnings
from collections.abc import Callable
from concurrent.futures import Future
from functools import cache
from hashlib import sha256
from pathlib import Path
from threading import Thread, current_thread, main_thread
from typing import Any, TypeVar

import numpy as np
from numba import njit
from numba.core.options import DefaultOptions
from numpy.typing import NDArray

Function = TypeVar("Function", bound=Callable[..., Any])
Array = NDArray[np.float64]
Integers = NDArray[np.int64]

# Multiply-adds may be fused, unless GEARPAIR_FMA=0 asks for the rounding of a processor that has none; nothing is
# reordered, and a division by zero gives inf instead of raising.
FUSED = os.environ.get("GEARPAIR_FMA", "1") != "0"
OPTIONS = {"error_model": "numpy", "fastmath": {"contract"} if FUSED else set(), "nogil": True}

# What a kernel is handed stays alive as long as its caller, so it need not count the references to it: handing over
# an oscillator, two dozen arrays, would take longer than a segment of its motion.
COUNTED, UNCOUNTED = ({"_nrt": True}, {"_nrt": False}) if hasattr(DefaultOptions, "_nrt") else ({}, {})

# numba's disk cache looks only at the file a kernel stands in, but a kernel contains those that it calls. So the
# names of the cached files carry a digest of all sources: after an edit nothing compiled before is found again.
SOURCES = sha256(b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))).hexdigest()[:16]
SOURCES += "" if FUSED else "-unfused"


def kernel(function: Function) -> Function:
    """Compile a function of numbers and arrays that returns numbers alone."""
    return compiled_once(function, UNCOUNTED)


def allocating_kernel(function: Function) -> Function:
    """`kernel` for a function that makes arrays, returns some, or calls one that returns some."""
    return compiled_once(function, COUNTED)


def inlined_kernel(function: Function) -> Function:
    """`kernel`, always inlined, for what runs once an event."""
    return compiled_once(function, UNCOUNTED | {"forceinline": True})


def compiled_once(function: Function, options: dict[str, Any]) -> Function:
    """Compile `function` at its first call, or load what an earlier process compiled from the same sources."""
    compiled = _to_be_compiled(function, OPTIONS | options)
    if compiled is not function:
        _make_ready_aside(compiled)
    return compiled


def _to_be_compiled(function: Function, options: dict[str, Any]) -> Function:
    """What compiles `function` when it is called, with a cache where there can be one."""
    try:
        compiled = njit(function, cache=True, **options)
    except RuntimeError:  # nowhere to write a cache
        return njit(function, **options)
    if compiled is function:  # NUMBA_DISABLE_JIT
        return function
    try:
        _name_cache_after_sources(compiled)
    except (AttributeError, ImportError, TypeError):
        _say_uncached()
        return njit(function, **options)
    return compiled


def _name_cache_after_sources(compiled: Any) -> None:
    """Put `SOURCES` into the names of the files that `compiled` is cached in: private parts of numba."""
    from numba.core.caching import IndexDataCacheFile

    cached = compiled._cache
    if type(cached._cache_file) is not IndexDataCacheFile:
        raise TypeError("numba keeps its cache in another way")
    name = f"{cached._impl.filename_base}-{SOURCES}"
    cached._cache_file = IndexDataCacheFile(cached._cache_path, name, SOURCES)


def _make_ready_aside(compiled: Any) -> None:
    """Load or compile in a thread of its own, which Ctrl-C does not end: numba left half-way would fail ever after.

    `gearpair._cores.aside` does the like for calls; this room imports nothing of the others.
    """
    make_ready = getattr(compiled, "_compile_for_args", None)  # a private part of numba
    if make_ready is None:
        return

    def made_ready(*arguments: Any, **named: Any) -> Any:
        if current_thread() is not main_thread():
            return make_ready(*arguments, **named)
        made: Future[Any] = Future()

        def make() -> None:
            try:
                made.set_result(make_ready(*arguments, **named))
            except BaseException as error:
                made.set_exception(error)

        Thread(target=make, daemon=True).start()
        return made.result()

    compiled._compile_for_args = made_ready


@cache
def _say_uncached() -> None:
    """Once in a process: a kernel that cannot be told from a stale one is compiled anew."""
    warnings.warn(
        "this numba keeps compiled code in another way than gearpair knows: the kernels work, but every process "
        "compiles them again (a minute); requirements.lock has a numba that avoids it",
        RuntimeWarning,
        stacklevel=2,
    )
