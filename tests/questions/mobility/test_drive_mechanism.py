from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, assembly, example
from cardan.drive.cross import Cross
from cardan.drive.joints import JOINTS
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import chain
from cardan.drive.models.machine_held import machine_held
from cardan.drive.models.wobble import course
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.io import example_names
from cardan.joints import (
    Clemens,
    ClemensProfile,
    DoubleCardan,
    HalfCardan,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.questions.forces.kinetostatics import standing
from cardan.questions.mobility.constraint_release import repairs
from cardan.questions.mobility.drive_mechanism import joint_freedoms, mechanism_of, unheld
from cardan.questions.mobility.finite_mobility import locks_at, mobility_over_turn
from cardan.questions.mobility.mobility import mobility
from cardan.reading.fields import fields_of
from tests.fixtures.joint_keys import OWN

HELD = [
    name
    for name in example_names()
    if example(name).supports and all(joint.kind == "hooke" for joint in example(name).joints)
]
"""Examples that statics can judge too: it knows crosses alone."""


@pytest.mark.parametrize("name", HELD)
def test_redundancy_is_what_the_statics_of_the_shafts_leaves_open(name):
    """Another formulation: unknown forces less equations of balance, of rigid shafts with massless crosses."""
    drive = machine_held(example(name))
    found = mobility(drive)
    assert found.agrees
    assert (found.mobility, found.parasitic, found.redundant) == (1, 0, assembly(drive).degree)


def test_the_pump_binds_by_its_bearings():
    drive = example("overconstrained-pump")
    found = mobility(drive)
    assert found.redundant == 3
    best = repairs(drive)[0]
    assert best.after == 0
    assert all(one.bearing for one in best.changes)


def held(drive, *supports, **more):
    return replace(drive, supports=supports, **more)


FIRM = {"radial": True, "axial": True, "tilt": True}
SINGLE = Drive.from_angles([0.4])


def two(after):
    return held(SINGLE, Support(shaft=1, position=-0.3, **FIRM), Support(shaft=2, position=0.3, **after))


@pytest.mark.parametrize(
    ("holds", "kind", "redundant"),
    [
        ({"radial": True}, "SG", 0),
        ({"radial": True, "axial": True}, "S", 1),
        ({"radial": True, "tilt": True}, "C", 2),
        (FIRM, "R", 3),
        ({"radial": False, "axial": True}, "PT", 0),
        ({"radial": False, "axial": True, "tilt": True}, "E", 1),
    ],
)
def test_what_a_support_holds_says_which_pair_it_is(holds, kind, redundant):
    whole = mechanism_of(two(holds))
    assert whole.joints[-1].type == kind
    found = mobility(two(holds))
    assert found.redundant == redundant or found.parasitic


def test_a_support_that_holds_the_slope_alone_is_two_pairs():
    whole = mechanism_of(two({"radial": False, "tilt": True}))
    assert [one.type for one in whole.joints[-2:]] == ["P", "E"]
    assert mobility(whole).formula == 6 * 4 - 5 * 3 - 5 - 3
    assert mobility(whole).agrees


def test_a_spline_parts_its_shaft_where_it_is():
    drive = Drive.from_angles([0.3, 0.3])
    spline = Spline(position=0.5)
    ends = Support(shaft=1, position=-0.2, **FIRM), Support(shaft=3, position=0.2, **FIRM)
    without = held(drive, *ends, shafts=(Shaft(number=2, length=0.8),))
    splined = held(drive, *ends, shafts=(Shaft(number=2, length=0.8, spline=spline),))
    assert (mobility(without).mobility, mobility(without).redundant) == (1, 1)
    assert (mobility(splined).mobility, mobility(splined).redundant) == (1, 0)
    middle = held(drive, *ends, Support(shaft=2, position=0.6), shafts=splined.shafts)
    assert mechanism_of(middle).joints[-1].links[1] == "shaft 2 behind its spline"


@pytest.mark.parametrize("number", [1, 3])
def test_a_slip_yoke_on_an_end_shaft_frees_the_length_of_the_drive(number):
    """R-P-RR-RR-R: the spline slides on the shaft of the machine, whose bearings stand beyond it."""
    drive = Drive.from_angles([0.3, 0.3])
    middle = Shaft(number=2, length=0.8)
    end = Support(shaft=4 - number, position=0.2 if number == 1 else -0.2, **FIRM)
    drive = held(drive, end, shafts=(middle, Shaft(number=number, spline=Spline())))
    made = machine_held(drive)
    found = mobility(made)
    assert (found.mobility, found.redundant, found.parasitic, found.driven) == (1, 0, 0, 1)
    assert assembly(made).degree == 0
    own = next(one.position for one in made.supports if one.shaft == number)
    assert own < -0.1 if number == 1 else own > 0.1


def test_a_cross_that_slides_frees_its_pins():
    firm = two(FIRM)
    sliding = replace(firm, joints=(replace(SINGLE.joints[0], cross=Cross(slides=True)),))
    assert [one.type for one in mechanism_of(sliding).joints[:2]] == ["C", "C"]
    assert mobility(sliding).redundant == assembly(sliding).degree


def test_housings_that_are_off_strain_what_is_held_too_much():
    firm = two(FIRM)
    off = replace(firm, supports=(firm.supports[0], replace(firm.supports[1], offset=(0.0, 1e-3, 0.0))))
    assert mobility(off).misalignment > 0.0
    loose = two({"radial": True})
    off = replace(loose, supports=(loose.supports[0], replace(loose.supports[1], offset=(0.0, 1e-3, 0.0))))
    assert mobility(off).misalignment == 0.0


def test_marks_are_those_by_which_forces_are_calculated():
    drive = Drive.from_angles([0.3, 0.5], plane_twists=[0.7], yoke_angles=[0.4], start_phase=0.2)
    place = geometry(drive)
    lying = course(drive, np.asarray([1.1]))
    driving, driven = lying.driving[:, 0], lying.driven[:, 0]
    stand = standing(chain(drive), place.axis, place.normal, np.asarray([1.1]), speed=1.0)
    np.testing.assert_allclose(driving, stand.driving_arm[0], atol=1e-14)  # rounding of two turns
    np.testing.assert_allclose(driven, stand.driven_arm[0], atol=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("kind", JOINTS)
def test_joints_of_every_kind_are_pairs(kind):
    values = {one.name: 0.02 for one in fields_of(JOINTS[kind]).values() if one.required}
    if kind == "offset_cross":
        values = {"offset": 0.01, "reach": 0.3}
    joint = JOINTS[kind](joint_angle=0.2, **OWN.get(kind, values))
    found = mobility(replace(two(FIRM), joints=(joint,)))
    assert found.agrees
    assert found.parasitic == 0
    assert found.driven == (0 if kind == "offset_cross" else 1), "its shaft has to wobble"
    held = {"tripod": 2, "half_cardan": 2, "offset_cross": 2, "mechanism": 15}  # five loops of axes that meet
    loose = ("elastic_half_cardan", "pin_coupling", "clemens", "tracta")
    assert found.redundant == (0 if kind in loose else held.get(kind, 3))


def test_a_drive_binds_alike_over_its_turn():
    found = mobility_over_turn(example("overconstrained-pump"), positions=12)
    assert found.turns
    assert (found.structural, found.special.size) == (3, 0)


@pytest.mark.parametrize(
    ("drive", "fields"),
    [
        (SINGLE, ["supports"]),
        (
            replace(Drive.from_angles([0.2, 0.2]), supports=(Support(shaft=1, position=-0.1),)),
            ["shafts[1].length"],
        ),
    ],
)
def test_what_misses_is_named(drive, fields):
    with pytest.raises(InputError) as caught:
        mobility(drive)
    assert [one.field for one in caught.value.problems] == fields
    assert np.all([one.message.startswith("missing") for one in caught.value.problems])


def offset(*supports):
    joint = OffsetCross(joint_angle=0.4, offset=0.02, reach=0.3)
    return replace(SINGLE, joints=(joint,), supports=supports)


@pytest.mark.slow
def test_an_offset_cross_turns_in_its_ball_and_locks_in_two_bearings():
    motor = Support(shaft=1, position=-0.3, **FIRM)
    ball = mobility_over_turn(offset(motor), positions=24)
    assert ball.turns
    assert (set(ball.mobility), ball.structural) == ({1}, 0)
    assert "ball behind joint 1" in [one.id for one in mechanism_of(offset(motor)).joints]
    pump = (Support(shaft=2, position=0.2), Support(shaft=2, position=0.4, axial=True))
    firm = mobility_over_turn(offset(motor, *pump), positions=24)
    assert not firm.turns
    floating = mobility_over_turn(offset(motor, Support(shaft=2, position=0.3)), positions=24)
    assert floating.turns


def test_a_coupling_that_holds_nothing_but_the_torque_is_told_by_bending():
    pins = replace(SINGLE, joints=(PinCoupling(joint_angle=0.4),))
    assert unheld(pins) == (0,)
    every = {kind: unheld(replace(SINGLE, joints=(one,))) for kind, one in KINDS.items()}
    loose = {"pin_coupling", "clemens", "elastic_half_cardan", "tracta"}
    assert {kind for kind, found in every.items() if found} == loose


KINDS = {
    kind: made(joint_angle=0.2, **({"offset": 0.01, "reach": 0.3} if kind == "offset_cross" else OWN.get(kind, {})))
    for kind, made in JOINTS.items()
}


ARM = ClemensProfile(axial=0.05, radial=0.02, radius=0.06)
SIZED = [
    (DoubleCardan(centring_ratio=0.55), "RRRR-SG", 2),
    (DoubleCardan(centring_ratio=0.45, ball_on="driven"), "RRRR-SG", 2),
    (Tracta(driving_distance=0.03, driven_distance=0.036), "RER", 5),
    (Rzeppa(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03), "RRSS", 2),
    (Rzeppa(driving_offset=0.004, driven_offset=0.005, groove_radius=0.03), "RRSS", 2),
    (Weiss(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03), "RRSS", 2),
    (HalfCardan(), "PRR", 3),
    (Tripod(track_radius=0.02), "P-SG-P-SG-P-SG", 3),
    (PinCoupling(driving_distance=0.05, driven_distance=0.06), "P-SG", 5),
    (Clemens(driving=ARM, driven=replace(ARM, radial=0.021)), "RRS", 5),
]
"""Joints with their sizes, the pairs that they are, and the ways they leave free: Book p. 88-96, spec structure."""


@pytest.mark.parametrize(("joint", "pairs", "free"), SIZED, ids=[one.kind for one, _pairs, _free in SIZED])
def test_a_joint_stands_in_a_drive_as_the_mechanism_that_it_is(joint, pairs, free):
    drive = two(FIRM)
    drive = replace(drive, joints=(replace(joint, joint_angle=0.3),))
    whole = mechanism_of(drive)
    assert "".join(one.type for one in whole.joints[:-2]) == pairs.replace("-", "")
    assert joint_freedoms(drive) == (free,)
    found = mobility(whole)
    assert found.agrees
    assert found.mobility - found.redundant == 1 + free + 1 - 6  # two hinges and the joint around one loop


@pytest.mark.slow
def test_a_tracta_joint_between_fixed_bearings_is_not_redundant_and_turns():
    """R-R-E-R-R, also with forks at unequal distances; spec structure, worked results."""
    for joint in (Tracta(), Tracta(driving_distance=0.03, driven_distance=0.036)):
        drive = replace(two(FIRM), joints=(replace(joint, joint_angle=0.3),))
        found = mobility(drive)
        assert (found.mobility, found.redundant, found.driven) == (1, 0, 1)
        assert locks_at(mechanism_of(drive)) is None


def test_balls_and_faces_repeat_what_the_first_of_them_holds():
    """Weiss with two balls that carry and a centre ball between fixed bearings: q = 4; the square bell: q = 1."""
    weiss = Weiss(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03, joint_angle=0.3)
    assert mobility(replace(two(FIRM), joints=(weiss,))).redundant + weiss.repeated == 4
    bell = HalfCardan(joint_angle=0.05)
    assert mobility(replace(two({"radial": True, "axial": True}), joints=(bell,))).redundant + bell.repeated == 1
    assert Rzeppa().repeated == 5
    lever, frame = (DoubleCardan(joint_angle=0.3, device=one, centre_distance=0.08) for one in ("lever", "frame"))
    held = [mobility(replace(two(FIRM), joints=(one,))).redundant + one.repeated for one in (lever, frame)]
    assert held[1] == held[0] + 1
    with pytest.raises(InputError, match="with centring_ratio a ball centres"):
        replace(two(FIRM), joints=(DoubleCardan(joint_angle=0.3, device="frame", centring_ratio=0.5),))


def test_a_tripod_needs_a_shaft_that_gives_way_to_its_spider():
    """Its spider orbits: two fixed bearings lock it, the joint at the far end of a half shaft lets it."""
    tripod = Tripod(track_radius=0.02, joint_angle=0.3)
    assert mobility(replace(two(FIRM), joints=(tripod,))).driven == 0
    grooves = Rzeppa(driving_offset=0.004, driven_offset=0.004, groove_radius=0.03, joint_angle=0.3)
    ends = Support(shaft=1, position=-0.2, **FIRM), Support(shaft=3, position=0.2, **FIRM)
    half = Drive(joints=(tripod, grooves), shafts=(Shaft(number=2, length=0.4),), supports=ends)
    found = mobility(half)
    assert (found.mobility, found.redundant, found.driven) == (1, 0, 1)
    assert locks_at(mechanism_of(half)) is None


def test_grooves_that_do_not_meet_are_no_mechanism():
    apart = Rzeppa(driving_offset=0.03, driven_offset=0.03, groove_radius=0.005, joint_angle=0.6)
    with pytest.raises(InputError, match="does not turn") as caught:
        mobility(replace(two(FIRM), joints=(apart,)))
    assert caught.value.field == "joints[0].joint_angle"
