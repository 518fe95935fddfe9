"""A mechanism as bodies that move: where its links stand at each frame."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.mechanisms import example_mechanism
from cardan.questions.mechanism.bodies import link_body
from cardan.scene.mechanism import mechanism_scene


def turned(track, frame, points):
    """Return points carried by a track, its quaternion written out."""
    x, y, z, w = track.turn[frame]
    axis = np.array([x, y, z])
    cross = np.cross(axis, points)
    return points + 2.0 * (w * cross + np.cross(axis, cross)) + track.origin[frame]


def test_links_stand_where_the_closed_form_has_them():
    shown = mechanism_scene(example_mechanism("crank-slider"))
    r, rod, drawn = 0.05, np.hypot(0.17, 0.04), np.arctan2(40, 30)
    pin, head = np.array([0.03, 0.04, 0.0]), np.array([0.2, 0.0, 0.0])
    for frame, angle in enumerate(shown.angle):
        a = drawn + angle
        tip = np.array([r * np.cos(a), r * np.sin(a), 0.0])
        end = np.array([tip[0] + np.sqrt(rod**2 - tip[1] ** 2), 0.0, 0.0])
        np.testing.assert_allclose(turned(shown.tracks[1], frame, pin), tip, atol=1e-12)
        np.testing.assert_allclose(turned(shown.tracks[2], frame, pin), tip, atol=1e-12)
        np.testing.assert_allclose(turned(shown.tracks[2], frame, head), end, atol=1e-12)
        np.testing.assert_allclose(turned(shown.tracks[3], frame, head), end, atol=1e-12)


def test_a_range_is_gone_to_and_fro():
    made = replace(example_mechanism("slot-cam"), input_range=(0.0, 0.5))
    shown = mechanism_scene(made)
    assert shown.angle[0] == 0.0
    assert shown.angle.max() == pytest.approx(0.5)
    assert shown.angle[-1] == pytest.approx(shown.angle[1])
    assert all(len(track.turn) == shown.angle.size for track in shown.tracks[1:])


def test_a_link_reaches_all_its_pairs():
    made = example_mechanism("maize-drive")
    for link in made.links:
        body = link_body(made, link).positions
        for pair in made.joints:
            if link in pair.links:
                assert (
                    np.min(np.linalg.norm(body - np.asarray(pair.point), axis=1)) < 0.06
                )  # a bar's radius and its pin
