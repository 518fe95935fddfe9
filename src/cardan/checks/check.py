"""What a check is: a name, a sentence, and a function from a design to verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from cardan.answers.quantity import numbered
from cardan.answers.question import Gathering
from cardan.catalogue.provenance import unconfirmed
from cardan.catalogue.rows import UNSURE, sureness
from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.models.kinematics_model import mixed, unmapped
from cardan.questions.torsion.stability.in_use import why_larger
from cardan.texts import _

from .design import Design
from .verdict import Sense, Verdict

VIBRATING = frozenset({"torsional_resonance", "torque_reversal", "gap_closure"})
"""Checks whose verdicts on torques rest on the alternating torque, beside those that grow with a power of it."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """A check.

    What all its verdicts share stands here; a verdict says the rest, and where it differs.

    Attributes
    ----------
    name : str
        Its name in `CHECKS`.
    doc : str
        One sentence on what it judges.
    judge : function, optional
        From a design to its verdicts; a verdict that lacks data names the paths that are missing.
    joint, shaft : function, optional
        The same of every joint or shaft: from a design and the place of the part, counted from 0.
    title : str
        What is judged, with a place for the number of joint or shaft.
    dimension, unit, sense, advice, power
        As of `Verdict`.
    crosses : str
        "each" where it judges Hooke joints only, one by one; "all" where it judges drives that have no others; "law"
        where many drives at once must have joints with tan φ' = κ tan φ.
    application : str
        Of drives that it is made for, as of `Duty`; empty where it judges all.
    moves : bool
        Whether it judges a drive that moves at the instants of its movement, as all do whose use grows with the torque.
    slides : bool
        Whether it judges a drive that moves where its shafts are longest and shortest, too.
    events : bool
        Whether the largest torques of starts and other events count, which come now and then.
    gathers : str
        "worst" where each pose is judged by itself; "sum" where one verdict is over all of them by their shares.
    """

    name: str
    doc: str
    judge: Callable[[Design], Iterable[Verdict]] | None = None
    joint: Callable[[Design, int], Iterable[Verdict]] | None = None
    shaft: Callable[[Design, int], Iterable[Verdict]] | None = None
    title: str = ""
    dimension: str = ""
    unit: str = ""
    sense: Sense = "at_most"
    advice: bool = False
    power: float = 0.0
    crosses: Literal["", "each", "all", "law"] = ""
    application: str = ""
    moves: bool = False
    slides: bool = False
    events: bool = False
    gathers: Gathering = "worst"

    @property
    def instants(self) -> bool:
        """Whether it judges each instant of a movement by itself."""
        return self.gathers == "worst" and (self.moves or bool(self.power))

    def verdicts(self, design: Design) -> Iterator[Verdict]:
        """Yield the verdicts on a design; those on joints of a kind that the check does not judge say so."""
        joints, own = design.drive.joints, design.duty.application
        if self.application not in ("", own):
            why = _("made for the application {one}, not for {other}").format(one=self.application, other=own)
            yield from (_unfit(one, why) for one in self._judged(design))
            return
        if not self.crosses or not mixed(joints):
            yield from self._judged(design)
            return
        if self.crosses == "law":
            lawless = unmapped(joints)
            for one in self._judged(design):
                stuck = lawless and bool(design.varied)
                yield _unfit(one, _ruled(joints[lawless[0]])) if stuck else one
            return
        others = [i for i, joint in enumerate(joints) if not joint.single_cross]
        for one in self._judged(design):
            whole = self.crosses == "all" or any(path.endswith(".kind") for path in one.missing)
            concerned = others if whole else [one.number - 1] if one.subject.startswith("joints[") else []
            kinds = [joints[i].kind for i in concerned if i in others]
            yield _unfit(one, _crossless(kinds[0])) if kinds else one

    def _judged(self, design: Design) -> Iterator[Verdict]:
        """Yield the verdicts, each with what all of them share."""
        if self.judge is not None:
            yield from (self._founded(self._whole(one, design), design) for one in self.judge(design))
        for path, judge, count in (
            ("joints", self.joint, design.joints),
            ("shafts", self.shaft, design.joints + 1),
        ):
            for k in range(count) if judge is not None else ():
                assert judge is not None
                named = (replace(one, subject=f"{path}[{k}]") for one in judge(design, k))
                yield from (self._founded(self._whole(one, design), design) for one in named)

    def _whole(self, one: Verdict, design: Design) -> Verdict:
        kind, part = one.title or _(self.title), part_of(design.drive, one.subject)
        return replace(
            one,
            check=self.name,
            kind=kind,
            title=kind.format(number=part) if one.number else kind,
            dimension=one.dimension or self.dimension,
            unit=one.unit or self.unit,
            sense=one.sense if one.sense != "at_most" else self.sense,
            advice=one.advice or self.advice or one.confidence in UNSURE,
            power=self.power,
        )

    def _founded(self, one: Verdict, design: Design) -> Verdict:
        """Return a verdict with the rows of the catalogue that it rests on and that nothing confirms."""
        if not one.run:
            return one
        rows = design.filled_by(*one.design_variables, *one.rests)
        own = [_(UNSURE[one.confidence])] if one.confidence in UNSURE else []
        least = min((one.confidence, *(row.confidence for row in rows if row.confidence in UNSURE)), key=sureness)
        found = replace(one, confidence=least, provenance=(*own, *unconfirmed(rows)))
        rests = self.power or (one.dimension == "torque" and self.name in VIBRATING)
        why = surpassed(design) if rests and np.all(one.passed) else ""
        return _unfit(found, why) if why else found


def surpassed(design: Design) -> str:
    """Return why a drive may have larger torques than steady vibration counts; empty where it has none.

    Of designs that vary each is judged as its steady vibration has it.
    """
    counted = not design.varied and any(case.vibration is not None for case in design.loaded)
    return why_larger(design.drive, stable=design.tried) if counted else ""


def part_of(drive: Drive, subject: str) -> str:
    """Return number and name of the joint, shaft or support at a path, empty for the drive as a whole.

    >>> part_of(Drive.from_angles([0.1]), "joints[0]")
    '1'
    """
    if not subject:
        return ""
    kind, _bracket, rest = subject.partition("[")
    number = int(rest.partition("]")[0]) + 1
    parts = getattr(drive, kind)
    return numbered(number, parts[number - 1].name if number <= len(parts) else "")


def _ruled(joint: Joint) -> str:
    text = _("judges joints with tan φ' = κ tan φ, not one of kind {kind} with these sizes")
    return text.format(kind=joint.kind)


def _crossless(kind: str) -> str:
    return _("judges Hooke joints, not a joint of kind {kind}").format(kind=kind)


def _unfit(one: Verdict, why: str) -> Verdict:
    return replace(one, value=float("nan"), limit=float("nan"), missing=(), design_variables=(), note="", unfit=why)
