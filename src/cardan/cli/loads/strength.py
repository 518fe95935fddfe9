"""``cardan strength``: is every part strong enough, how much may the drive carry, and how large must a part be?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from cardan.catalogue import known_to
from cardan.checks.strength.answer import answer, with_events
from cardan.checks.strength.strength import strength as ask
from cardan.choices import sizing_answer
from cardan.choices.size_search import Sizing
from cardan.choices.sizing import size
from cardan.cli.shared.apply import check_copy
from cardan.cli.shared.asked import TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.options import option
from cardan.cli.shared.output import write_text
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, DriveFile, Force, MoreRows, Plot, SpeedRpm, read_with_text
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import with_values
from cardan.errors import InputError, refuse
from cardan.io import dumps
from cardan.io.edit import edit
from cardan.texts import _

Hold: TypeAlias = Literal["ratio", "wall", "outer"]

OPTIONS = {"part": "--size", "hold": "--hold", "series": "--series"}


def strength(
    file: DriveFile,
    part: Annotated[
        str | None,
        option(
            "--size",
            "PART",
            _(
                "Size a part: tube:2, shaft:2 (solid), journal:1, needles:1, joint:1, or joint for all joints; the "
                "number may be left out where there is one."
            ),
        ),
    ] = None,
    hold: Annotated[
        Hold,
        option(
            "--hold",
            "WHAT",
            _("What a sized tube keeps: wall over outer diameter (ratio), its wall, or its outer diameter."),
        ),
    ] = "ratio",
    series: Annotated[
        str, option("--series", "SERIES", _("What sizes are rounded up to: step (of a drawing), R10, R20 or R40."))
    ] = "step",
    out: Annotated[
        Path | None,
        option("--out -o", "PATH", _("Write the new size into a copy of FILE, comments kept; may be FILE.")),
    ] = None,
    force: Force = False,
    more: MoreRows = None,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell the utilisation of every part, the torque rating of the whole drive, or how large a part must be."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    if out is not None and part is None:
        raise refuse("--out", _("there is nothing to write; say --size PART"))
    if out is not None:
        check_copy(out, file, force=force)
    files = tuple(more or ())
    given, text = read_with_text(file, files)
    drive = on_duty(given, speed_rpm, torque)
    folder = Path(".") if file == STDIN else file.parent
    known = known_to(drive, folder, files)
    if part is None:
        with keys_of(file):
            said = answer(drive, with_events(drive, ask(drive, known=known)))
        return tell(said, file, drive, json=json, csv=csv, plot=plot)
    with keys_of(file), watching(_("searching sizes")):
        try:
            made = size(drive, None, part, hold=hold, series=series, known=known)
        except InputError as error:
            raise error.renamed(lambda field: OPTIONS.get(field, field)) from error
    with watching(_("comparing tubes")) as progress:
        said = sizing_answer.answer(drive, made, known=known, progress=progress)
        if out is not None:
            write_text(out, _written(made, given, text, out, folder, files), "--out")
            said = sizing_answer.written(said, made, str(out))
        return tell(said, file, drive, json=json, csv=csv, plot=plot)


def _written(found: Sizing, drive: Drive, text: str, out: Path, folder: Path, catalogues: tuple[Path, ...]) -> str:
    """Return a drive file with the new size in it, its comments kept where it is TOML."""
    if not found.found:
        raise refuse("--out", _("no size passes; nothing is written"))
    values = dict(found.values)
    if out.suffix.lower() == ".json" or text.lstrip().startswith("{"):
        return dumps(with_values(drive, values), form="json" if out.suffix.lower() == ".json" else "toml")
    return edit(text, values, folder=folder, catalogues=catalogues)
