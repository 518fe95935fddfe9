import json
import tomllib

import jsonschema
import pytest

from cardan import InputError, load, save
from cardan.drive.drive import Drive
from cardan.io import (
    dumps,
    example_mechanism,
    example_text,
    loads,
    loads_either,
    loads_mechanism,
    mechanism_names,
    mechanism_schema,
)
from cardan.mechanisms import load_mechanism

HINGE = """
format = 1
frame = "wall"

[[joints]]
id = "hinge"
type = "R"
links = ["wall", "door"]
point_mm = [0, 20, 0]
axis = [0, 0, 1]
"""


def problems(text):
    with pytest.raises(InputError) as caught:
        loads_mechanism(text)
    return {one.field: one.message for one in caught.value.problems}


def test_lengths_are_read_in_their_units():
    found = loads_mechanism(
        HINGE.replace("axis =", "misalignment_um = [0, 0, 0]\naxis =").replace("misalignment_um", "misalignment_mm")
    )
    assert found.joints[0].point == (0.0, 0.02, 0.0)
    screw = loads_mechanism(HINGE.replace('"R"', '"H"') + "pitch_mm_per_turn = 5\n")
    assert screw.joints[0].pitch == pytest.approx(5e-3 / 6.283185307179586)


@pytest.mark.parametrize("name", mechanism_names())
@pytest.mark.parametrize("form", ["toml", "json"])
def test_what_is_written_is_what_is_read(name, form):
    whole = example_mechanism(name)
    assert loads_mechanism(dumps(whole, form=form), form=form) == whole


@pytest.mark.parametrize("name", mechanism_names())
def test_examples_explain_themselves_and_keep_the_schema(name):
    text = example_text(name)
    header = [line for line in text.split("\n\n")[0].splitlines() if line.startswith("#")]
    assert len(" ".join(header)) > 100
    jsonschema.Draft202012Validator(mechanism_schema()).validate(tomllib.loads(text))


def test_the_schema_is_one_and_refuses_what_the_reader_refuses():
    schema = mechanism_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    tree = tomllib.loads(HINGE)
    assert validator.is_valid(tree)
    for changed in ({"type": "X"}, {"axis": [0, 1]}, {"point_mm": None}, {"colour": "red"}):
        joint = {key: value for key, value in (tree["joints"][0] | changed).items() if value is not None}
        assert not validator.is_valid(tree | {"joints": [joint]})
        assert problems(json_to_toml(tree | {"joints": [joint]}))


def json_to_toml(tree):
    lines = [f"{key} = {json.dumps(value)}" for key, value in tree.items() if key != "joints"]
    for joint in tree["joints"]:
        lines += ["[[joints]]", *(f"{key} = {json.dumps(value)}" for key, value in joint.items())]
    return "\n".join(lines)


def test_all_problems_of_a_file_come_at_once_with_their_keys():
    found = problems(
        HINGE.replace("format = 1", "format = 2").replace("axis = [0, 0, 1]", "axis = [0, 0, 0]")
        + """
[[joints]]
id = "hinge"
type = "H"
links = ["door", "handle"]
point = [0, 0, 0]
axis = [1, 0, 0]
[[joints]]
id = "lock"
type = "Q"
links = ["bolt", "nut"]
point_mm = [0, 0, 0]
axes = [0, 0, 1]
"""
    )
    assert set(found) == {
        "format",
        "joints[0].axis",
        "joints[1].point",
        "joints[1].id",
        "joints[1].pitch_mm_per_turn",
        "joints[2].type",
        "joints[2].axes",
    }
    assert "point_mm" in found["joints[1].point"]
    assert "axis" in found["joints[2].axes"]


def test_drives_and_mechanisms_are_told_apart(tmp_path):
    drive = Drive.from_angles([0.3])
    assert isinstance(loads_either(dumps(drive)), Drive)
    assert loads_either(HINGE).links == ("door",)
    with pytest.raises(InputError, match="mobility"):
        loads(HINGE)
    with pytest.raises(InputError, match="no mechanism"):
        loads_mechanism(dumps(drive))
    place = tmp_path / "door.toml"
    save(loads_mechanism(HINGE), place)
    assert load_mechanism(place) == loads_mechanism(HINGE)
    with pytest.raises(InputError):
        load(place)
