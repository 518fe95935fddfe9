"""A scene as a binary glTF file: bodies with their colours, turning once and again in any viewer."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from cardan.maths.arrays import Array

from .parts import Scene, SceneBody

FLOAT, INTEGER = 5126, 5125
"""Kinds of numbers in glTF: 32-bit floats, and 32-bit integers without sign."""

VERTICES, INDICES = 34962, 34963
"""What a part of the buffer is for."""

UPRIGHT = [-float(np.sqrt(0.5)), 0.0, 0.0, float(np.sqrt(0.5))]
"""Turn from z up, as here, to y up, as in glTF."""


@dataclass(eq=False)
class _Buffer:
    """Numbers one behind the other, and the views and accessors that find them again."""

    data: bytearray = field(default_factory=bytearray)
    views: list[dict[str, Any]] = field(default_factory=list)
    accessors: list[dict[str, Any]] = field(default_factory=list)

    def add(self, values: Array, kind: str, target: int | None = None) -> int:
        """Add rows of numbers, and return their accessor."""
        whole = np.issubdtype(values.dtype, np.integer)
        raw = np.ascontiguousarray(values, dtype=np.dtype("<u4" if whole else "<f4"))
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": raw.nbytes}
        self.views.append(view if target is None else {**view, "target": target})
        self.data += raw.tobytes()
        made = {
            "bufferView": len(self.views) - 1,
            "componentType": INTEGER if whole else FLOAT,
            "count": len(raw),
            "type": kind,
        }
        if kind == "VEC3" or (kind == "SCALAR" and not whole):
            rows = raw.reshape(len(raw), -1)
            made |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self.accessors.append(made)
        return len(self.accessors) - 1


def render(shown: Scene, *, seconds: float = 4.0) -> bytes:
    """Return a scene as a binary glTF file (.glb), its bodies turning.

    seconds [s]: how long a turn of the input takes.
    Returns: lengths in m, y up, as glTF 2.0 asks (Khronos, ISO/IEC 12113); what is drawn round the bodies is left out.
    """
    buffer = _Buffer()
    materials: dict[tuple[str, bool], int] = {}
    meshes: list[dict[str, Any]] = []
    nodes: list[dict[str, Any]] = []
    children: dict[int, list[int]] = {}
    for body in shown.bodies:
        material = materials.setdefault((body.colour, body.metal), len(materials))
        meshes.append(_mesh(buffer, body, material))
        children.setdefault(body.track, []).append(len(shown.tracks) + len(nodes))
        nodes.append(
            {
                "name": body.name,
                "mesh": len(meshes) - 1,
                "extras": {"part": body.part, "path": body.path, "text": body.text},
            }
        )
    tracks: list[dict[str, Any]] = []
    for number, track in enumerate(shown.tracks):
        origin = np.reshape(track.origin, (-1, 3))[0]
        made = {"name": f"track {number}", "translation": origin.tolist(), "rotation": track.turn[0].tolist()}
        tracks.append({**made, "children": children[number]} if number in children else made)
    root = {"name": shown.name or "drive", "rotation": UPRIGHT, "children": list(range(len(tracks)))}
    return _packed(
        {
            "asset": {"version": "2.0", "generator": "cardan"},
            "scene": 0,
            "scenes": [{"nodes": [len(tracks) + len(nodes)]}],
            "nodes": [*tracks, *nodes, root],
            "meshes": meshes,
            "materials": [_material(colour, metal=metal) for colour, metal in materials],
            "animations": [_turning(buffer, shown, seconds)],
            "accessors": buffer.accessors,
            "bufferViews": buffer.views,
            "buffers": [{"byteLength": len(buffer.data)}],
        },
        bytes(buffer.data),
    )


def normals(body: SceneBody) -> Array:
    """Return the directions of the surface at the corners of a body, array (m, 3): means over their triangles."""
    a, b, c = (body.positions[body.indices[:, k]] for k in range(3))
    area = np.cross(b - a, c - a)
    found = np.zeros_like(body.positions)
    for k in range(3):
        np.add.at(found, body.indices[:, k], area)
    size = np.linalg.norm(found, axis=-1, keepdims=True)
    return np.where(size > 0.0, found / np.where(size > 0.0, size, 1.0), np.asarray([1.0, 0.0, 0.0]))


def _mesh(buffer: _Buffer, body: SceneBody, material: int) -> dict[str, Any]:
    # What no triangle uses, a pole given twice, would have no direction.
    own, indices = np.unique(body.indices, return_inverse=True)
    attributes = {
        "POSITION": buffer.add(body.positions[own], "VEC3", VERTICES),
        "NORMAL": buffer.add(normals(body)[own], "VEC3", VERTICES),
    }
    found = buffer.add(np.ravel(indices).astype(np.uint32), "SCALAR", INDICES)
    return {"name": body.name, "primitives": [{"attributes": attributes, "indices": found, "material": material}]}


def _material(colour: str, *, metal: bool) -> dict[str, Any]:
    share = np.asarray([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return {
        "name": colour,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*linear.round(5).tolist(), 1.0],
            "metallicFactor": 0.35 if metal else 0.0,
            "roughnessFactor": 0.45 if metal else 0.9,
        },
    }


def _turning(buffer: _Buffer, shown: Scene, seconds: float) -> dict[str, Any]:
    """Return the animation of one turn; its end is its beginning."""
    count = len(shown.angle)
    time = buffer.add(np.arange(count + 1) * (seconds / count), "SCALAR")
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    for number, track in enumerate(shown.tracks):
        closing = track.turn[0] * (1.0 if float(track.turn[0] @ track.turn[-1]) >= 0.0 else -1.0)
        moves = [("rotation", np.concatenate((track.turn, closing[None])), "VEC4")]
        if track.origin.ndim == 2:
            moves.append(("translation", np.concatenate((track.origin, track.origin[:1])), "VEC3"))
        for path, values, kind in moves if number else ():
            samplers.append({"input": time, "output": buffer.add(values, kind), "interpolation": "LINEAR"})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": number, "path": path}})
    return {"name": "turn", "samplers": samplers, "channels": channels}


def _packed(tree: dict[str, Any], data: bytes) -> bytes:
    """Return the file: its header, then the description and the numbers, each filled up to four bytes."""
    text = json.dumps(tree, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode("utf-8")
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    whole = 12 + 8 + len(text) + 8 + len(data)
    return b"".join(
        (
            struct.pack("<III", 0x46546C67, 2, whole),
            struct.pack("<II", len(text), 0x4E4F534A),
            text,
            struct.pack("<II", len(data), 0x004E4942),
            data,
        )
    )
