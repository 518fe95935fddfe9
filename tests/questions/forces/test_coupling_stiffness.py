"""Forces of flexible couplings out of line, on their shafts and supports."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import check, forces, losses
from cardan.drive.models.dynamics_model import train
from cardan.io.drive_file import loads
from cardan.questions.forces.turn_loads import turn_loads

STIFF = """bending_stiffness_Nm_per_deg = 3
axial_stiffness_N_per_mm = 100
axial_shift_mm = -2
lateral_stiffness_N_per_mm = 400
lateral_shift_mm = 0.5
lateral_direction_deg = 90"""


def coupled(more: str, *, torque: float = 0.0, moves: str = "") -> str:
    """Return the file of two shafts, 2° out of line, each in two bearings, with a flexible coupling between them."""
    return f"""format = 1
[input]
point_mm = [-500, 0, 0]
[output]
point_mm = [499.695413509548, 0, -17.449748351250]
[[joints]]
kind = "elastic_half_cardan"
centre_mm = [0, 0, 0]
{more}
[[supports]]
shaft = 1
position_mm = -100
[[supports]]
shaft = 1
position_mm = -300
axial = true
[[supports]]
shaft = 2
position_mm = 100
friction = 0.01
bore_mm = 30
[[supports]]
shaft = 2
position_mm = 300
axial = true
friction = 0.01
bore_mm = 30
{moves}
[duty]
speed_rpm = 1000
torque_Nm = {torque}
"""


def test_supports_carry_what_the_coupling_asks_for():
    """A couple of 6 N·m, 200 N apart and 200 N along the normal, by plain statics of two shafts on two bearings."""
    found = forces(loads(coupled(STIFF)))
    before, after = found.axis[:, 0]
    normal = np.cross(before, after) / np.linalg.norm(np.cross(before, after))
    reaction = found.reaction[:, 0]
    couple, push, across = 6.0 * normal, 200.0, -200.0 * normal
    force = push * (before + after) / np.linalg.norm(before + after) + across  # on the driven shaft
    # closer than without load the shafts are pushed apart: on the driven shaft along the power flow
    assert reaction[3] @ after == pytest.approx(-force @ after)
    assert reaction[1] @ before == pytest.approx(force @ before)
    for bearings, places, axis, sign in (
        (reaction[2:], (0.1, 0.3), after, 1.0),
        (reaction[:2], (-0.1, -0.3), before, -1.0),
    ):
        moment = sum(place * np.cross(axis, own) for place, own in zip(places, bearings, strict=True))
        assert moment - sign * couple == pytest.approx(np.zeros(3), abs=1e-9)
        assert np.sum(bearings, axis=0) + sign * force == pytest.approx(np.zeros(3), abs=1e-9)
    assert np.max(found.force_left) < 1e-12
    assert np.max(found.moment_left) < 1e-12


def test_the_torque_of_the_input_knows_nothing_of_them():
    plain, stiff = (forces(loads(coupled(more, torque=80.0))) for more in ("", STIFF))
    assert stiff.input_torque == pytest.approx(plain.input_torque)
    even = 80.0 * np.tan(np.radians(1.0))
    assert stiff.bending_couple[1, 0] == pytest.approx(np.hypot(even, 6.0), rel=1e-9)


def test_supports_that_rub_feel_them():
    plain, stiff = (losses(loads(coupled(more, torque=80.0))) for more in ("", STIFF))
    assert np.sum(stiff.supports) > 2.0 * np.sum(plain.supports)
    carried = forces(loads(coupled(STIFF, torque=80.0)))
    size = np.linalg.norm(carried.reaction[2:], axis=-1)
    speed = 1000.0 * np.pi / 30.0
    # their friction adds some 1e-4 to the torque
    assert stiff.supports[2:] == pytest.approx(0.01 * 0.015 * speed * np.mean(size, axis=-1), rel=1e-4)


def test_power_closes_while_the_coupling_bends():
    moves = '[[movements]]\nkind = "harmonic"\nmoves = ["output"]\namplitude_mm = [0, 0, 20]\nfrequency_Hz = 2\n'
    drive = loads(coupled(STIFF, torque=80.0, moves=moves))
    assert np.max(forces(drive, movement=drive.movements).power_left) < 1e-10


def test_checks_of_the_shafts_count_the_couple():
    drive = loads(coupled(STIFF, torque=80.0))
    counted = turn_loads(train(drive, kinds=True).chain, 80.0)
    assert counted.bending == pytest.approx(np.max(forces(drive).bending_couple, axis=-1), rel=1e-6)
    assert check(drive, only=["answers_agree"])[0].state == "passed"
