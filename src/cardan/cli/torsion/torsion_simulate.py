"""``cardan torsion simulate``: how do torques and speeds run in time?"""

from __future__ import annotations

from math import isfinite
from typing import Annotated

from cardan.cli.shared.asked import TorqueNm, check_options, on_duty
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.errors import refuse
from cardan.questions.torsion.transient.answer import answer
from cardan.questions.torsion.transient.torsion_transient import Start
from cardan.questions.torsion.transient.torsion_transient import transient as question
from cardan.texts import _

from .torsion_band import asked_of
from .torsion_parts import Pieces

MOST_SAMPLES = 1_000_000  # more samples than this are refused


def torsion_simulate(
    file: DriveFile,
    span: Annotated[
        float | None,
        option("--span-s --span", "S", _("How long; behind the run-up or to the end of the history, else some turns.")),
    ] = None,
    samples: Annotated[int, option("--samples", "N", _("Samples of the curves."), min=2, max=MOST_SAMPLES)] = 2001,
    settled: Annotated[bool, flag("--settled", _("Start from the steady motion, not from untwisted shafts."))] = False,
    speed_rpm: SpeedRpm = None,
    torque: TorqueNm = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how torques and speeds run in time."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    if span is not None and not (isfinite(span) and span > 0.0):
        raise refuse("--span-s", _("{value} is not allowed; allowed is a finite time above 0").format(value=span))
    drive = on_duty(read(file), speed_rpm, torque)
    start: Start = "settled" if settled else "even"
    with asked_of(file, {"span": "--span-s"}), keeping(_("following the motion")) as progress:
        found = question(drive, span=span, times=samples, start=start, pieces=pieces, progress=progress)
    return ended(tell(answer(drive, found), file, drive, json=json, csv=csv, plot=plot), progress)
