"""Strength of the joints of a drive: journals, yokes and needles of every cross, and what their makers allow."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from cardan.catalogue import Catalogue
from cardan.catalogue.rows import JointType
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Joint
from cardan.errors import InputError
from cardan.formulas.joint_rating import NOMINAL, POWER, rated_bend
from cardan.formulas.joint_strength import PartStress, journal_stress, yoke_stress
from cardan.formulas.needle_bearing import STATIC_PRESSURE, Contact, book_load, needle_contact
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.forces.turn_loads import LoadCase
from cardan.questions.life.bearing_life import CONVENTIONS
from cardan.questions.life.joint_bearings import joint_bearings
from cardan.questions.life.life import life
from cardan.texts import _

from .strength_use import Use, lacking

NEEDLES = ("count", "diameter", "length")
"""Sizes of needles that their contact needs."""

ROUNDS = 8
"""Times that a torque for a life is bettered at most; three are usual."""

RESTS = 1e-11
"""Change of the torque at which this ends."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointStrength:
    """What a joint goes through over all ways of running, shocks counted; nan or None where it cannot be told.

    Attributes
    ----------
    number : int
        From 1.
    torque : float [N·m]
        Largest torque on either side.
    couple : float [N·m]
        Largest couple of the cross.
    journal_force : float [N]
        Largest load of a journal, couple over span.
    journal, yoke : PartStress or None
    contact : Contact or None
        Of the most loaded needle.
    static_capacity : float [N]
        As given, or by ISO 76.
    book_capacity : float [N]
        Load that the book allows at the speed of the duty, no more than the static capacity.
    """

    number: int
    torque: float
    couple: float
    journal_force: float = math.nan
    journal: PartStress | None = None
    yoke: PartStress | None = None
    contact: Contact | None = None
    static_capacity: float = math.nan
    book_capacity: float = math.nan


def judged_joints(
    drive: Drive,
    duty: Duty,
    known: Catalogue,
    cases: Sequence[LoadCase],
    torque: Array,
    couple: Array,
    bend: Array,
) -> tuple[tuple[JointStrength, ...], tuple[Use, ...]]:
    """Return the strength of every joint, and what it uses of its limits.

    Parameters
    ----------
    drive : Drive
    duty : Duty
    known : Catalogue
        Its types of joints.
    cases : sequence of LoadCase (c,)
    torque : array (c, n+1) [N·m]
        Largest torque of each shaft.
    couple : array (c, n) [N·m]
        Largest couple of each cross.
    bend : array (c, n) [rad]
        Bend of each joint.
    """
    lives = _lives(drive, duty)
    joints: list[JointStrength] = []
    uses: list[Use] = []
    for i in range(len(drive.joints)):
        one = _Judge(drive, duty, known, cases, torque, couple, bend, i, lives)
        joints.append(one.strength())
        own = tuple(f"joints[{i}].{name}" for name in drive.joints[i].foreign)
        uses += [use for use in one.uses() if not any(path.startswith(own) for path in use.missing)]
    return tuple(joints), tuple(uses)


def _lives(drive: Drive, duty: Duty) -> tuple[Array, Array] | None:
    """Return the life of every joint by ISO 281 [s], and by which factor the torques may grow for the life demanded.

    Masses count in a life, so that it is not quite a power of the torque: of the joint that fails first the factor is
    bettered until it rests, that of the others is left at the power.
    """
    if duty.life is None:
        return None
    try:
        found = life(drive, duty, method="iso").of("iso")
        with np.errstate(divide="ignore"):
            factors = (found / duty.life) ** (1.0 / POWER)
        first = int(foremost(factors, least=True)) if not np.all(np.isnan(factors)) else -1
        for _round in range(ROUNDS if first >= 0 and math.isfinite(factors[first]) else 0):
            now = life(drive, scaled(duty, factors[first]), method="iso").of("iso")[first]
            step = float((now / duty.life) ** (1.0 / POWER))
            factors[first] *= step
            if abs(step - 1.0) < RESTS:
                break
    except InputError:
        return None
    return found, factors


def scaled(duty: Duty, factor: float) -> Duty:
    """Return a duty with all its torques times a factor.

    Examples
    --------
    >>> scaled(Duty(torque=100.0), 1.5).torque
    150.0
    """
    history = duty.torque_history
    return replace(
        duty,
        torque=None if duty.torque is None else factor * duty.torque,
        harmonics=tuple(replace(one, torque=factor * one.torque) for one in duty.harmonics),
        blocks=tuple(replace(one, torque=factor * one.torque) for one in duty.blocks),
        torque_history=None
        if history is None
        else replace(history, torques=tuple(factor * one for one in history.torques)),
    )


@dataclass(frozen=True, eq=False)
class _Judge:
    """One joint, counted from 0, with what it is judged by."""

    drive: Drive
    duty: Duty
    known: Catalogue
    cases: Sequence[LoadCase]
    torque: Array
    couple: Array
    bend: Array
    i: int
    lives: tuple[Array, Array] | None

    @property
    def joint(self) -> Joint:
        return self.drive.joints[self.i]

    @property
    def path(self) -> str:
        return f"joints[{self.i}]"

    def made(self, check: str, title: str, **more: Any) -> partial[Use]:
        return partial(Use, check=check, part=self.path, title=title.format(number=self.i + 1), **more)

    def most(self, values: Array) -> tuple[float, str]:
        """Return the largest of values (c,), shocks counted, and which part of the duty it is of."""
        at = int(foremost(values))
        return float(values[at]) * self.duty.shock_factor, self.cases[at].name

    @property
    def span(self) -> float:
        cross = self.joint.cross
        return math.nan if cross is None or cross.span is None else cross.span

    @property
    def force(self) -> tuple[float, str]:
        """Largest load of a journal [N], and which part of the duty it is of."""
        couple, case = self.most(self.couple[:, self.i])
        return couple / self.span, case

    def uses(self) -> Iterator[Use]:
        yield self._rated()
        if self.duty.life is not None and not lacking(self.drive, f"{self.path}.rating.torque"):
            yield self._maker()
        yield self._journal()
        yield self._yoke()
        yield self._static()
        yield self._contact()
        if self.duty.life is not None:
            yield self._life()

    def _rated(self) -> Use:
        made = self.made("joint_torque", _("largest torque of joint {number}"), dimension="torque", unit="Nm")
        rating, row = self.joint.rating, self.known.rows(JointType).get(self.joint.type)
        own = rating.max_torque if rating is not None else None
        limit = own if own is not None else row.max_torque if row is not None else None
        if limit is None:
            return made(missing=(f"{self.path}.rating.max_torque",))
        value, case = self.most(np.maximum(self.torque[:, self.i], self.torque[:, self.i + 1]))
        source = _("rating of the joint") if own is not None or row is None else row.source
        return made(value=value, limit=limit, source=source, case=case)

    def _maker(self) -> Use:
        """Return what the torque of the whole duty uses of the rated torque for its life."""
        made = self.made(
            "rated_torque", _("rated torque of joint {number} for its life"), dimension="torque", unit="Nm"
        )
        rating = self.joint.rating
        running = [c for c, case in enumerate(self.cases) if case.share > 0.0 and case.speed]
        if rating is None or rating.torque is None or not running:
            return made(missing=("duty.speed",))
        share = np.asarray([self.cases[c].share for c in running])
        pace = (
            share * np.asarray([(self.cases[c].speed or 0.0) for c in running]) * rated_bend(self.bend[running, self.i])
        )
        beside = np.maximum(self.torque[running, self.i], self.torque[running, self.i + 1])
        same = float(np.sum(pace * beside**POWER) / np.sum(pace)) ** (1.0 / POWER)
        rated = rating.torque / NOMINAL if rating.convention == "book" else rating.torque
        turned = float(np.sum(pace) / np.sum(share)) * (self.duty.life or math.nan)
        return made(
            value=self.duty.shock_factor * same,
            limit=rated * (CONVENTIONS[rating.convention] / turned) ** (1.0 / POWER),
            source=_("rating by the maker's convention, {name}").format(name=rating.convention),
        )

    def _of_journal(self) -> PartStress | None:
        cross = self.joint.cross
        if cross is None or cross.journal is None or math.isnan(self.span):
            return None
        arm = cross.bending_arm
        if arm is None:
            if cross.journal_length is None:
                return None
            arm = 0.5 * cross.journal_length
        return journal_stress(self.force[0], diameter=cross.journal, arm=arm, bore=cross.journal_bore)

    def _journal(self) -> Use:
        made = self.made(
            "journal_strength", _("stress of the journals of joint {number}"), dimension="stress", unit="MPa"
        )
        path = f"{self.path}.cross"
        strength = f"{path}.material.yield_strength"
        missing = lacking(self.drive, f"{path}.span", f"{path}.journal", strength)
        if len(lacking(self.drive, f"{path}.bending_arm", f"{path}.journal_length")) == 2:
            missing = (*missing, f"{path}.bending_arm")
        stress = self._of_journal()
        if missing or stress is None:
            return made(missing=missing)
        material = self.joint.cross.material if self.joint.cross is not None else None
        return made(
            value=float(stress.mises),
            limit=_strength(material) / self.drive.limits.safety,
            source=_("Book (264), (265) with the grease bore; yield strength over safety"),
            case=self.force[1],
        )

    def _of_yoke(self) -> PartStress | None:
        yoke = self.joint.yoke
        if yoke is None or yoke.section is None or yoke.bending_arm is None or yoke.torsion_arm is None:
            return None
        return yoke_stress(
            self.force[0],
            bending_arm=yoke.bending_arm,
            torsion_arm=yoke.torsion_arm,
            height=yoke.section.height,
            width=yoke.section.width,
            shape=yoke.section.shape,
        )

    def _yoke(self) -> Use:
        made = self.made("yoke_strength", _("stress of the yokes of joint {number}"), dimension="stress", unit="MPa")
        yoke = f"{self.path}.yoke"
        paths = tuple(f"{yoke}.{one}" for one in ("bending_arm", "torsion_arm", "section", "material.yield_strength"))
        missing = lacking(self.drive, f"{self.path}.cross.span", *paths)
        stress = self._of_yoke()
        if missing or stress is None:
            return made(missing=missing)
        material = self.joint.yoke.material if self.joint.yoke is not None else None
        return made(
            value=float(stress.mises),
            limit=_strength(material) / self.drive.limits.safety,
            source=_("Book (263) with Saint-Venant's torsion; yield strength over safety"),
            case=self.force[1],
        )

    @property
    def _capacity(self) -> float:
        return float(joint_bearings(self.drive)[0].static_capacity[self.i])

    def _static(self) -> Use:
        made = self.made(
            "needle_static", _("load of the needles of joint {number} at rest"), dimension="force", unit="N"
        )
        missing = lacking(self.drive, f"{self.path}.cross.span")
        if math.isnan(self._capacity):
            missing = (*missing, f"{self.path}.needles.static_capacity")
        if missing:
            return made(missing=missing)
        given = self.joint.needles is not None and self.joint.needles.static_capacity is not None
        load, case = self.force
        source = _("static capacity of the bearing") if given else "ISO 76"
        return made(value=load, limit=self._capacity, source=source, case=case)

    def _of_contact(self) -> Contact | None:
        cross, needles = self.joint.cross, self.joint.needles
        if cross is None or cross.journal is None or needles is None:
            return None
        if needles.count is None or needles.diameter is None or needles.length is None:
            return None
        return needle_contact(self.force[0], needles.count, needles.diameter, needles.length, cross.journal)

    def _contact(self) -> Use:
        made = self.made(
            "contact_pressure",
            _("pressure on the needles of joint {number}"),
            dimension="stress",
            unit="MPa",
            advice=True,
            power=0.5,
        )
        sizes = tuple(f"{self.path}.needles.{name}" for name in NEEDLES)
        missing = lacking(self.drive, f"{self.path}.cross.span", f"{self.path}.cross.journal", *sizes)
        contact = self._of_contact()
        if missing or contact is None:
            return made(missing=missing)
        source = _("Hertz; 4000 MPa stands behind ISO 76")
        return made(value=float(contact.pressure), limit=STATIC_PRESSURE, source=source, case=self.force[1])

    def _life(self) -> Use:
        made = self.made(
            "bearing_life",
            _("life of the bearings of joint {number}"),
            dimension="time",
            unit="h",
            at_least=True,
            power=POWER,
        )
        missing = [one.field for one in joint_bearings(self.drive)[1] if one.field.startswith(f"{self.path}.")]
        missing += [] if any(case.speed for case in self.cases) else ["duty.speed"]
        if missing or self.lives is None:
            return made(missing=tuple(missing) or ("duty.speed",))
        source = _("ISO 281 over the swing of the journals, reliability {share:g} %")
        return made(
            value=float(self.lives[0][self.i]),
            limit=self.duty.life or math.nan,
            factor=float(self.lives[1][self.i]),
            source=source.format(share=100.0 * self.duty.reliability),
        )

    def _book(self) -> float:
        """Return the load that the book allows at the highest speed under load, never above the static capacity."""
        needles = self.joint.needles
        speeds = [case.speed for case in self.cases if case.speed]
        if not speeds or needles is None:
            return math.nan
        if needles.count is None or needles.diameter is None or needles.length is None:
            return math.nan
        allowed = book_load(needles.count, needles.diameter, needles.length, max(speeds) / (2.0 * math.pi))
        return float(np.fmin(allowed, self._capacity))

    def strength(self) -> JointStrength:
        """Return what the joint goes through."""
        beside = np.maximum(self.torque[:, self.i], self.torque[:, self.i + 1])
        return JointStrength(
            number=self.i + 1,
            torque=self.most(beside)[0],
            couple=self.most(self.couple[:, self.i])[0],
            journal_force=self.force[0],
            journal=self._of_journal(),
            yoke=None if math.isnan(self.span) else self._of_yoke(),
            contact=None if math.isnan(self.span) else self._of_contact(),
            static_capacity=self._capacity,
            book_capacity=self._book(),
        )


def _strength(material: Any) -> float:
    """Return the yield strength of a material, nan without one."""
    return math.nan if material is None or material.yield_strength is None else float(material.yield_strength)
