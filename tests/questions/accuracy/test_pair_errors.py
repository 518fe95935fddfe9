"""Tolerances of pairs inside a joint of one's own: against loops closed anew, all directions, and a cross joint."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from cardan import Drive, Tolerance, allocate, example, tolerance
from cardan.drive.joints.mechanism import MechanismJoint, inside_of
from cardan.errors import InputError
from cardan.io.examples import example_mechanism
from cardan.methods import Linear, MonteCarlo, WorstCase
from cardan.questions.accuracy import answer as told
from cardan.questions.accuracy.accuracy import course, one_turn, sensitivity, still
from cardan.questions.accuracy.pair_errors import PLACES, pair_errors
from cardan.questions.accuracy.shaft_places import shaft_places
from cardan.questions.motion.joint_mechanism import joint_carried
from cardan.units import arcmin

OFF = 1e-3
"""Errors [rad], and over the size, of loops closed anew, to both sides: what is left is of their square."""

EVERY, SKEW = np.eye(3), np.asarray([2.0, -1.0, 2.0]) / 3.0


def made(name: str, **tolerances) -> MechanismJoint:
    """Return a shipped mechanism as a joint, with tolerances of pairs by name."""
    drawing = example_mechanism(name)
    joints = tuple(
        replace(one, **tolerances.get(one.id.replace(" ", "_").replace(",", ""), {})) for one in drawing.joints
    )
    return MechanismJoint(file=f"{name}.toml", drawing=replace(drawing, joints=joints))


def alone(joint: MechanismJoint) -> Drive:
    """Return a drive of it at the joint angle at which it is drawn."""
    angle = inside_of(joint.drawing, "", "").drawn_angle
    return replace(Drive.from_angles([angle]), joints=(replace(joint, joint_angle=angle, plane_twist=0.0),))


def closed(joint: MechanismJoint, pair: str, key: str, way: np.ndarray, theta: float) -> tuple[float, np.ndarray]:
    """Return by how much a joint's driven shaft turns and shifts over an error of a pair, its loops closed with it.

    Its driving shaft rests, the driven one keeps its direction: a face on a slide along it holds that. What is held too
    often closes by least squares, lengths over the size that counts as one.
    """
    here = inside_of(joint.drawing, "", "")
    even = np.arange(PLACES) * (2.0 * np.pi / PLACES)
    size = joint_carried(joint, here.drawn_angle, even).placed.size
    own = [
        (one.id, one.type, one.links, one.point, one.along)
        for k, one in enumerate(here.linkage.joints)
        if k not in here.bearings
    ]
    own += [("slide", "P", ("ground", "guide"), here.centre, here.after)]
    own += [("face", "E", ("guide", here.driven), here.centre, here.after)]
    drawn = dict(zip(here.linkage.links, here.at(np.asarray(theta), np.asarray(here.drawn_angle)), strict=True))
    links = [
        one for one in dict.fromkeys(link for row in own for link in row[2]) if one not in (here.driving, "ground")
    ]

    def poses(x: np.ndarray) -> dict[str, np.ndarray]:
        found = {"ground": np.eye(4), here.driving: drawn[here.driving]}
        for link, (turn, shift) in zip(links, x.reshape(-1, 2, 3), strict=True):
            pose = drawn.get(link, np.eye(4)).copy()
            pose[:3, :3] = Rotation.from_rotvec(turn).as_matrix() @ pose[:3, :3]
            pose[:3, 3] += size * shift
            found[link] = pose
        return found

    def missed(x: np.ndarray, off: np.ndarray) -> np.ndarray:
        at, rows = poses(x), []
        for name, kind, (first, second), point, axis in own:
            aside = np.linalg.svd(np.asarray(axis)[None])[2][1:]
            frame = np.stack((axis, *aside))
            other, there = frame, np.asarray(point)
            if name == pair:
                there = there + (off if key == "misalignment" else 0.0)
                other = frame @ Rotation.from_rotvec(off if key == "misalignment_turn" else 0.0 * off).as_matrix().T
            one, two = (frame @ at[first][:3, :3].T, other @ at[second][:3, :3].T)
            gap = at[second][:3, :3] @ there + at[second][:3, 3] - at[first][:3, :3] @ point - at[first][:3, 3]
            turned = np.sum(np.cross(one, two), axis=0) / 2.0 if kind == "P" else np.cross(one[0], two[0])
            held = {"R": ([0, 1, 2], [1, 2]), "P": ([1, 2], [0, 1, 2]), "E": ([0], [1, 2])}[kind]
            rows += [(one @ gap)[held[0]] / size, (one @ turned)[held[1]]]
        return np.concatenate(rows)

    length = OFF if key == "misalignment_turn" else OFF * size
    ends = []
    for sign in (1.0, -1.0):
        x = least_squares(
            missed,
            np.zeros(6 * len(links)),
            args=(sign * length * way,),
            method="lm",
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        ).x
        ends.append(poses(x)[here.driven])
    spin = Rotation.from_matrix(ends[0][:3, :3] @ ends[1][:3, :3].T).as_rotvec()
    shift = (ends[0][:3, :3] - ends[1][:3, :3]) @ here.centre + ends[0][:3, 3] - ends[1][:3, 3]
    return float(spin @ here.after) / (2.0 * length), here.basis @ shift / (2.0 * length)


CASES = [
    ("hooke-stiff-bearings", "driving pin", "misalignment_turn"),
    ("hooke-stiff-bearings", "driven pin", "misalignment"),
    ("thompson", "driving pin", "misalignment_turn"),
    ("thompson", "scissor 2", "misalignment"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "pair", "key"), CASES)
def test_the_influence_is_that_of_loops_closed_with_the_error(name, pair, key):
    """Angle of the driven shaft and its place; a Thompson coupling is held too often."""
    joint = made(name, **{pair.replace(" ", "_"): {key.replace("misalignment", "tolerance"): 1e-3}})
    drive = alone(joint)
    theta = inside_of(joint.drawing, "", "").start + 2.9
    (found,) = pair_errors(drive, np.asarray([theta - still(drive, np.zeros(1)).yoke_rotation[0][0]]))
    for way in EVERY if name != "thompson" else [SKEW]:
        angle, shift = closed(joint, pair, key, way, theta)
        most = max(float(np.max(np.abs(found.table))), 1e-3), max(float(np.max(np.abs(found.start))), 1e-3)
        assert found.table[0] @ way == pytest.approx(angle, rel=0.0, abs=2e-5 * most[0])
        np.testing.assert_allclose(found.start[0] @ way, shift, rtol=0.0, atol=2e-5 * most[1])


def test_a_pin_turned_in_the_plane_of_its_cross_is_an_error_of_the_right_angle():
    """As `alpha2` of a cross joint, whatever the place of the turn."""
    drive = alone(made("hooke-stiff-bearings", driving_pin={"tolerance_turn": 1e-3}))
    (found,) = pair_errors(drive, one_turn())
    normal = np.cross((0.0, 4.0, 3.0), (5.0, -9.0, 12.0))
    own = found.table @ (normal / np.linalg.norm(normal))
    known = sensitivity(Drive.from_angles([drive.joints[0].joint_angle]), one_turn())[:, 0, 2]
    assert np.sort(np.abs(own)) == pytest.approx(np.sort(np.abs(known)), abs=2e-3)
    assert np.max(np.abs(own)) == pytest.approx(np.max(np.abs(known)), rel=1e-4)
    assert np.min(np.abs(own)) == pytest.approx(np.min(np.abs(known)), abs=1e-2)


@pytest.mark.slow
def test_the_worst_direction_of_a_vector_is_the_worst_of_all():
    """Of the largest error, what stays, once and twice a turn, and the change, against every direction there is."""
    drive = alone(made("hooke-stiff-bearings", driven_pin={"tolerance_turn": 2e-3}))
    band = tolerance(drive, method=WorstCase()).output
    (found,), (row,) = pair_errors(drive, one_turn()), band.contributions
    count = np.arange(20000) + 0.5
    height, turn = 1.0 - count / 10000.0, count * np.pi * (1.0 + 5.0**0.5)
    flat = np.sqrt(1.0 - height**2)
    every = np.stack((flat * np.cos(turn), flat * np.sin(turn), height))
    curves = 2e-3 * found.table @ every
    parts = course(curves.T)
    for told_, brute in (
        ((band.largest, row.largest), np.max(np.abs(curves))),
        ((band.mean, row.mean), np.max(np.abs(parts.mean))),
        ((band.first, row.first), np.max(parts.first)),
        ((band.second, row.second), np.max(parts.second)),
    ):
        assert told_ == pytest.approx((brute, brute), rel=3e-4, abs=1e-12)  # so far apart the directions are
    assert band.peak_to_peak == pytest.approx(np.max(np.ptp(curves[::3], axis=0)), rel=3e-4)
    assert row.field == "joints[0].drawing.joints[2].tolerance_turn"
    assert row.share == 1.0


def pair_and_cross() -> tuple[Drive, Drive, Drive]:
    """Return a drive with a pair and a cross that may be off, with the pair alone, and with the cross alone."""
    one = replace(made("hooke-stiff-bearings", driven_pin={"tolerance_turn": 1e-3}), joint_angle=0.3, plane_twist=0.0)
    bare = replace(one, drawing=example_mechanism("hooke-stiff-bearings"))
    drive = Drive.from_angles([0.3, 0.25], plane_twists=[0.4])
    two, plain = replace(drive.joints[1], tolerance=Tolerance(alpha2=2e-3)), drive.joints[1]
    every = (one, two), (one, plain), (bare, two)
    return tuple(replace(drive, joints=joints) for joints in every)


@pytest.mark.slow
def test_tolerances_of_a_pair_and_of_another_joint_add():
    both, pair, cross = pair_and_cross()
    halves = [
        [tolerance(one, method=way).output.upper for one in (both, pair, cross)] for way in (WorstCase(), Linear())
    ]
    np.testing.assert_allclose(halves[0][0], halves[0][1] + halves[0][2], rtol=1e-12)
    np.testing.assert_allclose(halves[1][0], np.hypot(halves[1][1], halves[1][2]), rtol=1e-12)
    rows = tolerance(both).output.contributions
    assert {row.joint for row in rows} == {1, 2}
    assert sum(row.share for row in rows) == pytest.approx(1.0, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("way", [WorstCase(), Linear()])
def test_what_is_allotted_leaves_room_for_pairs(way):
    """Their tolerances count as kept: with them the target is reached, at a place between those looked at here."""
    both, pair, _cross = pair_and_cross()
    found = allocate(both, 6.0 * arcmin, method=way)
    assert tolerance(both, found.spread, method=way).output.largest == pytest.approx(6.0 * arcmin, rel=3e-5)
    remarks = [str(one.text) for one in told.answer_of_allocation(both, found).remarks]
    assert any("are kept, and count" in one for one in remarks)
    with pytest.raises(InputError, match="use up the error allowed"):
        allocate(both, 0.9 * tolerance(pair).output.largest, method=way)


@pytest.mark.slow
def test_samples_leave_pairs_out_and_say_so():
    both, pair, cross = pair_and_cross()
    some = MonteCarlo(samples=256)
    assert tolerance(both, method=some).output.largest == tolerance(cross, method=some).output.largest
    remarks = [str(one.text) for one in told.answer(both, told.ask(both, method=some)).remarks]
    assert any("Samples leave out the tolerances of pairs inside joint" in one for one in remarks)
    with pytest.raises(InputError, match="not of those of pairs"):
        tolerance(pair, method=some)


def test_a_drive_whose_pairs_alone_may_be_off_is_answered():
    _both, pair, _cross = pair_and_cross()
    assert not told.lacking(pair)
    answer = told.answer(pair, told.ask(pair))
    assert "turn of “driven pin” in joint 1" in str(answer.sentence)
    assert not [one for one in answer.remarks if one.code == "made_true"]
    assert not [one for one in answer.remarks if one.tone == "next"]  # nothing is left to be allotted
    fields = [row["field"] for row in answer.facts["angle"]["contributions"]]
    assert fields == ["joints[0].drawing.joints[2].tolerance_turn"]


@pytest.mark.slow
def test_a_pair_shifts_the_shaft_behind_it():
    """Both pins of a cross shift its centre by as much; the shaft behind it leans by that over its length."""
    drive = example("thompson-drive")
    one = made("hooke-stiff-bearings", driven_pin={"tolerance": 1e-4})
    drive = replace(drive, joints=(replace(one, centre=drive.joints[0].centre), *drive.joints[1:]))
    (place,) = shaft_places(drive, tolerance(drive))
    assert (place.shaft, len(place.shares)) == (2, 1)
    assert place.worst[0] == pytest.approx(1e-4, rel=1e-3)
    assert place.worst[2] == pytest.approx(1e-4 / np.hypot(0.6, 0.12), rel=1e-3)
    assert place.worst == pytest.approx(place.shares[0].ways, rel=1e-12)
