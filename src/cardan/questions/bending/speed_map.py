"""How do the critical speeds of a drive change with the stiffness of a support or the length of a shaft?"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.linear.modes import synchronous
from cardan.maths.linear.rotor_beams import divided
from cardan.texts import _

from .bending import elements, used_speeds
from .whirl_line import WhirlLine, whirl_line

VALUES = 49
"""Values of a map where none are given."""

COARSE = 8
"""Elements along the line for each mode, and one mode more: enough for curves."""

STIFFNESS = (1e4, 1e9)
"""Range of stiffness for a support whose own is not known [N/m]: soft rubber to a rigid housing."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CriticalSpeedMap:
    """Critical speeds over one quantity of the drive.

    Attributes
    ----------
    over : "stiffness" or "length"
        Radial stiffness of a support, or length of a shaft between its joints.
    number : int
        Of that support or shaft.
    value : array (v,) [N/m or m]
        Its values.
    speed : array (v, m) [rad/s]
        Critical speeds as computed, lowest first.
    drawn : float or None [N/m or m]
        Value in the drive; None for a support without a stiffness, which counts as rigid.
    used : (float, float) or None [rad/s]
        Lowest and highest speed of running; None where the drive says none.
    """

    over: Literal["stiffness", "length"]
    number: int
    value: Array
    speed: Array
    drawn: float | None
    used: tuple[float, float] | None


def critical_speed_map(
    drive: Drive,
    value: ArrayLike | None = None,
    *,
    support: int | None = None,
    shaft: int | None = None,
    modes: int = 3,
) -> CriticalSpeedMap:
    """Return the critical speeds of a drive over the stiffness of a support or the length of a shaft, all at once.

    Parameters
    ----------
    drive : Drive
        As for `bending_speeds`.
    value : array (v,) [N/m or m], optional
        Values; a range about that of the drive by default.
    support : int, optional
        Number of the support whose radial stiffness varies; by default the first elastic one, else the first that
        holds a shaft between two joints.
    shaft : int, optional
        Number of the shaft whose length varies; what is on it moves along. By default the longest, where no support
        can vary.
    modes : int
        How many critical speeds.

    Returns
    -------
    CriticalSpeedMap

    Raises
    ------
    InputError
        As `bending_speeds`; or the support or shaft is not part of the line, or values are not positive.

    See Also
    --------
    bending_speeds

    Notes
    -----
    Finite elements, all values in one stack.

    Examples
    --------
    >>> from cardan.io import example
    >>> from cardan.units import rpm
    >>> found = critical_speed_map(example("truck-supports"), [0.9, 1.2, 1.5], shaft=3, modes=1)
    >>> (found.speed / rpm).round(-1).tolist()
    [[16710.0], [10990.0], [7160.0]]
    """
    whole = whirl_line(drive)
    number = _chosen(drive, whole) if support is None and shaft is None else support
    given = None if value is None else np.atleast_1d(np.asarray(value, dtype=float))
    at = "support" if shaft is None and number is not None else "shaft"
    own = shaft or _longest(drive)
    check(_problems(drive, whole, at, number, own, given))
    if at == "support":
        assert number is not None
        return _over_stiffness(drive, whole, number, given, modes)
    return _over_length(drive, whole, own, given, modes)


def _chosen(drive: Drive, whole: WhirlLine) -> int | None:
    """Return the support whose stiffness varies when none is named, None where there is none to vary."""
    radial = [number for number in whole.support_node if drive.supports[number - 1].radial]
    elastic = [number for number in radial if drive.supports[number - 1].stiffness is not None]
    between = [number for number in radial if 1 < drive.supports[number - 1].shaft <= len(drive.joints)]
    return next(iter(sorted(elastic) + sorted(between)), None)


def _longest(drive: Drive) -> int:
    known = known_lengths(drive)
    return max(known, key=lambda number: known[number]) if known else 0


def _problems(
    drive: Drive, whole: WhirlLine, at: str, support: int | None, shaft: int, value: Array | None
) -> list[Problem]:
    found = []
    if at == "support" and (support not in whole.support_node or not drive.supports[support - 1].radial):
        found.append(
            Problem("support", _("support {number} holds no shaft of the line sideways").format(number=support))
        )
    if at == "shaft" and shaft not in known_lengths(drive):
        found.append(Problem("shaft", _("shaft {number} does not lie between two joints").format(number=shaft)))
    if value is not None and not bool(np.all(np.isfinite(value) & (value > 0.0))):
        found.append(Problem("value", _("not every value is finite and more than 0")))
    return found


def _over_stiffness(drive: Drive, whole: WhirlLine, number: int, given: Array | None, modes: int) -> CriticalSpeedMap:
    node, drawn = whole.support_node[number], drive.supports[number - 1].stiffness
    if given is None:
        low, high = STIFFNESS if drawn is None else (drawn / 30.0, 30.0 * drawn)
        given = np.geomspace(low, high, VALUES)
    beside = whole.line.spring[node] - (drawn or 0.0)
    spring = np.tile(whole.line.spring, (len(given), 1))
    spring[:, node] = beside + given
    free = tuple(one for one in whole.line.held if one != node)
    varied = replace(whole, line=replace(whole.line, spring=spring, held=free if drawn is None else whole.line.held))
    speed = _speeds(varied, whole, modes)
    return CriticalSpeedMap(
        over="stiffness", number=number, value=given, speed=speed, drawn=drawn, used=used_speeds(drive.duty)
    )


def _over_length(drive: Drive, whole: WhirlLine, number: int, given: Array | None, modes: int) -> CriticalSpeedMap:
    drawn = known_lengths(drive)[number]
    value = np.linspace(0.5 * drawn, 1.5 * drawn, VALUES) if given is None else given
    factor = np.where(whole.shaft == number, value[:, None] / drawn, 1.0)
    varied = replace(whole, line=replace(whole.line, length=whole.line.length * factor))
    speed = _speeds(varied, whole, modes)
    return CriticalSpeedMap(
        over="length", number=number, value=value, speed=speed, drawn=drawn, used=used_speeds(drive.duty)
    )


def _speeds(varied: WhirlLine, whole: WhirlLine, modes: int) -> Array:
    """Return the critical speeds of a stack of lines, array (v, m) [rad/s]."""
    return synchronous(divided(varied.line, elements(whole, modes, COARSE)), modes).speed
