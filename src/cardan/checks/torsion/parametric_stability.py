"""Whether damping keeps torsional vibration from swinging itself up by parametric resonance at the speeds in use."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict, turning
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.paths import place, with_values
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsion import TorsionModes
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.steady.run_stability import Verdict as Stability
from cardan.questions.torsion.steady.torsion_response import loaded_model, parted
from cardan.texts import _, mark

from .line import lacking, modes, nearest_used, used

MANY = 4000
"""Drives that are judged one by one at most; of more all count as the first."""

NOTHING = 1e-9
"""A loss factor below this is none."""


@dataclass(frozen=True, kw_only=True)
class Damping:
    """The mode that is nearest to growing."""

    mode: int  # from 1
    there: float  # loss factor 2ζ that it has
    needed: float  # loss factor from which nothing grows at the speeds in use; 0 where that is without any
    zone: float  # [rad/s]: middle of its nearest zone
    speed: float  # [rad/s]: speed in use that is nearest to it


@lru_cache(maxsize=4096)
def damping(drive: Drive, *, exact: bool) -> Damping | None:
    """Return how much damping a drive has and needs; None where nothing can be told.

    Of every mode by its modulation, to first order; exact: where the motion grows, too, by the rate at which it does,
    2ζ + 2λ/ω being the loss factor at which it would no longer.
    """
    found = modes(drive)
    if isinstance(found, tuple) or not used(drive):
        return None
    there = 2.0 * found.damping_ratio
    needed = np.max([found.least_loss(between) for between in used(drive)], axis=0)
    zone = found.parametric_speed.copy()
    for mode, speed, loss in _grows(drive, found) if exact else ():
        if loss > needed[mode]:
            needed[mode], zone[mode] = loss, speed
    share = needed / np.maximum(there, NOTHING)
    near = [abs(np.log(nearest_used(drive, float(one)) / one)) for one in zone]
    worst = int(np.argmax(share)) if np.any(share > 0.0) else int(np.argmin(near))
    return Damping(
        mode=worst + 1,
        there=float(there[worst]),
        needed=float(needed[worst]),
        zone=float(zone[worst]),
        speed=nearest_used(drive, float(zone[worst])),
    )


def _grows(drive: Drive, found: TorsionModes) -> Iterator[tuple[int, float, float]]:
    """Yield mode, zone and loss factor needed at speeds in use at which the exact motion grows."""
    omega = found.omega
    i, j = np.triu_indices(len(omega))
    zones = np.concatenate([0.5 * (omega[i] + omega[j]), 0.25 * (omega[i] + omega[j])])
    inside = [zone for zone in zones.tolist() for low, high in used(drive) if low < zone < high]
    speeds = np.unique([*inside, *(max(one, 0.05 * between[1]) for between in used(drive) for one in between)])
    try:
        model = loaded_model(drive, drive.duty, speeds, disturbed=True)[1]
        told = floquet_map(parted(replace(model, backlash=0.0 * model.backlash))[0], speed=speeds).floquet
    except InputError:
        return
    for k in np.flatnonzero(told.verdict == Stability.UNSTABLE).tolist():
        pair = [max(int(one) - 1, 0) for one in told.zone.modes[k]]
        mean, own = float(np.mean(omega[pair])), float(np.mean(found.damping_ratio[pair]))
        yield pair[0], float(told.zone.speed[k]), 2.0 * own + 2.0 * float(told.growth_rate[k]) / mean


def _judge(design: Design) -> Iterator[Verdict]:
    missing = lacking(design)
    if missing:
        yield Verdict(missing=missing)
        return
    own = damping(design.drive, exact=True)
    if own is None:
        yield Verdict(missing=("duty.speed",))
        return
    there, needed = _of_many(design, own)
    shafts = range(design.joints + 1)
    yield Verdict(
        value=np.maximum(there, NOTHING),
        limit=needed,
        source=_("Floquet multipliers of the exact motion, and Mathieu's equation with the modulation by the joints"),
        design_variables=(
            *design.design_variables(*(f"shafts[{k}].{name}" for k in shafts for name in ("damping", "loss_factor"))),
            *design.joint_angle_design_variables,
            *design.speed_design_variables,
        ),
        note=_note(own),
    )


def _note(own: Damping) -> Text:
    """Return where the zone is, and how far the speeds in use are from it."""
    text = _("the zone of mode {mode} lies about {zone}, {away} from the speeds in use; loss factors 2ζ")
    away = abs(own.speed / own.zone - 1.0)
    if own.needed > 0.0:
        text = _("the zone of mode {mode} about {zone} lies within the speeds in use; loss factors 2ζ")
    return say(text, mode=own.mode, zone=turning(own.zone), away=Quantity(away, "share", 3))


def _of_many(design: Design, own: Damping) -> tuple[Array, Array]:
    """Return damping there and needed of every drive of a design, arrays (...); of many to first order."""
    count = int(np.prod(design.shape, dtype=int))
    there, needed = np.full(count, own.there), np.full(count, own.needed)
    flat = {path: np.broadcast_to(values, design.shape).reshape(-1) for path, values in design.varied.items()}
    moves = ("shafts[", "joints[", "stations[", "duty.speed", "duty.torque")
    keys = {path: spelled(path) for path in flat if path.startswith(moves)}
    factors = {path: place(design.drive, key).factor for path, key in keys.items()}
    for k in range(count if count <= MANY and design.varied else 0):
        values = {key: float(flat[path][k]) / factors[path] for path, key in keys.items()}
        try:
            found = damping(with_values(design.drive, values), exact=False)
        except InputError:
            found = None
        there[k], needed[k] = (found.there, found.needed) if found is not None else (np.nan, np.nan)
    return there.reshape(design.shape)[()], needed.reshape(design.shape)[()]


CHECK = Check(
    name="parametric_stability",
    doc=mark("damping of torsional vibration against what parametric resonance by the joints needs"),
    judge=_judge,
    title=mark("damping against parametric resonance"),
    sense="at_least",
)
