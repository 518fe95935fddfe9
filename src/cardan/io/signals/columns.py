"""What a channel measures, from its title: ``acceleration_front_z_m_s2``, ``speed_rpm``, ``tacho``."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from cardan.errors import refuse
from cardan.files import refusal
from cardan.maths.arrays import Array
from cardan.questions.diagnosis.signals.signal import DIRECTIONS, QUANTITIES
from cardan.texts import _
from cardan.units import DIMENSIONS, inch, nearest

EXTRA = {
    "acceleration": {"g": 9.80665},
    "velocity": {"in_s": inch, "um_s": 1e-6},
    "displacement": {"um": 1e-6, "mil": 1e-3 * inch},
    "pulses": {"V": 1.0, "mV": 1e-3},
    "other": {"V": 1.0, "mV": 1e-3},
}
"""Units of sensors that no drive file has."""

UNITS = {
    quantity: {**(DIMENSIONS[dimension] if dimension else {}), **EXTRA.get(quantity, {})}
    for quantity, dimension in QUANTITIES.items()
}
"""Quantity -> unit -> factor to SI."""

SI = {
    "acceleration": "m_s2", "velocity": "m_s", "displacement": "m", "angle": "rad", "angular_speed": "rad_s",
    "torque": "Nm", "pulses": "", "other": "",
}  # fmt: skip
"""Quantity -> unit in which it is kept."""

WORDS = {
    "acceleration": ("acceleration",), "acc": ("acceleration",), "accel": ("acceleration",),
    "velocity": ("velocity",), "vel": ("velocity",), "displacement": ("displacement",), "disp": ("displacement",),
    "proximity": ("displacement",), "angle": ("angle",), "speed": ("angular_speed", "velocity"),
    "rpm": ("angular_speed",), "torque": ("torque",), "pulses": ("pulses",), "pulse": ("pulses",),
    "tacho": ("pulses",), "tachometer": ("pulses",), "keyphasor": ("pulses",), "phasor": ("pulses",),
    "trigger": ("pulses",), "other": ("other",),
}  # fmt: skip
"""Word of a title -> what it may mean."""

SHAKING = ("acceleration", "velocity", "displacement")
"""Quantities of which a recording has several channels: where they sit tells them apart better than what they are."""

PLACE = re.compile(r"(?:supports|shafts|joints)\[\d+\]")

PRINTED = {
    "ms-2": "m_s2", "m_s_s": "m_s2", "mm_s_s": "mm_s2", "gn": "g", "g's": "g", "1_min": "rpm", "min-1": "rpm",
    "u_min": "rpm", "r_min": "rpm", "°": "deg", "degree": "deg", "degrees": "deg", "°_s": "deg_s", "ips": "in_s",
    "inch": "in", "mils": "mil", "micron": "um", "volt": "V", "volts": "V", "radian": "rad", "radians": "rad",
}  # fmt: skip
"""Units as other programs write them."""


@dataclass(frozen=True, kw_only=True)
class Meaning:
    """What a title says."""

    name: str  # what is left of the title without quantity and unit
    quantity: str  # one of `cardan.questions.diagnosis.signals.signal.QUANTITIES`, or ``time``
    factor: float  # to SI
    unit: str  # as written
    place: str = ""  # place, direction: as in `cardan.questions.diagnosis.signals.signal.Channel`
    direction: str = ""


BRACKETED = re.compile(r"(?P<words>.*?)[\s_]*(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))\s*")
"""A title with its unit in brackets, as most loggers write it; an index as in ``supports[1]`` is a bracket too."""

TIMES = {"sec": "s", "second": "s", "seconds": "s", "msec": "ms", "milliseconds": "ms", "hr": "h", "hours": "h"}
"""Units of time as other programs write them."""


def underlined(title: str) -> str:
    """Return a title whose unit stands in brackets as words with lines between them; any other as it is."""
    found = BRACKETED.fullmatch(title)
    if found is None or (found["square"] or "").strip().isdecimal():
        return title
    words = re.sub(r"\s+", "_", found["words"].strip())
    printed = (found["square"] or found["round"] or "").strip()
    if words.lower() in ("time", "t"):
        unit = printed.lower()
        return f"{words}_{TIMES.get(unit, unit)}"
    known = suffix_of(printed)
    if known:
        return f"{words}_{known}"
    return words if any(one in WORDS for one in words.lower().split("_")) else title


def suffix_of(printed: str) -> str:
    """Return the suffix of a unit as another program writes it, "" where it is not known."""
    plain = printed.strip().strip("[]()").strip()
    plain = plain.replace("²", "2").replace("^", "").replace("**", "").replace("µ", "u").replace("μ", "u")
    plain = re.sub(r"[·*\s]", "", plain.replace("/", "_").replace("⁻¹", "-1").replace("⁻2", "-2"))
    known = {unit: unit for units in UNITS.values() for unit in units}
    lower = {unit.lower(): unit for unit in known} | PRINTED
    return known.get(plain) or lower.get(plain.lower(), "")


def meaning(title: str) -> Meaning:
    """Return what the channel of a title measures, by its words and its unit.

    title: words with lines between them: a quantity, a name, a place ``supports[1]``, a direction; the unit at its end.
    Or words with blanks and the unit in brackets.
    """
    words = [one for one in underlined(title.strip()).split("_") if one]
    lower = [one.lower() for one in words]
    if words and (lower[0] == "time" or (lower[0] == "t" and "_".join(words[1:]) in DIMENSIONS["time"])):
        return _time(title, words[1:])
    hinted = next((k for k, one in enumerate(lower) if one in WORDS), None)
    may = WORDS[lower[hinted]] if hinted is not None else tuple(QUANTITIES)
    if hinted is not None and lower[hinted : hinted + 1] == ["speed"] and "angular" in lower[:hinted]:
        may = ("angular_speed",)
    for k in range(len(words)):
        unit = "_".join(words[k:])
        fits = [one for one in may if unit in UNITS[one]]
        # A word alone, as rpm or g, is a unit where nothing else says what is measured.
        if fits and (hinted is None or hinted < k or lower[hinted] == unit):
            quantity = fits[0] if len(fits) == 1 or hinted is not None else _likeliest(fits)
            own = hinted if hinted is not None and hinted < k else None
            return _named(title, words[:k], own, quantity, UNITS[quantity][unit], unit)
    if hinted is None:
        return _named(title, words, None, "other", 1.0, "")
    if may[0] in ("pulses", "other"):
        return _named(title, words, hinted, may[0], 1.0, "")
    choices = _(" or ").join(f"{words[hinted]}_{unit}" for unit in UNITS[may[0]])
    text = _("needs a unit of {quantity} at its end: write {choices}")
    raise refuse(title, text.format(quantity=may[0].replace("_", " "), choices=choices), "inconsistent")


def _likeliest(fits: list[str]) -> str:
    sure = ("acceleration", "displacement", "angular_speed", "torque", "other")
    return next((one for one in sure if one in fits), fits[0])


def _named(title: str, words: list[str], own: int | None, quantity: str, factor: float, unit: str) -> Meaning:
    rest = [one for k, one in enumerate(words) if k != own and one.lower() not in ("angular",)]
    place = next((one for one in rest if PLACE.fullmatch(one)), "")
    direction = next((one.lower() for one in rest if one.lower() in DIRECTIONS[:-1]), "")
    left = [one for one in rest if one != place and one.lower() != direction]
    said = words[own] if own is not None and quantity not in SHAKING else ""
    name = "_".join(left) or said or "_".join(one for one in (place, direction) if one) or "_".join(words) or title
    return Meaning(name=name, quantity=quantity, factor=factor, unit=unit, place=place, direction=direction)


def _time(title: str, words: list[str]) -> Meaning:
    unit = "_".join(words)
    known = DIMENSIONS["time"]
    if unit not in known:
        near = nearest(unit, known)
        text = _("needs a unit of time at its end: write {choices}")
        choices = f"time_{near}" if near else _(" or ").join(f"time_{one}" for one in known)
        raise refuse(title, text.format(choices=choices), "inconsistent")
    return Meaning(name="time", quantity="time", factor=known[unit], unit=unit)


def title_of(name: str, quantity: str, place: str, direction: str) -> str:
    """Return the title under which a channel is written, with its SI unit."""
    words = [one for one in (place, direction) if one]
    given = "" if name == "_".join(words) or name in (quantity, "") else name
    angle_error = "" if quantity == "pulses" and WORDS.get(given.lower()) == ("pulses",) else quantity
    return "_".join(one for one in (angle_error, given, *words, SI[quantity]) if one)


# What a reader finds in a file, before anybody asks what it means.

MOST_VALUES = 100_000_000  # values of all channels of a recording together; more do not fit a desk computer's memory


@dataclass(frozen=True, eq=False, kw_only=True)
class Column:
    """A channel as a file has it."""

    title: str  # as in the file; its words and unit tell what it is unless the fields below do
    values: Array  # (n,): as in the file; nan where there is none
    rate: float | None = None  # values a second, where the file says it
    start: float = 0.0  # time of the first value [s]
    quantity: str = ""  # quantity, unit, place, direction: where the file says them in its own way; empty otherwise
    unit: str = ""
    place: str = ""
    direction: str = ""
    trust: float = 1.0  # from 0 to 1
    # whether the values are in their unit; not so where nobody said what a number of a WAV file stands for
    scaled: bool = True


@dataclass(frozen=True, eq=False, kw_only=True)
class Raw:
    """All columns of a file, and what was doubtful in it as a whole."""

    columns: Sequence[Column]
    cautions: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class Asked:
    """What the reader of a file is told besides it."""

    titles: dict[str, str] | Sequence[str] = ()  # titles instead of those of the file: by name, or all of them in order
    rate: float | None = None  # values a second where the file does not say it [Hz]
    # what the greatest number of a WAV file stands for, one for all channels or one for each
    full_scale: Sequence[float] = ()
    progress: Callable[[float], object] | None = None  # told the share done; it may answer "stop"


def content(path: object, name: str, limit: int) -> bytes:
    """Return the bytes of a file, no more of them than allowed."""
    try:
        with open(str(path), "rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            found = stream.read(limit + 1) if size <= limit else b""
    except OSError as error:
        raise refuse(name, _("cannot be read: {why}").format(why=refusal(error))) from None
    if max(size, len(found)) > limit:
        text = _("is larger than {limit} MB; cut the recording or read a part of it")
        raise refuse(name, text.format(limit=limit // 10**6), "out_of_range")
    if not found:
        raise refuse(name, _("is empty"), "empty")
    return found
