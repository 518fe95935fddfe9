"""Forces while the axes move: gyroscopic couples, masses that swing, power that the movement takes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, forces
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.models.geometry import geometry
from cardan.drive.movement import Harmonic as Swing
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.questions.forces.kinetostatics import gyroscopic_couple, parallel_ends
from cardan.questions.motion.moving_chain import moving_centres
from cardan.questions.motion.moving_points import moving_path

ANGLE = np.linspace(0.0, 40.0, 81)

POINTS = [(-0.4, 0, 0), (0, 0, 0), (0.9, 0.1, -0.2), (1.3, 0.1, -0.2)]

MOVE = Swing(moves=("joints[1]", "output"), frequency=60.0, amplitude=(0.0, 0.004, 0.02), phase=0.4)


def drive(**parts: object) -> Drive:
    bare = Drive.from_points(POINTS, yoke_angles=[0.3], start_phase=0.2)
    cross = Cross(span=0.08, mass=0.8, inertia=(0.002, 0.003, 0.004))
    shafts = (
        Shaft(number=1, inertia=0.02, mass=3.0, centre_of_mass=-0.2, transverse_inertia=0.05),
        Shaft(number=2, yoke_angle=0.3, inertia=0.03, mass=8.0, transverse_inertia=0.5, spline=Spline()),
        Shaft(number=3, inertia=0.2, mass=5.0, centre_of_mass=0.1, transverse_inertia=0.04),
    )
    own = {
        "joints": tuple(replace(joint, cross=cross) for joint in bare.joints),
        "shafts": shafts,
        "supports": (
            Support(shaft=1, position=-0.3, axial=True),
            Support(shaft=1, position=-0.1),
            Support(shaft=3, position=0.1),
            Support(shaft=3, position=0.3, axial=True),
        ),
        "duty": Duty(torque=100.0, speed=200.0),
    }
    return replace(bare, **(own | parts))  # type: ignore[arg-type]


def test_power_and_forces_balance_while_the_axes_move() -> None:
    found = forces(drive(), angle=ANGLE, movement=MOVE)
    assert found.power_left.max() < 1e-12
    assert found.force_left.max() < 1e-11
    assert found.moment_left.max() < 1e-11
    still = forces(drive(), angle=ANGLE)
    assert np.abs(found.reaction - still.reaction).max() > 10.0


def test_a_movement_that_hardly_moves_changes_nothing() -> None:
    calm = replace(MOVE, amplitude=(0.0, 1e-13, 1e-13))
    found, still = forces(drive(), angle=ANGLE, movement=calm), forces(drive(), angle=ANGLE)
    for name in ("shaft_torque", "secondary_couple", "reaction", "joint_force"):
        wanted = getattr(still, name)
        np.testing.assert_allclose(getattr(found, name), wanted, atol=1e-8 * np.abs(wanted).max())


def test_reactions_are_the_rate_of_momentum_of_the_whole_drive() -> None:
    """All external forces and moments against differences of momentum, from positions and spins of the movement alone.

    The drive carries no resisting torque; fourth-order differences over 2e-5 s leave about 1e-8.
    """
    one = replace(
        drive(), joints=tuple(replace(j, cross=None) for j in drive().joints), duty=Duty(torque=0.0, speed=200.0)
    )
    found = forces(one, angle=ANGLE, movement=MOVE)
    place = geometry(one)
    path = moving_path(place.points, (MOVE,))
    length = place.length[1]
    # The splined shaft is two uniform halves, the second of which keeps its place from joint 2: shaft, mass, point that
    # its place counts from, place. Inertia across is about the centre of the halves.
    bodies = ((0, 3.0, 1, -0.2), (1, 4.0, 1, 0.25 * length), (1, 4.0, 2, -0.25 * length), (2, 5.0, 2, 0.1))
    axial, across = (0.02, 0.03, 0.2), (0.05, 0.5 - 8.0 * (0.25 * length) ** 2, 0.04)
    base = np.asarray(POINTS[1])

    def momentum(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        now = moving_centres(path, times, yoke_angle=[0.3], speed=200.0, start_phase=0.2, normal=place.normal[0])
        p = np.zeros((times.size, 3))
        h = np.zeros((times.size, 3))
        e, rate = now.shafts.axis, now.shafts.axis_rate
        for k, mass, start, ahead in bodies:
            at = now.points[0][:, start] + ahead * e[:, k]
            v = now.points[1][:, start] + ahead * rate[:, k]
            p += mass * v
            h += np.cross(at - base, mass * v)
        for k in range(3):
            h += axial[k] * now.spins.spin[:, k, None] * e[:, k] + across[k] * np.cross(e[:, k], rate[:, k])
        return p, h

    times, step = ANGLE / 200.0, 2e-5
    parts = [momentum(times + k * step) for k in (-2, -1, 1, 2)]
    force, moment = (
        (part[0] - 8 * part[1] + 8 * part[2] - part[3]) / (12 * step)
        for part in ([row[k] for row in parts] for k in range(2))
    )
    now = moving_centres(path, times, yoke_angle=[0.3], speed=200.0, start_phase=0.2, normal=place.normal[0])
    e = now.shafts.axis
    pulls = [
        (found.reaction[k], now.points[0][:, 1 if k < 2 else 2] + x * e[:, 0 if k < 2 else 2])
        for k, x in enumerate((-0.3, -0.1, 0.1, 0.3))
    ]
    for k, mass, start, ahead in bodies:
        at = now.points[0][:, start] + ahead * e[:, k]
        pulls.append((np.broadcast_to(mass * np.asarray([0, 0, -9.80665]), at.shape), at))
    whole = sum(pull for pull, _at in pulls)
    turn = sum(np.cross(at - base, pull) for pull, at in pulls) + found.input_torque[:, None] * e[:, 0]
    np.testing.assert_allclose(whole, force, atol=1e-6 * np.abs(force).max())
    np.testing.assert_allclose(turn, moment, atol=1e-6 * np.abs(moment).max())


def test_what_slides_behind_a_spline_is_thrown_along_the_shaft() -> None:
    """The axial force of the half behind the spline is its mass times L̈ - (L - x)|ȧ|², in closed form; both halves."""
    one = replace(
        drive(duty=Duty(torque=0.0, speed=200.0)),
        joints=tuple(replace(j, cross=None) for j in drive().joints),
        settings=replace(drive().settings, gravity=(0.0, 0.0, 0.0)),
        shafts=(drive().shafts[1],),
    )
    found = forces(one, angle=ANGLE, movement=MOVE)
    place = geometry(one)
    now = moving_centres(moving_path(place.points, (MOVE,)), ANGLE / 200.0, yoke_angle=[0.3], speed=200.0)
    axis, swing = now.shafts.axis[:, 1], np.sum(now.shafts.axis_rate[:, 1] ** 2, axis=-1)
    first, last = (np.sum(now.points[2][:, k] * axis, axis=-1) for k in (1, 2))
    far = 0.25 * place.length[1]
    along = np.sum(found.joint_force * axis, axis=-1)
    # Each half is pulled by the joint at its own end alone: the spline passes no force along.
    np.testing.assert_allclose(along[0], 4.0 * (first - far * swing), rtol=1e-9, atol=1e-9 * np.abs(along).max())
    np.testing.assert_allclose(-along[1], 4.0 * (last + far * swing), rtol=1e-9, atol=1e-9 * np.abs(along).max())
    sliding = now.shafts.length_acceleration[:, 1] - now.shafts.length[:, 1] * swing
    np.testing.assert_allclose(last - first, sliding, rtol=1e-9, atol=1e-9 * np.abs(sliding).max())


def test_the_spline_rubs_against_its_sliding() -> None:
    rubbing = Spline(mean_diameter=0.05, friction=0.1)
    one = drive(shafts=(replace(drive().shafts[1], spline=rubbing),))
    found = forces(one, angle=ANGLE, movement=MOVE)
    path = moving_path(geometry(one).points, (MOVE,))
    rate = moving_centres(path, ANGLE / 200.0, yoke_angle=[0.3], speed=200.0).shafts.length_rate[:, 1]
    assert (np.sign(found.spline_thrust[0]) == -np.sign(rate)).all()
    assert set(np.sign(rate)) == {-1.0, 1.0}


def test_what_does_not_go_with_a_movement_is_refused() -> None:
    for duty, field in (
        (Duty(torque=1.0), "duty.speed"),
        (Duty(torque=1.0, speed=10.0, acceleration=1.0), "duty.acceleration"),
        (Duty(torque=1.0, speed=10.0, harmonics=(Harmonic(order=1, torque=1.0),)), "duty.harmonics"),
    ):
        with pytest.raises(InputError) as caught:
            forces(drive(), duty, [0.0], movement=MOVE)
        assert caught.value.field == field


def test_the_couple_of_a_swinging_shaft_is_the_rate_of_its_momentum() -> None:
    def joint_angle(t: float) -> tuple[float, float, float]:
        return 0.3 + 0.08 * np.sin(15 * t), 1.2 * np.cos(15 * t), -18.0 * np.sin(15 * t)

    def momentum(t: float) -> np.ndarray:
        axes, spins = parallel_ends(joint_angle(t), 0.7 + 120.0 * t, speed=120.0, yoke_angle=0.3)
        e, rate = axes[0][1], axes[1][1]
        return 0.02 * spins.spin[1] * e + 0.4 * np.cross(e, rate)

    axes, spins = parallel_ends(joint_angle(0.05), 6.7, speed=120.0, yoke_angle=0.3)
    middle = axes[0][1], axes[1][1], axes[2][1]
    found = gyroscopic_couple(middle, spins.spin[1], 0.02, 0.4)
    h = 1e-4
    rate = (momentum(0.05 - 2 * h) - 8 * momentum(0.05 - h) + 8 * momentum(0.05 + h) - momentum(0.05 + 2 * h)) / (
        12 * h
    )
    along = 0.02 * spins.spin_acceleration[1] * middle[0]
    np.testing.assert_allclose(found.whole, along - rate, atol=1e-5 * np.abs(rate).max())


def test_a_hooke_joint_needs_no_inertia_to_move() -> None:
    light = Drive(joints=(Hooke(centre=POINTS[1]), Hooke(centre=POINTS[2])), input=drive().input, output=drive().output)
    found = forces(light, Duty(torque=100.0, speed=200.0), ANGLE, movement=MOVE)
    assert found.reaction is None
    assert found.power_left.max() < 1e-12
