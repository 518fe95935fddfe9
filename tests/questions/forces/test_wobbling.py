"""Forces of drives whose shafts wobble, as pins of a cross stand apart: against the mechanism of the whole drive."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, forces, losses, motion, moving_forces
from cardan.answers.reader import Reader
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.joints.mechanism import MechanismJoint
from cardan.drive.models.geometry import geometry
from cardan.drive.models.wobble import course
from cardan.drive.support import Support
from cardan.io.drive_file import loads
from cardan.joints import OffsetCross
from cardan.maths.kernel import frames
from cardan.mechanism.load import LinkMass, Load
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.questions.forces.answer import answer, ask
from cardan.questions.forces.assembly import assembly
from cardan.questions.forces.inner_loads import inner_loads
from cardan.questions.mechanism.forces import mechanism_forces
from cardan.questions.mobility.drive_mechanism import mechanism_of
from cardan.questions.mobility.finite_mobility import finite_mobility
from cardan.questions.motion.joint_mechanism import joint_carried
from cardan.questions.motion.kinds import carried_on

SINGLE = """format = 1
[input]
point_mm = [-500, 0, 0]
[output]
point_mm = [800, 300, 100]
[[joints]]
kind = "offset_cross"
centre_mm = [0, 0, 0]
offset_mm = 15
reach_mm = 200
{pins}
[[supports]]
shaft = 1
position_mm = -100
axial = true
tilt = true
[duty]
speed_rpm = 1200
torque_Nm = {torque}
torque_at = "{at}"
"""

PINS = "friction = 0.05\njournal_span_mm = 60\njournal_diameter_mm = 14"

CHAIN = """format = 1
[input]
point_mm = [-500, 0, 0]
[output]
point_mm = [1500, 240, -60]
[[joints]]
centre_mm = [0, 0, 0]
{first}
[[joints]]
centre_mm = [900, 0, 0]
{second}
[[shafts]]
number = 2
yoke_angle_deg = 25
{spline}
[[supports]]
shaft = 1
position_mm = -100
axial = true
tilt = true
{bearings}
[duty]
speed_rpm = 1200
torque_Nm = 300
"""

OFFSET = 'kind = "offset_cross"\noffset_mm = 15\npin_side = "{side}"\nreach_mm = {reach}'

TWO = "[[supports]]\nshaft = 3\nposition_mm = 100\naxial = true\n[[supports]]\nshaft = 3\nposition_mm = 400\n"


def single(torque: float = 300.0, *, pins: str = "", at: str = "output") -> Drive:
    """Return an offset cross between a shaft in two bearings and one in a ball."""
    return loads(SINGLE.format(torque=torque, pins=pins, at=at))


def chain(place: str, side: str = "near") -> Drive:
    """Return a cross joint and an offset cross, which is the first or the second one, on a bent line."""
    text = CHAIN.replace("[-500, 0, 0]", "[-450, -120, 60]")
    offset = OFFSET.format(side=side, reach=900 if place == "first" else 250)
    cross = 'kind = "hooke"'
    if place == "first":
        return loads(text.format(first=offset, second=cross, spline="[shafts.spline]", bearings=TWO))
    bearings = "[[supports]]\nshaft = 2\nposition_mm = 700\n"
    return loads(text.format(first=cross, second=offset, spline="", bearings=bearings))


def standing(drive: Drive, angle: float) -> Mechanism:
    """Return a drive as a mechanism where it stands at an input angle, its torque on its output link."""
    whole = mechanism_of(drive, angle)
    axis = course(drive, np.asarray([angle])).axis[-1, 0]
    torque = tuple((-(drive.duty.torque or 0.0) * axis).tolist())
    return replace(
        whole, speed=drive.duty.speed, loads=(Load(link=whole.output_link, torque=torque, turns_with_link=True),)
    )


@pytest.mark.parametrize("torque", [300.0, -300.0])
@pytest.mark.parametrize("pins", ["", PINS])
def test_one_joint_carries_what_its_mechanism_carries(torque, pins):
    drive = single(torque, pins=pins)
    angle = np.arange(0.0, 2.0 * np.pi, np.pi / 36)
    found = forces(drive, angle=angle)
    joint = drive.joints[0]
    inner = joint_carried(
        joint, float(geometry(drive).joint_angle[0]), angle, friction=joint.friction or 0.0, fed=torque > 0.0
    )
    assert found.input_torque / torque == pytest.approx(np.abs(inner.input_torque), rel=1e-12)
    ball = found.reaction[-1] / torque
    assert np.linalg.norm(ball, axis=-1) == pytest.approx(
        np.linalg.norm(inner.found.reaction[:, 3, 3:], axis=-1), rel=1e-11, abs=1e-12
    )
    assert max(np.max(one) for one in (found.power_left, found.force_left, found.moment_left)) < 1e-13


@pytest.mark.parametrize("at", ["output", "input"])
def test_its_friction_is_that_of_the_losses(at):
    drive = single(pins=PINS, at=at)
    found, lost = forces(drive), losses(drive)
    # losses are told for a torque about the driven shaft as drawn, from which it wobbles by some 0.8°
    assert found.input_torque == pytest.approx(lost.input_torque, rel=5e-4)
    given, taken = found.input_torque * found.speed[0], found.output_torque * found.speed[1]
    assert given - taken == pytest.approx(found.loss[0], rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("place", ["first", "second"])
@pytest.mark.parametrize("side", ["near", "far"])
@pytest.mark.parametrize("angle", [0.3, 2.1])
def test_a_drive_carries_what_the_mechanism_of_it_carries(place, side, angle):
    drive = chain(place, side)
    found = forces(drive, angle=[angle])
    whole = mechanism_forces(standing(drive, angle), np.zeros(1))
    assert float(found.input_torque[0]) == pytest.approx(abs(float(whole.input_torque[0])), rel=1e-10)
    names = [pair.id for pair in whole.mechanism.joints]
    first = next(k for k, name in enumerate(names) if "support" in name or "ball" in name)
    sizes = np.linalg.norm(whole.reaction[0, :, 3:], axis=-1)[first:]
    ours = np.linalg.norm(found.reaction[:, 0], axis=-1)
    assert np.sort(ours) == pytest.approx(np.sort(sizes[sizes > 0.0])[-ours.size :], rel=1e-9)
    assert found.input_torque * found.speed[0] == pytest.approx(found.output_torque * found.speed[2], rel=1e-12)


@pytest.mark.slow
def test_a_shaft_that_wobbles_shakes():
    """Mass and inertia of the driven shaft against Newton and Euler for the mechanism, at places of a turn."""
    drive = single()
    heavy = {"mass": 4.0, "centre_of_mass": 0.15, "inertia": 0.02, "transverse_inertia": 0.05}
    drive = replace(
        drive,
        shafts=(drive.shafts[0], replace(drive.shafts[1], **heavy)),
        settings=replace(drive.settings, gravity=(0.0, 0.0, -9.81)),
    )
    turn = np.arange(720) * (2.0 * np.pi / 720)
    lying = course(drive, turn)
    ahead = float(np.mean(np.sum((lying.start[0] - lying.centre[0]) * lying.axis[1], axis=-1)))
    for k in (25, 100, 400):
        found = forces(drive, angle=[turn[k]])
        whole = standing(drive, float(turn[k]))
        axis = lying.axis[1, k]
        tensor = 0.05 * np.eye(3) + (0.02 - 0.05) * np.outer(axis, axis)
        mass = LinkMass(
            link=whole.output_link,
            mass=4.0,
            mass_centre=tuple(lying.start[0, k] + (0.15 - ahead) * axis),
            inertia=tuple(np.diag(tensor)),
            inertia_products=(tensor[0, 1], tensor[0, 2], tensor[1, 2]),
        )
        known = mechanism_forces(replace(whole, masses=(mass,), gravity=(0.0, 0.0, -9.81)), np.zeros(1))
        assert float(found.input_torque[0]) == pytest.approx(abs(float(known.input_torque[0])), rel=1e-8)
        ball = next(i for i, pair in enumerate(known.mechanism.joints) if "ball" in pair.id)
        assert np.linalg.norm(found.reaction[-1, 0]) == pytest.approx(
            float(np.linalg.norm(known.reaction[0, ball, 3:])), rel=1e-8
        )


def test_pins_that_meet_are_a_cross_joint():
    """No distance, and the ball as any bearing: torques and forces of the Hooke joint."""
    drive = single()
    together = replace(drive, joints=(replace(drive.joints[0], offset=0.0),))
    plain = loads(
        SINGLE.format(torque=300.0, pins="", at="output")
        .replace('kind = "offset_cross"', 'kind = "hooke"')
        .replace("offset_mm = 15\nreach_mm = 200\n", "")
        .replace("[duty]", "[[supports]]\nshaft = 2\nposition_mm = 200\n[duty]")
    )
    one, other = forces(together), forces(plain)
    assert one.input_torque == pytest.approx(other.input_torque, rel=1e-13)
    assert one.reaction == pytest.approx(other.reaction, rel=1e-11, abs=1e-9)
    assert one.joint_force == pytest.approx(other.joint_force, rel=1e-11, abs=1e-9)


def test_its_ball_is_no_bearing_twice():
    assert assembly(single()).residual < 1e-9
    own = replace(single(), supports=(*single().supports, Support(shaft=2, position=0.2)))
    assert forces(own).reaction == pytest.approx(forces(single()).reaction, rel=1e-12, abs=1e-9)


def test_what_keeps_the_shaft_from_wobbling_is_told():
    drive = single()
    held = replace(drive, supports=(*drive.supports, Support(shaft=2, position=0.4)))
    with pytest.raises(InputError, match="shaft 2 wobbles about the ball of joint 1, 200 mm behind it"):
        forces(held)
    beyond = chain("first")
    beyond = replace(beyond, joints=(replace(beyond.joints[0], reach=0.3), beyond.joints[1]))
    with pytest.raises(
        InputError, match=r"carries joint 2 around by .* 900 mm would put the ball where joint 2 stands"
    ):
        forces(beyond)
    with pytest.raises(InputError, match="supports: missing"):
        forces(replace(chain("first"), supports=()))
    with pytest.raises(InputError, match="stands in the frame"):
        moving_forces(loads(SINGLE.format(torque=300.0, pins="", at="output") + MOVES))


MOVES = """[[movements]]
kind = "harmonic"
moves = ["output"]
amplitude_mm = [0, 0, 40]
frequency_Hz = 2
"""


def test_pins_of_an_own_joint_carry_what_journals_do():
    """A cross as a mechanism file against the journals of the Hooke joint; and the offset cross without distance."""
    pins = [
        Pair(id="in", type="R", links=("one", "cross"), point=(0.0, 0.0, 0.0), axis=(0.0, 1.0, 0.0)),
        Pair(id="out", type="R", links=("cross", "two"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0)),
    ]
    ends = [
        Pair(id="a", type="R", links=("frame", "one"), point=(-0.1, 0.0, 0.0), axis=(1.0, 0.0, 0.0)),
        Pair(id="b", type="R", links=("frame", "two"), point=(0.08, 0.06, 0.0), axis=(4.0, 3.0, 0.0)),
    ]
    joints = (*ends, *(replace(one, diameter=0.012, bearing_distance=0.05) for one in pins))
    cross = Mechanism(frame="frame", input_link="one", output_link="two", joints=joints)
    bent = {"joint_angle": 0.3}
    duty = Duty(torque=100.0)
    plain = forces(Drive(joints=(Hooke(**bent, cross=Cross(span=0.05, journal=0.012)),)), duty)
    journals = np.asarray(plain.journals.size)[0]
    own = Drive(joints=(MechanismJoint(**bent, file="cross.toml").with_drawing(cross),))
    offset = Drive(
        joints=(OffsetCross(**bent, offset=0.0, reach=0.3, journal_span=0.05, journal_diameter=0.012),),
        supports=(Support(shaft=1, position=-0.1, axial=True, tilt=True),),
    )
    for drive in (own, offset):
        high = [one.high for one in inner_loads(drive, forces(drive, duty))]
        if drive is own:
            assert high == pytest.approx([journals[:, :2].max(), journals[:, 2:].max()], rel=1e-6)
        else:  # its ball pushes the pins too
            assert min(high) > journals.max()


PAIR = """format = 1
[[joints]]
kind = "offset_cross"
offset_mm = 20
pin_side = "{side}"
reach_mm = 200
joint_angle_deg = 28
[[joints]]
joint_angle_deg = 28
plane_twist_deg = 60
{joint}
[[shafts]]
number = 2
length_mm = 200
yoke_angle_deg = -60
{spline}
[[supports]]
shaft = 1
position_mm = -100
axial = {one}
[[supports]]
shaft = 1
position_mm = -200
[[supports]]
shaft = 3
position_mm = 100
axial = {two}
[[supports]]
shaft = 3
position_mm = 200
[duty]
speed_rpm = 600
torque_Nm = 100
"""

HELD = {"one": "true", "two": "true"}
CUT = "[[shafts]]\nnumber = {number}\n[shafts.spline]\nposition_mm = {place}"

FLOATS = {
    "spline": {"spline": "[shafts.spline]"},
    "ahead": {"two": "false"},
    "back": {"one": "false"},
    "spline behind": {"spline": CUT.format(number=3, place=50)},
    "spline before": {"spline": CUT.format(number=1, place=-50)},
    "plunges": {"joint": 'kind = "constant_velocity"\nplunge_out_mm = 20'},
    "tripod": {"joint": 'kind = "tripod"\ntrack_radius_mm = 25'},
    "nothing": {},
}


def pair(floats: str, side: str = "near") -> Drive:
    """Return an offset cross and a cross joint where its shaft swivels; what gives way along the shafts by name."""
    return loads(PAIR.format(**{"joint": "", "spline": "", "side": side, **HELD, **FLOATS[floats]}))


@pytest.mark.slow
@pytest.mark.parametrize("side", ["near", "far"])
@pytest.mark.parametrize("floats", [*FLOATS][:5])
def test_what_floats_decides_how_the_drive_turns(floats, side):
    """Closed loops of the whole drive, followed over a turn, turn as told; and the forces go with that."""
    drive = pair(floats, side)
    count = 90
    angle = np.linspace(0.0, 2.0 * np.pi, count + 1)
    moved = finite_mobility(mechanism_of(drive), angle=2.0 * np.pi, steps=count)
    assert moved.closes
    link = moved.mechanism.links.index(mechanism_of(drive).output_link)
    axis = np.asarray(geometry(drive).axis[2])
    aside = frames.perpendicular(axis)
    turned = np.einsum("tij,j->ti", moved.displacement[:, link, :3, :3], aside)
    told = np.unwrap(np.arctan2(turned @ np.cross(axis, aside), turned @ aside))
    known = motion(drive, angle)
    ours = known.shaft_angle[-1] - known.shaft_angle[-1][0]
    assert np.max(np.abs(np.abs(told) - ours)) < 1e-9
    found = forces(drive, angle=angle)
    assert found.speed[-1] / found.speed[0] == pytest.approx(known.ratio, rel=1e-9)
    given, taken = found.input_torque * found.speed[0], found.output_torque * found.speed[-1]
    assert given == pytest.approx(taken, rel=1e-12)
    assert max(np.max(one) for one in (found.power_left, found.force_left, found.moment_left)) < 1e-12


def test_where_the_next_joint_plunges_both_joints_stay():
    drive = pair("plunges")
    angle = np.linspace(0.0, 6.0, 50)
    assert np.max(np.abs(course(drive, angle).centre - geometry(drive).points[1:-1, None])) < 1e-15
    found = forces(drive, angle=angle)
    assert found.speed[-1] / found.speed[0] == pytest.approx(motion(drive, angle).ratio, rel=1e-9)
    assert np.max(found.power_left) < 1e-12


HEAVY = {"mass": 4.0, "centre_of_mass": 0.05, "inertia": 0.02, "transverse_inertia": 0.05}


@pytest.mark.slow
@pytest.mark.parametrize("floats", [*FLOATS][:3])
def test_heavy_shafts_that_float_carry_what_the_mechanism_carries(floats):
    """Weights at a place of the turn against the mechanism there; with inertia forces power balances over the turn."""
    drive = pair(floats)
    shafts = tuple(replace(shaft, **HEAVY) for shaft in drive.shafts)
    drive = replace(drive, shafts=shafts, settings=replace(drive.settings, gravity=(3.0, 0.0, -9.81)))
    assert np.max(forces(drive).power_left) < 1e-12
    slow = replace(drive, duty=replace(drive.duty, speed=1e-4))
    if floats != "ahead":
        return
    hinge = Support(shaft=1, position=-0.1, axial=True, tilt=True)
    slow = replace(slow, supports=(hinge, *drive.supports[2:]))
    for angle in (0.4, 2.1):
        lying, place, found = course(slow, np.asarray([angle])), geometry(slow), forces(slow, angle=[angle])
        middle = course(slow, np.arange(720) * (2.0 * np.pi / 720))
        ahead = float(np.mean(np.sum((middle.start[0] - middle.centre[0]) * middle.axis[1], axis=-1)))
        starts = (
            lying.centre[0, 0] - float(place.length[0]) * place.axis[0], lying.start[0, 0] - ahead * lying.axis[1, 0],
            lying.start[1, 0],
        )  # fmt: skip
        whole = standing(slow, angle)
        masses = tuple(
            LinkMass(link=f"shaft {k + 1}", mass=4.0, mass_centre=tuple(start + 0.05 * axis))
            for k, (start, axis) in enumerate(zip(starts, lying.axis[:, 0], strict=True))
        )
        known = mechanism_forces(replace(whole, masses=masses, gravity=(3.0, 0.0, -9.81)), np.zeros(1))
        assert float(found.input_torque[0]) == pytest.approx(abs(float(known.input_torque[0])), rel=1e-7)
        sizes = [
            np.linalg.norm(known.reaction[0, k, 3:])
            for k, one in enumerate(known.mechanism.joints)
            if one.id.startswith("support")
        ]
        assert np.linalg.norm(found.reaction[:, 0], axis=-1) == pytest.approx(np.asarray(sizes), rel=1e-7)


@pytest.mark.parametrize(
    ("floats", "said"),
    [
        ("spline", None),
        ("ahead", "Joint 2 moves ±1.45 mm along shaft 3"),
        ("back", "Joint 1 moves ±1.49 mm along shaft 1"),
        ("nothing", "shafts 1 and 3 are both held along: the drive binds"),
        ("open", "nothing says what slides, so it counts as if shaft 2 did"),
    ],
)
def test_motion_says_what_slides(floats, said):
    drive = replace(pair("nothing"), supports=()) if floats == "open" else pair(floats)
    told = [one.text.told(Reader()) for one in carried_on(drive) if one.code in {"slides", "binds"}]
    assert [said in one for one in told] == ([] if said is None else [True])


def told_by_forces(drive: Drive) -> str:
    """Return the remarks of forces."""
    remarks = answer(drive, ask(drive)).remarks
    return " ".join(one.text.told(Reader()) for one in remarks if hasattr(one.text, "told"))


@pytest.mark.slow
def test_forces_say_by_how_much_they_miss_a_wobble():
    """A tripod runs around its own pin behind a shaft that wobbles, and its wobble is not in forces."""
    text = told_by_forces(pair("tripod"))
    assert "of the power that goes in neither comes out nor is lost" in text
    offset = '"offset_cross"\noffset_mm = 20\npin_side = "{side}"\nreach_mm = 200'
    first = PAIR.replace(offset, '"tripod"\ntrack_radius_mm = 25')
    drive = loads(first.format(joint="", spline="", **HELD))
    text = told_by_forces(drive)
    assert "wobbles is not in these torques and forces" in text
    assert "neither comes out" not in told_by_forces(pair("ahead"))
