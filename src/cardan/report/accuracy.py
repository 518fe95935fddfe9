"""How exactly the output follows the input, given errors and tolerances of the joints."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.drive.accuracy import Error
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.wording import significant
from cardan.maths.arrays import Array
from cardan.questions.accuracy.accuracy import Course, TransmissionError, course, transmission_error
from cardan.questions.accuracy.figure import MICRON, band_figure, error_figure, pareto_figure, tolerance_name
from cardan.questions.accuracy.tolerance import Band, ToleranceBand, WorstCase, tolerance
from cardan.texts import _
from cardan.units import arcmin

from .balance import checks, refused
from .block import Block, Cell, Column, Page, Picture, Table, Words, key, number, words
from .lacking import of_accuracy
from .subject import Subject

CURVED = 0.02
"""Share by which exact loops may differ from the influence, which is a tangent: errors of some degrees bend it so."""


def erring(on: Subject) -> Page | None:
    """Return the page of the accuracy; None where no joint has an error or a tolerance."""
    if of_accuracy(on.drive):
        return None
    spread = any(joint.tolerance is not None for joint in on.drive.joints)
    title = _("Accuracy")
    try:
        known = transmission_error(on.drive)
        bands = (tolerance(on.drive), tolerance(on.drive, method=WorstCase())) if spread else None
    except InputError as error:
        return refused("accuracy", title, error)
    shifts = not any(one.axial and one.shaft == len(on.drive.shafts) for one in on.drive.supports)
    blocks: list[Block] = []
    if not bool(np.all(known.closes)):
        figure = error_figure(known)
        failed = Words(text=figure.sentence, tone="failed")
        blocks.append(failed)
        return Page(name="accuracy", title=title, answer=figure.sentence, blocks=blocks, alarms=[failed])
    if bands is None and not _errs(known, shifts):
        return None
    figure = error_figure(known, shifts=shifts) if bands is None else band_figure(bands[0], shifts=shifts)
    blocks = [Picture(figure=figure)]
    if bands is not None:
        blocks.append(Picture(figure=pareto_figure(bands[0], shifts=shifts)))
    blocks += [_table(known, bands, shifts=shifts), _checks(on.drive, known, bands)]
    answer = figure.sentence
    if bands is not None and bands[0].output.contributions:
        answer = _("The output follows within {most}′, at worst {worst}′; {name} matters most.").format(
            most=significant(bands[0].output.largest / arcmin, 3),
            worst=significant(bands[1].output.largest / arcmin, 3),
            name=tolerance_name(bands[0].output.contributions[0].field)[0],
        )
    return Page(name="accuracy", title=title, answer=answer, blocks=blocks, keys=list(_keys(known, bands)))


def _keys(known: TransmissionError, bands: tuple[ToleranceBand, ToleranceBand] | None) -> Iterator[list[Cell]]:
    if bands is None:
        yield key(_("error of the output angle"), float(np.max(np.abs(np.asarray(known.error)))) / arcmin, "′")
        return
    for name, band in zip((_("root of squares"), _("worst case")), bands, strict=True):
        if band.output.largest > 0.0:
            text = _("error of the output angle, {way}").format(way=name)
            yield key(text, band.output.largest / arcmin, "′", None, significant(band.output.largest / arcmin, 3))


def _errs(known: TransmissionError, shifts: bool) -> bool:
    """Return whether known errors do anything to the output: what a bearing holds does not shift."""
    turned, shifted = (float(np.max(np.abs(np.asarray(one)))) for one in (known.error, known.output_shift))
    return turned > 0.0 or (shifts and shifted > 0.0)


def _table(known: TransmissionError, bands: tuple[ToleranceBand, ToleranceBand] | None, *, shifts: bool) -> Table:
    rows: list[Sequence[Cell]] = []
    for name, curve, part, size, unit in (
        (_("output angle"), np.asarray(known.error), "output", arcmin, "arcmin"),
        (_("output shift"), np.asarray(known.output_shift), "shift", MICRON, "µm"),
    )[: 2 if shifts else 1]:
        if float(np.max(np.abs(curve))) > 0.0:
            rows.append(_known(name, course(curve), curve, size, unit))
        if bands is not None:
            for way, band in zip((_("root of squares"), _("worst case")), bands, strict=True):
                one: Band = getattr(band, part)
                if one.largest > 0.0:
                    row = (one.mean, one.first, one.second, one.peak_to_peak, one.largest)
                    rows.append([words(name), words(way), *_amounts(row, size), words(unit)])
    return Table(
        title=_("Errors of the output"),
        columns=(
            Column(heading=_("what"), left=True),
            Column(heading=_("by"), left=True),
            Column(heading=_("constant")),
            Column(heading=_("once a turn")),
            Column(heading=_("twice a turn")),
            Column(heading=_("change over a turn")),
            Column(heading=_("largest")),
            Column(heading="", left=True),
        ),
        rows=rows,
        note=_("Setting the drive up once takes the constant part away."),
    )


def _known(name: str, parts: Course, curve: Array, size: float, unit: str) -> list[Cell]:
    largest = float(np.max(np.abs(curve)))
    row = (abs(float(parts.mean)), float(parts.first), float(parts.second), float(parts.peak_to_peak), largest)
    return [words(name), words(_("known errors")), *_amounts(row, size), words(unit)]


def _amounts(row: Sequence[float], size: float) -> list[Cell]:
    top = max(row)
    return [number("0" if value <= 1e-9 * top else significant(value / size, 3), value / size) for value in row]


def _checks(drive: Drive, known: TransmissionError, bands: tuple[ToleranceBand, ToleranceBand] | None) -> Table:
    rows = []
    first = np.asarray(known.error_linear)
    if float(np.max(np.abs(first))) > 0.0:
        rows.append(
            (
                _("known errors"),
                _("exact loops less first order, over the largest error"),
                _miss(np.asarray(known.error), float(np.max(np.abs(first))), first),
                CURVED,
            )
        )
    if bands is not None and bands[0].output.contributions:
        worst = bands[0].output.contributions[0]
        name, joint, _long = tolerance_name(worst.field)
        key = worst.field.rpartition(".")[2]
        errors = [Error(**{key: worst.tolerance}) if k == joint else None for k in range(1, len(drive.joints) + 1)]
        exact = np.asarray(transmission_error(drive, errors=errors).error)
        rows.append(
            (
                _("influence of {name}").format(name=name),
                _("exact loop with that error alone, over the largest error that the influence gives"),
                abs(float(np.max(np.abs(exact))) / worst.largest - 1.0),
                CURVED,
            )
        )
        ratio = float(np.max(np.asarray(bands[0].output.upper) - np.asarray(bands[1].output.upper)))
        rows.append(
            (
                _("bounds"),
                _("root of squares beyond the worst case, over the worst case"),
                max(0.0, ratio) / bands[1].output.largest,
                1e-12,
            )
        )
    shift = np.asarray(known.shift_linear)[..., -1, :]
    if not rows:
        rows.append(
            (
                _("known shift"),
                _("exact loops less first order, over the largest shift"),
                _miss(np.asarray(known.output_shift), float(np.max(np.abs(shift), initial=1e-300)), shift),
                CURVED,
            )
        )
    return checks(rows)


def _miss(exact: Array, size: float, first: Array) -> float:
    return float(np.max(np.abs(exact - first))) / size
