"""The exact flow, as numba kernels on plain floats.

`closed_form` is the solution of one linear piece, `cells` its tables over a mesh period,
`event_search` the certified first crossing and `march` the motion over whole periods; `tangent` adds the
variational flow, `observe` what is seen on the way, `exponents` how fast neighbours part, `settle` the motion that
remains and `capture` the neighbourhoods in which it has.
Kernels never raise or print: they return a status.
"""
