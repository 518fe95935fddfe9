"""How one user likes to see things: language, units, decimal sign, light or dark."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal, TypeAlias

from cardan.texts import LANGUAGES
from cardan.units import DIMENSIONS

Theme: TypeAlias = Literal["auto", "light", "dark"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choices:
    """What a user chose."""

    language: str = "en"  # one of `cardan.texts.LANGUAGES`
    # dimension -> unit, as in the keys of a drive file, where it is not the usual one
    units: Mapping[str, str] = field(default_factory=dict)
    decimal: str = "."  # sign between whole and part: ``"."`` or ``","``
    theme: Theme = "auto"  # auto, light or dark

    def kept(self) -> dict[str, Any]:
        """Return the choices as plain data, to be kept for the next time."""
        return {**asdict(self), "units": dict(self.units)}


def choices_of(kept: Mapping[str, Any]) -> Choices:
    """Return the choices kept as plain data; what makes no sense is left at its default."""
    units = kept.get("units")
    given = dict(units) if isinstance(units, Mapping) else {}
    sound = {
        "language": kept.get("language") in tuple(LANGUAGES),
        "decimal": kept.get("decimal") in (".", ","),
        "theme": kept.get("theme") in ("auto", "light", "dark"),
    }
    return Choices(
        units={one: unit for one, unit in given.items() if unit in tuple(DIMENSIONS.get(one, {}))},
        **{one.name: kept[one.name] for one in fields(Choices) if sound.get(one.name)},
    )
