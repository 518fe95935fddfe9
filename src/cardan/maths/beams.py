"""Straight uniform beams under forces and couples along them: how loads bend and stretch at each other's places."""

from __future__ import annotations

from .arrays import Array, namespace


def bending(axis: Array, place: Array, force: Array, couple: Array, end: Array) -> Array:
    """Return the bending flexibilities of a beam of unit stiffness between its loads.

    Parameters
    ----------
    axis : array (..., 3)
        Unit vector along the beam.
    place : array (..., u) [m]
        Where each load acts along it.
    force, couple : arrays (..., u, 3)
        Force and couple of each load for a unit of its amount; what lies along the axis does not bend.
    end : array (...) [m]
        Any place behind all loads.

    Returns
    -------
    array (..., u, u)
        f with the energy ½ x·f x/EI for amounts x in equilibrium.

    Notes
    -----
    The loads before a section x make the moment Σ m_k - (x - x_k) e×t_k there; f is the integral of the products of
    the moments of two loads, from the later of both on. For loads in equilibrium nothing is left behind ``end``.

    Examples
    --------
    A unit force amid a beam on two supports of span 2 bends by l³/48:

    >>> import numpy as np
    >>> along, up = np.eye(3)[0], np.asarray([[0, 0, 1.0]] * 3)
    >>> f = bending(along, np.asarray([0.0, 1.0, 2.0]), up, 0 * up, np.asarray(2.0))
    >>> x = np.asarray([-0.5, 1.0, -0.5])
    >>> round(float(x @ f @ x) * 48, 12)
    8.0
    """
    xp = namespace(axis, place, force, couple)
    e = axis[..., None, :]
    t = force - xp.sum(force * e, axis=-1)[..., None] * e
    m = couple - xp.sum(couple * e, axis=-1)[..., None] * e
    turned = xp.stack(
        (
            e[..., 1] * t[..., 2] - e[..., 2] * t[..., 1],
            e[..., 2] * t[..., 0] - e[..., 0] * t[..., 2],
            e[..., 0] * t[..., 1] - e[..., 1] * t[..., 0],
        ),
        axis=-1,
    )
    first, second = place[..., :, None], place[..., None, :]
    start = xp.maximum(first, second)
    h = end[..., None, None] - start
    apart = xp.abs(first - second)

    def products(one: Array, other: Array) -> Array:
        return xp.matmul(one, xp.matrix_transpose(other))

    forces = products(t, t) * (h**3 / 3.0 + apart * h**2 / 2.0)
    mixed = products(m, turned) * (h**2 / 2.0 + (start - second) * h)
    return forces - mixed - xp.matrix_transpose(mixed) + products(m, m) * h


def stretching(axis: Array, place: Array, force: Array, end: Array, cut: Array | None = None) -> Array:
    """Return the axial flexibilities of a beam of unit stiffness between its loads.

    Parameters
    ----------
    axis : array (..., 3)
        Unit vector along the beam.
    place : array (..., u) [m]
        Where each load acts along it.
    force : array (..., u, 3)
        Force of each load for a unit of its amount.
    end : array (...) [m]
        Any place behind all loads.
    cut : array (...) [m], optional
        Place of a joint that slides freely: no axial force passes it.

    Returns
    -------
    array (..., u, u)
        f with the energy ½ x·f x/EA for amounts x in equilibrium.

    Examples
    --------
    >>> import numpy as np
    >>> pull = np.asarray([[-1.0, 0, 0], [1.0, 0, 0]])
    >>> f = stretching(np.eye(3)[0], np.asarray([0.5, 2.0]), pull, np.asarray(2.0))
    >>> float(np.ones(2) @ f @ np.ones(2))
    1.5
    """
    xp = namespace(axis, place, force)
    along = xp.sum(force * axis[..., None, :], axis=-1)
    start = xp.maximum(place[..., :, None], place[..., None, :])
    last = end[..., None, None]
    if cut is None:
        length = last - start
    else:
        divide = cut[..., None, None]
        before = place < cut[..., None]
        same = before[..., :, None] == before[..., None, :]
        length = xp.where(same, xp.where(before[..., :, None], divide, last) - start, 0.0)
    return along[..., :, None] * along[..., None, :] * length
