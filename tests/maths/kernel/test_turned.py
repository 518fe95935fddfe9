"""One joint in place of a chain of them."""

from __future__ import annotations

import numpy as np
import pytest

from cardan.maths.kernel import composed_angle
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.model.torsional_model import torsional_line

JOINT_ANGLES, PHASES = np.asarray([0.4, 1.2, 0.2]), np.asarray([0.3, 1.2, -2.0])
RIGID = torsional_line([[1.0]] * 4, stiffness=[[]] * 4, joint_angle=JOINT_ANGLES, phase=PHASES)


@pytest.mark.parametrize("joints", [1, 2, 3])
def test_it_turns_like_the_chain_over_several_turns(joints: int) -> None:
    q = np.linspace(-8.0, 8.0, 101)
    wanted = places(RIGID, q[:, None])
    tau, c, s = composed_angle.equivalent(JOINT_ANGLES[:joints], PHASES[:joints])
    c2, s2 = composed_angle.waves(np.cos(2.0 * q), np.sin(2.0 * q), c, s)
    angle = q + composed_angle.angle_error(c2, s2, tau) - composed_angle.angle_error(c, s, tau)
    _x, _y, first, second = composed_angle.slopes(c2, s2, tau)
    # Ratios reach 2.8 here, their slopes 15: a few units in the last place of these.
    np.testing.assert_allclose(angle, wanted.angle[:, joints], atol=2e-14)
    np.testing.assert_allclose(first, wanted.first[:, joints], atol=2e-14)
    np.testing.assert_allclose(second, wanted.second[:, joints], atol=2e-13)


def test_straight_joints_do_nothing() -> None:
    tau, c, s = composed_angle.equivalent(np.zeros(3), np.asarray([0.1, 0.2, 0.3]))
    assert (float(tau), float(c), float(s)) == (0.0, 1.0, 0.0)


def test_many_chains_at_once() -> None:
    many = composed_angle.equivalent(np.stack((JOINT_ANGLES, JOINT_ANGLES[::-1])), np.stack((PHASES, PHASES)))
    for k, joint_angles in enumerate((JOINT_ANGLES, JOINT_ANGLES[::-1])):
        for one, all_of in zip(composed_angle.equivalent(joint_angles, PHASES), many, strict=True):
            assert float(all_of[k]) == pytest.approx(float(one), rel=1e-14)
