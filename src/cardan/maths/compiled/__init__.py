"""The few compiled kernels, one a file, each tested against the plain form in `plain`.

Only the modules `lanes`, `pairs`, `traces` and `extremes` import numba; they are imported where a large job runs.
"""
