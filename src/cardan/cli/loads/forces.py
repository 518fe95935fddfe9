"""``cardan forces``: what does every shaft, joint and bearing carry?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from cardan.cli.motion.motion import check_positions, positions
from cardan.cli.shared import mechanisms
from cardan.cli.shared.asked import CurveAngle, CurveStep, TorqueNm, check_options, keys_of, on_duty
from cardan.cli.shared.options import option
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import AsCsv, AsJson, EitherFile, Plot, SpeedRpm, read_either
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.drive.movement import Movement
from cardan.errors import refuse
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.forces import moving_answer
from cardan.questions.forces.answer import answer, followed
from cardan.questions.forces.forces import forces as question
from cardan.questions.forces.moving_forces import moving_forces
from cardan.questions.gathering import principal
from cardan.register import QUESTIONS
from cardan.texts import _

ALL = "all"  # stands for every movement of the file


def forces(
    file: EitherFile,
    angle: CurveAngle = None,
    step: CurveStep = None,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    movement: Annotated[
        list[str] | None,
        option(
            "--movement",
            "NAME",
            _("Movement of the file that runs meanwhile: its name or number, or all; may be repeated."),
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what every shaft, joint and bearing carries over a turn."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    check_positions(angle, step)
    if movement and (angle or step is not None):
        raise refuse("--movement", _("is followed in time; --angle-deg and --angle-step-deg are of a standing drive"))
    thing = read_either(file)
    if isinstance(thing, Mechanism):
        if movement:
            raise refuse("--movement", _("is of drives; a mechanism moves by its input"))
        machine = mechanisms.on_duty(thing, speed_rpm, torque)
        asked = mechanisms.angles(machine, angle, step)
        return mechanisms.told("forces", machine, file, asked, listed=False, json=json, csv=csv, plot=plot)
    whole = on_duty(thing, speed_rpm, torque)
    drive = principal(QUESTIONS["forces"], whole)
    if movement:
        moves = _chosen(drive, movement)
        with keys_of(file), watching(_("following the movement")) as progress:
            moving = moving_forces(drive, None, moves, progress=progress)
        return tell(moving_answer.answer(drive, moving), file, drive, alone=True, json=json, csv=csv, plot=plot)
    with keys_of(file):
        found = question(drive)
    curves = question(drive, angle=positions(angle, step or 1.0)) if angle or step else None
    said = answer(drive, followed(drive, found), curves)
    return tell(said, file, drive, whole=whole, json=json, csv=csv, plot=plot)


def _chosen(drive: Drive, names: Sequence[str]) -> tuple[Movement, ...]:
    """Return the movements that are asked for by names or numbers from 1, in the order of the file."""
    if not drive.movements:
        raise refuse("--movement", _("the file has no [[movements]]"))
    if ALL in names:
        return drive.movements
    known = {str(k): k for k in range(1, len(drive.movements) + 1)}
    known |= {one.name: k for k, one in enumerate(drive.movements, 1) if one.name}
    for name in names:
        if name not in known:
            there = ", ".join(f"{k} {one.name}".strip() for k, one in enumerate(drive.movements, 1))
            text = _("there is no movement {name}; there is {known}, or {all} of them")
            raise refuse("--movement", text.format(name=repr(name), known=there, all=ALL))
    wanted = {known[name] for name in names}
    return tuple(one for k, one in enumerate(drive.movements, 1) if k in wanted)
