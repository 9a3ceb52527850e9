"""The variational flow along a walk: the matrix of its linear pieces, multiplied up.

The stiffness switches at fixed times, and the spring's force is continuous at X = +-1. So with one damping ratio the
variational flow has no jump: its matrix is the product of the linear pieces' own.

With another in free flight X'' jumps at a crossing, by 2 (zeta - zeta') X' from zeta to zeta'. The quotient by X' is
what the tangent jumps by (`cross`), bounded at a grazing: X' + 2 zeta X has no jump. The determinant of that is 1, so
that of the whole is exp(-2 zeta (time in contact) - 2 zeta_f (time in flight)), and exp(-2 zeta n T) with one damping.

Where no matrix is asked for it is None, and these kernels do nothing.
"""

from ._kernel import Array, inlined_kernel, kernel
from .cells import VV, VX, WIDTH, XV, XX, Cells
from .closed_form import evaluate
from .segment import Segment


@kernel
def set_identity(m: Array) -> None:
    """Make the 2 x 2 matrix `m` the identity."""
    m[0, 0], m[0, 1], m[1, 0], m[1, 1] = 1.0, 0.0, 0.0, 1.0


@kernel
def apply(xx: float, xv: float, vx: float, vv: float, m: Array) -> None:
    """Multiply the 2 x 2 matrix `m` from the left, in place."""
    for k in range(2):
        m[0, k], m[1, k] = xx * m[0, k] + xv * m[1, k], vx * m[0, k] + vv * m[1, k]


@inlined_kernel
def apply_map(m: Array | None, row: Array) -> None:
    """Multiply `m` by the linear part of the affine map in `row`."""
    if m is None:
        return
    apply(row[XX], row[XV], row[VX], row[VV], m)


@inlined_kernel
def apply_segment(m: Array | None, cells: Cells, segment: Segment) -> None:
    """Multiply `m` by the variational matrix of a segment."""
    if m is None:
        return
    basis = cells.bases[cells.level[segment.cell], abs(segment.region)]
    width = cells.clock[segment.cell, WIDTH]
    xx, vx, _ = evaluate(basis[0], segment.duration)
    xv, vv, _ = evaluate(basis[1], segment.duration)
    apply(xx, xv, vx / width, vv / width, m)
    cross(m, cells, segment)


@inlined_kernel
def cross(m: Array, cells: Cells, segment: Segment) -> None:
    """Multiply `m` by the jump (saltation) matrix of the crossing that a segment ends with, if it does."""
    if segment.left and cells.flight_damping != cells.damping_ratio:
        loss = 2.0 * (cells.flight_damping - cells.damping_ratio)
        apply(1.0, 0.0, loss if segment.region == 0 else -loss, 1.0, m)
