"""What there is to say of kinds of joints by themselves: how uniformly each turns, over a turn and over its angle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from cardan.answers.answer import Answer, Cell, Column, Remark, Table, Tone
from cardan.answers.quantity import Quantity, Say, say
from cardan.catalogue.rows import JointType
from cardan.drive.joints import JOINTS
from cardan.drive.joints.joint import Inside, Joint
from cardan.later import later
from cardan.maths.ties import foremost
from cardan.reading.fields import fields_of
from cardan.texts import _, plural
from cardan.units import deg

from .joint_law import JointAngles, JointTurn, joint_over_angles, joint_turn, types_of
from .kinds import joint_inside, quantity_of

drawn = later("cardan.questions.motion.figures.joint_law")

__all__ = ["Beside", "Named", "answer", "answer_of_kinds", "ask", "sentence_of", "written"]

SHOWN = (2.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0)
"""Joint angles [deg] of the table of one joint."""

ROOM = 40
"""Letters that sizes may take in a command to type next."""

SLACK = 1.0 + 1e-12
"""What a limit of the catalogue may be exceeded by rounding."""


@dataclass(frozen=True, kw_only=True)
class Named:
    """A joint with what it is called beside others, and its sizes as a drive file has them."""

    joint: Joint
    name: str
    sizes: Mapping[str, Any]


@dataclass(frozen=True, eq=False, kw_only=True)
class Beside:
    """Joints beside each other, all at one joint angle."""

    named: tuple[Named, ...]
    turns: tuple[JointTurn, ...]
    speed: float | None = None  # [rad/s]: constant speed of the driving shafts

    @cached_property
    def joint_angles(self) -> tuple[JointAngles, ...]:
        """How each fluctuates over its joint angle."""
        return tuple(joint_over_angles(one.joint) for one in self.turns)

    @property
    def names(self) -> list[str]:
        """What they are called."""
        return [one.name for one in self.named]

    @property
    def squared(self) -> float | None:
        """Square of the speed."""
        return None if self.speed is None else self.speed**2


def ask(named: Sequence[Named], joint_angle: float, *, speed: float | None = None) -> Beside:
    """Return joints beside each other.

    named: at least one; joint_angle [rad]: joint angle of all; speed [rad/s]: constant speed of the driving shafts.
    Raises InputError: as of `cardan.questions.motion.joint_law.joint_turn`.
    """
    turns = tuple(joint_turn(one.joint, joint_angle) for one in named)
    return Beside(named=tuple(named), turns=turns, speed=speed)


def answer(result: Beside) -> Answer:
    """Return what there is to say of joints beside each other."""
    beyond = any(one.joint_angle > one.joint.steepest for one in result.turns)
    return Answer(
        name="joint",
        title=_("Joints by themselves"),
        sentence=_sentence(result),
        tone="warning" if beyond else "plain",
        figures=lambda: drawn().joint_figures(result.turns, result.joint_angles, result.names),
        tables=tuple(_tables(result)),
        remarks=tuple(_remarks(result)),
        facts=_facts(result),
        full=lambda: _curves(result),
    )


def _angle(value: float, digits: int = 3) -> Quantity:
    return Quantity(value, "angle", digits)


def _sentence(result: Beside) -> Say:
    turns, names, at = result.turns, result.names, _angle(result.turns[0].joint_angle)
    if len(turns) == 1:
        (one,) = turns
        text = _("{name} at {angle}: the output turns exactly uniformly.")
        if one.error:
            text = _("{name} at {angle}: output angle error ±{error}, speed fluctuation δ = {share}.")
        share = Quantity(one.speed_fluctuation, "share")
        return say(text, name=names[0], angle=at, error=_angle(one.error, 4), share=share)
    uniform = sum(not one.error for one in turns)
    if uniform == len(turns):
        return say(_("All {count} joints turn exactly uniformly at {angle}."), count=len(turns), angle=at)
    worst = int(foremost([one.error for one in turns]))
    some = plural("{count} of {all} turns exactly uniformly", "{count} of {all} turn exactly uniformly", uniform)
    if not uniform:
        some = _("none of {all} turns exactly uniformly")
    return say(
        _("At {angle} {worst} has the largest output angle error, ±{error}; {uniform}."),
        angle=at,
        worst=names[worst],
        error=_angle(turns[worst].error),
        uniform=some.format(count=uniform, all=len(turns)),
    )


def _tables(result: Beside) -> Iterator[Table]:
    if len(result.turns) > 1:
        yield _compared(result)
    elif result.turns[0].error:
        yield _over_angles(result)
    inner = [(one.name, row) for one, turn in zip(result.named, result.turns, strict=True) for row in _inside(turn)]
    if inner:
        yield _inner(inner, several=len(result.turns) > 1)
    if len(result.turns) == 1:
        found = types_of(result.turns[0].joint.kind)
        if found:
            yield _types(found, result)


def _columns(angle_error: Any, share: Any, acceleration: Any) -> tuple[Column, ...]:
    """Return the columns of what a joint does to the output."""
    return (
        Column(key="angle_error", heading=_("angle error ±"), values=angle_error, dimension="angle", digits=3),
        Column(key="speed_fluctuation", heading=_("fluctuation δ"), values=share, dimension="share", digits=3),
        *(
            ()
            if acceleration is None
            else (
                Column(
                    key="acceleration",
                    heading=_("acceleration ±"),
                    values=acceleration,
                    dimension="angular_acceleration",
                    digits=3,
                ),
            )
        ),
    )


def _compared(result: Beside) -> Table:
    turns, squared = result.turns, result.squared
    tones: list[Tone] = ["warning" if one.joint_angle > one.joint.steepest else "plain" for one in turns]
    return Table(
        columns=(
            Column(key="joint", heading=_("joint"), values=result.names, left=True),
            *_columns(
                [one.error for one in turns],
                [one.speed_fluctuation for one in turns],
                None if squared is None else [one.acceleration * squared for one in turns],
            ),
            Column(key="order", heading=_("order"), values=[one.order if one.error else None for one in turns]),
            Column(
                key="max_joint_angle",
                heading=_("works to"),
                values=[one.joint.steepest for one in turns],
                dimension="angle",
                digits=3,
            ),
        ),
        tones=tones,
    )


def _over_angles(result: Beside) -> Table:
    (turn,), squared = result.turns, result.squared
    known = sorted(
        {*(one for one in SHOWN if one * deg <= turn.joint.steepest), round(math.degrees(turn.joint_angle), 9)}
    )
    found = joint_over_angles(turn.joint, [one * deg for one in known])
    return Table(
        title=_("Over the joint angle"),
        columns=(
            Column(
                key="joint_angle",
                heading=_("joint angle"),
                values=[one * deg for one in known],
                dimension="angle",
                digits=3,
            ),
            *_columns(found.error, found.speed_fluctuation, None if squared is None else found.acceleration * squared),
        ),
    )


def _inside(turn: JointTurn) -> tuple[Inside, ...]:
    return joint_inside(turn.joint, turn.joint_angle)


def _inner(inner: Sequence[tuple[str, Inside]], *, several: bool) -> Table:
    heads = [Column(key="joint", heading=_("joint"), values=[name for name, _row in inner], left=True)]
    return Table(
        title=_("What else moves inside"),
        columns=(
            *(heads if several else ()),
            Column(key="value", values=[quantity_of(row) for _name, row in inner]),
            Column(key="meaning", values=[row.meaning for _name, row in inner], left=True, wrap=True),
        ),
        fixed=int(several),
    )


def _types(found: Sequence[JointType], result: Beside) -> Table:
    return Table(
        title=_("Types that turn so, with the limits of their sources"),
        columns=(
            Column(key="type", heading=_("type of the catalogue"), values=[one.id for one in found], left=True),
            Column(
                key="max_joint_angle",
                heading=_("joint angle to"),
                values=[one.max_joint_angle for one in found],
                dimension="angle",
                digits=3,
            ),
            Column(
                key="max_torque",
                heading=_("torque to"),
                values=[one.max_torque for one in found],
                dimension="torque",
                digits=3,
            ),
            Column(
                key="verdict",
                heading=_("here"),
                values=[_verdict(one, result.turns[0], result.speed) for one in found],
                left=True,
                wrap=True,
            ),
        ),
    )


def _verdict(row: JointType, turn: JointTurn, speed: float | None) -> Cell:
    """Return in words whether a type of the catalogue allows joint angle and speed."""
    if row.max_joint_angle is not None and turn.joint_angle > row.max_joint_angle * SLACK:
        return Cell(value=_("joint angle too large"), tone="failed")
    if row.max_speed_angle is not None and speed is not None:
        if abs(speed) * turn.joint_angle > row.max_speed_angle * SLACK:
            return Cell(value=_("too fast at this joint angle, if it runs for long"), tone="failed")
        if row.max_joint_angle is None:
            return Cell(value=_("speed allowed, joint angle not given"), tone="warning")
    if row.max_joint_angle is None:
        return Cell(value=_("the source gives no joint angle"), tone="warning")
    return Cell(value=_("allowed"), tone="good")


def _remarks(result: Beside) -> Iterator[Remark]:
    for one, turn in zip(result.named, result.turns, strict=True):
        if turn.joint_angle > turn.joint.steepest:
            text = _("{name}: the law holds, but real joints of this kind work to {angle} only.")
            yield Remark(text=say(text, name=one.name, angle=_angle(turn.joint.steepest)), tone="warning")
    pairs = zip(result.named, result.turns, strict=True)
    ideal = [one.name for one, turn in pairs if not one.sizes and not turn.error]
    if ideal:
        text = _("Without sizes these count as made exactly uniform: {names}; sizes are keys of the drive file:")
        yield Remark(text=text.format(names=", ".join(ideal)), command=("cardan", "joint"), tone="next")
    elif len(result.named) == 1:
        joint = result.turns[0].joint
        words = ("cardan", "joint", joint.kind, *_sizes(result.named[0]), joint.beside)
        yield Remark(text=_("Beside others:"), command=words, tone="next")


def _sizes(one: Named) -> tuple[str, ...]:
    """Return the sizes of a joint as words, none where they would not stand on a line."""
    words = tuple(f"{key}={value}" for key, value in one.sizes.items() if not isinstance(value, dict))
    return words if sum(map(len, words)) <= ROOM else ()


def _curves(result: Beside) -> Table:
    columns = [Column(key="angle", values=result.turns[0].angle, dimension="angle")]
    for name, one in zip((label.replace(" ", "_") for label in result.names), result.turns, strict=True):
        columns += [
            Column(key=f"{name}_angle_error", values=one.angle_error, dimension="angle"),
            Column(key=f"{name}_ratio", values=one.ratio),
            Column(key=f"{name}_slope", values=one.slope),
        ]
    return Table(columns=columns)


def _facts(result: Beside) -> dict[str, Any]:
    squared = result.squared
    return {
        "joint_angle": Quantity(result.turns[0].joint_angle, "angle"),
        "speed": Quantity(result.speed, "angular_speed"),
        "joints": [
            {
                "kind": turn.joint.kind,
                "name": one.name,
                "sizes": one.sizes,
                "angle_error": Quantity(turn.error, "angle"),
                "speed_fluctuation": Quantity(turn.speed_fluctuation, "share"),
                "acceleration_over_speed_squared": turn.acceleration,
                "acceleration": Quantity(
                    None if squared is None else turn.acceleration * squared, "angular_acceleration"
                ),
                "order": turn.order,
                "max_joint_angle": Quantity(turn.joint.steepest, "angle"),
                "inside": {row.key: quantity_of(row) for row in _inside(turn)},
                "types": [row.id for row in types_of(turn.joint.kind)],
                "turn": {
                    "angle": Quantity(turn.angle, "angle"),
                    "angle_error": Quantity(np.asarray(turn.angle_error), "angle"),
                    "ratio": turn.ratio,
                    "slope": turn.slope,
                },
                "over_joint_angle": {
                    "joint_angle": Quantity(over.joint_angle, "angle"),
                    "angle_error": Quantity(over.error, "angle"),
                    "speed_fluctuation": Quantity(over.speed_fluctuation, "share"),
                },
            }
            for one, turn, over in zip(result.named, result.turns, result.joint_angles, strict=True)
        ],
    }


def answer_of_kinds() -> Answer:
    """Return the list of all kinds of joints, with their sizes."""
    kinds = list(JOINTS.items())
    sizes = [", ".join(written(kind)) for _name, kind in kinds]
    docs = [sentence_of(kind) for _name, kind in kinds]

    def columns(*more: Column) -> tuple[Column, ...]:
        return (
            Column(key="kind", heading=_("kind"), values=[name for name, _kind in kinds], left=True),
            Column(
                key="max_joint_angle",
                heading=_("works to"),
                values=[kind.steepest for _name, kind in kinds],
                dimension="angle",
                digits=3,
            ),
            *more,
        )

    long = [f"{doc} [{keys}]" if keys else doc for doc, keys in zip(docs, sizes, strict=True)]
    text = plural("{count} kind of joint.", "{count} kinds of joints.", len(kinds)).format(count=len(kinds))
    words = ("cardan", "joint", "hooke", "double_cardan", "centring_ratio=0.5", "--joint-angle-deg", "30")
    return Answer(
        name="joint",
        title=_("Kinds of joints"),
        sentence=text,
        tables=(Table(columns=columns(Column(key="doc", values=long, left=True, wrap=True))),),
        remarks=(
            Remark(
                text=_("Several at once are compared; sizes are the keys of the drive file:"),
                command=words,
                tone="next",
            ),
        ),
        facts={
            "kinds": [
                {
                    "kind": name,
                    "doc": sentence_of(kind),
                    "max_joint_angle": Quantity(kind.steepest, "angle"),
                    "types": [row.id for row in types_of(name)],
                    "keys": [
                        {"key": one.spelling, "required": one.required, "doc": _(one.key.doc)}
                        for field, one in fields_of(kind).items()
                        if field in kind.own_fields()
                    ],
                }
                for name, kind in kinds
            ]
        },
        full=lambda: Table(columns=columns(Column(key="doc", values=docs), Column(key="keys", values=sizes))),
    )


def sentence_of(kind: type[Joint]) -> str:
    """Return the one sentence that says what a kind is."""
    return _((kind.__doc__ or "").strip().splitlines()[0])


def written(kind: type[Joint]) -> list[str]:
    """Return the keys of a kind's own sizes as we write them."""
    return [one.spelling for name, one in fields_of(kind).items() if name in kind.own_fields()]
