import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive, InputError, motion
from cardan.drive.models.kinematics_model import chain
from cardan.formulas.friction import Turning, joint_friction
from cardan.questions.losses.chain_friction import chain_friction, kinks, stance
from cardan.sweeps import Drives, stack
from cardan.units import deg
from tests.builders.drives import plans
from tests.builders.friction_model import over_a_turn, torques
from tests.builders.vector_model import dot

TURN = over_a_turn()


def drags(n):
    return st.lists(st.floats(0.0, 0.1), min_size=n, max_size=n)


@settings(max_examples=25)
@given(plans(most=5), st.sampled_from(["output", "input"]), st.booleans(), st.data())
def test_efficiency_and_heat_agree_with_couples_of_plain_vectors(plan, at, backwards, data):
    drag = data.draw(drags(len(plan.joint_angles)))
    found = chain_friction(plan.drive, drag, torque_at=at, backwards=backwards)
    plain = torques(plan.vectors, TURN, drag, load=-1.0 if backwards else 1.0, at=at)
    ends = [np.mean(np.broadcast_to(plain.shaft[k] * plain.speed[k], TURN.shape)) for k in (0, -1)]
    want = ends[0] / ends[1] if backwards else ends[1] / ends[0]
    # 20,000 places miss each kink by 1e-9 of its jump; five joints of 40° and κ to 0.1 keep it below 1e-8.
    assert float(found.efficiency) == pytest.approx(want, abs=1e-8)
    for mine, other in ((found.driving_loss, plain.lost_driving), (found.driven_loss, plain.lost_driven)):
        means = [np.mean(np.broadcast_to(one, TURN.shape)) for one in other]
        assert np.allclose(mine, means, rtol=0, atol=1e-8)
    assert found.status == Turning.FREE


@given(plans(), st.sampled_from(["output", "input"]), st.booleans())
def test_power_balances(plan, at, backwards):
    """In less out is heat, to rounding, each integrated by itself."""
    found = chain_friction(plan.drive, [0.05] * len(plan.joint_angles), torque_at=at, backwards=backwards)
    assert float(found.residual) < 2e-14


@given(plans(), st.floats(-3, 3))
def test_stance_is_that_of_the_motion(plan, angle):
    at = stance(chain(plan.drive), np.asarray([angle]))
    moved = motion(plan.drive, [angle])
    assert np.allclose(at.ratio, moved.shaft_ratio, rtol=0, atol=3e-14)
    assert np.allclose(at.driving, np.abs(np.tan(moved.cross_driving)), rtol=0, atol=3e-14)
    assert np.allclose(at.driven, np.abs(np.tan(moved.cross_driven)), rtol=0, atol=3e-14)


@given(plans(straight=False))
def test_crosses_stop_at_the_kinks(plan):
    model = plan.vectors
    for place, angle in enumerate(kinks(chain(plan.drive))):
        driving, driven = model.arms(angle)
        joint, side = divmod(place, 2)
        # θ = 0: the driven yoke stops in the cross; θ = π/2: the cross stops in the driving yoke.
        arm, axis = (driven, model.axes[joint]) if side == 0 else (driving, model.axes[joint + 1])
        assert abs(dot(arm[joint], axis)) < 3e-14


def test_one_joint_is_the_single_joint():
    for at in ("output", "input"):
        one = chain_friction(Drive.from_angles([33 * deg], start_phase=0.7), [0.04], torque_at=at)
        assert float(one.efficiency) == pytest.approx(float(joint_friction(33 * deg, 0.04, torque_at=at).exact))
        assert float(one.first_order) == pytest.approx(float(joint_friction(33 * deg, 0.04).first_order))


def test_coasting_is_the_mirrored_drive_driven():
    """Seen from its other end a symmetric drive is itself; the end where the torque is constant changes with it."""
    even = Drive.from_angles([30 * deg, 30 * deg])
    forth = chain_friction(even, [0.05, 0.05], torque_at="output")
    back = chain_friction(even, [0.05, 0.05], torque_at="input", backwards=True)
    assert float(forth.efficiency) == pytest.approx(float(back.efficiency), rel=1e-14)
    assert np.allclose(forth.driving_loss, back.driven_loss[::-1], rtol=1e-13)
    single = Drive.from_angles([30 * deg])
    ways = [float(chain_friction(single, [0.2], backwards=b).efficiency) for b in (False, True)]
    assert abs(ways[0] - ways[1]) > 1e-4


def test_padding_with_straight_joints_changes_nothing():
    short, long = Drive.from_angles([0.3]), Drive.from_angles([0.2, 0.3, 0.1], plane_twists=[0.5, 1.0])
    found = chain_friction(stack([short, long]), [[0.02, 0.5, 0.5], [0.01, 0.02, 0.03]])
    assert found.efficiency[0] == pytest.approx(float(chain_friction(short, [0.02]).efficiency), rel=1e-14)
    assert found.efficiency[1] == pytest.approx(float(chain_friction(long, [0.01, 0.02, 0.03]).efficiency), rel=1e-14)
    assert np.all(found.joint_loss[0, 1:] == 0.0)


def test_a_locked_drive_is_a_status_in_its_batch():
    drives = Drives.from_angles(np.asarray([[20.0, 20.0], [20.0, 60.0]]) * deg)
    found = chain_friction(drives, [0.1, 0.6])
    assert list(found.status) == [Turning.FREE, Turning.LOCKED]
    assert found.locked.tolist() == [[False, False], [False, True]]
    assert np.isnan(found.efficiency[1])
    assert 0 < found.efficiency[0] < 1
    assert np.all(np.isnan(found.joint_loss[1]))


def test_many_frictions_of_one_drive_are_a_batch():
    drive, many = Drive.from_angles([0.3, 0.2]), np.asarray([[0.0, 0.0], [0.01, 0.02], [0.1, 0.0]])
    found = chain_friction(drive, many)
    assert found.efficiency[0] == 1.0
    one = chain_friction(drive, many[1])
    assert found.efficiency[1] == pytest.approx(float(one.efficiency), rel=1e-14)
    assert np.allclose(found.joint_loss[1], one.joint_loss, rtol=1e-13)


@pytest.mark.parametrize("drag", [0.01, [0.01], [0.01, 0.02, 0.03]])
def test_each_joint_needs_its_friction(drag):
    with pytest.raises(InputError, match="2 needed") as caught:
        chain_friction(Drive.from_angles([0.3, 0.2]), drag)
    assert caught.value.field == "drag"


def test_any_array_library_computes_them():
    joint_angle = [[0.2, 0.3], [0.4, 0.1]]
    found = chain_friction(
        Drives.from_angles(strict.asarray(joint_angle, dtype=strict.float64)),
        strict.asarray([0.01, 0.02], dtype=strict.float64),
    )
    plain = chain_friction(Drives.from_angles(joint_angle), [0.01, 0.02])
    assert np.allclose(np.asarray(found.efficiency), plain.efficiency, rtol=1e-14)
