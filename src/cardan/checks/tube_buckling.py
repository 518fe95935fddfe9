"""Whether tubes of fibre composite stay below the torque at which their wall buckles."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.analysis.composite_tube import composite_tube
from cardan.texts import _

from .check import Check
from .design import Design
from .verdict import Verdict


def _judge(design: Design) -> Iterator[Verdict]:
    for k, shaft in enumerate(design.drive.shafts):
        if shaft.layup is None:
            continue
        made = partial(
            Verdict,
            check="tube_buckling",
            subject=f"shafts[{k}]",
            title=_("torque of the composite tube of shaft {number}").format(number=k + 1),
            dimension="torque",
            unit="Nm",
        )
        lacking = (*design.missing(f"shafts[{k}].outer"), *design.unloaded)
        if lacking or shaft.outer is None:
            yield made(missing=lacking)
            continue
        plies = len(shaft.layup.angles)
        base = composite_tube(shaft.layup, shaft.outer - plies * shaft.layup.ply_thickness)
        outer, ply = design.value(f"shafts[{k}].outer"), design.value(f"shafts[{k}].layup.ply_thickness")
        # With the same angles the moduli stay, and the torque goes with d^(1/2) t^(5/2).
        middle = np.asarray(outer) - plies * np.asarray(ply)
        wide = middle / (shaft.outer - plies * shaft.layup.ply_thickness)
        limit = base.buckling_torque * np.sqrt(wide) * (np.asarray(ply) / shaft.layup.ply_thickness) ** 2.5
        torque, note = design.most(lambda case, k=k: case.shaft_torque[..., k])  # type: ignore[misc]
        yield made(
            value=torque * design.shock,
            limit=limit / design.value("limits.safety"),
            source=_("buckling of the wall, 2π r² t·0.272 (E_x E_y³)^(1/4) (t/r)^(3/2), over safety"),
            levers=(f"shafts[{k}].layup.ply_thickness", f"shafts[{k}].outer", *design.torque_levers),
            note=" ".join(part for part in (note, _("the strength of the plies is not checked")) if part),
        )


CHECK = Check(name="tube_buckling", doc=_("torque of composite tubes against buckling of their wall"), judge=_judge)
