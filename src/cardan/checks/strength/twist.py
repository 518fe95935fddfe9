"""Whether the shafts twist no more than they may."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.verdict import Verdict
from cardan.formulas.shaft_strength import RATED_TWIST
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .section import modulus, sections


def compliance(design: Design, k: int) -> tuple[Array | float | None, tuple[str, ...]]:
    """Return the twist of a shaft, counted from 0, under 1 N·m [rad], and the paths that move it; None if not known."""
    given, found = design.value(f"shafts[{k}].stiffness"), list(sections(design, k))
    if given is not None:
        return 1.0 / np.asarray(given), (f"shafts[{k}].stiffness",)
    if not found or any(one.length is None for one in found):
        return None, ()
    soft = sum(one.length / (modulus(design, one, "shear_modulus") * one.torsion) for one in found)
    return soft, tuple(path for one in found for path in one.design_variables)


def _judge(design: Design) -> Iterator[Verdict]:
    soft: dict[int, Array | float] = {}
    design_variables: list[str] = []
    lacking = list(design.unloaded)
    for k in range(design.joints + 1):
        twisted, moving = compliance(design, k)
        if twisted is not None:
            soft[k] = twisted
            design_variables += moving
        elif 0 < k < design.joints:
            found = list(sections(design, k))
            lacking += [] if found else [f"shafts[{k}].outer"]
            lacking += [f"shafts[{k}].length"] if design.length(k) is None or found else []
    if lacking or not soft:
        if lacking:
            yield Verdict(missing=tuple(lacking))
        return

    def turned(case: Case) -> Array:
        found: Array = sum(case.shaft_torque[..., k] * one for k, one in soft.items())
        return found

    value, note = design.most(turned, shocks=False)
    own = design.value("limits.twist")
    yield Verdict(
        value=value,
        limit=RATED_TWIST if own is None else own,
        source=_("Kozhevnikov & Perfil'ev (1978), eq. 262: 9°") if own is None else _("limits of the drive file"),
        design_variables=(*design_variables, *design.torque_design_variables),
        note=note,
    )


CHECK = Check(
    name="twist",
    doc=mark("twist of all shafts under their largest torque against 9° or the limit"),
    judge=_judge,
    title=mark("twist of the shafts under torque"),
    dimension="angle",
    unit="deg",
    power=1.0,
)
