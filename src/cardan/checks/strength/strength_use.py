"""How much of a limit a part uses under load, and how far the torque may grow until it uses all of it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from cardan.drive.drive import Drive
from cardan.maths.ties import foremost_of


@dataclass(frozen=True, kw_only=True)
class Use:
    """What one part does with one limit; in SI.

    Attributes
    ----------
    check : str
        What is judged; the check of this name judges the same.
    part : str
        Path of the part: ``shafts[1]``, ``joints[0]``; empty for the drive as a whole.
    title : str
        What is judged, in words.
    value, limit : float
        nan where something is missing.
    at_least : bool
        Whether the value must reach the limit instead of keeping below it.
    dimension, unit : str
        Dimension, and the unit that people read it in.
    source : str
        Where limit and formula come from.
    case : str
        Which part of the duty decides; empty for a steady one.
    power : float
        Exponent of the torque in the utilisation; 0 where it does not depend on it.
    factor : float or None
        By which factor the torques may grow, where no power of them tells it.
    advice : bool
        Whether it is a rule of thumb, which limits nothing.
    missing : tuple of str
        Paths of the drive file that it needs.
    """

    check: str
    title: str
    part: str = ""
    value: float = math.nan
    limit: float = math.nan
    at_least: bool = False
    dimension: str = ""
    unit: str = ""
    source: str = ""
    case: str = ""
    power: float = 1.0
    factor: float | None = None
    advice: bool = False
    missing: tuple[str, ...] = ()

    @property
    def judged(self) -> bool:
        """Whether nothing is missing."""
        return not self.missing

    @property
    def utilisation(self) -> float:
        """Share of the limit that is used, at most 1 exactly when the part holds."""
        if not self.at_least:
            return self.value / self.limit
        return self.limit / self.value if self.value > 0.0 else math.inf

    @property
    def torque_factor(self) -> float:
        """By which factor all torques of the duty may grow until the part uses all of its limit."""
        if self.power == 0.0 or not self.judged:
            return math.inf
        if self.factor is not None:
            return self.factor
        used = self.utilisation
        return math.inf if used == 0.0 else used ** (-1.0 / self.power)


def lacking(drive: Drive, *paths: str) -> tuple[str, ...]:
    """Return those of the paths at which a drive says nothing.

    Parameters
    ----------
    drive : Drive
    *paths : str
        As ``joints[0].cross.span``, without units.

    Examples
    --------
    >>> lacking(Drive.from_angles([0.1]), "joints[0].bend", "joints[0].cross.span")
    ('joints[0].cross.span',)
    """
    return tuple(path for path in paths if _at(drive, path) in (None, "", ()))


def _at(thing: object, path: str) -> object:
    for word in path.replace("[", ".[").split("."):
        if thing is None:
            return None
        if word.startswith("["):
            items, k = thing, int(word[1:-1])
            thing = items[k] if isinstance(items, tuple) and k < len(items) else None
        else:
            thing = getattr(thing, word)
    return thing


def governing(uses: Iterable[Use]) -> Use | None:
    """Return the use that ends first when the torque grows, None where nothing is judged."""
    judged = [one for one in uses if one.judged and not one.advice and one.power]
    return foremost_of(judged, lambda one: one.torque_factor, least=True) if judged else None
