"""Modes, the check, the response and stability say the same of parametric resonance, of one drive at one speed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, example, stability, torsion_response
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station, ToNext
from cardan.questions.torsion.answer import answer, ask
from cardan.questions.torsion.model.answer import modes_said
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.stability.torsion_stability import proved_in_use
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.units import rpm
from tests.questions.torsion.steady.test_torsion_response import three_joints
from tests.questions.torsion.transient.test_springs import TORQUES, TWISTS

STANDS = ("unstable-drive", "cured-drive", "pto-flywheel", "truck-power-unit")


def combined():
    """Return a drive that runs amid the sum of its modes 1 and 2, which no zone of a single mode tells."""
    bare = three_joints()
    shafts = tuple(replace(one, damping=0.15) for one in bare.shafts)
    duty = replace(bare.duty, torques=(), speed=None, speed_range=(3000 * rpm, 3300 * rpm))
    return replace(bare, shafts=shafts, duty=duty)


def of(drive):
    (found,) = check(drive, only=["parametric_stability"])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", STANDS)
@pytest.mark.parametrize("share", [1.0, 0.5, 1.012])
def test_one_speed(name, share):
    """As shipped, on the resonance of order 2, and beside: pto-flywheel runs at 540 rpm and its mode is at 614."""
    drive = example(name)
    duty = replace(drive.duty, speed=share * drive.duty.speed, speed_range=None, run_up=None)
    drive = replace(drive, duty=duty)
    grows = bool(stability(drive).verdict == Verdict.UNSTABLE)
    assert bool(torsion_response(drive).floquet.verdict == Verdict.UNSTABLE) is grows
    assert (of(drive).state == "failed") is grows
    exact = proved_in_use(drive)
    tone, said = modes_said(drive, torsion_modes(drive), exact=exact)
    assert (tone == "failed") is grows
    assert ("unstable in the operating range" in told(said, USUAL)) is grows
    assert bool(len(exact.overlapping(duty.speed, duty.speed))) is grows


@pytest.mark.slow
def test_the_nearest_of_two_zones_is_named_by_all():
    """From 700 to 1,290 rpm the zone at 1,321 is nearer than that at 669, which grows faster."""
    drive = example("unstable-drive")
    drive = replace(drive, duty=replace(drive.duty, speed=1000 * rpm, speed_range=(700 * rpm, 1290 * rpm)))
    assert "unstable from 1 320.9 to 1 358.7 rpm" in told(of(drive).note, USUAL).replace("\u202f", " ")
    tone, said = modes_said(drive, torsion_modes(drive), exact=proved_in_use(drive))
    assert tone == "warning"
    assert "from 1 320.9 to 1 358.7 rpm, near the operating range" in told(said, USUAL).replace("\u202f", " ")


@pytest.mark.slow
def test_a_sum_of_two_modes_is_seen_by_all():
    drive = combined()
    found = torsion_modes(drive)
    assert modes_said(drive, found)[0] != "failed"  # by zones of first order
    proof = stability(drive, over={"duty.speed_rpm": np.linspace(3000.0, 3300.0, 4)}).proof
    assert proof.proved
    assert [proof.zone.name((k,)) for k in range(len(proof.lowest))] == ["sum of modes 1 and 2"]
    exact = proved_in_use(drive)
    np.testing.assert_allclose(exact.lowest, proof.lowest, rtol=1e-6)
    np.testing.assert_allclose(exact.highest, proof.highest, rtol=1e-6)
    whole = answer(drive, ask(drive))
    assert whole.tone == "failed"
    assert "unstable in the operating range" in told(whole.sentence, USUAL)
    assert any(one.alarm and "sum of modes 1 and 2" in told(one.text, USUAL) for one in whole.remarks)
    failed = of(drive)
    assert failed.state == "failed"
    assert "sum of modes 1 and 2" in told(failed.note, USUAL)
    # with the damping that the check asks for it is stable
    factor = 1.1 * float(failed.limit / failed.value)
    damped = replace(drive, shafts=tuple(replace(one, damping=factor * one.damping) for one in drive.shafts))
    assert proved_in_use(damped).stable
    assert of(damped).state == "passed"
    assert modes_said(damped, torsion_modes(damped), exact=proved_in_use(damped))[0] != "failed"


def sprung() -> Drive:
    """Return a drive whose part twists by a table, with structural damping alone."""
    part = ToNext(twists=TWISTS, torques=TORQUES, loss_factor=0.03)
    return replace(
        Drive.from_angles([math.radians(25.0)]),
        shafts=(Shaft(number=1),),
        stations=(
            Station(shaft=1, end="start", inertia=1.0, to_next=part),
            Station(shaft=1, end="end", inertia=0.05),
            Station(shaft=2, inertia=0.4),
        ),
        duty=Duty(speed=60.0, torque=80.0),
    )


@pytest.mark.slow
def test_of_springs_by_a_table_one_motion_is_judged_by_all() -> None:
    """Its swing shifts the stiffness, so of another motion the multipliers are others, and near an edge the verdict."""
    drive = sprung()
    speeds = np.linspace(30.0, 75.0, 10)
    response = torsion_response(drive, speed=speeds)
    told_by_map = stability(drive, over={"duty.speed_rad_s": speeds})
    assert response.floquet.verdict.tolist() == told_by_map.verdict.tolist()
    assert {Verdict.STABLE, Verdict.UNSTABLE} <= set(told_by_map.verdict.tolist())
    known = np.isfinite(told_by_map.spectral_radius)
    np.testing.assert_allclose(told_by_map.spectral_radius[known], response.floquet.spectral_radius[known], rtol=1e-6)
