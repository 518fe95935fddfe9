from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, equivalent_joint
from cardan.io import example
from cardan.questions.bending.cracked_rotor import Crack, cracked_rotor
from cardan.questions.diagnosis.drive_model import plant
from cardan.questions.diagnosis.expected import FAULTS, LOSSES, expected_orders
from cardan.units import deg


def force(found, kind, order, direction="radial"):
    """Return the sizes of the lines of an order at a housing, the last line last."""
    lines = (one for one in found.orders if (one.kind, one.order, one.direction) == (kind, order, direction))
    return [one.size for one in lines]


def test_unbalance_grows_with_the_square_of_the_speed_and_the_bending_mode():
    drive = example("car-propshaft")
    found = expected_orders(drive, "unbalance")
    line = found.orders[-2]
    assert (line.order, line.direction) == (1.0, "radial")
    speed = np.array([0.1, 0.5]) * found.critical
    slow, fast = np.abs(found.value(line, speed, 0.0))
    ratio = lambda share: share**2 / np.hypot(1 - share**2, 2 * found.damping * share)  # noqa: E731
    assert fast / slow == pytest.approx(ratio(0.5) / ratio(0.1), rel=1e-12)
    # Half of the force m e ω² at each joint.
    base = plant(drive)
    assert line.size * base.housings[-1].mass == pytest.approx(2.0 * base.allowed[0] * base.speed[1] ** 2)


def test_order_2_is_that_of_the_secondary_couple():
    drive = example("car-propshaft")
    base, found = plant(drive), expected_orders(drive)
    line = next(one for one in found.orders if one.order == 2.0 and one.torque == (0.0, 0.0, 1.0))
    couple = drive.duty.torque * np.tan(base.joint_angle[0])
    assert line.size * base.housings[0].mass * base.length[0] == pytest.approx(couple)
    assert abs(found.value(line, 100.0, 0.0)) == 0.0


@pytest.mark.parametrize("order", [2, 3])
def test_a_shallow_crack_shakes_as_the_cracked_rotor_does(order):
    # The same losses, small enough that what is left out of their first order is below a percent.
    share = 1e-3
    found = expected_orders(example("car-propshaft"), "crack", severity=share)
    base = plant(example("car-propshaft"))
    mass, critical = float(base.mass[0]), found.critical
    speed = 0.8 * critical / order
    crack = Crack(loss_xi=share * LOSSES[0], loss_eta=share * LOSSES[1])
    rotor = cracked_rotor(mass, mass * critical**2, speed, crack=crack, damping_ratio=found.damping, orders=4)
    swing = abs(rotor.amplitude[..., list(rotor.order).index(order)])
    line = [one for one in found.orders if one.order == order and one.direction == "radial" and one.kind == "input"][-1]
    pushed = 2.0 * base.housings[0].mass * abs(found.value(line, speed, 0.0))
    assert pushed == pytest.approx(float(swing) * mass * critical**2, rel=0.01)


def test_a_turned_yoke_makes_the_output_as_uneven_as_the_equivalent_joint_says():
    drive = Drive.from_angles([6 * deg, 6 * deg], plane_twists=[0.0])
    even = expected_orders(drive, "phase")
    turned = replace(
        drive, shafts=tuple(replace(one, yoke_angle=30 * deg) if one.number == 2 else one for one in drive.shafts)
    )
    swing = abs(equivalent_joint(turned).vertex[-1] - equivalent_joint(drive).vertex[-1])
    # The vertices add to the first order in tan²(α/2); what is left out is of that size itself.
    top = even.speed[1]
    assert force(even, "output", 2.0, "torsion")[-1] == pytest.approx(2.0 * top * float(swing), rel=0.02)


@pytest.mark.parametrize("fault", [one for one in FAULTS if one not in ("healthy", "half_critical", "critical")])
def test_a_fault_adds_to_the_drive_in_order(fault):
    drive = example("truck-supports")
    healthy, found = expected_orders(drive), expected_orders(drive, fault)
    slight = expected_orders(drive, fault, severity=0.5)
    total = lambda one: sum(line.size**2 for line in one.orders)  # noqa: E731
    assert total(healthy) < total(slight) < total(found)
    assert found.cause == FAULTS[fault]
    assert all(line.source for line in found.orders)


def test_what_cannot_be_is_refused():
    drive = example("car-propshaft")
    for fault, more, field in (
        ("rust", {}, "fault"),
        ("bent", {"severity": 0.0}, "severity"),
        ("bent", {"shaft": 3}, "shaft"),
        ("centre_bearing", {}, "fault"),
    ):
        with pytest.raises(InputError) as told:
            expected_orders(drive, fault, **more)
        assert told.value.problems[0].field == field
