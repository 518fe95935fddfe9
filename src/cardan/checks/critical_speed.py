"""Whether every shaft stays far enough below the speed at which it whirls."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.analysis.composite_tube import composite_tube
from cardan.maths.arrays import Array
from cardan.texts import _

from .check import Check
from .design import Design
from .section import modulus, sections
from .verdict import Verdict

ARTICLE = 1.6
"""A real critical speed should be this much above the highest speed."""

CATALOGUE = {"automotive": 0.70, "industrial": 0.65}
"""Share of the computed critical speed that makers allow."""

SPLINED = 0.9
"""Real over computed critical speed of a shaft with a spline, where the drive does not say."""


def whirl(design: Design, k: int) -> tuple[Array | None, tuple[str, ...], tuple[str, ...]]:
    """Return the critical speed of a shaft between two joints, the paths it misses, and those that move it.

    Parameters
    ----------
    design : Design
    k : int
        Shaft, counted from 0.

    Returns
    -------
    tuple
        array (...) [rad/s], or None where something is missing or the shaft is stepped.

    Notes
    -----
    Book (257): ω = (π/L)² √(E(D² + d²)/(16ρ)), hinged ends.
    """
    found = list(sections(design, k))
    length = design.length(k)
    lacking = [] if found else [f"shafts[{k}].outer"]
    lacking += [] if length is not None else [f"shafts[{k}].length"]
    if lacking or len(found) != 1 or length is None:
        return None, tuple(lacking), ()
    section, layup = found[0], design.drive.shafts[k].layup
    if layup is not None:
        tube = composite_tube(layup, 0.1)
        stiff, heavy = np.asarray(tube.along), np.asarray(layup.ply.density)
    else:
        stiff, heavy = (np.asarray(modulus(design, section, name)) for name in ("youngs", "density"))
    speed: Array = (
        0.25 * np.sqrt(stiff / heavy) * np.hypot(section.outer, section.inner) * (math.pi / np.asarray(length)) ** 2
    )
    levers = (*section.levers, *(design.levers(f"shafts[{k}].length") if design.drive.form != "points" else ()))
    return speed, (), levers


def wear(design: Design, k: int) -> Array | float:
    """Return the real over the computed critical speed of a shaft, counted from 0."""
    given = design.value(f"shafts[{k}].wear_factor")
    usual = SPLINED if design.drive.shafts[k].spline is not None else 1.0
    return usual if given is None else given


def _judge(design: Design) -> Iterator[Verdict]:
    for k in range(1, design.joints):
        speed, lacking, levers = whirl(design, k)
        made = partial(
            Verdict,
            check="critical_speed",
            subject=f"shafts[{k}]",
            title=_("critical speed of shaft {number} over the highest speed").format(number=k + 1),
        )
        if lacking or design.unmoved:
            yield made(missing=(*lacking, *design.unmoved))
            continue
        if speed is None:
            continue
        top = np.maximum(np.asarray(design.top_speed, dtype=float), 1e-9)
        own = design.value("limits.critical_speed")
        yield made(
            value=wear(design, k) * speed / top,
            limit=ARTICLE if own is None else own,
            sense="at_least",
            source=_("web articles on drive shafts: 60 % above the highest speed")
            if own is None
            else _("limits of the drive file"),
            levers=(*levers, *design.speed_levers),
            note=_("of the real shaft, {factor:g} of the computed {speed:.0f} rpm").format(
                factor=float(np.ravel(wear(design, k))[0]), speed=float(speed) * 30.0 / math.pi
            )
            if np.ndim(speed) == 0
            else "",
        )
        application = design.duty.application
        yield made(
            title=_("highest speed over the critical speed of shaft {number}").format(number=k + 1),
            value=top / speed,
            limit=CATALOGUE[application],
            dimension="share",
            unit="percent",
            source=_("IMS catalogue, automotive drives: 70 %")
            if application == "automotive"
            else _("IMS catalogue, industrial drives: 65 %"),
            levers=(*levers, *design.speed_levers),
        )


CHECK = Check(
    name="critical_speed", doc=_("critical speed of every shaft in bending against the highest speed"), judge=_judge
)
