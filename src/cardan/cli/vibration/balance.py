"""``cardan balance``: what unbalance may each shaft have, and what cancels what it has?"""

from __future__ import annotations

from typing import Annotated

from cardan.catalogue import known_to
from cardan.cli.shared.asked import check_options, keys_of, on_duty
from cardan.cli.shared.options import option
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, DriveFile, MoreRows, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.errors import InputError
from cardan.questions.bending.balance_answer import answer, ask
from cardan.texts import _


def balance(
    file: DriveFile,
    grade: Annotated[
        str | None, option("--grade", "GRADE", _("Balance grade, as G16 or G40, instead of the one in the file."))
    ] = None,
    speed_rpm: SpeedRpm = None,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Tell what unbalance each shaft may have, the force of it, and the masses that cancel what was measured."""
    check_options(speed_rpm, json=json, csv=csv)
    files = tuple(more or ())
    drive = on_duty(read(file, files), speed_rpm, None)
    known = known_to(drive, "." if file == STDIN else file.parent, files)
    with keys_of(file):
        try:
            result = ask(drive, grade=grade, known=known)
        except InputError as error:
            raise error.renamed(lambda field: "--grade" if field == "grade" else field) from error
    return tell(answer(drive, result), file, drive, json=json, csv=csv)
