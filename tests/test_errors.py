import pickle

import numpy as np
import pytest

from cardan.errors import CardanError, InputError, JointAngleLimitError, MissingExtraError, Problem, check, refuse

TWO = (Problem("joints[0].joint_angle", "94° is too much"), Problem("duty.speed", "missing"))


def test_an_input_error_tells_everything_at_once():
    error = InputError(TWO)
    assert str(error) == "joints[0].joint_angle: 94° is too much\nduty.speed: missing"
    assert error.field == "joints[0].joint_angle"
    assert error.problems == TWO
    assert str(InputError([Problem("", "not TOML")])) == "not TOML"


def test_problems_may_be_given_by_a_generator():
    assert InputError(problem for problem in TWO).problems == TWO


@pytest.mark.parametrize("kind", [InputError, JointAngleLimitError])
def test_errors_cross_processes_whole(kind):
    error = kind(TWO, where=np.asarray([True, False]))
    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is kind
    assert copy.problems == TWO
    assert copy.where.tolist() == [True, False]
    assert str(copy) == str(error)


def test_renaming_keeps_kind_and_mask():
    error = JointAngleLimitError(TWO, where=[True]).renamed(lambda field: f"drive.{field}")
    assert isinstance(error, JointAngleLimitError)
    assert error.where == [True]
    assert [problem.field for problem in error.problems] == ["drive.joints[0].joint_angle", "drive.duty.speed"]


def test_check_raises_only_when_there_is_something():
    check(iter(()))
    with pytest.raises(InputError) as caught:
        check(iter(TWO))
    assert caught.value.problems == TWO


def test_all_errors_are_cardans():
    assert issubclass(InputError, CardanError)
    assert issubclass(JointAngleLimitError, InputError)
    assert issubclass(MissingExtraError, CardanError)
    assert refuse("a", "b").problems == (Problem("a", "b"),)
