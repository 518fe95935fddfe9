"""``cardan check``: does the drive keep its limits, and what cures it where it does not?"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, MoreRows, Plot, SpeedRpm

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cardan.drive.drive import Drive


def check(
    file: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help=_("Drive file, TOML or JSON; - reads standard input."), show_default=False),
    ] = None,
    only: Annotated[
        list[str] | None,
        typer.Option("--only", metavar="CHECK", help=_("Only this check; may be repeated."), show_default=False),
    ] = None,
    listed: Annotated[
        bool, typer.Option("--list", help=_("List all checks, and do nothing else."), show_default=False)
    ] = False,
    catalogue: MoreRows = None,
    sources: Annotated[
        bool, typer.Option("--sources", help=_("Say of every verdict where it comes from."), show_default=False)
    ] = False,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Judge the drive by every check that its file has data for, and say what cures what fails."""
    from .asked import check_options, keys_of, on_duty
    from .show import show

    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)

    from .check_answer import Judged, answer, listing

    if listed:
        return show(listing(), json=json, csv=csv)

    from cardan.errors import refuse

    if file is None:
        raise refuse("FILE", _("missing: the drive file to judge, or --list"))

    from cardan.checks import check as question
    from cardan.choices.cure import cures
    from cardan.io.drive_file import known_to

    from .progress import watching
    from .source import STDIN, read

    more = tuple(catalogue or ())
    _check_only(only or ())
    drive: Drive = on_duty(read(file, more), speed_rpm, torque)
    known = known_to(drive, "." if file == STDIN else file.parent, more)
    with keys_of(file), watching(_("searching cures")) as progress:
        verdicts = question(drive, only=only or (), known=known)
        found = cures(drive, verdicts, known=known, progress=progress)
    judged = Judged(drive=drive, file=file, verdicts=verdicts, cures=found, sources=sources)
    return show(answer(judged), json=json, csv=csv, plot=plot)


def _check_only(names: Sequence[str]) -> None:
    """Refuse a check that is none."""
    from cardan.checks import CHECKS
    from cardan.errors import Problem
    from cardan.errors import check as refuse_all
    from cardan.units import nearest

    problems = []
    for name in names:
        if name not in CHECKS:
            near = nearest(name, CHECKS)
            text = _("{name} is no check; cardan check --list names them").format(name=repr(name))
            problems.append(Problem("--only", text + (_("; the nearest is {near}").format(near=near) if near else "")))
    refuse_all(problems)
