"""Mass against utilisation against critical speed: what other diameters and walls of a tube would bring."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.catalogue import Catalogue, catalogue, filled
from cardan.checks import Verdict, check, design
from cardan.drive.body import body_material
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.parts import known_lengths
from cardan.drive.material import Material
from cardan.errors import InputError, Problem, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.pareto import front
from cardan.texts import _

STRENGTH = ("tube_strength", "tube_fatigue", "shaft_life", "tube_buckling", "twist")
"""Checks that make up the utilisation."""

OUTER, WALL = (0.5, 1.8, 53), (0.3, 3.0, 7)
"""Diameters and walls looked at, over those of the drive: from, to, how many."""

SLOW = 100.0
"""Input speed for which critical speeds are told where the duty has none [rad/s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TradeOff:
    """Tubes of other sizes for one shaft; arrays (o, w) over outer diameter and wall, nan where they are no tube.

    Attributes
    ----------
    shaft : int
        Number of the shaft.
    outer, wall : arrays (o,), (w,) [m]
        Wall of a tube of composite: all its plies.
    mass : array (o, w) [kg]
        Of the tube between its ends.
    utilisation : array (o, w)
        Largest of strength, fatigue, buckling and twist.
    critical : array (o, w) [rad/s]
        Real critical speed in bending.
    passes : array of bool (o, w)
        Whether all checks of the tube pass, its critical speed included where the duty has a speed.
    best : array of bool (o, w)
        Whether no other tube that passes is lighter, less used and faster at once.
    now : tuple of float
        Outer diameter, wall, mass, utilisation and critical speed of the drive as it is.
    speed : float or None [rad/s]
        Highest speed of the duty.
    needed : float [rad/s]
        Critical speed that the limits ask for or practice advises; nan without a speed.
    """

    shaft: int
    outer: Array
    wall: Array
    mass: Array
    utilisation: Array
    critical: Array
    passes: Array
    best: Array
    now: tuple[float, float, float, float, float]
    speed: float | None
    needed: float

    @property
    def lightest(self) -> tuple[float, float, float] | None:
        """Outer diameter, wall and mass of the lightest tube that passes; None where none does."""
        mass = np.where(self.passes, self.mass, np.inf)
        if not np.any(np.isfinite(mass)):
            return None
        i, j = np.unravel_index(int(np.argmin(mass)), mass.shape)
        return float(self.outer[i]), float(self.wall[j]), float(mass[i, j])


def trade_off(
    drive: Drive,
    duty: Duty | None,
    shaft: int,
    *,
    outer: ArrayLike | None = None,
    wall: ArrayLike | None = None,
    known: Catalogue | None = None,
    progress: Callable[[float], object] | None = None,
) -> TradeOff:
    """Return what tubes of other sizes would weigh, how much of their limits they would use, and when they would whirl.

    Parameters
    ----------
    drive : Drive
    duty : Duty or None
        The drive's own when None.
    shaft : int
        Its number; a shaft between two joints with an outer diameter.
    outer, wall : arrays (o,), (w,) [m], optional
        From half to 1.8 times the diameter of the drive, from 0.3 to 3 times its wall by default.
    known : Catalogue, optional
        The shipped one when not given.
    progress : function, optional
        Called with the share done; answering "stop" leaves the rest nan.

    Returns
    -------
    TradeOff

    Raises
    ------
    InputError
        The shaft has no outer diameter, no length, or what the checks need is missing.

    See Also
    --------
    size

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive
    >>> from cardan.parts import Duty, Material, Shaft
    >>> from cardan.sweeps import trade_off
    >>> tube = Shaft(number=2, outer=0.09, wall=0.003, length=1.0, material=Material(grade="C45"))
    >>> drive = replace(Drive.from_angles([0.2, 0.2]), shafts=(tube,))
    >>> found = trade_off(drive, Duty(torque=800.0, speed=300.0), 2)
    >>> print(*(f"{1e3 * size:.1f}" for size in found.lightest[:2]), f"{found.lightest[2]:.3f} kg")
    68.4 0.9 1.498 kg
    """
    rows = known or catalogue()
    whole = filled(drive if duty is None else replace(drive, duty=duty), rows)
    k, path = shaft - 1, f"shafts[{shaft - 1}]"
    length = known_lengths(whole).get(shaft)
    if not 0 < k < len(whole.joints):
        raise refuse("shaft", _("{number} is not a shaft between two joints").format(number=shaft), "out_of_range")
    own = whole.shafts[k]
    if own.outer is None or length is None:
        field = "outer" if own.outer is None else "length"
        raise refuse(f"{path}.{field}", _("missing; other tubes are compared with it"), "missing")
    if own.profile is not None:
        raise refuse(
            f"{path}.profile", _("profile tubes come in the sizes of their maker; round tubes alone are sized")
        )
    plies = 1 if own.layup is None else len(own.layup.angles)
    present = _wall(whole, k)
    start = replace(own, wall=None if own.layup is not None else present, inner=None)
    moving = design(whole, known=rows).top_speed is not None
    if not moving:
        whole = replace(whole, duty=replace(whole.duty, speed=SLOW))
    base = replace(whole, shafts=(*whole.shafts[:k], start, *whole.shafts[k + 1 :]))
    outers = _spread(own.outer, OUTER) if outer is None else np.asarray(outer, dtype=float)
    walls = _spread(present, WALL) if wall is None else np.asarray(wall, dtype=float)
    made = body_material(own) if own.layup is not None else own.material or Material()
    wide, thick = np.meshgrid(outers, walls, indexing="ij")
    tube = (2.0 * thick <= wide) & (thick > 0.0)
    thin = f"{path}.layup.ply_thickness_mm" if own.layup is not None else f"{path}.wall_mm"

    def judged(d: Array, t: Array) -> tuple[Array, Array, Array]:
        vary = {f"{path}.outer_mm": 1e3 * d, thin: 1e3 * t / plies}
        with np.errstate(all="ignore"):
            verdicts = [
                one
                for one in check(base, only=(*STRENGTH, "critical_speed"), vary=vary, known=rows)
                if one.subject in ("", path)
            ]
        _complete(verdicts)
        told = [one for one in verdicts if one.run]
        run = [one for one in told if not one.advice]
        used = np.max(
            [np.broadcast_to(np.asarray(one.utilisation, float), d.shape) for one in run if one.check in STRENGTH], 0
        )
        fast = [one for one in told if one.check == "critical_speed" and one.sense == "at_least"]
        ratio = np.broadcast_to(np.asarray(fast[0].value, float), d.shape) if fast else np.full(d.shape, np.nan)
        fine = np.all([np.broadcast_to(np.asarray(one.passed), d.shape) for one in run], 0)
        return used, ratio, fine if moving else used <= 1.0

    used, ratio = np.full(wide.shape, np.nan), np.full(wide.shape, np.nan)
    fine = np.zeros(wide.shape, dtype=bool)
    for j in range(walls.size):
        on = tube[:, j]
        if np.any(on):
            used[on, j], ratio[on, j], fine[on, j] = judged(wide[on, j], thick[on, j])
        if progress is not None and progress((j + 1) / walls.size) == "stop":
            break
    speed, least = _speed(base, rows, path)
    inner = wide - 2.0 * thick
    mass = np.where(tube, 0.25 * math.pi * (wide**2 - inner**2) * length * made.density, np.nan)
    own_used, own_ratio, _fine = judged(np.asarray([own.outer]), np.asarray([present]))
    own_mass = 0.25 * math.pi * (own.outer**2 - (own.outer - 2.0 * present) ** 2) * length * made.density
    critical = ratio * speed
    return TradeOff(
        shaft=shaft,
        outer=outers,
        wall=walls,
        mass=mass,
        utilisation=used,
        critical=critical,
        passes=fine,
        best=_front(mass, used, -critical, fine),
        now=(own.outer, present, own_mass, float(own_used[0]), float(own_ratio[0]) * speed),
        speed=speed if moving else None,
        needed=least * speed if moving else math.nan,
    )


def _front(mass: Array, used: Array, slow: Array, among: Array) -> Array:
    """Return which designs (o, w), of those that count, no other one beats: each size is better when smaller."""
    found = np.zeros(among.shape, dtype=bool)
    sizes = np.stack([np.nan_to_num(one, nan=np.inf) for one in (mass, used, slow)], axis=-1)
    found[among] = front(sizes[among])
    return found


def _wall(drive: Drive, k: int) -> float:
    """Return the wall of a shaft [m]: half its diameter where it is solid."""
    shaft = drive.shafts[k]
    outer = shaft.outer or 0.0
    if shaft.layup is not None:
        return len(shaft.layup.angles) * shaft.layup.ply_thickness
    return shaft.wall or (0.5 * (outer - shaft.inner) if shaft.inner else 0.5 * outer)


def _spread(now: float, over: tuple[float, float, int]) -> Array:
    return now * np.geomspace(*over)


def _complete(verdicts: Sequence[Verdict]) -> None:
    """Refuse where nothing of the strength of a tube can be judged."""
    if any(one.run for one in verdicts if one.check in STRENGTH):
        return
    fields = dict.fromkeys(path for one in verdicts for path in one.missing) or ["duty.torque"]
    raise InputError(Problem(path, _("missing; strength depends on it"), "missing") for path in fields)


def _speed(drive: Drive, rows: Catalogue, path: str) -> tuple[float, float]:
    """Return the highest speed [rad/s], and the ratio that the critical speed must keep to it."""
    top = design(drive, known=rows).top_speed
    least = [
        float(np.max(one.limit))
        for one in check(drive, only=("critical_speed",), known=rows)
        if one.subject == path and one.run and one.sense == "at_least"
    ]
    return float(np.max(top)) if top is not None else SLOW, least[0] if least else math.nan
