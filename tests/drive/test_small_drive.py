"""What small functions of drive return."""

import math
from dataclasses import replace

from cardan.drive.accuracy import Error
from cardan.drive.body import body_material, inner_diameter
from cardan.drive.conditions import in_poses, load_cases
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty
from cardan.drive.fields.keys import in_a_joint, written
from cardan.drive.joints import Hooke
from cardan.drive.joints.clemens import Circle, course
from cardan.drive.joints.common.laws import places
from cardan.drive.joints.pin_coupling import wrapped
from cardan.drive.joints.tracta import tilt
from cardan.drive.models.dynamics_model import lengths_off, place_of, train
from cardan.drive.models.geometry import geometry_from_points
from cardan.drive.models.kinematics_model import as_hooke, mixed, refuse_kinds
from cardan.drive.settings import Pose
from cardan.drive.shaft import Layup, Ply, Shaft
from cardan.drive.yokes import yoke_mass
from cardan.joints import ConstantVelocity
from cardan.units import deg


def test_inner_diameter():
    assert inner_diameter(Shaft(number=2, outer=0.07, wall=0.002)) == 0.066


def test_body_material():
    layup = Layup(angles=(0.0, 0.0), ply_thickness=1e-3, ply=Ply(along=135e9, across=10e9, shear=5e9))
    assert round(body_material(Shaft(number=2, outer=0.09, layup=layup)).youngs / 1e9) == 135


def test_in_poses():
    turned = Pose(name="turned", share=0.25, set=(("joints[0].joint_angle_deg", 20.0),))
    assert [(one.name, one.share) for one in in_poses(replace(Drive.from_angles([0.1]), poses=(turned,)))] == [
        ("", 0.75),
        ("pose turned", 0.25),
    ]


def test_load_cases():
    parts = (Block(torque=900.0, speed=100.0, share=0.2), Block(torque=300.0, speed=200.0, share=0.8))
    assert [(one.name, one.share) for one in load_cases(Duty(torque=500.0, speed=150.0, blocks=parts))] == [
        ("", 0.0),
        ("part 1 of the duty cycle", 0.2),
        ("part 2 of the duty cycle", 0.8),
    ]
    start = Case(name="start", torque=900.0)
    assert [
        (one.name, one.torque, one.share) for one in load_cases(Duty(torque=500.0, speed=150.0, cases=(start,)))
    ] == [("", 500.0, 1.0), ("start", 900.0, 0.0)]


def test_written():
    assert written(0.3490658503988659, "angle") == ("deg", 20.0)


def test_in_a_joint():
    assert (
        in_a_joint(Drive.from_angles([0.3]), "friction"),
        in_a_joint(Drive.from_angles([0.3]), "cross", ".span"),
    ) == (("joints[0].friction",), ("joints[0].cross.span",))


def test_course():
    one = Circle(axial=0.06, radial=0.01, radius=0.075)
    other = Circle(axial=0.062, radial=0.011, radius=0.074)
    assert (
        str([f"{part:.6f}" for part in course(math.radians(130.0), math.radians(30.0), one, other)])
        == "['0.014375', '0.994057', '-0.028502']"
    )


def test_places():
    assert (places(6), places(3)) == (3, 3)


def test_wrapped():
    assert f"{wrapped(3.5 * math.pi) / math.pi:.1f}" == "-0.5"


def test_tilt():
    assert str(tilt(30 * deg, 0.020, [0.020, 0.021]) / deg) == "[0.         0.37444242]"


def test_lengths_off():
    assert repr(lengths_off([Error(s1=1e-5), None])[:, 0]) == "array([1.e-05, 0.e+00])"


def test_place_of():
    straight = train(Drive.from_angles([0.0, 0.5], plane_twists=[0.7]))
    assert (
        repr((place_of(straight).normal[0], geometry_from_points(straight.points).normal[0].round(3) + 0.0))
        == "(array([0., 1., 0.]), array([0.   , 0.765, 0.644]))"
    )


def test_refuse_kinds():
    refuse_kinds(Drive.from_angles([0.1]), "losses", "losses")


def test_mixed():
    assert not mixed([Hooke(joint_angle=0.1)])


def test_as_hooke():
    pair = Drive(joints=(Hooke(joint_angle=0.3), ConstantVelocity(joint_angle=0.4)))
    assert [joint.joint_angle for joint in as_hooke(pair).joints] == [0.3, 0.0]


def test_yoke_mass():
    assert yoke_mass(Hooke(joint_angle=0.1, mass=3.4, cross=Cross(span=0.07, mass=0.6))) == 1.4
