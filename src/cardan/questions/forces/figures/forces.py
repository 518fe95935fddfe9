"""What a drive carries: torques and secondary couples of its shafts, and what its supports take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers.quantity import Quantity, Say, say
from cardan.drive.drive import Drive
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule, Series
from cardan.figures.palette import dash_of, shaft
from cardan.figures.turning import across, shaft_name, support_dashes, support_name
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost, foremost_on
from cardan.questions.forces.forces import Forces
from cardan.questions.forces.reactions import Held
from cardan.questions.forces.told import senses
from cardan.texts import _
from cardan.units import deg

from .arrows import loads_figures, worst
from .end_on import Tip, end_on

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
    """Return the torque and the secondary couple of every shaft over the input angle, and the couples seen end on.

    found: of one drive.
    """
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
    angle: Array,
    rows: Array,
    label: str,
    *,
    shafts: bool = False,
    named: bool = False,
    base: bool = False,
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
        label,
        "Nm",
        [rows],
        dimension="torque",
        include=(0.0,) if base else (),
        least=max(0.02 * size, LEAST),
        count=4,
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
    if int(np.max(np.asarray(found.status))) == int(Held.INDETERMINATE):
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
        name="reactions",
        title=_("What the supports carry"),
        sentence="",
        source=source,
        rows=(*rows, *paths),
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
