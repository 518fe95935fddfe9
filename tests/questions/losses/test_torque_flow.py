import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan import Drive, motion
from cardan.questions.losses.loss_model import torque_flow
from cardan.sweeps import Drives
from tests.builders.drives import plans
from tests.builders.friction_model import torques

PLACES = np.linspace(0, 2 * np.pi, 17)


@pytest.mark.slow
@given(plans(most=5), st.sampled_from(["output", "input"]), st.sampled_from([1.0, -1.0]), st.sampled_from([1.0, -1.0]))
def test_torques_and_losses_are_those_of_plain_vectors(plan, at, load, sense):
    drag = [0.07, 0.0, 0.03, 0.1, 0.01][: len(plan.joint_angles)]
    found = torque_flow(motion(plan.drive, PLACES), np.asarray(drag), np.full(17, load), sense=sense, torque_at=at)
    plain = torques(plan.vectors, PLACES, drag, load=load, speed=sense, at=at)
    want = np.stack([np.broadcast_to(one, (17,)) for one in plain.shaft])
    # Five joints of 40° stretch rounding 1/cos times each, and a torque by as much.
    assert np.allclose(found.entering, want, rtol=1e-13, atol=0)
    assert np.allclose(found.leaving, want, rtol=1e-13, atol=0)
    for mine, other in ((found.driving_loss, plain.lost_driving), (found.driven_loss, plain.lost_driven)):
        assert np.allclose(mine, np.stack([np.broadcast_to(one, (17,)) for one in other]), rtol=0, atol=1e-13)


@given(plans(), st.sampled_from(["output", "input"]), st.sampled_from([1.0, -1.0]), st.integers(0, 2**32 - 1))
def test_power_balances_at_every_position_whatever_shafts_take(plan, at, sense, seed):
    """What enters less what leaves, shaft by shaft and joint by joint, is what is drawn and what is rubbed away."""
    random = np.random.default_rng(seed)
    n = len(plan.joint_angles)
    moved = motion(plan.drive, PLACES)
    drawn = random.normal(size=(n + 1, 17))
    flow = torque_flow(moved, np.full(n, 0.05), random.normal(size=17), drawn=drawn, sense=sense, torque_at=at)
    speed = sense * moved.shaft_ratio
    ends = flow.entering[0] * speed[0] - flow.leaving[-1] * speed[-1]
    rubbed = np.sum(flow.driving_loss + flow.driven_loss, axis=0)
    size = np.max(np.abs(flow.entering * speed))
    assert np.allclose(ends, rubbed + np.sum(drawn * speed, axis=0), rtol=0, atol=1e-13 * size)
    assert np.all(flow.driving_loss >= 0)
    assert np.all(flow.driven_loss >= 0)
    assert np.allclose(flow.entering - flow.leaving, drawn, rtol=0, atol=1e-13 * size)


@given(plans(), st.integers(0, 2**32 - 1))
def test_from_either_end_it_is_the_same_flow(plan, seed):
    random = np.random.default_rng(seed)
    n = len(plan.joint_angles)
    moved, drag, drawn = motion(plan.drive, PLACES), np.full(n, 0.04), random.normal(size=(n + 1, 17))
    one = torque_flow(moved, drag, random.normal(size=17), drawn=drawn)
    other = torque_flow(moved, drag, one.entering[0], drawn=drawn, torque_at="input")
    size = np.max(np.abs(one.entering))
    assert np.allclose(one.leaving, other.leaving, rtol=0, atol=1e-12 * size)
    assert np.allclose(one.couple, other.couple, rtol=0, atol=1e-12 * size)


def test_cases_and_drives_are_batches():
    drives = Drives.from_angles([[0.2, 0.3], [0.1, 0.4]])
    moved = motion(drives, PLACES)
    found = torque_flow(
        moved, np.asarray([[0.01, 0.02], [0.03, 0.04]]), np.ones((2, 17)), sense=np.asarray([1.0, -1.0])
    )
    one = torque_flow(motion(Drive.from_angles([0.1, 0.4]), PLACES), np.asarray([0.03, 0.04]), np.ones(17), sense=-1.0)
    assert np.allclose(found.entering[1], one.entering, rtol=1e-14)


def test_any_array_library_computes_them():
    drives = Drives.from_angles(strict.asarray([0.3, 0.2], dtype=strict.float64))
    moved = motion(drives, strict.asarray([0.0, 1.0], dtype=strict.float64))
    drag = strict.asarray([0.01, 0.02], dtype=strict.float64)
    found = torque_flow(moved, drag, strict.ones(2, dtype=strict.float64))
    plain = torque_flow(motion(Drive.from_angles([0.3, 0.2]), [0.0, 1.0]), np.asarray([0.01, 0.02]), np.ones(2))
    assert np.asarray(found.entering) == pytest.approx(plain.entering, rel=1e-14)
