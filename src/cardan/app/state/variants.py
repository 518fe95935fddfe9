"""Variants of a drive that a user keeps side by side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.texts import _

MOST = 12  # variants that can be kept
LONGEST = 40  # letters of a name


@dataclass(frozen=True, eq=False, kw_only=True)
class Variant:
    """A drive file as it was when it was kept."""

    name: str  # what it is called
    text: str  # the file
    drive: Drive  # what it describes


@dataclass(frozen=True, eq=False)
class Variants:
    """The variants of one window, in the order in which they were kept."""

    kept: tuple[Variant, ...] = ()

    def __iter__(self) -> Iterator[Variant]:
        """Go through them."""
        return iter(self.kept)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.kept)

    @property
    def names(self) -> tuple[str, ...]:
        """What they are called."""
        return tuple(one.name for one in self.kept)

    @property
    def full(self) -> bool:
        """Whether no more can be kept."""
        return len(self.kept) >= MOST

    def named(self, name: str) -> Variant:
        """Return the one of a name."""
        found = next((one for one in self.kept if one.name == name), None)
        if found is None:
            raise refuse("variant", _("there is no variant {name}").format(name=name))
        return found

    def of_text(self, text: str) -> Variant | None:
        """Return the one that a text is; None where it is none."""
        return next((one for one in self.kept if one.text == text), None)

    def free_name(self) -> str:
        """Return a name that none of them has."""
        number = len(self.kept) + 1
        while _("variant {number}").format(number=number) in self.names:
            number += 1
        return _("variant {number}").format(number=number)

    def keeping(self, name: str, text: str, drive: Drive) -> Variants:
        """Return them with one more, or with another one under a name that is there."""
        new = Variant(name=_sound(name), text=text, drive=drive)
        if new.name in self.names:
            return Variants(tuple(new if one.name == new.name else one for one in self.kept))
        if self.full:
            raise refuse("variant", _("at most {count} variants are kept; delete one first").format(count=MOST))
        return Variants((*self.kept, new))

    def renaming(self, name: str, new: str) -> Variants:
        """Return them with one called otherwise."""
        self.named(name)
        sound = _sound(new)
        if sound != name and sound in self.names:
            raise refuse("variant", _("another variant is called {name}").format(name=sound))
        return Variants(tuple(replace(one, name=sound) if one.name == name else one for one in self.kept))

    def without(self, name: str) -> Variants:
        """Return them without one."""
        return Variants(tuple(one for one in self.kept if one.name != name))

    def compared(self, text: str, drive: Drive | None) -> tuple[tuple[str, Drive], ...]:
        """Return names and drives to be compared: what the user works on first, unless it is one of them.

        text: the file as it stands; drive: the last sound drive that it described.
        """
        rows = tuple((one.name, one.drive) for one in self.kept)
        if drive is None or self.of_text(text) is not None:
            return rows
        now = _("now")
        while now in self.names:
            now += "*"
        return ((now, drive), *rows)


def _sound(name: str) -> str:
    bare = " ".join(name.split())
    if not bare:
        raise refuse("variant", _("a variant needs a name"))
    if len(bare) > LONGEST:
        raise refuse("variant", _("a name has at most {count} letters").format(count=LONGEST))
    return bare
