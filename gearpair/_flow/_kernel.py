"""How every kernel here is compiled, in one place."""

from functools import partial

from numba import njit

# Multiply-adds may be fused; nothing is reordered, and a division by zero gives inf instead of raising.
kernel = partial(njit, cache=True, error_model="numpy", fastmath={"contract"}, nogil=True)
parallel_kernel = partial(kernel, parallel=True)
