"""Forces of joints of one's own that let their shafts shift one way or another in their centre.

Against Hooke joints whose journals slide, by closed form; against the whole drive as a mechanism; and against least
energy written out by hand.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, assembly, forces, losses, moving_forces
from cardan.drive.cross import Cross
from cardan.drive.described import Input, Output
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.joints.mechanism import MechanismJoint
from cardan.drive.models.geometry import geometry
from cardan.drive.movement import Harmonic
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.mechanism.load import Load
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.questions.forces.inner_loads import inner_loads
from cardan.questions.mechanism.forces import mechanism_forces
from cardan.questions.mobility.drive_mechanism import mechanism_of, unheld
from cardan.questions.motion.joint_mechanism import joint_carried
from tests.fixtures.own_joints import chains, cross, shipped

CLOSED = 1e-9
"""Share of the largest reaction to which both ways agree: loops are closed to a tenth of it."""

DUTY = Duty(torque=300.0, speed=100.0)
STIFF, ALONG = {"stiffness": 2e7}, {"axial": True, "axial_stiffness": 3e7}

JUST = (
    Support(shaft=1, position=-0.3, axial=True),
    Support(shaft=1, position=-0.1),
    Support(shaft=2, position=0.1),
    Support(shaft=2, position=0.4),
)
ELASTIC = tuple(replace(one, **STIFF, **(ALONG if one.axial else {})) for one in JUST)


def single(joint, supports, phase: float = 0.2) -> Drive:
    """Return a drive with one joint."""
    ends = {"input": Input(point=(-0.4, 0.0, 0.0), start_phase=phase), "output": Output(point=(0.5, 0.15, 0.1))}
    return Drive(joints=(replace(joint, centre=(0.0, 0.0, 0.0)),), supports=supports, duty=DUTY, **ends)


def double(*joints, yoke_angle: float = 0.0, middle: tuple[Support, ...] = ()) -> Drive:
    """Return a drive with two joints, whose end shafts are held by themselves."""
    places = (0.0, 0.0, 0.0), (0.6, 0.03, 0.06)
    last = [Support(shaft=3, position=at) for at in (0.1, 0.4)]
    stop = Support(shaft=3, position=0.45, radial=False, axial=True)
    return Drive(
        joints=tuple(replace(joint, centre=place) for joint, place in zip(joints, places, strict=True)),
        input=Input(point=(-0.4, 0.0, 0.0), start_phase=0.3),
        output=Output(point=(1.1, 0.1, 0.05)),
        shafts=(Shaft(number=2, yoke_angle=yoke_angle),),
        supports=(Support(shaft=1, position=-0.2, axial=True, tilt=True), *middle, *last, stop),
        duty=DUTY,
    )


def beside(joint: MechanismJoint, slides: bool | str, supports: tuple[Support, ...]) -> tuple[Drive, Drive]:
    """Return drives with a cross as a mechanism and as a Hooke joint, their pins in the same place at the start."""
    quarter = 0.0 if joint.pair(np.asarray(0.3))[1].real < 0.0 else 0.5 * np.pi
    hooke = single(Hooke(cross=Cross(slides=slides)), supports, 0.2 + quarter)
    heavy = (Shaft(number=2, mass=40.0, centre_of_mass=0.25),)
    return replace(single(joint, supports), shafts=heavy), replace(hooke, shafts=heavy)


def near(one, other) -> bool:
    return np.abs(one - other).max() < CLOSED * np.abs(other).max()


PINS = [
    (("driving pin", "driven pin"), True, JUST),
    (("driving pin",), "driving", ELASTIC),
    (("driven pin",), "driven", ELASTIC),
    ((), False, ELASTIC),
]


@pytest.mark.slow
@pytest.mark.parametrize(("pins", "slides", "supports"), PINS)
def test_a_cross_whose_pins_slide_carries_what_a_hooke_joint_does(pins, slides, supports):
    """It holds its shafts along its normal alone, or across one of its pins: no force along those that slide."""
    joint = cross(*pins)
    assert (joint.free_ways, joint.fixed, joint.loose, joint.slides) == (len(pins), True, False, False)
    own, hooke = (forces(drive) for drive in beside(joint, slides, supports))
    assert near(own.reaction, hooke.reaction)
    assert near(own.joint_force, hooke.joint_force)
    assert own.input_torque == pytest.approx(hooke.input_torque, rel=CLOSED)


@pytest.mark.slow
def test_it_does_so_while_the_drive_moves():
    bounce = Harmonic(moves=("output",), amplitude=(0.0, 0.01, 0.02), frequency=5.0)
    own, hooke = (
        moving_forces(drive, movements=[bounce]).forces
        for drive in beside(cross("driving pin", "driven pin"), True, JUST)
    )
    assert near(own.reaction, hooke.reaction)
    assert np.max(own.power_left) < 1e-12


@pytest.mark.slow
def test_it_binds_as_a_hooke_joint_does():
    """Forces of housings that are off, and the torque that turns against them: the ways in which it is free turn."""
    off = tuple(replace(one, offset=(0.0, 1e-3 * k, 5e-4)) for k, one in enumerate(ELASTIC))
    own, hooke = (assembly(drive) for drive in beside(cross("driven pin"), "driven", off))
    assert near(own.reaction, hooke.reaction)
    assert near(own.torque, hooke.torque)


def as_mechanism(drive: Drive, angle: float):
    """Return torque at the input and sizes of the reactions of a drive as one mechanism with all its inner pairs."""
    whole = mechanism_of(drive, angle)
    torque = tuple((-drive.duty.torque * geometry(drive).axis[-1]).tolist())
    load = Load(link=whole.output_link, torque=torque, turns_with_link=True)
    found = mechanism_forces(replace(whole, speed=drive.duty.speed, loads=(load,)), np.zeros(1))
    held = [k for k, pair in enumerate(found.mechanism.joints) if "support" in pair.id]
    return abs(float(found.input_torque[0])), np.linalg.norm(found.reaction[0, held, 3:], axis=-1)


BALL = (Support(shaft=2, position=0.25, axial=True),)

DRIVES = {
    "slipper joint first": lambda: double(shipped("slipper-joint"), Hooke()),
    "slipper joint second": lambda: double(Hooke(), shipped("slipper-joint")),
    "block joint first": lambda: double(shipped("block-joint"), Hooke()),
    "block joint second": lambda: double(Hooke(), shipped("block-joint")),
    "four chains first": lambda: double(chains(4), Hooke()),
    "four chains second": lambda: double(Hooke(), chains(4)),
    "two chains twice": lambda: double(chains(2), chains(2), yoke_angle=1.4, middle=BALL),
}


@pytest.mark.slow
@pytest.mark.parametrize("which", DRIVES)
def test_a_drive_carries_what_the_mechanism_of_it_carries(which):
    """Slides along the driven shaft, along the middle of both, and joints that hold one way across alone."""
    drive = DRIVES[which]()
    for angle in (0.3, 2.1):
        found = forces(drive, angle=[angle])
        torque, sizes = as_mechanism(drive, angle)
        assert float(found.input_torque[0]) == pytest.approx(torque, rel=1e-10)
        assert near(np.linalg.norm(found.reaction[:, 0], axis=-1), sizes)
        assert max(np.max(one) for one in (found.power_left, found.force_left, found.moment_left)) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize(("count", "ways", "slides"), [(1, 3, False), (2, 2, True), (4, 1, True)])
def test_what_chains_hold_of_their_shafts(count, ways, slides):
    """One the turn, two one way across beside it, four both: all of them slide along the middle of their shafts."""
    joint = chains(count)
    assert (joint.free_ways, joint.slides, joint.told, joint.even) == (ways, slides, True, True)
    angle, bent = np.linspace(0.1, 6.0, 7), 0.2
    free = joint.freed(angle, np.full(7, bent))
    middle = np.asarray([np.cos(0.5 * bent), np.sin(0.5 * bent), 0.0])
    assert np.linalg.norm(free @ middle, axis=-1) == pytest.approx(np.ones(7), abs=1e-9)
    wrench = joint_carried(joint, bent, angle).wrench
    assert np.abs(wrench[:, 3:] - joint.push(angle, np.full(7, bent))).max() < 1e-9 * np.abs(wrench).max()
    assert unheld(double(joint, Hooke())) == (() if count == 4 else (0,))


def held_by_springs(drive: Drive, shaft: int, force, couple) -> list[np.ndarray]:
    """Return what two bearings of a shaft hold of a force in the joint and a couple on it, by its levers; (p, 3)."""
    axis = geometry(drive).axis[shaft - 1]
    places = [one.position for one in drive.supports if one.shaft == shaft]
    pull = force - (force @ axis)[:, None] * axis
    first = (np.cross(axis, couple) + places[1] * pull) / (places[0] - places[1])
    along = (force @ axis)[:, None] * axis
    return [first / np.sqrt(2e7), (-pull - first) / np.sqrt(2e7), -along / np.sqrt(3e7)]


@pytest.mark.slow
def test_two_chains_share_their_force_with_the_bearings_by_their_stiffness():
    """The force one way across is that of least energy: of the force of either chain and their difference, by hand."""
    supports = tuple(replace(one, **STIFF, **(ALONG if k % 2 == 0 else {})) for k, one in enumerate(JUST))
    drive = single(chains(2), supports)
    angle = np.linspace(0.0, 2.0 * np.pi, 25)
    found, place = forces(drive, angle=angle), geometry(drive)
    basis = np.stack((place.axis[0], np.cross(place.normal[0], place.axis[0]), place.normal[0]))
    theta = angle + 0.2
    one, other = (joint_carried(chains(1), float(place.joint_angle[0]), at).wrench for at in (theta, theta + np.pi))
    assert np.abs(one[:, :3] - other[:, :3]).max() < 1e-9 * np.abs(one).max()
    couple, force, swing = (300.0 * part @ basis for part in (one[:, :3], one[:, 3:], other[:, 3:] - one[:, 3:]))
    none = 0.0 * couple
    still, by = (
        np.concatenate([*held_by_springs(drive, 1, -pull, -turn), *held_by_springs(drive, 2, pull, turn)], axis=-1)
        for pull, turn in ((force, couple), (swing, none))
    )  # square roots of the energy: of what is given, and of the difference of both chains
    share = -np.sum(still * by, axis=-1) / np.sum(by * by, axis=-1)
    assert near(found.joint_force[0], force + share[:, None] * swing)


@pytest.mark.slow
@pytest.mark.parametrize("torque", [300.0, -300.0])
def test_its_friction_takes_power(torque):
    sizes = {"diameter": 0.02, "bearing_distance": 0.08}
    supports = (*JUST[:3], replace(JUST[3], axial=True))
    soft = tuple(replace(one, **STIFF, **(ALONG if one.axial else {})) for one in supports)
    joint = replace(chains(2, **sizes), friction=0.05)
    drive = replace(single(joint, soft), duty=replace(DUTY, torque=torque))
    found, lost = forces(drive), losses(drive)
    assert np.max(found.power_left) < 1e-12
    assert np.mean(found.loss) == pytest.approx(lost.joints[0], rel=1e-2)
    assert lost.joints[0] > 1.0
    loads = inner_loads(drive, found)
    assert len(loads) == 10
    assert min(one.high for one in loads) > 0.0


def test_a_shaft_that_must_slide_is_told():
    """A hinge behind the centre and a ball: the driven shaft goes to and fro with the turn."""
    joints = (
        Pair(id="a", type="R", links=("frame", "one"), point=(-0.08, 0.0, 0.0), axis=(1.0, 0.0, 0.0)),
        Pair(id="hinge", type="R", links=("one", "bar"), point=(0.06, 0.0, 0.0), axis=(0.0, 1.0, 0.0)),
        Pair(id="ball", type="S", links=("bar", "two"), point=(0.0, 0.0, 0.05)),
        Pair(id="b", type="C", links=("frame", "two"), point=(0.08, 0.02, 0.0), axis=(4.0, 1.0, 0.0)),
    )
    drawing = Mechanism(frame="frame", input_link="one", output_link="two", joints=joints)
    drive = single(MechanismJoint(file="own.toml", drawing=drawing), JUST)
    # s² - 2 d s cos α = 2 d r v·e with v·e = ± sin α, d = 60 mm, r = 50 mm, tan α = 1/4
    reach, lean = 0.06 * np.cos(np.arctan(0.25)), 2.0 * 0.06 * 0.05 * np.sin(np.arctan(0.25))
    way = 1e3 * (np.sqrt(reach**2 + lean) - np.sqrt(reach**2 - lean))
    with pytest.raises(
        InputError, match=rf"'two' slides along its axis as it turns, by {way:.3g} mm at a joint angle of 14.04°"
    ):
        forces(drive)
