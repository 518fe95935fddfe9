"""Critical speeds of whole drives: the same lines told by hand, closed forms, and what a drive must say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, example
from cardan.book.stepped import Node, stepped_speeds
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.shaft import PointMass, Segment, Shaft, Spline
from cardan.drive.support import Support
from cardan.formulas.critical_speed import speed_margin, uniform_speed
from cardan.maths.linear.rotor_beams import round_section
from cardan.questions.bending.bending import Running, bending_speeds, critical_speed_map, wear_factors

STEEL = Material(youngs=2.1e11, density=7850.0)
TUBE = {"outer": 0.076, "inner": 0.072, "material": STEEL}
DUTY = Duty(speed=300.0)


def line_of(*lengths, down=0.0):
    """Return a drive with shafts of these lengths between its joints, straight or falling more and more."""
    points = [np.asarray([-0.3, 0.0, 0.0]), np.zeros(3)]
    for k, length in enumerate(lengths, start=1):
        points.append(points[-1] + length * np.asarray([np.cos(k * down), 0.0, -np.sin(k * down)]))
    points.append(points[-1] + np.asarray([0.3, 0.0, 0.0]))
    return Drive.from_points(points)


def single(length=1.5, **keys):
    return replace(line_of(length), shafts=(Shaft(number=2, **{**TUBE, **keys}),))


def two_piece(**keys):
    """Return the two-piece shaft of the reference cases: an elastic centre bearing before an overhung joint."""
    tube = {"outer": 0.06, "inner": 0.056, "material": STEEL}
    drive = line_of(0.8, 0.9, down=keys.pop("down", 0.0))
    joints = tuple(replace(one, cross=Cross(mass=1.5) if k == 1 else None) for k, one in enumerate(drive.joints))
    return replace(
        drive,
        joints=joints,
        shafts=(Shaft(number=2, masses=(PointMass(position=0.7, mass=1.0),), **tube), Shaft(number=3, **tube)),
        supports=(Support(shaft=2, position=0.7, stiffness=2e5),),
        **keys,
    )


@pytest.mark.parametrize("down", [0.0, 0.05])
def test_a_two_piece_shaft_as_published_whatever_its_bends(down):
    found = bending_speeds(two_piece(down=down))
    want = [197.88618823512496, 1334.4717635774452, 1825.7778633755738]
    np.testing.assert_allclose(found.speed, want, rtol=1e-10)
    assert [(one.kind, one.number, one.waves) for one in found.part] == [
        ("support", 1, 1),
        ("shaft", 3, 1),
        ("shaft", 2, 1),
    ]
    np.testing.assert_allclose(found.joint_place, [0.0, 0.8, 1.7])
    assert found.support_place.tolist() == pytest.approx([0.7])
    assert found.shaft_span[1:3].tolist() == [pytest.approx([0.0, 0.8]), pytest.approx([0.8, 1.7])]
    assert found.held == (1, 3)
    assert found.missed == 0
    assert found.residual < 1e-3
    np.testing.assert_allclose(found.shaft_share.sum(axis=-1) + found.support_share.sum(axis=-1), 1.0, rtol=1e-9)


def test_a_tube_between_two_joints_is_the_book_s_less_shear_and_spin():
    found = bending_speeds(single())
    assert found.speed[0] == pytest.approx(590.3394557720308, rel=1e-11)
    assert found.alone[1] == pytest.approx(593.796087907365, rel=1e-11)
    assert np.isnan(found.alone[[0, 2]]).all()
    assert found.at_rest[0] < found.speed[0] < found.alone[1]
    assert found.status == Running.UNKNOWN
    assert [one.waves for one in found.part] == [1, 2, 3]
    # At each place the first shape is a sine.
    np.testing.assert_allclose(found.deflection[0], np.sin(np.pi * found.place / 1.5), atol=1e-6)


def test_end_shafts_with_bearings_belong_to_the_line():
    """Two bearings of the machine on shaft 1, its flange overhung, then the joint and the shaft to the next machine."""
    drive = replace(
        line_of(0.9),
        shafts=(
            Shaft(
                number=1,
                segments=(
                    Segment(length=0.25, outer=0.05, material=STEEL),
                    Segment(length=0.1, outer=0.07, material=STEEL),
                ),
                masses=(PointMass(position=0.0, mass=2.0, polar_inertia=0.004, diametral_inertia=0.003),),
            ),
            Shaft(number=2, **TUBE),
        ),
        supports=(
            Support(shaft=1, position=-0.3, stiffness=8e7),
            Support(shaft=1, position=-0.1),
        ),
    )
    found = bending_speeds(drive)
    outer, inner = np.asarray([0.05, 0.05, 0.07, 0.076]), np.asarray([0.0, 0.0, 0.0, 0.072])
    flange = Node(mass=2.0, polar_inertia=0.004, diametral_inertia=0.003, hinge=True)
    nodes = [Node(), Node(stiffness=8e7), Node(held=True), flange, Node(held=True)]
    section = round_section(outer, inner, 2.1e11, 7850.0, poisson=0.3)
    want = stepped_speeds([0.05, 0.2, 0.1, 0.9], section, nodes)
    np.testing.assert_allclose(found.speed, want.speed, rtol=1e-10)
    assert found.held == (2,)
    assert found.place[0] == pytest.approx(-0.35)


@pytest.mark.slow
def test_without_a_length_an_end_shaft_reaches_its_last_bearing():
    ends = (Support(shaft=3, position=0.1), Support(shaft=3, position=0.28))
    drive = replace(line_of(0.9), shafts=(Shaft(number=2, **TUBE), Shaft(number=3, **TUBE)), supports=ends)
    found = bending_speeds(drive)
    assert found.place[-1] == pytest.approx(0.9 + 0.28)
    assert "shafts[2].segments" in found.assumed

    def reaching(length):
        body = (Segment(length=length, **TUBE),)
        return replace(drive, shafts=(drive.shafts[1], Shaft(number=3, segments=body)))

    np.testing.assert_allclose(bending_speeds(reaching(0.28)).speed, found.speed, rtol=1e-11)
    assert fields(reaching(0.2)) == ["supports[1].position"]
    by_angles = Drive.from_angles([0.0, 0.0])
    sized = (Shaft(number=2, length=0.9, **TUBE), Shaft(number=3, length=0.28, **TUBE))
    by_angles = replace(by_angles, shafts=sized, supports=ends)
    np.testing.assert_allclose(bending_speeds(by_angles).speed, found.speed, rtol=1e-11)


def test_a_support_that_holds_the_slope_is_a_fixed_end():
    """Long and thin, so that shear does not count: fixed behind joint 1, pinned at joint 2."""
    fixed = Support(shaft=2, position=0.0, tilt=True)
    found = bending_speeds(replace(single(30.0), supports=(fixed,)))
    want = uniform_speed(30.0, 0.076, 0.072, 2.1e11, 7850.0, ends="fixed-pinned")
    np.testing.assert_allclose(found.speed, want, rtol=3e-4)
    soft = bending_speeds(replace(single(30.0), supports=(replace(fixed, tilt_stiffness=1e-3),)))
    np.testing.assert_allclose(soft.speed, bending_speeds(single(30.0)).speed, rtol=1e-6)
    half = bending_speeds(replace(single(30.0), supports=(replace(fixed, tilt_stiffness=2e4),)))
    assert np.all((soft.speed < half.speed) & (half.speed < found.speed))
    assert 0.1 < half.support_share[0, 0] < 0.5


@pytest.mark.slow
def test_a_given_mass_is_spread_along_the_body():
    one = bending_speeds(single())
    own = np.pi / 4 * (0.076**2 - 0.072**2) * 1.5 * 7850
    heavy = bending_speeds(single(mass=4.0 * own))
    # Rotary inertia and spin, a few thousandths, scale along.
    np.testing.assert_allclose(heavy.at_rest, 0.5 * one.at_rest, rtol=1e-9)


def test_half_of_each_cross_turns_with_each_shaft():
    plain = two_piece()
    heavy = replace(plain.joints[1], cross=Cross(mass=1.5, inertia=(4e-3, 6e-3, 8e-3)))
    found = bending_speeds(replace(plain, joints=(plain.joints[0], heavy, plain.joints[2])))
    section = round_section(np.full(3, 0.06), 0.056, 2.1e11, 7850.0, poisson=0.3)
    half = {"diametral_inertia": 2.5e-3, "polar_inertia": 4e-3}
    # A hinge takes inertia before it; that behind goes a hair further.
    short = 1e-6
    nodes = [Node(held=True), Node(mass=1.0, stiffness=2e5), Node(mass=1.5, hinge=True, **half), Node(**half)]
    four = round_section(np.full(4, 0.06), 0.056, 2.1e11, 7850.0, poisson=0.3)
    want = stepped_speeds([0.7, 0.1, short, 0.9 - short], four, [*nodes, Node(held=True)])
    np.testing.assert_allclose(found.speed, want.speed, rtol=1e-4)
    bare = stepped_speeds([0.7, 0.1, 0.9], section, [*nodes[:2], Node(mass=1.5, hinge=True), Node(held=True)])
    assert abs(found.speed[2] / bare.speed[2] - 1) > 1e-3


@pytest.mark.slow
def test_a_spline_wears():
    spline = single(spline=Spline(teeth=16))
    drive = replace(spline, duty=DUTY)
    found = bending_speeds(drive)
    assert wear_factors(drive).tolist() == [1.0, 0.9, 1.0]
    np.testing.assert_allclose(found.actual, 0.9 * found.speed)
    assert found.assumed == ("shafts[1].wear_factor",)
    assert found.margin == speed_margin(float(found.speed[0]), 300.0, wear=0.9, operating=(300.0, 300.0), through=True)
    worn = replace(drive, shafts=(replace(drive.shafts[1], wear_factor=0.7),))
    assert bending_speeds(worn).actual[0] == pytest.approx(0.7 * found.speed[0])
    assert bending_speeds(worn).assumed == ()


def test_each_mode_wears_as_the_shaft_that_bends():
    drive = two_piece()
    splined = replace(drive, shafts=(drive.shafts[1], replace(drive.shafts[2], spline=Spline(teeth=16))))
    assert bending_speeds(splined).wear.tolist() == [1.0, 0.9, 1.0]  # the first bounces on its support


@pytest.mark.slow
@pytest.mark.parametrize(
    ("duty", "status", "crossed", "half"),
    [
        (Duty(), Running.UNKNOWN, False, False),
        (Duty(speed=-200.0), Running.CLEAR, False, False),
        (Duty(speed=290.0), Running.NEAR, False, True),
        (Duty(speed_range=(100.0, 365.0)), Running.CLEAR, False, True),
        (Duty(speed_range=(400.0, 430.0)), Running.CLOSE, False, True),
        (Duty(speed_range=(330.0, 385.0), application="industrial"), Running.CLOSE, False, True),
        (Duty(speed_range=(100.0, 600.0)), Running.BEYOND, True, True),
        (Duty(speed=700.0), Running.BEYOND, True, True),
    ],
)
def test_speeds_of_running(duty, status, crossed, half):
    """The first critical speed is 590 rad/s: 369 a 60 percent below, half of it 272 … 319, 65 percent of it 384."""
    found = bending_speeds(single(), duty)
    assert found.status == status
    assert found.crossed.tolist() == [crossed, False, False]
    assert bool(found.half_crossed[0]) == half
    assert found.half_band[0] == pytest.approx(0.5 * 590.34 * np.asarray([0.92, 1.08]), rel=1e-5)


def test_the_rules_are_about_the_first_mode_that_bows():
    found = bending_speeds(two_piece(), Duty(speed_range=(100.0, 500.0)), modes=1)
    assert len(found.speed) == 1
    assert found.crossed.tolist() == [True]
    assert found.deciding == 1
    assert found.margin.critical == pytest.approx(1334.4717635774452, rel=1e-10)
    assert found.status == Running.CLEAR


@pytest.mark.slow
def test_many_modes_are_all_found():
    found = bending_speeds(two_piece(), modes=12)
    assert found.missed == 0
    assert np.all(np.diff(found.speed) > 0.0)
    assert found.residual < 2e-3


def fields(drive, **keys):
    with pytest.raises(InputError) as caught:
        bending_speeds(drive, **keys)
    return [problem.field for problem in caught.value.problems]


def test_what_a_drive_must_say():
    assert fields(line_of(1.0, 0.9)) == ["shafts[1].outer", "shafts[2].outer"]
    joint_angles = Drive.from_angles([0.1, 0.1])
    assert fields(replace(joint_angles, shafts=(Shaft(number=2, outer=0.05),))) == ["shafts[1].length"]
    one = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (0.4, 0, 0)])
    assert fields(one) == ["shafts[0].outer", "shafts[1].outer"]
    assert fields(replace(one, shafts=(Shaft(number=1, **TUBE),))) == ["shafts[1].outer", "supports"]
    assert fields(single(), modes=0) == ["modes"]


def test_shafts_that_nothing_holds_are_named():
    drive = two_piece()
    loose = replace(drive, supports=())
    assert fields(loose) == ["supports"]
    with pytest.raises(InputError, match="shafts 2 and 3 can pivot freely"):
        bending_speeds(loose)
    one = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (0.4, 0, 0)])
    body = (Segment(length=0.4, **TUBE),)
    one = replace(one, shafts=(Shaft(number=2, segments=body),), supports=(Support(shaft=2, position=0.0),))
    with pytest.raises(InputError, match="shaft 2 can pivot freely"):
        bending_speeds(one)


def test_a_map_over_stiffness_is_each_drive_by_itself():
    drive = two_piece()
    found = critical_speed_map(drive, [1e5, 2e5, 5e6])
    assert (found.over, found.number, found.drawn) == ("stiffness", 1, 2e5)
    for stiffness, speed in zip(found.value, found.speed, strict=True):
        alone = bending_speeds(replace(drive, supports=(replace(drive.supports[0], stiffness=stiffness),)))
        # Elements against transfer matrices.
        np.testing.assert_allclose(speed, alone.speed, rtol=1e-3)
    rigid = replace(drive, supports=(replace(drive.supports[0], stiffness=None),))
    stiff = critical_speed_map(rigid, np.geomspace(1e4, 1e10, 7))
    assert stiff.drawn is None
    np.testing.assert_allclose(stiff.speed[-1], bending_speeds(rigid).speed, rtol=5e-3)
    assert np.all(np.diff(stiff.speed, axis=0) > -1e-9)


def test_a_map_over_length_moves_what_stands_on_the_shaft():
    drive = two_piece()
    found = critical_speed_map(drive, [0.8, 1.2], shaft=2)
    np.testing.assert_allclose(found.speed[0], critical_speed_map(drive, [2e5]).speed[0], rtol=1e-6)
    longer = replace(
        line_of(1.2, 0.9),
        joints=tuple(replace(b, cross=a.cross) for a, b in zip(drive.joints, line_of(1.2, 0.9).joints, strict=True)),
        shafts=(replace(drive.shafts[1], masses=(PointMass(position=1.05, mass=1.0),)), drive.shafts[2]),
        supports=(replace(drive.supports[0], position=1.05),),
    )
    np.testing.assert_allclose(found.speed[1], bending_speeds(longer).speed, rtol=1e-3)
    plain = critical_speed_map(single(), modes=1)
    assert (plain.over, plain.number, plain.drawn) == ("length", 2, pytest.approx(1.5))
    assert plain.speed.shape == (49, 1)
    assert np.all(np.diff(plain.speed, axis=0) < 0.0)


@pytest.mark.parametrize(
    ("keys", "field"),
    [({"support": 2}, "support"), ({"shaft": 1}, "shaft"), ({"value": [1e5, -1.0]}, "value")],
)
def test_a_map_needs_something_to_vary(keys, field):
    with pytest.raises(InputError) as caught:
        critical_speed_map(two_piece(), **keys)
    assert [problem.field for problem in caught.value.problems] == [field]


def test_the_shipped_example_passes_its_bounce_and_keeps_the_rules():
    found = bending_speeds(example("two-piece-rubber-bearing"))
    assert found.part[0].kind == "support"
    assert found.crossed.tolist() == [True, False, False]
    assert found.status == Running.CLEAR
