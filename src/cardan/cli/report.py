"""``cardan report``: everything on one page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cardan.texts import _
from cardan.units import thousands

from .options import AsJson, DriveFile, SpeedRpm


def report(
    file: DriveFile,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="PATH",
            help=_("File to write: .html, .pdf or a workbook, .xlsx; FILE's name with .html by default."),
            show_default=False,
        ),
    ] = None,
    interactive: Annotated[
        bool,
        typer.Option(
            "--interactive", help=_("Figures to point at, zoom and turn; some megabytes more."), show_default=False
        ),
    ] = False,
    open_: Annotated[
        bool, typer.Option("--open", help=_("Open the report when it is written."), show_default=False)
    ] = False,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
) -> int:
    """Put everything on one page."""
    from .output import check_report_target, check_speed
    from .source import STDIN, read_with_text

    place = out or Path("report.html" if file == STDIN else f"{file.stem}.html")
    check_report_target(place, interactive=interactive)
    check_speed(speed_rpm)
    drive, text = read_with_text(file)

    from dataclasses import replace

    from cardan.answers.reader import reader
    from cardan.io.drive_file import known_to
    from cardan.report.report import report as write
    from cardan.units import rpm

    from .progress import watching

    if speed_rpm is not None:
        drive = replace(drive, duty=replace(drive.duty, speed=speed_rpm * rpm))
    who = reader()
    with watching(_("writing the report")) as progress:
        known = known_to(drive, "." if file == STDIN else file.parent)
        write(
            drive,
            None,
            place,
            source_text=text,
            interactive=interactive,
            progress=progress,
            known=known,
            units=who.units,
            decimal=who.decimal,
        )

    from cardan.questions.motion.answer import sentence
    from cardan.questions.motion.swing import each_shaft

    from .answer import Answer, Remark
    from .show import show
    from .source import title

    opened = open_ and _opened(place)
    browsed = place.suffix.lower() in (".html", ".htm")
    hint = _("Open {path} in a browser, or print it.") if browsed else _("Open {path}, or print it.")
    if opened:
        hint = _("It is open: {path}.")
    if open_ and not opened:
        hint = _("No program answered; open {path} yourself.")
    return show(
        Answer(
            sentence=f"{title(drive, file)}: {sentence(drive, each_shaft(drive)).told(who)}",
            remarks=(
                Remark(text=_("Report written: {path}, {size} kB.").format(path=place, size=_kilobytes(place))),
                Remark(text=hint.format(path=place), tone="next"),
            ),
            content=lambda: {"question": "report", "drive": drive.name, "file": str(file), "report": str(place)},
        ),
        json=json,
    )


def _kilobytes(path: Path) -> str:
    return thousands(path.stat().st_size / 1000)


def _opened(path: Path) -> bool:
    import webbrowser

    return webbrowser.open(path.resolve().as_uri())
