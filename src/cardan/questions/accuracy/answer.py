"""What there is to say of the accuracy of a drive: bounds of the output, what makes them, the cheapest tolerances."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import degrees, floor, isfinite, log10
from pathlib import Path
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Checked, Column, Depth, KeyFigure, Remark, Table, checks, closely
from cardan.answers.quantity import Joined, Quantity, Say, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import in_a_joint
from cardan.drive.models.wobble import wobbling
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost, largest
from cardan.texts import _, mark, plural
from cardan.units import arcmin, deg, mm

from .accuracy import TransmissionError, course, transmission_error
from .allocation import SQUARES, Allocation, Allotted, Of
from .cross_play import CrossPlay, cross_play, loop_slides
from .figure import (
    ANGLE,
    SHIFT,
    Side,
    band_figure,
    cross_figure,
    error_figure,
    measure,
    pareto_figure,
    sides,
    tolerance_figures,
    tolerance_name,
)
from .own_laws import table_of
from .sampling import MonteCarlo
from .shaft_places import PlaceShare, ShaftPlace, Ways, alone, largest_way, shaft_places, still_joints
from .tolerance import Band, Contribution, Linear, Method, ToleranceBand, WorstCase, stacked, tolerance

CURVED = 0.02
"""Share by which exact loops may differ from the influence, which is a tangent: errors of some degrees bend it so."""

FIRST_ORDER = 5.0 * deg
"""Errors of the output beyond which the influence of an error, a tangent, is no longer to be trusted."""

NONE = 1e-9
"""Values below this share of the largest are nothing but rounding."""

DIGITS = 3
"""Digits of the tolerances that are written into a file, rounded down so that the target holds."""

TOLD = 0.1
"""Share of all that moves a shaft below which a tolerance has no row of its own."""

MOST_ANGLES = 6
"""More angles than this at which the target is reached are counted."""

METHODS: dict[type, str] = {Linear: "squares", WorstCase: "worst", MonteCarlo: "samples"}
"""How errors add up -> what programs call it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Accuracy:
    """What errors and tolerances do to the output."""

    known: TransmissionError  # what the known errors do, exactly
    # what the tolerances leave open, as asked; None without any, or where the joints cannot be assembled
    band: ToleranceBand | None = None
    worst: ToleranceBand | None = None  # the same in the worst case
    crosses: tuple[CrossPlay, ...] = ()  # how the cross of each joint moves; empty without errors of length
    shafts: tuple[ShaftPlace, ...] = ()  # how far shafts lie off; empty where no error moves one

    @property
    def closes(self) -> bool:
        """Whether every joint can be assembled at every position, with its known errors."""
        return bool(np.all(self.known.closes))


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for its accuracy: errors or tolerances of a joint."""
    some = any(joint.tolerance is not None or joint.error is not None or joint.tolerated for joint in drive.joints)
    keys = (*in_a_joint(drive, "tolerance"), *in_a_joint(drive, "error"))
    return absent((some, *keys))


def ask(
    drive: Drive, *, method: Method = SQUARES, progress: Callable[[float], object] | None = None
) -> Accuracy | None:
    """Return what errors and tolerances do to the output; None where there are errors alone, and these do nothing.

    drive: with errors or tolerances of its joints.
    progress: called with the share done of a sampling; answering "stop" ends it.
    Raises InputError: no joint has an error or a tolerance, or errors of joints of such a kind cannot be told.
    """
    if lacking(drive):
        tolerance(drive, method=method)  # refuses, and says why
    known = transmission_error(drive)
    found = Accuracy(known=known)
    if not found.closes:
        return found
    if not any(joint.tolerance is not None or joint.tolerated for joint in drive.joints):
        shifts, moves, shafts = _shifts(drive), cross_play(drive, None), shaft_places(drive, None)
        acts = moves or shafts or any(_largest(_curve(known, side)) > 0.0 for side in (ANGLE, SHIFT)[: 1 + shifts])
        return replace(found, crosses=moves, shafts=shafts) if acts else None
    band = tolerance(drive, method=method, progress=progress)
    worst = band if isinstance(method, WorstCase) else tolerance(drive, method=WorstCase())
    return Accuracy(
        known=known, band=band, worst=worst, crosses=cross_play(drive, band), shafts=shaft_places(drive, band)
    )


def otherwise(_drive: Drive) -> str:
    """Return why nothing can be told although nothing is missing."""
    return _("The errors given do nothing to the output.")


def answer(drive: Drive, result: Accuracy) -> Answer:
    """Return what there is to say of the accuracy of a drive."""
    title = _("Accuracy")
    if not result.closes:
        text = _("with these errors a joint cannot be assembled at every position.")
        return Answer(
            name="accuracy",
            title=title,
            sentence=text,
            tone="failed",
            remarks=(Remark(text=_("Failed: known errors keep a joint from closing."), tone="failed", alarm=True),),
            figures=lambda: (error_figure(result.known, shifts=_shifts(drive)),),
            facts={"closes": False},
        )
    return Answer(
        name="accuracy",
        title=title,
        sentence=_sentence(drive, result),
        tables=tuple(_tables(drive, result)),
        remarks=(*_as_drawn(drive), *_unmoved(drive), *_remarks(drive, result)),
        keys=(*_keys(drive, result), *_cross_key(result)),
        figures=lambda: _figures(drive, result),
        facts=_facts(result),
        full=lambda: _bounds(result),
    )


def _shifts(drive: Drive) -> bool:
    """Return whether nothing but the last joint holds the output shaft along its axis."""
    return not any(one.axial and one.shaft == len(drive.shafts) for one in drive.supports)


def _open(drive: Drive, band: ToleranceBand) -> list[tuple[Side, Band]]:
    return sides(band, shifts=_shifts(drive))


def _shown(drive: Drive, result: Accuracy) -> list[Side]:
    """Return the sides of the output that anything is done to."""
    opened = [] if result.band is None else [side for side, _band in _open(drive, result.band)]
    able = (ANGLE, SHIFT)[: 1 + _shifts(drive)]
    return [one for one in (ANGLE, SHIFT) if one in opened or (one in able and _largest(_curve(result.known, one)))]


def _curve(known: TransmissionError, side: Side) -> Array:
    """Return what known errors do over the turn, exactly."""
    return np.asarray(known.output_shift if side is SHIFT else known.error)


def _largest(curve: Array) -> float:
    return float(np.max(np.abs(curve)))


def _band_of(found: ToleranceBand, side: Side) -> Band:
    return found.shift if side is SHIFT else found.output


def _figures(drive: Drive, result: Accuracy) -> tuple[Any, ...]:
    shifts = _shifts(drive)
    angle = np.asarray(result.known.angle if result.band is None else result.band.angle)
    moves = (cross_figure(angle, result.crosses),) if result.crosses else ()
    if result.band is not None:
        some = _open(drive, result.band)
        bands = (band_figure(result.band, shifts=shifts), pareto_figure(result.band, shifts=shifts)) if some else ()
        return *bands, *moves
    return (*((error_figure(result.known, shifts=shifts),) if _shown(drive, result) else ()), *moves)


def _way(method: Method) -> str:
    """Return how errors add up, in words."""
    if isinstance(method, WorstCase):
        return _("worst case")
    return _("99.7 % of drives") if isinstance(method, MonteCarlo) else _("root of squares")


def _sentence(drive: Drive, result: Accuracy) -> Say:
    if result.band is None or result.worst is None:
        if not (shown := _shown(drive, result)):
            if not result.crosses:
                return _moved(result)
            way = max(result.crosses, key=lambda one: one.play)
            text = _(
                "known errors do nothing to the output; over a turn they move the cross of joint {number} by {way} in "
                "its {yoke} yoke."
            )
            return say(text, number=way.joint, way=SHIFT.quantity(way.play), yoke=_yokes()[way.yoke])
        side = shown[0]
        curve = _curve(result.known, side)
        text = _("known errors make an angle error of up to {size} at the output; over a turn it changes by {change}.")
        if side is SHIFT:
            text = _("known errors shift the output by up to {size}; over a turn that changes by {change}.")
        return say(text, size=side.quantity(_largest(curve)), change=side.quantity(float(np.ptp(curve))))
    if not (some := _open(drive, result.band)):
        return _moved(result)
    side, band = some[0]
    first = band.contributions[0]
    alike = [band.contributions[k] for k in largest([one.share for one in band.contributions])]
    parts = Joined([_named(one) for one in alike], last=_(" and "))
    bounds = say(_("±{size} ({how})"), size=side.quantity(band.largest), how=_way(result.band.method))
    if not isinstance(result.band.method, WorstCase):
        most = side.quantity(_band_of(result.worst, side).largest)
        text = _("±{size} ({how}), ±{most} in the worst case")
        bounds = say(text, size=side.quantity(band.largest), how=_way(result.band.method), most=most)
    texts = {
        (False, False): _("angle error of the output up to {bounds}; {parts} makes {share} of the variance."),
        (False, True): _("angle error of the output up to {bounds}; {parts} make {share} of the variance each."),
        (True, False): _("shift of the output up to {bounds}; {parts} makes {share} of the variance."),
        (True, True): _("shift of the output up to {bounds}; {parts} make {share} of the variance each."),
    }
    text = texts[side is SHIFT, len(alike) > 1]
    return say(text, bounds=bounds, parts=parts, share=Quantity(first.share, "share", 2))


def _moved(result: Accuracy) -> Say:
    """Return what errors do that turn nothing: by how much they move which shaft."""
    if not result.shafts:
        return say(_("the tolerances do nothing to the output."))
    most = max(result.shafts, key=lambda one: max(one.largest[:2]))
    text = _("errors inside the joints do not turn the output; they move shaft {number} across itself by up to {way}.")
    return say(text, number=most.shaft, way=SHIFT.quantity(max(most.largest[:2])))


def _tables(drive: Drive, result: Accuracy) -> Iterator[Table]:
    text = _(
        "95 %: of the drives; 1× and 2×: once and twice a turn. Setting the output up once takes the constant part "
        "away."
    )
    effects = [_effects(result, side) for side in _shown(drive, result)]
    yield from (replace(one, note=text if one is effects[-1] else "") for one in effects)
    if result.crosses:
        yield _moves(result)
    if result.band is not None and (some := _open(drive, result.band)):
        *first, last = (_parts(side, one) for side, one in some)
        yield from first
        yield replace(last, note=_("Shares are of the variance over a turn."))
    if result.shafts:
        yield _lying(result)
    yield checks(list(_checks(drive, result)))


def _yokes() -> dict[str, str]:
    return {"driving": _("driving"), "driven": _("driven")}


def _moves(result: Accuracy) -> Table:
    """Return the table of how the crosses move along their journals."""
    rows, names = result.crosses, _yokes()
    ends = [one.ends for one in rows]
    return Table(
        name="cross",
        title=_("How the crosses move along their journals over a turn"),
        records=True,
        columns=(
            Column(key="joint", heading=_("joint"), values=[one.joint for one in rows]),
            Column(key="", heading=_("in the yoke"), values=[names[one.yoke] for one in rows], left=True),
            Column(key="yoke", values=[one.yoke for one in rows], depth="data"),
            Column(key="", heading=_("cross"), values=[_("slides") if one.free else _("held") for one in rows]),
            Column(key="slides", values=[one.free for one in rows], depth="data"),
            _column(SHIFT, "lowest", [low for low, _high in ends], _("from")),
            _column(SHIFT, "highest", [high for _low, high in ends], _("to")),
            _column(SHIFT, "play", [one.play for one in rows], _("play needed")),
        ),
        note=_("Known errors and tolerances together; the play is the change over a turn, with the cross set once."),
    )


def _lying(result: Accuracy) -> Table:
    """Return the table of how far errors inside the joints move the shafts."""
    rows: list[tuple[int, Any, PlaceShare | None, Ways]] = []
    for one in result.shafts:
        ways = [(_("known errors"), one.known)]
        if result.band is not None and len(one.shares) > 1:
            ways.append((_way(result.band.method), one.reach))
            ways += [] if isinstance(result.band.method, WorstCase) else [(_("worst case"), one.worst)]
        rows += [(one.shaft, how, None, way) for how, way in ways if any(way)]
        for part in one.shares:
            if any(own > TOLD * most for own, most in zip(part.ways, one.worst, strict=True)):
                rows.append((one.shaft, _named(part), part, part.ways))
    kinds = dict.fromkeys(part.dimension for _shaft, _how, part, _ways in rows if part is not None)
    given = {
        kind: [part.tolerance if part and part.dimension == kind else None for *_, part, _w in rows] for kind in kinds
    }
    headings = _("at its joint ±"), _("at its far end ±"), _("lean ±")
    return Table(
        title=_("How far errors inside the joints move the shafts"),
        columns=(
            Column(key="", heading=_("shaft"), values=[shaft for shaft, *_rest in rows]),
            Column(key="", heading=_("how"), values=[how for _shaft, how, *_rest in rows], left=True),
            *(_column(measure(kind), "", values, _("given ±")) for kind, values in given.items()),
            *(
                _column(side, "", [way[k] or None for *_rest, way in rows], heading)
                for k, (side, heading) in enumerate(zip((SHIFT, SHIFT, ANGLE), headings, strict=True))
                if any(way[k] for *_rest, way in rows)
            ),
        ),
        note=_(
            "Across the shaft, from where it lies as drawn, without play inside the joints; it swivels in its next "
            "joint, or in a ball of its own."
        ),
    )


def _effects(result: Accuracy, side: Side) -> Table:
    """Return the table of what known errors do to one side of the output, and what tolerances leave open."""
    ways: list[str] = []
    rows: list[tuple[float | None, ...]] = []
    curve = _curve(result.known, side)
    if _largest(curve):
        parts = course(curve)
        ways.append(_("known errors"))
        mean, first, second = abs(float(parts.mean)), float(parts.first), float(parts.second)
        rows.append((_largest(curve), None, float(parts.peak_to_peak), mean, first, second))
    both = [] if result.band is None or result.worst is None else [result.band, result.worst]
    for found in both[: 1 if len(both) > 1 and both[0] is both[1] else 2]:
        one = _band_of(found, side)
        if one.contributions:
            inner = float(max(np.max(np.abs(one.lower_95)), np.max(np.abs(one.upper_95))))
            ways.append(_way(found.method))
            rows.append((one.largest, inner, one.peak_to_peak, one.mean, one.first, one.second))
    headings = {"largest": _("up to ±"), "largest_95": _("95 % ±"), "peak_to_peak": _("peak to peak")}
    headings |= {"mean": _("constant ±"), "first": "1× ±", "second": "2× ±"}
    values = [_tidy(row) for row in rows]
    return Table(
        title=side.title,
        columns=(
            Column(key="", heading=_("how"), values=ways, left=True),
            *(
                _column(side, key, list(column), heading)
                for (key, heading), column in zip(headings.items(), zip(*values, strict=True), strict=True)
            ),
        ),
    )


def _column(side: Side, key: str, values: Sequence[Any], heading: str = "", depth: Depth = "brief") -> Column:
    """Return a column of errors of one side of the output."""
    return Column(key=key, heading=heading, values=values, dimension=side.dimension, unit=side.unit, depth=depth)


def _measured(
    rows: Sequence[Contribution | Allotted], values: Sequence[Any], key: str, heading: str = "", depth: Depth = "brief"
) -> Iterator[Column]:
    """Yield the columns of values of tolerances, one for each dimension that they have."""
    for kind in dict.fromkeys(one.dimension for one in rows):
        here = [value if one.dimension == kind else None for one, value in zip(rows, values, strict=True)]
        yield _column(measure(kind), key, here, heading, depth)


def _named(one: Contribution | PlaceShare) -> str:
    return tolerance_name(one.joint, one.key, one.pair, one.dimension)


def _tidy(row: Sequence[float | None]) -> list[float | None]:
    """Return numbers with what is nothing but rounding beside the first set to zero."""
    top = row[0] or 0.0
    return [None if one is None else one if one > NONE * top else 0.0 for one in row]


def _parts(side: Side, band: Band) -> Table:
    """Return the table of what each tolerance contributes."""
    rows = band.contributions
    alone = {
        "largest": (_("alone ±"), [one.largest for one in rows]),
        "mean": (_("constant ±"), [one.mean for one in rows]),
        "first": ("1× ±", [one.first for one in rows]),
        "second": ("2× ±", [one.second for one in rows]),
    }
    return Table(
        title=_("What makes the shift") if side is SHIFT else _("What makes the angle error"),
        columns=(
            Column(key="", heading=_("tolerance"), values=[_named(one) for one in rows]),
            *_measured(rows, [one.tolerance for one in rows], "tolerance", _("given ±")),
            Column(key="share", heading=_("share"), values=[one.share for one in rows], dimension="share", decimals=1),
            *(
                _column(side, key, [one if one > NONE * band.largest else 0.0 for one in values], heading)
                for key, (heading, values) in alone.items()
            ),
        ),
    )


def _as_drawn(drive: Drive) -> Iterator[Remark]:
    """Yield of which joints no inner size counts, and why, and how a shaft that wobbles counts."""
    if wobbling(drive):
        text = _("Errors of joint angles and yokes act as on shafts that stand in the middle of their wobble.")
        yield Remark(text=text)
    for number, joint in enumerate(drive.joints, start=1):
        sizes = joint.sizes()
        if joint.single_cross or joint.tolerated or any(size is not None for size in sizes.values()):
            continue
        why = joint.refusal("tolerance")
        if sizes:
            why = _("the file gives none of its sizes that count, {keys}").format(keys=", ".join(sizes))
        text = _("Of joint {number} only alpha4, its joint angle, and phase, the place of its yoke, can be off: {why}.")
        yield Remark(text=say(text, number=number, why=why), code="made_true")


def _unmoved(drive: Drive) -> Iterator[Remark]:
    """Yield of which joints no error inside moves a shaft, and why, one sentence for all with the same reason."""
    found = list(still_joints(drive))
    for why in dict.fromkeys(why for _number, why in found):
        which = [str(number) for number, other in found if other == why]
        text = plural(
            "Errors inside joint {which} move no shaft: {why}.",
            "Errors inside joints {which} move no shaft: {why}.",
            len(which),
        )
        yield Remark(text=say(text, which=Joined(which, last=_(" and ")), why=why), code="shafts_stay")


def _remarks(drive: Drive, result: Accuracy) -> Iterator[Remark]:
    if (most := _tightest(result)) is not None:
        text = _(
            "The cross of joint {number} needs a play of {play} along its journals in the {yoke} yoke; with less it "
            "binds, and the misalignment tells what loads it."
        )
        play = SHIFT.quantity(most.play)
        yield Remark(text=say(text, number=most.joint, play=play, yoke=_yokes()[most.yoke]))
    band = result.band
    if band is None:
        return
    for side, one in _open(drive, band):
        low, high = float(one.centre.min()), float(one.centre.max())
        if max(abs(low), abs(high)) > NONE * side.size:
            text = _("Known errors put the angle off by {low:bare} to {high}; the bounds hold that.")
            if side is SHIFT:
                text = _("Known errors shift the output by {low:bare} to {high}; the bounds hold that.")
            yield Remark(text=say(text, low=side.quantity(low), high=side.quantity(high)))
    if band.output.largest > FIRST_ORDER and not isinstance(band.method, MonteCarlo):
        text = _("Warning: errors this large are beyond first order; --method samples counts the exact loops.")
        yield Remark(text=text, tone="warning")
    if band.convergence is not None and isinstance(band.method, MonteCarlo) and _open(drive, band):
        text = _("{count} drives drawn, seed {seed}: the standard deviation is known to {error}.")
        error = Quantity(band.convergence.standard_error, "share", 1)
        drawn = int(band.convergence.samples[-1])
        yield Remark(text=say(text, count=drawn, seed=band.method.seed, error=error))
    if band.convergence is not None and band.convergence.lost:
        text = _("Warning: {count} of them could not be assembled and are left out.")
        yield Remark(text=say(text, count=int(band.convergence.lost)), tone="warning")
    if isinstance(band.method, MonteCarlo):
        which = _tolerated(drive)
        if which:
            text = plural(
                "Samples leave out the tolerances of pairs inside joint {which}; the worst case counts them.",
                "Samples leave out the tolerances of pairs inside joints {which}; the worst case counts them.",
                len(which),
            )
            yield Remark(text=say(text, which=Joined(which, last=_(" and "))))
    if band.cancelled:
        yield Remark(text=_("Warning: the sampling was stopped; this is of what was drawn."), tone="warning")
    if not (some := _open(drive, band)):
        return
    side, one = some[0]
    half = float(f"{0.5 * one.largest / side.size:.2g}") * side.size
    kept = np.asarray([part.largest for part in one.contributions if part.pair])
    if float(stacked(kept, 1 if isinstance(band.method, WorstCase) else 2)) >= half:
        return  # the tolerances of pairs, which are kept, use that up
    text = _("Find the cheapest tolerances for half of that:")
    yield Remark(text=text, command=("cardan", "accuracy", FILE, "--allocate", goal(half, side)), tone="next")


def _tolerated(drive: Drive) -> list[str]:
    """Return the numbers of the joints whose pairs may be off."""
    return [str(number) for number, joint in enumerate(drive.joints, start=1) if joint.tolerated]


def goal(size: float, side: Side) -> str:
    """Return an error as ``--allocate`` takes it.

    >>> goal(1e-5, SHIFT)
    '0.01mm'
    """
    return f"{size / mm:.10g}mm" if side is SHIFT else f"{size / arcmin:.10g}arcmin"


def _tightest(result: Accuracy) -> CrossPlay | None:
    """Return the held cross that needs the largest play."""
    held = [one for one in result.crosses if not one.free and one.play > 0.0]
    return held[int(foremost(np.asarray([one.play for one in held])))] if held else None


def _cross_key(result: Accuracy) -> Iterator[KeyFigure]:
    """Yield the largest play that a held cross needs."""
    if (most := _tightest(result)) is not None:
        place = say(_("joint {number}, {yoke} yoke"), number=most.joint, yoke=_yokes()[most.yoke])
        title = _("play that the journals need over a turn")
        yield KeyFigure(name="cross_play", title=title, place=place, value=SHIFT.quantity(most.play), better="less")


def _keys(drive: Drive, result: Accuracy) -> Iterator[KeyFigure]:
    if ANGLE not in _shown(drive, result) and result.band is None:
        return
    if result.band is None or result.worst is None:
        largest = _largest(_curve(result.known, ANGLE))
        title, place = _("angle error of the output by the joints as made"), _("against the perfect drive")
        yield KeyFigure(name="error_of_joints", title=title, place=place, value=ANGLE.quantity(largest, 4))
        return
    ways = {"error_of_joints": result.band, "error_of_joints_worst": result.worst}
    for name, found in ways.items():
        if found.output.largest > 0.0 and not (name != "error_of_joints" and found is result.band):
            title, way = _("angle error of the output by the joints as made"), _way(found.method)
            yield KeyFigure(name=name, title=title, place=way, value=ANGLE.quantity(found.output.largest))


def _checks(drive: Drive, result: Accuracy) -> Iterator[Checked]:
    """Yield how the ways to the same number agree."""
    known, band = result.known, result.band
    first = np.asarray(known.error_linear)
    if _largest(first):
        yield Checked(
            what=_("known errors"),
            how=_("exact loops less first order, over the largest error"),
            left=_largest(np.asarray(known.error) - first) / _largest(first),
            allowed=CURVED,
        )
    elif band is None and _shifts(drive):
        shift = np.asarray(known.shift_linear)[..., -1, :]
        yield Checked(
            what=_("known shift"),
            how=_("exact loops less first order, over the largest shift"),
            left=_largest(np.asarray(known.output_shift) - shift) / max(_largest(shift), 1e-300),
            allowed=CURVED,
        )
    shifts = np.asarray(known.shift)
    if result.crosses and _largest(shifts):
        yield Checked(
            what=_("ways of the crosses"),
            how=_("shifts of the loops that they close, less those of the known errors, over the largest"),
            left=_largest(loop_slides(drive)[:, 2] + shifts) / _largest(shifts),
            allowed=1e-9,
        )
    if parts := [(one.shaft, part) for one in result.shafts for part in one.shares if not part.pair]:
        shaft, part = max(parts, key=lambda one: max(one[1].ways[:2]))
        exact, told = (max(one[:2]) for one in (alone(drive, part)[shaft], part.ways))
        yield Checked(
            what=_("way of shaft {number} by {name}").format(number=shaft, name=_named(part)),
            how=_("exact loops with that error alone, over what the influence gives"),
            left=abs(exact / told - 1.0),
            allowed=CURVED,
        )
    if band is None or result.worst is None or not band.output.contributions:
        return
    for most in [one for one in band.output.contributions if not one.pair][:1]:
        errors: list[Any] = [None] * len(drive.joints)
        errors[most.joint - 1] = table_of(drive.joints[most.joint - 1], "error")(**{most.key: most.tolerance})
        exact = _largest(np.asarray(transmission_error(drive, errors=errors).error))
        yield Checked(
            what=_("influence of {name}").format(name=_named(most)),
            how=_("exact loop with that error alone, over the largest error that the influence gives"),
            left=abs(exact / most.largest - 1.0),
            allowed=CURVED,
        )
    if isinstance(band.method, Linear):
        over = float(np.max(np.asarray(band.output.upper) - np.asarray(result.worst.output.upper)))
        yield Checked(
            what=_("bounds"),
            how=_("root of squares beyond the worst case, over the worst case"),
            left=max(0.0, over) / result.worst.output.largest,
            allowed=1e-12,
        )


def _facts(result: Accuracy) -> dict[str, Any]:
    known = {side.key: _course(_curve(result.known, side), side) for side in (ANGLE, SHIFT)}
    facts: dict[str, Any] = {"closes": True, "known": {key: one for key, one in known.items() if one}}
    if result.shafts:
        facts["shafts"] = [_shaft_facts(one) for one in result.shafts]
    band = result.band
    if band is None or result.worst is None:
        return facts
    drawn = band.convergence
    return facts | {
        "method": METHODS[type(band.method)],
        **{side.key: _band_facts(one, side) for side, one in sides(band)},
        "worst": {side.key: _sizes(one, side) for side, one in sides(result.worst)},
        "samples": None if drawn is None else drawn.samples[-1],
        "lost_samples": None if drawn is None else drawn.lost,
        "standard_error": None if drawn is None else drawn.standard_error,
        "seed": band.method.seed if isinstance(band.method, MonteCarlo) else None,
    }


def _shaft_facts(one: ShaftPlace) -> dict[str, Any]:
    """Return how far errors move a shaft, and its influence by one of each error in SI."""
    keys, kinds = ("at_joint", "at_far_end", "lean"), (SHIFT, SHIFT, ANGLE)

    def told(ways: Ways) -> dict[str, Any]:
        return {key: side.quantity(way) for key, side, way in zip(keys, kinds, ways, strict=True)}

    rows = [
        {
            "field": part.field,
            "tolerance": measure(part.dimension).quantity(part.tolerance),
            **told(part.ways),
            **{f"{key}_per_unit": way / part.tolerance for key, way in zip(keys, part.ways, strict=True)},
        }
        for part in one.shares
    ]
    return {"shaft": one.shaft, "known": told(one.known), "reach": told(one.reach), "worst": told(one.worst)} | {
        "contributions": rows
    }


def _course(curve: Array, side: Side) -> dict[str, Any]:
    """Return what a curve consists of; nothing where it is zero."""
    if not _largest(curve):
        return {}
    parts = course(curve)
    values = {"largest": _largest(curve), "peak_to_peak": parts.peak_to_peak, "mean": parts.mean}
    values |= {"first": parts.first, "second": parts.second}
    return {key: side.quantity(float(value)) for key, value in values.items()}


def _sizes(band: Band, side: Side) -> dict[str, Any]:
    keys = ("largest", "peak_to_peak", "mean", "first", "second")
    return {key: side.quantity(getattr(band, key)) for key in keys}


def _band_facts(band: Band, side: Side) -> dict[str, Any]:
    keys = ("largest", "mean", "first", "second")
    rows = [
        {
            "field": one.field,
            "share": one.share,
            "tolerance": measure(one.dimension).quantity(one.tolerance),
            **{key: side.quantity(getattr(one, key)) for key in keys},
        }
        for one in band.contributions
    ]
    return {**_sizes(band, side), "contributions": rows}


def _bounds(result: Accuracy) -> Table:
    """Return the bounds at every position; what known errors do where there are no tolerances."""
    known, band = result.known, result.band
    angle = known.angle if band is None else band.angle
    columns = [Column(key="angle", values=np.asarray(angle), dimension="angle")]
    curves: list[tuple[Side, str, Any]] = []
    if band is None:
        shift = np.asarray(known.shift_linear)[..., -1, :]
        curves = [(ANGLE, "exact", known.error), (ANGLE, "first_order", known.error_linear)]
        curves += [(SHIFT, "exact", known.output_shift), (SHIFT, "first_order", shift)]
    else:
        keys = ("centre", "lower", "upper", "lower_95", "upper_95", "deviation")
        curves = [(side, key, getattr(one, key)) for side, one in sides(band) for key in keys]
    for one in result.crosses:
        ways = {"known": one.known} | ({} if band is None else {"reach": one.reach})
        columns += [
            Column(key=f"joint_{one.joint}_{one.yoke}_{key}", values=values, dimension=SHIFT.dimension, unit=SHIFT.unit)
            for key, values in ways.items()
        ]
    for side, key, values in curves:
        name = f"{'shift' if side is SHIFT else 'error'}_{key}"
        columns.append(Column(key=name, values=np.asarray(values), dimension=side.dimension, unit=side.unit))
    return Table(name="bounds", columns=columns)


def answer_of_allocation(drive: Drive, found: Allocation, *, written: Path | None = None) -> Answer:
    """Return what there is to say of the cheapest tolerances. written: file they were written into."""
    side = _side(found)
    return Answer(
        name="accuracy",
        title=_("Cheapest tolerances"),
        sentence=_allotted(found, side),
        tables=(_allotments(found),),
        remarks=(*_keeping(drive, side), *_allocation_remarks(found, side, written)),
        figures=lambda: tolerance_figures(tolerance(drive, found.spread, method=found.method)),
        facts={
            "of": str(found.of),
            "method": METHODS[type(found.method)],
            "target": side.quantity(found.target),
            "largest": side.quantity(found.largest),
            "cost": found.cost,
            "equal_cost": found.equal_cost,
            "optimality": found.optimality,
            "binding": Quantity(list(found.binding), "angle"),
            "values": values_of(found),
            "written": None if written is None else str(written),
        },
    )


def _side(found: Allocation) -> Side:
    return SHIFT if found.of is Of.SHIFT else ANGLE


def _allotted(found: Allocation, side: Side) -> Say:
    texts = {
        Of.ANGLE: _("these tolerances keep the angle error of the output within ±{size} at the least cost"),
        Of.CHANGE: _("these tolerances keep the angle error over a turn within ±{size} at the least cost"),
        Of.SHIFT: _("these tolerances keep the shift of the output within ±{size} at the least cost"),
    }
    saved = 1.0 - found.cost / found.equal_cost if found.equal_cost else 0.0
    first = say(texts[found.of], size=side.quantity(found.target))
    if saved < 5e-4:
        return say("{first}.", first=first)
    more = Quantity(found.equal_cost / found.cost - 1.0, "share", 2)
    return say(_("{first}; equal shares would cost {more} more."), first=first, more=more)


def _allotments(found: Allocation) -> Table:
    rows = found.rows
    allotted = [one.tolerance if isfinite(one.tolerance) else None for one in rows]
    costs = [None if one.kept or not isfinite(one.tolerance) else one.cost / found.cost for one in rows]
    return Table(
        name="tolerances",
        records=True,
        columns=(
            Column(key="", heading=_("tolerance"), values=[tolerance_name(one.joint, one.key) for one in rows]),
            Column(key="field", values=[one.field for one in rows], depth="data"),
            *_measured(rows, [one.before or None for one in rows], "before", _("so far ±")),
            *_measured(rows, [_("any") if one is None else one for one in allotted], "", _("allotted ±")),
            *_measured(rows, allotted, "allotted", depth="data"),
            Column(key="", values=[_change(one.before, one.tolerance, kept=one.kept) for one in rows], left=True),
            Column(key="weight", heading=_("weight"), values=[one.weight for one in rows], trim=True),
            Column(key="", heading=_("of the cost"), values=costs, dimension="share", decimals=1),
            Column(key="cost", values=[one.cost for one in rows], depth="data"),
            Column(key="kept", values=[one.kept for one in rows], depth="data"),
        ),
    )


def _change(before: float, after: float, *, kept: bool) -> str:
    if kept:
        return _("kept")
    if not before:
        return _("new")
    return _("tighter") if after < before * (1.0 - NONE) else _("wider") if after > before * (1.0 + NONE) else ""


def values_of(found: Allocation) -> dict[str, float]:
    """Return key with unit -> value of the tolerances found, rounded down so that the target holds.

    >>> from .allocation import allocate
    >>> values_of(allocate(Drive.from_angles([0.5]), 1e-3))["joints[0].tolerance.phase_arcmin"]
    1.77
    """
    units = {"angle": (arcmin, "_arcmin"), "length": (mm, "_mm")}
    values = {}
    for one in found.rows:
        if one.kept or not isfinite(one.tolerance):
            continue
        size, unit = units.get(one.dimension, (1.0, ""))
        told = one.tolerance / size
        digits = DIGITS - 1 - floor(log10(told))
        values[f"{one.field}{unit}"] = round(floor(told * 10.0**digits) / 10.0**digits, max(digits, 0))
    return values


def _keeping(drive: Drive, side: Side) -> Iterator[Remark]:
    """Yield that tolerances of pairs, which only turn the output, are kept."""
    if (which := _tolerated(drive)) and side is ANGLE:
        text = plural(
            "The tolerances of pairs inside joint {which} are kept, and count.",
            "The tolerances of pairs inside joints {which} are kept, and count.",
            len(which),
        )
        yield Remark(text=say(text, which=Joined(which, last=_(" and "))))


def _allocation_remarks(found: Allocation, side: Side, written: Path | None) -> Iterator[Remark]:
    angles = [Quantity(round(degrees(angle), 9) % 360.0 * deg, "angle", decimals=0) for angle in found.binding]
    where: Any = Joined(angles)
    if len(angles) > MOST_ANGLES:
        where = _("{count} angles").format(count=len(angles))
    how = _("in the worst case") if isinstance(found.method, WorstCase) else _("by root of squares")
    text = _("The target is reached {how} at {where}; a tolerance t costs weight/t (joints.tolerance.cost).")
    yield Remark(text=say(text, how=how, where=where))
    text = _("No cheaper ones exist: the cost is proved to be the least {closely}.")
    yield Remark(text=say(text, closely=closely(found.optimality)))
    if written is not None:
        yield Remark(text=_("{path}: tolerances written, rounded down.").format(path=written), tone="good")
        yield Remark(text=_("Look at what they leave:"), command=("cardan", "accuracy", str(written)), tone="next")
        return
    command = ("cardan", "accuracy", FILE, "--allocate", goal(found.target, side), *_options(found))
    text = _("Write them into a copy of the file:")
    yield Remark(text=text, command=(*command, "-o", "better.toml"), tone="next")


def _options(found: Allocation) -> list[str]:
    """Return the options that ask the same."""
    options = ["--of", "change"] if found.of is Of.CHANGE else []
    options += ["--method", "worst"] if isinstance(found.method, WorstCase) else []
    return options + [word for one in found.rows if one.kept for word in ("--keep", one.field)]


def _column_values(drive: Drive) -> tuple[float, float, float, float]:
    found = tolerance(drive)
    way = largest_way(shaft_places(drive, found))
    return (found.output.largest, found.output.peak_to_peak, found.shift.largest, way)


COLUMNS = (
    SweepQuestion(
        name="tolerance",
        doc=mark("what the tolerances of the drive leave open at its output"),
        told=(
            OutputColumn.of("error_arcmin", mark("largest error of the output angle")),
            OutputColumn.of("error_change_arcmin", mark("change of it over a turn")),
            OutputColumn.of("shift_mm", mark("largest shift of the output along itself")),
            OutputColumn.of("shaft_off_mm", mark("largest way of a shaft across itself")),
        ),
        of_one=_column_values,
        counts=("error",),
    ),
)
"""What a sweep may ask of accuracy."""
