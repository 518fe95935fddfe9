"""Growth of vibration against Floquet's multipliers, and drift of the mean speed apart from it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cardan import example
from cardan.questions.torsion.model.torsional_model import torsional_line
from cardan.questions.torsion.stability.stability_kernel import vibration_growth
from cardan.questions.torsion.steady.alternating_torque import torque_swings
from cardan.questions.torsion.steady.run_stability import floquet
from cardan.questions.torsion.steady.torsion_response import loaded_model
from cardan.units import rpm

LINE = torsional_line(
    [[1.0, 0.02], [0.03, 0.4]],
    stiffness=[[4000.0], [6000.0]],
    damping=[[0.3], [0.3]],
    joint_angle=[0.4],
    input_speed=30.0,
)


def test_the_largest_multiplier_compiled_and_plain() -> None:
    few, many = np.linspace(60.0, 75.0, 6), np.linspace(60.0, 75.0, 201)
    for speed in (few, many):
        orbit = torque_swings(LINE, speed).orbit
        rows = np.arange(len(speed))[::-5][::-1]
        radius = np.exp(vibration_growth(orbit, rows))
        np.testing.assert_allclose(radius, floquet(orbit).spectral_radius[rows], rtol=1e-6)
    assert np.max(radius) > 1.0 > np.min(radius)


def test_backward_turning_and_backlash() -> None:
    for drives in (LINE, replace(LINE, backlash=np.asarray([0.0, 0.01]))):
        orbit = torque_swings(drives, [-33.0, 33.0][: 1 if np.any(drives.backlash) else 2]).orbit
        rows = np.arange(orbit.count)
        np.testing.assert_allclose(np.exp(vibration_growth(orbit, rows)), floquet(orbit).spectral_radius, rtol=1e-6)


def test_drift_of_the_mean_speed_is_no_vibration() -> None:
    """Above a resonance losses fall with the speed: under a constant torque the speed runs away, slowly."""
    stand = example("unstable-drive")
    speed = np.asarray([720.0, 800.0, 1340.0]) * rpm
    model = loaded_model(stand, stand.duty, speed)[1]
    dragged = replace(model, ground_damping=model.ground_damping + 1e-12)  # something changes with the speed
    running = floquet(torque_swings(dragged, speed).orbit)
    orbit = torque_swings(model, speed).orbit
    drift, grown = np.log(running.spectral_radius), vibration_growth(orbit, np.arange(3))
    assert running.removed.tolist() == [1, 1, 1]
    assert np.all(drift > 1e-4)
    assert np.all(grown[:2] < 0.0)
    np.testing.assert_allclose(grown[2], drift[2], rtol=1e-6)
    judged = floquet(orbit)
    assert judged.removed.tolist() == [2, 2, 2]
    assert judged.stable.tolist() == [True, True, False]
    np.testing.assert_allclose(np.log(judged.spectral_radius), grown, rtol=1e-6)


def test_what_was_not_found_is_not_known() -> None:
    found = torque_swings(LINE, np.linspace(20.0, 90.0, 600), progress=lambda _share: "stop")
    assert np.isnan(vibration_growth(found.orbit, np.asarray([10, 599]))).tolist() == [False, True]
