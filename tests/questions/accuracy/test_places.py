"""Errors inside joints that move shafts: the loops of their pairs closed anew, and closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, tolerance
from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.cross import Cross
from cardan.drive.joints import JOINTS, Hooke
from cardan.drive.joints.common.inner import DRIVEN, DRIVING, FRAME, Stance
from cardan.drive.joints.tripod import orbit_radius
from cardan.drive.models.geometry import geometry
from cardan.drive.models.wobble import course
from cardan.joints import ConstantVelocity, DoubleCardan, OffsetCross, Tripod
from cardan.mechanism.closing import CLOSED, Linkage
from cardan.mechanism.mechanism import Pair
from cardan.methods import MonteCarlo, WorstCase
from cardan.questions.accuracy import answer as told
from cardan.questions.accuracy import places
from cardan.questions.accuracy.accuracy import one_turn, sensitivity, transmission_error
from cardan.questions.accuracy.cross_play import loop_slides
from cardan.questions.accuracy.own_laws import table_of
from cardan.questions.accuracy.shaft_places import shaft_places
from cardan.units import deg, mm

BEND, LENGTH = 24 * deg, 0.3
PLACE = {"joint_angle": BEND, "plane_twist": 0.0}
FAR = OffsetCross(offset=12 * mm, reach=0.2, pin_side="far", **PLACE)
CENTRED = DoubleCardan(centring_ratio=0.51, centre_distance=60 * mm, **PLACE)
MOVING = {
    "near": OffsetCross(offset=12 * mm, reach=0.2, **PLACE),
    "far": FAR,
    "tripod": Tripod(track_radius=20 * mm, **PLACE),
    "ball on driving": CENTRED,
    "ball on driven": replace(CENTRED, ball_on="driven"),
    "hooke": Hooke(**PLACE),
}


def row(vector):
    return tuple(float(x) for x in np.ravel(vector))


def before(joint, **given):
    """Return a drive with the joint before one that turns evenly, 0.3 m behind it."""
    drive = Drive(joints=(joint, ConstantVelocity(joint_angle=10 * deg, plane_twist=0.4)), **given)
    return replace(
        drive, shafts=tuple(replace(one, length=LENGTH if one.number == 2 else None) for one in drive.shafts)
    )


def influence(drive, phi, key):
    """Return the ways of the shaft behind the first joint by one of an error of this."""
    return places.influences(drive, phi, [[key], []])[0, key].ways[0]


def shifts(joint, key, error, stance, rest):
    """Yield which pair is off by an error, on which of its links, and which way."""
    u, v, e, f = stance.driving, stance.driven, stance.before, stance.after
    if key == "offset":
        yield (
            "driven pin of joint {number}",
            DRIVING,
            (1.0 if joint.pin_side == "near" else -1.0) * error * np.cross(u, v),
        )
    elif key == "reach":
        yield "held", FRAME, error * rest
    elif key == "track_radius":
        for k in range(3):
            turned = np.cos(k * 120 * deg) * u + np.sin(k * 120 * deg) * np.cross(e, u)
            yield f"track {k + 1} of joint {{number}}", DRIVING, error * turned
    elif key == "centring_ratio":
        on, way = (DRIVING, e) if joint.ball_on == "driving" else (DRIVEN, -f)
        yield "ball of joint {number}", on, 60 * mm * error * way
    elif key in ("s1", "a1"):
        yield "driving pin of joint {number}", DRIVING, error * (e if key == "s1" else np.cross(u, e))
    elif key == "a2":
        yield "driven pin of joint {number}", "cross {number}", error * np.cross(u, v)
    else:
        yield "driven pin of joint {number}", DRIVEN, error * np.cross(v, f)


def closed(drive, key, error, phi):
    """Return a point of the driven shaft and its direction, its loops closed with one pair off."""
    joint, place, lying = drive.joints[0], geometry(drive), course(drive, np.asarray([phi]))
    stance = Stance(
        centre=place.points[1], before=place.axis[0], after=lying.axis[1, 0], normal=place.normal[0], length=LENGTH,
        joint_angle=float(lying.joint_angle[0, 0]), driving=lying.driving[0, 0], driven=lying.driven[0, 0],
    )  # fmt: skip
    # the plane of a joint whose shaft wobbles turns with it
    stance = replace(stance, normal=np.cross(place.axis[0], stance.after) / np.sin(stance.joint_angle))
    held = place.points[1] + (joint.held(LENGTH)) * place.axis[1]
    off = {name: (on, way) for name, on, way in shifts(joint, key, error, stance, place.axis[1])}
    pairs = []
    for one in joint.mechanism(stance):
        name = one.name.replace("{count}", str(one.count))
        links = tuple(link.replace("{count}", str(one.count)) for link in one.links)
        on, way = off.get(name, (links[1], np.zeros(3)))
        on = "cross {number}" if name == "driven pin of joint {number}" and key == "offset" else on
        second = {} if one.second is None else {"axis2": row(one.second)}
        ends = links if links[1] == on else links[::-1]
        if one.type == "SG" and ends != links:
            ends, way = links, -way  # the axis stays with its link; along it nothing is held
        pairs.append(
            Pair(
                id=name,
                type=one.type,
                links=ends,
                point=row(one.point),
                axis=row(one.axis),
                misalignment=row(way),
                **second,
            )
        )
    _on, way = off.get("held", (FRAME, np.zeros(3)))
    bearing = Pair(id="driving", type="R", links=(FRAME, DRIVING), point=row(place.points[1]), axis=row(place.axis[0]))
    axis = row(lying.axis[1])
    ball = Pair(id="held", type="SG", links=(DRIVEN, FRAME), point=row(held), axis=axis, misalignment=row(way))
    if joint.slides:  # its spider stays in the plane through the joint centre
        pairs.append(Pair(id="plane", type="PT", links=(DRIVEN, FRAME), point=row(place.points[1]), axis=axis))
    linkage = Linkage([bearing, ball, *pairs])
    moving = [k for k, link in enumerate(linkage.links) if link not in (FRAME, DRIVING)]
    poses, misfit = linkage.settled(linkage.drawn(), moving)
    assert np.max(misfit) < CLOSED
    pose = poses[linkage.links.index(DRIVEN)]
    return pose[:3, :3] @ lying.start[0, 0] + pose[:3, 3], pose[:3, :3] @ lying.axis[1, 0]


@pytest.mark.parametrize("phi", [0.3, 2.1, 4.4])
@pytest.mark.parametrize("name", MOVING)
def test_a_shaft_lies_where_the_loops_of_the_pairs_close(name, phi):
    joint = MOVING[name]
    drive = before(joint)
    lying = course(drive, np.asarray([phi]))
    for key in joint.placing():
        error = 0.002 if key == "centring_ratio" else 0.1 * mm
        point, axis = closed(drive, key, error, phi)
        off = [dict.fromkeys(joint.placing(), np.zeros(1)), {}]
        off[0][key] = np.asarray([error])
        made = course(drive, np.asarray([phi]), off=off)
        assert np.max(np.abs(made.axis[1, 0] - axis)) < 1e-9
        apart = made.start[0, 0] - point
        assert np.max(np.abs(apart - (apart @ axis) * axis)) < 1e-9
        assert np.max(np.abs(made.axis[1] - lying.axis[1])) > 1e-6 or key == "s1"


@pytest.mark.parametrize("name", MOVING)
def test_the_influence_is_the_slope_of_the_exact_loops(name):
    """Richardson's central differences of the way of the shaft and of the angle of the output."""
    drive, phi = before(MOVING[name]), one_turn(12)
    for (j, key), found in places.influences(drive, phi, places.placing(drive)).items():
        step = 1e-5 if key == "centring_ratio" else 1e-6
        each = step * np.asarray([-2.0, -1.0, 1.0, 2.0])
        off = [{one: each if one == key else 0.0 * each for one in drive.joints[j].placing()}, {}]
        exact = places.moved(drive, phi, off)
        for told_, two in ((found.angle, exact.angle), (found.ways, exact.ways)):
            slope = (8.0 * (two[2] - two[1]) - (two[3] - two[0])) / (12.0 * step)
            assert told_ == pytest.approx(slope, abs=1e-7 * max(1.0, float(np.max(np.abs(slope)))))


def test_an_offset_moves_its_shaft_as_one_of_the_axes_of_a_cross_does():
    """A Hooke joint with a_2 is an offset cross; its shaft leans by a_2 sin α |cos θ| over its length."""
    phi = one_turn(24)
    cross = influence(before(Hooke(**PLACE)), phi, "a2")
    pins = influence(before(OffsetCross(offset=0.0, reach=LENGTH, **PLACE)), phi, "offset")
    assert cross == pytest.approx(pins, abs=1e-9)
    lean = np.linalg.norm(cross[2], axis=-1)
    assert lean == pytest.approx(np.sin(BEND) * np.abs(np.cos(phi)) / LENGTH, abs=1e-8)


def test_a_track_off_widens_the_orbit_of_the_spider():
    tripod = Tripod(track_radius=0.01 * mm, pivot=LENGTH, **PLACE)
    found = influence(Drive(joints=(tripod,)), one_turn(24), "track_radius")
    way = np.linalg.norm(found[0], axis=-1)
    assert way == pytest.approx(np.full(24, float(orbit_radius(BEND, 1.0))), rel=1e-4)  # of a small orbit
    assert np.linalg.norm(found[2], axis=-1) == pytest.approx(way / LENGTH, rel=1e-4)


def test_a_held_cross_moves_the_shaft_where_a_free_one_would_slide():
    """What a cross slides along its journals between fixed bearings, its shaft moves where they hold it."""
    drive, phi = before(Hooke(**PLACE)), one_turn(24)
    lying = course(drive, phi)
    for key, one in places.influences(drive, phi, places.placing(drive)).items():
        slides = loop_slides(drive, phi, errors=[Error(**{key[1]: 1.0 * mm}), None])[0]
        sought = slides[0, :, None] * lying.driving[0] + slides[1, :, None] * lying.driven[0]
        sought = sought - np.sum(sought * lying.axis[1], axis=-1, keepdims=True) * lying.axis[1]
        assert 1.0 * mm * one.ways[0, 0] == pytest.approx(sought, abs=1e-9), key


def with_tolerances(joint, **tolerances):
    given = Tolerance if joint.single_cross else table_of(joint)
    return replace(joint, tolerance=given(**tolerances))


@pytest.mark.slow
def test_tolerances_of_the_place_add_up_as_those_of_the_angle():
    joint = with_tolerances(MOVING["far"], offset=0.05 * mm, reach=0.5 * mm)
    drive = before(joint)
    bands = [tolerance(drive, method=one) for one in (WorstCase(), MonteCarlo(samples=2048, positions=24))]
    square = tolerance(drive)
    likely, worst, drawn = (shaft_places(drive, one)[0] for one in (square, *bands))
    assert likely.shaft == 2
    # the pin moves on its circle, the ball along the shaft as drawn: neither adds up with the other at the joint
    alone = {one.key: one.ways for one in likely.shares}
    assert likely.reach[2] == pytest.approx(np.hypot(alone["offset"][2], alone["reach"][2]), rel=0.02)
    assert worst.reach == likely.worst
    assert worst.reach[2] == pytest.approx(alone["offset"][2] + alone["reach"][2], rel=0.02)
    assert drawn.reach[2] == pytest.approx(likely.reach[2], rel=0.06)
    # what the wobble does to the angle of the next joint counts in the angle of the output
    assert {one.key for one in square.output.contributions} == {"offset", "reach"}
    assert np.max(bands[1].output.deviation) == pytest.approx(np.max(square.output.deviation), rel=0.05)


def test_known_errors_lie_where_the_drive_with_these_sizes_does():
    joint = MOVING["near"]
    made = replace(joint, error=table_of(joint, "error")(offset=0.3 * mm, reach=2.0 * mm))
    drive, phi = before(made), one_turn(36)
    real, drawn = (course(before(one), phi) for one in (replace(joint, offset=12.3 * mm, reach=0.202), joint))
    found = transmission_error(drive, phi)
    assert found.error == pytest.approx(real.turned[-1] - drawn.turned[-1], abs=1e-13)
    assert found.error == pytest.approx(found.error_linear, abs=0.05 * float(np.max(np.abs(found.error))))
    (shaft,) = told.ask(drive).shafts
    lean = np.linalg.norm(real.axis[1] - drawn.axis[1], axis=-1)
    assert shaft.known[2] == pytest.approx(float(np.max(lean)), rel=1e-3)


@pytest.mark.slow
def test_the_answer_tells_how_far_shafts_are_moved():
    crossed = with_tolerances(Hooke(**PLACE), a3=0.02 * mm)
    drive = before(crossed)
    found = told.ask(drive)
    said = told.answer(drive, found)
    (table,) = (one for one in said.tables if "move the shafts" in one.title)
    ways = {str(one.heading): one.values for one in table.columns}
    assert ways["at its joint ±"][0] == pytest.approx(0.02 * mm)
    (facts,) = said.facts["shafts"]
    (row_,) = facts["contributions"]
    assert row_["field"] == "joints[0].tolerance.a3"
    assert row_["at_joint_per_unit"] == pytest.approx(1.0)
    assert row_["lean_per_unit"] == pytest.approx(1.0 / LENGTH, rel=1e-3)
    assert not [one for one in said.remarks if one.code == "shafts_stay"]
    # a size that moves the last shaft alone turns nothing
    alone = Drive(joints=(with_tolerances(MOVING["far"], offset=0.05 * mm),))
    sentence = told.answer(alone, told.ask(alone)).sentence
    assert "do not turn the output" in sentence.text
    drawn = told.ask(alone, method=MonteCarlo(samples=1024, positions=12))
    assert not [one for one in told.answer(alone, drawn).remarks if "drives drawn" in str(one.text)]
    assert sentence.values["way"].value == pytest.approx(np.sin(BEND) * 0.05 * mm, rel=0.1)


STAY = {
    "tracta": ({"driving_distance": 0.03, "driven_distance": 0.03}, "driving_distance", "stay in their bearings"),
    "rzeppa": ({"lever_b": 0.35, "lever_c": 0.7}, "lever_b", "spheres of its cage"),
    "weiss": ({"driving_offset": 0.012, "driven_offset": 0.012, "groove_radius": 0.04}, "groove_radius", "centre ball"),
    "pin_coupling": ({"driving_distance": 0.06, "driven_distance": 0.06}, "driving_distance", "only the contact moves"),
    "double_cardan": ({"centring_ratio": 0.51}, "centring_ratio", "centre_distance"),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", STAY)
def test_a_kind_whose_shafts_stay_says_why(kind):
    sizes, key, why = STAY[kind]
    drive = before(with_tolerances(JOINTS[kind](**sizes, **PLACE), **{key: 1e-5}))
    (remark,) = (one for one in told.answer(drive, told.ask(drive)).remarks if one.code == "shafts_stay")
    assert why in str(remark.text)
    assert not told.ask(drive).shafts


def test_a_shaft_stays_in_bearings_and_behind_a_cross_that_slides():
    free = with_tolerances(Hooke(cross=Cross(slides=True), **PLACE), a2=0.02 * mm)
    last = with_tolerances(Hooke(joint_angle=10 * deg, plane_twist=0.4), a2=0.02 * mm)
    drive = replace(before(free), joints=(free, last))
    texts = [str(one.text) for one in told.answer(drive, told.ask(drive)).remarks if one.code == "shafts_stay"]
    assert "slides along its journals" in texts[0]
    assert "bearings hold the shaft behind it" in texts[1]
    assert not shaft_places(drive, tolerance(drive))
    assert np.all(sensitivity(drive, one_turn(8))[:, 0, 0] != 0.0)


@pytest.mark.parametrize("kind", JOINTS.values(), ids=JOINTS)
def test_every_kind_moves_its_shaft_by_its_sizes_or_says_why_not(kind):
    assert kind.stays
    if not kind.single_cross:
        assert set(kind.place_sizes) <= kind.size_keys().keys()
