"""What an absorber is to do and how it begins: which mode and order it is for, what is refused, the closed forms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.drive.duty import Duty
from cardan.errors import Problem
from cardan.formulas.absorber_tuning import den_hartog, h_infinity, viscous_optimum
from cardan.formulas.pendulum import tuned_length
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_modes import StraightModes
from cardan.texts import _

from .absorber_search import Setting, rounded
from .band import Lines, excited
from .hosts import Host

KINDS = ("h_infinity", "den_hartog", "viscous", "tuned", "pendulum")
"""Smallest peak, by fixed points, damper without spring, absorber without damping for one speed, pendulums."""


def problems(
    kind: str,
    inertia: float | None,
    ratio: float | None,
    radius: float | None,
    count: int,
    mode: int | None,
    order: float | None,
) -> Iterator[Problem]:
    """Yield what is wrong with what is asked for."""
    if kind not in KINDS:
        yield Problem("kind", _("{given} given; one of {known}").format(given=repr(kind), known=", ".join(KINDS)))
    if inertia is not None and ratio is not None:
        yield Problem("inertia_ratio", _("the inertia itself is given already"))
    for name, value in (("inertia", inertia), ("inertia_ratio", ratio), ("radius", radius), ("order", order)):
        if value is not None and not (np.isfinite(value) and value > 0.0):
            yield Problem(name, _("{value:.6g} given; more than 0 is needed").format(value=value))
    if kind == "pendulum" and radius is None:
        yield Problem("radius", _("missing; the distance of the pivots from the axis of the shaft"))
    if count < 1:
        yield Problem("count", _("{given} given; at least 1").format(given=count))
    if kind in KINDS and kind != "pendulum":
        for name, given in (("radius", radius is not None), ("count", count > 1)):
            if given:
                yield Problem(name, _("counts only with pendulums"))
    if mode is not None and mode < 1:
        yield Problem("mode", _("{given} given; modes count from 1").format(given=mode))


def mode_problems(modes: StraightModes, mode: int | None) -> Iterator[Problem]:
    """Yield a mode that the drive does not have."""
    if mode is not None and mode > len(modes.omega):
        text = _("{given} given; the drive has {count}")
        yield Problem("mode", text.format(given=mode, count=len(modes.omega)))


def still(host: Host, modal: Array) -> list[Problem]:
    """Return a problem where a station stands still in the mode."""
    if np.isfinite(modal[host.station]) and modal[host.station] < 1e9 * np.min(modal):
        return []
    return [Problem("station", _("{name} stands still in this mode; nothing there reaches it").format(name=host.name))]


def meeting(
    found: Lines,
    modes: StraightModes,
    mode: int | None,
    order: float | None,
    band: tuple[float, float] | None,
    near: float | None,
) -> tuple[int, float]:
    """Return mode from 0 and order of the strongest resonance in a band; the slowest, or the nearest, without one."""
    drive = found.drives[0]
    known = excited(drive, drive.duty) if order is None else (order,)
    pairs = [(m, nu) for m in range(len(modes.omega)) for nu in known if mode in (None, m + 1)]
    speed = np.asarray([modes.omega[m] / nu for m, nu in pairs])
    if band is None:
        return pairs[int(np.argmin(np.abs(speed - near)))] if near is not None else min(pairs, key=lambda one: one[0])
    inside = np.flatnonzero((speed >= band[0]) & (speed <= band[1]))
    if not inside.size:
        return pairs[int(np.argmin(np.maximum(band[0] - speed, speed - band[1])))]
    swing = found.swings(speed[inside][None]).swing
    strength = np.max(np.where(np.isfinite(swing), swing, np.inf), axis=-1)
    return pairs[int(inside[int(np.argmax(strength))])]


def served(kind: str, duty: Duty, band: tuple[float, float], single: float | None, peak: float) -> float | None:
    """Return the one speed that an absorber without damping serves; None for the others."""
    if kind != "tuned":
        return None
    own = single if single is not None else None if duty.speed is None else abs(duty.speed)
    return own if own is not None and band[0] <= own <= band[1] else peak


def closed_form(
    kind: str,
    inertia: float,
    ratio: float,
    omega: float,
    order: float,
    serves: float | None,
    radius: float | None,
    middle: float,
) -> Setting:
    """Return the setting by the formula for one mode."""
    if kind == "pendulum":
        assert radius is not None
        arm = rounded(float(tuned_length(radius, order)))
        return Setting(inertia=inertia, stiffness=inertia * middle**2 * radius / arm, damping=0.0, arm=arm)
    if serves is not None:
        return Setting(inertia=inertia, stiffness=rounded(inertia * (order * serves) ** 2), damping=0.0)
    tuning = {"h_infinity": h_infinity, "den_hartog": den_hartog, "viscous": viscous_optimum}[kind](ratio)
    _own, spring, damper = (float(one) for one in tuning.sized(inertia / ratio, omega))
    return Setting(inertia=inertia, stiffness=rounded(spring), damping=rounded(damper))
