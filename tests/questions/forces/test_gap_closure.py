"""Clearances that open, against dense sampling and the book's case of a single joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.book.single_joint import joint_extremes
from cardan.drive.models.geometry import points_from_angles
from cardan.drive.models.train import train_of_points
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.gap_closure import gap_closure
from tests.builders.trains import one, trains

DENSE = np.arange(72000) * (np.pi / 36000)


def test_a_single_joint_needs_what_the_largest_acceleration_takes() -> None:
    """Book (122) but for where it is largest: T = (M + J ε)/(n·e) keeps its sign when M exceeds the largest -J ε."""
    joint_angle = 30 * np.pi / 180
    points = points_from_angles(np.asarray([joint_angle]), np.zeros(0), np.ones(2))
    single = train_of_points(points, inertia=np.asarray([3.0, 0.05]))
    found = gap_closure(single, load=1.0, speed=150.0)
    wanted = 0.05 * 150.0**2 * joint_extremes(np.asarray(joint_angle)).acceleration
    assert found.load_needed == pytest.approx(float(wanted), rel=1e-10)


@pytest.mark.parametrize("n", [2, 4])
def test_least_couples_and_openings_are_those_of_dense_samples(n: int) -> None:
    drive = one(trains(np.random.default_rng(n), n, (1,)), 0)
    drive = replace(drive, cross_inertia=None, resisting_torque=None, bearings=())
    found = gap_closure(drive, load=60.0, speed=120.0)
    couple = kinetostatics(drive, DENSE, torque=60.0, speed=120.0).joint_torque
    swing = np.ptp(couple, axis=-1)
    np.testing.assert_array_less(np.abs(found.least_couple - couple.min(axis=-1)), 1e-7 * swing)
    np.testing.assert_allclose(found.open_share, np.mean(couple < 0.0, axis=-1), atol=1e-4)
    assert found.closed == bool(np.all(couple > 0.0))
    for k, angles in enumerate(found.openings):
        at = kinetostatics(drive, angles, torque=60.0, speed=120.0).joint_torque[k] if angles.size else np.zeros(1)
        assert np.abs(at).max() < 1e-9 * swing[k]


@pytest.mark.parametrize(("share", "closed"), [(1.0001, True), (0.9999, False)])
def test_the_load_needed_just_closes_all_joints(share: float, closed: bool) -> None:
    drive = one(trains(np.random.default_rng(7), 3, (1,)), 0)
    drive = replace(drive, resisting_torque=None)
    needed = gap_closure(drive, load=0.0, speed=100.0).load_needed
    found = gap_closure(drive, load=share * needed, speed=100.0)
    assert found.closed is closed
    assert (max(angles.size for angles in found.openings) == 0) == closed


def test_a_load_the_other_way_mirrors_the_drive() -> None:
    """A load that resists turning backwards presses all joints the other way, and as firmly at the mirrored inertia."""
    drive = one(trains(np.random.default_rng(7), 3, (1,)), 0)
    drive = replace(drive, resisting_torque=None)
    needed = gap_closure(replace(drive, inertia=-drive.inertia), load=0.0, speed=100.0).load_needed
    for share, closed in ((1.0001, True), (0.9999, False)):
        found = gap_closure(drive, load=-share * needed, speed=100.0)
        assert found.closed is closed
        assert (float(np.max(found.open_share)) == 0.0) == closed
        assert np.all(found.least_couple < 0.0)
