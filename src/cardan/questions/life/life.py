"""How long do the joints of a drive last, and the bearings of its supports?"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.drive.conditions import Condition, LoadCase, in_poses, load_cases, under
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.dynamics_model import train
from cardan.errors import Problem, check, refuse
from cardan.formulas.joint_rating import POWER, book_life, lasting, nominal_torque
from cardan.maths.arrays import Array
from cardan.questions.motion.standing import standing
from cardan.questions.torsion.steady.dynamic_torque import DynamicTorque, steady_torque
from cardan.texts import _

from .bearing_life import MILLION, POINT_SLOPE, RELIABILITIES, maker_life, reliability_factor
from .bearing_loads import BearingLoads, bearing_loads
from .duty_cycle import combined_life, equivalent_torque
from .joint_bearings import JointBearings, Missing, joint_bearings
from .life_cautions import cautions
from .lives import METHODS, Life
from .rainflow import Cycles, Levels, rainflow, speed_at_level, time_at_level
from .support_loads import SupportLives, SupportLoads, capacities, rated_supports, support_loads


def life(drive: Drive, duty: Duty | None = None, *, method: str | None = None) -> Life:
    """Return how long the joints of a drive last, and its supports: ISO 281 exactly, makers' and the book's beside it.

    Parameters
    ----------
    drive : Drive
        With spans and capacities of needle bearings, or what to compute these from; ratings of makers; capacities of
        the ball bearings of its supports.
    duty : Duty, optional
        Torque and speed, or blocks, or a measured torque; life demanded, factor for shocks, reliability. Those of the
        drive by default.
    method : str, optional
        One of `METHODS`, by which the joint that fails first is found; ``iso`` by default where any joint has a
        capacity, else ``maker`` or ``book``.

    Returns
    -------
    Life

    Raises
    ------
    InputError
        No speed, no torque, no joint or support whose life could be told: with the keys to add.

    See Also
    --------
    strength, select_joint

    Notes
    -----
    ISO 281: L = a_1 10^6 turns/D, D = (1/2π) ∮ \\|dδ/dφ\\| (f_d Q/C)^(10/3) dφ, with the swing δ and the load
    Q = K/d of the journals over the turn from the torque flow of the whole drive, friction and inertia counted. Makers
    and the book take the mean torque and the joint angle, at least 3°. Parts of a duty cycle add their damage, Book
    (268), and so do poses by their shares and the instants of a movement, of which the drive turns many times in each.
    Supports: D of a turn is the mean of ω (f_d P/C)^3 with the forces of `forces` and `moving_forces`, without
    torsional vibration.

    Examples
    --------
    >>> from cardan import Drive, life
    >>> from cardan.joints import Hooke
    >>> from cardan.parts import Cross, Duty, Needles
    >>> from cardan.units import deg, mm, rpm
    >>> joint = Hooke(joint_angle=12 * deg, cross=Cross(span=80 * mm), needles=Needles(capacity=20e3))
    >>> found = life(Drive(joints=(joint,)), Duty(speed=1000 * rpm, torque=800.0))
    >>> for name in ("driving", "driven", "simple", "book"):
    ...     print(f"{name} {getattr(found, name)[0, 0] / 3600:.1f} h")
    driving 1199.2 h
    driven 1229.2 h
    simple 1259.9 h
    book 1015.0 h
    """
    whole = drive if duty is None else replace(drive, duty=duty)
    used = whole.duty
    if method is not None and method not in METHODS:
        names = ", ".join(METHODS)
        raise refuse("method", _("{value} is none of {choices}").format(value=repr(method), choices=names))
    _parts, _asked, history, cycles = duty_parts(used)
    bearings, missing = joint_bearings(drive)
    which, unheld = rated_supports(drive)
    check(() if which else _nothing(bearings, (*missing, *unheld)))
    chosen = method or _first(bearings)
    factor = float(reliability_factor(used.reliability))
    acting = duty_loads(whole)
    rows = [row for one in acting for row in _rows(one, bearings, factor, which)]
    lost = dict.fromkeys(row.supports for row in rows if isinstance(row.supports, str))
    check([Problem("supports", why) for why in lost] if lost and _nothing(bearings, missing) else ())
    unheld += tuple(Missing(field="supports", message=why, key=False) for why in lost)
    unknown = any(row.share is None for row in rows)
    if unknown:
        rows = _worst(rows, chosen)
    share = np.asarray([row.share if row.share is not None else row.part.share for row in rows])
    stacked: dict[str, Any] = {name: np.stack([getattr(row, name) for row in rows]) for name in ROWS}
    found = Life(
        parts=tuple(row.part for row in rows),
        share=share / np.sum(share),
        **stacked,
        bearings=bearings,
        shock_factor=used.shock_factor,
        reliability=used.reliability,
        reliability_factor=factor,
        demanded=used.life,
        method=chosen,
        history=history,
        cycles=cycles,
        uncounted=(*missing, *unheld),
        assumed=(*bearings.assumed, *train(drive, kinds=True).assumed),
        worst_pose=(rows[0].pose or _("as drawn")) if unknown else "",
        moving=any(one.stand.moving for one in acting),
        vibration=tuple(row.vibration for row in rows),
        supports=None if lost else _supports(drive, which, rows),
    )
    if bool(np.all(np.isnan(found.joints))) and (method is not None or found.supports is None):
        raise refuse("method", _("no joint has what {method} needs").format(method=chosen))
    return replace(found, cautions=tuple(cautions(found, beyond=used.reliability > max(RELIABILITIES))))


ROWS = ("joint_angle", "torque", "journal_force", "driving", "driven", "simple", "maker", "book")
"""Fields of a `Life` with a row for each part."""


@dataclass(frozen=True, eq=False, kw_only=True)
class _Row:
    """What the joints go through in one part of the duty, in one pose: means over its movement, arrays (n,)."""

    part: LoadCase
    pose: str
    share: float | None
    joint_angle: Array
    torque: Array
    journal_force: Array
    driving: Array
    driven: Array
    simple: Array
    maker: Array
    book: Array
    vibration: float  # largest alternating torque over its mean; nan where torsional vibration is not counted
    supports: SupportLoads | str | None  # loads of the bearings of supports, or why they lack; None for none


def _bound(drive: Drive, pose: str) -> bool:
    """Tell whether a load case is bound to a pose."""
    return bool(pose) and any(case.pose == pose for case in drive.duty.cases)


@dataclass(frozen=True, eq=False, kw_only=True)
class DutyLoads:
    """What the bearings of the joints carry in some parts of the duty, in one pose and under the same movements."""

    stand: Condition
    parts: tuple[LoadCase, ...]
    loads: tuple[BearingLoads, ...]  # as drawn, or at instants of the movements
    when: Array  # (k,): shares of these instants
    swung: tuple[DynamicTorque | None, ...]  # torsional vibration in each part

    @property
    def speed(self) -> Array:
        """Speeds of the parts, array (b, 1) [rad/s]."""
        return np.asarray([abs(part.speed or 0.0) for part in self.parts])[:, None]

    @property
    def shocks(self) -> Array:
        """Factors for shocks of the parts, array (b, 1)."""
        return np.asarray([part.shock_factor for part in self.parts])[:, None]

    def share(self, part: LoadCase) -> float | None:
        """Return the share of the time of a part in this pose; None where no share of the pose is known."""
        return part.share if part.pose else None if self.stand.share is None else part.share * self.stand.share


def duty_loads(drive: Drive) -> tuple[DutyLoads, ...]:
    """Return what the bearings of the joints carry in every part of the duty, pose and movement.

    drive: with a torque and a speed, else InputError.
    """
    stands = [one for one in in_poses(drive) if one.share != 0.0 or _bound(drive, one.pose)]
    return tuple(found for one in stands for found in _loads(one))


def _loads(stand: Condition) -> Iterator[DutyLoads]:
    """Yield what the bearings carry in a pose: as drawn there, or over the movements in which each part acts."""
    drive, machine = stand.drive, train(stand.drive, kinds=True)
    every, asked, history, _cycles = duty_parts(drive.duty)
    own = [part for part in every if part.pose == stand.pose or (not part.pose and stand.share != 0.0)]
    for movement in dict.fromkeys(part.movement for part in own):
        parts = tuple(part for part in own if part.movement == movement)
        moves = tuple(one for one in drive.movements if movement in ("", one.name))
        stood, when = [machine], np.ones(1)
        if moves and any(part.joint_angle is None for part in parts):
            stood, when = standing(replace(drive, movements=moves), machine)
        swung = [None if history else steady_torque(under(drive, _acting(one, asked))) for one in parts]
        loads = [bearing_loads(drive, one, asked, parts, drawn=machine, vibrating=swung) for one in stood]
        yield DutyLoads(stand=stand, parts=parts, loads=tuple(loads), when=when, swung=tuple(swung))


def _rows(acting: DutyLoads, bearings: JointBearings, factor: float, which: Sequence[int]) -> Iterator[_Row]:
    """Yield what every part of the duty does in a pose."""
    stand, loads, when, shocks = acting.stand, acting.loads, acting.when, acting.shocks
    lives = [_lives(one, bearings, acting.speed, shocks, factor) for one in loads]
    table = {name: mean_life([one[name] for one in lives], when) for name in lives[0]}
    joint_angles, torques = (np.stack([getattr(one, name) for one in loads]) for name in ("joint_angle", "torque"))
    table["torque"] = torques[0]
    if len(loads) > 1:
        flat = np.moveaxis(torques, 0, -1), when
        table["torque"] = equivalent_torque(
            *flat, speed=acting.speed[..., None], joint_angle=np.moveaxis(joint_angles, 0, -1)
        )
    table["joint_angle"] = np.average(joint_angles, axis=0, weights=when)
    table["journal_force"] = shocks * np.max([one.couple for one in loads], axis=0) / bearings.span
    with np.errstate(divide="ignore", invalid="ignore"):
        grown = [math.nan if one is None else _growth(one) for one in acting.swung]
    duty = stand.drive.duty
    asked, ball = duty_parts(duty)[1], float(reliability_factor(duty.reliability, slope=POINT_SLOPE))
    for k, part in enumerate(acting.parts):
        path = "" if stand.pose else part.path
        named = replace(part, name=replace(stand, case=part.name).name, path=path)
        row = {name: values[k] for name, values in table.items()}
        run = under(stand.drive, _acting(part, asked))
        held = support_loads(run, which, part.shock_factor, factor=ball) if which else None
        yield _Row(part=named, pose=stand.pose, share=acting.share(part), vibration=grown[k], supports=held, **row)


def _acting(part: LoadCase, asked: Duty) -> LoadCase:
    """Return a part of the duty with the swinging parts of the torque."""
    return replace(part, harmonics=asked.harmonics, scale=asked.torque or 0.0, torque_at=asked.torque_at)


def _growth(found: DynamicTorque) -> float:
    """Return the largest alternating torque of a shaft over the size of its mean."""
    mean = 0.5 * np.abs(found.high[0] + found.low[0])
    return float(np.max(0.5 * (found.high[0] - found.low[0]) / mean))


def mean_life(lives: Sequence[Array], shares: Array) -> Array:
    """Return the life over times with these lives (b, n) and these shares: their rates of damage have a mean."""
    if len(lives) == 1:
        return lives[0]
    with np.errstate(divide="ignore"):
        return lasting(1.0, np.average([1.0 / one for one in lives], axis=0, weights=shares))


def _worst(rows: Sequence[_Row], method: str) -> list[_Row]:
    """Return the rows of the pose in which a joint fails first, where nobody says how long each pose lasts."""

    def least(pose: str) -> float:
        own = [row for row in rows if row.pose == pose]
        share = np.asarray([row.part.share for row in own])
        names = ("driving", "driven") if method == "iso" else (method,)
        each = [np.stack([getattr(row, name) for row in own]) for name in names]
        held = [row.supports.life for row in own if isinstance(row.supports, SupportLoads)]
        each += [np.stack(held)] if len(held) == len(own) else []
        return float(np.nanmin(np.concatenate([combined_life(lives.T, share) for lives in each])))

    worst = min(dict.fromkeys(row.pose for row in rows), key=least)
    return [row for row in rows if row.pose == worst]


def _supports(drive: Drive, which: Sequence[int], rows: Sequence[_Row]) -> SupportLives | None:
    """Return the bearings of the supports in all parts; None where none of them is rated."""
    loads = [row.supports for row in rows if isinstance(row.supports, SupportLoads)]
    if not loads:
        return None
    capacity, static = capacities(drive, which)
    stacked = {name: np.stack([getattr(one, name) for one in loads]) for name in SupportLoads.__dataclass_fields__}
    return SupportLives(
        number=tuple(k + 1 for k in which), capacity=capacity, static_capacity=static, loads=SupportLoads(**stacked)
    )


def duty_parts(duty: Duty) -> tuple[tuple[LoadCase, ...], Duty, Levels | None, Cycles | None]:
    """Return the parts of a duty cycle, the duty they are of, and the levels and cycles of a measured torque.

    duty: its load cases and parts count before its measured torque, and this before its steady torque; peaks do not.
    """
    every = load_cases(duty)
    if duty.blocks:
        return tuple(one for one in every if one.path != "duty"), replace(duty, torque_at="output"), None, None
    timed = tuple(one for one in every if one.share > 0.0)
    if duty.cases and duty.torque_history is None and timed:
        text = _("missing; how long a joint lasts depends on it")
        check(Problem(f"{one.path}.speed", text, "missing") for one in timed if not one.speed)
        return timed, duty, None, None
    history = duty.torque_history
    problems = []
    if not duty.speed and not (history and history.speeds):
        zero = Problem("duty.speed", _("is zero; at standstill bearings do not wear"))
        lacks = Problem("duty.speed", _("missing; how long a joint lasts depends on it"), "missing")
        problems.append(zero if duty.speed == 0.0 else lacks)
    if history is None and duty.torque is None:
        problems.append(Problem("duty.torque", _("missing; how long a joint lasts depends on it"), "missing"))
    if history is not None and len(history.times) < 2:
        problems.append(Problem("duty.torque_history", _("has no rows; it comes from a CSV file"), "empty"))
    check(problems)
    speed = duty.speed or 0.0
    if history is None:
        return (LoadCase(torque=duty.torque or 0.0, speed=speed, shock_factor=duty.shock_factor),), duty, None, None
    levels = time_at_level(history.times, history.torques)
    speeds = np.full(levels.share.shape, speed)
    if history.speeds:
        speeds = speed_at_level(history.times, history.torques, history.speeds, levels.edge)
    rows = zip(levels.value.tolist(), levels.share.tolist(), speeds.tolist(), strict=True)
    shocks = duty.shock_factor
    parts = tuple(
        LoadCase(torque=torque, speed=at, share=share, shock_factor=shocks)
        for torque, share, at in rows
        if share > 0.0 and at != 0.0
    )
    return parts, replace(duty, torque_at="output", harmonics=()), levels, rainflow(history.torques)


def _lives(loads: BearingLoads, bearings: JointBearings, speed: Array, shock: Array, factor: float) -> dict[str, Array]:
    """Return the lives of every joint in every part by every method, arrays (b, n) [s]; speeds, shocks (b, 1)."""
    whole = factor * MILLION * 2.0 * math.pi / speed
    strength = (bearings.span * bearings.capacity / shock) ** POWER
    rated = np.isfinite(strength)
    mean = (np.abs(loads.torque)) ** POWER * 2.0 * loads.joint_angle / math.pi
    maker = np.full(loads.joint_angle.shape, np.nan)
    for i, convention in enumerate(bearings.convention):
        if convention in ("Tc", "CR"):
            case = {
                "speed": speed[:, 0],
                "joint_angle": loads.joint_angle[:, i],
                "convention": convention,
                "shock": shock[:, 0],
            }
            maker[:, i] = maker_life(bearings.rating[i], loads.torque[:, i], **case)
    own = np.asarray([convention == "book" for convention in bearings.convention])
    nominal: Array = np.where(own, bearings.rating, nominal_torque(bearings.capacity, 0.5 * bearings.span))
    nominal = np.where(bearings.inner, np.nan, nominal)  # handbook and mean load are of a cross
    return {
        "driving": np.where(rated, lasting(whole * strength, loads.driving), np.nan),
        "driven": np.where(rated, lasting(whole * strength, loads.driven), np.nan),
        "simple": np.where(rated & ~bearings.inner, lasting(whole * strength, mean), np.nan),
        "maker": factor * maker,
        "book": factor * book_life(nominal, loads.torque, speed=speed, joint_angle=loads.joint_angle, shock=shock),
    }


def _first(bearings: JointBearings) -> str:
    """Return the best method that any joint has the figures for."""
    if bool(np.any(bearings.rated)):
        return "iso"
    if any(convention in ("Tc", "CR") for convention in bearings.convention):
        return "maker"
    return "book" if any(bearings.convention) else "iso"


def _nothing(bearings: JointBearings, missing: tuple[Missing, ...]) -> list[Problem]:
    """Return what misses where no joint has anything to tell its life from."""
    if bool(np.any(bearings.rated)) or any(bearings.convention):
        return []
    return [Problem(one.field, one.message, "missing") for one in missing]
