"""Calculations of drives that move: moving centres, motion generators, length compensation."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.calc.calculation import Calculation, Values, given, gives
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
from cardan.texts import _, mark

from .kinematics import ACCELERATION, RIGHT
from .varying import TIME

MOVED = ("joints[1]", "output")
"""What a hitch or an arm carries in a double joint."""


def _axis_of_time(values: Values) -> Callable[[Any], Any]:
    """Return what takes the axis of instants away again where a single time was given."""
    return (lambda array: array[0]) if np.ndim(values["t"]) == 0 else (lambda array: array)


def _path(values: Values, times: Any) -> MovingMotion:
    path = harmonic_points(
        values["points0"], values["amplitude"], frequency=values["omega_motion"], phase=values["phase"]
    )
    yokes = np.zeros(len(values["points0"]) - 3) if values["gamma"] is None else values["gamma"]
    return moving_centres(
        path,
        times,
        yoke_angle=yokes,
        speed=values["omega1"],
        acceleration=values["eps1"],
        start_phase=values["theta1_at_t0"],
    )


def _centres(values: Values) -> Values:
    moved = _path(values, np.atleast_1d(values["t"]))
    if np.any(moved.shafts.joint_angle >= RIGHT):
        raise refuse("points0", _("at a given time a joint bends 90° or more"))
    at = _axis_of_time(values)
    return {
        "spin_rad_s": at(moved.spins.spin),
        "spin_acc_rad_s2": at(moved.spins.spin_acceleration),
        "alpha_deg": at(moved.shafts.joint_angle),
        "length_m": at(moved.shafts.length),
        "length_rate_m_s": at(moved.shafts.length_rate),
        "length_acc_m_s2": at(moved.shafts.length_acceleration),
    }


def _path_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Refuse tables of different lengths and points that make no line of shafts at time zero."""
    if "points0" not in values:
        return
    named = key("points0")
    for problem in point_problems(values["points0"].tolist()):
        yield Problem(problem.field.replace("points", named), problem.message.replace("points[", f"{named}["))
    count = len(values["points0"])
    for name, wanted in (("amplitude", count), ("phase", count), ("gamma", max(count - 3, 0))):
        value = values.get(name)
        if value is not None and np.ndim(value) and len(value) != wanted:
            yield Problem(key(name), _("{given} values given, {wanted} needed").format(given=len(value), wanted=wanted))


def _sliding(values: Values) -> Values:
    times = values["t"]
    shafts = _path(values | {"omega1": 0.0, "eps1": 0.0, "theta1_at_t0": 0.0, "gamma": None}, times).shafts
    k = values["shaft"] - 1
    found = length_compensation(
        times,
        shafts.length[:, k],
        shafts.length_rate[:, k],
        shafts.length_acceleration[:, k],
        spline=Spline(engaged=values["overlap0"], gap=values["gap0"]),
        limits=Limits(spline_overlap=values["overlap_min_allowed"]),
        drawn=float(np.linalg.norm(values["points0"][k + 1] - values["points0"][k])),
        shaft=values["shaft"],
    )
    return {
        "length_min_m": found.length_min,
        "length_max_m": found.length_max,
        "stroke_m": found.stroke,
        "rate_max_m_s": found.max_rate,
        "acc_max_m_s2": found.max_acceleration,
        "slip_path_m": found.slip_path,
        "engaged_min_m": found.engaged_min,
        "gap_min_m": found.gap_min,
        "flags": [told(flag.message, USUAL) for flag in found.flags],
    }


def _sliding_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from _path_check(values, key)
    if "points0" in values and "shaft" in values and not 1 <= values["shaft"] < len(values["points0"]):
        yield Problem(key("shaft"), _("there is no shaft {number}").format(number=values["shaft"]))


def _standing(points: Any, movement: Movement) -> Any:
    """Return the points with a movement held at its amplitude."""
    return moving_points(points, [movement], [0.0])[0][0]


def _turned(points: Any, gamma: float) -> Values:
    place = geometry_from_points(points)
    whole = equivalent_joint(Drives.from_points(points, yoke_angle=[gamma]))
    return {
        "joint_angle": place.joint_angle,
        "length": place.length[1],
        "twist": place.plane_twist,
        "delta": whole.speed_fluctuation,
    }


def _hitch(values: Values) -> Values:
    one, two = values["l1"], values["l2"]
    end = one + two
    line = [[-one - end, 0.0, 0.0], [-one, 0.0, 0.0], [two, 0.0, 0.0], [two + end, 0.0, 0.0]]
    hitch = Hitch(
        moves=MOVED, pivot=(0.0, 0.0, 0.0), yaw=values["yaw"], pitch=values["pitch"], frequency=1.0, phase=RIGHT
    )
    found = _turned(_standing(line, hitch), values["gamma2"])
    return {
        "alpha12_deg": found["joint_angle"][0],
        "alpha23_deg": found["joint_angle"][1],
        "length2_m": found["length"],
        "beta2_deg": found["twist"][0],
        "delta": found["delta"],
    }


def _hitch_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if values.get("l1") == 0.0 and values.get("l2") == 0.0:
        yield Problem(key("l2"), _("both joints stand at the pin"))


def _arm(values: Values) -> Values:
    one, two = values["B1"], values["B2_at_rest"]
    rest = np.stack((one - values["a1"], one, two, two + values["a3_at_rest"]))
    arm = Arm(
        moves=MOVED,
        pivot=tuple(values["pivot"].tolist()),
        axis=tuple(values["axis"].tolist()),
        amplitude=values["arm_rotation"],
        frequency=1.0,
        phase=RIGHT,
    )
    points = _standing(rest, arm)
    found = _turned(points, values["gamma2"])
    return {
        "B2_m": points[2],
        "a3": geometry_from_points(points).axis[-1],
        "alpha_deg": found["joint_angle"],
        "beta_deg": found["twist"],
        "length2_m": found["length"],
        "delta": found["delta"],
    }


def _arm_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    for name in ("a1", "axis", "a3_at_rest"):
        if name in values and not np.any(values[name]):
            yield Problem(key(name), _("[0, 0, 0] has no direction"))


def _vector(key: str, doc: str, dimension: str | None = None) -> Any:
    return given(key, doc, dimension, axes=(1,), width=3)


_POINTS = (
    given("points0_m", mark("middle positions of the points of the axis"), "length", axes=(2,), width=3),
    given("amplitude_m", mark("amplitude of each point [x, y, z]"), "length", axes=(2,), width=3),
    given("omega_motion_rad_s", mark("angular frequency of the oscillation"), "angular_speed"),
    given("phase_rad", mark("phase of each point"), "angle", axes=(0, 1), default=0.0),
)

CALCULATIONS = (
    Calculation(
        name="moving_centres",
        doc=mark("exact spin of every shaft, and lengths, while the joint centres oscillate along lines"),
        source=mark("rigid crosses; contains Kozhevnikov & Perfil'ev (1978), eq. 97–99"),
        takes=(
            *_POINTS,
            given("gamma_deg", mark("yoke angle of shafts 2 to n"), "angle", axes=(1,), default=None),
            given("omega1_rad_s", mark("spin of the input shaft at time zero"), "angular_speed"),
            ACCELERATION,
            given("theta1_at_t0_deg", mark("joint angle of joint 1 at time zero"), "angle", default=0.0),
            TIME,
        ),
        returns=(
            gives("spin_rad_s", mark("spin of each shaft"), "angular_speed"),
            gives("spin_acc_rad_s2", mark("its time derivative"), "angular_acceleration"),
            gives("alpha_deg", mark("joint angle of each joint"), "angle"),
            gives("length_m", mark("length of each shaft"), "length"),
            gives("length_rate_m_s", mark("sliding speed of each shaft"), "speed"),
            gives("length_acc_m_s2", mark("sliding acceleration of each shaft"), "acceleration"),
        ),
        answer=_centres,
        check=_path_check,
    ),
    Calculation(
        name="length_compensation",
        doc=mark("stroke, sliding speed, slip path, engaged length and gap of a splined shaft between swinging points"),
        source=mark("geometry of two moving points"),
        takes=(
            *_POINTS,
            given("t_s", mark("instants, rising"), "time", axes=(1,)),
            given("shaft", mark("number of the shaft"), kind="whole", low=1, default=2),
            given("overlap0_m", mark("engaged length in the middle position"), "length", above=0.0, default=None),
            given("gap0_m", mark("way left to bottoming in the middle position"), "length", above=0.0, default=None),
            given("overlap_min_allowed_m", mark("smallest engaged length allowed"), "length", above=0.0, default=None),
        ),
        returns=(
            gives("length_min_m", mark("shortest length"), "length"),
            gives("length_max_m", mark("longest length"), "length"),
            gives("stroke_m", mark("longest less shortest length"), "length"),
            gives("rate_max_m_s", mark("largest sliding speed"), "speed"),
            gives("acc_max_m_s2", mark("largest sliding acceleration"), "acceleration"),
            gives("slip_path_m", mark("total way slid"), "length"),
            gives("engaged_min_m", mark("shortest engaged length"), "length"),
            gives("gap_min_m", mark("least way left to bottoming"), "length"),
            gives("flags", mark("limits passed")),
        ),
        answer=_sliding,
        check=_sliding_check,
    ),
    Calculation(
        name="motion_hitch",
        doc=mark("double joint over a hitch pin that both end shafts point at"),
        source="Kozhevnikov & Perfil'ev (1978), Figs 56, 57",
        takes=(
            given("l1_m", mark("distance of joint 1 before the pin"), "length", low=0.0),
            given("l2_m", mark("distance of joint 2 behind the pin"), "length", low=0.0),
            given("yaw_deg", mark("yaw of the drawn body"), "angle", default=0.0),
            given("pitch_deg", mark("pitch of the drawn body"), "angle", default=0.0),
            given("gamma2_deg", mark("yoke angle of shaft 2"), "angle", default=0.0),
        ),
        returns=(
            gives("alpha12_deg", mark("joint angle of joint 1"), "angle"),
            gives("alpha23_deg", mark("joint angle of joint 2"), "angle"),
            gives("length2_m", mark("length of the shaft between"), "length"),
            gives("beta2_deg", mark("plane twist"), "angle"),
            gives("delta", mark("irregularity")),
        ),
        answer=_hitch,
        check=_hitch_check,
    ),
    Calculation(
        name="motion_arm",
        doc=mark("double joint whose second joint and output shaft turn with an arm"),
        source=mark("trailing arm, torque tube, leaf spring as an equivalent arm"),
        takes=(
            _vector("B1_m", mark("centre of joint 1"), "length"),
            _vector("a1", mark("direction of the input shaft")),
            _vector("pivot_m", mark("a point of the arm's axis"), "length"),
            _vector("axis", mark("direction of the arm's axis")),
            _vector("B2_at_rest_m", mark("centre of joint 2 before the arm turns"), "length"),
            _vector("a3_at_rest", mark("direction of the output shaft before the arm turns")),
            given("arm_rotation_deg", mark("turn of the arm"), "angle"),
            given("gamma2_deg", mark("yoke angle of shaft 2"), "angle", default=0.0),
        ),
        returns=(
            gives("B2_m", mark("centre of joint 2"), "length"),
            gives("a3", mark("direction of the output shaft")),
            gives("alpha_deg", mark("joint angles"), "angle"),
            gives("beta_deg", mark("plane twist"), "angle"),
            gives("length2_m", mark("length of the shaft between"), "length"),
            gives("delta", mark("irregularity")),
        ),
        answer=_arm,
        check=_arm_check,
    ),
)
