"""Choice of the offset of ball grooves: how far off the joint their centres must stand for an axial play."""

from __future__ import annotations

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


def groove_offset(joint_angle: ArrayLike, tilt: ArrayLike, play: ArrayLike) -> Array:
    """Return the smallest offset of both groove centres with which the plane of the balls tilts no more than allowed.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Largest α in [0, π/2).
    tilt : array (...) [rad]
        Largest η allowed, in size, above 0.
    play : array (...) [m]
        How far one shaft may shift along its axis from the middle, to either side.

    Returns
    -------
    array (...) [m]
        c of both centres, the shafts in the middle.

    Notes
    -----
    One centre comes as near as c - s: tan η = s tan(α/2)/(2c - s), so c = (s/2) [1 + tan(α/2)/tan η]. The tilt is the
    larger the smaller c: the reason why a Weiss joint has a ball that centres it.

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> print(groove_offset(40 * deg, 0.5 * deg, 0.1 * mm) / mm)
    2.13534289
    """
    alpha, eta, shift = floats(joint_angle, tilt, play)
    xp = namespace(alpha, eta, shift)
    return 0.5 * shift * (1.0 + xp.tan(0.5 * alpha) / xp.tan(eta))
