"""``cardan bending``: at which speeds do the shafts whirl, and how far does the drive stay away from them?"""

from __future__ import annotations

from typing import Annotated

from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.output import check_common
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, read
from cardan.cli.shared.tell import tell
from cardan.errors import refuse
from cardan.questions.bending.answer import answer, answer_of_map, ask
from cardan.questions.bending.bending import MOST, critical_speed_map
from cardan.texts import _


def bending(
    file: DriveFile,
    modes: Annotated[int, option("--modes", "N", _("How many critical speeds."))] = 3,
    over: Annotated[
        bool,
        flag(
            "--map", _("Critical speeds over the stiffness of a support, or the length of a shaft where all are rigid.")
        ),
    ] = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell at which speeds the shafts whirl, what moves there, and how far the drive stays away."""
    check_common(json=json, csv=csv, plot=plot)
    if not 1 <= modes <= MOST:
        text = _("{value} is not allowed; allowed is 1 to {most}")
        raise refuse("--modes", text.format(value=modes, most=MOST))
    drive = read(file)
    with keys_of(file):
        result = ask(drive, modes=modes)
        said = answer_of_map(drive, result, critical_speed_map(drive, modes=modes)) if over else answer(drive, result)
    return tell(said, file, drive, json=json, csv=csv, plot=plot)
