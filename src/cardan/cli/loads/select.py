"""``cardan select``: which types and sizes of joints do a job, under which conditions, and why not the others?"""

from __future__ import annotations

from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import Annotated, Any

from cardan.catalogue import Catalogue, catalogue, known_to, with_files
from cardan.choices.selection import JointDuty, joint_duty, over_time
from cardan.choices.selection_answer import answer, selected
from cardan.cli.shared.asked import TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, MoreRows, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, check
from cardan.texts import _
from cardan.units import deg, mm, rpm


def select(
    file: Annotated[
        Path | None,
        argument(
            "[FILE]", _("Drive file whose joints are to be chosen; - reads standard input. Options count before it.")
        ),
    ] = None,
    joint: Annotated[
        int | None, option("--joint", "NUMBER", _("Only this joint of the file; all of them by default."))
    ] = None,
    torque: TorqueNm = None,
    joint_angle_deg: Annotated[float | None, option("--joint-angle-deg", "DEG", _("Joint angle."))] = None,
    speed_rpm: SpeedRpm = None,
    factor: Annotated[float | None, option("--service-factor", "FACTOR", _("Factor on the torque."))] = None,
    outer_mm: Annotated[
        float | None, option("--outer-mm", "MM", _("Outer diameter, for the speed of the rim."))
    ] = None,
    synchronous: Annotated[
        bool | None, flag("--synchronous/--uneven", _("Whether the output must be uniform."))
    ] = None,
    continuous: Annotated[bool | None, flag("--continuous/--short", _("Whether it runs for long at a time."))] = None,
    modern: Annotated[bool, flag("--modern", _("Count modern types too, whose limits are typical values."))] = False,
    life_h: Annotated[float | None, option("--life-h", "H", _("Running time asked of the bearings."))] = None,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Tell which types and sizes of joints do a job: accepted, under conditions, or rejected, and why."""
    check_options(speed_rpm, torque, json=json, csv=csv)
    files = tuple(more or ())
    changes = _changes(joint_angle_deg, factor, outer_mm, synchronous, continuous, life_h)
    drive = None if file is None else read(file, files)
    if drive is None or file is None:
        known = with_files(catalogue(), files) if files else catalogue()
        need = _need(torque, speed_rpm, changes)
    else:
        known = known_to(drive, "." if file == STDIN else file.parent, files)
        with keys_of(file):
            need = _of_drive(drive, joint, torque, speed_rpm, changes, known)
    try:
        result = selected(need, known=known, modern=modern)
    except InputError as error:
        raise error.renamed(_option) from error
    return tell(answer(drive, result), file, drive, json=json, csv=csv)


OPTIONS = {
    "torque": "--torque-Nm", "joint_angle": "--joint-angle-deg", "speed": "--speed-rpm",
    "service_factor": "--service-factor", "outer": "--outer-mm", "life": "--life-h", "joint": "--joint",
}  # fmt: skip


def _option(field: str) -> str:
    return OPTIONS.get(field, field)


def _changes(
    joint_angle: float | None,
    factor: float | None,
    outer: float | None,
    even: bool | None,
    long: bool | None,
    life: float | None,
) -> dict[str, Any]:
    """Return what the options say beside torque and speed, in SI."""
    given = (
        ("--joint-angle-deg", joint_angle),
        ("--service-factor", factor),
        ("--outer-mm", outer),
        ("--life-h", life),
    )
    text = _("{value} is not a finite number")
    check(Problem(name, text.format(value=one)) for name, one in given if one is not None and not isfinite(one))
    said = {
        "joint_angle": None if joint_angle is None else joint_angle * deg,
        "service_factor": factor,
        "outer": None if outer is None else outer * mm,
        "synchronous": even,
        "continuous": long,
        "life": None if life is None else life * 3600.0,
    }
    return {name: value for name, value in said.items() if value is not None}


def _need(torque: float | None, speed_rpm: float | None, changes: dict[str, Any]) -> JointDuty:
    """Return a need from options alone."""
    given = {"--torque-Nm": torque, "--joint-angle-deg": changes.get("joint_angle"), "--speed-rpm": speed_rpm}
    check(
        Problem(name, _("missing; give it, or a drive file"), "missing") for name, one in given.items() if one is None
    )
    try:
        return JointDuty(torque=torque or 0.0, speed=(speed_rpm or 0.0) * rpm, **changes)
    except InputError as error:
        raise error.renamed(_option) from error


def _of_drive(
    drive: Drive,
    joint: int | None,
    torque: float | None,
    speed_rpm: float | None,
    changes: dict[str, Any],
    known: Catalogue,
) -> JointDuty:
    """Return the need of a drive, what the options say in place of it: its loads over time are of its own angles."""
    whole = on_duty(drive, speed_rpm, torque)
    try:
        need = joint_duty(whole, joint=joint, known=known)
        if not {"joint_angle", "service_factor"} & changes.keys():
            need = over_time(need, whole, joint=joint, known=known)
        return replace(need, **changes)
    except InputError as error:
        raise error.renamed(_option) from error
