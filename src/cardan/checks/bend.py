"""Whether every joint may bend as far as it does: by its maker, its type, or the user's own limit."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.catalogue.rows import JointType
from cardan.texts import _

from .check import Check
from .design import Design
from .verdict import Verdict


def _judge(design: Design) -> Iterator[Verdict]:
    own = design.drive.limits.bend
    for i, joint in enumerate(design.drive.joints):
        row = design.known.rows(JointType).get(joint.type)
        limits = [
            (own, _("limits of the drive file")),
            (design.value(f"joints[{i}].rating.max_bend"), _("rating of the joint")),
            (row.max_bend if row else None, row.source if row else ""),
        ]
        given = [(limit, source) for limit, source in limits if limit is not None]
        title = _("bend of joint {number}").format(number=i + 1)
        common = {"check": "bend", "subject": f"joints[{i}]", "title": title, "dimension": "angle", "unit": "deg"}
        if not given:
            yield Verdict(**common, missing=(f"joints[{i}].rating.max_bend",))  # type: ignore[arg-type]
            continue
        limit, source = given[0]
        yield Verdict(
            **common,  # type: ignore[arg-type]
            value=design.bend[..., i],
            limit=limit,
            source=source,
            levers=_levers(design, i),
        )


def _levers(design: Design, i: int) -> tuple[str, ...]:
    """Return the paths that move the bend of a joint."""
    if design.drive.form == "angles":
        return (f"joints[{i}].bend",)
    if design.drive.form == "points":
        around = [f"joints[{k}].centre" for k in (i - 1, i, i + 1) if 0 <= k < len(design.drive.joints)]
        return tuple(around)
    return tuple(f"shafts[{k}].side_slope" for k in (i, i + 1))


CHECK = Check(name="bend", doc=_("bend of every joint against what maker, type or user allow"), judge=_judge)
