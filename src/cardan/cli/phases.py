"""``cardan phases``: which yoke angles make the output even?"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, Force, Plot

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.phases.layout import Layout
    from cardan.questions.phases.phases import Phasing

Goal: TypeAlias = Literal["intermediate", "nearest"]


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
        Goal,
        typer.Option(
            "--goal",
            metavar="GOAL",
            help=_(
                "Among equally even settings prefer calm intermediate shafts (intermediate) or the least change of "
                "the present yokes (nearest)."
            ),
        ),
    ] = "intermediate",
    layout: Annotated[
        bool,
        typer.Option(
            "--layout",
            help=_("Also move the joint centres within their boxes (move_within), for the smallest bends."),
            show_default=False,
        ),
    ] = False,
    apply: Annotated[
        str | None,
        typer.Option(
            "--apply",
            metavar="SETTING",
            help=_("Which setting (A, B …) -o writes; the first by default."),
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="PATH",
            help=_("Write the yoke angles into a copy of FILE, comments kept; may be FILE."),
            show_default=False,
        ),
    ] = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell which yoke angles make the output even, or how even it can be."""
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    held = held_yokes(fix or ())
    if out is not None:
        from .apply import check_copy

        check_copy(out, file, force=force)

    from .source import read_with_text

    drive, text = read_with_text(file)
    if layout:
        from .layout import answer as moved
        from .layout import values

        place = _with_layout(drive, held, goal)
        answer, found, changed = moved(drive, file, place, held, goal), place.phasing, values(place)
    else:
        from .phasing import answer as turned

        found = _ask(drive, held, goal)
        answer, changed = turned(drive, file, found, held, goal), {}
    if apply is not None and out is None:
        from cardan.errors import refuse

        from .apply import named
        from .phasing import every_setting

        named(every_setting(found), apply)
        raise refuse("--apply", _("needs -o PATH; -o with the name of FILE overwrites it"))
    if out is not None:
        from .apply import applied

        answer = applied(answer, found, drive, text, label=apply, out=out, also=changed)
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


def _ask(drive: Drive, held: dict[int, float], goal: Goal) -> Phasing:
    from cardan.errors import InputError
    from cardan.questions.phases.phases import NEAREST, SYNCHRONOUS
    from cardan.questions.phases.phases import phases as question

    from .progress import watching

    try:
        with watching(_("searching yoke angles")) as progress:
            wish = NEAREST if goal == "nearest" else SYNCHRONOUS
            return question(drive, fixed=held, goal=wish, progress=progress)
    except InputError as error:
        raise error.renamed(_as_option) from error


def _with_layout(drive: Drive, held: dict[int, float], goal: Goal) -> Layout:
    from dataclasses import replace

    from cardan.errors import Problem, check
    from cardan.questions.phases.layout import layout as question
    from cardan.questions.phases.phases import NEAREST, SYNCHRONOUS

    from .progress import watching

    check(
        Problem("--fix", _("shaft {number} has no two yokes to set").format(number=k))
        for k in held
        if not 2 <= k <= len(drive.joints)
    )
    shafts = tuple(
        replace(shaft, yoke_angle=held[shaft.number], yoke_fixed=True) if shaft.number in held else shaft
        for shaft in drive.shafts
    )
    with watching(_("searching joint centres")) as progress:
        wish = NEAREST if goal == "nearest" else SYNCHRONOUS
        return question(replace(drive, shafts=shafts), goal=wish, progress=progress)


def _as_option(field: str) -> str:
    """Return the option that gave a field of the question."""
    return "--fix " + field.removeprefix("fixed[").removesuffix("]") if field.startswith("fixed[") else field
