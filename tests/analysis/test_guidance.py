import numpy as np
import pytest

from cardan.analysis.guidance import arm, hitch
from cardan.errors import InputError
from cardan.units import deg


def test_hitch_irregularity_closed_form():
    yaw = np.linspace(-0.8, 0.8, 9)
    found = hitch(yaw, 0.1, before=0.3, behind=0.5)
    ratio = np.cos(found.bend[:, 0]) / np.cos(found.bend[:, 1])
    np.testing.assert_allclose(found.irregularity, 2.0 * np.sinh(np.abs(np.log(ratio))), rtol=1e-12)
    np.testing.assert_allclose(found.bend.sum(axis=-1), found.articulation, rtol=1e-13)
    with pytest.raises(InputError, match="before"):
        hitch(0.1, before=0.0, behind=1.0)
    with pytest.raises(InputError, match="90"):
        hitch(175 * deg, before=0.3, behind=1.0)


def test_hitch_is_even_at_every_yaw_and_pitch_only_when_the_pin_is_half_way():
    yaw, pitch = np.meshgrid(np.linspace(-0.9, 0.9, 7), np.linspace(-0.4, 0.4, 5))
    assert hitch(yaw, pitch, before=0.4, behind=0.4).irregularity.max() < 1e-14
    uneven = hitch(yaw, pitch, before=0.4, behind=0.41).irregularity
    assert np.all((uneven > 1e-5) | (np.abs(yaw) + np.abs(pitch) < 1e-12))


def test_yoke_angle_spoils_an_even_hitch():
    right = hitch(0.5, before=0.4, behind=0.4, yoke_angle=0.5 * np.pi).irregularity
    bend = 0.25
    # Worst phase: both joints add up, δ = 2 sinh(-2 ln cos α).
    assert right == pytest.approx(2.0 * np.sinh(-2.0 * np.log(np.cos(bend))), rel=1e-12)


def test_arm_at_many_angles_is_the_arm_at_each():
    given = {
        "joint": [0, 0, 0],
        "input_axis": [2, 0, 0],
        "pivot": [0.2, 0, -0.1],
        "axis": [0, 3, 0],
        "centre": [1.4, 0, -0.15],
        "output_axis": [1, 0, -0.03],
    }
    angles = np.asarray([-8.0, 0.0, 4.0]) * deg
    many = arm(angles, **given)
    for k, angle in enumerate(angles):
        one = arm(angle, **given)
        np.testing.assert_allclose(many.bend[k], one.bend, rtol=1e-14)
        np.testing.assert_allclose(many.irregularity[k], one.irregularity, rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(many.centre - [0.2, 0, -0.1], axis=-1), np.hypot(1.2, 0.05), rtol=1e-14)
