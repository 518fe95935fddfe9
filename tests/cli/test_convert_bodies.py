"""convert to .glb: a turning model in space."""

import json
import struct

from cardan.mechanisms import load_mechanism
from tests.cli.conftest import EXAMPLES

TRUCK = EXAMPLES / "truck-supports.toml"


def test_a_drive_is_written_as_bodies_that_turn(cardan, tmp_path):
    done = cardan("convert", TRUCK, "truck.glb", "--json")
    assert done.code == 0
    data = (tmp_path / "truck.glb").read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    (size,) = struct.unpack_from("<I", data, 12)
    tree = json.loads(data[20 : 20 + size])
    assert tree["nodes"][-1]["name"] == "truck with centre bearing"
    assert done.content["bodies"] == len(tree["meshes"])
    assert cardan("convert", TRUCK, "truck.glb").code == 2
    assert "--force" in cardan("convert", TRUCK, "truck.glb").err


def test_bodies_have_no_form(cardan):
    done = cardan("convert", TRUCK, "truck.glb", "--form", "angles")
    assert done.code == 2
    assert "--form" in done.err


def test_a_mechanism_is_converted_too(cardan, tmp_path):
    path = EXAMPLES / "mechanisms" / "slot-cam.toml"
    done = cardan("convert", path, tmp_path / "cam.glb", "--json")
    assert (done.code, done.content["bodies"]) == (0, 4)
    assert (tmp_path / "cam.glb").read_bytes()[:4] == b"glTF"
    assert cardan("convert", path, tmp_path / "cam.json").code == 0
    assert load_mechanism(tmp_path / "cam.json") == load_mechanism(path)
    assert "none of these forms" in cardan("convert", path, "-", "--form", "points").err
