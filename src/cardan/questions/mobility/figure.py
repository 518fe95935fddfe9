"""Links and joints of a mechanism as a graph, with what of them is held too often; its loops over a turn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count

import numpy as np

from cardan.answers.quantity import Say, say
from cardan.figures.axes import angle_axis, axis, steps, written
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.mechanism.mechanism import PAIRS, Mechanism
from cardan.texts import _, plural
from cardan.units import deg, mm

from .finite_mobility import FiniteMobility, MobilityTurn
from .mobility import JointHold, Mobility

HALF = 0.2
"""Half the length of the bar that stands for a link; neighbours are one apart."""

ASIDE = 0.36
"""How far a link that hangs below another stands to its right."""

BOW = 0.17
"""How far joints between the same links stand apart."""

WIDE = 6.0
"""So many links side by side fill the width; fewer are not drawn larger."""

REACH = 0.24
"""Length of an arrow."""


def mobility_figures(found: Mobility) -> tuple[Figure, ...]:
    """Return the figures of the mobility of a mechanism."""
    return (graph_figure(found),)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Places:
    """Where links and joints are drawn; the frame is a bar along the bottom."""

    links: dict[str, Array]
    joints: list[tuple[Array, Array]]
    floor: float


def graph_figure(found: Mobility) -> Figure:
    """Return links and joints as a graph, with arrows for what errors of the parts can load."""
    mechanism = found.mechanism
    places = _places(mechanism)
    series: list[Series] = [*_frame(places)]
    series += [Curve(x=np.stack(ends)[:, 0], y=np.stack(ends)[:, 1], role="muted", width=1.0) for ends in places.joints]
    series += _links(found, places)
    named: set[str] = set()
    for hold, (start, end) in zip(found.joints, places.joints, strict=True):
        series += _joint(hold, start, end, named)
    xs = [float(place[0]) for place in places.links.values()]
    low, high = min(xs) - 0.75, max(xs) + 0.75
    spare = max(0.0, 0.5 * (WIDE - (high - low)))
    low, high = low - spare, high + spare
    bottom, top = places.floor - 0.45, 0.75
    height = min(max(7.2 * (top - bottom) / (high - low), 1.6), 6.0)
    return Figure(
        name="mechanism",
        title=_("Links and joints, and their redundant constraints"),
        sentence=_sentence(found),
        source=_(
            "Left null space of the wrenches that the joints hold; Kozhevnikov and Perfil'ev (1978), p. 11-16, "
            "exact by screws"
        )
        + _codes(found),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=tuple(series),
                        x=Axis(low=low, high=high),
                        y=Axis(low=bottom, high=top),
                        title=_("links as bars, joints as dots with their kind, the frame along the bottom"),
                        equal=True,
                        bare=True,
                    ),
                ),
                height=height,
            ),
        ),
    )


def _codes(found: Mobility) -> str:
    """Return what the letters beside the joints mean."""
    used = [code for code in PAIRS if any(hold.type == code for hold in found.joints)]
    return "; " + ", ".join(f"{code}: {_(PAIRS[code].name)}" for code in used) if used else ""


def _sentence(found: Mobility) -> str:
    """Return what to see, which the answer does not say."""
    if not found.redundant:
        return ""
    return _("Part errors load the joints drawn in colour along their arrows.")


def _line(mechanism: Mechanism) -> list[str]:
    """Return the links from input to output, over as few joints as can be and not through the frame."""
    first = mechanism.input_link or mechanism.links[0]
    behind: dict[str, str] = {first: ""}
    front = [first]
    while front:
        here = front.pop(0)
        for pair in mechanism.joints:
            for near, far in (pair.links, pair.links[::-1]):
                if near == here and far != mechanism.frame and far not in behind:
                    behind[far] = here
                    front.append(far)
    last = mechanism.output_link if mechanism.output_link in behind else list(behind)[-1]
    steps = [last]
    while behind[steps[-1]]:
        steps.append(behind[steps[-1]])
    return steps[::-1]


def _places(mechanism: Mechanism) -> _Places:
    links: dict[str, Array] = {link: np.asarray([float(k), 0.0]) for k, link in enumerate(_line(mechanism))}
    wide = float(len(links))
    front = list(links)
    while front:  # what hangs on the line, one level below what it hangs on
        here = front.pop(0)
        for pair in mechanism.joints:
            for near, far in (pair.links, pair.links[::-1]):
                if near == here and far != mechanism.frame and far not in links:
                    place = links[here] + [ASIDE, -0.9]
                    while any(np.max(np.abs(place - other)) < 2 * HALF for other in links.values()):
                        place = place + np.asarray([0.5, 0.0])
                    links[far] = place
                    front.append(far)
    for link in mechanism.links:  # what only the frame joins to the rest
        if link not in links:
            links[link] = np.asarray([wide, 0.0])
            wide += 1.0
    floor = min(float(place[1]) for place in links.values()) - 1.0
    return _Places(links=links, joints=list(_edges(mechanism, links, floor)), floor=floor)


def _edges(mechanism: Mechanism, links: dict[str, Array], floor: float) -> Iterator[tuple[Array, Array]]:
    """Yield where each joint begins and ends; those between the same links side by side."""
    together: dict[frozenset[str], int] = {}
    for pair in mechanism.joints:
        together[frozenset(pair.links)] = together.get(frozenset(pair.links), 0) + 1
    passed = {key: count() for key in together}
    for pair in mechanism.joints:
        key = frozenset(pair.links)
        shift = BOW * (next(passed[key]) - 0.5 * (together[key] - 1)) * 2.0
        if mechanism.frame in key:
            (link,) = key - {mechanism.frame}
            place = links[link] + [max(min(shift, HALF), -HALF), 0.0]
            foot = np.asarray([place[0], floor])
            yield (foot, place) if pair.links[0] == mechanism.frame else (place, foot)
        else:
            start, end = (links[link] for link in pair.links)
            way = end - start
            across = np.asarray([-way[1], way[0]]) / np.hypot(*way)
            yield start + shift * across, end + shift * across


def _frame(places: _Places) -> Iterator[Series]:
    xs = [float(place[0]) for place in places.links.values()]
    low, high = min(xs) - 0.4, max(xs) + 0.4
    yield Curve(x=np.asarray([low, high]), y=np.full(2, places.floor), role="muted", width=2.0)
    for x in np.arange(low, high - 0.05, 0.2):
        yield Curve(
            x=np.asarray([x + 0.1, x]), y=np.asarray([places.floor, places.floor - 0.1]), role="muted", width=0.7
        )


def _links(found: Mobility, places: _Places) -> Iterator[Series]:
    named = False
    ends = {found.mechanism.input_link: _("input"), found.mechanism.output_link: _("output")}
    for k, (link, place) in enumerate(places.links.items()):
        loose = link in found.adrift
        yield Curve(
            x=place[0] + np.asarray([-HALF, HALF]),
            y=np.full(2, place[1]),
            role="second order" if loose else "ink",
            width=5.0,
            label=_("link that moves while the input stands still") if loose and not named else "",
            text=link,
        )
        named |= loose
        high = 13.0 if k % 2 and place[1] == 0.0 else 5.0
        text = f"{link} ({ends[link]})" if link in ends and ends[link] not in link else link
        side = "centre" if place[1] == 0.0 else "left"
        shift = (0.0, high) if place[1] == 0.0 else (17.0, 0.0)
        yield Note(
            text=text,
            x=float(place[0]),
            y=float(place[1]),
            side=side,  # type: ignore[arg-type]
            level="bottom" if place[1] == 0.0 else "middle",
            shift=shift,
            size=7.0,
            bold=link in (found.mechanism.input_link, found.mechanism.output_link),
        )


def _joint(hold: JointHold, start: Array, end: Array, named: set[str]) -> Iterator[Series]:
    """Yield a joint: a line between its links, a dot with its kind, and arrows for what it holds too often."""

    def once(label: str) -> str:
        new = label not in named
        named.add(label)
        return label if new else ""

    strained = hold.strained
    way = end - start
    size = float(np.hypot(*way))
    along = way / size if size > 0.0 else np.asarray([1.0, 0.0])
    across = np.asarray([-along[1], along[0]])
    middle = 0.5 * (start + end)
    if strained:
        forces = [word == "strained" for word in hold.sliding]
        if forces[0]:
            yield from _double(middle, along, once(_("force along the axis of a joint")), "warning", "solid")
        if any(forces[1:]):
            yield from _double(middle, across, once(_("force across its axis")), "warning", "dashed")
        if "strained" in hold.turning:
            angle = np.linspace(-0.3 * np.pi, 1.1 * np.pi, 24)
            yield Curve(
                x=middle[0] + 0.13 * np.cos(angle),
                y=middle[1] + 0.13 * np.sin(angle),
                role="ink",
                width=1.0,
                arrow=True,
                label=once(_("couple")),
            )
    text = f"{hold.id} ({hold.type})"
    yield Curve(x=middle[:1], y=middle[1:], role="warning" if strained else "ink", width=0.0, marker=6.0, text=text)
    yield Note(
        text=hold.type,
        x=float(middle[0]),
        y=float(middle[1]),
        shift=(5.0, -5.0),
        side="left",
        level="top",
        size=7.0,
        role="warning" if strained else "muted",
    )


def _double(middle: Array, way: Array, label: str, role: str, dash: str) -> Iterator[Series]:
    """Yield an arrow to both sides."""
    for sign, name in ((1.0, label), (-1.0, "")):
        tip = middle + sign * REACH * way
        yield Curve(
            x=np.asarray([middle[0], tip[0]]),
            y=np.asarray([middle[1], tip[1]]),
            role=role,
            width=1.6,
            dash=dash,
            arrow=True,
            label=name,
        )


def turn_figures(found: MobilityTurn) -> tuple[Figure, ...]:
    """Return the figure of mobility and redundant constraints over a turn."""
    size = mm if found.slides else deg
    angle = np.asarray(found.position) / size
    top = int(max(np.max(found.redundant), np.max(found.mobility), 1))
    ticks = steps(0.0, float(top), min(top, 6))
    upright = Axis(
        label=_("Mobility and redundant constraints"), low=-0.2, high=top + 0.4, ticks=ticks, texts=written(ticks)
    )
    series: list[Series] = [
        Curve(x=angle, y=found.redundant.astype(float), role="warning", marker=4.0, label=_("redundant constraints")),
        Curve(x=angle, y=found.mobility.astype(float), role="accent", marker=4.0, dash="dashed", label=_("mobility")),
    ]
    series += [
        Rule(value=float(one) / size, upright=True, text=_("special position"), role="failed") for one in found.special
    ]
    x = angle_axis(_("input angle"))
    if not found.whole:
        text, unit, dimension = (
            (_("input path"), "mm", "length") if found.slides else (_("input angle"), "deg", "angle")
        )
        x = axis(text, unit, [angle], dimension=dimension, count=8, margin=0.0)
    return (
        Figure(
            name="mobility-turn",
            title=_("Mobility over a turn of the input") if found.whole else _("Mobility over the range of the input"),
            sentence=_turn_sentence(found),
            source=_("Rank of the constraints at each position, loops closed by least squares"),
            rows=(Row(panels=(Panel(series=tuple(series), x=x, y=upright),)),),
        ),
    )


def _turn_sentence(found: MobilityTurn) -> Say | str:
    if not found.turns or found.slides:
        return ""
    text = plural(
        "{n} constraint is redundant at every angle.", "{n} constraints are redundant at every angle.", found.structural
    )
    return say(text, n=found.structural) if found.structural else ""


def closure_figures(found: FiniteMobility) -> tuple[Figure, ...]:
    """Return the figure of what keeps the loops from closing."""
    slides = found.slides
    angle = np.asarray(found.position) / (mm if slides else deg)
    gap, turn = np.asarray(found.gap) / mm, np.asarray(found.turn) / deg
    named = (_("input path"), "mm", "length") if slides else (_("input angle"), "deg", "angle")
    across = axis(*named[:2], [angle], dimension=named[2], count=8, margin=0.0)
    panels = [
        Panel(
            series=(Curve(x=angle, y=values, role=role, width=1.6),),
            x=across,
            y=axis(label, unit, [values], dimension=dimension, include=(0.0,), least=1e-6, count=4),
        )
        for values, label, dimension, unit, role in (
            (gap, _("Gap at the joints that close the loops"), "length", "mm", "warning"),
            (turn, _("Turn between their halves"), "angle", "deg", "accent"),
        )
    ]
    return (
        Figure(
            name="closure",
            title=_("What keeps the loops from closing"),
            sentence=_("The loops close at every angle to rounding.") if found.closes else "",
            source=_("Products of exponentials, loops closed by least squares over all other joints"),
            rows=tuple(Row(panels=(panel,), height=1.5) for panel in panels),
        ),
    )


FIGURES = {Mobility: mobility_figures, MobilityTurn: turn_figures, FiniteMobility: closure_figures}
"""Result -> what makes its figures."""
