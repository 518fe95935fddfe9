"""Whether every shaft lasts under torque that swings and secondary couples that turn with it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.checks.case import Case
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.drive.shaft import Notch
from cardan.formulas.fatigue import shaft_fatigue
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .section import Section, sections


def _judge(design: Design) -> Iterator[Verdict]:
    for k, shaft in enumerate(design.drive.shafts):
        if shaft.layup is not None:
            continue
        found = list(sections(design, k))
        made = partial(
            Verdict,
            check="tube_fatigue",
            subject=f"shafts[{k}]",
            title=_("safety of shaft {number} against fatigue").format(number=k + 1),
            sense="at_least",
        )
        if not found:
            if 0 < k < design.joints:
                material = f"shafts[{k}].material"
                strong = design.missing(f"{material}.ultimate_strength", f"{material}.yield_strength")
                yield made(missing=(f"shafts[{k}].outer", *strong, *design.unloaded))
            continue
        strengths = [section.of_material(name) for section in found for name in ("ultimate_strength", "yield_strength")]
        lacking = (*design.missing(*strengths), *design.unloaded)
        if lacking:
            yield made(missing=lacking)
            continue
        safeties = [_safety(design, case, section, k) for case in design.loaded for section in found]
        sizes = tuple(path for section in found for path in section.levers)
        notches = design.levers(f"shafts[{k}].notch.bending", f"shafts[{k}].notch.torsion")
        yield made(
            value=np.min(np.stack(np.broadcast_arrays(*safeties)), axis=0),
            limit=design.value("limits.fatigue_safety"),
            source=_("Goodman with Marin's factors, Shigley chapter 6"),
            levers=(*sizes, strengths[0], *notches, *design.bend_levers, *design.torque_levers),
        )


def _safety(design: Design, case: Case, section: Section, k: int) -> Array:
    """Return the safety of a stretch in one way of running."""
    shaft = design.drive.shafts[k]
    least, most = (torque[..., k] for torque in case.torque_range)
    notch = shaft.notch or Notch()
    factors = [design.value(f"shafts[{k}].notch.{name}") for name in ("bending", "torsion")]
    bending, torsion = (
        getattr(notch, name) if given is None else given
        for name, given in zip(("bending", "torsion"), factors, strict=True)
    )
    ultimate = design.value(section.of_material("ultimate_strength"))
    outer = np.asarray(section.outer, dtype=float)
    return shaft_fatigue(
        mean_torque=0.5 * (most + least),
        swinging_torque=0.5 * (most - least),
        mean_bending=0.0,
        swinging_bending=case.end_bending[..., k],
        outer=outer,
        inner=section.inner,
        ultimate=ultimate,
        yield_strength=design.value(section.of_material("yield_strength")),
        finish=shaft.finish,
        bending_notch=bending,
        torsion_notch=torsion,
        reliability=design.duty.reliability,
    ).safety


CHECK = Check(
    name="tube_fatigue",
    doc=mark("safety of every shaft against fatigue by torque that swings and turning bending"),
    judge=_judge,
)
