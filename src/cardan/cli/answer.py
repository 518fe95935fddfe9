"""What a command answers: sentences, tables and the same content for a program. Only data; `show` prints it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from cardan.units import thousands

Cell: TypeAlias = float | int | str | bool | None

Tone: TypeAlias = Literal["plain", "good", "warning", "failed", "next"]


@dataclass(frozen=True, kw_only=True)
class Column:
    """One column of a table.

    Parameters
    ----------
    key : str
        Name in CSV, with its unit: ``lead_deg``.
    heading, unit : str
        What stands above it in the terminal.
    form : str
        Format of its numbers: that of `format`, or ``"4"`` for so many significant digits.
    left : bool
        Align to the left: words, not numbers.
    wrap : bool
        The last column of a table may be prose, broken into lines.
    """

    key: str
    heading: str = ""
    unit: str = ""
    form: str = "4"
    left: bool = False
    wrap: bool = False


@dataclass(frozen=True, kw_only=True)
class Table:
    """Rows of values in the units of their columns; the first ``fixed`` columns are repeated when it is split.

    ``tones`` says how good each row is; its first cell then has that colour, beside the sign and word it holds.
    """

    columns: tuple[Column, ...]
    rows: Sequence[Sequence[Cell]]
    title: str = ""
    fixed: int = 1
    tones: Sequence[Tone] = ()


@dataclass(frozen=True, kw_only=True)
class Remark:
    """One sentence below the tables; a command to type next stands on a line of its own, ready to be copied."""

    text: str
    command: tuple[str, ...] = ()
    tone: Tone = "plain"


@dataclass(frozen=True, kw_only=True)
class Answer:
    """Everything a command has to say.

    Parameters
    ----------
    sentence : str
        The answer.
    tone : str
        How good it is; shown as a sign and a colour.
    tables : callable
        Makes the tables for the terminal.
    remarks : sequence of Remark
        What it means, what to mind, what to do next.
    content : callable
        Makes the same for a program, in full precision; keys carry their units.
    csv : callable
        Makes the full table.
    figure : callable, optional
        Makes the figure of ``--plot`` when asked for.
    code : int
        Exit code.
    """

    sentence: str
    tone: Tone = "plain"
    tables: Callable[[], Sequence[Table]] = tuple
    remarks: Sequence[Remark] = ()
    content: Callable[[], dict[str, Any]] = dict
    csv: Callable[[], Table] | None = None
    figure: Callable[[], Any] | None = None
    code: int = 0


def significant(value: float, digits: int = 4) -> str:
    """Return a number with so many significant digits and thin grouping.

    Examples
    --------
    >>> significant(0.125603), significant(12.0), significant(1e-9)
    ('0.1256', '12.00', '1.000e-09')
    """
    if value == 0.0:
        return "0"
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "∞" if value > 0.0 else "-∞"
    size = math.floor(math.log10(abs(value)))
    if not -4 <= size < 9:
        return f"{value:.{digits - 1}e}"
    return thousands(value, max(0, digits - 1 - size))


def printed(value: Cell, form: str = "4") -> str:
    """Return a cell as the terminal shows it.

    Examples
    --------
    >>> printed(-0.0001, ".2f"), printed(None), printed(True), printed(3)
    ('0.00', '–', 'yes', '3')
    """
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, bool):
        from cardan.texts import _

        return _("yes") if value else _("no")
    if isinstance(value, str | int):
        return str(value)
    return significant(value, int(form)) if form.isdigit() else format(value, "z" + form)


def named(number: int, name: str) -> str:
    """Return a number with its name, short enough for a column.

    Examples
    --------
    >>> named(2, "front"), named(3, "")
    ('2 front', '3')
    """
    short = name if len(name) <= 20 else name[:19] + "…"
    return f"{number} {short}".strip()


def percent(share: float) -> str:
    """Return a share in percent; what is nothing but rounding is 0.

    Examples
    --------
    >>> percent(0.12512), percent(1e-16)
    ('12.51 %', '0 %')
    """
    return "0 %" if abs(share) < 1e-13 else f"{significant(100.0 * share)} %"
