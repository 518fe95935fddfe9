"""What there is to say of the motion of a mechanism: transfer functions of its links against the input."""

from __future__ import annotations

from collections.abc import Iterator
from math import nan
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, closely
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.errors import refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.ties import tidied
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.mobility.rounded import rounded
from cardan.texts import _, mark
from cardan.units import deg, preferred

from .motion import EVEN, WAYS, LinkMotion, MechanismMotion, PartErrors, peak
from .motion import mechanism_motion as ask
from .transfer import Input, input_of

drawn = later("cardan.questions.mechanism.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking", "sentence"]

STEP = 30.0 * deg
"""Step of the printed table."""


def lacking(mechanism: Mechanism) -> Lacking:
    """Return what the mechanism file lacks for the motion."""
    return absent(
        (bool(mechanism.input_link), "input_link"),
        (not mechanism.slides or mechanism.input_stroke is not None, "input_stroke"),
    )


def answer(mechanism: Mechanism, result: MechanismMotion, listed: MechanismMotion | None = None) -> Answer:
    """Return what there is to say of the motion of a mechanism; listed: positions that people read one by one."""
    return Answer(
        name="motion",
        title=_("Motion"),
        sentence=sentence(result),
        tone="plain",
        figures=lambda: drawn().motion_figures(result),
        tables=tuple(_tables(result, listed)),
        remarks=(*rounded(mechanism), *_remarks(result)),
        keys=tuple(_keys(result)),
        facts=_facts(result),
        full=lambda: _trace(result),
    )


def sentence(result: MechanismMotion) -> Say:
    """Return in one sentence how the output follows the input."""
    output, given, by = result.output, result.mechanism.input_link, input_of(result.mechanism)
    slides = result.mechanism.slides
    if output is None:
        text = _("{count} moving links follow {input}; name output_link, and it is told how that one moves.")
        return say(text, count=len(result.links), input=given)
    if output.way == "slides":
        text = _("{output} slides over {travel}, at most {speed} for a radian of {input}.")
        if slides:
            text = _("{output} slides over {travel}, at most at {speed} times the speed of {input}.")
        return say(
            text,
            output=output.link,
            input=given,
            travel=_length(_span(output.path)),
            speed=Quantity(peak(output.speed), by.speed),
        )
    if output.turns:
        low, high = _ends(output.ratio)
        if slides:
            text = _("{output} turns through {angle}, by {low} to {high} of {input}.")
            values = {"low": Quantity(tidied(low), by.ratio), "high": Quantity(tidied(high), by.ratio)}
            return say(text, output=output.link, input=given, angle=Quantity(_span(output.angle), "angle"), **values)
        if output.constant:
            text = _("{output} turns at a constant ratio of {ratio} to {input}.")
            return say(text, output=output.link, input=given, ratio=Quantity(tidied(0.5 * (low + high))))
        text = _("{output} turns at {low} to {high} of the speed of {input}; speed fluctuation δ = {share}.")
        if fluctuation(output, result.position) is None:
            text = _("{output} rocks through {angle}; it turns at {low} to {high} of the speed of {input}.")
        share = Quantity(fluctuation(output, result.position) or 0.0, "share")
        values = {"angle": Quantity(_span(output.angle), "angle"), "share": share}
        return say(text, output=output.link, input=given, low=Quantity(low), high=Quantity(high), **values)
    text = _("{output} shifts without turning, at most {speed} for a radian of {input}.")
    if slides:
        text = _("{output} shifts without turning, at most at {speed} times the speed of {input}.")
    return say(text, output=output.link, input=given, speed=Quantity(peak(output.speed), by.speed))


def fluctuation(link: LinkMotion, angle: Array) -> float | None:
    """Return the speed fluctuation of a link, largest less least over the mean; None where it turns back."""
    low, high = _ends(link.ratio)
    if low * high <= 0.0:
        return None
    known = np.isfinite(link.ratio)
    if np.count_nonzero(known) < 2 or link.constant:
        return 0.0
    mean = float(np.trapezoid(link.ratio[known], angle[known])) / float(np.ptp(angle[known]))
    return (high - low) / abs(mean)


def _ends(values: Array) -> tuple[float, float]:
    return float(np.nanmin(values)), float(np.nanmax(values))


def _span(values: Array) -> float:
    low, high = _ends(values)
    return high - low


def _length(value: float) -> Quantity:
    return Quantity(value, "length")


def _tables(result: MechanismMotion, listed: MechanismMotion | None) -> Iterator[Table]:
    pace, by = result.mechanism.pace, input_of(result.mechanism)
    size = result.turned.placed.size
    unit = 1.0 / size if result.mechanism.slides else 1.0  # a path of the input over the size counts as an angle does
    turning = [one for one in result.links if one.turns]
    if turning:
        rates = np.asarray([_ends(link.ratio) for link in turning])
        steep = _tidy(np.asarray([peak(one.slope) for one in turning]), unit**2)
        yield Table(
            name="turning",
            title=_("Links that turn"),
            records=True,
            columns=(
                *_heads(turning),
                Column(
                    key="travel",
                    heading=_("turned by"),
                    values=[_span(one.angle) if one.axis.any() else None for one in turning],
                    dimension="angle",
                ),
                *(
                    Column(
                        key=f"ratio_{name}",
                        heading=text,
                        values=_tidy(rates[:, k], unit),
                        dimension=by.ratio,
                        decimals=4,
                    )
                    for k, (name, text) in enumerate((("min", _("min ratio")), ("max", _("max ratio"))))
                ),
                Column(
                    key="acceleration" if pace else "acceleration_per_speed_squared",
                    heading=_("acceleration ±") if pace else _("acceleration ±ε/{sign}²").format(sign=by.sign),
                    values=steep * (pace or 1.0) ** 2,
                    dimension="angular_acceleration" if pace else by.slope,
                ),
            ),
            note=_(
                "Ratio: angular speed over that of the input, the first transfer function; of links that turn about no "
                "lasting direction its amount. Acceleration at uniform input, the second one."
            ),
        )
    moving = [one for one in result.links if one.moves]
    if moving:
        speeds = _tidy(np.asarray([_ends(one.speed) for one in moving]), size * unit)
        steep = _tidy(np.asarray([peak(one.curve) for one in moving]), size * unit**2)
        yield Table(
            name="moving",
            title=_("Points that move"),
            records=True,
            columns=(
                *_heads(moving),
                Column(
                    key="travel",
                    heading=_("travel"),
                    values=[_span(one.path) if one.way in ("slides", "screws") else None for one in moving],
                    dimension="length",
                ),
                *(
                    Column(
                        key=f"speed_{name}" if pace else f"speed_{name}_per_speed",
                        heading=text,
                        values=speeds[:, k] * (pace or 1.0),
                        dimension="speed" if pace else by.speed,
                    )
                    for k, (name, text) in enumerate(
                        (
                            ("min", _("least speed") if pace else _("least speed v/{sign}").format(sign=by.sign)),
                            ("max", _("largest")),
                        )
                    )
                ),
                Column(
                    key="acceleration" if pace else "acceleration_per_speed_squared",
                    heading=_("acceleration ±") if pace else _("acceleration ±a/{sign}²").format(sign=by.sign),
                    values=steep * (pace or 1.0) ** 2,
                    dimension="acceleration" if pace else by.curve,
                ),
            ),
            note=_("Of the centre of mass where the file has one, else of the middle of the pairs of the link."),
        )
    if result.errors is not None:
        yield _errors(result, result.errors)
    if listed is not None:
        yield _listed(listed)


def _errors(result: MechanismMotion, errors: PartErrors) -> Table:
    """Return what the tolerance of each joint does to the output."""
    joints = result.mechanism.joints
    shown = [k for k, one in enumerate(joints) if one.tolerance or one.tolerance_turn]
    worst = [int(np.nanargmax(errors.each[:, k])) for k in shown]
    return Table(
        name="tolerances",
        title=_("Output error by the tolerance of each joint"),
        records=True,
        columns=(
            Column(key="joint", heading=_("joint"), values=[joints[k].id for k in shown], left=True),
            Column(
                key="tolerance", heading=_("shift ±"), values=[joints[k].tolerance for k in shown], dimension="length"
            ),
            Column(
                key="tolerance_turn",
                heading=_("turn ±"),
                values=[joints[k].tolerance_turn for k in shown],
                dimension="angle",
            ),
            Column(
                key="output_error",
                heading=_("output ±"),
                values=[float(errors.each[at, k]) for at, k in zip(worst, shown, strict=True)],
                dimension="angle" if errors.turns else "length",
                digits=3,
            ),
            Column(
                key="output_error_at",
                heading=_("at"),
                values=[float(result.position[at]) for at in worst],
                dimension=input_of(result.mechanism).place,
                decimals=0,
            ),
        ),
        note=_("To first order, the input at rest; what is held more than once shares an error as equal springs do."),
    )


def _error_of(result: MechanismMotion, errors: PartErrors) -> Say:
    """Return how far the output may be off."""
    dimension = "angle" if errors.turns else "length"
    text = _(
        "By the tolerances of its joints {output} may be off by ±{likely} (root sum of squares), ±{worst} at worst."
    )
    likely, worst = (Quantity(float(np.nanmax(one)), dimension, 3) for one in (errors.likely, errors.worst))
    return say(text, output=result.mechanism.output_link, likely=likely, worst=worst)


def _tidy(values: Array, size: float) -> Array:
    """Return values, those that are nothing but rounding beside a size as 0."""
    return np.where(np.abs(values) < EVEN * size, 0.0, values)


def _heads(links: list[LinkMotion]) -> tuple[Column, Column]:
    """Return the columns that tell which links these are, and how each moves."""
    return (
        Column(key="link", heading=_("link"), values=[one.link for one in links], left=True),
        Column(key="way", heading=_("motion"), values=[_(WAYS[one.way]) for one in links], left=True),
    )


def _columns(link: LinkMotion, by: Input) -> Iterator[tuple[str, str, Array, str]]:
    """Yield what is told of a link over the input: name, heading, values, dimension."""
    if link.turns:
        if link.axis.any():
            yield "angle", _("angle"), link.angle, "angle"
        yield "ratio", _("ratio"), link.ratio, by.ratio
        text = _("acceleration ε/{sign}²").format(sign=by.sign)
        yield "acceleration_per_speed_squared", text, link.slope, by.slope
    if link.moves:
        if link.way in ("slides", "screws"):
            yield "path", _("path"), link.path, "length"
        yield "speed_per_speed", _("speed v/{sign}").format(sign=by.sign), link.speed, by.speed
        text = _("acceleration a/{sign}²").format(sign=by.sign)
        yield "point_acceleration_per_speed_squared", text, link.curve, by.curve


def _listed(found: MechanismMotion) -> Table:
    """Return how the output, or every link, moves at the positions that people read one by one."""
    output = found.output
    links = [output] if output is not None else list(found.links)
    by = input_of(found.mechanism)
    columns = [
        Column(
            key=f"{one.link}_{key}",
            heading=text if output else f"{one.link}: {text}",
            values=_tidy(values, found.turned.placed.size if dim == "length" else 1.0),
            dimension=dim,
        )
        for one in links
        for key, text, values, dim in _columns(one, by)
    ]
    first = Column(key=by.key, heading=by.head, values=found.position, dimension=by.place, digits=7, trim=True)
    title = _("Over the input path") if found.mechanism.slides else _("Over the input angle")
    return Table(title=title, columns=(first, *columns))


def _trace(found: MechanismMotion) -> Table:
    """Return how every link moves at every position."""
    by = input_of(found.mechanism)
    columns = [Column(key=by.key, values=found.position, dimension=by.place)]
    for one in found.links:
        name = one.link.replace(" ", "_")
        columns += [Column(key=f"{name}_{key}", values=v, dimension=dim) for key, _text, v, dim in _columns(one, by)]
        columns += [
            Column(key=f"{name}_{axis}", values=one.point[:, k], dimension="length") for k, axis in enumerate("xyz")
        ]
    return Table(name="motion", columns=columns)


def _remarks(result: MechanismMotion) -> Iterator[Remark]:
    turned, by = result.turned, input_of(result.mechanism)
    if turned.loose:
        text = _("Free to spin while the input rests, and told as at rest in that: {links}.")
        yield Remark(text=say(text, links=", ".join(turned.loose)))
    if np.any(turned.special):
        places: list[Text] = [Quantity(float(one), by.place, decimals=0) for one in result.position[turned.special][:8]]
        text = _(
            "Warning: in a change point at {angles}: it could go on in two ways, and its speeds are not told there."
        )
        yield Remark(text=say(text, angles=Joined(places)), tone="warning")
    if result.errors is not None:
        yield Remark(text=_error_of(result, result.errors))
    elif any(one.tolerance or one.tolerance_turn for one in result.mechanism.joints):
        text = _(
            "The tolerances of its joints are not told: no output_link that turns about an axis or slides along one."
        )
        yield Remark(text=text)
    told = float(np.max(turned.rates.open[~turned.special], initial=0.0))
    yield Remark(text=say(_("Loops closed at every position; rates checked in all pairs, {size}."), size=closely(told)))
    if result.mechanism.pace is None:
        text = _("--speed-rpm, or speed_rpm in the file, gives speeds and accelerations.")
        if result.mechanism.slides:
            text = _("sliding_speed_m_s in the file gives speeds and accelerations.")
        yield Remark(text=text, tone="next")
    yield Remark(text=_("Whether it is overconstrained:"), command=("cardan", "mobility", FILE), tone="next")


def _keys(result: MechanismMotion) -> Iterator[KeyFigure]:
    output = result.output
    if output is None:
        return
    if result.errors is not None:
        off = Quantity(peak(result.errors.likely), "angle" if result.errors.turns else "length")
        yield KeyFigure(name="output_error", title=_("output error by the tolerances"), value=off)
    if output.turns:
        share = None if result.mechanism.slides else fluctuation(output, result.position)
        if share is not None:
            title = _("speed fluctuation δ of the output")
            yield KeyFigure(name="speed_fluctuation", title=title, value=Quantity(share, "share"))
        for name, title, value in zip(
            ("ratio_min", "ratio_max"),
            (_("least speed ratio of the output"), _("largest speed ratio of the output")),
            _ends(output.ratio),
            strict=True,
        ):
            ratio = Quantity(tidied(value), input_of(result.mechanism).ratio, decimals=4)
            yield KeyFigure(name=name, title=title, value=ratio, better="")
    if output.way in ("slides", "screws"):
        yield KeyFigure(name="travel", title=_("travel of the output"), value=_length(_span(output.path)), better="")


def _facts(result: MechanismMotion) -> dict[str, Any]:
    mechanism, by = result.mechanism, input_of(result.mechanism)
    return {
        "name": mechanism.name,
        "input_link": mechanism.input_link,
        "output_link": mechanism.output_link,
        "speed": Quantity(mechanism.pace, by.pace),
        "input_range": Quantity([float(result.position[0]), float(result.position[-1])], by.place),
        "ways": {one.link: one.way for one in result.links},
    }


def _told(mechanism: Mechanism) -> tuple[OutputColumn, ...]:
    """Return what a sweep may ask of the output."""
    by = input_of(mechanism)
    unit = preferred(by.ratio) if by.ratio else ""
    end = f"_{unit}" if unit else ""
    return (
        OutputColumn(name=f"ratio_min{end}", dimension=by.ratio, unit=unit, text=mark("least ratio of the output")),
        OutputColumn(name=f"ratio_max{end}", dimension=by.ratio, unit=unit, text=mark("largest ratio of the output")),
        OutputColumn.of("speed_fluctuation_percent", mark("speed fluctuation of the output")),
        OutputColumn.of("turn_deg", mark("angle through which the output turns")),
        OutputColumn.of("travel_mm", mark("way by which the output slides")),
    )


def _numbers(found: MechanismMotion) -> tuple[float, ...]:
    """Return the same in SI, nan of what its output does not do."""
    output = found.output
    if output is None:
        raise refuse("output_link", _("missing: a sweep tells how the output moves"), "missing")
    low, high = map(tidied, _ends(output.ratio)) if output.turns else (nan, nan)
    share = None if found.mechanism.slides or not output.turns else fluctuation(output, found.position)
    turn = _span(output.angle) if output.turns and output.axis.any() else nan
    way = _span(output.path) if output.way in ("slides", "screws") else nan
    return low, high, nan if share is None else share * (share > EVEN), turn, way


COLUMNS = (
    SweepQuestion(
        name="motion",
        doc=mark("how the output of the mechanism moves: ratio, speed fluctuation, angle or way"),
        told=_told,
        of_result=_numbers,
    ),
)
"""What a sweep may ask of the motion of a mechanism."""
