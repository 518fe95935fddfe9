"""What can be put into a drive file with one touch: settings of the yokes, and changes that cure failed verdicts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from cardan.answers.quantity import say
from cardan.answers.reader import reader
from cardan.errors import InputError
from cardan.figures.wording import percent
from cardan.questions.motion.equivalence import SYNCHRONOUS
from cardan.questions.motion.kinds import kind_name
from cardan.questions.phases.answer import excess
from cardan.questions.phases.phases import Phasing, phases
from cardan.questions.phases.setting import YokeSetting, values_of
from cardan.texts import _

from .subject import Subject

SHOWN = 3
"""Settings with spline teeth beside the exact ones."""


@dataclass(frozen=True, kw_only=True)
class Applicable:
    """A change of the drive file that has a name."""

    label: str  # what it is called
    effect: str = ""  # what it comes to, in a few words
    # path with unit -> value, as `cardan.io.edit.edit` takes them; empty where the file has it so
    values: Mapping[str, float | int | str] = field(default_factory=dict)


def settings(on: Subject) -> tuple[Applicable, ...]:
    """Return the settings of the yokes that can be applied, as in the table of settings, without the one as built."""
    found = _phasing(on)
    if found is None:
        return ()
    several = (*found.settings, *found.spline_settings[:SHOWN], *found.pose_settings)
    return tuple(_of(one, on) for one in several)


def synchronous(on: Subject) -> Applicable | str:
    """Return the setting that makes the drive synchronous, or in a sentence why there is none to apply."""
    if on.joints == 1:
        return _("A single joint has no second one to undo it.")
    try:
        found = _phasing(on)
    except InputError as error:
        return "; ".join(problem.message for problem in error.problems)
    if found is None:
        own = ", ".join(f"{k} ({kind_name(joint)})" for k, joint in enumerate(on.drive.joints, start=1))
        return _("Yoke angles cannot be found for these joints: {joints}.").format(joints=own)
    if found.as_built.speed_fluctuation < SYNCHRONOUS:
        return _("The yokes stand right: the drive is synchronous.")
    exact = [one for one in found.settings if one.speed_fluctuation < SYNCHRONOUS]
    if not exact:
        return _why_not(on, found)
    return _of(exact[0], on)


def _phasing(on: Subject) -> Phasing | None:
    """Return what the yokes can do; None where joints turn by laws of their own that count."""
    if isinstance(on, Subject):
        return on.phasing
    try:
        return phases(on.drive)
    except InputError:
        return None


def _why_not(on: Subject, found: Phasing) -> str:
    least = percent(found.speed_fluctuation_min)
    if found.limiting_joint is None or len(found.limiting_joints) != 1:
        text = _("Joints tied by held yokes act as one that is too uneven for the others; {least} is the least.")
        return text.format(least=least)
    i = found.limiting_joint - 1
    why = excess(found, on.joints, float(on.joint_angle[i]), plain=on.drive.joints[i].single_cross)
    return say(_("It cannot be made uniform. {why}"), why=why).told(reader())


def _of(one: YokeSetting, on: Subject) -> Applicable:
    effect = _("leaves {share}").format(share=percent(one.speed_fluctuation))
    return Applicable(label=one.label, effect=effect, values=values_of(one, on.drive))
