"""Nobody outside of `cardan.drive.joints` asks for the type or the kind of a joint: they ask the joint."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import cardan
from cardan.drive.joints import JOINTS, Joint
from cardan.drive.joints.common import inner
from cardan.drive.joints.common.inner import Stance
from cardan.drive.joints.joint import REFUSALS
from cardan.drive.models.kinematics_model import left_over
from cardan.joints import ClemensProfile
from cardan.mechanism.mechanism import PAIRS
from cardan.texts import speaking
from tests.fixtures.toy_joint import TOYS

SOURCE = Path(cardan.__file__).parent

CLASSES = {kind.__name__ for kind in JOINTS.values()} | {"Joint"}

MODULES = sorted(path for path in SOURCE.rglob("*.py") if SOURCE / "drive" / "joints" not in path.parents)

A_JOINT = re.compile(r"(^|[^a-z])(joints?(\[[^]]*\])?|jointed)$", re.IGNORECASE)
"""What an expression for a joint ends with."""


def named(node: ast.AST) -> set[str]:
    """Return the names and attributes within an expression."""
    found = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
    return found | {one.attr for one in ast.walk(node) if isinstance(one, ast.Attribute)}


def words(node: ast.AST) -> set[str]:
    """Return the kinds of joints written out within an expression."""
    return {one.value for one in ast.walk(node) if isinstance(one, ast.Constant) and one.value in JOINTS}


def of_a_joint(node: ast.AST) -> bool:
    """Tell whether an expression is the kind of a joint."""
    return isinstance(node, ast.Attribute) and node.attr == "kind" and bool(A_JOINT.search(ast.unparse(node.value)))


def asking(code: str) -> Iterator[tuple[int, str]]:
    """Yield line and text of what asks for the type or the kind of a joint."""
    for node in ast.walk(ast.parse(code)):
        bad = False
        if isinstance(node, ast.Call):
            called = getattr(node.func, "id", "") or getattr(node.func, "attr", "")
            bad = called in ("isinstance", "issubclass") and bool(named(node.args[1]) & CLASSES)
            bad |= called == "get" and any(of_a_joint(one) for one in node.args)
        elif isinstance(node, ast.Compare):
            sides = (node.left, *node.comparators)
            typed = any(isinstance(one, ast.Call) and getattr(one.func, "id", "") == "type" for one in sides)
            bad = typed and any(named(one) & CLASSES for one in sides)
            bad |= any(of_a_joint(one) or words(one) for one in sides)
        elif isinstance(node, ast.Subscript):
            bad = of_a_joint(node.slice)
        elif isinstance(node, ast.Dict):
            bad = any(key is not None and words(key) for key in node.keys)
        elif isinstance(node, ast.MatchClass):
            bad = bool(named(node.cls) & CLASSES)
        elif isinstance(node, ast.MatchValue):
            bad = bool(words(node.value))
        if bad:
            yield node.lineno if hasattr(node, "lineno") else 0, ast.unparse(node)


@pytest.mark.slow
def test_joints_are_asked_not_their_types():
    found = {path.relative_to(SOURCE).as_posix(): list(asking(path.read_text("utf-8"))) for path in MODULES}
    assert len(found) > 100
    assert {path: places for path, places in found.items() if places} == {}


@pytest.mark.parametrize(
    "code",
    [
        "isinstance(joint, Tripod)",
        "isinstance(drive.joints[i], Rzeppa | Weiss)",
        "type(joint) is not Hooke",
        'joint.kind == "something"',
        "drive.joints[0].kind != other",
        'kind == "hooke"',
        'kind in ("tripod", "half_cardan")',
        'MAKERS = {"tripod": 1}',
        "names[joint.kind]",
        "names.get(joint.kind, 0)",
        "match joint:\n    case Tripod():\n        pass",
        'match kind:\n    case "weiss":\n        pass',
    ],
)
def test_what_asks_for_a_type_is_seen(code):
    assert list(asking(code))


def one_of_each() -> list[Joint]:
    """Return a joint of every kind, the toys among them."""
    sizes = {"offset_cross": {"offset": 0.01, "reach": 0.3}}
    return [kind(joint_angle=0.04, **sizes.get(name, {})) for name, kind in JOINTS.items()] + [
        toy(joint_angle=0.04) for toy in TOYS
    ]


STANCE = Stance(
    centre=np.zeros(3),
    before=np.asarray([1.0, 0.0, 0.0]),
    after=np.asarray([np.cos(0.3), np.sin(0.3), 0.0]),
    normal=np.asarray([0.0, 0.0, 1.0]),
    joint_angle=0.3,
    driving=np.asarray([0.0, 1.0, 0.0]),
    driven=np.asarray([-np.sin(0.3), np.cos(0.3), 0.0]),
    length=1.0,
)


@pytest.mark.parametrize("joint", one_of_each(), ids=lambda joint: joint.kind)
def test_every_kind_speaks_the_protocol(joint):
    assert joint.in_words()
    assert 0.0 < joint.steepest <= np.pi / 2
    angle_error, ratio, slope = joint.deviation(np.linspace(0.0, 6.0, 7), np.asarray(0.04))
    assert all(np.all(np.isfinite(one)) for one in (angle_error, ratio, slope))
    a, b = joint.near_pair(np.asarray(0.04))
    assert float(np.real(a * a - b * b)) == pytest.approx(1.0)
    assert joint.even == (joint.has_map and not np.any(np.abs(angle_error) > 0.0))
    assert set(joint.refusals) <= set(REFUSALS)
    assert joint.own_fields().isdisjoint(one.name for one in fields(Joint))
    assert joint.foreign <= {one.name for one in fields(Joint)}
    with speaking("en"):
        assert all(joint.refusal(question) == "" for question in REFUSALS if joint.single_cross)


@pytest.mark.parametrize("joint", one_of_each(), ids=lambda joint: joint.kind)
def test_every_inner_mechanism_joins_both_shafts(joint):
    pairs = list(joint.mechanism(STANCE))
    links = {link.replace("{count}", str(pair.count)) for pair in pairs for link in pair.links}
    assert {inner.DRIVING, inner.DRIVEN} <= links
    assert len(links) == len(pairs) + 1, "a chain from shaft to shaft"
    assert all(pair.type in PAIRS for pair in pairs)
    assert all("{number}" in pair.name for pair in pairs)


def test_what_a_kind_does_not_say_is_said_for_it():
    toy = TOYS[0](joint_angle=0.1)
    assert toy.in_words() == "toy"
    assert list(toy.inside(0.1)) == []
    assert toy.twist_spring is None
    assert toy.types == ()
    assert toy.refusal("losses").endswith("cross")
    assert not toy.refusal("articulation")
    assert TOYS[1](joint_angle=0.1).refusal("forces")


UNEVEN = {
    "rzeppa": {"lever_b": 0.35, "lever_c": 0.7},
    "weiss": {"driving_offset": 0.003, "driven_offset": 0.0033, "groove_radius": 0.03},
    "pin_coupling": {"driving_distance": 0.05, "driven_distance": 0.06},
    "clemens": {
        "driving": ClemensProfile(axial=0.05, radial=0.02, radius=0.06),
        "driven": ClemensProfile(axial=0.05, radial=0.021, radius=0.06),
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", UNEVEN)
def test_a_law_asked_at_many_joint_angles_is_that_at_each(kind):
    """The nearest map of a Hooke joint, a row of joint angles at once, also where the joint does not turn at some."""
    joint = JOINTS[kind](**UNEVEN[kind])
    for bends in (np.linspace(0.01, 0.7, 70), np.linspace(0.5, 1.5, 5)):
        with np.errstate(invalid="ignore"):
            many = joint.near_pair(bends)[1]
            each = np.asarray([joint.near_pair(np.asarray(one))[1] for one in bends.tolist()])
        assert np.allclose(many, each, rtol=0.0, atol=1e-15, equal_nan=True)
    assert np.any(np.abs(many) > 0.0)


SHARP = {
    "elastic_half_cardan": ({"pairs": 1}, 84.0),
    "rzeppa": ({"balls": 4, "lever_b": 2.0, "lever_c": 0.5}, 88.0),
    "weiss": ({"balls": 1, "driving_offset": 0.0263, "driven_offset": 0.0033, "groove_radius": 0.0241}, 59.0),
    "pin_coupling": ({"driving_distance": 0.05, "driven_distance": 0.07}, 70.0),
    "clemens": (UNEVEN["clemens"], 60.0),
}
"""Kinds whose laws are no maps -> sizes and a joint angle [°] at which they are sharp."""


def test_sharp_laws_are_all_that_are_no_maps():
    laws = {kind for kind, own in JOINTS.items() if own.deviation is not Joint.deviation}
    assert laws - {"mechanism"} == set(SHARP), "tests/drive/joints/test_mechanism.py has own mechanisms"


@pytest.mark.parametrize("kind", SHARP)
@pytest.mark.parametrize("share", [0.02, 0.5, 1.0])
def test_the_nearest_map_is_told_to_rounding_at_any_joint_angle(kind, share):
    """By 4001 places, which no number of places that the program takes divides."""
    sizes, steep = SHARP[kind]
    joint, bend = JOINTS[kind](**sizes), np.radians(share * steep)
    theta = np.arange(4001) * (2.0 * np.pi / 4001)
    lead = joint.deviation(theta, np.asarray(bend))[0]
    tau = float(lead @ np.sin(2.0 * theta)) * (2.0 / 4001)
    for bends in (np.asarray(bend), np.asarray([bend, 0.01])):
        a, b = (np.ravel(part)[0] for part in joint.near_pair(bends))
        assert abs(-(b / a).real - tau) < 1e-15
    nearest = np.arctan2(tau * np.sin(2.0 * theta), 1.0 - tau * np.cos(2.0 * theta))
    assert left_over(joint, float(bend)) == pytest.approx(np.max(np.abs(lead - nearest)), rel=3e-5, abs=1e-14)


def test_a_contact_that_is_lost_between_two_places_keeps_no_map():
    """Near its largest joint angle a pin coupling turns back over less than the places of a turn are apart."""
    joint = JOINTS["pin_coupling"](driving_distance=0.05, driven_distance=0.07)
    theta = np.arange(30720) * (2.0 * np.pi / 30720)
    low, high = np.radians(70.0), np.radians(89.0)
    for _halving in range(30):
        middle = 0.5 * (low + high)
        with np.errstate(invalid="ignore", divide="ignore"):
            turns = np.all(np.isfinite(joint.deviation(theta, np.asarray(middle))[0]))
        low, high = (middle, high) if turns else (low, middle)
    with np.errstate(invalid="ignore"):
        assert np.isfinite(joint.near_pair(np.asarray(low))[1])
        assert np.isnan(joint.near_pair(np.asarray(high + 1e-4))[1])
