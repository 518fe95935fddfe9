"""Stations of a torsional line: where they stand, and what is no line."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from cardan import Drive, InputError
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.machine import (
    AsynchronousMachine,
    ConstantTorque,
    Engine,
    EngineHarmonic,
    HarmonicTorque,
    RunUp,
    SpeedTorque,
)
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.station import Absorber, Pendulum, Station, ToNext
from cardan.drive.torsional_layout import shaft_places
from cardan.units import deg

DRIVE = Drive.from_angles([10 * deg, 12 * deg])
SPRING = ToNext(stiffness=1e4)
DISC = Station(shaft=1, end="start", name="disc", inertia=1.0)


def fields(**changes: Any) -> list[str]:
    """Return the fields that a drive with such changes is refused for."""
    with pytest.raises(InputError) as caught:
        replace(DRIVE, **changes)
    return [problem.field for problem in caught.value.problems]


def places(
    *stations: Station, number: int = 1, length: float | None = None
) -> list[tuple[float | None, tuple[int, ...]]]:
    found = shaft_places(replace(DRIVE, stations=stations), number, length)
    return [(one.position, one.stations) for one in found]


def test_a_rigid_shaft_is_one_place() -> None:
    assert places(DISC, replace(DISC, name="", end="end")) == [(0.0, (0, 1))]


def test_stations_without_a_place_follow_in_the_order_of_the_file() -> None:
    loose = Station(shaft=1, inertia=0.1, to_next=SPRING)
    ends = Station(shaft=1, end="end"), replace(DISC, to_next=SPRING)
    assert places(ends[0], loose, loose, ends[1]) == [(None, (3,)), (None, (1,)), (None, (2,)), (0.0, (0,))]


def test_stations_with_a_place_follow_along_the_shaft() -> None:
    there = [Station(shaft=1, position=at, to_next=SPRING) for at in (-0.2, -0.7)] + [Station(shaft=1, position=0.0)]
    assert places(*there, length=0.7) == [(-0.7, (1,)), (-0.2, (0,)), (0.0, (2,))]
    there = [Station(shaft=2, position=at, inertia=1.0) for at in (0.5, 0.5, 1.0)]
    assert places(*there, number=2, length=1.0) == [(0.0, (0, 1, 2))]  # nothing twists
    there[0] = replace(there[0], to_next=SPRING)
    assert places(*there, number=2, length=1.0) == [(0.0, ()), (0.5, (0, 1)), (1.0, (2,))]


@pytest.mark.parametrize(
    ("stations", "wanted"),
    [
        ([replace(DISC, shaft=9)], "stations[0].shaft"),
        ([replace(DISC, position=-0.1)], "stations[0].position"),
        ([Station(shaft=1, position=0.1)], "stations[0].position"),
        ([Station(shaft=2, position=-0.1)], "stations[0].position"),
        ([Station(shaft=1, position=-0.1, to_next=SPRING), Station(shaft=1, to_next=SPRING)], "stations[1].position"),
        ([DISC, DISC], "stations[1].name"),
        ([replace(DISC, name="output")], "stations[0].name"),
        ([replace(DISC, end="far")], "stations[0].end"),
        ([replace(DISC, inertia=-1.0)], "stations[0].inertia"),
        ([replace(DISC, ground_damping=-1.0)], "stations[0].ground_damping"),
        ([replace(DISC, to_next=ToNext(stiffness=0.0))], "stations[0].to_next.stiffness"),
        ([replace(DISC, to_next=SPRING), Station(shaft=1, end="end", to_next=SPRING)], "stations[1].to_next"),
        ([replace(DISC, to_next=SPRING), Station(shaft=1, end="start", to_next=SPRING)], "stations[1].to_next"),
        (
            [
                replace(
                    DISC, absorber=Absorber(inertia=1.0, stiffness=1.0), pendulum=Pendulum(mass=1, radius=1, length=1)
                )
            ],
            "stations[0].pendulum",
        ),
        ([replace(DISC, absorber=Absorber(inertia=1.0))], "stations[0].absorber.stiffness"),
        ([replace(DISC, absorber=Absorber(inertia=1.0, stiffness=-1.0))], "stations[0].absorber.stiffness"),
    ],
)
def test_a_station_that_cannot_be_is_named(stations: list[Station], wanted: str) -> None:
    assert wanted in fields(stations=tuple(stations))


def test_a_station_beyond_the_body_of_an_end_shaft_is_named() -> None:
    body = Shaft(number=3, outer=0.05, length=0.4)
    assert fields(shafts=(body,), stations=(Station(shaft=3, position=0.5),)) == ["stations[0].position"]


@pytest.mark.parametrize(
    ("shaft", "wanted"),
    [
        (Shaft(number=2, damping=1.0), "shafts[1].damping"),
        (Shaft(number=2, loss_factor=0.01), "shafts[1].loss_factor"),
        (Shaft(number=2, spline=Spline(backlash=0.01)), "shafts[1].spline.backlash"),
        (Shaft(number=2, stiffness=1e4, spline=Spline(stiffness=1e5)), "shafts[1].spline.stiffness"),
    ],
)
def test_what_counts_only_on_a_shaft_that_twists_is_refused_on_a_rigid_one(shaft: Shaft, wanted: str) -> None:
    assert fields(shafts=(shaft,)) == [wanted]


def test_play_of_a_joint_needs_a_shaft_that_twists_beside_it() -> None:
    joints = (Hooke(joint_angle=0.1, backlash=0.01), Hooke(joint_angle=0.1))
    assert fields(joints=joints) == ["joints[0].backlash"]
    assert replace(DRIVE, joints=joints, shafts=(Shaft(number=2, stiffness=1.0),)).joints[0].backlash == 0.01


@pytest.mark.parametrize(
    ("duty", "wanted"),
    [
        (Duty(load=ConstantTorque(torque=1.0, station="disk")), "duty.load.station"),
        (Duty(torques=(ConstantTorque(torque=1.0),)), "duty.torques[0].station"),
        (Duty(load=SpeedTorque(speeds=(2.0, 1.0), torques=(1.0, 1.0))), "duty.load.speeds"),
        (Duty(load=SpeedTorque(speeds=(1.0, 2.0), torques=(1.0,))), "duty.load.torques"),
        (Duty(load=SpeedTorque(speeds=(), torques=())), "duty.load.speeds"),
        (
            Duty(motor=AsynchronousMachine(synchronous_speed=0.0, pullout_torque=1.0, pullout_slip=0.1)),
            "duty.motor.synchronous_speed",
        ),
        (Duty(motor=HarmonicTorque(amplitude=-1.0, order=2.0)), "duty.motor.amplitude"),
        (Duty(input="uniform", motor=ConstantTorque(torque=1.0)), "duty.motor"),
        (Duty(input="uniform", torques=(ConstantTorque(torque=1.0, station="input"),)), "duty.torques[0]"),
        (Duty(run_up=RunUp(start=10.0, end=10.0, duration=1.0)), "duty.run_up.end"),
        (Duty(run_up=RunUp(end=10.0, duration=0.0)), "duty.run_up.duration"),
        (Duty(speed_range=(10.0, 10.0)), "duty.speed_range"),
        (Duty(harmonics=(Harmonic(order=2.0, torque=1.0),)), "duty.harmonics"),
        (Duty(engine=Engine()), "duty.engine.harmonics"),
        (Duty(engine=Engine(bore=0.1, stroke=0.1, mean_pressure=1e6)), "duty.engine.cylinders"),
        (Duty(engine=Engine(bore=0.1, mean_pressure=1e6, cylinders=4)), "duty.engine.stroke"),
        (Duty(engine=Engine(stroke=0.1, cylinders=4)), "duty.engine.mean_pressure"),
        (Duty(engine=Engine(mean_pressure=1e6, stroke=0.1, cylinders=4)), "duty.engine.bore"),
        (
            Duty(engine=Engine(bore=0.1, stroke=0.1, mean_pressure=1e6, cylinders=4, mean_torque=1.0)),
            "duty.engine.mean_torque",
        ),
        (Duty(engine=Engine(strokes=3, cylinders=4)), "duty.engine.strokes"),
        (
            Duty(engine=Engine(strokes=2, harmonics=(EngineHarmonic(order=1.5, torque=1.0),))),
            "duty.engine.harmonics[0].order",
        ),
        (
            Duty(engine=Engine(harmonics=(EngineHarmonic(order=1.7, torque=1.0),))),
            "duty.engine.harmonics[0].order",
        ),
        (Duty(engine=Engine(cylinders=4, rod_ratio=0.25)), "duty.engine.rod_ratio"),
    ],
)
def test_a_torque_that_cannot_be_is_named(duty: Duty, wanted: str) -> None:
    assert wanted in fields(duty=duty, stations=(DISC,))


def test_the_nearest_station_is_named() -> None:
    with pytest.raises(InputError, match="the nearest is disc"):
        replace(DRIVE, stations=(DISC,), duty=Duty(load=ConstantTorque(torque=1.0, station="disk")))
