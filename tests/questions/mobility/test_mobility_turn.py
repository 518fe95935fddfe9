import numpy as np
import pytest

from cardan.io import example_mechanism
from cardan.questions.mobility.finite_mobility import mobility_over_turn
from tests.builders.mechanisms import hooke


def test_a_stiff_hooke_joint_binds_at_every_angle():
    found = mobility_over_turn(hooke(), driven_joint="A", positions=12)
    assert found.turns
    assert (found.structural, found.special.size) == (3, 0)
    assert set(found.mobility) == {1}


def test_a_repair_that_fails_in_two_positions_is_found_out():
    # Driving pin sliding, output bearing a ball: fails where the pin stands square to the plane of the shafts.
    found = mobility_over_turn(hooke(0.5, 0.0, kinds="RCRS"), driven_joint="A", positions=8)
    assert found.structural == 0
    assert found.turns
    assert np.degrees(found.special) == pytest.approx([90.0, 270.0])
    assert set(found.mobility - found.redundant) == {1}


@pytest.mark.slow
def test_positions_that_are_not_reached_do_not_count():
    found = mobility_over_turn(example_mechanism("maize-drive-offset"), positions=6)
    assert not found.turns
    assert found.reached.tolist() == [True] + [False] * 5
    assert found.structural == 1


def test_it_can_be_stopped_in_both_halves():
    early = mobility_over_turn(hooke(), driven_joint="A", positions=6, progress=lambda share: "stop")
    late = mobility_over_turn(
        hooke(), driven_joint="A", positions=6, progress=lambda share: "stop" if share > 0.9 else None
    )
    assert early.cancelled
    assert late.cancelled
    assert len(early.position) < len(late.position) < 6
