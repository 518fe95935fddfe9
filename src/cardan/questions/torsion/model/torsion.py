"""How does a drive vibrate in torsion? Natural frequencies, shapes, and the speeds at which something excites them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.machine import HarmonicTorque
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import NEGLIGIBLE, given_chain, turning
from cardan.drive.models.law_series import beside_maps
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import series_at
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, harmonic_balance
from cardan.texts import _

from .inputs import Swinging
from .side_bands import side_waves
from .torsional_layouts import Turning, chosen, period_of
from .torsional_model import Torque
from .torsional_modes import changing_orders, main_order, meeting_speeds, modulation, straight_modes
from .torsional_train import TorsionalTrain, in_time, torsional_train

STRAIGHT = 1e-9
"""Joints that bend less [rad] excite nothing."""

BESIDE, SIDES, LEAST = (-4.0, -2.0, 2.0, 4.0), 6, 0.05
"""Distances of the side bands from the order of a torque, harmonics of half a turn by which they are found, and the
share of that torque from which one counts."""

HIGHEST = 4
"""Order of the joints up to which they are told."""

MODES = 4
"""Modes that side bands are asked for."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Node:
    """Place of a mode that stands still."""

    before: int  # before, behind: stations on either side; the same one where it stands still itself
    behind: int
    share: float  # how far from the one to the other
    position: float  # [m]: along the line of the shafts from the input end


@dataclass(frozen=True, kw_only=True, slots=True)
class Crossing:
    """Speed at which an order of the shaft meets a natural frequency."""

    mode: int  # from 1
    order: float  # swings in one turn of the input shaft
    cause: str  # what swings so
    speed: float  # [rad/s]: of the input
    inside: bool | None  # whether it lies in the speed range of the duty; None where that gives none
    # [N·m]: of a side band of a torque with the joints: the largest torque it makes there, to first order; else None
    torque: float | None = None
    share: float | None = None  # that over the torque that it is a side band of


@dataclass(frozen=True, eq=False, kw_only=True)
class TorsionModes:
    """Torsional modes of a drive, the slowest first; turning without twist is left out.

    Attributes
    ----------
    train : TorsionalTrain
        The model.
    omega : array (m,) [rad/s]
        Natural frequencies, all joints straight.
    shape : array (m, N)
        Angle of every station, the largest 1.
    damping_ratio : array (m,)
        ζ, of all damping the drive names.
    joint_weight : array (m, n)
        κ of every joint in every mode: 0 in a node, where a joint excites no parametric vibration.
    modulation : array (m,)
        Share by which the joints together modulate the stiffness of the mode.
    order : array (m,)
        Order of the turn at which they modulate it most, ν: 2 but with joints that turn by laws of their own.
    main : float
        Order at which the joints change the speed most, all of them together.
    nodes : tuple of m tuples of Node
        Where each mode stands still.
    speed : float [rad/s]
        Input speed at which pendulums and machines were asked; 0 where the drive gives none.
    speed_range : (float, float) or None [rad/s]
        Input speeds in use.
    crossings : tuple of Crossing
        Orders of joints, engine and load that meet a natural frequency, the slowest first.
    residual : float
        What the balance of the modes misses, over their largest torque.
    """

    train: TorsionalTrain
    omega: Array
    shape: Array
    damping_ratio: Array
    joint_weight: Array
    modulation: Array
    order: Array
    main: float
    nodes: tuple[tuple[Node, ...], ...]
    speed: float
    speed_range: tuple[float, float] | None
    crossings: tuple[Crossing, ...]
    residual: float

    def at(self, speed: ArrayLike) -> Array:
        """Return the natural frequencies at input speeds (s,), array (s, m) [rad/s]; only pendulums change them."""
        speeds = np.abs(np.asarray(speed, dtype=float))
        if not self.train.pendulums:
            return np.broadcast_to(self.omega, (*speeds.shape, len(self.omega)))
        found = np.full((len(speeds), len(self.omega)), np.nan)
        at = list(self.train.pendulums)
        for row, one in zip(found, speeds, strict=True):
            stiffness = self.train.model.stiffness.copy()
            stiffness[at] *= (one / self.speed) ** 2
            omega = straight_modes(replace(self.train.model, stiffness=stiffness, torques=())).omega
            row[: len(omega)] = omega
        return found

    @property
    def order2_speed(self) -> Array:
        """Input speed at which two swings a turn meet each natural frequency, ω/2: array (m,) [rad/s]."""
        return 0.5 * self.omega

    @property
    def main_speed(self) -> Array:
        """Input speed at which the main order of the joints meets each natural frequency: array (m,) [rad/s]."""
        return self.omega / self.main

    @property
    def parametric_speed(self) -> Array:
        """Input speed of each principal zone of parametric resonance, 2ω/ν: array (m,) [rad/s]."""
        return 2.0 * self.omega / self.order

    @property
    def zone(self) -> Array:
        """Input speeds between which each mode grows by parametric resonance, array (m, 2) [rad/s]; nan where none.

        To first order in the modulation: Ω = 2ω/ν (1 ± ½ √((q/a)² - 4ζ²)), Book (221) with the corrected q.
        """
        return self._zone(0.0)

    @property
    def zone_surely(self) -> Array:
        """What terms of second order surely leave of each zone, array (m, 2) [rad/s]; nan where it may be nothing.

        They move an edge by the square of the modulation at most: of Mathieu's equation a = 1 ± q - q²/8 - …, so that
        Ω = 2ω/ν (1 ± ½ m + ⅜ m² + …) without damping.
        """
        return self._zone(-1.0)

    @property
    def zone_perhaps(self) -> Array:
        """How far each zone may reach with terms of second order, array (m, 2) [rad/s]; nan where there is none."""
        return self._zone(1.0)

    def _zone(self, wider: float) -> Array:
        """Return the zones, so many times the terms of second order wider, array (m, 2) [rad/s]."""
        second = wider * self.modulation**2
        square = (self.modulation + second) ** 2 - 4.0 * self.damping_ratio**2
        half = 0.5 * np.sqrt(np.where(square > 0.0, square, np.nan)) + second
        half = np.where(half > 0.0, half, np.nan)
        found: Array = self.parametric_speed[:, None] * (1.0 + half[:, None] * np.asarray([-1.0, 1.0]))
        return found

    def least_loss(self, used: tuple[float, float]) -> Array:
        """Return the loss factor 2ζ from which each mode is stable at all of some input speeds, array (m,).

        To first order in the modulation, as `zone`: 2ζ = √((q/a)² - 4 (Ω/Ω_p - 1)²) at the speed nearest to that of the
        principal zone; 0 where it is stable without any damping.
        """
        centre = self.parametric_speed
        near = np.clip(centre, *used)
        found: Array = np.sqrt(np.maximum(self.modulation**2 - 4.0 * (near / centre - 1.0) ** 2, 0.0))
        return found

    @property
    def growth_rate(self) -> Array:
        """How fast each mode grows amid its principal zone, array (m,) [1/s]; negative where it dies out."""
        found: Array = self.omega * (0.5 * self.modulation - self.damping_ratio)
        return found


def torsion_modes(drive: Drive, duty: Duty | None = None, *, pieces: int = 1) -> TorsionModes:
    """Return the torsional modes of a drive and the speeds at which something excites them.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`.
    duty : Duty, optional
        What it does; that of the drive by default. Its engine and loads give orders, its speed range what matters.
    pieces : int
        Into how many equal stretches the body between two stations is divided.

    Returns
    -------
    TorsionModes

    Raises
    ------
    InputError
        What the model misses, each with the key to add.

    See Also
    --------
    torsion_response, stability

    Notes
    -----
    (K - ω²M) u = 0 with all joints straight, whose mean ratio is 1. Joints excite order 2, 4, …, by laws of their own
    1, 2, 3, …; the order ν meets ω at Ω = ω/ν. Beside that they modulate the stiffness, a cross twice a turn, which
    excites a mode at Ω = 2ω/ν however small the torque, unless damped: see `torsional_modes.modulation`.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, torsion_modes
    >>> from cardan.parts import Duty, Shaft, Station
    >>> two = (Station(shaft=1, inertia=2.0), Station(shaft=2, inertia=0.6))
    >>> drive = replace(Drive.from_angles([0.2]), shafts=(Shaft(number=1, stiffness=900.0),), stations=two)
    >>> found = torsion_modes(drive, Duty(input="free"))
    >>> found.omega, found.order2_speed
    (array([44.15880433]), array([22.07940217]))
    """
    return modes_of(drive, drive.duty if duty is None else duty, pieces=pieces)


def modes_of(drive: Drive, chosen: Duty, *, pieces: int = 1, crossings: bool = True) -> TorsionModes:
    """Return the same; crossings: whether the speeds at which orders meet modes are told, side bands take a while."""
    train = torsional_train(drive, chosen, pieces=pieces, loaded=chosen.speed is not None)
    found = straight_modes(train.model, speed=chosen.speed or 0.0)
    if not len(found.omega) and train.model.elements:
        text = _("too few of them have inertia: nothing oscillates against the rest; give the inertias of the machines")
        raise refuse("stations", text)
    if not len(found.omega):
        text = _("missing; every shaft counts as rigid, so nothing vibrates: give a body of known length, or stiffness")
        raise refuse("shafts[0].stiffness", text)
    largest = np.max(np.abs(found.shape), axis=-1, keepdims=True)
    swinging = np.asarray(changing_orders(train.model))
    modulations = np.abs([modulation(train.model, found.joint_weight, order) for order in swinging.tolist()])
    return TorsionModes(
        train=train,
        omega=found.omega,
        shape=found.shape / largest,
        damping_ratio=found.damping_ratio,
        joint_weight=found.joint_weight,
        modulation=np.max(modulations, axis=0),
        order=swinging[np.argmax(modulations, axis=0)],
        main=main_order(train.model),
        nodes=tuple(tuple(_nodes(train, shape)) for shape in found.shape / largest),
        speed=abs(chosen.speed or 0.0),
        speed_range=chosen.speed_range,
        crossings=tuple(_crossings(drive, chosen, train)) if crossings else (),
        residual=float(np.max(found.residual)),
    )


def _nodes(train: TorsionalTrain, shape: Array) -> Iterator[Node]:
    """Yield where a mode stands still along the line."""
    place = train.position
    line = set(train.line)
    for a, b in train.model.elements:
        if a not in line or b not in line:
            continue
        one, two = float(shape[a]), float(shape[b])
        if one * two < 0.0:
            share = one / (one - two)
            yield Node(before=a, behind=b, share=share, position=float(place[a] + share * (place[b] - place[a])))
        elif abs(two) < 1e-12 < abs(one):
            yield Node(before=b, behind=b, share=0.0, position=float(place[b]))


def orders(drive: Drive, duty: Duty) -> list[tuple[float, str]]:
    """Return the orders of the input shaft that something excites, each with its cause, rising."""
    found: dict[float, str] = {}
    whole = given_chain(drive)
    near = turning(whole, drive.joints, near=True)
    if np.any(near.joint_angle > STRAIGHT):
        found |= {2.0: _("joints"), 4.0: _("joints")}
    own = beside_maps(drive, whole, near, geometry(drive))
    size = np.zeros(0) if own is None else np.max(np.abs(own[: HIGHEST + 1]), axis=-1)
    found |= {float(one): _("joints") for one in np.flatnonzero(size > NEGLIGIBLE) if one}
    engine = duty.engine
    if engine is not None:
        given = [one.order for one in engine.harmonics]
        if not given and engine.cylinders is not None:
            given = [step * 2.0 * engine.cylinders / engine.strokes for step in (1, 2)]
        for order in given:
            _add(found, order * engine.speed_ratio, _("engine, order {order:g} of its crank").format(order=order))
    for harmonic in duty.harmonics:
        _add(found, harmonic.order, _("torque of the duty"))
    machines = (("motor", duty.motor), ("load", duty.load), *(("torques", one) for one in duty.torques))
    for name, machine in machines:
        if isinstance(machine, HarmonicTorque):
            word = {"motor": _("motor"), "load": _("load")}.get(name) or _("torque on {station}")
            _add(found, machine.order, word.format(station=machine.station))
    return sorted(found.items())


def _add(found: dict[float, str], order: float, cause: str) -> None:
    found[order] = f"{found[order]}, {cause}" if order in found else cause


def _crossings(drive: Drive, duty: Duty, train: TorsionalTrain) -> list[Crossing]:
    between = duty.speed_range
    rows = []
    for order, cause in orders(drive, duty):
        found = meeting_speeds(train.model, order, train.pendulums, float(duty.speed or 1.0))
        for mode, speed in enumerate(found.tolist(), start=1):
            inside = None if between is None else between[0] <= speed <= between[1]
            rows.append(Crossing(mode=mode, order=order, cause=cause, speed=speed, inside=inside))
    rows += _side_crossings(duty, train, [one.order for one in rows])
    return sorted(rows, key=lambda one: (one.speed, one.order))


def _side_crossings(duty: Duty, train: TorsionalTrain, known: list[float]) -> Iterator[Crossing]:
    """Yield where side bands of torques with the joints meet a mode, those that make some torque there."""
    loose = [one for one in train.model.torques if isinstance(one.law, Swinging) and np.all(one.law.amplitude != 0.0)]
    between = duty.speed_range
    for torque in loose if duty.speed else ():
        assert isinstance(torque.law, Swinging)
        for beside in BESIDE:
            order = abs(torque.law.frequency + beside)
            if order < STRAIGHT or any(abs(order - one) < STRAIGHT for one in known):
                continue
            found = meeting_speeds(train.model, order, train.pendulums, abs(duty.speed or 1.0))[:MODES]
            sizes = side_torques(train, torque, beside, found, abs(duty.speed or 1.0)) if len(found) else np.zeros(0)
            share = sizes / abs(float(np.max(np.abs(torque.law.amplitude))))
            for mode, speed in enumerate(found.tolist(), start=1):
                if share[mode - 1] >= LEAST:
                    text = _("side band {beside} of order {order:g} with the joints")
                    yield Crossing(
                        mode=mode,
                        order=order,
                        cause=text.format(beside=f"{beside:+g}", order=torque.law.frequency),
                        speed=speed,
                        inside=None if between is None else between[0] <= speed <= between[1],
                        torque=float(sizes[mode - 1]),
                        share=float(share[mode - 1]),
                    )


def side_torques(train: TorsionalTrain, torque: Torque, beside: float, speed: Array, taken: float) -> Array:
    """Return the largest torque in a drive of one side band of a torque at speeds (s,) [rad/s], array (s,) [N·m].

    beside: by how much its order differs; taken [rad/s]: speed at which the model is. About the motion that the joints
    make without any torque; nan where there is none.
    """
    model = replace(train.model, backlash=np.zeros_like(train.model.backlash), torques=())
    model = in_time(model if model.free else replace(model, input_speed=speed), main_order(model) * speed)
    own, period = np.arange(len(speed)), period_of(model)
    drives = chosen(model, (len(speed),), own, moments=False)
    if train.pendulums:
        stiffness, at = drives.stiffness.copy(), list(train.pendulums)
        stiffness[:, at] *= (speed[:, None] / taken) ** 2
        drives = replace(drives, stiffness=stiffness)
    turns, sides = Turning(drives, (len(speed),), speed, period), SIDES * round(period / np.pi)
    how = HarmonicBalance(harmonics=sides, most=sides)
    waves = harmonic_balance(turns, turns.frequency, turns.coordinates, free=model.free, method=how)
    phase, rate = 2.0 * np.pi * np.arange(4 * sides + 4) / (4 * sides + 4), turns.frequency[:, None, None]
    x, v, a = series_at(waves.coefficient, phase)
    motion = turns.motion(own, phase, x, rate * v, rate**2 * a)
    found = side_waves(turns.drives(own), motion, speed, period, (torque,), sides)[0]
    band = round(beside * period / (2.0 * np.pi))
    size = np.max(np.abs(np.fft.fft(found, axis=-1)[..., band]), axis=-1) / len(phase)
    return np.where(waves.status == Status.NO_CONVERGENCE, np.nan, size)
