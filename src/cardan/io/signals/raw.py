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
    """A channel as a file has it.

    Attributes
    ----------
    title : str
        As in the file; its words and unit tell what it is unless the fields below do.
    values : array (n,)
        As in the file; nan where there is none.
    rate : float, optional
        Values a second, where the file says it.
    start : float
        Time of the first value [s].
    quantity, unit, place, direction : str
        Where the file says them in its own way; empty otherwise.
    trust : float
        From 0 to 1.
    scaled : bool
        Whether the values are in their unit; not so where nobody said what a number of a WAV file stands for.
    """

    title: str
    values: Array
    rate: float | None = None
    start: float = 0.0
    quantity: str = ""
    unit: str = ""
    place: str = ""
    direction: str = ""
    trust: float = 1.0
    scaled: bool = True


@dataclass(frozen=True, eq=False, kw_only=True)
class Raw:
    """All columns of a file, and what was doubtful in it as a whole."""

    columns: Sequence[Column]
    cautions: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class Asked:
    """What the reader of a file is told besides it.

    Attributes
    ----------
    titles : dict of str to str, or sequence of str
        Titles instead of those of the file: by name, or all of them in order.
    rate : float, optional
        Values a second where the file does not say it [Hz].
    full_scale : sequence of float
        What the greatest number of a WAV file stands for, one for all channels or one for each.
    progress : function, optional
        Told the share done; it may answer "stop".
    """

    titles: dict[str, str] | Sequence[str] = ()
    rate: float | None = None
    full_scale: Sequence[float] = ()
    progress: Callable[[float], object] | None = None


def content(path: object, name: str, limit: int) -> bytes:
    """Return the bytes of a file, no more of them than allowed.

    Raises
    ------
    InputError
        It cannot be read, is empty or too large.
    """
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
