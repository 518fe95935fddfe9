"""Where a drive turns power to heat, and how well it runs at other speeds and torques."""

from __future__ import annotations

import numpy as np

from cardan.drive.drive import Drive
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row
from cardan.figures.palette import DASHES, dash_of, shaft
from cardan.figures.turning import across
from cardan.figures.wording import percent, significant
from cardan.maths.ties import foremost
from cardan.texts import _
from cardan.units import deg, rpm

from .losses import Losses, LossMap

SHOWN = 12
"""Parts with a bar of their own; the smaller ones share the last."""

LONG = 28
"""Letters of the name of a part."""

LINES = len(DASHES)
"""Speeds with a curve of their own in a map."""


def watts(power: float, digits: int) -> str:
    """Return a power with its unit.

    Examples
    --------
    >>> watts(694.96, 3), watts(302288.0, 4)
    ('695 W', '302.3 kW')
    """
    if abs(power) < 1e4:
        return f"{significant(power, digits)} W"
    return f"{significant(1e-3 * power, digits)} kW"


def losses_figures(found: Losses, drive: Drive | None = None) -> tuple[Figure, ...]:
    """Return the figures of the losses, with the names of the parts where the drive is given."""
    return (heat_figure(found, drive),)


def heat_parts(found: Losses, drive: Drive | None = None) -> list[tuple[str, float, str]]:
    """Return name, heat [W] and colour of every part that gets warm, the warmest first.

    Parameters
    ----------
    found : Losses
        Of one drive.
    drive : Drive, optional
        For the names of its parts.
    """
    known = (drive.joints, drive.supports, drive.shafts) if drive is not None else ((), (), ())
    names = [[one.name for one in parts] for parts in known]
    rows = [
        *((_("joint {number}"), 0, k, heat, shaft(k + 1)) for k, heat in enumerate(found.joints, start=1)),
        *((_("support {number}"), 1, k, heat, "muted") for k, heat in enumerate(found.supports, start=1)),
        *((_("spline of shaft {number}"), 2, k, heat, shaft(k)) for k, heat in enumerate(found.splines, start=1)),
    ]
    warm = [
        (" ".join((text.format(number=k), *names[kind][k - 1 : k])).strip(), float(heat), role)
        for text, kind, k, heat, role in rows
        if heat > 0.0
    ]
    return sorted(warm, key=lambda row: -row[1])


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"


def heat_figure(found: Losses, drive: Drive | None = None) -> Figure:
    """Return the heat of every part, the warmest first, and that of the joints over a turn.

    Parameters
    ----------
    found : Losses
        Of one drive.
    drive : Drive, optional
        For the names of its parts.
    """
    parts = heat_parts(found, drive)
    if len(parts) > SHOWN:
        rest = parts[SHOWN - 1 :]
        name = _("{count} other parts").format(count=len(rest))
        parts = [*parts[: SHOWN - 1], (name, sum(heat for _name, heat, _role in rest), "muted")]
    parts = [(_short(name), heat, role) for name, heat, role in parts]
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
                        y=axis(_("Heat of each joint over a turn"), "W", [course], include=(0.0,), count=4),
                    ),
                ),
                height=1.3,
            )
        )
    return Figure(
        name="losses",
        title=_("Where power turns to heat"),
        sentence=_sentence(found, drive),
        source=_(
            "Coulomb friction acting on itself, integrated between its turning points; instead of Book (136)–(139)"
        ),
        rows=tuple(rows),
    )


def _bars(parts: list[tuple[str, float, str]]) -> Panel:
    size = np.asarray([heat for _name, heat, _role in parts])
    at = np.arange(len(parts), 0, -1, dtype=float)
    top = float(np.max(size, initial=0.0)) or 1.0
    ticks = steps(0.0, top, 5)
    bars = Bars(
        at=at,
        size=size,
        texts=tuple(watts(float(heat), 3) for heat in size),
        roles=tuple(role for _name, _heat, role in parts) or ("muted",),
        thick=0.62,
        lying=True,
    )
    names = tuple(name for name, _heat, _role in parts)
    upright = Axis(low=0.4, high=max(len(parts), 1) + 0.6, ticks=tuple(at), texts=names, grid=False)
    along = Axis(low=0.0, high=1.16 * top, ticks=ticks, texts=written(ticks))
    return Panel(series=(bars,), x=along, y=upright, title=_("Mean heat [W]"))


def _sentence(found: Losses, drive: Drive | None) -> str:
    if found.locked:
        return _("Friction holds joint {numbers}: the drive does not turn.").format(
            numbers=", ".join(map(str, found.locked))
        )
    parts = heat_parts(found, drive)
    if not parts:
        return _("No part gets warm.")
    return _("{heat} of {power} turn to heat, most of it at {name}; efficiency {share}.").format(
        heat=watts(found.heat, 3),
        power=watts(max(abs(found.input_power), abs(found.output_power)), 4),
        name=parts[0][0],
        share=percent(found.efficiency, 4),
    )


def map_figures(found: LossMap) -> tuple[Figure, ...]:
    """Return the figures of a map of the losses."""
    return (map_figure(found),)


def map_figure(found: LossMap) -> Figure:
    """Return efficiency and heat over the torque, a curve for each of some speeds.

    Parameters
    ----------
    found : LossMap
        Over speed and torque.
    """
    speed = np.asarray(found.speed) / rpm
    torque = np.asarray(found.torque)
    share, heat = 100.0 * np.asarray(found.efficiency), np.asarray(found.heat)
    chosen = np.unique(np.linspace(0, speed.size - 1, min(speed.size, LINES)).round().astype(int))
    order = np.argsort(torque)

    def panel(rows: np.ndarray, label: str, unit: str, *, named: bool) -> Panel:
        made = axis(_("torque") if named else "", "N·m" if named else "", [torque], margin=0.04, count=8)
        return Panel(
            series=tuple(
                Curve(
                    x=torque[order],
                    y=rows[k][order],
                    role="accent",
                    dash=DASHES[n],
                    label="" if named else _("{speed} rpm").format(speed=significant(float(speed[k]), 3)),
                    marker=4.0 if torque.size == 1 else 0.0,
                )
                for n, k in enumerate(chosen)
            ),
            x=made,
            y=axis(label, unit, [rows[chosen]], count=4, least=1e-3),
        )

    best = float(np.nanmax(share)) if np.any(np.isfinite(share)) else float("nan")
    at = np.unravel_index(int(foremost(share.ravel())), share.shape) if np.isfinite(best) else (0, 0)
    return Figure(
        name="loss-map",
        title=_("Efficiency and heat at other speeds and torques"),
        sentence=_("The drive runs best at {speed} rpm and {torque} N·m: {share} of the power comes out.").format(
            speed=significant(float(speed[at[0]]), 3),
            torque=significant(float(torque[at[1]]), 3),
            share=percent(best / 100.0, 4),
        ),
        source=_("Coulomb friction acting on itself, inertia and weights counted; exact means over the turns"),
        rows=(
            Row(panels=(panel(share, _("Efficiency"), "%", named=False),), height=1.5),
            Row(panels=(panel(heat, _("Heat of all parts"), "W", named=True),), height=1.3),
        ),
    )
