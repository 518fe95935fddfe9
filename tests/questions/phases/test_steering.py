"""Steering columns: against plain vectors whose speed ratio is minimised directly, closed forms, and their poses."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import scipy

from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import pose_drives
from cardan.drive.settings import Pose, Steering
from cardan.drive.shaft import Shaft, Spline
from cardan.io import load
from cardan.io.edit import edit
from cardan.questions.phases.answer import answer
from cardan.questions.phases.phases import phases
from cardan.questions.phases.setting import values_of
from cardan.report.answers import subject
from cardan.report.summary import changes, uniformity, warnings
from cardan.units import deg

POINTS = np.asarray([(-0.52, 0.0, 0.25), (0.0, 0.0, 0.0), (0.3, -0.06, -0.23), (0.47, -0.16, -0.33)])


def unit(vector):
    return vector / np.linalg.norm(vector)


def about(axis, vector, angle):
    """Return a vector turned about a unit axis; angle (p,)."""
    c, s = np.cos(angle)[..., None], np.sin(angle)[..., None]
    return c * vector + s * np.cross(axis, vector) + (1.0 - c) * (vector @ axis)[..., None] * axis


def output_line(points, yoke_angles, phase, turn):
    """Return the angle of the last driven yoke's pin line about the output axis, unwrapped, for turns of the wheel."""
    axes = [unit(b - a) for a, b in pairwise(points)]
    arm = about(axes[0], np.cross(unit(np.cross(axes[0], axes[1])), axes[0])[None], phase + turn)
    for k, axis in enumerate(axes[1:]):
        pin = np.cross(axis, arm)
        pin /= np.linalg.norm(pin, axis=-1, keepdims=True)
        if k < len(yoke_angles):
            arm = about(axis, pin, np.full(len(turn), -yoke_angles[k]))
    flat = unit(np.cross(axes[-1], (0.0, 1.0, 0.0)))
    return np.unwrap(np.arctan2(pin @ np.cross(axes[-1], flat), pin @ flat))


def speed_ratio(points, yoke_angles, phase, turn):
    step = 1e-5
    ends = [output_line(points, yoke_angles, phase, turn + sign * step) for sign in (1.0, -1.0)]
    return (ends[0] - ends[1] + np.pi / 2) % np.pi / (2 * step) - np.pi / 2 / (2 * step)


def column(wanted, lock=540 * deg, **more):
    made = Drive.from_points(POINTS, yoke_angles=[0.0], start_phase=20 * deg)
    return replace(made, steering=Steering(lock=lock, centre_ratio=wanted), **more)


@pytest.mark.slow
@pytest.mark.parametrize("wanted", [0.95, 1.04])
def test_the_ratio_minimised_directly_over_plain_vectors_leads_to_the_same_column(wanted):
    turn = np.linspace(0.0, np.pi, 61)

    def miss(x):
        right, left = (speed_ratio(POINTS, x[:1], x[1], sign * turn) for sign in (1.0, -1.0))
        return 1e3 * ((right[0] - wanted) ** 2 + np.mean((right - left) ** 2))

    found = phases(column(wanted)).steering
    for one in found[1:]:
        start = np.asarray([one.setting.yoke_angle[0] + 0.1, one.setting.start_phase - 0.15])
        best = scipy.optimize.minimize(miss, start, method="Nelder-Mead", options={"xatol": 1e-8, "fatol": 1e-14})
        assert best.fun < 1e-9
        here = [one.setting.yoke_angle[0], one.setting.start_phase]
        assert np.sin(best.x - here) == pytest.approx(0.0, abs=1e-5)  # the simplex ends within 1e-5 rad
    everywhere = np.linspace(-np.pi, np.pi, 41)
    ratio = speed_ratio(POINTS, [one.setting.yoke_angle[0]], one.setting.start_phase, everywhere)
    assert ratio == pytest.approx(np.interp(everywhere, one.angle, one.ratio), abs=3e-5)  # 0.75° steps drawn straight


@pytest.mark.parametrize("lock", [30 * deg, 540 * deg])
def test_what_a_column_does_as_specified_is_what_plain_vectors_do(lock):
    one = phases(column(0.95, lock)).steering[0]
    turn = np.linspace(-lock, lock, 4001)
    ratio = speed_ratio(POINTS, [0.0], 20 * deg, turn)
    assert one.centre_ratio == pytest.approx(ratio[2000], abs=1e-7)
    assert (one.least, one.greatest) == pytest.approx((ratio.min(), ratio.max()), abs=1e-6)
    assert one.asymmetry == pytest.approx(np.max(np.abs(ratio - ratio[::-1])), abs=1e-6)
    assert one.ripple == one.greatest - one.least


def test_a_single_joint_stands_with_its_first_yoke_in_its_plane_or_across_it():
    alpha = 25 * deg
    for wanted, phase, ratio in ((1.2, 0.0, 1 / np.cos(alpha)), (0.8, 0.5 * np.pi, np.cos(alpha))):
        one = Drive.from_angles([alpha], start_phase=0.3)
        found = phases(replace(one, steering=Steering(lock=9.0, centre_ratio=wanted))).steering
        assert np.sin(found[1].setting.start_phase - phase) == pytest.approx(0.0, abs=1e-12)
        assert found[1].centre_ratio == pytest.approx(ratio, rel=1e-12)
        assert found[1].asymmetry < 1e-12
        said = answer(one, phases(replace(one, steering=Steering(lock=9.0, centre_ratio=wanted))))
        assert said.tables


def test_a_ratio_of_one_is_the_uniform_column_where_there_is_one():
    pair = replace(Drive.from_angles([0.4, 0.4], yoke_angles=[0.5]), steering=Steering(lock=9.0))
    best = phases(pair).steering[1]
    assert best.setting.speed_fluctuation < 1e-14
    assert best.centre_ratio == pytest.approx(1.0, abs=1e-14)
    assert best.ripple < 1e-13


def test_in_a_pose_straight_ahead_is_where_the_output_stands_as_drawn():
    low = (-0.53, 0.0, 0.21)
    moved = column(0.95, poses=(Pose(name="low", share=None, set=(("input.point_m", low),)),))
    assert pose_drives(moved)[0].input.point == low
    one = phases(moved).steering[1]
    points = np.asarray([low, *POINTS[1:]])
    yokes, phase = [one.setting.yoke_angle[0]], one.setting.start_phase
    home = output_line(POINTS, yokes, phase, np.zeros(1))[0]

    def off(turn):
        return np.sin(output_line(points, yokes, phase, np.asarray([turn]))[0] - home)

    near = min(np.linspace(-1.0, 1.0, 201), key=lambda turn: abs(off(turn)))
    centre = scipy.optimize.brentq(off, near - 0.02, near + 0.02)
    turn = np.linspace(-np.pi, np.pi, 4001)
    ratio = speed_ratio(points, yokes, phase, centre + turn)
    assert one.pose_centre_ratio[0] == pytest.approx(ratio[2000], abs=1e-7)
    assert one.pose_asymmetry[0] == pytest.approx(np.max(np.abs(ratio - ratio[::-1])), abs=1e-6)


def test_on_teeth_the_column_is_the_best_of_all_places():
    toothed = column(0.95, shafts=(Shaft(number=2, spline=Spline(teeth=20)),))
    found = next(one for one in phases(toothed).steering if "teeth" in one.setting.label)
    turn = np.linspace(0.0, np.pi, 3001)
    least = [speed_ratio(POINTS, [k * np.pi / 10], 0.0, turn).min() for k in range(10)]
    assert abs(found.centre_ratio - 0.95) == pytest.approx(np.min(np.abs(np.asarray(least) - 0.95)), abs=1e-6)
    assert found.asymmetry < 1e-12
    place = found.setting.yoke_angle[0] / (np.pi / 10)
    assert place == pytest.approx(round(place), abs=1e-9)


def test_the_best_setting_written_into_the_file_is_as_told(tmp_path):
    path = tmp_path / "column.toml"
    drive = load("examples/steering-column.toml")
    found = phases(drive)
    with open("examples/steering-column.toml", encoding="utf-8") as file:
        path.write_text(edit(file.read(), values_of(found.steering[1].setting, drive)), encoding="utf-8")
    again = phases(load(path))
    assert again.steering[0].centre_ratio == pytest.approx(0.95, abs=1e-9)
    assert again.steering[0].asymmetry < 1e-9
    said = answer(load(path), again)
    texts = [remark.text.told(USUAL) for remark in said.remarks if hasattr(remark.text, "told")]
    assert any("the same to the left and to the right" in text for text in texts)
    assert {key.name for key in said.keys} >= {"torque_ripple", "steering_asymmetry"}


def test_the_first_page_speaks_of_the_ratio_wanted_and_not_of_uniform_yokes():
    on = subject(load("examples/steering-column.toml"))
    assert uniformity(on).tone == "warning"
    assert "wanted is 0.9500" in uniformity(on).text
    assert changes(on).text.startswith("Setting S1")
    assert not any("uniform" in one.text for one in warnings(on))
