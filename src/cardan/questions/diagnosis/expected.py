"""What should appear: the orders that a fault of a drive makes, how they follow speed and torque, and where."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.questions.bending.cracked_rotor import GRAVITY
from cardan.texts import _, mark
from cardan.units import deg

from .drive_model import DriveModel, Housing, plant


@dataclass(frozen=True, kw_only=True)
class Expected:
    """What a fault of a drive should show.

    Attributes
    ----------
    fault : str
        One of `FAULTS`.
    cause : str
        Id of its row in the catalogue of faults; empty when healthy.
    orders : tuple of ExpectedOrder
        Those of the drive in order, and those of the fault.
    bursts : tuple of Bursts
        Knocks.
    critical : float [rad/s]
        Bending critical speed that amplifies; nan where not known.
    damping : float
        Of the bending mode.
    speed : (float, float) [rad/s]
        Range of running.
    reference : float [N·m]
        Torque of the duty.
    assumed : tuple of str
        Key paths of what the drive does not say.
    """

    fault: str
    cause: str
    orders: tuple[ExpectedOrder, ...]
    bursts: tuple[Bursts, ...] = ()
    critical: float
    damping: float
    speed: tuple[float, float]
    reference: float
    assumed: tuple[str, ...] = field(default=())

    def value(self, line: ExpectedOrder, speed: ArrayLike, torque: ArrayLike) -> Array:
        """Return an order over speed [rad/s] and torque [N·m], complex array (...): its size, and its phase's turn.

        Notes
        -----
        size (ω/ω_top)^p (a + bτ + c|τ|) H, H = 1/(1 − s² + 2iζs), s = order · ω/ω_c.
        """
        omega, share = np.asarray(speed, dtype=float), np.asarray(torque, dtype=float) / self.reference
        still, signed, sized = line.torque
        level = line.size * (omega / self.speed[1]) ** line.speed_power
        level = level * (still + signed * share + sized * np.abs(share))
        if not line.amplified or math.isnan(self.critical):
            return level + 0j
        ratio = line.order * omega / self.critical
        return np.asarray(level / (1.0 - ratio**2 + 2j * self.damping * ratio))


def expected_orders(
    drive: Drive, fault: str = "healthy", *, severity: float = 1.0, shaft: int | None = None
) -> Expected:
    """Return the orders that a fault of a drive should make at its bearings.

    Parameters
    ----------
    drive : Drive
        The drive in order.
    fault : str
        One of `FAULTS`.
    severity : float
        1 for a plain fault; sizes grow with it.
    shaft : int, optional
        Number of the shaft with the fault, 2 to n; the heaviest when not given.

    Returns
    -------
    Expected

    Raises
    ------
    InputError
        An unknown fault, one that the drive cannot have, or a severity not above 0.

    See Also
    --------
    diagnose, simulate_fault

    Notes
    -----
    Unbalance U: force U ω² (Book (253)-(260) for the critical speed), half at each joint, amplified by the bending
    mode. Secondary couple T tan α over the length of the shaft, order 2. Uneven running |τ| 2ω at the output, and its
    inertia torque J (2ω)² |τ|. Crack, to the first order in its losses Δ_ξ, Δ_η, breathing by (1 + cos θ)/2: forces m g
    times (Δ_ξ+Δ_η)/8 + (Δ_ξ−Δ_η)/8 at order 1, (Δ_ξ−Δ_η)/4 at order 2, (Δ_ξ−Δ_η)/8 at order 3, each amplified. Play:
    m c ω² with the torque deciding how the parts centre. Accelerations are forces over the mass of a housing; that mass
    and the axial shares are figures of this program, so that sizes are good to a factor and shapes to more.

    Examples
    --------
    >>> from cardan import example
    >>> from cardan.recordings import expected_orders
    >>> found = expected_orders(example("truck-supports"), "joint_angles")
    >>> sorted({line.order for line in found.orders if line.direction == "radial"})
    [1.0, 2.0, 4.0]
    """
    if fault not in FAULTS:
        text = _("{value} is none of {choices}").format(value=repr(fault), choices=", ".join(FAULTS))
        raise refuse("fault", text, "out_of_range")
    if not 0.0 < severity < math.inf:
        raise refuse("severity", _("{value:.6g} given; it must be above 0").format(value=severity), "not_positive")
    base = plant(drive)
    chosen = int(np.argmax(base.mass)) if shaft is None else shaft - 2
    if not 0 <= chosen < base.mass.size:
        text = _("shaft {number} lies not between two joints").format(number=shaft)
        raise refuse("shaft", text, "out_of_range")
    if fault == "centre_bearing" and base.housing("centre") is None:
        raise refuse("fault", _("the drive has no centre bearing"), "inconsistent")
    wrong = _moved(base, fault, severity)
    lines = [*in_order(wrong, fault, severity), *MAKERS[fault][1](wrong, severity, chosen)]
    return Expected(
        fault=fault,
        cause=FAULTS[fault],
        orders=tuple(one for one in lines if one.size > 0.0),
        bursts=bursts_of(wrong, fault, severity),
        critical=wrong.critical,
        damping=wrong.damping,
        speed=wrong.speed,
        reference=wrong.torque,
        assumed=base.assumed,
    )


def _moved(base: DriveModel, fault: str, severity: float) -> DriveModel:
    """Return the drive with the critical speed where the fault has it."""
    top = base.speed[1]
    if fault == "half_critical":
        return replace(base, critical=1.6 * top, damping=0.02 / severity)
    if fault == "critical":
        return replace(base, critical=(1.02 + 0.03 / severity) * top)
    return base


# The orders and knocks that each fault makes: forces at the joints, shared out to the housings.

RESIDUAL = 0.5  # share of the allowed unbalance that a drive in order has
TIMES = 4.0  # unbalance of a fault over the allowed one
RUNOUT, PLAY = 0.4e-3, 0.1e-3  # Run-out of a bent tube and play of a worn joint, spline or bearing, at severity 1 [m]

WRONG_JOINT_ANGLE, WRONG_PHASE = 5.0 * deg, 30.0 * deg
"""What a joint angle is too large by and a yoke is turned by, at severity 1."""

TIGHT = 0.1  # friction couple of a tight joint over the torque

LOSSES = (0.45, 0.1)
"""Losses of stiffness of a crack, across and along its edge (the captions of the paper on cracked shafts)."""

ARM = 0.2  # arm on which a swinging torque is taken up by a housing [m]

BOOK, COUPLES, SPLINES = (
    mark("Kozhevnikov & Perfil'ev (1978), eq. 253–260"),
    mark("Kozhevnikov & Perfil'ev (1978), eq. 66–74"),
    mark("Kozhevnikov & Perfil'ev (1978), p. 228"),
)
SECONDARY = f"{COUPLES}; {mark('secondary couple T tan α')}"
GRADES = "ISO 21940-11"
PAPER = f"{mark('paper on cracked shafts with a joint')}; {mark('first order in the losses of stiffness')}"
TRADE, LOOSE = mark("usual practice of the trade"), mark("usual practice of the trade: looseness")
FRICTION = mark("square wave of a friction couple")
UNEVEN = mark("equivalent joint of the drive: amplitude |τ| of order 2")


@dataclass(frozen=True, kw_only=True)
class ExpectedOrder:
    """One order at one sensor, and how it follows speed and torque."""

    order: float  # multiple of the speed of the shaft
    place: str  # key path of the support or shaft where the sensor sits
    kind: str  # ``input``, ``centre`` or ``output``
    direction: str  # ``radial``, ``axial`` [m/s²] or ``torsion`` (speed of the output beside its mean, [rad/s])
    size: float  # amplitude at top speed and the torque of the duty, without amplification
    speed_power: float  # p of (ω/ω_top)^p
    # a, b, c of the factor |a + bτ + c|τ||, τ torque over that of the duty
    torque: tuple[float, float, float] = (1.0, 0.0, 0.0)
    amplified: bool = False  # whether the bending mode amplifies it where order times speed meets the critical speed
    source: str  # where the line comes from


@dataclass(frozen=True, kw_only=True)
class Bursts:
    """Knocks: noise that comes some times a turn."""

    per_turn: int  # how often
    kind: str  # housing where they are loudest
    size: float  # [m/s²]: amplitude at light torque
    torque: tuple[float, float, float]  # as for orders


def _spread(
    base: DriveModel,
    shares: dict[int, float],
    *,
    order: float,
    power: float,
    source: str,
    axial: float = 0.0,
    **more: object,
) -> Iterator[ExpectedOrder]:
    """Yield the lines of forces {joint: N at top speed} at every housing, and their axial part."""
    for house in base.housings:
        force = sum(amount for joint, amount in shares.items() if joint in house.joints)
        for direction, share in (("radial", 1.0), ("axial", axial)):
            yield _line(house, direction, order, share * force / house.mass, power, source, **more)


def _line(
    house: Housing, direction: str, order: float, size: float, power: float, source: str, **more: object
) -> ExpectedOrder:
    return ExpectedOrder(
        order=float(order),
        place=house.place,
        kind=house.kind,
        direction=direction,
        size=size,
        speed_power=power,
        source=source,
        **more,  # type: ignore[arg-type]
    )


def _ends(chosen: int, force: float) -> dict[int, float]:
    return {chosen: 0.5 * force, chosen + 1: 0.5 * force}


def _couples(base: DriveModel, joint_angle: Array) -> dict[int, float]:
    """Return the forces of the secondary couples of all joints, that of each over its shorter shaft."""
    length = [
        float(min(base.length[max(k - 1, 0)], base.length[min(k, base.length.size - 1)]))
        for k in range(joint_angle.size)
    ]
    return {k: base.torque * math.tan(float(one)) / length[k] for k, one in enumerate(joint_angle)}


def _turning(base: DriveModel, uneven: float, source: str = UNEVEN) -> Iterator[ExpectedOrder]:
    """Yield what an uneven output makes: its speed, and the torque that its inertia takes at both ends."""
    top, last = base.speed[1], base.joint_angle.size - 1
    house = base.housings[-1]
    yield _line(house, "torsion", 2.0, 2.0 * top * uneven, 1.0, source)
    swing = 4.0 * base.inertia * top**2 * uneven / ARM
    yield from _spread(base, {0: swing, last: swing}, order=2.0, power=2.0, source=source)


def in_order(base: DriveModel, fault: str, severity: float) -> Iterator[ExpectedOrder]:
    """Yield what a drive in order shows as well."""
    top = base.speed[1]
    for k, allowed in enumerate(base.allowed):
        force = RESIDUAL * float(allowed) * top**2
        yield from _spread(
            base, _ends(k, force), order=1.0, power=2.0, source=f"{GRADES}; {BOOK}", axial=0.15, amplified=True
        )
    joint_angle = base.joint_angle
    if fault == "joint_angles":
        joint_angle = joint_angle + np.where(
            np.arange(joint_angle.size) == joint_angle.size - 1,
            WRONG_JOINT_ANGLE * severity,
            0.5 * WRONG_JOINT_ANGLE * severity,
        )
    by_torque = (0.0, 0.0, 1.0)
    shares = _couples(base, joint_angle)
    yield from _spread(
        base, shares, order=2.0, power=0.0, source=SECONDARY, axial=0.1, torque=by_torque, amplified=True
    )
    small = {k: 0.05 * one for k, one in _couples(base, joint_angle).items()}
    yield from _spread(base, small, order=4.0, power=0.0, source=SECONDARY, torque=by_torque)
    yield from _turning(base, base.uneven + 0.03 * math.tan(0.5 * float(np.max(base.joint_angle))) ** 2)


def _nothing(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    yield from ()


def _unbalance(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    force = TIMES * severity * float(base.allowed[chosen]) * base.speed[1] ** 2
    source = f"{GRADES}; {BOOK}"
    yield from _spread(base, _ends(chosen, force), order=1.0, power=2.0, source=source, axial=0.15, amplified=True)


def _lost_weight(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    force = 0.7 * TIMES * severity * float(base.allowed[chosen]) * base.speed[1] ** 2
    yield from _spread(base, {chosen + 1: force}, order=1.0, power=2.0, source=GRADES, axial=0.15)


def _bent(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    out = max(RUNOUT, 5.0 * float(base.allowed[chosen] / base.mass[chosen])) * severity
    force = 2.0 / math.pi * out * float(base.mass[chosen]) * base.speed[1] ** 2
    ends = _ends(chosen, force)
    yield from _spread(base, ends, order=1.0, power=2.0, source=f"{BOOK}; {TRADE}", axial=0.7, amplified=True)
    house = base.housings[-1]
    for order, share in ((2.0, 0.2),):
        yield _line(house, "axial", order, share * force / house.mass, 2.0, TRADE)


def _joint_angles(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    last = float(base.joint_angle[-1])
    yield from _turning(
        base, abs(math.tan(0.5 * (last + 0.5 * WRONG_JOINT_ANGLE * severity)) ** 2 - math.tan(0.5 * last) ** 2)
    )


def _phase(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    turn = min(WRONG_PHASE * severity, 0.5 * math.pi)
    uneven = 2.0 * math.sin(turn) * math.tan(0.5 * float(base.joint_angle[-1])) ** 2
    yield from _turning(base, uneven)


def _tight(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    couple = TIGHT * severity * base.torque / float(base.length[chosen])
    # A couple of friction turns its sense with the swing of the joint: a square wave, whose orders in space are even.
    for order, share in ((1.0, 0.6), (2.0, 1.0), (4.0, 0.5)):
        shares = {chosen: share * couple}
        yield from _spread(
            base, shares, order=order, power=0.0, source=f"{FRICTION}; {TRADE}", axial=0.2, torque=(0.8, 0.0, 0.2)
        )


def _crack(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    across, along = (min(0.8, one * severity) for one in LOSSES)
    weight = float(base.mass[chosen]) * GRAVITY
    for order, share in ((1.0, 0.25 * across), (2.0, 0.25 * (across - along)), (3.0, 0.125 * (across - along))):
        force = share * weight
        yield from _spread(base, _ends(chosen, force), order=order, power=0.0, source=PAPER, axial=0.1, amplified=True)


def _play(base: DriveModel, severity: float, chosen: int) -> float:
    """Return the force of a shaft off centre by its play, at top speed."""
    mass = float(base.mass[chosen])
    return severity * max(PLAY * mass, 2.5 * float(base.allowed[chosen])) * base.speed[1] ** 2


def _worn_joint(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    force = _play(base, severity, chosen)
    one = {chosen + 1: force}
    yield from _spread(base, one, order=1.0, power=2.0, source=TRADE, axial=0.15, torque=(1.0, 0.3, -0.6))
    two = {chosen + 1: 0.5 * force}
    yield from _spread(base, two, order=2.0, power=1.0, source=TRADE, axial=0.15, torque=(0.4, 0.0, 0.6))


def _worn_spline(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    force = _play(base, severity, chosen)
    source = f"{SPLINES}; {TRADE}"
    yield from _spread(
        base, _ends(chosen, force), order=1.0, power=2.0, source=source, axial=0.5, torque=(0.2, 0.9, 0.0)
    )


def _centre(base: DriveModel, severity: float, chosen: int) -> Iterator[ExpectedOrder]:
    force = 0.6 * _play(base, severity, chosen)
    for order, share in ((0.5, 0.5), (1.0, 0.5), (1.5, 0.35), (2.0, 0.5), (3.0, 0.3)):
        for house in base.housings:
            near = 1.0 if house.kind == "centre" else 0.1
            yield _line(house, "radial", order, near * share * force / house.mass, 1.5, LOOSE)


MAKERS: dict[str, tuple[str, Callable[[DriveModel, float, int], Iterator[ExpectedOrder]]]] = {
    "healthy": ("", _nothing),
    "unbalance": ("F01", _unbalance),
    "lost_weight": ("F01", _lost_weight),
    "bent": ("F02", _bent),
    "joint_angles": ("F10", _joint_angles),
    "phase": ("F11", _phase),
    "half_critical": ("F12", _nothing),
    "tight_joint": ("F13", _tight),
    "critical": ("F14", _nothing),
    "crack": ("F15", _crack),
    "worn_joint": ("F20", _worn_joint),
    "worn_spline": ("F21", _worn_spline),
    "centre_bearing": ("F23", _centre),
}
"""Fault -> its row of the catalogue, empty for a drive in order, and what makes its orders."""

FAULTS = {fault: row for fault, (row, _made) in MAKERS.items()}  # fault -> its row of the catalogue


def bursts_of(base: DriveModel, fault: str, severity: float) -> tuple[Bursts, ...]:
    """Return the knocks of a fault."""
    times = {"worn_joint": 2, "worn_spline": 1}.get(fault)
    if times is None:
        return ()
    house = base.housings[-1]
    size = 1.5 * _play(base, severity, base.mass.size - 1) / house.mass
    return (Bursts(per_turn=times, kind=house.kind, size=size, torque=(1.0, 0.0, -0.8)),)
