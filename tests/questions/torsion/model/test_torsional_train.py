"""The torsional model of a drive against closed forms of tubes, and against its motion."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from cardan import Drive, InputError, motion
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.machine import ConstantTorque, Engine, EngineHarmonic, HarmonicTorque, LinearTorque
from cardan.drive.material import Material
from cardan.drive.shaft import PointMass, Segment, Shaft, Spline
from cardan.drive.station import Absorber, Pendulum, Station, ToNext
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.model.torsional_modes import straight_modes
from cardan.questions.torsion.model.torsional_train import in_time, stacked, torsional_model, torsional_train
from cardan.units import deg
from tests.builders.drives import Plan, plans

G, DENSITY = 2.06e11 / 2.6, 7850.0
BASE = Drive.from_angles([10 * deg, 12 * deg], yoke_angles=[20 * deg])
DISCS = (Station(shaft=1, inertia=1.0, name="engine"), Station(shaft=3, inertia=2.0, name="mill"))
DUTY = Duty(speed=100.0)
LOOSE = Station(shaft=2, inertia=1.0)


def polar(outer: float, inner: float = 0.0) -> float:
    return math.pi * (outer**4 - inner**4) / 32.0


def drive(*shafts: Shaft, **changes: Any) -> Drive:
    return replace(BASE, **({"shafts": shafts, "stations": DISCS, "duty": DUTY} | changes))


@given(plans(most=5))
@settings(max_examples=25, deadline=None)
def test_a_rigid_drive_turns_as_its_motion_says(plan: Plan) -> None:
    whole = replace(plan.drive, stations=(Station(shaft=1, inertia=1.0),), duty=DUTY)
    model = torsional_model(whole)
    angle = np.linspace(0.0, 7.0, 40)
    assert model.coordinates == 1
    np.testing.assert_allclose(places(model, angle[:, None]).angle.T, motion(whole, angle).shaft_angle, atol=2e-13)


def test_a_tube_has_the_stiffness_and_half_the_inertia_at_either_end() -> None:
    tube = Shaft(number=2, length=1.2, outer=0.07, wall=0.002)
    found = torsional_train(drive(tube))
    size = polar(0.07, 0.066)
    assert found.model.stiffness == pytest.approx([G * size / 1.2])
    half = 0.5 * DENSITY * size * 1.2
    assert found.model.inertia == pytest.approx([1.0, half, half, 2.0])
    assert found.model.names == ("engine", "joint 1, driven yoke", "joint 2, driving yoke", "mill")
    assert found.joints == ((0, 1), (2, 3))
    assert set(found.assumed) >= {"shafts[0].stiffness", "shafts[1].material", "shafts[1].loss_factor"}


def test_stretches_splines_and_parts_are_in_their_places() -> None:
    steps = Segment(length=0.2, outer=0.05), Segment(length=0.8, outer=0.07, inner=0.066, material=Material(shear=4e10))
    stepped = Shaft(
        number=2,
        length=1.0,
        segments=steps,
        masses=(
            PointMass(position=0.0, mass=1.0, polar_inertia=0.004),
            PointMass(position=0.6, mass=1.0, polar_inertia=0.01),
        ),
        spline=Spline(position=0.1, stiffness=2e5, backlash=0.003),
    )
    model = torsional_model(drive(stepped))
    soft = 0.2 / (G * polar(0.05)) + 0.8 / (4e10 * polar(0.07, 0.066)) + 1.0 / 2e5
    assert 1.0 / np.sum(1.0 / model.stiffness) == pytest.approx(1.0 / soft)
    assert len(model.stiffness) == 2
    assert model.stiffness[1] == pytest.approx(4e10 * polar(0.07, 0.066) / 0.4)
    assert model.backlash.tolist() == [0.003, 0.0]
    own = DENSITY * (0.2 * polar(0.05) + 0.8 * polar(0.07, 0.066))
    assert np.sum(model.inertia) == pytest.approx(3.014 + own)
    behind, before = DENSITY * polar(0.07, 0.066) * 0.4, DENSITY * (0.2 * polar(0.05) + 0.4 * polar(0.07, 0.066))
    assert model.inertia[2] == pytest.approx(0.01 + 0.5 * (behind + before))


def test_a_finer_line_goes_to_the_waves_of_a_bar() -> None:
    """A bar driven at one end and free at the other first swings at (π/2) √(G/ρ)/L."""
    bar = Shaft(number=2, length=2.0, outer=0.03)
    line = Drive.from_angles([0.0], yoke_angles=[])
    line = replace(line, shafts=(replace(bar),), duty=DUTY)
    exact = 0.5 * math.pi * math.sqrt(G / DENSITY) / 2.0
    errors = []
    for pieces in (4, 8):
        model = torsional_model(line, pieces=pieces)
        stiffness = np.zeros((pieces + 1, pieces + 1))
        for (a, b), c in zip(model.elements, model.stiffness, strict=True):
            stiffness[np.ix_((a - 1, b - 1), (a - 1, b - 1))] += c * np.asarray([[1, -1], [-1, 1]])
        root = np.sqrt(model.inertia[1:][1:])
        omega = np.sqrt(np.linalg.eigvalsh(stiffness[1:, 1:] / np.outer(root, root))[0])
        errors.append(1.0 - omega / exact)
    assert errors[0] == pytest.approx(4.0 * errors[1], rel=0.02)  # of second order
    assert 0.0 < errors[1] < 2e-3


def test_what_is_given_stands_over_the_body() -> None:
    body = Shaft(number=2, length=1.2, outer=0.07, wall=0.002)
    tube = replace(body, stiffness=5e4, inertia=0.03, damping=6.0, loss_factor=0.02)
    whole = torsional_model(drive(tube))
    assert whole.stiffness.tolist() == [5e4]
    assert whole.inertia[1:3] == pytest.approx([0.015, 0.015])
    assert (whole.damping, whole.loss_factor) == (pytest.approx([6.0]), pytest.approx([0.02]))
    middle = Station(shaft=2, position=0.4, inertia=0.5)
    parted = torsional_model(drive(tube, stations=(*DISCS, middle)))
    assert parted.stiffness == pytest.approx([1.5e5, 7.5e4])
    assert parted.damping == pytest.approx([18.0, 9.0])
    assert parted.inertia[1:4] == pytest.approx([0.005, 0.515, 0.01])


def test_elements_of_stations_make_a_line_of_an_end_shaft() -> None:
    """Crank, flywheel and yoke of an engine, known by their lumps alone."""
    crank = [
        Station(shaft=1, inertia=j, to_next=ToNext(stiffness=c, backlash=g))
        for j, c, g in ((0.1, 1e5, 0.0), (0.8, 4e4, 0.01))
    ]
    yoke = Station(shaft=1, end="end", inertia=0.02, ground_damping=0.3)
    model = torsional_model(drive(stations=(*crank, yoke, DISCS[1])))
    assert model.inertia.tolist() == [0.1, 0.8, 0.02, 0.0, 2.0]
    assert (model.stiffness.tolist(), model.backlash.tolist()) == ([1e5, 4e4], [0.0, 0.01])
    assert model.ground_damping.tolist() == [0.0, 0.0, 0.3, 0.0, 0.0]
    assert model.driven == (None, None, None, (2, 0), (3, 1))


def test_a_mass_on_an_end_shaft_with_a_stiffness_is_at_its_free_end() -> None:
    model = torsional_model(drive(Shaft(number=1, stiffness=1e4), Shaft(number=3, stiffness=2e4)))
    assert model.inertia.tolist() == [1.0, 0.0, 0.0, 0.0, 2.0]
    assert model.elements == ((0, 1), (3, 4))


def test_play_of_a_joint_is_beside_it() -> None:
    joints = (Hooke(joint_angle=0.2, backlash=0.004), Hooke(joint_angle=0.2, backlash=0.002))
    spring = Shaft(number=2, stiffness=1e4)
    model = torsional_model(drive(spring, joints=joints))
    assert model.backlash == pytest.approx([0.006])
    both = torsional_model(drive(Shaft(number=1, stiffness=1e4), spring, joints=joints))
    assert both.backlash == pytest.approx([0.004, 0.002])


def test_absorbers_and_pendulums_hang_on_their_stations() -> None:
    hung = (
        replace(DISCS[0], absorber=Absorber(inertia=0.1, stiffness=900.0, damping=2.0)),
        replace(DISCS[1], pendulum=Pendulum(mass=0.5, radius=0.12, length=0.03, count=4)),
    )
    found = torsional_train(drive(Shaft(number=2, stiffness=1e4), stations=hung))
    assert found.hangs == (None, None, None, None, 0, 3)
    assert found.model.elements[-2:] == ((0, 4), (3, 5))
    mass = 4 * 0.5 * 0.15**2
    assert found.model.inertia[-2:] == pytest.approx([0.1, mass])
    assert found.model.stiffness[-2:] == pytest.approx([900.0, mass * 100.0**2 * 4.0])
    assert found.model.damping.tolist() == [0.0, 2.0, 0.0]
    assert found.line == (0, 1, 2, 3)
    loose = replace(DISCS[0], absorber=Absorber(inertia=0.1, damping=2.0))
    held = torsional_train(drive(Shaft(number=2, stiffness=1e4), stations=(loose, DISCS[1])), speed=[50.0, 100.0])
    np.testing.assert_allclose(held.model.stiffness[:, -1], [2e-3, 4e-3])  # 1e-5 of the drag at order 2
    alone = drive(Shaft(number=2, stiffness=1e4), stations=DISCS)
    with_it = replace(alone, stations=(loose, DISCS[1]))
    slow, fast = (straight_modes(torsional_train(one, speed=50.0).model).omega for one in (with_it, alone))
    np.testing.assert_allclose(slow, fast, rtol=1e-6)  # it hangs on by nothing, and what holds it is no mode


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"stations": (), "shafts": (Shaft(number=2, stiffness=1e4),)}, "stations"),
        ({"duty": Duty(), "shafts": (Shaft(number=2, stiffness=1e4),)}, "duty.speed"),
        ({"stations": (*DISCS, LOOSE), "shafts": (Shaft(number=2, stiffness=1.0),)}, "stations[2].to_next.stiffness"),
        ({"stations": (*DISCS, replace(LOOSE, to_next=ToNext(stiffness=1.0)))}, "shafts[1].stiffness"),
        ({"stations": (LOOSE, replace(LOOSE, to_next=ToNext(stiffness=1.0)))}, "stations[0].to_next.stiffness"),
    ],
)
def test_what_is_missing_is_named(changes: dict[str, Any], field: str) -> None:
    with pytest.raises(InputError) as caught:
        torsional_model(drive(**changes))
    assert field in [problem.field for problem in caught.value.problems]


def values(model: Any, station: int, angle: float = 0.4, speed: float = 50.0) -> float:
    laws = [torque.law for torque in model.torques if torque.station == station]
    return sum(float(law.at(0.0, np.asarray(angle), np.asarray(speed))[0]) for law in laws)


SPRUNG = drive(Shaft(number=2, stiffness=1e4, resisting_torque=3.0))


def test_the_torque_of_the_duty_loads_the_output() -> None:
    duty = Duty(speed=100.0, torque=70.0, harmonics=(Harmonic(order=3.0, torque=5.0, phase=0.2),))
    model = torsional_model(SPRUNG, duty)
    assert float(model.input_speed) == 100.0
    assert values(model, 3) == pytest.approx(-70.0 - 5.0 * math.cos(3.0 * 0.4 + 0.2))
    assert values(model, 2) == -3.0
    at_input = replace(duty, torque_at="input")
    free = torsional_model(SPRUNG, at_input)
    assert free.free
    assert values(free, 0) == pytest.approx(70.0 + 5.0 * math.cos(3.0 * 0.4 + 0.2))
    assert values(free, 3) == -70.0


def test_machines_act_where_they_stand() -> None:
    duty = Duty(
        speed=100.0,
        torque=1.0,
        engine=Engine(mean_torque=40.0, speed_ratio=1.5, harmonics=(EngineHarmonic(order=2.0, torque=9.0),)),
        motor=ConstantTorque(torque=7.0, station="mill"),
        load=LinearTorque(standstill=4.0, slope=0.5),
        torques=(
            HarmonicTorque(amplitude=2.0, order=1.0, station="engine"),
            ConstantTorque(torque=6.0, station="output"),
        ),
    )
    model = torsional_model(SPRUNG, duty)
    assert model.free
    assert values(model, 0) == pytest.approx(40.0 + 9.0 * math.sin(3.0 * 0.4) + 2.0 * math.sin(0.4))
    assert values(model, 3) == pytest.approx(7.0 - (4.0 + 0.5 * 50.0) + 6.0)


def test_structural_damping_loses_the_same_in_time_at_its_frequency() -> None:
    model = torsional_model(drive(Shaft(number=2, stiffness=1e4, loss_factor=0.03, damping=0.5)))
    assert in_time(model, 200.0).damping == pytest.approx([0.5 + 0.03 * 1e4 / 200.0])


def test_variants_stack_and_those_built_otherwise_do_not() -> None:
    models = [torsional_model(drive(Shaft(number=2, stiffness=c), duty=Duty(speed=c, torque=c))) for c in (1e3, 2e3)]
    both = stacked(models)
    assert both.stiffness.tolist() == [[1e3], [2e3]]
    assert both.input_speed.tolist() == [1e3, 2e3]
    assert both.torques[0].law.value.tolist() == [-1e3, -2e3]
    with pytest.raises(InputError, match="not built alike"):
        stacked([models[0], torsional_model(drive(Shaft(number=1, stiffness=1.0)))])
