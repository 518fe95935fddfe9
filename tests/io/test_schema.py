"""The schema accepts what the reader accepts and refuses what it refuses."""

from __future__ import annotations

import json
import tomllib
from typing import Any

import jsonschema
import pytest

from cardan.io import example_names, example_text, schema, starter
from cardan.io.formats import FORMATS
from cardan.io.schema import reference

VALIDATOR = jsonschema.Draft202012Validator(schema())


def tree(**changes: Any) -> dict[str, Any]:
    return {"format": 1, "joints": [{"joint_angle_deg": 10}, {"joint_angle_deg": 12}], **changes}


@pytest.mark.slow
def test_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(schema())
    assert json.loads(json.dumps(schema())) == schema()


@pytest.mark.parametrize("text", [*(example_text(name) for name in example_names()), starter()])
def test_accepts_examples(text: str) -> None:
    VALIDATOR.validate(tomllib.loads(text))


@pytest.mark.parametrize(
    "bad",
    [
        tree(format=2),
        tree(colour="red"),
        {"format": 1},
        tree(joints=[{"joint_angle": 10}]),
        tree(joints=[{"joint_angle_deg": 90}]),
        tree(joints=[{"joint_angle_deg": 1, "joint_angle_rad": 0.1}]),
        tree(joints=[{"centre_mm": [1, 2]}]),
        tree(joints=[{"kind": "hook", "joint_angle_deg": 1}]),
        tree(shafts=[{"yoke_angle_deg": 3}]),
        tree(shafts=[{"number": 2, "yoke_angle_deg": 3, "yoke_lead_deg": 3}]),
        tree(shafts=[{"number": 2, "spline": {"teeth": 2.5}}]),
        tree(duty={"speed_rpm": "fast"}),
        tree(movements=[{"kind": "arm", "moves": ["output"], "frequency_Hz": 1}]),
    ],
)
def test_refuses(bad: dict[str, Any]) -> None:
    assert not VALIDATOR.is_valid(bad)


def test_reference_names_every_key_of_the_schema() -> None:
    text = reference()
    for word in ("yoke_lead", "move_within", "engaged", "spline_overlap", "`_arcmin`", "set"):
        assert word in text


def test_formats_hold_a_content_each() -> None:
    assert all(module.suffix == suffix and callable(module.content) for suffix, module in FORMATS.items())
