"""``cardan joint``: how does a type of joint turn by itself, and which of several turns most evenly?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .options import AsCsv, AsJson, Plot

if TYPE_CHECKING:
    from cardan.catalogue.rows import JointType
    from cardan.drive.joints.common.inside import Inside
    from cardan.questions.motion.joint_law import JointBends, JointTurn

    from .answer import Answer, Cell, Remark, Table
    from .joint_kinds import Asked

SHOWN = (2.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0)
"""Bends [deg] of the table of one joint."""

ROOM = 40
"""Letters that sizes may take in a command to type next."""

USUAL = 20.0
"""Bend [deg] where none is said."""


def _words(incomplete: str) -> list[tuple[str, str]]:
    """Complete the name of a kind."""
    from cardan.drive.joints import JOINTS

    from .joint_kinds import sentence_of

    return [(name, sentence_of(kind)) for name, kind in JOINTS.items() if name.startswith(incomplete)]


def joint(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="KIND [KEY=VALUE]",
            help=_("Kinds of joints, each followed by its sizes as a drive file has them; none lists the kinds."),
            show_default=False,
            autocompletion=_words,
        ),
    ] = None,
    bend_deg: Annotated[
        float, typer.Option("--bend-deg", "--bend", metavar="DEG", help=_("Bend of the joints."))
    ] = USUAL,
    speed_rpm: Annotated[
        float | None,
        typer.Option(
            "--speed-rpm", metavar="RPM", help=_("Input speed, for accelerations and limits."), show_default=False
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how kinds of joints turn by themselves, over a turn and over their bends."""
    from .asked import check_options
    from .show import show

    check_options(speed_rpm, json=json, csv=csv, plot=plot)

    from .joint_kinds import asked, kinds_answer, made

    if not words:
        return show(kinds_answer(), json=json, csv=csv)

    from math import isfinite

    from cardan.errors import InputError, refuse
    from cardan.questions.motion.joint_law import joint_turn
    from cardan.units import deg

    if not isfinite(bend_deg):
        raise refuse("--bend-deg", _("{value} is not a finite number").format(value=bend_deg))
    several = asked(words)
    turns = []
    for thing in made(several):
        try:
            turns.append(joint_turn(thing, bend_deg * deg))
        except InputError as error:
            raise error.renamed(lambda field: "--bend-deg" if field == "bend" else field) from error
    return show(_answer(several, turns, speed_rpm), json=json, csv=csv, plot=plot)


def _answer(several: Sequence[Asked], turns: Sequence[JointTurn], speed_rpm: float | None) -> Answer:
    from functools import cache

    from .answer import Answer

    labels = [one.label for one in several]

    @cache
    def bends() -> tuple[JointBends, ...]:
        from cardan.questions.motion.joint_law import joint_bends

        return tuple(joint_bends(one.joint) for one in turns)

    def drawn() -> Any:
        from cardan.questions.motion.figures.joint_law import joint_figures

        return joint_figures(turns, bends(), labels)

    beyond = [one for one in turns if one.bend > one.joint.steepest]
    return Answer(
        sentence=_sentence(labels, turns),
        tone="warning" if beyond else "plain",
        tables=lambda: tuple(_tables(several, turns, speed_rpm)),
        remarks=tuple(_remarks(several, turns)),
        content=lambda: _content(several, turns, bends(), speed_rpm),
        csv=lambda: _curves(labels, turns),
        figure=drawn,
    )


def _sentence(labels: Sequence[str], turns: Sequence[JointTurn]) -> str:
    from math import degrees

    from .answer import percent, significant

    at = significant(degrees(turns[0].bend), 3)
    if len(turns) == 1:
        (one,) = turns
        if not one.error:
            return _("{name} at {bend}°: the output turns exactly evenly.").format(name=labels[0], bend=at)
        text = _("{name} at {bend}°: the output runs ahead and back by {error}°, its speed varies by {share}.")
        return text.format(
            name=labels[0], bend=at, error=significant(degrees(one.error)), share=percent(one.irregularity)
        )
    even = [label for label, one in zip(labels, turns, strict=True) if not one.error]
    rest = max(turns, key=lambda one: one.error)
    worst = labels[list(turns).index(rest)]
    if len(even) == len(turns):
        return _("All {count} joints turn exactly evenly at {bend}°.").format(count=len(turns), bend=at)
    text = _("At {bend}° {worst} is the most uneven, ±{error}°; {even}.")
    said = plural("{count} of {all} turns exactly evenly", "{count} of {all} turn exactly evenly", len(even))
    if not even:
        said = _("none of {all} turns exactly evenly")
    return text.format(
        bend=at,
        worst=worst,
        error=significant(degrees(rest.error), 3),
        even=said.format(count=len(even), all=len(turns)),
    )


def _tables(several: Sequence[Asked], turns: Sequence[JointTurn], speed_rpm: float | None) -> Iterator[Table]:
    if len(turns) > 1:
        yield _compared(several, turns, speed_rpm)
    else:
        if turns[0].error:
            yield _over_bends(turns[0], speed_rpm)
    inner = [(one.label, row) for one, turn in zip(several, turns, strict=True) for row in _inside(turn)]
    if inner:
        yield _inner(inner, several=len(turns) > 1)
    if len(turns) == 1 and several[0].kind:
        yield from _types(several[0].kind, turns[0], speed_rpm)


def _compared(several: Sequence[Asked], turns: Sequence[JointTurn], speed_rpm: float | None) -> Table:
    from math import degrees

    from .answer import Column, Table

    rows: list[list[Cell]] = []
    for one, turn in zip(several, turns, strict=True):
        row: list[Cell] = [
            one.label,
            degrees(turn.error),
            100.0 * turn.irregularity,
            turn.order if turn.error else None,
            *([_acceleration(turn, speed_rpm)] if speed_rpm is not None else []),
            degrees(turn.joint.steepest),
        ]
        rows.append(row)
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="error_deg", heading=_("error ±"), unit="°", form="3"),
        Column(key="irregularity_percent", heading=_("speed"), unit="%", form="3"),
        Column(key="order", heading=_("times"), unit=_("a turn")),
        *([Column(key="acceleration_rad_s2", heading="ε", unit="rad/s²", form="3")] if speed_rpm is not None else []),
        Column(key="steepest_deg", heading=_("works to"), unit="°", form="3"),
    )
    tones = ["warning" if one.bend > one.joint.steepest else "plain" for one in turns]
    return Table(columns=columns, rows=rows, tones=tones)  # type: ignore[arg-type]


def _acceleration(turn: JointTurn, speed_rpm: float) -> float:
    from cardan.units import rpm

    return turn.acceleration * (speed_rpm * rpm) ** 2


def _over_bends(turn: JointTurn, speed_rpm: float | None) -> Table:
    from math import degrees

    from cardan.questions.motion.joint_law import joint_bends
    from cardan.units import deg, rpm

    from .answer import Column, Table

    known = sorted({*(one for one in SHOWN if one * deg <= turn.joint.steepest), round(degrees(turn.bend), 9)})
    found = joint_bends(turn.joint, [one * deg for one in known])
    squared = None if speed_rpm is None else (speed_rpm * rpm) ** 2
    rows: list[list[Cell]] = [
        [
            known[k],
            degrees(float(found.error[k])),
            100.0 * float(found.irregularity[k]),
            *([] if squared is None else [float(found.acceleration[k]) * squared]),
        ]
        for k in range(len(known))
    ]
    columns = (
        Column(key="bend_deg", heading=_("bend"), unit="°", form="3"),
        Column(key="error_deg", heading=_("error ±"), unit="°", form="3"),
        Column(key="irregularity_percent", heading=_("speed"), unit="%", form="3"),
        *([] if squared is None else [Column(key="acceleration_rad_s2", heading="ε", unit="rad/s²", form="3")]),
    )
    return Table(columns=columns, rows=rows, title=_("Over the bend"))


def _inside(turn: JointTurn) -> tuple[Inside, ...]:
    from cardan.questions.motion.joint_inside import joint_inside

    return joint_inside(turn.joint, turn.bend)


def _measured(row: Inside) -> tuple[str, float]:
    """Return the unit a measure is shown in, and its value there."""
    from cardan.units import factor, preferred

    if row.dimension is None:
        return "", row.value
    unit = preferred(row.dimension)
    return unit, row.value / factor(row.dimension, unit)


def _inner(inner: Sequence[tuple[str, Inside]], *, several: bool) -> Table:
    from cardan.units import label

    from .answer import Column, Table

    rows: list[list[Cell]] = []
    for name, row in inner:
        unit, value = _measured(row)
        rows.append([*([name] if several else []), value, label(unit), row.meaning])
    columns = (
        *([Column(key="joint", heading=_("joint"), left=True)] if several else []),
        Column(key="value", form="4"),
        Column(key="unit", left=True),
        Column(key="meaning", left=True, wrap=True),
    )
    return Table(columns=columns, rows=rows, title=_("What else moves inside"))


def _types(kind: str, turn: JointTurn, speed_rpm: float | None) -> Iterator[Table]:
    from math import degrees

    from cardan.questions.motion.joint_law import types_of

    from .answer import Column, Table

    found = types_of(kind)
    if not found:
        return
    rows: list[list[Cell]] = [
        [
            one.id,
            None if one.max_bend is None else degrees(one.max_bend),
            one.max_torque,
            _verdict(one, turn, speed_rpm),
        ]
        for one in found
    ]
    columns = (
        Column(key="type", heading=_("type of the catalogue"), left=True),
        Column(key="max_bend_deg", heading=_("bend to"), unit="°", form="3"),
        Column(key="max_torque_Nm", heading=_("torque to"), unit="N·m", form="3"),
        Column(key="verdict", heading=_("here"), left=True, wrap=True),
    )
    yield Table(columns=columns, rows=rows, title=_("Types that turn so, with the limits of their sources"))


def _verdict(row: JointType, turn: JointTurn, speed_rpm: float | None) -> str:
    """Return in words whether a type of the catalogue allows bend and speed."""
    from cardan.units import rpm

    if row.max_bend is not None and turn.bend > row.max_bend * (1.0 + 1e-12):
        return _("✖ bends too much")
    if row.max_speed_angle is not None and speed_rpm is not None:
        if abs(speed_rpm) * rpm * turn.bend > row.max_speed_angle * (1.0 + 1e-12):
            return _("✖ too fast at this bend, if it runs for long")
        return _("● allowed") if row.max_bend is not None else _("▲ speed allowed, bend not given")
    return _("▲ the source gives no bend") if row.max_bend is None else _("● allowed")


def _remarks(several: Sequence[Asked], turns: Sequence[JointTurn]) -> Iterator[Remark]:
    from math import degrees

    from .answer import Remark, significant

    for one, turn in zip(several, turns, strict=True):
        if turn.bend > turn.joint.steepest:
            text = _("{name}: the law holds, but real joints of this kind work to {bend}° only.")
            text = text.format(name=one.label, bend=significant(degrees(turn.joint.steepest), 3))
            yield Remark(text=text, tone="warning")
    ideal = [one.label for one, turn in zip(several, turns, strict=True) if not one.keys and not turn.error]
    if ideal:
        text = _("Without sizes these count as made exactly even: {names}. Sizes are keys of the drive file:")
        yield Remark(text=text.format(names=", ".join(ideal)), command=("cardan", "joint"), tone="next")
    elif len(several) == 1:
        text = _("Beside others:")
        other = turns[0].joint.beside
        yield Remark(text=text, command=("cardan", "joint", several[0].kind, *_sizes(several[0]), other), tone="next")


def _sizes(one: Asked) -> tuple[str, ...]:
    """Return the sizes of a joint as words, none where they would not stand on a line."""
    words = tuple(f"{key}={value}" for key, value in one.keys.items() if not isinstance(value, dict))
    return words if sum(map(len, words)) <= ROOM else ()


def _curves(labels: Sequence[str], turns: Sequence[JointTurn]) -> Table:
    import numpy as np

    from .answer import Column, Table

    names = [label.replace(" ", "_") for label in labels]
    columns = [Column(key="angle_deg")]
    values = [np.degrees(turns[0].angle)]
    for name, one in zip(names, turns, strict=True):
        columns += [Column(key=f"{name}_lead_deg"), Column(key=f"{name}_ratio"), Column(key=f"{name}_slope")]
        values += [np.degrees(one.lead), np.asarray(one.ratio), np.asarray(one.slope)]
    return Table(columns=tuple(columns), rows=np.stack(values, axis=-1).tolist())


def _content(
    several: Sequence[Asked], turns: Sequence[JointTurn], bends: Sequence[JointBends], speed_rpm: float | None
) -> dict[str, Any]:
    from math import degrees

    import numpy as np

    from cardan.questions.motion.joint_law import types_of

    return {
        "question": "joint",
        "bend_deg": degrees(turns[0].bend),
        "speed_rpm": speed_rpm,
        "joints": [
            {
                "kind": one.kind,
                "name": one.label,
                "sizes": one.keys,
                "error_deg": degrees(turn.error),
                "irregularity": turn.irregularity,
                "acceleration_over_speed_squared": turn.acceleration,
                "acceleration_rad_s2": None if speed_rpm is None else _acceleration(turn, speed_rpm),
                "order": turn.order,
                "steepest_deg": degrees(turn.joint.steepest),
                "inside": {_key(row): _measured(row)[1] for row in _inside(turn)},
                "types": [row.id for row in types_of(one.kind)],
                "turn": {
                    "angle_deg": np.degrees(turn.angle),
                    "lead_deg": np.degrees(turn.lead),
                    "ratio": turn.ratio,
                    "slope": turn.slope,
                },
                "bends": {
                    "bend_deg": np.degrees(over.bend),
                    "error_deg": np.degrees(over.error),
                    "irregularity": over.irregularity,
                },
            }
            for one, turn, over in zip(several, turns, bends, strict=True)
        ],
    }


def _key(row: Inside) -> str:
    unit = _measured(row)[0]
    return f"{row.key}_{unit}" if unit else row.key
