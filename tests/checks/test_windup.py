"""Flexible couplings: how far they twist, and what they do to their shafts."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import InputError, check, forces
from cardan.io.drive_file import loads
from cardan.questions.forces.inner_loads import inner_loads

TEXT = """format = 1
[[joints]]
kind = "elastic_half_cardan"
joint_angle_deg = 2
stiffness_Nm_per_deg = 50
{more}
[duty]
torque_Nm = 300
shock_factor = 1.5
"""


def test_a_coupling_twists_by_torque_over_stiffness():
    (own,) = check(loads(TEXT.format(more="max_windup_deg = 10")), only=["windup"])
    assert np.degrees(own.value) == pytest.approx(300.0 * 1.5 / 50.0)
    assert own.utilisation == pytest.approx(0.9)


def test_the_limit_of_a_type_is_a_limit():
    (own,) = check(loads(TEXT.format(more='type = "el_hexagon"')), only=["windup"])
    assert np.degrees(own.limit) == pytest.approx(7.0)
    assert own.state == "failed"


def test_what_the_check_lacks_is_named():
    (own,) = check(loads(TEXT.format(more="")), only=["windup"])
    assert own.missing == ("joints[0].max_windup",)
    assert check(loads("format = 1\n[[joints]]\njoint_angle_deg = 2\n"), only=["windup"]) == ()


def test_a_coupling_out_of_line_loads_its_shafts():
    more = """bending_stiffness_Nm_per_deg = 3
axial_stiffness_N_per_mm = 100
axial_shift_mm = -2
lateral_stiffness_N_per_mm = 400
lateral_shift_mm = 0.5"""
    drive = loads(TEXT.format(more=more))
    found = inner_loads(drive, forces(drive))
    assert [(one.high, one.couple) for one in found] == [
        pytest.approx((0.0, 6.0)),
        pytest.approx((200.0, 0.0)),
        pytest.approx((200.0, 0.0)),
    ]


def test_a_shift_needs_its_stiffness():
    with pytest.raises(InputError, match="axial_stiffness"):
        loads(TEXT.format(more="axial_shift_mm = 1"))
