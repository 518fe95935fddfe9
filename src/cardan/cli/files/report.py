"""``cardan report``: everything on one page."""

from __future__ import annotations

import webbrowser
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from cardan.answers.answer import Answer, Remark
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.reader import reader
from cardan.catalogue import known_to
from cardan.cli.shared import mechanisms
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_speed, check_target
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import STDIN, AsJson, EitherFile, SpeedRpm, either_with_text, read_with_text
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.drive.settings import TitleBlock
from cardan.errors import Problem, check
from cardan.files import write_bytes
from cardan.later import later
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.motion.answer import sentence
from cardan.questions.motion.turning import each_shaft
from cardan.reading.fields import fields_of
from cardan.report.block import capital
from cardan.report.content import Excerpt
from cardan.report.look import look_of
from cardan.report.render.renderer import form_of, renderer_for
from cardan.report.report import report as write
from cardan.texts import _
from cardan.units import rpm

of_mechanism = later("cardan.report.mechanism", of="content")
several = later("cardan.report.compare")
"""Reports of a mechanism, and of several drives side by side."""


def _headed(name: str) -> Any:
    """Return the option that stands in for a key of the title block."""
    key = fields_of(TitleBlock)[name].key
    return option(f"--{name.replace('_', '-')}", "TEXT", capital(_(key.doc)) + ".")


def report(
    file: EitherFile,
    others: Annotated[
        list[Path] | None, argument("[FILE]...", _("More drive files: the report then sets them side by side."))
    ] = None,
    out: Annotated[
        Path | None,
        option(
            "--out -o", "PATH", _("File to write: .html, .pdf or a workbook, .xlsx; FILE's name with .html by default.")
        ),
    ] = None,
    interactive: Annotated[
        bool, flag("--interactive", _("Figures to point at, zoom and turn; some megabytes more."))
    ] = False,
    full: Annotated[
        bool, flag("--full", _("With the appendix: phase polygon, classical approximations, method, the drive file."))
    ] = False,
    open_: Annotated[bool, flag("--open", _("Open the report when it is written."))] = False,
    client: Annotated[str | None, _headed("client")] = None,
    project: Annotated[str | None, _headed("project")] = None,
    drawing_number: Annotated[str | None, _headed("drawing_number")] = None,
    revision: Annotated[str | None, _headed("revision")] = None,
    author: Annotated[str | None, _headed("author")] = None,
    checked_by: Annotated[str | None, _headed("checked_by")] = None,
    date: Annotated[str | None, _headed("date")] = None,
    logo: Annotated[
        Path | None, option("--logo", "PATH", _("PNG or SVG file with the logo in the head of the report."))
    ] = None,
    template: Annotated[
        Path | None,
        option("--template", "PATH", _("File with a firm's own look: colours, type, paper, logo, head and foot.")),
    ] = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
) -> int:
    """Put everything on one page, or several drives side by side."""
    place = out or Path("report.html" if file == STDIN else f"{file.stem}.html")
    renderer_for(place, interactive=interactive, field="--out")
    check_target(place, "--out")
    check_speed(speed_rpm)
    given = {
        "client": client,
        "project": project,
        "drawing_number": drawing_number,
        "revision": revision,
        "author": author,
        "checked_by": checked_by,
        "date": date,
        "logo": None if logo is None else str(logo.resolve()),
    }
    head: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    if others:
        only = {"--full": full, "--interactive": interactive, "--speed-rpm": speed_rpm is not None}
        only |= {"--template": template is not None}
        only |= {f"--{key.replace('_', '-')}": True for key in head}
        alone = _("is for the report of one drive; several are set side by side as their files say")
        check(Problem(option, alone) for option, used in only.items() if used)
        return _compared([file, *others], place, open_=open_, json=json)
    drive, text = either_with_text(file)
    folder = Path() if file == STDIN else file.parent
    if isinstance(drive, Mechanism):
        machine = mechanisms.on_duty(drive, speed_rpm)
        block, look = TitleBlock(**head), None if template is None else look_of(template)
        with about(str(file)), watching(_("writing the report")):
            said = of_mechanism()(machine, block, source_text=text, full=full, folder=folder, look=look)
            write_bytes(place, renderer_for(place, interactive=interactive)(said))
        return _told(place, said.judgement.text, file, machine, open_=open_, json=json)
    if speed_rpm is not None:
        drive = replace(drive, duty=replace(drive.duty, speed=speed_rpm * rpm))
    drive = replace(drive, report=replace(drive.report, **head))
    who = reader()
    with watching(_("writing the report")) as progress:
        known = known_to(drive, folder)
        write(
            drive,
            None,
            place,
            source_text=text,
            full=full,
            interactive=interactive,
            progress=progress,
            known=known,
            units=who.units,
            decimal=who.decimal,
            folder=folder,
            template=template,
        )
    return _told(place, sentence(drive, each_shaft(drive)), file, drive, open_=open_, json=json)


def _compared(files: Sequence[Path], place: Path, *, open_: bool, json: bool) -> int:
    """Write several drives side by side."""
    again = [one for k, one in enumerate(files) if one in files[:k]]
    check(Problem("FILE", _("{path} is given twice").format(path=one)) for one in dict.fromkeys(again))
    stems = [one.stem for one in files]
    names = stems if len(set(stems)) == len(stems) else [str(one) for one in files]
    variants = []
    for name, file in zip(names, files, strict=True):
        drive = read_with_text(file)[0]
        variants.append(several().Variant(name=name, drive=drive, known=known_to(drive, file.parent)))
    with watching(_("comparing the drives")) as progress:
        page = several().compared(variants, progress)
    write_bytes(place, form_of(place, "--out").excerpt(Excerpt(title=", ".join(names), page=page)))
    return _told(place, page.answer, open_=open_, json=json)


def _told(
    place: Path,
    said: Text,
    file: Path | None = None,
    drive: Drive | Mechanism | None = None,
    *,
    open_: bool,
    json: bool,
) -> int:
    """Say what was written."""
    opened = open_ and _opened(place)
    browsed = place.suffix.lower() in (".html", ".htm")
    hint = _("Open {path} in a browser, or print it.") if browsed else _("Open {path}, or print it.")
    if opened:
        hint = _("It is open: {path}.")
    if open_ and not opened:
        hint = _("No program answered; open {path} yourself.")
    size = Quantity(place.stat().st_size / 1000.0, decimals=0)
    return tell(
        Answer(
            name="report",
            title=_("Report"),
            sentence=said,
            remarks=(
                Remark(text=say(_("Report written: {path}, {size} kB."), path=str(place), size=size)),
                Remark(text=hint.format(path=place), tone="next"),
            ),
            facts={"report": str(place)},
        ),
        file,
        drive,
        json=json,
    )


def _opened(path: Path) -> bool:
    return webbrowser.open(path.resolve().as_uri())
