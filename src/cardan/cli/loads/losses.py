"""``cardan losses``: how much of the power is lost, and where?"""

from __future__ import annotations

from typing import Annotated

from cardan.cli.shared.asked import TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.options import flag
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.errors import refuse
from cardan.questions.losses.answer import answer, ask
from cardan.questions.losses.losses import loss_map
from cardan.texts import _


def losses(
    file: DriveFile,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    over: Annotated[
        bool, flag("--map", _("Efficiency and power loss over speed and torque, around those of the duty."))
    ] = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how much of the power is lost, part by part."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    drive = on_duty(read(file), speed_rpm, torque)
    if over and drive.duty.torque == 0.0:
        raise refuse("--map", _("spans a tenth to one and a half of the torque, and that is 0; say --torque-Nm"))
    with keys_of(file):
        found = ask(drive)
        table = loss_map(drive) if over and not found.locked else None
    return tell(answer(drive, found, table), file, drive, json=json, csv=csv, plot=plot)
