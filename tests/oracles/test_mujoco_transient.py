"""Another program's dynamics: MuJoCo's bodies, hinges and pins swing in time as the torsional model does.

A flywheel turns in the world; the driving yoke turns on it against a torsional spring, the cross in the yoke, and a
pin of the cross holds the driven yoke, which drives a second flywheel through another spring. MuJoCo knows nothing of
angles of universal joints. Its pin is a stiff spring and the cross has to weigh something: what these and its steps of
first order leave is a few ten-thousandths of the swing.
"""

from __future__ import annotations

import numpy as np
import pytest

from cardan.questions.torsion.model.torsional_model import TorsionalModel, torsional_line
from cardan.questions.torsion.transient.transient import Adaptive, simulate

mujoco = pytest.importorskip("mujoco")

JOINT_ANGLE, SPEED, SPAN, STEP = 0.6, 40.0, 0.08, 1e-5
INERTIA, STIFFNESS, DAMPING, CROSS = (0.5, 0.04, 0.03, 0.3), (900.0, 700.0), (0.4, 0.3), 1e-6


def text(vector: object) -> str:
    return " ".join(repr(float(x)) for x in np.atleast_1d(vector))


def bodies(joint_angle: float) -> object:
    """Return the mechanism: shaft 1 along x, the driving yoke's arm along y, normal to the plane of the shafts."""
    second = np.asarray([np.cos(joint_angle), 0.0, np.sin(joint_angle)])
    # At the start the driven arm is normal to both the driving arm and the driven shaft.
    arm = np.cross(second, [0.0, 1.0, 0.0])

    def turning(name: str, axis: object, inertia: float, inside: str, spring: str = "") -> str:
        return (
            f'<body name="{name}"><joint name="{name}" type="hinge" axis="{text(axis)}" {spring}/>'
            f'<inertial pos="0 0 0" mass="1e-3" diaginertia="{text(np.full(3, inertia))}"/>{inside}</body>'
        )

    springs = [f'stiffness="{c}" damping="{b}"' for c, b in zip(STIFFNESS, DAMPING, strict=True)]
    cross = turning("cross", [0.0, 1.0, 0.0], CROSS, "")
    yoke = turning("yoke1", [1.0, 0.0, 0.0], INERTIA[1], cross, springs[0])
    first = turning("wheel1", [1.0, 0.0, 0.0], INERTIA[0], yoke)
    last = turning("yoke2", second, INERTIA[2], turning("wheel2", second, INERTIA[3], "", springs[1]))
    stiff = f'solref="{5.0 * STEP} 1" solimp="0.999 0.9999 0.001"'
    pin = f'<connect body1="cross" body2="yoke2" anchor="{text(arm)}" {stiff}/>'
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option timestep="{STEP}" gravity="0 0 0" jacobian="dense" solver="PGS" '
        f'iterations="100" tolerance="1e-12"/><worldbody>{first}{last}</worldbody><equality>{pin}</equality></mujoco>'
    )


def followed(joint_angle: float) -> np.ndarray:
    """Return the angles of wheel, yoke, yoke and wheel over the span in time."""
    model = bodies(joint_angle)
    data = mujoco.MjData(model)
    at = {name: model.joint(name).qposadr[0] for name in ("wheel1", "yoke1", "yoke2", "wheel2")}
    # The driving arm stands across the plane of the shafts: the driven yoke turns slower by cos α, the cross rests.
    data.qvel[at["wheel1"]] = SPEED
    data.qvel[at["yoke2"]] = SPEED * np.cos(joint_angle)
    data.qvel[at["wheel2"]] = SPEED * (1.0 - np.cos(joint_angle))
    found = []
    for _step in range(round(SPAN / STEP)):
        mujoco.mj_step(model, data)
        q = data.qpos.copy()
        found.append(
            [q[at["wheel1"]], q[at["wheel1"]] + q[at["yoke1"]], q[at["yoke2"]], q[at["yoke2"]] + q[at["wheel2"]]]
        )
    return np.asarray(found)


def line(joint_angle: float) -> TorsionalModel:
    return torsional_line(
        [INERTIA[:2], INERTIA[2:]],
        stiffness=[[STIFFNESS[0]], [STIFFNESS[1]]],
        damping=[[DAMPING[0]], [DAMPING[1]]],
        joint_angle=[joint_angle],
        phase=[0.5 * np.pi],
    )


def test_two_flywheels_swing_through_a_joint_as_mujocos_do() -> None:
    theirs = followed(JOINT_ANGLE)
    times = STEP * np.arange(1, len(theirs) + 1)
    mine = simulate(line(JOINT_ANGLE), span=SPAN, times=times, speed=SPEED, method=Adaptive(rtol=1e-8, atol=1e-9))
    twist = theirs[:, 0] - theirs[:, 1]
    assert np.ptp(twist) > 0.05, "the springs must be twisted"
    swing = np.max(np.abs(theirs - SPEED * times[:, None]))
    assert np.max(np.abs(mine.angle - theirs)) < 5e-4 * swing


def test_the_oracle_would_notice_a_joint_of_another_bend() -> None:
    theirs = followed(JOINT_ANGLE)
    mine = simulate(
        line(JOINT_ANGLE + 0.02), span=SPAN, times=np.asarray([SPAN]), speed=SPEED, method=Adaptive(rtol=1e-8)
    )
    swing = np.max(np.abs(theirs[-1] - SPEED * SPAN))
    assert np.max(np.abs(mine.angle[-1] - theirs[-1])) > 1e-2 * swing
