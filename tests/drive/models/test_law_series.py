"""What joints turn beside their nearest maps, at many joint angles at once, against their laws at each."""

from __future__ import annotations

import numpy as np
import pytest

from cardan.drive.drive import Drive
from cardan.drive.joints import JOINTS
from cardan.drive.models.kinematics_model import Chain, turning
from cardan.drive.models.law_series import beside_maps
from cardan.joints import Clemens
from tests.drive.joints.test_protocol import SHARP, UNEVEN


def chain(bends) -> Chain:
    """Return two joints at several joint angles, the same for both."""
    none, both = np.zeros((len(bends), 1)), np.stack([bends, bends], axis=-1)
    return Chain(joint_angle=both, plane_twist=none, yoke_angle=none, start_phase=np.zeros(len(bends)))


def pair(joint) -> Drive:
    """Return a drive of two such joints, as sharp as no file may have them."""
    drive = Drive.from_angles([0.1, 0.1])
    object.__setattr__(drive, "joints", (joint,) * 2)
    return drive


@pytest.mark.parametrize("kind", SHARP)
def test_sums_and_map_together_are_the_law(kind):
    """Of all bends at once, and of those asked before and anew."""
    sizes, steep = SHARP[kind]
    joint = JOINTS[kind](**sizes)
    theta = np.linspace(0.0, 6.2, 41)
    for bends in (np.radians(np.linspace(0.3, 0.8, 70) * min(steep, 60.0)), np.radians([30.0, 12.3, 0.3 * steep])):
        given = chain(bends)
        near = turning(given, (joint,) * 2, near=True)
        sums = beside_maps(pair(joint), given, near)
        for k in (0, 1, len(bends) - 1):
            tau = np.tan(0.5 * near.joint_angle[k, 0]) ** 2
            at = theta + near.laws.ahead[k, 0]  # the Hooke joint's yoke stands ahead of the mark
            hooke = np.arctan2(tau * np.sin(2.0 * at), 1.0 - tau * np.cos(2.0 * at))
            beside = 0.0 if sums is None else np.exp(1j * np.outer(at, np.arange(sums.shape[1]))) @ sums[k, :, 0]
            lead = joint.deviation(theta, np.asarray(bends[k]))[0]
            most = 1e-11 if np.any(beside) else 1.1e-6  # less than anybody can measure is left out
            assert np.abs(hooke + np.real(beside) - lead).max() < most


def test_a_law_is_asked_at_many_bends_at_once_and_once_for_each(monkeypatch):
    """Variants of a drive that moves ask for the same bends again and again."""
    asked = []
    law = Clemens.deviation
    monkeypatch.setattr(Clemens, "deviation", lambda self, *at: asked.append(np.size(at[1])) or law(self, *at))
    joint, given = Clemens(**UNEVEN["clemens"], mass=1.2345), chain(np.linspace(0.05, 0.6, 100))
    near = turning(given, (joint,) * 2, near=True)
    asked.clear()
    first = beside_maps(pair(joint), given, near)
    assert sum(asked) >= 100
    assert len(asked) <= 6
    asked.clear()
    assert np.array_equal(beside_maps(pair(joint), given, near), first)
    assert not asked
