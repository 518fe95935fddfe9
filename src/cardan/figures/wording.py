"""Numbers as people read them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from cardan.texts import _, plural
from cardan.units import thousands

if TYPE_CHECKING:
    from cardan.questions.phases.phases import Phasing

THIN = "\u202f"


def significant(value: float, digits: int = 4) -> str:
    """Return a number with so many significant digits, a true minus and thin grouping.

    Examples
    --------
    >>> significant(0.125603), significant(-12.0, 3), significant(123456.0), significant(0.0)
    ('0.1256', '−12.0', '123\u202f456', '0')
    """
    if not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    size = math.floor(math.log10(abs(value)))
    if not -5 <= size < 9:
        mantissa, _sign, power = f"{value:.{digits - 1}e}".partition("e")
        return f"{mantissa}·10{_raised(int(power))}".replace("-", "−")
    return thousands(value, max(0, digits - 1 - size)).replace("-", "−")


def angular(value: float, digits: int = 4) -> str:
    """Return an angle before its sign °, which does not touch a power of ten: 10⁻⁷° would be read as one of ⁻⁷⁰.

    Examples
    --------
    >>> f"{angular(12.5)}° {angular(4.31e-7, 2)}°"
    '12.50° 4.3·10⁻⁷\u202f°'
    """
    text = significant(value, digits)
    return text + THIN if "·" in text else text


def given(value: float) -> str:
    """Return a number as it was given: four significant digits at most, none that is nought at the end.

    Examples
    --------
    >>> given(6.0), given(1500.0), given(7.9271), given(0.250)
    ('6', '1\u202f500', '7.927', '0.25')
    """
    text = significant(value)
    return text.rstrip("0").rstrip(".") if "." in text and "·" not in text else text


def fixed(value: float, decimals: int = 2) -> str:
    """Return a number with so many decimals, never "-0".

    Examples
    --------
    >>> fixed(-0.001), fixed(-22.918)
    ('0.00', '−22.92')
    """
    if not math.isfinite(value):
        return "–"
    return f"{value:z,.{decimals}f}".replace(",", THIN).replace("-", "−")


def used(share: float) -> str:
    """Return how much of a limit is used, where a limit of nothing is used without end.

    Examples
    --------
    >>> used(0.784), used(float("inf"))
    ('0.78', '∞')
    """
    return "∞" if share == math.inf else fixed(share)


def percent(share: float, digits: int = 3) -> str:
    """Return a share in percent; what is nothing but rounding is 0.

    Examples
    --------
    >>> percent(0.12512), percent(3e-16), percent(2.34e-6), percent(0.00069)
    ('12.5 %', '0 %', '0.000234 %', '0.0690 %')
    """
    if abs(share) < 1e-13:
        return "0 %"
    return f"{significant(100.0 * share, digits)} %"


def noiseless(slope: Iterable[float], largest: float) -> list[float]:
    """Return slopes of the irregularity with 0 for those that are nothing but rounding.

    Parameters
    ----------
    slope : iterable of float
        At a minimum the slope is 0 only to the rounding of the yoke angles.
    largest : float
        Largest irregularity that turning the yokes can make; no slope is much greater.

    Examples
    --------
    >>> noiseless([0.01, 8e-9], 0.2)
    [0.01, 0.0]
    """
    return [float(one) if abs(one) > 1e-6 * largest else 0.0 for one in slope]


LITTLE = 0.01
"""An irregularity below which what the yokes leave is called little."""


def excess(found: Phasing, joints: int, bend: float, *, single_cross: bool = True) -> str:
    """Return in one sentence which joint keeps a drive from being even, and at what bend it would not.

    Parameters
    ----------
    found : Phasing
        What the yokes can do; a single joint is too uneven for the others.
    joints : int
        Number of joints.
    bend : float [rad]
        Bend of that joint.
    single_cross : bool
        Whether it is a cross joint; of another no bend is named.

    Notes
    -----
    The side L = -ln cos α of that joint is asinh(δ/2) too long.
    """
    if not single_cross:
        text = _("Joint {number} is more uneven than the others can undo. What remains is {left}.")
        return text.format(number=found.limiting_joint, left=percent(found.irregularity_min))
    spare = math.asinh(0.5 * found.irregularity_min)
    closing, now = math.degrees(math.acos(min(1.0, math.cos(bend) * math.exp(spare)))), math.degrees(bend)
    digits = next((d for d in (2, 3, 4, 5) if fixed(closing, d) != fixed(now, d)), 6)
    if found.irregularity_min < LITTLE:
        text = plural(
            "Joint {number} bends a little more than the other one can undo: with {closing}° instead of {now}° the "
            "drive could be even. What remains is {left}.",
            "Joint {number} bends a little more than the others can undo: with {closing}° instead of {now}° the drive "
            "could be even. What remains is {left}.",
            joints - 1,
        )
    else:
        text = plural(
            "Joint {number} bends more than the other one can undo: with {closing}° instead of {now}° the drive could "
            "be even. What remains is {left}.",
            "Joint {number} bends more than all others together can undo: with {closing}° instead of {now}° the drive "
            "could be even. What remains is {left}.",
            joints - 1,
        )
    return text.format(
        number=found.limiting_joint,
        closing=fixed(closing, digits),
        now=fixed(now, digits),
        left=percent(found.irregularity_min),
    )


def letters(found: Phasing, *, nearest: bool = False) -> str:
    """Return what the letters of the settings stand for, "" where there is no choice.

    Parameters
    ----------
    found : Phasing
        Settings, best first.
    nearest : bool
        Whether the goal was the least change of the present yokes instead of calm intermediate shafts.
    """
    if not found.feasible or len(found.settings) < 2:
        return ""
    if len(found.free) < 3:
        return _("A and B are mirror images; both are exact.")
    if len(found.settings) == 2:
        return _("A is the best by the goal; B is exact as well.")
    if nearest:
        return _("A is nearest to the present yokes, B its mirror image; C keeps the intermediate shafts calmest.")
    return _("A keeps the intermediate shafts calmest, B is its mirror image; C is nearest to the present yokes.")


def half_turn(angle: float) -> float:
    """Return an angle [°] in (-90, 90]: yokes and planes are lines, not arrows.

    Examples
    --------
    >>> half_turn(-90.0), half_turn(178.0)
    (90.0, -2.0)
    """
    return 90.0 - (90.0 - angle) % 180.0


def powers_of_ten(values: Sequence[float]) -> tuple[str, ...]:
    """Return powers of ten, in full where all of them are short.

    Examples
    --------
    >>> powers_of_ten((0.01, 1.0)), powers_of_ten((1e-6, 1.0))
    (('0.01', '1'), ('10⁻⁶', '10⁰'))
    """
    powers = [round(math.log10(value)) for value in values]
    if all(-3 < power < 4 for power in powers):
        return tuple(f"{value:g}" for value in values)
    return tuple(f"10{_raised(power)}" for power in powers)


def _raised(number: int) -> str:
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
