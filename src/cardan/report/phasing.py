"""Page 4: what the yokes can do."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from cardan.drive.models.laws import is_even
from cardan.figures.wording import fixed, letters, noiseless, percent, significant
from cardan.questions.phases.figures.phases import phasing_figures
from cardan.questions.phases.setting import YokeSetting
from cardan.texts import _
from cardan.units import deg

from .block import Block, Cell, Column, Page, Picture, Table, Words, number, of_shaft, words
from .subject import Subject

SHOWN = 3
"""Settings with spline teeth shown beside the exact ones."""

WIDEST = 8
"""With more intermediate shafts than this the table of settings is turned: shafts downwards."""


def phasing(on: Subject) -> Page:
    """Return the page of the yoke angles."""
    blocks: list[Block] = [Words(title=_("Can it be even?"), text=_proof(on))]
    blocks += [Picture(figure=figure) for figure in phasing_figures(on.phasing)]
    if on.phasing.settings:
        blocks.insert(2, _settings(on))
        blocks.append(_costs(on))
    if on.phasing.poses:
        blocks.append(_poses(on))
    return Page(name="phases", title=_("Yoke angles"), answer=_answer(on), blocks=blocks)


def _answer(on: Subject) -> str:
    best = on.best
    if best is None:
        return _("A single joint has no second one to undo it.")
    elsewhere = on.drive.movements or on.drive.poses
    if on.alone_even and elsewhere and not all(is_even(joint) for joint in on.drive.joints):
        return _("As drawn every joint turns evenly by itself; the yokes count where the drive bends otherwise.")
    if on.alone_even:
        return _("The yokes may stand anyhow: every joint turns evenly by itself.")
    if on.even:
        return _("The yokes stand right: the drive is synchronous.")
    if on.rounded:
        return _("The yokes stand right: the drive is synchronous but for the rounding of its figures.")
    if on.phasing.feasible:
        return _("The yokes can make the drive exactly synchronous.")
    if on.rounding(on.phasing.irregularity_min):
        return _("The yokes can make the drive synchronous but for the rounding of its figures.")
    return _("No yokes make the drive synchronous; the least they can leave is {share}.").format(
        share=percent(on.phasing.irregularity_min)
    )


def _proof(on: Subject) -> str:
    if on.alone_even:
        said = _("Every joint turns evenly by itself, straight or of constant velocity: there is nothing to undo.")
        return f"{said} {_standing(on)}".strip()
    sides = _sides(on)
    return sides + " " + _("α is the bend of the Hooke joint that turns alike.") if on.mixed else sides


def _standing(on: Subject) -> str:
    """Return that something holds for a moving drive as drawn; nothing for one that does not move."""
    return _("This concerns the drive as drawn, standing still.") if on.drive.movements else ""


def _sides(on: Subject) -> str:
    """Return what the sides of the phase polygon say."""
    closing = on.closing
    longest = float(np.max(closing.length))
    places = min(max(4, 2 - math.floor(math.log10(longest))), 12) if longest > 0.0 else 4
    sides = ", ".join(fixed(float(value), places) for value in closing.length[:8]) + (" …" if on.joints > 8 else "")
    if on.joints == 1:
        return _(
            "Every joint is a side of length L = −ln cos α, here {sides}. One side never comes back to its start."
        ).format(sides=sides)
    if on.phasing.fixed:
        held = ", ".join(map(str, on.phasing.fixed))
        return _(
            "Every joint is a side of length L = −ln cos α, here {sides}; the yokes of shaft {held} are held, so the "
            "joints at their ends count as one. The free yokes reach every irregularity from {low} to {high}."
        ).format(
            sides=sides,
            held=held,
            low=percent(on.phasing.irregularity_min),
            high=percent(on.phasing.irregularity_max),
        )
    compare = {
        "longest": closing.longest,
        "long": fixed(float(closing.length[closing.longest - 1]), places),
        "others": fixed(closing.others, places),
        "sides": sides,
    }
    if closing.closes:
        return _(
            "Every joint is a side of length L = −ln cos α, here {sides}, and the yoke angles are the corners. The "
            "longest side, joint {longest} with {long}, is no longer than the others together, {others}: the path can "
            "be closed, exactly and for all harmonics at once."
        ).format(**compare)
    if on.rounding(on.phasing.irregularity_min):
        return _(
            "Every joint is a side of length L = −ln cos α, here {sides}, and the yoke angles are the corners. The "
            "longest side, joint {longest}, is as long as the others together but for the rounding of the figures that "
            "describe the drive: what it leaves, {left}, is no unevenness of the design."
        ).format(**compare, left=percent(on.phasing.irregularity_min))
    text = _(
        "Every joint is a side of length L = −ln cos α, here {sides}, and the yoke angles are the corners. The longest "
        "side, joint {longest} with {long}, is longer than the others together, {others}: no yoke angles can close the "
        "path. It could be closed if that joint bent {bend}°."
    )
    if not on.drive.joints[closing.longest - 1].single_cross:
        text = _(
            "Every joint is a side of length L = −ln cos α, here {sides}, and the yoke angles are the corners. The "
            "longest side, joint {longest} with {long}, is longer than the others together, {others}: no yoke angles "
            "can close the path. It could be closed if the Hooke joint that turns like that joint bent {bend}°."
        )
    return text.format(**compare, bend=fixed(closing.bend_allowed / deg))


def _all(on: Subject) -> list[YokeSetting]:
    return [on.phasing.as_built, *on.phasing.settings, *on.phasing.spline_settings[:SHOWN], *on.phasing.pose_settings]


def _settings(on: Subject) -> Table:
    some = _all(on)
    count = on.joints - 1
    if count > WIDEST:
        rows = [[of_shaft(k + 2), *(_angle(one, k) for one in some)] for k in range(count)] + [
            [words(_("leaves, %")), *(_left(one) for one in some)]
        ]
        return Table(
            title=_("Settings to choose from: yoke angles [°]"),
            columns=(Column(heading=_("shaft"), left=True), *(Column(heading=one.label) for one in some)),
            rows=rows,
            note=" ".join(_notes(on)),
        )
    return Table(
        title=_("Settings to choose from"),
        columns=(
            Column(heading=_("setting"), left=True),
            *(Column(heading=_("γ shaft {number}").format(number=k + 2), unit="°") for k in range(count)),
            Column(heading=_("leaves δ"), unit="%"),
            *([Column(heading=_("worst shaft between"), unit="%")] if count else []),
        ),
        rows=[[words(one.label), *(_angle(one, k) for k in range(count)), _left(one), _between(one)] for one in some],
        note=" ".join(_notes(on)),
    )


def _notes(on: Subject) -> Iterator[str]:
    if meaning := letters(on.phasing):
        yield meaning
    if on.phasing.poses:
        yield _("What is left here is left in the drive as drawn; the poses have a table of their own below.")
    if on.phasing.spline_steps:
        steps = ", ".join(
            _("{steps} places on shaft {number}").format(steps=steps, number=number)
            for number, steps in on.phasing.spline_steps.items()
        )
        yield _("Spline teeth allow {steps}; all of them were looked at.").format(steps=steps)


def _angle(one: YokeSetting, k: int) -> Cell:
    value = float(one.yoke_angle[k]) / deg
    return number(fixed(value), value)


def _left(one: YokeSetting) -> Cell:
    return number(
        percent(one.irregularity).removesuffix(" %"),
        100.0 * one.irregularity,
        "good" if one.irregularity < 1e-13 else "plain",
    )


def _between(one: YokeSetting) -> Cell:
    worst = float(np.max(one.shaft_irregularity[:-1]))
    return number(percent(worst).removesuffix(" %"), 100.0 * worst)


def _costs(on: Subject) -> Table:
    some = [on.phasing.as_built, *on.phasing.settings[:3]]
    costs = [[100.0 * cost for cost in noiseless(one.one_off, on.phasing.reach)] for one in some]
    rows: Sequence[list[Cell]] = [
        [of_shaft(k + 2), *(number(significant(cost[k], 3), cost[k]) for cost in costs)] for k in range(on.joints - 1)
    ]
    note = (
        _("To the worse side, in the pose where it grows most; exact, no slope.")
        if on.phasing.poses
        else _("To the worse side; exact, no slope.")
    )
    return Table(
        title=_("Growth of δ when one yoke stands one degree off"),
        columns=(Column(heading=_("shaft"), left=True), *(Column(heading=one.label, unit="%") for one in some)),
        rows=rows,
        note=note if on.phasing.poses else f"{note} {_standing(on)}".strip(),
    )


def _poses(on: Subject) -> Table:
    return Table(
        title=_("Irregularity δ in each pose"),
        columns=(
            Column(heading=_("setting"), left=True),
            *(Column(heading=name, unit="%") for name in on.phasing.poses),
        ),
        rows=[
            [
                words(one.label),
                *(number(percent(float(d)).removesuffix(" %"), 100.0 * float(d)) for d in one.pose_irregularity),
            ]
            for one in _all(on)
            if len(one.pose_irregularity) == len(on.phasing.poses)
        ],
    )
