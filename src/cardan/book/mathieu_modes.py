"""Where the torsional modes of a drive stand in the chart of Mathieu's equation, and the book's method for sizing.

Every mode of a drive obeys y'' + 2n y' + (a - 2q cos 2z) y to first order in the joint angles, z half the phase of the
order at which the joints modulate it most: with cross joints the input angle. The book has it for two inertias, whose
only mode it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array
from cardan.maths.periodic.mathieu import LARGEST_A, Exponents, exponents
from cardan.questions.torsion.model.inputs import Swinging
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.steady.dynamic_torque import dynamic_torque
from cardan.texts import _

from .dynamic_book import EngineeringTorque, Validity, engineering_torque, validity
from .mathieu_drive import zone_speeds

JOINTS = 2.0
"""Order in which cross joints shake."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sizing:
    """Torque in the last shaft by the book's method for sizing, and by the exact drive."""

    book: EngineeringTorque
    most: float  # [N·m]: mean and all amplitudes of the book together
    exact: float  # [N·m]: largest torque of the last shaft as it vibrates; nan where no motion was found


@dataclass(frozen=True, eq=False, kw_only=True)
class MathieuModes:
    """Mathieu's equation of every torsional mode of a drive at its speed."""

    speed: float  # [rad/s]: ω_1 of the input
    modes: TorsionModes
    number: Array  # (m,) of int: of the modes that the equation can be told of, from 1
    order: Array  # (m,): ν of the modulation; z = νφ/2 of the input angle φ
    a: Array  # (m,): (2ω/(νω_1))²
    q: Array  # (m,): parametric term, twice that of Book (196)
    damping: Array  # (m,): n per radian of z
    exponent: Exponents  # (m,)
    zone: tuple[tuple[int, float, float], ...]  # nearest zone of every mode, and the speeds between which it lies
    # of every mode: may the parametric term be neglected, by Book (237) and by solving
    validity: tuple[Validity | None, ...]
    sizing: Sizing | None  # of a drive with one mode and a torque
    without: str = ""  # why there is no sizing

    @property
    def nearest(self) -> int:
        """Place of the mode that stands nearest to one of its zones, in its own width where it has one."""
        far = [abs(np.sqrt(a) - zone) for a, (zone, *_ends) in zip(self.a, self.zone, strict=True)]
        grows = np.asarray(self.exponent.growth)
        return int(np.argmax(grows)) if np.any(grows > 0.0) else int(np.argmin(far))


def mathieu_modes(drive: Drive) -> MathieuModes:
    """Return Mathieu's equation of every torsional mode of a drive at the speed of its duty.

    a = (2ω/(νω_1))², n = ζ √a and q = a times the modulation of `torsion_modes` at its order ν: with ν = 2 the book's
    parameters with its parametric term put right, for any number of inertias, of first order in tan²(α/2), the static
    twist neglected. The sizing of Book (246) is of drives with one mode; the exact torque beside it is harmonic
    balance, see `torsion_response`.
    """
    modes = torsion_modes(drive)
    if not modes.speed:
        raise refuse("duty.speed", _("missing: the speed"), "missing")
    omega = modes.at([modes.speed])[0]
    centre = 2.0 * omega / modes.order
    a = (centre / modes.speed) ** 2
    told = np.flatnonzero(np.isfinite(a) & (a < LARGEST_A))
    if not told.size:
        raise refuse("duty.speed", _("so slow that no mode is within what Mathieu's equation can be solved for"))
    a = a[told]
    q, n = a * modes.modulation[told], modes.damping_ratio[told] * np.sqrt(a)
    zone = np.maximum(1, np.rint(np.sqrt(a))).astype(int).tolist()
    ends = [zone_speeds(float(centre[k]), float(modes.modulation[k]), z) for k, z in zip(told, zone, strict=True)]
    orders = sorted({0.0, JOINTS, *(one.order for one in modes.crossings)})
    sizing, without = _sizing(drive, modes)
    return MathieuModes(
        speed=modes.speed,
        modes=modes,
        number=told + 1,
        order=modes.order[told],
        a=a,
        q=q,
        damping=n,
        exponent=exponents(a, q, n),
        zone=tuple((z, *sorted(pair)) for z, pair in zip(zone, ends, strict=True)),
        validity=tuple(
            _valid(float(one), float(two), [order * JOINTS / own for order in orders])
            for one, two, own in zip(a, q, modes.order[told].tolist(), strict=True)
        ),
        sizing=sizing,
        without=without,
    )


def _valid(a: float, q: float, orders: list[float]) -> Validity | None:
    try:
        return validity(a, q, orders)
    except InputError:
        return None


def _sizing(drive: Drive, modes: TorsionModes) -> tuple[Sizing | None, str]:
    """Return the torque of the last shaft by the book's method, or why it does not apply."""
    model, duty = modes.train.model, drive.duty
    if len(modes.omega) != 1:
        text = _("The book's method for sizing is of two inertias and one mode; this drive has {count} modes.")
        return None, text.format(count=len(modes.omega))
    if model.sums is not None:
        return None, _("The book's method for sizing is of cross joints, which excite order 2 alone.")
    if duty.torque is None:
        return None, _("The book's method for sizing needs a torque, duty.torque.")
    behind = np.asarray(model.shaft) > 0
    shape = modes.shape[0]
    # Two inertias that swing against each other: J_1 and J_2 turn by shares of the twist, none of a driven input.
    last = float(np.sum((model.inertia * shape)[shape > 0.0]) / np.max(shape))
    first = float(-np.sum((model.inertia * shape)[shape < 0.0]) / -np.min(shape)) if np.min(shape) < 0.0 else np.inf
    if float(np.mean(shape[behind])) < 0.0:
        first, last = last, first
    inertia = last if np.isinf(first) else first * last / (first + last)
    tau = np.tan(0.5 * model.joint_angle) ** 2
    turned = np.concatenate(([0.0], np.cumsum(tau * np.sin(2.0 * model.phase))[:-1]))
    sway = abs(complex(np.sum(tau * np.exp(2j * (model.phase - turned)))))
    ends = _swinging(model, np.abs(shape), (shape > 0.0) == (float(np.mean(shape[behind])) > 0.0))
    try:
        book = engineering_torque(
            stiffness=float(modes.omega[0]) ** 2 * inertia,
            amplitude=sway,
            a=float(modes.omega[0] / modes.speed) ** 2,
            first_inertia=min(first, 1e12 * last),
            last_inertia=last,
            mean=duty.torque,
            drive_order=[order for order, _torque in ends[0]],
            drive_torque=[torque for _order, torque in ends[0]],
            load_order=[order for order, _torque in ends[1]],
            load_torque=[torque for _order, torque in ends[1]],
        )
        exact = dynamic_torque(drive, speed=[modes.speed])
        extremes = np.abs([exact.low[0, -1], exact.high[0, -1]]) if exact.found[0] else np.asarray([np.nan])
    except InputError as error:
        return None, error.problems[0].message
    most = book.mean + book.order2 + float(np.sum(book.drive)) + float(np.sum(book.load))
    return Sizing(book=book, most=most, exact=float(np.max(extremes))), ""


def _swinging(model: TorsionalModel, size: Array, driven: Array) -> tuple[list[tuple[float, float]], ...]:
    """Return orders and amplitudes [N·m] of the torques that swing, of the engine, machines and duty, at either end.

    size (N,): amplitude of every station in the only mode; driven (N,) of bool: whether it turns with the last inertia.
    Between the ends a torque counts by the work that it does: by the amplitude of its station over that of its end.
    """
    found: tuple[list[tuple[float, float]], ...] = ([], [])
    for one in model.torques:
        if isinstance(one.law, Swinging) and size[one.station] > 0.0:
            side = bool(driven[one.station])
            share = float(size[one.station] / np.max(size[driven == side]))
            found[side].append((abs(one.law.frequency), share * float(np.max(np.abs(one.law.amplitude)))))
    return found
