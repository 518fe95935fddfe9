"""``cardan phases``: which yoke angles make the output even?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from cardan.texts import _, plural

from .options import AsCsv, AsJson, DriveFile, Plot

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.synthesis.phases import Phasing, YokeSetting

    from .answer import Answer, Cell, Column, Remark, Table

WIDEST = 7
"""With more yokes than this the table of settings is turned: shafts downwards."""

WORTH = 2e-4
"""A setting that turns no yoke by more than this [rad] is not worth writing."""

SLIGHT = 1e-3
"""An irregularity below this needs no other bends."""

PITCHED = 3
"""So many settings of spline teeth are shown; JSON and CSV hold all."""


def phases(
    file: DriveFile,
    fix: Annotated[
        list[str] | None,
        typer.Option(
            "--fix",
            metavar="SHAFT=DEG",
            help=_("Hold the yoke angle of a shaft; may be repeated."),
            show_default=False,
        ),
    ] = None,
    goal: Annotated[
        Literal["intermediate", "nearest"],
        typer.Option(
            "--goal",
            metavar="GOAL",
            help=_(
                "Among equally even settings prefer calm intermediate shafts (intermediate) or the least change of "
                "the present yokes (nearest)."
            ),
        ),
    ] = "intermediate",
    apply: Annotated[
        str | None,
        typer.Option(
            "--apply",
            metavar="SETTING",
            help=_("Write the yoke angles of a setting (A, B …) into a copy of FILE, comments kept; needs -o."),
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="PATH", help=_("Where --apply writes; may be FILE."), show_default=False),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell which yoke angles make the output even, or how even it can be."""
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    held = held_yokes(fix or ())
    if apply is not None or out is not None:
        _check_apply(apply, out)

    from .source import read_with_text

    drive, text = read_with_text(file)
    found = _ask(drive, held, goal)
    answer = _answer(drive, file, found, held)
    if apply is not None and out is not None:
        from .apply import applied

        answer = applied(answer, every_setting(found), drive, text, apply, out)
    return show(answer, json=json, csv=csv, plot=plot)


def held_yokes(fix: Sequence[str]) -> dict[int, float]:
    """Return shaft number -> yoke angle to hold [rad] of ``2=90``.

    Examples
    --------
    >>> held_yokes(["2=180"])
    {2: 3.141592653589793}
    """
    from math import isfinite, radians

    from cardan.errors import Problem, check

    found: dict[int, float] = {}
    problems = []
    for text in fix:
        shaft, _equals, angle = text.partition("=")
        try:
            number, value = int(shaft), float(angle)
        except ValueError:
            problems.append(
                Problem("--fix", _("{text} should look like 2=90: shaft number = degrees").format(text=text))
            )
            continue
        if not isfinite(value):
            problems.append(Problem("--fix", _("{text}: the angle is not a finite number").format(text=text)))
        elif number in found:
            problems.append(Problem("--fix", _("shaft {number} is held twice").format(number=number)))
        found[number] = radians(value)
    check(problems)
    return found


def _check_apply(apply: str | None, out: Path | None) -> None:
    from cardan.errors import refuse

    from .output import check_target

    if apply is None:
        raise refuse("--out", _("belongs to --apply SETTING; which one shall be written?"))
    if out is None:
        raise refuse("--apply", _("needs -o PATH; -o with the name of FILE overwrites it"))
    check_target(out, "--out")


def _ask(drive: Drive, held: dict[int, float], goal: str) -> Phasing:
    from cardan.errors import InputError
    from cardan.synthesis.phases import NEAREST, SYNCHRONOUS
    from cardan.synthesis.phases import phases as question

    from .progress import watching

    try:
        with watching(_("searching yoke angles")) as progress:
            wish = NEAREST if goal == "nearest" else SYNCHRONOUS
            return question(drive, fixed=held, goal=wish, progress=progress)
    except InputError as error:
        raise error.renamed(lambda field: field.replace("fixed[", "--fix ").replace("]", "")) from error


def _answer(drive: Drive, file: Path, found: Phasing, held: dict[int, float]) -> Answer:
    from cardan.analysis.equivalence import SYNCHRONOUS

    from .answer import Answer

    shown = (found.as_built, *found.settings, *found.spline_settings[:PITCHED], *found.pose_settings)
    settings = [_table(drive, shown)] if len(drive.joints) > 1 else []
    posed = [_pose_table(found, shown)] if found.poses else []
    return Answer(
        sentence=_sentence(drive, file, found),
        tone="good" if found.as_built.irregularity < SYNCHRONOUS else "plain",
        tables=lambda: (*settings, *posed),
        remarks=tuple(_remarks(drive, file, found, held)),
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
    from cardan.analysis.equivalence import SYNCHRONOUS

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


def _remarks(drive: Drive, file: Path, found: Phasing, held: dict[int, float]) -> Iterator[Remark]:
    from math import degrees, radians

    from .answer import Remark, percent
    from .motion import steep_joints

    if not found.complete:
        yield Remark(text=_("Warning: the search was stopped; these are the best settings so far."), tone="warning")
    if not found.feasible:
        yield from _limits(drive, found)
    if found.settings and found.free:
        best = found.settings[0]
        numbers = sorted((*found.free, *found.fixed))
        each = [100.0 * abs(float(best.sensitivity[k - 2])) * radians(1.0) for k in numbers]
        if found.feasible:
            yield Remark(
                text=_("A yoke 1° off costs {costs} % on shaft {shafts}.").format(
                    costs=" / ".join(f"{cost:.2f}" for cost in each),
                    shafts=" / ".join(str(k) for k in numbers),
                )
            )
        else:
            text = _("The free yokes reach everything from {low} to {high}.")
            low, high = percent(found.irregularity_min), percent(found.irregularity_max)
            yield Remark(text=text.format(low=low, high=high))
    if found.spline_refusal:
        yield Remark(text=_("Warning: splines: {reason}.").format(reason=found.spline_refusal), tone="warning")
    yield from steep_joints(drive)
    writable = (*found.pose_settings, *found.settings)
    if writable and abs(writable[0].change).max() > WORTH:
        fixes = [part for k, angle in held.items() for part in ("--fix", f"{k}={degrees(angle):.12g}")]
        apply = ("--apply", writable[0].label, "-o", "better.toml")
        text = _("Write setting {label} into a copy of the file:").format(label=writable[0].label)
        yield Remark(text=text, command=("cardan", "phases", str(file), *fixes, *apply), tone="next")


def _limits(drive: Drive, found: Phasing) -> Iterator[Remark]:
    """Yield why no yoke angles make the drive even, and what would."""
    from math import degrees

    from cardan.drive.chain import chain

    from .answer import Remark

    if len(drive.joints) == 1:
        yield Remark(text=_("One joint is never even; a second one of equal bend can undo it."), tone="next")
        return
    if found.limiting_joint is None or not found.free:
        return
    bend = degrees(float(chain(drive).bend[found.limiting_joint - 1]))
    if found.irregularity_min < SLIGHT:
        text = _("Joint {number} ({bend:.2f}°) bends slightly more than the others can undo; what remains is small.")
        yield Remark(text=text.format(number=found.limiting_joint, bend=bend))
        return
    if len(found.limiting_joints) > 1:
        tied = ", ".join(str(k) for k in found.limiting_joints)
        text = _(
            "Joints {tied}, tied by held yokes, act as one that is too uneven for the others; free a yoke, or bend "
            "joint {number} ({bend:.2f}°) less."
        ).format(tied=tied, number=found.limiting_joint, bend=bend)
    else:
        text = _(
            "Joint {number} bends too much ({bend:.2f}°): all others together cannot undo it. Bend it less, the "
            "others more."
        ).format(number=found.limiting_joint, bend=bend)
    yield Remark(text=text, tone="warning")


def _table(drive: Drive, shown: Sequence[YokeSetting]) -> Table:
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
