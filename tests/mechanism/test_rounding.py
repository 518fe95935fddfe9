"""Drawings with few digits: closed by the least changes, told, as the exact drawings are; nothing else is mended."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError
from cardan.drive.joints.mechanism import inside_of
from cardan.io import loads_mechanism
from cardan.mechanism.rounding import fitted
from cardan.mechanisms import example_mechanism
from cardan.questions.mechanism.motion import mechanism_motion
from cardan.questions.mechanism.motion_answer import answer as motion_answer
from cardan.questions.mobility.answer import answer as mobility_answer
from cardan.questions.mobility.mobility import mobility
from cardan.units import deg

TURN = np.linspace(0.0, 2.0 * np.pi, 33)


def few_digits(name, places=1, digits=3, *, rounding=1e-3):
    """Return a shipped mechanism as a drawing tells it: tenths of a millimetre, directions of three digits."""
    made = example_mechanism(name)

    def short(way):
        return None if way is None else tuple(np.round(np.asarray(way) / np.linalg.norm(way), digits).tolist())

    joints = tuple(
        replace(
            one,
            point=tuple((np.round(np.asarray(one.point) * 1e3, places) / 1e3).tolist()),
            axis=short(one.axis),
            axis2=short(one.axis2),
        )
        for one in made.joints
    )
    return replace(made, joints=joints, rounding=rounding)


OPEN = ["hooke-stiff-bearings", "maize-drive", "thompson", "weiss-straight"]
"""Mechanisms held more than once, whose loops few digits open."""


@pytest.mark.slow
@pytest.mark.parametrize("name", OPEN)
def test_few_digits_close_as_all_digits_do(name):
    given, exact = few_digits(name), example_mechanism(name)
    with pytest.raises(InputError, match="rounding_mm"):
        mechanism_motion(replace(given, rounding=None), TURN)
    found = fitted(given)
    assert 0.0 < found.shift <= given.rounding
    near, true = mechanism_motion(given, TURN), mechanism_motion(exact, TURN)
    np.testing.assert_allclose(near.output.ratio, true.output.ratio, atol=5e-3)
    assert np.max(near.turned.misfit) < 1e-11  # [m, rad]; open by 1e-5 before
    one, other = mobility(given), mobility(exact)
    assert (one.mobility, one.redundant) == (other.mobility, other.redundant)
    for was, now in zip(given.joints, found.mechanism.joints, strict=True):
        if was.axis is not None:
            assert np.linalg.norm(np.cross(was.along, now.along)) <= np.sin(found.turn) + 1e-12


@pytest.mark.slow
def test_it_is_told_by_how_much():
    given = few_digits("thompson")
    found, said = fitted(given), "Its numbers are rounded"
    for made in (motion_answer(given, mechanism_motion(given, TURN)), mobility_answer(given, mobility(given))):
        (text,) = [one.text for one in made.remarks if said in str(one.text)]
        values = {one.dimension: one.value for one in text.values.values() if hasattr(one, "dimension")}
        assert values == {"length": found.shift, "angle": found.turn}


@pytest.mark.slow
def test_the_changes_are_the_least():
    """A plane crank-slider that closes is left alone; of one with a skewed pin the skew is shared among its pins."""
    exact = example_mechanism("crank-slider")
    assert fitted(replace(exact, rounding=1e-4)).shift < 1e-12
    lean = 1e-3
    skewed = tuple(
        replace(one, axis=(0.0, np.sin(lean), np.cos(lean))) if one.id == exact.joints[1].id else one
        for one in exact.joints
    )
    found = fitted(replace(exact, joints=skewed, rounding=1e-3))
    assert 0.3 * lean < found.turn <= lean * (1.0 + 1e-6)
    made = mechanism_motion(replace(exact, joints=skewed, rounding=1e-3), TURN)
    np.testing.assert_allclose(made.output.path, mechanism_motion(exact, TURN).output.path, atol=3e-6)


@pytest.mark.slow
def test_shafts_that_nearly_meet_are_made_to_meet():
    exact = example_mechanism("reuleaux")
    off = tuple(
        replace(one, point=(one.point[0], one.point[1], 0.3e-3)) if one.id == "driven bearing" else one
        for one in exact.joints
    )
    with pytest.raises(InputError, match=r"pass each other 0\.3 mm"):
        inside_of(replace(exact, joints=off), "", "")
    given = replace(exact, joints=off, rounding=0.5e-3)
    assert fitted(given).shift >= 0.3e-3
    assert np.max(np.abs(inside_of(given, "", "").law(0.3))) < 1e-3


@pytest.mark.slow
def test_a_joint_turns_at_every_joint_angle_as_the_exact_one():
    given, exact = (inside_of(one, "", "") for one in (few_digits("thompson"), example_mechanism("thompson")))
    assert given.freedom == exact.freedom == 2
    for alpha in (5 * deg, 20 * deg, 35 * deg):
        np.testing.assert_allclose(given.law(alpha)[:1], exact.law(alpha)[:1], atol=1e-5)


@pytest.mark.slow
def test_a_wrong_mechanism_is_refused_with_the_pair_and_the_amount():
    with pytest.raises(InputError) as caught:
        fitted(replace(example_mechanism("maize-drive-offset"), rounding=2e-3))
    (problem,) = caught.value.problems
    assert problem.field == "rounding"
    assert "'sleeve bearing' would have to move by 7.35 mm" in problem.message
    assert fitted(replace(example_mechanism("maize-drive-offset"), rounding=10e-3)).shift > 5e-3


def hinged(name, **few):
    """Return a shipped mechanism with a hinge for every ball and universal pair, and changed axes of some pairs."""
    made = example_mechanism(name)
    joints = tuple(
        replace(one, type="R", axis=(0.0, 1.0, 0.0), axis2=None) if one.type in ("S", "U") else one
        for one in made.joints
    )
    return replace(made, joints=tuple(replace(one, axis=few.get(one.id, one.axis)) for one in joints))


def test_an_input_between_links_that_move_closes_its_loops_too():
    """A boom of hinges alone is held three times too often; rounded axes open it by a tenth of a millimetre."""
    exact = hinged("boom-cylinder")
    given = hinged("boom-cylinder", trunnion=(0.001, 1.0, 0.0), cylinder=(0.8, 0.001, 0.6))
    with pytest.raises(InputError, match="rounding_mm"):
        mechanism_motion(given)
    given = replace(given, rounding=1e-3)
    assert 0.0 < fitted(given).turn <= 1.8e-3  # both axes together
    near, true = mechanism_motion(given), mechanism_motion(exact)
    np.testing.assert_allclose(near.output.ratio, true.output.ratio, rtol=3e-3)
    assert np.max(near.turned.misfit) < 1e-11
    assert (mobility(given).mobility, mobility(given).redundant) == (1, 3)


@pytest.mark.parametrize(
    ("name", "changed", "said"),
    [
        ("boom-cylinder", {"input_stroke": None}, "slides over a stroke"),
        ("friction-cones", {}, "it holds a speed, not a place"),
    ],
)
def test_it_needs_an_input_and_nothing_that_rolls(name, changed, said):
    with pytest.raises(InputError, match=said):
        replace(example_mechanism(name), rounding=1e-3, **changed)


def test_the_file_has_a_key():
    made = loads_mechanism(
        'format = 1\nframe = "0"\ninput_link = "1"\nrounding_mm = 0.5\n[[joints]]\nid = "A"\ntype = "R"\n'
        'links = ["0", "1"]\npoint_mm = [0, 0, 0]\naxis = [0, 0, 1]\n'
    )
    assert made.rounding == 0.5e-3


@pytest.mark.slow
def test_a_mechanism_locked_by_next_to_nothing_is_asked_whether_it_is_rounded():
    given = replace(few_digits("thompson"), rounding=None)
    found = mobility(given)
    assert found.mobility == 0
    assert any("rounding_mm" in str(one.text) for one in mobility_answer(given, found).remarks)
    exact = example_mechanism("thompson")
    assert not any("rounding_mm" in str(one.text) for one in mobility_answer(exact, mobility(exact)).remarks)
