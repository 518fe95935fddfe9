"""Torsional modes against closed forms, a chain solver of its own, and exact Floquet multipliers."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.book.straight_line import line_modes
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.machine import Engine, EngineHarmonic, HarmonicTorque, LinearTorque
from cardan.drive.shaft import Shaft
from cardan.drive.station import Absorber, Pendulum, Station
from cardan.questions.torsion.model.torsion import orders, torsion_modes
from cardan.questions.torsion.model.torsional_model import torsional_line
from cardan.questions.torsion.model.torsional_modes import modulation, straight_modes
from cardan.questions.torsion.steady.run_stability import floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.units import deg

FREE = Duty(input="free")
TWO = replace(
    Drive.from_angles([20 * deg]),
    shafts=(Shaft(number=1, stiffness=900.0, damping=2.0, loss_factor=0.01),),
    stations=(Station(shaft=1, inertia=2.0), Station(shaft=2, inertia=0.6)),
)


def test_two_masses_swing_against_each_other() -> None:
    found = torsion_modes(TWO, FREE)
    omega = math.sqrt(900.0 * (1 / 2.0 + 1 / 0.6))
    assert found.omega == pytest.approx([omega], rel=1e-14)
    assert found.shape[0] == pytest.approx([-0.3, 1.0, 1.0])
    assert found.damping_ratio == pytest.approx([0.5 * omega * 2.0 / 900.0 + 0.5 * 0.01])
    assert (found.order2_speed, found.parametric_speed) == (pytest.approx([omega / 2]), pytest.approx([omega]))
    assert found.residual < 1e-14


def test_an_even_input_holds_the_first_station() -> None:
    found = torsion_modes(TWO, Duty(speed=100.0))
    assert found.omega == pytest.approx([math.sqrt(900.0 / 0.6)])
    assert found.shape[0].tolist() == [0.0, 1.0, 1.0]
    assert found.nodes == ((),)


def test_three_masses_have_the_roots_of_their_quadratic() -> None:
    j, c = (1.5, 0.05, 0.8), (8000.0, 4000.0)
    drive = replace(
        Drive.from_angles([0.2, 0.2]),
        shafts=(Shaft(number=1, stiffness=c[0]), Shaft(number=2), Shaft(number=3, stiffness=c[1])),
        stations=(Station(shaft=1, inertia=j[0]), Station(shaft=2, inertia=j[1]), Station(shaft=3, inertia=j[2])),
    )
    found = torsion_modes(drive, FREE)
    both = c[0] * (1 / j[0] + 1 / j[1]) + c[1] * (1 / j[1] + 1 / j[2])
    product = c[0] * c[1] * sum(j) / (j[0] * j[1] * j[2])
    root = math.sqrt(both**2 - 4 * product)
    assert found.omega == pytest.approx([math.sqrt((both - root) / 2), math.sqrt((both + root) / 2)], rel=1e-12)
    assert [len(nodes) for nodes in found.nodes] == [1, 2]


@pytest.mark.parametrize("seed", range(4))
def test_a_line_has_the_modes_of_its_chain(seed: int) -> None:
    """The chain solver works on a bidiagonal matrix of its own."""
    rng = np.random.default_rng(seed)
    n = 6
    inertia, stiffness = 10.0 ** rng.uniform(-3, 0, n), 10.0 ** rng.uniform(2, 6, n - 1)
    model = torsional_line(
        [inertia[:3], [0.0, *inertia[3:]]], stiffness=[stiffness[:2], stiffness[2:]], joint_angle=[0.0]
    )
    model = replace(model, inertia=np.append(inertia[:3], [0.0, *inertia[3:]]))
    found = straight_modes(model)
    chain = line_modes(inertia, stiffness)
    np.testing.assert_allclose(found.omega, chain.omega[1:], rtol=1e-9)  # singular values of graded matrices
    shape = found.shape / np.max(np.abs(found.shape), axis=-1, keepdims=True)
    np.testing.assert_allclose(np.abs(shape[:, [0, 1, 2, 4, 5, 6]]), np.abs(chain.shape[1:]), atol=1e-7)


def test_masses_without_inertia_follow_statically() -> None:
    model = torsional_line([[2.0, 0.0], [0.0, 0.6]], stiffness=[[900.0], [1800.0]], joint_angle=[0.2])
    found = straight_modes(model)
    assert found.omega == pytest.approx([math.sqrt(600.0 * (1 / 2.0 + 1 / 0.6))])
    ends = found.shape[0, [0, 3]]
    assert found.shape[0, 1] == pytest.approx(ends[0] + (ends[1] - ends[0]) * 600.0 / 900.0)
    assert found.residual < 1e-14


def test_a_joint_between_two_masses_has_the_weight_of_mathieus_reduction() -> None:
    model = torsional_line([[2.0, 0.0], [0.0, 0.6]], stiffness=[[900.0], [1800.0]], joint_angle=[0.2])
    assert straight_modes(model).joint_weight[0] == pytest.approx([600.0 / 900.0 - 0.6 / 2.6])


def test_a_joint_in_the_node_excites_nothing() -> None:
    """c/c_1 = J_2/(J_1+J_2): the joint stands where the mode stands still."""
    share = 0.6 / 2.6
    model = torsional_line(
        [[2.0, 0.0], [0.0, 0.6]], stiffness=[[600.0 / share], [600.0 / (1 - share)]], joint_angle=[0.2]
    )
    found = straight_modes(model)
    assert abs(found.joint_weight[0, 0]) < 1e-14
    assert abs(modulation(model, found.joint_weight)[0]) < 1e-14


@pytest.mark.parametrize(
    ("joint_angles", "phases"), [((12.0, 8.0), (0.3, 0.9)), ((10.0, 10.0), (0.0, 90.0)), ((6.0, 12.0), (0.0, 20.0))]
)
def test_a_mode_grows_amid_its_zone_as_the_exact_multipliers_say(
    joint_angles: tuple[float, float], phases: tuple[float, float]
) -> None:
    """Three massive shafts: κ of the general mode, phases and the factor two. Of second order in τ and the twist."""
    model = torsional_line(
        [[1.0, 0.01], [0.02, 0.01], [0.01, 0.5]],
        stiffness=[[3000.0], [9000.0], [5000.0]],
        damping=[[0.05], [0.05], [0.05]],
        joint_angle=np.radians(joint_angles),
        phase=np.radians(phases),
        input_speed=0.0,
    )
    found = straight_modes(model)
    speed = float(found.omega[0])
    exact = floquet(periodic_response(replace(model, input_speed=np.asarray(speed))))
    growth = found.omega[0] * (0.5 * abs(modulation(model, found.joint_weight)[0]) - found.damping_ratio[0])
    scale = 0.5 * found.omega[0] * np.sum(np.tan(np.radians(joint_angles) / 2) ** 2)
    assert float(exact.growth_rate) == pytest.approx(growth, abs=0.03 * scale)


def test_the_zone_has_the_edges_that_the_multipliers_find() -> None:
    shafts, stations = (Shaft(number=1, stiffness=900.0, damping=0.2),), (Station(shaft=2, inertia=0.6),)
    drive = replace(TWO, shafts=shafts, stations=stations, duty=Duty(speed=1.0))
    found = torsion_modes(drive)
    for edge, inward in zip(found.zone[0], (1.0, -1.0), strict=True):
        for side, unstable in ((1.0, True), (-1.0, False)):
            speed = edge + side * inward * 0.1 * (found.zone[0, 1] - found.zone[0, 0])
            model = replace(found.train.model, input_speed=np.asarray(speed))
            assert bool(floquet(periodic_response(model)).spectral_radius > 1.0) == unstable


def test_a_machine_that_falls_with_speed_damps() -> None:
    duty = Duty(speed=50.0, input="free", load=LinearTorque(standstill=1.0, slope=0.4))
    bare, braked = torsion_modes(TWO, FREE), torsion_modes(TWO, duty)
    share = bare.shape[0, 2] ** 2 / np.sum(bare.train.model.inertia * bare.shape[0] ** 2)
    assert braked.damping_ratio - bare.damping_ratio == pytest.approx([0.5 * 0.4 * share / bare.omega[0]])


def test_orders_have_their_causes() -> None:
    duty = Duty(
        torque=10.0,
        harmonics=(Harmonic(order=3.0, torque=1.0),),
        engine=Engine(
            speed_ratio=1.5, harmonics=(EngineHarmonic(order=2.0, torque=1.0), EngineHarmonic(order=4.0, torque=1.0))
        ),
        load=HarmonicTorque(amplitude=1.0, order=5.0),
    )
    found = orders(TWO, duty)
    assert [order for order, _cause in found] == [2.0, 3.0, 4.0, 5.0, 6.0]
    assert dict(found)[3.0] == "engine, order 2 of its crank, torque of the duty"
    assert [one for one, _cause in orders(Drive.from_angles([0.0]), Duty(engine=Engine(cylinders=6)))] == [3.0, 6.0]


def test_crossings_are_where_an_order_meets_a_mode() -> None:
    found = torsion_modes(TWO, replace(FREE, speed_range=(10.0, 15.0)))
    omega = found.omega[0]
    assert [(one.order, one.inside) for one in found.crossings] == [(4.0, True), (2.0, False)]
    assert [one.speed for one in found.crossings] == pytest.approx([omega / 4.0, omega / 2.0])


def test_a_pendulum_keeps_its_order_away_at_every_speed() -> None:
    """Tuned to order 2 it holds its station against that order: only the other mass can still swing, on the spring."""
    pendulum = Pendulum(mass=0.5, radius=0.4, length=0.1)
    stations = (TWO.stations[0], replace(TWO.stations[1], pendulum=pendulum))
    drive = replace(TWO, stations=stations, duty=Duty(input="free", speed=20.0))
    found = torsion_modes(drive)
    second = [one.speed for one in found.crossings if one.order == 2.0]
    assert second == pytest.approx([0.5 * math.sqrt(900.0 / 2.0)])
    held = torsion_modes(replace(drive, duty=Duty(speed=20.0)))
    assert [one for one in held.crossings if one.order == 2.0] == []
    for one in found.crossings:
        model = replace(drive, duty=replace(drive.duty, speed=one.speed))
        assert np.min(np.abs(torsion_modes(model).omega / one.speed - one.order)) < 1e-9
    speeds = np.asarray([5.0, 20.0, 60.0])
    alone = [torsion_modes(replace(drive, duty=replace(drive.duty, speed=one))).omega for one in speeds]
    np.testing.assert_allclose(found.at(speeds), alone, rtol=1e-12)


def test_an_absorber_parts_a_mode_in_two() -> None:
    """Book (248): natural frequencies with an absorber on a held mass."""
    tuned = Absorber(inertia=0.06, stiffness=0.06 * 900.0 / 0.6)
    drive = replace(TWO, stations=(Station(shaft=2, inertia=0.6, absorber=tuned),), duty=Duty(speed=1.0))
    whole = 1.0 + 1.1
    square = [0.5 * (whole + sign * math.sqrt(whole**2 - 4.0)) for sign in (-1, 1)]
    assert torsion_modes(drive).omega == pytest.approx([math.sqrt(900.0 / 0.6 * one) for one in square])


def test_a_finer_body_has_more_modes_and_the_same_first() -> None:
    tube = Shaft(number=2, length=1.5, outer=0.07, wall=0.002)
    ends = Station(shaft=1, inertia=1.0), Station(shaft=3, inertia=1.0)
    drive = replace(Drive.from_angles([0.1, 0.1]), shafts=(tube,), stations=ends)
    coarse, fine = torsion_modes(drive, FREE), torsion_modes(drive, FREE, pieces=20)
    assert (len(coarse.omega), len(fine.omega)) == (1, 20)
    assert coarse.omega[0] == pytest.approx(fine.omega[0], rel=2e-3)  # half a tube at each end is nearly all of it


def test_a_rigid_drive_has_no_modes() -> None:
    with pytest.raises(InputError, match=r"shafts\[0\]\.stiffness: missing; every shaft counts as rigid"):
        torsion_modes(replace(Drive.from_angles([0.1]), stations=(Station(shaft=1, inertia=1.0),)))
