"""What a drive without load carries because its parts do not fit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.answers.palette import shaft
from cardan.figures.axes import across, axis, support_dashes, support_name
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.forces.assembly import AssemblyForces
from cardan.texts import _
from cardan.units import deg

NOTHING = 1e-9
"""Share of the largest force below which a force is rounding."""

LEAST = 1e-6
"""Smallest range of an axis of forces [N]."""


def misalignment_figures(found: AssemblyForces, names: Sequence[str] = ()) -> tuple[Figure, ...]:
    """Return the figures of the forces of assembly; names of the supports for the legend, where they are given."""
    return (misalignment_figure(found, names),)


def misalignment_figure(found: AssemblyForces, names: Sequence[str] = ()) -> Figure:
    """Return how misalignment loads supports and joints over the input angle.

    found: of one drive; names: names of the supports, for the legend.
    """
    angle = np.asarray(found.angle) / deg
    radial, axial = np.asarray(found.radial), np.asarray(found.axial)
    joint = frames.norm(np.asarray(found.joint_force))
    top = max(float(np.max(one, initial=0.0)) for one in (radial, np.abs(axial), joint))
    pushed = float(np.max(np.abs(axial), initial=0.0)) > NOTHING * top
    supports = [
        (support_name(k + 1, number, names[k] if k < len(names) else ""), shaft(number), dash)
        for k, (number, dash) in enumerate(zip(found.support_shaft, support_dashes(found.support_shaft), strict=True))
    ]
    several = len(joint) > 1
    joints = [
        (_("force in joint {number}").format(number=k) if several else "", shaft(k + 1), "dotted")
        for k in range(1, len(joint) + 1)
    ]
    rows = [_row(angle, radial, supports, _("Radial force of the supports, without load"))]
    if pushed:
        label = _("Axial force of the supports on the shaft, along the power flow positive")
        holding = [k for k, row in enumerate(axial) if float(np.max(np.abs(row))) > NOTHING * top]
        nameless = [("", role, dash) for _name, role, dash in supports]
        rows.append(_row(angle, axial[holding], [nameless[k] for k in holding], label, height=1.15))
    rows.append(_row(angle, joint, joints, _("Force in the joints, without load"), named=True, height=1.15))
    return Figure(
        name="misalignment",
        title=_("How misalignment loads supports and joints"),
        sentence="",
        source=_(
            "Least complementary energy of bearings and shafts at the gaps that the errors leave, spatial frame after "
            "Kozhevnikov and Perfil'ev (1978), p. 190; crosses rigid"
        ),
        rows=tuple(rows),
    )


def _row(
    angle: Array,
    values: Array,
    names: list[tuple[str, str, str]],
    label: str,
    *,
    named: bool = False,
    height: float = 1.4,
) -> Row:
    curves: list[Series] = [
        Curve(x=angle, y=row, label=name, role=role, dash=dash, width=1.6, marker=4.0 if len(angle) == 1 else 0.0)
        for row, (name, role, dash) in zip(values, names, strict=True)
    ]
    upright: Axis = axis(label, "N", [values], dimension="force", include=(0.0,), least=LEAST, count=4)
    rule = Rule(value=0.0, dash="solid", role="faint")
    return Row(panels=(Panel(series=(rule, *curves), x=across(angle, named=named), y=upright),), height=height)
