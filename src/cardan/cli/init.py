"""``cardan init``: a commented drive file to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cardan.texts import _

from .options import AsJson


def init(
    file: Annotated[
        Path,
        typer.Argument(metavar="FILE", help=_("File to write, TOML; - prints it."), show_default=False),
    ],
    force: Annotated[bool, typer.Option("--force", help=_("Overwrite FILE."), show_default=False)] = False,
    json: AsJson = False,
) -> int:
    """Write a commented drive file to start from."""
    from .answer import Answer, Remark
    from .output import check_new, write_text
    from .show import print_text, show
    from .source import STDIN

    if file != STDIN:
        check_new(file, force=force)

    from cardan.io import starter

    if file == STDIN:
        print_text(starter())
        return 0
    write_text(file, starter(), "FILE")
    return show(
        Answer(
            sentence=_("{file}: a drive of two joints written, every line explained.").format(file=file),
            tone="good",
            remarks=(
                Remark(text=_("Put your numbers in, then:"), command=("cardan", "report", str(file)), tone="next"),
                Remark(text=_("Other starting points:"), command=("cardan", "example"), tone="next"),
            ),
            content=lambda: {"file": str(file)},
        ),
        json=json,
    )
