"""What should appear: the orders that a fault of a drive makes, how they follow speed and torque, and where."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .fault_orders import MAKERS, Bursts, ExpectedOrder, bursts_of, in_order
from .plant import Plant, plant

FAULTS = {
    "healthy": "",
    "unbalance": "F01",
    "lost_weight": "F01",
    "bent": "F02",
    "joint_angles": "F10",
    "phase": "F11",
    "half_critical": "F12",
    "tight_joint": "F13",
    "critical": "F14",
    "crack": "F15",
    "worn_joint": "F20",
    "worn_spline": "F21",
    "centre_bearing": "F23",
}
"""Fault -> its row of the catalogue; empty for a drive in order."""


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
    >>> from cardan.io import example
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
    lines = [*in_order(wrong, fault, severity), *MAKERS[fault](wrong, severity, chosen)]
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


def _moved(base: Plant, fault: str, severity: float) -> Plant:
    """Return the drive with the critical speed where the fault has it."""
    top = base.speed[1]
    if fault == "half_critical":
        return replace(base, critical=1.6 * top, damping=0.02 / severity)
    if fault == "critical":
        return replace(base, critical=(1.02 + 0.03 / severity) * top)
    return base
