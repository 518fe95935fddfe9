"""Extremes of batches without positions: compiled and plain form against forty digits and `equivalent_joint`."""

from __future__ import annotations

from dataclasses import fields, replace

import array_api_strict
import mpmath as mp
import numpy as np
import pytest

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives
from cardan.errors import InputError
from cardan.maths.compiled import method
from cardan.maths.compiled.method import Compiled, Plain
from cardan.questions.motion import extremes as module
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.extremes import LARGE, Extremes, extremes
from cardan.questions.motion.many_drives import traces
from tests.builders import recurrence
from tests.questions.motion.test_traces import METHODS, drives

NAMES = tuple(field.name for field in fields(Extremes))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("joints", range(1, 9))
def test_forty_digits(method, joints):
    batch = drives(12, joints, joint_angle=0.5)
    c = batch.chain
    found = extremes(batch, method=method)
    with mp.workdps(recurrence.DIGITS):
        exact = [recurrence.largest_ratio(*row) for row in zip(c.joint_angle, c.plane_twist, c.yoke_angle, strict=True)]
        delta = np.asarray([float(x - 1 / x) for x in exact])
        tau = np.asarray([float((x - 1) / (x + 1)) for x in exact])
        joint_angle = np.asarray([float(mp.acos(1 / x)) for x in exact])
    # rounding of n products of numbers near 1, each with an error of about 2e-16
    close = 2e-15 * joints
    np.testing.assert_allclose(found.speed_fluctuation, delta, atol=2 * close, rtol=close)
    np.testing.assert_allclose(found.tau, tau, atol=close)
    np.testing.assert_allclose(found.ratio_max, [float(x) for x in exact], rtol=close)
    np.testing.assert_allclose(
        found.joint_angle**2, joint_angle**2, atol=4 * close
    )  # the joint angle is a square root of δ
    np.testing.assert_allclose(found.ratio_min * found.ratio_max, 1.0, rtol=4e-16)


@pytest.mark.parametrize("method", METHODS)
def test_equals_the_equivalent_joint(method):
    batch = drives(500, 4)
    found, wanted = extremes(batch, method=method), equivalent_joint(batch)
    for name in ("speed_fluctuation", "tau", "joint_angle", "ratio_max", "max_acceleration", "max_angle_error"):
        np.testing.assert_allclose(getattr(found, name), getattr(wanted, name), rtol=1e-12, atol=1e-14, err_msg=name)
    np.testing.assert_allclose(found.harmonics(4), wanted.harmonics(4), atol=1e-14)
    turned = np.abs(np.sin(found.phase - wanted.phase)) * found.speed_fluctuation  # a phase means as much as δ
    assert np.max(turned) < 1e-14


@pytest.mark.parametrize("method", METHODS)
def test_stored_traces_reach_them_and_no_more(method):
    """On 7200 positions the extreme is missed by at most the curvature times (2π/7200)²/8, 1e-6 here."""
    batch = drives(20, 4, joint_angle=0.4)
    found = extremes(batch, method=method)
    path = traces(batch, np.linspace(0, np.pi, 3601))
    for largest, reached in (
        (found.ratio_max, path.ratio.max(axis=-1)),
        (-found.ratio_min, (-path.ratio).max(axis=-1)),
        (found.max_acceleration, np.abs(path.acceleration).max(axis=-1)),
    ):
        assert np.all(reached <= largest + 1e-14)
        np.testing.assert_allclose(reached, largest, atol=2e-5)


@pytest.mark.parametrize("count", [1, 2, 7, 8, 9, 63, 64, 65, 4097])
@pytest.mark.parametrize("threads", [1, 2])
def test_odd_sizes(count, threads):
    batch = drives(count, 3)
    one, two = extremes(batch, method=Compiled(threads=threads)), extremes(batch, method=Plain())
    for name in NAMES:
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=1e-11, atol=1e-13, err_msg=name)


@pytest.mark.parametrize("method", METHODS)
def test_shapes(method):
    assert extremes(Drives.from_angles(np.zeros((0, 3))), method=method).joint_angle.shape == (0,)
    assert extremes(Drives.from_angles(np.zeros((2, 3, 3))), method=method).joint_angle.shape == (2, 3)
    assert extremes(Drive.from_angles([0.3]), method=method).joint_angle.shape == ()
    assert extremes(drives(5, 2), method=method).harmonics(3).shape == (5, 3)
    assert extremes(drives(5, 2), method=method).harmonics(0).shape == (5, 0)


@pytest.mark.parametrize("method", METHODS)
def test_synchronous_and_straight_drives(method):
    """Equal joint angles with γ + β = 0 turn evenly, to rounding of 2 joints; a straight one exactly."""
    found = extremes(Drives.from_angles([[0.5, 0.5], [0.0, 0.0]]), method=method)
    assert found.speed_fluctuation[0] < 4e-16
    assert np.all(np.isnan(found.phase))
    assert found.speed_fluctuation[1] == found.tau[1] == found.joint_angle[1] == found.max_acceleration[1] == 0.0
    assert found.ratio_max[1] == 1.0


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("joint_angle", [0.001, 20.0, 60.0, 89.0, 89.99])
def test_single_joint_in_closed_form(method, joint_angle):
    """δ = sin α tan α with the rounding of α itself near the right angle."""
    alpha = np.deg2rad(joint_angle)
    found = extremes(Drives.from_angles([[alpha]], start_phase=[0.25]), method=method)
    rtol = 4e-15 / np.cos(alpha)
    np.testing.assert_allclose(found.speed_fluctuation, np.sin(alpha) * np.tan(alpha), rtol=rtol)
    np.testing.assert_allclose(found.ratio_max, 1 / np.cos(alpha), rtol=rtol)
    np.testing.assert_allclose(found.joint_angle, alpha, rtol=1e-14)
    np.testing.assert_allclose(found.phase, 0.25, rtol=1e-14)


def test_results_go_into_given_arrays():
    batch, other = drives(77, 3), drives(77, 3, seed=2)
    found = extremes(other, method=Compiled())
    again = extremes(batch, out=found, method=Compiled())
    assert all(np.shares_memory(getattr(again, name), getattr(found, name)) for name in NAMES)
    np.testing.assert_array_equal(again.tau, extremes(batch, method=Compiled()).tau)
    with pytest.raises(InputError) as caught:
        extremes(batch, out=replace(found, tau=np.zeros(76)))
    assert caught.value.field == "out.tau"


def test_large_jobs_are_compiled_and_small_ones_are_not(monkeypatch):
    used = []
    monkeypatch.setattr(module, "_plain", lambda *job: used.append("plain"))
    monkeypatch.setattr(module, "_compiled", lambda *job, threads: used.append("compiled"))
    extremes(drives(LARGE - 1, 1))
    extremes(drives(LARGE, 1))
    assert used == ["plain", "compiled"]


def test_without_numba_everything_still_works(monkeypatch):
    monkeypatch.setattr(method, "has_numba", lambda: False)
    assert np.all(extremes(drives(LARGE, 1)).speed_fluctuation > 0.0)


def test_other_libraries_compute_it_themselves():
    xp = array_api_strict
    other = Drives.from_angles(xp.asarray([[0.3, 0.2]]))
    found = extremes(other)
    assert found.tau.__array_namespace__() is xp
    np.testing.assert_allclose(np.asarray(found.harmonics(2)), [[found.tau[0], found.tau[0] ** 2 / 2]], rtol=1e-15)
    np.testing.assert_allclose(
        np.asarray(found.speed_fluctuation), extremes(Drives.from_angles([[0.3, 0.2]])).speed_fluctuation, rtol=1e-14
    )


def test_a_single_drive_has_harmonics():
    single = Drive.from_angles([0.3])
    np.testing.assert_allclose(extremes(single).harmonics(3), equivalent_joint(single).harmonics(3), rtol=1e-14)
