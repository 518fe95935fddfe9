"""What a window works on, kept for when it comes back: on the server, and in the storage of its tab in the browser."""

from __future__ import annotations

import json
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from cardan.errors import InputError

from .document import Document, History
from .variants import Variants

ROOM = 200_000  # characters of earlier and later texts that go into the browser, the nearest ones
LARGEST = 900_000  # characters that a browser can send back
MOST = 100  # windows kept on the server, those used last
TOTAL = 100_000_000  # characters of all of them


@dataclass(frozen=True, eq=False, kw_only=True)
class Kept:
    """A drive file with all that a user would miss of it."""

    text: str  # as it stands
    saved: str = ""  # as it was read or written last
    name: str = ""  # its name in the workspace; empty for one that was never saved
    example: str = ""  # the shipped example that it began as
    history: History = field(default_factory=History)
    variants: Variants = field(default_factory=Variants)

    @property
    def place(self) -> tuple[str, str]:
        """What of it an address names."""
        return place(self.name, self.example)

    @cached_property
    def size(self) -> int:
        """Characters that it takes."""
        texts = (
            self.text,
            self.saved,
            *self.history.before,
            *self.history.behind,
            *(one.text for one in self.variants),
        )
        return sum(map(len, texts))

    def packed(self) -> str:
        """Return it as a text for the browser, of the history the nearest texts; nothing where it is too long."""
        before, room = _nearest(reversed(self.history.before), ROOM)
        behind, _left = _nearest(iter(self.history.behind), room)
        told = {
            "text": self.text,
            "saved": None if self.saved == self.text else self.saved,
            "name": self.name,
            "example": self.example,
            "before": before[::-1],
            "behind": behind,
            "variants": [[one.name, one.text] for one in self.variants],
        }
        packed = json.dumps(told, separators=(",", ":"))
        return packed if len(packed) <= LARGEST else ""


def place(name: str, example: str) -> tuple[str, str]:
    """Return what of a drive an address names: its file, the example that it is, or that it is new."""
    return ("file", name) if name else ("example", example) if example else ("drive", "new")


def unpacked(text: str, read: Callable[[str], Document]) -> Kept | None:
    """Return what a browser kept; None where it makes no sense.

    text: as of `Kept.packed`, or anything else; read: reads the text of a drive file.
    """
    try:
        told = json.loads(text)
        variants = Variants()
        for name, drive_file in told["variants"]:
            drive = read(_text(drive_file)).drive
            if drive is not None:
                variants = variants.keeping(_text(name), drive_file, drive)
        now = _text(told["text"])
        return Kept(
            text=now,
            saved=now if told["saved"] is None else _text(told["saved"]),
            name=_text(told["name"]),
            example=_text(told["example"]),
            history=History(tuple(map(_text, told["before"])), tuple(map(_text, told["behind"]))),
            variants=variants,
        )
    except (ValueError, TypeError, KeyError, RecursionError, InputError):
        return None


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


def _nearest(texts: Any, room: int) -> tuple[list[str], int]:
    """Return the first of some texts that there is room for, and the room left."""
    found: list[str] = []
    for text in texts:
        room -= len(text)
        if room < 0:
            break
        found.append(text)
    return found, max(room, 0)


class Keeper:
    """What the windows of a server work on, whether or not they are there."""

    def __init__(self) -> None:
        self._kept: OrderedDict[Hashable, Kept] = OrderedDict()

    def keep(self, window: Hashable, kept: Kept) -> None:
        """Keep what a window works on now; those not used for long give way."""
        self._kept[window] = kept
        self._kept.move_to_end(window)
        while len(self._kept) > 1 and (len(self._kept) > MOST or sum(one.size for one in self._kept.values()) > TOTAL):
            self._kept.popitem(last=False)

    def of(self, window: Hashable) -> Kept | None:
        """Return what a window worked on last; None where that is not known."""
        return self._kept.get(window)


def asked_place(query: Mapping[str, str], file: str) -> tuple[str, str]:
    """Return what an address asks for; empty for the examples.

    query: what stands behind its question mark; file: what opens where it names nothing.
    """
    for what in ("example", "file", "drive"):
        if what in query:
            return (what, query[what]) if query[what] else ("", "")
    return ("file", file) if file else ("", "")
