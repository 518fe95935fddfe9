"""Move: moving centres, motion generators, length compensation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
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
from cardan.reading.given import RIGHT, at_least_zero, given, positive, vector, whole
from cardan.texts import _

from .kinematics import ACCELERATION
from .varying import TIME

formula = Formulas(__doc__)


MOVED = ("joints[1]", "output")
"""What a hitch or an arm carries in a double joint."""


def _axis_of_time(v: Values) -> Callable[[Any], Any]:
    """Return what takes the axis of instants away again where a single time was given."""
    return (lambda array: array[0]) if np.ndim(v.t) == 0 else (lambda array: array)


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
    for name, wanted in (("amplitude", count), ("phase", count), ("gamma", max(count - 3, 0))):
        value = v.get(name)
        if value is not None and np.ndim(value) and len(value) != wanted:
            yield v.wrong(name, _("{given} values given, {wanted} needed").format(given=len(value), wanted=wanted))


def _sliding_check(v: Values) -> Problems:
    yield from _path_check(v)
    if "points0" in v and "shaft" in v and not 1 <= v.shaft < len(v.points0):
        yield v.wrong("shaft", _("there is no shaft {number}").format(number=v.shaft))


def _standing(points: Any, movement: Movement) -> Any:
    """Return the points with a movement held at its amplitude."""
    return moving_points(points, [movement], [0.0])[0][0]


def _turned(points: Any, gamma: float) -> dict[str, Any]:
    place = geometry_from_points(points)
    whole = equivalent_joint(Drives.from_points(points, yoke_angle=[gamma]))
    return {
        "joint_angle": place.joint_angle,
        "length": place.length[1],
        "twist": place.plane_twist,
        "delta": whole.speed_fluctuation,
    }


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
    "rigid crosses; contains Book (97)-(99)",
    *_POINTS,
    given("gamma_deg", "yoke angle of shafts 2 to n", axes=1, default=None),
    given("omega1_rad_s", "spin of the input shaft at time zero"),
    ACCELERATION,
    given("theta1_at_t0_deg", "joint angle of joint 1 at time zero", default=0.0),
    TIME,
    "spin_rad_s: spin of each shaft",
    "spin_acc_rad_s2: its time derivative",
    "alpha_deg: bend of each joint",
    "length_m: length of each shaft",
    "length_rate_m_s: sliding speed of each shaft",
    "length_acc_m_s2: sliding acceleration of each shaft",
    check=_path_check,
)
def _moving_centres(v: Values) -> Any:
    moved = _path(v, np.atleast_1d(v.t))
    if np.any(moved.shafts.joint_angle >= RIGHT):
        raise refuse("points0", _("at a given time a joint bends 90° or more"))
    at = _axis_of_time(v)
    return {
        "spin_rad_s": at(moved.spins.spin),
        "spin_acc_rad_s2": at(moved.spins.spin_acceleration),
        "alpha_deg": at(moved.shafts.joint_angle),
        "length_m": at(moved.shafts.length),
        "length_rate_m_s": at(moved.shafts.length_rate),
        "length_acc_m_s2": at(moved.shafts.length_acceleration),
    }


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
    "Book Figs 56, 57",
    at_least_zero("l1_m", "distance of joint 1 before the pin"),
    at_least_zero("l2_m", "distance of joint 2 behind the pin"),
    given("yaw_deg", "yaw of the drawn body", default=0.0),
    given("pitch_deg", "pitch of the drawn body", default=0.0),
    given("gamma2_deg", "yoke angle of shaft 2", default=0.0),
    "alpha12_deg: bend of joint 1",
    "alpha23_deg: bend of joint 2",
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
    found = _turned(_standing(line, hitch), v.gamma2)
    return found["joint_angle"][0], found["joint_angle"][1], found["length"], found["twist"][0], found["delta"]


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
    "alpha_deg: bends",
    "beta_deg: plane twist",
    "length2_m: length of the shaft between",
    "delta: speed fluctuation",
    check=_arm_check,
)
def _motion_arm(v: Values) -> Any:
    one, two = v.B1, v.B2_at_rest
    rest = np.stack((one - v.a1, one, two, two + v.a3_at_rest))
    arm = Arm(
        moves=MOVED,
        pivot=tuple(v.pivot.tolist()),
        axis=tuple(v.axis.tolist()),
        amplitude=v.arm_rotation,
        frequency=1.0,
        phase=RIGHT,
    )
    points = _standing(rest, arm)
    found = _turned(points, v.gamma2)
    return {
        "B2_m": points[2],
        "a3": geometry_from_points(points).axis[-1],
        "alpha_deg": found["joint_angle"],
        "beta_deg": found["twist"],
        "length2_m": found["length"],
        "delta": found["delta"],
    }
