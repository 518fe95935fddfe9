"""Calculations of joint angles that vary while the shafts turn: swinging joints, double joints, random bends."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from cardan.book.random_joint_angle import random_joint_angle
from cardan.book.varying_joint_angle import swinging_chain, swinging_joint
from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.errors import Problem
from cardan.texts import _, mark

from .kinematics import ACCELERATION, RIGHT

TIME = given("t_s", mark("time"), "time", axes=(0, 1))


def _swing_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Refuse bends that swing to a right angle."""
    for mean, amplitude in (
        ("alpha_mean", "alpha_amp"),
        ("alpha12_mean", "alpha12_sin_amp"),
        ("alpha23_mean", "alpha23_cos_amp"),
    ):
        if mean in values and amplitude in values and abs(values[mean]) + abs(values[amplitude]) >= RIGHT:
            yield Problem(key(mean), _("the joint angle reaches 90° with the given amplitude"))


def _single(values: Values) -> Values:
    found = swinging_joint(
        values["t"],
        mean=values["alpha_mean"],
        amplitude=values["alpha_amp"],
        frequency=values["alpha_omega"],
        phase=values["alpha_phase"],
        speed=values["omega1_at_t0"],
        acceleration=values["eps1"],
        start_phase=values["psi1"],
    )
    return {
        "alpha_deg": found.joint_angle,
        "alpha_rate_rad_s": found.joint_angle_rate,
        "alpha_acc_rad_s2": found.joint_angle_acceleration,
        "phi1_rad": found.angle,
        "omega2_rad_s": found.driven_speed,
        "eps2_rad_s2": found.driven_acceleration,
    }


def _double(values: Values) -> Values:
    found = swinging_chain(
        values["t"],
        mean=[values["alpha12_mean"], values["alpha23_mean"]],
        amplitude=[values["alpha12_sin_amp"], values["alpha23_cos_amp"]],
        frequency=values["omega_angle"],
        phase=[0.0, RIGHT],
        yoke_angle=[values["gamma2"]],
        speed=values["omega1"],
    )
    return {"omega3_rad_s": found.driven_speed, "eps3_rad_s2": found.driven_acceleration}


def _random(values: Values) -> Values:
    found = random_joint_angle(
        values["phi1"],
        mean=values["alpha_mean"],
        deviation=values["alpha_std"],
        rate_deviation=values["alpha_rate_std"],
        speed=values["omega1"],
    )
    return {
        "omega2_mean_rad_s": found.mean,
        "omega2_std_rad_s": found.deviation,
        "omega2_std_first_order_rad_s": found.small,
    }


def _random_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if "alpha_mean" in values and "alpha_std" in values and values["alpha_mean"] + 6 * values["alpha_std"] >= RIGHT:
        yield Problem(key("alpha_std"), _("the mean and six standard deviations reach 90°"))


CALCULATIONS = (
    Calculation(
        name="varying_angle_single",
        doc=mark("one joint whose joint angle oscillates harmonically, the plane of the shafts at rest"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 96–98, completed",
        takes=(
            given("alpha_mean_deg", mark("mean joint angle"), "angle"),
            given("alpha_amp_deg", mark("amplitude of the joint angle"), "angle"),
            given("alpha_omega_rad_s", mark("angular frequency of the joint angle"), "angular_speed"),
            given("alpha_phase_deg", mark("phase of the joint angle at time zero"), "angle", default=0.0),
            given("omega1_at_t0_rad_s", mark("input speed at time zero"), "angular_speed"),
            ACCELERATION,
            given("psi1_deg", mark("phase angle of the joint at time zero"), "angle", default=0.0),
            TIME,
        ),
        returns=(
            gives("alpha_deg", mark("joint angle"), "angle"),
            gives("alpha_rate_rad_s", mark("rate of the joint angle"), "angular_speed"),
            gives("alpha_acc_rad_s2", mark("acceleration of the joint angle"), "angular_acceleration"),
            gives("phi1_rad", mark("input angle"), "angle"),
            gives("omega2_rad_s", mark("speed of the driven shaft"), "angular_speed"),
            gives("eps2_rad_s2", mark("acceleration of the driven shaft"), "angular_acceleration"),
        ),
        answer=_single,
        check=_swing_check,
    ),
    Calculation(
        name="varying_angle_double",
        doc=mark("planar double joint whose joint angles oscillate, one as a sine, the other as a cosine"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 99",
        takes=(
            given("alpha12_mean_deg", mark("mean joint angle of joint 1"), "angle"),
            given("alpha12_sin_amp_deg", mark("amplitude of the joint angle of joint 1"), "angle"),
            given("alpha23_mean_deg", mark("mean joint angle of joint 2"), "angle"),
            given("alpha23_cos_amp_deg", mark("amplitude of the joint angle of joint 2"), "angle"),
            given("omega_angle_rad_s", mark("angular frequency of the joint angles"), "angular_speed"),
            given("omega1_rad_s", mark("input speed"), "angular_speed"),
            given("gamma2_deg", mark("yoke angle of shaft 2"), "angle", default=0.0),
            TIME,
        ),
        returns=(
            gives("omega3_rad_s", mark("output speed"), "angular_speed"),
            gives("eps3_rad_s2", mark("output acceleration"), "angular_acceleration"),
        ),
        answer=_double,
        check=_swing_check,
    ),
    Calculation(
        name="varying_angle_random",
        doc=mark("mean and standard deviation of the driven speed of a joint with a random joint angle"),
        source=mark("expectations of Kozhevnikov & Perfil'ev (1978), eq. 97 over the normal law"),
        takes=(
            given("alpha_mean_deg", mark("mean joint angle"), "angle", low=0.0, below=RIGHT),
            given("alpha_std_deg", mark("standard deviation of the joint angle"), "angle", low=0.0),
            given("alpha_rate_std_rad_s", mark("standard deviation of its rate"), "angular_speed", low=0.0),
            given("omega1_rad_s", mark("input speed"), "angular_speed"),
            given("phi1_deg", mark("angle of the driving yoke from the plane of the joint"), "angle", axes=(0, 1)),
        ),
        returns=(
            gives("omega2_mean_rad_s", mark("mean speed of the driven shaft"), "angular_speed"),
            gives("omega2_std_rad_s", mark("standard deviation of that speed"), "angular_speed"),
            gives(
                "omega2_std_first_order_rad_s", mark("the same to first order in the joint angle's"), "angular_speed"
            ),
        ),
        answer=_random,
        check=_random_check,
    ),
)
