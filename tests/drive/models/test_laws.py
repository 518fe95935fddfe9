"""Chains of mixed kinds against each joint's own law, followed one by one with nothing of the program's chains."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, motion, phases
from cardan.drive.bodies.solids import arms, solids
from cardan.drive.described import Input
from cardan.drive.drives import stack
from cardan.drive.joints import JOINTS, Hooke
from cardan.drive.joints.mechanism import MechanismJoint
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import NEGLIGIBLE, chain, given_chain, left_over, turning_chain
from cardan.drive.shaft import Shaft
from cardan.errors import InputError
from cardan.joints import (
    Clemens,
    ClemensProfile,
    ConstantVelocity,
    DoubleCardan,
    ElasticHalfCardan,
    HalfCardan,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import followed
from cardan.units import mm

ROUNDING = 1e-13
"""A dozen joints, ratios of order one: some hundred roundings."""

ANGLE = np.linspace(-1.0, 8.0, 61)

MAPPED = (
    Hooke(joint_angle=0.3, plane_twist=0.2),
    DoubleCardan(joint_angle=0.6, centring_ratio=0.45, plane_twist=0.4),
    ConstantVelocity(joint_angle=0.5, plane_twist=-1.0),
    Tracta(joint_angle=0.4, driving_distance=20 * mm, driven_distance=25 * mm, plane_twist=0.9),
    OffsetCross(joint_angle=0.3, offset=10 * mm, reach=0.2, plane_twist=0.1),
    DoubleCardan(joint_angle=0.4, centring_ratio=0.6, ball_on="driven", plane_twist=-0.3),
    HalfCardan(joint_angle=0.05),
    PinCoupling(joint_angle=0.3),
    Clemens(joint_angle=0.2),
    Rzeppa(joint_angle=0.4),
    Weiss(joint_angle=0.2),
    Tripod(joint_angle=0.2, track_radius=20 * mm),
    ElasticHalfCardan(joint_angle=0.1, stiffness=1e4),
    Hooke(joint_angle=0.35),
)

STEADY = tuple(joint for joint in MAPPED if not joint.wobbles)
"""Those behind which no shaft wobbles: a chain of them turns by their laws alone."""

UNMAPPED = (
    Rzeppa(joint_angle=0.5, lever_b=0.35, lever_c=0.65),
    Weiss(joint_angle=0.3, driving_offset=3.0 * mm, driven_offset=3.3 * mm, groove_radius=30 * mm),
    PinCoupling(joint_angle=0.3, driving_distance=50 * mm, driven_distance=52 * mm),
    Clemens(
        joint_angle=0.3,
        driving=ClemensProfile(axial=60 * mm, radial=10 * mm, radius=75 * mm),
        driven=ClemensProfile(axial=62 * mm, radial=11 * mm, radius=74 * mm),
    ),
    ElasticHalfCardan(joint_angle=0.2, pairs=2),
)


def drive_of(*joints, start=0.37):
    shafts = tuple(Shaft(number=k, yoke_angle=0.4 * k - 1.0) for k in range(2, len(joints) + 1))
    return Drive(joints=joints, shafts=shafts, input=Input(start_phase=start))


def tangent_of(joint, joint_angle):
    """Return κ of tan θ' = κ tan θ by the law of sines and cosines alone."""
    if isinstance(joint, DoubleCardan):
        second = math.asin(joint.centring_ratio * math.sin(joint_angle))
        kappa = math.cos(second) / math.cos(joint_angle - second)
        return kappa if joint.ball_on == "driving" else 1.0 / kappa
    if isinstance(joint, Tracta):
        first = math.atan2(
            joint.driven_distance * math.sin(joint_angle),
            joint.driving_distance + joint.driven_distance * math.cos(joint_angle),
        )
        return math.cos(joint_angle - first) / math.cos(first)
    return 1.0 / math.cos(joint_angle) if joint.crossed else 1.0


def plain(drive, angle):
    """Return the output angle by one arctan after another."""
    theta, origin = angle + drive.input.start_phase, drive.input.start_phase
    for i, joint in enumerate(drive.joints):
        kappa = tangent_of(joint, joint.joint_angle)
        rounds = [np.round(x / np.pi) * np.pi for x in (theta, origin)]
        theta, origin = (
            turns + np.arctan(kappa * np.tan(x - turns)) for x, turns in zip((theta, origin), rounds, strict=True)
        )
        if i + 1 < len(drive.joints):
            shift = (np.pi / 2 if joint.crossed else 0.0) - drive.shafts[i + 1].yoke_angle
            shift -= drive.joints[i + 1].plane_twist or 0.0
            theta, origin = theta + shift, origin + shift
    return theta - origin


def test_a_mixed_chain_is_the_composition_of_its_laws():
    drive = drive_of(*STEADY)
    found = motion(drive, ANGLE)
    assert np.abs(found.output_angle - plain(drive, ANGLE)).max() < ROUNDING
    step = 1e-5
    slope = (plain(drive, ANGLE + step) - plain(drive, ANGLE - step)) / (2.0 * step)
    assert np.abs(found.ratio - slope).max() < 1e-9  # a central difference of third derivatives of order ten


@pytest.mark.parametrize("joints", [STEADY, STEADY[::-1], STEADY[1:5]])
def test_both_ways_through_a_mixed_chain_agree(joints):
    drive = drive_of(*(replace(joint, plane_twist=0.3) for joint in joints))
    found, way = motion(drive, ANGLE), followed(drive, ANGLE)
    for name in ("shaft_angle", "shaft_ratio", "shaft_slope"):
        assert np.abs(getattr(found, name) - way[name]).max() < ROUNDING
    assert np.abs(np.sin(found.yoke_rotation - way["yoke_rotation"])).max() < ROUNDING
    assert np.array_equal(found.joint_angle, [joint.joint_angle for joint in drive.joints])


@pytest.mark.parametrize("joint", UNMAPPED, ids=lambda joint: joint.kind)
def test_laws_of_their_own_have_the_right_derivatives(joint):
    drive = drive_of(Hooke(joint_angle=0.2), joint, Hooke(joint_angle=0.3))
    step = 1e-4
    at, after, before = (motion(drive, ANGLE + shift) for shift in (0.0, step, -step))
    ahead, behind = (one.shaft_angle + one.shaft_angle * 0.0 for one in (after, before))
    assert np.abs((ahead - behind) / (2.0 * step) - at.shaft_ratio).max() < 1e-6  # h² times a third derivative
    slope = (after.shaft_ratio - before.shaft_ratio) / (2.0 * step)
    assert np.abs(slope - at.shaft_slope).max() < 1e-5
    # over a whole turn every kind returns: no joint gains on its driving shaft
    assert np.abs(motion(drive, [0.0, 2.0 * np.pi]).shaft_angle[:, 1] - 2.0 * np.pi).max() < 1e-9


def test_marks_of_the_picture_are_those_of_the_motion():
    drive = drive_of(*STEADY)
    found = motion(drive, ANGLE)
    place = geometry(drive)
    stand = arms(place, given_chain(drive), ANGLE, drive.joints)
    for i in range(len(drive.joints)):
        across, normal = np.cross(place.normal[i], place.axis[i]), place.normal[i]
        theta = found.yoke_rotation[i][:, None]
        along = np.sum((np.cos(theta) * across + np.sin(theta) * normal) * stand.driving[i], axis=-1)
        assert np.abs(np.abs(along) - 1.0).max() < ROUNDING
    assert len(solids(drive).bodies) > 2 * len(drive.joints)


def test_synchronous_yokes_of_a_mixed_chain_are_exact():
    joints = (
        Hooke(joint_angle=0.3),
        DoubleCardan(joint_angle=0.5, centring_ratio=0.5),
        Hooke(joint_angle=0.31, plane_twist=0.7),
    )
    drive = drive_of(*joints)
    found = phases(drive)
    assert found.feasible
    for one in found.settings:
        set_so = replace(
            drive, shafts=tuple(Shaft(number=k, yoke_angle=g) for k, g in enumerate(one.yoke_angle.tolist(), start=2))
        )
        assert np.ptp(np.gradient(plain(set_so, ANGLE), ANGLE)) < 1e-12


def test_a_constant_velocity_joint_does_not_change_the_phasing_of_the_others():
    two = phases(Drive.from_angles([0.3, 0.3], plane_twists=[0.6])).settings[0]
    between = Drive(
        joints=(Hooke(joint_angle=0.3), ConstantVelocity(joint_angle=0.2), Hooke(joint_angle=0.3, plane_twist=0.6))
    )
    found = phases(between, fixed={3: 0.0}).settings[0]
    assert np.sin(found.yoke_angle[0] - two.yoke_angle[0]) == pytest.approx(0.0, abs=1e-12)


def test_batches_hold_any_kinds():
    drives = [drive_of(*MAPPED[:3]), drive_of(*MAPPED[3:5]), Drive.from_angles([0.2, 0.3])]
    both = motion(stack(drives), ANGLE)
    for k, drive in enumerate(drives):
        assert np.abs(both.output_angle[k] - motion(drive, ANGLE).output_angle).max() < ROUNDING


def test_hooke_chains_are_what_they_were():
    drive = Drive.from_angles([0.2, 0.3], yoke_angles=[0.4])
    one, other = chain(drive), turning_chain(drive)
    assert one.laws is None
    assert other.laws is None
    assert np.array_equal(one.joint_angle, other.joint_angle)
    assert motion(drive).crossed == ()


@pytest.mark.parametrize("joint", UNMAPPED[2:], ids=lambda joint: joint.kind)
def test_questions_that_need_a_map_name_the_joint_its_kind_and_themselves(joint):
    drive = drive_of(Hooke(joint_angle=0.2), joint)
    with pytest.raises(InputError, match=r"joints\[1\]\.kind: .*law of its own"):
        equivalent_joint(drive)


def test_what_nobody_can_measure_keeps_no_yokes_from_being_set():
    """Six balls leave τ³/3 of order 6 beside their map, here some 1e-10 rad."""
    rzeppa = UNMAPPED[0]
    assert 0.0 < left_over(rzeppa, rzeppa.joint_angle) < NEGLIGIBLE < left_over(UNMAPPED[2], UNMAPPED[2].joint_angle)
    joints = Hooke(joint_angle=0.2), rzeppa, Hooke(joint_angle=0.2, plane_twist=0.4)
    found = phases(drive_of(*joints)).settings[0]
    set_so = replace(
        drive_of(*joints),
        shafts=tuple(Shaft(number=k, yoke_angle=g) for k, g in enumerate(found.yoke_angle.tolist(), start=2)),
    )
    assert np.ptp(motion(set_so).ratio) < 1e-8


def test_crosses_turn_only_where_there_are_some():
    found = motion(drive_of(Hooke(joint_angle=0.2), Rzeppa(joint_angle=0.3)))
    assert np.all(np.isfinite(found.cross_driving[0]))
    assert np.all(np.isnan(found.cross_driven_rate[1]))


@pytest.mark.parametrize(
    ("joint", "joint_angle"),
    [
        (PinCoupling(driving_slant=0.2), 0.5),
        (PinCoupling(driving_slant=0.2, driving_distance=0.05, driven_distance=0.06), 0.5),
        (Rzeppa(lever_b=0.35, lever_c=1.5), 1.4),
        (Tracta(driving_distance=1.0, driven_distance=1e-6), 1.5),
    ],
)
def test_sizes_that_do_not_turn_are_named(joint, joint_angle):
    drive = Drive(joints=(Hooke(joint_angle=0.1), replace(joint, joint_angle=joint_angle)))
    if isinstance(joint, Tracta):  # reaches nearly to 90°: it turns, however steeply
        assert np.isfinite(motion(drive).ratio).all()
        return
    with pytest.raises(InputError, match=r"joints\[1\]\.joint_angle: .*does not turn at its joint angle"):
        motion(drive)


@pytest.mark.parametrize(
    ("joint", "path"),
    [
        (Tracta(joint_angle=0.1, driving_distance=0.02), "driven_distance"),
        (Rzeppa(joint_angle=0.1, lever_b=0.35), "lever_c"),
        (
            Rzeppa(
                joint_angle=0.1, lever_b=0.35, lever_c=0.7, driving_offset=1e-3, driven_offset=1e-3, groove_radius=1e-2
            ),
            "lever_b",
        ),
        (Weiss(joint_angle=0.1, groove_radius=0.03), "driving_offset"),
        (OffsetCross(joint_angle=0.1, offset=0.2, reach=0.1), "reach"),
        (PinCoupling(joint_angle=0.1, driven_slant=0.9), "driving_distance"),
        (Clemens(joint_angle=0.1, driven=ClemensProfile(axial=0.1, radial=0.0, radius=0.2)), "driving"),
        (ConstantVelocity(joint_angle=0.1, friction=0.1), "friction"),
    ],
)
def test_contradictions_within_a_joint_are_found(joint, path):
    with pytest.raises(InputError, match=rf"joints\[1\]\.{path}: "):
        Drive(joints=(Hooke(joint_angle=0.1), joint))


def test_every_kind_is_covered_here():
    assert {type(joint) for joint in (*MAPPED, *UNMAPPED)} == set(JOINTS.values()) - {MechanismJoint}
