"""What drives a mechanism and what its pairs carry, at rest and in motion: loads, weight and inertia."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost
from cardan.mechanism.kinetostatics import each_carried
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.texts import _
from cardan.units import deg, mm

from .motion import LinkMotion, MechanismMotion, mechanism_motion

BALANCED = 1e-7
"""What may be left unbalanced of the loads over the largest reaction; beyond, no reactions hold them there."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MechanismForces:
    """What drives a mechanism and what its pairs carry; nan where nothing holds the loads, as at change points.

    Attributes
    ----------
    motion : MechanismMotion
    input_torque : array (p,) [N·m]
        Torque that drives the input link about its axis; the force [N] along its axis on one that slides.
    still_torque : array (p,) [N·m]
        The same without inertia.
    reaction : array (p, m, 6) [N·m, N]
        Wrench (couple; force) of the first link of each pair on the second one, about the point of the pair.
    power : array (p,) [W]
        Of all loads, weight and inertia, at the speed of the input, or 1 rad/s (1 m/s) where it is not known.
    loss : array (p, m) [W]
        What friction takes in each pair, at the same speed.
    blur : array (p,) [N]
        What rounding may make of a force in a pair.
    unbalanced : float
        What is left of power and balance of every link, over the largest of each.
    """

    motion: MechanismMotion
    input_torque: Array
    still_torque: Array
    reaction: Array
    power: Array
    loss: Array
    blur: Array
    unbalanced: float

    @property
    def mechanism(self) -> Mechanism:
        """What was asked about."""
        return self.motion.mechanism

    @property
    def position(self) -> Array:
        """Where the input link is, from where it is drawn, array (p,): angles [rad]; paths [m] of one that slides."""
        return self.motion.position

    @property
    def efficiency(self) -> float | None:
        """Share of the work of the input that friction leaves over its range; None where nothing rubs or drives."""
        told = np.isfinite(self.input_torque)
        given = float(np.mean((self.mechanism.pace or 1.0) * self.input_torque[told]))
        lost = float(np.mean(np.sum(self.loss[told], axis=-1)))
        return 1.0 - lost / given if 0.0 < lost < given else None

    @property
    def force(self) -> Array:
        """Amount of the force in each pair, array (p, m) [N]."""
        return frames.norm(self.reaction[..., 3:])

    @property
    def most(self) -> Array:
        """Places at which each pair carries most, array (m,): the first where it carries the same but for rounding."""
        force = self.force
        same = np.nanmax(force - self.blur[:, None], axis=0) <= np.nanmin(force + self.blur[:, None], axis=0)
        first = int(np.argmax(np.isfinite(force[:, 0])))
        return np.where(same, first, foremost(force.T))

    @property
    def largest(self) -> Array:
        """Largest force in each pair, array (m,) [N]."""
        return np.asarray(self.force[self.most, np.arange(self.force.shape[1])])

    @property
    def couple(self) -> Array:
        """Amount of the couple in each pair, array (p, m) [N·m]."""
        return frames.norm(self.reaction[..., :3])

    def rolling(self) -> tuple[tuple[int, Pair], ...]:
        """Return the rolling contacts, each with its place among the pairs."""
        return tuple((k, pair) for k, pair in enumerate(self.mechanism.joints) if pair.kind.rolls)


def mechanism_forces(mechanism: Mechanism, position: Array | None = None) -> MechanismForces:
    """Return what drives a mechanism and what its pairs carry while its input link turns or slides uniformly.

    Parameters
    ----------
    mechanism : Mechanism
        With loads, a resistance of its output, or masses; inertia counts where it has a speed.
    position : array (p,) [rad], optional
        Angles of the input link; each degree of its range by default. Paths [m] of an input that slides.

    Returns
    -------
    MechanismForces

    Raises
    ------
    InputError
        As of `mechanism_motion`; an output that does not turn, or slide, as what resists it says.

    See Also
    --------
    mechanism_motion

    Notes
    -----
    Every link is balanced by Newton and Euler: loads, weight, -m a of its centre of mass and -(I dω/dt + ω × I ω), and
    the wrenches that its pairs hold. What is held too often shares so that the sum of squares is least. Pairs with a
    coefficient of friction rub by Coulomb's law against their motion, with the forces that friction itself makes.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan.mechanisms import mechanism_forces
    >>> import numpy as np
    >>> from cardan.mechanisms import example_mechanism
    >>> cones = replace(example_mechanism("friction-cones"), input_range=(0.0, 0.1))
    >>> found = mechanism_forces(cones, np.zeros(1))
    >>> [round(float(one[0]), 6) for one in (found.input_torque, found.force[:, 2])]
    [3.0, 50.0]
    """
    motion = mechanism_motion(mechanism, position)
    turned = motion.turned
    speed = mechanism.pace or 0.0
    rates = turned.rates
    twist, rate = speed * rates.speed, speed * speed * rates.acceleration
    still = _loads(motion)
    moving = still + _inertia(motion, twist, rate)
    pairs = mechanism.joints
    placed = replace(
        turned.placed,
        lever=tuple(0.5 * (one.diameter or 0.0) for one in pairs),
        spread=tuple(one.bearing_distance or math.inf for one in pairs),
    )
    rubbing = tuple(one.friction or 0.0 for one in pairs), speed >= 0.0
    rows = [each_carried(placed, [rubbing], load=one, **turned.driven)[0] for one in (still, moving)]
    here = rows[1]
    told = ~(turned.special | (here.unbalanced > BALANCED))
    _check_turns(mechanism, turned.position, here.locked & told & any(rubbing[0]))
    blank = np.where(told, 1.0, np.nan)
    pace = abs(speed) or 1.0
    loss = pace * here.loss
    each = pace * rates.speed * moving
    power, driven = np.sum(each, axis=(-2, -1)), pace * here.input_torque
    largest = float(np.max(np.sum(np.abs(each), axis=(-2, -1))[told], initial=0.0))
    sense = 1.0 if speed >= 0.0 else -1.0
    blur = _blur(motion, still, speed)
    gap = float(np.max(np.abs((driven + power - sense * np.sum(loss, axis=-1))[told]), initial=0.0)) / (largest or 1.0)
    return MechanismForces(
        motion=motion,
        input_torque=np.where(np.abs(here.input_torque) > blur[1], here.input_torque, 0.0) * blank,
        still_torque=np.where(np.abs(rows[0].input_torque) > blur[0], rows[0].input_torque, 0.0) * blank,
        reaction=here.reaction * blank[:, None, None],
        power=power,
        loss=loss * blank[:, None],
        blur=blur[1] * rates.steep * blank / (1.0 if mechanism.slides else turned.placed.size),
        unbalanced=max(gap, float(np.max(here.unbalanced[told], initial=0.0))),
    )


def _blur(motion: MechanismMotion, load: Array, speed: float) -> tuple[Array, Array]:
    """Return what rounding may make of the drive, without and with inertia, arrays (p,) [N·m], [N] where it slides.

    Of loads (p, n, 6) at speeds, and of inertia, which goes with the square of the speed, at accelerations.
    """
    rates, size = motion.turned.rates, motion.turned.placed.size
    points = np.stack([one.point for one in motion.links], axis=-2)
    force, couple = frames.norm(load[..., 3:]), frames.norm(load[..., :3] - frames.cross(points, load[..., 3:]))
    per = size if motion.mechanism.slides else 1.0
    still = np.sum(force * size + couple, axis=-1) * rates.blur(1) / per
    inert = sum(one.mass * size**2 + float(np.max(np.abs(one.tensor))) for one in motion.mechanism.masses)
    return still, still + inert * (speed / per) ** 2 * (rates.blur(1) + rates.blur(2)) / per


def _check_turns(mechanism: Mechanism, angle: Array, locked: Array) -> None:
    """Refuse a mechanism that friction locks."""
    if np.any(locked):
        text = _("friction locks the mechanism with {input} turned by {angle:.4g}°: no torque turns it on")
        if mechanism.slides:
            text = _("friction locks the mechanism with {input} moved by {path:.4g} mm: no force moves it on")
        where = float(angle[int(np.argmax(locked))])
        said = text.format(input=repr(mechanism.input_link), angle=where / deg, path=where / mm)
        raise refuse("joints", said, "out_of_range")


def _loads(motion: MechanismMotion) -> Array:
    """Return loads and weight on every link about the origin, array (p, n, 6) [N·m, N]."""
    mechanism, poses = motion.mechanism, motion.turned.displacement
    found = np.zeros((*poses.shape[:2], 6))
    index = mechanism.links.index
    for one in mechanism.masses:
        k = index(one.link)
        _push(found[:, k], motion.links[k].point, one.mass * np.asarray(mechanism.gravity))
    for load in mechanism.loads:
        k = index(load.link)
        turn = poses[:, k, :3, :3] if load.turns_with_link else np.eye(3)
        force, torque = turn @ np.asarray(load.force), turn @ np.asarray(load.torque)
        point = poses[:, k, :3, :3] @ np.asarray(load.point or (0.0, 0.0, 0.0)) + poses[:, k, :3, 3]
        _push(found[:, k], point, force)
        found[:, k, :3] += torque
    output = motion.output
    if output is not None:
        k = index(output.link)
        for name, ways, told in (
            ("output_torque", ("turns", "screws"), output.ratio),
            ("output_force", ("slides",), output.speed),
        ):
            amount = getattr(mechanism, name)
            if amount is None:
                continue
            _check_way(name, output, ways)
            sense = -1.0 if (mechanism.pace or 0.0) < 0.0 else 1.0
            against = -sense * amount * np.sign(np.nan_to_num(told))[:, None] * output.axis
            if name == "output_torque":
                found[:, k, :3] += against
            else:
                _push(found[:, k], output.point, against)
    return found


def _check_way(name: str, output: LinkMotion, ways: tuple[str, ...]) -> None:
    if output.way not in ways:
        text = _("{link} does not turn about a fixed axis; say what resists it in loads")
        if name == "output_force":
            text = _("{link} does not slide along a line; say what resists it in loads")
        raise refuse(name, text.format(link=repr(output.link)), "inconsistent")


def _push(wrench: Array, point: Array, force: Array) -> None:
    """Add a force (..., 3) at points (p, 3) to wrenches about the origin (p, 6)."""
    force = np.broadcast_to(force, point.shape)
    wrench[:, :3] += frames.cross(point, force)
    wrench[:, 3:] += force


def _inertia(motion: MechanismMotion, twist: Array, rate: Array) -> Array:
    """Return what inertia does to every link about the origin, array (p, n, 6) [N·m, N]; Newton and Euler."""
    mechanism, poses = motion.mechanism, motion.turned.displacement
    found = np.zeros_like(twist)
    for one in mechanism.masses:
        k = mechanism.links.index(one.link)
        spin, steep, point = twist[:, k, :3], rate[:, k, :3], motion.links[k].point
        pace = twist[:, k, 3:] + frames.cross(spin, point)
        swept = rate[:, k, 3:] + frames.cross(steep, point) + frames.cross(spin, pace)
        _push(found[:, k], point, -one.mass * swept)
        turn = poses[:, k, :3, :3]
        tensor = turn @ one.tensor @ np.swapaxes(turn, -1, -2)
        momentum = (tensor @ spin[..., None])[..., 0]
        found[:, k, :3] -= (tensor @ steep[..., None])[..., 0] + frames.cross(spin, momentum)
    return found
