import numpy as np
import pytest

from cardan import InputError
from cardan.questions.forces.elastic import redundancy
from cardan.questions.forces.support_statics import Layout, actions, balance

AXIS = np.asarray([[1.0, 0, 0], [0.8, 0.6, 0], [0.8, 0.0, 0.6]])


def found(bearings, places, *, joints=1, splines=()):
    layout = Layout(joints=joints, bearings=tuple(bearings), splines=splines)
    acting = actions(AXIS[: joints + 1], np.ones(joints + 1), layout, np.asarray(places))
    return redundancy(balance(acting), layout)


FIXED, FLOATING = ("radial", "axial"), ("radial",)
TYPICAL = {
    "single joint, 5 + 2": ([(0, FIXED), (0, FLOATING), (1, FLOATING)], [0.1, 0.8, 0.5], 1, ()),
    "double joint, 5 + 4": ([(0, FIXED), (0, FLOATING), (2, FLOATING), (2, FLOATING)], [0.1, 0.8, 0.3, 0.7], 2, ()),
    "double joint with spline, 5 + 5": (
        [(0, FIXED), (0, FLOATING), (2, FIXED), (2, FLOATING)],
        [0.1, 0.8, 0.3, 0.7],
        2,
        (1,),
    ),
}


@pytest.mark.parametrize("layout", TYPICAL.values(), ids=TYPICAL)
def test_typical_layouts_are_determinate(layout):
    bearings, places, joints, splines = layout
    assert found(bearings, places, joints=joints, splines=splines).degree == 0


@pytest.mark.parametrize("layout", TYPICAL.values(), ids=TYPICAL)
def test_one_bearing_more_counts_its_holds_and_any_fewer_is_loose(layout):
    bearings, places, joints, splines = layout
    more = found([*bearings, (0, FLOATING)], [*places, 0.4], joints=joints, splines=splines)
    assert more.degree == 2
    assert (len(bearings), "radial") in more.strained
    assert sum(2 if hold == "radial" else 1 for _k, hold in more.spare) == 2
    for k in range(len(bearings)):
        rest = [one for i, one in enumerate(bearings) if i != k]
        with pytest.raises(InputError, match="too few"):
            found(rest, [x for i, x in enumerate(places) if i != k], joints=joints, splines=splines)


def test_what_takes_no_part_is_not_strained():
    # A third bearing on shaft 1 strains that shaft alone.
    many = found([(0, FIXED), (0, FLOATING), (0, FLOATING), (1, FLOATING)], [0.1, 0.8, 0.4, 0.5])
    assert {k for k, _hold in many.strained} == {0, 1, 2}
    assert (0, "axial") not in many.strained


def test_a_fixed_slope_is_let_go_first():
    many = found([(0, ("radial", "axial", "tilt")), (0, FLOATING), (1, FLOATING)], [0.1, 0.8, 0.5])
    assert (many.degree, many.spare) == (2, ((0, "tilt"),))


def test_a_spline_that_nothing_else_holds_is_loose():
    with pytest.raises(InputError, match="shaft 3 from moving along its axis"):
        found([(0, FIXED), (0, FLOATING), (2, FLOATING), (2, FLOATING)], [0.1, 0.8, 0.3, 0.7], joints=2, splines=(1,))


def test_letting_go_turns_back_from_a_dead_end():
    # Two too many: the thrust bearing alone would go most readily, but then only radial bearings are left, of two each.
    many = found([(0, FIXED), (0, FLOATING), (1, FLOATING), (1, FLOATING)], [0.1, 0.8, 0.3, 0.7])
    assert many.degree == 2
    ((number, hold),) = many.spare
    assert hold == "radial"
    bearings = [(0, FIXED), (0, FLOATING), (1, FLOATING), (1, FLOATING)]
    places = [0.1, 0.8, 0.3, 0.7]
    assert number > 0
    assert found(bearings[:number] + bearings[number + 1 :], places[:number] + places[number + 1 :]).degree == 0


def test_where_no_hold_can_go_none_is_named():
    # One too many, and only radial bearings: letting one go frees a shaft.
    many = found([(0, FLOATING), (0, FLOATING), (1, FLOATING), (1, FLOATING)], [0.1, 0.8, 0.3, 0.7])
    assert (many.degree, many.spare) == (1, ())
