"""``cardan life``: how long do the joints last?"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from cardan.cli.shared.asked import TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.options import option
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.questions.life.answer import answer, ask
from cardan.questions.life.lives import METHODS
from cardan.texts import _


def life(
    file: DriveFile,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    method: Annotated[
        str | None,
        option(
            "--method",
            "METHOD",
            _("By which the first joint to fail is found: iso, simple (mean load), maker or book."),
        ),
    ] = None,
    reliability: Annotated[
        float | None,
        option(
            "--reliability-percent",
            "PERCENT",
            _("Share of joints that reach the life: 50 to 99.999, instead of the one in the file."),
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how long the joints last, by ISO 281, maker and handbook side by side."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    if method is not None and method not in METHODS:
        text = _("{value} is none of {choices}")
        raise refuse("--method", text.format(value=method, choices=", ".join(METHODS)))
    if reliability is not None and not 50.0 <= reliability <= 99.999:
        raise refuse("--reliability-percent", _("{value} is not from 50 to 99.999").format(value=reliability))
    drive = _asked(read(file), speed_rpm, torque, reliability)
    with keys_of(file):
        result = ask(drive, method=method)
    return tell(answer(drive, result), file, drive, json=json, csv=csv, plot=plot)


def _asked(drive: Drive, speed_rpm: float | None, torque: float | None, reliability: float | None) -> Drive:
    """Return a drive with what the command line says."""
    if torque is None and speed_rpm is not None and (drive.duty.blocks or drive.duty.cases):
        raise refuse("--speed-rpm", _("every load case has its own speed; with --torque-Nm the duty is steady"))
    asked = on_duty(drive, speed_rpm, torque)
    if reliability is None:
        return asked
    return replace(asked, duty=replace(asked.duty, reliability=reliability / 100.0))
