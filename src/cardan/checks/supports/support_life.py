"""Whether the bearings of the supports last as long as the duty asks."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.strength.joints.bearing_life import rated
from cardan.checks.verdict import Verdict
from cardan.questions.life.support_loads import rated_supports
from cardan.texts import _, mark

STAYS = ("limits.", "duty.life", "duty.upkeep")
"""Beginnings of paths that do not change the loads of the supports."""


def alone(design: Design) -> bool:
    """Tell whether all the drives of a design load their supports alike."""
    return all(path.startswith(STAYS) for path in design.varied)


def _judge(design: Design) -> Iterator[Verdict]:
    for k in rated_supports(design.drive)[0]:
        subject = f"supports[{k}]"
        lacking = (*design.missing("duty.life"), *design.unloaded, *design.unmoved)
        if lacking:
            yield Verdict(subject=subject, missing=lacking)
            continue
        if not alone(design):
            yield Verdict(subject=subject, unfit=_("judges one drive at a time; a sweep asks life"))
            continue
        found = rated(design.drive)
        if isinstance(found, tuple) or found.supports is None:
            wrong = found if isinstance(found, tuple) else [(one.field, one.message) for one in found.uncounted]
            why = [text for path, text in wrong if path == "supports"]
            yield Verdict(subject=subject, unfit="; ".join(why or (text for _path, text in wrong)))
            continue
        yield Verdict(
            subject=subject,
            value=float(found.of_supports[found.supports.number.index(k + 1)]),
            limit=design.value("duty.life"),
            source=say(
                _("ISO 281 with the forces over the turn, reliability {share}"),
                share=Quantity(design.duty.reliability, "share", 6, trim=True),
            ),
            rests=(f"{subject}.capacity", f"{subject}.static_capacity"),
        )


CHECK = Check(
    name="support_life",
    doc=mark("life of the ball bearings of the supports by ISO 281 against the life asked for"),
    judge=_judge,
    title=mark("life of the bearing of support {number}"),
    dimension="duration",
    unit="h",
    sense="at_least",
    gathers="sum",
)
