import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import InputError
from cardan.questions.mobility.constraint_release import release
from cardan.questions.mobility.mobility import mobility
from tests.builders.mechanisms import anyhow, hooke


@pytest.mark.parametrize(
    ("joint", "way", "axis", "verdict"),
    [
        *[(name, "trans", axis, "remedy") for name in "ABCD" for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 2, 3))],
        ("A", "rot", (1, 0, 0), "remedy"),
        ("A", "rot", (0, 0, 1), "free"),
        ("D", "rot", (0, 1, 0), "remedy"),
        ("B", "rot", (0, 0, 1), "spoil"),
        ("C", "rot", (0, 0, 1), "spoil"),
    ],
)
def test_what_frees_a_hooke_joint_and_what_spoils_it(joint, way, axis, verdict):
    assert release(hooke(), joint, way, axis).verdict == verdict


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_release_takes_one_away_or_lets_one_loose(seed):
    rng = np.random.default_rng(seed)
    mechanism = anyhow(rng, links=4, loops=3)
    joint = mechanism.joints[int(rng.integers(len(mechanism.joints)))].id
    found = release(mechanism, joint, str(rng.choice(["rot", "trans"])), rng.normal(size=3))
    assert (found.redundant, found.mobility) in {(-1, 0), (0, 1), (0, 0)}


@pytest.mark.parametrize("name", "ABCD")
def test_the_axes_of_a_joint_say_what_a_release_there_does(name):
    mechanism = hooke()
    hold = next(one for one in mobility(mechanism).joints if one.id == name)
    verdict = {"strained": "remedy", "needed": "spoil", "free": "free"}
    for way, words in (("rot", hold.turning), ("trans", hold.sliding)):
        for axis, word in zip(hold.axes, words, strict=True):
            assert release(mechanism, name, way, axis).verdict == verdict[word]


@pytest.mark.parametrize(
    ("joint", "way", "axis", "field"),
    [
        ("X", "rot", (0, 0, 1), "joint"),
        ("A", "turn", (0, 0, 1), "way"),
        ("A", "rot", (0, 0, 0), "axis"),
        ("A", "rot", (0, 1), "axis"),
    ],
)
def test_what_cannot_be_released_is_named(joint, way, axis, field):
    with pytest.raises(InputError) as caught:
        release(hooke(), joint, way, axis)
    assert caught.value.field == field
