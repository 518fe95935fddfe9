"""``cardan motion``: how does every shaft turn?"""

from __future__ import annotations

import math
from typing import Annotated, Any

import numpy as np

from cardan.cli.shared import mechanisms
from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.output import check_common, check_speed
from cardan.cli.shared.source import AsCsv, AsJson, EitherFile, Plot, SpeedRpm, read_either
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.motion.answer import answer, ask
from cardan.texts import _
from cardan.units import deg, rpm

STEP = 30.0  # step of the printed table [deg]; JSON, CSV and figures have steps of one degree
MOST_POSITIONS = 1_000_000  # more positions than this would not fit a table anyone reads


def motion(
    file: EitherFile,
    angle: Annotated[
        list[float] | None,
        option(
            "--angle-deg --angle",
            "DEG",
            _("Input angle from the start position; may be repeated. Instead of a whole turn."),
        ),
    ] = None,
    step: Annotated[
        float | None,
        option(
            "--angle-step-deg --angle-step",
            "DEG",
            _("Step of the input angle over one turn: 30 in the table, 1 otherwise."),
        ),
    ] = None,
    table: Annotated[bool, flag("--table", _("Print a table over the input angle, too."))] = False,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how every shaft turns: angle, speed ratio, acceleration."""
    check_common(json=json, csv=csv, plot=plot)
    check_positions(angle, step)
    check_speed(speed_rpm)
    drive = read_either(file)
    if isinstance(drive, Mechanism):
        machine = mechanisms.on_duty(drive, speed_rpm)
        asked = mechanisms.angles(machine, angle, step)
        return mechanisms.told("motion", machine, file, asked, listed=table, json=json, csv=csv, plot=plot)
    speed = drive.duty.speed if speed_rpm is None else speed_rpm * rpm
    listed = positions(angle, step or STEP) if table or angle or step is not None else None
    with keys_of(file):
        result = ask(drive, positions(angle, step or 1.0), speed=speed, listed=listed)
    return tell(answer(drive, result), file, drive, json=json, csv=csv, plot=plot)


def check_positions(angle: list[float] | None, step: float | None) -> None:
    """Refuse positions that are not numbers, that contradict each other, or that are too many."""
    problems = []
    if angle and step is not None:
        problems.append(Problem("--angle-step-deg", _("choose --angle-deg or --angle-step-deg, not both")))
    problems += [
        Problem("--angle-deg", _("{value} is not a finite number").format(value=value))
        for value in angle or ()
        if not math.isfinite(value)
    ]
    if step is not None and not 360.0 / MOST_POSITIONS <= step <= 360.0:
        text = _("{value} is not allowed; allowed is {low:g} to 360")
        problems.append(Problem("--angle-step-deg", text.format(value=step, low=360.0 / MOST_POSITIONS)))
    check(problems)


def positions(angle: list[float] | None, step: float) -> Any:
    """Return the input angles asked for [rad]: those given, or one turn with both its ends."""
    return deg * (np.asarray(angle) if angle else step * np.arange(int(360.0 / step + 1e-9) + 1))
