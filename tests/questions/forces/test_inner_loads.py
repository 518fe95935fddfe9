"""What balls, rollers and cages carry, against closed forms and balances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, check, forces
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke, half_cardan
from cardan.errors import InputError
from cardan.formulas.hertz import point_contact
from cardan.io.drive_file import loads
from cardan.joints import Clemens, ClemensProfile, HalfCardan, PinCoupling, Rzeppa, Tracta, Tripod, Weiss
from cardan.questions.forces import answer as forces_answer
from cardan.questions.forces.inner_loads import inner_loads, thrusts, unit_loads, unit_thrust
from cardan.questions.motion.joint_mechanism import joint_carried

BEND = 0.35

ANGLE = np.linspace(0.0, 2.0 * np.pi, 25)[:-1] + 0.013

STEEP = np.radians(42.0)

BALLS = Rzeppa(
    driving_offset=0.005,
    driven_offset=0.005,
    groove_radius=0.032,
    ball_diameter=0.017,
    groove_conformity=0.52,
    pressure_angle=STEEP,
)

ROLLERS = Tripod(track_radius=0.019, roller_diameter=0.032, roller_crown=0.015, track_section=0.016)

HALF_SHAFT = """format = 1
[[joints]]
kind = "tripod"
joint_angle_deg = 6
track_radius_mm = 19
roller_diameter_mm = 32
roller_crown_mm = 15
track_section_mm = 16
friction = 0.03
[[joints]]
kind = "rzeppa"
joint_angle_deg = 30
driving_offset_mm = 5
driven_offset_mm = 5
groove_radius_mm = 32
ball_diameter_mm = 17
groove_conformity = 0.52
pressure_angle_deg = 42
[duty]
speed_rpm = 800
torque_Nm = 600
"""


def named(joint, joint_angle):
    return {one.name.split(" {")[0]: one for one in unit_loads(joint, joint_angle)}


def test_straight_balls_share_alike():
    """N = T/(z r sin δ), the balls on the radius √(R² - c²); the cage holds 2c/R cos δ of each."""
    found = named(BALLS, 0.0)
    radius = np.sqrt(0.032**2 - 0.005**2)
    each = 1.0 / (6.0 * radius * np.sin(STEEP))
    for name in ("bell groove of ball", "inner groove of ball"):
        assert found[name].high == pytest.approx(each)
        assert found[name].low == pytest.approx(each)
    assert found["cage window of ball"].high == pytest.approx(each * np.cos(STEEP) * 0.01 / 0.032)
    assert found["cage in the bell"].high == pytest.approx(3.0 * each * np.cos(STEEP) * 0.01 / 0.032)


@pytest.mark.parametrize("bend", [0.05, BEND, 0.7])
def test_balls_in_contact_turn_evenly_and_balance(bend):
    found = joint_carried(BALLS, bend, ANGLE, loads=True)
    assert np.max(found.found.open) < 1e-12
    assert np.max(found.found.unbalanced) < 1e-12
    assert np.abs(found.ratio - 1.0).max() < 1e-12
    assert np.abs(found.input_torque - 1.0).max() < 1e-12
    assert np.abs(found.wrench[:, 3:]).max() < 1e-9
    middle = np.asarray([1.0 + np.cos(bend), np.sin(bend), 0.0])
    assert np.abs(np.cross(found.wrench[:, :3], middle)).max() < 1e-12


def test_the_cage_is_in_balance_and_holds_what_both_grooves_leave():
    """By hand: force and tilting moment on the cage, and the torque that each ball passes on, N r sin δ."""
    found = joint_carried(BALLS, BEND, ANGLE, loads=True)
    force, point = found.found.reaction[..., 3:], found.placed.point
    bell, inner, window = (slice(k, 18, 3) for k in range(3))
    assert np.linalg.norm(force[:, bell] - force[:, inner] + force[:, window], axis=-1).max() < 1e-9
    assert np.abs(np.sum(np.cross(point[:, window], force[:, window]), axis=1)).max() < 1e-9
    radius = np.linalg.norm(np.cross([1.0, 0.0, 0.0], point[:, bell]), axis=-1)
    torque = np.cross(point[:, bell], force[:, bell])[..., 0]
    size = np.linalg.norm(force[:, bell], axis=-1)
    assert np.abs(torque) == pytest.approx(size * radius * np.sin(STEEP))
    assert np.sum(torque, axis=1) == pytest.approx(1.0)


def test_balls_of_a_slightly_bent_joint_keep_the_cage_in_balance():
    """By hand, to first order in the joint angle: N (1 - R/c tan δ tan(α/2) sin φ - (c/r) tan(α/2) cos φ), the bell

    driving: the first keeps the cage in balance, the second is the radius on which the ball stands.
    """
    bend = 1e-4
    found = joint_carried(BALLS, bend, ANGLE, loads=True)
    force = np.sum(found.found.reaction[:, 0, 3:] * found.placed.axis[:, 0], axis=-1)
    share = 0.032 / 0.005 * np.tan(STEEP) * np.tan(0.5 * bend)
    aside = 0.005 / np.sqrt(0.032**2 - 0.005**2) * np.tan(0.5 * bend)
    expected = 1.0 - share * np.sin(ANGLE) - aside * np.cos(ANGLE)
    assert force / np.mean(force) == pytest.approx(expected, abs=0.032 / 0.005 * bend * share)  # what follows


def test_rollers_of_a_straight_tripod_share_alike():
    (found,) = unit_loads(ROLLERS, 0.0)
    assert found.count == 3
    assert found.high == pytest.approx(1.0 / (3.0 * 0.019))
    assert found.low == pytest.approx(1.0 / (3.0 * 0.019))


def test_balls_of_a_straight_weiss_joint_share_alike():
    joint = Weiss(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03)
    (found,) = unit_loads(joint, 1e-9)
    assert found.high == pytest.approx(1.0 / (2.0 * np.sqrt(0.03**2 - 0.004**2)))


def test_friction_of_a_tripod_pushes_in_third_order():
    """To first order in friction and joint angle each roller pushes with μT/(3R) as it runs; the signs of three sines

    120° apart add up to that of sin 3φ: a square wave of μT/(3R), of third order 4/π of it.
    """
    friction, share = 1e-4, 1.0 / (3.0 * 0.019)
    joint = replace(ROLLERS, friction=friction)
    for row in unit_thrust(joint, 0.01):
        assert np.max(np.abs(row)) == pytest.approx(friction * share, rel=1e-3)
        orders = 2.0 * np.abs(np.fft.rfft(row)) / row.size
        assert orders[3] == pytest.approx(4.0 / np.pi * friction * share, rel=1e-3)
        assert np.argmax(orders) == 3


def test_a_half_shaft_tells_its_balls_and_rollers():
    drive = loads(HALF_SHAFT)
    found = inner_loads(drive, forces(drive))
    assert [(one.joint, one.count) for one in found] == [(1, 3), (2, 6), (2, 6), (2, 6), (2, 1), (2, 1)]
    roller = found[0]
    assert roller.pressure == pytest.approx(
        float(point_contact(roller.high, 1.0 / 0.015 - 1.0 / 0.016, 2.0 / 0.032).pressure)
    )
    bell, inner = (one.pressure for one in found[1:3])
    assert bell < inner  # hollow along its way, the groove of the bell fits the ball better
    (push,) = thrusts(drive, forces(drive))
    assert push.order == 3
    assert push.amplitude == pytest.approx(4.0 / np.pi * 0.03 * 600.0 / 0.057, rel=0.1)  # first order in friction


def test_the_table_stands_in_forces():
    drive = loads(HALF_SHAFT)
    told = forces_answer.answer(drive, forces_answer.ask(drive))
    (table,) = (one for one in told.tables if one.name == "inside_joints")
    columns = {one.key: one.values for one in table.columns}
    assert columns["part"][1] == "bell groove of ball 1–6"
    assert columns["couple_max"] == [0.0] * 6
    assert [one.code for one in told.remarks].count("generated_axial_force") == 1
    assert told.facts["generated_axial_force"][0]["order"] == 3


def test_pressure_of_balls_and_rollers_is_judged():
    drive = loads(HALF_SHAFT)
    found = forces(drive)
    worst = {one.joint: one.pressure for one in inner_loads(drive, found) if one.pressure}
    verdicts = check(drive, only=["inner_pressure"])
    assert [one.value for one in verdicts] == pytest.approx([worst[1], worst[2]])
    assert [one.limit for one in verdicts] == [4000e6, 4200e6]
    many = check(drive, only=["inner_pressure"], vary={"duty.torque_Nm": [600.0, 4800.0]})
    assert np.asarray(many[0].value)[1] == pytest.approx(2.0 * worst[1])


@pytest.mark.slow
def test_pressure_over_many_joint_angles_lies_between_full_ones():
    drive = loads(HALF_SHAFT)
    angles = np.linspace(20.0, 31.3, 12)
    many = check(drive, only=["inner_pressure"], vary={"joints[1].joint_angle_deg": angles})[1].value
    for k in (3, 8):
        joints = (drive.joints[0], replace(drive.joints[1], joint_angle=np.radians(angles[k])))
        own = check(replace(drive, joints=joints), only=["inner_pressure"])[1].value
        assert many[k] == pytest.approx(float(own), rel=1e-4)  # straight between half degrees


def test_what_the_pressure_lacks_is_named():
    drive = loads(HALF_SHAFT.replace("ball_diameter_mm = 17\n", ""))
    rows = check(drive, only=["inner_pressure"])
    assert rows[1].missing == ("joints[1].ball_diameter",)
    uneven = loads(HALF_SHAFT.replace("driven_offset_mm = 5\n", "driven_offset_mm = 5.1\n"))
    assert "do not fit" in check(uneven, only=["inner_pressure"])[1].unfit


TONGUE = Tracta(
    driving_distance=0.03,
    driven_distance=0.03,
    swivel_diameter=0.05,
    swivel_length=0.04,
    swivel_width=0.01,
    tongue_length=0.05,
    tongue_width=0.02,
    tongue_height=0.015,
)


def drive_of(joint):
    return Drive(joints=(replace(joint, joint_angle=BEND),), duty=Duty(torque=100.0, speed=50.0))


def test_swivels_and_tongue_press_on_their_areas():
    """Straight, swivel and tongue pass on the torque as a couple: on both faces the torque over their distance.

    Bent, both forks stand at half the joint angle to the middle: a swivel turns in its fork as a cross in its yoke.
    """
    straight = drive_of(TONGUE)
    straight = replace(straight, joints=(replace(TONGUE, joint_angle=0.0),))
    swivel, tongue, _other = inner_loads(straight, forces(straight))
    assert swivel.pressure == pytest.approx(100.0 / 0.04 / (0.05 * 0.01))
    assert tongue.pressure == pytest.approx(100.0 / 0.05 / (0.02 * 0.015))
    assert swivel.heating == pytest.approx(0.0, abs=1e-6)
    drive = drive_of(TONGUE)
    found = forces(drive)
    swivel = inner_loads(drive, found)[0]
    theta = np.linspace(0.0, 2.0 * np.pi, 73)
    half, inside = 0.5 * BEND, joint_carried(TONGUE, BEND, theta, loads=True)
    reaction = inside.found.reaction[:, 0]
    face = 100.0 * (0.5 * np.linalg.norm(reaction[:, 3:], axis=-1) + np.linalg.norm(reaction[:, :3], axis=-1) / 0.04)
    rate = 50.0 * np.tan(half) * np.cos(theta) / (1.0 + (np.tan(half) * np.sin(theta)) ** 2)
    assert swivel.high == pytest.approx(np.max(face), rel=1e-6)
    most = np.max(face * 0.025 * np.abs(rate)) / (0.05 * 0.01)
    assert swivel.heating == pytest.approx(most, rel=1e-3)  # straight between places 5° apart


def test_crossed_pins_press_by_hertz():
    joint = PinCoupling(driving_distance=0.05, driven_distance=0.05, pin_diameter=0.012)
    drive = drive_of(joint)
    pins = inner_loads(drive, forces(drive))
    assert pins[0].pressure == pytest.approx(pins[1].pressure)
    assert pins[0].heating is None
    # in the plane of the shafts, the pin on the inner side of the bend: at 45° to both, 90° + α to each other
    (one, _two) = unit_loads(joint, BEND)
    angle = np.cos(np.pi / 2 - BEND)
    own = point_contact(one.high[0], 2.0 * (1.0 + angle) / 0.012, 2.0 * (1.0 - angle) / 0.012).pressure
    assert np.isclose(float(point_contact(one.high[0], one.contact.across[0], one.contact.along[0]).pressure), own)
    assert pins[0].pressure >= own * 100.0 ** (1.0 / 3.0) * (1.0 - 1e-9)


def test_hinges_of_a_clemens_coupling_press_on_their_pins():
    joint = Clemens(
        driving=ClemensProfile(axial=0.05, radial=0.02, radius=0.06),
        hinge_diameter=0.01,
        hinge_length=0.03,
        hinge_width=0.008,
        tip_diameter=0.012,
    )
    drive = drive_of(joint)
    hinge, _other, tip = inner_loads(drive, forces(drive))
    assert hinge.pressure == pytest.approx(hinge.high / (0.01 * 0.008))
    assert tip.pressure == pytest.approx(tip.high / (np.pi * 0.006**2))
    assert 0.0 < hinge.heating < hinge.pressure * 0.005 * 50.0
    assert inner_loads(drive, forces(drive, Duty(torque=100.0)))[0].heating is None


def test_teeth_of_a_half_joint_share_the_torque_by_their_stiffness():
    """Springs that push, 20 of them, against the one pair that carries all where they are rigid; T/(2r) for a pair."""
    bend, radius, torque, stiffness = np.radians(2.0), 0.06, 500.0, 4e5
    rigid = HalfCardan(joint_angle=bend, pairs=20, face_radius=radius)
    drives = [
        Drive(joints=(Hooke(joint_angle=bend), one), duty=Duty(torque=torque, speed=100.0))
        for one in (rigid, replace(rigid, pair_stiffness=stiffness))
    ]
    alone, shared = ([row for row in inner_loads(one, forces(one)) if row.joint == 2] for one in drives)
    assert [row.high for row in alone] == pytest.approx([torque / (2 * radius)] * 2, rel=2e-3)
    (row,) = shared
    places = np.linspace(0.0, np.pi, 4001)
    own = half_cardan.shares(places, bend, 20, torque / stiffness) * stiffness / (2 * radius)
    assert row.high == pytest.approx(own.max(), rel=1e-3)
    assert (row.count, row.low) == (20, 0.0)
    np.testing.assert_allclose(own.sum(axis=-1) * 2 * radius, torque, rtol=1e-9)


def test_the_stiffness_of_teeth_goes_with_their_radius():
    with pytest.raises(InputError, match="goes with pair_stiffness"):
        Drive(joints=(HalfCardan(joint_angle=0.03, pairs=20, pair_stiffness=4e5),))
