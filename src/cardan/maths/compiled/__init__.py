"""The few compiled kernels, one a file, each tested against the plain form in `plain`.

Modules with a kernel import numba, and so does `lanes`; they are imported where a large job runs.
"""
