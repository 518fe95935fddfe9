"""Is a drive strong enough, and how much torque may it carry at most?"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from cardan.catalogue import Catalogue, catalogue, filled
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.chain import given_chain
from cardan.drive.models.train import train
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.questions.forces.turn_loads import LoadCase, case_loads, load_cases
from cardan.questions.life.bearing_loads import bearing_loads
from cardan.questions.life.life import duty_parts
from cardan.texts import _

from .joint_uses import JointStrength, judged_joints
from .shaft_body import stretches
from .shaft_loads import ShaftLoads, shaft_loads
from .shaft_uses import ShaftStrength, judged_shafts
from .strength_use import Use, governing

WIDEST = 0.254
"""Diameter up to which the size factor of fatigue is measured [m], Shigley chapter 6."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Strength:
    """Strength of a drive.

    Attributes
    ----------
    cases : tuple of LoadCase (c,)
        Ways in which it runs: its duty, the parts of its duty cycle, the peak of its torque history.
    loads : ShaftLoads
        Torques, secondary couples and moments of the shafts in each of them, without the factor for shocks.
    couple : array (c, n) [N·m]
        Largest couple of each cross in each of them, without the factor for shocks.
    shafts : tuple of ShaftStrength (n+1,)
    joints : tuple of JointStrength (n,)
    uses : tuple of Use
        What every part uses of its limits, and what it lacks to be judged.
    torque : float [N·m]
        Largest size of the torque of the duty.
    shock_factor : float
        Factor on stresses and loads.
    dynamic_factor : float
        Largest couple of a cross with masses and friction counted over that without; 1 where it cannot be told. The
        stresses leave it out: the factor for shocks is to hold it.
    extrapolated : tuple of int
        Numbers of shafts that are wider than those whose fatigue was measured.
    """

    cases: tuple[LoadCase, ...]
    loads: ShaftLoads
    couple: Array
    shafts: tuple[ShaftStrength, ...]
    joints: tuple[JointStrength, ...]
    uses: tuple[Use, ...]
    torque: float
    shock_factor: float
    dynamic_factor: float = 1.0
    extrapolated: tuple[int, ...] = ()

    @property
    def judged(self) -> tuple[Use, ...]:
        """Uses of limits for which nothing is missing."""
        return tuple(one for one in self.uses if one.judged)

    @property
    def binding(self) -> tuple[Use, ...]:
        """Those of them that must be kept: no rules of thumb."""
        return tuple(one for one in self.judged if not one.advice)

    @property
    def missing(self) -> tuple[str, ...]:
        """Paths of the drive file without which some parts are not judged, each once."""
        return tuple(dict.fromkeys(path for one in self.uses for path in one.missing))

    @property
    def governing(self) -> Use | None:
        """The use that ends first when all torques grow; None where nothing is judged."""
        return governing(self.uses)

    @property
    def torque_factor(self) -> float:
        """By which factor all torques of the duty may grow until the first part uses all of its limit."""
        first = self.governing
        return math.nan if first is None else first.torque_factor

    @property
    def rated_torque(self) -> float:
        """Torque rating of the whole drive, the largest torque of the duty times this factor [N·m]; nan if none."""
        return self.torque * self.torque_factor

    @property
    def utilisation(self) -> float:
        """Largest share of a limit that is used; nan where nothing is judged."""
        return max((one.utilisation for one in self.binding), default=math.nan)

    @property
    def enough(self) -> bool | None:
        """Whether every part that is judged holds; None where nothing is judged."""
        return self.utilisation <= 1.0 if self.binding else None

    def of(self, part: str) -> tuple[Use, ...]:
        """Return the uses of a part, as ``joints[0]`` or ``shafts[1]``."""
        return tuple(one for one in self.uses if one.part == part)


def strength(drive: Drive, duty: Duty | None = None, *, known: Catalogue | None = None) -> Strength:
    """Return what every shaft and joint of a drive uses of its limits, and the torque rating of the whole drive.

    Parameters
    ----------
    drive : Drive
        With bodies, splines, crosses, yokes and needles as far as they are to be judged.
    duty : Duty, optional
        Torque, blocks or a measured torque; that of the drive by default.
    known : Catalogue, optional
        The shipped one when not given.

    Returns
    -------
    Strength

    Raises
    ------
    InputError
        There is no torque; names that the catalogue does not have.

    Notes
    -----
    The largest loads over the turn of the whole drive, exactly: torque of every shaft, secondary couples at both its
    ends, couple of every cross (`forces.turn_loads`), with the swinging parts of the torque; masses and
    friction are not in them. Shafts: Book (261), von Mises, twist (262), Goodman's line with Marin's factors, where a
    secondary couple turns with its shaft and swings fully; composite tubes against buckling. Splines: core, teeth,
    flanks. Joints: Book (263)-(265), ISO 76, Hertz; life by ISO 281 where the duty asks for one. Stresses grow with the
    torque, contact pressure with its root, life with its power -10/3: so each use tells the torque at which it ends.

    Examples
    --------
    >>> from cardan.drive.material import Material
    >>> from cardan.drive.shaft import Shaft
    >>> tube = Shaft(number=2, outer=0.06, wall=0.003, length=1.0, material=Material(grade="C45"))
    >>> drive = replace(Drive.from_angles([0.2, 0.2]), shafts=(tube,))
    >>> found = strength(drive, Duty(torque=800.0))
    >>> print(found.governing.check, f"{found.utilisation:.3f} {found.rated_torque:.1f}")
    tube_fatigue 0.423 1890.9
    """
    rows = known or catalogue()
    whole = filled(drive if duty is None else replace(drive, duty=duty), rows)
    used = whole.duty
    cases = tuple(load_cases(used))
    if not cases:
        check([Problem("duty.torque", _("missing; how strong a drive must be depends on it"), "missing")])
    loads = [case_loads(whole, case) for case in cases]
    shafts = shaft_loads(loads)
    couple = np.stack([one.couple for one in loads])
    own = np.asarray(given_chain(whole).bend, dtype=float)
    bend = np.stack([own if case.bend is None else np.full(own.shape, case.bend) for case in cases])
    of_shafts, shaft_uses = judged_shafts(whole, used, cases, shafts)
    of_joints, joint_uses = judged_joints(whole, used, rows, cases, shafts.torque, couple, bend)
    return Strength(
        cases=cases,
        loads=shafts,
        couple=couple,
        shafts=of_shafts,
        joints=of_joints,
        uses=(*shaft_uses, *joint_uses),
        torque=max(abs(case.torque) for case in cases),
        shock_factor=used.shock_factor,
        dynamic_factor=_dynamic(whole, used, cases, couple),
        extrapolated=tuple(
            k + 1
            for k, shaft in enumerate(whole.shafts)
            if shaft.layup is None and any(one.outer > WIDEST for one in stretches(whole, k))
        ),
    )


def _dynamic(drive: Drive, duty: Duty, cases: tuple[LoadCase, ...], couple: Array) -> float:
    """Return by which factor masses and friction raise the largest couple of a cross; 1 where it cannot be told."""
    try:
        parts, asked, _history, _cycles = duty_parts(duty)
        real = bearing_loads(drive, train(drive), asked, parts).couple
    except InputError:
        return 1.0
    own = [c for c, case in enumerate(cases) if case.share > 0.0]
    plain = np.max(couple[own or [0]], axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        grown = np.max(real, axis=0) / plain
    return float(max(1.0, np.max(grown[np.isfinite(grown)], initial=1.0)))
