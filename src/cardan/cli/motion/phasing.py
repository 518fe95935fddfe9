"""``cardan phasing``: which yoke angles make the output uniform?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite, radians
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from cardan.answers.answer import Answer
from cardan.cli.shared.apply import check_copy, named, written
from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.output import check_common
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Force, Plot, read_with_text
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, check, refuse
from cardan.questions.phases import layout_answer
from cardan.questions.phases.answer import answer, ask, every_setting, with_applied
from cardan.questions.phases.layout import Layout
from cardan.questions.phases.layout import layout as moved
from cardan.questions.phases.layout_conditions import Over
from cardan.questions.phases.phases import NEAREST, SYNCHRONOUS, Phasing
from cardan.texts import _

Goal: TypeAlias = Literal["intermediate", "nearest"]


def phasing(
    file: DriveFile,
    fix: Annotated[
        list[str] | None, option("--fix", "SHAFT=DEG", _("Hold the yoke angle of a shaft; may be repeated."))
    ] = None,
    goal: Annotated[
        Goal,
        option(
            "--goal",
            "GOAL",
            _(
                "Among equally uniform settings prefer the least fluctuation of the intermediate shafts (intermediate) "
                "or the least change of the present yokes (nearest)."
            ),
        ),
    ] = "intermediate",
    layout: Annotated[
        bool,
        flag(
            "--layout",
            _("Also move the joint centres within their limits (move_within), for the smallest joint angles."),
        ),
    ] = False,
    over: Annotated[
        Over | None,
        option(
            "--over",
            "WHAT",
            _(
                "Of what --layout makes the fluctuation least where there are poses, movements or spline teeth: of the "
                "worst condition or of their mean over the time."
            ),
        ),
    ] = None,
    apply: Annotated[
        str | None, option("--apply", "SETTING", _("Which setting (A, B …) -o writes; the first by default."))
    ] = None,
    out: Annotated[
        Path | None,
        option("--out -o", "PATH", _("Write the yoke angles into a copy of FILE, comments kept; may be FILE.")),
    ] = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell which yoke angles make the output uniform, or how uniform it can be."""
    check_common(json=json, csv=csv, plot=plot)
    held, nearest = held_yokes(fix or ()), goal == "nearest"
    if over is not None and not layout:
        raise refuse("--over", _("belongs to --layout"))
    if out is not None:
        check_copy(out, file, force=force)
    drive, text = read_with_text(file)
    changed: dict[str, Any] = {}
    if layout:
        place = _with_layout(drive, held, goal, over or "worst")
        found, changed = place.phasing, layout_answer.values(place)
        said: Answer = layout_answer.answer(drive, place, fixed=held, nearest=nearest)
    else:
        found = _ask(file, drive, held, goal)
        said = answer(drive, found, fixed=held, nearest=nearest)
    if apply is not None and out is None:
        named(every_setting(found), apply)
        raise refuse("--apply", _("needs -o PATH; -o with the name of FILE overwrites it"))
    if out is not None:
        setting, values = written(found, drive, text, label=apply, out=out, also=changed)
        said = with_applied(said, setting, str(out), values)
    return tell(said, file, drive, json=json, csv=csv, plot=plot)


def held_yokes(fix: Sequence[str]) -> dict[int, float]:
    """Return shaft number -> yoke angle to hold [rad] of ``2=90``."""
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


def _ask(file: Path, drive: Drive, held: dict[int, float], goal: Goal) -> Phasing:
    wish = NEAREST if goal == "nearest" else SYNCHRONOUS
    try:
        with watching(_("searching yoke angles")) as progress:
            return ask(drive, fixed=held, goal=wish, progress=progress)
    except InputError as error:
        if any(_as_option(one.field) != one.field for one in error.problems):
            raise error.renamed(_as_option) from error
        with keys_of(file):
            raise


def _with_layout(drive: Drive, held: dict[int, float], goal: Goal, over: Over) -> Layout:
    check(
        Problem("--fix", _("shaft {number} has no two yokes to set").format(number=k))
        for k in held
        if not 2 <= k <= len(drive.joints)
    )
    shafts = tuple(
        replace(shaft, yoke_angle=held[shaft.number], yoke_fixed=True) if shaft.number in held else shaft
        for shaft in drive.shafts
    )
    wish = NEAREST if goal == "nearest" else SYNCHRONOUS
    with watching(_("searching joint centres")) as progress:
        return moved(replace(drive, shafts=shafts), goal=wish, over=over, progress=progress)


def _as_option(field: str) -> str:
    """Return the option that gave a field of the question."""
    return "--fix " + field.removeprefix("fixed[").removesuffix("]") if field.startswith("fixed[") else field
