from dataclasses import replace

import numpy as np
import pytest

from cardan import assembly, example, forces
from cardan.drive.accuracy import Error
from cardan.drive.duty import Duty
from cardan.drive.models.dynamics_model import train, train_of_points
from cardan.drive.shaft import Segment
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.reactions import Determinacy

PUMP = example("overconstrained-pump")
FITTING = replace(
    PUMP,
    joints=tuple(replace(joint, error=Error()) for joint in PUMP.joints),
    supports=tuple(replace(support, offset=(0.0, 0.0, 0.0)) for support in PUMP.supports),
)
ANGLES = np.linspace(0.0, 2 * np.pi, 13)


def test_torque_and_misfit_add():
    whole, loaded, alone = forces(PUMP, angle=ANGLES), forces(FITTING, angle=ANGLES), assembly(PUMP, angle=ANGLES)
    largest = np.max(np.abs(whole.reaction))
    np.testing.assert_allclose(whole.reaction, loaded.reaction + alone.reaction, atol=1e-11 * largest)
    np.testing.assert_allclose(whole.joint_force, loaded.joint_force + alone.joint_force, atol=1e-11 * largest)
    assert int(whole.status) == Determinacy.INDETERMINATE


def test_what_is_determinate_does_not_care_for_misfit():
    rows = tuple(
        replace(support, axial=False, axial_stiffness=None) if k == 3 else support
        for k, support in enumerate(PUMP.supports)
        if k != 1
    )
    drives = [
        replace(one, supports=tuple(replace(s, offset=off) for s in rows))
        for one, off in ((PUMP, (0.0, 1e-3, 0.0)), (FITTING, (0.0, 0.0, 0.0)))
    ]
    found = [forces(one, Duty(torque=10.0), ANGLES).reaction for one in drives]
    np.testing.assert_array_equal(*found)


def test_many_drives_share_alike_in_one_call():
    one = train(FITTING)
    points = np.stack((one.points, one.points + np.asarray([0.0, 0.0, 1.0])))
    parts = {name: np.stack([getattr(one, name)] * 2) for name in ("position", "stiffness", "offset")}
    parts |= {name: np.stack([getattr(one, name)] * 2) for name in ("bending", "stretching")}
    many = kinetostatics(train_of_points(points, bearings=one.bearings, **parts), ANGLES, torque=[120.0, 240.0])
    single = kinetostatics(replace(one, mass=None, inertia=None, cross_mass=None, drag=None), ANGLES, torque=120.0)
    assert many.reaction.shape == (2, 4, 13, 3)
    largest = np.max(np.abs(single.reaction))
    np.testing.assert_allclose(many.reaction[0], single.reaction, atol=1e-10 * largest)
    np.testing.assert_allclose(many.reaction[1], 2 * single.reaction, atol=2e-10 * largest)
    assert np.max(many.moment_left) == pytest.approx(0.0, abs=1e-12)


def stepped(number, *parts):
    """Return the pump with the body of a shaft in stretches: length, outer diameter."""
    body = tuple(Segment(length=length, outer=outer) for length, outer in parts)
    shafts = [replace(one, outer=None, segments=body) if one.number == number else one for one in PUMP.shafts]
    return replace(PUMP, shafts=tuple(shafts))


def test_a_body_in_stretches_gives_way_as_one():
    whole = assembly(PUMP, angle=ANGLES)
    for number, parts in ((1, [(0.1, 0.04), (0.27, 0.04), (0.03, 0.04)]), (2, [(0.15, 0.035), (0.2, 0.035)])):
        found = assembly(stepped(number, *parts), angle=ANGLES)
        np.testing.assert_allclose(found.reaction, whole.reaction, atol=1e-10 * np.max(np.abs(whole.reaction)))


def test_stretches_stand_where_the_shaft_has_them():
    """Between its bearings the motor's shaft bends, in front of the far one it carries nothing."""
    whole, thin = (
        np.max(assembly(one, angle=ANGLES).reaction) for one in (PUMP, stepped(1, (0.02, 0.02), (0.38, 0.04)))
    )
    assert thin == pytest.approx(whole, rel=1e-10)
    weak = np.max(assembly(stepped(1, (0.2, 0.02), (0.2, 0.04)), angle=ANGLES).reaction)
    assert weak < 0.99 * whole
