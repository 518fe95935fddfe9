"""Layouts of bearings of a drive: each is mobile once and held just enough, all round; Book p. 74-79."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from cardan import Drive, assembly, example
from cardan.choices.bearing_layouts import (
    ALIKE,
    bearing_layouts,
    is_regular,
    with_layout,
)
from cardan.choices.bearing_layouts_answer import answer, ask, otherwise, spelled
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.joints import OffsetCross
from cardan.mechanism.layouts import Layout
from cardan.questions.forces.forces import forces
from cardan.questions.mobility.drive_mechanism import mechanism_of
from cardan.questions.mobility.finite_mobility import mobility_over_turn
from cardan.questions.mobility.mobility import mobility

TWO = replace(
    Drive.from_angles([0.2, 0.3], plane_twists=[0.7]),
    shafts=(Shaft(number=2, length=0.8),),
    duty=Duty(torque=300.0),
)


@pytest.fixture(scope="module")
def found():
    return bearing_layouts(TWO)


@pytest.mark.slow
def test_every_layout_that_is_told_is_held_just_enough_all_round(found):
    assert found.number == found.ranked == 45
    assert found.best
    for one in found.best:
        assert mobility(one.drive).agrees
        around = mobility_over_turn(one.drive, positions=6)
        assert around.turns
        assert (set(around.mobility), set(around.redundant)) == ({1}, {0})


@pytest.mark.slow
def test_statics_agrees_that_the_forces_are_determinate(found):
    """Another formulation: unknown forces less equations of balance."""
    assert [assembly(one.drive).degree for one in found.best] == [0] * len(found.best)


@pytest.mark.slow
def test_the_best_come_first(found):
    assert {one.speed_fluctuation for one in found.best} == {found.best[0].speed_fluctuation}
    known = [one.force for one in found.best]
    own = np.asarray(forces(found.best[0].drive, angle=np.linspace(0.0, 2.0 * np.pi, 361)).reaction)
    assert known[0] == pytest.approx(float(np.linalg.norm(own, axis=-1).max()), rel=1e-3)
    assert all(after >= before / ALIKE for before, after in pairwise(known))


@pytest.mark.slow
def test_other_joints_make_it_even():
    even = bearing_layouts(TWO, other_joints=True)
    assert even.number == 372
    assert even.best[0].speed_fluctuation == 0.0
    assert {joint.kind for joint in even.best[0].drive.joints} <= {"tripod", "tracta", "constant_velocity"}


@pytest.mark.slow
def test_the_half_shaft_is_held_as_cars_have_it():
    """Tripod at the gearbox, ball joint at the wheel, both ends in their bearings, none between.

    By the number of parts; forces alone would set a wheel bearing apart into two.
    """
    drive = example("front-halfshaft")
    drive = replace(drive, duty=replace(drive.duty, torque=None))
    shafts = [one.layout.shafts for one in bearing_layouts(drive).best]
    assert shafts[0] == (("R",), ("",), ("R",))


@pytest.mark.parametrize("shafts", [(("R",), ("SG",), ("", ""), ("R",)), (("R",), ("", ""), ("R",), ("SG",))])
def test_the_three_joint_drives_of_the_book_hold_just_enough(shafts):
    """Fig. 47 a and b; the same as the mechanisms shipped."""
    drive = Drive.from_angles([0.2, 0.3, 0.25], plane_twists=[0.7, -0.4])
    held = with_layout(drive, Layout(joints=(2, 2, 2), shafts=shafts), (2, 2, 2))
    assert is_regular(held)
    assert mechanism_of(held).formula == 1


def test_two_slides_in_line_are_seen_by_the_rank_alone():
    drive = Drive.from_angles([0.4])
    held = with_layout(drive, Layout(joints=(2,), shafts=(("R", ""), ("", "C"))), (2,))
    assert mechanism_of(held).formula == 1
    assert not is_regular(held)


def test_bearings_stand_where_the_drive_has_some():
    drive = replace(TWO, supports=(Support(shaft=3, position=0.35),))
    held = with_layout(drive, Layout(joints=(2, 2), shafts=(("R",), ("", ""), ("R",))), (2, 2))
    assert [one.shaft for one in held.supports] == [1, 1, 3, 3]
    held = with_layout(drive, Layout(joints=(2, 2), shafts=(("R",), ("SG",), ("SG",))), (2, 2))
    assert held.supports[-1].position == 0.35


def test_a_joint_with_a_bearing_of_its_own_leaves_no_choice():
    joint = OffsetCross(joint_angle=0.4, offset=0.02, reach=0.3)
    drive = replace(Drive.from_angles([0.4]), joints=(joint,))
    assert ask(drive) is None
    assert "bearing of its own" in otherwise(drive)


def test_what_is_said_has_counts_groups_and_signs(found):
    said = answer(TWO, found)
    assert said.facts["by_graph"] == 45
    assert 23 <= said.facts["up_to_mirror_images"] < 45
    groups = said.tables[-1]
    table = dict(zip(groups.columns[2].values, groups.columns[0].values, strict=True))
    assert table["5-4-5"] == table["5-5-5-5"] == "SG"  # the groups of Book Fig. 47 c and d
    assert all("×" in spelled(one, found.freedoms) for one in found.best)
    assert len(said.figures()[0].panels) == len(found.best) + len(found.best) % 2
