"""How shafts and crosses stand and turn where pins stand apart, so that shafts wobble about the balls they run in."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Hooke
from cardan.drive.models.geometry import geometry
from cardan.drive.models.wobble import CLOSE, SAMPLES, course
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import sampled_series, series_at
from cardan.maths.kernel import frames
from cardan.questions.motion.moving_chain import moving_axes
from cardan.texts import _
from cardan.units import mm

from .kinetostatics import KinematicState, swinging

CARRIED = 1e-9
"""Share of the length of a shaft by which its end may be carried around, for rounding."""


def wobbling_state(
    drive: Drive, angle: Array, speed: float, acceleration: float
) -> tuple[KinematicState, Array, Array]:
    """Return how a drive stands whose shafts wobble, and its points.

    drive: with its supports, the balls of its joints among them; angle (p,) [rad]: φ_1 from the start position.
    speed, acceleration [rad/s, rad/s²]: ω_1, ε_1.
    Returns the state, and points and their accelerations (p, n+2, 3) [m, m/s²]: a point of the input axis, the joint
    centres, the end of the output shaft. What changes over a turn is followed by its harmonics.
    """
    place = geometry(drive)
    turn = np.arange(SAMPLES) * (2.0 * np.pi / SAMPLES)
    lying = course(drive, turn, place)
    check(_problems(drive, lying.centre - place.points[1:-1, None]))
    heads = np.moveaxis(lying.start - lying.centre, 1, 0)
    far = np.asarray(place.length[-1])
    if drive.shafts[-1].spline is not None:  # beyond it nothing moves along
        far = frames.dot(place.points[-1] - lying.start[-1], lying.axis[-1])
    ends = lying.start[-1] + far[..., None] * lying.axis[-1]
    table = np.concatenate(
        (np.moveaxis(lying.axis, 1, 0), heads, np.moveaxis(lying.centre, 1, 0), ends[:, None]), axis=1
    )
    wave = sampled_series(np.moveaxis(table, 0, -1))
    wave[np.abs(wave) < CLOSE * np.max(np.abs(wave), axis=-1, keepdims=True)] = 0.0
    value, by_angle, second = (np.moveaxis(part, 1, 0) for part in series_at(wave, angle))
    rate, curve = speed * by_angle, speed**2 * second + acceleration * by_angle
    n = len(drive.joints)
    shafts, head, rest = np.s_[:, : n + 1], np.s_[:, n + 1 : 2 * n + 1], np.s_[:, 2 * n + 1 :]
    phi = angle + drive.input.start_phase
    mark = frames.rotate(
        np.broadcast_to(frames.cross(place.normal[0], place.axis[0]), (*phi.shape, 3)), place.axis[0], phi
    )
    axes = value[shafts], rate[shafts], curve[shafts]
    spins = moving_axes(
        axes,
        mark,
        yoke_angle=[shaft.yoke_angle for shaft in drive.shafts[1:-1]],
        speed=np.full(phi.shape, speed),
        acceleration=np.full(phi.shape, acceleration),
        kinds=[joint if joint.ball is None else Hooke() for joint in drive.joints],
    )

    def points(centres: Array, first: Array) -> Array:
        return np.concatenate((np.broadcast_to(first, (*phi.shape, 1, 3)), centres), axis=1)

    stand = swinging(
        axes,
        spins,
        head=value[head],
        head_acceleration=curve[head],
        head_rate=rate[head],
        point_rate=points(rate[rest], np.zeros(3)),
        ahead=np.mean(np.sum(heads * np.moveaxis(lying.axis[1:], 1, 0), axis=-1), axis=0),
        rest=np.asarray(place.axis),
        shift=value[rest][:, :n] - place.points[1:-1],
    )

    return stand, points(value[rest], place.points[0]), points(curve[rest], np.zeros(3))


def _problems(drive: Drive, carried: Array) -> Iterator[Problem]:
    """Yield what keeps a shaft from wobbling: bearings beside its ball, a next joint that stays where it is.

    carried (n, p, 3) [m]: way of each joint centre from its place.
    """
    place = geometry(drive)
    for i, joint in enumerate(drive.joints):
        if joint.ball is None:
            continue
        for k, one in enumerate(drive.supports):
            if one.shaft == i + 2 and (one.tilt or abs(one.position - joint.ball) > CARRIED * joint.ball):
                text = _(
                    "shaft {shaft} wobbles about the ball of joint {joint}, {reach:.6g} mm behind it: it binds here"
                )
                said = text.format(shaft=i + 2, joint=i + 1, reach=joint.ball / mm)
                yield Problem(f"supports[{k}].position", said, "inconsistent")
        length = float(place.length[i + 1])
        if i + 1 < len(drive.joints) and abs(joint.ball - length) > CARRIED * length:
            way = float(np.max(frames.norm(carried[i + 1])))
            text = _(
                "the shaft behind it carries joint {next} around by {way:.4g} mm, which shafts in bearings cannot "
                "follow: {length:.6g} mm would put the ball where joint {next} stands"
            )
            said = text.format(next=i + 2, way=way / mm, length=length / mm)
            yield Problem(f"joints[{i}].reach", said, "inconsistent")
