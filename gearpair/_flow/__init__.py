"""The exact flow, as numba kernels on plain floats.

`closed_form` is the solution of one linear piece, `cells` its tables over a mesh period,
`event_search` the certified first crossing, `march` the motion over whole periods.
Kernels never raise or print: they return a status.
"""

from gearpair._flow.cells import Cells, Parameters, build_cells

__all__ = ["Cells", "Parameters", "build_cells"]
