import numpy as np
import pytest

from cardan.questions.forces.support_statics import Layout, actions, balance, shaft_flexibility

RNG = np.random.default_rng(21)
POINTS = np.asarray([[-0.4, 0, 0], [0, 0, 0], [0.7, 0.25, 0.1], [1.1, 0.3, 0.1]])
STEPS = np.diff(POINTS, axis=0)
LENGTH = np.linalg.norm(STEPS, axis=1)
AXIS = STEPS / LENGTH[:, None]
LAYOUT = Layout(
    joints=2,
    bearings=((0, ("radial", "axial")), (1, ("radial",)), (2, ("radial", "axial", "tilt"))),
    splines=(1,),
)
PLACE = np.asarray([0.1, 0.3, 0.2])
CUT = np.asarray([0.5])


@pytest.fixture
def acting():
    return actions(AXIS, LENGTH, LAYOUT, PLACE, CUT)


def test_unknowns_are_counted_by_what_holds():
    assert len(LAYOUT.unknowns) == 6 + 3 + 2 + 5
    assert LAYOUT.columns(2, "axial") == slice(13, 14)
    assert LAYOUT.unknowns[13] == (2, "axial")


def test_rows_are_the_plain_sums_of_forces_and_moments(acting):
    amount = RNG.normal(size=16)
    rows = balance(acting) @ amount
    joints, rest = amount[:6].reshape(2, 3), amount[6:]
    across = acting.across
    held = [
        (0, 0.1, rest[0] * across[0, 0] + rest[1] * across[0, 1] + rest[2] * AXIS[0], np.zeros(3)),
        (1, 0.3, rest[3] * across[1, 0] + rest[4] * across[1, 1], np.zeros(3)),
        (
            2,
            0.2,
            rest[5] * across[2, 0] + rest[6] * across[2, 1] + rest[7] * AXIS[2],
            rest[8] * across[2, 0] + rest[9] * across[2, 1],
        ),
    ]
    for s in range(3):
        loads = [(x, pull, turn) for shaft, x, pull, turn in held if shaft == s]
        if s:
            loads.append((0.0, joints[s - 1], np.zeros(3)))
        if s < 2:
            loads.append((LENGTH[s], -joints[s], np.zeros(3)))
        force = sum(pull for _x, pull, _turn in loads)
        moment = sum(turn + np.cross(x * AXIS[s], pull) for x, pull, turn in loads)
        here = rows[5 * s : 5 * s + 5]
        np.testing.assert_allclose(here[:2], across[s] @ force, atol=1e-14)
        np.testing.assert_allclose(here[3:], across[s] @ moment / LENGTH.mean(), atol=1e-14)
        ahead = sum((pull for x, pull, _turn in loads if s != 1 or x < CUT[0]), np.zeros(3))
        assert here[2] == pytest.approx(AXIS[s] @ ahead, abs=1e-14)
        if s == 1:
            assert rows[15] == pytest.approx(AXIS[s] @ (force - ahead), abs=1e-14)


def test_batches_equal_single_drives(acting):
    turn = np.linalg.qr(RNG.normal(size=(3, 3)))[0]
    both = actions(
        np.stack((AXIS, AXIS @ turn.T)),
        np.stack((LENGTH, LENGTH)),
        LAYOUT,
        np.stack((PLACE, PLACE)),
        np.stack((CUT, CUT)),
    )
    np.testing.assert_array_equal(balance(both)[0], balance(acting))
    single = actions(AXIS @ turn.T, LENGTH, LAYOUT, PLACE, CUT)
    np.testing.assert_allclose(balance(both)[1], balance(single), atol=1e-15)
    soft = np.asarray([[1e-4], [0.0], [2e-4]])
    np.testing.assert_allclose(
        shaft_flexibility(both, soft, soft)[1], shaft_flexibility(single, soft, soft), atol=1e-18
    )


def test_rigid_shafts_do_not_give_way(acting):
    assert not np.any(shaft_flexibility(acting, np.zeros((3, 1)), np.zeros((3, 1))))
