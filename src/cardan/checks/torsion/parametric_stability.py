"""Whether damping keeps torsional vibration from swinging itself up by parametric resonance at the speeds in use."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
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
from cardan.questions.torsion.model.answer import nonsynchronous
from cardan.questions.torsion.model.torsion import TorsionModes
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.stability.proved_speeds import ProvedSpeeds
from cardan.questions.torsion.stability.torsion_stability import judged, no_smooth_motion, proved_in_use
from cardan.questions.torsion.steady.torsion_response import loaded_model, parted
from cardan.texts import _, mark

from .line import as_drawn, lacking, modes, nearest_used, rubbing, used

MANY = 4000
"""Drives that are judged one by one at most; of more all count as the first."""

NOTHING = 1e-9
"""A loss factor below this is none."""

LEAST = 1e-6
"""Share of its damping that a mode lacks at least where it grows."""


@dataclass(frozen=True, kw_only=True)
class Damping:
    """The mode that is nearest to growing."""

    mode: int  # from 1
    there: float  # loss factor 2ζ that it has
    needed: float  # loss factor from which nothing grows at the speeds in use; 0 where that is without any
    zone: float  # [rad/s]: middle of its nearest zone
    speed: float  # [rad/s]: speed in use that is nearest to it
    proof: ProvedSpeeds | None  # of the speeds in use and a tenth beyond; None where nothing was proved


@lru_cache(maxsize=4096)
def damping(drive: Drive, *, exact: bool) -> Damping | None:
    """Return how much damping a drive has and needs; None where nothing can be told.

    Of every mode by its modulation, to first order; exact: by what is proved at the speeds in use, too. Where the
    motion grows there, 2ζ + 2λ/ω is the loss factor at which it would no longer; where it is proved to die out, what
    the mode has is enough.
    """
    found = modes(drive)
    if isinstance(found, tuple) or not used(drive):
        return None
    there = 2.0 * found.damping_ratio
    needed = np.max([found.least_loss(between) for between in used(drive)], axis=0)
    zone = found.parametric_speed.copy()
    proof = _proof(drive) if exact else None
    if proof is not None:
        growing = list(_growing(drive, found, proof))
        if not growing and not any(_unproved(proof, between) for between in used(drive)):
            needed = np.minimum(needed, there)
        for mode, speed, loss in growing:
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
        proof=proof,
    )


def _proof(drive: Drive) -> ProvedSpeeds | None:
    try:
        proof = proved_in_use(drive)
    except InputError:
        return None
    return proof if proof is not None and proof.looked_at else None


def _unproved(proof: ProvedSpeeds, between: tuple[float, float]) -> bool:
    """Tell whether at some of the speeds in use nothing was shown."""
    return bool(np.any((proof.unproved[:, 0] < between[1]) & (between[0] < proof.unproved[:, 1])))


def _growing(drive: Drive, found: TorsionModes, proof: ProvedSpeeds) -> Iterator[tuple[int, float, float]]:
    """Yield mode, zone and loss factor needed of unstable ranges at speeds in use."""
    pairs = [(k, between) for between in used(drive) for k in proof.overlapping(*between).tolist()]
    if not pairs:
        return
    sense = -1.0 if (drive.duty.speed or 1.0) < 0.0 else 1.0
    speeds = [min(max(proof.worst[k], low), high) for k, (low, high) in pairs]
    alone = (proof.lowest == proof.highest) | proof.zone.by_torques  # judged by themselves
    for (k, _between), speed in zip(pairs, speeds, strict=True):
        rate = float(proof.growth_rate[k])
        if not alone[k]:
            where = np.asarray([sense * speed])
            told = judged(parted(loaded_model(drive, drive.duty, where)[1])[0], where)
            rate = float(told.growth_rate[0])
        rate = max(rate, 0.0)
        pair = [max(int(one) - 1, 0) for one in proof.zone.modes[k]]
        mean, own = float(np.mean(found.omega[pair])), float(np.mean(found.damping_ratio[pair]))
        yield pair[0], float(proof.zone.speed[k]), 2.0 * own + max(2.0 * rate / mean, LEAST * own)


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
        note=as_drawn(design, _counted(design.drive, _note(own, design.drive))),
    )


def _note(own: Damping, drive: Drive) -> Text:
    """Return where the motion grows or where its zone is, and how far the speeds in use are from it."""
    zone = {"mode": own.mode, "zone": turning(own.zone)}
    if own.proof is not None:
        return _proved(own.proof, drive, zone)
    if rubbing(drive):
        return say(_without_friction(), **zone)
    text = _("the zone of mode {mode} lies about {zone}, {away} from the speeds in use; loss factors 2ζ")
    away = abs(own.speed / own.zone - 1.0)
    if own.needed > 0.0:
        text = _("the zone of mode {mode} about {zone} lies within the speeds in use; loss factors 2ζ")
    return say(text, away=Quantity(away, "share", 3), **zone)


def _counted(drive: Drive, note: Text) -> Text:
    """Return a note with what it leaves out."""
    orders = nonsynchronous(drive)
    if orders is None:
        return note
    text = _("{note}; orders that do not repeat within two turns ({orders}) count at single speeds, not between them")
    return say(text, note=note, orders=orders)


def _without_friction() -> str:
    return _(
        "not proved, as dry friction sticks and slips: judged without it, by the zones of single modes; that of mode "
        "{mode} lies about {zone}"
    )


def _proved(proof: ProvedSpeeds, drive: Drive, zone: Mapping[str, object]) -> Text:
    """Return what is proved of the speeds in use and a tenth beyond."""
    between = used(drive)
    inside = [k for one in between for k in proof.overlapping(*one).tolist()]
    near = sorted(proof.overlapping(*proof.looked).tolist(), key=lambda k: _away(proof, k, between))
    shown = not any(_unproved(proof, one) for one in between)
    for k in (*inside, *near)[:1]:
        text = _("not proved throughout; unstable from {low:bare} to {high} ({zone}), {away} off; loss factors 2ζ")
        if inside:
            text = _("unstable from {low:bare} to {high} within the speeds in use ({zone}); loss factors 2ζ")
        elif shown:
            text = _("proved stable; unstable from {low:bare} to {high} ({zone}), {away} off; loss factors 2ζ")
        low, high = (Quantity(float(one), "angular_speed", 5) for one in (proof.lowest[k], proof.highest[k]))
        away = Quantity(_away(proof, k, between), "share", 3)
        return say(text, low=low, high=high, zone=proof.zone.name((k,)), away=away)
    if rubbing(drive) and not shown:
        return say(_without_friction(), **zone)
    if shown or not len(proof.unsettled):
        if shown:
            return say(_("proved stable; the zone of mode {mode} lies about {zone}; loss factors 2ζ"), **zone)
        text = _("not proved throughout: {why}; the zone of mode {mode} lies about {zone}")
        return say(text, why=no_smooth_motion(torsional_train(drive, loaded=False)), **zone)
    low, high = (Quantity(float(one), "angular_speed", 5) for one in (proof.unsettled[0, 0], proof.unsettled[-1, 1]))
    text = _("not settled from {low:bare} to {high}: it takes too long; the zone of mode {mode} lies about {zone}")
    return say(text, low=low, high=high, **zone)


def _away(proof: ProvedSpeeds, k: int, between: Sequence[tuple[float, float]]) -> float:
    """Return how far the speeds in use are from an unstable range, as a share of its nearer end."""
    low, high = float(proof.lowest[k]), float(proof.highest[k])
    return min(max(0.0, low - one[1], one[0] - high) / (low if one[1] < low else high) for one in between)


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
