"""Strength and stiffness of a shaft: stresses of torsion and bending, the diameter that carries a torque, the twist."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from cardan.drive.material import Material
from cardan.drive.shaft import Bond, Layup
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.linear.laminate import laminate_moduli, ply_stresses
from cardan.texts import _
from cardan.units import mm

RATED_TWIST = math.radians(9.0)
"""Largest twist of a drive's shafts by the book, p. 228 [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ShaftStress:
    """Stresses at the surface of a round shaft, arrays (...) [Pa]."""

    torsion: Array  # (...): τ = T/W_t
    bending: Array  # (...): σ = 2 M/W_t
    shear: Array  # (...): largest shear stress √(T² + M²)/W_t, that of Tresca
    mises: Array  # (...): √(σ² + 3τ²)


def torsion_modulus(outer: ArrayLike, inner: ArrayLike = 0.0) -> Array:
    """Return W_t = π(D⁴ - d⁴)/(16 D) of a round section [m³].

    outer, inner (...) [m].

    >>> round(float(torsion_modulus(0.075, 0.070)) * 1e9, 1)
    19976.9
    """
    outer, inner = floats(outer, inner)
    return math.pi * (outer**4 - inner**4) / (16.0 * outer)


def polar_moment(outer: ArrayLike, inner: ArrayLike = 0.0) -> Array:
    """Return J = π(D⁴ - d⁴)/32 of a round section [m⁴]."""
    outer, inner = floats(outer, inner)
    return math.pi * (outer**4 - inner**4) / 32.0


def shaft_stress(torque: ArrayLike, bending: ArrayLike, outer: ArrayLike, inner: ArrayLike = 0.0) -> ShaftStress:
    """Return the stresses of a round shaft under torque and bending, Book (261).

    Parameters
    ----------
    torque, bending : array (...) [N·m]
        T and M_b, dynamic loads included.
    outer, inner : array (...) [m]
        D and d, 0 ≤ d < D.

    Examples
    --------
    >>> round(float(shaft_stress(2000.0, 350.0, 0.075, 0.070).shear) / 1e6, 3)
    101.637
    """
    torque, bending = floats(torque, bending)
    xp = namespace(torque, bending)
    modulus = torsion_modulus(outer, inner)
    tau, sigma = torque / modulus, 2.0 * bending / modulus
    return ShaftStress(
        torsion=tau,
        bending=sigma,
        shear=xp.sqrt(torque**2 + bending**2) / modulus,
        mises=xp.sqrt(sigma**2 + 3.0 * tau**2),
    )


def shaft_diameter(torque: ArrayLike, shear_stress: ArrayLike, bore_ratio: ArrayLike = 0.0) -> Array:
    """Return the outer diameter that carries a torque, D = [16 T/(π [τ] (1 - k⁴))]^(1/3) [m].

    Parameters
    ----------
    torque : array (...) [N·m]
        T, with the bending moment √(T² + M²).
    shear_stress : array (...) [Pa]
        Largest shear stress allowed.
    bore_ratio : array (...)
        k = d/D, 0 ≤ k < 1.

    Examples
    --------
    >>> round(float(shaft_diameter(946.6875, 323.73e6)) * 1e3, 3)
    24.604
    """
    torque, shear_stress, ratio = floats(torque, shear_stress, bore_ratio)
    return (16.0 * torque / (math.pi * shear_stress * (1.0 - ratio**4))) ** (1.0 / 3.0)


def shaft_twist(
    torque: ArrayLike, shear_modulus: ArrayLike, length: ArrayLike, outer: ArrayLike, inner: ArrayLike = 0.0
) -> Array:
    """Return the twist of a stepped shaft, Σ T l_i/(G J_i) [rad].

    Parameters
    ----------
    torque : array (...) [N·m]
        Sign kept.
    shear_modulus : array (...) or (..., k) [Pa]
    length, outer, inner : array (..., k) [m]
        Of its segments.

    Notes
    -----
    Book (262) puts the combined moment of torsion and bending here; only the torque twists a shaft.

    Examples
    --------
    >>> round(math.degrees(shaft_twist(2000.0, 80e9, [1.5], [0.075], [0.070])), 4)
    2.8681
    """
    torque, shear_modulus, length = floats(torque, shear_modulus, length)
    xp = namespace(length, torque)
    flexible = length / (polar_moment(outer, inner) * shear_modulus)
    return torque * xp.sum(flexible, axis=-1)


def wall_buckling_torque(outer: ArrayLike, inner: ArrayLike, youngs: ArrayLike, poisson: ArrayLike = 0.3) -> Array:
    """Return the torque at which the wall of a long tube buckles, T = 2π r² t τ [N·m].

    outer, inner (...) [m]: D and d; for walls that are thin beside the radius.
    youngs, poisson (...) [Pa, -]: E and ν.
    τ = E (t/r)^(3/2)/(3√2 (1 - ν²)^(3/4)), r the mean radius: Timoshenko and Gere, Theory of elastic stability, 11.11,
    after Schwerin; 0.253 E (t/r)^(3/2) for ν = 0.3. Ends that are held close together hold more.

    >>> round(float(wall_buckling_torque(0.076, 0.072, 2.06e11)))
    11267
    """
    outer, inner, youngs, poisson = floats(outer, inner, youngs, poisson)
    radius, wall = 0.25 * (outer + inner), 0.5 * (outer - inner)
    stress = youngs * (wall / radius) ** 1.5 / (3.0 * math.sqrt(2.0) * (1.0 - poisson**2) ** 0.75)
    return 2.0 * math.pi * radius**2 * wall * stress


# Fatigue of a shaft under swinging torque and the bending that turns with it: Marin's factors and Goodman's line.

MPA = 1e6

FINISHES = {
    "ground": (1.58, -0.085),
    "machined": (4.51, -0.265),
    "hot_rolled": (57.7, -0.718),
    "forged": (272.0, -0.995),
}
"""Surface factor k_a = a S_ut^b, S_ut in MPa: Shigley, table 6-2."""

RELIABILITIES = {0.5: 1.0, 0.9: 0.897, 0.95: 0.868, 0.99: 0.814, 0.999: 0.753, 0.9999: 0.702, 0.99999: 0.659}
"""Reliability factor k_e: Shigley, table 6-5."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Fatigue:
    """Fatigue of a shaft, arrays (...)."""

    endurance: Array  # (...) [Pa]: S_e, fatigue limit of the part
    alternating: Array  # alternating, mean (...) [Pa]: equivalent stresses by von Mises
    mean: Array  # (...) [Pa]
    safety: Array  # (...): against fatigue, by Goodman
    yield_safety: Array  # (...): against yielding in the first cycle
    # (...): life; infinite where the safety is 1 and more, 0 where the mean stress alone breaks the shaft
    cycles: Array


def reliability_factor(reliability: float) -> float:
    """Return k_e, straight over the normal quantile between the values of the table.

    reliability: share of parts that last, from 0.5 to 0.99999.

    >>> reliability_factor(0.99), round(reliability_factor(0.98), 3)
    (0.814, 0.836)
    """
    if reliability in RELIABILITIES:
        return RELIABILITIES[reliability]
    places = [NormalDist().inv_cdf(share) for share in RELIABILITIES]
    factors = list(RELIABILITIES.values())
    at = NormalDist().inv_cdf(reliability)
    right = next((k for k, place in enumerate(places) if place >= at), len(places) - 1)
    left = max(right - 1, 0)
    share = (at - places[left]) / (places[right] - places[left])
    return factors[left] + share * (factors[right] - factors[left])


def shaft_fatigue(
    *,
    mean_torque: ArrayLike,
    swinging_torque: ArrayLike,
    mean_bending: ArrayLike,
    swinging_bending: ArrayLike,
    outer: ArrayLike,
    inner: ArrayLike,
    ultimate: ArrayLike,
    yield_strength: ArrayLike,
    finish: str,
    bending_notch: ArrayLike = 1.0,
    torsion_notch: ArrayLike = 1.0,
    reliability: float = 0.9,
) -> Fatigue:
    """Return the fatigue of a round shaft; a secondary couple turns with the shaft and swings fully.

    Parameters
    ----------
    mean_torque, swinging_torque, mean_bending, swinging_bending : array (...) [N·m]
        T_m, T_a, M_m, M_a.
    outer, inner : array (...) [m]
    ultimate, yield_strength : array (...) [Pa]
        S_ut ≥ S_y.
    finish : str
        Key of `FINISHES`.
    bending_notch, torsion_notch : array (...)
        K_f and K_fs.
    reliability : float
        Share of parts that last.

    Notes
    -----
    S_e = k_a k_b k_e min(0.5 S_ut, 700 MPa); k_b = 1 below 2.79 mm, 1.24 d^-0.107 up to 51 mm, 1.51 d^-0.157 above.
    Goodman: n = 1/(σ_a/S_e + σ_m/S_ut). Below 1 the life is (σ_r/A)^(1/B), σ_r = σ_a/(1 - σ_m/S_ut),
    A = (0.9 S_ut)²/S_e, B = -⅓ lg(0.9 S_ut/S_e). Sources: Shigley, chapter 6.

    Examples
    --------
    >>> one = shaft_fatigue(mean_torque=2000.0, swinging_torque=600.0, mean_bending=0.0, swinging_bending=350.0,
    ...     outer=0.075, inner=0.070, ultimate=410e6, yield_strength=245e6, finish="hot_rolled",
    ...     bending_notch=1.3, torsion_notch=1.2)
    >>> round(float(one.safety), 4), round(float(one.cycles))
    (0.8186, 123411)
    """
    t_mean, t_swing, m_mean, m_swing = floats(mean_torque, swinging_torque, mean_bending, swinging_bending)
    outer, ultimate, strength, kf, kfs = floats(outer, ultimate, yield_strength, bending_notch, torsion_notch)
    xp = namespace(outer)
    modulus = torsion_modulus(outer, inner)
    scale, exponent = FINISHES[finish]
    wide = outer / mm
    size = xp.where(wide <= 51.0, 1.24 * wide**-0.107, 1.51 * wide**-0.157)
    size = xp.where(wide < 2.79, 1.0, size)
    surface = xp.minimum(scale * (ultimate / MPA) ** exponent, 0.0 * ultimate + 1.0)
    endurance = surface * size * reliability_factor(reliability) * xp.minimum(0.5 * ultimate, 0.0 * ultimate + 700e6)
    joint_angle_swing, joint_angle_mean = 2.0 * m_swing / modulus, 2.0 * m_mean / modulus
    twist_swing, twist_mean = t_swing / modulus, t_mean / modulus
    alternating = xp.sqrt((kf * joint_angle_swing) ** 2 + 3.0 * (kfs * twist_swing) ** 2)
    mean = xp.sqrt((kf * joint_angle_mean) ** 2 + 3.0 * (kfs * twist_mean) ** 2)
    use = alternating / endurance + mean / ultimate
    most = xp.sqrt(
        (kf * (xp.abs(joint_angle_mean) + joint_angle_swing)) ** 2
        + 3.0 * (kfs * (xp.abs(twist_mean) + twist_swing)) ** 2
    )
    cycles = fatigue_cycles(alternating, mean, endurance, ultimate)
    unloaded = xp.where(use > 0.0, use, 1.0)
    stressed = xp.where(most > 0.0, most, 1.0)
    return Fatigue(
        endurance=endurance,
        alternating=alternating,
        mean=mean,
        safety=xp.where(use > 0.0, 1.0 / unloaded, math.inf),
        yield_safety=xp.where(most > 0.0, strength / stressed, math.inf),
        cycles=cycles,
    )


def fatigue_cycles(alternating: ArrayLike, mean: ArrayLike, endurance: ArrayLike, ultimate: ArrayLike) -> Array:
    """Return the cycles that a part lasts, infinite where Goodman's safety is 1 and more, array (...).

    alternating, mean, endurance, ultimate (...) [Pa]: σ_a, σ_m, S_e, S_ut; see `shaft_fatigue`.

    >>> round(float(fatigue_cycles(300e6, 0.0, 200e6, 600e6)))
    59613
    """
    swing, steady, limit, strength = floats(alternating, mean, endurance, ultimate)
    xp = namespace(swing, steady)
    level = 0.9 * strength / limit
    slope = -xp.log10(level) / 3.0
    rest = xp.where(steady < strength, 1.0 - steady / strength, 1.0)
    reversed_stress = xp.where(swing > 0.0, swing, 1.0) / rest
    cycles = (reversed_stress / (level * 0.9 * strength)) ** (1.0 / slope)
    use = swing / limit + steady / strength
    return xp.where(use <= 1.0, math.inf, xp.where(steady >= strength, 0.0, cycles))


# Tube of fibre composite: its moduli, mass and the torque at which it buckles.


@dataclass(frozen=True, kw_only=True)
class CompositeTube:
    """Figures of a thin tube of composite."""

    along: float  # along, around, shear [Pa]: E_x along the axis, E_y around it, G_xy
    around: float  # [Pa]
    shear: float  # [Pa]
    thickness: float  # [m]: of the wall
    mass_per_length: float  # [kg/m]
    buckling_torque: float  # [N·m]: torque at which the wall buckles


def composite_tube(layup: Layup, mean_diameter: float) -> CompositeTube:
    """Return the figures of a tube of composite.

    Parameters
    ----------
    layup : Layup
    mean_diameter : float [m]
        Of the middle of the wall.

    Notes
    -----
    T_b = 2π r² t·0.272 (E_x E_y³)^(1/4) (t/r)^(3/2); 0.272 is a figure of the literature, the classical one of an
    isotropic tube is 0.253. Only stiffness; the strength of the plies is `ply_exposure`.

    Examples
    --------
    >>> from cardan.parts import Ply
    >>> ply = Ply(along=135e9, across=10e9, shear=5e9, poisson=0.3)
    >>> layup = Layup(angles=(0.0, math.pi / 4, -math.pi / 4, math.pi / 2), ply_thickness=0.0005, ply=ply)
    >>> round(composite_tube(layup, 0.09).buckling_torque, 1)
    3398.4
    """
    plies = len(layup.angles)
    thickness = plies * layup.ply_thickness
    along, around, shear = laminate_moduli(layup.angles, [layup.ply_thickness] * plies, layup.ply.stiffness)
    radius = 0.5 * mean_diameter
    buckling = 2.0 * math.pi * radius**2 * thickness * 0.272 * (along * around**3) ** 0.25 * (thickness / radius) ** 1.5
    return CompositeTube(
        along=float(along),
        around=float(around),
        shear=float(shear),
        thickness=thickness,
        mass_per_length=2.0 * math.pi * radius * thickness * layup.ply.density,
        buckling_torque=float(buckling),
    )


PLY_STRENGTHS = ("tension_along", "compression_along", "tension_across", "compression_across", "shear_strength")
"""Fields of a ply that its strength needs."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PlyExposure:
    """How much of their strength the plies of a tube use, arrays (...)."""

    exposure: Array  # (...): of the ply that is worst off, 1 where it fails by Tsai and Wu
    ply: Array  # (...) of int: which one that is, from 1 at the inside
    shear: Array  # (...) [Pa]: largest shear stress along the fibres in any ply


def ply_exposure(
    layup: Layup, mean_diameter: ArrayLike, ply_thickness: ArrayLike, torque: ArrayLike, bending: ArrayLike = 0.0
) -> PlyExposure:
    """Return how much of their strength the plies of a thin tube use under torque and a bending moment.

    layup: its angles and the figures of its ply, strengths included.
    mean_diameter, ply_thickness (...) [m]: of the middle of the wall, of a ply.
    torque, bending (...) [N·m]: either way round: the tube turns under the moment, and the torque may be that of
    coasting.

    N_xy = T/(2πr²), N_x = ±M/(πr²); stresses of each ply by classical laminate theory, `ply_stresses`. Tsai and Wu
    (1971): F_1 σ_1 + F_2 σ_2 + F_11 σ_1² + F_22 σ_2² + F_66 τ² + 2 F_12 σ_1 σ_2 = 1 with F_12 = -½√(F_11 F_22); the
    exposure is the inverse of the factor by which the loads grow until then. The ends of the tube are left out.
    """
    strength = {name: getattr(layup.ply, name) for name in PLY_STRENGTHS}
    lacking = [name for name, value in strength.items() if value is None]
    check(Problem(f"layup.ply.{name}", _("missing: the strength of the ply"), "missing") for name in lacking)
    first, second, third, fourth, fifth = strength.values()
    unit = ply_stresses(layup.angles, np.ones(len(layup.angles)), layup.ply.stiffness)
    radius, thin, twist, bent = np.broadcast_arrays(0.5 * np.asarray(mean_diameter), ply_thickness, torque, bending)
    across = twist / (2.0 * np.pi * radius**2 * thin)
    along = bent / (np.pi * radius**2 * thin)
    exposure, shear = [], []
    f11, f22, f66 = 1.0 / (first * second), 1.0 / (third * fourth), 1.0 / fifth**2
    f1, f2, f12 = 1.0 / first - 1.0 / second, 1.0 / third - 1.0 / fourth, -0.5 * math.sqrt(f11 * f22)
    for way in (1.0, -1.0):
        for side in (1.0, -1.0):
            one, two, tau = np.moveaxis(
                side * along[..., None, None] * unit[:, :, 0] + way * across[..., None, None] * unit[:, :, 2], -1, 0
            )
            square = f11 * one**2 + f22 * two**2 + f66 * tau**2 + 2.0 * f12 * one * two
            straight = f1 * one + f2 * two
            exposure.append(0.5 * (straight + np.sqrt(straight**2 + 4.0 * square)))
            shear.append(np.abs(tau))
    most: Array = np.max(exposure, axis=0)
    return PlyExposure(
        exposure=np.max(most, axis=-1), ply=np.argmax(most, axis=-1) + 1, shear=np.max(shear, axis=(0, -1))
    )


def bond_shear(bond: Bond, layup: Layup, outer: ArrayLike, ply_thickness: ArrayLike, torque: ArrayLike) -> Array:
    """Return the largest shear stress in the bond between a composite tube and the metal end in it, array (...) [Pa].

    outer, ply_thickness (...) [m]: outer diameter of the tube, thickness of a ply; torque (...) [N·m].
    Lap of two tubes twisted against each other (Volkersen's model in torsion, Adams and Peppiatt 1977): with the
    torsional stiffness k_1 of the tube and k_2 of the steel end, β² = 2πa³ G_a/t_a (1/k_1 + 1/k_2), the stress at the
    end from which the part with the share s = k/(k_1 + k_2) comes is T β/(2πa²) (s + (1 - s) cosh βL)/sinh βL; the
    larger end counts.
    """
    plies = len(layup.angles)
    _along, _around, shear = laminate_moduli(layup.angles, [layup.ply_thickness] * plies, layup.ply.stiffness)
    wide, thin, load = np.broadcast_arrays(*floats(outer, ply_thickness, torque))
    wall = plies * thin
    inside = 0.5 * wide - wall
    tube = shear * 2.0 * np.pi * (inside + 0.5 * wall) ** 3 * wall
    steel = Material().shear_modulus
    end = np.inf
    if bond.wall is not None:
        end = steel * 0.5 * np.pi * (inside**4 - np.maximum(inside - bond.wall, 0.0) ** 4)
    share = np.where(np.isinf(end), 0.0, tube / (tube + end))
    steep = np.sqrt(2.0 * np.pi * inside**3 * bond.shear / bond.thickness * (1.0 / tube + 1.0 / end))
    less = np.minimum(share, 1.0 - share)
    far = steep * bond.length
    found: Array = load * steep / (2.0 * np.pi * inside**2) * (less / np.sinh(far) + (1.0 - less) / np.tanh(far))
    return found


# Torque a vehicle's shaft must carry: what the engine brings, and what the wheels can pass to the road.


@dataclass(frozen=True, eq=False, kw_only=True)
class DesignTorque:
    """Torques at a shaft, arrays (...) [N·m]."""

    drive: Array  # (...): what the engine brings through the gears
    adhesion: Array | None  # (...): what the wheels can pass on; None where their load, radius or adhesion is not given
    design: Array  # (...): factor for jerks times the smaller one
    by_adhesion: Array  # (...) of bool: whether adhesion is the smaller one


def design_torque(
    engine_torque: ArrayLike,
    *,
    halfshaft: bool,
    gear_ratio: ArrayLike,
    axle_ratio: ArrayLike,
    efficiency: ArrayLike = 1.0,
    split_fraction: ArrayLike = 1.0,
    dynamic_factor: ArrayLike = 1.0,
    wheel_load: ArrayLike | None = None,
    friction: ArrayLike | None = None,
    wheel_radius: ArrayLike | None = None,
) -> DesignTorque:
    """Return the design torque of a propeller shaft or a half-shaft.

    Parameters
    ----------
    engine_torque : array (...) [N·m]
        M_e.
    halfshaft : bool
        Behind the axle's gear; else before it.
    gear_ratio, axle_ratio : array (...)
        i_g and i_0.
    efficiency, split_fraction, dynamic_factor : array (...)
        η, share of the torque that this shaft carries, k_d.
    wheel_load : array (...) [N], optional
        W on the wheels that this shaft drives.
    friction : array (...), optional
        μ of these wheels.
    wheel_radius : array (...) [m], optional
        r.

    Notes
    -----
    Propeller shaft: T = M_e i_g η split, limited by μ W r/i_0; half-shaft: T = M_e i_g i_0 η split, limited by μ W r.

    Examples
    --------
    >>> float(design_torque(162.0, halfshaft=True, gear_ratio=2.75, axle_ratio=4.25, split_fraction=0.5).design)
    946.6875
    """
    torque, gear, axle, efficiency, split, factor = floats(
        engine_torque, gear_ratio, axle_ratio, efficiency, split_fraction, dynamic_factor
    )
    xp = namespace(torque)
    drive = torque * gear * efficiency * split * (axle if halfshaft else 1.0)
    if wheel_load is None or friction is None or wheel_radius is None:
        return DesignTorque(drive=drive, adhesion=None, design=factor * drive, by_adhesion=drive != drive)
    load, grip, radius = floats(wheel_load, friction, wheel_radius)
    adhesion = grip * load * radius / (1.0 if halfshaft else axle)
    smaller = xp.minimum(drive, adhesion)
    return DesignTorque(drive=drive, adhesion=adhesion, design=factor * smaller, by_adhesion=adhesion < drive)


def wheel_load(torque: ArrayLike, friction: ArrayLike, wheel_radius: ArrayLike) -> Array:
    """Return the load on the wheels that a torque at them needs, T/(μ r) [N].

    Examples
    --------
    >>> round(float(wheel_load(946.6875, 0.6, 0.325)), 1)
    4854.8
    """
    torque, friction, wheel_radius = floats(torque, friction, wheel_radius)
    return torque / (friction * wheel_radius)
