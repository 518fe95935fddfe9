"""Bodies of whole drives: closed, as large as their file says, and moved as the laws of their joints ask."""

import math

import numpy as np
import pytest

from cardan import joints as kinds
from cardan.drive.bodies.assembly import assembled
from cardan.drive.described import Input, Output
from cardan.drive.drive import Drive
from cardan.drive.joints.clemens import Circle, ClemensProfile, profile_contact
from cardan.drive.models.geometry import geometry
from cardan.drive.shaft import Segment, Shaft, Spline
from cardan.drive.station import Absorber, Pendulum, Station
from cardan.drive.support import Support
from cardan.maths.kernel import frames, meshes
from cardan.questions.motion.motion import motion
from tests.maths.kernel.test_meshes import closed

JOINT_ANGLE = math.radians(20.0)
KINDS = {
    "hooke": kinds.Hooke(joint_angle=JOINT_ANGLE),
    "offset": kinds.OffsetCross(joint_angle=JOINT_ANGLE, offset=0.03, reach=0.5),
    "double": kinds.DoubleCardan(joint_angle=1.5 * JOINT_ANGLE),
    "double with a ball": kinds.DoubleCardan(joint_angle=1.5 * JOINT_ANGLE, centring_ratio=0.45, ball_on="driven"),
    "constant velocity": kinds.ConstantVelocity(joint_angle=JOINT_ANGLE),
    "tracta": kinds.Tracta(joint_angle=JOINT_ANGLE),
    "rzeppa": kinds.Rzeppa(joint_angle=JOINT_ANGLE, driving_offset=0.005, driven_offset=0.0055, groove_radius=0.032),
    "weiss": kinds.Weiss(joint_angle=JOINT_ANGLE),
    "tripod": kinds.Tripod(joint_angle=JOINT_ANGLE, track_radius=0.02),
    "half": kinds.HalfCardan(joint_angle=0.08),
    "toothed half": kinds.HalfCardan(joint_angle=0.08, pairs=8),
    "elastic": kinds.ElasticHalfCardan(joint_angle=0.1, pairs=4),
    "pins": kinds.PinCoupling(joint_angle=JOINT_ANGLE, driving_distance=0.05, driven_distance=0.052),
    "clemens": kinds.Clemens(joint_angle=JOINT_ANGLE),
}

TRUCK = Drive(
    input=Input(point=(-0.3, 0.0, 0.0), start_phase=0.3),
    joints=tuple(kinds.Hooke(centre=centre) for centre in ((0.0, 0.0, 0.0), (1.02, 0.1, -0.07), (2.3, 0.0, -0.34))),
    output=Output(point=(2.7, 0.1, -0.36)),
    shafts=(
        Shaft(number=2, outer=0.1, wall=0.004, yoke_angle=0.4),
        Shaft(
            number=3,
            yoke_angle=-1.1,
            outer=0.1,
            wall=0.004,
            spline=Spline(position=0.4, teeth=16, outer=0.06, root=0.05, engaged=0.11, gap=0.06),
        ),
    ),
    supports=(
        Support(shaft=2, position=0.9, bore=0.05, stiffness=2e5),
        Support(shaft=4, position=0.2, axial=True, tilt=True),
    ),
    stations=(
        Station(shaft=1, end="start", inertia=0.5, absorber=Absorber(inertia=0.05, stiffness=10.0)),
        Station(shaft=4, position=0.3, inertia=0.2, pendulum=Pendulum(mass=0.1, radius=0.05, length=0.02, count=3)),
    ),
)


def world(build, track, point):
    """Return a point of a track's frame over the turn, array (p, 3), by the plain formula of a quaternion."""
    one = build.tracks[track]
    x, w = one.turn[:, :3], one.turn[:, 3:]
    point = np.broadcast_to(np.asarray(point, dtype=float), x.shape)
    return one.origin + point + 2.0 * w * np.cross(x, point) + 2.0 * np.cross(x, np.cross(x, point))


def parts(build, name):
    return [solid for solid in build.solids if solid.part == name]


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_is_made_of_closed_bodies_on_sound_tracks(name):
    build = assembled(Drive(joints=(KINDS[name],)), count=12)
    assert {solid.path.partition(".")[0] for solid in build.solids} >= {"joints[0]", "shafts[0]", "shafts[1]"}
    for solid in build.solids:
        assert meshes.volume(solid.surface) > 0.0, solid.part
        assert closed(solid.surface), solid.part
        assert np.all(np.isfinite(solid.surface.positions)), solid.part
    for track in build.tracks:
        # Roundings of a unit quaternion.
        np.testing.assert_allclose(np.linalg.norm(track.turn, axis=-1), 1.0, atol=1e-14)
        # Twelve frames a turn: no part turns by more than some 40 degrees from one to the next.
        assert np.all(np.sum(track.turn[1:] * track.turn[:-1], axis=-1) > math.cos(math.radians(20.0)))


def test_a_whole_drive_is_made_of_closed_bodies():
    build = assembled(TRUCK, count=4)
    assert {"spline sleeve", "spline shaft", "rubber", "bearing", "support", "station", "absorber", "collar"} <= {
        solid.part for solid in build.solids
    }
    for solid in build.solids:
        assert meshes.volume(solid.surface) > 0.0, solid.part
        assert closed(solid.surface), solid.part


def test_ears_of_both_yokes_hold_the_ends_of_the_cross_in_every_frame():
    drive = Drive.from_angles([0.3, 0.5, 0.2], plane_twists=[0.7, -2.0], yoke_angles=[0.4, -1.1], start_phase=0.3)
    build = assembled(drive, count=24)
    for i, solid in enumerate(parts(build, "cross")):
        radius = build.sizes.joints[i].radius
        for track, arm in ((build.ends[i + 1], (radius, 0.0, 0.0)), (build.starts[i + 2], (0.0, radius, 0.0))):
            ear, journal = world(build, track, (0.0, radius, 0.0)), world(build, solid.track, arm)
            np.testing.assert_allclose(ear, journal, atol=1e-13)


def test_shafts_turn_as_the_motion_says():
    mixed = Drive(joints=(KINDS["hooke"], KINDS["rzeppa"], KINDS["pins"], kinds.HalfCardan(joint_angle=0.06)))
    build = assembled(mixed, count=36)
    angle = motion(mixed, np.arange(36) * (2.0 * np.pi / 36)).shaft_angle
    for k in range(2, 6):
        axis = build.axis(k)
        across = world(build, build.starts[k], (0.0, 1.0, 0.0)) - build.centre(k - 2)
        expected = frames.rotate(np.broadcast_to(across[0], across.shape), axis, angle[k - 1])
        # Laws found by iteration leave some 1e-12.
        np.testing.assert_allclose(across, expected, atol=1e-10)


def test_sizes_of_the_file_are_the_sizes_of_the_bodies():
    build = assembled(TRUCK, count=4)
    tube = next(solid for solid in parts(build, "tube") if solid.number == 2)
    across = np.linalg.norm(tube.surface.positions[:, 1:], axis=-1)
    # A weld seam stands up by six hundredths of the radius.
    assert 0.05 <= float(np.max(across)) <= 0.0531
    assert float(np.min(across)) == pytest.approx(0.046, rel=1e-12)
    teeth = parts(build, "spline shaft")[0].surface.positions
    assert float(np.max(np.linalg.norm(teeth[:, 1:], axis=-1))) == pytest.approx(0.03, rel=1e-12)
    sleeve = parts(build, "spline sleeve")[0]
    length = float(geometry(TRUCK).length[2])
    there = teeth[:, 0] + (0.0 if parts(build, "spline shaft")[0].track == build.starts[3] else length)
    overlap = float(np.max(sleeve.surface.positions[:, 0])) - float(np.min(there))
    assert overlap == pytest.approx(0.11, rel=1e-9)
    assert float(np.min(there)) == pytest.approx(0.4 - 0.055, rel=1e-9)


def test_crosses_have_their_span_and_journals():
    from cardan.drive.cross import Cross

    cross = Cross(span=0.098, journal=0.024, journal_length=0.02)
    build = assembled(Drive(joints=(kinds.Hooke(joint_angle=0.2, cross=cross), kinds.Hooke(joint_angle=0.2))), count=4)
    size = build.sizes.joints[0]
    assert (size.radius, size.ear, size.journal, size.given) == (0.049, 0.02, 0.024, True)
    assert build.sizes.joints[1].radius == pytest.approx(0.049)
    assert not build.sizes.joints[1].given
    yoke = next(solid for solid in parts(build, "driving yoke") if solid.number == 1)
    assert float(np.max(yoke.surface.positions[:, 1])) == pytest.approx(0.059, rel=1e-12)


def test_stretches_keep_their_places():
    segments = (
        Segment(length=0.2, outer=0.05),
        Segment(length=0.6, outer=0.08, inner=0.07),
        Segment(length=0.2, outer=0.04),
    )
    drive = Drive(
        joints=(kinds.Hooke(joint_angle=0.1), kinds.Hooke(joint_angle=0.1)),
        shafts=(Shaft(number=2, length=1.0, segments=segments),),
    )
    build = assembled(drive, count=4)
    ends = [
        (float(np.min(s.surface.positions[:, 0])), float(np.max(s.surface.positions[:, 0])))
        for s in parts(build, "tube")
        if s.number == 2
    ]
    assert ends[1] == pytest.approx((0.2, 0.8))
    assert ends[0][1] == pytest.approx(0.2)
    assert ends[2][0] == pytest.approx(0.8)


def test_supports_stand_at_their_places_with_their_feet_on_the_floor_side():
    build = assembled(TRUCK, count=4)
    for number, support in enumerate(TRUCK.supports):
        place = build.centre(support.shaft - 2) + support.position * build.axis(support.shaft)
        bearing = next(s for s in parts(build, "bearing") if s.number == number + 1)
        np.testing.assert_allclose(np.mean(bearing.surface.positions, axis=0), place, atol=1e-12)
        foot = next(s for s in parts(build, "support") if s.number == number + 1).surface.positions
        assert place[2] - np.min(foot[:, 2]) > np.max(foot[:, 2]) - place[2]


def test_a_station_is_a_disc_of_steel_with_its_moment_of_inertia():
    build = assembled(TRUCK, count=4)
    disc = parts(build, "station")[0]
    radius = float(np.max(np.linalg.norm(disc.surface.positions[:, 1:], axis=-1)))
    # ½ m r² of a disc 0.3 r thick, about what a rim and a hub leave of it.
    assert 0.5 * 7850.0 * np.pi * 0.25 * radius**5 == pytest.approx(0.5, rel=1e-9)
    assert disc.text.startswith("station 1: 0.5 kg m²")


@pytest.mark.parametrize("name", ["double", "double with a ball"])
def test_the_second_cross_of_a_double_joint_stands_as_the_law_of_both_says(name):
    build = assembled(Drive(joints=(KINDS[name],)), count=24)
    crosses = parts(build, "cross")
    middle = world(build, crosses[1].track, (0.0, 0.0, 0.0))
    arm = world(build, crosses[1].track, (0.0, 1.0, 0.0)) - middle
    # A yoke is a line; a law and a chain of vectors agree to rounding.
    np.testing.assert_allclose(np.abs(frames.dot(arm, build.arms.driven[0])), 1.0, atol=1e-12)


def test_balls_stand_in_the_halving_plane_in_the_grooves_of_both_shafts():
    grooves = {"driving_offset": 0.004, "driven_offset": 0.004, "groove_radius": 0.03}
    build = assembled(Drive(joints=(kinds.Rzeppa(joint_angle=JOINT_ANGLE, **grooves),)), count=24)
    half = frames.unit(build.axis(1) + build.axis(2))
    for j, ball in enumerate(parts(build, "ball")):
        place = world(build, ball.track, (0.03, 0.0, 0.0)) - build.centre(0)
        np.testing.assert_allclose(place @ half, 0.0, atol=1e-15)
        for k, mark in ((1, build.arms.driving[0]), (2, build.arms.driven[0])):
            flat = frames.unit(place - (place @ build.axis(k))[:, None] * build.axis(k))
            turned = frames.rotate(mark, np.broadcast_to(build.axis(k), mark.shape), np.full(24, j * np.pi / 3.0))
            np.testing.assert_allclose(flat, turned, atol=1e-12)


def test_rollers_of_a_tripod_stay_in_the_straight_tracks_of_its_housing():
    build = assembled(Drive(joints=(KINDS["tripod"],)), count=24)
    for j, roller in enumerate(parts(build, "roller")):
        place = world(build, roller.track, (0.0, 0.0, 0.0)) - build.centre(0)
        flat = place - (place @ build.axis(1))[:, None] * build.axis(1)
        mark = build.arms.driving[0]
        turned = frames.rotate(mark, np.broadcast_to(build.axis(1), mark.shape), np.full(24, j * 2.0 * np.pi / 3.0))
        np.testing.assert_allclose(flat, 0.02 * turned, atol=1e-14)


def test_pins_touch_in_every_frame():
    build = assembled(Drive(joints=(KINDS["pins"],)), count=24)
    slant = math.pi / 4
    rows = []
    for track, start, sense in ((build.ends[1], -0.05, 1.0), (build.starts[2], 0.052, -1.0)):
        foot = world(build, track, (start, 0.0, 0.0))
        tip = world(build, track, (start + sense * math.cos(slant), math.sin(slant), 0.0))
        rows.append((foot, tip - foot))
    (one, d1), (two, d2) = rows
    apart = frames.dot(two - one, frames.unit(frames.cross(d1, d2)))
    np.testing.assert_allclose(apart, 0.0, atol=1e-12)


def test_arms_of_a_clemens_coupling_meet():
    side = ClemensProfile(axial=0.06, radial=0.01, radius=0.075)
    build = assembled(Drive(joints=(kinds.Clemens(joint_angle=JOINT_ANGLE, driving=side),)), count=24)
    tips = [world(build, arm.track, (0.075, 0.0, 0.0)) for arm in parts(build, "arm")]
    for one, two in zip(tips[:3], tips[3:], strict=True):
        np.testing.assert_allclose(one, two, atol=1e-14)
    u, normal = build.arms.driving[0], build.place.normal[0]
    theta = np.arctan2(u @ normal, u @ np.cross(normal, build.axis(1)))
    circle = Circle(axial=0.06, radial=0.01, radius=0.075)
    contact = profile_contact(theta, JOINT_ANGLE, circle, circle)
    # The contact of equal profiles, found by iteration on the circles themselves.
    np.testing.assert_allclose(
        frames.norm(tips[0] - build.centre(0)), np.hypot(contact.height1, contact.radius1), atol=1e-9
    )


def test_a_shaft_behind_an_offset_cross_passes_through_its_sliding_ball():
    joint = KINDS["offset"]
    build = assembled(Drive(joints=(joint,)), count=24)
    pin, on = (world(build, build.starts[2], (x, 0.0, 0.0)) for x in (0.0, 1.0))
    held = build.centre(0) + joint.reach * build.axis(2)
    np.testing.assert_allclose(frames.norm(frames.cross(on - pin, held - pin)), 0.0, atol=1e-14)
    np.testing.assert_allclose(frames.norm(pin - build.centre(0)), joint.offset, rtol=1e-12)


def test_a_slip_spline_takes_up_what_a_moved_drive_changes():
    points = np.asarray(geometry(TRUCK).points).copy()
    points[3] += (0.03, 0.0, 0.05)
    points[4] += (0.03, 0.0, 0.05)
    drawn, moved = assembled(TRUCK, count=4), assembled(TRUCK, count=4, points=points)
    for part in ("spline sleeve", "spline shaft"):
        one, other = parts(drawn, part)[0], parts(moved, part)[0]
        np.testing.assert_array_equal(one.surface.positions, other.surface.positions)
    np.testing.assert_allclose(moved.tracks[moved.ends[3]].origin, points[3], atol=1e-15)
    np.testing.assert_allclose(moved.tracks[moved.starts[3]].origin, points[2], atol=1e-15)


def test_the_first_yoke_stays_while_the_points_move_through_a_straight_line():
    drive = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, 0.05)], start_phase=0.4)
    found = []
    for height in (0.05, 1e-3, -1e-3, -0.05):
        points = np.asarray([(-1, 0, 0), (0, 0, 0), (1, 0, height)], dtype=float)
        found.append(assembled(drive, count=4, points=points).arms.driving[0, 0])
    np.testing.assert_allclose(np.stack(found), np.broadcast_to(found[0], (4, 3)), atol=1e-12)


def test_sizes_that_do_not_turn_are_shown_turning_evenly():
    stuck = Drive(joints=(kinds.PinCoupling(joint_angle=1.2, driving_slant=0.2),))
    build = assembled(stuck, count=4)
    assert np.all(np.isfinite(build.arms.driven))


def test_bodies_of_unusual_proportions_stay_sound():
    tight = Spline(position=0.02, outer=0.3, root=0.01, engaged=0.5, gap=0.5, teeth=3)
    drive = Drive(
        joints=(kinds.Hooke(joint_angle=1.4), kinds.Hooke(joint_angle=0.0)),
        shafts=(
            Shaft(number=1, outer=0.9),
            Shaft(number=2, length=0.1, outer=0.4, wall=0.2, spline=tight),
            Shaft(number=3, outer=0.002),
        ),
        supports=(Support(shaft=2, position=0.05, bore=0.5), Support(shaft=3, position=0.0, bore=0.001)),
        stations=(Station(shaft=1, end="start", inertia=1e-6), Station(shaft=3, end="end", inertia=1e3)),
    )
    for solid in assembled(drive, count=4).solids:
        assert meshes.volume(solid.surface) > 0.0, solid.part
        assert closed(solid.surface), solid.part
