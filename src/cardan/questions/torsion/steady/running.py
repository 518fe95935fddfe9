"""What there is to say of steady torsional vibration at the speed of the duty, in a condition beside others."""

from __future__ import annotations

from dataclasses import replace

from cardan.answers.answer import Answer
from cardan.answers.question import Lacking, absent
from cardan.drive.drive import Drive
from cardan.questions.torsion.model.answer import lacking as lacking_modes

from .answer import answer as whole
from .torsion_response import TorsionResponse
from .torsion_response import torsion_response as ask

__all__ = ["answer", "ask", "lacking"]


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for its vibration at the speed of its duty."""
    return (*lacking_modes(drive), *absent((bool(drive.duty.speed), "duty.speed")))


def answer(drive: Drive, result: TorsionResponse) -> Answer:
    """Return what there is to say, its sentence alone: mean and alternating torque, and whether it is stable."""
    return replace(whole(drive, result), keys=())
