"""The exact flow, as numba kernels on plain floats.

`closed_form` is the solution of one linear piece, `cells` its tables over a mesh period, `event_search` the certified
first crossing, `segment` a piece of the motion up to it, and `walk` the one loop over whole mesh periods. What a walk
gathers on its way: `tangent` (variational flow), `reach` (range and contacts), `records` (samples, segments, extrema),
`measures` (blows and forces), `growth` (of a neighbourhood).

On top: `newton` and `cycle` for periodic orbits, `observe` for exponents and measures, `capture` for the neighbourhoods
that no motion leaves, `settle` for the motion that remains; `runge_kutta` is the article's method, for comparison.
Kernels never raise or print: they return a status.
"""
