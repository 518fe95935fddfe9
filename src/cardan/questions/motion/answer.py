"""What there is to say of the motion: how uniformly every shaft turns, in numbers and over the input angle."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Protocol

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table, Tone, heads
from cardan.answers.palette import colour
from cardan.answers.palette import shaft as shaft_role
from cardan.answers.quantity import Joined, Quantity, Say, say
from cardan.answers.question import Lacking
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.conditions import held_speeds
from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import given_chain, mixed, unlike_hooke
from cardan.later import later
from cardan.maths.arrays import Array, namespace
from cardan.maths.ties import foremost
from cardan.texts import _, mark, plural
from cardan.units import deg

from .equivalence import FLOOR, SYNCHRONOUS, EquivalentJoint, each_uniform, equivalent_joint, is_rounding
from .kinds import beside_turning, carried_on, steep_joints
from .motion import Motion, motion
from .standing import standing_chain
from .turning import Evenness, Swing, Turning
from .turning import turning as ask

drawn = later("cardan.questions.motion.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking", "over_movement", "sentence"]

ORDERS = 3
"""So many orders of the angle error are told: 2, 4, 6."""

NOISE = 1e-12
"""Accelerations below this share of a shaft's largest one are rounding and are shown as 0."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks: every drive moves."""
    return ()


def answer(drive: Drive, result: Turning) -> Answer:
    """Return what there is to say of the motion of a drive."""
    turn = () if result.listed is None else (_turn(result.listed, result),)
    return Answer(
        name="motion",
        title=_("Motion"),
        sentence=sentence(drive, result.each),
        tone="good" if is_rounding(drive, result.fluctuation) else "plain",
        figures=lambda: _figures(drive, result),
        tables=(_joints(drive), _shafts(drive, result), _orders_table(drive, result.each), *turn),
        remarks=tuple(_remarks(drive, result)),
        keys=tuple(_keys(drive, result)),
        facts=_facts(result),
        full=lambda: _trace(result.motion),
    )


def over_movement(drive: Drive) -> Callable[[Array], Array] | None:
    """Return the key figures of a moving drive as it stands at any instants; None where its joints have own laws.

    Returns a function of instants (t,) [s] to values (k, t), nan where it does not turn: speed fluctuation, that all
    others of the output grow with, and the joint angle nearest its limit.
    """
    if unlike_hooke(drive):
        return None
    steepest = np.asarray([one.steepest for one in drive.joints])

    def values(times: Array) -> Array:
        chain, possible = standing_chain(drive, times)
        joint_angle = chain.joint_angle if chain.laws is None else chain.laws.joint_angle
        place = np.argmax(joint_angle / steepest, axis=-1)[:, None]
        found = equivalent_joint(chain).speed_fluctuation, np.take_along_axis(joint_angle, place, axis=-1)[:, 0]
        return np.where(possible, np.stack(found), np.nan)

    return values


def sentence(drive: Drive, each: Evenness) -> Say:
    """Return in one sentence how uniformly a drive turns.

    drive: of joints of any kinds; each: as of `cardan.questions.motion.turning.each_shaft`.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.questions.motion.turning import each_shaft
    >>> drive = Drive.from_angles([12 * deg, 20 * deg])
    >>> sentence(drive, each_shaft(drive)).told(USUAL)
    '2 joints; equivalent joint angle 16.12°, speed fluctuation δ = 8.023 %.'
    """
    share = float(each.speed_fluctuation[-1])
    even, erring = is_rounding(drive, share), any(joint.error is not None for joint in drive.joints)
    alone = each_uniform(drive) or (even and len(drive.joints) == 1)
    text = _("{count}; equivalent joint angle {angle}, speed fluctuation δ = {share}.")
    if even and erring:
        text = _("{count}; by design the joints cancel each other: uniform but for the errors of its joints as made.")
        if alone:
            text = _("{count}; by design every joint turns uniformly; the errors of its joints as made remain.")
    elif alone:
        text = _("{count}; every joint turns uniformly by itself, and so does the output.")
    elif share < SYNCHRONOUS:
        text = _("{count}; synchronous: the joints cancel each other, and the output turns exactly uniformly.")
    elif even:
        text = _("{count}; synchronous but for the rounding of the figures that describe the drive, δ = {share}.")
    elif unlike_hooke(drive):
        text = _("{count}; speed fluctuation δ = {share}, as of one cross joint at {angle}.")
    elif len(drive.joints) == 1 and drive.joints[0].single_cross:
        text = _("one joint at a joint angle of {angle}, speed fluctuation δ = {share}.")
    if even and drive.movements:
        text = f"{text} {_('This concerns the drive as drawn, standing still.')}"
    return say(
        text,
        count=plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints)),
        angle=Quantity(float(each.joint_angle[-1]), "angle", decimals=2),
        share=Quantity(share, "share"),
    )


def _figures(drive: Drive, result: Turning) -> tuple[Any, ...]:
    figures = [drawn().motion_figure(result.motion)]
    if not unlike_hooke(drive) and not is_rounding(drive, result.fluctuation):
        whole = equivalent_joint(drive)
        figures += [drawn().speed_fluctuation_figure(whole), drawn().orders_figure(whole)]
    return tuple(figures)


def _joints(drive: Drive) -> Table:
    chain = given_chain(drive)
    start = np.rad2deg(motion(drive, [0.0]).yoke_rotation[:, 0])
    kinds = [Column(key="kind", heading=_("kind"), values=[joint.kind for joint in drive.joints])]
    return Table(
        name="joints",
        records=True,
        aside=True,  # the page of the drive as understood tells them too
        columns=(
            *heads(_("joint"), [joint.name for joint in drive.joints]),
            *(kinds if mixed(drive.joints) else ()),
            Column(
                key="joint_angle",
                heading=_("joint angle"),
                values=np.asarray(chain.joint_angle),
                dimension="angle",
                decimals=2,
            ),
            Column(
                key="plane_twist",
                heading=_("plane twist"),
                values=[None, *np.asarray(chain.plane_twist).tolist()],
                dimension="angle",
                decimals=2,
            ),
            Column(
                key="initial_yoke_position",
                heading=_("initial yoke position"),
                values=(90.0 - (90.0 - start) % 180.0) * deg,  # yokes are lines, not arrows
                dimension="angle",
                decimals=2,
            ),
        ),
    )


def _shafts(drive: Drive, result: Turning) -> Table:
    each, behind = result.each, drive.shafts[1:]
    last = len(drive.shafts)
    named = [shaft.name or (_("output") if shaft.number == last else "") for shaft in behind]
    still = [bool(share < SYNCHRONOUS) for share in each.speed_fluctuation]
    known = result.motion.speed is not None
    steep = _largest(result)
    places = [_places(float(share)) for share in each.speed_fluctuation]

    def ratios(values: Array) -> list[Quantity]:
        return [Quantity(float(one), decimals=most) for one, most in zip(values, places, strict=True)]

    def tidy(values: Array) -> list[float]:
        return [0.0 if even else float(one) for even, one in zip(still, values, strict=True)]

    return Table(
        name="shafts",
        records=True,
        columns=(
            Column(
                key="",
                heading=_("shaft"),
                values=[
                    Cell(value=f"{shaft.number} {name}".strip(), chip=colour(shaft_role(shaft.number)))
                    for shaft, name in zip(behind, named, strict=True)
                ],
            ),
            Column(key="number", values=[shaft.number for shaft in behind], depth="data"),
            Column(key="name", values=[shaft.name for shaft in behind], depth="data"),
            Column(
                key="yoke_angle",
                heading=_("yoke γ"),
                values=[None if shaft.number == last else shaft.yoke_angle for shaft in behind],
                dimension="angle",
                decimals=2,
            ),
            Column(key="speed_fluctuation", heading="δ", values=np.asarray(each.speed_fluctuation), dimension="share"),
            Column(key="ratio_min", heading=_("min ratio"), values=ratios(each.ratio_min)),
            Column(key="ratio_max", heading=_("max ratio"), values=ratios(each.ratio_max)),
            Column(key="", heading=_("angle error ±"), values=tidy(each.max_angle_error), dimension="angle", digits=4),
            Column(key="angle_error", values=np.asarray(each.max_angle_error), dimension="angle", depth="data"),
            Column(
                key="",
                heading=_("acceleration ±") if known else _("acceleration ±ε/ω₁²"),
                values=tidy(steep),
                dimension="angular_acceleration" if known else "",
            ),
            Column(
                key="max_acceleration" if known else "max_acceleration_per_speed_squared",
                values=steep,
                dimension="angular_acceleration" if known else "",
                depth="data",
            ),
        ),
        note=_("Extremes over a turn at uniform input, of the yoke angles γ described."),
    )


def _places(share: float) -> int:
    """Return with how many decimals the ratios of a shaft are told, so that least and greatest differ."""
    return 4 if share < SYNCHRONOUS else min(max(4, 1 - math.floor(math.log10(share))), 9)


def _orders(each: Evenness) -> list[tuple[int, float]]:
    """Return orders of the output's angle error with their amplitudes [1/turn, rad]."""
    if isinstance(each, Swing):
        return each.orders(ORDERS)
    return [(2 * k, float(wave)) for k, wave in enumerate(each.harmonics(ORDERS)[-1], start=1)]


def _orders_table(drive: Drive, each: Evenness) -> Table:
    found = _orders(each)
    return Table(
        name="orders",
        title=_("Largest orders of the output's angle error"),
        records=True,
        depth="full" if unlike_hooke(drive) else "data",
        columns=(
            Column(key="order", heading=_("order, times a turn"), values=[order for order, _wave in found]),
            Column(
                key="angle_error",
                heading=_("amplitude ±"),
                values=[wave for _order, wave in found],
                dimension="angle",
                digits=3,
            ),
            Column(key="ratio", values=[order * wave for order, wave in found], depth="data"),
        ),
    )


def _turn(listed: Motion, result: Turning) -> Table:
    """Return how the drive turns at the positions that people read one by one."""
    angle_error, ratio, steep = listed.angle_error[-1], listed.shaft_ratio, _accelerations(listed)[-1]
    most = _largest(result)[-1] if result.fluctuation >= SYNCHRONOUS else math.inf
    known = listed.speed is not None
    between = range(2, ratio.shape[-2])
    return Table(
        title=_("Over the input angle"),
        columns=(
            Column(key="angle", heading=_("input angle"), values=listed.angle, dimension="angle", digits=7, trim=True),
            Column(key="angle_error", heading=_("angle error"), values=angle_error, dimension="angle", decimals=3),
            Column(key="ratio", heading=_("ratio"), values=ratio[-1], decimals=4),
            Column(
                key="acceleration",
                heading=_("acceleration") if known else _("acceleration ε/ω₁²"),
                values=np.where(np.abs(steep) > NOISE * most, steep, 0.0),
                dimension="angular_acceleration" if known else "",
            ),
            *(
                Column(
                    key=f"shaft_{k}_ratio",
                    heading=_("ratio {number}").format(number=k),
                    values=ratio[k - 1],
                    decimals=4,
                )
                for k in between
            ),
        ),
        note=_("Ratio of the output and, with their numbers, of the shafts between.") if len(between) else "",
    )


def _trace(found: Motion) -> Table:
    """Return angle, ratio and acceleration of every shaft at every position."""
    known, steep = found.speed is not None, _accelerations(found)
    columns = [Column(key="angle", values=found.angle, dimension="angle")]
    for k in range(1, found.shaft_ratio.shape[-2]):
        name = f"shaft_{k + 1}"
        columns += [
            Column(key=f"{name}_angle", values=found.shaft_angle[k], dimension="angle"),
            Column(key=f"{name}_ratio", values=found.shaft_ratio[k]),
            Column(key=f"{name}_acceleration", values=steep[k], dimension="angular_acceleration")
            if known
            else Column(key=f"{name}_acceleration_per_speed_squared", values=steep[k]),
        ]
    return Table(name="motion", columns=columns)


def _accelerations(found: Motion) -> Array:
    return found.shaft_slope if found.speed is None else found.shaft_acceleration


def _largest(result: Turning) -> Array:
    """Return the largest acceleration of shafts 2 … n+1 at uniform input [rad/s²], over ω₁² without a speed."""
    speed = result.motion.speed
    return np.asarray(result.each.max_acceleration) * (1.0 if speed is None else float(speed) ** 2)


def _remarks(drive: Drive, result: Turning) -> Iterator[Remark]:
    each, speed = result.each, result.motion.speed
    even, alike = result.fluctuation < SYNCHRONOUS, not unlike_hooke(drive)
    if not even:
        text = _("Output angle error ±{error}.")
        if speed is not None:
            text = _("Output angle error ±{error}; at {speed} the angular acceleration reaches ±{steep}.")
        if alike:
            text = _("Output angle error ±{error}, 2nd order.")
            if speed is not None:
                text = _(
                    "Output angle error ±{error}, 2nd order; at {speed} the angular acceleration reaches ±{steep}."
                )
        yield Remark(
            text=say(
                text,
                error=Quantity(float(each.max_angle_error[-1]), "angle"),
                speed=Quantity(float(speed or 0.0), "angular_speed"),
                steep=Quantity(float(_largest(result)[-1]), "angular_acceleration"),
            )
        )
    if not even and any(wave > FLOOR * deg for _order, wave in _orders(each)):
        parts = [
            say(_("{order} with ±{size}"), order=order, size=Quantity(wave, "angle", 3))
            for order, wave in _orders(each)
            if wave > FLOOR * deg
        ]
        yield Remark(text=say(_("Orders of the angle error: {orders}."), orders=Joined(parts)), aside=True)
    if isinstance(each, EquivalentJoint) and not is_rounding(drive, result.fluctuation):
        text = _("At the start the driving yoke of the equivalent joint stands {angle} from the plane of that joint.")
        angle = Quantity(float(equivalent_joint(drive).phase), "angle", decimals=2)
        yield Remark(text=say(text, angle=angle), depth="full", aside=True)
    yield from (Remark(text=text) for text in beside_turning(drive))
    yield from carried_on(drive)
    yield from steep_joints(drive)
    if not even and speed is None:
        yield Remark(text=_("--speed-rpm gives angular accelerations in rad/s²."), tone="next")
    if is_rounding(drive, result.fluctuation):
        yield Remark(text=_("The whole drive on one page:"), command=("cardan", "report", FILE), tone="next")
    elif len(drive.joints) == 1:
        if drive.joints[0].single_cross:
            text = _("A single joint always fluctuates; a second one at the same joint angle can cancel it.")
            yield Remark(text=text, tone="next")
    elif alike:
        text = _("Find the yoke angles that leave the least fluctuation:")
        yield Remark(text=text, command=("cardan", "phasing", FILE), tone="next")


def _keys(drive: Drive, result: Turning) -> Iterator[KeyFigure]:
    each, speed, even = result.each, result.motion.speed, result.fluctuation < SYNCHRONOUS
    share, allowed = result.fluctuation, drive.limits.speed_fluctuation
    joint_angle = np.asarray(given_chain(drive).joint_angle)
    joint = int(foremost(joint_angle / [one.steepest for one in drive.joints]))
    tone: Tone = "plain" if allowed is None else "good" if share <= allowed else "failed"
    yield KeyFigure(
        name="speed_fluctuation",
        title=_("speed fluctuation δ of the output"),
        value=Quantity(share, "share"),
        limit=None if allowed is None else Quantity(allowed, "share", trim=True),
        verdict={"plain": "", "good": _("passed"), "failed": _("too much")}[tone],
        tone=tone,
        check="speed_fluctuation",
    )
    angles = {
        "equivalent_joint_angle": (_("equivalent joint angle of the drive"), each.joint_angle, ""),
        "angle_error": (_("angle error of the output, ±"), each.max_angle_error, "output_error"),
    }
    for name, (title, values, check) in angles.items():
        angle = Quantity(0.0 if even else float(values[-1]), "angle")
        yield KeyFigure(name=name, title=title, value=angle, check=check)
    steep = 0.0 if even else float(_largest(result)[-1])
    if speed is None and not held_speeds(drive.duty):
        title = _("largest acceleration of the output over ω₁²")
        yield KeyFigure(name="relative_acceleration", title=title, value=Quantity(steep))
    elif speed is not None:
        yield KeyFigure(
            name="acceleration",
            title=_("largest acceleration of the output"),
            place=say(_("at {speed}"), speed=Quantity(abs(float(speed)), "angular_speed")),
            value=Quantity(steep, "angular_acceleration"),
            check="acceleration",
        )
    place = say(_("joint {number}"), number=joint + 1)
    value = Quantity(float(joint_angle[joint]), "angle")
    yield KeyFigure(name="joint_angle", title=_("largest joint angle"), place=place, value=value)


def _facts(result: Turning) -> dict[str, Any]:
    each, speed = result.each, result.motion.speed
    return {
        "speed": Quantity(None if speed is None else float(speed), "angular_speed"),
        "synchronous": result.fluctuation < SYNCHRONOUS,
        "speed_fluctuation": Quantity(result.fluctuation, "share"),
        "equivalent_joint_angle": Quantity(float(each.joint_angle[-1]), "angle"),
        "ratio_min": float(each.ratio_min[-1]),
        "ratio_max": float(each.ratio_max[-1]),
        "angle_error": Quantity(float(each.max_angle_error[-1]), "angle"),
        "max_acceleration_per_speed_squared": float(each.max_acceleration[-1]),
    }


class Motions(Protocol):
    """What the motion of many drives is asked, arrays (n, ...) in SI; see `cardan.batch.answering.many.Many`."""

    @property
    def joint_angle(self) -> Array:
        """Angles of the joints (n, joints)."""

    @property
    def speed(self) -> Array | float:
        """Speed of the input (n,)."""

    @property
    def output(self) -> Evenness:
        """How evenly the output turns (n,)."""

    @property
    def each(self) -> Evenness:
        """How evenly the shafts that joints drive turn (n, joints)."""

    @property
    def lengths(self) -> Array:
        """Lengths of the shafts between two joints (n, joints - 1)."""

    @property
    def swings(self) -> Array:
        """Largest accelerations over the square of the speed: output, drive, coast (n, 1 or 3)."""


def _inside(drive: Drive) -> tuple[OutputColumn, ...]:
    output = OutputColumn.of("output_acceleration_rad_s2", mark("largest angular acceleration of the output"))
    if len(drive.joints) == 1:
        return (output,)
    return (
        output,
        OutputColumn.of(
            "drive_acceleration_rad_s2",
            mark("largest angular acceleration of intermediate shafts, the input turning uniformly"),
        ),
        OutputColumn.of(
            "coast_acceleration_rad_s2",
            mark("largest angular acceleration of intermediate shafts, the output turning uniformly"),
        ),
    )


def _norms(found: Motions) -> Sequence[Array]:
    return [found.speed**2 * one for one in _each(found.swings)]


def _each(values: Array) -> list[Array]:
    return [values[..., k] for k in range(values.shape[-1])]


COLUMNS = (
    SweepQuestion(
        name="speed_fluctuation",
        doc=mark("speed fluctuation δ of the output: largest less smallest speed ratio"),
        told=(OutputColumn.of("speed_fluctuation_percent", mark("speed fluctuation of the output")),),
        of_many=lambda found: (found.output.speed_fluctuation,),
    ),
    SweepQuestion(
        name="alpha_eq",
        doc=mark("equivalent joint angle: that of the single Hooke joint with the speed fluctuation of the drive"),
        told=(OutputColumn.of("alpha_eq_deg", mark("equivalent angle")),),
        of_many=lambda found: (found.output.joint_angle,),
    ),
    SweepQuestion(
        name="ratio",
        doc=mark("smallest and largest speed ratio of the drive over a turn"),
        told=(
            OutputColumn(name="ratio_min", text=mark("smallest speed ratio")),
            OutputColumn(name="ratio_max", text=mark("largest speed ratio")),
        ),
        of_many=lambda found: (found.output.ratio_min, found.output.ratio_max),
    ),
    SweepQuestion(
        name="angle_error",
        doc=mark("how far the output leads the input at most, about its mean"),
        told=(OutputColumn.of("angle_error_deg", mark("largest lead of the output")),),
        of_many=lambda found: (found.output.max_angle_error,),
    ),
    SweepQuestion(
        name="acceleration",
        doc=mark("largest angular accelerations at the speed of the duty: of the output and of the shafts inside"),
        told=_inside,
        of_many=_norms,
        needs_speed=True,
    ),
    SweepQuestion(
        name="shaft_speed_fluctuation",
        doc=mark("speed fluctuation of every shaft that a joint drives"),
        told=lambda drive: tuple(
            OutputColumn.of(f"shaft_speed_fluctuation_percent[{k}]", mark("speed fluctuation of a shaft"))
            for k in range(1, len(drive.joints) + 1)
        ),
        of_many=lambda found: _each(found.each.speed_fluctuation),
    ),
    SweepQuestion(
        name="joint_angle",
        doc=mark("joint angle of every joint"),
        told=lambda drive: tuple(
            OutputColumn.of(f"joint_angle_deg[{i}]", mark("joint angle of a joint")) for i in range(len(drive.joints))
        ),
        of_many=lambda found: _each(found.joint_angle),
    ),
    SweepQuestion(
        name="greatest_joint_angle",
        doc=mark("largest joint angle"),
        told=(OutputColumn.of("greatest_joint_angle_deg", mark("greatest joint angle of a joint")),),
        of_many=lambda found: (namespace(found.joint_angle).max(found.joint_angle, axis=-1),),
    ),
    SweepQuestion(
        name="length",
        doc=mark("length of every shaft between two joints, of drives given by joint centres"),
        told=lambda drive: tuple(
            OutputColumn.of(f"length_mm[{k}]", mark("length of a shaft")) for k in range(1, len(drive.joints))
        ),
        of_many=lambda found: _each(found.lengths),
        needs_centres=True,
    ),
)
"""What a sweep may ask of motion."""
