"""Calculations of cracked and unbalanced shafts."""

from __future__ import annotations

from cardan.calc.calculation import Calculation, Given, Values, at_least_zero, given, gives, positive
from cardan.calc.motion.kinematics import RIGHT
from cardan.errors import InputError, Problem, check
from cardan.formulas.unbalance_behind_joint import unbalance_behind_joint
from cardan.questions.bending.crack import MOST_POWER, Crack, breathing_law, crack_section
from cardan.questions.bending.cracked_rotor import GRAVITY, SLOWEST, CrackedRotor, cracked_rotor
from cardan.questions.bending.cracked_shafts import WhirlingShaft, cracked_shafts
from cardan.texts import _, mark

LAW = "cos^(2m)(theta/2)"

ORDERS = range(-3, 5)
"""Orders of a cracked rotor that are told."""


def _section(values: Values) -> Values:
    found = crack_section(values["radius"], values["delta"])
    return {
        "area_m2": found.area,
        "centroid_shift_m": found.shift,
        "Ix_remaining_m4": found.second_x,
        "Iy_remaining_m4": found.second_y,
        "Ix_centroidal_m4": found.second_x_centroid,
        "relative_loss_strong": found.loss_x,
        "relative_loss_weak": found.loss_y,
    }


def _crack(values: Values) -> Crack:
    return Crack(loss_xi=values["loss_xi"], loss_eta=values["loss_eta"], breathing=values["breathing_m"])


def _rotor(values: Values) -> Values:
    stiffness, mass = values["k0"], values["mass"]
    speed = values["speed_ratio"] * (stiffness / mass) ** 0.5
    found: CrackedRotor = cracked_rotor(
        mass,
        stiffness,
        speed,
        crack=_crack(values),
        damping_ratio=values["damping_ratio"],
        unbalance=values["unbalance"],
        unbalance_phase=values["unbalance_phase"],
        gravity=values["gravity"],
    )
    text = _("a disturbance neither grows nor dies away here, so there is no steady motion; give some damping")
    check([Problem("speed_ratio", text, "singular")] if found.resonant.any() else [])
    return {
        "speed_rad_s": speed,
        "order_amplitude_complex_m": {str(n): found.order_amplitude(n) for n in ORDERS},
        "spectral_radius": found.spectral_radius,
        "stable": found.stable,
        "half_order_unstable": found.half_order,
    }


def _behind(values: Values) -> Values:
    found = unbalance_behind_joint(values["alpha"], values["psi"])
    return {"force_order_over_meOmega2": dict(zip(map(str, found.order.tolist()), found.size.T, strict=True))}


def _shaft(values: Values, number: int) -> WhirlingShaft:
    return WhirlingShaft(
        mass=values[f"M{number}"],
        stiffness=values[f"k{number}"],
        inertia=values[f"J{number}"],
        damping=values[f"c{number}"],
        unbalance_mass=values[f"mu{number}"],
        unbalance_radius=values[f"e{number}"],
    )


def _shafts(values: Values) -> Values:
    try:
        found = cracked_shafts(
            _shaft(values, 1),
            _shaft(values, 2),
            values["alpha"],
            values["speed"],
            values["t_end"],
            phase=values["psi"],
            crack=_crack(values),
            drive_stiffness=values["K1T"],
            drive_damping=values["C1T"],
            gravity=values["gravity"],
            time=[values["t_end"]],
        )
    except InputError as error:
        raise error.renamed(lambda field: "t_end" if field == "end" else field) from None
    first, second = found.deflection[-1]
    return {
        "theta1_rad": found.angle[-1, 0],
        "X1_m": first.real,
        "Y1_m": first.imag,
        "X2_m": second.real,
        "Y2_m": second.imag,
        "theta1_dot_rad_s": found.rate[-1, 0],
        "energy_residual": found.residual,
    }


_LOSSES = (
    at_least_zero("loss_xi", mark("share of the stiffness lost along the crack when it is open"), below=1.0),
    at_least_zero("loss_eta", mark("share of the stiffness lost across the crack when it is open"), below=1.0),
)


def _power(key: str) -> Values:
    """Return the options of a power of the law of breathing."""
    return {"key": key, "doc": _("power m of the law of breathing"), "kind": "whole", "low": 1, "high": MOST_POWER}


def _of_both(name: str, first: str, second: str, dimension: str, *, zero: bool = False) -> tuple[Given, ...]:
    kind = at_least_zero if zero else positive
    return tuple(kind(name.format(number), doc, dimension) for number, doc in ((1, first), (2, second)))


_GRAVITY = at_least_zero("gravity_m_s2", mark("gravity across the shaft"), "acceleration", default=GRAVITY)

CALCULATIONS = (
    Calculation(
        name="crack_section",
        doc=mark("section that a straight-fronted crack leaves of a round shaft, and what bending stiffness it takes"),
        source=mark("article on the cracked shaft (17)-(19)"),
        takes=(
            positive("radius_m", mark("radius of the shaft"), "length", axes=(0, 1)),
            at_least_zero("delta", mark("depth of the crack over the radius"), below=2.0, axes=(0, 1)),
        ),
        returns=(
            gives("area_m2", mark("area that remains")),
            gives("centroid_shift_m", mark("from the axis to the centroid, away from the crack"), "length"),
            gives("Ix_remaining_m4", mark("second moment about the diameter along the crack's edge")),
            gives("Iy_remaining_m4", mark("second moment about the diameter across the crack's edge")),
            gives("Ix_centroidal_m4", mark("second moment about the centroid, along the crack's edge")),
            gives("relative_loss_strong", mark("share of stiffness lost in bending in the crack's direction")),
            gives("relative_loss_weak", mark("share of stiffness lost in bending across it")),
        ),
        answer=_section,
    ),
    Calculation(
        name="crack_breathing",
        doc=mark("how far a crack is open over the turn, as a sum of cosines"),
        source=mark("article on the cracked shaft (21)"),
        takes=(given(**_power("m")),),
        returns=(gives("a_j", mark("factors of 1, cos θ, cos 2θ …")),),
        answer=lambda values: {"a_j": breathing_law(values["m"])},
    ),
    Calculation(
        name="cracked_rotor_response",
        doc=mark("orders of the whirling of a cracked, unbalanced shaft at a steady speed, and whether it is stable"),
        source=mark("exact: banded harmonic balance, monodromy matrix"),
        takes=(
            positive("mass_kg", mark("mass of the disc"), "mass"),
            at_least_zero("damping_ratio", mark("damping ratio of the bending")),
            positive("k0_N_per_m", mark("stiffness of the sound shaft at the disc"), "stiffness"),
            *_LOSSES,
            given("breathing", mark("law of breathing"), kind="word", choices=(LAW,), default=LAW),
            given(**_power("breathing_m"), default=1),
            at_least_zero("unbalance_kgm", mark("mass times radius of the unbalance"), "unbalance", default=0.0),
            given("unbalance_phase_deg", mark("by which it is ahead of the crack"), "angle", default=0.0),
            _GRAVITY,
            given("speed_ratio", mark("speed over the critical one"), low=SLOWEST, axes=(0, 1)),
        ),
        returns=(
            gives("speed_rad_s", mark("speed"), "angular_speed"),
            gives("order_amplitude_complex_m", mark("size of each order; negative ones run backward"), "length"),
            gives("spectral_radius", mark("what the worst disturbance is multiplied by in a turn")),
            gives("stable", mark("whether disturbances die away")),
            gives("half_order_unstable", mark("whether half orders grow")),
        ),
        answer=_rotor,
    ),
    Calculation(
        name="unbalance_behind_joint",
        doc=mark("orders of the force of an unbalance on a shaft behind a joint"),
        source=mark("exact series of the joint"),
        takes=(
            at_least_zero("alpha_deg", mark("joint angle of the joint"), "angle", below=RIGHT, axes=(0, 1)),
            given("psi_deg", mark("angle of the driving yoke from the plane of the shafts"), "angle", default=0.0),
        ),
        returns=(
            gives(
                "force_order_over_meOmega2",
                mark(
                    "size of each order over mass times radius times square of the input speed; negative ones backward"
                ),
            ),
        ),
        answer=_behind,
    ),
    Calculation(
        name="cracked_two_shaft_model",
        doc=mark("two unbalanced shafts joined by a Hooke joint, the first cracked: where they are after a time"),
        source=mark("article on the cracked shaft (6)-(25), restored; integrated with an account of energy"),
        takes=(
            at_least_zero("alpha_deg", mark("joint angle of the joint"), "angle", below=RIGHT),
            given("psi_deg", mark("angle of the driving yoke from the plane of the shafts"), "angle", default=0.0),
            positive("speed_rad_s", mark("speed of the motor"), "angular_speed"),
            given(**_power("breathing_m"), default=1),
            *_LOSSES,
            *_of_both(
                "k{}_N_per_m",
                mark("stiffness of shaft 1 in bending"),
                mark("stiffness of shaft 2 in bending"),
                "stiffness",
            ),
            *_of_both("M{}_kg", mark("mass of disc 1"), mark("mass of disc 2"), "mass"),
            *_of_both(
                "mu{}_kg", mark("mass that unbalances disc 1"), mark("mass that unbalances disc 2"), "mass", zero=True
            ),
            *_of_both(
                "e{}_m",
                mark("its distance from the axis of shaft 1"),
                mark("its distance from the axis of shaft 2"),
                "length",
                zero=True,
            ),
            *_of_both("J{}_kgm2", mark("inertia of disc 1"), mark("inertia of disc 2"), "inertia"),
            positive("K1T_Nm_per_rad", mark("stiffness between motor and disc 1"), "turning_stiffness"),
            at_least_zero("C1T_Nms_per_rad", mark("damping between motor and disc 1"), "turning_damping"),
            *_of_both(
                "c{}_Ns_per_m",
                mark("damping of shaft 1 in bending"),
                mark("damping of shaft 2 in bending"),
                "damping",
                zero=True,
            ),
            _GRAVITY,
            positive("t_end_s", mark("how long"), "time"),
        ),
        returns=(
            gives("theta1_rad", mark("angle of disc 1"), "angle"),
            gives("X1_m", mark("disc 1, down"), "length"),
            gives("Y1_m", mark("disc 1, 90° ahead in the sense of rotation"), "length"),
            gives("X2_m", mark("disc 2, down"), "length"),
            gives("Y2_m", mark("disc 2, 90° ahead"), "length"),
            gives("theta1_dot_rad_s", mark("speed of disc 1"), "angular_speed"),
            gives("energy_residual", mark("what the account of energy misses")),
        ),
        answer=_shafts,
    ),
)
