"""A drive as an elastic frame, by the displacement method: nodes that move, springs and beams between them.

Nothing of the package: shafts are beam elements of three dimensions (or rigid bodies), bearings are springs to a
housing that stands off, joints are ties between nodes with Lagrange multipliers, cross arms and gaps come from plain
vectors.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from tests.builders.vector_model import VectorModel


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def hat(vector):
    x, y, z = vector
    return np.asarray([[0, -z, y], [z, 0, -x], [-y, x, 0.0]])


@dataclass
class Bearing:
    shaft: int
    x: float
    radial: float = 0.0
    axial: float = 0.0
    tilt: float = 0.0
    offset: tuple = (0.0, 0.0, 0.0)


@dataclass
class Frame:
    """Points of the drive, bearings with stiffnesses (0: does not hold), bodies as (EI, EA) or None where rigid."""

    points: np.ndarray
    yoke_angles: tuple
    bearings: list
    bodies: list
    start_phase: float = 0.0
    slides: dict = field(default_factory=dict)
    splines: dict = field(default_factory=dict)

    def __post_init__(self):
        self.points = np.asarray(self.points, dtype=float)
        self.axes = [unit(b - a) for a, b in pairwise(self.points)]
        self.lengths = [float(np.linalg.norm(b - a)) for a, b in pairwise(self.points)]

    def arms(self, angle):
        model = VectorModel.from_points(self.points.tolist(), self.yoke_angles, self.start_phase)
        driving, driven = model.arms(angle)
        return [np.asarray(u) for u in driving], [np.asarray(v) for v in driven]

    def gap(self, joint, angle, error):
        """Walk along the parts of a joint: shaft, driving journals, cross, driven journals, shaft."""
        u, v = (arm[joint] for arm in self.arms(angle))
        one, two = self.axes[joint], self.axes[joint + 1]
        z = [one, -u, -v, two]
        x2, x3, x4 = np.cross(z[0], z[1]), np.cross(z[1], z[2]), np.cross(z[2], z[3])
        x1 = unit(np.cross(z[3], z[0]))
        return error @ np.asarray([one, x2, x3, x4, x1])

    def couples(self, angle, torque):
        """Return (shaft, x, couple): what bends the shafts at their ends under a torque that resists the output."""
        driving, driven = self.arms(angle)
        found = []
        for i in reversed(range(len(self.points) - 2)):
            normal = np.cross(driving[i], driven[i])
            whole = torque / (normal @ self.axes[i + 1]) * normal
            found.append((i + 1, 0.0, whole))
            found.append((i, self.lengths[i], -whole))
            torque = whole @ self.axes[i]
        return [(s, x, couple - (couple @ self.axes[s]) * self.axes[s]) for s, x, couple in found]

    def solve(self, angle, errors, torque=0.0):
        """Return joint forces on the later shaft, bearing forces and couples on their shafts, and the energy."""
        nodes = []
        for s, length in enumerate(self.lengths):
            places = {0.0: None} if s else {}
            if s < len(self.lengths) - 1:
                places[length] = None
            places |= dict.fromkeys(b.x for b in self.bearings if b.shaft == s)
            if s in self.splines:
                places |= {self.splines[s]: None}
            nodes.append(sorted(places))
        first = np.cumsum([0, *(6 * len(one) for one in nodes)])
        extra = {s: first[-1] + k for k, s in enumerate(self.splines)}
        size = first[-1] + len(extra)

        def at(s, x, kind=0):
            start = first[s] + 6 * nodes[s].index(x) + 3 * kind
            return slice(start, start + 3)

        stiff = np.zeros((size, size))
        push = np.zeros(size)
        ties, values = [], []
        for s, body in enumerate(self.bodies):
            e = self.axes[s]
            across = np.eye(3) - np.outer(e, e)
            for x1, x2 in pairwise(nodes[s]):
                # The half of a spline behind it may move along the shaft: its own freedom, added to the beam's.
                loose = s in self.splines and x1 == self.splines[s]
                rows = np.zeros((12, size))
                for k, (x, kind) in enumerate(((x1, 0), (x1, 1), (x2, 0), (x2, 1))):
                    rows[3 * k : 3 * k + 3, at(s, x, kind)] = np.eye(3)
                if loose:
                    rows[0:3, extra[s]] = e
                if body is None:
                    move = rows[6:9] - rows[0:3] - (x2 - x1) * -hat(e) @ rows[3:6]
                    for equation in (*move, *(rows[9:12] - rows[3:6])):
                        ties.append(equation)
                        values.append(0.0)
                else:
                    stiff += rows.T @ _beam(e, across, x2 - x1, *body) @ rows
            twist = np.zeros(size)
            twist[at(s, nodes[s][0], 1)] = e
            ties.append(twist)
            values.append(0.0)
        for b in self.bearings:
            e = self.axes[b.shaft]
            across = np.eye(3) - np.outer(e, e)
            spring = b.radial * across + b.axial * np.outer(e, e)
            place = at(b.shaft, b.x)
            stiff[place, place] += spring
            push[place] += spring @ np.asarray(b.offset)
            turn = at(b.shaft, b.x, 1)
            stiff[turn, turn] += b.tilt * across
        for s, x, couple in self.couples(angle, torque) if torque else ():
            push[at(s, x, 1)] += couple
        joint_ties = []
        for i in range(len(self.points) - 2):
            u, v = (arm[i] for arm in self.arms(angle))
            directions = [d for d, k in ((u, "driving"), (v, "driven")) if k not in self.slides.get(i, ())]
            directions.append(np.cross(u, v))
            off = self.gap(i, angle, np.asarray(errors[i]))
            for direction in directions:
                tie = np.zeros(size)
                tie[at(i + 1, 0.0)] = direction
                tie[at(i, self.lengths[i])] = -direction
                joint_ties.append((i, len(ties), direction))
                ties.append(tie)
                values.append(direction @ off)
        ties = np.asarray(ties)
        scale = np.max(np.abs(stiff))
        bordered = np.block([[stiff / scale, ties.T], [ties, np.zeros((len(ties), len(ties)))]])
        found = np.linalg.solve(bordered, np.concatenate((push / scale, values)))
        moved, pulls = found[:size], scale * found[size:]
        joint = np.zeros((len(self.points) - 2, 3))
        for i, row, direction in joint_ties:
            joint[i] -= pulls[row] * direction
        force, couple, energy = [], [], 0.5 * moved @ stiff @ moved
        for b in self.bearings:
            e = self.axes[b.shaft]
            across = np.eye(3) - np.outer(e, e)
            spring = b.radial * across + b.axial * np.outer(e, e)
            shift = np.asarray(b.offset) - moved[at(b.shaft, b.x)]
            force.append(spring @ shift)
            couple.append(-b.tilt * across @ moved[at(b.shaft, b.x, 1)])
            here = moved[at(b.shaft, b.x)]
            energy += 0.5 * shift @ spring @ shift - 0.5 * here @ spring @ here
        return joint, np.asarray(force), np.asarray(couple), energy


def _beam(e, across, length, bending, stretching):
    """Stiffness of a beam element between displacement, rotation here and there; axial, bending, and stiff in twist."""
    turn = hat(e)
    k1, k2, k3, k4 = (bending * c for c in (12 / length**3, 6 / length**2, 4 / length, 2 / length))
    along = np.outer(e, e)
    axial = stretching / length * along
    twist = bending / length * along
    # Slope of the beam axis is rotation × e, so couple rows carry e×.
    a = k1 * across + axial
    b = k2 * turn
    return np.block(
        [
            [a, -b, -a, -b],
            [b, k3 * across + twist, -b, k4 * across - twist],
            [-a, b, a, b],
            [b, k4 * across - twist, -b, k3 * across + twist],
        ]
    )
