"""``cardan mobility``: will it turn, which constraints are redundant, and what to release?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag
from cardan.cli.shared.output import check_common
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, Plot, form_of, stdin_text
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.io import load_either, loads_either
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.mobility.answer import answer, turned
from cardan.questions.mobility.mobility import mobility as question
from cardan.texts import _


def mobility(
    file: Annotated[Path, argument("FILE", _("Drive or mechanism file, TOML or JSON; - reads standard input."))],
    turn: Annotated[bool, flag("--turn", _("Follow it over a turn of the input."))] = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell whether a drive or mechanism turns, and its redundant constraints."""
    check_common(json=json, csv=csv, plot=plot)
    thing = _read(file)
    with keys_of(file), watching(_("following a turn")) as progress:
        found = question(thing)
        around = turned(thing, progress) if turn else None
    return tell(answer(thing, found, around), file, thing, json=json, csv=csv, plot=plot)


def _read(path: Path) -> Drive | Mechanism:
    """Return the drive or mechanism of a file, or of standard input when the path is ``-``."""
    name = _("standard input") if path == STDIN else str(path)
    with about(name):
        if path != STDIN:
            return load_either(path)
        text = stdin_text()
        return loads_either(text, form=form_of(path, text), name=name)
