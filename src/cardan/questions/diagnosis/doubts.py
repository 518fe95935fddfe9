"""What does not fit between a recording and the drive that it is said to be of: speeds and places."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.texts import _
from cardan.units import rpm

from .levels import Track, stands_out
from .plant import Plant
from .signals.signal import Signal

TOO_FAST = 1.15
"""Times the top speed of the drive that a recording may reach."""

TOO_SLOW = 0.5
"""Share of the least speed of the drive that a recording should reach."""

APART = 0.03
"""Share by which the mean speed of the output may differ from that of the shaft: over whole turns joints make none."""

MISFIT, FAR, PLACELESS, SIZELESS = 0.3, 0.6, 0.8, 0.6
"""What is left of the confidence: where two speeds contradict each other, where the recording lies outside of the
running of the drive, where a sensor does not say its place, where the drive does not say what its sizes follow from."""

SILENT = 0.4
"""Share of the confidence that is left where order 1, which every shaft has, does not rise over the noise."""


def doubts(signal: Signal, shaft: Rotation, base: Plant) -> Iterator[tuple[str, float]]:
    """Yield what does not fit, each with the share of confidence that it leaves."""
    yield from _speeds(shaft, base)
    yield from _other_speeds(signal, shaft)
    if base.assumed:
        text = _("The drive does not say {names}; the sizes to be expected are assumed.")
        decide = any(one == "duty.torque" or one.endswith(".mass") for one in base.assumed)
        yield text.format(names=", ".join(base.assumed)), SIZELESS if decide else 1.0
    shaking = [one for one in signal.measured if one.quantity in ("acceleration", "velocity", "displacement")]
    lost = [one for one in shaking if base.housing_at(one.place) is None]
    if lost:
        text = _("It is not known where {names} sits; it counts as sitting at the output. Known places are {places}.")
        names = ", ".join(f"{one.name} ({one.place})" if one.place else one.name for one in lost)
        places = ", ".join(one.place for one in base.housings)
        yield text.format(names=names, places=places), PLACELESS


def _speeds(shaft: Rotation, base: Plant) -> Iterator[tuple[str, float]]:
    """Yield a speed that the drive does not have."""
    if "duty.speed" in base.assumed:
        return
    high, (low, top) = shaft.speeds[1], base.speed
    if high > TOO_FAST * top:
        text = _(
            "The shaft turned up to {high:.4g} rpm; the drive runs up to {top:.4g} rpm: the sampling rate, the pulses "
            "per turn or the drive file are wrong."
        )
        yield text.format(high=high / rpm, top=top / rpm), MISFIT
    elif high < TOO_SLOW * low:
        text = _(
            "The shaft turned up to {high:.4g} rpm only; the drive runs from {low:.4g} rpm: the recording is far from "
            "its running, or the sampling rate or the pulses per turn are wrong."
        )
        yield text.format(high=high / rpm, low=low / rpm), FAR


def _other_speeds(signal: Signal, shaft: Rotation) -> Iterator[tuple[str, float]]:
    """Yield channels of a speed that turn otherwise than the shaft."""
    for k, one in enumerate(signal.channels):
        if k == signal.tacho or one.quantity != "angular_speed":
            continue
        inside = (one.time >= shaft.time[0]) & (one.time <= shaft.time[-1])
        if not np.any(inside):
            continue
        mean = float(np.mean(shaft.speed_at(one.time[inside])))
        other = abs(float(np.mean(one.values[inside])))
        if abs(other / mean - 1.0) > APART:
            text = _(
                "{name} turns at {other:.4g} rpm on average and the shaft at {mean:.4g} rpm: the sampling rate, the "
                "pulses per turn or a unit is wrong, or it is another shaft."
            )
            yield text.format(name=one.name, other=other / rpm, mean=mean / rpm), MISFIT


def silent(radial: list[Track], high: Array, low: Array) -> list[tuple[str, float]]:
    """Return the doubt of a recording in which not all follows the shaft, with the share of confidence it leaves."""
    one, two = (stands_out(radial, order, high) for order in (1.0, 2.0))
    if one or not high.any() or (low.any() and stands_out(radial, 1.0, low)):
        return []
    if two:
        text = _("Order 2 rises over the noise and order 1 does not: the pulses per turn may be twice the true ones.")
    else:
        text = _("Neither order 1 nor order 2 of the shaft rises over the noise: faults may hide in it.")
    return [(text, SILENT)]
