"""``cardan strength``: is every part strong enough, how much may the drive carry, and how large must a part be?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, TypeAlias

import typer

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Force, MoreRows, Plot, SpeedRpm

Hold: TypeAlias = Literal["ratio", "wall", "outer"]


def strength(
    file: DriveFile,
    part: Annotated[
        str | None,
        typer.Option(
            "--size",
            metavar="PART",
            help=_(
                "Size a part: tube:2, shaft:2 (solid), journal:1, needles:1, joint:1, or joint for all joints; the "
                "number may be left out where there is one."
            ),
            show_default=False,
        ),
    ] = None,
    hold: Annotated[
        Hold,
        typer.Option(
            "--hold",
            metavar="WHAT",
            help=_("What a sized tube keeps: wall over outer diameter (ratio), its wall, or its outer diameter."),
        ),
    ] = "ratio",
    series: Annotated[
        str,
        typer.Option(
            "--series", metavar="SERIES", help=_("What sizes are rounded up to: step (of a drawing), R10, R20 or R40.")
        ),
    ] = "step",
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="PATH",
            help=_("Write the new size into a copy of FILE, comments kept; may be FILE."),
            show_default=False,
        ),
    ] = None,
    force: Force = False,
    more: MoreRows = None,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what every part uses of its limits, the torque rating of the whole drive, or how large a part must be."""
    from .asked import check_options, keys_of, on_duty
    from .show import show

    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    _check(part, out)
    if out is not None:
        from .apply import check_copy

        check_copy(out, file, force=force)

    from cardan.checks.strength.strength import strength as question
    from cardan.io.drive_file import known_to

    from .source import STDIN, read_with_text

    given, text = read_with_text(file, tuple(more or ()))
    drive = on_duty(given, speed_rpm, torque)
    folder, files = Path(".") if file == STDIN else file.parent, tuple(more or ())
    known = known_to(drive, folder, files)
    if part is None:
        from .strength_answer import answer

        with keys_of(file):
            found = question(drive, known=known)
        return show(answer(drive, file, found), json=json, csv=csv, plot=plot)

    from cardan.choices.sizing import size
    from cardan.errors import InputError

    from .progress import watching
    from .sizing_answer import answer as sized
    from .sizing_answer import written

    with keys_of(file), watching(_("searching sizes")):
        try:
            made = size(drive, None, part, hold=hold, series=series, known=known)
        except InputError as error:
            options = {"part": "--size", "hold": "--hold", "series": "--series"}
            raise error.renamed(lambda field: options.get(field, field)) from error
    said = sized(drive, file, made, known)
    if out is not None:
        said = written(said, made, given, text, out, folder=folder, catalogues=files)
    return show(said, json=json, csv=csv, plot=plot)


def _check(part: str | None, out: Path | None) -> None:
    """Refuse to write what is not sized."""
    from cardan.errors import refuse

    if out is not None and part is None:
        raise refuse("--out", _("there is nothing to write; say --size PART"))
