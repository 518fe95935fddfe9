"""Another program's closed loops: each kind of joint as MuJoCo's bodies on hinges and slides, its loops closed by pins.

MuJoCo knows nothing of our theory: it gives how far the points pinned together are apart, and the Jacobian of that.
Newton's method closes the loops; the rates and, by virtual work, the forces in the pins follow from the same Jacobian.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from cardan.drive.joints import Hooke, Joint
from cardan.joints import Clemens, ClemensProfile, DoubleCardan, OffsetCross, PinCoupling, Tracta, Tripod, Weiss
from cardan.questions.motion.joint_mechanism import joint_carried

mujoco = pytest.importorskip("mujoco")

BEND = 0.35
E1, Y, N = np.eye(3)
E2 = np.cos(BEND) * E1 + np.sin(BEND) * Y
P2 = np.cos(BEND) * Y - np.sin(BEND) * E1

CLOSED = 1e-13
"""Points [m] closer than this are together."""

NOT_HELD = 1e-10
"""Singular values below this share of the largest: what two pins hold twice."""


@dataclass
class Body:
    """A body at a place, its joints in it and what hangs on it; unturned where it is drawn."""

    name: str
    at: np.ndarray
    joints: str
    inside: str = ""
    sites: tuple[tuple[str, np.ndarray], ...] = ()

    def xml(self, parent: np.ndarray) -> str:
        places = "".join(f'<site name="{name}" pos="{row(at - self.at)}"/>' for name, at in self.sites)
        weight = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
        return (
            f'<body name="{self.name}" pos="{row(self.at - parent)}">{self.joints}{weight}{places}{self.inside}</body>'
        )


def row(vector) -> str:
    return " ".join(repr(float(x)) for x in vector)


def hinge(name, axis):
    return f'<joint name="{name}" type="hinge" axis="{row(axis)}"/>'


def slide(name, axis):
    return f'<joint name="{name}" type="slide" axis="{row(axis)}"/>'


ORIGIN = np.zeros(3)


class Loop:
    """A mechanism of bodies whose points are pinned together in pairs: sites a and b of each."""

    def __init__(self, bodies: list[Body], pins: tuple[str, ...], sites: str = "", welds: str = "") -> None:
        closed = "".join(f'<connect site1="{one}a" site2="{one}b"/>' for one in pins) + welds
        world = sites + "".join(one.xml(ORIGIN) for one in bodies)
        self.model = mujoco.MjModel.from_xml_string(
            '<mujoco><compiler angle="radian"/><option jacobian="dense" gravity="0 0 0"/>'
            f"<worldbody>{world}</worldbody><equality>{closed}</equality></mujoco>"
        )
        self.data = mujoco.MjData(self.model)
        self.pins = pins
        self.first = self.model.joint("input").dofadr[0]
        self.rest = [k for k in range(self.model.nv) if k != self.first]

    def output(self):
        """Return how fast the output turns per speed of each joint, and how far it has turned."""
        last = self.model.joint("output").dofadr[0]
        return np.eye(self.model.nv)[last], self.data.qpos[last]

    def apart(self):
        mujoco.mj_fwdPosition(self.model, self.data)
        rows = self.data.nefc
        return self.data.efc_pos[:rows].copy(), self.data.efc_J.reshape(-1, self.model.nv)[:rows].copy()

    def close(self, angle: float):
        """Turn the input there, bring all pins together, and return the Jacobian."""
        self.data.qpos[self.first] = angle
        for _ in range(40):
            gap, slope = self.apart()
            if np.max(np.abs(gap)) < CLOSED:
                return slope
            self.data.qpos[self.rest] -= np.linalg.lstsq(slope[:, self.rest], gap, rcond=NOT_HELD)[0]
        raise AssertionError("the loops do not close")

    def turned(self, angle: float):
        """Return the angle of the output, its speed ratio, the torque that drives and the force in each pin."""
        slope = self.close(angle)
        speed = np.ones(self.model.nv)
        speed[self.rest] = -np.linalg.lstsq(slope[:, self.rest], slope[:, self.first], rcond=NOT_HELD)[0]
        turns, place = self.output()
        drive = np.zeros((self.model.nv, 1))
        drive[self.first] = 1.0
        columns = np.concatenate((slope.T, drive), axis=1)
        held, *_ = np.linalg.lstsq(columns, turns, rcond=NOT_HELD)
        assert np.max(np.abs(columns @ held - turns)) < 1e-9
        forces = np.linalg.norm(np.reshape(held[: 3 * len(self.pins)], (-1, 3)), axis=-1)
        return place, turns @ speed, held[-1], dict(zip(self.pins, forces, strict=True))


def shaft(name: str, axis, inside: str = "", sites=(), *, floats: str = "") -> Body:
    return Body(name, ORIGIN, floats + hinge(name, axis), inside, tuple(sites))


def hooke() -> Loop:
    u, v = Y, np.cross(E2, Y) / np.linalg.norm(np.cross(E2, Y))
    tips = [(f"tip{k}", sign * 0.05 * v) for k, sign in enumerate((1.0, -1.0))]
    cross = Body("cross", ORIGIN, hinge("cross", u), sites=tuple((f"{name}a", at) for name, at in tips))
    two = shaft("output", E2, sites=[(f"{name}b", at) for name, at in tips])
    return Loop([shaft("input", E1, cross.xml(ORIGIN)), two], ("tip0", "tip1"))


def tripod() -> Loop:
    """Rollers slide in the tracks of the housing, and on the arms of a spider whose shaft keeps its direction."""
    radius = 0.02
    tracks, arms = "", ""
    for k in range(3):
        c, s = np.cos(2.0 * np.pi * k / 3.0), np.sin(2.0 * np.pi * k / 3.0)
        at, way = radius * (c * Y + s * N), c * P2 + s * N
        tracks += Body(f"roller{k}", at, slide(f"track{k}", E1), sites=((f"arm{k}a", at),)).xml(ORIGIN)
        on = radius * way
        arms += Body(f"end{k}", on, slide(f"way{k}", way), sites=((f"arm{k}b", on),)).xml(ORIGIN)
    floats = slide("aside", P2) + slide("up", N)
    return Loop([shaft("input", E1, tracks), shaft("output", E2, arms, floats=floats)], ("arm0", "arm1", "arm2"))


def swinging(first, axis, tip, other, axis2, tip2) -> Loop:
    """Return two shafts with an arm each, hinged on them, which meet in one point."""
    one = Body("one", first, hinge("one", axis), sites=(("contacta", tip),)).xml(ORIGIN)
    two = Body("two", other, hinge("two", axis2), sites=(("contactb", tip2),)).xml(ORIGIN)
    return Loop([shaft("input", E1, one), shaft("output", E2, two)], ("contact",))


def weiss() -> Loop:
    first, second, radius = 0.004, 0.005, 0.03
    a, b = -first * E1, second * E2
    return swinging(a, N, a + radius * Y, b, N, b + radius * P2)


CLEMENS = Clemens(
    driving=ClemensProfile(axial=0.05, radial=0.02, radius=0.06),
    driven=ClemensProfile(axial=0.05, radial=0.021, radius=0.06),
)


def clemens() -> Loop:
    a, b = -0.05 * E1 + 0.02 * Y, 0.05 * E2 + 0.021 * P2
    middle = 0.07 * (Y + P2) / np.linalg.norm(Y + P2)
    return swinging(
        a,
        N,
        a + 0.06 * (middle - a) / np.linalg.norm(middle - a),
        b,
        N,
        b + 0.06 * (middle - b) / np.linalg.norm(middle - b),
    )


def pins() -> Loop:
    slant = np.pi / 4
    one, two = np.cos(slant) * E1 + np.sin(slant) * Y, -np.cos(slant) * E2 + np.sin(slant) * P2
    first, second = -0.05 * E1 + 0.06 * one, 0.06 * E2 + 0.07 * two
    a = Body("one", first, slide("one", one), sites=(("contacta", first),)).xml(ORIGIN)
    b = Body("two", second, slide("two", two), sites=(("contactb", second),)).xml(ORIGIN)
    return Loop([shaft("input", E1, a), shaft("output", E2, b)], ("contact",))


def double_cardan() -> Loop:
    """Two crosses, the piece between them, and a ball of the driving shaft that slides along the driven one."""
    apart, ratio = 0.08, 0.45
    near = ratio * apart
    far = np.sqrt(apart**2 - (near * np.sin(BEND)) ** 2) - near * np.cos(BEND)
    one, two = -near * E1, far * E2
    inner = N
    ends = [(f"end{k}", two + sign * 0.03 * Y_OF_TWO) for k, sign in enumerate((1.0, -1.0))]
    second = Body("second", two, hinge("second", inner), sites=tuple((f"{name}a", at) for name, at in ends)).xml(one)
    piece = Body("piece", one, hinge("piece", inner), second).xml(one)
    first = Body("first", one, hinge("first", Y), piece).xml(ORIGIN)
    ball = Body("slider", ORIGIN, slide("slider", E2), sites=(("ballb", ORIGIN),)).xml(ORIGIN)
    floats = slide("along", E2) + slide("aside", P2) + slide("up", N)
    driven = shaft("output", E2, ball, [(f"{name}b", at) for name, at in ends], floats=floats)
    return Loop([shaft("input", E1, first, [("balla", ORIGIN)]), driven], ("end0", "end1", "ball"))


Y_OF_TWO = P2
"""Arm of the second cross in the driven yoke where the driving yoke lies in the plane of the shafts."""


def tracta() -> Loop:
    """Two halves that swivel in their forks, and a face on which they slide and turn: two slides and a hinge."""
    a, b = -0.03 * E1, 0.036 * E2
    u = Y
    face = np.cross(u, b - a) / np.linalg.norm(np.cross(u, b - a))
    v = np.cross(face, E2) / np.linalg.norm(np.cross(face, E2))
    along = np.cross(face, u)
    last = Body("plate", a, hinge("turned", face), sites=(("face", ORIGIN),)).xml(a)
    half = Body("half", a, hinge("half", u), Body("s", a, slide("s", u) + slide("t", along), last).xml(a)).xml(ORIGIN)
    other = Body("other", b, hinge("other", v), sites=(("mate", ORIGIN),)).xml(ORIGIN)
    weld = '<weld site1="face" site2="mate"/>'
    return Loop([shaft("input", E1, half), shaft("output", E2, other)], (), welds=weld)


class Wobbling(Loop):
    """A loop whose driven shaft turns about an axis that moves."""

    def output(self):
        rates, moves = np.zeros((3, self.model.nv)), np.zeros((3, self.model.nv))
        number = self.model.body("driven").id
        mujoco.mj_jacBody(self.model, self.data, moves, rates, number)
        turn = np.reshape(self.data.xmat[number], (3, 3))
        mark = turn @ ARM
        return rates.T @ (turn @ self.along), np.arctan2(mark @ N, mark @ P2)


ARM = np.cross(E2, Y) / np.linalg.norm(np.cross(E2, Y))
"""Driven pin of a cross whose driving pin lies in the plane of the shafts."""


def offset_cross() -> Loop:
    """The driven shaft hangs on the second pin of the cross and slides through a ball of the frame."""
    offset, reach = 0.02, 0.2
    u, v = Y, ARM
    pin = offset * np.cross(u, v)
    held = reach * E2
    way = (held - pin) / np.linalg.norm(held - pin)
    end = Body("end", held, slide("end", way), sites=(("ballb", held),)).xml(pin)
    driven = Body("driven", pin, hinge("driven", v), end).xml(ORIGIN)
    cross = Body("cross", ORIGIN, hinge("cross", u), driven).xml(ORIGIN)
    site = f'<site name="balla" pos="{row(held)}"/>'
    found = Wobbling([shaft("input", E1, cross)], ("ball",), sites=site)
    found.along = way
    return found


CASES: dict[str, tuple[Joint, object, dict[str, str]]] = {
    "hooke": (Hooke(), hooke, {}),
    "tripod": (Tripod(track_radius=0.02), tripod, {f"arm{k}": f"arm {{count}} {k + 1}" for k in range(3)}),
    "weiss": (
        Weiss(driving_offset=0.004, driven_offset=0.005, groove_radius=0.03, balls=1),
        weiss,
        {"contact": "ball {count} 1"},
    ),
    "clemens": (CLEMENS, clemens, {"contact": "contact 1"}),
    "pin_coupling": (
        PinCoupling(driving_distance=0.05, driven_distance=0.06),
        pins,
        {"contact": "driving pin 1"},
    ),
    "double_cardan": (DoubleCardan(centring_ratio=0.45, centre_distance=0.08), double_cardan, {"ball": "ball 1"}),
    "tracta": (Tracta(driving_distance=0.03, driven_distance=0.036), tracta, {}),
    "offset_cross": (OffsetCross(offset=0.02, reach=0.2), offset_cross, {"ball": "sliding ball 1"}),
}

ANGLES = np.arange(0, 400, 15) * np.pi / 180.0


def told(joint: Joint, found, name: str):
    """Return the force in an inner pair whose name begins so, with its number."""
    start, count = name.rsplit(" ", 1)
    (own,) = (k for k, one in enumerate(found.pairs) if one.name.startswith(start) and one.count == int(count))
    return np.linalg.norm(found.found.reaction[:, own, 3:], axis=-1)


@pytest.mark.parametrize("kind", CASES)
def test_a_joint_turns_and_carries_as_mujocos_bodies_do(kind):
    joint, build, names = CASES[kind]
    loop = build()
    places = [loop.turned(angle) for angle in ANGLES]
    angle, ratio, torque = (np.asarray([one[k] for one in places]) for k in range(3))
    # the loop counts its output from where its drawing has the driven mark: unlike halves do not meet there
    angle = np.unwrap(angle) - angle[0]
    lead, steps, _slope = joint.deviation(ANGLES, np.asarray(BEND))
    assert angle == pytest.approx(ANGLES + lead - lead[0], abs=1e-10)
    found = joint_carried(joint, BEND, ANGLES)
    assert ratio == pytest.approx(found.ratio, abs=1e-9)
    if not joint.wobbles or kind == "tripod":
        assert ratio == pytest.approx(steps, abs=1e-9)
    assert torque == pytest.approx(found.input_torque, abs=1e-9)
    for pin, name in names.items():
        forces = np.asarray([one[3][pin] for one in places])
        assert forces == pytest.approx(told(joint, found, name), rel=1e-8)


def test_journals_of_a_cross_carry_as_mujocos_pins():
    loop = hooke()
    tips = [loop.turned(angle)[3] for angle in ANGLES]
    found = joint_carried(Hooke(), BEND, ANGLES).found.reaction[:, 1, :3]
    for tip in ("tip0", "tip1"):
        assert [one[tip] for one in tips] == pytest.approx(np.linalg.norm(found, axis=-1) / 0.1, rel=1e-9)


def test_the_oracle_would_notice_a_wrong_size():
    loop = clemens()
    _angle, ratio, _torque, _forces = loop.turned(1.0)
    other = Clemens(
        driving=ClemensProfile(axial=0.05, radial=0.02, radius=0.06),
        driven=ClemensProfile(axial=0.05, radial=0.0212, radius=0.06),
    )
    assert abs(ratio - float(other.deviation(np.asarray([1.0]), np.asarray(BEND))[1][0])) > 1e-4
