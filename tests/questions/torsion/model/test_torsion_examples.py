"""What the comments of the shipped examples say of their torsional vibration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import example, stability, torsion_modes, torsion_response
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.units import rpm


@pytest.mark.slow
def test_the_truck_swings_at_12_6_hz_and_its_yokes_decide_how_far() -> None:
    drive, even = example("truck-power-unit"), example("truck-exact-yokes")
    found = torsion_modes(drive)
    assert found.omega[0] / (2 * np.pi) == pytest.approx(12.6, abs=0.05)
    assert found.order2_speed[0] / rpm == pytest.approx(378, abs=0.5)
    assert found.parametric_speed[0] / rpm == pytest.approx(757, abs=0.5)
    assert found.growth_rate[0] > 0.0
    swing = torsion_response(drive)
    assert np.max(swing.swing) == pytest.approx(1300, rel=0.01)
    assert swing.apart[0].order == pytest.approx(6.8)
    shafts = tuple(
        replace(one, yoke_angle=other.yoke_angle) if 1 < one.number < 5 else one
        for one, other in zip(drive.shafts, even.shafts, strict=True)
    )
    cured = replace(drive, shafts=shafts)
    assert np.max(torsion_response(cured).swing) == pytest.approx(14, abs=0.5)
    assert torsion_modes(cured).growth_rate[0] < 0.0


@pytest.mark.slow
def test_the_engineering_formula_gives_the_size_of_the_swing() -> None:
    """Book (246): 4 c s/(a - 4), s = δ/4 of the whole drive; massless joints, one mode."""
    drive = example("truck-power-unit")
    found = torsion_modes(drive)
    stiffness = 1.0 / np.sum(1.0 / found.train.model.stiffness)
    a = (found.omega[0] / (860 * rpm)) ** 2
    assert 4 * stiffness * 0.12512 / 4 / (4 - a) == pytest.approx(np.max(torsion_response(drive).swing), rel=0.02)


@pytest.mark.slow
def test_the_flywheel_lifts_off_at_small_loads() -> None:
    drive = example("pto-flywheel")
    assert torsion_modes(drive).order2_speed[0] / rpm == pytest.approx(307, abs=0.5)
    assert torsion_response(drive).torque_lowest[0] > 0.0
    assert torsion_response(drive, replace(drive.duty, torque=100.0)).torque_lowest[0] < 0.0


@pytest.mark.slow
def test_the_stand_is_cured_by_putting_its_joint_into_the_node() -> None:
    sick, cured = example("unstable-drive"), example("cured-drive")
    one, other = torsion_modes(sick), torsion_modes(cured)
    assert one.joint_weight[0, 0] == pytest.approx(0.60, abs=0.005)
    assert abs(other.joint_weight[0, 0]) < 1e-4
    assert one.omega[0] == pytest.approx(other.omega[0], rel=1e-3)
    assert stability(sick).verdict == Verdict.UNSTABLE
    assert np.log(10.0) / float(stability(sick).growth_rate) < 2.0
    assert stability(cured).verdict == Verdict.STABLE
