"""``cardan check``: does the drive keep its limits, and what remedies it where it does not?"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cardan.catalogue import known_to
from cardan.checks.checks import CHECKS
from cardan.choices.check_answer import answer, answer_of_list, checked
from cardan.cli.shared.asked import TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, MoreRows, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, refuse
from cardan.errors import check as refuse_all
from cardan.texts import _
from cardan.units import nearest


def check(
    file: Annotated[Path | None, argument("FILE", _("Drive file, TOML or JSON; - reads standard input."))] = None,
    only: Annotated[list[str] | None, option("--only", "CHECK", _("Only this check; may be repeated."))] = None,
    listed: Annotated[bool, flag("--list", _("List all checks, and do nothing else."))] = False,
    catalogue: MoreRows = None,
    sources: Annotated[bool, flag("--sources", _("Say of every verdict where it comes from."))] = False,
    missing: Annotated[bool, flag("--missing", _("Say which keys the checks need that were not run."))] = False,
    audit: Annotated[
        bool, flag("--audit", _("Compare all answers that speak of the same quantity, and tell them side by side."))
    ] = False,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Judge the drive by every check that its file has data for, and tell the remedies of what fails."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    if listed:
        return tell(answer_of_list(), json=json, csv=csv)
    if file is None:
        raise refuse("FILE", _("missing: the drive file to judge, or --list"))
    more = tuple(catalogue or ())
    _check_only(only or ())
    drive = on_duty(read(file, more), speed_rpm, torque)
    known = known_to(drive, "." if file == STDIN else file.parent, more)
    with keys_of(file), watching(_("searching remedies")) as progress:
        result = checked(drive, only=only or (), known=known, whole=audit, progress=progress)
    return tell(answer(drive, result, sources=sources, missing=missing), file, drive, json=json, csv=csv, plot=plot)


def _check_only(names: Sequence[str]) -> None:
    """Refuse a check that is none."""
    problems = []
    for name in names:
        if name not in CHECKS:
            near = nearest(name, CHECKS)
            text = _("unknown check {name}; cardan check --list names them").format(name=repr(name))
            problems.append(Problem("--only", text + (_("; the nearest is {near}").format(near=near) if near else "")))
    refuse_all(problems)
