"""How well must the shafts of a drive be balanced, how well are they, and what mass where puts it right?"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.catalogue import Catalogue, catalogue, filled
from cardan.catalogue.rows import BalanceGrade, BalanceNorm
from cardan.drive.body import body_length, weight
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.parts import known_lengths
from cardan.drive.shaft import Shaft
from cardan.drive.yokes import with_yokes
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, floats
from cardan.maths.ties import foremost_of, in_a_turn, summed
from cardan.texts import _
from cardan.units import rpm

LEAST, BETWEEN, OUTSIDE = 0.3, 0.7, 1.3
"""Shares of the permissible unbalance in a tolerance plane, ISO 21940-11: the least; the most where the centre of mass
lies between the planes, and where it lies outside."""

ROUNDING = 1e-9
"""Share of what is allowed by which rounding may exceed it."""

USUAL = "G16"
"""Grade for universal-joint shafts where the duty names none, ISO 21940-11."""


@dataclass(frozen=True, kw_only=True)
class Correction:
    """Mass that cancels unbalance in a plane."""

    position: float  # [m]: of the plane, along the power flow from the joint before
    unbalance: float  # [kg m]
    # [rad]: about the axis along the power flow, from the driving yoke: where the mass goes; nan where none does
    angle: float
    mass: float  # [kg]: at the outer radius of the shaft; nan where that is not known


@dataclass(frozen=True, kw_only=True)
class PlaneBalance:
    """Unbalance of a shaft in one of its tolerance planes."""

    position: float  # [m]: of the plane, along the power flow from the joint before; nan where the length is not known
    allowed: float  # [kg m]: permissible residual unbalance of the plane; nan where it is not known
    unbalance: float  # [kg m]: what was measured, resolved into the two planes; nan where none was measured

    @property
    def utilisation(self) -> float:
        """Unbalance over what is allowed."""
        return self.unbalance / self.allowed


@dataclass(frozen=True, kw_only=True)
class ShaftBalance:
    """Balance of a shaft between two joints; nan where the drive does not say enough."""

    number: int
    mass: float  # [kg]
    allowed: float  # [kg m]: unbalance of the whole shaft that the grade allows
    eccentricity: float  # [m]: of the centre of mass, that the grade allows
    norm: float  # [kg m]: upper limit of the book's norm, for the whole shaft
    unbalance: float  # [kg m]: static part of what was measured, the resultant; nan where none was measured
    couple: float  # [kg m²]: couple part, the moment of what was measured about the centre of mass
    # [N]: of the static part at the highest speed, turning with the shaft; of what the grade allows where none was
    # measured
    force: float
    joint_forces: tuple[float, ...] = ()  # [N]: turning forces on the joints at both ends of what was measured
    planes: tuple[PlaneBalance, ...] = ()  # the tolerance planes, and what was measured there
    corrections: tuple[Correction, ...] = ()  # masses at both ends of the tube that cancel what was measured
    missing: tuple[str, ...] = ()  # paths of the drive file without which the grade does not tell

    @property
    def limit(self) -> float:
        """The smaller of grade and norm, of the whole shaft [kg m]."""
        return min((one for one in (self.allowed, self.norm) if not math.isnan(one)), default=math.nan)

    @property
    def allowed_plane(self) -> float:
        """Permissible residual unbalance of the tolerance plane that may have least [kg m]."""
        return min(one.allowed for one in self.planes)

    @property
    def worst(self) -> PlaneBalance | None:
        """The tolerance plane with the highest utilisation; None where none was measured or nothing limits it."""
        known = [one for one in self.planes if not math.isnan(one.utilisation)]
        return foremost_of(known, lambda one: one.utilisation) if known else None

    @property
    def balanced(self) -> bool | None:
        """Whether what was measured keeps grade and norm in every plane; None where one is not known."""
        worst = self.worst
        return None if worst is None else worst.unbalance <= worst.allowed * (1.0 + ROUNDING)


@dataclass(frozen=True, kw_only=True)
class Balance:
    """Balance of a drive.

    Attributes
    ----------
    speed : float [rad/s]
        Highest in use.
    grade : BalanceGrade or None
        Grade the shafts are to keep.
    norm : BalanceNorm or None
        Norm of the book.
    shafts : tuple of ShaftBalance
        Those between two joints, and end shafts with measured unbalance.
    needed : bool
        Whether makers balance at this speed at all.
    assumed : bool
        Whether the grade is the usual one, because the duty names none.
    """

    speed: float
    grade: BalanceGrade | None
    norm: BalanceNorm | None
    shafts: tuple[ShaftBalance, ...]
    needed: bool
    assumed: bool

    @property
    def balanced(self) -> bool | None:
        """Whether every shaft that was measured keeps its limit; None where none was."""
        known = [one.balanced for one in self.shafts if one.balanced is not None]
        return all(known) if known else None


def balance(
    drive: Drive, duty: Duty | None = None, *, grade: str | None = None, known: Catalogue | None = None
) -> Balance:
    """Return the unbalance that the shafts of a drive may have, what they have, and what cancels it.

    Parameters
    ----------
    drive : Drive
        With bodies or masses, and measured unbalances where there are any.
    duty : Duty, optional
        Highest speed, balance grade or vehicle; that of the drive by default.
    grade : str, optional
        A balance grade, instead of that of the duty; G16 where there is neither grade nor vehicle.
    known : Catalogue, optional
        The shipped one when not given.

    Returns
    -------
    Balance

    Raises
    ------
    InputError
        No speed; a grade or vehicle that the catalogue does not have.

    See Also
    --------
    rotor_response, bending_speeds

    Notes
    -----
    ISO 21940-11: e Ω = G, U = m e, split between the tolerance planes at both ends of the shaft by the place of the
    centre of mass, each getting 0.3 to 0.7 of it (up to 1.3 where the centre of mass lies outside). Vectors of
    unbalance u_j at x_j are the same as Σ u_j (b - x_j)/(b - a) in plane a and Σ u_j (x_j - a)/(b - a) in plane b: each
    is judged, as static and couple part add up in one plane and cancel in the other; the opposite cancels them.
    The book's norm of a vehicle is split the same way.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, balance
    >>> from cardan.parts import Duty, Shaft
    >>> from cardan.units import rpm
    >>> tube = Shaft(number=2, mass=10.0, length=1.2)
    >>> drive = replace(Drive.from_angles([0.1, 0.1]), shafts=(tube,))
    >>> found = balance(drive, Duty(speed=3000 * rpm), grade="G16").shafts[0]
    >>> print(f"{1e6 * found.allowed:.0f} g·mm, {found.force:.1f} N")
    509 g·mm, 50.3 N
    """
    rows = known or catalogue()
    whole = filled(drive if duty is None else replace(drive, duty=duty), rows)
    used = whole.duty
    speeds = [abs(one) for case in load_cases(used) for one in (case.speed, *(case.speed_range or ())) if one]
    speeds += [abs(one) for one in (used.speed, *(used.speed_range or ())) if one]
    if not speeds:
        raise refuse("duty.speed", _("missing; the unbalance allowed depends on it"), "missing")
    name = grade or used.balance_grade
    own = used.balance_class
    assumed = not name and not own
    field = "grade" if grade else "duty.balance_grade"
    chosen = rows.row(BalanceGrade, name or USUAL, field=field) if name or assumed else None
    norm = rows.row(BalanceNorm, own, field="duty.balance_class") if own else None
    top = max(speeds)
    lengths = known_lengths(whole)
    shafts = tuple(
        _of_shaft(shaft, lengths.get(shaft.number), chosen, norm, top)
        for k, shaft in enumerate(with_yokes(whole).shafts)
        if 0 < k < len(whole.joints) or shaft.unbalance
    )
    return Balance(speed=top, grade=chosen, norm=norm, shafts=shafts, needed=top >= SLOW, assumed=assumed)


def _of_shaft(
    shaft: Shaft, length: float | None, grade: BalanceGrade | None, norm: BalanceNorm | None, speed: float
) -> ShaftBalance:
    nan = math.nan
    whole = body_length(shaft, length)
    heavy = weight(shaft, whole)
    mass, centre = heavy.mass, heavy.centre
    allowed = eccentricity = nan
    missing: tuple[str, ...] = ()
    if grade is not None and mass:
        found = allowed_unbalance(mass, speed, grade.speed)
        allowed, eccentricity = float(found.whole), float(found.eccentricity)
    elif grade is not None:
        missing = (f"shafts[{shaft.number - 1}].mass",)
    if shaft.unbalance and whole is None:
        missing = (*missing, f"shafts[{shaft.number - 1}].length")
    norm_limit = nan if norm is None else norm.max_unbalance
    limit = min((one for one in (allowed, norm_limit) if not math.isnan(one)), default=nan)
    ends = tolerance_planes(shaft.number, whole)
    vectors = [(one.position, cmath.rect(one.amount, one.angle)) for one in shaft.unbalance]
    places, sizes = (np.asarray([one[k] for one in vectors]) for k in (0, 1))
    there = np.full(2, nan) if ends is None or not vectors else in_planes(ends, places, sizes)
    resultant = abs(complex(summed(sizes)))
    fixes = vectors if ends is None or not vectors else list(zip(ends, map(complex, there), strict=True))
    radius = 0.5 * shaft.outer if shaft.outer is not None else nan
    return ShaftBalance(
        number=shaft.number,
        mass=mass or nan,
        allowed=allowed,
        eccentricity=eccentricity,
        norm=norm_limit,
        unbalance=resultant if vectors else nan,
        couple=abs(complex(summed([*(sizes * places), *(-sizes * centre)]))) if vectors and centre is not None else nan,
        force=speed**2 * (resultant if vectors else limit),
        joint_forces=tuple(speed**2 * abs(vector) for _place, vector in fixes),
        planes=tuple(
            PlaneBalance(position=place, allowed=float(limit * share), unbalance=float(abs(vector)))
            for place, share, vector in zip(ends or (nan, nan), plane_shares(ends, centre), there, strict=True)
        ),
        corrections=tuple(
            Correction(
                position=place,
                unbalance=abs(vector),
                angle=float(in_a_turn(cmath.phase(-vector))) if vector else nan,
                mass=abs(vector) / radius,
            )
            for place, vector in fixes
        ),
        missing=missing,
    )


# Tolerance planes of a shaft: where they are, their shares of what is allowed, and what is there.


def tolerance_planes(number: int, length: Any) -> tuple[Any, Any] | None:
    """Return where the tolerance planes of a shaft are, at its ends (...) [m]; None where its length is not known.

    number: of the shaft; on the first one places count from its end.
    """
    if length is None:
        return None
    return (-length, 0.0) if number == 1 else (0.0, length)


def plane_shares(ends: tuple[Any, Any] | None, centre: Any) -> Array:
    """Return the shares of the permissible unbalance in the tolerance planes, array (..., 2).

    ends (...) [m]: places of the planes, halves where None; centre (...) [m]: of mass; amid the planes where None.
    ISO 21940-11: in inverse proportion to the distances of the centre of mass; not below 0.3, and not above 0.7 where
    it lies between the planes, 1.3 where it lies outside.

    >>> plane_shares((0.0, 1.0), 0.4).tolist(), plane_shares((0.0, 1.0), 0.1).tolist()
    ([0.6, 0.4], [0.7, 0.3])
    """
    if ends is None:
        return np.full(2, 0.5)
    first, last = floats(*ends)
    behind = np.full_like(last - first, 0.5) if centre is None else (np.asarray(centre) - first) / (last - first)
    most = np.where((behind >= 0.0) & (behind <= 1.0), BETWEEN, OUTSIDE)
    return np.stack([np.clip(np.abs(share), LEAST, most) for share in (1.0 - behind, behind)], axis=-1)


def in_planes(ends: tuple[Any, Any], places: Array, vectors: Array) -> Array:
    """Return what unbalances are together in the tolerance planes, complex array (..., 2).

    ends (...) [m]: places of the planes; places (..., u) [m], vectors (..., u) [kg m], complex: the unbalances.

    >>> in_planes((0.0, 2.0), np.array([0.5, 1.0]), np.array([4.0, 2.0j])).tolist()
    [(3+1j), (1+1j)]
    """
    first, last = (np.asarray(one, dtype=float)[..., None] for one in ends)
    sizes, behind = np.broadcast_arrays(vectors, (places - first) / (last - first))
    passed = sizes * behind
    return np.stack([summed(np.concatenate([sizes, -passed], axis=-1)), summed(passed)], axis=-1)


# Balance of shafts: the unbalance that a grade allows, and the force it leaves.

SLOW = 500.0 * rpm
"""Speed below which makers do not balance [rad/s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AllowedUnbalance:
    """Unbalance that a balance grade allows, arrays (...)."""

    whole: Array  # (...) [kg m]: U of the shaft
    plane: Array  # (...) [kg m]: half of it, for each of the two planes of a symmetrical shaft
    eccentricity: Array  # (...) [m]: e of the centre of mass
    force: Array  # (...) [N]: U Ω², which turns with the shaft


def allowed_unbalance(mass: ArrayLike, speed: ArrayLike, grade: ArrayLike) -> AllowedUnbalance:
    """Return the unbalance that a balance grade allows, ISO 21940-11: e Ω = G.

    mass (...) [kg]; speed (...) [rad/s]: Ω, the highest in use.
    grade (...) [m/s]: G; 0.016 for G16.

    >>> round(float(allowed_unbalance(10.0, 3000 * 3.141592653589793 / 30, 0.016).whole) * 1e6, 1)
    509.3
    """
    mass, speed, grade = floats(mass, speed, grade)
    eccentricity = grade / speed
    whole = mass * eccentricity
    return AllowedUnbalance(whole=whole, plane=0.5 * whole, eccentricity=eccentricity, force=whole * speed**2)
