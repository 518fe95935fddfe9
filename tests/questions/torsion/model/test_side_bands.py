"""Side bands of torques with the joints in modes, the Campbell diagram and the check, against the exact motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import torsion_response
from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.drive.drive import Drive
from cardan.questions.torsion.absorber.band import excited
from cardan.questions.torsion.model.answer import answer
from cardan.questions.torsion.model.figure import campbell_figure
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.units import rpm
from tests.questions.torsion.steady.test_torsion_response import three_joints


def shaken(amplitude: float = 5.0) -> Drive:
    bare = three_joints()
    (torque,) = bare.duty.torques
    return replace(bare, duty=replace(bare.duty, torques=(replace(torque, amplitude=amplitude),)))


@pytest.mark.slow
def test_where_a_side_band_meets_a_mode_and_how_strongly() -> None:
    """|ν - 2| = 1.315 and |ν + 2| = 5.315 at mode 1; their torques are those of the motion of both frequencies."""
    drive = shaken()
    found = torsion_modes(drive)
    sides = [one for one in found.crossings if one.torque is not None and one.mode == 1 and one.order < 6.0]
    assert [round(one.order, 6) for one in sides] == [5.315, 1.315]
    for one in sides:
        assert one.speed == pytest.approx(found.omega[0] / one.order)
        exact = dict(
            (round(order, 3), torque) for order, torque in torsion_response(drive, speed=one.speed).side_orders(0.0)
        )
        assert one.torque == pytest.approx(exact[round(one.order, 3)], rel=0.01)
        assert one.share == pytest.approx(one.torque / 5.0)


def test_a_straight_drive_has_none_and_double_the_torque_makes_double() -> None:
    straight = replace(shaken(), joints=tuple(replace(one, joint_angle=1e-3) for one in shaken().joints))
    assert all(one.torque is None for one in torsion_modes(straight).crossings)
    one, two = ([c for c in torsion_modes(shaken(a)).crossings if c.torque is not None] for a in (5.0, 10.0))
    np.testing.assert_allclose([c.torque for c in two], [2.0 * c.torque for c in one])


def test_every_surface_names_them() -> None:
    drive = shaken(300.0)
    found = torsion_modes(drive)
    said = answer(drive, found)
    table = next(one for one in said.tables if any(str(c.heading) == "excited by" for c in one.columns))
    assert any("side band -2 of order 3.315 with the joints" in str(one) for one in table.columns[-1].values)
    rows = data(said, USUAL)["crossings"]
    assert any(row["order"] == pytest.approx(1.315) and row["side_band_torque_Nm"] > 100.0 for row in rows)
    words = [
        told(one.text, USUAL)
        for one in campbell_figure(found).rows[0].panels[0].series
        if hasattr(one, "x") and one.text
    ]
    assert any(one.startswith("order 1.315, side band: ±") for one in words)
    assert excited(drive, drive.duty) == pytest.approx((1.315, 2.0, 3.315, 4.0, 5.315))


def test_the_check_keeps_its_distance_from_them() -> None:
    """At 840 rpm nothing else is near: the side band of order 1.315 meets mode 1 at 834."""
    drive = shaken(300.0)
    drive = replace(drive, duty=replace(drive.duty, speed=840 * rpm))
    (found,) = [one for one in check(drive, only=["torsional_resonance"]) if one.sense == "outside"]
    assert not found.passed
    assert "order 1.315 (side band -2 of order 3.315 with the joints) meets mode 1" in told(found.note, USUAL)
