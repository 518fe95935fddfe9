"""Forces of drives against plain balances, closed forms and differentiated momenta."""

from __future__ import annotations

from dataclasses import replace

import array_api_strict
import mpmath as mp
import numpy as np
import pytest

from cardan import Drive, InputError, forces, motion
from cardan.book.joint_forces import double_joint_forces, single_joint_forces
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.models.dynamics_model import Train, spline_grip, train, train_of_points
from cardan.drive.models.geometry import points_from_angles
from cardan.drive.models.kinematics_model import Chain
from cardan.drive.settings import Settings
from cardan.drive.shaft import PointMass, Shaft, Spline
from cardan.drive.support import Support
from cardan.maths.kernel import frames
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.reactions import Determinacy
from cardan.questions.losses.chain_friction import chain_friction
from cardan.units import deg
from tests.builders.trains import one, shaft_rests, trains
from tests.builders.vector_model import VectorModel

ANGLE = np.linspace(0.0, 2 * np.pi, 37)

PARALLEL = [(-0.4, 0, 0), (0, 0, 0), (0.7, 0, -0.2), (1.1, 0, -0.2)]

HELD = (
    Support(shaft=1, position=-0.3, axial=True),
    Support(shaft=1, position=-0.1),
    Support(shaft=3, position=0.1),
    Support(shaft=3, position=0.3),
)


@pytest.mark.parametrize("n", range(1, 7))
@pytest.mark.parametrize("drag", [0.0, 0.03])
@pytest.mark.parametrize("heavy", [False, True])
def test_power_and_the_whole_drive_balance(n: int, heavy: bool, drag: float) -> None:
    random = np.random.default_rng(n)
    many = trains(random, n, (20,), heavy=heavy, drag=drag)
    found = kinetostatics(many, ANGLE, torque=100.0, speed=150.0, acceleration=-40.0)
    # a chain of six is some fifty operations deep; its condition takes two digits of sixteen
    assert found.power_left.max() < 1e-12
    assert found.force_left.max() < 1e-11
    assert found.moment_left.max() < 1e-11
    assert (found.equations, found.unknowns) == (5 * (n + 1), 5 * (n + 1))
    assert (found.loss >= 0.0).all()
    assert (found.loss.max() > 0.0) == bool(drag)


@pytest.mark.parametrize("n", range(1, 7))
def test_every_shaft_balances_by_itself(n: int) -> None:
    """Plain sums in space, shaft by shaft: action and reaction in every joint, no component left out."""
    single = one(trains(np.random.default_rng(10 + n), n, (1,), drag=0.02), 0)
    found = kinetostatics(single, ANGLE, torque=100.0, speed=150.0, acceleration=70.0)
    force, moment = shaft_rests(single, found, found.output_torque)
    size = max(np.abs(found.reaction).max(), np.abs(found.driving_couple).max())
    assert force < 1e-11 * size
    assert moment < 1e-11 * size


def test_a_batch_gives_what_single_drives_give() -> None:
    many = trains(np.random.default_rng(3), 4, (5,), drag=0.02)
    torque = np.linspace(50.0, 90.0, 5)
    whole = kinetostatics(many, ANGLE, torque=torque, speed=150.0)
    for k in range(5):
        single = kinetostatics(one(many, k), ANGLE, torque=torque[k], speed=150.0)
        for name in ("shaft_torque", "secondary_couple", "joint_force", "reaction", "loss", "speed"):
            got, wanted = getattr(whole, name)[k], getattr(single, name)
            np.testing.assert_allclose(got, wanted, rtol=1e-11, atol=1e-11 * np.abs(wanted).max())
        np.testing.assert_allclose(whole.journals.load[k], single.journals.load, rtol=1e-10, atol=1e-8)


def test_any_array_library_computes_it() -> None:
    strict = array_api_strict
    random = np.random.default_rng(4)
    plain = trains(random, 3, (2,))
    arrays = {
        name: strict.asarray(value)
        for name, value in vars(plain).items()
        if isinstance(value, np.ndarray) and name not in ("bearings",)
    }
    chain = Chain(**{name: strict.asarray(value) for name, value in vars(plain.chain).items() if value is not None})
    foreign = replace(plain, chain=chain, **arrays)
    got = kinetostatics(foreign, strict.asarray(ANGLE), torque=strict.asarray(100.0), speed=strict.asarray(150.0))
    wanted = kinetostatics(plain, ANGLE, torque=100.0, speed=150.0)
    assert type(got.reaction) is type(strict.asarray(ANGLE))
    np.testing.assert_allclose(np.asarray(got.reaction), wanted.reaction, rtol=1e-9)
    np.testing.assert_allclose(np.asarray(got.journals.load), wanted.journals.load, rtol=1e-9, atol=1e-6)


def momentum_rates(points: np.ndarray, gamma: float, psi: float, inertia: np.ndarray, speed: float, phi: float) -> list:
    """Return Ḣ of both crosses of a double joint at constant input speed, from positions of 40 digits."""
    with mp.workdps(40):
        exact = [[mp.mpf(float(x)) for x in row] for row in points]
        model = VectorModel.from_points(exact, [mp.mpf(gamma)], mp.mpf(psi), lib=mp)
        step = mp.mpf(10) ** -10

        def frame(i: int, t: mp.mpf) -> mp.matrix:
            driving, driven = model.arms(mp.mpf(phi) + speed * t)
            u, v = driving[i], driven[i]
            n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            return mp.matrix([[u[k], v[k], n[k]] for k in range(3)])

        def momentum(i: int, t: mp.mpf) -> mp.matrix:
            now = frame(i, t)
            turn = (frame(i, t + step) - frame(i, t - step)) / (2 * step) * now.T
            omega = mp.matrix([turn[2, 1], turn[0, 2], turn[1, 0]])
            return now * mp.diag([mp.mpf(float(x)) for x in inertia[i]]) * now.T * omega

        return [np.asarray([float(x) for x in (momentum(i, step) - momentum(i, -step)) / (2 * step)]) for i in range(2)]


def test_crosses_turn_by_the_rate_of_their_momentum() -> None:
    points = np.asarray([[-0.4, 0, 0], [0, 0, 0], [0.7, 0.25, 0.1], [1.1, 0.25, 0.1]])
    inertia = np.asarray([[0.001, 0.002, 0.0025], [0.004, 0.001, 0.003]])
    drive = train_of_points(points, yoke_angle=np.asarray([0.5]), start_phase=0.2, cross_inertia=inertia)
    found = kinetostatics(drive, np.asarray([0.9]), torque=10.0, speed=90.0)
    for i, wanted in enumerate(momentum_rates(points, 0.5, 0.2, inertia, 90.0, 0.9)):
        # differences of second order with a step of 1e-10 turns: error about 1e-15 of ω³
        np.testing.assert_allclose(
            found.driving_couple[i, 0] - found.driven_couple[i, 0], wanted, atol=1e-9 * np.abs(wanted).max()
        )


def test_z_cancels_and_v_doubles() -> None:
    for joint_angle in (10 * deg, 30 * deg, 55 * deg):
        ends = []
        for twist in (0.0, np.pi):
            drive = Drive.from_angles([joint_angle, joint_angle], plane_twists=[twist])
            ends.append(forces(drive, Duty(torque=100.0), ANGLE))
        v, z = ends
        assert z.bending_couple[1].max() < 1e-12 * 100
        wave = np.sqrt(1 + np.tan(joint_angle) ** 2 * np.sin(ANGLE) ** 2)
        np.testing.assert_allclose(
            v.bending_couple[1], 200 * np.sin(joint_angle) * np.abs(np.cos(ANGLE)) * wave, atol=1e-10
        )
        for end in ends:
            np.testing.assert_allclose(
                end.bending_couple[0], 100 * np.tan(joint_angle) * np.abs(np.sin(ANGLE)), atol=1e-10
            )
            np.testing.assert_allclose(end.input_torque, 100.0, rtol=1e-13)


def book_joint(joint_angle: float, *, slides: bool) -> Train:
    points = points_from_angles(np.asarray([joint_angle]), np.zeros(0), np.asarray([0.38, 0.9]))
    ends: tuple = ((1, ("radial",)), (1, ("radial",))) if slides else ((1, ("radial",)),)
    return train_of_points(
        points,
        bearings=((0, ("radial", "axial")), (0, ("radial",)), *ends),
        position=np.asarray([0.0, 0.3, *([0.4, 0.65] if slides else [0.4])]),
        slides=((slides, slides),),
        span=np.asarray([0.1]),
    )


@pytest.mark.parametrize("slides", [True, False])
def test_single_joints_agree_with_the_closed_forms(slides: bool) -> None:
    """Book Figs 67a and 67b: the far bearing at 0.38 m before the joint, the near one at 0.08 m."""
    joint_angle = 30 * deg
    found = kinetostatics(book_joint(joint_angle, slides=slides), ANGLE, torque=1000.0)
    closed = single_joint_forces(
        joint_angle,
        ANGLE,
        1000.0,
        span=0.1,
        bearing_span=0.3,
        overhang=0.08,
        reach=0.25 if slides else 0.4,
        located=not slides,
    )
    near = {"rtol": 1e-11, "atol": 1e-9}
    np.testing.assert_allclose(found.input_torque, closed.driving_torque, **near)
    np.testing.assert_allclose(found.radial[0], closed.far, **near)
    np.testing.assert_allclose(found.radial[1], closed.near, **near)
    np.testing.assert_allclose(np.abs(found.axial[0]), closed.axial, **near)
    np.testing.assert_allclose(found.radial[2], closed.driven_bearing, **near)
    np.testing.assert_allclose(found.bending_couple, [closed.driving_couple, closed.driven_couple], **near)
    if slides:
        np.testing.assert_allclose(found.journals.size[0], np.stack([closed.journal] * 4, axis=-1), **near)
        np.testing.assert_allclose(found.joint_force, 0.0, atol=1e-9)
        assert (found.equations, found.unknowns) == (10, 10)


def test_a_cross_that_slides_one_way_passes_no_force_on_along_it() -> None:
    joints = (Hooke(joint_angle=20 * deg, cross=Cross(span=0.1, slides="driving")),)
    held = (HELD[0], HELD[1], Support(shaft=2, position=0.4), Support(shaft=2, position=0.7, radial=False, axial=True))
    drive = Drive(joints=joints, supports=held, duty=Duty(torque=100.0))
    found = forces(drive, angle=ANGLE[1:9] + 0.1)
    assert np.abs(np.sum(found.joint_force * found.driving_arm, axis=-1)).max() < 1e-9
    assert np.abs(found.joint_force).max() > 1.0
    assert found.force_left.max() < 1e-12
    assert found.moment_left.max() < 1e-12


HELD_BOTH = (
    Support(shaft=1, position=-0.25, axial=True),
    Support(shaft=1, position=-0.05),
    Support(shaft=3, position=0.05),
    Support(shaft=3, position=0.25, axial=True),
)


def splined(*, axial: bool, spline: Spline | None = None, **parts: object) -> Drive:
    last = Support(shaft=3, position=0.3, axial=axial)
    drive = Drive.from_points(PARALLEL, yoke_angles=[0.4], start_phase=0.3)
    shafts = (drive.shafts[0], replace(drive.shafts[1], spline=spline), drive.shafts[2])
    return replace(drive, supports=(*HELD[:3], last), shafts=shafts, duty=Duty(torque=100.0), **parts)  # type: ignore[arg-type]


def test_a_free_spline_leaves_the_pair_of_forces_of_the_double_joint() -> None:
    """Book Fig 70, and what Fig 69 adds: a force along the middle shaft that ends in the thrust bearing of shaft 1."""
    joint_angle = np.arctan2(0.2, 0.7)
    length = np.hypot(0.7, 0.2)
    free = forces(splined(axial=True, spline=Spline()), angle=ANGLE)
    fixed = forces(splined(axial=False), angle=ANGLE)
    closed = double_joint_forces(
        joint_angle, joint_angle, ANGLE + 0.3, plane_twist=np.pi, yoke_angle=0.4, torque=100.0, length=length
    )
    assert (free.equations, free.unknowns) == (16, 16)
    size = np.linalg.norm(free.joint_force, axis=-1)
    np.testing.assert_allclose(size[0], closed.pair_force, atol=1e-9)
    np.testing.assert_allclose(size[1], closed.pair_force, atol=1e-9)
    np.testing.assert_allclose(np.abs(free.axial[0]), closed.first_axial, atol=1e-9)
    np.testing.assert_allclose(np.abs(free.axial[3]), closed.last_axial, atol=1e-9)
    assert free.status == fixed.status == Determinacy.DETERMINATE
    e2, e3 = free.axis[1, 0], free.axis[2, 0]
    pair = fixed.joint_force[1] - (fixed.joint_force[1] @ e2)[:, None] * e2
    np.testing.assert_allclose(fixed.joint_force[1] @ e2, -(pair @ e3) / (e2 @ e3), atol=1e-9)
    assert np.abs(fixed.axial[2:]).max() < 1e-9


def test_spline_friction_pushes_the_shafts_apart() -> None:
    spline = Spline(position=0.3, mean_diameter=0.05, friction=0.12)
    found = forces(splined(axial=True, spline=spline), angle=ANGLE)
    back = found.reverse
    assert back is not None
    thrust = spline_grip(0.12, 0.05) * np.abs(found.shaft_torque[1])
    np.testing.assert_allclose(found.spline_thrust[0], -thrust)
    np.testing.assert_allclose(back.spline_thrust[0], thrust)
    for one_way, sign in ((found, -1.0), (back, 1.0)):
        along = np.sum(one_way.joint_force * one_way.axis[1:2], axis=-1)
        np.testing.assert_allclose(along, np.stack([sign * thrust] * 2), atol=1e-9)
        assert one_way.force_left.max() < 1e-12
        assert one_way.moment_left.max() < 1e-12
    only = forces(splined(axial=True, spline=replace(spline, sliding="in")), angle=ANGLE)
    assert only.reverse is None
    np.testing.assert_allclose(only.spline_thrust[0], thrust)


@pytest.mark.parametrize("off", [-0.0017, 0.0, 0.0017])
def test_a_splined_tube_hangs_with_each_half_on_its_own_side(off: float) -> None:
    """A steep tube of 14 kg with its spline in the middle: half its weight along it on each thrust bearing, whichever
    side of its middle the spline is; with the flange at one end, on that side."""
    steep = [(0.0, 0.0, -0.3), (0.0, 0.0, 0.0), (0.05, 0.0, 1.2), (0.05, 0.0, 1.5)]
    tube = Shaft(number=2, outer=0.076, wall=0.00318, spline=Spline(position=0.6 + off))
    loads = []
    for shaft in (tube, replace(tube, masses=(PointMass(position=1.15, mass=2.0),))):
        drive = Drive.from_points(steep)
        one = replace(drive, shafts=(shaft,), supports=HELD_BOTH, duty=Duty(torque=0.0))
        found = forces(one, angle=[0.3])
        loads.append([float(np.sum(found.axial[k : k + 2, 0])) for k in (0, 2)])
        assert found.force_left.max() < 1e-12
        assert found.moment_left.max() < 1e-12
    length = np.hypot(0.05, 1.2)
    whole = 7850 * np.pi / 4 * (0.076**2 - 0.06964**2) * length * 9.80665
    (first, last), flanged = loads
    assert first + last == pytest.approx(whole, rel=1e-9)
    assert first == pytest.approx(whole * (0.6 + off) / length, rel=4e-3)  # the tube leans by 2.4°
    assert flanged[0] == pytest.approx(first, rel=1e-2)
    assert flanged[1] - last == pytest.approx(2.0 * 9.80665, rel=1e-2)


def test_a_spline_rubs_by_the_torque_that_comes_to_it() -> None:
    """Behind the part before it: a uniform shaft that gains speed leaves the share before the spline there."""
    spline = Spline(position=0.2, mean_diameter=0.05, friction=0.12)
    base = splined(axial=True, spline=spline)
    length = np.hypot(0.7, 0.2)
    shafts = (base.shafts[0], replace(base.shafts[1], inertia=0.4, mass=6.0), base.shafts[2])
    found = forces(replace(base, shafts=shafts, duty=Duty(torque=100.0, speed=150.0, acceleration=80.0)), angle=ANGLE)
    at_spline = found.shaft_torque[1] - 0.4 * (0.2 / length) * found.acceleration[1]
    np.testing.assert_allclose(-found.spline_thrust[0], spline_grip(0.12, 0.05) * np.abs(at_spline), rtol=1e-12)


def test_outer_and_root_diameter_tell_where_friction_acts() -> None:
    mean = Spline(position=0.3, mean_diameter=0.05, friction=0.12)
    ends = replace(mean, mean_diameter=None, outer=0.053, root=0.047)
    one, other = (forces(splined(axial=True, spline=spline), angle=ANGLE) for spline in (mean, ends))
    np.testing.assert_allclose(other.spline_thrust, one.spline_thrust, rtol=1e-12)


def test_steeper_teeth_push_more() -> None:
    assert spline_grip(0.1, 0.04, 60 * deg) == pytest.approx(2 * spline_grip(0.1, 0.04))


def test_friction_costs_what_it_takes_over_a_turn() -> None:
    joints = (Hooke(joint_angle=20 * deg, friction=0.05, cross=Cross(span=0.08, journal=0.02)),) * 2
    found = forces(Drive(joints=joints, duty=Duty(torque=100.0, speed=100.0)), angle=np.arange(7200) * np.pi / 3600)
    work = np.mean(found.input_torque)
    wanted = chain_friction(Drive(joints=joints), [0.0125, 0.0125]).efficiency
    # kinks of the friction stay between samples of 0.05°: the mean is right to the square of that
    assert 100.0 / work == pytest.approx(wanted, abs=1e-6)
    lost = np.mean(np.sum(found.loss, axis=0))
    assert lost == pytest.approx((work - 100.0) * 100.0, rel=1e-3)


@pytest.mark.parametrize("at", ["output", "input"])
def test_journals_that_reverse_just_there_rub_as_right_after(at: str) -> None:
    """At the quarter turns a journal stands still for an instant; what friction adds must not hang on rounding."""
    joints = (Hooke(joint_angle=20 * deg, friction=0.05, cross=Cross(span=0.08, journal=0.02)),)
    quarters = 0.5 * np.pi * np.arange(5)
    drive = Drive(joints=joints, duty=Duty(torque=100.0, speed=100.0, torque_at=at))
    there, after = forces(drive, angle=quarters), forces(drive, angle=quarters + 1e-9)
    # 1e-9 rad further the couples, some 40 N·m, differ by 1e-7 N·m at most
    np.testing.assert_allclose(there.secondary_couple, after.secondary_couple, rtol=0, atol=1e-6)
    np.testing.assert_allclose(there.bending_couple[:, 0], there.bending_couple[:, 4], rtol=1e-12)
    straight = replace(drive, joints=(replace(joints[0], joint_angle=0.0),))
    assert forces(straight, angle=quarters).bending_couple.max() == 0.0


@pytest.mark.parametrize("n", [1, 4])
@pytest.mark.parametrize("drag", [0.0, 0.05, 1.5])
@pytest.mark.parametrize("torque", [200.0, 0.0, -3.0])
def test_torque_may_be_given_at_the_input(n: int, drag: float, torque: float) -> None:
    drive = trains(np.random.default_rng(8), n, (3,), drag=drag)
    with np.errstate(all="raise"):
        found = kinetostatics(drive, ANGLE, torque=torque, torque_at="input", speed=100.0, acceleration=30.0)
    size = np.abs(found.shaft_torque).max()
    # there and back again through four joints, each within some roundings
    np.testing.assert_allclose(found.input_torque, torque, rtol=0, atol=1e-13 * size)
    again = kinetostatics(drive, ANGLE, torque=found.output_torque, speed=100.0, acceleration=30.0)
    np.testing.assert_allclose(again.input_torque, torque, rtol=0, atol=1e-13 * size)
    assert np.ptp(found.output_torque) > 1.0


@pytest.mark.parametrize("joint_angles", [(0.0, 0.5), (0.0, 0.0, 0.4, 0.3), (0.3, 0.0, 0.4)])
def test_straight_joints_keep_the_planes_they_are_given(joint_angles: tuple[float, ...]) -> None:
    """Forces turn as motion says, and as where the joint is all but straight; points alone do not tell its plane."""
    twists = [0.7, -1.1, 0.4][: len(joint_angles) - 1]
    drive, near = (
        replace(
            Drive.from_angles(
                [joint_angle or least for joint_angle in joint_angles], plane_twists=twists, start_phase=0.2
            ),
            shafts=tuple(Shaft(number=k + 1, length=0.5, inertia=0.02) for k in range(len(joint_angles) + 1)),
        )
        for least in (0.0, 1e-7)
    )
    duty = Duty(speed=50.0, torque=30.0)
    found, almost = forces(drive, duty, ANGLE), forces(near, duty, ANGLE)
    np.testing.assert_allclose(found.speed, 50.0 * motion(drive, ANGLE).shaft_ratio, rtol=1e-13)
    for name in ("shaft_torque", "secondary_couple"):
        # a joint angle of 1e-7 shows to the first order in couples of 30 N·m
        np.testing.assert_allclose(getattr(found, name), getattr(almost, name), rtol=0, atol=1e-4)


def test_torque_may_swing_with_its_shaft() -> None:
    drive = Drive.from_angles([20 * deg])
    wave = (Harmonic(order=2, torque=30.0, phase=0.5),)
    out = forces(drive, Duty(torque=100.0, harmonics=wave), ANGLE)
    turned = motion(drive, ANGLE).output_angle
    np.testing.assert_allclose(out.output_torque, 100 + 30 * np.cos(2 * turned + 0.5))
    into = forces(drive, Duty(torque=100.0, harmonics=wave, torque_at="input"), ANGLE)
    np.testing.assert_allclose(into.input_torque, 100 + 30 * np.cos(2 * ANGLE + 0.5))


def test_weight_hangs_on_the_supports() -> None:
    """Standing still without torque, the sum of all reactions is the weight."""
    tube = Shaft(number=1, mass=10.0, centre_of_mass=-0.2)
    drive = replace(
        Drive.from_points(PARALLEL),
        shafts=(tube,),
        supports=HELD,
        duty=Duty(torque=0.0),
        joints=tuple(replace(j, cross=Cross(mass=1.0)) for j in Drive.from_points(PARALLEL).joints),
    )
    found = forces(drive, angle=[0.0])
    np.testing.assert_allclose(found.reaction[..., 2].sum(), 12.0 * 9.80665)
    assert "shafts[1].inertia" in found.assumed
    light = forces(replace(drive, settings=Settings(gravity=(0.0, 0.0, 0.0))), angle=[0.0])
    np.testing.assert_allclose(light.reaction, 0.0, atol=1e-12)


def test_a_fixed_end_holds_the_slope() -> None:
    drive = Drive.from_points([(-0.4, 0, 0), (0, 0, 0), (0.7, 0.2, 0)])
    ends = (Support(shaft=1, position=-0.2, axial=True, tilt=True), Support(shaft=2, position=0.5))
    found = forces(replace(drive, supports=ends, duty=Duty(torque=100.0)), angle=ANGLE)
    pairs = (Support(shaft=1, position=-0.3, axial=True), Support(shaft=1, position=-0.1), ends[1])
    other = forces(replace(drive, supports=pairs, duty=Duty(torque=100.0)), angle=ANGLE)
    np.testing.assert_allclose(found.reaction[0], other.reaction[0] + other.reaction[1], atol=1e-9)
    turn = np.cross([-0.1, 0, 0], other.reaction[0]) + np.cross([0.1, 0, 0], other.reaction[1])
    np.testing.assert_allclose(found.support_couple[0], turn, atol=1e-9)
    assert found.moment_left.max() < 1e-12


def test_journals_carry_couple_force_and_weight() -> None:
    single = one(trains(np.random.default_rng(5), 2, (1,)), 0)
    found = kinetostatics(single, ANGLE, torque=100.0, speed=150.0)
    u, v, load = found.driving_arm, found.driven_arm, found.journals.load
    arm = 0.04 * np.stack((u, -u, v, -v), axis=-2)
    turns = np.cross(arm, load)
    near = {"atol": 1e-9 * np.abs(load).max()}
    # pins turn about themselves, so the couple about them is not theirs
    driving = found.driving_couple - np.sum(found.driving_couple * u, axis=-1)[..., None] * u
    driven = found.driven_couple - np.sum(found.driven_couple * v, axis=-1)[..., None] * v
    np.testing.assert_allclose(turns[..., :2, :].sum(axis=-2), driving, **near)
    np.testing.assert_allclose(turns[..., 2:, :].sum(axis=-2), driven, **near)
    out = load[..., 2:, :].sum(axis=-2) + found.journals.thrust[..., 1, None] * v
    into = load[..., :2, :].sum(axis=-2) + found.journals.thrust[..., 0, None] * u
    np.testing.assert_allclose(out, found.joint_force, **near)
    weight = single.cross_mass[:, None, None] * single.gravity
    np.testing.assert_allclose(into + weight, out, **near)


def test_without_supports_there_are_couples_and_journal_loads() -> None:
    joints = (Hooke(joint_angle=20 * deg, cross=Cross(span=0.1)),)
    found = forces(Drive(joints=joints), Duty(torque=100.0), [0.0])
    assert found.reaction is None
    assert found.force_left is None
    np.testing.assert_allclose(found.journals.size[0, 0], 100.0 / 0.1 / np.cos(20 * deg))
    with pytest.raises(InputError, match="reactions need"):
        _ = found.radial


def fields(drive: Drive, **question: object) -> list[str]:
    with pytest.raises(InputError) as caught:
        forces(drive, **question)  # type: ignore[arg-type]
    return [problem.field for problem in caught.value.problems]


def test_what_is_missing_is_named() -> None:
    drive = Drive.from_points(PARALLEL)
    assert fields(drive) == ["duty.torque"]
    loaded = replace(drive, duty=Duty(torque=1.0))
    assert fields(replace(loaded, supports=(HELD[0], HELD[3]))) == ["supports"]
    heavy = replace(loaded, supports=HELD, shafts=(Shaft(number=3, mass=3.0),))
    assert fields(heavy) == ["shafts[2].centre_of_mass"]
    joint_angles = Drive.from_angles([0.1, 0.2])
    assert fields(replace(joint_angles, supports=HELD, duty=Duty(torque=1.0))) == ["shafts[1].length"]
    assert fields(loaded, angle=[[0.0]]) == ["angle"]


def test_loose_shafts_are_named_with_their_direction() -> None:
    loaded = replace(Drive.from_points(PARALLEL), duty=Duty(torque=1.0))
    with pytest.raises(InputError, match=r"nothing keeps shaft 1 .*along its axis"):
        forces(replace(loaded, supports=(replace(HELD[0], axial=False), *HELD[1:])))
    with pytest.raises(InputError, match="stiffness"):
        forces(replace(loaded, supports=(*HELD[:3], replace(HELD[3], axial=True))))


def test_a_loose_drive_in_a_batch_has_a_status() -> None:
    many = trains(np.random.default_rng(9), 2, (3,), heavy=False)
    place = many.position.copy()
    place[1, 1] = place[1, 0]
    found = kinetostatics(replace(many, position=place), ANGLE, torque=100.0)
    assert found.status.tolist() == [Determinacy.DETERMINATE, Determinacy.LOOSE, Determinacy.DETERMINATE]
    assert np.isnan(found.reaction[1]).all()
    assert np.isfinite(found.reaction[[0, 2]]).all()
    assert np.isfinite(found.shaft_torque).all()


def test_a_joint_that_friction_locks_is_refused() -> None:
    # Beyond κ tan α = 1 no torque drives the joint: its equations still have a solution, which no drive obeys.
    def held(joint_angle: float) -> Drive:
        joint = Hooke(joint_angle=joint_angle, friction=4.0, cross=Cross(span=0.1, journal=0.025))
        return Drive(joints=(Hooke(joint_angle=0.1), joint), duty=Duty(torque=10.0))

    assert np.max(forces(held(44.0 * deg)).power_left) < 1e-12
    with pytest.raises(InputError, match="locks joint 2") as caught:
        forces(held(46.0 * deg))
    assert [one.field for one in caught.value.problems] == ["joints[1].friction"]


def test_friction_has_no_sense_at_standstill() -> None:
    joint = Hooke(joint_angle=20 * deg, friction=0.05, cross=Cross(span=0.08, journal=0.02))
    with pytest.raises(InputError, match=r"duty\.speed"):
        forces(Drive(joints=(joint,)), Duty(torque=100.0, speed=0.0))
    assert forces(Drive(joints=(replace(joint, friction=None),)), Duty(torque=100.0, speed=0.0)).power_left.max() == 0.0


@pytest.mark.parametrize("joint_angles", [(85, 0, 60), (0, 0, 70, 20), (89, 45), (30, 0, 0, 80, 10, 40)])
@pytest.mark.parametrize("at", ["output", "input"])
def test_steep_and_straight_joints_balance_too(joint_angles: tuple[float, ...], at: str) -> None:
    """With inertia, weight, friction near locking and a shaft clamped at its end; running the other way."""
    n = len(joint_angles)
    random = np.random.default_rng(n)
    cross = Cross(span=0.08, journal=0.02, mass=0.5, inertia=(0.001, 0.001, 0.002))
    drag = [min(1.0, 2.0 / np.tan(max(joint_angle, 1.0) * deg)) for joint_angle in joint_angles]
    drive = replace(
        Drive.from_angles(
            [joint_angle * deg for joint_angle in joint_angles], plane_twists=list(random.uniform(-3, 3, n - 1))
        ),
        joints=tuple(
            Hooke(joint_angle=joint_angle * deg, plane_twist=twist, friction=mu, cross=cross)
            for joint_angle, twist, mu in zip(joint_angles, random.uniform(-3, 3, n), drag, strict=True)
        ),
        shafts=tuple(
            Shaft(number=k + 1, length=0.5, inertia=0.02, mass=4.0, centre_of_mass=0.1 * k, resisting_torque=k - 2.0)
            for k in range(n + 1)
        ),
        supports=(
            Support(shaft=1, position=-0.3, axial=True, tilt=True),
            *(Support(shaft=k, position=0.2) for k in range(2, n)),
            Support(shaft=n + 1, position=0.3, tilt=True),
        ),
    )
    found = forces(drive, Duty(torque=-80.0, torque_at=at, speed=-40.0, acceleration=20.0), ANGLE)
    force, moment = shaft_rests(train(drive), found, found.output_torque)
    size = max(np.abs(found.reaction).max(), np.abs(found.driving_couple).max())
    # 1/cos 89° takes two more digits than the chains of 25° above
    assert max(found.power_left.max(), force / size, moment / size) < 1e-10


@pytest.mark.slow
def test_ten_thousand_drives_are_one_call(monkeypatch: pytest.MonkeyPatch) -> None:
    """As many steps of Python as for three drives, and each drive's extremes those of the drive by itself."""
    calls, plain = [0], frames.cross

    def counted(one: np.ndarray, other: np.ndarray) -> np.ndarray:
        calls[0] += 1
        return plain(one, other)

    monkeypatch.setattr(frames, "cross", counted)
    places = np.linspace(0.0, 2 * np.pi, 73)[:-1]
    steps = []
    for count in (3, 10_000):
        calls[0] = 0
        many = trains(np.random.default_rng(6), 1, (count,), heavy=False)
        found = kinetostatics(many, places, torque=100.0)
        steps.append(calls[0])
    assert steps[0] == steps[1] > 0
    assert found.reaction.shape == (10_000, 3, 72, 3)
    assert found.power_left.max() < 1e-12
    for k in (0, 4321, 9999):
        single = kinetostatics(one(many, k), places, torque=100.0)
        for name in ("bending_couple", "radial"):
            np.testing.assert_allclose(getattr(found, name)[k].max(-1), getattr(single, name).max(-1), rtol=1e-10)


@pytest.mark.parametrize("at", ["output", "input"])
def test_a_locked_drive_has_no_torques_and_leaves_its_batch_alone(at: str) -> None:
    many = trains(np.random.default_rng(5), 2, (3,), drag=0.02)
    joint_angle = many.chain.joint_angle[1, 0]
    drag = many.drag.copy()
    drag[1, 0] = 1.0 / np.tan(joint_angle)
    found = kinetostatics(replace(many, drag=drag), ANGLE, torque=100.0, torque_at=at, speed=50.0)
    freely = kinetostatics(many, ANGLE, torque=100.0, torque_at=at, speed=50.0)
    assert np.isnan(found.output_torque[1] if at == "input" else found.input_torque[1]).all()
    for k in (0, 2):
        np.testing.assert_array_equal(found.input_torque[k], freely.input_torque[k])
        np.testing.assert_allclose(found.reaction[k], freely.reaction[k], rtol=1e-12)


def test_a_torque_that_repeats_in_two_turns_is_followed_over_both():
    """Order 0.5 by power, τ_1 ω_1 = M(φ_2) ω_2: the top stands in the second turn, and the mean is that of both."""
    drive, size, part = Drive.from_angles([20 * deg]), 100.0, 0.4
    wave = Harmonic(order=0.5, torque=part * size, phase=-1.7 * np.pi)
    found = forces(drive, Duty(torque=size, harmonics=(wave,)))
    assert found.angle[-1] == pytest.approx(4.0 * np.pi)
    turned = motion(drive, np.linspace(0.0, 4.0 * np.pi, 721))
    by_power = size * (1.0 + part * np.cos(0.5 * turned.output_angle + wave.phase)) * turned.ratio
    np.testing.assert_allclose(found.input_torque, by_power, rtol=1e-12)
    first, second = np.max(by_power[:361]), np.max(by_power[360:])
    assert second > 1.05 * first
    assert np.max(found.input_torque) == pytest.approx(second, rel=1e-12)
    # over both turns the work of the swing is that of order 0.5 on orders 2, 4, … of the joint: none
    assert float(np.mean(found.input_torque[:-1])) == pytest.approx(size, rel=1e-9)


def test_swings_that_no_two_turns_hold_are_followed_as_far_as_life_follows_them():
    duty = Duty(torque=10.0, harmonics=(Harmonic(order=1.0 / 3.0, torque=1.0), Harmonic(order=0.5, torque=1.0)))
    assert forces(Drive.from_angles([0.2]), duty).angle[-1] == pytest.approx(12.0 * np.pi)
