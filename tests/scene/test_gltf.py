"""Binary glTF: read back by the rules of the format, it holds the bodies of the scene, in place and turning."""

import json
import struct

import numpy as np
import pytest

from cardan import example
from cardan import joints as kinds
from cardan.drive.drive import Drive
from cardan.scene.gltf import render
from cardan.scene.scene import scene

KIND = {5126: np.dtype("<f4"), 5125: np.dtype("<u4")}
WIDTH = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


def read(data):
    """Return the description of a .glb file and a function that reads its accessors."""
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, name = struct.unpack_from("<I4s", data, 12)
    assert name == b"JSON"
    assert size % 4 == 0
    tree = json.loads(data[20 : 20 + size])
    held, name = struct.unpack_from("<I4s", data, 20 + size)
    assert name == b"BIN\0"
    numbers = data[28 + size :]
    assert len(numbers) == held >= tree["buffers"][0]["byteLength"]

    def rows(index):
        accessor = tree["accessors"][index]
        view = tree["bufferViews"][accessor["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        raw = numbers[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        values = np.frombuffer(raw, KIND[accessor["componentType"]]).reshape(accessor["count"], WIDTH[accessor["type"]])
        if "min" in accessor:
            np.testing.assert_array_equal(values.min(axis=0), np.float32(accessor["min"]))
            np.testing.assert_array_equal(values.max(axis=0), np.float32(accessor["max"]))
        return values

    return tree, rows


DRIVES = {
    "truck": example("truck-supports"),
    "tripod": Drive(joints=(kinds.Tripod(joint_angle=0.3), kinds.Rzeppa(joint_angle=0.4))),
}


@pytest.mark.parametrize("name", DRIVES)
def test_a_file_holds_the_bodies_with_normals_that_look_outwards(name):
    shown = scene(DRIVES[name], frames=24)
    tree, rows = read(render(shown))
    assert tree["asset"]["version"] == "2.0"
    nodes = [node for node in tree["nodes"] if "mesh" in node]
    assert [node["name"] for node in nodes] == [body.name for body in shown.bodies]
    for node, body in zip(nodes, shown.bodies, strict=True):
        (primitive,) = tree["meshes"][node["mesh"]]["primitives"]
        points, normal = (rows(primitive["attributes"][key]) for key in ("POSITION", "NORMAL"))
        corners = rows(primitive["indices"]).reshape(-1, 3)
        # Lengths of the scene as 32-bit numbers.
        np.testing.assert_allclose(points[corners], body.positions[body.indices], rtol=1e-6, atol=1e-7)
        np.testing.assert_allclose(np.linalg.norm(normal, axis=-1), 1.0, atol=1e-5)
        a, b, c = (points[corners[:, k]].astype(float) for k in range(3))
        flat = np.cross(b - a, c - a)
        large = np.linalg.norm(flat, axis=-1) > 1e-12
        assert np.all(np.sum(flat * normal[corners].mean(axis=1), axis=-1)[large] > 0.0)
        assert node["extras"]["path"] == body.path


@pytest.mark.parametrize("name", DRIVES)
def test_a_turn_lasts_as_long_as_told_and_ends_where_it_began(name):
    shown = scene(DRIVES[name], frames=24)
    tree, rows = read(render(shown, seconds=3.0))
    (animation,) = tree["animations"]
    time = rows(animation["samplers"][0]["input"])[:, 0]
    np.testing.assert_allclose(time, np.linspace(0.0, 3.0, 25), rtol=1e-6)
    paths = {(one["target"]["node"], one["target"]["path"]) for one in animation["channels"]}
    assert {(k, "rotation") for k in range(1, len(shown.tracks))} <= paths
    assert any(path == "translation" for _node, path in paths) == (name == "tripod")
    for sampler in animation["samplers"]:
        values = rows(sampler["output"])
        assert len(values) == 25
        np.testing.assert_allclose(np.abs(values[-1]), np.abs(values[0]), atol=1e-6)


def test_bodies_hang_on_their_tracks_below_a_root_that_stands_up():
    shown = scene(DRIVES["truck"], frames=24)
    tree, _rows = read(render(shown))
    root = tree["nodes"][tree["scenes"][0]["nodes"][0]]
    x, y, z, w = root["rotation"]
    # The z axis of the scene points along the y axis of the file.
    assert (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)) == pytest.approx((0, 1, 0), abs=1e-12)
    for number, body in enumerate(shown.bodies):
        assert len(shown.tracks) + number in tree["nodes"][body.track]["children"]
    assert sorted(root["children"]) == list(range(len(shown.tracks)))
