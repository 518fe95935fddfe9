"""Make the coefficients of `cardan.maths.compiled.approximations`: ``python tests/builders/polynomials.py``.

Interpolation in Chebyshev points of 60-digit values; the leading terms are kept exact, so that small arguments keep
their relative accuracy.
"""

from __future__ import annotations

from collections.abc import Callable

import mpmath as mp


def fitted(function: Callable[[mp.mpf], mp.mpf], end: mp.mpf, count: int) -> tuple[float, ...]:
    """Return ``count`` coefficients, lowest first, of a polynomial near ``function`` on [0, end]."""
    nodes = [end / 2 * (1 + mp.cos(mp.pi * (2 * i + 1) / (2 * count))) for i in range(count)]
    powers = mp.matrix(count, count)
    for i, node in enumerate(nodes):
        for j in range(count):
            powers[i, j] = node**j
    solved = mp.lu_solve(powers, mp.matrix([function(node) for node in nodes]))
    return tuple(float(value) for value in solved)


def coefficients() -> dict[str, tuple[float, ...]]:
    """Return the coefficients by the names they have in the module."""
    with mp.workdps(60):
        arctangent = fitted(lambda z: (mp.atan(mp.sqrt(z)) / mp.sqrt(z) - 1) / z, mp.tan(mp.pi / 8) ** 2, 11)
        sine = fitted(lambda z: (mp.sin(mp.sqrt(z)) / mp.sqrt(z) - 1) / z, (mp.pi / 2) ** 2, 9)
        cosine = fitted(lambda z: (mp.cos(mp.sqrt(z)) - 1 + z / 2) / z**2, (mp.pi / 2) ** 2, 9)
    return {"ARCTANGENT": arctangent, "SINE": sine, "COSINE": cosine}


if __name__ == "__main__":
    for name, values in coefficients().items():
        print(f"{name} = {values}")
