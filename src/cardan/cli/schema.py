"""``cardan schema``: the JSON Schema of the drive file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cardan.texts import _

from .options import AsJson


def schema(
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="PATH", help=_("Write it to PATH instead."), show_default=False),
    ] = None,
    mechanism: Annotated[
        bool, typer.Option("--mechanism", help=_("That of the mechanism file instead."), show_default=False)
    ] = False,
    json: AsJson = False,
) -> int:
    """Print the JSON Schema of the drive file."""
    from .answer import Answer
    from .output import check_target, write_text
    from .show import as_json, print_text, show

    if out is not None:
        check_target(out, "--out")

    from cardan.io import mechanism_schema
    from cardan.io import schema as drive_schema

    text = as_json(mechanism_schema() if mechanism else drive_schema()) + "\n"
    if out is None:
        print_text(text)
        return 0
    write_text(out, text, "--out")
    said = (
        _("{path}: schema of the mechanism file written.")
        if mechanism
        else _("{path}: schema of the drive file written.")
    )
    return show(Answer(sentence=said.format(path=out)), json=json)
