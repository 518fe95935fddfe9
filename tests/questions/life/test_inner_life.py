"""Life of bearings inside of joints, against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.drive.joints.double_cardan import even_share
from cardan.formulas.joint_rating import POWER
from cardan.io.drive_file import loads
from cardan.joints import DoubleCardan, Tripod
from cardan.questions.life import answer as life_answer
from cardan.questions.life.bearing_life import MILLION, swing_damage
from cardan.questions.life.bearing_loads import bearing_damage
from cardan.questions.life.life import life

BEND = 0.3

TEXT = """format = 1
[[joints]]
kind = "tripod"
joint_angle_deg = 0.5
track_radius_mm = 19
roller_diameter_mm = 30
bearing_capacity_kN = 20
[[joints]]
kind = "double_cardan"
joint_angle_deg = 16
centring_ratio = 0.5
centre_distance_mm = 70
journal_span_mm = 62
journal_diameter_mm = 15
bearing_capacity_kN = 17
[[joints]]
kind = "rzeppa"
joint_angle_deg = 5
[duty]
speed_rpm = 1000
torque_Nm = 350
"""


def test_crosses_far_apart_wear_as_two_cross_joints_of_half_the_angle():
    """Far apart the ball needs no force, and each cross has the couple of a cross joint at half the joint angle.

    K = T in the closed form is 2RQ: the load of a journal times the span.
    """
    span = 0.06
    joint = DoubleCardan(
        centring_ratio=float(even_share(BEND)),
        centre_distance=1e6,
        journal_span=span,
        journal_diameter=0.014,
        bearing_capacity=17e3,
    )
    _force, damage = bearing_damage(joint, BEND)
    most = max(float(one) for one in swing_damage(0.5 * BEND, torque_at="input"))
    assert np.mean(damage, axis=-1) * span**POWER == pytest.approx([most, most], rel=1e-4)  # places of a degree


def test_rollers_wear_as_they_run_to_and_fro():
    """At small joint angles F = T/(3R), and a roller turns by R tan α cos φ over its radius."""
    track, roller, bend = 0.019, 0.015, 1e-3
    joint = Tripod(track_radius=track, roller_diameter=2.0 * roller, bearing_capacity=20e3)
    force, damage = bearing_damage(joint, bend)
    assert force == pytest.approx(1.0 / (3.0 * track), rel=1e-5)
    expected = 2.0 / np.pi * np.tan(bend) * track / roller * (1.0 / (3.0 * track)) ** POWER
    assert np.mean(damage, axis=-1) == pytest.approx([expected, expected], rel=1e-4)


def test_life_of_rollers_is_that_of_iso_281():
    """L = 10⁶ (C/F)^(10/3) turns of the roller, which turns by 4 R tan α/r in a turn of the shaft."""
    found = life(loads(TEXT))
    force = 350.0 / (3.0 * 0.019)
    turns = MILLION * (20e3 / force) ** POWER / (4.0 * np.tan(np.radians(0.5)) * 0.019 / 0.015 / (2.0 * np.pi))
    assert found.joints[0] == pytest.approx(turns / (1000.0 / 60.0), rel=1e-3)
    assert found.journal_force[0, 0] == pytest.approx(force, rel=1e-3)
    assert found.joint_angle[0] == pytest.approx(np.radians([0.5, 16.0, 0.0]), abs=0.1)
    assert np.isfinite(found.joints[1])
    assert np.isnan(found.joints[2])
    assert np.isnan(found.of("simple")[:2]).all()
    assert np.isnan(found.of("book")[:2]).all()


def test_harder_work_and_shocks_wear_by_the_power():
    drive = loads(TEXT)
    plain, hard = life(drive), life(replace(drive, duty=replace(drive.duty, torque=700.0, shock_factor=1.2)))
    assert hard.joints[:2] == pytest.approx(plain.joints[:2] / 2.4**POWER)


def test_what_the_life_of_balls_lacks_is_said():
    drive = loads(TEXT)
    texts = [str(one.text) for one in life_answer.answer(drive, life(drive)).remarks]
    assert sum("ISO 281 has no life" in text for text in texts) == 1
    bare = loads(TEXT.replace("bearing_capacity_kN = 17\n", ""))
    assert "joints[1].bearing_capacity" in [one.field for one in life(bare).uncounted]
