"""What `make bench` measures: accuracy against seventy digits, and time beside other integrators, on this machine.

`methods` are the integrators, `accuracy` and `race` fill the table that compares them, `jobs` are diagrams and grids
of starts that run in processes of their own, and `workload` tabulates those.
"""
