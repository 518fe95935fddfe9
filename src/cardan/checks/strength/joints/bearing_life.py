"""Whether the needle bearings of every joint last as long as the duty asks."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.moving import stands
from cardan.checks.verdict import Verdict
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.formulas.joint_rating import POWER, needle_rating
from cardan.maths.arrays import Array
from cardan.questions.life.bearing_life import swing_damage
from cardan.questions.life.life import life
from cardan.questions.life.lives import Life
from cardan.texts import _, mark

SIZES = ("needles.count", "needles.diameter", "needles.length", "cross.journal")


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    given, span = f"joints[{i}].needles.capacity", f"joints[{i}].cross.span"
    sizes = tuple(f"joints[{i}].{name}" for name in SIZES)
    rated = design.value(given) is not None
    lacking = list(design.missing(span, "duty.life"))
    if not rated and design.missing(*sizes):
        lacking.insert(0, given)
    lacking += [*design.unloaded, *design.unmoved]
    if lacking:
        yield Verdict(missing=tuple(lacking))
        return
    found = lives(design.drive)
    if isinstance(found, tuple):
        yield Verdict(missing=tuple(path for path, _message in found), note="; ".join(text for _path, text in found))
        return
    value = np.asarray(found[i])
    if design.varied:
        plain = Design(drive=design.drive, duty=design.duty, known=design.known)
        value = found[i] * _relative(plain, i) / np.maximum(_relative(design, i), 1e-300)
    yield Verdict(
        value=value,
        limit=design.value("duty.life"),
        source=say(
            _("ISO 281 over the oscillation of the journals, reliability {share}"),
            share=Quantity(design.duty.reliability, "share", 6, trim=True),
        ),
        design_variables=(
            *((given,) if rated else sizes),
            span,
            *design.joint_angles_of(i),
            *design.torque_design_variables,
            *design.speed_design_variables,
            "duty.life",
        ),
    )


def lives(drive: Drive) -> Array | tuple[tuple[str, str], ...]:
    """Return the life of every joint by ISO 281, array (n,) [s]; or what is wrong, path and message."""
    found = rated(drive)
    return found if isinstance(found, tuple) else found.of("iso")


@lru_cache(maxsize=64)
def rated(drive: Drive) -> Life | tuple[tuple[str, str], ...]:
    """Return the life of a drive; or what is wrong, path and message."""
    try:
        return life(drive)
    except InputError as error:
        return tuple((problem.field, problem.message) for problem in error.problems)


def _relative(whole: Design, i: int) -> Array:
    """Return the damage of a joint over all poses apart from a constant, array (...); their sum where shares lack."""
    found: Array = sum(share * _damage(one, i) for share, one in stands(whole))
    return found


def _damage(design: Design, i: int) -> Array:
    """Return the damage of a joint in a time apart from a constant, by torque, speed, bend and sizes, array (...)."""
    capacity = design.value(f"joints[{i}].needles.capacity")
    if capacity is None:
        capacity = needle_rating(*(design.value(f"joints[{i}].{name}") for name in SIZES)).dynamic
    strength = np.asarray(capacity) * design.value(f"joints[{i}].cross.span") / design.shock
    damage = np.zeros((2, *design.shape))
    swung: dict[tuple[int, str], tuple[Array, Array]] = {}
    for case in design.running:
        turned = id(case.chain), case.torque_at
        if turned not in swung:
            swung[turned] = _swung(design, case, i)
        load = np.asarray(case.share) * case.speed * (case.severity * np.asarray(case.torque) / strength) ** POWER
        damage = damage + np.stack([np.broadcast_to(load * swing, design.shape) for swing in swung[turned]])
    found: Array = np.max(damage, axis=0)
    return found


def _swung(design: Design, case: Case, i: int) -> tuple[Array, Array]:
    """Return the damage of a turn in both yokes of a joint, the mean over the movements of the drive, arrays (...)."""
    moved = None
    if case.chain is design.chain:
        moved = design.while_moving(
            lambda chain: np.stack(swing_damage(chain.joint_angle[..., i], torque_at=case.torque_at), axis=-1),
            mean=True,
        )
    if moved is None:
        return swing_damage(case.joint_angle[..., i], torque_at=case.torque_at)
    return moved.most[..., 0], moved.most[..., 1]


CHECK = Check(
    name="bearing_life",
    doc=mark("life of the needle bearings of every joint by ISO 281 against the life asked for"),
    joint=_judge,
    title=mark("life of the bearings of joint {number}"),
    dimension="duration",
    unit="h",
    sense="at_least",
    power=POWER,
    crosses="each",
    gathers="sum",
)
