"""Mechanisms whose mobility is known, and random ones."""

from __future__ import annotations

import numpy as np

from cardan.mechanism.mechanism import PAIRS, Mechanism, Pair


def row(vector):
    return tuple(float(x) for x in vector)


def pair(name, kind, links, point, axis=None, axis2=None, pitch=None):
    return Pair(
        id=name,
        type=kind,
        links=tuple(links),
        point=row(point),
        axis=None if axis is None else row(axis),
        axis2=None if axis2 is None else row(axis2),
        pitch=pitch,
    )


def hooke(joint_angle=0.5, phase=0.3, *, kinds="RRRR", cross=np.pi / 2):
    """A Hooke joint between two bearings: A(0-1), pins B(1-2), C(2-3), D(3-0); ``cross`` is the angle of its arms."""
    first, second = np.array([0.0, 0, 1]), np.array([np.sin(joint_angle), 0, np.cos(joint_angle)])
    b = np.array([np.cos(phase), np.sin(phase), 0.0])
    c = np.cross(second, b)
    c = c / np.linalg.norm(c) if np.linalg.norm(c) > 1e-12 else first
    if cross != np.pi / 2:  # a spherical four-bar: the second arm at another angle to shaft 2
        c = np.cos(cross) * second + np.sin(cross) * c
    where = [-0.3 * first, np.zeros(3), np.zeros(3), 0.4 * second]
    ends = [("0", "1"), ("1", "2"), ("2", "3"), ("3", "0")]
    joints = [
        pair(name, kind, links, point, axis)
        for name, kind, links, point, axis in zip("ABCD", split(kinds), ends, where, (first, b, c, second), strict=True)
    ]
    return Mechanism(frame="0", joints=tuple(joints), input_link="1", output_link="3")


def split(kinds):
    """Codes of pairs in a word, SG, L4 and PT as one."""
    found = []
    while kinds:
        size = 2 if kinds[:2] in PAIRS else 1
        found.append(kinds[:size])
        kinds = kinds[size:]
    return found


def chain(kinds, points, axes, ends, *, given="1", taken=""):
    """Joints one by one."""
    joints = [
        pair(f"{a}-{b}", kind, (a, b), point, axis)
        for kind, point, axis, (a, b) in zip(split(kinds), points, axes, ends, strict=True)
    ]
    return Mechanism(frame="0", joints=tuple(joints), input_link=given, output_link=taken)


def crank_slider(kinds="RRRP", out=1e-1):
    """A crank of 50 mm, a rod to (200, 0, 0) and a slide along x; axes along z."""
    z, x = (0, 0, 1), (1, 0, 0)
    points = [(0, 0, 0), (0.03, 0.04, 0), (0.2, 0, 0), (0.2, 0, 0)]
    ends = [("0", "1"), ("1", "2"), ("2", "3"), ("3", "0")]
    return chain(kinds, points, [z, z, z, x], ends, taken="3")


def anyhow(rng, links=4, loops=2):
    """A connected mechanism of random pairs in random places: no geometry is special."""
    names = [str(k) for k in range(links + 1)]
    ends = [(names[int(rng.integers(0, k))], names[k]) for k in range(1, links + 1)]
    for _loop in range(loops):
        a, b = rng.choice(links + 1, 2, replace=False)
        ends.append((names[int(a)], names[int(b)]))
    joints = []
    for k, links_here in enumerate(ends):
        kind = str(rng.choice(list(PAIRS)))
        axis, other = rng.normal(size=(2, 3))
        if kind == "L4":
            other -= axis * (axis @ other) / (axis @ axis)
        joints.append(
            pair(
                f"j{k}",
                kind,
                links_here,
                rng.normal(size=3),
                axis,
                other if PAIRS[kind].needs_second else None,
                0.1 if kind == "H" else None,
            )
        )
    return Mechanism(frame="0", joints=tuple(joints), input_link="1", output_link=names[-1])
