"""The equations of motion against finite differences, energy and the closed angle law."""

from __future__ import annotations

import numpy as np
import pytest

from cardan.errors import InputError
from cardan.questions.torsion.model.inputs import Asynchronous, Falling, SpeedTable, Swinging
from cardan.questions.torsion.model.torsional_balance import (
    accelerations,
    balance,
    energy,
    joint_law,
    places,
    power,
    slopes,
)
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line


def line(*, forced: bool = False, backlash: float = 0.0) -> TorsionalModel:
    """Return four shafts, one of them rigid, with every kind of damping and of torque that depends on the motion."""
    torques = (
        Torque(station=7, law=Falling(standstill=-3.0, slope=0.2)),
        Torque(station=1, law=Swinging(amplitude=5.0, frequency=1.5, phase=0.3)),
        Torque(station=0, law=Asynchronous(synchronous_speed=30.0, pullout_torque=40.0, pullout_slip=0.2)),
        Torque(station=6, law=SpeedTable(speeds=np.asarray([0.0, 40.0]), torques=np.asarray([4.0, -9.0]))),
    )
    return torsional_line(
        [[1.0, 0.02], [0.03], [0.02, 0.2, 0.02], [0.4, 0.1]],
        stiffness=[[4000.0], [], [900.0, 900.0], [500.0]],
        damping=[[1.0], [], [0.3, 0.2], [0.1]],
        backlash=[[backlash], [], [0.0, 0.0], [0.0]],
        ground_damping=[[0.1, 0.2], [0.3], [0.1, 0.1, 0.1], [0.0, 0.2]],
        joint_angle=[0.4, 0.5, 0.3],
        phase=[0.1, 1.2, 2.0],
        torques=torques,
        input_speed=20.0 if forced else None,
    )


@pytest.fixture
def motion() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return coordinates, speeds and accelerations of seven moments."""
    rng = np.random.default_rng(1)
    q = np.cumsum(rng.normal(size=(7, 5)) * 0.01, axis=-1) + rng.normal(size=(7, 1))
    return q, 20.0 + rng.normal(size=(7, 5)), 50.0 * rng.normal(size=(7, 5))


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.5, 2.8, 40.1, -7.3])
def test_the_joint_law_is_that_of_the_tangents_and_its_derivatives_are_its_differences(angle: float) -> None:
    joint_angle, step = 0.7, 1e-4
    whole, first, second, third = joint_law(np.asarray(angle), np.asarray(joint_angle))
    assert np.tan(whole) == pytest.approx(np.tan(angle) / np.cos(joint_angle), rel=1e-11)
    assert abs(whole - angle) < 0.2  # unwrapped: never further from the input than the angle error
    for lower, upper in ((0, first), (1, second), (2, third)):
        ends = [joint_law(np.asarray(angle + side * step), np.asarray(joint_angle))[lower] for side in (1.0, -1.0)]
        assert (ends[0] - ends[1]) / (2.0 * step) == pytest.approx(upper, abs=1e-6)


def test_the_slopes_are_the_differences_of_the_balance(motion: tuple[np.ndarray, ...]) -> None:
    q, rate, acceleration = motion
    model = line()
    found = slopes(model, q, rate, acceleration)
    step = 1e-6
    for s in range(model.coordinates):
        side = np.zeros(model.coordinates)
        side[s] = step
        by_q = balance(model, q + side, rate, acceleration) - balance(model, q - side, rate, acceleration)
        by_rate = balance(model, q, rate + side, acceleration) - balance(model, q, rate - side, acceleration)
        np.testing.assert_allclose(by_q / (2 * step), found.stiffness[..., s], atol=1e-6 * 4000.0)
        np.testing.assert_allclose(by_rate / (2 * step), found.damping[..., s], atol=1e-6 * 4000.0)


def test_the_balance_vanishes_at_the_accelerations(motion: tuple[np.ndarray, ...]) -> None:
    q, rate, _acceleration = motion
    model = line()
    left = balance(model, q, rate, accelerations(model, q, rate))
    assert np.max(np.abs(left)) < 1e-9


@pytest.mark.parametrize("forced", [False, True])
def test_energy_changes_by_what_the_torques_bring_and_the_dampers_take(
    motion: tuple[np.ndarray, ...], forced: bool
) -> None:
    q, rate, _acceleration = motion
    model = line(forced=forced, backlash=0.004)
    change = accelerations(model, q, rate)
    step = 1e-6
    ahead = energy(model, q + step * rate, rate + step * change)
    behind = energy(model, q - step * rate, rate - step * change)
    given, lost = power(model, q, rate)
    brought = balance(model, q, rate, change)[..., 0] * rate[..., 0] if forced else 0.0
    np.testing.assert_allclose((ahead - behind) / (2 * step), given - lost + brought, rtol=1e-6, atol=1e-3)


def test_many_drives_at_many_moments_equal_each_alone(motion: tuple[np.ndarray, ...]) -> None:
    q, rate, acceleration = motion
    joint_angles = np.asarray([[0.1, 0.2, 0.3], [0.5, 0.0, 0.6]])
    model = line()
    parts = dict(vars(model))
    for name in ("coordinate", "owner"):
        parts.pop(name, None)
    many = TorsionalModel(**{**parts, "joint_angle": joint_angles})
    whole = balance(many, np.stack([q, q]), np.stack([rate, rate]), np.stack([acceleration, acceleration]))
    for k in range(2):
        one = TorsionalModel(**{**parts, "joint_angle": joint_angles[k]})
        np.testing.assert_allclose(whole[k], balance(one, q, rate, acceleration), rtol=1e-13, atol=1e-9)


def test_a_rigid_shaft_passes_its_angle_through_both_joints() -> None:
    model = torsional_line(
        [[1.0], [0.1], [1.0]], stiffness=[[], [], []], joint_angle=[0.5, 0.5], phase=[0.0, np.pi / 2]
    )
    q = np.linspace(0.0, 7.0, 50)[:, None]
    assert model.coordinates == 1
    np.testing.assert_allclose(places(model, q).angle[:, 2], q[:, 0], atol=1e-14)  # a Z drive turns evenly


def test_every_fault_is_named_at_once() -> None:
    with pytest.raises(InputError) as caught:
        torsional_line(
            [[1.0, -0.1], [0.1, 0.2]],
            stiffness=[[0.0], [5.0]],
            joint_angle=[1.6],
            torques=[Torque(station=9, law=Falling(standstill=1.0, slope=0.0))],
        )
    assert [problem.field for problem in caught.value.problems] == [
        "inertia[1]",
        "stiffness[0]",
        "joints[0].joint_angle",
        "torques[0].station",
    ]
