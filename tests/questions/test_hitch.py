"""The hitch drive over its whole movement: life and heat against an integration of its own, by vectors.

The oracle knows crosses as vectors alone: it turns the points by matrices, the pins by cross products, and sums damage
and friction over the turn and over the movement by the midpoint rule.
"""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.answer import Answer
from cardan.answers.quantity import told
from cardan.answers.reader import Reader
from cardan.drive.conditions import in_poses
from cardan.drive.cross import Cross
from cardan.drive.joint_parts import Needles
from cardan.drive.settings import Pose
from cardan.io.examples import example
from cardan.questions.gathering import gather
from cardan.questions.life.life import life
from cardan.questions.losses.losses import losses
from cardan.register import QUESTIONS
from cardan.units import hour

CAPACITY, SPAN, JOURNAL, FRICTION = 17.93e3, 0.08, 0.02, 0.0427
TORQUE, SPEED = 400.0, 540.0 * 2.0 * np.pi / 60.0
PIVOT, YAW, PITCH = np.array((0.5, 0.0, -0.24)), np.deg2rad(40.0), np.deg2rad(8.0)
DROP = 0.06  # the implement is coupled lower than the tractor: the shaft is bent a little as drawn
POINTS = np.array(((-0.12, 0, 0), (0, 0, 0), (1, 0, -DROP), (1.15, 0, -DROP)))

TURN, SWING = 720, 360  # places in a turn and in a swing of the movement: a midpoint sum with kinks errs by 1/n²


def hitch(**fields):
    """Return the shipped hitch drive with crosses that rub and tire, its implement a little lower, under torque."""
    drive = example("pto-hitch")
    crossed = {
        "cross": Cross(span=SPAN, journal=JOURNAL),
        "friction": FRICTION,
        "needles": Needles(capacity=CAPACITY),
    }
    first, last = (replace(one, **crossed) for one in drive.joints)
    return replace(
        drive,
        joints=(first, replace(last, centre=tuple(POINTS[2]))),
        output=replace(drive.output, point=tuple(POINTS[3])),
        duty=replace(drive.duty, torque=TORQUE),
        **fields,
    )


def turned(yaw, pitch):
    """Return the points with the implement yawed, and pitched about the axis that yaws with it."""
    (cz, sz), (cy, sy) = (np.cos(yaw), np.sin(yaw)), (np.cos(pitch), np.sin(pitch))
    about = np.array(((cz, -sz, 0), (sz, cz, 0), (0, 0, 1))) @ np.array(((cy, 0, sy), (0, 1, 0), (-sy, 0, cy)))
    return np.vstack((POINTS[:2], PIVOT + (POINTS[2:] - PIVOT) @ about.T))


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def swing(normal, axis, pin):
    """Return the angle of the normal of a cross from the axis of a shaft, about the pin in the yoke of that shaft."""
    return np.arctan2(np.sum(np.cross(axis, normal) * pin, axis=-1), np.sum(axis * normal, axis=-1))


def rates(points):
    """Return damage and heat of the pins in both yokes of both joints a turn of the input, (2, 2) each.

    Damage: ∮|dδ| (Q/C)^(10/3), Q the couple of the cross over the span; heat: ∮|dδ| of the friction of both journals.
    """
    first, middle, last = unit(np.diff(points, axis=0))
    across = unit(np.cross(first, (0.0, 0.0, 1.0)))
    angle = np.arange(TURN + 1) * (2.0 * np.pi / TURN)
    pin = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * np.cross(first, across)
    torque, found = np.full(TURN + 1, TORQUE), []
    driven = unit(np.cross(middle, pin))
    out = unit(np.cross(last, driven))
    joints = ((first, middle, pin, driven), (middle, last, driven, out))
    for before, behind, fork, end in joints[::-1]:  # the torque is given at the output
        normal = unit(np.cross(fork, end))
        normal *= np.sign(normal @ before)[:, None]
        couple = torque / (normal @ behind)
        torque = couple * (normal @ before)
        load = np.abs(couple[:-1] + couple[1:]) / 2.0
        ways = [np.abs(np.diff(swing(normal, axis, one))) for axis, one in ((before, fork), (behind, end))]
        damage = [np.sum(way * (load / SPAN / CAPACITY) ** (10.0 / 3.0)) / (2.0 * np.pi) for way in ways]
        heat = [np.sum(way * load) * FRICTION * JOURNAL / SPAN for way in ways]
        found.append((damage, heat))
    return np.array(found[::-1]).swapaxes(0, 1)


def hours(damage):
    """Return how long the joint that fails first lasts [h]: a million turns by ISO 281, the worse of its yokes."""
    return 1e6 / np.max(damage) * 2.0 * np.pi / SPEED / hour


@pytest.fixture(scope="module")
def truth():
    """Return damage and heat as drawn, at the lock to the left, and as means over the movement."""
    phase = (np.arange(SWING) + 0.5) * (2.0 * np.pi / SWING)
    every = [rates(turned(YAW * np.sin(at), PITCH * np.sin(at + np.pi / 2.0))) for at in phase]
    return rates(POINTS), rates(turned(YAW, 0.0)), np.mean(every, axis=0)


def watts(heat):
    return np.sum(heat) * SPEED / (2.0 * np.pi)


@pytest.mark.slow
def test_the_life_is_that_of_the_whole_movement(truth):
    drive = hitch()
    drawn, lock, moving = (hours(one[0]) for one in truth)
    found = life(drive)
    # What friction adds to the load of a journal, 0.4 % of it at the lock, tires it by that to the power 10/3.
    assert found.drive / hour == pytest.approx(moving, rel=0.02)
    assert life(replace(drive, movements=())).drive / hour == pytest.approx(drawn, rel=0.02)
    assert (drawn, lock) == (pytest.approx(56768.0, rel=0.01), pytest.approx(8339.0, rel=0.01))
    assert lock < moving < 0.3 * drawn


@pytest.mark.slow
def test_the_joints_take_more_heat_over_the_movement_than_as_drawn(truth):
    drawn, _lock, moving = (watts(one[1]) for one in truth)
    found = losses(hitch())
    # Friction that acts on itself is left out of the oracle: 1 % of it times tan of the joint angle.
    assert found.heat == pytest.approx(moving, rel=0.01)
    assert found.drawn.heat == pytest.approx(drawn, rel=0.01)
    assert found.heat - found.drawn.heat == pytest.approx(114.0, rel=0.01)
    assert found.efficiency == pytest.approx(1.0 - moving / (TORQUE * SPEED), abs=1e-4)


def test_a_pose_at_the_lock_counts_by_its_share(truth):
    """A fifth of the time at the lock to the left, the rest as drawn."""
    points = turned(YAW, 0.0)
    set_to = (("joints[1].centre_mm", tuple(1e3 * points[2])), ("output.point_mm", tuple(1e3 * points[3])))
    drive = hitch(movements=(), poses=(Pose(name="lock", share=0.2, set=set_to),))
    assert [one.share for one in in_poses(drive)] == pytest.approx([0.8, 0.2])
    drawn, lock, _moving = truth
    damage, heat = 0.8 * drawn + 0.2 * lock
    assert life(drive).drive / hour == pytest.approx(hours(damage), rel=0.02)
    assert losses(drive).heat == pytest.approx(watts(heat), rel=0.01)
    assert losses(drive).efficiency < 1.0 - 0.9 * watts(heat) / (TORQUE * SPEED)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["life", "losses"])
def test_what_is_told_is_of_the_movement_and_says_so(name):
    drive, question = hitch(), QUESTIONS[name]
    found: Answer = gather(question, drive, question.answer(drive, question.ask(drive)))
    said = " ".join(told(one.text, Reader()) for one in found.remarks)
    assert "movement" in said
