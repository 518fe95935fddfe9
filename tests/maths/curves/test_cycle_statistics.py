"""Extremes and harmonics of a turn against dense sampling."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import Drive, InputError, forces
from cardan.drive.duty import Duty
from cardan.drive.support import Support
from cardan.maths.curves.cycle_statistics import harmonics, over_turn
from cardan.units import deg

TURN = np.linspace(0.0, 2 * np.pi, 361)
DENSE = np.arange(200 * 360) * (np.pi / 36000)


def drive() -> Drive:
    from dataclasses import replace

    bare = Drive.from_points([(-0.4, 0, 0), (0, 0, 0), (0.7, 0.25, 0.1), (1.1, 0.25, 0.1)], yoke_angles=[0.5])
    held = (
        Support(shaft=1, position=-0.3, axial=True),
        Support(shaft=1, position=-0.1),
        Support(shaft=3, position=0.1),
        Support(shaft=3, position=0.3),
    )
    return replace(bare, supports=held, duty=Duty(torque=150.0))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["shaft_torque", "bending_couple", "radial", "axial"])
def test_extremes_and_means_are_those_of_dense_samples(name: str) -> None:
    coarse = over_turn(TURN, getattr(forces(drive(), angle=TURN), name))
    dense = getattr(forces(drive(), angle=DENSE), name)
    swing = dense.max(axis=-1) - dense.min(axis=-1) + 1e-6
    # a step of 0.005° misses a smooth extreme by the square of 4e-5 rad
    np.testing.assert_array_less(np.abs(coarse.high - dense.max(axis=-1)) / swing, 1e-7)
    if name in ("shaft_torque", "axial"):
        np.testing.assert_array_less(np.abs(coarse.low - dense.min(axis=-1)) / swing, 1e-7)
    np.testing.assert_allclose(coarse.rms, np.sqrt(np.mean(dense**2, axis=-1)), rtol=1e-6, atol=1e-9)
    at = forces(drive(), angle=coarse.high_angle)
    np.testing.assert_allclose(np.diagonal(getattr(at, name)), coarse.high, rtol=1e-7, atol=1e-7)


def test_a_curve_with_a_corner_keeps_its_samples() -> None:
    # its corner lies on a sample: nothing above it may be made up
    turn = over_turn(TURN, np.abs(np.sin(TURN)))
    assert turn.low == pytest.approx(0.0, abs=1e-15)
    steps = (np.pi > TURN).astype(float)
    assert over_turn(TURN, steps).high == 1.0


def test_harmonics_give_the_curve_back() -> None:
    torque = forces(Drive.from_angles([20 * deg]), Duty(torque=100.0), TURN).input_torque
    found = harmonics(TURN, torque, count=60)
    back = sum(a * np.cos(k * TURN + p) for k, a, p in zip(found.order, found.amplitude, found.phase, strict=True))
    np.testing.assert_allclose(back, torque, atol=1e-10)
    odd = found.amplitude[1::2]
    assert odd.max() < 1e-10
    ratio = np.tan(10 * deg) ** 2
    # M_1 = M_2 (1 + 2 Σ τ^k cos 2kφ): the series of the speed ratio
    np.testing.assert_allclose(found.amplitude[2:10:2], 200 * ratio ** np.arange(1, 5), rtol=1e-9)


def test_a_phase_counts_from_zero_wherever_the_turn_begins() -> None:
    late = TURN + 1.0
    found = harmonics(late, 2.0 * np.cos(3 * late + 0.4), count=5)
    assert found.amplitude[3] == pytest.approx(2.0)
    assert found.phase[3] == pytest.approx(0.4)


@pytest.mark.parametrize("angle", [[0.0, 1.0], np.linspace(0, 3, 50), np.linspace(0, 2 * np.pi, 6)])
def test_angles_that_are_no_turn_are_refused(angle: object) -> None:
    with pytest.raises(InputError, match="do not divide one turn"):
        over_turn(np.asarray(angle), np.asarray(angle))


def test_orders_and_extremes_of_two_turns_count_in_turns_of_the_input() -> None:
    """A torque that repeats in two turns: order 2 is order 2, and the top of the second turn counts."""
    phi = np.linspace(0.0, 4 * np.pi, 721)
    values = 5.0 + 2.0 * np.cos(0.5 * phi - 0.9 * np.pi) + 0.7 * np.cos(2.0 * phi + 0.3)
    found = harmonics(phi, values)
    np.testing.assert_allclose(found.amplitude[:4], [5.0, 0.0, 0.7, 0.0], atol=1e-12)
    assert found.phase[2] == pytest.approx(0.3)
    dense = np.linspace(0.0, 4 * np.pi, 400_001)
    curve = 5.0 + 2.0 * np.cos(0.5 * dense - 0.9 * np.pi) + 0.7 * np.cos(2.0 * dense + 0.3)
    turn = over_turn(phi, values)
    assert turn.high == pytest.approx(curve.max(), rel=1e-9)
    # a step of 3e-5 rad on a top whose bend is of order 3
    assert turn.high_angle == pytest.approx(dense[np.argmax(curve)], abs=1e-4)
    assert turn.mean == pytest.approx(5.0)
