import numpy as np
import pytest

from cardan import InputError
from cardan.maths.kernel import screws
from cardan.mechanism.mechanism import PAIRS, Mechanism, axes
from tests.builders.mechanisms import anyhow, hooke, pair

# tmm Table 1 and the Book: freedoms of each kind of pair.
FREEDOMS = {"R": 1, "P": 1, "H": 1, "C": 2, "U": 2, "S": 3, "E": 3, "SG": 4, "L4": 4, "PT": 5, "RO": 5}


def test_freedoms_are_those_of_the_table():
    assert {code: kind.freedoms for code, kind in PAIRS.items()} == FREEDOMS
    assert all(kind.freedoms + kind.constraints == 6 for kind in PAIRS.values())


def test_twists_of_a_pair_are_as_many_and_independent():
    rng = np.random.default_rng(0)
    for one in anyhow(rng, links=8, loops=12).joints:
        assert screws.independent(one.freedoms).shape == (one.kind.freedoms, 6)


def test_a_screw_turns_and_slides_at_once():
    screw = pair("s", "H", "01", (0, 0, 0), (0, 0, 2), pitch=0.01)
    assert np.allclose(screw.freedoms, [[0, 0, 1, 0, 0, 0.01]])


def test_axes_of_a_joint_are_square_and_right_handed():
    own = axes(pair("s", "R", "01", (0, 0, 0), (1, 2, 3)))
    assert np.allclose(own @ own.T, np.eye(3))
    assert np.linalg.det(own) == pytest.approx(1.0)


def test_counts_come_from_the_joints():
    one = hooke()
    assert (one.links, one.loops, one.constraints, one.formula) == (("1", "2", "3"), 1, 20, -2)


def refused(*joints, frame="0", **more):
    with pytest.raises(InputError) as caught:
        Mechanism(frame=frame, joints=joints, **more)
    return [problem.field for problem in caught.value.problems]


def test_everything_wrong_is_named_at_once():
    found = refused(
        pair("A", "R", "01", (0, 0, 0), (0, 0, 0)),
        pair("A", "U", "12", (0, 0, 0), (0, 0, 1), (0, 0, 3)),
        pair("B", "L4", "22", (0, 0, 0), (0, 0, 1), (0, 1, 1)),
        pair("C", "R", "34", (0, 0, np.inf), (np.nan, 0, 1)),
        pair("D", "C", "01", (0, 0, 0)),
        pair("E", "H", "01", (0, 0, 0), (0, 0, 1)),
        pair("F", "R", "01", (0, 0, 0), (0, 0, 1), (0, 1, 0), 0.1),
        input_link="0",
        output_link="9",
    )
    assert found == [
        "joints[0].axis",
        "joints[1].id",
        "joints[1].axis2",
        "joints[2].links",
        "joints[2].axis2",
        "joints[3].point",
        "joints[3].axis",
        "joints[4].axis",
        "joints[5].pitch",
        "joints[6].axis2",
        "joints[6].pitch",
        "joints",
        "input_link",
        "output_link",
    ]


def test_no_joints_are_no_mechanism():
    assert refused() == ["joints"]
    assert refused(pair("A", "S", "12", (0, 0, 0))) == ["joints"]
