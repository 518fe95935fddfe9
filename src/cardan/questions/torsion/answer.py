"""What there is to say of torsional vibration: natural frequencies, what excites them, and torques at the duty."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from cardan.answers.answer import Answer, Remark, Table, Tone
from cardan.answers.quantity import Joined
from cardan.answers.sweepable import OutputColumn, SweepQuestion, each, first
from cardan.drive.drive import Drive
from cardan.texts import _, mark

from .model.answer import answer as answer_of_modes
from .model.answer import lacking, modes_said, torques_left_out
from .model.torsion import TorsionModes, torsion_modes
from .stability.proved_speeds import ProvedSpeeds
from .stability.torsion_stability import proved_in_use
from .steady.answer import answer as answer_of_running
from .steady.answer import worst
from .steady.torsion_response import TorsionResponse, torsion_response

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

TONES: tuple[Tone, ...] = ("failed", "warning", "good", "plain")
"""The first that either part has is that of the whole."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Torsion:
    """Torsional vibration of a drive."""

    modes: TorsionModes  # natural frequencies and what excites them
    running: TorsionResponse | None  # steady vibration at the speed of the duty; None where that gives none
    exact: ProvedSpeeds | None  # where it is unstable at the speeds in use and about them; None where none is named


def ask(drive: Drive) -> Torsion:
    """Return the torsional modes of a drive and its vibration at the speed of its duty."""
    running = None if drive.duty.speed is None else torsion_response(drive)
    return Torsion(modes=torsion_modes(drive), running=running, exact=proved_in_use(drive))


def answer(drive: Drive, result: Torsion) -> Answer:
    """Return what there is to say of the torsional vibration of a drive."""
    modes = answer_of_modes(drive, result.modes, exact=result.exact)
    modes = replace(modes, name="torsion", title=_("Torsional vibration"))
    if result.running is None:
        return modes
    running = answer_of_running(drive, result.running)
    tone, said = modes_said(drive, result.modes, exact=result.exact)
    return replace(
        modes,
        sentence=Joined([said, running.sentence], between="; "),
        tone=next(one for one in TONES if one in (tone, running.tone)),
        figures=lambda: (*modes.figures(), *running.figures()),
        tables=(*modes.tables, *(_apart(one) for one in running.tables)),
        remarks=tuple(_once([*modes.remarks, *torques_left_out(drive), *running.remarks])),
        keys=(*modes.keys, *running.keys),
        facts={**modes.facts, "running": running.facts},
    )


def _apart(table: Table) -> Table:
    """Return a table of the motion under a name that none of the modes has."""
    return replace(table, name=f"running_{table.name}" if table.name else "")


def _once(remarks: list[Remark]) -> Iterator[Remark]:
    """Yield remarks, the same only the first time."""
    seen: list[object] = []
    for one in remarks:
        if one.text not in seen:
            seen.append(one.text)
            yield one


COLUMNS = (
    SweepQuestion(
        name="natural_frequency",
        doc=mark("torsional natural frequencies, slowest first"),
        told=each("natural_frequency", "frequency", "Hz", mark("torsional natural frequency")),
        of_one=lambda drive: first(torsion_modes(drive).omega),
    ),
    SweepQuestion(
        name="alternating_torque",
        doc=mark("largest alternating torque of torsional vibration at the speed of the duty"),
        told=(OutputColumn.of("alternating_torque_Nm", mark("largest alternating torque, ±")),),
        of_result=lambda found: worst(found.running)[:1],
        needs_speed=True,
    ),
)
"""What a sweep may ask of torsional vibration."""
