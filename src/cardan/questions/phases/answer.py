"""What there is to say of the phasing of the yokes: settings to choose from, what each leaves, and why no less."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.palette import colour
from cardan.answers.palette import shaft as shaft_role
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.answers.question import Lacking
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import given_chain, mixed, unmapped
from cardan.drive.models.wobble import wobbling
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.motion.equivalence import SYNCHRONOUS, closure, each_uniform, is_rounding
from cardan.questions.motion.kinds import steep_joints
from cardan.texts import _, mark, plural
from cardan.units import deg

from .phases import Phasing
from .phases import phases as ask
from .setting import YokeSetting
from .steering import SteeringColumn

drawn = later("cardan.questions.phases.figures")

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

CALM = 1e-3
"""Speed fluctuation below which a drive is called nearly uniform: some tenth of what one joint of 5° does."""

UTMOST = 1e-9
"""Changes of the speed fluctuation smaller than this help nobody."""

WIDEST = 7
"""With more yokes than this the table of settings is turned: shafts downwards."""

WORTH = 2e-4
"""A setting that turns no yoke by more than this [rad] is not worth writing."""

PITCHED = 3
"""So many settings of spline teeth are shown; JSON and CSV hold all."""

LITTLE = 0.01
"""A speed fluctuation below which what the yokes leave is called little."""

LEVEL = 5e-5
"""Speed ratios of a steering column that differ by less than this are told as the same."""

POLYGON = "polygon"  # figure of the yokes, and code of the remarks about it
SIDES = 8
"""So many sides of the phase polygon are told."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks: nothing."""
    return ()


def answer(drive: Drive, result: Phasing, *, fixed: Mapping[int, float] | None = None, nearest: bool = False) -> Answer:
    """Return what there is to say of the phasing of the yokes of a drive.

    drive: the drive as it stands in the file; result: what its yoke angles can do.
    fixed: what was held beside the file: shaft number -> yoke angle [rad].
    nearest: whether the goal was the least change of the present yokes.
    """
    shown = (result.as_built, *result.settings, *result.spline_settings[:PITCHED], *result.pose_settings)
    shown += tuple(one.setting for one in result.steering[1:])
    several = len(drive.joints) > 1
    return Answer(
        name="phasing",
        title=_("Phasing of the yokes"),
        sentence=_sentence(drive, result),
        tone="good" if is_uniform(drive, result.as_built.speed_fluctuation) else "plain",
        figures=lambda: drawn().phasing_figures(result),
        tables=(
            *((settings_table(drive, shown),) if several else ()),
            *((_poses(result, shown),) if result.poses else ()),
            *((_costs(drive, result),) if several and result.settings else ()),
            *((_steering(result),) if result.steering else ()),
        ),
        remarks=tuple(_remarks(drive, result, fixed or {}, nearest)),
        keys=tuple(_keys(drive, result)),
        facts=_facts(drive, result),
        full=lambda: _everything(drive, result),
        code=0 if result.complete else 1,
    )


def indifferent(found: Phasing) -> bool:
    """Tell whether the yokes of a drive that was followed, all free, change nothing."""
    every = bool(found.free) and len(found.free) == len(found.as_built.yoke_angle)
    return found.followed and every and found.speed_fluctuation_max - found.speed_fluctuation_min <= UTMOST


def is_uniform(drive: Drive, share: float) -> bool:
    """Tell whether a speed fluctuation of a drive is none, or only the rounding of its figures."""
    return share < SYNCHRONOUS or is_rounding(drive, share)


def every_setting(found: Phasing) -> tuple[YokeSetting, ...]:
    """Return all settings of an answer, the one as specified first."""
    steered = (one.setting for one in found.steering[1:])
    return (found.as_built, *found.settings, *found.spline_settings, *found.pose_settings, *steered)


def advised(found: Phasing) -> tuple[YokeSetting, ...]:
    """Return the settings worth writing into the file, the first choice first."""
    return (*(one.setting for one in found.steering[1:]), *found.pose_settings, *found.settings)


def _sentence(drive: Drive, found: Phasing) -> Say:
    now, least = found.as_built.speed_fluctuation, found.speed_fluctuation_min
    erring = any(joint.error is not None for joint in drive.joints)
    if len(drive.joints) == 1:
        text = _("one joint, speed fluctuation δ = {now}; a single joint has no yokes to phase.")
    elif erring and is_uniform(drive, now):
        text = _("{count}; the yokes are phased right, uniform but for the errors of its joints as made.")
    elif erring and found.feasible:
        text = _(
            "{count}; speed fluctuation δ = {now} as specified, with other yoke angles uniform but for the errors of "
            "its joints as made."
        )
    elif each_uniform(drive):
        text = _("{count}; every joint turns uniformly by itself, the yokes may stand anyhow.")
        elsewhere = drive.movements or drive.poses
        if elsewhere and not all(joint.even for joint in drive.joints):
            text = _(
                "{count}; as drawn every joint turns uniformly by itself, the yokes count where joint angles differ."
            )
    elif now < SYNCHRONOUS:
        text = _("{count}; the yokes are phased right, the output is exactly uniform as specified.")
    elif is_rounding(drive, now):
        text = _("{count}; the yokes are phased right, uniform but for the rounding of its figures: δ = {now}.")
    elif indifferent(found):
        text = _("{count}; speed fluctuation δ = {now}, however the yokes stand.")
    elif found.feasible:
        text = _("{count}; speed fluctuation δ = {now} as specified, exactly uniform with other yoke angles.")
    elif is_rounding(drive, least):
        text = _("{count}; speed fluctuation δ = {now} as specified, with other yoke angles uniform but for rounding.")
    elif not found.free and np.max(np.abs(found.settings[0].change)) < 1e-9:
        text = _("{count}; speed fluctuation δ = {now}, no yokes to set.")
    elif not found.free:
        text = _("{count}; speed fluctuation δ = {now} as specified, {least} with the yokes held.")
    elif found.followed:
        text = _("{count}; speed fluctuation δ = {now} as specified; the best yoke angles found leave {least}.")
    else:
        text = _("{count}; speed fluctuation δ = {now} as specified; no yoke angles leave less than {least}.")
    return say(text, count=_count(drive), now=Quantity(now, "share"), least=Quantity(least, "share"))


def _count(drive: Drive) -> str:
    return plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints))


def settings_table(drive: Drive, shown: Sequence[YokeSetting]) -> Table:
    """Return yoke angles and what they leave, row by row, or column by column where there are many shafts."""
    numbers = range(2, len(drive.joints) + 1)
    title = _("Yoke angles γ, and the speed fluctuation δ that they leave")
    tones = ["good" if one.speed_fluctuation < SYNCHRONOUS else "plain" for one in shown]
    if len(numbers) <= WIDEST:
        return Table(
            title=title,
            columns=(
                Column(key="setting", heading=_("setting"), values=[one.label for one in shown]),
                *(
                    Column(
                        key=f"shaft_{k}",
                        heading=_("shaft {number}").format(number=k),
                        values=[float(one.yoke_angle[k - 2]) for one in shown],
                        dimension="angle",
                        decimals=2,
                    )
                    for k in numbers
                ),
                Column(
                    key="speed_fluctuation",
                    heading="δ",
                    values=[
                        Cell(value=float(one.speed_fluctuation), tone=tone)  # type: ignore[arg-type]
                        for one, tone in zip(shown, tones, strict=True)
                    ],
                    dimension="share",
                ),
                Column(
                    key="worst_shaft",
                    heading=_("worst shaft between"),
                    values=[float(np.max(one.shaft_speed_fluctuation[:-1])) for one in shown],
                    dimension="share",
                    depth="full",
                ),
            ),
        )
    return Table(
        title=title,
        columns=(
            Column(key="shaft", heading=_("yoke of shaft"), values=[*map(str, numbers), "δ"], left=True),
            *(
                Column(
                    key=one.label,
                    heading=one.label,
                    values=[*one.yoke_angle.tolist(), Quantity(one.speed_fluctuation, "share")],
                    dimension="angle",
                    decimals=2,
                )
                for one in shown
            ),
        ),
    )


def _steps(found: Phasing) -> str:
    """Return between how many places the teeth of splines let yokes be set."""
    steps = ", ".join(
        _("{steps} places on shaft {number}").format(steps=steps, number=number)
        for number, steps in found.spline_steps.items()
    )
    return _("Spline teeth allow {steps}; all of them were looked at.").format(steps=steps)


def _poses(found: Phasing, shown: Sequence[YokeSetting]) -> Table:
    some = [one for one in shown if len(one.pose_speed_fluctuation) == len(found.poses)]
    return Table(
        title=_("Speed fluctuation δ in each pose"),
        columns=(
            Column(key="setting", heading=_("setting"), values=[one.label for one in some]),
            *(
                Column(
                    key=name,
                    heading=f"{k} {name}" if len(name) <= 20 else f"{k} {name[:19]}…",
                    values=[float(one.pose_speed_fluctuation[k - 1]) for one in some],
                    dimension="share",
                )
                for k, name in enumerate(found.poses, 1)
            ),
        ),
    )


def _costs(drive: Drive, found: Phasing) -> Table:
    some = [found.as_built, *found.settings[:3]]
    note = _("In the pose where it grows most.") if found.poses else ""
    if drive.movements and not found.poses:
        note = _("This concerns the drive as drawn, standing still.")
    return Table(
        title=_("Growth of δ when one yoke stands one degree off"),
        depth="full",
        columns=(
            Column(
                key="shaft",
                heading=_("shaft"),
                values=[Cell(value=str(k), chip=colour(shaft_role(k))) for k in range(2, len(drive.joints) + 1)],
            ),
            *(
                Column(
                    key=one.label,
                    heading=one.label,
                    values=noiseless(one.one_off, found.reach),
                    dimension="share",
                    digits=3,
                )
                for one in some
            ),
        ),
        note=note,
    )


def _everything(drive: Drive, found: Phasing) -> Table:
    every, n = every_setting(found), len(drive.joints)

    def column(key: str, values: Iterable[Any], dimension: str = "share") -> Column:
        return Column(key=key, values=list(values), dimension=dimension)

    between = range(2, n + 1)
    return Table(
        columns=(
            Column(key="setting", values=[one.label for one in every]),
            column("speed_fluctuation", (float(one.speed_fluctuation) for one in every)),
            *(
                column(f"shaft_{k}_yoke_angle", (float(one.yoke_angle[k - 2]) for one in every), "angle")
                for k in between
            ),
            *(column(f"shaft_{k}_change", (float(one.change[k - 2]) for one in every), "angle") for k in between),
            *(
                column(f"shaft_{k}_speed_fluctuation", (float(one.shaft_speed_fluctuation[k - 2]) for one in every))
                for k in range(2, n + 2)
            ),
            *(
                column(f"pose_{name}_speed_fluctuation", (float(one.pose_speed_fluctuation[k]) for one in every))
                for k, name in enumerate(found.poses)
            ),
        )
    )


def _remarks(drive: Drive, found: Phasing, fixed: Mapping[int, float], nearest: bool) -> Iterator[Remark]:
    if not found.complete:
        text = _("Warning: the search was stopped; these are the best settings so far.")
        yield Remark(text=text, tone="warning")
    yield from (Remark(text=one, code=POLYGON, depth="full", aside=True) for one in proof(drive, found))
    if not found.feasible and not wants_fluctuation(drive):
        yield from _limits(drive, found)
    if meaning := letters(found, nearest=nearest):
        yield Remark(text=meaning)
    yield from spread(found)
    if found.spline_steps:
        yield Remark(text=_steps(found), depth="full")
    if found.poses:
        text = _("δ beside the yoke angles is that of the drive as drawn; the poses have a table of their own.")
        yield Remark(text=text, depth="full")
    felt = wobbling(drive)
    if felt and found.free and not indifferent(found):
        text = plural(
            "A shaft wobbles behind joint {which}: the yokes were sought with what later joints make of it, without "
            "proof that none are better.",
            "Shafts wobble behind joints {which}: the yokes were sought with what later joints make of it, without "
            "proof that none are better.",
            len(felt),
        )
        yield Remark(text=say(text, which=Joined([str(i + 1) for i in felt], last=_(" and "))))
    elif found.followed and not felt:
        text = _(
            "Some joints turn by laws of their own: the yokes were sought by these, without proof that none are better."
        )
        yield Remark(text=text)
    elif unmapped(drive.joints) and not found.followed:
        text = _("What joints leave by laws of their own, below {most}, is not in these figures.")
        yield Remark(text=say(text, most=Quantity(1e-6, "angle", 1, unit="rad")))
    if found.spline_refusal:
        yield Remark(text=_("Warning: splines: {reason}.").format(reason=found.spline_refusal), tone="warning")
    yield from steep_joints(drive)
    yield from steers(drive, found)
    writable = advised(found)
    if writable and turns(drive, writable[0]) > WORTH:
        text = _("Write setting {label} into a copy of the file:").format(label=writable[0].label)
        parts = command(fixed, "--apply", writable[0].label, "-o", "better.toml", nearest=nearest)
        yield Remark(text=text, command=parts, tone="next")


def wants_fluctuation(drive: Drive) -> bool:
    """Tell whether a drive is a steering column whose ratio straight ahead is to be another than elsewhere."""
    return drive.steering is not None and drive.steering.centre_ratio != 1.0


def turns(drive: Drive, one: YokeSetting) -> float:
    """Return by how much a setting turns the yoke that it turns most, that of the input among them [rad]."""
    first = 0.0 if one.start_phase is None else abs(math.sin(one.start_phase - drive.input.start_phase))
    return max(first, float(np.max(np.abs(one.change), initial=0.0)))


def _steering(found: Phasing) -> Table:
    """Return how a steering column hands on the turn of its wheel in each setting."""
    every = found.steering

    def ratios(key: str, heading: str, values: Iterable[float]) -> Column:
        return Column(key=key, heading=heading, values=list(values), decimals=4)

    phases = [one.setting.start_phase for one in every[1:]]
    return Table(
        name="steering",
        title=_("As a steering column: speed ratio of output to wheel, from lock to lock"),
        records=True,
        columns=(
            Column(key="setting", heading=_("setting"), values=[one.setting.label for one in every]),
            Column(
                key="start_phase",
                heading=_("first yoke ψ₁"),
                values=[float(found.as_built.initial_phase[0]), *phases],
                dimension="angle",
                decimals=2,
            ),
            ratios("centre_ratio", _("straight ahead"), (one.centre_ratio for one in every)),
            ratios("least_ratio", _("least"), (one.least for one in every)),
            ratios("greatest_ratio", _("greatest"), (one.greatest for one in every)),
            ratios("asymmetry", _("left less right, up to"), (one.asymmetry for one in every)),
            Column(
                key="torque_ripple", heading=_("torque ripple"), values=[one.ripple for one in every], dimension="share"
            ),
            *(
                column
                for k, name in enumerate(found.poses)
                for column in (
                    ratios(
                        f"pose_{name}_centre_ratio",
                        _("straight ahead, {pose}").format(pose=name),
                        (float(one.pose_centre_ratio[k]) for one in every),
                    ),
                    ratios(
                        f"pose_{name}_asymmetry",
                        _("left less right, {pose}").format(pose=name),
                        (float(one.pose_asymmetry[k]) for one in every),
                    ),
                )
            ),
        ),
        note=_(
            "Torque ripple: of the torque at the wheel, peak to peak, under a steady one at the output; no friction."
        ),
    )


def steers(drive: Drive, found: Phasing) -> Iterator[Remark]:
    """Yield what a steering column does as specified, what the best setting makes of it, and what stands in the way."""
    if drive.steering is None or len(found.steering) < 2:
        return
    now, best = found.steering[:2]
    torque = drive.duty.torque

    def ripple(one: SteeringColumn) -> Text:
        share = Quantity(one.ripple, "share", 3)
        return (
            share if torque is None else say("{share}, {torque}", share=share, torque=_newton(one.ripple * abs(torque)))
        )

    wanted = Quantity(drive.steering.centre_ratio, decimals=4)
    text = _(
        "As a steering column: straight ahead the speed ratio is {now}, wanted is {wanted}; to the left and to the "
        "right it differs by up to {asymmetry}; the torque at the wheel ripples by {ripple}."
    )
    if now.asymmetry < LEVEL:
        text = _(
            "As a steering column: straight ahead the speed ratio is {now}, wanted is {wanted}; it is the same to the "
            "left and to the right; the torque at the wheel ripples by {ripple}."
        )
    values = {"now": Quantity(now.centre_ratio, decimals=4), "wanted": wanted, "ripple": ripple(now)}
    as_wanted = now.asymmetry < LEVEL and abs(now.centre_ratio - drive.steering.centre_ratio) < LEVEL
    said = say(text, **values, asymmetry=Quantity(now.asymmetry, decimals=4))
    yield Remark(text=said, tone="good" if as_wanted else "plain")
    if as_wanted:
        return
    text = _(
        "Setting {label}, with the first yoke at ψ₁ = {phase} straight ahead: {best} there, the same to both locks; "
        "the torque at the wheel ripples by {ripple}."
    )
    phase = Quantity(best.setting.start_phase or 0.0, "angle", decimals=2)
    there = Quantity(best.centre_ratio, decimals=4)
    yield Remark(text=say(text, label=best.setting.label, phase=phase, best=there, ripple=ripple(best)))
    if abs(best.centre_ratio - drive.steering.centre_ratio) > LEVEL:
        text = _("The ratio wanted straight ahead, {wanted}, is beyond what the yokes reach: {best} is the nearest.")
        if drive.steering.centre_ratio == 1.0:
            text = _(
                "The yokes do not make the drive uniform, and a ratio of 1 straight ahead cannot be symmetric then: "
                "{best} is the nearest."
            )
        yield Remark(text=say(text, wanted=wanted, best=there), tone="warning")


def _newton(torque: float) -> Quantity:
    return Quantity(torque, "torque", 3)


def command(fixed: Mapping[int, float], *more: str, nearest: bool) -> tuple[str, ...]:
    """Return the command that asks the same again, and more."""
    fixes = [part for k, angle in fixed.items() for part in ("--fix", f"{k}={math.degrees(angle):.12g}")]
    return ("cardan", "phasing", FILE, *fixes, *(["--goal", "nearest"] if nearest else []), *more)


def proof(drive: Drive, found: Phasing) -> list[Text]:
    """Return what the sides of the phase polygon say of a drive, sentence by sentence."""
    if found.followed:
        return []
    if each_uniform(drive):
        said = [
            _("Every joint turns uniformly by itself, straight or of constant velocity: there is nothing to cancel.")
        ]
        return [*said, _("This concerns the drive as drawn, standing still.")] if drive.movements else [*said]
    seen = closure(drive)
    longest = float(np.max(seen.length))
    places = min(max(4, 2 - math.floor(math.log10(longest))), 12) if longest > 0.0 else 4
    sides: list[Text] = [Quantity(float(value), decimals=places) for value in seen.length[:SIDES]]
    if len(drive.joints) > SIDES:
        sides.append("…")
    texts = [_("Every joint is a side of length L = −ln cos α, here {sides}.")]
    values: dict[str, Any] = {
        "sides": Joined(sides),
        "longest": seen.longest,
        "long": Quantity(float(seen.length[seen.longest - 1]), decimals=places),
        "others": Quantity(seen.others, decimals=places),
        "low": Quantity(found.speed_fluctuation_min, "share", 3),
        "high": Quantity(found.speed_fluctuation_max, "share", 3),
        "angle": Quantity(seen.joint_angle_allowed, "angle", decimals=2),
        "held": ", ".join(map(str, found.fixed)),
    }
    if len(drive.joints) == 1:
        texts.append(_("One side never comes back to its start."))
    elif found.fixed:
        texts.append(_("The yokes of shaft {held} are held, so the joints at their ends count as one."))
        texts.append(_("The free yokes reach every fluctuation from {low:bare} to {high}."))
    else:
        texts += [_("The yoke angles are the corners."), _closing(drive, found, closes=seen.closes)]
        if not seen.closes and not is_rounding(drive, found.speed_fluctuation_min):
            allowed = _("It could be closed if that joint had a joint angle of {angle}.")
            if not drive.joints[seen.longest - 1].single_cross:
                allowed = _("It could be closed if the Hooke joint that turns like that joint had an angle of {angle}.")
            texts.append(allowed)
    if mixed(drive.joints):
        texts.append(_("α is the angle of the Hooke joint that turns alike."))
    return [say(text, **values) for text in texts]


def _closing(drive: Drive, found: Phasing, *, closes: bool) -> str:
    """Return whether the longest side is too long for the others."""
    if closes:
        return _(
            "The longest side, joint {longest} with {long}, is no longer than the others together, {others}: the path "
            "can be closed, exactly and for all harmonics at once."
        )
    if is_rounding(drive, found.speed_fluctuation_min):
        return _(
            "The longest side, joint {longest}, is as long as the others together but for the rounding of the figures "
            "that describe the drive: what it leaves, {low}, is not a fluctuation of the design."
        )
    return _(
        "The longest side, joint {longest} with {long}, is longer than the others together, {others}: no yoke angles "
        "can close the path."
    )


def _limits(drive: Drive, found: Phasing) -> Iterator[Remark]:
    """Yield why no yoke angles make the drive uniform, and what would."""
    if len(drive.joints) == 1:
        if drive.joints[0].single_cross:
            alone = _("A single joint always fluctuates; a second one at the same joint angle can cancel it.")
            yield Remark(text=alone, tone="next")
        return
    if found.limiting_joint is None or not found.free or is_rounding(drive, found.speed_fluctuation_min):
        return
    joint_angle = float(given_chain(drive).joint_angle[found.limiting_joint - 1])
    if len(found.limiting_joints) > 1:
        text: Text = say(
            _(
                "Joints {tied}, tied by held yokes, act as one whose joint angle is too large for the others; free a "
                "yoke, or reduce the angle of joint {number}, {angle}."
            ),
            tied=", ".join(str(k) for k in found.limiting_joints),
            number=found.limiting_joint,
            angle=Quantity(joint_angle, "angle", decimals=2),
        )
    else:
        text = excess(found, len(drive.joints), joint_angle, plain=drive.joints[found.limiting_joint - 1].single_cross)
    yield Remark(text=text, tone="plain" if found.speed_fluctuation_min < LITTLE else "warning")


def excess(found: Phasing, joints: int, joint_angle: float, *, plain: bool = True) -> Text:
    """Return in one sentence which joint keeps a drive from being uniform, and at what joint angle it would not.

    found: what the yokes can do; a single joint fluctuates more than the others can undo.
    joint_angle [rad].
    plain: whether it is a Hooke joint; of another kind no angle is named.
    The side L = -ln cos α of that joint is asinh(δ/2) too long.
    """
    left = Quantity(found.speed_fluctuation_min, "share", 3)
    if not plain:
        text = _("Joint {number} fluctuates more than the others can undo; what remains is {left}.")
        return say(text, number=found.limiting_joint, left=left)
    spare = math.asinh(0.5 * found.speed_fluctuation_min)
    closing = math.acos(min(1.0, math.cos(joint_angle) * math.exp(spare)))
    decimals = next((d for d in (2, 3, 4, 5) if round(closing / deg, d) != round(joint_angle / deg, d)), 6)
    text = plural(
        "The angle of joint {number} is too large for the other one: at {closing} instead of {now} the drive could be "
        "uniform; what remains is {left}.",
        "The angle of joint {number} is too large for the others: at {closing} instead of {now} the drive could be "
        "uniform; what remains is {left}.",
        joints - 1,
    )
    if found.speed_fluctuation_min < LITTLE:
        text = plural(
            "The angle of joint {number} is a little too large for the other one: at {closing} instead of {now} the "
            "drive could be uniform; what remains is {left}.",
            "The angle of joint {number} is a little too large for the others: at {closing} instead of {now} the drive "
            "could be uniform; what remains is {left}.",
            joints - 1,
        )
    return say(
        text,
        number=found.limiting_joint,
        closing=Quantity(closing, "angle", decimals=decimals),
        now=Quantity(joint_angle, "angle", decimals=decimals),
        left=left,
    )


def letters(found: Phasing, *, nearest: bool = False) -> str:
    """Return what the letters of the settings stand for, "" where there is no choice.

    found: settings, best first.
    nearest: whether the goal was the least change of the present yokes instead of the most uniform intermediate shafts.
    """
    if not found.feasible or len(found.settings) < 2:
        return ""
    if len(found.free) < 3:
        return _("A and B are mirror images; both are exact.")
    if len(found.settings) == 2:
        return _("A is the best by the goal; B is exact as well.")
    if nearest:
        return _(
            "A is nearest to the present yokes, B its mirror image; C leaves the intermediate shafts the least "
            "fluctuation."
        )
    return _(
        "A leaves the intermediate shafts the least fluctuation, B is its mirror image; C is nearest to the present "
        "yokes."
    )


def noiseless(slope: Iterable[float], largest: float) -> list[float]:
    """Return slopes of the speed fluctuation with 0 for those that are nothing but rounding.

    slope: at a minimum the slope is 0 only to the rounding of the yoke angles.
    largest: largest fluctuation that turning the yokes can make; no slope is much greater.

    >>> noiseless([0.01, 8e-9], 0.2)
    [0.01, 0.0]
    """
    return [float(one) if abs(one) > 1e-6 * largest else 0.0 for one in slope]


def spread(found: Phasing) -> Iterator[Remark]:
    """Yield what an error of the yokes costs, or what the free yokes reach."""
    if not found.settings or not found.free or indifferent(found):
        return
    if not found.feasible:
        text = _("The free yokes reach every speed fluctuation from {low:bare} to {high}.")
        low, high = Quantity(found.speed_fluctuation_min, "share"), Quantity(found.speed_fluctuation_max, "share")
        yield Remark(text=say(text, low=low, high=high))
        return
    numbers = sorted((*found.free, *found.fixed))
    costs = noiseless(found.settings[0].one_off, found.reach)
    each = [costs[k - 2] for k in numbers]
    if len(numbers) > WIDEST:
        worst = numbers[each.index(max(each))]
        text = _("A yoke 1° off adds at most {cost} to δ, on shaft {shaft}.")
        yield Remark(text=say(text, cost=Quantity(max(each), "share", 2), shaft=worst))
        return
    text = _("A yoke 1° off adds {costs} to δ on shaft {shafts}.")
    parts = [Quantity(cost, "share", 2) for cost in each]
    yield Remark(text=say(text, costs=Joined(parts, between=" / "), shafts=" / ".join(map(str, numbers))))


def _keys(drive: Drive, found: Phasing) -> Iterator[KeyFigure]:
    verdict, tone = _uniformity(drive, found)
    title, share = _("speed fluctuation δ of the output"), float(found.as_built.speed_fluctuation)
    drawn, value = _("as drawn") if drive.movements or drive.poses else "", Quantity(share, "share")
    yield KeyFigure(
        name="speed_fluctuation",
        title=title,
        place=drawn,
        value=value,
        verdict=verdict,
        tone=tone,
        check="speed_fluctuation",
    )
    posed = found.as_built.pose_speed_fluctuation
    if posed.size and float(np.max(posed)) > share + UTMOST:
        place = say(_("in the pose {name}"), name=found.poses[int(foremost(posed))])
        value = Quantity(float(np.max(posed)), "share")
        yield KeyFigure(
            name="pose_speed_fluctuation", title=title, place=place, value=value, repeats="speed_fluctuation"
        )
    for one in found.steering[:1]:
        ripple = Quantity(one.ripple, "share")
        yield KeyFigure(name="torque_ripple", title=_("torque ripple at the steering wheel"), value=ripple)
        difference = Quantity(one.asymmetry, decimals=4)
        title = _("difference of the steering ratio between left and right")
        yield KeyFigure(name="steering_asymmetry", title=title, value=difference)


def _uniformity(drive: Drive, found: Phasing) -> tuple[str, Tone]:
    """Return verdict and tone of the speed fluctuation."""
    share = float(found.as_built.speed_fluctuation)
    length = None if found.followed else closure(drive).length
    if is_uniform(drive, share) and any(joint.error is not None for joint in drive.joints):
        return _("uniform but for the errors as made"), "good"
    if share < SYNCHRONOUS:
        return _("exactly uniform"), "good"
    if is_rounding(drive, share, length):
        return _("uniform but for rounding"), "good"
    if share < CALM:
        return _("nearly uniform"), "plain"
    if wants_fluctuation(drive):
        return "", "plain"
    if found.feasible or is_rounding(drive, found.speed_fluctuation_min, length):
        return _("can be made uniform"), "warning"
    return _("cannot be uniform"), "warning"


def _facts(drive: Drive, found: Phasing) -> dict[str, Any]:
    return {
        "synchronous_possible": found.feasible,
        "speed_fluctuation_as_specified": Quantity(found.as_built.speed_fluctuation, "share"),
        "speed_fluctuation_min": Quantity(found.speed_fluctuation_min, "share"),
        "speed_fluctuation_max": Quantity(found.speed_fluctuation_max, "share"),
        "equivalent_joint_angle_min": Quantity(found.joint_angle_min, "angle"),
        "equivalent_joint_angle_max": Quantity(found.joint_angle_max, "angle"),
        "limiting_joint": found.limiting_joint,
        "limiting_joints": list(found.limiting_joints),
        "free_shafts": list(found.free),
        "held_shafts": list(found.fixed),
        "shafts": list(range(2, len(drive.joints) + 1)),
        "poses": list(found.poses),
        "settings": [setting_facts(one) for one in every_setting(found)],
        **({"steering": [_steering_facts(one) for one in found.steering]} if found.steering else {}),
        "spline_refusal": found.spline_refusal,
        "complete": found.complete,
    }


def _steering_facts(one: SteeringColumn) -> dict[str, Any]:
    return {
        "label": one.setting.label,
        "yoke_angle": Quantity(np.asarray(one.setting.yoke_angle, dtype=float), "angle"),
        "start_phase": Quantity(one.setting.start_phase, "angle"),
        "centre_ratio": one.centre_ratio,
        "least_ratio": one.least,
        "greatest_ratio": one.greatest,
        "asymmetry": one.asymmetry,
        "torque_ripple": Quantity(one.ripple, "share"),
        "pose_centre_ratio": one.pose_centre_ratio.tolist(),
        "pose_asymmetry": one.pose_asymmetry.tolist(),
    }


def setting_facts(one: YokeSetting) -> dict[str, Any]:
    """Return one setting for a program; lists run over the yokes of shafts 2 … n unless their name says otherwise."""

    def each(values: Array, dimension: str) -> Quantity:
        return Quantity(np.asarray(values, dtype=float), dimension)

    return {
        "label": one.label,
        "speed_fluctuation": Quantity(one.speed_fluctuation, "share"),
        "yoke_angle": each(one.yoke_angle, "angle"),
        "change": each(one.change, "angle"),
        "sensitivity_per_deg": np.asarray(one.sensitivity, dtype=float) * deg,
        "initial_yoke_position": each(one.initial_phase, "angle"),
        "shaft_speed_fluctuation": each(one.shaft_speed_fluctuation, "share"),
        "pose_speed_fluctuation": each(one.pose_speed_fluctuation, "share"),
    }


def with_applied(said: Answer, setting: YokeSetting, file: str, values: Mapping[str, Any]) -> Answer:
    """Return an answer with a word on the setting that was written into a file, and with what to do next.

    values: what changed in it, by paths with units.
    """
    text = _("{path}: setting {label} written, speed fluctuation δ = {share}.")
    done = say(text, path=file, label=setting.label, share=Quantity(setting.speed_fluctuation, "share"))
    step = Remark(text=_("Look at the new drive:"), command=("cardan", "report", file), tone="next")
    kept = [remark for remark in said.remarks if remark.tone != "next"]
    facts = {**said.facts, "applied": {"setting": setting.label, "file": file, "values": values}}
    return replace(said, remarks=(*kept, Remark(text=done, tone="good"), step), facts=facts)


COLUMNS = (
    SweepQuestion(
        name="phasing",
        doc=mark("least and largest speed fluctuation of the output by other yoke angles"),
        told=(
            OutputColumn.of("least_speed_fluctuation_percent", mark("least speed fluctuation by other yoke angles")),
            OutputColumn.of(
                "largest_speed_fluctuation_percent", mark("largest speed fluctuation by other yoke angles")
            ),
        ),
        of_result=lambda found: (found.speed_fluctuation_min, found.speed_fluctuation_max),
    ),
)
"""What a sweep may ask of phasing."""
