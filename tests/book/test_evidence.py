"""The self-checks can fail, and hold where they should."""

import numpy as np
import pytest

from cardan.book import evidence as module
from cardan.book.evidence import evidence, ratio_by_vectors, swing_by_vectors
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import chain
from cardan.questions.motion.equivalence import closure
from cardan.questions.motion.motion import motion
from cardan.questions.phases.phases import phases
from cardan.units import deg

rng = np.random.default_rng(5)
DRIVES = [
    Drive.from_angles(
        rng.uniform(0, 40, n) * deg,
        plane_twists=rng.uniform(-3, 3, n - 1),
        yoke_angles=rng.uniform(-2, 2, n - 1),
        start_phase=1.0,
    )
    for n in (1, 2, 3, 5, 9)
] + [Drive.from_angles([0.0]), Drive.from_angles([0.3, 0.0, 0.3]), Drive.from_angles([80 * deg, 85 * deg])]
DRIVES.append(Drive.from_angles([89.9999999 * deg, 0.3]))


@pytest.mark.parametrize("drive", DRIVES)
def test_every_way_to_the_numbers_agrees(drive):
    for check in evidence(drive):
        assert check.passed, check


@pytest.mark.parametrize("drive", DRIVES[1:5])
def test_a_wrong_motion_is_found_out(drive, monkeypatch):
    def wrong(train, angle):
        found = motion(train, angle)
        return type(found)(**{**vars(found), "shaft_ratio": found.shaft_ratio * (1.0 + 1e-9)})

    monkeypatch.setattr(module, "motion", wrong)
    assert not all(check.passed for check in evidence(drive))


def test_ratio_of_vectors_has_the_extremes_of_one_joint():
    drive = Drive.from_angles([60 * deg])
    ratio = ratio_by_vectors(geometry(drive), chain(drive), [0.0, np.pi / 2])[-1]
    np.testing.assert_allclose(ratio, [2.0, 0.5], rtol=1e-14)


@pytest.mark.parametrize("drive", DRIVES[2:5])
def test_settings_of_the_synthesis_leave_what_they_say(drive):
    for one in phases(drive).settings:
        # Sampled every degree: the swing seen falls short by the curvature of the peaks, at most 1.5e-4 of it.
        assert swing_by_vectors(drive, one.yoke_angle) == pytest.approx(one.speed_fluctuation, rel=1e-3, abs=1e-13)


def test_closure_is_the_criterion_of_the_synthesis():
    for drive in DRIVES[2:5]:
        assert closure(drive).closes == phases(drive).feasible


def test_a_joint_bent_as_allowed_closes_exactly():
    found = closure(Drive.from_angles([0.1, 0.5, 0.2]))
    assert not found.closes
    left = phases(Drive.from_angles([0.1, found.joint_angle_allowed, 0.2]))
    assert left.speed_fluctuation_min < 1e-14
    assert not phases(Drive.from_angles([0.1, found.joint_angle_allowed + 1e-6, 0.2])).feasible
