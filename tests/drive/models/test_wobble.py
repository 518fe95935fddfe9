from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from cardan import Drive, motion
from cardan.drive.joints import Hooke
from cardan.drive.joints.tripod import orbit_radius, pivot_error
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import turning_chain
from cardan.drive.models.wobble import course, wobbles, wobbling
from cardan.drive.shaft import Spline
from cardan.errors import InputError
from cardan.joints import ConstantVelocity, OffsetCross, PinCoupling, Rzeppa, Tracta, Tripod
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.questions.mobility.finite_mobility import finite_mobility
from cardan.questions.motion.turning import each_shaft
from cardan.units import deg, mm


def chain(joints, *, twist=60 * deg, yoke=-60 * deg, length=None, spline=None):
    """Return a drive of two joints."""
    drive = Drive.from_angles([joints[0].joint_angle, joints[1].joint_angle], plane_twists=[twist], yoke_angles=[yoke])
    named = tuple(replace(one, plane_twist=old.plane_twist) for one, old in zip(joints, drive.joints, strict=True))
    shafts = tuple(replace(one, length=length, spline=spline) if one.number == 2 else one for one in drive.shafts)
    return replace(drive, joints=named, shafts=shafts)


def crosses(reach, side="near", **given):
    joint = OffsetCross(joint_angle=28 * deg, offset=20 * mm, reach=reach, pin_side=side)
    return chain((joint, joint), **given)


@pytest.mark.parametrize(
    ("reach", "side", "share", "error"),
    [
        (0.2, "far", 0.036146, 0.51251),
        (0.2, "near", 0.041355, 0.58506),
        (0.1, "far", 0.067907, 0.96347),
        (0.1, "near", 0.088890, 1.25518),
    ],
)
def test_a_pair_that_would_be_exact_is_not_behind_a_shaft_that_wobbles(reach, side, share, error):
    # by plain vectors at 3601 places: pin 2 = a2 x pin 1, the shaft from pin 2 to its ball, the next pin on it
    found = each_shaft(crosses(reach, side))
    assert found.speed_fluctuation[-1] == pytest.approx(share, rel=2e-5)
    assert found.max_angle_error[-1] / deg == pytest.approx(error, rel=3e-5)


def row(vector):
    return tuple(float(x) for x in vector)


@pytest.mark.parametrize(("reach", "length"), [(0.2, 0.3), (0.1, 0.15)])
@pytest.mark.parametrize("side", ["near", "far"])
def test_two_offset_crosses_turn_as_their_closed_loops(side, reach, length):
    drive = crosses(reach, side, length=length)
    place, count = geometry(drive), 40
    angle = np.linspace(0.0, 2.0 * np.pi, count + 1)
    found = course(drive, angle)
    (o1, o2) = (found.centre[k, 0] for k in range(2))
    (s1, s2) = (place.points[k + 1] + reach * place.axis[k + 1] for k in range(2))
    pins = [
        Pair(id=f"{k}{side}", type="R", links=links, point=row(point), axis=row(axis))
        for k, links, point, axis in (
            ("bearing", ("frame", "1"), place.points[1], place.axis[0]),
            ("a", ("1", "c"), o1, found.driving[0, 0]),
            ("b", ("c", "2"), found.start[0, 0], found.driven[0, 0]),
            ("c", ("2", "d"), o2, found.driving[1, 0]),
            ("d", ("d", "3"), found.start[1, 0], found.driven[1, 0]),
        )
    ]
    balls = [
        Pair(id=f"ball {k}", type="SG", links=(f"{k + 2}", "frame"), point=row(at), axis=row(found.axis[k + 1, 0]))
        for k, at in enumerate((s1, s2))
    ]
    moved = finite_mobility(
        Mechanism(frame="frame", input_link="1", joints=(*pins, *balls)), angle=2.0 * np.pi, steps=count
    )
    assert moved.closes
    shaft = moved.displacement[:, moved.mechanism.links.index("3"), :3, :3]
    axis, mark = (np.einsum("tij,j->ti", shaft, one[1, 0]) for one in (found.axis[1:], found.driven))
    assert np.max(np.abs(axis - found.axis[2])) < 1e-9
    assert np.max(np.abs(mark - found.driven[1])) < 1e-9


def test_the_next_joint_is_carried_around_beyond_the_ball():
    (first, second) = wobbles(crosses(0.2, length=0.5))
    assert first.nutation == pytest.approx(
        0.02 * np.sin(28 * deg) / 2 / (0.2 - 0.019), rel=0.08
    )  # first order, in the middle of its turn
    assert first.way == pytest.approx(0.3 * first.nutation, rel=0.02)
    assert second.joint == 1
    assert all(one.way == 0.0 for one in wobbles(crosses(0.2, length=0.2)))


def test_a_spline_keeps_the_next_joint_where_it_is_along_the_shaft():
    drive = crosses(0.2, length=0.5, spline=Spline())
    found, place = course(drive, np.linspace(0.0, 6.0, 50)), geometry(drive)
    along = (found.centre[1] - place.points[2]) @ place.axis[1]
    assert np.max(np.abs(along)) < 1e-12
    bare = course(crosses(0.2, length=0.5), np.linspace(0.0, 6.0, 50))
    assert np.ptp((bare.centre[1] - place.points[2]) @ place.axis[1]) > 1 * mm


ALPHA, TRACK, LENGTH = 20 * deg, 20 * mm, 300 * mm


def test_the_shaft_of_a_tripod_pivots_on_the_next_joint():
    drive = chain((Tripod(joint_angle=ALPHA, track_radius=TRACK), ConstantVelocity(joint_angle=0.0)), length=LENGTH)
    found = motion(drive)
    wave = np.fft.rfft(found.angle_error[-1][:-1]) / 180.0
    assert np.abs(wave[3]) == pytest.approx(float(pivot_error(ALPHA, TRACK, LENGTH)), rel=3e-3)
    assert np.argmax(np.abs(wave[1:])) == 2
    (only,) = wobbles(drive)
    assert only.nutation == pytest.approx(float(orbit_radius(ALPHA, TRACK)) / LENGTH, rel=1e-3)


def test_the_shaft_of_a_tripod_lies_where_its_rollers_run():
    drive = chain((Tripod(joint_angle=ALPHA, track_radius=TRACK), ConstantVelocity(joint_angle=0.0)), length=LENGTH)
    place, angle = geometry(drive), np.linspace(0.0, 6.0, 13)
    found = course(drive, angle)
    tracks = [TRACK * _about(found.driving[0], place.axis[0], k * 120 * deg) for k in range(3)]

    def missed(state, j):
        axis = place.axis[1] + state[0] * place.normal[0] + state[1] * np.cross(place.normal[0], place.axis[1])
        axis /= np.linalg.norm(axis)
        head = place.points[2] - LENGTH * axis
        arm = np.cross(np.cross(axis, found.driven[0, j]), axis)
        arm /= np.linalg.norm(arm)
        rest = []
        for k in range(3):
            way = _about(arm[None], axis, k * 120 * deg + state[2])[0]
            start = place.points[1] + tracks[k][j]
            point = start + place.axis[0] * ((head - start) @ axis) / (place.axis[0] @ axis)
            rest.append((point - head) @ np.cross(axis, way) / TRACK)
        return rest, axis

    for j in range(len(angle)):
        solved = least_squares(lambda state, j=j: missed(state, j)[0], np.zeros(3), xtol=1e-15, ftol=1e-15, gtol=1e-15)
        assert np.max(np.abs(solved.fun)) < 1e-12
        # the spider's plane passes the centre here, where really the shaft keeps its length: second order of the tilt
        assert np.max(np.abs(missed(solved.x, j)[1] - found.axis[1, j])) < 5e-6
        assert abs(solved.x[2]) < 5e-6


def _about(vectors, axis, angle):
    along = (vectors @ axis)[:, None] * axis
    return along + (vectors - along) * np.cos(angle) + np.cross(axis, vectors) * np.sin(angle)


KINDS = (
    Hooke(joint_angle=20 * deg),
    Tracta(joint_angle=25 * deg, driving_distance=20 * mm, driven_distance=23 * mm),
    PinCoupling(
        joint_angle=15 * deg, driving_slant=44 * deg, driven_slant=45 * deg,
        driving_distance=40 * mm, driven_distance=41 * mm,
    ),
    Rzeppa(joint_angle=30 * deg, driving_offset=3 * mm, driven_offset=4 * mm, groove_radius=30 * mm, balls=5),
    OffsetCross(joint_angle=12 * deg, offset=0.0, reach=0.3),
)  # fmt: skip


@pytest.mark.parametrize("first", KINDS, ids=lambda one: one.kind)
@pytest.mark.parametrize("second", KINDS, ids=lambda one: one.kind)
def test_shafts_that_do_not_wobble_turn_as_they_do_joint_by_joint(first, second):
    drive = chain((first, second), twist=40 * deg, yoke=25 * deg, length=0.4)
    assert wobbling(drive) == ()
    angle = np.linspace(0.0, 6.0, 400)
    known = motion(drive, angle)
    found = course(drive, angle)
    turned = np.unwrap(found.turned) - found.turned[:, :1]
    assert np.max(np.abs(turned - known.shaft_angle)) < 1e-12
    assert np.max(np.abs(np.exp(1j * found.theta) - np.exp(1j * known.yoke_rotation))) < 1e-12


def test_ratio_and_slope_are_the_derivatives_of_the_angle():
    drive = crosses(0.15, length=0.25)
    step = 1e-4
    angle = np.linspace(0.0, 6.0, 9)
    ahead, here, behind = (motion(drive, angle + shift) for shift in (step, 0.0, -step))
    rise = (ahead.shaft_angle - behind.shaft_angle) / (2.0 * step)
    assert np.allclose(rise, here.shaft_ratio, atol=1e-7)
    assert np.allclose((ahead.shaft_ratio - behind.shaft_ratio) / (2.0 * step), here.shaft_slope, atol=1e-6)


@pytest.mark.parametrize("kind", ["clemens", "rzeppa"])
def test_a_joint_of_its_own_law_feels_a_shaft_that_wobbles(kind):
    second = KINDS[3] if kind == "rzeppa" else KINDS[2]
    still, moved = (
        motion(chain((OffsetCross(joint_angle=20 * deg, offset=offset, reach=0.2), second), length=0.2))
        for offset in (0.0, 10 * mm)
    )
    assert np.ptp(moved.ratio) != pytest.approx(np.ptp(still.ratio), rel=1e-3)
    assert np.array_equal(moved.joint_angle, still.joint_angle)


def test_no_hooke_joints_stand_for_a_shaft_that_wobbles():
    with pytest.raises(InputError, match="wobbles"):
        turning_chain(crosses(0.2))
    last = replace(crosses(0.2), joints=(Hooke(joint_angle=28 * deg), crosses(0.2).joints[1]))
    assert wobbling(last) == ()
    turning_chain(last)
