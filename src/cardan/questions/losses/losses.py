"""How much of the power does a drive turn to heat, and where?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.drive.conditions import conditions, gathered
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.machine_held import machine_held
from cardan.drive.movement import Movement
from cardan.errors import Problem, check
from cardan.formulas.friction import Turning, joint_friction
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import foremost
from cardan.questions.motion.motion import TURN
from cardan.questions.motion.standing import FEWEST, standing
from cardan.texts import _

from .loss_model import Model, Powers, mean_powers, powers
from .loss_parts import Parts, Uncounted, counted, model_of

FEW = 48
"""Instants over which means are taken where supports rub: each of them takes rounds of forces."""


@dataclass(frozen=True, kw_only=True)
class LossesAt:
    """What a drive turns to heat in one condition."""

    name: str  # what to call it; empty as drawn at the only torque
    share: float | None  # share of the time
    speed: float  # [rad/s]
    torque: float  # [N·m]
    efficiency: float
    heat: float  # [W]


@dataclass(frozen=True, eq=False, kw_only=True)
class Losses:
    """Mean powers of a drive over its turns, what each part turns to heat, and what was left out.

    Attributes
    ----------
    speed : float [rad/s]
        ω_1.
    torque : float [N·m]
        Mean torque of the duty.
    torque_at : str
        Where it is, ``output`` or ``input``.
    input_power, output_power : float [W]
        What enters the input shaft and leaves the output shaft; negative where it goes the other way, as in coasting.
    driving_pins, driven_pins : arrays (n,) [W]
        Heat of each joint, in the journals of the driving and of the driven yoke.
    supports : array (k,) [W]
        Heat of the bearing of each support; zero where it could not be counted.
    seals : array (k,) [W]
        Heat under the lip seals of each support.
    splines : array (n+1,) [W]
        Heat of the spline of each shaft while the drive moves; what moves the drive pays for it.
    resisting, storing : arrays (n+1,) [W]
        What resisting torques of the shafts take, and what speeding them up stores.
    efficiency : float
        Useful power over all that is put in; zero where both ends feed the friction, nan where the drive locks.
    first_order : float
        Product of the joints' own efficiencies, Book (136), (139): friction not acting on itself, journals alone.
    small_angle : float
        The same by Book (137), for small joint angles.
    angle : array (p,) [rad]
        Input angles of the curves: one turn.
    joint_power : array (n, p) [W]
        Heat of each joint over the turn.
    input_torque, output_torque : arrays (p,) [N·m]
        Torques at the two ends over the turn.
    residual : float
        What the power balance misses, over the larger end.
    locked : tuple of int
        Numbers of the joints that friction holds.
    uncounted : tuple of Uncounted
        Losses left out, each with the key to add.
    each : tuple of LossesAt
        In every condition that has a share of the time, where there are several: all else are means by these shares,
        but for the curves, which are of the first.
    worst : str
        Where no share of the poses is known: the condition with most heat, in which alone this is.
    drawn : LossesAt, optional
        Of a moving drive if it stood as drawn; all else are means over its movements, but for the curves.
    assumed : tuple of str
        Paths of what the drive does not say and the answer assumes.
    """

    speed: float
    torque: float
    torque_at: str
    input_power: float
    output_power: float
    driving_pins: Array
    driven_pins: Array
    supports: Array
    seals: Array
    splines: Array
    resisting: Array
    storing: Array
    efficiency: float
    first_order: float
    small_angle: float
    angle: Array
    joint_power: Array
    input_torque: Array
    output_torque: Array
    residual: float
    locked: tuple[int, ...]
    uncounted: tuple[Uncounted, ...]
    each: tuple[LossesAt, ...] = ()
    worst: str = ""
    drawn: LossesAt | None = None
    assumed: tuple[str, ...] = ()

    @property
    def joints(self) -> Array:
        """Heat of each joint, array (n,) [W]."""
        return self.driving_pins + self.driven_pins

    @property
    def heat(self) -> float:
        """Heat of all parts [W]."""
        return float(sum(map(np.sum, (self.joints, self.supports, self.seals, self.splines))))

    def at(self, name: str, share: float | None) -> LossesAt:
        """Return what of it is told beside other conditions, under a name and with a share of the time."""
        powers = {"efficiency": self.efficiency, "heat": self.heat}
        return LossesAt(name=name, share=share, speed=self.speed, torque=self.torque, **powers)

    @property
    def status(self) -> Turning:
        """Whether friction lets the drive turn."""
        return Turning.LOCKED if self.locked else Turning.FREE


@dataclass(frozen=True, eq=False, kw_only=True)
class LossMap:
    """Efficiency and heat over speed and torque.

    Attributes
    ----------
    speed : array (s,) [rad/s]
        Input speeds.
    torque : array (t,) [N·m]
        Mean torques of the duty.
    efficiency : array (s, t)
        As in `Losses`.
    heat : array (s, t) [W]
        Of all parts.
    joints : array (s, t, n) [W]
        Of each joint.
    supports : array (s, t, k) [W]
        Of the bearing of each support.
    seals : array (s, t, k) [W]
        Of the lip seals of each support.
    input_power, output_power : arrays (s, t) [W]
        At both ends.
    uncounted : tuple of Uncounted
        Losses left out, each with the key to add.
    """

    speed: Array
    torque: Array
    efficiency: Array
    heat: Array
    joints: Array
    supports: Array
    seals: Array
    input_power: Array
    output_power: Array
    uncounted: tuple[Uncounted, ...]


def losses(drive: Drive, duty: Duty | None = None, *, movement: Movement | Sequence[Movement] | None = None) -> Losses:
    """Return what a drive turns to heat at steady running, part by part, exactly.

    Parameters
    ----------
    drive : Drive
        With friction of joints, spans and journals of their crosses; better with friction, bore and seals of its
        supports.
    duty : Duty, optional
        Speed and torque, or load cases; those of the drive by default.
    movement : Movement or sequence of Movement, optional
        What moves; all movements of the drive by default.

    Returns
    -------
    Losses

    Raises
    ------
    InputError
        No speed, no torque, or no friction at all: with the keys to add.

    See Also
    --------
    loss_map, forces

    Notes
    -----
    Coulomb friction acting on itself: the cross of joint i carries T_i n and rubs with κ\\|T_i\\| in both yokes
    (κ = μ d_c/d), every support with μ_b d_b/2 times the force on it, its seals with a torque of their own
    (`seal_friction`), a spline with 2 μ\\|M\\|/D against sliding. Inertia and resisting torques of the shafts count;
    crosses are taken without mass. Powers are integrated between the angles at which friction turns about. Over
    movements, poses and load cases they are means by the time.

    Examples
    --------
    >>> from cardan import Drive, losses
    >>> from cardan.joints import Hooke
    >>> from cardan.parts import Cross, Duty
    >>> from cardan.units import deg, mm, rpm
    >>> joint = Hooke(joint_angle=20 * deg, friction=0.05, cross=Cross(span=80 * mm, journal=20 * mm))
    >>> found = losses(Drive(joints=(joint,)), Duty(speed=3000 * rpm, torque=100.0))
    >>> print(f"{found.efficiency:.6f}, {found.joints[0]:.1f} W of {found.input_power / 1000:.2f} kW")
    0.994284, 180.6 W of 31.60 kW
    """
    whole = replace(drive, duty=drive.duty if duty is None else duty)
    if movement is not None:
        whole = replace(whole, movements=_several(movement))
    every = conditions(whole)
    timed = [one for one in every if one.share is None or one.share > 0.0] or every[:1]
    found = [_steady(one.drive) for one in timed]
    each = tuple(its.at(one.name, one.share) for one, its in zip(timed, found, strict=True))
    if len(timed) == 1:
        return found[0]
    if any(one.share is None for one in timed):
        k = int(foremost([one.heat for one in each]))
        return replace(found[k], each=each, worst=each[k].name or _("as drawn"))
    return _together(found, each)


def _several(movement: Movement | Sequence[Movement]) -> tuple[Movement, ...]:
    return (movement,) if isinstance(movement, Movement) else tuple(movement)


def _steady(drive: Drive) -> Losses:
    """Return what a drive turns to heat in one condition: as it stands, or the mean over its movements."""
    own, drive = len(drive.supports), machine_held(drive)
    parts, uncounted = counted(drive, drive.duty)
    model = model_of(drive, drive.duty, parts)
    stood = _losses(drive, own, parts, model, uncounted, [model])
    if not drive.movements:
        return stood
    stands, shares = standing(drive, parts.train, fewest=FEW if model.holding is not None else FEWEST)
    models = [model_of(drive, drive.duty, replace(parts, train=one)) for one in stands]
    return replace(_losses(drive, own, parts, model, uncounted, models, shares), drawn=stood.at("", None))


def _losses(
    drive: Drive,
    own: int,
    parts: Parts,
    model: Model,
    uncounted: tuple[Uncounted, ...],
    models: Sequence[Model],
    shares: Array | None = None,
) -> Losses:
    """Return the means over models of a drive at instants, by their shares, with the curves of it as drawn.

    own: how many of its supports, the first, are its own; machines that hold its ends are counted to have no friction.
    """
    held = [model.drag * np.tan(one.chain.joint_angle) >= 1.0 for one in models]
    locked = tuple(int(i) + 1 for i in np.flatnonzero(np.any(held, axis=0)))
    if locked:
        model = replace(model, drag=np.full_like(model.drag, np.nan), holding=None)
        models, shares = [model], None
    means = [mean_powers(one) for one in models]
    weight = np.ones(1) if shares is None else shares
    mean = _mean(means, weight)
    angle = np.linspace(0.0, 2.0 * np.pi, TURN)
    course = powers(model, angle)
    rules = [joint_friction(one.chain.joint_angle, one.drag) for one in models]
    return Losses(
        speed=float(model.speed),
        torque=float(model.torque),
        torque_at=drive.duty.torque_at,
        input_power=float(mean.input),
        output_power=float(mean.output),
        driving_pins=mean.driving,
        driven_pins=mean.driven,
        supports=mean.supports[:own],
        seals=mean.seals[:own],
        splines=mean.splines,
        resisting=mean.resisting,
        storing=mean.storing,
        efficiency=float(_efficiency(mean)),
        first_order=float(weight @ [np.prod(rule.first_order) for rule in rules]),
        small_angle=float(weight @ [np.prod(rule.small_angle) for rule in rules]),
        angle=angle,
        joint_power=course.driving + course.driven,
        input_torque=course.input_torque,
        output_torque=course.output_torque,
        residual=float(_residual(mean)),
        locked=locked,
        uncounted=uncounted,
        assumed=parts.train.assumed,
    )


def _mean(parts: Sequence[Powers], share: Array) -> Powers:
    """Return the mean of powers by shares that add up to 1."""
    if len(parts) == 1:
        return parts[0]
    names = Powers.__dataclass_fields__
    return Powers(**{name: np.tensordot(share, [getattr(one, name) for one in parts], axes=1) for name in names})


MEANS = (
    "input_power",
    "output_power",
    "driving_pins",
    "driven_pins",
    "supports",
    "seals",
    "splines",
    "resisting",
    "storing",
    "first_order",
    "small_angle",
    "torque",
    "speed",
)
"""Fields of `Losses` that have a mean over conditions."""


def _together(found: Sequence[Losses], each: tuple[LossesAt, ...]) -> Losses:
    """Return the means of losses over conditions by their shares; useful power over power put in of the whole."""
    shares = [one.share for one in each]
    means = {name: gathered("mean", [getattr(one, name) for one in found], shares) for name in MEANS}
    flat: dict[str, Any] = {name: value if value.ndim else float(value) for name, value in means.items()}
    ends = [_useful(one) for one in found]
    useful, put_in = gathered("mean", ends, shares)
    locked = tuple(sorted({joint for one in found for joint in one.locked}))
    efficiency = float(useful / put_in) if put_in > 0.0 else float("nan")
    residual = max(one.residual for one in found)
    return replace(found[0], **flat, efficiency=efficiency, residual=residual, locked=locked, each=each)


def _useful(found: Losses) -> tuple[float, float]:
    """Return useful power and power put in [W]."""
    larger = max(abs(found.input_power), abs(found.output_power), found.heat)
    if not found.efficiency > 0.0:
        return 0.0, larger
    useful = abs(found.output_power if found.output_power >= 0.0 else found.input_power)
    return useful, useful / found.efficiency


def loss_map(
    drive: Drive,
    speed: ArrayLike | None = None,
    torque: ArrayLike | None = None,
    *,
    movement: Movement | Sequence[Movement] | None = None,
) -> LossMap:
    """Return efficiency and heat of a drive over speed and torque, all cases at once.

    Parameters
    ----------
    drive : Drive
        As for `losses`.
    speed : array (s,) [rad/s], optional
        Input speeds, none of them zero; a tenth to one and a half of that of the duty by default.
    torque : array (t,) [N·m], optional
        Mean torques; swinging parts grow with them. A tenth to one and a half of that of the duty by default.
    movement : Movement or sequence of Movement, optional
        What moves, so that splines slide; all movements of the drive by default.

    Returns
    -------
    LossMap

    Raises
    ------
    InputError
        A speed of zero, or what `losses` misses; a joint that locks.

    See Also
    --------
    losses

    Notes
    -----
    Friction of journals alone gives the same efficiency everywhere: the map bends where seals rub and weights load
    supports at small torques, inertia loads the joints at high speeds, and splines slide however slowly it turns.

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.joints import Hooke
    >>> from cardan.parts import Cross, Duty
    >>> from cardan.sweeps import loss_map
    >>> from cardan.units import deg, mm
    >>> joint = Hooke(joint_angle=20 * deg, friction=0.05, cross=Cross(span=80 * mm, journal=20 * mm))
    >>> found = loss_map(Drive(joints=(joint,)), [100.0, 200.0], [50.0, -50.0])
    >>> print(found.efficiency.round(6).tolist(), found.heat.round(1).tolist())
    [[0.994284, 0.994284], [0.994284, 0.994284]] [[28.7, 28.6], [57.5, 57.2]]
    """
    speeds, torques = _axes(drive, speed, torque)
    duty = replace(drive.duty, speed=float(speeds[0]), torque=drive.duty.torque or float(torques[0]))
    own, drive = len(drive.supports), machine_held(drive)
    moving = drive if movement is None else replace(drive, movements=_several(movement))
    parts, uncounted = counted(moving, duty)
    model = replace(model_of(drive, duty, parts), speed=speeds[:, None], torque=torques[None, :])
    check(
        Problem(
            f"joints[{i}].friction",
            _("joint {number} locks: friction over the journals reaches 1").format(number=i + 1),
        )
        for i in np.flatnonzero(model.drag * np.tan(model.chain.joint_angle) >= 1.0)
    )
    mean = mean_powers(model)
    joints = mean.driving + mean.driven
    heat = sum(np.sum(one, axis=-1) for one in (joints, mean.supports, mean.seals, mean.splines))
    return LossMap(
        speed=speeds,
        torque=torques,
        efficiency=_efficiency(mean),
        heat=heat,
        joints=joints,
        supports=mean.supports[..., :own],
        seals=mean.seals[..., :own],
        input_power=mean.input,
        output_power=mean.output,
        uncounted=uncounted,
    )


def _axes(drive: Drive, speed: ArrayLike | None, torque: ArrayLike | None) -> tuple[Array, Array]:
    """Return the speeds (s,) and torques (t,) of a map, and refuse what makes none."""
    problems, found = [], []
    for name, given, usual in (("speed", speed, drive.duty.speed), ("torque", torque, drive.duty.torque)):
        if given is None and not usual:
            problems.append(Problem(f"duty.{name}", _("missing; or give the values of the map")))
        values = np.atleast_1d(
            np.asarray(np.linspace(0.1, 1.5, 15) * (usual or 1.0) if given is None else given, dtype=float)
        )
        if values.ndim != 1 or not values.size or not np.all(np.isfinite(values)):
            problems.append(Problem(name, _("a list of finite numbers is needed")))
        elif name == "speed" and np.any(values == 0.0):
            problems.append(
                Problem(name, _("at standstill the sense of friction is open; give speeds other than zero"))
            )
        found.append(values)
    check(problems)
    return found[0], found[1]


def _efficiency(mean: Powers) -> Array:
    """Return useful power over power put in, whichever way it flows."""
    moving = np.sum(mean.splines, axis=-1)
    forwards = np.maximum(mean.output, 0.0), np.maximum(mean.input, 0.0) + moving
    backwards = np.maximum(-mean.input, 0.0), np.maximum(-mean.output, 0.0) + moving
    ahead = np.asarray(mean.output >= 0.0)
    useful, put_in = (np.where(ahead, one, other) for one, other in zip(forwards, backwards, strict=True))
    heat = moving + sum(np.sum(one, axis=-1) for one in (mean.driving, mean.driven, mean.supports, mean.seals))
    put_in = np.maximum(put_in, useful + heat)  # what shafts are driven with beside, and rounding
    found: Array = np.where(put_in > 0.0, useful / np.where(put_in > 0.0, put_in, 1.0), np.nan)
    return found


def _residual(mean: Powers) -> Array:
    """Return what the balance of the means misses, over the larger end."""
    parts = mean.driving, mean.driven
    taken = sum(np.sum(one, axis=-1) for one in (*parts, mean.supports, mean.seals, mean.resisting, mean.storing))
    size = np.maximum(np.abs(mean.input), np.abs(mean.output))
    found: Array = np.abs(mean.input - mean.output - taken) / np.where(size > 0.0, size, 1.0)
    return found
