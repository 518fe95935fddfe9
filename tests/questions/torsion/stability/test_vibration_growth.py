"""Growth of vibration against Floquet's multipliers, and drift of the mean speed apart from it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import example
from cardan.io import loads
from cardan.questions.torsion.absorber.band import lines
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.model.torsional_model import torsional_line
from cardan.questions.torsion.stability.proved_speeds import proved_speeds
from cardan.questions.torsion.stability.stability_kernel import vibration_growth
from cardan.questions.torsion.steady.alternating_torque import torque_swings
from cardan.questions.torsion.steady.run_stability import floquet
from cardan.questions.torsion.steady.torsion_response import loaded_model
from cardan.units import rpm
from tests.questions.torsion.stability.test_answer import FREE_TRIPOD

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


@pytest.mark.parametrize("yoke_angle", [25.0, -43.437, 60.0, 110.0])
def test_a_resonance_is_not_taken_for_the_drift(yoke_angle: float) -> None:
    """Two multipliers above 1 where the torque falls: that of the zone is Mathieu's, ω(m/2 - ζ) T."""
    drive = loads(FREE_TRIPOD.replace("SPEED", "1910").replace("= 25,", f"= {yoke_angle},"))
    speed = 1910.0 * rpm
    found = lines([drive], speed).swings(np.asarray([[speed]]))
    modes = torsion_modes(drive, drive.duty)
    by_hand = float(modes.omega[0] * (0.5 * modes.modulation[0] - modes.damping_ratio[0])) * 2.0 * np.pi / speed
    assert by_hand > 0.02
    assert vibration_growth(found.orbit, np.zeros(1, dtype=int))[0] == pytest.approx(by_hand, rel=0.04)
    assert floquet(found.orbit).spectral_radius.item() == pytest.approx(np.exp(by_hand), rel=2e-3)

    def build(speeds):
        return loaded_model(drive, drive.duty, speeds)[1]

    assert not proved_speeds(build, 1909.0 * rpm, 1911.0 * rpm).stable


@pytest.mark.parametrize(
    ("loss", "yoke_angle", "grows"),
    [(0.005, 60.0, True), (0.005, 110.0, True), (0.005, 150.0, True), (0.02, 25.0, False), (0.02, 150.0, False)],
)
def test_a_drift_hardly_off_1_is_the_drift_on_either_side(loss: float, yoke_angle: float, grows: bool) -> None:
    """With structural damping the slope of the torque and the side of 1 need not agree: a zone was told stable."""
    text = FREE_TRIPOD.replace("damping_Nms_per_rad = 0.3", f"loss_factor = {loss}").replace("SPEED", "1910")
    drive = loads(text.replace("angle_deg = 20,", "angle_deg = 8,").replace("= 25,", f"= {yoke_angle},"))
    speed = np.asarray([[1910.0 * rpm]])
    found = floquet(lines([drive], speed.item()).swings(speed).orbit)
    assert (found.spectral_radius.item() > 1.03) is grows
    assert (found.spectral_radius.item() < 0.995) is not grows
