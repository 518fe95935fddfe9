"""A made-up scene in the form of ``cardan.scene.scene``: four shafts at angles, turning evenly about their axes.

It knows nothing of joints: what the browser draws is compared with it, not with a drive.
"""

from __future__ import annotations

from functools import partial
from math import cos, hypot, pi, sin, tau
from typing import Any

FRAMES = 72
SEGMENTS = 28
CENTRES = ((0.0, 0.0, 0.0), (0.7, 0.05, -0.08), (1.3, 0.0, -0.2), (1.9, 0.12, -0.24))
ENDS = ((-0.4, 0.0, 0.0), (2.3, 0.12, -0.24))
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9")

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Mesh = tuple[list[float], list[int]]


def times(p: Quaternion, q: Quaternion) -> Quaternion:
    """Return the turn q followed by the turn p."""
    (a, b, c, d), (e, f, g, h) = p, q
    return (
        d * e + a * h + b * g - c * f,
        d * f - a * g + b * h + c * e,
        d * g + a * f - b * e + c * h,
        d * h - a * e - b * f - c * g,
    )


def about(axis: Vector, angle: float) -> Quaternion:
    """Return a turn about an axis of length 1."""
    s = sin(angle / 2)
    return (axis[0] * s, axis[1] * s, axis[2] * s, cos(angle / 2))


def from_x(axis: Vector) -> Quaternion:
    """Return the shortest turn of the x axis into ``axis``."""
    size = hypot(0.0, -axis[2], axis[1], 1.0 + axis[0])
    return (0.0, -axis[2] / size, axis[1] / size, (1.0 + axis[0]) / size)


def rod(along: int, start: float, end: float, radius: float) -> Mesh:
    """Return a closed cylinder along one of the axes."""
    positions: list[float] = []
    indices: list[int] = []
    for place in (start, end):
        for k in range(SEGMENTS):
            y, z = radius * cos(tau * k / SEGMENTS), radius * sin(tau * k / SEGMENTS)
            point = [0.0, 0.0, 0.0]
            point[along], point[(along + 1) % 3], point[(along + 2) % 3] = place, y, z
            positions += point
    for k in range(SEGMENTS):
        a, b = k, (k + 1) % SEGMENTS
        indices += [a, b, b + SEGMENTS, a, b + SEGMENTS, a + SEGMENTS]
        if 0 < k < SEGMENTS - 1:
            indices += [0, k + 1, k, SEGMENTS, SEGMENTS + k, SEGMENTS + k + 1]
    return positions, indices


def box(low: Vector, high: Vector) -> Mesh:
    """Return a block between two corners."""
    positions = [(low, high)[n >> axis & 1][axis] for n in range(8) for axis in range(3)]
    sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return positions, [corner for a, b, c, d in sides for corner in (a, b, c, a, c, d)]


def yoke(sign: float, quarter: bool) -> list[Mesh]:
    """Return the two arms of a fork that reaches over the joint, its base towards ``sign``."""
    ends = sorted((-0.02 * sign, 0.09 * sign))
    arms = []
    for side in (-1.0, 1.0):
        across = sorted((0.045 * side, 0.06 * side))
        if quarter:
            arms.append(box((ends[0], -0.02, across[0]), (ends[1], 0.02, across[1])))
        else:
            arms.append(box((ends[0], across[0], -0.02), (ends[1], across[1], 0.02)))
    base = sorted((0.075 * sign, 0.09 * sign))
    reach = (0.02, 0.06) if quarter else (0.06, 0.02)
    return [*arms, box((base[0], -reach[0], -reach[1]), (base[1], reach[0], reach[1]))]


def joined(meshes: list[Mesh], shift: float = 0.0) -> Mesh:
    """Return several meshes as one, moved along x."""
    positions: list[float] = []
    indices: list[int] = []
    for points, corners in meshes:
        first = len(positions) // 3
        positions += [p + shift if k % 3 == 0 else p for k, p in enumerate(points)]
        indices += [first + corner for corner in corners]
    return positions, indices


def body(mesh: Mesh, part: str, number: int, track: int, colour: str, utilisation: float | None, path: str) -> Any:
    """Return one body as the scene describes it."""
    return {
        "name": f"{part} {number}",
        "part": part,
        "number": number,
        "path": path,
        "text": f"{part.capitalize()} {number}"
        + ("" if utilisation is None else f"; {100 * utilisation:.0f} % of the limit"),
        "track": track,
        "positions": mesh[0],
        "indices": mesh[1],
        "smooth": part in {"tube", "cross"},
        "colour": colour,
        "metal": part != "support",
        "utilisation": utilisation,
        "utilisation_colour": "#888888" if utilisation is None else "#1b7837",
    }


def scene(*, radius: float = 0.035, frames: int = FRAMES) -> dict[str, Any]:
    """Return four joints and five shafts that turn, with one of each thing a scene can hold."""
    points = (ENDS[0], *CENTRES, ENDS[1])
    tracks: list[dict[str, Any]] = [{"origin": [0.0, 0.0, 0.0], "turn": [0.0, 0.0, 0.0, 1.0] * frames}]
    bodies: list[Any] = []
    axes: list[Vector] = []
    for k in range(5):
        start, end = points[k], points[k + 1]
        span = [b - a for a, b in zip(start, end, strict=True)]
        length = hypot(*span)
        axes.append((span[0] / length, span[1] / length, span[2] / length))
        spin = partial(about, (1.0, 0.0, 0.0))
        turns = [times(from_x(axes[k]), spin(tau * n / frames + k * pi / 2)) for n in range(frames)]
        tracks.append({"origin": list(start), "turn": [number for turn in turns for number in turn]})
        first, last = (0.0 if k == 0 else 0.09), (length if k == 4 else length - 0.09)
        tube = rod(0, first, last, radius)
        bodies.append(body(tube, "tube", k + 1, k + 1, COLOURS[k], 0.2 * k, f"shafts[{k + 1}]"))
        if k > 0:
            bodies.append(body(joined(yoke(1.0, True)), "driven yoke", k, k + 1, COLOURS[k], 0.5, f"joints[{k - 1}]"))
        if k < 4:
            fork = joined(yoke(-1.0, False), length)
            bodies.append(body(fork, "driving yoke", k + 1, k + 1, COLOURS[k], 0.4, f"joints[{k}]"))
    for k, centre in enumerate(CENTRES):
        cross = joined([rod(1, -0.058, 0.058, 0.011), rod(2, -0.058, 0.058, 0.011)])
        tracks.append({"origin": list(centre), "turn": tracks[k + 1]["turn"]})
        bodies.append(body(cross, "cross", k + 1, len(tracks) - 1, "#9aa0a6", None, f"joints[{k}]"))
    block = box((-0.25, -0.06, -0.15), (-0.19, 0.06, -0.04))
    bodies.append(body(block, "support", 1, 0, "#5f6b76", None, "supports[0]"))
    still = [list(CENTRES[1]) for _n in range(frames)]
    force = [[0.0, 0.15 * cos(2 * tau * n / frames), 0.2] for n in range(frames)]
    flat = lambda rows: [number for row in rows for number in row]  # noqa: E731
    middle = [[x, 0.02 * sin(x), -0.1 * x + 0.03 * sin(3 * x) * cos(tau * n / 24)] for n in range(24) for x in AXIS]
    return {
        "name": "made up",
        "centre": [0.95, 0.05, -0.12],
        "size": 2.7,
        "frames": frames,
        "angle": [tau * n / frames for n in range(frames)],
        "tracks": tracks,
        "bodies": bodies,
        "lines": [
            {"group": "axes", "points": flat(points), "colour": "#888888", "dashed": True, "width": 1.0},
            {"group": "planes", "points": flat(points[1:4]), "colour": "#0072b2", "dashed": False, "width": 1.5},
        ],
        "areas": [
            {
                "group": "planes",
                "positions": flat(points[1:4]),
                "indices": [0, 1, 2],
                "colour": "#0072b2",
                "opacity": 0.2,
                "text": "plane of joint 2",
            }
        ],
        "labels": [
            {"group": "names", "text": f"joint {k + 1}", "at": list(centre), "role": "joint"}
            for k, centre in enumerate(CENTRES)
        ],
        "arrows": [
            {
                "group": "forces",
                "text": "joint 2: 870 N",
                "colour": "#d55e00",
                "curl": False,
                "from": flat(still),
                "vector": flat(force),
                "scale": 4000.0,
                "unit": "N",
                "decimal": ".",
            },
            {
                "group": "couples",
                "text": "joint 3: 95 N·m",
                "colour": "#0072b2",
                "curl": True,
                "from": list(CENTRES[2]),
                "vector": [0.2, 0.0, 0.05],
                "scale": 400.0,
                "unit": "N·m",
                "decimal": ".",
            },
        ],
        "modes": [
            {
                "name": "whirl 1",
                "text": "first critical speed",
                "kind": "whirl",
                "frames": 24,
                "turns": {},
                "curves": [{"points": flat(middle), "colour": "#d55e00", "radius": 0.02}],
            },
            {
                "name": "torsion 1",
                "text": "first torsional mode",
                "kind": "torsion",
                "frames": 24,
                "turns": {"2": flat(about(axes[1], 0.5 * sin(tau * n / 24)) for n in range(24))},
                "curves": [],
            },
        ],
        "groups": [
            {"name": name, "title": name.capitalize(), "on": name in {"axes", "names"}}
            for name in ("axes", "planes", "names", "forces", "couples")
        ],
        "scale": [
            {"value": 0.0, "colour": "#d8e6f3", "text": "unused"},
            {"value": 1.0, "colour": "#b3261e", "text": "over the limit"},
        ],
        "missing": {},
    }


AXIS = tuple(2.3 * k / 40 for k in range(41))
