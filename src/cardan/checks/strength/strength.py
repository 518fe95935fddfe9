"""Is a drive strong enough, and how much torque may it carry at most? The verdicts of the checks on its parts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.quantity import Text
from cardan.catalogue import Catalogue
from cardan.checks.check import Check, surpassed
from cardan.checks.design import Design, design
from cardan.checks.load_case import Case
from cardan.checks.moving import happening, stood, stops, worst_of_poses
from cardan.checks.verdict import Verdict
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.dynamics_model import train
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError, Problem, check
from cardan.maths.ties import foremost_of
from cardan.questions.forces.forces import forces
from cardan.questions.life.bearing_loads import bearing_loads
from cardan.questions.life.life import duty_parts
from cardan.questions.torsion.model.excitation import forced_run_up
from cardan.texts import _

from . import (
    ply_strength,
    shaft_life,
    spline_pressure,
    spline_strength,
    tube_buckling,
    tube_fatigue,
    tube_strength,
    twist,
)
from .event_damage import EventDamage
from .joints import (
    bearing_life,
    contact_pressure,
    inner_pressure,
    joint_torque,
    journal_strength,
    needle_static,
    rated_torque,
    yoke_strength,
)
from .omitted import Journal, LeftOut, Vibration, vibration
from .part_strength import JointStrength, ShaftStrength, joint_strength, shaft_strength
from .rating import lasting_as_long, rated, scaled
from .section import sections

STRENGTH = tuple(
    module.CHECK
    for module in (
        tube_strength,
        tube_buckling,
        ply_strength,
        tube_fatigue,
        shaft_life,
        spline_strength,
        spline_pressure,
        twist,
        joint_torque,
        rated_torque,
        journal_strength,
        yoke_strength,
        needle_static,
        contact_pressure,
        inner_pressure,
        bearing_life,
    )
)
"""Checks of the parts that the torque can break, in the order in which they are told."""

WIDEST = 0.254
"""Diameter up to which the size factor of fatigue is measured [m], Shigley chapter 6."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Strength:
    """Strength of a drive.

    Attributes
    ----------
    cases : tuple of Case (c,)
        Ways in which it runs under torque, with the largest loads of shafts and crosses over a turn, without the factor
        for shocks: its duty, the parts of its duty cycle, the peak of its torque history.
    shafts : tuple of ShaftStrength (n+1,)
    joints : tuple of JointStrength (n,)
    verdicts : tuple of Verdict
        What every part uses of its limits, and what it lacks to be judged: shafts, then all of them together, joints.
    torque : float [N·m]
        Largest size of the torque of the duty.
    shock_factor : float
        Factor on stresses and loads.
    dynamic_factor : float
        Largest couple of a cross with masses and friction counted over that without; 1 where it cannot be told. The
        stresses leave it out: the factor for shocks is to hold it.
    vibration : Vibration or None
        What torsional vibration makes of the torque, which is counted; None where the file does not let it be told.
    vibrates : bool
        Whether the file says anything of masses and stiffness.
    extrapolated : tuple of int
        Numbers of shafts that are wider than those whose fatigue was measured.
    left_out : LeftOut or None
        What the stresses leave out, where that was asked.
    case : str
        Load case that has this torque; empty where there is one only.
    events, ramps : tuple of EventDamage
        What starts and events cost, and a start with run-ups of other times, where that was asked.
    lost : tuple of (str, str)
        Events that cannot be followed, each with why.
    surpassed : str
        Why the drive may have larger torques than steady vibration counts, so that nothing passes and nothing is rated.
    """

    cases: tuple[Case, ...]
    shafts: tuple[ShaftStrength, ...]
    joints: tuple[JointStrength, ...]
    verdicts: tuple[Verdict, ...]
    torque: float
    shock_factor: float
    dynamic_factor: float = 1.0
    vibration: Vibration | None = None
    vibrates: bool = False
    extrapolated: tuple[int, ...] = ()
    left_out: LeftOut | None = None
    case: str = ""
    events: tuple[EventDamage, ...] = ()
    ramps: tuple[EventDamage, ...] = ()
    lost: tuple[tuple[str, str], ...] = ()
    surpassed: str = ""

    @property
    def judged(self) -> tuple[Verdict, ...]:
        """Verdicts for which nothing is missing."""
        return tuple(one for one in self.verdicts if one.run)

    @property
    def binding(self) -> tuple[Verdict, ...]:
        """Those of them that must be kept: no rules of thumb."""
        return tuple(one for one in self.judged if not one.advice)

    @property
    def missing(self) -> tuple[str, ...]:
        """Paths of the drive file without which some parts are not judged, each once."""
        return tuple(dict.fromkeys(path for one in self.verdicts for path in one.missing))

    @property
    def governing(self) -> Verdict | None:
        """The limit that is reached first when all torques grow; None where nothing is judged."""
        return foremost_of(self.binding, reached, least=True) if self.binding else None

    @property
    def torque_factor(self) -> float:
        """By which factor all torques of the duty may grow until the first part uses all of its limit; nan if none."""
        first = self.governing
        return math.nan if first is None or self.surpassed else float(first.torque_factor)

    @property
    def rated_torque(self) -> float:
        """Torque rating of the whole drive, the largest torque of the duty times this factor [N·m]; nan if none."""
        return self.torque * self.torque_factor

    @property
    def utilisation(self) -> float:
        """Largest share of a limit that is used; nan where nothing is judged."""
        return max((float(one.utilisation) for one in self.binding), default=math.nan)

    @property
    def enough(self) -> bool | None:
        """Whether every part that is judged is strong enough; None where nothing is judged."""
        return self.utilisation <= 1.0 if self.binding else None

    def of(self, subject: str) -> tuple[Verdict, ...]:
        """Return the verdicts on a part, as ``joints[0]`` or ``shafts[1]``."""
        return tuple(one for one in self.verdicts if one.subject == subject)


def reached(one: Verdict) -> float:
    """Return what orders verdicts by the torques at which they are reached, the most used first of those at none.

    >>> reached(Verdict(value=1.0, limit=2.0, power=1.0))
    2.0
    """
    return float(one.torque_factor) or -float(one.utilisation)


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

    See Also
    --------
    check, size

    Notes
    -----
    The largest loads over the turn of the whole drive, exactly: torque of every shaft, secondary couples at both its
    ends, couple of every cross (`forces.turn_loads`), with the swinging parts of the torque, and with torsional
    vibration at the speeds in use where the file tells masses and stiffness; friction is not in them. Shafts: Book
    (261), von Mises, twist (262), Goodman's line with Marin's factors, where a secondary couple turns with its shaft
    and swings fully; composite tubes against buckling. Splines: core, teeth, flanks. Joints: Book (263)-(265), ISO 76,
    Hertz; life by ISO 281 where the duty asks for one. Stresses grow with the torque, contact pressure with its root,
    life with its power -10/3: so each use tells the torque at which it ends. Where torsional vibration adds to the
    torque, which joints make whatever a drive carries, that torque is sought (`rating.rated`).

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, strength
    >>> from cardan.parts import Duty, Material, Shaft
    >>> tube = Shaft(number=2, outer=0.06, wall=0.003, length=1.0, material=Material(grade="C45"))
    >>> drive = replace(Drive.from_angles([0.2, 0.2]), shafts=(tube,))
    >>> found = strength(drive, Duty(torque=800.0))
    >>> print(found.governing.check, f"{found.utilisation:.3f} {found.rated_torque:.1f}")
    tube_fatigue 0.423 1890.9
    """
    subject = design(drive, duty, known=known)
    if not subject.loaded:
        check([Problem("duty.torque", _("missing; how strong a drive must be depends on it"), "missing")])
    parts = range(subject.joints + 1)
    return Strength(
        cases=subject.loaded,
        shafts=tuple(shaft_strength(subject, k) for k in parts),
        joints=tuple(joint_strength(subject, i) for i in parts[:-1]),
        verdicts=_rated(subject),
        torque=max(abs(float(case.torque or 0.0)) for case in subject.loaded),
        shock_factor=float(subject.shock),
        dynamic_factor=_dynamic(subject),
        case=subject.called(max(subject.loaded, key=lambda case: abs(float(case.torque or 0.0)))),
        vibration=vibration(subject),
        vibrates=has_torsion(subject.drive),
        surpassed=surpassed(subject),
        extrapolated=tuple(
            k + 1
            for k in parts
            if subject.drive.shafts[k].layup is None and any(one.outer > WIDEST for one in sections(subject, k))
        ),
    )


@dataclass(frozen=True, eq=False)
class _Stance:
    """A design as drawn, in a pose or at an instant of its movements, and the checks that judge it there."""

    said: Text
    subject: Design
    checks: Sequence[Check]

    def verdicts(self) -> list[Verdict]:
        """Return its verdicts."""
        return _judged(self.checks, self.subject)

    def at(self, factor: float) -> _Stance:
        """Return it with all torques times a factor."""
        duty = scaled(self.subject.duty, factor)
        return replace(self, subject=replace(self.subject, drive=replace(self.subject.drive, duty=duty), duty=duty))

    @property
    def vibrates(self) -> list[bool]:
        """Whether the torsional vibration of each way to run is known."""
        return [case.vibration is not None for case in self.subject.loaded]


def _judged(checks: Sequence[Check], subject: Design) -> list[Verdict]:
    return [one for check in checks for one in check.verdicts(subject)]


def _stances(subject: Design) -> Iterator[_Stance]:
    """Yield the design as drawn, in its poses, in events, and at the instants of its movements that load it most."""
    worst = [check for check in STRENGTH if check.gathers == "worst"]
    loads = [check for check in worst if check.instants]
    yield _Stance("", subject, STRENGTH)
    yield from (_Stance(said, stand, worst) for said, stand in stood(subject))
    sudden = [check for check in worst if check.events]
    yield from (_Stance(said, stand, sudden) for said, stand in happening(subject))
    yield from (_Stance(said, stand, loads) for said, stand in stops(subject, lambda at: _judged(loads, at)))


def _rated(subject: Design) -> tuple[Verdict, ...]:
    """Return the verdicts with the torques at which their limits are reached.

    In proportion where machines of their own, and not the torques of the duty, make a drive vibrate.
    """
    stances, duty = list(_stances(subject)), subject.duty
    every = lasting_as_long(subject.drive, duty, _verdicts(stances))
    if not has_torsion(subject.drive) or duty.engine or duty.motor or duty.load or duty.torques or surpassed(subject):
        return every

    def at(factor: float) -> tuple[Verdict, ...]:
        other = [one.at(factor) for one in stances]
        known = all(one.vibrates == before.vibrates for one, before in zip(other, stances, strict=True))
        return _verdicts(other) if known else ()

    resting = [replace(one, subject=replace(one.subject, vibrates=False)) for one in stances]
    return rated(every, _verdicts(resting), at)


def _verdicts(stances: Sequence[_Stance]) -> tuple[Verdict, ...]:
    """Return the verdicts on shafts, on all of them together, on joints."""
    each = worst_of_poses(stances[0].verdicts(), [(one.said, one.verdicts()) for one in stances[1:]])
    every = [one for one in each if _asked(one)]
    limits = {(one.check, one.subject) for one in every if not one.advice}
    kept = (one for one in every if not (one.advice and (one.check, one.subject) in limits))  # no rule beside a limit
    order = {"shafts": 0, "": 1, "joints": 2}
    return tuple(sorted(kept, key=lambda one: (order[one.subject.partition("[")[0]], one.number)))


def _asked(one: Verdict) -> bool:
    """Tell whether a verdict is about what the drive has and is to do: no life that nobody asks for."""
    rated = one.check != "rated_torque" or not any(path.endswith(".rating.torque") for path in one.missing)
    return not one.unfit and rated and "duty.life" not in one.missing


def _dynamic(subject: Design) -> float:
    """Return by which factor masses and friction raise the largest couple of a cross; 1 where it cannot be told."""
    try:
        parts, asked, _history, _cycles = duty_parts(subject.duty)
        whole = train(subject.drive, kinds=True)
        light = replace(whole, inertia=None, cross_inertia=None, drag=None, resisting_torque=None)
        real, plain = (bearing_loads(subject.drive, one, asked, parts).couple for one in (whole, light))
    except InputError:
        return 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        grown = np.max(real, axis=0) / np.max(plain, axis=0)
    return float(max(1.0, np.max(grown[np.isfinite(grown)], initial=1.0)))


# What the stresses of a drive count of torsional vibration, and what they leave out: friction, weights, axial forces.

LITTLE = 1.02
"""Times the torque counted up to which torsional vibration is not worth a word."""

SLIGHT = 0.005
"""Share by which all forces together must raise the load of a journal to be told."""


def left_out(drive: Drive, found: Strength) -> LeftOut:
    """Return what the stresses of a drive leave out."""
    supported = drive.duty.torque is not None and bool(drive.supports)
    return LeftOut(
        journal=_journal(drive, found) if supported else None,
        supported=supported,
        runs_up=forced_run_up(drive, drive.duty) is not None and drive.duty.starts is None,
    )


def _journal(drive: Drive, found: Strength) -> Journal | None:
    """Return the journal whose load all forces together raise most; None if unknown or by little."""
    if found.cases[0].name:
        return None
    try:
        every = forces(drive)
    except InputError:
        return None
    ways = (every,) if every.reverse is None else (every, every.reverse)
    load = np.max([np.max(np.asarray(one.journals.size), axis=(-1, -2)) for one in ways], axis=0)
    couple = found.cases[0].couple
    span = np.asarray([one.couple / one.journal_force if one.journal_force > 0.0 else math.nan for one in found.joints])
    more = load * span / np.where(couple > 0.0, couple, math.nan) - 1.0
    if not np.any(np.isfinite(more)):
        return None
    i = int(np.nanargmax(more))
    several = len(found.cases) > 1
    return Journal(joint=i + 1, load=float(load[i]), more=float(more[i]), several=several) if more[i] > SLIGHT else None
