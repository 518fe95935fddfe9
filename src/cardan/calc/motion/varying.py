"""Bends that vary while the shafts turn: swinging joints, double joints, random bends."""

from __future__ import annotations

from typing import Any

from cardan.book.random_joint_angle import random_joint_angle
from cardan.book.varying_joint_angle import swinging_chain, swinging_joint
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.reading.given import RIGHT, at_least_zero, given, yoke_rotation
from cardan.texts import _

from .kinematics import ACCELERATION

formula = Formulas(__doc__)


TIME = given("t_s", "time", axes=(0, 1))


def _swing_check(v: Values) -> Problems:
    """Refuse bends that swing to a right angle."""
    for mean, amplitude in (
        ("alpha_mean", "alpha_amp"),
        ("alpha12_mean", "alpha12_sin_amp"),
        ("alpha23_mean", "alpha23_cos_amp"),
    ):
        if mean in v and amplitude in v and abs(v[mean]) + abs(v[amplitude]) >= RIGHT:
            yield v.wrong(mean, _("the joint angle reaches 90° with the given amplitude"))


def _random_check(v: Values) -> Problems:
    if "alpha_mean" in v and "alpha_std" in v and v.alpha_mean + 6 * v.alpha_std >= RIGHT:
        yield v.wrong("alpha_std", _("the mean and six standard deviations reach 90°"))


@formula(
    "one joint whose joint angle oscillates harmonically, the plane of the shafts at rest",
    "Book (96)-(98), completed",
    given("alpha_mean_deg", "mean joint angle"),
    given("alpha_amp_deg", "amplitude of the joint angle"),
    given("alpha_omega_rad_s", "angular frequency of the joint angle"),
    given("alpha_phase_deg", "phase of the joint angle at time zero", default=0.0),
    given("omega1_at_t0_rad_s", "input speed at time zero"),
    ACCELERATION,
    given("psi1_deg", "phase angle of the joint at time zero", default=0.0),
    TIME,
    "alpha_deg = bend: bend",
    "alpha_rate_rad_s = bend_rate: rate of the joint angle",
    "alpha_acc_rad_s2 = bend_acceleration: acceleration of the joint angle",
    "phi1_rad = angle: input angle",
    "omega2_rad_s = driven_speed: speed of the driven shaft",
    "eps2_rad_s2 = driven_acceleration: acceleration of the driven shaft",
    check=_swing_check,
)
def _varying_angle_single(v: Values) -> Any:
    return swinging_joint(
        v.t,
        **v.of(
            mean="alpha_mean",
            amplitude="alpha_amp",
            frequency="alpha_omega",
            phase="alpha_phase",
            speed="omega1_at_t0",
            acceleration="eps1",
            start_phase="psi1",
        ),
    )


@formula(
    "planar double joint whose joint angles oscillate, one as a sine, the other as a cosine",
    "Book (99)",
    given("alpha12_mean_deg", "mean joint angle of joint 1"),
    given("alpha12_sin_amp_deg", "amplitude of the joint angle of joint 1"),
    given("alpha23_mean_deg", "mean joint angle of joint 2"),
    given("alpha23_cos_amp_deg", "amplitude of the joint angle of joint 2"),
    given("omega_angle_rad_s", "angular frequency of the joint angles"),
    given("omega1_rad_s", "input speed"),
    given("gamma2_deg", "yoke angle of shaft 2", default=0.0),
    TIME,
    "omega3_rad_s: output speed",
    "eps3_rad_s2: output acceleration",
    check=_swing_check,
)
def _varying_angle_double(v: Values) -> Any:
    found = swinging_chain(
        v.t,
        mean=[v.alpha12_mean, v.alpha23_mean],
        amplitude=[v.alpha12_sin_amp, v.alpha23_cos_amp],
        frequency=v.omega_angle,
        phase=[0.0, RIGHT],
        yoke_angle=[v.gamma2],
        speed=v.omega1,
    )
    return found.driven_speed, found.driven_acceleration


@formula(
    "mean and standard deviation of the driven speed of a joint with a random joint angle",
    "expectations of Book (97) over the normal law",
    yoke_rotation("alpha_mean_deg", "mean joint angle"),
    at_least_zero("alpha_std_deg", "standard deviation of the joint angle"),
    at_least_zero("alpha_rate_std_rad_s", "standard deviation of its rate"),
    given("omega1_rad_s", "input speed"),
    given("phi1_deg", "angle of the driving yoke from the plane of the joint", axes=(0, 1)),
    "omega2_mean_rad_s: mean speed of the driven shaft",
    "omega2_std_rad_s: standard deviation of that speed",
    "omega2_std_first_order_rad_s: the same to first order in the joint angle's",
    check=_random_check,
)
def _varying_angle_random(v: Values) -> Any:
    found = random_joint_angle(
        v.phi1, **v.of(mean="alpha_mean", deviation="alpha_std", rate_deviation="alpha_rate_std", speed="omega1")
    )
    return found.mean, found.deviation, found.small
