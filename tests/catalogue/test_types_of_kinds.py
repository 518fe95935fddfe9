"""A type of the catalogue belongs to the kinds that turn by its law."""

from __future__ import annotations

import pytest

from cardan import InputError
from cardan.drive.joints import JOINTS
from cardan.io.drive_file import loads

TEXT = 'format = 1\n[[joints]]\njoint_angle_deg = 5\nkind = "{kind}"\ntype = "{type}"\n'


@pytest.mark.parametrize(("kind", "type_"), [("hooke", "weiss_curved"), ("tripod", "medium"), ("weiss", "tracta")])
def test_a_type_of_another_kind_is_refused(kind, type_):
    with pytest.raises(InputError) as refused:
        loads(TEXT.format(kind=kind, type=type_))
    (problem,) = refused.value.problems
    assert problem.field == "joints[0].type"
    assert "is a type of kind" in problem.message


@pytest.mark.parametrize("kind", [kind for kind in JOINTS if kind != "offset_cross"])
def test_types_of_a_kind_are_taken(kind):
    for type_ in JOINTS[kind].types:
        assert loads(TEXT.format(kind=kind, type=type_)).joints[0].type == type_


def test_an_ideal_joint_may_be_of_any_type():
    assert loads(TEXT.format(kind="constant_velocity", type="rzeppa_offset")).joints[0].type == "rzeppa_offset"
