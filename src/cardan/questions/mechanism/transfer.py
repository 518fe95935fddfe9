"""By what transfer functions are told: the angle of an input that turns, or the path of one that slides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.figures.axes import across, axis
from cardan.figures.figure import Axis
from cardan.maths.arrays import Array
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _
from cardan.units import deg, mm


@dataclass(frozen=True, kw_only=True)
class Input:
    """What the input moves by, and the dimensions and heads of what is told against it."""

    place: str  # dimension of where it is; and its key
    key: str
    head: str
    load: str  # dimension of what drives it
    pace: str  # dimension of its speed
    sign: str  # of its speed
    ratio: str = ""  # dimensions of both transfer functions of what turns, and of points
    slope: str = ""
    speed: str = "length"
    curve: str = "length"

    def axis(self, values: Array, *, named: bool = False) -> Axis:
        """Return the axis along which curves over the input are drawn."""
        if self.place == "angle":
            return across(values / deg, named=named)
        made = axis(
            _("input path s₁ from the start position"), "mm", [values / mm], dimension="length", margin=0.0, least=1e-6
        )
        return made if named else Axis(low=made.low, high=made.high, ticks=made.ticks, texts=made.texts)

    def units(self, values: Array) -> Array:
        """Return where it is in the units of that axis."""
        return np.asarray(values) / (deg if self.place == "angle" else mm)


def input_of(mechanism: Mechanism) -> Input:
    """Return how the input of a mechanism is told."""
    if not mechanism.slides:
        text = _("input angle")
        return Input(place="angle", key="angle", head=text, load="torque", pace="angular_speed", sign="ω₁")
    return Input(
        place="length",
        key="path",
        head=_("input path"),
        load="force",
        pace="speed",
        sign="v₁",
        ratio="turning",
        slope="turning_slope",
        speed="",
        curve="per_length",
    )
