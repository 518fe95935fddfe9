"""The quick answer of torque swings against the full one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.questions.torsion.model.inputs import Constant, Swinging
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.model.torsional_modes import straight_waves
from cardan.questions.torsion.steady.alternating_torque import some_motions, torque_swings
from cardan.questions.torsion.steady.run_stability import floquet
from cardan.questions.torsion.steady.steady import periodic_response

LINE = torsional_line(
    [[1.0, 0.02], [0.03, 0.4]],
    stiffness=[[4000.0], [6000.0]],
    damping=[[1.0], [1.0]],
    joint_angle=[0.4],
    torques=[Torque(station=3, law=Constant(value=-60.0))],
    input_speed=30.0,
)
SPEEDS = np.asarray([[20.0, 31.0, -31.0], [48.0, 61.0, 95.0]])


def test_it_is_what_the_full_answer_says() -> None:
    found, wanted = torque_swings(LINE, SPEEDS), periodic_response(LINE, speed=SPEEDS)
    np.testing.assert_allclose(found.swing, 0.5 * wanted.peak_to_peak, rtol=1e-5)
    assert found.found.all()


def test_free_drives_and_half_orders_too() -> None:
    halves = Torque(station=0, law=Swinging(amplitude=5.0, frequency=1.5, phase=0.3))
    free = replace(LINE, input_speed=None, torques=(*LINE.torques, halves))
    found, wanted = torque_swings(free, [25.0, 70.0]), periodic_response(free, speed=[25.0, 70.0])
    np.testing.assert_allclose(found.swing, 0.5 * wanted.peak_to_peak, rtol=1e-5)


def test_backlash_goes_the_full_way() -> None:
    loose = replace(LINE, backlash=np.asarray([0.0, 0.002]))
    found, wanted = torque_swings(loose, [33.0]), periodic_response(loose, speed=[33.0])
    np.testing.assert_allclose(found.swing, 0.5 * wanted.peak_to_peak)


def test_an_order_that_no_turns_hold_is_added() -> None:
    other = Torque(station=3, law=Swinging(amplitude=7.0, frequency=3.3))
    more = replace(LINE, torques=(*LINE.torques, other))
    waves = straight_waves(LINE, 3, 7.0, 3.3 * 40.0)
    difference = torque_swings(more, [40.0]).swing - torque_swings(LINE, [40.0]).swing
    np.testing.assert_allclose(difference[0], np.abs(waves.torque))


def test_some_of_the_motions_keep_their_stability() -> None:
    found = torque_swings(LINE, SPEEDS)
    whole, part = floquet(found.orbit), floquet(some_motions(found.orbit, np.asarray([4, 1])))
    np.testing.assert_allclose(part.spectral_radius, whole.spectral_radius.reshape(-1)[[4, 1]], rtol=1e-9)


def test_standing_still_is_refused_and_a_stop_leaves_the_rest() -> None:
    with pytest.raises(InputError, match="other than 0"):
        torque_swings(LINE, [0.0])
    found = torque_swings(LINE, np.linspace(20.0, 90.0, 600), progress=lambda _share: "stop")
    assert found.found[:512].all()
    assert not found.found[512:].any()
