"""Numbers as people read them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from cardan.answers.numbers import THIN as THIN
from cardan.answers.numbers import fixed as fixed
from cardan.answers.numbers import half_turn as half_turn
from cardan.answers.numbers import raised
from cardan.answers.numbers import significant as significant
from cardan.maths.ties import power_of
from cardan.texts import _


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


def together(words: Iterable[str]) -> str:
    """Return what is alike named in one breath.

    Examples
    --------
    >>> together(["2"]), together(["2", "3"]), together(["1", "2", "4"])
    ('2', '2 and 3', '1, 2 and 4')
    """
    *before, last = words
    return _(" and ").join((", ".join(before), last)) if before else last


def closely(residual: float) -> str:
    """Return how closely a check holds: its digits beyond the power of ten are the processor's.

    Parameters
    ----------
    residual : float
        What is left over, relative.

    Examples
    --------
    >>> closely(7e-16), closely(3.2e-10), closely(0.02), closely(float("nan"))
    ('to rounding', 'to 10⁻⁹', 'to 0.1', 'not at all')
    """
    if not math.isfinite(residual):
        return _("not at all")
    power = power_of(residual)
    return _("to rounding") if power is None else _("to {size}").format(size=powers_of_ten((10.0**power,))[0])


def leftover(residual: float) -> str:
    """Return a residual for a cell beside what is allowed: below which power of ten it is, or that it is rounding.

    Examples
    --------
    >>> leftover(7e-16), leftover(3.2e-10), leftover(float("nan"))
    ('rounding', '< 10⁻⁹', '–')
    """
    if not math.isfinite(residual):
        return "–"
    power = power_of(residual)
    return _("rounding") if power is None else f"< {powers_of_ten((10.0**power,))[0]}"


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
    return tuple(f"10{raised(power)}" for power in powers)
