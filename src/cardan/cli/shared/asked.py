"""What the questions about forces share: the duty they are asked for, the keys they miss, the figures they have."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import Annotated, TypeAlias

from cardan.answers import quantity
from cardan.answers.reader import reader
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.wording import needed
from cardan.errors import InputError, Problem, check, refuse
from cardan.questions.gathering import principal
from cardan.reading.ranges import HUGE
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import rpm

from .failure import about
from .options import option
from .output import check_common, check_speed, print_text
from .progress import watching
from .source import STDIN, AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from .tell import tell

TorqueNm: TypeAlias = Annotated[
    float | None, option("--torque-Nm --torque-nm", "NM", _("Torque, instead of the one in the file."))
]

CurveAngle: TypeAlias = Annotated[
    list[float] | None,
    option(
        "--angle-deg --angle",
        "DEG",
        _("Input angle of the curves (--csv, --json); may be repeated. Instead of a whole turn."),
    ),
]
CurveStep: TypeAlias = Annotated[
    float | None, option("--angle-step-deg --angle-step", "DEG", _("Step of the curves over one turn: 1 by default."))
]

SUFFIX = {
    "torque": "Nm", "speed": "rpm", "span": "mm", "outer": "mm", "position": "mm", "journal": "mm", "bore": "mm",
    "capacity": "N", "length": "mm", "mean_diameter": "mm", "mass_centre": "mm", "stiffness": "N_per_um",
    "axial_stiffness": "N_per_um", "tilt_stiffness": "Nm_per_rad",
}  # fmt: skip
"""Field of the drive -> unit that its key in a file is best given in."""


def check_options(
    speed_rpm: float | None = None, torque: float | None = None, *, json: bool, csv: bool, plot: Path | None = None
) -> None:
    """Refuse common options that cannot be, before anything is read."""
    check_common(json=json, csv=csv, plot=plot)
    check_speed(speed_rpm)
    check_torque(torque)


def check_torque(torque: float | None) -> None:
    """Refuse a torque that is not a finite number, or one that no drive has."""
    if torque is None:
        return
    if not isfinite(torque):
        raise refuse("--torque-Nm", _("{value} is not a finite number").format(value=torque))

    if abs(torque) > HUGE:
        raise refuse("--torque-Nm", _("{value} is not allowed; no drive has such a number").format(value=torque))


def on_duty(drive: Drive, speed_rpm: float | None, torque: float | None) -> Drive:
    """Return a drive with the speed [rpm] and torque [N·m] of the command line instead of its own.

    A torque there is steady, and stands in place of load cases, of a duty cycle and of a measured torque too.
    """
    duty = drive.duty
    if speed_rpm is not None:
        duty = replace(duty, speed=speed_rpm * rpm)
    if torque is not None:
        duty = replace(duty, torque=torque, blocks=(), cases=(), torque_history=None)
    return replace(drive, duty=duty)


@contextmanager
def keys_of(file: Path) -> Iterator[None]:
    """Name the file and its keys, with their units, in whatever an answer misses."""
    with about(_("standard input") if file == STDIN else str(file)):
        try:
            yield
        except InputError as error:
            raise InputError(
                replace(one, field=key_of(one.field), message=_hinted(one)) for one in error.problems
            ) from error


def _hinted(problem: Problem) -> str:
    """Return a message with the keys in it as a file has them, and the option that does as well."""
    message = re.sub(r"\b[a-z]+\[\d+\](?:\.[a-z_]+)+", lambda found: key_of(found[0]), problem.message)
    option = {"duty.torque": "--torque-Nm", "duty.speed": "--speed-rpm"}.get(problem.field)
    if option is None or problem.code != "missing":
        return message
    return _("{message}; or say {option}").format(message=message, option=option)


def key_of(field: str) -> str:
    """Return the key of a field in a file."""
    unit = SUFFIX.get(field.rpartition(".")[2])
    if field.endswith(".stiffness") and not field.startswith("supports"):
        unit = "Nm_per_rad"  # a shaft or a station twists
    if unit:
        return f"{field}_{unit}"
    return spelled(field)


def command_of(name: str) -> Callable[..., int]:
    """Return the command of a question of the register that has no file of its own here.

    name: one of `cardan.register.QUESTIONS`.
    """

    def command(
        file: DriveFile,
        torque: TorqueNm = None,
        speed_rpm: SpeedRpm = None,
        json: AsJson = False,
        csv: AsCsv = False,
        plot: Plot = None,
    ) -> int:
        question = QUESTIONS[name]
        check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
        whole = on_duty(read(file), speed_rpm, torque)
        drive = principal(question, whole)
        missing = _("missing; the question {name} needs it").format(name=name)
        with keys_of(file):
            check(Problem(_(" or ").join(map(key_of, some)), missing, "missing") for some in question.lacking(drive))
            with watching(_(question.title)) as progress:
                result = question.ask(drive, progress=progress)
        if result is None:
            why = question.otherwise(drive)
            print_text((why if isinstance(why, str) else quantity.told(needed(why), reader())) + "\n")
            return 0
        return tell(question.answer(drive, result), file, drive, whole=whole, json=json, csv=csv, plot=plot)

    return command
