"""Whether tubes stay below the torque at which their wall buckles."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.composite_tube import composite_tube
from cardan.formulas.shaft_strength import wall_buckling_torque
from cardan.texts import _, mark

from .section import STEEL, modulus, number_of, sections


def _judge(design: Design) -> Iterator[Verdict]:
    for k, shaft in enumerate(design.drive.shafts):
        if shaft.layup is None:
            yield from _of_metal(design, k)
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


def _of_metal(design: Design, k: int) -> Iterator[Verdict]:
    """Yield the verdicts of the tubes of a shaft of one material; a solid one has no wall."""
    for section in sections(design, k):
        if not np.any(np.asarray(section.inner) > 0.0):
            continue
        part = _(", stretch {number}").format(number=number_of(section.path)) if "segments" in section.path else ""
        made = partial(
            Verdict,
            check="tube_buckling",
            subject=f"shafts[{k}]",
            title=_("torque on the wall of shaft {number}").format(number=k + 1) + part,
            dimension="torque",
            unit="Nm",
        )
        if design.unloaded:
            yield made(missing=design.unloaded)
            continue
        given = design.value(f"{section.path}.material.poisson")
        poisson = STEEL.poisson if given is None else given
        torque, note = design.most(lambda case: case.shaft_torque[..., k])
        buckles = wall_buckling_torque(section.outer, section.inner, modulus(design, section, "youngs"), poisson)
        yield made(
            value=torque * design.shock,
            limit=buckles / design.value("limits.safety"),
            source=_("buckling of the wall by Timoshenko and Gere, 11.11, over safety"),
            levers=(*section.levers, *design.torque_levers),
            note=note,
        )


CHECK = Check(name="tube_buckling", doc=mark("torque of tubes against buckling of their wall"), judge=_judge)
