"""Forces of drives with joints of other kinds, against statics written out by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, example, forces, motion
from cardan.drive.described import Input, Output
from cardan.drive.duty import Duty
from cardan.drive.joints import JOINTS, Hooke
from cardan.drive.models.geometry import geometry
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.joints import (
    Clemens,
    ClemensProfile,
    ConstantVelocity,
    DoubleCardan,
    HalfCardan,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
)
from tests.fixtures.joint_keys import OWN

DUTY = Duty(torque=400.0, speed=120.0, acceleration=30.0)

PROFILE, OTHER = (ClemensProfile(axial=0.05, radial=radial, radius=0.06) for radial in (0.02, 0.021))

ROUNDING = 1e-12
"""Share of the largest term that a dozen sums of double precision leave."""


def held(*joints, **more):
    """Return a drive through three joints or fewer, held just enough, with masses."""
    places = [(0.0, 0.0, 0.0), (0.6, 0.05, 0.1), (1.2, 0.3, 0.1)][: len(joints)]
    n = len(joints)
    supports = [Support(shaft=1, position=-0.3, axial=True), Support(shaft=1, position=-0.1)]
    supports += [Support(shaft=n + 1, position=at) for at in (0.1, 0.3)[: min(n, 2)]]
    supports += [Support(shaft=2, position=0.25)] if n == 3 else []
    shafts = tuple(
        Shaft(number=k, yoke_angle=0.3 * k, mass=4.0, inertia=0.01, centre_of_mass=0.2)
        for k in range(2, len(joints) + 1)
    )
    return Drive(
        joints=tuple(replace(joint, centre=place) for joint, place in zip(joints, places, strict=True)),
        input=Input(point=(-0.4, 0.0, 0.0), start_phase=0.2),
        output=Output(point=(places[-1][0] + 0.5, 0.1, 0.4)),
        shafts=shafts,
        supports=tuple(supports),
        duty=DUTY,
        **more,
    )


CHAINS = [
    (ConstantVelocity(),),
    (Hooke(), ConstantVelocity()),
    (DoubleCardan(centring_ratio=0.4), Hooke(), Tracta(driving_distance=0.02, driven_distance=0.023)),
    (Rzeppa(), Hooke(), DoubleCardan()),
    (Hooke(), Rzeppa(lever_b=0.35, lever_c=0.7)),
]


@pytest.mark.parametrize("joints", CHAINS)
def test_power_forces_and_moments_balance(joints):
    found = forces(held(*joints))
    for left in (found.power_left, found.force_left, found.moment_left):
        assert np.max(left) < ROUNDING


@pytest.mark.parametrize("joints", CHAINS)
def test_every_shaft_balances_by_plain_sums(joints):
    """Forces at the joints and supports, weight and couples of each shaft, added up about the origin."""
    drive = held(*joints)
    found = forces(drive)
    place = geometry(drive)
    n = len(joints)
    couple = [np.zeros((361, 3)), *found.driven_couple]
    back = [*found.driving_couple, np.zeros((361, 3))]
    size = np.max(np.abs(found.secondary_couple)) + 1.0
    for s in range(n + 1):
        axis = place.axis[s]
        start = place.points[1] if s == 0 else place.points[s]
        moment = couple[s] - back[s]
        if s == 0:
            moment = moment + found.input_torque[:, None] * axis
        if s == n:
            moment = moment - found.output_torque[:, None] * axis
        force = np.zeros((361, 3))
        for i, pull in enumerate(found.joint_force):
            for shaft, sign in ((i, -1.0), (i + 1, 1.0)):
                if shaft == s:
                    force = force + sign * pull
                    moment = moment + sign * np.cross(place.points[i + 1], pull)
        for k, support in enumerate(drive.supports):
            if support.shaft == s + 1:
                force = force + found.reaction[k]
                at = start + support.position * axis
                moment = moment + found.support_couple[k] + np.cross(at, found.reaction[k])
        shaft = drive.shafts[s]
        if shaft.mass:
            weight = shaft.mass * np.asarray(drive.settings.gravity)
            force = force + weight
            moment = moment + np.cross(start + shaft.centre_of_mass * axis, weight)
        turning = (shaft.inertia or 0.0) * found.acceleration[s][:, None] * axis
        assert np.abs(force).max() < ROUNDING * np.abs(found.reaction).max()
        assert np.abs(moment - turning).max() < ROUNDING * size


def test_the_couple_of_a_constant_velocity_joint_halves_the_angle_of_its_shafts():
    drive = Drive(joints=(ConstantVelocity(joint_angle=0.7),))
    found = forces(drive, Duty(torque=100.0), [0.0, 1.0])
    one, two = found.axis[:, 0]
    middle = (one + two) / np.linalg.norm(one + two)
    assert found.driving_couple[0] == pytest.approx(np.tile(100.0 / np.cos(0.35) * middle, (2, 1)))
    assert found.bending_couple == pytest.approx(np.full((2, 2), 100.0 * np.tan(0.35)))


def test_a_joint_that_turns_as_a_cross_carries_as_one():
    """A double joint bent at its first cross only is a Hooke joint; a law of the same map gives the same couples."""
    from cardan.drive.models.kinematics_model import Chain, alike
    from cardan.questions.forces.kinetostatics import kind_arms
    from cardan.questions.motion.motion import motion

    joint_angle = np.asarray([0.5, 0.3])
    drive = Drive.from_angles(joint_angle.tolist(), plane_twists=[0.4], yoke_angles=[0.2])
    place = geometry(drive)
    _joint_angle, _twist, _start, laws = alike(drive.joints, joint_angle, np.asarray([0.4]))
    chain = Chain(
        joint_angle=joint_angle,
        plane_twist=np.asarray([0.4]),
        yoke_angle=np.asarray([0.2]),
        start_phase=np.zeros(()),
        laws=laws,
    )
    found = motion(chain)
    _u, _v, crossed = kind_arms(chain, place.axis, place.normal, found)
    owned = replace(chain, laws=replace(laws, own=(True, True)))
    _u, _v, free = kind_arms(owned, place.axis, place.normal, found)
    assert np.abs(np.abs(np.sum(crossed * free, axis=-1)) - 1.0).max() < 1e-13


@pytest.mark.parametrize("kind", sorted(JOINTS))
def test_kinds_that_statics_cannot_tell_are_refused_by_name(kind):
    known = {"offset_cross": {"offset": 0.01, "reach": 0.3}, **OWN}.get(kind, {})
    joint = JOINTS[kind](joint_angle=0.04, **known)
    drive = Drive(joints=(Hooke(joint_angle=0.1), joint))
    if joint.ball is not None:
        with pytest.raises(InputError, match=r"^shafts\[1\]\.length: missing; the balance of moments needs it"):
            forces(drive, Duty(torque=1.0))
        return
    if joint.fixed:
        assert np.all(np.isfinite(forces(drive, Duty(torque=1.0)).input_torque))
        return
    with pytest.raises(InputError, match=rf"^joints\[1\]\.kind: forces: not answered for a joint of kind {kind}: "):
        forces(drive, Duty(torque=1.0))


def test_drives_of_hooke_joints_carry_what_they_did():
    drive = example("truck-supports")
    one, other = forces(drive), forces(replace(drive, name="again"))
    assert np.array_equal(one.reaction, other.reaction)
    assert np.max(one.moment_left) < 1e-9


@pytest.mark.parametrize("joint", [Tripod(), HalfCardan()])
def test_a_joint_that_slides_takes_no_force_along_its_driving_shaft(joint):
    drive = held(joint, Hooke())
    stop = Support(shaft=3, position=0.4, radial=False, axial=True)
    found = forces(replace(drive, supports=(*drive.supports, stop)))
    for left in (found.power_left, found.force_left, found.moment_left):
        assert np.max(left) < ROUNDING
    along = np.sum(found.joint_force[0] * found.axis[0], axis=-1)
    assert np.abs(along).max() < 1e-9 * np.abs(found.joint_force[0]).max()


@pytest.mark.parametrize(
    "joint", [PinCoupling(driving_distance=0.05, driven_distance=0.06), Clemens(driving=PROFILE, driven=OTHER)]
)
def test_a_contact_pushes_its_shafts_apart(joint):
    """Two shafts, each in two bearings: their forces balance force and couple of the contact, summed here by hand."""
    drive = held(joint)
    stop = Support(shaft=2, position=0.3, radial=True, axial=True)
    drive = replace(drive, supports=(*drive.supports[:2], drive.supports[2], stop), duty=Duty(torque=100.0))
    drive = replace(drive, settings=replace(drive.settings, gravity=(0.0, 0.0, 0.0)))
    found = forces(drive)
    for left in (found.power_left, found.force_left, found.moment_left):
        assert np.max(left) < ROUNDING
    behind = np.sum(found.reaction[2:], axis=0)
    place = geometry(drive)
    theta = np.asarray(motion(drive).yoke_rotation)[0]
    push = np.asarray(joint.push(theta, np.asarray(place.joint_angle[0]))) * found.output_torque[:, None]
    basis = np.stack((place.axis[0], np.cross(place.normal[0], place.axis[0]), place.normal[0]))
    assert np.abs(behind + push @ basis).max() < 1e-9 * np.abs(behind).max()
    assert np.abs(found.joint_force[0] - push @ basis).max() < 1e-12 * np.abs(behind).max()
