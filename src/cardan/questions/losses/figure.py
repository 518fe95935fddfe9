"""Where a drive loses power, and how well it runs at other speeds and torques."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.palette import DASHES, dash_of, shaft
from cardan.answers.quantity import Quantity, Say, numbered, say
from cardan.drive.drive import Drive
from cardan.figures.axes import across, axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row
from cardan.maths.ties import foremost
from cardan.texts import _
from cardan.units import deg

from .losses import Losses, LossMap

SHOWN = 12
"""Parts with a bar of their own; the smaller ones share the last."""

LONG = 28
"""Letters of the name of a part."""

LINES = len(DASHES)
"""Speeds with a curve of their own in a map."""

ALIKE = 1e-5
"""Efficiencies that differ by less are told alike, with four digits."""

LARGE = 1e4
"""Power [W] from which it is told in kilowatts."""


def power(value: float, digits: int = 4) -> Quantity:
    """Return a power, large ones in kilowatts."""
    return Quantity(value, "power", digits, unit="kW" if abs(value) >= LARGE else "")


MAYBE = {"seals": "seal_diameter", "shafts": "spline"}
"""Kind of part that not every support or shaft has -> the field that says that it is there."""


@dataclass(frozen=True, kw_only=True)
class LossyPart:
    """A part that loses power."""

    named: str  # what it is called: ``joint 2 (centre)``
    loss: float  # [W]: its mean over the turns
    role: str  # its colour, see `palette`
    counted: bool  # whether the drive file says enough to count it


def losses_figures(found: Losses, drive: Drive | None = None) -> tuple[Figure, ...]:
    """Return the figures of the losses, with the names of the parts where the drive is given."""
    return (loss_figure(found, drive),)


def loss_parts(found: Losses, drive: Drive | None = None) -> list[LossyPart]:
    """Return every part that may lose power: joints, supports, seals, splines.

    found: of one drive.
    drive: for the names of its parts, for its seals and splines; those that lose something when it is not given.
    """
    return list(_parts(found, drive))


def _parts(found: Losses, drive: Drive | None) -> Iterator[LossyPart]:
    left_out = {(one.part, one.number) for one in found.uncounted}
    texts = {
        "joints": _("joint {number}"),
        "supports": _("support {number}"),
        "seals": _("seals of support {number}"),
        "shafts": _("spline of shaft {number}"),
    }
    rows = (
        *(("joints", k, loss, shaft(k + 1)) for k, loss in enumerate(found.joints, 1)),
        *(("supports", k, loss, "muted") for k, loss in enumerate(found.supports, 1)),
        *(("seals", k, loss, "muted") for k, loss in enumerate(found.seals, 1)),
        *(("shafts", k, loss, shaft(k)) for k, loss in enumerate(found.splines, 1)),
    )
    for kind, k, loss, role in rows:
        own = None if drive is None else getattr(drive, "supports" if kind == "seals" else kind)[k - 1]
        if kind in MAYBE and (not loss if own is None else getattr(own, MAYBE[kind]) is None):
            continue
        name = "" if own is None else own.name
        yield LossyPart(
            named=texts[kind].format(number=numbered(k, name)),
            loss=float(loss),
            role=role,
            counted=not {(kind, k), (kind, None)} & left_out,
        )


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"


def loss_figure(found: Losses, drive: Drive | None = None) -> Figure:
    """Return the power loss of every part, the largest first, and that of the joints over a turn.

    found: of one drive; drive: for the names of its parts.
    """
    losing = sorted((one for one in loss_parts(found, drive) if one.loss > 0.0), key=lambda one: -one.loss)
    parts = [(_short(one.named), one.loss, one.role) for one in losing]
    if len(parts) > SHOWN:
        rest = parts[SHOWN - 1 :]
        name = _("{count} other parts").format(count=len(rest))
        parts = [*parts[: SHOWN - 1], (name, sum(loss for _name, loss, _role in rest), "muted")]
    rows = [Row(panels=(_bars(parts),), height=0.25 * max(len(parts), 1) + 0.2)]
    course = np.asarray(found.joint_power)
    if np.all(np.isfinite(course)) and float(np.max(course, initial=0.0)) > 0.0:
        angle = np.asarray(found.angle) / deg
        rows.append(
            Row(
                panels=(
                    Panel(
                        series=tuple(
                            Curve(
                                x=angle,
                                y=row,
                                role=shaft(k + 1),
                                dash=dash_of(k + 1),
                                label=_("joint {number}").format(number=k),
                            )
                            for k, row in enumerate(course, start=1)
                        ),
                        x=across(angle, named=True),
                        y=axis(
                            _("Power loss of each joint over a turn"),
                            "W",
                            [course],
                            dimension="power",
                            include=(0.0,),
                            count=4,
                        ),
                    ),
                ),
                height=1.3,
            )
        )
    text = _("Means are of all conditions, the course over a turn of the first: {condition}.")
    gathered = bool(found.each) and not found.worst
    return Figure(
        name="losses",
        title=_("Where power is lost"),
        sentence=say(text, condition=found.each[0].name or _("as drawn")) if gathered and len(rows) > 1 else "",
        source=_(
            "Coulomb friction acting on itself, integrated between its turning points; instead of Kozhevnikov and "
            "Perfil'ev (1978), eq. 136–139"
        ),
        rows=tuple(rows),
        aside=True,  # the table tells the same
    )


def _bars(parts: list[tuple[str, float, str]]) -> Panel:
    size = np.asarray([loss for _name, loss, _role in parts])
    at = np.arange(len(parts), 0, -1, dtype=float)
    top = float(np.max(size, initial=0.0)) or 1.0
    ticks = steps(0.0, top, 5)
    bars = Bars(
        at=at,
        size=size,
        texts=tuple(power(float(loss), 3) for loss in size),
        roles=tuple(role for _name, _loss, role in parts) or ("muted",),
        thick=0.62,
        lying=True,
    )
    names = tuple(name for name, _loss, _role in parts)
    upright = Axis(low=0.4, high=max(len(parts), 1) + 0.6, ticks=tuple(at), texts=names, grid=False)
    along = Axis(low=0.0, high=1.16 * top, ticks=ticks, texts=written(ticks))
    return Panel(series=(bars,), x=along, y=upright, title=_("Mean power loss"), dimension="power", unit="W")


def map_figures(found: LossMap) -> tuple[Figure, ...]:
    """Return the figures of a map of the losses."""
    return (map_figure(found),)


def map_figure(found: LossMap) -> Figure:
    """Return efficiency and power loss over the torque, a curve for each of some speeds."""
    torque = np.asarray(found.torque)
    share, loss = 100.0 * np.asarray(found.efficiency), np.asarray(found.heat)
    chosen = np.unique(np.linspace(0, found.speed.size - 1, min(found.speed.size, LINES)).round().astype(int))
    order = np.argsort(torque)

    def panel(rows: np.ndarray, label: str, dimension: str, unit: str, *, named: bool) -> Panel:
        made = axis("", "", [torque], margin=0.04, count=8)
        return Panel(
            series=tuple(
                Curve(
                    x=torque[order],
                    y=rows[k][order],
                    role="accent",
                    dash=DASHES[n],
                    label="" if named else Quantity(float(found.speed[k]), "angular_speed", 3),
                    marker=4.0 if torque.size == 1 else 0.0,
                )
                for n, k in enumerate(chosen)
            ),
            x=replace(made, label=_("torque"), unit="Nm", dimension="torque") if named else made,
            y=axis(label, unit, [rows[chosen]], dimension=dimension, count=4, least=1e-3),
        )

    return Figure(
        name="loss-map",
        title=_("Efficiency and power loss at other speeds and torques"),
        sentence=_best(found),
        source=_("Coulomb friction acting on itself, inertia and weights counted; exact means over the turns"),
        rows=(
            Row(panels=(panel(share, _("Efficiency"), "share", "percent", named=False),), height=1.5),
            Row(panels=(panel(loss, _("Power loss of all parts"), "power", "W", named=True),), height=1.3),
        ),
    )


def _best(found: LossMap) -> Say | str:
    """Return where the efficiency is highest; nothing where it is the same everywhere."""
    share = np.asarray(found.efficiency)
    known = share[np.isfinite(share)]
    if not known.size or float(np.ptp(known)) <= ALIKE:
        return ""
    s, t = np.unravel_index(int(foremost(np.ravel(share))), share.shape)
    text = _("Of the points asked the efficiency is highest at {speed} and {torque}: {share}.")
    if found.torque[t] in (np.min(found.torque), np.max(found.torque)):
        text = _("The efficiency is highest at {speed} and {torque}, at the end of what is shown: {share}.")
    return say(
        text,
        speed=Quantity(float(found.speed[s]), "angular_speed", 3),
        torque=Quantity(float(found.torque[t]), "torque", 3),
        share=Quantity(float(share[s, t]), "share"),
    )


FIGURES = {Losses: losses_figures, LossMap: map_figures}
"""Result -> what makes its figures."""
