"""Drives that move: moving centres, motion generators, length compensation; bends that swing or are random."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.book.varying_joint_angle import random_joint_angle, swinging_chain, swinging_joint
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.drives import Drives
from cardan.drive.duty import Limits
from cardan.drive.fields.validity import point_problems
from cardan.drive.models.geometry import geometry_from_points
from cardan.drive.movement import Arm, Hitch, Movement
from cardan.drive.shaft import Spline
from cardan.errors import Problem, refuse
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.length import length_compensation
from cardan.questions.motion.moving_chain import MovingMotion, harmonic_points, moving_centres
from cardan.questions.motion.moving_points import moving_points
from cardan.reading.given import RIGHT, at_least_zero, given, joint_angle, positive, vector, whole
from cardan.texts import _

from .kinematics import ACCELERATION

formula = Formulas(__doc__)

TIME = given("t_s", "time", axes=(0, 1))
MOVED = ("joints[1]", "output")
"""What a hitch or an arm carries in a double joint."""


def _path(v: Values, times: Any) -> MovingMotion:
    path = harmonic_points(v.points0, v.amplitude, frequency=v.omega_motion, phase=v.phase)
    yokes = np.zeros(len(v.points0) - 3) if v.gamma is None else v.gamma
    return moving_centres(
        path, times, yoke_angle=yokes, **v.of(speed="omega1", acceleration="eps1", start_phase="theta1_at_t0")
    )


def _path_check(v: Values) -> Problems:
    """Refuse tables of different lengths and points that make no line of shafts at time zero."""
    if "points0" not in v:
        return
    named = v.key("points0")
    for problem in point_problems(v.points0.tolist()):
        yield Problem(problem.field.replace("points", named), problem.message.replace("points[", f"{named}["))
    count = len(v.points0)
    yield from v.miscounted(count, "amplitude", "phase", axis=0)
    yield from v.miscounted(max(count - 3, 0), "gamma")


def _sliding_check(v: Values) -> Problems:
    yield from _path_check(v)
    if "points0" in v and "shaft" in v and not 1 <= v.shaft < len(v.points0):
        yield v.wrong("shaft", _("there is no shaft {number}"), number=v.shaft)


def _standing(points: Any, movement: Movement) -> Any:
    """Return the points with a movement held at its amplitude."""
    return moving_points(points, [movement], [0.0])[0][0]


def _turned(points: Any, gamma: float) -> tuple[Any, Any, float, float]:
    """Return joint angles, plane twists, length of the shaft between and speed fluctuation."""
    place = geometry_from_points(points)
    whole = equivalent_joint(Drives.from_points(points, yoke_angle=[gamma]))
    return place.joint_angle, place.plane_twist, place.length[1], whole.speed_fluctuation


def _hitch_check(v: Values) -> Problems:
    if v.get("l1") == 0.0 and v.get("l2") == 0.0:
        yield v.wrong("l2", _("both joints stand at the pin"))


def _arm_check(v: Values) -> Problems:
    for name in ("a1", "axis", "a3_at_rest"):
        if name in v and not np.any(v[name]):
            yield v.wrong(name, _("[0, 0, 0] has no direction"))


_POINTS = (
    given("points0_m", "middle positions of the points of the axis", axes=2, width=3),
    given("amplitude_m", "amplitude of each point [x, y, z]", axes=2, width=3),
    given("omega_motion_rad_s", "angular frequency of the oscillation"),
    given("phase_rad", "phase of each point", axes=(0, 1), default=0.0),
)


@formula(
    "exact spin of every shaft, and lengths, while the joint centres oscillate along lines",
    "rigid crosses; contains Kozhevnikov & Perfil'ev (1978), eq. 97–99",
    *_POINTS,
    given("gamma_deg", "yoke angle of shafts 2 to n", axes=1, default=None),
    given("omega1_rad_s", "spin of the input shaft at time zero"),
    ACCELERATION,
    given("theta1_at_t0_deg", "joint angle of joint 1 at time zero", default=0.0),
    TIME,
    "spin_rad_s: spin of each shaft",
    "spin_acc_rad_s2: its time derivative",
    "alpha_deg: joint angle of each joint",
    "length_m: length of each shaft",
    "length_rate_m_s: sliding speed of each shaft",
    "length_acc_m_s2: sliding acceleration of each shaft",
    check=_path_check,
)
def _moving_centres(v: Values) -> Any:
    moved = _path(v, np.atleast_1d(v.t))
    if np.any(moved.shafts.joint_angle >= RIGHT):
        raise refuse("points0", _("at a given time a joint angle is 90° or more"))
    spins, shafts = moved.spins, moved.shafts
    lengths = shafts.length, shafts.length_rate, shafts.length_acceleration
    return tuple(map(v.single("t", 0), (spins.spin, spins.spin_acceleration, shafts.joint_angle, *lengths)))


@formula(
    "stroke, sliding speed, slip path, engaged length and gap of a splined shaft between swinging points",
    "geometry of two moving points",
    *_POINTS,
    given("t_s", "instants, rising", axes=1),
    whole("shaft", "number of the shaft", low=1, default=2),
    positive("overlap0_m", "engaged length in the middle position", default=None),
    positive("gap0_m", "way left to bottoming in the middle position", default=None),
    positive("overlap_min_allowed_m", "smallest engaged length allowed", default=None),
    "length_min_m = length_min: shortest length",
    "length_max_m = length_max: longest length",
    "stroke_m = stroke: longest less shortest length",
    "rate_max_m_s = max_rate: largest sliding speed",
    "acc_max_m_s2 = max_acceleration: largest sliding acceleration",
    "slip_path_m = slip_path: total way slid",
    "engaged_min_m = engaged_min: shortest engaged length",
    "gap_min_m = gap_min: least way left to bottoming",
    "flags: limits passed",
    check=_sliding_check,
)
def _length_compensation(v: Values) -> Any:
    times = v.t
    shafts = _path(v.but(omega1=0.0, eps1=0.0, theta1_at_t0=0.0, gamma=None), times).shafts
    k = v.shaft - 1
    found = length_compensation(
        times,
        shafts.length[:, k],
        shafts.length_rate[:, k],
        shafts.length_acceleration[:, k],
        spline=Spline(engaged=v.overlap0, gap=v.gap0),
        limits=Limits(spline_overlap=v.overlap_min_allowed),
        drawn=float(np.linalg.norm(v.points0[k + 1] - v.points0[k])),
        shaft=v.shaft,
    )
    return found, {"flags": [told(flag.message, USUAL) for flag in found.flags]}


@formula(
    "double joint over a hitch pin that both end shafts point at",
    "Kozhevnikov & Perfil'ev (1978), Figs 56, 57",
    at_least_zero("l1_m", "distance of joint 1 before the pin"),
    at_least_zero("l2_m", "distance of joint 2 behind the pin"),
    given("yaw_deg", "yaw of the drawn body", default=0.0),
    given("pitch_deg", "pitch of the drawn body", default=0.0),
    given("gamma2_deg", "yoke angle of shaft 2", default=0.0),
    "alpha12_deg: joint angle of joint 1",
    "alpha23_deg: joint angle of joint 2",
    "length2_m: length of the shaft between",
    "beta2_deg: plane twist",
    "delta: speed fluctuation",
    check=_hitch_check,
)
def _motion_hitch(v: Values) -> Any:
    one, two = v.l1, v.l2
    end = one + two
    line = [[-one - end, 0.0, 0.0], [-one, 0.0, 0.0], [two, 0.0, 0.0], [two + end, 0.0, 0.0]]
    hitch = Hitch(moves=MOVED, pivot=(0.0, 0.0, 0.0), yaw=v.yaw, pitch=v.pitch, frequency=1.0, phase=RIGHT)
    (first, second), (twist,), length, delta = _turned(_standing(line, hitch), v.gamma2)
    return first, second, length, twist, delta


@formula(
    "double joint whose second joint and output shaft turn with an arm",
    "trailing arm, torque tube, leaf spring as an equivalent arm",
    vector("B1_m", "centre of joint 1"),
    vector("a1", "direction of the input shaft"),
    vector("pivot_m", "a point of the arm's axis"),
    vector("axis", "direction of the arm's axis"),
    vector("B2_at_rest_m", "centre of joint 2 before the arm turns"),
    vector("a3_at_rest", "direction of the output shaft before the arm turns"),
    given("arm_rotation_deg", "turn of the arm"),
    given("gamma2_deg", "yoke angle of shaft 2", default=0.0),
    "B2_m: centre of joint 2",
    "a3: direction of the output shaft",
    "alpha_deg: joint angles",
    "beta_deg: plane twist",
    "length2_m: length of the shaft between",
    "delta: speed fluctuation",
    check=_arm_check,
)
def _motion_arm(v: Values) -> Any:
    one, two = v.B1, v.B2_at_rest
    rest = np.stack((one - v.a1, one, two, two + v.a3_at_rest))
    pivot, axis = (tuple(way.tolist()) for way in (v.pivot, v.axis))
    arm = Arm(moves=MOVED, pivot=pivot, axis=axis, amplitude=v.arm_rotation, frequency=1.0, phase=RIGHT)
    points = _standing(rest, arm)
    return points[2], geometry_from_points(points).axis[-1], *_turned(points, v.gamma2)


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
    "Kozhevnikov & Perfil'ev (1978), eq. 96–98, completed",
    given("alpha_mean_deg", "mean joint angle"),
    given("alpha_amp_deg", "amplitude of the joint angle"),
    given("alpha_omega_rad_s", "angular frequency of the joint angle"),
    given("alpha_phase_deg", "phase of the joint angle at time zero", default=0.0),
    given("omega1_at_t0_rad_s", "input speed at time zero"),
    ACCELERATION,
    given("psi1_deg", "phase angle of the joint at time zero", default=0.0),
    TIME,
    "alpha_deg = joint_angle: joint angle",
    "alpha_rate_rad_s = joint_angle_rate: rate of the joint angle",
    "alpha_acc_rad_s2 = joint_angle_acceleration: acceleration of the joint angle",
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
    "Kozhevnikov & Perfil'ev (1978), eq. 99",
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
    "expectations of Kozhevnikov & Perfil'ev (1978), eq. 97 over the normal law",
    joint_angle("alpha_mean_deg", "mean joint angle"),
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
