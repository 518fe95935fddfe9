"""Another program's kinematics: MuJoCo knows bodies, hinges and pinned points, and no word of our theory.

Each shaft is a body on a hinge in the world; each cross is a body on a hinge in the driving yoke, and the tips of its
other arm are pinned into the driven yoke. MuJoCo gives how far the pins are apart and the Jacobian of that; Newton's
method on those two closes the loops at every input angle. What is left is rounding.
"""

import numpy as np
import pytest

from cardan import Drive, motion
from cardan.units import deg
from tests.builders.vector_model import VectorModel

mujoco = pytest.importorskip("mujoco")

POINTS = [(-0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (1.1, 0.25, -0.30), (1.9, 0.10, 0.15), (2.6, 0.45, 0.20)]
YOKES = (0.6, -1.1)
START = 0.35

CLOSED = 1e-14
"""Pins of a cross of 1 m closer than this [m] are together."""


def text(vector):
    return " ".join(repr(float(x)) for x in vector)


def body(name, place, axis, inside=""):
    return (
        f'<body name="{name}" pos="{text(place)}"><joint name="{name}" type="hinge" axis="{text(axis)}"/>'
        f'<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{inside}</body>'
    )


def assembled():
    """Return the mechanism standing at its start: arms at right angles to their shafts and to each other."""
    start = VectorModel.from_points(POINTS, YOKES, START)
    driving, driven = start.arms(0.0)
    crosses = [body(f"cross{i}", (0, 0, 0), u) for i, u in enumerate(driving, start=1)] + [""]
    # A shaft's body stands at the joint that it drives, the last one at the joint that drives it.
    shafts = [
        body(f"shaft{i}", POINTS[min(i, len(POINTS) - 2)], axis, crosses[i - 1])
        for i, axis in enumerate(start.axes, start=1)
    ]
    pins = [
        f'<connect body1="cross{i}" body2="shaft{i + 1}" anchor="{text(sign * np.asarray(v))}"/>'
        for i, v in enumerate(driven, start=1)
        for sign in (1, -1)
    ]
    return mujoco.MjModel.from_xml_string(
        '<mujoco><compiler angle="radian"/><option jacobian="dense" gravity="0 0 0"/>'
        f"<worldbody>{''.join(shafts)}</worldbody><equality>{''.join(pins)}</equality></mujoco>"
    )


class Mechanism:
    def __init__(self):
        self.model = assembled()
        self.data = mujoco.MjData(self.model)
        names = [f"shaft{i}" for i in range(1, len(POINTS))]
        self.shafts = [self.model.joint(name).qposadr[0] for name in names]
        self.rest = [k for k in range(self.model.nv) if k != self.shafts[0]]

    def apart(self):
        mujoco.mj_fwdPosition(self.model, self.data)
        rows = self.data.nefc
        return self.data.efc_pos[:rows].copy(), self.data.efc_J.reshape(-1, self.model.nv)[:rows].copy()

    def close(self, angle):
        """Turn the input there and bring all pins together."""
        self.data.qpos[self.shafts[0]] = angle
        for _ in range(20):
            gap, slope = self.apart()
            if np.max(np.abs(gap)) < CLOSED:
                break
            self.data.qpos[self.rest] -= np.linalg.lstsq(slope[:, self.rest], gap, rcond=1e-10)[0]
        assert np.max(np.abs(gap)) < CLOSED
        speed = np.zeros(self.model.nv)
        speed[self.shafts[0]] = 1.0
        speed[self.rest] = -np.linalg.lstsq(slope[:, self.rest], slope[:, self.shafts[0]], rcond=1e-10)[0]
        assert np.max(np.abs(slope @ speed)) < 1e-13, "the mechanism has no motion through this place"
        return self.data.qpos[self.shafts].copy(), speed[self.shafts]


def test_the_mechanism_moves_in_one_way_only():
    mechanism = Mechanism()
    gap, slope = mechanism.apart()
    assert np.max(np.abs(gap)) < CLOSED, "assembled by right angles alone, it must fit"
    assert mechanism.model.nv == 7
    assert np.linalg.matrix_rank(slope, tol=1e-9) == 6


def test_a_spatial_three_joint_chain_turns_as_mujocos_bodies_do():
    """Over more than a turn to both sides, every shaft: angles and speed ratios."""
    mechanism = Mechanism()
    drive = Drive.from_points(POINTS, yoke_angles=YOKES, start_phase=START)
    for side in (1, -1):
        mechanism.data.qpos[:] = 0.0
        angles = side * np.arange(0, 400, 4) * deg
        found = [mechanism.close(angle) for angle in angles]
        mine = motion(drive, angles)
        # Pins of 1 m arms closed to 1e-14; the Jacobian's condition is a few tens, and quaternions of 7 rad round too.
        assert np.max(np.abs(np.stack([turned for turned, _ in found], axis=-1) - mine.shaft_angle)) < 1e-12
        assert np.max(np.abs(np.stack([speed for _, speed in found], axis=-1) - mine.shaft_ratio)) < 1e-12


def test_the_oracle_would_notice_a_wrong_sense_of_the_yoke_angle():
    mechanism = Mechanism()
    for angle in np.arange(0, 60, 5) * deg:
        turned, _speed = mechanism.close(angle)
    wrong = Drive.from_points(POINTS, yoke_angles=[-yoke for yoke in YOKES], start_phase=START)
    assert abs(motion(wrong, [55 * deg]).output_angle[0] - turned[-1]) > 1e-3
