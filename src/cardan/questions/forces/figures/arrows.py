"""The forces of the supports as arrows on the drawings of the drive, where the largest of them is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.quantity import Quantity, Say, numbered, say
from cardan.drive.bodies.solids import solids
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.figures.drive import MARGIN, WIDE, space_figure, views_figure
from cardan.figures.figure import Curve, Figure, Mesh, Note, Panel, Row, Series
from cardan.figures.projection import onto
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost, foremost_on
from cardan.questions.forces.forces import Forces
from cardan.questions.forces.told import senses
from cardan.texts import _
from cardan.units import mm

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
    """Return the largest force on any support, of both ways of sliding; the first of those alike but for rounding.

    found: of one drive with supports.
    """
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
        self.seen = solids(drive)
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
