"""Joints of every kind by themselves, against chains, closed forms and each other."""

import numpy as np
import pytest

from cardan import Drive, InputError, motion
from cardan.catalogue import catalogue
from cardan.catalogue.rows import JointType
from cardan.drive.joints import JOINTS, Hooke
from cardan.joints import (
    Clemens,
    ClemensProfile,
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
from cardan.questions.motion.joint_law import joint_over_angles, joint_turn, types_of
from cardan.questions.motion.kinds import joint_inside
from cardan.units import deg, mm

UNEVEN = (
    Hooke(),
    OffsetCross(offset=20 * mm, reach=0.5),
    DoubleCardan(centring_ratio=0.5),
    Tracta(driving_distance=20 * mm, driven_distance=21 * mm),
    Rzeppa(lever_b=0.35, lever_c=0.65),
    Weiss(driving_offset=6 * mm, driven_offset=5.5 * mm, groove_radius=30 * mm),
    HalfCardan(pairs=2),
    ElasticHalfCardan(pairs=3),
    PinCoupling(driving_slant=40 * deg, driven_slant=42 * deg, driving_distance=50 * mm, driven_distance=52 * mm),
    Clemens(
        driving=ClemensProfile(axial=60 * mm, radial=10 * mm, radius=75 * mm),
        driven=ClemensProfile(axial=62 * mm, radial=11 * mm, radius=74 * mm),
    ),
)


def test_a_hooke_joint_is_the_chain_of_one():
    joint_angle = 25 * deg
    found = joint_turn(Hooke(), joint_angle)
    chain = motion(Drive.from_angles([joint_angle]), found.angle)
    np.testing.assert_allclose(found.ratio, chain.ratio, rtol=1e-13)
    assert found.speed_fluctuation == pytest.approx(np.sin(joint_angle) * np.tan(joint_angle), rel=1e-12)
    # Half a degree beside the peak the lead is less by its curvature, 2 (0.25°)² of it at most.
    assert found.error == pytest.approx(np.arcsin(np.tan(joint_angle / 2) ** 2), rel=4e-5)
    assert found.order == 2


@pytest.mark.parametrize("joint", UNEVEN, ids=lambda joint: joint.kind)
def test_lead_ratio_and_slope_belong_together(joint):
    """The ratio is the slope of the turn, its mean is 1, and the lead repeats."""
    found = joint_turn(joint, 15 * deg)
    step = found.angle[1] - found.angle[0]
    # A difference quotient over half a degree misses a slope of order k by (k 0.5°)²/6: 5e-4 of it for order 6.
    angle_error, ratio = np.gradient(found.angle_error, step)[1:-1], np.gradient(found.ratio, step)[1:-1]
    np.testing.assert_allclose(angle_error, found.ratio[1:-1] - 1, atol=5e-4 * found.speed_fluctuation)
    np.testing.assert_allclose(ratio, found.slope[1:-1], atol=1e-3 * found.acceleration)
    assert found.ratio[:-1].mean() == pytest.approx(1.0, abs=1e-12)
    assert found.angle_error[-1] == pytest.approx(found.angle_error[0], abs=1e-9)


@pytest.mark.parametrize("joint", UNEVEN, ids=lambda joint: joint.kind)
def test_over_bends_is_turn_by_turn(joint):
    joint_angles = np.array([5.0, 20.0]) * deg
    found = joint_over_angles(joint, joint_angles)
    for k, joint_angle in enumerate(joint_angles):
        one = joint_turn(joint, joint_angle)
        # Every third degree misses a peak of order 6, the highest here, by less than half its (9°)² at most.
        assert found.error[k] == pytest.approx(one.error, rel=0.015, abs=1e-11)
        assert found.speed_fluctuation[k] == pytest.approx(one.speed_fluctuation, rel=0.015, abs=1e-11)
    assert np.all(np.diff(joint_over_angles(joint).error[:8]) >= 0), "the more it bends, the more uneven it is"


def test_joints_without_sizes_are_even_but_for_crosses():
    for name, kind in JOINTS.items():
        if name == "offset_cross":
            continue
        found = joint_turn(kind(), 12 * deg)
        even = name not in ("hooke", "half_cardan")
        assert (found.error == 0.0) == even
        assert (found.order == 0) == even
        assert found.acceleration == 0.0 or not even


def test_a_bend_at_which_it_does_not_turn_is_refused():
    with pytest.raises(InputError, match="below 90°"):
        joint_turn(Hooke(), 90 * deg)
    flat = PinCoupling(driving_slant=20 * deg)
    with pytest.raises(InputError, match="pin_coupling with these sizes does not turn at its joint angle of 45°"):
        joint_turn(flat, 45 * deg)
    assert np.isnan(joint_over_angles(flat, [10 * deg, 45 * deg]).error).tolist() == [False, True]


def test_every_type_of_the_catalogue_turns_by_the_law_of_one_kind_at_most():
    named = [name for kind in JOINTS.values() for name in kind.types]
    assert len(set(named)) == len(named)
    assert set(named) <= set(catalogue().rows(JointType))
    assert {name for name, kind in JOINTS.items() if not kind.types} == {"mechanism"}
    assert types_of("perpetual") == ()


def test_what_moves_inside():
    joint_angle = 20 * deg

    def inside(joint):
        return {one.key: one.value for one in joint_inside(joint, joint_angle)}

    assert inside(Hooke()) == {}
    assert inside(Tripod()) == {}
    assert inside(Rzeppa()) == {}
    assert inside(Tripod(track_radius=20 * mm))["orbit"] == pytest.approx(0.642 * mm, rel=1e-3)
    assert inside(OffsetCross(offset=20 * mm, reach=0.5))["wobble"] == pytest.approx(0.02 * np.sin(joint_angle) / 1.0)
    double = inside(DoubleCardan(centring_ratio=0.4))
    assert np.sin(double["driven_joint_angle"]) == pytest.approx(0.4 * np.sin(joint_angle))
    assert double["driving_joint_angle"] + double["driven_joint_angle"] == pytest.approx(joint_angle)
    other = inside(DoubleCardan(centring_ratio=0.4, ball_on="driven"))
    assert other["driving_joint_angle"] == pytest.approx(double["driven_joint_angle"])
    assert inside(HalfCardan(pairs=2))["play"] == pytest.approx(
        np.arctan(0.5 * np.sin(joint_angle) * np.tan(joint_angle))
    )
    assert inside(ElasticHalfCardan(pairs=3))["strain"] > 0
    even = PinCoupling(driving_slant=40 * deg, driving_distance=50 * mm, driven_distance=50 * mm)
    assert inside(even)["stroke"] == pytest.approx(
        50 * mm * np.cos(joint_angle / 2) * (1 / np.cos(50 * deg) - 1 / np.cos(30 * deg))
    )
    assert set(inside(PinCoupling())) == {"least_slant", "most_slant"}
    assert inside(Tracta(driving_distance=20 * mm, driven_distance=20 * mm))["plane_tilt"] == 0.0
    missed = inside(UNEVEN[4])
    # One ball by itself swings by 4 η tan(α/2) in speed, by a quarter of that to both sides in angle.
    assert missed["ball_spread"] == pytest.approx(2 * abs(missed["plane_tilt"]) * np.tan(joint_angle / 2), rel=0.15)
    grooves = {"driving_offset": 6 * mm, "driven_offset": 5.5 * mm, "groove_radius": 30 * mm}
    two, six = inside(Weiss(balls=2, **grooves)), inside(Rzeppa(balls=6, **grooves))
    assert two["plane_tilt"] == six["plane_tilt"] != 0.0
    assert 0.0 < two["ball_spread"] < six["ball_spread"], "opposite balls ask for nearly the same"
    assert inside(Rzeppa(**grooves | {"driven_offset": 6 * mm}))["ball_spread"] == pytest.approx(0.0, abs=1e-12)
