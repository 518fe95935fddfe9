"""What there is to say of field balancing: the masses to add, what they leave once a turn, and what no mass changes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.quantity import Quantity, Text, say
from cardan.maths.arrays import Array
from cardan.maths.ties import in_a_turn
from cardan.texts import _

from .field_balance import SAME_SPEED, FieldBalance, Readings
from .signals.signal import QUANTITIES

__all__ = ["answer"]

ALIKE = 10.0
"""Ratio of singular values above which the sensors tell the planes apart badly."""

CHANGED = 0.2
"""Share of order 2 by which it may change between runs; more says that torque or joint angle was another."""

LOOSE = 0.1
"""Share of the largest change that runs may miss of the influence coefficients."""


def answer(result: FieldBalance, readings: Readings, planes: Sequence[float], radius: float | None = None) -> Answer:
    """Return what there is to say of the corrections of a shaft.

    planes [m]: places of the planes; radius [m]: where the masses go, where it is known.
    """
    size = np.abs(result.correction)
    masses = size / radius if radius else np.full(len(planes), np.nan)
    return Answer(
        name="field-balance",
        title=_("Field balancing"),
        sentence=_sentence(result, readings),
        tables=(
            Table(
                title=_("Masses to add"),
                name="corrections",
                columns=(
                    Column(key="position", heading=_("position"), values=list(planes), dimension="length"),
                    Column(
                        key="angle",
                        heading=_("angle"),
                        values=in_a_turn(np.angle(result.correction)),
                        dimension="angle",
                        decimals=1,
                    ),
                    Column(key="unbalance", heading=_("unbalance"), values=size, dimension="unbalance"),
                    Column(key="mass", heading=_("mass"), values=masses, dimension="mass", unit="g", digits=3),
                ),
            ),
            *_sensors(result, readings),
        ),
        remarks=tuple(_remarks(result, readings)),
        facts={
            "speed": Quantity(readings.speed, "angular_speed"),
            "two_sided": result.two_sided,
            "condition": result.condition,
            "misfit": result.misfit,
        },
    )


def _dimension(quantity: str) -> str:
    return {"displacement": "displacement"}.get(quantity, QUANTITIES[quantity])


def _sentence(result: FieldBalance, readings: Readings) -> Text:
    before, after = np.abs(result.first), np.abs(result.remaining)
    text = _("the masses below take {share} of order 1 at {speed}; order 2 is of the joints and stays.")
    share = 1.0 - float(np.linalg.norm(after) / np.linalg.norm(before))
    return say(text, share=Quantity(share, "share", 3), speed=Quantity(readings.speed, "angular_speed", 3))


def _sensors(result: FieldBalance, readings: Readings) -> Iterator[Table]:
    """Yield a table of the sensors for each quantity that they measure."""
    for quantity in dict.fromkeys(readings.quantity):
        rows = [k for k, one in enumerate(readings.quantity) if one == quantity]

        def column(key: str, heading: str, values: Array, rows: list[int] = rows, unit: str = quantity) -> Column:
            return Column(key=key, heading=heading, values=np.abs(values)[rows], dimension=_dimension(unit), digits=3)

        yield Table(
            title=_("Sensors"),
            name=f"sensors_{quantity}",
            columns=(
                Column(key="sensor", heading=_("sensor"), values=[readings.sensors[k] for k in rows], left=True),
                column("order_1", _("order 1"), result.first),
                column("remaining", _("after balancing"), result.remaining),
                column("order_2", _("order 2, stays"), readings.value[0, :, 1]),
                column("order_3", _("order 3"), readings.value[0, :, 2]),
            ),
        )


def _remarks(result: FieldBalance, readings: Readings) -> Iterator[Remark]:
    second = np.abs(readings.value[:, :, 1])
    changed = np.max(np.abs(second - second[0]), axis=0) > CHANGED * np.maximum(second[0], np.abs(result.first))
    if np.any(changed):
        text = _("Warning: order 2 was not the same in all runs; run them with the same torque and joint angles.")
        yield Remark(text=text, tone="warning")
    if result.two_sided:
        share = float(np.max(np.abs(result.mirrored)) / np.max(np.abs(result.influence)))
        text = _("What turns backward, behind a joint or on unequal supports, is {share} of the influence and counted.")
        yield Remark(text=say(text, share=Quantity(share, "share", 2)))
    else:
        text = _("Behind a joint a share of the unbalance turns backward; runs at two angles a plane tell it, too.")
        yield Remark(text=text)
    if result.condition > ALIKE:
        text = _(
            "Warning: the planes shake the sensors almost alike ({ratio} to 1); large masses may cancel each other."
        )
        yield Remark(text=say(text, ratio=Quantity(result.condition, digits=2)), tone="warning")
    if result.misfit > LOOSE:
        text = _(
            "Warning: the runs miss the influence coefficients by {share}; speed or mounting changed between them."
        )
        yield Remark(text=say(text, share=Quantity(result.misfit, "share", 2)), tone="warning")
    text = _("Angles count from the mark on the shaft in its sense of rotation; all runs within {share} of one speed.")
    yield Remark(text=say(text, share=Quantity(SAME_SPEED, "share", 1)))
    yield Remark(text=_("Take the trial masses off first."))
