"""``cardan life``: how long do the joints last?"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm

if TYPE_CHECKING:
    from cardan.drive.drive import Drive

METHODS = ("iso", "simple", "maker", "book")
"""Those of `cardan.questions.life.life`, known here without it."""


def life(
    file: DriveFile,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    method: Annotated[
        str | None,
        typer.Option(
            "--method",
            metavar="METHOD",
            help=_("By which the first joint to fail is found: iso, simple (mean load), maker or book."),
            show_default=False,
        ),
    ] = None,
    reliability: Annotated[
        float | None,
        typer.Option(
            "--reliability-percent",
            metavar="PERCENT",
            help=_("Share of joints that reach the life: 50 to 99.999, instead of the one in the file."),
            show_default=False,
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how long the joints last, by ISO 281, maker and book side by side."""
    from .asked import check_options, keys_of
    from .show import show

    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    _check(method, reliability)

    from cardan.questions.life.life import life as question

    from .life_answer import answer
    from .source import read

    drive = _asked(read(file), speed_rpm, torque, reliability)
    with keys_of(file):
        found = question(drive, method=method)
    return show(answer(drive, file, found), json=json, csv=csv, plot=plot)


def _check(method: str | None, reliability: float | None) -> None:
    """Refuse a method that is none, and a share that no joints reach."""
    from cardan.errors import refuse

    if method is not None and method not in METHODS:
        text = _("{value} is none of {choices}")
        raise refuse("--method", text.format(value=method, choices=", ".join(METHODS)))
    if reliability is not None and not 50.0 <= reliability <= 99.999:
        raise refuse("--reliability-percent", _("{value} is not from 50 to 99.999").format(value=reliability))


def _asked(drive: Drive, speed_rpm: float | None, torque: float | None, reliability: float | None) -> Drive:
    """Return a drive with what the command line says."""
    from dataclasses import replace

    from cardan.errors import refuse

    from .asked import on_duty

    if torque is None and speed_rpm is not None and drive.duty.blocks:
        raise refuse("--speed-rpm", _("every block has its own speed; with --torque-Nm the duty is steady"))
    asked = on_duty(drive, speed_rpm, torque)
    if reliability is not None:
        asked = replace(asked, duty=replace(asked.duty, reliability=reliability / 100.0))
    return asked
