"""``cardan schema``: the JSON Schema of the drive file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.answers.answer import Answer
from cardan.answers.data import as_json
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.output import check_target, print_text, write_text
from cardan.cli.shared.source import AsJson
from cardan.cli.shared.tell import tell
from cardan.io import mechanism_schema
from cardan.io import schema as drive_schema
from cardan.texts import _


def schema(
    out: Annotated[Path | None, option("--out -o", "PATH", _("Write it to PATH instead."))] = None,
    mechanism: Annotated[bool, flag("--mechanism", _("That of the mechanism file instead."))] = False,
    json: AsJson = False,
) -> int:
    """Print the JSON Schema of the drive file."""
    if out is not None:
        check_target(out, "--out")
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
    written = Answer(name="schema", title=_("JSON Schema"), sentence=said.format(path=out), facts={"file": str(out)})
    return tell(written, json=json)
