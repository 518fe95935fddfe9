from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, motion
from cardan.drive.cross import Cross
from cardan.drive.models.dynamics_model import train
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.losses.loss_model import torque_flow
from cardan.questions.losses.loss_parts import response, trouble
from cardan.units import mm

PLACES = np.linspace(0.0, 2 * np.pi, 37)


def drive():
    """Return a heavy spatial drive, its journals rubbing, its supports just enough."""
    points = [[-0.4, 0, 0], [0, 0, 0], [0.9, 0.2, -0.3], [1.5, 0.1, -0.5]]
    places = [(1, -0.05, False), (1, -0.3, True), (3, 0.1, False), (3, 0.4, True)]
    made = Drive.from_points(points, yoke_angles=[0.4], start_phase=0.3)
    return replace(
        made,
        joints=tuple(
            replace(joint, friction=0.3, cross=Cross(span=80 * mm, journal=20 * mm, mass=1.5)) for joint in made.joints
        ),
        shafts=(
            Shaft(number=1, mass=4.0, centre_of_mass=-0.2),
            Shaft(number=2, yoke_angle=0.4, mass=6.0, spline=Spline(), inertia=0.05),
            Shaft(number=3, mass=3.0, centre_of_mass=0.25, resisting_torque=3.0),
        ),
        supports=tuple(Support(shaft=s, position=x, axial=axial, bore=0.04, friction=0.01) for s, x, axial in places),
    )


@pytest.mark.parametrize("speed", [150.0, -150.0])
@pytest.mark.parametrize("torque", [200.0, -20.0])
@pytest.mark.parametrize("at", ["output", "input"])
def test_forces_and_torques_are_those_of_kinetostatics(speed, torque, at):
    """The same drive by general statics: couples of the crosses as vectors, weights, one linear system."""
    whole = train(drive())
    moved = motion(drive(), PLACES)
    drawn = whole.resisting_torque[:, None] + whole.inertia[:, None] * speed**2 * moved.shaft_slope
    load = np.full(PLACES.size, torque)
    flow = torque_flow(moved, whole.drag, load, drawn=drawn, sense=np.sign(speed), torque_at=at)
    known = kinetostatics(whole, PLACES, torque=flow.leaving[-1], speed=speed)
    size = np.max(np.abs(known.shaft_torque))
    # Two joints of 20°, then a system of 21 equations of condition some tens: a hundred roundings.
    assert np.allclose(flow.entering, known.shaft_torque, rtol=0, atol=1e-13 * size)
    held = response(whole, whole.drag, PLACES).load(flow.couple, np.sign(speed))
    want = np.linalg.norm(known.reaction, axis=-1)
    assert np.allclose(held, want, rtol=0, atol=1e-12 * np.max(want))


def test_cases_are_a_batch():
    whole = train(drive())
    at = response(whole, whole.drag, PLACES)
    couple = np.random.default_rng(1).normal(size=(3, 2, 2, PLACES.size))
    sense = np.asarray([[1.0], [-1.0], [1.0]])
    many = at.load(couple, np.broadcast_to(sense, (3, 2)))
    assert many.shape == (3, 2, 4, PLACES.size)
    assert np.allclose(many[1, 0], at.load(couple[1, 0], -1.0), rtol=1e-13)
    apart = response(whole, whole.drag, np.stack((PLACES, PLACES + 1.0)))
    assert np.allclose(apart.load(couple[0], np.ones(2))[0], at.load(couple[0, 0], 1.0), rtol=1e-12)


def test_what_holds_too_much_or_too_little_is_said():
    one = drive()
    assert trouble(train(one)) == ""
    more = replace(one, supports=(*one.supports, Support(shaft=2, position=0.4)))
    assert "hold the drive 2 times more" in trouble(train(more))
    fewer = replace(one, supports=one.supports[:3])
    assert "3 ways to give" in trouble(train(fewer))
    crooked = (
        *one.supports[:3],
        replace(one.supports[3], axial=False),
        Support(shaft=1, position=-0.2, radial=False, axial=True),
    )
    assert "twice one way" in trouble(train(replace(one, supports=crooked)))
