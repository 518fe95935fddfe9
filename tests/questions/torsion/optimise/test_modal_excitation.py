"""What joints do to a mode, against the exact drive: resonance of order 2, growth in the principal zone, the node."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.book.mathieu_drive import mathieu_reduction
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.optimise.answer import rule_reasons
from cardan.questions.torsion.optimise.modal_excitation import NodeRule, node_rules
from cardan.questions.torsion.steady.run_stability import floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.units import deg

ENDS = (Station(shaft=1, end="start", inertia=0.9), Station(shaft=3, end="end", inertia=0.5))
FREE = replace(
    Drive.from_angles([9 * deg, 7 * deg], plane_twists=[30 * deg], yoke_angles=[20 * deg], start_phase=10 * deg),
    shafts=(
        Shaft(number=1, stiffness=3000.0, damping=0.15),
        Shaft(number=2, stiffness=5000.0, inertia=0.02, yoke_angle=20 * deg),
        Shaft(number=3, stiffness=2500.0, damping=0.2),
    ),
    stations=ENDS,
    duty=Duty(speed=50.0, input="free"),
)


def slowest(drive: Drive) -> tuple[NodeRule, object]:
    train = torsional_train(drive)
    return node_rules(train)[0], train.model


@pytest.mark.parametrize("held", [False, True])
def test_the_push_is_the_resonance_of_order_two(held: bool) -> None:
    drive = replace(FREE, duty=Duty(speed=50.0)) if held else FREE
    drive = replace(drive, shafts=tuple(replace(one, damping=2.0) for one in drive.shafts))
    rule, model = slowest(drive)
    found = periodic_response(model, speed=0.5 * rule.omega)
    # the other modes and the second order in the bends: up to two hundredths
    assert float(np.max(found.peak_to_peak)) / 2.0 == pytest.approx(rule.resonance_torque, rel=0.02)


def test_a_load_turns_the_push() -> None:
    """Two equal joint angles whose phases cancel push by the twist of the load alone; another yoke takes that away."""
    plain = Drive.from_angles([0.25, 0.25])
    tube = Shaft(number=2, stiffness=5000.0, damping=8.0, inertia=0.01)
    load = (Station(shaft=3, inertia=0.8),)
    for yoke in (0.0, -2.0 * 60.0 / 5000.0):
        shafts = (plain.shafts[0], replace(tube, yoke_angle=yoke), plain.shafts[2])
        rule, model = slowest(replace(plain, shafts=shafts, stations=load, duty=Duty(speed=40.0, torque=60.0)))
        found = float(periodic_response(model, speed=0.5 * rule.omega).peak_to_peak[0]) / 2.0
        if yoke == 0.0:
            assert found == pytest.approx(rule.resonance_torque, rel=0.02)
            whole = found
    assert rule.resonance_torque < 0.12 * whole  # the tube is not without inertia
    assert found < 0.3 * whole  # what else there is: orders 0 and 4


@pytest.mark.parametrize("yoke", [20.0, 65.0, -40.0])
def test_the_modulation_is_the_growth_amid_the_principal_zone(yoke: float) -> None:
    shafts = (FREE.shafts[0], replace(FREE.shafts[1], yoke_angle=yoke * deg), FREE.shafts[2])
    rule, model = slowest(replace(FREE, shafts=tuple(replace(one, damping=0.001) for one in shafts)))
    found = floquet(periodic_response(model, speed=rule.omega))
    assert rule.grows
    growth = rule.omega * (0.5 * rule.modulation - rule.damping_ratio)
    assert float(found.growth_rate) == pytest.approx(growth, rel=0.02)


def test_a_joint_in_the_node_excites_no_parametric_vibration() -> None:
    """Two masses, one joint: only where the springs balance the masses is the exact drive not destabilised."""
    grown = []
    for share in (0.2, 0.9 / 1.4, 0.9):
        ends = (ENDS[0], replace(ENDS[1], shaft=2))
        whole = 1500.0
        # compliance before the joint as a share of the whole: the node lies at J_b/(J_a + J_b) of it
        before, behind = whole / (1.0 - share), whole / share
        shafts = (Shaft(number=1, stiffness=before, damping=1e-3), Shaft(number=2, stiffness=behind, damping=1e-3))
        drive = replace(Drive.from_angles([14 * deg]), shafts=shafts, stations=ends, duty=FREE.duty)
        rule, model = slowest(drive)
        assert rule.kappa[0] == pytest.approx((1.0 - share) - 0.5 / 1.4, abs=1e-9)
        grown.append(float(floquet(periodic_response(model, speed=rule.omega)).growth_rate))
        node = any("stands in the node" in told(one, USUAL) for one in rule_reasons(rule))
        assert node == (abs(rule.kappa[0]) < 1e-6)
    assert grown[1] < 0.0 < min(grown[0], grown[2])


def test_two_masses_give_the_reduction_of_mathieu() -> None:
    drive = replace(FREE, shafts=(FREE.shafts[0], replace(FREE.shafts[1], inertia=0.0), FREE.shafts[2]))
    rule, model = slowest(drive)
    springs = [3000.0, 5000.0, 2500.0]
    wanted = mathieu_reduction(model.joint_angle, model.phase, springs, first_inertia=0.9, last_inertia=0.5, speed=50.0)
    assert rule.modulation == pytest.approx(float(wanted.q / wanted.a), rel=1e-9)


def test_straight_joints_do_nothing() -> None:
    rule, _model = slowest(replace(FREE, joints=tuple(replace(one, joint_angle=0.0) for one in FREE.joints)))
    (said,) = rule_reasons(rule)
    assert told(said, USUAL).endswith("no joint changes the speed, so nothing excites it.")
    assert (rule.modulation, rule.push, rule.left, rule.resonance_torque) == (0.0, 0.0, 0.0, 0.0)
