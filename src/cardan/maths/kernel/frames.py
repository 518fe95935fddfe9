"""Directions in space: unit vectors, turns about an axis, bends and plane twists of a polyline.

Vectors are the last axis (3). Everything works in batches.
"""

from __future__ import annotations

from cardan.maths.arrays import Array, abreast, namespace


def dot(a: Array, b: Array) -> Array:
    """Return the scalar product over the last axis."""
    return namespace(a, b).vecdot(a, b)


def cross(a: Array, b: Array) -> Array:
    """Return the vector product over the last axis."""
    xp = namespace(a, b)
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return abreast((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), xp)


def norm(a: Array) -> Array:
    """Return the length of vectors."""
    xp = namespace(a)
    return xp.sqrt(dot(a, a))


def unit(a: Array) -> Array:
    """Return vectors of length one."""
    return a / norm(a)[..., None]


def rotate(vector: Array, axis: Array, angle: Array) -> Array:
    """Turn vectors about a unit axis by the right-hand rule (Rodrigues)."""
    xp = namespace(vector, axis, angle)
    c = xp.cos(angle)[..., None]
    s = xp.sin(angle)[..., None]
    return c * vector + s * cross(axis, vector) + (1.0 - c) * dot(axis, vector)[..., None] * axis


def angle_between(a: Array, b: Array) -> Array:
    """Return the angle between unit vectors in [0, π], accurate near 0 and π."""
    xp = namespace(a, b)
    return xp.atan2(norm(cross(a, b)), dot(a, b))


def angle_about(axis: Array, start: Array, end: Array) -> Array:
    """Return the angle from ``start`` to ``end`` about ``axis`` in (-π, π]; both perpendicular to it."""
    xp = namespace(axis, start, end)
    return xp.atan2(dot(axis, cross(start, end)), dot(start, end))


def perpendicular(a: Array) -> Array:
    """Return some unit vector perpendicular to each vector, horizontal where there is one."""
    xp = namespace(a)
    zero = 0.0 * a[..., 0]
    flat = xp.stack((-a[..., 1], a[..., 0], zero), axis=-1)
    upright = xp.stack((zero, zero + 1.0, zero), axis=-1)
    steep = norm(flat) <= 1e-9 * norm(a)
    return unit(xp.where(steep[..., None], upright, flat))
