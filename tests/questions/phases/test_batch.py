"""Thousands of drives at once, judged by plain vectors."""

import array_api_strict
import numpy as np
import pytest

from cardan import Drive, InputError, phases
from cardan.drive.models.kinematics_model import Chain
from cardan.questions.phases.batch import synchronous_yokes
from cardan.sweeps import Drives, stack
from tests.builders import closing


def drives(n, count=3000, seed=0):
    random = np.random.default_rng(seed + n)
    return Drives.from_angles(
        random.uniform(0.02, 0.6, (count, n)),
        plane_twist=random.uniform(-3, 3, (count, n - 1)),
        yoke_angle=random.uniform(-3, 3, (count, n - 1)),
    )


@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize("n", range(1, 7))
def test_the_bound_is_reached_in_plain_vectors(n, mirror):
    many = drives(n)
    found = synchronous_yokes(many, mirror=mirror)
    uneven = closing.speed_fluctuation(many.chain.joint_angle, many.chain.plane_twist, found.yoke_angle)
    # bends to 34°: ratios to 3 in a chain of six, each sampled with a few roundings
    assert np.abs(uneven - found.speed_fluctuation_min).max() < 3e-14
    assert np.abs(found.speed_fluctuation - found.speed_fluctuation_min).max() < 1e-14
    length = -np.log(np.cos(many.chain.joint_angle))
    gap = 2 * length.max(axis=-1) - length.sum(axis=-1)
    clear = np.abs(gap) > 1e-12
    assert (found.feasible == (gap < 0))[clear].all()


@pytest.mark.parametrize("n", range(2, 7))
def test_a_batch_gives_what_single_drives_give(n):
    """Not bit for bit: a single drive runs on Python's sinh and atan2, a batch on NumPy's, which differ by a digit."""
    many = drives(n, 40)
    together = synchronous_yokes(many)
    for row in range(40):
        chain = many.chain
        one = synchronous_yokes(
            Chain(
                joint_angle=chain.joint_angle[row],
                plane_twist=chain.plane_twist[row],
                yoke_angle=chain.yoke_angle[row],
                start_phase=chain.start_phase[row],
            )
        )
        # a stretched corner shows the root of the last digit
        assert np.abs(np.sin(one.yoke_angle - together.yoke_angle[row])).max() < 1e-6
        assert float(one.speed_fluctuation) == pytest.approx(float(together.speed_fluctuation[row]), abs=1e-14)
        assert bool(one.feasible) == bool(together.feasible[row])


def test_a_batch_does_not_depend_on_its_size():
    """Array operations treat elements alike up to the last digit of vectorised and scalar loops."""
    many = drives(5, 64)
    whole = synchronous_yokes(many)
    half = Drives.from_angles(many.chain.joint_angle[:7], plane_twist=many.chain.plane_twist[:7])
    part = synchronous_yokes(half)
    assert np.abs(np.sin(whole.yoke_angle[:7] - part.yoke_angle)).max() < 1e-6


@pytest.mark.slow
def test_agrees_with_the_single_answer():
    many = drives(4, 30)
    found = synchronous_yokes(many)
    for row in range(30):
        drive = Drive.from_angles(many.chain.joint_angle[row], plane_twists=many.chain.plane_twist[row])
        best = phases(drive)
        assert best.feasible == bool(found.feasible[row])
        assert best.speed_fluctuation_max == pytest.approx(float(found.speed_fluctuation_max[row]), rel=1e-13)


def test_padding_changes_nothing():
    short = Drive.from_angles([0.2, 0.25, 0.3], plane_twists=[0.3, 0.4])
    long = Drive.from_angles([0.2, 0.25, 0.3, 0.2, 0.1], plane_twists=[0.3, 0.4, 0.5, 0.6])
    found = synchronous_yokes(stack([short, long]))
    alone = synchronous_yokes(short)
    assert np.abs(np.sin(found.yoke_angle[0, :2] - alone.yoke_angle)).max() < 1e-7
    assert found.speed_fluctuation.max() < 1e-14


def test_held_yokes_stay_as_each_drive_has_them():
    many = drives(5, 500)
    found = synchronous_yokes(many, fixed=(3, 4))
    kept = found.yoke_angle[:, 1:3] - many.chain.yoke_angle[:, 1:3]
    assert np.abs(np.sin(kept)).max() < 1e-14
    uneven = closing.speed_fluctuation(many.chain.joint_angle, many.chain.plane_twist, found.yoke_angle)
    assert np.abs(uneven - found.speed_fluctuation_min).max() < 3e-14
    for row in range(5):
        drive = Drive.from_angles(
            many.chain.joint_angle[row],
            plane_twists=many.chain.plane_twist[row],
            yoke_angles=many.chain.yoke_angle[row],
        )
        best = phases(drive, fixed={k: many.chain.yoke_angle[row, k - 2] for k in (3, 4)})
        assert best.speed_fluctuation_min == pytest.approx(float(found.speed_fluctuation_min[row]), abs=1e-14)


def test_runs_on_any_array_library():
    many = drives(5, 20)
    strict = Drives.from_angles(
        array_api_strict.asarray(many.chain.joint_angle), plane_twist=array_api_strict.asarray(many.chain.plane_twist)
    )
    found = synchronous_yokes(strict)
    uneven = closing.speed_fluctuation(many.chain.joint_angle, many.chain.plane_twist, np.asarray(found.yoke_angle))
    assert np.abs(uneven - np.asarray(found.speed_fluctuation_min)).max() < 3e-14


def test_wrong_shafts_and_weights_are_named():
    with pytest.raises(InputError) as caught:
        synchronous_yokes(drives(3, 2), fixed=(1, 2), weights=[1.0])
    assert [p.field for p in caught.value.problems] == ["fixed[0]", "weights"]
