"""Spline settings against exhaustive enumeration on plain vectors."""

from itertools import product

import numpy as np
import pytest

from cardan import Drive, phases
from cardan.drive.joints import Hooke
from cardan.drive.shaft import Shaft, Spline
from cardan.questions.phases import spline_pitch
from cardan.questions.phases.spline_pitch import steps
from cardan.units import deg
from tests.builders import closing


def splined(joint_angles, twists, teeth, yokes, fixed=()):
    """Return a drive; None for teeth means a shaft without a spline."""
    return Drive(
        joints=tuple(
            Hooke(joint_angle=float(b), plane_twist=float(t)) for b, t in zip(joint_angles, (0.0, *twists), strict=True)
        ),
        shafts=tuple(
            Shaft(number=k, yoke_angle=float(y), yoke_fixed=k in fixed, spline=None if z is None else Spline(teeth=z))
            for k, (y, z) in enumerate(zip(yokes, teeth, strict=True), start=2)
        ),
    )


def every(joint_angles, twists, teeth, yokes):
    """Return all settings (s, n-1) and their δ, z places each, repeats included."""
    rows = np.asarray(list(product(*(y + np.arange(z) * 2 * np.pi / z for y, z in zip(yokes, teeth, strict=True)))))
    return rows, closing.speed_fluctuation(np.asarray(joint_angles), np.asarray(twists), rows)


@pytest.mark.parametrize(("teeth", "count"), [(16, 8), (21, 21), (1, 1), (2, 1), (3, 3), (6, 3)])
def test_teeth_give_distinct_angles_modulo_half_a_turn(teeth, count):
    angles = np.arange(teeth) * 2 * np.pi / teeth
    distinct = {round(a, 9) % round(np.pi, 9) for a in np.mod(angles, np.pi).round(9)}
    assert steps(teeth) == count == len(distinct)


@pytest.mark.parametrize(
    ("joint_angles", "twists", "teeth", "offsets", "best", "second", "at"),
    [
        (
            (11.5, 15 + 1 / 3, 15, 16.5),
            (1.9, -(22 + 56 / 60), 49 + 59 / 60),
            (16, 16, 16),
            (90, 0, 0),
            0.005227002348569574,
            0.008822031742284877,
            (90, 45, 0),
        ),
        (
            (10, 15, 17),
            (20, -70),
            (21, 23),
            (0, 5),
            0.003757733049975223,
            0.006208564125714999,
            (102.857142857, 59.782608696),
        ),
    ],
)
def test_known_enumerations(joint_angles, twists, teeth, offsets, best, second, at):
    drive = splined(np.asarray(joint_angles) * deg, np.asarray(twists) * deg, teeth, np.asarray(offsets) * deg)
    found = phases(drive)
    assert found.spline_steps == {k: steps(z) for k, z in enumerate(teeth, start=2)}
    first, runner_up = found.spline_settings[:2]
    assert first.speed_fluctuation == pytest.approx(best, rel=1e-8)
    assert runner_up.speed_fluctuation == pytest.approx(second, rel=1e-8)
    assert np.abs(np.sin(first.yoke_angle - np.asarray(at) * deg)).max() < 1e-9
    assert first.label == f"{'/'.join(dict.fromkeys(map(str, teeth)))}-tooth splines"


@pytest.mark.parametrize("seed", range(4))
def test_best_and_runners_up_are_those_of_the_enumeration(seed):
    random = np.random.default_rng(seed)
    n = 3 + seed % 2
    joint_angles, twists = random.uniform(5, 25, n) * deg, random.uniform(-3, 3, n - 1)
    teeth, yokes = random.integers(3, 14, n - 1), random.uniform(-1, 1, n - 1)
    found = phases(splined(joint_angles, twists, [int(z) for z in teeth], yokes))
    _rows, uneven = every(joint_angles, twists, teeth, yokes)
    distinct = np.unique(np.round(uneven, 11))
    got = [s.speed_fluctuation for s in found.spline_settings]
    assert got == sorted(got)
    np.testing.assert_allclose(got[0], distinct[0], atol=1e-10)
    assert {round(float(g), 10) for g in got} <= {round(float(d), 10) for d in distinct}


@pytest.mark.parametrize("seed", range(3))
def test_meeting_in_the_middle_finds_what_direct_enumeration_finds(seed, monkeypatch):
    random = np.random.default_rng(seed)
    joint_angles, twists = random.uniform(5, 25, 6) * deg, random.uniform(-3, 3, 5)
    drive = splined(joint_angles, twists, (10, 7, 12, 9, 16), random.uniform(-1, 1, 5))
    direct = phases(drive).spline_settings
    monkeypatch.setattr(spline_pitch, "DIRECT", 1)
    met = phases(drive).spline_settings
    assert len(met) == len(direct) == 6
    for one, two in zip(direct, met, strict=True):
        np.testing.assert_allclose(one.yoke_angle, two.yoke_angle, atol=1e-14)


def test_ties_go_to_the_smaller_change_also_in_the_middle(monkeypatch):
    """A straight joint leaves its yoke without effect: all its places tie."""
    drive = splined((0.2, 0.0, 0.25), (0.0, 0.3), (8, 8), (0.1, 0.2))
    direct = phases(drive).spline_settings
    monkeypatch.setattr(spline_pitch, "DIRECT", 1)
    met = phases(drive).spline_settings
    assert direct[0].speed_fluctuation == pytest.approx(direct[1].speed_fluctuation, abs=1e-14)
    change = [(s.change**2).sum() for s in direct if abs(s.speed_fluctuation - direct[0].speed_fluctuation) < 1e-12]
    assert change == sorted(change)
    np.testing.assert_allclose([s.speed_fluctuation for s in met], [s.speed_fluctuation for s in direct], atol=1e-14)


def test_ten_yokes_of_sixteen_teeth():
    random = np.random.default_rng(4)
    n = 11
    drive = splined(random.uniform(5, 20, n) * deg, random.uniform(-3, 3, n - 1), [16] * (n - 1), [0.0] * (n - 1))
    found = phases(drive)
    # 8^10 settings leave about 1e-9 of the range between them, in two dimensions its root
    assert found.spline_settings[0].speed_fluctuation < 1e-4
    assert found.spline_refusal == ""


def test_too_many_settings_are_refused_with_their_number():
    n = 16
    found = phases(splined([0.2] * n, [0.1] * (n - 1), [24] * (n - 1), [0.0] * (n - 1)))
    assert found.spline_settings == ()
    assert "1.54e+16" in found.spline_refusal
    assert found.settings[0].speed_fluctuation < 1e-14


def test_yokes_without_teeth_are_set_freely_and_held_ones_stay():
    random = np.random.default_rng(5)
    joint_angles, twists = random.uniform(8, 20, 4) * deg, random.uniform(-3, 3, 3)
    yokes = (0.3, -0.2, 0.5)
    drive = splined(joint_angles, twists, (16, None, 16), yokes, fixed=(4,))
    found = phases(drive)
    assert found.spline_steps == {2: 8}
    rows = [(0.3 + k * np.pi / 8, x, 0.5) for k in range(8) for x in np.linspace(0, np.pi, 2001)]
    uneven = closing.speed_fluctuation(joint_angles, twists, np.asarray(rows))
    # a grid of 1.6 mrad beside a minimum: slope below 0.3 per rad
    assert found.spline_settings[0].speed_fluctuation == pytest.approx(float(uneven.min()), abs=5e-4)
    assert found.spline_settings[0].speed_fluctuation <= uneven.min() + 1e-12
    for setting in found.spline_settings:
        assert setting.yoke_angle[2] == pytest.approx(0.5)
        assert np.sin(8 * (setting.yoke_angle[0] - 0.3)) == pytest.approx(0.0, abs=1e-12)
