"""Joints of one's own: their laws against closed forms and an own loop closure, and what is no joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from cardan import Drive, InputError, example, forces, losses, motion, phases
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.joints.mechanism import MechanismJoint
from cardan.io import dumps, load
from cardan.io.drive_file import loads, loads_mechanism
from cardan.io.examples import example_mechanism
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.questions.motion.joint_mechanism import joint_carried, rubbed_share
from cardan.questions.motion.kinds import beside_turning
from cardan.units import deg

ANGLE = np.linspace(0.0, 2.0 * np.pi, 37)[:-1] + 0.021


DETUNED = {"arm_1,_driven_shaft": {"point": (0.031, 0.019, 0.0), "axis": (31.0, 19.0, 0.0)}}
"""A Thompson coupling one of whose arms stands 2.3° off."""


def joint_of(name: str, **changes) -> MechanismJoint:
    """Return a shipped mechanism as a joint, pairs changed by name."""
    drawing = example_mechanism(name)
    joints = tuple(replace(one, **changes.get(one.id.replace(" ", "_"), {})) for one in drawing.joints)
    return MechanismJoint(file=f"{name}.toml", drawing=replace(drawing, joints=joints))


def hooke(**sizes) -> MechanismJoint:
    """Return a Hooke joint as a mechanism, drawn with its pins anywhere."""
    made = joint_of("hooke-stiff-bearings")
    joints = tuple(replace(one, **sizes) for one in made.drawing.joints)
    return replace(made, drawing=replace(made.drawing, joints=joints))


@pytest.mark.parametrize("joint_angle", [0.02, 0.3, 0.6])
def test_a_cross_as_a_mechanism_turns_as_hookes_joint(joint_angle):
    """Whatever position it is drawn in: angles count from the arms of its cross."""
    joint = hooke()
    assert joint.has_map
    quarter = 0.0 if joint.pair(np.asarray(0.3))[1].real < 0.0 else 0.5 * np.pi  # the nearer arm: that of either yoke
    own = joint.deviation(ANGLE, np.asarray(joint_angle))
    known = Hooke().deviation(ANGLE + quarter, np.asarray(joint_angle))
    for one, other in zip(own, known, strict=True):
        assert np.abs(one - other).max() < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize(("joint_angle", "most"), [(80.0, 1e-11), (84.0, 1e-11), (88.0, 1e-10)])
def test_a_cross_as_a_mechanism_turns_as_hookes_joint_near_where_it_locks(joint_angle, most):
    """Its law is sharp there: at 88° harmonics fade by 3 % from one even order to the next."""
    joint, bend = hooke(), np.asarray(np.radians(joint_angle))
    quarter = 0.0 if joint.pair(np.asarray(0.3))[1].real < 0.0 else 0.5 * np.pi
    own, known = joint.deviation(ANGLE, bend), Hooke().deviation(ANGLE + quarter, bend)
    assert np.abs(own[0] - known[0]).max() < most
    assert np.abs(own[1] - known[1]).max() < 100.0 * most
    assert abs(joint.near_pair(bend)[1]) == pytest.approx(abs(Hooke().pair(bend)[1]), rel=1e-11)


@pytest.mark.slow
def test_sharp_laws_at_many_joint_angles_are_not_smoothed():
    joint = hooke()
    bends = np.radians(84.0) - np.linspace(0.0, 1e-3, 17)
    many = joint.deviation(ANGLE[:, None], bends)[0]
    for k in (0, 16):
        assert np.abs(many[:, k] - joint.deviation(ANGLE, bends[k])[0]).max() < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hooke-stiff-bearings", "thompson"])
def test_the_law_at_many_joint_angles_is_that_at_each(name):
    """By polynomials between full degrees, which pass through the straight joint."""
    joint = joint_of(name, **(DETUNED if name == "thompson" else {}))
    angles = np.linspace(0.003, 0.5, 40)
    many = joint.deviation(ANGLE[:, None], angles)
    for k in (0, 3, 20, 39):
        for one, other in zip(many, joint.deviation(ANGLE, angles[k]), strict=True):
            assert np.abs(one[:, k] - other).max() < 1e-9
    if joint.has_map:
        assert joint.near_pair(angles)[1][7] == pytest.approx(joint.near_pair(angles[7])[1], abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["thompson", "reuleaux", "weiss-straight"])
@pytest.mark.parametrize("joint_angle", [0.05, 0.2, 0.4, 0.6])
def test_mirror_images_are_exactly_uniform(name, joint_angle):
    joint = joint_of(name)
    assert np.abs(joint.deviation(ANGLE, np.asarray(joint_angle))[0]).max() == 0.0
    carried = joint_carried(joint, joint_angle, ANGLE)
    assert np.abs(carried.ratio - 1.0).max() < 1e-12
    assert np.abs(carried.input_torque - 1.0).max() < 1e-12
    assert np.max(carried.found.open) < 1e-12


def test_a_thompson_coupling_holds_its_centre_and_a_reuleaux_coupling_nothing():
    one, other = joint_of("thompson"), joint_of("reuleaux")
    assert joint_of("weiss-straight").fixed
    assert (one.fixed, one.slides, one.loose, one.even) == (True, False, False, True)
    assert (other.fixed, other.slides, other.loose, other.even) == (False, False, True, True)
    assert np.abs(joint_carried(one, 0.4, ANGLE).wrench[:, 3:]).max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", ["slipper-joint", "block-joint"])
def test_a_joint_with_axial_freedom_slides_and_turns_as_hookes_joint(name):
    joint = joint_of(name)
    assert (joint.fixed, joint.slides, joint.loose) == (True, True, False)
    quarter = 0.0 if joint.pair(np.asarray(0.15))[1].real < 0.0 else 0.5 * np.pi
    own, known = joint.deviation(ANGLE, np.asarray(0.15)), Hooke().deviation(ANGLE + quarter, np.asarray(0.15))
    assert max(np.abs(one - other).max() for one, other in zip(own, known, strict=True)) < 1e-10
    carried = joint_carried(joint, 0.15, ANGLE)
    along = carried.wrench[:, 3:] @ np.asarray([1.0, 0.0, 0.0])
    assert np.abs(along).max() < 1e-9
    assert np.abs(carried.input_torque - carried.ratio).max() < 1e-12


def test_two_block_joints_are_uniform():
    one = replace(joint_of("block-joint"), joint_angle=0.2)
    assert phases(Drive(joints=(one, one))).feasible


def turned(axis, angle, vector):
    """Turn a vector about an axis (Rodrigues)."""
    a = np.asarray(axis) / np.linalg.norm(axis)
    v = np.asarray(vector, dtype=float)
    return v * np.cos(angle) + np.cross(a, v) * np.sin(angle) + a * (a @ v) * (1.0 - np.cos(angle))


def own_closure(theta, joint_angle, last):
    """Return the turn of the driven shaft by directions on the sphere: nothing of the program is used.

    Unknown: the turn of the driven shaft, the pin p of the yoke, its axis k, and the scissor hinges q and r.
    """
    drawn = 2.0 * np.arctan(7.0 / 24.0)
    e1 = np.asarray([24.0, 7.0, 0.0]) / 25.0
    normal = np.asarray([0.0, 0.0, -1.0])
    bent = joint_angle - drawn
    e2 = turned(normal, bent, [24.0 / 25.0, -7.0 / 25.0, 0.0])

    def unit(*v):
        return np.asarray(v) / np.linalg.norm(v)

    u, f1, g1 = (turned(e1, theta, unit(*v)) for v in ((-7, 24, 0), (-31, 17, 0), (-17, -31, 0)))
    cos_driving, cos_driven, cos_other = (unit(0, 31, 17) @ unit(*v) for v in ((-31, 17, 0), (31, 19, 0), (31, 19, 0)))
    cos_second = unit(0, -17, 31) @ unit(-17, -31, 0)
    assert cos_driven == cos_other

    def rest(x):
        turn, p, k, q, r = x[0], x[1:4], x[4:7], x[7:10], x[10:13]
        v, f2, g2 = (turned(e2, turn, turned(normal, bent, unit(*w))) for w in ((7, 24, 0), (31, 19, 0), (17, -31, 0)))
        return [
            p @ u, p @ v, p @ p - 1.0, k @ p, k @ k - 1.0, k @ q, k @ r, q @ q - 1.0, r @ r - 1.0,
            q @ f1 - cos_driving, q @ f2 - cos_driven, r @ g1 - cos_second, r @ g2 - cos_second,
        ]  # fmt: skip

    found = root(rest, last, tol=1e-13).x
    assert np.abs(rest(found)).max() < 1e-12
    return found


@pytest.mark.slow
def test_a_detuned_thompson_coupling_turns_as_an_own_closure_says():
    """The arm that stands off is drawn with its shaft: at the joint angle drawn all loops close at angle 0."""
    joint = joint_of("thompson", **DETUNED)
    joint_angle, inside = 2.0 * np.arctan(7.0 / 24.0), joint._inside()
    theta = np.linspace(0.0, 2.0 * np.pi, 361)
    last = np.concatenate(
        ([0.0], [0, 0, 1], [1, 0, 0], [0, 31 / 1250**0.5, 17 / 1250**0.5], [0, -17 / 1250**0.5, 31 / 1250**0.5])
    )
    rows, leads = [last, last], []
    for angle in theta:
        rows.append(own_closure(angle, joint_angle, 2.0 * rows[-1] - rows[-2]))
        leads.append(rows[-1][0] - angle)
    found = joint.deviation(theta + inside.start, np.asarray(joint_angle))[0]
    assert np.ptp(leads) > 0.01
    assert np.abs(found - leads + np.mean(leads[:-1])).max() < 1e-10
    carried = joint_carried(joint, joint_angle, theta[::10] + inside.start)
    assert np.abs(carried.ratio - joint.deviation(theta[::10] + inside.start, np.asarray(joint_angle))[1]).max() < 1e-9


@pytest.mark.slow
def test_forces_and_losses_of_a_cross_as_a_mechanism_are_those_of_hookes_joint():
    sizes = {"diameter": 0.02, "bearing_distance": 0.08}
    known = example("z-arrangement")
    duty = replace(known.duty, torque=200.0, speed=100.0)
    cross = Cross(span=0.08, journal=0.02)

    def drive_of(joint):
        first, last = known.joints
        placed = replace(joint, centre=first.centre, joint_angle=first.joint_angle, friction=0.05)
        return replace(known, joints=(placed, replace(last, friction=0.05, cross=cross)), duty=duty, movements=())

    plain, own = drive_of(Hooke(cross=cross)), drive_of(hooke(**sizes))
    assert np.max(forces(own).power_left) < 1e-12
    shares = [
        rubbed_share(joint, 0.3, ANGLE + shift)
        for joint, shift in ((replace(plain.joints[0], friction=0.05), 0.5 * np.pi), (own.joints[0], 0.0))
    ]
    assert shares[0] == pytest.approx(np.asarray(shares[1]), rel=1e-9)
    # the closed form loads the journals by the couple along their normal alone, and the share is a table of 5° steps
    assert losses(own).joints[0] == pytest.approx(losses(plain).joints[0], rel=0.01)


def changed(text: str, old: str, new: str) -> Mechanism:
    assert old in text
    return loads_mechanism(text.replace(old, new))


def refusal(drawing: Mechanism, **keys) -> str:
    with pytest.raises(InputError) as found:
        Drive(joints=(MechanismJoint(file="own.toml", drawing=drawing, joint_angle=0.3, **keys),))
    (problem,) = found.value.problems
    return f"{problem.field}: {problem.message}"


@pytest.mark.slow
def test_what_is_no_joint_is_refused_with_link_angle_and_amount():
    drawing = example_mechanism("thompson")
    text = dumps(drawing)
    said = refusal(drawing, driven="lever 9")
    assert said.startswith("joints[0].driven: the mechanism has no moving link 'lever 9'")
    without = replace(drawing, joints=tuple(one for one in drawing.joints if "lever 2" not in one.links))
    assert "'driven shaft' is not held: with 'driving shaft' at rest it has 1 motion left" in refusal(without)
    straight = changed(text, "axis = [24, -7, 0]", "axis = [24, 7, 0]")
    assert "its shafts lie in one line" in refusal(straight)
    apart = changed(text, "point_mm = [144, -42, 0]", "point_mm = [144, -42, 3]")
    assert "its shafts pass each other 3 mm apart" in refusal(apart)
    short = loads_mechanism(text.replace("[0, -17, 31]", "[0, -17, 5]"))  # arms of 33° reach no further than 33°
    said = refusal(short)
    assert "cannot follow: with the driving link turned by" in said
    assert "mm and" in said
    assert "rounding_mm" not in said
    rolling = tuple(replace(one, type="RO") if one.id == "scissor 1" else one for one in drawing.joints)
    assert "'scissor 1' rolls: it holds a speed, not a place" in refusal(replace(drawing, joints=rolling))
    assert "needs one pair with the frame" in refusal(example_mechanism("crank-slider"))
    assert "missing: neither this key nor input_link" in refusal(replace(drawing, input_link=""))


def sketched(joint_angle: float, turn: float, digits: int) -> Mechanism:
    """Return a Thompson coupling as the page tells it, drawn at any joint angle and turn, its numbers rounded."""
    half, mirror = 0.5 * joint_angle, np.asarray([-1.0, 1.0, 1.0])
    shaft = np.asarray([np.cos(half), np.sin(half), 0.0])
    centre = np.asarray([0.1, 0.05, 0.0])

    def hinge(name, links, axis, reach=0.03):
        point, axis = (tuple(np.round(one, digits).tolist()) for one in (centre + reach * axis, axis))
        return Pair(id=name, type="R", links=links, point=point, axis=axis)

    pin = turned(shaft, turn, [-np.sin(half), np.cos(half), 0.0])
    yoke = np.cross(pin, mirror * pin) / np.linalg.norm(np.cross(pin, mirror * pin))
    across = np.asarray([1.0, 0.0, 0.0])
    joints = [
        hinge("input bearing", ("frame", "input"), shaft, -0.1),
        hinge("output bearing", ("frame", "output"), -mirror * shaft, 0.1),
        hinge("driving pin", ("input", "driving cross"), pin),
        hinge("driving pin of the yoke", ("driving cross", "yoke"), yoke),
        hinge("driven pin of the yoke", ("yoke", "driven cross"), yoke),
        hinge("driven pin", ("driven cross", "output"), mirror * pin),
    ]
    for k, tilt in ((1, 0.5), (2, 0.5 + 0.5 * np.pi)):
        arm = (pin * (1.0 if k == 1 else -1.0) - shaft) / np.sqrt(2.0)
        up = (arm + mirror * arm) / np.linalg.norm(arm + mirror * arm)
        hinge_axis = turned(across, tilt, up if k == 1 else -up)
        joints += [
            hinge(f"arm {k} in", ("input", f"driving arm {k}"), arm),
            hinge(f"scissor {k}", (f"driving arm {k}", f"driven arm {k}"), hinge_axis),
            hinge(f"arm {k} out", (f"driven arm {k}", "output"), mirror * arm),
            hinge(f"lever {k} on the yoke", ("yoke", f"lever {k}"), across, 0.02 if k == 1 else -0.02),
            hinge(f"lever {k} on its scissor", (f"lever {k}", f"driving arm {k}"), hinge_axis),
        ]
    return Mechanism(frame="frame", input_link="input", output_link="output", joints=tuple(joints))


@pytest.mark.slow
def test_a_sketch_becomes_a_joint_and_answers_in_a_drive():
    joint = MechanismJoint(drawing=sketched(20 * deg, 0.0, 15), joint_angle=12 * deg)
    drive = Drive(joints=(joint, Hooke(joint_angle=12 * deg)), duty=Duty(torque=100.0, speed=100.0))
    assert joint.even
    assert np.abs(joint.deviation(ANGLE, np.asarray(0.25))[0]).max() < 1e-9
    assert forces(drive).input_torque.max() == pytest.approx(100.0 / np.cos(12 * deg), rel=1e-6)
    assert "tell how much, rounding_mm" in refusal(sketched(20 * deg, 0.0, 6))  # micrometres


@pytest.mark.slow
@pytest.mark.parametrize("rounding", [0.2e-3, 0.02e-3])
def test_a_sketch_with_printed_digits_answers_in_a_drive(rounding):
    digits = 4 if rounding > 0.1e-3 else 5  # of metres: tenths or hundredths of a millimetre
    exact = MechanismJoint(drawing=sketched(20 * deg, 0.3, 15), joint_angle=12 * deg)
    drawn = MechanismJoint(drawing=replace(sketched(20 * deg, 0.3, digits), rounding=rounding), joint_angle=12 * deg)
    assert drawn.even  # but for what the rounding may make
    moved = {one.key: one.value for one in drawn.inside(12 * deg)}
    assert 0.0 < moved["drawing_shift"] <= rounding
    one, other = (
        forces(Drive(joints=(joint, Hooke(joint_angle=12 * deg)), duty=Duty(torque=100.0, speed=100.0)))
        for joint in (exact, drawn)
    )
    assert other.input_torque == pytest.approx(one.input_torque, rel=1e-9)
    said = [str(one) for one in beside_turning(Drive(joints=(drawn,)))]
    assert any("whose numbers are rounded" in one for one in said)


@pytest.mark.slow
def test_a_joint_angle_at_which_it_binds_is_refused_where_the_motion_is_asked():
    drive = Drive(joints=(replace(joint_of("thompson"), joint_angle=50 * deg),))
    with pytest.raises(InputError, match="cannot follow: with the driving link turned by"):
        motion(drive)


def test_the_file_is_read_beside_the_drive_file(tmp_path):
    drive = example("thompson-drive")
    (tmp_path / "own.toml").write_text(dumps(example_mechanism("thompson")), "utf-8")
    text = dumps(drive).replace('file = "thompson"', 'file = "own.toml"')
    (tmp_path / "drive.toml").write_text(text, "utf-8")
    assert load(tmp_path / "drive.toml").joints[0].drawing == drive.joints[0].drawing
    with pytest.raises(InputError, match=r"joints\[0\].file: .*missing.toml.* cannot be read"):
        loads(text.replace("own.toml", "missing.toml"), folder=tmp_path)
    (tmp_path / "own.toml").write_text("format = 1\n[[joints]]\nid = 'a'\nlinks = ['a', 'b']\n", "utf-8")
    with pytest.raises(InputError, match=r"joints\[0\].file"):
        load(tmp_path / "drive.toml")


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["SG", "S"])
def test_a_driven_shaft_that_a_ball_holds_alone_keeps_its_direction(kind):
    """The joint holds its centre and the ball another point of the shaft: as well as a bearing."""
    joint = joint_of("hooke-cured", bearing_2={"type": kind})
    bearing = joint_of("hooke-stiff-bearings")
    assert joint.fixed
    for one, other in zip(
        joint.deviation(ANGLE, np.asarray(0.4)), bearing.deviation(ANGLE, np.asarray(0.4)), strict=True
    ):
        assert np.abs(one - other).max() < 1e-12
    own, known = (joint_carried(one, 0.4, ANGLE).wrench for one in (joint, bearing))
    assert np.abs(own - known).max() < 1e-9


def test_a_ball_without_an_axis_does_not_tell_where_its_shaft_lies():
    joint = joint_of("hooke-cured", bearing_2={"type": "S", "axis": None})
    (problem,) = joint.own_problems()
    assert (
        "'shaft 2' needs one pair with the frame, of type R or C, or a ball, S or SG, with an axis" in problem.message
    )


def test_a_ball_off_the_shaft_is_refused():
    joint = joint_of("hooke-cured", bearing_2={"point": (0.312, 0.002, -0.130)})
    (problem,) = joint.own_problems()
    assert "its shafts pass each other" in problem.message
