"""``cardan diagnose``: a machine shakes, here is a recording; what is wrong with it, and what to check first?"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from cardan.answers.answer import FILE, Answer, Remark
from cardan.answers.reader import reader
from cardan.catalogue import catalogue, known_to
from cardan.catalogue.catalogue import with_files
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_common, check_target
from cardan.cli.shared.progress import watching
from cardan.cli.shared.recording import FullScale, Places, Pulses, Rate, Reading, Tacho, Titles, placed, read_both
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, MoreRows, Plot
from cardan.cli.shared.tell import tell
from cardan.cli.torsion.torsion_band import band_of
from cardan.errors import InputError, Problem, refuse
from cardan.files import write_bytes
from cardan.io.signals import SIGNAL_FORMATS
from cardan.questions.diagnosis.answer import answer, answer_of_signs
from cardan.questions.diagnosis.examination import Examination, examine
from cardan.questions.diagnosis.findings import diagnose as causes_of
from cardan.questions.diagnosis.match import Signs, symptoms
from cardan.report.block import page
from cardan.report.content import Excerpt
from cardan.report.render.renderer import Renderer, form_of
from cardan.texts import _
from cardan.units import nearest

LEAST = 0.1  # share of the largest order below which one does not count


def diagnose(
    recording: Annotated[
        Path | None, argument("SIGNAL", _("Recording: .csv, .txt, .wav, .uff, .unv or .tdms."))
    ] = None,
    file: Annotated[Path | None, argument("DRIVE", _("Drive file, TOML or JSON; - reads standard input."))] = None,
    tacho: Tacho = None,
    pulses_per_turn: Pulses = 1.0,
    rate: Rate = None,
    title: Titles = None,
    place: Places = None,
    full_scale: FullScale = None,
    speeds: Annotated[
        str | None,
        option(
            "--speeds", "LOW:HIGH", _("Least and greatest speed of the shaft in rpm, for a recording without a tacho.")
        ),
    ] = None,
    channel: Annotated[
        str | None,
        option("--channel", "CHANNEL", _("Channel whose orders are shown; the one with the highest line otherwise.")),
    ] = None,
    orders: Annotated[
        str | None,
        option("--orders", "N,N…", _("Orders seen, as 1,2 or 1=3.2,2=5 with their sizes, instead of a recording.")),
    ] = None,
    torque_sensitive: Annotated[
        bool | None,
        flag("--with-torque/--no-torque", _("With --orders or --symptom: whether it changes with the torque.")),
    ] = None,
    symptom: Annotated[
        str | None,
        option("--symptom", "NAME", _("What is noticed, instead of a recording, as clunk_on_load_reversal.")),
    ] = None,
    report: Annotated[
        Path | None,
        option("--report -o", "PATH", _("Write the diagnosis with its pictures into PATH: .html, .pdf or .xlsx.")),
    ] = None,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what is likely wrong with a drive by a recording of it, what speaks for it, and what to check."""
    check_common(json=json, csv=csv, plot=plot)
    form = None if report is None else _form(report)
    catalogues = tuple(more or ())
    name = ""
    if orders is not None or symptom is not None or torque_sensitive is not None:
        if recording is not None:
            raise refuse("--orders", _("neither a recording nor a drive file is read beside orders and symptoms"))
        signs = _signs(orders, symptom, torque_sensitive)
        known = with_files(catalogue(), catalogues) if catalogues else None
        said = answer_of_signs(signs, causes_of(signs, known=known))
    else:
        recording, file = _files(recording, file)
        how = Reading(
            tacho=tacho,
            pulses_per_turn=pulses_per_turn,
            rate=rate,
            titles=tuple(title or ()),
            places=tuple(place or ()),
            full_scale=tuple(full_scale or ()),
        )
        examined = _examined(recording, file, how, band_of(speeds), channel, catalogues)
        name = examined.drive.name
        said = _with_next(answer(examined), file, how, () if speeds is None else ("--speeds", speeds))
    if report is not None and form is not None:
        said = _written(said, name, report, form)
    return tell(said, recording, json=json, csv=csv, plot=plot)


def _form(path: Path) -> Renderer:
    """Return the form of a report, or refuse its file before any work is done."""
    form = form_of(path, "--report")
    check_target(path, "--report")
    return form


def _with_next(said: Answer, file: Path, how: Reading, band: tuple[str, ...]) -> Answer:
    """Return an answer with its drive file, and with the command that reports it."""
    command = ("cardan", "diagnose", FILE, str(file), *how.arguments, *band, "--report", "diagnosis.html")
    more = Remark(text=_("Everything with its pictures:"), command=command, tone="next")
    return replace(said, remarks=(*said.remarks, more), facts={**said.facts, "file": str(file)})


def _written(said: Answer, title: str, path: Path, form: Renderer) -> Answer:
    """Write the report of an answer, and return the answer that says so."""
    write_bytes(path, form.excerpt(Excerpt(title=title or said.title, page=page(said, reader()))))
    kept = tuple(one for one in said.remarks if one.tone != "next")
    more = Remark(text=_("Report written: {path}.").format(path=path))
    return replace(said, remarks=(*kept, more), facts={**said.facts, "report": str(path)})


def _files(recording: Path | None, file: Path | None) -> tuple[Path, Path]:
    """Return the recording and the drive, refusing what is missing or in the wrong order."""
    problems = []
    if recording is None:
        problems.append(Problem("SIGNAL", _("missing: the recording; or say what was seen with --orders or --symptom")))
    elif file is None:
        problems.append(Problem("DRIVE", _("missing: the drive file of what was recorded")))
    if problems or recording is None or file is None:
        raise InputError(problems)
    if recording.suffix.lower() in (".toml", ".json") and file.suffix.lower() in SIGNAL_FORMATS:
        text = _("the recording stands first: cardan diagnose {signal} {drive}")
        raise refuse("", text.format(signal=file, drive=recording))
    return recording, file


def _signs(orders: str | None, symptom: str | None, torque_sensitive: bool | None) -> Signs:
    """Return what was seen, or refuse what is no sign; all at once."""
    problems = []
    if symptom is not None and symptom not in symptoms():
        near = nearest(symptom, symptoms())
        text = _("{value} is none of {choices}").format(value=repr(symptom), choices=", ".join(symptoms()))
        text += _("; the nearest is {near}").format(near=near) if near else ""
        problems.append(Problem("--symptom", text, "out_of_range"))
    found = []
    sizes = []
    for part in (orders or "").split(",") if orders is not None else ():
        order, sign, size = part.strip().partition("=")
        try:
            found.append(float(order))
            sizes.append(float(size) if sign else 1.0)
            if not 0.0 < sizes[-1] < math.inf:
                raise ValueError
        except ValueError:
            text = _("not an order: {text}; write them as 1,2 or 1=3.2,2=5")
            problems.append(Problem("--orders", text.format(text=repr(part.strip()))))
    if not problems:
        try:
            told = tuple(order for order, size in zip(found, sizes, strict=True) if size >= LEAST * max(sizes))
            return Signs(orders=told, symptom=symptom, torque_sensitive=torque_sensitive)
        except InputError as error:
            raise error.renamed(lambda field: "--orders" if field.startswith("orders") else field) from error
    raise InputError(problems)


def _examined(
    path: Path,
    drive_path: Path,
    how: Reading,
    limits: tuple[float, float] | None,
    channel: str | None,
    catalogues: tuple[Path, ...],
) -> Examination:
    """Return what the recording tells of the drive; what is wrong with both files at once."""
    with watching(_("looking for causes")) as progress:
        signal, drive = read_both(path, drive_path, how, catalogues, lambda share: progress(0.5 * share))
        signal = placed(signal, how.places, drive)
        known = known_to(drive, "." if drive_path == STDIN else drive_path.parent, catalogues)
        with about(str(path)):
            try:
                return examine(
                    signal,
                    drive,
                    channel=channel,
                    speed_range=limits,
                    known=known,
                    progress=lambda share: progress(0.5 + 0.5 * share),
                )
            except InputError as error:
                names = {"channel": "--channel" if channel is not None else "", "signal": ""}
                raise error.renamed(lambda field: names.get(field, field)) from error
