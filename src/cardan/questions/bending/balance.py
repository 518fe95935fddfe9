"""How well must the shafts of a drive be balanced, how well are they, and what mass where puts it right?"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace

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
from cardan.texts import _
from cardan.units import rpm

USUAL = "G16"
"""Grade for universal-joint shafts where the duty names none, ISO 21940-11."""


@dataclass(frozen=True, kw_only=True)
class Correction:
    """Mass that cancels unbalance in a plane."""

    position: float  # [m]: of the plane, along the power flow from the joint before
    unbalance: float  # [kg m]
    angle: float  # [rad]: about the axis along the power flow, from the driving yoke: where the mass goes
    mass: float  # [kg]: at the outer radius of the shaft; nan where that is not known


@dataclass(frozen=True, kw_only=True)
class ShaftBalance:
    """Balance of a shaft between two joints; nan where the drive does not say enough."""

    number: int
    mass: float  # [kg]
    allowed: float  # allowed, allowed_plane [kg m]: unbalance that the grade allows: in all, and in each of two planes
    allowed_plane: float  # [kg m]
    eccentricity: float  # [m]: of the centre of mass, that the grade allows
    norm: float  # [kg m]: upper limit of the book's norm
    # [kg m]: what is there: the resultant, or twice that of the worst plane; nan where none was measured
    unbalance: float
    # [N]: of that unbalance at the highest speed, turning with the shaft; of what the grade allows where none was
    # measured
    force: float
    joint_forces: tuple[float, ...] = ()  # [N]: turning forces on the joints at both ends of what was measured
    corrections: tuple[Correction, ...] = ()  # masses at both ends of the tube that cancel what was measured
    missing: tuple[str, ...] = ()  # paths of the drive file without which the grade does not tell

    @property
    def limit(self) -> float:
        """The smaller of grade and norm [kg m]."""
        return min((one for one in (self.allowed, self.norm) if not math.isnan(one)), default=math.nan)

    @property
    def balanced(self) -> bool | None:
        """Whether what was measured keeps grade and norm; None where one is not known."""
        if math.isnan(self.limit) or math.isnan(self.unbalance):
            return None
        return self.unbalance <= self.limit


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
    ISO 21940-11: e Ω = G, half of U = m e for each of two planes. Vectors of unbalance u_j at x_j are the same as
    Σ u_j (b - x_j)/(b - a) in plane a and Σ u_j (x_j - a)/(b - a) in plane b; the opposite cancels them.

    Examples
    --------
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
    mass = weight(shaft, body_length(shaft, length)).mass
    allowed = plane = eccentricity = nan
    missing: tuple[str, ...] = ()
    if grade is not None and mass:
        found = allowed_unbalance(mass, speed, grade.speed)
        allowed, plane, eccentricity = float(found.whole), float(found.plane), float(found.eccentricity)
    elif grade is not None:
        missing = (f"shafts[{shaft.number - 1}].mass",)
    limit = nan if norm is None else norm.max_unbalance
    vectors = [(one.position, cmath.rect(one.amount, one.angle)) for one in shaft.unbalance]
    if not vectors:
        force = speed**2 * min((one for one in (allowed, limit) if not math.isnan(one)), default=nan)
        return ShaftBalance(
            number=shaft.number, mass=mass or nan, allowed=allowed, allowed_plane=plane, eccentricity=eccentricity,
            norm=limit, unbalance=nan, force=force, missing=missing,
        )  # fmt: skip
    resultant = abs(sum(vector for _place, vector in vectors))
    worst = max(abs(vector) for _place, vector in vectors)
    ends = _resolved(vectors, length)
    radius = 0.5 * shaft.outer if shaft.outer is not None else nan
    return ShaftBalance(
        number=shaft.number,
        mass=mass or nan,
        allowed=allowed,
        allowed_plane=plane,
        eccentricity=eccentricity,
        norm=limit,
        unbalance=max(resultant, 2.0 * worst) if len(vectors) > 1 else resultant,
        force=speed**2 * resultant,
        joint_forces=tuple(speed**2 * abs(vector) for _place, vector in ends),
        corrections=tuple(
            Correction(
                position=place,
                unbalance=abs(vector),
                angle=cmath.phase(-vector) % (2.0 * math.pi),
                mass=abs(vector) / radius,
            )
            for place, vector in ends
        ),
        missing=missing,
    )


def _resolved(vectors: list[tuple[float, complex]], length: float | None) -> list[tuple[float, complex]]:
    """Return unbalances put together in the planes at both ends of a shaft; as they are where it has no length."""
    if length is None:
        return vectors
    first = sum(vector * (1.0 - place / length) for place, vector in vectors)
    last = sum(vector * place / length for place, vector in vectors)
    return [(0.0, complex(first)), (length, complex(last))]


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
