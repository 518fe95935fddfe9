import numpy as np

from cardan.drive.joints.weiss import plane_tilt
from cardan.formulas.joint_geometry import groove_offset
from cardan.units import deg


def test_the_offset_uses_the_allowed_tilt_up():
    joint_angle, tilt, play = 40 * deg, np.asarray([0.1, 0.5, 3.0]) * deg, 0.1
    c = groove_offset(joint_angle, tilt, play)
    shifted = np.stack([plane_tilt(joint_angle, c + side * play, c) for side in (-1, -0.5, 0, 0.5, 1)])
    assert np.allclose(np.abs(shifted).max(axis=0), tilt, rtol=1e-12)
    assert np.all(np.abs(plane_tilt(joint_angle, 0.99 * c - play, 0.99 * c)) > tilt)
    assert groove_offset(joint_angle, 0.5 * deg, 0.0) == 0.0
