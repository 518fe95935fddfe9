"""Groups of shafts whose forces follow from each other: known layouts, and the solution group by group."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import Drive, example
from cardan.drive.cross import Cross
from cardan.drive.joints import Hooke
from cardan.drive.support import Support
from cardan.questions.forces.reactions import reaction_groups, solving_order
from cardan.questions.forces.support_statics import Layout, actions, balance

FULL, SIDE, ALONG = ("radial", "axial"), ("radial",), ("axial",)
RNG = np.random.default_rng(5)

LAYOUTS = {
    "single joint, Fig. 67b": (1, ((0, FULL), (0, SIDE), (1, SIDE)), (), ((2,), (1,))),
    "double joint, Fig. 69": (2, ((0, FULL), (0, SIDE), (2, SIDE), (2, SIDE)), (), ((2, 3), (1,))),
    "double joint with a spline, Fig. 70": (2, ((0, FULL), (0, SIDE), (2, FULL), (2, SIDE)), (1,), ((2,), (3,), (1,))),
    "a bearing on the middle shaft": (2, ((0, FULL), (0, SIDE), (1, SIDE), (2, SIDE)), (), ((3,), (2,), (1,))),
    "four joints": (
        4,
        ((0, FULL), (0, SIDE), (1, SIDE), (3, SIDE), (4, SIDE), (4, SIDE)),
        (),
        ((3, 4, 5), (2,), (1,)),
    ),
    "driven from the middle": (2, ((0, SIDE), (1, FULL), (1, SIDE), (2, SIDE)), (), ((3,), (1,), (2,))),
    "all in one": (2, ((0, SIDE), (0, SIDE), (1, ALONG), (2, SIDE), (2, SIDE)), (), ((1, 2, 3),)),
}


def system(joints, bearings, splines):
    layout = Layout(joints=joints, bearings=bearings, splines=splines)
    axis = np.asarray([1.0, 0.0, 0.0]) + RNG.uniform(-0.3, 0.3, (joints + 1, 3))
    axis /= np.linalg.norm(axis, axis=-1)[:, None]
    return layout, balance(actions(axis, np.ones(joints + 1), layout, RNG.uniform(0.1, 0.9, len(bearings))))


@pytest.mark.parametrize("name", LAYOUTS)
def test_groups_follow_from_each_other(name):
    """Each group's own equations give all that acts on it, once those before are known; together they are the whole."""
    joints, bearings, splines, _wanted = LAYOUTS[name]
    layout, matrix = system(joints, bearings, splines)
    load = RNG.normal(size=len(matrix))
    whole, found = np.linalg.solve(matrix, load), np.full(len(matrix), np.nan)
    groups = solving_order(matrix, layout)
    assert sorted(number for group in groups for number in group) == list(range(1, joints + 2))
    for group in groups:
        lines = [k for k in range(5 * (joints + 1)) if k // 5 + 1 in group]
        lines += [5 * (joints + 1) + k for k, shaft in enumerate(sorted(splines)) if shaft + 1 in group]
        unknown = np.isnan(found) & np.any(matrix[lines] != 0.0, axis=0)
        known = np.where(np.isnan(found), 0.0, found)
        found[unknown] = np.linalg.solve(matrix[np.ix_(lines, unknown)], (load - matrix @ known)[lines])
    np.testing.assert_allclose(found, whole, rtol=1e-8)


@pytest.mark.parametrize("name", LAYOUTS)
def test_known_layouts_part_as_the_book_parts_them(name):
    joints, bearings, splines, wanted = LAYOUTS[name]
    layout, matrix = system(joints, bearings, splines)
    assert solving_order(matrix, layout) == wanted


def test_groups_of_a_drive_are_those_of_its_supports():
    held = (
        Support(shaft=1, position=-0.4, axial=True),
        Support(shaft=1, position=-0.1),
        Support(shaft=2, position=0.3),
    )
    joint = Hooke(joint_angle=0.3, cross=Cross(span=0.08))
    single = Drive(joints=(joint,), supports=held)
    assert reaction_groups(single) == ((2,), (1,))
    # Along arms that slide nothing is passed on: shaft 2 needs bearings of its own, and holds nothing lengthwise.
    slides = Hooke(joint_angle=0.3, cross=Cross(span=0.08, slides=True))
    both = Drive(joints=(slides,), supports=(*held, Support(shaft=2, position=0.5)))
    assert reaction_groups(both) == ((2,), (1,))
    assert reaction_groups(Drive(joints=(joint,))) == ()
    assert reaction_groups(example("overconstrained-pump")) == ()
