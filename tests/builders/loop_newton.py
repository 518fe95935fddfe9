"""A closed loop of four cylindrical pairs as plain products of 4x4 matrices, solved by Gauss-Newton from a rough start.

No branch formula, no vectors: the matrices are built from elementary turns and shifts, the derivatives are taken by
complex steps, the sixteen elements of (product - unit matrix) are driven to zero.
"""

from __future__ import annotations

import numpy as np


def screw_z(angle, way):
    c, s, one, zero = np.cos(angle), np.sin(angle), 1.0 + 0 * way, 0 * way
    return np.array(
        [[c, -s, zero, zero], [s, c, zero, zero], [zero, zero, one, way], [zero, zero, zero, one]], dtype=complex
    )


def screw_x(angle, way):
    c, s, one, zero = np.cos(angle), np.sin(angle), 1.0 + 0 * way, 0 * way
    return np.array(
        [[one, zero, zero, way], [zero, c, -s, zero], [zero, s, c, zero], [zero, zero, zero, one]], dtype=complex
    )


def gap(alpha, length, angle, slide):
    whole = np.eye(4, dtype=complex)
    for k in range(4):
        whole = whole @ screw_z(angle[k], slide[k]) @ screw_x(alpha[k], length[k])
    return (whole - np.eye(4)).reshape(-1)


def solved(alpha, length, phi1, s1, start, iterations=60):
    """Return φ_2, φ_3, φ_4, s_2, s_3, s_4 that close the loop, and the largest element left."""
    alpha, length = (np.asarray(row, dtype=complex) for row in (alpha, length))
    unknown = np.asarray(start, dtype=float)

    def residual(x):
        return gap(alpha, length, [phi1 + 0j, *x[:3]], [s1 + 0j, *x[3:]])

    for _ in range(iterations):
        now = residual(unknown.astype(complex)).real
        slope = np.stack([residual(unknown + 1e-30j * unit).imag / 1e-30 for unit in np.eye(6)], axis=-1)
        step = np.linalg.lstsq(slope, -now, rcond=None)[0]
        unknown = unknown + step / max(1.0, np.max(np.abs(step[:3])))
    return unknown, float(np.max(np.abs(residual(unknown.astype(complex)).real)))
