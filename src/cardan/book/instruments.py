"""Instruments of the book: slot cams, friction drives, and the disc and roller that add up a distance."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np

from cardan.maths.arrays import Array, ArrayLike, floats, namespace

# A drum cam with helical slots that shifts two followers along its axis, with friction everywhere.
#
# The cam (3) turns about +z between two end planes z = ±l/2, in a housing that it touches at its rim: at C on one end
# plane, which also takes the axial force, and at D on the other. Followers 2 and 4 touch it at E and F, both at
# (-r_3, 0), and are guided along z; a force P across the radius turns the cam; x points where its weight pulls.

ROUNDS = 200
"""Rounds of the iteration at most; eight to thirty are usual."""

STILL = 4e-15
"""The iteration rests when both reactions change by less than this share."""


class Contact(IntEnum):
    """What became of the reactions of a cam."""

    BOTH_ENDS = 0
    """It touches its housing at both ends, as supposed."""
    FIRST_JAMS = 1
    """The slope of the first slot is not above the angles of friction of contact and guide."""
    SECOND_JAMS = 2
    """The same of the second slot."""
    OTHER = 3
    """No two reactions at the rim hold it: it touches its housing in another way."""
    UNSETTLED = 4
    """The reactions did not come to rest; so near to jamming that a trifle more friction would stop it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SlotCam:
    """A cam with two helical slots, its places and its coefficients of friction; arrays (...) or numbers.

    Attributes
    ----------
    radius : array (...) [m]
        r_3, at which followers, drive and housing touch it.
    length : array (...) [m]
        l, between its end planes.
    weight : array (...) [N]
        G_3.
    first_slope, second_slope : arrays (...) [rad]
        β_2, β_4, of the slots from the generatrix of the cylinder.
    first_place, second_place, drive_place, weight_place : arrays (...) [m]
        z of E, F, of the driving force and of the centre of mass, from the middle of the cam.
    first_friction, second_friction : arrays (...)
        f_E, f_F, between cam and followers.
    first_guide_friction, second_guide_friction : arrays (...)
        f_N, f_S, of the followers in their guides.
    rim_friction, end_friction, far_friction : arrays (...)
        f_C at the rim and f_C' on the plane of the end that is pushed against the housing, f_D at the rim of the other.
    """

    radius: ArrayLike
    length: ArrayLike
    weight: ArrayLike
    first_slope: ArrayLike
    second_slope: ArrayLike
    first_place: ArrayLike
    second_place: ArrayLike
    drive_place: ArrayLike
    weight_place: ArrayLike = 0.0
    first_friction: ArrayLike = 0.0
    second_friction: ArrayLike = 0.0
    first_guide_friction: ArrayLike = 0.0
    second_guide_friction: ArrayLike = 0.0
    rim_friction: ArrayLike = 0.0
    end_friction: ArrayLike = 0.0
    far_friction: ArrayLike = 0.0


@dataclass(frozen=True, eq=False, kw_only=True)
class CamForces:
    """Forces on a slot cam; nan where the status is not `Contact.BOTH_ENDS`, follower forces only where one jams."""

    first: Array  # first, second (...) [N]: R_23 at E and R_43 at F, friction included
    second: Array  # (...) [N]
    drive: Array  # (...) [N]: P, that turns the cam
    end: Array  # (...) [N]: reaction of the end plane
    end_side: Array  # (...): +1 where the end plane at +l/2 is touched, -1 at -l/2
    rim: Array  # rim, far (...) [N]: normal reactions at C, on the rim of that end, and at D, on the other
    far: Array  # (...) [N]
    rim_point: Array  # rim_point, far_point (..., 2) [m]: x, y of C and D
    far_point: Array  # (..., 2) [m]
    rounds: Array  # (...): rounds of the iteration
    # (...): largest of the six sums of forces, and moments over the radius, as a share of the largest force
    imbalance: Array
    status: Array  # (...)


def follower_force(load: ArrayLike, slope: ArrayLike, friction: ArrayLike, guide_friction: ArrayLike) -> Array:
    """Return the force between a slot and a follower that is guided along the cam's axis.

    load (...) [N]: Q along the axis; slope (...) [rad]: β of the slot from the generatrix, to 90°.
    friction, guide_friction (...): coefficients at the slot and in the guide.
    Returns (...) [N]: nan where the follower jams, β ≤ ρ + ρ_N.
    Q cos ρ_N/sin(β - ρ - ρ_N), ρ = arctan f: balance of the follower along and across its guide; stands for Litvin
    (6.159)-(6.166), which are lost.
    """
    q, beta, f, g = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (load, slope, friction, guide_friction)))
    rho, guide = np.arctan(f), np.arctan(g)
    sine = np.sin(beta - rho - guide)
    return q * np.cos(guide) / np.where(beta > rho + guide, sine, np.nan)


def cam_forces(cam: SlotCam, first_load: ArrayLike, second_load: ArrayLike, angle: ArrayLike = 0.0) -> CamForces:
    """Return all forces on a slot cam that turns under the loads of its followers.

    Parameters
    ----------
    cam : SlotCam
    first_load, second_load : arrays (...) [N]
        Q_2, Q_4 along the axis.
    angle : array (...) [rad]
        ψ: the driving force acts at (-r_3 cos ψ, -r_3 sin ψ), in the direction (sin ψ, -cos ψ).

    Returns
    -------
    CamForces

    Notes
    -----
    Litvin (6.173)-(6.182). R_Cm = \\|s_F - s_E\\| and P = c_E + c_F + f_D R_Dn + f_C R_Cn + f_C' R_Cm; from the moments
    about x and y of all forces but those at the rims follow C, by (6.178), and R_Dn, by (6.182). That C lies on the
    rim, (6.180), is a quadratic equation in R_Cn: first with R_Dn = R_Cn, where its largest root counts, then with R_Dn
    as found last, where the root nearest the last one does; in turns with (6.182), until both rest.

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> cam = SlotCam(radius=30 * mm, length=120 * mm, weight=8.0, first_slope=55 * deg, second_slope=60 * deg,
    ...               first_place=-20 * mm, second_place=30 * mm, drive_place=50 * mm, first_friction=0.1,
    ...               second_friction=0.1, first_guide_friction=0.12, second_guide_friction=0.12, rim_friction=0.1,
    ...               end_friction=0.1, far_friction=0.1)
    >>> found = cam_forces(cam, 20.0, 35.0)
    >>> print(found.drive, found.rim, found.far, found.end)
    52.88667512 26.47826979 19.12925812 16.00133154
    """
    values = {name: getattr(cam, name) for name in SlotCam.__dataclass_fields__}
    given = {**values, "Q2": first_load, "Q4": second_load, "psi": angle}
    wide = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in given.values()))
    at = dict(zip(given, wide, strict=True))
    state = _State(at)
    with np.errstate(invalid="ignore", divide="ignore"):
        rim, far, rounds = _reactions(state)
        balance = _Balance(state, rim, far)
        point, other = balance.rim_point(), balance.far_point()
    held = ~np.isnan(rim)
    status = np.where(held, Contact.BOTH_ENDS, np.where(rounds == ROUNDS, Contact.UNSETTLED, Contact.OTHER))
    status = np.where(state.lean[1] <= 0.0, Contact.SECOND_JAMS, status)
    status = np.where(state.lean[0] <= 0.0, Contact.FIRST_JAMS, status)
    return CamForces(
        first=state.first,
        second=state.second,
        drive=balance.drive,
        end=np.where(held, state.end, np.nan),
        end_side=state.side,
        rim=rim,
        far=far,
        rim_point=np.stack(point, axis=-1),
        far_point=np.stack(other, axis=-1),
        rounds=rounds,
        imbalance=_imbalance(state, rim, far, balance.drive, point, other),
        status=status,
    )


class _State:
    """What is known before the reactions at the rims are: loads at the followers and at the end plane."""

    def __init__(self, at: dict[str, Any]) -> None:
        self.at = at
        self.first = follower_force(at["Q2"], at["first_slope"], at["first_friction"], at["first_guide_friction"])
        self.second = follower_force(at["Q4"], at["second_slope"], at["second_friction"], at["second_guide_friction"])
        lean = at["first_slope"] - np.arctan(at["first_friction"])
        other = at["second_slope"] - np.arctan(at["second_friction"])
        self.lean = lean - np.arctan(at["first_guide_friction"]), other - np.arctan(at["second_guide_friction"])
        self.c_e, self.s_e = self.first * np.cos(lean), self.first * np.sin(lean)
        self.c_f, self.s_f = self.second * np.cos(other), self.second * np.sin(other)
        self.side = np.where(self.s_f >= self.s_e, 1.0, -1.0)
        self.end = np.abs(self.s_f - self.s_e)
        self.arm = 2.0 * at["radius"] / at["length"]
        self.sine, self.cosine = np.sin(at["psi"]), np.cos(at["psi"])

    def moments(self, drive: Array) -> tuple[Array, Array, Array, Array]:
        """Return b_1 … b_4 of (6.176) for a driving force."""
        at, s = self.at, self.side * self.arm
        force, turned = drive * self.sine, drive * self.cosine
        r, z = at["radius"], at["drive_place"]
        return (
            r * (at["weight"] + force),
            r * (self.c_e + self.c_f - turned),
            s * (z * turned - at["first_place"] * self.c_e - at["second_place"] * self.c_f),
            s * (r * (self.s_f - self.s_e) + z * force + at["weight_place"] * at["weight"]),
        )


class _Balance:
    """Coefficients of the balance for reactions at the rims."""

    def __init__(self, state: _State, rim: Array, far: Array) -> None:
        at = state.at
        self.radius, self.far_friction = at["radius"], at["far_friction"]
        rub = at["rim_friction"] * rim + at["end_friction"] * state.end
        self.drive = state.c_e + state.c_f + at["far_friction"] * far + rub
        self.b = state.moments(self.drive)
        self.a11, self.a12 = rim, -rub
        self.a41 = rim - state.arm * state.end
        self.a13, self.a14 = far, -at["far_friction"] * far

    def on_rim(self) -> Array:
        """Return by how much (6.180) is missed."""
        b1, b2, b3, b4 = self.b
        size = (self.a11 + self.a41) ** 2 + 4.0 * self.a12**2
        found: Array = size * self.radius**2 - (b1 + b4) ** 2 - (b2 - b3) ** 2
        return found

    def rim_point(self) -> tuple[Array, Array]:
        """Return C, (6.178)."""
        b1, b2, b3, b4 = self.b
        u, w = self.a11 + self.a41, 2.0 * self.a12
        size = u * u + w * w
        size = np.where(size > 0.0, size, np.nan)
        return ((b1 + b4) * u - (b2 - b3) * w) / size, ((b1 + b4) * w + (b2 - b3) * u) / size

    def rest(self) -> tuple[Array, Array]:
        """Return the right sides of (6.179)."""
        x, y = self.rim_point()
        return self.b[2] - self.a12 * x + self.a41 * y, self.b[3] - self.a41 * x - self.a12 * y

    def far(self) -> Array:
        """Return R_Dn, (6.182)."""
        found: Array = np.hypot(*self.rest()) / (self.radius * np.sqrt(1.0 + self.far_friction**2))
        return found

    def far_point(self) -> tuple[Array, Array]:
        """Return D, (6.179)."""
        one, two = self.rest()
        size = self.a13**2 + self.a14**2
        size = np.where(size > 0.0, size, np.nan)
        return -(self.a14 * one + self.a13 * two) / size, (self.a13 * one - self.a14 * two) / size


def _quadratic(state: _State, far: Array, follows: float) -> tuple[Array, Array]:
    """Return both roots of (6.180) in R_Cn, with R_Dn = far + follows · R_Cn; nan where they are not real."""
    size = state.end + state.c_e + state.c_f + far + state.at["weight"]
    # A quadratic through three places; they are of the size of the forces.
    low, middle, high = (_Balance(state, k * size, far + follows * k * size).on_rim() for k in (-1.0, 0.0, 1.0))
    a, b, c = 0.5 * (low + high) - middle, 0.5 * (high - low), middle
    root = np.sqrt(b * b - 4.0 * a * c)
    q = -0.5 * (b + np.where(b < 0.0, -root, root))
    return size * q / a, size * c / q


def _largest(roots: tuple[Array, Array]) -> Array:
    """Return the largest root that is not negative."""
    found: Array = np.fmax(*(np.where(root >= 0.0, root, np.nan) for root in roots))
    return found


def _reactions(state: _State) -> tuple[Array, Array, Array]:
    """Return R_Cn, R_Dn and the rounds it took; nan where there are none."""
    rim = _largest(_quadratic(state, 0.0 * state.end, 1.0))
    far = rim
    alone = _largest(_quadratic(state, 0.0 * state.end, 0.0))
    far = np.where(np.isnan(rim), 0.0 * alone, far)
    rim = np.where(np.isnan(rim), alone, rim)
    rounds = np.zeros(np.shape(rim), dtype=int)
    moving = ~np.isnan(rim)
    for _round in range(ROUNDS):
        before, beside = rim, far
        far = np.where(moving, _Balance(state, rim, far).far(), far)
        one, two = _quadratic(state, far, 0.0)
        nearest = np.where(np.abs(one - before) <= np.abs(two - before), one, two)
        rim = np.where(moving, nearest, rim)
        rounds = rounds + moving
        change = np.fmax(np.abs(rim - before), np.abs(far - beside))
        moving = moving & ~np.isnan(rim) & ~(change <= STILL * (np.abs(rim) + far))
        if not np.any(moving):
            break
    held = (rim >= 0.0) & ~moving
    return np.where(held, rim, np.nan), np.where(held, far, np.nan), rounds


def _imbalance(
    state: _State, rim: Array, far: Array, drive: Array, point: tuple[Array, Array], other: tuple[Array, Array]
) -> Array:
    """Return the largest of the six sums over the largest force, all forces added as vectors."""
    at, r, zero = state.at, state.at["radius"], 0.0 * rim
    (xc, yc), (xd, yd) = point, other
    end = 0.5 * at["length"] * state.side
    rub = at["rim_friction"] * rim + at["end_friction"] * state.end
    fd = at["far_friction"] * far
    loads = (
        ((-r, zero, at["first_place"]), (zero, state.c_e, -state.s_e)),
        ((-r, zero, at["second_place"]), (zero, state.c_f, state.s_f)),
        ((-r * state.cosine, -r * state.sine, at["drive_place"]), (drive * state.sine, -drive * state.cosine, zero)),
        ((zero, zero, at["weight_place"]), (at["weight"], zero, zero)),
        ((xc, yc, end), ((rub * yc - rim * xc) / r, -(rub * xc + rim * yc) / r, -state.side * state.end)),
        ((xd, yd, -end), ((fd * yd - far * xd) / r, -(fd * xd + far * yd) / r, zero)),
    )
    places, forces = (
        np.stack([np.stack(np.broadcast_arrays(*load[k]), axis=-1) for load in loads], axis=-2) for k in (0, 1)
    )
    total = np.sum(forces, axis=-2)
    moment = np.sum(np.cross(places, forces), axis=-2) / np.asarray(r)[..., None]
    largest = np.max(np.linalg.norm(forces, axis=-1), axis=-1)
    missed = np.max(np.abs(np.concatenate((total, moment), axis=-1)), axis=-1)
    return missed / np.where(largest > 0.0, largest, 1.0)


# Disc and roller: a roller on a turning disc adds up its distance from the middle, and differentiates backwards.


def roller_speed(speed: ArrayLike, place: ArrayLike, radius: ArrayLike) -> Array:
    """Return the speed of the roller.

    Parameters
    ----------
    speed : array (...) [rad/s]
        ω_1 of the disc.
    place : array (...) [m]
        ρ of the roller from the middle of the disc, negative on the other side.
    radius : array (...) [m]
        r_2 > 0 of the roller.

    Returns
    -------
    array (...) [rad/s]
        ω_1 ρ/r_2, Litvin (7.4).

    Examples
    --------
    >>> print(roller_speed(10.0, 0.005, 0.02))
    2.5
    """
    omega, rho, size = floats(speed, place, radius)
    return omega * rho / size


def roller_turn(turn: ArrayLike, place: ArrayLike, radius: ArrayLike) -> Array:
    """Return how far the roller has turned, while it moved over the disc.

    Parameters
    ----------
    turn : array (..., p) [rad]
        φ_1 of the disc at some instants.
    place : array (..., p) [m]
        ρ there; between them ρ changes in proportion to φ_1.
    radius : array (...) [m]
        r_2 > 0.

    Returns
    -------
    array (..., p) [rad]
        φ_2 since the first instant.

    Notes
    -----
    ∫ρ dφ_1/r_2 from Litvin (7.4), by trapezoids, which are exact for such a movement.

    Examples
    --------
    >>> print(roller_turn([0.0, 20.0], [0.005, 0.010], 0.02))
    [0.  7.5]
    """
    phi, rho, size = floats(turn, place, radius)
    xp = namespace(phi, rho, size)
    steps = 0.5 * (rho[..., 1:] + rho[..., :-1]) * (phi[..., 1:] - phi[..., :-1]) / size[..., None]
    sums = xp.cumulative_sum(steps, axis=-1) if steps.shape[-1] else steps
    return xp.concat((0.0 * phi[..., :1] + 0.0 * rho[..., :1] + 0.0 * size[..., None], sums), axis=-1)


# Friction drives: how hard two smooth wheels must be pressed together, and at which ratio they turn.


def least_press(torque: ArrayLike, radius: ArrayLike, friction: ArrayLike) -> Array:
    """Return the normal force below which the wheels slip.

    Parameters
    ----------
    torque : array (...) [N·m]
        M on the wheel.
    radius : array (...) [m]
        r of this wheel, positive.
    friction : array (...)
        f_0 > 0 of rest.

    Returns
    -------
    array (...) [N]
        M/(f_0 r), Litvin (7.1).

    Examples
    --------
    >>> print(least_press(0.5, 0.02, 0.15))
    166.66666667
    """
    moment, size, f = floats(torque, radius, friction)
    return moment / (f * size)


def press(torque: ArrayLike, radius: ArrayLike, friction: ArrayLike, safety: ArrayLike = 2.5) -> Array:
    """Return the normal force with which to press the wheels together.

    Parameters
    ----------
    torque : array (...) [N·m]
        M on the wheel.
    radius : array (...) [m]
        r of this wheel, positive.
    friction : array (...)
        f_0 > 0 of rest.
    safety : array (...)
        k, usually 2 to 3: coefficients of friction scatter that much.

    Returns
    -------
    array (...) [N]
        k M/(f_0 r), Litvin (7.2).

    Examples
    --------
    >>> print(press(0.5, 0.02, 0.15))
    416.66666667
    """
    (k,) = floats(safety)
    return k * least_press(torque, radius, friction)


def speed_ratio(driving_radius: ArrayLike, driven_radius: ArrayLike) -> Array:
    """Return ω_1/ω_2 of two cylindrical wheels without slip, in size.

    Parameters
    ----------
    driving_radius, driven_radius : arrays (...) [m]
        r_1, r_2 > 0.

    Returns
    -------
    array (...)
        r_2/r_1, Litvin (7.3); outside contact turns the sense about.

    Examples
    --------
    >>> print(speed_ratio(0.02, 0.05))
    2.5
    """
    one, two = floats(driving_radius, driven_radius)
    return two / one
