"""What there is to say of a drive by Mathieu's equation: parameters of its modes, zones, the book's rule and sizing."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.later import later
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.model.answer import lacking as lacking_of_torsion
from cardan.texts import _, mark

from .mathieu_modes import JOINTS, MathieuModes
from .mathieu_modes import mathieu_modes as _modes

drawn = later("cardan.book.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking", "otherwise"]


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for Mathieu's equation: masses and stiffness, a speed."""
    return (*lacking_of_torsion(drive), *absent((bool(drive.duty.speed), "duty.speed")))


def ask(drive: Drive) -> MathieuModes | None:
    """Return Mathieu's equation of every mode; None where no joint modulates any."""
    found = _modes(drive)
    return found if np.any(found.q > 0.0) else None


def otherwise(drive: Drive) -> str:
    """Return why there is nothing to tell."""
    return _("No joint modulates the stiffness of a torsional mode: there is no parametric vibration.")


def answer(drive: Drive, result: MathieuModes) -> Answer:
    """Return what there is to say of a drive by Mathieu's equation."""
    k = result.nearest
    growth = float(np.asarray(result.exponent.growth)[k])
    zone, low, high = result.zone[k]
    grows = growth > 0.0
    text = _("mode {mode} at a = {a}, q = {q} is stable; its zone {zone} lies from {low:bare} to {high}.")
    if grows:
        text = _("mode {mode} at a = {a}, q = {q} grows by {rate} per turn in zone {zone}, {low:bare} to {high}.")
    return Answer(
        name="mathieu",
        title=_("Mathieu's equation"),
        sentence=say(
            text,
            mode=int(result.number[k]),
            a=Quantity(float(result.a[k]), digits=4),
            q=Quantity(float(result.q[k]), digits=3),
            rate=Quantity(math.expm1(math.pi * float(result.order[k]) * growth), "share", 2),
            zone=zone,
            low=Quantity(low, "angular_speed", 5),
            high=Quantity(high, "angular_speed", 5),
        ),
        tone="warning" if grows else "plain",
        tables=tuple(_tables(result)),
        remarks=(*yokes_estimated(drive), *_remarks(result)),
        keys=tuple(_keys(result)),
        figures=lambda: (drawn().modes_chart_figure(result),),
        facts={
            "speed": Quantity(result.speed, "angular_speed"),
            "nearest_mode": int(result.number[k]),
            "stable": not np.any(np.asarray(result.exponent.growth) > 0.0),
        },
    )


def _tables(result: MathieuModes) -> Iterator[Table]:
    ends = np.asarray([pair for _zone, *pair in result.zone])
    others = bool(np.any(result.order != JOINTS))
    yield Table(
        name="modes",
        title=_("Parameters of y'' + 2n y' + (a - 2q cos 2z) y = 0, z half the phase of order ν")
        if others
        else _("Parameters of y'' + 2n y' + (a - 2q cos 2z) y = 0, z the angle of the input"),
        records=True,
        columns=(
            Column(key="mode", heading=_("mode"), values=result.number.tolist()),
            *([Column(key="order", heading=_("order ν"), values=result.order, decimals=0)] if others else []),
            Column(key="a", heading="a", values=result.a, digits=4),
            Column(key="q", heading="q", values=result.q, digits=3),
            Column(key="damping", heading="n", values=result.damping, digits=2),
            Column(key="beta", heading="β", values=np.asarray(result.exponent.beta), digits=4),
            Column(key="growth", heading=_("growth per radian"), values=np.asarray(result.exponent.growth), digits=2),
            Column(key="zone", heading=_("zone"), values=[zone for zone, *_ends in result.zone]),
            Column(key="zone_low", heading=_("from"), values=ends[:, 0], dimension="angular_speed", digits=5),
            Column(key="zone_high", heading=_("to"), values=ends[:, 1], dimension="angular_speed", digits=5),
        ),
        note=_("Growth by Hill's determinant, with damping; zones without damping. q is twice that of Book (196)."),
    )
    found = result.sizing
    if found is not None:
        book = found.book
        rows = [
            (_("mean"), book.mean),
            (_("order 2, from the joints"), book.order2),
            (_("harmonics of the drive torque"), float(np.sum(book.drive))),
            (_("harmonics of the load"), float(np.sum(book.load))),
            (_("all together"), found.most),
            (_("largest of the exact drive"), found.exact),
        ]
        yield Table(
            name="sizing",
            title=_("Torque in the last shaft, engineering method"),
            columns=(
                Column(key="part", heading=_("part"), values=[name for name, _size in rows], left=True),
                Column(
                    key="torque",
                    heading=_("torque"),
                    values=[size for _name, size in rows],
                    dimension="torque",
                    digits=4,
                ),
            ),
            note=_(
                "Kozhevnikov & Perfil'ev (1978), eq. 246, without parametric term and damping; exact: harmonic balance."
            ),
        )


def _remarks(result: MathieuModes) -> Iterator[Remark]:
    k = result.nearest
    told = result.validity[k]
    if told is not None:
        text = _("The parametric term must not be neglected: without damping the vibration grows.")
        yield Remark(text=_neglected(told.rule, told.too_far, told.error) if told.stable else text)
    if result.sizing is None:
        yield Remark(text=result.without)
    left = len(result.modes.omega) - len(result.number)
    if left:
        text = _("Modes beyond a = 10⁶, {count} of them, are left out; no zone of them is wide enough to matter.")
        yield Remark(text=text.format(count=left))
    text = _("This is of first order in the joint angles; the exact equations of the whole drive decide:")
    yield Remark(text=text, command=("cardan", "torsion", "stability", FILE), tone="next")


def _neglected(rule: bool, too_far: bool, error: np.ndarray) -> Text:
    """Return whether the parametric term may be neglected, by the book's rule and by solving."""
    most = float(np.max(error[np.isfinite(error)], initial=0.0))
    text = {
        (True, False): _("The parametric term may be neglected: Book (237) is met, and solving finds {error} at most."),
        (True, True): _("Book (237) would neglect the parametric term, which changes the vibration by {error}."),
        (False, False): _("Book (237) is not met; yet neglecting the parametric term costs {error} at most."),
        (False, True): _("The parametric term must not be neglected: Book (237) is not met, and it costs {error}."),
    }[rule, too_far]
    return say(text, error=Quantity(most, "share", 2))


def _keys(result: MathieuModes) -> Iterator[KeyFigure]:
    k = result.nearest
    growth = float(np.asarray(result.exponent.growth)[k])
    tone: Tone = "warning" if growth > 0.0 else "good"
    yield KeyFigure(
        name="mathieu_distance",
        title=_("distance of the speed from the nearest zone of parametric resonance"),
        place=say(_("mode {mode}, zone {zone}"), mode=int(result.number[k]), zone=result.zone[k][0]),
        value=Quantity(_distance(result, k), "share", 2),
        better="more",
        tone=tone,
    )


def _distance(result: MathieuModes, k: int) -> float:
    """Return by which share the speed must change to enter the nearest zone of a mode; 0 within it."""
    _zone, low, high = result.zone[k]
    return max(0.0, low / result.speed - 1.0, 1.0 - high / result.speed)


def _column_values(found: MathieuModes | None) -> tuple[float, float, float, float]:
    if found is None:
        return (math.nan,) * 4
    k = found.nearest
    growth = float(np.asarray(found.exponent.growth)[k])
    return float(found.a[k]), float(found.q[k]), 0.5 * float(found.order[k]) * growth, _distance(found, k)


COLUMNS = (
    SweepQuestion(
        name="mathieu",
        doc=mark("parameters of Mathieu's equation of the mode that is nearest to a zone of parametric resonance"),
        told=(
            OutputColumn(name="mathieu_a", text=mark("parameter a, natural frequency over speed, squared")),
            OutputColumn(name="mathieu_q", text=mark("parametric term q")),
            OutputColumn(name="mathieu_growth", text=mark("rate of growth per radian of the input, damping counted")),
            OutputColumn.of(
                "mathieu_distance_percent", mark("change of the speed that leads into the nearest zone; 0 within it")
            ),
        ),
        of_result=_column_values,
    ),
)
"""What a sweep may ask of Mathieu's equation."""
