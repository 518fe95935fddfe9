"""Whether every shaft stays far enough below the speed at which it whirls."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict, turning
from cardan.formulas.critical_speed import ARTICLE, CATALOGUE, SEPARATION
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .whirl import Whirl, bounces, clearances, nearest, whirls


def _judge(design: Design) -> Iterator[Verdict]:
    for one in whirls(design):
        subject = f"shafts[{one.shaft}]"
        if one.missing or design.unmoved:
            yield Verdict(subject=subject, missing=(*one.missing, *design.unmoved))
            continue
        if one.speed is None:
            continue
        top = np.maximum(np.asarray(design.top_speed, dtype=float), 1e-9)
        own = design.value("limits.critical_speed")
        source = _("rule of practice, source unknown: 60 % above the highest speed")
        yield Verdict(
            subject=subject,
            value=one.wear * one.speed / top,
            limit=ARTICLE if own is None else own,
            sense="at_least",
            source=source if own is None else _("limits of the drive file"),
            confidence="recalled" if own is None else "",
            design_variables=(*one.design_variables, *design.speed_design_variables),
            note=_note(one),
        )
        application = design.duty.application
        makers = {
            "automotive": _("IMS Ltd: Critical speeds, ims-ltd.co.uk/technical-data, vehicles: 70 %"),
            "industrial": _("IMS Ltd: Critical speeds, ims-ltd.co.uk/technical-data, industry: 65 %"),
        }
        yield Verdict(
            subject=subject,
            title=_("speed ratio n/n_crit of shaft {number}, computed"),
            value=top / one.speed,
            limit=CATALOGUE[application],
            dimension="share",
            unit="percent",
            source=makers[application],
            design_variables=(
                *(path for path in one.design_variables if "wear" not in path),
                *design.speed_design_variables,
            ),
            note=_computed(one),
        )
        yield from _beside(design, one, top)
    yield from _bounced(design)


def _beside(design: Design, one: Whirl, top: Array) -> Iterator[Verdict]:
    """Yield how far the speeds held keep off the speed at which a shaft whirls, where the speeds in use come near it.

    top: highest speed [rad/s]; whirling on the way to a speed beyond counts as held.
    """
    low, high = one.actual * (1.0 - SEPARATION), one.actual * (1.0 + SEPARATION)
    passed, held = np.asarray(top >= one.actual), design.held_speeds
    if not np.any(top > low) or not (held or np.any(passed)):
        return
    near = nearest(held or [np.minimum(top, low)], one.actual)
    yield Verdict(
        subject=f"shafts[{one.shaft}]",
        title=_("clearance from the critical speed, shaft {number}"),
        value=np.where(passed, one.actual, near),
        limit=(low, high),
        sense="outside",
        dimension="angular_speed",
        unit="rpm",
        source=_separation(),
        design_variables=(*one.design_variables, *design.speed_design_variables),
    )


def _separation() -> str:
    return _("separation of 20 %: beyond it a mode amplifies an unbalance at most 3.3 times")


def _bounced(design: Design) -> Iterator[Verdict]:
    """Yield how far the speeds keep off those at which a support gives way."""
    for one in bounces(design):
        texts = (
            _("clearance from the critical speed, bounce mode on support {number}"),
            _("passing the critical speed, bounce mode on support {number}"),
        )
        if one.sideways:
            texts = (
                _("clearance from the critical speed, bounce mode on support {number}, sideways"),
                _("passing the critical speed, bounce mode on support {number}, sideways"),
            )
        yield from clearances(design, one, 1.0, SEPARATION, texts, _separation())


def _note(one: Whirl) -> Text:
    """Return which critical speed of one shaft counts, as computed and as the real shaft has it."""
    if one.speed is None or np.ndim(one.speed) or np.ndim(one.wear) or float(one.wear) == 1.0:
        return _computed(one)
    text = _("{factor} of the {speed} computed for the whole line")
    if not one.exact:
        text = _("{factor} of the {speed} computed for the tube between its joints")
    return say(text, factor=Quantity(float(one.wear), digits=3, trim=True), speed=turning(float(one.speed)))


def _computed(one: Whirl) -> Text:
    """Return the critical speed of one shaft as computed."""
    if one.speed is not None and np.ndim(one.speed) and one.exact:
        return _("scaled from the speed of the drive as it is, computed for the whole line")
    if one.speed is None or np.ndim(one.speed):
        return ""
    text = _("{speed}, computed for the whole line")
    if not one.exact:
        text = _("{speed}, computed for the tube between its joints")
    return say(text, speed=turning(float(one.speed)))


CHECK = Check(
    name="critical_speed",
    doc=mark("critical speed of every shaft in bending against the highest speed"),
    judge=_judge,
    title=mark("margin n_crit/n of shaft {number}, real"),
    moves=True,
    slides=True,
)
