"""What there is to say of the power that a drive loses: how much, in which part, what was left out; over speed too."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table, Value, closely
from cardan.answers.palette import colour
from cardan.answers.quantity import Joined, Quantity, Say, Text, Written, listed, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import in_a_joint, spelled
from cardan.drive.fields.wording import in_words, written
from cardan.drive.models.machine_held import machines_of
from cardan.drive.models.wobble import wobbling
from cardan.errors import refuse
from cardan.figures.figure import Figure
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost, largest
from cardan.questions.assumed import held_by_machines, yokes_estimated
from cardan.questions.motion.kinds import without_vibration
from cardan.texts import _, mark, plural

from .figure import loss_parts, losses_figures, map_figures, power
from .loss_parts import Uncounted
from .losses import Losses, LossMap
from .losses import losses as ask

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

SHOWN = (0, 3, 6, 9, 14)
"""Speeds and torques of the map that people are shown: a tenth to one and a half of the duty."""

ALLOWED = 1e-9
"""Share of the larger end that the power balance may miss: some thousand roundings."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the power loss."""
    joints = any(joint.friction is not None or joint.material_friction is not None for joint in drive.joints)
    supports = any(one.friction is not None or one.seal_diameter is not None for one in drive.supports)
    splines = any(shaft.spline is not None and shaft.spline.friction is not None for shaft in drive.shafts)
    timed = [case for case in load_cases(drive.duty) if case.share > 0.0] or [*load_cases(drive.duty)[:1]]
    return absent(
        (all(case.torque is not None for case in timed), "duty.torque", "duty.cases"),
        (all(case.speed is not None for case in timed), "duty.speed"),
        (
            joints or supports or splines,
            *in_a_joint(drive, "friction"),
            "supports[0].friction",
            "shafts[1].spline.friction",
        ),
    )


def answer(drive: Drive, result: Losses, over: LossMap | None = None) -> Answer:
    """Return what there is to say of the power loss of a drive.

    result: at the speed and torque of its duty; over: over other speeds and torques, shown instead of the parts.
    """
    locked = bool(result.locked)
    trace = _trace(result)
    return Answer(
        name="losses",
        title=_("Power loss"),
        sentence=_sentence(drive, result),
        tone="failed" if locked else "plain",
        figures=lambda: _figures(drive, result, over),
        tables=_tables(drive, result, over, trace),
        remarks=(*yokes_estimated(drive), *_remarks(drive, result, over)),
        keys=tuple(_keys(result)),
        facts=_facts(drive, result),
        full=lambda: trace if over is None else _map(over),
        code=1 if locked else 0,
    )


def _figures(drive: Drive, result: Losses, over: LossMap | None) -> tuple[Figure, ...]:
    own = losses_figures(result, drive) if result.heat > 0.0 else ()
    return (*own, *(() if over is None else map_figures(over)))


def _sentence(drive: Drive, result: Losses) -> Say:
    if result.locked:
        text = plural("friction locks joint {which}.", "friction locks joints {which}.", len(result.locked))
        return say(text, which=listed(result.locked))
    values: dict[str, Any] = {
        "torque": Quantity(result.torque, "torque"),
        "speed": Quantity(result.speed, "angular_speed"),
        "loss": power(result.heat),
    }
    if result.each and not result.worst and result.efficiency > 0.0 and result.heat > 0.0:
        text = _("efficiency {share} over {count} conditions by their shares; {loss} are lost, most in {part}: {most}.")
        parts = loss_parts(result, drive)
        places = largest([part.loss for part in parts])
        where = Joined([parts[k].named for k in places], last=_(" and "))
        values |= {"share": Quantity(result.efficiency, "share"), "count": len(result.each)}
        return say(text, part=where, most=power(parts[places[0]].loss), **values)
    if math.isnan(result.efficiency) or result.efficiency <= 0.0:
        return say(_("at {torque} and {speed} no power comes through; {loss} are lost."), **values)
    values |= {
        "share": Quantity(result.efficiency, "share"),
        "power": power(max(abs(result.input_power), abs(result.output_power))),
    }
    if result.heat <= 0.0:
        return say(_("efficiency {share} at {torque} and {speed}; no part loses power."), **values)
    parts = loss_parts(result, drive)
    places = largest([part.loss for part in parts])
    text = _("efficiency {share} at {torque} and {speed}; of {power}, {loss} are lost, most in {part}: {most}.")
    if len(places) > 1:
        text = _(
            "efficiency {share} at {torque} and {speed}; of {power}, {loss} are lost, most in {part}: {most} each."
        )
    where = Joined([parts[k].named for k in places], last=_(" and "))
    return say(text, part=where, most=power(parts[places[0]].loss), **values)


def _tables(drive: Drive, result: Losses, over: LossMap | None, trace: Table) -> tuple[Table, ...]:
    if over is not None:
        data = Table(name=trace.name, columns=trace.columns, depth="data")
        return (*_map_tables(over), data)
    return () if result.locked else (_parts(drive, result), *_each(result))


def _each(result: Losses) -> Iterator[Table]:
    """Yield the table of the conditions, where there are several."""
    if not result.each:
        return
    yield Table(
        name="conditions",
        records=True,
        title=_("Power loss in each condition"),
        columns=(
            Column(key="condition", heading=_("condition"), values=[one.name or _("as drawn") for one in result.each]),
            Column(
                key="share", heading=_("time"), values=[one.share for one in result.each], dimension="share", decimals=1
            ),
            Column(key="torque", heading=_("torque"), values=[one.torque for one in result.each], dimension="torque"),
            Column(
                key="speed", heading=_("speed"), values=[one.speed for one in result.each], dimension="angular_speed"
            ),
            Column(
                key="efficiency",
                heading=_("efficiency"),
                values=[one.efficiency for one in result.each],
                dimension="share",
            ),
            Column(
                key="power_loss", heading=_("power loss"), values=[one.heat for one in result.each], dimension="power"
            ),
        ),
    )


def _parts(drive: Drive, result: Losses) -> Table:
    whole = result.heat
    parts = loss_parts(result, drive)
    counted = [part.loss if part.counted else None for part in parts]
    sides = [
        [float(one) if joint.single_cross else None for one, joint in zip(side, drive.joints, strict=True)]
        + [None] * (len(parts) - len(side))
        for side in (result.driving_pins, result.driven_pins)
    ]
    names: list[Value] = [Cell(value=part.named, chip=colour(part.role)) for part in parts]
    shares = [None if loss is None or not whole else loss / whole for loss in counted]
    return Table(
        columns=(
            Column(key="part", heading=_("part"), values=[*names, _("all")]),
            Column(key="power_loss", heading=_("power loss"), values=[*counted, whole], dimension="power"),
            Column(
                key="share", heading=_("share"), values=[*shares, 1.0 if whole else None], dimension="share", decimals=1
            ),
            Column(key="driving", heading=_("driving yoke"), values=[*sides[0], None], dimension="power"),
            Column(key="driven", heading=_("driven yoke"), values=[*sides[1], None], dimension="power"),
        ),
        note=_("Means over a turn; driving and driven yoke: in the journals that each yoke of the joint holds."),
    )


def _map_tables(over: LossMap) -> Iterator[Table]:
    """Yield efficiency and loss at some speeds, from the top, and torques, to the right."""
    rows = [s for s in SHOWN if s < over.speed.size]
    speeds = Column(
        key="speed", heading=_("speed"), values=over.speed[rows], dimension="angular_speed", digits=5, trim=True
    )
    for title, values, dimension, decimals in (
        (_("Efficiency over speed and torque"), over.efficiency, "share", 3),
        (_("Power loss over speed and torque"), over.heat, "power", None),
    ):
        yield Table(
            title=title,
            columns=(
                speeds,
                *(
                    Column(
                        key=f"torque_{t}",
                        heading=Quantity(float(over.torque[t]), "torque", trim=True),
                        values=values[rows, t],
                        dimension=dimension,
                        decimals=decimals,
                    )
                    for t in SHOWN
                    if t < over.torque.size
                ),
            ),
        )


def _remarks(drive: Drive, result: Losses, over: LossMap | None) -> Iterator[Remark]:
    if unsteady := wobbling(drive):
        text = _("Joint angles count as drawn: that the shaft behind joint {which} wobbles is not in the power loss.")
        yield Remark(text=say(text, which=listed([i + 1 for i in unsteady])), code="wobble")
    if len(result.each) > 1 and not result.worst and result.heat > 0.0:
        parts = [(one.share or 0.0) * one.heat for one in result.each]
        one, part = result.each[int(foremost(parts))], max(parts) / sum(parts)
        text = _("Most heat arises in this condition: {condition}; {heat} of it in {share} of the time.")
        shares = {"heat": Quantity(part, "share", 3), "share": Quantity(one.share, "share", 3)}
        said = say(text, condition=one.name or _("as drawn"), **shares)
        yield Remark(text=said, code="governing_condition")
    if result.locked:
        text = plural(
            "Failed: friction in the journals of joint {which} reaches the torque that turns it; reduce friction, "
            "journal diameter or joint angle.",
            "Failed: friction in the journals of joints {which} reaches the torque that turns them; reduce friction, "
            "journal diameter or joint angle.",
            len(result.locked),
        )
        yield Remark(text=say(text, which=listed(result.locked)), tone="failed", alarm=True)
        return
    rubbing = any(support.friction is not None for support in drive.supports)
    yield from held_by_machines(machines_of(drive) if rubbing else ())
    yield from _gathered(drive, result, over)
    yield from without_vibration(drive)
    yield from _uncounted(result.uncounted)
    if any(joint.single_cross for joint in drive.joints):
        text = _(
            "By the usual formulas, for the journals alone, the efficiency is {first} to first order and {small} by "
            "the rule for small joint angles."
        )
        rules = {"first": result.first_order, "small": result.small_angle}
        yield Remark(text=say(text, **{name: Quantity(value, "share", 5) for name, value in rules.items()}), aside=True)
    if any(support.seal_diameter is not None for support in drive.supports):
        text = _(
            "Seals count with the guide value of ISO/TR 14179-2 for a lip in oil; rubber, lubricant, temperature and "
            "dust lips change it by half and more."
        )
        yield Remark(text=text, code="seal_guide_value")
    taken = float(np.sum(result.resisting))
    if taken:
        yield Remark(text=say(_("Resisting torques of the shafts take another {power}."), power=power(taken)))
    held = result.residual <= ALLOWED
    text = _("Power balance checked: input less output, losses, resisting torques and inertia closes {closely}.")
    yield Remark(text=say(text, closely=closely(result.residual)), tone="plain" if held else "failed", aside=held)
    if over is None:
        command = ("cardan", "losses", FILE, "--map")
        yield Remark(text=_("The same over speed and torque:"), command=command, tone="next")


def _gathered(drive: Drive, result: Losses, over: LossMap | None) -> Iterator[Remark]:
    """Yield how the losses were gathered over conditions."""
    if result.worst:
        text = _(
            "Warning: no {key} tells how long each pose lasts; this is the power loss where it is largest, in {pose}."
        )
        yield Remark(
            text=say(text, pose=result.worst, key=Written("share_percent", _("share of the time"))),
            tone="warning",
            code="no_share",
        )
    if result.drawn is not None:
        text = _("These are means over the movement; standing as drawn the efficiency is {share}, and {loss} are lost.")
        loss = power(result.drawn.heat)
        yield Remark(text=say(text, share=Quantity(result.drawn.efficiency, "share"), loss=loss))
    elif drive.movements:
        yield Remark(text=_("Every condition is a mean over its movement."))
    if over is not None and (drive.movements or drive.poses):
        yield Remark(text=_("The map over speed and torque is of the drive as drawn, standing still."))


def _uncounted(parts: Sequence[Uncounted]) -> Iterator[Remark]:
    """Yield what was left out, keys that differ only by their number together."""
    groups: dict[tuple[str, str], list[int]] = {}
    for one in parts:
        if not one.missing:
            text = _("Warning: not counted: {field}: {message}")
            yield Remark(text=say(text, field=written(one.field), message=one.message), tone="warning")
        elif one.field == "movements":
            text = _(
                "Warning: the power loss of splines is not counted: they slide while the drive moves, as {key} say."
            )
            moving = Written("[[movements]]", _("its movements"))
            yield Remark(text=say(text, key=moving), tone="warning")
        else:
            key = one.field.partition("].")[2]
            groups.setdefault((one.part, key), []).extend([] if one.number is None else [one.number])
    keys = [_key_of(part, key, numbers) for (part, key), numbers in groups.items()]
    if keys:
        text = _("Warning: some power loss is not counted; the file lacks {keys}.")
        yield Remark(text=say(text, keys=Joined(keys)), tone="warning")


def _key_of(part: str, key: str, numbers: Sequence[int]) -> Text:
    """Return a key with the parts that lack it; the table of the parts where there is none."""
    if not numbers:
        return Written(f"[[{part}]]", in_words(part))
    text = {
        "joints": plural("{key} of joint {which}", "{key} of joints {which}", len(numbers)),
        "supports": plural("{key} of support {which}", "{key} of supports {which}", len(numbers)),
        "shafts": plural("{key} of shaft {which}", "{key} of shafts {which}", len(numbers)),
    }[part]
    path = f"{part}[0].{key}"
    name = Written(spelled(path).partition("].")[2], in_words(path, inside=f"{part}[0]"))
    return say(text, key=name, which=listed(numbers))


def _keys(result: Losses) -> Iterator[KeyFigure]:
    if result.locked:
        return
    part = _("some power loss not counted") if result.uncounted else ""
    if result.efficiency > 0.0:
        yield KeyFigure(
            name="efficiency",
            title=_("efficiency"),
            value=Quantity(result.efficiency, "share"),
            better="more",
            verdict=part,
            tone="warning" if part else "plain",
        )
        part = ""
    yield KeyFigure(
        name="power_loss",
        title=_("power loss of all parts"),
        value=Quantity(result.heat, "power"),
        verdict=part,
        tone="warning" if part else "plain",
    )


def _column(key: str, values: Array, dimension: str = "") -> Column:
    return Column(key=key, values=values, dimension=dimension)


def _trace(result: Losses) -> Table:
    """Return torques and losses of the joints over the turn."""
    return Table(
        name="losses",
        columns=(
            _column("angle", result.angle, "angle"),
            _column("input_torque", result.input_torque, "torque"),
            _column("output_torque", result.output_torque, "torque"),
            *(_column(f"joint_{i}_power_loss", row, "power") for i, row in enumerate(result.joint_power, 1)),
        ),
    )


def _map(over: LossMap) -> Table:
    """Return the map, one speed and torque a row."""
    speed, torque = (np.ravel(one) for one in np.meshgrid(over.speed, over.torque, indexing="ij"))
    joints = over.joints.reshape(speed.size, -1)
    return Table(
        name="map",
        columns=(
            _column("speed", speed, "angular_speed"),
            _column("torque", torque, "torque"),
            _column("efficiency", np.ravel(over.efficiency)),
            _column("power_loss", np.ravel(over.heat), "power"),
            _column("input_power", np.ravel(over.input_power), "power"),
            _column("output_power", np.ravel(over.output_power), "power"),
            *(_column(f"joint_{i}_power_loss", row, "power") for i, row in enumerate(joints.T, 1)),
        ),
    )


def _facts(drive: Drive, result: Losses) -> dict[str, Any]:
    def watts(value: float) -> Quantity:
        return Quantity(float(value), "power")

    return {
        "speed": Quantity(result.speed, "angular_speed"),
        "torque": Quantity(result.torque, "torque"),
        "torque_at": result.torque_at,
        "efficiency": result.efficiency,
        "efficiency_first_order": result.first_order,
        "efficiency_small_joint_angles": result.small_angle,
        "input_power": watts(result.input_power),
        "output_power": watts(result.output_power),
        "power_loss": watts(result.heat),
        "joints": [
            {
                "number": i + 1,
                "name": joint.name,
                "power_loss": watts(result.joints[i]),
                "driving_journals": watts(result.driving_pins[i]),
                "driven_journals": watts(result.driven_pins[i]),
            }
            for i, joint in enumerate(drive.joints)
        ],
        "supports": [
            {
                "number": k + 1,
                "name": one.name,
                "power_loss": watts(result.supports[k]),
                "seals_power_loss": watts(result.seals[k]),
            }
            for k, one in enumerate(drive.supports)
        ],
        "shafts": [
            {
                "number": shaft.number,
                "name": shaft.name,
                "spline_power_loss": watts(result.splines[shaft.number - 1]),
                "resisting": watts(result.resisting[shaft.number - 1]),
                "storing": watts(result.storing[shaft.number - 1]),
            }
            for shaft in drive.shafts
        ],
        "locked_joints": result.locked,
        "not_counted": [{"field": spelled(one.field), "message": one.message} for one in result.uncounted],
        "residual": result.residual,
        "assumed": result.assumed,
    }


def _column_values(drive: Drive) -> tuple[float, float]:
    found = ask(drive)
    if found.locked:
        raise refuse("joints", _("friction in the journals reaches what turns them"))
    return (found.efficiency, found.heat)


COLUMNS = (
    SweepQuestion(
        name="losses",
        doc=mark("efficiency and heat at the speed and torque of the duty"),
        told=(
            OutputColumn.of("efficiency_percent", mark("efficiency")),
            OutputColumn.of("heat_W", mark("heat of the drive")),
        ),
        of_one=_column_values,
        counts=("pose", "movement", "case"),
    ),
)
"""What a sweep may ask of power loss."""
