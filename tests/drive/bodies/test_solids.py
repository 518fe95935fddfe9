"""Bodies of a drive: closed surfaces, in the right places, yokes at the angles the drive says."""

from itertools import pairwise

import numpy as np
import pytest

from cardan import example
from cardan.catalogue.completion import sized
from cardan.drive.bodies.assembly import assembled
from cardan.drive.bodies.solids import arms, solids
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import chain
from cardan.maths.kernel import frames
from cardan.questions.motion.motion import initial_phases, motion
from cardan.units import deg

DRIVE = Drive.from_angles([0.2, 0.3, 0.25], plane_twists=[0.7, -2.0], yoke_angles=[0.4, -1.1], start_phase=0.3)


@pytest.mark.slow
@pytest.mark.parametrize(
    "drive",
    [DRIVE, Drive.from_angles([0.0]), Drive.from_points([[0, 0, 0], [0.01, 0, 0], [1, 0, 0.1], [1.02, 0, 0.1]])],
)
def test_surfaces_are_closed_and_turned_outwards(drive):
    for body in solids(drive).bodies:
        corners = body.corners - body.corners.mean(axis=0)
        by_triangles = sum(np.dot(corners[a], np.cross(corners[b], corners[c])) for a, b, c in body.triangles)
        by_faces = sum(
            np.dot(corners[face[0]], np.cross(corners[i], corners[j]))
            for face in body.faces
            for i, j in pairwise(face[1:])
        )
        assert by_triangles > 0.0
        assert by_triangles == pytest.approx(by_faces, rel=1e-9)
        edges = {(a, b) for face in body.faces for a, b in zip(face, (*face[1:], face[0]), strict=True)}
        assert edges == {(b, a) for a, b in edges}


def test_yokes_stand_at_the_yoke_angles_of_the_drive():
    place, train = geometry(DRIVE), chain(DRIVE)
    found = arms(place, train)
    for k in (1, 2):
        angle = frames.angle_about(place.axis[k], found.driving[k], found.driven[k - 1])
        assert float(np.sin(angle - train.yoke_angle[k - 1])) == pytest.approx(0.0, abs=1e-14)


def test_driving_yokes_start_at_the_phase_angles_of_the_motion():
    place, train = geometry(DRIVE), chain(DRIVE)
    psi = initial_phases(DRIVE)
    for i, u in enumerate(arms(place, train).driving):
        in_plane = np.cross(place.normal[i], place.axis[i])
        angle = frames.angle_about(place.axis[i], in_plane, u)
        assert float(np.sin(angle - psi[i])) == pytest.approx(0.0, abs=1e-13)


def test_arms_turn_as_the_motion_says_and_crosses_stay_square():
    place, train = geometry(DRIVE), chain(DRIVE)
    phi = np.linspace(0.0, 2.0 * np.pi, 13)
    found = arms(place, train, phi)
    np.testing.assert_allclose(frames.dot(found.driving, found.driven), 0.0, atol=1e-15)
    turned = motion(DRIVE, phi).shaft_angle
    for i in range(3):
        start = found.driven[i, 0]
        expected = frames.rotate(np.broadcast_to(start, (13, 3)), place.axis[i + 1], turned[i + 1])
        # A yoke is a line: compare up to sign. Some ten roundings of turns of six radians.
        np.testing.assert_allclose(np.abs(frames.dot(expected, found.driven[i])), 1.0, atol=1e-13)


@pytest.mark.parametrize("name", ["truck-supports", "car-propshaft", "pto-drive"])
def test_pictures_are_as_large_as_the_bodies_that_turn(name):
    drive = sized(example(name))
    turning, seen = assembled(drive, count=4), solids(drive)

    def reach(part, number):
        whole = [one for one in turning.solids if one.part == part and one.number == number]
        return max(float(np.max(np.linalg.norm(one.surface.positions[:, 1:], axis=1))) for one in whole)

    for body in seen.bodies:
        if body.part == "tube":
            k = body.number - 1
            spread = body.corners - seen.place.points[max(k, 1)]
            radius = float(np.max(np.linalg.norm(np.cross(spread, seen.place.axis[k]), axis=1)))
            assert radius == pytest.approx(turning.body_radius(body.number), rel=1e-9)
        elif body.part == "driven yoke":
            k = body.number - 1
            spread = body.corners - seen.place.points[k]
            radius = float(np.max(np.linalg.norm(np.cross(spread, seen.place.axis[k]), axis=1)))
            # Ears are round outside on the one and square on the other, as thick as they are wide.
            assert radius == pytest.approx(reach("driven yoke", body.number), rel=0.2)
    ends = np.linalg.norm(seen.ends - seen.centres[[0, -1]], axis=1)
    np.testing.assert_allclose(ends, turning.sizes.ends, rtol=1e-9)


def test_a_single_yoke_angle_turns_the_picture():
    turned = Drive.from_angles([0.2, 0.2], yoke_angles=[90 * deg])
    straight = Drive.from_angles([0.2, 0.2])
    one, two = (arms(geometry(d), chain(d)).driving[1] for d in (turned, straight))
    assert abs(float(np.dot(one, two))) < 1e-12
