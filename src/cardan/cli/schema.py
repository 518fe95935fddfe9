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
    json: AsJson = False,
) -> int:
    """Print the JSON Schema of the drive file."""
    from .answer import Answer
    from .output import check_target, write_text
    from .show import as_json, print_text, show

    if out is None:
        from cardan.io import schema as described

        print_text(as_json(described()) + "\n")
        return 0
    check_target(out, "--out")
    from cardan.io import schema as described

    write_text(out, as_json(described()) + "\n", "--out")
    return show(Answer(sentence=_("{path}: schema of the drive file written.").format(path=out)), json=json)
