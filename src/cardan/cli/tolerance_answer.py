"""What ``cardan tolerance`` answers: the bounds of the output, and which tolerance makes which share of them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.accuracy.tolerance import Band, Contribution, ToleranceBand

    from .answer import Answer, Remark, Table

UM = 1e-6
"""Shifts are told in µm."""

FIRST_ORDER = 5.0
"""Errors of the output [°] beyond which the influence of an error, a tangent, is no longer to be trusted."""


def answer(drive: Drive, file: Path, found: ToleranceBand) -> Answer:
    """Return what there is to say of the bounds of a drive's output."""
    from .answer import Answer
    from .asked import figures

    return Answer(
        sentence=_sentence(drive, file, found),
        tables=lambda: [
            _band_table(found),
            *(_part_table(band, length=length) for band, length in _bands(found)),
        ],
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _trace(found),
        figure=lambda: figures(found),
    )


def _bands(found: ToleranceBand) -> list[tuple[Band, bool]]:
    """Return what tolerances leave open, and whether it is a length."""
    both = ((found.output, False), (found.shift, True))
    return [(band, length) for band, length in both if band.contributions]


def _scale(*, length: bool) -> float:
    from cardan.units import arcmin

    return UM if length else arcmin


def _sentence(drive: Drive, file: Path, found: ToleranceBand) -> str:
    from .answer import significant
    from .source import title

    name, how = title(drive, file), _how(found)
    band, length = _bands(found)[0]
    size = significant(band.largest / _scale(length=length), 3)
    first = band.contributions[0]
    share = significant(100.0 * first.share, 2)
    if length:
        text = _("{name}: the output shifts by up to ±{size} µm ({how}); {part} makes {share} % of the variance.")
    else:
        text = _("{name}: the output errs by up to ±{size}′ ({how}); {part} makes {share} % of the variance.")
    return text.format(name=name, size=size, how=how, part=part(first.field), share=share)


def _how(found: ToleranceBand) -> str:
    from cardan.questions.accuracy.sampling import MonteCarlo
    from cardan.questions.accuracy.tolerance import WorstCase

    if isinstance(found.method, WorstCase):
        return _("worst case")
    return _("99.7 % of drives") if isinstance(found.method, MonteCarlo) else _("root of squares")


def part(field: str) -> str:
    """Return what a tolerance is called in words.

    Examples
    --------
    >>> part("joints[0].tolerance.alpha2")
    'alpha2 of joint 1'
    """
    number = int(field.split("[")[1].split("]")[0]) + 1
    return _("{key} of joint {number}").format(key=field.rpartition(".")[2], number=number)


def _band_table(found: ToleranceBand) -> Table:
    from .answer import Cell, Column, Table
    from .asked import tidy

    rows: list[list[Cell]] = []
    for band, length in _bands(found):
        unit = _scale(length=length)
        inner = max(abs(band.lower_95).max(), abs(band.upper_95).max())
        values = tidy([band.largest, inner, band.peak_to_peak, band.mean, band.first, band.second])
        rows.append([_("shift, µm") if length else _("angle, ′"), *(float(value) / unit for value in values)])
    columns = (
        Column(key="output", heading=_("output"), left=True),
        Column(key="largest", heading=_("errs by"), unit=_("up to ±")),
        Column(key="largest_95", heading=_("95 % of"), unit=_("drives ±")),
        Column(key="peak_to_peak", heading=_("changes"), unit=_("in a turn")),
        Column(key="mean", heading=_("of it stays"), unit="±"),
        Column(key="first", heading=_("once"), unit=_("a turn ±")),
        Column(key="second", heading=_("twice"), unit=_("a turn ±")),
    )
    return Table(columns=columns, rows=rows)


def _part_table(band: Band, *, length: bool) -> Table:
    from .answer import Column, Table

    unit = _scale(length=length)
    label = _("± µm") if length else "± ′"

    def shown(value: float) -> float:
        return value / unit if value > 1e-9 * band.largest else 0.0

    rows = [
        (
            part(one.field),
            one.tolerance / unit,
            100.0 * one.share,
            shown(one.largest),
            shown(one.mean),
            shown(one.first),
            shown(one.second),
        )
        for one in band.contributions
    ]
    columns = (
        Column(key="tolerance", heading=_("shift by") if length else _("angle by"), left=True),
        Column(key="size", heading=_("tolerance"), unit=label),
        Column(key="share_percent", heading=_("share"), unit="%", form=".1f"),
        Column(key="largest", heading=_("alone"), unit=label),
        Column(key="mean", heading=_("stays"), unit=label),
        Column(key="first", heading=_("once"), unit=label),
        Column(key="second", heading=_("twice"), unit=label),
    )
    return Table(columns=columns, rows=rows)


def _remarks(drive: Drive, file: Path, found: ToleranceBand) -> Iterator[Remark]:
    from cardan.questions.accuracy.sampling import MonteCarlo
    from cardan.units import deg

    from .answer import Remark, significant
    from .source import STDIN

    for band, length in _bands(found):
        unit = _scale(length=length)
        low, high = float(band.centre.min()) / unit, float(band.centre.max()) / unit
        if max(abs(low), abs(high)) > 1e-9:
            text = _("Known errors shift the {what} by {low} to {high}; the bounds hold that.")
            what = _("output, µm,") if length else _("angle, ′,")
            yield Remark(text=text.format(what=what, low=significant(low, 3), high=significant(high, 3)))
    if found.output.largest > FIRST_ORDER * deg and not isinstance(found.method, MonteCarlo):
        text = _("Warning: errors this large are beyond first order; --method samples counts the exact loops.")
        yield Remark(text=text, tone="warning")
    yield Remark(text=_("Shares are of the variance over a turn; what stays, setting the output up takes away."))
    if found.convergence is not None and isinstance(found.method, MonteCarlo):
        text = _("{count} drives drawn, seed {seed}: the standard deviation is known to {error}.")
        drawn = int(found.convergence.samples[-1])
        error = f"{100.0 * found.convergence.standard_error:.1g} %"
        yield Remark(text=text.format(count=drawn, seed=found.method.seed, error=error))
        if found.convergence.lost:
            text = _("Warning: {count} of them could not be assembled and are left out.")
            yield Remark(text=text.format(count=found.convergence.lost), tone="warning")
    if found.cancelled:
        yield Remark(text=_("Warning: the sampling was stopped; this is of what was drawn."), tone="warning")
    if file == STDIN:
        return
    band, length = _bands(found)[0]
    half = float(f"{0.5 * band.largest / _scale(length=length):.2g}") * _scale(length=length)
    text = _("Find the cheapest tolerances for half of that:")
    parts = ("cardan", "tolerance", str(file), "--allocate", goal(half, length=length))
    yield Remark(text=text, command=parts, tone="next")


def goal(size: float, *, length: bool) -> str:
    """Return an error as ``--allocate`` takes it.

    Examples
    --------
    >>> goal(1e-5, length=True)
    '0.01mm'
    """
    from cardan.units import arcmin, mm

    return f"{size / mm:.10g}mm" if length else f"{size / arcmin:.10g}arcmin"


def _trace(found: ToleranceBand) -> Table:
    """Return the bounds at every position."""
    import numpy as np

    from .answer import Column, Table

    named: list[tuple[str, Any]] = [("angle_deg", np.rad2deg(found.angle))]
    for band, length in _bands(found):
        unit, start, end = (UM, "shift", "um") if length else (_scale(length=False), "error", "arcmin")
        for key in ("centre", "lower", "upper", "lower_95", "upper_95", "deviation"):
            named.append((f"{start}_{key}_{end}", getattr(band, key) / unit))
    table = np.stack([values for _key, values in named], axis=-1)
    return Table(columns=tuple(Column(key=key) for key, _values in named), rows=table.tolist())


def _content(drive: Drive, file: Path, found: ToleranceBand) -> dict[str, Any]:
    from cardan.questions.accuracy.sampling import MonteCarlo

    from .asked import columns_of

    drawn = found.convergence
    sampled = isinstance(found.method, MonteCarlo)
    return {
        "question": "tolerance",
        "drive": drive.name,
        "file": str(file),
        "method": "samples" if sampled else "worst" if _how(found) == _("worst case") else "squares",
        **{("shift" if length else "angle"): _band_content(band, length=length) for band, length in _bands(found)},
        "samples": None if drawn is None else drawn.samples[-1],
        "lost_samples": None if drawn is None else drawn.lost,
        "standard_error": None if drawn is None else drawn.standard_error,
        "seed": found.method.seed if isinstance(found.method, MonteCarlo) else None,
        "bounds": columns_of(_trace(found)),
    }


def _band_content(band: Band, *, length: bool) -> dict[str, Any]:
    unit, end = _scale(length=length), "um" if length else "arcmin"

    def row(one: Contribution) -> dict[str, Any]:
        return {
            "field": one.field,
            f"tolerance_{end}": one.tolerance / unit,
            "share": one.share,
            **{f"{key}_{end}": getattr(one, key) / unit for key in ("largest", "mean", "first", "second")},
        }

    keys = ("largest", "peak_to_peak", "mean", "first", "second")
    return {
        **{f"{key}_{end}": getattr(band, key) / unit for key in keys},
        "contributions": [row(one) for one in band.contributions],
    }
