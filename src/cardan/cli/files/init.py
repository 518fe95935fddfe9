"""``cardan init``: a commented drive file to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.answers.answer import Answer, Remark
from cardan.cli.shared.options import argument, flag
from cardan.cli.shared.output import check_new, print_text, write_text
from cardan.cli.shared.source import STDIN, AsJson
from cardan.cli.shared.tell import tell
from cardan.io import starter
from cardan.texts import _


def init(
    file: Annotated[Path, argument("FILE", _("File to write, TOML; - prints it."))],
    force: Annotated[bool, flag("--force", _("Overwrite FILE."))] = False,
    json: AsJson = False,
) -> int:
    """Write a commented drive file to start from."""
    if file == STDIN:
        print_text(starter())
        return 0
    check_new(file, force=force)
    write_text(file, starter(), "FILE")
    return tell(
        Answer(
            name="init",
            title=_("Drive file to start from"),
            sentence=_("{file}: a drive of two joints written, every line explained.").format(file=file),
            tone="good",
            remarks=(
                Remark(text=_("Put your numbers in, then:"), command=("cardan", "report", str(file)), tone="next"),
                Remark(text=_("Other starting points:"), command=("cardan", "example"), tone="next"),
            ),
            facts={"file": str(file)},
        ),
        json=json,
    )
