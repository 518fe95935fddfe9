"""What a reader finds in a file, before anybody asks what it means."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from cardan.errors import refuse
from cardan.files import refusal
from cardan.maths.arrays import Array
from cardan.texts import _

MOST_VALUES = 100_000_000
"""Values of all channels of a recording together; more do not fit a desk computer's memory."""


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
