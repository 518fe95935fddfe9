"""What a drive carries: torques and secondary couples of its shafts, and what its supports take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, Say, numbered, say
from cardan.catalogue.completion import sized
from cardan.drive.bodies.solids import solids
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.figures.axes import across, axis, clear_way, shaft_name, steps, support_dashes, support_name
from cardan.figures.drive import MARGIN, WIDE, space_figure, views_figure
from cardan.figures.figure import Axis, Curve, Figure, Mesh, Note, Panel, Row, Rule, Series
from cardan.figures.page import onto
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost, foremost_on
from cardan.questions.forces.force_tables import senses
from cardan.questions.forces.forces import Forces
from cardan.questions.forces.reactions import Determinacy
from cardan.texts import _
from cardan.units import deg, mm

NOTHING = 1e-9
"""Share of the largest value below which a couple or a force is rounding."""

LEAST = 1e-9
"""Smallest range of an axis of forces or torques."""


def forces_figures(found: Forces, drive: Drive | None = None) -> tuple[Figure, ...]:
    """Return the figures of the forces of one drive, with drawings where the drive is given.

    found: of one drive.
    drive: the drive, to draw the forces on; standing still.
    """
    if found.reaction is None:
        return (torques_figure(found),)
    drawn = loads_figures(found, drive) if drive is not None else ()
    names = [one.name for one in drive.supports] if drive is not None else []
    return (torques_figure(found), *drawn, reactions_figure(found, names))


def torques_figure(found: Forces) -> Figure:
    """Return the torque and the secondary couple of every shaft over the input angle, and the couples seen end on."""
    angle = np.asarray(found.angle) / deg
    torque, couple = np.asarray(found.shaft_torque), np.asarray(found.bending_couple)
    return Figure(
        name="torques",
        title=_("Torque and secondary couple of every shaft"),
        sentence=_most_bent(found),
        source=_(
            "Couples along the normals of the crosses balance the torques, K = T n; the rest bends the shafts, "
            "Kozhevnikov and Perfil'ev (1978), p. 129 ff., exact; paths: tip of the couple seen along the power "
            "flow, dot at the start"
        ),
        rows=(
            _over_angle(angle, torque, _("Torque that enters each shaft"), shafts=True),
            _over_angle(angle, couple, _("Secondary couple, size"), named=True, base=True),
            *_couples(found),
        ),
    )


def _most_bent(found: Forces) -> Say | str:
    """Return which shaft has the largest secondary couple, and where."""
    couple = np.asarray(found.bending_couple)
    high = np.max(couple, axis=-1)
    k = int(foremost(high))
    if high[k] <= NOTHING * float(np.max(np.abs(np.asarray(found.shaft_torque)), initial=0.0)):
        return _("The joints are straight: there is no secondary couple.")
    return say(
        _("The secondary couple is largest on shaft {number}, {most} at {angle}."),
        number=k + 1,
        most=Quantity(float(high[k]), "torque"),
        angle=Quantity(float(np.asarray(found.angle)[int(foremost_on(couple[k]))]), "angle", decimals=1, trim=True),
    )


def _over_angle(
    angle: Array, rows: Array, label: str, *, shafts: bool = False, named: bool = False, base: bool = False
) -> Row:
    curves = [
        Curve(
            x=angle,
            y=row,
            label=shaft_name(k, len(rows)) if shafts else "",
            role=shaft(k),
            dash=dash_of(k),
            width=2.0 if k == len(rows) else 1.3,
            marker=4.0 if len(angle) == 1 else 0.0,
        )
        for k, row in enumerate(rows, start=1)
    ]
    size = float(np.max(np.abs(rows), initial=0.0))
    upright = axis(
        label, "Nm", [rows], dimension="torque", include=(0.0,) if base else (), least=max(0.02 * size, LEAST), count=4
    )
    return Row(panels=(Panel(series=tuple(curves), x=across(angle, named=named), y=upright),), height=1.35)


def _couples(found: Forces) -> Iterator[Row]:
    """Yield the paths of the couple vectors, each seen along its shaft, all to one scale."""
    vector, axes = np.asarray(found.secondary_couple), np.asarray(found.axis)
    most = float(np.max(np.asarray(found.bending_couple)))
    if most <= NOTHING * float(np.max(np.abs(np.asarray(found.shaft_torque)), initial=0.0)) or len(found.angle) < 3:
        return
    yield from end_on(
        [
            Tip(
                title=_("shaft {number}").format(number=k),
                dimension="torque",
                axis=axes[k - 1],
                paths=(vector[k - 1],),
                role=shaft(k),
                dash=dash_of(k),
            )
            for k in range(1, len(vector) + 1)
        ],
        most,
    )


def reactions_figure(found: Forces, names: Sequence[str] = ()) -> Figure:
    """Return what every support takes over the input angle, and the radial forces seen along the shafts.

    found: of one drive with supports; names: names of the supports, for the legend.
    """
    angle = np.asarray(found.angle) / deg
    most = worst(found)
    pushed = bool(np.any(np.abs(np.asarray(found.axial)) > NOTHING * max(most.size, LEAST)))
    source = _("Balance of forces and moments of every shaft in one linear system; rigid shafts and crosses")
    if int(np.max(np.asarray(found.status))) == int(Determinacy.INDETERMINATE):
        source = _("Balance of every shaft, shared by least energy among bearings and shafts that give way")
    paths = tuple(_radial_paths(found, most.size))
    if paths:
        source += _("; paths: tip of the radial force seen along the power flow, z up, dot at the start")
    rows = [
        Row(
            panels=(
                Panel(
                    series=tuple(_curves(found, angle, "radial", names, labelled=True)),
                    x=across(angle, named=not pushed),
                    y=_force_axis(_("Radial force"), [np.asarray(one.radial) for one in senses(found)]),
                ),
            ),
            height=1.5,
        )
    ]
    if pushed:
        rows.append(
            Row(
                panels=(
                    Panel(
                        series=(
                            Rule(value=0.0, dash="solid", role="faint"),
                            *_curves(found, angle, "axial", names, labelled=False),
                        ),
                        x=across(angle, named=True),
                        y=_force_axis(
                            _("Axial force on the shaft, along the power flow positive"),
                            [np.asarray(one.axial) for one in senses(found)],
                        ),
                    ),
                ),
                height=1.3,
            )
        )
    return Figure(
        name="reactions", title=_("What the supports carry"), sentence="", source=source, rows=(*rows, *paths)
    )


def _radial_paths(found: Forces, top: float) -> Iterator[Row]:
    """Yield the paths of the radial forces of all supports that carry any."""
    if len(found.angle) < 3:
        return
    axes = np.asarray(found.support_axis)
    radial = [np.asarray(one.reaction) - np.asarray(one.axial)[..., None] * axes for one in senses(found)]
    most = max(float(np.max(frames.norm(one))) for one in radial)
    if not most > NOTHING * max(top, LEAST):
        return
    tips = []
    for k, (number, dash) in enumerate(zip(found.support_shaft, support_dashes(found.support_shaft), strict=True)):
        paths = [one[k] for one in radial]
        if len(paths) > 1 and float(np.max(frames.norm(paths[1] - paths[0]))) <= NOTHING * max(top, LEAST):
            paths = paths[:1]
        title = _("support {number}").format(number=k + 1)
        tips.append(Tip(title=title, dimension="force", axis=axes[k], paths=paths, role=shaft(number), dash=dash))
    yield from end_on(tips, most)


def _force_axis(label: str, rows: list[Array]) -> Axis:
    return axis(label, "N", rows, dimension="force", include=(0.0,), least=LEAST, count=4)


def _curves(found: Forces, angle: Array, part: str, names: Sequence[str], *, labelled: bool) -> Iterator[Series]:
    """Yield the forces of every support; thin beside it those while the splines slide back."""
    top = float(np.max(frames.norm(np.asarray(found.reaction))))
    for back, one in enumerate(senses(found)):
        for k, (number, dash) in enumerate(zip(found.support_shaft, support_dashes(found.support_shaft), strict=True)):
            row = np.asarray(getattr(one, part))[k]
            known = np.asarray(getattr(found, part))[k]
            nothing = part == "axial" and float(np.max(np.abs(row))) <= NOTHING * max(top, LEAST)
            same = back and float(np.max(np.abs(row - known))) <= NOTHING * max(top, LEAST)
            if nothing or same:
                continue
            called = names[k] if k < len(names) else ""
            name = support_name(k + 1, number, called)
            yield Curve(
                x=angle,
                y=row,
                label=_("thin: splines sliding back") if back else name if labelled else "",
                text=name,
                role=shaft(number),
                dash=dash,
                width=0.7 if back else 1.6,
                marker=4.0 if len(angle) == 1 else 0.0,
            )


# Paths of vectors seen along their shaft: the tip of a couple or of a force over a turn, all to one scale.

DOWN = 0.99
"""A shaft whose axis has this vertical part is upright: then x runs up on paper instead of z."""


WIDEST = 5
"""Panels side by side at most; more stand in rows of four."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tip:
    """A vector over a turn."""

    title: str  # what stands above it
    dimension: str  # what it is, as of `cardan.answers.quantity.Quantity`; in SI
    axis: Array  # (p, 3): direction of its shaft
    paths: Sequence[Array]  # sequence of array (p, 3): the vector; behind the first, thin ones beside it
    role: str  # role, dash: how it is drawn
    dash: str = "solid"


def end_on(tips: Sequence[Tip], reach: float) -> Iterator[Row]:
    """Yield rows of panels, each a vector seen along the power flow, a dot where it starts.

    reach: the largest of the vectors, for the scale of all.
    """
    wide = len(tips) if 3 <= len(tips) <= WIDEST else 3 if len(tips) < 3 else 4
    panels = [_panel(tip, reach) for tip in tips]
    for first in range(0, len(panels), wide):
        some = panels[first : first + wide]
        some += [Panel(series=(), bare=True)] * (wide - len(some))
        yield Row(panels=tuple(some), height={3: 1.9, 4: 1.6}.get(wide, 1.35))


def _panel(tip: Tip, reach: float) -> Panel:
    along = np.asarray(tip.axis)
    up = np.asarray([1.0, 0.0, 0.0]) if abs(float(along[0, 2])) > DOWN else np.asarray([0.0, 0.0, 1.0])
    up = frames.unit(up - frames.dot(up, along)[:, None] * along)
    right = frames.cross(along, up)
    turn = np.linspace(0.0, 2.0 * np.pi, 91)
    series: list[Series] = []
    rings = steps(0.0, reach, 3)[1:]
    series += [Curve(x=ring * np.sin(turn), y=ring * np.cos(turn), role="faint", width=0.8) for ring in rings]
    seen = [(frames.dot(path, right), frames.dot(path, up)) for path in tip.paths]
    for ring in rings[-1:]:
        name = Quantity(ring, tip.dimension, trim=True)
        way = clear_way(np.concatenate([x + 1j * y for x, y in seen]), [ring], 0.5**0.5 * (1.0 - 1.0j))
        series.append(Note(text=name, x=ring * way.real, y=ring * way.imag, role="muted", size=6.6))
    series.append(Curve(x=np.asarray([0.0]), y=np.asarray([0.0]), role="muted", width=0.0, marker=2.5))
    for k, (x, y) in reversed(list(enumerate(seen))):
        series.append(Curve(x=x, y=y, role=tip.role, dash=tip.dash, width=0.7 if k else 1.8))
        if not k:
            series.append(Curve(x=x[:1], y=y[:1], role=tip.role, width=0.0, marker=5.5))
    span = Axis(low=-1.15 * reach, high=1.15 * reach)
    return Panel(series=tuple(series), x=span, y=span, title=tip.title, equal=True, bare=True)


# The forces of the supports as arrows on the drawings of the drive, where the largest of them is.

__all__ = ["Worst", "loads_figures", "senses", "worst"]

LONGEST = 0.6
"""Length of the largest force on the drawing of a drive [inch]."""

PALE = 0.55
"""Share of white in the bodies under the arrows."""

GLASS = 0.45
"""How much the bodies hide of the arrows that start inside them."""


@dataclass(frozen=True, kw_only=True)
class Worst:
    """The largest force on any support."""

    forces: Forces  # those of the way of sliding it belongs to
    support: int  # support, when: support and position, counted from 0
    when: int
    size: float  # [N]: how large it is


def worst(found: Forces) -> Worst:
    """Return the largest force on any support, of both ways of sliding; the first of those alike but for rounding."""
    size = np.stack([frames.norm(np.asarray(one.reaction)) for one in senses(found)])
    peaks = np.max(size, axis=-1)
    sense, support = (int(part) for part in np.unravel_index(int(foremost(np.ravel(peaks))), peaks.shape))
    when = int(foremost_on(size[sense, support]))
    return Worst(forces=senses(found)[sense], support=support, when=when, size=float(np.max(size)))


def loads_figures(found: Forces, drive: Drive) -> tuple[Figure, ...]:
    """Return the drawings of a drive with the forces of its supports; none where they carry nothing.

    found: of one drive with supports; drive: the drive, standing still.
    """
    most = worst(found)
    if not most.size > 0.0:
        return ()
    loads = _Loads(most, drive)
    return loads.flat(), loads.space()


class _Loads:
    """A drive with the feet and tips of its arrows [mm, N]."""

    def __init__(self, most: Worst, drive: Drive) -> None:
        place = geometry(drive)
        points, axis = np.asarray(place.points), np.asarray(place.axis)
        rows = [points[max(one.shaft - 1, 1)] + one.position * axis[one.shaft - 1] for one in drive.supports]
        self.drive = drive
        self.seen = solids(sized(drive))
        self.feet = np.stack(rows) / mm
        self.force = np.asarray(most.forces.reaction)[:, most.when]
        self.most = most

    def flat(self) -> Figure:
        """Return side and plan view."""
        base = views_figure(self.drive, self.seen)
        return replace(
            base,
            name="loads",
            title=_("Forces of the supports on the shafts, side and plan view"),
            aside=True,
            sentence=self._sentence(),
            source=self._source(),
            rows=self._rows([row.panels[0] for row in base.rows]),
        )

    def space(self) -> Figure:
        """Return the view in space."""
        base = space_figure(self.drive, self.seen)
        return replace(
            base,
            name="loads-space",
            title=_("Forces of the supports in space"),
            sentence="",
            source=self._source(),
            rows=self._rows([base.rows[0].panels[0]]),
            aside=True,
        )

    def _sentence(self) -> Say:
        angle = float(np.asarray(self.most.forces.angle)[self.most.when])
        return say(
            _("All forces on the shafts at {angle}, where support {name} carries most."),
            angle=Quantity(angle, "angle", decimals=1, trim=True),
            name=numbered(self.most.support + 1, self.drive.supports[self.most.support].name),
        )

    def _source(self) -> str:
        return _("Arrows to one scale, as long as the force; a dot is a support, the number tells which")

    def _rows(self, panels: list[Panel]) -> tuple[Row, ...]:
        """Return the panels widened to hold the arrows, all to one scale."""
        inch = (panels[0].x.high - panels[0].x.low) / WIDE
        tips = self.feet + LONGEST * inch / self.most.size * self.force
        seen = [np.concatenate((onto(one.view, tips), onto(one.view, self.feet))) for one in panels if one.view]
        room = 0.5 * MARGIN * inch
        left = min(panels[0].x.low, *(float(np.min(one[:, 0])) - room for one in seen))
        right = max(panels[0].x.high, *(float(np.max(one[:, 0])) + room for one in seen))
        scaled = (right - left) / WIDE
        made = []
        for panel, one in zip(panels, seen, strict=True):
            low = min(panel.y.low, float(np.min(one[:, 1])) - room)
            high = max(panel.y.high, float(np.max(one[:, 1])) + room)
            new = replace(
                panel,
                series=(*self._bodies(panel), *self._arrows(panel, tips)),
                x=replace(panel.x, low=left, high=right),
                y=replace(panel.y, low=low, high=high),
            )
            made.append(Row(panels=(new,), height=(high - low) / scaled))
        return tuple(made)

    def _bodies(self, panel: Panel) -> Iterator[Series]:
        """Yield what stands in a panel, the bodies paler, the words left out."""
        for item in panel.series:
            if isinstance(item, Mesh):
                yield replace(item, shade=item.shade + (1.0 - item.shade) * PALE, opacity=GLASS)
            elif not isinstance(item, Note) or item.z is None:
                yield item

    def _arrows(self, panel: Panel, tips: Array) -> Iterator[Series]:
        assert panel.view is not None
        longest = float(np.max(frames.norm(tips - self.feet)))
        for k, (foot, tip) in enumerate(zip(self.feet, tips, strict=True), start=1):
            name = self.drive.supports[k - 1].name
            text = say(
                _("support {name}: {force}"),
                name=numbered(k, name),
                force=Quantity(float(np.linalg.norm(self.force[k - 1])), "force"),
            )
            way = onto(panel.view, tip - foot)[:2]
            long = float(np.hypot(*way))
            x, y, z = np.stack((foot, tip), axis=-1)
            if long > 0.0 and not panel.view.turnable:
                yield Curve(x=x, y=y, z=z, role="paper", width=3.2)
            if float(np.linalg.norm(tip - foot)) > 0.0:
                yield Curve(x=x, y=y, z=z, role="ink", width=1.4, arrow=True, text=text)
            yield Curve(x=x[:1], y=y[:1], z=z[:1], role="ink", width=0.0, marker=4.0, text=text)
            yield _number(k, foot, tip, way, short=long <= 0.3 * longest)


def _number(k: int, foot: Array, tip: Array, way: Array, *, short: bool) -> Note:
    """Return the number of a support at the tip of its arrow; behind the foot of a short one, not over it."""
    long = float(np.hypot(*way))
    right, up = (-1.4 if short else 1.0) * way / long if long > 0.0 else (0.0, -1.4)
    at = foot if short else tip
    return Note(
        text=str(k),
        x=float(at[0]),
        y=float(at[1]),
        z=float(at[2]),
        shift=(6.0 * float(right), 6.0 * float(up)),
        bold=True,
        size=7.6,
    )
