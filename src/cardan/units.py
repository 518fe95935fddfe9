"""Units: what a key of a file may end in, and its factor to SI.

Python is SI and radians throughout. Only files, tables and axes carry units, in the key itself: ``centre_mm``,
``speed_rpm``. A dimension lists its units, the first one is what we write.
"""

from __future__ import annotations

import math
import re
from dataclasses import MISSING, dataclass, field
from difflib import get_close_matches
from typing import Any

from cardan.texts import _

deg = math.pi / 180
arcmin = deg / 60
mm = 1e-3
inch = 0.0254
rpm = math.pi / 30
percent = 1e-2
pound = 0.45359237
lbf = pound * 9.80665
hour = 3600.0

DIMENSIONS: dict[str, dict[str, float]] = {
    "length": {"mm": mm, "m": 1.0, "cm": 1e-2, "in": inch, "ft": 12 * inch, "km": 1e3},
    "displacement": {"um": 1e-6, "mm": mm, "m": 1.0, "mil": 1e-3 * inch, "in": inch},
    "angle": {"deg": deg, "rad": 1.0, "arcmin": arcmin},
    "angular_speed": {"rpm": rpm, "rad_s": 1.0, "deg_s": deg},
    "angular_acceleration": {"rad_s2": 1.0, "deg_s2": deg},
    "speed": {"m_s": 1.0, "mm_s": mm},
    "acceleration": {"m_s2": 1.0, "mm_s2": mm},
    "time": {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": hour},
    "duration": {"h": hour, "min": 60.0, "s": 1.0},
    "frequency": {"Hz": 2 * math.pi, "rad_s": 1.0, "per_min": 2 * math.pi / 60},
    "rate": {"per_s": 1.0},
    "turning": {"deg_per_mm": deg / mm, "rad_per_m": 1.0},
    "turning_slope": {"rad_per_m2": 1.0},
    "per_length": {"per_m": 1.0},
    "sampling_rate": {"Hz": 1.0, "kHz": 1e3},
    "share": {"percent": percent, "fraction": 1.0},
    "torque": {"Nm": 1.0, "kNm": 1e3, "MNm": 1e6, "Nmm": mm, "lbft": 12 * inch * lbf, "lbin": inch * lbf},
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": lbf},
    "mass": {"kg": 1.0, "g": 1e-3, "lb": pound},
    "inertia": {"kg_m2": 1.0, "kg_mm2": mm * mm, "g_mm2": 1e-3 * mm * mm, "kg_cm2": 1e-4, "kgm2": 1.0},
    "density": {"kg_m3": 1.0, "g_cm3": 1e3},
    "stress": {"MPa": 1e6, "Pa": 1.0, "GPa": 1e9, "psi": lbf / inch**2},
    "pressure_velocity": {"MPa_m_s": 1e6, "W_m2": 1.0},
    "pitch": {"mm_per_turn": mm / (2 * math.pi), "m_per_rad": 1.0, "mm_per_rad": mm},
    "stiffness": {"N_per_m": 1.0, "N_per_mm": 1e3, "kN_per_mm": 1e6, "N_per_um": 1e6},
    "damping": {"Ns_per_m": 1.0, "Ns_per_mm": 1e3},
    "turning_stiffness": {"Nm_per_rad": 1.0, "kNm_per_rad": 1e3, "MNm_per_rad": 1e6, "Nm_per_deg": 1 / deg},
    "turning_damping": {"Nms_per_rad": 1.0, "Nms_per_deg": 1 / deg},
    "speed_angle": {"rpm_deg": rpm * deg, "rad2_s": 1.0},
    "unbalance": {
        "g_mm": 1e-6,
        "kg_m": 1.0,
        "kgm": 1.0,
        "g_cm": 1e-5,
        "N_cm": 1e-2 / 9.80665,
        "oz_in": 0.028349523125 * inch,
    },
    "power": {"W": 1.0, "kW": 1e3},
    "work": {"J": 1.0, "kJ": 1e3},
}
"""Dimension -> unit suffix -> factor to SI. A frequency is an angular one in Python [rad/s]."""

LABELS = {
    "um": "µm",
    "deg": "°",
    "rad_s": "rad/s",
    "rad_s2": "rad/s²",
    "deg_s": "°/s",
    "deg_s2": "°/s²",
    "m_s": "m/s",
    "mm_s": "mm/s",
    "m_s2": "m/s²",
    "mm_s2": "mm/s²",
    "MPa_m_s": "MPa·m/s",
    "W_m2": "W/m²",
    "percent": "%",
    "fraction": "",
    "per_min": "1/min",
    "per_s": "1/s",
    "deg_per_mm": "°/mm",
    "rad_per_m": "rad/m",
    "rad_per_m2": "rad/m²",
    "per_m": "1/m",
    "arcmin": "′",
    "Nm": "N·m",
    "kNm": "kN·m",
    "MNm": "MN·m",
    "Nmm": "N·mm",
    "lbft": "lbf·ft",
    "lbin": "lbf·in",
    "rpm_deg": "rpm·°",
    "rad2_s": "rad²/s",
    "g_mm": "g·mm",
    "kg_m": "kg·m",
    "kgm": "kg·m",
    "g_cm": "g·cm",
    "N_cm": "N·cm",
    "oz_in": "oz·in",
    "kg_m2": "kg·m²",
    "kgm2": "kg·m²",
    "kg_mm2": "kg·mm²",
    "kg_cm2": "kg·cm²",
    "g_mm2": "g·mm²",
    "kg_m3": "kg/m³",
    "g_cm3": "g/cm³",
    "mm_per_turn": "mm/turn",
    "m_per_rad": "m/rad",
    "mm_per_rad": "mm/rad",
    "N_per_m": "N/m",
    "N_per_mm": "N/mm",
    "kN_per_mm": "kN/mm",
    "N_per_um": "N/µm",
    "Nm_per_rad": "N·m/rad",
    "kNm_per_rad": "kN·m/rad",
    "MNm_per_rad": "MN·m/rad",
    "Nm_per_deg": "N·m/°",
    "Ns_per_m": "N·s/m",
    "Ns_per_mm": "N·s/mm",
    "Nms_per_rad": "N·m·s/rad",
    "Nms_per_deg": "N·m·s/°",
}
"""How a unit suffix is printed, where it is not printed as it stands."""


def factor(dimension: str, unit: str) -> float:
    """Return how many SI units one ``unit`` is.

    Examples
    --------
    >>> factor("length", "mm")
    0.001
    """
    return DIMENSIONS[dimension][unit]


def dimension_of(unit: str) -> str:
    """Return the first dimension that has a unit; empty where none has.

    >>> dimension_of("deg"), dimension_of("")
    ('angle', '')
    """
    return next((dimension for dimension, units in DIMENSIONS.items() if unit in units), "")


def preferred(dimension: str) -> str:
    """Return the unit we write for a dimension."""
    return next(iter(DIMENSIONS[dimension]))


def label(unit: str) -> str:
    """Return the printed form of a unit suffix."""
    return spoken(LABELS.get(unit, unit))


def thousands(value: float, decimals: int = 0) -> str:
    """Return a number with so many decimals, its thousands in thin groups.

    >>> thousands(51090), thousands(1234.56, 1)
    ('51\u202f090', '1\u202f234.6')
    """
    return f"{value:,.{decimals}f}".replace(",", "\u202f")


def spoken(printed: str) -> str:
    """Return a printed unit in the language spoken here, signs before it as they are.

    >>> spoken("± N·m")
    '± N·m'
    >>> from cardan.texts import speaking
    >>> with speaking("ru"):
    ...     spoken("± N·m")
    '± Н·м'
    """
    return " ".join(_(part) for part in printed.split(" "))


def nearest(word: str, known: Any) -> str | None:
    """Return the known word that ``word`` means: what an old name is called now, else the most alike; None if none is.

    >>> nearest("bend_deg", ["centre_mm", "joint_angle_deg"])
    'joint_angle_deg'
    >>> nearest("centre_mmm", ["centre_mm", "joint_angle_deg"])
    'centre_mm'
    """
    names = list(known)
    renamed = _OLD_WORD.sub(lambda found: _OLD_WORDS[found[0]], str(word))
    if renamed != word and renamed in names:
        return renamed
    found = get_close_matches(renamed, names, n=1, cutoff=0.6)
    return found[0] if found else None


_OLD_WORDS = {"bend": "joint_angle", "irregularity": "speed_fluctuation", "lead": "angle_error", "cures": "remedies"}
_OLD_WORD = re.compile(rf"(?<![a-z])({'|'.join(_OLD_WORDS)})(?![a-z])")


@dataclass(frozen=True, slots=True)
class Key:
    """What a field of the drive model means in a file; stands in the field's metadata."""

    doc: str  # one sentence for schema, reference and error messages
    dimension: str | None = None  # a key of `DIMENSIONS`; None for counts, ratios and names
    low: float = -math.inf  # low, high: allowed closed range in SI, `above` and `below` the open ends
    high: float = math.inf
    above: float = -math.inf
    below: float = math.inf
    mirror: str = ""  # name of an alternative key with the opposite sign (``yoke_lead`` for ``yoke_angle``)
    choices: tuple[str, ...] = ()  # allowed words

    def allows(self, value: float) -> bool:
        """Tell whether a value in SI lies in the allowed range."""
        return math.isfinite(value) and self.low <= value <= self.high and self.above < value < self.below


KEY = "cardan"
"""Name under which a field's metadata holds its `Key`."""


def quantity(dimension: str, default: Any = MISSING, *, doc: str, **limits: Any) -> Any:
    """Declare a dataclass field with a physical dimension.

    Parameters
    ----------
    dimension : str
        A key of `DIMENSIONS`.
    default : object
        Default in SI; required when missing.
    doc : str
        One sentence on what the field means.
    **limits
        ``low``, ``high``, ``above``, ``below``, ``mirror`` of `Key`.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass
    ... class Tube:
    ...     wall: float = quantity("length", doc="wall thickness", above=0.0)
    """
    return field(default=default, metadata={KEY: Key(doc, dimension, **limits)})


def plain(default: Any = MISSING, *, doc: str, **limits: Any) -> Any:
    """Declare a dataclass field without a dimension: a count, a ratio, a name, a table."""
    return field(default=default, metadata={KEY: Key(doc, None, **limits)})
