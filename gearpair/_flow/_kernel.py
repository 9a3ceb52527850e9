"""How every kernel here is compiled, in one place."""

import os
from hashlib import sha256
from pathlib import Path

from numba import njit
from numba.core.caching import IndexDataCacheFile

# Multiply-adds may be fused, unless GEARPAIR_FMA=0 asks for the rounding of a processor that has none; nothing is
# reordered, and a division by zero gives inf instead of raising.
FUSED = os.environ.get("GEARPAIR_FMA", "1") != "0"
OPTIONS = {"error_model": "numpy", "fastmath": {"contract"} if FUSED else set(), "nogil": True}

# numba's disk cache looks only at the file a kernel stands in, but a kernel contains those that it calls. So the
# names of the cached files carry a digest of all sources: after an edit nothing compiled before is found again.
SOURCES = sha256(b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))).hexdigest()[:16]
SOURCES += "" if FUSED else "-unfused"


def kernel(function, **options):
    """Compile `function` at its first call, or load what an earlier process compiled from the same sources."""
    options = OPTIONS | options
    try:
        compiled = njit(function, cache=True, **options)
    except RuntimeError:  # nowhere to write a cache
        return njit(function, **options)
    cache = getattr(compiled, "_cache", None)  # without it, NUMBA_DISABLE_JIT has left a plain function
    if cache is not None:
        name = f"{cache._impl.filename_base}-{SOURCES}"
        cache._cache_file = IndexDataCacheFile(cache._cache_path, name, SOURCES)
    return compiled


def inlined_kernel(function):
    """`kernel`, always inlined: handing over the tables of an oscillator would take longer than the work."""
    return kernel(function, forceinline=True)
