"""What there is to say of a choice of joints: types and sizes that do a job, under which conditions, why not others."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from cardan.answers.answer import Answer, Cell, Column, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.answers.question import Lacking, all_of
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.questions.assumed import yokes_estimated
from cardan.texts import _, plural

from .selection import (
    Candidate,
    JointDuty,
    Reason,
    SizeFit,
    fitting_sizes,
    joint_duty,
    over_time,
    reasons,
    select_joint,
)

TONES: dict[str, Tone] = {"ok": "good", "conditional": "warning", "unrated": "plain", "rejected": "failed"}

SHOWN = 12
"""Sizes that fit shown to people; programs get all."""

FAR = 0.1
"""Torque reserve below which a type is for drives of another kind, and not shown to people either."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Selection:
    """What could be taken for a need."""

    need: JointDuty
    types: tuple[Candidate, ...]  # every type of the catalogue: accepted, under conditions, rejected
    sizes: tuple[SizeFit, ...]  # every size of it


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for a choice of its joints."""
    try:
        joint_duty(drive)
    except InputError as error:
        return all_of([one.field for one in error.problems])
    return ()


def selected(need: JointDuty, *, known: Catalogue | None = None, modern: bool = False) -> Selection:
    """Return what could be taken for a need.

    known: the shipped one when not given; modern: count modern types too, whose limits are typical values.
    """
    types = select_joint(need, known=known, include_beyond=modern)
    return Selection(need=need, types=tuple(types), sizes=fitting_sizes(need, known=known))


def ask(drive: Drive, *, known: Catalogue | None = None, joint: int | None = None) -> Selection:
    """Return what could be taken for the joints of a drive, or for one of them."""
    need = over_time(joint_duty(drive, joint=joint, known=known), drive, joint=joint, known=known)
    return selected(need, known=known)


def answer(drive: Drive | None, result: Selection) -> Answer:
    """Return what there is to say of a choice of joints."""
    states = [one.state for one in result.types]
    tone: Tone = "good" if "ok" in states else "warning" if "conditional" in states else "failed"
    return Answer(
        name="select",
        title=_("Selection of joints"),
        sentence=_sentence(result),
        tone=tone,
        tables=_tables(result),
        remarks=(*_remarks(result), *(yokes_estimated(drive) if drive and has_torsion(drive) else ())),
        facts=_facts(result),
        full=lambda: _rows(result),
        code=1 if tone == "failed" else 0,
    )


def _sentence(result: Selection) -> Say:
    need = result.need
    accepted, under = (sum(one.state == state for one in result.types) for state in ("ok", "conditional"))
    done = plural("one type does it", "{count} types do it", accepted).format(count=accepted)
    more = plural("one more under conditions", "{count} more under conditions", under).format(count=under)
    return say(
        _("{torque} at {angle} and {speed}: {accepted}, {more}."),
        torque=Quantity(need.torque * need.service_factor, "torque"),
        angle=Quantity(need.joint_angle, "angle", 3),
        speed=Quantity(need.speed, "angular_speed"),
        accepted=done if accepted else _("no type does it without conditions"),
        more=more if under else _("none under conditions"),
    )


def _tables(result: Selection) -> tuple[Table, ...]:
    """Return the sizes, where any comes near, and the types: what fits stands first."""
    near = _near(result.sizes)
    tables = [_types(result), *((_sizes(result, near),) if near else ())]
    return tuple(tables[::-1] if near and near[0].fits else tables)


def _said(why: Sequence[Reason]) -> Text:
    return Joined([one.message for one in why], between="; ")


def _types(result: Selection) -> Table:
    words = {"ok": _("accepted"), "conditional": _("with conditions"), "rejected": _("rejected")}
    found = [one for one in result.types if one.state != "unrated" and not one.headroom < FAR]
    why = [reasons(one, result.need) for one in found]
    return Table(
        title=_("Types of joints"),
        fixed=2,
        columns=(
            Column(
                key="",
                heading=_("verdict"),
                values=[Cell(value=words[one.state], tone=TONES[one.state]) for one in found],
            ),
            Column(key="", heading=_("type"), values=[one.row.id for one in found]),
            Column(key="", heading=_("name"), values=[one.row.name for one in found], depth="full"),
            Column(key="", heading=_("torque reserve"), values=_room([one.headroom for one in found]), digits=3),
            Column(
                key="",
                heading=_("why"),
                values=[_said(own) if own else one.row.name for one, own in zip(found, why, strict=True)],
                wrap=True,
            ),
            Column(key="", heading=_("source"), values=[one.row.source for one in found], depth="full"),
        ),
        note=_("Torque reserve: the torque it may carry over that needed."),
    )


def _room(values: Sequence[float]) -> list[float | None]:
    return [None if math.isnan(one) else one for one in values]


def _why(one: SizeFit, asked: bool) -> Text:
    """Return of which series a size that fits is, and what its source does not rate; else why it does not fit."""
    if not one.fits:
        return _said(one.reasons)
    unrated = _("no rating for the life asked") if asked and math.isnan(one.life) else ""
    steep = "" if one.row.rating and one.row.rating.max_joint_angle else _("no largest joint angle given")
    return Joined([part for part in (one.row.series, unrated, steep) if part], between="; ")


def _near(sizes: Sequence[SizeFit]) -> list[SizeFit]:
    """Return the smallest sizes that fit, and of each of their series the next smaller one, which does not."""
    fits = [one for one in sizes if one.fits][:SHOWN]
    below = []
    for name in dict.fromkeys(one.row.series for one in fits or sizes):
        own = [one for one in sizes if one.row.series == name and not math.isnan(one.headroom)]
        least = min((one.headroom for one in own if one.fits), default=math.inf)
        short = (one for one in own if not one.fits and FAR <= one.headroom < least)
        below.append(max(short, key=_strength, default=None))
    return [*fits, *(one for one in below if one is not None)]


def _strength(one: SizeFit) -> float:
    return one.headroom


def _sizes(result: Selection, sizes: Sequence[SizeFit]) -> Table:
    every, asked = result.sizes, result.need.life is not None
    fits = [(_("fits"), "good") if one.fits else (_("rejected"), "failed") for one in sizes]
    outer = [one.row.space if math.isfinite(one.row.space) else None for one in sizes]
    return Table(
        title=_("Sizes of the catalogue by their makers' ratings"),
        fixed=2,
        columns=(
            Column(
                key="",
                heading=_("verdict"),
                values=[Cell(value=word, tone="good" if tone == "good" else "failed") for word, tone in fits],
            ),
            Column(key="", heading=_("size"), values=[one.row.id for one in sizes]),
            Column(key="", heading=_("outer diameter"), values=outer, dimension="length"),
            Column(
                key="",
                heading=_("life"),
                values=_room([one.life for one in sizes]),
                dimension="time",
                unit="h",
                digits=3,
            ),
            Column(key="", heading=_("torque reserve"), values=_room([one.headroom for one in sizes]), digits=3),
            Column(key="", heading=_("why"), values=[_why(one, asked) for one in sizes], wrap=True),
            Column(key="", heading=_("source"), values=[one.row.source for one in sizes], depth="full"),
        ),
        note=say(
            _("{fit} of {count} sizes fit; below those shown the next smaller one of each series, and what it lacks."),
            fit=sum(one.fits for one in every),
            count=len(every),
        ),
    )


def _remarks(result: Selection) -> Iterator[Remark]:
    unrated = [one.row.id for one in result.types if one.state == "unrated"]
    if unrated:
        text = _("Their sources give no torque, so these types are not candidates: {types}.")
        yield Remark(text=text.format(types=", ".join(unrated)))
    weak = [one.row.id for one in result.types if one.state != "unrated" and one.headroom < FAR]
    if weak:
        text = _("These types are for far smaller torques: {types}.")
        yield Remark(text=text.format(types=", ".join(weak)))
    yield Remark(text=_("A figure that the source of a type does not give is a condition: look it up at the maker's."))
    if result.sizes and not _near(result.sizes):
        yield Remark(text=_("No size of the catalogue carries a tenth of this torque."))
    if any(one.fits for one in result.sizes):
        text = _(
            "Life that {share} of the joints reach, by the maker's formula, at the largest torque and speed throughout."
        )
        if result.need.loads:
            text = _(
                "Life that {share} of the joints reach, by the maker's formula over load cases, poses and movements; "
                "torque reserve and speeds are of the largest."
            )
        yield Remark(text=say(text, share=Quantity(result.need.reliability, "share", 6, trim=True)))
        yield Remark(text=_("cardan strength --size judges a size in a drive by every limit."))
    command = ("cardan", "catalogue", "joint_types", "TYPE")
    yield Remark(text=_("Where every figure comes from:"), command=command, tone="next")


def _rows(result: Selection) -> Table:
    found = result.types
    return Table(
        columns=(
            Column(key="type", values=[one.row.id for one in found]),
            Column(key="state", values=[one.state for one in found]),
            Column(key="codes", values=[" ".join((*one.causes, *one.flags)) for one in found]),
            Column(key="why", values=[_said(reasons(one, result.need)) for one in found]),
            Column(key="headroom", values=[one.headroom for one in found]),
            Column(key="confidence", values=[one.row.confidence for one in found]),
            Column(key="source", values=[one.row.source for one in found]),
        )
    )


def _facts(result: Selection) -> dict[str, Any]:
    need = result.need
    return {
        "need": {
            "torque": Quantity(need.torque, "torque"),
            "joint_angle": Quantity(need.joint_angle, "angle"),
            "speed": Quantity(need.speed, "angular_speed"),
            "service_factor": need.service_factor,
            "synchronous": need.synchronous,
            "continuous": need.continuous,
            "outer": None if need.outer is None else Quantity(need.outer, "length"),
        },
        "types": [
            {
                "type": one.row.id,
                "name": one.row.name,
                "state": one.state,
                "headroom": one.headroom,
                "reasons": _reasons(reasons(one, need)),
                "confidence": one.row.confidence,
                "source": one.row.source,
            }
            for one in result.types
        ],
        "sizes": [
            {
                "size": one.row.id,
                "series": one.row.series,
                "fits": one.fits,
                "life": None if math.isnan(one.life) else Quantity(one.life, "time", unit="h"),
                "headroom": one.headroom,
                "reasons": _reasons(one.reasons),
                "confidence": one.row.confidence,
                "source": one.row.source,
            }
            for one in result.sizes
        ],
    }


def _reasons(why: Sequence[Reason]) -> list[dict[str, Any]]:
    return [
        {"code": one.code, "message": one.message, "value": one.value, "limit": one.limit, "source": one.source}
        for one in why
    ]
