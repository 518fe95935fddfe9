"""``cardan torsion response``: how do the shafts vibrate in torsion, at a speed or over many?"""

from __future__ import annotations

from dataclasses import replace

from cardan.cli.shared.asked import TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.questions.gathering import principal
from cardan.questions.torsion.steady.answer import answer
from cardan.questions.torsion.steady.torsion_response import torsion_response as question
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import rpm

from .torsion_parts import RUNNING, Pieces, Speeds, at_speed, values


def torsion_response(
    file: DriveFile,
    speed_rpm: SpeedRpm = None,
    speeds: Speeds = None,
    torque: TorqueNm = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how the shafts vibrate in torsion while the drive runs steadily."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    asked = None if speeds is None else values(speeds, "--speeds", low=0.0)
    whole = at_speed(on_duty(read(file), None, torque), speed_rpm)
    asks = RUNNING
    if asked is not None:
        ends = float(asked[0]) * rpm, float(asked[-1]) * rpm
        asks, whole = QUESTIONS["orders"], replace(whole, duty=replace(whole.duty, speed_range=ends))
    drive = principal(asks, whole)
    with keys_of(file), keeping(_("finding steady motions")) as progress:
        found = question(drive, speed=None if asked is None else asked * rpm, pieces=pieces, progress=progress)
    said = answer(drive, found)
    return ended(tell(said, file, drive, whole=whole, asks=asks, json=json, csv=csv, plot=plot), progress)
