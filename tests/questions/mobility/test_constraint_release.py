from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive, example
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.io import example_mechanism, mechanism_names
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.questions.mobility.constraint_release import advice, repaired, repairs, working
from cardan.questions.mobility.drive_mechanism import mechanism_of
from cardan.questions.mobility.finite_mobility import finite_mobility
from cardan.questions.mobility.mobility import mobility
from tests.builders.mechanisms import anyhow, crank_slider, hooke


def keeps_its_word(mechanism, repair):
    before, after = mobility(mechanism), mobility(repaired(mechanism, repair))
    assert (before.redundant, after.redundant) == (repair.before, repair.after)
    assert after.mobility == before.mobility


LEFT = {"weiss-straight": 1, "slot-cam": 4, "disc-integrator": 1}
"""What balls, screws and rolling contacts hold too often, whatever the bearings let go."""


@pytest.mark.slow
@pytest.mark.parametrize("name", mechanism_names())
def test_repairs_of_the_examples_keep_their_word(name):
    mechanism = example_mechanism(name)
    found = repairs(mechanism)
    assert bool(found) == (mobility(mechanism).redundant > 0)
    assert all(one.after == LEFT.get(name, 0) for one in found)
    for one in found[:2]:
        keeps_its_word(mechanism, one)
    assert [one.trouble for one in found] == sorted(one.trouble for one in found)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_repairs_of_random_mechanisms_keep_their_word(seed):
    rng = np.random.default_rng(seed)
    mechanism = anyhow(rng, links=3, loops=3)
    for one in repairs(mechanism, most=2):
        keeps_its_word(mechanism, one)


def test_the_simplest_repair_of_a_hooke_joint_is_the_books_second():
    best = repairs(hooke())[0]
    assert [(one.joint, one.after) for one in best.changes] == [("D", "SG")]
    assert advice(best.changes[0], hooke()) == "make the bearing of 3, D, self-aligning and axially free"


def test_the_sound_repair_of_the_crank_slider_is_among_them():
    sets = [{(one.joint, one.after) for one in repair.changes} for repair in repairs(crank_slider(), most=40)]
    assert {("1-2", "S"), ("2-3", "C")} in sets
    assert {("2-3", "S"), ("3-0", "C")} not in sets  # a ball at the piston with a slide in the guide fails
    assert {("1-2", "S"), ("2-3", "S")} not in sets  # two balls let the rod spin


def test_one_change_cures_the_maize_harvester():
    found = repairs(example_mechanism("maize-drive"))
    assert [len(one.changes) for one in found] == [1] * 5


@pytest.mark.parametrize("joint", ["sleeve hinge", "shackle hinge"])
def test_the_link_of_the_book_cures_the_maize_harvester(joint):
    """Link 11 between sleeve and shackle, or between shackle and frame: one link and one hinge more, Book p. 78."""
    mechanism = example_mechanism("maize-drive-offset")
    (added,) = [
        one for one in repairs(mechanism, most=12) if [(c.joint, c.gain) for c in one.changes] == [(joint, "link")]
    ]
    made = repaired(mechanism, added)
    assert (len(made.links), len(made.joints)) == (len(mechanism.links) + 1, len(mechanism.joints) + 1)
    keeps_its_word(mechanism, added)
    assert finite_mobility(made).closes
    hinges = [pair.along for pair in made.joints if joint in pair.id]
    assert abs(hinges[0] @ hinges[1]) < 1e-12


def test_a_drive_gets_no_links():
    drive = example("overconstrained-pump")
    assert all(change.gain != "link" for one in repairs(drive, most=20) for change in one.changes)


def test_where_no_bearing_cures_all_the_best_part_is_told():
    # Two hinges and a slide between the same links: with only the slide to change, one may still turn.
    mechanism = anyhow(np.random.default_rng(5), links=2, loops=6)
    for one in repairs(mechanism):
        keeps_its_word(mechanism, one)


def test_many_firm_bearings_are_thinned_out_to_just_enough():
    firm = {"radial": True, "axial": True, "tilt": True}
    ends = [(1, -0.2), (1, -0.1), (2, 0.1), (2, 0.2), (3, 0.1), (3, 0.2)]
    drive = replace(
        Drive.from_angles([0.2, 0.2], plane_twists=[0.3]),
        shafts=(Shaft(number=2, length=0.5),),
        supports=tuple(Support(shaft=shaft, position=place, **firm) for shaft, place in ends),
    )
    (best, *_others) = repairs(drive)
    assert (best.before, best.after) == (21, 0)
    keeps_its_word(mechanism_of(drive), best)


def test_the_name_of_a_link_is_told_once():
    mechanism = example_mechanism("three-joints-e")
    assert advice(repairs(mechanism)[0].changes[0], mechanism) == "make bearing of shaft 3 self-aligning"


def test_nothing_to_repair_is_nothing():
    assert repairs(hooke(kinds="RRRSG")) == ()


@pytest.mark.slow
def test_only_changes_with_which_it_turns_all_round_are_told():
    mechanism = example_mechanism("maize-drive-offset")
    tried, found = repairs(mechanism, most=12), working(mechanism, most=12)
    assert found
    assert set(found) < set(tried)
    for one in tried:
        moved = finite_mobility(repaired(mechanism, one))
        assert moved.closes == (one in found)


def parallelogram(reach):
    """Return a parallelogram with a third crank, whose bearing stands ``reach`` from the first."""
    ends = {"1": (0.0, 0.0), "3": (0.3, 0.0), "4": (reach, 0.0)}
    hinges = [
        Pair(
            id=f"{link}{end}", type="R", links=(link, end), point=(x + rise, y + 2.0 * rise, 0.0), axis=(0.0, 0.0, 1.0)
        )
        for link, (x, y) in ends.items()
        for end, rise in (("0", 0.0), ("2", 0.05))
    ]
    wrong = [replace(one, point=(0.13, 0.0, 0.0)) if one.id == "40" else one for one in hinges]
    return Mechanism(frame="0", input_link="1", joints=tuple(wrong))


def test_no_change_of_a_bearing_frees_a_parallelogram_with_a_wrong_link():
    mechanism = parallelogram(0.12)
    assert repairs(mechanism)
    assert working(mechanism) == ()
