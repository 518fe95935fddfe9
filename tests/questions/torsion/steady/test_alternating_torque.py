"""The quick answer of torque swings against the full one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.questions.torsion.model.inputs import Constant, Swinging
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.model.torsional_modes import straight_waves
from cardan.questions.torsion.steady.alternating_torque import torque_swings
from cardan.questions.torsion.steady.steady import periodic_response, steady_orbits
from cardan.questions.torsion.steady.two_frequencies import grouped, side_bands

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


@pytest.mark.parametrize("orders", [(3.3,), (3.3, 1.65), (3.3, 2.2)])
@pytest.mark.parametrize("free", [False, True])
def test_an_order_that_no_turns_hold_has_side_bands(orders: tuple[float, ...], *, free: bool) -> None:
    """As the motion of both frequencies, to first order in that torque; far from what the straight line adds."""
    speeds = np.asarray([28.0, 40.0, 75.0])
    others = tuple(Torque(station=3, law=Swinging(amplitude=0.7, frequency=one, phase=one)) for one in orders)
    bare = replace(LINE, input_speed=None) if free else LINE
    found = torque_swings(replace(bare, torques=(*bare.torques, *others)), speeds).swing
    orbit, _status = steady_orbits(bare, speed=speeds)
    alone = periodic_response(bare, speed=speeds)
    wanted = 0.5 * alone.peak_to_peak
    for base, group in grouped(others):
        band = side_bands(orbit, base, group)
        assert band.found.all()
        wanted = wanted + 0.5 * (band.highest - band.lowest - alone.peak_to_peak)
    added = np.max(wanted - 0.5 * alone.peak_to_peak)
    # the second order, of several torques the tops that never meet, and samples of both phases
    np.testing.assert_allclose(found, wanted, atol=(0.02 if len(orders) == 1 else 0.05) * added)
    waves = sum(np.abs(straight_waves(bare, 3, 0.7, one * speeds).torque) for one in orders)
    assert np.max(np.abs(0.5 * alone.peak_to_peak + waves - wanted) / (wanted - 0.5 * alone.peak_to_peak)) > 0.03


def test_with_backlash_the_straight_line_is_added() -> None:
    loose = replace(LINE, backlash=np.asarray([0.0, 1e-6]))
    other = Torque(station=3, law=Swinging(amplitude=7.0, frequency=3.3))
    waves = straight_waves(loose, 3, 7.0, 3.3 * 40.0)
    both, alone = (
        torque_swings(replace(loose, torques=(*loose.torques, *one)), [40.0]).swing for one in ((other,), ())
    )
    np.testing.assert_allclose((both - alone)[0], np.abs(waves.torque))


def test_standing_still_is_refused_and_a_stop_leaves_the_rest() -> None:
    with pytest.raises(InputError, match="other than 0"):
        torque_swings(LINE, [0.0])
    found = torque_swings(LINE, np.linspace(20.0, 90.0, 600), progress=lambda _share: "stop")
    assert found.found[:512].all()
    assert not found.found[512:].any()
