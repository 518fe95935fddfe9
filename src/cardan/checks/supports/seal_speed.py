"""Whether the seals of the supports bear how fast the shaft rubs under their lips."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark

from .support_speed import of_supports


def _judge(design: Design) -> Iterator[Verdict]:
    def radius(k: int) -> Any:
        diameter = design.value(f"supports[{k}].seal_diameter")
        return None if diameter is None else 0.5 * diameter

    yield from of_supports(design, "max_lip_speed", radius, _("largest speed under the lip of the seal"))


CHECK = Check(
    name="seal_speed",
    doc=mark("speed of the shaft's surface under the seals of every support against the largest they bear"),
    judge=_judge,
    title=mark("speed under the seals of support {number}"),
    dimension="speed",
    unit="m_s",
)
