"""Cracked and unbalanced shafts."""

from __future__ import annotations

from typing import Any

from cardan.calc.calculation import Formulas, Values
from cardan.errors import Problem, check
from cardan.formulas.unbalance_behind_joint import unbalance_behind_joint
from cardan.questions.bending.cracked_rotor import (
    GRAVITY,
    MOST_POWER,
    SLOWEST,
    Crack,
    CrackedRotor,
    breathing_law,
    crack_section,
    cracked_rotor,
)
from cardan.questions.bending.cracked_shafts import WhirlingShaft, cracked_shafts
from cardan.reading.given import Given, at_least_zero, given, joint_angle, positive, whole, word
from cardan.texts import _

formula = Formulas(__doc__)

LAW = "cos^(2m)(theta/2)"

ORDERS = range(-3, 5)
"""Orders of a cracked rotor that are told."""


def _crack(v: Values) -> Crack:
    return Crack(loss_xi=v.loss_xi, loss_eta=v.loss_eta, breathing=v.breathing_m)


def _shaft(v: Values, number: int) -> WhirlingShaft:
    return WhirlingShaft(
        mass=v[f"M{number}"],
        stiffness=v[f"k{number}"],
        inertia=v[f"J{number}"],
        damping=v[f"c{number}"],
        unbalance_mass=v[f"mu{number}"],
        unbalance_radius=v[f"e{number}"],
    )


_LOSSES = (
    at_least_zero("loss_xi", "share of the stiffness lost along the crack when it is open", below=1.0),
    at_least_zero("loss_eta", "share of the stiffness lost across the crack when it is open", below=1.0),
)


def _power(key: str, **options: Any) -> Given:
    """Declare a power of the law of breathing."""
    return whole(key, "power m of the law of breathing", low=1, high=MOST_POWER, **options)


def _of_both(name: str, first: str, second: str, dimension: str, *, zero: bool = False) -> tuple[Given, ...]:
    kind = at_least_zero if zero else positive
    return tuple(kind(name.format(number), doc, dimension) for number, doc in ((1, first), (2, second)))


_GRAVITY = at_least_zero("gravity_m_s2", "gravity across the shaft", default=GRAVITY)


@formula(
    "section that a straight-fronted crack leaves of a round shaft, and what bending stiffness it takes",
    "article on the cracked shaft (17)-(19)",
    positive("radius_m", "radius of the shaft", axes=(0, 1)),
    at_least_zero("delta", "depth of the crack over the radius", below=2.0, axes=(0, 1)),
    "area_m2 = area: area that remains",
    "centroid_shift_m = shift: from the axis to the centroid, away from the crack",
    "Ix_remaining_m4 = second_x: second moment about the diameter along the crack's edge",
    "Iy_remaining_m4 = second_y: second moment about the diameter across the crack's edge",
    "Ix_centroidal_m4 = second_x_centroid: second moment about the centroid, along the crack's edge",
    "relative_loss_strong = loss_x: share of stiffness lost in bending in the crack's direction",
    "relative_loss_weak = loss_y: share of stiffness lost in bending across it",
)
def _crack_section(v: Values) -> Any:
    return crack_section(v.radius, v.delta)


@formula(
    "how far a crack is open over the turn, as a sum of cosines",
    "article on the cracked shaft (21)",
    _power("m"),
    "a_j: factors of 1, cos θ, cos 2θ …",
)
def _crack_breathing(v: Values) -> Any:
    return breathing_law(v.m)


@formula(
    "orders of the whirling of a cracked, unbalanced shaft at a steady speed, and whether it is stable",
    "exact: banded harmonic balance, monodromy matrix",
    positive("mass_kg", "mass of the disc"),
    at_least_zero("damping_ratio", "damping ratio of the bending"),
    positive("k0_N_per_m", "stiffness of the sound shaft at the disc"),
    *_LOSSES,
    word("breathing", "law of breathing", LAW, default=LAW),
    _power("breathing_m", default=1),
    at_least_zero("unbalance_kgm", "mass times radius of the unbalance", default=0.0),
    given("unbalance_phase_deg", "by which it is ahead of the crack", default=0.0),
    _GRAVITY,
    given("speed_ratio", "speed over the critical one", low=SLOWEST, axes=(0, 1)),
    "speed_rad_s: speed",
    "order_amplitude_complex_m: size of each order; negative ones run backward",
    "spectral_radius: what the worst disturbance is multiplied by in a turn",
    "stable: whether disturbances die away",
    "half_order_unstable = half_order: whether half orders grow",
)
def _cracked_rotor_response(v: Values) -> Any:
    stiffness, mass = v.k0, v.mass
    speed = v.speed_ratio * (stiffness / mass) ** 0.5
    found: CrackedRotor = cracked_rotor(
        mass, stiffness, speed, crack=_crack(v), **v.of("damping_ratio", "unbalance", "unbalance_phase", "gravity")
    )
    text = _("a disturbance neither grows nor dies away here, so there is no steady motion; give some damping")
    check([Problem("speed_ratio", text, "singular")] if found.resonant.any() else [])
    return found, {
        "speed_rad_s": speed,
        "order_amplitude_complex_m": {str(n): found.order_amplitude(n) for n in ORDERS},
    }


@formula(
    "orders of the force of an unbalance on a shaft behind a joint",
    "exact series of the joint",
    joint_angle("alpha_deg", "joint angle of the joint", axes=(0, 1)),
    given("psi_deg", "angle of the driving yoke from the plane of the shafts", default=0.0),
    "force_order_over_meOmega2: size of each order over mass times radius times square of the input speed; "
    "negative ones backward",
)
def _unbalance_behind_joint(v: Values) -> Any:
    found = unbalance_behind_joint(v.alpha, v.psi)
    return dict(zip(map(str, found.order.tolist()), found.size.T, strict=True))


@formula(
    "two unbalanced shafts joined by a Hooke joint, the first cracked: where they are after a time",
    "article on the cracked shaft (6)-(25), restored; integrated with an account of energy",
    joint_angle("alpha_deg", "joint angle of the joint"),
    given("psi_deg", "angle of the driving yoke from the plane of the shafts", default=0.0),
    positive("speed_rad_s", "speed of the motor"),
    _power("breathing_m", default=1),
    *_LOSSES,
    *_of_both("k{}_N_per_m", "stiffness of shaft 1 in bending", "stiffness of shaft 2 in bending", "stiffness"),
    *_of_both("M{}_kg", "mass of disc 1", "mass of disc 2", "mass"),
    *_of_both("mu{}_kg", "mass that unbalances disc 1", "mass that unbalances disc 2", "mass", zero=True),
    *_of_both(
        "e{}_m", "its distance from the axis of shaft 1", "its distance from the axis of shaft 2", "length", zero=True
    ),
    *_of_both("J{}_kgm2", "inertia of disc 1", "inertia of disc 2", "inertia"),
    positive("K1T_Nm_per_rad", "stiffness between motor and disc 1"),
    at_least_zero("C1T_Nms_per_rad", "damping between motor and disc 1"),
    *_of_both("c{}_Ns_per_m", "damping of shaft 1 in bending", "damping of shaft 2 in bending", "damping", zero=True),
    _GRAVITY,
    positive("t_end_s", "how long"),
    "theta1_rad: angle of disc 1",
    "X1_m: disc 1, down",
    "Y1_m: disc 1, 90° ahead in the sense of rotation",
    "X2_m: disc 2, down",
    "Y2_m: disc 2, 90° ahead",
    "theta1_dot_rad_s: speed of disc 1",
    "energy_residual: what the account of energy misses",
)
def _cracked_two_shaft_model(v: Values) -> Any:
    found = cracked_shafts(
        _shaft(v, 1),
        _shaft(v, 2),
        v.alpha,
        v.speed,
        v.t_end,
        crack=_crack(v),
        time=[v.t_end],
        **v.of("gravity", phase="psi", drive_stiffness="K1T", drive_damping="C1T"),
    )
    first, second = found.deflection[-1]
    return found.angle[-1, 0], first.real, first.imag, second.real, second.imag, found.rate[-1, 0], found.residual
