"""Torsional vibration with joints of other kinds, against closed forms and against the crosses inside them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, stability, torsion_modes, torsion_response
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.errors import InputError
from cardan.joints import DoubleCardan, ElasticHalfCardan, PinCoupling, Tripod
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import motion
from cardan.questions.torsion.model.answer import parts_left_out

ENDS = (Station(shaft=1, inertia=0.5), Station(shaft=2, inertia=2.0))

SHARE = 0.4


def test_an_elastic_joint_is_a_spring():
    drive = Drive(joints=(ElasticHalfCardan(joint_angle=0.0, stiffness=1e4),), stations=ENDS)
    forced = torsion_modes(drive, Duty(speed=100.0))
    assert forced.omega == pytest.approx([math.sqrt(1e4 / 2.0)], rel=1e-12)


def test_an_elastic_joint_takes_its_part_of_the_twist():
    """Two springs in a row: their softnesses add."""
    shafts = (Shaft(number=2, stiffness=3e4, length=1.0),)
    ends = (Station(shaft=1, inertia=0.5), Station(shaft=2, position=1.0, inertia=2.0))
    soft = Drive(joints=(ElasticHalfCardan(joint_angle=0.05, stiffness=1e4),), shafts=shafts, stations=ends)
    stiff = replace(soft, joints=(ElasticHalfCardan(joint_angle=0.05),))
    one, other = (torsion_modes(drive, Duty(speed=100.0)).omega[0] for drive in (soft, stiff))
    assert other == pytest.approx(math.sqrt(3e4 / 2.0), rel=1e-12)
    assert one == pytest.approx(math.sqrt(1.0 / (1.0 / 1e4 + 1.0 / 3e4) / 2.0), rel=1e-12)


def whole_and_parts():
    """Return a drive with a double joint, and the same with its two crosses written out."""
    alpha = 0.6
    second = math.asin(SHARE * math.sin(alpha))
    first = alpha - second
    shafts = (Shaft(number=2, yoke_angle=0.4, stiffness=2e4, length=1.0), Shaft(number=3, yoke_angle=0.7))
    shafts = (*shafts, Shaft(number=4, stiffness=5e3, length=0.5))
    double = DoubleCardan(joint_angle=alpha, centring_ratio=SHARE, plane_twist=0.3)
    last = Hooke(joint_angle=0.25, plane_twist=0.5)
    one = Drive(
        joints=(Hooke(joint_angle=0.2), double, last),
        shafts=shafts,
        stations=(
            Station(shaft=1, inertia=0.5),
            Station(shaft=3, inertia=0.1),
            Station(shaft=4, position=0.5, inertia=2.0),
        ),
    )
    inner = (Hooke(joint_angle=first, plane_twist=0.3), Hooke(joint_angle=second, plane_twist=0.0))
    two = Drive(
        joints=(Hooke(joint_angle=0.2), *inner, last),
        shafts=(shafts[0], Shaft(number=3), replace(shafts[1], number=4), replace(shafts[2], number=5)),
        stations=(
            Station(shaft=1, inertia=0.5),
            Station(shaft=4, inertia=0.1),
            Station(shaft=5, position=0.5, inertia=2.0),
        ),
    )
    return one, two


def test_a_double_joint_turns_as_its_two_crosses():
    one, two = whole_and_parts()
    angle = np.linspace(0.0, 7.0, 50)
    found, parts = motion(one, angle), motion(two, angle)
    for k, same in ((1, 1), (2, 3), (3, 4)):
        assert np.abs(found.shaft_angle[k] - parts.shaft_angle[same]).max() < 1e-13
        assert np.abs(found.shaft_slope[k] - parts.shaft_slope[same]).max() < 1e-12
    assert equivalent_joint(one).speed_fluctuation == pytest.approx(equivalent_joint(two).speed_fluctuation, rel=1e-12)


def test_a_double_joint_swings_as_its_two_crosses():
    one, two = whole_and_parts()
    duty = Duty(speed=60.0, torque=100.0)
    modes = [torsion_modes(drive, duty).omega for drive in (one, two)]
    assert modes[0] == pytest.approx(modes[1], rel=1e-10)
    runs = [torsion_response(drive, duty) for drive in (one, two)]
    assert runs[0].swing == pytest.approx(runs[1].swing, rel=1e-6)  # both to the accuracy of the periodic motion
    grows = [stability(drive, duty).multipliers for drive in (one, two)]
    assert np.sort(np.abs(grows[0])) == pytest.approx(np.sort(np.abs(grows[1])), rel=1e-6)


def test_pins_that_do_not_reach_around_are_refused():
    """At a bend of 80° pins that slant by 30° part before they have turned around."""
    joint = PinCoupling(joint_angle=1.4, driving_slant=0.5, driving_distance=0.05, driven_distance=0.06)
    with pytest.raises(InputError, match=r"joints\[0\]\.joint_angle: a joint of kind pin_coupling .* does not turn"):
        torsion_modes(Drive(joints=(joint,), stations=ENDS), Duty(speed=1.0))


def test_the_wobble_of_a_shaft_is_said_to_be_left_out():
    """A last tripod whose shaft pivots beyond: order 3 of its motion is not in the line, and that is said."""
    joint = Tripod(joint_angle=0.35, track_radius=0.02, pivot=0.3)
    drive = Drive(joints=(joint,), stations=ENDS)
    assert [one.code for one in parts_left_out(drive)] == ["wobble"]
    assert not list(parts_left_out(replace(drive, joints=(replace(joint, pivot=None),))))
