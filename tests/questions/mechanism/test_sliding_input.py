"""Mechanisms whose input slides: an inverted slider-crank by its cosine law, and a piston that drives its crank."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.mechanism.counting import joins, partition
from cardan.mechanism.turning import grid
from cardan.mechanisms import Pair, example_mechanism, mechanism_forces, mechanism_motion
from cardan.questions.mechanism import forces_answer, motion_answer
from cardan.questions.mobility.answer import answer, turned
from cardan.questions.mobility.finite_mobility import mobility_over_turn
from cardan.questions.mobility.mobility import mobility

PATH = np.linspace(0.0, 0.3, 11)
R, D = 0.8, 0.6  # bearing of the boom to the eye of the rod, and to the trunnion
DRAWN = example_mechanism("boom-cylinder")
BOOM = replace(DRAWN, masses=DRAWN.masses[:1])


def cosine_law(path):
    """Return the angle of a boom at its bearing between trunnion and eye, and both its derivatives by the path."""
    length = 1.0 + path
    angle = np.arccos((R**2 + D**2 - length**2) / (2 * R * D))
    first = length / (R * D * np.sin(angle))
    return angle, first, (1.0 - R * D * np.cos(angle) * first**2) / (R * D * np.sin(angle))


def test_a_cylinder_lifts_a_boom_by_the_cosine_law():
    found = mechanism_motion(BOOM, PATH).output
    angle, first, second = cosine_law(PATH)
    sense = -1.0  # told about +y, and the boom rises about -y
    np.testing.assert_allclose(found.angle, sense * (angle - 0.5 * np.pi), atol=1e-12)
    np.testing.assert_allclose(found.ratio, sense * first, rtol=1e-12)
    np.testing.assert_allclose(found.slope, sense * second, rtol=1e-10)


def test_a_cylinder_pushes_with_what_the_boom_asks_for():
    found = mechanism_forces(replace(BOOM, joints=tuple(replace(one, friction=None) for one in BOOM.joints)), PATH)
    angle, first, second = cosine_law(PATH)
    weight = 300 * 9.81 * 1.2 * np.cos(angle - 0.5 * np.pi)
    inertia = (150 + 300 * 1.2**2) * second * 0.1**2
    np.testing.assert_allclose(found.input_torque, (weight + inertia) * first, rtol=1e-10)
    np.testing.assert_allclose(found.still_torque, weight * first, rtol=1e-10)
    np.testing.assert_allclose(found.force[:, 1], found.input_torque, rtol=1e-10)  # the barrel is held against it
    np.testing.assert_allclose(found.force[:, 3], found.input_torque, rtol=1e-10)
    np.testing.assert_allclose(found.reaction[:, 2], 0.0, atol=1e-7)  # a weightless cylinder leans on nothing
    assert found.unbalanced < 1e-12


def test_what_rubs_in_a_cylinder_is_taken_from_its_push():
    found = mechanism_forces(DRAWN, PATH)
    bare = replace(BOOM.joints[2], friction=None)
    smooth = mechanism_forces(replace(found.mechanism, joints=(*BOOM.joints[:2], bare, BOOM.joints[3])), PATH)
    rubs = 0.1 * found.force[:, 2]
    assert np.min(rubs) > 1.0
    np.testing.assert_allclose(found.input_torque - smooth.input_torque, rubs, rtol=1e-9)
    np.testing.assert_allclose(found.loss[:, 2], 0.1 * rubs, rtol=1e-9)
    assert found.unbalanced < 1e-10


def piston_drives():
    made = example_mechanism("crank-slider")
    return replace(
        made,
        input_link="piston",
        output_link="crank",
        speed=None,
        output_force=None,
        output_torque=20.0,
        masses=(),
        input_stroke=(-0.05, 0.02),
    )


@pytest.mark.slow
def test_a_piston_turns_its_crank_as_the_crank_moves_the_piston():
    forth = mechanism_motion(piston_drives())
    theta = -forth.output.angle if forth.output.axis[2] < 0.0 else forth.output.angle
    back = mechanism_motion(example_mechanism("crank-slider"), theta).output
    np.testing.assert_allclose(back.path, forth.position, atol=1e-10)
    np.testing.assert_allclose(forth.output.ratio * back.speed, 1.0, atol=1e-9)
    np.testing.assert_allclose(forth.output.slope, -back.curve / back.speed**3, rtol=1e-8)
    force = mechanism_forces(piston_drives()).input_torque
    np.testing.assert_allclose(np.abs(force), 20.0 * np.abs(forth.output.ratio), rtol=1e-9)


@pytest.mark.slow
def test_the_reaction_of_a_guide_is_told_about_its_own_point():
    """Where the drawing stands in space changes nothing."""
    made, shift = piston_drives(), np.array([0.3, -2.0, 0.7])
    moved = replace(
        made, joints=tuple(replace(one, point=tuple((np.asarray(one.point) + shift).tolist())) for one in made.joints)
    )
    one, other = mechanism_forces(made), mechanism_forces(moved)
    np.testing.assert_allclose(other.input_torque, one.input_torque, rtol=1e-9)
    np.testing.assert_allclose(other.reaction, one.reaction, atol=1e-8)


def test_a_joint_between_moving_links_turns_as_it_does_from_the_frame():
    """A motor on the rocker of a linkage, against the same linkage drawn with the rocker at rest."""
    z = (0.0, 0.0, 1.0)

    def hinge(name, links, x, y):
        return Pair(id=name, type="R", links=links, point=(x, y, 0.0), axis=z)

    corners = {"A": (0.0, 0.0), "B": (0.02, 0.05), "C": (0.14, 0.11), "D": (0.15, 0.0)}
    links = {"A": ("0", "a"), "B": ("a", "b"), "C": ("b", "c"), "D": ("c", "0")}
    joints = tuple(hinge(name, links[name], *at) for name, at in corners.items())
    made = {"joints": joints, "input_range": (-0.2, 0.3)}
    angle = np.linspace(-0.2, 0.3, 6)
    kind = type(BOOM)
    inner = mechanism_motion(kind(frame="0", input_link="b", input_joint="B", output_link="c", **made), angle)
    outer = mechanism_motion(kind(frame="a", input_link="b", output_link="c", **made), angle)
    ground = next(one for one in outer.links if one.link == "0")
    np.testing.assert_allclose(inner.output.angle, outer.output.angle - ground.angle, atol=1e-11)
    np.testing.assert_allclose(inner.output.ratio, outer.output.ratio - ground.ratio, atol=1e-11)
    np.testing.assert_allclose(inner.output.slope, outer.output.slope - ground.slope, atol=1e-10)


def test_answers_tell_what_slides_in_its_own_units():
    found = mechanism_motion(BOOM)
    said = motion_answer.answer(BOOM, found, mechanism_motion(BOOM, grid(BOOM, 0.5)))
    assert {"ratio_min", "ratio_max"} <= {one.name for one in said.keys}
    assert "speed_fluctuation" not in {one.name for one in said.keys}
    pushed = forces_answer.answer(BOOM, mechanism_forces(BOOM))
    assert {one.name for one in pushed.keys} >= {"input_force"}
    assert len(said.figures()) == 2
    assert len(pushed.figures()) == 1


@pytest.mark.slow
def test_loops_are_followed_over_the_stroke_and_an_end_is_told():
    over = mobility_over_turn(BOOM)
    assert over.turns
    assert (over.position[0], over.position[-1]) == pytest.approx((0.0, 0.3))
    assert set(over.mobility) == {1}
    assert set(over.redundant) == {0}
    r, rod = 0.05, np.hypot(0.17, 0.04)
    made = replace(piston_drives(), input_stroke=(-0.2, 0.01))  # drawn at 200 mm
    found = turned(made)
    assert found.end == pytest.approx(rod - r - 0.2, abs=1e-6)
    assert not found.positions.turns
    assert found.positions.position[found.positions.reached].min() == pytest.approx(found.end, abs=5e-3)
    said = answer(made, mobility(made), found)
    assert "reaches an end" in str(said.remarks)
    assert len(said.figures()) == 3


def test_the_graph_counts_what_is_driven_between_moving_links():
    counted = partition(joins(BOOM), frame=BOOM.frame, input_link=BOOM.input_link)
    assert (counted.formula, counted.mobility, counted.redundant) == (1, 1, 0)
    hinges = replace(BOOM, joints=(*BOOM.joints[:3], replace(BOOM.joints[3], type="R", axis=(0.0, 1.0, 0.0))))
    found = mobility(hinges)
    assert (found.mobility, found.redundant) == (1, 2)
    counted = partition(joins(hinges), frame=BOOM.frame, input_link=BOOM.input_link)
    assert (counted.mobility, counted.redundant) == (1, 2)


@pytest.mark.parametrize(
    ("changes", "field", "words"),
    [
        ({"input_stroke": None}, "input_stroke", "say between which paths"),
        ({"input_stroke": (0.0, 0.45)}, "input_link", "cannot follow: with 'rod' moved by"),
        ({"input_stroke": (0.1, 0.0)}, "input_stroke", "must lie below"),
        ({"input_range": (0.0, 1.0)}, "input_range", "sliding_speed and input_stroke"),
        ({"speed": 1.0}, "speed", "sliding_speed and input_stroke"),
        ({"input_joint": "cylindre"}, "input_joint", "did you mean cylinder?"),
        ({"input_joint": "rod eye"}, "input_joint", "of type S"),
        ({"input_joint": "boom bearing"}, "input_joint", "does not join the input link"),
    ],
)
def test_what_no_stroke_can_be_is_refused(changes, field, words):
    with pytest.raises(InputError) as caught:
        mechanism_motion(replace(BOOM, **changes))
    (problem, *_more) = caught.value.problems
    assert problem.field == field
    assert words in problem.message
