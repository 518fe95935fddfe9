"""Torsional vibration with joints of other kinds, against closed forms and against the crosses inside them."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from cardan import Drive, stability, torsion_modes, torsion_response
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.joints.tripod import pivot_error
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import given_chain
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.errors import InputError
from cardan.joints import DoubleCardan, ElasticHalfCardan, OffsetCross, PinCoupling, Rzeppa, Tripod
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import motion
from cardan.questions.torsion.model.answer import _exactly
from cardan.questions.torsion.model.joint_bends import bends
from cardan.questions.torsion.model.torsional_balance import joint_law
from cardan.questions.torsion.model.torsional_modes import base_order
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.optimise.answer import _as_built, rule_reasons
from cardan.questions.torsion.optimise.modal_excitation import node_rules
from cardan.questions.torsion.optimise.optimise import _rules

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


WOBBLING = {
    "a last tripod": (Tripod(joint_angle=0.35, track_radius=0.02, pivot=0.3),),
    "a tripod before a cross": (Tripod(joint_angle=0.35, track_radius=0.02), Hooke(joint_angle=0.3, plane_twist=0.8)),
    "a tripod before a Rzeppa joint": (
        Tripod(joint_angle=0.35, track_radius=0.02),
        Rzeppa(joint_angle=0.3, plane_twist=0.8, balls=6),
    ),
    "offset crosses": (OffsetCross(joint_angle=0.4, offset=0.02, reach=0.2),) * 2,
}


def wobbling_drive(name):
    joints = WOBBLING[name]
    last = len(joints) + 1
    shafts = (Shaft(number=2, length=0.3, yoke_angle=0.4 if last > 2 else 0.0),)
    return Drive(joints=joints, shafts=shafts, stations=(ENDS[0], replace(ENDS[1], shaft=last)))


@pytest.mark.parametrize("name", WOBBLING)
def test_what_a_wobble_makes_of_joints_is_in_the_line_as_in_the_motion(name):
    """The laws of the line, one after the other, turn as the drive does that is followed pin by pin."""
    drive = wobbling_drive(name)
    given = given_chain(drive)
    found = bends(drive, given, geometry(drive))
    angle = np.linspace(0.0, 2.0 * np.pi, 97)
    turned, joints = angle, len(drive.joints)
    sums = np.reshape(found["sums"], (-1, 2, joints))
    for i in range(joints):
        own = sums[:, 0, i] + 1j * sums[:, 1, i]
        bend, phase = found["joint_angle"][i], found["phase"][i]
        turned = joint_law(turned + phase, bend, own)[0] - joint_law(phase, bend, own)[0]
    course = motion(drive, angle).shaft_angle[-1]
    assert np.ptp(course - angle) > 1e-4
    assert turned == pytest.approx(course - course[0], abs=2e-6)  # what is below a microradian is left out
    rows = np.stack([given.joint_angle, given.joint_angle])
    many = bends(drive, replace(given, joint_angle=rows))  # as for maps of joint angles: lengths as drawn
    assert many["sums"] == pytest.approx(np.stack([found["sums"]] * 2), abs=1e-12)


@pytest.mark.parametrize("turns", [100.0, 300.0, 318.3, 500.0])
def test_the_third_order_of_a_shaft_that_wobbles_excites_the_line(turns):
    """A last tripod whose shaft pivots beyond shakes a disk on a spring three times a turn, by its closed form."""
    k, c, inertia, angle, radius, length = 1000.0, 0.4, 0.1, 0.35, 0.02, 0.3
    joint = Tripod(joint_angle=angle, track_radius=radius, pivot=length)
    shafts = (Shaft(number=2, stiffness=k, damping=c, length=0.3),)
    ends = (Station(shaft=1, inertia=0.5), Station(shaft=2, position=0.3, inertia=inertia))
    drive = Drive(joints=(joint,), shafts=shafts, stations=ends)
    speed = turns * math.pi / 30.0
    found = torsion_response(drive, Duty(speed=speed, torque=100.0))
    omega, spring = 3.0 * speed, k + 3j * c * speed
    by_hand = pivot_error(angle, radius, length) * abs(spring * omega**2 * inertia / (spring - omega**2 * inertia))
    assert found.swing[0] == pytest.approx(by_hand, rel=2e-3)  # the closed form is of first order in the tilt
    bare = replace(drive, joints=(replace(joint, pivot=None),))
    assert torsion_response(bare, Duty(speed=speed, torque=100.0)).swing[0] < 1e-6
    modes = torsion_modes(drive, Duty(speed=speed))
    assert (modes.main, modes.order[0]) == (3.0, 3.0)
    assert modes.main_speed == pytest.approx(modes.omega / 3.0)
    assert [one.order for one in modes.crossings if one.mode == 1] == [3.0]


def test_what_joints_do_to_a_mode_is_told_of_the_order_that_does_most():
    """Two tripods on a line make its orders 3, 6, …: neither zones nor excitation are of order 2."""
    drive = wobbling_drive("a tripod before a Rzeppa joint")
    drive = replace(drive, shafts=tuple(replace(one, stiffness=2e4) for one in drive.shafts))
    train = torsional_train(drive, Duty(speed=80.0, torque=50.0))
    assert base_order(train.model) == 3.0
    (rule,) = node_rules(train, speed=80.0)
    assert rule.order == 3.0
    modes = torsion_modes(drive, Duty(speed=80.0))
    assert rule.modulation == pytest.approx(modes.modulation[0], rel=1e-12)
    said = [told(one, USUAL) for one in rule_reasons(rule)]
    assert "order 3 excites it at" in said[0]
    assert not any("no joint changes the speed" in one for one in said)
    zone = stability(drive, Duty(speed=80.0, torque=50.0)).zone
    assert zone.name(()) == "principal zone of mode 1"
    assert float(zone.speed) == pytest.approx(2.0 * modes.omega[0] / 3.0)


def test_modes_are_explained_where_their_own_order_meets_them():
    """Of two modes shaken three times a turn the one whose order 3 lies in the band; another order is no ratio."""
    drive = wobbling_drive("a tripod before a Rzeppa joint")
    ends = (ENDS[0], Station(shaft=2, position=0.3, inertia=0.3), replace(ENDS[1], shaft=3, position=0.3))
    shafts = (Shaft(number=2, length=0.3, stiffness=6000.0), Shaft(number=3, length=0.3, stiffness=9000.0))
    train = torsional_train(replace(drive, shafts=shafts, stations=ends), Duty(speed=80.0, torque=50.0))
    slow, fast = node_rules(train, speed=80.0)
    line: Any = SimpleNamespace(trains=(train,), speed=80.0)
    for one in (slow, fast):
        for at in (one.omega / 3.0, 2.0 * one.omega / 3.0):
            assert [rule.mode for rule in _rules(line, (0.99 * at, 1.01 * at))] == [one.mode]
    (said,) = _as_built(replace(slow, order=2.0), slow)
    assert "order 2 excited it most" in told(said, USUAL)
    assert "times" not in told(said, USUAL)


def test_ranges_of_speed_that_touch_are_one_where_stability_is_not_proved():
    pieces = [(300.0, 310.0), (100.0, 110.0), (110.0, 120.0), (500.0, 510.0), (700.0, 710.0), (2e3, 3e3)]
    exact: Any = SimpleNamespace(overlapping=lambda *_used: np.zeros(0, dtype=int), unproved=np.asarray(pieces))
    tone, said = _exactly(exact, (0.0, 600.0), (0.0, 700.0))
    assert tone == "warning"
    assert told(said, Reader(units={"angular_speed": "rad_s"})) == (
        "whether it is parametrically stable from 100.0 to 120.0 rad/s, 300.0 to 310.0 rad/s and 500.0 to "
        "510.0 rad/s is not proved"
    )
    _tone, said = _exactly(exact, (0.0, 1000.0), (0.0, 1100.0))
    assert "in further ranges" in told(said, USUAL)
