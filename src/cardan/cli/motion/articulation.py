"""``cardan articulation``: how does the drive turn and slide while it moves?"""

from __future__ import annotations

from math import isfinite
from typing import Annotated, Any

import numpy as np

from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import option
from cardan.cli.shared.output import check_common, check_speed
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check
from cardan.questions.motion.articulation_answer import answer, ask
from cardan.texts import _
from cardan.units import rpm

MOST_INSTANTS = 1_000_000  # more instants than this are refused


def articulation(
    file: DriveFile,
    until: Annotated[
        float | None, option("--until-s --until", "S", _("Time span from 0, instead of a whole period."))
    ] = None,
    step: Annotated[
        float | None,
        option("--step-s --step", "S", _("Step of --until-s; fine enough to follow the movement by default.")),
    ] = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how the drive turns and slides while it moves."""
    check_common(json=json, csv=csv, plot=plot)
    check_times(until, step)
    check_speed(speed_rpm)
    drive = read(file)
    times = instants(until, step)
    speed = None if speed_rpm is None else speed_rpm * rpm
    with keys_of(file):
        result = ask(drive, times=times, until=until if times is None else None, speed=speed)
    return tell(answer(drive, result), file, drive, json=json, csv=csv, plot=plot)


def check_times(until: float | None, step: float | None) -> None:
    """Refuse a time span or step that makes no series of instants."""
    problems = [
        Problem(option, _("{value} is not allowed; allowed is a finite time above 0").format(value=value))
        for option, value in (("--until-s", until), ("--step-s", step))
        if value is not None and not (isfinite(value) and value > 0.0)
    ]
    if step is not None and until is None:
        problems.append(Problem("--step-s", _("belongs to --until-s; how long shall it last?")))
    if not problems and step is not None and until is not None and until / step > MOST_INSTANTS:
        text = _("{count:.3g} instants asked for; the limit is {limit}")
        problems.append(Problem("--step-s", text.format(count=until / step, limit=MOST_INSTANTS)))
    check(problems)


def instants(until: float | None, step: float | None) -> Any:
    """Return the instants asked for [s], or None for those that fit the movement."""
    if until is None or step is None:
        return None
    return step * np.arange(int(until / step + 1e-9) + 1)
