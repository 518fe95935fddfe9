"""What of a shaft of a drive decides how it whirls: its lowest mode of bending as one mass on one spring."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from cardan.drive.body import body_length, pieces
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.models.geometry import geometry
from cardan.drive.shaft import Shaft
from cardan.drive.yokes import with_yokes
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .bending import CriticalSpeeds, bending_speeds
from .crack import UNCRACKED, Crack, crack_section
from .shaft_balance import balance

DAMPING = 0.02
"""Damping ratio of bending where nothing says another; measured drives have 0.01 to 0.05."""

MODES = (3, 8)
"""Modes among which that of the shaft is looked for, then looked for again."""

SAMPLES = 200
"""Places of a stretch at which the shape is summed."""


@dataclass(frozen=True, kw_only=True)
class Rotor:
    """A shaft in its lowest mode of bending: a mass on a spring where it bows most."""

    shaft: int
    mass: float  # [kg]: ∫ μφ² dx over the line, φ = 1 where the shaft bows most
    stiffness: float  # [N/m]: mass times the square of the real critical speed
    gravity: float  # [m/s²]: weight across the shaft that pushes the mode, over that mass
    unbalance: float  # [kg·m]: of the mode
    unbalance_angle: float  # [rad]: about the axis, from the driving yoke of the shaft
    crack: Crack  # its losses of stiffness; none for a sound shaft
    crack_angle: float  # [rad]: about the axis, from the driving yoke of the shaft
    damping_ratio: float  # of the mode
    assumed: tuple[str, ...] = ()  # key paths of what the drive does not say

    @property
    def critical(self) -> float:
        """Real critical speed of the sound shaft [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def sag(self) -> float:
        """How far the sound shaft hangs down where it bows most [m]."""
        return self.gravity / self.critical**2

    @property
    def cracked(self) -> bool:
        """Whether it has a crack."""
        return max(self.crack.losses) > 0.0


def rotor(drive: Drive, shaft: int | None = None, *, damping_ratio: float = DAMPING) -> Rotor:
    """Return a shaft of a drive as a mass on a spring, in its lowest mode of bending.

    drive: with a body for each shaft between two joints.
    shaft: number of the shaft; the cracked one when not given, else the one with the largest unbalance, else the one
    whose critical speed is the lowest.
    damping_ratio: ζ of the mode.

    Rayleigh's quotients with the shape φ of `bending_speeds`: mass M = ∫ μφ² dx, stiffness M ω², push of the weight
    g⊥ ∫ μφ dx, unbalance Σ U_j φ(x_j) e^(iχ_j). For a uniform shaft between two joints M is half its mass and the push
    4/π of M g. Losses of a crack count as of this stiffness; those of `depth_ratio` are those of its section, taken
    along the whole shaft as in the paper on cracked shafts, which overstates one crack. Where no unbalance is given,
    the allowed one counts, amid the shaft.
    """
    if not 0.0 <= damping_ratio < 1.0:
        text = _("{value:.6g} is not at least 0 and below 1")
        raise refuse("damping_ratio", text.format(value=damping_ratio), "out_of_range")
    found, chosen, mode = _mode(drive, shaft)
    shape = found.deflection[mode]
    begin, end = (float(one) for one in found.shaft_span[chosen.number - 1])
    inside = (found.place >= begin - 1e-9) & (found.place <= end + 1e-9)
    shape = shape / shape[inside][int(np.argmax(np.abs(shape[inside])))]
    mass, push = _summed(drive, found, shape)
    if mass == 0.0:
        text = _("missing; the mass of shaft {number} follows from the lengths of its body")
        raise refuse(f"shafts[{chosen.number - 1}].segments", text.format(number=chosen.number), "missing")
    axis = geometry(drive).axis[chosen.number - 1]
    pull = np.asarray(drive.settings.gravity, dtype=float)
    across = float(np.linalg.norm(pull - np.dot(pull, axis) * axis))
    unbalance, assumed = _unbalance(drive, chosen, found, shape, (begin, end))
    crack, angle = _crack(chosen)
    return Rotor(
        shaft=chosen.number,
        mass=mass,
        stiffness=mass * float(found.actual[mode]) ** 2,
        gravity=across * abs(push) / mass,
        unbalance=abs(unbalance),
        unbalance_angle=cmath.phase(unbalance),
        crack=crack,
        crack_angle=angle,
        damping_ratio=damping_ratio,
        assumed=(*found.assumed, *assumed),
    )


def _mode(drive: Drive, shaft: int | None) -> tuple[CriticalSpeeds, Shaft, int]:
    """Return the modes, the shaft, and the lowest mode in which it bows."""
    for count in MODES:
        found = bending_speeds(drive, modes=count)
        chosen = _chosen(drive, found, shaft)
        for k, one in enumerate(found.part):
            if one.kind == "shaft" and one.number == chosen.number:
                return found, chosen, k
    text = _("shaft {number} does not bend in any of the lowest {count} modes")
    raise refuse("shaft", text.format(number=chosen.number, count=MODES[-1]), "out_of_range")


def _chosen(drive: Drive, found: CriticalSpeeds, number: int | None) -> Shaft:
    if number is not None:
        known = {one.number: one for one in drive.shafts}
        if number not in known:
            text = _("there is no shaft {number}; the drive has {count}")
            raise refuse("shaft", text.format(number=number, count=len(drive.shafts)), "out_of_range")
        if math.isnan(found.shaft_span[number - 1, 0]):
            raise refuse("shaft", _("shaft {number} has no body").format(number=number), "missing")
        return known[number]
    cracked = [one for one in drive.shafts if one.crack is not None]
    unbalanced = [one for one in drive.shafts if one.unbalance]
    if cracked:
        return cracked[0]
    if unbalanced:
        return max(unbalanced, key=lambda one: sum(part.amount for part in one.unbalance))
    lowest = next((one.number for one in found.part if one.kind == "shaft"), 2)
    return next(one for one in drive.shafts if one.number == lowest)


def _summed(drive: Drive, found: CriticalSpeeds, shape: Array) -> tuple[float, float]:
    """Return ∫ μφ² and ∫ μφ over all shafts of the line."""
    lengths = known_lengths(drive)
    mass = push = 0.0
    for one in with_yokes(drive).shafts:
        begin, end = found.shaft_span[one.number - 1]
        if math.isnan(begin):
            continue
        body = pieces(one, body_length(one, lengths.get(one.number)))
        whole = sum(piece.mass for piece in body)
        scale = one.mass / whole if one.mass is not None and whole else 1.0
        for piece in body:
            at = begin + piece.start + piece.length * (np.arange(SAMPLES) + 0.5) / SAMPLES
            phi = np.interp(at, found.place, shape)
            mass += scale * piece.mass * float(np.mean(phi**2))
            push += scale * piece.mass * float(np.mean(phi))
        origin = end if one.number == 1 else begin
        for lump in one.masses:
            phi = float(np.interp(origin + lump.position, found.place, shape))
            mass += lump.mass * phi**2
            push += lump.mass * phi
    return mass, push


def _unbalance(
    drive: Drive, shaft: Shaft, found: CriticalSpeeds, shape: Array, span: tuple[float, float]
) -> tuple[complex, tuple[str, ...]]:
    """Return the unbalance of the mode, and what was assumed for it."""
    if not shaft.unbalance:
        try:
            allowed = next((one.allowed for one in balance(drive).shafts if one.number == shaft.number), math.nan)
        except InputError:
            allowed = math.nan
        return complex(allowed if math.isfinite(allowed) else 0.0), (f"shafts[{shaft.number - 1}].unbalance",)
    origin = span[1] if shaft.number == 1 else span[0]
    parts = (
        one.amount * float(np.interp(origin + one.position, found.place, shape)) * cmath.exp(1j * one.angle)
        for one in shaft.unbalance
    )
    return sum(parts, 0j), ()


def _crack(shaft: Shaft) -> tuple[Crack, float]:
    given = shaft.crack
    if given is None:
        return UNCRACKED, 0.0
    if given.losses:
        xi, eta = given.losses
    else:
        section = crack_section(0.5, given.depth_ratio or 0.0)
        xi, eta = float(section.loss_x), float(section.loss_y)
    return Crack(loss_xi=xi, loss_eta=eta, breathing=given.breathing), given.angle
