"""Minus-2 groups, of cardan elements (Book Fig. 48) and branched, in the place of the last bearing of Fig. 47 b."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.mechanism.counting import joins, partition
from cardan.mechanisms import Load, example_mechanism, mechanism_forces, mechanism_motion, mobility_over_turn
from cardan.questions.mobility.mobility import mobility

NAMES = ("three-joints-cardan-rod", "three-joints-three-rods")
TURN = np.radians(np.arange(0.0, 360.0, 30.0))


@pytest.mark.parametrize("name", NAMES)
def test_the_drive_is_held_just_enough_by_rank_and_by_graph(name):
    made = example_mechanism(name)
    held = mobility(made)
    assert (held.formula, held.mobility, held.redundant, held.parasitic, held.local) == (1, 1, 0, 0, 0)
    counted = partition(joins(made), frame="frame", input_link="input shaft")
    assert (counted.mobility, counted.redundant) == (1, 0)
    group = [pair for pair in made.joints if made.joints.index(pair) >= 9]
    links = {link for pair in group for link in pair.links} - {"frame", "output shaft"}
    assert 6 * len(links) - sum(pair.kind.constraints for pair in group) == -2


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_it_turns_all_round_and_as_with_the_bearing(name):
    over = mobility_over_turn(example_mechanism(name), positions=24)
    assert over.turns
    assert set(over.mobility) == {1}
    assert set(over.redundant) == {0}
    found, plain = (mechanism_motion(example_mechanism(one), TURN).output for one in (name, "three-joints-b"))
    np.testing.assert_allclose(found.ratio, plain.ratio, atol=1e-9)  # digits of the files
    np.testing.assert_allclose(found.angle, plain.angle, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "rods"), [(NAMES[0], {"pin of the rod": 1000.0}), (NAMES[1], {"eye 2 on the sleeve": 500.0})]
)
def test_the_rods_carry_what_the_bearing_would(name, rods):
    """A force along z through the axis of the shaft: one rod takes it, or two of them half each."""
    push = Load(link="output shaft", force=(0.0, 0.0, -1000.0), point=(2.0, 0.05, 0.05))
    made = replace(example_mechanism(name), loads=(push,))
    found = mechanism_forces(made, TURN)
    for joint, force in rods.items():
        np.testing.assert_allclose(found.force[:, made.index(joint)], force, rtol=1e-8)
    np.testing.assert_allclose(found.input_torque, 0.0, atol=1e-6)
