"""Straight uniform beams under forces and couples along them: how loads bend and stretch at each other's places."""

from __future__ import annotations

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel.frames import cross


def bending(axis: Array, place: Array, force: Array, couple: Array, end: Array, since: Array | None = None) -> Array:
    """Return the bending flexibilities of a beam of unit stiffness between its loads.

    axis (..., 3): unit vector along the beam; place (..., u) [m]: where each load acts along it.
    force, couple (..., u, 3): force and couple of each load for a unit of its amount; what lies along the axis does not
    bend.
    end (...) [m]: any place behind all loads; since (...) [m]: only what lies behind this place bends.
    Returns (..., u, u): f with the energy ½ x·f x/EI for amounts x in equilibrium.
    The loads before a section x make the moment Σ m_k - (x - x_k) e×t_k there; f is the integral of the products of
    the moments of two loads, from the later of both on. For loads in equilibrium nothing is left behind ``end``.
    """
    loads = place, force, couple
    return bending_between(axis, loads, loads, end, since)


def bending_between(
    axis: Array,
    one: tuple[Array, Array, Array],
    other: tuple[Array, Array, Array],
    end: Array,
    since: Array | None = None,
) -> Array:
    """Return the bending flexibilities between two sets of loads, array (..., u, w); see `bending`.

    axis (..., 3): unit vector along the beam.
    one, other (array (..., u) [m], array (..., u, 3), array (..., u, 3)): places, forces and couples of each set.
    end (...) [m]: any place behind all loads; since (...) [m]: only what lies behind this place bends.
    """
    xp = namespace(axis, *one, *other)
    e = axis[..., None, :]

    def parts(force: Array, couple: Array) -> tuple[Array, Array, Array]:
        t = force - xp.sum(force * e, axis=-1)[..., None] * e
        m = couple - xp.sum(couple * e, axis=-1)[..., None] * e
        return t, m, cross(e + 0.0 * t, t)

    t1, m1, turned1 = parts(one[1], one[2])
    t2, m2, turned2 = parts(other[1], other[2])
    first, second = one[0][..., :, None], other[0][..., None, :]
    start = _from(xp.maximum(first, second), since)
    h = xp.maximum(end[..., None, None] - start, 0.0 * start)

    def products(a: Array, b: Array) -> Array:
        return xp.matmul(a, xp.matrix_transpose(b))

    before = start - first, start - second
    forces = products(t1, t2) * (h**3 / 3.0 + (before[0] + before[1]) * h**2 / 2.0 + before[0] * before[1] * h)
    mixed = products(m1, turned2) * (h**2 / 2.0 + before[1] * h)
    mixed = mixed + products(turned1, m2) * (h**2 / 2.0 + before[0] * h)
    return forces - mixed + products(m1, m2) * h


def _from(start: Array, since: Array | None) -> Array:
    """Return where two loads act together, array (..., u, w), no earlier than a place."""
    if since is None:
        return start
    return namespace(start).maximum(start, since[..., None, None] + 0.0 * start)


def stretching(
    axis: Array, place: Array, force: Array, end: Array, cut: Array | None = None, since: Array | None = None
) -> Array:
    """Return the axial flexibilities of a beam of unit stiffness between its loads.

    axis (..., 3): unit vector along the beam; place (..., u) [m]: where each load acts along it.
    force (..., u, 3): force of each load for a unit of its amount; end (...) [m]: any place behind all loads.
    cut (...) [m]: place of a joint that slides freely: no axial force passes it.
    since (...) [m]: only what lies behind this place stretches.
    Returns (..., u, u): f with the energy ½ x·f x/EA for amounts x in equilibrium.
    """
    loads = place, force
    return stretching_between(axis, loads, loads, end, cut, since)


def stretching_between(
    axis: Array,
    one: tuple[Array, Array],
    other: tuple[Array, Array],
    end: Array,
    cut: Array | None = None,
    since: Array | None = None,
) -> Array:
    """Return the axial flexibilities between two sets of loads, array (..., u, w); see `stretching`.

    axis (..., 3): unit vector along the beam.
    one, other (array (..., u) [m], array (..., u, 3)): places and forces of each set.
    end (...) [m]: any place behind all loads; cut (...) [m]: place of a joint that slides freely.
    since (...) [m]: only what lies behind this place stretches.
    """
    xp = namespace(axis, *one, *other)
    along = [xp.sum(force * axis[..., None, :], axis=-1) for _place, force in (one, other)]
    start = _from(xp.maximum(one[0][..., :, None], other[0][..., None, :]), since)
    last = end[..., None, None]
    if cut is None:
        length = xp.maximum(last - start, 0.0 * start)
    else:
        divide = cut[..., None, None]
        before = [place < cut[..., None] for place, _force in (one, other)]
        same = before[0][..., :, None] == before[1][..., None, :]
        length = xp.where(same, xp.where(before[0][..., :, None], divide, last) - start, 0.0)
        length = xp.maximum(length, 0.0 * length)
    return along[0][..., :, None] * along[1][..., None, :] * length
