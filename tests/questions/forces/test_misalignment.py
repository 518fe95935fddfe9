import numpy as np
import pytest

from cardan.maths.kernel import frames
from cardan.questions.forces.support_statics import (
    Layout,
    actions,
    conditions,
    crosses,
    joint_gap,
    misalignment,
    sliding,
)

JOINT_ANGLES = np.deg2rad([0.0, 12.0, 35.0])
ANGLES = np.linspace(0.0, 2 * np.pi, 13)


def joint(joint_angle, angle):
    """One joint bent about -x, shaft 1 along z: its axes, and the arms of its cross at the angles."""
    axis = np.stack((np.eye(3)[2], np.asarray([0.0, np.sin(joint_angle), np.cos(joint_angle)])))
    driving = np.stack((-np.sin(angle), np.cos(angle), 0.0 * angle), axis=-1)
    driven = frames.unit(np.cross(axis[1], driving))
    return axis, driving[:, None], driven[:, None]


@pytest.mark.parametrize("joint_angle", JOINT_ANGLES)
def test_arms_turn_with_their_shafts(joint_angle):
    step = 1e-5
    axis, *here = joint(joint_angle, ANGLES)
    ahead, behind = joint(joint_angle, ANGLES + step)[1:], joint(joint_angle, ANGLES - step)[1:]
    found = crosses(axis, *here)
    for k, rate in enumerate((found.driving_rate, found.driven_rate)):
        # Central differences: 1e-16/1e-5 by rounding, (1e-5)² by the third derivative, both near 1e-11.
        np.testing.assert_allclose(rate, (ahead[k] - behind[k]) / (2 * step), atol=1e-9)


@pytest.mark.parametrize("joint_angle_deg", [10.0, 35.0])
def test_the_gap_is_what_free_slides_take_up(joint_angle_deg):
    # Book (171): with the slides free, s_i = C_i s_1 + Σ C_ij a_j along the driving and driven journals and shaft 2.
    errors = np.asarray([0.7, -0.4, 0.3, 0.9, -0.2])
    angle = np.deg2rad(40.0)
    axis, driving, driven = joint(np.deg2rad(joint_angle_deg), np.asarray([angle]))
    gap, _rate = joint_gap(axis, np.asarray([[-1.0, 0, 0]]), crosses(axis, driving, driven), errors[None])
    c, s, t = np.cos(np.deg2rad(joint_angle_deg)), np.sin(np.deg2rad(joint_angle_deg)), angle
    delta = np.sqrt(np.sin(t) ** 2 + (c * np.cos(t)) ** 2)
    rows = np.asarray(
        [
            [
                -2 * s * c * np.cos(t) / (2 * delta**2),
                -(s**2) * np.sin(2 * t) / (2 * delta**2),
                -s * np.cos(t) / delta,
                -1 / delta,
                -np.sin(t) / delta**2,
            ],
            [s * np.sin(t) / delta, -c / delta, 0.0, 0.0, -c * np.cos(t) / delta],
            [
                -c / delta**2,
                -s * np.sin(t) / delta**2,
                -1 / delta,
                -s * np.cos(t) / delta,
                -s * np.sin(2 * t) / (2 * delta**2),
            ],
        ]
    )
    slid = rows @ errors
    # The journals of that loop point the other way than the arms.
    taken = -slid[0] * driving[0, 0] - slid[1] * driven[0, 0] + slid[2] * axis[1]
    np.testing.assert_allclose(-gap[0, 0], taken, atol=1e-14)


def test_a_batch_of_drives_equals_single_ones():
    layout = Layout(
        joints=1,
        bearings=((0, ("radial", "axial")), (0, ("radial",)), (1, ("radial",)), (1, ("radial", "axial"))),
        slides=((True, False),),
    )
    soft = np.diag([0.0] * 3 + [1e-8] * 10)
    errors = 1e-5 * np.random.default_rng(8).normal(size=(3, 1, 5))
    parts = [joint(joint_angle, ANGLES) for joint_angle in JOINT_ANGLES[1:]]
    axis = np.stack([part[0] for part in parts])[:, None]
    length, place = np.ones((2, 1, 2)), np.asarray([0.1, 0.8, 0.2, 0.9]) * np.ones((2, 1, 1))
    arms = crosses(axis, *(np.stack([part[k] for part in parts]) for k in (1, 2)))
    normal = np.asarray([[-1.0, 0, 0]])
    gap = joint_gap(axis, normal, arms, errors[:2, None])
    many = misalignment(actions(axis, length, layout, place), layout, arms, soft, gap, np.zeros(13))
    assert many.unknowns.shape == (2, 13, 13)
    for k, part in enumerate(parts):
        one = crosses(*part)
        acting = actions(part[0], length[k, 0], layout, place[k, 0])
        alone = misalignment(acting, layout, one, soft, joint_gap(part[0], normal, one, errors[k]), np.zeros(13))
        for name in ("unknowns", "energy", "torque"):
            wanted = getattr(alone, name)
            np.testing.assert_allclose(getattr(many, name)[k], wanted, atol=1e-10 * np.max(np.abs(wanted)))


def test_nothing_acts_along_what_slides():
    layout = Layout(joints=1, bearings=((0, ("radial", "axial")),), slides=((False, True),))
    axis, driving, driven = joint(0.3, ANGLES)
    rows = sliding(layout, crosses(axis, driving, driven))
    assert rows.shape == (13, 1, 6)
    np.testing.assert_array_equal(rows[:, 0, :3], driven[:, 0])
    still = Layout(joints=1, bearings=layout.bearings)
    assert sliding(still, crosses(axis, driving, driven)) is None
    acting = actions(axis, np.ones(2), still, np.asarray([0.5]))
    assert conditions(acting, still, crosses(axis, driving, driven)).shape == (10, 6)
