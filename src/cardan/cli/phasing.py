"""What ``cardan phases`` says of yoke settings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _, plural

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.phases.phases import Phasing, YokeSetting

    from .answer import Answer, Cell, Column, Remark, Table

WIDEST = 7
"""With more yokes than this the table of settings is turned: shafts downwards."""

WORTH = 2e-4
"""A setting that turns no yoke by more than this [rad] is not worth writing."""

PITCHED = 3
"""So many settings of spline teeth are shown; JSON and CSV hold all."""


def answer(drive: Drive, file: Path, found: Phasing, held: Mapping[int, float], goal: str) -> Answer:
    """Return what to say of the yoke settings of a drive.

    Parameters
    ----------
    drive : Drive
        The drive as it stands in the file.
    file : path
        The file.
    found : Phasing
        What its yoke angles can do.
    held : mapping of int to float
        What ``--fix`` holds: shaft number -> yoke angle [rad].
    goal : str
        As of ``--goal``.
    """
    from cardan.questions.motion.equivalence import SYNCHRONOUS

    from .answer import Answer

    shown = (found.as_built, *found.settings, *found.spline_settings[:PITCHED], *found.pose_settings)
    settings = [settings_table(drive, shown)] if len(drive.joints) > 1 else []
    posed = [_pose_table(found, shown)] if found.poses else []
    return Answer(
        sentence=_sentence(drive, file, found),
        tone="good" if found.as_built.irregularity < SYNCHRONOUS else "plain",
        tables=lambda: (*settings, *posed),
        remarks=tuple(_remarks(drive, file, found, held, goal)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _full_table(drive, found),
        figure=lambda: _figures(found),
        code=0 if found.complete else 1,
    )


def _figures(found: Phasing) -> Any:
    from cardan.figures import for_result

    return for_result(found)


def every_setting(found: Phasing) -> tuple[YokeSetting, ...]:
    """Return all settings of an answer, the one as built first."""
    return (found.as_built, *found.settings, *found.spline_settings, *found.pose_settings)


def _sentence(drive: Drive, file: Path, found: Phasing) -> str:
    from cardan.questions.motion.equivalence import SYNCHRONOUS

    from .answer import percent
    from .source import title

    count = plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints))
    name = title(drive, file)
    if found.as_built.irregularity < SYNCHRONOUS:
        return _("{name}: {count}, exactly synchronous as built").format(name=name, count=count)
    now = percent(found.as_built.irregularity)
    if found.feasible:
        text = _("{name}: {count}, {now} irregular as built → exactly synchronous possible")
        return text.format(name=name, count=count, now=now)
    if not found.free:
        text = _("{name}: {count}, {now} irregular as built, {least} with the yokes held")
        if len(drive.joints) == 1 or abs(found.settings[0].change).max() < 1e-9:
            text = _("{name}: {count}, {now} irregular, no yokes to set")
        return text.format(name=name, count=count, now=now, least=percent(found.irregularity_min))
    text = _("{name}: {count}, {now} irregular as built → cannot be synchronous, at least {least} remains")
    return text.format(name=name, count=count, now=now, least=percent(found.irregularity_min))


def _remarks(drive: Drive, file: Path, found: Phasing, held: Mapping[int, float], goal: str) -> Iterator[Remark]:
    from cardan.drive.models.laws import unmapped
    from cardan.figures.wording import letters

    from .answer import Remark
    from .motion import steep_joints

    if not found.complete:
        yield Remark(text=_("Warning: the search was stopped; these are the best settings so far."), tone="warning")
    if not found.feasible:
        yield from _limits(drive, found)
    if meaning := letters(found, nearest=goal == "nearest"):
        yield Remark(text=meaning)
    yield from spread(found)
    if unmapped(drive.joints):
        text = _("What joints leave by laws of their own, below {most} rad, is not in these figures.")
        yield Remark(text=text.format(most="10⁻⁶"))
    if found.spline_refusal:
        yield Remark(text=_("Warning: splines: {reason}.").format(reason=found.spline_refusal), tone="warning")
    yield from steep_joints(drive)
    writable = (*found.pose_settings, *found.settings)
    if writable and abs(writable[0].change).max() > WORTH:
        text = _("Write setting {label} into a copy of the file:").format(label=writable[0].label)
        parts = command(file, held, goal, "--apply", writable[0].label, "-o", "better.toml")
        yield Remark(text=text, command=parts, tone="next")


def command(file: Path, held: Mapping[int, float], goal: str, *more: str) -> tuple[str, ...]:
    """Return the command that asks the same again, and more."""
    from math import degrees

    fixes = [part for k, angle in held.items() for part in ("--fix", f"{k}={degrees(angle):.12g}")]
    goals = ["--goal", goal] if goal != "intermediate" else []
    return ("cardan", "phases", str(file), *fixes, *goals, *more)


def spread(found: Phasing) -> Iterator[Remark]:
    """Yield what an error of the yokes costs, or what the free yokes reach."""
    from cardan.figures.wording import noiseless

    from .answer import Remark, percent, significant

    if found.settings and found.free:
        best = found.settings[0]
        numbers = sorted((*found.free, *found.fixed))
        costs = noiseless(best.one_off, found.reach)
        each = [100.0 * costs[k - 2] for k in numbers]
        if found.feasible and len(numbers) > WIDEST:
            text = _("A yoke 1° off costs at most {cost} %, on shaft {shaft}.")
            yield Remark(text=text.format(cost=significant(max(each), 2), shaft=numbers[each.index(max(each))]))
        elif found.feasible:
            yield Remark(
                text=_("A yoke 1° off costs {costs} % on shaft {shafts}.").format(
                    costs=" / ".join(significant(cost, 2) for cost in each),
                    shafts=" / ".join(str(k) for k in numbers),
                )
            )
        else:
            text = _("The free yokes reach everything from {low} to {high}.")
            low, high = percent(found.irregularity_min), percent(found.irregularity_max)
            yield Remark(text=text.format(low=low, high=high))


def _limits(drive: Drive, found: Phasing) -> Iterator[Remark]:
    """Yield why no yoke angles make the drive even, and what would."""
    from math import degrees

    from cardan.drive.models.chain import given_chain
    from cardan.figures.wording import LITTLE, excess
    from cardan.units import deg

    from .answer import Remark

    if len(drive.joints) == 1:
        if drive.joints[0].single_cross:
            yield Remark(text=_("One joint is never even; a second one of equal bend can undo it."), tone="next")
        return
    if found.limiting_joint is None or not found.free:
        return
    bend = degrees(float(given_chain(drive).bend[found.limiting_joint - 1]))
    if len(found.limiting_joints) > 1:
        tied = ", ".join(str(k) for k in found.limiting_joints)
        text = _(
            "Joints {tied}, tied by held yokes, act as one that is too uneven for the others; free a yoke, or bend "
            "joint {number} ({bend:.2f}°) less."
        ).format(tied=tied, number=found.limiting_joint, bend=bend)
    else:
        plain = drive.joints[found.limiting_joint - 1].single_cross
        text = excess(found, len(drive.joints), bend * deg, single_cross=plain)
    yield Remark(text=text, tone="plain" if found.irregularity_min < LITTLE else "warning")


def settings_table(drive: Drive, shown: Sequence[YokeSetting]) -> Table:
    """Return the settings row by row, or column by column where there are many shafts."""
    import numpy as np

    from .answer import Column, Table

    numbers = range(2, len(drive.joints) + 1)
    angles = [[f"{value:z.2f}°" for value in np.rad2deg(one.yoke_angle)] for one in shown]
    leaves = [f"{100.0 * one.irregularity:.3f} %" for one in shown]
    if len(numbers) <= WIDEST:
        heads: list[Column] = [Column(key=str(k), heading=str(k)) for k in numbers]
        rows = [[one.label, *row, rest] for one, row, rest in zip(shown, angles, leaves, strict=True)]
        first = Column(key="setting", heading=_("yoke angle on shaft"), left=True)
        return Table(columns=(first, *heads, Column(key="leaves", heading=_("leaves"))), rows=rows)
    heads = [Column(key=one.label, heading=one.label) for one in shown]
    rows = [[str(k), *(row[k - 2] for row in angles)] for k in numbers] + [[_("leaves"), *leaves]]
    return Table(columns=(Column(key="shaft", heading=_("yoke of shaft"), left=True), *heads), rows=rows)


def _pose_table(found: Phasing, shown: Sequence[YokeSetting]) -> Table:
    from .answer import Column, Table, named

    heads = [Column(key=name, heading=named(k, name), unit="%", form=".3f") for k, name in enumerate(found.poses, 1)]
    rows: list[list[Cell]] = [[one.label, *(100.0 * float(value) for value in one.pose_irregularity)] for one in shown]
    first = Column(key="setting", heading=_("irregular in pose"), left=True)
    return Table(columns=(first, *heads), rows=rows)


def _full_table(drive: Drive, found: Phasing) -> Table:
    import numpy as np

    from .answer import Column, Table

    n = len(drive.joints)
    columns = [Column(key="setting"), Column(key="irregularity")]
    columns += [Column(key=f"shaft_{k}_yoke_angle_deg") for k in range(2, n + 1)]
    columns += [Column(key=f"shaft_{k}_change_deg") for k in range(2, n + 1)]
    columns += [Column(key=f"shaft_{k}_irregularity") for k in range(2, n + 2)]
    columns += [Column(key=f"pose_{name}_irregularity") for name in found.poses]
    rows: list[list[Cell]] = [
        [
            one.label,
            one.irregularity,
            *np.rad2deg(one.yoke_angle).tolist(),
            *np.rad2deg(one.change).tolist(),
            *one.shaft_irregularity.tolist(),
            *one.pose_irregularity.tolist(),
        ]
        for one in every_setting(found)
    ]
    return Table(columns=tuple(columns), rows=rows)


def _content(drive: Drive, file: Path, found: Phasing) -> dict[str, Any]:
    from math import degrees

    return {
        "question": "phases",
        "drive": drive.name,
        "file": str(file),
        "synchronous_possible": found.feasible,
        "irregularity_as_built": found.as_built.irregularity,
        "irregularity_min": found.irregularity_min,
        "irregularity_max": found.irregularity_max,
        "equivalent_bend_min_deg": degrees(found.bend_min),
        "equivalent_bend_max_deg": degrees(found.bend_max),
        "limiting_joint": found.limiting_joint,
        "limiting_joints": found.limiting_joints,
        "free_shafts": found.free,
        "held_shafts": found.fixed,
        "shafts": list(range(2, len(drive.joints) + 1)),
        "poses": found.poses,
        "settings": [setting_content(one) for one in every_setting(found)],
        "spline_refusal": found.spline_refusal,
        "complete": found.complete,
    }


def setting_content(one: YokeSetting) -> dict[str, Any]:
    """Return one setting for a program; lists run over the yokes of shafts 2 … n unless their name says otherwise."""
    import numpy as np

    return {
        "label": one.label,
        "irregularity": one.irregularity,
        "yoke_angle_deg": np.rad2deg(one.yoke_angle),
        "change_deg": np.rad2deg(one.change),
        "sensitivity_per_deg": np.deg2rad(one.sensitivity),
        "joint_phase_angle_deg": np.rad2deg(one.phase_angle),
        "shaft_irregularity": one.shaft_irregularity,
        "pose_irregularity": one.pose_irregularity,
    }
